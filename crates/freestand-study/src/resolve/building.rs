//! Resolves `[building]` and its levels.

use std::collections::HashSet;

use freestand::code_spectrum::PeriodCode;

use super::recorded::has_measured_floors;
use super::{MAX_LEVELS, Overrides, Resolver, or, stated};
use crate::building::{self, BuildingInput, GivenStoreys};
use crate::options::{BuildingOptions, GroundOptions, LevelOptions};
use crate::rerun::with_storeys;
use crate::study::{DEFAULT_VERTICAL_AMPLIFICATION, FirstFloor, Level, NamedFloor};
use freestand_input::file_names;
use freestand_input::keys::Words;
use freestand_input::quantity::shorten;
use freestand_input::toml_reader::Written;

/// What the building is called where a study says nothing about it.
const DEFAULT_NAME: &str = "tower";

/// Longest name of a building, in characters: a name, not a description.
const MAX_NAME_CHARS: usize = 120;

const DEFAULT_LEVELS: [(&str, f64); 2] = [("mid-height", 0.5), ("roof", 1.0)];

/// A study whose building has the storeys that were given beside it.
pub(super) struct WithStoreys {
    /// Its text.
    pub(super) text: String,
    /// The storeys.
    pub(super) storeys: GivenStoreys,
    /// Whether nobody stated the building.
    pub(super) is_assumed: bool,
}

/// Whether `[building]` says how high the building is and how it moves: by its storeys, its height or a
/// table, or by its period and its named floors.
fn states_its_size(written: &BuildingOptions) -> bool {
    let has = |key: &str| written.words.get(key).is_some();
    ["storeys", "height", "storey_table", "mode_table"]
        .into_iter()
        .any(has)
        || has("period") && written.floors.is_some()
        || has_measured_floors(written)
}

