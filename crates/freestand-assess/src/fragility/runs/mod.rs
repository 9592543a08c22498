//! Fragilities from runs: objects under motions at many scales.
//!
//! `changed` has objects that options change, `shaking` the motions and their measures, `follow` the
//! runs, `levels` the intensities of stripes, `kept` the finished runs on disk, `table` their outcomes in the form that the fit reads,
//! `quality` how well each measure predicts the outcome, `figures` the figures.

mod changed;
mod figures;
mod follow;
mod kept;
mod levels;
mod quality;
mod shaking;
mod table;

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};

use freestand::block::Block;
use freestand::cushion::Cushion;
use freestand::fragility::{LimitState, resurrections};
use freestand::rocking::Restitution;
use freestand_input::file::InputFile;
use freestand_input::problem::{Problem, ProblemKind, Problems};
use freestand_input::quantity::{Dimension, parse_grid, shorten};
use freestand_input::words::{Choices, counted, name_of, number, shortest, significant, some};
use freestand_output::facts::{Facts, table as of_rows};
use freestand_output::figure::{Figure, FigureError};
use freestand_output::table::Table;
use freestand_study::cushion::EdgeCushion;
use freestand_study::recorded::refuse_copies;
use freestand_study::run::{Progress, Stage, Step};
use freestand_study::shape::Sizes;
use freestand_study::study::Study;
use rayon::prelude::*;

use super::measure::{At, MEASURES, Measure};
use super::outcomes::OutcomeTable;
use super::{FitMethod, FragilityReport, FragilityRequest, ShockLimits, TWO_STAGE, check_replicates, fitted};
use crate::inventory::too_mild;
use crate::inventory::{Inventory, Item};
use crate::job::{JobReport, Part, said};
use crate::library::{Confidence, Tolerance};
use crate::output::head;
use crate::verdict::Nominal;
use follow::{Followed, GoOn};
use shaking::{RatioFactors, Shaking};

pub use changed::{Change, ChangedObject};
pub use kept::KeepRuns;
pub use quality::Quality;
pub use shaking::{DEFAULT_WORLDS, FloorMotion};
pub use table::file_name;

/// How runs are chosen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Method {
    /// Every motion is scaled up.
    Incremental,
    /// Every motion is scaled to the same intensities.
    Stripes,
    /// Every motion is used once, unscaled.
    Cloud,
}

/// Methods by name.
pub const METHODS: Choices<Method> = &[
    (Method::Incremental, "ida", "every motion is scaled up until it overturns the object"),
    (Method::Stripes, "stripes", "every motion is scaled to each intensity of --scales"),
    (Method::Cloud, "cloud", "every motion is used once, unscaled"),
];

/// Scales above this are marked: a motion that is scaled so far is a poor model of a stronger
/// earthquake.
const DOUBTFUL_SCALE: f64 = 4.0;

/// The largest scale, if the user gives none.
pub const DEFAULT_MAX_SCALE: f64 = 10.0;

/// The most measures of one request.
const MAX_MEASURES: usize = 24;

/// Measures as a list, `pfv, sa(0.5)`.
///
/// # Errors
/// An unknown measure.
pub fn measures(text: &str) -> Result<Vec<Measure>, Problem> {
    let measure = |name: &str| {
        let parsed = Measure::parse(name);
        parsed.ok_or_else(|| {
            let message = format!("\"{}\" is not an intensity measure", shorten(name.trim()));
            Problem::value(message, format!("write some of {MEASURES}, without the units"))
        })
    };
    text.split(',').map(measure).collect()
}

/// `adaptive`, or levels: factors for an incremental analysis, intensities by the first measure for
/// stripes. `from:to:count` has equal ratios, because rates fall with a power of the intensity: equal
/// steps would leave the weak motions, which cause most of a rate, between two levels.
///
/// # Errors
/// A grid that cannot be read or has a value that is not above 0, or a method that has no scales.
pub fn scales(text: &str, method: Method, first: Measure) -> Result<Option<Vec<f64>>, Problem> {
    if text.trim() == "adaptive" {
        return Ok(None);
    }
    let values = match method {
        Method::Incremental => parse_grid(text, Dimension::Ratio)
            .map_err(|problem| problem.hint("write adaptive, or factors such as \"0.5:5:10\" or \"0.5, 1, 2\""))?,
        Method::Stripes => first.quantities(text)?,
        Method::Cloud => {
            let hint = "leave the scales out, or give `method = \"ida\"`";
            return Err(Problem::value("a cloud uses every motion unscaled", hint).of(&["scales"]));
        }
    };
    if values.len() > MAX_LEVELS {
        let message =
            format!("{} are too many: each is a run of every object and motion", counted(values.len(), "scale"));
        return Err(Problem::value(message, format!("give at most {MAX_LEVELS}")).of(&["scales"]));
    }
    if let Some(bad) = values.iter().find(|value| **value <= 0.0) {
        return Err(Problem::value(format!("{bad} is not above 0"), "give positive values").of(&["scales"]));
    }
    Ok(Some(if text.contains(':') { in_equal_ratios(values) } else { values }))
}

