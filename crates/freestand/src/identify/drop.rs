//! The evaluation of one drop test, from samples to a law.

use super::contact::{self, Pulse, smooth_peak};
use super::direct::{Flank, Touch};
use super::filter::Poles;
use super::fit::{Data, Fit, Measured};
use super::laws::{candidate, damping_ratio, law_of};
use super::model::Elastic;
use super::{
    DropError, DropSetup, DropTest, FittedLaw, Flag, Identified, ImpactVelocity, LoopPoint,
    StiffnessEstimates,
};

/// Samples per contact below which a record gives no stiffness. The contact time is accurate to one
/// or two hundredths.
const MIN_SAMPLES: f64 = 24.5;
/// The flanks alone give a contact that is up to a fifth too short where the law has a root at its
/// beginning (Hertz).
const ROUGH_SHARE: f64 = 0.8;
/// Smallest product of low-pass corner and contact time: a two-pole filter at 3 lowers the stiffness of a fit that
/// ignores it by up to 5 %.
const MIN_CORNER: f64 = 6.0;
/// Below this product a filter that nobody stated is looked for. At 6 it lowers the stiffness of a curve that is fitted
/// without it by 2 to 7 %, at 12, as the square of the product, by a quarter of that.
const LOOKED_FOR_CORNER: f64 = 12.0;
/// Above this product a filter does nothing but delay the pulse.
const FREE_CORNER: f64 = 30.0;
/// −2 ln of the probability of the samples by which a law outweighs a simpler one: a factor of 20.
const OUTWEIGHED: f64 = 6.0;
/// The gain above which the weight is assumed not to act. With a stated velocity and peaks up to
/// 75 g the gain is −3 or less for pulses with weight, and +3 or more for pulses without it; above
/// 75 g the two cannot be told apart, and the weight is assumed to act.
const LIKELY: f64 = 3.0;
/// The reduction in the sum of squares that a clipped top must bring: five standard deviations.
const CLEARLY_CUT: f64 = 25.0;
/// The gain, of either sign, above which the choice counts as certain: four standard deviations.
const DECISIVE: f64 = 16.0;
/// A zero line that is wrong by more than this share of the peak gives no stiffness.
const HOPELESS_SHIFT: f64 = 0.05;
/// Above this share of the peak the residual of a law is not noise.
const POOR_RESIDUAL: f64 = 0.01;
/// Standard deviation of ln v in the prior of an unknown velocity.
const UNKNOWN_SPEED: f64 = 0.5;
/// Residuals are more than noise above this sum of squares per sample, if they are also above this share of the peak:
/// twice the noise, and more than the ringing of a good sensor.
const POOR_CHI: f64 = 4.0;
const VISIBLE_RESIDUAL: f64 = 2e-3;
/// The integrated stiffness differs from the fit by more standard deviations than chance and by more than the flank
/// of an unknown curve explains.
const APART_ERRORS: f64 = 3.0;
const APART: f64 = 0.03;
/// Smallest standard deviation of ln k: numerical accuracy, rounding of printed samples, and the
/// clock of the recorder.
const FLOOR: f64 = 1e-3;
/// The same of a curve without a formula, whose straight pieces let samples without noise tell the velocity better than
/// it is known: of a pad that nearly bottoms, errors of 0.4 % were found.
const CURVE_FLOOR: f64 = 4e-3;

/// Smallest number of samples of a record.
const MIN_RECORD: usize = 20;
/// A restitution that is above 1 by less than this is 1: the integral of 50 samples with noise is
/// accurate to some per cent.
const ROUNDING: f64 = 0.05;

