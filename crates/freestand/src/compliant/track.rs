//! The quantities that a history reports, collected step by step.

use super::equation::{Body, Foot, Grip, LEN, Line, OMEGA, STRETCH, State, THETA, Turn};
use super::step::Step;
use super::{CompliantRocking, EdgeSide, PointPeaks, Swing, Touch};
use crate::block::{Block, Pivot};
use crate::search::bisect;

/// The ends of a step reach at least this share of a maximum inside it: steps are short compared with a visible vibration
/// on the cushions, by their longest length in the plane and by error control in space.
pub(crate) const HEADROOM: f64 = 0.7;
/// Contacts that carry less than this share of the weight are ignored for friction.
const CARRYING_RATIO: f64 = 0.1;

/// A step with everything needed to evaluate it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Seen<'a, 'b> {
    pub(super) body: &'a Body<'b>,
    pub(super) grips: &'a [Grip],
    pub(super) line: &'a Line,
    pub(super) step: &'a Step<LEN>,
    /// The turns of its start and of its end.
    pub(super) ends: [Turn; 2],
}

impl Seen<'_, '_> {
    pub(super) fn time_s(&self, share: f64) -> f64 {
        self.step.start_s + share * self.step.length_s
    }

    /// Reads the state at a share of the step.
    pub(super) fn with_state<T>(&self, share: f64, read: impl Fn(&State, &Turn) -> T) -> T {
        if share == 0.0 {
            return read(&self.step.start, &self.ends[0]);
        }
        if share == 1.0 {
            return read(&self.step.end, &self.ends[1]);
        }
        let y = self.step.state(share);
        read(&y, &Turn::of(&y))
    }

    fn foot(&self, contact: usize, share: f64) -> Foot {
        self.with_state(share, |y, turn| self.body.foot_turned(contact, y, turn))
    }

    /// Acceleration of a point of the block in the inertial frame: (horizontal, vertical).
    pub(super) fn acceleration(&self, right: f64, up: f64, share: f64) -> (f64, f64) {
        let [right_m_s2, up_m_s2] = self.line.at(self.time_s(share));
        let (horizontal, vertical) = self.with_state(share, |y, turn| {
            let of = |rates: &State| self.body.acceleration_of((right, up), y, rates, turn);
            match share {
                0.0 => of(self.step.start_rates()),
                1.0 => of(self.step.end_rates()),
                _ => of(&self
                    .body
                    .rates(self.grips, self.line, self.time_s(share), y)),
            }
        });
        (horizontal + right_m_s2, vertical + up_m_s2)
    }

    /// The share of the step at which a value of its shares that is positive at its start falls through
    /// zero.
    fn falls(&self, value: impl Fn(f64) -> f64) -> Option<f64> {
        let falling = value(0.0) > 0.0 && value(1.0) <= 0.0;
        falling.then(|| bisect(0.0, 1.0, |share| value(share) <= 0.0))
    }

    /// A value of the state at a share of the step.
    fn value(&self, share: f64, of: impl Fn(&State) -> f64) -> f64 {
        match share {
            0.0 => of(&self.step.start),
            1.0 => of(&self.step.end),
            _ => of(&self.step.state(share)),
        }
    }
}

/// Raises `best` to the largest value over a step, if that may be larger; `value` is that at a share
/// of the step.
pub(crate) fn raise(best: &mut f64, value: impl Fn(f64) -> f64) {
    let ends = value(0.0).max(value(1.0));
    if ends < HEADROOM * *best {
        return;
    }
    *best = best.max(ends);
    let inner: [f64; 5] = [0.0, 0.25, 0.5, 0.75, 1.0].map(&value);
    let highest = (1..4)
        .max_by(|&a, &b| inner[a].total_cmp(&inner[b]))
        .unwrap_or(2);
    let (mut place, mut reach) = (0.25 * highest as f64, 0.25);
    let (mut before, mut middle, mut after) =
        (inner[highest - 1], inner[highest], inner[highest + 1]);
    // Two parabolas: the second one is a tenth as wide, so its top is accurate to 1e-4 of the
    // error of the first one.
    for _ in 0..2 {
        let bend = before - 2.0 * middle + after;
        if bend < 0.0 {
            place =
                (place + 0.5 * reach * ((before - after) / bend).clamp(-2.0, 2.0)).clamp(0.0, 1.0);
        }
        reach = (0.1 * reach)
            .min(0.5 * place.max(1e-3))
            .min(0.5 * (1.0 - place).max(1e-3));
        (before, middle, after) = (
            value((place - reach).max(0.0)),
            value(place),
            value((place + reach).min(1.0)),
        );
        *best = best.max(middle).max(before).max(after);
    }
}

