//! The history of a rocking block, sampled for plots and tables.

use super::{Rocking, Segment};
use crate::motion::Motion;

/// The block at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HistoryPoint {
    /// Time \[s\].
    pub time_s: f64,
    /// θ \[rad\].
    pub theta_rad: f64,
    /// ω \[rad/s\].
    pub omega_rad_s: f64,
    /// Horizontal acceleration of the base \[m/s²\].
    pub base_accel_m_s2: f64,
}

/// Collects the points of a history at a fixed time step, together with the instants just before
/// and after every impact and the instant of the peak, from the segments that
/// [`super::rock_observed`] passes on.
#[derive(Debug, Clone)]
pub struct HistoryRecorder<'a> {
    base: Option<&'a Motion>,
    dt_s: f64,
    points: Vec<HistoryPoint>,
    sampled: usize,
}

impl<'a> HistoryRecorder<'a> {
    /// A recorder that samples at the steps of `base`, or every `dt_s` without one.
    pub fn new(base: Option<&'a Motion>, dt_s: f64) -> Self {
        Self {
            base,
            dt_s: base.map_or(dt_s, Motion::dt_s),
            points: Vec::new(),
            sampled: 0,
        }
    }

    fn point(&self, time_s: f64, (theta_rad, omega_rad_s): (f64, f64)) -> HistoryPoint {
        HistoryPoint {
            time_s,
            theta_rad,
            omega_rad_s,
            base_accel_m_s2: self.base.map_or(0.0, |m| m.at_m_s2(time_s)),
        }
    }

    /// Adds samples at rest up to, but not including, `until_s`.
    fn rest(&mut self, until_s: f64) {
        while (self.sampled as f64) * self.dt_s < until_s {
            self.points
                .push(self.point(self.sampled as f64 * self.dt_s, (0.0, 0.0)));
            self.sampled += 1;
        }
    }

    /// Adds the next segment.
    pub fn observe(&mut self, segment: &Segment) {
        self.rest(segment.start_s);
        let end_s = segment.start_s + segment.end_ratio * segment.step_s;
        // An event gets its own point even between samples.
        let event = segment.starts_with_an_event();
        if event {
            self.points
                .push(self.point(segment.start_s, segment.rotation(0.0)));
        }
        while (self.sampled as f64) * self.dt_s < end_s {
            let time_s = self.sampled as f64 * self.dt_s;
            if time_s > segment.start_s || !event {
                self.points.push(self.point(
                    time_s,
                    segment.rotation((time_s - segment.start_s) / segment.step_s),
                ));
            }
            self.sampled += 1;
        }
        if segment.end_ratio < 1.0 {
            self.points
                .push(self.point(end_s, segment.rotation(segment.end_ratio)));
        }
    }

    /// Adds the instant of the largest rotation, unless a sample is already there.
    fn peak(&mut self, time_s: f64, rotation_rad: f64) {
        let next = self.points.partition_point(|p| p.time_s < time_s);
        let near = |index: usize| {
            self.points
                .get(index)
                .filter(|p| (p.time_s - time_s).abs() < 1e-9 * self.dt_s)
        };
        if near(next).is_some() || next.checked_sub(1).and_then(near).is_some() {
            return;
        }
        let side = self.points.get(next).map_or(1.0, |p| p.theta_rad);
        self.points
            .insert(next, self.point(time_s, (rotation_rad.copysign(side), 0.0)));
    }

    /// The history, filled up to the end that the solver reports.
    pub fn finish(mut self, rocking: &Rocking) -> Vec<HistoryPoint> {
        if rocking.at_rest {
            self.rest(rocking.end_time_s);
        }
        let last = (rocking.final_rotation_rad, rocking.final_omega_rad_s);
        self.points.push(self.point(rocking.end_time_s, last));
        if let Some(time_s) = rocking.peak_rotation_time_s {
            self.peak(time_s, rocking.peak_rotation_rad);
        }
        // An overturned block ends with an event that is already among the points.
        self.points
            .dedup_by(|b, a| a.time_s == b.time_s && a.omega_rad_s == b.omega_rad_s);
        self.points
    }
}
