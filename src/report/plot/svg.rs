//! Draws a figure: sizes, style sheet, panels, legend.

use super::{Axis, Dash, Figure, Ink, Key, Marker, Panel, Series, Style};
use std::collections::BTreeSet;
use std::fmt::Write;

/// Pixels at the figure's own size; the file scales.
const FONT: f64 = 12.0;
/// From the left edge of a panel to its axis: tick labels, and the axis' name beside them.
const LEFT: f64 = 56.0;
const RIGHT: f64 = 18.0;
const TOP: f64 = 28.0;
const BOTTOM: f64 = 44.0;
const TICK: f64 = 4.0;
/// Space around the plotted area in which the ends of thick lines and markers still show.
const BLEED: f64 = 5.0;
const LEGEND_TOP: f64 = 18.0;
const LEGEND_LINE: f64 = 20.0;
const SAMPLE: f64 = 30.0;
/// Of a character of a sans-serif face, in its size: wider than the mean of any common one.
const CHARACTER: f64 = 0.58;

/// The area between the axes of one panel.
#[derive(Clone, Copy)]
struct Area {
    left: f64,
    top: f64,
    width: f64,
    height: f64,
}

pub(super) fn draw(figure: &Figure) -> String {
    let columns = figure.columns.clamp(1, figure.panels.len().max(1));
    let rows = figure.panels.len().div_ceil(columns);
    let (width, height) = if figure.panels.len() == 1 { (460.0, 300.0) } else { (250.0, 180.0) };
    let (across, down) = (LEFT + width + RIGHT, TOP + height + BOTTOM);
    let legend = legend(&figure.legend, across * columns as f64 - LEFT - RIGHT);
    let size = [across * columns as f64, down * rows as f64 + legend.height];
    let mut out = head(figure, size);
    for (place, panel) in figure.panels.iter().enumerate() {
        let (row, column) = (place / columns, place % columns);
        let area = Area { left: across * column as f64 + LEFT, top: down * row as f64 + TOP, width, height };
        let lowest = place + columns >= figure.panels.len();
        draw_panel(&mut out, panel, area, column == 0, lowest);
    }
    let _ = write!(out, "<g transform=\"translate({LEFT} {:.1})\">{}</g>\n</svg>\n", down * rows as f64, legend.svg);
    out
}

fn head(figure: &Figure, [width, height]: [f64; 2]) -> String {
    let inks: BTreeSet<Ink> = figure
        .panels
        .iter()
        .flat_map(|panel| panel.series.iter().map(|series| series.style.ink))
        .chain(figure.legend.iter().map(|key| key.style.ink))
        .collect();
    let (mut light, mut dark) = (String::new(), String::new());
    for ink in inks {
        let class = class(ink);
        let _ = write!(light, ".plot .{class}{{stroke:{0};color:{0}}}", hex(ink.light));
        let _ = write!(dark, ".plot .{class}{{stroke:{0};color:{0}}}", hex(ink.dark));
    }
    let Ink { light: text, dark: text_on_dark } = Ink::TEXT;
    let (text, text_on_dark) = (hex(text), hex(text_on_dark));
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"plot\" role=\"img\" viewBox=\"0 0 {width:.0} {height:.0}\" \
         width=\"{width:.0}\" height=\"{height:.0}\" font-family=\"sans-serif\" font-size=\"{FONT}\">\n\
         <title>{}</title>\n<desc>{}</desc>\n<style>\
         .plot .paper{{fill:#fff}}.plot text{{fill:{text}}}.plot .axis{{stroke:{text};fill:none}}\
         .plot .grid{{stroke:#e3e3e3;fill:none}}.plot .line{{fill:none;stroke-linejoin:round}}.plot .mark{{fill:currentColor}}{light}\n\
         @media (prefers-color-scheme:dark){{.plot .paper{{fill:#15181c}}.plot text{{fill:{text_on_dark}}}\
         .plot .axis{{stroke:{text_on_dark}}}.plot .grid{{stroke:#343a41}}{dark}}}</style>\n\
         <rect class=\"paper\" width=\"100%\" height=\"100%\"/>\n",
        escaped(&figure.title),
        escaped(&figure.description),
    )
}

