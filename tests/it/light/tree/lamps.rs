//! Many lamps of every kind, and where they are asked for.

use crate::statistics::Random;
use glam::{DVec3, Vec3};
use spectrel::geometry::{Convex, Disk, Rectangle, Shape, ShapeId, Sphere, World};
use spectrel::light::{Cone, Emitter, Environment, Lights, Point, Receiver, Source, Sun};
use spectrel::spectrum::{Arena, Spectrum};

pub struct Scene {
    pub world: World,
    pub lights: Lights,
}

pub fn vector(random: &mut Random, from: [f32; 3], to: [f32; 3]) -> Vec3 {
    Vec3::from_array(std::array::from_fn(|i| from[i] + (to[i] - from[i]) * random.unit()))
}

pub fn direction(random: &mut Random) -> Vec3 {
    loop {
        let v = vector(random, [-1.0; 3], [1.0; 3]);
        if (0.01..1.0).contains(&v.length_squared()) {
            return v.normalize();
        }
    }
}

/// Which lamps hang in a room of 10 × 10 × 3.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// Small balls.
    Balls,
    /// Small squares below the ceiling that shine down.
    Ceiling,
    /// Balls, disks, boxes and squares that look anywhere, one side or two; points and spots; powers over four decades.
    Mixed,
}

fn lamp(random: &mut Random, kind: Kind, index: usize) -> (Option<Shape>, bool) {
    let center = vector(random, [-5.0, -5.0, 0.5], [5.0, 5.0, 3.0]);
    let size = 0.02 + 0.08 * random.unit();
    let choice = if kind == Kind::Mixed { index % 6 } else { 0 };
    let flat = |normal: Vec3| {
        let (u, v) = normal.any_orthonormal_pair();
        Rectangle::new(center, u * size, v * size).expect("a square").into()
    };
    match (kind, choice) {
        (Kind::Balls, _) | (_, 1) => (Some(Sphere::new(center, size).expect("a ball").into()), false),
        (Kind::Ceiling, _) => {
            let center = Vec3::new(center.x, center.y, 3.0);
            (Some(Rectangle::new(center, Vec3::Y * size, Vec3::X * size).expect("a square").into()), false)
        }
        (_, 0) => (Some(flat(direction(random))), false),
        (_, 2) => (Some(flat(direction(random))), true),
        (_, 3) => (Some(Disk::facing(center, direction(random), size).expect("a disk").into()), false),
        (_, 4) => (Some(Convex::cuboid(center, Vec3::splat(size)).expect("a box").into()), false),
        _ => (None, false),
    }
}

/// So many lamps; with `far`, also a sun, and two lamps without power.
pub fn room(seed: u64, kind: Kind, count: usize, far: bool) -> Scene {
    let mut random = Random::new(seed);
    let radiance = Arena::default().add(Spectrum::Constant(1.0));
    let (mut shapes, mut emitters) = (Vec::new(), Vec::new());
    for index in 0..count {
        let (shape, two_sided) = lamp(&mut random, kind, index);
        let luminance = if kind == Kind::Mixed { 10f64.powf(4.0 * f64::from(random.unit())) } else { 1.0 };
        let Some(shape) = shape else {
            // Some fade, some have a sharp edge.
            let edge = if index % 12 < 3 { 0.4 } else { 0.7 };
            let cone =
                (index % 12 < 6).then(|| Cone::new(direction(&mut random).as_dvec3(), 0.4, edge).expect("a cone"));
            let light = Point::new(vector(&mut random, [-5.0, -5.0, 0.5], [5.0, 5.0, 3.0]), 1.0, cone);
            let power = 0.01 * luminance * light.solid_angle() / std::f64::consts::PI;
            emitters.push(Emitter { source: Source::Point(light), radiance, power });
            continue;
        };
        let power = luminance * f64::from(shape.area()) * if two_sided { 2.0 } else { 1.0 };
        let source = Source::Shape { id: ShapeId(shapes.len() as u32), two_sided };
        emitters.push(Emitter { source, radiance, power });
        shapes.push(shape);
    }
    if far {
        let power = emitters.iter().map(|emitter| emitter.power).sum::<f64>() * 0.3;
        emitters[count / 2].power = 0.0;
        emitters[count / 3].power = 0.0;
        let sun = Sun::new(DVec3::new(1.0, 0.0, 2.0).as_vec3(), 0.01).expect("a sun");
        emitters.insert(0, Emitter { source: Source::Sun(sun), radiance, power });
    }
    let world = World::new(shapes).expect("a world");
    Scene { lights: Lights::new(emitters, Environment::Dark, &world), world }
}

/// A row of spots that shine straight down from a height of 3, apart by 4.
pub fn spots(count: usize, full: f64, none: f64) -> Scene {
    let radiance = Arena::default().add(Spectrum::Constant(1.0));
    let spot = |index: usize| {
        let cone = Cone::new(-DVec3::Z, full, none).expect("a cone");
        let light = Point::new(Vec3::new(4.0 * index as f32, 0.0, 3.0), 1.0, Some(cone));
        Emitter { source: Source::Point(light), radiance, power: light.solid_angle() / std::f64::consts::PI }
    };
    let world = World::new(Vec::new()).expect("a world");
    Scene { lights: Lights::new((0..count).map(spot).collect(), Environment::Dark, &world), world }
}

/// Places in the room and on its floor, some right at lamps, some far away.
pub fn receivers(random: &mut Random, count: usize) -> Vec<Receiver> {
    let place = |index: usize| {
        let point = match index % 4 {
            0 => vector(random, [-5.0, -5.0, 0.0], [5.0, 5.0, 0.0]),
            3 if index % 8 == 3 => vector(random, [-500.0; 3], [500.0; 3]),
            _ => vector(random, [-5.0, -5.0, 0.0], [5.0, 5.0, 3.0]),
        };
        let normal = match index % 4 {
            0 => Some(Vec3::Z),
            1 => None,
            _ => Some(direction(random)),
        };
        Receiver { point, normal }
    };
    (0..count).map(place).collect()
}
