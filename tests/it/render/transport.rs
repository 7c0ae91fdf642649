//! Light through the whole renderer against answers worked out on paper: lamps of every shape, media, radiometry, a prism.
//!
//! Every comparison must hold by the spread of 16 independent renders, and must not hold for an answer one per cent off.

use crate::common::paper::{HEAD, check};
use crate::common::{prism, replicates};
use glam::DVec3;
use spectrel::fresnel::exact::reflect;
use spectrel::scene::Overrides;

/// What a lamp or an environment makes of a grey plane, seen from the side.
fn plane(camera: &str, lamps: &str) -> String {
    format!(
        "{HEAD}
        camera = {{ position = {camera}, look_at = [0, 0, 0], fov = 0.05 }}
        materials.grey.diffuse.reflectance = 0.5
        {lamps}
        [[objects]]
        material = \"grey\"
        shape.rectangle = {{ size = [100, 100] }}"
    )
}

fn lamp(shape: &str, more: &str) -> String {
    format!("[[objects]]\nshape.{shape}\nemission = {{ spectrum = \"E\", luminance = 100{more} }}\n")
}

/// Form factor of a corner of a rectangle, x and y over its height (Howell, catalogue of configuration factors, B-3).
fn corner(x: f64, y: f64) -> f64 {
    let (sx, sy) = (1.0f64.hypot(x), 1.0f64.hypot(y));
    (x / sx * (y / sx).atan() + y / sy * (x / sy).atan()) / std::f64::consts::TAU
}

#[test]
fn round_and_solid_lamps_light_a_plane() {
    let cases = [
        ("sphere", lamp("sphere = { radius = 1, center = [0, 0, 3] }", ""), 1.0 / 9.0),
        ("disk", lamp("disk = { radius = 2, center = [0, 0, 3], normal = [0, 0, -1] }", ""), 4.0 / 13.0),
        ("box", lamp("box = { size = [2, 2, 2], center = [0, 0, 3] }", ""), 4.0 * corner(0.5, 0.5)),
    ];
    for (name, lamp, form_factor) in cases {
        check(name, &plane("[6, 0, 6]", &lamp), 256, 8, 50.0 * form_factor);
    }
}

#[test]
fn rectangles_light_a_plane_near_and_far_and_from_the_side_they_shine() {
    // On both sides of where sampling by solid angle takes over from sampling by area.
    for (side, height) in [(4.0, 2.5), (1.0, 3.0), (2.6, 2.5), (2.4, 2.5)] {
        let form_factor = 4.0 * corner(side / 2.0 / height, side / 2.0 / height);
        let facing = |z: f64, more| {
            let shape =
                format!("rectangle = {{ size = [{side}, {side}], center = [0, 0, {height}], normal = [0, 0, {z}] }}");
            plane("[6, 0, 6]", &lamp(&shape, more))
        };
        check("rectangle", &facing(-1.0, ""), 128, 8, 50.0 * form_factor);
        check("two sides", &facing(1.0, ", two_sided = true"), 128, 8, 50.0 * form_factor);
        let dark = replicates(&facing(1.0, ""), &Overrides { samples: Some(16), ..Overrides::default() }, 0, 2);
        assert_eq!(dark, [[0.0; 3]; 2], "the back of a lamp");
    }
}

#[test]
fn a_weak_lamp_beside_a_strong_hidden_one_keeps_its_light() {
    for strength in [1e3, 1e5] {
        let hidden = lamp("sphere = { radius = 1, center = [0, 0, -30] }", "")
            .replace("100 }", &format!("{} }}", 100.0 * strength));
        let weak = lamp("sphere = { radius = 1, center = [0, 0, 3] }", "");
        check("weak first", &plane("[6, 0, 6]", &format!("{weak}{hidden}")), 512, 8, 50.0 / 9.0);
        check("weak last", &plane("[6, 0, 6]", &format!("{hidden}{weak}")), 512, 8, 50.0 / 9.0);
    }
}

#[test]
fn a_bounded_path_ends_after_its_last_light() {
    let bounded = |text: String| text.replace("filter = \"box\"", "filter = \"box\", max_depth = 1");
    let sphere = plane("[6, 0, 6]", &lamp("sphere = { radius = 1, center = [0, 0, 3] }", ""));
    check("lamp at depth 1", &bounded(sphere), 256, 8, 50.0 / 9.0);
    let sky = plane("[6, 0, 6]", "environment.constant = { spectrum = \"E\", luminance = 100 }");
    check("environment at depth 1", &bounded(sky), 16, 8, 50.0);
}

