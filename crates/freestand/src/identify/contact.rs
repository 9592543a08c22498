//! The beginning and end of the pulse of a drop test, its zero line, and the faults of the record.

use super::Flag;
use super::fit::solve;
use crate::G0_M_S2;

/// The search finds pulses above this share of the largest excursion; smaller ones are noise or
/// later bounces.
const PULSE_SHARE: f64 = 0.2;
/// A sample belongs to the contact if it is above the zero line by this many standard deviations of
/// the noise.
const THRESHOLD_SIGMA: f64 = 5.0;
/// Smallest threshold as a share of the peak: a record without noise still shows the ringing of
/// filters and rounding.
const THRESHOLD_SHARE: f64 = 0.02;
/// The zero line is the mean over this many contact times before the contact; earlier, the mass may
/// have been held.
const BEFORE: usize = 20;
/// Flanks are located in the moving mean over this part of the pulse: single samples of a noisy
/// flank cross a level many times.
const SMOOTH_PART: usize = 60;
/// Smallest number of samples from which a shifted zero line after the pulse is determined.
const MIN_PLATEAU: usize = 20;
/// Smallest number of samples before the contact, for a mean and its scatter.
const MIN_PRE: usize = 10;
/// A shift or a drift below this share of the peak is accepted.
pub(super) const ZERO_SHIFT_GATE: f64 = 0.005;
/// The window after the contact, in contact times.
const AFTER: f64 = 5.0;
/// A shift is significant above this many standard errors.
const SIGNIFICANT: f64 = 5.0;

