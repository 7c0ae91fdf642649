//! Opaque sheets and solids that lie on faces of clear solids, in either order of the objects.
//!
//! A sheet on a face is in optical contact: from outside it is seen in the outer medium, from
//! within in the glass, and where it lies the glass has no boundary. Expected are closed forms, and
//! furnaces: a lamp of n² × 100 cd/m² that shines into glass, in surroundings of 100, is the same
//! light as the surroundings themselves, so glass of any shape and index vanishes. A film of air
//! between, or the boundary in front of the sheet, must be rejected.

use crate::common::files::{cuboid, obj};
use crate::common::plates::{check, fresnel};
use crate::common::{film, lanes::with, library, scene};
use glam::{DMat3, DVec3};
use spectrel::film::Window;
use spectrel::fresnel::exact::reflect;
use spectrel::geometry::{Brilliant, Triangles};
use spectrel::render::first_hits;
use spectrel::scene::Needs;
use std::path::Path;

const N: f64 = 1.5;
const METAL: (f64, f64) = (0.2, 3.0);
const SKY: &str = "environment.constant = { spectrum = \"E\", luminance = 100 }\n";
const LIT: &str = "emission = { spectrum = \"E\", luminance = 100 }";

/// Where a scene is put as a whole: nothing but rounding may change.
#[derive(Clone, Copy, Debug)]
struct Place {
    scale: f64,
    turned: bool,
}

const PLACES: [Place; 4] = [
    Place { scale: 1.0, turned: false },
    Place { scale: 1.0, turned: true },
    Place { scale: 1e-3, turned: true },
    Place { scale: 1e3, turned: true },
];
const HERE: Place = PLACES[0];

impl Place {
    fn of(self, p: DVec3) -> DVec3 {
        let [x, y, z] = [10f64, 20.0, 30.0].map(f64::to_radians);
        let turn = DMat3::from_rotation_z(z) * DMat3::from_rotation_y(y) * DMat3::from_rotation_x(x);
        self.scale * if self.turned { turn * p } else { p }
    }

    fn transform(self) -> String {
        let rotate = if self.turned { "[10, 20, 30]" } else { "[0, 0, 0]" };
        format!("transform = {{ scale = {}, rotate = {rotate} }}", self.scale)
    }

    /// Seen from one point towards another along parallel rays.
    fn looking(self, from: DVec3, at: DVec3) -> String {
        let [from, at, up] = [from, at, DVec3::Y].map(|p| self.of(p).to_array());
        format!(
            "meters_per_unit = 1\nrender = {{ width = 8, height = 8, filter = \"box\" }}
            camera = {{ position = {from:?}, look_at = {at:?}, up = {up:?}, orthographic_width = {} }}\n",
            0.05 * self.scale
        )
    }

    fn object(self, name: &str, what: &str) -> String {
        format!("[[objects]]\nname = \"{name}\"\n{what}\n{}\n", self.transform())
    }

    /// Glass and a sheet, in both orders.
    fn both(self, glass: &str, sheet: &str) -> [String; 2] {
        let (glass, sheet) = (self.object("glass", &format!("material = \"g\"\n{glass}")), self.object("sheet", sheet));
        [format!("{glass}{sheet}"), format!("{sheet}{glass}")]
    }
}

fn materials(glass: &str) -> String {
    let (n, k) = METAL;
    format!(
        "materials.g.dielectric = {{ {glass} }}
        materials.water.dielectric = {{ ior = 1.33 }}
        materials.grey.diffuse.reflectance = 0.5
        materials.m.conductor = {{ ior = {{ n = {n}, k = {k} }} }}\n"
    )
}

fn clear() -> String {
    materials(&format!("ior = {N}"))
}

/// A triangle mesh that fills a square.
fn square(z: f32, half: f32) -> Triangles {
    let corner = |x: f32, y: f32| glam::Vec3::new(half * x, half * y, z);
    Triangles {
        positions: vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)],
        indices: vec![[0, 1, 2], [0, 2, 3]],
        ..Triangles::default()
    }
}

/// Shapes of a block of glass between z = 0 and 1, and of sheets at z = 1 that shine upwards:
/// smaller and larger than it.
fn blocks(folder: &Path) -> [String; 2] {
    let mesh = obj(folder, "block", &cuboid([0.0, 0.0, 0.5], [100.0, 100.0, 1.0]));
    ["shape.box = { center = [0, 0, 0.5], size = [100, 100, 1] }".into(), mesh]
}

