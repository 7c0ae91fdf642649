//! Numbers as colours: scales of fixed steps, so that maps of different reports can be compared.
//!
//! - Sizes: `magma` of N. Smith & S. van der Walt (2015, CC0), perceptually uniform from black to pale yellow, in the
//!   polynomial fit of M. Zucker (2019, CC0), within 0.02 of the table.
//! - Signs: `RdBu` of C. Brewer (ColorBrewer 2.0, 2013), blue below zero and red above.
//!
//! Between two steps a scale is linear.

/// sRGB-encoded, 8 bits a channel.
pub type Colour = [u8; 3];

/// A way to paint numbers.
#[derive(Clone, Copy, Debug)]
pub struct Scale {
    /// Numbers at equal distances of the colours; the last one is painted alike with all that lie beyond it.
    pub steps: &'static [f64],
    map: fn(f64) -> Colour,
}

/// ΔE2000: 1 can just be told, 10 is another colour.
pub const DELTA_E: Scale = Scale { steps: &[0.0, 1.0, 2.0, 5.0, 10.0], map: magma };

/// Differences of luminance in units of display white.
pub const LUMINANCE: Scale = Scale { steps: &[-0.2, -0.05, -0.01, 0.0, 0.01, 0.05, 0.2], map: red_blue };

impl Scale {
    pub fn colour(&self, value: f64) -> Colour {
        (self.map)(self.position(value))
    }

    /// The colour at a part of the scale, 0…1: for legends.
    pub fn at(&self, position: f64) -> Colour {
        (self.map)(position)
    }

    /// Where on the scale a number lies, 0…1.
    fn position(&self, value: f64) -> f64 {
        let intervals = self.steps.len() - 1;
        let above = self.steps.iter().take_while(|step| **step <= value).count();
        let interval = above.clamp(1, intervals) - 1;
        let (low, high) = (self.steps[interval], self.steps[interval + 1]);
        ((interval as f64 + (value - low) / (high - low)) / intervals as f64).clamp(0.0, 1.0)
    }

    /// The pixels of a map, channels beside each other.
    pub fn paint(&self, values: &[f32]) -> Vec<u8> {
        values.iter().flat_map(|value| self.colour(f64::from(*value))).collect()
    }
}

fn magma(t: f64) -> Colour {
    const POWERS: [[f64; 3]; 7] = [
        [-0.002136485053939582, -0.000749655052795221, -0.005386127855323933],
        [0.2516605407371642, 0.6775232436837668, 2.494026599312351],
        [8.353717279216625, -3.577719514958484, 0.3144679030132573],
        [-27.66873308576866, 14.26473078096533, -13.64921318813922],
        [52.17613981234068, -27.94360607168351, 12.94416944238394],
        [-50.76852536473588, 29.04658282127291, 4.23415299384598],
        [18.65570506591883, -11.48977351997711, -5.601961508734096],
    ];
    std::array::from_fn(|i| byte(255.0 * POWERS.iter().rev().fold(0.0, |sum, power| sum * t + power[i])))
}

fn red_blue(t: f64) -> Colour {
    const COLOURS: [[f64; 3]; 11] = [
        [5.0, 48.0, 97.0],
        [33.0, 102.0, 172.0],
        [67.0, 147.0, 195.0],
        [146.0, 197.0, 222.0],
        [209.0, 229.0, 240.0],
        [247.0, 247.0, 247.0],
        [253.0, 219.0, 199.0],
        [244.0, 165.0, 130.0],
        [214.0, 96.0, 77.0],
        [178.0, 24.0, 43.0],
        [103.0, 0.0, 31.0],
    ];
    let place = t * (COLOURS.len() - 1) as f64;
    let first = (place as usize).min(COLOURS.len() - 2);
    let part = place - first as f64;
    std::array::from_fn(|i| byte(COLOURS[first][i] + part * (COLOURS[first + 1][i] - COLOURS[first][i])))
}

fn byte(value: f64) -> u8 {
    libm::round(value.clamp(0.0, 255.0)) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn magma_is_that_of_its_table() {
        // matplotlib 3.9, `magma` at 0, 0.25, 0.5, 0.75 and 1.
        let table = [[0, 0, 4], [81, 18, 124], [183, 55, 121], [252, 137, 97], [252, 253, 191]];
        for (i, expected) in table.iter().enumerate() {
            let found = magma(i as f64 / 4.0);
            assert!(found.iter().zip(expected).all(|(a, b)| i32::from(*a).abs_diff(*b) <= 5), "{found:?} {expected:?}");
        }
    }

    #[test]
    fn steps_are_evenly_apart() {
        for (value, position) in
            [(-1.0, 0.0), (0.0, 0.0), (0.5, 0.125), (1.0, 0.25), (3.5, 0.625), (10.0, 1.0), (99.0, 1.0)]
        {
            assert!((DELTA_E.position(value) - position).abs() < 1e-12, "{value}");
        }
        assert_eq!(LUMINANCE.colour(0.0), [247; 3]);
        assert_eq!((LUMINANCE.colour(-9.0), LUMINANCE.colour(9.0)), ([5, 48, 97], [103, 0, 31]));
        assert_eq!(DELTA_E.paint(&[0.0, 20.0]).len(), 6);
    }
}
