//! The plan of an assessment in shards: a folder that holds everything a shard needs.

use std::collections::BTreeMap;
use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::files::{KeptFiles, absolute};
use super::{MOTIONS, OUT};
use freestand_assess::key::resume_key;
use freestand_assess::list::ListRequest;
use freestand_assess::store::part_size;
use freestand_input::file::{load, sha256_hex};
use freestand_input::problem::{Problem, ProblemKind, Problems};
use freestand_input::words::counted;
use freestand_inventory::{CellsRequest, Edit, Inventory, lines_of_items};
use freestand_output::folder::{OutputFolder, PLAN};
use freestand_output::json::document;
use freestand_output::paths::io_problem;
use freestand_report::assessment::{PlanReport, head, said};
use freestand_study::resolve::{Overrides, load as load_study, resolve_with};
use freestand_study::study::Study;

/// Schema of `plan.json`, and of the document of `freestand shard plan`.
pub const PLAN_SCHEMA: &str = "freestand.shard-plan/1";

/// Largest number of shards: what names with five digits can count.
const MAX_SHARDS: usize = 100_000;

const ANOTHER_FOLDER: &str = "name another folder with `out`";

/// Refuses a number of shards that a plan cannot have.
///
/// # Errors
/// None, or more than 100,000.
pub fn check_shards(shards: usize) -> Result<(), Problem> {
    if (1..=MAX_SHARDS).contains(&shards) {
        return Ok(());
    }
    let message = format!("`shards` must be a whole number from 1 to {MAX_SHARDS}, not {shards}");
    let hint = "take shards of some minutes of work: about 200 objects or more";
    Err(Problem::value(message, hint).of(&["shards"]))
}

/// What is planned.
#[derive(Debug, Clone, Copy)]
pub struct PlanRequest<'r> {
    /// The study, with its overrides.
    pub study: &'r Study,
    /// The seed that replaces those of the study, if any.
    pub seed: Option<u64>,
    /// The inventory.
    pub inventory: &'r Inventory,
    /// How it was read.
    pub list: &'r ListRequest,
    /// Number of shards, from 1 to 100,000.
    pub shards: usize,
    /// Whether `outcomes.csv` is written too.
    pub outcomes: bool,
}

/// `plan.json`.
#[derive(Debug, Clone, Serialize, Deserialize)]
struct PlanFile {
    /// Version of the program.
    version: String,
    /// Number of shards.
    shards: usize,
    /// Rows of the inventory.
    rows: usize,
    /// Rows that are assessed and stored together.
    part: usize,
    /// Whether `outcomes.csv` is written too.
    outcomes: bool,
    /// Hash of everything that results depend on.
    key: String,
    /// Hash of the study as it was resolved.
    study_key: String,
    study: PlannedStudy,
    inventory: PlannedList,
    /// All files, for the checks of output folders.
    files: Vec<String>,
    /// The hash of each file but this one, which the output folder adds.
    #[serde(default, skip_serializing)]
    files_sha256: BTreeMap<String, String>,
}

/// The study; paths are relative to the folder of the plan.
#[derive(Debug, Clone, Serialize, Deserialize)]
struct PlannedStudy {
    file: String,
    is_builtin: bool,
    place_is_assumed: bool,
    building_is_assumed: bool,
    seed: Option<u64>,
    pages: usize,
    library: Option<String>,
    cushion_library: Option<String>,
}

/// The inventory; paths are relative to the folder of the plan.
#[derive(Debug, Clone, Serialize, Deserialize)]
struct PlannedList {
    file: String,
    sha256: String,
    /// Where it was when the plan was made.
    original: PathBuf,
    sheet: Option<String>,
    columns: Option<String>,
    storeys: Option<usize>,
    is_strict: bool,
    assess_anchored: bool,
    /// Cells that are read otherwise, such as `D7=900 mm`.
    #[serde(default)]
    edits: Vec<String>,
}

/// A plan on disk.
#[derive(Debug)]
pub(super) struct Plan {
    dir: PathBuf,
    file: PlanFile,
    /// Of the bytes of `plan.json`.
    sha256: String,
}

