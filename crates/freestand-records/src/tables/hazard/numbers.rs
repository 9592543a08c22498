//! Numbers of hazard files, and the curves and spectra that they make.

use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;
use freestand_input::words::{counted, shortest};

use super::{Coordinates, Curve, GroundMeasure, ReturnSpectrum};

/// A number with the name of its place in the file, for what is wrong with it.
#[derive(Clone)]
pub(super) struct Value {
    pub(super) number: f64,
    pub(super) place: String,
    pub(super) line: Option<usize>,
}

impl Value {
    pub(super) fn problem(&self, message: impl AsRef<str>, hint: &str) -> Problem {
        let problem = Problem::value(format!("{}: {}", self.place, message.as_ref()), hint);
        match self.line {
            Some(line) => problem.at_line(line),
            None => problem,
        }
    }
}

/// What the numbers of a curve are beside its intensities.
#[derive(Clone, Copy)]
pub(super) enum Exceedance {
    /// Probabilities in so many years.
    Probabilities { years: f64 },
    /// Rates a year.
    Rates,
}

/// PGV of files, which is in cm/s, in m/s.
pub(super) const PGV_M_S: f64 = 0.01;

const DOWNLOAD: &str = "download the file again, or correct the value";

/// A curve of intensities in units of its measure, each with its exceedance.
///
/// A probability p in T years is a rate −ln(1 − p)/T. A probability of 1 has no rate, and one of 0 no
/// logarithm: such points are left out. Files are rounded, so that neighbours may have the same rate: the
/// stronger motions are then as frequent as the weaker ones, and their point is kept.
pub(super) fn curve(
    measure: GroundMeasure,
    points: impl IntoIterator<Item = (Value, Value)>,
    kind: Exceedance,
) -> Result<Curve, Problem> {
    let mut out = Curve {
        measure,
        points: Vec::new(),
        certain: 0,
        equal: 0,
    };
    let (mut x_before, mut y_before): (Option<f64>, Option<f64>) = (None, None);
    let mut line = None;
    for (x, y) in points {
        line = y.line;
        if !(x.number > 0.0 && x.number.is_finite()) {
            let message = format!("the intensity {} is not a number above 0", x.number);
            return Err(x.problem(message, DOWNLOAD));
        }
        if let Some(before) = x_before.filter(|before| *before >= x.number) {
            let (here, before) = (shortest(x.number), shortest(before));
            let message = format!("the intensity {here} is not above {before}, the one before it");
            let hint = "sort the points by rising intensity, and give each intensity once";
            return Err(x.problem(message, hint));
        }
        let is_fine = match kind {
            Exceedance::Probabilities { .. } => (0.0..=1.0).contains(&y.number),
            Exceedance::Rates => y.number >= 0.0 && y.number.is_finite(),
        };
        if !is_fine {
            let (what, hint) = match kind {
                Exceedance::Probabilities { .. } => (
                    "a probability",
                    "write the probability that the intensity is exceeded, from 0 to 1",
                ),
                Exceedance::Rates => ("an annual rate of 0 or more", DOWNLOAD),
            };
            return Err(y.problem(format!("{} is not {what}", y.number), hint));
        }
        if let Some(before) = y_before.filter(|before| *before < y.number) {
            let (here, before) = (shortest(y.number), shortest(before));
            let message = format!(
                "the rate {here} is not below {before}, that of the weaker motions before it"
            );
            let hint =
                "each stronger intensity must be rarer: correct the rate, or leave the point out";
            return Err(y.problem(message, hint));
        }
        (x_before, y_before) = (Some(x.number), Some(y.number));
        let rate = match kind {
            Exceedance::Rates => y.number,
            Exceedance::Probabilities { .. } if y.number == 1.0 => {
                out.certain += 1;
                continue;
            }
            Exceedance::Probabilities { years } => -(-y.number).ln_1p() / years,
        };
        if rate == 0.0 {
            continue;
        }
        if out.points.last().is_some_and(|last| last.1 == rate) {
            out.equal += 1;
            out.points.pop();
        }
        out.points.push((x.number, rate));
    }
    if out.points.len() < 2 {
        let count = out.points.len();
        let message = format!(
            "{} of the site {} a rate above 0 or a probability between 0 and 1, but a hazard curve needs two",
            counted(count, "intensity"),
            if count == 1 { "has" } else { "have" }
        );
        let problem = Problem::value(
            message,
            "export the curve with weaker or stronger intensities, or a shorter investigation time",
        );
        return Err(match line {
            Some(line) => problem.at_line(line),
            None => problem,
        });
    }
    Ok(out)
}

