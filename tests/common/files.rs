//! Mesh files that tests write for themselves.

use spectrel::geometry::Triangles;
use std::fmt::Write;
use std::path::Path;

/// A box around a point as triangles, like `shape.box`.
pub fn cuboid(center: [f32; 3], size: [f32; 3]) -> Triangles {
    let corner = |i: usize| {
        let at = |axis: usize| center[axis] + size[axis] * if i >> axis & 1 == 1 { 0.5 } else { -0.5 };
        glam::Vec3::new(at(0), at(1), at(2))
    };
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let indices = faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    Triangles { positions: (0..8).map(corner).collect(), indices, ..Triangles::default() }
}

/// Two meshes as one, the second turned inside out: a solid with a hollow.
pub fn hollowed(outer: Triangles, hollow: &Triangles) -> Triangles {
    let offset = outer.positions.len() as u32;
    let turned = hollow.indices.iter().map(|&[a, b, c]| [a + offset, c + offset, b + offset]);
    Triangles {
        positions: outer.positions.iter().chain(&hollow.positions).copied().collect(),
        indices: outer.indices.iter().copied().chain(turned).collect(),
        ..Triangles::default()
    }
}

/// Writes positions and triangles as OBJ; gives the shape as a scene says it.
pub fn obj(folder: &Path, name: &str, mesh: &Triangles) -> String {
    let mut text = String::new();
    for p in &mesh.positions {
        // Shortest digits that read back to the same number.
        writeln!(text, "v {} {} {}", p.x, p.y, p.z).expect("to memory");
    }
    for [a, b, c] in &mesh.indices {
        writeln!(text, "f {} {} {}", a + 1, b + 1, c + 1).expect("to memory");
    }
    let path = folder.join(format!("{name}.obj"));
    std::fs::write(&path, text).expect("a folder to write to");
    format!("shape.mesh.file = '{}'", path.display())
}

/// Writes a mesh as binary PLY, with its normals if it has some; gives the shape as a scene says it.
pub fn ply(folder: &Path, name: &str, mesh: &Triangles) -> String {
    let properties = |names: [&str; 3]| names.map(|name| format!("property float {name}\n")).concat();
    let normals = if mesh.normals.is_empty() { String::new() } else { properties(["nx", "ny", "nz"]) };
    let mut bytes = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\n{}{normals}element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        mesh.positions.len(),
        properties(["x", "y", "z"]),
        mesh.indices.len()
    )
    .into_bytes();
    for (index, position) in mesh.positions.iter().enumerate() {
        for number in
            position.to_array().into_iter().chain(mesh.normals.get(index).into_iter().flat_map(|n| n.to_array()))
        {
            bytes.extend(number.to_le_bytes());
        }
    }
    for triangle in &mesh.indices {
        bytes.push(3);
        for index in triangle {
            bytes.extend(index.to_le_bytes());
        }
    }
    let path = folder.join(format!("{name}.ply"));
    std::fs::write(&path, bytes).expect("a folder to write to");
    format!("shape.mesh.file = '{}'", path.display())
}
