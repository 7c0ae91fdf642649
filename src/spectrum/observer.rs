//! The eye: CIE colour matching functions, linear between their 1 nm points.

use super::{About, Table};

/// The standard observers that come with the library.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Observer {
    /// CIE 1931, 2°: the colour convention wherever nothing else is asked.
    #[default]
    Cie1931,
    /// CIE 1964, 10°.
    Cie1964,
    /// CIE 2015, 2°, from cone fundamentals; from 390 nm.
    Cie2015,
}

impl Observer {
    pub const ALL: [Self; 3] = [Self::Cie1931, Self::Cie1964, Self::Cie2015];

    /// The name of its data set in the library.
    pub fn name(self) -> &'static str {
        match self {
            Self::Cie1931 => "cie-1931-2",
            Self::Cie1964 => "cie-1964-10",
            Self::Cie2015 => "cie-2015-2",
        }
    }
}

/// x̄, ȳ, z̄; 0 outside their range.
#[derive(Clone, Debug, PartialEq)]
pub struct ColorMatching {
    pub x: Table,
    pub y: Table,
    pub z: Table,
    pub about: About,
}

impl ColorMatching {
    /// (x̄, ȳ, z̄) at a wavelength.
    pub fn at(&self, nm: f64) -> [f64; 3] {
        [self.x.at(nm), self.y.at(nm), self.z.at(nm)]
    }
}
