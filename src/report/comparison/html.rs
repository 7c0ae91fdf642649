//! The report as one HTML page that needs nothing else: pictures are inside, and its policy forbids to load anything.

use super::super::colormap::{DELTA_E, LUMINANCE, Scale};
use super::super::markup::html as escaped;
use super::super::plot::{Axis, Figure, Panel, Series, Style};
use super::super::{Difference, Verdict};
use super::words::{percent, seconds, short, signed};
use super::{Comparison, Curves, Data, JSON_FILE, Line, Variant};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use std::ffi::OsStr;
use std::fmt::Write;
use std::path::Path;

/// PNG files of a variant.
#[derive(Clone, Debug)]
pub struct Pictures {
    pub picture: Vec<u8>,
    pub delta_e: Option<Vec<u8>>,
    pub luminance: Option<Vec<u8>>,
}

const TEMPLATE: &str = include_str!("template.html");
const STYLE: &str = include_str!("style.css");
const SCRIPT: &str = include_str!("script.js");

/// The page, with the pictures of every variant.
pub fn page(comparison: &Comparison, pictures: &[Pictures]) -> Result<String, super::PageError> {
    let page = Page { comparison, pictures };
    let parts = [
        ("title", escaped(title(&comparison.scene))),
        ("style", STYLE.to_owned()),
        ("lead", page.lead()),
        ("cards", page.cards()),
        ("thumbnails", page.thumbnails()),
        ("options", page.options()),
        ("size", format!("{} / {}", comparison.settings.width, comparison.settings.height)),
        ("legend-delta-e", legend(DELTA_E, |step| step.to_string())),
        ("legend-luminance", legend(LUMINANCE, signed_percent)),
        ("maps", page.maps()),
        ("rows", page.rows()),
        ("chance", page.chance()),
        ("curves", comparison.curves.iter().map(figure).collect()),
        ("data", comparison.data.iter().map(source).collect()),
        ("settings", page.settings()),
        ("command", escaped(&comparison.settings.command)),
        ("json", JSON_FILE.to_owned()),
        ("script", SCRIPT.to_owned()),
    ];
    filled(TEMPLATE, &parts)
}

/// A template with every `{{name}}` replaced, once: what is put in is not looked at again.
pub fn filled(template: &str, parts: &[(&str, String)]) -> Result<String, super::PageError> {
    let mut pieces = template.split("{{");
    let mut page = pieces.next().unwrap_or_default().to_owned();
    for piece in pieces {
        let (name, rest) = piece.split_once("}}").ok_or_else(|| super::PageError(piece.to_owned()))?;
        let (_, part) =
            parts.iter().find(|(known, _)| *known == name).ok_or_else(|| super::PageError(name.to_owned()))?;
        page += part;
        page += rest;
    }
    Ok(page)
}

struct Page<'a> {
    comparison: &'a Comparison,
    pictures: &'a [Pictures],
}

