//! Colour and normal of what a camera ray meets, without its light: what compositing and denoisers go by.
//!
//! The albedo of a surface is its colour under D65 and equal illumination: the reflectance of a diffuse one, the reflectance
//! at normal incidence of a metal, as linear RGB in which a perfect reflector is (1, 1, 1). It is worked out once for each
//! surface by the nodes of the render, so that it has no noise. Dielectrics count as white: behind their first surface
//! a cut stone shows a dozen facets at once, and that would be noise where denoisers want none; Intel's *Open Image Denoise*
//! (its manual, "Albedo") asks for 1 in that case. What only shines, and where there is nothing, is black, with normal zero
//! where there is nothing. Channels are cut to 0…1, as denoisers ask (gold's red is 1.04).
//!
//! The normal is in world space and on the side that is seen.
//!
//! For denoisers mirrors are followed, as the same manual advises ("perfect specular surfaces"): a smooth metal shows albedo × its own
//! and the normal of what it reflects, so that what is seen in it stays sharp. A mirror that shows nothing but sky keeps its own.

use crate::bsdf::dielectric::reflect;
use crate::fresnel::{self, FresnelModel, Specimen, Target};
use crate::geometry::{Hit, Ray, Side};
use crate::math::Lanes;
use crate::scene::{MediumId, Metal, Needs, Scene, Surface};
use crate::spectrum::{
    Daylight, LAMBDA_MAX_NM, LAMBDA_MIN_NM, Matrix3, NODE_COUNT, Nodes, RgbSpace, Spectrum, SpectrumId, Tint, Xyz,
    bradford,
};
use crate::texture::Texels;
use glam::Vec3;
use std::collections::BTreeMap;

/// Mirrors that are followed one after another.
const MIRRORS: u32 = 4;

/// Correlated colour temperature of D65, K.
const D65_KELVIN: f64 = 6504.0;

/// What a ray sees of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// Linear RGB in 0…1.
    pub albedo: [f32; 3],
    /// A unit vector, or zero.
    pub normal: Vec3,
}

impl Seen {
    const NOTHING: Self = Self { albedo: [0.0; 3], normal: Vec3::ZERO };
}

/// The albedo of every surface of a scene, and whether mirrors are followed.
#[derive(Clone, Debug)]
pub struct Guides {
    /// By surface, not cut.
    albedos: Vec<[f32; 3]>,
    /// Colours of the pictures on surfaces.
    printed: BTreeMap<u32, Texels<[f32; 3]>>,
    mirrors: bool,
}

impl Guides {
    /// For the first surface of every ray, in the RGB of a picture.
    pub fn first_hit(scene: &Scene, needs: &Needs, space: RgbSpace) -> Self {
        let white = White::new(scene, needs, space);
        let pictures =
            scene.patterns.iter().filter_map(|(&surface, pattern)| Some((surface, pattern.reflectance.as_ref()?)));
        Self {
            albedos: scene.surfaces.iter().map(|surface| white.albedo(surface)).collect(),
            printed: pictures.map(|(surface, picture)| (surface, white.colors(picture))).collect(),
            mirrors: false,
        }
    }

    /// For what is seen in mirrors, as denoisers want it.
    pub fn behind_mirrors(scene: &Scene, needs: &Needs, space: RgbSpace) -> Self {
        Self { mirrors: true, ..Self::first_hit(scene, needs, space) }
    }

    /// What a camera ray sees.
    pub fn seen(&self, scene: &Scene, ray: &Ray) -> Seen {
        let Some(hit) = scene.closest(ray) else { return Seen::NOTHING };
        let mut seen = self.at(scene, &hit);
        if self.mirrors {
            seen = self.follow(scene, *ray, hit, seen);
        }
        Seen { albedo: seen.albedo.map(|channel| channel.clamp(0.0, 1.0)), ..seen }
    }

    fn follow(&self, scene: &Scene, mut ray: Ray, mut hit: Hit, first: Seen) -> Seen {
        let (mut seen, mut tint) = (first, [1.0; 3]);
        for _ in 0..MIRRORS {
            if !is_mirror(scene, &hit) {
                break;
            }
            tint = product(tint, self.at(scene, &hit).albedo);
            let cos = (-ray.direction.dot(facing(&hit))).clamp(0.0, 1.0);
            ray = Ray::leaving(&hit, hit.side, reflect(ray.direction, facing(&hit), cos));
            let Some(next) = scene.closest(&ray) else { return first };
            hit = next;
            let reflected = self.at(scene, &hit);
            seen = Seen { albedo: product(tint, reflected.albedo), normal: reflected.normal };
        }
        seen
    }

    fn at(&self, scene: &Scene, hit: &Hit) -> Seen {
        let surface = scene.object(hit.shape).surface;
        let albedo = match self.printed.get(&surface) {
            None => self.albedos[surface as usize],
            Some(picture) => {
                let around = picture.around(scene.world.uv(hit).unwrap_or_default());
                std::array::from_fn(|channel| around.iter().map(|(color, weight)| color[channel] * weight).sum())
            }
        };
        Seen { albedo, normal: facing(hit) }
    }
}

