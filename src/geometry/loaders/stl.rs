//! STL: triangles and nothing else, as text or as bytes.
//!
//! Source: "StereoLithography Interface Specification" (3D Systems, 1989); binary: 80 bytes of anything, a count, and
//! 50 bytes for each triangle, little endian. Vertices that agree in every bit (and -0 = 0) become one, so that a
//! closed solid is closed. Facet normals say nothing that the winding does not; those that contradict it are counted.

use glam::{DVec3, Vec3};

use super::error::Fault;
use super::gather::{Gathered, position};
use super::text::{decoded, text};
use super::weld::Weld;
use super::{MeshFile, Part, Triangles, number};

const HEAD: usize = 84;
const RECORD: usize = 50;

pub(super) fn read(bytes: &[u8], stem: &str) -> Result<MeshFile, Fault> {
    let as_text = decoded(bytes);
    let promised = bytes.get(80..).and_then(|rest| rest.first_chunk()).map(|&count| u32::from_le_bytes(count) as usize);
    let size = promised.and_then(|count| count.checked_mul(RECORD)?.checked_add(HEAD));
    // Binary files begin with "solid" often enough; only their size tells, or that they are no text.
    let begins_as_text = as_text.trim_ascii_start().get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    let is_text = as_text.iter().take(1024).all(|&b| b >= b' ' || b.is_ascii_whitespace());
    if begins_as_text && is_text && size != Some(bytes.len()) {
        return read_text(&text(&as_text), stem);
    }
    match promised {
        Some(promised) => read_binary(bytes, promised, stem),
        None => {
            let message = format!("the file ends after {} bytes, in the head of {HEAD}", bytes.len());
            Err(Fault::new(message))
        }
    }
}

/// A solid in the making.
#[derive(Default)]
struct Solid {
    weld: Weld,
    indices: Vec<[u32; 3]>,
    /// Facets whose normal points to the back.
    contradictions: usize,
}

impl Solid {
    fn add(&mut self, normal: Vec3, corners: [Vec3; 3]) -> Result<(), String> {
        let mut triangle = [0; 3];
        for (slot, corner) in triangle.iter_mut().zip(corners) {
            // Adding 0 makes 0 of -0 and leaves all other numbers as they are.
            let key = (corner + Vec3::ZERO).to_array().map(f32::to_bits);
            *slot = self.weld.number(key).ok_or("there are more than 2³² vertices")?;
        }
        self.indices.push(triangle);
        let [a, b, c]: [DVec3; 3] = corners.map(|p| p.as_dvec3());
        if (b - a).cross(c - a).dot(normal.as_dvec3()) < 0.0 {
            self.contradictions += 1;
        }
        Ok(())
    }

    fn finish(self, name: String, gathered: &mut Gathered) {
        if self.contradictions > 0 {
            let (facets, verb, whose) = match self.contradictions {
                1 => ("1 facet normal".to_owned(), "points", "its"),
                many => (format!("{many} facet normals"), "point", "their"),
            };
            gathered.note(format!("{facets} of `{name}` {verb} against the order of {whose} corners, which counts"));
        }
        let positions = self.weld.keys.iter().map(|&key| Vec3::from_array(key.map(f32::from_bits))).collect();
        let triangles = Triangles { positions, indices: self.indices, ..Triangles::default() };
        gathered.add(Part { name, material: None, triangles });
    }
}

fn read_binary(bytes: &[u8], promised: usize, stem: &str) -> Result<MeshFile, Fault> {
    let (records, trailing) = bytes.get(HEAD..).unwrap_or_default().as_chunks::<RECORD>();
    let mut solid = Solid::default();
    for (number, record) in records.iter().take(promised).enumerate() {
        let [normal, a, b, c] = vectors(record);
        let fault = |message| Fault::at_byte(HEAD + number * RECORD, format!("triangle {number}: {message}"));
        for p in [a, b, c] {
            position(p.x.into(), p.y.into(), p.z.into()).map_err(fault)?;
        }
        solid.add(normal, [a, b, c]).map_err(fault)?;
    }
    if records.len() < promised {
        let message = format!("the file ends in triangle {} of {promised}", records.len());
        return Err(Fault::at_byte(bytes.len(), message));
    }
    let mut gathered = Gathered::default();
    let more = (records.len() - promised) * RECORD + trailing.len();
    if more > 0 {
        gathered.note(format!("{more} bytes follow the last triangle"));
    }
    solid.finish(stem.to_owned(), &mut gathered);
    gathered.finish_in_place()
}

