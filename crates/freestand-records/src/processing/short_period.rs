//! Periods for which a record has few samples.

/// Samples per period that resolve its peaks well enough: between two of ten samples a sine loses
/// at most 1 − cos(π/10) = 5 % of its peak, and straight lines between them lose 1 − sinc²(1/10) =
/// 3 % of its amplitude.
const SAMPLES_A_PERIOD: f64 = 10.0;

/// The shortest period, and by how much the samples must be refined for it; `None` if there are
/// enough. A period of zero is the peak of the record itself.
pub fn samples_needed(periods_s: &[f64], dt_s: f64, upsample: usize) -> Option<(f64, f64)> {
    let shortest_s = periods_s
        .iter()
        .copied()
        .filter(|&t| t > 0.0)
        .fold(f64::INFINITY, f64::min);
    // Rounding in the last bits must not turn ten steps into fewer.
    let needed = (SAMPLES_A_PERIOD * dt_s / shortest_s * (1.0 - 1e-9)).ceil();
    (needed > upsample.max(1) as f64).then_some((shortest_s, needed))
}

/// A warning if a period has fewer than ten samples: peaks between them are missed. `of` says whose
/// periods they are.
///
/// # Example
/// ```
/// use freestand_records::processing::short_period_warning;
/// let warning = short_period_warning("the spectrum", &[0.0, 0.05, 1.0], 0.01).unwrap_or_default();
/// assert!(warning.ends_with("`resample = \"0.005 s\"` gives it ten"));
/// assert_eq!(short_period_warning("the spectrum", &[0.1], 0.01), None);
/// ```
pub fn short_period_warning(of: &str, periods_s: &[f64], dt_s: f64) -> Option<String> {
    let (shortest_s, needed) = samples_needed(periods_s, dt_s, 1)?;
    // Half a step is in a simple ratio to the step and is short to write.
    let step_s = dt_s / needed.log2().ceil().exp2();
    let few = few_steps(&format!("the shortest period of {of}"), shortest_s, dt_s);
    Some(format!(
        "{few}: peaks between them are missed; `resample = \"{step_s} s\"` gives it ten"
    ))
}

/// The beginning of all such warnings.
pub fn few_steps(which: &str, shortest_s: f64, dt_s: f64) -> String {
    format!("{which}, {shortest_s} s, has fewer than ten steps of {dt_s} s")
}
