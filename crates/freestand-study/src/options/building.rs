//! The keys of `[building]`.

use toml::de::DeValue;

use super::{Reader, Section, Written};
use freestand_input::quantity::Dimension;

/// `[building]`, as written.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct BuildingOptions {
    pub(crate) storeys: Option<Written<u64>>,
    pub(crate) storey_height_m: Option<Written<f64>>,
    /// The first axis.
    pub(crate) along: AxisOptions,
    pub(crate) across: Option<Written<AxisOptions>>,
    pub(crate) levels: Option<Written<Vec<LevelOptions>>>,
}

/// The keys of one horizontal axis: of `[building]` itself or of its `across`.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct AxisOptions {
    pub(crate) frame: Option<Written<String>>,
    pub(crate) period_s: Option<Written<f64>>,
    pub(crate) damping: Option<Written<f64>>,
    pub(crate) shear_flexure: Option<Written<f64>>,
    pub(crate) modes: Option<Written<u64>>,
    pub(crate) storey_table: Option<Written<String>>,
    pub(crate) mode_table: Option<Written<String>>,
    pub(crate) rayleigh_modes: Option<Written<[u64; 2]>>,
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
        along: axis(reader, table),
        across: across(reader, table),
        levels: levels(reader, table),
    }
}

fn across(reader: &mut Reader, table: &mut Section) -> Option<Written<AxisOptions>> {
    let mut table = table.table(reader, "across")?;
    let line = table.line;
    let value = axis(reader, &mut table);
    table.finish(reader);
    Some(Written { value, line })
}

fn axis(reader: &mut Reader, table: &mut Section) -> AxisOptions {
    AxisOptions {
        frame: table.string(reader, "frame"),
        period_s: table.quantity(reader, "period", Dimension::Time),
        damping: table.ratio(reader, "damping"),
        shear_flexure: table.ratio(reader, "shear_flexure"),
        modes: table.count(reader, "modes"),
        storey_table: table.string(reader, "storey_table"),
        mode_table: table.string(reader, "mode_table"),
        rayleigh_modes: two_modes(reader, table),
    }
}

/// `rayleigh_modes = [1, 3]`.
fn two_modes(reader: &mut Reader, table: &mut Section) -> Option<Written<[u64; 2]>> {
    const KEY: &str = "rayleigh_modes";
    let (value, line) = table.take(reader, KEY)?;
    let number = |value: &DeValue| match value {
        DeValue::Integer(number) => u64::from_str_radix(number.as_str(), number.radix()).ok(),
        _ => None,
    };
    let modes = match value {
        DeValue::Array(items) => items.iter().map(|item| number(item.get_ref())).collect::<Option<Vec<_>>>(),
        _ => None,
    };
    match modes.as_deref() {
        Some(&[first, second]) => Some(Written { value: [first, second], line }),
        _ => {
            reader.wrong_type(line, KEY, "two numbers of modes", value, "write rayleigh_modes = [1, 3]");
            None
        }
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
