//! Spectral pictures in OpenEXR: bands of wavelength as channels.
//!
//! The layout of A. Fichet, R. Pacanowski & A. Wilkie, "An OpenEXR Layout for Spectral Images", Journal of Computer Graphics
//! Techniques 10(3), 2021, with its published code as the arbiter of details:
//!
//! - one channel a band, `S0.550,000000nm`: the unpolarised part of emitted light, the centre of the band with a comma for
//!   the decimal point (a dot would begin another layer), six decimals;
//! - `spectralLayoutVersion` = "1.0"; `emissiveUnits` = "W.m^-2.sr^-1", the one value the layout knows and its readers accept. Our
//!   values are per nanometre, the mean spectral radiance over the band, as those readers take them when they integrate;
//!   `spectrel:spectral-unit` and `spectrel:bands` say so in full;
//! - R, G, B of the developed picture beside them, as the layout recommends, for viewers that know no spectra.
//!
//! Bands always have 32 bits: radiances of ordinary pictures are about 1e-4, where 16 bits have three digits at best.
//! tev and Nuke show such a file; Blender gives up on a layer of 24 channels, so that it opens files of at most 23 bands.

use super::{Channel, Extra, Metadata};
use crate::film::Layers;
use crate::spectrum::Bins;

/// Ending of the names of files that are to hold bands.
pub const ENDING: &str = ".spectral.exr";

/// The channels and attributes of a film with bands.
pub fn extra(layers: &Layers, bins: &Bins) -> Extra {
    let band = |i| Channel::new(name(bins.center_nm(i)), layers.band(i).map(|radiance| radiance as f32).collect());
    Extra {
        channels: (0..bins.count()).map(band).collect(),
        attributes: vec![("spectralLayoutVersion", "1.0".into()), ("emissiveUnits", "W.m^-2.sr^-1".into())],
    }
}

/// What the layout has no attribute for.
pub fn describe(metadata: &Metadata, bins: &Bins) -> Metadata {
    let (first, last) = (bins.center_nm(0), bins.center_nm(bins.count() - 1));
    metadata
        .clone()
        .with("bands", format!("{first}:{}:{last} nm", bins.step_nm()))
        .with("spectral-unit", "W.m^-2.sr^-1.nm^-1, mean over each band")
}

fn name(center_nm: f64) -> String {
    format!("S0.{}nm", format!("{center_nm:.6}").replace('.', ","))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_the_layout() {
        assert_eq!(name(400.0), "S0.400,000000nm");
        assert_eq!(name(532.25), "S0.532,250000nm");
    }
}
