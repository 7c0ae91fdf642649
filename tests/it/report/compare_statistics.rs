//! What a comparison says of pictures whose truth is known: drawn here, with noise of known size.

use crate::common::random::Random;
use spectrel::film::{Unseen, View};
use spectrel::report::difference::{Image, compare};
use spectrel::report::{Difference, Verdict};
use spectrel::spectrum::RgbSpace;

const REPLICATES: usize = 8;
const PIXELS: usize = 24 * 24;

fn view() -> View {
    View::new(0.0, RgbSpace::Srgb.white_xyz())
}

/// The truth: smooth greys and colours; `change` times as bright.
fn truth(change: f64) -> Vec<[f64; 3]> {
    let at = |i: usize| {
        let part = i as f64 / PIXELS as f64;
        [0.1 + 0.6 * part, 0.2 + 0.3 * part, 0.5 - 0.3 * part].map(|c| c * change)
    };
    (0..PIXELS).map(at).collect()
}

/// Replicates of a truth with exponential noise, which is as skewed as that of path tracing.
fn noisy(truth: &[[f64; 3]], noise: f64, random: &mut Random) -> Vec<Image> {
    let mut excess = || -f64::from(1.0 - random.unit()).ln() - 1.0;
    let mut pixel = |xyz: &[f64; 3]| xyz.map(|c| (c * (1.0 + noise * excess())) as f32);
    (0..REPLICATES).map(|_| truth.iter().map(&mut pixel).collect()).collect()
}

/// Replicates with the random numbers of others: scaled.
fn scaled(replicates: &[Image], by: f32) -> Vec<Image> {
    replicates.iter().map(|image| image.iter().map(|xyz| xyz.map(|c| c * by)).collect()).collect()
}

fn trials(count: u64, mut one: impl FnMut(&mut Random) -> Difference) -> Vec<Difference> {
    (0..count).map(|trial| one(&mut Random(trial.wrapping_mul(0x9e37_79b9_7f4a_7c15)))).collect()
}

fn share(found: &[Difference], holds: impl Fn(&Difference) -> bool) -> f64 {
    found.iter().filter(|difference| holds(difference)).count() as f64 / found.len() as f64
}

#[test]
fn noise_alone_is_no_difference() {
    let found = trials(200, |random| {
        let (a, b) = (noisy(&truth(1.0), 0.1, random), noisy(&truth(1.0), 0.1, random));
        compare(&view(), &a, &b, &Unseen::NOTHING).difference
    });
    // At most 3.5 % nominally, 2.5 % by colour and 1 % by energy; of 200 trials 5 % is more than a standard deviation above that.
    let alarms = share(&found, |difference| difference.verdict != Verdict::Indistinguishable);
    assert!(alarms <= 0.05, "{alarms}");
    let size = |of: fn(f64) -> f64| found.iter().map(|found| of(found.delta_e2000.beyond_noise)).sum::<f64>() / 200.0;
    assert!(size(|value| value).abs() < 0.2 * size(f64::abs), "biased");
    // Where there is nothing, the measured ΔE is that of noise.
    for difference in &found {
        let delta_e = &difference.delta_e2000;
        assert!((delta_e.mean / delta_e.noise - 1.0).abs() < 0.2, "{delta_e:?}");
        assert!((difference.rmse / difference.rmse_noise - 1.0).abs() < 0.25, "{difference:?}");
    }
}

/// As of paths that part at a random choice: the pictures of a replicate are the same but in a few pixels, where they have nothing
/// to do with each other. No replicate agrees with another about such a difference.
#[test]
fn rare_strong_noise_is_no_difference() {
    let found = trials(200, |random| {
        let a = noisy(&truth(1.0), 0.3, random);
        let mut b = a.clone();
        for xyz in b.iter_mut().flatten() {
            if random.unit() < 0.03 {
                *xyz = xyz.map(|c| c * if random.unit() < 0.5 { 0.5 } else { 1.5 });
            }
        }
        compare(&view(), &a, &b, &Unseen::NOTHING).difference
    });
    let alarms = share(&found, |difference| difference.verdict != Verdict::Indistinguishable);
    assert!(alarms <= 0.05, "{alarms}");
}

