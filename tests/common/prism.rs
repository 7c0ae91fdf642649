//! Planes n·x ≤ d of a prism along y whose apex is up, and the light that a ray brings out of it by f64 ray tracing.

use glam::DVec3;
use spectrel::fresnel::exact::reflect;

fn planes() -> [(DVec3, f64); 3] {
    let (sin, cos) = 30f64.to_radians().sin_cos();
    [(DVec3::new(cos, 0.0, sin), 1.0), (DVec3::new(-cos, 0.0, sin), 1.0), (DVec3::NEG_Z, 2.0)]
}

/// Radiance of the sky: linear in the sine of the elevation, from 10 straight down to 90 straight up.
fn sky(direction: DVec3) -> f64 {
    50.0 + 40.0 * direction.z
}

/// A ray inside at a point, until it carries next to nothing.
fn inside(point: DVec3, direction: DVec3, n: f64, weight: f64) -> f64 {
    if weight < 1e-9 {
        return 0.0;
    }
    let exit = |(normal, offset): (DVec3, f64)| {
        let rate = normal.dot(direction);
        (if rate > 1e-12 { (offset - normal.dot(point)).max(0.0) / rate } else { f64::INFINITY }, normal)
    };
    let (t, normal) = planes().into_iter().map(exit).min_by(|a, b| a.0.total_cmp(&b.0)).expect("three planes");
    let (at, cos) = (point + direction * t, normal.dot(direction));
    let r = reflect(n, 1.0, 0.0, cos).r;
    let back = inside(at, direction - 2.0 * cos * normal, n, weight * r);
    if r == 1.0 {
        return back;
    }
    let along = (direction - cos * normal) * n;
    let out = along + normal * (1.0 - along.length_squared()).sqrt();
    back + weight * (1.0 - r) * sky(out)
}

/// What a ray from outside brings that meets the left face.
fn seen(origin: DVec3, direction: DVec3, n: f64) -> f64 {
    let (normal, offset) = planes()[1];
    let t = (offset - normal.dot(origin)) / normal.dot(direction);
    let cos = -normal.dot(direction);
    let r = reflect(1.0, n, 0.0, cos).r;
    let along = (direction + cos * normal) / n;
    let into = along - normal * (1.0 - along.length_squared()).sqrt();
    r * sky(direction + 2.0 * cos * normal) + inside(origin + direction * t, into, n, 1.0 - r)
}

/// From where the camera sees the prism, and whereto it looks.
fn view(height: f64) -> (DVec3, DVec3) {
    (DVec3::new(-20.0, 0.0, height), DVec3::new(-1.0, 0.0, 0.2))
}

/// A camera at a height that sees a prism of this index under the sky, in light of equal energy.
pub fn scene(ior: &str, height: f64) -> String {
    let ends = [(DVec3::Y, 500.0), (DVec3::NEG_Y, 500.0)];
    let planes = planes().into_iter().chain(ends).map(|(normal, offset)| [normal.x, normal.y, normal.z, offset]);
    let (origin, target) = view(height);
    format!(
        "camera = {{ position = {:?}, look_at = {:?}, fov = 0.01 }}
        environment.gradient.zenith = {{ spectrum = \"E\", luminance = 90 }}
        environment.gradient.horizon = {{ spectrum = \"E\", luminance = 50 }}
        environment.gradient.nadir = {{ spectrum = \"E\", luminance = 10 }}
        materials.glass.dielectric = {{ ior = {ior} }}
        [[objects]]\nmaterial = \"glass\"\nshape.convex.planes = {:?}",
        origin.to_array(),
        target.to_array(),
        planes.collect::<Vec<_>>()
    )
}

/// What that camera sees at an index, cd/m² for the whole of the light.
pub fn expected(n: f64, height: f64) -> f64 {
    let (origin, target) = view(height);
    seen(origin, (target - origin).normalize(), n)
}
