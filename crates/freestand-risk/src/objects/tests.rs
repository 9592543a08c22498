//! Rates and losses of an object: tests.

use freestand::fragility::Curve;
use freestand::risk::HazardPoint;

use super::*;
use crate::fragility::{At, Measure};
use freestand_inventory::too_mild::TooMild;

fn state(
    limit_state: LimitState,
    rate: Option<f64>,
    (lower, upper): (f64, f64),
    ci95: Option<(f64, f64)>,
) -> StateRisk {
    StateRisk {
        limit_state,
        rates: AnnualRates {
            annual_rate: rate,
            annual_rate_in_table: rate,
            annual_rate_lower: lower,
            annual_rate_upper: Some(upper),
            below_first: 0.0,
        },
        open: None,
        ci95,
        slopes: Slopes::Stated,
        lacks_interval: false,
        probability: None,
        years: 50.0,
    }
}

#[test]
fn verdicts_follow_the_accepted_rates() {
    let overturns = |rate, ends, ci95| [state(LimitState::Overturns, rate, ends, ci95)];
    let of = |states: &[StateRisk], accepted, exceed| {
        let found = super::judged(states, accepted, exceed);
        (found.verdict, found.is_certain)
    };
    let judged = |states: &[StateRisk], accepted| of(states, accepted, None);
    let (accepted, exceeds) = (Some(RiskVerdict::Accepted), Some(RiskVerdict::Exceeds));
    let (same, narrow) = ((1e-4, 1e-4), Some((5e-5, 2e-4)));
    assert_eq!(
        judged(&overturns(Some(1e-4), same, narrow), None),
        (None, None)
    );
    assert_eq!(
        judged(&overturns(Some(1e-4), same, narrow), Some(1e-3)),
        (accepted, Some(true))
    );
    // Accepted only if the most that the rate can be is.
    assert_eq!(
        judged(&overturns(Some(1e-4), (1e-4, 2e-3), narrow), Some(1e-3)),
        (exceeds, Some(false))
    );
    assert_eq!(
        judged(&overturns(Some(1e-4), same, Some((1e-5, 2e-3))), Some(1e-3)),
        (accepted, Some(false))
    );
    assert_eq!(
        judged(
            &overturns(Some(2e-3), (2e-3, 2e-3), Some((1.5e-3, 3e-3))),
            Some(1e-3)
        ),
        (exceeds, Some(true))
    );
    // The uncertainty of a rate without an interval is not known, unless its bounds state it.
    assert_eq!(
        judged(&overturns(Some(1e-4), same, None), Some(1e-3)),
        (accepted, None)
    );
    assert_eq!(
        judged(&overturns(Some(2e-3), (5e-4, 3e-3), None), Some(1e-3)),
        (exceeds, Some(false))
    );
    // If a rate is not known, its bounds decide.
    assert_eq!(
        judged(&overturns(None, (0.0, 5e-4), None), Some(1e-3)),
        (accepted, None)
    );
    assert_eq!(
        judged(&overturns(None, (5e-3, 1.0), None), Some(1e-3)),
        (exceeds, None)
    );
    assert_eq!(
        judged(&overturns(None, (0.0, 5e-3), None), Some(1e-3)),
        (None, None)
    );
    // A hazard that begins too high gives only a lower bound.
    let mut cut = overturns(Some(1e-4), same, narrow);
    cut[0].rates.below_first = 2e-3;
    assert_eq!(judged(&cut, Some(1e-3)), (exceeds, Some(false)));
    let both = [
        state(
            LimitState::Exceeds,
            Some(0.1),
            (0.1, 0.1),
            Some((0.05, 0.2)),
        ),
        state(LimitState::Overturns, Some(1e-4), same, narrow),
    ];
    assert_eq!(of(&both, Some(1e-3), Some(1e-2)), (exceeds, Some(true)));
    let without = super::judged(&both[1..], Some(1e-3), Some(1e-2));
    assert_eq!(
        (without.verdict, without.why),
        (None, Some(Unjudged::NoCurve(LimitState::Exceeds)))
    );
    // One rate that is surely too large is enough.
    assert_eq!(
        of(&both[1..], Some(1e-5), Some(1e-2)),
        (exceeds, Some(true))
    );
}

