//! A block that slides, or rolls on casters that turn, under both horizontal components of its floor.

use super::{Clearance, Friction, SlidingError, SlidingOptions};
use crate::motion::Motion;
use crate::rocking::{LONGEST_TAIL_S, RockingError, Until};

/// The longest step \[s\].
const LONGEST_STEP_S: f64 = 5e-4;

/// How a floor moves: both horizontal components, and the vertical one where there is one, with the
/// same time step and length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlaneMotion<'a> {
    /// Along x.
    pub x: &'a Motion,
    /// Along y.
    pub y: &'a Motion,
    /// Positive upward.
    pub vertical: Option<&'a Motion>,
}

/// The slide of a block in the plane of its floor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlaneSliding {
    /// Largest distance from where the block stood, as if nothing were in the way \[m\].
    pub peak_m: f64,
    /// Largest distance along each axis of the block, to its negative and to its positive side: what a block with
    /// its sides along these axes needs free there. Towards a wall at right angles to **n** it is max(−**x**·**n**)
    /// from the face of the block \[m\].
    pub farthest_m: [[f64; 2]; 2],
    /// Displacement at the end, along the axes of the block \[m\].
    pub final_m: [f64; 2],
    /// Length of the path \[m\].
    pub path_m: f64,
    /// Largest speed \[m/s\].
    pub speed_max_m_s: f64,
    /// Time at which it first reaches a stop on each axis of the block, and its velocity along that axis there,
    /// signed; `None`: it does not \[s, m/s\].
    pub contacts: [Option<(f64, f64)>; 2],
    /// Speed at the end of the history: 0, unless it ended before the block rested \[m/s\].
    pub final_speed_m_s: f64,
    /// Time at which the history ended \[s\].
    pub end_time_s: f64,
    /// Time at which the floor fell away; `None`: it did not \[s\].
    pub free_flight_time_s: Option<f64>,
}

impl PlaneSliding {
    /// What the block needs free on every side: the largest distance along one of its axes \[m\].
    pub fn room_m(&self) -> f64 {
        self.farthest_m
            .as_flattened()
            .iter()
            .copied()
            .fold(0.0, f64::max)
    }
}

/// Where a block is that slides in the plane of its floor, along its own axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlanePoint {
    /// Time \[s\].
    pub time_s: f64,
    /// Place relative to the floor, from where it stood \[m\].
    pub place_m: [f64; 2],
    /// Velocity relative to the floor \[m/s\].
    pub velocity_m_s: [f64; 2],
    /// Horizontal acceleration of the floor \[m/s²\].
    pub base_accel_m_s2: [f64; 2],
}

/// The slide of a block under both components: **v**′ = −**a** − μ (g + a_v) **v**/|**v**|, and at rest it sticks
/// where |**a**| ≤ μ_s (g + a_v); while it slides, μ is the kinetic one. The clearances of the options
/// are those on both sides of each axis of the block, which is turned by `yaw_rad` from x towards y and does not
/// turn as it slides; the calculation goes on as if nothing were there.
///
/// # Method
/// Steps of at most 0.5 ms within each sample interval: the floor's acceleration at the middle of the
/// step changes the velocity, and friction then shortens it by at most μ (g + a_v) h, or ends it.
///
/// # Accuracy
/// Of the first order where the block starts and stops, of the second in between: under one component
/// within 1 mm and 0.2 % of [`slide`](super::slide), which is exact (`one_component_is_the_exact_slider`).
/// The same slide in any direction of the axes, to rounding.
///
/// # Errors
/// Motions that differ in step or length, and options that are not numbers.
pub fn slide_in_plane(
    motion: PlaneMotion<'_>,
    yaw_rad: f64,
    options: &SlidingOptions,
) -> Result<PlaneSliding, SlidingError> {
    slide_in_plane_observed(motion, yaw_rad, options, |_| ())
}

