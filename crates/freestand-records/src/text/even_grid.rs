//! Interpolates unevenly spaced points on straight lines to equally spaced samples.

pub(crate) const TOO_SHORT: &str = "a motion needs 2 samples or more";

/// Why times are not equally spaced.
#[derive(Debug, PartialEq)]
pub(crate) struct Uneven {
    /// The row where it was found, from 0.
    pub(crate) row: usize,
    pub(crate) message: String,
    pub(crate) hint: &'static str,
    /// Whether interpolation mends it: the steps differ throughout, and nothing is missing.
    pub(crate) is_mended_by_lines: bool,
}

impl Uneven {
    /// Times that interpolation does not mend.
    pub(crate) fn at(row: usize, message: impl Into<String>, hint: &'static str) -> Self {
        Self {
            row,
            message: message.into(),
            hint,
            is_mended_by_lines: false,
        }
    }

    /// The first and the last time.
    ///
    /// # Errors
    /// No times.
    pub(crate) fn ends(times: &[f64]) -> Result<(f64, f64), Self> {
        let ends = times.first().copied().zip(times.last().copied());
        ends.ok_or_else(|| Self::at(0, "there are no times", TOO_SHORT))
    }

    /// A time that is not above the one before it.
    pub(crate) fn falling(times: &[f64], row: usize, hint: &'static str) -> Self {
        let message = format!(
            "the time does not increase: {} after {}",
            times[row],
            times[row - 1]
        );
        Self::at(row, message, hint)
    }
}

/// Samples at `times_s[0] + i·dt_s`, up to the last time, on the straight lines between the points.
///
/// A point on the grid keeps its value to the bit. Two points at one time count as one point if
/// their values are equal.
///
/// # Errors
/// A time that does not increase, a step that is not positive, more than `most` samples; the row
/// counts from 0.
pub(crate) fn on_even_grid(
    times_s: &[f64],
    values: &[f64],
    dt_s: f64,
    most: usize,
) -> Result<Vec<f64>, Uneven> {
    let (first, last) = Uneven::ends(times_s)?;
    let rises = |i: usize| {
        times_s[i] > times_s[i - 1] || times_s[i] == times_s[i - 1] && values[i] == values[i - 1]
    };
    let points = times_s.len().min(values.len());
    if let Some(row) = (1..points).find(|&i| !rises(i)) {
        let hint = "a record has one value at each time: repair the record";
        return Err(Uneven::falling(times_s, row, hint));
    }
    // The last point is on the grid if only rounding separates them.
    let steps = ((last - first) / dt_s + ON_GRID).floor();
    if !(dt_s > 0.0 && steps < most as f64) {
        let message =
            format!("the record from {first} s to {last} s is too long for steps of {dt_s} s");
        return Err(Uneven::at(
            0,
            message,
            "choose a longer step with `resample`",
        ));
    }
    let mut samples = Vec::with_capacity(steps as usize + 1);
    // The point at or before the sample.
    let mut point = 0;
    for i in 0..=steps as usize {
        let time = first + i as f64 * dt_s;
        while point + 1 < points && times_s[point + 1] <= time + ON_GRID * dt_s {
            point += 1;
        }
        let (t0, v0) = (times_s[point], values[point]);
        let is_on_point = (time - t0).abs() <= ON_GRID * dt_s;
        samples.push(match (times_s.get(point + 1), values.get(point + 1)) {
            (Some(t1), Some(v1)) if !is_on_point => v0 + (v1 - v0) * ((time - t0) / (t1 - t0)),
            _ => v0,
        });
    }
    Ok(samples)
}

/// A point and a sample closer than this part of a step are at the same time: i·dt is off by some
/// units in the last place, 1e-16 of a time, and a record has fewer than 1e8 steps.
const ON_GRID: f64 = 1e-6;

/// The longest step that has all of `times_s` on its grid. The last printed digit counts
/// 10^`last_digit_exponent` seconds. `None` if all times are equal or span more than 2⁵³ such
/// units.
///
/// With this step, [`on_even_grid`] keeps every point.
pub(crate) fn common_step(times_s: &[f64], last_digit_exponent: i32) -> Option<f64> {
    let first = *times_s.first()?;
    let per_second = 10f64.powi(last_digit_exponent.checked_neg()?.clamp(-300, 300));
    let mut divisor = 0u64;
    for time_s in times_s {
        let units = ((time_s - first).abs() * per_second).round();
        // Beyond this, f64 does not hold every whole number.
        if units.is_nan() || units > 9_007_199_254_740_992.0 {
            return None;
        }
        divisor = greatest_common_divisor(divisor, units as u64);
    }
    // Parsed, so that it is the f64 nearest to the decimal: 5e-3, not 5 times 0.001.
    let step = format!("{divisor}e{last_digit_exponent}").parse().ok();
    step.filter(|_| divisor > 0)
}

