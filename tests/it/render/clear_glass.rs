//! White furnaces for smooth clear solids: where all light has one radiance, glass cannot be seen, whatever it is made of.
//!
//! Balls, boxes and meshes, alone, in each other and touching, in air and in water; and seen from within, where the furnace is n²
//! brighter in every direction from which light can come, and dark in those that total reflection closes. A hundredth of
//! absorption must be seen.

use crate::common::compare::{luminances, renders};
use crate::common::files::{cuboid, obj, ply};
use crate::common::meshes;
use crate::common::plates::{check, looking};
use crate::common::{film, lanes::with, mean, mean_and_error, scene};
use glam::DVec3;
use spectrel::geometry::Triangles;
use std::path::Path;

const SKY: &str = "environment.constant = { spectrum = \"E\", luminance = 100 }\n";

fn furnace(camera: DVec3, width: f64, objects: &str) -> String {
    let head = looking(camera, DVec3::ZERO, 64)
        .replace("0.05 }", &format!("{width} }}"))
        .replace("width = 8, height = 8", "width = 24, height = 24");
    format!(
        "{head}{SKY}
        materials.glass.dielectric = {{ ior = 1.5, absorption = 0 }}
        materials.sf11.dielectric = {{ ior = \"SCHOTT/sf11\", absorption = 0 }}
        materials.water.dielectric = {{ ior = \"H2O/daimon-2007-20c\", absorption = 0 }}
        materials.grey.dielectric = {{ ior = 1.5, absorption = 0.01 }}
        {objects}"
    )
}

const CAMERA: DVec3 = DVec3::new(3.0, -7.0, 5.0);

/// Without the smooth normals of what it stands for, which no furnace is white to.
fn ring(folder: &Path) -> String {
    ply(folder, "ring", &Triangles { normals: Vec::new(), ..meshes::torus(48, 24, 0.4) })
}

fn solids(folder: &Path) -> Vec<(&'static str, String)> {
    let mesh = |name: &str, mesh| ply(folder, name, mesh);
    vec![
        ("ball", "shape.sphere = { radius = 1 }".into()),
        ("box", "shape.box = { size = [1.5, 1.3, 1] }\ntransform.rotate = [10, 20, 30]".into()),
        ("brilliant", "shape.brilliant = { diameter = 2 }\ntransform.translate = [0, 0, -0.5]".into()),
        ("flat mesh of a ball", mesh("ball", &meshes::icosphere(3))),
        ("mesh of a box", obj(folder, "box", &cuboid([0.0; 3], [1.5, 1.3, 1.0])) + "\ntransform.rotate = [10, 20, 30]"),
        ("ring", ring(folder)),
    ]
}

/// How far a scene may be off that nothing can be seen in, as a share.
///
/// Light that total reflection holds goes on for hundreds of bounces, and late in a path a few in a hundred are let go, their light given
/// to the others: right in the mean, but with a long tail.
const HELD: f64 = 1e-3;

fn invisible(name: &str, text: &str) {
    let found = luminances(&renders(&mut scene(text, &with(8, 16)), 0..16));
    let (mean, error) = mean_and_error(&found);
    println!("{name}: {mean:.5} ± {error:.5}");
    assert!((mean / 100.0 - 1.0).abs() < HELD, "{name}: {mean} ± {error}");
}

#[test]
fn clear_solids_are_invisible_whatever_they_are_made_of() {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, shape) in solids(folder.path()) {
        for material in ["glass", "sf11"] {
            let object = format!("[[objects]]\nmaterial = \"{material}\"\n{shape}\n");
            let text = furnace(CAMERA, 2.4, &object);
            invisible(&format!("{name} of {material}"), &text);
            invisible(&format!("{name} of {material} in water"), &format!("outside = \"water\"\n{text}"));
        }
    }
}

/// The counter-check: what would be seen of all these if a hundredth of the light were lost on a way as long as they are.
#[test]
fn a_hundredth_of_absorption_is_seen() {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, shape) in solids(folder.path()) {
        let text = furnace(CAMERA, 2.4, &format!("[[objects]]\nmaterial = \"grey\"\n{shape}\n"));
        let mean = mean(&film(&scene(&text, &with(8, 64))))[1];
        println!("{name}: {mean:.3}");
        assert!(mean < 100.0 * (1.0 - HELD), "{name}: {mean}");
    }
}

#[test]
fn heaps_of_clear_solids_are_invisible() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let ring = ring(folder);
    let block = obj(folder, "block", &cuboid([0.0, 0.0, -0.5], [1.6, 1.6, 1.0]));
    let objects = |list: &[(&str, &str)]| {
        list.iter()
            .map(|(material, shape)| format!("[[objects]]\nmaterial = \"{material}\"\n{shape}\n"))
            .collect::<String>()
    };
    let turned = "transform.rotate = [25, -10, 40]";
    let heaps = [
        (
            "three blocks that meet in an edge",
            objects(&[
                ("glass", &format!("shape.box = {{ size = [1, 1, 1], center = [0.5, 0, 0.5] }}\n{turned}")),
                ("water", &format!("shape.box = {{ size = [1, 1, 1], center = [-0.5, 0, 0.5] }}\n{turned}")),
                ("sf11", &format!("{block}\n{turned}")),
            ]),
        ),
        (
            "a ball half in a block",
            objects(&[("sf11", "shape.sphere = { radius = 0.6 }"), ("water", &format!("{block}\n{turned}"))]),
        ),
        (
            "a ring in a ball in a ball",
            objects(&[
                ("glass", "shape.sphere = { radius = 0.9 }\npriority = -1"),
                ("sf11", &format!("{ring}\ntransform.scale = 0.5")),
                ("water", "shape.sphere = { radius = 0.4 }\npriority = -2"),
            ]),
        ),
        (
            "rings that share room",
            objects(&[
                ("glass", &format!("{ring}\ntransform = {{ scale = 0.7, rotate = [60, 0, 0] }}\npriority = 2")),
                ("water", &format!("{ring}\ntransform.scale = 0.7\npriority = 1")),
            ]),
        ),
    ];
    for (name, heap) in heaps {
        invisible(name, &furnace(CAMERA, 2.4, &heap));
    }
}

/// Solids in one another whose faces coincide and look the same way: light that has crossed both must not cross one again.
#[test]
fn solids_with_faces_in_common_are_invisible() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let block = "shape.box = { size = [1, 1, 1] }";
    let in_corner = |share: usize| {
        let at = |axis: usize| if axis < share { 0.25 } else { 0.0 };
        format!("shape.box = {{ size = [0.5, 0.5, 0.5], center = [{}, {}, {}] }}", at(0), at(1), at(2))
    };
    let cube = obj(folder, "cube", &cuboid([0.0; 3], [1.0; 3]));
    let ball = ply(folder, "ball", &meshes::icosphere(2));
    let turned = "transform.rotate = [25, -10, 40]";
    let pairs: Vec<(&str, String, String)> = vec![
        ("one face", block.into(), in_corner(1)),
        ("three faces", block.into(), in_corner(3)),
        ("a filling", block.into(), "shape.box = { size = [1, 1, 0.5], center = [0, 0, -0.25] }".into()),
        ("two boxes alike", block.into(), block.into()),
        ("two balls alike", "shape.sphere = { radius = 0.7 }".into(), "shape.sphere = { radius = 0.7 }".into()),
        ("two mesh cubes alike", cube.clone(), cube.clone()),
        ("a mesh cube and a box", cube, block.into()),
        ("two mesh balls alike", ball.clone(), ball),
    ];
    for (name, first, second) in pairs {
        for second_material in ["water", "glass"] {
            let objects = [("glass", &first), (second_material, &second)]
                .map(|(material, shape)| format!("[[objects]]\nmaterial = \"{material}\"\n{shape}\n{turned}\n"));
            invisible(&format!("{name}, glass and {second_material}"), &furnace(CAMERA, 2.4, &objects.concat()));
        }
    }
    let three = "[[objects]]\nmaterial = \"glass\"\nshape.sphere = { radius = 0.7 }\ncopies = [{}, {}, {}]\n";
    invisible("three balls alike", &furnace(CAMERA, 2.4, three));
}