/// [`slide_in_plane`], which also passes the block at every sample of the motion, and at the end, to `observe`.
///
/// # Errors
/// Those of [`slide_in_plane`].
pub fn slide_in_plane_observed(
    motion: PlaneMotion<'_>,
    yaw_rad: f64,
    options: &SlidingOptions,
    mut observe: impl FnMut(PlanePoint),
) -> Result<PlaneSliding, SlidingError> {
    options.check()?;
    let PlaneMotion { x, y, vertical } = motion;
    let (samples, dt_s) = (x.accel_m_s2().len(), x.dt_s());
    for other in [Some(y), vertical].into_iter().flatten() {
        let (vertical_samples, vertical_dt_s) = (other.accel_m_s2().len(), other.dt_s());
        if (samples, dt_s) != (vertical_samples, vertical_dt_s) {
            return Err(RockingError::VerticalMismatch {
                samples,
                dt_s,
                vertical_samples,
                vertical_dt_s,
            }
            .into());
        }
    }
    let end_s = match options.until {
        Until::EndOfMotion => x.duration_s(),
        Until::Time(end_s) => end_s,
        Until::Settled { at_most_s } => x.duration_s() + at_most_s.min(LONGEST_TAIL_S),
    };
    let parts = (dt_s / LONGEST_STEP_S).ceil().max(1.0);
    let step_s = dt_s / parts;
    let at = |motion: &Motion, index: usize| motion.accel_m_s2().get(index).copied().unwrap_or(0.0);
    let mut slider = Slider::new(options);
    let (sin, cos) = yaw_rad.sin_cos();
    let along = |a_x: f64, a_y: f64| [cos * a_x + sin * a_y, cos * a_y - sin * a_x];
    let mut index = 0;
    while (index as f64) * dt_s < end_s {
        if index >= samples
            && slider.velocity == [0.0; 2]
            && matches!(options.until, Until::Settled { .. })
        {
            break;
        }
        let from = [
            at(x, index),
            at(y, index),
            vertical.map_or(0.0, |motion| at(motion, index)),
        ];
        let to = [
            at(x, index + 1),
            at(y, index + 1),
            vertical.map_or(0.0, |motion| at(motion, index + 1)),
        ];
        observe(slider.point(index as f64 * dt_s, along(from[0], from[1])));
        for part in 0..parts as usize {
            let time_s = index as f64 * dt_s + part as f64 * step_s;
            let share = (part as f64 + 0.5) / parts;
            let [a_x, a_y, a_v] =
                std::array::from_fn(|way| from[way] + (to[way] - from[way]) * share);
            let weight = options.gravity_m_s2 + a_v;
            if weight <= 0.0 {
                slider.result.free_flight_time_s = Some(time_s);
                return Ok(slider.finish());
            }
            slider.step(along(a_x, a_y), weight, time_s, step_s);
        }
        index += 1;
        slider.result.end_time_s = index as f64 * dt_s;
    }
    observe(slider.point(slider.result.end_time_s, along(at(x, index), at(y, index))));
    Ok(slider.finish())
}

struct Slider {
    velocity: [f64; 2],
    place: [f64; 2],
    friction: Friction,
    clearance: Clearance,
    result: PlaneSliding,
}

impl Slider {
    fn new(options: &SlidingOptions) -> Self {
        let result = PlaneSliding {
            peak_m: 0.0,
            farthest_m: [[0.0; 2]; 2],
            final_m: [0.0; 2],
            path_m: 0.0,
            speed_max_m_s: 0.0,
            contacts: [None; 2],
            final_speed_m_s: 0.0,
            end_time_s: 0.0,
            free_flight_time_s: None,
        };
        Self {
            velocity: [0.0; 2],
            place: [0.0; 2],
            friction: options.friction,
            clearance: options.clearance,
            result,
        }
    }

    fn point(&self, time_s: f64, base_accel_m_s2: [f64; 2]) -> PlanePoint {
        PlanePoint {
            time_s,
            place_m: self.place,
            velocity_m_s: self.velocity,
            base_accel_m_s2,
        }
    }

