//! Rays and one large mesh, with mesh and rays in a file that a peer can read: `benches/peers/embree/compare.py` runs both.
//!
//! ```text
//! cargo bench --bench rays -- write FILE [ROWS]   a displaced ball of about 4 ROWS² triangles, and a million rays of each kind
//! cargo bench --bench rays -- time FILE HITS      processor time a ray; what was hit goes into HITS
//! cargo bench --bench rays -- build [ROWS]        how long it takes to build the ball, and how much memory
//! ```
//!
//! The file, little-endian: numbers of corners, triangles and rays of a kind (u32), corners (3 f32), triangles (3 u32), and for each of
//! [`KINDS`] its rays (origin, direction, farthest distance: 7 f32). Hits: for each ray of each kind a distance, −1 where nothing is
//! met, and a triangle (f32, u32); shadow rays tell 0 or −1 and no triangle.

use std::error::Error;
use std::hint::black_box;
use std::io::Write;
use std::sync::Arc;
use std::time::Instant;

use glam::{DVec3, Vec3};
use rustix::time::{ClockId, clock_gettime};
use spectrel::geometry::{Hit, Mesh, Placed, Ray, Side, Triangles, World};

const KINDS: [&str; 4] = ["camera", "diffuse", "random", "shadow"];
const SIDE: usize = 1000;
const RAYS: usize = SIDE * SIDE;
/// Each kind is timed so many times; the fastest counts.
const TURNS: usize = 3;
const LAMP: Vec3 = Vec3::new(2.0, -3.0, 4.0);

type Answer<T = ()> = Result<T, Box<dyn Error>>;

fn main() -> Answer {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| word != "--bench").collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    match words[..] {
        ["write", file] => write(file, 509),
        ["write", file, rows] => write(file, rows.parse()?),
        ["time", file, hits] => time(&Input::read(file)?, hits, ""),
        ["time", file, hits, kind] => time(&Input::read(file)?, hits, kind),
        ["build"] => build(509),
        ["build", rows] => build(rows.parse()?),
        _ => time(&Input::made(250)?, "/dev/null", ""),
    }
}

struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        let x = (self.0 ^ (self.0 >> 29)).wrapping_mul(0xbf58476d1ce4e5b9);
        (x >> 11) as f64 / (1u64 << 53) as f64
    }

    fn direction(&mut self) -> DVec3 {
        let (z, around) = (2.0 * self.unit() - 1.0, std::f64::consts::TAU * self.unit());
        let (sin, cos) = around.sin_cos();
        let r = (1.0 - z * z).sqrt();
        DVec3::new(r * cos, r * sin, z)
    }
}

/// A ball of radius 1 by latitude and longitude, moved in and out by waves, large and small.
fn ball(rows: u32) -> Triangles {
    let columns = 2 * rows;
    let place = |row: u32, column: u32| {
        let polar = std::f64::consts::PI * f64::from(row) / f64::from(rows);
        let around = std::f64::consts::TAU * f64::from(column) / f64::from(columns);
        let p = DVec3::new(polar.sin() * around.cos(), polar.sin() * around.sin(), polar.cos());
        let wave = |f: f64| (f * p.x + 1.0).sin() * (f * p.y).cos() + (f * p.z + p.x).sin();
        (p * (1.0 + 0.06 * wave(5.0) + 0.012 * wave(37.0) + 0.002 * wave(171.0))).as_vec3()
    };
    let mut mesh = Triangles { positions: vec![place(0, 0)], ..Triangles::default() };
    for row in 1..rows {
        mesh.positions.extend((0..columns).map(|column| place(row, column)));
    }
    mesh.positions.push(place(rows, 0));
    let last = mesh.positions.len() as u32 - 1;
    let at = |row: u32, column: u32| match row {
        0 => 0,
        row if row == rows => last,
        row => 1 + (row - 1) * columns + column % columns,
    };
    for row in 0..rows {
        for column in 0..columns {
            let [a, b, c, d] = [at(row, column), at(row + 1, column), at(row + 1, column + 1), at(row, column + 1)];
            mesh.indices.extend([[a, b, c], [a, c, d]].iter().filter(|t| t[0] != t[1] && t[1] != t[2] && t[2] != t[0]));
        }
    }
    mesh
}

/// A mesh and rays of each kind: origin, direction, farthest distance.
struct Input {
    mesh: Triangles,
    rays: [Vec<[f32; 7]>; 4],
}

