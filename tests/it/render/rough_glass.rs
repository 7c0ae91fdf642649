//! Rough glass through the whole renderer: against its albedo by quadrature, light found both ways, and lanes against wavelengths alone.

use crate::common::lanes::{RENDERS, ball, slab as plate, t_of_lanes, with};
use crate::common::{replicates, z_against};
use glam::DVec3;
use spectrel::bsdf::albedo::dielectric;
use spectrel::fresnel::exact;
use spectrel::scene::{Overrides, Text, resolve};

/// |z| beyond which a mean is wrong: 15 degrees of freedom, one failure in ten thousand.
const CRITICAL: f64 = 5.2;

/// The luminance of a scene must be the expected one, in cd/m², and none that is one per cent off.
fn check(name: &str, scene: &str, overrides: &Overrides, expected: f64) {
    let renders = replicates(scene, overrides, 0, RENDERS);
    let y: Vec<[f64; 3]> = renders.iter().map(|xyz| [xyz[1]; 3]).collect();
    let mean = y.iter().map(|y| y[0]).sum::<f64>() / y.len() as f64;
    let error = mean / expected - 1.0;
    println!("{name}: {mean:.5}, expected {expected:.5}, off by {error:+.1e}");
    let rounding = 1e-4;
    assert!(error.abs() < rounding || z_against(&y, [expected; 3]) < CRITICAL, "{name}: {mean} against {expected}");
    assert!(error.abs() < 2e-3, "{name}: {mean} against {expected}");
    assert!(z_against(&y, [1.01 * expected; 3]) > CRITICAL, "{name}: one per cent more is not told apart");
}

/// Cosines under which the camera sees a level surface half a unit above the origin.
const VIEWS: [(&str, f64); 3] = [
    ("[0.001, 0, 6.5]", 1.0),
    ("[6, 0, 6.5]", std::f64::consts::FRAC_1_SQRT_2),
    ("[6, 0, 2.5]", 0.316_227_766_016_837_94),
];

fn over(camera: &str, more: &str) -> String {
    format!(
        "meters_per_unit = 1\nrender = {{ width = 8, height = 8, filter = \"box\" }}
        camera = {{ position = {camera}, look_at = [0, 0, 0.5], fov = 0.05 }}\n{more}"
    )
}

const SKY: &str = "environment.constant = { spectrum = \"E\", luminance = 100 }\n";

fn slab(alpha: f64, n: f64) -> String {
    format!(
        "materials.glass.dielectric = {{ ior = {n}, roughness = {alpha} }}
        [[objects]]\nmaterial = \"glass\"\nshape.box = {{ size = [2000, 2000, 1] }}\n"
    )
}

/// What a rough surface reflects and lets through.
fn surface(alpha: f64, cos: f64, n1: f64, n2: f64) -> [f64; 2] {
    dielectric(alpha, cos, [n1, n2], |cos| exact::reflect(n1, n2, 0.0, cos).r)
}

#[test]
fn a_sheet_that_nothing_comes_back_from_shows_its_reflectance() {
    let black = "[[objects]]\nmaterial = \"black\"\nshape.rectangle = { size = [1990, 1990], center = [0, 0, 0.3] }
        [materials.black]\ndiffuse.reflectance = 0\n";
    for alpha in [0.05, 0.5] {
        for (camera, cos) in VIEWS {
            for lanes in [1, 8] {
                let text = over(camera, &format!("{SKY}{}{black}", slab(alpha, 4.0)));
                let [expected, _] = surface(alpha, cos, 1.0, 4.0);
                check(&format!("α {alpha}, cos {cos:.2}"), &text, &with(lanes, 2048), 100.0 * expected);
            }
        }
    }
}

