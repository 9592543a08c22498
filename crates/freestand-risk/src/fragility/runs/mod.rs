//! Fragilities from runs: objects under motions at many scales.
//!
//! `request` is what is asked, `changed` has objects that options change, `shaking` the motions and their
//! measures, `follow` the runs, `levels` the intensities of stripes, `kept` the finished runs on disk, `table`
//! their outcomes in the form that the fit reads, `quality` how well each measure predicts the outcome,
//! `report` the result.

mod changed;
mod follow;
mod kept;
mod levels;
mod quality;
mod report;
mod request;
mod shaking;
mod table;

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use freestand::fragility::{LimitState, resurrections};
use freestand_input::file::InputFile;
use freestand_input::problem::{Problem, ProblemKind, Problems};
use freestand_input::quantity::shorten;
use freestand_input::words::name_of;
use freestand_study::recorded::refuse_copies;
use freestand_study::run::{Progress, Stage, Step};
use freestand_study::shape::Sizes;
use rayon::prelude::*;

use super::hazard::MeasuredHazard;
use super::measure::{At, Measure};
use super::outcomes::OutcomeTable;
use super::{FitMethod, Fitting, FragilityRequest, ShockLimits, TWO_STAGE, check_replicates};
use changed::changed_item;
use follow::GoOn;
use freestand_assess::store::Store;
use freestand_assess::verdict::{NoShockLimits, Nominal};
use freestand_inventory::Item;
use request::{DOUBTFUL_SCALE, GIVEN_ID, MAX_MEASURES};
use shaking::{Asked, Motions, RatioFactors};

pub use changed::{Change, ChangedObject};
pub use follow::Followed;
pub use levels::Added;
pub use report::{LeftOut, RunsDoubt, RunsReport};
pub use request::{
    DEFAULT_MAX_SCALE, GivenObject, KeepRuns, Limits, METHODS, Method, RunObjects, RunsRequest,
    measures, scales,
};
pub use shaking::{FloorMotion, FloorShaking};
pub use table::file_name;

/// One object and its runs.
#[derive(Debug, Clone)]
pub struct ObjectRuns {
    /// Its identifier.
    pub id: String,
    /// The object as it is listed.
    pub nominal: Nominal,
    factors: RatioFactors,
    /// Place of its floor among those with motions.
    pub floor: usize,
    /// For each motion its runs, by rising scale.
    pub motions: Vec<Vec<Followed>>,
    /// For each motion the scale below which it does not lift the object; `None`: not known.
    pub(crate) uplifts_ratio: Vec<Option<f64>>,
    /// For each measure the intensities over which an adaptive analysis spreads its runs.
    pub(crate) spans: Vec<Option<(f64, f64)>>,
    /// Whether it has a tolerance.
    pub(crate) has_tolerance: bool,
    /// Whether its tolerance also limits the rotation.
    pub(crate) limits_rotation: bool,
}

/// Runs objects under motions at many scales and fits their fragilities, on the current thread pool;
/// the result does not depend on the number of threads.
///
/// # Errors
/// A measure that the motions do not have, a scale above the largest, no motion, no object that can
/// be run; a run that was stopped.
pub fn fragility_of_runs(
    request: &RunsRequest,
    progress: Progress,
) -> Result<RunsReport, Problems> {
    check_replicates(request.replicates)?;
    let measures = measures_of(request)?;
    let hazard = levels::hazard(request, &measures)?;
    let go_on = || super::go_on(progress).map_err(Problems::from);
    let Prepared {
        mut objects,
        floors,
        left_out,
    } = prepare(request, &measures, go_on)?;
    check_ground(request, &measures, &floors)?;
    check_shocks(request.fit, &objects)?;
    let motions = Motions {
        floors: &floors,
        measures: &measures,
    };
    let mut asked = request.clone();
    if request.method == Method::Stripes && request.scales.is_none() {
        asked.scales = Some(levels::chosen(request, &objects, motions, &go_on)?);
    }
    let store = kept::open(&asked, &measures, hazard.as_ref(), objects.len())?;
    let work = Work {
        motions,
        store: store.as_ref(),
        progress,
    };
    work.run(&asked, &mut objects, 0)?;
    let added = hazard
        .map(|hazard| work.add_levels(&mut asked, &mut objects, hazard))
        .transpose()?;
    fit(
        asked,
        measures,
        Prepared {
            objects,
            floors,
            left_out,
        },
        added,
        progress,
    )
}

