//! Both edges on their pads: the exact recursion in every lane, and what it says of letting go.

use pulp::{Arch, Simd, WithSimd};

use super::each::{each, six};
use super::linear::{Bounds, Recursion, STATES, Sample, WEIGHED};
use super::look::{Look, Looking, Reached, Wanted};
use super::stretch::{SAMPLES, Stretch};
use super::{LANES, Lane};
use crate::vector::{Masks, Math, Numbers};

/// Worlds side by side.
///
/// They go from stretch to stretch. The samples in between are taken only where the bounds say that one of their steps
/// may set a new extreme, and are looked at later, many of a world at once: what they find changes nothing elsewhere, so
/// a world does not depend on its neighbours.
#[derive(Debug, Default)]
pub(super) struct Pressed {
    /// [`Stretch`].
    state: [[Lane; STATES]; STATES],
    base: [[[Lane; SAMPLES + 1]; STATES]; 2],
    sample: Steps,
    /// Of a stretch and of a sample.
    bounds_of_stretch: Weights,
    bounds: Weights,
    /// [`Modes`](super::linear::Modes).
    into: [[Lane; 3]; 3],
    held: [Lane; 3],
    /// The larger compression of both edges at rest.
    deepest: Lane,
    y: [Lane; STATES],
    /// [`Reached`], as far as samples were looked at: the acceleration is the smaller one of both edges.
    most_lost: Lane,
    most_pressed: Lane,
    peak: Lane,
    counts_to: Lane,
    pub(super) reached: [Reached; LANES],
    /// Samples that are to be looked at.
    wanted: [Vec<Wanted>; LANES],
    looking: Looking,
}

/// [`Bounds`] in every lane.
type Weights = [[Lane; WEIGHED]; 3];

/// [`Recursion`] in every lane.
#[derive(Debug, Default)]
struct Steps {
    state: [[Lane; STATES]; STATES],
    from: [[Lane; 2]; STATES],
    to: [[Lane; 2]; STATES],
}

impl Steps {
    fn enter(&mut self, lane: usize, recursion: &Recursion) {
        for (columns, row) in self.state.iter_mut().zip(&recursion.state) {
            for (column, value) in columns.iter_mut().zip(row) {
                column[lane] = *value;
            }
        }
        let ways = [
            (&mut self.from, &recursion.from),
            (&mut self.to, &recursion.to),
        ];
        for (columns, rows) in ways {
            for (column, value) in columns.iter_mut().flatten().zip(rows.iter().flatten()) {
                column[lane] = *value;
            }
        }
    }

    fn leave(&mut self, lane: usize) {
        let columns = self.state.iter_mut().flatten();
        let ways = self.from.iter_mut().chain(&mut self.to).flatten();
        columns.chain(ways).for_each(|column| column[lane] = 0.0);
    }

    /// y after it, while the base acceleration goes from the first to the second of each way.
    #[inline(always)]
    fn after<S: Simd>(
        &self,
        m: Math<S>,
        i: usize,
        y: [Numbers<S>; STATES],
        [a, a_end]: [Numbers<S>; 2],
        vertical: Option<[Numbers<S>; 2]>,
    ) -> [Numbers<S>; STATES] {
        six!(k, {
            let row = &self.state[k];
            let mut one = m.mul(self.from[k][0].get::<S>(i), a);
            let mut two = m.mul(self.to[k][0].get::<S>(i), a_end);
            if let Some([v, v_end]) = vertical {
                one = m.fma(self.from[k][1].get::<S>(i), v, one);
                two = m.fma(self.to[k][1].get::<S>(i), v_end, two);
            }
            one = m.fma(row[0].get::<S>(i), y[0], one);
            two = m.fma(row[1].get::<S>(i), y[1], two);
            one = m.fma(row[2].get::<S>(i), y[2], one);
            two = m.fma(row[3].get::<S>(i), y[3], two);
            one = m.fma(row[4].get::<S>(i), y[4], one);
            two = m.fma(row[5].get::<S>(i), y[5], two);
            m.add(one, two)
        })
    }
}

