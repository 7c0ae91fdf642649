//! Words of a text file with their places, so that an error about a number can point at it.

use std::borrow::Cow;

use super::error::Fault;
use super::table::Number;

/// A word and where it starts, bytes from the start of the file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Word<'a> {
    pub text: &'a str,
    pub offset: usize,
}

impl<'a> Word<'a> {
    pub fn number(self) -> Result<Number, Fault> {
        self.scaled(0)
    }

    /// The number times a power of ten: 0.0517 µm become 51.7 nm and not 51.699999999999996, by
    /// moving the decimal point.
    pub fn scaled(self, power: i32) -> Result<Number, Fault> {
        let plain = self.with_point();
        let value: f64 = plain.parse().map_err(|_| self.no_number())?;
        if power == 0 || !value.is_finite() {
            return Ok(Number { value, offset: self.offset });
        }
        let (mantissa, exponent) = plain.split_once(['e', 'E']).unwrap_or((&plain, "0"));
        let exponent: i32 = exponent.parse().map_err(|_| self.no_number())?;
        let moved = format!("{mantissa}e{}", exponent.saturating_add(power));
        Ok(Number { value: moved.parse().map_err(|_| self.no_number())?, offset: self.offset })
    }

    pub fn is_number(self) -> bool {
        self.with_point().parse::<f64>().is_ok()
    }

    /// With a point where the decimal mark is a comma.
    fn with_point(self) -> Cow<'a, str> {
        match self.text.split_once(',') {
            Some((whole, fraction)) if !fraction.contains(',') && !self.text.contains('.') => {
                Cow::Owned(format!("{whole}.{fraction}"))
            }
            _ => Cow::Borrowed(self.text),
        }
    }

    pub fn no_number(self) -> Fault {
        Fault::at(self.offset, format!("`{}`, expected a number", self.text))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_move_exactly_and_commas_are_points() {
        let scaled = |text, power| Word { text, offset: 3 }.scaled(power).map(|number| number.value).ok();
        assert_eq!(scaled("0.0517", 3), Some(51.7));
        assert_eq!(scaled("5,17e-2", 3), Some(51.7));
        assert_eq!(scaled("5876", -1), Some(587.6));
        assert_eq!(scaled("1,2,3", 0), None);
        assert_eq!(scaled("1.2,3", 0), None);
        assert!(scaled("nan", 3).is_some_and(f64::is_nan));
    }
}
