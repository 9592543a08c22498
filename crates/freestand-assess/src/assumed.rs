//! What a list leaves open about an object, column by column, and what is then assumed.

use freestand::rocking::Restitution;

use freestand_inventory::{Casters, Column, Item};

/// A column, whether it is empty for an object, and what is then assumed.
type Assumption = (Column, fn(&Item) -> bool, &'static str);

/// Every column that an answer depends on and that may be empty.
const ALL: [Assumption; 11] = [
    (
        Column::Width,
        |item| item.width_m.is_none(),
        "it rocks about one axis only",
    ),
    (
        Column::CgHeight,
        |item| item.cg_height_m.is_none(),
        "half the height",
    ),
    (
        Column::BaseThickness,
        |item| item.base_thickness_m.is_none(),
        "it stands on its full thickness",
    ),
    (
        Column::Mass,
        |item| item.mass_kg.is_none(),
        "no shock, no pads and no force is calculated",
    ),
    (
        Column::Stiffness,
        |item| item.cushion.is_none(),
        "a rigid floor",
    ),
    (
        Column::Tolerance,
        |item| item.tolerance.is_none(),
        "only falling is asked",
    ),
    (
        Column::Restitution,
        |item| item.restitution == Restitution::Housner,
        "Housner's, drawn about it",
    ),
    (
        Column::Friction,
        |item| item.friction_ratio.is_none(),
        "enough for rocking",
    ),
    (
        Column::WallGap,
        |item| !item.surroundings.has_wall(),
        "nothing within its reach",
    ),
    (
        Column::Casters,
        |item| item.surroundings.casters.is_none(),
        "none",
    ),
    (
        Column::RollingResistance,
        |item| {
            item.surroundings.casters == Some(Casters::Free)
                && item.surroundings.rolling_resistance_ratio.is_none()
        },
        "that of the default casters",
    ),
];

/// The names of the columns that are empty for an object.
pub fn columns(item: &Item) -> impl Iterator<Item = &'static str> {
    ALL.into_iter()
        .filter(|(_, is_open, _)| is_open(item))
        .map(|(column, ..)| column.name())
}

/// Of each column that is empty for some objects: its name, for how many, and what is then assumed.
pub fn counted(items: &[Item]) -> Vec<(&'static str, usize, &'static str)> {
    let of = |(column, is_open, words): Assumption| {
        let objects = items.iter().filter(|item| is_open(item)).count();
        (objects > 0).then(|| (column.name(), objects, words))
    };
    ALL.into_iter().filter_map(of).collect()
}