/// The tracking data of one edge.
#[derive(Debug, Clone, Copy)]
struct EdgeTrack {
    contact: usize,
    side: EdgeSide,
    /// Index of the contact in progress.
    open: Option<usize>,
    pivot: Pivot,
}

#[derive(Debug)]
pub(super) struct Track {
    edges: [EdgeTrack; 2],
    /// Requested points: distances (to the right, upward) from the centre of gravity.
    points: Vec<(f64, f64)>,
    is_free: bool,
    alpha: [f64; 2],
    swing: (f64, f64, bool),
    last_touch: Option<usize>,
    flight_s: Option<f64>,
    /// Where the foot of a slipping contact began to slip, and its stretch.
    slips: Vec<f64>,
}

impl Track {
    /// `is_free`: the base does not move.
    pub(super) fn new(
        block: &Block,
        body: &Body,
        points_m: &[(f64, f64)],
        is_free: bool,
        start: &State,
    ) -> Self {
        let edge = |contact, side, pivot| EdgeTrack {
            contact,
            side,
            open: None,
            pivot,
        };
        let pivots = [block.pivot(), block.right_pivot()];
        Self {
            edges: [
                edge(0, EdgeSide::Left, pivots[0]),
                edge(body.contacts.len() - 1, EdgeSide::Right, pivots[1]),
            ],
            points: points_m
                .iter()
                .map(|&(x, z)| (x - block.cg_from_left_m(), z - block.cg_height_m()))
                .collect(),
            is_free,
            alpha: pivots.map(|pivot| pivot.slenderness_angle_rad),
            swing: (0.0, start[THETA], false),
            last_touch: None,
            flight_s: None,
            slips: vec![0.0; body.contacts.len()],
        }
    }

    /// Evaluates a step.
    pub(super) fn read(&mut self, seen: &Seen, result: &mut CompliantRocking) {
        self.accelerations(seen, result);
        self.rotations(seen, result);
        self.uplifts(seen, result);
        self.friction(seen, result);
    }

    fn accelerations(&self, seen: &Seen, result: &mut CompliantRocking) {
        for (index, edge) in self.edges.iter().enumerate() {
            if !seen.grips[edge.contact].carries() {
                continue;
            }
            let up = |share: f64| {
                seen.acceleration(
                    seen.body.contacts[edge.contact],
                    -seen.body.cg_height,
                    share,
                )
                .1
            };
            let push = |share: f64| {
                seen.with_state(share, |y, turn| {
                    let foot = seen.body.foot_turned(edge.contact, y, turn);
                    seen.body
                        .load(seen.grips[edge.contact], &foot, y[STRETCH + edge.contact])
                        .normal
                })
            };
            let press = |share: f64| seen.foot(edge.contact, share).compression;
            raise(&mut result.peak_compression_m, press);
            if let Some(touch) = edge.open.and_then(|open| result.touches.get_mut(open)) {
                raise(&mut touch.peak_acceleration_m_s2, up);
                raise(&mut touch.peak_force_n, push);
                let (a, f) = (touch.peak_acceleration_m_s2, touch.peak_force_n);
                result.peak_edge_accelerations_m_s2[index] =
                    result.peak_edge_accelerations_m_s2[index].max(a);
                result.peak_edge_forces_n[index] = result.peak_edge_forces_n[index].max(f);
            } else {
                raise(&mut result.peak_edge_accelerations_m_s2[index], up);
                raise(&mut result.peak_edge_forces_n[index], push);
            }
        }
        for (&(right, up), peaks) in self.points.iter().zip(&mut result.points) {
            raise(&mut peaks.horizontal_m_s2, |share| {
                seen.acceleration(right, up, share).0.abs()
            });
            raise(&mut peaks.vertical_m_s2, |share| {
                seen.acceleration(right, up, share).1.abs()
            });
        }
    }

