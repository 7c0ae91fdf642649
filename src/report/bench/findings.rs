//! What the numbers of a scene say, in sentences.

use super::{Bias, Change, Run, Scene, Variant, Way};
use crate::report::Verdict;
use crate::report::comparison::short;

/// The usual variant first, then each of the others that has a sentence of its own, then the best and what limits them.
pub fn findings(scene: &Scene) -> Vec<String> {
    let Some((usual, others)) = scene.usual() else { return Vec::new() };
    let told = others.iter().filter(|variant| !variant.way.changes_several() || variant.on_front());
    let told = told.map(|variant| other(usual, variant));
    start(usual).into_iter().chain(told).chain(several(usual, others)).chain(near(scene)).collect()
}

/// Of combinations only those on the front have sentences: what comes of all of them together.
fn several(usual: &Variant, others: &[Variant]) -> Option<String> {
    let all: Vec<_> = others.iter().filter(|variant| variant.way.changes_several()).collect();
    let best = others.iter().filter_map(|variant| Some((variant, last_runs(usual, variant)?)));
    let best = best.max_by(|(_, (_, a)), (_, (_, b))| a.efficiency.total_cmp(&b.efficiency));
    let (variant, (old, new)) = best.filter(|_| !all.is_empty())?;
    let front = all.iter().filter(|variant| variant.on_front()).count();
    Some(format!(
        "Of {} ways that change several things at once {front} {} on the front. Of all others than the usual way, `{}` is the most efficient with {} \
         samples a pixel: {} × as efficient as the usual way.",
        all.len(),
        if front == 1 { "is" } else { "are" },
        variant.way.label,
        new.samples,
        times(new.efficiency / old.efficiency)
    ))
}

fn start(usual: &Variant) -> Option<String> {
    let run = usual.runs.last()?;
    let way = &usual.way;
    Some(format!(
        "The usual way ({}, {}) is ΔE {} from the reference with {} samples a pixel, in {} s of processor time.",
        way.label,
        if way.dispersion { "dispersion as the scene has it" } else { "no dispersion" },
        short(run.delta_e2000),
        run.samples,
        short(run.cpu_seconds)
    ))
}

fn other(usual: &Variant, variant: &Variant) -> String {
    let plural = is_plural(&variant.way);
    let mut parts = vec![time(variant, plural)];
    parts.extend(variant.bias.as_ref().and_then(|bias| bias_of(variant, bias, plural)));
    if variant.way.changes_any(&[Change::Lanes, Change::Sampler, Change::Adaptive]) {
        parts.extend(noise(usual, variant, plural));
    }
    let last = parts.pop().unwrap_or_default();
    let before = if parts.is_empty() { String::new() } else { format!("{} and ", parts.join(", ")) };
    format!("{} {before}{last}.", subject(usual, variant))
}

/// Whether what is changed is more than one thing, in grammar.
fn is_plural(way: &Way) -> bool {
    match way.changes.as_slice() {
        [Change::Lanes] => way.lanes > 1,
        [one] => *one == Change::Sampler,
        _ => true,
    }
}

fn subject(usual: &Variant, variant: &Variant) -> String {
    let all: Vec<_> = variant.way.changes.iter().map(|change| changed(*change, &usual.way, &variant.way)).collect();
    match all.split_last() {
        Some((last, before)) if !before.is_empty() => format!("{} and {last}", before.join(", ")),
        _ => all.concat(),
    }
}

fn changed(change: Change, old: &Way, new: &Way) -> String {
    match change {
        Change::Model => format!("{} instead of {}", new.model, old.model),
        Change::Lanes if new.lanes == 1 => format!("1 lane instead of {}", old.lanes),
        Change::Lanes => format!("{} lanes instead of {}", new.lanes, old.lanes),
        Change::Sampler => format!("{} samples instead of {}", new.sampler, old.sampler),
        Change::Adaptive => {
            format!("sharing samples out for {} instead of evenly", new.adaptive.as_deref().unwrap_or_default())
        }
        Change::Dispersion => "leaving dispersion out".into(),
    }
}

fn verb(plural: bool, stem: &str, singular: &str) -> String {
    if plural { stem.into() } else { singular.into() }
}

fn time(variant: &Variant, plural: bool) -> String {
    let Some(ratio) = variant.time else { return format!("{} no known time", verb(plural, "take", "takes")) };
    let percent = |ratio: f64| 100.0 * (ratio - 1.0);
    let [low, high] = ratio.interval_95.map(percent);
    let size = shown(percent(ratio.value).abs());
    match (ratio.is_even(), ratio.value < 1.0) {
        (true, _) => format!(
            "{} as long, to what timing can tell (95 %: {} … {} %)",
            verb(plural, "take", "takes"),
            signed(low),
            signed(high)
        ),
        (false, true) => format!(
            "{} {size} % of the time (95 %: {} … {} %)",
            verb(plural, "save", "saves"),
            shown(-high),
            shown(-low)
        ),
        (false, false) => {
            format!("{} {size} % more time (95 %: {} … {} %)", verb(plural, "take", "takes"), shown(low), shown(high))
        }
    }
}

