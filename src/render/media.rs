//! Which medium a path is in: the solids it is inside of, by rank.
//!
//! Source: C. Schmidt, B. Budge, "Simple Nested Dielectrics in Ray Traced Images", J. Graphics Tools 7(2), 2002: where
//! solids overlap, the one of the highest rank fills the space, and the boundaries of others are not there. Here the
//! solids a path is inside of are a set, so that crossing a boundary twice the same way, as rounding may have it where a ray grazes
//! an edge, changes nothing.

use crate::scene::{Filling, MediumId};

/// A path can be inside of this many solids; of more, those of the lowest ranks are forgotten.
const DEPTH: usize = 8;

/// The solids around a point of a path, the highest rank last.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MediaStack {
    inside_of: [Filling; DEPTH],
    len: u8,
}

impl MediaStack {
    pub const OUTSIDE: Self = Self { inside_of: [Filling { rank: 0, medium: MediumId::OUTSIDE }; DEPTH], len: 0 };

    /// The medium that the path is in.
    #[inline]
    pub fn current(&self) -> MediumId {
        if self.len == 0 { MediumId::OUTSIDE } else { self.inside_of[usize::from(self.len) - 1].medium }
    }

    /// After the boundary of a solid.
    #[inline]
    pub fn across(mut self, solid: Filling, entering: bool) -> Self {
        let len = usize::from(self.len);
        let place = self.inside_of[..len].partition_point(|known| known.rank < solid.rank);
        let known = self.inside_of[..len].get(place).is_some_and(|known| known.rank == solid.rank);
        match (entering, known) {
            (true, false) => self.insert(place, solid),
            (false, true) => {
                self.inside_of.copy_within(place + 1..len, place);
                self.len -= 1;
            }
            _ => {}
        }
        self
    }

    fn insert(&mut self, place: usize, solid: Filling) {
        let len = usize::from(self.len);
        if len < DEPTH {
            self.inside_of.copy_within(place..len, place + 1);
            self.inside_of[place] = solid;
            self.len += 1;
        } else if place > 0 {
            self.inside_of.copy_within(1..place, 0);
            self.inside_of[place - 1] = solid;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn solid(rank: u32) -> Filling {
        Filling { rank, medium: MediumId(rank as u16 + 100) }
    }

    #[test]
    fn the_highest_rank_fills_the_space_in_whatever_order() {
        let (water, glass) = (solid(1), solid(2));
        for order in [[water, glass], [glass, water]] {
            let both = order.iter().fold(MediaStack::OUTSIDE, |media, &solid| media.across(solid, true));
            assert_eq!(both.current(), glass.medium);
            assert_eq!(both.across(water, false).current(), glass.medium);
            assert_eq!(both.across(glass, false).current(), water.medium);
            let none = order.iter().fold(both, |media, &solid| media.across(solid, false));
            assert_eq!(none.current(), MediumId::OUTSIDE);
        }
    }

    #[test]
    fn crossing_twice_the_same_way_changes_nothing() {
        let once = MediaStack::OUTSIDE.across(solid(3), true);
        assert_eq!(once.across(solid(3), true), once);
        assert_eq!(once.across(solid(4), false), once);
        assert_eq!(once.across(solid(3), false).across(solid(3), false).current(), MediumId::OUTSIDE);
    }

    #[test]
    fn too_deep_nesting_keeps_the_highest_ranks() {
        for order in [(0..20).collect::<Vec<_>>(), (0..20).rev().collect(), (0..20).map(|i| i * 7 % 20).collect()] {
            let mut media = order.iter().fold(MediaStack::OUTSIDE, |media, &rank| media.across(solid(rank), true));
            for rank in (12..20).rev() {
                assert_eq!(media.current(), solid(rank).medium);
                media = media.across(solid(rank), false);
            }
            assert_eq!(media.current(), MediumId::OUTSIDE);
        }
    }
}
