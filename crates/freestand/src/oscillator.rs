//! The damped linear oscillator under a motion that is linear between its samples: exact step,
//! history and spectrum.
//!
//! `ü + 2ζω u̇ + ω² u = −a(t)`, u relative to the base, a the base acceleration. Because a
//! [`Motion`] *is* linear between samples, the step has no discretisation error; only rounding
//! remains.

use crate::motion::Motion;
use rustfft::num_traits::Float;
use std::f64::consts::TAU;
use thiserror::Error;

/// Damping of an oscillator where none is stated, as a share of critical damping: that of the
/// spectra of design codes, and Q = 10.
pub const DAMPING_RATIO: f64 = 0.05;

/// Why the response of an oscillator cannot be calculated.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum OscillatorError {
    /// The circular frequency is not positive, or so large that its square is not finite.
    #[error(
        "the circular frequency must be positive and its square finite, not {omega_rad_s} rad/s"
    )]
    Frequency {
        /// The frequency that was given.
        omega_rad_s: f64,
    },
    /// The period is negative, not a number, or too short or too long for its frequency to be
    /// finite and positive.
    #[error("a period must be zero or positive and finite, not {period_s} s")]
    Period {
        /// The period that was given.
        period_s: f64,
    },
    /// The damping is not below critical.
    #[error("the damping ratio must be at least 0 and below 1, not {damping_ratio}")]
    Damping {
        /// The damping ratio that was given.
        damping_ratio: f64,
    },
    /// The time step is not a positive finite number.
    #[error("the time step must be positive and finite, not {dt_s} s")]
    TimeStep {
        /// The time step that was given.
        dt_s: f64,
    },
}

/// Displacement and velocity of an oscillator relative to its base.
///
/// **Units**: m and m/s. The default is at rest.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct OscillatorState {
    /// Displacement relative to the base, u \[m\].
    pub displacement_m: f64,
    /// Velocity relative to the base, u̇ \[m/s\].
    pub velocity_m_s: f64,
}

/// One exact time step of a damped oscillator under a base acceleration that is linear within the
/// step.
///
/// With `h(t) = e^(−ζωt) sin(ω_D t)/ω_D`, `S₁ = ∫h`, `S₂ = ∫∫h` over the step, `Δ = a₁ − a₀`:
/// `u₁ = (1 − ω²S₁) u₀ + h u̇₀ − S₁ a₀ − S₂ Δ/dt` and `u̇₁ = −ω²h u₀ + ḣ u̇₀ − h a₀ − S₁ Δ/dt`.
///
/// # Reference
/// Nigam and Jennings (1969), "Calculation of response spectra from strong-motion earthquake
/// records", BSSA 59; the coefficients are theirs, written with h, S₁, S₂ so that no digits cancel.
///
/// # Accuracy
/// Better than 10⁻¹³ for every ω dt: a power series where ω dt < 0.5 (where the usual closed form
/// loses digits like 1/(ω dt)³), the closed form above. The phase of a very stiff oscillator is
/// only as accurate as ω dt itself.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OscillatorStep {
    omega2: f64,
    two_zeta_omega: f64,
    u_u: f64,
    u_v: f64,
    v_u: f64,
    v_v: f64,
    u_a0: f64,
    u_a1: f64,
    v_a0: f64,
    v_a1: f64,
}

/// Below this ω dt the series is used; at 0.5 it needs 17 terms, and the closed form still has 12
/// digits.
const SERIES_BELOW: f64 = 0.5;
/// Terms of the series: the 17th is below 0.5^17 · 18/17! ≈ 4e-19 of the first.
const SERIES_TERMS: usize = 17;

