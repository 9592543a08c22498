//! The motion of the base in units of g, and when it lifts a block from rest.

use crate::rocking::Base;
use crate::vector::{ABREAST, largest};

/// Samples per maximum on the first level, and first-level maxima per maximum on the second.
const SPAN: usize = 32;

/// ü_h/g and 1 + ü_v/g at every sample.
#[derive(Debug, Clone)]
pub(super) struct Shaking<'a> {
    pub(super) dt_s: f64,
    /// Empty without a horizontal motion. In m/s²: most blocks at rest never need it in g.
    horizontal_m_s2: &'a [f64],
    per_g: f64,
    /// Of the motion; with the base at rest after it, one more.
    samples: usize,
    /// Empty without a vertical motion; it is then 1 throughout.
    pub(super) v: Vec<f64>,
    /// ü_h/(g+ü_v), which lifts a block about the left edge, and less than 0 about the right one; empty
    /// without a vertical motion: it is then ü_h/g.
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
    by_span: Vec<f64>,
    by_square: Vec<f64>,
}

impl<'a> Shaking<'a> {
    /// The samples of the motion; with `and_back` the base comes to rest within one more step.
    ///
    /// `None` without a motion, and where the base falls away (1 + ü_v/g ≤ 0): the scalar solver
    /// then calculates the responses or reports the error.
    pub(super) fn new(base: Base<'a>, gravity_m_s2: f64, and_back: bool) -> Option<Self> {
        let given = base.horizontal.or(base.vertical)?;
        let horizontal_m_s2 = base.horizontal.map_or(&[][..], |h| h.accel_m_s2());
        let per_g = 1.0 / gravity_m_s2;
        let mut v: Vec<f64> = base.vertical.map_or_else(Vec::new, |v| {
            v.accel_m_s2().iter().map(|a| 1.0 + a * per_g).collect()
        });
        if and_back && !v.is_empty() {
            v.push(1.0);
        }
        if v.iter().any(|v| *v <= 0.0) {
            return None;
        }
        let (peaks, steepest_u) = surveyed(horizontal_m_s2, per_g, and_back);
        let steepest = steepest_u + surveyed(&v, 1.0, false).1;
        let mut shaking = Self {
            dt_s: given.dt_s(),
            horizontal_m_s2,
            per_g,
            samples: given.accel_m_s2().len() + usize::from(and_back),
            v,
            lifting: Vec::new(),
            peaks,
            largest: 1.0,
            steepest,
        };
        if shaking.v.is_empty() {
            let peaks = shaking.peaks.iter().flat_map(|peaks| &peaks.by_square);
            shaking.largest += peaks.fold(0.0, |largest: f64, peak| largest.max(*peak));
        } else {
            let both = || (0..shaking.samples).map(|k| (shaking.u(k), shaking.v[k]));
            let largest = both().fold(1.0, |largest: f64, (u, v)| largest.max(u.abs() + v));
            let lifting: Vec<f64> = both().map(|(u, v)| u / v).collect();
            (shaking.peaks, _) = surveyed(&lifting, 1.0, false);
            (shaking.largest, shaking.lifting) = (largest, lifting);
        }
        Some(shaking)
    }

    /// ü_h/g at a sample.
    #[inline(always)]
    fn u(&self, k: usize) -> f64 {
        self.horizontal_m_s2.get(k).map_or(0.0, |a| a * self.per_g)
    }

    /// Base acceleration at the start of interval `k` and its change over it.
    #[inline(always)]
    pub(super) fn interval(&self, k: usize) -> Interval {
        let (u, v) = (self.u(k), self.v.get(k).copied().unwrap_or(1.0));
        Interval {
            u,
            u_change: self.u(k + 1) - u,
            v,
            v_change: self.v.get(k + 1).copied().unwrap_or(1.0) - v,
        }
    }

    /// Number of intervals between samples.
    pub(super) fn intervals(&self) -> usize {
        self.samples - 1
    }

    /// The first sample, from index `from`, at which s ü_h/(g+ü_v) about an edge passes a threshold:
    /// it lets a block go that leans on the wall beyond that edge.
    pub(super) fn first_release(&self, edge: usize, threshold: f64, from: usize) -> Option<usize> {
        self.first_above(1 - edge, threshold, from)
    }

    /// The first sample, from index `from`, that lifts a block at rest with these uplift thresholds
    /// of its right and left edges.
    pub(super) fn first_lift(&self, thresholds: [f64; 2], from: usize) -> Option<usize> {
        let [right, left] = [0, 1].map(|edge| self.first_above(edge, thresholds[edge], from));
        [right, left].into_iter().flatten().min()
    }