/// What all runs of a request have in common.
struct Work<'a> {
    motions: Motions<'a>,
    /// Where finished runs are kept.
    store: Option<&'a Store>,
    progress: Progress<'a>,
}

impl Work<'_> {
    /// Runs objects, part by part; parts of this round that are kept are read.
    fn run(
        &self,
        request: &RunsRequest,
        objects: &mut [ObjectRuns],
        round: usize,
    ) -> Result<(), Problems> {
        let motions: Vec<usize> = self.motions.floors.iter().map(Vec::len).collect();
        let of = |one: &ObjectRuns| motions.get(one.floor).copied().unwrap_or(0);
        let total = objects.iter().map(of).sum();
        let done = AtomicUsize::new(0);
        let count = |runs: usize| -> Result<(), Problems> {
            let done = done.fetch_add(runs, Ordering::Relaxed) + runs;
            match (self.progress)(Step::new(Stage::RockingHistories, done, total)) {
                ControlFlow::Continue(()) => Ok(()),
                ControlFlow::Break(()) => Err(Problem::stopped().into()),
            }
        };
        for part in kept::parts(objects.len(), round) {
            let Some(objects) = objects.get_mut(part.rows.clone()) else {
                continue;
            };
            if let Some(store) = self.store
                && kept::read(store, &part, objects, &motions)
            {
                count(objects.iter().map(of).sum())?;
                continue;
            }
            self.run_part(request, objects, &|| count(1))?;
            if let Some(store) = self.store {
                kept::write(store, &part, objects)?;
            }
        }
        Ok(())
    }

    /// Runs some objects under all motions of their floors.
    fn run_part(
        &self,
        request: &RunsRequest,
        objects: &mut [ObjectRuns],
        count: GoOn,
    ) -> Result<(), Problems> {
        let Motions { floors, measures } = self.motions;
        let go_on: GoOn = &|| super::go_on(self.progress).map_err(Problems::from);
        // Every motion of every object is a task of its own.
        let tasks: Vec<(usize, usize)> = objects
            .iter()
            .enumerate()
            .flat_map(|(i, one)| {
                (0..floors.get(one.floor).map_or(0, Vec::len)).map(move |motion| (i, motion))
            })
            .collect();
        let followed: Vec<Result<Followings, Problems>> = tasks
            .par_iter()
            .map(|&(i, motion)| {
                let one = objects.get(i).ok_or_else(missing)?;
                let shaking = floors
                    .get(one.floor)
                    .and_then(|floor| floor.get(motion))
                    .ok_or_else(missing)?;
                let runs = follow::first_runs(request, one, shaking, measures, go_on)?;
                let known = one.uplifts_ratio.get(motion).copied();
                let uplift_ratio =
                    known.unwrap_or_else(|| follow::uplift_ratio(request, one, shaking));
                count()?;
                Ok((runs, uplift_ratio))
            })
            .collect();
        for ((i, _), runs) in tasks.iter().zip(followed) {
            if let Some(one) = objects.get_mut(*i) {
                let (runs, uplift_ratio) = runs?;
                one.motions.push(runs);
                // Those of added intensities are known.
                if one.uplifts_ratio.len() < one.motions.len() {
                    one.uplifts_ratio.push(uplift_ratio);
                }
            }
        }
        if request.method == Method::Incremental && request.scales.is_none() {
            objects.par_iter_mut().try_for_each(|one| {
                go_on()?;
                follow::fill(
                    request,
                    one,
                    floors.get(one.floor).map_or(&[], Vec::as_slice),
                    measures,
                    go_on,
                )
            })?;
        }
        Ok(())
    }

    /// Adds intensities to those of stripes until the runs tell the rates of all objects, or as many as may
    /// be added. They follow from the runs before them, so that a resumed command adds the same.
    fn add_levels(
        &self,
        request: &mut RunsRequest,
        objects: &mut [ObjectRuns],
        hazard: MeasuredHazard,
    ) -> Result<Added, Problems> {
        let limit = levels::limit(request, objects, self.motions);
        let mut levels = request.scales.take().unwrap_or_default();
        let (mut added, mut round) = (0, 0);
        loop {
            round += 1;
            super::go_on(self.progress)?;
            let open = levels::open(&hazard.hazard, objects, self.motions, &levels);
            let room = if round > levels::ROUNDS {
                0
            } else {
                levels::MOST_ADDED - added
            };
            let more = levels::wanted(&open, &levels, limit, room);
            if more.is_empty() {
                request.scales = Some(levels);
                let ids = objects
                    .iter()
                    .zip(open)
                    .filter(|(_, parts)| !parts.is_empty());
                return Ok(Added {
                    hazard,
                    count: added,
                    open_ids: ids.map(|(one, _)| one.id.clone()).collect(),
                });
            }
            let earlier: Vec<_> = objects
                .iter_mut()
                .map(|one| std::mem::take(&mut one.motions))
                .collect();
            request.scales = Some(more.clone());
            self.run(request, objects, round)?;
            for (runs, earlier) in objects
                .iter_mut()
                .flat_map(|one| &mut one.motions)
                .zip(earlier.into_iter().flatten())
            {
                runs.extend(earlier);
                follow::sort(runs);
            }
            added += more.len();
            levels.extend(more);
            levels.sort_by(f64::total_cmp);
        }
    }
}