impl Resolver<'_> {
    /// The storeys of `overrides` in place of those of a building that nobody stated. Nobody chose the one of
    /// the built-in study.
    pub(super) fn with_storeys(
        &mut self,
        written: &mut BuildingOptions,
        text: String,
        overrides: &Overrides,
        is_builtin: bool,
    ) -> WithStoreys {
        let none = GivenStoreys::default();
        if states_its_size(written) && !is_builtin {
            return WithStoreys {
                text,
                storeys: none,
                is_assumed: false,
            };
        }
        let Some(storeys) = overrides.storeys else {
            return WithStoreys {
                text,
                storeys: none,
                is_assumed: true,
            };
        };
        // The name of the built-in building is not that of another.
        if is_builtin {
            written.name = None;
        }
        let height = overrides
            .storey_height_m
            .map(|height_m| format!("{height_m} m"));
        // Text that is not TOML was noted when it was read.
        WithStoreys {
            text: with_storeys(&text, storeys, height.as_deref(), is_builtin).unwrap_or(text),
            storeys: GivenStoreys::of(overrides),
            is_assumed: false,
        }
    }

    /// Its warnings are still with it; `code` is that of the spectrum.
    pub(super) fn building(
        &mut self,
        words: &Words,
        storeys: GivenStoreys,
        code: Option<PeriodCode>,
    ) -> Option<BuildingInput> {
        match building::resolve_with(words, storeys, self.base_dir, code) {
            Ok(building) => Some(building),
            Err(problems) => {
                for mut problem in problems {
                    let line = words.line_of(&problem.keys);
                    let key = problem
                        .key()
                        .unwrap_or_default()
                        .replace("across_", "across ");
                    problem.message = in_its_table(&problem.message);
                    problem.hint = problem.hint.as_deref().map(in_its_table);
                    self.fault(line, &key, problem);
                }
                None
            }
        }
    }

    pub(super) fn levels(
        &mut self,
        written: &BuildingOptions,
        ground: &GroundOptions,
    ) -> Vec<Level> {
        let Some(Written {
            value: entries,
            line,
        }) = &written.levels
        else {
            let level = |(name, ratio): (&str, _)| Level {
                name: name.to_owned(),
                level_ratio: Some(ratio),
                motions: vec![],
            };
            return DEFAULT_LEVELS.map(level).to_vec();
        };
        if entries.is_empty() || entries.len() > MAX_LEVELS {
            self.note(
                Some(*line),
                format!("levels must have 1 to {MAX_LEVELS} entries, not {}", entries.len()),
                "give heights as shares of the building's, such as levels = [0.5, 1.0]: 0 is the ground, 1 the roof",
            );
        }
        let mut names = HashSet::new();
        let mut levels = Vec::new();
        for entry in entries {
            if let Some(level) = self.level(entry, ground) {
                if !names.insert(file_names::same_file(&level.name)) {
                    self.note(
                        Some(entry.line),
                        format!("two levels have the name \"{}\"", level.name),
                        "give each level its own name",
                    );
                }
                levels.push(level);
            }
        }
        levels
    }

    /// What the building is called. The default is that of the default building alone: any other
    /// building has the name that its study gives it, or none.
    pub(super) fn building_name(
        &mut self,
        written: &BuildingOptions,
        storeys: GivenStoreys,
    ) -> Option<String> {
        let Some(Written { value, line }) = &written.name else {
            let is_default =
                *written == BuildingOptions::default() && storeys == GivenStoreys::default();
            return is_default.then(|| DEFAULT_NAME.to_owned());
        };
        let name = value.trim();
        if name.is_empty()
            || name.chars().count() > MAX_NAME_CHARS
            || name.contains(char::is_control)
        {
            self.note(
                Some(*line),
                format!(
                    "name must be a text of 1 to {MAX_NAME_CHARS} characters on one line, not \"{}\"",
                    shorten(value)
                ),
                "give the name of the building, such as name = \"Main block\"",
            );
        }
        Some(name.to_owned())
    }

    /// Floors by their names; the top one is the roof.
    pub(super) fn floors(&mut self, written: &BuildingOptions) -> Vec<NamedFloor> {
        let Some(Written {
            value: entries,
            line,
        }) = &written.floors
        else {
            return Vec::new();
        };
        let mut floors = Vec::new();
        for entry in entries {
            match (&entry.name, &entry.elevation) {
                (Some(name), Some(elevation)) => floors.push(NamedFloor {
                    names: std::iter::once(name.value.clone())
                        .chain(entry.aliases.iter().cloned())
                        .collect(),
                    level_ratio: elevation.value,
                }),
                _ => self.note(
                    Some(entry.line),
                    "a floor must have a name and an elevation".to_owned(),
                    "write { name = \"Lobby\", aliases = [\"G\"], elevation = \"0 m\" }",
                ),
            }
        }
        let roof_m = floors
            .iter()
            .map(|floor| floor.level_ratio)
            .fold(0.0, f64::max);
        if roof_m <= 0.0 {
            self.note(
                Some(*line),
                "the floors must have a top one above the ground".to_owned(),
                "give the elevation of every floor above the ground, and of the roof as the last one",
            );
            return Vec::new();
        }
        for floor in &mut floors {
            floor.level_ratio = (floor.level_ratio / roof_m).max(0.0);
        }
        floors
    }

    /// Vertical acceleration of the floors over that of the ground.
    pub(super) fn vertical_amplification(&mut self, written: &BuildingOptions) -> f64 {
        let accept = |ratio: f64| ratio > 0.0 && ratio.is_finite();
        self.require(
            &written.vertical_amplification,
            accept,
            "vertical_amplification",
            "a ratio above 0",
        );
        or(
            &written.vertical_amplification,
            DEFAULT_VERTICAL_AMPLIFICATION,
        )
    }

    /// Whether floor 1 is the ground.
    pub(super) fn first_floor(&mut self, written: &BuildingOptions) -> Option<FirstFloor> {
        let Written { value, line } = written.first_floor.as_ref()?;
        let found = FirstFloor::ALL
            .iter()
            .find(|(name, _)| name == value)
            .map(|(_, first)| *first);
        if found.is_none() {
            let message = format!(
                "first_floor must be \"ground\" or \"above\", not \"{}\"",
                shorten(value)
            );
            self.note(
                Some(*line),
                message,
                "\"ground\": floor 1 is the ground; \"above\": floor 1 is the one above it",
            );
        }
        found
    }

    fn level(&mut self, entry: &LevelOptions, ground: &GroundOptions) -> Option<Level> {
        self.require(
            &entry.level_ratio,
            |x| (0.0..=1.0).contains(&x),
            "level_ratio",
            "a share from 0 (ground) to 1 (roof)",
        );
        let ratio = stated(&entry.level_ratio);
        if ratio.is_none() && entry.motions.is_none() {
            // A bare entry that is not a number was noted when it was read.
            if entry.name.is_some() {
                self.note(
                    Some(entry.line),
                    "the level has no level_ratio",
                    "write { name = \"roof\", level_ratio = 1.0 }",
                );
            }
            return None;
        }
        let name = match (&entry.name, ratio) {
            (Some(name), _) => name.value.clone(),
            (None, Some(0.0)) => "ground".to_owned(),
            (None, Some(1.0)) => "roof".to_owned(),
            (None, Some(ratio)) => format!("level-{ratio}"),
            (None, None) => {
                let hint = "write { name = \"floor 12\", motions = [\"floor-12.csv\"] }";
                self.note(Some(entry.line), "the level has no name", hint);
                return None;
            }
        };
        if !is_file_name(&name) {
            self.note(
                Some(entry.line),
                format!(
                    "\"{}\" cannot be the name of a level, because it would also name an output folder",
                    shorten(&name)
                ),
                "use letters, digits, spaces and - _ . (at most 60, the first a letter or digit); do not end the name \
                 with a space, a dot or \".csv\", and avoid names that Windows reserves, such as CON",
            );
        }
        let motions = match &entry.motions {
            Some(motions) => self.motions(ground, motions, &entry.across)?,
            None => Vec::new(),
        };
        Some(Level {
            name,
            level_ratio: ratio,
            motions,
        })
    }
}

/// A message in which the keys of the second axis are those of the table `across`.
fn in_its_table(message: &str) -> String {
    message.replace("`across_", "across `")
}

/// Whether a name can be that of a folder on every system and differs from all names of motion
/// files.
fn is_file_name(name: &str) -> bool {
    file_names::unfit(name).is_none()
        && name.chars().count() <= 60
        && name.starts_with(char::is_alphanumeric)
        && !name.to_lowercase().ends_with(".csv")
}
