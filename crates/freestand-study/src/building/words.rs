//! The keys of a building, and the building that they describe.

use std::path::Path;

use freestand::building::{Damping, MAX_MODES};
use freestand::code_spectrum::{FrameKind, PeriodCode};
use freestand_input::keys::Words;
use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::{Dimension, format_si, shorten};
use freestand_input::word_reader::WordReader;

use super::{
    Axis, AxisModel, AxisRequest, BuildingDoubt, BuildingInput, BuildingTable,
    DEFAULT_DAMPING_RATIO, DEFAULT_SHEAR_FLEXURE_RATIO, DEFAULT_STOREY_HEIGHT_M, DEFAULT_STOREYS,
    PeriodFrom,
};

/// Largest number of storeys of a building.
pub const MAX_STOREYS: u16 = 500;

/// The keys of an axis: for the first, and for the second.
const AXIS_KEYS: [[&str; 2]; 8] = [
    ["frame", "across_frame"],
    ["period", "across_period"],
    ["damping", "across_damping"],
    ["shear_flexure", "across_shear_flexure"],
    ["modes", "across_modes"],
    ["storey_table", "across_storey_table"],
    ["mode_table", "across_mode_table"],
    ["rayleigh_modes", "across_rayleigh_modes"],
];

/// Keys that a table replaces; the last four are not keys of an axis.
const REPLACED_BY_TABLES: [&str; 7] = [
    "period",
    "frame",
    "shear_flexure",
    "storeys",
    "storey_height",
    "height",
    "period_code",
];

/// The name of a key for the first axis (0) or the second (1).
pub(crate) fn axis_key(key: &'static str, axis: usize) -> &'static str {
    AXIS_KEYS
        .iter()
        .find(|names| names[0] == key)
        .map_or(key, |names| names[axis])
}

/// The building that words describe; paths are relative to `base_dir`. Keys of the second axis begin
/// with `across_`; any of them, or `across` itself, gives the building a second axis. What is not
/// stated for that axis is as along the first. `code` is the code of the study's spectrum: its
/// formula gives the period where none is stated and the words name no other code.
///
/// # Errors
/// Everything that is wrong with the values and the tables, each problem with its keys.
pub fn resolve(
    words: &Words,
    base_dir: &Path,
    code: Option<PeriodCode>,
) -> Result<BuildingInput, Problems> {
    resolve_with(words, GivenStoreys::default(), base_dir, code)
}

/// Storeys in values, in place of those of words.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct GivenStoreys {
    pub(crate) count: Option<u16>,
    /// \[m\]
    pub(crate) each_m: Option<f64>,
}

/// As [`resolve`], with storeys in values.
pub(crate) fn resolve_with(
    words: &Words,
    given: GivenStoreys,
    base_dir: &Path,
    code: Option<PeriodCode>,
) -> Result<BuildingInput, Problems> {
    let mut reader = WordReader::new(words);
    let building = building(&mut reader, given, base_dir, code);
    reader.problems.finish(building)
}

