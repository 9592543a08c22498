//! An inventory: the objects of a building, as a spreadsheet has them, read into SI with everything that is wrong said at once.

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

/// FEMA E-74's three consequences, each rated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Consequences {
    /// LS: somebody may be hurt.
    pub life_safety: Option<Rating>,
    /// PL: it costs money.
    pub property: Option<Rating>,
    /// FL: work stops.
    pub function: Option<Rating>,
}

/// High, medium, low.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Rating {
    /// L.
    Low,
    /// M.
    Medium,
    /// H.
    High,
}

/// One row of an inventory. `None` is an empty cell: what is missing costs the verdict, not the file.
#[derive(Debug, Clone, PartialEq)]
pub struct Item {
    /// Its row in the sheet or file, counted from 1 as a spreadsheet does.
    pub row: u32,
    /// Unique.
    pub id: String,
    /// What it is.
    pub item: String,
    /// How many of them stand there.
    pub quantity: u32,
    /// Rank given by the owner.
    pub priority: String,
    /// In words; `building`, `floor` and `room` are the finer columns of E-74.
    pub location: String,
    /// Building.
    pub building: String,
    /// Floor, by its name.
    pub floor: String,
    /// Room.
    pub room: String,
    /// Life safety, property loss, functional loss.
    pub consequences: Consequences,
    /// Height of its floor over that of the building: 0 ground, 1 roof.
    pub level_ratio: Option<f64>,
    /// Height \[m\].
    pub height_m: Option<f64>,
    /// Side in the first plane of motion, mostly the shorter \[m\].
    pub thickness_m: Option<f64>,
    /// The other side; `None`: it is looked at about one axis only \[m\].
    pub width_m: Option<f64>,
    /// Distance between the pivot edges in the direction of the thickness; `None`: the thickness \[m\].
    pub base_thickness_m: Option<f64>,
    /// Distance between the pivot edges in the direction of the width; `None`: the width \[m\].
    pub base_width_m: Option<f64>,
    /// Height of the centre of gravity; `None`: half the height \[m\].
    pub cg_height_m: Option<f64>,
    /// Mass \[kg\].
    pub mass_kg: Option<f64>,
    /// What stands under one edge.
    pub cushion: Option<EdgeCushion>,
    /// Half a 16–84 % range of its stiffness in ln k, where a library entry gives a range rather than a value.
    pub cushion_log_sd: Option<f64>,
    /// The entry of the cushion library that it is from, with its source in words.
    pub cushion_source: Option<String>,
    /// What it stands.
    pub tolerance: Option<Tolerance>,
    /// Restitution of the motion.
    pub restitution: Restitution,
    /// Coefficient of friction, lowest and highest.
    pub friction_ratio: Option<(f64, f64)>,
    /// Probability of being overturned or damaged that its owner accepts, in place of the study's.
    pub accepted_ratio: Option<f64>,
    /// Notes.
    pub notes: String,
    /// Cells of the columns that are not ours, in the order of [`Inventory::carried`].
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
    /// Headers of the columns that are not ours.
    pub carried: Vec<String>,
    /// The rows, in the order of the file.
    pub items: Vec<Item>,
    /// The libraries of the user that its names were looked up in.
    pub libraries: Vec<freestand_input::file::InputFile>,
    /// How the input was read, and what is doubtful.
    pub warnings: Vec<String>,
}
