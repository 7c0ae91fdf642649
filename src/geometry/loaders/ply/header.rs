//! The head of a PLY file: what elements follow, of which properties.

use super::super::error::Fault;

/// How the body is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Ascii,
    Little,
    Big,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Type {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Type {
    pub fn is_integer(self) -> bool {
        !matches!(self, Type::F32 | Type::F64)
    }

    fn of(word: &str) -> Option<Self> {
        Some(match word {
            "char" | "int8" => Type::I8,
            "uchar" | "uint8" => Type::U8,
            "short" | "int16" => Type::I16,
            "ushort" | "uint16" => Type::U16,
            "int" | "int32" => Type::I32,
            "uint" | "uint32" => Type::U32,
            "float" | "float32" => Type::F32,
            "double" | "float64" => Type::F64,
            _ => return None,
        })
    }
}

#[derive(Debug, PartialEq)]
pub(super) struct Property {
    pub name: String,
    /// Of a list: the type of its length.
    pub length: Option<Type>,
    pub value: Type,
}

#[derive(Debug, PartialEq)]
pub(super) struct Element {
    pub name: String,
    pub count: usize,
    pub properties: Vec<Property>,
    /// Where the header speaks of it.
    pub line: usize,
}

#[derive(Debug)]
pub(super) struct Header {
    pub encoding: Encoding,
    pub elements: Vec<Element>,
    /// Lines of the header, and bytes up to the body.
    pub lines: usize,
    pub bytes: usize,
}

impl Header {
    pub fn parse(bytes: &[u8]) -> Result<Self, Fault> {
        let mut encoding = None;
        let mut elements: Vec<Element> = Vec::new();
        // How the first line ends tells: after a carriage return alone the body's first byte may be
        // anything.
        let first = bytes.iter().position(|b| matches!(b, b'\r' | b'\n')).unwrap_or(0);
        let end = match bytes.get(first..) {
            Some([b'\r', next, ..]) if *next != b'\n' => b'\r',
            _ => b'\n',
        };
        let mut at = 0;
        let mut number = 0;
        loop {
            number += 1;
            let rest = bytes.get(at..).unwrap_or_default();
            let Some(length) = rest.iter().position(|&b| b == end) else {
                return Err(Fault::at_line(number, "the file ends before `end_header`"));
            };
            at += length + 1;
            let line = String::from_utf8_lossy(rest.get(..length).unwrap_or_default());
            let words: Vec<&str> = line.split_ascii_whitespace().collect();
            let fault = |message: String| Fault::at_line(number, message);
            match words.as_slice() {
                ["ply"] if number == 1 => {}
                _ if number == 1 => return Err(fault("the file does not begin with `ply`".to_owned())),
                ["end_header"] => break,
                [] | ["comment" | "obj_info", ..] => {}
                ["format", form, _] => encoding = Some(parse_encoding(form).map_err(fault)?),
                ["element", name, count] => {
                    let count = count.parse().map_err(|_| fault(format!("`{count}` is not a count of elements")))?;
                    if elements.iter().any(|element| element.name == *name) {
                        return Err(fault(format!("a second element `{name}`")));
                    }
                    elements.push(Element { name: (*name).to_owned(), count, properties: Vec::new(), line: number });
                }
                ["property", words @ ..] => {
                    let property = parse_property(words).map_err(fault)?;
                    let element =
                        elements.last_mut().ok_or_else(|| fault("a property before any element".to_owned()))?;
                    element.properties.push(property);
                }
                _ => return Err(fault(format!("`{}` is no line of a PLY header", line.trim()))),
            }
        }
        let encoding = encoding.ok_or_else(|| Fault::new("the header has no `format` line"))?;
        if let Some(element) = elements.iter().find(|element| element.properties.is_empty() && element.count > 0) {
            let message = format!("the element `{}` has no properties", element.name);
            return Err(Fault::at_line(element.line, message));
        }
        Ok(Self { encoding, elements, lines: number, bytes: at })
    }

    pub fn element(&self, name: &str) -> Option<&Element> {
        self.elements.iter().find(|element| element.name == name)
    }
}

fn parse_encoding(word: &str) -> Result<Encoding, String> {
    match word {
        "ascii" => Ok(Encoding::Ascii),
        "binary_little_endian" => Ok(Encoding::Little),
        "binary_big_endian" => Ok(Encoding::Big),
        _ => Err(format!("the format `{word}`, expected `ascii`, `binary_little_endian` or `binary_big_endian`")),
    }
}

fn parse_property(words: &[&str]) -> Result<Property, String> {
    let kind = |word: &str| Type::of(word).ok_or_else(|| format!("`{word}` is no type of a property"));
    match *words {
        ["list", length, value, name] => {
            let length_type = kind(length)?;
            if !length_type.is_integer() {
                return Err(format!("the length of the list `{name}` is of type {length}, expected an integer"));
            }
            Ok(Property { name: name.to_owned(), length: Some(length_type), value: kind(value)? })
        }
        [value, name] => Ok(Property { name: name.to_owned(), length: None, value: kind(value)? }),
        _ => Err("expected `property <type> <name>` or `property list <type> <type> <name>`".to_owned()),
    }
}
