//! Absorption as a sum of Gaussian bands: Σ peak · exp(−4 ln 2 ((λ − centre) / fwhm)²).
//!
//! For stones whose band centres are published but whose absorption curve is not.

use serde::Deserialize;

use super::error::Fault;

/// One Gaussian band.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Band {
    /// Centre, nm.
    pub center_nm: f64,
    /// Full width at half maximum, nm.
    pub fwhm_nm: f64,
    /// Value at the centre, in the spectrum's unit.
    pub peak: f64,
    /// Who published the centre.
    #[serde(default)]
    pub source: String,
}

/// A sum of bands.
#[derive(Clone, Debug, PartialEq)]
pub struct Bands(Vec<Band>);

impl Bands {
    pub(super) fn new(bands: Vec<Band>) -> Result<Self, Fault> {
        if bands.is_empty() {
            return Err(Fault::new("no bands, expected at least one"));
        }
        for band in &bands {
            let good = band.center_nm > 0.0 && band.fwhm_nm > 0.0 && band.peak >= 0.0;
            if !(good && (band.center_nm + band.fwhm_nm + band.peak).is_finite()) {
                let Band { center_nm, fwhm_nm, peak, .. } = band;
                let message = format!(
                    "a band with center_nm {center_nm}, fwhm_nm {fwhm_nm}, peak {peak}; expected a positive centre and width and a peak of 0 or more"
                );
                return Err(Fault::new(message));
            }
        }
        Ok(Self(bands))
    }

    pub fn at(&self, nm: f64) -> f64 {
        let four_ln2 = 4.0 * std::f64::consts::LN_2;
        let band = |band: &Band| {
            let x = (nm - band.center_nm) / band.fwhm_nm;
            band.peak * libm::exp(-four_ln2 * x * x)
        };
        self.0.iter().map(band).sum()
    }

    pub fn bands(&self) -> &[Band] {
        &self.0
    }

    /// Points between which a polynomial of low degree follows the bands, nm: every quarter of a width, two widths out.
    pub(super) fn breakpoints_nm(&self) -> impl Iterator<Item = f64> {
        self.0.iter().flat_map(|band| (-8..=8).map(|i| band.center_nm + f64::from(i) * 0.25 * band.fwhm_nm))
    }

    pub(super) fn scaled(&self, factor: f64) -> Self {
        Self(self.0.iter().map(|band| Band { peak: band.peak * factor, ..band.clone() }).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_at_half_width() {
        let band = Band { center_nm: 550.0, fwhm_nm: 80.0, peak: 300.0, source: String::new() };
        let bands = Bands::new(vec![band.clone()]).unwrap();
        assert!((bands.at(550.0) - 300.0).abs() < 1e-12 && (bands.at(590.0) - 150.0).abs() < 1e-9);
        assert!(Bands::new(vec![]).is_err());
        assert!(Bands::new(vec![Band { fwhm_nm: 0.0, ..band.clone() }]).is_err());
        assert!(Bands::new(vec![Band { peak: f64::INFINITY, ..band }]).is_err());
    }
}
