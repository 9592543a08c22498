//! Reads options of processing as people write them.

use std::path::PathBuf;

use freestand::oscillator::DAMPING_RATIO;
use freestand::signal::baseline::{Baseline, MAX_DEGREE};
use freestand::signal::filter::MAX_ORDER;

use super::{FILTER_ORDER, Processing, Scale, TargetSource, read_target};
use crate::formats::check_step;
use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::quantity::{Dimension, parse, parse_non_negative, parse_positive, shorten};
use freestand_input::word_reader::WordReader;

/// The keys of the last step, of which only one is possible.
const SCALES: [&str; 4] = ["scale", "scale_to", "scale_to_sa", "scale_to_spectrum"];

impl Processing {
    /// Processing as a person wrote it; `find` gives the path of a file that is named. What no
    /// record allows is added to the problems of the reader.
    ///
    /// # Example
    /// ```
    /// use freestand_input::word_reader::WordReader;
    /// use freestand_records::processing::Processing;
    /// let words = [("low_cut", "0.1 Hz"), ("taper", "60 %")].into_iter().collect();
    /// let mut reader = WordReader::new(&words);
    /// let processing = Processing::read(&mut reader, freestand_input::file::as_named);
    /// assert_eq!(processing.low_cut_hz, Some(0.1));
    /// assert_eq!(reader.problems.problems[0].keys, ["taper"]);
    /// ```
    pub fn read(
        reader: &mut WordReader<'_>,
        find: impl Fn(&str) -> Result<PathBuf, Problem>,
    ) -> Self {
        reader.exclusive("component", "azimuth");
        for (i, first) in SCALES.iter().enumerate() {
            SCALES
                .iter()
                .skip(i + 1)
                .for_each(|second| reader.exclusive(first, second));
        }
        let share = [
            "above 0 and at most 50 %",
            "above 0 and up to 50 %; 5 % is usual",
        ];
        let processing = Self {
            keep_mean: reader.flag("keep_mean"),
            azimuth_deg: reader
                .quantity("azimuth", Dimension::Angle)
                .map(azimuth_deg),
            baseline: reader.read("baseline", parse_baseline),
            taper_ratio: reader.accepted(
                "taper",
                Dimension::Ratio,
                |share| share > 0.0 && share <= 0.5,
                share,
            ),
            low_cut_hz: reader.positive("low_cut", Dimension::Frequency),
            high_cut_hz: reader.positive("high_cut", Dimension::Frequency),
            filter_order: filter_order(reader),
            resample_dt_s: read_step(reader, "resample"),
            scale: scale(reader, find),
        };
        if let (Some(low), Some(high)) = (processing.low_cut_hz, processing.high_cut_hz)
            && low >= high
        {
            let message = format!("`low_cut`: {low} Hz is not below the high cut of {high} Hz");
            let hint =
                "choose a lower low cut or a higher high cut: frequencies between them are kept";
            reader.note(&["low_cut"], message, hint);
        }
        processing
    }
}

fn filter_order(reader: &mut WordReader<'_>) -> u32 {
    let Some(order) = reader.whole("filter_order") else {
        return FILTER_ORDER;
    };
    if !reader.has("low_cut") && !reader.has("high_cut") {
        let hint = "give one of them, such as `low_cut = \"0.1 Hz\"`";
        reader.note(
            &["filter_order"],
            "`filter_order` needs `low_cut` or `high_cut`",
            hint,
        );
    } else if !(1..=MAX_ORDER).contains(&order) {
        let message = format!("`filter_order` must be 1 to {MAX_ORDER}, not {order}");
        reader.note(&["filter_order"], message, "4 is usual");
    }
    order
}

/// Beyond this a factor is a slip: even a pulse of unit height in cm/s² becomes 10 g.
const MAX_FACTOR: f64 = 1e4;

