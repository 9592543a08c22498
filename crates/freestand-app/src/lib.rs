//! Questions as people and programs ask them: one struct each, which the command line, the page and Python fill
//! in the same way. `resolve` alone knows defaults, units, choices and what may be combined, and tells
//! all problems at once; what it returns is in SI and asks the models.

pub mod assess;
pub mod check_list;
pub mod code_spectrum;
pub mod cushion_curve;
pub mod drop_test;
pub mod entered;
pub mod files;
pub mod floor;
pub mod fragility;
pub mod inventory;
pub mod job;
pub mod library;
pub mod list;
pub mod motion;
pub mod object;
pub mod pair;
pub mod place;
pub mod places;
pub mod recovery;
pub mod request;
pub mod restrain;
pub mod risk;
pub mod rock;
pub mod run;
pub mod schema;
pub mod shard;
pub mod shock;
pub mod shock_spectrum;
pub mod simulate;
pub mod spectrum;
pub mod static_test;
pub mod synth;
pub mod typed;
pub mod validate;
pub mod virtual_test;

mod block;
mod body;
mod cells;
mod cushion;
mod hazard;
mod records;
mod second;
mod sliding;
mod study;
mod target;
mod walls;

pub use block::{GeneralBlock, Rocking};
pub use cells::{CellKeys, Libraries};
pub use cushion::CushionUnder;
pub use hazard::{HazardCurve, HazardOfCode};
pub use records::{OneMotion, ReadMotions, Records, VerticalRecords};
pub use second::SecondKeys;
pub use sliding::Sliding;
pub use target::TargetKeys;
pub use walls::Walls;
