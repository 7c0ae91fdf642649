//! Equal intervals of wavelength, and how a path's radiance is shared out to them.
//!
//! Bin b is centre ± step/2; what it holds is the mean of the spectral radiance over it. With the nodes of a render
//! (`nodes`) that mean is (1/step) Σᵢ Sᵢ · |cell i ∩ bin b|, and a sample that carries the nodes of one of M/N equally likely
//! sets estimates it by (M/N)/step Σⱼ Sⱼ · |cell j ∩ bin b|. Its mean over samples is the integral by the nodes, whatever
//! the number of samples: nothing is divided by how often a bin happened to be met, which would be biased.
//!
//! Which wavelengths a sample has is drawn anew for each, from a net in every pixel's own order (`sampler`), so that errors
//! do not repeat from pixel to pixel. 256 samples of eight lanes have every node once: with a multiple of them each band gets
//! exactly its share, with fewer it is off by chance, and more so the narrower it is.
//!
//! Cells are 0.13 nm wide where the eye sees best and 2 nm at 830 nm; inside of a cell radiance counts as flat, so narrower
//! bins than that are as wide as a cell.

use super::{LAMBDA_MAX_NM, LAMBDA_MIN_NM, NODE_COUNT, Nodes, Wavelengths};
use std::str::FromStr;

/// More bins than this are a mistake.
const MOST_BINS: usize = 2048;

/// Intervals of equal width, side by side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bins {
    first_nm: f64,
    step_nm: f64,
    count: usize,
}

impl Default for Bins {
    /// 380 to 780 nm by 10 nm: where the eye sees.
    fn default() -> Self {
        Self { first_nm: 380.0, step_nm: 10.0, count: 41 }
    }
}

impl Bins {
    /// Bins with their centres at `first_nm`, `first_nm + step_nm` … `last_nm`; they must lie within 360–830 nm.
    pub fn new(first_nm: f64, step_nm: f64, last_nm: f64) -> Result<Self, String> {
        let steps = (last_nm - first_nm) / step_nm;
        if !(step_nm > 0.0 && steps >= 0.0 && steps.is_finite()) {
            return Err("expected FIRST:STEP:LAST in nm with a positive step and FIRST not above LAST".into());
        }
        if (steps - libm::round(steps)).abs() > 1e-6 {
            return Err(format!("{last_nm} nm is no whole number of steps of {step_nm} nm from {first_nm} nm"));
        }
        if steps >= MOST_BINS as f64 {
            return Err(format!("{:.0} bands are too many; {MOST_BINS} is the limit", steps + 1.0));
        }
        let bins = Self { first_nm, step_nm, count: libm::round(steps) as usize + 1 };
        let (low, high) = (bins.edges_nm(0).0, bins.edges_nm(bins.count - 1).1);
        if low < LAMBDA_MIN_NM - 1e-6 || high > LAMBDA_MAX_NM + 1e-6 {
            let message = format!("bands from {low} to {high} nm reach beyond {LAMBDA_MIN_NM}–{LAMBDA_MAX_NM} nm");
            return Err(format!("{message}, where light is computed (a band is half a step wider on both sides)"));
        }
        Ok(bins)
    }

    pub fn count(&self) -> usize {
        self.count
    }

    pub fn step_nm(&self) -> f64 {
        self.step_nm
    }

    pub fn center_nm(&self, bin: usize) -> f64 {
        self.first_nm + bin as f64 * self.step_nm
    }

    /// Where a bin begins and ends.
    pub fn edges_nm(&self, bin: usize) -> (f64, f64) {
        (self.center_nm(bin) - 0.5 * self.step_nm, self.center_nm(bin) + 0.5 * self.step_nm)
    }

    /// The bins that a stretch of wavelengths meets, and how much of it lies in each, nm.
    fn overlaps(&self, low: f64, high: f64) -> impl Iterator<Item = (usize, f64)> {
        let start = self.edges_nm(0).0;
        let bin = |nm: f64| ((nm - start) / self.step_nm).max(0.0) as usize;
        let last = self.count.min(bin(high) + 1);
        (bin(low).min(last)..last).filter_map(move |bin| {
            let (from, to) = self.edges_nm(bin);
            let overlap = to.min(high) - from.max(low);
            (overlap > 0.0).then_some((bin, overlap))
        })
    }
}