/// As many values between the same ends, each the same factor above the one before it.
fn in_equal_ratios(values: Vec<f64>) -> Vec<f64> {
    let [from, .., to] = *values.as_slice() else { return values };
    let last = values.len() - 1;
    let at = |i: usize| match i {
        0 => from,
        i if i == last => to,
        i => from * (to / from).powf(i as f64 / last as f64),
    };
    (0..values.len()).map(at).collect()
}

/// One object by its numbers, under motions of its floor.
#[derive(Debug, Clone)]
pub struct GivenObject {
    /// The block.
    pub block: Block,
    /// Restitution of its impacts.
    pub restitution: Restitution,
    /// Mass \[kg\] and the cushion under one edge, for the shock.
    pub body: Option<(f64, EdgeCushion)>,
    /// What it withstands.
    pub limits: Limits,
    /// The motions.
    pub motions: Vec<FloorMotion>,
    /// Whether the object is on the ground, so that its motions are ground motions.
    pub is_on_ground: bool,
}

/// What an object withstands.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Limits {
    /// Peak acceleration of a landing \[m/s²\].
    pub peak_m_s2: Option<f64>,
    /// Duration of the half-sine with that peak \[s\].
    pub duration_s: Option<f64>,
    /// Velocity change \[m/s\].
    pub velocity_change_m_s: Option<f64>,
    /// Uplift of the free edge \[m\].
    pub edge_lift_m: Option<f64>,
}

impl Limits {
    /// Whether a landing is compared with any of them.
    pub fn needs_shock(&self) -> bool {
        self.peak_m_s2.is_some() || self.velocity_change_m_s.is_some()
    }

    fn tolerance(&self) -> Tolerance {
        let Self { peak_m_s2, duration_s, velocity_change_m_s, edge_lift_m } = *self;
        let (source, confidence) = ("the user".to_owned(), Confidence::Stated);
        Tolerance { peak_m_s2, duration_s, velocity_change_m_s, edge_lift_m, source, confidence }
    }
}

/// The objects of runs.
#[derive(Debug, Clone)]
pub enum RunObjects<'a> {
    /// One by its numbers.
    Given(Box<GivenObject>),
    /// Those of a list on the floors of a study.
    Listed {
        /// The study.
        study: &'a Study,
        /// The list.
        inventory: &'a Inventory,
        /// How many worlds; `None`: the records of the study once each, or [`DEFAULT_WORLDS`].
        worlds: Option<u32>,
        /// Objects of the list that are run as options change them, too.
        changed: Vec<ChangedObject>,
    },
}

/// The id of an object that is given by its numbers.
pub const GIVEN_ID: &str = "object";

/// What is run and fitted.
#[derive(Debug, Clone)]
pub struct RunsRequest<'a> {
    /// The objects.
    pub objects: RunObjects<'a>,
    /// Measures; empty: `pfv` of given motions, `pgv` of a study.
    pub measures: Vec<Measure>,
    /// Where spectral accelerations are taken; `None`: at the ground where it is known.
    pub at: Option<At>,
    /// How runs are chosen.
    pub method: Method,
    /// Scales of an incremental analysis, or intensities of stripes; `None`: adaptive.
    pub scales: Option<Vec<f64>>,
    /// The largest scale.
    pub max_scale_ratio: f64,
    /// Rotation over α beyond which a tolerance is exceeded.
    pub rotation_ratio: Option<f64>,
    /// How limit states are fitted.
    pub fit: FitMethod,
    /// Bootstrap samples; `None`: [`super::DEFAULT_REPLICATES`].
    pub replicates: Option<u32>,
    /// Seed of the bootstrap.
    pub seed: u64,
    /// The files that it was made from, for the document.
    pub inputs: Vec<InputFile>,
    /// Where the finished runs of an inventory are kept; `None`: nowhere.
    pub keep: Option<KeepRuns>,
}

/// One object and its runs.
#[derive(Debug, Clone)]
pub(super) struct ObjectRuns {
    id: String,
    nominal: Nominal,
    factors: RatioFactors,
    /// Place of its floor among those with motions.
    floor: usize,
    /// For each motion its runs, by rising scale.
    motions: Vec<Vec<Followed>>,
    /// For each motion the scale below which it does not lift the object; `None`: not known.
    uplifts_ratio: Vec<Option<f64>>,
    /// For each measure the intensities over which an adaptive analysis spreads its runs.
    spans: Vec<Option<(f64, f64)>>,
    has_tolerance: bool,
    /// Whether its tolerance also limits the rotation.
    limits_rotation: bool,
}

