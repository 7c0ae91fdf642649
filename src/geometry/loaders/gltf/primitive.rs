//! The triangles of a mesh's primitive.

use std::ops::Range;

use glam::{Vec2, Vec3};

use super::super::Triangles;
use super::super::error::Fault;
use super::super::gather::position;
use super::accessor::Accessors;
use super::json::Primitive;

/// The triangles, or why there are none to be had.
pub(super) enum Shape {
    Triangles(Triangles),
    PointsOrLines,
}

pub(super) fn read(primitive: &Primitive, accessors: &Accessors) -> Result<Shape, Fault> {
    let mode = match primitive.mode.unwrap_or(4) {
        0..=3 => return Ok(Shape::PointsOrLines),
        4 => Mode::Separate,
        5 => Mode::Strip,
        6 => Mode::Fan,
        other => return Err(Fault::new(format!("{other} is no mode of a primitive"))),
    };
    let Some(of_positions) = primitive.attributes.position else {
        return Ok(Shape::Triangles(Triangles::default()));
    };
    let count = accessors.count(of_positions)?;
    if u32::try_from(count).is_err() {
        return Err(Fault::new(format!("{count} vertices are more than 32 bits can count")));
    }
    let corners = match primitive.indices {
        Some(accessor) => accessors.indices(accessor)?,
        // The positions are known to be there before their numbers are made.
        None => {
            accessors.vectors::<3>(of_positions, 0..0)?;
            (0..count as u32).collect()
        }
    };
    let mut indices = mode.triangles(&corners);
    let range = used(&indices, count)?;
    let first = range.start as u32;
    for corner in indices.as_flattened_mut() {
        *corner -= first;
    }
    let positions: Result<Vec<Vec3>, String> =
        accessors.vectors(of_positions, range.clone())?.into_iter().map(|[x, y, z]| position(x, y, z)).collect();
    let positions = positions.map_err(|message| Fault::new(format!("accessor {of_positions}: {message}")))?;
    let optional = |accessor: Option<usize>| same_count(accessors, accessor, count);
    let normals = match optional(primitive.attributes.normal)? {
        Some(accessor) => accessors.vectors(accessor, range.clone())?.into_iter().map(single).collect(),
        None => Vec::new(),
    };
    let uvs = match optional(primitive.attributes.uv)? {
        // The format counts v downwards from the top row.
        Some(accessor) => {
            let uv = |[u, v]: [f64; 2]| Vec2::new(u as f32, (1.0 - v) as f32);
            accessors.vectors(accessor, range)?.into_iter().map(uv).collect()
        }
        None => Vec::new(),
    };
    Ok(Shape::Triangles(Triangles { positions, normals, uvs, indices }))
}

fn single([x, y, z]: [f64; 3]) -> Vec3 {
    Vec3::new(x as f32, y as f32, z as f32)
}

fn same_count(accessors: &Accessors, accessor: Option<usize>, count: usize) -> Result<Option<usize>, Fault> {
    let Some(index) = accessor else { return Ok(None) };
    let found = accessors.count(index)?;
    if found == count {
        return Ok(accessor);
    }
    Err(Fault::new(format!("accessor {index} has {found} elements for {count} vertices")))
}

/// From the lowest vertex to the highest: primitives often share one long accessor, each using a stretch of it.
fn used(triangles: &[[u32; 3]], count: usize) -> Result<Range<usize>, Fault> {
    let (mut low, mut end) = (usize::MAX, 0);
    for (number, triangle) in triangles.iter().enumerate() {
        for &corner in triangle {
            let corner = corner as usize;
            if corner >= count {
                let message = format!("triangle {number} names vertex {corner}, but there are {count} (from 0)");
                return Err(Fault::new(message));
            }
            low = low.min(corner);
            end = end.max(corner + 1);
        }
    }
    Ok(low.min(end)..end)
}

enum Mode {
    Separate,
    Strip,
    Fan,
}

impl Mode {
    /// In the orders of the specification, 3.7.2.1.
    fn triangles(&self, corners: &[u32]) -> Vec<[u32; 3]> {
        match self {
            Mode::Separate => corners.as_chunks().0.to_vec(),
            Mode::Strip => corners
                .array_windows()
                .enumerate()
                .map(|(i, &[a, b, c])| if i % 2 == 0 { [a, b, c] } else { [a, c, b] })
                .collect(),
            Mode::Fan => match corners.split_first() {
                Some((&apex, rim)) => rim.array_windows().map(|&[b, c]| [b, c, apex]).collect(),
                None => Vec::new(),
            },
        }
    }
}
