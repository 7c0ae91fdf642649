//! The wavelengths of one path: which place of the tables it reads.

use super::{SpectrumId, Tables};
use crate::math::Lanes;

/// N wavelengths of a path and the tables that know every spectrum at them.
///
/// Nobody else carries a place in the tables.
#[derive(Clone, Copy)]
pub struct Wavelengths<'a, const N: usize> {
    tables: &'a Tables,
    offset: u32,
}

impl<'a, const N: usize> Wavelengths<'a, N> {
    /// Returns those of a set, 0 … [`Tables::sets`]; N is the number of lanes that the tables were made for.
    #[inline]
    pub fn new(tables: &'a Tables, set: u32) -> Self {
        Self { tables, offset: set * N as u32 }
    }

    /// Returns a spectrum's values.
    #[inline]
    pub fn at(&self, id: SpectrumId) -> Lanes<N> {
        self.tables.get(id, self.offset)
    }

    /// Returns where the wavelengths stand in the visible range, 0…1, once [`Tables::push_positions`] has told.
    #[inline]
    pub fn positions(&self) -> Lanes<N> {
        self.tables.positions(self.offset)
    }

    /// Returns one of them, to go on alone.
    #[inline]
    pub fn lane(&self, lane: usize) -> Wavelengths<'a, 1> {
        Wavelengths { tables: self.tables, offset: self.offset + lane as u32 }
    }

    /// Returns the first lane's place among all places of the tables.
    #[inline]
    pub(super) fn place(&self) -> usize {
        self.offset as usize
    }
}
