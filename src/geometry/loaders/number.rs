//! Numbers as text.

use std::str::FromStr;

/// `f32` or `f64` from a word of a file, correctly rounded; also `nan` and `inf`.
pub(super) fn parse<T: FromStr + Copy + Into<f64>>(word: &str) -> Result<T, String> {
    let Ok(value) = word.parse::<T>() else {
        return Err(format!("`{word}` is not a number"));
    };
    // Digits that become infinite are too many, which is another thing than `inf`.
    if value.into().is_infinite() && word.contains(|c: char| c.is_ascii_digit()) {
        return Err(format!("{word} is beyond the range of numbers"));
    }
    Ok(value)
}
