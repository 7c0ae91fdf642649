//! The figure of reflectance curves.
//!
//! One model: a panel for each material, in it the curves at all wavelengths (or angles) in colours of their own, s dashed and p dotted.
//! Several models: a panel for each material and wavelength, in it a colour for each model, the exact one thick below them.

use super::curve::{Lane, Over, Row};
use crate::fresnel::FresnelModel;
use crate::report::plot::{Axis, Dash, Figure, Ink, Key, PALETTE, Panel, Series, Style};

/// A figure of more panels is one that nobody reads.
pub const MOST_PANELS: usize = 36;

/// Of more curves s and p are not drawn.
const MOST_POLARISED: usize = 6;

/// Legends name no more curves of a family than this, evenly chosen.
const MOST_KEYS: usize = 12;

/// Of the largest reflectance: what falls below is shown with its zero.
const ZERO_BELOW: f64 = 0.5;

/// What is at one wavelength, in one channel, or at one angle.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Member {
    Lane(Lane),
    /// Degrees.
    Angle(f64),
}

impl Member {
    fn of(row: &Row, over: Over) -> Self {
        match over {
            Over::Angle => Self::Lane(row.lane),
            Over::Wavelength => Self::Angle(row.theta_deg),
        }
    }

    fn label(self) -> String {
        match self {
            Self::Lane(Lane::Nm(nm)) => format!("{nm} nm"),
            Self::Lane(Lane::Channel(channel)) => ["red", "green", "blue"][channel % 3].to_owned(),
            Self::Angle(degrees) => format!("{}°", (degrees * 100.0).round() / 100.0),
        }
    }

    /// The lane's own colour, or one of the palette.
    fn ink(self, place: usize) -> Ink {
        match self {
            Self::Lane(Lane::Nm(nm)) => spectral_ink(nm),
            Self::Lane(Lane::Channel(channel)) => spectral_ink([630.0, 545.0, 455.0][channel % 3]),
            Self::Angle(_) => PALETTE[place % PALETTE.len()],
        }
    }
}

/// nm, and a colour that reads as that of the wavelength on white and on black, apart in lightness too.
const SPECTRAL_INKS: [(f64, Ink); 9] = [
    (400.0, Ink::new(0x5a3fb0, 0xa08cf0)),
    (450.0, Ink::new(0x1f4fc0, 0x6f9cff)),
    (490.0, Ink::new(0x0f86a8, 0x4cc6e6)),
    (520.0, Ink::new(0x159a58, 0x45d08c)),
    (550.0, Ink::new(0x4e9a1e, 0x8edb55)),
    (580.0, Ink::new(0xc09a00, 0xf2d04a)),
    (610.0, Ink::new(0xd96a10, 0xff9f50)),
    (650.0, Ink::new(0xb8252c, 0xff6f6f)),
    (700.0, Ink::new(0x7e1620, 0xd95560)),
];

fn spectral_ink(nm: f64) -> Ink {
    let mut below = SPECTRAL_INKS[0];
    for above in SPECTRAL_INKS {
        if nm < above.0 {
            let share = ((nm - below.0) / (above.0 - below.0).max(1.0)).clamp(0.0, 1.0);
            return mixed(below.1, above.1, share);
        }
        below = above;
    }
    below.1
}

fn mixed(a: Ink, b: Ink, share: f64) -> Ink {
    let mix = |a: [u8; 3], b: [u8; 3]| {
        std::array::from_fn(|i| (f64::from(a[i]) + share * (f64::from(b[i]) - f64::from(a[i]))).round() as u8)
    };
    Ink { light: mix(a.light, b.light), dark: mix(a.dark, b.dark) }
}

/// What occurs, in the order of its first occurrence.
fn distinct<T: PartialEq>(values: impl Iterator<Item = T>) -> Vec<T> {
    let mut found = Vec::new();
    for value in values {
        if !found.contains(&value) {
            found.push(value);
        }
    }
    found
}

/// Panels in a row: three at most, and none alone in the last row if two rows of two hold all.
fn columns(panels: usize) -> usize {
    if panels == 4 { 2 } else { panels.min(3) }
}

