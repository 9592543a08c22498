//! Velocity pulses of forward directivity, in the worlds of a place near a fault.
//!
//! A world has a pulse with the probability of Shahi and Baker (2011), which depends on the distance and on how far
//! the rupture runs towards the place. Its ground motion is then a motion of the target, to which a pulse
//! is added in one direction, so large that together they have the spectrum that such motions have in the mean. Worlds
//! without a pulse have a spectrum that is a little lower at long periods, because the records behind a hazard have some
//! pulses among them ([`without_pulse_ratio`]).
//!
//! A target that is raised for near faults already, such as that of NZS 1170.5 with N(T, D), is the mean over all worlds:
//! all motions are then matched to a spectrum that is lower by what the pulses add, so that they are not counted twice.

use std::f64::consts::{FRAC_PI_4, TAU};

use rand::RngExt;
use rand_distr::{Beta, Distribution, StandardNormal};

use super::ground::{Component, Deviation};
use super::streams::{Group, world_stream};
use super::{WorldError, within};
use crate::G0_M_S2;
use crate::fragility::uniform_draw;
use crate::oscillator::{DAMPING_RATIO, response_spectrum};
use crate::synthesis::{LONGEST_PERIOD_S, SynthesisError, VelocityPulse, matched_periods_s};

/// The distance to a fault from which worlds have no pulses \[m\]: the law is not used farther away. There it gives a
/// pulse to 0.05 % of earthquakes of magnitude 7, less than 1 % of 7.5, but 10 % of 7.8 and 25 % of 8.
pub const FARTHEST_PULSE_M: f64 = 50e3;
/// The largest distance to a fault that is accepted \[m\].
pub const MOST_FAULT_DISTANCE_M: f64 = 1e6;
/// The magnitudes among which that of the earthquake is drawn, uniformly, if none is given.
pub const FAULT_MAGNITUDES: (f64, f64) = (6.5, 7.0);
/// The magnitudes that are accepted: those of the earthquakes behind the laws, to half a unit.
pub const ACCEPTED_FAULT_MAGNITUDES: (f64, f64) = (5.0, 8.5);
/// The longest period of a pulse \[s\]: longer ones are not told from the drift of a record, and at γ = 3.2 would not
/// fit into 40 s of shaking.
const LONGEST_PULSE_S: f64 = 10.0;
/// γ: its least and its largest value, and the parameters of the beta distribution between them.
const CYCLES: (f64, f64) = (2.0, 3.2);
const CYCLES_BETA: (f64, f64) = (1.303, 3.969);
/// γ that a sixth, a half and five sixths of all pulses stay below.
const CYCLES_AT: [f64; 3] = [2.092, 2.257, 2.506];
/// The period over that of the pulse at which spectra of pulses are highest.
const PEAK_RATIO: f64 = 0.88;
/// The standard deviation of the logarithm of the period.
const PERIOD_SPREAD: f64 = 0.56;
/// Steps of the integrals over the magnitude, over the length of the rupture and over the period.
const MAGNITUDE_STEPS: usize = 5;
const RUPTURE_STEPS: usize = 100;
const PERIOD_STEPS: usize = 24;
/// How often the spectrum that the motions are matched to is corrected by itself: the second time changes it by less
/// than 0.02.
const PASSES: usize = 3;

/// A fault near the place, on which the earthquake happens.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearFault {
    distance_m: f64,
    magnitude: Option<f64>,
    is_in_target: bool,
}

impl NearFault {
    /// A fault at its closest distance \[m\]; without a magnitude each world draws one of [`FAULT_MAGNITUDES`].
    ///
    /// # Errors
    /// A distance outside 0 to 1000 km, a magnitude outside 5 to 8.5.
    pub fn new(distance_m: f64, magnitude: Option<f64>) -> Result<Self, WorldError> {
        within(
            "the distance to the fault in m",
            MOST_FAULT_DISTANCE_M,
            distance_m,
        )?;
        if let Some(magnitude) = magnitude {
            let (least, most) = ACCEPTED_FAULT_MAGNITUDES;
            within("the magnitude less 5", most - least, magnitude - least)?;
        }
        Ok(Self {
            distance_m,
            magnitude,
            is_in_target: false,
        })
    }

