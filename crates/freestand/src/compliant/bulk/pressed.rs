//! Both edges on their pads: the exact recursion in every lane, and what it says of letting go.

use pulp::{Arch, Simd, WithSimd};

use super::each::{each, six};
use super::linear::STATES;
use super::look::{Look, Looking, Reached, Wanted};
use super::reach::{AtOnce, Does, Highest, Reach};
use super::stretch::{SAMPLES, Stretch};
use super::through::{Of, Start, Through};
use super::{LANES, Lane};
use crate::vector::{Masks, Math, Numbers};

/// Worlds side by side.
///
/// They go from stretch to stretch. The samples in between are taken only of stretches in which the bounds say that
/// one of their steps may set a new extreme, and later, many stretches of a world at once; so are those steps. What they
/// find changes nothing elsewhere, so a world does not depend on its neighbours.
#[derive(Debug, Default)]
pub(super) struct Pressed {
    /// [`Stretch`].
    state: [[Lane; STATES]; STATES],
    base: [[[Lane; SAMPLES + 1]; STATES]; 2],
    reach: Reach<Lane>,
    at_once: AtOnce<Lane>,
    highest: Highest<Lane>,
    y: [Lane; STATES],
    pub(super) reached: [Reached; LANES],
    /// Stretches whose samples may be taken, and samples that are to be looked at.
    starts: [Vec<Start>; LANES],
    wanted: Vec<Wanted>,
    through: Through,
    looking: Looking,
}

impl Pressed {
    /// Puts a world into a lane, with what it has reached so far.
    pub(super) fn enter(
        &mut self,
        lane: usize,
        stretch: &Stretch,
        y: &[f64; STATES],
        of: &Of,
        at_once: &AtOnce<f64>,
        reached: Reached,
    ) {
        let columns = self.state.iter_mut().flatten();
        for (column, value) in columns.zip(stretch.state.iter().flatten()) {
            column[lane] = *value;
        }
        let columns = self.base.iter_mut().flatten().flatten();
        for (column, value) in columns.zip(stretch.base.iter().flatten().flatten()) {
            column[lane] = *value;
        }
        let reach = Reach::new(&of.sample.modes, &stretch.bounds);
        self.reach.enter(lane, &reach);
        for (column, value) in self.y.iter_mut().zip(y) {
            column[lane] = *value;
        }
        self.at_once.enter(lane, at_once);
        self.highest
            .enter(lane, &Highest::new(&reached, of.deepest_m));
        self.reached[lane] = reached;
        self.starts[lane].clear();
    }

    /// Looks at what is wanted of a world so far, in the order of time.
    pub(super) fn look(&mut self, arch: Arch, lane: usize, look: &Look, of: &Of) {
        let mut starts = std::mem::take(&mut self.starts[lane]);
        let reached = self.find(arch, lane, look, of, &starts, &Highest::default());
        starts.clear();
        self.starts[lane] = starts;
        self.reached[lane] = reached;
        let known = self.highest.of(lane);
        self.highest
            .enter(lane, &known.and(&Highest::new(&reached, of.deepest_m)));
    }

    /// The same of a world at its end. What its stretches begin with says before what it reaches, or nearly: few
    /// stretches may find more. Where an edge loses so much that not everything counts, the order of time matters, and
    /// nothing is known before.
    pub(super) fn look_at_all(&mut self, arch: Arch, lane: usize, look: &Look, of: &Of) {
        let known = self.highest.of(lane);
        let starts = std::mem::take(&mut self.starts[lane]);
        let counts_to = self.reached[lane].counts_to;
        let found = (known.lost <= counts_to)
            .then(|| self.find(arch, lane, look, of, &starts, &known))
            .filter(|reached| reached.lost <= counts_to);
        self.reached[lane] =
            found.unwrap_or_else(|| self.find(arch, lane, look, of, &starts, &Highest::default()));
        self.starts[lane] = starts;
    }

