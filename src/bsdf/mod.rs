//! Light at a surface, in the local frame: z is the normal, ωo the direction to the viewer, ωi to the light.
//!
//! A [`Bsdf`] is made per hit from the material and the wavelengths of the path, then asked for a direction (`sample`) and for
//! what goes between two (`eval`). Smooth dielectrics, where lanes part, are not a lobe but directions (`dielectric`) and a
//! choice (`branch`); rough ones send all lanes one way, to either side.
//!
//! A new surface is a file here with a type that [`Scatters`], and its line in [`surfaces!`].

pub mod albedo;
pub mod branch;
pub mod conductor;
pub mod dielectric;
pub mod diffuse;
mod ggx;
pub mod rough_dielectric;

pub use branch::{Choice, choose, keep_refracted};
pub use conductor::Conductor;
pub use diffuse::Diffuse;
pub use rough_dielectric::RoughDielectric;

use crate::math::Lanes;
use glam::Vec3;

/// The numbers that choose a direction, each in [0, 1).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Draw {
    /// Chooses the lobe, where a surface has [several](Scatters::has_lobes).
    pub lobe: f32,
    /// Chooses within the lobe.
    pub uv: [f32; 2],
}

/// The part of a surface that a direction was chosen from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lobe {
    /// A single direction, reflected: `eval` knows nothing of it.
    Mirror,
    /// Directions on the side of ωo.
    Reflection,
    /// Directions beyond the surface.
    Transmission,
}

/// The sides of a surface that it scatters to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sides {
    /// That of ωo alone.
    One,
    Both,
}

/// A direction chosen by the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample<const N: usize> {
    pub wi: Vec3,
    /// f cos θ_i/pdf.
    pub weight: Lanes<N>,
    /// In sr⁻¹; 1 for a mirror.
    pub pdf: f32,
    pub lobe: Lobe,
}

/// Scattering between two given directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eval<const N: usize> {
    /// f cos θ_i in sr⁻¹.
    pub f_cos: Lanes<N>,
    /// Density in sr⁻¹ with which `sample` chooses ωi.
    pub pdf: f32,
}

impl<const N: usize> Eval<N> {
    pub const NONE: Self = Self { f_cos: Lanes::ZERO, pdf: 0.0 };
}

/// A model of a surface, made for one hit and the wavelengths of one path.
///
/// What a model needs beside directions it is given when it is made: a random walk within layers its numbers, a texture
/// its footprint.
pub trait Scatters<const N: usize> {
    /// Chooses a direction, given ωo with z > 0. None where the facet that was met sends light to the wrong side: that sample
    /// weighs zero.
    fn sample(&self, wo: Vec3, draw: Draw) -> Option<Sample<N>>;

    /// Returns what is scattered from ωi to ωo, with ωo.z > 0 and ωi on a side that the surface scatters to; zero for
    /// single directions.
    fn eval(&self, wo: Vec3, wi: Vec3) -> Eval<N>;

    /// Returns whether all of it is a single direction, so that lights cannot be aimed at through it.
    fn is_delta(&self) -> bool {
        false
    }

    /// Returns the sides that it scatters to.
    fn sides(&self) -> Sides {
        Sides::One
    }

    /// Returns whether `sample` chooses among lobes by [`Draw::lobe`].
    fn has_lobes(&self) -> bool {
        false
    }

    /// Returns whether a mesh's smooth normals show a hard edge of shadow on it, which wants softening.
    fn softens_terminator(&self) -> bool {
        false
    }
}

/// The closed set of surfaces: for each its name and its type.
///
/// What asks a surface of one kind is told so at compile time: the choice among all of them took 2 % of the instructions of a
/// sample in a Cornell box.
macro_rules! surfaces {
    ($($(#[$about:meta])* $name:ident),+ $(,)?) => {
        /// How a surface scatters, for the wavelengths of one path.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum Bsdf<const N: usize> {
            $($(#[$about])* $name($name<N>),)+
        }

        $(impl<const N: usize> From<$name<N>> for Bsdf<N> {
            #[inline]
            fn from(surface: $name<N>) -> Self {
                Self::$name(surface)
            }
        })+

        impl<const N: usize> Scatters<N> for Bsdf<N> {
            #[inline(always)]
            fn sample(&self, wo: Vec3, draw: Draw) -> Option<Sample<N>> {
                if wo.z <= 0.0 {
                    return None;
                }
                match self {
                    $(Self::$name(surface) => surface.sample(wo, draw),)+
                }
            }

            #[inline(always)]
            fn eval(&self, wo: Vec3, wi: Vec3) -> Eval<N> {
                let reaches = wi.z > 0.0 || wi.z < 0.0 && self.sides() == Sides::Both;
                if wo.z <= 0.0 || !reaches {
                    return Eval::NONE;
                }
                match self {
                    $(Self::$name(surface) => surface.eval(wo, wi),)+
                }
            }

            #[inline(always)]
            fn is_delta(&self) -> bool {
                match self {
                    $(Self::$name(surface) => surface.is_delta(),)+
                }
            }

            #[inline(always)]
            fn sides(&self) -> Sides {
                match self {
                    $(Self::$name(surface) => surface.sides(),)+
                }
            }

            #[inline(always)]
            fn has_lobes(&self) -> bool {
                match self {
                    $(Self::$name(surface) => surface.has_lobes(),)+
                }
            }

            #[inline(always)]
            fn softens_terminator(&self) -> bool {
                match self {
                    $(Self::$name(surface) => surface.softens_terminator(),)+
                }
            }
        }
    };
}

surfaces! {
    Diffuse,
    Conductor,
    RoughDielectric,
}