fn sheets(folder: &Path) -> [String; 5] {
    [
        "shape.rectangle = { center = [0, 0, 1], size = [100, 100] }".into(),
        "shape.rectangle = { center = [0, 0, 1], size = [7, 9] }".into(),
        "shape.rectangle = { center = [0, 0, 1], size = [300, 200] }".into(),
        "shape.disk = { center = [0, 0, 1], radius = 3 }".into(),
        obj(folder, "sheet", &square(1.0, 4.0)),
    ]
}

/// Radiance over all angles that a face of index n reflects from a side, by Fresnel on paper.
fn diffuse_reflectance(n1: f64, n2: f64) -> f64 {
    let steps = 20_000;
    let cos2 = |i: i32| (f64::from(i) + 0.5) / f64::from(steps);
    (0..steps).map(|i| fresnel(n1, n2, cos2(i).sqrt()).0).sum::<f64>() / f64::from(steps)
}

#[test]
fn a_sheet_on_glass_is_seen_in_air_from_outside() {
    let folder = tempfile::tempdir().expect("a folder");
    let (n, k) = METAL;
    for place in PLACES {
        for glass in blocks(folder.path()) {
            for sheet in sheets(folder.path()) {
                for cos in [1.0, 0.4f64] {
                    let from = DVec3::new(9.0 * (1.0 - cos * cos).sqrt(), 0.0, 1.0 + 9.0 * cos);
                    let head = place.looking(from, DVec3::Z) + SKY + &clear();
                    let metal = 100.0 * reflect(1.0, n, k, cos).r;
                    for (kind, light) in [(LIT, 100.0), ("material = \"grey\"", 50.0), ("material = \"m\"", metal)] {
                        for objects in place.both(&glass, &format!("{kind}\n{sheet}")) {
                            let name = format!("{kind}, {sheet} on {glass}, cos {cos}, {place:?}");
                            let found = crate::common::mean(&film(&scene(&(head.clone() + &objects), &with(8, 16))))[1];
                            assert!((found / light - 1.0).abs() < 3e-5, "{name}: {found} for {light}");
                        }
                    }
                }
            }
        }
    }
}

