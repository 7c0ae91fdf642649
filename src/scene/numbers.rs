//! Numbers that are checked while they are read, so that an error points at the very number.

use serde::de::{Deserialize, Deserializer, Error, SeqAccess, Visitor};
use std::fmt;
use std::marker::PhantomData;
use toml::Spanned;

/// A number that single precision can hold: neither infinite nor NaN.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finite(pub f64);

/// A length in scene units: finite and above 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Length(pub f64);

/// Exactly `N` of a kind, in a list.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exactly<T, const N: usize>(pub [T; N]);

/// A number whose place is known.
pub type Number = Spanned<f64>;
pub type Numbers<const N: usize> = Exactly<Finite, N>;
pub type Lengths<const N: usize> = Exactly<Length, N>;

impl<const N: usize> Numbers<N> {
    pub fn new(values: [f64; N]) -> Self {
        Self(values.map(Finite))
    }

    pub fn values(&self) -> [f64; N] {
        self.0.map(|Finite(value)| value)
    }
}

impl<const N: usize> Lengths<N> {
    pub fn values(&self) -> [f64; N] {
        self.0.map(|Length(value)| value)
    }
}

impl<const N: usize> Default for Numbers<N> {
    fn default() -> Self {
        Self([Finite(0.0); N])
    }
}

/// A number with a condition.
trait Checked: Sized {
    const EXPECTED: &'static str;

    fn checked(value: f64) -> Option<Self>;
}

impl Checked for Finite {
    const EXPECTED: &'static str = "a finite number";

    fn checked(value: f64) -> Option<Self> {
        (value as f32).is_finite().then_some(Self(value))
    }
}

impl Checked for Length {
    const EXPECTED: &'static str = "a length, finite and above 0";

    fn checked(value: f64) -> Option<Self> {
        let single = value as f32;
        (single > 0.0 && single.is_finite()).then_some(Self(value))
    }
}

struct NumberVisitor<T>(PhantomData<T>);

impl<T: Checked> Visitor<'_> for NumberVisitor<T> {
    type Value = T;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(T::EXPECTED)
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<T, E> {
        self.visit_f64(value as f64)
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<T, E> {
        T::checked(value).ok_or_else(|| E::custom(format!("expected {}, found {}", T::EXPECTED, short(value))))
    }
}

/// A number in its shortest form: 0, -1.5, 1e-60, NaN.
pub fn short(value: f64) -> String {
    let text = format!("{value:?}");
    text.strip_suffix(".0").unwrap_or(&text).to_owned()
}

struct ListVisitor<T, const N: usize>(PhantomData<T>);

impl<'de, T: Deserialize<'de>, const N: usize> Visitor<'de> for ListVisitor<T, N> {
    type Value = Exactly<T, N>;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "a list of {N} numbers")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Self::Value, A::Error> {
        let mut found = Vec::new();
        while let Some(number) = list.next_element()? {
            found.push(number);
        }
        found
            .try_into()
            .map(Exactly)
            .map_err(|found: Vec<T>| A::Error::custom(format!("expected {N} numbers, found {}", found.len())))
    }
}

impl<'de> Deserialize<'de> for Finite {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_f64(NumberVisitor(PhantomData))
    }
}

impl<'de> Deserialize<'de> for Length {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_f64(NumberVisitor(PhantomData))
    }
}

impl<'de, T: Deserialize<'de>, const N: usize> Deserialize<'de> for Exactly<T, N> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(ListVisitor(PhantomData))
    }
}
