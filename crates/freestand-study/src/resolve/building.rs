//! Resolves the levels of `[building]`.

use std::collections::HashSet;

use super::{MAX_LEVELS, Resolver};
use crate::options::{BuildingOptions, GroundOptions, LevelOptions};
use crate::study::Level;
use freestand_input::quantity::shorten;
use freestand_input::toml_reader::Written;

impl Resolver<'_> {
    pub(super) fn levels(&mut self, written: &BuildingOptions, ground: &GroundOptions) -> Vec<Level> {
        let Some(Written { value: entries, line }) = &written.levels else {
            let level =
                |name: &str, ratio| Level { name: name.to_owned(), level_ratio: Some(ratio), motions: Vec::new() };
            return vec![level("mid-height", 0.5), level("roof", 1.0)];
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
            if let Some(level) = self.level(entry, ground) {
                if !names.insert(level.name.to_lowercase()) {
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

    fn level(&mut self, entry: &LevelOptions, ground: &GroundOptions) -> Option<Level> {
        self.require(&entry.level_ratio, |x| (0.0..=1.0).contains(&x), "level_ratio", "from 0 (ground) to 1 (roof)");
        let ratio = entry.level_ratio.as_ref().map(|ratio| ratio.value);
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
                    "\"{}\" cannot be the name of a level, because an output folder has the same name",
                    shorten(&name)
                ),
                "use only letters, digits, spaces and - _ . and do not end it with \".csv\"",
            );
        }
        let motions = match &entry.motions {
            Some(motions) => self.motions(ground, motions, &entry.across)?,
            None => Vec::new(),
        };
        Some(Level { name, level_ratio: ratio, motions })
    }
}

/// The keys of `[building]` that describe the building itself, with their lines.
pub(super) fn model_keys(written: &BuildingOptions) -> [(&'static str, Option<usize>); 11] {
    [
        ("storeys", written.storeys.as_ref().map(|w| w.line)),
        ("storey_height", written.storey_height_m.as_ref().map(|w| w.line)),
        ("frame", written.along.frame.as_ref().map(|w| w.line)),
        ("period", written.along.period_s.as_ref().map(|w| w.line)),
        ("damping", written.along.damping.as_ref().map(|w| w.line)),
        ("shear_flexure", written.along.shear_flexure.as_ref().map(|w| w.line)),
        ("modes", written.along.modes.as_ref().map(|w| w.line)),
        ("storey_table", written.along.storey_table.as_ref().map(|w| w.line)),
        ("mode_table", written.along.mode_table.as_ref().map(|w| w.line)),
        ("rayleigh_modes", written.along.rayleigh_modes.as_ref().map(|w| w.line)),
        ("across", written.across.as_ref().map(|w| w.line)),
    ]
}

/// Whether a name can be that of a folder on every system and differs from all names of motion
/// files.
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

/// Names that Windows reserves for devices, with any extension.
fn is_device(name: &str) -> bool {
    let stem = name.split('.').next().unwrap_or(name).trim_end().to_lowercase();
    let numbered = |prefix| stem.strip_prefix(prefix).is_some_and(|n: &str| matches!(n.as_bytes(), [b'1'..=b'9']));
    matches!(stem.as_str(), "con" | "prn" | "aux" | "nul") || numbered("com") || numbered("lpt")
}