/// The runs of an object under one motion at several scales, and the scale at which it begins to lift.
type Followings = (Vec<Followed>, Option<f64>);

fn missing() -> Problems {
    Problem::new(ProblemKind::Computation, "a run has no object").into()
}

/// Fits the outcomes by each measure.
fn fit(
    request: RunsRequest,
    measures: Vec<Asked>,
    Prepared {
        objects,
        floors,
        left_out,
    }: Prepared,
    added: Option<Added>,
    progress: Progress,
) -> Result<RunsReport, Problems> {
    let mut report = RunsReport {
        request,
        reports: Vec::new(),
        outcomes: Vec::new(),
        added,
        objects,
        floors,
        left_out,
    };
    for asked in measures {
        let Asked { measure, place, at } = asked;
        super::go_on(progress)?;
        let lines = table::lines(&report, asked, progress)?;
        let outcomes = table::outcomes(measure, &lines, progress)?;
        super::go_on(progress)?;
        let name = file_name("outcomes", place, measure);
        let file = InputFile::new(Path::new(&name), outcomes.as_ref());
        let runs = lines.iter().map(|line| line.run);
        let table = OutcomeTable::of_runs(file, measure, runs, progress)?;
        let request = &report.request;
        let limits = shock_limits(request.fit, &report.objects, &table);
        let fits = FragilityRequest {
            outcomes: PathBuf::from(name),
            at: Some(at),
            fit: request.fit.kind(),
            shock: limits.iter().flatten().next().copied(),
            replicates: request.replicates,
            seed: request.seed,
        };
        let fitting = Fitting {
            request: fits,
            table,
            method: name_of(METHODS, request.method),
            limits: &limits,
        };
        let mut found = fitting.fitted(progress)?;
        for object in &mut found.objects {
            let Some(runs) = report.objects.iter().find(|one| one.id == object.id) else {
                continue;
            };
            let shakings = report.floors.get(runs.floor).map_or(&[][..], Vec::as_slice);
            object.resurrections = Some(
                runs.motions
                    .iter()
                    .map(|runs| resurrections(&follow::classes(runs)))
                    .sum(),
            );
            object.scaled_above_4 = Some(runs.marked());
            object.qualities =
                quality::qualities(report.request.method, object, runs, shakings, asked);
        }
        report.reports.push(found);
        report.outcomes.push(outcomes);
    }
    Ok(report)
}

/// Refuses a fit of shocks if no object has a tolerance that is a peak acceleration alone.
fn check_shocks(fit: FitMethod, objects: &[ObjectRuns]) -> Result<(), Problem> {
    let why = objects.first().and_then(|one| one.shock_limits().err());
    let Some(why) = why.filter(|_| {
        fit == FitMethod::TwoStage && objects.iter().all(|one| one.shock_limits().is_err())
    }) else {
        return Ok(());
    };
    let message =
        format!("`fit = \"{TWO_STAGE}\"` needs the shocks of an object and its tolerance: {why}");
    let hint = "give mass, cushion and a peak acceleration as tolerance, or fit the outcomes with `fit = \"ordered\"`";
    Err(Problem::value(message, hint).of(&["fit"]))
}

