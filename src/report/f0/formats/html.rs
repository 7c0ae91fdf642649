//! Pages that need no other file: light and dark, readable on a phone.

use crate::report::Grid;
use crate::report::f0::{Color, Row, Spread, Table};
use crate::report::markup::html as escape;
use crate::spectrum::{RgbSpace, hex_from_srgb};

/// A page in parts.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Page {
    pub title: String,
    /// Plain text, a paragraph each.
    pub paragraphs: Vec<String>,
    /// HTML.
    pub body: String,
}

impl Page {
    /// A page of one table.
    pub fn of_grid(title: &str, paragraphs: Vec<String>, grid: &Grid) -> Self {
        let row = |tag: &str, cells: &[String]| {
            let cells: Vec<_> = cells.iter().map(|cell| format!("<{tag}>{}</{tag}>", with_swatch(cell))).collect();
            format!("<tr>{}</tr>\n", cells.concat())
        };
        let rows: Vec<_> = grid.rows.iter().map(|cells| row("td", cells)).collect();
        let (head, rows) = (row("th", &grid.heading), rows.concat());
        let body = format!("<div class=\"wide\"><table>\n<thead>{head}</thead>\n<tbody>{rows}</tbody></table></div>\n");
        Self { title: title.to_owned(), paragraphs, body }
    }

    /// The page with a list below.
    pub fn with_list(mut self, title: &str, items: &[String]) -> Self {
        if !items.is_empty() {
            let items: Vec<_> = items.iter().map(|item| format!("<li>{}</li>\n", escape(item))).collect();
            self.body += &format!("<h2>{}</h2>\n<ul>\n{}</ul>\n", escape(title), items.concat());
        }
        self
    }

    pub fn html(&self) -> String {
        let title = escape(&self.title);
        let paragraphs: Vec<_> = self.paragraphs.iter().map(|text| format!("<p>{}</p>\n", escape(text))).collect();
        format!(
            "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <meta name=\"color-scheme\" content=\"light dark\">\n<title>{title}</title>\n<style>{STYLE}</style>\n</head>\n\
             <body>\n<main>\n<h1>{title}</h1>\n{}{}</main>\n</body>\n</html>\n",
            paragraphs.concat(),
            self.body
        )
    }
}

const STYLE: &str = include_str!("style.css");

/// The page of an F0 table.
pub(super) fn table(table: &Table) -> Page {
    let cards: Vec<_> =
        table.materials.iter().map(|row| card(row, &table.distance(row), table.conditions.space)).collect();
    let spread: Vec<_> = table.spread.iter().map(Spread::sentence).collect();
    Page {
        title: "F0 of measured materials".into(),
        paragraphs: vec![table.conditions.sentence() + ".", LEGEND.to_owned()],
        body: format!("<section class=\"cards\">\n{}</section>\n", cards.concat()),
    }
    .with_list("How far published sets are apart", &spread)
}

const LEGEND: &str = "Numbers are linear unless they say so, and not clipped; one outside 0…1 is marked, and its swatch is clipped. \
The columns are the reflectance at normal incidence, at 82°, at cos θ = 1/7, and on average over diffuse light. \
n and k are at 587.56 nm.";

/// `distance` is ΔE2000 to the set that stands for the material, where others are told too.
fn card(row: &Row, distance: &str, space: &str) -> String {
    let kinds = [("0°", &row.f0), ("82°", &row.f82), ("cos 1/7", &row.f_mu17), ("average", &row.f_avg)];
    let swatches: Vec<_> = kinds.iter().map(|(name, color)| swatch(name, color, space)).collect();
    let channels = ["Red", "Green", "Blue"].iter().enumerate().map(|(i, channel)| {
        let cells: Vec<_> = kinds.iter().map(|(_, color)| cell(color.linear[i])).collect();
        format!("<tr><th>{channel}</th>{}</tr>\n", cells.concat())
    });
    let head = kinds.map(|(name, _)| format!("<th>{name}</th>")).concat();
    let distance = if distance == "–" { String::new() } else { format!(", ΔE {distance} from the set we use") };
    let k = if row.k_d == 0.0 { String::new() } else { format!(" + {} i", index(row.k_d)) };
    format!(
        "<article>\n<div class=\"swatches\">{}</div>\n<h2>{}</h2>\n<p class=\"kind\">{}, N = {}{k}, Y = {:.4}{distance}</p>\n\
         <table><thead><tr><th></th>{head}</tr></thead>\n<tbody>{}{}</tbody></table>\n{}<p class=\"source\">{}</p>\n</article>\n",
        swatches.concat(),
        escape(&row.name),
        row.class,
        index(row.n_d),
        row.luminance,
        channels.collect::<Vec<_>>().concat(),
        hexes(&kinds),
        engines(row),
        source(row)
    )
}

fn index(value: f64) -> String {
    if value < 1e-4 { format!("{value:.1e}") } else { format!("{value:.4}") }
}

