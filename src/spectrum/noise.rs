//! Noise in measured points: what is set right or passed over with a note, and what is refused.
//!
//! Data of others have rows out of order, wavelengths twice, and values a hair beyond what is
//! possible. Outside the visible no picture depends on such a row, so it is passed over; inside,
//! only what is surely noise is set right.

use super::error::Fault;
use super::table::{Bound, Number};
use super::{LAMBDA_MAX_NM, LAMBDA_MIN_NM};

/// A wavelength in nm and what was measured there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    pub nm: Number,
    pub value: Number,
}

/// Two values at one wavelength agree if they are within this share of the larger.
const AGREE: f64 = 0.01;

/// Whether two measurements of one thing may be averaged.
pub(super) fn agree(a: f64, b: f64) -> bool {
    a == b || (a - b).abs() <= AGREE * a.abs().max(b.abs())
}

/// Returns points whose wavelengths increase and whose values are possible, and notes what it took
/// to get there.
pub(super) fn cleaned(
    mut points: Vec<Point>,
    what: &str,
    bound: Bound,
    notes: &mut Vec<String>,
) -> Result<Vec<Point>, Fault> {
    if falls(&points) {
        points.reverse();
    }
    let points = possible(points, what, bound, notes)?;
    let points = without_twins(points, notes);
    in_order(points, notes)
}

/// Notes wavelengths that would be in the visible if their unit were a thousand times larger.
pub(super) fn note_likely_um(nm: &[Number], stated: &str, notes: &mut Vec<String>) {
    let (low, high) = nm
        .iter()
        .fold((f64::INFINITY, 0.0), |(low, high): (f64, f64), number| (low.min(number.value), high.max(number.value)));
    if high < LAMBDA_MIN_NM && low * 1000.0 < LAMBDA_MAX_NM && high * 1000.0 > LAMBDA_MIN_NM {
        note(notes, format!("`{stated}` runs from {low} to {high} nm, outside the visible: is it in µm?"));
    }
}

/// The same for n and k is told once.
pub(super) fn note(notes: &mut Vec<String>, text: String) {
    if !notes.contains(&text) {
        notes.push(text);
    }
}

fn is_visible(nm: f64) -> bool {
    (LAMBDA_MIN_NM..=LAMBDA_MAX_NM).contains(&nm)
}

/// Whether the wavelengths go down rather than up.
fn falls(points: &[Point]) -> bool {
    let steps = |down: bool| points.windows(2).filter(|pair| (pair[1].nm.value < pair[0].nm.value) == down).count();
    steps(true) > steps(false)
}

/// Sets right what is noise, and leaves out impossible values where nobody looks.
fn possible(points: Vec<Point>, what: &str, bound: Bound, notes: &mut Vec<String>) -> Result<Vec<Point>, Fault> {
    let peak = points.iter().map(|point| point.value.value).fold(0.0, f64::max);
    let (mut kept, mut left_out, mut mended) = (Vec::with_capacity(points.len()), Vec::new(), Vec::new());
    for point in &points {
        let Point { nm, value } = *point;
        match bound.nearest(value.value, peak) {
            Some(possible) => {
                if possible != value.value {
                    mended.push((*point, possible));
                }
                kept.push(Point { nm, value: Number { value: possible, ..value } });
            }
            None if is_visible(nm.value) => return Err(impossible(point, what, bound)),
            None => left_out.push(*point),
        }
    }
    if let (true, Some(first)) = (kept.is_empty(), left_out.first()) {
        return Err(impossible(first, what, bound));
    }
    if let Some((Point { nm, value }, possible)) = mended.first() {
        let more = and_more(mended.len());
        let (value, nm) = (shown(value.value), nm.value);
        let text = format!("{what} is {value} at {nm} nm{more}: noise, taken for {possible}");
        note(notes, text);
    }
    if let Some(first) = left_out.first() {
        note(notes, passed_over(left_out.len(), &format!("{what} is {} at {} nm", first.value.value, first.nm.value)));
    }
    Ok(kept)
}

fn impossible(point: &Point, what: &str, bound: Bound) -> Fault {
    let (value, nm) = (point.value.value, point.nm.value);
    Fault::at(point.value.offset, format!("{what} is {value} at {nm} nm, expected {}", bound.expected()))
}

fn and_more(count: usize) -> String {
    if count > 1 { format!(" and the like at {} more", count - 1) } else { String::new() }
}