impl OscillatorStep {
    /// The step of an oscillator with circular frequency `omega_rad_s` and damping ratio
    /// `damping_ratio`.
    ///
    /// # Errors
    /// A frequency that is not positive (or whose square overflows), damping outside 0 ≤ ζ < 1, or
    /// a time step that is not positive and finite.
    ///
    /// # Example
    /// Half a period after a step of −1 m/s², an undamped oscillator of ω = 1 rad/s is at 2 a/ω² =
    /// 2 m:
    /// ```
    /// use freestand::oscillator::{OscillatorState, OscillatorStep};
    /// let half_period = OscillatorStep::new(1.0, 0.0, std::f64::consts::PI)?;
    /// let state = half_period.advance(OscillatorState::default(), -1.0, -1.0);
    /// assert!((state.displacement_m - 2.0).abs() < 1e-15);
    /// # Ok::<(), freestand::oscillator::OscillatorError>(())
    /// ```
    pub fn new(omega_rad_s: f64, damping_ratio: f64, dt_s: f64) -> Result<Self, OscillatorError> {
        let omega2 = omega_rad_s * omega_rad_s;
        if !(omega_rad_s > 0.0 && omega2.is_finite()) {
            return Err(OscillatorError::Frequency { omega_rad_s });
        }
        check_damping(damping_ratio)?;
        if !(dt_s > 0.0 && dt_s.is_finite()) {
            return Err(OscillatorError::TimeStep { dt_s });
        }
        let Kernel { h, s1, s2 } = kernel(omega_rad_s, damping_ratio, dt_s);
        let two_zeta_omega = 2.0 * damping_ratio * omega_rad_s;
        Ok(Self {
            omega2,
            two_zeta_omega,
            u_u: 1.0 - omega2 * s1,
            u_v: h,
            v_u: -omega2 * h,
            v_v: 1.0 - two_zeta_omega * h - omega2 * s1,
            u_a0: s2 / dt_s - s1,
            u_a1: -s2 / dt_s,
            v_a0: s1 / dt_s - h,
            v_a1: -s1 / dt_s,
        })
    }

    /// The state one time step later, while the base acceleration changes linearly from `a0_m_s2`
    /// to `a1_m_s2`.
    #[inline]
    pub fn advance(&self, state: OscillatorState, a0_m_s2: f64, a1_m_s2: f64) -> OscillatorState {
        let (u, v) = (state.displacement_m, state.velocity_m_s);
        OscillatorState {
            displacement_m: self.u_u * u
                + self.u_v * v
                + (self.u_a0 * a0_m_s2 + self.u_a1 * a1_m_s2),
            velocity_m_s: self.v_u * u + self.v_v * v + (self.v_a0 * a0_m_s2 + self.v_a1 * a1_m_s2),
        }
    }

    /// Absolute acceleration of the mass, `ü + a = −2ζω u̇ − ω² u` \[m/s²\].
    #[inline]
    pub fn absolute_acceleration_m_s2(&self, state: OscillatorState) -> f64 {
        -(self.two_zeta_omega * state.velocity_m_s + self.omega2 * state.displacement_m)
    }
}

/// Impulse response of the step and its first two integrals.
struct Kernel {
    h: f64,
    s1: f64,
    s2: f64,
}

fn kernel(omega: f64, zeta: f64, dt: f64) -> Kernel {
    let x = omega * dt;
    if x < SERIES_BELOW {
        kernel_series(x, zeta, dt)
    } else {
        kernel_closed(omega, zeta, dt)
    }
}

/// Σ c_k x^k/(k+n)! times dt^n, with c the Taylor coefficients of h: c₀ = 1, c₁ = −2ζ, c_{k+1} =
/// −2ζ c_k − c_{k−1}.
fn kernel_series(x: f64, zeta: f64, dt: f64) -> Kernel {
    let (mut h, mut s1, mut s2) = (0.0, 0.0, 0.0);
    let (mut before, mut c) = (0.0, 1.0);
    let mut term = 1.0; // x^k/(k+1)!
    for k in 0..SERIES_TERMS {
        let n = k as f64;
        h += c * term;
        s1 += c * term / (n + 2.0);
        s2 += c * term / ((n + 2.0) * (n + 3.0));
        (before, c) = (c, -2.0 * zeta * c - before);
        term *= x / (n + 2.0);
    }
    Kernel {
        h: dt * h,
        s1: dt * dt * s1,
        s2: dt * dt * dt * s2,
    }
}

/// From integrating the equation of h once and twice; it divides by ω² and is therefore not used
/// for small ω dt.
fn kernel_closed(omega: f64, zeta: f64, dt: f64) -> Kernel {
    let root = ((1.0 - zeta) * (1.0 + zeta)).sqrt();
    let omega_d = omega * root;
    let decay = (-zeta * omega * dt).exp();
    let (sin, cos) = (omega_d * dt).sin_cos();
    let h = decay * sin / omega_d;
    let s1 = (1.0 - decay * (cos + zeta / root * sin)) / omega / omega;
    let s2 = (dt - h - 2.0 * zeta * omega * s1) / omega / omega;
    Kernel { h, s1, s2 }
}

