//! Wavefront OBJ: the polygons, with their groups and the names of their materials.
//!
//! Source: "Object Files (.obj)", Advanced Visualizer manual, appendix B1 (Wavefront, 1993). `v`, `vt`, `vn`, `f`, `o`,
//! `g`, `usemtl` are read; corners may be `v`, `v/vt`, `v//vn` or `v/vt/vn`, counted from 1 or, negative, backwards
//! from the line. Each (object, group, material) is a part. Lines, points, free-form surfaces, and faces of fewer than
//! three corners are counted in a note, and so are normals and texture coordinates that a face names and the file does
//! not have; colours of vertices, smoothing groups and material libraries are passed over.

use std::collections::{BTreeMap, HashMap};

use glam::{Vec2, Vec3};

use super::error::Fault;
use super::gather::{Gathered, count, position};
use super::polygon::Polygons;
use super::text::{decoded, text};
use super::weld::{Key, Weld};
use super::{MeshFile, Part, Triangles, number};

/// In place of an index that a corner does not have.
const NONE: u32 = u32::MAX;

pub(super) fn read(bytes: &[u8], stem: &str) -> Result<MeshFile, Fault> {
    let bytes = decoded(bytes);
    let text = text(&bytes);
    let mut reader = Reader::default();
    let mut lines = text.split('\n').enumerate();
    while let Some((index, line)) = lines.next() {
        let line = line.trim_ascii();
        if !line.ends_with('\\') {
            reader.line(line, index + 1)?;
            continue;
        }
        let mut joined = line.trim_end_matches('\\').to_owned();
        for (_, more) in lines.by_ref() {
            let more = more.trim_ascii();
            joined.push(' ');
            joined.push_str(more.trim_end_matches('\\'));
            if !more.ends_with('\\') {
                break;
            }
        }
        reader.line(&joined, index + 1)?;
    }
    let cut_short = !text.is_empty() && !text.ends_with('\n');
    reader.finish(stem, cut_short)
}

/// What faces are gathered by; each set of three is a part.
#[derive(Clone, Default, PartialEq, Eq, Hash)]
struct Label {
    object: String,
    group: String,
    material: Option<String>,
}

#[derive(Default)]
struct Faces {
    label: Label,
    /// Position, texture coordinates and normal of each corner, [`NONE`] where there is none.
    corners: Vec<Key>,
    sizes: Vec<u32>,
}

/// A stream of the file that corners refer to.
#[derive(Clone, Copy)]
struct Stream {
    name: &'static str,
    /// The largest index that a face has named so far, from 1, and the line of it: it may refer forwards.
    largest: (u32, usize),
}

struct Reader {
    positions: Vec<Vec3>,
    uvs: Vec<Vec2>,
    normals: Vec<Vec3>,
    streams: [Stream; 3],
    label: Label,
    faces: Vec<Faces>,
    numbers: HashMap<Label, usize>,
    /// The part of the current label; it is looked up at the first face after a change.
    current: Option<usize>,
    /// Faces of fewer than three corners.
    thin: usize,
    /// Other keywords, how many lines of each.
    passed: BTreeMap<String, usize>,
}

impl Default for Reader {
    fn default() -> Self {
        let streams = ["vertex", "texture coordinates", "normal"].map(|name| Stream { name, largest: (0, 0) });
        Self {
            positions: Vec::new(),
            uvs: Vec::new(),
            normals: Vec::new(),
            streams,
            label: Label::default(),
            faces: Vec::new(),
            numbers: HashMap::new(),
            current: None,
            thin: 0,
            passed: BTreeMap::new(),
        }
    }
}

impl Reader {
    fn line(&mut self, line: &str, number: usize) -> Result<(), Fault> {
        let (keyword, rest) = line.split_once([' ', '\t']).unwrap_or((line, ""));
        match keyword {
            "v" => {
                let [x, y, z] = numbers(rest, 3, number)?;
                let point = position(x.into(), y.into(), z.into());
                self.positions.push(point.map_err(|message| Fault::at_line(number, message))?);
            }
            "vt" => {
                let [u, v, _] = numbers(rest, 1, number)?;
                self.uvs.push(Vec2::new(u, v));
            }
            "vn" => self.normals.push(Vec3::from_array(numbers(rest, 3, number)?)),
            "f" | "fo" => self.face(rest, number)?,
            "o" => self.relabel(|label| label.object = rest.trim().to_owned()),
            "g" => self.relabel(|label| label.group = rest.trim().to_owned()),
            "usemtl" => {
                let name = rest.trim();
                self.relabel(|label| label.material = (!name.is_empty()).then(|| name.to_owned()));
            }
            _ => self.pass(keyword),
        }
        Ok(())
    }

