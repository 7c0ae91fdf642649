//! Lines in a small SVG: reflectance against the angle of incidence, one line a variant.
//!
//! Colours are left to the page: line i is stroked with its variable `--line-i` (0…7, from there again with dashes).

use std::fmt::Write;

/// Colours that a page must define.
pub const COLOURS: usize = 8;

const WIDTH: f64 = 360.0;
const HEIGHT: f64 = 230.0;
/// Of the lines' field: left, top, right, bottom.
const FIELD: [f64; 4] = [38.0, 10.0, 350.0, 196.0];
const DEGREES: [f64; 7] = [0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0];

/// A line: the colour's number, a label, and points (degrees, reflectance).
pub type Line<'a> = (usize, &'a str, &'a [[f64; 2]]);

/// The SVG of these lines, the first one on top.
pub fn curves(lines: &[Line]) -> String {
    let axis = Axis::of(lines);
    let mut svg = format!("<svg viewBox=\"0 0 {WIDTH} {HEIGHT}\" role=\"img\">");
    svg += &axis.grid();
    for (colour, label, points) in lines.iter().rev() {
        let places = points.iter().map(|&[degrees, value]| format!("{:.1},{:.1}", x(degrees), axis.y(value)));
        let places = places.collect::<Vec<_>>().join(" ");
        let _ = write!(
            svg,
            "<polyline points=\"{places}\" style=\"{}\"><title>{}</title></polyline>",
            stroke(*colour),
            super::comparison::escaped(label)
        );
    }
    svg + "</svg>"
}

/// The style of a line, for legends too.
pub fn stroke(colour: usize) -> String {
    let dashes = if colour < COLOURS { "" } else { ";stroke-dasharray:5 3" };
    format!("stroke:var(--line-{}){dashes}", colour % COLOURS)
}

fn x(degrees: f64) -> f64 {
    FIELD[0] + (FIELD[2] - FIELD[0]) * degrees / 90.0
}

/// Reflectances from the bottom to the top, in tenths.
struct Axis {
    low: i32,
    high: i32,
}

impl Axis {
    fn of(lines: &[Line]) -> Self {
        let values = || lines.iter().flat_map(|(_, _, points)| points.iter().map(|point| point[1]));
        let low = (values().fold(1.0, f64::min) * 10.0 + 1e-6).floor() as i32;
        let high = (values().fold(1.0, f64::max) * 10.0 - 1e-6).ceil() as i32;
        Self { low: low.min(high - 1), high }
    }

    fn y(&self, value: f64) -> f64 {
        let part = (value * 10.0 - f64::from(self.low)) / f64::from(self.high - self.low);
        FIELD[3] - (FIELD[3] - FIELD[1]) * part
    }

    fn grid(&self) -> String {
        let mut grid = String::from("<g class=\"grid\">");
        for degrees in DEGREES {
            let (x, [_, top, _, bottom]) = (x(degrees), FIELD);
            let _ = write!(grid, "<path d=\"M{x:.1} {top}V{bottom}\"/>");
            let _ = write!(grid, "<text x=\"{x:.1}\" y=\"{}\" text-anchor=\"middle\">{degrees}°</text>", bottom + 14.0);
        }
        let step = if self.high - self.low > 5 { 2 } else { 1 };
        for tenths in (self.low..=self.high).filter(|tenths| (self.high - tenths) % step == 0) {
            let (value, [left, _, right, _]) = (f64::from(tenths) / 10.0, FIELD);
            let y = self.y(value);
            let _ = write!(grid, "<path d=\"M{left} {y:.1}H{right}\"/>");
            let _ =
                write!(grid, "<text x=\"{}\" y=\"{:.1}\" text-anchor=\"end\">{value:.1}</text>", left - 6.0, y + 4.0);
        }
        let middle = 0.5 * (FIELD[0] + FIELD[2]);
        let _ = write!(
            grid,
            "<text x=\"{middle}\" y=\"{}\" text-anchor=\"middle\">angle of incidence</text>",
            HEIGHT - 4.0
        );
        grid + "</g>"
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_field_holds_all_lines() {
        let (low, high) = ([[0.0, 0.42], [90.0, 1.0]], [[0.0, 0.5], [90.0, 1.04]]);
        let lines: [Line; 2] = [(0, "a", &low), (9, "<b>", &high)];
        let axis = Axis::of(&lines);
        assert_eq!((axis.low, axis.high), (4, 11));
        assert_eq!((axis.y(0.4), axis.y(1.1)), (FIELD[3], FIELD[1]));
        let svg = curves(&lines);
        assert!(svg.contains("&lt;b&gt;"));
        assert!(svg.contains("var(--line-1);stroke-dasharray"));
        // Of nothing but ones there is an axis, too.
        let ones = [[0.0, 1.0], [90.0, 1.0]];
        assert_eq!(Axis::of(&[(0, "one", &ones)]).low, 9);
    }
}