fn greatest_common_divisor(mut a: u64, mut b: u64) -> u64 {
    while b > 0 {
        (a, b) = (b, a % b);
    }
    a
}

#[cfg(test)]
mod tests {
    use super::*;

    const MAX: usize = 1_000_000;

    #[test]
    fn points_keep_their_values_and_lines_stay_straight() {
        // Exact: halves and quarters are exact in binary.
        assert_eq!(
            on_even_grid(&[0.0, 1.0, 1.5, 3.5], &[2.0, 4.0, -1.0, 7.0], 0.5, MAX).unwrap(),
            [2.0, 3.0, 4.0, -1.0, 1.0, 3.0, 5.0, 7.0]
        );
        // The grid starts at the first time and ends at or before the last.
        assert_eq!(
            on_even_grid(&[0.25, 1.0, 1.25], &[1.0, 4.0, 4.0], 0.75, MAX).unwrap(),
            [1.0, 4.0]
        );
        // One point twice is one point.
        assert_eq!(
            on_even_grid(&[0.0, 1.0, 1.0, 2.0], &[0.0, 3.0, 3.0, 1.0], 1.0, MAX).unwrap(),
            [0.0, 3.0, 1.0]
        );
    }

    #[test]
    fn every_printed_point_is_found_again_on_the_common_step() {
        // Times in milliseconds, as printed.
        let ms: Vec<u32> = (0..4000)
            .scan(7u32, |t, i| {
                Some(std::mem::replace(t, *t + 3 + i * 7919 % 60))
            })
            .collect();
        let times: Vec<f64> = ms
            .iter()
            .map(|ms| format!("{ms}e-3").parse().unwrap())
            .collect();
        let values: Vec<f64> = (0..4000)
            .map(|i| f64::from(i * 7919 % 2001 - 1000) * 1e-3)
            .collect();
        assert_eq!(common_step(&times, -3), Some(0.001));
        let samples = on_even_grid(&times, &values, 0.001, MAX).unwrap();
        assert_eq!(samples.len() as u32, ms.last().unwrap() - ms[0] + 1);
        for (ms_of, value) in ms.iter().zip(&values) {
            assert_eq!(
                samples[(ms_of - ms[0]) as usize],
                *value,
                "exact: a point on the grid is taken as it is"
            );
        }
        // Straight between: the second difference vanishes but for rounding. Times below 200 s are
        // off by 3e-14 s, intervals are 3 ms or more and values differ by 2 at most, in four terms:
        // 8e-11.
        let is_point: std::collections::HashSet<u32> = ms.iter().map(|t| t - ms[0]).collect();
        for i in (1..samples.len() - 1).filter(|i| !is_point.contains(&(*i as u32))) {
            assert!((samples[i - 1] - 2.0 * samples[i] + samples[i + 1]).abs() < 1e-10);
        }
    }

    #[test]
    fn common_steps_are_decimals() {
        assert_eq!(common_step(&[0.01, 0.03, 0.07], -2), Some(0.02));
        assert_eq!(common_step(&[0.0, 0.005, 0.02], -3), Some(0.005));
        assert_eq!(common_step(&[1.0, 1.0], -3), None);
        assert_eq!(common_step(&[], -3), None);
        assert_eq!(common_step(&[0.0, 1e300], -3), None);
        assert_eq!(common_step(&[0.0, 40.0, 100.0], 1), Some(20.0));
    }

    #[test]
    fn what_is_no_time_is_refused() {
        let row = |times: &[f64], dt_s: f64| {
            on_even_grid(times, &[1.0, 2.0, 3.0], dt_s, MAX)
                .unwrap_err()
                .row
        };
        assert_eq!(row(&[0.0, 1.0, 0.5], 0.1), 2);
        assert_eq!(row(&[0.0, 0.0, 0.5], 0.1), 1);
        assert_eq!(row(&[0.0, f64::NAN, 0.5], 0.1), 1);
        assert_eq!(row(&[0.0, 1.0, 1e6], 0.001), 0);
        assert!(on_even_grid(&[0.0, 1.0], &[1.0, 2.0], 0.0, MAX).is_err());
        assert!(on_even_grid(&[0.0, 1.0], &[1.0, 2.0], f64::NAN, MAX).is_err());
        assert!(on_even_grid(&[], &[], 0.1, MAX).is_err());
        // No memory is reserved for more samples than `MAX`: 1e15 of them here.
        assert!(on_even_grid(&[0.0, 1e9], &[1.0, 2.0], 1e-6, MAX).is_err());
        assert_eq!(
            on_even_grid(&[0.0, 1.0], &[1.0, 2.0], 0.25, 5)
                .unwrap()
                .len(),
            5
        );
        assert!(on_even_grid(&[0.0, 1.0], &[1.0, 2.0], 0.25, 4).is_err());
    }
}
