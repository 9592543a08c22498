//! A whole assessment, from an inventory to a folder of results. It can be stopped or killed at any
//! moment and resumed.

mod shards;
mod sites;

pub use shards::{
    Merged, PLAN_SCHEMA, PlanRequest, SHARD_SCHEMA, ShardReport, check_shards, merge_shards,
    plan_shards, run_shard,
};

pub(crate) use sites::EXPOSURE;
pub use sites::{SITES_SCHEMA, SiteRun, SitesRun, assess_sites};

use std::cell::RefCell;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use freestand_assess::key::resume_key;
use freestand_assess::portfolio::{
    Keep, Portfolio, Tell, TellEstimates, assess, progress_names, shake,
};
use freestand_assess::result::{Assessment, Decision};
use freestand_assess::store::{PROGRESS, Part, Store, part_size};
use freestand_input::file::InputFile;
use freestand_input::problem::{Problem, Problems};
use freestand_inventory::{Inventory, Item};
use freestand_output::answer::ByName;
use freestand_output::folder::{MANIFEST, OutputFolder, announce};
use freestand_output::json::document;
use freestand_output::paths::io_problem;
use freestand_report::assessment::{
    ALTERNATIVES_NAME, CHANGES_NAME, Earlier, Head, JobReport, JsonRows, OUTCOMES_NAME, PARTS_NAME,
    PARTS_PAGE, PLAN_NAME, WORKLIST_NAME, WORLDS_NAME, Wanted, head, outcomes_head, outcomes_rows,
    said, write_all, write_worlds,
};
use freestand_report::signature::Signing;
use freestand_risk::budget::{Budget, BudgetPlan, Priced};
use freestand_study::resolve::motion_paths;
use freestand_study::run::{Progress, Stage, Step};
use freestand_study::study::Study;
use serde_json::{Map, Value, json};

/// Schema of `manifest.json` and of the document of `freestand assess`.
pub const SCHEMA: &str = "freestand.assess/1";

/// The files of a job, including optional ones.
const OUTPUTS: [&str; 13] = [
    "objects.csv",
    "objects.parquet",
    WORKLIST_NAME,
    WORLDS_NAME,
    OUTCOMES_NAME,
    PLAN_NAME,
    ALTERNATIVES_NAME,
    PARTS_NAME,
    PARTS_PAGE,
    CHANGES_NAME,
    "report.html",
    "assessment.xlsx",
    MANIFEST,
];

/// Called with the row of each object when it is finished, as it will be in `objects.csv`; its rank is
/// that among the objects which were told before it.
pub type TellRow<'a> = &'a dyn Fn(&Map<String, Value>);

/// What is told of objects while a job runs.
#[derive(Clone, Copy, Default)]
pub struct Told<'a> {
    /// Each one when it is finished.
    pub rows: Option<TellRow<'a>>,
    /// What their worlds say so far, after each look at them.
    pub estimates: Option<TellEstimates<'a>>,
}

/// Settings of a job.
#[derive(Debug, Clone, Copy, Default)]
pub struct Job {
    /// Use the finished parts of an earlier run.
    pub resume: bool,
    /// Write into a folder even if it holds other files.
    pub force: bool,
    /// Write `objects.parquet` too.
    pub parquet: bool,
    /// Write `outcomes.csv` too: every object in every world.
    pub outcomes: bool,
    /// How the report and the orders are signed.
    pub signing: Signing,
}

/// Assesses `inventory` on the floors of `study` and writes all outputs into `target`, on the
/// current thread pool.
///
/// Finished parts are in `progress/` of the folder until the run is complete. A run that was
/// stopped leaves them next to valid outputs of the finished objects; one that was killed leaves
/// only the parts. With [`Job::resume`] a run continues either and writes the same bytes as a run
/// that was not interrupted.
///
/// # Errors
/// A motion that cannot be generated, or a folder that cannot be written or was not written by
/// freestand.
pub fn assess_into(
    study: &Study,
    inventory: &Inventory,
    target: &Path,
    job: &Job,
    progress: Progress,
) -> Result<JobReport, Problems> {
    assess_telling(
        study,
        inventory,
        target,
        job,
        Beside::default(),
        Told::default(),
        progress,
    )
}

/// For what the measures of a list are calculated.
#[derive(Clone, Copy)]
pub enum Spending<'b> {
    /// For the plan of this list.
    Planned(&'b Budget),
    /// For the plan of several lists, which takes them from here.
    Priced(&'b Budget, &'b RefCell<Option<Priced>>),
}

