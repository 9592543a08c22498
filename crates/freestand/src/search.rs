//! One-dimensional searches: a root by bisection or by false position, a maximum by golden section.

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

/// Where a smooth value that is positive at `low` and not at `high` passes zero, to `within`: by false position, with
/// bisection where a value is infinite. Both ends come with their values.
pub(crate) fn falls(
    (mut low, mut above): (f64, f64),
    (mut high, mut below): (f64, f64),
    within: f64,
    value: impl Fn(f64) -> f64,
) -> f64 {
    let mut last_was_above = None;
    while high - low > within {
        let share = above / (above - below);
        let share = if share.is_finite() { share } else { 0.5 };
        // Not nearer to an end than `within`, so that both ends close in.
        let inset = 0.5 * within / (high - low);
        let middle = low + (high - low) * share.clamp(inset, 1.0 - inset);
        let found = value(middle);
        let is_above = found > 0.0;
        // An end that stays counts half, so that it moves soon (the Illinois method).
        let stays = last_was_above == Some(is_above);
        if is_above {
            (low, above) = (middle, found);
            below *= if stays { 0.5 } else { 1.0 };
        } else {
            (high, below) = (middle, found);
            above *= if stays { 0.5 } else { 1.0 };
        }
        last_was_above = Some(is_above);
    }
    high
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
    fn a_value_falls_through_zero_once() {
        let within = 1e-9;
        let of =
            |value: &dyn Fn(f64) -> f64| falls((0.0, value(0.0)), (1.0, value(1.0)), within, value);
        for root in [1e-7, 0.1, 0.5, 0.9, 1.0] {
            let bent = |x: f64| (root - x) * (1.0 + 30.0 * x * x);
            assert!((of(&bent) - root).abs() <= within, "{root}");
            let steep = |x: f64| (50.0 * (root - x)).exp() - 1.0;
            assert!((of(&steep) - root).abs() <= within, "{root}");
            let endless = |x: f64| if x <= root { f64::INFINITY } else { -1.0 };
            let sure = falls((0.0, f64::INFINITY), (1.0, -1.0), within, endless);
            assert!((sure - root).abs() <= within, "{root}");
        }
        // A flat stretch counts as below.
        assert!((of(&|x| (0.3 - x).max(0.0)) - 0.3).abs() <= 1e-6);
    }

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
