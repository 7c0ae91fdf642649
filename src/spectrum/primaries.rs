//! Three reflectances that stand for red, green and blue: every RGB colour becomes a spectrum by their weighted sum.
//!
//! ```text
//! S(λ) = r b_r(λ) + g b_g(λ) + b b_b(λ),   b_r + b_g + b_b = 1,   0 ≤ b ≤ 1,   colour of b_i under D65 = primary i of linear sRGB
//! ```
//!
//! - Source: I. Mallett & C. Yuksel, "Spectral primary decomposition for rendering with sRGB reflectance" (EGSR 2019); the tables are solved
//!   anew by `tools/srgb_primaries.py`. What their rounding leaves is taken out here: the colour of S is (r, g, b) to 1e-12.
//! - Linear, so that sums and products with numbers of colours hold for spectra too, and defined for any colour; one beyond 0…1 gives a
//!   spectrum beyond 0…1. [`Upsampler`] stays within, but is neither linear nor defined for colours above 1.

use std::path::Path;

use super::{Library, Matrix3, Outside, Spectrum, SpectrumError, Table, Upsampler};

/// b_r, b_g and b_b: for the CIE 1931 observer.
pub fn srgb_primaries(library: &Library) -> Result<[Spectrum; 3], SpectrumError> {
    let upsampler = Upsampler::new(library)?;
    let mut tables = Vec::new();
    for name in ["srgb/red", "srgb/green", "srgb/blue"] {
        tables.push(library.reflectance(name, Path::new(""))?.spectrum.clone());
    }
    let colors = Matrix3([0, 1, 2].map(|i| upsampler.rgb(&tables[i])));
    // Were a user's own files of these names no three colours, they would be taken as they are.
    let shares = colors.inverse().unwrap_or(Matrix3::IDENTITY);
    let mut knots: Vec<f64> = tables.iter().flat_map(Spectrum::breakpoints_nm).collect();
    knots.sort_by(f64::total_cmp);
    knots.dedup();
    let at = |row: [f64; 3], nm: f64| (0..3).map(|i| row[i] * tables[i].at(nm)).sum();
    let corrected = |row: [f64; 3]| knots.iter().map(|&nm| (nm, at(row, nm))).collect::<Vec<_>>();
    Ok(shares.0.map(|row| Spectrum::Table(Table::from_points(&corrected(row), Outside::Hold))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn they_are_the_primaries_and_add_up_to_white() {
        let library = Library::default();
        let primaries = srgb_primaries(&library).unwrap();
        let upsampler = Upsampler::new(&library).unwrap();
        for (i, primary) in primaries.iter().enumerate() {
            let rgb = upsampler.rgb(primary);
            let expected = std::array::from_fn(|channel| f64::from(u8::from(channel == i)));
            assert!(rgb.iter().zip::<[f64; 3]>(expected).all(|(a, b)| (a - b).abs() < 1e-12), "{i}: {rgb:?}");
        }
        for nm in (360..=830).map(f64::from) {
            let values = [0, 1, 2].map(|i| primaries[i].at(nm));
            assert!((values.iter().sum::<f64>() - 1.0).abs() < 1e-6, "{nm}: {values:?}");
            assert!(values.iter().all(|value| (-1e-5..=1.0 + 1e-5).contains(value)), "{nm}: {values:?}");
        }
    }
}
