//! One-dimensional searches: a root by bisection, a maximum by golden section.

/// The point between `low` and `high` where `is_beyond` changes from false to true, by bisection to
/// the last digit.
pub(crate) fn bisect(mut low: f64, mut high: f64, is_beyond: impl Fn(f64) -> bool) -> f64 {
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return high;
        }
        if is_beyond(middle) {
            high = middle
        } else {
            low = middle
        }
    }
}

/// The largest value of a function with a single maximum between `low` and `high`, by golden
/// section. The location is accurate to 1e-8 of the bracket, below which rounding hides the
/// differences, and the value to rounding.
pub(crate) fn golden_maximum(f: impl Fn(f64) -> f64, low: f64, high: f64) -> f64 {
    golden(f, low, high).1
}

/// Where [`golden_maximum`] finds the largest value.
pub(crate) fn golden_maximum_at(f: impl Fn(f64) -> f64, low: f64, high: f64) -> f64 {
    golden(f, low, high).0
}

fn golden(f: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> (f64, f64) {
    const SHARE: f64 = 0.618_033_988_749_895;
    let (mut a, mut b) = (high - SHARE * (high - low), low + SHARE * (high - low));
    let (mut fa, mut fb) = (f(a), f(b));
    // 0.618⁴⁰ = 4e-9.
    for _ in 0..40 {
        if fa < fb {
            (low, a, fa) = (a, b, fb);
            b = low + SHARE * (high - low);
            fb = f(b);
        } else {
            (high, b, fb) = (b, a, fa);
            a = high - SHARE * (high - low);
            fa = f(a);
        }
    }
    if fa < fb { (b, fb) } else { (a, fa) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_top_of_a_parabola_and_of_an_edge() {
        assert!((golden_maximum(|x| 2.0 - (x - 0.3).powi(2), 0.0, 1.0) - 2.0).abs() < 1e-15);
        // Largest at an end, which golden section approaches to 4e-9 of the bracket.
        assert!((golden_maximum(|x| x, 0.0, 1.0) - 1.0).abs() < 1e-8);
    }

    #[test]
    fn halving_ends_at_the_last_digit() {
        let root = bisect(0.0, 2.0, |x| x * x >= 2.0);
        assert!((root - std::f64::consts::SQRT_2).abs() < 3e-16);
    }
}
