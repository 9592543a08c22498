//! The keys of `[building]`.

use toml::de::DeValue;

use super::{Reader, Section, Written};
use crate::quantity::Dimension;

/// `[building]`, as written.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct BuildingOptions {
    pub(crate) storeys: Option<Written<u64>>,
    pub(crate) storey_height_m: Option<Written<f64>>,
    pub(crate) frame: Option<Written<String>>,
    pub(crate) period_s: Option<Written<f64>>,
    pub(crate) damping: Option<Written<f64>>,
    pub(crate) shear_flexure: Option<Written<f64>>,
    pub(crate) modes: Option<Written<u64>>,
    pub(crate) levels: Option<Written<Vec<LevelOptions>>>,
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

pub(super) fn building(reader: &mut Reader, table: &mut Section) -> BuildingOptions {
    BuildingOptions {
        storeys: table.count(reader, "storeys"),
        storey_height_m: table.quantity(reader, "storey_height", Dimension::Length),
        frame: table.string(reader, "frame"),
        period_s: table.quantity(reader, "period", Dimension::Time),
        damping: table.ratio(reader, "damping"),
        shear_flexure: table.ratio(reader, "shear_flexure"),
        modes: table.count(reader, "modes"),
        levels: levels(reader, table),
    }
}

fn levels(reader: &mut Reader, table: &mut Section) -> Option<Written<Vec<LevelOptions>>> {
    let (value, line) = table.take(reader, "levels")?;
    let DeValue::Array(items) = value else {
        reader.wrong_type(line, "levels", "a list", value, "write levels = [{ name = \"roof\", level_ratio = 1.0 }]");
        return None;
    };
    let mut levels = Vec::new();
    for item in items {
        let line = reader.line_of(item.span().start);
        match item.get_ref() {
            DeValue::Table(entries) => {
                let mut entry = Section::new("levels", entries, line);
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
                levels.push(LevelOptions { line, name: None, level_ratio, motions: None, across: None });
            }
        }
    }
    Some(Written { value: levels, line })
}
