//! Mesh files in scenes: which parts stand where, of which material, seen by whose camera.

mod bodies;
mod units;

use glam::Vec3;
use spectrel::geometry::{Ray, Shape};
use spectrel::scene::{Overrides, Scene, SceneError, Surface, Text, resolve};
use std::fs;
use std::path::Path;

/// Two cubes of edge 2 around x = ±2, each of a material of its own.
fn cubes() -> String {
    let mut text = String::new();
    for (name, material, x) in [("Left", "Metal", -2.0), ("Right", "Stone", 2.0)] {
        text += &format!("o {name}\nusemtl {material}\n");
        for corner in 0..8 {
            let at = |bit: u32| if corner >> bit & 1 == 0 { -1.0 } else { 1.0 };
            text += &format!("v {} {} {}\n", x + at(0), at(1), at(2));
        }
        for face in [[1, 3, 4, 2], [5, 6, 8, 7], [1, 2, 6, 5], [3, 7, 8, 4], [1, 5, 7, 3], [2, 4, 8, 6]] {
            text += "f";
            face.iter().for_each(|corner| text += &format!(" {}", corner - 9));
            text += "\n";
        }
    }
    text
}

const HEAD: &str = "meters_per_unit = 0.001\n[render]\nwidth = 40\nheight = 20\nsamples = 4\n\
    [environment.constant]\nspectrum = \"D65\"\nluminance = 100\n";
const CAMERA: &str = "[camera]\nposition = [0, -20, 0]\nlook_at = [0, 0, 0]\nfov = 40\n";

fn resolved_in(folder: &Path, scene: &str) -> Result<Scene, SceneError> {
    resolve(Text::new(folder.join("scene.toml"), scene), &crate::common::library(), &Overrides::default())
}

fn resolved(more: &str) -> Scene {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("cubes.obj"), cubes()).unwrap();
    resolved_in(folder.path(), &[HEAD, CAMERA, more].concat()).unwrap_or_else(|error| panic!("{error}"))
}

/// The name and the material of what a ray towards −z meets at (x, y).
fn met(scene: &Scene, x: f32, y: f32) -> Option<(String, String)> {
    let hit = scene.world.closest(&Ray::free(Vec3::new(x, y, 50.0), -Vec3::Z), f32::INFINITY)?;
    let object = scene.object(hit.shape);
    Some((object.name.clone(), object.material.clone()))
}

fn pair(name: &str, material: &str) -> Option<(String, String)> {
    Some((name.to_owned(), material.to_owned()))
}

#[test]
fn materials_of_a_file_are_replaced_by_ours() {
    let scene = resolved(
        "[replace]\n\"Metal\" = \"gold\"\n\"Stone\" = \"diamond\"\n[[objects]]\nname = \"pair\"\nshape.mesh = { file = \"cubes.obj\" }\n",
    );
    assert_eq!(met(&scene, -2.0, 0.3), pair("pair: Left", "gold"));
    assert_eq!(met(&scene, 2.0, 0.3), pair("pair: Right", "diamond"));
    assert_eq!(met(&scene, 0.0, 0.0), None);
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
    assert_eq!(scene.files.len(), 1);
}

#[test]
fn an_objects_own_material_goes_before_those_of_its_file() {
    let scene = resolved(
        "[replace]\n\"Stone\" = \"diamond\"\n[[objects]]\nmaterial = \"copper\"\nshape.mesh = { file = \"cubes.obj\" }\n",
    );
    assert_eq!(met(&scene, 2.0, 0.3), pair("object 1: Right", "copper"));
    assert!(scene.warnings[0].contains("no mesh of this scene has a material `Stone`"), "{:?}", scene.warnings);
}

#[test]
fn a_part_is_an_object_of_its_own() {
    let scene = resolved(
        "[[objects]]\nname = \"ring\"\nmaterial = \"silver\"\nshape.mesh = { file = \"cubes.obj\", part = \"Right\" }\n\
         transform = { translate = [-2, 0, 0], scale = 1 }\n",
    );
    assert_eq!(scene.objects.len(), 1);
    assert_eq!(met(&scene, 0.9, 0.9), pair("ring", "silver"));
    assert_eq!(met(&scene, 1.1, 0.0), None);
}