#[test]
#[ignore = "long: many seconds of paths"]
fn a_lamp_in_rough_glass_shows_through_it() {
    let lamp = "[[objects]]\nshape.rectangle = { size = [1990, 1990], center = [0, 0, 0.3] }
        emission = { spectrum = \"E\", luminance = 100 }\n";
    for alpha in [0.05, 0.5] {
        for (camera, cos) in VIEWS {
            for lanes in [1, 8] {
                let [_, expected] = surface(alpha, cos, 1.0, 1.5);
                let text = over(camera, &format!("{}{lamp}", slab(alpha, 1.5)));
                check(&format!("in glass, α {alpha}, cos {cos:.2}"), &text, &with(lanes, 512), 100.0 / 2.25 * expected);
                // Seen from glass, in a hollow.
                let [_, expected] = surface(alpha, cos, 1.5, 1.0);
                if expected > 0.02 {
                    let hollow = slab(alpha, 1.0);
                    let text = format!(
                        "outside = \"around\"\n{}\n[materials.around]\ndielectric.ior = 1.5\n",
                        over(camera, &format!("{hollow}{lamp}"))
                    );
                    let name = format!("in a hollow, α {alpha}, cos {cos:.2}");
                    check(&name, &text, &with(lanes, 2048), 100.0 * 2.25 * expected);
                }
            }
        }
    }
}

/// Six lamps that leave no gap around an object: the same light as a constant environment, but found by sampling too.
fn room(object: &str, light: Option<&str>) -> String {
    let walls = [DVec3::X, DVec3::Y, DVec3::Z].into_iter().flat_map(|axis| [axis, -axis]).map(|normal| {
        let (center, normal) = ((-4.0 * normal).to_array(), normal.to_array());
        format!(
            "[[objects]]\nshape.rectangle = {{ size = [8, 8], center = {center:?}, normal = {normal:?} }}
            emission = {{ spectrum = \"E\", luminance = 100 }}\n"
        )
    });
    let light = light.map_or_else(|| walls.collect::<String>(), str::to_owned);
    format!(
        "meters_per_unit = 1\nrender = {{ width = 8, height = 8, filter = \"box\" }}
        camera = {{ position = [0, -3.9, 1], look_at = [0, 0, 0], fov = 6 }}\n{}",
        if light == SKY { format!("{light}{object}") } else { format!("{object}{light}") }
    )
}

#[test]
#[ignore = "long: many seconds of paths"]
fn lamps_around_rough_glass_are_found_both_ways() {
    for alpha in [0.02, 0.1, 0.4, 1.0] {
        for (kind, absorption) in [("clear", 0.0), ("coloured", 0.5)] {
            let ball = format!(
                "materials.m.dielectric = {{ ior = 1.5, roughness = {alpha}, absorption = {absorption} }}
                [[objects]]\nmaterial = \"m\"\nshape.sphere = {{ radius = 1 }}\n"
            );
            let sky = replicates(&room(&ball, Some(SKY)), &with(8, 1024), 100, RENDERS);
            let expected = sky.iter().map(|xyz| xyz[1]).sum::<f64>() / RENDERS as f64;
            assert!(expected < 100.001, "light is gained: {expected}");
            check(&format!("{kind}, α {alpha}"), &room(&ball, None), &with(8, 512), expected);
        }
    }
}

#[test]
fn nearly_smooth_glass_is_invisible_in_a_furnace() {
    let object = |roughness: f64| {
        format!(
            "materials.m.dielectric = {{ ior = 1.5, roughness = {roughness} }}
            [[objects]]\nmaterial = \"m\"\nshape.box = {{ size = [1.5, 1.5, 1] }}\ntransform.rotate = [10, 20, 30]\n"
        )
    };
    for roughness in [0.0, 9e-5, 2e-4, 1e-3] {
        let renders = replicates(&room(&object(roughness), Some(SKY)), &with(8, 64), 0, 4);
        let mean = renders.iter().map(|xyz| xyz[1]).sum::<f64>() / 4.0;
        println!("α {roughness}: {mean}");
        assert!((mean - 100.0).abs() < 2e-2, "{roughness}: {mean}");
    }
}

/// A lamp in a solid within another of the same stuff, over a grey plane in the outer one: the boundary stops shadow rays only.
#[test]
fn a_boundary_that_is_none_keeps_all_light() {
    let text = "meters_per_unit = 1
        render = { width = 8, height = 8, filter = \"box\" }
        camera = { position = [6, 0, 6], look_at = [0, 0, 0], fov = 0.05 }
        materials.grey.diffuse.reflectance = 0.5
        materials.air.dielectric = { ior = 1 }
        objects = [
            { material = \"air\", shape.box = { size = [300, 300, 9] } },
            { material = \"air\", shape.box = { size = [2.2, 2.2, 2.2], center = [0, 0, 3] } },
            { material = \"grey\", shape.rectangle = { size = [100, 100] } },
            { shape.sphere = { radius = 1, center = [0, 0, 3] }, emission = { spectrum = \"E\", luminance = 100 } },
        ]";
    check("nested", text, &with(8, 2048), 50.0 / 9.0);
}

#[test]
#[ignore = "long: many seconds of paths"]
fn lanes_of_rough_sf11_agree_with_single_wavelengths() {
    for alpha in [0.05, 0.5] {
        let sf11 = format!("materials.stone = {{ dielectric = {{ ior = \"SCHOTT/sf11\", roughness = {alpha} }} }}");
        for (name, t) in [("ball", t_of_lanes(ball, &sf11, &sf11, 112)), ("box", t_of_lanes(plate, &sf11, &sf11, 224))]
        {
            println!("{name}, α {alpha}: t = {t:.1}");
            assert!(t < 4.6, "{name}, α {alpha}: t = {t:.1}");
        }
    }
}

#[test]
#[ignore = "long: many seconds of paths"]
fn the_lane_test_sees_an_index_one_per_cent_too_high() {
    for alpha in [0.05, 0.5] {
        let glass = |n: f64| format!("materials.stone = {{ dielectric = {{ ior = {n}, roughness = {alpha} }} }}");
        let t = t_of_lanes(plate, &glass(1.78), &glass(1.01 * 1.78), 224);
        println!("α {alpha}: t = {t:.1}");
        assert!(t > 4.6, "α {alpha}: t = {t:.1}");
    }
}

#[test]
fn roughness_is_said_in_one_way() {
    let scene = |keys: &str| {
        over(
            VIEWS[1].0,
            &format!(
                "materials.glass.dielectric = {{ ior = 1.5, {keys} }}
        [[objects]]\nmaterial = \"glass\"\nshape.sphere = {{ radius = 1 }}\n"
            ),
        )
    };
    let error = |keys: &str| match resolve(
        Text::new("tests/scene.toml", scene(keys)),
        &crate::common::library(),
        &Overrides::default(),
    ) {
        Ok(_) => String::new(),
        Err(error) => error.to_string(),
    };
    assert_eq!(error("roughness = 0.25"), "");
    assert_eq!(error("perceptual_roughness = 0.5"), "");
    assert!(error("roughness = 0.25, perceptual_roughness = 0.5").contains("both say how rough"));
    assert!(error("roughness = 1.5").contains("between 0 and 1"));
}
