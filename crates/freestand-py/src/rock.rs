//! One object under one motion: rocking, on cushions, sliding.

use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::compliant::CompliantBase;
use freestand::motion::Motion;
use freestand::respond::{
    Along, HistoryOptions, Pads, Plane, Planes, Release, RigidPlane, Settings,
};
use freestand::rocking::{Restitution, RockingModel};
use freestand::sliding::Clearance;
use freestand_input::problem::Problem;
use freestand_output::facts::{Facts, Value};
use freestand_study::compliant::{
    self as on_cushions, CompliantRequest, Turned, rock_on_cushions, start,
    with_tangential_stiffness,
};
use freestand_study::restitution::checked;
use freestand_study::rock::{
    ACCURACIES, HISTORY, MODELS, RockRequest, history_row, rock as calculated, until,
};
use freestand_study::sliding::{
    self, Contact, SlideRequest, StopShock, Surface, SurfaceGiven, slide as slid,
};
use freestand_study::walls::{GivenWalls, WallStiffness, needs_a_gap};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

use crate::arguments::{Given, bytes, dictionary};
use crate::block::Body;
use crate::errors::raised;
use crate::motion::Record;
use crate::work::abandoned_on_signal;

/// Facts, warnings, impacts, impacts on walls, names and columns of the history.
type Answer<'py> = (
    Bound<'py, PyDict>,
    Vec<String>,
    Bound<'py, PyBytes>,
    Bound<'py, PyBytes>,
    Option<(String, Bound<'py, PyBytes>)>,
);

/// Numbers of an impact, in this order, in the arrays of the Python layer.
const IMPACT: [&str; 4] = [
    "time_s",
    "omega_before_rad_s",
    "omega_after_rad_s",
    "edge_acceleration_impact_velocity_g",
];

/// Numbers of an impact on a wall; before them stands 1 for the right wall and −1 for the left.
const WALL_IMPACT: [&str; 5] = [
    "time_s",
    "omega_before_rad_s",
    "omega_after_rad_s",
    "speed_m_s",
    "acceleration_g",
];

/// A list of facts as rows of numbers.
fn rows<const N: usize>(facts: &Facts<'_>, list: &str, names: [&str; N], side: bool) -> Vec<u8> {
    let Some(Value::List(rows)) = facts.get(list) else {
        return Vec::new();
    };
    let row = |value: &Value<'_>| {
        let Value::Facts(row) = value else {
            return Vec::new();
        };
        let side = side.then(|| {
            if row.text("side") == Some("right") {
                1.0
            } else {
                -1.0
            }
        });
        let numbers = names.map(|name| row.number(name).unwrap_or(f64::NAN));
        bytes(side.into_iter().chain(numbers))
    };
    rows.iter().flat_map(row).collect()
}

/// The names of the columns of a history, and the columns, one after the other.
fn columns(head: &str, rows: &[impl AsRef<[f64]>]) -> (String, Vec<u8>) {
    let width = head.split(',').count();
    let column = |column: usize| {
        rows.iter()
            .map(move |row| row.as_ref().get(column).copied().unwrap_or(f64::NAN))
    };
    (head.to_owned(), bytes((0..width).flat_map(column)))
}

fn answer<'py>(
    py: Python<'py>,
    facts: &Facts<'_>,
    warnings: Vec<String>,
    history: Option<(String, Vec<u8>)>,
) -> PyResult<Answer<'py>> {
    // Those of a rigid base are numbers alone, and many.
    let is_rigid = facts.get("wall_impacts").is_some();
    let impacts = if is_rigid {
        rows(facts, "impacts", IMPACT, false)
    } else {
        Vec::new()
    };
    let impacts = PyBytes::new(py, &impacts);
    let walls = PyBytes::new(py, &rows(facts, "wall_impacts", WALL_IMPACT, true));
    let known = dictionary(py, facts, |name| {
        is_rigid && matches!(name, "impacts" | "wall_impacts")
    })?;
    Ok((
        known,
        warnings,
        impacts,
        walls,
        history.map(|(head, history)| (head, PyBytes::new(py, &history))),
    ))
}

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

fn nothing_moves() -> Problem {
    let hint = "give a motion, or initial_rotation_rad or initial_velocity_rad_s";
    Problem::value("nothing moves the object", hint)
}

/// An object and what shakes it.
#[derive(Clone, Copy)]
struct Shaken<'a> {
    body: &'a Body,
    motion: Option<&'a Record>,
    vertical: Option<&'a Record>,
    /// Whether its history is recorded.
    history: bool,
}

/// Samples of a motion above which a history has its own thread, next to the one that looks for Ctrl-C:
/// shorter ones take a few milliseconds, and starting a thread costs more than the history of a
/// small object.
const MANY_SAMPLES: usize = 50_000;