/// The first pulse of a record, in samples and in the record's unit (m/s²).
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Pulse {
    /// Last sample below the threshold before the pulse.
    pub(super) before: usize,
    /// First sample below the threshold after the pulse.
    pub(super) after: usize,
    /// Zero line.
    pub(super) zero_m_s2: f64,
    /// Standard deviation before the contact.
    pub(super) noise_m_s2: f64,
    /// Number of samples of the zero line.
    pub(super) pre_count: usize,
    /// Largest sample above the zero line.
    pub(super) peak_m_s2: f64,
    /// (zero after − zero before)/peak; `None` where too few samples follow.
    pub(super) zero_shift_ratio: Option<f64>,
    /// From the end of this pulse to the next one, in samples.
    pub(super) flight: Option<usize>,
    pub(super) flags: Vec<Flag>,
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

fn deviation(values: &[f64]) -> f64 {
    let m = mean(values);
    let sum: f64 = values.iter().map(|v| (v - m).powi(2)).sum();
    (sum / (values.len().max(2) - 1) as f64).sqrt()
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(0.0)
}

/// Finds the first pulse and flags what makes it unusable; `Err` where there is no pulse at all.
pub(super) fn find(samples: &[f64]) -> Result<Pulse, Flag> {
    let rough_zero = median(samples);
    let highest = samples
        .iter()
        .fold(0.0, |most: f64, a| most.max(a - rough_zero));
    let lowest = samples
        .iter()
        .fold(0.0, |most: f64, a| most.max(rough_zero - a));
    if lowest > 2.0 * highest {
        // Where the pulse fills the record, the median is not a zero line.
        let quiet = samples
            .iter()
            .filter(|a| (*a - rough_zero).abs() < PULSE_SHARE * lowest)
            .count();
        return Err(if 5 * quiet > 2 * samples.len() {
            Flag::UpsideDown
        } else {
            Flag::NoPreTrigger
        });
    }
    if highest <= 0.0 {
        return Err(Flag::NoPulse);
    }
    let (smooth, reach) = smoothed(samples, rough_zero, highest);
    let highest = smooth
        .iter()
        .fold(0.0, |most: f64, a| most.max(a - rough_zero));
    let level = rough_zero + PULSE_SHARE * highest;
    let Some(rise) = smooth.iter().position(|&a| a > level) else {
        return Err(Flag::NoPulse);
    };
    let width = fall(&smooth, rise, level, reach) - rise;
    // A soft cushion rises slowly: samples that may already belong to the contact are not part of
    // the zero line.
    let guard = (width / 4).max(1);
    if rise < MIN_PRE + guard {
        return Err(Flag::NoPreTrigger);
    }
    let (zero, noise) = (
        mean(&samples[..rise - guard]),
        deviation(&samples[..rise - guard]),
    );
    let quiet = deviation(&smooth[..rise - guard]);
    let end = fall(
        &smooth,
        rise,
        zero + (THRESHOLD_SIGMA * quiet).max(THRESHOLD_SHARE * highest),
        reach,
    );
    let peak = samples[rise..end]
        .iter()
        .fold(0.0, |most: f64, a| most.max(a - zero));
    if peak < 8.0 * noise {
        return Err(Flag::NoPulse);
    }
    let threshold = zero + (THRESHOLD_SIGMA * quiet).max(THRESHOLD_SHARE * peak);
    let before = smooth[..rise]
        .iter()
        .rposition(|&a| a <= threshold)
        .unwrap_or(0);
    let mut after = fall(&smooth, rise, threshold, reach);
    if after >= samples.len()
        && let Some(plateau) = plateau(
            &smooth,
            fall(&smooth, rise, zero + PULSE_SHARE * peak, reach),
            quiet,
            peak,
        )
    {
        after = fall(&smooth, rise, plateau + threshold - zero, reach);
    }
    // Again with the guard as a share of the whole contact, as a root at its beginning (Hertz)
    // requires.
    let guard = (after - before).div_ceil(10);
    if before < MIN_PRE + guard {
        return Err(Flag::NoPreTrigger);
    }
    let all = &samples[..before - guard];
    let pre = &all[all.len().saturating_sub(BEFORE * (after - before))..];
    let mut pulse = Pulse {
        before,
        after,
        zero_m_s2: mean(pre),
        noise_m_s2: deviation(pre),
        pre_count: pre.len(),
        peak_m_s2: peak,
        zero_shift_ratio: None,
        flight: None,
        flags: Vec::new(),
    };
    pulse.noise_m_s2 = pulse.noise_m_s2.max(resolution(samples) / 12f64.sqrt());
    let post = post_window(&smooth, &mut pulse, threshold);
    if after >= samples.len() {
        pulse.flags.push(Flag::CutOff);
    }
    judge_zero(pre, &samples[post], &mut pulse);
    let (rise, error) = trend(all);
    // Where more than the noise remains about the fitted line, the cause is not drift: the mass
    // was held and released.
    let left = error * (all.len() as f64 / 12.0).sqrt();
    let is_drift = rise.abs() > ZERO_SHIFT_GATE * peak && rise.abs() > SIGNIFICANT * error;
    if is_drift
        && left < 2.0 * pulse.noise_m_s2.max(1e-3 * peak)
        && !pulse.flags.contains(&Flag::Drift)
    {
        pulse.flags.push(Flag::Drift);
    }
    if is_clipped(
        &samples[before..after.min(samples.len())],
        pulse.noise_m_s2,
        least_step(samples),
    ) {
        pulse.flags.push(Flag::Clipped);
    }
    Ok(pulse)
}

/// A pulse of a record, in samples.
#[derive(Debug, Clone, Copy)]
struct Bump {
    from: usize,
    to: usize,
    peak_m_s2: f64,
    /// ∫a dt \[m/s\].
    impulse_m_s: f64,
}

/// One drop of a record, with its bounces.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Part {
    /// The samples that belong to it: up to the middle between it and its neighbours.
    pub(super) samples: std::ops::Range<usize>,
    /// The sample at which its pulse has risen to a fifth of the largest.
    pub(super) start: usize,
}

