//! Ctrl-C and SIGTERM: the first signal asks the work to stop and clean up, the second ends the
//! program at once.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use freestand_input::Problem;
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
            let _ = flag::register_conditional_shutdown(
                signal,
                EXIT_STATUS.into(),
                Arc::clone(&wanted),
            )
            .and_then(|_| flag::register(signal, Arc::clone(&wanted)));
        }
        Self(wanted)
    }

    /// Also stops on Ctrl-\\ (SIGQUIT), and when the terminal is closed (SIGHUP), unless the program was
    /// started to ignore that (`nohup`): for a program that leaves no files.
    #[cfg(feature = "page")]
    pub(crate) fn listen_to_hangup(&self) {
        #[cfg(unix)]
        let _ = flag::register(signal_hook::consts::SIGQUIT, Arc::clone(&self.0));
        #[cfg(unix)]
        if !is_ignored(signal_hook::consts::SIGHUP) {
            let _ = flag::register(signal_hook::consts::SIGHUP, Arc::clone(&self.0));
        }
    }

    /// Stops when this flag is set.
    #[cfg(feature = "page")]
    pub(crate) fn on(flag: Arc<AtomicBool>) -> Self {
        Self(flag)
    }

    pub(crate) fn wanted(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// For work that asks at every step: a problem once the user wants to stop.
    pub(crate) fn go_on(&self) -> Result<(), Problem> {
        if self.wanted() {
            Err(Problem::stopped())
        } else {
            Ok(())
        }
    }

    /// The same for work that reports its progress.
    pub(crate) fn flow(&self) -> ControlFlow<()> {
        if self.wanted() {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }
}

/// Whether this process ignores a signal, as Linux tells it: bit n − 1 of a mask is signal n. Other
/// systems do not tell it without calls of C; there no signal counts as ignored.
#[cfg(all(unix, feature = "page"))]
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status
        .lines()
        .find_map(|line| line.strip_prefix("SigIgn:"))
        .map(str::trim);
    let mask = mask
        .and_then(|text| u64::from_str_radix(text, 16).ok())
        .unwrap_or(0);
    u32::try_from(signal - 1)
        .is_ok_and(|bit| mask.checked_shr(bit).is_some_and(|mask| mask & 1 == 1))
}