/// Identifies the cushion under a mass that fell on it.
///
/// **Method**: the contact is found above 5 standard deviations of the noise before it; the zero
/// line is the mean before the contact. The pulses of F = kd, Kdⁿ, kd + cḋ, Kdⁿ(1 + Λḋ), kd + k₃d³ and
/// of a curve without a formula are fitted to the samples by least squares over first contact, impact
/// velocity, zero line and the parameters of the law, each behind the filter of the instrument. The
/// simplest law that no other outweighs is chosen; the differences to the others, weighted by how
/// likely they are, are part of the error. Known values of impact velocity and zero line are priors, so
/// the pulse can correct a wrong height. The compression is the double integral over the contact alone.
/// F/d of the samples integrated from the touch that their own flank shows is a check without a law.
///
/// **Stiffness**: the secant F/d of the elastic force at the largest compression. Of a pad that hardens
/// or softens it holds for this drop alone; the tangent at the origin is reported with it.
///
/// **Units**: samples in m/s², upward positive.
///
/// # Accuracy
/// From a noise-free record of 50 samples per contact, for each of the four laws with its weight,
/// the secant is recovered to 1e-3.
///
/// # Reference
/// Tierney and Kadane (1986) for the weights of the laws, by the method of Laplace.
///
/// # Errors
/// A mass, time step or velocity that is not positive, fewer than 20 samples, or a sample that is
/// not a number. A record that gives no stiffness is not an error: it has flags and no law.
///
/// # Example
/// A half-sine of 349.8 g and 1.2826 ms: m(π/t_c)² = 2190 N/mm.
/// ```
/// use freestand::identify::{DropSetup, ImpactVelocity, drop_test};
/// let (mass_kg, speed_m_s, omega) = (0.365, 1.400475, (2.19e6_f64 / 0.365).sqrt());
/// let pulse = |i: i32| {
///     let t = f64::from(i - 40) * 20e-6;
///     let is_contact = t > 0.0 && omega * t < std::f64::consts::PI;
///     if is_contact { speed_m_s * omega * (omega * t).sin() } else { 0.0 }
/// };
/// let samples: Vec<f64> = (0..200).map(pulse).collect();
/// let impact_velocity = ImpactVelocity::Known { speed_m_s, error_ratio: 0.01 };
/// let gravity_m_s2 = 9.80665;
/// let setup = DropSetup { mass_kg, impact_velocity, gravity_m_s2, filter_corner_hz: None, law: None };
/// let test = drop_test(&samples, 20e-6, &setup)?;
/// let stiffness_n_m = test.identified.map(|found| found.stiffness.fit_n_m).unwrap_or_default();
/// assert!((stiffness_n_m / 2.19e6 - 1.0).abs() < 0.005 && test.flags.is_empty());
/// # Ok::<(), freestand::identify::DropError>(())
/// ```
pub fn drop_test(
    samples_m_s2: &[f64],
    dt_s: f64,
    setup: &DropSetup,
) -> Result<DropTest, DropError> {
    check(samples_m_s2, dt_s, setup)?;
    let pulse = match contact::find(samples_m_s2) {
        Ok(pulse) => pulse,
        Err(flag) => return Ok(DropTest::nothing(flag)),
    };
    let accel: Vec<f64> = samples_m_s2.iter().map(|a| a - pulse.zero_m_s2).collect();
    let contact = Contact::new(&accel, dt_s, setup, &pulse);
    let mut test = DropTest::nothing(Flag::NoPulse);
    test.flags = pulse.flags.clone();
    test.peak_acceleration_m_s2 = Some(contact.peak_m_s2);
    test.noise_ratio = Some(pulse.noise_m_s2 / contact.peak_m_s2);
    test.zero_shift_ratio = pulse.zero_shift_ratio;
    test.contact_time_s = Some(contact.rough_s);
    test.impact_velocity_m_s = contact.known_speed();
    contact.judge(&mut test);
    if !is_hopeless(&test)
        && let Some(choice) = contact.choose()
    {
        contact.report(choice, &mut test);
        if test
            .contact_time_s
            .is_some_and(|time_s| time_s < MIN_SAMPLES * dt_s)
        {
            test.flags.push(Flag::FewSamples);
            test.identified = None;
        }
    }
    if test.identified.is_none() && test.flags.is_empty() {
        test.flags.push(Flag::PoorFit);
    }
    test.samples_per_contact = test.contact_time_s.map(|time_s| time_s / dt_s);
    let shown_hz = test
        .identified
        .as_ref()
        .and_then(|found| found.filter_corner_hz);
    if let (Some(corner_hz), Some(time_s)) =
        (setup.filter_corner_hz.or(shown_hz), test.contact_time_s)
        && corner_hz * time_s < MIN_CORNER
    {
        test.flags.push(Flag::Filter);
    }
    Ok(test)
}

/// One drop of a record with several.
#[derive(Debug, Clone, PartialEq)]
pub struct DropOfRecord {
    /// Its time from the first sample of the record, where its pulse has risen to a fifth of the
    /// largest pulse \[s\]; `None` if there is no pulse.
    pub start_time_s: Option<f64>,
    /// Its evaluation.
    pub test: DropTest,
}

