//! The film: exact sums of XYZ for every pixel, and their development into a picture.
//!
//! Samples arrive as XYZ in cd/m² and are added to wide fixed-point integers ([`fixed`]), so a film depends on the set
//! of samples alone: not on their order, the number of threads, or how a job was cut into parts. Only
//! [`Film::develop`] turns sums into floating-point numbers, once.
//!
//! - [`window`]: which part of the full image a film covers, and its tiles
//! - [`fixed`]: one number to fixed point
//! - [`pixel`]: the sums of one pixel; [`batch`]: many samples of one pixel at once
//! - [`layers`]: a film with features, replicates and bands of wavelength beside it
//! - [`features`]: albedo and normal of one pixel; [`replicates`]: how uncertain it is
//! - [`exposure`]: which luminance becomes display white
//! - [`develop`]: exposure → white balance → RGB
//! - [`gamut`]: what a display cannot show, counted and, for PNG, moved inside
//! - [`view`]: radiances as a display shows them; [`unseen`]: light that may be missing

pub mod batch;
pub mod develop;
pub mod error;
pub mod exposure;
pub mod features;
pub mod fixed;
pub mod gamut;
pub mod hash;
pub mod layers;
pub mod pixel;
pub mod replicates;
pub mod unseen;
pub mod view;
pub mod window;

pub use develop::{Develop, Developed};
pub use error::FilmError;
pub use exposure::Exposure;
pub use features::Features;
pub use gamut::{Gamut, GamutReport};
pub use hash::fnv1a_64;
pub use layers::{Kept, Layers, LayersRow, Wanted};
pub use pixel::Pixel;
pub use replicates::{REPLICATES, Replicates};
pub use unseen::Unseen;
pub use view::View;
pub use window::Window;

use rayon::prelude::*;

/// The pixels of a window of an image.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Film {
    image: [u32; 2],
    window: Window,
    pixels: Vec<Pixel>,
}

impl Film {
    /// An empty film for `window` of an image of `image` = [width, height] pixels.
    ///
    /// Fails if the window is empty, not inside the image, or beyond what the machine can allocate.
    pub fn new(image: [u32; 2], window: Window) -> Result<Self, FilmError> {
        window.check(image)?;
        let bytes = Self::memory_bytes(window.width, window.height);
        let count = usize::try_from(window.pixel_count()).map_err(|_| FilmError::TooLarge { bytes })?;
        Ok(Self { image, window, pixels: empty(count, bytes)? })
    }

    /// An empty film for a whole image.
    pub fn full(width: u32, height: u32) -> Result<Self, FilmError> {
        Self::new([width, height], Window::full(width, height))
    }

    /// The bytes the sums of `width` × `height` pixels take in memory, for a check before rendering.
    pub fn memory_bytes(width: u32, height: u32) -> u64 {
        (u64::from(width) * u64::from(height)).saturating_mul(size_of::<Pixel>() as u64)
    }

    /// [width, height] of the full image this film is a window of.
    pub fn image(&self) -> [u32; 2] {
        self.image
    }

    /// The part of the image this film covers.
    pub fn window(&self) -> Window {
        self.window
    }

    /// The pixel at (x, y) of the full image, if the window covers it.
    pub fn pixel(&self, x: u32, y: u32) -> Option<&Pixel> {
        self.pixels.get(self.window.index(x, y)?)
    }

    /// The pixel at (x, y) of the full image, if the window covers it.
    pub fn pixel_mut(&mut self, x: u32, y: u32) -> Option<&mut Pixel> {
        self.pixels.get_mut(self.window.index(x, y)?)
    }

    /// All pixels, row by row from the top.
    pub fn pixels(&self) -> &[Pixel] {
        &self.pixels
    }

    /// All pixels, row by row from the top. Rows are disjoint chunks of `window().width` pixels, so threads can share
    /// a film without locks: `film.pixels_mut().par_chunks_mut(width)`.
    pub fn pixels_mut(&mut self) -> &mut [Pixel] {
        &mut self.pixels
    }

    /// Samples accepted in all pixels.
    pub fn samples(&self) -> u64 {
        self.pixels.iter().map(|p| u64::from(p.count())).sum()
    }

    /// Adds the samples of another film of the same window: the parts of a job cut by sample ranges.
    pub fn merge(&mut self, other: &Film) -> Result<(), FilmError> {
        if self.image != other.image || self.window != other.window {
            return Err(self.mismatch(other));
        }
        for (mine, theirs) in self.pixels.iter_mut().zip(&other.pixels) {
            mine.merge(theirs);
        }
        Ok(())
    }

    /// Adds the samples of a film whose window lies inside this one: a tile rendered by one thread, or a crop.
    pub fn merge_tile(&mut self, tile: &Film) -> Result<(), FilmError> {
        if self.image != tile.image || !self.window.contains_window(tile.window) {
            return Err(self.mismatch(tile));
        }
        let (mine, width) = (self.window, tile.window.width as usize);
        for (row, y) in tile.pixels.chunks_exact(width).zip(tile.window.y0..) {
            let Some(start) = mine.index(tile.window.x0, y) else { continue };
            for (mine, theirs) in self.pixels[start..].iter_mut().zip(row) {
                mine.merge(theirs);
            }
        }
        Ok(())
    }

    fn mismatch(&self, other: &Film) -> FilmError {
        FilmError::Mismatch {
            window: self.window,
            image: self.image,
            other_window: other.window,
            other_image: other.image,
        }
    }
}

/// So many empty sums, which take `bytes` with all that is beside them. By all threads, for it is the machine's looking for memory that
/// takes time.
fn empty<T: Clone + Default + Send>(count: usize, bytes: u64) -> Result<Vec<T>, FilmError> {
    let mut values = Vec::new();
    values.try_reserve_exact(count).map_err(|_| FilmError::TooLarge { bytes })?;
    values.par_extend(rayon::iter::repeat_n(T::default(), count));
    Ok(values)
}
