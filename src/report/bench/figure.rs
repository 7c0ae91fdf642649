//! Error against processor time, both logarithmic: a row of panels a scene, a curve a variant, the front beneath.

use super::pareto;
use super::{Bench, Run, Scene, Variant};
use crate::report::plot::{Axis, Dash, Figure, Ink, Key, Marker, Panel, Series, Style};

/// What a panel shows of a run.
type Measure = (&'static str, fn(&Run) -> f64);

const MEASURES: [Measure; 2] = [("MSE", |run| run.mse), ("mean ΔE2000", |run| run.delta_e2000)];

/// Of what only the table names.
const FAINT: Ink = Ink::new(0xc4c4c4, 0x565656);

/// Under everything.
const FRONT: Ink = Ink::new(0xd9d2b4, 0x57502f);

/// The whole figure; variants of one name look alike in all scenes.
pub fn figure(bench: &Bench) -> Figure {
    let labels = labels(bench);
    let panels = bench.scenes.iter().flat_map(|scene| MEASURES.map(|measure| panel(scene, measure, &labels)));
    let curves = labels.iter().enumerate().map(|(n, label)| Key { label: (*label).into(), style: style(n) });
    let named = |variant: &Variant| labels.contains(&variant.way.label.as_str());
    let others = !bench.scenes.iter().flat_map(|scene| &scene.variants).all(named);
    let others = others.then(|| Key { label: "other ways that change several things".into(), style: faint_style() });
    let front = Key { label: "front: least error for its time".into(), style: front_style() };
    Figure {
        title: "Speed against error".into(),
        description: "Error of renders against the processor time that they took, for every way to render".into(),
        panels: panels.collect(),
        columns: MEASURES.len(),
        legend: curves.chain(others).chain([front]).collect(),
    }
}

/// The name of every variant that has a curve of its own, once: of those that change several things, what is on a front.
fn labels(bench: &Bench) -> Vec<&str> {
    let mut labels: Vec<&str> = Vec::new();
    let own = |variant: &&Variant| !variant.way.changes_several() || variant.on_front();
    for variant in bench.scenes.iter().flat_map(|scene| &scene.variants).filter(own) {
        if !labels.contains(&variant.way.label.as_str()) {
            labels.push(&variant.way.label);
        }
    }
    labels
}

fn style(n: usize) -> Style {
    const MARKERS: [Marker; 4] = [Marker::Disk, Marker::Square, Marker::Triangle, Marker::Diamond];
    match n {
        // The usual one stands out.
        0 => Style::new(Ink::TEXT).width(2.2).marker(Marker::Disk),
        n => Style::nth(n - 1).marker(MARKERS[n % MARKERS.len()]),
    }
}

fn faint_style() -> Style {
    Style::new(FAINT).width(1.0)
}

fn front_style() -> Style {
    Style::new(FRONT).width(9.0).dash(Dash::Solid)
}

fn panel(scene: &Scene, (name, of): Measure, labels: &[&str]) -> Panel {
    let points = |variant: &Variant| variant.runs.iter().map(|run| [run.cpu_seconds, of(run)]).collect::<Vec<_>>();
    let all: Vec<_> = scene.variants.iter().flat_map(points).collect();
    let axis = |label: &str, i: usize| Axis::logarithmic(label, all.iter().map(|point| point[i]));
    let front = Series { points: front(&all), style: front_style() };
    let curve = |variant: &Variant| {
        let n = labels.iter().position(|label| *label == variant.way.label);
        Series { points: points(variant), style: n.map_or_else(faint_style, style) }
    };
    // The usual one is drawn last, over the others.
    let curves = scene.variants.iter().rev().map(curve);
    Panel {
        title: format!("{}: {name}", scene.name),
        x: axis("processor time of a render (s)", 0),
        y: axis("error", 1),
        series: [front].into_iter().chain(curves).collect(),
    }
}

/// What nothing beats, from the cheapest on.
fn front(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let on = pareto::front(points);
    let mut front: Vec<_> = points.iter().zip(on).filter(|(_, on)| *on).map(|(point, _)| *point).collect();
    front.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]));
    front
}