    fn rotations(&mut self, seen: &Seen, result: &mut CompliantRocking) {
        let (from, to) = (seen.step.start[THETA], seen.step.end[THETA]);
        let side = if from + to < 0.0 { -1.0 } else { 1.0 };
        let top = seen.falls(|share| side * seen.value(share, |y| y[OMEGA]));
        let top = top.map(|share| (share, seen.step.state(share)[THETA]));
        for (share, theta) in [(0.0, from), (1.0, to)].into_iter().chain(top) {
            if theta.abs() > result.peak_rotation_rad {
                (result.peak_rotation_rad, result.peak_rotation_time_s) =
                    (theta.abs(), seen.time_s(share));
            }
            if theta.abs() > self.swing.1.abs() && theta * side >= 0.0 {
                (self.swing.0, self.swing.1) = (seen.time_s(share), theta);
            }
        }
        let alpha = self.alpha[usize::from(side > 0.0)];
        if result.passed_alpha_time_s.is_none() && side * to > alpha {
            let share = bisect(0.0, 1.0, |share| {
                side * seen.step.state(share)[THETA] > alpha
            });
            result.passed_alpha_time_s = Some(seen.time_s(share));
        }
        if from != 0.0 && from.signum() != to.signum() {
            self.end_swing(result);
            self.swing = (seen.time_s(1.0), to, false);
        }
    }

    /// Records the swing that has ended, if an edge was off its cushion during it.
    pub(super) fn end_swing(&self, result: &mut CompliantRocking) {
        let (time_s, rotation_rad, lifted) = self.swing;
        if !lifted {
            return;
        }
        let rise = |theta: f64| {
            self.edges[usize::from(theta > 0.0)]
                .pivot
                .largest_rise_m(theta)
        };
        let before = result
            .swings
            .last()
            .filter(|_| self.is_free)
            .map(|last| rise(last.rotation_rad));
        let ratio = before.map(|before| (rise(rotation_rad) / before).sqrt());
        result.swings.push(Swing {
            time_s,
            rotation_rad,
            effective_restitution_ratio: ratio,
        });
    }

    fn uplifts(&mut self, seen: &Seen, result: &mut CompliantRocking) {
        for edge in &self.edges {
            let height = |share: f64| -seen.foot(edge.contact, share).compression;
            let rising = |share: f64| -seen.foot(edge.contact, share).compression_rate;
            let top = seen.falls(rising).map(height);
            let most = height(0.0).max(height(1.0)).max(top.unwrap_or(0.0));
            result.uplift_m = result.uplift_m.max(most);
            if most > 0.0 {
                self.swing.2 = true;
                if result.first_uplift_time_s.is_none() {
                    let is_up = |share: f64| height(share) > 0.0;
                    let share = if is_up(0.0) {
                        0.0
                    } else {
                        bisect(0.0, 1.0, is_up)
                    };
                    result.first_uplift_time_s = Some(seen.time_s(share));
                }
                let theta = seen.step.start[THETA].abs().max(seen.step.end[THETA].abs());
                let theta = if seen
                    .falls(|share| seen.value(share, |y| y[OMEGA] * y[THETA]))
                    .is_some()
                {
                    theta.max(self.swing.1.abs())
                } else {
                    theta
                };
                result.peak_uplifted_rotation_rad = result.peak_uplifted_rotation_rad.max(theta);
            }
        }
    }

