//! The colour of a surface in numbers: F0 tables with the source of every row.
//!
//! - `instrument`: the light, the eye and the RGB space, and what a reflectance looks like by them.
//! - `row`: one data set of a material, measured; `engines`: the same as the parameters of renderers.
//! - `family`: which published data sets describe the same material, and how far apart they are.
//! - `claims`, `check`: a table of someone else's, read, and held against all of them; `likeness`: the metals that look like a colour.
//! - `formats`: the same rows as text for a terminal, Markdown, CSV, JSON, TOML or a page.
//!
//! Reflectances are exact, from vacuum, at every nanometre of 360–830 nm; the sum is that of [`Colorimeter`].
//! Nothing is clipped, but what says so.
//!
//! ```
//! use spectrel::report::f0::{Conditions, Instrument, Subject, Table, formats};
//! use spectrel::spectrum::Library;
//! use std::path::Path;
//!
//! let library = Library::default();
//! let instrument = Instrument::new(Conditions::default(), &library)?;
//! let ior = library.ior("Au/olmon-2012-evaporated", Path::new(""))?;
//! let table = Table::new(&[Subject { name: "gold".into(), conductor: true, ior, why: None }], &instrument);
//! assert!((table.materials[0].f0.linear[0] - 1.0428).abs() < 5e-5);
//! println!("{}", formats::text(&table, formats::Format::Markdown)?);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`Colorimeter`]: crate::spectrum::Colorimeter

pub mod check;
pub mod claims;
mod engines;
mod family;
pub mod formats;
mod instrument;
mod likeness;
mod row;
mod table;

pub use engines::Engines;
pub use family::Families;
pub use instrument::{Color, Conditions, Instrument, Labels, observer_name};
pub use likeness::{Likeness, Likenesses, Nearer};
pub use row::{Provenance, Row, Specular, Subject};
pub use table::{Distance, Spread, Table, Widest};
