//! Resolves a study: fills in defaults, checks everything and loads files; reports all problems at
//! once.

mod assessment;
mod assumed;
mod building;
mod cushion;
mod ground;
mod ground_keys;
mod hazard;
mod objects;
mod outputs;
mod recorded;
mod simulated;
mod suite;

use std::path::{Path, PathBuf};

use crate::building::GivenStoreys;
use crate::options::{self, Change, GroundOptions, Options};
use crate::recorded::{MotionFiles, ReadMotion};
use crate::study::{BuildingInput, Ground, RecordedMotion, Study, StudyDoubt};
use crate::target::{Target, period_code};
use building::WithStoreys;
use freestand_input::file::{file_name, load_up_to};
use freestand_input::keys::{KeyStyle, Words};
use freestand_input::problem::{Problem, ProblemKind, Problems};
use freestand_input::quantity::{Dimension, format_si};
use freestand_input::toml_reader::Written;
use freestand_records::notes::{Note, grouped};

use recorded::has_measured_floors;

/// Largest number of synthetic motions in a study.
pub const MAX_MOTIONS: u64 = 1000;
/// Largest number of objects in a study's grid.
pub const MAX_OBJECTS: usize = 1_000_000;
/// Largest number of levels in a study.
pub const MAX_LEVELS: usize = 100;

/// Values that take precedence over those of the study.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Overrides {
    /// Seed of the synthetic motions.
    pub seed: Option<u64>,
    /// Keys of `[ground]` that describe the hazard: `place`, `site`, `return_period_years`. A place
    /// replaces the study's code with everything that belongs to it; its return period stays, and its
    /// site where the code is the same.
    pub hazard: Words,
    /// Number of storeys, where the study does not state its building; it then has no name from the
    /// built-in study either.
    pub storeys: Option<u16>,
    /// Height of one of these storeys \[m\].
    pub storey_height_m: Option<f64>,
    /// Files that replace the study's ground motions, which are then not read.
    pub motions: Option<MotionFiles>,
    /// Step between the directions in which objects are tried, for motions with two components
    /// \[degrees\].
    pub rotation_step_deg: Option<f64>,
    /// One value in place of the study's.
    pub change: Option<Change>,
}

/// The built-in study as TOML, with comments.
pub fn builtin_toml() -> &'static str {
    include_str!("../builtin.toml")
}

/// The built-in study.
///
/// # Errors
/// Without overrides, none; with them, the errors of the motion files.
pub fn builtin(overrides: &Overrides) -> Result<Study, Problems> {
    resolve_as(Text::Builtin, None, Path::new(""), overrides)
}

/// A study that nobody wrote: values over the built-in study. What is `None` is as there, and is assumed.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Values {
    /// The hazard.
    pub hazard: Hazard,
    /// Number of synthetic motions.
    pub count: Option<u16>,
    /// Seed of the synthetic motions.
    pub seed: Option<u64>,
    /// Number of storeys.
    pub storeys: Option<u16>,
    /// Height of a storey \[m\].
    pub storey_height_m: Option<f64>,
}

/// The hazard of a study that nobody wrote.
#[derive(Debug, Clone, PartialEq)]
pub enum Hazard {
    /// Keys of `[ground]` as a person gave them: `place`, `site`, `return_period_years`.
    Keys(Words),
    /// A spectrum, every value of which is stated.
    Spectrum(Box<Target>),
}

impl Default for Hazard {
    fn default() -> Self {
        Self::Keys(Words::default())
    }
}

/// The study of values; its text is empty.
///
/// # Errors
/// Everything that is wrong with the values.
///
/// # Example
/// ```
/// use freestand_study::resolve::{Values, of_values};
/// let study = of_values(&Values { storeys: Some(12), ..Values::default() })?;
/// assert_eq!(study.building.map(|building| building.height_m), Some(12.0 * 3.2));
/// # Ok::<(), freestand_input::problem::Problems>(())
/// ```
pub fn of_values(values: &Values) -> Result<Study, Problems> {
    let overrides = Overrides {
        seed: values.seed,
        storeys: values.storeys,
        storey_height_m: values.storey_height_m,
        ..Overrides::default()
    };
    resolve_as(Text::None(values), None, Path::new(""), &overrides)
}

