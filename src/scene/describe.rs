//! What a scene file says, before any name is looked up: serde structures with the place of every value that can be wrong.
//!
//! Kinds are externally tagged (`shape.sphere = { … }`, `[conductor]`), so that an error points at the exact place; untagged
//! and flattened structures lose it.

pub use super::lamps::{LightSpectrum, OwnLight, OwnTable};
use super::materials::Material;
pub use super::numbers::Number;
use super::numbers::{Finite, Length, Lengths, Numbers};
pub use super::pictures::{ColorSpaceName, EnvironmentImage, ImageTexture, TextureSpaceName};
use crate::fresnel::FresnelModel;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use toml::Spanned;

pub type Vector = Spanned<Numbers<3>>;

/// Keys of a scene that stand above its first table: below one they would belong to that.
pub const TOP_KEYS: [&str; 2] = ["meters_per_unit", "outside"];

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
    pub points: Vec<Spanned<PointLight>>,
    #[serde(default)]
    pub suns: Vec<Spanned<SunLight>>,
    #[serde(default)]
    pub materials: BTreeMap<String, Spanned<Material>>,
    /// Materials that mesh files name, by the scene's own: `"Ring" = "gold"`.
    #[serde(default)]
    pub replace: BTreeMap<Spanned<String>, Spanned<String>>,
    #[serde(default)]
    pub objects: Vec<Spanned<Object>>,
}

/// How to render: everything here but `max_depth`, `filter` and `sampler` can be overridden on the command line.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Render {
    /// Pixels; 960 unless given.
    pub width: Option<Spanned<u32>>,
    /// Pixels; 640 unless given.
    pub height: Option<Spanned<u32>>,
    /// Samples a pixel; 128 unless given.
    pub samples: Option<Spanned<u32>>,
    /// Another seed gives another noise; 0 unless given.
    pub seed: Option<u64>,
    /// The longest path in surface interactions; no bound but roulette unless given.
    pub max_depth: Option<Spanned<u32>>,
    #[serde(default)]
    pub filter: FilterName,
    #[serde(default)]
    pub sampler: SamplerName,
    /// A Fresnel model for the whole render; it wins over those of the materials.
    pub fresnel: Option<FresnelModel>,
}

/// How samples spread around a pixel's centre.
#[derive(Clone, Copy, Debug, Default, Deserialize, Serialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub enum FilterName {
    /// Evenly over the pixel.
    Box,
    /// Less and less up to the centres of the next pixels; unless given. A small light is as bright wherever in a pixel it stands.
    #[default]
    Tent,
    /// By a Blackman–Harris window of 1.5 pixels around it: as sharp, with less of what is much finer than a pixel; a light smaller than
    /// a pixel is up to 3 % brighter or darker by its place along each axis.
    BlackmanHarris,
}

/// Where random numbers come from: scrambled points in the manner of Sobol that neighbouring pixels share, or independent ones for statistics.
#[derive(Clone, Copy, Debug, Default, Deserialize, Serialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub enum SamplerName {
    /// Less noise for the same time; unless given.
    #[default]
    Sobol,
    /// Samples that know nothing of each other.
    Independent,
}

/// Where the picture is seen from: `position` and `look_at`, or a camera of a glTF file. How wide the camera sees is said by one of
/// `fov`, `focal_length_mm` and `orthographic_width`, or by the file's camera.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Camera {
    /// A glTF file whose camera this is, in metres and with y up, whatever `unit` and `up` a mesh of
    /// the same file is given; other keys win over what it says.
    pub file: Option<Spanned<String>>,
    /// The name of the file's camera; its first one unless given.
    pub named: Option<Spanned<String>>,
    /// Where the camera stands. Its rays begin in the clear solid that is there; of parallel rays,
    /// and of those through an opening, each in the one at its own origin. It must not stand inside
    /// something opaque; where only a part of its rays begins there, that part is black.
    pub position: Option<Vector>,
    /// The point in the middle of the picture.
    pub look_at: Option<Vector>,
    /// What is up in the picture; +z, or as the file says, unless given.
    pub up: Option<Vector>,
    /// Horizontal field of view in degrees.
    pub fov: Option<Number>,
    /// Of a lens in front of a sensor of `sensor_width_mm`.
    pub focal_length_mm: Option<Number>,
    /// Width of the sensor behind `focal_length_mm`; 36 unless given.
    pub sensor_width_mm: Option<Number>,
    /// Parallel rays instead: the width of the picture in scene units.
    pub orthographic_width: Option<Number>,
    /// Opens the aperture to `focal_length_mm` over this; everything is in focus unless given. Needs `meters_per_unit`.
    pub f_number: Option<Number>,
    /// From the camera to what is sharp, scene units along the view; the distance of `look_at` unless given.
    pub focus_distance: Option<Number>,
    /// Corners of the aperture; 0, round, unless given.
    pub blades: Option<Spanned<u32>>,
}

fn up() -> Numbers<3> {
    Numbers::new([0.0, 0.0, 1.0])
}

