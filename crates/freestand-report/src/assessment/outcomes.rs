//! `outcomes.csv`: what happened to every object in every world, by each model.

use freestand_assess::verdict::OutcomeRow;
use freestand_input::problem::Problem;

use super::table::Cell;
use super::worlds::csv_of;

/// The file's name.
pub const OUTCOMES_NAME: &str = "outcomes.csv";

const HEADER: [&str; 14] = [
    "id",
    "world",
    "model",
    "fell",
    "exceeded",
    "demand_capacity",
    "lift_m",
    "edge_acceleration_g",
    "restitution",
    "stiffness_n_m",
    "pad_damping_ratio",
    "mass_kg",
    "height_m",
    "thickness_m",
];

/// The header of the file.
pub fn outcomes_head() -> Result<Vec<u8>, Problem> {
    csv_of([HEADER.map(Cell::text).to_vec()])
}

/// Rows of the file, without its header.
pub fn outcomes_rows<'a>(
    rows: &mut (dyn Iterator<Item = OutcomeRow<'a>> + '_),
) -> Result<Vec<u8>, Problem> {
    let flag = |one: Option<bool>| one.map_or(Cell::Missing, |one| Cell::Count(u64::from(one)));
    let cells = |row: OutcomeRow<'a>| {
        let demand = match row.demand_capacity_ratio {
            Some(f64::INFINITY) => Cell::Overturned,
            other => Cell::number(other),
        };
        vec![
            Cell::text(row.id),
            Cell::Count(u64::from(row.world)),
            Cell::text(row.model),
            flag(row.has_fallen),
            flag(row.has_exceeded),
            demand,
            Cell::number(row.lift_m),
            Cell::number(row.edge_acceleration_g),
            Cell::number(Some(row.restitution)),
            Cell::number(row.stiffness_n_m),
            Cell::number(row.pad_damping_ratio),
            Cell::number(row.mass_kg),
            Cell::number(Some(row.height_m)),
            Cell::number(Some(row.thickness_m)),
        ]
    };
    csv_of(rows.map(cells))
}