impl Shaken<'_> {
    fn is_still(&self) -> bool {
        self.motion.or(self.vertical).is_none()
    }

    fn horizontal(&self) -> Option<Motion> {
        self.motion.map(|record| record.motion().clone())
    }

    fn upward(&self) -> Option<Motion> {
        self.vertical.map(|record| record.motion().clone())
    }

    fn how(&self, settings: Settings, start: Release) -> HistoryOptions {
        HistoryOptions {
            settings,
            start,
            points_m: Vec::new(),
            is_sampled: self.history,
        }
    }

    /// Calculates a history without the interpreter's lock.
    fn follow<T: Send + 'static>(
        &self,
        py: Python<'_>,
        work: impl FnOnce() -> Result<T, Problem> + Send + 'static,
    ) -> PyResult<T> {
        let samples = self
            .motion
            .into_iter()
            .chain(self.vertical)
            .map(|record| record.motion().accel_m_s2().len());
        let done = if samples.max().unwrap_or(0) > MANY_SAMPLES {
            abandoned_on_signal(py, work)?
        } else {
            py.detach(work)
        };
        done.map_err(raised)
    }
}

/// The response of an object: `base` is rigid, compliant or sliding. `None`: it should slide, but is
/// on braked casters that hold.
#[pyfunction]
pub(crate) fn rock<'py>(
    py: Python<'py>,
    body: &Body,
    motion: Option<&Record>,
    vertical: Option<&Record>,
    values: &Bound<'py, PyDict>,
    history: bool,
) -> PyResult<Option<Answer<'py>>> {
    let shaken = Shaken {
        body,
        motion,
        vertical,
        history,
    };
    let mut given = Given::new(values);
    if given.flag("sliding") {
        return slide(py, shaken, given);
    }
    let on_cushions = match given.text("base").as_deref() {
        None | Some("rigid") => false,
        Some("compliant") => true,
        Some(other) => {
            given.push(Problem::value(
                format!("base \"{other}\" is not known"),
                "give one of rigid, compliant",
            ));
            false
        }
    };
    let follow = if on_cushions { compliant } else { rigid };
    follow(py, shaken, given).map(Some)
}

fn rigid<'py>(
    py: Python<'py>,
    shaken: Shaken<'_>,
    mut given: Given<'_, 'py>,
) -> PyResult<Answer<'py>> {
    let Shaken { body, history, .. } = shaken;
    let block = body.block;
    if body.edge.is_some() && body.mass_kg.is_none() {
        let message = "the cushion is used for the shock, which also needs the mass of the object";
        given.push(Problem::value(
            message,
            "give mass_kg, or leave the cushion out",
        ));
    }
    let model = given.choice("model", MODELS).unwrap_or_default();
    let (walls, wall) = walls(&mut given, Some(&block), body.mass_kg);
    if !walls.is_none() && model == RockingModel::Linearised {
        let message = "the linearised equation of motion has no walls";
        given.push(Problem::value(message, "leave model out, or the walls"));
    }
    let duration_s = given.positive("duration_s");
    let restitution = restitution(&mut given, || vec![block]);
    let settings = Settings {
        model,
        gravity_m_s2: given.positive("gravity_m_s2").unwrap_or(G0_M_S2),
        accuracy: given.choice("accuracy", ACCURACIES).unwrap_or_default(),
        until: until(duration_s),
        ..Settings::default()
    };
    let start = Release {
        rotation_rad: given.number("initial_rotation_rad").unwrap_or(0.0),
        omega_rad_s: given.number("initial_velocity_rad_s").unwrap_or(0.0),
    };
    let friction = given.positive("friction");
    if shaken.is_still() && start.is_at_rest() {
        given.push(nothing_moves());
    }
    given.finish()?;
    let request = RockRequest {
        object: RigidPlane::along_x(block, restitution, walls),
        horizontal: shaken.horizontal(),
        vertical: shaken.upward(),
        how: shaken.how(settings, start),
        cushion: body.mass_kg.zip(body.edge.clone()),
        wall,
        friction,
    };
    let report = shaken.follow(py, move || calculated(&request))?;
    let rows: Vec<[f64; 5]> = report
        .history
        .samples
        .iter()
        .map(|point| history_row(&block, point))
        .collect();
    answer(
        py,
        &report.facts,
        report.warnings,
        history.then(|| columns(HISTORY, &rows)),
    )
}

