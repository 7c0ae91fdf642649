//! Whether a picture fits into memory.

use crate::film::Window;
use crate::memory::{GIB, available_bytes};
use crate::scene::SceneError;

/// Bytes a pixel takes beside the film while it is developed (XYZ and RGB) and encoded (all files at once).
const DEVELOPED_BYTES: f64 = 96.0;

/// Bytes of a channel beside the picture: gathered, and encoded.
const CHANNEL_BYTES: usize = 12;

/// For a film of so many bytes a pixel, and so many channels made of it beside the picture.
pub fn check(window: Window, film_bytes: u64, channels: usize) -> Result<(), SceneError> {
    check_or(window, film_bytes, channels, "render it in parts with --crop x0,y0,x1,y1")
}

/// The same with advice of one's own.
pub fn check_or(window: Window, film_bytes: u64, channels: usize, advice: &str) -> Result<(), SceneError> {
    let a_pixel = film_bytes as f64 + DEVELOPED_BYTES + (CHANNEL_BYTES * channels) as f64;
    let needed = f64::from(window.width) * f64::from(window.height) * a_pixel;
    match available_bytes() {
        Some(available) if needed > available => {
            let message = format!(
                "a picture of {} × {} pixels takes {:.1} GiB of memory, but {:.1} GiB are free",
                window.width,
                window.height,
                needed / GIB,
                available / GIB
            );
            Err(SceneError::new(message).help(advice))
        }
        _ => Ok(()),
    }
}
