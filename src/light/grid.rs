//! The texels of a latitude–longitude picture on the sphere of directions.
//!
//! ```text
//! direction = (sin θ sin ψ, sin θ cos ψ, cos θ),  θ = π v,  ψ = 2π (u − 1/2) − rotation
//! ```
//!
//! u runs from left to right and v from top to bottom, 0…1 each: the top row is straight up (+z), the picture's middle is +y,
//! and who looks there with +z up sees it as it lies on a desk, +x at three quarters of its width. The rotation turns the
//! surroundings against the clock, seen from above.
//!
//! A texel covers Δψ (cos θ₀ − cos θ₁). Next to the poles cosines are all alike in single precision, so heights are kept as
//! 1 − |cos θ|, which has no cancellation there, and differences of cosines come from products of sines.

use glam::Vec3;
use std::f64::consts::PI;

#[derive(Clone, Debug)]
pub(super) struct Grid {
    pub width: u32,
    pub height: u32,
    /// Of the whole circle.
    turn: f32,
    /// 1 − |cos θ| at the upper and the lower edge of each row, from the pole on the row's side.
    heights: Vec<[f32; 2]>,
}

impl Grid {
    /// `rotation` in radians. Both sides are above 0.
    pub fn new(width: u32, height: u32, rotation: f64) -> Self {
        let edge = |row: u32, down: u32| {
            let theta = PI * f64::from(row + down) / f64::from(height);
            let sin = libm::sin(0.5 * if upper(row, height) { theta } else { PI - theta });
            (2.0 * sin * sin) as f32
        };
        let turns = rotation / (2.0 * PI);
        Self {
            width,
            height,
            turn: (turns - libm::floor(turns)) as f32,
            heights: (0..height).map(|row| [edge(row, 0), edge(row, 1)]).collect(),
        }
    }

    /// Of one texel of a row, sr.
    pub fn solid_angle(&self, row: u32) -> f64 {
        let height = f64::from(self.height);
        let sines = libm::sin(PI * (f64::from(row) + 0.5) / height) * libm::sin(0.5 * PI / height);
        2.0 * sines * 2.0 * PI / f64::from(self.width)
    }

    /// Row and column of a direction.
    #[inline]
    pub fn texel(&self, direction: Vec3) -> [u32; 2] {
        let Vec3 { x, y, z } = direction;
        let v = libm::atan2f((x * x + y * y).sqrt(), z) * std::f32::consts::FRAC_1_PI;
        let u = libm::atan2f(x, y) * (0.5 * std::f32::consts::FRAC_1_PI) + 0.5 + self.turn;
        let u = if u >= 1.0 { u - 1.0 } else { u };
        let index = |part: f32, count: u32| ((part * count as f32) as u32).min(count - 1);
        [index(v, self.height), index(u, self.width)]
    }

    /// A direction within a texel, uniform in solid angle for (a, b) uniform in the unit square.
    #[inline]
    pub fn direction(&self, [row, column]: [u32; 2], [a, b]: [f32; 2]) -> Vec3 {
        let [above, below] = self.heights[row as usize];
        let height = above + (below - above) * a;
        let z = if upper(row, self.height) { 1.0 - height } else { height - 1.0 };
        let radius = (height * (2.0 - height)).max(0.0).sqrt();
        let u = (column as f32 + b) / self.width as f32 - 0.5 - self.turn;
        let (sin, cos) = libm::sincosf(u * std::f32::consts::TAU);
        Vec3::new(radius * sin, radius * cos, z)
    }
}

/// Whether the middle of a row lies above the horizon.
#[inline]
fn upper(row: u32, height: u32) -> bool {
    2 * row < height
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sphere_is_covered_once() {
        for (width, height) in [(1, 1), (7, 3), (64, 32), (1, 4096)] {
            let grid = Grid::new(width, height, 0.0);
            let total: f64 = (0..height).map(|row| grid.solid_angle(row) * f64::from(width)).sum();
            assert!((total / (4.0 * PI) - 1.0).abs() < 1e-12, "{width} × {height}: {total}");
        }
    }

    #[test]
    fn directions_lie_in_their_texels_and_point_where_the_picture_says() {
        for (width, height, rotation) in [(8, 4, 0.0), (2048, 1024, 1.0), (3, 5, -2.0), (4096, 8192, 100.0)] {
            let grid = Grid::new(width, height, rotation);
            for row in (0..height).step_by(1 + height as usize / 40).chain([height - 1]) {
                for column in (0..width).step_by(1 + width as usize / 40).chain([width - 1]) {
                    for inside in [[0.5, 0.5], [0.1, 0.9], [0.9, 0.1]] {
                        let direction = grid.direction([row, column], inside);
                        assert!((direction.length() - 1.0).abs() < 1e-6);
                        assert_eq!(grid.texel(direction), [row, column], "{width} × {height}");
                    }
                }
            }
        }
        let grid = Grid::new(400, 200, 0.0);
        assert_eq!(grid.texel(Vec3::Y)[1], 200);
        assert_eq!(grid.texel(Vec3::X), [100, 300]);
        assert_eq!(grid.texel(Vec3::NEG_X), [100, 100]);
        assert_eq!((grid.texel(Vec3::Z)[0], grid.texel(Vec3::NEG_Z)[0]), (0, 199));
        // A quarter against the clock brings what was at +y to −x.
        assert_eq!(Grid::new(400, 200, PI / 2.0).texel(Vec3::NEG_X), [100, 200]);
        assert!([-0.0, 0.0].iter().all(|&x| grid.texel(Vec3::new(x, -1.0, 0.0))[1] < 400));
    }
}
