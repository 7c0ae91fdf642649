//! Clear bodies however their files cut, double or wind them.

use crate::common::paper::agrees;
use crate::common::{film, library, mean};
use serde_json::json;
use spectrel::geometry::Shape;
use spectrel::scene::{Overrides, Scene, SceneError, Text, resolve};
use std::fs;
use tempfile::TempDir;

/// A right-angled prism, its hypotenuse up.
const CORNERS: [[f32; 3]; 6] =
    [[-1.0, -9.0, 0.0], [1.0, -9.0, 0.0], [0.0, -9.0, -1.0], [-1.0, 9.0, 0.0], [1.0, 9.0, 0.0], [0.0, 9.0, -1.0]];

const VERTICES: &str = "v -1 -9 0\nv 1 -9 0\nv 0 -9 -1\nv -1 9 0\nv 1 9 0\nv 0 9 -1\n";
const TOP: &str = "f 1 2 5 4\n";
const LEFT: &str = "f 1 4 6 3\n";
const RIGHT: &str = "f 2 3 6 5\n";
const ENDS: &str = "f 1 3 2\nf 4 5 6\n";

/// Looks straight down on the hypotenuse; only the zenith shines.
const SCENE: &str = "
    render = { width = 6, height = 6, samples = 16 }
    camera = { position = [0.3, 0, 9], look_at = [0.3, 0, 0], up = [0, 1, 0], orthographic_width = 0.5 }
    environment.gradient.zenith = { spectrum = \"E\", luminance = 100 }
    environment.gradient.horizon = { spectrum = \"E\", luminance = 0 }
    environment.gradient.nadir = { spectrum = \"E\", luminance = 0 }
    materials.glass.dielectric.ior = 1.6
    materials.water.dielectric.ior = 1.333
    materials.mirror.conductor.ior = { n = 1e-6, k = 1 }
    materials.soot.diffuse.reflectance = 0
    [replace]\n\"G\" = \"glass\"\n\"H\" = \"glass\"\n\"W\" = \"water\"\n\"M\" = \"mirror\"\n\"S\" = \"soot\"
    [[objects]]\nname = \"prism\"\n";

/// What comes back where light is reflected by the surface alone.
const SURFACE: f64 = 100.0 * (0.6 * 0.6) / (2.6 * 2.6);

struct Files(TempDir);

impl Files {
    fn new() -> Self {
        Self(tempfile::tempdir().expect("a folder"))
    }

    fn try_scene(&self, name: &str, text: &str, keys: &str) -> Result<Scene, SceneError> {
        self.seeded(name, text, keys, 0)
    }

    fn seeded(&self, name: &str, text: &str, keys: &str, seed: u64) -> Result<Scene, SceneError> {
        fs::write(self.0.path().join(name), text).expect("a file");
        let replaced = SCENE.replace("\"G\"", if text.contains("usemtl") { "\"G\"" } else { "\"none\"" });
        let scene = format!("{replaced}shape.mesh = {{ file = \"{name}\"{keys} }}\n");
        resolve(
            Text::new(self.0.path().join("scene.toml"), scene),
            &library(),
            &Overrides { seed: Some(seed), ..Overrides::default() },
        )
    }

    /// Mean colours of a body of glass by 16 seeds.
    fn replicates(&self, faces: &str) -> Vec<[f64; 3]> {
        let text = format!("{VERTICES}usemtl G\n{faces}");
        let look = |seed| mean(&film(&self.seeded("prism.obj", &text, "", seed).expect("a scene")));
        (0..16).map(look).collect()
    }

    /// Of glass.
    fn glass(&self, faces: &str) -> Scene {
        let text = format!("{VERTICES}usemtl G\n{faces}");
        self.try_scene("prism.obj", &text, "").unwrap_or_else(|error| panic!("{faces}: {error}"))
    }
}

fn luminance(scene: &Scene) -> f64 {
    mean(&film(scene))[1]
}

fn sees(scene: &Scene, expected: f64, what: &str) {
    let found = luminance(scene);
    assert!((found - expected).abs() < 2e-5 * expected, "{what}: {found}, expected {expected}");
}

fn said<'a>(scene: &'a Scene, words: &str) -> Vec<&'a str> {
    scene.warnings.iter().map(String::as_str).filter(|warning| warning.contains(words)).collect()
}

fn clear_of_complaints(scene: &Scene) {
    let complaints: Vec<_> =
        scene.warnings.iter().filter(|said| !said.contains("to replace") && !said.contains("no object uses")).collect();
    assert!(complaints.is_empty(), "{complaints:?}");
}

#[test]
fn groups_objects_and_materials_are_one_solid() {
    let files = Files::new();
    for (faces, name) in [
        ([TOP, LEFT, RIGHT, ENDS].concat(), "prism"),
        (format!("g top\n{TOP}g rest\n{LEFT}{RIGHT}{ENDS}"), "prism"),
        (format!("o top\n{TOP}o rest\n{LEFT}{RIGHT}o ends\n{ENDS}"), "prism"),
        (format!("{TOP}usemtl H\n{LEFT}{RIGHT}{ENDS}"), "prism"),
        (format!("g a\n{TOP}g b\n{LEFT}g c\n{RIGHT}g d\nf 1 3 2\ng e\nf 4 5 6\n"), "prism"),
    ] {
        let scene = files.glass(&faces);
        sees(&scene, 100.0, &faces);
        clear_of_complaints(&scene);
        assert_eq!((scene.objects.len(), scene.objects[0].name.as_str()), (1, name), "{faces}");
    }
    // Two prisms, each in two groups, stay two, and copies share each.
    let second: String = ["v -1 20 0\nv 1 20 0\nv 0 20 -1\nv -1 29 0\nv 1 29 0\nv 0 29 -1\n"].concat();
    let faces = format!(
        "{second}g top\n{TOP}g rest\n{LEFT}{RIGHT}{ENDS}g top2\nf 7 8 11 10\ng rest2\nf 7 10 12 9\nf 8 9 12 11\nf 7 9 8\nf 10 11 12\n"
    );
    let scene = files.glass(&faces);
    let names: Vec<&str> = scene.objects.iter().map(|object| object.name.as_str()).collect();
    assert_eq!(names, ["prism: top + prism: rest", "prism: top2 + prism: rest2"]);
    sees(&scene, 100.0, "one of two");
}

/// The primitives of a glTF mesh, each with vertices of its own.
#[test]
fn primitives_are_one_solid() {
    let primitives: [&[u32]; 2] = [&[0, 1, 4, 0, 4, 3], &[0, 3, 5, 0, 5, 2, 1, 2, 5, 1, 5, 4, 0, 2, 1, 3, 4, 5]];
    let corners = |which: &[u32]| which.iter().map(|&i| CORNERS[i as usize]).collect::<Vec<_>>();
    let bytes: Vec<u8> = primitives.iter().flat_map(|p| corners(p)).flatten().flat_map(|x| x.to_le_bytes()).collect();
    let counts = primitives.map(<[u32]>::len);
    let primitive = |number: usize| json!({ "attributes": { "POSITION": number } });
    let accessor =
        |view: usize| json!({ "bufferView": view, "componentType": 5126, "count": counts[view], "type": "VEC3" });
    let file = json!({
        "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": [0] }],
        // Our z is up, theirs is y.
        "nodes": [{ "mesh": 0, "matrix": [1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1] }],
        "meshes": [{ "name": "m", "primitives": [primitive(0), primitive(1)] }],
        "accessors": [accessor(0), accessor(1)],
        "bufferViews": [{ "buffer": 0, "byteLength": 12 * counts[0] },
            { "buffer": 0, "byteOffset": 12 * counts[0], "byteLength": 12 * counts[1] }],
        "buffers": [{ "uri": "prism.bin", "byteLength": bytes.len() }]
    });
    let files = Files::new();
    fs::write(files.0.path().join("prism.bin"), bytes).expect("a file");
    let scene = files.try_scene("prism.gltf", &file.to_string(), " }\nmaterial = \"glass\"\npriority = 0\n#");
    let scene = scene.unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(scene.objects.len(), 1);
    sees(&scene, 100.0, "primitives");
    clear_of_complaints(&scene);
}

