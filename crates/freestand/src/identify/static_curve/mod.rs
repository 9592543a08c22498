//! The force–displacement curve of a static test with load cell and displacement transducer.

use thiserror::Error;

use crate::search::golden_maximum_at;

/// How a static test is evaluated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StaticOptions {
    /// Working load \[N\]; `None`: half the largest force.
    pub load_n: Option<f64>,
    /// Stiffness of the machine, whose deformation is part of the displacement \[N/m\].
    pub machine_stiffness_n_m: Option<f64>,
    /// What of the toe of the curve is removed.
    pub toe: Toe,
}

/// What is removed from the beginning of a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Toe {
    /// The slack before the pad is touched: d₀ of F = K (d − d₀)ⁿ through the points up to the working load. A pad that
    /// hardens keeps its slow beginning.
    #[default]
    Slack,
    /// Everything before the tangent at the working load meets zero force, for a plate that seats itself on a pad that
    /// is linear: secant and tangent are then the same.
    Tangent,
    /// Nothing.
    Keep,
}

/// The results of a static test.
#[derive(Debug, Clone, PartialEq)]
pub struct StaticTest {
    /// Working load \[N\].
    pub load_n: f64,
    /// Largest force of the cycle \[N\].
    pub max_force_n: f64,
    /// Largest compression, corrected for toe and machine \[m\].
    pub max_compression_m: f64,
    /// Tangent stiffness dF/dd at the working load, during loading \[N/m\].
    pub tangent_stiffness_n_m: f64,
    /// Secant stiffness F/d at the working load \[N/m\].
    pub secant_stiffness_n_m: f64,
    /// Energy lost in the cycle divided by the energy of loading; `None` without unloading.
    pub hysteresis_ratio: Option<f64>,
    /// What was removed from the beginning of the curve; negative where the tangent meets zero force
    /// before the start: a preload, or a pad that softens \[m\].
    pub toe_m: f64,
    /// Standard error of the toe of a tangent, from its residuals; otherwise 0 \[m\].
    pub toe_error_m: f64,
    /// Number of cycles before and after the evaluated one.
    pub other_cycles: usize,
    /// Slope of ln F against ln d from a tenth of the load to the load: the exponent of a power
    /// law.
    pub exponent: Option<f64>,
    /// Compression \[m\] and force \[N\], corrected for toe and machine; loading, then unloading,
    /// of one cycle.
    pub curve: Vec<(f64, f64)>,
    /// Number of points during loading.
    pub loading_count: usize,
}

/// Why a record cannot be evaluated as a static test.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum StaticError {
    /// Too few points.
    #[error("a static test needs at least 10 points up to the largest force, not {points}")]
    TooFew {
        /// Number of points.
        points: usize,
    },
    /// A point that is not a number.
    #[error("point {number} is not a number")]
    NotFinite {
        /// The point, counted from 1.
        number: usize,
    },
    /// Tension, or no force at all.
    #[error("the largest force is {value} N, so the test shows no compression")]
    NoForce {
        /// The largest force \[N\].
        value: f64,
    },
    /// The working load was not reached.
    #[error("the working load of {load_n} N is not below the largest force, {max_force_n} N")]
    Load {
        /// The working load \[N\].
        load_n: f64,
        /// The largest force \[N\].
        max_force_n: f64,
    },
    /// The force does not rise with the displacement.
    #[error("the force does not rise with the displacement near {load_n} N")]
    NotRising {
        /// The working load \[N\].
        load_n: f64,
    },
    /// The cycle does not begin below the working load.
    #[error(
        "loading up to the largest force begins at {foot_n} N, which is not below the working load of {load_n} N"
    )]
    Foot {
        /// The force at which it begins \[N\].
        foot_n: f64,
        /// The working load \[N\].
        load_n: f64,
    },
    /// The machine deforms by more than the measured displacement.
    #[error("a machine of {machine_n_m} N/m would deform by more than the measured displacement")]
    Machine {
        /// Its stiffness \[N/m\].
        machine_n_m: f64,
    },
}

/// Smallest number of points during loading.
const MIN_POINTS: usize = 10;
/// The tangent is a line through the points within this share of the load below and above it.
const TANGENT_SHARE: f64 = 0.25;
/// The force turns where it falls back by more than this share of its largest value; less than that
/// is noise or a slip.
const TURN_SHARE: f64 = 0.1;
/// A cycle is full if it reaches this share of the largest force.
const FULL_SHARE: f64 = 0.95;
/// Points within this share of the smallest force of a pause belong to the pause.
const PAUSE_SHARE: f64 = 0.05;

