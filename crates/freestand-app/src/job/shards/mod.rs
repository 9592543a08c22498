//! An assessment in shards: a plan divides the rows of an inventory, each shard is assessed by a
//! process of its own, on any machine that sees the folder of the plan, and a merge writes what one
//! process would have written.
//!
//! The parts of a shard are the parts of any run (`freestand_assess::store`), in the folder of the plan. A merge is a run
//! whose parts are all there.

mod files;
mod plan;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

use serde::{Deserialize, Serialize};

use super::{Beside, Job, Run, staged, written};
use freestand_assess::key::resume_key;
use freestand_assess::list::inventory_of;
use freestand_assess::portfolio::{Assessed, Assessor, Keep, PartState, Tell, Watch, assess};
use freestand_assess::store::{Part, Store, part_size};
use freestand_assess::two_spectra::refuse_outcomes;
use freestand_input::file::sha256_hex;
use freestand_input::problem::{Problem, ProblemKind, Problems};
use freestand_inventory::{Inventory, Item, items_from_lines};
use freestand_output::answer;
use freestand_output::folder::write_file;
use freestand_output::json::document;
use freestand_output::paths::io_problem;
use freestand_report::assessment::{JobReport, head, outcomes_rows};
use freestand_report::signature::Signing;
use freestand_study::run::{Progress, Step};

use plan::Plan;
pub use plan::{PLAN_SCHEMA, PlanRequest, check_shards, plan_shards};

/// Schema of the file of a finished shard, and of the document of `freestand shard run`.
pub const SHARD_SCHEMA: &str = "freestand.shard/1";

/// The folder of the results of shards.
const OUT: &str = "out";

/// The folder of the ground motions of worlds.
const MOTIONS: &str = "motions";

answer! {
    /// A finished shard; its fields are the keys of the JSON document.
    #[derive(Deserialize)]
    pub struct ShardReport {
        /// Its number, counted from 0.
        index: usize,
        /// Its rows.
        rows: usize,
        /// SHA-256 of its rows as they were planned.
        input_sha256: String,
        /// SHA-256 of its results.
        sha256: String,
        /// Time that the run which finished it took.
        seconds: f64,
        /// Rocking histories that that run computed.
        histories: u64,
        /// Objects with a history that failed.
        failed: usize,
        /// Whether it was finished before this run began.
        was_finished: bool,
    }
}

/// A finished shard, as it is on disk.
#[derive(Debug, Serialize, Deserialize)]
struct Finished {
    /// SHA-256 of the plan.
    plan_sha256: String,
    #[serde(flatten)]
    report: ShardReport,
    /// The files of the shard with their SHA-256.
    files: BTreeMap<String, String>,
}

/// What a merge came to.
#[derive(Debug)]
pub enum Merged {
    /// The outputs are written.
    Done(Box<(JobReport, Inventory)>),
    /// These shards are not finished; nothing was written.
    Missing(Vec<usize>),
}

/// Assesses the objects of a shard, on the current thread pool. A shard that is finished and intact
/// is left as it is; what an earlier run left of it is used.
///
/// # Errors
/// A folder without a plan, a plan of another version, a number that the plan does not have, files that
/// were changed after it, a motion that cannot be generated, a disk that is full, or a stop: what was
/// finished stays.
pub fn run_shard(dir: &Path, index: usize, progress: Progress) -> Result<ShardReport, Problems> {
    let plan = Plan::open(dir)?;
    let rows = plan.rows_of(index)?;
    let input_sha256 = plan.input_sha256(index)?;
    let out = dir.join(OUT);
    let parts = Part::of_shard(index, rows.clone(), plan.part());
    let earlier = finished(&plan, index);
    if let Some(found) = earlier
        .as_ref()
        .filter(|found| is_intact(&out, found, &parts))
    {
        return Ok(ShardReport {
            was_finished: true,
            ..found.report.clone()
        });
    }
    plan.check_original()?;
    let begin = Instant::now();
    let items = items(&plan, index, &input_sha256, rows.len())?;
    // A part that is not as it was written is computed again.
    for (name, hash) in earlier.iter().flat_map(|found| &found.files) {
        if hash_of(&out.join(name)).is_some_and(|found| found != *hash) {
            let path = out.join(name);
            fs::remove_file(&path)
                .map_err(|error| io_problem(&path, "cannot remove a damaged file", &error))?;
        }
    }
    let study = plan.study()?;
    let store = Store::of_shards(&out)?;
    let motions = dir.join(MOTIONS);
    let wants_to_stop = || progress(Step::asks()).is_break();
    let watch = Watch::new(&study, &items, None, progress);
    let alternative = study.alternative();
    refuse_outcomes(plan.outcomes(), alternative.as_ref())?;
    let keep = Keep {
        outcomes: plan.outcomes().then_some(outcomes_rows),
        motions: Some(&motions),
    };
    let mut assessor = Assessor::new(&study, plan.rows(), keep, &wants_to_stop, &watch)
        .beside(alternative.as_ref());
    let mut failed = 0;
    for part in &parts {
        let done = part.rows.start - rows.start;
        let items = items
            .get(done..part.rows.end - rows.start)
            .unwrap_or_default();
        let Assessed { found, state } = assessor.part(&store, part, items, progress)?;
        if state == PartState::Stopped || wants_to_stop() {
            return Err(Problem::stopped().into());
        }
        failed += found
            .iter()
            .filter(|one| one.has_failed_histories())
            .count();
    }
    let mut files = BTreeMap::new();
    for name in names(&plan, &parts) {
        let hash = hash_of(&out.join(&name)).ok_or_else(|| {
            Problem::new(ProblemKind::Io, "disappeared while the shard was computed")
                .in_file(&out.join(&name))
                .hint("run the shard again")
        })?;
        files.insert(name, hash);
    }
    let all: String = files.values().map(|hash| format!("{hash}\n")).collect();
    let report = ShardReport {
        index,
        rows: rows.len(),
        input_sha256,
        sha256: sha256_hex(all.as_bytes()),
        seconds: begin.elapsed().as_secs_f64(),
        histories: assessor.histories(),
        failed,
        was_finished: false,
    };
    let done = Finished {
        plan_sha256: plan.sha256().to_owned(),
        report,
        files,
    };
    let text = document(SHARD_SCHEMA, &done, &[])?;
    write_file(&out.join(finished_name(index)), text.as_bytes(), &[])?;
    Ok(done.report)
}

