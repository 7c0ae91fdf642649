//! Where light comes from: shapes that shine, and the environment around everything.
//!
//! A shape is chosen by its power and sampled over the solid angle it covers. The environment here is smooth, so paths find
//! it best by following the surface they leave; it is never sampled by itself.

use crate::geometry::{Hit, ShapeId, Side, World};
use crate::spectrum::{Lanes, SpectrumId, Tables};
use glam::Vec3;

/// A shape that shines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Emitter {
    pub shape: ShapeId,
    /// W m⁻² sr⁻¹ nm⁻¹, the same in all directions.
    pub radiance: SpectrumId,
    /// Whether a flat shape shines from its back too.
    pub two_sided: bool,
    /// Luminous power in any unit common to all emitters: how often this one is chosen.
    pub power: f64,
}

/// The light that comes from infinitely far away.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
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
}

impl Environment {
    /// Spectral radiance that arrives from `direction`.
    #[inline]
    pub fn radiance<const N: usize>(&self, tables: &Tables, direction: Vec3, offset: u32) -> Lanes<N> {
        match *self {
            Self::Dark => Lanes::ZERO,
            Self::Constant(radiance) => tables.get(radiance, offset),
            Self::Gradient { nadir, horizon, zenith } => {
                let pole = if direction.z > 0.0 { zenith } else { nadir };
                let share = direction.z.abs().min(1.0);
                tables.get::<N>(horizon, offset) * (1.0 - share) + tables.get::<N>(pole, offset) * share
            }
        }
    }
}

/// All lights of a scene.
#[derive(Clone, Debug, Default)]
pub struct Lights {
    emitters: Vec<Emitter>,
    /// Share of the total power up to and with each emitter.
    cumulative: Vec<f32>,
    /// The emitter of each shape.
    of_shape: Vec<Option<u32>>,
    pub environment: Environment,
}

/// A point on a light, seen from where it was asked for.
#[derive(Clone, Copy, Debug)]
pub struct LightSample {
    pub direction: Vec3,
    pub distance: f32,
    pub shape: ShapeId,
    pub radiance: SpectrumId,
    /// Per steradian, with the choice of the light.
    pub pdf: f32,
}

impl Lights {
    /// Emitters without power are never chosen; they have nothing to give.
    pub fn new(emitters: Vec<Emitter>, environment: Environment, shapes: usize) -> Self {
        let total: f64 = emitters.iter().map(|emitter| emitter.power).sum();
        let mut sum = 0.0;
        let cumulative = emitters
            .iter()
            .map(|emitter| {
                sum += emitter.power;
                (sum / total) as f32
            })
            .collect();
        let mut of_shape = vec![None; shapes];
        for (index, emitter) in emitters.iter().enumerate() {
            of_shape[emitter.shape.0 as usize] = Some(index as u32);
        }
        Self { emitters, cumulative, of_shape, environment }
    }

    pub fn emitters(&self) -> &[Emitter] {
        &self.emitters
    }

    fn probability(&self, index: usize) -> f32 {
        let before = if index == 0 { 0.0 } else { self.cumulative[index - 1] };
        self.cumulative[index] - before
    }

    /// A point on one of the lights that shines towards `from`; `None` where the chosen light shows its dark side.
    #[inline]
    pub fn sample(&self, world: &World, from: Vec3, choice: f32, u: [f32; 2]) -> Option<LightSample> {
        let index = self.cumulative.iter().position(|&share| choice < share)?;
        let emitter = self.emitters[index];
        let toward = world.shape(emitter.shape)?.sample_toward(from, u)?;
        let front = toward.normal.dot(toward.direction) < 0.0;
        (front || emitter.two_sided).then_some(LightSample {
            direction: toward.direction,
            distance: toward.distance,
            shape: emitter.shape,
            radiance: emitter.radiance,
            pdf: toward.pdf * self.probability(index),
        })
    }

    /// What shines at a hit towards where the ray came from.
    #[inline]
    pub fn emitted(&self, hit: &Hit) -> Option<SpectrumId> {
        let emitter = self.emitters[self.of_shape[hit.shape.0 as usize]? as usize];
        (hit.side == Side::Outside || emitter.two_sided).then_some(emitter.radiance)
    }

    /// The density with which [`Self::sample`] gives the direction from `from` to a hit on a light, per steradian.
    #[inline]
    pub fn pdf(&self, world: &World, from: Vec3, direction: Vec3, hit: &Hit) -> f32 {
        let Some(index) = self.of_shape[hit.shape.0 as usize] else { return 0.0 };
        let Some(shape) = world.shape(hit.shape) else { return 0.0 };
        shape.pdf_toward(from, direction, hit) * self.probability(index as usize)
    }
}
