//! One world on its way through the kernel: what it is, where it is, and what it has reached.

use super::body::Body;
use super::lifted::{CONTACT_CHANGES, FALLEN, Lifted, PULSE_ENDS, SAMPLE_ENDS};
use super::linear::{Recursion, STATES, Sample};
use super::look::{FIRM_RATIO, Look, Reached};
use super::pressed::Pressed;
use super::reach::AtOnce;
use super::stretch::Stretch;
use super::through::Of;
use super::{CompliantSummary, PadOutcome};
use crate::compliant::CompliantError;
use crate::motion::Motion;
use crate::rocking::LONGEST_TAIL_S;

/// Lanes beyond this rotation have no use for a result \[rad\].
const LOST_RAD: f64 = 1e3;

/// A touch of an edge: its pulse lasts until its upward acceleration is over.
#[derive(Debug, Clone, Copy, Default)]
struct Touch {
    start_s: f64,
    speed: f64,
    /// Whether its pulse has the highest peak so far.
    is_hardest: bool,
}

/// Where a world is.
#[derive(Debug, Clone, Copy)]
enum State {
    /// Both edges on their pads: y of [`Recursion`].
    Pressed([f64; STATES]),
    /// Displacements and rates of the centre of gravity, and the feet of the two edges.
    Lifted { y: [f64; 6], anchors: [f64; 2] },
}

#[derive(Debug)]
pub(super) struct World<'a> {
    body: Body,
    look: Look,
    sample: Sample,
    stretch: Stretch,
    horizontal: &'a [f64],
    vertical: &'a [f64],
    dt_s: f64,
    intervals: usize,
    state: State,
    /// The sample interval that comes next, or in which the world is, and the time since its start.
    index: usize,
    gone_s: f64,
    /// Half of the difference of the two springs' stretch, which nothing changes while both edges hold.
    apart: f64,
    touches: [Touch; 2],
    /// Largest acceleration of a pulse.
    hardest: f64,
    summary: CompliantSummary,
    /// The first way through the motion, which goes to its end for the ratio of uplift.
    pub(super) is_screened: bool,
    pub(super) error: Option<CompliantError>,
}

impl<'a> World<'a> {
    pub(super) fn new(
        body: Body,
        motion: &Motion,
        horizontal: &'a [f64],
        vertical: &'a [f64],
    ) -> Self {
        let deepest = body.rest.compressions[0].max(body.rest.compressions[1]);
        let step = Recursion::new(&body);
        let sample = Sample::new(&body, &step);
        Self {
            stretch: Stretch::new(&sample),
            sample,
            look: Look::new(&body, step),
            horizontal,
            vertical,
            dt_s: motion.dt_s(),
            // To rest within one sample, and two half periods of rocking: the residual vibration is largest
            // within its first period.
            intervals: motion.accel_m_s2().len()
                + (2.0 * body.calm_s / motion.dt_s()).ceil() as usize,
            state: State::Pressed([0.0; STATES]),
            index: 0,
            gone_s: 0.0,
            apart: 0.0,
            touches: [Touch::default(); 2],
            hardest: 0.0,
            summary: CompliantSummary {
                outcome: PadOutcome::StayedOn,
                pad_uplift_ratio: 0.0,
                lift_m: 0.0,
                peak_edge_accelerations_m_s2: [0.0; 2],
                touch_count: 0,
                touch_speed_m_s: 0.0,
                velocity_change_m_s: 0.0,
                pulse_duration_s: None,
                contact_duration_s: None,
                peak_compression_m: deepest,
                let_go_time_s: None,
                first_uplift_time_s: None,
                overturn_time_s: None,
            },
            is_screened: false,
            error: None,
            body,
        }
    }

    pub(super) fn result(self) -> Result<CompliantSummary, CompliantError> {
        self.error.map_or(Ok(self.summary), Err)
    }

    pub(super) fn is_vertical(&self) -> bool {
        !self.vertical.is_empty()
    }

