//! The ramp-invariant oscillator: one exact step for an acceleration that is linear between
//! samples, for many oscillators at once.
//!
//! The filter of ISO 18431-4 (Smallwood) is a biquad with poles at e^(λh), λ = ω(−ζ + i√(1−ζ²)). At
//! low ω h both poles are close to 1 and the biquad loses digits like 1/(ω h)²: 1e-8 at 1 Hz and
//! 100 kHz. The same filter in its complex mode, `ẏ = λy + κa`, response = Re y, has one pole and
//! loses none.

use pulp::{Simd, WithSimd};
use rustfft::num_complex::Complex;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::{ResponseKind, ShockResponseError};

/// One oscillator and its step: `w' = E w + G a`, response `Re w + D a`, with w = y − κ h φ₂(λh) a.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Filter {
    pole: Complex<f64>,
    gain: Complex<f64>,
    direct: f64,
    omega_rad_s: f64,
    damping_ratio: f64,
}

/// Below this |λh| the functions φ are summed as series; 18 terms leave 0.5^18/20! of the first.
const SERIES_BELOW: f64 = 0.5;
const SERIES_TERMS: i32 = 18;

/// φ₂(z) = (e^z − 1 − z)/z², without cancellation for small z.
fn phi_2(z: Complex<f64>) -> Complex<f64> {
    if z.norm() < SERIES_BELOW {
        // Horner on Σ z^k/(k+2)!.
        return (0..SERIES_TERMS).rev().fold(Complex::from(0.0), |sum, k| {
            (sum * z / f64::from(k + 3)) + 1.0
        }) / 2.0;
    }
    ((z.exp() - 1.0) / z - 1.0) / z
}

impl Filter {
    pub(super) fn new(
        kind: ResponseKind,
        frequency_hz: f64,
        damping_ratio: f64,
        step_s: f64,
    ) -> Result<Self, ShockResponseError> {
        let omega = TAU * frequency_hz;
        if !(omega > 0.0 && (omega * omega).is_finite()) {
            return Err(ShockResponseError::Frequency { frequency_hz });
        }
        if !(0.0..1.0).contains(&damping_ratio) {
            return Err(ShockResponseError::Damping { damping_ratio });
        }
        let damped = (1.0 - damping_ratio * damping_ratio).sqrt();
        // Of unit length; multiplied by ω it is λ.
        let direction = Complex::new(-damping_ratio, damped);
        let i = Complex::new(0.0, 1.0);
        // The relative displacement is −Im(e^(λt)∗a)/ω_d, the absolute acceleration −(2ζω u̇ + ω²
        // u).
        let kappa = match kind {
            ResponseKind::AbsoluteAcceleration => {
                (2.0 * damping_ratio * direction + 1.0) * omega / (i * damped)
            }
            ResponseKind::RelativeDisplacement => i / (omega * damped),
            ResponseKind::PseudoVelocity => i / damped,
        };
        let z = direction * (omega * step_s);
        let phi_2 = phi_2(z);
        let phi_1 = 1.0 + z * phi_2;
        let pole = 1.0 + z * phi_1;
        let late = kappa * step_s * phi_2;
        let early = kappa * step_s * (phi_1 - phi_2);
        Ok(Self {
            pole,
            gain: pole * late + early,
            direct: late.re,
            omega_rad_s: omega,
            damping_ratio,
        })
    }

