//! The choice as a probability: it sums to one, it is what happens, and it is worth its price.

use super::lamps::{Kind, Scene, direction, receivers, room, spots, vector};
use crate::statistics::{Random, chi_squared};
use glam::Vec3;
use spectrel::light::{FEW, Receiver, Source};

const STEPS: u32 = 1 << 24;

fn probabilities(scene: &Scene, receiver: &Receiver) -> Vec<f64> {
    (0..scene.lights.emitters().len()).map(|i| f64::from(scene.lights.probability(receiver, i))).collect()
}

/// Never more than one; less by what a tree gives to groups in which no light can reach the place.
#[test]
fn probabilities_sum_to_one() {
    let mut random = Random::new(1);
    for (kind, count) in
        [(Kind::Balls, 5), (Kind::Balls, 1000), (Kind::Ceiling, 64), (Kind::Mixed, 9), (Kind::Mixed, 200)]
    {
        let scene = room(3, kind, count, true);
        assert_eq!(scene.lights.in_tree(), if count > FEW + 2 { count - 2 } else { 0 });
        for receiver in receivers(&mut random, 400) {
            let all = probabilities(&scene, &receiver);
            let total: f64 = all.iter().sum();
            assert!(total <= 1.0, "{kind:?} {count}: {total}");
            if kind == Kind::Balls && receiver.normal.is_none() {
                assert!(total > 1.0 - 1e-6, "{kind:?} {count}: {total}");
            }
            for (emitter, p) in scene.lights.emitters().iter().zip(&all) {
                assert_eq!(*p > 0.0, emitter.power > 0.0, "{emitter:?}");
            }
        }
    }
}

#[test]
fn lights_are_chosen_as_often_as_their_probability_says() {
    let mut random = Random::new(2);
    for (kind, count) in [(Kind::Balls, 12), (Kind::Ceiling, 64), (Kind::Mixed, 200), (Kind::Mixed, 1000)] {
        let scene = room(5, kind, count, false);
        for receiver in receivers(&mut random, 4) {
            let expected = probabilities(&scene, &receiver);
            let mut counts = vec![0.0; expected.len() + 1];
            let samples = 200_000;
            for _ in 0..samples {
                match scene.lights.choose(&receiver, random.unit()) {
                    Some((index, p)) => {
                        assert_eq!(f64::from(p), expected[index], "one and the same probability");
                        counts[index] += 1.0;
                    }
                    None => counts[expected.len()] += 1.0,
                }
            }
            let nothing = 1.0 - expected.iter().sum::<f64>();
            let p = chi_squared(&counts, &[expected, vec![nothing]].concat(), f64::from(samples));
            assert!(p > 1e-4, "{kind:?} {count}: p = {p}");
        }
    }
}

/// Sharp edges are what spots have unless told, and narrow ones are hardly wider than single precision tells angles.
#[test]
fn spots_are_chosen_where_they_shine() {
    for (full, none) in [(0.3, 0.3), (0.3, 0.6), (3.5e-4, 3.5e-4), (0.02, 0.02)] {
        let scene = spots(40, full, none);
        for index in 0..scene.lights.emitters().len() {
            let below = Receiver { point: Vec3::new(4.0 * index as f32, 0.0, 0.0), normal: Some(Vec3::Z) };
            let p = scene.lights.probability(&below, index);
            assert!(p > 0.5, "{full} … {none} rad, spot {index}: {p}");
        }
    }
}

/// Every one of the 2²⁴ numbers that choose, counted.
#[test]
fn every_step_is_counted_once() {
    let scene = room(7, Kind::Mixed, 40, true);
    let receiver = Receiver { point: Vec3::new(1.0, 2.0, 0.0), normal: Some(Vec3::Z) };
    let mut counts = vec![0u32; scene.lights.emitters().len()];
    for step in 0..STEPS {
        if let Some((index, _)) = scene.lights.choose(&receiver, step as f32 / STEPS as f32) {
            counts[index] += 1;
        }
    }
    for (index, count) in counts.into_iter().enumerate() {
        assert_eq!(count as f32 / STEPS as f32, scene.lights.probability(&receiver, index), "{index}");
    }
}

/// Variance of one sample of the irradiance with given probabilities, over the square of the irradiance: from the first two moments
/// of each lamp's own samples.
struct Moments(Vec<[f64; 2]>);