#[test]
fn a_small_difference_is_found_with_the_same_random_numbers_only() {
    let change = 1.005;
    let paired = trials(40, |random| {
        let a = noisy(&truth(1.0), 0.3, random);
        compare(&view(), &a, &scaled(&a, change as f32), &Unseen::NOTHING).difference
    });
    let independent = trials(40, |random| {
        let (a, b) = (noisy(&truth(1.0), 0.3, random), noisy(&truth(change), 0.3, random));
        compare(&view(), &a, &b, &Unseen::NOTHING).difference
    });
    let differs = |difference: &Difference| difference.verdict == Verdict::Different;
    assert_eq!(share(&paired, differs), 1.0);
    assert!(share(&independent, differs) < 0.2);
    for (paired, independent) in paired.iter().zip(&independent) {
        assert!(paired.rmse_noise < 0.02 * independent.rmse_noise);
    }
}

fn holds([low, high]: [f64; 2], value: f64) -> bool {
    low <= value && value <= high
}

/// Intervals hold the truth at least as often as they say (95 % less two standard deviations of 100 trials), whether
/// the difference is far above the noise or below it.
#[test]
fn intervals_hold_the_truth() {
    let change = 1.1;
    let still = |truth: &[[f64; 3]]| vec![truth.iter().map(|xyz| xyz.map(|c| c as f32)).collect(); REPLICATES];
    let exact = compare(&view(), &still(&truth(1.0)), &still(&truth(change)), &Unseen::NOTHING).difference;
    for noise in [0.005, 0.02, 0.04, 0.1] {
        let found = trials(100, |random| {
            let (a, b) = (noisy(&truth(1.0), noise, random), noisy(&truth(change), noise, random));
            compare(&view(), &a, &b, &Unseen::NOTHING).difference
        });
        let energy = share(&found, |found| holds(found.energy.interval_95, exact.energy.value));
        let truth = exact.delta_e2000.mean;
        let delta_e = share(&found, |found| holds(found.delta_e2000.interval_95, truth));
        assert!(energy.min(delta_e) > 0.9, "{noise}: {energy} {delta_e}");
        let mean = |of: fn(&Difference) -> f64| found.iter().map(of).sum::<f64>() / found.len() as f64;
        let (beyond, measured) = (mean(|found| found.delta_e2000.beyond_noise), mean(|found| found.delta_e2000.mean));
        assert!(beyond < 1.01 * truth && truth < 1.01 * measured, "{noise}: {beyond} {truth} {measured}");
    }
}

/// Half a percent of brightness is nothing beside the noise of a pixel, and plain in the sum of many: such a picture is not called
/// indistinguishable.
#[test]
fn a_difference_that_shows_in_the_sum_only_is_one() {
    let large = |change: f64| -> Vec<[f64; 3]> { (0..25).flat_map(|_| truth(change)).collect() };
    let found = trials(20, |random| {
        let (a, b) = (noisy(&large(1.0), 0.2, random), noisy(&large(1.005), 0.2, random));
        compare(&view(), &a, &b, &Unseen::NOTHING).difference
    });
    assert!(share(&found, |difference| difference.delta_e2000.interval_95[0] == 0.0) > 0.8, "the case is not met");
    assert!(share(&found, |difference| difference.verdict == Verdict::Different) > 0.8);
}

/// What single precision rounds away is the same in every replicate, and no difference between pictures for all that.
#[test]
fn rounding_is_no_difference() {
    let found = trials(20, |random| {
        let a = noisy(&truth(1.0), 0.2, random);
        let mut b = a.clone();
        for xyz in b.iter_mut().flatten() {
            if random.unit() < 0.02 {
                *xyz = xyz.map(|c| c.next_down());
            }
        }
        compare(&view(), &a, &b, &Unseen::NOTHING).difference
    });
    assert!(share(&found, |difference| difference.energy.interval_95[1] < 0.0) > 0.5, "the case is not met");
    assert_eq!(share(&found, |difference| difference.verdict == Verdict::Indistinguishable), 1.0);
}
