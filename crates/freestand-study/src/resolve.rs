//! The study as meant: defaults filled in, everything checked, files loaded; all problems at once.

mod cushion;
mod processing;

use std::collections::HashSet;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use freestand::block::Block;
use freestand::building::{Building, MAX_MODES};
use freestand::code_spectrum::{
    CodeSpectrum, Edition, FrameKind, SiteClass, fundamental_period_s, hazard_factor, hazard_factor_places,
    minimum_kpz, probability_factor,
};
use freestand::impact::{ValidityWarning, stiffness_warnings};
use freestand::rocking::{Accuracy, Restitution};

use crate::error::{Problem, ProblemKind, StudyError};
use crate::options::{
    self, BuildingOptions, GroundOptions, HistoryOptions, LevelOptions, ObjectsOptions, Options, OutputsOptions,
    RestitutionOption, Written, nearest,
};
use crate::quantity::{Dimension, format_si, shorten};
use crate::recorded::{MotionFiles, read_recorded};
use crate::records::ReadOptions;
use crate::study::{
    BuildingInput, Ground, HistoryChoice, Level, Objects, Outputs, RecordedMotion, Study, SyntheticGround,
};

/// Most synthetic motions of a study.
pub const MAX_MOTIONS: u64 = 1000;
/// Most objects of a study's grid.
pub const MAX_OBJECTS: usize = 1_000_000;
/// Most storeys of a building.
pub const MAX_STOREYS: u64 = 500;
/// Most levels of a study.
pub const MAX_LEVELS: usize = 100;

/// What the command line puts in place of what the study says.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Overrides {
    /// Seed of the synthetic motions.
    pub seed: Option<u64>,
    /// Files in place of the study's ground motions, which are then not looked at.
    pub motions: Option<MotionFiles>,
}

/// The built-in study as TOML, with comments: what `--dump-study` prints.
pub fn builtin_toml() -> &'static str {
    include_str!("builtin.toml")
}

/// The built-in study.
///
/// # Errors
/// None without overrides; with them those of the motion files.
pub fn builtin(overrides: &Overrides) -> Result<Study, StudyError> {
    resolve_with(builtin_toml(), None, Path::new(""), overrides)
}

/// Reads a study from a file; paths in it are relative to its folder.
///
/// # Errors
/// A file that cannot be read, or whatever [`resolve`] finds wrong with it.
pub fn load(path: &Path, overrides: &Overrides) -> Result<Study, StudyError> {
    resolve_with(&read_text(path)?, Some(path), path.parent().unwrap_or(Path::new("")), overrides)
}

/// Whether a file is a study by its name and what it holds, so that one given for a record can be told.
pub fn is_study_file(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("toml"))
        && read_text(path).is_ok_and(|text| options::has_table_of_ours(&text))
}

fn read_text(path: &Path) -> Result<String, StudyError> {
    const LARGEST: u64 = 16 << 20;
    let unreadable =
        |message: String, hint: &str| StudyError::from(Problem::new(ProblemKind::Io, message).in_file(path).hint(hint));
    let failed = |error: std::io::Error| {
        unreadable(format!("cannot read the study: {error}"), "check the path and its permissions")
    };
    let file = File::open(path).map_err(failed)?;
    if file.metadata().is_ok_and(|facts| facts.is_dir()) {
        return Err(unreadable("is a folder, not a study".to_owned(), "name the TOML file in it"));
    }
    // A pipe or a device does not say how long it is: count what comes.
    let mut bytes = Vec::new();
    file.take(LARGEST + 1).read_to_end(&mut bytes).map_err(failed)?;
    if bytes.len() as u64 > LARGEST {
        return Err(unreadable("is too large for a study".to_owned(), "a study is a TOML text of some lines"));
    }
    String::from_utf8(bytes).map_err(|_| {
        let problem = Problem::new(ProblemKind::Format, "is not text (UTF-8)").in_file(path);
        StudyError::from(problem.hint("a study is a TOML text; freestand run --dump-study prints one to start from"))
    })
}

