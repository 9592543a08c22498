//! Lists of objects: what stands in a building, read from a list as people keep it.
//!
//! A file becomes a sheet of cells with their places (`source`); its headings are found, and the
//! rows that are objects (`layout`); each column gets a name, a unit and a decimal sign, each with
//! its evidence (`understood`); each cell becomes a value in SI or a problem (`cells`, `values`),
//! each row an object (`item`). Problems are collected by kind and column (`problems`): a bad cell
//! costs its value, never its row or the file.
//!
//! What a person would read without hesitating is read; where a person would hesitate, nothing is
//! used and the list says so once.

mod archive;
mod cell;
mod cells;
mod columns;
mod columns_read;
mod convert;
mod cost_columns;
mod costs;
mod csv_file;
mod edit;
mod edits;
mod encoding;
mod floors;
mod given;
mod hazardous;
mod headings;
mod implausible;
mod item;
mod kept;
mod layout;
pub mod library;
mod mapping;
mod marked;
mod more_headings;
mod named;
mod numbers;
mod plausible;
mod problems;
mod read;
mod readings;
mod report;
mod roles;
mod round;
mod scans;
mod sentence;
mod sizes;
mod source;
mod template;
#[cfg(test)]
mod tests;
pub mod too_mild;
mod understood;
mod units;
mod used;
pub mod validate;
mod values;
mod vocabulary;
mod wheels;
mod workbook;
mod write;

use std::path::PathBuf;
use std::sync::Arc;
use strum::IntoStaticStr;

use freestand::rocking::Restitution;
use serde::{Deserialize, Serialize};

pub use columns::{COLUMNS, Column, ColumnSpec, Holds};
pub use columns_read::{ColumnRead, HeadingReport};
pub use convert::{Converted, Target, convert_bytes, convert_inventory};
pub use cost_columns::{Amounts, Cost, code as currency_code, cost_name};
pub use costs::CellsRequest;
pub use costs::{costs_of_list, is_list, money};
pub use edit::Edit;
pub use floors::Floors;
pub use given::Value;
pub use hazardous::{is_gas_cylinder, is_lain_in};
pub use item::item_of;
pub use kept::{items_from_lines, lines_of_items};
pub use layout::{LeftOut, RowKind};
pub use mapping::Mapping;
pub use marked::marked_copy;
pub use named::level_of_floor;
pub use problems::{Finding, Kind, Severity, console_lines};
pub use read::{
    CellsRead, ReadOptions, Reading, inspect_headings, inspect_inventory, mapping_of_headings,
    parse_inventory, read_inventory,
};
pub use report::{
    CellsReport, CheckReport, Counts, LeftOutReport, ObjectReport, ProblemReport, RowReport, SHOWN,
    SenseReport, check_report, problem_reports, senses,
};
pub use template::{template_csv, template_xlsx};
pub use vocabulary::rating;

use crate::library::Tolerance;
use freestand_input::file::InputFile;
use freestand_input::quantity::UnitSystem;
use freestand_input::words::{Choices, name_of};
use freestand_study::cushion::EdgeCushion;
use freestand_study::hull::BodyInPose;
use freestand_study::study::assessment::Questions;

/// The ratings of the three consequences of FEMA E-74; `None`: not rated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct Consequences {
    /// LS: risk that somebody is hurt.
    pub life_safety: Option<Rating>,
    /// PL: risk of a loss of property.
    pub property: Option<Rating>,
    /// FL: risk that work stops.
    pub function: Option<Rating>,
}

/// A rating of a consequence.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, IntoStaticStr,
)]
#[strum(serialize_all = "kebab-case")]
pub enum Rating {
    /// `L`: low.
    Low,
    /// `M`: medium.
    Medium,
    /// `H`: high.
    High,
}

impl Rating {
    /// Its name in outputs.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

/// One row of an inventory. `None` is an empty cell: missing data cost the object its verdict, but
/// do not stop the reading.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Item {
    /// Its row in the sheet or file, counted from 1 as in a spreadsheet.
    pub row: u32,
    /// The section of the list that it is in; empty: none.
    pub section: String,
    /// Its identifier, unique in the inventory.
    pub id: String,
    /// What it is.
    pub item: String,
    /// How many such objects there are.
    pub quantity: u32,
    /// Rank given by the owner.
    pub priority: String,
    /// Where it is, in words; `building`, `floor` and `room` are the finer columns of E-74.
    pub location: String,
    /// Building.
    pub building: String,
    /// Name of the floor.
    pub floor: String,
    /// Room.
    pub room: String,
    /// Life safety, property loss, functional loss.
    pub consequences: Consequences,
    /// Height of its floor over the height of the building: 0 ground, 1 roof.
    pub level_ratio: Option<f64>,
    /// Height \[m\].
    pub height_m: Option<f64>,
    /// Horizontal size in the plane of rocking, usually the shorter side \[m\].
    pub thickness_m: Option<f64>,
    /// Horizontal size across the thickness; `None`: rocking is computed about one axis only \[m\].
    pub width_m: Option<f64>,
    /// Distance between the edges in the direction of the thickness; `None`: the thickness \[m\].
    pub base_thickness_m: Option<f64>,
    /// Distance between the edges in the direction of the width; `None`: the width \[m\].
    pub base_width_m: Option<f64>,
    /// The shape of its base, as far as it is known.
    pub shape: ItemShape,
    /// Height of the centre of gravity; `None`: half the height \[m\].
    pub cg_height_m: Option<f64>,
    /// Mass \[kg\].
    pub mass_kg: Option<f64>,
    /// The cushion under one edge.
    pub cushion: Option<EdgeCushion>,
    /// Half of the 16–84 % range of ln k, where a library entry gives a range of stiffness in place
    /// of a value.
    pub cushion_log_sd: Option<f64>,
    /// The entry of the cushion library that it comes from, with its source in words.
    pub cushion_source: Option<String>,
    /// Its tolerance.
    pub tolerance: Option<Tolerance>,
    /// Restitution of the motion.
    #[serde(with = "kept::KeptRestitution")]
    pub restitution: Restitution,
    /// Coefficient of friction, lowest and highest.
    pub friction_ratio: Option<(f64, f64)>,
    /// Probability of overturning or damage that the owner accepts, in place of that of the study.
    pub accepted_ratio: Option<f64>,
    /// What is asked of it; `None`: what the study and its ratings ask.
    #[serde(with = "kept::questions")]
    pub questions: Option<Questions>,
    /// Whether it is anchored; `None`: the list does not say.
    pub anchored: Option<bool>,
    /// What it stands on, in words.
    pub rests_on: String,
    /// What is around it and on it, and whether it rolls.
    pub surroundings: Surroundings,
    /// Notes.
    pub notes: String,
    /// What is doubtful about the values of its row.
    pub doubts: Vec<Kind>,
    /// Cells whose sizes are not believed, each with the text that would mend or confirm it (`F17=1.45 m`).
    /// Where there are any, the object has no verdict.
    pub to_confirm: Vec<String>,
    /// Cells of the other columns, in the order of [`Inventory::carried`].
    pub carried: Vec<String>,
}