/// From within, along one line of sight.
/// Roulette looks at the path's throughput, in which n² must not be: a path that enters glass would be let go by chance, though it
/// carries as much light as before. With 256 samples a pixel has each set of wavelengths once, so that, where nothing is absorbed
/// and no path is let go, every pixel is white whatever its paths were.
#[test]
fn no_path_is_let_go_in_clear_glass() {
    let dense = "materials.dense.dielectric = { ior = 2.4, absorption = 0 }\n";
    let shapes = [("ball", "shape.sphere = { radius = 1 }"), ("box", "shape.box = { size = [1.5, 1.3, 1] }")];
    for (name, shape) in shapes {
        let object = format!("{dense}[[objects]]\nmaterial = \"dense\"\n{shape}\n");
        let outside = furnace(CAMERA, 2.4, &format!("{object}transform.rotate = [10, 20, 30]\n"));
        let within = furnace(DVec3::new(0.0, 0.0, 0.3), 1e-3, &object);
        for (place, text, white) in [("outside", outside, 100.0), ("within", within, 2.4 * 2.4 * 100.0)] {
            let found = film(&scene(&text, &with(8, 256)));
            let off = |y: f64| (y / white - 1.0).abs();
            let worst = found.pixels().iter().map(|pixel| off(pixel.mean()[1])).fold(0.0, f64::max);
            println!("{name} from {place}: {worst:.1e}");
            assert!(worst < 2e-5, "{name} from {place}: {worst:e}");
        }
    }
}

#[test]
fn a_furnace_is_n_squared_brighter_from_within_glass() {
    let folder = tempfile::tempdir().expect("a folder");
    let squared = 1.5 * 1.5 * 100.0;
    let mesh = ply(folder.path(), "cube", &cuboid([0.0; 3], [2.0; 3]));
    let shapes =
        [("ball", "shape.sphere = { radius = 1 }"), ("box", "shape.box = { size = [2, 2, 2] }"), ("mesh", &mesh)];
    for (name, shape) in shapes {
        let glass = format!("[[objects]]\nmaterial = \"glass\"\n{shape}\n");
        let text = furnace(DVec3::new(0.0, 0.0, 0.5), 1e-3, &glass);
        check(&format!("within a {name}"), &mut scene(&text, &with(8, 16)), squared, &[1.001 * squared, squared / 1.5]);
    }
    // A line that meets the ball's surface at a sine of 0.6 leaves it (0.6 < 1/1.5), one at 0.7 never does.
    let glass = "[[objects]]\nmaterial = \"glass\"\nshape.sphere = { radius = 1 }\n";
    let from = |x: f64| {
        let (from, at) = (DVec3::new(x, 0.0, 0.0), DVec3::new(x, 0.0, -1.0));
        let text = furnace(from, 1e-3, glass);
        text.replace("look_at = [0.0, 0.0, 0.0]", &format!("look_at = {:?}", at.to_array()))
    };
    check("off the middle", &mut scene(&from(0.6), &with(8, 64)), squared, &[1.001 * squared]);
    let dark = mean(&film(&scene(&from(0.7), &with(8, 64))));
    assert_eq!(dark, [0.0; 3], "light that total reflection keeps out");
}