impl<'b> Spending<'b> {
    fn budget(self) -> &'b Budget {
        match self {
            Self::Planned(budget) | Self::Priced(budget, _) => budget,
        }
    }
}

/// What is made of the results of a run, beside its outputs.
#[derive(Default)]
pub struct Beside<'b> {
    /// Measures within a budget.
    pub spending: Option<Spending<'b>>,
    /// What has changed since an earlier assessment.
    pub earlier: Option<Earlier>,
}

/// As [`assess_into`], with what is made of the results beside, and reports each object when it is finished, for a
/// user who watches. With something beside nothing of a complete folder is used again.
///
/// # Errors
/// As [`assess_into`].
pub fn assess_telling(
    study: &Study,
    inventory: &Inventory,
    target: &Path,
    job: &Job,
    beside: Beside<'_>,
    tell: Told,
    progress: Progress,
) -> Result<JobReport, Problems> {
    let size = part_size(study, inventory);
    let key = resume_key(study, inventory, size);
    let head = head(study, inventory);
    if job.resume
        && beside.spending.is_none()
        && beside.earlier.is_none()
        && let Some(report) = finished(target, &key, study, inventory, job, &head)
    {
        return Ok(report);
    }
    let parts = Part::of_run(inventory.items.len(), size);
    let names = progress_names(&parts);
    announce(target, job.force, SCHEMA, &names)?;
    let budget = beside.spending.map(Spending::budget);
    let folder = staged(study, inventory, target, job, budget)?;
    let store = Store::open(&target.join(PROGRESS), &key, job.resume)?;
    let rows = tell.rows.map(|tell| (JsonRows::new(inventory), tell));
    let told = |item: &Item, rank: usize, found: &Assessment| {
        if let Some((rows, tell)) = &rows {
            tell(&rows.row(item, rank, found));
        }
    };
    let told = Tell {
        objects: rows.is_some().then_some(&told),
        estimates: tell.estimates,
    };
    let keep = Keep {
        outcomes: job.outcomes.then_some(outcomes_rows),
        motions: None,
    };
    let portfolio = assess(study, inventory, store, parts, keep, told, progress)?;
    let run = Run {
        study,
        inventory,
        head: &head,
        job,
        key: &key,
        motions: None,
        beside,
    };
    written(run, target, folder, portfolio, progress)
}

/// The folder for the outputs, which are checked to have a place in it.
fn staged(
    study: &Study,
    inventory: &Inventory,
    target: &Path,
    job: &Job,
    budget: Option<&Budget>,
) -> Result<OutputFolder, Problem> {
    let inputs = study
        .source
        .iter()
        .cloned()
        .chain(motion_paths(study))
        .chain([inventory.path.clone()]);
    let restraints = budget.map_or(&[][..], Budget::inputs);
    let looked_up = inventory
        .libraries
        .iter()
        .chain(&inventory.scans)
        .chain(restraints);
    let inputs = inputs.chain(looked_up.map(|file| file.path.clone()));
    let folder = OutputFolder::stage(target, job.force, &inputs.collect::<Vec<PathBuf>>())?
        .of_command(SCHEMA)?;
    folder.check(&OUTPUTS.map(str::to_owned))?;
    Ok(folder)
}

/// What the outputs of a run are made from, besides its results.
struct Run<'r> {
    study: &'r Study,
    inventory: &'r Inventory,
    head: &'r Head,
    job: &'r Job,
    key: &'r str,
    /// Where the ground motions of worlds are kept, in a merge: one that is stopped is repeated, not
    /// resumed.
    motions: Option<&'r Path>,
    beside: Beside<'r>,
}