fn draw_panel(out: &mut String, panel: &Panel, area: Area, first: bool, lowest: bool) {
    let Area { left, top, width, height } = area;
    let _ = writeln!(
        out,
        "<text x=\"{left:.1}\" y=\"{:.1}\" font-weight=\"bold\">{}</text>",
        top - 10.0,
        escaped(&panel.title)
    );
    across(out, &panel.x, area);
    upward(out, &panel.y, area);
    let _ = writeln!(out, "<path class=\"axis\" d=\"M{left:.1} {top:.1}V{:.1}H{:.1}\"/>", top + height, left + width);
    if lowest {
        let (x, y) = (left + width / 2.0, top + height + 36.0);
        text(out, [x, y], "middle", "", &panel.x.label);
    }
    if first {
        let (x, y) = (left - LEFT + 15.0, top + height / 2.0);
        text(out, [x, y], "middle", &format!(" transform=\"rotate(-90 {x:.1} {y:.1})\""), &panel.y.label);
    }
    // A picture within the picture cuts off what is beyond the axes.
    let (w, h) = (width + 2.0 * BLEED, height + 2.0 * BLEED);
    let (x, y) = (left - BLEED, top - BLEED);
    let _ = writeln!(out, "<svg x=\"{x:.1}\" y=\"{y:.1}\" width=\"{w:.1}\" height=\"{h:.1}\" overflow=\"hidden\">");
    for series in &panel.series {
        draw_series(out, panel, series, [width, height]);
    }
    out.push_str("</svg>\n");
}

fn across(out: &mut String, axis: &Axis, Area { left, top, width, height }: Area) {
    let bottom = top + height;
    for (tick, label) in axis.ticks.iter().zip(axis.labels()) {
        let x = left + width * axis.place(*tick);
        let _ = writeln!(out, "<path class=\"axis\" d=\"M{x:.1} {bottom:.1}v{TICK}\"/>");
        text(out, [x, bottom + TICK + 13.0], "middle", "", &label);
    }
}

fn upward(out: &mut String, axis: &Axis, Area { left, top, width, height }: Area) {
    for (tick, label) in axis.ticks.iter().zip(axis.labels()) {
        let y = top + height * (1.0 - axis.place(*tick));
        let _ = write!(out, "<path class=\"grid\" d=\"M{left:.1} {y:.1}h{width:.1}\"/>");
        let _ = writeln!(out, "<path class=\"axis\" d=\"M{left:.1} {y:.1}h-{TICK}\"/>");
        text(out, [left - TICK - 3.0, y + 4.0], "end", "", &label);
    }
}

fn text(out: &mut String, [x, y]: [f64; 2], anchor: &str, more: &str, content: &str) {
    let content = escaped(content);
    let _ = writeln!(out, "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\"{more}>{content}</text>");
}

fn draw_series(out: &mut String, panel: &Panel, series: &Series, [width, height]: [f64; 2]) {
    let place = |[x, y]: [f64; 2]| [BLEED + width * panel.x.place(x), BLEED + height * (1.0 - panel.y.place(y))];
    let points: Vec<_> = series.points.iter().filter(|p| p.iter().all(|v| v.is_finite())).map(|&p| place(p)).collect();
    line(out, &points, series.style);
    points.iter().for_each(|&point| mark(out, point, series.style));
}

fn line(out: &mut String, points: &[[f64; 2]], style: Style) {
    if style.width == 0.0 {
        return;
    }
    let list: Vec<_> = bends(points).iter().map(|[x, y]| format!("{x:.2},{y:.2}")).collect();
    let _ = writeln!(
        out,
        "<polyline class=\"line {}\" stroke-width=\"{}\"{} points=\"{}\"/>",
        class(style.ink),
        style.width,
        dashes(style.dash),
        list.join(" ")
    );
}

/// Pixels by which a line may miss a point of its curve.
const STRAIGHT: f64 = 0.02;

/// The points that a line needs: those between are so near to it that nobody sees them.
fn bends(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut kept: Vec<[f64; 2]> = points.first().copied().into_iter().collect();
    let mut from = 0;
    for next in 2..points.len() {
        let near = |&point: &[f64; 2]| distance(point, points[from], points[next]) < STRAIGHT;
        if !points[from + 1..next].iter().all(near) {
            from = next - 1;
            kept.push(points[from]);
        }
    }
    kept.extend(points.last().filter(|_| points.len() > 1));
    kept
}

/// Of a point from the line through two others, or from the first where they are one.
fn distance([x, y]: [f64; 2], [x0, y0]: [f64; 2], [x1, y1]: [f64; 2]) -> f64 {
    let length = libm::hypot(x1 - x0, y1 - y0);
    match length > 0.0 {
        true => ((x - x0) * (y1 - y0) - (y - y0) * (x1 - x0)).abs() / length,
        false => libm::hypot(x - x0, y - y0),
    }
}

fn mark(out: &mut String, [x, y]: [f64; 2], style: Style) {
    let Some(marker) = style.marker else { return };
    let path = match marker {
        Marker::Disk => format!("M{:.2} {y:.2}a3 3 0 1 0 6 0a3 3 0 1 0-6 0z", x - 3.0),
        Marker::Square => format!("M{:.2} {:.2}h5.4v5.4h-5.4z", x - 2.7, y - 2.7),
        Marker::Triangle => format!("M{x:.2} {:.2}l3.5 6h-7z", y - 3.8),
        Marker::Diamond => format!("M{x:.2} {:.2}l3.7 3.7l-3.7 3.7l-3.7-3.7z", y - 3.7),
    };
    let _ = writeln!(out, "<path class=\"mark {}\" d=\"{path}\"/>", class(style.ink));
}