/// Writes the outputs of a planned assessment into `target`, as
/// [`assess_into`](super::assess_into) would have written them, once all shards are finished.
///
/// # Errors
/// As [`run_shard`] and [`assess_into`](super::assess_into). A stop leaves `target` as it was.
pub fn merge_shards(
    dir: &Path,
    target: &Path,
    force: bool,
    signing: Signing,
    progress: Progress,
) -> Result<Merged, Problems> {
    let plan = Plan::open(dir)?;
    let out = dir.join(OUT);
    let (mut missing, mut parts, mut histories) = (Vec::new(), Vec::new(), 0);
    for index in 0..plan.shards() {
        let of_shard = Part::of_shard(index, plan.rows_of(index)?, plan.part());
        match finished(&plan, index).filter(|found| is_intact(&out, found, &of_shard)) {
            Some(found) => {
                histories += found.report.histories;
                parts.extend(of_shard);
            }
            None => missing.push(index),
        }
    }
    if !missing.is_empty() {
        return Ok(Merged::Missing(missing));
    }
    plan.check_original()?;
    let study = plan.study()?;
    let (path, request) = plan.list()?;
    let inventory = inventory_of(&study, Some(&path), &request)?;
    plan.check_list(&inventory)?;
    let job = Job {
        resume: false,
        force,
        parquet: true,
        outcomes: plan.outcomes(),
        signing,
    };
    let key = resume_key(&study, &inventory, part_size(&study, &inventory));
    let head = head(&study, &inventory);
    let folder = staged(&study, &inventory, target, &job, None)?;
    let motions = dir.join(MOTIONS);
    let store = Store::of_shards(&out)?;
    let keep = Keep {
        outcomes: job.outcomes.then_some(outcomes_rows),
        motions: Some(&motions),
    };
    let portfolio = assess(
        &study,
        &inventory,
        store,
        parts,
        keep,
        Tell::default(),
        progress,
    )?;
    if portfolio.interrupted {
        return Err(Problem::stopped().into());
    }
    let run = Run {
        study: &study,
        inventory: &inventory,
        head: &head,
        job: &job,
        key: &key,
        motions: Some(&motions),
        beside: Beside::default(),
    };
    let mut report = written(run, target, folder, portfolio, progress)?;
    // The shards did the work of this assessment.
    report.histories += histories;
    report.computed += std::mem::take(&mut report.resumed);
    Ok(Merged::Done(Box::new((report, inventory))))
}

/// The files of a shard in these parts.
fn names<'p>(plan: &Plan, parts: &'p [Part]) -> impl Iterator<Item = String> + 'p {
    let has_outcomes = plan.outcomes();
    parts.iter().flat_map(move |part| {
        [
            Some(part.results_name()),
            has_outcomes.then(|| part.outcomes_name()),
        ]
        .into_iter()
        .flatten()
    })
}

fn finished_name(index: usize) -> String {
    format!("{index:05}.json")
}

/// What the file of a finished shard says; `None` where there is none of this plan.
fn finished(plan: &Plan, index: usize) -> Option<Finished> {
    let bytes = fs::read(plan.dir().join(OUT).join(finished_name(index))).ok()?;
    let found: Finished = serde_json::from_slice(&bytes).ok()?;
    (found.plan_sha256 == plan.sha256()
        && found.report.index == index
        && plan
            .input_sha256(index)
            .is_ok_and(|hash| hash == found.report.input_sha256))
    .then_some(found)
}

/// Whether all files of a shard are there, as they were written.
fn is_intact(out: &Path, found: &Finished, parts: &[Part]) -> bool {
    let has = |name: &String| found.files.contains_key(name);
    parts.iter().map(Part::results_name).all(|name| has(&name))
        && found
            .files
            .iter()
            .all(|(name, hash)| hash_of(&out.join(name)).as_ref() == Some(hash))
}

fn hash_of(path: &Path) -> Option<String> {
    fs::read(path).ok().map(|bytes| sha256_hex(&bytes))
}

/// The rows of a shard as they were planned.
fn items(plan: &Plan, index: usize, sha256: &str, rows: usize) -> Result<Vec<Item>, Problem> {
    let path: PathBuf = plan.input(index);
    let bytes = fs::read(&path)
        .map_err(|error| io_problem(&path, "cannot read the rows of the shard", &error))?;
    let is_same = sha256_hex(&bytes) == sha256;
    let items = items_from_lines(&bytes).filter(|items| is_same && items.len() == rows);
    items.ok_or_else(|| plan.changed(&path))
}