    /// The same fault where the target spectrum has its pulses, as N(T, D) of NZS 1170.5 brings them in.
    #[must_use]
    pub fn in_target(self) -> Self {
        Self {
            is_in_target: true,
            ..self
        }
    }

    /// Its closest distance \[m\].
    pub fn distance_m(&self) -> f64 {
        self.distance_m
    }

    /// The magnitude, if it was given.
    pub fn magnitude(&self) -> Option<f64> {
        self.magnitude
    }

    /// The share of the worlds that have a pulse: 0 from [`FARTHEST_PULSE_M`] on.
    pub fn pulse_share(&self) -> f64 {
        if self.distance_m >= FARTHEST_PULSE_M {
            return 0.0;
        }
        self.magnitudes()
            .map(|magnitude| self.share_at(magnitude))
            .sum::<f64>()
            / self.magnitudes().count() as f64
    }

    /// Magnitudes of equal weight.
    fn magnitudes(&self) -> impl Iterator<Item = f64> + use<> {
        let (low, high) = self
            .magnitude
            .map_or(FAULT_MAGNITUDES, |given| (given, given));
        let steps = if low == high { 1 } else { MAGNITUDE_STEPS };
        (0..steps).map(move |i| low + (high - low) * (i as f64 + 0.5) / steps as f64)
    }

    /// The share of earthquakes of a magnitude that bring a pulse: place and hypocentre lie anywhere along the
    /// rupture, so that s = L |x − y|, with x and y uniform, has the density 2 (L − s)/L².
    fn share_at(&self, magnitude: f64) -> f64 {
        let length_km = rupture_length_km(magnitude);
        let at = |i: usize| {
            let share = (i as f64 + 0.5) / RUPTURE_STEPS as f64;
            2.0 * (1.0 - share) * pulse_probability(self.distance_m / 1e3, share * length_km)
        };
        (0..RUPTURE_STEPS).map(at).sum::<f64>() / RUPTURE_STEPS as f64
    }
}

/// The probability of a pulse, from strike-slip earthquakes: 1/(1 + e^(0.642 + 0.167 r − 0.075 s)), with the closest
/// distance r and the length s of the rupture from the epicentre towards the place, both in km.
///
/// # Reference
/// Shahi and Baker (2011), "An empirically calibrated framework for including the effects of near-fault directivity in
/// probabilistic seismic hazard analysis", BSSA 101(2), 742–755; also PEER 2013/15, Eq. (2.6). Read in a public program
/// that cites that equation.
///
/// # Example
/// ```
/// use freestand::worlds::pulse_probability;
/// assert!((pulse_probability(5.0, 40.0) - 0.821).abs() < 1e-3); // 1/(1 + e^−1.523)
/// ```
pub fn pulse_probability(distance_km: f64, rupture_km: f64) -> f64 {
    1.0 / (1.0 + (0.642 + 0.167 * distance_km - 0.075 * rupture_km).exp())
}

/// The median period of pulses, e^(−5.73 + 0.99 M) \[s\]; the standard deviation of its logarithm is 0.56.
///
/// # Reference
/// Shahi and Baker (2011), as [`pulse_probability`]; the standard deviation is recalled.
pub fn pulse_period_s(magnitude: f64) -> f64 {
    (-5.73 + 0.99 * magnitude).exp()
}

/// Surface rupture length of strike-slip earthquakes, 10^(−3.55 + 0.74 M) \[km\].
///
/// # Reference
/// Wells and Coppersmith (1994), BSSA 84(4), Table 2A; read in a public program.
pub fn rupture_length_km(magnitude: f64) -> f64 {
    10_f64.powf(-3.55 + 0.74 * magnitude)
}

