//! Which medium a path is in: the solids it has entered and not yet left.

use crate::scene::MediumId;

/// Solids can be nested this deep; entering more keeps the medium that was innermost.
const DEPTH: usize = 8;

/// The media around a point of a path, the innermost last; outside of all solids is [`MediumId::OUTSIDE`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MediaStack {
    entered: [MediumId; DEPTH],
    len: u8,
}

impl MediaStack {
    pub const OUTSIDE: Self = Self { entered: [MediumId::OUTSIDE; DEPTH], len: 0 };

    /// The medium that the path is in.
    #[inline]
    pub fn current(&self) -> MediumId {
        if self.len == 0 { MediumId::OUTSIDE } else { self.entered[usize::from(self.len) - 1] }
    }

    /// Goes through the boundary of a solid.
    #[inline]
    pub fn cross(&mut self, medium: MediumId, entering: bool) {
        match entering {
            true => self.enter(medium),
            false => self.leave(medium),
        }
    }

    #[inline]
    fn enter(&mut self, medium: MediumId) {
        if usize::from(self.len) < DEPTH {
            self.entered[usize::from(self.len)] = medium;
            self.len += 1;
        }
    }

    /// Takes the innermost solid of `medium` away, wherever it stands: overlapping solids are left in any order.
    #[inline]
    pub fn leave(&mut self, medium: MediumId) {
        let len = usize::from(self.len);
        if let Some(at) = self.entered[..len].iter().rposition(|&entered| entered == medium) {
            self.entered.copy_within(at + 1..len, at);
            self.len -= 1;
        }
    }

    /// The medium on the other side when `medium` is left.
    #[inline]
    pub fn without(mut self, medium: MediumId) -> MediumId {
        self.leave(medium);
        self.current()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nested_media_are_left_in_any_order() {
        let (water, glass) = (MediumId(1), MediumId(2));
        let mut media = MediaStack::OUTSIDE;
        assert_eq!(media.current(), MediumId::OUTSIDE);
        media.enter(water);
        media.enter(glass);
        assert_eq!(media.current(), glass);
        assert_eq!(media.without(glass), water);
        assert_eq!(media.without(water), glass);
        media.leave(water);
        assert_eq!(media.current(), glass);
        media.leave(glass);
        assert_eq!(media, MediaStack { len: 0, ..media });
        media.leave(glass);
        assert_eq!(media.current(), MediumId::OUTSIDE);
    }

    #[test]
    fn too_deep_nesting_is_harmless() {
        let mut media = MediaStack::OUTSIDE;
        (0..20).for_each(|i| media.enter(MediumId(i)));
        assert_eq!(media.current(), MediumId(7));
    }
}