#[test]
fn copies_share_one_mesh() {
    let scene = resolved(
        "[[objects]]\nname = \"bead\"\nmaterial = \"silver\"\nshape.mesh = { file = \"cubes.obj\", part = \"Left\" }\n\
         transform = { translate = [2, 0, 0] }\n\
         copies = [{ translate = [-5, 0, 0] }, { translate = [5, 0, 0], rotate = [0, 0, 45] }, { translate = [0, 8, 0], scale = 2 }]\n",
    );
    assert_eq!(met(&scene, -5.0, 0.9), pair("bead #1", "silver"));
    assert_eq!(met(&scene, 5.0, 1.3), pair("bead #2", "silver"));
    assert_eq!(met(&scene, 5.9, 0.9), None, "turned by 45° its corner is on the axis");
    assert_eq!(met(&scene, 1.9, 9.9), pair("bead #3", "silver"));
    assert_eq!(met(&scene, 0.0, 0.0), None, "copies stand instead of the object");
    let meshes: Vec<_> = scene.world.shapes().iter().filter_map(mesh_of).collect();
    assert!(meshes.len() == 3 && meshes.iter().all(|mesh| std::ptr::eq(*mesh, meshes[0])));
    let stones = resolved(
        "[[objects]]\nname = \"pavé\"\nmaterial = \"diamond\"\nshape.brilliant = { diameter = 1 }\n\
         copies = [{ translate = [-1, 0, 0] }, { translate = [1, 0, 0] }]\n",
    );
    assert_eq!(met(&stones, 1.0, 0.1), pair("pavé #2", "diamond"));
}

fn mesh_of(shape: &Shape) -> Option<*const spectrel::geometry::Mesh> {
    match shape {
        Shape::Mesh(placed) => Some(std::sync::Arc::as_ptr(placed.mesh())),
        _ => None,
    }
}

#[test]
fn a_dielectric_with_a_hole_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let text = cubes();
    let open: Vec<&str> = text.lines().filter(|line| *line != "f -8 -6 -5 -7").collect();
    fs::write(folder.path().join("open.obj"), open.join("\n") + "\n").unwrap();
    let object = |material: &str| {
        let scene = format!(
            "[[objects]]\nname = \"vase\"\nmaterial = \"{material}\"\nshape.mesh = {{ file = \"open.obj\", part = \"Left\" }}\n"
        );
        resolved_in(folder.path(), &[HEAD, CAMERA, &scene].concat()).unwrap()
    };
    let glass = object("SF11");
    let Shape::Mesh(placed) = &glass.world.shapes()[0] else { panic!("a mesh") };
    let open_edges = placed.mesh().surroundings().open_edges;
    assert_eq!(open_edges, 4);
    let warning = format!("`vase` is not closed: {open_edges} of its edges");
    assert!(glass.warnings.iter().any(|said| said.starts_with(&warning)), "{:?}", glass.warnings);
    let gold = object("gold").warnings;
    assert!(gold.is_empty(), "metals need no inside: {gold:?}");
}

#[test]
fn overlapping_media_are_told_and_ranked() {
    let scene = |priority: &str| {
        resolved(&format!(
            "[[objects]]\nname = \"glass\"\nmaterial = \"SF11\"\nshape.box = {{ size = [4, 4, 4] }}\n{priority}\n\
             [[objects]]\nname = \"water\"\nmaterial = \"water\"\nshape.sphere = {{ center = [2, 0, 0], radius = 1 }}\n\
             [[objects]]\nname = \"stone\"\nmaterial = \"diamond\"\nshape.box = {{ size = [1, 1, 1] }}\n"
        ))
    };
    let silent = scene("");
    assert_eq!(silent.warnings.len(), 1, "{:?}", silent.warnings);
    assert!(silent.warnings[0].starts_with("`glass` and `water` overlap: where both are, `water` fills the space"));
    let rank = |scene: &Scene| scene.objects.iter().map(|object| object.rank).collect::<Vec<_>>();
    assert_eq!(rank(&silent), [1, 2, 3], "smaller ones go before");
    let said = scene("priority = 1");
    assert!(said.warnings.is_empty(), "{:?}", said.warnings);
    assert_eq!(rank(&said), [3, 1, 2]);
}

