//! The columns of an F0 table.

use super::{Page, Report};
use crate::report::Grid;
use crate::report::f0::{Color, Labels, Row, Table};

/// Digits after the point where people read.
const BRIEF: usize = 4;

impl Report for Table {
    fn brief(&self) -> Grid {
        let mut heading = vec!["Material"];
        let hex = self.has_hex();
        heading.extend(hex.then_some("Hex"));
        heading.extend(["Red", "Green", "Blue", "Tint R", "Tint G", "Tint B", "n_d", "k_d"]);
        heading.extend((!self.spread.is_empty()).then_some("ΔE2000"));
        heading.extend(["Data set", "Source"]);
        Grid::new(&heading, self.materials.iter().map(|row| self.brief_row(row, hex)))
    }

    fn full(&self) -> Grid {
        let columns = columns();
        let heading: Vec<&str> = columns.iter().map(|(name, _)| name.as_str()).collect();
        let conditions = ["illuminant", "observer", "space", "adapt"];
        let Labels { illuminant, observer, space, adapt } = &self.conditions;
        let values = [illuminant.as_str(), observer, space, adapt];
        let row = |row: &Row| {
            let own = columns.iter().map(|(_, value)| value(row));
            own.chain(values.map(str::to_owned)).collect()
        };
        Grid::new(&[heading, conditions.to_vec()].concat(), self.materials.iter().map(row))
    }

    fn notes(&self) -> Vec<String> {
        let mut notes = vec![self.conditions.sentence(), KEY.to_owned(), MORE.to_owned()];
        if self.materials.iter().any(|row| row.f0.encoded == row.f0.linear) {
            notes.push(format!("{} is a linear space: encoded values are the linear ones", self.conditions.space));
        }
        if self.materials.iter().any(|row| !row.f0.in_gamut) {
            let hex = if self.materials.iter().any(|row| row.f0.hex.is_some()) { "; its hex is clipped" } else { "" };
            notes.push(format!("* outside 0…1, printed unclipped{hex}"));
        }
        if self.materials.iter().any(|row| !row.source.covers_visible) {
            notes.push("† ends inside the visible; beyond, its ends are held or its formula is extrapolated".into());
        }
        if self.materials.iter().any(|row| row.source.is_doubtful()) {
            notes.push("‡ of low confidence, or modelled: better data are not public".into());
        }
        notes.extend(self.spread.iter().map(super::super::Spread::sentence));
        // Of a few materials; the other formats say it of all.
        if self.materials.len() <= WHY_OF {
            notes.extend(
                self.materials.iter().filter_map(|row| {
                    row.source.why.as_ref().map(|why| format!("{}: why {}: {why}", row.name, row.ior))
                }),
            );
        }
        notes
    }

    fn page(&self) -> Page {
        super::html::table(self)
    }

    fn materials(&self) -> Option<&Table> {
        Some(self)
    }
}

const KEY: &str = "Red, Green, Blue: linear F0. Tint: F(cos θ = 1/7) against Schlick's, the specular_color of OpenPBR. \
n_d, k_d: at 587.56 nm";
const MORE: &str = "More columns (82°, 1/7, F_avg, encoded values, engines, DOI): --format csv, json, toml or html; files to load: gltf, mtlx";

impl Table {
    fn has_hex(&self) -> bool {
        self.materials.iter().any(|row| row.f0.hex.is_some())
    }

    fn brief_row(&self, row: &Row, hex: bool) -> Vec<String> {
        let number = |value: f64| format!("{value:.BRIEF$}");
        let channel = |value: f64| number(value) + if (0.0..=1.0).contains(&value) { "" } else { "*" };
        let tint = row.engines.openpbr.specular_color.map(|tint| tint.map(number));
        let mut cells = vec![row.name.clone()];
        cells.extend(hex.then(|| row.f0.hex.clone().unwrap_or_default()));
        cells.extend(row.f0.linear.map(channel));
        cells.extend(tint.unwrap_or_else(|| ["–"; 3].map(str::to_owned)));
        cells.extend([number(row.n_d), if row.k_d == 0.0 { "0".into() } else { small(row.k_d) }]);
        cells.extend((!self.spread.is_empty()).then(|| self.distance(row)));
        let short = if row.source.covers_visible { "" } else { " †" };
        let doubtful = if row.source.is_doubtful() { " ‡" } else { "" };
        cells.extend([format!("{}{short}{doubtful}", row.ior), row.source.citation()]);
        cells
    }

    /// ΔE2000 to the set that stands for the material.
    pub(super) fn distance(&self, row: &Row) -> String {
        let own = self.spread.iter().filter(|spread| spread.name == row.name);
        let set = own.flat_map(|spread| &spread.sets).find(|set| set.ior == row.ior);
        set.map_or("–".into(), |set| format!("{:.2}", set.delta_e))
    }
}

/// A k of a clear stone is small.
fn small(value: f64) -> String {
    if value < 1e-4 { format!("{value:.1e}") } else { format!("{value:.BRIEF$}") }
}

/// Of how many materials the brief table says why their data were chosen.
const WHY_OF: usize = 8;

type Column = (String, Box<dyn Fn(&Row) -> String>);

fn column(name: &str, value: impl Fn(&Row) -> String + 'static) -> Column {
    (name.to_owned(), Box::new(value))
}

