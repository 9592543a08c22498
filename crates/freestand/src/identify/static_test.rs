//! A static test: load cell and displacement transducer.

use thiserror::Error;

/// How a static test is evaluated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StaticOptions {
    /// Working load \[N\]; `None`: half of the largest force.
    pub load_n: Option<f64>,
    /// Stiffness of the machine, whose give is in the displacement \[N/m\].
    pub machine_stiffness_n_m: Option<f64>,
    /// Whether the foot of the curve (seating, slack) is cut off along the tangent at the working load. Not for a sphere,
    /// whose curve has a foot of its own.
    pub compensates_toe: bool,
}

/// A static test, evaluated.
#[derive(Debug, Clone, PartialEq)]
pub struct StaticTest {
    /// Working load \[N\].
    pub load_n: f64,
    /// Largest force \[N\].
    pub max_force_n: f64,
    /// Largest compression, after toe and machine \[m\].
    pub max_compression_m: f64,
    /// dF/dd at the working load, on the way in \[N/m\].
    pub tangent_stiffness_n_m: f64,
    /// F/d at the working load \[N/m\].
    pub secant_stiffness_n_m: f64,
    /// Energy lost in the cycle over the energy of the way in; `None` without a way out.
    pub hysteresis_ratio: Option<f64>,
    /// Displacement at which the straight part of the curve begins \[m\].
    pub toe_m: f64,
    /// Slope of ln F against ln d from a tenth of the load up to it: the exponent of a power law.
    pub exponent: Option<f64>,
    /// Compression \[m\] and force \[N\], after toe and machine; the way in, then the way out.
    pub curve: Vec<(f64, f64)>,
    /// Number of points of the way in.
    pub loading_count: usize,
}

/// Why numbers are no static test.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum StaticError {
    /// Too few points.
    #[error("{points} points up to the largest force are no static test: at least 10")]
    TooFew {
        /// How many there are.
        points: usize,
    },
    /// A point is no number.
    #[error("point {number} is not a number")]
    NotFinite {
        /// The point, from 1.
        number: usize,
    },
    /// Pulled, or nothing.
    #[error("the largest force is {value} N: compression must be positive")]
    NoForce {
        /// The largest force.
        value: f64,
    },
    /// The working load was not reached.
    #[error("the working load of {load_n} N is not below the largest force, {max_force_n} N")]
    Load {
        /// The working load.
        load_n: f64,
        /// The largest force.
        max_force_n: f64,
    },
    /// The force does not rise with the displacement.
    #[error("the force does not rise with the displacement near {load_n} N")]
    NotRising {
        /// The working load.
        load_n: f64,
    },
    /// The machine is softer than what was measured.
    #[error("the machine at {machine_n_m} N/m gives more than the displacement that was measured")]
    Machine {
        /// Its stiffness.
        machine_n_m: f64,
    },
}

/// Least points of the way in.
const LEAST_POINTS: usize = 10;
/// The tangent is a line through the points within this share of the load below and above it.
const TANGENT_SHARE: f64 = 0.25;

