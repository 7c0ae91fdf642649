//! The report as one HTML page that needs nothing else: the figure is inside, and its policy forbids to load anything.

use super::{Bench, CLEAR, JSON_FILE, Reference, Run, SVG_FILE, Scene, Variant, figure};
use crate::report::comparison::{PageError, filled, seconds, short};
use crate::report::markup;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

const TEMPLATE: &str = include_str!("template.html");
/// As of every report, and what is this one's own.
const STYLE: &str = concat!(include_str!("../comparison/style.css"), include_str!("style.css"));

/// The page, with a PNG of every scene.
pub fn page(bench: &Bench, pictures: &[Vec<u8>]) -> Result<String, PageError> {
    let parts = [
        ("style", STYLE.to_owned()),
        ("lead", lead(bench)),
        ("figure", figure(bench).svg()),
        ("scenes", bench.scenes.iter().zip(pictures).enumerate().map(scene).collect()),
        ("meaning", meaning()),
        ("command", markup::html(&bench.command)),
        ("settings", settings(bench)),
        ("json", JSON_FILE.to_owned()),
        ("svg", SVG_FILE.to_owned()),
    ];
    filled(TEMPLATE, &parts)
}

fn lead(bench: &Bench) -> String {
    let scenes: Vec<_> = bench.scenes.iter().map(|scene| format!("<b>{}</b>", markup::html(&scene.name))).collect();
    let several = bench.scenes.iter().flat_map(|scene| &scene.variants).any(|variant| variant.way.changes_several());
    format!(
        "What a render costs and how far it is from the truth, for one way to render after the other. Scenes: {}. \
         Each way differs from the usual one in {}; each was rendered {} times at every count of samples.",
        scenes.join(", "),
        if several { "one thing or several" } else { "one thing" },
        bench.repeats
    )
}

fn scene((n, (scene, picture)): (usize, (&Scene, &Vec<u8>))) -> String {
    let items =
        |texts: &[String]| texts.iter().map(|text| format!("<li>{}</li>", markup::html(text))).collect::<String>();
    let name = markup::html(&scene.name);
    let left_out = match scene.left_out.is_empty() {
        true => String::new(),
        false => {
            format!("<p class=\"quiet\">Left out:</p><ul class=\"findings quiet\">{}</ul>", items(&scene.left_out))
        }
    };
    format!(
        "<section aria-labelledby=\"scene-{n}\">\n<h2 id=\"scene-{n}\">{name}</h2>\n\
         <img class=\"picture\" alt=\"The reference of {name}\" width=\"{}\" height=\"{}\" src=\"data:image/png;base64,{}\">\n<ul class=\"findings\">{}</ul>\n\
         <p class=\"reference\">{}</p>\n{left_out}\
         <div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-labelledby=\"scene-{n}\">\n<table>\n<thead><tr>{}</tr></thead>\n\
         <tbody>{}</tbody>\n</table>\n</div>\n</section>\n",
        scene.width,
        scene.height,
        STANDARD.encode(picture),
        items(&scene.findings),
        markup::html(&reference(scene)),
        heads(),
        scene.variants.iter().map(rows).collect::<String>()
    )
}

/// What errors are measured from, and how good that is.
fn reference(scene: &Scene) -> String {
    let Reference { file, samples, replicates, mse, delta_e2000 } = &scene.reference;
    let counted = samples.map_or(String::new(), |samples| format!(", {samples} samples a pixel"));
    let made = match (file, replicates) {
        (Some(file), _) => format!("{file}{counted}"),
        (None, Some(replicates)) => format!("the mean of {replicates} renders with seeds of their own{counted}"),
        (None, None) => counted,
    };
    let noise = delta_e2000.map_or(String::new(), |noise| format!(", a mean ΔE2000 of {}", short(noise)));
    format!(
        "{} × {} pixels, white is {} cd/m². Reference: {made}; its own error is an MSE of {mse:.2e}{noise}.",
        scene.width,
        scene.height,
        short(libm::exp2(scene.exposure_ev))
    )
}

fn heads() -> String {
    const HEADS: [&str; 12] = [
        "Way to render",
        "Samples",
        "Processor time",
        "Wall time",
        "M samples/s",
        "M rays/s",
        "MSE",
        "relMSE",
        "ΔE2000",
        "of it bias",
        "of it noise",
        "Efficiency",
    ];
    HEADS.map(|head| format!("<th scope=\"col\">{head}</th>")).concat()
}

fn rows(variant: &Variant) -> String {
    variant.runs.iter().enumerate().map(|(n, run)| row(variant, n == 0, run)).collect()
}

fn row(variant: &Variant, first: bool, run: &Run) -> String {
    let class = match (run.near_reference, run.pareto) {
        (true, _) => " class=\"near\"",
        (false, true) => " class=\"front\"",
        (false, false) => "",
    };
    let cells = [
        run.samples.to_string(),
        seconds(run.cpu_seconds),
        seconds(run.wall_seconds),
        short(run.samples_per_second / 1e6),
        short(run.rays_per_second / 1e6),
        format!("{:.2e}", run.mse),
        format!("{:.2e}", run.rel_mse),
        short(run.delta_e2000),
        markup::html(&variant.bias_text()),
        short(run.noise_delta_e2000),
        short(run.efficiency),
    ];
    let cell = |(i, cell): (usize, &String)| {
        let class = if i == 5 || i == 10 { class } else { "" };
        format!("<td{class}>{cell}</td>")
    };
    format!(
        "<tr{}><th scope=\"row\">{}</th>{}</tr>",
        if first { " class=\"first\"" } else { "" },
        if first { markup::html(&variant.way.label) } else { String::new() },
        cells.iter().enumerate().map(cell).collect::<String>()
    )
}

fn meaning() -> String {
    let texts = [
        "Times are the median of the renders at one count, without setting up the scene. Processor time is that of all threads together. A ratio of \
         times is the median over pairs of renders with equal seeds, made one after the other; its interval is that of the sign test."
            .to_owned(),
        format!(
            "MSE and relMSE, the mean of (x − r)² / (r² + 0.01), are of linear sRGB at the exposure of the reference, over pixels and channels; nothing is \
             subtracted. Where the MSE is below {CLEAR} × that of the reference itself, it is set in italics: it is not known better. In green is what no \
             other run beats in both MSE and processor time. Efficiency is 1 / (MSE × processor seconds)."
        ),
        "Bias is what more samples do not cure: the mean ΔE2000 of a way's own mean from that of the usual way at equal seeds, as far as independent \
         renders agree on it; below what noise alone can make, an upper bound is given. Lanes, samplers and the usual way itself should have none, and \
         a dash says that none was found; that of the usual way is looked for from the reference. Noise is the mean \
         ΔE2000 of a render from its way's own mean. The two do not add up to the whole ΔE2000: they stand at an angle to each other."
            .to_owned(),
    ];
    texts.iter().map(|text| format!("<p>{}</p>", markup::html(text))).collect()
}

fn settings(bench: &Bench) -> String {
    let entries = [
        ("version", format!("spectrel {}", bench.version)),
        ("threads", bench.threads.to_string()),
        ("processor time", bench.clock.clone()),
        ("seed", bench.seed.to_string()),
        ("time", format!("{} of a budget of {}", seconds(bench.seconds), seconds(bench.time_budget_seconds))),
    ];
    entries.iter().map(|(name, value)| format!("<dt>{name}</dt><dd>{}</dd>", markup::html(value))).collect()
}