/// How the rows divide into panels and curves.
struct Plan<'a> {
    rows: &'a [Row],
    over: Over,
    materials: Vec<&'a str>,
    models: Vec<FresnelModel>,
    members: Vec<Member>,
}

/// How many panels [`figure`] would draw.
pub fn panel_count(rows: &[Row], over: Over) -> usize {
    let plan = Plan::new(rows, over);
    plan.materials.len() * if plan.one_model() { 1 } else { plan.members.len() }
}

/// All curves of some models on some materials.
pub fn figure(rows: &[Row], over: Over) -> Figure {
    let plan = Plan::new(rows, over);
    let (across, panels) = if plan.one_model() {
        (columns(plan.materials.len()), plan.materials.iter().map(|material| plan.family(material)).collect())
    } else {
        let panel = |material| plan.members.iter().map(move |&member| (material, member));
        let pairs = plan.materials.iter().flat_map(panel);
        // A row for each material, unless it has one panel only.
        let across = if plan.members.len() == 1 { plan.materials.len() } else { plan.members.len() };
        (columns(across), pairs.map(|(material, member)| plan.comparison(material, member)).collect())
    };
    let names: Vec<_> = plan.models.iter().map(|model| model.name()).collect();
    let against = match over {
        Over::Angle => "the angle of incidence",
        Over::Wavelength => "the wavelength",
    };
    Figure {
        title: format!("Reflectance of {} against {against}", plan.materials.join(", ")),
        description: format!("Fresnel models: {}", names.join(", ")),
        panels,
        columns: across,
        legend: plan.legend(),
    }
}

impl<'a> Plan<'a> {
    fn new(rows: &'a [Row], over: Over) -> Self {
        Self {
            rows,
            over,
            materials: distinct(rows.iter().map(|row| row.material.as_str())),
            models: distinct(rows.iter().map(|row| row.model)),
            members: distinct(rows.iter().map(|row| Member::of(row, over))),
        }
    }

    fn one_model(&self) -> bool {
        self.models.len() == 1
    }

    /// At normal incidence alone s and p are the same, and three curves for each of many members are too many.
    fn polarised(&self) -> bool {
        self.one_model()
            && self.members.len() <= MOST_POLARISED
            && self.rows.iter().any(|row| row.rs.is_some() && row.theta_deg > 0.0)
    }

    fn style(&self, model: FresnelModel) -> Style {
        let others = self.models.iter().filter(|&&other| other != FresnelModel::EXACT);
        match others.into_iter().position(|&other| other == model) {
            Some(place) => Style::nth(place),
            None => Style::new(Ink::TEXT).width(3.0),
        }
    }

    fn member_style(&self, member: Member) -> Style {
        let place = self.members.iter().position(|&other| other == member).unwrap_or(0);
        Style::new(member.ink(place))
    }

    /// One material, one model, all members.
    fn family(&self, material: &str) -> Panel {
        let series = self.members.iter().flat_map(|&member| self.polarisations(material, member)).collect();
        // What all curves have in common stands above them, and not in the legend.
        let member = if let [only] = self.members[..] { Some(only.label()) } else { None };
        let model =
            self.models.first().filter(|&&model| model != FresnelModel::EXACT).map(|model| model.name().to_owned());
        let title: Vec<_> = [Some(material.to_owned()), member, model].into_iter().flatten().collect();
        self.panel(title.join(", "), material, series)
    }

    /// s, p and their mean, as far as they are known and apart.
    fn polarisations(&self, material: &str, member: Member) -> Vec<Series> {
        let rows = || self.of(material).filter(|row| Member::of(row, self.over) == member);
        let style = self.member_style(member);
        let mean = Series { points: self.points(rows(), |row| Some(row.r)), style: style.width(1.8) };
        if !self.polarised() {
            return vec![mean];
        }
        let s = Series { points: self.points(rows(), |row| row.rs), style: style.dash(Dash::Dashed).width(1.1) };
        let p = Series { points: self.points(rows(), |row| row.rp), style: style.dash(Dash::Dotted).width(1.3) };
        vec![s, p, mean]
    }

