//! The verdict: what to do with an object, and why, in words.

use super::result::{Decision, Probability};
use crate::inventory::{Consequences, Rating};
use freestand_input::words::number;
use freestand_study::study::assessment::Accepted;

/// What an accepted probability is for where somebody may be hurt.
pub(super) const LIFE_SAFETY: &str = "life safety";

/// The probability that is accepted for an object, and for what.
pub(super) fn accepted(all: &Accepted, own: Option<f64>, consequences: &Consequences) -> (f64, &'static str) {
    if let Some(own) = own {
        return (own, "this object");
    }
    let high = |rating: Option<Rating>| rating == Some(Rating::High);
    let classes = [
        (high(consequences.life_safety), all.life_safety_ratio, LIFE_SAFETY),
        (high(consequences.property), all.property_ratio, "property"),
        (high(consequences.function), all.function_ratio, "function"),
    ];
    let rated = classes.into_iter().filter(|(is_high, ..)| *is_high).map(|(_, ratio, name)| (ratio, name));
    rated.reduce(|least, next| if next.0 < least.0 { next } else { least }).unwrap_or((all.other_ratio, "default"))
}

/// What a verdict is reached from.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Case<'a> {
    pub(super) accepted_ratio: f64,
    pub(super) lifts: bool,
    pub(super) p_overturn: Probability,
    pub(super) p_exceed: Option<Probability>,
    /// Whether the tolerance may decide.
    pub(super) decides: bool,
    pub(super) governing: Option<&'a str>,
    /// What is missing for a comparison: `tolerance`, `mass`, `cushion`.
    pub(super) missing: &'a [&'static str],
    pub(super) pfa_g: f64,
    /// Demand over capacity of the hardest motion; without a tolerance, rotation over that of overturning.
    pub(super) hardest: f64,
    /// Share of the motions or draws whose histories could not be followed.
    pub(super) unknown_ratio: f64,
    /// Whether its pads are pressed beyond their thickness, where the shock is no longer what was computed.
    pub(super) bottoms: bool,
    /// Whether the shock alone brings it above, so that a softer pad may help; and whether one does, with what was checked.
    pub(super) softer: Option<(bool, &'a str)>,
    /// Why no softer pad was found.
    pub(super) beyond_pads: &'a str,
    /// The larger probability that the compliant base gives.
    pub(super) p_compliant: Option<f64>,
    pub(super) tolerance_source: &'a str,
}

/// The decision, and why.
pub(super) fn decide(case: &Case) -> (Decision, String) {
    let limit = percent(case.accepted_ratio);
    let overturn = in_words("overturned", case.p_overturn);
    if case.p_overturn.value > case.accepted_ratio {
        return (
            Decision::Restrain,
            format!("{overturn}, more than the accepted {limit}.{}", doubt(case.p_overturn, case)),
        );
    }
    let rocking = if case.lifts { format!("rocks; {overturn}") } else { "rocking: none".to_owned() };
    let Some(p_exceed) = case.p_exceed else {
        let missing = case.missing.join(", ");
        let still = if case.lifts { "its shock" } else { &format!("floor PFA {} g", number(case.pfa_g, 2)) };
        let why = format!("{rocking}; {still} still to be compared: {missing} missing.");
        return (Decision::NoVerdict, why);
    };
    let exceed = in_words(case.governing.map_or("exceeded", governing_words), p_exceed);
    if !case.decides {
        let source = case.tolerance_source;
        return (
            Decision::NoVerdict,
            format!(
                "{rocking}; {exceed} if the tolerance holds, but {source} is recalled and cannot decide: confirm it."
            ),
        );
    }
    let compliant = case.p_compliant.filter(|p| *p > case.accepted_ratio && p_exceed.value <= case.accepted_ratio);
    if p_exceed.value <= case.accepted_ratio && compliant.is_none() {
        if p_exceed.value + case.unknown_ratio > case.accepted_ratio {
            let share = percent(case.unknown_ratio);
            return (
                Decision::NoVerdict,
                format!("{rocking}; {exceed}, but {share} of its histories could not be followed."),
            );
        }
        if case.bottoms {
            let why = format!(
                "{rocking}; {exceed} on a straight line, but its pads are pressed beyond their thickness: give their law."
            );
            return (Decision::NoVerdict, why);
        }
        return (
            Decision::Leave,
            format!("{rocking}; {exceed}, within the accepted {limit}.{}", doubt(p_exceed, case)),
        );
    }
    let above = match compliant {
        Some(p) => {
            format!("{exceed} by Eq. (5), but {} on a compliant base, more than the accepted {limit}", percent(p))
        }
        None => format!("{exceed}, more than the accepted {limit}"),
    };
    match (case.softer, case.governing) {
        (Some((true, note)), _) => (Decision::Soften, format!("{above}; a softer pad brings it below: {note}.")),
        (Some((false, note)), _) => (Decision::Restrain, format!("{above}; no pad helps: {note}.")),
        (None, Some("floor-acceleration")) => (
            Decision::Restrain,
            format!(
                "{above}; the floor itself exceeds it, which neither a pad nor a fixing lowers: fix it and move it to a lower floor or isolate it."
            ),
        ),
        (None, _) => (Decision::Restrain, format!("{above}; no pad helps: {}.", case.beyond_pads)),
    }
}

