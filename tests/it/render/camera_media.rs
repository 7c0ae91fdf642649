//! Cameras whose rays begin in different media: views along parallel rays and lens openings that
//! reach into solids.
//!
//! In surroundings of 100 cd/m² on all sides a ray that begins in clear glass sees n² × 100,
//! whatever the solid's shape: what refraction keeps is radiance over n², and reflections within
//! only swap one part of the same light for another.

use crate::common::files::{cuboid, obj};
use crate::common::{film, lanes::with, mean, scene};
use glam::{DMat3, DVec3};
use spectrel::film::Film;
use spectrel::scene::{Overrides, SceneError, Text, resolve};

const N: f64 = 1.5;
const SKY: &str = "environment.constant = { spectrum = \"E\", luminance = 100 }\n";

fn materials(ior: f64, absorption: f64) -> String {
    format!("meters_per_unit = 1\nmaterials.g.dielectric = {{ ior = {ior}, absorption = {absorption} }}\n")
}

fn glass(shape: &str) -> String {
    format!("[[objects]]\nname = \"block\"\nmaterial = \"g\"\n{shape}\n")
}

/// Parallel rays straight down from the plane z = 0, x to the right.
fn downwards(filter: &str) -> String {
    format!(
        "render = {{ width = 16, height = 16, filter = \"{filter}\" }}
        camera = {{ position = [0, 0, 0], look_at = [0, 0, -1], up = [0, 1, 0], orthographic_width = 4 }}\n"
    )
}

/// Mean luminance of some columns.
fn columns(film: &Film, range: std::ops::Range<usize>) -> f64 {
    let width = film.window().width as usize;
    let mine = film.pixels().iter().enumerate().filter(|(index, _)| range.contains(&(index % width)));
    let luminances: Vec<f64> = mine.map(|(_, pixel)| pixel.mean()[1]).collect();
    luminances.iter().sum::<f64>() / luminances.len() as f64
}

fn close(name: &str, found: f64, expected: f64, tolerance: f64) {
    println!("{name}: {found:.4}, expected {expected:.4}");
    assert!((found / expected - 1.0).abs() < tolerance, "{name}: {found} for {expected}");
}

#[test]
fn parallel_rays_begin_in_the_medium_that_is_there() {
    let folder = tempfile::tempdir().expect("a folder");
    let mesh = obj(folder.path(), "block", &cuboid([50.0, 0.0, 0.0], [100.0, 50.0, 2.0]));
    for shape in ["shape.box = { size = [100, 50, 2], center = [50, 0, 0] }", &mesh] {
        // Absorption over a length of 1, and no light lost at the faces.
        let smoke = film(&scene(&(downwards("box") + &materials(1.0, 1.0) + SKY + &glass(shape)), &with(8, 16)));
        close("beside smoke", columns(&smoke, 0..8), 100.0, 1e-5);
        close("in smoke", columns(&smoke, 8..16), 100.0 * (-1f64).exp(), 1e-5);
        let clear = film(&scene(&(downwards("box") + &materials(N, 0.0) + SKY + &glass(shape)), &with(8, 256)));
        close("beside glass", columns(&clear, 0..8), 100.0, 2e-3);
        close("in glass", columns(&clear, 8..16), N * N * 100.0, 2e-3);
    }
}

/// A ball around the middle of the view shows n² × as much where light can leave it, within 1/n of
/// its outline, and nothing beyond, where all is reflected for ever: what is concentrated in one
/// place is missing in another.
#[test]
fn a_view_through_the_middle_of_a_ball_shows_as_much_light_as_one_without_it() {
    let ball = glass("shape.sphere = { radius = 1.4 }");
    let film = film(&scene(&(downwards("box") + &materials(N, 0.0) + SKY + &ball), &with(8, 1024)));
    let at = |x: usize, y: usize| film.pixels()[16 * y + x].mean()[1];
    close("middle", at(8, 8), N * N * 100.0, 2e-3);
    close("corner", at(0, 0), 100.0, 1e-5);
    // Between 1 and 1.3 from the middle.
    assert_eq!(at(8, 12), 0.0);
    close("ball", mean(&film)[1], 100.0, 2e-3);
}

/// Pixels gather light from beside them, so rays begin beyond the picture's edge, too.
#[test]
fn what_only_the_filter_reaches_counts() {
    let beyond = glass("shape.box = { size = [10, 50, 2], center = [7.125, 0, 0] }");
    let text = |filter: &str| downwards(filter) + &materials(N, 0.0) + SKY + &beyond;
    let [sharp, wide] = ["box", "blackman-harris"].map(|filter| film(&scene(&text(filter), &with(8, 1024))));
    close("within the picture", columns(&sharp, 15..16), 100.0, 1e-4);
    // The window's weight beyond one pixel (Harris 1978), over a third of its half width.
    let third = std::f64::consts::PI / 3.0;
    let weight = 0.35875 * third - 0.48829 * third.sin() + 0.14128 / 2.0 * (2.0 * third).sin();
    let share = weight / (0.35875 * 6.0 * third);
    let (found, expected) = (columns(&wide, 15..16), 100.0 * (1.0 + (N * N - 1.0) * share));
    println!("beside the picture: {found}, expected {expected}");
    assert!((found - expected).abs() < 0.2 * (expected - 100.0), "{found} for {expected}");
}