/// The drops of a record. A later pulse is a bounce of the drop before it if the flight between them
/// gives e = gT/(2v) ≤ 1 and it is weaker than that drop's; otherwise a drop of its own. `speed_m_s`
/// is the impact velocity; without it v follows from the impulse, (1 + e) v. Pulses below a fifth of
/// the largest are bounces or handling. Empty if no pulse is found.
pub(super) fn parts(samples: &[f64], dt_s: f64, speed_m_s: Option<f64>) -> Vec<Part> {
    let zero = median(samples);
    let highest = samples.iter().fold(0.0, |most: f64, a| most.max(a - zero));
    let lowest = samples.iter().fold(0.0, |most: f64, a| most.max(zero - a));
    // What `find` refuses has no parts.
    if lowest > 2.0 * highest || highest <= 0.0 {
        return Vec::new();
    }
    let (smooth, reach) = smoothed(samples, zero, highest);
    let highest = smooth.iter().fold(0.0, |most: f64, a| most.max(a - zero));
    let bumps = bumps(&smooth, zero, zero + PULSE_SHARE * highest, reach, dt_s);
    let mut drops: Vec<(Bump, Bump)> = Vec::new();
    for bump in bumps {
        let is_bounce = drops.last().is_some_and(|(first, last)| {
            let flight_s = bump.from.saturating_sub(last.to) as f64 * dt_s;
            let rebound_m_s = 0.5 * G0_M_S2 * flight_s;
            let speed_m_s = speed_m_s.unwrap_or(first.impulse_m_s - rebound_m_s);
            rebound_m_s <= speed_m_s && bump.peak_m_s2 < first.peak_m_s2
        });
        match drops.last_mut() {
            Some((_, last)) if is_bounce => *last = bump,
            _ => drops.push((bump, bump)),
        }
    }
    let middle = |i: usize| match (
        i.checked_sub(1).and_then(|before| drops.get(before)),
        drops.get(i),
    ) {
        (None, _) => 0,
        (Some(_), None) => samples.len(),
        (Some((_, before)), Some((next, _))) => before.to + (next.from - before.to) / 2,
    };
    let part = |(i, (first, _)): (usize, &(Bump, Bump))| Part {
        samples: middle(i)..middle(i + 1),
        start: first.from,
    };
    drops.iter().enumerate().map(part).collect()
}

/// The pulses above a level; two that are closer than the first is long are one.
fn bumps(smooth: &[f64], zero: f64, level: f64, reach: usize, dt_s: f64) -> Vec<Bump> {
    let mut found: Vec<Bump> = Vec::new();
    let mut at = 0;
    while let Some(rise) = smooth
        .get(at..)
        .and_then(|rest| rest.iter().position(|&a| a > level))
    {
        let from = at + rise;
        let to = fall(smooth, from, level, reach).max(from + 1);
        let inside = smooth.get(from..to).unwrap_or_default();
        let bump = Bump {
            from,
            to,
            peak_m_s2: inside.iter().fold(0.0, |most: f64, a| most.max(a - zero)),
            impulse_m_s: inside.iter().map(|a| a - zero).sum::<f64>() * dt_s,
        };
        match found.last_mut() {
            Some(last) if from - last.to < last.to - last.from => {
                last.to = to;
                last.peak_m_s2 = last.peak_m_s2.max(bump.peak_m_s2);
                last.impulse_m_s += bump.impulse_m_s;
            }
            _ => found.push(bump),
        }
        at = to;
    }
    found
}

/// The moving mean over a small part of the first high pulse, and how many samples it reaches to
/// each side. The pulse lasts from half of the largest sample down to a fifth, a difference that
/// exceeds the noise.
fn smoothed(samples: &[f64], zero: f64, highest: f64) -> (Vec<f64>, usize) {
    let rise = samples
        .iter()
        .position(|&a| a > zero + 0.5 * highest)
        .unwrap_or(0);
    let width = samples[rise..]
        .iter()
        .take_while(|&&a| a > zero + PULSE_SHARE * highest)
        .count();
    let reach = width / SMOOTH_PART;
    let of = |i: usize| mean(&samples[i.saturating_sub(reach)..(i + reach + 1).min(samples.len())]);
    ((0..samples.len()).map(of).collect(), reach)
}

/// The first sample from `from` on that is not above `level` and is not soon followed by one that
/// is.
fn fall(samples: &[f64], from: usize, level: f64, reach: usize) -> usize {
    let is_down = |i: usize| {
        samples[i..samples.len().min(i + 2 + 2 * reach)]
            .iter()
            .all(|&a| a <= level)
    };
    (from..samples.len())
        .find(|&i| is_down(i))
        .unwrap_or(samples.len())
}

/// The level at which a record stays from `from` on, if it stays: a zero line that the impact
/// shifted.
fn plateau(smooth: &[f64], from: usize, quiet: f64, peak: f64) -> Option<f64> {
    let tail = smooth
        .get(from..)
        .filter(|tail| tail.len() >= MIN_PLATEAU)?;
    let level = median(tail);
    let apart: Vec<f64> = tail.iter().map(|a| (a - level).abs()).collect();
    let (first, last) = tail.split_at(tail.len() / 2);
    let is_level = (median(first) - median(last)).abs() <= ZERO_SHIFT_GATE * peak + quiet;
    (is_level && median(&apart) <= ZERO_SHIFT_GATE * peak + 2.0 * quiet).then_some(level)
}