fn building(
    reader: &mut WordReader,
    given: GivenStoreys,
    base_dir: &Path,
    code: Option<PeriodCode>,
) -> Option<BuildingInput> {
    let Storeys {
        count: storeys,
        each_m: storey_height_m,
        height_m: stated_m,
    } = storeys(reader, given);
    let named = reader.one_of(
        "period_code",
        &PeriodCode::ALL.map(|code| (code.name(), code)),
    );
    let code = named.or(code).unwrap_or_default();
    let along = AxisWords::read(reader, 0, base_dir);
    let has_across = reader
        .words
        .entries()
        .any(|(key, _)| key.starts_with("across"));
    let across = has_across.then(|| AxisWords::read(reader, 1, base_dir).inheriting(&along));
    if !reader.problems.is_empty() {
        // Values that were refused above would be refused again.
        return None;
    }
    // A height that is stated stays exact.
    let mut height_m = stated_m.unwrap_or(f64::from(storeys) * storey_height_m);
    let mut storeys = storeys as usize;
    let has_formula = |axis: &AxisWords| axis.table.is_none() && axis.period_s.is_none();
    let has_formula = has_formula(&along) || across.as_ref().is_some_and(has_formula);
    let first = along.resolve(reader, 0, height_m, code);
    if let Some((
        Axis {
            height_m: Some(stated_m),
            building,
            ..
        },
        _,
    )) = &first
    {
        (storeys, height_m) = (building.floors_ratio().len(), *stated_m);
    }
    // Resolved even if the first is wrong, so that the problems of both are reported at once.
    let second = across.map(|across| across.resolve(reader, 1, height_m, code));
    let states_damping = |axis: Option<&(Axis, PeriodFrom)>| {
        axis.is_some_and(|(axis, _)| {
            axis.table
                .as_ref()
                .is_some_and(|table| table.states_damping)
        })
    };
    let second_states = states_damping(second.as_ref().and_then(Option::as_ref));
    for key in ["damping", "rayleigh_modes"] {
        let own = axis_key(key, 1);
        let is_inherited = second.is_some() && !second_states && !reader.has(own);
        for (key, is_unused) in [
            (key, states_damping(first.as_ref()) && !is_inherited),
            (own, second_states),
        ] {
            if is_unused && reader.has(key) {
                let message =
                    format!("`{key}` is not used: the table states the damping of every mode");
                let hint = format!(
                    "leave `{key}` out, or clear the damping of the modes that it is meant for"
                );
                reader.note(&[key], message, hint);
            }
        }
    }
    let (first, period_from) = first?;
    let (second, across_from) = match second {
        None => (None, None),
        Some(second) => second.map(|(axis, from)| (Some(axis), Some(from)))?,
    };
    if let Some(other_m) = second.as_ref().and_then(|axis| axis.height_m)
        && (other_m - height_m).abs() > 1e-3 * height_m
    {
        let [there, here] =
            [other_m, height_m].map(|height_m| format_si(height_m, Dimension::Length));
        let message =
            format!("the building is {there} high across, but {here} high along its first axis");
        reader.note(
            &["across"],
            message,
            "give both axes the same height: levels are shares of it",
        );
        return None;
    }
    let mut tables = Vec::from_iter(first.table);
    let mut doubts = first.doubts;
    if let Some(greatest_m) = code
        .greatest_height_m()
        .filter(|greatest_m| has_formula && height_m > *greatest_m)
    {
        doubts.push(BuildingDoubt::TooHigh {
            code,
            greatest_m,
            height_m,
        });
    }
    if code == PeriodCode::Nzs1170_5 && has_formula {
        doubts.push(BuildingDoubt::FormulaUnread(code));
    }
    if let Some(axis) = &second {
        // A table that the second axis inherits is listed once, with the first.
        let own = axis
            .table
            .clone()
            .filter(|table| reader.has(axis_key(table.key, 1)));
        tables.extend(own.map(|table| BuildingTable {
            is_across: true,
            ..table
        }));
        doubts.extend(axis.doubts.clone());
    }
    Some(BuildingInput {
        storeys,
        height_m,
        storey_height_m: first.height_m.is_none().then_some(storey_height_m),
        along: first.building,
        across: second.map(|axis| axis.building),
        period_from,
        period_code: has_formula.then_some(code),
        across_from,
        tables,
        doubts,
    })
}

/// The values of one axis, as written.
#[derive(Debug, Clone)]
struct AxisWords {
    /// The table that it names.
    table: Option<AxisModel>,
    frame: Option<FrameKind>,
    period_s: Option<f64>,
    shear_flexure_ratio: Option<f64>,
    modes: Option<usize>,
    damping_ratio: Option<f64>,
    rayleigh_modes: Option<[usize; 2]>,
}

