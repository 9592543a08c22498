//! What a list leaves open about an object, column by column.

use freestand::rocking::Restitution;

use freestand_inventory::{Casters, Column, Item};

/// A column, and whether it is empty for an object.
type Open = (Column, fn(&Item) -> bool);

/// Every column that an answer depends on and that may be empty.
const ALL: [Open; 11] = [
    (Column::Width, |item| item.width_m.is_none()),
    (Column::CgHeight, |item| item.cg_height_m.is_none()),
    (Column::BaseThickness, |item| {
        item.base_thickness_m.is_none()
    }),
    (Column::Mass, |item| item.mass_kg.is_none()),
    (Column::Stiffness, |item| item.cushion.is_none()),
    (Column::Tolerance, |item| item.tolerance.is_none()),
    (Column::Restitution, |item| {
        item.restitution == Restitution::Housner
    }),
    (Column::Friction, |item| item.friction_ratio.is_none()),
    (Column::WallGap, |item| !item.surroundings.has_wall()),
    (Column::Casters, |item| item.surroundings.casters.is_none()),
    (Column::RollingResistance, |item| {
        item.surroundings.casters == Some(Casters::Free)
            && item.surroundings.rolling_resistance_ratio.is_none()
    }),
];

/// The columns that an answer depends on and that may be empty.
pub fn all() -> impl Iterator<Item = Column> {
    ALL.into_iter().map(|(column, _)| column)
}

/// The names of the columns that are empty for an object.
pub fn columns(item: &Item) -> impl Iterator<Item = &'static str> {
    ALL.into_iter()
        .filter(|(_, is_open)| is_open(item))
        .map(|(column, _)| column.name())
}

/// The columns that are empty for some objects, and for how many.
pub fn counted(items: &[Item]) -> Vec<(Column, usize)> {
    let of = |(column, is_open): Open| {
        let objects = items.iter().filter(|item| is_open(item)).count();
        (objects > 0).then_some((column, objects))
    };
    ALL.into_iter().filter_map(of).collect()
}