/// The quiet part after the pulse, up to the next bounce.
fn post_window(samples: &[f64], pulse: &mut Pulse, threshold: f64) -> std::ops::Range<usize> {
    let contact = pulse.after - pulse.before;
    let from = (pulse.after + contact.div_ceil(4).max(2)).min(samples.len());
    let next = samples[from..]
        .iter()
        .position(|&a| a > threshold.max(pulse.zero_m_s2 + 0.1 * pulse.peak_m_s2));
    pulse.flight = next.map(|steps| from + steps - pulse.after);
    let quiet = next.map_or(samples.len(), |steps| {
        from + steps.saturating_sub(contact.div_ceil(4))
    });
    let most = from + (AFTER * contact as f64).ceil() as usize;
    from..quiet.clamp(from, most.max(from))
}

/// Zero shift and drift.
fn judge_zero(pre: &[f64], post: &[f64], pulse: &mut Pulse) {
    let of_peak = |value: f64| value / pulse.peak_m_s2;
    let mut flags = Vec::new();
    if post.len() >= 5 {
        let shift = of_peak(mean(post) - pulse.zero_m_s2);
        let error =
            of_peak(pulse.noise_m_s2 * (1.0 / post.len() as f64 + 1.0 / pre.len() as f64).sqrt());
        pulse.zero_shift_ratio = Some(shift);
        if shift.abs() > ZERO_SHIFT_GATE && shift.abs() > SIGNIFICANT * error {
            flags.push(Flag::ZeroShift);
        }
    }
    for window in [pre, post] {
        let (rise, error) = trend(window);
        if of_peak(rise.abs()) > ZERO_SHIFT_GATE
            && rise.abs() > SIGNIFICANT * error
            && !flags.contains(&Flag::Drift)
        {
            flags.push(Flag::Drift);
        }
    }
    pulse.flags.extend(flags);
}

/// The rise of the regression line of a window from its first to its last sample, and the standard
/// error of that rise.
fn trend(window: &[f64]) -> (f64, f64) {
    let count = window.len() as f64;
    if window.len() < MIN_PRE {
        return (0.0, 0.0);
    }
    let centre = 0.5 * (count - 1.0);
    let m = mean(window);
    let xx = count * (count * count - 1.0) / 12.0;
    let slope = window
        .iter()
        .enumerate()
        .map(|(i, v)| (i as f64 - centre) * (v - m))
        .sum::<f64>()
        / xx;
    let left: f64 = window
        .iter()
        .enumerate()
        .map(|(i, v)| (v - m - slope * (i as f64 - centre)).powi(2))
        .sum();
    (
        slope * (count - 1.0),
        (left / (count - 2.0) / xx).sqrt() * (count - 1.0),
    )
}

/// Equal largest samples that may be a flat top.
const FLAT_TOP: usize = 3;
/// Samples below this share of the peak say nothing about its top.
const TOP_SHARE: f64 = 0.2;
/// Steps of rounding by which the flanks of a round top point above it at most: four where it is as flat as t⁴, and as
/// many again for its place between the samples and between the steps.
const ROUNDED_TOP: f64 = 8.0;
/// The same in standard errors of the noise. The largest of some samples is itself above the curve by two standard
/// deviations of the noise, so that chance is three of them away.
const NOISY_TOP: f64 = 1.0;

