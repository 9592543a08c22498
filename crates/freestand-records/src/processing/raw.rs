//! Raw records, which include the offset of their instrument.

use freestand::motion::Motion;
use freestand::signal::baseline::{Baseline, corrected};

use super::{Processing, refused};
use crate::formats::Component;
use freestand_input::problem::Problem;

/// The samples; those of a raw record without their mean.
pub(super) fn without_mean(
    component: &Component,
    processing: &Processing,
    steps: &mut Vec<String>,
) -> Result<Motion, Problem> {
    if !component.is_raw || processing.keep_mean {
        return Ok(component.motion.clone());
    }
    let (motion, mean_m_s2) = take_mean(&component.motion)?;
    steps.push(format!("mean of {mean_m_s2:.6} m/s2 removed (raw record)"));
    Ok(motion)
}

pub(super) fn take_mean(motion: &Motion) -> Result<(Motion, f64), Problem> {
    let centred = corrected(motion, Baseline::Mean).map_err(|error| refused("the mean", error, "check the values"))?;
    Ok((centred, motion.mean_m_s2()))
}
