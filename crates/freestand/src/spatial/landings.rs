//! What the points of a base do where they press on the floor.

use super::element::{Element, Role};
use super::equation::{Line, Poses, State};
use super::pose::Flat;
use super::seen::Seen;
use crate::compliant::{HEADROOM, raise};

/// The top of the parabola through the highest of five values of the force in a step is at least this share of the
/// maximum: error control limits the steps of a visible vibration to a third of a radian. The highest one of these tops
/// tells which point to search.
const SAMPLED_NEAR: f64 = 0.99;

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
    index: usize,
    point: [f64; 2],
    start_s: f64,
    speed_m_s: f64,
    peak_m_s2: f64,
}

#[derive(Debug, Clone)]
pub(super) struct Landings {
    /// The points of the base: indices of their elements, and places.
    points: Vec<(usize, [f64; 2])>,
    pulses: Vec<Pulse>,
    hardest_m_s2: f64,
    found: BaseLandings,
    /// Largest distance of a point of the base from the axis.
    reach_m: f64,
}

impl Landings {
    pub(super) fn new(elements: &[Element<'_>]) -> Self {
        let elements = elements.iter().enumerate();
        let base = elements.filter(|(_, element)| element.role == Role::Base);
        let points: Vec<(usize, [f64; 2])> = base
            .map(|(index, element)| (index, [element.point[0], element.point[1]]))
            .collect();
        Self {
            reach_m: points
                .iter()
                .map(|(_, [x, y])| x.hypot(*y))
                .fold(0.0, f64::max),
            points,
            pulses: Vec::new(),
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
        let pressing = |poses: &Poses| {
            let sinking = poses[0].rising(z).times(-1.0);
            (height(poses).times(-1.0), sinking)
        };
        let pressings = seen.ends.map(pressing);
        let at = |share: f64| {
            let (y, time_s) = (seen.state(share), seen.time_s(share));
            let rates = world.rates(seen.grips, line, time_s, &y);
            lifting(time_s, &world.poses(&y), &rates)
        };
        let known_m_s2 = self.found.peak_acceleration_m_s2;
        // Compared with gravity added: the force of the cushions, which also carries the weight, is what vibrates.
        let least_m_s2 = |share: f64| share * (known_m_s2 + world.gravity) - world.gravity;
        let worth_a_look_m_s2 = least_m_s2(HEADROOM);
        let deepest_m = pressings.map(|(depth, _)| depth.most_within(self.reach_m));
        let hardest_m_s2 = liftings.map(|lifting| lifting.most_within(self.reach_m));
        let may_be_deepest =
            deepest_m[0].max(deepest_m[1]) >= HEADROOM * self.found.peak_compression_m;
        let may_be_hardest = hardest_m_s2[0].max(hardest_m_s2[1]) >= worth_a_look_m_s2;
        for pulse in &mut self.pulses {
            // Of a pulse that is not the hardest so far the ends of steps will do.
            let [before, now] = liftings.map(|lifting| lifting.of(pulse.point));
            pulse.peak_m_s2 = pulse.peak_m_s2.max(before).max(now);
        }
        let mut inner: Option<[Flat; 3]> = None;
        let mut highest: Option<(usize, [f64; 5], f64)> = None;
        let grips = seen.grips.each();
        let looked_at = match may_be_deepest || may_be_hardest {
            true => &self.points[..],
            false => &[],
        };
        for &(index, point) in looked_at {
            if !grips[index].carries() {
                continue;
            }
            let at_point = |(depth, rate): (Flat, Flat)| (depth.of(point), rate.of(point));
            let pressed = |poses: &Poses| at_point(pressing(poses));
            let deepest_m = self.found.peak_compression_m;
            if may_be_deepest
                && let Some((_, most_m)) =
                    seen.crest_between(deepest_m, pressings.map(at_point), pressed)
            {
                self.found.peak_compression_m = most_m;
            }
            if !may_be_hardest {
                continue;
            }
            let [before, now] = liftings.map(|lifting| lifting.of(point));
            if before.max(now) >= worth_a_look_m_s2 {
                let [a, b, c] = inner
                    .get_or_insert_with(|| [0.25, 0.5, 0.75].map(at))
                    .map(|lifting| lifting.of(point));
                let samples = [before, a, b, c, now];
                let top_m_s2 = top(samples);
                if highest.is_none_or(|(.., most_m_s2)| top_m_s2 > most_m_s2) {
                    highest = Some((index, samples, top_m_s2));
                }
            }
        }
        if let Some((index, [before, a, b, c, now], top_m_s2)) = highest
            && top_m_s2 >= least_m_s2(SAMPLED_NEAR)
        {
            let [x, y, _] = world.elements[index].point;
            let up = |share: f64| match share {
                0.0 => before,
                0.25 => a,
                0.5 => b,
                0.75 => c,
                1.0 => now,
                _ => at(share).of([x, y]),
            };
            raise(&mut self.found.peak_acceleration_m_s2, up);
            let most_m_s2 = self.found.peak_acceleration_m_s2;
            if most_m_s2 > known_m_s2 {
                let mut pulses = self.pulses.iter_mut();
                if let Some(pulse) = pulses.find(|pulse| pulse.index == index) {
                    pulse.peak_m_s2 = pulse.peak_m_s2.max(most_m_s2);
                }
            }
        }
        let mut at = 0;
        while let Some(&Pulse { index, point, .. }) = self.pulses.get(at) {
            let [before, now] = liftings.map(|lifting| lifting.of(point));
            if before > 0.0 && now <= 0.0 {
                let share = before / (before - now);
                let pose = &seen.poses(share)[0];
                let rate_m_s = -pose.rising(z).of(point);
                self.leave(index, step.start_s + share * step.length_s, rate_m_s);
            } else {
                at += 1;
            }
        }
    }

    /// A point of the base touches the floor at this speed.
    pub(super) fn touch(&mut self, index: usize, start_s: f64, speed_m_s: f64) {
        let point = self.points.iter().find(|(of, _)| *of == index);
        self.pulses.extend(point.map(|&(_, point)| Pulse {
            index,
            point,
            start_s,
            speed_m_s,
            peak_m_s2: 0.0,
        }));
    }

    /// The pulse of an element, if there is one, ends with its cushion pressed at this rate.
    pub(super) fn leave(&mut self, index: usize, time_s: f64, rate_m_s: f64) {
        let Some(at) = self.pulses.iter().position(|pulse| pulse.index == index) else {
            return;
        };
        let pulse = self.pulses.remove(at);
        let change = pulse.speed_m_s + (-rate_m_s).max(0.0);
        self.found.velocity_change_m_s = self.found.velocity_change_m_s.max(change);
        if pulse.peak_m_s2 > self.hardest_m_s2 {
            self.hardest_m_s2 = pulse.peak_m_s2;
            self.found.pulse_duration_s = Some(time_s - pulse.start_s);
        }
    }

    /// What was found until the end of the history.
    pub(super) fn close(mut self, end_s: f64) -> BaseLandings {
        while let Some(pulse) = self.pulses.first() {
            self.leave(pulse.index, end_s, 0.0);
        }
        self.found
    }
}

/// The top of the parabola through the highest of values at equal distances and its neighbours.
fn top(values: [f64; 5]) -> f64 {
    let inner = values.windows(3).filter_map(|three| {
        let [before, middle, after] = *three.as_array()?;
        let bend = before - 2.0 * middle + after;
        let is_top = middle >= before && middle >= after && bend < 0.0;
        is_top.then(|| middle - (after - before).powi(2) / (8.0 * bend))
    });
    inner.fold(values[0].max(values[4]), f64::max)
}
