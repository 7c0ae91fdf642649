//! `spectrel fresnel eval`: the reference and the kernels by the command line, over the table of hard cases.

use crate::common::command::{folder, refused, run};
use spectrel::fresnel::exact::reflect;

const TABLE: &str = include_str!("../../data/fresnel_hard.csv");
const HEADER: &str = "category,n1,n2,k2,cos_i,Rs,Rp,R,one_minus_Rs,one_minus_Rp,one_minus_R,delta_s,delta_p,tir";

/// The rows of what the command says: the category and the numbers.
fn evaluated(args: &[&str]) -> Vec<(String, Vec<f64>)> {
    let folder = folder(&[("points.csv", TABLE)]);
    let output = run(folder.path(), &[&["fresnel", "eval", "--input", "points.csv"], args].concat());
    let text = String::from_utf8(output.stdout).expect("text");
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some(HEADER));
    let rows: Vec<_> = lines
        .map(|line| {
            let (category, rest) = line.split_once(',').expect("a row");
            (category.to_owned(), rest.split(',').map(|field| field.parse().expect("a number")).collect())
        })
        .collect();
    assert!(rows.len() > 280, "every row is answered");
    rows
}

fn results(r: &spectrel::fresnel::exact::Reflection) -> [f64; 8] {
    [r.rs, r.rp, r.r, r.one_minus_rs, r.one_minus_rp, r.one_minus_r, r.delta_s, r.delta_p]
}

#[test]
fn double_precision_is_the_reference_to_the_last_digit() {
    for (category, row) in evaluated(&[]) {
        let [n1, n2, k2, cos] = [row[0], row[1], row[2], row[3]];
        let expected = reflect(n1, n2, k2, cos);
        for (value, expected) in row[4..].iter().zip(results(&expected)) {
            assert!(
                value.to_bits() == expected.to_bits() || (value.is_nan() && expected.is_nan()),
                "{category} {row:?}"
            );
        }
        assert_eq!(row[12], f64::from(u8::from(expected.tir)));
    }
}

#[test]
fn single_precision_is_near_it_at_the_rounded_inputs() {
    let mut worst = [0.0f64; 2];
    for (category, row) in evaluated(&["--precision", "f32"]) {
        assert!(row[..4].iter().all(|&input| f64::from(input as f32) == input), "inputs are printed as rounded");
        let expected = results(&reflect(row[0], row[1], row[2], row[3]));
        let critical = category.contains("critical");
        for (value, expected) in row[4..10].iter().zip(&expected[..6]) {
            let error = (value - expected).abs();
            assert!(error <= if critical { 2e-3 } else { 2e-6 }, "{category}: {value} for {expected} in {row:?}");
            worst[usize::from(critical)] = worst[usize::from(critical)].max(error);
        }
        assert!(row[10].is_nan() && row[11].is_nan(), "kernels know no phases");
    }
    println!("largest error {:.2e}, beside the critical angle {:.2e}", worst[0], worst[1]);
    assert!(worst[0] > 1e-8, "these are the kernels, not the reference");
}

#[test]
fn values_that_everybody_knows() {
    let text = "# a remark\nn1, n2, k2, cos_i, note\n1,1.5,0,0.7071067811865476,45°\n1.5,1,0,0.984807753012208,10° inside\n1,1.5,0,0.5547001962252291,Brewster\n";
    let folder = folder(&[("points.csv", text)]);
    let output = run(folder.path(), &["fresnel", "eval", "--input", "points.csv"]);
    let text = String::from_utf8(output.stdout).expect("text");
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(rows[0][..5], ["n1", "n2", "k2", "cos_i", "note"]);
    let number = |row: usize, column: usize| rows[row][column].parse::<f64>().expect("a number");
    // Rs = sin²(i − t)/sin²(i + t), Rp = tan²(i − t)/tan²(i + t).
    for (row, degrees, ratio) in [(1, 45.0f64, 1.0 / 1.5), (2, 10.0, 1.5)] {
        let i = degrees.to_radians();
        let t = (i.sin() * ratio).asin();
        let (rs, rp) = (((i - t).sin() / (i + t).sin()).powi(2), ((i - t).tan() / (i + t).tan()).powi(2));
        assert!((number(row, 5) - rs).abs() < 1e-14 && (number(row, 6) - rp).abs() < 1e-14);
        assert!((number(row, 7) - (rs + rp) / 2.0).abs() < 1e-14);
    }
    assert!(number(3, 6) < 1e-30 && rows[1][4] == "45°");
}

#[test]
fn what_is_wrong_with_a_table_is_told() {
    let table = |text: &str| {
        let folder = folder(&[("points.csv", text)]);
        refused(folder.path(), &["fresnel", "eval", "--input", "points.csv"])
    };
    for (text, says) in [
        ("n1,n2,cos\n1,2,1\n", &["no column", "`k2`", "`cos_i` (is it `cos`?)"][..]),
        ("n1,n2,k2,cos_i\n1,1.5,0,1\n1,1.5,0,1.5\n", &["points.csv:3", "`cos_i` is 1.5", "0 … 1"]),
        ("# x\nn1,n2,k2,cos_i\n0,1.5,0,1\n", &["points.csv:3", "`n1` is 0", "above 0"]),
        ("n1,n2,k2,cos_i\n1,-1.5,0,1\n", &["points.csv:2", "`n2` is -1.5"]),
        ("n1,n2,k2,cos_i\n1,1.5,-1,1\n", &["points.csv:2", "`k2` is -1", "not negative"]),
        ("n1,n2,k2,cos_i\n1,nan,0,1\n", &["points.csv:2", "`n2` is nan"]),
        ("n1,n2,k2,cos_i\n1,glass,0,1\n", &["points.csv:2", "`n2` is \"glass\", expected a number"]),
        ("n1,n2,k2,cos_i\n1,1.5\n", &["points.csv:2: 2 columns, expected 4"]),
        // As an editor counts: comments and empty lines before a row, and before the header.
        ("n1,n2,k2,cos_i\n1,1.5,0,1\n# x\n1,1.5,0,1.5\n", &["points.csv:4", "`cos_i` is 1.5"]),
        ("# x\n# y\nn1,n2,k2,cos_i\n# z\n\n1,1.5,0,1\n# z\n1,glass,0,1\n", &["points.csv:8", "\"glass\""]),
        ("n1,n2,k2,cos_i\n1,1.5,0,1\n# x\n# y\n1,1.5\n", &["points.csv:5: 2 columns"]),
        ("", &["no column"]),
    ] {
        let said = table(text);
        assert!(said.starts_with("error: ") && says.iter().all(|words| said.contains(words)), "{text:?}: {said}");
    }
    let folder = folder(&[]);
    assert!(refused(folder.path(), &["fresnel", "eval", "--input", "none.csv"]).contains("none.csv"));
}

/// 1e-60 is 0 in single precision, and 1e60 infinite.
#[test]
fn what_single_precision_cannot_hold_is_told() {
    for (row, says) in [("1,1e-60,0,0.5", "`n2` is 1e-60"), ("1,1.5,1e60,0.5", "`k2` is 1e60")] {
        let folder = folder(&[("points.csv", &format!("n1,n2,k2,cos_i\n{row}\n"))]);
        let said = refused(folder.path(), &["fresnel", "eval", "--precision", "f32", "--input", "points.csv"]);
        assert!(said.contains(&format!("points.csv:2: {says}")) && said.contains("beyond the range of f32"), "{said}");
    }
}
