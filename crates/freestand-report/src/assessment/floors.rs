//! Floors as outputs name and order them.

use freestand_inventory::Item;

/// A floor, in a form that sorts.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) struct FloorKey {
    pub building: String,
    pub floor: String,
    /// The bits of the level, of a floor without a name.
    level: Option<u64>,
}

/// The floor of an object. A floor with a name is one floor, whatever levels its rows give.
pub(super) fn floor_key(item: &Item) -> FloorKey {
    let level_ratio = item.level_ratio.filter(|level| level.is_finite());
    let level = if item.floor.is_empty() {
        level_ratio.map(f64::to_bits)
    } else {
        None
    };
    FloorKey {
        building: item.building.clone(),
        floor: item.floor.clone(),
        level,
    }
}

/// The name of a floor, with its building or without.
pub(super) fn floor_words(key: &FloorKey, with_building: bool) -> String {
    let floor = match (key.floor.as_str(), key.level) {
        ("", None) => "level not given".to_owned(),
        ("", Some(bits)) => format!(
            "level {}",
            freestand_input::words::number(f64::from_bits(bits), 3)
        ),
        (floor, _) => floor.to_owned(),
    };
    if key.building.is_empty() || !with_building {
        floor
    } else {
        format!("{}, {floor}", key.building)
    }
}
