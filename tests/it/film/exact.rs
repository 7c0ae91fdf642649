//! A film depends on the set of its samples alone, and refuses or reports what it cannot hold.

use proptest::prelude::*;
use spectrel::film::{Film, FilmError, Pixel, Window};

fn pixel_of(samples: &[[f32; 3]]) -> Pixel {
    let mut pixel = Pixel::default();
    samples.iter().for_each(|xyz| pixel.add(*xyz));
    pixel
}

/// Any bit pattern: huge, subnormal, negative, infinite, not a number.
fn any_sample() -> impl Strategy<Value = [f32; 3]> {
    prop_oneof![
        3 => prop::array::uniform3(0.0..1e4f32),
        1 => prop::array::uniform3(any::<u32>().prop_map(f32::from_bits)),
    ]
}

/// The edges of what the film tells apart: what is cut away, gathered (below 2²⁵), in range (below 2⁴³), a number.
const EDGES: [f32; 10] =
    [0.0, -0.0, 1e-45, -1e-45, f32::MIN_POSITIVE, 33_554_432.0, 8_796_093_022_208.0, f32::MAX, f32::NAN, f32::INFINITY];

/// Forty decades beside each other, both signs, and what lies at the edges.
fn any_channel() -> impl Strategy<Value = f32> {
    let edge = (prop::sample::select(&EDGES[..]), -1..2i32, any::<bool>()).prop_map(|(edge, step, negative)| {
        let beside = f32::from_bits(edge.to_bits().saturating_add_signed(step));
        if negative { -beside } else { beside }
    });
    let decades = (-30.0..11.0f32, any::<bool>())
        .prop_map(|(decade, negative)| if negative { -10f32.powf(decade) } else { 10f32.powf(decade) });
    prop_oneof![8 => decades, 2 => 0.0..1e4f32, 1 => any::<u32>().prop_map(f32::from_bits), 1 => edge]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4096))]

    #[test]
    fn gathered_samples_are_added_samples(
        before in prop::collection::vec(any_sample(), 0..3),
        samples in prop::collection::vec(prop::array::uniform3(any_channel()), 0..50),
        cut in 0usize..50,
    ) {
        let mut gathered = pixel_of(&before);
        let (first, second) = samples.split_at(cut.min(samples.len()));
        gathered.extend(first.iter().copied());
        gathered.extend(second.iter().copied());
        prop_assert_eq!(gathered, pixel_of(&[before, samples].concat()));
    }

    /// What comes closest to rounding where samples are gathered: sums of the brightest, beside small ones that fill the last place
    /// of the upper parts, and of squares just below 1, which are all lower part.
    #[test]
    fn the_hardest_to_gather_do_not_round(
        first in prop::collection::vec(1.0..2.0f32, 0..4),
        brightest in prop::collection::vec(0x4bff_ff00u32..=0x4bff_ffff, 0..50),
        below_one in prop::collection::vec(0x3f7f_fff0u32..=0x3f7f_ffff, 0..50),
    ) {
        let bits = brightest.into_iter().chain(below_one).map(f32::from_bits);
        let samples: Vec<[f32; 3]> = first.into_iter().chain(bits).map(|x| [x, -x, x]).collect();
        let mut gathered = Pixel::default();
        gathered.extend(samples.iter().copied());
        prop_assert_eq!(gathered, pixel_of(&samples));
    }
}

proptest! {
    #[test]
    fn order_does_not_matter(
        (samples, shuffled) in prop::collection::vec(any_sample(), 0..60)
            .prop_flat_map(|s| (Just(s.clone()), Just(s).prop_shuffle()))
    ) {
        prop_assert_eq!(pixel_of(&samples), pixel_of(&shuffled));
    }

    #[test]
    fn cutting_into_parts_does_not_matter(
        samples in prop::collection::vec(any_sample(), 1..60),
        parts in prop::collection::vec(0usize..4, 60),
    ) {
        let mut split = [Pixel::default(); 4];
        samples.iter().zip(&parts).for_each(|(xyz, part)| split[*part].add(*xyz));
        let [a, b, c, d] = split;
        let (mut left, mut right, mut back) = (a, c, d);
        left.merge(&b);
        right.merge(&d);
        left.merge(&right);
        [c, b, a].iter().for_each(|p| back.merge(p));
        prop_assert_eq!(left, pixel_of(&samples));
        prop_assert_eq!(back, left);
    }

    #[test]
    fn tiles_and_sample_ranges_give_the_same_film(side in 1u32..9, cut in 0u32..6) {
        let window = Window { x0: 3, y0: 2, width: 13, height: 7 };
        let value = |x: u32, y: u32, i: u32| [0.1 + x as f32 / 3.0, 1e7 / (1 + y + i) as f32, 1e-9 * i as f32];
        let render = |window: Window, samples: std::ops::Range<u32>| {
            let mut film = Film::new([40, 20], window).unwrap();
            for i in samples {
                for y in window.y0..window.y0 + window.height {
                    for x in window.x0..window.x0 + window.width {
                        film.pixel_mut(x, y).unwrap().add(value(x, y, i));
                    }
                }
            }
            film
        };
        let whole = render(window, 0..6);
        let mut tiled = Film::new([40, 20], window).unwrap();
        window.tiles(side).for_each(|tile| tiled.merge_tile(&render(tile, cut..6)).unwrap());
        tiled.merge(&render(window, 0..cut)).unwrap();
        prop_assert_eq!(tiled, whole);
    }
}

