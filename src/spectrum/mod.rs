//! Functions of wavelength: what they are, where their data come from, and what an eye makes of them.
//!
//! - `curve`: [`Spectrum`], the closed set of functions; `table`, `formula`, `emission`, `bands`, `sigmoid` are its kinds.
//! - `library`: [`Library`], data sets and materials by name, built in or from a user's folders; `toml_file`,
//!   `rii_page`, `table_file`, `agf_file`, `cgats_file`, `spdx_file` read the formats; `about` is the provenance that comes along. Text of columns passes
//!   through `words`, `rows`, `wave_unit` and `columns`; `absorbing` knows what states an absorption, `noise` what is passed over.
//! - `integrate`: exact integrals of products of spectra; `observer`: the CIE observers.
//! - `density`: how densely wavelengths are chosen; `nodes`: those that the renderer uses, and how they sample an integral.
//! - `arena`: the spectra of a scene and their tables; `wavelengths`: those of a path, by which it reads them; `bins`: intervals of wavelength for spectral pictures.
//! - `colorimeter`: from a reflectance to RGB, as tables are made.
//! - `color`, `spaces`, `delta_e`, `upsample`: from XYZ to RGB, to a colour difference, and from RGB to a reflectance;
//!   `upsample_table` does it for the texels of pictures, `tint` is what it makes of one; `primaries` does it linearly.
//!
//! Wavelengths are vacuum wavelengths in nm; what reaches a picture uses `libm`, so that every machine agrees.

mod about;
mod absorbing;
mod agf_file;
mod arena;
mod bands;
mod bins;
mod cgats_file;
mod color;
mod colorimeter;
mod columns;
mod curve;
mod delta_e;
mod density;
mod emission;
mod error;
mod format;
mod formula;
mod integrate;
mod library;
mod nodes;
mod noise;
mod observer;
mod primaries;
mod rii_page;
mod rows;
mod sigmoid;
mod spaces;
mod spdx_file;
mod table;
mod table_file;
mod tint;
mod toml_file;
mod upsample;
mod upsample_table;
mod wave_unit;
mod wavelengths;
mod words;

pub use about::{About, Confidence, Dataset, Ior, Quantity, Sample, Source, citation};
pub use arena::{Arena, SpectrumId, Tables};
pub use bands::{Band, Bands};
pub use bins::{BinShares, Bins};
pub use color::{Matrix3, Xyz, bradford, lab_from_xyz, xyz_from_lab, xyz_from_xy};
pub use colorimeter::{Adaptation, Colorimeter};
pub use curve::Spectrum;
pub use delta_e::{ciede2000, ciede2000_metric};
pub use density::Density;
pub use emission::{Daylight, Line, planck};
pub use error::{SpectrumError, nearest};
pub use formula::{Formula, FormulaType};
pub use integrate::{integrate, luminance, radiance_xyz, tristimulus, tristimulus_1nm, white_xyz, white_xyz_1nm};
pub use library::{Library, MaterialText};
pub use nodes::{NODE_COUNT, Nodes};
pub use observer::{ColorMatching, Observer};
pub use primaries::srgb_primaries;
pub use sigmoid::Sigmoid;
pub use spaces::{Chromaticities, RgbSpace, decode_srgb, encode_srgb, hex_from_srgb, srgb_from_hex};
pub use table::{Outside, Table};
pub use tint::Tint;
pub use upsample::Upsampler;
pub use upsample_table::UpsampleTable;
pub use wavelengths::Wavelengths;

/// First and last wavelength that integrals, observers and the renderer use, nm.
pub const LAMBDA_MIN_NM: f64 = 360.0;
pub const LAMBDA_MAX_NM: f64 = 830.0;

/// Every nanometre at which light is computed.
pub fn visible_nm() -> impl Iterator<Item = f64> {
    (LAMBDA_MIN_NM as u32..=LAMBDA_MAX_NM as u32).map(f64::from)
}

/// The yellow helium line d, nm, at which catalogues print n_d (ISO 7944).
pub const HELIUM_D_NM: f64 = 587.56;

/// Luminous efficacy, lm/W: luminance in cd/m² is this times ∫ L ȳ dλ.
pub const LUMENS_PER_WATT: f64 = 683.0;
