//! PLY, the Stanford polygon format: text, or bytes of either order.
//!
//! Source: G. Turk, "The PLY polygon file format" (Stanford, 1994). Of `vertex` the properties x, y, z, then nx, ny, nz
//! and u, v (also s, t or texture_u, texture_v) are read; of `face` the list vertex_indices or vertex_index, counted
//! from 0; of `tristrips` the same, where −1 begins a new strip. Other elements and properties are passed over. The file
//! is one part, without a material.

mod body;
mod header;

use glam::{Vec2, Vec3};

use super::error::Fault;
use super::gather::{Gathered, count, position};
use super::polygon::Polygons;
use super::text::{decoded, text};
use super::{MeshFile, Part, Triangles};
use body::{Binary, Body, Text};
use header::{Element, Encoding, Header};

pub(super) fn read(bytes: &[u8], stem: &str) -> Result<MeshFile, Fault> {
    let bytes = &*decoded(bytes);
    let header = Header::parse(bytes)?;
    let layout = Layout::of(&header)?;
    match header.encoding {
        Encoding::Ascii => {
            let text = text(bytes.get(header.bytes..).unwrap_or_default());
            read_body(Text::new(&text, header.lines), &header, &layout, stem)
        }
        encoding => read_body(Binary::new(bytes, header.bytes, encoding), &header, &layout, stem),
    }
}

/// What is taken of a vertex, by slot.
const NAMES: [&[&str]; 8] = [
    &["x"],
    &["y"],
    &["z"],
    &["nx"],
    &["ny"],
    &["nz"],
    &["u", "s", "texture_u", "texture_s"],
    &["v", "t", "texture_v", "texture_t"],
];
/// A ninth slot takes what is passed over.
const PASSED: usize = NAMES.len();

/// Which properties go where.
struct Layout {
    /// The slot of each property of a vertex.
    slots: Vec<usize>,
    has_normals: bool,
    has_uvs: bool,
    vertices: usize,
    /// Which property of a face is its list of vertices, and which of a set of strips.
    list: Option<usize>,
    strips: Option<usize>,
}

impl Layout {
    /// Returns the vertex that a list names, or how it is wrong.
    fn corner(&self, vertex: f64) -> Result<u32, String> {
        match vertex >= 0.0 && vertex < self.vertices as f64 && vertex <= u32::MAX.into() {
            true => Ok(vertex as u32),
            false => Err(format!("names vertex {vertex}, but the file has {} (counted from 0)", self.vertices)),
        }
    }

    fn of(header: &Header) -> Result<Self, Fault> {
        let absent = |name: &str| Fault::new(format!("the header has no element `{name}`"));
        let vertex = header.element("vertex").ok_or_else(|| absent("vertex"))?;
        let slot = |name: &str| NAMES.iter().position(|names| names.contains(&name)).unwrap_or(PASSED);
        let slots: Vec<usize> = vertex
            .properties
            .iter()
            .map(|property| if property.length.is_some() { PASSED } else { slot(&property.name) })
            .collect();
        let has = |wanted: &[usize]| wanted.iter().all(|slot| slots.contains(slot));
        if !has(&[0, 1, 2]) {
            let message = "the element `vertex` lacks one of the properties `x`, `y`, `z`";
            return Err(Fault::at_line(vertex.line, message));
        }
        let [list, strips] =
            [header.element("face"), header.element("tristrips")].map(|element| element.map(list_of).transpose());
        let (list, strips) = (list?, strips?);
        if list.is_none() && strips.is_none() {
            return Err(absent("face"));
        }
        let (has_normals, has_uvs) = (has(&[3, 4, 5]), has(&[6, 7]));
        Ok(Self { slots, has_normals, has_uvs, vertices: vertex.count, list, strips })
    }
}

/// Which property of an element is its list of vertices.
fn list_of(element: &Element) -> Result<usize, Fault> {
    let fault = |message: String| Fault::at_line(element.line, message);
    let is_list = |name: &str| matches!(name, "vertex_indices" | "vertex_index");
    let name = &element.name;
    let list = element.properties.iter().position(|property| is_list(&property.name) && property.length.is_some());
    let Some(list) = list else {
        return Err(fault(format!("the element `{name}` has no list `vertex_indices` or `vertex_index`")));
    };
    if element.properties.get(list).is_some_and(|property| !property.value.is_integer()) {
        return Err(fault(format!("the vertices of a {name} are not of an integer type")));
    }
    Ok(list)
}

fn read_body(mut body: impl Body, header: &Header, layout: &Layout, stem: &str) -> Result<MeshFile, Fault> {
    let mut gathered = Gathered::default();
    let mut triangles = Triangles::default();
    let mut faces = Polygons::default();
    let mut strips = Vec::new();
    for element in &header.elements {
        match element.name.as_str() {
            "vertex" => read_vertices(&mut body, element, layout, &mut triangles)?,
            "face" => {
                let thin = read_faces(&mut body, element, layout, &mut faces)?;
                if thin > 0 {
                    gathered.note(format!("{} of fewer than 3 vertices skipped", count(thin, "face")));
                }
            }
            "tristrips" => read_strips(&mut body, element, layout, &mut strips)?,
            _ => pass_over(&mut body, element)?,
        }
    }
    if let Some(note) = body.epilogue() {
        gathered.note(note);
    }
    triangles.indices = faces.triangles(&triangles.positions);
    triangles.indices.extend(strips);
    gathered.add(Part { name: stem.to_owned(), material: None, triangles });
    gathered.finish_in_place()
}

