//! Ctrl-C: the first one ends a render with the picture that there is, the second one ends the program at once.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// What ends a render early.
#[derive(Clone, Debug)]
pub struct Interrupt {
    /// Set by people, or because the scene is another one by now.
    stop: Arc<AtomicBool>,
    /// Set by people only.
    pressed: Arc<AtomicBool>,
}

impl Interrupt {
    /// From now on Ctrl-C is heard; once in a program.
    pub fn listen() -> Self {
        let interrupt = Self { stop: Arc::default(), pressed: Arc::default() };
        let heard = interrupt.clone();
        // Without a handler an interrupt ends the program as usual: nothing is lost but the picture.
        let _ = ctrlc::set_handler(move || {
            if heard.pressed.swap(true, Ordering::Relaxed) {
                std::process::exit(130);
            }
            heard.stop.store(true, Ordering::Relaxed);
        });
        interrupt
    }

    /// For a render to look at.
    pub fn flag(&self) -> &AtomicBool {
        &self.stop
    }

    pub fn stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    pub fn pressed(&self) -> bool {
        self.pressed.load(Ordering::Relaxed)
    }

    /// Ends the render that runs, but not the program.
    pub fn restart(&self) {
        self.stop.store(true, Ordering::Relaxed);
    }

    /// Lets the next render run, if people have not asked for the end meanwhile.
    pub fn rearm(&self) {
        self.stop.store(false, Ordering::Relaxed);
        if self.pressed() {
            self.stop.store(true, Ordering::Relaxed);
        }
    }
}