/// What a fit of shocks needs for each object of a table; `None` for objects whose outcomes are
/// fitted.
fn shock_limits(
    fit: FitMethod,
    objects: &[ObjectRuns],
    table: &OutcomeTable,
) -> Vec<Option<ShockLimits>> {
    let of = |id: &String| {
        objects
            .iter()
            .find(|one| one.id == *id)
            .and_then(|one| one.shock_limits().ok())
    };
    table
        .objects
        .iter()
        .map(|id| of(id).filter(|_| fit == FitMethod::TwoStage))
        .collect()
}

/// The measures with the place of each.
fn measures_of(request: &RunsRequest) -> Result<Vec<Asked>, Problems> {
    let (ground, default) = match &request.objects {
        RunObjects::Given(object) if object.is_on_ground => (At::Ground, Measure::Pgv),
        RunObjects::Given(_) => (At::Floor, Measure::Pfv),
        RunObjects::Listed { study, .. }
            if study.ground == freestand_study::study::Ground::OnFloors =>
        {
            (At::Floor, Measure::Pfv)
        }
        RunObjects::Listed { .. } => (At::Ground, Measure::Pgv),
    };
    let asked = if request.measures.is_empty() {
        vec![default]
    } else {
        request.measures.clone()
    };
    if asked.len() > MAX_MEASURES {
        let message = format!("{} measures are too many", asked.len());
        return Err(
            Problem::value(message, format!("give at most {MAX_MEASURES}"))
                .of(&["im"])
                .into(),
        );
    }
    if let Some((i, twice)) = asked
        .iter()
        .enumerate()
        .find(|(i, one)| asked[..*i].contains(one))
    {
        let message = format!(
            "the measure {} is given twice (number {} in the list)",
            twice.name(),
            i + 1
        );
        return Err(Problem::value(message, "name each measure once")
            .of(&["im"])
            .into());
    }
    // Beside a list, a place that none of the measures has would say nothing.
    let is_listed = matches!(request.objects, RunObjects::Listed { .. });
    let elsewhere = |measure: &Measure| measure.at(request.at).is_err();
    if let Some(first) = asked
        .first()
        .filter(|_| is_listed && asked.iter().all(elsewhere))
    {
        first.at(request.at)?;
    }
    let placed = |(place, measure): (usize, Measure)| -> Result<Asked, Problem> {
        // A place that was named holds for the measures that may be at either.
        let given = if measure.place().is_some() {
            None
        } else {
            Some(request.at.unwrap_or(ground))
        };
        let at = measure.at(given)?;
        Ok(Asked { measure, place, at })
    };
    Ok(asked
        .into_iter()
        .enumerate()
        .map(placed)
        .collect::<Result<_, Problem>>()?)
}

/// Refuses measures of the ground where only floor motions are known.
fn check_ground(
    request: &RunsRequest,
    measures: &[Asked],
    floors: &[Vec<FloorShaking>],
) -> Result<(), Problem> {
    let has_ground = floors
        .iter()
        .flatten()
        .all(|shaking| shaking.at_ground.is_some());
    let Some(Asked { measure, .. }) = measures
        .iter()
        .find(|one| one.at == At::Ground && !has_ground)
    else {
        return Ok(());
    };
    let (known, otherwise) = match &request.objects {
        RunObjects::Given(_) => (
            "only the motions of the floor are known",
            "if the object stands on the ground, give `at = \"ground\"`",
        ),
        RunObjects::Listed { .. } => (
            "the study gives the motions of the floors, not those of the ground",
            "for a measure of the ground, give a study with motions of the ground and the building",
        ),
    };
    let is = if measure.place().is_none() {
        "is asked for at the ground"
    } else {
        "is a measure of the ground"
    };
    let message = format!("{} {is}, and {known}", measure.name());
    let hint =
        format!("write pfa or pfv, or `at = \"floor\"` for a spectral acceleration; {otherwise}");
    Err(Problem::value(message, hint).of(&["im"]))
}

/// Objects and motions before anything is run.
struct Prepared {
    objects: Vec<ObjectRuns>,
    floors: Vec<Vec<FloorShaking>>,
    left_out: Vec<LeftOut>,
}

