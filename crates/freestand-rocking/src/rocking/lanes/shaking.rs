//! The motion of the base in units of g, and when it lifts a block from rest.

use crate::rocking::Base;
use crate::vector::{ABREAST, largest};

/// Samples per maximum on the first level, and first-level maxima per maximum on the second.
const SPAN: usize = 32;

/// ü_h/g and 1 + ü_v/g at every sample.
#[derive(Debug, Clone)]
pub(super) struct Shaking {
    pub(super) dt_s: f64,
    pub(super) u: Vec<f64>,
    /// Empty without a vertical motion; it is then 1 throughout.
    pub(super) v: Vec<f64>,
    /// ü_h/(g+ü_v), which lifts a block about the left edge, and less than 0 about the right one; empty
    /// without a vertical motion: it is then that of `u`.
    lifting: Vec<f64>,
    /// The maxima of its opposite, and its own.
    peaks: [Peaks; 2],
    /// Largest |ü_h|/g + |1 + ü_v/g|.
    pub(super) largest: f64,
    /// Largest change of ü_h/g from one sample to the next, plus that of ü_v/g.
    pub(super) steepest: f64,
}

/// Maxima of values times a sign.
#[derive(Debug, Clone)]
struct Peaks {
    sign: f64,
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
        let lifting: Vec<f64> = u.iter().zip(&v).map(|(u, v)| u / v).collect();
        let lifts = if v.is_empty() { &u } else { &lifting };
        let peaks = [-1.0, 1.0].map(|sign| Peaks::new(lifts, sign));
        let largest = match v.is_empty() {
            true => largest(&u, |u| u.abs() + 1.0),
            false => (0..u.len())
                .map(|k| u[k].abs() + v[k])
                .fold(f64::NEG_INFINITY, f64::max),
        };
        let steepest = steepest(&u) + steepest(&v);
        Some(Self {
            dt_s: given.dt_s(),
            u,
            v,
            lifting,
            peaks,
            largest: largest.max(1.0),
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
        self.peaks[1 - edge].first_above(self.lifts(), threshold, from)
    }

    /// The first sample, from index `from`, that lifts a block at rest with these uplift thresholds
    /// of its right and left edges.
    pub(super) fn first_lift(&self, thresholds: [f64; 2], from: usize) -> Option<usize> {
        let lifts = self.lifts();
        let [right, left] =
            [0, 1].map(|edge| self.peaks[edge].first_above(lifts, thresholds[edge], from));
        [right, left].into_iter().flatten().min()
    }

    fn lifts(&self) -> &[f64] {
        if self.v.is_empty() {
            &self.u
        } else {
            &self.lifting
        }
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

/// The largest change from one value to the next.
fn steepest(values: &[f64]) -> f64 {
    let mut most = [0.0; ABREAST];
    let larger = |most: f64, value: f64| if value > most { value } else { most };
    let later = values.get(1..).unwrap_or_default();
    let (abreast, rest) = later.as_chunks::<ABREAST>();
    for (place, later) in abreast.iter().enumerate() {
        for lane in 0..ABREAST {
            let change = (later[lane] - values[place * ABREAST + lane]).abs();
            most[lane] = larger(most[lane], change);
        }
    }
    let done = later.len() - rest.len();
    let rest = rest.iter().zip(values.iter().skip(done));
    let rest = rest.map(|(later, before)| (later - before).abs());
    most.into_iter().chain(rest).fold(0.0, larger)
}

impl Peaks {
    fn new(values: &[f64], sign: f64) -> Self {
        let spans = values.chunks(SPAN);
        let by_span: Vec<f64> = spans
            .map(|span| largest(span, |value| sign * value))
            .collect();
        let spans = by_span.chunks(SPAN);
        let by_square = spans.map(|span| largest(span, |most| most)).collect();
        Self {
            sign,
            by_span,
            by_square,
        }
    }

    fn first_above(&self, values: &[f64], threshold: f64, from: usize) -> Option<usize> {
        let mut k = from;
        while k < values.len() {
            if k.is_multiple_of(SPAN * SPAN) && self.by_square[k / (SPAN * SPAN)] <= threshold {
                k += SPAN * SPAN;
            } else if k.is_multiple_of(SPAN) && self.by_span[k / SPAN] <= threshold {
                k += SPAN;
            } else if self.sign * values[k] > threshold {
                return Some(k);
            } else {
                k += 1;
            }
        }
        None
    }
}