/// Fragilities from runs.
#[derive(Debug)]
pub struct RunsReport {
    /// One for each measure, with the outcomes of its table.
    pub reports: Vec<FragilityReport>,
    /// The tables of outcomes, for each measure.
    pub outcomes: Vec<Table>,
    /// Warnings about the result.
    pub warnings: Vec<String>,
    method: Method,
    max_scale_ratio: f64,
    scales: Option<Vec<f64>>,
    rotation_ratio: Option<f64>,
    fit: FitMethod,
    objects: Vec<ObjectRuns>,
    floors: Vec<Vec<Shaking>>,
    left_out: Vec<(String, String)>,
    inputs: Vec<InputFile>,
    /// Whose building and hazard this is; `None`: the motions were given.
    study: Option<OfStudy>,
}

/// What a document says about the study of its runs, and about their list.
#[derive(Debug)]
struct OfStudy {
    said: JobReport,
    hazard: Option<String>,
    building: String,
    /// What nobody stated of the place and the building, and of the objects.
    assumed: Vec<String>,
    toml: String,
}

impl OfStudy {
    fn of(objects: &RunObjects) -> Option<Self> {
        let RunObjects::Listed { study, inventory, .. } = objects else { return None };
        Some(Self {
            said: said(study, &head::head(study, inventory)),
            hazard: head::hazard(study),
            building: head::building(study),
            assumed: head::silent(study, inventory),
            toml: study.toml.clone(),
        })
    }
}

/// The most scales or levels of one analysis: each is a run of every object under every motion.
const MAX_LEVELS: usize = 10_000;

/// Runs objects under motions at many scales and fits their fragilities, on the current thread pool;
/// the result does not depend on the number of threads.
///
/// # Errors
/// A measure that the motions do not have, a scale above the largest, no motion, no object that can
/// be run; a run that was stopped.
pub fn fragility_of_runs(request: &RunsRequest, progress: Progress) -> Result<RunsReport, Problems> {
    check_replicates(request.replicates)?;
    let measures = measures_of(request)?;
    let go_on = || super::go_on(progress).map_err(Problems::from);
    let Prepared { mut objects, floors, left_out } = prepare(request, &measures, go_on)?;
    check_ground(&measures, &floors)?;
    check_shocks(request.fit, &objects)?;
    let chosen = match (request.method, &request.scales) {
        (Method::Stripes, None) => Some(levels::chosen(request, &objects, &floors, &measures, &go_on)?),
        _ => None,
    };
    let with_levels = chosen.map(|levels| RunsRequest { scales: Some(levels), ..request.clone() });
    let request = with_levels.as_ref().unwrap_or(request);
    let motions: Vec<usize> = floors.iter().map(Vec::len).collect();
    let of = |one: &ObjectRuns| motions.get(one.floor).copied().unwrap_or(0);
    let total = objects.iter().map(of).sum();
    let done = AtomicUsize::new(0);
    let count = |runs: usize| -> Result<(), Problems> {
        let done = done.fetch_add(runs, Ordering::Relaxed) + runs;
        match progress(Step { stage: Some(Stage::RockingHistories), done, total }) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(Problem::stopped().into()),
        }
    };
    let store = kept::open(request, &measures, objects.len())?;
    for part in Part::of_run(objects.len(), kept::PART) {
        let Some(objects) = objects.get_mut(part.rows.clone()) else { continue };
        if let Some(store) = &store
            && kept::read(store, &part, objects, &motions)
        {
            count(objects.iter().map(of).sum())?;
            continue;
        }
        run_part(request, objects, &floors, &measures, (&go_on, &|| count(1)))?;
        if let Some(store) = &store {
            kept::write(store, &part, objects)?;
        }
    }
    fit(request, measures, Prepared { objects, floors, left_out }, progress)
}

/// The runs of an object under one motion at several scales, and the scale at which it begins to lift.
type Followings = (Vec<Followed>, Option<f64>);

/// Runs some objects under all motions of their floors.
fn run_part(
    request: &RunsRequest,
    objects: &mut [ObjectRuns],
    floors: &[Vec<Shaking>],
    measures: &[(Measure, At)],
    (go_on, count): (GoOn, GoOn),
) -> Result<(), Problems> {
    // Every motion of every object is a task of its own.
    let tasks: Vec<(usize, usize)> = objects
        .iter()
        .enumerate()
        .flat_map(|(i, one)| (0..floors.get(one.floor).map_or(0, Vec::len)).map(move |motion| (i, motion)))
        .collect();
    let followed: Vec<Result<Followings, Problems>> = tasks
        .par_iter()
        .map(|&(i, motion)| {
            let one = objects.get(i).ok_or_else(missing)?;
            let shaking = floors.get(one.floor).and_then(|floor| floor.get(motion)).ok_or_else(missing)?;
            let runs = follow::first_runs(request, one, shaking, measures, go_on)?;
            let uplift_ratio = follow::uplift_ratio(request, one, shaking);
            count()?;
            Ok((runs, uplift_ratio))
        })
        .collect();
    for ((i, _), runs) in tasks.iter().zip(followed) {
        if let Some(one) = objects.get_mut(*i) {
            let (runs, uplift_ratio) = runs?;
            one.motions.push(runs);
            one.uplifts_ratio.push(uplift_ratio);
        }
    }
    if request.method == Method::Incremental && request.scales.is_none() {
        objects.par_iter_mut().try_for_each(|one| {
            go_on()?;
            follow::fill(request, one, floors.get(one.floor).map_or(&[], Vec::as_slice), measures, go_on)
        })?;
    }
    Ok(())
}

