//! What is done to a record after reading, each step in words.

mod align;
mod factor;
mod pair;
mod raw;
mod short_period;
mod standstill;
mod target;
mod written;

use freestand::motion::Motion;
use freestand::signal::baseline::{Baseline, corrected};
use freestand::signal::filter::{Filtered, Pass, filtered};
use freestand::signal::resample::resampled;
use freestand::signal::scale::LARGE_FACTOR;
use freestand::signal::taper::tapered;

use crate::formats::{Component, MotionFile};
use crate::notes::{Note, NoteKind};
use freestand_input::problem::Problem;
use freestand_input::words::number;

use factor::{factor, factor_words, target_notes};
use raw::without_mean;

pub use pair::{
    Bearing, azimuth_of, horizontal_pair, not_perpendicular, pair_of_one, process_pair, turned,
    with_azimuths,
};
pub use short_period::short_period_warning;
pub use short_period::{few_steps, samples_needed};
pub use standstill::standstill_note;
pub use target::{TargetSource, TargetSpectrum, parse_target, read_target};
pub use written::{
    azimuth_deg, parse_baseline, parse_sa_target, parse_step, parse_target_source, read_step,
};

/// What the user requests for the samples of a record, in the order of the steps. The default only
/// removes the mean of raw formats.
#[derive(Debug, Clone, PartialEq)]
pub struct Processing {
    /// Keep the mean of a raw record.
    pub keep_mean: bool,
    /// Azimuth of the component that is made of two horizontal ones \[degrees clockwise from
    /// north\].
    pub azimuth_deg: Option<f64>,
    /// Baseline to be removed.
    pub baseline: Option<Baseline>,
    /// Share of the duration that is tapered at each end.
    pub taper_ratio: Option<f64>,
    /// Corner of a high-pass filter \[Hz\].
    pub low_cut_hz: Option<f64>,
    /// Corner of a low-pass filter \[Hz\].
    pub high_cut_hz: Option<f64>,
    /// Order of both filters.
    pub filter_order: u32,
    /// New time step \[s\].
    pub resample_dt_s: Option<f64>,
    /// The factor on the samples, the last step.
    pub scale: Scale,
}

/// How the factor on the samples is determined.
#[derive(Debug, Clone, PartialEq)]
pub enum Scale {
    /// A given factor; 1 changes nothing.
    Factor(f64),
    /// The factor that gives a target peak |a|.
    Peak {
        /// The target peak |a| \[m/s²\].
        target_m_s2: f64,
    },
    /// The factor that gives a target pseudo-acceleration at one period.
    Sa {
        /// The pseudo-acceleration \[m/s²\].
        target_m_s2: f64,
        /// Its period \[s\].
        period_s: f64,
        /// Its damping ratio.
        damping_ratio: f64,
    },
    /// The factor that fits a pseudo-acceleration spectrum best: least squares of the logarithms,
    /// with equal weights for all periods.
    Spectrum(TargetSpectrum),
}

/// Order of the filters where none is given.
pub const FILTER_ORDER: u32 = 4;

impl Default for Processing {
    fn default() -> Self {
        Self {
            keep_mean: false,
            azimuth_deg: None,
            baseline: None,
            taper_ratio: None,
            low_cut_hz: None,
            high_cut_hz: None,
            filter_order: FILTER_ORDER,
            resample_dt_s: None,
            scale: Scale::Factor(1.0),
        }
    }
}

/// A processed motion, and what was done to it.
#[derive(Debug, Clone, PartialEq)]
pub struct Processed {
    /// The motion.
    pub motion: Motion,
    /// What was done, in order, one sentence per step.
    pub steps: Vec<String>,
    /// The factor that the samples were multiplied by.
    pub scale_ratio: f64,
    /// Warnings for readers of the results.
    pub notes: Vec<Note>,
}

