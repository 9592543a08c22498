//! The Taylor series of the equation of motion over a step, in every lane.

#![expect(
    clippy::absurd_extreme_comparisons,
    reason = "loops are unrolled with constants, one of which is zero"
)]

use super::unroll::{unroll, unroll_down};
use crate::vector::{Masks, Math, Numbers};
use pulp::Simd;

/// Highest degree of a series.
pub(super) const MAX_DEGREE: usize = 11;

/// Length of the arrays of terms: two more than a series has. They are never used, but unrolled
/// loops refer to them.
pub(super) const TERMS: usize = MAX_DEGREE + 3;

/// 1/n.
pub(super) const INVERSE: [f64; TERMS] = {
    let mut inverse = [0.0; TERMS];
    let mut n = 1;
    while n < TERMS {
        inverse[n] = 1.0 / n as f64;
        n += 1;
    }
    inverse
};

/// The edge that a block turns about: α, and p²h² for a step h.
#[derive(Clone, Copy)]
pub(super) struct Edge<S: Simd> {
    pub(super) alpha: Numbers<S>,
    pub(super) x2: Numbers<S>,
}

/// Base acceleration over a step: s ü_h/g and 1 + ü_v/g at its start, and their changes; `v` is 1
/// without vertical motion.
#[derive(Clone, Copy)]
pub(super) struct Ground<S: Simd> {
    pub(super) su: Numbers<S>,
    pub(super) su_change: Numbers<S>,
    pub(super) v: Numbers<S>,
    pub(super) v_change: Numbers<S>,
}

/// y = Σ cₖ xᵏ over a step, x from 0 to 1.
#[derive(Clone, Copy)]
pub(super) struct Series<S: Simd, const K: usize> {
    /// cₖ.
    pub(super) c: [Numbers<S>; TERMS],
    /// k cₖ: the terms of the slope at x = 1.
    pub(super) slope: [Numbers<S>; TERMS],
    /// x² sin φ and x² cos φ at the start.
    pub(super) start: [Numbers<S>; 2],
}

impl<S: Simd, const K: usize> Series<S, K> {
    /// The series of ÿ = −x²\[(v₀+v₁x) sin φ + s(u₀+u₁x) cos φ\], φ = α − y, in units of the step,
    /// from (y, w). `first` may change −ÿ at the start.
    #[inline(always)]
    pub(super) fn new<const VERTICAL: bool>(
        m: Math<S>,
        y: Numbers<S>,
        w: Numbers<S>,
        edge: Edge<S>,
        ground: Ground<S>,
        first: impl Fn(Numbers<S>) -> Numbers<S>,
    ) -> Self {
        let zero = m.splat(0.0);
        let (mut c, mut slope) = ([zero; TERMS], [zero; TERMS]);
        // x² sin φ and x² cos φ.
        let (mut sin, mut cos) = ([zero; TERMS], [zero; TERMS]);
        c[0] = y;
        c[1] = w;
        slope[1] = w;
        let phi = m.sub(edge.alpha, y);
        (sin[0], cos[0]) = m.sin_cos(phi);
        (sin[0], cos[0]) = (m.mul(edge.x2, sin[0]), m.mul(edge.x2, cos[0]));
        unroll!(N, {
            if N + 2 <= K {
                if N > 0 {
                    let mut sum = m.mul(slope[1], cos[N - 1]);
                    let mut difference = m.mul(slope[1], sin[N - 1]);
                    unroll!(J, {
                        if J >= 2 && J <= N {
                            sum = m.fma(slope[J], cos[N - J], sum);
                            difference = m.fma(slope[J], sin[N - J], difference);
                        }
                    });
                    sin[N] = m.mul(sum, m.splat(-INVERSE[N]));
                    cos[N] = m.mul(difference, m.splat(INVERSE[N]));
                }
                // −ÿ; the newest term is added last, so that the chain from one term to the next
                // but one is short.
                let f = if N == 0 {
                    let vertical = if VERTICAL {
                        m.mul(ground.v, sin[0])
                    } else {
                        sin[0]
                    };
                    m.fma(ground.su, cos[0], vertical)
                } else {
                    let mut before = m.mul(ground.su_change, cos[N - 1]);
                    if VERTICAL {
                        before = m.fma(ground.v_change, sin[N - 1], before);
                        before = m.fma(ground.v, sin[N], before);
                    } else {
                        before = m.add(sin[N], before);
                    }
                    m.fma(ground.su, cos[N], before)
                };
                let f = if N == 0 { first(f) } else { f };
                slope[N + 2] = m.mul(f, m.splat(-INVERSE[N + 1]));
                c[N + 2] = m.mul(slope[N + 2], m.splat(INVERSE[N + 2]));
            }
        });
        let start = [sin[0], cos[0]];
        Self { c, slope, start }
    }

