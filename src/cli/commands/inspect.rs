//! `spectrel inspect`: what a scene is understood to be.

use crate::cli::scene_file::SceneArgs;
use crate::cli::show;
use crate::geometry::{Mesh, Shape};
use crate::light::Source;
use crate::report::markup;
use crate::scene::describe::ExposureValue;
use crate::scene::{Decision, MediumId, Needs, Object, Overrides, Scene, SceneError, listed, resolve};
use crate::spectrum::{About, citation};
use clap::Args;
use glam::DVec3;
use serde::Serialize;

#[derive(Debug, Args)]
pub struct InspectArgs {
    #[command(flatten)]
    scene: SceneArgs,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct Report {
    /// Pixels.
    width: u32,
    height: u32,
    /// A pixel.
    samples: u32,
    seed: u64,
    /// `None`: automatic.
    exposure_ev: Option<f64>,
    white_balance: String,
    observer: String,
    outside: String,
    /// How many objects and suns shine.
    lights: usize,
    objects: Vec<ObjectReport>,
    physics: Vec<Decision>,
    data: Vec<DataReport>,
    warnings: Vec<String>,
}

#[derive(Serialize)]
struct ObjectReport {
    name: String,
    shape: String,
    material: String,
    kind: String,
    /// Of a mesh.
    extent: Option<Extent>,
}

/// The box around a mesh, as the scene has it.
#[derive(Clone, Copy, Serialize)]
struct Extent {
    /// Scene units.
    size: [f64; 3],
    center: [f64; 3],
    /// Where the scene says how long its unit is.
    size_mm: Option<[f64; 3]>,
    center_mm: Option<[f64; 3]>,
}

impl Extent {
    fn of(shape: &Shape, scene: &Scene) -> Option<Self> {
        let Shape::Mesh(placed) = shape else { return None };
        let bounds = placed.bounds();
        let size = bounds.size().as_dvec3();
        let center = (bounds.min.as_dvec3() + bounds.max.as_dvec3()) / 2.0 + scene.origin;
        let mm = scene.meters_per_unit.map(|metres| metres * 1e3);
        let of = |vector: DVec3| mm.map(|mm| (vector * mm).to_array());
        let [size_mm, center_mm] = [of(size), of(center)];
        Some(Self { size: size.to_array(), center: center.to_array(), size_mm, center_mm })
    }