impl Item {
    /// Whether its base is round: its sides are those of the square around it.
    pub fn is_round(&self) -> bool {
        self.shape == ItemShape::Round
    }

    /// Whether its histories are followed one by one in every study: those of a body that is no block, and of a stack.
    pub fn is_followed_alone(&self) -> bool {
        let is_stack = self.surroundings.upper.is_some();
        let rolls = self.surroundings.casters == Some(Casters::Free);
        let is_no_block = matches!(self.shape, ItemShape::Round | ItemShape::Body(_));
        self.anchored != Some(true) && (is_stack || is_no_block && !rolls)
    }
}

/// The shape of an object.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum ItemShape {
    /// A block, which its sizes describe.
    Block,
    /// A round base: its sides are those of the square around it.
    Round,
    /// A polygon, a body on feet, or one that was scanned.
    #[serde(with = "kept::body")]
    Body(Arc<BodyInPose>),
    /// It was given, and cannot be used.
    Unknown,
}

/// What is around an object and on it, and whether it rolls.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Surroundings {
    /// Distance from its back to the wall, in the direction of the thickness; `None`: no wall \[m\].
    pub wall_gap_m: Option<f64>,
    /// Distance to what stands on both sides of it, in the direction of the width; `None`: nothing \[m\].
    pub neighbour_gap_m: Option<f64>,
    /// Height of the wall and of the neighbours; `None`: taller than the object \[m\].
    pub wall_height_m: Option<f64>,
    /// Stiffness of the wall where the object strikes it \[N/m\].
    pub wall_stiffness_n_m: Option<f64>,
    /// Restitution of an impact at the wall, from 0 to below 1.
    pub wall_restitution: Option<f64>,
    /// Its casters; `None`: the list does not say.
    pub casters: Option<Casters>,
    /// Resistance of its casters over its weight.
    pub rolling_resistance_ratio: Option<f64>,
    /// How far it may slide or roll \[m\].
    pub clearance_m: Option<f64>,
    /// What stands on it.
    pub upper: Option<UpperBody>,
}

impl Surroundings {
    /// Whether a wall or neighbours stand beside it.
    pub fn has_wall(&self) -> bool {
        self.wall_gap_m.is_some() || self.neighbour_gap_m.is_some()
    }
}

/// The casters of an object.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Casters {
    /// It has none.
    None,
    /// They roll.
    Free,
    /// They are braked.
    Braked,
}

/// The casters by name, as lists have them.
pub const CASTERS: Choices<Casters> = &[
    (Casters::None, "no", "It has none"),
    (Casters::Free, "free", "They roll"),
    (Casters::Braked, "braked", "They hold: it rocks as without"),
];

impl Casters {
    /// Its name in files.
    pub fn name(self) -> &'static str {
        name_of(CASTERS, self)
    }
}

/// A body that stands on an object.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct UpperBody {
    /// Height \[m\].
    pub height_m: f64,
    /// Thickness \[m\].
    pub thickness_m: f64,
    /// Mass; `None`: not known \[kg\].
    pub mass_kg: Option<f64>,
}

/// An inventory that was read.
#[derive(Debug, Clone, PartialEq)]
pub struct Inventory {
    /// The file.
    pub path: PathBuf,
    /// Its SHA-256, in hexadecimal.
    pub sha256: String,
    /// The sheet, of a workbook.
    pub sheet: Option<String>,
    /// Headings of the other columns.
    pub carried: Vec<String>,
    /// The rows, in the order of the file.
    pub items: Vec<Item>,
    /// The user's libraries in which its entries were looked up.
    pub libraries: Vec<InputFile>,
    /// The scans that it names.
    pub scans: Vec<InputFile>,
    /// What beside the file and the study decided how it was read, for the key of a run.
    pub read_with: String,
    /// What is wrong or doubtful, one for each kind and column.
    pub findings: Vec<Finding>,
    /// Warnings about how the file was read.
    pub warnings: Vec<String>,
    /// The units of most of its columns, or of its cells where its columns have none.
    pub units: UnitSystem,
}

impl Inventory {
    /// Whether a cell has no value that should have one.
    pub fn has_errors(&self) -> bool {
        self.findings
            .iter()
            .any(|finding| finding.severity == Severity::Error)
    }
}