/// Processes one component, in this order: mean of a raw record, baseline, taper, filter, time
/// step, scale.
///
/// # Errors
/// An azimuth, for which one component is not enough; a corner above half the sampling rate, a time
/// outside the record, or anything else that this record does not allow.
///
/// # Example
/// ```
/// use freestand_records::processing::{Processing, Scale, process};
/// use freestand_records::formats::{ReadOptions, parse_motions};
/// let text = b"time [s],a [g]\n0,0\n0.01,0.5\n0.02,0\n".to_vec();
/// let file = parse_motions(text, "x.csv".as_ref(), &ReadOptions::default())?;
/// let halved = Processing { scale: Scale::Factor(0.5), ..Processing::default() };
/// let processed = process(&file.components[0], &halved)?;
/// assert_eq!(processed.steps, ["multiplied by 0.5"]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn process(component: &Component, processing: &Processing) -> Result<Processed, Problem> {
    if let Some(azimuth_deg) = processing.azimuth_deg {
        let message = format!("an azimuth of {azimuth_deg} degrees needs two components, not one");
        return Err(Problem::value(
            message,
            "leave out `azimuth`, or rotate the record first with freestand motion rotate",
        ));
    }
    let mut unasked = Vec::new();
    let motion = without_mean(component, processing, &mut unasked)?;
    finish(motion, unasked, None, processing)
}

/// The requested component of a file, processed, and its name in words; with an azimuth, the two
/// horizontal components rotated to it.
///
/// # Errors
/// As [`MotionFile::select`], [`horizontal_pair`] and [`process`].
pub fn process_file(
    file: &MotionFile,
    component: Option<&str>,
    processing: &Processing,
) -> Result<(Processed, String), Problem> {
    let Some(azimuth_deg) = processing.azimuth_deg else {
        let chosen = file.select(component)?;
        let name = if file.components.len() == 1 {
            String::new()
        } else {
            format!(", component {}", chosen.name)
        };
        let processed =
            process(chosen, processing).map_err(|problem| problem.in_file(&file.path))?;
        return Ok((processed, name + &station_words(chosen)));
    };
    let (first, second) = horizontal_pair(file)?;
    let in_file = |problem: Problem| problem.in_file(&file.path);
    let names = (first.0.name.as_str(), second.0.name.as_str());
    let processed = turned(first, second, names, azimuth_deg, processing).map_err(in_file)?;
    let name = format!(", components {} and {}", names.0, names.1);
    Ok((processed, name + &station_words(first.0)))
}

fn station_words(component: &Component) -> String {
    component
        .station
        .as_ref()
        .map_or(String::new(), |station| format!(", {station}"))
}

/// All steps after the choice of a component.
///
/// What was done without a request, such as removing the mean of a raw record, is reported wherever
/// the motion is used.
fn finish(
    motion: Motion,
    unasked: Vec<Note>,
    turned: Option<String>,
    processing: &Processing,
) -> Result<Processed, Problem> {
    let steps = unasked.iter().map(Note::to_string).chain(turned).collect();
    let mut done = Processed {
        motion,
        notes: unasked,
        steps,
        scale_ratio: 1.0,
    };
    if let Some(baseline) = processing.baseline {
        done.add(without_baseline(&done.motion, baseline)?);
    }
    if let Some(share_ratio) = processing.taper_ratio {
        let motion = tapered(&done.motion, share_ratio)
            .map_err(|error| refused("taper", error, "give a share of the record such as 5 %"))?;
        done.add((
            motion,
            format!(
                "cosine taper over {} % at each end",
                number(100.0 * share_ratio, 6)
            ),
        ));
    }
    if let Some(pass) = pass(processing) {
        done.add(through_filter(&done.motion, pass, processing.filter_order)?);
    }
    if let Some(dt_s) = processing.resample_dt_s
        && dt_s != done.motion.dt_s()
    {
        done.add(at_step(&done.motion, dt_s)?);
    }
    let (factor, target) = factor(&done.motion, &processing.scale)?;
    let is_found = !matches!(processing.scale, Scale::Factor(_));
    // The step of a target is reported even if its factor is 1.
    if factor != 1.0 || is_found {
        let hint = "check the values and the scale";
        let words = factor_words(factor);
        let motion = done
            .motion
            .scaled(factor)
            .map_err(|error| refused(&format!("times {words}"), error, hint))?;
        done.add((motion, format!("multiplied by {words}{target}")));
    }
    done.scale_ratio = factor;
    done.notes
        .extend(target_notes(&processing.scale, done.motion.dt_s()));
    if is_found && !(1.0 / LARGE_FACTOR..=LARGE_FACTOR).contains(&factor) {
        let words = format!(
            "a record multiplied by {} no longer represents its earthquake: choose a record nearer to the target",
            number(factor, 4)
        );
        done.notes.push(Note::new(NoteKind::FarFactor, words));
    }
    Ok(done)
}

