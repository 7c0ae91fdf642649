//! Which medium a path is in: the solids it is inside of, by rank.
//!
//! Source: C. Schmidt, B. Budge, "Simple Nested Dielectrics in Ray Traced Images", J. Graphics Tools 7(2), 2002: where
//! solids overlap, the one of the highest rank fills the space, and the boundaries of others are not there. Here the
//! solids a path is inside of are a set, so that crossing a boundary twice the same way, as rounding may have it where a ray grazes
//! an edge, changes nothing.
//!
//! A path carries the highest ranks itself. The others, of which most scenes have none, are a
//! number that stands for their list in [`Buried`], which all paths of a kernel share: a path stays
//! a plain value, and nothing limits how deep solids are nested.

use crate::scene::{Filling, MediumId};
use std::collections::HashMap;
use std::sync::{PoisonError, RwLock};

/// So many solids are known to a path without a look into the lists.
const DEPTH: usize = 8;

/// The solids around a point of a path, the highest rank last.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MediaStack {
    inside_of: [Filling; DEPTH],
    /// Those of lower ranks; none unless there are [`DEPTH`] above them.
    below: ListId,
    len: u8,
}

impl MediaStack {
    pub const OUTSIDE: Self =
        Self { inside_of: [Filling { rank: 0, medium: MediumId::OUTSIDE }; DEPTH], below: ListId::EMPTY, len: 0 };

    /// The medium that the path is in.
    #[inline]
    pub fn current(&self) -> MediumId {
        if self.len == 0 { MediumId::OUTSIDE } else { self.inside_of[usize::from(self.len) - 1].medium }
    }

    /// After the boundary of a solid.
    #[inline]
    pub fn across(mut self, solid: Filling, entering: bool, buried: &Buried) -> Self {
        let len = usize::from(self.len);
        let place = self.inside_of[..len].partition_point(|known| known.rank < solid.rank);
        let known = self.inside_of[..len].get(place).is_some_and(|known| known.rank == solid.rank);
        if len == DEPTH {
            return self.across_when_full((place, known), solid, entering, buried);
        }
        match (entering, known) {
            (true, false) => {
                self.inside_of.copy_within(place..len, place + 1);
                self.inside_of[place] = solid;
                self.len += 1;
            }
            (false, true) => {
                self.inside_of.copy_within(place + 1..len, place);
                self.len -= 1;
            }
            _ => {}
        }
        self
    }

    /// The same where the lowest rank here may have others below it.
    #[cold]
    #[inline(never)]
    fn across_when_full(
        mut self,
        (place, known): (usize, bool),
        solid: Filling,
        entering: bool,
        buried: &Buried,
    ) -> Self {
        match (entering, known) {
            (_, false) if place == 0 => self.below = buried.changed(self.below, solid, entering),
            (true, false) => {
                self.below = buried.changed(self.below, self.inside_of[0], true);
                self.inside_of.copy_within(1..place, 0);
                self.inside_of[place - 1] = solid;
            }
            (false, true) => {
                self.inside_of.copy_within(..place, 1);
                match buried.parted(self.below) {
                    Some((highest, below)) => (self.inside_of[0], self.below) = (highest, below),
                    None => {
                        self.inside_of.copy_within(1.., 0);
                        self.len -= 1;
                    }
                }
            }
            _ => {}
        }
        self
    }
}

/// A list of [`Buried`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct ListId(u32);

impl ListId {
    const EMPTY: Self = Self(0);

    /// Its place in the table, which has no row for the empty one.
    fn row(self) -> Option<usize> {
        (self.0 as usize).checked_sub(1)
    }
}

/// Lists of solids in the order of their ranks, each of which has one number however it came about.
#[derive(Debug, Default)]
pub struct Buried(RwLock<Table>);

/// A list is its solid of the highest rank and a list of those below.
#[derive(Debug, Default)]
struct Table {
    rows: Vec<(Filling, ListId)>,
    numbers: HashMap<(Filling, ListId), ListId>,
}