/// Evaluates forces \[N\] over displacements \[m\], both positive in compression, in the order of
/// the test.
///
/// Of several cycles, the last one that reaches 95 % of the largest force is evaluated: from the
/// turn of the force before it to the turn after it. The machine's deformation F/k_m is subtracted
/// from the displacement, then the toe, see [`Toe`]. Tangent and secant are those of loading, at the working
/// load; the hysteresis is that of the loop, ∮F dd divided by ∫F dd of loading.
///
/// # Reference
/// [`Toe::Tangent`] is the toe compensation of ASTM D695 annex A1.
///
/// # Errors
/// Too few points, no rising force, a load that was not reached or below which the cycle does not
/// begin, or a machine that is too soft.
///
/// # Example
/// A straight line of 1000 N/mm in a machine of 4000 N/mm that shows 800 N/mm:
/// ```
/// use freestand::identify::{StaticOptions, Toe, static_test};
/// let force: Vec<f64> = (0..=50).map(|i| f64::from(i) * 10.0).collect();
/// let displacement: Vec<f64> = force.iter().map(|f| f / 0.8e6).collect();
/// let machine_stiffness_n_m = Some(4e6);
/// let options = StaticOptions { load_n: None, machine_stiffness_n_m, toe: Toe::Slack };
/// let test = static_test(&force, &displacement, &options)?;
/// assert!((test.tangent_stiffness_n_m / 1e6 - 1.0).abs() < 1e-9);
/// # Ok::<(), freestand::identify::StaticError>(())
/// ```
pub fn static_test(
    force_n: &[f64],
    displacement_m: &[f64],
    options: &StaticOptions,
) -> Result<StaticTest, StaticError> {
    let bad = force_n
        .iter()
        .zip(displacement_m)
        .position(|(f, d)| !f.is_finite() || !d.is_finite());
    if let Some(index) = bad {
        return Err(StaticError::NotFinite { number: index + 1 });
    }
    let count = force_n.len().min(displacement_m.len());
    let (force_n, displacement_m) = (&force_n[..count], &displacement_m[..count]);
    let cycle = Cycle::last_full(force_n, displacement_m);
    let Some(cycle) = cycle.filter(|cycle| cycle.top + 1 >= cycle.foot + MIN_POINTS) else {
        return Err(StaticError::TooFew {
            points: cycle.map_or(0, |cycle| cycle.top + 1 - cycle.foot),
        });
    };
    let (force_n, displacement_m) = (
        &force_n[cycle.foot..=cycle.end],
        &displacement_m[cycle.foot..=cycle.end],
    );
    let top = cycle.top - cycle.foot;
    let max_force_n = force_n[top];
    if max_force_n <= 0.0 {
        // Without a negative zero.
        return Err(StaticError::NoForce {
            value: max_force_n + 0.0,
        });
    }
    let load_n = options.load_n.unwrap_or(0.5 * max_force_n);
    if !(load_n > 0.0 && load_n < max_force_n) {
        return Err(StaticError::Load {
            load_n,
            max_force_n,
        });
    }
    let foot_n = force_n[0];
    if cycle.others > 0 && foot_n > (1.0 - TANGENT_SHARE) * load_n {
        return Err(StaticError::Foot { foot_n, load_n });
    }
    let give = |f: f64| options.machine_stiffness_n_m.map_or(0.0, |k| f / k);
    let mut curve: Vec<(f64, f64)> = force_n
        .iter()
        .zip(displacement_m)
        .map(|(&f, &d)| (d - give(f), f))
        .collect();
    let (start, _) = curve[0];
    curve.iter_mut().for_each(|point| point.0 -= start);
    let loading = &curve[..=top];
    if loading[top].0 <= 0.0 {
        return Err(match options.machine_stiffness_n_m {
            Some(machine_n_m) => StaticError::Machine { machine_n_m },
            None => StaticError::NotRising { load_n },
        });
    }
    let near = |share: f64| -> Vec<(f64, f64)> {
        loading
            .iter()
            .copied()
            .filter(|(_, f)| (f / load_n - 1.0).abs() <= share)
            .collect()
    };
    // A coarse table may have too few points near the load.
    let mut share = TANGENT_SHARE;
    while near(share).len() < 5 && share < 1.0 {
        share += 0.1;
    }
    let first = line(&near(share)).ok_or(StaticError::NotRising { load_n })?;
    // Points selected by a noisy force lie on a line that is too flat, so the same section is
    // selected again by displacement.
    let (centre_m, reach_m) = (first.at(load_n), share * load_n / first.slope);
    let stretch: Vec<(f64, f64)> = loading
        .iter()
        .copied()
        .filter(|(d, _)| (d - centre_m).abs() <= reach_m)
        .collect();
    let again = line(&stretch).filter(|line| stretch.len() >= 5 && line.slope > 0.0);
    let tangent_line = again.unwrap_or(first);
    let (at_m, tangent) = (tangent_line.at(load_n), tangent_line.slope);
    let toe_m = match options.toe {
        Toe::Slack => slack_m(loading, load_n),
        Toe::Tangent => tangent_line.at(0.0),
        Toe::Keep => 0.0,
    };
    let secant = load_n / (at_m - toe_m);
    if !(tangent > 0.0 && secant > 0.0 && secant.is_finite()) {
        return Err(StaticError::NotRising { load_n });
    }
    let area = |points: &[(f64, f64)]| -> f64 {
        points
            .windows(2)
            .map(|pair| 0.5 * (pair[0].1 + pair[1].1) * (pair[1].0 - pair[0].0))
            .sum()
    };
    let is_back = curve.last().is_some_and(|last| last.1 < 0.2 * max_force_n);
    let hysteresis_ratio = is_back.then(|| (area(loading) + area(&curve[top..])) / area(loading));
    let exponent = exponent(loading, toe_m, load_n);
    curve.iter_mut().for_each(|point| point.0 -= toe_m);
    Ok(StaticTest {
        load_n,
        max_force_n,
        max_compression_m: curve[top].0,
        tangent_stiffness_n_m: tangent,
        secant_stiffness_n_m: secant,
        hysteresis_ratio,
        toe_m,
        toe_error_m: if options.toe == Toe::Tangent {
            tangent_line.error_at(0.0)
        } else {
            0.0
        },
        other_cycles: cycle.others,
        exponent,
        loading_count: top + 1,
        curve,
    })
}