/// A curve through values at return periods \[years\], the shortest first, each times a factor.
pub(super) fn at_return_periods(
    measure: GroundMeasure,
    factor: f64,
    values: impl IntoIterator<Item = (f64, Value)>,
) -> Result<Curve, Problem> {
    let points = values.into_iter().map(|(years, value)| {
        let rate = Value {
            number: years.recip(),
            ..value.clone()
        };
        let intensity = Value {
            number: factor * value.number,
            ..value
        };
        (intensity, rate)
    });
    curve(measure, points, Exceedance::Rates)
}

/// A value of a spectrum at a return period \[years\].
pub(super) fn at_years(years: f64, number: f64) -> Value {
    Value {
        number,
        place: format!("the value at {years:.0} years"),
        line: None,
    }
}

/// A spectrum of periods with accelerations \[s, g\].
pub(super) fn spectrum(
    years: Option<f64>,
    values: impl IntoIterator<Item = (f64, Value)>,
) -> Result<ReturnSpectrum, Problem> {
    let mut out: Vec<(f64, f64)> = Vec::new();
    for (period_s, value) in values {
        if !(period_s >= 0.0 && period_s.is_finite()) {
            let message = format!("a period must be 0 s or more, not {period_s} s");
            return Err(value.problem(message, DOWNLOAD));
        }
        if !(value.number > 0.0 && value.number.is_finite()) {
            let message = format!("the acceleration {} is not a number above 0", value.number);
            return Err(value.problem(message, DOWNLOAD));
        }
        if out.iter().any(|one| one.0 == period_s) {
            let message = format!("the period {} s is listed twice", shortest(period_s));
            return Err(value.problem(message, "keep only one of them"));
        }
        out.push((period_s, value.number));
    }
    out.sort_by(|a, b| a.0.total_cmp(&b.0));
    Ok(ReturnSpectrum { years, values: out })
}

/// The return period of a probability in so many years \[years\].
pub(super) fn return_period(probability: f64, years: f64) -> Option<f64> {
    (probability > 0.0 && probability < 1.0).then(|| -years / (-probability).ln_1p())
}

/// Years that a file states, above 0.
pub(super) fn years(text: &str) -> Result<f64, Problem> {
    let years = text.trim().parse::<f64>().ok();
    years
        .filter(|years| *years > 0.0 && years.is_finite())
        .ok_or_else(|| {
            let message = format!(
                "the investigation time \"{}\" is not a number of years above 0",
                shorten(text)
            );
            Problem::value(message, "download the file again")
        })
}

/// The measure that files call `PGA`, `PGV`, `SA(0.2)` or `SA0P2`, and the factor from their unit to that of the measure: PGV
/// is in cm/s.
pub(super) fn measure(text: &str) -> Option<(GroundMeasure, f64)> {
    let text = text.trim();
    match text {
        "PGA" => return Some((GroundMeasure::Pga, 1.0)),
        "PGV" => return Some((GroundMeasure::Pgv, PGV_M_S)),
        _ => {}
    }
    let rest = text.strip_prefix("SA")?;
    let rest = rest
        .strip_prefix('(')
        .and_then(|rest| rest.strip_suffix(')'))
        .map_or_else(|| rest.replacen('P', ".", 1), str::to_owned);
    let period_s = rest.parse::<f64>().ok()?;
    (period_s > 0.0 && period_s.is_finite()).then_some((GroundMeasure::Sa { period_s }, 1.0))
}

/// A point on the globe.
pub(super) fn coordinates(longitude: &Value, latitude: &Value) -> Result<Coordinates, Problem> {
    let within = |value: &Value, most: f64| {
        if value.number.abs() <= most {
            return Ok(value.number);
        }
        let message = format!(
            "{} is not an angle from -{most} to {most} degrees",
            value.number
        );
        Err(value.problem(message, "write decimal degrees, such as -33.9"))
    };
    let longitude = within(longitude, 360.0)?;
    Ok(Coordinates {
        latitude_deg: within(latitude, 90.0)?,
        longitude_deg: if longitude > 180.0 {
            longitude - 360.0
        } else {
            longitude
        },
    })
}
