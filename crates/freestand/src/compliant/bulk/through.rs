//! The samples of stretches that may set a new extreme: many stretches of one world side by side.

use pulp::{Arch, Simd, WithSimd};

use super::each::{each, six};
use super::linear::{Recursion, STATES, Sample};
use super::look::Wanted;
use super::reach::{Does, Highest, Reach};
use super::stretch::SAMPLES;
use super::{LANES, Lane};
use crate::vector::Math;

/// A stretch whose samples may be taken: y at its start, its first sample in the motion, and its bounds.
#[derive(Debug, Clone, Copy)]
pub(super) struct Start {
    pub(super) y: [f64; STATES],
    pub(super) sample: usize,
    pub(super) most: [f64; 3],
}

/// Stretches side by side.
#[derive(Debug, Default)]
pub(super) struct Through {
    /// y at the start of each sample.
    y: [[Lane; STATES]; SAMPLES],
    /// The base acceleration at the samples, each way.
    base: [[Lane; SAMPLES + 1]; 2],
    /// 1 where a sample is to be looked at.
    wants: [Lane; SAMPLES],
}

impl Through {
    /// Adds the samples of stretches of a world that may find more than is known. The stretches are in the order of their
    /// time, and so are the samples.
    pub(super) fn take(
        &mut self,
        arch: Arch,
        of: &Of,
        starts: &[Start],
        highest: &Highest<f64>,
        wanted: &mut Vec<Wanted>,
    ) {
        let reach = Reach::new(&of.sample.modes, &of.sample.bounds);
        for starts in starts.chunks(LANES) {
            for (lane, start) in starts.iter().enumerate() {
                self.enter(lane, start, of);
            }
            arch.dispatch(All {
                through: self,
                recursion: &of.sample.recursion,
                reach: &reach,
                highest,
                count: starts.len(),
                is_vertical: !of.base[1].is_empty(),
            });
            for (lane, start) in starts.iter().enumerate() {
                let wants = (0..SAMPLES).filter(|&i| self.wants[i][lane] > 0.0);
                wanted.extend(wants.map(|i| self.wanted(lane, start, i)));
            }
        }
    }

    fn enter(&mut self, lane: usize, start: &Start, of: &Of) {
        for (column, value) in self.y[0].iter_mut().zip(start.y) {
            column[lane] = value;
        }
        for (columns, samples) in self.base.iter_mut().zip(of.base) {
            let samples = samples.get(start.sample..).unwrap_or_default();
            let (moved, still) = columns.split_at_mut(samples.len().min(SAMPLES + 1));
            for (column, sample) in moved.iter_mut().zip(samples) {
                column[lane] = *sample;
            }
            still.iter_mut().for_each(|column| column[lane] = 0.0);
        }
    }

    fn wanted(&self, lane: usize, start: &Start, i: usize) -> Wanted {
        let [horizontal, vertical] = self
            .base
            .each_ref()
            .map(|columns| [columns[i][lane], columns[i + 1][lane]]);
        Wanted {
            y: self.y[i].each_ref().map(|column| column[lane]),
            horizontal,
            vertical,
            sample: start.sample + i,
        }
    }
}

/// The world that stretches are of: what it is, and what moves it, each way.
#[derive(Debug, Clone, Copy)]
pub(super) struct Of<'a> {
    pub(super) sample: &'a Sample,
    /// The larger compression of both edges at rest.
    pub(super) deepest_m: f64,
    pub(super) base: [&'a [f64]; 2],
}

struct All<'a> {
    through: &'a mut Through,
    recursion: &'a Recursion,
    reach: &'a Reach<f64>,
    highest: &'a Highest<f64>,
    count: usize,
    is_vertical: bool,
}

impl WithSimd for All<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let m = Math(simd);
        let Through { y, base, wants } = self.through;
        let [horizontal, vertical] = base;
        let abreast = LANES / Lane::pairs::<S>();
        for i in 0..self.count.div_ceil(abreast) {
            let mut now = six!(k, y[0][k].get::<S>(i));
            for sample in 0..SAMPLES {
                let a = [
                    horizontal[sample].get::<S>(i),
                    horizontal[sample + 1].get::<S>(i),
                ];
                let v = [
                    vertical[sample].get::<S>(i),
                    vertical[sample + 1].get::<S>(i),
                ];
                let does = Does {
                    level: a[0],
                    slope: m.abs(m.sub(a[1], a[0])),
                    bend: None,
                    up: match self.is_vertical {
                        true => Some(m.larger(m.abs(v[0]), m.abs(v[1]))),
                        false => None,
                    },
                };
                let (may, _) = self.reach.may_find::<S>(m, i, now, does, self.highest);
                wants[sample].set::<S>(i, m.select(may, m.splat(1.0), m.splat(0.0)));
                for (column, value) in y[sample].iter_mut().zip(now) {
                    column.set::<S>(i, value);
                }
                now = self.recursion.after::<S>(m, now, a, v);
            }
        }
    }
}