/// Divides an assessment into shards: writes everything that they need into the folder `dir`. A folder
/// that has the same plan is left as it is.
///
/// # Errors
/// A number of shards that is out of range, a folder with another plan, with results, or with files that
/// freestand did not write, or a file of the study that cannot be copied.
pub fn plan_shards(request: &PlanRequest, dir: &Path, force: bool) -> Result<PlanReport, Problems> {
    let PlanRequest {
        study,
        inventory,
        shards,
        ..
    } = *request;
    check_shards(shards)?;
    let rows = inventory.items.len();
    let head = head(study, inventory);
    let said = said(study, &head);
    let report = PlanReport {
        out: dir.display().to_string(),
        shards,
        rows,
        rows_most: rows.div_ceil(shards),
        was_planned: false,
        no_study: said.no_study,
        place: said.place,
        problems: said.problems,
        warnings: said.warnings,
    };
    let key = plan_key(request);
    // What was killed while it was written is written again.
    if let Some(found) = fs::read(dir.join(PLAN))
        .ok()
        .and_then(|bytes| parsed(&bytes))
    {
        if found.key == key {
            return Ok(PlanReport {
                was_planned: true,
                ..report
            });
        }
        let another = Problem::new(ProblemKind::Io, "the folder has another plan");
        return Err(another.in_file(dir).hint(ANOTHER_FOLDER).into());
    }
    for name in [OUT, MOTIONS] {
        if dir.join(name).exists() {
            let message =
                format!("the folder has results of shards ({name}), but no complete plan");
            return Err(Problem::new(ProblemKind::Io, message)
                .in_file(dir)
                .hint(ANOTHER_FOLDER)
                .into());
        }
    }
    write(request, key, dir, force)?;
    Ok(report)
}

/// Everything that the outputs depend on.
fn plan_key(request: &PlanRequest) -> String {
    let PlanRequest {
        study,
        seed,
        inventory,
        shards,
        outcomes,
        list: _,
    } = *request;
    let of_results = resume_key(study, inventory, part_size(study, inventory));
    let toml = sha256_hex(study.toml.as_bytes());
    sha256_hex(
        format!(
            "{of_results} {toml} {seed:?} {shards} {outcomes} {}",
            study.assessment.pages
        )
        .as_bytes(),
    )
}

fn write(request: &PlanRequest, key: String, dir: &Path, force: bool) -> Result<(), Problems> {
    let PlanRequest {
        study,
        seed,
        inventory,
        list,
        shards,
        outcomes,
    } = *request;
    let kept = KeptFiles::of(
        study,
        [inventory.path.clone()]
            .into_iter()
            .chain(list.cells.columns.clone())
            .chain(inventory.scans.iter().map(|file| file.path.clone())),
    )?;
    let inputs: Vec<PathBuf> = kept.files().cloned().collect();
    let folder = OutputFolder::stage(dir, force, &inputs)?.of_command(PLAN_SCHEMA)?;
    let text = kept.relocated(study)?;
    kept.write(&folder, (study.source.as_deref(), &text))?;
    let name = |path: &Option<PathBuf>| path.as_deref().map(|path| kept.name(path)).transpose();
    let settings = &study.assessment;
    let planned = PlannedStudy {
        file: kept.study_name(study.source.as_deref())?,
        is_builtin: study.is_builtin,
        place_is_assumed: study.place_is_assumed,
        building_is_assumed: study.building_is_assumed,
        seed,
        pages: settings.pages,
        library: name(&settings.library)?,
        cushion_library: name(&settings.cushion_library)?,
    };
    let file = kept.name(&inventory.path)?;
    if sha256_hex(&load(&folder.path_of(&file)?)?) != inventory.sha256 {
        let message = "was changed while the plan was made";
        return Err(Problem::new(ProblemKind::Io, message)
            .in_file(&inventory.path)
            .hint("plan again")
            .into());
    }
    // Now the copies are read as a shard will read them: they have to give the same study.
    let staged = folder.path_of(PLAN)?;
    let again = planned.load(staged.parent().unwrap_or(dir))?;
    let part = part_size(study, inventory);
    let as_written = Study {
        toml: study.toml.clone(),
        ..again.clone()
    };
    if resume_key(&as_written, inventory, part) != resume_key(study, inventory, part) {
        let message = "the files of the study cannot be copied so that they give the same study";
        let hint = "put the study and the files that it names into one folder, with relative paths";
        return Err(Problem::new(ProblemKind::Io, message).hint(hint).into());
    }
    for shard in 0..shards {
        let items = inventory
            .items
            .get(rows_of(shard, shards, inventory.items.len()))
            .unwrap_or_default();
        folder.write(&input_name(shard), &lines_of_items(items)?)?;
    }
    let plan = PlanFile {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        shards,
        rows: inventory.items.len(),
        part,
        outcomes,
        key,
        study_key: study_key(&again),
        study: planned,
        inventory: PlannedList {
            file,
            sha256: inventory.sha256.clone(),
            original: absolute(&inventory.path)?,
            sheet: list.cells.sheet.clone(),
            columns: name(&list.cells.columns)?,
            storeys: list.storeys,
            is_strict: list.is_strict,
            assess_anchored: list.assess_anchored,
            edits: list.cells.edits.iter().map(Edit::to_string).collect(),
        },
        files: folder
            .names()?
            .into_iter()
            .chain([PLAN.to_owned()])
            .collect(),
        files_sha256: BTreeMap::new(),
    };
    folder.write(PLAN, document(PLAN_SCHEMA, &plan, &[])?.as_bytes())?;
    folder.commit()?;
    Ok(())
}