/// One cycle within a test, as indices of points.
#[derive(Debug, Clone, Copy)]
struct Cycle {
    foot: usize,
    top: usize,
    end: usize,
    /// Number of the other cycles.
    others: usize,
}

impl Cycle {
    /// The last cycle that reaches [`FULL_SHARE`] of the largest force; `None` without points.
    fn last_full(force_n: &[f64], displacement_m: &[f64]) -> Option<Self> {
        let max_n = force_n.iter().copied().max_by(f64::total_cmp)?;
        let peaks = peaks(force_n, TURN_SHARE * max_n.abs());
        let number = peaks
            .iter()
            .rposition(|&peak| force_n[peak] >= FULL_SHARE * max_n)?;
        let pause =
            |from: usize, to: usize| pause(&force_n[from..=to], &displacement_m[from..=to], max_n);
        let before = number.checked_sub(1).map(|i| peaks[i]);
        let after = peaks.get(number + 1).copied();
        let top = peaks[number];
        Some(Self {
            foot: before.map_or(0, |before| before + pause(before, top)),
            top,
            end: after.map_or(force_n.len() - 1, |after| top + pause(top, after)),
            others: peaks.len() - 1,
        })
    }
}

/// The local maxima between which the force falls by more than `turn_n` and rises again.
fn peaks(force_n: &[f64], turn_n: f64) -> Vec<usize> {
    let mut peaks = Vec::new();
    let (mut highest, mut lowest, mut is_rising) = (0, 0, true);
    for (i, &force) in force_n.iter().enumerate() {
        if is_rising {
            if force > force_n[highest] {
                highest = i;
            } else if force < force_n[highest] - turn_n {
                peaks.push(highest);
                (lowest, is_rising) = (i, false);
            }
        } else if force < force_n[lowest] {
            lowest = i;
        } else if force > force_n[lowest] + turn_n {
            (highest, is_rising) = (i, true);
        }
    }
    if is_rising && !force_n.is_empty() {
        peaks.push(highest);
    }
    peaks
}

/// The point at which the press turns between two cycles: the last of the points of smallest
/// displacement among those of smallest force.
fn pause(force_n: &[f64], displacement_m: &[f64], max_n: f64) -> usize {
    let min_n = force_n.iter().copied().fold(f64::INFINITY, f64::min) + PAUSE_SHARE * max_n.abs();
    let mut turn: Option<usize> = None;
    for i in (0..force_n.len()).filter(|&i| force_n[i] <= min_n) {
        if turn.is_none_or(|turn| displacement_m[i] <= displacement_m[turn]) {
            turn = Some(i);
        }
    }
    turn.unwrap_or(0)
}

