//! A spectrum from a file.

use std::path::Path;

use freestand::G0_M_S2;
use freestand::code_spectrum::{Interpolation, OutOfRange, SpectrumTable};
use freestand::synthesis::DAMPING_RATIO;

use super::Target;
use super::code::{Code, missing};
use super::doubt::TargetDoubt;
use freestand_input::problem::Problem;
use freestand_input::word_reader::WordReader;
use freestand_input::words::number;
use freestand_records::processing::{TargetSource, read_target};

pub(super) fn table(reader: &mut WordReader, base_dir: &Path) -> Option<Target> {
    let interpolation = interpolation(reader);
    let out_of_range = beyond(reader);
    let Some(name) = reader.words.get("spectrum") else {
        missing(reader, "spectrum", Code::Table, "target.csv");
        return None;
    };
    let path = base_dir.join(name);
    let source = TargetSource {
        path: path.clone(),
        range_s: None,
        damping_ratio: None,
    };
    let read = reader
        .problems
        .keep(read_target(&source).map_err(|problem| problem.of(&["spectrum"])))?;
    let refuse = |reader: &mut WordReader, message: String, hint: &str| {
        reader.problems.push(
            Problem::value(message, hint)
                .of(&["spectrum"])
                .in_file(&path),
        );
    };
    if (read.damping_ratio - DAMPING_RATIO).abs() > 1e-6 {
        let message = format!(
            "the spectrum is for {} % damping",
            number(100.0 * read.damping_ratio, 6)
        );
        refuse(
            reader,
            message,
            "give a spectrum for 5 % damping: motions are matched at that",
        );
        return None;
    }
    let periods = read.periods_s.iter().copied();
    let rows = Rows {
        values: periods.zip(read.psa_m_s2.iter().copied()).collect(),
        name: &read.name,
    };
    let made = made(reader, rows, interpolation, out_of_range);
    made.map(|target| Target {
        file: read.file,
        ..target
    })
}

/// The keys `interpolation` and `beyond`.
pub(super) fn interpolation(reader: &mut WordReader) -> Option<Interpolation> {
    let known = [
        ("log-log", Interpolation::LogLog),
        ("linear", Interpolation::Linear),
    ];
    one_of(reader, "interpolation", &known, Interpolation::LogLog)
}

pub(super) fn beyond(reader: &mut WordReader) -> Option<OutOfRange> {
    let known = [("refuse", OutOfRange::Refuse), ("hold", OutOfRange::Hold)];
    one_of(reader, "beyond", &known, OutOfRange::Refuse)
}

/// Periods with pseudo-accelerations \[s, m/s²\], and the name of their file.
pub(super) struct Rows<'n> {
    pub(super) values: Vec<(f64, f64)>,
    pub(super) name: &'n str,
}

pub(super) fn made(
    reader: &mut WordReader,
    rows: Rows,
    interpolation: Option<Interpolation>,
    out_of_range: Option<OutOfRange>,
) -> Option<Target> {
    let Rows { mut values, name } = rows;
    values.sort_by(|a, b| a.0.total_cmp(&b.0));
    // -0 is 0, which the sort puts first either way.
    let periods_s: Vec<f64> = values.iter().map(|row| row.0 + 0.0).collect();
    let sa_g = values.iter().map(|row| row.1 / G0_M_S2).collect();
    let (interpolation, out_of_range) = (interpolation?, out_of_range?);
    let spectrum = match SpectrumTable::new(periods_s, sa_g, interpolation, out_of_range) {
        Ok(spectrum) => spectrum,
        Err(error) => {
            let hint = "give two periods or more, each once";
            let problem = Problem::value(error.to_string(), hint).of(&["spectrum"]);
            reader.problems.push(problem.in_file(Path::new(name)));
            return None;
        }
    };
    let lines: String = values
        .iter()
        .map(|(period_s, psa)| format!("{},{psa}\n", period_s + 0.0))
        .collect();
    let first_s = spectrum.first_period_s();
    let begins_late =
        (out_of_range == OutOfRange::Hold && first_s > 0.0).then(|| TargetDoubt::BeginsLate {
            name: name.to_owned(),
            first_s,
        });
    Some(Target {
        facts: facts(&spectrum, name),
        spectrum: spectrum.into(),
        place: None,
        place_is_assumed: false,
        file: None,
        alternative: None,
        parts_edition: None,
        table_csv: Some(format!("period [s],PSA [m/s2]\n{lines}")),
        doubts: begins_late.into_iter().collect(),
        period_doubts: Vec::new(),
    })
}

fn one_of<T: Copy>(
    reader: &mut WordReader,
    key: &'static str,
    known: &[(&str, T)],
    default: T,
) -> Option<T> {
    if reader.has(key) {
        reader.one_of(key, known)
    } else {
        Some(default)
    }
}

fn facts(table: &SpectrumTable, name: &str) -> Vec<(String, String)> {
    let between = match table.interpolation() {
        Interpolation::LogLog => "linear in ln Sa against ln T",
        Interpolation::Linear => "linear in Sa against T",
    };
    let outside = match table.out_of_range() {
        OutOfRange::Refuse => "refused",
        OutOfRange::Hold => "constant Sa below, constant displacement beyond",
    };
    let periods = format!(
        "{} from {} s to {} s",
        table.periods_s().len(),
        number(table.first_period_s(), 4),
        number(table.last_period_s(), 4)
    );
    [
        (
            "Target",
            "a user's table, taken as elastic with 5 % damping".to_owned(),
        ),
        ("File", name.to_owned()),
        ("Periods", periods),
        ("Between the periods", between.to_owned()),
        ("Outside them", outside.to_owned()),
    ]
    .map(|(name, value)| (name.to_owned(), value))
    .to_vec()
}
