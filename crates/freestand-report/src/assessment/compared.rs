//! What an object withstands, how far it goes, and the published numbers that it is compared with, in words.

use freestand::G0_M_S2;
use freestand_assess::capacity::Capacity;
use freestand_assess::result::{Comparison, FloorFacts, Rolled};
use freestand_assess::verdict::{P58_BETA, P58_SHARE};
use freestand_input::quantity::UnitSystem;
use freestand_input::words::{number, percent_words};

/// `5 g, 11 ms half-sine`.
pub(super) fn tolerance(capacity: &Capacity) -> String {
    let parts = [
        capacity
            .peak_m_s2
            .map(|peak| format!("{} g", number(peak / G0_M_S2, 4))),
        capacity
            .duration_s
            .map(|s| format!("{} ms half-sine", number(1e3 * s, 4))),
        capacity
            .velocity_change_m_s
            .map(|v| format!("{} m/s", number(v, 4))),
        capacity
            .edge_lift_m
            .map(|m| format!("uplift of {} mm", number(1e3 * m, 4))),
    ];
    let parts: Vec<String> = parts.into_iter().flatten().collect();
    parts.join(", ")
}

/// How far an object rolls or slides: `at least` where one component of its floor is all that is known.
pub(crate) fn reach(rolled: &Rolled, units: UnitSystem) -> String {
    let (reach_m, is_at_least) = rolled.reach_m();
    let at_least = if is_at_least { "at least " } else { "" };
    format!("{at_least}{}", units.reach(reach_m))
}

/// A comparison with a published number.
pub(super) fn comparison(comparison: &Comparison, floor: &FloorFacts) -> String {
    match comparison {
        Comparison::CodeFloor { code_g, clause } => format!(
            "The code requires {} g for a rigid part on this floor ({clause}); the median PFA of the motions is {} g.",
            number(*code_g, 3),
            number(floor.pfa_g_median, 3)
        ),
        Comparison::FemaP58 {
            median_m_s,
            probability,
        } => format!(
            "By the rule that the FEMA P-58 medians for unanchored contents follow ({P58_SHARE} of the overturning \
             velocity of Kaneko and Hayashi, recalled; β {P58_BETA}), an object of this shape has a median PFV of {} \
             m/s. At the median PFV of this floor, {} m/s, it overturns with a probability of {}.",
            number(*median_m_s, 3),
            number(floor.pfv_m_s_median, 3),
            percent_words(*probability)
        ),
        Comparison::Uplift { threshold_g } => format!(
            "Uplift begins at {} g; the largest PFA of its floor is {} g.",
            number(*threshold_g, 3),
            number(floor.pfa_g_max, 3)
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_sentence() {
        let floor = FloorFacts {
            level_ratio: 1.0,
            pfa_g_median: 0.4,
            pfa_g_max: 0.9,
            pfv_m_s_median: 0.5,
        };
        let capacity = Capacity {
            peak_m_s2: Some(5.0 * G0_M_S2),
            duration_s: Some(0.011),
            velocity_change_m_s: Some(1.5),
            edge_lift_m: Some(0.02),
            decides: true,
        };
        let comparisons = [
            Comparison::CodeFloor {
                code_g: 0.41,
                clause: "ASCE 7-22, 13.3: 0.4 SDS Hf".to_owned(),
            },
            Comparison::FemaP58 {
                median_m_s: 0.81,
                probability: 0.167,
            },
            Comparison::Uplift { threshold_g: 0.26 },
        ];
        let compared = comparisons.iter().map(|one| comparison(one, &floor));
        let all: Vec<String> = std::iter::once(tolerance(&capacity))
            .chain(compared)
            .collect();
        insta::assert_snapshot!(all.join("\n"));
    }
}
