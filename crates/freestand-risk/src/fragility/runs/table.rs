//! The outcomes of runs by one measure, as they are fitted and as they are written.

use freestand::fragility::{OutcomeClass, level_weights};
use freestand_input::formula::guarded;
use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::words::shortest;
use freestand_output::rows::{csv_writer, table_of_csv};
use freestand_output::table::Table;
use freestand_study::run::Progress;

use super::super::curves::CAUTION;
use super::super::go_on;
use super::super::measure::Measure;
use super::super::outcomes::{RunRow, UNRESOLVED, UPLIFT};
use super::follow::Followed;
use super::levels::Levels;
use super::shaking::Asked;
use super::{Method, ObjectRuns, RunsReport};
use freestand_inventory::too_mild::TooMild;

/// The name of a table by the measure at a place of the request: `outcomes.csv` by the first,
/// `outcomes_sa_0.5.csv` by another one.
///
/// # Example
/// ```
/// use freestand_risk::fragility::{Measure, file_name};
/// assert_eq!(file_name("outcomes", 0, Measure::Pfv), "outcomes.csv");
/// assert_eq!(file_name("outcomes", 1, Measure::SaAverage { from_s: 0.2, to_s: 2.0 }), "outcomes_sa_avg_0.2_2.csv");
/// ```
pub fn file_name(what: &str, place: usize, measure: Measure) -> String {
    if place == 0 {
        return format!("{what}.csv");
    }
    let plain: String = measure
        .name()
        .chars()
        .map(|c| {
            if c.is_ascii_alphanumeric() || c == '.' {
                c
            } else {
                '_'
            }
        })
        .collect();
    format!("{what}_{}.csv", plain.trim_matches('_'))
}

/// A run, and the factor on its motion.
pub(super) struct Line<'a> {
    pub(super) run: RunRow<'a>,
    scale_ratio: f64,
}

/// The runs of all objects by one measure.
pub(super) fn lines<'a>(
    report: &'a RunsReport,
    asked: Asked,
    progress: Progress,
) -> Result<Vec<Line<'a>>, Problem> {
    let is_weighted =
        report.request.method == Method::Incremental && report.request.scales.is_none();
    let is_of_stripes = report.request.method == Method::Stripes && asked.place == 0;
    let scales = report.request.scales.as_deref().filter(|_| is_of_stripes);
    let levels = Levels::new(scales.unwrap_or_default());
    let mut lines = Vec::new();
    for one in &report.objects {
        let shakings = report.floors.get(one.floor).map_or(&[][..], Vec::as_slice);
        let units: Vec<Option<f64>> = shakings
            .iter()
            .map(|shaking| shaking.intensity(asked, one.factors))
            .collect();
        let weights = weights(one, asked.place, &units);
        let runs = one.motions.iter().flatten();
        let known = runs.filter(|run| run.found.is_ok()).count() as f64;
        let all: f64 = weights.iter().flatten().sum();
        // Together they count as many as there are runs.
        let factor = if all > 0.0 { known / all } else { 1.0 };
        let each = one
            .motions
            .iter()
            .zip(&one.uplifts_ratio)
            .zip(&weights)
            .zip(shakings)
            .zip(&units);
        for ((((runs, uplift), weights), shaking), unit) in each {
            let Some(unit) = unit else { continue };
            go_on(progress)?;
            for (followed, weight) in runs.iter().zip(weights) {
                let found = followed.run();
                let run = RunRow {
                    object: &one.id,
                    motion: &shaking.name,
                    intensity: levels.exact(unit * followed.scale_ratio),
                    class: found.map(|run| run.class),
                    shock_g: found.and_then(|run| run.edge_acceleration_g),
                    weight: if is_weighted { factor * weight } else { 1.0 },
                    rotation_ratio: found.and_then(|run| run.rotation_ratio),
                    uplift: uplift.map(|uplift| unit * uplift),
                    reason: followed.found.as_ref().err().map_or("", String::as_str),
                    caution: one.nominal.too_mild(),
                };
                let scale_ratio = followed.scale_ratio;
                lines.push(Line { run, scale_ratio });
            }
        }
    }
    Ok(lines)
}

/// Lines that are written before the work can be stopped again.
const LINES_AT_A_TIME: usize = 4096;

/// As a table. Extra columns say how each run came about.
pub(super) fn outcomes(
    measure: Measure,
    lines: &[Line<'_>],
    progress: Progress,
) -> Result<Table, Problem> {
    let broken = |error: &dyn std::fmt::Display| {
        Problem::new(
            ProblemKind::Computation,
            format!("the outcomes cannot be written: {error}"),
        )
    };
    let [intensity, uplift] = [measure.name().as_str(), UPLIFT].map(|name| match measure.unit() {
        "1" => name.to_owned(),
        unit => format!("{name} [{unit}]"),
    });
    // Each column with whether it holds numbers.
    let columns = [
        ("object", false),
        ("motion", false),
        (&*intensity, true),
        ("outcome", false),
        ("edge_acceleration [g]", true),
        ("weight", true),
        ("scale", true),
        ("rotation_ratio", true),
        (&*uplift, true),
        ("reason", false),
        (CAUTION, false),
    ];
    let mut writer = csv_writer();
    writer
        .write_record(columns.map(|(name, _)| name))
        .map_err(|error| broken(&error))?;
    let text = |value: Option<f64>| value.map(shortest).unwrap_or_default();
    for (place, Line { run, scale_ratio }) in lines.iter().enumerate() {
        if place.is_multiple_of(LINES_AT_A_TIME) {
            go_on(progress)?;
        }
        let record = [
            guarded(run.object).into_owned(),
            guarded(run.motion).into_owned(),
            shortest(run.intensity),
            run.class.map_or(UNRESOLVED, OutcomeClass::name).to_owned(),
            text(run.shock_g),
            shortest(run.weight),
            shortest(*scale_ratio),
            text(run.rotation_ratio),
            text(run.uplift),
            guarded(run.reason).into_owned(),
            run.caution.map_or("", TooMild::name).to_owned(),
        ];
        writer
            .write_record(&record)
            .map_err(|error| broken(&error))?;
    }
    let bytes = writer.into_inner().map_err(|error| broken(&error))?;
    Ok(table_of_csv(bytes, &columns))
}

/// How much each run counts by the measure at a place of the request, for each motion with its
/// intensity at a scale of 1. Runs of an adaptive analysis share the intensities over which they are
/// spread; all others count as one. A run that could not be followed takes no share.
pub(super) fn weights(one: &ObjectRuns, place: usize, units: &[Option<f64>]) -> Vec<Vec<f64>> {
    // Only an adaptive analysis has such intensities.
    let span = one.spans.get(place).copied().flatten();
    let of_motion = |(runs, unit): (&Vec<Followed>, &Option<f64>)| {
        let Some(((from, to), unit)) = span.zip(*unit) else {
            return vec![1.0; runs.len()];
        };
        let known: Vec<f64> = runs
            .iter()
            .filter(|run| run.found.is_ok())
            .map(|run| unit * run.scale_ratio)
            .collect();
        let mut weights = level_weights(&known, from, to).into_iter();
        runs.iter()
            .map(|run| run.run().and_then(|_| weights.next()).unwrap_or(0.0))
            .collect()
    };
    one.motions.iter().zip(units).map(of_motion).collect()
}