/// Identifies the cushion from every drop of a record, each as [`drop_test`] does from a record of
/// its own.
///
/// **Method**: a later pulse is a bounce of the drop before it if its flight T gives e = gT/(2v) ≤ 1
/// and it is weaker than the pulse of that drop; otherwise it is a drop. Without a stated velocity v
/// is the impulse less gT/2. A drop gets the samples up to the middle between it and its neighbours.
///
/// # Limitation
/// A pulse below a fifth of the largest one is a bounce or handling, never a drop: drops from very
/// different heights belong in files of their own.
///
/// # Errors
/// As [`drop_test`].
pub fn drop_tests(
    samples_m_s2: &[f64],
    dt_s: f64,
    setup: &DropSetup,
) -> Result<Vec<DropOfRecord>, DropError> {
    check(samples_m_s2, dt_s, setup)?;
    let speed_m_s = match setup.impact_velocity {
        ImpactVelocity::Known { speed_m_s, .. } => Some(speed_m_s),
        ImpactVelocity::FromImpulse => None,
    };
    let parts = contact::parts(samples_m_s2, dt_s, speed_m_s);
    if parts.len() < 2 {
        let start_time_s = parts.first().map(|part| part.start as f64 * dt_s);
        return Ok(vec![DropOfRecord {
            start_time_s,
            test: drop_test(samples_m_s2, dt_s, setup)?,
        }]);
    }
    let one = |part: contact::Part| {
        let samples = samples_m_s2.get(part.samples).unwrap_or_default();
        // Too short to hold a zero line and a contact.
        let test = match samples.len() < MIN_RECORD {
            true => DropTest::nothing(Flag::NoPreTrigger),
            false => drop_test(samples, dt_s, setup)?,
        };
        Ok(DropOfRecord {
            start_time_s: Some(part.start as f64 * dt_s),
            test,
        })
    };
    parts.into_iter().map(one).collect()
}

/// A restitution, which is at most 1: up to [`ROUNDING`] above, it is 1 with the error of the record;
/// beyond that, the record or its velocity is wrong, and there is none.
fn physical(restitution_ratio: f64) -> Option<f64> {
    (restitution_ratio <= 1.0 + ROUNDING).then(|| restitution_ratio.min(1.0))
}

fn check(samples: &[f64], dt_s: f64, setup: &DropSetup) -> Result<(), DropError> {
    let positive = |name, value: f64| {
        if value > 0.0 && value.is_finite() {
            Ok(())
        } else {
            Err(DropError::NotPositive { name, value })
        }
    };
    positive("mass", setup.mass_kg)?;
    positive("time step", dt_s)?;
    if let ImpactVelocity::Known {
        speed_m_s,
        error_ratio,
    } = setup.impact_velocity
    {
        positive("impact velocity", speed_m_s)?;
        positive("error of the impact velocity", error_ratio)?;
    }
    if samples.len() < MIN_RECORD {
        return Err(DropError::TooShort {
            samples: samples.len(),
        });
    }
    match samples.iter().position(|a| !a.is_finite()) {
        Some(index) => Err(DropError::NotFinite { number: index + 1 }),
        None => Ok(()),
    }
}

/// Whether the flags so far rule out a stiffness.
fn is_hopeless(test: &DropTest) -> bool {
    let shift = test.zero_shift_ratio.unwrap_or(0.0).abs();
    let fatal = [Flag::CutOff, Flag::Clipped, Flag::FewSamples, Flag::Impulse];
    shift > HOPELESS_SHIFT || test.flags.iter().any(|flag| fatal.contains(flag))
}

impl DropTest {
    fn nothing(flag: Flag) -> Self {
        Self {
            impact_velocity_m_s: None,
            peak_acceleration_m_s2: None,
            contact_time_s: None,
            max_compression_m: None,
            restitution_ratio: None,
            restitution_bounce_ratio: None,
            energy_lost_ratio: None,
            identified: None,
            samples_per_contact: None,
            zero_shift_ratio: None,
            noise_ratio: None,
            flags: vec![flag],
            points: Vec::new(),
        }
    }
}

/// A contact in a record.
struct Contact<'a> {
    accel: &'a [f64],
    dt_s: f64,
    setup: &'a DropSetup,
    pulse: &'a Pulse,
    peak_m_s2: f64,
    /// Duration between the threshold crossings, extrapolated to zero along the flanks.
    rough_s: f64,
    /// ∫a dt over the contact \[m/s\].
    impulse_m_s: f64,
}

/// The law that was chosen, and the others.
struct Choice {
    best: Fit,
    others: Vec<Fit>,
    has_gravity: bool,
    /// ln k with gravity less ln k without it, where the record cannot decide.
    gravity_error: f64,
}

/// Where an integration begins.
struct Start {
    touch_s: f64,
    speed_m_s: f64,
    /// The force over mass at the touch, which jumps on a damped pad.
    jump_m_s2: f64,
}

/// A stiffness without a law.
struct Integrated {
    secant_n_m: f64,
    /// Standard deviation of its logarithm.
    error_ratio: f64,
}

impl<'a> Contact<'a> {
    fn new(accel: &'a [f64], dt_s: f64, setup: &'a DropSetup, pulse: &'a Pulse) -> Self {
        let inside = &accel[pulse.before..pulse.after.min(accel.len())];
        let impulse_m_s = inside.iter().sum::<f64>() * dt_s;
        Self {
            accel,
            dt_s,
            setup,
            pulse,
            peak_m_s2: smooth_peak(inside),
            rough_s: rough_contact(accel, pulse) * dt_s,
            impulse_m_s,
        }
    }