/// Percents, to a tenth below ten.
fn shown(percent: f64) -> String {
    if percent < 9.95 { format!("{percent:.1}") } else { format!("{percent:.0}") }
}

fn signed(percent: f64) -> String {
    format!("{}{}", if percent < 0.0 { "−" } else { "+" }, shown(percent.abs()))
}

/// Lanes and samplers are expected to have none: said only if they do.
fn bias_of(variant: &Variant, bias: &Bias, plural: bool) -> Option<String> {
    let expected = variant.may_be_biased();
    let [low, high] = bias.interval_95.map(short);
    match bias.verdict {
        Verdict::Different => {
            let cost = verb(plural, "cost", "costs");
            Some(format!("{cost} ΔE {} (95 %: {low} … {high})", short(bias.delta_e2000)))
        }
        Verdict::Indistinguishable if expected => {
            Some(format!("{} nothing beyond noise (ΔE at most {high})", verb(plural, "change", "changes")))
        }
        Verdict::Identical if expected => Some(format!("{} not one sample", verb(plural, "change", "changes"))),
        _ => None,
    }
}

fn noise(usual: &Variant, variant: &Variant, plural: bool) -> Option<String> {
    let ((old, new), have) = (last_runs(usual, variant)?, verb(plural, "have", "has"));
    let noise = new.noise_delta_e2000 / old.noise_delta_e2000;
    let efficiency = new.efficiency / old.efficiency;
    if !noise.is_finite() || !efficiency.is_finite() {
        return None;
    }
    Some(format!(
        "{have} {} × the colour noise at {} samples a pixel, so that {} {} × the efficiency",
        times(noise),
        new.samples,
        if plural { "they have" } else { "it has" },
        times(efficiency)
    ))
}

/// A factor, to two digits behind the point where that is enough of it.
fn times(factor: f64) -> String {
    if (0.1..100.0).contains(&factor) { format!("{factor:.2}") } else { short(factor) }
}

/// Of both, the runs with the most samples.
fn last_runs<'a>(usual: &'a Variant, variant: &'a Variant) -> Option<(&'a Run, &'a Run)> {
    usual.runs.last().zip(variant.runs.last()).filter(|(old, new)| old.samples == new.samples)
}

fn near(scene: &Scene) -> Option<String> {
    let count = scene.runs().filter(|(_, run)| run.near_reference).count();
    let runs = if count == 1 { "1 run is".into() } else { format!("{count} runs are") };
    (count > 0).then(|| {
        format!(
            "{runs} nearer to the reference than {} × its own error: their MSE, and what follows from it, is not known better.",
            super::CLEAR
        )
    })
}

#[cfg(test)]
mod tests {
    use super::super::Ratio;
    use super::*;

    fn variant(changes: &[Change], time: [f64; 3], verdict: Verdict) -> Variant {
        let way = Way {
            label: "f82".into(),
            changes: changes.to_vec(),
            model: "f82".into(),
            lanes: 4,
            sampler: "sobol".into(),
            adaptive: Some("rmse".into()),
            dispersion: true,
        };
        let [value, low, high] = time;
        let bias = Some(Bias { verdict, delta_e2000: 2.1, interval_95: [2.0, 2.25] });
        Variant { way, time: Some(Ratio { value, interval_95: [low, high] }), bias, runs: Vec::new() }
    }

    #[test]
    fn sentences_say_what_the_numbers_do() {
        let mut usual = variant(&[], [1.0; 3], Verdict::Indistinguishable);
        usual.way = Way { model: "exact".into(), lanes: 8, ..usual.way };
        let said = |changes: &[Change], time, verdict| other(&usual, &variant(changes, time, verdict));
        assert_eq!(
            said(&[Change::Model], [0.99, 0.985, 0.996], Verdict::Different),
            "f82 instead of exact saves 1.0 % of the time (95 %: 0.4 … 1.5 %) and costs ΔE 2.10 (95 %: 2.00 … 2.25)."
        );
        assert_eq!(
            said(&[Change::Model], [1.01, 0.99, 1.02], Verdict::Indistinguishable),
            "f82 instead of exact takes as long, to what timing can tell (95 %: −1.0 … +2.0 %) and changes nothing beyond noise (ΔE at most 2.25)."
        );
        assert_eq!(
            said(&[Change::Lanes], [1.5, 1.4, 1.6], Verdict::Indistinguishable),
            "4 lanes instead of 8 take 50 % more time (95 %: 40 … 60 %)."
        );
        let shared = said(&[Change::Adaptive], [1.3; 3], Verdict::Indistinguishable);
        assert!(shared.starts_with("sharing samples out for rmse instead of evenly takes 30 % more time"), "{shared}");
        assert!(said(&[Change::Dispersion], [1.5; 3], Verdict::Identical).ends_with("changes not one sample."));
        assert_eq!(
            said(&[Change::Model, Change::Lanes, Change::Dispersion], [1.5, 1.4, 1.6], Verdict::Different),
            "f82 instead of exact, 4 lanes instead of 8 and leaving dispersion out take 50 % more time (95 %: 40 … 60 %) and cost ΔE 2.10 (95 %: 2.00 … 2.25)."
        );
    }
}
