//! Renders against answers worked out on paper: a comparison must hold by the spread of 16 independent renders, and must not
//! hold for an answer one per cent off.

use super::{replicates, z_against};
use spectrel::scene::Overrides;

/// |z| beyond which a mean is wrong: 15 degrees of freedom, one failure in ten thousand.
const CRITICAL: f64 = 5.2;

/// Renders without noise to speak of may be off by rounding.
const ROUNDING: f64 = 2e-5;

/// A small picture of a scene in metres.
pub const HEAD: &str = "meters_per_unit = 1\nrender = { width = 8, height = 8, filter = \"box\" }\n";

pub fn agrees(renders: &[[f64; 3]], expected: f64) -> bool {
    let luminances: Vec<[f64; 3]> = renders.iter().map(|xyz| [xyz[1]; 3]).collect();
    let mean = luminances.iter().map(|y| y[0]).sum::<f64>() / luminances.len() as f64;
    (mean - expected).abs() < ROUNDING * expected || z_against(&luminances, [expected; 3]) < CRITICAL
}

/// The luminance of a scene, cd/m², must be the expected one and no other.
pub fn check(name: &str, scene: &str, samples: u32, lanes: u32, expected: f64) {
    let overrides = Overrides { samples: Some(samples), lanes: Some(lanes), ..Overrides::default() };
    let renders = replicates(scene, &overrides, 0, 16);
    let mean = renders.iter().map(|xyz| xyz[1]).sum::<f64>() / 16.0;
    println!("{name}: {mean:.6}, expected {expected:.6}");
    assert!(agrees(&renders, expected), "{name}: {mean} against {expected}");
    assert!(!agrees(&renders, 1.01 * expected), "{name}: one per cent more is not told apart");
}