/// A number of few zeros.
fn shown(value: f64) -> String {
    if value.abs() < 1e-4 { format!("{value:e}") } else { value.to_string() }
}

fn passed_over(count: usize, why: &str) -> String {
    let rows = if count == 1 { "1 row".to_owned() } else { format!("{count} rows") };
    format!("{rows} outside {LAMBDA_MIN_NM}–{LAMBDA_MAX_NM} nm passed over: {why}")
}

/// Of neighbours at one wavelength, their mean if they agree; outside the visible the first in any
/// case. Others stay, to be refused.
fn without_twins(points: Vec<Point>, notes: &mut Vec<String>) -> Vec<Point> {
    let mut kept: Vec<Point> = Vec::with_capacity(points.len());
    let (mut averaged, mut left_out) = (Vec::new(), Vec::new());
    let mut rest = points.as_slice();
    while let Some(first) = rest.first() {
        let count = rest.iter().take_while(|point| point.nm.value == first.nm.value).count();
        let (twins, others) = rest.split_at(count);
        rest = others;
        let nm = first.nm.value;
        if twins.iter().all(|twin| agree(twin.value.value, first.value.value)) {
            let mean = twins.iter().map(|twin| twin.value.value).sum::<f64>() / count as f64;
            if twins.iter().any(|twin| twin.value.value != first.value.value) {
                averaged.push(nm);
                kept.push(Point { value: Number { value: mean, ..first.value }, ..*first });
            } else {
                kept.push(*first);
            }
        } else if is_visible(nm) {
            kept.extend(twins);
        } else {
            left_out.extend(std::iter::repeat_n(nm, count - 1));
            kept.push(*first);
        }
    }
    if let Some(nm) = averaged.first() {
        let more = and_more(averaged.len());
        note(notes, format!("two values at {nm} nm{more}: they agree and are averaged"));
    }
    if let Some(nm) = left_out.first() {
        note(notes, passed_over(left_out.len(), &format!("two values at {nm} nm")));
    }
    kept
}

/// Leaves out the fewest points that break the order, all of them outside the visible.
fn in_order(points: Vec<Point>, notes: &mut Vec<String>) -> Result<Vec<Point>, Fault> {
    let Some(pair) = points.windows(2).find(|pair| pair[1].nm.value <= pair[0].nm.value) else { return Ok(points) };
    let (before, after) = (pair[0].nm, pair[1].nm);
    let keeps = longest_increasing(&points);
    let lost = points.iter().zip(&keeps).filter(|(_, keep)| !**keep).map(|(point, _)| point.nm.value);
    if lost.clone().any(is_visible) {
        let message =
            format!("the wavelength {} nm follows {} nm, expected increasing wavelengths", after.value, before.value);
        return Err(Fault::at(after.offset, message));
    }
    note(notes, passed_over(lost.count(), &format!("{} nm follows {} nm", after.value, before.value)));
    Ok(points.into_iter().zip(keeps).filter(|(_, keep)| *keep).map(|(point, _)| point).collect())
}

