//! Whether a picture fits into memory: asked before a render, for systems that promise memory they do not have end the
//! program once it is used.

use crate::film::Window;
use crate::scene::SceneError;

/// Bytes a pixel takes beside the film while it is developed (XYZ and RGB) and encoded (all files at once).
const DEVELOPED_BYTES: f64 = 96.0;

const GIB: f64 = (1u64 << 30) as f64;

/// Bytes of a channel beside the picture: gathered, and encoded.
const CHANNEL_BYTES: usize = 12;

/// For a film of so many bytes a pixel, and so many channels made of it beside the picture.
pub fn check(window: Window, film_bytes: u64, channels: usize) -> Result<(), SceneError> {
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
            Err(SceneError::new(message).help("render it in parts with --crop x0,y0,x1,y1"))
        }
        _ => Ok(()),
    }
}

/// What Linux says; other systems refuse by themselves when too much is asked for.
fn available_bytes() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
    let kib: f64 = line.split_whitespace().next()?.parse().ok()?;
    Some(kib * 1024.0)
}
