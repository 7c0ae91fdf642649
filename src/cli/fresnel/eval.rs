//! `spectrel fresnel eval`: the interface by itself, for every row of a table.

use crate::fresnel::{conductor, dielectric, exact};
use crate::scene::SceneError;
use crate::spectrum::{Lanes, nearest};
use clap::{Args, ValueEnum};
use csv::{ReaderBuilder, StringRecord, Trim, WriterBuilder};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

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
    let text = contents(&args.input)?;
    let table = table(&text, args)?;
    let mut out = io::stdout().lock();
    match out.write_all(&table).and_then(|()| out.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(SceneError::new(error)),
        _ => Ok(()),
    }
}

fn contents(path: &Path) -> Result<Vec<u8>, SceneError> {
    let mut bytes = Vec::new();
    if path == Path::new("-") {
        io::stdin().read_to_end(&mut bytes).map_err(SceneError::new)?;
        return Ok(bytes);
    }
    std::fs::read(path).map_err(|error| SceneError::new(format!("cannot read {}: {error}", path.display())))
}

fn table(text: &[u8], args: &EvalArgs) -> Result<Vec<u8>, SceneError> {
    let shown = args.input.display();
    let mut reader = ReaderBuilder::new().comment(Some(b'#')).trim(Trim::All).from_reader(text);
    let headers = reader.headers().map_err(|error| SceneError::new(format!("{shown}: {error}")))?.clone();
    let inputs = columns(&headers).map_err(|error| SceneError::new(format!("{shown}: {error}")).help(HEADER))?;
    let kept: Vec<usize> = (0..headers.len()).filter(|&column| !RESULTS.contains(&&headers[column])).collect();
    let mut writer = WriterBuilder::new().from_writer(Vec::new());
    let names = kept.iter().map(|&column| &headers[column]).chain(RESULTS);
    writer.write_record(names).map_err(SceneError::new)?;
    for record in reader.records() {
        let record = record.map_err(|error| SceneError::new(format!("{shown}: {error}")))?;
        let line = record.position().map_or(0, csv::Position::line);
        let point = point(&record, inputs).map_err(|error| SceneError::new(format!("{shown}:{line}: {error}")))?;
        let results = match args.precision {
            Precision::F64 => double(point),
            Precision::F32 => single(point.map(|value| value as f32)),
        };
        let field = |&column: &usize| match (args.precision, inputs.iter().position(|&input| input == column)) {
            // All digits of the rounded number, so that whoever reads it in double precision reads that very number.
            (Precision::F32, Some(input)) => format!("{:?}", f64::from(point[input] as f32)),
            _ => record[column].to_owned(),
        };
        writer.write_record(kept.iter().map(field).chain(results)).map_err(SceneError::new)?;
    }
    writer.into_inner().map_err(|error| SceneError::new(error.to_string()))
}

const HEADER: &str = "the first line that is no comment names the columns, such as `n1,n2,k2,cos_i`";

/// Where the four numbers stand.
fn columns(headers: &StringRecord) -> Result<[usize; 4], String> {
    let found = INPUTS.map(|name| headers.iter().position(|header| header == name));
    let missing: Vec<String> = INPUTS
        .iter()
        .zip(found)
        .filter(|(_, place)| place.is_none())
        .map(|(name, _)| match nearest(name, headers.iter().filter(|header| !INPUTS.contains(header))) {
            Some(header) => format!("`{name}` (is it `{header}`?)"),
            None => format!("`{name}`"),
        })
        .collect();
    match found {
        [Some(n1), Some(n2), Some(k2), Some(cos)] => Ok([n1, n2, k2, cos]),
        _ => Err(format!("the table has no column {}", missing.join(", "))),
    }
}

/// The four numbers of a row, within what they can be.
fn point(record: &StringRecord, inputs: [usize; 4]) -> Result<[f64; 4], String> {
    let mut point = [0.0; 4];
    for (slot, (column, name)) in inputs.into_iter().zip(INPUTS).enumerate() {
        let text = &record[column];
        let value: f64 = text.parse().map_err(|_| format!("`{name}` is \"{text}\", expected a number"))?;
        let (holds, wants) = match name {
            "k2" => (value >= 0.0, "not negative"),
            "cos_i" => ((0.0..=1.0).contains(&value), "within 0 … 1"),
            _ => (value > 0.0, "above 0"),
        };
        if !(holds && value.is_finite()) {
            return Err(format!("`{name}` is {text}: it must be finite and {wants}"));
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
