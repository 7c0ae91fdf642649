//! Clear bodies out of what programs export: parts joined, faces that are there twice dropped,
//! windings made to agree, hairline gaps closed.
//!
//! A dielectric needs an inside, and files lose theirs in few ways: a solid is cut into groups,
//! every face is written a second time from behind, some faces are wound the other way, or the rims
//! of parts differ by a rounding. Each step is tried only on triangles that do not enclose a volume
//! yet, and what closes them is kept:
//!
//! - `rim`: the edges at which a part is open, by which parts are known to belong together
//! - `sheets`: fronts and backs of surfaces that are there twice
//! - `patches`: windings, followed from triangle to triangle
//! - `gaps`: corners of open edges that are a hair apart

mod gaps;
mod patches;
mod rim;
mod sheets;

pub use rim::Rim;

use std::collections::HashSet;

use glam::Vec3;

use super::Triangles;
use super::mesh::{Surroundings, weld};

/// Gaps up to this share of the size of a mesh are closed unless a scene says otherwise.
pub const HAIR: f64 = 1e-4;

/// What was done to a mesh, to be told.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mended {
    /// Triangles that were there already, forwards or backwards.
    pub repeated: usize,
    /// Triangles that were turned round.
    pub turned: usize,
    /// Corners that were moved, and how far at most.
    pub welded: Option<(usize, f32)>,
}

impl Mended {
    pub fn is_nothing(&self) -> bool {
        *self == Self::default()
    }
}

/// A mesh and what was done to it.
#[derive(Clone)]
struct Attempt {
    mesh: Triangles,
    found: Surroundings,
    mended: Mended,
}

impl Triangles {
    /// Several meshes as one. Normals that a part lacks are those of its triangles; texture
    /// coordinates are 0.
    pub fn joined<'a>(parts: impl IntoIterator<Item = &'a Triangles>) -> Triangles {
        let parts: Vec<&Triangles> = parts.into_iter().collect();
        let smooth = parts.iter().any(|part| !part.normals.is_empty());
        let textured = parts.iter().any(|part| !part.uvs.is_empty());
        let mut all = Triangles::default();
        for part in parts {
            let faceted;
            let part = if smooth && part.normals.is_empty() {
                faceted = part.with_own_normals();
                &faceted
            } else {
                part
            };
            let first = all.positions.len() as u32;
            all.positions.extend(&part.positions);
            all.normals.extend(&part.normals);
            all.uvs.extend(&part.uvs);
            if textured {
                all.uvs.resize(all.positions.len(), glam::Vec2::ZERO);
            }
            all.indices.extend(part.indices.iter().map(|corners| corners.map(|corner| corner + first)));
        }
        all
    }

    /// The same triangles, each with corners of its own that have its normal.
    fn with_own_normals(&self) -> Triangles {
        let mut own = Triangles::default();
        for corners in &self.indices {
            let [a, b, c] = corners.map(|corner| self.positions[corner as usize]);
            let normal = (b - a).as_dvec3().cross((c - a).as_dvec3()).normalize_or_zero().as_vec3();
            let first = own.positions.len() as u32;
            own.positions.extend([a, b, c]);
            own.normals.extend([normal; 3]);
            own.uvs.extend(corners.iter().filter_map(|&corner| self.uvs.get(corner as usize)));
            own.indices.push([first, first + 1, first + 2]);
        }
        own
    }

    /// The body that these triangles mean, as far as it can be told, with gaps of up to a share of
    /// its size closed. All indices must name corners.
    pub fn mended(self, gap: f64) -> (Triangles, Mended) {
        let first = Attempt::of(self, Mended::default());
        if first.found.is_solid() {
            return first.outwards().parts();
        }
        let once = first.front().or_else(|| first.facing()).unwrap_or_else(|| first.without_repeats().agreeing());
        let agreeing = first.agreeing();
        let best = if agreeing.found.is_solid() || agreeing.openness() <= once.openness() { agreeing } else { once };
        if best.found.is_solid() {
            return best.outwards().parts();
        }
        best.closed(gap).map_or(best, Attempt::outwards).parts()
    }
}

impl Attempt {
    fn of(mesh: Triangles, mended: Mended) -> Self {
        Self { found: Surroundings::of(&mesh), mesh, mended }
    }

    fn parts(self) -> (Triangles, Mended) {
        (self.mesh, self.mended)
    }