/// The study of a TOML text; `source` names it in messages, paths in it are relative to `base_dir`.
///
/// # Errors
/// Everything that is wrong with it, each with its line and a hint.
///
/// # Example
/// ```
/// use freestand_study::resolve::resolve;
/// let study = resolve("[building]\nstoreys = 12\n", None, "".as_ref())?;
/// assert_eq!(study.building.storeys, 12);
/// assert_eq!(study.objects.mass_kg, 150.0); // not said: as in the built-in study
/// let error = resolve("[building]\nstoreys = -1\nstory_height = \"3 m\"\n", None, "".as_ref()).unwrap_err();
/// assert_eq!(error.problems.len(), 2);
/// # Ok::<(), freestand_study::StudyError>(())
/// ```
pub fn resolve(text: &str, source: Option<&Path>, base_dir: &Path) -> Result<Study, StudyError> {
    resolve_with(text, source, base_dir, &Overrides::default())
}

/// As [`resolve`], with what the command line puts in place.
///
/// # Errors
/// As [`resolve`].
pub fn resolve_with(
    text: &str,
    source: Option<&Path>,
    base_dir: &Path,
    overrides: &Overrides,
) -> Result<Study, StudyError> {
    let (options, problems) = options::parse(text, source);
    let is_complete = problems.is_empty();
    let mut resolver = Resolver { source, base_dir, problems, warnings: Vec::new(), is_complete };
    let Options { ground, building, objects, outputs } = options;
    let ground = resolver.ground(&ground, overrides);
    let building_input = resolver.building(&building);
    let levels = resolver.levels(&building);
    let objects = resolver.objects(&objects);
    let outputs = resolver.outputs(&outputs, &levels, objects.as_ref(), ground.as_ref());
    match (ground, building_input, objects) {
        (Some(ground), Some(building), Some(objects)) if resolver.problems.is_empty() => Ok(Study {
            source: source.map(Path::to_path_buf),
            toml: text.to_owned(),
            ground,
            building,
            levels,
            objects,
            outputs,
            warnings: resolver.warnings,
        }),
        _ => {
            resolver.problems.sort_by_key(|problem| problem.line);
            Err(StudyError { problems: resolver.problems })
        }
    }
}

struct Resolver<'a> {
    source: Option<&'a Path>,
    base_dir: &'a Path,
    problems: Vec<Problem>,
    warnings: Vec<String>,
    /// No key was refused when the text was read.
    is_complete: bool,
}

/// The value, or the default where the key is missing. A key that was refused also comes here as the default: its
/// problem is noted already, and the study with it is never used.
fn or<T: Clone>(written: &Option<Written<T>>, default: T) -> T {
    written.as_ref().map_or(default, |written| written.value.clone())
}