fn compliant<'py>(
    py: Python<'py>,
    shaken: Shaken<'_>,
    mut given: Given<'_, 'py>,
) -> PyResult<Answer<'py>> {
    let Shaken { body, history, .. } = shaken;
    let of_rigid_base = [
        "restitution",
        "restitution_factor",
        "left_m",
        "right_m",
        "wall_height_m",
    ];
    for name in of_rigid_base {
        if given.number(name).is_some() {
            let hint = "leave it out: on cushions, the equations of motion determine the energy lost in a landing";
            given.push(Problem::value(
                format!("{name} applies only to a rigid base"),
                hint,
            ));
        }
    }
    let tangential = given.positive("tangential_stiffness_n_m");
    let ratio = given.positive("tangential_ratio");
    let friction_ratio = given.non_negative("friction");
    let rise = given.positive("cg_rise_m").map(Turned::CgRise);
    let turned = rise.or(given.number("initial_rotation_rad").map(Turned::Rotation));
    let omega = given.number("initial_velocity_rad_s").unwrap_or(0.0);
    let gravity_m_s2 = given.positive("gravity_m_s2").unwrap_or(G0_M_S2);
    let duration_s = given.positive("duration_s");
    let at = given.point("at_m");
    let contacts = given.count("contacts");
    let settings = Settings {
        on_pads: given
            .choice("accuracy", ACCURACIES)
            .unwrap_or_default()
            .into(),
        gravity_m_s2,
        until: until(duration_s),
        ..Settings::default()
    };
    let start = given
        .keep(start(&body.block, turned, omega))
        .unwrap_or_default();
    let cushion = body.mass_kg.zip(body.edge.clone());
    if cushion.is_none() {
        let hint =
            "give the block mass_kg and the stiffness_n_m of the whole cushion under one edge";
        given.push(Problem::value(
            "a compliant base needs a mass and a stiffness",
            hint,
        ));
    }
    if shaken.is_still() && start.is_at_rest() {
        given.push(nothing_moves());
    }
    given.finish()?;
    let Some((mass_kg, edge)) = cushion else {
        return Err(raised(nothing_moves()));
    };
    let mut base = CompliantBase {
        friction_ratio,
        ..CompliantBase::new(mass_kg, edge.cushion)
    };
    base.contacts = contacts.unwrap_or(base.contacts);
    base.tangential_stiffness_ratio = ratio.unwrap_or(base.tangential_stiffness_ratio);
    if let Some(stiffness_n_m) = tangential {
        base = with_tangential_stiffness(base, stiffness_n_m, gravity_m_s2);
    }
    let planes = Planes::single(Plane {
        along: Along::X,
        block: body.block,
    });
    let request = CompliantRequest {
        object: Pads { planes, base },
        pad_thickness_m: edge.pad_thickness_m,
        notes: edge.notes,
        horizontal: shaken.horizontal(),
        vertical: shaken.upward(),
        how: HistoryOptions {
            points_m: at.into_iter().collect(),
            ..shaken.how(settings, start)
        },
    };
    let report = abandoned_on_signal(py, move || rock_on_cushions(&request))?.map_err(raised)?;
    let rows: Vec<_> = report
        .history
        .samples
        .iter()
        .map(on_cushions::history_row)
        .collect();
    let head = on_cushions::history_head(&report.history.samples);
    answer(
        py,
        &report.facts,
        report.warnings,
        history.then(|| columns(&head, &rows)),
    )
}

/// The travel of an object that slides or rolls; `None` if it is on braked casters that hold.
fn slide<'py>(
    py: Python<'py>,
    shaken: Shaken<'_>,
    mut given: Given<'_, 'py>,
) -> PyResult<Option<Answer<'py>>> {
    let Shaken { body, history, .. } = shaken;
    let surface = surface(&mut given);
    let carried = surface.and_then(|surface| given.keep(surface.carries(&body.block)));
    let stop = surface.and_then(|surface| {
        let stiffness_n_m = given.positive("stop_stiffness_n_m");
        given.keep(StopShock::new(
            stiffness_n_m,
            body.mass_kg,
            &surface.clearance,
        ))?
    });
    let settings = Settings {
        gravity_m_s2: given.positive("gravity_m_s2").unwrap_or(G0_M_S2),
        until: until(given.positive("duration_s")),
        ..Settings::default()
    };
    if shaken.is_still() {
        given.push(Problem::value("nothing moves the object", "give a motion"));
    }
    given.finish()?;
    let (Some(surface), Some(true)) = (surface, carried) else {
        return Ok(None);
    };
    let request = SlideRequest {
        block: body.block,
        surface,
        stop,
        horizontal: shaken.horizontal(),
        vertical: shaken.upward(),
        how: shaken.how(settings, Release::default()),
    };
    let report = shaken.follow(py, move || slid(&request))?;
    let samples = report.history.samples.iter();
    let rows: Vec<_> = samples.map(sliding::history_row).collect();
    answer(
        py,
        &report.facts,
        report.warnings,
        history.then(|| columns(sliding::HISTORY, &rows)),
    )
    .map(Some)
}
