//! What a list leaves open about an object, column by column.

use freestand::rocking::Restitution;

use freestand_inventory::{Casters, Column, Item};
use strum::VariantArray;

/// What an answer depends on and a list may leave open.
#[derive(Debug, Clone, Copy, PartialEq, Eq, VariantArray)]
pub enum Open {
    /// Its width.
    Width,
    /// The height of its centre of gravity.
    CgHeight,
    /// Where its feet stand.
    BaseThickness,
    /// Its mass.
    Mass,
    /// What is under it.
    Stiffness,
    /// What it withstands.
    Tolerance,
    /// What an impact leaves.
    Restitution,
    /// Its friction.
    Friction,
    /// What stands beside it.
    WallGap,
    /// Whether it is on casters.
    Casters,
    /// How its casters roll.
    RollingResistance,
}

impl Open {
    /// Its column.
    pub fn column(self) -> Column {
        match self {
            Self::Width => Column::Width,
            Self::CgHeight => Column::CgHeight,
            Self::BaseThickness => Column::BaseThickness,
            Self::Mass => Column::Mass,
            Self::Stiffness => Column::Stiffness,
            Self::Tolerance => Column::Tolerance,
            Self::Restitution => Column::Restitution,
            Self::Friction => Column::Friction,
            Self::WallGap => Column::WallGap,
            Self::Casters => Column::Casters,
            Self::RollingResistance => Column::RollingResistance,
        }
    }

    fn is_of(self, item: &Item) -> bool {
        let around = &item.surroundings;
        match self {
            Self::Width => item.width_m.is_none(),
            Self::CgHeight => item.cg_height_m.is_none(),
            Self::BaseThickness => item.base_thickness_m.is_none(),
            Self::Mass => item.mass_kg.is_none(),
            Self::Stiffness => item.cushion.is_none(),
            Self::Tolerance => item.tolerance.is_none(),
            Self::Restitution => item.restitution == Restitution::Housner,
            Self::Friction => item.friction_ratio.is_none(),
            Self::WallGap => !around.has_wall(),
            Self::Casters => around.casters.is_none(),
            Self::RollingResistance => {
                around.casters == Some(Casters::Free) && around.rolling_resistance_ratio.is_none()
            }
        }
    }
}

/// The names of the columns that are empty for an object.
pub fn columns(item: &Item) -> impl Iterator<Item = &'static str> {
    let open = Open::VARIANTS.iter().filter(|open| open.is_of(item));
    open.map(|open| open.column().name())
}

/// What is open for some objects, and for how many.
pub fn counted(items: &[Item]) -> Vec<(Open, usize)> {
    let count = |open: &Open| items.iter().filter(|item| open.is_of(item)).count();
    let all = Open::VARIANTS.iter().map(|open| (*open, count(open)));
    all.filter(|(_, objects)| *objects > 0).collect()
}
