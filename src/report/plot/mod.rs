//! Figures in SVG: panels of curves with axes, and one legend for all.
//!
//! Of our own because the one well-kept crate for it (`plotters` 0.3) rounds every coordinate to whole pixels, which shows as steps in
//! a flat curve, and writes colours beside each shape where a style sheet cannot change them for dark pages.
//!
//! - Colours are classes named after themselves, so that figures in one page share a style sheet without clashes; the dark ones
//!   are chosen by `prefers-color-scheme`. Renderers without media queries show the light ones.
//! - Text is sans-serif of whoever shows it. Its width is estimated, on the wide side.
//! - `axis`: ranges, ticks and their labels; `svg`: the drawing.

mod axis;
mod svg;

pub use axis::{Axis, Scale};

/// Panels row by row over a legend.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// For screen readers and tabs; not drawn, since a figure has its caption.
    pub title: String,
    pub description: String,
    pub panels: Vec<Panel>,
    /// Panels in a row.
    pub columns: usize,
    pub legend: Vec<Key>,
}

/// One pair of axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    pub title: String,
    pub x: Axis,
    pub y: Axis,
    /// The first one lies lowest.
    pub series: Vec<Series>,
}

/// A curve, its points in the units of the axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    pub points: Vec<[f64; 2]>,
    pub style: Style,
}

/// A line of the legend.
#[derive(Clone, Debug, PartialEq)]
pub struct Key {
    pub label: String,
    pub style: Style,
}

/// How a curve is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    pub ink: Ink,
    pub dash: Dash,
    /// Of the line; pixels at the figure's own size.
    pub width: f64,
    pub marker: Option<Marker>,
}

/// A colour on white paper and its counterpart on black, encoded sRGB.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Ink {
    pub light: [u8; 3],
    pub dark: [u8; 3],
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Dash {
    #[default]
    Solid,
    Dashed,
    Dotted,
    DashDotted,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Marker {
    Disk,
    Square,
    Triangle,
    Diamond,
}

impl Ink {
    /// That of text and axes.
    pub const TEXT: Self = Self::new(0x1a1a1a, 0xe8e8e8);

    /// From 0xRRGGBB.
    pub const fn new(light: u32, dark: u32) -> Self {
        Self { light: channels(light), dark: channels(dark) }
    }
}

const fn channels(hex: u32) -> [u8; 3] {
    let [_, r, g, b] = hex.to_be_bytes();
    [r, g, b]
}

/// Colours that stay apart for colour-blind eyes: after M. Okabe & K. Ito, "Color universal design" (2008), darker on white.
pub const PALETTE: [Ink; 7] = [
    Ink::new(0x0072b2, 0x58a9e0),
    Ink::new(0xd55e00, 0xf2874a),
    Ink::new(0x008f68, 0x35c79c),
    Ink::new(0xb5588f, 0xe39ac6),
    Ink::new(0xc08600, 0xf3bf4a),
    Ink::new(0x3fa0d8, 0x9ad7fa),
    Ink::new(0x6b5b3e, 0xc9b184),
];

impl Style {
    pub fn new(ink: Ink) -> Self {
        Self { ink, dash: Dash::Solid, width: 1.5, marker: None }
    }

    /// The nth of many curves: the palette's colours in turn, then the same ones dashed.
    pub fn nth(n: usize) -> Self {
        const DASHES: [Dash; 4] = [Dash::Solid, Dash::Dashed, Dash::Dotted, Dash::DashDotted];
        let dash = DASHES[(n / PALETTE.len()) % DASHES.len()];
        Self { dash, ..Self::new(PALETTE[n % PALETTE.len()]) }
    }

    pub fn dash(self, dash: Dash) -> Self {
        Self { dash, ..self }
    }

    pub fn width(self, width: f64) -> Self {
        Self { width, ..self }
    }

    pub fn marker(self, marker: Marker) -> Self {
        Self { marker: Some(marker), ..self }
    }
}

impl Figure {
    /// The whole file.
    pub fn svg(&self) -> String {
        svg::draw(self)
    }
}
