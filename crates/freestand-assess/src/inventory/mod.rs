//! Inventories: the objects of a building, read from a spreadsheet into SI, with all problems
//! reported at once.

mod archive;
mod cell;
mod columns;
mod convert;
mod csv_file;
mod encoding;
mod findings;
mod header;
mod item;
mod layout;
mod read;
mod source;
mod template;
#[cfg(test)]
mod tests;
mod values;
mod workbook;
mod write;

use std::path::PathBuf;

use freestand::rocking::Restitution;

pub use columns::{COLUMNS, Column, ColumnSpec, Holds};
pub use convert::{Converted, Target, convert_bytes, convert_inventory};
pub use layout::ColumnRead;
pub use read::{Reading, inspect_inventory, parse_inventory, read_inventory};
pub use template::{template_csv, template_xlsx};

use crate::library::Tolerance;
use freestand_study::cushion::EdgeCushion;
use freestand_study::study::assessment::Questions;

/// The ratings of the three consequences of FEMA E-74; `None`: not rated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Consequences {
    /// LS: risk that somebody is hurt.
    pub life_safety: Option<Rating>,
    /// PL: risk of a loss of property.
    pub property: Option<Rating>,
    /// FL: risk that work stops.
    pub function: Option<Rating>,
}

/// A rating of a consequence.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Rating {
    /// `L`: low.
    Low,
    /// `M`: medium.
    Medium,
    /// `H`: high.
    High,
}

/// One row of an inventory. `None` is an empty cell: missing data cost the object its verdict, but
/// do not stop the reading.
#[derive(Debug, Clone, PartialEq)]
pub struct Item {
    /// Its row in the sheet or file, counted from 1 as in a spreadsheet.
    pub row: u32,
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
    pub restitution: Restitution,
    /// Coefficient of friction, lowest and highest.
    pub friction_ratio: Option<(f64, f64)>,
    /// Probability of overturning or damage that the owner accepts, in place of that of the study.
    pub accepted_ratio: Option<f64>,
    /// What is asked of it; `None`: what the study and its ratings ask.
    pub questions: Option<Questions>,
    /// Notes.
    pub notes: String,
    /// Cells of the other columns, in the order of [`Inventory::carried`].
    pub carried: Vec<String>,
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
    pub libraries: Vec<freestand_input::file::InputFile>,
    /// Warnings about how the file was read.
    pub warnings: Vec<String>,
}
