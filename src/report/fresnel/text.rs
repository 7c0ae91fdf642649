//! Curves and errors as CSV, Markdown and lines for a terminal. Numbers in CSV are in the shortest form that reads back the same.

use super::curve::{Lane, Row as Point};
use super::errors::{BOUNCES, Row};
use csv::Writer;
use std::io;

/// The columns of a curve's CSV.
const CURVE: [&str; 8] = ["material", "model", "lane", "cos_theta", "theta_deg", "Rs", "Rp", "R"];

/// Curves as CSV; `Rs` and `Rp` are empty for models without polarisation.
pub fn curve_csv(rows: &[Point]) -> io::Result<String> {
    let mut writer = Writer::from_writer(Vec::new());
    writer.write_record(CURVE)?;
    let maybe = |value: Option<f64>| value.map_or(String::new(), |value| value.to_string());
    for row in rows {
        let [cos, theta, r] = [row.cos_theta, row.theta_deg, row.r].map(|value| value.to_string());
        let names = [row.material.clone(), row.model.to_string(), row.lane.to_string()];
        writer.write_record(names.into_iter().chain([cos, theta, maybe(row.rs), maybe(row.rp), r]))?;
    }
    finished(writer)
}

fn finished(writer: Writer<Vec<u8>>) -> io::Result<String> {
    let bytes = writer.into_inner().map_err(|error| io::Error::other(error.to_string()))?;
    String::from_utf8(bytes).map_err(io::Error::other)
}

/// Curves as a Markdown table of four digits: an angle and a wavelength a line.
pub fn curve_markdown(rows: &[Point]) -> String {
    let lane = |lane: Lane| match lane {
        Lane::Nm(nm) => format!("{nm} nm"),
        Lane::Channel(_) => lane.to_string(),
    };
    let maybe = |value: Option<f64>| value.map_or(String::new(), |value| format!("{value:.4}"));
    let line = |row: &Point| {
        let numbers = [maybe(row.rs), maybe(row.rp), format!("{:.4}", row.r)];
        let names = [row.material.clone(), row.model.to_string(), lane(row.lane)];
        let theta = [format!("{}", (row.theta_deg * 100.0).round() / 100.0)];
        names.into_iter().chain(theta).chain(numbers).collect()
    };
    let head = ["Material", "Model", "Lane", "θ (°)", "Rs", "Rp", "R"].map(str::to_owned).to_vec();
    markdown(&head, &rows.iter().map(line).collect::<Vec<_>>(), 3)
}

/// A table whose columns from `numbers` on are set to the right.
fn markdown(head: &[String], rows: &[Vec<String>], numbers: usize) -> String {
    let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
    let rule = |column: usize| if column < numbers { "---" } else { "---:" }.to_owned();
    let rule: Vec<_> = (0..head.len()).map(rule).collect();
    let body: String = rows.iter().map(|row| line(row)).collect();
    format!("{}{}{body}", line(head), line(&rule))
}

/// The lights that errors are of, the one of the fits first.
fn lights(rows: &[Row]) -> Vec<&str> {
    let colors = rows.first().map(|row| row.colors.as_slice()).unwrap_or_default();
    colors.iter().map(|color| color.light.as_str()).step_by(BOUNCES.len()).collect()
}

/// Errors as CSV: what the JSON has, but for fitted parameters.
pub fn errors_csv(rows: &[Row]) -> io::Result<String> {
    let mut writer = Writer::from_writer(Vec::new());
    let names = ["material", "ior", "model", "max_abs", "cos_at_max", "rms", "de_mean", "de_max", "cos_at_de_max"];
    let head = names.into_iter().chain(["f_avg_max_abs", "f_avg_de", "ns"]).map(str::to_owned);
    let colors = rows.first().map(|row| row.colors.as_slice()).unwrap_or_default();
    let of_colors = colors.iter().flat_map(|color| {
        let case = format!("{}_x{}", color.light.to_lowercase(), color.bounces);
        ["de_mean", "de_max", "cos_at_de_max", "de_normal"].map(|name| format!("{name}_{case}"))
    });
    writer.write_record(head.chain(of_colors))?;
    for row in rows {
        let names = [row.material.clone(), row.ior.clone(), row.model.to_string()];
        let first = [row.max_abs, row.cos_at_max, row.rms, row.de_mean, row.de_max, row.cos_at_de_max];
        let colors =
            row.colors.iter().flat_map(|color| [color.de_mean, color.de_max, color.cos_at_de_max, color.de_normal]);
        let numbers = first.into_iter().chain([row.f_avg_max_abs, row.f_avg_de, row.ns]).chain(colors);
        writer.write_record(names.into_iter().chain(numbers.map(|value| value.to_string())))?;
    }
    finished(writer)
}