fn missing() -> Problems {
    Problem::new(ProblemKind::Computation, "a run has no object").into()
}

/// Fits the outcomes by each measure.
fn fit(
    request: &RunsRequest,
    measures: Vec<(Measure, At)>,
    Prepared { objects, floors, left_out }: Prepared,
    progress: Progress,
) -> Result<RunsReport, Problems> {
    let mut report = RunsReport {
        reports: Vec::new(),
        outcomes: Vec::new(),
        warnings: Vec::new(),
        method: request.method,
        max_scale_ratio: request.max_scale_ratio,
        scales: request.scales.clone(),
        rotation_ratio: request.rotation_ratio,
        fit: request.fit,
        objects,
        floors,
        left_out,
        inputs: request.inputs.clone(),
        study: OfStudy::of(&request.objects),
    };
    for (place, (measure, at)) in measures.iter().enumerate() {
        super::go_on(progress)?;
        let outcomes = table::outcomes(&report, (*measure, place, *at), progress)?;
        super::go_on(progress)?;
        let name = file_name("outcomes", place, *measure);
        let table = table::read(outcomes.as_ref(), &name, progress)?;
        let limits = shock_limits(request.fit, &report.objects, &table);
        let fits = FragilityRequest {
            outcomes: PathBuf::from(name),
            at: Some(*at),
            fit: request.fit.kind(),
            shock: limits.iter().flatten().next().copied(),
            replicates: request.replicates,
            seed: request.seed,
        };
        let mut found = fitted(fits, table, (name_of(METHODS, request.method), &limits), progress)?;
        for object in &mut found.objects {
            let Some(runs) = report.objects.iter().find(|one| one.id == object.id) else { continue };
            let shakings = report.floors.get(runs.floor).map_or(&[][..], Vec::as_slice);
            object.resurrections = Some(runs.motions.iter().map(|runs| resurrections(&follow::classes(runs))).sum());
            object.scaled_above_4 = Some(runs.marked());
            object.qualities = quality::qualities(request.method, object, runs, shakings, (*measure, place, *at));
        }
        report.reports.push(found);
        report.outcomes.push(outcomes);
    }
    report.warnings = report.all_warnings();
    if let RunObjects::Given(object) = &request.objects {
        report.warnings.extend(Sizes::of(&object.block).doubts());
    }
    Ok(report)
}

/// Refuses a fit of shocks if no object has a tolerance that is a peak acceleration alone.
fn check_shocks(fit: FitMethod, objects: &[ObjectRuns]) -> Result<(), Problem> {
    let why = objects.first().and_then(|one| one.shock_limits().err());
    let Some(why) = why.filter(|_| fit == FitMethod::TwoStage && objects.iter().all(|one| one.shock_limits().is_err()))
    else {
        return Ok(());
    };
    let message = format!("`fit = \"{TWO_STAGE}\"` needs the shocks of an object and its tolerance: {why}");
    let hint = "give mass, cushion and a peak acceleration as tolerance, or fit the outcomes with `fit = \"ordered\"`";
    Err(Problem::value(message, hint).of(&["fit"]))
}

/// What a fit of shocks needs for each object of a table; `None` for objects whose outcomes are
/// fitted.
fn shock_limits(fit: FitMethod, objects: &[ObjectRuns], table: &OutcomeTable) -> Vec<Option<ShockLimits>> {
    let of = |id: &String| objects.iter().find(|one| one.id == *id).and_then(|one| one.shock_limits().ok());
    table.objects.iter().map(|id| of(id).filter(|_| fit == FitMethod::TwoStage)).collect()
}

