//! A plane-parallel plate that absorbs, against the series of its reflections.
//!
//! R + T²Rτ²/(1 − R²τ²) comes back and T²τ/(1 − R²τ²) goes through, T = 1 − R by Fresnel for light without polarisation and
//! τ = exp(−αd/cos θ_t) (`common::plates`). The sky shines from one side only, so that the two are seen apart. The plate is a
//! `box`, whose light is traced within the solid alone, and a mesh of twelve triangles, whose light asks the scene; of glass
//! of one index, where eight wavelengths go together, and of BK7, where they part.
//!
//! Plates of which nothing comes back show Fresnel's equations with n + ik, whatever they are called and wherever light comes from.

use crate::common::files::{cuboid, obj};
use crate::common::plates::{Plates, check_by, half_sky, pile, seen};
use crate::common::{lanes::with, library, replicates, scene, t_of_pairs};
use glam::DVec3;
use spectrel::fresnel::exact;
use std::path::Path;

const COSINES: [f64; 3] = [1.0, std::f64::consts::FRAC_1_SQRT_2, 0.3];

const ABSORPTION: f64 = 0.7;

/// Shapes of the same plate, its upper side at a half.
fn shapes(folder: &Path) -> [(&'static str, String); 2] {
    let mesh = obj(folder, "slab", &cuboid([0.0; 3], [200.0, 200.0, 1.0]));
    [("box", "shape.box = { size = [200, 200, 1] }".into()), ("mesh", mesh)]
}

fn plate(cos: f64, spectrum: &str, above: bool, ior: &str, shape: &str) -> String {
    format!(
        "{}{}
        materials.m.dielectric = {{ ior = {ior}, absorption = {ABSORPTION} }}
        [[objects]]\nmaterial = \"m\"\n{shape}\n",
        seen(0.5 * DVec3::Z, cos, 160),
        half_sky(spectrum, above)
    )
}

fn paper(n: f64, absorption: f64, cos: f64) -> Plates {
    pile(1.0, &[(n, absorption, 1.0)], 1.0, cos)
}

/// What a plate lets through and throws back at each angle, in the glass that the scene names and whose index is n.
fn compare(name: &str, spectrum: &str, ior: &str, n: f64, lanes: u32) {
    let folder = tempfile::tempdir().expect("a folder");
    for (shape, text) in shapes(folder.path()) {
        for cos in COSINES {
            let name = format!("{name}, {shape}, cos {cos:.1}");
            let light = 100.0 * cos;
            let right = paper(n, ABSORPTION, cos);
            let wrong = [0.99, 1.01].map(|factor| light * paper(n, factor * ABSORPTION, cos).t);
            let mut through = scene(&plate(cos, spectrum, false, ior, &text), &with(lanes, 160));
            check_by(64, &format!("{name}, through"), &mut through, light * right.t, &wrong);
            if lanes == 1 {
                // One wavelength a path makes too much noise for the little that comes back.
                continue;
            }
            // Little of what comes back has been inside: the index tells, and a tenth of the absorption.
            let wrong = [light * paper(1.02 * n, ABSORPTION, cos).r, light * paper(n, 1.2 * ABSORPTION, cos).r];
            let mut back = scene(&plate(cos, spectrum, true, ior, &text), &with(lanes, 160));
            check_by(64, &format!("{name}, back"), &mut back, light * right.r, &wrong);
        }
    }
}

#[test]
fn a_plate_shows_the_series_of_its_reflections() {
    compare("n = 1.5", "\"E\"", "1.5", 1.5, 8);
}

#[test]
fn a_plate_shows_it_to_one_wavelength_alone() {
    compare("one lane", "\"E\"", "1.5", 1.5, 1);
}

#[test]
#[ignore = "long: many seconds of paths"]
fn a_plate_that_disperses_shows_it_at_its_index() {
    let n = library().ior("SCHOTT/n-bk7", Path::new("")).expect("in the library").n.at(589.3);
    assert!((n - 1.5167).abs() < 1e-4, "the catalogue's n_D is 1.51673: {n}");
    compare("BK7", "{ lines = [[589.3, 1]] }", "\"SCHOTT/n-bk7\"", n, 8);
}

/// A thick plate of an index with k, which is in a medium of this index, under light from above.
fn thick(outside: f64, index: &str, cos: f64) -> String {
    format!(
        "{}{}outside = \"around\"
        materials.around.dielectric = {{ ior = {outside} }}
        materials.m.{index}
        [[objects]]\nmaterial = \"m\"\nshape.box = {{ size = [200, 200, 1] }}\n",
        seen(0.5 * DVec3::Z, cos, 160),
        half_sky("\"E\"", true)
    )
}

/// From glass, angles beyond the critical one are among them: less than all is reflected there, and the rest is lost.
#[test]
fn what_absorbs_reflects_by_its_complex_index() {
    for (outside, n, k) in [(1.0, 1.5, 3.0), (1.0, 1.5, 2.0), (1.0, 1.5, 0.5), (1.6, 1.2, 0.1), (1.6, 0.5, 0.8)] {
        for cos in COSINES {
            let name = format!("{n} + {k}i in {outside}, cos {cos:.1}");
            let [right, clear] = [k, 0.0].map(|k| 100.0 * cos * exact::reflect(outside, n, k, cos).r);
            let mut plate =
                scene(&thick(outside, &format!("dielectric.ior = {{ n = {n}, k = {k} }}"), cos), &with(8, 160));
            check_by(64, &name, &mut plate, right, &[clear]);
        }
    }
}

#[test]
fn a_metal_called_a_dielectric_is_that_metal() {
    for roughness in ["", ", roughness = 0.2"] {
        let [gold, glass] = ["conductor", "dielectric"].map(|kind| {
            let plate = thick(1.0, &format!("{kind} = {{ ior = \"Au/olmon-2012-evaporated\"{roughness} }}"), 0.7);
            replicates(&plate, &with(8, 160), 0, 64)
        });
        let difference = t_of_pairs(&gold, &glass);
        assert!(difference < 4.6, "{roughness}: {difference}");
        let [a, b] = [&gold, &glass].map(|xyz| xyz.iter().map(|xyz| xyz[1]).sum::<f64>() / 64.0);
        assert!((a / b - 1.0).abs() < 0.01, "{a} {b}");
    }
}

/// Approximations keep their F0 on what absorbs: head on they are exact.
#[test]
fn approximations_know_what_absorbs_head_on() {
    for model in ["schlick", "f82", "schlick-rgb"] {
        let right = 100.0 * exact::reflect(1.0, 1.5, 2.0, 1.0).r;
        let material = format!("dielectric = {{ ior = {{ n = 1.5, k = 2 }}, fresnel = \"{model}\" }}");
        check_by(64, model, &mut scene(&thick(1.0, &material, 1.0), &with(8, 160)), right, &[4.0]);
    }
}
