//! A light, an eye and an RGB space: what a reflectance looks like.

use crate::fresnel::f0;
use crate::spectrum::{
    Adaptation, Colorimeter, Ior, Library, Observer, RgbSpace, SpectrumError, Xyz, ciede2000, hex_from_srgb,
};
use serde::Serialize;
use std::path::Path;

/// How colours are to be told.
#[derive(Clone, Debug, PartialEq)]
pub struct Conditions {
    /// The name of a light of the library.
    pub illuminant: String,
    pub observer: Observer,
    pub space: RgbSpace,
    pub adaptation: Adaptation,
}

impl Default for Conditions {
    /// The convention of colour tables: D65, CIE 1931, sRGB, Bradford.
    fn default() -> Self {
        let illuminant = "D65".to_owned();
        Self {
            illuminant,
            observer: Observer::default(),
            space: RgbSpace::default(),
            adaptation: Adaptation::default(),
        }
    }
}

/// The conditions in words, as tables state them.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Labels {
    pub illuminant: String,
    pub observer: &'static str,
    pub space: &'static str,
    pub adapt: &'static str,
}

impl Conditions {
    pub fn labels(&self) -> Labels {
        Labels {
            illuminant: self.illuminant.clone(),
            observer: observer_name(self.observer),
            space: self.space.name(),
            adapt: self.adaptation.name(),
        }
    }
}

impl Labels {
    /// In one line.
    pub fn sentence(&self) -> String {
        let Self { illuminant, observer, space, adapt } = self;
        let adapted = if *adapt == "none" { "not adapted".to_owned() } else { format!("{adapt} adaptation") };
        format!("Illuminant {illuminant}, observer CIE {observer}, {space}, {adapted}, from vacuum")
    }
}

/// An observer's name without its publisher.
pub fn observer_name(observer: Observer) -> &'static str {
    observer.name().trim_start_matches("cie-")
}

/// A colour in the space of an instrument.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Color {
    /// Linear RGB, not clipped.
    pub linear: [f64; 3],
    /// The same by the transfer curve of the space; ACEScg is linear and has none.
    pub encoded: [f64; 3],
    /// `#rrggbb`, clipped; `None` where the space is not that of 8-bit displays.
    pub hex: Option<String>,
    /// Whether every channel is within 0…1.
    pub in_gamut: bool,
}

/// The conditions with their data.
pub struct Instrument {
    pub conditions: Conditions,
    meter: Colorimeter,
    /// Whose Y is that of the light itself.
    unadapted: Colorimeter,
}

impl Instrument {
    /// Fails if the library has no such light, or the eye sees none of it.
    pub fn new(conditions: Conditions, library: &Library) -> Result<Self, SpectrumError> {
        let observer = library.observer(conditions.observer)?;
        let light = library.illuminant(&conditions.illuminant, Path::new(""))?;
        let meter = Colorimeter::new(&light.spectrum, &observer, conditions.space, conditions.adaptation)?;
        let unadapted = Colorimeter::new(&light.spectrum, &observer, RgbSpace::Srgb, Adaptation::None)?;
        Ok(Self { conditions, meter, unadapted })
    }

    /// The wavelengths that count, nm.
    pub fn wavelengths_nm(&self) -> impl Iterator<Item = f64> {
        self.meter.wavelengths_nm()
    }

    /// Linear RGB of reflectances, one for each wavelength.
    pub fn rgb(&self, reflectances: impl IntoIterator<Item = f64>) -> [f64; 3] {
        let mut reflectances = reflectances.into_iter();
        self.meter.rgb(|_| reflectances.next().unwrap_or(0.0))
    }

    /// Linear RGB of a material at normal incidence in vacuum.
    pub fn f0(&self, ior: &Ior) -> [f64; 3] {
        self.meter.rgb(|nm| {
            let (n, k) = ior.at(nm);
            f0(1.0, n, k)
        })
    }

    /// Luminous reflectance Y of reflectances, one for each wavelength: that of a perfect reflector is 1.
    pub fn luminance(&self, reflectances: impl IntoIterator<Item = f64>) -> f64 {
        let mut reflectances = reflectances.into_iter();
        self.xyz(|_| reflectances.next().unwrap_or(0.0))[1]
    }

    /// XYZ under the light itself.
    fn xyz(&self, reflectance: impl FnMut(f64) -> f64) -> Xyz {
        RgbSpace::Srgb.xyz_from_rgb().apply(self.unadapted.rgb(reflectance))
    }

    /// Linear RGB in its other forms.
    pub fn color(&self, linear: [f64; 3]) -> Color {
        let space = self.conditions.space;
        Color {
            linear,
            encoded: linear.map(|value| space.encode(value)),
            hex: matches!(space, RgbSpace::Srgb | RgbSpace::DisplayP3).then(|| hex_from_srgb(linear)),
            in_gamut: linear.iter().all(|value| (0.0..=1.0).contains(value)),
        }
    }

    /// CIEDE2000 of two colours in linear RGB.
    pub fn difference(&self, a: [f64; 3], b: [f64; 3]) -> f64 {
        ciede2000(self.meter.lab(a), self.meter.lab(b))
    }

    /// How much of what the eye sees of the light lies outside a range of wavelengths in nm, 0…1.
    pub fn share_outside(&self, range_nm: Option<(f64, f64)>) -> f64 {
        let Some((first, last)) = range_nm else { return 0.0 };
        let sum = |xyz: Xyz| xyz.iter().sum::<f64>();
        let outside = |nm: f64| f64::from(u8::from(!(first..=last).contains(&nm)));
        sum(self.xyz(outside)) / sum(self.xyz(|_| 1.0))
    }
}
