//! The Fresnel models side by side, on interfaces that the caller names.
//!
//! - `curve`: reflectance of a model against angle and wavelength; `curve_plot`: its figure.
//! - `errors`: how far a model is from the exact equations, in reflectance and in colour.
//! - `text`: tables of both.

pub mod curve;
pub mod curve_plot;
pub mod errors;
pub mod text;

use crate::fresnel::absorbing::LEAST_K;
use crate::fresnel::{Fitted, FresnelModel, Ready, Specimen, Target};
use crate::math::{LANES, Lanes};
use crate::spectrum::{Colorimeter, Ior, Spectrum, visible_nm};

/// An interface that is asked about.
#[derive(Clone, Debug)]
pub struct Subject<'a> {
    /// What people call the material inside.
    pub name: String,
    /// The data set that its index comes from.
    pub data: String,
    pub specimen: Specimen<'a>,
    /// Whether what enters goes on; if not, the material is a conductor.
    pub clear: bool,
}

/// Wavelengths of a path, nm.
const WAVELENGTHS: [f64; LANES] = [415.0, 455.0, 495.0, 535.0, 575.0, 615.0, 655.0, 695.0];

impl<'a> Subject<'a> {
    /// A material seen from vacuum. The k of a clear one is not looked at, as rendering does not, unless it is large enough to show in what is
    /// reflected: then it is seen as a metal is.
    pub fn new(name: String, ior: &'a Ior, clear: bool) -> Self {
        let seen = Specimen::in_vacuum(ior);
        let clear = clear && visible_nm().all(|nm| ior.k.at(nm) <= LEAST_K);
        let specimen = if clear { Specimen::clear(seen.n1, seen.n2) } else { seen };
        Self { name, data: ior.about.name.clone(), specimen, clear }
    }

    /// The same, seen from a medium of this index.
    pub fn in_medium(self, n1: &'a Spectrum) -> Self {
        Self { specimen: Specimen { n1, ..self.specimen }, ..self }
    }

    /// The same interface of clear media, for light that comes from the inside.
    pub fn from_inside(self) -> Self {
        let Specimen { n1, n2, k2 } = self.specimen;
        Self { specimen: Specimen { n1: n2, n2: n1, k2 }, ..self }
    }

    /// A model at the wavelengths of a path, to be timed; RGB models are spread over them by primaries that are flat.
    pub fn ready(&self, model: FresnelModel, meter: &Colorimeter) -> Ready<LANES> {
        let fitted = Fitted::new(model, &Target::new(self.specimen, meter));
        Ready::new(fitted, &self.specimen, &WAVELENGTHS, [0.2, 0.5, 0.3].map(Lanes::splat), self.clear)
    }

    /// Whether light comes from the denser of two clear media, by n at 550 nm.
    fn seen_from_the_denser_side(&self) -> bool {
        let [n1, n2, _] = self.specimen.indices(550.0);
        self.clear && n1 > n2
    }
}

/// Why a model has nothing to say.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Unfit {
    #[error("the Fresnel model `{model}` does not apply to `{name}`: it is for dielectrics, and this is a conductor")]
    Conductor { model: FresnelModel, name: String },
    #[error(
        "the RGB model `{model}` does not apply to `{name}` from its denser side: its curve is that of the rarer one"
    )]
    DenserSide { model: FresnelModel, name: String },
    #[error("the Fresnel model `{model}` knows red, green and blue and no wavelengths")]
    NoWavelengths { model: FresnelModel },
}

/// Whether a model has something to say of an interface, at wavelengths or as a colour.
pub fn check(model: FresnelModel, subject: &Subject, wavelengths: bool) -> Result<(), Unfit> {
    let rgb = matches!(model, FresnelModel::Rgb(_));
    let name = || subject.name.clone();
    match () {
        () if model.dielectrics_only() && !subject.clear => Err(Unfit::Conductor { model, name: name() }),
        () if rgb && wavelengths => Err(Unfit::NoWavelengths { model }),
        () if rgb && subject.seen_from_the_denser_side() => Err(Unfit::DenserSide { model, name: name() }),
        () => Ok(()),
    }
}
