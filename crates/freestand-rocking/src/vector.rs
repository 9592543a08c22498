//! Arithmetic on a vector of lanes, with identical bits in every lane on every vector unit: an
//! operation written as fused is fused everywhere, in software where the processor has no such
//! instruction, and no other operation is. (Calculations made once for a block, or at rare events,
//! use the platform's sine and logarithm.)

use std::ops::{Deref, DerefMut};

use pulp::Simd;

/// An operation on each of two vectors.
macro_rules! each {
    ($i:ident, $operation:expr) => {
        [
            {
                let $i = 0;
                $operation
            },
            {
                let $i = 1;
                $operation
            },
        ]
    };
}

/// Two vectors of numbers whose operations alternate: each vector's chain of operations runs while
/// the other's waits.
pub type Numbers<S> = [<S as Simd>::f64s; 2];

/// One truth value for each number.
pub type Masks<S> = [<S as Simd>::m64s; 2];

/// One number for each of N lanes.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
pub struct Column<const N: usize>(pub [f64; N]);

impl<const N: usize> Column<N> {
    /// Number of pairs of vectors in a column.
    pub const fn pairs<S: Simd>() -> usize {
        N / (2 * S::F64_LANES)
    }

    /// The pair of vectors `i`.
    #[inline(always)]
    pub fn get<S: Simd>(&self, i: usize) -> Numbers<S> {
        let (vectors, _) = S::as_simd_f64s(&self.0);
        vectors.as_chunks().0[i]
    }

    /// Puts the pair of vectors `i`.
    #[inline(always)]
    pub fn set<S: Simd>(&mut self, i: usize, value: Numbers<S>) {
        let (vectors, _) = S::as_mut_simd_f64s(&mut self.0);
        vectors.as_chunks_mut().0[i] = value;
    }
}

impl<const N: usize> Default for Column<N> {
    fn default() -> Self {
        Self([0.0; N])
    }
}

impl<const N: usize> Deref for Column<N> {
    type Target = [f64; N];

    fn deref(&self) -> &[f64; N] {
        &self.0
    }
}

impl<const N: usize> DerefMut for Column<N> {
    fn deref_mut(&mut self) -> &mut [f64; N] {
        &mut self.0
    }
}

/// The operations of one generation of vector units, on two vectors.
#[derive(Clone, Copy)]
pub struct Math<S>(pub S);

impl<S: Simd> Math<S> {
    /// a in every lane.
    #[inline(always)]
    pub fn splat(self, a: f64) -> Numbers<S> {
        [self.0.splat_f64s(a); 2]
    }

    /// a + b.
    #[inline(always)]
    pub fn add(self, a: Numbers<S>, b: Numbers<S>) -> Numbers<S> {
        each!(i, self.0.add_f64s(a[i], b[i]))
    }

    /// a − b.
    #[inline(always)]
    pub fn sub(self, a: Numbers<S>, b: Numbers<S>) -> Numbers<S> {
        each!(i, self.0.sub_f64s(a[i], b[i]))
    }

    /// a b.
    #[inline(always)]
    pub fn mul(self, a: Numbers<S>, b: Numbers<S>) -> Numbers<S> {
        each!(i, self.0.mul_f64s(a[i], b[i]))
    }

    /// a / b.
    #[inline(always)]
    pub fn div(self, a: Numbers<S>, b: Numbers<S>) -> Numbers<S> {
        each!(i, self.0.div_f64s(a[i], b[i]))
    }

    /// a b + c, rounded once.
    #[inline(always)]
    pub fn fma(self, a: Numbers<S>, b: Numbers<S>, c: Numbers<S>) -> Numbers<S> {
        each!(i, self.0.mul_add_f64s(a[i], b[i], c[i]))
    }

    /// c − a b, rounded once.
    #[inline(always)]
    pub fn fnma(self, a: Numbers<S>, b: Numbers<S>, c: Numbers<S>) -> Numbers<S> {
        each!(i, self.0.negate_mul_add_f64s(a[i], b[i], c[i]))
    }

    /// |a|. The library's own is a call in builds for tests, which takes half of their time.
    #[inline(always)]
    pub fn abs(self, a: Numbers<S>) -> Numbers<S> {
        let all_but_sign = self.0.splat_f64s(f64::from_bits(!(-0.0f64).to_bits()));
        each!(i, self.0.and_f64s(all_but_sign, a[i]))
    }

    /// The larger one; b where one is not a number.
    #[inline(always)]
    pub fn larger(self, a: Numbers<S>, b: Numbers<S>) -> Numbers<S> {
        self.select(self.gt(a, b), a, b)
    }

    /// The smaller one; b where one is not a number.
    #[inline(always)]
    pub fn smaller(self, a: Numbers<S>, b: Numbers<S>) -> Numbers<S> {
        self.select(self.gt(b, a), a, b)
    }

    /// The larger one of two numbers: [`Self::larger`] where the result goes to the place of one of them.
    /// A compiler makes a masked store of that, for which some processors with AVX2 take twenty times as long.
    #[inline(always)]
    pub fn most(self, a: Numbers<S>, b: Numbers<S>) -> Numbers<S> {
        each!(i, self.0.max_f64s(a[i], b[i]))
    }

    /// √a.
    #[inline(always)]
    pub fn sqrt(self, a: Numbers<S>) -> Numbers<S> {
        each!(i, self.0.sqrt_f64s(a[i]))
    }

