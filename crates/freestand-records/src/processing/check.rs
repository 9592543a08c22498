//! Checks of options that do not need a record.

use freestand::signal::baseline::{Baseline, MAX_DEGREE};
use freestand::signal::filter::MAX_ORDER;

use super::target::fault;
use super::{Processing, Scale, TargetSpectrum};
use freestand_input::problem::{Problem, ProblemKind};

impl Processing {
    /// What no record allows, each problem with its key (`low_cut`).
    pub fn problems(&self) -> Vec<(&'static str, Problem)> {
        let mut found = Vec::new();
        let mut check = |key, holds: bool, message: String, hint: &str| {
            if !holds {
                found.push((key, Problem::value(message, hint)));
            }
        };
        if let Some(azimuth_deg) = self.azimuth_deg {
            let message = format!("must be a finite angle, not {azimuth_deg} degrees");
            check("azimuth", azimuth_deg.is_finite(), message, "give it clockwise from north, such as 30 deg");
        }
        if let Some(share) = self.taper_ratio {
            let holds = share > 0.0 && share <= 0.5;
            check("taper", holds, format!("must be above 0 and at most 50 %, not {share}"), "5 % is usual");
        }
        for (key, corner_hz) in [("low_cut", self.low_cut_hz), ("high_cut", self.high_cut_hz)] {
            if let Some(hz) = corner_hz {
                let holds = is_positive(hz);
                check(key, holds, format!("must be above 0 Hz, not {hz} Hz"), "leave it out to omit the filter");
            }
        }
        if let (Some(low), Some(high)) = (self.low_cut_hz, self.high_cut_hz)
            && low > 0.0
            && high > 0.0
        {
            let message = format!("{low} Hz is not below the high cut of {high} Hz");
            check("low_cut", low < high, message, "frequencies between the two cuts are kept");
        }
        let message = format!("must be 1 to {MAX_ORDER}, not {}", self.filter_order);
        check("filter_order", (1..=MAX_ORDER).contains(&self.filter_order), message, "4 is usual");
        let step = self.resample_dt_s.map_or(Ok(()), |dt_s| crate::formats::check_step(dt_s, ProblemKind::Value));
        let baseline = self.baseline.map_or(Ok(()), check_baseline);
        let checked = [("baseline", baseline), ("resample", step), check_target(&self.scale)];
        found.extend(checked.into_iter().filter_map(|(key, result)| Some((key, result.err()?))));
        found
    }
}

/// Checks a degree and times that some record may allow.
fn check_baseline(baseline: Baseline) -> Result<(), Problem> {
    let degree = |degree: usize, least: usize| {
        let message = format!("the degree must be {least} to {MAX_DEGREE}, not {degree}");
        require((least..=MAX_DEGREE).contains(&degree), message, "1 is a straight line")
    };
    match baseline {
        Baseline::Mean => Ok(()),
        Baseline::PreEvent { until_s } => {
            let message = format!("the quiet time must be above 0 s, not {until_s} s");
            require(is_positive(until_s), message, "state how long the record is quiet at its start")
        }
        Baseline::Polynomial { degree: n } => degree(n, 0),
        Baseline::Graizer { degree: n, from_s } => {
            degree(n, 1)?;
            let message = format!("the start of the fit must be 0 s or later, not {from_s} s");
            require(is_zero_or_more(from_s), message, "state when the baseline begins to wander")
        }
        Baseline::Boore2001 { t1_s, t2_s } => {
            let message = format!("the times must be 0 s or later and one after the other, not {t1_s} s and {t2_s} s");
            let holds = is_zero_or_more(t1_s) && t1_s < t2_s && t2_s.is_finite();
            require(holds, message, "the shaking lasts from the first time to the second")
        }
    }
}

/// Checks a factor or target that some record may allow; returns the key with the result.
fn check_target(scale: &Scale) -> (&'static str, Result<(), Problem>) {
    match *scale {
        Scale::Factor(factor) => ("scale", check_scale(factor)),
        Scale::Peak { target_m_s2 } => {
            let message = format!("must be above 0, not {target_m_s2} m/s2");
            ("scale_to", require(is_positive(target_m_s2), message, "write it as 0.3 g"))
        }
        Scale::Sa { target_m_s2, period_s, damping_ratio } => {
            let message = format!("{target_m_s2} m/s2 at {period_s} s, damping {damping_ratio}, is not a target");
            let holds = is_positive(target_m_s2) && is_zero_or_more(period_s) && (0.0..1.0).contains(&damping_ratio);
            let hint = "give an acceleration above 0, a period of 0 s or more, and damping from 0 to below 100 %";
            ("scale_to_sa", require(holds, message, hint))
        }
        Scale::Spectrum(ref target) => ("scale_to_spectrum", check_spectrum(target)),
    }
}

fn check_spectrum(target: &TargetSpectrum) -> Result<(), Problem> {
    let (periods, targets, damping_ratio) = (target.periods_s.len(), target.psa_m_s2.len(), target.damping_ratio);
    let message = format!("the target spectrum has {targets} accelerations for {periods} periods");
    require(periods > 0 && periods == targets, message, "give at least one period, and one acceleration for each")?;
    let message = format!("the damping must be from 0 to below 100 %, not {damping_ratio}");
    require((0.0..1.0).contains(&damping_ratio), message, "5 % is usual")?;
    fault(&target.periods_s, &target.psa_m_s2).map_or(Ok(()), |(_, problem)| Err(problem))
}

fn is_positive(value: f64) -> bool {
    value > 0.0 && value.is_finite()
}

fn is_zero_or_more(value: f64) -> bool {
    value >= 0.0 && value.is_finite()
}

fn require(holds: bool, message: String, hint: &str) -> Result<(), Problem> {
    if holds { Ok(()) } else { Err(Problem::value(message, hint)) }
}

/// Checks a factor on the samples; a negative factor inverts the motion.
///
/// # Errors
/// Zero, or a factor that is not finite.
pub fn check_scale(scale_ratio: f64) -> Result<(), Problem> {
    let message = format!("scale must be a number other than 0, not {scale_ratio}");
    require(scale_ratio != 0.0 && scale_ratio.is_finite(), message, "leave it out to use the record as it is")
}
