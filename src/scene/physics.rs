//! The parts of the physics that a kernel can be compiled without, as a set.

use std::ops::BitOr;

/// A set of parts of the physics.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Physics(pub u32);

impl Physics {
    /// Opaque surfaces, found by chance by the light.
    pub const NONE: Self = Self(0);
    /// Lights are aimed at from surfaces that scatter.
    pub const LIGHT_SAMPLING: Self = Self(1);
    /// Metals are not smooth.
    pub const ROUGH_METAL: Self = Self(1 << 1);
    /// Surfaces change from place to place.
    pub const TEXTURES: Self = Self(1 << 2);
    /// Interfaces that are not exact.
    pub const APPROXIMATIONS: Self = Self(1 << 3);
    /// Solids that light enters.
    pub const CLEAR_MEDIA: Self = Self(1 << 4);
    /// Media that take light away on its way.
    pub const ABSORPTION: Self = Self(1 << 5);
    /// Lanes part where they enter a medium.
    pub const DISPERSION: Self = Self(1 << 6);
    /// Boundaries of clear media that coincide, overlap, or are covered by something opaque.
    pub const CONTACT: Self = Self(1 << 7);
    /// Boundaries of clear media that are not smooth.
    pub const ROUGH_GLASS: Self = Self(1 << 8);
    /// Media that absorb so much that it shows in what they reflect.
    pub const COMPLEX_INDEX: Self = Self(1 << 9);
    pub const ALL: Self = Self((1 << 10) - 1);

    pub const fn and(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// Whether all parts of another set are in this one.
    pub const fn contains(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }
}

impl BitOr for Physics {
    type Output = Self;

    fn bitor(self, other: Self) -> Self {
        self.and(other)
    }
}

impl FromIterator<Self> for Physics {
    fn from_iter<I: IntoIterator<Item = Self>>(parts: I) -> Self {
        parts.into_iter().fold(Self::NONE, Self::and)
    }
}