/// The measures with the place of each.
fn measures_of(request: &RunsRequest) -> Result<Vec<(Measure, At)>, Problems> {
    let (ground, default) = match &request.objects {
        RunObjects::Given(object) if object.is_on_ground => (At::Ground, Measure::Pgv),
        RunObjects::Given(_) => (At::Floor, Measure::Pfv),
        RunObjects::Listed { study, .. } if study.ground == freestand_study::study::Ground::OnFloors => {
            (At::Floor, Measure::Pfv)
        }
        RunObjects::Listed { .. } => (At::Ground, Measure::Pgv),
    };
    let asked = if request.measures.is_empty() { vec![default] } else { request.measures.clone() };
    if asked.len() > MAX_MEASURES {
        let message = format!("{} measures are too many", asked.len());
        return Err(Problem::value(message, format!("give at most {MAX_MEASURES}")).of(&["im"]).into());
    }
    if let Some((i, twice)) = asked.iter().enumerate().find(|(i, one)| asked[..*i].contains(one)) {
        let message = format!("the measure {} is given twice (number {} in the list)", twice.name(), i + 1);
        return Err(Problem::value(message, "name each measure once").of(&["im"]).into());
    }
    let placed = |measure: Measure| -> Result<(Measure, At), Problem> {
        // A place that was named holds for the measures that may be at either.
        let given = if measure.place().is_some() { None } else { Some(request.at.unwrap_or(ground)) };
        Ok((measure, measure.at(given)?))
    };
    Ok(asked.into_iter().map(placed).collect::<Result<_, Problem>>()?)
}

/// Refuses measures of the ground where only floor motions are known.
fn check_ground(measures: &[(Measure, At)], floors: &[Vec<Shaking>]) -> Result<(), Problem> {
    let has_ground = floors.iter().flatten().all(|shaking| shaking.at_ground.is_some());
    let Some((measure, _)) = measures.iter().find(|(_, at)| *at == At::Ground && !has_ground) else { return Ok(()) };
    let message = format!("{} is a measure of the ground, and only the motions of the floor are known", measure.name());
    let hint = "write pfa or pfv, or `at = \"floor\"` for a spectral acceleration; if the object stands on the \
                ground, give `at = \"ground\"`";
    Err(Problem::value(message, hint).of(&["im"]))
}

/// Objects and motions before anything is run.
struct Prepared {
    objects: Vec<ObjectRuns>,
    floors: Vec<Vec<Shaking>>,
    /// Ids, and why.
    left_out: Vec<(String, String)>,
}

fn prepare(
    request: &RunsRequest,
    measures: &[(Measure, At)],
    go_on: impl Fn() -> Result<(), Problems> + Sync,
) -> Result<Prepared, Problems> {
    let asked: Vec<Measure> = measures.iter().map(|(measure, _)| *measure).collect();
    let runs = |id: &str, nominal: Nominal, floor: usize| -> Result<ObjectRuns, Problem> {
        // Its fit needs shocks that follow from the uplift.
        let nominal = if request.fit == FitMethod::TwoStage { nominal.without_pads() } else { nominal };
        Ok(ObjectRuns {
            id: id.to_owned(),
            factors: RatioFactors::new(&nominal.block)?,
            floor,
            motions: Vec::new(),
            uplifts_ratio: Vec::new(),
            spans: Vec::new(),
            has_tolerance: request.rotation_ratio.is_some() || nominal.has_tolerance(),
            limits_rotation: request.rotation_ratio.is_some(),
            nominal,
        })
    };
    match &request.objects {
        RunObjects::Given(object) => {
            if object.motions.is_empty() {
                return Err(Problem::value("there are no motions to run", "give `motion`, one or more files").into());
            }
            Sizes::of(&object.block).check()?;
            refuse_copies(
                object
                    .motions
                    .iter()
                    .map(|motion| (motion.name.as_str(), [Some(&motion.horizontal), motion.vertical.as_ref()])),
            )?;
            let tolerance = Some(object.limits.tolerance()).filter(|_| object.limits != Limits::default());
            let nominal = Nominal::of_block(object.block, object.restitution, object.body.as_ref(), tolerance.as_ref());
            if nominal.lacks_shock() {
                let hint = "give `mass` and `stiffness` (or another cushion), or leave the tolerance out";
                let message =
                    "the tolerance needs the shock of a landing, and so the mass and the cushion of the object";
                return Err(Problem::value(message, hint).of(&["tolerance"]).into());
            }
            let floors = vec![shaking::given(&object.motions, object.is_on_ground, &asked)?];
            Ok(Prepared { objects: vec![runs(GIVEN_ID, nominal, 0)?], floors, left_out: Vec::new() })
        }
        RunObjects::Listed { study, inventory, worlds, changed } => {
            let mut levels_ratio: Vec<f64> = Vec::new();
            let (mut objects, mut left_out) = (Vec::new(), Vec::new());
            let mut problems = Problems::default();
            let as_changed = changed.iter().filter_map(|one| problems.keep(changed_item(one, inventory))).collect();
            let as_changed: Vec<Item> = problems.finish(Some(as_changed))?;
            for item in inventory.items.iter().cloned().chain(as_changed) {
                let nominal = match Nominal::new(&item, &study.assessment) {
                    Ok(nominal) => nominal,
                    Err(why) => {
                        left_out.push((item.id.clone(), why));
                        continue;
                    }
                };
                let level = nominal.level_ratio;
                let floor = levels_ratio.iter().position(|other| *other == level).unwrap_or_else(|| {
                    levels_ratio.push(level);
                    levels_ratio.len() - 1
                });
                objects.push(runs(&item.id, nominal, floor)?);
            }
            if objects.is_empty() {
                let why = left_out.first().map_or_else(
                    || "the list is empty".to_owned(),
                    |(id, why)| format!("{} for example: {why}", shorten(id)),
                );
                let message = format!("no object of the list can be run ({why})");
                let hint = "give at least `height`, `thickness` and the floor of one object that can rock";
                return Err(Problem::value(message, hint).in_file(&inventory.path).into());
            }
            let floors = shaking::of_study(study, &levels_ratio, *worlds, &asked, go_on)?;
            Ok(Prepared { objects, floors, left_out })
        }
    }
}