fn cost(repair: f64, replacement: f64) -> CostRow {
    CostRow {
        id: "a".to_owned(),
        line: 2,
        quantity: 2.0,
        has_quantity: true,
        repair: Some(repair),
        replacement: Some(replacement),
        downtime_days: None,
        downtime_cost: None,
        casualty_probability: None,
        casualty_cost: None,
        accepted_rate: None,
        accepted_exceed_rate: None,
        item: String::new(),
        building: String::new(),
        location: String::new(),
        anchored: String::new(),
        life_safety: None,
        floor: None,
        site_deg: None,
    }
}

/// Every pair of rates within the ends, with overturning never above exceeding, has a loss between
/// the bounds, and some pairs of a fine grid come close to both.
#[test]
fn losses_between_the_ends_of_rates_are_within_the_bounds() {
    for (repair, replacement) in [(100.0, 900.0), (900.0, 100.0), (0.0, 900.0), (900.0, 0.0)] {
        let cost = cost(repair, replacement);
        for (e, o) in [
            ((2.0, 6.0), (1.0, 3.0)),
            ((2.0, 2.0), (0.0, 4.0)),
            ((2.0, 6.0), (3.0, 3.0)),
        ] {
            let of = |(least, most)| {
                Some(Interval {
                    least,
                    best: least,
                    most: Some(most),
                })
            };
            let bounds = loss_between([of(e), of(o)], true, &cost);
            let steps = |(least, most): (f64, f64)| {
                (0..=60).map(move |i| least + (most - least) * f64::from(i) / 60.0)
            };
            let pairs = steps(e)
                .flat_map(|e| steps(o).map(move |o| (e, o)))
                .filter(|(e, o)| o <= e);
            let losses: Vec<f64> = pairs
                .map(|(e, o)| expected_annual_loss(2.0, e, o, repair, replacement))
                .collect();
            let (least, most) = (
                losses.iter().copied().fold(f64::INFINITY, f64::min),
                losses.iter().copied().fold(0.0, f64::max),
            );
            let stated = bounds.most.unwrap();
            // Rounding; the ends are of the order of 1000.
            assert!(
                bounds.least <= least + 1e-9 && stated >= most - 1e-9,
                "{bounds:?} {least} {most}"
            );
            // One step of the grid, 4/60 of a rate that costs at most 900 for each of two.
            let tight = 4.0 / 60.0 * 900.0 * 2.0;
            let known_above = o.0 == o.1 && o.0 > e.0;
            assert!(
                known_above || (least - bounds.least < tight && stated - most < tight),
                "{bounds:?} {least} {most}"
            );
        }
    }
}

/// What has no bound has none, unless it costs nothing or the milder state bounds it.
#[test]
fn a_loss_without_a_bound_is_told_so() {
    let open = Some(Interval {
        least: 1.0,
        best: 1.0,
        most: None,
    });
    let known = |rate| Some(Interval::known(rate));
    let most = |e, o, cost: &CostRow| loss_between([e, o], true, cost).most;
    assert_eq!(
        most(known(2.0), open, &cost(100.0, 900.0)),
        Some(2.0 * 2.0 * 900.0)
    );
    assert_eq!(
        most(known(2.0), None, &cost(100.0, 900.0)),
        Some(2.0 * 2.0 * 900.0)
    );
    assert_eq!(most(open, known(1.0), &cost(100.0, 900.0)), None);
    assert_eq!(most(open, known(1.0), &cost(0.0, 900.0)), Some(2.0 * 900.0));
    assert_eq!(most(open, open, &cost(0.0, 900.0)), None);
    let without = loss_between([None, open], false, &cost(100.0, 900.0));
    assert_eq!(
        without,
        LossBounds {
            least: 2.0 * 900.0,
            best: 2.0 * 900.0,
            most: None
        }
    );
}

/// An object that may fail more often than its curves say has no most, whatever its curves.
#[test]
fn a_caution_leaves_a_loss_without_a_bound() {
    let hazard = Hazard::power_law(1.0, 1.0, 1.0).unwrap();
    for kind in [
        CurveKind::None { lower: 2.0 },
        CurveKind::Lognormal {
            median: 2.0,
            beta: 0.3,
        },
    ] {
        let of = |caution| {
            let one = ObjectCurves {
                caution,
                ..curves(&[(LimitState::Overturns, kind)])
            };
            ObjectRisk::new(
                &one,
                None,
                Some(&cost(0.0, 1.0)),
                (&hazard, &[]),
                50.0,
                Some(1.0),
            )
        };
        let (without, with) = (of(None), of(Some(TooMild::Glides)));
        assert!(
            without.loss.unwrap().most.is_some() && without.verdict == Some(RiskVerdict::Accepted)
        );
        assert_eq!(
            (with.loss.unwrap().most, with.is_at_least, with.verdict),
            (None, true, None),
            "{kind:?}"
        );
        assert_eq!(with.expected_annual_loss, without.expected_annual_loss);
    }
}

