//! One order of attributes in the header of an EXR file.
//!
//! The `exr` crate keeps custom attributes in a hash map with a random seed, so the same picture would give other bytes
//! each time. Readers take attributes in any order; here they are sorted by name. The header keeps its length, so the
//! offsets behind it stay true.

/// Magic number and version.
const START: usize = 8;

/// Sorts the attributes of a single-part file; `None` if `file` does not begin with a header.
pub fn sort_attributes(file: &mut [u8]) -> Option<()> {
    let mut attributes = Vec::new();
    let mut at = START;
    while *file.get(at)? != 0 {
        let length = attribute_length(&file[at..])?;
        attributes.push(file.get(at..at + length)?.to_vec());
        at += length;
    }
    // Names are unique and end in zero, so comparing whole attributes compares names.
    attributes.sort();
    file[START..at].copy_from_slice(&attributes.concat());
    Some(())
}

/// An attribute is name, zero, type, zero, size of the value as a 32-bit integer, value.
fn attribute_length(bytes: &[u8]) -> Option<usize> {
    let name = bytes.iter().position(|b| *b == 0)? + 1;
    let kind = bytes[name..].iter().position(|b| *b == 0)? + 1;
    let size = bytes.get(name + kind..name + kind + 4)?;
    let value = u32::from_le_bytes(size.try_into().ok()?) as usize;
    (name + kind + 4).checked_add(value)
}
