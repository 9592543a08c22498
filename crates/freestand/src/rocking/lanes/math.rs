//! Arithmetic on a vector of lanes, the same bits in every lane on every processor: what is written as fused is fused
//! everywhere, in software where the processor cannot, and nothing else is.

use pulp::Simd;

/// Operations of one generation of vector units.
#[derive(Clone, Copy)]
pub(super) struct Math<S>(pub(super) S);

impl<S: Simd> Math<S> {
    #[inline(always)]
    pub(super) fn splat(self, a: f64) -> S::f64s {
        self.0.splat_f64s(a)
    }

    /// a + b.
    #[inline(always)]
    pub(super) fn add(self, a: S::f64s, b: S::f64s) -> S::f64s {
        self.0.add_f64s(a, b)
    }

    /// a − b.
    #[inline(always)]
    pub(super) fn sub(self, a: S::f64s, b: S::f64s) -> S::f64s {
        self.0.sub_f64s(a, b)
    }

    /// a b.
    #[inline(always)]
    pub(super) fn mul(self, a: S::f64s, b: S::f64s) -> S::f64s {
        self.0.mul_f64s(a, b)
    }

    /// a / b.
    #[inline(always)]
    pub(super) fn div(self, a: S::f64s, b: S::f64s) -> S::f64s {
        self.0.div_f64s(a, b)
    }

    /// a b + c, rounded once.
    #[inline(always)]
    pub(super) fn fma(self, a: S::f64s, b: S::f64s, c: S::f64s) -> S::f64s {
        self.0.mul_add_f64s(a, b, c)
    }

    /// c − a b, rounded once.
    #[inline(always)]
    pub(super) fn fnma(self, a: S::f64s, b: S::f64s, c: S::f64s) -> S::f64s {
        self.0.negate_mul_add_f64s(a, b, c)
    }

    #[inline(always)]
    pub(super) fn abs(self, a: S::f64s) -> S::f64s {
        self.0.abs_f64s(a)
    }

    #[inline(always)]
    pub(super) fn sqrt(self, a: S::f64s) -> S::f64s {
        self.0.sqrt_f64s(a)
    }

    /// a > b, false where one is not a number.
    #[inline(always)]
    pub(super) fn gt(self, a: S::f64s, b: S::f64s) -> S::m64s {
        self.0.greater_than_f64s(a, b)
    }

    /// a ≥ b, false where one is not a number.
    #[inline(always)]
    pub(super) fn ge(self, a: S::f64s, b: S::f64s) -> S::m64s {
        self.0.greater_than_or_equal_f64s(a, b)
    }

    #[inline(always)]
    pub(super) fn and(self, a: S::m64s, b: S::m64s) -> S::m64s {
        self.0.and_m64s(a, b)
    }

    #[inline(always)]
    pub(super) fn or(self, a: S::m64s, b: S::m64s) -> S::m64s {
        self.0.or_m64s(a, b)
    }

    #[inline(always)]
    pub(super) fn not(self, a: S::m64s) -> S::m64s {
        self.0.not_m64s(a)
    }

    #[inline(always)]
    pub(super) fn any(self, mask: S::m64s) -> bool {
        self.0.first_true_m64s(mask) < S::F64_LANES
    }

    #[inline(always)]
    pub(super) fn select(self, mask: S::m64s, yes: S::f64s, no: S::f64s) -> S::f64s {
        self.0.select_f64s(mask, yes, no)
    }

    /// sin y and cos y for 0 ≤ |y| ≤ π/2 to 5e-16: interpolation of sin y/y and cos y in y² at Chebyshev nodes of
    /// [0, (π/2)²], with the leading coefficients of the Taylor series, so that small angles keep their digits.
    #[inline(always)]
    pub(super) fn sin_cos(self, y: S::f64s) -> (S::f64s, S::f64s) {
        let t = self.mul(y, y);
        let t2 = self.mul(t, t);
        let t4 = self.mul(t2, t2);
        // Pairs of terms, and pairs of pairs: a short chain.
        let pair = |c: &[f64], i: usize| self.fma(self.splat(c[i + 1]), t, self.splat(c[i]));
        let sin = self.fma(
            t4,
            self.fma(self.splat(SIN[7]), t2, pair(&SIN, 5)),
            self.fma(pair(&SIN, 3), t2, pair(&SIN, 1)),
        );
        let four = |i: usize| self.fma(pair(&COS, i + 2), t2, pair(&COS, i));
        let cos = self.fma(t4, self.fma(t4, self.splat(COS[8]), four(4)), four(0));
        (self.fma(self.mul(sin, t), y, y), cos)
    }
}

const SIN: [f64; 8] = [
    1.0,
    -0.1666666666666665,
    0.008333333333325933,
    -0.00019841269836469024,
    2.7557318055685783e-06,
    -2.505197292154555e-08,
    1.6050972244135636e-10,
    -7.40805488954261e-13,
];
const COS: [f64; 9] = [
    1.0,
    -0.5,
    0.04166666666666666,
    -0.0013888888888884767,
    2.480158729891355e-05,
    -2.7557318573366175e-07,
    2.0876681558867395e-09,
    -1.1466252259718479e-11,
    4.6464359591124806e-14,
];
