//! Requests whose answer is the document of a command.

use std::sync::atomic::Ordering;

use freestand::motion::Motion;
use freestand_app::code_spectrum::{CodeSpectrum, SCHEMA as CODE_SPECTRUM};
use freestand_app::drop_test::{DropTests, SCHEMA as DROP};
use freestand_app::files::Files;
use freestand_app::floor::{Floor, SCHEMA as FLOOR};
use freestand_app::request::Question as _;
use freestand_app::shock::{SCHEMA as SHOCK, Shock};
use freestand_app::shock_spectrum::{SCHEMA as SHOCK_SPECTRUM, ShockSpectrum};
use freestand_app::static_test::{SCHEMA as STATIC, StaticTests};
use freestand_app::synth::{SCHEMA as SYNTH, Synth};
use freestand_input::problem::{Problem, ProblemKind};
use freestand_inventory::validate::validate as validated;
use freestand_records::notes::grouped;
use freestand_report::cushion::{DropsAnswer, drops_doubts, statics_doubt};
use freestand_report::doubts::{building_doubt, fit_doubt, motion_doubts, target_doubt};
use freestand_report::shock::{landing_report, shock_doubt};
use freestand_report::target::{CodeSpectrumAnswer, FitAnswer};
use freestand_study::floor::{FloorReport, floors};
use freestand_study::laboratory::drop_test::{cushion_toml, drop_tests, loop_table};
use freestand_study::laboratory::static_curve::static_tests;
use freestand_study::matched::synth as made;
use freestand_study::shock::shock as evaluated;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arguments::told;
use crate::asked::{Named, asked, fill, typed};
use crate::errors::{raised, raised_all};
use crate::motion::{Record, unread};
use crate::work::watched;

/// One landing.
#[pyfunction]
pub(crate) fn shock(request: &Bound<'_, PyDict>, files: Named) -> PyResult<String> {
    let (request, files) = asked::<Shock>(request, std::iter::empty(), files)?;
    let meant = request.resolve(&files).map_err(raised_all)?;
    let report = evaluated(&meant.landing).map_err(raised_all)?;
    let warnings: Vec<String> = report.doubts.iter().map(shock_doubt).collect();
    told(SHOCK, &landing_report(&report), &warnings)
}

/// The document, the pad as the text of a cushion file, the loops as CSV.
type Pad = (String, Option<String>, Vec<String>);

/// A pad from its drop tests.
#[pyfunction]
pub(crate) fn drop_test(py: Python<'_>, values: &Bound<'_, PyDict>) -> PyResult<Pad> {
    let request = typed::<DropTests>(values)?.resolve(&Files::Disk);
    let request = request.map_err(raised_all)?;
    let report = watched(py, None, |_| drop_tests(&request))?.map_err(raised_all)?;
    let text = told(DROP, &DropsAnswer(&report), &drops_doubts(&report))?;
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
    let warnings: Vec<String> = report.doubts.iter().map(statics_doubt).collect();
    told(STATIC, &report, &warnings)
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
    fill(&mut request.frequencies, frequencies_hz);
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
    told(SHOCK_SPECTRUM, &report, &motion_doubts(&report.doubts))
}

/// The spectrum of a code.
#[pyfunction]
pub(crate) fn code_spectrum(periods_s: &[u8], values: &Bound<'_, PyDict>) -> PyResult<String> {
    let mut request = typed::<CodeSpectrum>(values)?;
    fill(&mut request.periods, periods_s);
    let meant = request.resolve(&Files::Disk).map_err(raised_all)?;
    let report = meant.report().map_err(raised_all)?;
    let doubts: Vec<String> = meant.target.doubts.iter().map(target_doubt).collect();
    told(CODE_SPECTRUM, &CodeSpectrumAnswer(&report), &doubts)
}

/// Motions that fit a target: the document, and the motions.
#[pyfunction]
pub(crate) fn synth(
    py: Python<'_>,
    values: &Bound<'_, PyDict>,
    threads: Option<usize>,
) -> PyResult<(String, Vec<Record>)> {
    let meant = typed::<Synth>(values)?.resolve(&Files::Disk);
    let request = meant.map_err(raised_all)?.asked;
    let report = watched(py, threads, |_| made(&request))?.map_err(raised)?;
    let doubts: Vec<String> = report.doubts().iter().map(fit_doubt).collect();
    let text = told(SYNTH, &FitAnswer(&report), &doubts)?;
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
    fill(&mut asked.levels, levels);
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
        let of_building = request.building.doubts.iter().map(building_doubt);
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