impl Buried {
    /// A list with a solid more, or without it.
    fn changed(&self, list: ListId, solid: Filling, with: bool) -> ListId {
        match self.parted(list) {
            Some((highest, below)) if highest.rank > solid.rank => {
                self.joined(highest, self.changed(below, solid, with))
            }
            Some((highest, below)) if highest.rank == solid.rank => {
                if with {
                    list
                } else {
                    below
                }
            }
            _ if with => self.joined(solid, list),
            _ => list,
        }
    }

    /// The highest rank of a list and the others, unless it is empty.
    fn parted(&self, list: ListId) -> Option<(Filling, ListId)> {
        let table = self.0.read().unwrap_or_else(PoisonError::into_inner);
        table.rows.get(list.row()?).copied()
    }

    fn joined(&self, highest: Filling, below: ListId) -> ListId {
        let row = (highest, below);
        let known = self.0.read().unwrap_or_else(PoisonError::into_inner).numbers.get(&row).copied();
        known.unwrap_or_else(|| self.0.write().unwrap_or_else(PoisonError::into_inner).add(row))
    }
}

impl Table {
    /// Another thread may have added it meanwhile.
    fn add(&mut self, row: (Filling, ListId)) -> ListId {
        *self.numbers.entry(row).or_insert_with(|| {
            self.rows.push(row);
            ListId(self.rows.len() as u32)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    fn solid(rank: u32) -> Filling {
        Filling { rank, medium: MediumId(rank as u16 + 100) }
    }

    #[test]
    fn the_highest_rank_fills_the_space_in_whatever_order() {
        let buried = Buried::default();
        let (water, glass) = (solid(1), solid(2));
        for order in [[water, glass], [glass, water]] {
            let both = order.iter().fold(MediaStack::OUTSIDE, |media, &solid| media.across(solid, true, &buried));
            assert_eq!(both.current(), glass.medium);
            assert_eq!(both.across(water, false, &buried).current(), glass.medium);
            assert_eq!(both.across(glass, false, &buried).current(), water.medium);
            let none = order.iter().fold(both, |media, &solid| media.across(solid, false, &buried));
            assert_eq!(none.current(), MediumId::OUTSIDE);
        }
    }

    #[test]
    fn crossing_twice_the_same_way_changes_nothing() {
        let buried = Buried::default();
        let once = MediaStack::OUTSIDE.across(solid(3), true, &buried);
        assert_eq!(once.across(solid(3), true, &buried), once);
        assert_eq!(once.across(solid(4), false, &buried), once);
        let out = once.across(solid(3), false, &buried).across(solid(3), false, &buried);
        assert_eq!(out.current(), MediumId::OUTSIDE);
    }

    /// Against a set of ranks, through many crossings that now and then go deep; equal sets are
    /// equal however they came about.
    #[test]
    fn any_depth_is_a_set() {
        let buried = Buried::default();
        let (mut media, mut set, mut random, mut deepest) = (MediaStack::OUTSIDE, BTreeSet::new(), 1u32, 0);
        for step in 0..20_000u32 {
            random = random.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
            let (rank, deeper) = ((random >> 8) % 40 + 1, (step / 500).is_multiple_of(2));
            let entering = if random >> 28 < 4 { !deeper } else { deeper };
            media = media.across(solid(rank), entering, &buried);
            if entering {
                set.insert(rank)
            } else {
                set.remove(&rank)
            };
            deepest = deepest.max(set.len());
            let expected = set.last().map_or(MediumId::OUTSIDE, |&rank| solid(rank).medium);
            assert_eq!(media.current(), expected, "{set:?}");
            if step.is_multiple_of(100) {
                let again =
                    set.iter().fold(MediaStack::OUTSIDE, |media, &rank| media.across(solid(rank), true, &buried));
                let all_out = (1..41).fold(again, |media, rank| media.across(solid(rank), false, &buried));
                assert_eq!((again.current(), again.below, all_out.len), (media.current(), media.below, 0));
            }
        }
        assert!(deepest > 30, "{deepest}");
    }
}
