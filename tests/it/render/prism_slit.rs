//! A slit of light through a prism: each line of a lamp in the pixel where refraction puts it.
//!
//! A lamp as thin as a slit stands behind an equilateral prism and is photographed through it, one line of its spectrum at a time.
//! Where the picture must show it follows from Snell's law at two faces, traced here in f64 backwards from the pinhole. The
//! centroid of the rendered line is to be there within half a pixel, and an index a thousandth off must not be. Prisms of BK7 and SF11,
//! as convex solids (light traced within the solid) and as meshes.

use crate::common::files::obj;
use crate::common::meshes;
use crate::common::{film, lanes::with, library, scene};
use glam::DVec3;
use spectrel::geometry::{Convex, Plane};
use std::path::Path;

const COLUMNS: u32 = 400;
const ROWS: u32 = 4;

/// Columns on either side of the brightest that belong to the slit.
const NEAR: usize = 8;

/// Half the slit's width.
const HALF_SLIT: f64 = 0.02;

/// From the prism's middle to its faces.
const SIZE: f64 = 3.0;

/// Planes n·x ≤ d of the prism: its edge runs along y, up.
fn faces() -> [(DVec3, f64); 3] {
    let (sin, cos) = 30f64.to_radians().sin_cos();
    [(DVec3::new(-cos, 0.0, sin), SIZE), (DVec3::new(cos, 0.0, sin), SIZE), (DVec3::NEG_Z, SIZE)]
}

/// Snell's law for a ray that meets a plane whose normal looks against it.
fn refract(direction: DVec3, normal: DVec3, eta: f64) -> DVec3 {
    let cos = -direction.dot(normal);
    let along = (direction + cos * normal) * eta;
    along - normal * (1.0 - along.length_squared()).sqrt()
}

/// A ray through the left face and out of the right one: where it leaves, and whereto.
fn through(origin: DVec3, direction: DVec3, n: f64) -> (DVec3, DVec3) {
    let [left, right, _] = faces();
    let to = |(normal, offset): (DVec3, f64), origin: DVec3, direction: DVec3| {
        origin + direction * ((offset - normal.dot(origin)) / normal.dot(direction))
    };
    let at = to(left, origin, direction);
    let within = refract(direction, left.0, 1.0 / n);
    let out = to(right, at, within);
    (out, refract(within, -right.0, n))
}

/// A camera, a prism and a slit that the camera sees through it in light of index n in the middle of the picture.
struct Bench {
    camera: DVec3,
    forward: DVec3,
    slit: DVec3,
    facing: DVec3,
    /// Horizontal field of view, degrees.
    fov: f64,
}

impl Bench {
    /// At least deviation for the middle index.
    fn new(n: f64, fov: f64) -> Self {
        let incidence = (0.5 * n).asin();
        let (normal, along) = (faces()[0].0, DVec3::new(0.5, 0.0, 0.75f64.sqrt()));
        let forward = -normal * incidence.cos() + along * incidence.sin();
        let camera = SIZE * normal - 30.0 * forward;
        let (exit, out) = through(camera, forward, n);
        Self { camera, forward, slit: exit + 40.0 * out, facing: -out, fov }
    }

    /// Towards a place in the picture, in pixels from its left edge.
    fn ray(&self, x: f64) -> DVec3 {
        let right = self.forward.cross(DVec3::Y).normalize();
        let half = (self.fov / 2.0).to_radians().tan();
        (self.forward + right * (half * (2.0 * x / f64::from(COLUMNS) - 1.0))).normalize()
    }

    /// How far beside the middle of the slit a ray in light of index n meets its plane.
    fn beside(&self, x: f64, n: f64) -> f64 {
        let (origin, direction) = through(self.camera, self.ray(x), n);
        let at = origin + direction * ((self.slit - origin).dot(self.facing) / direction.dot(self.facing));
        (at - self.slit).dot(self.facing.cross(DVec3::Y))
    }