/// Writes the outputs of a finished or interrupted run.
fn written(
    run: Run,
    target: &Path,
    folder: OutputFolder,
    mut portfolio: Portfolio,
    progress: Progress,
) -> Result<JobReport, Problems> {
    let Run {
        study,
        inventory,
        head,
        job,
        key,
        motions,
        beside,
    } = run;
    let settings = &study.assessment;
    let budget = beside.spending.map(Spending::budget);
    let plan = planned(beside.spending, study, motions, &mut portfolio, progress)?;
    // Where a run was stopped, objects that it did not reach would seem to be gone.
    let earlier = beside.earlier.filter(|_| !portfolio.interrupted);
    let inputs = inputs(study, inventory);
    let since = earlier.map(|earlier| earlier.since(&inputs, portfolio.rows()));
    let since = since.transpose()?;
    let wanted = Wanted {
        parquet: job.parquet,
        workbook: true,
        report: true,
        pages: settings.pages,
        plan: plan.as_ref(),
        lacks_plan: plan.is_none() && matches!(beside.spending, Some(Spending::Planned(_))),
        since: since.as_ref(),
        signing: job.signing,
    };
    let first = write_all(&folder, head, inventory, wanted, &mut portfolio.rows())?;
    if job.outcomes {
        let mut file = folder.begin(OUTCOMES_NAME)?;
        file.write(&outcomes_head()?)?;
        for rows in portfolio.outcomes() {
            file.write(&rows?)?;
        }
        file.finish()?;
    }
    if !portfolio.interrupted {
        match worlds_into(&folder, study, motions, &mut portfolio, progress) {
            Err(error) if error.is_stopped() && motions.is_none() => portfolio.interrupted = true,
            written => written?,
        }
    }
    if portfolio.interrupted {
        portfolio.keep_in(&folder)?;
    }
    let mut report = report(&portfolio, study, inventory, head, target).planned(plan);
    report.first = first;
    report.since = since;
    report.files = folder.names()?;
    report.files.push(MANIFEST.to_owned());
    report.files.sort_unstable();
    folder.write(
        MANIFEST,
        manifest(study, inventory, &report, key, budget, job.signing)?.as_bytes(),
    )?;
    report.removed = folder.commit()?.removed;
    report.files.retain(|name| !name.starts_with(PROGRESS));
    Ok(report)
}

/// The plan within a budget. A run that was stopped has none.
fn planned(
    spending: Option<Spending>,
    study: &Study,
    motions: Option<&Path>,
    portfolio: &mut Portfolio,
    progress: Progress,
) -> Result<Option<BudgetPlan>, Problems> {
    let Some(spending) = spending.filter(|_| !portfolio.interrupted) else {
        return Ok(None);
    };
    let worlds = match &portfolio.worlds {
        Some(worlds) => worlds.at_intensity(1.0),
        None => shake(study, motions, progress)?,
    };
    let rows = portfolio.rows();
    let asks_losses = matches!(spending, Spending::Priced(..));
    let priced = match spending
        .budget()
        .priced(study, worlds, rows, asks_losses, progress)
    {
        Err(error) if error.is_stopped() => {
            portfolio.interrupted = true;
            return Ok(None);
        }
        priced => priced?,
    };
    Ok(match spending {
        Spending::Planned(budget) => Some(budget.plan(priced, progress)),
        Spending::Priced(_, place) => {
            *place.borrow_mut() = Some(priced);
            None
        }
    })
}

/// Writes `worlds.csv`, with the worlds made anew where an earlier run assessed every object. A run
/// that was stopped has none: whoever stops a run does not wait for its motions.
fn worlds_into(
    folder: &OutputFolder,
    study: &Study,
    motions: Option<&Path>,
    portfolio: &mut Portfolio,
    progress: Progress,
) -> Result<(), Problems> {
    let lived = &portfolio.lived;
    let worlds = match portfolio.worlds.take() {
        Some(worlds) => worlds,
        None => shake(study, motions, progress)?,
    };
    let total = lived.worlds as usize;
    let go_on = |done: u32| match progress(Step::new(Stage::FloorMotions, done as usize, total)) {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(Problem::stopped().into()),
    };
    let written = write_worlds(folder, study, &worlds, lived, go_on);
    if written.as_ref().is_err_and(Problems::is_stopped) {
        // A part of the table must not pass for the whole.
        let path = folder.path_of(WORLDS_NAME)?;
        std::fs::remove_file(&path)
            .map_err(|error| io_problem(&path, "cannot remove an unfinished file", &error))?;
    }
    written
}

fn report(
    portfolio: &Portfolio,
    study: &Study,
    inventory: &Inventory,
    head: &Head,
    target: &Path,
) -> JobReport {
    JobReport {
        objects: inventory.items.len(),
        resumed: portfolio.resumed,
        computed: portfolio.computed,
        unsettled: portfolio.unsettled,
        worlds: portfolio.lived.worlds as usize,
        interrupted: portfolio.interrupted,
        decisions: ByName(
            Decision::ALL
                .map(Decision::name)
                .into_iter()
                .zip(portfolio.decisions)
                .collect(),
        ),
        tiers: portfolio.tiers,
        failed: portfolio.failed,
        histories: portfolio.histories,
        out: target.display().to_string(),
        files: Vec::new(),
        removed: Vec::new(),
        only_falling: portfolio.only_falling,
        first: Vec::new(),
        ..said(study, head)
    }
}

