//! A material as the parameters of renderers, clipped to what they take.
//!
//! | engine | metal | dielectric | defined in |
//! |---|---|---|---|
//! | glTF | `baseColorFactor` = F0, linear Rec. 709 | `ior` = n_d | Khronos, *glTF 2.0 Specification*, 3.9.2 and appendix B; *KHR_materials_ior* |
//! | Filament | `baseColor` = F0, linear Rec. 709 | `reflectance` = √(F0/0.16) | Guy & Agopian, *Physically Based Rendering in Filament*, "Reflectance remapping"; *Filament Materials Guide*, "Base color" |
//! | Unreal | `BaseColor` = F0, linear | `Specular` = F0/0.08 | Karis, *Real Shading in Unreal Engine 4*, SIGGRAPH 2013; Epic, *Physically Based Materials* |
//! | OpenPBR, MaterialX | `base_color` = F0, `specular_color` = F82 tint | `specular_ior` = n_d | ASWF, *OpenPBR Surface 1.1*, metal and dielectric base; Kutz, Hašan & Edmondson, *Novel aspects of the Adobe Standard Material*, 2021 |
//! | Disney | `baseColor` = F0, linear | `specular` = F0/0.08 | Burley, *Physically-Based Shading at Disney*, SIGGRAPH 2012, 5.5 |
//!
//! The colour of a clear dielectric is what is in it or under it, so its base colour is left open; a scalar is made of the luminance of
//! F0. glTF and Filament are defined with Rec. 709 primaries and get them whatever the space of the table; the others work in a space
//! that their user chooses and get that of the table. A metal's `Specular`, `reflectance` and index do nothing and are left open.

use super::{Color, Specular};
use crate::fresnel::f82_tint;
use crate::spectrum::{RgbSpace, encode_srgb};
use serde::Serialize;

/// What to type into which engine; the keys are the engines' own names.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Engines {
    pub gltf: Gltf,
    pub filament: Filament,
    pub unreal: Unreal,
    pub openpbr: OpenPbr,
    pub disney: Disney,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Gltf {
    /// With an alpha of 1.
    pub base_color_factor: Option<[f64; 4]>,
    pub metallic_factor: f64,
    /// Of the extension `KHR_materials_ior`.
    pub ior: Option<f64>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Filament {
    /// Linear, as materials take it.
    pub base_color: Option<[f64; 3]>,
    /// Encoded, as `RgbType::sRGB` and colour pickers take it.
    #[serde(rename = "baseColor_sRGB")]
    pub base_color_srgb: Option<[f64; 3]>,
    pub metallic: f64,
    pub reflectance: Option<f64>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "PascalCase")]
pub struct Unreal {
    pub base_color: Option<[f64; 3]>,
    pub metallic: f64,
    pub specular: Option<f64>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OpenPbr {
    pub base_color: Option<[f64; 3]>,
    pub base_metalness: f64,
    pub specular_color: Option<[f64; 3]>,
    pub specular_ior: Option<f64>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Disney {
    pub base_color: Option<[f64; 3]>,
    pub metallic: f64,
    pub specular: Option<f64>,
}

impl Engines {
    /// `specular` is that of a dielectric; a metal has none.
    pub(super) fn new(f0: &Color, f_mu17: &Color, specular: Option<Specular>, space: RgbSpace) -> Self {
        let metal = specular.is_none();
        let metallic = f64::from(u8::from(metal));
        let ior = specular.map(|specular| specular.ior);
        let level = specular.map(|specular| specular.level.min(1.0));
        let (base, tint) = f82_tint::f82_tint(f0.linear, f_mu17.linear);
        let (base, tint) = (metal.then_some(base), metal.then_some(tint));
        let rec709 = metal.then(|| rec709(f0.linear, space).map(|value| value.clamp(0.0, 1.0)));
        Self {
            gltf: Gltf { base_color_factor: rec709.map(|[r, g, b]| [r, g, b, 1.0]), metallic_factor: metallic, ior },
            filament: Filament {
                base_color: rec709,
                base_color_srgb: rec709.map(|rgb| rgb.map(encode_srgb)),
                metallic,
                reflectance: specular.map(|specular| specular.reflectance.min(1.0)),
            },
            unreal: Unreal { base_color: base, metallic, specular: level },
            openpbr: OpenPbr { base_color: base, base_metalness: metallic, specular_color: tint, specular_ior: ior },
            disney: Disney { base_color: base, metallic, specular: level },
        }
    }
}

fn rec709(linear: [f64; 3], space: RgbSpace) -> [f64; 3] {
    if space == RgbSpace::Srgb {
        return linear;
    }
    space.chromaticities().to(RgbSpace::Srgb).map_or(linear, |matrix| matrix.apply(linear))
}