/// Spectral acceleration with the pulse over that of the motion without it, in the direction of the pulse, at a
/// period over that of the pulse: the median, up to 3.28 at 0.88.
///
/// ln A = 1.131 e^(−3.11 (ln x + 0.127)²) + 0.058 up to x = 0.88, 0.924 e^(−2.11 (ln x + 0.127)²) + 0.255 above
///
/// # Reference
/// Shahi and Baker (2011), as [`pulse_probability`]; recalled. The two branches meet at 0.88 to within 0.01, as they
/// must.
pub fn pulse_amplification_ratio(period_ratio: f64) -> f64 {
    let away = (period_ratio.ln() + 0.127).powi(2);
    if period_ratio <= PEAK_RATIO {
        (1.131 * (-3.11 * away).exp() + 0.058).exp()
    } else {
        (0.924 * (-2.11 * away).exp() + 0.255).exp()
    }
}

/// Spectral acceleration of motions near a fault without a pulse over that of a hazard that does not know of pulses: the
/// median, 1 up to 1 s and from 20 km on, at least 0.82.
///
/// ln D = max(−0.0905 ln T, −0.198) g h, g = 2 (M − 6) from 0 to 1, h = 1 − r/(20 km), for T above 1 s
///
/// # Reference
/// Shahi and Baker (2011), as [`pulse_probability`]; recalled.
pub fn without_pulse_ratio(period_s: f64, magnitude: f64, distance_m: f64) -> f64 {
    let of_magnitude = (2.0 * (magnitude - 6.0)).clamp(0.0, 1.0);
    let of_distance = (1.0 - distance_m / 20e3).max(0.0);
    let ln = (-0.0905 * period_s.max(1.0).ln()).max(-0.198);
    (ln * of_magnitude * of_distance).exp()
}

/// The pulse of a world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WorldPulse {
    /// Its shape.
    pub shape: VelocityPulse,
    /// Its direction from the first axis of the building \[rad\].
    pub direction_rad: f64,
}

impl WorldPulse {
    /// Its part along a component, from −1 to 1: pulses are horizontal.
    pub fn part(&self, component: Component) -> f64 {
        match component {
            Component::X => self.direction_rad.cos(),
            Component::Y => self.direction_rad.sin(),
            Component::Vertical => 0.0,
        }
    }

    /// Its amplitude over motions with this spectrum \[g\] in its direction: added to them as independent motions
    /// are, it gives them [`pulse_amplification_ratio`] at 0.88 of its period, or at the longest matched period where
    /// that is shorter \[m/s\].
    ///
    /// # Errors
    /// A spectrum that is no number.
    pub fn amplitude_m_s(&self, sa_g: impl Fn(f64) -> f64) -> Result<f64, SynthesisError> {
        let period_s = calibrated_at_s(self.shape.period_s);
        let alone = response_spectrum(&self.shape.alone()?, DAMPING_RATIO, &[period_s])?;
        let of_unit_m_s2: f64 = alone.psa_m_s2.iter().sum();
        let sa_g = sa_g(period_s);
        if !(sa_g > 0.0 && sa_g.is_finite()) {
            return Err(SynthesisError::Target { period_s, sa_g });
        }
        Ok(added_ratio(self.shape.period_s) * sa_g * G0_M_S2 / of_unit_m_s2)
    }
}

/// The period at which a pulse is calibrated \[s\].
fn calibrated_at_s(pulse_s: f64) -> f64 {
    (PEAK_RATIO * pulse_s).min(LONGEST_PERIOD_S)
}

/// Spectral acceleration of a pulse alone over that of the motion that it is added to, where it is calibrated.
fn added_ratio(pulse_s: f64) -> f64 {
    let amplification = pulse_amplification_ratio(calibrated_at_s(pulse_s) / pulse_s);
    (amplification * amplification - 1.0).sqrt()
}

/// The pulses of all worlds near a fault.
#[derive(Debug, Clone, PartialEq)]
pub struct Pulses {
    fault: NearFault,
    /// ln of the spectrum over the target to which motions are matched, those of worlds without a pulse, or all of them
    /// where the target has the pulses.
    lowered: Deviation,
}