fn scale(reader: &mut WordReader<'_>, find: impl Fn(&str) -> Result<PathBuf, Problem>) -> Scale {
    let factor = [
        "a number other than 0, up to 10000 either way",
        "other than 0 and of at most 10000, or leave it out to use the record as it is",
    ];
    let is_factor = |factor: f64| factor != 0.0 && factor.abs() <= MAX_FACTOR;
    let factor = reader.accepted("scale", Dimension::Ratio, is_factor, factor);
    let peak = reader.positive("scale_to", Dimension::Acceleration);
    let sa = reader.read("scale_to_sa", parse_sa_target);
    let spectrum = reader
        .read("scale_to_spectrum", parse_target_source)
        .and_then(|source| {
            let path = find(&source.path.to_string_lossy());
            let read = path.and_then(|path| read_target(&TargetSource { path, ..source }));
            // A problem in the file names the file.
            let named = read.map_err(|problem| match problem.path {
                Some(_) => problem.of(&["scale_to_spectrum"]),
                None => problem.named("scale_to_spectrum"),
            });
            reader.problems.keep(named)
        });
    let peak = peak.map(|target_m_s2| Scale::Peak { target_m_s2 });
    peak.or(sa)
        .or(spectrum.map(Scale::Spectrum))
        .unwrap_or(Scale::Factor(factor.unwrap_or(1.0)))
}

/// A time step that a record may have \[s\]; a wrong one is added to the problems of the reader.
pub fn read_step(reader: &mut WordReader<'_>, key: &'static str) -> Option<f64> {
    let dt_s = reader.quantity(key, Dimension::Time)?;
    reader.keep(key, check_step(dt_s, ProblemKind::Value).map(|()| dt_s))
}

/// As [`read_step`], of a text.
///
/// # Errors
/// A text that is not a time; a step that no record has.
pub fn parse_step(text: &str) -> Result<f64, Problem> {
    let dt_s = parse(text, Dimension::Time)?;
    check_step(dt_s, ProblemKind::Value).map(|()| dt_s)
}

const KNOWN: &str = "known: mean, pre-event:5s, linear, quadratic, cubic, poly:4, graizer, graizer:2:5s, boore:10s:25s";

/// A baseline, as `mean`, `pre-event:5s`, `linear`, `quadratic`, `cubic`, `poly:4`, `graizer`
/// (degree 2 from 0 s), `graizer:3:5s`, `boore:10s:25s`.
///
/// # Errors
/// An unknown word, too few or too many parts, a time without its unit, a degree above 10.
///
/// # Example
/// ```
/// use freestand::signal::baseline::Baseline;
/// use freestand_records::processing::parse_baseline;
/// assert_eq!(parse_baseline("pre-event:5s")?, Baseline::PreEvent { until_s: 5.0 });
/// assert_eq!(parse_baseline("Quadratic")?, Baseline::Polynomial { degree: 2 });
/// # Ok::<(), freestand_input::problem::Problem>(())
/// ```
pub fn parse_baseline(text: &str) -> Result<Baseline, Problem> {
    let parts: Vec<&str> = text.split(':').map(str::trim).collect();
    let word = parts
        .first()
        .map(|word| word.to_lowercase())
        .unwrap_or_default();
    let from_zero = |text: &str| parse_non_negative(text, Dimension::Time, "the time");
    let polynomial = |degree: usize| Ok(Baseline::Polynomial { degree });
    let graizer = |degree: usize, from_s: f64| Ok(Baseline::Graizer { degree, from_s });
    match (word.as_str(), parts.get(1..).unwrap_or_default()) {
        ("mean", []) => Ok(Baseline::Mean),
        ("pre-event", [until]) => Ok(Baseline::PreEvent {
            until_s: parse_positive(until, Dimension::Time, "the time")?,
        }),
        ("linear", []) => polynomial(1),
        ("quadratic", []) => polynomial(2),
        ("cubic", []) => polynomial(3),
        ("poly", [degree]) => polynomial(parse_degree(degree, 0)?),
        ("graizer", []) => graizer(2, 0.0),
        ("graizer", [degree]) => graizer(parse_degree(degree, 1)?, 0.0),
        ("graizer", [degree, from]) => graizer(parse_degree(degree, 1)?, from_zero(from)?),
        ("boore", [t1, t2]) => {
            let (t1_s, t2_s) = (from_zero(t1)?, parse(t2, Dimension::Time)?);
            if t1_s < t2_s {
                return Ok(Baseline::Boore2001 { t1_s, t2_s });
            }
            Err(wrong(
                text,
                "does not end after it begins",
                "the shaking lasts from the first time to the second",
            ))
        }
        ("pre-event" | "poly" | "boore", _) => Err(wrong(text, "is incomplete", KNOWN)),
        _ => Err(wrong(text, "is not a baseline", KNOWN)),
    }
}