    /// a > b, false where one is not a number.
    #[inline(always)]
    pub fn gt(self, a: Numbers<S>, b: Numbers<S>) -> Masks<S> {
        each!(i, self.0.greater_than_f64s(a[i], b[i]))
    }

    /// a ≥ b, false where one is not a number.
    #[inline(always)]
    pub fn ge(self, a: Numbers<S>, b: Numbers<S>) -> Masks<S> {
        each!(i, self.0.greater_than_or_equal_f64s(a[i], b[i]))
    }

    /// Both.
    #[inline(always)]
    pub fn and(self, a: Masks<S>, b: Masks<S>) -> Masks<S> {
        each!(i, self.0.and_m64s(a[i], b[i]))
    }

    /// Either.
    #[inline(always)]
    pub fn or(self, a: Masks<S>, b: Masks<S>) -> Masks<S> {
        each!(i, self.0.or_m64s(a[i], b[i]))
    }

    /// Not.
    #[inline(always)]
    pub fn not(self, a: Masks<S>) -> Masks<S> {
        each!(i, self.0.not_m64s(a[i]))
    }

    /// `yes` where the mask is true, else `no`.
    #[inline(always)]
    pub fn select_mask(self, mask: Masks<S>, yes: Masks<S>, no: Masks<S>) -> Masks<S> {
        self.or(self.and(mask, yes), self.and(self.not(mask), no))
    }

    /// `yes` where the mask is true, else `no`. The library's own for f64 is a call in builds for
    /// tests, which takes five sixths of their time.
    #[inline(always)]
    pub fn select(self, mask: Masks<S>, yes: Numbers<S>, no: Numbers<S>) -> Numbers<S> {
        let bits = |a| self.0.transmute_u64s_f64s(a);
        each!(
            i,
            self.0
                .transmute_f64s_u64s(self.0.select_u64s(mask[i], bits(yes[i]), bits(no[i])))
        )
    }

    /// The sum over all lanes, of numbers whose sum is exact in any order.
    #[inline(always)]
    pub fn sum(self, a: Numbers<S>) -> f64 {
        self.0.reduce_sum_f64s(self.0.add_f64s(a[0], a[1]))
    }

    /// Whether the mask is true anywhere.
    #[inline(always)]
    pub fn any(self, mask: Masks<S>) -> bool {
        mask.iter()
            .any(|mask| self.0.first_true_m64s(*mask) < S::F64_LANES)
    }

    /// sin y and cos y for 0 ≤ |y| ≤ π/2, accurate to 9e-16: interpolation of sin y/y and cos y in
    /// y² at Chebyshev nodes of [0, (π/2)²], with the leading coefficients of the Taylor series, so
    /// that small angles keep their digits.
    #[inline(always)]
    pub fn sin_cos(self, y: Numbers<S>) -> (Numbers<S>, Numbers<S>) {
        let t = self.mul(y, y);
        let t2 = self.mul(t, t);
        let t4 = self.mul(t2, t2);
        let sin = self.fma(
            t4,
            self.fma(self.splat(SIN[7]), t2, self.pair(&SIN, 5, t)),
            self.fma(self.pair(&SIN, 3, t), t2, self.pair(&SIN, 1, t)),
        );
        let high = self.fma(self.pair(&COS, 6, t), t2, self.pair(&COS, 4, t));
        let low = self.fma(self.pair(&COS, 2, t), t2, self.pair(&COS, 0, t));
        let cos = self.fma(t4, self.fma(t4, self.splat(COS[8]), high), low);
        (self.fma(self.mul(sin, t), y, y), cos)
    }

    /// Two terms of a polynomial: evaluation by pairs, and pairs of pairs, makes a shorter chain
    /// than term by term.
    #[inline(always)]
    fn pair(self, c: &[f64], i: usize, t: Numbers<S>) -> Numbers<S> {
        self.fma(self.splat(c[i + 1]), t, self.splat(c[i]))
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

/// Numbers that are compared side by side: one comparison would wait for that before it.
pub(crate) const ABREAST: usize = 8;

/// The largest of the values of a function, which are numbers; −∞ without any.
#[inline(always)]
pub fn largest(values: &[f64], of: impl Fn(f64) -> f64) -> f64 {
    let larger = |most: f64, value: f64| if value > most { value } else { most };
    let (abreast, rest) = values.as_chunks::<ABREAST>();
    let mut most = [f64::NEG_INFINITY; ABREAST];
    for values in abreast {
        for (most, value) in most.iter_mut().zip(values) {
            *most = larger(*most, of(*value));
        }
    }
    // By halves: one comparison after the other would take longer than a short slice.
    let mut width = ABREAST / 2;
    while width > 0 {
        for lane in 0..width {
            most[lane] = larger(most[lane], most[lane + width]);
        }
        width /= 2;
    }
    rest.iter().map(|value| of(*value)).fold(most[0], larger)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sine_and_cosine_are_those_of_the_platform() {
        let m = Math(pulp::Scalar::new());
        let mut worst: f64 = 0.0;
        for i in 1..=10_000 {
            let y = std::f64::consts::FRAC_PI_2 * f64::from(i) / 10_000.0;
            for y in [y, -y, 1e-8 * y] {
                let ([sin, _], [cos, _]) = m.sin_cos([y; 2]);
                // Relative to the sine: that of a small angle keeps its digits.
                worst = worst
                    .max((sin / y.sin() - 1.0).abs())
                    .max((cos - y.cos()).abs());
            }
        }
        // Rounding of the last digits; the largest error found is 8.9e-16.
        assert!(worst <= 1e-15, "{worst}");
    }
}