/// A study as it was given.
#[derive(Debug, Clone, PartialEq)]
pub enum StudySource {
    /// Its file.
    File(PathBuf),
    /// Its text (TOML); paths in it are relative to the current folder.
    Text(String),
}

impl StudySource {
    /// Reads and resolves it.
    ///
    /// # Errors
    /// As [`load`] and [`resolve_with`].
    pub fn load(&self, overrides: &Overrides) -> Result<Study, Problems> {
        match self {
            Self::File(path) => load(path, overrides),
            Self::Text(text) => resolve_with(text, None, Path::new(""), overrides),
        }
    }

    /// What people call it: the name of its file.
    pub fn name(&self) -> String {
        match self {
            Self::File(path) => file_name(path).unwrap_or_default(),
            Self::Text(_) => "the study".to_owned(),
        }
    }
}

/// Reads a study from a file; paths in it are relative to its folder.
///
/// # Errors
/// A file that cannot be read, or the errors of [`resolve`].
pub fn load(path: &Path, overrides: &Overrides) -> Result<Study, Problems> {
    resolve_with(
        &read_text(path)?,
        Some(path),
        path.parent().unwrap_or(Path::new("")),
        overrides,
    )
}

/// Whether a file is a study, judged by its name and its content: a study is sometimes given where
/// a record is expected.
pub fn is_study_file(path: &Path) -> bool {
    path.extension()
        .is_some_and(|extension| extension.eq_ignore_ascii_case("toml"))
        && read_text(path).is_ok_and(|text| options::has_table_of_ours(&text))
}

fn read_text(path: &Path) -> Result<String, Problem> {
    const TABLES: [&str; 6] = ["csv", "tsv", "xlsx", "xls", "xlsm", "ods"];
    if path
        .extension()
        .is_some_and(|end| TABLES.iter().any(|table| end.eq_ignore_ascii_case(table)))
    {
        let message = "is a list or a record, not a study";
        return Err(Problem::value(
            message,
            "a study is a TOML file; a list is given as the inventory, and a record as a motion",
        )
        .in_file(path));
    }
    const MAX_BYTES: u64 = 16 << 20;
    const HINT: &str = "name a study: a short text file in TOML";
    let bytes = load_up_to(path, MAX_BYTES, "is too large for a study", HINT)?;
    String::from_utf8(bytes).map_err(|_| {
        Problem::new(ProblemKind::Format, "is not text (UTF-8)")
            .in_file(path)
            .hint(HINT)
    })
}

/// Resolves the study in a TOML text; `source` names it in messages, and paths in it are relative
/// to `base_dir`.
///
/// # Errors
/// Everything that is wrong with it, each with its line and a hint.
///
/// # Example
/// ```
/// use freestand_study::resolve::resolve;
/// let study = resolve("[building]\nstoreys = 12\n", None, "".as_ref())?;
/// assert_eq!(study.building.map(|building| building.storeys), Some(12));
/// assert_eq!(study.objects.mass_kg, 150.0); // not stated: as in the built-in study
/// let error = resolve("[building]\nstoreys = -1\nstory_height = \"3 m\"\n", None, "".as_ref()).unwrap_err();
/// assert_eq!(error.problems.len(), 2);
/// # Ok::<(), freestand_input::problem::Problems>(())
/// ```
pub fn resolve(text: &str, source: Option<&Path>, base_dir: &Path) -> Result<Study, Problems> {
    resolve_with(text, source, base_dir, &Overrides::default())
}

