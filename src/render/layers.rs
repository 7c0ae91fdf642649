//! The loop of every render: samples of the picture, and of what is recorded beside it: features, replicates, bands of wavelength.
//!
//! The same paths draw the same numbers as for a film alone, so that a picture with features or bands is the picture without
//! them, bit by bit. Replicates are another cut of the samples (`film::replicates`): sample i is the sample i / R of replicate
//! i mod R, and the picture has another noise than the one without them. So has a picture in halves, the fields of a chessboard: each draws
//! numbers of its own, so that the samples of one may decide how many the other gets.

use super::{Guides, Kernel, PASS, Progress};
use crate::film::{Layers, LayersRow, REPLICATES};
use crate::sampler::{PixelSamples, Sampler};
use crate::spectrum::{BinShares, Bins, Nodes};
use rayon::prelude::*;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

/// Rows that a thread takes at a time. Left to rayon, two threads took a quarter of the picture, and one of them had nothing to do at the
/// end of every pass while the other one finished its own.
const ROWS: usize = 1;

/// A kernel, and what fills the layers.
pub struct Recorder<'a> {
    kernel: &'a Kernel<'a>,
    guides: Option<Guides>,
    shares: Option<BinShares>,
    halves: bool,
}

impl<'a> Recorder<'a> {
    /// What a film with layers needs: guides for its features, `bins` for its bands.
    pub fn new(kernel: &'a Kernel<'a>, guides: Option<Guides>, bins: Option<&Bins>) -> Self {
        let lanes = kernel.scene.settings.lanes as usize;
        // The kernel has kept the spectra's values only; its nodes are quickly found again.
        let shares = bins.map(|bins| BinShares::new(bins, &Nodes::new(&kernel.needs.wavelength_density), lanes));
        Self { kernel, guides, shares, halves: false }
    }

    /// With numbers of its own for either half of the picture.
    pub fn in_halves(self) -> Self {
        Self { halves: true, ..self }
    }

    fn row<const N: usize>(&self, row: &mut LayersRow, [x0, y]: [u32; 2], samples: &dyn Fn(usize) -> Range<u64>) {
        for (at, x) in (0..row.pixels.len()).zip(x0..) {
            let mut numbers = self.numbers([x, y], !row.replicates.is_empty());
            let mut pixel = row.pixels[at];
            let sample = |index| self.sample::<N>(row, at, [x, y], numbers.sample(index), index);
            pixel.extend(samples(at).map(sample));
            row.pixels[at] = pixel;
        }
    }

    /// Whether the halves' numbers are independent.
    pub fn draws_in_halves(&self) -> bool {
        self.halves
    }

    fn numbers(&self, [x, y]: [u32; 2], replicates: bool) -> Numbers {
        let pixel = self.kernel.samples([x, y]);
        let pixel = if self.halves { pixel.in_half((x ^ y) & 1) } else { pixel };
        Numbers::new(pixel, replicates)
    }

    fn row_of_lanes(&self) -> RenderRow<'a> {
        match self.kernel.scene.settings.lanes {
            1 => Self::row::<1>,
            4 => Self::row::<4>,
            _ => Self::row::<8>,
        }
    }

    /// XYZ of a sample for the film; the layers are given theirs.
    #[inline]
    fn sample<const N: usize>(
        &self,
        row: &mut LayersRow,
        at: usize,
        pixel: [u32; 2],
        sampler: Sampler,
        index: u64,
    ) -> [f32; 3] {
        let traced = self.kernel.trace::<N>(pixel, sampler);
        let xyz = self.kernel.xyz(&traced);
        // The film counts it as rejected; so it does not count for the layers.
        if !xyz.iter().all(|c| c.is_finite()) {
            return xyz;
        }
        if let Some(replicates) = row.replicates.get_mut(at) {
            replicates.add((index % REPLICATES as u64) as usize, xyz);
        }
        if let (Some(guides), Some(features)) = (&self.guides, row.features.get_mut(at)) {
            let seen = guides.seen(self.kernel.scene, &traced.ray);
            features.add(seen.albedo, seen.normal.to_array());
        }
        if let Some(shares) = &self.shares {
            for lane in 0..N {
                for &(band, weight) in shares.at(traced.wavelengths.lane(lane)) {
                    row.add_band(at, band as usize, traced.radiance[lane] * weight);
                }
            }
        }
        xyz
    }
}

/// Renders a row of pixels, given where it begins and which samples each of them gets.
type RenderRow<'a> = fn(&Recorder<'a>, &mut LayersRow, [u32; 2], &dyn Fn(usize) -> Range<u64>);

/// The random numbers of a pixel's samples: of one net, or of independent ones in turn.
enum Numbers {
    One(PixelSamples),
    Replicates(Box<[PixelSamples; REPLICATES]>),
}

impl Numbers {
    fn new(pixel: PixelSamples, replicates: bool) -> Self {
        match replicates {
            false => Self::One(pixel),
            true => Self::Replicates(Box::new(std::array::from_fn(|replicate| pixel.replicate(replicate as u32)))),
        }
    }

    #[inline]
    fn sample(&mut self, index: u64) -> Sampler<'_> {
        let count = REPLICATES as u64;
        match self {
            Self::One(pixel) => pixel.sample(index),
            Self::Replicates(pixels) => pixels[(index % count) as usize].sample(index / count),
        }
    }
}

/// Samples that are added at once.
#[derive(Clone, Debug)]
pub enum Samples<'a> {
    /// The same ones of every pixel.
    Same(Range<u64>),
    /// Of each pixel its own, row by row from the top; pixels beyond them get none.
    Own(&'a [Range<u64>]),
}

/// Adds samples to the pixels of a picture, or of a window of it, and to what is recorded beside them.
///
/// Which samples and which window change nothing in a pixel but what is added to it: ranges and windows rendered apart and
/// merged are the same film. Once `cancel` is set no more rows are begun.
pub fn render(
    recorder: &Recorder,
    layers: &mut Layers,
    samples: Samples,
    progress: &dyn Progress,
    cancel: &AtomicBool,
) {
    match samples {
        Samples::Same(all) => {
            for pass in passes(all, cancel) {
                recorder.add(layers, &|_| pass.clone(), progress, cancel);
            }
        }
        Samples::Own(each) => {
            recorder.add(layers, &|at| each.get(at).cloned().unwrap_or_default(), progress, cancel);
        }
    }
}

/// Cuts samples into passes, until `cancel` is set.
fn passes(samples: Range<u64>, cancel: &AtomicBool) -> impl Iterator<Item = Range<u64>> {
    let pass = move |first: u64| first..(first + u64::from(PASS)).min(samples.end);
    samples.clone().step_by(PASS as usize).take_while(|_| !cancel.load(Ordering::Relaxed)).map(pass)
}

impl Recorder<'_> {
    /// Renders every row once, given which samples each pixel of the window gets.
    fn add(
        &self,
        layers: &mut Layers,
        samples: &(dyn Fn(usize) -> Range<u64> + Sync),
        progress: &dyn Progress,
        cancel: &AtomicBool,
    ) {
        let render_row = self.row_of_lanes();
        let window = layers.film().window();
        let width = window.width as usize;
        let count = |samples: Range<u64>| samples.end.saturating_sub(samples.start);
        layers.rows_mut().par_iter_mut().enumerate().with_max_len(ROWS).for_each(|(number, row)| {
            if !cancel.load(Ordering::Relaxed) {
                let of_row = |at: usize| samples(number * width + at);
                render_row(self, row, [window.x0, window.y0 + number as u32], &of_row);
                progress.advance((0..width).map(of_row).map(count).sum());
            }
        });
    }
}