/// Whether the top of a pulse is flat: most samples between the first and the last of the largest are equal to it, and
/// the flanks beside them point above it by more than rounding and noise explain.
fn is_clipped(pulse: &[f64], noise: f64, rounding: f64) -> bool {
    let top = pulse.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let range = top - pulse.iter().copied().fold(f64::INFINITY, f64::min);
    let is_top = |a: &f64| top - a <= 1e-9 * range;
    let (Some(first), Some(last)) = (
        pulse.iter().position(is_top),
        pulse.iter().rposition(is_top),
    ) else {
        return false;
    };
    let (length, equal) = (last + 1 - first, pulse.iter().filter(|a| is_top(a)).count());
    if equal < FLAT_TOP || 2 * equal < length {
        return false;
    }
    let reach = length.div_ceil(2).max(2);
    let middle = 0.5 * (first + last) as f64;
    let is_beside = |i: usize| (i < first && i + reach >= first) || (i > last && i <= last + reach);
    let is_flank = |(i, a): &(usize, &f64)| is_beside(*i) && top - **a < (1.0 - TOP_SHARE) * range;
    let point = |(i, a): (usize, &f64)| ((i as f64 - middle) / length as f64, *a);
    let flanks: Vec<(f64, f64)> = pulse
        .iter()
        .enumerate()
        .filter(is_flank)
        .map(point)
        .collect();
    // A top without flanks is a step.
    let Some(Parabola { value, variance }) = parabola(&flanks) else {
        return true;
    };
    value - top > ROUNDED_TOP * rounding + NOISY_TOP * noise * variance.sqrt()
}

/// The least difference between two values, which shows the rounding of printed ones.
fn least_step(samples: &[f64]) -> f64 {
    let Levels { range, steps, .. } = steps_above(samples, 1e-9);
    steps.into_iter().fold(range, f64::min)
}

/// The values of samples.
#[derive(Default)]
struct Levels {
    /// The lowest.
    low: f64,
    range: f64,
    /// The differences from one to the next.
    steps: Vec<f64>,
}

/// The values of samples, with the steps that are larger than this share of their range.
fn steps_above(samples: &[f64], share: f64) -> Levels {
    let mut sorted = samples.to_vec();
    sorted.sort_by(f64::total_cmp);
    let (Some(&low), Some(high)) = (sorted.first(), sorted.last()) else {
        return Levels::default();
    };
    let range = high - low;
    let steps = sorted.windows(2).map(|pair| pair[1] - pair[0]);
    let steps = steps.filter(|step| *step > share * range);
    let steps = steps.collect();
    Levels { low, range, steps }
}

/// Smallest number of different values that show the steps of a converter.
const MIN_VALUES: usize = 20;
/// Values are on a grid if they are this close to it, in steps: a file rounds them once more.
const ON_GRID: f64 = 0.1;

/// The step of a converter whose multiples all samples are; 0 if they are not on a grid that shows. A noise below the
/// step does not show in a quiet record, and is part of every sample of a pulse.
fn resolution(samples: &[f64]) -> f64 {
    let Levels { low, range, steps } = steps_above(samples, 1e-6);
    let least = steps.iter().copied().fold(f64::INFINITY, f64::min);
    if steps.len() < MIN_VALUES || !least.is_finite() {
        return 0.0;
    }
    let step = range / (range / least).round();
    let is_off = |a: &f64| {
        let place = (a - low) / step;
        (place - place.round()).abs() > ON_GRID
    };
    if samples.iter().any(is_off) {
        0.0
    } else {
        step
    }
}

/// The peak of a pulse between its samples: least squares of a parabola over the samples around the
/// largest one of their moving mean. This averages the noise, which the largest sample does not.
pub(super) fn smooth_peak(values: &[f64]) -> f64 {
    let reach = (values.len() / 9).max(2);
    let largest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if values.len() < 2 * reach + 3 {
        return largest;
    }
    let middle = (reach..values.len() - reach)
        .max_by(|&a, &b| {
            let sum = |i: usize| values[i - reach..=i + reach].iter().sum::<f64>();
            sum(a).total_cmp(&sum(b))
        })
        .unwrap_or(reach);
    let window = &values[middle - reach..=middle + reach];
    let n = reach as f64;
    let x = |i: usize| (i as f64 - n) / n;
    let s = |power: i32| (0..window.len()).map(|i| x(i).powi(power)).sum::<f64>();
    let t = |power: i32| {
        window
            .iter()
            .enumerate()
            .map(|(i, v)| v * x(i).powi(power))
            .sum::<f64>()
    };
    let (s0, s2, s4) = (s(0), s(2), s(4));
    let curvature = (t(2) * s0 - t(0) * s2) / (s4 * s0 - s2 * s2);
    let level = (t(0) - curvature * s2) / s0;
    let slope = t(1) / s2;
    // A pulse that jumps at its beginning does not have a rounded top.
    if curvature >= 0.0 || (0.5 * slope / curvature).abs() > 1.0 {
        return largest;
    }
    level - 0.25 * slope * slope / curvature
}

