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
    use crate::compliant::bulk::look::{Look, Looking, Reached, Wanted};
    use crate::compliant::bulk::tests::{leaning, soft};

    /// y after a sample, with the accelerations of the base at the samples of a stretch, each way.
    fn after(one: &Recursion, y: [f64; STATES], base: &[Base; 2], sample: usize) -> [f64; STATES] {
        let moved = times(&one.state, &y);
        std::array::from_fn(|k| {
            let base = |way: usize| {
                one.from[k][way] * base[way][sample] + one.to[k][way] * base[way][sample + 1]
            };
            moved[k] + base(0) + base(1)
        })
    }

    /// Samples one after the other are a whole stretch.
    #[test]
    fn a_stretch_is_its_samples() {
        let base = [
            [0.7, 1.9, -0.4, -2.2, 0.3, 0.1, 2.5, 1.1, -0.6],
            [-0.2, 0.4, 0.9, -0.3, -1.2, 0.5, 0.0, 0.8, 0.7],
        ];
        let y = [1e-3, 2e-4, -3e-3, 1e-4, 5e-5, 2e-3];
        let body = leaning();
        let sample = Sample::new(&body, &Recursion::new(&body));
        let whole = Stretch::new(&sample);
        let one_by_one = (0..SAMPLES).fold(y, |y, i| after(&sample.recursion, y, &base, i));
        let moved = times(&whole.state, &y);
        for (k, expected) in one_by_one.into_iter().enumerate() {
            let by_base = |way: usize| -> f64 {
                let pairs = whole.base[way][k].iter().zip(&base[way]);
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

    /// Starts of a stretch, and what its base does, in which only one thing that is weighed is not zero, but 1: which
    /// one, y and the base. The differences, and the vertical accelerations, have all signs: no smaller ones are worse.
    fn cases(modes: &Modes) -> Vec<(usize, [f64; STATES], [Base; 2])> {
        let (still, at_rest) = ([0.0; SAMPLES + 1], [0.0; STATES]);
        let signs = |of: usize| -> Base {
            std::array::from_fn(|at| if of >> at & 1 == 0 { 1.0 } else { -1.0 })
        };
        let y = |places: &[f64; STATES]| -> [f64; STATES] {
            std::array::from_fn(|k| {
                let (half, i) = (k / 3 * 3, k % 3);
                let parts = modes.from[i].iter().zip(&places[half..]);
                parts.map(|(from, place)| from * place).sum()
            })
        };
        let mut cases = Vec::new();
        for sign in [1.0, -1.0] {
            for mode in 0..STATES {
                let mut alone = at_rest;
                alone[mode] = sign;
                cases.push((mode, y(&alone), [still; 2]));
            }
            let mut held = at_rest;
            held[..3].copy_from_slice(&modes.held.map(|held| sign * held));
            cases.push((STATES, y(&held), [[sign; SAMPLES + 1], still]));
        }
        for of in 0..1 << SAMPLES {
            let mut differences = signs(of << 1);
            differences[0] = 0.0;
            cases.push((STATES + 1, at_rest, [differences, still]));
        }
        for of in 0..1 << (SAMPLES + 1) {
            cases.push((STATES + 2, at_rest, [still, signs(of)]));
        }
        cases
    }

    /// What the bounds of a sample weigh.
    fn sizes(modes: &Modes, y: &[f64; STATES], base: &[Base; 2], sample: usize) -> [f64; WEIGHED] {
        let [a, a_end] = [base[0][sample], base[0][sample + 1]];
        let up = base[1][sample].abs().max(base[1][sample + 1].abs());
        let mut all = [0.0; WEIGHED];
        all[..STATES].copy_from_slice(&into_modes(modes, y));
        for (place, held) in all.iter_mut().zip(modes.held) {
            *place -= held * a;
        }
        (all[STATES], all[STATES + 1], all[STATES + 2]) = (a, a_end - a, up);
        all.map(f64::abs)
    }

    /// Where one thing alone is weighed in a sample, what bounds it in the stretch is no smaller than it can be, and no
    /// larger either.
    #[test]
    fn the_bound_of_one_thing_in_a_stretch_is_its_worst_case() {
        assert_eq!(soft().parts, 1);
        for body in [leaning(), soft()] {
            let sample = Sample::new(&body, &Recursion::new(&body));
            let mut worst = [[0.0_f64; WEIGHED]; WEIGHED];
            for (by, mut y, base) in cases(&sample.modes) {
                for i in 0..SAMPLES {
                    let sizes = sizes(&sample.modes, &y, &base, i);
                    for (worst, size) in worst.iter_mut().zip(sizes) {
                        worst[by] = worst[by].max(size);
                    }
                    y = after(&sample.recursion, y, &base, i);
                }
            }
            let place = sample
                .modes
                .held
                .iter()
                .fold(0.0_f64, |most, held| most.max(held.abs()));
            for (of, worst) in worst.iter().enumerate() {
                let mut alone = sample.clone();
                alone.bounds.lost = [0.0; WEIGHED];
                alone.bounds.lost[of] = 1.0;
                let bound = bounds(&alone).lost;
                for (by, (found, worst)) in bound.into_iter().zip(worst).enumerate() {
                    // Rounding of a dozen products for each sample, with places and sums of this size.
                    assert!(
                        (found - worst).abs() < 1e-13 * (place + worst),
                        "{of} by {by}: {found} {worst}"
                    );
                }
            }
        }
    }

    /// Nothing that is found at the steps of a stretch is beyond its bound.
    #[test]
    fn what_is_found_in_a_stretch_is_within_its_bound() {
        /// So far out that the compression at rest is nothing.
        const FAR: f64 = 1e15;
        for body in [leaning(), soft()] {
            let step = Recursion::new(&body);
            let sample = Sample::new(&body, &step);
            let look = Look::new(&body, step);
            let mut looking = Looking::default();
            let mut highest = [[0.0_f64; WEIGHED]; 3];
            for (by, mut y, base) in cases(&sample.modes) {
                let mut wanted = Vec::new();
                for i in 0..SAMPLES {
                    let [horizontal, vertical] =
                        base.map(|base| [FAR * base[i], FAR * base[i + 1]]);
                    wanted.push(Wanted {
                        y: y.map(|y| FAR * y),
                        horizontal,
                        vertical,
                        sample: i,
                    });
                    y = after(&sample.recursion, y, &base, i);
                }
                let mut reached = Reached {
                    counts_to: f64::INFINITY,
                    ..Reached::default()
                };
                looking.at(pulp::Arch::new(), &look, &wanted, &mut reached);
                let up = reached.peaks[0].max(reached.peaks[1]);
                for (highest, found) in highest.iter_mut().zip([reached.lost, reached.pressed, up])
                {
                    highest[by] = highest[by].max(found / FAR);
                }
            }
            let Bounds { lost, press, up } = bounds(&sample);
            for (of, (bound, highest)) in [lost, press, up].into_iter().zip(highest).enumerate() {
                for (by, (bound, highest)) in bound.into_iter().zip(highest).enumerate() {
                    // Rounding, and what the compression at rest adds.
                    assert!(
                        bound >= (1.0 - 1e-9) * highest,
                        "{of} by {by}: {bound} {highest}"
                    );
                }
            }
        }
    }
}