pub(crate) fn check_damping(damping_ratio: f64) -> Result<(), OscillatorError> {
    if (0.0..1.0).contains(&damping_ratio) {
        Ok(())
    } else {
        Err(OscillatorError::Damping { damping_ratio })
    }
}

/// Absolute acceleration of an oscillator at every sample of `motion`, from rest at t = 0 \[m/s²\].
///
/// `A = ü + a = −2ζω u̇ − ω² u`; the first value is 0 even where the motion starts with a jump.
///
/// # Reference
/// Nigam and Jennings (1969).
///
/// # Errors
/// A period that is not positive or too short to have a finite ω², or damping outside 0 ≤ ζ < 1.
///
/// # Example
/// ```
/// use freestand::{motion::Motion, oscillator::absolute_acceleration_history_m_s2};
/// let step = Motion::new(0.5, vec![1.0; 3])?;
/// let history = absolute_acceleration_history_m_s2(&step, 1.0, 0.0)?;
/// assert_eq!(history[0], 0.0);
/// assert!((history[1] - 2.0).abs() < 1e-14); // half a period after the step: twice the step
/// assert!(history[2].abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn absolute_acceleration_history_m_s2(
    motion: &Motion,
    period_s: f64,
    damping_ratio: f64,
) -> Result<Vec<f64>, OscillatorError> {
    let step = step_of_period(period_s, damping_ratio, motion.dt_s())?;
    let accel = motion.accel_m_s2();
    let mut state = OscillatorState::default();
    let mut history = Vec::with_capacity(accel.len());
    history.push(0.0);
    for pair in accel.windows(2) {
        state = step.advance(state, pair[0], pair[1]);
        history.push(step.absolute_acceleration_m_s2(state));
    }
    Ok(history)
}

pub(crate) fn step_of_period(
    period_s: f64,
    damping_ratio: f64,
    dt_s: f64,
) -> Result<OscillatorStep, OscillatorError> {
    match OscillatorStep::new(TAU / period_s, damping_ratio, dt_s) {
        Err(OscillatorError::Frequency { .. }) => Err(OscillatorError::Period { period_s }),
        other => other,
    }
}

/// Peak responses of damped oscillators to one motion.
///
/// **Units** and shapes: four arrays with one value for each period, in the order of the request.
#[derive(Debug, Clone, PartialEq)]
pub struct ResponseSpectrum {
    /// Undamped periods T \[s\].
    pub periods_s: Vec<f64>,
    /// Largest relative displacement, max|u| \[m\].
    pub sd_m: Vec<f64>,
    /// Pseudo-velocity, ω·Sd \[m/s\].
    pub psv_m_s: Vec<f64>,
    /// Pseudo-acceleration, ω²·Sd \[m/s²\].
    pub psa_m_s2: Vec<f64>,
    /// Largest absolute acceleration, max|ü + a| \[m/s²\].
    pub sa_m_s2: Vec<f64>,
}

