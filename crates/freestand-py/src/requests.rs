//! Requests whose answer is the document of a command.

use std::path::Path;
use std::sync::atomic::Ordering;

use freestand::motion::Motion;
use freestand::synthesis::SynthesisOptions;
use freestand_app::code_spectrum::{CodeSpectrum, SCHEMA as CODE_SPECTRUM};
use freestand_app::drop_test::{DropTests, SCHEMA as DROP};
use freestand_app::files::Files;
use freestand_app::floor::{Floor, SCHEMA as FLOOR};
use freestand_app::request::Question as _;
use freestand_app::shock::{SCHEMA as SHOCK, Shock};
use freestand_app::shock_spectrum::{SCHEMA as SHOCK_SPECTRUM, ShockSpectrum};
use freestand_app::static_test::{SCHEMA as STATIC, StaticTests};
use freestand_assess::validate::validate as validated;
use freestand_input::problem::{Problem, ProblemKind, Problems};
use freestand_input::written::Written;
use freestand_records::notes::grouped;
use freestand_study::floor::{FloorReport, floors};
use freestand_study::laboratory::drop_test::{cushion_toml, drop_tests, loop_table};
use freestand_study::laboratory::static_curve::static_tests;
use freestand_study::matched::{SynthRequest, synth as made};
use freestand_study::shock::shock as evaluated;
use freestand_study::study::{DEFAULT_MOTIONS, DEFAULT_SEED};
use freestand_study::target::Target;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arguments::{Given, doubles, told};
use crate::asked::{Named, asked, typed};
use crate::errors::{raised, raised_all};
use crate::motion::{Record, unread};
use crate::work::watched;

/// One landing.
#[pyfunction]
pub(crate) fn shock(request: &Bound<'_, PyDict>, files: Named) -> PyResult<String> {
    let (request, files) = asked::<Shock>(request, std::iter::empty(), files)?;
    let meant = request.resolve(&files).map_err(raised_all)?;
    let report = evaluated(&meant.landing).map_err(raised_all)?;
    told(SHOCK, &report.answer, &report.warnings)
}

/// The document, the pad as the text of a cushion file, the loops as CSV.
type Pad = (String, Option<String>, Vec<String>);

/// A pad from its drop tests.
#[pyfunction]
pub(crate) fn drop_test(py: Python<'_>, values: &Bound<'_, PyDict>) -> PyResult<Pad> {
    let request = typed::<DropTests>(values)?.resolve(&Files::Disk);
    let request = request.map_err(raised_all)?;
    let report = watched(py, None, |_| drop_tests(&request))?.map_err(raised_all)?;
    let text = told(DROP, &report, &report.warnings)?;
    let loops = report
        .tests
        .iter()
        .map(|test| loop_table(&test.test).to_string())
        .collect();
    Ok((text, cushion_toml(&report.pooled), loops))
}

/// Static tests of a pad.
#[pyfunction]
pub(crate) fn static_test(py: Python<'_>, values: &Bound<'_, PyDict>) -> PyResult<String> {
    let request = typed::<StaticTests>(values)?.resolve(&Files::Disk);
    let request = request.map_err(raised_all)?;
    let report = watched(py, None, |_| static_tests(&request))?.map_err(raised_all)?;
    told(STATIC, &report, &report.warnings)
}

/// The shock response spectrum of a motion.
#[pyfunction]
pub(crate) fn shock_spectrum(
    py: Python<'_>,
    record: Option<&Record>,
    frequencies_hz: &[u8],
    values: &Bound<'_, PyDict>,
) -> PyResult<String> {
    let motion = record.map(|record| ("motion", record.read.clone()));
    let (mut request, files) = asked::<ShockSpectrum>(values, motion, Named::new())?;
    if !frequencies_hz.is_empty() {
        let all = doubles(frequencies_hz).into_iter().map(Written::Number);
        request.frequencies = Some(Written::List(all.collect()));
    }
    let meant = request.resolve(&files).map_err(raised_all)?;
    let report = watched(py, None, |stop| {
        let go_on = || {
            if stop.load(Ordering::Relaxed) {
                Err(Problem::stopped())
            } else {
                Ok(())
            }
        };
        meant.spectra(go_on)
    })?
    .map_err(raised)?;
    told(SHOCK_SPECTRUM, &report, &report.warnings)
}

/// The spectrum of a code.
#[pyfunction]
pub(crate) fn code_spectrum(periods_s: &[u8], values: &Bound<'_, PyDict>) -> PyResult<String> {
    let mut request = typed::<CodeSpectrum>(values)?;
    if !periods_s.is_empty() {
        let all = doubles(periods_s).into_iter().map(Written::Number);
        request.periods = Some(Written::List(all.collect()));
    }
    let meant = request.resolve(&Files::Disk).map_err(raised_all)?;
    let report = meant.report().map_err(raised_all)?;
    told(CODE_SPECTRUM, &report, &meant.target.warnings)
}