    fn known_speed(&self) -> Option<f64> {
        match self.setup.impact_velocity {
            ImpactVelocity::Known { speed_m_s, .. } => Some(speed_m_s),
            ImpactVelocity::FromImpulse => None,
        }
    }

    /// Checks that need no law.
    fn judge(&self, test: &mut DropTest) {
        if self.rough_s < ROUGH_SHARE * MIN_SAMPLES * self.dt_s {
            test.flags.push(Flag::FewSamples);
        }
        if let Some(speed) = self.known_speed() {
            // (1 + e) v₀, plus the possible effect of gravity and a tenth for noise and a wrong
            // height.
            let given_m_s = self.impulse_m_s;
            let weight_m_s = self.setup.gravity_m_s2 * self.rough_s;
            if given_m_s < 0.9 * speed || given_m_s > 2.2 * speed + weight_m_s {
                test.flags.push(Flag::Impulse);
            }
        }
    }

    fn data(&self, gravity_m_s2: f64) -> Data<'_> {
        let contact = self.rough_s / self.dt_s;
        let margin = (0.25 * contact).ceil() as usize + 2;
        let from = self.pulse.before.saturating_sub(margin);
        let to = (self.pulse.after + margin / 2).min(self.accel.len());
        let shift_m_s2 = self.pulse.zero_shift_ratio.unwrap_or(0.0) * self.peak_m_s2;
        let is_shifted = self.pulse.flags.contains(&Flag::ZeroShift);
        let mean_error = self.pulse.noise_m_s2 / (self.pulse.pre_count as f64).sqrt();
        let (speed_m_s, speed_error_ratio) = match self.setup.impact_velocity {
            ImpactVelocity::Known {
                speed_m_s,
                error_ratio,
            } => (speed_m_s, error_ratio),
            ImpactVelocity::FromImpulse => (0.53 * self.impulse_m_s, UNKNOWN_SPEED),
        };
        Data {
            mass_kg: self.setup.mass_kg,
            gravity_m_s2,
            dt_s: self.dt_s,
            accel_m_s2: &self.accel[from..to],
            peak_m_s2: self.peak_m_s2,
            noise_m_s2: self.pulse.noise_m_s2,
            corner_hz: self.setup.filter_corner_hz,
            poles: Poles::Two,
            zero_error_m_s2: mean_error
                + if is_shifted {
                    0.5 * shift_m_s2.abs()
                } else {
                    0.0
                },
            speed_m_s,
            speed_error_ratio,
            touch: (self.pulse.before - from) as f64 + 0.5,
            contact,
        }
    }

    /// Fits every law with and without gravity, and chooses the simplest that no other outweighs.
    fn choose(&self) -> Option<Choice> {
        let gravity = self.setup.gravity_m_s2;
        let with = self.fits(gravity);
        if gravity == 0.0 {
            let (best, others) = self.simplest(self.with_filters(with, 0.0))?;
            return Some(Choice {
                best,
                others,
                has_gravity: false,
                gravity_error: 0.0,
            });
        }
        let (best, _) = self.simplest(with.clone())?;
        let without = self.fits(0.0);
        let Some((best_without, _)) = self.simplest(without.clone()) else {
            let (best, others) = self.simplest(self.with_filters(with, gravity))?;
            return Some(Choice {
                best,
                others,
                has_gravity: true,
                gravity_error: 0.0,
            });
        };
        let scale = (best.chi_squared.min(best_without.chi_squared) / best.degrees).max(1.0);
        let gain = best.unlikeliness(scale) - best_without.unlikeliness(scale);
        let apart = (best.secant_n_m / best_without.secant_n_m).ln().abs();
        let gravity_error = if gain.abs() > DECISIVE { 0.0 } else { apart };
        let has_gravity = gain <= LIKELY;
        let all = if has_gravity {
            self.with_filters(with, gravity)
        } else {
            self.with_filters(without, 0.0)
        };
        let (best, others) = self.simplest(all)?;
        Some(Choice {
            best,
            others,
            has_gravity,
            gravity_error,
        })
    }

    /// Every law behind the stated filter; those that are not wanted show how far the samples allow another one.
    fn fits(&self, gravity_m_s2: f64) -> Vec<Fit> {
        let data = self.data(gravity_m_s2);
        let all = [
            FittedLaw::Linear,
            FittedLaw::Power,
            FittedLaw::KelvinVoigt,
            FittedLaw::HuntCrossley,
            FittedLaw::Cubic,
        ];
        let mut fits: Vec<Fit> = all.iter().filter_map(|&law| data.fit(law)).collect();
        let curve = data.curve(&fits, self.measured(&data).as_ref());
        fits.extend(curve);
        fits
    }

    /// Adds what the samples allow about the filter: one that nobody stated, or one of another order.
    fn with_filters(&self, mut fits: Vec<Fit>, gravity_m_s2: f64) -> Vec<Fit> {
        let data = self.data(gravity_m_s2);
        let behind = |poles| Data {
            poles,
            ..data.clone()
        };
        let more: Vec<Fit> = match data.corner_hz {
            None => {
                let simple = |fit: &&Fit| fit.law != FittedLaw::HuntCrossley;
                let slow = |fit: &Fit| {
                    fit.fitted_corner_hz()
                        .is_some_and(|corner| corner * fit.predicted.contact_s < LOOKED_FOR_CORNER)
                };
                // A curve takes much time, and the poles of its filter change little.
                let is_tried =
                    |fit: &Fit, poles| fit.law != FittedLaw::Tabulated || poles == Poles::Two;
                let of = |poles| {
                    let tried = fits
                        .iter()
                        .filter(simple)
                        .filter(move |fit| is_tried(fit, poles));
                    tried.filter_map(move |fit| behind(poles).behind_filter(fit))
                };
                Poles::ALL.into_iter().flat_map(of).filter(slow).collect()
            }
            Some(corner_hz) if corner_hz * self.rough_s < FREE_CORNER => {
                let others = Poles::ALL.into_iter().filter(|poles| *poles != data.poles);
                others
                    .flat_map(|poles| fits.iter().filter_map(move |fit| behind(poles).refit(fit)))
                    .collect()
            }
            Some(_) => Vec::new(),
        };
        fits.extend(more);
        fits
    }

    /// The simplest law that no other outweighs; a law with negative damping is excluded. What the other laws make of the
    /// samples is part of its error, each as much as it is likely.
    fn simplest(&self, mut fits: Vec<Fit>) -> Option<(Fit, Vec<Fit>)> {
        let least = fits
            .iter()
            .map(|fit| fit.chi_squared / fit.degrees)
            .fold(f64::INFINITY, f64::min)
            .max(1.0);
        let is_wanted = |fit: &Fit| match self.setup.law {
            Some(law) => fit.law == law,
            None => fit.is_law(),
        };
        let wanted = || fits.iter().enumerate().filter(|(_, fit)| is_wanted(fit));
        let likeliest = wanted()
            .map(|(_, fit)| fit.unlikeliness(least))
            .fold(f64::INFINITY, f64::min);
        let best = wanted()
            .filter(|(_, fit)| fit.unlikeliness(least) <= likeliest + OUTWEIGHED)
            .min_by(|a, b| a.1.simpler(b.1, least))
            .map(|(index, _)| index)?;
        let mut chosen = fits.remove(best);
        let all = || std::iter::once(&chosen).chain(fits.iter().filter(|fit| fit.is_law()));
        let likely = chosen.error_among(all(), least);
        // No pad follows a formula exactly: a curve counts no less than all of them.
        let curves = all().filter(|fit| fit.law == FittedLaw::Tabulated);
        let curved = chosen.error_among(curves, least);
        let even = if curved.is_finite() {
            (0.5 * (likely * likely + curved * curved)).sqrt()
        } else {
            likely
        };
        // A law that the others outweigh is no more certain for that.
        chosen.secant_error_ratio = chosen.secant_error_ratio.max(likely).max(even);
        if chosen.fitted_corner_hz().is_some() {
            // Nobody stated this filter: without it, the samples give this.
            let plain = fits
                .iter()
                .filter(|fit| fit.fitted_corner_hz().is_none() && is_wanted(fit));
            let plain =
                plain.min_by(|a, b| a.unlikeliness(least).total_cmp(&b.unlikeliness(least)));
            let apart = plain.map_or(0.0, |fit| (fit.secant_n_m / chosen.secant_n_m).ln());
            chosen.secant_error_ratio = chosen.secant_error_ratio.hypot(apart);
        }
        Some((chosen, fits))
    }

    fn report(&self, choice: Choice, test: &mut DropTest) {
        let Choice {
            best,
            others,
            has_gravity,
            gravity_error,
        } = choice;
        let gravity = if has_gravity {
            self.setup.gravity_m_s2
        } else {
            0.0
        };
        let speed = self.known_speed().unwrap_or(best.model.speed_m_s);
        let contact_s = best.predicted.contact_s;
        let data = self.data(gravity);
        // A filter shows everything later.
        let delay_s = best.model.filter.map_or(0.0, |filter| filter.delay_s());
        let touch_s =
            best.touch_s + delay_s + (self.pulse.before as f64 + 0.5 - data.touch) * self.dt_s;
        let start = Start {
            touch_s,
            speed_m_s: speed,
            jump_m_s2: best.predicted.at(0.0),
        };
        let points = self.integrate(self.accel, &start, contact_s, gravity);
        let Some(deepest) = deepest(&points) else {
            return;
        };
        let m = self.setup.mass_kg;
        let a = self.peak_m_s2;
        let d = deepest.compression_m;
        let integrated = self.integrated(&best, speed, gravity);
        let stiffness = StiffnessEstimates {
            fit_n_m: best.secant_n_m,
            peak_over_velocity_n_m: m * (a / speed).powi(2),
            contact_time_n_m: m * (std::f64::consts::PI / contact_s).powi(2),
            velocity_over_compression_n_m: m * (speed / d).powi(2),
            acceleration_over_compression_n_m: m * a / d,
            energy_n_m: 2.0 * deepest.energy_j / (d * d),
            integrated_n_m: integrated.as_ref().map(|found| found.secant_n_m),
        };
        test.impact_velocity_m_s = Some(speed);
        test.contact_time_s = Some(contact_s);
        test.max_compression_m = Some(d);
        let rebound_m_s = -points.last().map_or(0.0, |point| point.speed_m_s);
        let e = rebound_m_s / speed;
        let e = physical(e);
        test.restitution_ratio = e;
        test.energy_lost_ratio = e.map(|e| 1.0 - e * e);
        test.restitution_bounce_ratio =
            self.pulse.flight.filter(|_| has_gravity).and_then(|steps| {
                physical(self.setup.gravity_m_s2 * steps as f64 * self.dt_s / (2.0 * speed))
            });
        if self.is_cut(&data, &best, &others) {
            test.flags.push(Flag::Clipped);
            return;
        }
        test.points = points;
        let is_more =
            best.chi_squared > POOR_CHI * best.degrees && best.residual_ratio > VISIBLE_RESIDUAL;
        if is_more || best.residual_ratio > POOR_RESIDUAL.max(2.0 * self.pulse.noise_m_s2 / a) {
            test.flags.push(Flag::PoorFit);
            // No pad that the laws know gives this pulse: an interval would say nothing about the error of the laws. That
            // of a law which was asked for includes the others.
            if self.setup.law.is_none() {
                return;
            }
        }
        let floor = if best.law == FittedLaw::Tabulated {
            CURVE_FLOOR
        } else {
            FLOOR
        };
        let error_ratio = best.secant_error_ratio.hypot(gravity_error).hypot(floor);
        if let Some(Integrated {
            secant_n_m,
            error_ratio: own,
        }) = integrated
            && (secant_n_m / best.secant_n_m).ln().abs()
                > APART + APART_ERRORS * own.hypot(error_ratio)
        {
            test.flags.push(Flag::Integration);
        }
        if let ImpactVelocity::Known {
            speed_m_s,
            error_ratio,
        } = self.setup.impact_velocity
            && (best.model.speed_m_s / speed_m_s).ln().abs() > 3.0 * error_ratio
        {
            test.flags.push(Flag::Velocity);
        }
        if best.gives_energy() {
            test.flags.push(Flag::Damping);
        }
        let free = self.with_free_exponent(&best, &others, gravity);
        test.identified = Some(Identified {
            chosen: best.law,
            law: law_of(&best),
            stiffness,
            error_ratio,
            initial_stiffness_n_m: best.model.initial_n_m(),
            cubic_n_m3: match best.model.elastic {
                Elastic::Cubic { cubic_n_m3, .. } => Some(cubic_n_m3),
                Elastic::Power { .. } | Elastic::Curve { .. } => None,
            },
            filter_corner_hz: best.fitted_corner_hz(),
            exponent: free
                .as_ref()
                .map_or(best.model.exponent(), |fit| fit.model.exponent()),
            exponent_error: free.as_ref().and_then(|fit| fit.exponent_error),
            exponent_by_identity: 2.0 * a * d / (speed * speed) - 1.0,
            damping_ratio: damping_ratio(&best),
            fitted_velocity_m_s: best.model.speed_m_s,
            candidates: std::iter::once(&best)
                .chain(&others)
                .map(candidate)
                .collect(),
            has_gravity,
            residual_ratio: best.residual_ratio,
        });
    }

    /// Whether a law with a clipped top fits clearly better than the best law without one: the
    /// sensor reached the end of its range, and noise that was added later hides the flat top.
    fn is_cut(&self, data: &Data, best: &Fit, others: &[Fit]) -> bool {
        let all = || std::iter::once(best).chain(others);
        let likeliest = all()
            .map(|fit| fit.unlikeliness(1.0))
            .fold(f64::INFINITY, f64::min);
        let gain = |fit: &Fit| {
            Some(fit.chi_squared - data.cut(fit)? - (fit.unlikeliness(1.0) - likeliest))
        };
        all().any(|fit| gain(fit).is_some_and(|gain| gain > CLEARLY_CUT))
    }

    /// F/d at the largest compression, from the samples integrated twice after the touch that their flank shows. Behind
    /// a filter, what the same steps make of the pulse of the fit, whose stiffness is known, removes its effect; without
    /// one this would remove what the flank says about the touch.
    fn integrated(&self, best: &Fit, speed: f64, gravity: f64) -> Option<Integrated> {
        let (known, beginning) = self.twice(self.accel, speed, gravity, None)?;
        if best.model.filter.is_none() {
            return Some(known)
                .filter(|known| known.secant_n_m > 0.0 && known.secant_n_m.is_finite());
        }
        let data = self.data(gravity);
        let touch = best.touch_s / self.dt_s + self.pulse.before as f64 + 0.5 - data.touch;
        let offset = best.offset_m_s2(self.peak_m_s2);
        let law = |i: usize| best.predicted.at((i as f64 - touch) * self.dt_s) + offset;
        let predicted: Vec<f64> = (0..self.accel.len()).map(law).collect();
        let (of_law, _) = self.twice(&predicted, best.model.speed_m_s, gravity, Some(beginning))?;
        let secant_n_m = best.secant_n_m * known.secant_n_m / of_law.secant_n_m;
        (secant_n_m > 0.0 && secant_n_m.is_finite()).then_some(Integrated {
            secant_n_m,
            ..known
        })
    }

    fn flank<'b>(&self, accel: &'b [f64]) -> Flank<'b> {
        Flank {
            accel,
            before: self.pulse.before,
            contact: self.rough_s / self.dt_s,
            peak: self.peak_m_s2,
            noise: self.pulse.noise_m_s2,
        }
    }

    /// Force and compression of the samples, integrated from the touch that their flank shows.
    fn measured(&self, data: &Data) -> Option<Measured> {
        let Touch { at, .. } = self.flank(self.accel).touch(None)?;
        let start = Start {
            touch_s: at * self.dt_s,
            speed_m_s: data.speed_m_s,
            jump_m_s2: 0.0,
        };
        let loaded = self.integrate(self.accel, &start, 1.2 * self.rough_s, data.gravity_m_s2);
        let loaded = loaded.iter().take_while(|point| point.speed_m_s > 0.0);
        let points: Vec<(f64, f64)> = loaded
            .map(|point| (point.compression_m, point.force_n))
            .collect();
        let depth_m = points.last().filter(|last| last.0 > 0.0 && last.1 > 0.0)?.0;
        Some(Measured {
            touch: at - (self.pulse.before as f64 + 0.5 - data.touch),
            depth_m,
            points,
        })
    }

    /// The stiffness of a pulse from two integrations, and how its flank begins.
    fn twice(
        &self,
        accel: &[f64],
        speed: f64,
        gravity: f64,
        beginning: Option<usize>,
    ) -> Option<(Integrated, usize)> {
        let flank = self.flank(accel);
        let Touch {
            at,
            error,
            beginning,
        } = flank.touch(beginning)?;
        let start = Start {
            touch_s: at * self.dt_s,
            speed_m_s: speed,
            jump_m_s2: 0.0,
        };
        let points = self.integrate(accel, &start, 1.2 * self.rough_s, gravity);
        let deepest = deepest(&points)?;
        let middle = at + deepest.time_s / self.dt_s;
        let force_n = self.setup.mass_kg * contact::smooth_at(accel, middle, 0.1 * flank.contact)?;
        let speed_error = match self.setup.impact_velocity {
            ImpactVelocity::Known { error_ratio, .. } => error_ratio,
            ImpactVelocity::FromImpulse => UNKNOWN_SPEED,
        };
        let d = deepest.compression_m;
        // d = ∫ḋ dt: a later touch takes v₀ for that time away, a higher velocity adds to all of the time.
        let error_ratio =
            (speed / d * error * self.dt_s).hypot(speed / d * deepest.time_s * speed_error);
        Some((
            Integrated {
                secant_n_m: force_n / d,
                error_ratio,
            },
            beginning,
        ))
    }

    /// The fit that determines the exponent: another than the best one if its law has a fixed
    /// exponent.
    fn with_free_exponent(&self, best: &Fit, others: &[Fit], gravity: f64) -> Option<Fit> {
        match best.law {
            FittedLaw::Linear | FittedLaw::Cubic | FittedLaw::Tabulated => others
                .iter()
                .filter(|fit| fit.law == FittedLaw::Power)
                .min_by(|a, b| a.chi_squared.total_cmp(&b.chi_squared))
                .cloned()
                .or_else(|| self.data(gravity).fit(FittedLaw::Power)),
            FittedLaw::KelvinVoigt => self.data(gravity).extend(FittedLaw::DampedPower, best),
            _ => Some(best.clone()),
        }
    }

    /// ḋ = v₀ + gt − ∫a dt and d, from the first contact to its end: the trapezoidal rule with ends
    /// between two samples, where the acceleration is zero (or, if it jumps, that of the first
    /// sample).
    fn integrate(
        &self,
        accel: &[f64],
        start: &Start,
        contact_s: f64,
        gravity: f64,
    ) -> Vec<LoopPoint> {
        let Start {
            touch_s,
            speed_m_s: speed,
            jump_m_s2: jump,
        } = *start;
        let point = |time_s: f64, accel: f64, d: f64, v: f64| LoopPoint {
            time_s,
            acceleration_m_s2: accel,
            force_n: self.setup.mass_kg * accel,
            compression_m: d,
            speed_m_s: v,
        };
        let mut points = vec![point(0.0, jump, 0.0, speed)];
        let first = (touch_s / self.dt_s).floor().max(-1.0) as isize + 1;
        let (mut t, mut a, mut d, mut v) = (0.0, jump, 0.0, speed);
        let mut step = |next_s: f64, next_a: f64, t: &mut f64, a: &mut f64| {
            let h = next_s - *t;
            let change = gravity * h - 0.5 * (*a + next_a) * h;
            // The acceleration is linear in between: exact for d as well.
            d += v * h + h * h * (0.5 * gravity - *a / 3.0 - next_a / 6.0);
            v += change;
            (*t, *a) = (next_s, next_a);
            points.push(point(next_s, next_a, d, v));
        };
        for (i, sample) in accel
            .iter()
            .enumerate()
            .skip(usize::try_from(first).unwrap_or(0))
        {
            let time_s = i as f64 * self.dt_s - touch_s;
            if time_s >= contact_s {
                break;
            }
            if time_s > 0.0 {
                step(time_s, *sample, &mut t, &mut a);
            }
        }
        step(contact_s, 0.0, &mut t, &mut a);
        points
    }
}