    /// Largest and smallest response of the free decay from a state in which the base is at rest.
    ///
    /// Re(y e^(λt)) has an extreme where the argument of λy e^(λt) is ±π/2; every later extreme is
    /// smaller and has the other sign.
    pub(super) fn decay(&self, state: Complex<f64>) -> (f64, f64) {
        let amplitude = state.norm();
        if amplitude == 0.0 {
            return (0.0, 0.0);
        }
        let zeta = self.damping_ratio;
        let damped = (1.0 - zeta * zeta).sqrt();
        let slope_phase = state.arg() + (PI - zeta.acos());
        // ω_d t of the first extreme, and its phase: its cosine is the response over e^(−ζωt).
        let angle = (FRAC_PI_2 - slope_phase).rem_euclid(PI);
        let first = amplitude * (-zeta / damped * angle).exp() * (state.arg() + angle).cos();
        let second = -first * (-zeta / damped * PI).exp();
        let values = [state.re, first, second];
        (
            values.iter().copied().fold(0.0, f64::max),
            values.iter().copied().fold(0.0, f64::min),
        )
    }

    pub(super) fn is_finite(&self) -> bool {
        self.omega_rad_s.is_finite()
            && self.gain.is_finite()
            && self.pole.is_finite()
            && self.direct.is_finite()
    }
}

/// Oscillators that are stepped together, and their largest and smallest responses so far.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bank<const N: usize> {
    pole: [[f64; N]; 2],
    gain: [[f64; N]; 2],
    direct: [f64; N],
    state: [[f64; N]; 2],
    most: [f64; N],
    least: [f64; N],
}

impl<const N: usize> Bank<N> {
    /// A bank at rest; lanes without a filter stay empty.
    pub(super) fn new(filters: &[Filter]) -> Self {
        let of = |value: fn(&Filter) -> f64| {
            let mut lanes = [0.0; N];
            for (lane, filter) in lanes.iter_mut().zip(filters) {
                *lane = value(filter);
            }
            lanes
        };
        Self {
            pole: [of(|f| f.pole.re), of(|f| f.pole.im)],
            gain: [of(|f| f.gain.re), of(|f| f.gain.im)],
            direct: of(|f| f.direct),
            state: [[0.0; N]; 2],
            most: [0.0; N],
            least: [0.0; N],
        }
    }

    /// Largest and smallest response of a lane since the last reset; the state of rest counts as 0.
    pub(super) fn extremes(&self, lane: usize) -> (f64, f64) {
        (self.most[lane], self.least[lane])
    }

    pub(super) fn forget_extremes(&mut self) {
        (self.most, self.least) = ([0.0; N], [0.0; N]);
    }

    /// w; the mode y itself where the acceleration is zero.
    pub(super) fn state(&self, lane: usize) -> Complex<f64> {
        Complex::new(self.state[0][lane], self.state[1][lane])
    }

    /// Steps over all samples. Fused operations are written out, so the result does not depend on
    /// the processor.
    #[inline(always)]
    fn step(&mut self, samples: &[f64]) {
        let Self {
            pole: [er, ei],
            gain: [gr, gi],
            direct,
            state: [wr, wi],
            most,
            least,
        } = *self;
        let (mut wr, mut wi, mut most, mut least) = (wr, wi, most, least);
        for &a in samples {
            for lane in 0..N {
                let response = direct[lane].mul_add(a, wr[lane]);
                most[lane] = if response > most[lane] {
                    response
                } else {
                    most[lane]
                };
                least[lane] = if response < least[lane] {
                    response
                } else {
                    least[lane]
                };
                let re = er[lane].mul_add(wr[lane], (-ei[lane]).mul_add(wi[lane], gr[lane] * a));
                let im = ei[lane].mul_add(wr[lane], er[lane].mul_add(wi[lane], gi[lane] * a));
                (wr[lane], wi[lane]) = (re, im);
            }
        }
        (self.state, self.most, self.least) = ([wr, wi], most, least);
    }

    /// Steps over all samples with the vector instructions of this processor.
    pub(super) fn run(&mut self, arch: pulp::Arch, samples: &[f64]) {
        arch.dispatch(Steps {
            bank: self,
            samples,
        });
    }
}

struct Steps<'a, const N: usize> {
    bank: &'a mut Bank<N>,
    samples: &'a [f64],
}

impl<const N: usize> WithSimd for Steps<'_, N> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        self.bank.step(self.samples);
    }
}
