//! Cameras of glTF.

use super::write::{cube_buffer, cube_on};
use super::*;
use serde_json::{Value, json};
use spectrel::geometry::loaders::{FileCamera, Projection};

fn cameras(camera: Value, node: Value) -> Result<Vec<FileCamera>, LoadError> {
    let mut scene = cube_on(json!([{ "mesh": 0, "children": [1] }, node]));
    scene["cameras"] = json!([camera]);
    Ok(load_bytes("glb", &cube_buffer().glb(scene))?.cameras)
}

#[test]
fn a_perspective_camera_looks_along_its_node() {
    let yfov = 2.0 * 0.5_f64.atan();
    let camera = json!({ "type": "perspective", "perspective": { "yfov": yfov, "aspectRatio": 2, "znear": 0.1 } });
    let node = json!({ "name": "eye", "camera": 0, "translation": [0, 1, 5], "scale": [2, 2, 2] });
    let [camera] = cameras(camera, node).unwrap().try_into().unwrap();
    assert_eq!(camera.name, "eye");
    assert_eq!(camera.position, DVec3::new(0.0, -5.0, 1.0));
    assert_eq!((camera.direction, camera.up), (DVec3::Y, DVec3::Z));
    let Projection::Perspective { vertical_fov_degrees, aspect_ratio } = camera.projection else { panic!() };
    assert!((vertical_fov_degrees - yfov.to_degrees()).abs() < 1e-12);
    assert_eq!(aspect_ratio, Some(2.0));
    // tan 45° = 2 · 0.5; the file's ratio goes before that of the picture.
    assert!((camera.projection.horizontal_fov_degrees(1.0).unwrap() - 90.0).abs() < 1e-12);
    let free = Projection::Perspective { vertical_fov_degrees, aspect_ratio: None };
    assert!((free.horizontal_fov_degrees(1.0).unwrap() - vertical_fov_degrees).abs() < 1e-12);
}

#[test]
fn a_turned_orthographic_camera() {
    let h = std::f64::consts::FRAC_1_SQRT_2;
    let camera = json!({ "name": "plan", "type": "orthographic",
                         "orthographic": { "xmag": 3, "ymag": -2, "zfar": 9, "znear": 0 } });
    // A quarter turn about −x: it looks down, the top of the picture is away from the viewer.
    let node = json!({ "camera": 0, "rotation": [-h, 0, 0, h] });
    let [camera] = cameras(camera, node).unwrap().try_into().unwrap();
    assert_eq!(camera.name, "plan");
    assert!((camera.direction - DVec3::NEG_Z).length() < 1e-15);
    assert!((camera.up - DVec3::Y).length() < 1e-15);
    assert_eq!(camera.projection, Projection::Orthographic { width: 6.0, height: 4.0 });
    assert_eq!(camera.projection.horizontal_fov_degrees(1.0), None);
}

#[test]
fn cameras_that_cannot_be() {
    let wrong = |camera: Value, expected: &str| {
        let message = cameras(camera, json!({ "camera": 0 })).unwrap_err().to_string();
        assert!(message.ends_with(expected), "{message}");
    };
    wrong(json!({ "perspective": { "yfov": 4 } }), "camera `camera 0`: yfov is 4, expected an angle between 0 and π");
    wrong(json!({ "perspective": { "yfov": 1, "aspectRatio": 0 } }), "aspectRatio is 0, it must be above zero");
    wrong(json!({ "orthographic": { "xmag": 0, "ymag": 1 } }), "xmag and ymag must not be zero");
    wrong(json!({}), "it has neither `perspective` nor `orthographic`");
    let blind = json!({ "camera": 0, "name": "blind", "scale": [0, 0, 0] });
    assert!(cameras(json!({ "perspective": { "yfov": 1 } }), blind).unwrap().is_empty());
}