    fn words(&self) -> String {
        let place = |size, center| format!("{} at ({})", numbers(size, " × "), numbers(center, ", "));
        let units = place(self.size, self.center);
        match (self.size_mm, self.center_mm) {
            (Some(size), Some(center)) => format!("{units}; in mm {}", place(size, center)),
            _ => units,
        }
    }
}

/// Five digits; what is small beside the others is none.
fn numbers(values: [f64; 3], between: &str) -> String {
    let largest = values.iter().fold(0.0f64, |largest, value| largest.max(value.abs()));
    let rounded = values.map(|value| {
        let value = if value.abs() < 1e-6 * largest { 0.0 } else { value };
        format!("{}", format!("{value:.4e}").parse::<f64>().unwrap_or(value))
    });
    rounded.join(between)
}

#[derive(Serialize)]
struct DataReport {
    name: String,
    used_by: Vec<String>,
    range_nm: Option<(f64, f64)>,
    covers_visible: bool,
    confidence: String,
    authors: String,
    year: Option<i32>,
    doi: Option<String>,
}

/// What data should cover, nm; beyond it the eye sees next to nothing.
const VISIBLE_NM: (f64, f64) = (380.0, 780.0);

pub fn run(args: &InspectArgs) -> Result<(), SceneError> {
    let library = args.scene.library.open()?;
    let scene = resolve(args.scene.read()?, &library, &Overrides::default())?;
    let report = report(&scene);
    show::answer(if args.json { markup::json(&report).map_err(SceneError::new)? } else { text(&report) })
}

fn report(scene: &Scene) -> Report {
    let surface = |object: &Object| scene.surfaces[object.surface as usize];
    let objects = scene.objects.iter().zip(scene.world.shapes()).map(|(object, shape)| ObjectReport {
        name: object.name.clone(),
        shape: shape_kind(shape),
        material: object.material.clone(),
        kind: match scene.patterns.get(&object.surface) {
            Some(pattern) => format!("{}, by {}", surface(object).describe(), pattern.files.join(" and ")),
            None => surface(object).describe(),
        },
        extent: Extent::of(shape, scene),
    });
    Report {
        width: scene.settings.width,
        height: scene.settings.height,
        samples: scene.settings.samples,
        seed: scene.settings.seed,
        exposure_ev: match scene.picture.exposure {
            ExposureValue::Auto => None,
            ExposureValue::Ev(ev) => Some(ev),
        },
        white_balance: scene.picture.white_balance.clone(),
        observer: scene.picture.observer.about.name.clone(),
        outside: scene.medium(MediumId::OUTSIDE).name.clone(),
        lights: scene.lights.emitters().iter().filter(|emitter| emitter.source != Source::Map).count(),
        objects: objects.collect(),
        physics: Needs::of(scene).decisions,
        data: data(scene),
        warnings: scene.warnings.clone(),
    }
}

fn data(scene: &Scene) -> Vec<DataReport> {
    let report = |(about, used_by): (&About, Vec<String>)| DataReport {
        name: about.name.clone(),
        used_by,
        range_nm: about.range_nm,
        covers_visible: about.covers_nm(VISIBLE_NM.0, VISIBLE_NM.1),
        confidence: about.confidence().to_string(),
        authors: about.source.authors.clone(),
        year: about.source.year,
        doi: about.source.doi.clone(),
    };
    show::data_sets(&scene.data).into_iter().map(report).collect()
}

fn shape_kind(shape: &Shape) -> String {
    match shape {
        Shape::Sphere(_) => "sphere".into(),
        Shape::Rectangle(_) => "rectangle".into(),
        Shape::Disk(_) => "disk".into(),
        Shape::Mesh(placed) => mesh_kind(placed.mesh()),
        Shape::Convex(solid) => format!("solid of {} facets", solid.facets().len()),
    }
}

fn mesh_kind(mesh: &Mesh) -> String {
    let triangles = mesh.triangles().indices.len();
    match mesh.surroundings().open_edges {
        0 if !mesh.surroundings().is_solid() => format!("mesh of {triangles} triangles that enclose nothing"),
        0 => format!("closed mesh of {triangles} triangles"),
        open => format!("mesh of {triangles} triangles, {open} open edges"),
    }
}

fn text(report: &Report) -> String {
    let count = format!("Objects: {}; lights: {}", report.objects.len(), report.lights);
    let objects = report.objects.iter().map(|o| [&o.name, &o.shape, &o.material, &o.kind].map(String::clone));
    let physics =
        report.physics.iter().map(|d| [d.part, if d.used { "yes" } else { "no" }, &d.reason].map(str::to_owned));
    let mut parts = vec![
        show::section("Picture", &show::columns(&picture_rows(report))),
        show::section(count, &show::columns(&objects.collect::<Vec<_>>())),
        meshes(report),
        show::section("Physics", &show::columns(&physics.collect::<Vec<_>>())),
        show::section("Data", &show::columns(&report.data.iter().map(data_row).collect::<Vec<_>>())),
    ];
    parts.retain(|part| !part.is_empty());
    if !report.warnings.is_empty() {
        parts.push(show::section("Warnings", &report.warnings.join("\n")));
    }
    parts.join("\n\n")
}

/// Size and place of each mesh.
fn meshes(report: &Report) -> String {
    let row = |object: &ObjectReport| Some([object.name.clone(), object.extent?.words()]);
    let rows: Vec<[String; 2]> = report.objects.iter().filter_map(row).collect();
    if rows.is_empty() { String::new() } else { show::section("Meshes, scene units", &show::columns(&rows)) }
}

fn picture_rows(report: &Report) -> Vec<[String; 2]> {
    let size =
        format!("{} × {} pixels, {} samples each, seed {}", report.width, report.height, report.samples, report.seed);
    let exposure =
        report.exposure_ev.map_or("automatic".into(), |ev| format!("{ev} EV: white is {:.1} cd/m²", ev.exp2()));
    [
        ("size", &size),
        ("exposure", &exposure),
        ("white", &report.white_balance),
        ("observer", &report.observer),
        ("outside", &report.outside),
    ]
    .map(|(name, value)| [name.to_owned(), value.clone()])
    .to_vec()
}

fn data_row(data: &DataReport) -> [String; 5] {
    let gap = if data.covers_visible { "" } else { " (short of the visible)" };
    let users: Vec<_> = data.used_by.iter().map(String::as_str).collect();
    [
        data.name.clone(),
        format!("{}{gap}", show::range_nm(data.range_nm)),
        format!("confidence {}", data.confidence),
        citation(&data.authors, data.year),
        format!("for {}", listed(&users)),
    ]
}