impl AxisWords {
    fn read(reader: &mut WordReader, axis: usize, base_dir: &Path) -> Self {
        let key = |name| axis_key(name, axis);
        let replaced = if axis == 0 {
            &REPLACED_BY_TABLES[..]
        } else {
            &REPLACED_BY_TABLES[..3]
        };
        for (first, second) in [
            ("period", "frame"),
            ("storey_table", "mode_table"),
            ("modes", "mode_table"),
        ] {
            reader.exclusive(key(first), key(second));
        }
        for table in ["storey_table", "mode_table"] {
            replaced
                .iter()
                .for_each(|name| reader.exclusive(key(table), key(name)));
        }
        let path = |name| reader.words.get(key(name)).map(|file| base_dir.join(file));
        let table = path("storey_table").map(AxisModel::StoreyTable);
        let table = table.or_else(|| path("mode_table").map(AxisModel::ModeTable));
        let below_one = ["from 0 to below 1", "from 0 to below 1"];
        Self {
            table,
            frame: reader.one_of(
                key("frame"),
                &FrameKind::ALL.map(|kind| (kind.name(), kind)),
            ),
            period_s: reader.positive(key("period"), Dimension::Time),
            shear_flexure_ratio: reader.non_negative(key("shear_flexure"), Dimension::Ratio),
            modes: whole(reader, key("modes"), MAX_MODES as u32).map(|modes| modes as usize),
            damping_ratio: reader.accepted(
                key("damping"),
                Dimension::Ratio,
                |ratio| (0.0..1.0).contains(&ratio),
                below_one,
            ),
            rayleigh_modes: two_modes(reader, key("rayleigh_modes")),
        }
    }

    /// The second axis, with the values that it does not state taken from the first; if it describes
    /// another kind of model, only the damping is taken.
    fn inheriting(mut self, along: &Self) -> Self {
        let has_period = self.period_s.is_some() || self.frame.is_some();
        let is_beam = self.table.is_none() && (has_period || self.shear_flexure_ratio.is_some());
        self.damping_ratio = self.damping_ratio.or(along.damping_ratio);
        self.rayleigh_modes = self.rayleigh_modes.or(along.rayleigh_modes);
        if !(self.table.is_some() || along.table.is_some() && is_beam) {
            self.table = along.table.clone();
            self.shear_flexure_ratio = self.shear_flexure_ratio.or(along.shear_flexure_ratio);
            self.modes = self.modes.or(along.modes);
            if !has_period {
                (self.period_s, self.frame) = (along.period_s, along.frame);
            }
        }
        self
    }

    /// The axis, and what its period is from.
    fn resolve(
        self,
        reader: &mut WordReader,
        axis: usize,
        height_m: f64,
        code: PeriodCode,
    ) -> Option<(Axis, PeriodFrom)> {
        let (model, name, from) = match (self.table, self.period_s) {
            (Some(table @ AxisModel::StoreyTable(_)), _) => {
                (table, "storey_table", PeriodFrom::Storeys)
            }
            (Some(table), _) => (table, "mode_table", PeriodFrom::Modes),
            (None, given) => {
                let frame = self.frame.unwrap_or(FrameKind::Other);
                let by_code = || {
                    code.formula(frame).period_s(height_m).map_err(|error| {
                        Problem::value(error.to_string(), "give `period`, or another height")
                    })
                };
                let period_s = given.or_else(|| reader.keep("storey_height", by_code()))?;
                let by_formula = PeriodFrom::Formula {
                    code,
                    frame,
                    height_m,
                };
                let from = given.map_or(by_formula, |_| PeriodFrom::Given);
                let shear_flexure_ratio = self
                    .shear_flexure_ratio
                    .unwrap_or(DEFAULT_SHEAR_FLEXURE_RATIO);
                let name = if self.rayleigh_modes.is_some() {
                    "rayleigh_modes"
                } else {
                    "period"
                };
                (
                    AxisModel::Beam {
                        period_s,
                        shear_flexure_ratio,
                    },
                    name,
                    from,
                )
            }
        };
        let damping_ratio = self.damping_ratio.unwrap_or(DEFAULT_DAMPING_RATIO);
        let damping = match self.rayleigh_modes {
            None => Damping::Uniform(damping_ratio),
            Some(modes) => Damping::Rayleigh {
                damping_ratio,
                modes,
            },
        };
        // A value that is inherited has the key of the first axis.
        let key = Some(axis_key(name, axis))
            .filter(|key| reader.has(key))
            .unwrap_or(name);
        let found = super::axis(&AxisRequest {
            model,
            damping,
            modes: self.modes,
        });
        let found = reader
            .problems
            .keep(found.map_err(|problem| problem.of(&[key])))?;
        Some((found, from))
    }
}

