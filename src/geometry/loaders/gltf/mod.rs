//! glTF 2.0, as text with its buffers or as GLB: meshes, the nodes that place them, cameras.
//!
//! Source: "glTF 2.0 Specification" (Khronos, 2021; ISO/IEC 12113:2022). Nodes of the default scene (or the first, or
//! all nodes where there is none) are followed down; each mesh is read once, however many nodes show it. y is upwards
//! in the format and z here: (x, y, z) becomes (x, −z, y), in the placements. Lengths are metres in the format.
//! Materials are kept by name; skins, morph targets, animations, lights and pictures are not read. Meshes that stand at
//! many places by EXT_mesh_gpu_instancing stand there.

mod accessor;
mod container;
mod json;
mod nodes;
mod primitive;

use std::collections::{BTreeSet, HashMap};
use std::path::Path;

use super::error::Fault;
use super::gather::{Gathered, count};
use super::{FileCamera, MeshFile, Part, Placement};
use accessor::Accessors;
use container::{Buffers, Container};
use json::Root;
use nodes::Placed;
pub use nodes::Z_UP;
use primitive::Shape;

/// Extensions that change nothing of what is read here: materials are replaced, pictures are not read.
const HARMLESS: [&str; 6] =
    ["KHR_materials_", "KHR_texture_", "EXT_texture_", "MSFT_texture_", "KHR_mesh_quantization", INSTANCING];

/// One mesh at many places.
const INSTANCING: &str = "EXT_mesh_gpu_instancing";

/// Extensions that some exporters require though nothing of the meshes depends on them; they are
/// passed over, and told.
const PASSED: [&str; 7] = [
    "KHR_lights_",
    "EXT_lights_",
    "KHR_xmp",
    "KHR_animation_pointer",
    "KHR_node_selectability",
    "KHR_node_hoverability",
    "KHR_audio_emitter",
];

pub(super) fn read(bytes: &[u8], path: &Path) -> Result<MeshFile, Fault> {
    let Container { root, chunk, trailing } = container::open(bytes)?;
    let mut reader = Reader::default();
    if trailing > 0 {
        reader.gathered.note(format!("{trailing} bytes follow the end of the GLB"));
    }
    reader.check_version(&root)?;
    reader.check_extensions(&root)?;
    let buffers = Buffers::new(&root.buffers, chunk, path);
    let accessors = Accessors::new(&root, &buffers);
    for placed in nodes::walk(&root)? {
        reader.place(&placed, &root, &accessors)?;
    }
    reader.finish(&root)
}

#[derive(Default)]
struct Reader {
    gathered: Gathered,
    placements: Vec<Placement>,
    cameras: Vec<FileCamera>,
    /// The parts of each mesh read so far.
    parts: HashMap<usize, Vec<usize>>,
    points_or_lines: usize,
}

impl Reader {
    fn check_version(&self, root: &Root) -> Result<(), Fault> {
        if root.asset.version.starts_with("2.") {
            return Ok(());
        }
        Err(Fault::new(format!("it is glTF {}, expected 2.0", root.asset.version)))
    }

    fn check_extensions(&mut self, root: &Root) -> Result<(), Fault> {
        let harmless = |name: &str| HARMLESS.iter().any(|known| name.starts_with(known));
        let passed = |name: &str| PASSED.iter().any(|known| name.starts_with(known));
        let unknown = |name: &&String| !harmless(name) && !passed(name);
        let required: Vec<String> = root.extensions_required.iter().filter(unknown).cloned().collect();
        if !required.is_empty() {
            return Err(Fault::extensions(required));
        }
        for name in &root.extensions_required {
            if harmless(name) && name != "KHR_mesh_quantization" && name != INSTANCING {
                self.gathered.note(format!("the file requires {name}: its materials and pictures are not read"));
            }
        }
        let used: BTreeSet<&String> = root.extensions_used.iter().chain(&root.extensions_required).collect();
        for name in used.into_iter().filter(|name| !harmless(name)) {
            let instead = if name.starts_with("KHR_lights_") { ": a scene has lights of its own" } else { "" };
            self.gathered.note(format!("the file uses {name}, which was passed over{instead}"));
        }
        Ok(())
    }

    fn place(&mut self, placed: &Placed, root: &Root, accessors: &Accessors) -> Result<(), Fault> {
        let name = placed.name();
        if let Some(mesh) = placed.node.mesh {
            if placed.node.skin.is_some() {
                self.gathered.note(format!("`{name}` has a skin: it is shown as modelled, without its bones"));
            }
            let places = placed.places(accessors).map_err(|fault| fault.within(&format!("node `{name}`")))?;
            let flat = places.iter().filter(|place| place.matrix3.determinant() == 0.0).count();
            if flat > 0 {
                let what = if places.len() == 1 { String::new() } else { format!("{} of ", count(flat, "instance")) };
                self.gathered.note(format!("{what}`{name}` is scaled to nothing and was skipped"));
            }
            for &transform in places.iter().filter(|place| place.matrix3.determinant() != 0.0) {
                for part in self.mesh(mesh, root, accessors)? {
                    self.placements.push(Placement { name: name.clone(), part, transform });
                }
            }
        }
        if let Some(camera) = placed.node.camera {
            match placed.camera(camera, root)? {
                Some(camera) => self.cameras.push(camera),
                None => self.gathered.note(format!("the camera at `{name}` looks nowhere and was skipped")),
            }
        }
        Ok(())
    }

    /// The parts of a mesh, read when it is first shown.
    fn mesh(&mut self, index: usize, root: &Root, accessors: &Accessors) -> Result<Vec<usize>, Fault> {
        if let Some(parts) = self.parts.get(&index) {
            return Ok(parts.clone());
        }
        let mesh = root.meshes.get(index).ok_or_else(|| Fault::new(format!("there is no mesh {index}")))?;
        let name = mesh.name.clone().unwrap_or_else(|| format!("mesh {index}"));
        let mut parts = Vec::new();
        for (number, primitive) in mesh.primitives.iter().enumerate() {
            let within = |fault: Fault| fault.within(&format!("primitive {number} of mesh `{name}`"));
            if !primitive.targets.is_empty() {
                self.gathered.note(format!("`{name}` has morph targets: it is shown without them"));
            }
            let material = match primitive.material {
                Some(index) => Some(material_name(index, root).map_err(within)?),
                None => None,
            };
            match primitive::read(primitive, accessors).map_err(within)? {
                Shape::PointsOrLines => self.points_or_lines += 1,
                Shape::Triangles(triangles) => {
                    parts.extend(self.gathered.add(Part { name: name.clone(), material, triangles }));
                }
            }
        }
        self.parts.insert(index, parts.clone());
        Ok(parts)
    }

    fn finish(mut self, root: &Root) -> Result<MeshFile, Fault> {
        let unseen = root.meshes.len().saturating_sub(self.parts.len());
        if unseen > 0 {
            self.gathered.note(format!("{} shown by no node of the scene: not read", count(unseen, "mesh")));
        }
        if self.points_or_lines > 0 {
            let primitives = count(self.points_or_lines, "primitive");
            self.gathered.note(format!("{primitives} of points or lines skipped"));
        }
        let mut file = self.gathered.finish()?;
        file.placements = self.placements;
        file.cameras = self.cameras;
        file.is_in_metres = true;
        Ok(file)
    }
}

fn material_name(index: usize, root: &Root) -> Result<String, Fault> {
    let material = root.materials.get(index).ok_or_else(|| Fault::new(format!("there is no material {index}")))?;
    Ok(material.name.clone().unwrap_or_else(|| format!("material {index}")))
}
