//! The columns of verdicts on another table, and of metals that look like a colour.

use super::{Page, Report};
use crate::report::Grid;
use crate::report::f0::check::{Checked, MATCH, NEAR, Nearest, Outcome, Verdict};
use crate::report::f0::{Likeness, Likenesses};

impl Outcome {
    fn name(self) -> &'static str {
        match self {
            Self::Match => "match",
            Self::Near => "near",
            Self::MisEncoded => "mis-encoded",
            Self::Nothing => "nothing",
            Self::Unknown => "unknown",
        }
    }
}

fn distance(nearest: &Option<Nearest>) -> String {
    nearest.as_ref().map_or("–".into(), |nearest| format!("{:.2}", nearest.delta_e))
}

fn set(nearest: &Option<Nearest>) -> String {
    nearest.as_ref().map_or("–".into(), |nearest| nearest.ior.clone())
}

impl Report for Checked {
    fn brief(&self) -> Grid {
        let heading = ["Table", "Material", "Outcome", "Nearest data set", "ΔE", "Other encoding", "ΔE", "Ours", "ΔE"];
        let row = |verdict: &Verdict| {
            let Verdict { claim, outcome, as_stated, other_encoding, primary, .. } = verdict;
            let table = claim.table.clone().unwrap_or_default();
            let mut cells = vec![table, claim.material.clone(), outcome.name().to_owned()];
            cells.extend([as_stated, other_encoding, primary].into_iter().flat_map(|near| [set(near), distance(near)]));
            cells
        };
        Grid::new(&heading, self.rows.iter().map(row))
    }

    fn full(&self) -> Grid {
        let heading = [
            "line",
            "table",
            "material",
            "r",
            "g",
            "b",
            "encoding",
            "outcome",
            "name",
            "ior",
            "delta_e",
            "fit",
            "other_ior",
            "other_delta_e",
            "other_fit",
            "primary_ior",
            "primary_delta_e",
            "primary_fit",
            "says",
        ];
        Grid::new(&heading, self.rows.iter().map(full))
    }

    fn notes(&self) -> Vec<String> {
        [vec![self.conditions.sentence(), limits()], self.assumption(), self.findings()].concat()
    }

    fn page(&self) -> Page {
        let mut paragraphs = vec![self.conditions.sentence() + ".", limits() + "."];
        paragraphs.extend(self.assumption());
        Page::of_grid("A table of colours against measured data", paragraphs, &self.brief())
            .with_list("What does not match as stated", &self.findings())
    }
}

impl Checked {
    /// What was taken for granted.
    fn assumption(&self) -> Vec<String> {
        let assumed = self.rows.iter().any(|row| row.claim.assumed);
        let says = "No encoding is stated: the numbers are taken for linear, and what matches as sRGB only is called mis-encoded";
        assumed.then(|| says.to_owned()).into_iter().collect()
    }

    fn findings(&self) -> Vec<String> {
        self.rows.iter().filter(|row| row.outcome != Outcome::Match).map(Verdict::sentence).collect()
    }
}

fn full(verdict: &Verdict) -> Vec<String> {
    let Verdict { claim, outcome, name, as_stated, other_encoding, primary, says } = verdict;
    let mut cells = vec![claim.line.to_string(), claim.table.clone().unwrap_or_default(), claim.material.clone()];
    cells.extend(claim.rgb.map(|value| value.to_string()));
    cells.extend([claim.encoding.word().to_owned(), outcome.name().to_owned(), name.clone().unwrap_or_default()]);
    for nearest in [as_stated, other_encoding, primary] {
        let cell = |text: fn(&Nearest) -> String| nearest.as_ref().map(text).unwrap_or_default();
        cells.extend([cell(|near| near.ior.clone()), cell(|near| format!("{:.4}", near.delta_e))]);
        cells.push(cell(|near| near.fit.word().to_owned()));
    }
    cells.push(says.clone());
    cells
}

fn limits() -> String {
    format!(
        "ΔE is CIEDE2000 of F0. match: at most {MATCH}, what an eye can just tell; near: at most {NEAR}; mis-encoded: not near as stated, \
         a match under the other encoding; nothing: neither. Colours within 0…1 are compared with F0 clipped to 1, or, if they reach 1, \
         divided by its largest channel"
    )
}

impl Report for Likenesses {
    fn brief(&self) -> Grid {
        let heading = ["Metal", "F0", "ΔE", "Data set", "Nearer set", "F0", "ΔE"];
        let hex = |color: &crate::report::f0::Color| match &color.hex {
            Some(hex) => hex.clone(),
            None => color.linear.map(|value| format!("{value:.3}")).join(" "),
        };
        let row = |metal: &Likeness| {
            let mut cells =
                vec![metal.name.clone(), hex(&metal.f0), format!("{:.2}", metal.delta_e), metal.ior.clone()];
            cells.extend(match &metal.nearer {
                Some(nearer) => [nearer.ior.clone(), hex(&nearer.f0), format!("{:.2}", nearer.delta_e)],
                None => ["–"; 3].map(str::to_owned),
            });
            cells
        };
        Grid::new(&heading, self.metals.iter().map(row))
    }

    fn full(&self) -> Grid {
        let heading = [
            "name",
            "ior",
            "r",
            "g",
            "b",
            "delta_e",
            "nearer_ior",
            "nearer_r",
            "nearer_g",
            "nearer_b",
            "nearer_delta_e",
        ];
        let number = |value: f64| format!("{value:.8}");
        let row = |metal: &Likeness| {
            let mut cells = vec![metal.name.clone(), metal.ior.clone()];
            cells.extend(metal.f0.linear.map(number));
            cells.push(format!("{:.4}", metal.delta_e));
            let nearer = metal.nearer.as_ref();
            cells.push(nearer.map(|nearer| nearer.ior.clone()).unwrap_or_default());
            let channel = |i: usize| nearer.map(|nearer| number(nearer.f0.linear[i])).unwrap_or_default();
            cells.extend([0, 1, 2].map(channel));
            cells.push(nearer.map(|nearer| format!("{:.4}", nearer.delta_e)).unwrap_or_default());
            cells
        };
        Grid::new(&heading, self.metals.iter().map(row))
    }

    fn notes(&self) -> Vec<String> {
        let [r, g, b] = self.color.linear.map(|value| format!("{value:.4}"));
        let hex = self.color.hex.as_deref().map(|hex| format!("{hex}, ")).unwrap_or_default();
        vec![
            format!("Nearest to {hex}linear {r}, {g}, {b}. {}", self.conditions.sentence()),
            "ΔE is CIEDE2000 of F0, clipped to 1 where the colour asked for is within 0…1; 1 is about what an eye can just tell".into(),
        ]
    }

    fn page(&self) -> Page {
        Page::of_grid("Metals that look like a colour", self.notes(), &self.brief())
    }
}