fn prepare(
    request: &RunsRequest,
    measures: &[Asked],
    go_on: impl Fn() -> Result<(), Problems> + Sync,
) -> Result<Prepared, Problems> {
    let asked: Vec<Measure> = measures.iter().map(|one| one.measure).collect();
    let runs = |id: &str, nominal: Nominal, floor: usize| -> Result<ObjectRuns, Problem> {
        // Its fit needs shocks that follow from the uplift.
        let nominal = if request.fit == FitMethod::TwoStage {
            nominal.without_pads()
        } else {
            nominal
        };
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
                return Err(Problem::value(
                    "there are no motions to run",
                    "give `motion`, one or more files",
                )
                .into());
            }
            Sizes::of(&object.block).check()?;
            refuse_copies(object.motions.iter().map(|motion| {
                (
                    motion.name.as_str(),
                    [Some(&motion.horizontal), motion.vertical.as_ref()],
                )
            }))?;
            let tolerance =
                Some(object.limits.tolerance()).filter(|_| object.limits != Limits::default());
            let nominal = Nominal::of_block(
                object.block,
                object.restitution,
                object.body.as_ref(),
                tolerance.as_ref(),
            );
            if nominal.lacks_shock() {
                let hint =
                    "give `mass` and `stiffness` (or another cushion), or leave the tolerance out";
                let message = "the tolerance needs the shock of a landing, and so the mass and the cushion of the object";
                return Err(Problem::value(message, hint).of(&["tolerance"]).into());
            }
            let floors = vec![shaking::given(
                &object.motions,
                object.is_on_ground,
                &asked,
            )?];
            Ok(Prepared {
                objects: vec![runs(GIVEN_ID, nominal, 0)?],
                floors,
                left_out: Vec::new(),
            })
        }
        RunObjects::Listed {
            study,
            inventory,
            worlds,
            changed,
            ..
        } => {
            let mut levels_ratio: Vec<f64> = Vec::new();
            let (mut objects, mut left_out) = (Vec::new(), Vec::new());
            let mut problems = Problems::default();
            let as_changed = changed
                .iter()
                .filter_map(|one| problems.keep(changed_item(one, inventory)))
                .collect();
            let as_changed: Vec<Item> = problems.finish(Some(as_changed))?;
            for item in inventory.items.iter().cloned().chain(as_changed) {
                let nominal = match Nominal::new(&item, &study.assessment) {
                    Ok(nominal) => nominal,
                    Err(why) => {
                        let id = item.id.clone();
                        left_out.push(LeftOut { id, why });
                        continue;
                    }
                };
                let level = nominal.level_ratio;
                let floor = levels_ratio
                    .iter()
                    .position(|other| *other == level)
                    .unwrap_or_else(|| {
                        levels_ratio.push(level);
                        levels_ratio.len() - 1
                    });
                objects.push(runs(&item.id, nominal, floor)?);
            }
            if objects.is_empty() {
                let why = left_out.first().map_or_else(
                    || "the list is empty".to_owned(),
                    |LeftOut { id, why }| format!("{} for example: {why}", shorten(id)),
                );
                let message = format!("no object of the list can be run ({why})");
                let hint =
                    "give at least `height`, `thickness` and the floor of one object that can rock";
                return Err(Problem::value(message, hint)
                    .in_file(&inventory.path)
                    .into());
            }
            let floors = shaking::of_study(study, &levels_ratio, *worlds, &asked, go_on)?;
            Ok(Prepared {
                objects,
                floors,
                left_out,
            })
        }
    }
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
    /// Why the shocks cannot be fitted.
    fn shock_limits(&self) -> Result<ShockLimits, NoShockLimits> {
        if self.limits_rotation {
            return Err(NoShockLimits::LimitsRotation);
        }
        let (tolerance_g, ceiling_g) = self.nominal.shock_limits()?;
        Ok(ShockLimits {
            tolerance_g,
            ceiling_g,
        })
    }

    /// Number of runs whose scale is above [`DOUBTFUL_SCALE`].
    fn marked(&self) -> usize {
        self.motions
            .iter()
            .flatten()
            .filter(|run| run.scale_ratio > DOUBTFUL_SCALE)
            .count()
    }
}
