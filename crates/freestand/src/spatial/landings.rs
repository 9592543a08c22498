//! What the points of a base do where they press on the floor.

use super::element::Role;
use super::equation::{Line, Poses, State};
use super::pose::Flat;
use super::seen::Seen;
use crate::compliant::{HEADROOM, raise};

/// The highest of five values of the force in a step is at least this share of the maximum: error control limits the
/// steps of a visible vibration to a third of a radian.
const SAMPLED_NEAR: f64 = 0.97;

/// The landings of the base of an object, or of the lower body of a stack.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BaseLandings {
    /// Largest upward acceleration of a point of the base during contact, in the inertial frame
    /// \[m/s²\].
    pub peak_acceleration_m_s2: f64,
    /// Largest compression of a cushion \[m\].
    pub peak_compression_m: f64,
    /// Δv: largest sum, over the contacts, of the speed of the point as it touches and its upward speed
    /// at the end of its pulse \[m/s\].
    pub velocity_change_m_s: f64,
    /// Duration of the pulse with the highest peak, from the touch until the point is no longer
    /// accelerated upward \[s\]; `None`: no point landed.
    pub pulse_duration_s: Option<f64>,
}

/// The pulse of a point in progress.
#[derive(Debug, Clone, Copy)]
struct Pulse {
    start_s: f64,
    speed_m_s: f64,
    peak_m_s2: f64,
}

#[derive(Debug, Clone)]
pub(super) struct Landings {
    /// Of each element.
    pulses: Vec<Option<Pulse>>,
    hardest_m_s2: f64,
    found: BaseLandings,
}

impl Landings {
    pub(super) fn new(elements: usize) -> Self {
        Self {
            pulses: vec![None; elements],
            hardest_m_s2: 0.0,
            found: BaseLandings::default(),
        }
    }

    /// Evaluates a step.
    pub(super) fn read(&mut self, seen: &Seen<'_, '_>, line: &Line) {
        let (world, step) = (seen.world, seen.step);
        let z = -world.bodies[0].cg_height;
        let end_s = step.start_s + step.length_s;
        let height = |poses: &Poses| poses[0].displacement(z, 2);
        let lifting = |time_s: f64, poses: &Poses, rates: &State| {
            let relative = poses[0].lifting(z, rates);
            Flat {
                at: relative.at + line.at(time_s)[2],
                ..relative
            }
        };
        let liftings = [
            lifting(step.start_s, seen.ends[0], step.start_rates()),
            lifting(end_s, seen.ends[1], step.end_rates()),
        ];
        let mut inner: Option<[Flat; 3]> = None;
        for (index, element) in world.elements.iter().enumerate() {
            if element.role != Role::Base || !seen.grips.each()[index].carries() {
                continue;
            }
            let point = [element.point[0], element.point[1]];
            let pressed = |poses: &Poses| {
                let pose = &poses[0];
                (-height(poses).of(point), -pose.rising(z).of(point))
            };
            if let Some((_, most_m)) = seen.crest(self.found.peak_compression_m, pressed) {
                self.found.peak_compression_m = most_m;
            }
            let [before, now] = liftings.map(|lifting| lifting.of(point));
            let known_m_s2 = self.found.peak_acceleration_m_s2;
            // Compared with gravity added: the force of the cushions, which also carries the weight, is what vibrates.
            let gravity = world.gravity;
            if before.max(now) + gravity >= HEADROOM * (known_m_s2 + gravity) {
                let at = |share: f64| {
                    let (y, time_s) = (seen.state(share), seen.time_s(share));
                    let rates = world.rates(seen.grips, line, time_s, &y);
                    lifting(time_s, &world.poses(&y), &rates)
                };
                let inner = inner.get_or_insert_with(|| [0.25, 0.5, 0.75].map(at));
                let highest = inner.iter().map(|lifting| lifting.of(point));
                let highest = highest.fold(before.max(now), f64::max);
                if highest + gravity >= SAMPLED_NEAR * (known_m_s2 + gravity) {
                    let up = |share: f64| match share {
                        0.0 => before,
                        1.0 => now,
                        _ => at(share).of(point),
                    };
                    raise(&mut self.found.peak_acceleration_m_s2, up);
                }
            }
            let Some(pulse) = &mut self.pulses[index] else {
                continue;
            };
            // Of a pulse that is not the hardest so far the ends of steps will do.
            let top_m_s2 = self.found.peak_acceleration_m_s2;
            let inner_m_s2 = if top_m_s2 > known_m_s2 { top_m_s2 } else { 0.0 };
            pulse.peak_m_s2 = pulse.peak_m_s2.max(before).max(now).max(inner_m_s2);
            if before > 0.0 && now <= 0.0 {
                let share = before / (before - now);
                let pose = &seen.poses(share)[0];
                let rate_m_s = -pose.rising(z).of(point);
                self.leave(index, step.start_s + share * step.length_s, rate_m_s);
            }
        }
    }

    /// A point of the base touches the floor at this speed.
    pub(super) fn touch(&mut self, index: usize, start_s: f64, speed_m_s: f64) {
        self.pulses[index] = Some(Pulse {
            start_s,
            speed_m_s,
            peak_m_s2: 0.0,
        });
    }

    /// The pulse of an element, if there is one, ends with its cushion pressed at this rate.
    pub(super) fn leave(&mut self, index: usize, time_s: f64, rate_m_s: f64) {
        let Some(pulse) = self.pulses[index].take() else {
            return;
        };
        let change = pulse.speed_m_s + (-rate_m_s).max(0.0);
        self.found.velocity_change_m_s = self.found.velocity_change_m_s.max(change);
        if pulse.peak_m_s2 > self.hardest_m_s2 {
            self.hardest_m_s2 = pulse.peak_m_s2;
            self.found.pulse_duration_s = Some(time_s - pulse.start_s);
        }
    }

    /// What was found until the end of the history.
    pub(super) fn close(mut self, end_s: f64) -> BaseLandings {
        for index in 0..self.pulses.len() {
            self.leave(index, end_s, 0.0);
        }
        self.found
    }
}