    /// Open edges; what is closed around nothing has no inside at all.
    fn openness(&self) -> usize {
        match self.found.is_closed() && !self.found.is_solid() {
            true => usize::MAX,
            false => self.found.open_edges,
        }
    }

    /// Each triangle once, however it is wound.
    fn without_repeats(&self) -> Self {
        let mut mesh = self.mesh.clone();
        drop_repeats(&mut mesh);
        let repeated = self.mesh.indices.len() - mesh.indices.len();
        Self::of(mesh, Mended { repeated: self.mended.repeated + repeated, ..self.mended.clone() })
    }

    /// One side of what is closed around nothing, if that makes a body.
    fn front(&self) -> Option<Self> {
        let mesh = self.found.is_closed().then(|| sheets::fronts(&self.mesh)).flatten()?;
        let repeated = self.mesh.indices.len() - mesh.indices.len();
        let front = Self::of(mesh, Mended { repeated: self.mended.repeated + repeated, ..self.mended.clone() });
        front.found.is_solid().then_some(front)
    }

    /// Bodies beside each other that all face outwards, where some that face inwards left nothing of the volume: a stone and its mirror
    /// image.
    fn facing(&self) -> Option<Self> {
        if !self.found.is_closed() {
            return None;
        }
        let mut mesh = self.mesh.clone();
        let turned = patches::face_outwards(&mut mesh, 1.0);
        let facing = Self::of(mesh, Mended { turned: self.mended.turned + turned, ..self.mended.clone() });
        facing.found.is_solid().then_some(facing)
    }

    /// Neighbours wound alike.
    fn agreeing(&self) -> Self {
        let mut mesh = self.mesh.clone();
        match patches::agree(&mut mesh) {
            0 => self.clone(),
            turned => Self::of(mesh, Mended { turned: self.mended.turned + turned, ..self.mended.clone() }),
        }
    }

    /// Bodies beside each other that all face outwards.
    fn outwards(mut self) -> Self {
        let turned = patches::face_outwards(&mut self.mesh, self.found.volume);
        match turned {
            0 => self,
            turned => Self::of(self.mesh, Mended { turned: self.mended.turned + turned, ..self.mended }),
        }
    }

    /// With the corners of its open edges welded, by the smallest distance that closes it.
    fn closed(&self, gap: f64) -> Option<Self> {
        gaps::distances(&self.mesh, gap).into_iter().find_map(|distance| {
            let mut mesh = self.mesh.clone();
            let welded = gaps::weld_rims(&mut mesh, distance)?;
            drop_repeats(&mut mesh);
            let attempt = Self::of(mesh, Mended { welded: Some(welded), ..self.mended.clone() }).agreeing();
            attempt.found.is_solid().then_some(attempt)
        })
    }
}

fn drop_repeats(mesh: &mut Triangles) {
    let mut seen = HashSet::with_capacity(mesh.indices.len());
    let welded = weld(&mesh.positions);
    mesh.indices.retain(|corners| seen.insert(whichever_way(corners, &welded)));
}

/// The corners of a triangle in an order that does not depend on its winding.
fn whichever_way(corners: &[u32; 3], welded: &[u32]) -> [u32; 3] {
    let mut corners = corners.map(|corner| welded[corner as usize]);
    corners.sort_unstable();
    corners
}

/// A triangle the other way round. Normals that went with its old winding are turned, at corners of
/// its own.
fn turn(mesh: &mut Triangles, triangle: usize) {
    let corners = mesh.indices[triangle];
    mesh.indices[triangle].swap(1, 2);
    if mesh.normals.is_empty() {
        return;
    }
    let [a, b, c]: [Vec3; 3] = corners.map(|corner| mesh.positions[corner as usize]);
    let face = (b - a).as_dvec3().cross((c - a).as_dvec3());
    if corners.iter().any(|&corner| mesh.normals[corner as usize].as_dvec3().dot(face) <= 0.0) {
        return;
    }
    let [x, y, z] = mesh.indices[triangle];
    let first = mesh.positions.len() as u32;
    for corner in [x, y, z].map(|corner| corner as usize) {
        mesh.positions.push(mesh.positions[corner]);
        mesh.normals.push(-mesh.normals[corner]);
        if !mesh.uvs.is_empty() {
            mesh.uvs.push(mesh.uvs[corner]);
        }
    }
    mesh.indices[triangle] = [first, first + 1, first + 2];
}

#[cfg(test)]
mod tests;
