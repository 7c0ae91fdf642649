//! What can be wrong with a film.

use thiserror::Error;

use super::Window;

/// Why a film could not be made, merged, read or developed.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum FilmError {
    #[error("the image has no pixels: width and height must be at least 1")]
    Empty,
    #[error("the window of {window} is not inside the image of {} × {} pixels", image[0], image[1])]
    Outside { window: Window, image: [u32; 2] },
    #[error("the image needs {:.1} GiB of memory, more than can be allocated; render it in crop windows", *bytes as f64 / (1u64 << 30) as f64)]
    TooLarge { bytes: u64 },
    #[error(
        "films do not match: {window} of an image of {} × {}, and {other_window} of an image of {} × {}",
        image[0], image[1], other_image[0], other_image[1]
    )]
    Mismatch { window: Window, image: [u32; 2], other_window: Window, other_image: [u32; 2] },
    #[error("this is no film file")]
    NotAFilm,
    #[error("the film file is damaged: {reason}")]
    Damaged { reason: String },
    #[error("exposure EV {ev} is out of range: use −{limit} to {limit} (display white is 2^EV cd/m²)")]
    Exposure { ev: f64, limit: f64 },
    #[error("XYZ ({}, {}, {}) is no white: it must be finite, not negative, and Y above 0", white[0], white[1], white[2])]
    White { white: [f64; 3] },
}