/// Response spectrum of a motion: exact between samples; peaks are the largest values at the
/// samples of the motion.
///
/// T = 0 is the rigid oscillator: Sd = PSV = 0 and both accelerations the PGA.
///
/// # Reference
/// Nigam and Jennings (1969).
///
/// # Limitation
/// Peaks between samples are missed, and below T ≈ 10 dt straight lines do not represent the ground
/// motion: upsample such a motion first
/// ([`upsampled_sinc`](crate::signal::resample::upsampled_sinc)). Free vibration after the last
/// sample counts only if the caller adds zeros at the end.
///
/// # Errors
/// A negative or non-finite period, or damping outside 0 ≤ ζ < 1.
///
/// # Example
/// ```
/// use freestand::{motion::Motion, oscillator::response_spectrum};
/// let step = Motion::new(0.01, vec![1.0; 301])?;
/// let spectrum = response_spectrum(&step, 0.0, &[0.0, 2.0])?;
/// assert_eq!(spectrum.psa_m_s2[0], 1.0);
/// assert!((spectrum.psa_m_s2[1] - 2.0).abs() < 1e-12); // a sudden load counts twice
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn response_spectrum(
    motion: &Motion,
    damping_ratio: f64,
    periods_s: &[f64],
) -> Result<ResponseSpectrum, OscillatorError> {
    let steps = steps(periods_s, damping_ratio, motion.dt_s())?;
    let (sd_m, mut sa_m_s2) = peaks(&steps, motion.accel_m_s2());
    let omega = |period_s: f64| if period_s > 0.0 { TAU / period_s } else { 0.0 };
    let psv_m_s: Vec<f64> = periods_s
        .iter()
        .zip(&sd_m)
        .map(|(&t, sd)| omega(t) * sd)
        .collect();
    let mut psa_m_s2: Vec<f64> = periods_s
        .iter()
        .zip(&psv_m_s)
        .map(|(&t, psv)| omega(t) * psv)
        .collect();
    for (i, &period_s) in periods_s.iter().enumerate() {
        if period_s == 0.0 {
            psa_m_s2[i] = motion.peak_m_s2();
            sa_m_s2[i] = motion.peak_m_s2();
        }
    }
    Ok(ResponseSpectrum {
        periods_s: periods_s.to_vec(),
        sd_m,
        psv_m_s,
        psa_m_s2,
        sa_m_s2,
    })
}

/// Number of oscillators that are calculated together: enough independent chains to hide the
/// latency of a step. Of 8, 16 and 32 this is the fastest with AVX-512 (two vectors) and no slower
/// without.
pub(crate) const LANES: usize = 16;

/// A number of each of [`LANES`] oscillators; those beyond the last stay at rest.
pub(crate) type Lanes = [f64; LANES];

/// Lanes of the same vectors with numbers of half the size.
const QUICK_LANES: usize = 2 * LANES;

fn lanes<S>(steps: &[Option<S>], value: impl Fn(&S) -> f64) -> Lanes {
    std::array::from_fn(|i| steps.get(i).and_then(Option::as_ref).map_or(0.0, &value))
}

/// The larger of the two. Not f64::max: its handling of NaN prevents vectorisation.
#[inline(always)]
fn larger<F: PartialOrd>(value: F, so_far: F) -> F {
    if value > so_far { value } else { so_far }
}

#[inline(always)]
fn smaller<F: PartialOrd>(value: F, so_far: F) -> F {
    if value < so_far { value } else { so_far }
}

/// The steps of oscillators with these periods; a period of 0 has none.
fn steps(
    periods_s: &[f64],
    damping_ratio: f64,
    dt_s: f64,
) -> Result<Vec<Option<OscillatorStep>>, OscillatorError> {
    check_damping(damping_ratio)?;
    let step = |&period_s: &f64| match period_s {
        0.0 => Ok(None),
        _ => step_of_period(period_s, damping_ratio, dt_s).map(Some),
    };
    periods_s.iter().map(step).collect()
}

/// max|u| \[m\] and max|ü + a| \[m/s²\] of every oscillator, from rest at t = 0.
fn peaks(steps: &[Option<OscillatorStep>], accel_m_s2: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let widest = pulp::Arch::new();
    let (mut sd_m, mut sa_m_s2) = (Vec::new(), Vec::new());
    for group in steps.chunks(LANES).map(LaneGroup::new) {
        let (sd, sa) = widest.dispatch(
            #[inline(always)]
            || group.peaks(accel_m_s2),
        );
        sd_m.extend_from_slice(&sd);
        sa_m_s2.extend_from_slice(&sa);
    }
    sd_m.truncate(steps.len());
    sa_m_s2.truncate(steps.len());
    (sd_m, sa_m_s2)
}

/// The steps of some oscillators.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LaneGroup {
    omega2: Lanes,
    two_zeta_omega: Lanes,
    u_u: Lanes,
    u_v: Lanes,
    v_u: Lanes,
    v_v: Lanes,
    u_a0: Lanes,
    u_a1: Lanes,
    v_a0: Lanes,
    v_a1: Lanes,
}

/// Where some oscillators are.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct LaneStates {
    displacement_m: Lanes,
    velocity_m_s: Lanes,
}

