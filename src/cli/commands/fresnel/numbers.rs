//! Lists of numbers on the command line: `450,550,650`, `0-90:5`, or both.

use crate::scene::SceneError;

/// More numbers than this are a slip of the step.
const MOST: f64 = 100_000.0;

/// What a list's numbers are.
#[derive(Clone, Copy, Debug)]
pub struct Kind {
    /// The option they belong to.
    pub option: &'static str,
    pub range: [f64; 2],
    /// A range as an example.
    pub example: &'static str,
}

/// Reads a list; `A-B:STEP` is all from A to B by STEP.
pub fn list(text: &str, kind: Kind) -> Result<Vec<f64>, SceneError> {
    let wrong = |what: String| {
        SceneError::new(format!("{} {text}: {what}", kind.option))
            .help(format!("numbers separated by commas, or a range with a step such as {}", kind.example))
    };
    let parts = text.split(',').map(|part| part.trim());
    let numbers = parts.map(|part| one(part).map_err(wrong)).collect::<Result<Vec<_>, _>>()?.concat();
    let [low, high] = kind.range;
    match numbers.iter().find(|number| !(low..=high).contains(*number)) {
        Some(number) => Err(wrong(format!("{number} is not within {low} … {high}"))),
        None => Ok(numbers),
    }
}

fn one(part: &str) -> Result<Vec<f64>, String> {
    let number = |text: &str| {
        let value = text.trim().parse::<f64>().ok().filter(|value| value.is_finite());
        value.ok_or_else(|| format!("\"{}\" is no number", text.trim()))
    };
    let Some((range, step)) = part.split_once(':') else {
        return match part.split_once('-') {
            Some((first, last)) if number(first).is_ok() && number(last).is_ok() => {
                Err(format!("the range {part} needs a step: {part}:10"))
            }
            _ => number(part).map(|number| vec![number]),
        };
    };
    let (first, last) = range.split_once('-').ok_or(format!("\"{range}\" is no range"))?;
    let (low, high, by) = (number(first)?, number(last)?, number(step)?);
    let steps = (high - low) / by;
    if by <= 0.0 || high < low || steps > MOST {
        return Err(format!("the range {part} does not go up in at most {MOST} steps"));
    }
    // Decimals as written: 0.57 is not 57 times the double nearest to 0.01.
    let decimals = [first, step].map(|text| text.trim().split_once('.').map_or(0, |(_, digits)| digits.len()));
    let unit = libm::pow(10.0, decimals[0].max(decimals[1]).min(15) as f64);
    let at = |i: u32| ((low + f64::from(i) * by) * unit).round() / unit;
    Ok((0..=(steps + 1e-9) as u32).map(at).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    const KIND: Kind = Kind { option: "--angles", range: [0.0, 90.0], example: "0-90:5" };

    #[test]
    fn numbers_and_ranges_mix() {
        assert_eq!(list("0-90:30, 45,7.5", KIND).unwrap(), [0.0, 30.0, 60.0, 90.0, 45.0, 7.5]);
        assert_eq!(list("0-1:0.01", KIND).unwrap()[57], 0.57);
        assert_eq!(list("0.5-2:0.7", KIND).unwrap(), [0.5, 1.2, 1.9]);
        assert_eq!(list("5-5:1", KIND).unwrap(), [5.0]);
    }

    #[test]
    fn slips_are_told() {
        let said = |text: &str| list(text, KIND).unwrap_err().to_string();
        assert!(said("0-90").contains("needs a step: 0-90:10"));
        assert!(said("10,x").contains("\"x\" is no number") && said("10,x").contains("such as 0-90:5"));
        assert!(said("0-120:10").contains("100 is not within 0 … 90"));
        for text in ["90-0:10", "0-90:0", "0-90:-1", "0-90:1e-9", "1:2", "", "0-90:nan", "0-inf:1"] {
            assert!(said(text).starts_with("--angles"), "{text}");
        }
    }
}