impl Moments {
    fn at(scene: &Scene, receiver: &Receiver, random: &mut Random) -> Self {
        let normal = receiver.normal.unwrap_or(Vec3::Z);
        let mut of = |source: &Source| {
            let mut moments = [0.0; 2];
            let n = 64;
            for _ in 0..n {
                let value = match source {
                    Source::Shape { id, two_sided } => scene
                        .world
                        .shape(*id)
                        .and_then(|shape| shape.sample_toward(receiver.point, random.point()))
                        .filter(|toward| *two_sided || toward.normal.dot(toward.direction) < 0.0)
                        .map_or(0.0, |toward| f64::from(normal.dot(toward.direction).max(0.0) / toward.pdf)),
                    Source::Point(point) => point
                        .seen_from(receiver.point)
                        .map_or(0.0, |(direction, _, strength)| f64::from(normal.dot(direction).max(0.0) * strength)),
                    Source::Sun(_) | Source::Map => 0.0,
                };
                moments = [moments[0] + value / f64::from(n), moments[1] + value * value / f64::from(n)];
            }
            moments
        };
        // Radiance is 1 in these scenes; what a lamp is brighter, its power says.
        let brighter = |index: usize| {
            let emitter = &scene.lights.emitters()[index];
            let one = match emitter.source {
                Source::Shape { id, two_sided } => {
                    let area = scene.world.shape(id).map_or(0.0, |shape| f64::from(shape.area()));
                    area * if two_sided { 2.0 } else { 1.0 }
                }
                Source::Point(point) => point.solid_angle() / std::f64::consts::PI,
                Source::Sun(_) | Source::Map => 1.0,
            };
            emitter.power / one
        };
        let emitters = scene.lights.emitters().iter().enumerate();
        Self(
            emitters
                .map(|(i, emitter)| (of(&emitter.source), brighter(i)))
                .map(|([a, b], k)| [a * k, b * k * k])
                .collect(),
        )
    }

    fn variance(&self, probability: impl Fn(usize) -> f64) -> f64 {
        let irradiance: f64 = self.0.iter().map(|moments| moments[0]).sum();
        let second: f64 =
            self.0.iter().enumerate().map(|(i, m)| if m[1] > 0.0 { m[1] / probability(i) } else { 0.0 }).sum();
        if irradiance > 0.0 { second / (irradiance * irradiance) - 1.0 } else { 0.0 }
    }

    fn best(&self) -> f64 {
        let all: f64 = self.0.iter().map(|m| m[1].sqrt()).sum();
        self.variance(|i| self.0[i][1].sqrt() / all)
    }
}

/// Mean variances at places on the floor and, in the room, on surfaces that look anywhere: by power, by the tree, by the tree without
/// the receiver's normal, and the least that any choice reaches.
fn variances(kind: Kind, count: usize) -> [f64; 4] {
    let mut random = Random::new(11);
    let places = 300;
    let mut sums = [0.0; 4];
    for round in 0..places {
        let scene_seed = 20 + round / 30;
        let scene = room(scene_seed, kind, count, false);
        let receiver = match round % 2 {
            0 => Receiver { point: vector(&mut random, [-5.0, -5.0, 0.0], [5.0, 5.0, 0.0]), normal: Some(Vec3::Z) },
            _ => Receiver {
                point: vector(&mut random, [-5.0, -5.0, 0.0], [5.0, 5.0, 3.0]),
                normal: Some(direction(&mut random)),
            },
        };
        let moments = Moments::at(&scene, &receiver, &mut random);
        let emitters = scene.lights.emitters();
        let power: f64 = emitters.iter().map(|emitter| emitter.power).sum();
        let by_power = |i: usize| 0.25 / emitters.len() as f64 + 0.75 * emitters[i].power / power;
        let blind = Receiver { normal: None, ..receiver };
        let by = |receiver: &Receiver, i: usize| f64::from(scene.lights.probability(receiver, i));
        let found = [
            moments.variance(by_power),
            moments.variance(|i| by(&receiver, i)),
            moments.variance(|i| by(&blind, i)),
            moments.best(),
        ];
        sums = std::array::from_fn(|i| sums[i] + found[i] / places as f64);
    }
    sums
}

#[test]
fn the_tree_is_worth_its_price() {
    for kind in [Kind::Balls, Kind::Ceiling, Kind::Mixed] {
        for count in [FEW + 1, 8, 16, 64, 200, 1000] {
            let [power, tree, blind, best] = variances(kind, count);
            println!(
                "{kind:?} {count:>5}: power {power:7.2}  tree {tree:6.2}  without normal {blind:6.2}  best {best:6.2}"
            );
            assert!(3.0 * tree < power, "{kind:?} {count}");
        }
    }
}