    fn friction(&self, seen: &Seen, result: &mut CompliantRocking) {
        let y = &seen.step.end;
        for (index, &grip) in seen
            .grips
            .iter()
            .enumerate()
            .filter(|(_, grip)| grip.carries())
        {
            let foot = seen.body.foot_turned(index, y, &seen.ends[1]);
            let load = seen.body.load(grip, &foot, y[STRETCH + index]);
            if load.normal > CARRYING_RATIO * seen.body.mass * seen.body.gravity {
                result.friction_used_ratio = result
                    .friction_used_ratio
                    .max(load.tangential.abs() / load.normal);
            }
        }
    }

    /// A contact begins.
    pub(super) fn touch(
        &mut self,
        body: &Body,
        contact: usize,
        time_s: f64,
        y: &State,
        result: &mut CompliantRocking,
    ) {
        if let Some(start_s) = self.flight_s.take() {
            result.flight_time_s += time_s - start_s;
        }
        let Some(edge) = self
            .edges
            .iter_mut()
            .position(|edge| edge.contact == contact)
        else {
            return;
        };
        if self.last_touch == Some(edge) {
            result.bounce_count += 1;
        }
        self.last_touch = Some(edge);
        self.edges[edge].open = Some(result.touches.len());
        result.touches.push(Touch {
            edge: self.edges[edge].side,
            time_s,
            speed_m_s: body.foot(contact, y).compression_rate,
            omega_before_rad_s: y[OMEGA],
            end_time_s: None,
            rebound_m_s: None,
            omega_after_rad_s: None,
            peak_acceleration_m_s2: 0.0,
            peak_force_n: 0.0,
        });
    }

    /// A contact ends; `none_left`: it was the last one.
    pub(super) fn leave(
        &mut self,
        body: &Body,
        (contact, none_left): (usize, bool),
        time_s: f64,
        y: &State,
        result: &mut CompliantRocking,
    ) {
        if none_left {
            self.flight_s = Some(time_s);
            result.flight_count += 1;
        }
        let Some(edge) = self.edges.iter_mut().find(|edge| edge.contact == contact) else {
            return;
        };
        if let Some(touch) = edge
            .open
            .take()
            .and_then(|open| result.touches.get_mut(open))
        {
            touch.end_time_s = Some(time_s);
            touch.rebound_m_s = Some(-body.foot(contact, y).compression_rate);
            touch.omega_after_rad_s = Some(y[OMEGA]);
        }
    }

    /// The foot of a contact begins or ends its slide; `place` is its position relative to the
    /// centre of the base.
    pub(super) fn slide(
        &mut self,
        contact: usize,
        place: f64,
        begins: bool,
        result: &mut CompliantRocking,
    ) {
        let Some(from) = self.slips.get_mut(contact) else {
            return;
        };
        if !begins {
            result.slid_m += (place - *from).abs();
        }
        *from = place;
    }

    /// Starts a flight.
    pub(super) fn flies_from(&mut self, time_s: f64, result: &mut CompliantRocking) {
        self.flight_s = Some(time_s);
        result.flight_count += 1;
    }

    pub(super) fn finish(&self, block: &Block, time_s: f64, result: &mut CompliantRocking) {
        self.end_swing(result);
        if let Some(start_s) = self.flight_s {
            result.flight_time_s += time_s - start_s;
        }
        let theta = result.peak_uplifted_rotation_rad;
        let rises = [block.pivot(), block.right_pivot()].map(|pivot| pivot.largest_rise_m(theta));
        // The edge about which the block rotated in the largest swing; for a block without offset
        // both rises are equal.
        let to = |side: f64| {
            result
                .swings
                .iter()
                .map(|swing| side * swing.rotation_rad)
                .fold(0.0, f64::max)
        };
        result.cg_rise_m = if to(1.0) >= to(-1.0) {
            rises[1]
        } else {
            rises[0]
        };
    }
}

impl PointPeaks {
    pub(super) const NONE: Self = Self {
        horizontal_m_s2: 0.0,
        vertical_m_s2: 0.0,
    };
}
