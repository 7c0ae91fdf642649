//! Pictures that scenes read: missing, broken, of the wrong kind, or holding what light cannot be.

use super::*;

fn surroundings(keys: &str) -> String {
    [SMALL, CAMERA, SPHERE, "[environment.image]\n", keys, "\n"].concat()
}

const HDR: &str = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\nxyz@zyxA";

/// The same without colour.
const GREY: &str = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\nxxx@yyyA";

#[test]
fn a_good_picture_is_good() {
    let outcome = render(surroundings("file = \"sky.hdr\""), &[("sky.hdr", HDR)], &["-q"]);
    assert_eq!((outcome.code, outcome.stderr.as_str()), (Some(0), ""));
}

#[test]
fn broken_pictures_are_told_with_the_place_and_the_file() {
    let cut = &HDR[..HDR.len() - 1];
    let huge = "#?RADIANCE\n\n-Y 1000000 +X 2000000\n";
    for (file, content, says) in [
        ("sky.hdr", cut, "the HDR ends in the middle"),
        ("sky.hdr", "", "the HDR ends in the middle"),
        ("sky.hdr", "P6 1 1\n", "does not begin with #?RADIANCE"),
        ("sky.hdr", huge, "1000000 texels: they take"),
        ("sky.hdr", huge, "bytes)"),
        ("sky.exr", "v/1\u{1}\u{2}\0\0\0", "the EXR ends in the middle"),
        ("sky.exr", "", "EXR"),
        ("sky.exr", "nonsense of some length, more than a header has", "no EXR"),
        ("sky.png", "\u{89}PNG", "no PNG"),
        ("sky.jpg", "\u{89}PNG", "no JPEG"),
        ("sky.tif", "", "must end in .exr, .hdr, .png or .jpg"),
    ] {
        refused_at_mark(&surroundings(&format!("file = §\"{file}\"")), &[(file, content)], &[file, says]);
    }
    refused_at_mark(&surroundings("file = §\"none.exr\""), &[], &["cannot read `none.exr`"]);
    refused_at_mark(&surroundings("file = §\".\""), &[], &["must end in"]);
}

#[test]
fn keys_of_surroundings_must_make_sense() {
    let with = |keys: &str| surroundings(&format!("file = \"sky.hdr\"\n{keys}"));
    for (keys, says) in [
        ("scale = §-1", "`scale` is -1"),
        ("scale = §nan", "`scale` is NaN"),
        ("luminance = §inf", "`luminance` is inf"),
        ("scale = 1\nluminance = §1", "both say how strong"),
        ("rotate = §nan", "`rotate` is NaN"),
        ("color_space = §\"srgbb\"", "did you mean `srgb`?"),
        ("illuminant = §\"D655\"", "did you mean `d65`?"),
        ("illuminant = { blackbody = §0 }", "`blackbody` is 0"),
        ("§luminanse = 1", "did you mean `luminance`?"),
    ] {
        refused_at_mark(&with(keys), &[("sky.hdr", HDR)], &[says]);
    }
    let scaled = surroundings("file = §\"sky.hdr\"\nscale = 1e300");
    refused_at_mark(&scaled, &[("sky.hdr", HDR)], &["the brightest texel has", "cd/m²", "smaller `scale`"]);
    let black = surroundings("file = \"sky.hdr\"\nluminance = §5");
    refused_at_mark(&black, &[("sky.hdr", "#?RADIANCE\n\n-Y 1 +X 1\n\0\0\0\0")], &["`sky.hdr` is black"]);
    refused_at_mark(
        &surroundings("§scale = 1").replace("§scale", "scale").replace("[environment", "§[environment"),
        &[],
        &["`file` is missing"],
    );
    let code = surroundings("file = §\"sky.png\"");
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("sky.png");
    let mut encoder = png::Encoder::new(fs::File::create(&path).expect("a file"), 1, 1);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.write_header().expect("a header").write_image_data(&[9]).expect("a pixel");
    fs::write(folder.path().join("scene.toml"), code.replace('§', "")).expect("a file");
    let outcome = spectrel(folder.path(), &["render", "scene.toml", "-q"]);
    assert_eq!(outcome.code, Some(2));
    assert!(outcome.stderr.contains("give an .exr or .hdr file"), "{}", outcome.stderr);
}

