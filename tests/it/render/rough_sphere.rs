//! Balls and planes of rough glass in a furnace, against light transport integrated apart from the renderer (`common::facets`).
//!
//! What facets send to other facets is lost, so a rough ball is darker than the furnace by just what single scattering says, at the
//! first boundary and at each one that light meets within. Seen over the whole disk and at single angles; an absorption one per
//! cent off and another form of shadowing must be rejected.

use crate::common::facets::{Ball, Facets, Joint};
use crate::common::plates::{check, looking, seen};
use crate::common::{lanes::with, scene};
use glam::DVec3;

const N: f64 = 1.5;
const ALPHAS: [f64; 3] = [0.1, 0.3, 0.6];
const SKY: &str = "environment.constant = { spectrum = \"E\", luminance = 100 }\n";

/// How far a comparison may be off, as a share.
const TARGET: f64 = 2e-3;

fn ball(alpha: f64, absorption: f64) -> String {
    format!(
        "{SKY}materials.m.dielectric = {{ ior = {N}, roughness = {alpha}, absorption = {absorption} }}
        [[objects]]\nmaterial = \"m\"\nshape.sphere = {{ radius = 1 }}\n"
    )
}

/// A picture that the ball just fills, corners apart.
fn whole(more: &str) -> String {
    looking(9.0 * DVec3::Z, DVec3::ZERO, 1).replace("orthographic_width = 0.05", "orthographic_width = 2") + more
}

fn picture(ball: f64) -> f64 {
    let disk = std::f64::consts::FRAC_PI_4;
    100.0 * (disk * ball + 1.0 - disk)
}

#[test]
fn a_rough_ball_loses_what_single_scattering_loses() {
    for alpha in ALPHAS {
        let right = Ball::new(alpha, N, 0.0, Joint::Beta);
        let [mean, other] = [&right, &Ball::new(alpha, N, 0.0, Joint::OneSide)].map(Ball::mean);
        // The wrong joint of the two sides changes too little where facets hardly shadow each other.
        let wrong = if alpha > 0.2 { &[picture(other)][..] } else { &[] };
        let off = check(
            &format!("ball of α {alpha}"),
            &mut scene(&whole(&ball(alpha, 0.0)), &with(8, 256)),
            picture(mean),
            wrong,
        );
        assert!(off.abs() < TARGET);
        for cos in [1.0, 0.7, 0.3f64] {
            let text = looking(
                DVec3::new((1.0 - cos * cos).sqrt(), 0.0, 9.0),
                DVec3::new((1.0 - cos * cos).sqrt(), 0.0, 0.0),
                1,
            )
            .replace("orthographic_width = 0.05", "orthographic_width = 1e-3");
            let mut scene = scene(&(text + &ball(alpha, 0.0)), &with(8, 512));
            let off = check(&format!("ball of α {alpha}, cos {cos}"), &mut scene, 100.0 * right.seen(cos), &[]);
            assert!(off.abs() < TARGET);
        }
    }
}

#[test]
fn a_rough_ball_that_absorbs_loses_what_its_length_says() {
    for alpha in ALPHAS {
        let light = |absorption: f64| picture(Ball::new(alpha, N, 2.0 * absorption, Joint::Beta).mean());
        let mut scene = scene(&whole(&ball(alpha, 0.5)), &with(8, 1024));
        let wrong = [light(0.99 * 0.5), light(1.01 * 0.5)];
        let off = check(&format!("absorbing ball of α {alpha}"), &mut scene, light(0.5), &wrong);
        assert!(off.abs() < TARGET);
    }
}

/// A lamp within the glass as bright as the furnace, n² brighter in numbers: the interface shows all that it does not lose.
#[test]
fn a_rough_interface_keeps_its_single_scattering_albedo() {
    for alpha in ALPHAS {
        let glass = format!(
            "materials.m.dielectric = {{ ior = {N}, roughness = {alpha} }}
            [[objects]]\nmaterial = \"m\"\nshape.box = {{ size = [2000, 2000, 1] }}
            [[objects]]\nshape.rectangle = {{ size = [1990, 1990], center = [0, 0, 0.3] }}
            emission = {{ spectrum = \"E\", luminance = {} }}\n",
            100.0 * N * N
        );
        for cos in [1.0, 0.7, 0.3] {
            let albedo = |joint| Facets { alpha, n1: 1.0, n2: N, joint }.albedo(cos).iter().sum::<f64>();
            let mut scene = scene(&(seen(0.5 * DVec3::Z, cos, 256) + SKY + &glass), &with(8, 256));
            let expected = 100.0 * albedo(Joint::Beta);
            let other = 100.0 * albedo(Joint::OneSide);
            let wrong = if (other / expected - 1.0).abs() > 5e-3 { &[other][..] } else { &[] };
            let off = check(&format!("interface of α {alpha}, cos {cos}"), &mut scene, expected, wrong);
            assert!(off.abs() < TARGET);
        }
    }
}