fn read_vertices(
    body: &mut impl Body,
    element: &Element,
    layout: &Layout,
    triangles: &mut Triangles,
) -> Result<(), Fault> {
    // However many the header promises, each of their numbers takes a byte.
    let room = element.count.min(body.left() / element.properties.len().max(1));
    triangles.positions.reserve(room);
    triangles.normals.reserve(if layout.has_normals { room } else { 0 });
    triangles.uvs.reserve(if layout.has_uvs { room } else { 0 });
    for row in 0..element.count {
        body.begin_row(element, row)?;
        let mut values = [0.0; PASSED + 1];
        for (property, &slot) in element.properties.iter().zip(&layout.slots) {
            let value = match property.length {
                None => body.number(property.value)?,
                Some(_) => pass_list(body, property)?,
            };
            if let Some(place) = values.get_mut(slot) {
                *place = value;
            }
        }
        body.end_row()?;
        let [x, y, z, nx, ny, nz, u, v, _] = values;
        triangles.positions.push(position(x, y, z).map_err(|message| body.fault(message))?);
        if layout.has_normals {
            triangles.normals.push(Vec3::new(nx as f32, ny as f32, nz as f32));
        }
        if layout.has_uvs {
            triangles.uvs.push(Vec2::new(u as f32, v as f32));
        }
    }
    Ok(())
}

/// The faces, and how many were skipped.
fn read_faces(body: &mut impl Body, element: &Element, layout: &Layout, faces: &mut Polygons) -> Result<usize, Fault> {
    let room = element.count.min(body.left() / element.properties.len().max(1));
    faces.sizes.reserve(room);
    faces.corners.reserve(room.saturating_mul(3).min(body.left()));
    let mut thin = 0;
    for row in 0..element.count {
        body.begin_row(element, row)?;
        for (place, property) in element.properties.iter().enumerate() {
            match property.length {
                None => {
                    body.number(property.value)?;
                }
                Some(length) if Some(place) == layout.list => {
                    let size = list_length(body, length)?;
                    for _ in 0..size {
                        let vertex = body.number(property.value)?;
                        faces
                            .corners
                            .push(layout.corner(vertex).map_err(|wrong| body.fault(format!("face {row} {wrong}")))?);
                    }
                    if size < 3 {
                        faces.corners.truncate(faces.corners.len().saturating_sub(size as usize));
                        thin += 1;
                    } else {
                        faces.sizes.push(size);
                    }
                }
                Some(_) => {
                    pass_list(body, property)?;
                }
            }
        }
        body.end_row()?;
    }
    Ok(thin)
}

/// The triangles of strips, each of which shares an edge with the one before and turns the other
/// way along the list. What names a vertex twice in a row only joins strips.
fn read_strips(
    body: &mut impl Body,
    element: &Element,
    layout: &Layout,
    triangles: &mut Vec<[u32; 3]>,
) -> Result<(), Fault> {
    for row in 0..element.count {
        body.begin_row(element, row)?;
        for (place, property) in element.properties.iter().enumerate() {
            match property.length {
                None => {
                    body.number(property.value)?;
                }
                Some(length) if Some(place) == layout.strips => {
                    let mut strip: Vec<u32> = Vec::new();
                    for _ in 0..list_length(body, length)? {
                        let vertex = body.number(property.value)?;
                        if vertex == -1.0 {
                            strip.clear();
                            continue;
                        }
                        strip.push(layout.corner(vertex).map_err(|wrong| body.fault(format!("strip {row} {wrong}")))?);
                        let [.., a, b, c] = strip[..] else { continue };
                        let triangle = if strip.len() % 2 == 1 { [a, b, c] } else { [a, c, b] };
                        if a != b && b != c && c != a {
                            triangles.push(triangle);
                        }
                    }
                }
                Some(_) => {
                    pass_list(body, property)?;
                }
            }
        }
        body.end_row()?;
    }
    Ok(())
}

fn list_length(body: &mut impl Body, kind: header::Type) -> Result<u32, Fault> {
    let length = body.number(kind)?;
    if length >= 0.0 && length <= u32::MAX.into() && length.fract() == 0.0 {
        return Ok(length as u32);
    }
    Err(body.fault(format!("a list of {length} values")))
}

fn pass_list(body: &mut impl Body, property: &header::Property) -> Result<f64, Fault> {
    if let Some(kind) = property.length {
        for _ in 0..list_length(body, kind)? {
            body.number(property.value)?;
        }
    }
    Ok(0.0)
}

fn pass_over(body: &mut impl Body, element: &Element) -> Result<(), Fault> {
    for row in 0..element.count {
        body.begin_row(element, row)?;
        for property in &element.properties {
            match property.length {
                None => {
                    body.number(property.value)?;
                }
                Some(_) => {
                    pass_list(body, property)?;
                }
            }
        }
        body.end_row()?;
    }
    Ok(())
}