struct Legend {
    svg: String,
    height: f64,
}

/// Keys in columns as wide as the widest, as many as fit.
fn legend(keys: &[Key], room: f64) -> Legend {
    let widest = keys.iter().map(|key| key.label.chars().count()).max().unwrap_or(0) as f64;
    let width = SAMPLE + 8.0 + widest * CHARACTER * FONT + 14.0;
    let columns = ((room / width) as usize).clamp(1, keys.len().max(1));
    let rows = keys.len().div_ceil(columns);
    let mut svg = String::new();
    for (place, key) in keys.iter().enumerate() {
        // Down first, so that what belongs together stands together.
        let [x, y] = [(place / rows) as f64 * width, (place % rows) as f64 * LEGEND_LINE + LEGEND_TOP];
        line(&mut svg, &[[x, y], [x + SAMPLE, y]], key.style);
        mark(&mut svg, [x + SAMPLE / 2.0, y], key.style);
        text(&mut svg, [x + SAMPLE + 8.0, y + 4.0], "start", "", &key.label);
    }
    Legend { svg, height: if keys.is_empty() { 0.0 } else { rows as f64 * LEGEND_LINE + LEGEND_TOP } }
}

fn dashes(dash: Dash) -> &'static str {
    match dash {
        Dash::Solid => "",
        Dash::Dashed => " stroke-dasharray=\"6 3.5\"",
        Dash::Dotted => " stroke-dasharray=\"1.5 2.8\"",
        Dash::DashDotted => " stroke-dasharray=\"7 2.5 1.5 2.5\"",
    }
}

fn hex([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// The same wherever the ink is the same, so that two figures in a page agree.
fn class(ink: Ink) -> String {
    format!("ink-{}-{}", &hex(ink.light)[1..], &hex(ink.dark)[1..])
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn figure(title: &str, panels: usize) -> Figure {
        let style = Style::new(Ink::new(0x0072b2, 0x58a9e0)).marker(Marker::Square);
        let panel = Panel {
            title: title.into(),
            x: Axis::linear("θ (°)", [0.0, 90.0]),
            y: Axis::linear("R (%)", [0.0, 100.0]),
            series: vec![Series { points: vec![[0.0, 50.0], [f64::NAN, 1.0], [90.0, 100.0]], style }],
        };
        let keys = vec![Key { label: "s & p".into(), style }; 9];
        Figure {
            title: title.into(),
            description: String::new(),
            panels: vec![panel; panels],
            columns: 3,
            legend: keys,
        }
    }

    #[test]
    fn points_stand_where_the_axes_say() {
        let svg = figure("gold", 1).svg();
        // Half of 300 pixels up at the left edge, and the upper right corner, inside the bleed.
        assert!(svg.contains("points=\"5.00,155.00 465.00,5.00\""), "{svg}");
        assert_eq!(svg.matches("class=\"mark").count(), 2 + 9);
    }

    #[test]
    fn a_line_keeps_its_bends() {
        let arc = |i: i32| [f64::from(i), 100.0 * libm::sin(f64::from(i) / 100.0)];
        let points: Vec<_> = (0..=300).map(arc).collect();
        let kept = bends(&points);
        assert!(kept.len() < 100 && kept.first() == points.first() && kept.last() == points.last());
        for pair in kept.windows(2) {
            let between = points.iter().filter(|point| pair[0][0] < point[0] && point[0] < pair[1][0]);
            assert!(between.into_iter().all(|&point| distance(point, pair[0], pair[1]) < STRAIGHT));
        }
        assert_eq!(bends(&[[0.0, 0.0], [1.0, 1.0], [2.0, 0.0]]).len(), 3);
        assert_eq!((bends(&[]).len(), bends(&[[1.0, 1.0]]).len(), bends(&[[1.0, 1.0]; 3]).len()), (0, 1, 2));
    }

    #[test]
    fn names_cannot_break_the_file() {
        let svg = figure("a<b>&\"c\"", 4).svg();
        assert!(svg.contains("a&lt;b&gt;&amp;&quot;c&quot;") && !svg.contains("<b>"));
        assert!(svg.contains("s &amp; p") && svg.ends_with("</svg>\n"));
        assert_eq!(svg.matches("<svg").count(), svg.matches("</svg>").count());
    }

    #[test]
    fn colours_follow_the_page() {
        let svg = figure("gold", 1).svg();
        let (light, dark) = svg.split_once("@media (prefers-color-scheme:dark)").expect("both");
        assert!(light.contains("stroke:#0072b2") && dark.contains("stroke:#58a9e0"));
    }
}
