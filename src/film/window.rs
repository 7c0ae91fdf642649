//! Rectangles of pixels: the crop window of a film and the tiles it is rendered in.

use std::fmt;

use super::FilmError;

/// A rectangle of pixels of an image; (0, 0) is the top left pixel of the full image.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Window {
    pub x0: u32,
    pub y0: u32,
    pub width: u32,
    pub height: u32,
}

impl Window {
    /// The window that covers an image of `width` × `height` pixels.
    pub fn full(width: u32, height: u32) -> Self {
        Self { x0: 0, y0: 0, width, height }
    }

    /// Whether this is a window of an image of `image` = [width, height] pixels, and has pixels.
    pub fn check(self, image: [u32; 2]) -> Result<(), FilmError> {
        if self.is_empty() {
            Err(FilmError::Empty)
        } else if !Window::full(image[0], image[1]).contains_window(self) {
            Err(FilmError::Outside { window: self, image })
        } else {
            Ok(())
        }
    }

    pub fn is_empty(self) -> bool {
        self.width == 0 || self.height == 0
    }

    pub fn pixel_count(self) -> u64 {
        u64::from(self.width) * u64::from(self.height)
    }

    pub fn contains(self, x: u32, y: u32) -> bool {
        x >= self.x0 && x - self.x0 < self.width && y >= self.y0 && y - self.y0 < self.height
    }

    /// Whether `inner` lies inside this window.
    pub fn contains_window(self, inner: Window) -> bool {
        inner.x0 >= self.x0 && inner.y0 >= self.y0 && inner.x1() <= self.x1() && inner.y1() <= self.y1()
    }

    /// The place of (x, y) in a vector of the window's rows, if the window covers it.
    pub fn index(self, x: u32, y: u32) -> Option<usize> {
        let row = || (y - self.y0) as usize * self.width as usize;
        self.contains(x, y).then(|| row() + (x - self.x0) as usize)
    }

    /// Squares of `side` pixels that cover the window once, row by row; those at the right and lower edge are cut.
    pub fn tiles(self, side: u32) -> impl Iterator<Item = Window> {
        let step = side.max(1) as usize;
        let columns = move || (0..self.width).step_by(step);
        (0..self.height).step_by(step).flat_map(move |y| columns().map(move |x| self.tile(x, y, step as u32)))
    }

    fn tile(self, x: u32, y: u32, side: u32) -> Window {
        Window { x0: self.x0 + x, y0: self.y0 + y, width: side.min(self.width - x), height: side.min(self.height - y) }
    }

    // Edges one past the last pixel, wide enough for any four numbers.
    fn x1(self) -> u64 {
        u64::from(self.x0) + u64::from(self.width)
    }

    fn y1(self) -> u64 {
        u64::from(self.y0) + u64::from(self.height)
    }
}

impl fmt::Display for Window {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{} × {} pixels at ({}, {})", self.width, self.height, self.x0, self.y0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_cover_every_pixel_once() {
        let window = Window { x0: 5, y0: 7, width: 37, height: 21 };
        let mut seen = vec![0; window.pixel_count() as usize];
        for tile in window.tiles(16) {
            assert!(window.contains_window(tile));
            for y in tile.y0..tile.y0 + tile.height {
                for x in tile.x0..tile.x0 + tile.width {
                    seen[window.index(x, y).unwrap()] += 1;
                }
            }
        }
        assert!(seen.iter().all(|&n| n == 1));
    }

    #[test]
    fn extreme_windows_do_not_wrap() {
        let far = Window { x0: u32::MAX, y0: u32::MAX, width: u32::MAX, height: u32::MAX };
        assert!(far.contains(u32::MAX, u32::MAX) && !far.contains(0, 0));
        assert!(!Window::full(u32::MAX, u32::MAX).contains_window(far));
        assert_eq!(Window::full(3, 3).tiles(0).count(), 9);
        assert_eq!(Window::full(u32::MAX, u32::MAX).tiles(u32::MAX).count(), 1);
    }
}