/// Hairs of less and more than a rounding, on either side of the face.
#[test]
fn a_hair_changes_nothing() {
    let steps = |count: i32| f32::from_bits((1.0f32.to_bits() as i32 + count) as u32);
    for height in [-40, -9, -2, -1, 1, 2, 9, 40].map(steps) {
        let glass = "shape.box = { center = [0, 0, 0.5], size = [100, 100, 1] }";
        let sheet = format!("shape.rectangle = {{ center = [0, 0, {height:?}], size = [7, 9] }}");
        let head = HERE.looking(DVec3::new(3.0, 0.0, 7.0), DVec3::Z);
        let lamp = "[[objects]]\nshape.sphere = { center = [1, 0, 3], radius = 0.2 }
            emission = { spectrum = \"E\", luminance = 10000 }\n";
        // Lit by a lamp that is aimed at: what the same sheet sends back without the glass.
        let lit = |objects: &str| {
            let text = head.clone() + &clear() + lamp + objects;
            crate::common::mean(&film(&scene(&text, &with(8, 64))))[1]
        };
        let grey = format!("material = \"grey\"\n{sheet}");
        let alone = lit(&HERE.object("sheet", &grey));
        for objects in HERE.both(glass, &grey) {
            assert!((lit(&objects) / alone - 1.0).abs() < 0.01, "{height}: {} for {alone}", lit(&objects));
        }
        let inwards = format!("{LIT}\n{}", sheet.replace("size", "normal = [0, 0, -1], size"));
        let head = HERE.looking(DVec3::new(0.0, 0.0, -8.0), DVec3::Z) + &clear();
        for objects in HERE.both(glass, &inwards) {
            let found = crate::common::mean(&film(&scene(&(head.clone() + &objects), &with(8, 256))))[1];
            let expected = 100.0 * (1.0 - fresnel(1.0, N, 1.0).0) / N / N;
            assert!((found / expected - 1.0).abs() < 0.01, "{height}: {found} for {expected}");
        }
    }
}

#[test]
#[ignore = "long: many seconds of paths"]
fn a_sheet_on_glass_is_seen_in_glass_from_within() {
    let folder = tempfile::tempdir().expect("a folder");
    let (n, k) = METAL;
    let rectangle = "shape.rectangle = { center = [0, 0, 1], size = [300, 300], normal = [0, 0, -1] }";
    for place in [PLACES[0], PLACES[1]] {
        for glass in blocks(folder.path()) {
            for cos in [1.0, 0.4f64] {
                let from = DVec3::new(9.0 * (1.0 - cos * cos).sqrt(), 0.0, -9.0 * cos);
                let head = place.looking(from, DVec3::ZERO) + SKY + &clear();
                let (r, within) = fresnel(1.0, N, cos);
                let through = |below: f64, above: f64| 100.0 * (r + (1.0 - r) * (1.0 - r) * below / (1.0 - r * above));
                let metal = reflect(N, n, k, within).r;
                let gap = r + (1.0 - r) * (1.0 - r) * reflect(1.0, n, k, cos).r / (1.0 - r * reflect(1.0, n, k, cos).r);
                let lamp = 100.0 * r + 100.0 * (1.0 - r) / N / N;
                // A grey ground under glass (J. L. Saunderson, J. Opt. Soc. Am. 32, 1942), with the
                // radiance over n² inside.
                let [out, back] = [diffuse_reflectance(1.0, N), diffuse_reflectance(N, 1.0)];
                let grey = 100.0 * (r + (1.0 - r) * 0.5 * (1.0 - out) / (1.0 - 0.5 * back) / N / N);
                for (kind, right, wrong) in [
                    (LIT, lamp, 100.0 * r + 100.0 * (1.0 - r)),
                    ("material = \"grey\"", grey, 50.0),
                    ("material = \"m\"", through(metal, metal), through(gap, gap)),
                ] {
                    for objects in place.both(&glass, &format!("{kind}\n{rectangle}")) {
                        let name = format!("{kind} on {glass}, cos {cos}, {place:?}");
                        check(&name, &mut scene(&(head.clone() + &objects), &with(8, 256)), right, &[wrong]);
                    }
                }
            }
        }
    }
}

/// Two clear solids that touch, with a sheet between: each is seen as in the solid before it.
#[test]
fn a_sheet_between_two_solids_is_in_each_of_them() {
    let (n, k) = METAL;
    let parts = [
        "[[objects]]\nmaterial = \"g\"\nshape.box = { center = [0, 0, 0.5], size = [100, 100, 1] }\n",
        "[[objects]]\nmaterial = \"water\"\nshape.box = { center = [0, 0, -0.5], size = [90, 90, 1] }\n",
        "[[objects]]\nmaterial = \"m\"\nshape.rectangle = { size = [80, 80] }\n",
    ];
    for order in [[0, 1, 2], [0, 2, 1], [2, 0, 1], [2, 1, 0], [1, 2, 0], [1, 0, 2]] {
        let objects = order.map(|i| parts[i]).concat();
        for (sign, index) in [(1.0, N), (-1.0, 1.33)] {
            let head = HERE.looking(sign * 9.0 * DVec3::Z, DVec3::ZERO) + SKY + &clear();
            let r = fresnel(1.0, index, 1.0).0;
            let light = |metal: f64| 100.0 * (r + (1.0 - r) * (1.0 - r) * metal / (1.0 - r * metal));
            let [right, wrong] = [index, 1.0].map(|index| light(reflect(index, n, k, 1.0).r));
            check(&format!("{order:?} from {sign}"), &mut scene(&(head + &objects), &with(8, 256)), right, &[wrong]);
        }
    }
}

/// A metal block under glass, beside it, and sunk into it with its top flush.
#[test]
#[ignore = "long: many seconds of paths"]
fn opaque_solids_with_a_face_in_common_cover_it_too() {
    let folder = tempfile::tempdir().expect("a folder");
    let (n, k) = METAL;
    let shape = |z: f32, height: f32| {
        [
            format!("shape.box = {{ center = [0, 0, {z}], size = [60, 60, {height}] }}"),
            obj(folder.path(), &format!("metal {z}"), &cuboid([0.0, 0.0, z], [60.0, 60.0, height])),
        ]
    };
    let (air, glass) = (100.0 * reflect(1.0, n, k, 1.0).r, reflect(N, n, k, 1.0).r);
    let r = fresnel(1.0, N, 1.0).0;
    let through = 100.0 * (r + (1.0 - r) * (1.0 - r) * glass / (1.0 - r * glass));
    for place in [PLACES[0], PLACES[1]] {
        for block in blocks(folder.path()) {
            for (where_, metals, from, right) in [
                ("upon, from above", shape(1.5, 1.0), 9.0, air),
                ("upon, from below", shape(1.5, 1.0), -9.0, through),
                ("sunk, from above", shape(0.75, 0.5), 9.0, air),
                ("sunk, from below", shape(0.75, 0.5), -9.0, through),
            ] {
                for metal in metals {
                    let head = place.looking(from * DVec3::Z, DVec3::ZERO) + SKY + &clear();
                    for objects in place.both(&block, &format!("material = \"m\"\n{metal}")) {
                        let name = format!("{metal} {where_} of {block}, {place:?}");
                        check(&name, &mut scene(&(head.clone() + &objects), &with(8, 256)), right, &[]);
                    }
                }
            }
        }
    }
}

/// The table facet of a stone with a lamp on it that shines in.
#[test]
fn a_stone_with_a_lamp_on_its_table_vanishes_in_a_furnace() {
    let cut = Brilliant { diameter: 2.0, ..Brilliant::default() };
    let solid = cut.solid().expect("a stone");
    let table = solid.bounds().max.z;
    let n_d = library().ior("C/peter-1923", Path::new("")).expect("in the library").n.at(589.3);
    for (name, ior, n) in [("of one index", "2.42", 2.42), ("dispersive", "\"C/peter-1923\"", n_d)] {
        for place in PLACES {
            let spectrum = "{ lines = [[589.3, 1]] }";
            let sky = SKY.replace("\"E\"", spectrum);
            let lamp = format!(
                "shape.rectangle = {{ center = [0, 0, {table:?}], size = [0.6, 0.6], normal = [0, 0, -1] }}
                emission = {{ spectrum = {spectrum}, luminance = {} }}",
                n * n * 100.0
            );
            let below = DVec3::new(1.0, 0.4, -9.0);
            let head = place.looking(below, DVec3::ZERO) + &sky + &materials(&format!("ior = {ior}"));
            for objects in place.both("shape.brilliant = { diameter = 2 }", &lamp) {
                let found = crate::common::mean(&film(&scene(&(head.clone() + &objects), &with(8, 256))))[1];
                assert!((found / 100.0 - 1.0).abs() < 0.01, "{name}, {place:?}: {found}");
            }
            // Seen from above it is a lamp that turns its back.
            let head = place.looking(9.0 * DVec3::Z, DVec3::ZERO) + &sky + &materials(&format!("ior = {ior}"));
            for objects in place.both("shape.brilliant = { diameter = 2 }", &lamp) {
                let found = crate::common::mean(&film(&scene(&(head.clone() + &objects), &with(8, 16))))[1];
                assert_eq!(found, 0.0, "{name}, {place:?}, from above");
            }
        }
    }
}

/// Rough glass finds the lamp by aiming at it and by chance; both together must find all of its
/// light.
#[test]
fn rough_glass_over_a_lamp_nearly_vanishes_in_a_furnace() {
    let folder = tempfile::tempdir().expect("a folder");
    for place in [PLACES[0], PLACES[1], PLACES[3]] {
        for glass in blocks(folder.path()) {
            let lamp = format!(
                "shape.rectangle = {{ size = [100, 100], center = [0, 0, 1], normal = [0, 0, -1] }}
                emission = {{ spectrum = \"E\", luminance = {} }}",
                N * N * 100.0
            );
            let rough = materials(&format!("ior = {N}, roughness = 0.1"));
            let head = place.looking(DVec3::new(2.0, 0.0, -9.0), DVec3::ZERO) + SKY + &rough;
            for objects in place.both(&glass, &lamp) {
                let found = crate::common::mean(&film(&scene(&(head.clone() + &objects), &with(8, 1024))))[1];
                assert!((found / 100.0 - 1.0).abs() < 0.01, "{glass}, {place:?}: {found}");
            }
        }
    }
}

/// Radiance of a grey point 2 under or over the middle of a lamp of 2 × 2, seen through as much as
/// √5 of what absorbs.
fn lit(absorption: f64) -> f64 {
    let steps = 400;
    let at = |i: i32| (f64::from(i) + 0.5) * 2.0 / f64::from(steps) - 1.0;
    let part = |x: f64, y: f64| {
        let r2 = x * x + y * y + 4.0;
        4.0 / (r2 * r2) * (-absorption * r2.sqrt()).exp()
    };
    let sum: f64 = (0..steps * steps).map(|i| part(at(i / steps), at(i % steps))).sum();
    50.0 / std::f64::consts::PI * sum * (2.0 / f64::from(steps)).powi(2) * (-absorption * 5f64.sqrt()).exp()
}

/// A lamp on glass that shines both ways lights what is over it as if there were no glass, and what
/// is in the glass at once. (The glass absorbs, or light that it traps would light it, too.)
#[test]
fn a_lamp_on_glass_lights_what_is_around_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let deep = obj(folder.path(), "deep", &cuboid([0.0, 0.0, -2.0], [100.0, 100.0, 6.0]));
    for place in PLACES {
        let smoky = materials(&format!("ior = {N}, absorption = {}", 1.0 / place.scale));
        for glass in ["shape.box = { center = [0, 0, -2], size = [100, 100, 6] }", &deep] {
            let lamp = "shape.rectangle = { center = [0, 0, 1], size = [2, 2] }
                emission = { spectrum = \"E\", luminance = 100, two_sided = true }";
            for (name, z, right) in [("over", 3.0, lit(0.0)), ("in", -1.0, lit(1.0))] {
                let sheet = format!("shape.rectangle = {{ center = [0, 0, {z}], size = [0.2, 0.2] }}");
                let target = place.object("target", &format!("material = \"grey\"\n{sheet}"));
                let head = place.looking(DVec3::new(2.0, 0.0, 0.5 * (1.0 + z)), z * DVec3::Z) + &smoky;
                for objects in place.both(glass, lamp) {
                    let text = head.clone() + &objects + &target;
                    let name = format!("{name} {glass}, {place:?}");
                    check(&name, &mut scene(&text, &with(8, 256)), right, &[1.01 * right]);
                }
            }
        }
    }
}

/// What the layers of a picture show is what paths meet first.
#[test]
fn layers_show_the_sheet_in_either_order() {
    let folder = tempfile::tempdir().expect("a folder");
    for glass in blocks(folder.path()) {
        for sheet in sheets(folder.path()) {
            for objects in HERE.both(&glass, &format!("material = \"grey\"\n{sheet}")) {
                let text = HERE.looking(9.0 * DVec3::Z, DVec3::ZERO) + SKY + &clear() + &objects;
                let scene = scene(&text, &with(8, 1));
                for hit in first_hits(&scene, Window::full(8, 8)) {
                    let name = &scene.objects[hit.expect("a sheet").object as usize].name;
                    assert_eq!(name, "sheet", "{sheet} on {glass}");
                }
            }
        }
    }
}

#[test]
fn it_is_told_and_only_where_it_is() {
    let told = |objects: &str| {
        let scene = scene(&(HERE.looking(9.0 * DVec3::Z, DVec3::ZERO) + SKY + &clear() + objects), &with(8, 1));
        let decisions = Needs::of(&scene).decisions;
        let contact = decisions.into_iter().find(|decision| decision.part == "media in contact").expect("a decision");
        (scene.warnings, contact)
    };
    let folder = tempfile::tempdir().expect("a folder");
    let [glass, _] = blocks(folder.path());
    for sheet in sheets(folder.path()) {
        for objects in HERE.both(&glass, &format!("{LIT}\n{sheet}")) {
            let (warnings, contact) = told(&objects);
            assert!(
                warnings.iter().any(|warning| warning.contains("`sheet` lies on a face of `glass`")),
                "{warnings:?}"
            );
            assert!(contact.used && contact.reason.contains("sheet on glass"), "{contact:?}");
        }
    }
    // A ball on a plane, a stone on its culet, a block on its edge, and a sheet with room below.
    let floor = "material = \"grey\"\nshape.rectangle = { size = [30, 30] }";
    for clear in [
        "shape.sphere = { radius = 1, center = [0, 0, 1] }",
        "shape.box = { size = [1, 1, 1], center = [0, 0, 0.5002] }",
        "shape.box = { size = [1, 1, 1], center = [15.5, 0, -0.5] }",
    ] {
        for objects in HERE.both(clear, floor) {
            let (warnings, contact) = told(&objects);
            let none = !warnings.iter().any(|warning| warning.contains("lies on"));
            assert!(!contact.used && none, "{contact:?} {warnings:?}");
        }
    }
}