fn curves(rows: &[(LimitState, CurveKind)]) -> ObjectCurves {
    let curves = rows
        .iter()
        .map(|&(limit_state, kind)| Curve { limit_state, kind })
        .collect();
    let capacities = Vec::new();
    ObjectCurves {
        id: "a".to_owned(),
        measure: Measure::Pgv,
        at: At::Ground,
        curves,
        capacities,
        caution: None,
        line: 2,
    }
}

/// k = 1 and steps: the rate of an intensity x is 1/x.
#[test]
fn an_option_avoids_at_least_what_the_bounds_leave() {
    let hazard = Hazard::power_law(1.0, 1.0, 1.0).unwrap();
    let (exceeds, overturns) = (LimitState::Exceeds, LimitState::Overturns);
    let step = |x| CurveKind::Step { lower: x, upper: x };
    let (none, all) = (
        |lower| CurveKind::None { lower },
        |upper| CurveKind::All { upper },
    );
    let cost = cost(0.0, 1.0);
    let of = |before, after| {
        let changed = Effect::Curves(curves(&[(overturns, after)]));
        let found = avoided(&curves(&[(overturns, before)]), &changed, &cost, &hazard);
        (found.least, found.is_at_least)
    };
    // Of two objects: 2/x before, less 2/x after. Rounding is none with powers of 2.
    assert_eq!(of(step(0.5), step(2.0)), (Some(3.0), false));
    assert_eq!(of(step(0.5), none(2.0)), (Some(3.0), true));
    assert_eq!(of(all(0.5), step(2.0)), (Some(3.0), true));
    assert_eq!(of(all(0.5), none(2.0)), (Some(3.0), true));
    assert_eq!(of(none(0.5), step(2.0)), (Some(-1.0), true));
    assert_eq!(of(step(0.5), all(2.0)), (None, true));
    // Curves without one of overturning, of an object that overturns: exceeding bounds it.
    let with = |rows: &[(LimitState, CurveKind)]| {
        avoided(
            &curves(&[(overturns, step(0.5))]),
            &Effect::Curves(curves(rows)),
            &cost,
            &hazard,
        )
    };
    assert_eq!(with(&[]).least, None);
    assert_eq!(with(&[(exceeds, step(2.0))]).least, Some(3.0));
    // Twice the median never makes anything worse, and half of it may.
    let factor = |factor| {
        avoided(
            &curves(&[(overturns, none(0.5))]),
            &Effect::MedianFactor(factor),
            &cost,
            &hazard,
        )
        .least
    };
    assert_eq!((factor(2.0), factor(0.5)), (Some(0.0), Some(-8.0)));
}

/// Nothing that is known about motions below the hazard may make an option look better.
#[test]
fn an_option_is_charged_with_weak_motions_that_it_adds() {
    let points = [(1.0, 1.0), (2.0, 0.5), (4.0, 0.25)];
    let points = points.map(|(intensity, annual_rate)| HazardPoint {
        intensity,
        annual_rate,
    });
    let hazard = Hazard::points(points.to_vec()).unwrap();
    let step = |x| CurveKind::Step { lower: x, upper: x };
    let of = |after| {
        let changed = Effect::Curves(curves(&[(LimitState::Overturns, step(after))]));
        avoided(
            &curves(&[(LimitState::Overturns, step(2.0))]),
            &changed,
            &cost(0.0, 1.0),
            &hazard,
        )
    };
    // λ(x) = 1/x goes on below 1: at 1/2 the rate is 2, of which 1 is below the first point.
    let worse = of(0.5);
    assert!(
        (worse.least.unwrap() + 2.0 * (2.0 - 0.5)).abs() < 1e-12,
        "{worse:?}"
    );
    assert_eq!((worse.after.most, worse.is_at_least), (None, true));
    assert!((of(4.0).least.unwrap() - 0.5).abs() < 1e-12);
}