#[test]
fn opaque_faces_of_a_clear_body_keep_their_surface() {
    let files = Files::new();
    let scene = files.glass(&format!("{TOP}{RIGHT}{ENDS}usemtl M\n{LEFT}"));
    sees(&scene, 100.0, "a mirror where all light is reflected anyway");
    assert_eq!(said(&scene, "not closed"), Vec::<&str>::new());
    // Every ray that enters meets the black face, at once or by the other one; the edge between them is out of view.
    let renders = files.replicates(&format!("{TOP}{RIGHT}{ENDS}usemtl S\n{LEFT}"));
    assert!(agrees(&renders, SURFACE) && !agrees(&renders, 1.2 * SURFACE), "a black face: {renders:?}");
    // Two opaque parts that close it together.
    let faces = format!("{TOP}usemtl S\n{LEFT}{ENDS}usemtl M\n{RIGHT}");
    let renders = files.replicates(&faces);
    assert!(agrees(&renders, SURFACE) && !agrees(&renders, 1.2 * SURFACE), "a black face and a mirror: {renders:?}");
    assert_eq!(files.glass(&faces).objects.len(), 3);
}

#[test]
fn two_media_on_one_body_are_refused() {
    let files = Files::new();
    let text = format!("{VERTICES}g top\nusemtl G\n{TOP}g rest\nusemtl W\n{LEFT}{RIGHT}{ENDS}");
    let error = files.try_scene("two.obj", &text, "").expect_err("two media").to_string();
    for words in ["`prism: top`", "`prism: rest`", "`glass`", "`water`", "one closed body"] {
        assert!(error.contains(words), "{words}: {error}");
    }
    // Nor are two media that something opaque keeps apart from each other: they are open, and told so.
    let text = format!("{VERTICES}usemtl G\n{TOP}usemtl W\n{LEFT}usemtl M\n{RIGHT}{ENDS}");
    assert!(files.try_scene("setting.obj", &text, "").is_ok());
    // Two bodies of their own are none of its business.
    let text = format!("{VERTICES}usemtl G\n{TOP}{LEFT}{RIGHT}{ENDS}usemtl W\n{TOP}{LEFT}{RIGHT}{ENDS}");
    assert!(files.try_scene("bodies.obj", &text, "").is_ok());
}

