//! Ctrl-C and SIGTERM: the first asks the work to stop and tidy up, the second ends the program at
//! once.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

/// Exit status of a program that was stopped: 128 + SIGINT.
pub(crate) const EXIT_STATUS: u8 = 130;

/// Whether the user wants to stop.
#[derive(Debug, Clone)]
pub(crate) struct Stop(Arc<AtomicBool>);

impl Stop {
    /// Listens from now on. SIGHUP keeps its meaning, so that `nohup` does.
    pub(crate) fn listen() -> Self {
        let wanted = Arc::new(AtomicBool::new(false));
        for signal in [SIGINT, SIGTERM] {
            // In this order: the second signal finds the flag of the first. Where the system
            // refuses, the signal ends the program at once, and the next run clears what it left.
            let _ = flag::register_conditional_shutdown(signal, EXIT_STATUS.into(), Arc::clone(&wanted))
                .and_then(|_| flag::register(signal, Arc::clone(&wanted)));
        }
        Self(wanted)
    }

    pub(crate) fn wanted(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}