impl Pressed {
    /// Puts a world into a lane, with what it has reached so far.
    pub(super) fn enter(
        &mut self,
        lane: usize,
        sample: &Sample,
        stretch: &Stretch,
        y: &[f64; STATES],
        deepest_m: f64,
        reached: Reached,
    ) {
        self.sample.enter(lane, &sample.recursion);
        let columns = self.state.iter_mut().flatten();
        for (column, value) in columns.zip(stretch.state.iter().flatten()) {
            column[lane] = *value;
        }
        let columns = self.base.iter_mut().flatten().flatten();
        for (column, value) in columns.zip(stretch.base.iter().flatten().flatten()) {
            column[lane] = *value;
        }
        for (all, Bounds { lost, press, up }) in [
            (&mut self.bounds_of_stretch, &stretch.bounds),
            (&mut self.bounds, &sample.bounds),
        ] {
            for (columns, weights) in all.iter_mut().zip([lost, press, up]) {
                for (column, weight) in columns.iter_mut().zip(weights) {
                    column[lane] = *weight;
                }
            }
        }
        for (columns, row) in self.into.iter_mut().zip(&sample.modes.into) {
            for (column, value) in columns.iter_mut().zip(row) {
                column[lane] = *value;
            }
        }
        let pairs = self.y.iter_mut().zip(y);
        for (column, value) in pairs.chain(self.held.iter_mut().zip(&sample.modes.held)) {
            column[lane] = *value;
        }
        self.deepest[lane] = deepest_m;
        self.counts_to[lane] = reached.counts_to;
        self.reached[lane] = reached;
        self.wanted[lane].clear();
        self.compare_with_reached(lane);
    }

    fn compare_with_reached(&mut self, lane: usize) {
        let reached = &self.reached[lane];
        self.most_lost[lane] = reached.lost;
        self.most_pressed[lane] = reached.pressed;
        self.peak[lane] = reached.peaks[0].min(reached.peaks[1]);
    }

    /// Looks at what is wanted of a world; with `now`, also where that does not fill the lanes.
    pub(super) fn look(&mut self, arch: Arch, lane: usize, look: &Look, now: bool) {
        let wanted = &mut self.wanted[lane];
        let count = if now {
            wanted.len()
        } else {
            wanted.len() / LANES * LANES
        };
        if count > 0 {
            let reached = &mut self.reached[lane];
            self.looking.at(arch, look, &wanted[..count], reached);
            wanted.drain(..count);
            self.compare_with_reached(lane);
        }
    }

    /// Takes a world out of a lane: zeros do nothing.
    pub(super) fn leave(&mut self, lane: usize) {
        self.sample.leave(lane);
        let stretch = self.base.iter_mut().flatten().flatten();
        let stretch = stretch.chain(self.state.iter_mut().flatten());
        let bounds = self.bounds_of_stretch.iter_mut().chain(&mut self.bounds);
        let bounds = bounds.flatten().chain(stretch);
        let held = self.held.iter_mut().chain(&mut self.y);
        for column in bounds.chain(held) {
            column[lane] = 0.0;
        }
        self.deepest[lane] = 0.0;
    }
}

/// The base acceleration of every lane at each sample of a block of whole stretches.
#[derive(Debug, Default)]
pub(super) struct Ground {
    pub(super) horizontal: Vec<Lane>,
    /// Empty where no lane moves vertically.
    pub(super) vertical: Vec<Lane>,
    /// The place of the first sample in the motion of every lane.
    pub(super) first: [usize; LANES],
}

/// Follows all lanes through a block of samples.
pub(super) fn follow(arch: Arch, pressed: &mut Pressed, ground: &Ground) {
    arch.dispatch(Follow { pressed, ground });
}

struct Follow<'a> {
    pressed: &'a mut Pressed,
    ground: &'a Ground,
}