/// A lens half in smoke: each ray goes the same way through it down to the lamp, where all of them
/// meet.
#[test]
fn an_opening_half_in_a_solid_sees_half_through_it() {
    let lens = "render = { width = 4, height = 4, filter = \"box\" }
        [camera]
        position = [0, 0, 0]
        look_at = [0, 0, -10]
        up = [0, 1, 0]
        focal_length_mm = 1000
        sensor_width_mm = 0.01
        f_number = 1\n";
    let smoke = glass("shape.box = { size = [100, 50, 2], center = [50, 0, 0] }");
    let lamp = "[[objects]]\nshape.rectangle = { size = [50, 50], center = [0, 0, -10] }
        emission = { spectrum = \"E\", luminance = 100 }\n";
    let (radius, distance) = (0.5f64, 10f64);
    // Beer's law over the slant ways from all points of the opening, by area.
    let steps = 1000;
    let slant = |i: i32| (1.0 + radius * radius * (f64::from(i) + 0.5) / f64::from(steps) / distance.powi(2)).sqrt();
    let within = (0..steps).map(|i| (-slant(i)).exp()).sum::<f64>() / f64::from(steps);
    let head = materials(1.0, 1.0);
    let found = mean(&film(&scene(&(head.clone() + lens + &smoke + lamp), &with(8, 4096))))[1];
    close("half in smoke", found, 100.0 * (0.5 + 0.5 * within), 1e-3);
    let blades = lens.replace("f_number = 1", "f_number = 1\nblades = 6");
    let found = mean(&film(&scene(&(head + &blades + &smoke + lamp), &with(8, 4096))))[1];
    close("six blades, half in smoke", found, 100.0 * (0.5 + 0.5 * within), 2e-3);
    let bright = mean(&film(&scene(&(materials(N, 0.0) + SKY + lens + &smoke), &with(8, 4096))))[1];
    close("half in glass", bright, 100.0 * (0.5 + 0.5 * N * N), 5e-3);
}

/// The picture does not depend on where the scene lies.
#[test]
fn a_turned_and_scaled_view_sees_the_same() {
    let turn = DMat3::from_rotation_z(30f64.to_radians())
        * DMat3::from_rotation_y(20f64.to_radians())
        * DMat3::from_rotation_x(10f64.to_radians());
    for scale in [1e-3, 1.0, 1e3] {
        let [ahead, up] = [-DVec3::Z, DVec3::Y].map(|v| (turn * v * scale).to_array());
        let head = format!(
            "render = {{ width = 16, height = 16, filter = \"box\" }}
            camera = {{ position = [0, 0, 0], look_at = {ahead:?}, up = {up:?}, orthographic_width = {} }}\n",
            4.0 * scale
        );
        let block = glass("shape.box = { size = [100, 50, 2], center = [50, 0, 0] }")
            + &format!("transform = {{ scale = {scale}, rotate = [10, 20, 30] }}\n");
        let smoke = film(&scene(&(head + &materials(1.0, 1.0 / scale) + SKY + &block), &with(8, 16)));
        close("beside smoke", columns(&smoke, 0..8), 100.0, 1e-4);
        close("in smoke", columns(&smoke, 8..16), 100.0 * (-1f64).exp(), 1e-4);
    }
}

fn resolved(text: &str) -> Result<spectrel::scene::Scene, SceneError> {
    resolve(Text::new("scene.toml", text), &crate::common::library(), &Overrides::default())
}

#[test]
fn a_view_that_begins_in_something_opaque_is_refused_or_told() {
    let wall = |x: f64| {
        format!(
            "materials.wall.diffuse.reflectance = 0.5
            [[objects]]\nname = \"wall\"\nmaterial = \"wall\"\nshape.box = {{ size = [10, 50, 2], center = [{x}, 0, 0] }}\n"
        )
    };
    // All of it, by its middle.
    let error = resolved(&(downwards("box") + SKY + &wall(4.0))).expect_err("the camera stands in a wall").to_string();
    assert!(error.contains("inside `wall`"), "{error}");
    // A part of it: black there.
    let scene = resolved(&(downwards("box") + SKY + &wall(5.5))).expect("the middle is free");
    let told = scene.warnings.iter().any(|warning| warning.contains("wall") && warning.contains("black"));
    assert!(told, "{:?}", scene.warnings);
    let film = film(&scene);
    close("beside the wall", columns(&film, 0..10), 100.0, 1e-5);
    assert_eq!(columns(&film, 10..16), 0.0);
    // Nothing of it.
    let scene = resolved(&(downwards("box") + SKY + &wall(7.5))).expect("all is free");
    assert_eq!(scene.warnings, Vec::<String>::new());
}
