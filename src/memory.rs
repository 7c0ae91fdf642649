//! How much memory is free: asked before a picture is made or read, for systems that promise memory they do not have end the
//! program once it is used.

/// Bytes in a GiB.
pub const GIB: f64 = (1u64 << 30) as f64;

/// What Linux says; other systems refuse by themselves when too much is asked for.
pub fn available_bytes() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
    let kib: f64 = line.split_whitespace().next()?.parse().ok()?;
    Some(kib * 1024.0)
}
