//! Kernels compiled for what scenes need.
//!
//! The code of a path is written once, for every set of physics; what a set has not is not compiled. A scene is rendered by the
//! smallest of [`COMPILED`] that has what it needs. Few are compiled: most parts cost a scene that does not need them next to nothing
//! once their code stands apart. Instructions a sample (callgrind) of the kernel that is chosen against one compiled for exactly what the
//! scene needs, and of the one for everything:
//!
//! | scene | needs | exactly that | chosen | everything |
//! |---|---|---|---|---|
//! | metals | light sampling, rough metal | 2932 | 2948, +0.5 % | +2.7 % |
//! | glass | light sampling, clear media | 3563 | 3593, +0.8 % | +3.6 % |
//! | diamond | light sampling, clear media, dispersion | 16289 | 16310, +0.1 % | +1.0 % |
//! | rough glass | the same, absorption, rough glass | 6186 | 6186, ±0.0 % | +1.9 % |
//!
//! (2026-11-26. Rays, films and gems have become cheaper since, in all columns alike; the differences are of that day.)
//! To measure again: a line in `kernels!` compiles another set, and it is chosen where it suffices.

use super::Kernel;
use super::path::Path;
use crate::scene::Physics;
use std::ops::Deref;

/// A kernel that runs the physics `P` and nothing else.
#[derive(Clone, Copy)]
pub struct Tracer<'a, const P: u32>(&'a Kernel<'a>);

impl<const P: u32> Tracer<'_, P> {
    /// Whether a part of the physics is compiled.
    #[inline(always)]
    pub const fn runs(part: Physics) -> bool {
        Physics(P).contains(part)
    }

    /// Whether the scene needs a part of the physics that is decided as paths go.
    #[inline]
    pub fn needs(&self, part: Physics) -> bool {
        Self::runs(part) && self.0.needs.physics.contains(part)
    }
}

impl<'a, const P: u32> Deref for Tracer<'a, P> {
    type Target = Kernel<'a>;

    #[inline(always)]
    fn deref(&self) -> &Kernel<'a> {
        self.0
    }
}

macro_rules! kernels {
    ($($physics:expr),+ $(,)?) => {
        /// The sets of physics that kernels are compiled for, the smallest first; the last one has all.
        pub const COMPILED: &[Physics] = &[$($physics,)+ Physics::ALL];

        impl Kernel<'_> {
            /// Follows a path to its end; it gathers the radiance that arrives along its ray.
            #[inline]
            pub fn follow<const N: usize>(&self, path: &mut Path<N>) {
                $(if self.physics == $physics {
                    return Tracer::<{ $physics.0 }>(self).follow(path);
                })+
                Tracer::<{ Physics::ALL.0 }>(self).follow(path)
            }
        }
    };
}

/// All but approximations, and boundaries that coincide: these two cost a scene without them 0.6 and 1.5–2.5 %.
const USUAL: Physics = Physics::LIGHT_SAMPLING
    .and(Physics::ROUGH_METAL)
    .and(Physics::TEXTURES)
    .and(Physics::CLEAR_MEDIA)
    .and(Physics::ABSORPTION)
    .and(Physics::DISPERSION)
    .and(Physics::ROUGH_GLASS);

kernels! { USUAL, USUAL.and(Physics::APPROXIMATIONS) }

/// The smallest compiled set that has all of another.
pub fn smallest(needed: Physics) -> Physics {
    COMPILED.iter().copied().find(|compiled| compiled.contains(needed)).unwrap_or(Physics::ALL)
}
