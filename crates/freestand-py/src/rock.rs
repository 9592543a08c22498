//! One object under one motion: rocking, on cushions, sliding.

use freestand::block::Block;
use freestand::rocking::Restitution;
use freestand::sliding::Clearance;
use freestand_app::rock::{Asked, Meant, Results, Rock, SCHEMA, resolve};
use freestand_input::problem::Problem;
use freestand_study::restitution::checked;
use freestand_study::sliding::{Contact, Surface, SurfaceGiven};
use freestand_study::walls::{GivenWalls, WallStiffness, needs_a_gap};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

use crate::arguments::{Given, bytes, told};
use crate::asked::{Named, asked};
use crate::errors::{raised, raised_all};
use crate::motion::Record;
use crate::work::abandoned_on_signal;

/// The document, and the names and columns of the history.
type Answer<'py> = (String, Option<(String, Bound<'py, PyBytes>)>);

/// The restitution, checked against the objects, which are made only if a restitution is given.
pub(crate) fn restitution(
    given: &mut Given<'_, '_>,
    blocks: impl FnOnce() -> Vec<Block>,
) -> Restitution {
    let (value, factor) = (
        given.number("restitution"),
        given.number("restitution_factor"),
    );
    if value.is_some() && factor.is_some() {
        let message = "restitution and restitution_factor exclude each other";
        given.push(Problem::value(message, "keep one of them"));
    }
    let restitution = match (value, factor) {
        (Some(value), _) => Restitution::Value(value),
        (None, Some(factor)) => Restitution::Factor(factor),
        (None, None) => return Restitution::Housner,
    };
    given
        .keep(checked(restitution, &blocks()))
        .unwrap_or_default()
}

/// The walls beside an object, and what the shock on them needs.
pub(crate) fn walls(
    given: &mut Given<'_, '_>,
    block: Option<&Block>,
    mass_kg: Option<f64>,
) -> (freestand::wall::Walls, WallStiffness) {
    let of = GivenWalls {
        left_gap_m: given.non_negative("left_m"),
        right_gap_m: given.non_negative("right_m"),
        height_m: given.positive("wall_height_m"),
        restitution_ratio: given.number("wall_restitution"),
    };
    let stiffness_n_m = given.positive("wall_stiffness_n_m");
    let has_gap = of.left_gap_m.or(of.right_gap_m).is_some();
    if stiffness_n_m.is_some()
        && !has_gap
        && of.height_m.is_none()
        && of.restitution_ratio.is_none()
    {
        given.push(needs_a_gap());
    }
    if stiffness_n_m.is_some() && mass_kg.is_none() {
        let message = "the stiffness of the walls is used for the shock, which also needs the mass of the object";
        given.push(Problem::value(
            message,
            "give mass_kg, or leave the stiffness of the walls out",
        ));
    }
    let walls = block
        .and_then(|block| given.keep(of.walls(block)))
        .unwrap_or_default();
    (
        walls,
        WallStiffness {
            mass_kg,
            stiffness_n_m,
        },
    )
}

/// What is under an object that slides or stands on casters.
pub(crate) fn surface(given: &mut Given<'_, '_>) -> Option<Surface> {
    let contact = match (given.flag("casters"), given.flag("brakes")) {
        (false, _) => Contact::Base,
        (true, false) => Contact::Casters,
        (true, true) => Contact::BrakedCasters,
    };
    let of = SurfaceGiven {
        contact,
        friction: given.positive("friction"),
        friction_kinetic: given.non_negative("friction_kinetic"),
        rolling_resistance: given.positive("rolling_resistance"),
        clearance: Clearance {
            left_m: given.non_negative("clearance_left_m"),
            right_m: given.non_negative("clearance_right_m"),
        },
    };
    given.keep(Surface::new(&of))
}

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
    let motions = [("motion", motion), ("vertical", vertical)];
    let (rock, files) = asked::<Rock>(request, &motions, files)?;
    let meant = resolve(&rock, &files).map_err(raised_all)?;
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
    let given = motions.horizontal.iter().map(|(_, motion)| motion);
    let samples = given
        .chain(&motions.vertical)
        .map(|motion| motion.accel_m_s2().len());
    let is_quick = matches!(meant.asked, Asked::Rigid(_) | Asked::Slides(_));
    !is_quick || samples.max().unwrap_or(0) > MANY_SAMPLES
}