fn backwards(faces: &str) -> String {
    let turned = faces.lines().map(|line| {
        let mut corners: Vec<&str> = line.split(' ').skip(1).collect();
        corners.reverse();
        format!("f {}\n", corners.join(" "))
    });
    turned.collect()
}

#[test]
fn faces_from_both_sides_are_taken_once() {
    let files = Files::new();
    let all = [TOP, LEFT, RIGHT, ENDS].concat();
    for faces in [
        all.clone() + &backwards(&all),
        backwards(&all) + &all,
        format!("g a\n{TOP}{}g b\n{LEFT}{RIGHT}{ENDS}{}", backwards(TOP), backwards(&[LEFT, RIGHT, ENDS].concat())),
    ] {
        let scene = files.glass(&faces);
        sees(&scene, 100.0, &faces);
        assert_eq!(said(&scene, "has 8 triangles twice").len(), 1, "{:?}", scene.warnings);
        let Shape::Mesh(placed) = &scene.world.shapes()[0] else { panic!("a mesh") };
        assert_eq!(placed.mesh().triangles().indices.len(), 8);
    }
}

/// A clear cube in a furnace cannot be seen.
#[test]
fn a_two_sided_cube_vanishes_in_a_furnace() {
    let files = Files::new();
    let cube = "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n\
        f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n\
        f 1 2 3 4\nf 8 7 6 5\nf 5 6 2 1\nf 6 7 3 2\nf 7 8 4 3\nf 8 5 1 4\n";
    fs::write(files.0.path().join("twosided.obj"), cube).expect("a file");
    let text = "render = { width = 6, height = 6, samples = 16 }
        camera = { position = [3, -8, 4], look_at = [0, 0, 0], fov = 8 }
        environment.constant = { spectrum = \"E\", luminance = 100 }
        materials.glass.dielectric.ior = 1.5
        [[objects]]\nmaterial = \"glass\"\nshape.mesh.file = \"twosided.obj\"";
    let scene = resolve(Text::new(files.0.path().join("scene.toml"), text), &library(), &Overrides::default());
    let scene = scene.unwrap_or_else(|error| panic!("{error}"));
    sees(&scene, 100.0, "a furnace");
    assert_eq!(said(&scene, "has 12 triangles twice").len(), 1, "{:?}", scene.warnings);
}

#[test]
fn windings_are_made_to_agree() {
    let files = Files::new();
    for (faces, turned) in [
        ([&backwards(TOP), LEFT, RIGHT, ENDS].concat(), "2 triangles wound"),
        ([TOP, &backwards(LEFT), RIGHT, ENDS].concat(), "2 triangles wound"),
        (format!("g top\n{}g rest\n{LEFT}{RIGHT}{ENDS}", backwards(TOP)), "2 triangles wound"),
        ([TOP, LEFT, RIGHT, "f 1 2 3\nf 4 5 6\n"].concat(), "1 triangle wound"),
    ] {
        let scene = files.glass(&faces);
        sees(&scene, 100.0, &faces);
        assert_eq!(said(&scene, turned).len(), 1, "{:?}", scene.warnings);
        assert_eq!(said(&scene, "not closed").len(), 0);
    }
    // All of them: a solid that is inside out is no news.
    let scene = files.glass(&backwards(&[TOP, LEFT, RIGHT, ENDS].concat()));
    sees(&scene, 100.0, "inside out");
    clear_of_complaints(&scene);
}

#[test]
fn hairline_gaps_are_closed_unless_the_scene_says_otherwise() {
    let files = Files::new();
    // The top has corners of its own, each a little off; the prism is 18.1 long.
    let with_gap = |by: f64| {
        format!(
            "{VERTICES}v -1 -9 {by}\nv {} -9 0\nv {} 9 0\nv -1 {} 0\nusemtl G\ng top\nf 7 8 9 10\ng rest\n{LEFT}{RIGHT}{ENDS}",
            1.0 + by,
            1.0 - by,
            9.0 + by
        )
    };
    let scene = |by: f64, keys: &str| files.try_scene("gap.obj", &with_gap(by), keys).unwrap_or_else(|e| panic!("{e}"));
    for by in [4e-6, 1e-4, 1e-3] {
        let scene = scene(by, "");
        let found = luminance(&scene);
        assert!((found - 100.0).abs() < 1e-2, "{by}: {found}");
        assert_eq!(said(&scene, "had gaps: 4 corners").len(), 1, "{:?}", scene.warnings);
    }
    assert!(!said(&scene(1e-2, ""), "not closed").is_empty(), "too wide");
    assert!(!said(&scene(4e-6, ", weld = 0"), "not closed").is_empty(), "as the scene says");
    let wide = scene(1e-2, ", weld = 1e-3");
    assert_eq!(said(&wide, "had gaps").len(), 1, "{:?}", wide.warnings);
    let error = files.try_scene("gap.obj", &with_gap(0.0), ", weld = 2").expect_err("too much").to_string();
    assert!(error.contains("`weld` is 2: it is a share"), "{error}");
}
