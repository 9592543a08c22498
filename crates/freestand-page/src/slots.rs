//! Requests of which only the newest counts, such as those of a slider that is being moved.

use std::collections::HashMap;
use std::sync::{Mutex, PoisonError};

use tokio::sync::oneshot;

use crate::Cancel;

/// The running request of each slot.
#[derive(Default)]
pub(crate) struct Slots(Mutex<Running>);

#[derive(Default)]
struct Running {
    last: u64,
    slots: HashMap<String, (u64, Cancel, oneshot::Sender<()>)>,
}

/// A request in a slot.
pub(crate) struct Taken {
    number: u64,
    pub(crate) cancel: Cancel,
    /// Ends when a newer request takes the slot.
    pub(crate) superseded: oneshot::Receiver<()>,
}

impl Slots {
    /// Takes a slot; the request that was in it is cancelled.
    pub(crate) fn take(&self, slot: &str) -> Taken {
        let cancel = Cancel::default();
        let (sender, superseded) = oneshot::channel();
        let mut running = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        running.last += 1;
        let number = running.last;
        if let Some((_, older, told)) = running.slots.insert(slot.to_owned(), (number, cancel.clone(), sender)) {
            older.cancel();
            let _ = told.send(());
        }
        Taken { number, cancel, superseded }
    }

    /// Leaves a slot, unless a newer request has it.
    pub(crate) fn leave(&self, slot: &str, number: u64) {
        let mut running = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if running.slots.get(slot).is_some_and(|(own, ..)| *own == number) {
            running.slots.remove(slot);
        }
    }
}

impl Taken {
    pub(crate) fn number(&self) -> u64 {
        self.number
    }
}