    /// Base accelerations at a sample.
    fn sample(&self, index: usize) -> [f64; 2] {
        [self.horizontal, self.vertical].map(|samples| samples.get(index).copied().unwrap_or(0.0))
    }

    pub(super) fn index(&self) -> usize {
        self.index
    }

    pub(super) fn intervals(&self) -> usize {
        self.intervals
    }

    /// Base accelerations one way from a sample on; none where it does not move that way.
    pub(super) fn samples(&self, way: usize, index: usize) -> &'a [f64] {
        let samples = if way == 0 {
            self.horizontal
        } else {
            self.vertical
        };
        samples.get(index..).unwrap_or_default()
    }

    fn time_s(&self, gone_s: f64) -> f64 {
        self.index as f64 * self.dt_s + gone_s
    }

    /// Into a lane with both edges on their pads.
    pub(super) fn press(&self, pressed: &mut Pressed, lane: usize) {
        let y = match self.state {
            State::Pressed(y) => y,
            State::Lifted { .. } => [0.0; STATES],
        };
        // After the screen what is lost matters only where it leaves.
        let (lost, counts_to) = if self.is_screened {
            (FIRM_RATIO, FIRM_RATIO)
        } else {
            (0.0, 1.0)
        };
        let reached = Reached {
            lost,
            pressed: self.summary.peak_compression_m,
            peaks: self.summary.peak_edge_accelerations_m_s2,
            left: None,
            counts_to,
        };
        let at_once = AtOnce::new(&self.body);
        pressed.enter(lane, &self.stretch, &y, &self.of(), &at_once, reached);
    }

    /// What its stretches are of.
    pub(super) fn of(&self) -> Of<'_> {
        let [left_m, right_m] = self.body.rest.compressions;
        Of {
            sample: &self.sample,
            deepest_m: left_m.max(right_m),
            base: [self.horizontal, self.vertical],
        }
    }

    /// What its steps are looked at with.
    pub(super) fn look(&self) -> &Look {
        &self.look
    }

    /// Out of such a lane; whether an edge has let go.
    pub(super) fn after_pressed(&mut self, reached: &Reached) -> bool {
        let summary = &mut self.summary;
        let first = !std::mem::replace(&mut self.is_screened, true);
        if first {
            summary.pad_uplift_ratio = reached.lost;
        }
        summary.peak_compression_m = summary.peak_compression_m.max(reached.pressed);
        let peaks = &mut summary.peak_edge_accelerations_m_s2;
        for (peak, reached) in peaks.iter_mut().zip(reached.peaks) {
            *peak = peak.max(reached);
        }
        if !summary.pad_uplift_ratio.is_finite() {
            self.error = Some(CompliantError::NotFinite {
                time_s: self.intervals as f64 * self.dt_s,
            });
            return false;
        }
        // Pads that would never have to pull need no other equations.
        let Some(left) = reached.left.filter(|_| summary.pad_uplift_ratio > 1.0) else {
            return false;
        };
        self.index = left.sample;
        self.gone_s = left.part as f64 * self.body.step_s;
        self.lift_off(left.y);
        true
    }

    /// From the deviation from rest to the place of the block.
    fn lift_off(&mut self, y: [f64; STATES]) {
        let (rest, h) = (self.body.rest, self.body.step_s);
        let place = [
            y[0],
            rest.z + y[1],
            rest.theta + y[2],
            y[3] / h,
            y[4] / h,
            y[5] / h,
        ];
        let (sin, cos) = place[2].sin_cos();
        let anchor = |edge: usize, side: f64| {
            let arm_x = self.body.edges[edge] * cos - self.body.height * sin;
            let stretch = y[0] + rest.arm_z[edge] * y[2] + side * self.apart;
            place[0] + arm_x - stretch
        };
        self.state = State::Lifted {
            y: place,
            anchors: [anchor(0, -1.0), anchor(1, 1.0)],
        };
    }

    /// A block at some place, its feet where its right edge is, for tests.
    #[cfg(test)]
    pub(super) fn tilt(&mut self, y: [f64; 6], anchor: f64) {
        self.state = State::Lifted {
            y,
            anchors: [anchor; 2],
        };
    }

    /// Every step of every sample, for tests.
    #[cfg(test)]
    pub(super) fn look_everywhere(&mut self) {
        for bounds in [&mut self.stretch.bounds, &mut self.sample.bounds] {
            bounds.lost = [f64::INFINITY; _];
        }
    }

    /// Into a lane of blocks that may lift.
    pub(super) fn lift(&self, lifted: &mut Lifted, lane: usize) {
        let State::Lifted { y, anchors } = self.state else {
            return;
        };
        lifted.enter(lane, &self.body);
        lifted.place(lane, y);
        for (column, value) in lifted.anchor.iter_mut().zip(anchors) {
            column[lane] = value;
        }
        self.shake(lifted, lane, self.gone_s);
        lifted.plan(lane);
    }

    /// The base acceleration of the sample interval, `gone_s` after its start.
    fn shake(&self, lifted: &mut Lifted, lane: usize, gone_s: f64) {
        let (from, to) = (self.sample(self.index), self.sample(self.index + 1));
        for way in 0..2 {
            let slope = (to[way] - from[way]) / self.dt_s;
            lifted.slope[way][lane] = slope;
            lifted.base[way][lane] = from[way] + slope * gone_s;
        }
        lifted.rest[lane] = self.dt_s - gone_s;
        lifted.gone[lane] = gone_s;
    }

    /// What a step of a lane asks for; says where the world goes if it leaves the lane.
    pub(super) fn after_step(&mut self, lifted: &mut Lifted, lane: usize) -> Option<Next> {
        let flags = lifted.flags[lane] as u32;
        let end_s = self.time_s(lifted.gone[lane]);
        if lifted.lift[lane] > 0.0 {
            self.summary.first_uplift_time_s.get_or_insert(end_s);
        }
        for edge in 0..2 {
            if flags & PULSE_ENDS[edge] != 0 {
                self.end_pulse_between(lifted, lane, edge, end_s);
            }
            if flags & CONTACT_CHANGES[edge] != 0 {
                if lifted.on[edge][lane] > 0.0 {
                    self.leave(lifted, lane, edge, end_s);
                } else {
                    self.touch(lifted, lane, edge, end_s);
                }
            }
        }
        if flags & FALLEN != 0 {
            let theta = lifted.y[2][lane];
            if theta.abs() < LOST_RAD {
                self.summary.outcome = PadOutcome::Overturned;
                self.summary.overturn_time_s = Some(end_s);
            } else {
                self.error = Some(CompliantError::NotFinite { time_s: end_s });
            }
            self.close(lifted, lane, end_s);
            return Some(Next::Done);
        }
        if flags & SAMPLE_ENDS == 0 {
            return None;
        }
        self.index += 1;
        // After the motion it goes on until both edges hold, or it falls.
        let is_calm = lifted.calm[lane] >= self.body.calm_s;
        let longest = self.intervals + (LONGEST_TAIL_S / self.dt_s) as usize;
        if self.index >= longest || self.index >= self.intervals && is_calm {
            self.close(lifted, lane, end_s);
            return Some(Next::Done);
        }
        if lifted.calm[lane] >= self.body.calm_s {
            self.close(lifted, lane, end_s);
            self.settle(lifted, lane);
            return Some(Next::Pressed);
        }
        self.shake(lifted, lane, 0.0);
        lifted.plan(lane);
        None
    }

    fn touch(&mut self, lifted: &mut Lifted, lane: usize, edge: usize, time_s: f64) {
        lifted.on[edge][lane] = 1.0;
        lifted.anchor[edge][lane] = lifted.place_end[edge][lane];
        lifted.pulse[edge][lane] = 1.0;
        lifted.pulse_peak[edge][lane] = 0.0;
        lifted.up[edge][lane] = 0.0;
        let speed = lifted.pressing_end[edge][lane];
        self.touches[edge] = Touch {
            start_s: time_s,
            speed,
            is_hardest: false,
        };
        self.summary.touch_count += 1;
        self.summary.touch_speed_m_s = self.summary.touch_speed_m_s.max(speed);
    }

    fn leave(&mut self, lifted: &mut Lifted, lane: usize, edge: usize, time_s: f64) {
        if lifted.pulse[edge][lane] > 0.0 {
            let rebound = -lifted.pressing_end[edge][lane];
            self.end_pulse(lifted, lane, edge, time_s, rebound);
        }
        if std::mem::take(&mut self.touches[edge].is_hardest) {
            self.summary.contact_duration_s = Some(time_s - self.touches[edge].start_s);
        }
        if self.summary.let_go_time_s.is_none() {
            (self.summary.outcome, self.summary.let_go_time_s) = (PadOutcome::LetGo, Some(time_s));
        }
        lifted.on[edge][lane] = 0.0;
        lifted.surface[edge][lane] = lifted.press_end[edge][lane].max(0.0);
    }

    /// The upward acceleration was over between the starts of the last step and of this one.
    fn end_pulse_between(&mut self, lifted: &mut Lifted, lane: usize, edge: usize, end_s: f64) {
        let (before, now) = (lifted.up_before[edge][lane], lifted.up[edge][lane]);
        let share = before / (before - now);
        let (from, to) = (
            lifted.pressing_before[edge][lane],
            lifted.pressing[edge][lane],
        );
        let time_s = end_s - lifted.taken[lane] - (1.0 - share) * lifted.taken_before[lane];
        self.end_pulse(lifted, lane, edge, time_s, -(from + share * (to - from)));
    }

    fn end_pulse(
        &mut self,
        lifted: &mut Lifted,
        lane: usize,
        edge: usize,
        time_s: f64,
        rebound: f64,
    ) {
        let touch = self.touches[edge];
        lifted.pulse[edge][lane] = 0.0;
        let change = touch.speed + rebound.max(0.0);
        self.summary.velocity_change_m_s = self.summary.velocity_change_m_s.max(change);
        let peak = lifted.pulse_peak[edge][lane];
        if peak > self.hardest {
            self.hardest = peak;
            self.summary.pulse_duration_s = Some(time_s - touch.start_s);
            self.summary.contact_duration_s = None;
            self.touches[1 - edge].is_hardest = false;
            self.touches[edge].is_hardest = true;
        }
    }

    /// Takes what a lane has reached.
    fn close(&mut self, lifted: &mut Lifted, lane: usize, time_s: f64) {
        for edge in 0..2 {
            if lifted.pulse[edge][lane] > 0.0 {
                let rebound = -lifted.pressing_end[edge][lane];
                self.end_pulse(lifted, lane, edge, time_s, rebound);
            }
            let peak = &mut self.summary.peak_edge_accelerations_m_s2[edge];
            *peak = peak.max(lifted.peak[edge][lane]);
        }
        self.summary.lift_m = self.summary.lift_m.max(lifted.lift[lane]);
        self.summary.peak_compression_m = self
            .summary
            .peak_compression_m
            .max(lifted.most_pressed[lane]);
    }

    /// From the place of the block, both edges on their pads, to the deviation from rest.
    fn settle(&mut self, lifted: &Lifted, lane: usize) {
        let (rest, h) = (self.body.rest, self.body.step_s);
        let y: [f64; 6] = std::array::from_fn(|k| lifted.y[k][lane]);
        let stretch = [0, 1].map(|edge| lifted.place_end[edge][lane] - lifted.anchor[edge][lane]);
        let theta = y[2] - rest.theta;
        let turned = [0, 1].map(|edge: usize| rest.arm_z[edge] * theta);
        let x = 0.5 * (stretch[0] - turned[0] + stretch[1] - turned[1]);
        self.apart = 0.5 * (stretch[1] - turned[1] - stretch[0] + turned[0]);
        self.gone_s = 0.0;
        self.state = State::Pressed([x, y[1] - rest.z, theta, h * y[3], h * y[4], h * y[5]]);
    }
}

/// Where a world goes that leaves a lane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Next {
    Done,
    Pressed,
}
