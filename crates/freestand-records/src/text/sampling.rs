//! The time step of a column of printed times.

use super::even_grid::{TOO_SHORT, Uneven, common_step};
use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;

const FIRST_IS_TIME: &str = "the first column must be the time; without a time column, give `dt`";

/// The time step \[s\] of a sampling rate \[Hz\] on `line`.
///
/// # Errors
/// A rate that no instrument has; they sample at 50 to 1000 Hz. Some files hold rates of 1e30, and
/// a damaged number must not become a step of nanoseconds.
pub(crate) fn step_of_rate(rate_hz: f64, line: usize) -> Result<f64, Problem> {
    if rate_hz > 0.0 && rate_hz <= 1e5 {
        return Ok(1.0 / rate_hz);
    }
    Err(Problem::format(
        format!("the sampling rate is {rate_hz} Hz"),
        "this header line must give samples per second, such as 100 or 200: correct it",
    )
    .at_line(line))
}

/// The step of equally spaced `times`, in their own unit. Their last printed digit counts
/// 10^`last_digit_exponent`.
///
/// A time may be off by half a unit of its last digit, because it was rounded, or by 1 % of the
/// step, because clocks jitter; the effect of that on a response is negligible. The allowance for
/// rounding holds only while a unit is below half the step: beyond that, a lost sample could hide
/// in it.
pub(crate) fn time_step(times: &[f64], last_digit_exponent: i32) -> Result<f64, Uneven> {
    let (first, last) = Uneven::ends(times)?;
    let intervals = times.len().saturating_sub(1) as f64;
    if intervals == 0.0 {
        return Err(Uneven::at(0, "one sample spans no time", TOO_SHORT));
    }
    let mean = (last - first) / intervals;
    if let Some(i) = times.windows(2).position(|pair| pair[1] < pair[0]) {
        return Err(Uneven::falling(times, i + 1, FIRST_IS_TIME));
    }
    if !(mean > 0.0 && mean.is_finite()) {
        return Err(Uneven::falling(times, 1, FIRST_IS_TIME));
    }
    let digit = 10f64.powi(last_digit_exponent.clamp(-300, 300));
    let rounding = if digit < 0.5 * mean { digit } else { 0.0 };
    // A time may be off the straight line by a whole unit, because the ends of the line are rounded
    // too. A lost sample bends the line by only half a step, but doubles its interval; an interval
    // has two rounded ends.
    let noise = 4.0 * f64::EPSILON * first.abs().max(last.abs());
    let off_line = rounding.max(0.01 * mean) * (1.0 + 1e-9) + noise;
    let off_step = rounding.max(0.02 * mean) * (1.0 + 1e-9) + noise;
    let odd_time = |i: usize| (times[i] - (first + i as f64 * mean)).abs() > off_line;
    let odd_step = |i: usize| ((times[i] - times[i - 1]) - mean).abs() > off_step;
    match (1..times.len()).find(|&i| odd_time(i) || odd_step(i)) {
        None => Ok(plain_step(times, first, last, mean)),
        Some(found) => Err(uneven(times, found, mean, digit)),
    }
}

/// Of all steps that agree with both ends, the one that a person would have chosen.
fn plain_step(times: &[f64], first: f64, last: f64, mean: f64) -> f64 {
    let intervals = (times.len() - 1) as f64;
    let noise = 4.0 * f64::EPSILON * first.abs().max(last.abs());
    // Times printed in full as i·dt hold dt itself in the second row. Only this reads freestand's
    // own files back to the bit.
    if first == 0.0 && (intervals * times[1] - last).abs() <= noise {
        return times[1];
    }
    // Otherwise the shortest decimal: (39.89 - 0.01)/3988 is 0.01, not 0.010000000000000002.
    for digits in 0..17 {
        if let Ok(step) = format!("{mean:.digits$e}").parse::<f64>()
            && (intervals * (step - mean)).abs() <= noise
        {
            return step;
        }
    }
    mean
}

/// Finds the row where the step changes, which need not be the first that is off the straight line.
fn uneven(times: &[f64], found: usize, mean: f64, digit: f64) -> Uneven {
    let mut steps = steps_of(times);
    let usual = middle(&mut steps);
    let is_odd = |step: f64| (step - usual).abs() > digit.min(0.5 * usual) + 0.02 * usual;
    let odd_steps = steps.iter().filter(|&&step| is_odd(step)).count();
    // A single odd step is a gap; if one step in ten is odd, or most are zero, the times have too few digits.
    if digit >= 0.5 * mean && (odd_steps * 10 > steps.len() || usual == 0.0) && steps.len() > 10 {
        let message = format!(
            "the times are printed too coarsely for a step of about {}",
            number(mean)
        );
        return Uneven::at(found, message, "remove the time column and give `dt`");
    }
    let row = times
        .windows(2)
        .position(|pair| is_odd(pair[1] - pair[0]))
        .map_or(found, |i| i + 1);
    let step = times[row] - times[row - 1];
    // Where the other samples are even, a line over what is missing would be made up.
    let is_gap = odd_steps * 100 <= steps.len() && step > 1.5 * usual;
    let hint = match is_gap {
        _ if step == 0.0 => "a record has one value at each time: remove the row that is too many",
        true => "samples are missing: fetch the record again, or cut it before the gap",
        false => "resample the record to equal time steps",
    };
    Uneven {
        row,
        message: format!(
            "uneven sampling: {} after {}, where the step is {}",
            number(times[row]),
            number(times[row - 1]),
            number(usual)
        ),
        hint,
        is_mended_by_lines: !is_gap && step != 0.0,
    }
}

