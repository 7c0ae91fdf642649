//! What exact sums cost (1024 samples added to one pixel) and what development and writing take (one megapixel):
//! `cargo bench --bench film`.

use divan::{Bencher, black_box};
use spectrel::film::{Develop, Developed, Film, Pixel};
use spectrel::image::{self, Bits, Format, Metadata, Options};

fn main() {
    divan::main();
}

const SAMPLES: usize = 1024;

/// Radiances of a product shot: six decades around 100 cd/m², a few of them black.
fn samples() -> Vec<[f32; 3]> {
    let mut state = 1u32;
    let mut random = move || {
        state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        (state >> 8) as f32 / 16_777_216.0
    };
    let mut sample = || if random() < 0.1 { [0.0; 3] } else { [0; 3].map(|_| 10f32.powf(6.0 * random() - 1.0)) };
    (0..SAMPLES).map(|_| sample()).collect()
}

#[divan::bench]
fn exact_by_shifting(bencher: Bencher) {
    let samples = samples();
    bencher.counter(SAMPLES).bench_local(|| {
        let mut pixel = Pixel::default();
        for xyz in black_box(&samples) {
            pixel.add(*xyz);
        }
        pixel
    });
}

/// The same bits from runs of 16, as a pass of a render adds them.
#[divan::bench]
fn exact_by_gathering(bencher: Bencher) {
    let samples = samples();
    bencher.counter(SAMPLES).bench_local(|| {
        let mut pixel = Pixel::default();
        for run in black_box(&samples).chunks(16) {
            pixel.extend(run.iter().copied());
        }
        pixel
    });
}

/// The obvious way to the same bits: scale in f64 and cast.
#[divan::bench]
fn exact_by_casting(bencher: Bencher) {
    let samples = samples();
    bencher.counter(SAMPLES).bench_local(|| {
        let mut pixel = ([0i128; 3], [0u128; 3], 0u32);
        for xyz in black_box(&samples) {
            if !xyz.iter().all(|c| c.is_finite()) {
                continue;
            }
            for (channel, x) in xyz.iter().enumerate() {
                let x = f64::from(*x);
                pixel.0[channel] = pixel.0[channel].wrapping_add((x * 18_446_744_073_709_551_616.0) as i128);
                pixel.1[channel] = pixel.1[channel].saturating_add((x * x * 281_474_976_710_656.0) as u128);
            }
            pixel.2 += 1;
        }
        pixel
    });
}

/// Not exact: what the usual film does.
#[divan::bench]
fn sums_in_f64(bencher: Bencher) {
    let samples = samples();
    bencher.counter(SAMPLES).bench_local(|| {
        let mut pixel = ([0f64; 3], [0f64; 3], 0u32);
        for xyz in black_box(&samples) {
            if !xyz.iter().all(|c| c.is_finite()) {
                continue;
            }
            for (channel, x) in xyz.iter().enumerate() {
                let x = f64::from(*x);
                pixel.0[channel] += x;
                pixel.1[channel] += x * x;
            }
            pixel.2 += 1;
        }
        pixel
    });
}

/// One megapixel of smooth shading with the noise of a short render.
fn film() -> Film {
    let mut film = Film::full(1024, 1024).unwrap_or_else(|e| panic!("{e}"));
    let mut state = 1u32;
    for (i, pixel) in film.pixels_mut().iter_mut().enumerate() {
        let shade = ((i % 1024) * (i / 1024)) as f32 / 1048.0;
        state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        let grain = (state >> 8) as f32 / 16_777_216.0 * 0.1 + 0.95;
        pixel.add([shade * grain, shade * grain * 1.02, shade * 0.8]);
    }
    film
}

fn developed() -> Developed {
    film().develop(&Develop::default()).unwrap_or_else(|e| panic!("{e}"))
}

#[divan::bench(sample_count = 10)]
fn develop(bencher: Bencher) {
    let film = film();
    bencher.bench_local(|| film.develop(&Develop::default()));
}

fn bench_encode(bencher: Bencher, format: Format, options: Options) {
    let (developed, metadata) = (developed(), Metadata::new());
    bencher.bench_local(|| image::encode(format, &developed, &options, &metadata));
}

#[divan::bench(sample_count = 10)]
fn exr_float(bencher: Bencher) {
    bench_encode(bencher, Format::Exr, Options::default());
}

#[divan::bench(sample_count = 10)]
fn exr_half(bencher: Bencher) {
    bench_encode(bencher, Format::Exr, Options { half: true, ..Options::default() });
}

#[divan::bench(sample_count = 10)]
fn png_8_bits(bencher: Bencher) {
    bench_encode(bencher, Format::Png, Options::default());
}

#[divan::bench(sample_count = 10)]
fn png_16_bits(bencher: Bencher) {
    bench_encode(bencher, Format::Png, Options { bits: Bits::Sixteen, ..Options::default() });
}
