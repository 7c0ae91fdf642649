//! The standard round brilliant.
//!
//! 57 facets and the girdle: a table, 8 stars, 8 bezels (kites), 16 upper halves; 8 pavilion mains, 16 lower halves; 58
//! with a culet. Proportions are those of grading reports: M. S. Hemphill et al., "Modeling the appearance of the round
//! brilliant cut diamond", Gems & Gemology 34(3), 1998 (reference proportions and facet names), and T. M. Moses et al.,
//! "A foundation for grading the overall cut quality of round brilliant cut diamonds", Gems & Gemology 40(3), 2004 (star
//! and lower-half lengths).
//!
//! In plan, bezels and mains look to k · 45°, stars to 22.5° + k · 45°. The girdle outline is a polygon whose corners lie on
//! the circle of the given diameter, among them the 16 points where bezels, halves and mains reach it; there the girdle is
//! thickest, and between them the halves cut it thinner, as on real stones.

use std::f64::consts::PI;

use glam::DVec3;

use super::{trigonometry, within};
use crate::geometry::{Convex, GeometryError, Plane};

/// Proportions of a round brilliant; the default is within the best grade of the trade.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Brilliant {
    /// Of the girdle, scene units.
    pub diameter: f64,
    /// Table width from corner to opposite corner, over the diameter.
    pub table: f64,
    /// Bezels against the girdle plane, degrees.
    pub crown_angle: f64,
    /// Pavilion mains against the girdle plane, degrees.
    pub pavilion_angle: f64,
    /// Girdle thickness where bezels and mains meet it, over the diameter.
    pub girdle: f64,
    /// How far stars reach from table edge to girdle, in plan.
    pub star_length: f64,
    /// How far lower halves reach from girdle to the centre, in plan.
    pub lower_half_length: f64,
    /// Culet width across its flats, over the diameter; 0 is a point.
    pub culet: f64,
    /// Facets of the girdle, a multiple of 16. Each is one more plane for every ray inside: 32 keep the outline within
    /// 0.5 % of the radius of a circle, 89 planes in all; 64 within 0.12 %, with 121 planes and a third more time for an exit.
    /// 64 is the default because then a stone of 500 pixels is round to a third of a pixel.
    pub girdle_facets: u32,
}

impl Default for Brilliant {
    fn default() -> Self {
        Self {
            diameter: 1.0,
            table: 0.57,
            crown_angle: 34.5,
            pavilion_angle: 40.75,
            girdle: 0.035,
            star_length: 0.5,
            lower_half_length: 0.77,
            culet: 0.0,
            girdle_facets: 64,
        }
    }
}

/// An eighth and a sixteenth of a turn.
const EIGHTH: f64 = PI / 4.0;
const SIXTEENTH: f64 = PI / 8.0;

/// Heights of the parts above the culet, scene units.
struct Heights {
    girdle_bottom: f64,
    girdle_top: f64,
    table: f64,
}

impl Brilliant {
    /// The stone: its facets in the order table, bezels, stars, upper halves, girdle, mains, lower halves, culet.
    pub fn solid(&self) -> Result<Convex, GeometryError> {
        let planes = self.planes()?;
        let solid = Convex::from_planes(&planes)?;
        if solid.facets().len() < planes.len() {
            return Err(GeometryError::Proportion {
                name: "the set of proportions",
                value: solid.facets().len() as f64,
                wants: format!(
                    "only so many of its {} facets are left; star length, lower-half length, culet and girdle must leave each facet some area",
                    planes.len()
                ),
            });
        }
        Ok(solid)
    }

    /// From culet to table, scene units.
    pub fn height(&self) -> f64 {
        self.heights().table
    }

    /// Height of the girdle's middle above the culet, scene units.
    pub fn girdle_height(&self) -> f64 {
        let heights = self.heights();
        0.5 * (heights.girdle_bottom + heights.girdle_top)
    }

    fn heights(&self) -> Heights {
        let radius = 0.5 * self.diameter;
        let (_, _, crown) = trigonometry(self.crown_angle);
        let (_, _, pavilion) = trigonometry(self.pavilion_angle);
        let girdle_bottom = pavilion * radius * (1.0 - self.culet);
        let girdle_top = girdle_bottom + self.girdle * self.diameter;
        Heights { girdle_bottom, girdle_top, table: girdle_top + crown * radius * (1.0 - self.table) }
    }