fn ray(origin: Vec3, direction: Vec3, far: f32) -> [f32; 7] {
    let ([a, b, c], [x, y, z]) = (origin.to_array(), direction.to_array());
    [a, b, c, x, y, z, far]
}

fn taken(&[a, b, c, x, y, z, far]: &[f32; 7]) -> (Ray, f32) {
    (Ray::free(Vec3::new(a, b, c), Vec3::new(x, y, z)), far)
}

impl Input {
    fn made(rows: u32) -> Answer<Self> {
        let mesh = ball(rows);
        let world = world(mesh.clone())?;
        let mut random = Random(1);
        let camera: Vec<[f32; 7]> = (0..RAYS).map(|i| camera(&mut random, i)).collect();
        let hits: Vec<Hit> = camera.iter().filter_map(|words| world.closest(&taken(words).0, f32::INFINITY)).collect();
        let many = || hits.iter().cycle().take(RAYS);
        // Off the surface by as much as tells both sides that it is not met again.
        let above = |hit: &Hit| hit.point + hit.outward() * 1e-4;
        let diffuse = many().map(|hit| {
            let d = (hit.outward().as_dvec3() + random.direction() * 0.999999).normalize();
            ray(above(hit), d.as_vec3(), f32::INFINITY)
        });
        let diffuse = diffuse.collect();
        let shadow = many().map(|hit| {
            let to = LAMP - above(hit);
            ray(above(hit), to.normalize(), to.length())
        });
        let shadow = shadow.collect();
        let anywhere = (0..RAYS).map(|_| {
            let origin = DVec3::new(random.unit(), random.unit(), random.unit()) * 2.4 - 1.2;
            ray(origin.as_vec3(), random.direction().as_vec3(), f32::INFINITY)
        });
        let anywhere = anywhere.collect();
        Ok(Self { mesh, rays: [camera, diffuse, anywhere, shadow] })
    }

    fn read(file: &str) -> Answer<Self> {
        let bytes = std::fs::read(file)?;
        let mut words = bytes.as_chunks::<4>().0.iter().copied();
        let mut word = || words.next().ok_or("the file ends early");
        let [corners, triangles, rays] = [word()?, word()?, word()?].map(u32::from_le_bytes);
        let mut mesh = Triangles::default();
        for _ in 0..corners {
            mesh.positions.push(Vec3::from_array([word()?, word()?, word()?].map(f32::from_le_bytes)));
        }
        for _ in 0..triangles {
            mesh.indices.push([word()?, word()?, word()?].map(u32::from_le_bytes));
        }
        let mut kinds: [Vec<[f32; 7]>; 4] = Default::default();
        for kind in &mut kinds {
            for _ in 0..rays {
                kind.push([word()?, word()?, word()?, word()?, word()?, word()?, word()?].map(f32::from_le_bytes));
            }
        }
        Ok(Self { mesh, rays: kinds })
    }
}

/// Through a pixel of a square picture that the ball nearly fills.
fn camera(random: &mut Random, pixel: usize) -> [f32; 7] {
    let place = |at: usize, u: f64| 2.0 * (at as f64 + u) / SIDE as f64 - 1.0;
    let (x, y) = (place(pixel % SIDE, random.unit()), place(pixel / SIDE, random.unit()));
    let direction = DVec3::new(-2.7, 1.15 * x, -1.15 * y).normalize();
    ray(Vec3::X * 3.0, direction.as_vec3(), f32::INFINITY)
}

fn world(mesh: Triangles) -> Answer<World> {
    Ok(World::new(vec![Placed::new(Arc::new(Mesh::new(mesh)?)).into()])?)
}

fn write(file: &str, rows: u32) -> Answer {
    let Input { mesh, rays } = Input::made(rows)?;
    let mut out = std::io::BufWriter::new(std::fs::File::create(file)?);
    for count in [mesh.positions.len(), mesh.indices.len(), RAYS] {
        out.write_all(&u32::try_from(count)?.to_le_bytes())?;
    }
    for position in &mesh.positions {
        out.write_all(position.to_array().map(f32::to_le_bytes).as_flattened())?;
    }
    for triangle in &mesh.indices {
        out.write_all(triangle.map(u32::to_le_bytes).as_flattened())?;
    }
    for ray in rays.iter().flatten() {
        out.write_all(ray.map(f32::to_le_bytes).as_flattened())?;
    }
    Ok(out.flush()?)
}

