//! Blocks at rest, until the base lifts them.

use super::{Lift, Tile};
use crate::rocking::lanes::ranks::{Moving, NONE, SIDES};
use crate::rocking::lanes::record::State;
use crate::rocking::lanes::rocker::{EdgeTerms, Rocker};
use crate::rocking::lanes::shaking::Interval;

impl Tile<'_> {
    /// The step at a ratio of the interval, and the part of that step that has passed.
    pub(super) fn part_of(&self, ratio: f64) -> (usize, f64) {
        let place = ratio * self.parts as f64;
        let part = (place as usize).min(self.parts - 1);
        (part, (place - part as f64).clamp(0.0, 1.0))
    }

    /// Starts a block that the base lifts from rest, or takes off a wall, and returns its lane.
    pub(super) fn start(&mut self, block: u32, edge: usize, tau: f64) -> usize {
        let record = &mut self.records[block as usize];
        let leans = matches!(record.state, State::Leaning { .. });
        record.state = State::Moving;
        let best = record.sides[edge].height;
        let rocker = &self.rockers[block as usize];
        let y = if leans {
            rocker.edges[edge].ceiling
        } else {
            0.0
        };
        let lane = self.moving.enter();
        self.moving.set(
            lane,
            Moving {
                block,
                edge,
                y,
                w: 0.0,
                best,
                tau,
            },
            rocker,
        );
        lane
    }

    /// Adds a block at rest to the list of the interval that ends at the first sample, from index
    /// `from`, that lifts it; a block that leans, that takes it off the wall.
    pub(super) fn wait(&mut self, block: u32, from: usize) {
        let edges = &self.rockers[block as usize].edges;
        let first = match self.records[block as usize].state {
            State::Leaning { edge, .. } => {
                let edge = usize::from(edge);
                let EdgeTerms { alpha, ceiling, .. } = edges[edge];
                self.shaking
                    .first_release(edge, (ceiling - alpha).tan(), from)
            }
            _ => self
                .shaking
                .first_lift(edges.map(|edge| edge.threshold), from),
        };
        if let Some(sample) = first {
            let interval = sample.saturating_sub(1);
            self.lifted_next[block as usize] =
                std::mem::replace(&mut self.lifted_in[interval], block);
        }
    }

    /// Moves the blocks that are lifted in an interval from its list to the pending lifts.
    pub(super) fn lift_waiting(&mut self, interval: usize, whole: &Interval) {
        let mut block = std::mem::replace(&mut self.lifted_in[interval], NONE);
        while block != NONE {
            let next = self.lifted_next[block as usize];
            match self.lift(block, whole, 0.0) {
                Some((edge, ratio)) => {
                    let (part, tau) = self.part_of(ratio);
                    self.pending.push(Lift {
                        part,
                        block,
                        edge,
                        tau,
                    });
                }
                // `first_lift` compares a quotient, `margin` a product: they may round to different
                // sides of the threshold.
                None => self.wait(block, interval + 2),
            }
            block = next;
        }
    }

    /// The edge about which the base lifts a block at rest or takes it off the wall, and the ratio of the interval at which
    /// it does, not before the ratio `from`.
    pub(super) fn lift(&self, block: u32, whole: &Interval, from: f64) -> Option<(usize, f64)> {
        let ((u, v), (u_end, v_end)) = (whole.at(from), whole.at(1.0));
        if let State::Leaning { edge, .. } = self.records[block as usize].state {
            let edge = usize::from(edge);
            let [by_v, by_u] = self.walls[block as usize].press[edge];
            let (now, end) = (by_v * v + by_u * u, by_v * v_end + by_u * u_end);
            let at = if now < 0.0 {
                from
            } else if end < 0.0 {
                from + (1.0 - from) * now / (now - end)
            } else {
                return None;
            };
            return (at < 1.0).then_some((edge, at));
        }
        let rocker = &self.rockers[block as usize];
        let mut first: Option<(usize, f64)> = None;
        for edge in 0..2 {
            let (now, end) = (
                margin(rocker, edge, u, v),
                margin(rocker, edge, u_end, v_end),
            );
            let at = if now < 0.0 {
                from
            } else if end < 0.0 {
                from + (1.0 - from) * now / (now - end)
            } else {
                continue;
            };
            if at < 1.0 && first.is_none_or(|(_, earliest)| at < earliest) {
                first = Some((edge, at));
            }
        }
        first
    }
}

/// How far the base is from lifting a block about an edge: (1+ü_v/g) tan α + s ü_h/g, negative when
/// it lifts.
pub(super) fn margin(rocker: &Rocker, edge: usize, u: f64, v: f64) -> f64 {
    v * rocker.edges[edge].threshold + SIDES[edge] * u
}
