//! Whether a picture fits into memory.

use crate::film::{Film, Window};
use crate::memory::{GIB, available_bytes};
use crate::scene::SceneError;

/// Bytes a pixel takes beside the film while it is developed (XYZ and RGB) and encoded (all files at once).
const DEVELOPED_BYTES: f64 = 96.0;

pub fn check(window: Window) -> Result<(), SceneError> {
    let a_pixel = Film::memory_bytes(1, 1) as f64 + DEVELOPED_BYTES;
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
            Err(SceneError::new(message).help("render it in parts with --crop x0,y0,x1,y1"))
        }
        _ => Ok(()),
    }
}