/// How the film is developed.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Picture {
    /// Display white is 2^EV cd/m²; `"auto"` unless given.
    pub exposure: Option<Spanned<ExposureValue>>,
    /// What becomes white: `"scene"` (the strongest light's own spectrum) or an illuminant's name; D65 unless given.
    pub white_balance: Option<Spanned<String>>,
    #[serde(default)]
    pub gamut: GamutName,
    #[serde(default)]
    pub observer: ObserverName,
}

/// What a PNG shows of colours that no display can: each channel cut, or the hue kept and the colour made paler.
#[derive(Clone, Copy, Debug, Default, Deserialize, Serialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub enum GamutName {
    /// Each channel for itself, which shifts hues; unless given.
    #[default]
    Clip,
    /// Towards grey of equal luminance.
    PreserveChroma,
}

/// Whose eye the film sees with.
#[derive(Clone, Copy, Debug, Default, Deserialize, Serialize, PartialEq, Eq)]
pub enum ObserverName {
    /// The standard 2° observer; unless given.
    #[default]
    #[serde(rename = "cie-1931-2")]
    Cie1931,
    /// The 10° observer, for large fields.
    #[serde(rename = "cie-1964-10")]
    Cie1964,
    /// The 2° observer from cone fundamentals.
    #[serde(rename = "cie-2015-2")]
    Cie2015,
}

/// `"auto"` or an exposure value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ExposureValue {
    Auto,
    Ev(f64),
}

/// What shines from infinitely far away, all around.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "kebab-case", remote = "Self")]
pub enum Environment {
    Constant(Emission),
    Gradient(Box<Gradient>),
    Image(Box<EnvironmentImage>),
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

/// A disk infinitely far away: the sun, or the moon. It has a size, so that mirrors show it.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SunLight {
    /// Where it stands, seen from the scene.
    pub direction: Vector,
    /// Its diameter in degrees; 0.533, the sun's, unless given.
    pub angle: Option<Number>,
    pub spectrum: Spanned<LightSpectrum>,
    /// lx on a surface that faces it.
    pub illuminance: Option<Number>,
    /// W m⁻² over 360–830 nm on a surface that faces it.
    pub irradiance: Option<Number>,
}

/// A light without size at a point, with one of `luminous_intensity` and `luminous_flux`. Smooth mirrors and glass do not show it, and
/// nothing is lit by it through glass: a small sphere that shines is seen everywhere. Needs `meters_per_unit`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PointLight {
    pub position: Vector,
    pub spectrum: Spanned<LightSpectrum>,
    /// cd, in the middle of the cone.
    pub luminous_intensity: Option<Number>,
    /// lm, in all directions together.
    pub luminous_flux: Option<Number>,
    /// Whereto its cone opens; it shines in all directions unless given.
    pub direction: Option<Vector>,
    /// From edge to edge, degrees.
    pub cone_angle: Option<Number>,
    /// How far inside of its edge the cone begins to fade, degrees; 0, a sharp edge, unless given.
    pub fade: Option<Number>,
}

/// A spectrum with a strength: one of `luminance`, `radiance` and `scale`. It is the radiance in the medium that the light
/// stands in; seen from outside of glass of index n it is n² times less.
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

/// A shape at a place, of a material, with or without light of its own.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Object {
    /// For people; "object 7" unless given.
    pub name: Option<String>,
    /// Needed unless the object shines (what only shines is black) or a mesh file names its materials.
    pub material: Option<Spanned<String>>,
    pub shape: Spanned<Shape>,
    pub transform: Option<Spanned<Transform>>,
    /// Where the object stands instead, each place after `transform`: many equal things cost little more than one.
    #[serde(default)]
    pub copies: Vec<Spanned<Transform>>,
    pub emission: Option<Spanned<Emission>>,
    /// Where dielectric solids overlap, the one with the highest number fills the space; among equals, the smaller one; 0 unless
    /// given.
    #[serde(default)]
    pub priority: i32,
}

/// One kind of shape; lengths in scene units.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "kebab-case", remote = "Self")]
pub enum Shape {
    Sphere(Sphere),
    Rectangle(Rectangle),
    Disk(Disk),
    Box(Cuboid),
    Convex(Convex),
    Brilliant(Brilliant),
    StepCut(StepCut),
    Mesh(MeshFile),
}

/// A ball.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sphere {
    #[serde(default)]
    pub center: Numbers<3>,
    pub radius: Length,
}

/// A rectangle around `center`, its front towards `normal` (+z unless given), its width level.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rectangle {
    #[serde(default)]
    pub center: Numbers<3>,
    pub size: Lengths<2>,
    #[serde(default = "up")]
    pub normal: Numbers<3>,
}

/// A disk around `center`, its front towards `normal` (+z unless given).
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Disk {
    #[serde(default)]
    pub center: Numbers<3>,
    pub radius: Length,
    #[serde(default = "up")]
    pub normal: Numbers<3>,
}