impl Pulses {
    /// The pulses near a fault, where the horizontal target is `target_sa_g` (period \[s\] to g); `None`: the fault
    /// is so far that no world has one.
    ///
    /// # Errors
    /// A spectrum that cannot be calculated.
    pub fn new(
        fault: NearFault,
        target_sa_g: impl Fn(f64) -> f64,
    ) -> Result<Option<Self>, SynthesisError> {
        if fault.pulse_share() == 0.0 {
            return Ok(None);
        }
        let periods_s = matched_periods_s();
        let without = |&t: &f64| {
            let magnitudes = fault.magnitudes();
            let ln = magnitudes.map(|m| without_pulse_ratio(t, m, fault.distance_m).ln());
            ln.sum::<f64>() / fault.magnitudes().count() as f64
        };
        if !fault.is_in_target {
            let lowered = Deviation::new(periods_s.iter().map(without).collect());
            return Ok(Some(Self { fault, lowered }));
        }
        let shapes = shapes()?;
        let lowered = Deviation::new(vec![0.0; periods_s.len()]);
        let mut pulses = Self { fault, lowered };
        for _ in 0..PASSES {
            let raised = pulses.raised(&shapes, |t| pulses.lowered.sa_g(t, target_sa_g(t)));
            pulses.lowered = Deviation::new(raised.into_iter().map(|ln| -ln).collect());
        }
        Ok(Some(pulses))
    }

    /// The spectrum to which the motion of a world is matched before its pulse is added, where the target is
    /// `target_sa_g` \[g\].
    pub fn under_sa_g(&self, pulse: Option<&WorldPulse>, period_s: f64, target_sa_g: f64) -> f64 {
        if pulse.is_some() && !self.fault.is_in_target {
            return target_sa_g;
        }
        self.lowered.sa_g(period_s, target_sa_g)
    }

    /// The mean over worlds of ln of a component with its pulse over the same without it, at the matched periods:
    /// ½ ln(1 + k cos²θ) of a pulse whose spectrum is √k of that of the motion, which over all directions θ has the
    /// mean ln((1 + √(1 + k))/2).
    fn raised(&self, shapes: &[Shape], sa_g: impl Fn(f64) -> f64) -> Vec<f64> {
        let periods_s = matched_periods_s();
        let motion_g: Vec<f64> = periods_s.iter().map(|&t| sa_g(t)).collect();
        let mut raised = vec![0.0; periods_s.len()];
        let magnitudes: Vec<f64> = self.fault.magnitudes().collect();
        let normals = (0..=PERIOD_STEPS).map(|i| -3.0 + 6.0 * i as f64 / PERIOD_STEPS as f64);
        let normals: Vec<(f64, f64)> = normals.map(|z| (z, (-0.5 * z * z).exp())).collect();
        let all: f64 = normals.iter().map(|(_, weight)| weight).sum();
        for &magnitude in &magnitudes {
            let share = self.fault.share_at(magnitude) / magnitudes.len() as f64;
            for &(normal, weight) in &normals {
                let pulse_s = drawn_period_s(magnitude, normal);
                let at_s = calibrated_at_s(pulse_s);
                let added = added_ratio(pulse_s) * sa_g(at_s);
                let weight = share * weight / all / shapes.len() as f64;
                for shape in shapes {
                    let unit = added / shape.at(at_s / pulse_s);
                    for ((raised, &t), motion_g) in raised.iter_mut().zip(&periods_s).zip(&motion_g)
                    {
                        let k = (unit * shape.at(t / pulse_s) / motion_g).powi(2);
                        *raised += weight * (0.5 * (1.0 + (1.0 + k).sqrt())).ln();
                    }
                }
            }
        }
        raised
    }

    /// The pulse of a world, if it has one; `repetition` is 0, or 1 and more where the motion is drawn again.
    ///
    /// All random numbers are drawn in one order: the magnitude, the place and the hypocentre along the rupture,
    /// whether there is a pulse, its period, its cycles, its phase and its direction.
    pub fn draw(&self, seed: u64, world: u32, repetition: u32) -> Option<WorldPulse> {
        let (pulse, has_it) = self.drawn(seed, world, repetition);
        has_it.then_some(pulse)
    }

