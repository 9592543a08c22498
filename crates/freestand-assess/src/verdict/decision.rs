//! The decision on an object, and the reason for it in words.

use crate::inventory::{Consequences, Rating};
use crate::result::{AcceptedFor, Criterion, Decision, Probability};
use freestand_input::words::{number, percent_significant};
use freestand_study::study::assessment::Accepted;

/// The accepted probability of an object, and what sets it.
pub(crate) fn accepted(all: &Accepted, own: Option<f64>, consequences: &Consequences) -> (f64, AcceptedFor) {
    if let Some(own) = own {
        return (own, AcceptedFor::ThisObject);
    }
    let high = |rating: Option<Rating>| rating == Some(Rating::High);
    let classes = [
        (high(consequences.life_safety), all.life_safety_ratio, AcceptedFor::LifeSafety),
        (high(consequences.property), all.property_ratio, AcceptedFor::Property),
        (high(consequences.function), all.function_ratio, AcceptedFor::Function),
    ];
    let rated = classes.into_iter().filter(|(is_high, ..)| *is_high).map(|(_, ratio, class)| (ratio, class));
    let strictest = rated.reduce(|least, next| if next.0 < least.0 { next } else { least });
    strictest.unwrap_or((all.other_ratio, AcceptedFor::Default))
}

/// What a decision is made from.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Case<'a> {
    pub(super) accepted_ratio: f64,
    pub(super) lifts: bool,
    pub(super) p_overturn: Probability,
    pub(super) p_exceed: Option<Probability>,
    /// Whether the tolerance may decide.
    pub(super) decides: bool,
    pub(super) governing: Option<Criterion>,
    /// What a comparison lacks: `tolerance`, `mass`, `cushion`.
    pub(super) missing: &'a [&'static str],
    pub(super) pfa_g: f64,
    /// Demand/capacity of the hardest motion; without a tolerance, rotation over the slenderness
    /// angle.
    pub(super) hardest: f64,
    /// Share of the motions or draws whose histories failed.
    pub(super) unknown_ratio: f64,
    /// Whether its pads are compressed beyond their thickness, where the computed shock is too
    /// small.
    pub(super) bottoms: bool,
    /// The softer pad that was looked for because the shock alone is too large: whether it passed,
    /// and what was checked.
    pub(super) softer: Option<(bool, &'a str)>,
    /// Why no softer pad was found.
    pub(super) beyond_pads: &'a str,
    /// The larger probability that the compliant base gives.
    pub(super) p_compliant: Option<f64>,
    pub(super) tolerance_source: &'a str,
}

/// The decision and its reason.
pub(super) fn decide(case: &Case) -> (Decision, String) {
    let limit = percent(case.accepted_ratio);
    let overturns = format!("overturns {}", in_words(case.p_overturn));
    if case.p_overturn.value > case.accepted_ratio {
        let why = format!("It {overturns}, more than the accepted {limit}.{}", doubt(case.p_overturn, case));
        return (Decision::Restrain, why);
    }
    let rocking = if case.lifts { format!("It rocks and {overturns}.") } else { "It does not rock.".to_owned() };
    let Some(p_exceed) = case.p_exceed else {
        let (missing, pfa) = (listed(case.missing), number(case.pfa_g, 2));
        let verb = if case.missing.len() == 1 { "was" } else { "were" };
        let why = format!(
            "{rocking} Only overturning was assessed, because its {missing} {verb} not given; the median PFA of its \
             floor is {pfa} g."
        );
        return (Decision::NoVerdict, why);
    };
    let exceeds = format!("{} {}", governing_words(case.governing), in_words(p_exceed));
    if !case.decides {
        let source = case.tolerance_source;
        let why = format!(
            "{rocking} {exceeds}, but this tolerance is recalled and cannot decide: confirm it. Its source: {source}."
        );
        return (Decision::NoVerdict, why);
    }
    let compliant = case.p_compliant.filter(|p| *p > case.accepted_ratio && p_exceed.value <= case.accepted_ratio);
    if p_exceed.value <= case.accepted_ratio && compliant.is_none() {
        if p_exceed.value + case.unknown_ratio > case.accepted_ratio {
            let share = percent(case.unknown_ratio);
            return (Decision::NoVerdict, format!("{rocking} {exceeds}, but {share} of its histories failed."));
        }
        if case.bottoms {
            let why = format!(
                "{rocking} {exceeds}. This assumes a linear cushion, but its pads are compressed beyond their \
                 thickness: give their contact law."
            );
            return (Decision::NoVerdict, why);
        }
        let why = format!("{rocking} {exceeds}, within the accepted {limit}.{}", doubt(p_exceed, case));
        return (Decision::Leave, why);
    }
    let above = match compliant {
        Some(p) => {
            let p = percent(p);
            format!("{exceeds} by Eq. (5), but with {p} on a compliant base, more than the accepted {limit}.")
        }
        None => format!("{exceeds}, more than the accepted {limit}."),
    };
    match (case.softer, case.governing) {
        (Some((true, note)), _) => (Decision::Soften, format!("{above} A softer pad suffices: {note}")),
        (Some((false, note)), _) => (Decision::Restrain, format!("{above} No pad suffices: {note}")),
        (None, Some(Criterion::FloorAcceleration)) => (
            Decision::Restrain,
            format!(
                "{above} Neither a pad nor a restraint lowers the acceleration of the floor: restrain it, and move it \
                 to a lower floor or isolate it."
            ),
        ),
        (None, _) => (Decision::Restrain, format!("{above} No pad suffices: {}.", case.beyond_pads)),
    }
}