impl Resolver<'_> {
    fn note(&mut self, line: Option<usize>, message: impl Into<String>, hint: impl Into<String>) {
        let mut problem = Problem::new(ProblemKind::Value, message).hint(hint);
        problem.line = line;
        problem.path = self.source.map(Path::to_path_buf);
        self.problems.push(problem);
    }

    /// Notes a value for which `accept` does not hold.
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
            let message = format!("{key} must be positive, not {}", format_si(*value, dimension));
            self.note(Some(*line), message, format!("give {} above 0", dimension.with_article()));
        }
    }

    /// Notes two keys that exclude each other; the line is that of the second.
    fn exclusive<A, B>(&mut self, first: (&str, &Option<Written<A>>), second: (&str, &Option<Written<B>>)) {
        if let (Some(a), Some(b)) = (first.1, second.1) {
            let line = a.line.max(b.line);
            self.note(Some(line), format!("{} and {} exclude each other", first.0, second.0), "keep one of them");
        }
    }

    fn ground(&mut self, written: &GroundOptions, overrides: &Overrides) -> Option<Ground> {
        if let Some(files) = &overrides.motions {
            return self.recorded(files, None);
        }
        let Some(motions) = &written.motions else {
            for (key, line) in [
                ("unit", written.unit.as_ref().map(|w| w.line)),
                ("dt", written.dt_s.as_ref().map(|w| w.line)),
                ("component", written.component.as_ref().map(|w| w.line)),
                ("station_xml", written.station_xml.as_ref().map(|w| w.line)),
                ("scale", written.scale.as_ref().map(|w| w.line)),
                ("processing", written.processing.as_ref().map(|w| w.line)),
            ] {
                if line.is_some() {
                    self.note(line, format!("{key} goes with motions"), "name the files: motions = [\"record.AT2\"]");
                }
            }
            return self.synthetic(written, overrides);
        };
        self.exclusive(("code", &written.code), ("motions", &written.motions));
        self.exclusive(("city", &written.city), ("motions", &written.motions));
        self.exclusive(("hazard_factor", &written.hazard_factor), ("motions", &written.motions));
        self.exclusive(("site", &written.site), ("motions", &written.motions));
        self.exclusive(("return_period_years", &written.return_period_years), ("motions", &written.motions));
        self.exclusive(("edition", &written.edition), ("motions", &written.motions));
        self.exclusive(("count", &written.count), ("motions", &written.motions));
        self.exclusive(("seed", &written.seed), ("motions", &written.motions));
        let before = self.problems.len();
        let unit_only = ReadOptions { unit: written.unit.clone().map(|unit| unit.value), ..ReadOptions::default() };
        let dt_only = ReadOptions { dt_s: written.dt_s.as_ref().map(|dt| dt.value), ..ReadOptions::default() };
        let lines = [written.unit.as_ref().map(|w| w.line), written.dt_s.as_ref().map(|w| w.line)];
        for ((key, line), options) in ["unit", "dt"].into_iter().zip(lines).zip([&unit_only, &dt_only]) {
            if let Err(problem) = options.check() {
                self.note(line, format!("{key}: {}", problem.message), problem.hint.unwrap_or_default());
            }
        }
        let processing = self.processing(written);
        if motions.value.is_empty() {
            self.note(Some(motions.line), "motions is empty", "name at least one file, or leave motions out");
            return None;
        }
        // Files read without what was refused would only be refused for the lack of it.
        if written.is_incomplete || self.problems.len() > before {
            return None;
        }
        let files = MotionFiles {
            paths: motions.value.iter().map(|file| self.base_dir.join(&file.value)).collect(),
            read: ReadOptions {
                unit: unit_only.unit,
                uneven_dt_s: processing.resample_dt_s,
                station_xml: written.station_xml.as_ref().map(|file| self.base_dir.join(&file.value)),
                ..dt_only
            },
            component: written.component.as_ref().map(|w| w.value.clone()),
            processing,
        };
        let lines: Vec<usize> = motions.value.iter().map(|file| file.line).collect();
        self.recorded(&files, Some(&lines))
    }

    /// Reads files; a file that is missing is a fault of the study's line, one that is broken of the file's.
    fn recorded(&mut self, files: &MotionFiles, lines: Option<&[usize]>) -> Option<Ground> {
        let (motions, failures) = read_recorded(files);
        let all_read = failures.is_empty();
        for (index, mut problem) in failures {
            if let (Some(line), Some(source), None) =
                (lines.and_then(|lines| lines.get(index)), self.source, problem.line)
            {
                problem.message = format!("motions: {problem}");
                problem.path = Some(source.to_path_buf());
                problem.line = Some(*line);
            }
            self.problems.push(problem);
        }
        for motion in &motions {
            self.warnings.extend(motion.notes.iter().map(|note| format!("{}: {note}", motion.motion.name)));
        }
        all_read.then(|| Ground::Recorded(motions.into_iter().map(|read| read.motion).collect()))
    }

    fn synthetic(&mut self, written: &GroundOptions, overrides: &Overrides) -> Option<Ground> {
        if let Some(Written { value, line }) = &written.code
            && !matches!(value.to_lowercase().as_str(), "as1170.4" | "as 1170.4")
        {
            self.note(Some(*line), format!("code \"{}\" is not known", shorten(value)), "known: \"as1170.4\"");
        }
        self.require(&written.edition, |edition| edition == 2007, "edition", "2007 (with Amendments 1 and 2)");
        self.require(
            &written.count,
            |count| (1..=MAX_MOTIONS).contains(&count),
            "count",
            "a whole number from 1 to 1000",
        );
        self.exclusive(("city", &written.city), ("hazard_factor", &written.hazard_factor));
        let (hazard, city) = match (&written.hazard_factor, &written.city) {
            (Some(hazard), _) => (Some(hazard.value), None),
            (None, Some(city)) => {
                let places: Vec<&str> = hazard_factor_places().collect();
                let place = places.iter().find(|place| place.eq_ignore_ascii_case(city.value.trim()));
                if place.is_none() {
                    let hint = match nearest(&city.value, &places) {
                        Some(near) => format!("did you mean \"{near}\"?"),
                        None => {
                            "give hazard_factor instead; the code's table has Melbourne, Sydney, Adelaide, Perth, …"
                                .to_owned()
                        }
                    };
                    self.note(Some(city.line), format!("city \"{}\" is not in AS 1170.4", shorten(&city.value)), hint);
                }
                (hazard_factor(&city.value), place.map(|&place| place.to_owned()))
            }
            (None, None) => (hazard_factor("Melbourne"), Some("Melbourne".to_owned())),
        };
        let site = match &written.site {
            None => Some(SiteClass::De),
            Some(Written { value, line }) => {
                let site = SiteClass::parse(value).ok();
                if site.is_none() {
                    self.note(
                        Some(*line),
                        format!("site \"{}\" is not a class of AS 1170.4", shorten(value)),
                        "Ae strong rock, Be rock, Ce shallow soil, De deep or soft soil, Ee very soft soil",
                    );
                }
                site
            }
        };
        // A number beyond u32 is no period of the code's table either.
        let years = u32::try_from(or(&written.return_period_years, 500)).unwrap_or(u32::MAX);
        // Each value on its own, so that one that is wrong does not hide another.
        const TABLES: &str = "see Tables 3.1 and 3.2 of AS 1170.4";
        if let Err(error) = probability_factor(years) {
            self.note(written.return_period_years.as_ref().map(|w| w.line), error.to_string(), TABLES);
        }
        self.positive(&written.hazard_factor, "hazard_factor", Dimension::Ratio);
        let spectrum = CodeSpectrum::new(Edition::default(), site?, hazard?, years).ok()?;
        self.warnings.extend(minimum_governs_warning(&spectrum));
        // Beyond, the count was refused above; its names are still listed.
        let count = usize::try_from(or(&written.count, 10).min(MAX_MOTIONS)).unwrap_or_default();
        Some(Ground::Synthetic(SyntheticGround {
            spectrum,
            city,
            count,
            seed: overrides.seed.unwrap_or(or(&written.seed, 1)),
        }))
    }

    fn building(&mut self, written: &BuildingOptions) -> Option<BuildingInput> {
        self.require(&written.storeys, |n| (1..=MAX_STOREYS).contains(&n), "storeys", "a whole number from 1 to 500");
        self.positive(&written.storey_height_m, "storey_height", Dimension::Length);
        self.positive(&written.period_s, "period", Dimension::Time);
        self.require(&written.damping, |zeta| (0.0..1.0).contains(&zeta), "damping", "a ratio from 0 to below 1");
        self.require(&written.shear_flexure, |a| a >= 0.0 && a.is_finite(), "shear_flexure", "0 or more");
        self.require(&written.modes, |n| (1..=MAX_MODES as u64).contains(&n), "modes", "a whole number from 1 to 50");
        self.exclusive(("period", &written.period_s), ("frame", &written.frame));
        let frame = match &written.frame {
            None => Some(FrameKind::Other),
            Some(Written { value, line }) => {
                let found = FrameKind::parse(value);
                if found.is_none() {
                    let hint = "steel-moment, concrete-moment, steel-braced or other; or give period = \"1.92 s\"";
                    self.note(Some(*line), format!("frame \"{}\" is not known", shorten(value)), hint);
                }
                found
            }
        };
        let storeys = usize::try_from(or(&written.storeys, 30)).unwrap_or(usize::MAX);
        let storey_height_m = or(&written.storey_height_m, 3.2);
        let height_m = storeys as f64 * storey_height_m;
        let (period_s, period_note) = match &written.period_s {
            Some(period) => (period.value, "as given".to_owned()),
            None => {
                let kind = frame?;
                let name = kind.name();
                let period_s = fundamental_period_s(kind, height_m).ok()?;
                let kt = kind.period_factor();
                (
                    period_s,
                    format!(
                        "AS 1170.4, 1.25 kt h^0.75 with kt = {kt} (frame \"{name}\") and h = {}",
                        format_si(height_m, Dimension::Length)
                    ),
                )
            }
        };
        let modes = usize::try_from(or(&written.modes, 10)).unwrap_or(usize::MAX);
        let before = self.problems.len();
        match Building::new(period_s, or(&written.damping, 0.05), or(&written.shear_flexure, 5.0), modes) {
            Ok(beam) => Some(BuildingInput { storeys, storey_height_m, beam, period_note }),
            Err(error) => {
                // What was refused above is refused here again; only what is new is worth a line.
                if before == 0 {
                    let line = written.period_s.as_ref().map(|w| w.line);
                    self.note(line, error.to_string(), "check the table [building]");
                }
                None
            }
        }
    }

    fn levels(&mut self, written: &BuildingOptions) -> Vec<Level> {
        let Some(Written { value: entries, line }) = &written.levels else {
            return vec![
                Level { name: "mid-height".to_owned(), level_ratio: 0.5 },
                Level { name: "roof".to_owned(), level_ratio: 1.0 },
            ];
        };
        if entries.is_empty() || entries.len() > MAX_LEVELS {
            self.note(
                Some(*line),
                format!("levels must have 1 to {MAX_LEVELS} entries"),
                "0 is the ground, 1 the roof",
            );
        }
        let mut names = HashSet::new();
        let mut levels = Vec::new();
        for entry in entries {
            if let Some(level) = self.level(entry) {
                if !names.insert(level.name.to_lowercase()) {
                    self.note(
                        Some(entry.line),
                        format!("two levels are called \"{}\"", level.name),
                        "give each its own name",
                    );
                }
                levels.push(level);
            }
        }
        levels
    }

    fn level(&mut self, entry: &LevelOptions) -> Option<Level> {
        self.require(&entry.level_ratio, |x| (0.0..=1.0).contains(&x), "level_ratio", "from 0 (ground) to 1 (roof)");
        let Some(ratio) = &entry.level_ratio else {
            // A bare entry that is no number was noted when it was read.
            if entry.name.is_some() {
                self.note(
                    Some(entry.line),
                    "the level has no level_ratio",
                    "write { name = \"roof\", level_ratio = 1.0 }",
                );
            }
            return None;
        };
        let name = match &entry.name {
            Some(name) => name.value.clone(),
            None if ratio.value == 0.0 => "ground".to_owned(),
            None if ratio.value == 1.0 => "roof".to_owned(),
            None => format!("level-{}", ratio.value),
        };
        if !is_file_name(&name) {
            self.note(
                Some(entry.line),
                format!("\"{}\" cannot name a level: a folder of the outputs has its name", shorten(&name)),
                "use letters, digits, spaces and - _ . only, and no \".csv\" at the end",
            );
        }
        Some(Level { name, level_ratio: ratio.value })
    }

    fn objects(&mut self, written: &ObjectsOptions) -> Option<Objects> {
        for (key, grid) in [("heights", &written.heights_m), ("thicknesses", &written.thicknesses_m)] {
            if let Some(Written { value, line }) = grid {
                if value.is_empty() {
                    self.note(Some(*line), format!("{key} is empty"), "give at least one length");
                } else if let Some(wrong) = value.iter().find(|&&length| !(length > 0.0 && length.is_finite())) {
                    self.note(Some(*line), format!("{key} must be positive, not {wrong} m"), "give lengths above 0");
                }
            }
        }
        self.positive(&written.mass_kg, "mass", Dimension::Mass);
        let mass_kg = or(&written.mass_kg, 150.0);
        let cushion = self.cushion(&written.cushion, mass_kg);
        self.positive(&written.tolerance_m_s2, "tolerance", Dimension::Acceleration);
        self.positive(&written.friction, "friction", Dimension::Ratio);
        self.exclusive(("restitution", &written.restitution), ("restitution_factor", &written.restitution_factor));
        let heights_m = or(&written.heights_m, linear(0.5, 3.0, 26));
        let thicknesses_m = or(&written.thicknesses_m, vec![0.2, 0.3, 0.4, 0.5, 0.6]);
        if heights_m.len().saturating_mul(thicknesses_m.len()) > MAX_OBJECTS {
            let line = written.heights_m.as_ref().or(written.thicknesses_m.as_ref()).map(|w| w.line);
            self.note(
                line,
                format!("the grid has more than {MAX_OBJECTS} objects"),
                "take fewer heights or thicknesses",
            );
            return None;
        }
        let accuracy = self.accuracy(written);
        let blocks: Vec<Block> = heights_m
            .iter()
            .flat_map(|&height_m| thicknesses_m.iter().filter_map(move |&t| Block::uniform(height_m, t).ok()))
            .collect();
        let restitution = self.restitution(written, &blocks);
        if blocks.len() != heights_m.len() * thicknesses_m.len() {
            return None;
        }
        let (cushion, cushion_file) = cushion?;
        let soft = stiffness_warnings(mass_kg, &cushion.cushion, cushion.pad_thickness_m);
        self.warnings.extend(soft.iter().map(ToString::to_string));
        self.warnings.extend(squat_warning(&blocks));
        Some(Objects {
            heights_m,
            thicknesses_m,
            blocks,
            mass_kg,
            cushion,
            cushion_file,
            restitution: restitution?,
            accuracy: accuracy?,
            tolerance_m_s2: written.tolerance_m_s2.as_ref().map(|w| w.value),
            friction: written.friction.as_ref().map(|w| w.value),
        })
    }

    fn accuracy(&mut self, written: &ObjectsOptions) -> Option<Accuracy> {
        let Some(Written { value, line }) = &written.accuracy else { return Some(Accuracy::Standard) };
        match value.to_lowercase().as_str() {
            "fast" => Some(Accuracy::Fast),
            "standard" => Some(Accuracy::Standard),
            "tight" => Some(Accuracy::Tight),
            _ => {
                self.note(
                    Some(*line),
                    format!("accuracy \"{}\" is not known", shorten(value)),
                    "fast, standard or tight",
                );
                None
            }
        }
    }

    fn restitution(&mut self, written: &ObjectsOptions, blocks: &[Block]) -> Option<Restitution> {
        if let Some(Written { value: factor, line }) = &written.restitution_factor {
            let largest = blocks.iter().map(Block::landing_ratio).fold(0.0, f64::max) * factor;
            if !(*factor > 0.0 && factor.is_finite()) {
                self.note(
                    Some(*line),
                    format!("restitution_factor must be positive, not {factor}"),
                    "0.95 on concrete, 0.67 on rubber were measured",
                );
                return None;
            }
            if largest > 1.0 {
                self.note(
                    Some(*line),
                    format!("restitution_factor = {factor} makes the restitution of an object {largest:.4}: it would gain energy"),
                    "the product with Housner's ratio must not exceed 1",
                );
                return None;
            }
            return Some(Restitution::Factor(*factor));
        }
        match &written.restitution {
            None | Some(Written { value: RestitutionOption::Housner, .. }) => Some(Restitution::Housner),
            Some(Written { value: RestitutionOption::Value(r), .. }) if *r > 0.0 && *r <= 1.0 => {
                Some(Restitution::Value(*r))
            }
            Some(Written { value: RestitutionOption::Value(r), line }) => {
                self.note(
                    Some(*line),
                    format!("restitution must be in (0, 1], not {r}"),
                    "\"housner\", or a value in (0, 1]",
                );
                None
            }
        }
    }

    fn outputs(
        &mut self,
        written: &OutputsOptions,
        levels: &[Level],
        objects: Option<&Objects>,
        ground: Option<&Ground>,
    ) -> Outputs {
        let history = written.history.as_ref().and_then(|history| self.history(history, levels, objects, ground));
        Outputs { figures: or(&written.figures, true), report: or(&written.report, true), history }
    }

    fn history(
        &mut self,
        written: &HistoryOptions,
        levels: &[Level],
        objects: Option<&Objects>,
        ground: Option<&Ground>,
    ) -> Option<HistoryChoice> {
        // What it names may be what was refused.
        if !self.is_complete {
            return None;
        }
        let (Some(level), Some(height), Some(thickness)) = (&written.level, &written.height_m, &written.thickness_m)
        else {
            let hint = "write history = { level = \"roof\", height = \"1.5 m\", thickness = \"300 mm\" }";
            self.note(Some(written.line), "history needs level, height and thickness", hint);
            return None;
        };
        let named = levels.iter().find(|one| one.name.eq_ignore_ascii_case(&level.value));
        if named.is_none() {
            let names: Vec<&str> = levels.iter().map(|level| level.name.as_str()).collect();
            self.note(
                Some(level.line),
                format!("history: no level is called \"{}\"", shorten(&level.value)),
                format!("levels: {}", names.join(", ")),
            );
        }
        self.positive(&written.height_m, "history.height", Dimension::Length);
        self.positive(&written.thickness_m, "history.thickness", Dimension::Length);
        if let Some(objects) = objects {
            for (key, value, grid) in
                [("height", height, &objects.heights_m), ("thickness", thickness, &objects.thicknesses_m)]
            {
                // Grid points are interpolated, so 1.5 m of the grid may differ from "1.5 m" by rounding.
                if !grid.iter().any(|point| (point - value.value).abs() <= 1e-9 * value.value.abs()) {
                    let message =
                        format!("history: the grid has no {key} of {}", format_si(value.value, Dimension::Length));
                    self.note(
                        Some(value.line),
                        message,
                        format!("add it to {key}{}", if key == "height" { "s" } else { "es" }),
                    );
                }
            }
        }
        if let (Some(motion), Some(ground)) = (&written.motion, ground) {
            let mut names = ground.names();
            if !names.contains(&motion.value) {
                names.truncate(10);
                self.note(
                    Some(motion.line),
                    format!("history: no motion is called \"{}\"", shorten(&motion.value)),
                    format!("motions: {}", names.join(", ")),
                );
            }
        }
        Some(HistoryChoice {
            level: named?.name.clone(),
            motion: written.motion.as_ref().map(|motion| motion.value.clone()),
            height_m: height.value,
            thickness_m: thickness.value,
        })
    }
}