/// Contact time in samples: the flanks between 8 and 35 % of the peak, extrapolated to zero.
fn rough_contact(accel: &[f64], pulse: &Pulse) -> f64 {
    let end = pulse.after.min(accel.len().saturating_sub(1));
    let crossing = |share: f64, up: bool| -> f64 {
        let level = share * pulse.peak_m_s2;
        let between = |i: usize, j: usize| {
            let (a, b) = (accel[i], accel[j]);
            i as f64
                + (j as f64 - i as f64)
                    * if b == a {
                        0.5
                    } else {
                        ((level - a) / (b - a)).clamp(0.0, 1.0)
                    }
        };
        let found = if up {
            (pulse.before..end)
                .find(|&i| accel[i + 1] > level)
                .map(|i| between(i, i + 1))
        } else {
            (pulse.before..end)
                .rev()
                .find(|&i| accel[i] > level)
                .map(|i| between(i, i + 1))
        };
        found.unwrap_or(if up { pulse.before as f64 } else { end as f64 })
    };
    let zero = |up: bool| {
        let (low, high) = (crossing(0.08, up), crossing(0.35, up));
        low - (high - low) * 0.08 / 0.27
    };
    zero(false) - zero(true)
}

/// The point of largest compression, between the samples, and ∫F dd up to it.
struct Deepest {
    /// From first contact \[s\].
    time_s: f64,
    compression_m: f64,
    energy_j: f64,
}

fn deepest(points: &[LoopPoint]) -> Option<Deepest> {
    let mut energy_j = 0.0;
    for pair in points.windows(2) {
        let [a, b] = pair else { continue };
        if b.speed_m_s <= 0.0 {
            // The velocity is nearly linear between two samples.
            let h = b.time_s - a.time_s;
            let fall = a.speed_m_s - b.speed_m_s;
            let share = if fall > 0.0 { a.speed_m_s / fall } else { 0.0 };
            let compression_m = a.compression_m + 0.5 * a.speed_m_s * share * h;
            let force_n = a.force_n + share * (b.force_n - a.force_n);
            energy_j += 0.5 * (a.force_n + force_n) * (compression_m - a.compression_m);
            let time_s = a.time_s + share * h;
            return (compression_m > 0.0).then_some(Deepest {
                time_s,
                compression_m,
                energy_j,
            });
        }
        energy_j += 0.5 * (a.force_n + b.force_n) * (b.compression_m - a.compression_m);
    }
    None
}