    fn relabel(&mut self, change: impl FnOnce(&mut Label)) {
        change(&mut self.label);
        self.current = None;
    }

    fn pass(&mut self, keyword: &str) {
        if keyword.is_empty() || keyword.starts_with('#') || matches!(keyword, "s" | "mtllib" | "vp") {
            return;
        }
        *self.passed.entry(keyword.to_owned()).or_default() += 1;
    }

    fn face(&mut self, rest: &str, line: usize) -> Result<(), Fault> {
        let counts = [self.positions.len(), self.uvs.len(), self.normals.len()];
        let faces = match self.current.and_then(|part| self.faces.get_mut(part)) {
            Some(faces) => faces,
            None => {
                let next = self.faces.len();
                let part = *self.numbers.entry(self.label.clone()).or_insert(next);
                self.current = Some(part);
                if part == next {
                    self.faces.push(Faces { label: self.label.clone(), ..Faces::default() });
                }
                match self.faces.get_mut(part) {
                    Some(faces) => faces,
                    None => return Ok(()),
                }
            }
        };
        let before = faces.corners.len();
        for word in rest.split_ascii_whitespace().take_while(|word| !word.starts_with('#')) {
            faces.corners.push(corner(word, counts, &mut self.streams, line)?);
        }
        let size = faces.corners.len() - before;
        if size < 3 {
            faces.corners.truncate(before);
            self.thin += 1;
            return Ok(());
        }
        // A line of 2³² corners is longer than memory.
        faces.sizes.push(size as u32);
        Ok(())
    }

    fn finish(self, stem: &str, cut_short: bool) -> Result<MeshFile, Fault> {
        let counts = [self.positions.len(), self.uvs.len(), self.normals.len()];
        let mut gathered = Gathered::default();
        for (number, (stream, count)) in self.streams.iter().zip(counts).enumerate() {
            let (index, line) = stream.largest;
            if index as usize <= count {
                continue;
            }
            let fault = missing(stream.name, i64::from(index), count, line);
            if number == 0 {
                return Err(fault);
            }
            gathered.note(format!(
                "faces name {} that the file does not have (line {line} the {index} of {count}): such are left out",
                plural(stream.name)
            ));
        }
        if self.thin > 0 {
            gathered.note(format!("{} of fewer than 3 corners skipped", super::gather::count(self.thin, "face")));
        }
        for faces in &self.faces {
            let part = self.part(faces, stem, &mut gathered)?;
            gathered.add(part);
        }
        for (keyword, lines) in self.passed.iter().take(8) {
            gathered.note(format!("{} of `{keyword}` passed over: only polygons are read", count(*lines, "line")));
        }
        if cut_short {
            gathered.note("the last line has no end: the file may have been cut short");
        }
        gathered.finish_in_place()
    }

