//! The choice of directions by itself, without a renderer.

use super::Picture;
use crate::statistics::{Random, chi_squared};
use glam::{DVec3, Vec3};
use spectrel::light::{Map, mean_over_sphere};
use spectrel::spectrum::{Arena, Spectrum, Tint};
use std::f64::consts::PI;

/// A map of these luminances.
fn map(width: usize, luminances: &[f32]) -> Map {
    let light = Arena::default().add(Spectrum::Constant(1.0));
    let tints = luminances.iter().map(|y| Tint { scale: 2.0 * y, ..Tint::BLACK }).collect();
    let brightest = luminances.iter().copied().fold(0.0, f32::max);
    Map::new([width as u32, (luminances.len() / width) as u32], tints, (luminances, brightest), light, 0.0)
}

fn solid_angle(width: usize, height: usize, row: usize) -> f64 {
    let cos = |edge: usize| (PI * edge as f64 / height as f64).cos();
    2.0 * PI / width as f64 * (cos(row) - cos(row + 1))
}

/// The middle of a texel, from its angles.
fn middle(width: usize, height: usize, index: usize) -> Vec3 {
    let theta = PI * ((index / width) as f64 + 0.5) / height as f64;
    let psi = 2.0 * PI * ((index % width) as f64 + 0.5) / width as f64 - PI;
    DVec3::new(theta.sin() * psi.sin(), theta.sin() * psi.cos(), theta.cos()).as_vec3()
}

/// Luminances of every size, with bright rows at both poles.
fn random_sky(width: usize, height: usize, seed: u64) -> Vec<f32> {
    let mut random = Random::new(seed);
    let value = |row: usize, u: f32| if row == 0 || row + 1 == height { 20.0 + u } else { (12.0 * u - 6.0).exp() };
    (0..width * height).map(|i| value(i / width, random.unit())).collect()
}

const SIZES: [(usize, usize); 5] = [(1, 1), (16, 8), (31, 15), (5, 40), (256, 128)];

#[test]
fn densities_sum_to_one_over_the_sphere_and_follow_what_is_above_the_mean() {
    for (width, height) in SIZES {
        let sky = random_sky(width, height, 7);
        let map = map(width, &sky);
        let density = |i: usize| f64::from(map.look(middle(width, height, i)).pdf);
        let angle = |i: usize| solid_angle(width, height, i / width);
        let total: f64 = (0..sky.len()).map(|i| density(i) * angle(i)).sum();
        assert!((total - 1.0).abs() < 1e-5, "{width} × {height}: {total}");
        if sky.len() == 1 {
            continue;
        }
        let mean = mean_over_sphere([width as u32, height as u32], &sky);
        let own_mean: f64 = (0..sky.len()).map(|i| f64::from(sky[i]) * angle(i)).sum::<f64>() / (4.0 * PI);
        assert!((mean / own_mean - 1.0).abs() < 1e-9);
        let above = |i: usize| (f64::from(sky[i]) - mean).max(0.0);
        let all: f64 = (0..sky.len()).map(|i| above(i) * angle(i)).sum();
        for i in 0..sky.len() {
            // A step of the numbers that choose is the most that rounding takes.
            let (found, expected) = (density(i) * angle(i), above(i) * angle(i) / all);
            assert!((found - expected).abs() < 4.0 / 16_777_216.0 + 1e-5 * expected, "{i}: {found} for {expected}");
        }
        assert!((map.chosen() / all - 1.0).abs() < 1e-9);
    }
}

#[test]
fn directions_follow_their_density() {
    for (width, height) in SIZES {
        let sky = random_sky(width, height, 11);
        let map = map(width, &sky);
        let mut random = Random::new(3);
        let (samples, mut on_an_edge) = (400_000, 0);
        // Texels are cut in four, so that a wrong spread within them shows as well.
        let mut counts = vec![0.0; 4 * sky.len()];
        for _ in 0..samples {
            let (direction, look) = map.sample(random.point()).expect("light");
            on_an_edge += u32::from(map.look(direction).pdf != look.pdf);
            let direction = direction.as_dvec3();
            let v = direction.truncate().length().atan2(direction.z) / PI * height as f64;
            let u = (direction.x.atan2(direction.y) / (2.0 * PI) + 0.5) * width as f64;
            let [u, v] = [(u * 2.0) as usize, (v * 2.0) as usize];
            let [u, v] = [u.min(2 * width - 1), v.min(2 * height - 1)];
            counts[v * 2 * width + u] += 1.0;
        }
        assert!(on_an_edge < samples / 10_000, "rounding puts {on_an_edge} into the next texel");
        let expected: Vec<f64> = (0..4 * sky.len())
            .map(|i| {
                let (v, u) = (i / (2 * width), i % (2 * width));
                let pdf = map.look(middle(width, height, v / 2 * width + u / 2)).pdf;
                f64::from(pdf) * solid_angle(2 * width, 2 * height, v)
            })
            .collect();
        let p = chi_squared(&counts, &expected, f64::from(samples));
        assert!(p > 1e-4, "{width} × {height}: p = {p:.1e}");
        let wrong: Vec<f64> =
            expected.iter().enumerate().map(|(i, p)| p * if i % 2 == 0 { 1.05 } else { 0.95 }).collect();
        assert!(chi_squared(&counts, &wrong, f64::from(samples)) < 1e-4, "five per cent are seen");
    }
}

#[test]
fn sampled_irradiance_is_that_of_the_texels() {
    // Dark but for texels far above the mean, one of them next to each pole and one across the horizon.
    let (width, height) = (32, 15);
    let mut sky = vec![0.0f32; width * height];
    for (i, y) in [(3, 40.0), (width * 4 + 9, 25.0), (width * 7 + 20, 30.0), (width * 14 + 1, 90.0)] {
        sky[i] = y;
    }
    let expected = Picture::new(width, sky.iter().map(|y| [*y; 3]).collect()).irradiance();
    let map = map(width, &sky);
    let mut random = Random::new(5);
    let samples = 2_000_000;
    let (mut sum, mut squares) = (0.0, 0.0);
    for _ in 0..samples {
        let (direction, look) = map.sample(random.point()).expect("light");
        let value = f64::from(0.5 * look.tint.scale * direction.z.max(0.0) / look.pdf);
        (sum, squares) = (sum + value, squares + value * value);
    }
    let n = f64::from(samples);
    let (mean, error) = (sum / n, ((squares / n - sum * sum / n / n) / n).sqrt());
    println!("irradiance: {mean:.5} ± {error:.5}, of the texels {expected:.5}");
    assert!((mean - expected).abs() < 4.0 * error && error < 1e-3 * expected, "{mean} ± {error} against {expected}");
}

#[test]
fn surroundings_of_one_luminance_are_chosen_evenly_and_black_ones_never() {
    let constant = map(64, &[0.3; 64 * 32]);
    for index in [0, 63, 1000, 2047] {
        let pdf = f64::from(constant.look(middle(64, 32, index)).pdf);
        // Rows and texels are chosen in steps.
        assert!((pdf * 4.0 * PI - 1.0).abs() < 3e-5, "{pdf}");
    }
    let black = map(4, &[0.0; 8]);
    assert!(black.sample([0.3, 0.7]).is_none());
    assert_eq!(black.look(Vec3::Z).pdf, 0.0);
}
