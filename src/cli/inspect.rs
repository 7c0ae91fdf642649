//! `spectrel inspect`: what a scene is understood to be.

use super::{SceneArgs, show};
use crate::geometry::Shape;
use crate::scene::{Decision, Interface, Needs, Overrides, Scene, SceneError, Surface, resolve};
use clap::Args;
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
    width: u32,
    height: u32,
    samples: u32,
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
}

#[derive(Serialize)]
struct DataReport {
    used_by: String,
    name: String,
    range_nm: Option<(f64, f64)>,
    covers_visible: bool,
    confidence: String,
    authors: String,
    year: Option<i32>,
    doi: Option<String>,
}

pub fn run(args: &InspectArgs) -> Result<(), SceneError> {
    let library = args.scene.library.open()?;
    let scene = resolve(args.scene.read()?, &library, &Overrides::default())?;
    let report = report(&scene, Needs::of(&scene).decisions);
    if args.json {
        show::answer(serde_json::to_string_pretty(&report).map_err(SceneError::new)?);
    } else {
        show::answer(text(&report));
    }
    Ok(())
}

fn report(scene: &Scene, physics: Vec<Decision>) -> Report {
    let objects = scene.objects.iter().zip(scene.world.shapes()).map(|(object, shape)| ObjectReport {
        name: object.name.clone(),
        shape: shape_kind(shape),
        material: object.material.clone(),
        kind: surface_kind(&scene.surfaces[object.surface as usize]),
    });
    let data = scene.data.iter().map(|data| DataReport {
        used_by: data.used_by.clone(),
        name: data.about.name.clone(),
        range_nm: data.about.range_nm,
        covers_visible: data.about.covers_nm(380.0, 780.0),
        confidence: data.about.confidence().to_string(),
        authors: data.about.source.authors.clone(),
        year: data.about.source.year,
        doi: data.about.source.doi.clone(),
    });
    Report {
        width: scene.settings.width,
        height: scene.settings.height,
        samples: scene.settings.samples,
        lights: scene.lights.emitters().len(),
        objects: objects.collect(),
        physics,
        data: data.collect(),
        warnings: scene.warnings.clone(),
    }
}

fn shape_kind(shape: &Shape) -> String {
    match shape {
        Shape::Sphere(_) => "sphere".into(),
        Shape::Rectangle(_) => "rectangle".into(),
        Shape::Disk(_) => "disk".into(),
        Shape::Convex(solid) => format!("solid of {} facets", solid.facets().len()),
    }
}

fn surface_kind(surface: &Surface) -> String {
    match surface {
        Surface::Black => "black".into(),
        Surface::Diffuse { .. } => "diffuse".into(),
        Surface::Conductor { alpha: 0.0, model, .. } => format!("smooth conductor, {model} Fresnel"),
        Surface::Conductor { alpha, model, .. } => format!("conductor of roughness {alpha}, {model} Fresnel"),
        Surface::Dielectric(Interface { model, .. }) => format!("dielectric, {model} Fresnel"),
    }
}

fn text(report: &Report) -> String {
    let mut parts = vec![format!(
        "{} × {} pixels, {} samples each; {} objects, {} of them shine",
        report.width,
        report.height,
        report.samples,
        report.objects.len(),
        report.lights
    )];
    let objects: Vec<[String; 4]> = report
        .objects
        .iter()
        .map(|o| [format!("  {}", o.name), o.shape.clone(), o.material.clone(), o.kind.clone()])
        .collect();
    parts.push(format!("Objects\n{}", show::columns(&objects)));
    let physics: Vec<[String; 3]> = report
        .physics
        .iter()
        .map(|d| [format!("  {}", d.part), if d.used { "yes" } else { "no" }.into(), d.reason.clone()])
        .collect();
    parts.push(format!("Physics\n{}", show::columns(&physics)));
    let data: Vec<[String; 4]> = report.data.iter().map(data_row).collect();
    parts.push(format!("Data\n{}", show::columns(&data)));
    parts.extend((!report.warnings.is_empty()).then(|| format!("Warnings\n  {}", report.warnings.join("\n  "))));
    parts.join("\n\n")
}

fn data_row(data: &DataReport) -> [String; 4] {
    let range = data.range_nm.map_or("everywhere".into(), |(first, last)| format!("{first}–{last} nm"));
    let cover = if data.covers_visible { "" } else { ", does not cover 380–780 nm" };
    let year = data.year.map_or(String::new(), |year| format!(" {year}"));
    let first_author = data.authors.split([',', ';']).next().unwrap_or_default();
    [
        format!("  {}", data.used_by),
        data.name.clone(),
        format!("{range}{cover}"),
        format!("{first_author}{year}, confidence {}", data.confidence),
    ]
}