/// The key of a study, whatever the list.
fn study_key(study: &Study) -> String {
    let nothing = Inventory {
        path: PathBuf::new(),
        sha256: String::new(),
        sheet: None,
        carried: Vec::new(),
        items: Vec::new(),
        libraries: Vec::new(),
        scans: Vec::new(),
        read_with: String::new(),
        findings: Vec::new(),
        warnings: Vec::new(),
        units: Default::default(),
    };
    resume_key(study, &nothing, part_size(study, &nothing))
}

fn input_name(shard: usize) -> String {
    format!("in/{shard:05}.jsonl")
}

/// The rows of a shard: shards differ by at most one row.
fn rows_of(shard: usize, shards: usize, rows: usize) -> Range<usize> {
    shard * rows / shards..(shard + 1) * rows / shards
}

fn parsed(bytes: &[u8]) -> Option<PlanFile> {
    let value: serde_json::Value = serde_json::from_slice(bytes).ok()?;
    let is_plan = value
        .get("schema")
        .is_some_and(|schema| schema == PLAN_SCHEMA);
    let plan: PlanFile = serde_json::from_value(value).ok().filter(|_| is_plan)?;
    (1..=MAX_SHARDS).contains(&plan.shards).then_some(plan)
}

impl PlannedStudy {
    /// The study from the folder of a plan.
    fn load(&self, dir: &Path) -> Result<Study, Problems> {
        let overrides = Overrides {
            seed: self.seed,
            ..Overrides::default()
        };
        let path = dir.join(&self.file);
        let mut study = if self.is_builtin {
            let text = fs::read_to_string(&path)
                .map_err(|error| io_problem(&path, "cannot read the study", &error))?;
            Study {
                is_builtin: true,
                ..resolve_with(&text, None, Path::new(""), &overrides)?
            }
        } else {
            load_study(&path, &overrides)?
        };
        // The copies hold the built-in study where nobody stated anything.
        (study.place_is_assumed, study.building_is_assumed) =
            (self.place_is_assumed, self.building_is_assumed);
        let settings = &mut study.assessment;
        settings.seed = self.seed.unwrap_or(settings.seed);
        settings.pages = self.pages;
        settings.library = self.library.as_ref().map(|name| dir.join(name));
        settings.cushion_library = self.cushion_library.as_ref().map(|name| dir.join(name));
        Ok(study)
    }
}

impl Plan {
    /// The plan in a folder.
    ///
    /// # Errors
    /// A folder without a plan, or with one of another version of freestand.
    pub(super) fn open(dir: &Path) -> Result<Self, Problem> {
        let no_plan = |what: &str| {
            Problem::new(ProblemKind::Io, what.to_owned())
                .in_file(dir)
                .hint("name the folder of a plan; freestand shard plan makes one")
        };
        let path = dir.join(PLAN);
        if !path.is_file() {
            return Err(no_plan(
                "is not the folder of a plan: there is no plan.json",
            ));
        }
        let bytes = load(&path)?;
        let file = parsed(&bytes)
            .ok_or_else(|| no_plan("plan.json is not a plan of freestand, or is damaged"))?;
        let ours = env!("CARGO_PKG_VERSION");
        if file.version != ours {
            let message = format!(
                "was planned by freestand {}, and this is {ours}",
                file.version
            );
            let hint = "use the version of the plan, or plan again into another folder";
            return Err(Problem::new(ProblemKind::Value, message)
                .in_file(dir)
                .hint(hint));
        }
        Ok(Self {
            dir: dir.to_path_buf(),
            file,
            sha256: sha256_hex(&bytes),
        })
    }

    /// Number of shards.
    pub(super) fn shards(&self) -> usize {
        self.file.shards
    }

    pub(super) fn dir(&self) -> &Path {
        &self.dir
    }

    pub(super) fn sha256(&self) -> &str {
        &self.sha256
    }

    pub(super) fn part(&self) -> usize {
        self.file.part.max(1)
    }

    pub(super) fn rows(&self) -> usize {
        self.file.rows
    }

    pub(super) fn outcomes(&self) -> bool {
        self.file.outcomes
    }