    /// A step under these accelerations of the floor, with this weight per mass.
    fn step(&mut self, accel_m_s2: [f64; 2], weight_m_s2: f64, time_s: f64, step_s: f64) {
        let before = self.velocity;
        let pushed = [0, 1].map(|way| before[way] - accel_m_s2[way] * step_s);
        let speed = pushed[0].hypot(pushed[1]);
        let held = |ratio: f64| ratio * weight_m_s2 * step_s;
        let is_at_rest = before == [0.0; 2];
        // It is at rest, or comes to rest within the step: then it moves on only over the static threshold.
        let is_slow = before[0] * pushed[0] + before[1] * pushed[1] <= 0.0;
        let sticks = is_slow
            && accel_m_s2[0].hypot(accel_m_s2[1]) * step_s <= held(self.friction.static_ratio());
        if is_at_rest && sticks {
            return;
        }
        let held = held(self.friction.kinetic_ratio());
        self.velocity = if sticks || speed <= held {
            [0.0; 2]
        } else {
            pushed.map(|v| v * (1.0 - held / speed))
        };
        let moved = [0, 1].map(|way| 0.5 * (before[way] + self.velocity[way]) * step_s);
        for (place, moved) in self.place.iter_mut().zip(moved) {
            *place += moved;
        }
        let result = &mut self.result;
        result.path_m += moved[0].hypot(moved[1]);
        result.speed_max_m_s = result
            .speed_max_m_s
            .max(self.velocity[0].hypot(self.velocity[1]));
        result.peak_m = result.peak_m.max(self.place[0].hypot(self.place[1]));
        let Clearance { left_m, right_m } = self.clearance;
        for (way, (place, moved)) in self.place.into_iter().zip(moved).enumerate() {
            let [negative, positive] = &mut result.farthest_m[way];
            (*negative, *positive) = (negative.max(-place), positive.max(place));
            let is_beyond = left_m.is_some_and(|room_m| place <= -room_m && moved < 0.0)
                || right_m.is_some_and(|room_m| place >= room_m && moved > 0.0);
            if is_beyond {
                result.contacts[way].get_or_insert((time_s + step_s, moved / step_s));
            }
        }
    }