/// The value of samples at a place between them: least squares of a parabola over `reach` to both sides.
pub(super) fn smooth_at(values: &[f64], place: f64, reach: f64) -> Option<f64> {
    let reach = reach.max(2.0);
    let from = (place - reach).ceil().max(0.0) as usize;
    let window = values.get(from..values.len().min((place + reach).floor() as usize + 1))?;
    let point = |(i, value): (usize, &f64)| (((from + i) as f64 - place) / reach, *value);
    parabola(&window.iter().enumerate().map(point).collect::<Vec<_>>()).map(|found| found.value)
}

/// A parabola at zero.
struct Parabola {
    value: f64,
    /// The variance of the value over that of a point.
    variance: f64,
}

/// The parabola through points, by least squares.
fn parabola(points: &[(f64, f64)]) -> Option<Parabola> {
    let mut normal = vec![vec![0.0; 3]; 3];
    let mut right = vec![0.0; 3];
    for (x, value) in points {
        let powers = [1.0, *x, x * x];
        for (row, a) in powers.iter().enumerate() {
            right[row] += a * value;
            normal[row]
                .iter_mut()
                .zip(&powers)
                .for_each(|(sum, b)| *sum += a * b);
        }
    }
    let variance = solve(normal.clone(), vec![1.0, 0.0, 0.0])?
        .first()
        .copied()?;
    Some(Parabola {
        value: solve(normal, right)?.first().copied()?,
        variance,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand_chacha::ChaCha12Rng;
    use rand_chacha::rand_core::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};

    /// A pulse 1 − |x|^order of so many samples with noise, as steps of a converter; its top may be clipped.
    fn pulse(order: i32, count: usize, noise: f64, step: f64, top: f64, seed: u64) -> Vec<f64> {
        let mut random = ChaCha12Rng::seed_from_u64(seed);
        let phase = 0.618_033_988_749_895 * seed as f64;
        let one = |i: usize| {
            let x = 2.0 * (i as f64 + phase.fract()) / count as f64 - 1.0;
            let normal: f64 = StandardNormal.sample(&mut random);
            ((1.0 - x.abs().powi(order) + noise * normal).min(top) / step).round() * step
        };
        (0..count).map(one).collect()
    }

    const COUNTS: [usize; 3] = [60, 200, 1000];

    /// Whether one of so many pulses is taken for a clipped one. A step of the converter is a noise, too.
    fn clipped(order: i32, count: usize, (noise, step): (f64, f64), top: f64, seeds: u64) -> u64 {
        let is_one = |seed: &u64| {
            is_clipped(
                &pulse(order, count, noise, step, top, *seed),
                noise.max(step / 12f64.sqrt()),
                step,
            )
        };
        (0..seeds).filter(is_one).count() as u64
    }

    /// Pulses with round tops and with tops as flat as those of pads that soften: equal largest values come from rounding
    /// where the noise is below a step of the converter, and from chance where it is some steps.
    #[test]
    fn equal_largest_samples_are_no_clipped_top() {
        for order in [2, 4] {
            for count in COUNTS {
                for noise in [
                    (0.0, 1e-3),
                    (3e-4, 1e-3),
                    (1e-3, 1e-3),
                    (5e-3, 1e-3),
                    (1e-2, 1e-3),
                    (5e-3, 8e-3),
                ] {
                    assert_eq!(
                        clipped(order, count, noise, f64::INFINITY, 200),
                        0,
                        "{order} {count} {noise:?}"
                    );
                }
            }
        }
    }

    /// What was clipped is found where it takes more off the top than the noise of the samples hides.
    #[test]
    fn a_flat_top_is_clipped() {
        for (noise, most) in [
            ((0.0, 1e-3), 0.98),
            ((1e-3, 1e-3), 0.98),
            ((5e-3, 1e-3), 0.95),
            ((1e-2, 1e-3), 0.9),
        ] {
            for (order, count) in [2, 4]
                .into_iter()
                .flat_map(|order| COUNTS.map(|count| (order, count)))
            {
                for top in [most, 0.9, 0.6] {
                    assert_eq!(
                        clipped(order, count, noise, top, 50),
                        50,
                        "{order} {count} {noise:?} {top}"
                    );
                }
            }
        }
    }
}