fn parse_degree(text: &str, least: usize) -> Result<usize, Problem> {
    let degree = text
        .parse::<usize>()
        .ok()
        .filter(|degree| (least..=MAX_DEGREE).contains(degree));
    degree.ok_or_else(|| {
        wrong(
            text,
            "is not a degree",
            format!("write a whole number from {least} to {MAX_DEGREE}, such as poly:4"),
        )
    })
}

/// A target for scaling, such as `0.4 g at 1.2 s`, or for a damping other than 5 %
/// `0.4 g at 1.2 s, 2 %`.
///
/// # Errors
/// Anything else, a target that is not positive, a negative period, damping of 100 % or more.
///
/// # Example
/// ```
/// use freestand_records::processing::{Scale, parse_sa_target};
/// let target = parse_sa_target("3 m/s2 at 1.2 s")?;
/// assert_eq!(target, Scale::Sa { target_m_s2: 3.0, period_s: 1.2, damping_ratio: 0.05 });
/// # Ok::<(), freestand_input::problem::Problem>(())
/// ```
pub fn parse_sa_target(text: &str) -> Result<Scale, Problem> {
    const HINT: &str =
        "write \"0.4 g at 1.2 s\", or \"0.4 g at 1.2 s, 2 %\" for a damping other than 5 %";
    let Some((target, rest)) = text.split_once(" at ") else {
        return Err(wrong(text, "is not an acceleration at a period", HINT));
    };
    let (period, damping) = rest
        .split_once(',')
        .map_or((rest, None), |(period, damping)| (period, Some(damping)));
    let damping_ratio = match damping {
        Some(damping) => parse(damping, Dimension::Ratio)?,
        None => DAMPING_RATIO,
    };
    if !(0.0..1.0).contains(&damping_ratio) {
        return Err(wrong(
            text,
            "does not have a damping from 0 to below 100 %",
            HINT,
        ));
    }
    Ok(Scale::Sa {
        target_m_s2: parse_positive(target, Dimension::Acceleration, "the acceleration")?,
        period_s: parse_non_negative(period, Dimension::Time, "the period")?,
        damping_ratio,
    })
}

/// A file with a target spectrum, such as `target.csv`, and after commas a range of periods and
/// another damping, `target.csv, 0.1 s to 2 s, 2 %`. The path is kept as it is written.
///
/// # Errors
/// No file, a range that ends before it begins, damping of 100 % or more, too many parts.
///
/// # Example
/// ```
/// use freestand_records::processing::{TargetSource, parse_target_source};
/// let source = parse_target_source("target.csv, 200 ms to 2 s")?;
/// let expected = TargetSource { path: "target.csv".into(), range_s: Some((0.2, 2.0)), damping_ratio: None };
/// assert_eq!(source, expected);
/// # Ok::<(), freestand_input::problem::Problem>(())
/// ```
pub fn parse_target_source(text: &str) -> Result<TargetSource, Problem> {
    const HINT: &str = "write a file name, then periods and damping after commas: \"target.csv, 0.1 s to 2 s, 2 %\"";
    let mut parts = text.split(',').map(str::trim);
    let path = parts
        .next()
        .filter(|path| !path.is_empty())
        .ok_or_else(|| wrong(text, "does not name a file", HINT))?;
    let mut source = TargetSource {
        path: path.into(),
        range_s: None,
        damping_ratio: None,
    };
    for part in parts {
        let given = if let Some((from, to)) = part.split_once(" to ") {
            let from_s = parse_non_negative(from, Dimension::Time, "the period")?;
            let to_s = parse(to, Dimension::Time)?;
            if from_s > to_s {
                return Err(wrong(part, "ends before it begins", HINT));
            }
            source.range_s.replace((from_s, to_s)).is_some()
        } else {
            let ratio = parse(part, Dimension::Ratio)
                .map_err(|_| wrong(part, "is neither a range of periods nor a damping", HINT))?;
            if !(0.0..1.0).contains(&ratio) {
                return Err(wrong(part, "is not a damping from 0 to below 100 %", HINT));
            }
            source.damping_ratio.replace(ratio).is_some()
        };
        if given {
            return Err(wrong(part, "is one part too many", HINT));
        }
    }
    Ok(source)
}

/// Radians to degrees, rounded so that 30 degrees converted to radians come back as 30.
pub fn azimuth_deg(azimuth_rad: f64) -> f64 {
    (azimuth_rad.to_degrees() * 1e9).round() / 1e9
}

