//! Reads the stiffness of a contact law.

use freestand_input::problem::Problem;
use freestand_input::quantity::{
    Dimension, is_possible, parse, parse_coefficient, shorten, too_large,
};
use serde::{Deserialize, Serialize};

/// Largest difference between an exponent in a unit and the same exponent under its key.
const SAME_EXPONENT: f64 = 1e-9;

/// A stiffness whose unit has no exponent, read as the secant at 1 mm of a law that has one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Secant {
    /// As it was written, shortened.
    pub written: String,
    /// That stiffness \[N/m\].
    pub stiffness_n_m: f64,
    /// n of F = K dⁿ.
    pub exponent: f64,
    /// K \[N/mⁿ\].
    pub coefficient_n_mn: f64,
}

/// The coefficient K of F = K dⁿ in N/mⁿ, and how it was read if the unit was completed.
///
/// `"2190 N/mm"` for n = 1; `"2e7 N/m^1.5"` or `"632 N/mm^1.5"` for n = 1.5. A plain `"632 N/mm"`,
/// or `"632000 N/m"`, with n ≠ 1 is read as the secant at 1 mm, 632 N/mmⁿ. 1
/// N/mmⁿ = 1000ⁿ N/mⁿ.
///
/// # Errors
/// No positive stiffness, or an exponent in the unit that is not `exponent`.
///
/// # Example
/// ```
/// use freestand_study::law::contact_law_stiffness;
/// assert_eq!(contact_law_stiffness("2190 N/mm", 1.0)?, (2.19e6, None));
/// let (coefficient_n_mn, secant) = contact_law_stiffness("40 N/mm", 2.0)?;
/// assert!((coefficient_n_mn / 40e6 - 1.0).abs() < 1e-12);
/// assert_eq!(secant.map(|secant| secant.written).as_deref(), Some("40 N/mm"));
/// # Ok::<(), freestand_input::problem::Problem>(())
/// ```
pub fn contact_law_stiffness(text: &str, exponent: f64) -> Result<(f64, Option<Secant>), Problem> {
    let text = text.trim();
    let (plain, stated) = split_exponent(text)?;
    let stiffness_n_m =
        parse_coefficient(&plain, Dimension::Stiffness, "the stiffness").map_err(|problem| {
            if exponent == 1.0 {
                problem
            } else {
                problem.hint(example(exponent))
            }
        })?;
    let is_one = (exponent - 1.0).abs() <= SAME_EXPONENT;
    match stated {
        Some(stated) if (stated - exponent).abs() > SAME_EXPONENT => {
            let message = format!(
                "\"{}\" has the exponent {stated}, but the law has {exponent}",
                shorten(text)
            );
            Err(Problem::value(
                message,
                "give the same exponent in both places",
            ))
        }
        _ if is_one && is_possible(stiffness_n_m) => Ok((stiffness_n_m, None)),
        _ if is_one => Err(too_large(text)),
        _ => {
            // One N/mm is 1000 N/m, one N/mmⁿ is 1000ⁿ N/mⁿ; without an exponent in the unit its
            // length is a millimetre.
            let is_per_mm =
                stated.is_none() || plain.trim_end().to_ascii_lowercase().ends_with("/mm");
            let lengths_in_m: f64 = if is_per_mm { 1e3 } else { 1.0 };
            let coefficient_n_mn = stiffness_n_m * lengths_in_m.powf(exponent - 1.0);
            // Of the secant at 1 mm: the coefficient itself may have any number.
            if !is_possible(coefficient_n_mn * 1e-3_f64.powf(exponent - 1.0)) {
                return Err(too_large(text));
            }
            let secant = stated.is_none().then(|| Secant {
                written: shorten(text),
                stiffness_n_m,
                exponent,
                coefficient_n_mn,
            });
            Ok((coefficient_n_mn, secant))
        }
    }
}

/// `N/mm^1.5` → `N/mm` and 1.5; `N/m²` → `N/m` and 2.
fn split_exponent(text: &str) -> Result<(String, Option<f64>), Problem> {
    let text = text.replace('²', "^2").replace('³', "^3");
    let Some((plain, power)) = text.split_once('^') else {
        return Ok((text, None));
    };
    let power = power.trim().trim_start_matches('(').trim_end_matches(')');
    let value = match power.split_once('/') {
        Some((above, below)) => parse(above, Dimension::Ratio)? / parse(below, Dimension::Ratio)?,
        None => parse(power, Dimension::Ratio)?,
    };
    Ok((plain.to_owned(), Some(value)))
}

fn example(exponent: f64) -> String {
    format!("write for example \"632 N/mm^{exponent}\" or \"2e7 N/m^{exponent}\"")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stiffnesses_of_power_laws() {
        // 1000^1.5 = 31622.7766.
        let cases = [
            ("2190 N/mm", 1.0, 2.19e6),
            ("2e7 N/m^1.5", 1.5, 2e7),
            ("2e7 N/m^(3/2)", 1.5, 2e7),
            ("632 N/mm^1.5", 1.5, 632.0 * 31_622.776_601_683_8),
            ("632 N/mm", 1.5, 632.0 * 31_622.776_601_683_8),
            ("1 kN/mm", 2.0, 1e9),
            ("3 N/m²", 2.0, 3.0),
            ("632000 N/m", 1.5, 632.0 * 31_622.776_601_683_8),
            ("5 kN/m^1.2", 1.2, 5e3),
            // The secant at 1 mm decides what is too large, and not the coefficient.
            (
                "2003966766634516700 N/m^4",
                4.0,
                2_003_966_766_634_516_700.0,
            ),
            ("1e5 N/mm^5", 5.0, 1e20),
            ("1e20 N/m^5", 5.0, 1e20),
        ];
        for (text, exponent, expected) in cases {
            let (found, note) = contact_law_stiffness(text, exponent).unwrap();
            // Rounding of a power.
            assert!((found / expected - 1.0).abs() < 1e-14, "{text}: {found}");
            assert_eq!(
                note.is_some(),
                exponent != 1.0 && !text.contains(['^', '²']),
                "{text}"
            );
        }
        for (text, exponent) in [
            ("632 N/mm^1.5", 1.0),
            ("632", 1.5),
            ("-3 N/mm", 1.0),
            ("1e19 N/m", 1.0),
            ("1e20 N/mm^5", 5.0),
            ("3 N/mm^", 1.5),
            ("3 N/mm^x", 1.5),
            ("1 mm", 1.0),
        ] {
            assert!(contact_law_stiffness(text, exponent).is_err(), "{text}");
        }
    }
}