/// As [`resolve`], with values that take precedence.
///
/// # Errors
/// As [`resolve`].
pub fn resolve_with(
    text: &str,
    source: Option<&Path>,
    base_dir: &Path,
    overrides: &Overrides,
) -> Result<Study, Problems> {
    if options::is_empty(text) {
        let hint = "state the place, such as `place = \"Wellington\"` in [ground], and the building, such as `storeys = 4` \
                    in [building]";
        let empty = Problem::new(
            ProblemKind::Missing,
            "the study is empty: nothing is stated in it",
        )
        .hint(hint);
        let empty = empty.shown(KeyStyle::File);
        return Err(source
            .map_or(empty.clone(), |path| empty.in_file(path))
            .into());
    }
    resolve_as(Text::Of(text), source, base_dir, overrides)
}

/// The text of a study.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Text<'t> {
    /// Somebody wrote it.
    Of(&'t str),
    /// The built-in study: nobody stated its place or its building.
    Builtin,
    /// Nothing is written: there are values.
    None(&'t Values),
}

fn resolve_as(
    written: Text,
    source: Option<&Path>,
    base_dir: &Path,
    overrides: &Overrides,
) -> Result<Study, Problems> {
    let is_builtin = written == Text::Builtin;
    let (text, values) = match written {
        Text::Of(text) => (text, None),
        Text::Builtin => (builtin_toml(), None),
        Text::None(values) => ("", Some(values)),
    };
    let (options, problems) = match values {
        None => options::parse(text, overrides.change.as_ref(), source),
        Some(values) => (values.options(), Problems::default()),
    };
    let is_complete = problems.is_empty();
    let mut resolver = Resolver {
        source,
        base_dir,
        values,
        has_place_alone: values.is_some() || overrides.hazard.get("place").is_some(),
        problems,
        doubts: Vec::new(),
        notes: Vec::new(),
        is_complete,
        reading: None,
    };
    let Options {
        mut ground,
        mut building,
        objects,
        outputs,
        assessment,
        worlds,
        restraint,
    } = options;
    let text = resolver.with_hazard(&mut ground, text, overrides);
    let WithStoreys {
        text,
        storeys,
        is_assumed: building_is_assumed,
    } = match values {
        Some(_) => WithStoreys {
            text,
            storeys: GivenStoreys::of(overrides),
            is_assumed: overrides.storeys.is_none(),
        },
        None => resolver.with_storeys(&mut building, text, overrides, is_builtin),
    };
    if has_measured_floors(&building)
        || ((ground.motions.is_some() || ground.suite.is_some()) && overrides.motions.is_none())
    {
        resolver.reading = resolver.reading(&ground);
    }
    let levels = resolver.levels(&building, &ground);
    let is_measured = building
        .period_measured
        .as_ref()
        .is_some_and(|measured| measured.value);
    let (floors, first_floor) = (resolver.floors(&building), resolver.first_floor(&building));
    let vertical_amplification_ratio = resolver.vertical_amplification(&building);
    let building_name = resolver.building_name(&building, storeys);
    let (ground_input, other_ground, building_input) = if has_measured_floors(&building) {
        resolver.check_measured(&ground, &building, &levels, overrides);
        (Some(Ground::OnFloors), None, Some(None))
    } else {
        let code = match values.and_then(Values::spectrum) {
            Some(target) => target.period_code(),
            None => period_code(&ground.target),
        };
        let found = resolver.building(&building.words, storeys, code);
        let ground_input = resolver.ground(&ground, overrides, found.as_ref(), &levels);
        let other_type = ground_input
            .as_ref()
            .and_then(Ground::code_spectrum)
            .and_then(Target::other_type);
        let other = other_type.and_then(|kind| {
            resolver.ground_of_type(kind, &ground, overrides, found.as_ref(), &levels)
        });
        let of_building = found.iter().flat_map(|building| building.doubts.clone());
        resolver
            .doubts
            .extend(of_building.map(StudyDoubt::Building));
        (ground_input, other, found.map(Some))
    };
    let two = ground_input
        .as_ref()
        .is_some_and(|input| input.has_two_components(&levels));
    if let Some(Some(BuildingInput {
        across: Some(_), ..
    })) = &building_input
        && !two
    {
        resolver.doubts.push(StudyDoubt::AcrossUnused);
    }
    let directions_deg = if ground_input.is_some() {
        resolver.directions(&ground, overrides, two)
    } else {
        vec![0.0]
    };
    let objects = resolver.objects(&objects);
    let assessment = resolver.assessment(
        &assessment,
        &worlds,
        &restraint,
        is_measured,
        ground_input.as_ref(),
    );
    let names = ground_input.as_ref().map(|input| input.names(&levels));
    let target = ground_input.as_ref().and_then(Ground::code_spectrum);
    // Nobody chose the place that the built-in study names.
    let place_is_assumed = target.is_some_and(|target| {
        target.place_is_assumed || is_builtin && overrides.hazard.get("place").is_none()
    });
    let outputs = resolver.outputs(&outputs, &levels, objects.as_ref(), names.as_deref());
    let stated = assumed::Stated {
        ground: &ground,
        building: &building,
        overrides,
        is_spectrum: values.is_some_and(|values| values.spectrum().is_some()),
        is_builtin,
        place_is_assumed,
        building_is_assumed,
    };
    let assumed = assumed::assumed(
        ground_input.as_ref(),
        building_input.as_ref().and_then(Option::as_ref),
        &stated,
    );
    if let (Text::Of(_), true, Some(Some(building))) =
        (written, building_is_assumed, &building_input)
    {
        let doubt = StudyDoubt::assumed_building(building);
        resolver.doubts.push(doubt);
    }
    let notes = grouped(resolver.notes.iter().map(|(name, note)| (name, note)));
    let notes = notes.iter().map(|note| KeyStyle::File.shown(note));
    match (ground_input, building_input, objects) {
        (Some(ground), Some(building), Some(objects)) if resolver.problems.is_empty() => {
            Ok(Study {
                source: source.map(Path::to_path_buf),
                is_builtin,
                place_is_assumed,
                building_is_assumed,
                assumed,
                toml: text,
                ground,
                other_ground,
                directions_deg,
                building_name,
                building,
                levels,
                vertical_amplification_ratio,
                floors,
                first_floor,
                objects,
                outputs,
                assessment,
                doubts: resolver
                    .doubts
                    .into_iter()
                    .chain(notes.map(StudyDoubt::OfRecords))
                    .collect(),
            })
        }
        _ => {
            resolver
                .problems
                .problems
                .sort_by_key(|problem| problem.line);
            Err(resolver.problems)
        }
    }
}

struct Resolver<'a> {
    source: Option<&'a Path>,
    base_dir: &'a Path,
    /// Where nothing is written.
    values: Option<&'a Values>,
    /// Whether the place was given beside the study, where no code or value of one can be.
    has_place_alone: bool,
    problems: Problems,
    doubts: Vec<StudyDoubt>,
    /// Of all records that are read, with their names.
    notes: Vec<(String, Note)>,
    /// No key was refused when the text was read.
    is_complete: bool,
    /// How records are read and processed, if there are any.
    reading: Option<MotionFiles>,
}

