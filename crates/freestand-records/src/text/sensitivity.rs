//! Sensors that give volts: `10 mV/g`, `2 mV/N`.

use super::headings::Heading;
use freestand_input::problem::Problem;
use freestand_input::quantity::{Dimension, Unit, lookup, shorten};

/// The sensitivity of a sensor: the volts that it gives for what it measures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sensitivity {
    unit: &'static Unit,
    /// Volts per `unit`.
    volts: f64,
}

impl Sensitivity {
    /// What the sensor measures.
    pub fn dimension(&self) -> Dimension {
        self.unit.dimension
    }

    /// What a number in units of `volts` means, in SI.
    pub(crate) fn si_of(&self, volts: f64) -> f64 {
        self.unit.to_si(volts / self.volts)
    }
}

const VOLTS: [(f64, &[&str]); 3] = [
    (1.0, &["V", "Volt", "Volts", "volt", "volts"]),
    (1e-3, &["mV"]),
    (1e-6, &["uV", "µV", "μV"]),
];

/// The volts of a unit: `V`, `mV`.
fn volts_of(unit: &str) -> Option<f64> {
    VOLTS
        .iter()
        .find(|(_, names)| names.contains(&unit.trim()))
        .map(|(volts, _)| *volts)
}

/// The volts in which a column is written, by its heading: `force [mV]`, `acc (V)`, `a, mV`, `a_mV`.
pub(crate) fn volts_of_heading(heading: &Heading) -> Option<f64> {
    let name = heading.name.trim();
    let bracketed = name
        .strip_suffix([']', ')'])
        .and_then(|open| open.rsplit_once(['[', '(']))
        .map(|(_, unit)| unit);
    let unit = bracketed.or_else(|| name.rsplit_once([' ', ',', '_', '/']).map(|(_, unit)| unit));
    unit.filter(|_| heading.unit.is_none()).and_then(volts_of)
}

/// A sensitivity, such as `10 mV/g`, `0.1 V/(m/s2)`, `2 mV/N` or `1 V/mm`.
///
/// # Errors
/// Something else.
pub fn parse_sensitivity(text: &str) -> Result<Sensitivity, Problem> {
    let read = || {
        let (volts, per) = text.split_once('/')?;
        let at = volts.find(|c: char| c.is_alphabetic() && c != 'e' && c != 'E')?;
        let (number, unit) = volts.split_at(at);
        let volts = number.trim().parse::<f64>().ok()? * volts_of(unit)?;
        let per = per.trim();
        let unit = lookup(
            per.strip_prefix('(')
                .and_then(|per| per.strip_suffix(')'))
                .unwrap_or(per),
        )?;
        let is_measured = matches!(
            unit.dimension,
            Dimension::Acceleration | Dimension::Force | Dimension::Length
        );
        (volts.is_finite() && volts != 0.0 && is_measured).then_some(Sensitivity { unit, volts })
    };
    read().ok_or_else(|| {
        let hint = "write the volts for one unit of acceleration, force or displacement, such as \"10 mV/g\", \"2 mV/N\" \
                    or \"1 V/mm\"";
        Problem::value(format!("\"{}\" is not the sensitivity of a sensor", shorten(text)), hint)
    })
}

/// The problem of a column in volts whose sensor is not known; `example` is a sensitivity.
pub(crate) fn no_sensitivity(heading: &Heading, line: usize, example: &str) -> Problem {
    let message = format!(
        "\"{}\" is in volts, but the sensitivity of its sensor is not given",
        shorten(&heading.name)
    );
    Problem::value(
        message,
        format!("give it as `sensitivity`, such as \"{example}\""),
    )
    .at_line(line)
}

/// The problem of a sensitivity for a column that is not in volts.
pub(crate) fn not_in_volts(what: &str) -> Problem {
    Problem::value(
        format!("{what} is not in volts, but a sensitivity is given"),
        "leave out `sensitivity`, or name the unit \
         of the column, such as \"[mV]\"",
    )
    .of(&["sensitivity"])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::headings::heading;

    /// 1 g is 9.80665 m/s²; 5 mV at 10 mV/g are half of it.
    #[test]
    fn sensitivities_are_read() {
        for (text, volts, si) in [
            ("10 mV/g", 5e-3, 0.5 * 9.80665),
            ("0.1 V/(m/s2)", 0.05, 0.5),
            ("100mV / m/s2", 0.05, 0.5),
            ("-2 mV/N", 1e-3, -0.5),
            ("1e3 uV/kN", 1e-3, 1e3),
            ("1 V/mm", 2.0, 2e-3),
        ] {
            let found = parse_sensitivity(text).unwrap().si_of(volts);
            assert!((found - si).abs() <= 1e-12 * si.abs(), "{text}: {found}");
        }
        for text in [
            "10", "10 mV", "mV/g", "10 A/g", "10 mV/s", "0 mV/g", "inf V/g", "10 g/mV", "",
        ] {
            assert!(
                parse_sensitivity(text).unwrap_err().hint.is_some(),
                "{text}"
            );
        }
    }

    #[test]
    fn columns_in_volts_are_known() {
        for (cell, volts) in [
            ("Force [mV]", Some(1e-3)),
            ("acc (V)", Some(1.0)),
            ("Load cell, V", Some(1.0)),
            ("acc_mV", Some(1e-3)),
            ("force [N]", None),
            ("V", None),
            ("acceleration", None),
        ] {
            assert_eq!(volts_of_heading(&heading(cell)), volts, "{cell}");
        }
    }
}
