//! Rooms that keep nearly all light, against answers worked out apart from the renderer.
//!
//! Where walls shine alike all around and reflect ρ, light is e/(1 − ρ) everywhere: e, and ρ of the same again. Between smooth metal walls it
//! is e (1 + R₁ + R₁R₂ + …) along one line of sight, whose reflections are followed here in double precision. A mean must be right by the
//! spread of independent renders, and the error that each render tells of itself must be the one it has.

use crate::common::compare::renders;
use crate::common::{film, mean, mean_and_error, scene};
use glam::DVec3;
use spectrel::film::Film;
use spectrel::fresnel::exact::reflect;
use spectrel::render::rays;
use spectrel::scene::Overrides;

/// What each wall sends out by itself, cd/m².
const SHINES: f64 = 10.0;

/// Independent renders of a room.
const SEEDS: u64 = 24;

/// |z| beyond which the mean of them is wrong: 23 degrees of freedom, one failure in ten thousand.
const CRITICAL: f64 = 4.7;

/// Mean square of z beyond which the errors told are too small: χ² with 24 degrees of freedom over 24, one failure in ten thousand.
const CRITICAL_SQUARE: f64 = 2.5;

const CAMERA: DVec3 = DVec3::new(0.3, -0.2, 0.1);
const TARGET: DVec3 = DVec3::new(0.9, 0.7, -0.3);

/// A cube of side 2 around the origin, looked into from within.
fn room(walls: &str, size: u32, samples: u32, fov: f64) -> String {
    let sides = [DVec3::X, DVec3::Y, DVec3::Z].into_iter().flat_map(|axis| [axis, -axis]).map(|normal| {
        let (center, normal) = ((-normal).to_array(), normal.to_array());
        format!(
            "[[objects]]\nmaterial = \"wall\"\nshape.rectangle = {{ size = [2, 2], center = {center:?}, normal = {normal:?} }}
            emission = {{ spectrum = \"E\", luminance = {SHINES} }}\n"
        )
    });
    format!(
        "meters_per_unit = 1\nrender = {{ width = {size}, height = {size}, samples = {samples}, filter = \"box\" }}
        camera = {{ position = {:?}, look_at = {:?}, fov = {fov} }}\nmaterials.wall = {walls}\n{}",
        CAMERA.to_array(),
        TARGET.to_array(),
        sides.collect::<String>()
    )
}

/// A render's mean luminance and the error that it tells of it.
fn told(film: &Film) -> (f64, f64) {
    let variance: f64 = film.pixels().iter().map(|pixel| pixel.variance_of_mean()[1]).sum();
    (mean(film)[1], variance.sqrt() / film.pixels().len() as f64)
}

/// The mean of a room must be right to a percent and by its spread, and its renders must tell the error that they have.
fn check(name: &str, text: &str, expected: f64) {
    let each: Vec<_> = renders(&mut scene(text, &Overrides::default()), 0..SEEDS).iter().map(told).collect();
    let means: Vec<f64> = each.iter().map(|(mean, _)| *mean).collect();
    let (mean, error) = mean_and_error(&means);
    let square = each.iter().map(|(mean, error)| ((mean - expected) / error).powi(2)).sum::<f64>() / each.len() as f64;
    println!("{name}: {mean:.2} ± {error:.2}, expected {expected:.2}; mean square of z {square:.2}");
    assert!(error < 0.006 * expected, "{name}: ± {error} sees no percent of {expected}");
    assert!((mean - expected).abs() < CRITICAL * error, "{name}: {mean} ± {error} against {expected}");
    assert!(square < CRITICAL_SQUARE, "{name}: errors are {:.1} times those told", square.sqrt());
}

#[test]
#[ignore = "long: many seconds of paths"]
fn matt_rooms_gather_what_their_walls_keep() {
    for (reflectance, samples) in [(0.99, 4), (0.995, 4), (0.998, 3), (0.9995, 1)] {
        let walls = format!("{{ diffuse = {{ reflectance = {reflectance} }} }}");
        let expected = SHINES / (1.0 - reflectance);
        check(&format!("matt, {reflectance}"), &room(&walls, 8, samples, 60.0), expected);
    }
}

/// e (1 + R₁ + R₁R₂ + …) from the camera on.
fn between_mirrors(n: f64, k: f64) -> f64 {
    let (mut at, mut direction) = (CAMERA, (TARGET - CAMERA).normalize());
    let (mut light, mut kept) = (0.0, 1.0);
    while kept > 1e-12 {
        let to_wall = |axis: usize| (direction[axis].signum() - at[axis]) / direction[axis];
        let axis = (0..3).min_by(|&a, &b| to_wall(a).total_cmp(&to_wall(b))).expect("three");
        at += to_wall(axis) * direction;
        light += kept * SHINES;
        kept *= reflect(1.0, n, k, direction[axis].abs()).r;
        direction[axis] = -direction[axis];
    }
    light
}

#[test]
fn metal_rooms_gather_what_their_walls_keep() {
    for (n, k, samples) in [(0.25, 10.0, 4), (0.125, 10.0, 4), (0.05, 10.0, 3), (0.0125, 10.0, 2)] {
        let walls = format!("{{ conductor = {{ ior = {{ n = {n}, k = {k} }} }} }}");
        check(&format!("metal, {n} + {k} i"), &room(&walls, 8, samples, 1e-3), between_mirrors(n, k));
    }
}

/// Light that total reflection holds in clear glass carries the same for ever, and yet must end.
#[test]
fn light_that_nothing_lets_out_ends() {
    let glass = "materials.glass.dielectric = { ior = 1.5, absorption = 0 }\n";
    // Towards an edge at 45°: beyond the critical angle at every face it comes to, for ever.
    let cube = format!(
        "meters_per_unit = 1\nrender = {{ width = 16, height = 16, samples = 16, filter = \"box\" }}
        camera = {{ position = [0.3, -0.2, 0.1], look_at = [1.3, 0.8, 1.1], fov = 1 }}
        environment.constant = {{ spectrum = \"E\", luminance = 100 }}
        {glass}[[objects]]\nmaterial = \"glass\"\nshape.box = {{ size = [2, 2, 2] }}\n"
    );
    let matt = room("{ diffuse = { reflectance = 1 } }", 16, 4, 60.0)
        .replace("emission = { spectrum = \"E\", luminance = 10 }", "");
    for (name, text, samples) in [("glass cube", cube, 16), ("white room", matt, 4)] {
        let scene = scene(&text, &Overrides::default());
        let before = rays::traced();
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
        let (film, rays) = pool.install(|| (film(&scene), rays::traced()));
        let each = (rays - before) as f64 / f64::from(256 * samples);
        println!("{name}: {each:.0} rays a sample");
        assert_eq!(mean(&film), [0.0; 3], "{name}");
        assert!(each < 1500.0, "{name}: {each} rays a sample");
    }
}