fn cell(value: f64) -> String {
    match (0.0..=1.0).contains(&value) {
        true => format!("<td>{value:.4}</td>"),
        false => format!("<td class=\"out\" title=\"outside 0…1\">{value:.4}</td>"),
    }
}

fn hexes(kinds: &[(&str, &Color); 4]) -> String {
    if kinds.iter().any(|(_, color)| color.hex.is_none()) {
        return String::new();
    }
    let cells = kinds.map(|(_, color)| format!("<td>{}</td>", color.hex.as_deref().unwrap_or_default()));
    format!("<tr><th>Hex</th>{}</tr>\n", cells.concat())
}

/// Browsers know Display P3; of other spaces they are shown what sRGB has of the colour.
fn swatch(name: &str, color: &Color, space: &str) -> String {
    let css = match RgbSpace::from_name(space) {
        Some(RgbSpace::DisplayP3) => {
            let [r, g, b] = color.encoded.map(|value| value.clamp(0.0, 1.0));
            format!("color(display-p3 {r:.4} {g:.4} {b:.4})")
        }
        Some(space) => {
            let to_srgb = space.chromaticities().to(RgbSpace::Srgb);
            hex_from_srgb(to_srgb.map_or(color.linear, |matrix| matrix.apply(color.linear)))
        }
        None => hex_from_srgb(color.linear),
    };
    format!("<span role=\"img\" aria-label=\"colour at {name}\" style=\"background:{css}\" title=\"{name}\"></span>")
}

fn engines(row: &Row) -> String {
    let number = |value: f64| format!("{value:.4}");
    let rgb = |rgb: [f64; 3]| rgb.map(number).join(", ");
    let engines = &row.engines;
    let mut lines: Vec<(&str, &str, Option<String>)> = vec![
        ("glTF", "baseColorFactor", engines.gltf.base_color_factor.map(|rgba| rgba.map(number).join(", "))),
        ("Filament", "baseColor", engines.filament.base_color.map(rgb)),
        ("Filament", "baseColor as sRGB", engines.filament.base_color_srgb.map(rgb)),
        ("Unreal", "BaseColor", engines.unreal.base_color.map(rgb)),
        ("OpenPBR", "base_color", engines.openpbr.base_color.map(rgb)),
        ("OpenPBR", "specular_color", engines.openpbr.specular_color.map(rgb)),
        ("Disney", "baseColor", engines.disney.base_color.map(rgb)),
    ];
    lines.extend([
        ("glTF", "ior", engines.gltf.ior.map(number)),
        ("Filament", "reflectance", engines.filament.reflectance.map(number)),
        ("Unreal", "Specular", engines.unreal.specular.map(number)),
        ("OpenPBR", "specular_ior", engines.openpbr.specular_ior.map(number)),
        ("Disney", "specular", engines.disney.specular.map(number)),
    ]);
    let line = |(engine, name, value): (&str, &str, Option<String>)| {
        value.map(|value| format!("<tr><th>{engine}</th><td><code>{name}</code></td><td>{value}</td></tr>\n"))
    };
    let metallic = format!("metallic {}", row.engines.gltf.metallic_factor);
    let lines: Vec<_> = lines.into_iter().filter_map(line).collect();
    format!(
        "<details><summary>For engines ({metallic}, clipped to 0…1)</summary><table class=\"engines\">{}</table></details>\n",
        lines.concat()
    )
}

fn source(row: &Row) -> String {
    let source = &row.source;
    let mut text =
        format!("<code>{}</code> – {}: {}", escape(&row.ior), escape(&source.authors), escape(&source.title));
    if let Some(journal) = &source.journal {
        text += &format!(", {}", escape(journal));
    }
    if let Some(year) = source.year {
        text += &format!(" ({year})");
    }
    if let Some(doi) = &source.doi {
        text += &format!(", <a href=\"https://doi.org/{0}\">{0}</a>", escape(doi));
    }
    text += &format!(". {}; confidence {}", escape(&source.sample), escape(&source.confidence));
    if let (false, Some((first, last))) = (source.covers_visible, source.range_nm) {
        text += &format!("; <strong>covers {first}–{last} nm only</strong>");
    }
    text += ".";
    if let Some(why) = &source.why {
        text += &format!(" Chosen because: {}.", escape(why));
    }
    text
}

/// A hex colour is shown too.
fn with_swatch(cell: &str) -> String {
    match crate::spectrum::srgb_from_hex(cell) {
        Some(_) if cell.starts_with('#') => format!("<i class=\"dot\" style=\"background:{cell}\"></i> {cell}"),
        _ => escape(cell),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_stays_text() {
        let grid = Grid::new(&["A & B"], [vec!["<script>".to_owned()], vec!["#ffd891".to_owned()]]);
        let html = Page::of_grid("\"<title>\"", vec!["a < b".into()], &grid).html();
        assert!(html.contains("<h1>&quot;&lt;title&gt;&quot;</h1>") && html.contains("<p>a &lt; b</p>"));
        assert!(html.contains("<th>A &amp; B</th>") && html.contains("<td>&lt;script&gt;</td>"));
        assert!(html.contains("background:#ffd891"));
    }
}
