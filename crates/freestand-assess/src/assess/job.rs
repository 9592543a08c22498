//! The whole job: an inventory in, a folder of results out, that survives being stopped or killed at any moment.

use std::path::{Path, PathBuf};

use serde::Serialize;
use serde_json::json;

use super::outputs::{Wanted, write_all};
use super::portfolio::{Portfolio, assess, fingerprint, progress_names};
use super::result::Decision;
use super::{Head, PROGRESS, head};
use crate::inventory::{Inventory, read_inventory};
use crate::library::Libraries;
use crate::library::Lookup;
use freestand_input::file::InputFile;
use freestand_input::problem::{Problem, ProblemKind, Problems};
use freestand_output::folder::{MANIFEST, OutputFolder, announce};
use freestand_output::json::document;
use freestand_study::resolve::motion_paths;
use freestand_study::run::Progress;
use freestand_study::study::Study;

/// Schema of `manifest.json` and of the document of `freestand assess`.
pub const SCHEMA: &str = "freestand.assess/1";

/// The files of a job, those on demand among them.
const OUTPUTS: [&str; 5] = ["objects.csv", "objects.parquet", "report.html", "assessment.xlsx", MANIFEST];

/// What is wanted beside the results themselves.
#[derive(Debug, Clone, Copy, Default)]
pub struct Job {
    /// Go on from the finished parts of an earlier run.
    pub resume: bool,
    /// Write into a folder that holds other files.
    pub force: bool,
    /// `objects.parquet` too.
    pub parquet: bool,
}

/// What a job came to; the keys of the JSON document.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct JobReport {
    /// Rows of the inventory.
    pub objects: usize,
    /// Those that an earlier run had finished.
    pub resumed: usize,
    /// Those that were assessed now.
    pub computed: usize,
    /// Whether it was stopped before its end: go on with `--resume`.
    pub interrupted: bool,
    /// Objects by decision.
    pub decisions: serde_json::Value,
    /// Objects by the tier that decided.
    pub tiers: [usize; 4],
    /// Objects of which some motion could not be followed.
    pub failed: usize,
    /// Rocking histories that were followed now.
    pub histories: u64,
    /// The folder.
    pub out: String,
    /// The files in it.
    pub files: Vec<String>,
    /// What the reader must know.
    #[serde(skip)]
    pub warnings: Vec<String>,
}

/// Reads the inventory of a study, or another one, with the libraries that the study names.
///
/// # Errors
/// No inventory, a library or an inventory that cannot be read; all problems of it at once.
pub fn inventory_of(study: &Study, path: Option<&Path>, sheet: Option<&str>) -> Result<Inventory, Problems> {
    let settings = &study.assessment;
    let Some(path) = path.or(settings.inventory.as_deref()) else {
        return Err(Problem::new(ProblemKind::Value, "no inventory: nothing to assess")
            .hint("name one with --inventory FILE, or in the study: [assessment] inventory = \"objects.csv\"; freestand inventory template prints one")
            .into());
    };
    let libraries = Libraries::with_files(settings.library.as_deref(), settings.cushion_library.as_deref())?;
    let read = |lookup: &Lookup| read_inventory(path, sheet.or(settings.sheet.as_deref()), lookup);
    let mut inventory = libraries.looked_up(read)?;
    let Libraries { tolerances, cushions } = libraries;
    inventory.libraries = tolerances.inputs.into_iter().chain(cushions.inputs).collect();
    inventory.warnings.extend(tolerances.warnings.into_iter().chain(cushions.warnings));
    Ok(inventory)
}

/// Assesses `inventory` on the floors of `study` and writes everything into `target`, on the current thread pool.
///
/// Finished parts stand in `progress/` of the folder until all is done: a run that was stopped leaves them beside valid outputs of what was
/// finished, one that was killed leaves them alone; with [`Job::resume`] either goes on, and writes the bytes of a run that was not stopped.
///
/// # Errors
/// A motion that cannot be made, a folder that cannot be written or is not ours.
pub fn assess_into(
    study: &Study,
    inventory: &Inventory,
    target: &Path,
    job: &Job,
    progress: Progress,
) -> Result<JobReport, Problems> {
    let key = fingerprint(study, inventory);
    let head = head(study, inventory);
    if job.resume
        && let Some(report) = finished(target, &key, (study, inventory), job)
    {
        return Ok(report);
    }
    let names = progress_names(inventory.items.len());
    announce(target, job.force, &names)?;
    let inputs = study.source.iter().cloned().chain(motion_paths(study)).chain([inventory.path.clone()]);
    let inputs = inputs.chain(inventory.libraries.iter().map(|file| file.path.clone()));
    let folder = OutputFolder::stage(target, job.force, &inputs.collect::<Vec<PathBuf>>())?;
    folder.check(&OUTPUTS.map(str::to_owned))?;
    let portfolio = assess(study, inventory, (&target.join(PROGRESS), &key), job.resume, progress)?;
    let settings = &study.assessment;
    let wanted = Wanted { parquet: job.parquet, workbook: true, report: true, pages: settings.pages };
    write_all(&folder, &head, inventory, wanted, &mut portfolio.rows())?;
    if portfolio.interrupted {
        portfolio.keep_in(&folder)?;
    }
    let mut report = report(&portfolio, inventory, &head, target);
    report.files = folder.names()?;
    report.files.push(MANIFEST.to_owned());
    report.files.sort_unstable();
    folder.write(MANIFEST, manifest(study, inventory, &report, &key)?.as_bytes())?;
    folder.commit()?;
    report.files.retain(|name| !name.starts_with(PROGRESS));
    Ok(report)
}