impl Processed {
    fn add(&mut self, (motion, step): (Motion, String)) {
        self.motion = motion;
        self.steps.push(step);
    }
}

fn without_baseline(motion: &Motion, baseline: Baseline) -> Result<(Motion, String), Problem> {
    let result = corrected(motion, baseline).map_err(|error| {
        refused(
            "baseline",
            error,
            "choose times within the record and a lower degree",
        )
    })?;
    let removed: Vec<f64> = motion
        .accel_m_s2()
        .iter()
        .zip(result.accel_m_s2())
        .map(|(a, b)| a - b)
        .collect();
    let largest = removed.iter().fold(
        0.0_f64,
        |most, &a| if a.abs() > most.abs() { a } else { most },
    );
    let largest = number(largest, 4);
    let step = match baseline {
        Baseline::Mean => format!("mean of {largest} m/s2 removed"),
        Baseline::PreEvent { until_s } => {
            format!("mean of {largest} m/s2 of the first {until_s} s removed")
        }
        Baseline::Polynomial { degree } => {
            format!(
                "polynomial of degree {degree} in the acceleration removed, at most {largest} m/s2"
            )
        }
        Baseline::Graizer { degree, from_s } => format!(
            "derivative of a polynomial of degree {degree} in the velocity from {from_s} s removed (Graizer 1979), at \
             most {largest} m/s2"
        ),
        Baseline::Boore2001 { t1_s, t2_s } => {
            let last = removed.last().map_or_else(String::new, |&a| number(a, 4));
            format!(
                "offsets removed between {t1_s} s and {t2_s} s and after them (Iwan 1985, Boore 2001), at most \
                 {largest} m/s2, at the end {last} m/s2"
            )
        }
    };
    Ok((result, step))
}

fn pass(processing: &Processing) -> Option<Pass> {
    Some(match (processing.low_cut_hz, processing.high_cut_hz) {
        (None, None) => return None,
        (Some(low_cut_hz), None) => Pass::High { low_cut_hz },
        (None, Some(high_cut_hz)) => Pass::Low { high_cut_hz },
        (Some(low_cut_hz), Some(high_cut_hz)) => Pass::Band {
            low_cut_hz,
            high_cut_hz,
        },
    })
}

fn through_filter(motion: &Motion, pass: Pass, order: u32) -> Result<(Motion, String), Problem> {
    let Filtered { motion, pad_s } = filtered(motion, pass, order)
        .map_err(|error| refused("filter", error, "change the cuts or the order"))?;
    let band = match pass {
        Pass::High { low_cut_hz } => format!("high-pass filter at {low_cut_hz} Hz"),
        Pass::Low { high_cut_hz } => format!("low-pass filter at {high_cut_hz} Hz"),
        Pass::Band {
            low_cut_hz,
            high_cut_hz,
        } => format!("filters from {low_cut_hz} Hz to {high_cut_hz} Hz"),
    };
    let pad = number(pad_s, 6);
    let step = format!(
        "Butterworth {band} of order {order}, forwards and backwards; {pad} s of zeros added before and after the \
         record: the motion starts {pad} s earlier"
    );
    Ok((motion, step))
}

fn at_step(motion: &Motion, dt_s: f64) -> Result<(Motion, String), Problem> {
    let result = resampled(motion, dt_s).map_err(|error| {
        refused(
            "resample",
            error,
            "choose a step shorter than the record and in a simple ratio to its step",
        )
    })?;
    let lost = if dt_s > motion.dt_s() {
        format!(", frequencies above {} Hz removed", number(0.5 / dt_s, 6))
    } else {
        String::new()
    };
    Ok((
        result,
        format!(
            "resampled from {} s to {dt_s} s (band-limited){lost}",
            motion.dt_s()
        ),
    ))
}

fn refused(step: &str, why: impl std::fmt::Display, hint: &str) -> Problem {
    Problem::value(format!("{step}: {why}"), hint)
}

#[cfg(test)]
mod tests;
