//! Clear bodies from the parts of mesh files: what becomes one medium is joined before anyone asks
//! whether it is closed.
//!
//! A file may cut a solid into groups, materials or primitives. Those of one clear material that
//! have open edges in common are one body; where opaque parts close it, their triangles are a part
//! of its boundary, too, on which they lie in optical contact.

use super::Resolver;
use super::meshes::Loaded;
use super::objects::Piece;
use crate::geometry::mend::HAIR;
use crate::geometry::{GeometryError, Mended, Mesh, Placed, Rim, Shape, Surroundings, Triangles};
use crate::scene::SceneError;
use crate::scene::describe;
use glam::Affine3A;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// Parts of a file that become one body.
pub struct Body {
    /// Indices into the pieces that stand at one place.
    members: Vec<usize>,
    mesh: Arc<Mesh>,
    mended: Mended,
}

/// By file, gap that is closed (its bits) and the parts at one place with their surfaces.
pub type Bodies = BTreeMap<(usize, u64, Vec<(usize, u32)>), Arc<Vec<Body>>>;

/// Where a piece of a mesh file comes from.
#[derive(Clone, Copy)]
pub struct Origin {
    /// Index into the parts of the file.
    pub part: usize,
    /// From there to where the piece stands.
    pub affine: Affine3A,
}

/// Joined triangles that are no body yet.
struct Open {
    members: Vec<usize>,
    surface: u32,
    mesh: Triangles,
    mended: Mended,
}

impl Resolver<'_> {
    /// The pieces that an object shows of its file, the clear ones as bodies.
    pub fn bodies(
        &mut self,
        object: &describe::Object,
        file: &describe::MeshFile,
        name: &str,
        pieces: Vec<Piece>,
    ) -> Result<Vec<Piece>, SceneError> {
        if !pieces.iter().any(|piece| self.is_clear(piece.surface)) {
            return Ok(pieces);
        }
        let loaded = self.mesh_file(file)?;
        let mut places: BTreeMap<[u32; 12], Vec<usize>> = BTreeMap::new();
        for (index, piece) in pieces.iter().enumerate() {
            let Some(origin) = piece.origin else { continue };
            places.entry(origin.affine.to_cols_array().map(f32::to_bits)).or_default().push(index);
        }
        let mut pieces: Vec<Option<Piece>> = pieces.into_iter().map(Some).collect();
        for place in places.into_values() {
            let there: Vec<Piece> = place.iter().filter_map(|&index| pieces[index].clone()).collect();
            let bodies = self.bodies_of(object, file, &loaded, &there)?;
            for body in bodies.iter() {
                let kept = place[body.members[0]];
                let joined = self.embodied(object, &there, body)?;
                body.members.iter().for_each(|&member| pieces[place[member]] = None);
                pieces[kept] = Some(joined);
            }
        }
        let mut pieces: Vec<Piece> = pieces.into_iter().flatten().collect();
        if let [alone] = pieces.as_mut_slice() {
            alone.name = name.to_owned();
        }
        Ok(pieces)
    }

    fn is_clear(&self, surface: u32) -> bool {
        self.surfaces[surface as usize].is_clear()
    }

    /// A body in place of its pieces.
    fn embodied(&self, object: &describe::Object, pieces: &[Piece], body: &Body) -> Result<Piece, SceneError> {
        let first = &pieces[body.members[0]];
        let there = Placed::new(body.mesh.clone());
        let shape = match first.origin {
            Some(origin) if origin.affine != Affine3A::IDENTITY => there.transformed(&origin.affine),
            _ => Ok(there),
        };
        let shape: Shape = shape.map_err(|error| self.text.error(&object.shape.span(), error))?.into();
        Ok(Piece { name: named(pieces, &body.members), shape, ..first.clone() })
    }

    /// The bodies of pieces that stand at one place, made once for all places.
    fn bodies_of(
        &mut self,
        object: &describe::Object,
        file: &describe::MeshFile,
        loaded: &Arc<Loaded>,
        pieces: &[Piece],
    ) -> Result<Arc<Vec<Body>>, SceneError> {
        let gap = self.gap(file)?;
        let parts = pieces.iter().map(|piece| (piece.origin.map_or(0, |origin| origin.part), piece.surface)).collect();
        let key = (Arc::as_ptr(loaded) as usize, gap.to_bits(), parts);
        if let Some(known) = self.bodies.get(&key) {
            return Ok(known.clone());
        }
        let crease = file.crease_angle.as_ref().map(|angle| *angle.get_ref());
        let workshop = Workshop { pieces, gap, crease };
        let bodies = workshop.bodies(|surface| self.is_clear(surface));
        let bodies = bodies.map_err(|refused| match refused {
            Refused::Media(members) => self.two_media(object, pieces, members),
            Refused::Mesh(error) => self.text.error(&object.shape.span(), error),
        })?;
        for body in &bodies {
            self.tell(&named(pieces, &body.members), body);
        }
        let bodies = Arc::new(bodies);
        self.bodies.insert(key, bodies.clone());
        Ok(bodies)
    }

    /// The widest gap that is closed, as a share of a mesh's size.
    fn gap(&self, file: &describe::MeshFile) -> Result<f64, SceneError> {
        let Some(weld) = &file.weld else { return Ok(HAIR) };
        match *weld.get_ref() {
            share if (0.0..=0.1).contains(&share) => Ok(share),
            share => {
                let message = format!("`weld` is {share}: it is a share of the mesh's size, 0 … 0.1");
                Err(self.text.error(&weld.span(), message))
            }
        }
    }

    fn two_media(&self, object: &describe::Object, pieces: &[Piece], [a, b]: [usize; 2]) -> SceneError {
        let [a, b] = [a, b].map(|member| &pieces[member]);
        let message = format!(
            "`{}` and `{}` are faces of one closed body, but of two clear materials, `{}` and `{}`: a body is of one",
            a.name, b.name, a.material, b.material
        );
        let help =
            "give both the same material (`[replace]` names one for each of the file's), or make two closed bodies";
        self.text.error(&object.shape.span(), message).help(help)
    }

    /// What was done to a body, and what is still wrong.
    fn tell(&mut self, name: &str, body: &Body) {
        let Mended { repeated, turned, welded } = body.mended;
        let triangles = |count: usize| match count {
            1 => "1 triangle".to_owned(),
            _ => format!("{count} triangles"),
        };
        if repeated > 0 {
            let triangles = triangles(repeated);
            self.warnings.push(format!(
                "`{name}` has {triangles} twice, as two-sided exports do: a clear solid has each face once, the second ones were dropped"
            ));
        }
        if turned > 0 {
            let triangles = triangles(turned);
            self.warnings
                .push(format!("`{name}` has {triangles} wound the other way than the rest: they were turned round"));
        }
        if let Some((corners, far)) = welded {
            self.warnings.push(format!(
                "`{name}` had gaps: {corners} corners of open edges, up to {far:.1e} units of the file from others, were put there, which closes it; \
                 `weld = 0` leaves them"
            ));
        }
        self.warn_of_openings(name, body.mesh.surroundings());
    }
}

