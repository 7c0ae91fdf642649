//! What a scene file says, before any name is looked up: serde structures with the place of every value that can be wrong.
//!
//! Kinds are externally tagged (`shape.sphere = { … }`, `[conductor]`), so that an error points at the exact place; untagged
//! and flattened structures lose it.

use crate::fresnel::FresnelModel;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use toml::Spanned;

pub type Vector = Spanned<[f64; 3]>;
type Number = Spanned<f64>;

/// A whole scene file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneFile {
    /// Length of one scene unit in metres; required when something absorbs.
    pub meters_per_unit: Option<Number>,
    /// The dielectric that surrounds everything; vacuum unless named.
    pub outside: Option<Spanned<String>>,
    #[serde(default)]
    pub render: Render,
    pub camera: Spanned<Camera>,
    #[serde(default)]
    pub picture: Picture,
    pub environment: Option<Spanned<Environment>>,
    #[serde(default)]
    pub materials: BTreeMap<String, Spanned<Material>>,
    #[serde(default)]
    pub objects: Vec<Spanned<Object>>,
}

/// How to render: everything here can be overridden on the command line.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Render {
    pub width: Option<Spanned<u32>>,
    pub height: Option<Spanned<u32>>,
    pub samples: Option<Spanned<u32>>,
    pub seed: Option<u64>,
    /// The longest path in surface interactions; no bound but roulette unless given.
    pub max_depth: Option<Spanned<u32>>,
    #[serde(default)]
    pub filter: FilterName,
    #[serde(default)]
    pub sampler: SamplerName,
    /// A Fresnel model for the whole render.
    pub fresnel: Option<FresnelModel>,
}

#[derive(Clone, Copy, Debug, Default, Deserialize, Serialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub enum FilterName {
    Box,
    #[default]
    BlackmanHarris,
}

#[derive(Clone, Copy, Debug, Default, Deserialize, Serialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub enum SamplerName {
    #[default]
    Sobol,
    Independent,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Camera {
    pub position: Vector,
    pub look_at: Vector,
    #[serde(default = "up")]
    pub up: [f64; 3],
    /// Horizontal field of view in degrees.
    pub fov: Option<Number>,
    pub focal_length_mm: Option<Number>,
    #[serde(default = "full_frame")]
    pub sensor_width_mm: f64,
}

fn up() -> [f64; 3] {
    [0.0, 0.0, 1.0]
}

fn full_frame() -> f64 {
    36.0
}

/// How the film is developed.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Picture {
    pub exposure: Option<Spanned<ExposureValue>>,
    /// `"scene"` (the strongest light's own spectrum) or an illuminant's name.
    pub white_balance: Option<Spanned<String>>,
    #[serde(default)]
    pub gamut: GamutName,
    #[serde(default)]
    pub observer: ObserverName,
}

#[derive(Clone, Copy, Debug, Default, Deserialize, Serialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub enum GamutName {
    #[default]
    Clip,
    PreserveChroma,
}

/// Whose eye the film sees with.
#[derive(Clone, Copy, Debug, Default, Deserialize, Serialize, PartialEq, Eq)]
pub enum ObserverName {
    #[default]
    #[serde(rename = "cie-1931-2")]
    Cie1931,
    #[serde(rename = "cie-1964-10")]
    Cie1964,
    #[serde(rename = "cie-2015-2")]
    Cie2015,
}

/// `"auto"` or an exposure value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ExposureValue {
    Auto,
    Ev(f64),
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Environment {
    Constant(Emission),
    Gradient(Box<Gradient>),
}

/// Radiance by direction: `nadir` straight down, `horizon` level, `zenith` straight up (+z), linear in the sine of the
/// elevation between them.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Gradient {
    pub zenith: Emission,
    pub horizon: Emission,
    pub nadir: Emission,
}

/// A spectrum with a strength.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Emission {
    pub spectrum: Spanned<LightSpectrum>,
    /// cd/m².
    pub luminance: Option<Number>,
    /// W m⁻² sr⁻¹ over 360–830 nm.
    pub radiance: Option<Number>,
    /// Multiplies a spectrum that is stated in W m⁻² sr⁻¹ nm⁻¹.
    pub scale: Option<Number>,
    /// Flat shapes shine from the front only unless this is true.
    #[serde(default)]
    pub two_sided: bool,
}

