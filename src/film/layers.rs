//! A film with what was asked for beside it: features, replicates, bands of wavelength.
//!
//! Every layer is made of exact sums, so that layers are as independent of threads, windows and cuts as the film is. What is
//! not asked for takes no memory; a pixel takes 112 bytes for the film, 56 more for features, 416 for replicates, 16 for each
//! band (41 bands of 960 × 640 pixels: 0.4 GB). What they cost in time (`benches/layers.rs`, twelve metals): nothing without layers, 22 %
//! for features (one more ray), 5 % for replicates, 11 % for 41 bands.

use super::fixed::{sum_to_f64, sum_units};
use super::{Features, Film, FilmError, Pixel, Replicates, Window, empty};

/// Which layers a film is to have.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Wanted {
    /// Albedo and normal.
    pub features: bool,
    /// Independent replicates, for the variance.
    pub replicates: bool,
    /// Bands of wavelength; none if 0.
    pub bands: usize,
}

impl Wanted {
    /// Bytes that a pixel takes, with those of its film.
    pub fn bytes_per_pixel(&self) -> u64 {
        let layers = [
            (self.features, size_of::<Features>()),
            (self.replicates, size_of::<Replicates>()),
            (self.bands > 0, self.bands * size_of::<i128>()),
        ];
        let asked_for = layers.iter().filter(|(wanted, _)| *wanted).map(|(_, bytes)| *bytes as u64);
        Film::memory_bytes(1, 1) + asked_for.sum::<u64>()
    }
}

/// The film of a window, and its layers pixel by pixel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Layers {
    film: Film,
    wanted: Wanted,
    features: Vec<Features>,
    replicates: Vec<Replicates>,
    bands: Vec<i128>,
}

/// One row of pixels and of the layers; those that are not there are empty.
#[derive(Debug)]
pub struct LayersRow<'a> {
    pub pixels: &'a mut [Pixel],
    pub features: &'a mut [Features],
    pub replicates: &'a mut [Replicates],
    /// Pixel after pixel.
    pub bands: &'a mut [i128],
    band_count: usize,
}

impl Layers {
    /// Empty layers for `window` of an image of `image` = [width, height] pixels.
    pub fn new(image: [u32; 2], window: Window, wanted: Wanted) -> Result<Self, FilmError> {
        let film = Film::new(image, window)?;
        let bytes = window.pixel_count().saturating_mul(wanted.bytes_per_pixel());
        let pixels = film.pixels().len();
        Ok(Self {
            film,
            wanted,
            features: empty(pixels * usize::from(wanted.features), bytes)?,
            replicates: empty(pixels * usize::from(wanted.replicates), bytes)?,
            bands: empty(pixels.saturating_mul(wanted.bands), bytes)?,
        })
    }

    pub fn film(&self) -> &Film {
        &self.film
    }

    /// Returns the film alone.
    pub fn into_film(self) -> Film {
        self.film
    }

    pub fn wanted(&self) -> Wanted {
        self.wanted
    }

    /// Features by pixel, row by row from the top; empty if they were not asked for.
    pub fn features(&self) -> &[Features] {
        &self.features
    }

    /// Replicates by pixel, row by row from the top; empty if they were not asked for.
    pub fn replicates(&self) -> &[Replicates] {
        &self.replicates
    }

    /// Mean spectral radiance of a band in W m⁻² sr⁻¹ nm⁻¹, by pixel; zero where nothing was sampled.
    pub fn band(&self, band: usize) -> impl Iterator<Item = f64> {
        let sums = self.bands.iter().skip(band).step_by(self.wanted.bands.max(1));
        self.film.pixels().iter().zip(sums).map(|(pixel, sum)| sum_to_f64(*sum) / f64::from(pixel.count().max(1)))
    }

