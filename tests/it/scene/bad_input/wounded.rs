//! Scenes with random wounds are scenes or errors, never panics.

use crate::common::random::Random;
use spectrel::scene::{Overrides, SceneError, Text, resolve};
use spectrel::spectrum::Library;
use std::time::{Duration, Instant};

fn one_of<'a>(random: &mut Random, choices: &[&'a str]) -> &'a str {
    choices[random.below(choices.len())]
}

const NASTY: [&str; 22] = [
    "nan",
    "-inf",
    "0",
    "-0.0",
    "1e300",
    "-1e38",
    "1e-300",
    "1e15",
    "4294967295",
    "-9223372036854775808",
    "\"\"",
    "[]",
    "{}",
    "true",
    "\"D50\"",
    "1979-05-27",
    "\n",
    "[[",
    "]",
    "= ",
    "µ",
    "\u{0}",
];

/// A scene with one to three wounds: bytes changed, words replaced by nasty ones, lines lost, doubled or moved.
fn wounded(scene: &str, random: &mut Random) -> String {
    let mut text = scene.as_bytes().to_vec();
    for _ in 0..=random.below(3) {
        let at = random.below(text.len());
        match random.below(5) {
            0 => text[at] = random.below(256) as u8,
            1 => drop(text.drain(at..(at + 1 + random.below(12)).min(text.len()))),
            2 => drop(text.splice(at..at, one_of(random, &NASTY).bytes())),
            3 => {
                let is_word = |byte: &u8| byte.is_ascii_alphanumeric() || b".-_\"".contains(byte);
                let start = text[..at].iter().rposition(|byte| !is_word(byte)).map_or(0, |before| before + 1);
                let end = text[at..].iter().position(|byte| !is_word(byte)).map_or(text.len(), |length| at + length);
                text.splice(start..end.max(start), one_of(random, &NASTY).bytes());
            }
            _ => {
                let mut lines: Vec<_> = text.split(|&byte| byte == b'\n').map(<[u8]>::to_vec).collect();
                let line = lines.remove(random.below(lines.len()));
                for _ in 0..random.below(3) {
                    lines.insert(random.below(lines.len()), line.clone());
                }
                text = lines.join(&b'\n');
            }
        }
    }
    String::from_utf8_lossy(&text).into_owned()
}

/// Every kind of shape, light and material, and every key of the camera and the picture.
const EVERYTHING: &str = r#"
meters_per_unit = 0.001
outside = "air"
[render]
width = 9
height = 6
samples = 2
seed = 1
max_depth = 9
filter = "box"
sampler = "independent"
fresnel = "exact"
[camera]
position = [0, -90, 0]
look_at = [0, 0, 0]
up = [0, 0, 1]
focal_length_mm = 50
sensor_width_mm = 24
f_number = 2.8
focus_distance = 9
blades = 7
[picture]
exposure = "auto"
white_balance = "scene"
gamut = "preserve-chroma"
observer = "cie-2015-2"
[[suns]]
direction = [1, 0, 2]
angle = 1
spectrum = { blackbody = 5778 }
illuminance = 900
[environment]
constant = { spectrum = { table = { wavelength_nm = [400, 500.5, 700], value = [1, 2, 3] } }, scale = 0.5 }
[materials.glass.dielectric]
ior = 1.5
absorption = 20
fresnel = "schlick"
[materials.metal.conductor]
ior = { n = 0.2, k = 4 }
perceptual_roughness = 0.3
[materials.paint.diffuse]
reflectance = { rgb = [0.2, 0.3, 0.4] }
[[objects]]
material = "glass"
shape.brilliant = { diameter = 6, table = 0.57, crown_angle = 34, pavilion_angle = 41, girdle = 0.03, culet = 0.01, girdle_facets = 32 }
transform = { scale = 2, rotate = [10, 20, 30], translate = [0, 0, 9] }
[[objects]]
material = "water"
shape.step-cut = { width = 5, length = 7, corner = 0.2, crown_angles = [47, 40, 33], pavilion_angles = [55, 48, 41] }
[[objects]]
material = "metal"
shape.convex.planes = [[1, 0, 0, 9], [-1, 0, 0, 1], [0, 1, 0, 1], [0, -1, 0, 1], [0, 0, 1, 1], [0, 0, -1, 1]]
transform.scale = [1, 2, 3]
[[objects]]
material = "paint"
shape.box = { center = [20, 0, 0], size = [1, 2, 3] }
[[objects]]
emission = { spectrum = { blackbody = 3000 } }
shape.sphere = { center = [30, 0, 0], radius = 2 }
[[objects]]
emission = { spectrum = { daylight = 6500 }, radiance = 3, two_sided = true }
shape.disk = { center = [-30, 0, 0], radius = 2, normal = [1, 1, 1] }
[[objects]]
emission = { spectrum = { lines = [[435.8, 1], [546.1, 2]] }, luminance = 50 }
shape.rectangle = { center = [0, 0, 50], size = [3, 4], normal = [0, 0, -1] }
"#;

/// [`EVERYTHING`] under a picture, beside a ball that wears one.
fn under_a_picture() -> String {
    let (before, after) = EVERYTHING.split_once("[environment]").expect("an environment");
    let (_, after) = after.split_once("[materials.glass").expect("a material");
    let image = "[environment.image]\nfile = \"data/sky.hdr\"\nilluminant = \"D50\"\nluminance = 200\nrotate = 30\ncolor_space = \"rec2020\"\n";
    let print = "[materials.print.diffuse]\nreflectance = { image = \"data/sky.hdr\", color_space = \"linear\", scale = [2, -3], wrap = \"clamp\" }\n\
        [[objects]]\nmaterial = \"print\"\nshape.sphere = { center = [-9, 9, 9], radius = 3 }\n";
    format!("{before}{image}[materials.glass{after}{print}")
}

/// What resolves also renders: a part of them is, to see it.
#[test]
fn wounded_scenes_are_scenes_or_errors() {
    let library = Library::default();
    let mut random = Random(0x5eed);
    for scene in [include_str!("../../../../scenes/tray.toml"), EVERYTHING, &under_a_picture()] {
        let small = Overrides { width: Some(3), height: Some(2), samples: Some(1), ..Overrides::default() };
        let read = |text: &str, render: bool| {
            let scene = resolve(Text::new("tests/wounded.toml", text), &library, &small)?;
            Ok::<_, SceneError>(render.then(|| crate::common::film(&scene)).map(drop))
        };
        read(scene, true).unwrap_or_else(|error| panic!("{error}"));
        let started = Instant::now();
        let (mut good, mut bad) = (0, 0);
        while good + bad < 2500 && started.elapsed() < Duration::from_secs(10) {
            let text = wounded(scene, &mut random);
            let render = random.below(8) == 0;
            match std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| read(&text, render))) {
                Ok(Ok(_)) => good += 1,
                Ok(Err(error)) => {
                    assert!(!error.to_string().is_empty());
                    bad += 1;
                }
                Err(_) => panic!("panicked on\n{text}"),
            }
        }
        assert!(good > 0 && bad > 0, "{good} good and {bad} bad scenes");
    }
}
