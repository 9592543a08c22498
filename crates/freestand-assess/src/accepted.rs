//! The probability that is accepted for an object.

use freestand::G0_M_S2;
use freestand_study::study::assessment::{Accepted, SMALL_ITEM_J, Settings};

use crate::result::AcceptedFor;
use freestand_inventory::{Consequences, Item, Rating};

/// The accepted probability of an object, and what sets it.
pub fn accepted(item: &Item, settings: &Settings) -> (f64, AcceptedFor) {
    let cg_height_m = item
        .cg_height_m
        .or(item.height_m.map(|height_m| 0.5 * height_m));
    let fall_j = item
        .mass_kg
        .zip(cg_height_m)
        .map(|(mass_kg, cg_m)| mass_kg * G0_M_S2 * cg_m);
    strictest(
        &settings.accepted,
        item.accepted_ratio,
        &item.consequences,
        fall_j,
    )
}

/// An object's own number, else that of the strictest of its ratings. `fall_j` is m g z of its centre of gravity, where the mass is known \[J\].
fn strictest(
    all: &Accepted,
    own: Option<f64>,
    consequences: &Consequences,
    fall_j: Option<f64>,
) -> (f64, AcceptedFor) {
    if let Some(own) = own {
        return (own, AcceptedFor::ThisObject);
    }
    let classes = [
        (
            consequences.life_safety,
            all.life_safety_ratio,
            AcceptedFor::LifeSafety,
        ),
        (
            consequences.property,
            all.property_ratio,
            AcceptedFor::Property,
        ),
        (
            consequences.function,
            all.function_ratio,
            AcceptedFor::Function,
        ),
    ];
    let rated = classes
        .into_iter()
        .filter_map(|(rating, [high, medium, low], class)| {
            let ratio = match rating? {
                Rating::High => high,
                Rating::Medium => medium,
                Rating::Low => low,
            };
            Some((ratio, class))
        });
    let strictest = rated.reduce(|least, next| if next.0 < least.0 { next } else { least });
    strictest.unwrap_or(match fall_j {
        Some(fall_j) if fall_j < SMALL_ITEM_J => (all.small_item_ratio, AcceptedFor::SmallItem),
        _ => (all.other_ratio, AcceptedFor::Default),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_strictest_rating_counts() {
        let all = freestand_study::study::assessment::Settings::default().accepted;
        let rated = |ls, pl, fl| Consequences {
            life_safety: ls,
            property: pl,
            function: fl,
        };
        let [high, medium, low] = [Rating::High, Rating::Medium, Rating::Low].map(Some);
        assert_eq!(
            strictest(&all, None, &rated(None, None, None), None),
            (0.1, AcceptedFor::Default)
        );
        assert_eq!(
            strictest(&all, None, &rated(None, None, None), Some(99.0)),
            (0.2, AcceptedFor::SmallItem)
        );
        assert_eq!(
            strictest(&all, None, &rated(None, None, None), Some(100.0)),
            (0.1, AcceptedFor::Default)
        );
        assert_eq!(
            strictest(&all, None, &rated(high, high, high), None),
            (0.02, AcceptedFor::LifeSafety)
        );
        assert_eq!(
            strictest(&all, None, &rated(low, medium, high), None),
            (0.05, AcceptedFor::Function)
        );
        assert_eq!(
            strictest(&all, None, &rated(medium, low, None), Some(1.0)),
            (0.05, AcceptedFor::LifeSafety)
        );
        assert_eq!(
            strictest(&all, Some(0.3), &rated(high, None, None), None),
            (0.3, AcceptedFor::ThisObject)
        );
    }
}