/// Normal and corners of a record; the last two bytes are colours of some programs.
fn vectors(record: &[u8; RECORD]) -> [Vec3; 4] {
    let mut vectors = [Vec3::ZERO; 4];
    let (words, _) = record.as_chunks::<4>();
    let mut numbers = words.iter().map(|&word| f32::from_le_bytes(word));
    let mut next = || numbers.next().unwrap_or(f32::NAN);
    for vector in &mut vectors {
        *vector = Vec3::new(next(), next(), next());
    }
    vectors
}

/// The words of a text, with their lines.
struct Words<'a> {
    lines: std::iter::Enumerate<std::str::Lines<'a>>,
    words: std::str::SplitAsciiWhitespace<'a>,
    line: usize,
}

impl<'a> Words<'a> {
    fn next(&mut self) -> Option<&'a str> {
        loop {
            if let Some(word) = self.words.next() {
                return Some(word);
            }
            let (index, line) = self.lines.next()?;
            self.line = index + 1;
            self.words = line.split_ascii_whitespace();
        }
    }

    /// What is left of the line.
    fn rest(&mut self) -> String {
        self.words.by_ref().collect::<Vec<_>>().join(" ")
    }

    fn fault(&self, found: Option<&str>, expected: &str) -> Fault {
        let message = match found {
            Some(found) => format!("`{found}`, expected {expected}"),
            None => format!("the file ends, expected {expected}"),
        };
        Fault::at_line(self.line, message)
    }

    fn expect(&mut self, keyword: &str) -> Result<(), Fault> {
        match self.next() {
            Some(word) if word.eq_ignore_ascii_case(keyword) => Ok(()),
            other => Err(self.fault(other, &format!("`{keyword}`"))),
        }
    }

    /// A normal, in whose place some programs write what their C library makes of 0/0: `-nan(ind)`,
    /// `-1.#IND`.
    fn normal(&mut self) -> Result<Vec3, Fault> {
        let mut vector = [f32::NAN; 3];
        for slot in &mut vector {
            let word = self.next().ok_or_else(|| self.fault(None, "a number"))?;
            *slot = match number::parse::<f64>(word) {
                Ok(value) => value as f32,
                Err(_) if is_odd_nan(word) => f32::NAN,
                Err(message) => return Err(Fault::at_line(self.line, message)),
            };
        }
        Ok(Vec3::from_array(vector))
    }

    fn vector(&mut self) -> Result<DVec3, Fault> {
        let mut vector = [0.0; 3];
        for slot in &mut vector {
            let word = self.next().ok_or_else(|| self.fault(None, "a number"))?;
            *slot = number::parse(word).map_err(|message| Fault::at_line(self.line, message))?;
        }
        Ok(DVec3::from_array(vector))
    }
}

fn is_odd_nan(word: &str) -> bool {
    let word = word.trim_start_matches(['+', '-']).to_ascii_lowercase();
    ["nan", "qnan", "snan", "ind", "inf", "1.#"].iter().any(|odd| word.starts_with(odd))
}

fn read_text(text: &str, stem: &str) -> Result<MeshFile, Fault> {
    let mut gathered = Gathered::default();
    let mut words = Words { lines: text.lines().enumerate(), words: "".split_ascii_whitespace(), line: 0 };
    while let Some(word) = words.next() {
        if !word.eq_ignore_ascii_case("solid") {
            return Err(words.fault(Some(word), "`solid`"));
        }
        let name = words.rest();
        let name = if name.is_empty() { stem.to_owned() } else { name };
        let mut solid = Solid::default();
        loop {
            match words.next() {
                Some(word) if word.eq_ignore_ascii_case("facet") => read_facet(&mut words, &mut solid)?,
                Some(word) if word.eq_ignore_ascii_case("endsolid") => break,
                other => return Err(words.fault(other, "`facet` or `endsolid`")),
            }
        }
        words.rest();
        solid.finish(name, &mut gathered);
    }
    gathered.finish_in_place()
}

fn read_facet(words: &mut Words, solid: &mut Solid) -> Result<(), Fault> {
    words.expect("normal")?;
    let normal = words.normal()?;
    words.expect("outer")?;
    words.expect("loop")?;
    let mut corners = [Vec3::ZERO; 3];
    for corner in &mut corners {
        words.expect("vertex")?;
        let point = words.vector()?;
        *corner = position(point.x, point.y, point.z).map_err(|message| Fault::at_line(words.line, message))?;
    }
    words.expect("endloop")?;
    words.expect("endfacet")?;
    solid.add(normal, corners).map_err(|message| Fault::at_line(words.line, message))
}
