//! Values of textbooks and papers that a reader can look up, asked of the reference and of the kernels.

use spectrel::fresnel::exact::reflect;
use spectrel::fresnel::{conductor, dielectric};
use spectrel::math::Lanes;
use std::f64::consts::PI;

fn cos(degrees: f64) -> f64 {
    degrees.to_radians().cos()
}

/// Glass of 1.5 from air at 45° (E. Hecht, *Optics*, 5th ed., 4.6): R_s = 0.0920, R_p = R_s² = 0.0085.
#[test]
fn glass_at_45_degrees() {
    let r = reflect(1.0, 1.5, 0.0, cos(45.0));
    assert!((r.rs - 0.0920).abs() < 5e-5 && (r.rp - 0.0085).abs() < 5e-5, "{r:?}");
    assert!((r.rp - r.rs * r.rs).abs() < 1e-15);
    let kernel = conductor::polarised(1.0, 1.5, 0.0, cos(45.0) as f32);
    assert!((f64::from(kernel.rs) - r.rs).abs() < 1e-7 && (f64::from(kernel.rp) - r.rp).abs() < 1e-7);
}

/// Out of the same glass at 10°: Fresnel's sine and tangent laws with θ_t = 15.10°.
#[test]
fn out_of_glass_at_10_degrees() {
    let (i, t) = (10f64.to_radians(), (1.5 * 10f64.to_radians().sin()).asin());
    let (rs, rp) = (((i - t).sin() / (i + t).sin()).powi(2), ((i - t).tan() / (i + t).tan()).powi(2));
    let r = reflect(1.5, 1.0, 0.0, cos(10.0));
    assert!((t.to_degrees() - 15.0981).abs() < 1e-4);
    assert!((r.rs - rs).abs() < 1e-15 && (r.rp - rp).abs() < 1e-15, "{r:?}");
    let kernel = dielectric::fresnel(&Lanes([1.5]), &Lanes([1.0]), &Lanes([cos(10.0) as f32]));
    assert!((f64::from(kernel.r[0]) - r.r).abs() < 1e-7 && (f64::from(kernel.cos_theta_t[0]) - t.cos()).abs() < 1e-6);
}

/// tan θ_B = n: 56.3099° for 1.5, where p light passes whole.
#[test]
fn brewsters_angle_is_56_3099_degrees() {
    let darkest = |n: f64| {
        let rp = |degrees: f64| reflect(1.0, n, 0.0, cos(degrees)).rp;
        let (mut low, mut high) = (10.0, 85.0);
        while high - low > 1e-9 {
            let third = (high - low) / 3.0;
            (low, high) = if rp(low + third) < rp(high - third) { (low, high - third) } else { (low + third, high) };
        }
        low
    };
    for (n, expected) in [(1.5, 56.3099), (1.333, 53.1232), (2.417, 67.5233)] {
        let found = darkest(n);
        assert!((found - expected).abs() < 1e-4 && (found - f64::atan(n).to_degrees()).abs() < 1e-5, "{n}: {found}");
    }
}

/// Total reflection parts the phases of p and s by tan(Δ/2) = cos θ √(n² sin²θ − 1)/(n sin²θ), at most by tan(Δ/2) = (n² − 1)/(2 n) at
/// sin²θ = 2/(n² + 1) (M. Born & E. Wolf, *Principles of Optics*, 7th ed., 1.5.4; R. Azzam, "Phase shifts that accompany total
/// internal reflection at a dielectric–dielectric interface", JOSA A 21 (2004)): 45.24° at 51.67° for 1.5.
#[test]
fn total_reflection_parts_the_phases_as_far_as_azzam_says() {
    for (n, largest_deg, at_deg) in [(1.5f64, 45.2397, 51.6711), (2.417, 90.0934, 32.7288)] {
        let difference = |degrees: f64| {
            let r = reflect(n, 1.0, 0.0, cos(degrees));
            let delta = (r.delta_p - r.delta_s).rem_euclid(2.0 * PI);
            delta.min(2.0 * PI - delta).to_degrees()
        };
        let formula = |degrees: f64| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            2.0 * (cos * (n * n * sin * sin - 1.0).sqrt() / (n * sin * sin)).atan().to_degrees()
        };
        let critical = (1.0 / n).asin().to_degrees();
        let angles = || (1..10_000).map(|i| critical + (90.0 - critical) * f64::from(i) / 10_000.0);
        for angle in angles() {
            assert!((difference(angle) - formula(angle)).abs() < 1e-6, "{n} at {angle}°: {}", difference(angle));
        }
        let (at, largest) =
            angles().map(|angle| (angle, difference(angle))).fold((0.0, 0.0), |a, b| if b.1 > a.1 { b } else { a });
        let closed = 2.0 * ((n * n - 1.0) / (2.0 * n)).atan().to_degrees();
        println!("n {n}: {largest:.4}° at {at:.4}°, closed form {closed:.4}°");
        assert!((largest - closed).abs() < 1e-5 && (largest - largest_deg).abs() < 1e-3, "{n}: {largest}, {closed}");
        assert!(
            (at - (2.0 / (n * n + 1.0)).sqrt().asin().to_degrees()).abs() < 0.02 && (at - at_deg).abs() < 0.03,
            "{at}"
        );
    }
}

/// A metal that absorbs nothing is a dielectric: the general kernel and the one for clear media, from either side.
#[test]
fn a_conductor_without_k_is_a_dielectric() {
    let mut worst = 0.0f32;
    for (n1, n2) in [(1.0f32, 1.33), (1.0, 1.5), (1.0, 2.417), (1.33, 1.5), (1.5, 1.0), (2.417, 1.0)] {
        for step in 0..=1000 {
            let cos = step as f32 / 1000.0;
            let metal = conductor::reflectance(&Lanes([n1]), &Lanes([n2]), &Lanes([0.0]), &Lanes([cos]))[0];
            let clear = dielectric::fresnel(&Lanes([n1]), &Lanes([n2]), &Lanes([cos])).r[0];
            // Beside the critical angle one rounding of the input is worth more than that.
            let steep = (f64::from(n2) / f64::from(n1)).min(1.0);
            let critical = (1.0 - steep * steep).sqrt();
            if n1 <= n2 || (f64::from(cos) - critical).abs() > 0.02 {
                worst = worst.max((metal - clear).abs());
            }
        }
    }
    println!("{worst:.1e}, {} ulp of 1", worst / f32::EPSILON);
    assert!(worst <= 8.0 * f32::EPSILON, "{worst:e}");
}

/// The same of the reference: k = 0 in the equations of absorbing media against Fresnel's real amplitudes.
#[test]
fn the_reference_without_k_is_fresnels_own() {
    for n in [1.33, 1.5, 2.417] {
        for step in 1..=1000 {
            let c = f64::from(step) / 1000.0;
            let t = (n * n - 1.0 + c * c).sqrt() / n;
            let (rs, rp) = (((c - n * t) / (c + n * t)).powi(2), ((n * c - t) / (n * c + t)).powi(2));
            let r = reflect(1.0, n, 0.0, c);
            assert!((r.rs - rs).abs() < 4.0 * f64::EPSILON && (r.rp - rp).abs() < 4.0 * f64::EPSILON, "{n} {c}: {r:?}");
        }
    }
}