#[test]
fn the_material_around_everything_is_there_for_objects_too() {
    let scene = |own: &str, outside: &str, object: &str| {
        let text = format!(
            "outside = \"{outside}\"\n{HEAD}{CAMERA}{own}\n[[objects]]\nmaterial = \"{object}\"\nshape.sphere = {{ radius = 1 }}\n"
        );
        crate::common::scene(&text, &Overrides::default())
    };
    let surface = |scene: &Scene| scene.surfaces[scene.objects[0].surface as usize];
    let own = "[materials.w.dielectric]\nior = 1.9\n";
    let same = scene(own, "w", "w");
    let Surface::Dielectric(interface) = surface(&same) else { panic!("w is no metal") };
    assert_eq!(interface.medium, spectrel::scene::MediumId::OUTSIDE, "in w a ball of w is not there");
    let empty = crate::common::scene(&[HEAD, CAMERA].concat(), &Overrides::default());
    let [with, without] = [&same, &empty].map(|scene| crate::common::mean(&crate::common::film(scene))[1]);
    assert!((with / without - 1.0).abs() < 1e-5, "{with} {without}");
    let other = scene(&format!("{own}[materials.v.dielectric]\nior = 1.5\n"), "w", "v");
    assert!(matches!(surface(&other), Surface::Dielectric(interface) if interface.medium.0 != 0));
    // In light from all around clear things are not seen, which is all that is to be told.
    let told = [&same, &other].map(|scene| scene.warnings.join("\n"));
    assert!(told.iter().all(|told| told.starts_with("everything here is clear") && !told.contains('\n')), "{told:?}");
}

#[test]
fn a_lamp_from_a_file_shines_whatever_its_file_calls_it() {
    let lamp = "[[objects]]\nname = \"lamp\"\nshape.mesh = { file = \"cubes.obj\", part = \"Left\" }\n\
        emission = { spectrum = \"D65\", luminance = 300 }\n";
    let scene = resolved(lamp);
    assert_eq!(met(&scene, -2.0, 0.3), pair("lamp", "light"));
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);

    let folder = tempfile::tempdir().unwrap();
    let inwards: String = cubes()
        .lines()
        .map(|line| match line.split_whitespace().collect::<Vec<_>>()[..] {
            ["f", a, b, c, d] => format!("f {d} {c} {b} {a}\n"),
            _ => format!("{line}\n"),
        })
        .collect();
    fs::write(folder.path().join("cubes.obj"), inwards).unwrap();
    let dome = |more: &str| {
        let scene = [HEAD, CAMERA, &lamp.replace("luminance = 300", &format!("luminance = 300{more}"))].concat();
        resolved_in(folder.path(), &scene).unwrap()
    };
    assert!(dome("").warnings[0].contains("its triangles face inwards"), "{:?}", dome("").warnings);
    assert!(dome(", two_sided = true").warnings.is_empty());
}

#[test]
fn lights_of_which_nothing_arrives_are_told() {
    let point = "[[points]]\nposition = [0, 0, 9]\nspectrum = \"A\"\nluminous_flux = 4\n";
    let ball = |material: &str| format!("[[objects]]\nmaterial = \"{material}\"\nshape.sphere = {{ radius = 1 }}\n");
    let text = [HEAD, CAMERA, point, &ball("gold")].concat();
    assert!(crate::common::scene(&text, &Overrides::default()).warnings[0].contains("point lights light nothing"));
    let text = ["outside = \"water\"\n", HEAD, CAMERA, &ball("gold")].concat();
    assert!(crate::common::scene(&text, &Overrides::default()).warnings[0].contains("infinitely far away"));
}

