//! Which published data sets describe the same material.
//!
//! Sets of one folder of `spectra/ior` are of one element or compound, which is not yet one material: carbon is diamond and graphite. So a
//! set that no material stands on belongs to the material of its folder whose F0 looks most like its own (CIEDE2000), but
//!
//! - a clear set and an opaque one are of two materials;
//! - of another axis of a crystal (names that end in `-o`, `-e`, `-alpha` …) it is another index of the same crystal, and belongs to none;
//! - in the folder of a mixture (`Cu-Zn`), another composition is another material.

use super::Instrument;
use crate::spectrum::{HELIUM_D_NM, Ior, Library, Quantity, SpectrumError};
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

/// The data sets of the materials of a library.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Families {
    /// By the set that a material stands on: the others, sorted.
    others: BTreeMap<String, Vec<String>>,
}

impl Families {
    /// `primaries` are the sets that materials stand on.
    pub fn new(primaries: &[Arc<Ior>], library: &Library, instrument: &Instrument) -> Result<Self, SpectrumError> {
        let mut families = Self::default();
        families.others.extend(primaries.iter().map(|primary| (primary.about.name.clone(), Vec::new())));
        for set in library.names(Quantity::Ior) {
            let akin: Vec<_> = primaries.iter().filter(|primary| may_be_same(&primary.about.name, &set)).collect();
            if families.others.contains_key(&set) || akin.is_empty() {
                continue;
            }
            let ior = library.ior(&set, Path::new(""))?;
            let distance = |primary: &Ior| instrument.difference(instrument.f0(primary), instrument.f0(&ior));
            let alike = akin.into_iter().filter(|primary| is_clear(primary) == is_clear(&ior));
            if let Some(nearest) = alike.min_by(|a, b| distance(a).total_cmp(&distance(b))) {
                families.others.entry(nearest.about.name.clone()).or_default().push(set);
            }
        }
        Ok(families)
    }

    /// All sets of the material that `set` describes, `set` first; alone if it belongs to none.
    pub fn of(&self, set: &str) -> Vec<String> {
        let family = self.others.iter().find(|(primary, others)| *primary == set || others.iter().any(|o| o == set));
        let members = family.into_iter().flat_map(|(primary, others)| std::iter::once(primary).chain(others));
        std::iter::once(set.to_owned()).chain(members.filter(|member| *member != set).cloned()).collect()
    }
}

/// A k below this lets light through a thousandth of a millimetre.
const CLEAR_K: f64 = 1e-2;

fn is_clear(ior: &Ior) -> bool {
    ior.at(HELIUM_D_NM).1 < CLEAR_K
}

fn may_be_same(a: &str, b: &str) -> bool {
    let folder = |set: &str| set.split_once('/').map(|(folder, _)| folder.to_owned());
    let mixture = folder(a).is_some_and(|folder| folder.contains('-'));
    let same_axis = match (axis(a), axis(b)) {
        (Some(a), Some(b)) => a == b,
        _ => true,
    };
    folder(a).is_some() && folder(a) == folder(b) && !mixture && same_axis
}

/// The axis of a crystal that a set's name ends in.
fn axis(set: &str) -> Option<&str> {
    let (_, last) = set.rsplit_once('-')?;
    ["o", "e", "alpha", "beta", "gamma"].contains(&last).then_some(last)
}

#[cfg(test)]
mod tests {
    use super::super::Conditions;
    use super::*;

    #[test]
    fn a_folder_may_hold_several_materials() {
        let library = Library::default();
        let instrument = Instrument::new(Conditions::default(), &library).unwrap();
        let primaries = [
            "C/peter-1923",
            "C/song-2018-hopg-o",
            "C/song-2018-hopg-e",
            "H2O/daimon-2007-20c",
            "H2O/warren-brandt-2008-ice",
            "Fe2O3/querry-1985-o",
            "Au-Ag/rioux-2014-au50ag50",
            "Cr/rakic-1998-bb",
        ];
        let primaries = primaries.map(|set| library.ior(set, Path::new("")).unwrap());
        let families = Families::new(&primaries, &library, &instrument).unwrap();
        assert_eq!(families.of("C/peter-1923"), ["C/peter-1923"]);
        let graphite = ["C/song-2018-hopg-o", "C/djurisic-1999-graphite-o", "C/querry-1985-pyrolytic"];
        assert_eq!(families.of("C/song-2018-hopg-o"), graphite);
        assert_eq!(families.of("H2O/daimon-2007-20c"), ["H2O/daimon-2007-20c", "H2O/hale-querry-1973"]);
        assert_eq!(families.of("H2O/warren-brandt-2008-ice"), ["H2O/warren-brandt-2008-ice"]);
        assert_eq!(families.of("Fe2O3/querry-1985-o"), ["Fe2O3/querry-1985-o"]);
        assert_eq!(families.of("Au-Ag/rioux-2014-au50ag50"), ["Au-Ag/rioux-2014-au50ag50"]);
        // Whichever is asked for comes first.
        let chromium = ["Cr/johnson-christy-1974", "Cr/rakic-1998-bb", "Cr/rakic-1998-ld"];
        assert_eq!(families.of("Cr/johnson-christy-1974"), chromium);
        assert_eq!(families.of("mine.csv"), ["mine.csv"]);
    }
}
