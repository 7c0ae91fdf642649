//! A picture on a surface: what it shows at texture coordinates.
//!
//! Between the middles of texels values are mixed bilinearly. There is no pyramid of smaller pictures: a pixel's samples lie
//! all over what it covers, so they already average the picture there, converge to the exact mean and blur nothing. A
//! pyramid would be of use with few samples a pixel; a spectral picture takes many.

use super::Index;
use glam::Vec2;

/// What lies beyond a picture's edges.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wrap {
    #[default]
    Repeat,
    Clamp,
}

/// Texels, rows from the top, and how they lie on a surface: `scale` pictures beside and above each other per unit of u and v, the first one's
/// lower left corner at u = v = 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Texels<T> {
    size: [u32; 2],
    /// What texels show.
    values: Vec<T>,
    /// Which of the values each texel shows; its own unless given.
    index: Option<Index>,
    scale: Vec2,
    wrap: Wrap,
}

impl<T: Copy> Texels<T> {
    /// `texels` fill both sides of `size`, which are above 0.
    pub fn new(size: [u32; 2], texels: Vec<T>, scale: [f32; 2], wrap: Wrap) -> Self {
        Self { size, values: texels, index: None, scale: Vec2::from_array(scale), wrap }
    }

    /// The same of a picture with few values, of which `index` names one for each texel.
    pub fn indexed(size: [u32; 2], mut values: Vec<T>, index: Index, scale: [f32; 2], wrap: Wrap) -> Self {
        let (used, first) = (index.used(values.len()), values[index.at(0)]);
        values.iter_mut().zip(used).filter(|(_, used)| !used).for_each(|(value, _)| *value = first);
        Self { size, values, index: Some(index), scale: Vec2::from_array(scale), wrap }
    }

    /// The same picture of other values.
    pub fn map<U>(self, value: impl Fn(T) -> U) -> Texels<U> {
        let Self { size, values, index, scale, wrap } = self;
        Texels { size, values: values.into_iter().map(value).collect(), index, scale, wrap }
    }

    /// Every value that a texel shows, and no other.
    pub fn all(&self) -> &[T] {
        &self.values
    }

    /// The four texels around a point, with weights that sum to 1. v points up.
    #[inline]
    pub fn around(&self, uv: Vec2) -> [(T, f32); 4] {
        let [width, height] = self.size;
        let ([left, right], x) = self.neighbours(uv.x * self.scale.x, width);
        let ([top, bottom], y) = self.neighbours(1.0 - uv.y * self.scale.y, height);
        let texel = |row: u32, column: u32| {
            let texel = row as usize * width as usize + column as usize;
            self.values[self.index.as_ref().map_or(texel, |index| index.at(texel))]
        };
        [
            (texel(top, left), (1.0 - x) * (1.0 - y)),
            (texel(top, right), x * (1.0 - y)),
            (texel(bottom, left), (1.0 - x) * y),
            (texel(bottom, right), x * y),
        ]
    }

    /// The two texels along an axis whose middles enclose a place, given in pictures, and how near it is to the second.
    #[inline]
    fn neighbours(&self, place: f32, count: u32) -> ([u32; 2], f32) {
        let within = match self.wrap {
            // Before anything else, so that far copies keep their digits. It may round to 1.
            Wrap::Repeat => place - libm::floorf(place),
            Wrap::Clamp => place.clamp(0.0, 1.0),
        };
        let position = within * count as f32 - 0.5;
        let first = libm::floorf(position);
        // −1 … count.
        let index = |i: i64| match self.wrap {
            Wrap::Repeat => i.rem_euclid(i64::from(count)) as u32,
            Wrap::Clamp => i.clamp(0, i64::from(count) - 1) as u32,
        };
        ([index(first as i64), index(first as i64 + 1)], position - first)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(texels: &Texels<f32>, u: f32, v: f32) -> f32 {
        let around = texels.around(Vec2::new(u, v));
        assert!((around.iter().map(|(_, weight)| weight).sum::<f32>() - 1.0).abs() < 1e-6);
        around.iter().map(|(texel, weight)| texel * weight).sum()
    }

    #[test]
    fn middles_show_their_texel_and_the_top_row_is_up() {
        for wrap in [Wrap::Repeat, Wrap::Clamp] {
            let texels = Texels::new([3, 2], vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0], [1.0, 1.0], wrap);
            for (i, expected) in [1.0, 2.0, 3.0, 4.0, 5.0, 6.0].into_iter().enumerate() {
                let (u, v) = ((i % 3) as f32 / 3.0 + 1.0 / 6.0, 0.75 - 0.5 * (i / 3) as f32);
                assert!((value(&texels, u, v) - expected).abs() < 1e-5, "{i}");
            }
            assert!(
                (value(&texels, 1.0 / 3.0, 0.75) - 1.5).abs() < 1e-5 && (value(&texels, 0.5, 0.5) - 3.5).abs() < 1e-5
            );
        }
    }

    #[test]
    fn edges_repeat_or_stay() {
        let row = |scale, wrap| Texels::new([2, 1], vec![0.0, 1.0], [scale, 1.0], wrap);
        let (repeat, clamp) = (row(1.0, Wrap::Repeat), row(1.0, Wrap::Clamp));
        assert!((value(&repeat, 0.0, 0.3) - 0.5).abs() < 1e-6 && (value(&repeat, 1.0, 0.3) - 0.5).abs() < 1e-6);
        assert_eq!((value(&clamp, 0.0, 0.3), value(&clamp, 1.0, 0.3), value(&clamp, 7.0, -3.0)), (0.0, 1.0, 1.0));
        for u in [0.05, 0.3, 0.6, 0.95] {
            let once = value(&repeat, u, 0.5);
            assert!(
                (value(&repeat, u + 3.0, 0.5) - once).abs() < 1e-5
                    && (value(&repeat, u - 2.0, 0.5) - once).abs() < 1e-5
            );
            assert!((value(&row(4.0, Wrap::Repeat), u / 4.0, 0.5) - once).abs() < 1e-5);
        }
        let one = Texels::new([1, 1], vec![0.7], [1.0, 1.0], Wrap::Repeat);
        assert!([-1e9, -1e-9, 0.0, 0.5, 1.0, 1e9].iter().all(|&u| (value(&one, u, u) - 0.7).abs() < 1e-6));
    }
}