/// A step for interpolating unevenly spaced `times`: the longest that has them all on its grid,
/// unless that is far below the usual step; then the usual step. `None` if the times do not
/// increase.
pub(crate) fn even_step(times: &[f64], last_digit_exponent: i32) -> Option<f64> {
    let mut steps = steps_of(times);
    if steps.is_empty() || !steps.iter().all(|step| *step > 0.0 && step.is_finite()) {
        return None;
    }
    let usual = middle(&mut steps);
    let common = common_step(times, last_digit_exponent).filter(|step| *step >= 0.1 * usual);
    common.or_else(|| format!("{usual:.2e}").parse().ok())
}

fn steps_of(times: &[f64]) -> Vec<f64> {
    times.windows(2).map(|pair| pair[1] - pair[0]).collect()
}

/// The middle one by size.
fn middle(steps: &mut [f64]) -> f64 {
    *steps
        .select_nth_unstable_by(steps.len() / 2, f64::total_cmp)
        .1
}

fn number(value: f64) -> String {
    // Nine digits show every printed time and hide the rounding of a difference.
    let rounded = format!("{value:.8e}").parse::<f64>().unwrap_or(value);
    shorten(&rounded.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rounded(dt: f64, decimals: i32, n: usize, start: usize) -> Vec<f64> {
        let unit = 10f64.powi(decimals);
        (start..start + n)
            .map(|i| (i as f64 * dt * unit).round() / unit)
            .collect()
    }

    #[test]
    fn a_rate_gives_the_step_or_is_refused() {
        // Exact: one division.
        assert_eq!(
            [100.0, 200.0, 1e5].map(|rate| step_of_rate(rate, 7).ok()),
            [Some(0.01), Some(0.005), Some(1e-5)]
        );
        for rate in [0.0, -100.0, 1.1e5, 1.7e38, f64::NAN, f64::INFINITY] {
            assert_eq!(
                step_of_rate(rate, 7).unwrap_err().to_string(),
                format!("line 7: the sampling rate is {rate} Hz")
            );
        }
    }

    #[test]
    fn printed_times_give_the_step_that_was_meant() {
        // Exact: these steps are decimals, and must come back as the nearest f64 to them.
        for (dt, decimals, start) in [
            (0.01, 4, 0),
            (0.01, 2, 1),
            (0.02, 2, 0),
            (0.005, 3, 7),
            (1.0, 0, 0),
            (5.0, 0, 1000),
        ] {
            assert_eq!(
                time_step(&rounded(dt, decimals, 3989, start), -decimals),
                Ok(dt),
                "{dt} {start}"
            );
        }
        // All digits of any step, as in freestand's own files.
        for dt in [1.0 / 256.0, 1.0 / 3.0, 0.1 + 0.2, 1e-9, 12345.678] {
            let times: Vec<f64> = (0..5000).map(|i| f64::from(i) * dt).collect();
            assert_eq!(time_step(&times, -20), Ok(dt));
        }
        // 1/256 s printed to the millisecond: each end is off by 0.5 ms at most, so the mean by 1
        // ms/(n - 1).
        let step = time_step(&rounded(1.0 / 256.0, 3, 2000, 0), -3).unwrap();
        assert!((step - 1.0 / 256.0).abs() < 1e-3 / 1999.0, "{step}");
    }

    #[test]
    fn a_gap_is_found_where_it_is() {
        for (dt, decimals) in [(0.01, 4), (0.005, 3), (1.0 / 256.0, 3), (1.0, 0), (0.01, 2)] {
            for lost in [1, 500, 998] {
                let mut times = rounded(dt, decimals, 1000, 0);
                times.remove(lost);
                let problem = time_step(&times, -decimals).expect_err("a gap");
                assert_eq!(problem.row, lost, "{dt} {problem:?}");
                assert!(problem.message.contains("uneven"), "{problem:?}");
                let mut times = rounded(dt, decimals, 1000, 0);
                times.insert(lost, times[lost]);
                assert!(time_step(&times, -decimals).is_err(), "a repeated row");
            }
        }
    }

    #[test]
    fn jitter_of_a_clock_is_taken_and_what_is_no_time_is_not() {
        let jittered: Vec<f64> = (0..100)
            .map(|i| f64::from(i) * 0.01 + if i % 2 == 1 { 0.9e-4 } else { 0.0 })
            .collect();
        assert!(time_step(&jittered, -6).is_ok());
        assert!(
            time_step(&[0.0, 0.01, 0.005], -3)
                .unwrap_err()
                .message
                .contains("does not increase")
        );
        assert!(time_step(&[0.0, 0.0, 0.0], -3).is_err());
        assert!(time_step(&[1.0], 0).is_err() && time_step(&[], 0).is_err());
        assert!(time_step(&[0.0, f64::MAX, f64::MAX], 300).is_err());
        // 1/1500 s printed to the millisecond repeats times: the step cannot be told from a lost
        // sample.
        let coarse = time_step(&rounded(1.0 / 1500.0, 3, 1000, 0), -3).unwrap_err();
        assert!(coarse.message.contains("coarse"), "{coarse:?}");
        // Most times repeat: a clock in ms beside samples at 39 kHz.
        let coarser = time_step(&rounded(1.0 / 39_000.0, 3, 1000, 0), -3).unwrap_err();
        assert!(coarser.message.contains("coarse"), "{coarser:?}");
    }
}
