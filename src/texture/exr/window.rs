//! The data window of an EXR in its display window: the picture is what a display would show.

use super::super::error::room_for;
use super::Samples;
use exr::meta::attribute::IntegerBounds;
use exr::meta::header::Header;
use exr::prelude::Vec2;

/// The samples of the data window where they stand in the display window; as they are where the two have nothing in common,
/// or the display would be larger than memory.
pub fn place(samples: Samples, header: &Header, bytes: usize, notes: &mut Vec<String>) -> (Vec2<usize>, Samples) {
    let (data, display) = (header.data_window(), header.shared_attributes.display_window);
    if data == display {
        return (data.size, samples);
    }
    let size = |bounds: IntegerBounds| format!("{} × {}", bounds.size.0, bounds.size.1);
    let overlap = Overlap::new(data, display);
    let Vec2(width, height) = display.size;
    let fits = room_for(width as u64, height as u64, bytes).is_ok();
    let Some(overlap) = overlap.filter(|_| fits) else {
        let windows = [data, display].map(size);
        notes.push(format!(
            "its data window of {} is taken for the picture; its display window is another, of {}",
            windows[0], windows[1]
        ));
        return (data.size, samples);
    };
    if overlap.size != display.size {
        notes.push(format!("it has texels for {} of its {}: the others are black", overlap.named(), size(display)));
    }
    if overlap.size != data.size {
        notes.push(format!("what lies outside of its display window of {} is cut off", size(display)));
    }
    let samples = match samples {
        Samples::Grey(values) => Samples::Grey(overlap.placed(&values)),
        Samples::Rgb(values) => Samples::Rgb(overlap.placed(&values)),
        codes => codes,
    };
    (display.size, samples)
}

/// Where two windows overlap, in texels of each.
struct Overlap {
    size: Vec2<usize>,
    in_data: Vec2<usize>,
    in_display: Vec2<usize>,
    data_width: usize,
    display: Vec2<usize>,
}

impl Overlap {
    fn new(data: IntegerBounds, display: IntegerBounds) -> Option<Self> {
        let axis = |data: (i32, usize), display: (i32, usize)| {
            let end = |(start, count): (i32, usize)| i64::from(start) + count as i64;
            let start = i64::from(data.0.max(display.0));
            let count = end(data).min(end(display)) - start;
            (count > 0)
                .then(|| [count, start - i64::from(data.0), start - i64::from(display.0)].map(|texels| texels as usize))
        };
        let x = axis((data.position.0, data.size.0), (display.position.0, display.size.0))?;
        let y = axis((data.position.1, data.size.1), (display.position.1, display.size.1))?;
        let [size, in_data, in_display] = [0, 1, 2].map(|i| Vec2(x[i], y[i]));
        Some(Self { size, in_data, in_display, data_width: data.size.0, display: display.size })
    }

    fn named(&self) -> String {
        format!("{} × {}", self.size.0, self.size.1)
    }

    fn placed<T: Copy + Default>(&self, values: &[T]) -> Vec<T> {
        let mut placed = vec![T::default(); self.display.area()];
        for row in 0..self.size.1 {
            let from = (self.in_data.1 + row) * self.data_width + self.in_data.0;
            let to = (self.in_display.1 + row) * self.display.0 + self.in_display.0;
            placed[to..to + self.size.0].copy_from_slice(&values[from..from + self.size.0]);
        }
        placed
    }
}