impl LaneGroup {
    pub(crate) fn new(steps: &[Option<OscillatorStep>]) -> Self {
        Self {
            omega2: lanes(steps, |s| s.omega2),
            two_zeta_omega: lanes(steps, |s| s.two_zeta_omega),
            u_u: lanes(steps, |s| s.u_u),
            u_v: lanes(steps, |s| s.u_v),
            v_u: lanes(steps, |s| s.v_u),
            v_v: lanes(steps, |s| s.v_v),
            u_a0: lanes(steps, |s| s.u_a0),
            u_a1: lanes(steps, |s| s.u_a1),
            v_a0: lanes(steps, |s| s.v_a0),
            v_a1: lanes(steps, |s| s.v_a1),
        }
    }

    /// Displacement and velocity of a lane one sample later. The same operations in the same order as
    /// [`OscillatorStep::advance`], so the results are equal bit for bit on every vector unit: nothing is fused.
    #[inline(always)]
    fn step(&self, i: usize, (u, v): (f64, f64), [a0, a1]: [f64; 2]) -> (f64, f64) {
        (
            self.u_u[i] * u + self.u_v[i] * v + (self.u_a0[i] * a0 + self.u_a1[i] * a1),
            self.v_u[i] * u + self.v_v[i] * v + (self.v_a0[i] * a0 + self.v_a1[i] * a1),
        )
    }

    /// 2ζω u̇ + ω² u, the absolute acceleration of a lane with the opposite sign \[m/s²\].
    #[inline(always)]
    fn pull(&self, i: usize, u: f64, v: f64) -> f64 {
        self.two_zeta_omega[i] * v + self.omega2[i] * u
    }

    /// Goes on from sample to sample: the absolute accelerations \[m/s²\] and the displacements \[m\] at each but the
    /// first; the latter only where they have a place.
    #[inline(always)]
    pub(crate) fn advance(
        &self,
        states: &mut LaneStates,
        accel_m_s2: &[f64],
        absolute_m_s2: &mut [Lanes],
        displacement_m: &mut [Lanes],
    ) {
        let (mut u, mut v) = (states.displacement_m, states.velocity_m_s);
        let mut displaced = displacement_m.iter_mut();
        for (pair, absolute) in accel_m_s2.windows(2).zip(absolute_m_s2) {
            let pair = [pair[0], pair[1]];
            for i in 0..LANES {
                (u[i], v[i]) = self.step(i, (u[i], v[i]), pair);
                absolute[i] = -self.pull(i, u[i], v[i]);
            }
            if let Some(displaced) = displaced.next() {
                *displaced = u;
            }
        }
        (states.displacement_m, states.velocity_m_s) = (u, v);
    }

    /// The largest displacement \[m\] and absolute acceleration \[m/s²\] of each lane, from rest. Inlined into the code that
    /// `pulp` compiles for each vector unit.
    #[inline(always)]
    fn peaks(&self, accel_m_s2: &[f64]) -> (Lanes, Lanes) {
        let (mut u, mut v) = ([0.0_f64; LANES], [0.0_f64; LANES]);
        let (mut sd, mut sa) = ([0.0_f64; LANES], [0.0_f64; LANES]);
        for pair in accel_m_s2.windows(2) {
            let pair = [pair[0], pair[1]];
            for i in 0..LANES {
                (u[i], v[i]) = self.step(i, (u[i], v[i]), pair);
                sd[i] = larger(u[i].abs(), sd[i]);
                sa[i] = larger(self.pull(i, u[i], v[i]).abs(), sa[i]);
            }
        }
        (sd, sa)
    }
}

/// The displacements of the oscillators of a whole spectrum, prepared once for a time step and used
/// on many motions.
///
/// Without the velocity an oscillator is a recurrence in three samples, from two exact steps: `u₂ =
/// tr u₁ − det u₀ + b₂ a₂ + b₁ a₁ + b₀ a₀`, with the trace and the determinant of the step's matrix.
/// For u/b₂ that is four fused operations.
#[derive(Debug, Clone)]
pub(crate) struct DisplacementBank {
    groups: Groups,
    count: usize,
}