    /// What is reached in stretches in the order of time, where it is more than `known`.
    fn find(
        &mut self,
        arch: Arch,
        lane: usize,
        look: &Look,
        of: &Of,
        starts: &[Start],
        known: &Highest<f64>,
    ) -> Reached {
        let mut reached = self.reached[lane];
        self.wanted.clear();
        let highest = |reached: &Reached| Highest::new(reached, of.deepest_m).and(known);
        let mut rest = starts.iter();
        let mut now = Vec::with_capacity(LANES);
        loop {
            let most = highest(&reached);
            let more = rest.by_ref().filter(|start| most.is_below(&start.most));
            now.clear();
            now.extend(more.take(LANES));
            let is_last = now.len() < LANES;
            self.through.take(arch, of, &now, &most, &mut self.wanted);
            let count = if is_last {
                self.wanted.len()
            } else {
                self.wanted.len() / LANES * LANES
            };
            self.looking
                .at(arch, look, &self.wanted[..count], &mut reached);
            self.wanted.drain(..count);
            if is_last {
                return reached;
            }
        }
    }

    /// Takes a world out of a lane: zeros do nothing.
    pub(super) fn leave(&mut self, lane: usize) {
        let stretch = self.base.iter_mut().flatten().flatten();
        let stretch = stretch.chain(self.state.iter_mut().flatten());
        for column in stretch.chain(&mut self.y) {
            column[lane] = 0.0;
        }
        self.reach.leave(lane);
        self.at_once.leave(lane);
        self.highest.enter(lane, &Highest::default());
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

/// What the base does in a stretch.
#[inline(always)]
fn does<S: Simd>(m: Math<S>, i: usize, horizontal: &[Lane], vertical: Option<&[Lane]>) -> Does<S> {
    let zero = m.splat(0.0);
    let level = horizontal[0].get::<S>(i);
    let (mut slope, mut bend) = (zero, zero);
    let mut now = level;
    let mut change = None;
    for next in &horizontal[1..] {
        let next = next.get::<S>(i);
        let by = m.sub(next, now);
        slope = m.larger(m.abs(by), slope);
        if let Some(before) = change {
            bend = m.larger(m.abs(m.sub(by, before)), bend);
        }
        (now, change) = (next, Some(by));
    }
    let up = match vertical {
        Some(vertical) => {
            let mut up = zero;
            for v in vertical {
                up = m.larger(m.abs(v.get::<S>(i)), up);
            }
            Some(up)
        }
        None => None,
    };
    Does {
        level,
        slope,
        bend: Some(bend),
        up,
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
            let does = does::<S>(m, i, horizontal, vertical);
            let (may, most) = self.reach.may_find::<S>(m, i, y, does, &self.highest);
            if m.any(may) {
                self.start::<S>(m, i, may, y, most, ground.first.map(|lane| lane + first));
            }
            y = self.after::<S>(m, i, y, horizontal, vertical);
            self.highest.with::<S>(m, i, &self.at_once, y);
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

    /// Keeps a stretch whose samples may be taken, in the lanes of the mask; it begins with these samples.
    #[inline(always)]
    fn start<S: Simd>(
        &mut self,
        m: Math<S>,
        i: usize,
        may: Masks<S>,
        y: [Numbers<S>; STATES],
        most: [Numbers<S>; 3],
        samples: [usize; LANES],
    ) {
        let mut starts = Lane::default();
        starts.set::<S>(i, m.select(may, m.splat(1.0), m.splat(0.0)));
        let mut now = [Lane::default(); STATES];
        for (column, value) in now.iter_mut().zip(y) {
            column.set::<S>(i, value);
        }
        let mut bounds = [Lane::default(); 3];
        for (column, value) in bounds.iter_mut().zip(most) {
            column.set::<S>(i, value);
        }
        let abreast = LANES / Lane::pairs::<S>();
        for lane in i * abreast..(i + 1) * abreast {
            if starts[lane] > 0.0 {
                self.starts[lane].push(Start {
                    y: now.each_ref().map(|column| column[lane]),
                    sample: samples[lane],
                    most: bounds.each_ref().map(|column| column[lane]),
                });
            }
        }
    }
}
