//! Typed views into buffers.

use std::ops::Range;

use super::super::error::Fault;
use super::container::Buffers;
use super::json::{Accessor, BufferView, Root};

/// The type of a number.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Kind {
    fn of(code: u32) -> Result<Self, String> {
        Ok(match code {
            5120 => Kind::I8,
            5121 => Kind::U8,
            5122 => Kind::I16,
            5123 => Kind::U16,
            5125 => Kind::U32,
            5126 => Kind::F32,
            _ => return Err(format!("{code} is no type of a component")),
        })
    }

    fn size(self) -> usize {
        match self {
            Kind::I8 | Kind::U8 => 1,
            Kind::I16 | Kind::U16 => 2,
            Kind::U32 | Kind::F32 => 4,
        }
    }

    /// The number at the beginning of `bytes`; normalised integers are fractions of their largest.
    #[inline]
    fn number(self, bytes: &[u8], normalized: bool) -> Option<f64> {
        let (value, largest) = match self {
            Kind::I8 => (i8::from_le_bytes(*bytes.first_chunk()?).into(), 127.0),
            Kind::U8 => (u8::from_le_bytes(*bytes.first_chunk()?).into(), 255.0),
            Kind::I16 => (i16::from_le_bytes(*bytes.first_chunk()?).into(), 32767.0),
            Kind::U16 => (u16::from_le_bytes(*bytes.first_chunk()?).into(), 65535.0),
            Kind::U32 => (u32::from_le_bytes(*bytes.first_chunk()?).into(), 4294967295.0),
            Kind::F32 => return Some(f32::from_le_bytes(*bytes.first_chunk()?).into()),
        };
        Some(if normalized { f64::max(value / largest, -1.0) } else { value })
    }
}

/// Elements that all lie within their view.
struct Elements<'a> {
    bytes: &'a [u8],
    stride: usize,
    kind: Kind,
    normalized: bool,
}

impl Elements<'_> {
    #[inline]
    fn get<const N: usize>(&self, index: usize) -> [f64; N] {
        let element = self.bytes.get(index.saturating_mul(self.stride)..).unwrap_or_default();
        std::array::from_fn(|i| {
            let bytes = element.get(i * self.kind.size()..);
            bytes.and_then(|bytes| self.kind.number(bytes, self.normalized)).unwrap_or(f64::NAN)
        })
    }
}

/// All accessors of a document.
pub(super) struct Accessors<'a> {
    root: &'a Root,
    buffers: &'a Buffers<'a>,
}

impl<'a> Accessors<'a> {
    pub fn new(root: &'a Root, buffers: &'a Buffers<'a>) -> Self {
        Self { root, buffers }
    }

