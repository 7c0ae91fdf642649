//! Eight numbers: one register where there is AVX2, an array elsewhere, with the same results to the bit.
//!
//! By name rather than as loops over lanes, of which the compiler, amid other code, makes a mixture of vectors and single numbers; and it
//! does not know `vpermps`, by which corners get to triangles. (Boxes are met by loops nevertheless: the tree's head tells why.)
//!
//! - `pick`: lanes from where a [`Choice`] says
//! - `min`, `max`: the other's number unless one's own is less, more; so the other's if one of them is NaN
//! - `above`: a bit for each lane that is above the other's
//! - [`Choice::new`]: even lanes choose by the lower half of the bits, odd ones by the upper half, each by nine bits: three for this choice,
//!   six for the two that [`Choice::next`] gives. The last two lanes choose as the first two do.

use std::ops::{Add, Div, Mul, Sub};

#[cfg(all(target_arch = "x86_64", target_feature = "avx2"))]
pub(super) use avx2::{Choice, Eight};
#[cfg(not(all(target_arch = "x86_64", target_feature = "avx2")))]
pub(super) use plain::{Choice, Eight};

/// Lanes.
pub(super) const WIDTH: usize = 8;

macro_rules! lanewise {
    ($($operation:ident $name:ident),*) => {$(
        impl $operation for Eight {
            type Output = Self;

            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                self.both(other, $operation::$name)
            }
        }
    )*};
}

#[cfg(all(target_arch = "x86_64", target_feature = "avx2"))]
mod avx2 {
    use safe_arch::*;

    use super::*;

    #[derive(Clone, Copy)]
    pub struct Eight(m256);

    #[derive(Clone, Copy)]
    pub struct Choice(m256i);

    impl Eight {
        #[inline(always)]
        pub fn new(lanes: &[f32; WIDTH]) -> Self {
            Self(m256::from_array(*lanes))
        }

        #[inline(always)]
        pub fn splat(value: f32) -> Self {
            Self(set_splat_m256(value))
        }

        #[inline(always)]
        pub fn lane(self, lane: usize) -> f32 {
            convert_to_f32_from_m256_s(shuffle_av_f32_all_m256(self.0, set_splat_i32_m256i(lane as i32)))
        }

        #[inline(always)]
        pub fn pick(self, choice: Choice) -> Self {
            Self(shuffle_av_f32_all_m256(self.0, choice.0))
        }

        #[inline(always)]
        pub fn abs(self) -> Self {
            Self(bitandnot_m256(set_splat_m256(-0.0), self.0))
        }

        #[inline(always)]
        pub fn min(self, other: Self) -> Self {
            self.both(other, min_m256)
        }

        #[inline(always)]
        pub fn max(self, other: Self) -> Self {
            self.both(other, max_m256)
        }

        #[inline(always)]
        pub fn above(self, other: Self) -> u32 {
            move_mask_m256(cmp_op_mask_m256::<{ cmp_op!(GreaterThanOrdered) }>(self.0, other.0)) as u32
        }

        #[inline(always)]
        fn both(self, other: Self, operation: impl Fn(m256, m256) -> m256) -> Self {
            Self(operation(self.0, other.0))
        }
    }

    lanewise!(Add add, Sub sub, Mul mul, Div div);

    impl Choice {
        #[inline(always)]
        pub fn new(bits: u64) -> Self {
            let shifts = m256i::from([0u32, 0, 9, 9, 18, 18, 0, 0]);
            Self(shr_each_u32_m256i(set_splat_i64_m256i(bits as i64), shifts))
        }

        #[inline(always)]
        pub fn next(self) -> Self {
            Self(shr_imm_u32_m256i::<3>(self.0))
        }
    }
}

#[cfg(any(test, not(all(target_arch = "x86_64", target_feature = "avx2"))))]
mod plain {
    use super::*;

    #[derive(Clone, Copy)]
    pub struct Eight([f32; WIDTH]);

    #[derive(Clone, Copy)]
    pub struct Choice([u32; WIDTH]);

    impl Eight {
        #[inline(always)]
        pub fn new(lanes: &[f32; WIDTH]) -> Self {
            Self(*lanes)
        }

        #[inline(always)]
        pub fn splat(value: f32) -> Self {
            Self([value; WIDTH])
        }

        #[inline(always)]
        pub fn lane(self, lane: usize) -> f32 {
            self.0[lane % WIDTH]
        }

        #[inline(always)]
        pub fn pick(self, choice: Choice) -> Self {
            Self(choice.0.map(|k| self.lane(k as usize)))
        }

        #[inline(always)]
        pub fn abs(self) -> Self {
            Self(self.0.map(f32::abs))
        }

        #[inline(always)]
        pub fn min(self, other: Self) -> Self {
            self.both(other, |a, b| if a < b { a } else { b })
        }

        #[inline(always)]
        pub fn max(self, other: Self) -> Self {
            self.both(other, |a, b| if a > b { a } else { b })
        }

        #[inline(always)]
        pub fn above(self, other: Self) -> u32 {
            (0..WIDTH).map(|k| u32::from(self.0[k] > other.0[k]) << k).sum()
        }

        #[inline(always)]
        fn both(self, other: Self, operation: impl Fn(f32, f32) -> f32) -> Self {
            Self(std::array::from_fn(|k| operation(self.0[k], other.0[k])))
        }
    }

    lanewise!(Add add, Sub sub, Mul mul, Div div);

    impl Choice {
        #[inline(always)]
        pub fn new(bits: u64) -> Self {
            Self([0, 32, 9, 41, 18, 50, 0, 32].map(|shift| (bits >> shift) as u32))
        }

        #[inline(always)]
        pub fn next(self) -> Self {
            Self(self.0.map(|k| k >> 3))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ODD: [f32; WIDTH] = [0.0, -0.0, f32::NAN, f32::INFINITY, -1.5, 1e-40, -3e38, 7.0];

    /// Bits of all lanes, of all that there is, in the same words for both.
    macro_rules! all {
        ($kind:ident, $a:expr, $b:expr, $bits:expr) => {{
            let (a, b) = ($kind::Eight::new($a), $kind::Eight::new($b));
            let choice = $kind::Choice::new($bits);
            let picks = [choice, choice.next(), choice.next().next()].map(|choice| a.pick(choice));
            let same = $kind::Eight::splat($b[0]);
            let lanes = [a + b, a - b, a * b, a / b, a.min(b), a.max(b), a.abs(), same, picks[0], picks[1], picks[2]];
            let bits = |x: f32| if x.is_nan() { u32::MAX } else { x.to_bits() };
            (lanes.map(|x| [0, 1, 2, 3, 4, 5, 6, 7].map(|k| bits(x.lane(k)))), a.above(b))
        }};
    }

    #[test]
    fn a_register_and_an_array_agree() {
        use super::super::eight as fast;
        let mut bits = 0x0123_4567_89ab_cdef_u64;
        for turn in 0..64 {
            let mut other = ODD;
            other.rotate_left(turn % WIDTH);
            bits = bits.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            assert_eq!(all!(fast, &ODD, &other, bits), all!(plain, &ODD, &other, bits), "turn {turn}");
        }
    }

    #[test]
    fn choices_are_read_nine_bits_a_lane() {
        let lanes = plain::Eight::new(&[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
        // Lane 2 is the second of the lower half: 1, 6, 3.
        let choice = plain::Choice::new(0b011_110_001 << 9);
        let [a, b, c] = [choice, choice.next(), choice.next().next()].map(|choice| lanes.pick(choice).lane(2));
        assert_eq!([a, b, c], [1.0, 6.0, 3.0]);
    }
}
