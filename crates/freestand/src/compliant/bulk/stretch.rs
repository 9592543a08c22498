//! Several samples at once: where a bound says that none of their steps sets a new extreme, nobody looks at them.

use super::linear::{BEND, Bounds, LEVEL, Modes, Recursion, SLOPE, STATES, Sample, UP, WEIGHED};

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
    /// As of a sample.
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
///
/// The horizontal acceleration of the base is that at the start, a straight line by its first change, and from each
/// later sample on a further straight line by the difference of the changes there. So is what follows from it: the
/// response to a straight line from rest, which begins at each sample and is multiplied by at most the largest
/// difference. The response is counted in the modes without the place that the acceleration would hold: a mode that is
/// faster than the base hardly moves away from there.
fn bounds(sample: &Sample) -> Bounds {
    let Sample {
        recursion,
        modes,
        bounds,
    } = sample;
    let one = in_modes(modes, &recursion.state);
    let of_way =
        |rows: &[[f64; 2]; STATES], way: usize| into_modes(modes, &rows.map(|ways| ways[way]));
    let (from, to) = (of_way(&recursion.from, 0), of_way(&recursion.to, 0));
    let (mut up_from, mut up_to) = (of_way(&recursion.from, 1), of_way(&recursion.to, 1));
    let mut held = [0.0; STATES];
    held[..3].copy_from_slice(&modes.held);

    let mut state: Square = [[0.0; STATES]; STATES];
    for (k, row) in state.iter_mut().enumerate() {
        row[k] = 1.0;
    }
    let nothing: [f64; STATES] = [0.0; STATES];
    // Where a steady acceleration of 1 takes a block that it holds, and one that grows by 1 in a sample a block at
    // rest; and the sizes of the latter so far, without where it would be held.
    let (mut steady, mut line, mut bend) = (held, nothing, nothing);
    // At most so much the largest vertical acceleration does, which acts as the end of a sample and then as the start
    // of the next one, the first one as a start alone.
    let (mut up, mut up_begun) = (nothing, nothing);
    let mut all = Bounds::default();
    for place in 0..SAMPLES {
        let before = place as f64;
        let away = |y: &[f64; STATES], a: f64| -> [f64; STATES] {
            std::array::from_fn(|k| (y[k] - a * held[k]).abs())
        };
        let (steady_now, line_now) = (away(&steady, 1.0), away(&line, before));
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
            let mut now = [0.0; WEIGHED];
            for (k, now) in now.iter_mut().take(STATES).enumerate() {
                *now = sum(&state.map(|row| row[k].abs()));
            }
            now[LEVEL] = sum(&steady_now) + weights[LEVEL];
            // So far the acceleration has changed by at most so many of the largest change.
            now[SLOPE] = sum(&line_now) + before * weights[LEVEL] + weights[SLOPE];
            now[BEND] = sum(&bend);
            now[UP] = sum(&up_now) + weights[UP];
            for (most, now) in most.iter_mut().zip(now) {
                *most = most.max(now);
            }
        }
        for k in 0..STATES {
            bend[k] += line_now[k];
            up[k] += (up_begun[k] + up_to[k]).abs();
        }
        let goes_on = |y: &[f64; STATES], a: f64, a_end: f64| -> [f64; STATES] {
            let moved = times(&one, y);
            std::array::from_fn(|k| moved[k] + a * from[k] + a_end * to[k])
        };
        steady = goes_on(&steady, 1.0, 1.0);
        line = goes_on(&line, before, before + 1.0);
        up_begun = up_from;
        state = product(&one, &state);
        (up_from, up_to) = (times(&one, &up_from), times(&one, &up_to));
    }
    for weights in [&mut all.lost, &mut all.press, &mut all.up] {
        // Differences are rounded where their accelerations are.
        weights[SLOPE] += DIFFERENCE * weights[BEND];
        weights[LEVEL] += DIFFERENCE * (weights[SLOPE] + weights[BEND]);
    }
    all
}

