//! The primary rainbow of a ball of water under a parallel sun, through the whole renderer.
//!
//! A ray that meets the ball at an angle i and is reflected once within turns by D = π + 2i − 4r, least at cos²i = (n² − 1)/3
//! (Descartes 1637; K. Sassen, "Angular scattering and rainbow formation in pendant drops", J. Opt. Soc. Am. 69, 1979): the bow stands
//! π − D from the point opposite the sun, and beyond it there is no light of this kind at all. The light at each wavelength is that of a
//! lamp of one line. The camera looks at the strip of the ball where the bow's rays leave it, once for each angle between it and
//! the sun; the mean of each picture is compared with rays traced here in f64, T²R of Fresnel each, over a sun of the same width.

use crate::common::plates::fresnel;
use crate::common::{film, lanes::with, library, mean, scene};
use glam::DVec3;
use std::f64::consts::PI;
use std::path::Path;

/// Diameter of the sun, degrees.
const SUN: f64 = 1.0;

/// The strip: impact parameters along the plane of sun and camera, and its height; the ball's radius is 1.
const STRIP: [f64; 2] = [0.68, 1.0];
const PIXELS: [u32; 2] = [64, 6];

/// Where the bow of one internal reflection stands, degrees.
fn descartes(n: f64) -> f64 {
    let cos_i = ((n * n - 1.0) / 3.0).sqrt();
    let sin_i = (1.0 - cos_i * cos_i).sqrt();
    (4.0 * (sin_i / n).asin() - 2.0 * sin_i.asin()).to_degrees()
}

fn index(nm: f64) -> f64 {
    library().ior("H2O/daimon-2007-20c", Path::new("")).expect("in the library").n.at(nm)
}

/// Half the strip's height.
fn half_height() -> f64 {
    (STRIP[1] - STRIP[0]) / 2.0 * f64::from(PIXELS[1]) / f64::from(PIXELS[0])
}

