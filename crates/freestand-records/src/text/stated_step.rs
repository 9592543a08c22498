//! A time step that the text above the numbers states in words.

use super::fortran::scan;
use freestand_input::problem::Problem;

/// The step \[s\] that `dt=0.005` or `dt = 5 ms` states in a comment; in seconds unless a unit
/// follows.
///
/// # Errors
/// A step that is not a number, not positive, or in another unit.
pub(crate) fn dt_in_comment(text: &str) -> Option<Result<f64, Problem>> {
    let value = text.match_indices('=').find_map(|(at, _)| {
        let key = text[..at]
            .trim_end()
            .rsplit(|c: char| c.is_whitespace() || ",;(".contains(c))
            .next()?;
        key.eq_ignore_ascii_case("dt").then_some(&text[at + 1..])
    })?;
    Some(
        seconds(value)
            .filter(|dt_s| *dt_s > 0.0 && dt_s.is_finite())
            .ok_or_else(|| {
                let value = value.split([',', ';', ')']).next().unwrap_or(value).trim();
                let message = format!(
                    "dt must be positive and in s or ms, not \"{}\"",
                    freestand_input::quantity::shorten(value)
                );
                Problem::value(message, "write it as \"dt=0.005\", in seconds")
            }),
    )
}

/// The step \[s\] that prose states: `Sampling rate: 100 Hz`, `SAMPLING RATE= 100Hz`,
/// `Time step = 0.01 s`, `dt=0.01`. A rate must be in hertz.
pub(crate) fn step_in_prose(text: &str) -> Option<f64> {
    // ASCII lower case keeps the byte positions.
    let lower = text.to_ascii_lowercase();
    let value = |key: &str| {
        lower
            .split_once(key)
            .map(|(_, rest)| rest.trim_start_matches([' ', '\t', '=', ':']))
    };
    let step = [
        "time step",
        "time interval",
        "sampling interval",
        "sampling period",
        "time increment",
    ]
    .into_iter()
    .find_map(|key| value(key).and_then(seconds));
    let rate = ["sampling rate", "sampling frequency"]
        .into_iter()
        .find_map(|key| {
            let text = value(key)?;
            let rate = scan(text.as_bytes())?;
            let unit = text[rate.length..].trim_start();
            (unit.starts_with("hz") || unit.starts_with("sps")).then_some(1.0 / rate.value)
        });
    let dt_s = step.or(rate).or_else(|| dt_in_comment(text)?.ok())?;
    (dt_s > 0.0 && dt_s.is_finite()).then_some(dt_s)
}

/// The number of values that `npts: 6` or `NPTS=6` states.
pub(crate) fn count_in_words(text: &str) -> Option<f64> {
    let lower = text.to_ascii_lowercase();
    let (before, rest) = lower.split_once("npts")?;
    let rest = rest.trim_start().strip_prefix(['=', ':'])?.trim_start();
    let number = scan(rest.as_bytes())
        .filter(|number| number.value >= 1.0 && number.value.fract() == 0.0)?;
    (!before.ends_with(|c: char| c.is_alphanumeric())).then_some(number.value)
}

/// A number and its unit of time at the start of `text`.
fn seconds(text: &str) -> Option<f64> {
    let text = text.trim_start_matches([' ', '\t', '(']);
    let number = scan(text.as_bytes())?;
    let rest = &text[number.length..];
    let unit: String = rest
        .trim_start()
        .chars()
        .take_while(|c| c.is_alphabetic() || *c == 'µ')
        .collect();
    match unit.to_lowercase().as_str() {
        "ms" | "msec" | "milliseconds" => Some(number.value / 1000.0),
        "" | "s" | "sec" | "secs" | "second" | "seconds" => Some(number.value),
        // After a blank another statement may begin: "dt=0.005 columns=2".
        _ if rest.starts_with([' ', '\t'])
            && rest.trim_start()[unit.len()..]
                .trim_start()
                .starts_with(['=', ':']) =>
        {
            Some(number.value)
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_in_words() {
        for (text, expected) in [
            ("Sampling rate: 100 Hz", Some(0.01)),
            ("SAMPLING RATE= 100Hz", Some(0.01)),
            ("Time step = 0.01 s", Some(0.01)),
            ("Time Interval (5 ms)", Some(0.005)),
            ("dt=0.02, npts=7", Some(0.02)),
            ("Sampling rate: 100", None),
            ("Sampling interval: 1 min", None),
            ("Sampling rate: 0 Hz", None),
            ("time stepping", None),
        ] {
            assert_eq!(step_in_prose(text), expected, "{text}");
        }
        for (text, expected) in [
            ("units=g dt=0.005 columns=2", Some(0.005)),
            ("dt = 5 ms, x", Some(0.005)),
            ("DT=5ms", Some(0.005)),
            ("(dt= .01)", Some(0.01)),
            ("dt=1D-2", Some(0.01)),
            ("width=3", None),
        ] {
            assert_eq!(
                dt_in_comment(text).map(|dt| dt.unwrap()),
                expected,
                "{text}"
            );
        }
        for (text, count) in [
            ("npts: 6", Some(6.0)),
            ("dt=0.01 NPTS=1e3, x", Some(1000.0)),
            ("npts 6", None),
            ("xnpts=6", None),
        ] {
            assert_eq!(count_in_words(text), count, "{text}");
        }
        for text in ["dt=-1", "dt=0", "dt=x", "dt=5 min", "dt=5us"] {
            assert!(dt_in_comment(text).unwrap().is_err(), "{text}");
        }
    }
}