    fn get(&self, index: usize) -> Result<&'a Accessor, Fault> {
        self.root.accessors.get(index).ok_or_else(|| Fault::new(format!("there is no accessor {index}")))
    }

    pub fn count(&self, index: usize) -> Result<usize, Fault> {
        Ok(self.get(index)?.count)
    }

    /// Those elements of an accessor whose indices are in the range, which must end within its count.
    pub fn vectors<const N: usize>(&self, index: usize, range: Range<usize>) -> Result<Vec<[f64; N]>, Fault> {
        self.read(index, range).map_err(|problem| problem.of_accessor(index))
    }

    /// Whole numbers, as the indices of triangles.
    pub fn indices(&self, index: usize) -> Result<Vec<u32>, Fault> {
        let accessor = self.get(index)?;
        if !matches!(accessor.component_type, 5121 | 5123 | 5125) {
            return Err(Fault::new(format!("accessor {index}: indices must be unsigned integers")));
        }
        let numbers = self.vectors::<1>(index, 0..accessor.count)?;
        Ok(numbers.into_iter().map(|[number]| number as u32).collect())
    }

    fn read<const N: usize>(&self, index: usize, range: Range<usize>) -> Result<Vec<[f64; N]>, Problem> {
        let accessor = self.get(index)?;
        let expected = ["SCALAR", "VEC2", "VEC3", "VEC4"].get(N - 1).copied().unwrap_or("SCALAR");
        if accessor.shape != expected {
            return Err(format!("it is of type {}, expected {expected}", accessor.shape).into());
        }
        let kind = Kind::of(accessor.component_type)?;
        let mut values = match accessor.buffer_view {
            Some(view) => {
                let elements =
                    self.elements(view, accessor.byte_offset, kind, N, accessor.count, accessor.normalized)?;
                range.clone().map(|i| elements.get(i)).collect()
            }
            // All zero, but for what is sparse: nothing behind it limits the count.
            None if accessor.count > self.buffers.total() => {
                return Err(format!("its {} elements are more than the bytes of all buffers", accessor.count).into());
            }
            None => vec![[0.0; N]; range.len()],
        };
        if let Some(sparse) = &accessor.sparse {
            let places = &sparse.indices;
            let kind_of_places = Kind::of(places.component_type)?;
            let places =
                self.elements(places.buffer_view, places.byte_offset, kind_of_places, 1, sparse.count, false)?;
            let (view, offset) = (sparse.values.buffer_view, sparse.values.byte_offset);
            let changed = self.elements(view, offset, kind, N, sparse.count, accessor.normalized)?;
            for i in 0..sparse.count {
                let [place] = places.get(i);
                if !(place >= 0.0 && place < accessor.count as f64) {
                    return Err(format!("its sparse element {i} is at {place} of {}", accessor.count).into());
                }
                let slot = (place as usize).checked_sub(range.start).and_then(|place| values.get_mut(place));
                if let Some(slot) = slot {
                    *slot = changed.get(i);
                }
            }
        }
        Ok(values)
    }

    fn elements(
        &self,
        view: usize,
        offset: usize,
        kind: Kind,
        components: usize,
        count: usize,
        normalized: bool,
    ) -> Result<Elements<'a>, Problem> {
        let described = self.root.buffer_views.get(view).ok_or_else(|| format!("there is no buffer view {view}"))?;
        let size = kind.size() * components;
        let stride = described.byte_stride.unwrap_or(size);
        if stride < size {
            return Err(format!("the stride of {stride} bytes is less than the {size} of an element").into());
        }
        let bytes = self.view(described, view)?;
        let needed = count.checked_sub(1).map_or(Some(0), |last| last.checked_mul(stride)?.checked_add(size));
        let bytes = bytes.get(offset..).filter(|bytes| needed.is_some_and(|needed| needed <= bytes.len()));
        match bytes {
            Some(bytes) => Ok(Elements { bytes, stride, kind, normalized }),
            None => {
                let length = described.byte_length;
                Err(format!("{count} elements from byte {offset} reach beyond the {length} bytes of view {view}")
                    .into())
            }
        }
    }

    fn view(&self, view: &BufferView, index: usize) -> Result<&'a [u8], Problem> {
        let buffer = self.buffers.get(view.buffer)?;
        let end = view.byte_offset.checked_add(view.byte_length);
        let bytes = end.and_then(|end| buffer.get(view.byte_offset..end));
        Ok(bytes.ok_or_else(|| {
            let (length, offset, name) = (view.byte_length, view.byte_offset, view.buffer);
            format!("view {index} of {length} bytes from {offset} reaches beyond buffer {name} of {}", buffer.len())
        })?)
    }
}

/// What is wrong with an accessor, or with what stands behind it.
enum Problem {
    Own(String),
    Other(Fault),
}

impl Problem {
    fn of_accessor(self, index: usize) -> Fault {
        match self {
            Problem::Own(message) => Fault::new(format!("accessor {index}: {message}")),
            Problem::Other(fault) => fault,
        }
    }
}

impl From<String> for Problem {
    fn from(message: String) -> Self {
        Problem::Own(message)
    }
}

impl From<Fault> for Problem {
    fn from(fault: Fault) -> Self {
        Problem::Other(fault)
    }
}