    /// One material, one member, all models.
    fn comparison(&self, material: &str, member: Member) -> Panel {
        let curve = |model: FresnelModel| {
            let rows = self.of(material).filter(|row| row.model == model && Member::of(row, self.over) == member);
            Series { points: self.points(rows, |row| Some(row.r)), style: self.style(model) }
        };
        let (exact, others): (Vec<_>, Vec<_>) = self.models.iter().partition(|&&model| model == FresnelModel::EXACT);
        let series = exact.into_iter().chain(others).map(|&model| curve(model)).collect();
        self.panel(format!("{material}, {}", member.label()), material, series)
    }

    fn of(&self, material: &str) -> impl Iterator<Item = &'a Row> {
        self.rows.iter().filter(move |row| row.material == material)
    }

    fn points(&self, rows: impl Iterator<Item = &'a Row>, value: fn(&Row) -> Option<f64>) -> Vec<[f64; 2]> {
        let mut points: Vec<_> = rows.filter_map(|row| Some([self.place(row)?, 100.0 * value(row)?])).collect();
        points.sort_by(|a, b| a[0].total_cmp(&b[0]));
        points
    }

    fn place(&self, row: &Row) -> Option<f64> {
        match (self.over, row.lane) {
            (Over::Angle, _) => Some(row.theta_deg),
            (Over::Wavelength, Lane::Nm(nm)) => Some(nm),
            (Over::Wavelength, Lane::Channel(_)) => None,
        }
    }

    /// All panels of a material share their ordinate.
    fn panel(&self, title: String, material: &str, series: Vec<Series>) -> Panel {
        let drawn = |row: &'a Row| {
            let polarised = if self.polarised() { [row.rs, row.rp] } else { [None; 2] };
            polarised.into_iter().flatten().chain([row.r]).map(|value| 100.0 * value)
        };
        let name = match self.rows.first().map(|row| row.lane) {
            Some(Lane::Channel(_)) => "R in linear sRGB (%)",
            _ => "Reflectance R (%)",
        };
        let values: Vec<f64> = self.of(material).flat_map(drawn).collect();
        let [low, high] =
            [values.iter().copied().fold(f64::INFINITY, f64::min), values.iter().copied().fold(0.0, f64::max)];
        // Where most of the way to 0 is used up, the rest of it belongs to the picture.
        let zero = (low < ZERO_BELOW * high).then_some(0.0);
        let y = Axis::around(name, values.into_iter().chain(zero));
        Panel { title, x: self.abscissa(), y, series }
    }

    fn abscissa(&self) -> Axis {
        let places = || self.rows.iter().filter_map(|row| self.place(row));
        let [low, high] = [places().fold(f64::INFINITY, f64::min), places().fold(f64::NEG_INFINITY, f64::max)];
        match self.over {
            Over::Angle if low <= 15.0 && high >= 75.0 => {
                Axis::linear("Angle of incidence θ (°)", [0.0, 90.0]).every(15.0)
            }
            Over::Angle => Axis::around("Angle of incidence θ (°)", places()),
            Over::Wavelength => Axis::linear("Wavelength λ (nm)", [low, high]),
        }
    }

    fn legend(&self) -> Vec<Key> {
        if !self.one_model() {
            let key = |&model: &FresnelModel| Key { label: model.name().to_owned(), style: self.style(model) };
            return self.models.iter().map(key).collect();
        }
        let every = self.members.len().div_ceil(MOST_KEYS).max(1);
        let member = |&member: &Member| Key { label: member.label(), style: self.member_style(member).width(1.8) };
        let named: &[Member] = if self.members.len() > 1 { &self.members } else { &[] };
        let mut keys: Vec<_> = named.iter().step_by(every).map(member).collect();
        if self.polarised() {
            for (label, dash) in
                [("s-polarised", Dash::Dashed), ("p-polarised", Dash::Dotted), ("unpolarised", Dash::Solid)]
            {
                keys.push(Key { label: label.to_owned(), style: Style::new(Ink::TEXT).dash(dash) });
            }
        }
        keys
    }
}