    fn finish(self) -> PlaneSliding {
        PlaneSliding {
            final_m: self.place,
            final_speed_m_s: self.velocity[0].hypot(self.velocity[1]),
            ..self.result
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::G0_M_S2;
    use crate::rocking::Base;
    use crate::sliding::slide;

    /// A decaying wave of these periods, 0.01 s apart.
    fn wave(peak_g: f64, period_s: f64) -> Motion {
        let sample = |i: usize| {
            let t = 0.01 * i as f64;
            peak_g * G0_M_S2 * (-0.5 * t).exp() * (std::f64::consts::TAU * t / period_s).sin()
        };
        Motion::new(0.01, (0..800).map(sample).collect()).unwrap()
    }

    fn options(ratio: f64, room_m: Option<f64>) -> SlidingOptions {
        of_both(ratio, ratio, room_m)
    }

    fn of_both(static_ratio: f64, kinetic_ratio: f64, room_m: Option<f64>) -> SlidingOptions {
        let friction = Friction::new(static_ratio, kinetic_ratio).unwrap();
        SlidingOptions {
            clearance: Clearance {
                left_m: room_m,
                right_m: room_m,
            },
            until: Until::Settled {
                at_most_s: LONGEST_TAIL_S,
            },
            ..SlidingOptions::new(friction)
        }
    }

    #[test]
    fn one_component_is_the_exact_slider() {
        let still = wave(0.0, 1.0);
        for (peak_g, period_s, ratio, kinetic_ratio) in [
            (0.5, 1.0, 0.2, 0.2),
            (0.9, 0.7, 0.3, 0.3),
            (0.4, 2.0, 0.02, 0.02),
            (0.25, 1.0, 0.3, 0.3),
            (0.5, 1.0, 0.3, 0.2),
            (0.9, 0.7, 0.25, 0.05),
        ] {
            let options = of_both(ratio, kinetic_ratio, Some(0.03));
            let one = wave(peak_g, period_s);
            let exact = slide(
                Base {
                    horizontal: Some(&one),
                    vertical: None,
                },
                &options,
            )
            .unwrap();
            let found = slide_in_plane(
                PlaneMotion {
                    x: &one,
                    y: &still,
                    vertical: None,
                },
                0.0,
                &options,
            )
            .unwrap();
            // As documented.
            let close = |found: f64, exact: f64| (found - exact).abs() <= 1e-3 + 2e-3 * exact.abs();
            assert!(
                close(found.peak_m, exact.peak_m.abs()),
                "{} {}",
                found.peak_m,
                exact.peak_m
            );
            assert!(
                close(found.final_m[0], exact.final_m),
                "{:?} {}",
                found.final_m,
                exact.final_m
            );
            assert!(
                close(found.path_m, exact.path_m),
                "{} {}",
                found.path_m,
                exact.path_m
            );
            assert_eq!(found.final_m[1], 0.0);
            assert_eq!(found.room_m(), found.peak_m);
            assert_eq!(found.contacts[0].is_some(), exact.contact.is_some());
            let contacts = found.contacts[0].zip(exact.contact);
            // A stop is reached within a step: half a millisecond, in which 1 g changes the speed by 5 mm/s.
            assert!(
                contacts.is_none_or(|(found, exact)| (found.0 - exact.0).abs() < 2e-3
                    && (found.1 - exact.1).abs() < 5e-3),
                "{contacts:?}"
            );
        }
    }

    /// Turned axes, and the second component, which makes a block slide farther than the first alone.
    #[test]
    fn the_slide_does_not_depend_on_the_axes() {
        let (first, second) = (wave(0.5, 1.0), wave(0.4, 1.3));
        let found = |x: &Motion, y: &Motion| {
            slide_in_plane(
                PlaneMotion {
                    x,
                    y,
                    vertical: None,
                },
                0.0,
                &options(0.2, None),
            )
            .unwrap()
        };
        let along = found(&first, &second);
        let (sin, cos) = 0.7_f64.sin_cos();
        let mixed = |a: f64, b: f64| {
            let both = first.accel_m_s2().iter().zip(second.accel_m_s2());
            Motion::new(0.01, both.map(|(x, y)| a * x + b * y).collect()).unwrap()
        };
        let turned = found(&mixed(cos, sin), &mixed(-sin, cos));
        // Rounding over 16000 steps.
        for (one, other) in [
            (along.peak_m, turned.peak_m),
            (along.path_m, turned.path_m),
            (
                along.final_m[0].hypot(along.final_m[1]),
                turned.final_m[0].hypot(turned.final_m[1]),
            ),
        ] {
            assert!((one / other - 1.0).abs() < 1e-9, "{one} {other}");
        }
        // The block turned in place of the axes: the same room, between the largest distance and that over √2.
        let both = PlaneMotion {
            x: &first,
            y: &second,
            vertical: None,
        };
        let yawed = slide_in_plane(both, 0.7, &options(0.2, None)).unwrap();
        assert!(
            (yawed.room_m() / turned.room_m() - 1.0).abs() < 1e-9,
            "{yawed:?}"
        );
        assert!(
            (yawed.room_m() / along.room_m() - 1.0).abs() > 0.01,
            "{yawed:?}"
        );
        assert!((0.5_f64.sqrt()..=1.0).contains(&(yawed.room_m() / yawed.peak_m)));
        let still = wave(0.0, 1.0);
        assert!(
            along.peak_m > found(&first, &still).peak_m && along.peak_m > 0.05,
            "{along:?}"
        );
    }
}