/// From `from` to `to`, both included, as [`crate::quantity::parse_grid`] makes them.
fn linear(from: f64, to: f64, count: usize) -> Vec<f64> {
    crate::quantity::parse_grid(&format!("{from} m:{to} m:{count}"), Dimension::Length).unwrap_or_default()
}

/// Whether a name can be that of a folder on every system, and never that of a motion's file beside it.
fn is_file_name(name: &str) -> bool {
    let allowed = |c: char| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_' | '.');
    !name.is_empty()
        && name.chars().count() <= 60
        && name.chars().all(allowed)
        && name.starts_with(char::is_alphanumeric)
        && !name.ends_with([' ', '.'])
        && !name.to_lowercase().ends_with(".csv")
        && !is_device(name)
}

/// Names that Windows keeps for devices, whatever follows a dot.
fn is_device(name: &str) -> bool {
    let stem = name.split('.').next().unwrap_or(name).trim_end().to_lowercase();
    let numbered = |prefix| stem.strip_prefix(prefix).is_some_and(|n: &str| matches!(n.as_bytes(), [b'1'..=b'9']));
    matches!(stem.as_str(), "con" | "prn" | "aux" | "nul") || numbered("com") || numbered("lpt")
}

/// Says where the code's least kpZ took the place of the product.
pub fn minimum_governs_warning(spectrum: &CodeSpectrum) -> Option<String> {
    let least = minimum_kpz(spectrum.return_period_years()).filter(|_| spectrum.minimum_governs())?;
    Some(format!(
        "the code's minimum kpZ of {least} for {} years governs: Z = {} alone would give less",
        spectrum.return_period_years(),
        spectrum.hazard_factor()
    ))
}

fn squat_warning(blocks: &[Block]) -> Option<String> {
    let squat: Vec<&Block> = blocks.iter().filter(|block| block.landing_ratio() < 0.0).collect();
    let first = squat.first()?;
    let size = |length_m| format_si(length_m, Dimension::Length);
    Some(format!(
        "{} of {} objects are squat, the first {} high and {} thick: {}",
        squat.len(),
        blocks.len(),
        size(first.height_m()),
        size(first.thickness_m()),
        ValidityWarning::Squat { landing_ratio: first.landing_ratio() }
    ))
}

/// The paths of the files that a study's motions were read from, those of StationXML and of targets of scaling among them.
pub fn motion_paths(study: &Study) -> Vec<PathBuf> {
    match &study.ground {
        Ground::Synthetic(_) => Vec::new(),
        Ground::Recorded(motions) => {
            let others = motions.iter().flat_map(RecordedMotion::other_inputs).map(|file| &file.path);
            motions.iter().map(|motion| &motion.path).chain(others).cloned().collect()
        }
    }
}

#[cfg(test)]
mod tests;
