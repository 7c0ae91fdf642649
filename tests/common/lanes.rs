//! One scene for comparing lanes: a solid that reflects a lamp into the camera and refracts the rest.

use super::{replicates, t_of_pairs};
use spectrel::scene::Overrides;

/// Independently seeded pairs of renders.
pub const RENDERS: u64 = 16;

pub fn with(lanes: u32, samples: u32) -> Overrides {
    Overrides { lanes: Some(lanes), samples: Some(samples), ..Overrides::default() }
}

/// Lanes of eight against paths of one wavelength each, of the same scene but for the material given to the second.
pub fn t_of_lanes(scene: impl Fn(&str) -> String, material: &str, other: &str, samples: u32) -> f64 {
    let together = replicates(&scene(material), &with(8, samples), 0, RENDERS);
    let alone = replicates(&scene(other), &with(1, samples), 0, RENDERS);
    t_of_pairs(&together, &alone)
}

/// A solid that reflects a lamp into the camera and refracts the rest, on a dark ground that catches its colours.
pub fn solid(shape: &str, material: &str) -> String {
    format!(
        r#"
        meters_per_unit = 0.001
        render = {{ width = 24, height = 24 }}
        camera = {{ position = [0, -8, 9], look_at = [0, 0, 0.7], fov = 5.5 }}
        environment.gradient.zenith = {{ spectrum = "D65", luminance = 3 }}
        environment.gradient.horizon = {{ spectrum = "A", luminance = 1 }}
        environment.gradient.nadir = {{ spectrum = "A", luminance = 1 }}
        {material}
        [[objects]]
        shape.rectangle = {{ size = [4, 4], center = [0, 7, 8.4], normal = [0, -7, -8] }}
        emission = {{ spectrum = "D65", luminance = 500 }}
        [[objects]]
        material = "ground"
        shape.rectangle = {{ size = [30, 30], center = [0, 0, -0.01] }}
        [[objects]]
        material = "stone"
        {shape}
        [materials.ground]
        diffuse.reflectance = 0.02
        "#
    )
}

pub fn slab(material: &str) -> String {
    solid("shape.box = { size = [6, 5, 0.7] }\ntransform = { rotate = [0, 0, 30], translate = [0, 0, 0.36] }", material)
}

pub fn ball(material: &str) -> String {
    solid("shape.sphere = { radius = 0.8, center = [0, 0, 0.81] }", material)
}
