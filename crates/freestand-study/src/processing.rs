//! What is done to a record between its file and its use, each step in words.

use freestand::motion::Motion;

use crate::error::{Problem, ProblemKind};
use crate::records::Component;

/// What the user asks to be done to the samples of a record. The default alters nothing but the mean of raw formats.
#[derive(Debug, Clone, PartialEq)]
pub struct Processing {
    /// Leave the mean of a raw record in it.
    pub keep_mean: bool,
    /// Factor on the samples, after all other steps.
    pub scale_ratio: f64,
}

impl Default for Processing {
    fn default() -> Self {
        Self { keep_mean: false, scale_ratio: 1.0 }
    }
}

/// A motion as it is used, and how it came about.
#[derive(Debug, Clone, PartialEq)]
pub struct Processed {
    /// The motion.
    pub motion: Motion,
    /// What was done, one step each, in order; for people.
    pub steps: Vec<String>,
}

/// Does what is asked, in the order of the fields of [`Processing`].
///
/// # Errors
/// A factor that makes a sample infinite.
pub fn process(component: &Component, processing: &Processing) -> Result<Processed, Problem> {
    let mut motion = component.motion.clone();
    let mut steps = Vec::new();
    if component.is_raw && !processing.keep_mean {
        let accel_m_s2 = motion.accel_m_s2();
        let mean_m_s2 = accel_m_s2.iter().sum::<f64>() / accel_m_s2.len() as f64;
        let centred = accel_m_s2.iter().map(|a| a - mean_m_s2).collect();
        motion = Motion::new(motion.dt_s(), centred).map_err(|error| refused("the mean", &error.to_string()))?;
        steps.push(format!("mean of {mean_m_s2:.6} m/s2 removed (raw record)"));
    }
    let factor = processing.scale_ratio;
    if factor != 1.0 {
        motion = motion.scaled(factor).map_err(|error| refused(&format!("times {factor}"), &error.to_string()))?;
        steps.push(format!("multiplied by {factor}"));
    }
    Ok(Processed { motion, steps })
}

fn refused(step: &str, why: &str) -> Problem {
    Problem::new(ProblemKind::Value, format!("{step}: {why}")).hint("check the values and the scale")
}

/// Whether a factor on the samples leaves a motion; a negative one turns it round.
///
/// # Errors
/// Zero, or a factor that is not finite.
pub fn check_scale(scale_ratio: f64) -> Result<(), Problem> {
    if scale_ratio != 0.0 && scale_ratio.is_finite() {
        return Ok(());
    }
    let message = format!("scale must be a number other than 0, not {scale_ratio}");
    Err(Problem::new(ProblemKind::Value, message).hint("leave it out for the record as it is"))
}