fn governing_words(governing: &str) -> &str {
    match governing {
        "peak" => "peak shock exceeded",
        "spectrum" => "shock spectrum exceeded",
        "damage-boundary" => "damage boundary exceeded",
        "velocity-change" => "velocity change exceeded",
        "edge-lift" => "edge lift exceeded",
        "floor-acceleration" => "floor acceleration above the tolerance",
        "overturning" => "overturned or exceeded",
        other => other,
    }
}

fn in_words(what: &str, p: Probability) -> String {
    format!("{what} with probability {} (95 %: {} to {})", percent(p.value), percent(p.low), percent(p.high))
}

/// A share in per cent; what is below a hundredth of one is not worth its digits.
pub(super) fn percent(share: f64) -> String {
    if share > 0.0 && share < 1e-4 { "under 0.01 %".to_owned() } else { format!("{} %", number(100.0 * share, 3)) }
}

/// Demand over capacity of the hardest motion from which one more motion could be beyond it.
const CLOSE_DEMAND: f64 = 0.5;

/// A sentence where the interval holds the accepted probability: more motions could turn the verdict. Of an object that no motion brings
/// anywhere near what it stands, the interval says only how few motions there are.
fn doubt(p: Probability, case: &Case) -> String {
    let is_close = p.value > 0.0 || case.hardest >= CLOSE_DEMAND;
    if is_close && p.low <= case.accepted_ratio && p.high > case.accepted_ratio {
        " The interval holds the accepted probability: more motions could turn the verdict.".to_owned()
    } else {
        String::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn case() -> Case<'static> {
        let never = Probability { value: 0.0, low: 0.0, high: 0.17 };
        Case {
            accepted_ratio: 0.1,
            lifts: true,
            p_overturn: never,
            p_exceed: Some(never),
            decides: true,
            governing: Some("peak"),
            missing: &[],
            pfa_g: 0.2,
            hardest: 0.9,
            unknown_ratio: 0.0,
            bottoms: false,
            softer: None,
            beyond_pads: "",
            p_compliant: None,
            tolerance_source: "a test",
        }
    }

    fn sure(value: f64) -> Probability {
        Probability { value, low: value, high: value }
    }

    #[test]
    fn the_rules_one_by_one() {
        let decided = |case: Case| decide(&case).0;
        assert_eq!(decided(case()), Decision::Leave);
        assert_eq!(decided(Case { p_overturn: sure(0.2), p_exceed: None, ..case() }), Decision::Restrain);
        assert_eq!(decided(Case { p_exceed: Some(sure(0.2)), ..case() }), Decision::Restrain);
        assert_eq!(decided(Case { p_exceed: Some(sure(0.2)), softer: Some((true, "")), ..case() }), Decision::Soften);
        assert_eq!(
            decided(Case { p_exceed: Some(sure(0.2)), softer: Some((false, "")), ..case() }),
            Decision::Restrain
        );
        assert_eq!(decided(Case { p_compliant: Some(0.2), ..case() }), Decision::Restrain);
        assert_eq!(decided(Case { unknown_ratio: 0.2, ..case() }), Decision::NoVerdict);
        assert_eq!(decided(Case { bottoms: true, ..case() }), Decision::NoVerdict);
        assert_eq!(decided(Case { p_exceed: None, missing: &["tolerance"], ..case() }), Decision::NoVerdict);
        // A recalled tolerance decides neither way, but a fall needs none.
        assert_eq!(decided(Case { decides: false, ..case() }), Decision::NoVerdict);
        assert_eq!(decided(Case { decides: false, p_exceed: Some(sure(0.9)), ..case() }), Decision::NoVerdict);
        assert_eq!(decided(Case { decides: false, p_overturn: sure(0.9), ..case() }), Decision::Restrain);
    }

    #[test]
    fn an_object_at_rest_without_a_tolerance_still_has_its_floor() {
        let (decision, why) = decide(&Case { lifts: false, p_exceed: None, missing: &["tolerance"], ..case() });
        assert_eq!(decision, Decision::NoVerdict);
        assert_eq!(why, "rocking: none; floor PFA 0.2 g still to be compared: tolerance missing.");
    }

    #[test]
    fn the_strictest_high_rating_counts() {
        let all = Accepted { other_ratio: 0.1, life_safety_ratio: 0.02, property_ratio: 0.2, function_ratio: 0.05 };
        let rated = |ls, pl, fl| Consequences { life_safety: ls, property: pl, function: fl };
        let (high, low) = (Some(Rating::High), Some(Rating::Low));
        assert_eq!(accepted(&all, None, &rated(None, None, None)), (0.1, "default"));
        assert_eq!(accepted(&all, None, &rated(high, high, high)), (0.02, "life safety"));
        assert_eq!(accepted(&all, None, &rated(low, high, None)), (0.2, "property"));
        assert_eq!(accepted(&all, Some(0.3), &rated(high, None, None)), (0.3, "this object"));
    }
}