fn wrong(text: &str, why: &str, hint: impl Into<String>) -> Problem {
    Problem::value(format!("\"{}\" {why}", shorten(text.trim())), hint)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn baselines_are_read_as_they_are_written() {
        for (text, expected) in [
            ("mean", Baseline::Mean),
            (" Mean ", Baseline::Mean),
            ("pre-event:500 ms", Baseline::PreEvent { until_s: 0.5 }),
            ("linear", Baseline::Polynomial { degree: 1 }),
            ("cubic", Baseline::Polynomial { degree: 3 }),
            ("poly:0", Baseline::Polynomial { degree: 0 }),
            ("poly: 10", Baseline::Polynomial { degree: 10 }),
            (
                "graizer",
                Baseline::Graizer {
                    degree: 2,
                    from_s: 0.0,
                },
            ),
            (
                "graizer:3",
                Baseline::Graizer {
                    degree: 3,
                    from_s: 0.0,
                },
            ),
            (
                "graizer:3:5s",
                Baseline::Graizer {
                    degree: 3,
                    from_s: 5.0,
                },
            ),
            (
                "boore:10s:25 s",
                Baseline::Boore2001 {
                    t1_s: 10.0,
                    t2_s: 25.0,
                },
            ),
        ] {
            assert_eq!(parse_baseline(text), Ok(expected), "{text}");
        }
        for text in [
            "",
            "means",
            "mean:3",
            "pre-event",
            "pre-event:5",
            "pre-event:-5s",
            "pre-event:0s",
            "poly",
            "poly:-1",
            "poly:11",
            "poly:2.5",
            "graizer:0",
            "graizer:2:-1s",
            "graizer:2:1s:2s",
            "boore",
            "boore:5s",
            "boore:5s:5s",
            "boore:nan s:5s",
            "linear:2",
        ] {
            let problem = parse_baseline(text).unwrap_err();
            assert!(
                problem.hint.is_some() || problem.message.contains("must"),
                "{text}: {problem:?}"
            );
        }
    }

    #[test]
    fn targets_are_read_as_they_are_written() {
        let target = parse_sa_target("0.4 g at 1200 ms, 2 %").unwrap();
        assert_eq!(
            target,
            Scale::Sa {
                target_m_s2: 0.4 * freestand::G0_M_S2,
                period_s: 1.2,
                damping_ratio: 0.02
            }
        );
        for text in [
            "0.4 g",
            "0.4 at 1 s",
            "0.4 g at 1",
            "-1 g at 1 s",
            "0 g at 1 s",
            "1 g at -1 s",
            "1 g at 1 s, 100 %",
            "",
        ] {
            assert!(parse_sa_target(text).is_err(), "{text}");
        }
    }

    #[test]
    fn sources_of_targets_are_read_as_they_are_written() {
        let whole = TargetSource {
            path: "a b/t.csv".into(),
            range_s: None,
            damping_ratio: None,
        };
        for (text, expected) in [
            (" a b/t.csv ", whole.clone()),
            (
                "a b/t.csv, 2 %",
                TargetSource {
                    damping_ratio: Some(0.02),
                    ..whole.clone()
                },
            ),
            (
                "a b/t.csv,0.02",
                TargetSource {
                    damping_ratio: Some(0.02),
                    ..whole.clone()
                },
            ),
            (
                "a b/t.csv, 0 s to 500 ms",
                TargetSource {
                    range_s: Some((0.0, 0.5)),
                    ..whole.clone()
                },
            ),
            (
                "a b/t.csv, 0 %, 1 s to 1 s",
                TargetSource {
                    range_s: Some((1.0, 1.0)),
                    damping_ratio: Some(0.0),
                    ..whole.clone()
                },
            ),
        ] {
            assert_eq!(parse_target_source(text), Ok(expected), "{text}");
        }
        for text in [
            "",
            ", 5 %",
            "t.csv,",
            "t.csv, 5 s",
            "t.csv, 100 %",
            "t.csv, -1 %",
            "t.csv, 2 s to 1 s",
            "t.csv, -1 s to 1 s",
            "t.csv, 1 to 2",
            "t.csv, 1 %, 2 %",
            "t.csv, 1 s to 2 s, 1 s to 2 s",
        ] {
            assert!(parse_target_source(text).is_err(), "{text}");
        }
    }
}
