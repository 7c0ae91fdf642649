//! What a picture of codes says of its colours.

use super::{Curve, icc};
use crate::spectrum::Chromaticities;

#[derive(Default)]
pub(super) struct Stated {
    pub curves: Option<[Curve; 3]>,
    pub chromaticities: Option<Chromaticities>,
    pub notes: Vec<String>,
}

impl Stated {
    pub fn in_space(curve: Curve, chromaticities: Option<Chromaticities>) -> Self {
        Self { curves: Some([curve.clone(), curve.clone(), curve]), chromaticities, notes: Vec::new() }
    }

    pub fn by_profile(profile: &[u8]) -> Self {
        match icc::read(profile) {
            Some(icc::Profile { curves, chromaticities }) => {
                Self { curves: Some(curves), chromaticities, notes: Vec::new() }
            }
            None => {
                let note = "its colour profile is of a kind that is not read, other than three primaries and curves: taken for sRGB";
                Self { notes: vec![note.into()], ..Self::default() }
            }
        }
    }
}
