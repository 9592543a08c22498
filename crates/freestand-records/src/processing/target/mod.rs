//! The spectrum to which records are scaled.

use std::path::{Path, PathBuf};

use crate::tables::{SpectrumRow, load_spectrum, parse_spectrum};
use freestand::oscillator::DAMPING_RATIO;
use freestand_input::file::InputFile;
use freestand_input::problem::Problem;
use freestand_input::words::{number, percent_significant};

/// Dampings and periods that differ by less than this share are equal, printed with fewer digits.
const SAME: f64 = 1e-6;

/// The file of a target spectrum, and which part of it is used.
#[derive(Debug, Clone, PartialEq)]
pub struct TargetSource {
    /// The file.
    pub path: PathBuf,
    /// The shortest and the longest period to use \[s\]; `None`: all.
    pub range_s: Option<(f64, f64)>,
    /// Damping ratio; `None`: that of the file if it states only one, else 5 %.
    pub damping_ratio: Option<f64>,
}

/// A spectrum to which records are scaled.
#[derive(Debug, Clone, PartialEq)]
pub struct TargetSpectrum {
    /// Its name in the step that scales to it.
    pub name: String,
    /// The file that it was read from.
    pub file: Option<InputFile>,
    /// Periods, each once; 0 is the peak acceleration \[s\].
    pub periods_s: Vec<f64>,
    /// Pseudo-accelerations at them \[m/s²\].
    pub psa_m_s2: Vec<f64>,
    /// Their damping ratio.
    pub damping_ratio: f64,
    /// A note about what was left out of the file.
    pub note: Option<String>,
}

/// Reads a target from its file.
///
/// # Errors
/// A file that cannot be read or is not a table of periods and accelerations with units in its
/// headings; values that no spectrum has, a period that is listed twice; a damping that the file
/// does not have; a range without periods.
pub fn read_target(source: &TargetSource) -> Result<TargetSpectrum, Problem> {
    parse_target(load_spectrum(&source.path)?, source)
}

/// As [`read_target`], from bytes in memory; the path names them in messages.
///
/// # Errors
/// As [`read_target`].
///
/// # Example
/// ```
/// use freestand_records::processing::{TargetSource, parse_target};
/// let source = TargetSource { path: "target.csv".into(), range_s: Some((0.2, 2.0)), damping_ratio: None };
/// let target = parse_target(b"T [s]; Sa [m/s2]\n0,1; 3,5\n0,2; 6\n1; 4\n".to_vec(), &source)?;
/// assert_eq!((target.periods_s, target.psa_m_s2), (vec![0.2, 1.0], vec![6.0, 4.0]));
/// # Ok::<(), freestand_input::problem::Problem>(())
/// ```
pub fn parse_target(bytes: Vec<u8>, source: &TargetSource) -> Result<TargetSpectrum, Problem> {
    let file = InputFile::new(&source.path, &bytes);
    let in_file = |problem: Problem| problem.in_file(&source.path);
    let mut rows = parse_spectrum(bytes).map_err(in_file)?;
    let (damping_ratio, left_out) =
        take_damping(&mut rows, source.damping_ratio).map_err(in_file)?;
    let name = name_of(&source.path);
    let note = left_out.map(|others| {
        format!(
            "{name} has spectra for several dampings: that for {} is the target, those for {others} are left out \
             (to use another damping, write it after the file name)",
            percent(damping_ratio)
        )
    });
    // All of it, so that a range of periods does not hide a problem.
    let (periods_s, psa_m_s2): (Vec<f64>, Vec<f64>) =
        rows.iter().map(|row| (row.period_s, row.psa_m_s2)).unzip();
    if let Some((row, problem)) = fault(&periods_s, &psa_m_s2) {
        let line = rows.get(row).map_or(1, |row| row.line);
        return Err(in_file(problem.at_line(line)));
    }
    if let Some((from_s, to_s)) = source.range_s {
        let within = from_s * (1.0 - SAME)..=to_s * (1.0 + SAME);
        rows.retain(|row| within.contains(&row.period_s));
        if rows.is_empty() {
            let (first, last) = ends(&periods_s);
            let message = format!(
                "the spectrum has no period from {} s to {} s",
                number(from_s, 6),
                number(to_s, 6)
            );
            return Err(in_file(Problem::value(
                message,
                format!(
                    "choose a range within its periods, {} s to {} s",
                    number(first, 6),
                    number(last, 6)
                ),
            )));
        }
    }
    Ok(TargetSpectrum {
        name,
        file: Some(file),
        periods_s: rows.iter().map(|row| row.period_s).collect(),
        psa_m_s2: rows.iter().map(|row| row.psa_m_s2).collect(),
        damping_ratio,
        note,
    })
}

