//! Where light comes from: shapes that shine, suns, and the environment around everything.
//!
//! Shapes, points, suns and pictures of the surroundings are aimed at: which one, `choice` says, by power and, where there are more than
//! a few lamps, by a `tree` of them. Shapes and suns are sampled over the solid angle they cover, a picture by its luminance ([`Map`]).
//! Surroundings that are constant or a gradient are smooth, so paths find them best by following the surface they leave; they are never
//! sampled by themselves.

mod choice;
mod distribution;
mod grid;
mod map;
mod point;
mod reach;
mod sun;
mod tree;

pub use choice::FEW;
pub use map::{Look, Map, mean_over_sphere};
pub use point::{Cone, Point};
pub use sun::Sun;
pub use tree::Receiver;

use crate::geometry::{Hit, ShapeId, Side, Target, World};
use crate::math::Lanes;
use crate::spectrum::{SpectrumId, Tint, Wavelengths};
use choice::Choice;
use glam::Vec3;

/// What an emitter is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Source {
    /// A flat one may shine from its back too.
    Shape {
        id: ShapeId,
        two_sided: bool,
    },
    Sun(Sun),
    Point(Point),
    /// The picture of [`Environment::Map`].
    Map,
}

/// A light that can be aimed at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Emitter {
    pub source: Source,
    /// W m⁻² sr⁻¹ nm⁻¹, the same in all directions; of a picture, what is white in it; of a point, W sr⁻¹ nm⁻¹.
    pub radiance: SpectrumId,
    /// Luminous power in any unit common to all emitters: how often this one is chosen.
    pub power: f64,
}

/// Spectral radiance, W m⁻² sr⁻¹ nm⁻¹: a spectrum, in the colour of a texel if it comes from a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Radiance {
    pub spectrum: SpectrumId,
    pub tint: Option<Tint>,
}

impl Radiance {
    #[inline]
    pub fn at<const N: usize>(&self, wavelengths: Wavelengths<N>) -> Lanes<N> {
        let spectrum = wavelengths.at(self.spectrum);
        match self.tint {
            None => spectrum,
            Some(tint) => spectrum * tint.at(wavelengths.positions()),
        }
    }
}

impl From<SpectrumId> for Radiance {
    fn from(spectrum: SpectrumId) -> Self {
        Self { spectrum, tint: None }
    }
}

/// The light that comes from infinitely far away.
#[derive(Clone, Debug, Default)]
pub enum Environment {
    #[default]
    Dark,
    Constant(SpectrumId),
    /// Linear in the sine of the elevation between straight down, level and straight up (+z).
    Gradient {
        nadir: SpectrumId,
        horizon: SpectrumId,
        zenith: SpectrumId,
    },
    Map(Box<Map>),
}

/// All lights of a scene.
#[derive(Clone, Debug, Default)]
pub struct Lights {
    emitters: Vec<Emitter>,
    choice: Choice,
    /// The emitter of each shape.
    of_shape: Vec<Option<u32>>,
    /// So many emitters at the end are suns.
    suns: usize,
    /// How often the picture of the surroundings is chosen.
    map: f32,
    pub environment: Environment,
}

/// A point on a light, seen from where it was asked for.
#[derive(Clone, Copy, Debug)]
pub struct LightSample {
    pub direction: Vec3,
    /// Infinite for a sun and for the surroundings.
    pub distance: f32,
    /// None for a sun and for the surroundings.
    pub target: Option<Target>,
    pub radiance: Radiance,
    /// Per steradian, with the choice of the light; of a point light the choice alone.
    pub pdf: f32,
    /// What the radiance is multiplied by: 1, or of a point light irradiance per intensity.
    pub strength: f32,
    /// Whether no other way finds this light.
    pub only: bool,
}

impl Lights {
    /// Emitters without power are never chosen; they have nothing to give.
    pub fn new(mut emitters: Vec<Emitter>, environment: Environment, world: &World) -> Self {
        let choice = Choice::new(&mut emitters, world);
        let suns = emitters.iter().filter(|emitter| matches!(emitter.source, Source::Sun(_))).count();
        let mut of_shape = vec![None; world.shapes().len()];
        for (index, emitter) in emitters.iter().enumerate() {
            if let Source::Shape { id, .. } = emitter.source {
                of_shape[id.0 as usize] = Some(index as u32);
            }
        }
        let map = emitters.iter().position(|emitter| emitter.source == Source::Map);
        let map = map.map_or(0.0, |index| choice.fixed(index));
        Self { emitters, choice, of_shape, suns, map, environment }
    }

    pub fn emitters(&self) -> &[Emitter] {
        &self.emitters
    }

    /// How many lights are chosen by a tree; 0 if there is none.
    pub fn in_tree(&self) -> usize {
        self.choice.in_tree()
    }

