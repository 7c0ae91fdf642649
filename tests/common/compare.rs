//! Two pictures compared: the means of independent renders in the cells of a grid.

use super::film;
use spectrel::film::Film;
use spectrel::scene::Scene;
use std::ops::Range;

/// One film a seed of a scene that is resolved once.
pub fn renders(scene: &mut Scene, seeds: Range<u64>) -> Vec<Film> {
    let render = |seed| {
        scene.settings.seed = seed;
        film(scene)
    };
    seeds.map(render).collect()
}

/// Mean luminances of whole films, cd/m².
pub fn luminances(films: &[Film]) -> Vec<f64> {
    films.iter().map(|film| super::mean(film)[1]).collect()
}

/// Mean XYZ in each cell of a grid of `columns` × `rows` over a film.
pub fn cells(film: &Film, [columns, rows]: [u32; 2]) -> Vec<[f64; 3]> {
    let window = film.window();
    let mut sums = vec![([0.0; 3], 0.0); (columns * rows) as usize];
    for (index, pixel) in (0..).zip(film.pixels()) {
        let (x, y) = (index % window.width, index / window.width);
        let cell = y * rows / window.height * columns + x * columns / window.width;
        let (sum, count) = &mut sums[cell as usize];
        *sum = std::array::from_fn(|i| sum[i] + pixel.mean()[i]);
        *count += 1.0;
    }
    sums.into_iter().map(|(sum, count)| sum.map(|value| value / count)).collect()
}

/// How far two sets of independent renders are apart.
#[derive(Clone, Copy, Debug)]
pub struct Apart {
    /// Largest |t| of a cell and channel (Welch).
    pub worst: f64,
    /// Σ t² over the cells' luminances, scaled so that a cell counts 1 in the mean.
    pub chi2: f64,
    /// How many cells there are.
    pub cells: usize,
    /// Root mean square of the luminances' differences over their mean.
    pub relative: f64,
}

impl Apart {
    /// Cells and channels in which two sets of 16 renders differ no more than chance has it.
    ///
    /// One in 1000 for the worst of up to 75 comparisons with 30 degrees of freedom (Bonferroni); the sum of squares has a
    /// mean of one and a variance of 2.5 a cell (t² with 30 degrees of freedom), and is allowed four standard deviations.
    pub fn agrees(&self) -> bool {
        let cells = self.cells as f64;
        self.worst < 5.0 && self.chi2 < cells + 4.0 * (2.5 * cells).sqrt()
    }
}

pub fn apart(a: &[Film], b: &[Film], grid: [u32; 2]) -> Apart {
    let moments = |films: &[Film]| {
        let each: Vec<_> = films.iter().map(|film| cells(film, grid)).collect();
        let n = each.len() as f64;
        let of = |cell: usize, i: usize| {
            let mean = each.iter().map(|cells| cells[cell][i]).sum::<f64>() / n;
            let variance = each.iter().map(|cells| (cells[cell][i] - mean).powi(2)).sum::<f64>() / (n - 1.0);
            [mean, variance / n]
        };
        (0..each[0].len()).map(|cell| [0, 1, 2].map(|i| of(cell, i))).collect::<Vec<_>>()
    };
    let (a_moments, b_moments) = (moments(a), moments(b));
    let mut found = Apart { worst: 0.0, chi2: 0.0, cells: a_moments.len(), relative: 0.0 };
    let freedom = (a.len() + b.len() - 2) as f64;
    let mut total = 0.0;
    for (a, b) in a_moments.iter().zip(&b_moments) {
        for i in 0..3 {
            let ([a, a_variance], [b, b_variance]) = (a[i], b[i]);
            let rounding = 1e-6 * (a.abs() + b.abs());
            let t = (a - b).abs() / (a_variance + b_variance + rounding * rounding + f64::MIN_POSITIVE).sqrt();
            found.worst = found.worst.max(t);
            if i == 1 {
                found.chi2 += t * t * (freedom - 2.0) / freedom;
                found.relative += (a - b).powi(2);
                total += a;
            }
        }
    }
    let cells = a_moments.len() as f64;
    found.relative = (found.relative / cells).sqrt() / (total / cells);
    found
}
