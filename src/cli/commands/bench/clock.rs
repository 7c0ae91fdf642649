//! Time that passes, and time that processors work for this program.
//!
//! Processor time is that of all threads, user and system, from the system's own clock of the process (POSIX clock_gettime,
//! CLOCK_PROCESS_CPUTIME_ID): it counts in ns, where /proc/self/stat counts in steps of 10 ms, and asking costs below 1 µs.
//! Where there is none, it is what the threads could have worked.

use std::time::Instant;

/// Of some work.
#[derive(Clone, Copy, Debug)]
pub struct Spent {
    pub cpu_seconds: f64,
    pub wall_seconds: f64,
}

/// Both clocks at one moment.
#[derive(Debug)]
pub struct Clock {
    wall: Instant,
    cpu: Option<f64>,
}

impl Clock {
    pub fn start() -> Self {
        Self { wall: Instant::now(), cpu: processor_seconds() }
    }

    /// Since then.
    pub fn spent(&self) -> Spent {
        let wall_seconds = self.wall.elapsed().as_secs_f64();
        let cpu = processor_seconds().zip(self.cpu).map(|(now, then)| now - then);
        Spent { cpu_seconds: cpu.unwrap_or(wall_seconds * rayon::current_num_threads() as f64), wall_seconds }
    }
}

/// What [`Spent::cpu_seconds`] is, for people.
pub fn source() -> String {
    match processor_seconds() {
        Some(_) => "of all threads, from the system's clock of the process".into(),
        None => "wall time × threads: this system has no clock of the process".into(),
    }
}

#[cfg(unix)]
fn processor_seconds() -> Option<f64> {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
    Some(time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9)
}

#[cfg(not(unix))]
fn processor_seconds() -> Option<f64> {
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of one busy thread, no more than passes on all processors; and some.
    #[test]
    fn work_is_counted() {
        let clock = Clock::start();
        let mut sum = 0u64;
        while clock.wall.elapsed().as_millis() < 30 {
            sum = std::hint::black_box(sum.wrapping_add(1));
        }
        let spent = clock.spent();
        assert!(spent.wall_seconds >= 0.03 && spent.cpu_seconds > 0.0, "{spent:?}");
    }
}