    /// The emitter that [`Self::sample`] asks for a number in [0, 1), and the probability of that.
    #[inline]
    pub fn choose(&self, receiver: &Receiver, choice: f32) -> Option<(usize, f32)> {
        self.choice.sample(receiver, choice)
    }

    /// The probability with which [`Self::sample`] asks an emitter.
    pub fn probability(&self, receiver: &Receiver, index: usize) -> f32 {
        self.choice.probability(receiver, index)
    }

    /// A point on one of the lights that shines towards the receiver; `None` where the chosen light shows its dark side.
    #[inline]
    pub fn sample(&self, world: &World, receiver: &Receiver, choice: f32, u: [f32; 2]) -> Option<LightSample> {
        let (index, probability) = self.choose(receiver, choice)?;
        let Emitter { source, radiance, .. } = self.emitters[index];
        let from = receiver.point;
        match source {
            Source::Sun(sun) => Some(LightSample {
                direction: sun.sample(u),
                distance: f32::INFINITY,
                target: None,
                radiance: radiance.into(),
                pdf: sun.pdf() * probability,
                strength: 1.0,
                only: false,
            }),
            Source::Point(point) => {
                let (direction, distance, strength) = point.seen_from(from)?;
                let (target, radiance) = (None, radiance.into());
                Some(LightSample { direction, distance, target, radiance, pdf: probability, strength, only: true })
            }
            Source::Map => {
                let Environment::Map(map) = &self.environment else { return None };
                let (direction, Look { tint, pdf }) = map.sample(u)?;
                Some(LightSample {
                    direction,
                    distance: f32::INFINITY,
                    target: None,
                    radiance: Radiance { spectrum: radiance, tint: Some(tint) },
                    pdf: pdf * probability,
                    strength: 1.0,
                    only: false,
                })
            }
            Source::Shape { id, two_sided } => {
                let toward = world.shape(id)?.sample_toward(from, u)?;
                let front = toward.normal.dot(toward.direction) < 0.0;
                (front || two_sided).then_some(LightSample {
                    direction: toward.direction,
                    distance: toward.distance,
                    target: Some(Target { shape: id, facet: toward.facet }),
                    radiance: radiance.into(),
                    pdf: toward.pdf * probability,
                    strength: 1.0,
                    only: false,
                })
            }
        }
    }

    /// What shines at a hit towards where the ray came from.
    #[inline]
    pub fn emitted(&self, hit: &Hit) -> Option<SpectrumId> {
        let Emitter { source, radiance, .. } = self.emitters[self.of_shape[hit.shape.0 as usize]? as usize];
        let both = matches!(source, Source::Shape { two_sided: true, .. });
        (hit.side == Side::Outside || both).then_some(radiance)
    }

    /// What the surroundings send from a direction, and the density with which [`Self::sample`] gives it, per steradian.
    #[inline]
    pub fn environment<const N: usize>(&self, direction: Vec3, wavelengths: Wavelengths<N>) -> (Lanes<N>, f32) {
        let radiance = match &self.environment {
            Environment::Dark => Lanes::ZERO,
            Environment::Constant(radiance) => wavelengths.at(*radiance),
            Environment::Gradient { nadir, horizon, zenith } => {
                let pole = if direction.z > 0.0 { zenith } else { nadir };
                let share = direction.z.abs().min(1.0);
                wavelengths.at(*horizon) * (1.0 - share) + wavelengths.at(*pole) * share
            }
            Environment::Map(map) => {
                let Look { tint, pdf } = map.look(direction);
                let radiance = Radiance { spectrum: map.light(), tint: Some(tint) };
                return (radiance.at(wavelengths), pdf * self.map);
            }
        };
        (radiance, 0.0)
    }

    /// The suns in a direction, each with the density with which [`Self::sample`] gives it, per steradian.
    #[inline]
    pub fn suns(&self, direction: Vec3) -> impl Iterator<Item = (SpectrumId, f32)> {
        let first = self.emitters.len() - self.suns;
        self.emitters[first..].iter().zip(first..).filter_map(move |(emitter, index)| match emitter.source {
            Source::Sun(sun) if sun.meets(direction) => Some((emitter.radiance, sun.pdf() * self.choice.fixed(index))),
            _ => None,
        })
    }

    /// The density with which [`Self::sample`] gives the direction from a receiver to a hit on a light, per steradian.
    #[inline]
    pub fn pdf(&self, world: &World, receiver: &Receiver, direction: Vec3, hit: &Hit) -> f32 {
        let Some(index) = self.of_shape[hit.shape.0 as usize] else { return 0.0 };
        let Some(shape) = world.shape(hit.shape) else { return 0.0 };
        shape.pdf_toward(receiver.point, direction, hit) * self.choice.probability(receiver, index as usize)
    }
}
