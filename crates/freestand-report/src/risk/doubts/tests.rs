//! Every doubt beside rates and losses, and every assumption, in words.

use freestand::fragility::LimitState;
use freestand::risk::Hazard;
use freestand_risk::costs::CostDoubt;
use freestand_risk::fragility::{At, CurveDoubt, FitDoubt, HazardDoubt};
use freestand_risk::objects::Unjudged;
use strum::EnumCount;

use super::*;

fn names(all: &[&str]) -> Vec<String> {
    all.iter().map(|one| (*one).to_owned()).collect()
}

/// None is forgotten: as many kinds are listed as there are.
fn all<T: EnumCount>(listed: &[T]) {
    let kinds: std::collections::HashSet<_> = listed.iter().map(std::mem::discriminant).collect();
    assert_eq!(kinds.len(), T::COUNT);
}

/// A report without objects, with these doubts and assumptions.
fn report(doubts: Vec<Doubt>, assumptions: Vec<Assumed>) -> RiskReport {
    RiskReport {
        years: 50.0,
        currency: None,
        hazard: MeasuredHazard {
            hazard: Hazard::power_law(1e-4, 1.0, 2.5).unwrap(),
            measure: Measure::Sa { period_s: 0.5 },
            at: At::Ground,
            file: None,
            tilted: Vec::new(),
            has_sites: false,
            doubts: Vec::new(),
        },
        objects: Vec::new(),
        portfolio: None,
        measures: None,
        not_run: Vec::new(),
        assumptions,
        inputs: Vec::new(),
        doubts,
    }
}

#[test]
fn every_doubt_in_words() {
    let (one, many) = (names(&["a"]), names(&["a", "b", "c"]));
    let options = |more| OpenOptions {
        option: "strap".to_owned(),
        id: "a".to_owned(),
        more,
    };
    let few = |id: &str| CurveDoubt::Fit {
        id: id.to_owned(),
        doubt: FitDoubt::FewMotions(12),
    };
    let gaps = [
        Gap::Below {
            uplift: None,
            lowest: 0.1,
        },
        Gap::Between(0.1, 0.123_456),
        Gap::Above(0.4),
    ];
    let unjudged = [LimitState::Exceeds, LimitState::Overturns]
        .map(|state| [Unjudged::NoCurve(state), Unjudged::UnknownRate(state)]);
    let without = [
        NoPortfolio::OfFloor,
        NoPortfolio::Counts,
        NoPortfolio::OneIntensity,
        NoPortfolio::NoStripes,
        NoPortfolio::NotCalculated(0.2),
    ];
    all(&without);
    let mut doubts = vec![
        Doubt::Curves(vec![few("a"), few("b")]),
        Doubt::Hazard(HazardDoubt::IdleSite),
        Doubt::Cost(CostDoubt::OfList("row 3 is odd".to_owned())),
        Doubt::BeginsTooHigh {
            first: 0.123_456,
            ids: one.clone(),
        },
        Doubt::EndsTooLow {
            last: 1.234_56,
            share: 0.3456,
            ids: many.clone(),
        },
    ];
    doubts.extend(gaps.map(|gap| Doubt::NotResolved {
        gap,
        ids: many.clone(),
    }));
    doubts.extend([
        Doubt::WouldTell {
            from: 0.01,
            to: 2.0,
            count: 37,
        },
        Doubt::WithoutCosts(many.clone()),
        Doubt::WithoutFragility(one.clone()),
    ]);
    doubts.extend(unjudged.concat().into_iter().map(|why| Doubt::Unjudged {
        why,
        ids: one.clone(),
    }));
    doubts.extend([
        Doubt::UnknownWorth(options(0)),
        Doubt::UnknownWorth(options(2)),
        Doubt::UnknownFalls(options(0)),
        Doubt::UnknownFalls(options(2)),
    ]);
    doubts.extend(without.map(Doubt::NoPortfolio));
    doubts.extend([1, 2].map(|left_out| Doubt::WorldsLeftOut {
        left_out,
        worlds: 6,
    }));
    doubts.extend([
        Doubt::FailsAtLowest {
            lowest: 0.123_456,
            failing: 3,
            motions: 40,
        },
        Doubt::LeastAlone(many),
    ]);
    all(&doubts);
    let assumed = vec![
        Assumed::Years(50.0),
        Assumed::OneDispersion,
        Assumed::Replicates(1000),
        Assumed::Place,
        Assumed::HazardGoesOn,
        Assumed::NothingAccepted,
        Assumed::OneOfEach(1),
        Assumed::OneOfEach(2),
        Assumed::PaidOnce(1),
        Assumed::PaidOnce(2),
    ];
    all(&assumed);
    let report = report(doubts, assumed);
    let mut told = warnings(&report);
    told.extend(assumptions(&report));
    insta::assert_snapshot!(told.join("\n"));
}