    /// y and dy/dx at the end of the step, the small terms first.
    #[inline(always)]
    pub(super) fn end(&self, m: Math<S>) -> (Numbers<S>, Numbers<S>) {
        let (mut y, mut slope) = (self.c[K], self.slope[K]);
        unroll_down!(N, {
            if N > 0 && N < K {
                y = m.add(y, self.c[N]);
                slope = m.add(slope, self.slope[N]);
            }
        });
        (m.add(y, self.c[0]), slope)
    }

    /// Σ k|cₖ| from k = 2: a bound of the difference between the slope and c₁; half of it bounds
    /// the difference between y and c₀ + c₁x.
    #[inline(always)]
    pub(super) fn bend(&self, m: Math<S>) -> Numbers<S> {
        let mut sum = m.abs(self.slope[K]);
        unroll_down!(N, {
            if N >= 2 && N < K {
                sum = m.add(sum, m.abs(self.slope[N]));
            }
        });
        sum
    }

    /// The end of the step, and what is certain about the way to it.
    #[inline(always)]
    pub(super) fn shape(&self, m: Math<S>) -> Shape<S> {
        let zero = m.splat(0.0);
        let (y1, w1) = self.end(m);
        // k(k−1)|cₖ| and k(k−1)(k−2)|cₖ| from k = 4.
        let (mut beyond_bend, mut beyond_third) = (zero, zero);
        unroll_down!(N, {
            if N >= 4 && N <= K {
                let size = m.abs(self.slope[N]);
                beyond_bend = m.fma(size, m.splat((N - 1) as f64), beyond_bend);
                beyond_third = m.fma(size, m.splat(((N - 1) * (N - 2)) as f64), beyond_third);
            }
        });
        // 2c₂ + 6c₃x at both ends, and 6c₃.
        let start = self.slope[2];
        let third = m.add(self.slope[3], self.slope[3]);
        let end = m.add(start, third);
        let opens = m.gt(third, beyond_third);
        let closes = m.gt(m.sub(zero, third), beyond_third);
        Shape {
            bend: self.bend(m),
            y1,
            w1,
            concave: m.or(
                m.gt(m.sub(zero, m.larger(start, end)), beyond_bend),
                m.and(closes, m.ge(zero, start)),
            ),
            convex: m.or(
                m.gt(m.smaller(start, end), beyond_bend),
                m.and(opens, m.ge(start, zero)),
            ),
            opens,
            closes,
        }
    }

    /// Whether y is certainly above 0 throughout the step, after its start: too far from the floor, or
    /// going up too fast to come back, or speeding up.
    #[inline(always)]
    pub(super) fn stays_above(&self, m: Math<S>) -> Masks<S> {
        let zero = m.splat(0.0);
        // Σ |cₖ| from k = 4.
        let mut beyond = zero;
        unroll_down!(N, {
            if N >= 4 && N <= K {
                beyond = m.add(beyond, m.abs(self.c[N]));
            }
        });
        let mut above = m.gt(self.c[3], beyond);
        unroll_down!(N, {
            if N <= 2 {
                beyond = m.add(beyond, m.abs(self.c[N + 1]));
                above = m.or(m.gt(self.c[N], beyond), m.and(m.ge(self.c[N], zero), above));
            }
        });
        above
    }
}

/// A step of y: its end, and what is certain about the way to it.
pub(super) struct Shape<S: Simd> {
    /// Bound of the difference between the slope and c₁.
    pub(super) bend: Numbers<S>,
    /// y and dy/dx at the end.
    pub(super) y1: Numbers<S>,
    pub(super) w1: Numbers<S>,
    /// The slope falls throughout, or it rises throughout.
    pub(super) concave: Masks<S>,
    pub(super) convex: Masks<S>,
    /// The second derivative rises throughout, or it falls throughout: the slope is below the line
    /// between its ends, or above it.
    pub(super) opens: Masks<S>,
    pub(super) closes: Masks<S>,
}