/// An object of an inventory as an option changes it.
fn changed_item(changed: &ChangedObject, inventory: &Inventory) -> Result<Item, Problem> {
    let wrong =
        |message: String, hint: &str| Problem::value(message, hint).in_file(&changed.file).at_line(changed.line);
    let found = inventory.items.iter().find(|item| item.id == changed.id).ok_or_else(|| {
        let message = format!("the inventory has no object {}", shorten(&changed.id));
        wrong(message, "correct its id, or leave out the row")
    })?;
    let Change { stiffness_n_m, base_thickness_m, mass_kg } = changed.change;
    // Feet may reach beyond the object, but not into the wall behind it.
    let reach_m = base_thickness_m.zip(found.thickness_m).map(|(base_m, thickness_m)| 0.5 * (base_m - thickness_m));
    if let Some((reach_m, gap_m)) = reach_m.zip(found.surroundings.wall_gap_m).filter(|(reach, gap)| reach > gap) {
        let message = format!(
            "the feet of {} would reach {} m beyond it, but the wall is only {} m behind it",
            shorten(&changed.id),
            number(reach_m, 3),
            shortest(gap_m)
        );
        return Err(wrong(message, "correct base_thickness, or the gap to the wall in the inventory"));
    }
    let cushion = stiffness_n_m.map(Cushion::linear).transpose();
    let cushion = cushion.map_err(|error| wrong(error.to_string(), "correct the stiffness"))?;
    let cushion = cushion.map(|cushion| EdgeCushion { cushion, pad_thickness_m: None, notes: Vec::new() });
    Ok(Item {
        id: changed.curve_id.clone(),
        cushion: cushion.or_else(|| found.cushion.clone()),
        base_thickness_m: base_thickness_m.or(found.base_thickness_m),
        mass_kg: mass_kg.or(found.mass_kg),
        ..found.clone()
    })
}

impl ObjectRuns {
    /// The limit states that its runs can tell.
    fn states(&self) -> Vec<LimitState> {
        let can_tell = |state: &LimitState| *state != LimitState::Exceeds || self.has_tolerance;
        LimitState::ALL.into_iter().filter(can_tell).collect()
    }

    /// What a fit of its shocks needs.
    ///
    /// # Errors
    /// Why the shocks cannot be fitted, in words.
    fn shock_limits(&self) -> Result<ShockLimits, &'static str> {
        if self.limits_rotation {
            return Err("its tolerance also limits the rotation");
        }
        let (tolerance_g, ceiling_g) = self.nominal.shock_limits()?;
        Ok(ShockLimits { tolerance_g, ceiling_g })
    }

    /// Number of runs whose scale is above [`DOUBTFUL_SCALE`].
    fn marked(&self) -> usize {
        self.motions.iter().flatten().filter(|run| run.scale_ratio > DOUBTFUL_SCALE).count()
    }
}

/// How many objects that were left out are named.
const NAMED_LEFT_OUT: usize = 3;