impl FromStr for Bins {
    type Err = String;

    /// `380:10:780`: first centre, step and last centre, nm.
    fn from_str(text: &str) -> Result<Self, String> {
        let numbers: Result<Vec<f64>, _> = text.split(':').map(|number| number.trim().parse::<f64>()).collect();
        match numbers.as_deref() {
            Ok([first, step, last]) => Self::new(*first, *step, *last),
            _ => Err("expected FIRST:STEP:LAST in nm, such as 380:10:780".into()),
        }
    }
}

/// By place in the tables of a render: which bins a lane's radiance goes to, with which weights.
#[derive(Clone, Debug)]
pub struct BinShares {
    /// Where the entries of each place begin, and the end of the last ones.
    starts: Vec<u32>,
    entries: Vec<(u32, f32)>,
}

impl BinShares {
    /// For paths of `lanes` wavelengths of these nodes.
    pub fn new(bins: &Bins, nodes: &Nodes, lanes: usize) -> Self {
        let sets = NODE_COUNT / lanes;
        let mut shares = Self { starts: vec![0], entries: Vec::new() };
        for offset in 0..NODE_COUNT {
            let (low, high) = nodes.cell_nm(offset / lanes + offset % lanes * sets);
            let weight = |(bin, overlap)| (bin as u32, (sets as f64 * overlap / bins.step_nm) as f32);
            shares.entries.extend(bins.overlaps(low, high).map(weight));
            shares.starts.push(shares.entries.len() as u32);
        }
        shares
    }

    /// Bins and weights of one lane of a path.
    #[inline]
    pub fn at(&self, wavelength: Wavelengths<1>) -> &[(u32, f32)] {
        self.of_place(wavelength.place())
    }

    fn of_place(&self, offset: usize) -> &[(u32, f32)] {
        &self.entries[self.starts[offset] as usize..self.starts[offset + 1] as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::super::Density;
    use super::super::density::of_lines;
    use super::*;

    #[test]
    fn bins_are_read_and_checked() {
        let bins: Bins = "380:10:780".parse().unwrap();
        assert_eq!((bins, bins.count()), (Bins::default(), 41));
        assert_eq!(bins.edges_nm(1), (385.0, 395.0));
        assert_eq!("550:1:550".parse::<Bins>().unwrap().count(), 1);
        for text in ["", "380", "380:10", "a:b:c", "380:0:780", "780:10:380", "380:-1:370", "nan:1:500", "1:2:inf"] {
            assert!(text.parse::<Bins>().unwrap_err().contains("expected"), "{text}");
        }
        assert!("380:10:785".parse::<Bins>().unwrap_err().contains("no whole number of steps"));
        assert!("360:10:780".parse::<Bins>().unwrap_err().contains("beyond 360–830"));
        assert!("400:0.001:500".parse::<Bins>().unwrap_err().contains("too many"));
    }

    /// What is flat is flat in every bin, for sets of one and of eight, with and without lines.
    #[test]
    fn shares_of_all_sets_sum_to_one_per_bin() {
        for density in [Density::visible(), of_lines(&[546.074, 589.3])] {
            let nodes = Nodes::new(&density);
            for (bins, lanes) in [("365:10:825", 8), ("360.5:1:829.5", 8), ("550:0.2:552", 1), ("380:5:780", 4)] {
                let bins: Bins = bins.parse().unwrap();
                let shares = BinShares::new(&bins, &nodes, lanes);
                let mut sums = vec![0.0; bins.count()];
                for offset in 0..NODE_COUNT as u32 {
                    shares
                        .of_place(offset as usize)
                        .iter()
                        .for_each(|&(bin, weight)| sums[bin as usize] += f64::from(weight));
                }
                let sets = (NODE_COUNT / lanes) as f64;
                assert!(sums.iter().all(|sum| (sum / sets - 1.0).abs() < 1e-6), "{bins:?} × {lanes}");
            }
        }
    }
}