fn percent(ratio: f64) -> String {
    percent_significant(ratio, 6)
}

fn percents<'a>(ratios: impl Iterator<Item = &'a f64>) -> String {
    let shown: Vec<String> = ratios.take(8).copied().map(percent).collect();
    shown.join(", ")
}

fn name_of(path: &Path) -> String {
    path.file_name()
        .unwrap_or(path.as_os_str())
        .to_string_lossy()
        .into_owned()
}

/// The damping to use. In a file with several, the rows of the others are removed; if none was
/// requested, the others are returned as text.
fn take_damping(
    rows: &mut Vec<SpectrumRow>,
    asked: Option<f64>,
) -> Result<(f64, Option<String>), Problem> {
    let is = |one: f64, other: f64| (one - other).abs() <= SAME;
    let mut stated: Vec<f64> = Vec::new();
    for row in rows.iter() {
        let Some(ratio) = row.damping_ratio else {
            continue;
        };
        if !(0.0..1.0).contains(&ratio) {
            let message = format!("{ratio} is not a damping ratio");
            return Err(Problem::value(
                message,
                "write it from 0 to below 1, or in per cent under \"damping [%]\"",
            )
            .at_line(row.line));
        }
        stated.push(ratio);
    }
    stated.sort_by(f64::total_cmp);
    stated.dedup_by(|one, other| is(*one, *other));
    let damping_ratio = match (asked, &stated[..]) {
        (Some(asked), _) => asked,
        (None, &[one]) => one,
        (None, _) => DAMPING_RATIO,
    };
    if !stated.is_empty() {
        rows.retain(|row| {
            row.damping_ratio
                .is_some_and(|ratio| is(ratio, damping_ratio))
        });
        if rows.is_empty() {
            let message = format!(
                "the spectrum has no values for {} damping",
                percent(damping_ratio)
            );
            return Err(Problem::value(
                message,
                format!(
                    "write one of its dampings after the file name: {}",
                    percents(stated.iter())
                ),
            ));
        }
    }
    let mut others = stated
        .iter()
        .filter(|&&ratio| !is(ratio, damping_ratio))
        .peekable();
    let left_out = (asked.is_none() && others.peek().is_some()).then(|| percents(others));
    Ok((damping_ratio, left_out))
}

/// The first row with an impossible value, and why.
fn fault(periods_s: &[f64], psa_m_s2: &[f64]) -> Option<(usize, Problem)> {
    for (row, (&period_s, &psa_m_s2)) in periods_s.iter().zip(psa_m_s2).enumerate() {
        if !(period_s >= 0.0 && period_s.is_finite()) {
            let message = format!("a period must be 0 s or more, not {period_s} s");
            return Some((
                row,
                Problem::value(message, "correct it; 0 s is the peak acceleration"),
            ));
        }
        if !(psa_m_s2 > 0.0 && psa_m_s2.is_finite()) {
            let message =
                format!("the acceleration of a target must be above 0, not {psa_m_s2} m/s2");
            return Some((
                row,
                Problem::value(message, "correct it, or remove the period"),
            ));
        }
    }
    let mut order: Vec<usize> = (0..periods_s.len()).collect();
    let period = |row: usize| periods_s.get(row).copied().unwrap_or(0.0);
    // Zeros of both signs are one period.
    order.sort_by(|&a, &b| {
        (period(a) + 0.0)
            .total_cmp(&(period(b) + 0.0))
            .then(a.cmp(&b))
    });
    let again = order
        .windows(2)
        .filter(|pair| period(pair[0]) == period(pair[1]))
        .map(|pair| pair[1])
        .min()?;
    let message = format!("the period {} s is listed twice", period(again));
    Some((again, Problem::value(message, "keep only one of them")))
}

fn ends(periods_s: &[f64]) -> (f64, f64) {
    let shortest = periods_s.iter().copied().fold(f64::INFINITY, f64::min);
    (shortest, periods_s.iter().copied().fold(0.0, f64::max))
}

impl TargetSpectrum {
    /// `target.csv (24 periods from 0.1 s to 3 s, 5 % damping`: the bracket is left open for the
    /// misfit.
    pub(super) fn words(&self) -> String {
        let (first, last) = ends(&self.periods_s);
        let periods = match self.periods_s.len() {
            1 => format!("1 period of {} s", number(first, 6)),
            count => format!(
                "{count} periods from {} s to {} s",
                number(first, 6),
                number(last, 6)
            ),
        };
        format!(
            "{} ({periods}, {} % damping",
            self.name,
            number(100.0 * self.damping_ratio, 6)
        )
    }
}

#[cfg(test)]
mod tests;
