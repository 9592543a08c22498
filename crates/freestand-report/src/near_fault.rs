//! What a fault near the place brings into the worlds, in words.

use freestand::worlds::{FARTHEST_PULSE_M, FAULT_MAGNITUDES};
use freestand_input::words::{number, percent_significant};
use freestand_study::study::{Ground, Study, SyntheticGround};

/// The fault and the share of the worlds that have a velocity pulse, without a full stop; `None`: no fault is known.
pub(crate) fn near_fault_words(study: &Study) -> Option<String> {
    let Ground::Synthetic(SyntheticGround {
        near_fault: Some(fault),
        ..
    }) = &study.ground
    else {
        return None;
    };
    let km = number(fault.distance_m() / 1e3, 4);
    let share = fault.pulse_share();
    if share == 0.0 {
        return Some(format!(
            "no world has a velocity pulse: the fault is {km} km away, and from {} km on none has one",
            FARTHEST_PULSE_M / 1e3
        ));
    }
    let magnitude = match fault.magnitude() {
        Some(magnitude) => number(magnitude, 3),
        None => {
            let (low, high) = FAULT_MAGNITUDES;
            format!("from {low} to {high}, because none was given")
        }
    };
    Some(format!(
        "{} of the worlds have a velocity pulse: the earthquake is on a fault {km} km away, and its magnitude is {magnitude}",
        percent_significant(share, 2)
    ))
}
