//! One object under one motion: rocking, on cushions, sliding.

use freestand_app::request::Question as _;
use freestand_app::rock::{Asked, Meant, Results, Rock, SCHEMA};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

use crate::arguments::{bytes, told};
use crate::asked::{Named, asked};
use crate::errors::{raised, raised_all};
use crate::motion::Record;
use crate::work::abandoned_on_signal;

/// The document, and the names and columns of the history.
type Answer<'py> = (String, Option<(String, Bound<'py, PyBytes>)>);

/// Samples of a motion above which a history has its own thread, next to the one that looks for Ctrl-C:
/// shorter ones take a few milliseconds, and starting a thread costs more than the history of a
/// small object.
const MANY_SAMPLES: usize = 50_000;

/// The response of an object.
#[pyfunction]
pub(crate) fn rock<'py>(
    py: Python<'py>,
    request: &Bound<'py, PyDict>,
    motion: Option<&Record>,
    vertical: Option<&Record>,
    files: Named,
    history: bool,
) -> PyResult<Answer<'py>> {
    let one = |key, record: Option<&Record>| record.map(|record| (key, record.samples("motion")));
    let motions = one("motion", motion)
        .into_iter()
        .chain(one("vertical", vertical));
    let (rock, files) = asked::<Rock>(request, motions, files)?;
    let meant = rock.resolve(&files).map_err(raised_all)?;
    let is_long = is_long(&meant);
    let follow = move || meant.follow(0, history);
    let followed = if is_long {
        abandoned_on_signal(py, follow)?
    } else {
        py.detach(follow)
    };
    let followed = followed.map_err(raised)?;
    let answers = vec![(followed.name.clone(), followed.answer())];
    let text = told(SCHEMA, &Results::of(answers), followed.warnings())?;
    let columns = history.then(|| {
        let (head, rows) = followed.samples();
        let column = |column: usize| rows.iter().filter_map(move |row| row.get(column).copied());
        let columns = (0..head.split(',').count()).flat_map(column);
        let columns = PyBytes::new(py, &bytes(columns));
        (head, columns)
    });
    Ok((text, columns))
}

/// Whether its history takes long.
fn is_long(meant: &Meant) -> bool {
    let motions = &meant.motions;
    let all = motions.horizontal.iter().chain(&motions.vertical);
    let samples = all.map(|one| one.motion.accel_m_s2().len());
    let is_quick = matches!(meant.asked, Asked::Rigid(_) | Asked::Slides(_));
    !is_quick || samples.max().unwrap_or(0) > MANY_SAMPLES
}
