//! What a person reads on the terminal: for every scene a table, and what it says.

use crate::cli::show;
use crate::report::bench::{Bench, Run, Scene, Variant};
use crate::report::comparison::short;

pub fn answer(bench: &Bench) -> String {
    bench.scenes.iter().map(scene).collect::<Vec<_>>().join("\n\n")
}

fn scene(scene: &Scene) -> String {
    const NAMES: [&str; 11] = [
        "way to render",
        "samples",
        "CPU s",
        "M samples/s",
        "M rays/s",
        "MSE",
        "relMSE",
        "ΔE",
        "bias",
        "noise",
        "1/(MSE·CPU s)",
    ];
    let rows = scene.variants.iter().flat_map(|v| v.runs.iter().enumerate().map(|(n, run)| row(v, n == 0, run)));
    let title = format!("{}, {} × {} pixels; reference: {}", scene.name, scene.width, scene.height, reference(scene));
    let bullets = |texts: &[String]| texts.iter().map(|text| format!("\n  - {text}")).collect::<String>();
    let left_out = match scene.left_out.is_empty() {
        true => String::new(),
        false => format!("\n  left out:{}", bullets(&scene.left_out)),
    };
    let key = "* nothing else has less MSE in less processor time; ~ not known better than the reference; – no bias expected or found";
    format!(
        "{}\n  {key}\n{}{left_out}",
        show::section(title, &show::table(NAMES, rows)),
        bullets(&scene.findings).trim_start_matches('\n')
    )
}

fn reference(scene: &Scene) -> String {
    let reference = &scene.reference;
    let made = match (&reference.file, reference.replicates) {
        (Some(file), _) => file.clone(),
        (None, replicates) => format!("{} renders", replicates.unwrap_or(0)),
    };
    let samples = reference.samples.map_or(String::new(), |samples| format!(", {samples} samples"));
    let noise = reference.delta_e2000.map_or(String::new(), |noise| format!(", ΔE {}", short(noise)));
    format!("{made}{samples}, own MSE {:.1e}{noise}", reference.mse)
}

fn row(variant: &Variant, first: bool, run: &Run) -> [String; 11] {
    let mark = match (run.near_reference, run.pareto) {
        (true, true) => " ~*",
        (true, false) => " ~",
        (false, true) => " *",
        (false, false) => "",
    };
    [
        if first { variant.way.label.clone() } else { String::new() },
        run.samples.to_string(),
        short(run.cpu_seconds),
        short(run.samples_per_second / 1e6),
        short(run.rays_per_second / 1e6),
        format!("{:.2e}", run.mse),
        format!("{:.2e}", run.rel_mse),
        short(run.delta_e2000),
        variant.bias_text(),
        short(run.noise_delta_e2000),
        format!("{}{mark}", short(run.efficiency)),
    ]
}
