//! Values that an object can hardly have: used, and said.

use std::ops::RangeInclusive;

use freestand::G0_M_S2;
use freestand::cushion::PAD_STIFFNESS_N_M;

use super::columns::Column;
use super::implausible::is_possible;
use super::problems::Kind;
use super::{Item, ItemShape};

/// Density of the box around an object \[kg/m³\]: an empty cardboard box to solid stone.
const DENSITY: RangeInclusive<f64> = 20.0..=3000.0;
/// Height \[m\].
const HEIGHT_M: RangeInclusive<f64> = 0.1..=6.0;
/// Either side \[m\].
const SIDE_M: RangeInclusive<f64> = 0.05..=6.0;
/// Height over the shorter side.
const MAX_SLENDERNESS: f64 = 15.0;
/// Height over the shorter side below which they may have been swapped.
const LOW: f64 = 0.5;
/// Mass \[kg\].
const MASS_KG: RangeInclusive<f64> = 0.5..=100e3;
/// Tolerance \[g\].
const TOLERANCE_G: RangeInclusive<f64> = 0.3..=1000.0;
/// Largest compression of the pads by the weight alone, m g/(2k) \[m\].
const MAX_SINK_M: f64 = 0.02;

/// Whether a mass fits a volume.
pub(super) fn is_density_plausible(mass_kg: f64, volume_m3: f64) -> bool {
    DENSITY.contains(&(mass_kg / volume_m3))
}

/// What is doubtful about the values of an object, with the column that it is said of.
pub(super) fn doubts(item: &Item) -> Vec<(Kind, Column)> {
    let mut found = Vec::new();
    let is_outside = |value: Option<f64>, range: RangeInclusive<f64>| {
        value.is_some_and(|value| !range.contains(&value))
    };
    // What is not even possible is said by `implausible`.
    for (kind, column, size, range) in [
        (Kind::Height, Column::Height, item.height_m, HEIGHT_M),
        (Kind::Side, Column::Thickness, item.thickness_m, SIDE_M),
        (Kind::Side, Column::Width, item.width_m, SIDE_M),
    ] {
        let possible = size.filter(|size| is_possible(column, *size));
        if is_outside(possible, range) {
            found.push((kind, column));
        }
    }
    if is_outside(item.mass_kg, MASS_KG) {
        found.push((Kind::Mass, Column::Mass));
    }
    if let (Some(height), Some(thickness)) = (item.height_m, item.thickness_m) {
        let shorter = item.width_m.map_or(thickness, |width| width.min(thickness));
        if height > MAX_SLENDERNESS * shorter {
            found.push((Kind::Slenderness, Column::Height));
        }
        if height < LOW * shorter && is_possible(Column::Height, height) {
            found.push((Kind::Low, Column::Height));
        }
        // Without a width, the thickness stands for it.
        let volume = match &item.shape {
            ItemShape::Body(body) => body.volume_m3,
            _ => height * thickness * item.width_m.unwrap_or(thickness),
        };
        if item
            .mass_kg
            .is_some_and(|mass| !is_density_plausible(mass, volume))
        {
            found.push((Kind::Density, Column::Mass));
        }
    }
    let peak = item
        .tolerance
        .as_ref()
        .and_then(|tolerance| tolerance.peak_m_s2);
    if is_outside(peak.map(|peak| peak / G0_M_S2), TOLERANCE_G) {
        found.push((Kind::Tolerance, Column::Tolerance));
    }
    let stiffness = item
        .cushion
        .as_ref()
        .and_then(|edge| edge.cushion.linear_stiffness_n_m());
    if let Some(stiffness) = stiffness {
        let sink = item.mass_kg.map(|mass| mass * G0_M_S2 / (2.0 * stiffness));
        if !PAD_STIFFNESS_N_M.contains(&stiffness) || sink.is_some_and(|sink| sink > MAX_SINK_M) {
            found.push((Kind::Stiffness, Column::Stiffness));
        }
    }
    found
}