    fn planes(&self) -> Result<Vec<Plane>, GeometryError> {
        crate::geometry::check::length("the diameter of the brilliant", self.diameter)?;
        within("the table", self.table, 0.2, 0.9)?;
        within("the crown angle", self.crown_angle, 5.0, 60.0)?;
        within("the pavilion angle", self.pavilion_angle, 10.0, 70.0)?;
        within("the girdle", self.girdle, 0.001, 0.5)?;
        within("the star length", self.star_length, 0.05, 0.95)?;
        within("the lower-half length", self.lower_half_length, 0.05, 0.98)?;
        within("the culet", self.culet, 0.0, 0.5)?;
        within("the number of girdle facets", self.girdle_facets as f64, 16.0, 1024.0)?;
        if !self.girdle_facets.is_multiple_of(16) {
            return Err(GeometryError::Proportion {
                name: "the number of girdle facets",
                value: self.girdle_facets as f64,
                wants: "it must be a multiple of 16, so that all facets meet the girdle at its corners".into(),
            });
        }
        let radius = 0.5 * self.diameter;
        let at = |r: f64, angle: f64, z: f64| {
            let (sin, cos) = libm::sincos(angle);
            DVec3::new(r * cos, r * sin, z)
        };
        let Heights { girdle_bottom, girdle_top, table: top } = self.heights();
        let (crown_sin, crown_cos, crown_tan) = trigonometry(self.crown_angle);
        let (pavilion_sin, pavilion_cos, pavilion_tan) = trigonometry(self.pavilion_angle);
        let (_, cos_16th) = libm::sincos(SIXTEENTH);

        // Where two bezels, a star and two upper halves meet, and two mains and two lower halves.
        let table_radius = self.table * radius;
        let star_radius = table_radius * cos_16th + self.star_length * (radius - table_radius * cos_16th);
        let star_z = girdle_top + crown_tan * (radius - star_radius * cos_16th);
        let lower_radius = (1.0 - self.lower_half_length) * radius;
        let lower_z = girdle_bottom - pavilion_tan * (radius - lower_radius * cos_16th);

        if self.culet > 0.0 && lower_z <= 0.0 {
            let wants = "it swallows the tips of the lower halves; make it smaller or the lower halves shorter".into();
            return Err(GeometryError::Proportion { name: "the culet", value: self.culet, wants });
        }

        let mut planes = vec![Plane::new(DVec3::Z, top)];
        let eighth = |k: usize| k as f64 * EIGHTH;
        planes.extend((0..8).map(|k| {
            let normal = at(crown_sin, eighth(k), crown_cos);
            Plane::through(at(radius, eighth(k), girdle_top), normal)
        }));
        planes.extend((0..8).map(|k| {
            let corners = [
                at(table_radius, eighth(k), top),
                at(star_radius, eighth(k) + SIXTEENTH, star_z),
                at(table_radius, eighth(k) + EIGHTH, top),
            ];
            through(corners, DVec3::Z)
        }));
        let halves = |apex_radius: f64, apex_z: f64, girdle_z: f64, up: DVec3| {
            (0..16usize).map(move |i| {
                // The half between the bezel (or main) at an eighth and the apex a sixteenth before or after it.
                let (k, sign) = (i.div_ceil(2), if i.is_multiple_of(2) { 1.0 } else { -1.0 });
                let main = eighth(k);
                let middle = main + sign * SIXTEENTH;
                through([at(radius, main, girdle_z), at(radius, middle, girdle_z), at(apex_radius, middle, apex_z)], up)
            })
        };
        planes.extend(halves(star_radius, star_z, girdle_top, DVec3::Z));
        let count = self.girdle_facets as usize;
        let half_step = PI / count as f64;
        let (_, cos_half) = libm::sincos(half_step);
        planes.extend((0..count).map(|i| Plane::new(at(1.0, (2 * i + 1) as f64 * half_step, 0.0), radius * cos_half)));
        planes.extend((0..8).map(|k| {
            let normal = at(pavilion_sin, eighth(k), -pavilion_cos);
            Plane::through(at(radius, eighth(k), girdle_bottom), normal)
        }));
        planes.extend(halves(lower_radius, lower_z, girdle_bottom, -DVec3::Z));
        if self.culet > 0.0 {
            planes.push(Plane::new(-DVec3::Z, 0.0));
        }
        Ok(planes)
    }
}

/// The plane through three points, facing `up`.
fn through(corners: [DVec3; 3], up: DVec3) -> Plane {
    let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    Plane::through(corners[0], if normal.dot(up) < 0.0 { -normal } else { normal })
}