/// A box with its edges along the axes.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cuboid {
    #[serde(default)]
    pub center: Numbers<3>,
    pub size: Lengths<3>,
}

/// Half-spaces n·x ≤ d as [nx, ny, nz, d]; normals need not be of unit length.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Convex {
    pub planes: Vec<Spanned<Numbers<4>>>,
}

/// A round brilliant, its culet at the origin and its table towards +z; ratios are of the girdle diameter, angles in degrees.
/// What is not given is within the best grade of the trade.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Brilliant {
    pub diameter: Length,
    /// Table width from corner to opposite corner.
    pub table: Option<Finite>,
    pub crown_angle: Option<Finite>,
    pub pavilion_angle: Option<Finite>,
    /// Thickness where bezels and mains meet it.
    pub girdle: Option<Finite>,
    /// How far stars reach from table edge to girdle, in plan, 0…1.
    pub star_length: Option<Finite>,
    /// How far lower halves reach from girdle to centre, in plan, 0…1.
    pub lower_half_length: Option<Finite>,
    /// Width of the culet; 0 is a point.
    pub culet: Option<Finite>,
    /// A multiple of 16.
    pub girdle_facets: Option<u32>,
}

/// An octagonal step ("emerald") cut, its keel on z = 0 along x and its table towards +z; ratios are of the width, angles in
/// degrees.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StepCut {
    pub width: Length,
    /// At least the width.
    pub length: Length,
    /// How much of the width each cut corner takes from a side.
    pub corner: Option<Finite>,
    pub table: Option<Finite>,
    /// From girdle to table.
    pub crown_angles: Option<Numbers<3>>,
    /// From girdle to keel.
    pub pavilion_angles: Option<Numbers<3>>,
    /// Thickness.
    pub girdle: Option<Finite>,
}

/// Triangles from an OBJ, PLY, STL or glTF file. If they are closed, they are a solid. Without a material of the object each part
/// has the one that `[replace]` gives for its material in the file, or else the one that the file names. Parts of one clear
/// material that have open edges in common are one body, and so are clear and opaque parts that close it together: the opaque ones
/// lie on it. Of clear bodies faces that are there twice are dropped, windings are made to agree and hairline gaps are closed, each
/// with a warning. A glTF file is in metres: where the scene states `meters_per_unit`, its lengths, cameras included, become the
/// scene's units. Lengths of the other formats are scene units unless `unit` is given.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MeshFile {
    /// Next to the scene file unless absolute.
    pub file: Spanned<String>,
    /// Only the parts, or placements, of this name; all of the file unless given.
    pub part: Option<Spanned<String>>,
    /// Smooths edges that bend by less than this, in degrees: 0 shows every triangle flat. The file's own normals unless given.
    pub crease_angle: Option<Number>,
    /// The unit of the file's lengths; a glTF file's is the metre, another's the scene's unless given. Needs `meters_per_unit`.
    pub unit: Option<Spanned<UnitName>>,
    /// The axis that is up in the file and becomes the scene's z, as (x, −z, y) of its (x, y, z); `"y"` for glTF and `"z"` for the others
    /// unless given.
    pub up: Option<UpName>,
    /// The widest gap between open edges of a clear body that is closed, if that closes the body, as a share of its size; 1e-4
    /// unless given, 0 leaves gaps.
    pub weld: Option<Number>,
}

/// A unit of length.
#[derive(Clone, Copy, Debug, Deserialize, Serialize, PartialEq, Eq)]
pub enum UnitName {
    /// Metre.
    #[serde(rename = "m")]
    Metre,
    /// Centimetre.
    #[serde(rename = "cm")]
    Centimetre,
    /// Millimetre.
    #[serde(rename = "mm")]
    Millimetre,
    /// Micrometre.
    #[serde(rename = "um")]
    Micrometre,
    /// Inch, 25.4 mm.
    #[serde(rename = "in")]
    Inch,
    /// Foot, 304.8 mm.
    #[serde(rename = "ft")]
    Foot,
}

impl UnitName {
    pub fn metres(self) -> f64 {
        match self {
            Self::Metre => 1.0,
            Self::Centimetre => 0.01,
            Self::Millimetre => 1e-3,
            Self::Micrometre => 1e-6,
            Self::Inch => 0.0254,
            Self::Foot => 0.3048,
        }
    }
}

/// An axis that is up.
#[derive(Clone, Copy, Debug, Deserialize, Serialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub enum UpName {
    /// As in glTF, and in OBJ files of many modelling programs.
    Y,
    /// As in the scene.
    Z,
}

/// Moves an object; applied in this order: scale, rotation about the origin, translation.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Transform {
    pub scale: Option<Spanned<Scale>>,
    /// Rotations about x, y and z in degrees, in this order.
    pub rotate: Option<Numbers<3>>,
    pub translate: Option<Numbers<3>>,
}

/// One factor, or one an axis.
#[derive(Debug)]
pub struct Scale(pub Numbers<3>);
