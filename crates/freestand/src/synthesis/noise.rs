//! Random numbers and the windows that shape them in time.

use rand_chacha::ChaCha12Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardNormal};

/// The stream of random numbers of motion `index` of earthquake number `earthquake` (0 is the
/// first, or the only one): no two motions of one seed share a stream.
///
/// # Example
/// ```
/// use freestand::synthesis::stream;
/// assert_eq!((stream(0, 7), stream(1, 7)), (7, 4_294_967_303));
/// ```
pub fn stream(earthquake: u32, index: u32) -> u64 {
    u64::from(earthquake) << 32 | u64::from(index)
}

/// Standard normal numbers from a stream of `seed`.
pub(super) fn noise(seed: u64, stream: u64) -> impl FnMut() -> f64 {
    let mut random = ChaCha12Rng::seed_from_u64(seed);
    random.set_stream(stream);
    move || StandardNormal.sample(&mut random)
}

/// How the strength of shaking rises and falls over a duration T_d.
#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum Window {
    /// `e^(−0.4·6t/T_d) − e^(−1.2·6t/T_d)`: its maximum is 0.3849 at 0.2289 T_d (Lam, Wilson and
    /// Hutchinson 2000).
    Lam,
    /// `a (t/t_η)^b e^(−c t/t_η)` with t_η = 2 T_d: its maximum is 1 at 0.2 t_η, and it is 0.05 at
    /// t_η (Saragoni and Hart 1974, in the form of Boore 2003).
    SaragoniHart,
}

/// Share of t_η at which the window of Saragoni and Hart has its maximum.
const SARAGONI_HART_PEAK_RATIO: f64 = 0.2;
/// Its value at t_η.
const SARAGONI_HART_END_RATIO: f64 = 0.05;

impl Window {
    /// The value of the window at `time_ratio` = t/T_d; 0 before it begins.
    ///
    /// # Example
    /// ```
    /// use freestand::synthesis::Window;
    /// assert!((Window::Lam.at(0.2289) - 0.3849).abs() < 1e-4);
    /// assert!((Window::SaragoniHart.at(2.0) - 0.05).abs() < 1e-12);
    /// ```
    pub fn at(self, time_ratio: f64) -> f64 {
        if time_ratio <= 0.0 {
            return 0.0;
        }
        match self {
            Self::Lam => {
                let x = 6.0 * time_ratio;
                (-0.4 * x).exp() - (-1.2 * x).exp()
            }
            Self::SaragoniHart => {
                let (a, b, c) = saragoni_hart();
                let x = time_ratio / 2.0;
                a * x.powf(b) * (-c * x).exp()
            }
        }
    }
}

/// a, b and c of the window of Saragoni and Hart: b = −ε ln η/(1 + ε(ln ε − 1)), c = b/ε, a =
/// (e/ε)^b.
fn saragoni_hart() -> (f64, f64, f64) {
    let (epsilon, eta) = (SARAGONI_HART_PEAK_RATIO, SARAGONI_HART_END_RATIO);
    let b = -epsilon * eta.ln() / (1.0 + epsilon * (epsilon.ln() - 1.0));
    ((std::f64::consts::E / epsilon).powf(b), b, b / epsilon)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integration::unit_integral;

    #[test]
    fn the_random_numbers_are_those_of_the_named_generator() {
        // Recorded from rand_chacha 0.10.0 and rand_distr 0.6.0. Any other value changes every
        // synthetic motion.
        let mut noise = noise(1, 7);
        assert_eq!(
            [noise(), noise(), noise()],
            [
                -0.8937706181435281,
                -0.5479682301173312,
                0.04426811833978719
            ]
        );
    }

    #[test]
    fn the_constants_of_saragoni_and_hart_are_the_published_ones() {
        // GMSS 2.0 prints 26.312, 1.253 and 6.266; four and five digits of b and c follow from ε
        // and η.
        let (a, b, c) = saragoni_hart();
        assert!(
            (a - 26.312).abs() < 5e-4 && (b - 1.2531).abs() < 5e-5 && (c - 6.2657).abs() < 5e-5,
            "{a} {b} {c}"
        );
        assert!(
            (Window::SaragoniHart.at(0.4) - 1.0).abs() < 1e-12,
            "the peak at 0.2 t_η"
        );
    }

    #[test]
    fn the_window_of_lam_has_its_peak_energy_and_duration() {
        // d/dt = 0 at t = ln 3/4.8 T_d, where w = 3^(−1/2) − 3^(−3/2).
        let peak = 3.0_f64.ln() / 4.8;
        assert!((peak - 0.2289).abs() < 5e-5 && (Window::Lam.at(peak) - 0.3849).abs() < 5e-5);
        assert!((Window::Lam.at(peak) - (3.0_f64.powf(-0.5) - 3.0_f64.powf(-1.5))).abs() < 1e-15);
        // ∫w² = 1/4.8 − 2/9.6 + 1/14.4 = 0.0694 T_d; beyond 8 T_d only e^(−38) remains.
        let energy = |until: f64| until * unit_integral(|x| Window::Lam.at(x * until).powi(2));
        assert!((energy(8.0) - 1.0 / 14.4).abs() < 1e-12 && (1.0_f64 / 14.4 - 0.0694).abs() < 5e-5);
        let time = |share: f64| crate::search::bisect(0.0, 8.0, |t| energy(t) > share / 14.4);
        assert!(
            (time(0.95) - time(0.05) - 0.754).abs() < 5e-4,
            "{}",
            time(0.95) - time(0.05)
        );
    }
}