impl RunsReport {
    fn all_warnings(&self) -> Vec<String> {
        let mut warnings = self.study.as_ref().map_or_else(Vec::new, |study| study.said.all_warnings());
        if !self.left_out.is_empty() {
            let named: Vec<String> = self.left_out.iter().map(|(id, why)| format!("{} ({why})", shorten(id))).collect();
            let named = some(&named, NAMED_LEFT_OUT);
            let objects = counted(self.left_out.len(), "object");
            let verb = if self.left_out.len() == 1 { "was" } else { "were" };
            warnings.push(format!("{objects} {verb} not run: {named}"));
        }
        if self.fit == FitMethod::TwoStage {
            let not: Vec<(&str, &str)> =
                self.objects.iter().filter_map(|one| Some((&*one.id, one.shock_limits().err()?))).collect();
            if let Some((id, why)) = not.first() {
                let verb = if not.len() == 1 { "is" } else { "are" };
                warnings.push(format!(
                    "{} {verb} fitted as ordered, not from shocks (for example {}, because {why})",
                    counted(not.len(), "object"),
                    shorten(id),
                ));
            }
        }
        let lacking = self.objects.iter().filter(|one| one.nominal.lacks_shock()).count();
        if lacking > 0 {
            let (verb, them) = if lacking == 1 { ("has", "its shock is") } else { ("have", "their shocks are") };
            warnings.push(format!(
                "{} {verb} a tolerance, but no mass or no cushion: {them} not known, so \"exceeds\" is not fitted; \
                 add the mass and the cushion",
                counted(lacking, "object")
            ));
        }
        let mut mild: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
        for one in &self.objects {
            if let Some(why) = one.nominal.too_mild() {
                mild.entry(why).or_default().push(&one.id);
            }
        }
        warnings.extend(mild.iter().filter_map(|(why, ids)| too_mild(why, ids)));
        let runs: usize = self.objects.iter().flat_map(|one| &one.motions).map(Vec::len).sum();
        let marked: usize = self.objects.iter().map(ObjectRuns::marked).sum();
        if marked > 0 {
            warnings.push(format!(
                "{marked} of {} use a motion scaled by more than {DOUBTFUL_SCALE}: see the column scale of outcomes.csv",
                counted(runs, "run")
            ));
        }
        // Some do not depend on the measure.
        let is_of_all = |text: &String| self.reports.iter().all(|report| report.warnings.contains(text));
        for report in &self.reports {
            let name = report.table.measure.name();
            for text in &report.warnings {
                let text = if is_of_all(text) { text.clone() } else { format!("{name}: {text}") };
                if !warnings.contains(&text) {
                    warnings.push(text);
                }
            }
        }
        warnings
    }

    /// `left_out.csv`: the objects that were not run, and why; `None` where all were.
    ///
    /// # Errors
    /// None in practice: see [`of_rows`].
    pub fn left_out_table(&self) -> Result<Option<Table>, Problem> {
        let row = |(id, why): &'_ (String, String)| Facts::default().key("id", id.clone()).key("why", why.clone());
        let rows: Vec<Facts> = self.left_out.iter().map(row).collect();
        if rows.is_empty() { Ok(None) } else { of_rows(rows).map(Some) }
    }

    /// The sentence that says whose building this is, where no study was given.
    pub fn no_study(&self) -> Option<&String> {
        self.study.as_ref()?.said.no_study.as_ref()
    }

    /// The report by the first measure, for other programs.
    pub fn first(&self) -> Option<&FragilityReport> {
        self.reports.first()
    }