/// Where a value is written.
fn line<T>(written: &Option<Written<T>>) -> Option<usize> {
    written.as_ref().map(|written| written.line)
}

/// A value that may be written.
fn stated<T: Clone>(written: &Option<Written<T>>) -> Option<T> {
    written.as_ref().map(|written| written.value.clone())
}

/// The value, or the default where the key is missing. A key that was refused also gets the
/// default: its problem is already noted, so the study is never used.
fn or<T: Clone>(written: &Option<Written<T>>, default: T) -> T {
    stated(written).unwrap_or(default)
}

impl Values {
    fn options(&self) -> Options {
        let target = match &self.hazard {
            Hazard::Keys(words) => words.clone(),
            Hazard::Spectrum(_) => Words::default(),
        };
        Options {
            ground: GroundOptions {
                target,
                ..GroundOptions::default()
            },
            ..Options::default()
        }
    }

    fn spectrum(&self) -> Option<&Target> {
        match &self.hazard {
            Hazard::Spectrum(target) => Some(target),
            Hazard::Keys(_) => None,
        }
    }
}

impl GivenStoreys {
    fn of(overrides: &Overrides) -> Self {
        Self {
            count: overrides.storeys,
            each_m: overrides.storey_height_m,
        }
    }
}

impl Resolver<'_> {
    fn note(&mut self, line: Option<usize>, message: impl Into<String>, hint: impl Into<String>) {
        self.fault(line, "", Problem::value(message, hint));
    }

    /// Keeps the notes of records, which are told together.
    fn take_notes<'m>(&mut self, motions: impl IntoIterator<Item = &'m ReadMotion>) {
        let notes = motions.into_iter().flat_map(ReadMotion::named_notes);
        self.notes
            .extend(notes.map(|(name, note)| (name.to_owned(), note.clone())));
    }

    /// Notes a problem that was found elsewhere. A problem that has a line already names its own
    /// file. Any other is assigned to a line of the study; `key` is the key on that line that names
    /// the problem's file.
    fn fault(&mut self, line: Option<usize>, key: &str, problem: Problem) {
        let mut problem = problem.shown(KeyStyle::File);
        if problem.line.is_none() {
            if problem.path.is_some() {
                problem.message = format!("{key}: {problem}");
            }
            problem.line = line;
            problem.path = self.source.map(Path::to_path_buf);
        }
        self.problems.push(problem);
    }

    /// Notes a value that `accept` refuses.
    fn require<T: Copy + std::fmt::Display>(
        &mut self,
        written: &Option<Written<T>>,
        accept: impl Fn(T) -> bool,
        key: &str,
        expected: &str,
    ) {
        if let Some(Written { value, line }) = written
            && !accept(*value)
        {
            self.note(
                Some(*line),
                format!("{key} must be {expected}, not {value}"),
                format!("give {key} as {expected}"),
            );
        }
    }

    fn positive(&mut self, written: &Option<Written<f64>>, key: &str, dimension: Dimension) {
        if let Some(Written { value, line }) = written
            && !(*value > 0.0 && value.is_finite())
        {
            let message = format!(
                "{key} must be positive, not {}",
                format_si(*value, dimension)
            );
            self.note(
                Some(*line),
                message,
                format!("give {} above 0", dimension.with_article()),
            );
        }
    }

    /// Notes two keys that exclude each other; the line is that of the second.
    fn exclusive<A, B>(
        &mut self,
        first: (&str, &Option<Written<A>>),
        second: (&str, &Option<Written<B>>),
    ) {
        if let (Some(a), Some(b)) = (first.1, second.1) {
            let line = a.line.max(b.line);
            self.note(
                Some(line),
                format!("{} and {} exclude each other", first.0, second.0),
                "keep one of them",
            );
        }
    }
}

/// The paths of all files that a study's motions, target spectrum and building were read from.
pub fn motion_paths(study: &Study) -> Vec<PathBuf> {
    let recorded: Vec<&RecordedMotion> = study.ground.recorded(&study.levels).collect();
    let target = match &study.ground {
        Ground::Synthetic(synthetic) => synthetic.target.file.as_ref(),
        Ground::Simulated(_) | Ground::Recorded(_) | Ground::OnFloors => None,
    };
    let others = recorded
        .iter()
        .flat_map(|motion| motion.other_inputs())
        .chain(target)
        .map(|file| &file.path);
    let tables = study
        .building
        .iter()
        .flat_map(|building| &building.tables)
        .map(|table| &table.file.path);
    recorded
        .iter()
        .map(|motion| &motion.path)
        .chain(others)
        .chain(tables)
        .cloned()
        .collect()
}

#[cfg(test)]
mod tests;