#[test]
fn means_and_variances_are_those_of_the_samples() {
    let pixel = pixel_of(&[[1.0, 10.0, 0.1], [2.0, 20.0, 0.1], [6.0, 30.0, 0.1]]);
    let tenth = f64::from(0.1f32);
    assert_eq!(pixel.count(), 3);
    assert_eq!(pixel.mean(), [3.0, 20.0, tenth]);
    let [x, y, z] = pixel.variance_of_mean();
    assert!((x - 7.0 / 3.0).abs() < 1e-12 && (y - 100.0 / 3.0).abs() < 1e-10 && z < 1e-16);
}

#[test]
fn a_million_small_samples_beside_a_large_one_are_not_lost() {
    // In f32 the small ones vanish; in f64 their last bits do.
    let mut pixel = pixel_of(&[[1e9; 3]]);
    (0..1_000_000).for_each(|_| pixel.add([1e-6; 3]));
    let small = f64::from(1e-6f32);
    let expected = (1e9 + 1e6 * small) / 1_000_001.0;
    assert!((pixel.mean()[0] - expected).abs() / expected < 1e-15);
}

#[test]
fn unknown_variance_is_infinite() {
    assert_eq!(Pixel::default().variance_of_mean(), [f64::INFINITY; 3]);
    assert_eq!(pixel_of(&[[1.0; 3]]).variance_of_mean(), [f64::INFINITY; 3]);
    assert_eq!(Pixel::default().mean(), [0.0; 3]);
}

#[test]
fn numbers_that_are_none_are_counted_and_not_added() {
    let good = [1.0, 2.0, 3.0];
    let mut pixel = pixel_of(&[good]);
    for bad in [f32::NAN, -f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for channel in 0..3 {
            let mut sample = good;
            sample[channel] = bad;
            pixel.add(sample);
        }
    }
    assert_eq!((pixel.count(), pixel.rejected()), (1, 12));
    assert_eq!(pixel.mean(), [1.0, 2.0, 3.0]);
    assert!(!pixel.overflowed());
}

#[test]
fn range_ends_where_the_documentation_says() {
    let last = f32::from_bits((8_796_093_022_208.0f32).to_bits() - 1);
    assert!(!pixel_of(&[[last; 3]; 4]).overflowed());
    assert!(pixel_of(&[[last; 3]; 5]).overflowed(), "Σx² ≥ 2⁸⁸");
    assert!(pixel_of(&[[0.0, 0.0, 8_796_093_022_208.0]]).overflowed());
    assert!(pixel_of(&[[-f32::MAX, 0.0, 0.0], [f32::MAX, 0.0, 0.0]]).overflowed(), "cancelling does not hide it");
    assert_eq!(pixel_of(&[[f32::MAX; 3]]).variance_of_mean(), [f64::INFINITY; 3]);
}

#[test]
fn subnormal_samples_are_harmless() {
    let pixel = pixel_of(&[[1e-45, -1e-45, f32::MIN_POSITIVE]; 3]);
    assert_eq!((pixel.count(), pixel.mean()), (3, [0.0; 3]));
}

#[test]
fn windows_are_checked() {
    let inside = Window { x0: 8, y0: 8, width: 8, height: 8 };
    assert!(Film::new([16, 16], inside).is_ok());
    assert_eq!(Film::new([15, 16], inside), Err(FilmError::Outside { window: inside, image: [15, 16] }));
    assert_eq!(Film::full(0, 5), Err(FilmError::Empty));
    let wrapping = Window { x0: u32::MAX, y0: 0, width: 2, height: 1 };
    assert!(matches!(Film::new([u32::MAX, 1], wrapping), Err(FilmError::Outside { .. })));
}

#[test]
fn only_matching_films_merge() {
    let mut film = Film::full(4, 4).unwrap();
    let corner = Film::new([4, 4], Window { x0: 0, y0: 0, width: 2, height: 2 }).unwrap();
    assert!(film.merge(&corner).is_err());
    assert!(film.merge_tile(&corner).is_ok());
    assert!(film.merge_tile(&Film::full(2, 2).unwrap()).is_err(), "another image");
    let message = film.merge(&Film::full(2, 2).unwrap()).unwrap_err().to_string();
    assert!(message.contains("4 × 4 pixels at (0, 0)") && message.contains("2 × 2"), "{message}");
}

#[test]
fn pixels_outside_are_none() {
    let mut film = Film::new([9, 9], Window { x0: 2, y0: 3, width: 2, height: 2 }).unwrap();
    assert!(film.pixel_mut(2, 3).is_some() && film.pixel(3, 4).is_some());
    for (x, y) in [(1, 3), (4, 3), (2, 2), (2, 5), (u32::MAX, u32::MAX)] {
        assert!(film.pixel_mut(x, y).is_none());
    }
}

#[test]
fn images_beyond_memory_are_errors() {
    assert_eq!(Film::memory_bytes(1000, 1000), 112_000_000);
    assert_eq!(Film::memory_bytes(u32::MAX, u32::MAX), u64::MAX);
    let error = Film::full(u32::MAX, u32::MAX).unwrap_err();
    assert!(error.to_string().contains("GiB"), "{error}");
}
