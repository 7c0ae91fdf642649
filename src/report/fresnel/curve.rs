//! Reflectance of a model against angle and wavelength, polarised where the model knows polarisation.
//!
//! At wavelengths the exact model is the f64 reference; the others are the f32 kernels that render. In red, green and blue it is the
//! linear sRGB colour of the reflected light under D65, neither clipped nor rounded.

use super::Subject;
use crate::fresnel::{FresnelModel, SpectralModel, Tabulated, Target};
use crate::math::Lanes;
use crate::spectrum::Colorimeter;
use serde::{Serialize, Serializer};
use std::fmt;

/// What a reflectance is of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lane {
    /// A wavelength, nm.
    Nm(f64),
    /// 0, 1 or 2: red, green or blue of linear sRGB under D65.
    Channel(usize),
}

/// An angle of incidence, both ways exactly as asked for where it was.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Angle {
    pub cos_theta: f64,
    /// Degrees.
    pub theta_deg: f64,
}

/// One reflectance: a line of the CSV, an object of the JSON.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    pub material: String,
    pub model: FresnelModel,
    /// nm, or "r", "g", "b".
    pub lane: Lane,
    pub cos_theta: f64,
    pub theta_deg: f64,
    /// None of models without polarisation.
    #[serde(rename = "Rs")]
    pub rs: Option<f64>,
    #[serde(rename = "Rp")]
    pub rp: Option<f64>,
    #[serde(rename = "R")]
    pub r: f64,
}

/// What is drawn along the curve; the other one tells curves apart.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Over {
    #[default]
    Angle,
    Wavelength,
}

/// Where reflectances are asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    pub over: Over,
    pub lanes: Vec<Lane>,
    pub angles: Vec<Angle>,
}

impl Lane {
    pub const RGB: [Self; 3] = [Self::Channel(0), Self::Channel(1), Self::Channel(2)];
}

impl fmt::Display for Lane {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Nm(nm) => write!(f, "{nm}"),
            Self::Channel(channel) => f.write_str(["r", "g", "b"][*channel % 3]),
        }
    }
}

impl Serialize for Lane {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Nm(nm) => serializer.serialize_f64(*nm),
            Self::Channel(_) => serializer.collect_str(self),
        }
    }
}

impl Angle {
    /// The cosine of 90° is 0 exactly.
    pub fn from_degrees(theta_deg: f64) -> Self {
        let cos_theta = match theta_deg > 45.0 {
            true => libm::sin((90.0 - theta_deg).to_radians()),
            false => libm::cos(theta_deg.to_radians()),
        };
        Self { cos_theta, theta_deg }
    }

    pub fn from_cosine(cos_theta: f64) -> Self {
        Self { cos_theta, theta_deg: libm::acos(cos_theta).to_degrees() }
    }
}

/// A model on an interface, ready to be asked.
struct Curve<'a> {
    model: FresnelModel,
    tabulated: Tabulated<'a>,
    subject: &'a Subject<'a>,
    meter: &'a Colorimeter,
}

/// The reflectances that a model has for an interface, curve by curve; an RGB model has none at wavelengths.
pub fn rows(model: FresnelModel, subject: &Subject, meter: &Colorimeter, grid: &Grid) -> Vec<Row> {
    let target = Target::new(subject.specimen, meter);
    let curve = Curve { model, tabulated: Tabulated::new(model, &target), subject, meter };
    let along_angles = grid.lanes.iter().flat_map(|&lane| grid.angles.iter().map(move |&angle| (lane, angle)));
    let along_lanes = grid.angles.iter().flat_map(|&angle| grid.lanes.iter().map(move |&lane| (lane, angle)));
    match grid.over {
        Over::Angle => along_angles.filter_map(|(lane, angle)| curve.row(lane, angle)).collect(),
        Over::Wavelength => along_lanes.filter_map(|(lane, angle)| curve.row(lane, angle)).collect(),
    }
}

impl Curve<'_> {
    fn row(&self, lane: Lane, Angle { cos_theta, theta_deg }: Angle) -> Option<Row> {
        let r = match lane {
            Lane::Nm(nm) => self.at(nm, cos_theta)?,
            Lane::Channel(channel) => self.color(cos_theta)[channel],
        };
        let [rs, rp] = self.polarised(lane, cos_theta).map_or([None; 2], |both| both.map(Some));
        Some(Row { material: self.subject.name.clone(), model: self.model, lane, cos_theta, theta_deg, rs, rp, r })
    }

    fn at(&self, nm: f64, cos: f64) -> Option<f64> {
        match self.of_clear_media() {
            Some(model) => Some(self.interface(model, nm, cos)),
            None => self.tabulated.at(nm, cos),
        }
    }

    fn color(&self, cos: f64) -> [f64; 3] {
        match self.of_clear_media() {
            Some(model) => self.meter.rgb(|nm| self.interface(model, nm, cos)),
            None => self.tabulated.color(cos, 1, self.meter),
        }
    }

    /// The spectral approximation whose rules for total reflection apply.
    fn of_clear_media(&self) -> Option<SpectralModel> {
        match self.model {
            FresnelModel::Spectral(model) if self.subject.clear && self.model != FresnelModel::EXACT => Some(model),
            _ => None,
        }
    }

    /// Reflectance at the boundary of two clear media, from either side.
    fn interface(&self, model: SpectralModel, nm: f64, cos: f64) -> f64 {
        let [n1, n2, _] = self.subject.specimen.indices(nm).map(|index| Lanes([index as f32]));
        f64::from(model.dielectric(&n1, &n2, &Lanes([cos as f32])).r[0])
    }

    /// R_s and R_p, which the exact model alone knows.
    fn polarised(&self, lane: Lane, cos: f64) -> Option<[f64; 2]> {
        let exact = |nm: f64| {
            let reflection = self.subject.specimen.reflect(nm, cos);
            [reflection.rs, reflection.rp]
        };
        (self.model == FresnelModel::EXACT).then(|| match lane {
            Lane::Nm(nm) => exact(nm),
            Lane::Channel(channel) => [0, 1].map(|part| self.meter.rgb(|nm| exact(nm)[part])[channel]),
        })
    }
}
