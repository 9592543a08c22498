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
fn report(doubts: Vec<RiskDoubt>, assumptions: Vec<RiskAssumption>) -> RiskReport {
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
        RiskDoubt::Curves(vec![few("a"), few("b")]),
        RiskDoubt::Hazard(HazardDoubt::IdleSite),
        RiskDoubt::Cost(CostDoubt::OfList("row 3 is odd".to_owned())),
        RiskDoubt::BeginsTooHigh {
            first: 0.123_456,
            ids: one.clone(),
        },
        RiskDoubt::EndsTooLow {
            last: 1.234_56,
            share: 0.3456,
            ids: many.clone(),
        },
    ];
    doubts.extend(gaps.map(|gap| RiskDoubt::NotResolved {
        gap,
        ids: many.clone(),
    }));
    doubts.extend([
        RiskDoubt::WouldTell {
            from: 0.01,
            to: 2.0,
            count: 37,
        },
        RiskDoubt::WithoutCosts(many.clone()),
        RiskDoubt::WithoutFragility(one.clone()),
    ]);
    doubts.extend(
        unjudged
            .concat()
            .into_iter()
            .map(|why| RiskDoubt::Unjudged {
                why,
                ids: one.clone(),
            }),
    );
    doubts.extend([
        RiskDoubt::UnknownWorth(options(0)),
        RiskDoubt::UnknownWorth(options(2)),
        RiskDoubt::UnknownFalls(options(0)),
        RiskDoubt::UnknownFalls(options(2)),
    ]);
    doubts.extend(without.map(RiskDoubt::NoPortfolio));
    doubts.extend([1, 2].map(|left_out| RiskDoubt::WorldsLeftOut {
        left_out,
        worlds: 6,
    }));
    doubts.extend([
        RiskDoubt::FailsAtLowest {
            lowest: 0.123_456,
            failing: 3,
            motions: 40,
        },
        RiskDoubt::LeastAlone(many),
    ]);
    all(&doubts);
    let assumed = vec![
        RiskAssumption::Years(50.0),
        RiskAssumption::OneDispersion,
        RiskAssumption::Replicates(1000),
        RiskAssumption::Place,
        RiskAssumption::HazardGoesOn,
        RiskAssumption::NothingAccepted,
        RiskAssumption::OneOfEach(1),
        RiskAssumption::OneOfEach(2),
        RiskAssumption::PaidOnce(1),
        RiskAssumption::PaidOnce(2),
    ];
    all(&assumed);
    let report = report(doubts, assumed);
    let mut told = warnings(&report);
    told.extend(assumptions(&report));
    insta::assert_snapshot!(told.join("\n"));
}
