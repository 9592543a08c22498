//! Ctrl-C and SIGTERM: the first signal asks the work to stop and clean up, the second ends the
//! program at once.

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
    /// Starts listening. SIGHUP is not caught, so that `nohup` works.
    pub(crate) fn listen() -> Self {
        let wanted = Arc::new(AtomicBool::new(false));
        for signal in [SIGINT, SIGTERM] {
            // The order matters: the second signal finds the flag set by the first. If the system
            // refuses, the first signal ends the program at once, and the next run removes the
            // files that it left.
            let _ = flag::register_conditional_shutdown(signal, EXIT_STATUS.into(), Arc::clone(&wanted))
                .and_then(|_| flag::register(signal, Arc::clone(&wanted)));
        }
        Self(wanted)
    }

    /// Stops when this flag is set.
    #[cfg(feature = "page")]
    pub(crate) fn on(flag: Arc<AtomicBool>) -> Self {
        Self(flag)
    }

    pub(crate) fn wanted(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}
