//! The spectra of a scene, each once, and their values at the nodes that a render uses.

use super::{LUMENS_PER_WATT, NODE_COUNT, Nodes, Sigmoid, Spectrum, Xyz};
use crate::math::Lanes;

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
        let mut tables = Tables { values: Vec::with_capacity(self.len() * NODE_COUNT), lanes, positions: None };
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
    positions: Option<SpectrumId>,
}

impl Tables {
    /// Appends one more table given by node, and tells its id.
    pub fn push(&mut self, by_node: &[f32]) -> SpectrumId {
        let id = SpectrumId((self.values.len() / NODE_COUNT) as u32);
        let sets = NODE_COUNT / self.lanes;
        self.values.extend((0..NODE_COUNT).map(|offset| by_node[offset / self.lanes + offset % self.lanes * sets]));
        id
    }

    /// Appends what turns the spectral radiances of a set (W m⁻² sr⁻¹ nm⁻¹) into X, Y and Z (cd/m²), given the observer's
    /// weight at each node in nm: the mean over the sets of the sums over lanes is the integral.
    pub fn push_observer(&mut self, by_node: &[Xyz]) -> [SpectrumId; 3] {
        let scale = f64::from(self.sets()) * LUMENS_PER_WATT;
        [0, 1, 2].map(|axis| self.push(&by_node.iter().map(|weight| (weight[axis] * scale) as f32).collect::<Vec<_>>()))
    }

    /// Appends where the nodes stand in the visible range, 0…1: what a [`Tint`](super::Tint) is computed from.
    pub fn push_positions(&mut self, nodes: &Nodes) {
        let by_node: Vec<f32> = (0..NODE_COUNT).map(|i| Sigmoid::position(nodes.wavelength_nm(i)) as f32).collect();
        self.positions = Some(self.push(&by_node));
    }

    /// Where the lanes stand in the visible range, 0…1, once [`Self::push_positions`] has told.
    #[inline]
    pub(super) fn positions<const N: usize>(&self, offset: u32) -> Lanes<N> {
        self.positions.map_or(Lanes::ZERO, |id| self.get(id, offset))
    }

    /// How many sets of wavelengths there are.
    pub fn sets(&self) -> u32 {
        (NODE_COUNT / self.lanes) as u32
    }

    #[inline]
    pub(super) fn get<const N: usize>(&self, id: SpectrumId, offset: u32) -> Lanes<N> {
        let start = id.0 as usize * NODE_COUNT + offset as usize;
        let lanes = &self.values[start..start + N];
        Lanes(std::array::from_fn(|lane| lanes[lane]))
    }
}

#[cfg(test)]
mod tests {
    use super::super::density::of_lines;
    use super::super::{Density, Line};
    use super::*;

    #[test]
    fn equal_spectra_are_kept_once() {
        let mut arena = Arena::default();
        let ids = [1.0, 2.0, 1.0].map(|value| arena.add(Spectrum::Constant(value)));
        assert_eq!((ids[0], arena.len()), (ids[2], 2));
        assert_eq!(arena.get(ids[1]), &Spectrum::Constant(2.0));
    }

    #[test]
    fn sets_of_one_and_of_eight_are_the_same_nodes() {
        let nodes = Nodes::new(&Density::visible());
        let mut arena = Arena::default();
        arena.add(Spectrum::Constant(3.0));
        let id = arena.add(Spectrum::Blackbody { kelvin: 3000.0 });
        let (ones, eights) = (arena.tabulate(&nodes, 1), arena.tabulate(&nodes, 8));
        assert_eq!((ones.sets(), eights.sets()), (2048, 256));
        for set in 0..256 {
            let together = eights.get::<8>(id, set * 8);
            for lane in 0..8 {
                assert_eq!(together[lane], ones.get::<1>(id, set + 256 * lane as u32)[0]);
                assert_eq!(together[lane], eights.get::<1>(id, set * 8 + lane as u32)[0]);
            }
        }
    }

    #[test]
    fn every_set_of_eight_sees_each_of_a_few_lines() {
        let nodes = Nodes::new(&of_lines(&[546.074, 589.3]));
        let mut arena = Arena::default();
        let id = arena.add(Spectrum::Lines(vec![Line { nm: 546.074, power: 1.0 }]));
        let tables = arena.tabulate(&nodes, 8);
        assert!((0..256).all(|set| tables.get::<8>(id, set * 8).max() > 0.0));
    }
}