impl Page<'_> {
    fn lead(&self) -> String {
        let Comparison { settings, variants, reference_noise, interrupted, .. } = self.comparison;
        let cut = if *interrupted { "It was interrupted before all samples were taken. " } else { "" };
        format!(
            "{cut}{} variants of one scene, {} × {} pixels, {} samples a pixel with the same random numbers in every variant. \
             Differences are from <b>{}</b>, whose own noise is ΔE2000 {} in the mean.",
            variants.len(),
            settings.width,
            settings.height,
            settings.samples,
            escaped(&variants[0].label),
            short(reference_noise.delta_e2000)
        )
    }

    fn compared(&self) -> impl Iterator<Item = (usize, &Variant, &Difference)> {
        let with = |(i, variant): (usize, &'_ Variant)| variant.difference.as_ref().map(|_| i);
        let numbers: Vec<usize> = self.comparison.variants.iter().enumerate().filter_map(with).collect();
        numbers.into_iter().filter_map(|i| {
            let variant = &self.comparison.variants[i];
            Some((i, variant, variant.difference.as_ref()?))
        })
    }

    fn cards(&self) -> String {
        let card = |(_, variant, difference): (usize, &Variant, &Difference)| {
            let delta_e = &difference.delta_e2000;
            let [low, high] = delta_e.interval_95.map(short);
            format!(
                "<li class=\"card {}\"><h3>{}</h3><p class=\"big\"><span>{}</span> mean ΔE2000</p>{}\
                 <p class=\"quiet\">95 % interval {low} … {high}<br>of noise alone {}<br>energy {}</p></li>",
                class(difference.verdict),
                escaped(&variant.label),
                short(delta_e.mean),
                match difference.verdict {
                    Verdict::Different => String::new(),
                    alike => format!("<p class=\"verdict\">{}</p>", verdict(alike)),
                },
                short(delta_e.noise),
                percent(difference.energy.value)
            )
        };
        self.compared().map(card).collect()
    }

    fn thumbnails(&self) -> String {
        let one = |(i, (variant, pictures)): (usize, (&Variant, &Pictures))| {
            let label = escaped(&variant.label);
            format!(
                "<button type=\"button\" class=\"thumb\" data-key=\"picture-{i}\"><img id=\"picture-{i}\" alt=\"{label}\" src=\"{}\"><span>{label}</span></button>",
                uri(&pictures.picture)
            )
        };
        self.comparison.variants.iter().zip(self.pictures).enumerate().map(one).collect()
    }

    /// What both sides of the wipe can show, by the ids of the pictures.
    fn options(&self) -> String {
        let group = |name: &str, key: &str, from: usize| {
            let all = self.comparison.variants.iter().enumerate().skip(from);
            let options: String = all
                .map(|(i, variant)| format!("<option value=\"{key}-{i}\">{}</option>", escaped(&variant.label)))
                .collect();
            format!("<optgroup label=\"{name}\">{options}</optgroup>")
        };
        group("Pictures", "picture", 0) + &group("ΔE2000", "delta-e", 1) + &group("Luminance", "luminance", 1)
    }

    fn maps(&self) -> String {
        let reference = escaped(&self.comparison.variants[0].label);
        let mut maps = String::new();
        for (i, variant, difference) in self.compared() {
            let label = escaped(&variant.label);
            let image = |key: &str, what: &str, bytes: &Option<Vec<u8>>| {
                let Some(bytes) = bytes else { return String::new() };
                format!("<img id=\"{key}-{i}\" alt=\"{what} of {label} from {reference}\" src=\"{}\">", uri(bytes))
            };
            let pictures = &self.pictures[i];
            let _ = write!(
                maps,
                "<figure class=\"pair\"><figcaption><b>{label}</b> <span class=\"quiet\">{}</span></figcaption>{}{}</figure>",
                verdict(difference.verdict),
                image("delta-e", "ΔE2000", &pictures.delta_e),
                image("luminance", "difference of luminance", &pictures.luminance)
            );
        }
        maps
    }

    fn rows(&self) -> String {
        self.comparison.variants.iter().map(row).collect()
    }

    /// What intervals hold that no path may have found.
    fn chance(&self) -> String {
        let way = &self.comparison.by_chance;
        let differences = self.comparison.variants.iter().filter_map(|variant| variant.difference.as_ref());
        let most =
            differences.map(|difference| difference.missed).max_by(|a, b| a.delta_e2000.total_cmp(&b.delta_e2000));
        most.filter(|missed| missed.delta_e2000 > 0.0).map_or(String::new(), |missed| {
            format!(
                "<p>Nothing aims at some of the light: {}. Paths may not have found it, so that intervals reach {} ΔE2000 and {} % of \
                 energy further.</p>",
                escaped(way),
                short(missed.delta_e2000),
                short(100.0 * missed.energy)
            )
        })
    }

    fn settings(&self) -> String {
        let Comparison { settings, rendering_seconds, report_seconds, version, .. } = self.comparison;
        let replicates = settings.replicate_seeds.len() as u64;
        let entries = [
            ("scene", self.comparison.scene.clone()),
            ("version", format!("spectrel {version}")),
            ("picture", format!("{} × {} pixels", settings.width, settings.height)),
            (
                "samples",
                format!(
                    "{} a pixel: {replicates} replicates of {}",
                    settings.samples,
                    settings.samples / replicates.max(1)
                ),
            ),
            ("seed", settings.seed.to_string()),
            (
                "exposure",
                format!("{:.2} EV: white is {} cd/m²", settings.exposure_ev, short(libm::exp2(settings.exposure_ev))),
            ),
            ("white", settings.white_balance.clone()),
            ("observer", settings.observer.clone()),
            (
                "time",
                format!(
                    "rendering {}, comparing {}, {} threads",
                    seconds(*rendering_seconds),
                    seconds(*report_seconds),
                    settings.threads
                ),
            ),
        ];
        entries.iter().map(|(name, value)| format!("<dt>{name}</dt><dd>{}</dd>", escaped(value))).collect()
    }
}

/// The name of a scene's file without folder and ending.
fn title(scene: &str) -> &str {
    Path::new(scene).file_stem().and_then(OsStr::to_str).unwrap_or(scene)
}

fn uri(png: &[u8]) -> String {
    format!("data:image/png;base64,{}", STANDARD.encode(png))
}

fn class(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Identical => "identical",
        Verdict::Indistinguishable => "same",
        Verdict::Different => "different",
    }
}

fn verdict(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Identical => "identical, sample for sample",
        Verdict::Indistinguishable => "indistinguishable at this sample count",
        Verdict::Different => "different",
    }
}

