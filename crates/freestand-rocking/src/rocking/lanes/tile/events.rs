//! Events within a step: landings and the uplifts after them, rest, overturning.

use std::f64::consts::FRAC_PI_2;

use super::waiting::margin;
use super::{Lift, Step, Tile};
use crate::polynomial::{first_root, roots, value, value_and_slope};
use crate::rocking::MAX_IMPACTS;
use crate::rocking::lanes::batch::{CALM, GOES_ON, Known, LANDING, STOPS, STRIKE};
use crate::rocking::lanes::chatter::{Acting, Pull, Trace, impacts_to_rest};
use crate::rocking::lanes::ranks::{Moving, SIDES};
use crate::rocking::lanes::record::State;
use crate::rocking::lanes::rocker::EdgeTerms;
use crate::rocking::lanes::series::TERMS;
use crate::rocking::solve::reaches;

impl Tile<'_> {
    /// Takes up to `BATCH` lanes from their place in the step to their next event, or to its end.
    pub(super) fn events(&mut self, step: &Step, batch: &[u32]) {
        self.work.batches += 1;
        self.work.events += batch.len();
        let known = Known {
            rockers: self.rockers,
            records: &self.records,
            walls: &self.walls,
        };
        self.batch.gather(&self.moving, batch, known);
        (self.degree.solve)(
            self.arch,
            &mut self.batch,
            step.ground,
            self.rest_w,
            batch.len(),
        );
        for (i, &lane) in batch.iter().enumerate() {
            let lane = lane as usize;
            let at = &self.batch;
            let (rank, place) = self.moving.rank_mut(lane);
            rank.best[place] = at.best[i];
            if at.turn[i] != STOPS {
                self.turned(lane, i);
            } else if at.event[i] == CALM {
                rank.y[place] = at.y[i];
                rank.w[place] = at.w[i];
                rank.tau[place] = 0.0;
            } else if at.event[i] == LANDING {
                self.land(step, lane, at.w[i], at.tau[i]);
            } else if at.event[i] == STRIKE {
                self.strike(step, lane, at.w[i], at.tau[i]);
            } else {
                let c = std::array::from_fn(|k| at.c[k][i]);
                self.intricate(step, lane, &c, at.rest[i]);
            }
        }
    }

    /// After an impact from which the block goes far: it is at the end of the step, or has another event
    /// in it.
    #[inline(always)]
    fn turned(&mut self, lane: usize, i: usize) {
        let (rank, place) = self.moving.rank(lane);
        let (block, edge) = (rank.block[place], usize::from(rank.side[place] < 0.0));
        let (best, speed) = (self.batch.best[i], self.batch.speed[i]);
        let counted = if self.batch.event[i] == LANDING {
            self.count_landing(block, edge, best, speed)
        } else {
            self.count_strike(block, edge, speed)
        };
        if !counted {
            self.give_up(lane);
            return;
        }
        let at = &self.batch;
        let (rank, place) = self.moving.rank_mut(lane);
        rank.y[place] = at.y[i];
        rank.w[place] = at.w[i];
        if !at.alike {
            rank.alpha[place] = at.other.alpha[i];
            rank.x2[place] = at.other.x2[i];
            rank.ceiling[place] = at.other.ceiling[i];
        }
        rank.side[place] = at.side[i];
        rank.best[place] = at.other.best[i];
        let over = at.turn[i] == GOES_ON || at.tau[i] >= 1.0;
        rank.tau[place] = if over { 0.0 } else { at.tau[i] };
        if !over {
            self.again.push(lane as u32);
        }
    }

    /// Leaves the block of a lane to the scalar solver.
    #[cold]
    fn give_up(&mut self, lane: usize) {
        self.records[self.moving.block(lane) as usize].state = State::GivenUp;
        self.moving.leave(lane);
    }

    /// Counts an impact on the floor; `false` if there were too many.
    #[inline(always)]
    fn count_landing(&mut self, block: u32, edge: usize, best: f64, speed: f64) -> bool {
        let record = &mut self.records[block as usize];
        record.impact_count += 1;
        let side = &mut record.sides[edge];
        side.height = best;
        if speed > side.speed {
            side.speed = speed;
        }
        record.bounced = false;
        record.impact_count <= MAX_IMPACTS
    }

    /// Counts an impact on the wall beyond an edge; `false` if there were too many.
    #[inline(always)]
    fn count_strike(&mut self, block: u32, edge: usize, speed: f64) -> bool {
        let ceiling = self.rockers[block as usize].edges[edge].ceiling;
        let record = &mut self.records[block as usize];
        record.sides[edge].height = ceiling;
        record.bounced = true;
        let wall = &mut self.walls[block as usize];
        wall.impact_count += 1;
        wall.speeds[edge] = wall.speeds[edge].max(speed);
        wall.impact_count <= MAX_IMPACTS
    }

    /// A step with more than one event, a maximum that is hard to find, a wall, or overturning:
    /// solved by all roots of the series.
    #[inline(never)]
    fn intricate(&mut self, step: &Step, lane: usize, c: &[f64; TERMS], rest: f64) {
        self.work.intricate += 1;
        let Moving {
            block,
            edge,
            best,
            tau,
            ..
        } = self.moving.get(lane);
        let terms = self.rockers[block as usize].edges[edge];
        let mut c = *c;
        if terms.has_wall() && c[0] >= terms.ceiling {
            if c[1] > 0.0 {
                self.strike(step, lane, c[1] / rest, tau);
                return;
            }
            c[0] = terms.ceiling;
            if c[1] == 0.0 {
                // At the instant at which nothing presses it on any longer; a push is rounding.
                c[2] = c[2].min(0.0);
            }
        }
        let c = &c[..=self.degree.degree];
        let Some(lead) = c.iter().position(|&c| c != 0.0).filter(|&k| c[k] > 0.0) else {
            // The base does not lift it after all.
            if c.iter().all(|c| c.is_finite()) {
                self.come_to_rest(step, lane, 1.0);
            } else {
                self.records[block as usize].state = State::GivenUp;
                self.moving.leave(lane);
            }
            return;
        };
        let reach: f64 = c[lead + 1..].iter().map(|c| c.abs()).sum();
        let highest = c[lead] + reach;
        if !highest.is_finite() {
            self.records[block as usize].state = State::GivenUp;
            self.moving.leave(lane);
            return;
        }
        let impact = if c[lead] > reach {
            None
        } else {
            first_root(&c[lead..])
        };
        let stop = if highest < terms.ceiling {
            None
        } else {
            reaches(c, terms.ceiling)
        };
        if terms.has_wall() && stop == Some(0.0) {
            self.lean(step, lane, 1.0);
            return;
        }
        let end = impact.unwrap_or(1.0).min(stop.unwrap_or(1.0));
        let stopped = stop.is_some_and(|x| x <= end);
        if stopped && !terms.has_wall() {
            let record = &mut self.records[block as usize];
            record.state = State::Overturned;
            record.sides[edge].height = FRAC_PI_2;
            self.moving.leave(lane);
            return;
        }
        let (y, w) = value_and_slope(c, end);
        // No further than the wall, whatever rounding yields.
        let y = y.min(terms.ceiling);
        let mut best = best.max(y);
        if highest > best {
            let mut slope = [0.0; TERMS];
            slope
                .iter_mut()
                .zip(c.iter().enumerate().skip(1))
                .for_each(|(slope, (k, c))| *slope = k as f64 * c);
            roots(&slope[..c.len() - 1], &mut |x| {
                if x <= end {
                    best = best.max(value(c, x).min(terms.ceiling));
                }
                x < end
            });
        }
        let (rank, place) = self.moving.rank_mut(lane);
        rank.best[place] = best;
        let after = if end == 1.0 { 1.0 } else { tau + end * rest };
        if stopped {
            self.strike(step, lane, w / rest, after);
        } else if impact.is_some() || y <= 0.0 {
            self.land(step, lane, w / rest, after);
        } else {
            (rank.y[place], rank.w[place], rank.tau[place]) = (y, w / rest, 0.0);
        }
    }

    /// An impact at velocity `w` that ends the rotation about the edge of a lane.
    fn land(&mut self, step: &Step, lane: usize, w: f64, tau: f64) {
        let Moving {
            block, edge, best, ..
        } = self.moving.get(lane);
        let rocker = &self.rockers[block as usize];
        let other = 1 - edge;
        let speed = (-w).max(0.0);
        let after = speed * rocker.restitution[other];
        if !self.count_landing(block, edge, best, speed) {
            self.give_up(lane);
            return;
        }
        if self.walled && rocker.edges.iter().any(EdgeTerms::touches_wall) {
            let (edge, w) = self.beside_touching_wall(block, edge, after);
            self.go_on(step, lane, edge, w, tau);
            return;
        }
        let (edge, w, tau) = if after > self.rest_w {
            self.short_flights(step, block, other, after, tau)
        } else {
            (other, after, tau)
        };
        self.go_on(step, lane, edge, w, tau);
    }

    /// Goes on from the floor with the velocity `w` about `edge`, or rests.
    #[inline(always)]
    fn go_on(&mut self, step: &Step, lane: usize, edge: usize, w: f64, tau: f64) {
        if w > self.rest_w {
            self.turn(lane, edge, 0.0, w, tau);
            return;
        }
        let rocker = &self.rockers[self.moving.block(lane) as usize];
        let (u, v) = step.ground.at(tau);
        let lifted = (0..2).find(|&edge| margin(rocker, edge, u, v) < 0.0);
        match lifted {
            Some(edge) => self.turn(lane, edge, 0.0, 0.0, tau),
            None => self.come_to_rest(step, lane, tau),
        }
    }

    /// After a landing from the rotation about `edge`, with the velocity `after`, beside a wall that
    /// the block touches at rest: the edge about which it goes on, and its velocity.
    #[cold]
    fn beside_touching_wall(&mut self, block: u32, edge: usize, after: f64) -> (usize, f64) {
        let rocker = &self.rockers[block as usize];
        let other = 1 - edge;
        if !rocker.edges[other].touches_wall() {
            return (other, after);
        }
        // The floor, the wall and the floor again at one instant. Between two walls that it touches
        // the block stops.
        let wall = &mut self.walls[block as usize];
        wall.impact_count += 1;
        wall.speeds[other] = wall.speeds[other].max(after);
        let back = after * wall.restitution[other] * rocker.restitution[edge];
        (
            edge,
            if rocker.edges[edge].touches_wall() {
                0.0
            } else {
                back
            },
        )
    }

    /// An impact at velocity `w` on the wall beyond the edge of a lane.
    #[inline(never)]
    fn strike(&mut self, step: &Step, lane: usize, w: f64, tau: f64) {
        let Moving { block, edge, .. } = self.moving.get(lane);
        let rocker = &self.rockers[block as usize];
        let ceiling = rocker.edges[edge].ceiling;
        let speed = w.max(0.0);
        // Too many are found below.
        self.count_strike(block, edge, speed);
        let wall = &self.walls[block as usize];
        let after = speed * wall.restitution[edge];
        let (after, tau) = if after > self.rest_w {
            self.short_bounces(step, block, edge, after, tau)
        } else {
            (after, tau)
        };
        if self.walls[block as usize].impact_count > MAX_IMPACTS {
            self.records[block as usize].state = State::GivenUp;
            self.moving.leave(lane);
            return;
        }
        if after > self.rest_w {
            self.turn(lane, edge, ceiling, -after, tau);
            return;
        }
        let (u, v) = step.ground.at(tau);
        let [by_v, by_u] = self.walls[block as usize].press[edge];
        if by_v * v + by_u * u < 0.0 {
            self.turn(lane, edge, ceiling, 0.0, tau);
        } else {
            self.lean(step, lane, tau);
        }
    }

    /// Calculates short flights from the wall back to it, which do not come near the floor. Returns
    /// the speed away from the wall and the part of the step that has passed after the last of them;
    /// a speed of zero at the end of the step if the block leans before it.
    ///
    /// With d = θ_c − y the equation is that of a flight from the floor:
    /// d̈ = −(E′ cos d − D′ sin d), E′ = D sin θ_c − E cos θ_c, D′ = E sin θ_c + D cos θ_c.
    fn short_bounces(
        &mut self,
        step: &Step,
        block: u32,
        edge: usize,
        w: f64,
        tau: f64,
    ) -> (f64, f64) {
        let rocker = &self.rockers[block as usize];
        let wall = &mut self.walls[block as usize];
        let ceiling = rocker.edges[edge].ceiling;
        let r = wall.restitution[edge];
        let (mut w, mut tau) = (w, tau);
        let (u, v) = step.ground.at(tau);
        let (u1, v1) = (step.ground.u_change, step.ground.v_change);
        let ([by_v, by_u], s) = (wall.press[edge], SIDES[edge]);
        let mut acting = Acting {
            e: Pull {
                now: by_v * v + by_u * u,
                slope: by_v * v1 + by_u * u1,
            },
            d: Pull {
                now: s * (by_v * u - by_u * v),
                slope: s * (by_v * u1 - by_u * v1),
            },
        };
        while w > self.rest_w && wall.impact_count < MAX_IMPACTS {
            let left = 1.0 - tau;
            if !acting.is_brief(w, left) {
                break;
            }
            let trace = Trace {
                height: ceiling,
                speed: wall.speeds[edge],
            };
            if !self.quiet
                && let Some(impacts) =
                    impacts_to_rest([&acting; 2], r, w, left, [trace; 2], self.rest_w)
            {
                wall.impact_count += impacts;
                return (0.0, 1.0);
            }
            let Some(flight) = acting.flight(w, left, ceiling) else {
                break;
            };
            wall.impact_count += 1;
            wall.speeds[edge] = wall.speeds[edge].max(flight.speed);
            acting = acting.after(flight.time);
            w = flight.speed * r;
            tau += flight.time;
        }
        (w, tau)
    }

    /// Starts the rotation about `edge` from the floor or from the wall.
    fn turn(&mut self, lane: usize, edge: usize, y: f64, w: f64, tau: f64) {
        let block = self.moving.block(lane);
        let best = self.records[block as usize].sides[edge].height;
        // At the end of the step the block continues in the next one.
        let over = tau >= 1.0;
        let tau = if over { 0.0 } else { tau };
        self.moving.set(
            lane,
            Moving {
                block,
                edge,
                y,
                w,
                best,
                tau,
            },
            &self.rockers[block as usize],
        );
        if !over {
            self.again.push(lane as u32);
        }
    }

    /// Calculates short flights, which set no new largest rotation. Returns the edge, the speed and
    /// the part of the step that has passed after the last of them; a speed of zero at the end of
    /// the step if the block comes to rest before it.
    fn short_flights(
        &mut self,
        step: &Step,
        block: u32,
        edge: usize,
        w: f64,
        tau: f64,
    ) -> (usize, f64, f64) {
        let rocker = &self.rockers[block as usize];
        let record = &mut self.records[block as usize];
        let (mut edge, mut w, mut tau) = (edge, w, tau);
        let (u, v) = step.ground.at(tau);
        let (u1, v1) = (step.ground.u_change, step.ground.v_change);
        let acting_about = |edge: usize| {
            let (s, EdgeTerms { threshold, b, .. }) = (SIDES[edge], rocker.edges[edge]);
            let a = threshold * b;
            Acting {
                e: Pull {
                    now: a * v + s * b * u,
                    slope: a * v1 + s * b * u1,
                },
                d: Pull {
                    now: b * v - s * a * u,
                    slope: b * v1 - s * a * u1,
                },
            }
        };
        let mut here = acting_about(edge);
        if !here.is_brief(w, 1.0 - tau) {
            return (edge, w, tau);
        }
        let mut there = acting_about(1 - edge);
        let alike = rocker.restitution[0] == rocker.restitution[1];
        let [mut restitution, mut other_restitution] =
            [rocker.restitution[1 - edge], rocker.restitution[edge]];
        let [mut trace, mut other_trace] = [record.sides[edge], record.sides[1 - edge]];
        let mut impacts = record.impact_count;
        let mut rests = false;
        while w > self.rest_w && impacts < MAX_IMPACTS {
            let left = 1.0 - tau;
            // After the motion, impacts of a block for which `tail` has no result are counted one
            // by one, as in the scalar solver.
            if !self.quiet
                && alike
                && let Some(last) = impacts_to_rest(
                    [&here, &there],
                    restitution,
                    w,
                    left,
                    [trace, other_trace],
                    self.rest_w,
                )
            {
                impacts += last;
                rests = impacts <= MAX_IMPACTS;
                break;
            }
            let Some(flight) = here.flight(w, left, trace.height) else {
                break;
            };
            impacts += 1;
            trace.speed = trace.speed.max(flight.speed);
            w = flight.speed * restitution;
            tau += flight.time;
            (here, there) = (there.after(flight.time), here.after(flight.time));
            (trace, other_trace) = (other_trace, trace);
            (restitution, other_restitution) = (other_restitution, restitution);
            edge = 1 - edge;
        }
        record.impact_count = impacts;
        record.sides[edge] = trace;
        record.sides[1 - edge] = other_trace;
        if rests {
            (w, tau) = (0.0, 1.0);
        }
        (edge, w, tau)
    }

    /// The block of a lane comes to rest in a step and waits to be lifted again.
    fn come_to_rest(&mut self, step: &Step, lane: usize, tau: f64) {
        let Moving {
            block, edge, best, ..
        } = self.moving.get(lane);
        let record = &mut self.records[block as usize];
        record.state = State::AtRest;
        record.sides[edge].height = best;
        self.pause(step, lane, block, tau);
    }

    /// The wall beyond the edge of a lane holds its block.
    fn lean(&mut self, step: &Step, lane: usize, tau: f64) {
        let Moving { block, edge, .. } = self.moving.get(lane);
        let past_balance = self.rockers[block as usize].edges[edge].is_past_balance();
        self.records[block as usize].state = State::Leaning {
            edge: edge as u8,
            past_balance,
        };
        self.pause(step, lane, block, tau);
    }

    /// The block of a lane stops in a step and waits for the base.
    fn pause(&mut self, step: &Step, lane: usize, block: u32, tau: f64) {
        self.moving.leave(lane);
        if self.quiet {
            return;
        }
        let ratio = (step.part as f64 + tau) / self.parts as f64;
        match self.lift(block, step.whole, ratio) {
            Some((edge, ratio)) => {
                // Measured from the start of this step: rounding must not start the block before it
                // has come to rest.
                let ahead = ratio * self.parts as f64 - step.part as f64;
                if tau < 1.0 && ahead < 1.0 {
                    let lane = self.start(block, edge, ahead.max(tau));
                    self.again.push(lane as u32);
                } else if step.part + 1 < self.parts {
                    let (part, tau) = self.part_of(ratio);
                    let early = part <= step.part;
                    let (part, tau) = if early {
                        (step.part + 1, 0.0)
                    } else {
                        (part, tau)
                    };
                    self.pending.push(Lift {
                        part,
                        block,
                        edge,
                        tau,
                    });
                } else {
                    self.wait(block, step.interval + 2);
                }
            }
            None => self.wait(block, step.interval + 2),
        }
    }
}