/// An illuminant's name or file, or a spectrum of its own.
#[derive(Debug)]
pub enum LightSpectrum {
    Name(String),
    Own(OwnLight),
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum OwnLight {
    /// Colour temperature in K.
    Blackbody(Number),
    /// CIE daylight of this correlated colour temperature in K.
    Daylight(Number),
    Table(OwnTable),
    /// Emission lines as [wavelength in nm, relative power].
    Lines(Vec<[f64; 2]>),
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OwnTable {
    pub wavelength_nm: Vec<f64>,
    pub value: Vec<f64>,
}

/// A material: a file of `materials/` or an entry of a scene's `[materials]`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Material {
    pub description: Option<String>,
    /// Other names; the library looks materials up by them.
    #[serde(default)]
    pub aliases: Vec<String>,
    pub conductor: Option<Spanned<Conductor>>,
    pub dielectric: Option<Spanned<Dielectric>>,
    pub diffuse: Option<Spanned<Diffuse>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Conductor {
    pub ior: Spanned<IndexSource>,
    /// GGX α, 0…1.
    pub roughness: Option<Number>,
    /// r with α = r².
    pub perceptual_roughness: Option<Number>,
    pub fresnel: Option<FresnelModel>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Dielectric {
    pub ior: Spanned<IndexSource>,
    pub absorption: Option<Spanned<AbsorptionSource>>,
    pub fresnel: Option<FresnelModel>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Diffuse {
    pub reflectance: Spanned<ReflectanceSource>,
}

/// A data set's name or file, or plain numbers.
#[derive(Debug)]
pub enum IndexSource {
    Name(String),
    Constant { n: f64, k: f64 },
}

/// A data set's name or file, or one coefficient for all wavelengths.
#[derive(Debug)]
pub enum AbsorptionSource {
    Name(String),
    /// In m⁻¹, natural base.
    PerMetre(f64),
}

/// A data set's name or file, one value for all wavelengths, or a linear sRGB colour to be upsampled.
#[derive(Debug)]
pub enum ReflectanceSource {
    Name(String),
    Constant(f64),
    Rgb([f64; 3]),
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Object {
    pub name: Option<String>,
    /// Needed unless the object shines: what only shines is black.
    pub material: Option<Spanned<String>>,
    pub shape: Spanned<Shape>,
    #[serde(default)]
    pub transform: Option<Spanned<Transform>>,
    pub emission: Option<Spanned<Emission>>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Shape {
    Sphere(Sphere),
    Rectangle(Rectangle),
    Disk(Disk),
    Box(Cuboid),
    Convex(Convex),
    Brilliant(Brilliant),
    StepCut(StepCut),
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sphere {
    #[serde(default)]
    pub center: [f64; 3],
    pub radius: f64,
}

/// A rectangle in the plane z = 0 around the origin, its front towards +z; placed by the transform or by `center`, `normal`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rectangle {
    #[serde(default)]
    pub center: [f64; 3],
    pub size: [f64; 2],
    #[serde(default = "up")]
    pub normal: [f64; 3],
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Disk {
    #[serde(default)]
    pub center: [f64; 3],
    pub radius: f64,
    #[serde(default = "up")]
    pub normal: [f64; 3],
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cuboid {
    #[serde(default)]
    pub center: [f64; 3],
    pub size: [f64; 3],
}

/// Half-spaces n·x ≤ d as [nx, ny, nz, d]; normals need not be of unit length.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Convex {
    pub planes: Vec<[f64; 4]>,
}

/// A round brilliant with its table towards +z; ratios are of the girdle diameter, angles in degrees.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Brilliant {
    pub diameter: f64,
    pub table: Option<f64>,
    pub crown_angle: Option<f64>,
    pub pavilion_angle: Option<f64>,
    pub girdle: Option<f64>,
    pub star_length: Option<f64>,
    pub lower_half_length: Option<f64>,
    pub culet: Option<f64>,
    pub girdle_facets: Option<u32>,
}

/// An octagonal step ("emerald") cut with its table towards +z; ratios are of the width, angles in degrees.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StepCut {
    pub width: f64,
    pub length: f64,
    pub corner: Option<f64>,
    pub table: Option<f64>,
    /// From girdle to table.
    pub crown_angles: Option<[f64; 3]>,
    /// From girdle to keel.
    pub pavilion_angles: Option<[f64; 3]>,
    pub girdle: Option<f64>,
}

/// Applied in this order: scale, rotation about the axis through the origin, translation.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Transform {
    pub scale: Option<Spanned<Scale>>,
    /// Rotations about x, y and z in degrees, in this order.
    pub rotate: Option<[f64; 3]>,
    pub translate: Option<[f64; 3]>,
}

/// One factor, or one an axis.
#[derive(Debug)]
pub struct Scale(pub [f64; 3]);