    fn part(&self, faces: &Faces, stem: &str, gathered: &mut Gathered) -> Result<Part, Fault> {
        let name = name(&faces.label, stem);
        let mut weld = Weld::default();
        let (uvs, normals) = (self.uvs.len(), self.normals.len());
        let there = |index: u32, count: usize| if (index as usize) < count { index } else { NONE };
        let present = |&[v, t, n]: &Key| [v, there(t, uvs), there(n, normals)];
        let corners: Option<Vec<u32>> = faces.corners.iter().map(|corner| weld.number(present(corner))).collect();
        let corners = corners.ok_or_else(|| Fault::new(format!("`{name}` has more than 2³² vertices")))?;
        let positions: Vec<Vec3> = weld.keys.iter().map(|&[v, ..]| fetch(&self.positions, v)).collect();
        let lacking = |at: fn(&Key) -> u32| weld.keys.iter().filter(|key| at(key) == NONE).count();
        let mut whole = |lacking: usize, what: &str| {
            if 0 < lacking && lacking < weld.keys.len() {
                gathered.note(format!("some corners of `{name}` have no {what}: those of the others were dropped"));
            }
            lacking == 0
        };
        let uvs = whole(lacking(|&[_, t, _]| t), "texture coordinates");
        let normals = whole(lacking(|&[_, _, n]| n), "normal");
        let uvs = if uvs { weld.keys.iter().map(|&[_, t, _]| fetch(&self.uvs, t)).collect() } else { Vec::new() };
        let normals =
            if normals { weld.keys.iter().map(|&[_, _, n]| fetch(&self.normals, n)).collect() } else { Vec::new() };
        let indices = Polygons { corners, sizes: faces.sizes.clone() }.triangles(&positions);
        let triangles = Triangles { positions, normals, uvs, indices };
        Ok(Part { name, material: faces.label.material.clone(), triangles })
    }
}

fn plural(name: &str) -> String {
    if name.ends_with('s') { name.to_owned() } else { format!("{name}s") }
}

fn fetch<T: Copy + Default>(values: &[T], index: u32) -> T {
    values.get(index as usize).copied().unwrap_or_default()
}

fn name(label: &Label, stem: &str) -> String {
    match (label.object.as_str(), label.group.as_str()) {
        ("", "") => stem.to_owned(),
        (name, "") | ("", name) => name.to_owned(),
        (object, group) => format!("{object}/{group}"),
    }
}

/// Up to three numbers; at least `least` of them, 0 for the others.
fn numbers(rest: &str, least: usize, line: usize) -> Result<[f32; 3], Fault> {
    let mut values = [0.0; 3];
    let mut found = 0;
    for (value, word) in values.iter_mut().zip(rest.split_ascii_whitespace()) {
        *value = number::parse(word).map_err(|message| Fault::at_line(line, message))?;
        found += 1;
    }
    if found < least {
        let message = format!("{}, expected {least}", count(found, "number"));
        return Err(Fault::at_line(line, message));
    }
    Ok(values)
}

fn corner(word: &str, counts: [usize; 3], streams: &mut [Stream; 3], line: usize) -> Result<Key, Fault> {
    let mut key = [NONE; 3];
    let mut words = word.split('/');
    for (place, ((slot, stream), count)) in key.iter_mut().zip(streams).zip(counts).enumerate() {
        match words.next() {
            Some("") if place > 0 => {}
            // Of coordinates and normals 0 is none.
            Some("0") if place > 0 => {}
            Some(index) => *slot = resolve(index, word, count, stream, line)?,
            None => {}
        }
    }
    if words.next().is_some() {
        return Err(Fault::at_line(line, not_a_corner(word)));
    }
    Ok(key)
}

fn not_a_corner(word: &str) -> String {
    format!("`{word}` is not a corner, expected `v`, `v/vt`, `v//vn` or `v/vt/vn`")
}

/// From the file's way of counting to ours, from 0.
fn resolve(index: &str, word: &str, count: usize, stream: &mut Stream, line: usize) -> Result<u32, Fault> {
    let index: i64 = index.parse().map_err(|_| Fault::at_line(line, not_a_corner(word)))?;
    if index < 0 {
        let place = i64::try_from(count).ok().and_then(|count| count.checked_add(index)).filter(|&place| place >= 0);
        let place = place.and_then(|place| u32::try_from(place).ok());
        return place.ok_or_else(|| {
            let message = format!("the face names {} {index}, but {count} stand before it", stream.name);
            Fault::at_line(line, message)
        });
    }
    match u32::try_from(index) {
        Ok(0) => Err(Fault::at_line(line, format!("`{word}` names a {} 0, they count from 1", stream.name))),
        Ok(index) if index < NONE => {
            if index > stream.largest.0 {
                stream.largest = (index, line);
            }
            Ok(index - 1)
        }
        _ => Err(missing(stream.name, index, count, line)),
    }
}

fn missing(name: &str, index: i64, count: usize, line: usize) -> Fault {
    Fault::at_line(line, format!("the face names {name} {index}, but the file has {count}"))
}
