//! What an object is for those who restrain it: which restraints suit it, and what its fall means for people.

use freestand_inventory::library::HoldsWhat;
use freestand_inventory::{Casters, Item, Rating, is_gas_cylinder, is_lain_in};

/// A wall that is farther away is not for its restraint: brackets and straps are shorter \[m\].
const NEAR_WALL_M: f64 = 0.3;

/// What may hold an object.
pub(super) fn uses(item: &Item) -> Vec<HoldsWhat> {
    let around = &item.surroundings;
    if is_gas_cylinder(&item.item) {
        return vec![HoldsWhat::Cylinder];
    }
    if matches!(around.casters, Some(Casters::Free | Casters::Braked)) {
        return vec![HoldsWhat::OnCasters];
    }
    let is_at_wall = around.wall_gap_m.is_some_and(|gap_m| gap_m <= NEAR_WALL_M);
    let at_wall = is_at_wall.then_some(HoldsWhat::AtWall);
    [HoldsWhat::OnFloor].into_iter().chain(at_wall).collect()
}

/// What the fall of an object means for people.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LifeSafety {
    /// `None`: nobody rates it.
    pub rating: Option<Rating>,
    /// Whether the list does not rate it.
    pub is_assumed: bool,
}

impl LifeSafety {
    /// Where a list does not rate it, a gas cylinder, whose valve may break, and what somebody lies in count as high.
    pub(super) fn of(item: &Item) -> Self {
        let stated = item.consequences.life_safety;
        let is_assumed =
            stated.is_none() && (is_gas_cylinder(&item.item) || is_lain_in(&item.item));
        Self {
            rating: stated.or(is_assumed.then_some(Rating::High)),
            is_assumed,
        }
    }
}