/// The strip as the camera sees it that stands at an angle from the sun, as a share of the sun's luminance.
fn rendered(ior: &str, nm: f64, degrees: f64, samples: u32) -> f64 {
    let (sin, cos) = degrees.to_radians().sin_cos();
    // The camera stands at +z and sees +x to its right; the light leaves towards −x.
    let middle = 0.5 * (STRIP[0] + STRIP[1]);
    let solid_angle = PI * (SUN / 2.0).to_radians().sin().powi(2);
    let text = format!(
        "meters_per_unit = 0.001
        render = {{ width = {}, height = {}, filter = \"box\", samples = {samples} }}
        camera = {{ position = [{middle}, 0, 50], look_at = [{middle}, 0, 0], up = [0, 1, 0], orthographic_width = {} }}
        materials.w.dielectric = {{ ior = {ior}, absorption = 0 }}
        [[suns]]
        direction = [{}, 0, {cos}]
        angle = {SUN}
        spectrum = {{ lines = [[{nm}, 1]] }}
        illuminance = {}
        [[objects]]
        material = \"w\"
        shape.sphere = {{ radius = 1 }}\n",
        PIXELS[0],
        PIXELS[1],
        STRIP[1] - STRIP[0],
        -sin,
        1000.0 * solid_angle
    );
    mean(&film(&scene(&text, &with(8, samples))))[1] / 1000.0
}

/// The same by rays of one internal reflection.
fn traced(n: f64, degrees: f64) -> f64 {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let sun = DVec3::new(-sin, 0.0, cos);
    let least = (SUN / 2.0).to_radians().cos();
    let (columns, rows) = (1600, 60);
    let mut sum = 0.0;
    for i in 0..columns {
        let x = STRIP[0] + (STRIP[1] - STRIP[0]) * (f64::from(i) + 0.5) / f64::from(columns);
        for j in 0..rows {
            // The lower half is the upper one's mirror image.
            let y = half_height() * (f64::from(j) + 0.5) / f64::from(rows);
            let b = x.hypot(y);
            if b >= 1.0 {
                continue;
            }
            let turned = PI + 2.0 * b.asin() - 4.0 * (b / n).asin();
            // From straight down towards the axis, by the turn.
            let out = DVec3::new(-x / b * turned.sin(), -y / b * turned.sin(), -turned.cos());
            if out.dot(sun) > least {
                let (r, _) = fresnel(1.0, n, (1.0 - b * b).sqrt());
                sum += (1.0 - r) * (1.0 - r) * r;
            }
        }
    }
    sum / f64::from(columns * rows)
}

const VIEWS: usize = 17;

fn view(i: usize) -> f64 {
    39.5 + 0.25 * i as f64
}

/// The index whose rainbow is most like the rendered one in all views, and how unlike it still is over its peak.
fn fitted(measured: &[f64]) -> (f64, f64) {
    let unlike = |n: f64| (0..VIEWS).map(|i| (measured[i] - traced(n, view(i))).powi(2)).sum::<f64>();
    let step = 2.5e-3;
    let coarse = (0..15).map(|i| 1.32 + step * f64::from(i));
    let best = coarse.min_by(|a, b| unlike(*a).total_cmp(&unlike(*b))).expect("some");
    // A parabola through three points.
    let step = 0.4 * step;
    let [a, b, c] = [best - step, best, best + step].map(unlike);
    let n = best + 0.5 * step * (a - c) / (a - 2.0 * b + c);
    let peak = measured.iter().copied().fold(0.0, f64::max);
    (n, (unlike(n) / VIEWS as f64).sqrt() / peak)
}

/// Where the renderer has the bow, degrees.
fn bow(ior: &str, nm: f64) -> f64 {
    let measured: Vec<f64> = (0..VIEWS).map(|i| rendered(ior, nm, view(i), 64)).collect();
    let (n, unlike) = fitted(&measured);
    assert!(unlike < 0.05, "{nm} nm: the bow has another shape, by {unlike:.3} of its peak: {measured:.4?}");
    println!("{nm} nm: index {n:.5}, differs by {unlike:.3} of the peak");
    descartes(n)
}

#[test]
#[ignore = "long: many seconds of paths"]
fn the_bow_stands_where_descartes_has_it_in_red_green_and_blue() {
    let mut bows = Vec::new();
    for nm in [656.3, 546.1, 435.8] {
        let (found, theory) = (bow("\"H2O/daimon-2007-20c\"", nm), descartes(index(nm)));
        println!("{nm} nm: {found:.3}°, Descartes {theory:.3}°");
        assert!((found - theory).abs() < 0.05, "{nm} nm: {found} against {theory}");
        bows.push(found);
    }
    assert!(bows[0] > bows[1] && bows[1] > bows[2], "red is the outer colour: {bows:?}");
}

#[test]
#[ignore = "long: many seconds of paths"]
fn the_bow_of_sodium_light_stands_at_42_degrees() {
    let found = bow("\"H2O/daimon-2007-20c\"", 589.3);
    println!("sodium: {found:.3}°");
    assert!((found - 42.0).abs() < 0.2, "{found}");
    // The counter-check: an index one per cent higher.
    let wrong = bow(&(1.01 * index(589.3)).to_string(), 589.3);
    println!("index one per cent higher: {wrong:.3}°");
    assert!((wrong - 42.0).abs() > 0.5, "{wrong}");
}

/// Without a model: light to within 0.2° of 42.0° and none beyond.
#[test]
fn there_is_no_light_beyond_the_bow() {
    let light = |degrees| rendered("\"H2O/daimon-2007-20c\"", 589.3, degrees, 512);
    let (inside, outside) = (light(42.0 + SUN / 2.0 - 0.2), light(42.0 + SUN / 2.0 + 0.2));
    let brightest = light(42.0 - SUN / 4.0);
    println!("{inside:.5} within, {outside:.5} beyond, {brightest:.5} in the bow");
    assert!(outside < 0.002 * brightest, "{outside} of {brightest}");
    assert!(inside > 0.02 * brightest, "{inside} of {brightest}");
}
