//! What the surfaces of a pixel look like without their light: exact sums of albedo and normal.
//!
//! Both lie in [−1, 1], so a 64-bit integer in units of 2⁻³⁰ holds 2³² of them: exact in any order, as the film is
//! ([`fixed`](super::fixed)), at half the size.

const UNIT: f32 = (1u32 << 30) as f32;

/// Sums of albedo and normal over a pixel's samples. 56 bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Features {
    albedo: [i64; 3],
    normal: [i64; 3],
    count: u32,
}

impl Features {
    /// Adds what one sample sees; the albedo is linear RGB in 0…1, the normal a unit vector or zero.
    #[inline]
    pub fn add(&mut self, albedo: [f32; 3], normal: [f32; 3]) {
        for channel in 0..3 {
            self.albedo[channel] = self.albedo[channel].wrapping_add(units(albedo[channel]));
            self.normal[channel] = self.normal[channel].wrapping_add(units(normal[channel]));
        }
        self.count = self.count.saturating_add(1);
    }

    /// Mean albedo; zero without samples.
    pub fn albedo(&self) -> [f32; 3] {
        self.mean(&self.albedo)
    }

    /// Mean normal: shorter than 1 where a pixel sees several.
    pub fn normal(&self) -> [f32; 3] {
        self.mean(&self.normal)
    }

    fn mean(&self, sums: &[i64; 3]) -> [f32; 3] {
        sums.map(|sum| (sum as f64 / (f64::from(UNIT) * f64::from(self.count.max(1)))) as f32)
    }
}

fn units(x: f32) -> i64 {
    (x.clamp(-1.0, 1.0) * UNIT) as i64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn order_changes_nothing_and_means_are_right() {
        let samples: Vec<[f32; 3]> = (0..1000).map(|i| [(i as f32 * 0.37).sin(), 0.1 * (i % 7) as f32, -1.0]).collect();
        let mut sums = [Features::default(); 2];
        samples.iter().for_each(|s| sums[0].add(*s, *s));
        samples.iter().rev().for_each(|s| sums[1].add(*s, *s));
        assert_eq!(sums[0], sums[1]);
        let mean = samples.iter().map(|s| f64::from(s[0])).sum::<f64>() / 1000.0;
        assert!((f64::from(sums[0].normal()[0]) - mean).abs() < 1e-8);
        assert_eq!((sums[0].albedo()[2], Features::default().normal()), (-1.0, [0.0; 3]));
    }
}