/// The columns of the tables for people, and their cells.
fn cells(rows: &[Row]) -> (Vec<String>, Vec<Vec<String>>) {
    let lights = lights(rows);
    let (first, others) = lights.split_first().map_or(("", &[][..]), |(first, others)| (*first, others));
    let cases: Vec<(&str, i32)> =
        BOUNCES[1..].iter().map(|&bounces| (first, bounces)).chain(others.iter().map(|&light| (light, 1))).collect();
    // The angle of no error at all is none.
    let angle =
        |of: f64, cos: f64| if of > 0.0 { format!("{:.0}°", libm::acos(cos).to_degrees()) } else { "–".into() };
    let line = |row: &Row| {
        let case = |&(light, bounces): &(&str, i32)| row.color(light, bounces).map_or(String::new(), |c| de(c.de_mean));
        let fixed = [
            row.model.to_string(),
            format!("{:.4}", row.max_abs),
            angle(row.max_abs, row.cos_at_max),
            format!("{:.4}", row.rms),
            format!("{:.4}", row.f_avg_max_abs),
            de(row.de_mean),
            de(row.de_max),
            angle(row.de_max, row.cos_at_de_max),
        ];
        fixed.into_iter().chain(cases.iter().map(case)).chain([format!("{:.1}", row.ns)]).collect()
    };
    let name = |&(light, bounces): &(&str, i32)| if light == first { format!("×{bounces}") } else { light.to_owned() };
    let fixed = ["Model", "ΔR max", "at", "ΔR rms", "ΔF_avg", "ΔE", "ΔE max", "at"].map(str::to_owned);
    let head = fixed.into_iter().chain(cases.iter().map(name)).chain(["ns".to_owned()]).collect();
    (head, rows.iter().map(line).collect())
}

fn de(value: f64) -> String {
    if value < 9.995 { format!("{value:.2}") } else { format!("{value:.1}") }
}

/// Rows of one material after the other.
fn by_material(rows: &[Row]) -> impl Iterator<Item = &[Row]> {
    rows.chunk_by(|a, b| (&a.material, &a.ior) == (&b.material, &b.ior))
}

/// What the columns of [`errors_table`] mean.
pub const ERRORS_NOTE: &str = "\
ΔR: of linear sRGB under D65, over cos θ = 0, 0.01 … 1; ΔF_avg: of its average over the hemisphere.
ΔE: CIEDE2000, mean over cos θ; ×2, ×3, ×5: the same after so many bounces at equal angle; A, FL2: after one
under that light. ns: of one evaluation, eight wavelengths, on this machine.";

/// Errors for a terminal, a table for each material.
pub fn errors_table(rows: &[Row]) -> String {
    let table = |rows: &[Row]| {
        let (head, lines) = cells(rows);
        format!("{} ({})\n{}\n", rows[0].material, rows[0].ior, aligned(&head, &lines))
    };
    let tables: Vec<_> = by_material(rows).map(table).collect();
    format!("{}\n{ERRORS_NOTE}\n", tables.join("\n"))
}

/// Errors as Markdown, a table for each material.
pub fn errors_markdown(rows: &[Row]) -> String {
    let table = |rows: &[Row]| {
        let (head, lines) = cells(rows);
        format!("### {} (`{}`)\n\n{}", rows[0].material, rows[0].ior, markdown(&head, &lines, 1))
    };
    let tables: Vec<_> = by_material(rows).map(table).collect();
    format!("{}\n{ERRORS_NOTE}\n", tables.join("\n"))
}

/// Names to the left, numbers to the right, two spaces apart.
fn aligned(head: &[String], rows: &[Vec<String>]) -> String {
    let all = || std::iter::once(head).chain(rows.iter().map(Vec::as_slice));
    let width = |column: usize| all().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let line = |row: &[String]| {
        let cell = |(column, cell): (usize, &String)| match column {
            0 => format!("{cell:width$}", width = width(0)),
            _ => format!("{cell:>width$}", width = width(column)),
        };
        row.iter().enumerate().map(cell).collect::<Vec<_>>().join("  ")
    };
    all().map(line).collect::<Vec<_>>().join("\n")
}
