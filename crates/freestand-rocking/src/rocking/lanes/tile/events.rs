//! Events within a step: landings and the uplifts after them, rest, overturning.

use std::f64::consts::FRAC_PI_2;

use super::waiting::margin;
use super::{Lift, Step, Tile};
use crate::polynomial::{first_root, roots, value, value_and_slope};
use crate::rocking::MAX_IMPACTS;
use crate::rocking::lanes::batch::{CALM, GOES_ON, Known, LANDING, STOPS, STRIKE};
use crate::rocking::lanes::chatter::Trace;
use crate::rocking::lanes::flights::{Acting, Flown, Flyer};
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
                self.give_up(lane);
            }
            return;
        };
        let reach: f64 = c[lead + 1..].iter().map(|c| c.abs()).sum();
        let highest = c[lead] + reach;
        if !highest.is_finite() {
            self.give_up(lane);
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
        if after > self.rest_w {
            self.take_off(lane, block, other, after, tau);
            self.fly_if_full(step);
        } else {
            self.go_on(step, lane, other, after, tau);
        }
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
        let speed = w.max(0.0);
        // Too many are found below.
        self.count_strike(block, edge, speed);
        let wall = &self.walls[block as usize];
        let after = speed * wall.restitution[edge];
        if after > self.rest_w {
            self.take_off_from_wall(lane, block, edge, after, tau);
            self.fly_if_full(step);
        } else {
            self.go_on_from_wall(step, lane, edge, after, tau);
        }
    }

    /// Goes on from the wall beyond the edge of a lane with the speed `after`, or leans on it.
    fn go_on_from_wall(&mut self, step: &Step, lane: usize, edge: usize, after: f64, tau: f64) {
        let block = self.moving.block(lane);
        if self.walls[block as usize].impact_count > MAX_IMPACTS {
            self.give_up(lane);
            return;
        }
        let ceiling = self.rockers[block as usize].edges[edge].ceiling;
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

    /// Keeps a lane for [`Self::fly`], which takes it through short flights from the floor back to it.
    fn take_off(&mut self, lane: usize, block: u32, edge: usize, w: f64, tau: f64) {
        let rocker = &self.rockers[block as usize];
        let record = &self.records[block as usize];
        let about = [edge, 1 - edge].map(|edge| {
            let EdgeTerms { threshold, b, .. } = rocker.edges[edge];
            Acting {
                a: threshold * b,
                b,
                side: SIDES[edge],
                restitution: rocker.restitution[1 - edge],
                trace: record.sides[edge],
            }
        });
        // After the motion, impacts of a block for which `tail` has no result are counted one by one,
        // as in the scalar solver.
        let counted = !self.quiet && rocker.restitution[0] == rocker.restitution[1];
        let flyer = Flyer {
            lane: lane as u32,
            edge,
            from_wall: false,
            w,
            tau,
        };
        self.flights.push(flyer, about, counted);
    }

    /// The same from the wall beyond an edge back to it, where flights do not come near the floor.
    ///
    /// With d = θ_c − y the equation is that of a flight from the floor, about the angle θ_c − α and to
    /// the other side.
    fn take_off_from_wall(&mut self, lane: usize, block: u32, edge: usize, w: f64, tau: f64) {
        let wall = &self.walls[block as usize];
        let [by_v, by_u] = wall.press[edge];
        let side = -SIDES[edge];
        let acting = Acting {
            a: by_v,
            b: side * by_u,
            side,
            restitution: wall.restitution[edge],
            trace: Trace {
                height: self.rockers[block as usize].edges[edge].ceiling,
                speed: wall.speeds[edge],
            },
        };
        let flyer = Flyer {
            lane: lane as u32,
            edge,
            from_wall: true,
            w,
            tau,
        };
        self.flights.push(flyer, [acting; 2], !self.quiet);
    }

    fn fly_if_full(&mut self, step: &Step) {
        if self.flights.is_full() {
            self.fly(step);
        }
    }

    /// Takes the lanes that wait for it through their short flights.
    pub(super) fn fly(&mut self, step: &Step) {
        self.flights.fly(self.arch, step.ground, self.rest_w);
        while let Some(flown) = self.flights.pop(step.ground, self.rest_w) {
            let Flown {
                flyer,
                impacts,
                w,
                tau,
                speeds: [first, second],
            } = flown;
            let Flyer {
                lane,
                edge,
                from_wall,
                ..
            } = flyer;
            let lane = lane as usize;
            let block = self.moving.block(lane) as usize;
            if from_wall {
                let wall = &mut self.walls[block];
                wall.impact_count += impacts;
                wall.speeds[edge] = first.max(second);
                self.go_on_from_wall(step, lane, edge, w, tau);
                continue;
            }
            let record = &mut self.records[block];
            record.impact_count += impacts;
            record.sides[edge].speed = first;
            record.sides[1 - edge].speed = second;
            if record.impact_count > MAX_IMPACTS {
                self.give_up(lane);
                continue;
            }
            let edge = if impacts % 2 == 0 { edge } else { 1 - edge };
            self.go_on(step, lane, edge, w, tau);
        }
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