impl WithSimd for Follow<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let m = Math(simd);
        for i in 0..Lane::pairs::<S>() {
            self.pressed.pass(m, i, self.ground);
        }
    }
}

impl Pressed {
    #[inline(always)]
    fn pass<S: Simd>(&mut self, m: Math<S>, i: usize, ground: &Ground) {
        let mut y = six!(k, self.y[k].get::<S>(i));
        let stretches = ground.horizontal.windows(SAMPLES + 1).step_by(SAMPLES);
        for (stretch, horizontal) in stretches.enumerate() {
            let first = stretch * SAMPLES;
            let vertical = ground.vertical.get(first..=first + SAMPLES);
            let a = horizontal[0].get::<S>(i);
            let mut change = m.splat(0.0);
            for later in &horizontal[1..] {
                change = m.larger(m.abs(m.sub(later.get::<S>(i), a)), change);
            }
            let up = match vertical {
                Some(vertical) => {
                    let mut up = m.splat(0.0);
                    for v in vertical {
                        up = m.larger(m.abs(v.get::<S>(i)), up);
                    }
                    Some(up)
                }
                None => None,
            };
            let may = self.may_find::<S>(m, i, &self.bounds_of_stretch, y, [a, change], up);
            if m.any(may) {
                self.look_through::<S>(m, i, y, ground, first);
            }
            y = self.after::<S>(m, i, y, horizontal, vertical);
        }
        for (column, value) in self.y.iter_mut().zip(y) {
            column.set::<S>(i, value);
        }
    }

    /// y at the end of a stretch.
    #[inline(always)]
    fn after<S: Simd>(
        &self,
        m: Math<S>,
        i: usize,
        y: [Numbers<S>; STATES],
        horizontal: &[Lane],
        vertical: Option<&[Lane]>,
    ) -> [Numbers<S>; STATES] {
        let mut sums = six!(k, {
            let row = &self.state[k];
            let mut one = m.mul(row[0].get::<S>(i), y[0]);
            let mut two = m.mul(row[1].get::<S>(i), y[1]);
            one = m.fma(row[2].get::<S>(i), y[2], one);
            two = m.fma(row[3].get::<S>(i), y[3], two);
            one = m.fma(row[4].get::<S>(i), y[4], one);
            two = m.fma(row[5].get::<S>(i), y[5], two);
            m.add(one, two)
        });
        for (at, a) in horizontal.iter().enumerate() {
            let a = a.get::<S>(i);
            sums = six!(k, m.fma(self.base[0][k][at].get::<S>(i), a, sums[k]));
        }
        for (at, v) in vertical.unwrap_or_default().iter().enumerate() {
            let v = v.get::<S>(i);
            sums = six!(k, m.fma(self.base[1][k][at].get::<S>(i), v, sums[k]));
        }
        sums
    }

    /// The samples of a stretch that begins so many after the start of the block.
    #[inline(always)]
    fn look_through<S: Simd>(
        &mut self,
        m: Math<S>,
        i: usize,
        mut y: [Numbers<S>; STATES],
        ground: &Ground,
        first: usize,
    ) {
        for sample in first..first + SAMPLES {
            let from = &ground.horizontal[sample];
            let a = [from.get::<S>(i), ground.horizontal[sample + 1].get::<S>(i)];
            let vertical = match ground.vertical.get(sample..) {
                Some([from, to, ..]) => Some([from.get::<S>(i), to.get::<S>(i)]),
                _ => None,
            };
            let change = m.abs(m.sub(a[1], a[0]));
            let v = vertical.unwrap_or([m.splat(0.0); 2]);
            let up = m.larger(m.abs(v[0]), m.abs(v[1]));
            let up = vertical.is_some().then_some(up);
            let may = self.may_find::<S>(m, i, &self.bounds, y, [a[0], change], up);
            if m.any(may) {
                self.want::<S>(m, i, may, y, ground, sample);
            }
            y = self.sample.after::<S>(m, i, y, a, vertical);
        }
    }

