//! The f64 reference against 60 digits, and the f32 kernels against the f64 reference, over the cases where Fresnel
//! formulas break: index matching, near the critical angle, vanishing k, immersed and grazing metals.

use spectrel::fresnel::exact::{Reflection, reflect};
use spectrel::fresnel::{conductor, dielectric};
use spectrel::math::Lanes;

const TABLE: &str = include_str!("../../data/fresnel_hard.csv");

struct Case {
    line: usize,
    category: String,
    input: [f64; 4],
    expected: Reflection,
}

impl Case {
    fn is_critical(&self) -> bool {
        self.category == "critical" || self.category == "tiny_k_critical"
    }

    /// The table's flag was set in f64: it is 0 on one row where n2² − n1² sin² θ_i = −2.6e-17, yet 1 − R = 0 there to all 60 digits.
    fn is_total(&self) -> bool {
        let [_, _, k2, cos] = self.input;
        let nothing_transmitted = k2 == 0.0 && cos > 0.0 && self.expected.one_minus_r == 0.0;
        self.expected.tir || nothing_transmitted
    }

    fn is_metal(&self) -> bool {
        self.category.starts_with("metal")
    }

    fn computed(&self) -> Reflection {
        let [n1, n2, k2, cos] = self.input;
        reflect(n1, n2, k2, cos)
    }
}

fn cases() -> Vec<Case> {
    let rows = TABLE.lines().enumerate().filter(|(_, row)| !row.starts_with('#') && !row.starts_with("category"));
    let cases: Vec<_> = rows.map(|(line, row)| case(line + 1, row)).collect();
    assert!(cases.len() > 280);
    cases
}

fn case(line: usize, row: &str) -> Case {
    let mut fields = row.split(',');
    let category = fields.next().unwrap().to_owned();
    let v: Vec<f64> = fields.map(|field| field.parse().unwrap()).collect();
    let expected = Reflection {
        rs: v[4],
        rp: v[5],
        r: v[6],
        one_minus_rs: v[7],
        one_minus_rp: v[8],
        one_minus_r: v[9],
        delta_s: v[10],
        delta_p: v[11],
        tir: v[12] == 1.0,
    };
    Case { line, category, input: [v[0], v[1], v[2], v[3]], expected }
}

/// Collects errors as parts of their tolerance; prints the largest, fails above 1.
#[derive(Default)]
struct Verdict(Vec<(f64, String)>);

impl Verdict {
    fn add(&mut self, error: f64, tolerance: f64, what: impl Fn() -> String) {
        let share = if error.is_nan() { f64::INFINITY } else { error / tolerance };
        self.0.push((share, format!("{} error {error:.2e} of {tolerance:.0e}", what())));
    }

    fn finish(mut self) {
        self.0.sort_by(|a, b| b.0.total_cmp(&a.0));
        for (share, what) in self.0.iter().take(12) {
            println!("{share:9.2e}  {what}");
        }
        assert!(self.0[0].0 <= 1.0, "{} rows exceed their tolerance", self.0.iter().filter(|row| row.0 > 1.0).count());
    }
}

#[test]
fn reference_agrees_with_60_digits() {
    let mut verdict = Verdict::default();
    for case in cases() {
        let computed = case.computed();
        assert_eq!(computed.tir, case.is_total(), "total reflection, line {}", case.line);
        powers(&case, &computed, &mut verdict);
        phases(&case, &computed, &mut verdict);
    }
    verdict.finish();
}

fn powers(case: &Case, computed: &Reflection, verdict: &mut Verdict) {
    let e = &case.expected;
    let reflected = [("Rs", computed.rs, e.rs), ("Rp", computed.rp, e.rp), ("R", computed.r, e.r)];
    let transmitted = [
        ("1-Rs", computed.one_minus_rs, e.one_minus_rs),
        ("1-Rp", computed.one_minus_rp, e.one_minus_rp),
        ("1-R", computed.one_minus_r, e.one_minus_r),
    ];
    let absolute = if case.is_critical() { 5e-6 } else { 1e-12 };
    for (values, floor) in [(reflected, 1e-6), (transmitted, 1e-300)] {
        for (name, value, expected) in values {
            let what = || format!("{name} {} line {}", case.category, case.line);
            verdict.add((value - expected).abs(), absolute, what);
            if !case.is_critical() && expected > floor {
                verdict.add((value / expected - 1.0).abs(), 1e-12, || format!("relative {}", what()));
            }
        }
    }
}

fn phases(case: &Case, computed: &Reflection, verdict: &mut Verdict) {
    let e = &case.expected;
    for (name, value, expected, power) in
        [("delta_s", computed.delta_s, e.delta_s, e.rs), ("delta_p", computed.delta_p, e.delta_p, e.rp)]
    {
        if power == 0.0 {
            assert!(value.is_nan() && expected.is_nan(), "{name} line {}", case.line);
        } else if power > 1e-12 {
            let turns = (value - expected) / std::f64::consts::TAU;
            let error = (turns - turns.round()).abs() * std::f64::consts::TAU;
            verdict.add(error, 1e-10, || format!("{name} {} line {}", case.category, case.line));
        }
    }
}

/// The kernels at the inputs rounded to f32, against the reference at the same rounded inputs.
#[test]
fn conductor_kernel_agrees_with_the_reference() {
    let mut verdict = Verdict::default();
    for case in cases() {
        let (input, expected) = rounded(&case);
        let [n1, n2, k2, cos] = input.map(|value| Lanes([value]));
        let (r, one_minus_r) = conductor::reflectance_and_loss(&n1, &n2, &k2, &cos);
        assert!((0.0..=1.0).contains(&r[0]));
        kernel_reflects(&case, r[0], expected.r, &mut verdict);
        if case.is_metal() && expected.one_minus_r > 0.0 {
            let error = (one_minus_r[0] as f64 / expected.one_minus_r - 1.0).abs();
            verdict.add(error, 1e-5, || format!("relative 1-R {} line {}", case.category, case.line));
        }
    }
    verdict.finish();
}

#[test]
fn dielectric_kernel_agrees_with_the_reference() {
    let mut verdict = Verdict::default();
    for case in cases().into_iter().filter(|case| case.input[2] == 0.0) {
        let (input, expected) = rounded(&case);
        let [n1, n2, _, cos] = input.map(|value| Lanes([value]));
        let interface = dielectric::fresnel(&n1, &n2, &cos);
        assert!((0.0..=1.0).contains(&interface.r[0]));
        kernel_reflects(&case, interface.r[0], expected.r, &mut verdict);
        if expected.tir && !case.is_critical() {
            assert_eq!((interface.r[0], interface.cos_theta_t[0]), (1.0, 0.0), "line {}", case.line);
        }
    }
    verdict.finish();
}

fn rounded(case: &Case) -> ([f32; 4], Reflection) {
    let input = case.input.map(|value| value as f32);
    let [n1, n2, k2, cos] = input.map(f64::from);
    (input, reflect(n1, n2, k2, cos))
}

fn kernel_reflects(case: &Case, r: f32, expected: f64, verdict: &mut Verdict) {
    let tolerance = if case.is_critical() { 2e-3 } else { 2e-6 };
    verdict.add((r as f64 - expected).abs(), tolerance, || format!("R {} line {}", case.category, case.line));
}
