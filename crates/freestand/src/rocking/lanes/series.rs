//! The Taylor series of the equation of motion over a step, in every lane.

use super::math::Math;
use super::unroll::{unroll, unroll_down};
use pulp::Simd;

/// Highest degree of a series.
pub(super) const MAX_DEGREE: usize = 11;

/// Room for the terms of a series, with two to spare that are never used: a loop written out names them.
pub(super) const TERMS: usize = MAX_DEGREE + 3;

/// 1/n.
const INVERSE: [f64; TERMS] = {
    let mut inverse = [0.0; TERMS];
    let mut n = 1;
    while n < TERMS {
        inverse[n] = 1.0 / n as f64;
        n += 1;
    }
    inverse
};

/// y = Σ cₖ xᵏ over a step, x from 0 to 1.
#[derive(Clone, Copy)]
pub(super) struct Series<S: Simd, const K: usize> {
    /// cₖ.
    pub(super) c: [S::f64s; TERMS],
    /// k cₖ: the terms of the slope at x = 1.
    pub(super) slope: [S::f64s; TERMS],
}

impl<S: Simd, const K: usize> Series<S, K> {
    /// ÿ = −(E cos y − D sin y) with E = e₀ + e₁x, D = d₀ + d₁x, all in units of the step, from (y, w); linearised: sin y → y,
    /// cos y → 1.
    #[inline(always)]
    pub(super) fn new<const LINEARISED: bool>(
        m: Math<S>,
        y: S::f64s,
        w: S::f64s,
        e: [S::f64s; 2],
        d: [S::f64s; 2],
    ) -> Self {
        let zero = m.splat(0.0);
        let mut c = [zero; TERMS];
        let mut slope = [zero; TERMS];
        let mut sin = [zero; TERMS];
        let mut cos = [zero; TERMS];
        c[0] = y;
        c[1] = w;
        slope[1] = w;
        (sin[0], cos[0]) = if LINEARISED { (y, m.splat(1.0)) } else { m.sin_cos(y) };
        unroll!(N, {
            if N + 2 <= K {
                if N > 0 && LINEARISED {
                    sin[N] = c[N];
                } else if N > 0 {
                    let mut sum = m.mul(slope[1], cos[N - 1]);
                    let mut difference = m.mul(slope[1], sin[N - 1]);
                    unroll!(J, {
                        if J >= 2 && J <= N {
                            sum = m.fma(slope[J], cos[N - J], sum);
                            difference = m.fma(slope[J], sin[N - J], difference);
                        }
                    });
                    sin[N] = m.mul(sum, m.splat(INVERSE[N]));
                    cos[N] = m.mul(difference, m.splat(-INVERSE[N]));
                }
                let mut f = m.fnma(e[0], cos[N], m.mul(d[0], sin[N]));
                if N > 0 {
                    f = m.fma(d[1], sin[N - 1], m.fnma(e[1], cos[N - 1], f));
                }
                slope[N + 2] = m.mul(f, m.splat(INVERSE[N + 1]));
                c[N + 2] = m.mul(slope[N + 2], m.splat(INVERSE[N + 2]));
            }
        });
        Self { c, slope }
    }

    /// y and dy/dx at the end of the step, the small terms first.
    #[inline(always)]
    pub(super) fn end(&self, m: Math<S>) -> (S::f64s, S::f64s) {
        let (mut y, mut slope) = (self.c[K], self.slope[K]);
        unroll_down!(N, {
            if N > 0 && N < K {
                y = m.add(y, self.c[N]);
                slope = m.add(slope, self.slope[N]);
            }
        });
        (m.add(y, self.c[0]), slope)
    }

    /// y and dy/dx at x.
    #[inline(always)]
    pub(super) fn at(&self, m: Math<S>, x: S::f64s) -> (S::f64s, S::f64s) {
        let (mut y, mut slope) = (self.c[K], self.slope[K]);
        unroll_down!(N, {
            if N > 0 && N < K {
                y = m.fma(y, x, self.c[N]);
                slope = m.fma(slope, x, self.slope[N]);
            }
        });
        (m.fma(y, x, self.c[0]), slope)
    }

    /// Σ k|cₖ| from k = 2 on: how far the slope can leave c₁; half of it bounds how far y can leave c₀ + c₁x.
    #[inline(always)]
    pub(super) fn bend(&self, m: Math<S>) -> S::f64s {
        let mut sum = m.abs(self.slope[K]);
        unroll_down!(N, {
            if N >= 2 && N < K {
                sum = m.add(sum, m.abs(self.slope[N]));
            }
        });
        sum
    }

    /// Whether the slope is certain to fall all the way: 2c₂ + Σ k(k−1)|cₖ| < 0.
    #[inline(always)]
    pub(super) fn is_concave(&self, m: Math<S>) -> S::m64s {
        let mut sum = self.slope[2];
        unroll!(N, {
            if N >= 3 && N <= K {
                sum = m.fma(m.abs(self.slope[N]), m.splat((N - 1) as f64), sum);
            }
        });
        m.gt(m.splat(0.0), sum)
    }

    /// The x in (0, 1) of the maximum of a step whose slope falls from above zero to below it without a turn.
    #[inline(always)]
    pub(super) fn summit(&self, m: Math<S>) -> S::f64s {
        // From the parabola through both slopes.
        let (_, end) = self.end(m);
        let mut x = m.div(self.slope[1], m.sub(self.slope[1], end));
        // Newton on the slope: a curve without a turn, so close to a line that four steps reach rounding.
        for _ in 0..4 {
            let (mut p, mut dp) = (self.slope[K], m.mul(self.slope[K], m.splat((K - 1) as f64)));
            unroll_down!(N, {
                if N > 1 && N < K {
                    p = m.fma(p, x, self.slope[N]);
                    dp = m.fma(dp, x, m.mul(self.slope[N], m.splat((N - 1) as f64)));
                }
            });
            p = m.fma(p, x, self.slope[1]);
            x = m.sub(x, m.div(p, dp));
        }
        x
    }
}