/// Evaluates forces \[N\] over displacements \[m\], both positive in compression, in the order of the test.
///
/// The machine's give F/k_m is taken from the displacement, then the toe; tangent and secant are those of the way in at
/// the working load; the hysteresis is that of the loop, ∮F dd over ∫F dd of the way in.
///
/// # Reference
/// Toe compensation after ASTM D695 annex A1.
///
/// # Errors
/// Too few points, no rising force, a load that was not reached, a machine that is too soft.
///
/// # Example
/// A straight line of 1000 N/mm in a machine of 4000 N/mm that shows 800 N/mm:
/// ```
/// use freestand::identify::{StaticOptions, static_test};
/// let force: Vec<f64> = (0..=50).map(|i| f64::from(i) * 10.0).collect();
/// let displacement: Vec<f64> = force.iter().map(|f| f / 0.8e6).collect();
/// let options = StaticOptions { load_n: None, machine_stiffness_n_m: Some(4e6), compensates_toe: true };
/// let test = static_test(&force, &displacement, &options)?;
/// assert!((test.tangent_stiffness_n_m / 1e6 - 1.0).abs() < 1e-9);
/// # Ok::<(), freestand::identify::StaticError>(())
/// ```
pub fn static_test(
    force_n: &[f64],
    displacement_m: &[f64],
    options: &StaticOptions,
) -> Result<StaticTest, StaticError> {
    let bad = force_n.iter().zip(displacement_m).position(|(f, d)| !f.is_finite() || !d.is_finite());
    if let Some(index) = bad {
        return Err(StaticError::NotFinite { number: index + 1 });
    }
    let top = (0..force_n.len().min(displacement_m.len())).max_by(|&a, &b| force_n[a].total_cmp(&force_n[b]));
    let Some(top) = top.filter(|&top| top + 1 >= LEAST_POINTS) else {
        return Err(StaticError::TooFew { points: top.map_or(0, |top| top + 1) });
    };
    let max_force_n = force_n[top];
    if max_force_n <= 0.0 {
        return Err(StaticError::NoForce { value: max_force_n });
    }
    let load_n = options.load_n.unwrap_or(0.5 * max_force_n);
    if !(load_n > 0.0 && load_n < max_force_n) {
        return Err(StaticError::Load { load_n, max_force_n });
    }
    let give = |f: f64| options.machine_stiffness_n_m.map_or(0.0, |k| f / k);
    let mut curve: Vec<(f64, f64)> = force_n.iter().zip(displacement_m).map(|(&f, &d)| (d - give(f), f)).collect();
    let (start, _) = curve[0];
    curve.iter_mut().for_each(|point| point.0 -= start);
    let loading = &curve[..=top];
    if loading[top].0 <= 0.0 {
        let machine_n_m = options.machine_stiffness_n_m.unwrap_or(f64::INFINITY);
        return Err(StaticError::Machine { machine_n_m });
    }
    let near = |share: f64| -> Vec<(f64, f64)> {
        loading.iter().copied().filter(|(_, f)| (f / load_n - 1.0).abs() <= share).collect()
    };
    // A coarse table may have too few points near the load.
    let mut share = TANGENT_SHARE;
    while near(share).len() < 5 && share < 1.0 {
        share += 0.1;
    }
    let (at_m, tangent) = line(&near(share), load_n).ok_or(StaticError::NotRising { load_n })?;
    let toe_m = if options.compensates_toe { at_m - load_n / tangent } else { 0.0 };
    let secant = load_n / (at_m - toe_m);
    if !(tangent > 0.0 && secant > 0.0 && secant.is_finite()) {
        return Err(StaticError::NotRising { load_n });
    }
    let area = |points: &[(f64, f64)]| -> f64 {
        points.windows(2).map(|pair| 0.5 * (pair[0].1 + pair[1].1) * (pair[1].0 - pair[0].0)).sum()
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
        exponent,
        loading_count: top + 1,
        curve,
    })
}

/// Least squares of a line: displacement at `load_n`, and dF/dd.
fn line(points: &[(f64, f64)], load_n: f64) -> Option<(f64, f64)> {
    let count = points.len() as f64;
    if points.len() < 3 {
        return None;
    }
    let (md, mf) = (points.iter().map(|p| p.0).sum::<f64>() / count, points.iter().map(|p| p.1).sum::<f64>() / count);
    let df: f64 = points.iter().map(|p| (p.0 - md) * (p.1 - mf)).sum();
    let dd: f64 = points.iter().map(|p| (p.0 - md).powi(2)).sum();
    let slope = df / dd;
    (slope > 0.0 && slope.is_finite()).then(|| (md + (load_n - mf) / slope, slope))
}

fn exponent(loading: &[(f64, f64)], toe_m: f64, load_n: f64) -> Option<f64> {
    let points: Vec<(f64, f64)> = loading
        .iter()
        .filter(|(d, f)| *f >= 0.1 * load_n && *f <= load_n && d - toe_m > 0.0)
        .map(|(d, f)| ((d - toe_m).ln(), f.ln()))
        .collect();
    line(&points, 0.0).map(|(_, slope)| slope)
}
