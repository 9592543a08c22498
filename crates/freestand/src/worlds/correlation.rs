//! How the deviations of a spectrum at two periods go together.

use std::f64::consts::{FRAC_PI_2, PI};

/// The periods for which the correlation was fitted \[s\].
const FITTED_S: (f64, f64) = (0.01, 10.0);
/// The periods at which its pieces meet \[s\].
const SHORT_S: f64 = 0.109;
const MIDDLE_S: f64 = 0.2;

/// Correlation of ln Sa at two periods \[s\] between motions of one earthquake scenario, from 0 to 1.
///
/// With a the shorter and b the longer period, both limited to 0.01–10 s,
///
/// C₁ = 1 − cos(π/2 − 0.366 ln(b/max(a, 0.109))),
///
/// C₂ = 1 − 0.105 (1 − 1/(1 + e^(100b−5))) (b − a)/(b − 0.0099),
///
/// C₃ = C₂ where b < 0.109, otherwise C₁; C₄ = C₁ + ½(√C₃ − C₃)(1 + cos(πa/0.109));
///
/// ρ = C₂ where b ≤ 0.109; C₁ where a > 0.109; min(C₂, C₄) where b < 0.2; otherwise C₄.
///
/// # Reference
/// Baker and Jayaram (2008), "Correlation of spectral acceleration values from NGA ground motion
/// models", Earthquake Spectra 24, 299–317.
///
/// # Accuracy
/// A fit to recorded motions, with errors of some 0.05. The matrix of the periods to which motions
/// are matched is positive definite.
///
/// # Example
/// ρ(0.2 s, 1 s) = 1 − sin(0.366 ln 5):
/// ```
/// use freestand::worlds::spectral_correlation_ratio;
/// assert!((spectral_correlation_ratio(1.0, 0.2) - 0.44443).abs() < 5e-6);
/// ```
pub fn spectral_correlation_ratio(one_s: f64, other_s: f64) -> f64 {
    let limited = |period_s: f64| period_s.clamp(FITTED_S.0, FITTED_S.1);
    let (a, b) = (limited(one_s.min(other_s)), limited(one_s.max(other_s)));
    if a == b {
        return 1.0;
    }
    let c1 = 1.0 - (FRAC_PI_2 - 0.366 * (b / a.max(SHORT_S)).ln()).cos();
    let c2 = 1.0 - 0.105 * (1.0 - 1.0 / (1.0 + (100.0 * b - 5.0).exp())) * (b - a) / (b - 0.0099);
    let c3 = if b < SHORT_S { c2 } else { c1 };
    let c4 = c1 + 0.5 * (c3.sqrt() - c3) * (1.0 + (PI * a / SHORT_S).cos());
    if b <= SHORT_S {
        c2
    } else if a > SHORT_S {
        c1
    } else if b < MIDDLE_S {
        c2.min(c4)
    } else {
        c4
    }
}