/// What is possible and hardly meant is told; the same scene put right is silent.
#[test]
fn oversights_are_told() {
    let said =
        |more: &str| crate::common::scene(&[HEAD, CAMERA, more].concat(), &Overrides::default()).warnings.join("\n");
    let check = |wrong: &str, words: &str, right: &str| {
        let (wrong, right) = (said(wrong), said(right));
        assert!(wrong.contains(words), "{words:?} is not in {wrong:?}");
        assert_eq!(right, "");
    };
    let metal = |ior: &str| {
        format!(
            "[materials.m.conductor]\nior = {ior}\n[[objects]]\nmaterial = \"m\"\nshape.sphere = {{ radius = 1 }}\n"
        )
    };
    check(&metal("{ n = 5.9, k = 0.2 }"), "`m`: n is above k at all wavelengths", &metal("{ n = 0.2, k = 5.9 }"));
    check(&metal("1.5"), "`m` is a conductor whose k is 0", &metal("\"W/weaver-1975\""));

    let panel = |normal: &str, more: &str| {
        format!(
            "{}[[objects]]\nname = \"panel\"\nshape.rectangle = {{ center = [0, 0, 9], size = [2, 2], normal = {normal} }}\n\
             emission = {{ spectrum = \"A\", luminance = 9{more} }}\n",
            metal("{ n = 0.2, k = 5.9 }")
        )
    };
    check(&panel("[0, 0, 1]", ""), "panel shines away from everything", &panel("[0, 0, -1]", ""));
    assert_eq!(said(&panel("[0, 0, 1]", ", two_sided = true")), "");

    let points = |alpha: &str, direction: &str| {
        let own = metal("{ n = 0.2, k = 5.9 }").replace("5.9 }", &format!("5.9 }}\n{alpha}"));
        let floor = "[materials.d.diffuse]\nreflectance = 0.5\n[[objects]]\nname = \"floor\"\nmaterial = \"d\"\n\
                     shape.rectangle = { center = [0, 0, -2], size = [9, 9] }\n";
        let point = "[[points]]\nposition = [0, 0, 9]\nspectrum = \"A\"\nluminous_flux = 4\ncone_angle = 30\n";
        format!("{own}{floor}{point}direction = {direction}\n")
    };
    check(
        &points("", "[0, 0, -1]"),
        "object 1 is smooth and shows no point light",
        &points("roughness = 0.2", "[0, 0, -1]"),
    );
    assert!(said(&points("roughness = 0.2", "[1, 0, 0]")).contains("a point light with a cone shines away"));

    let clear = |size: &str, more: &str| {
        format!(
            "[materials.m.dielectric]\nior = 1.5\n[[objects]]\nmaterial = \"m\"\nshape.box = {{ size = {size} }}\n{more}"
        )
    };
    let dark = "[[objects]]\nmaterial = \"gold\"\nshape.sphere = { center = [5, 0, 0], radius = 1 }\n";
    check(&clear("[1, 1, 1]", ""), "everything here is clear", &clear("[1, 1, 1]", dark));
    // Scene units are millimetres.
    check(&clear("[1, 1, 0.015]", dark), "object 1 is thinner than 20 µm", &clear("[1, 1, 0.025]", dark));
}

#[test]
fn a_mesh_far_from_the_picture_is_told_with_its_place() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("cubes.obj"), cubes()).unwrap();
    let at = |z: f64| {
        let mesh = "[[objects]]\nname = \"ring\"\nmaterial = \"gold\"\nshape.mesh = { file = \"cubes.obj\" }\n";
        let text = format!("{HEAD}{CAMERA}{mesh}transform = {{ translate = [0, 0, {z}] }}\n");
        resolved_in(folder.path(), &text).unwrap().warnings.join("\n")
    };
    assert!(at(5000.0).contains("far outside of the picture") && at(5000.0).contains("ring"), "{}", at(5000.0));
    assert_eq!(at(0.0), "");
}