fn report(portfolio: &Portfolio, inventory: &Inventory, head: &Head, target: &Path) -> JobReport {
    JobReport {
        objects: inventory.items.len(),
        resumed: portfolio.resumed,
        computed: portfolio.computed,
        interrupted: portfolio.interrupted,
        decisions: Decision::ALL
            .iter()
            .zip(portfolio.decisions)
            .map(|(one, n)| (one.name().to_owned(), json!(n)))
            .collect(),
        tiers: portfolio.tiers,
        failed: portfolio.failed,
        histories: portfolio.histories,
        out: target.display().to_string(),
        files: Vec::new(),
        warnings: head.warnings.clone(),
    }
}

/// Everything that was read, and what outputs depend on beside the results.
fn inputs(study: &Study, inventory: &Inventory) -> serde_json::Value {
    let recorded: Vec<_> = study
        .ground
        .recorded(&study.levels)
        .map(|motion| json!({"name": motion.name, "sha256": motion.sha256}))
        .collect();
    json!({
        "inventory": {"name": file_name(&inventory.path), "sha256": inventory.sha256},
        "libraries": inventory.libraries.iter().map(input).collect::<Vec<_>>(),
        "study": study.toml,
        "records": recorded,
        "motion_seed": study.ground.seed(),
        "draw_seed": study.assessment.seed,
        "pages": study.assessment.pages,
    })
}

/// What does not hang on how the run went: the same inputs give the same bytes, however often it was stopped.
fn manifest(study: &Study, inventory: &Inventory, report: &JobReport, key: &str) -> Result<String, Problem> {
    let body = json!({
        "version": env!("CARGO_PKG_VERSION"),
        "key": key,
        "complete": !report.interrupted,
        "objects": report.objects,
        "assessed": report.resumed + report.computed,
        "decisions": report.decisions,
        "tiers": report.tiers,
        "failed": report.failed,
        "inputs": inputs(study, inventory),
        "files": report.files,
    });
    document(SCHEMA, &body, &report.warnings)
}

fn input(file: &InputFile) -> serde_json::Value {
    json!({"name": file_name(&file.path), "sha256": file.sha256})
}

fn file_name(path: &Path) -> Option<String> {
    path.file_name().map(|name| name.to_string_lossy().into_owned())
}

/// A folder in which all of this was done before; `None` where something is left to do.
fn finished(target: &Path, key: &str, (study, inventory): (&Study, &Inventory), job: &Job) -> Option<JobReport> {
    let manifest: serde_json::Value = serde_json::from_slice(&std::fs::read(target.join(MANIFEST)).ok()?).ok()?;
    let has = |name: &str, value: serde_json::Value| manifest.get(name).is_some_and(|found| *found == value);
    if !(has("schema", json!(SCHEMA))
        && has("key", json!(key))
        && has("complete", json!(true))
        && has("inputs", inputs(study, inventory)))
    {
        return None;
    }
    let files: Vec<String> = serde_json::from_value(manifest.get("files")?.clone()).ok()?;
    let is_there = |name: &str| target.join(name).is_file();
    if !files.iter().all(|name| is_there(name)) || (job.parquet && !is_there("objects.parquet")) {
        return None;
    }
    Some(JobReport {
        objects: inventory.items.len(),
        resumed: inventory.items.len(),
        computed: 0,
        interrupted: false,
        decisions: manifest.get("decisions")?.clone(),
        tiers: serde_json::from_value(manifest.get("tiers")?.clone()).ok()?,
        failed: serde_json::from_value(manifest.get("failed")?.clone()).ok()?,
        histories: 0,
        out: target.display().to_string(),
        files,
        warnings: serde_json::from_value(manifest.get("warnings")?.clone()).ok()?,
    })
}
