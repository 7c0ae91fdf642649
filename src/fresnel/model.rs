//! A Fresnel model: what a new one must provide, and the closed set that a scene chooses from by name.
//!
//! A spectral model knows the indices at each wavelength. An RGB model knows three channels: it is fitted to the colours of an
//! interface once, and `rgb` says how it acts on wavelengths.

use super::{Dielectric, FresnelModel, SpectralModel, Target, dielectric};
use crate::math::Lanes;
use crate::spectrum::nearest;

/// Reflectance as a function of the angle alone: made once per hit from the indices, then asked for cosines.
pub trait Model<const N: usize>: Copy {
    /// Whether it is made for lossless interfaces and says nothing of metals.
    const DIELECTRICS_ONLY: bool = false;

    /// The curve of N = n2 + i k2 seen from n1.
    fn new(n1: &Lanes<N>, n2: &Lanes<N>, k2: &Lanes<N>) -> Self;

    /// Unpolarised reflectance at cos θ_i of each lane.
    fn reflectance(&self, cos_theta_i: &Lanes<N>) -> Lanes<N>;

    /// A lossless interface n1 → n2. The curve is evaluated on the rarer side, where its angle covers 0…90°; beyond the
    /// critical angle R = 1. Exact models override this, for they need no such rule.
    #[inline]
    fn dielectric(n1: &Lanes<N>, n2: &Lanes<N>, cos_theta_i: &Lanes<N>) -> Dielectric<N> {
        let cos_theta_t = dielectric::cos_theta_t(n1, n2, cos_theta_i);
        let rarer = dielectric::on_the_rarer_side(n1, n2, cos_theta_i, &cos_theta_t);
        dielectric::bounded(n1, n2, &Self::new(n1, n2, &Lanes::ZERO).reflectance(&rarer), cos_theta_t)
    }
}

/// Reflectance of red, green and blue (linear sRGB) as a function of the angle: fitted to an interface once.
pub trait Rgb: Copy {
    /// The curve nearest to the exact colours of an interface, in the model's own way.
    fn fit(target: &Target) -> Self;

    /// Unpolarised reflectance of the three channels at cos θ_i; may be above 1 where the colour is.
    fn reflectance(&self, cos_theta_i: f32) -> Lanes<3>;
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

/// Writes the enums of names and of values from the lists of models, with static dispatch.
macro_rules! models {
    (
        spectral { $($(#[$doc:meta])* $variant:ident = $name:literal, $model:ident::$curve:ident;)+ }
        rgb { $($(#[$rgb_doc:meta])* $rgb_variant:ident = $rgb_name:literal, $rgb_model:ident::$rgb_curve:ident;)+ }
    ) => {
        /// The models that know the indices at each wavelength.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum SpectralModel {
            $($(#[$doc])* $variant,)+
        }

        /// The models that know three channels.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum RgbModel {
            $($(#[$rgb_doc])* $rgb_variant,)+
        }

        /// The reflectance curve of a spectral model at a hit, all lanes.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum SpectralCurve<const N: usize> {
            $($(#[$doc])* $variant($model::$curve<N>),)+
        }

        /// The reflectance curves of an RGB model, fitted to an interface.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum RgbCurve {
            $($(#[$rgb_doc])* $rgb_variant($rgb_model::$rgb_curve),)+
        }

        impl FresnelModel {
            pub const ALL: &'static [Self] = &[
                $(Self::Spectral(SpectralModel::$variant),)+
                $(Self::Rgb(RgbModel::$rgb_variant),)+
            ];
            pub const NAMES: &'static [&'static str] = &[$($name,)+ $($rgb_name,)+];

            /// The name in scene files.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::Spectral(SpectralModel::$variant) => $name,)+
                    $(Self::Rgb(RgbModel::$rgb_variant) => $rgb_name,)+
                }
            }
        }

        impl SpectralModel {
            pub const ALL: &'static [Self] = &[$(Self::$variant),+];

            /// Whether it is made for lossless interfaces and says nothing of metals.
            pub fn dielectrics_only(self) -> bool {
                match self {
                    $(Self::$variant => <$model::$curve<1> as Model<1>>::DIELECTRICS_ONLY,)+
                }
            }

            /// The curve of N = n2 + i k2 seen from n1.
            #[inline]
            pub fn at<const N: usize>(self, n1: &Lanes<N>, n2: &Lanes<N>, k2: &Lanes<N>) -> SpectralCurve<N> {
                match self {
                    $(Self::$variant => SpectralCurve::$variant($model::$curve::new(n1, n2, k2)),)+
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

        impl<const N: usize> SpectralCurve<N> {
            /// Unpolarised reflectance of all lanes at one cos θ_i.
            #[inline]
            pub fn reflectance(&self, cos_theta_i: f32) -> Lanes<N> {
                match self {
                    $(Self::$variant(curve) => curve.reflectance(&Lanes::splat(cos_theta_i)),)+
                }
            }
        }

        impl RgbModel {
            /// The curve nearest to the exact colours of an interface, in the model's own way.
            pub fn fit(self, target: &Target) -> RgbCurve {
                match self {
                    $(Self::$rgb_variant => RgbCurve::$rgb_variant($rgb_model::$rgb_curve::fit(target)),)+
                }
            }
        }

        impl RgbCurve {
            /// Unpolarised reflectance of red, green and blue at one cos θ_i.
            #[inline]
            pub fn reflectance(&self, cos_theta_i: f32) -> Lanes<3> {
                match self {
                    $(Self::$rgb_variant(curve) => curve.reflectance(cos_theta_i),)+
                }
            }
        }
    };
}

pub(super) use models;

impl FresnelModel {
    pub const EXACT: Self = Self::Spectral(SpectralModel::Exact);

    /// Whether it is made for lossless interfaces and says nothing of metals.
    pub fn dielectrics_only(self) -> bool {
        matches!(self, Self::Spectral(model) if model.dielectrics_only())
    }
}

impl std::str::FromStr for FresnelModel {
    type Err = UnknownModel;
    fn from_str(name: &str) -> Result<Self, UnknownModel> {
        let found = Self::ALL.iter().find(|model| model.name() == name);
        found.copied().ok_or_else(|| UnknownModel {
            name: name.to_owned(),
            nearest: nearest(name, Self::NAMES.iter().copied()),
            known: Self::NAMES.join(", "),
        })
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
    use crate::fresnel::{FresnelModel, SpectralModel, UnknownModel};

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
        let schlick = FresnelModel::Spectral(SpectralModel::Schlick);
        let json = serde_json::to_string(&schlick).unwrap();
        assert_eq!(json, "\"schlick\"");
        assert_eq!(serde_json::from_str::<FresnelModel>(&json).unwrap(), schlick);
    }
}