/// Whether all of what is hit is a smooth metal.
fn is_mirror(scene: &Scene, hit: &Hit) -> bool {
    let surface = scene.object(hit.shape).surface;
    let varies = scene.patterns.get(&surface).is_some_and(|pattern| pattern.alpha.is_some());
    let smooth = matches!(&scene.surfaces[surface as usize], Surface::Conductor(metal) if metal.is_smooth());
    smooth && !varies
}

/// The smooth normal on the side that a ray comes to.
fn facing(hit: &Hit) -> Vec3 {
    if hit.side == Side::Outside { hit.shading } else { -hit.shading }
}

fn product(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    std::array::from_fn(|channel| a[channel] * b[channel])
}

/// Reflectances as colours under D65.
struct White<'a> {
    scene: &'a Scene,
    nodes: Nodes,
    /// What a perfect reflector gives at each node.
    weights: Vec<Xyz>,
    rgb_from_xyz: Matrix3,
}

impl<'a> White<'a> {
    fn new(scene: &'a Scene, needs: &Needs, space: RgbSpace) -> Self {
        let nodes = Nodes::new(&needs.wavelength_density);
        // Within the range of the series; were it not, equal energy would do.
        let light = Daylight::new(D65_KELVIN).map_or(Spectrum::Constant(1.0), Spectrum::Daylight);
        let observer = nodes.observer_weights(&scene.picture.observer);
        let weights: Vec<Xyz> =
            nodes.values(&light).iter().zip(observer).map(|(light, xyz)| xyz.map(|x| x * light)).collect();
        let white = sum(weights.iter().copied());
        let adapt = bradford(white.map(|c| c / white[1]), space.white_xyz());
        let scale = Matrix3::diagonal([1.0 / white[1]; 3]);
        Self { scene, nodes, weights, rgb_from_xyz: space.rgb_from_xyz().after(&adapt).after(&scale) }
    }

    /// A picture's colours, by 2 nm at a time: at 10 nm reds were 0.3 % off.
    fn colors(&self, picture: &Texels<Tint>) -> Texels<[f32; 3]> {
        const BAND_NM: f64 = 2.0;
        let mut bands: BTreeMap<u32, (f64, f64, Xyz)> = BTreeMap::new();
        for (index, weight) in (0..NODE_COUNT).zip(&self.weights) {
            let nm = self.nodes.wavelength_nm(index);
            let (sum, count, total) = bands.entry((nm / BAND_NM) as u32).or_default();
            *sum += nm * weight[1];
            *count += weight[1];
            *total = std::array::from_fn(|i| total[i] + weight[i]);
        }
        let bands: Vec<(f32, Xyz)> = bands
            .into_values()
            .filter(|(_, count, _)| *count > 0.0)
            .map(|(sum, count, total)| {
                (((sum / count - LAMBDA_MIN_NM) / (LAMBDA_MAX_NM - LAMBDA_MIN_NM)) as f32, total)
            })
            .collect();
        picture.clone().map(|tint| {
            let seen = bands.iter().map(|(t, weight)| {
                let value = f64::from(tint.at(Lanes([*t]))[0]);
                weight.map(|w| w * value)
            });
            self.rgb_from_xyz.apply(sum(seen)).map(|channel| channel as f32)
        })
    }

    fn albedo(&self, surface: &Surface) -> [f32; 3] {
        match *surface {
            Surface::Black => [0.0; 3],
            Surface::Dielectric(_) => [1.0; 3],
            Surface::Diffuse(matt) => self.color(self.values(matt.reflectance)),
            Surface::Conductor(Metal { n, k, model, .. }) => {
                let specimen = self.scene.metal([n, k], MediumId::OUTSIDE);
                self.color(self.head_on(model, specimen))
            }
        }
    }

    /// Reflectance at normal incidence, by node.
    fn head_on(&self, model: FresnelModel, metal: Specimen) -> Vec<f64> {
        let at = |spectrum: &Spectrum| self.nodes.values(spectrum);
        match (model, &self.scene.rgb) {
            (FresnelModel::Rgb(model), Some(colors)) => {
                let rgb = model.fit(&Target::new(metal, &colors.meter)).reflectance(1.0);
                let primaries = colors.primaries.map(|id| self.values(id));
                (0..NODE_COUNT).map(|i| (0..3).map(|c| f64::from(rgb[c]) * primaries[c][i]).sum()).collect()
            }
            _ => {
                let indices = [metal.n1, metal.n2, metal.k2].map(at);
                // Every spectral model is exact there.
                (0..NODE_COUNT).map(|i| fresnel::f0(indices[0][i], indices[1][i], indices[2][i])).collect()
            }
        }
    }

    fn values(&self, id: SpectrumId) -> Vec<f64> {
        self.nodes.values(self.scene.spectra.get(id))
    }

    fn color(&self, reflectance: Vec<f64>) -> [f32; 3] {
        let seen = reflectance.iter().zip(&self.weights).map(|(r, weight)| weight.map(|w| w * r));
        self.rgb_from_xyz.apply(sum(seen)).map(|channel| channel as f32)
    }
}

fn sum(terms: impl Iterator<Item = Xyz>) -> Xyz {
    terms.fold([0.0; 3], |sum, term| std::array::from_fn(|i| sum[i] + term[i]))
}