    /// The rows of a shard, counted from 0.
    pub(super) fn rows_of(&self, shard: usize) -> Result<Range<usize>, Problem> {
        let shards = self.file.shards;
        if shard >= shards {
            let message = format!("`shard` must be from 0 to {}, not {shard}", shards - 1);
            let hint = format!("the plan has {}, counted from 0", counted(shards, "shard"));
            return Err(Problem::value(message, hint).of(&["shard"]));
        }
        Ok(rows_of(shard, shards, self.file.rows))
    }

    /// The file with the rows of a shard.
    pub(super) fn input(&self, shard: usize) -> PathBuf {
        self.dir.join(input_name(shard))
    }

    pub(super) fn input_sha256(&self, shard: usize) -> Result<String, Problem> {
        let hash = self.file.files_sha256.get(&input_name(shard));
        hash.cloned()
            .ok_or_else(|| self.changed(&self.dir.join(PLAN)))
    }

    /// The study, read from its copies.
    pub(super) fn study(&self) -> Result<Study, Problems> {
        let study = self.file.study.load(&self.dir)?;
        if study_key(&study) == self.file.study_key {
            return Ok(study);
        }
        let is_changed = |(name, hash): (&String, &String)| {
            let path = self.dir.join(name);
            let found = fs::read(&path).ok().map(|bytes| sha256_hex(&bytes));
            (found.as_ref() != Some(hash)).then_some(path)
        };
        let changed = self.file.files_sha256.iter().find_map(is_changed);
        Err(self
            .changed(&changed.unwrap_or_else(|| self.dir.clone()))
            .into())
    }

    /// The copy of the inventory, and how it is read.
    pub(super) fn list(&self) -> Result<(PathBuf, ListRequest), Problem> {
        let PlannedList {
            file,
            sheet,
            columns,
            storeys,
            is_strict,
            assess_anchored,
            edits,
            sha256: _,
            original: _,
        } = &self.file.inventory;
        let edits = edits
            .iter()
            .map(|edit| Edit::parse(edit))
            .collect::<Result<_, _>>()?;
        let request = ListRequest {
            cells: CellsRequest {
                sheet: sheet.clone(),
                columns: columns.as_ref().map(|name| self.dir.join(name)),
                edits,
            },
            storeys: *storeys,
            is_strict: *is_strict,
            assess_anchored: *assess_anchored,
        };
        Ok((self.dir.join(file), request))
    }

    /// Refuses a copy of the inventory that was changed.
    pub(super) fn check_list(&self, inventory: &Inventory) -> Result<(), Problem> {
        let is_same = inventory.sha256 == self.file.inventory.sha256
            && inventory.items.len() == self.file.rows;
        if is_same {
            Ok(())
        } else {
            Err(self.changed(&inventory.path))
        }
    }

    /// Refuses results for an inventory that was changed after the plan. One that is no longer there, or
    /// cannot be seen from this machine, is not compared.
    pub(super) fn check_original(&self) -> Result<(), Problem> {
        let PlannedList {
            original,
            sha256,
            file,
            ..
        } = &self.file.inventory;
        match fs::read(original) {
            Ok(bytes) if sha256_hex(&bytes) != *sha256 => {
                let hint = format!(
                    "plan again into another folder, or put the list as it was planned back: it is in {}",
                    self.dir.join(file).display()
                );
                Err(
                    Problem::new(ProblemKind::Io, "was changed after the shards were planned")
                        .in_file(original)
                        .hint(hint),
                )
            }
            _ => Ok(()),
        }
    }

    /// The problem of a file of the plan that is not as it was written.
    pub(super) fn changed(&self, path: &Path) -> Problem {
        Problem::new(
            ProblemKind::Io,
            "is not as it was planned: it was changed, or is damaged",
        )
        .in_file(path)
        .hint("plan again into another folder")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every row is in one shard, in order, and shards differ by at most one row.
    #[test]
    fn shards_divide_the_rows() {
        for (rows, shards) in [(30, 1), (30, 7), (30, 64), (1, 3), (1_000_000, 99_999)] {
            let ranges: Vec<Range<usize>> = (0..shards)
                .map(|shard| rows_of(shard, shards, rows))
                .collect();
            assert_eq!((ranges[0].start, ranges[shards - 1].end), (0, rows));
            assert!(ranges.windows(2).all(|pair| pair[0].end == pair[1].start));
            let most = ranges.iter().map(ExactSizeIterator::len).max().unwrap();
            assert_eq!(most, rows.div_ceil(shards));
            assert!(ranges.iter().all(|range| range.len() + 1 >= most));
        }
    }
}