/// The oscillators of a bank, in groups that fill a vector.
#[derive(Debug, Clone)]
enum Groups {
    Exact(Vec<RecurrenceGroup<f64, LANES>>),
    Quick(Vec<ThinnedGroup>),
}

/// Oscillators that see only some samples, each a mean of its neighbours.
#[derive(Debug, Clone)]
struct ThinnedGroup {
    every: usize,
    /// Samples in half of the longest period: vibration that decays freely has its largest value within them.
    decaying: usize,
    group: RecurrenceGroup<f32, QUICK_LANES>,
}

/// The samples that a period of a thinned group has at least: a peak between two of them is missed by
/// (π/16)²/2 = 1.9 % at most, and by a third of it in the mean, which is added.
const THINNED_TO_SAMPLES: f64 = 16.0;

/// The coefficients of u/b₂ in lanes.
#[derive(Debug, Clone, Copy)]
struct RecurrenceGroup<F, const N: usize> {
    trace: [F; N],
    minus_determinant: [F; N],
    a0: [F; N],
    a1: [F; N],
    /// Of the first step, from rest.
    first_a0: [F; N],
    /// |b₂|, which makes displacements.
    scale: [F; N],
}

impl DisplacementBank {
    /// Every sample in double precision.
    ///
    /// # Accuracy
    /// The recurrence loses digits like 1/(ω dt)²: to 1e-11 of the peak at T = 1000 dt.
    pub(crate) fn new(
        periods_s: &[f64],
        damping_ratio: f64,
        dt_s: f64,
    ) -> Result<Self, OscillatorError> {
        let steps = steps(periods_s, damping_ratio, dt_s)?;
        let group = |steps: &[_]| RecurrenceGroup::new(steps, |value| value);
        Ok(Self {
            groups: Groups::Exact(steps.chunks(LANES).map(group).collect()),
            count: periods_s.len(),
        })
    }

    /// At a fifth of the cost, for rising periods and motions that start from quiet: in single
    /// precision, and where all periods of a group have more samples than they need, on a share of them.
    ///
    /// # Accuracy
    /// To 2 % of the peak, and to 0.2 % in the mean over many periods.
    pub(crate) fn quick(
        periods_s: &[f64],
        damping_ratio: f64,
        dt_s: f64,
    ) -> Result<Self, OscillatorError> {
        let group = |periods_s: &[f64]| {
            let samples = periods_s
                .first()
                .map_or(0.0, |shortest_s| shortest_s / dt_s);
            let mut every = 1;
            while samples >= THINNED_TO_SAMPLES * (2 * every) as f64 {
                every *= 2;
            }
            let steps = steps(periods_s, damping_ratio, every as f64 * dt_s)?;
            let mut group = RecurrenceGroup::new(&steps, |value| value as f32);
            for (i, period_s) in periods_s.iter().enumerate() {
                // What samples that are farther apart miss of peaks in the mean.
                let phase = std::f64::consts::PI * dt_s / period_s;
                let left = 1.0 - ((every as f64 * phase).powi(2) - phase.powi(2)) / 6.0;
                group.scale[i] /= left as f32;
            }
            let longest_s = periods_s.iter().copied().fold(0.0, f64::max);
            let decaying = (0.5 * longest_s / dt_s).ceil() as usize + every;
            Ok(ThinnedGroup {
                every,
                decaying,
                group,
            })
        };
        let groups = periods_s.chunks(QUICK_LANES).map(group);
        Ok(Self {
            groups: Groups::Quick(groups.collect::<Result<_, _>>()?),
            count: periods_s.len(),
        })
    }

    /// max|u| of every oscillator, from rest at t = 0 \[m\].
    pub(crate) fn peaks_m(&self, accel_m_s2: &[f64]) -> Vec<f64> {
        let widest = pulp::Arch::new();
        let mut peaks_m: Vec<f64> = match &self.groups {
            Groups::Exact(groups) => groups
                .iter()
                .flat_map(|group| widest.dispatch(Shaken { group, accel_m_s2 }))
                .collect(),
            Groups::Quick(groups) => Self::quick_peaks_m(groups, accel_m_s2),
        };
        peaks_m.truncate(self.count);
        peaks_m
    }