fn governing_words(governing: Option<Criterion>) -> &'static str {
    match governing {
        Some(Criterion::Peak) => "Its peak shock exceeds its tolerance",
        Some(Criterion::Spectrum) => "The spectrum of its shock exceeds that of its tolerance",
        Some(Criterion::DamageBoundary) => "Its shock exceeds its damage boundary",
        Some(Criterion::VelocityChange) => "Its velocity change exceeds its tolerance",
        Some(Criterion::EdgeLift) => "Its uplift exceeds its tolerance",
        Some(Criterion::FloorAcceleration) => "The acceleration of its floor exceeds its tolerance",
        Some(Criterion::Overturning) => "It overturns or exceeds its tolerance",
        None => "It exceeds its tolerance",
    }
}

fn in_words(p: Probability) -> String {
    let [value, low, high] = [p.value, p.low, p.high].map(percent);
    format!("with a probability of {value} (95 % interval: {low} to {high})")
}

/// A share in percent; below 0.01 % its digits mean nothing.
pub(super) fn percent(share: f64) -> String {
    if share > 0.0 && share < 1e-4 { "under 0.01 %".to_owned() } else { percent_significant(share, 3) }
}

/// `level`, `level and height`, `level, height and thickness`.
pub(crate) fn listed(names: &[&str]) -> String {
    match names {
        [] => String::new(),
        [one] => (*one).to_owned(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

/// Demand/capacity of the hardest motion from which one more motion could exceed it.
const CLOSE_DEMAND: f64 = 0.5;

/// A sentence where the interval includes the accepted probability, so that more motions could
/// change the verdict. Where no motion comes near the tolerance, the interval only shows how few
/// motions there are.
fn doubt(p: Probability, case: &Case) -> String {
    let is_close = p.value > 0.0 || case.hardest >= CLOSE_DEMAND;
    if is_close && p.low <= case.accepted_ratio && p.high > case.accepted_ratio {
        " The interval includes the accepted probability: more motions could change the verdict.".to_owned()
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
            governing: Some(Criterion::Peak),
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
        // A recalled tolerance decides neither way, but overturning needs no tolerance.
        assert_eq!(decided(Case { decides: false, ..case() }), Decision::NoVerdict);
        assert_eq!(decided(Case { decides: false, p_exceed: Some(sure(0.9)), ..case() }), Decision::NoVerdict);
        assert_eq!(decided(Case { decides: false, p_overturn: sure(0.9), ..case() }), Decision::Restrain);
    }

    #[test]
    fn an_object_at_rest_without_a_tolerance_has_no_verdict() {
        let (decision, why) = decide(&Case { lifts: false, p_exceed: None, missing: &["tolerance"], ..case() });
        assert_eq!(decision, Decision::NoVerdict);
        assert_eq!(
            why,
            "It does not rock. Only overturning was assessed, because its tolerance was not given; the median PFA of \
             its floor is 0.2 g."
        );
    }

    #[test]
    fn the_strictest_high_rating_counts() {
        let all = Accepted { other_ratio: 0.1, life_safety_ratio: 0.02, property_ratio: 0.2, function_ratio: 0.05 };
        let rated = |ls, pl, fl| Consequences { life_safety: ls, property: pl, function: fl };
        let (high, low) = (Some(Rating::High), Some(Rating::Low));
        assert_eq!(accepted(&all, None, &rated(None, None, None)), (0.1, AcceptedFor::Default));
        assert_eq!(accepted(&all, None, &rated(high, high, high)), (0.02, AcceptedFor::LifeSafety));
        assert_eq!(accepted(&all, None, &rated(low, high, None)), (0.2, AcceptedFor::Property));
        assert_eq!(accepted(&all, Some(0.3), &rated(high, None, None)), (0.3, AcceptedFor::ThisObject));
    }
}