/// A line through points, by least squares in the second number.
struct Line {
    middle: (f64, f64),
    slope: f64,
    count: f64,
    /// Sum of the squares of the first number about its mean, and of the residuals of the second.
    spread: f64,
    left: f64,
}

impl Line {
    /// The first number where the second is `value`.
    fn at(&self, value: f64) -> f64 {
        self.middle.0 + (value - self.middle.1) / self.slope
    }

    /// Standard error of [`Line::at`].
    fn error_at(&self, value: f64) -> f64 {
        let variance = self.left / (self.count - 2.0).max(1.0);
        let lever = (self.at(value) - self.middle.0).powi(2) / self.spread;
        (variance * (self.count.recip() + lever)).sqrt() / self.slope
    }
}

fn line(points: &[(f64, f64)]) -> Option<Line> {
    let count = points.len() as f64;
    if points.len() < 3 {
        return None;
    }
    let (mx, my) = (
        points.iter().map(|p| p.0).sum::<f64>() / count,
        points.iter().map(|p| p.1).sum::<f64>() / count,
    );
    let xy: f64 = points.iter().map(|p| (p.0 - mx) * (p.1 - my)).sum();
    let spread: f64 = points.iter().map(|p| (p.0 - mx).powi(2)).sum();
    let slope = xy / spread;
    let left = points
        .iter()
        .map(|p| (p.1 - my - slope * (p.0 - mx)).powi(2))
        .sum();
    (slope > 0.0 && slope.is_finite()).then_some(Line {
        middle: (mx, my),
        slope,
        count,
        spread,
        left,
    })
}

/// Exponents of pads, between which that of a curve with slack is searched.
const EXPONENTS: (f64, f64) = (0.3, 5.0);
/// The slack ends before the force has risen to this share of the working load.
const SLACK_SHARE: f64 = 0.1;
/// A slack below this share of the compression is noise, or the shape of a curve that is no power law.
const NO_SLACK: f64 = 0.02;
/// Points through which the curve with slack is fitted; more of them cost time and no accuracy that counts.
const SLACK_POINTS: usize = 400;

/// d₀ of F = K (d − d₀)ⁿ, by least squares through the points of loading up to the load, if the slack shows: the force
/// stays near zero up to it.
fn slack_m(loading: &[(f64, f64)], load_n: f64) -> f64 {
    let end = loading
        .iter()
        .position(|(_, f)| *f > (1.0 + TANGENT_SHARE) * load_n)
        .unwrap_or(loading.len());
    let step = end.div_ceil(SLACK_POINTS).max(1);
    let points: Vec<(f64, f64)> = loading[..end].iter().copied().step_by(step).collect();
    let Some(most_m) = points
        .iter()
        .find(|(_, f)| *f > SLACK_SHARE * load_n)
        .map(|(d, _)| *d)
    else {
        return 0.0;
    };
    let misfit = |slack_m: f64, n: f64| -> f64 {
        let (mut ff, mut fm, mut mm) = (0.0, 0.0, 0.0);
        for (d, f) in &points {
            let m = (d - slack_m).max(0.0).powf(n);
            (ff, fm, mm) = (ff + f * f, fm + f * m, mm + m * m);
        }
        if mm > 0.0 { ff - fm * fm / mm } else { ff }
    };
    let best = |slack_m: f64| {
        let n = golden_maximum_at(|n| -misfit(slack_m, n), EXPONENTS.0, EXPONENTS.1);
        misfit(slack_m, n)
    };
    let found_m = golden_maximum_at(|slack_m| -best(slack_m), 0.0, most_m);
    let deep_m = points.last().map_or(0.0, |(d, _)| *d);
    if found_m > NO_SLACK * deep_m && best(found_m) < 0.9 * best(0.0) {
        found_m
    } else {
        0.0
    }
}

fn exponent(loading: &[(f64, f64)], toe_m: f64, load_n: f64) -> Option<f64> {
    let points: Vec<(f64, f64)> = loading
        .iter()
        .filter(|(d, f)| *f >= 0.1 * load_n && *f <= load_n && d - toe_m > 0.0)
        .map(|(d, f)| ((d - toe_m).ln(), f.ln()))
        .collect();
    line(&points).map(|line| line.slope)
}

#[cfg(test)]
mod tests;