/// Six lamps that leave no gap around an object: the same light as a constant environment, but found by sampling too.
fn room(object: &str) -> String {
    let walls = [DVec3::X, DVec3::Y, DVec3::Z].into_iter().flat_map(|axis| [axis, -axis]).map(|normal| {
        let (center, normal) = ((-4.0 * normal).to_array(), normal.to_array());
        lamp(&format!("rectangle = {{ size = [8, 8], center = {center:?}, normal = {normal:?} }}"), "")
    });
    format!(
        "{HEAD}camera = {{ position = [0, -3.9, 1], look_at = [0, 0, 0], fov = 6 }}\n{object}\n{}",
        walls.collect::<String>()
    )
}

#[test]
fn a_room_of_lamps_is_a_furnace() {
    let ball = |material: String| {
        format!("materials.m = {material}\n[[objects]]\nmaterial = \"m\"\nshape.sphere = {{ radius = 1 }}\n")
    };
    check("grey ball", &room(&ball("{ diffuse = { reflectance = 0.5 } }".into())), 64, 8, 50.0);
    for alpha in [0.02, 0.1, 0.4, 1.0] {
        let metal = ball(format!("{{ conductor = {{ ior = {{ n = 0.2, k = 3 }}, roughness = {alpha} }} }}"));
        let sky = format!(
            "{HEAD}camera = {{ position = [0, -3.9, 1], look_at = [0, 0, 0], fov = 6 }}
            environment.constant = {{ spectrum = \"E\", luminance = 100 }}\n{metal}"
        );
        let overrides = Overrides { samples: Some(1024), ..Overrides::default() };
        let renders = replicates(&sky, &overrides, 100, 16);
        let expected = renders.iter().map(|xyz| xyz[1]).sum::<f64>() / 16.0;
        check(&format!("metal of roughness {alpha}"), &room(&metal), 256, 8, expected);
    }
}

/// Camera positions over a level surface and the cosines of the angles under which they see it.
const VIEWS: [(&str, f64); 2] = [("[0.01, 0, 6]", 1.0), ("[6, 0, 6.5]", std::f64::consts::FRAC_1_SQRT_2)];

fn under(camera: &str, more: &str) -> String {
    format!("{HEAD}camera = {{ position = {camera}, look_at = [0, 0, 0.5], fov = 0.05 }}\n{more}")
}

const SKY: &str = "environment.constant = { spectrum = \"E\", luminance = 100 }\n";

/// Cosine after refraction from vacuum.
fn refracted(cos: f64, n: f64) -> f64 {
    (1.0 - (1.0 - cos * cos) / (n * n)).sqrt()
}

#[test]
fn gold_looks_as_its_medium_makes_it() {
    const GOLD: &str =
        "materials.g.conductor = { ior = { n = 0.2, k = 3 } }\nmaterials.w.dielectric = { ior = 1.33 }\n";
    const SHEET: &str =
        "[[objects]]\nmaterial = \"g\"\nshape.rectangle = { size = [190, 190], center = [0, 0, 0.1] }\n";
    const WATER: &str = "[[objects]]\nmaterial = \"w\"\nshape.box = { size = [200, 200, 1] }\n";
    for (camera, cos) in VIEWS {
        let surface = reflect(1.0, 1.33, 0.0, cos).r;
        let gold = reflect(1.33, 0.2, 3.0, refracted(cos, 1.33)).r;
        let expected = surface + (1.0 - surface) * (1.0 - surface) * gold / (1.0 - surface * gold);
        check("under water", &under(camera, &format!("{SKY}{GOLD}{WATER}{SHEET}")), 256, 8, 100.0 * expected);
        let all_wet = format!("outside = \"w\"\n{}", under(camera, &format!("{SKY}{GOLD}{SHEET}")));
        check("all in water", &all_wet, 16, 8, 100.0 * reflect(1.33, 0.2, 3.0, cos).r);
    }
}

#[test]
fn a_slab_that_absorbs_shows_the_series_of_its_reflections() {
    for (camera, cos) in VIEWS {
        let r = reflect(1.0, 1.5, 0.0, cos).r;
        let tau = (-0.7 / refracted(cos, 1.5)).exp();
        let expected = r + (1.0 - r) * (1.0 - r) * tau * (1.0 + r * tau) / (1.0 - r * r * tau * tau);
        let slab = "materials.w.dielectric = { ior = 1.5, absorption = 0.7 }
            [[objects]]\nmaterial = \"w\"\nshape.box = { size = [200, 200, 1] }\n";
        for lanes in [1, 8] {
            check("slab", &under(camera, &format!("{SKY}{slab}")), 1024, lanes, 100.0 * expected);
        }
    }
}

#[test]
fn a_lamp_in_glass_is_dimmer_by_the_square_of_the_index() {
    let glass =
        "materials.w.dielectric = { ior = 1.5 }\n[[objects]]\nmaterial = \"w\"\nshape.box = { size = [20, 20, 4] }\n";
    let text = under("[0.01, 0, 6]", &format!("{glass}{}", lamp("sphere = { radius = 0.5 }", "")));
    for lanes in [1, 8] {
        check("lamp in glass", &text, 256, lanes, 100.0 * 0.96 / 2.25);
    }
}

#[test]
fn surroundings_that_absorb_dim_what_they_fill() {
    // A lamp so small that its light is E = L π r²/d², through smoke on both ways. Its visible points lie 2/3 of the radius
    // before its centre in the mean.
    let lamp = lamp("sphere = { radius = 0.01, center = [0, 0, 3] }", "").replace("= 100 ", "= 1000000 ");
    let smoke = "materials.smoke.dielectric = { ior = 1, absorption = 0.2 }\n";
    let text = format!("outside = \"smoke\"\n{}", plane("[6, 0, 6]", &format!("{smoke}{lamp}")));
    let expected = 0.5e6 * 1e-4 / 9.0 * (-0.2 * (72f64.sqrt() + 3.0 - 0.02 / 3.0)).exp();
    check("smoke", &text, 256, 8, expected);
}

#[test]
fn overlapping_solids_refract_once_between_two_media() {
    let text = under(
        "[6, 0, 6.5]",
        "environment.gradient.zenith = { spectrum = \"E\", luminance = 0 }
        environment.gradient.horizon = { spectrum = \"E\", luminance = 0 }
        environment.gradient.nadir = { spectrum = \"E\", luminance = 100 }
        materials.a.dielectric = { ior = 1.5 }
        materials.b.dielectric = { ior = 1.0 }
        [[objects]]\nmaterial = \"a\"\nshape.box = { size = [2000, 2000, 1] }
        [[objects]]\nmaterial = \"b\"\nshape.box = { size = [2000, 2000, 1], center = [0, 0, -0.9] }",
    );
    let cos = std::f64::consts::FRAC_1_SQRT_2;
    let r = reflect(1.0, 1.5, 0.0, cos).r;
    check("overlap", &text, 256, 8, 100.0 * cos * (1.0 - r) / (1.0 + r));
}

#[test]
fn light_of_known_strength_has_it() {
    let sky = |light: &str| under("[0.01, 0, 6]", &format!("environment.constant = {light}\n"));
    // Planck's law through the observer, integrated apart from this program: 683 ∫ L ȳ dλ at platinum's melting point.
    check("platinum point", &sky("{ spectrum = { blackbody = 2041.4 } }"), 256, 8, 596_459.6);
    // 47 W/m²sr over 470 nm; the observer's ȳ integrates to 106.8569 nm.
    check("radiance", &sky("{ spectrum = \"E\", radiance = 47 }"), 256, 8, 683.0 * 0.1 * 106.8569);
}

#[test]
fn a_prism_shows_the_sky_where_refraction_says() {
    for (n, height) in [(1.5, 1.5), (1.78, 0.5), (2.4, -2.0)] {
        let text = format!("{HEAD}{}", prism::scene(&n.to_string(), height));
        for lanes in [1, 8] {
            check(&format!("prism of index {n}"), &text, 1024, lanes, prism::expected(n, height));
        }
    }
}

#[test]
fn a_lens_spreads_a_lamp_but_loses_none_of_its_light() {
    // A lamp far out of focus, wholly in the picture with its blur: the mean over the picture stays what a pinhole sees.
    let text = |lens: &str| {
        format!(
            "meters_per_unit = 0.001\nrender = {{ width = 32, height = 32, filter = \"box\" }}
            camera = {{ position = [0, -100, 0], look_at = [0, 0, 0], focal_length_mm = 50, {lens} }}
            [[objects]]\nshape.sphere = {{ radius = 6 }}\nemission = {{ spectrum = \"E\", luminance = 100 }}"
        )
    };
    let overrides = Overrides { samples: Some(1024), ..Overrides::default() };
    let pinhole = replicates(&text(""), &overrides, 0, 16).iter().map(|xyz| xyz[1]).sum::<f64>() / 16.0;
    // Distances from the opening to the lamp differ by so little that the solid angle changes by (r/d)² ≈ 2e-4 at most.
    check("lens in focus", &text("f_number = 16"), 1024, 8, pinhole);
    check("lens out of focus", &text("f_number = 16, focus_distance = 30, blades = 6"), 1024, 8, pinhole);
}

#[test]
fn a_sun_gives_its_illuminance_and_mirrors_show_its_disk() {
    let sun = |angle: f64| {
        format!("[[suns]]\ndirection = [1.7320508, 0, 1]\nangle = {angle}\nspectrum = \"E\"\nilluminance = 1000\n")
    };
    // From 60° off the normal: ρ/π E cos θ.
    for angle in [0.533, 20.0] {
        check("sun on a plane", &plane("[6, 0, 6]", &sun(angle)), 256, 8, 0.5 / std::f64::consts::PI * 500.0);
    }
    // A mirror of R = 1 in all but name looks into a sun that fills the picture: L = E/(π sin²).
    let mirror = "materials.m.conductor = { ior = { n = 1e-6, k = 1 } }\n[[objects]]\nmaterial = \"m\"\nshape.rectangle = { size = [9, 9] }\n";
    let view = under("[-17.320508, 0, 10]", &format!("{mirror}{}", sun(20.0))).replace("[0, 0, 0.5]", "[0, 0, 0]");
    check("sun in a mirror", &view, 16, 8, 1000.0 / std::f64::consts::PI / 10f64.to_radians().sin().powi(2));
    // Half a furnace: rough metal sees the sun by both ways of finding it.
    let rough = mirror.replace("k = 1 }", "k = 1 }, roughness = 0.3");
    let dome = |sky: &str, sun: &str| under("[0.01, 0, 6]", &format!("{sky}{rough}{sun}"));
    let overrides = Overrides { samples: Some(1024), ..Overrides::default() };
    let sky = replicates(&dome(SKY, ""), &overrides, 50, 16).iter().map(|xyz| xyz[1]).sum::<f64>() / 16.0;
    let half_sky = format!(
        "[[suns]]\ndirection = [0, 0, 1]\nangle = 179.99\nspectrum = \"E\"\nilluminance = {}\n",
        100.0 * std::f64::consts::PI
    );
    check("a sun as wide as the sky", &dome("", &half_sky), 1024, 8, sky);
}

#[test]
fn a_point_light_gives_its_intensity_within_its_cone() {
    use std::f64::consts::PI;
    let point = |keys: &str| format!("[[points]]\nposition = [1.5, 0, 2]\nspectrum = \"E\"\n{keys}\n");
    // At r = 2.5 m, cos θ = 0.8: L = ρ/π I cos θ / r².
    let at_origin = |candela: f64| 0.5 / PI * candela * 0.8 / 6.25;
    let scene = |keys: &str| plane("[6, 0, 6]", &point(keys));
    check("point light", &scene("luminous_intensity = 1000"), 4, 8, at_origin(1000.0));
    check("point light by its flux", &scene("luminous_flux = 1000"), 512, 1, at_origin(1000.0 / (4.0 * PI)));
    let toward = "direction = [-1.5, 0, -2]\n";
    let cone = |keys: &str| scene(&format!("{toward}{keys}"));
    let cap = 2.0 * PI * (1.0 - 15f64.to_radians().cos());
    check("cone", &cone("cone_angle = 30\nluminous_flux = 100"), 4, 8, at_origin(100.0 / cap));
    // The origin is off the axis, where the cone fades.
    let axis = glam::DVec3::new(-1.5, 0.2, -2.0).normalize();
    let cosine = axis.dot(glam::DVec3::new(-0.6, 0.0, -0.8));
    let (full, none) = (2f64.to_radians().cos(), 10f64.to_radians().cos());
    let t = (cosine - none) / (full - none);
    assert!((0.1..0.9).contains(&t));
    let keys = "direction = [-1.5, 0.2, -2]\ncone_angle = 20\nfade = 8\nluminous_intensity = 100";
    // (The fade bends within what a wider picture would show.)
    let narrow = scene(keys).replace("fov = 0.05", "fov = 0.005");
    check("fading cone", &narrow, 4, 8, at_origin(100.0 * t * t * (3.0 - 2.0 * t)));
    // Twice the metres, a quarter of the light.
    let larger = scene("luminous_intensity = 1000").replace("meters_per_unit = 1", "meters_per_unit = 2");
    check("larger scene", &larger, 4, 8, at_origin(1000.0) / 4.0);
}