fn textured(keys: &str, shape: &str) -> String {
    scene_with(&format!("[[objects]]\nmaterial = \"m\"\n{shape}\n[materials.m.{keys}\n"))
}

const RECTANGLE: &str = "shape.rectangle = { size = [1, 1] }";

#[test]
fn pictures_of_the_wrong_kind_are_refused_where_they_are_named() {
    let colored = &[("a.hdr", HDR)];
    let rough = textured("conductor]\nior = 1\nroughness = { image = §\"a.hdr\" }", RECTANGLE);
    refused_at_mark(&rough, colored, &["`a.hdr` has three channels, which differ in 2 of 2 texels", "a grey picture"]);
    let spaced = textured("conductor]\nior = 1\nroughness = { image = \"a.hdr\", color_space = §\"srgb\" }", RECTANGLE);
    refused_at_mark(&spaced, colored, &["roughness is data"]);
    let huge = &[("a.hdr", "#?RADIANCE\n\n-Y 1000000 +X 2000000\n")];
    refused_at_mark(&textured("diffuse]\nreflectance = { image = §\"a.hdr\" }", RECTANGLE), huge, &["bytes)"]);
    refused_at_mark(&textured("diffuse]\nreflectance = { image = §\"a.gif\" }", RECTANGLE), &[], &["a.gif", ".png"]);
    refused_at_mark(
        &textured("diffuse]\nreflectance = { image = §\"a.png\" }", RECTANGLE),
        &[],
        &["cannot read `a.png`"],
    );
    for (keys, says) in [
        ("diffuse]\nreflectance = { image = \"a.hdr\", §scal = [1, 1] }", "did you mean `scale`?"),
        ("diffuse]\nreflectance = { image = \"a.hdr\", wrap = §\"mirror\" }", "known here: `repeat`, `clamp`"),
        ("diffuse]\nreflectance = { image = \"a.hdr\", scale = §[1, 1, 1] }", "expected 2 numbers"),
        ("diffuse]\nreflectance = { image = \"a.hdr\", scale = [1, §nan] }", "finite"),
        ("diffuse]\nreflectance = { image = \"a.hdr\", color_space = §\"rgb\" }", "did you mean `srgb`?"),
        ("diffuse]\nreflectance = §{ image = \"a.hdr\", rgb = [0, 0, 0] }", "keys of both"),
        ("diffuse]\nreflectance = §{ rgb = [0, 0, 0], wrap = \"clamp\" }", "keys of both"),
        ("conductor]\nior = 1\nroughness = §\"a.hdr\"", "expected a number 0…1, or { image"),
        ("conductor]\nior = 1\nroughness = { §file = \"a.hdr\" }", "unknown key `file`"),
    ] {
        refused_at_mark(&textured(keys, RECTANGLE), colored, &[says]);
    }
}

#[test]
fn a_mesh_without_texture_coordinates_takes_no_picture() {
    let scene = textured("diffuse]\nreflectance = { image = \"a.hdr\" }", "§shape.mesh = { file = \"t.obj\" }");
    let files = &[("a.hdr", GREY), ("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")];
    refused_at_mark(&scene, files, &["object 1 has no texture coordinates", "meshes whose file brings them"]);
}

#[test]
fn a_shape_without_texture_coordinates_takes_no_picture() {
    for shape in ["§shape.box = { size = [1, 1, 1] }", "§shape.brilliant = { diameter = 1 }"] {
        for keys in
            ["diffuse]\nreflectance = { image = \"a.hdr\" }", "conductor]\nior = 1\nroughness = { image = \"a.hdr\" }"]
        {
            let scene = textured(keys, shape);
            refused_at_mark(
                &scene,
                &[("a.hdr", GREY)],
                &["object 1 has no texture coordinates", "`a.hdr`", "spheres, rectangles"],
            );
        }
    }
}