    /// The first sample, from index `from`, at which what lifts a block, or its opposite about the right edge, is above
    /// a threshold.
    fn first_above(&self, edge: usize, threshold: f64, from: usize) -> Option<usize> {
        let value = |k: usize| match (self.lifting.get(k), edge) {
            (Some(lifting), 0) => -lifting,
            (Some(lifting), _) => *lifting,
            (None, 0) => -self.u(k),
            (None, _) => self.u(k),
        };
        self.peaks[edge].first_above(value, self.samples, threshold, from)
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

/// The maxima of values times a factor, with the opposite sign and with their own, and the largest change from one to the
/// next; with `and_back` of 0 after them.
fn surveyed(values: &[f64], factor: f64, and_back: bool) -> ([Peaks; 2], f64) {
    pulp::Arch::new().dispatch(Survey {
        values,
        factor,
        and_back,
    })
}

/// What [`surveyed`] does, to be compiled for each vector unit; nothing is fused, so it changes no bit.
struct Survey<'a> {
    values: &'a [f64],
    factor: f64,
    and_back: bool,
}

impl pulp::WithSimd for Survey<'_> {
    type Output = ([Peaks; 2], f64);

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) -> Self::Output {
        let Self {
            values,
            factor,
            and_back,
        } = self;
        let peaks = [-factor, factor].map(|factor| Peaks::new(values, factor, and_back));
        let change = match values.last() {
            Some(last) if and_back => (last * factor).abs(),
            _ => 0.0,
        };
        (peaks, steepest(values, factor).max(change))
    }
}

/// The largest change from one value to the next, of values times a factor.
#[inline(always)]
fn steepest(values: &[f64], factor: f64) -> f64 {
    let change = |before: f64, later: f64| (later * factor - before * factor).abs();
    let larger = |most: f64, value: f64| if value > most { value } else { most };
    let later = values.get(1..).unwrap_or_default();
    let (abreast, rest) = later.as_chunks::<ABREAST>();
    let (before, before_rest) = values.as_chunks::<ABREAST>();
    let mut most = [0.0; ABREAST];
    for (before, later) in before.iter().zip(abreast) {
        let mut changes = [0.0; ABREAST];
        for lane in 0..ABREAST {
            changes[lane] = change(before[lane], later[lane]);
        }
        for lane in 0..ABREAST {
            most[lane] = larger(most[lane], changes[lane]);
        }
    }
    let before_rest = match before.get(abreast.len()) {
        Some(before) => before,
        None => before_rest,
    };
    let rest = before_rest.iter().zip(rest);
    let rest = rest.map(|(before, later)| change(*before, *later));
    rest.chain(most).fold(0.0, larger)
}

impl Peaks {
    /// Of values times a factor; with `and_back` of 0 after them.
    #[inline(always)]
    fn new(values: &[f64], factor: f64, and_back: bool) -> Self {
        let mut by_span = Vec::with_capacity(values.len() / SPAN + 1);
        for span in values.chunks(SPAN) {
            by_span.push(largest(span, |value| factor * value));
        }
        if and_back {
            by_span.resize((values.len() + 1).div_ceil(SPAN), 0.0);
            if let Some(last) = by_span.last_mut() {
                *last = last.max(0.0);
            }
        }
        let spans = by_span.chunks(SPAN);
        let by_square = spans.map(|span| largest(span, |most| most)).collect();
        Self { by_span, by_square }
    }

    /// The first of `samples` samples, from index `from`, whose `value` is above the threshold.
    fn first_above(
        &self,
        value: impl Fn(usize) -> f64,
        samples: usize,
        threshold: f64,
        from: usize,
    ) -> Option<usize> {
        let mut k = from;
        while k < samples {
            if k.is_multiple_of(SPAN * SPAN) && self.by_square[k / (SPAN * SPAN)] <= threshold {
                k += SPAN * SPAN;
            } else if k.is_multiple_of(SPAN) && self.by_span[k / SPAN] <= threshold {
                k += SPAN;
            } else if value(k) > threshold {
                return Some(k);
            } else {
                k += 1;
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::Motion;

    /// Lengths around whole spans and squares, with and without rest after them and with vertical motion, against all samples
    /// one by one; the last sample lifts, and so does rest, where a wall releases a block that leans by its weight.
    #[test]
    fn the_first_lift_is_that_of_all_samples() {
        for samples in [2, 31, 32, 33, 1023, 1024, 1025] {
            let wave =
                |k: usize| 3.0 * (0.37 * k as f64).sin() + if k + 1 == samples { 9.0 } else { 0.0 };
            let horizontal = Motion::new(0.01, (0..samples).map(wave).collect()).unwrap();
            let vertical = (0..samples).map(|k| (0.2 * k as f64).cos()).collect();
            let vertical = Motion::new(0.01, vertical).unwrap();
            for (vertical, and_back) in [(None, false), (None, true), (Some(&vertical), true)] {
                let base = Base {
                    horizontal: Some(&horizontal),
                    vertical,
                };
                let shaking = Shaking::new(base, 10.0, and_back).unwrap();
                assert_eq!(shaking.intervals(), samples - 1 + usize::from(and_back));
                let lifting = |k: usize| {
                    let at = |motion: &Motion| motion.accel_m_s2().get(k).map_or(0.0, |a| a * 0.1);
                    at(&horizontal) / vertical.map_or(1.0, |vertical| 1.0 + at(vertical))
                };
                for threshold in [-0.5, -0.01, 0.0, 0.25, 0.5, 2.0] {
                    for from in [0, 1, samples / 2, samples - 1] {
                        for edge in [0, 1] {
                            let sign = [1.0, -1.0][edge];
                            let expected = (from..=shaking.intervals())
                                .find(|k| sign * lifting(*k) > threshold);
                            let found = shaking.first_release(edge, threshold, from);
                            assert_eq!(found, expected, "{samples} {threshold} {from} {edge}");
                        }
                    }
                }
            }
        }
    }
}
