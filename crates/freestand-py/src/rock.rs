//! One object under one motion: rocking, on cushions, sliding.

use freestand_app::request::Question as _;
use freestand_app::rock::{Asked, Followed, Meant, Results, Rock, SCHEMA};
use freestand_input::problem::Problem;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

use crate::arguments::{bytes, told};
use crate::asked::{Named, asked};
use crate::errors::{raised, raised_all};
use crate::motion::Record;
use crate::work::abandoned_on_signal;

/// The document, and the names and columns of each history.
type Answer<'py> = (String, Vec<(String, Bound<'py, PyBytes>)>);

/// Samples of a motion above which a history has its own thread, next to the one that looks for Ctrl-C:
/// shorter ones take a few milliseconds, and starting a thread costs more than the history of a
/// small object.
const MANY_SAMPLES: usize = 50_000;

/// The response of an object to one motion, or to each of several.
#[pyfunction]
pub(crate) fn rock<'py>(
    py: Python<'py>,
    request: &Bound<'py, PyDict>,
    motions: Vec<PyRef<'py, Record>>,
    vertical: Option<&Record>,
    across: Option<&Record>,
    files: Named,
    history: bool,
) -> PyResult<Answer<'py>> {
    let one = |key, record: Option<&Record>| record.map(|record| (key, record.samples("motion")));
    let is_one = motions.len() == 1;
    let name = |record: &Record| match is_one {
        true => "motion".to_owned(),
        false => record.name().to_owned(),
    };
    let motions = motions
        .iter()
        .map(|record| ("motion", record.samples(&name(record))))
        .chain(one("vertical", vertical))
        .chain(one("motion_y", across));
    let (rock, files) = asked::<Rock>(request, motions, files)?;
    let meant = rock.resolve(&files).map_err(raised_all)?;
    let is_long = is_long(&meant);
    let follow = move || -> Result<Vec<Followed>, Problem> { meant.follow_each(history).collect() };
    let followed = if is_long {
        abandoned_on_signal(py, follow)?
    } else {
        py.detach(follow)
    };
    let followed = followed.map_err(raised)?;
    let told_of = |one: &Followed| {
        let name = (followed.len() > 1).then(|| one.name.clone());
        let warning = move |warning: String| match &name {
            Some(name) => format!("{name}: {warning}"),
            None => warning,
        };
        one.warnings().into_iter().map(warning).collect::<Vec<_>>()
    };
    let warnings: Vec<String> = followed.iter().flat_map(told_of).collect();
    let answers = followed.iter().map(|one| (one.name.clone(), one.answer()));
    let text = told(SCHEMA, &Results::of(answers.collect()), &warnings)?;
    let columns = followed.iter().filter(|_| history).map(|one| {
        let (head, rows) = one.samples();
        let column = |column: usize| rows.iter().filter_map(move |row| row.get(column).copied());
        let columns = (0..head.split(',').count()).flat_map(column);
        let columns = PyBytes::new(py, &bytes(columns));
        (head, columns)
    });
    Ok((text, columns.collect()))
}

/// Whether its history takes long.
fn is_long(meant: &Meant) -> bool {
    let motions = &meant.motions;
    let all = motions.horizontal.iter().chain(&motions.vertical);
    let samples = all.map(|one| one.motion.accel_m_s2().len());
    let is_quick = matches!(meant.asked, Asked::Rigid(_) | Asked::Slides(_));
    !is_quick || samples.max().unwrap_or(0) > MANY_SAMPLES
}