    /// The pulse that a world would have, and whether it has it.
    fn drawn(&self, seed: u64, world: u32, repetition: u32) -> (WorldPulse, bool) {
        let mut random = world_stream(seed, world, Group::Pulse, repetition);
        let (low, high) = FAULT_MAGNITUDES;
        let drawn = uniform_draw(&mut random, low, high);
        let magnitude = self.fault.magnitude.unwrap_or(drawn);
        let [place, hypocentre, chance]: [f64; 3] = random.random();
        let rupture_km = rupture_length_km(magnitude) * (place - hypocentre).abs();
        let normal: f64 = StandardNormal.sample(&mut random);
        let (first, second) = CYCLES_BETA;
        // Both parameters are positive, which is all that can be wrong with them.
        let share = Beta::new(first, second).map_or(0.5, |beta| beta.sample(&mut random));
        let pulse = WorldPulse {
            shape: VelocityPulse {
                period_s: drawn_period_s(magnitude, normal),
                cycles: CYCLES.0 + (CYCLES.1 - CYCLES.0) * share,
                phase_rad: uniform_draw(&mut random, 0.0, TAU),
            },
            direction_rad: uniform_draw(&mut random, 0.0, TAU),
        };
        (
            pulse,
            chance < pulse_probability(self.fault.distance_m / 1e3, rupture_km),
        )
    }
}

/// The period of a pulse this many standard deviations from the median \[s\].
fn drawn_period_s(magnitude: f64, normal: f64) -> f64 {
    (pulse_period_s(magnitude) * (PERIOD_SPREAD * normal).exp()).min(LONGEST_PULSE_S)
}

/// The spectrum of a pulse alone against the period over its own, with any unit.
struct Shape {
    ln_ratios: Vec<f64>,
    ln_psa: Vec<f64>,
}

/// The least and the largest period over that of the pulse, and the number of them.
const SHAPE: (f64, f64, usize) = (0.05, 20.0, 49);

impl Shape {
    fn of(pulse: VelocityPulse) -> Result<Self, SynthesisError> {
        let (low, high, count) = SHAPE;
        let ratio = |i: usize| low * (high / low).powf(i as f64 / (count - 1) as f64);
        let ratios: Vec<f64> = (0..count).map(ratio).collect();
        let periods_s: Vec<f64> = ratios.iter().map(|ratio| ratio * pulse.period_s).collect();
        let spectrum = response_spectrum(&pulse.alone()?, DAMPING_RATIO, &periods_s)?;
        Ok(Self {
            ln_ratios: ratios.into_iter().map(f64::ln).collect(),
            ln_psa: spectrum.psa_m_s2.into_iter().map(f64::ln).collect(),
        })
    }

    /// Constant below the least period: the oscillators there move with the ground.
    fn at(&self, period_ratio: f64) -> f64 {
        let last = self.ln_ratios.len() - 1;
        let step = (self.ln_ratios[last] - self.ln_ratios[0]) / last as f64;
        let along = ((period_ratio.ln() - self.ln_ratios[0]) / step).clamp(0.0, last as f64);
        let below = (along as usize).min(last - 1);
        let (low, high) = (self.ln_psa[below], self.ln_psa[below + 1]);
        (low + (high - low) * (along - below as f64)).exp()
    }
}

/// Pulses of equal weight: three lengths, and four phases, of which those beyond π only have the other sign.
fn shapes() -> Result<Vec<Shape>, SynthesisError> {
    let mut all = Vec::new();
    for cycles in CYCLES_AT {
        for quarter in 0..4 {
            all.push(Shape::of(VelocityPulse {
                period_s: 1.0,
                cycles,
                phase_rad: f64::from(quarter) * FRAC_PI_4,
            })?);
        }
    }
    Ok(all)
}

#[cfg(test)]
mod tests;