/// Which points make up the longest strictly increasing sequence (patience sorting, Schensted
/// 1961).
fn longest_increasing(points: &[Point]) -> Vec<bool> {
    // The last point of the best sequence of each length, and what comes before each point.
    let mut ends: Vec<usize> = Vec::new();
    let mut before: Vec<Option<usize>> = Vec::with_capacity(points.len());
    for (i, point) in points.iter().enumerate() {
        let length = ends.partition_point(|&end| points[end].nm.value < point.nm.value);
        before.push(length.checked_sub(1).map(|shorter| ends[shorter]));
        if length == ends.len() {
            ends.push(i);
        } else {
            ends[length] = i;
        }
    }
    let mut keeps = vec![false; points.len()];
    let mut last = ends.last().copied();
    while let Some(i) = last {
        keeps[i] = true;
        last = before[i];
    }
    keeps
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is kept, and the notes.
    type Cleaned = (Vec<(f64, f64)>, Vec<String>);

    fn clean(points: &[(f64, f64)], bound: Bound) -> Result<Cleaned, Fault> {
        let number = |value, offset| Number { value, offset };
        let points =
            points.iter().enumerate().map(|(i, &(nm, value))| Point { nm: number(nm, i), value: number(value, i) });
        let mut notes = Vec::new();
        let kept = cleaned(points.collect(), "k", bound, &mut notes)?;
        Ok((kept.iter().map(|point| (point.nm.value, point.value.value)).collect(), notes))
    }

    #[test]
    fn good_points_pass_without_a_word_in_either_order() {
        let up = [(300.0, 1.0), (400.0, 2.0), (900.0, 0.0)];
        let down = [up[2], up[1], up[0]];
        for points in [up, down] {
            assert_eq!(clean(&points, Bound::NonNegative).unwrap(), (up.to_vec(), Vec::new()));
        }
    }

    #[test]
    fn rows_out_of_order_outside_the_visible_are_passed_over() {
        // 2000 is the culprit, not the six that follow it.
        let points = [200.0, 2000.0, 210.0, 220.0, 400.0, 800.0, 900.0, 890.0, 1000.0].map(|nm| (nm, 1.0));
        let (kept, notes) = clean(&points, Bound::NonNegative).unwrap();
        let nm: Vec<f64> = kept.iter().map(|point| point.0).collect();
        assert_eq!(nm, [200.0, 210.0, 220.0, 400.0, 800.0, 890.0, 1000.0]);
        assert_eq!(notes, ["2 rows outside 360–830 nm passed over: 210 nm follows 2000 nm"]);
        let inside = [400.0, 600.0, 500.0, 700.0].map(|nm| (nm, 1.0));
        assert!(clean(&inside, Bound::NonNegative).unwrap_err().message.contains("500 nm follows 600 nm"));
    }

    #[test]
    fn noise_of_k_is_zero_inside_and_passed_over_outside() {
        let points = [(200.0, -3.0), (400.0, -1e-6), (500.0, -1e-9), (600.0, 1.0)];
        let (kept, notes) = clean(&points, Bound::NonNegative).unwrap();
        assert_eq!(kept, [(400.0, 0.0), (500.0, 0.0), (600.0, 1.0)]);
        assert_eq!(notes[0], "k is -1e-6 at 400 nm and the like at 1 more: noise, taken for 0");
        assert_eq!(notes[1], "1 row outside 360–830 nm passed over: k is -3 at 200 nm");
        let message = clean(&[(400.0, -1.1e-6)], Bound::NonNegative).unwrap_err().message;
        assert!(message.starts_with("k is -0.0000011 at 400 nm, expected a number of 0 or more"), "{message}");
    }

    #[test]
    fn reflectances_are_clamped_by_a_hair_only() {
        let (kept, notes) = clean(&[(400.0, 1.01), (500.0, -0.001)], Bound::Fraction).unwrap();
        assert_eq!((kept, notes.len()), (vec![(400.0, 1.0), (500.0, 0.0)], 1));
        assert!(
            clean(&[(400.0, 1.011)], Bound::Fraction).is_err() && clean(&[(400.0, -0.0011)], Bound::Fraction).is_err()
        );
    }

    #[test]
    fn twins_are_averaged_if_they_agree() {
        let (kept, notes) = clean(&[(400.0, 1.0), (400.0, 1.01), (500.0, 2.0), (500.0, 2.0)], Bound::Any).unwrap();
        assert_eq!(kept, [(400.0, 1.005), (500.0, 2.0)]);
        assert_eq!(notes, ["two values at 400 nm: they agree and are averaged"]);
        let (kept, notes) = clean(&[(300.0, 1.0), (300.0, 2.0), (500.0, 2.0)], Bound::Any).unwrap();
        assert_eq!((kept, notes.len()), (vec![(300.0, 1.0), (500.0, 2.0)], 1));
        assert!(
            clean(&[(500.0, 1.0), (500.0, 2.0)], Bound::Any).unwrap_err().message.contains("500 nm follows 500 nm")
        );
    }

    #[test]
    fn micrometres_called_nanometres_are_told() {
        let told = |values: &[f64]| {
            let numbers: Vec<_> = values.iter().map(|&value| Number { value, offset: 0 }).collect();
            let mut notes = Vec::new();
            note_likely_um(&numbers, "wavelength_nm", &mut notes);
            notes
        };
        assert_eq!(told(&[0.4, 0.7]), ["`wavelength_nm` runs from 0.4 to 0.7 nm, outside the visible: is it in µm?"]);
        assert!(told(&[400.0, 700.0]).is_empty() && told(&[1.0, 50.0]).is_empty() && told(&[]).is_empty());
    }
}
