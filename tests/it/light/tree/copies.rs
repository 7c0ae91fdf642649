//! A scene of very many lamps: nothing in it may take a step for each pair of them.

use crate::common::{film, scene};
use spectrel::scene::Overrides;
use std::fmt::Write;

/// Lamps along each side of a square.
const SIDE: usize = 316;

/// A ceiling of small lamps is as good as one large one: with a twentieth of it shining, a floor below has a twentieth of its light.
#[test]
fn a_hundred_thousand_copies_of_a_lamp_load_and_light_a_floor() {
    let mut copies = String::new();
    for i in 0..SIDE * SIDE {
        let at = |i: usize| i as f64 - 0.5 * (SIDE - 1) as f64;
        write!(copies, "{{ translate = [{}, {}, 10] }},", at(i % SIDE), at(i / SIDE)).expect("to memory");
    }
    let text = format!(
        "meters_per_unit = 1
        render = {{ width = 4, height = 4, samples = 256, filter = \"box\" }}
        camera = {{ position = [0, -5, 5], look_at = [0, 0, 0], fov = 10 }}
        materials.grey.diffuse.reflectance = 0.5
        [[objects]]\nmaterial = \"grey\"\nshape.rectangle = {{ size = [20, 20] }}
        [[objects]]\nname = \"lamp\"
        shape.rectangle = {{ size = [0.2, 0.25], normal = [0, 0, -1] }}
        emission = {{ spectrum = \"E\", luminance = 2000 }}
        copies = [{copies}]"
    );
    let scene = scene(&text, &Overrides::default());
    assert_eq!(scene.lights.in_tree(), SIDE * SIDE);
    // The spectrum of all of them is looked up, integrated and noted once.
    let users: Vec<_> = scene.data.iter().map(|data| &data.used_by).filter(|user| user.contains("lamp")).collect();
    assert_eq!(users, ["lamp"]);
    // The ceiling ends at 158 units, 10 above: it fills sin² θ = 1 − 1/(1 + 15.8²) of the floor's sky and a little in its corners.
    let luminance = crate::common::mean(&film(&scene))[1];
    assert!((luminance / 50.0 - 0.997).abs() < 0.01, "{luminance}");
}