    /// Rows from the top: disjoint, for threads to share.
    pub fn rows_mut(&mut self) -> Vec<LayersRow<'_>> {
        let width = self.film.window().width as usize;
        let mut features = rows(&mut self.features, width);
        let mut replicates = rows(&mut self.replicates, width);
        let mut bands = rows(&mut self.bands, width * self.wanted.bands);
        let row = |pixels| LayersRow {
            pixels,
            features: features.next().unwrap_or_default(),
            replicates: replicates.next().unwrap_or_default(),
            bands: bands.next().unwrap_or_default(),
            band_count: self.wanted.bands,
        };
        self.film.pixels_mut().chunks_exact_mut(width).map(row).collect()
    }
}

/// Copies of some pixels and of their layers, as they were.
#[derive(Clone, Debug)]
pub struct Kept {
    places: Vec<usize>,
    pixels: Vec<Pixel>,
    features: Vec<Features>,
    replicates: Vec<Replicates>,
    bands: Vec<i128>,
}

impl Layers {
    /// Copies of the pixels at some places, row by row from the top.
    pub fn keep(&self, places: Vec<usize>) -> Kept {
        Kept {
            pixels: picked(self.film.pixels(), 1, &places),
            features: picked(&self.features, 1, &places),
            replicates: picked(&self.replicates, 1, &places),
            bands: picked(&self.bands, self.wanted.bands, &places),
            places,
        }
    }

    /// Undoes what was added to pixels since they were kept.
    pub fn put_back(&mut self, kept: &Kept) {
        put(self.film.pixels_mut(), 1, &kept.places, &kept.pixels);
        put(&mut self.features, 1, &kept.places, &kept.features);
        put(&mut self.replicates, 1, &kept.places, &kept.replicates);
        put(&mut self.bands, self.wanted.bands, &kept.places, &kept.bands);
    }
}

/// Those at some places of values of which each place has `each`; none of none.
fn picked<T: Copy>(values: &[T], each: usize, places: &[usize]) -> Vec<T> {
    let of = |place: &usize| values.get(place * each..(place + 1) * each).unwrap_or_default();
    places.iter().flat_map(of).copied().collect()
}

/// The inverse of [`picked`].
fn put<T: Copy>(values: &mut [T], each: usize, places: &[usize], kept: &[T]) {
    for (place, own) in places.iter().zip(kept.chunks_exact(each.max(1))) {
        values[place * each..(place + 1) * each].copy_from_slice(own);
    }
}

impl LayersRow<'_> {
    /// Adds to a band of a pixel what one sample estimates its spectral radiance to be.
    #[inline]
    pub fn add_band(&mut self, pixel: usize, band: usize, radiance: f32) {
        if radiance.is_finite() {
            let sum = &mut self.bands[pixel * self.band_count + band];
            *sum = sum.wrapping_add(sum_units(radiance));
        }
    }
}

fn rows<T>(values: &mut [T], width: usize) -> impl Iterator<Item = &mut [T]> {
    values.chunks_exact_mut(width.max(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_added_to_kept_pixels_is_undone_and_no_more() {
        let wanted = Wanted { features: true, replicates: true, bands: 2 };
        let mut layers = Layers::new([3, 2], Window::full(3, 2), wanted).expect("small");
        let add = |layers: &mut Layers, value: f32| {
            for mut row in layers.rows_mut() {
                for at in 0..3 {
                    row.pixels[at].add([value; 3]);
                    row.features[at].add([value; 3], [0.0, 0.0, 1.0]);
                    row.replicates[at].add(1, [value; 3]);
                    (0..2).for_each(|band| row.add_band(at, band, value));
                }
            }
        };
        add(&mut layers, 1.0);
        let before = layers.clone();
        let kept = layers.keep(vec![0, 4]);
        add(&mut layers, 2.0);
        let after = layers.clone();
        layers.put_back(&kept);
        for at in 0..6 {
            let expected = if at == 0 || at == 4 { &before } else { &after };
            assert_eq!(layers.film().pixels()[at], expected.film().pixels()[at]);
            assert_eq!(layers.features[at], expected.features[at]);
            assert_eq!(layers.replicates[at], expected.replicates[at]);
            assert_eq!(layers.bands[2 * at..2 * at + 2], expected.bands[2 * at..2 * at + 2]);
        }
    }
}