/// All digits, for programs.
fn number(value: f64) -> String {
    format!("{value:?}")
}

fn optional<T>(value: Option<T>, text: impl Fn(T) -> String) -> String {
    value.map(text).unwrap_or_default()
}

/// Three columns of a colour that a row may lack.
fn rgb(name: &str, value: fn(&Row) -> Option<[f64; 3]>) -> impl Iterator<Item = Column> {
    let channel = move |(index, letter): (usize, &str)| {
        column(&format!("{name}_{letter}"), move |row| optional(value(row), |rgb| number(rgb[index])))
    };
    ["r", "g", "b"].into_iter().enumerate().map(channel).collect::<Vec<_>>().into_iter()
}

fn scalar(name: &str, value: fn(&Row) -> Option<f64>) -> Column {
    column(name, move |row| optional(value(row), number))
}

/// Linear, encoded, hex, in gamut.
fn color(name: &str, pick: fn(&Row) -> &Color) -> Vec<Column> {
    let channel = |kind: &str, part: fn(&Color) -> [f64; 3]| {
        let kind = kind.to_owned();
        let one = move |(index, letter): (usize, &str)| {
            column(&format!("{name}{kind}_{letter}"), move |row| number(part(pick(row))[index]))
        };
        ["r", "g", "b"].into_iter().enumerate().map(one).collect::<Vec<_>>()
    };
    let mut columns = channel("", |color| color.linear);
    columns.extend(channel("_encoded", |color| color.encoded));
    columns.push(column(&format!("{name}_hex"), move |row| pick(row).hex.clone().unwrap_or_default()));
    columns.push(column(&format!("{name}_in_gamut"), move |row| pick(row).in_gamut.to_string()));
    columns
}

fn columns() -> Vec<Column> {
    let mut columns = vec![
        column("name", |row| row.name.clone()),
        column("ior", |row| row.ior.clone()),
        column("class", |row| row.class.to_owned()),
        scalar("n_d", |row| Some(row.n_d)),
        scalar("k_d", |row| Some(row.k_d)),
    ];
    columns.extend(color("f0", |row| &row.f0));
    columns.extend(color("f82", |row| &row.f82));
    columns.extend(color("f_mu17", |row| &row.f_mu17));
    columns.extend(color("f_avg", |row| &row.f_avg));
    columns.push(scalar("luminance", |row| Some(row.luminance)));
    columns.push(scalar("specular_level", |row| row.specular.map(|specular| specular.level)));
    columns.push(scalar("specular_reflectance", |row| row.specular.map(|specular| specular.reflectance)));
    columns.push(scalar("specular_ior", |row| row.specular.map(|specular| specular.ior)));
    columns.extend(engines());
    columns.extend(source());
    columns
}

fn engines() -> Vec<Column> {
    let mut columns: Vec<_> =
        rgb("gltf_baseColorFactor", |row| row.engines.gltf.base_color_factor.map(|[r, g, b, _]| [r, g, b])).collect();
    columns.push(scalar("gltf_metallicFactor", |row| Some(row.engines.gltf.metallic_factor)));
    columns.push(scalar("gltf_ior", |row| row.engines.gltf.ior));
    columns.extend(rgb("filament_baseColor", |row| row.engines.filament.base_color));
    columns.extend(rgb("filament_baseColor_sRGB", |row| row.engines.filament.base_color_srgb));
    columns.push(scalar("filament_metallic", |row| Some(row.engines.filament.metallic)));
    columns.push(scalar("filament_reflectance", |row| row.engines.filament.reflectance));
    columns.extend(rgb("unreal_BaseColor", |row| row.engines.unreal.base_color));
    columns.push(scalar("unreal_Metallic", |row| Some(row.engines.unreal.metallic)));
    columns.push(scalar("unreal_Specular", |row| row.engines.unreal.specular));
    columns.extend(rgb("openpbr_base_color", |row| row.engines.openpbr.base_color));
    columns.push(scalar("openpbr_base_metalness", |row| Some(row.engines.openpbr.base_metalness)));
    columns.extend(rgb("openpbr_specular_color", |row| row.engines.openpbr.specular_color));
    columns.push(scalar("openpbr_specular_ior", |row| row.engines.openpbr.specular_ior));
    columns.extend(rgb("disney_baseColor", |row| row.engines.disney.base_color));
    columns.push(scalar("disney_metallic", |row| Some(row.engines.disney.metallic)));
    columns.push(scalar("disney_specular", |row| row.engines.disney.specular));
    columns
}

fn source() -> Vec<Column> {
    vec![
        column("source_title", |row| row.source.title.clone()),
        column("source_authors", |row| row.source.authors.clone()),
        column("source_journal", |row| row.source.journal.clone().unwrap_or_default()),
        column("source_year", |row| optional(row.source.year, |year| year.to_string())),
        column("source_doi", |row| row.source.doi.clone().unwrap_or_default()),
        column("sample", |row| row.source.sample.clone()),
        column("confidence", |row| row.source.confidence.clone()),
        column("range_first_nm", |row| optional(row.source.range_nm, |(first, _)| first.to_string())),
        column("range_last_nm", |row| optional(row.source.range_nm, |(_, last)| last.to_string())),
        column("covers_visible", |row| row.source.covers_visible.to_string()),
        column("why", |row| row.source.why.clone().unwrap_or_default()),
    ]
}