/// The storeys of a building without a table.
struct Storeys {
    count: u32,
    each_m: f64,
    /// The height of the building, if it was stated.
    height_m: Option<f64>,
}

/// Heights of one storey \[m\]: that of a hall at most.
const STOREY_M: std::ops::RangeInclusive<f64> = 1.0..=30.0;

/// Number and height of the storeys: as given, or from the height of the building.
fn storeys(reader: &mut WordReader, given: GivenStoreys) -> Storeys {
    const KEY: &str = "storey_height";
    const EXPECTED: [&str; 2] = [
        "a height between 1 and 30 m",
        "such as \"3.2 m\", from floor to floor",
    ];
    let count = match given.count {
        Some(count) => at_most(reader, "storeys", count.into(), MAX_STOREYS.into()),
        None => whole(reader, "storeys", MAX_STOREYS.into()),
    };
    let is_storey = |each_m| STOREY_M.contains(&each_m);
    let each_m = match given.each_m {
        Some(each_m) if is_storey(each_m) => Some(each_m),
        Some(each_m) => {
            reader.refuse(KEY, &format!("{each_m} m"), Dimension::Length, EXPECTED);
            None
        }
        None => reader.accepted(KEY, Dimension::Length, is_storey, EXPECTED),
    };
    let Some(height_m) = reader.positive("height", Dimension::Length) else {
        let count = count.unwrap_or(DEFAULT_STOREYS);
        return Storeys {
            count,
            each_m: each_m.unwrap_or(DEFAULT_STOREY_HEIGHT_M),
            height_m: None,
        };
    };
    if count.is_some() {
        reader.exclusive("height", "storey_height");
    }
    let by_height = || (height_m / each_m.unwrap_or(DEFAULT_STOREY_HEIGHT_M)).round();
    let count = count.unwrap_or_else(|| by_height().clamp(1.0, f64::from(MAX_STOREYS)) as u32);
    Storeys {
        count,
        each_m: height_m / f64::from(count),
        height_m: Some(height_m),
    }
}

/// A whole number from 1 to `most`.
fn whole(reader: &mut WordReader, key: &'static str, most: u32) -> Option<u32> {
    let number = reader.whole(key)?;
    at_most(reader, key, number, most)
}

/// The number, if it is from 1 to `most`.
fn at_most(reader: &mut WordReader, key: &'static str, number: u32, most: u32) -> Option<u32> {
    if (1..=most).contains(&number) {
        return Some(number);
    }
    let expected = format!("a whole number from 1 to {most}");
    reader.note(
        &[key],
        format!("`{key}` must be {expected}, not {number}"),
        format!("give `{key}` as {expected}"),
    );
    None
}

/// Two mode numbers, such as "1, 3".
fn two_modes(reader: &mut WordReader, key: &'static str) -> Option<[usize; 2]> {
    let text = reader.words.get(key)?;
    let modes = text
        .split_once(',')
        .map(|(one, other)| (one.trim().parse(), other.trim().parse()));
    if let Some((Ok(one), Ok(other))) = modes {
        return Some([one, other]);
    }
    let message = format!(
        "`{key}` must be two mode numbers, not \"{}\"",
        shorten(text)
    );
    reader.note(&[key], message, format!("write `{key} = \"1, 3\"`"));
    None
}
