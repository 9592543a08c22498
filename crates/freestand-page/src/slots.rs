//! Requests of which only the newest counts, such as those of a slider that is being moved. They count
//! within one tab of a browser: two tabs that show different places do not stop each other.

use std::collections::HashMap;
use std::sync::{Mutex, PoisonError};

use tokio::sync::oneshot;

use crate::Cancel;

/// A slot of a tab.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub(crate) struct Slot {
    /// The tab, by a name that it made up; one without a name shares its slots with others of them.
    pub(crate) tab: String,
    pub(crate) name: String,
}

/// The running request of each slot.
#[derive(Default)]
pub(crate) struct Slots(Mutex<Running>);

#[derive(Default)]
struct Running {
    last: u64,
    slots: HashMap<Slot, Holder>,
}

/// The request that has a slot.
struct Holder {
    number: u64,
    cancel: Cancel,
    /// Tells it that a newer request has the slot.
    superseded: oneshot::Sender<()>,
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
    pub(crate) fn take(&self, slot: &Slot) -> Taken {
        let cancel = Cancel::default();
        let (tell, superseded) = oneshot::channel();
        let mut running = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        running.last += 1;
        let number = running.last;
        let holder = Holder {
            number,
            cancel: cancel.clone(),
            superseded: tell,
        };
        if let Some(older) = running.slots.insert(slot.clone(), holder) {
            older.cancel.cancel();
            let _ = older.superseded.send(());
        }
        Taken {
            number,
            cancel,
            superseded,
        }
    }

    /// Leaves a slot, unless a newer request has it.
    pub(crate) fn leave(&self, slot: &Slot, number: u64) {
        let mut running = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if running
            .slots
            .get(slot)
            .is_some_and(|holder| holder.number == number)
        {
            running.slots.remove(slot);
        }
    }
}

impl Taken {
    pub(crate) fn number(&self) -> u64 {
        self.number
    }
}
