//! Events of contacts: when they occur, and how the contact continues.

use std::f64::consts::FRAC_PI_2;

use super::CompliantRocking;
use super::equation::{Grip, Line, Load, OMEGA, SLIP, STRETCH, State, THETA, Turn, V_Z, X};
use super::pad::between_kinks;
use super::solve::{Piece, Solver};

/// A contact that begins with less than this share of the weight counts as beginning without force.
pub(crate) const TOUCHING: f64 = 1e-9;

impl<F: FnMut(&Piece<'_, '_>)> Solver<'_, '_, F> {
    /// How far each contact is from its next event, of the order of 1; negative past it.
    pub(super) fn margin(
        &self,
        index: usize,
        line: &Line,
        time_s: f64,
        y: &State,
        turn: &Turn,
    ) -> f64 {
        let (body, foot) = (self.body, self.body.foot_turned(index, y, turn));
        let d = foot.compression / self.unit_m;
        if let Grip::Open {
            since_s,
            compression_m,
        } = self.grips[index]
        {
            return body.pad.surface(since_s, compression_m, time_s) / self.unit_m - d;
        }
        let load = body.load(self.grips[index], &foot, y[STRETCH + index]);
        let weight = body.mass * body.gravity;
        let pushes = body
            .pad
            .pushes(foot.compression, load.normal, (self.unit_m, weight));
        let (low, high) = self.lines[index];
        let between = (foot.compression - low).min(high - foot.compression) / self.unit_m;
        let margin = pushes.min(between);
        let Some(friction) = body.friction else {
            return margin;
        };
        match self.grips[index] {
            Grip::Slip(way) => {
                let moves = if body.tangential_damping > 0.0 {
                    foot.sliding - load.stretching
                } else {
                    let rates = body.rates(&self.grips, line, time_s, y);
                    let turned = -(rates[V_Z]
                        - rates[OMEGA] * foot.arm_x
                        - y[OMEGA] * y[OMEGA] * foot.arm_z);
                    let normal_rate =
                        body.pad
                            .push_rate(foot.compression, foot.compression_rate, turned);
                    foot.sliding - way * friction * normal_rate / body.tangential_stiffness
                };
                margin.min(way * moves * self.unit_s / self.unit_m)
            }
            _ => margin.min((friction * load.normal - load.tangential.abs()) / weight),
        }
    }

    /// The smallest of all margins; overturning counts as one of them.
    pub(super) fn least_margin(&self, line: &Line, time_s: f64, y: &State) -> f64 {
        let turn = Turn::of(y);
        let contacts =
            (0..self.grips.len()).map(|index| self.margin(index, line, time_s, y, &turn));
        contacts.fold(FRAC_PI_2 - y[THETA].abs(), f64::min)
    }

    /// Sets the stretch of sliding springs from their force.
    pub(super) fn settle_stretches(&mut self) {
        for index in 0..self.grips.len() {
            if let Grip::Slip(_) = self.grips[index] {
                let load = self.load(index);
                self.y[STRETCH + index] = -load.tangential / self.body.tangential_stiffness;
            }
        }
    }

    fn load(&self, index: usize) -> Load {
        let foot = self.body.foot(index, &self.y);
        self.body
            .load(self.grips[index], &foot, self.y[STRETCH + index])
    }

    /// Changes a contact that is past its event.
    pub(super) fn change(&mut self, index: usize, result: &mut CompliantRocking) {
        self.effort.events += 1;
        let foot = self.body.foot(index, &self.y);
        match self.grips[index] {
            Grip::Open { .. } => self.touch(index, result),
            grip => {
                let load = self.load(index);
                let (low, high) = self.lines[index];
                if self.body.pad.is_over(foot.compression, load.normal) {
                    self.leave(index, result);
                } else if foot.compression < low || foot.compression > high {
                    self.place_between_kinks(index);
                } else {
                    self.turn(index, grip, result);
                }
            }
        }
    }

    /// Begins a contact; the energy that its cushion holds is taken back from the losses.
    fn touch(&mut self, index: usize, result: &mut CompliantRocking) {
        let foot = self.body.foot(index, &self.y);
        self.ledger.lose(-self.body.pad.pressed_j(foot.compression));
        self.y[STRETCH + index] = 0.0;
        self.grips[index] = Grip::Stick;
        self.place_between_kinks(index);
        let load = self.load(index);
        if let Some(friction) = self.body.friction {
            let weight = self.body.mass * self.body.gravity;
            let slips = if load.normal > TOUCHING * weight {
                load.tangential.abs() > friction * load.normal
            } else {
                // At the first contact without dashpots both forces are zero, and their rates
                // decide.
                let rate =
                    self.body
                        .pad
                        .push_rate(foot.compression.max(0.0), foot.compression_rate, 0.0);
                let k = self.body.tangential_stiffness;
                load.tangential != 0.0 || k * foot.sliding.abs() > friction * rate
            };
            if slips {
                self.grips[index] = Grip::Slip(foot.sliding.signum());
                self.track.slide(index, self.place(index), true, result);
            }
        }
        self.track
            .touch(self.body, index, self.time_s, &self.y, result);
    }

    /// Ends a contact; the energy in its springs is lost to the block.
    fn leave(&mut self, index: usize, result: &mut CompliantRocking) {
        let foot = self.body.foot(index, &self.y);
        self.end_slip(index, result);
        let sheared = 0.5 * self.body.tangential_stiffness * self.y[STRETCH + index].powi(2);
        self.ledger
            .lose(self.body.pad.pressed_j(foot.compression) + sheared);
        self.y[STRETCH + index] = 0.0;
        self.grips[index] = Grip::Open {
            since_s: self.time_s,
            compression_m: foot.compression.max(0.0),
        };
        let none_left = !self.grips.iter().any(|grip| grip.carries());
        self.track
            .leave(self.body, (index, none_left), self.time_s, &self.y, result);
    }

    /// Begins or ends a slip. Without a dashpot the energy of the spring is counted with the slip
    /// in between.
    fn turn(&mut self, index: usize, grip: Grip, result: &mut CompliantRocking) {
        if let Grip::Slip(_) = grip {
            self.end_slip(index, result);
            self.grips[index] = Grip::Stick;
            return;
        }
        let way = -self.load(index).tangential.signum();
        if self.body.tangential_damping == 0.0 {
            self.y[SLIP] += 0.5 * self.body.tangential_stiffness * self.y[STRETCH + index].powi(2);
        }
        self.grips[index] = Grip::Slip(way);
        self.track.slide(index, self.place(index), true, result);
    }

    fn end_slip(&mut self, index: usize, result: &mut CompliantRocking) {
        if let Grip::Slip(_) = self.grips[index] {
            if self.body.tangential_damping == 0.0 {
                self.y[SLIP] -=
                    0.5 * self.body.tangential_stiffness * self.y[STRETCH + index].powi(2);
            }
            self.track.slide(index, self.place(index), false, result);
        }
    }

    /// Position of the foot of a contact's spring.
    pub(super) fn place(&self, index: usize) -> f64 {
        self.y[X] + self.body.foot(index, &self.y).arm_x - self.y[STRETCH + index]
    }

    pub(super) fn place_between_kinks(&mut self, index: usize) {
        let d = self.body.foot(index, &self.y).compression;
        self.lines[index] = between_kinks(&self.kinks_m, d);
    }
}
