//! Materials as files that other programs load: a glTF scene with a sphere of each, and a MaterialX
//! document.
//!
//! Both hold the parameters that [`Engines`](crate::report::f0::Engines) defines; surfaces are
//! smooth, and clear solids let light through. glTF has no word for a metal's tint at grazing
//! angles, so `specular_color` is in MaterialX alone.

use crate::report::f0::{Row, Table};
use crate::report::markup;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};

/// Names of the materials, each once: data sets tell apart what has one name.
fn names(table: &Table) -> Vec<String> {
    let count = |name: &str| table.materials.iter().filter(|row| row.name == name).count();
    let name = |row: &Row| if count(&row.name) > 1 { format!("{} {}", row.name, row.ior) } else { row.name.clone() };
    table.materials.iter().map(name).collect()
}

/// A MaterialX document of `open_pbr_surface` nodes.
pub(super) fn materialx(table: &Table) -> String {
    // As MaterialX calls linear spaces.
    let space = match table.conditions.space {
        "srgb" => "lin_rec709",
        "display-p3" => "lin_displayp3",
        "rec2020" => "lin_rec2020",
        other => other,
    };
    let mut text = format!("<?xml version=\"1.0\"?>\n<materialx version=\"1.39\" colorspace=\"{space}\">\n");
    text += &format!("  <!-- {} -->\n", table.conditions.sentence().replace("--", "–"));
    for (row, name) in table.materials.iter().zip(names(table)) {
        text += &surface(row, &identifier(&name));
    }
    text + "</materialx>\n"
}

/// A name of letters, digits and underscores.
fn identifier(name: &str) -> String {
    let plain: String = name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
    if plain.starts_with(|c: char| c.is_ascii_digit()) { format!("_{plain}") } else { plain }
}

fn surface(row: &Row, name: &str) -> String {
    let openpbr = &row.engines.openpbr;
    let color = |value: [f64; 3]| value.map(|channel| channel.to_string()).join(", ");
    let mut inputs = vec![("base_metalness", "float", openpbr.base_metalness.to_string())];
    inputs.extend(openpbr.base_color.map(|value| ("base_color", "color3", color(value))));
    inputs.extend(openpbr.specular_color.map(|value| ("specular_color", "color3", color(value))));
    inputs.push(("specular_roughness", "float", "0".into()));
    if let Some(ior) = openpbr.specular_ior {
        inputs.extend([("specular_ior", "float", ior.to_string()), ("transmission_weight", "float", "1".into())]);
    }
    let inputs = inputs
        .into_iter()
        .map(|(name, kind, value)| format!("    <input name=\"{name}\" type=\"{kind}\" value=\"{value}\" />\n"));
    let doc = markup::html(&format!("{}, data set {}", row.name, row.ior));
    format!(
        "  <open_pbr_surface name=\"{name}_surface\" type=\"surfaceshader\" doc=\"{doc}\">\n{}  </open_pbr_surface>\n  \
         <surfacematerial name=\"{name}\" type=\"material\">\n    \
         <input name=\"surfaceshader\" type=\"surfaceshader\" nodename=\"{name}_surface\" />\n  </surfacematerial>\n",
        inputs.collect::<String>()
    )
}

/// Parts of a sphere around and from pole to pole, and how many stand in a row.
const AROUND: u16 = 48;
const DOWN: u16 = 24;
const A_ROW: usize = 8;

/// A glTF 2.0 scene in one file: a sphere of unit radius of each material, eight in a row.
pub(super) fn gltf(table: &Table) -> Result<String, serde_json::Error> {
    let materials: Vec<Value> =
        table.materials.iter().zip(names(table)).map(|(row, name)| material(row, &name)).collect();
    let count = materials.len();
    let meshes: Vec<Value> = (0..count)
        .map(|i| {
            let attributes = json!({ "POSITION": 0, "NORMAL": 0 });
            json!({ "primitives": [{ "attributes": attributes, "indices": 1, "material": i }] })
        })
        .collect();
    let nodes: Vec<Value> = (0..count)
        .map(|i| {
            let place = |step: usize| 2.5 * step as f64;
            json!({ "mesh": i, "name": names(table)[i], "translation": [place(i % A_ROW), -place(i / A_ROW), 0.0] })
        })
        .collect();
    let extensions: &[&str] = match table.materials.iter().any(|row| row.engines.gltf.ior.is_some()) {
        true => &["KHR_materials_ior", "KHR_materials_transmission"],
        false => &[],
    };
    let (points, corners, buffer) = sphere();
    let split = points * 12;
    let mut asset = json!({
        "asset": { "version": "2.0", "generator": "spectrel" },
        "scene": 0,
        "scenes": [{ "nodes": (0..count).collect::<Vec<_>>() }],
        "nodes": nodes,
        "meshes": meshes,
        "materials": materials,
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": points, "type": "VEC3", "min": [-1, -1, -1], "max": [1, 1, 1] },
            { "bufferView": 1, "componentType": 5123, "count": corners, "type": "SCALAR" },
        ],
        "bufferViews": [
            { "buffer": 0, "byteOffset": 0, "byteLength": split, "target": 34962 },
            { "buffer": 0, "byteOffset": split, "byteLength": corners * 2, "target": 34963 },
        ],
        "buffers": [{
            "byteLength": buffer.len(),
            "uri": format!("data:application/octet-stream;base64,{}", STANDARD.encode(&buffer)),
        }],
    });
    if !extensions.is_empty() {
        asset["extensionsUsed"] = json!(extensions);
    }
    markup::json(&asset)
}

fn material(row: &Row, name: &str) -> Value {
    let gltf = &row.engines.gltf;
    let mut material = json!({
        "name": name,
        "pbrMetallicRoughness": {
            "baseColorFactor": gltf.base_color_factor.unwrap_or([1.0; 4]),
            "metallicFactor": gltf.metallic_factor,
            "roughnessFactor": 0.0,
        },
        "extras": { "data_set": row.ior },
    });
    if let Some(ior) = gltf.ior {
        material["extensions"] =
            json!({ "KHR_materials_ior": { "ior": ior }, "KHR_materials_transmission": { "transmissionFactor": 1.0 } });
    }
    material
}

/// Number of points, of corners of triangles, and both as bytes: the points of a unit sphere are
/// its normals too.
fn sphere() -> (usize, usize, Vec<u8>) {
    let mut bytes = Vec::new();
    for down in 0..=DOWN {
        let theta = std::f64::consts::PI * f64::from(down) / f64::from(DOWN);
        for around in 0..=AROUND {
            let phi = 2.0 * std::f64::consts::PI * f64::from(around % AROUND) / f64::from(AROUND);
            let ring = if down == 0 || down == DOWN { 0.0 } else { libm::sin(theta) };
            for value in [ring * libm::cos(phi), libm::cos(theta), -ring * libm::sin(phi)] {
                bytes.extend((value as f32).to_le_bytes());
            }
        }
    }
    let points = bytes.len() / 12;
    let at = |down: u16, around: u16| down * (AROUND + 1) + around;
    let mut corners: Vec<u16> = Vec::new();
    for down in 0..DOWN {
        for around in 0..AROUND {
            let [a, b] = [at(down, around), at(down + 1, around)];
            if down > 0 {
                corners.extend([a, b, a + 1]);
            }
            if down + 1 < DOWN {
                corners.extend([a + 1, b, b + 1]);
            }
        }
    }
    bytes.extend(corners.iter().flat_map(|corner| corner.to_le_bytes()));
    (points, corners.len(), bytes)
}
