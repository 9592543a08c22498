//! A spectrum from a file.

use freestand::G0_M_S2;
use freestand::code_spectrum::{Interpolation, OutOfRange, SpectrumTable};

use super::Target;
use super::words::{Code, Reader};
use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::words::number;
use freestand_records::processing::{TargetSource, read_target};

/// The damping of everything that a table is held against.
const DAMPING_RATIO: f64 = 0.05;

pub(super) fn table(reader: &mut Reader<'_>) -> Option<Target> {
    let known = [("log-log", Interpolation::LogLog), ("linear", Interpolation::Linear)];
    let interpolation = reader.one_of("interpolation", &known, Interpolation::LogLog);
    let known = [("refuse", OutOfRange::Refuse), ("hold", OutOfRange::Hold)];
    let out_of_range = reader.one_of("beyond", &known, OutOfRange::Refuse);
    let Some(name) = reader.words.get("spectrum") else {
        reader.missing("spectrum", Code::Table, "target.csv");
        return None;
    };
    let path = reader.base_dir.join(name);
    let source = TargetSource { path: path.clone(), range_s: None, damping_ratio: None };
    let read = match read_target(&source) {
        Ok(read) => read,
        Err(problem) => {
            reader.push(&["spectrum"], problem);
            return None;
        }
    };
    if (read.damping_ratio - DAMPING_RATIO).abs() > 1e-6 {
        let message = format!("the spectrum is for {} % damping", number(100.0 * read.damping_ratio, 6));
        let problem = Problem::new(ProblemKind::Value, message).in_file(&path);
        reader.push(&["spectrum"], problem.hint("give one for 5 %, which motions are matched at"));
        return None;
    }
    let mut rows: Vec<(f64, f64)> = read.periods_s.iter().copied().zip(read.psa_m_s2.iter().copied()).collect();
    rows.sort_by(|a, b| a.0.total_cmp(&b.0));
    // -0 is 0, which the sort puts first either way.
    let periods_s: Vec<f64> = rows.iter().map(|row| row.0 + 0.0).collect();
    let sa_g = rows.iter().map(|row| row.1 / G0_M_S2).collect();
    let (interpolation, out_of_range) = (interpolation?, out_of_range?);
    let spectrum = match SpectrumTable::new(periods_s, sa_g, interpolation, out_of_range) {
        Ok(spectrum) => spectrum,
        Err(error) => {
            let problem = Problem::new(ProblemKind::Value, error.to_string()).in_file(&path);
            reader.push(&["spectrum"], problem.hint("give two periods or more, each once"));
            return None;
        }
    };
    let lines: String = rows.iter().map(|(period_s, psa)| format!("{},{psa}\n", period_s + 0.0)).collect();
    let mut warnings = Vec::new();
    if out_of_range == OutOfRange::Hold && spectrum.first_period_s() > 0.0 {
        warnings.push(format!(
            "the spectrum {} begins at {} s: below, its first value is held, and the PGA of motions is held against it",
            read.name,
            number(spectrum.first_period_s(), 4)
        ));
    }
    Some(Target {
        facts: facts(&spectrum, &read.name),
        spectrum: spectrum.into(),
        city: None,
        file: read.file,
        table_csv: Some(format!("period [s],PSA [m/s2]\n{lines}")),
        warnings,
    })
}

fn facts(table: &SpectrumTable, name: &str) -> Vec<(String, String)> {
    let between = match table.interpolation() {
        Interpolation::LogLog => "straight in ln Sa over ln T",
        Interpolation::Linear => "straight in Sa over T",
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
        ("Target", "a table of the user, taken as elastic with 5 % damping".to_owned()),
        ("File", name.to_owned()),
        ("Periods", periods),
        ("Between the periods", between.to_owned()),
        ("Outside of them", outside.to_owned()),
    ]
    .map(|(name, value)| (name.to_owned(), value))
    .to_vec()
}
