//! `[building]` as meant.

use std::collections::HashSet;

use freestand::building::{Building, MAX_MODES};
use freestand::code_spectrum::{FrameKind, fundamental_period_s};

use super::{MAX_LEVELS, MAX_STOREYS, Resolver, or};
use crate::options::{BuildingOptions, GroundOptions, LevelOptions, Written};
use crate::quantity::{Dimension, format_si, shorten};
use crate::study::{BuildingInput, Level};

impl Resolver<'_> {
    pub(super) fn building(&mut self, written: &BuildingOptions) -> Option<BuildingInput> {
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
                        format!("two levels are called \"{}\"", level.name),
                        "give each its own name",
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
            // A bare entry that is no number was noted when it was read.
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
                format!("\"{}\" cannot name a level: a folder of the outputs has its name", shorten(&name)),
                "use letters, digits, spaces and - _ . only, and no \".csv\" at the end",
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
pub(super) fn model_keys(written: &BuildingOptions) -> [(&'static str, Option<usize>); 7] {
    [
        ("storeys", written.storeys.as_ref().map(|w| w.line)),
        ("storey_height", written.storey_height_m.as_ref().map(|w| w.line)),
        ("frame", written.frame.as_ref().map(|w| w.line)),
        ("period", written.period_s.as_ref().map(|w| w.line)),
        ("damping", written.damping.as_ref().map(|w| w.line)),
        ("shear_flexure", written.shear_flexure.as_ref().map(|w| w.line)),
        ("modes", written.modes.as_ref().map(|w| w.line)),
    ]
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
