//! The maximum of a smooth function of a few parameters, by Newton's method.

/// A function, its gradient and its matrix of second derivatives.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Derivatives<const N: usize> {
    pub(super) value: f64,
    pub(super) gradient: [f64; N],
    pub(super) hessian: [[f64; N]; N],
}

impl<const N: usize> Derivatives<N> {
    pub(super) fn zero() -> Self {
        Self {
            value: 0.0,
            gradient: [0.0; N],
            hessian: [[0.0; N]; N],
        }
    }
}

/// The most steps of the search; ten are usual.
const MAX_STEPS: usize = 200;

/// The parameters with the largest value of `at`, in the first `count` of N parameters; the others
/// keep their start. `score` is the size of a gradient that must fall to `target`; the search goes
/// on below it as long as it gets better.
///
/// A step is that of Newton where the function is curved downwards, otherwise a shorter one uphill
/// (Levenberg); it is halved until the value rises. `None` if the score does not reach the target.
pub(super) fn maximum<const N: usize>(
    start: [f64; N],
    count: usize,
    target: f64,
    at: impl Fn(&[f64; N]) -> Derivatives<N>,
    score: impl Fn(&[f64; N], &[f64; N]) -> f64,
) -> Option<([f64; N], Derivatives<N>)> {
    let mut here = start;
    let mut found = at(&here);
    let mut size = score(&here, &found.gradient);
    for _ in 0..MAX_STEPS {
        let Some(step) = newton_step(&found, count) else {
            break;
        };
        let moved = |part: f64| {
            let mut there = here;
            there
                .iter_mut()
                .zip(step)
                .take(count)
                .for_each(|(value, by)| *value += part * by);
            there
        };
        let gain: f64 = found
            .gradient
            .iter()
            .zip(step)
            .take(count)
            .map(|(slope, by)| slope * by)
            .sum();
        // Close to the top the value no longer shows which point is better, but its slope does.
        let is_close = gain <= 1e-9 * (1.0 + found.value.abs());
        let next = if is_close {
            let there = moved(1.0);
            let derivatives = at(&there);
            let smaller = score(&there, &derivatives.gradient);
            (smaller < size).then_some((there, derivatives, smaller))
        } else {
            (0..60).map(|i| moved(0.5_f64.powi(i))).find_map(|there| {
                let derivatives = at(&there);
                (derivatives.value > found.value).then(|| {
                    let size = score(&there, &derivatives.gradient);
                    (there, derivatives, size)
                })
            })
        };
        let Some(better) = next else { break };
        (here, found, size) = better;
        if size <= 1e-3 * target {
            break;
        }
    }
    (size <= target).then_some((here, found))
}

/// The step s with −H s = g, with a multiple of the diagonal added until −H is positive definite.
fn newton_step<const N: usize>(at: &Derivatives<N>, count: usize) -> Option<[f64; N]> {
    let diagonal = (0..count)
        .map(|i| at.hessian[i][i].abs())
        .fold(f64::MIN_POSITIVE, f64::max);
    (0..14)
        .map(|i| {
            if i == 0 {
                0.0
            } else {
                1e-12 * diagonal * 10_f64.powi(i)
            }
        })
        .find_map(|added| {
            let matrix: [[f64; N]; N] = std::array::from_fn(|i| {
                std::array::from_fn(|j| if i == j { added } else { 0.0 } - at.hessian[i][j])
            });
            solve_positive(&matrix, &at.gradient, count)
        })
}

/// Solves A x = b for a positive definite matrix by Cholesky's decomposition; `None` for another.
pub(super) fn solve_positive<const N: usize>(
    a: &[[f64; N]; N],
    b: &[f64; N],
    count: usize,
) -> Option<[f64; N]> {
    let mut root = [[0.0; N]; N];
    for i in 0..count {
        for j in 0..=i {
            let inner: f64 = (0..j).map(|k| root[i][k] * root[j][k]).sum();
            let rest = a[i][j] - inner;
            if i != j {
                root[i][j] = rest / root[j][j];
            } else if rest > 1e-14 * a[i][i] && rest.is_finite() {
                root[i][i] = rest.sqrt();
            } else {
                return None;
            }
        }
    }
    let mut x = [0.0; N];
    for i in 0..count {
        let inner: f64 = (0..i).map(|k| root[i][k] * x[k]).sum();
        x[i] = (b[i] - inner) / root[i][i];
    }
    for i in (0..count).rev() {
        let inner: f64 = (i + 1..count).map(|k| root[k][i] * x[k]).sum();
        x[i] = (x[i] - inner) / root[i][i];
    }
    Some(x)
}