/// All inputs, and what outputs depend on besides the results.
fn inputs(study: &Study, inventory: &Inventory) -> serde_json::Value {
    let recorded: Vec<_> = study
        .ground
        .recorded(&study.levels)
        .map(|motion| json!({"name": motion.name, "sha256": motion.sha256}))
        .collect();
    json!({
        "inventory": {"name": file_name(&inventory.path), "sha256": inventory.sha256},
        "libraries": inventory.libraries.iter().map(input).collect::<Vec<_>>(),
        "scans": inventory.scans.iter().map(input).collect::<Vec<_>>(),
        "study": study.toml,
        "records": recorded,
        "motion_seed": study.ground.seed(),
        "draw_seed": study.assessment.seed,
        "pages": study.assessment.pages,
    })
}

/// Nothing here depends on how the run went: the same inputs give the same bytes, however often it
/// was stopped.
fn manifest(
    study: &Study,
    inventory: &Inventory,
    report: &JobReport,
    key: &str,
    budget: Option<&Budget>,
    signing: Signing,
) -> Result<String, Problem> {
    let body = json!({
        "version": env!("CARGO_PKG_VERSION"),
        "key": key,
        "complete": !report.interrupted,
        "objects": report.objects,
        "assessed": report.resumed + report.computed,
        "worlds": report.worlds,
        "decisions": report.decisions,
        "tiers": report.tiers,
        "failed": report.failed,
        "only_falling": report.only_falling,
        "first": report.first,
        "inputs": inputs(study, inventory),
        "budget": budget.map(Budget::told),
        "allow_recalled": signing.allows_recalled,
        "files": report.files,
    });
    document(SCHEMA, &body, &report.all_warnings())
}

fn input(file: &InputFile) -> serde_json::Value {
    json!({"name": file_name(&file.path), "sha256": file.sha256})
}

fn file_name(path: &Path) -> Option<String> {
    path.file_name()
        .map(|name| name.to_string_lossy().into_owned())
}

/// The report of a folder that is complete already; `None` where something is left to do.
fn finished(
    target: &Path,
    key: &str,
    study: &Study,
    inventory: &Inventory,
    job: &Job,
    head: &Head,
) -> Option<JobReport> {
    let manifest: serde_json::Value =
        serde_json::from_slice(&std::fs::read(target.join(MANIFEST)).ok()?).ok()?;
    let has = |name: &str, value: serde_json::Value| {
        manifest.get(name).is_some_and(|found| *found == value)
    };
    if !(has("schema", json!(SCHEMA))
        && has("key", json!(key))
        && has("complete", json!(true))
        && has("allow_recalled", json!(job.signing.allows_recalled))
        && has("inputs", inputs(study, inventory)))
    {
        return None;
    }
    let files: Vec<String> = serde_json::from_value(manifest.get("files")?.clone()).ok()?;
    let is_there = |name: &str| target.join(name).is_file();
    let wanted = [
        (job.parquet, "objects.parquet"),
        (job.outcomes, OUTCOMES_NAME),
    ];
    let has_all = wanted
        .iter()
        .all(|(is_wanted, name)| !is_wanted || files.iter().any(|file| file == name));
    if !files.iter().all(|name| is_there(name)) || !has_all {
        return None;
    }
    let decided = |one: &Decision| {
        let objects = manifest.get("decisions")?.get(one.name())?;
        Some((one.name(), serde_json::from_value(objects.clone()).ok()?))
    };
    let decisions: Option<Vec<(&'static str, usize)>> = Decision::ALL.iter().map(decided).collect();
    Some(JobReport {
        objects: inventory.items.len(),
        resumed: inventory.items.len(),
        computed: 0,
        unsettled: 0,
        worlds: serde_json::from_value(manifest.get("worlds")?.clone()).ok()?,
        interrupted: false,
        decisions: ByName(decisions?),
        tiers: serde_json::from_value(manifest.get("tiers")?.clone()).ok()?,
        failed: serde_json::from_value(manifest.get("failed")?.clone()).ok()?,
        histories: 0,
        out: target.display().to_string(),
        files,
        removed: Vec::new(),
        only_falling: serde_json::from_value(manifest.get("only_falling")?.clone()).ok()?,
        first: serde_json::from_value(manifest.get("first")?.clone()).ok()?,
        ..said(study, head)
    })
}
