//! Colours of others against all data sets of the library.

use super::F0Args;
use super::subjects::{families, of_library};
use crate::cli::tables;
use crate::report::f0::check::{Checked, Claim, Known, judge};
use crate::report::f0::claims;
use crate::report::f0::{Instrument, Likenesses};
use crate::scene::{Class, Optics, SceneError, optics};
use crate::spectrum::{Library, RgbSpace, encode_srgb, srgb_from_hex};
use std::path::Path;

/// Every material with F0 of all its data sets.
fn known(args: &F0Args, library: &Library, instrument: &Instrument) -> Result<Vec<(Known, Class)>, SceneError> {
    let mut materials = of_library(library)?;
    let families = families(library, instrument)?;
    args.data.replace(&mut materials, library)?;
    let known = |optics: Optics| {
        let own = &optics.ior.about.name;
        let candidate = |set: String| {
            let ior = if set == *own { optics.ior.clone() } else { library.ior(&set, Path::new(""))? };
            Ok((set, instrument.f0(&ior)))
        };
        let candidates = families.of(own).into_iter().map(candidate).collect::<Result<_, SceneError>>()?;
        Ok((Known { name: optics.name, candidates }, optics.class))
    };
    materials.into_iter().map(known).collect()
}

/// A table of others, row by row.
pub fn checked(file: &Path, args: &F0Args, library: &Library, instrument: &Instrument) -> Result<Checked, SceneError> {
    let text = tables::contents(file)?;
    let claims = claims::read(&text).map_err(|error| tables::wrong(file, error, "material,r,g,b"))?;
    let known = known(args, library, instrument)?;
    let verdict = |claim: Claim| {
        let own = meant(&claim.material, library).and_then(|optics| {
            let same = known.iter().map(|(known, _)| known).find(|known| known.name == optics.name);
            same.ok_or_else(|| format!("`{}` is a data set, not a material", optics.name))
        });
        judge(claim, own, instrument)
    };
    Ok(Checked::new(claims.into_iter().map(verdict).collect(), instrument))
}

/// A material as others write it: `Stainless Steel`, `stainless_steel`.
fn meant(name: &str, library: &Library) -> Result<Optics, String> {
    let dashed = || optics(&name.replace([' ', '_'], "-"), None, library);
    optics(name, None, library).or_else(|error| dashed().map_err(|_| error)).map_err(|error| error.to_string())
}

/// How many metals --match names.
const LIKENESSES: usize = 5;

/// The metals nearest to a colour.
pub fn likenesses(
    color: &str,
    args: &F0Args,
    library: &Library,
    instrument: &Instrument,
) -> Result<Likenesses, SceneError> {
    let linear = color_of(color, args.space).map_err(|error| SceneError::new(format!("--match {color}: {error}")))?;
    let known = known(args, library, instrument)?;
    let metals: Vec<_> =
        known.into_iter().filter(|(_, class)| *class == Class::Conductor).map(|(metal, _)| metal).collect();
    Ok(Likenesses::new(linear, &metals, LIKENESSES, instrument))
}

/// Linear RGB of `#rrggbb`, encoded in the space, or of three linear numbers.
fn color_of(text: &str, space: RgbSpace) -> Result<[f64; 3], &'static str> {
    if let Some(rgb) = srgb_from_hex(text) {
        return Ok(rgb.map(|linear| space.decode(encode_srgb(linear))));
    }
    let numbers = text.split(',').map(|number| number.trim().parse().ok()).collect::<Option<Vec<f64>>>();
    match numbers.as_deref() {
        Some(&[r, g, b]) if [r, g, b].iter().all(|value| (0.0..=2.0).contains(value)) => Ok([r, g, b]),
        Some(&[_, _, _]) => Err("a reflectance is about 0…1"),
        _ => Err("expected #rrggbb or three linear numbers such as 1.0,0.78,0.34"),
    }
}