fn row(variant: &Variant) -> String {
    let ns = variant.ns_per_evaluation.map_or("–".into(), |ns| format!("{ns:.1}"));
    let head = format!(
        "<tr><th scope=\"row\">{}</th><td>{}</td><td>{ns}</td>",
        escaped(&variant.label),
        seconds(variant.render_seconds)
    );
    let Some(difference) = &variant.difference else {
        return head + "<td colspan=\"8\" class=\"note\">the reference</td></tr>";
    };
    let delta_e = &difference.delta_e2000;
    let cells = [
        format!("<b>{}</b><small>{}</small>", short(delta_e.mean), interval(delta_e.interval_95, short)),
        short(delta_e.noise),
        short(delta_e.percentile_95),
        short(delta_e.max),
        format!("{}<small>noise {}</small>", short(difference.rmse), short(difference.rmse_noise)),
        short(difference.rel_mse),
        format!(
            "{}<small>{}</small>",
            percent(difference.energy.value),
            interval(difference.energy.interval_95.map(|end| 100.0 * end), signed)
        ),
    ];
    let cells: String = cells.iter().map(|cell| format!("<td>{cell}</td>")).collect();
    format!("{head}{cells}<td class=\"note\">{}</td></tr>", verdict(difference.verdict))
}

fn interval(ends: [f64; 2], shown: fn(f64) -> String) -> String {
    let [low, high] = ends.map(shown);
    format!("{low} … {high}")
}

fn signed_percent(step: f64) -> String {
    let percent = libm::round(step * 100.0);
    if percent > 0.0 { format!("+{percent}") } else { percent.to_string().replace('-', "−") }
}

/// A bar of a scale's colours with its steps below.
fn legend(scale: Scale, shown: fn(f64) -> String) -> String {
    const STOPS: u32 = 32;
    let stop = |i: u32| {
        let [r, g, b] = scale.at(f64::from(i) / f64::from(STOPS));
        format!("rgb({r},{g},{b})")
    };
    let stops: Vec<String> = (0..=STOPS).map(stop).collect();
    let steps: String = scale.steps.iter().map(|step| format!("<span>{}</span>", shown(*step))).collect();
    format!(
        "<div class=\"bar\" style=\"background:linear-gradient(90deg,{})\"></div><div class=\"steps\">{steps}</div>",
        stops.join(",")
    )
}

/// The curves of a material, over a legend in HTML: labels may be long.
fn figure(curves: &Curves) -> String {
    let entry = |line: &Line| format!("<li>{}{}</li>", style(line).sample_svg(), escaped(&line.label));
    let legend: String = curves.lines.iter().map(entry).collect();
    format!(
        "<figure><figcaption>{}</figcaption>{}<ul class=\"lines\">{legend}</ul></figure>",
        escaped(&curves.title),
        drawn(curves).inline_svg()
    )
}

fn drawn(curves: &Curves) -> Figure {
    let percent = |line: &Line| line.points.iter().map(|&[degrees, r]| [degrees, 100.0 * r]).collect();
    let series: Vec<_> = curves.lines.iter().map(|line| Series { points: percent(line), style: style(line) }).collect();
    let values = series.iter().flat_map(|series| series.points.iter().map(|point| point[1]));
    let y = Axis::amounts("Reflectance R (%)", values);
    let labels: Vec<_> = curves.lines.iter().map(|line| line.label.as_str()).collect();
    Figure {
        title: format!("Reflectance of {}", curves.title),
        description: format!("against the angle of incidence: {}", labels.join(", ")),
        panels: vec![Panel { title: String::new(), x: Axis::incidence(), y, series }],
        columns: 1,
        legend: Vec::new(),
    }
}

fn style(line: &Line) -> Style {
    line.variant.checked_sub(1).map_or_else(Style::reference, Style::nth)
}

fn source(data: &Data) -> String {
    let year = data.year.map_or(String::new(), |year| format!(" ({year})"));
    let journal = data.journal.as_ref().map_or(String::new(), |journal| format!(", {}", escaped(journal)));
    let doi = data.doi.as_ref().map_or(String::new(), |doi| {
        let doi = escaped(doi);
        format!(" <a href=\"https://doi.org/{doi}\" rel=\"noreferrer\">doi:{doi}</a>")
    });
    let range = data.range_nm.map_or(String::new(), |(first, last)| format!(", {}–{} nm", short(first), short(last)));
    format!(
        "<li><b>{}</b> <span class=\"quiet\">{}</span><br>{}{year}: {}{journal}.{doi} <span class=\"quiet\">confidence {}{range}</span></li>",
        escaped(&data.name),
        escaped(&data.used_by.join(", ")),
        escaped(&data.authors),
        escaped(&data.title),
        escaped(&data.confidence)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_put_in_is_not_looked_at_again() {
        let parts = [("a", "{{b}}".to_owned()), ("b", "x".to_owned())];
        assert_eq!(filled("<{{a}}|{{b}}>", &parts).unwrap(), "<{{b}}|x>");
        assert!(filled("{{c}}", &parts).is_err() && filled("{{a", &parts).is_err());
    }

    #[test]
    fn legends_show_every_step() {
        let legend = legend(LUMINANCE, signed_percent);
        assert!(
            legend.contains("<span>−20</span>")
                && legend.contains("<span>0</span>")
                && legend.contains("<span>+5</span>")
        );
    }
}
