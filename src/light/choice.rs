//! Which light is asked at a point.
//!
//! A few lights are chosen by their power alone. More than [`FEW`] that have a place are leaves of a tree ([`super::tree`]), which
//! looks at distance and direction too; suns and surroundings have no place and keep their share by power.

use super::reach::Reach;
use super::tree::{Receiver, Tree};
use super::{Emitter, Source};
use crate::geometry::World;

/// Up to so many lights with a place are chosen by power alone.
///
/// Measured on matt and metal things under small and large lamps: the error by power over that by the tree at 16 samples a pixel is
/// 1.1–1.5 (3.6 where most of two lamps look away) for two, 1.3–2.1 for three, 1.3–1.8 for four, 1.5–2.1 for eight, 2.9–3.9 for 64 and
/// 3.8–5.3 for 1024; a sample takes 8–11 % more instructions with two to eight, 15 % with 64, 21 % with 1024.
pub const FEW: usize = 2;

/// Of all choices, this part goes to the emitters in equal shares: power says nothing about distance or what stands between,
/// and a lamp that is chosen next to never leaves rare bright dots.
const EQUAL_PART: f64 = 0.25;

/// Steps of the numbers that choose, so that an emitter is chosen exactly as often as its density says.
const STEPS: f64 = 16_777_216.0;

/// One in so many choices among a tree's lights is not the tree's, but goes to all of them equally, so that no light that it thinks little
/// of leaves rare bright dots. One in 4 has 1.2 times the variance on many lamps and twice on eight; one in 16 takes 5 % off it, and
/// is worse with groups of which the tree knows too little.
const EQUAL_OF_TREE: u32 = 8;

/// How emitters are chosen.
#[derive(Clone, Debug, Default)]
pub(super) struct Choice {
    /// Share of the choices up to and with each emitter, in whole [`STEPS`].
    cumulative: Vec<f32>,
    grove: Option<Grove>,
}

/// The first so many emitters, in a tree.
#[derive(Clone, Debug)]
struct Grove {
    tree: Tree,
    lights: u32,
    /// Steps in which its lights are chosen equally, and by the tree.
    equal: u32,
    grown: u32,
}

impl Choice {
    /// Puts emitters into the order by which they are known: those of a tree first, suns last.
    pub fn new(emitters: &mut Vec<Emitter>, world: &World) -> Self {
        emitters.sort_by_key(|emitter| matches!(emitter.source, Source::Sun(_)));
        let reach = |emitter: &Emitter| Reach::of(emitter, world).filter(|reach| reach.intensity > 0.0);
        let reaches: Vec<Reach> = emitters.iter().filter_map(reach).collect();
        if reaches.len() <= FEW {
            return Self { cumulative: shares(emitters), grove: None };
        }
        let (placed, others): (Vec<Emitter>, Vec<_>) = emitters.iter().partition(|emitter| reach(emitter).is_some());
        let (tree, order) = Tree::new(&reaches);
        *emitters = order.iter().map(|&light| placed[light]).chain(others).collect();
        let cumulative = shares(emitters);
        let steps = steps(cumulative[order.len() - 1]);
        let equal = steps / EQUAL_OF_TREE;
        let grove = Grove { tree, lights: order.len() as u32, equal, grown: steps - equal };
        Self { cumulative, grove: Some(grove) }
    }

    /// How many emitters are leaves of a tree.
    pub fn in_tree(&self) -> usize {
        self.grove.as_ref().map_or(0, |grove| grove.lights as usize)
    }

    /// An emitter, and the probability of its choice.
    #[inline]
    pub fn sample(&self, receiver: &Receiver, choice: f32) -> Option<(usize, f32)> {
        if let Some(grove) = &self.grove {
            let step = steps(choice);
            if step < grove.equal + grove.grown {
                let (light, steps) = grove.sample(receiver, step)?;
                return Some((light as usize, share(steps)));
            }
        }
        let index = self.cumulative.partition_point(|&share| share <= choice);
        (index < self.cumulative.len()).then(|| (index, self.fixed(index)))
    }

    /// Of the choice of an emitter at a point.
    #[inline]
    pub fn probability(&self, receiver: &Receiver, index: usize) -> f32 {
        match &self.grove {
            Some(grove) if index < grove.lights as usize => share(grove.steps(receiver, index as u32)),
            _ => self.fixed(index),
        }
    }

    /// Of the choice of an emitter that is in no tree: the same everywhere.
    #[inline]
    pub fn fixed(&self, index: usize) -> f32 {
        let before = if index == 0 { 0.0 } else { self.cumulative[index - 1] };
        self.cumulative[index] - before
    }
}

impl Grove {
    /// Where the equal share of a light begins.
    #[inline]
    fn start(&self, light: u32) -> u32 {
        (u64::from(light) * u64::from(self.equal) / u64::from(self.lights)) as u32
    }

    #[inline]
    fn equal(&self, light: u32) -> u32 {
        self.start(light + 1) - self.start(light)
    }

    /// The light that a step chooses, and how many steps do.
    #[inline]
    fn sample(&self, receiver: &Receiver, step: u32) -> Option<(u32, u32)> {
        if step < self.equal {
            // The last light that starts at the step or before it.
            let light = (((u64::from(step) + 1) * u64::from(self.lights) - 1) / u64::from(self.equal)) as u32;
            return Some((light, self.steps(receiver, light)));
        }
        let (light, steps) = self.tree.sample(receiver, step - self.equal, self.grown)?;
        Some((light, steps + self.equal(light)))
    }

    /// How many steps choose a light.
    #[inline]
    fn steps(&self, receiver: &Receiver, light: u32) -> u32 {
        self.equal(light) + self.tree.steps(receiver, light, self.grown)
    }
}

#[inline]
fn steps(share: f32) -> u32 {
    (share * STEPS as f32) as u32
}

#[inline]
fn share(steps: u32) -> f32 {
    steps as f32 * (1.0 / STEPS as f32)
}

/// Share of the choices up to and with each emitter, in whole [`STEPS`].
fn shares(emitters: &[Emitter]) -> Vec<f32> {
    let total: f64 = emitters.iter().map(|emitter| emitter.power).sum();
    let shining = emitters.iter().filter(|emitter| emitter.power > 0.0).count() as f64;
    let mut sum = 0.0;
    let share = |emitter: &Emitter| match emitter.power > 0.0 {
        true => EQUAL_PART / shining + (1.0 - EQUAL_PART) * emitter.power / total,
        false => 0.0,
    };
    emitters
        .iter()
        .map(|emitter| {
            sum += share(emitter);
            (libm::round(sum * STEPS) / STEPS) as f32
        })
        .collect()
}
