//! Scenes far from the origin: what the camera looks at there comes out to the bit as it does at home, and what single precision cannot
//! place is told.

use crate::common::files::{cuboid, obj};
use crate::common::{film, scene};
use glam::{DVec3, Vec3};
use spectrel::scene::Overrides;

/// Lamps, a stone, metal and glass on a floor: each kind of shape, by itself, by a transform and as copies.
fn at(place: DVec3, mesh: &str) -> String {
    let from = |x: f64, y: f64, z: f64| format!("{:?}", (place + DVec3::new(x, y, z)).to_array());
    let inwards = DVec3::new(-1.0, 0.5, 2.0);
    let planes = [DVec3::X, -DVec3::X, DVec3::Y, -DVec3::Y, DVec3::Z, -DVec3::Z, inwards].map(|normal| {
        let DVec3 { x, y, z } = normal;
        format!("[{x:?}, {y:?}, {z:?}, {:?}]", 0.5 + normal.dot(place + DVec3::new(2.0, 0.0, 0.5)))
    });
    format!(
        "meters_per_unit = 1
        render = {{ width = 24, height = 16, samples = 8 }}
        camera = {{ position = {}, look_at = {}, fov = 40 }}
        environment.gradient.zenith = {{ spectrum = \"D65\", luminance = 20 }}
        environment.gradient.horizon = {{ spectrum = \"A\", luminance = 5 }}
        environment.gradient.nadir = {{ spectrum = \"A\", luminance = 1 }}
        [[points]]
        position = {}
        spectrum = \"A\"
        luminous_intensity = 100
        [[objects]]
        shape.sphere = {{ radius = 0.3, center = {} }}
        emission = {{ spectrum = \"E\", luminance = 1000 }}
        [[objects]]
        material = \"titanium\"
        shape.rectangle = {{ size = [20, 20], center = {} }}
        [[objects]]
        material = \"gold\"
        shape.disk = {{ radius = 0.5, center = {}, normal = [0, -1, 1] }}
        [[objects]]
        material = \"fused-silica\"
        shape.box = {{ size = [0.5, 0.5, 0.5], center = {} }}
        [[objects]]
        material = \"silver\"
        shape.convex.planes = [{}]
        [[objects]]
        material = \"diamond\"
        shape.brilliant = {{ diameter = 1 }}
        transform = {{ rotate = [20, 0, 30], translate = {} }}
        [[objects]]
        material = \"copper\"
        {mesh}
        transform.scale = 0.3
        copies = [{{ translate = {} }}, {{ translate = {}, rotate = [0, 0, 45] }}]\n",
        from(0.0, -8.0, 5.0),
        from(0.0, 0.0, 0.0),
        from(-2.0, -3.0, 4.0),
        from(1.0, -1.0, 3.0),
        from(0.0, 0.0, 0.0),
        from(-1.5, 1.0, 0.6),
        from(0.0, 1.5, 0.25),
        planes.join(", "),
        from(0.0, -1.0, 0.25),
        from(-2.0, -1.0, 0.25),
        from(1.0, -2.0, 0.25),
    )
}

/// Far away by whole units, so that adding them rounds nothing.
const AWAY: DVec3 = DVec3::new(1_000_000.0, -2_000_000.0, 500_000.0);

#[test]
fn a_scene_far_away_is_the_same_to_the_bit() {
    let folder = tempfile::tempdir().expect("a folder");
    let mesh = obj(folder.path(), "block", &cuboid([0.0; 3], [1.0; 3]));
    let [home, away] = [DVec3::ZERO, AWAY].map(|place| scene(&at(place, &mesh), &Overrides::default()));
    assert!(film(&home) == film(&away), "a scene by itself and {AWAY} away");
    assert_eq!(home.warnings, away.warnings);
}

/// What has no place of its own, and what only a file places, moves with the origin, too.
#[test]
fn stones_and_meshes_that_nothing_moves_keep_their_places() {
    let folder = tempfile::tempdir().expect("a folder");
    let mesh = obj(folder.path(), "block", &cuboid([1.0, 0.0, 0.0], [1.0; 3]));
    let shapes = ["shape.brilliant = { diameter = 3 }", "shape.step-cut = { width = 1, length = 2 }", &mesh];
    let objects = shapes.map(|shape| format!("[[objects]]\nmaterial = \"gold\"\n{shape}\n")).concat();
    let bounds = |position: [f64; 3], look_at: [f64; 3]| {
        let camera = format!("camera = {{ position = {position:?}, look_at = {look_at:?}, fov = 20 }}\n");
        let scene = scene(&(camera + &objects), &Overrides::default());
        scene.world.shapes().iter().map(|shape| shape.bounds()).collect::<Vec<_>>()
    };
    let home = bounds([0.0, -8.0, 5.0], [0.0; 3]);
    let away = bounds([4096.0, -8.0, 5.0], [4096.0, 0.0, 0.0]);
    for (home, away) in home.iter().zip(&away) {
        let by = [home.min - away.min, home.max - away.max];
        assert!(by.iter().all(|by| (*by - Vec3::new(4096.0, 0.0, 0.0)).length() < 1e-3), "{by:?}");
    }
}

#[test]
fn places_that_are_rounded_are_told() {
    let told = |place: DVec3, position: [f64; 3], mesh: &str| {
        let text = format!(
            "camera = {{ position = {position:?}, look_at = [0, 0, 0], fov = 40 }}
            environment.constant = {{ spectrum = \"E\", luminance = 1 }}
            [[objects]]\nmaterial = \"gold\"\nshape.sphere = {{ radius = 1, center = [0, 0, 0] }}
            [[objects]]\nname = \"ball\"\nmaterial = \"gold\"\nshape.sphere = {{ radius = 1, center = {:?} }}\n{mesh}",
            place.to_array()
        );
        let warnings = scene(&text, &Overrides::default()).warnings;
        warnings.into_iter().filter(|warning| warning.contains("single precision")).collect::<Vec<_>>()
    };
    let camera = [0.0, -8.0, 5.0];
    assert!(told(DVec3::new(1e4, 0.0, 0.0), camera, "").is_empty());
    let warnings = told(DVec3::new(1e6, 0.0, 0.0), camera, "");
    assert!(
        matches!(&warnings[..], [one] if one.contains("size: ball.") && one.contains("6.0e-2 units")),
        "{warnings:?}"
    );
    // A mesh whose corners are far away in its file, brought back by a transform: what its file has lost stays lost.
    let folder = tempfile::tempdir().expect("a folder");
    let mesh = obj(folder.path(), "block", &cuboid([1e6, 0.0, 0.0], [1.0; 3]));
    let mesh =
        format!("[[objects]]\nname = \"block\"\nmaterial = \"gold\"\n{mesh}\ntransform.translate = [-1e6, 0, 0]\n");
    let warnings = told(DVec3::ZERO, camera, &mesh);
    assert!(matches!(&warnings[..], [one] if one.contains("size: block.")), "{warnings:?}");
}
