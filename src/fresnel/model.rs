//! A Fresnel model: what a new one must provide, and the closed set that a scene chooses from by name.

use super::{Dielectric, FresnelModel, dielectric};
use crate::spectrum::{Lanes, nearest};

/// Reflectance as a function of the angle alone: made once per hit from the indices, then asked for cosines.
pub trait Model<const N: usize>: Copy {
    /// The curve of N = n2 + i k2 seen from n1.
    fn new(n1: &Lanes<N>, n2: &Lanes<N>, k2: &Lanes<N>) -> Self;

    /// Unpolarised reflectance at cos θ_i of each lane.
    fn reflectance(&self, cos_theta_i: &Lanes<N>) -> Lanes<N>;

    /// A lossless interface n1 → n2. The curve is evaluated on the rarer side, where its angle covers 0…90°; beyond the
    /// critical angle R = 1. Exact models override this, for they need no such rule.
    #[inline]
    fn dielectric(n1: &Lanes<N>, n2: &Lanes<N>, cos_theta_i: &Lanes<N>) -> Dielectric<N> {
        let cos_theta_t = dielectric::cos_theta_t(n1, n2, cos_theta_i);
        let rarer = Lanes::from_fn(|lane| if n1[lane] > n2[lane] { cos_theta_t[lane] } else { cos_theta_i[lane] });
        let curve = Self::new(n1, n2, &Lanes::ZERO).reflectance(&rarer);
        let r = Lanes::from_fn(|lane| if n1[lane] == n2[lane] { 0.0 } else { curve[lane] });
        Dielectric { r, cos_theta_t }
    }
}

/// A model name that is not in the list.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("unknown Fresnel model `{name}` (known: {known}){}", nearest.map_or(String::new(), |nearest| format!("; did you mean `{nearest}`?")))]
pub struct UnknownModel {
    pub name: String,
    /// The known name most like it, if any is.
    pub nearest: Option<&'static str>,
    /// All known names, separated by commas.
    pub known: String,
}

impl UnknownModel {
    pub(super) fn new(name: &str, names: &[&'static str]) -> Self {
        Self { name: name.to_owned(), nearest: nearest(name, names.iter().copied()), known: names.join(", ") }
    }
}

/// Writes the enum of names and the enum of values from the list of models, with static dispatch.
macro_rules! models {
    ($($(#[$doc:meta])* $variant:ident = $name:literal, $model:ident::$curve:ident;)+) => {
        /// The Fresnel model that a scene asks for, by name.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum FresnelModel {
            $($(#[$doc])* $variant,)+
        }

        /// The reflectance curve at a hit: one model, all lanes.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum Fresnel<const N: usize> {
            $($(#[$doc])* $variant($model::$curve<N>),)+
        }

        impl FresnelModel {
            pub const ALL: &'static [Self] = &[$(Self::$variant),+];
            pub const NAMES: &'static [&'static str] = &[$($name),+];

            /// The name in scene files.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name,)+
                }
            }

            /// The curve of N = n2 + i k2 seen from n1.
            #[inline]
            pub fn at<const N: usize>(self, n1: &Lanes<N>, n2: &Lanes<N>, k2: &Lanes<N>) -> Fresnel<N> {
                match self {
                    $(Self::$variant => Fresnel::$variant($model::$curve::new(n1, n2, k2)),)+
                }
            }

            /// Reflectance and refraction angle of the lossless interface n1 → n2, cosines lane by lane.
            #[inline]
            pub fn dielectric<const N: usize>(self, n1: &Lanes<N>, n2: &Lanes<N>, cos_theta_i: &Lanes<N>) -> Dielectric<N> {
                match self {
                    $(Self::$variant => $model::$curve::dielectric(n1, n2, cos_theta_i),)+
                }
            }
        }

        impl<const N: usize> Fresnel<N> {
            /// Unpolarised reflectance of all lanes at one cos θ_i.
            #[inline]
            pub fn reflectance(&self, cos_theta_i: f32) -> Lanes<N> {
                match self {
                    $(Self::$variant(curve) => curve.reflectance(&Lanes::splat(cos_theta_i)),)+
                }
            }
        }
    };
}

pub(super) use models;

impl std::str::FromStr for FresnelModel {
    type Err = UnknownModel;
    fn from_str(name: &str) -> Result<Self, UnknownModel> {
        let found = Self::ALL.iter().find(|model| model.name() == name);
        found.copied().ok_or_else(|| UnknownModel::new(name, Self::NAMES))
    }
}

impl std::fmt::Display for FresnelModel {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

impl serde::Serialize for FresnelModel {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

impl<'de> serde::Deserialize<'de> for FresnelModel {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let name = String::deserialize(deserializer)?;
        name.parse().map_err(serde::de::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use crate::fresnel::{FresnelModel, UnknownModel};

    #[test]
    fn names_are_read_back() {
        for model in FresnelModel::ALL {
            assert_eq!(model.name().parse(), Ok(*model));
        }
    }

    #[test]
    fn a_slip_is_understood() {
        let error = "Schlik".parse::<FresnelModel>().unwrap_err();
        assert_eq!(error.nearest, Some("schlick"));
        assert!(error.to_string().contains("did you mean `schlick`?") && error.to_string().contains("exact, schlick"));
        assert_eq!("q".parse::<FresnelModel>().unwrap_err().nearest, None::<&str>);
        let _: UnknownModel = error;
    }

    #[test]
    fn scene_files_hold_the_name() {
        let json = serde_json::to_string(&FresnelModel::Schlick).unwrap();
        assert_eq!(json, "\"schlick\"");
        assert_eq!(serde_json::from_str::<FresnelModel>(&json).unwrap(), FresnelModel::Schlick);
    }
}