    fn quick_peaks_m(groups: &[ThinnedGroup], accel_m_s2: &[f64]) -> Vec<f64> {
        // Before the shaking nothing moves.
        let quiet = accel_m_s2.iter().take_while(|a| **a == 0.0).count();
        let shaken = accel_m_s2
            .iter()
            .rposition(|a| *a != 0.0)
            .map_or(0, |k| k + 1);
        // More than thinning takes from the start, and whole samples of the most thinned group, which do not shift.
        let coarsest = groups.last().map_or(1, |group| group.every);
        let from = (quiet / coarsest).saturating_sub(4) * coarsest;
        let mut thinned: Vec<f32> = accel_m_s2[from..].iter().map(|a| *a as f32).collect();
        let mut left = 1;
        let peaks_m = groups.iter().flat_map(|group| {
            let ThinnedGroup {
                every,
                decaying,
                group,
            } = group;
            while left < *every {
                let (pairs, _) = thinned.as_chunks::<2>();
                thinned = pairs
                    .windows(3)
                    .map(|pairs| {
                        let [[a0, a1], [a2, a3], [a4, _]] = [pairs[0], pairs[1], pairs[2]];
                        0.75 * a2 + 0.25 * (a1 + a3) - 0.125 * (a0 + a4)
                    })
                    .collect();
                left *= 2;
            }
            let samples = (shaken.saturating_sub(from) + decaying).div_ceil(*every);
            let accel_m_s2 = &thinned[..samples.min(thinned.len())];
            let shaken = Shaken { group, accel_m_s2 };
            pulp::Arch::new().dispatch(shaken).map(f64::from)
        });
        peaks_m.collect()
    }
}

impl<F: Default + Copy, const N: usize> RecurrenceGroup<F, N> {
    fn new(steps: &[Option<OscillatorStep>], narrow: impl Fn(f64) -> F) -> Self {
        let lanes = |value: fn(&OscillatorStep) -> f64| {
            let of = |i| steps.get(i).and_then(Option::as_ref).map_or(0.0, value);
            std::array::from_fn(|i| narrow(of(i)))
        };
        Self {
            trace: lanes(|s| s.u_u + s.v_v),
            minus_determinant: lanes(|s| s.u_v * s.v_u - s.u_u * s.v_v),
            a0: lanes(|s| (s.u_v * s.v_a0 - s.v_v * s.u_a0) / s.u_a1),
            a1: lanes(|s| (s.u_a0 + (s.u_v * s.v_a1 - s.v_v * s.u_a1)) / s.u_a1),
            first_a0: lanes(|s| s.u_a0 / s.u_a1),
            scale: lanes(|s| s.u_a1.abs()),
        }
    }
}

/// Oscillators and what shakes them, to be compiled for each vector unit.
struct Shaken<'a, F, const N: usize> {
    group: &'a RecurrenceGroup<F, N>,
    accel_m_s2: &'a [F],
}

impl<F: Float, const N: usize> pulp::WithSimd for Shaken<'_, F, N> {
    /// max|u| \[m\].
    type Output = [F; N];

    /// What is fused is fused everywhere, so the results are equal bit for bit on every vector unit.
    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) -> [F; N] {
        let Self { group, accel_m_s2 } = self;
        let zero = [F::zero(); N];
        let (mut before, mut u, mut lowest, mut highest) = (zero, zero, zero, zero);
        if let [first, second, ..] = *accel_m_s2 {
            for i in 0..N {
                u[i] = group.first_a0[i].mul_add(first, second);
                highest[i] = larger(u[i], zero[i]);
                lowest[i] = smaller(u[i], zero[i]);
            }
        }
        for three in accel_m_s2.windows(3) {
            let (a0, a1, a2) = (three[0], three[1], three[2]);
            for i in 0..N {
                let pushed = group.a0[i].mul_add(a0, group.a1[i].mul_add(a1, a2));
                let kept = group.minus_determinant[i].mul_add(before[i], pushed);
                let next = group.trace[i].mul_add(u[i], kept);
                before[i] = u[i];
                u[i] = next;
                highest[i] = larger(next, highest[i]);
                lowest[i] = smaller(next, lowest[i]);
            }
        }
        std::array::from_fn(|i| group.scale[i] * larger(highest[i], -lowest[i]))
    }
}

#[cfg(test)]
mod tests;