/// Names of pieces, as the name of what they become.
fn named(pieces: &[Piece], members: &[usize]) -> String {
    const SHOWN: usize = 3;
    let mut names: Vec<&str> = members.iter().map(|&member| pieces[member].name.as_str()).collect();
    names.dedup();
    match names.len().saturating_sub(SHOWN) {
        0 => names.join(" + "),
        more => format!("{} + {more} more", names[..SHOWN].join(" + ")),
    }
}

/// Why pieces cannot become bodies.
enum Refused {
    /// Two of them, of different media, close one body.
    Media([usize; 2]),
    Mesh(GeometryError),
}

/// Pieces that stand at one place, on their way to become bodies.
struct Workshop<'a> {
    pieces: &'a [Piece],
    gap: f64,
    crease: Option<f64>,
}

impl Workshop<'_> {
    fn mesh(&self, piece: usize) -> Option<&Arc<Mesh>> {
        match &self.pieces[piece].shape {
            Shape::Mesh(placed) => Some(placed.mesh()),
            _ => None,
        }
    }

    fn bodies(&self, clear: impl Fn(u32) -> bool) -> Result<Vec<Body>, Refused> {
        let is_solid = |piece: usize| self.mesh(piece).is_some_and(|mesh| mesh.surroundings().is_solid());
        let is_clear = |piece: usize| clear(self.pieces[piece].surface);
        let (whole, lacking): (Vec<usize>, Vec<usize>) =
            (0..self.pieces.len()).filter(|&piece| is_clear(piece)).partition(|&piece| is_solid(piece));
        let mut bodies = whole.iter().map(|&piece| self.whole(piece)).collect::<Result<Vec<_>, _>>()?;
        if !lacking.is_empty() {
            let opaque = (0..self.pieces.len()).filter(|&piece| !is_clear(piece) && !is_solid(piece));
            bodies.extend(self.joined_bodies(&lacking, &opaque.collect::<Vec<_>>())?);
        }
        Ok(bodies)
    }

    /// A piece that is a body by itself.
    fn whole(&self, piece: usize) -> Result<Body, Refused> {
        let open = self.join(&[piece], self.pieces[piece].surface);
        self.body(open)
    }

    /// Bodies of clear pieces that are not closed each by itself, with opaque ones that may be a
    /// part of their boundary.
    fn joined_bodies(&self, lacking: &[usize], opaque: &[usize]) -> Result<Vec<Body>, Refused> {
        if let ([piece], []) = (lacking, opaque) {
            return Ok(vec![self.whole(*piece)?]);
        }
        let all: Vec<usize> = lacking.iter().chain(opaque).copied().collect();
        let rims: BTreeMap<usize, Rim> = all.iter().map(|&piece| (piece, Rim::of(&self.triangles(&[piece])))).collect();
        let sets = |of: &[usize]| -> Vec<Vec<usize>> {
            let first = Rim::sets(&of.iter().map(|piece| &rims[piece]).collect::<Vec<_>>());
            let mut sets: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
            of.iter().zip(first).for_each(|(&piece, first)| sets.entry(first).or_default().push(piece));
            sets.into_values().collect()
        };
        let surfaces: BTreeSet<u32> = lacking.iter().map(|&piece| self.pieces[piece].surface).collect();
        let of_surface = |surface: u32| {
            lacking.iter().copied().filter(move |&piece| self.pieces[piece].surface == surface).collect::<Vec<_>>()
        };
        let (mut done, mut open): (Vec<Open>, Vec<Open>) = surfaces
            .iter()
            .flat_map(|&surface| sets(&of_surface(surface)).into_iter().map(move |set| (set, surface)))
            .map(|(set, surface)| self.join(&set, surface))
            .partition(Open::is_solid);
        let places: Vec<Vec<usize>> = sets(&all);
        let set_of: BTreeMap<usize, usize> =
            places.iter().enumerate().flat_map(|(set, pieces)| pieces.iter().map(move |&piece| (piece, set))).collect();
        let mut inside: Vec<Vec<Open>> = places.iter().map(|_| Vec::new()).collect();
        open.drain(..).for_each(|part| inside[set_of[&part.members[0]]].push(part));
        for (inside, set) in inside.into_iter().zip(&places) {
            self.refuse_two_media(&inside)?;
            let opaque: Vec<usize> = set.iter().copied().filter(|piece| opaque.contains(piece)).collect();
            for alike in of_each_surface(inside) {
                match self.close(&alike, &opaque) {
                    Some(body) => done.push(body),
                    None => open.extend(alike),
                }
            }
        }
        // What is left of a medium may lack no more than a hair between its parts.
        for alike in of_each_surface(open) {
            match self.close(&alike, &[]) {
                Some(body) => done.push(body),
                None => done.extend(alike),
            }
        }
        done.into_iter().map(|open| self.body(open)).collect()
    }

    /// Clear pieces of several media that close one body without anything opaque.
    fn refuse_two_media(&self, open: &[Open]) -> Result<(), Refused> {
        let [first, rest @ ..] = open else { return Ok(()) };
        let Some(other) = rest.iter().find(|open| open.surface != first.surface) else { return Ok(()) };
        match self.join(&members(open), first.surface).is_solid() {
            true => Err(Refused::Media([first.members[0], other.members[0]])),
            false => Ok(()),
        }
    }

    /// The one body that open pieces of one medium become together, with opaque ones if these close it.
    fn close(&self, open: &[Open], opaque: &[usize]) -> Option<Open> {
        let (first, members) = (open.first()?, members(open));
        let with =
            |opaque: &[usize]| Some(self.join(&[&members, opaque].concat(), first.surface)).filter(Open::is_solid);
        let alone = (open.len() > 1).then(|| with(&[])).flatten();
        let joined = alone.or_else(|| (!opaque.is_empty()).then(|| with(opaque)).flatten())?;
        Some(Open { members, ..joined })
    }

    fn triangles(&self, pieces: &[usize]) -> Triangles {
        Triangles::joined(pieces.iter().filter_map(|&piece| Some(self.mesh(piece)?.triangles())))
    }

    fn join(&self, members: &[usize], surface: u32) -> Open {
        let (mesh, mended) = self.triangles(members).mended(self.gap);
        Open { members: members.to_vec(), surface, mesh, mended }
    }

    /// Ready for rays; what was left as it is shares the mesh of its file.
    fn body(&self, open: Open) -> Result<Body, Refused> {
        let Open { members, mesh, mended, .. } = open;
        let own = self.mesh(members[0]).filter(|own| own.triangles().indices.len() == mesh.indices.len());
        let mesh = match own {
            Some(own) if mended.is_nothing() => own.clone(),
            _ => {
                let mesh = match self.crease {
                    Some(degrees) => mesh.smoothed(degrees),
                    None => mesh,
                };
                Arc::new(Mesh::new(mesh).map_err(Refused::Mesh)?)
            }
        };
        Ok(Body { members, mesh, mended })
    }
}

/// All pieces of open parts, in their order.
fn members(open: &[Open]) -> Vec<usize> {
    let mut members: Vec<usize> = open.iter().flat_map(|open| open.members.iter().copied()).collect();
    members.sort_unstable();
    members
}

fn of_each_surface(open: Vec<Open>) -> impl Iterator<Item = Vec<Open>> {
    let mut alike: BTreeMap<u32, Vec<Open>> = BTreeMap::new();
    open.into_iter().for_each(|open| alike.entry(open.surface).or_default().push(open));
    alike.into_values()
}

impl Open {
    fn is_solid(&self) -> bool {
        Surroundings::of(&self.mesh).is_solid()
    }
}