    /// Where the picture must show the slit's middle: halfway between its edges.
    fn predicted(&self, n: f64) -> f64 {
        let edge = |place: f64| {
            let (mut low, mut high) = (0.0, f64::from(COLUMNS));
            let rises = self.beside(high, n) > self.beside(low, n);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if (self.beside(middle, n) < place) == rises { low = middle } else { high = middle }
            }
            0.5 * (low + high)
        };
        0.5 * (edge(-HALF_SLIT) + edge(HALF_SLIT))
    }

    /// Where it does, and how bright all of it is.
    fn rendered(&self, shape: &str, ior: &str, nm: f64) -> (f64, f64) {
        let text = format!(
            "meters_per_unit = 0.01
            render = {{ width = {COLUMNS}, height = {ROWS}, filter = \"box\", samples = 64 }}
            camera = {{ position = {:?}, look_at = {:?}, up = [0, 1, 0], fov = {} }}
            materials.glass.dielectric = {{ ior = {ior}, absorption = 0 }}
            [[objects]]
            material = \"glass\"
            {shape}
            [[objects]]
            shape.rectangle = {{ size = [20, {}], center = {:?}, normal = {:?} }}
            emission = {{ spectrum = {{ lines = [[{nm}, 1]] }}, luminance = 1000 }}\n",
            self.camera.to_array(),
            (self.camera + 30.0 * self.forward).to_array(),
            self.fov,
            2.0 * HALF_SLIT,
            self.slit.to_array(),
            self.facing.to_array(),
        );
        let film = film(&scene(&text, &with(8, 64)));
        let mut columns = vec![0.0; COLUMNS as usize];
        for (i, pixel) in film.pixels().iter().enumerate() {
            columns[i % COLUMNS as usize] += pixel.mean()[1];
        }
        // Around the brightest: light thrown to and fro within the prism shows the slit a second time, faint and elsewhere.
        let brightest = (0..columns.len()).max_by(|&a, &b| columns[a].total_cmp(&columns[b])).expect("columns");
        let near = brightest.saturating_sub(NEAR)..columns.len().min(brightest + NEAR + 1);
        let light: f64 = columns[near.clone()].iter().sum();
        let moment: f64 = near.map(|x| columns[x] * (x as f64 + 0.5)).sum();
        (moment / light, light)
    }
}

/// C, d, e, F and g: hydrogen, helium and mercury, as glass catalogues use them.
const LINES: [f64; 5] = [656.27, 587.56, 546.07, 486.13, 435.83];

/// The prism as half-spaces and as a closed mesh.
fn shapes(folder: &Path) -> [(&'static str, String); 2] {
    let ends = [(DVec3::Y, 15.0), (DVec3::NEG_Y, 15.0)];
    let planes = || faces().into_iter().chain(ends);
    let half_spaces: Vec<[f64; 4]> = planes().map(|(n, offset)| [n.x, n.y, n.z, offset]).collect();
    let solid = Convex::from_planes(&planes().map(|(n, offset)| Plane::new(n, offset)).collect::<Vec<_>>());
    let mesh = meshes::of_convex(&solid.expect("a prism"));
    [("convex", format!("shape.convex.planes = {half_spaces:?}")), ("mesh", obj(folder, "prism", &mesh))]
}

#[test]
fn every_line_of_a_lamp_is_where_refraction_puts_it() {
    let folder = tempfile::tempdir().expect("a folder");
    for (glass, fov) in [("SCHOTT/n-bk7", 2.5), ("SCHOTT/sf11", 8.0)] {
        let ior = library().ior(glass, Path::new("")).expect("in the library");
        let bench = Bench::new(ior.n.at(546.07), fov);
        for (kind, shape) in shapes(folder.path()) {
            let mut places = Vec::new();
            for nm in LINES {
                let predicted = bench.predicted(ior.n.at(nm));
                let (found, light) = bench.rendered(&shape, &format!("\"{glass}\""), nm);
                println!(
                    "{glass}, {kind}, {nm} nm: at {found:.3}, predicted {predicted:.3}, {:+.3} pixels",
                    found - predicted
                );
                assert!(
                    light > 0.0 && (found - predicted).abs() < 0.5,
                    "{glass}, {kind}, {nm} nm: {found}, {predicted}"
                );
                places.push(found);
            }
            let spread = (places[4] - places[0]).abs();
            assert!(spread > 90.0, "{glass}, {kind}: the prism disperses over {spread} pixels");
        }
    }
}

#[test]
fn an_index_a_thousandth_off_puts_the_line_elsewhere() {
    let folder = tempfile::tempdir().expect("a folder");
    let n = library().ior("SCHOTT/n-bk7", Path::new("")).expect("in the library").n.at(546.07);
    let bench = Bench::new(n, 2.5);
    for (kind, shape) in shapes(folder.path()) {
        for factor in [1.0, 1.001, 0.999] {
            let (found, _) = bench.rendered(&shape, &(factor * n).to_string(), 546.07);
            let off = found - bench.predicted(n);
            println!("{kind}, n × {factor}: {off:+.2} pixels");
            assert_eq!(off.abs() < 0.5, factor == 1.0, "{kind}, n × {factor}: off by {off} pixels");
        }
    }
}
