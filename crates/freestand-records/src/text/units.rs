//! The unit of a record: stated by the file, else by the user, never guessed from the size of the
//! values.

use freestand::G0_M_S2;
use freestand_input::problem::Problem;
use freestand_input::quantity::{Dimension, Unit, find_unit, lookup, shorten};

/// Tenths of g, used by records from film.
pub(crate) const TENTHS_OF_G: Unit = Unit::acceleration("g/10", -1, G0_M_S2);

/// A unit that a file states, and the line that states it.
#[derive(Clone, Copy)]
pub(crate) struct Stated {
    pub(crate) unit: &'static Unit,
    pub(crate) line: usize,
}

/// A unit as record headers write it: `G`, `(g)`, `CM/SEC/SEC`, `cm/s**2`, `m s-2`.
pub(crate) fn record_unit(text: &str) -> Option<&'static Unit> {
    let text = text.trim_matches(|c: char| c.is_whitespace() || "()[]{}\"'.,;:".contains(c));
    // In a record, N means north.
    if let Some(unit) = lookup(text).filter(|unit| unit.symbol != "N") {
        return Some(unit);
    }
    // Headers are often in capitals: M/S/S does not mean megametre. MG alone is ambiguous (milli or
    // mega).
    if text.eq_ignore_ascii_case("mg") {
        return None;
    }
    let mut name = text.to_lowercase().replace("**", "");
    for (long, short) in [
        ("seconds", "s"),
        ("second", "s"),
        ("secs", "s"),
        ("sec", "s"),
        ("gals", "gal"),
        ("g's", "g"),
    ] {
        name = name.replace(long, short);
    }
    lookup(&name)
}

/// The unit that a line of prose states: "IN UNITS OF G", "The units are (g)", "Units: cm/s2",
/// "acceleration in gal".
pub(crate) fn unit_in_prose(line: &str) -> Option<&'static Unit> {
    // ASCII lower case keeps the byte positions of the original.
    let lower = line.to_ascii_lowercase();
    for (at, _) in lower.match_indices("unit") {
        let mut rest = line[at + 4..].trim_start_matches(['s', 'S']);
        loop {
            let trimmed =
                rest.trim_start_matches(|c: char| c.is_whitespace() || ":=([".contains(c));
            let word = ["of ", "are ", "is ", "in "]
                .iter()
                .find(|word| starts_with_ignore_case(trimmed, word));
            match word {
                Some(word) => rest = &trimmed[word.len()..],
                None => {
                    rest = trimmed;
                    break;
                }
            }
        }
        if let Some(unit) = leading_unit(rest).filter(|unit| unit.dimension != Dimension::Time) {
            return Some(unit);
        }
    }
    let bracketed = line
        .split(['(', '['])
        .skip(1)
        .filter_map(|part| part.split([')', ']']).next());
    if let Some(unit) = bracketed
        .filter_map(record_unit)
        .find(|unit| unit.dimension == Dimension::Acceleration)
    {
        return Some(unit);
    }
    if lower.contains("accel") {
        for (at, _) in lower.match_indices(" in ") {
            if let Some(unit) = leading_unit(&line[at + 4..])
                .filter(|unit| unit.dimension == Dimension::Acceleration)
            {
                return Some(unit);
            }
        }
    }
    None
}

fn starts_with_ignore_case(text: &str, start: &str) -> bool {
    text.as_bytes()
        .get(..start.len())
        .is_some_and(|head| head.eq_ignore_ascii_case(start.as_bytes()))
}

fn leading_unit(text: &str) -> Option<&'static Unit> {
    let joined = text.split('/').map(str::trim).collect::<Vec<_>>().join("/");
    let mut words = joined.split(|c: char| c.is_whitespace() || ",;)]".contains(c));
    let (first, second) = (words.next()?, words.next().unwrap_or(""));
    // "m s^-2" is two words.
    let is_power =
        second.starts_with(['s', 'S']) && (second.ends_with("-2") || second.ends_with("⁻²"));
    // In prose, "in" is a preposition before it is an inch.
    let unit = if is_power {
        record_unit(&format!("{first} {second}"))
    } else {
        record_unit(first)
    };
    unit.filter(|_| !first.trim_end_matches(':').eq_ignore_ascii_case("in"))
}

/// A problem if the first of `lines` that seems to state a unit states an unknown one: `a [kN]`,
/// `Units: furlong`.
pub(crate) fn not_known<'a>(lines: impl Iterator<Item = (usize, &'a str)>) -> Option<Problem> {
    let (line, text) = lines
        .filter_map(|(line, text)| Some((line, unknown_unit(text)?)))
        .next()?;
    Some(
        Problem::value(
            format!("the unit \"{}\" is not known", shorten(&text)),
            "state a known one with `unit`: g, m/s2, cm/s2 or another",
        )
        .at_line(line),
    )
}

/// The text in the last brackets of a heading, or after `units:`, `unit =`, `in units of`, if it is
/// not a unit.
fn unknown_unit(text: &str) -> Option<String> {
    let lower = text.to_ascii_lowercase();
    let stated = lower.find("unit").and_then(|at| {
        let rest = text[at + 4..].trim_start_matches(['s', 'S']).trim_start();
        let words = [":", "=", "of ", "are "];
        let rest = words
            .iter()
            .find(|word| starts_with_ignore_case(rest, word))
            .and_then(|word| rest.get(word.len()..))?;
        rest.trim_start()
            .split(|c: char| c.is_whitespace() || ",;".contains(c))
            .next()
    });
    let bracketed = || {
        let open = text.rfind(['[', '('])?;
        let inside = &text[open + 1..];
        inside.find([']', ')']).map(|close| &inside[..close])
    };
    let stated = stated.or_else(bracketed)?.trim();
    let is_other = stated.is_empty()
        || record_unit(stated).is_some()
        || super::direction::Direction::parse(stated).is_some();
    (!is_other && stated.contains(char::is_alphabetic)).then(|| stated.to_owned())
}