/// Motions that fit a target: the document, and the motions.
#[pyfunction]
pub(crate) fn synth(
    py: Python<'_>,
    values: &Bound<'_, PyDict>,
    threads: Option<usize>,
) -> PyResult<(String, Vec<Record>)> {
    let mut given = Given::new(values);
    let words = given.words("words");
    let target = given.keep(Target::resolve(&words, Path::new("")));
    let is_peak_matched = given.flag("match_pga");
    let fine = SynthesisOptions::default();
    let options = SynthesisOptions {
        dt_s: given.positive("time_step_s").unwrap_or(fine.dt_s),
        shaking_s: given.positive("shaking_s").unwrap_or(fine.shaking_s),
        envelope_s: given.positive("envelope_s").unwrap_or(fine.envelope_s),
        ..fine
    };
    let count = given.whole("count", 1).unwrap_or(DEFAULT_MOTIONS);
    if count > freestand_study::resolve::MAX_MOTIONS {
        let hint = format!("give at most {}", freestand_study::resolve::MAX_MOTIONS);
        given.push(Problem::value(
            format!("a count of {count} motions is too large"),
            hint,
        ));
    }
    let seed = given.whole("seed", 0).unwrap_or(DEFAULT_SEED);
    if let Some(target) = &target {
        given.keep(target.check_matched_band());
    }
    let pga_g = target
        .as_ref()
        .filter(|_| is_peak_matched)
        .map(Target::peak_g);
    let pga_g = pga_g.and_then(|pga_g| given.keep(pga_g));
    given.finish()?;
    let Some(target) = target else {
        return Err(raised_all(Problems::default()));
    };
    let request = SynthRequest {
        target,
        count,
        seed,
        options,
        pga_g,
    };
    let report = watched(py, threads, |_| made(&request))?.map_err(raised)?;
    let text = told("freestand.motion-synth/1", &report, &report.warnings())?;
    let motions = report
        .motions
        .into_iter()
        .map(|one| unread(one.name, one.motion, Vec::new()))
        .collect();
    Ok((text, motions))
}

/// The floors of a building: the document, and the motions of each level under each motion.
#[pyfunction]
pub(crate) fn floor(
    py: Python<'_>,
    records: Vec<PyRef<'_, Record>>,
    levels: &[u8],
    values: &Bound<'_, PyDict>,
    threads: Option<usize>,
) -> PyResult<(String, Vec<Vec<Record>>)> {
    let motions = records.iter().map(|record| ("motion", record.read.clone()));
    let (mut asked, files) = asked::<Floor>(values, motions, Named::new())?;
    if !levels.is_empty() {
        let all = doubles(levels).into_iter().map(Written::Number);
        asked.levels = Some(Written::List(all.collect()));
    }
    let meant = asked.resolve(&files).map_err(raised_all)?;
    let (request, read) = (meant.floors, meant.motions);
    let work = || {
        let (mut reports, mut motions) = (Vec::new(), Vec::new());
        let mut notes = Vec::new();
        for one in &read {
            let done = floors(one, &request)?;
            notes.extend(done.notes.into_iter().map(|note| (&one.motion.name, note)));
            let named = request
                .levels_ratio
                .iter()
                .zip(done.floors)
                .map(|(level, floor)| (format!("{} at {level}", one.motion.name), floor.along));
            motions.push(named.collect::<Vec<(String, Motion)>>());
            reports.push(done.report);
        }
        let of_building = request.building.warnings.iter().cloned();
        let warnings: Vec<String> = of_building
            .chain(grouped(notes.iter().map(|(name, note)| (name, note))))
            .collect();
        Ok::<_, Problem>((reports, motions, warnings))
    };
    let (reports, motions, mut warnings) = watched(py, threads, |_| work())?.map_err(raised)?;
    warnings.extend(meant.warnings);
    let report = FloorReport::new(&request, reports, None).ok_or_else(|| {
        raised(
            Problem::new(ProblemKind::Missing, "there is no motion")
                .hint("give at least one motion"),
        )
    })?;
    let text = told(FLOOR, &report, &warnings)?;
    let record = |(name, motion): (String, Motion)| unread(name, motion, Vec::new());
    Ok((
        text,
        motions
            .into_iter()
            .map(|floors| floors.into_iter().map(record).collect())
            .collect(),
    ))
}

/// The checks of the models.
#[pyfunction]
pub(crate) fn validate(py: Python<'_>, threads: Option<usize>) -> PyResult<String> {
    let validation = watched(py, threads, |_| validated())?.map_err(raised_all)?;
    let failed = validation.checks.iter().filter(|check| !check.ok).count();
    let some = format!("{failed} of {} checks failed", validation.checks.len());
    let warnings: Vec<String> = (failed > 0).then_some(some).into_iter().collect();
    told("freestand.validate/1", &validation, &warnings)
}
