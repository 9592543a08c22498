//! Several samples at once: where a bound says that none of their steps sets a new extreme, nobody looks at them.

use super::linear::{Bounds, Modes, Recursion, STATES, Sample, WEIGHED};

/// Samples of a stretch. The longer it is, the fewer products a sample takes, and the farther the bound is from what
/// it bounds.
pub(super) const SAMPLES: usize = 8;

/// By the accelerations at the start of each sample of a stretch, and at its end.
type Base = [f64; SAMPLES + 1];

/// A whole stretch, and what bounds the numbers of the block at all of its steps.
#[derive(Debug, Clone)]
pub(super) struct Stretch {
    /// y at the end, by that at the start and by the accelerations of the base, each way.
    pub(super) state: [[f64; STATES]; STATES],
    pub(super) base: [[Base; STATES]; 2],
    /// As of a sample. What is weighed of the base is its horizontal acceleration at the start of the stretch, the
    /// largest difference from it, and the largest vertical one.
    pub(super) bounds: Bounds,
}

impl Stretch {
    /// Of so many samples.
    pub(super) fn new(sample: &Sample) -> Self {
        let one = &sample.recursion;
        let mut state = one.state;
        for _ in 1..SAMPLES {
            state = product(&one.state, &state);
        }
        Self {
            state,
            base: [0, 1].map(|way: usize| base(one, way)),
            bounds: bounds(sample),
        }
    }
}

type Square = [[f64; STATES]; STATES];

fn product(a: &Square, b: &Square) -> Square {
    let mut all = [[0.0; STATES]; STATES];
    for (row, left) in all.iter_mut().zip(a) {
        for (factor, through) in left.iter().zip(b) {
            for (value, part) in row.iter_mut().zip(through) {
                *value += factor * part;
            }
        }
    }
    all
}

fn times(a: &Square, y: &[f64; STATES]) -> [f64; STATES] {
    a.map(|row| row.iter().zip(y).map(|(a, y)| a * y).sum())
}

/// An acceleration acts at the end of the sample before it and at the start of the one after it, and then through all
/// samples that follow.
fn base(one: &Recursion, way: usize) -> [Base; STATES] {
    let mut all = [[0.0; SAMPLES + 1]; STATES];
    let mut add = |at: usize, part: &[f64; STATES]| {
        for (row, part) in all.iter_mut().zip(part) {
            row[at] += part;
        }
    };
    let (mut from, mut to) = (one.from.map(|ways| ways[way]), one.to.map(|ways| ways[way]));
    for sample in (0..SAMPLES).rev() {
        add(sample, &from);
        add(sample + 1, &to);
        (from, to) = (times(&one.state, &from), times(&one.state, &to));
    }
    all
}

/// From the bounds within a sample, and from how far its start may be from the start of the stretch.
fn bounds(sample: &Sample) -> Bounds {
    let Sample {
        recursion,
        modes,
        bounds,
    } = sample;
    let one = in_modes(modes, &recursion.state);
    let of_way =
        |rows: &[[f64; 2]; STATES], way: usize| into_modes(modes, &rows.map(|ways| ways[way]));
    let (mut from, mut to) = (of_way(&recursion.from, 0), of_way(&recursion.to, 0));
    let (mut up_from, mut up_to) = (of_way(&recursion.from, 1), of_way(&recursion.to, 1));
    let mut held = [0.0; STATES];
    held[..3].copy_from_slice(&modes.held);

    // What the start of a sample depends on, in the modes without the place that its acceleration would hold: the
    // states at the start of the stretch, a steady acceleration, and at most so much the largest difference from it and
    // the largest vertical acceleration. Each acts as the end of a sample and then as the start of the next one, the
    // first one as a start alone.
    let mut state = [[0.0; STATES]; STATES];
    for (k, row) in state.iter_mut().enumerate() {
        row[k] = 1.0;
    }
    let nothing: [f64; STATES] = [0.0; STATES];
    let (mut steady, mut change, mut up) = (nothing, nothing, nothing);
    let (mut begun, mut up_begun) = (nothing, nothing);
    let mut place = held;
    let mut all = Bounds::default();
    for _ in 0..SAMPLES {
        let still = times(&state, &held);
        let steady_now: [f64; STATES] =
            std::array::from_fn(|k| (still[k] + steady[k] - held[k]).abs());
        let up_now: [f64; STATES] = std::array::from_fn(|k| up[k] + up_begun[k].abs());
        for (most, weights) in [
            (&mut all.lost, &bounds.lost),
            (&mut all.press, &bounds.press),
            (&mut all.up, &bounds.up),
        ] {
            let sum = |sizes: &[f64; STATES]| {
                let pairs = weights.iter().zip(sizes);
                pairs.map(|(weight, size)| weight * size).sum::<f64>()
            };
            let (level, slope) = (weights[STATES], weights[STATES + 1]);
            let mut now = [0.0; WEIGHED];
            for (k, now) in now.iter_mut().take(STATES).enumerate() {
                *now = sum(&state.map(|row| row[k].abs()));
            }
            now[STATES] = sum(&steady_now) + level;
            // Two accelerations that differ by at most this from the first differ by at most twice this.
            now[STATES + 1] = sum(&change) + level + 2.0 * slope;
            now[STATES + 2] = sum(&up_now) + weights[STATES + 2];
            for (most, now) in most.iter_mut().zip(now) {
                *most = most.max(now);
            }
        }
        for k in 0..STATES {
            change[k] += (begun[k] + to[k] - place[k]).abs();
            up[k] += (up_begun[k] + up_to[k]).abs();
            steady[k] += from[k] + to[k];
        }
        (begun, up_begun, place) = (from, up_from, nothing);
        state = product(&one, &state);
        (from, to) = (times(&one, &from), times(&one, &to));
        (up_from, up_to) = (times(&one, &up_from), times(&one, &up_to));
    }
    all
}

