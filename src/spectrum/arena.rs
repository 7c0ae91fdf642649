//! The spectra of a scene, each once, and their values at the nodes that a render uses.

use super::{Lanes, NODE_COUNT, Nodes, Spectrum};

/// One spectrum of an [`Arena`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct SpectrumId(u32);

/// Every spectrum that a scene refers to. Adding an equal one gives the same id.
#[derive(Clone, Debug, Default)]
pub struct Arena {
    spectra: Vec<Spectrum>,
}

impl Arena {
    pub fn add(&mut self, spectrum: Spectrum) -> SpectrumId {
        let known = self.spectra.iter().position(|other| *other == spectrum);
        let index = known.unwrap_or_else(|| {
            self.spectra.push(spectrum);
            self.spectra.len() - 1
        });
        SpectrumId(index as u32)
    }

    pub fn get(&self, id: SpectrumId) -> &Spectrum {
        &self.spectra[id.0 as usize]
    }

    pub fn len(&self) -> usize {
        self.spectra.len()
    }

    pub fn is_empty(&self) -> bool {
        self.spectra.is_empty()
    }

    /// The values of every spectrum at every node, for paths of `lanes` wavelengths.
    pub fn tabulate(&self, nodes: &Nodes, lanes: usize) -> Tables {
        let mut tables = Tables { values: Vec::with_capacity(self.len() * NODE_COUNT), lanes };
        for spectrum in &self.spectra {
            tables.push(&nodes.tabulate(spectrum));
        }
        tables
    }
}

/// Values by spectrum, set and lane: the lanes of a set lie together, so a path's lookup is one load.
///
/// An offset names a place in a set's order: `set × lanes` for the whole set, `+ lane` for one lane that goes on alone.
#[derive(Clone, Debug)]
pub struct Tables {
    values: Vec<f32>,
    lanes: usize,
}

impl Tables {
    /// Appends one more table given by node, and tells its id.
    pub fn push(&mut self, by_node: &[f32]) -> SpectrumId {
        let id = SpectrumId((self.values.len() / NODE_COUNT) as u32);
        let sets = NODE_COUNT / self.lanes;
        self.values.extend((0..NODE_COUNT).map(|offset| by_node[offset / self.lanes + offset % self.lanes * sets]));
        id
    }

    /// How many sets of wavelengths there are.
    pub fn sets(&self) -> u32 {
        (NODE_COUNT / self.lanes) as u32
    }

    #[inline]
    pub fn get<const N: usize>(&self, id: SpectrumId, offset: u32) -> Lanes<N> {
        let start = id.0 as usize * NODE_COUNT + offset as usize;
        let lanes = &self.values[start..start + N];
        Lanes(std::array::from_fn(|lane| lanes[lane]))
    }
}
