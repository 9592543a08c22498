//! All real roots of a polynomial on the unit interval.

/// The highest degree that [`roots`] accepts.
pub(crate) const MAX_DEGREE: usize = 23;

type Coefficients = [f64; MAX_DEGREE + 1];

/// Binomial coefficients C(n, k) for n up to [`MAX_DEGREE`].
const BINOMIAL: [[f64; MAX_DEGREE + 1]; MAX_DEGREE + 1] = {
    let mut rows = [[0.0; MAX_DEGREE + 1]; MAX_DEGREE + 1];
    let mut n = 0;
    while n <= MAX_DEGREE {
        rows[n][0] = 1.0;
        let mut k = 1;
        while k <= n {
            rows[n][k] = rows[n - 1][k - 1] + rows[n - 1][k];
            k += 1;
        }
        n += 1;
    }
    rows
};

/// Largest number of subdivisions: two roots closer than 2⁻⁴⁰ of the interval count as a point
/// where p touches zero, not as two crossings.
const MAX_DEPTH: usize = 40;

/// p(x) = Σ aₖ xᵏ.
pub(crate) fn value(a: &[f64], x: f64) -> f64 {
    a.iter().rev().fold(0.0, |sum, &a| sum * x + a)
}

/// p(x) and p′(x).
pub(crate) fn value_and_slope(a: &[f64], x: f64) -> (f64, f64) {
    a.iter()
        .rev()
        .fold((0.0, 0.0), |(p, dp), &a| (p * x + a, dp * x + p))
}

/// The first x in (0, 1] at which p changes sign; an exact zero at x = 1 counts.
pub(crate) fn first_root(a: &[f64]) -> Option<f64> {
    let mut first = None;
    roots(a, &mut |x| {
        first = Some(x);
        false
    });
    first
}

/// Calls `found` with every sign change of p in (0, 1], from left to right, until it returns
/// `false`.
///
/// Descartes' rule on the Bernstein coefficients: a part of the interval in which they do not
/// change sign has no root, a part with one change has exactly one, and any other part is halved
/// (Lane and Riesenfeld 1981).
pub(crate) fn roots(a: &[f64], found: &mut impl FnMut(f64) -> bool) {
    let n = a.len() - 1;
    debug_assert!(n <= MAX_DEGREE);
    let mut b = [0.0; MAX_DEGREE + 1];
    for (k, (b, a)) in b.iter_mut().zip(a).enumerate() {
        *b = a / BINOMIAL[n][k];
    }
    for row in 1..=n {
        for i in (row..=n).rev() {
            b[i] += b[i - 1];
        }
    }
    isolate(a, &b, n, 0.0, 1.0, 0, found);
}

/// Returns `false` once `found` has returned `false`.
fn isolate(
    a: &[f64],
    b: &Coefficients,
    n: usize,
    lo: f64,
    hi: f64,
    depth: usize,
    found: &mut impl FnMut(f64) -> bool,
) -> bool {
    let mut changes = 0;
    let mut sign = 0.0;
    for &c in &b[..=n] {
        if c != 0.0 {
            if sign * c < 0.0 {
                changes += 1;
            }
            sign = c.signum();
        }
    }
    // A zero at the right end of the whole interval is a crossing there; elsewhere the next part
    // finds it.
    if hi == 1.0 && b[n] == 0.0 && sign != 0.0 {
        changes += 1;
    }
    if changes == 0 {
        return true;
    }
    if changes == 1 {
        return found(refine(a, lo, hi));
    }
    if depth == MAX_DEPTH {
        return true;
    }
    let mut left = [0.0; MAX_DEGREE + 1];
    let mut right = *b;
    left[0] = right[0];
    for (row, left) in left.iter_mut().enumerate().take(n + 1).skip(1) {
        for i in 0..=n - row {
            right[i] = 0.5 * (right[i] + right[i + 1]);
        }
        *left = right[0];
    }
    let mid = 0.5 * (lo + hi);
    isolate(a, &left, n, lo, mid, depth + 1, found)
        && isolate(a, &right, n, mid, hi, depth + 1, found)
}

/// The only root in [lo, hi], by Newton's method inside a shrinking bracket.
fn refine(a: &[f64], mut lo: f64, mut hi: f64) -> f64 {
    // The sign just to the right of the left end: p itself may be zero at it.
    let sign_lo = {
        let end = value(a, hi);
        if end == 0.0 {
            return hi;
        }
        -end.signum()
    };
    let mut x = 0.5 * (lo + hi);
    for _ in 0..200 {
        let (p, dp) = value_and_slope(a, x);
        if p == 0.0 {
            return x;
        }
        if p.signum() == sign_lo {
            lo = x;
        } else {
            hi = x;
        }
        let mut next = x - p / dp;
        // Not `lo < next < hi`: a converged root may lie on an end of its bracket.
        if !(lo <= next && next <= hi) {
            next = 0.5 * (lo + hi);
        }
        if (next - x).abs() <= f64::EPSILON * next.abs() {
            return next;
        }
        x = next;
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    fn from_roots(zeros: &[f64]) -> Vec<f64> {
        zeros.iter().fold(vec![1.0], |p, z| {
            let mut q = vec![0.0; p.len() + 1];
            for (i, c) in p.iter().enumerate() {
                q[i + 1] += c;
                q[i] -= z * c;
            }
            q
        })
    }

    fn all(a: &[f64]) -> Vec<f64> {
        let mut list = Vec::new();
        roots(a, &mut |x| {
            list.push(x);
            true
        });
        list
    }

    /// Well-separated simple roots keep all but a few of their digits.
    #[test]
    fn finds_every_simple_root_in_order() {
        let zeros = [0.1, 0.3, 0.35, 0.9, -0.5, 1.5];
        let got = all(&from_roots(&zeros));
        assert_eq!(got.len(), 4);
        for (x, z) in got.iter().zip(zeros) {
            assert!((x - z).abs() < 1e-12, "{x} {z}");
        }
        assert!((first_root(&from_roots(&zeros)).unwrap() - 0.1).abs() < 1e-13);
    }

    #[test]
    fn tiny_roots_keep_their_relative_accuracy() {
        for z in [1e-3, 1e-7, 1e-12] {
            let x = first_root(&from_roots(&[z, 2.0])).unwrap();
            assert!((x / z - 1.0).abs() < 1e-13, "{x}");
        }
    }

    #[test]
    fn a_root_on_the_right_end_counts_and_one_at_zero_does_not() {
        assert_eq!(all(&[1.0, -1.0]), [1.0]);
        assert_eq!(all(&[0.0, 1.0]), Vec::<f64>::new());
        assert_eq!(all(&[1.0, 1.0]), Vec::<f64>::new());
        assert_eq!(all(&[0.0, 0.0]), Vec::<f64>::new());
    }

    #[test]
    fn a_near_miss_is_no_root_and_a_near_hit_is_two() {
        // (x − 0.4)² ± 1e-12: two crossings 2e-6 apart, or none.
        assert_eq!(all(&[0.16 + 1e-12, -0.8, 1.0]), Vec::<f64>::new());
        let two = all(&[0.16 - 1e-12, -0.8, 1.0]);
        assert_eq!(two.len(), 2);
        assert!((two[1] - two[0] - 2e-6).abs() < 1e-9);
    }
}