    /// The document.
    pub fn facts(&self, seed: u64) -> Facts<'static> {
        let objects: Vec<Facts> = self.reports.iter().flat_map(FragilityReport::object_facts).collect();
        let motions: Vec<Facts> = self
            .floors
            .iter()
            .flatten()
            .map(|shaking| {
                Facts::default()
                    .key("name", shaking.name.clone())
                    .key("floor_velocity_over_acceleration_s", shaking.at_floor.velocity_over_acceleration_s())
                    .key("floor_mean_period_s", shaking.at_floor.mean_period_s)
            })
            .collect();
        let inputs: Vec<Facts> = self.inputs.iter().map(super::input_facts).collect();
        let said = self.study.as_ref().map(|study| &study.said);
        let left_out: Vec<Facts> = self
            .left_out
            .iter()
            .map(|(id, why)| Facts::default().key("id", id.clone()).key("why", why.clone()))
            .collect();
        Facts::default()
            .key("version", env!("CARGO_PKG_VERSION"))
            .key("seed", seed)
            .key("method", name_of(METHODS, self.method))
            .key("max_scale", self.max_scale_ratio)
            .key("scales", self.scales.clone())
            .key("tolerance_rotation_ratio", self.rotation_ratio)
            .key("inputs", inputs)
            .key("no_study", said.and_then(|said| said.no_study.clone()))
            .key("assumptions", self.study.as_ref().map(|study| study.assumed.clone()))
            .key("place_is_assumed", said.map(|said| said.place_is_assumed))
            .key("building_is_assumed", said.map(|said| said.building_is_assumed))
            .key("place_name", said.and_then(|said| said.place_name.clone()))
            .key("building_name", said.and_then(|said| said.building_name.clone()))
            .key("hazard", self.study.as_ref().and_then(|study| study.hazard.clone()))
            .key("building", self.study.as_ref().map(|study| study.building.clone()))
            .key("study", self.study.as_ref().map(|study| study.toml.clone()))
            .key("motions", motions)
            .key("left_out", left_out)
            .key("objects", objects)
            .key("im_ranking", self.ranking())
    }

    /// For each object and limit state the measures, the most proficient one first.
    fn ranking(&self) -> Vec<Facts<'static>> {
        let mut ranking = Vec::new();
        let first = self.reports.first().map_or(&[][..], |report| report.objects.as_slice());
        for (i, object) in first.iter().enumerate() {
            for state in object.fit.curves.iter().map(|curve| curve.limit_state) {
                let mut measures: Vec<(&FragilityReport, &Quality)> = self
                    .reports
                    .iter()
                    .filter_map(|report| {
                        let qualities = &report.objects.get(i)?.qualities;
                        Some((report, qualities.iter().find(|quality| quality.limit_state == state)?))
                    })
                    .collect();
                let value = |quality: &Quality| quality.proficiency().unwrap_or(f64::INFINITY);
                measures.sort_by(|(_, a), (_, b)| value(a).total_cmp(&value(b)));
                let measures: Vec<Facts> = measures
                    .into_iter()
                    .map(|(report, quality)| {
                        Facts::default()
                            .key("im", report.table.measure.name())
                            .key("at", report.at.name())
                            .key("efficiency", quality.efficiency)
                            .key("practicality", quality.practicality)
                            .key("proficiency", quality.proficiency())
                    })
                    .collect();
                ranking.push(
                    Facts::default()
                        .key("id", object.id.clone())
                        .key("limit_state", state.name())
                        .key("measures", measures),
                );
            }
        }
        ranking
    }

    /// One line for each measure and limit state of the first object, for people.
    pub fn summary(&self) -> String {
        let runs: usize = self.objects.iter().flat_map(|one| &one.motions).map(Vec::len).sum();
        let motions = self.floors.first().map_or(0, Vec::len);
        let mut text = String::new();
        if let Some(OfStudy { said, .. }) = &self.study {
            text.extend(said.no_study.iter().map(|sentence| format!("{sentence}\n\n")));
            text.push_str(&format!("{}\n\n", said.place));
        }
        text.push_str(&format!(
            "{} of {} under {} ({})",
            counted(runs, "run"),
            counted(self.objects.len(), "object"),
            counted(motions, "motion"),
            name_of(METHODS, self.method)
        ));
        let survived: usize =
            self.objects.iter().flat_map(|one| &one.motions).map(|runs| resurrections(&follow::classes(runs))).sum();
        if survived > 0 {
            let plural = if survived == 1 { "run stays" } else { "runs stay" };
            text.push_str(&format!("; {survived} {plural} upright above a scale that overturns the object"));
        }
        text
    }

    /// The measures with their efficiency, practicality, proficiency, for people.
    pub fn measure_rows(&self) -> Vec<Facts<'static>> {
        let of_report = |report: &FragilityReport| -> Vec<Facts<'static>> {
            let name = report.table.measure.name();
            let rows = report.objects.iter().flat_map(|object| {
                object.qualities.iter().map(|quality| {
                    let p = |p: Option<f64>| p.map(|p| significant(p, 2));
                    Facts::default()
                        .key("id", object.id.clone())
                        .key("limit_state", quality.limit_state.name())
                        .key("im", name.clone())
                        .key("efficiency", quality.efficiency)
                        .key("practicality", quality.practicality)
                        .key("proficiency", quality.proficiency())
                        .key("p_mean_period", p(quality.p_mean_period))
                        .key("p_pgv_over_pga", p(quality.p_velocity_over_acceleration))
                })
            });
            rows.collect()
        };
        self.reports.iter().flat_map(of_report).collect()
    }

    /// The runs against rotation and shock.
    ///
    /// # Errors
    /// What the plot library says when it cannot draw.
    pub fn ida_figure(&self) -> Result<Figure, FigureError> {
        figures::ida(self)
    }

    /// β by measure.
    ///
    /// # Errors
    /// What the plot library says when it cannot draw.
    pub fn measures_figure(&self) -> Result<Figure, FigureError> {
        figures::measures(self)
    }

    /// What the first measure leaves, against other properties of the motions.
    ///
    /// # Errors
    /// What the plot library says when it cannot draw.
    pub fn residuals_figure(&self) -> Result<Figure, FigureError> {
        figures::residuals(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ends as they are written, and one factor between neighbours; a list stays as it is.
    #[test]
    fn a_grid_of_levels_has_equal_ratios() {
        let levels = |text: &str| scales(text, Method::Stripes, Measure::Pga).unwrap().unwrap();
        let grid = levels("0.05 g:1.5 g:10");
        assert_eq!((grid.len(), grid[0], grid[9]), (10, 0.05, 1.5));
        let ratio = 30_f64.powf(1.0 / 9.0);
        // Rounding of two powers.
        assert!(grid.windows(2).all(|pair| (pair[1] / pair[0] / ratio - 1.0).abs() < 1e-12), "{grid:?}");
        assert_eq!(levels("0.1 g, 0.2 g, 0.3 g"), [0.1, 0.2, 0.3]);
        let factors = scales("0.5:2:3", Method::Incremental, Measure::Pga).unwrap().unwrap();
        assert_eq!(factors, [0.5, 1.0, 2.0]);
        assert!(scales("0 g:1 g:4", Method::Stripes, Measure::Pga).is_err());
    }
}