/// Processor seconds of this thread, or of all.
fn seconds(clock: ClockId) -> f64 {
    let time = clock_gettime(clock);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}

fn fastest<T>(mut run: impl FnMut() -> T) -> f64 {
    let mut best = f64::INFINITY;
    for _ in 0..TURNS {
        let start = seconds(ClockId::ThreadCPUTime);
        black_box(run());
        best = best.min(seconds(ClockId::ThreadCPUTime) - start);
    }
    best
}

/// All kinds, or `only` one.
fn time(input: &Input, hits: &str, only: &str) -> Answer {
    let world = world(input.mesh.clone())?;
    let mut out = std::io::BufWriter::new(std::fs::File::create(hits)?);
    let mut found: Vec<(f32, u32)> = vec![(-1.0, 0); RAYS];
    for (kind, rays) in KINDS.iter().zip(&input.rays).filter(|(kind, _)| kind.contains(only)) {
        let rays: Vec<(Ray, f32)> = rays.iter().map(taken).collect();
        let best = fastest(|| {
            for (&(ref ray, far), found) in rays.iter().zip(&mut found) {
                *found = match *kind {
                    "shadow" => (f32::from(u8::from(world.occluded(ray, far, None))) - 1.0, 0),
                    _ => world.first(ray, &[], far).map_or((-1.0, 0), |met| (met.t, met.facet)),
                };
            }
        });
        println!("{kind} {:.1}", best / rays.len() as f64 * 1e9);
        if *kind != "shadow" {
            println!("{kind}+surface {:.1}", surfaces(&world, &rays));
        }
        for (t, facet) in &found {
            out.write_all(&t.to_le_bytes())?;
            out.write_all(&facet.to_le_bytes())?;
        }
    }
    if "leaving".contains(only) {
        println!("leaving {:.1}", leaving(&world, &input.rays[0]));
    }
    Ok(out.flush()?)
}

/// Rays with point and normals of what they meet.
fn surfaces(world: &World, rays: &[(Ray, f32)]) -> f64 {
    let best = fastest(|| {
        for (ray, far) in rays {
            black_box(world.closest(ray, *far));
        }
    });
    best / rays.len() as f64 * 1e9
}

/// Diffuse rays as the renderer asks for them: from the hit itself, by what it knows of its triangle.
fn leaving(world: &World, camera: &[[f32; 7]]) -> f64 {
    let mut random = Random(2);
    let hits = camera.iter().filter_map(|words| world.closest(&taken(words).0, f32::INFINITY));
    let rays: Vec<Ray> = hits
        .map(|hit| {
            let d = (hit.outward().as_dvec3() + random.direction() * 0.999999).normalize();
            Ray::leaving(&hit, Side::Outside, d.as_vec3())
        })
        .collect();
    let best =
        fastest(|| rays.iter().filter_map(|ray| world.closest(ray, f32::INFINITY)).map(|hit| hit.t).sum::<f32>());
    best / rays.len() as f64 * 1e9
}

fn build(rows: u32) -> Answer {
    let input = ball(rows);
    let count = input.indices.len() as f64;
    let before = memory()?;
    let (start, processors) = (Instant::now(), seconds(ClockId::ProcessCPUTime));
    let mesh = Mesh::new(input)?;
    let (took, processors) = (start.elapsed().as_secs_f64(), seconds(ClockId::ProcessCPUTime) - processors);
    let after = memory()?;
    println!("{count} triangles, closed: {}", mesh.is_closed());
    println!("build         {took:8.2} s on {} threads, {processors:.2} s of processor", rayon::current_num_threads());
    println!("input         {:8.1} bytes a triangle", before.resident / count);
    println!("resident after{:8.1} bytes a triangle, the process whole", after.resident / count);
    println!("peak          {:8.1} bytes a triangle, the process whole", after.peak / count);
    black_box(mesh);
    Ok(())
}

/// Bytes of this process.
struct Memory {
    resident: f64,
    peak: f64,
}

fn memory() -> Answer<Memory> {
    let status = std::fs::read_to_string("/proc/self/status")?;
    let field = |name: &str| -> Answer<f64> {
        let line = status.lines().find(|line| line.starts_with(name)).ok_or("no such field")?;
        Ok(line.split_ascii_whitespace().nth(1).ok_or("no number")?.parse::<f64>()? * 1024.0)
    };
    Ok(Memory { resident: field("VmRSS:")?, peak: field("VmHWM:")? })
}
