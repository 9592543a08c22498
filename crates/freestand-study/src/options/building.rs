//! The keys of `[building]`.

use toml::de::DeValue;

use super::Kind::{self, Count, Name, Number, Quantity};
use super::{Place, Reader, Section, Written, read_text, read_words};
use crate::building::axis_key;
use freestand_input::keys::Words;
use freestand_input::quantity::Dimension;

/// `[building]`, as written.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct BuildingOptions {
    pub(crate) name: Option<Written<String>>,
    /// The values of [`crate::building::resolve`]. The key `across` stands for its table.
    pub(crate) words: Words,
    pub(crate) levels: Option<Written<Vec<LevelOptions>>>,
    pub(crate) period_measured: Option<Written<bool>>,
    pub(crate) vertical_amplification: Option<Written<f64>>,
    /// Floors by the names that lists of objects use.
    pub(crate) floors: Option<Written<Vec<FloorOptions>>>,
    pub(crate) first_floor: Option<Written<String>>,
}

/// One entry of `floors`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FloorOptions {
    pub(crate) line: usize,
    pub(crate) name: Option<Written<String>>,
    pub(crate) aliases: Vec<String>,
    /// \[m\]
    pub(crate) elevation: Option<Written<f64>>,
}

/// One entry of `levels`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct LevelOptions {
    pub(crate) line: usize,
    pub(crate) name: Option<Written<String>>,
    pub(crate) level_ratio: Option<Written<f64>>,
    pub(crate) motions: Option<Written<Vec<Written<String>>>>,
    pub(crate) across: Option<Written<Vec<Written<String>>>>,
}

const STOREY_KEYS: [(&str, Kind); 4] = [
    ("storeys", Count),
    ("storey_height", Quantity(Dimension::Length)),
    ("height", Quantity(Dimension::Length)),
    ("period_code", Name),
];

const AXIS_KEYS: [(&str, Kind); 8] = [
    ("frame", Name),
    ("period", Quantity(Dimension::Time)),
    ("damping", Number),
    ("rayleigh_modes", Quantity(Dimension::Ratio)),
    ("shear_flexure", Number),
    ("modes", Count),
    ("storey_table", Name),
    ("mode_table", Name),
];

pub(super) fn building(reader: &mut Reader, table: &mut Section) -> BuildingOptions {
    let mut words = Words::default();
    read_words(reader, table, &STOREY_KEYS, &mut words);
    read_words(reader, table, &AXIS_KEYS, &mut words);
    if let Some(mut across) = table.table(reader, "across") {
        words.add("across", "", Some(across.line));
        for (key, kind) in AXIS_KEYS {
            if let Some(Written { value, line }) = read_text(reader, &mut across, (key, kind)) {
                words.add(axis_key(key, 1), value, Some(line));
            }
        }
        across.finish(reader);
    }
    let name = table.string(reader, "name");
    let first_floor = table.string(reader, "first_floor");
    let period_measured = table.boolean(reader, "period_measured");
    let vertical_amplification = table.ratio(reader, "vertical_amplification");
    BuildingOptions {
        name,
        words,
        levels: levels(reader, table),
        period_measured,
        vertical_amplification,
        floors: floors(reader, table),
        first_floor,
    }
}

fn floors(reader: &mut Reader, table: &mut Section) -> Option<Written<Vec<FloorOptions>>> {
    let (value, line) = table.take(reader, "floors")?;
    let hint = "write floors = [{ name = \"Lobby\", aliases = [\"G\"], elevation = \"0 m\" }, …]";
    let DeValue::Array(items) = value else {
        reader.wrong_type(line, "floors", "a list", value, hint);
        return None;
    };
    let mut floors = Vec::new();
    for item in items {
        let line = reader.line_of(item.span().start);
        let DeValue::Table(entries) = item.get_ref() else {
            reader.wrong_type(line, "floors", "a list of tables", item.get_ref(), hint);
            continue;
        };
        let mut entry = Section::new(Place::Table("floors"), entries, line);
        let aliases = entry
            .strings(reader, "aliases")
            .map(|aliases| aliases.value)
            .unwrap_or_default();
        floors.push(FloorOptions {
            line,
            name: entry.string(reader, "name"),
            aliases: aliases.into_iter().map(|alias| alias.value).collect(),
            elevation: entry.quantity(reader, "elevation", Dimension::Length),
        });
        entry.finish(reader);
    }
    Some(Written {
        value: floors,
        line,
    })
}

fn levels(reader: &mut Reader, table: &mut Section) -> Option<Written<Vec<LevelOptions>>> {
    let (value, line) = table.take(reader, "levels")?;
    let DeValue::Array(items) = value else {
        reader.wrong_type(
            line,
            "levels",
            "a list",
            value,
            "write levels = [{ name = \"roof\", level_ratio = 1.0 }]",
        );
        return None;
    };
    let mut levels = Vec::new();
    for item in items {
        let line = reader.line_of(item.span().start);
        match item.get_ref() {
            DeValue::Table(entries) => {
                let mut entry = Section::new(Place::Table("levels"), entries, line);
                let level = LevelOptions {
                    line,
                    name: entry.string(reader, "name"),
                    level_ratio: entry.ratio(reader, "level_ratio"),
                    motions: entry.strings(reader, "motions"),
                    across: entry.strings(reader, "across"),
                };
                entry.finish(reader);
                levels.push(level);
            }
            value => {
                let level_ratio = reader.ratio_value("levels", value, line);
                levels.push(LevelOptions {
                    line,
                    name: None,
                    level_ratio,
                    motions: None,
                    across: None,
                });
            }
        }
    }
    Some(Written {
        value: levels,
        line,
    })
}