/// Places and rates of the modes from those of the block.
fn into_modes(modes: &Modes, y: &[f64; STATES]) -> [f64; STATES] {
    std::array::from_fn(|k| {
        let (half, mode) = (k / 3 * 3, k % 3);
        (0..3).map(|i| modes.into[mode][i] * y[half + i]).sum()
    })
}

/// What `a` does to the states of the block, as what it does to those of the modes.
fn in_modes(modes: &Modes, a: &Square) -> Square {
    let mut columns = [[0.0; STATES]; STATES];
    for (mode, column) in columns.iter_mut().enumerate() {
        let half = mode / 3 * 3;
        let mut y = [0.0; STATES];
        for i in 0..3 {
            y[half + i] = modes.from[i][mode % 3];
        }
        *column = into_modes(modes, &times(a, &y));
    }
    std::array::from_fn(|k| columns.map(|column| column[k]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compliant::bulk::tests::leaning;

    /// Accelerations of the base at the samples of a stretch, each way.
    const A: [Base; 2] = [
        [0.7, 1.9, -0.4, -2.2, 0.3, 0.1, 2.5, 1.1, -0.6],
        [-0.2, 0.4, 0.9, -0.3, -1.2, 0.5, 0.0, 0.8, 0.7],
    ];
    const Y: [f64; STATES] = [1e-3, 2e-4, -3e-3, 1e-4, 5e-5, 2e-3];

    fn after(one: &Recursion, y: [f64; STATES], sample: usize) -> [f64; STATES] {
        let moved = times(&one.state, &y);
        std::array::from_fn(|k| {
            let base = |way: usize| {
                one.from[k][way] * A[way][sample] + one.to[k][way] * A[way][sample + 1]
            };
            moved[k] + base(0) + base(1)
        })
    }

    /// Samples one after the other are a whole stretch.
    #[test]
    fn a_stretch_is_its_samples() {
        let body = leaning();
        let sample = Sample::new(&body, &Recursion::new(&body));
        let whole = Stretch::new(&sample);
        let one_by_one = (0..SAMPLES).fold(Y, |y, i| after(&sample.recursion, y, i));
        let moved = times(&whole.state, &Y);
        for (k, expected) in one_by_one.into_iter().enumerate() {
            let by_base = |way: usize| -> f64 {
                let pairs = whole.base[way][k].iter().zip(&A[way]);
                pairs.map(|(part, a)| part * a).sum()
            };
            let found = moved[k] + by_base(0) + by_base(1);
            // Rounding of a dozen products for each sample, with numbers of this size.
            assert!(
                (found - expected).abs() < 1e-15 * SAMPLES as f64,
                "{k}: {found} {expected}"
            );
        }
    }

    /// What bounds the numbers in each sample is not larger than what bounds them in the stretch, and the latter is
    /// close enough to be of use.
    #[test]
    fn the_bound_of_a_stretch_is_above_those_of_its_samples() {
        let body = leaning();
        let sample = Sample::new(&body, &Recursion::new(&body));
        let whole = Stretch::new(&sample);
        let sizes = |y: [f64; STATES], a: f64, change: f64, up: f64| {
            let mut modes = into_modes(&sample.modes, &y);
            for (place, held) in modes.iter_mut().zip(sample.modes.held) {
                *place -= held * a;
            }
            let base = [a, change, up];
            let sizes: Vec<f64> = modes.iter().chain(&base).map(|one| one.abs()).collect();
            sizes
        };
        let bound = |weights: &[f64; WEIGHED], sizes: &[f64]| -> f64 {
            weights
                .iter()
                .zip(sizes)
                .map(|(weight, size)| weight * size)
                .sum()
        };
        let most = |values: &[f64]| values.iter().fold(0.0_f64, |most, one| most.max(one.abs()));
        for scale in [0.0, 1.0] {
            let y = Y.map(|y| scale * y);
            let change = most(&A[0].map(|a| a - A[0][0]));
            let of_stretch = sizes(y, A[0][0], change, most(&A[1]));
            let mut highest = [0.0_f64; 3];
            let mut inside = y;
            for i in 0..SAMPLES {
                let change = A[0][i + 1] - A[0][i];
                let of_sample = sizes(inside, A[0][i], change, most(&A[1][i..=i + 1]));
                let Bounds { lost, press, up } = &sample.bounds;
                for (highest, weights) in highest.iter_mut().zip([lost, press, up]) {
                    *highest = highest.max(bound(weights, &of_sample));
                }
                inside = after(&sample.recursion, inside, i);
            }
            let Bounds { lost, press, up } = &whole.bounds;
            for (highest, weights) in highest.into_iter().zip([lost, press, up]) {
                let found = bound(weights, &of_stretch);
                assert!(found >= highest, "{scale}: {found} {highest}");
                // Seen: up to 4.
                assert!(found < 10.0 * highest, "{scale}: {found} {highest}");
            }
        }
    }
}