    /// Keeps a sample to be looked at, in the lanes of the mask.
    #[inline(always)]
    fn want<S: Simd>(
        &mut self,
        m: Math<S>,
        i: usize,
        may: Masks<S>,
        y: [Numbers<S>; STATES],
        ground: &Ground,
        sample: usize,
    ) {
        let mut wants = Lane::default();
        wants.set::<S>(i, m.select(may, m.splat(1.0), m.splat(0.0)));
        let mut now = [Lane::default(); STATES];
        for (column, value) in now.iter_mut().zip(y) {
            column.set::<S>(i, value);
        }
        let abreast = LANES / Lane::pairs::<S>();
        for lane in i * abreast..(i + 1) * abreast {
            if wants[lane] > 0.0 {
                let ends = |columns: &[Lane]| match columns.get(sample..) {
                    Some([from, to, ..]) => [from[lane], to[lane]],
                    _ => [0.0; 2],
                };
                self.wanted[lane].push(Wanted {
                    y: now.each_ref().map(|column| column[lane]),
                    horizontal: ends(&ground.horizontal),
                    vertical: ends(&ground.vertical),
                    sample: ground.first[lane] + sample,
                });
            }
        }
    }

    /// Whether a step within a sample or a stretch could find more than was found before, with the
    /// horizontal acceleration at its start and the largest change, and the largest vertical one.
    #[inline(always)]
    fn may_find<S: Simd>(
        &self,
        m: Math<S>,
        i: usize,
        bounds: &Weights,
        y: [Numbers<S>; STATES],
        [a, change]: [Numbers<S>; 2],
        up: Option<Numbers<S>>,
    ) -> Masks<S> {
        let zero = m.splat(0.0);
        let places = each!(
            mode,
            {
                let into = &self.into[mode];
                let held = m.mul(self.held[mode].get::<S>(i), a);
                let place = m.fma(into[0].get::<S>(i), y[0], m.sub(zero, held));
                let place = m.fma(into[1].get::<S>(i), y[1], place);
                m.abs(m.fma(into[2].get::<S>(i), y[2], place))
            },
            0 1 2
        );
        let rates = each!(
            mode,
            {
                let into = &self.into[mode];
                let rate = m.mul(into[0].get::<S>(i), y[3]);
                let rate = m.fma(into[1].get::<S>(i), y[4], rate);
                m.abs(m.fma(into[2].get::<S>(i), y[5], rate))
            },
            0 1 2
        );
        let level = m.abs(a);
        let most = each!(
            of,
            {
                let weights = &bounds[of];
                let mut one = m.mul(weights[STATES].get::<S>(i), level);
                let mut two = m.mul(weights[STATES + 1].get::<S>(i), change);
                if let Some(up) = up {
                    one = m.fma(weights[STATES + 2].get::<S>(i), up, one);
                }
                one = m.fma(weights[0].get::<S>(i), places[0], one);
                two = m.fma(weights[1].get::<S>(i), places[1], two);
                one = m.fma(weights[2].get::<S>(i), places[2], one);
                two = m.fma(weights[3].get::<S>(i), rates[0], two);
                one = m.fma(weights[4].get::<S>(i), rates[1], one);
                two = m.fma(weights[5].get::<S>(i), rates[2], two);
                m.add(one, two)
            },
            0 1 2
        );
        let lost = self.most_lost.get::<S>(i);
        let pressed = m.add(self.deepest.get::<S>(i), most[1]);
        let pressed = m.ge(self.most_pressed.get::<S>(i), pressed);
        let up = m.ge(self.peak.get::<S>(i), most[2]);
        // What follows from pads that pull does not count.
        let rest = m.or(m.gt(lost, self.counts_to.get::<S>(i)), m.and(pressed, up));
        // Numbers that are none are looked at.
        m.not(m.and(m.ge(lost, most[0]), rest))
    }
}
