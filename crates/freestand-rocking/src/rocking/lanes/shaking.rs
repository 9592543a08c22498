//! The motion of the base in units of g, and when it lifts a block from rest.

use crate::rocking::Base;

/// Samples per maximum on the first level, and first-level maxima per maximum on the second.
const SPAN: usize = 32;

/// ü_h/g and 1 + ü_v/g at every sample.
#[derive(Debug, Clone)]
pub(super) struct Shaking {
    pub(super) dt_s: f64,
    pub(super) u: Vec<f64>,
    /// Empty without a vertical motion; it is then 1 throughout.
    pub(super) v: Vec<f64>,
    /// Values and maxima of −ü_h/(g+ü_v) and of ü_h/(g+ü_v), which lift a block about the right
    /// edge and about the left edge.
    peaks: [Peaks; 2],
    /// Largest |ü_h|/g + |1 + ü_v/g|.
    pub(super) largest: f64,
    /// Largest change of ü_h/g from one sample to the next, plus that of ü_v/g.
    pub(super) steepest: f64,
}

#[derive(Debug, Clone, Default)]
struct Peaks {
    values: Vec<f64>,
    by_span: Vec<f64>,
    by_square: Vec<f64>,
}

impl Shaking {
    /// The samples of the motion; with `and_back` the base comes to rest within one more step.
    ///
    /// `None` without a motion, and where the base falls away (1 + ü_v/g ≤ 0): the scalar solver
    /// then calculates the responses or reports the error.
    pub(super) fn new(base: Base, gravity_m_s2: f64, and_back: bool) -> Option<Self> {
        let given = base.horizontal.or(base.vertical)?;
        let per_g = 1.0 / gravity_m_s2;
        let samples = given.accel_m_s2().len();
        let mut u: Vec<f64> = base.horizontal.map_or_else(
            || vec![0.0; samples],
            |h| h.accel_m_s2().iter().map(|a| a * per_g).collect(),
        );
        let mut v: Vec<f64> = base.vertical.map_or_else(Vec::new, |v| {
            v.accel_m_s2().iter().map(|a| 1.0 + a * per_g).collect()
        });
        if and_back {
            u.push(0.0);
            if !v.is_empty() {
                v.push(1.0);
            }
        }
        if v.iter().any(|v| *v <= 0.0) {
            return None;
        }
        let lifting: Vec<f64> = if v.is_empty() {
            u.clone()
        } else {
            u.iter().zip(&v).map(|(u, v)| u / v).collect()
        };
        let peaks = [
            Peaks::new(lifting.iter().map(|a| -a).collect()),
            Peaks::new(lifting),
        ];
        let largest = (0..u.len())
            .map(|k| u[k].abs() + v.get(k).copied().unwrap_or(1.0))
            .fold(1.0, f64::max);
        let change = |values: &[f64]| {
            values
                .windows(2)
                .map(|w| (w[1] - w[0]).abs())
                .fold(0.0, f64::max)
        };
        let steepest = change(&u) + change(&v);
        Some(Self {
            dt_s: given.dt_s(),
            u,
            v,
            peaks,
            largest,
            steepest,
        })
    }

    /// Base acceleration at the start of interval `k` and its change over it.
    #[inline(always)]
    pub(super) fn interval(&self, k: usize) -> Interval {
        let (u, v) = (self.u[k], self.v.get(k).copied().unwrap_or(1.0));
        Interval {
            u,
            u_change: self.u[k + 1] - u,
            v,
            v_change: self.v.get(k + 1).copied().unwrap_or(1.0) - v,
        }
    }

    /// Number of intervals between samples.
    pub(super) fn intervals(&self) -> usize {
        self.u.len() - 1
    }

    /// The first sample, from index `from`, at which s ü_h/(g+ü_v) about an edge passes a threshold:
    /// it lets a block go that leans on the wall beyond that edge.
    pub(super) fn first_release(&self, edge: usize, threshold: f64, from: usize) -> Option<usize> {
        self.peaks[1 - edge].first_above(threshold, from)
    }

    /// The first sample, from index `from`, that lifts a block at rest with these uplift thresholds
    /// of its right and left edges.
    pub(super) fn first_lift(&self, thresholds: [f64; 2], from: usize) -> Option<usize> {
        let [right, left] = [0, 1].map(|edge| self.peaks[edge].first_above(thresholds[edge], from));
        [right, left].into_iter().flatten().min()
    }
}

/// Base acceleration along a straight line, in units of g.
#[derive(Debug, Clone, Copy)]
pub(super) struct Interval {
    pub(super) u: f64,
    pub(super) u_change: f64,
    pub(super) v: f64,
    pub(super) v_change: f64,
}

impl Interval {
    /// ü_h/g and 1 + ü_v/g at a ratio of the interval.
    #[inline(always)]
    pub(super) fn at(&self, ratio: f64) -> (f64, f64) {
        (
            self.u + ratio * self.u_change,
            self.v + ratio * self.v_change,
        )
    }
}

impl Peaks {
    fn new(values: Vec<f64>) -> Self {
        let largest = |values: &[f64]| values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let by_span: Vec<f64> = values.chunks(SPAN).map(largest).collect();
        let by_square = by_span.chunks(SPAN).map(largest).collect();
        Self {
            values,
            by_span,
            by_square,
        }
    }

    fn first_above(&self, threshold: f64, from: usize) -> Option<usize> {
        let mut k = from;
        while k < self.values.len() {
            if k.is_multiple_of(SPAN * SPAN) && self.by_square[k / (SPAN * SPAN)] <= threshold {
                k += SPAN * SPAN;
            } else if k.is_multiple_of(SPAN) && self.by_span[k / SPAN] <= threshold {
                k += SPAN;
            } else if self.values[k] > threshold {
                return Some(k);
            } else {
                k += 1;
            }
        }
        None
    }
}