/// What rounding may do to the difference of two differences of accelerations, as a share of these and of their
/// changes over a stretch: a hundred times what it does.
const DIFFERENCE: f64 = 1e-12;

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

    /// A start of a stretch, and what its base does each way.
    struct Case {
        y: [f64; STATES],
        base: [Base; 2],
    }

    impl Case {
        /// What the bounds weigh of it.
        fn sizes(&self, modes: &Modes) -> [f64; WEIGHED] {
            let [horizontal, vertical] = &self.base;
            let largest = |values: &[f64]| values.iter().fold(0.0_f64, |most, a| most.max(a.abs()));
            let changes: Vec<f64> = horizontal.windows(2).map(|a| a[1] - a[0]).collect();
            let bends: Vec<f64> = changes.windows(2).map(|a| a[1] - a[0]).collect();
            let mut all = [0.0; WEIGHED];
            all[..STATES].copy_from_slice(&into_modes(modes, &self.y));
            for (place, held) in all.iter_mut().zip(modes.held) {
                *place -= held * horizontal[0];
            }
            all[LEVEL] = horizontal[0];
            (all[SLOPE], all[BEND]) = (largest(&changes), largest(&bends));
            all[UP] = largest(vertical);
            all.map(f64::abs)
        }

        /// The same of one of its samples, which has no two changes.
        fn sizes_in(&self, modes: &Modes, y: [f64; STATES], sample: usize) -> [f64; WEIGHED] {
            let base = self.base.each_ref().map(|base| {
                let mut ends = [base[sample + 1]; SAMPLES + 1];
                ends[0] = base[sample];
                ends
            });
            let mut all = Self { y, base }.sizes(modes);
            all[BEND] = 0.0;
            all
        }
    }

    /// Those in which one thing that is weighed is 1, and all others are as small as they then can be. Differences of
    /// changes, and vertical accelerations, have all signs: no smaller ones are worse.
    fn cases(modes: &Modes) -> Vec<(usize, Case)> {
        let (still, at_rest) = ([0.0; SAMPLES + 1], [0.0; STATES]);
        let sign = |of: usize, at: usize| if of >> at & 1 == 0 { 1.0 } else { -1.0 };
        let y = |places: &[f64; STATES]| -> [f64; STATES] {
            std::array::from_fn(|k| {
                let (half, i) = (k / 3 * 3, k % 3);
                let parts = modes.from[i].iter().zip(&places[half..]);
                parts.map(|(from, place)| from * place).sum()
            })
        };
        let mut cases = Vec::new();
        let mut add = |by: usize, y: [f64; STATES], base: [Base; 2]| {
            cases.push((by, Case { y, base }));
        };
        for sign in [1.0, -1.0] {
            for mode in 0..STATES {
                let mut alone = at_rest;
                alone[mode] = sign;
                add(mode, y(&alone), [still; 2]);
            }
            let mut held = at_rest;
            held[..3].copy_from_slice(&modes.held.map(|held| sign * held));
            add(LEVEL, y(&held), [[sign; SAMPLES + 1], still]);
            let line = std::array::from_fn(|at| sign * at as f64);
            add(SLOPE, at_rest, [line, still]);
        }
        for of in 0..1 << (SAMPLES - 1) {
            let (mut a, mut change) = (still, 0.0);
            for at in 1..SAMPLES {
                change += sign(of, at - 1);
                a[at + 1] = a[at] + change;
            }
            add(BEND, at_rest, [a, still]);
        }
        for of in 0..1 << (SAMPLES + 1) {
            let vertical = std::array::from_fn(|at| sign(of, at));
            add(UP, at_rest, [still, vertical]);
        }
        cases
    }

    fn bound(weights: &[f64; WEIGHED], sizes: &[f64; WEIGHED]) -> f64 {
        weights
            .iter()
            .zip(sizes)
            .map(|(weight, size)| weight * size)
            .sum()
    }

    /// Where one thing alone is weighed in a sample, what bounds it in the stretch is no smaller than it can be, and no
    /// larger either: of the places and rates of the modes by each thing, and of what the base does by the same.
    #[test]
    fn the_bound_of_one_thing_in_a_stretch_is_its_worst_case() {
        assert_eq!(soft().parts, 1);
        for body in [leaning(), soft()] {
            let sample = Sample::new(&body, &Recursion::new(&body));
            let mut worst = [[0.0_f64; WEIGHED]; WEIGHED];
            let cases = cases(&sample.modes);
            for (by, case) in &cases {
                let mut y = case.y;
                for i in 0..SAMPLES {
                    let sizes = case.sizes_in(&sample.modes, y, i);
                    for (worst, size) in worst.iter_mut().zip(sizes) {
                        worst[*by] = worst[*by].max(size);
                    }
                    y = after(&sample.recursion, y, &case.base, i);
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
                let weights = bounds(&alone).lost;
                for (by, worst) in worst.iter().enumerate() {
                    // A level and a change that follow from differences of changes are weighed as what they are.
                    if of >= STATES && by != of && (by, of) != (SLOPE, LEVEL) {
                        continue;
                    }
                    let found = weights[by];
                    // What is added for rounding, and rounding of a dozen products for each sample, with places and sums
                    // of this size.
                    let rounding = DIFFERENCE * weights.iter().sum::<f64>();
                    assert!(
                        (found - worst).abs() < rounding + 1e-13 * (place + worst),
                        "{of} by {by}: {found} {worst}"
                    );
                }
            }
            // Together they bound every size.
            for (_, case) in &cases {
                let (all, mut y) = (case.sizes(&sample.modes), case.y);
                for i in 0..SAMPLES {
                    let sizes = case.sizes_in(&sample.modes, y, i);
                    for (of, size) in sizes.into_iter().enumerate() {
                        let mut alone = sample.clone();
                        alone.bounds.lost = [0.0; WEIGHED];
                        alone.bounds.lost[of] = 1.0;
                        let most = bound(&bounds(&alone).lost, &all);
                        // As above.
                        assert!(size <= most + 1e-13 * (place + most), "{of}: {size} {most}");
                    }
                    y = after(&sample.recursion, y, &case.base, i);
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
            let Bounds { lost, press, up } = bounds(&sample);
            let mut looking = Looking::default();
            let mut closest = [[0.0_f64; WEIGHED]; 3];
            for (by, case) in cases(&sample.modes) {
                let (mut y, mut wanted) = (case.y, Vec::new());
                for i in 0..SAMPLES {
                    let [horizontal, vertical] =
                        case.base.map(|base| [FAR * base[i], FAR * base[i + 1]]);
                    wanted.push(Wanted {
                        y: y.map(|y| FAR * y),
                        horizontal,
                        vertical,
                        sample: i,
                    });
                    y = after(&sample.recursion, y, &case.base, i);
                }
                let mut reached = Reached {
                    counts_to: f64::INFINITY,
                    ..Reached::default()
                };
                looking.at(pulp::Arch::new(), &look, &wanted, &mut reached);
                let highest = reached.peaks[0].max(reached.peaks[1]);
                let found = [reached.lost, reached.pressed, highest];
                let sizes = case.sizes(&sample.modes);
                for (of, (weights, found)) in [lost, press, up].iter().zip(found).enumerate() {
                    let (most, found) = (bound(weights, &sizes), found / FAR);
                    // Rounding, and what the compression at rest adds.
                    assert!(most >= (1.0 - 1e-9) * found, "{of} by {by}: {most} {found}");
                    if most > 0.0 {
                        closest[of][by] = closest[of][by].max(found / most);
                    }
                }
            }
            // None is so far away that it could be anything: the loosest sums up all that differences of changes do.
            let by_states = closest.iter().flat_map(|closest| &closest[..STATES]);
            assert!(by_states.copied().fold(0.0, f64::max) > 0.9, "{closest:?}");
        }
    }
}