/// The unit that the user states.
pub(crate) fn requested(option: Option<&str>) -> Result<Option<&'static Unit>, Problem> {
    option
        .map(|text| find_unit(text, Dimension::Acceleration))
        .transpose()
}

/// The unit to read in: the stated one, else the requested one. If there are both, they must agree.
pub(crate) fn decide(
    stated: Option<Stated>,
    requested: Option<&'static Unit>,
    what: &str,
) -> Result<&'static Unit, Problem> {
    match (stated, requested) {
        (Some(stated), _) if stated.unit.dimension != Dimension::Acceleration => {
            Err(not_acceleration(stated, what))
        }
        // gal and cm/s2 are the same unit, so the values are compared.
        (Some(stated), Some(requested)) if stated.unit.to_si(1.0) != requested.to_si(1.0) => {
            Err(Problem::value(
                format!(
                    "{what} is in {} according to the file, not in {}",
                    stated.unit.symbol, requested.symbol
                ),
                "leave out `unit`, or correct the file if it is wrong",
            )
            .at_line(stated.line))
        }
        (Some(stated), _) => Ok(stated.unit),
        (None, Some(requested)) => Ok(requested),
        (None, None) => Err(Problem::value(
            format!("the unit of {what} is not stated in the file"),
            "state it with `unit`: g, m/s2, cm/s2 or another",
        )),
    }
}

fn not_acceleration(stated: Stated, what: &str) -> Problem {
    Problem::format(
        format!(
            "{what} is {} ({}); an acceleration is expected",
            stated.unit.dimension.with_article(),
            stated.unit.symbol
        ),
        "use the acceleration record of the same station",
    )
    .at_line(stated.line)
}

/// What to do about a missing value.
pub(crate) const GAP: &str =
    "a motion with gaps cannot be used: repair the record or cut it before the gap";

/// The problem of a value that marks a missing value.
pub(crate) fn missing(text: &str, line: usize) -> Problem {
    Problem::format(format!("\"{}\" marks a missing value", shorten(text)), GAP).at_line(line)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_of_headers() {
        for (line, symbol) in [
            ("ACCELERATION TIME SERIES IN UNITS OF G", Some("g")),
            (
                "ACCELERATION TIME HISTORY IN UNITS OF G. FILTER POINTS: HP=0.1 Hz LP=40.0 Hz",
                Some("g"),
            ),
            ("The units are (g)", Some("g")),
            ("(UNITS: CM/SEC/SEC)", Some("cm/s2")),
            ("Units of cm / sec / sec, corrected", Some("cm/s2")),
            ("units=m/s^2 dt=0.005 columns=1", Some("m/s2")),
            ("unit: m/s**2", Some("m/s2")),
            ("UNITS OF M/S/S", Some("m/s2")),
            ("units gal", Some("gal")),
            ("Acceleration (g)", Some("g")),
            ("acceleration in m/sec2", Some("m/s2")),
            ("VELOCITY TIME SERIES IN UNITS OF CM/S", Some("cm/s")),
            ("DISPLACEMENT TIME SERIES IN UNITS OF CM", Some("cm")),
            ("UNITS ARE SEC AND G/10", None),
            ("UNITS OF G/10", Some("g/10")),
            ("units: m s^-2", Some("m/s2")),
            ("UNITS: CM S-2, corrected", Some("cm/s2")),
            ("acceleration [%g]", Some("%g")),
            ("acceleration (in/sec^2)", Some("in/s2")),
            ("United States Geological Survey (USGS)", None),
            ("recorded in g block 4", None),
            ("UNITS OF MG", None),
            ("units", None),
        ] {
            assert_eq!(
                unit_in_prose(line).map(|unit| unit.symbol),
                symbol,
                "{line}"
            );
        }
    }

    #[test]
    fn units_that_are_not_known_are_named() {
        for (line, unit) in [
            ("a [furlong/s2]", Some("furlong/s2")),
            ("Units: counts, raw", Some("counts")),
            ("IN UNITS OF VOLT", Some("VOLT")),
            ("a (NS)", None),
            ("a [g]", None),
            ("a [1]", None),
            ("a", None),
            ("United States Geological Survey", None),
        ] {
            let said = unit.map(|unit| format!("line 7: the unit \"{unit}\" is not known"));
            assert_eq!(
                not_known([(7, line)].into_iter()).map(|problem| problem.to_string()),
                said,
                "{line}"
            );
        }
    }

    #[test]
    fn the_file_and_the_flag_must_agree() {
        let cm = Some(Stated {
            unit: lookup("cm/s2").unwrap(),
            line: 3,
        });
        assert_eq!(
            decide(cm, requested(Some("gal")).unwrap(), "it")
                .unwrap()
                .symbol,
            "cm/s2"
        );
        assert_eq!(decide(cm, None, "it").unwrap().symbol, "cm/s2");
        assert_eq!(
            decide(cm, requested(Some("g")).unwrap(), "it")
                .unwrap_err()
                .line,
            Some(3)
        );
        assert_eq!(
            decide(None, requested(Some("g")).unwrap(), "it")
                .unwrap()
                .symbol,
            "g"
        );
        assert!(
            decide(None, None, "it")
                .unwrap_err()
                .hint
                .unwrap()
                .contains("`unit`")
        );
        assert!(requested(Some("mm")).is_err());
    }
}