/// A glTF file with one triangle and a camera that looks along +y from (1, −5, 2) of our axes, in metres.
fn filmed() -> (String, Vec<u8>) {
    let corners = [[0.0f32, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let bytes: Vec<u8> = corners.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
    let text = r#"{ "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": [0, 1] }],
        "nodes": [{ "mesh": 0 }, { "camera": 0, "name": "Close", "translation": [1, 2, 5] }],
        "cameras": [{ "name": "Close", "type": "perspective", "perspective": { "yfov": 0.5, "znear": 0.1 } }],
        "meshes": [{ "name": "Tri", "primitives": [{ "attributes": { "POSITION": 0 } }] }],
        "accessors": [{ "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0] }],
        "bufferViews": [{ "buffer": 0, "byteLength": 36 }], "buffers": [{ "uri": "tri.bin", "byteLength": 36 }] }"#;
    (text.to_owned(), bytes)
}

#[test]
fn a_files_camera_is_ours() {
    let folder = tempfile::tempdir().unwrap();
    let (text, bytes) = filmed();
    fs::write(folder.path().join("tri.gltf"), text).unwrap();
    fs::write(folder.path().join("tri.bin"), bytes).unwrap();
    let object = "[[objects]]\nmaterial = \"gold\"\nshape.mesh = { file = \"tri.gltf\" }\n";
    let camera = |keys: &str| resolved_in(folder.path(), &[HEAD, "[camera]\n", keys, object].concat());
    let scene = camera("file = \"tri.gltf\"\n").unwrap();
    let middle = scene.camera.ray(20.0, 10.0, || [0.5, 0.5]);
    assert!(
        (middle.origin - Vec3::new(1e3, -5e3, 2e3)).length() < 1e-3 && (middle.direction - Vec3::Y).length() < 1e-6
    );
    // The upper edge is half of yfov above the middle.
    let top = scene.camera.ray(20.0, 0.0, || [0.5, 0.5]);
    assert!((top.direction.z.atan2(top.direction.y) - 0.25).abs() < 1e-5);
    let named = camera("file = \"tri.gltf\"\nnamed = \"Close\"\nposition = [0, -9, 0]\nfov = 90\n").unwrap();
    assert!((named.camera.ray(20.0, 10.0, || [0.5, 0.5]).origin - Vec3::new(0.0, -9.0, 0.0)).length() < 1e-6);
    let left = named.camera.ray(0.0, 10.0, || [0.5, 0.5]).direction;
    assert!((left.x.abs() - left.y).abs() < 1e-5);
    for (keys, says) in [
        ("file = \"tri.gltf\"\nnamed = \"Clse\"\n", "did you mean `Close`?"),
        ("named = \"Close\"\nposition = [0, 0, 1]\nlook_at = [0, 0, 0]\nfov = 30\n", "`named` goes with `file`"),
        ("fov = 30\n", "missing `position`"),
    ] {
        let error = camera(keys).unwrap_err().to_string();
        assert!(error.contains(says), "{error}");
    }
}

/// The same scene by a box and by a closed mesh of it has the same picture but for noise: here without noise, one bit of it.
#[test]
fn gold_cubes_are_gold_cubes() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("cubes.obj"), cubes()).unwrap();
    let look = |shape: &str| {
        let scene = [HEAD, CAMERA, "[[objects]]\nmaterial = \"gold\"\n", shape].concat();
        crate::common::mean(&crate::common::film(&resolved_in(folder.path(), &scene).unwrap()))
    };
    let mesh = look("shape.mesh = { file = \"cubes.obj\", part = \"Left\" }\n");
    let cuboid = look("shape.box = { center = [-2, 0, 0], size = [2, 2, 2] }\n");
    for (a, b) in mesh.iter().zip(cuboid) {
        assert!((a / b - 1.0).abs() < 1e-4, "{mesh:?} {cuboid:?}");
    }
    assert!(matches!(
        resolved_in(
            folder.path(),
            &[HEAD, CAMERA, "[[objects]]\nmaterial = \"gold\"\nshape.mesh = { file = \"cubes.obj\" }\n"].concat()
        )
        .unwrap()
        .surfaces[0],
        Surface::Conductor { .. }
    ));
}

/// Smooth normals keep a metal's light, but for what they throw below the triangles; of a white surface the softened terminator takes a
/// little, as its head says.
#[test]
fn smooth_metal_is_invisible_in_a_furnace() {
    let look = |material: &str, crease: u32| {
        let text = format!(
            "render = {{ width = 60, height = 40, samples = 64 }}
            camera = {{ position = [0, -60, 30], look_at = [0, 0, 0], fov = 24 }}
            environment.constant = {{ spectrum = \"E\", luminance = 100 }}
            materials.m.{material}
            [[objects]]\nmaterial = \"m\"
            shape.mesh = {{ file = \"meshes/ring.obj\", crease_angle = {crease} }}\ntransform.rotate = [20, 0, 0]\n"
        );
        let scene = resolve(Text::new("scenes/furnace.toml", text), &crate::common::library(), &Overrides::default());
        crate::common::mean(&crate::common::film(&scene.unwrap()))[1]
    };
    let mirror = "conductor = { ior = { n = 1e-6, k = 1 } }";
    for (crease, tolerance) in [(0, 1e-4), (50, 3e-4)] {
        let found = look(mirror, crease);
        assert!((found / 100.0 - 1.0).abs() < tolerance, "crease angle {crease}: {found}");
    }
    let white = look("diffuse.reflectance = 1", 50);
    assert!((99.3..=100.01).contains(&white), "{white}");
}
