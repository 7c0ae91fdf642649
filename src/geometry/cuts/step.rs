//! The step cut (emerald cut): an octagonal outline, and three steps of facets along each of its sides above and below.
//!
//! All eight sides share one profile, so the steps are parallel to the outline. Steps are steepest at the girdle. In plan,
//! the crown's three have the same width; so have the pavilion's, which end in a keel along the stone's length.

use glam::DVec3;

use super::{trigonometry, within};
use crate::geometry::{Convex, GeometryError, Plane};

/// Proportions of a step cut; the default suits a sapphire.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepCut {
    /// Across the shorter sides of the outline, along y, scene units.
    pub width: f64,
    /// Length, along x, over width.
    pub length_ratio: f64,
    /// How much of the width each cut corner takes from a side.
    pub corner: f64,
    /// Table width over stone width.
    pub table: f64,
    /// Crown steps from girdle to table, degrees.
    pub crown_angles: [f64; 3],
    /// Pavilion steps from girdle to keel, degrees.
    pub pavilion_angles: [f64; 3],
    /// Girdle thickness over width.
    pub girdle: f64,
}

impl Default for StepCut {
    fn default() -> Self {
        Self {
            width: 1.0,
            length_ratio: 1.4,
            corner: 0.15,
            table: 0.6,
            crown_angles: [47.0, 40.0, 33.0],
            pavilion_angles: [55.0, 48.0, 41.0],
            girdle: 0.03,
        }
    }
}

impl StepCut {
    /// The stone, its keel on z = 0 and its table up.
    pub fn solid(&self) -> Result<Convex, GeometryError> {
        crate::geometry::check::length("the width of the step cut", self.width)?;
        within("the length ratio", self.length_ratio, 1.0, 10.0)?;
        within("the corner", self.corner, 0.01, 0.45)?;
        within("the table", self.table, 0.2, 0.9)?;
        within("the girdle", self.girdle, 0.001, 0.5)?;
        for (name, angles) in [("a crown angle", self.crown_angles), ("a pavilion angle", self.pavilion_angles)] {
            for angle in angles {
                within(name, angle, 5.0, 80.0)?;
            }
            if let Some(pair) = angles.windows(2).find(|pair| pair[1] >= pair[0]) {
                let wants = format!("it must be below the step before it ({}), nearer to the girdle", pair[0]);
                return Err(GeometryError::Proportion { name, value: pair[1], wants });
            }
        }
        let (half_width, half_length) = (0.5 * self.width, 0.5 * self.width * self.length_ratio);
        // Outward directions and distances of the outline's sides.
        let diagonal = 0.5f64.sqrt();
        let corner = (half_width + half_length - self.corner * self.width) * diagonal;
        let sides: Vec<(DVec3, f64)> = (-1..=1)
            .flat_map(|x| (-1..=1).map(move |y| (x as f64, y as f64)))
            .filter_map(|(x, y)| match (x != 0.0, y != 0.0) {
                (true, true) => Some((DVec3::new(x * diagonal, y * diagonal, 0.0), corner)),
                (true, false) => Some((DVec3::new(x, 0.0, 0.0), half_length)),
                (false, true) => Some((DVec3::new(0.0, y, 0.0), half_width)),
                (false, false) => None,
            })
            .collect();
        let crown_step = half_width * (1.0 - self.table) / 3.0;
        let pavilion_step = half_width / 3.0;
        let drop = |angles: [f64; 3], step: f64| angles.map(|a| trigonometry(a).2 * step);
        let girdle_bottom: f64 = drop(self.pavilion_angles, pavilion_step).iter().sum();
        let girdle_top = girdle_bottom + self.girdle * self.width;

        let mut planes = Vec::new();
        let mut steps = |angles: [f64; 3], step: f64, start: f64, up: f64| {
            let mut z = start;
            for (i, angle) in angles.into_iter().enumerate() {
                let (sin, cos, tan) = trigonometry(angle);
                for &(out, distance) in &sides {
                    let edge = out * (distance - i as f64 * step) + DVec3::Z * z;
                    planes.push(Plane::through(edge, out * sin + DVec3::Z * (up * cos)));
                }
                z += up * tan * step;
            }
            z
        };
        let top = steps(self.crown_angles, crown_step, girdle_top, 1.0);
        steps(self.pavilion_angles, pavilion_step, girdle_bottom, -1.0);
        planes.extend(sides.iter().map(|&(out, distance)| Plane::new(out, distance)));
        planes.push(Plane::new(DVec3::Z, top));
        Convex::from_planes(&planes)
    }
}
