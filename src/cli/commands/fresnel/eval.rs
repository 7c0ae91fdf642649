//! `spectrel fresnel eval`: the interface by itself, for every row of a table.

use crate::cli::{show, tables};
use crate::fresnel::{conductor, dielectric, exact};
use crate::math::Lanes;
use crate::report::Grid;
use crate::report::table::{Table, TableError, number};
use crate::scene::SceneError;
use clap::{Args, ValueEnum};
use csv::StringRecord;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct EvalArgs {
    /// CSV with a header that names n1, n2, k2 and cos_i; `#` begins a comment; `-` is standard input
    #[arg(long, value_name = "FILE")]
    input: PathBuf,
    /// f64 is the reference; f32 are the kernels that render
    #[arg(long, value_enum, default_value = "f64")]
    precision: Precision,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Precision {
    F64,
    F32,
}

const INPUTS: [&str; 4] = ["n1", "n2", "k2", "cos_i"];
const RESULTS: [&str; 9] =
    ["Rs", "Rp", "R", "one_minus_Rs", "one_minus_Rp", "one_minus_R", "delta_s", "delta_p", "tir"];

/// Answers only once all rows are read: half a table looks like a whole one.
pub fn run(args: &EvalArgs) -> Result<(), SceneError> {
    let text = tables::contents(&args.input)?;
    let answer = evaluated(&text, args.precision);
    let answer = answer.map_err(|error| tables::wrong(&args.input, error, "n1,n2,k2,cos_i"))?;
    show::answer(answer.csv().map_err(SceneError::new)?)
}

/// The columns that are not named like a result, and the results.
fn evaluated(text: &[u8], precision: Precision) -> Result<Grid, TableError> {
    let mut table = Table::new(text)?;
    let inputs = table.columns(INPUTS.each_ref().map(std::slice::from_ref))?;
    let kept: Vec<usize> =
        (0..table.header.len()).filter(|&column| !RESULTS.contains(&&table.header[column])).collect();
    let heading: Vec<&str> = kept.iter().map(|&column| &table.header[column]).chain(RESULTS).collect();
    let mut answer = Grid::new(&heading, []);
    for row in table.rows() {
        let (line, record) = row?;
        let point = point(&record, inputs, precision).map_err(|message| TableError { line: Some(line), message })?;
        let results = match precision {
            Precision::F64 => double(point),
            Precision::F32 => single(point.map(|value| value as f32)),
        };
        let field = |&column: &usize| match (precision, inputs.iter().position(|&input| input == column)) {
            // All digits of the rounded number, so that whoever reads it in double precision reads that very number.
            (Precision::F32, Some(input)) => format!("{:?}", f64::from(point[input] as f32)),
            _ => record[column].to_owned(),
        };
        answer.rows.push(kept.iter().map(field).chain(results).collect());
    }
    Ok(answer)
}

impl Precision {
    /// Beyond these a square of an index, or of its square, has no place in the format.
    fn largest(self) -> f64 {
        match self {
            Self::F64 => 1e70,
            Self::F32 => 1e6,
        }
    }
}

/// The four numbers of a row, within what they can be.
fn point(record: &StringRecord, inputs: [usize; 4], precision: Precision) -> Result<[f64; 4], String> {
    let mut point = [0.0; 4];
    for (slot, (column, name)) in inputs.into_iter().zip(INPUTS).enumerate() {
        let text = &record[column];
        let value = number(name, text)?;
        let (holds, wants) = match name {
            "k2" => (value >= 0.0, "not negative"),
            "cos_i" => ((0.0..=1.0).contains(&value), "within 0 … 1"),
            _ => (value > 0.0, "above 0"),
        };
        if !(holds && value.is_finite()) {
            return Err(format!("`{name}` is {text}: it must be finite and {wants}"));
        }
        let largest = precision.largest();
        let vanishes = precision == Precision::F32 && name.starts_with('n') && value < 1.0 / largest;
        if value > largest || vanishes {
            let format = if precision == Precision::F32 { "f32" } else { "f64" };
            return Err(format!(
                "`{name}` is {text}: beyond the range of {format} here, {:e} to {largest:e}",
                1.0 / largest
            ));
        }
        point[slot] = value;
    }
    Ok(point)
}

/// The reference.
fn double([n1, n2, k2, cos]: [f64; 4]) -> [String; 9] {
    let r = exact::reflect(n1, n2, k2, cos);
    let numbers = [r.rs, r.rp, r.r, r.one_minus_rs, r.one_minus_rp, r.one_minus_r, r.delta_s, r.delta_p];
    let [a, b, c, d, e, f, g, h] =
        numbers.map(|value| if value.is_nan() { "nan".into() } else { format!("{value:?}") });
    [a, b, c, d, e, f, g, h, u8::from(r.tir).to_string()]
}

/// The kernels that render, which know no phases; a dielectric's mean is that of its own kernel.
fn single([n1, n2, k2, cos]: [f32; 4]) -> [String; 9] {
    let polarised = conductor::polarised(n1, n2, k2, cos);
    let lane = |value: f32| Lanes([value]);
    let (mut r, lost) = conductor::reflectance_and_loss(&lane(n1), &lane(n2), &lane(k2), &lane(cos));
    let mut tir = false;
    if k2 == 0.0 {
        let interface = dielectric::fresnel(&lane(n1), &lane(n2), &lane(cos));
        r = interface.r;
        tir = n1 > n2 && interface.cos_theta_t[0] == 0.0;
    }
    let conductor::Polarised { rs, rp, one_minus_rs, one_minus_rp } = polarised;
    let [a, b, c, d, e, f] = [rs, rp, r[0], one_minus_rs, one_minus_rp, lost[0]].map(|value| format!("{value:?}"));
    [a, b, c, d, e, f, "nan".into(), "nan".into(), u8::from(tir).to_string()]
}
