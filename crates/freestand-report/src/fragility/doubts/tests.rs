//! Every doubt beside fragilities, hazards, costs and exports in words.

use std::path::PathBuf;

use freestand::fragility::{Crossing, LimitState, ShockFitError};
use freestand_inventory::too_mild::TooMild;
use freestand_records::tables::hazard::Statistic;
use freestand_risk::export::{ExportDoubt, ExportFormat};
use freestand_risk::fragility::Measure;
use strum::{EnumCount, VariantArray as _};

use super::super::exports;
use super::*;

fn names(all: &[&str]) -> Vec<String> {
    all.iter().map(|one| (*one).to_owned()).collect()
}

/// None is forgotten: as many kinds are listed as there are.
fn all<T: EnumCount>(listed: &[T]) {
    let kinds: std::collections::HashSet<_> = listed.iter().map(std::mem::discriminant).collect();
    assert_eq!(kinds.len(), T::COUNT);
}

#[test]
fn every_doubt_in_words() {
    let first = |crossing| Contradiction {
        id: "shelf".to_owned(),
        measure: Measure::Pgv,
        from: 0.02,
        to: 0.4935,
        mild: LimitState::Exceeds,
        severe: LimitState::Overturns,
        crossing,
    };
    let fit = |id: &str, doubt| CurveDoubt::Fit {
        id: id.to_owned(),
        doubt,
    };
    let mut curves: Vec<CurveDoubt> = TooMild::VARIANTS
        .iter()
        .zip([1, 2, 3])
        .map(|(why, count)| CurveDoubt::TooMild {
            why: *why,
            ids: names(&["a", "b", "c"][..count]),
        })
        .collect();
    curves.extend([
        CurveDoubt::Contradiction {
            first: first(Some(0.4935)),
            also: names(&["o2", "o3", "o4", "o5", "o6"]),
        },
        CurveDoubt::Contradiction {
            first: first(None),
            also: Vec::new(),
        },
    ]);
    let state = LimitState::Overturns;
    let fits = [
        FitDoubt::NotByShock(ShockFitError::NoMaximum),
        FitDoubt::Unresolved {
            runs: 1,
            reasons: Vec::new(),
        },
        FitDoubt::Unresolved {
            runs: 5,
            reasons: names(&["it flies", "it spins", "it bounces", "it hums"]),
        },
        FitDoubt::Crossing(Crossing {
            states: [LimitState::Exceeds, state],
            intensity: 0.4935,
        }),
        FitDoubt::Misfit { p_value: 0.005 },
        FitDoubt::NotIncreasing(state),
        FitDoubt::OnlyBounds(state),
        FitDoubt::NoInterval {
            state,
            why: NoInterval::FewCurves {
                known: 40,
                samples: 100,
            },
        },
        FitDoubt::NoInterval {
            state,
            why: NoInterval::AllEqual,
        },
        FitDoubt::FewMotions(12),
        FitDoubt::FailedSamples {
            failed: 30,
            samples: 1000,
        },
    ];
    all(&fits);
    curves.extend(fits.into_iter().map(|doubt| fit("a", doubt)));
    // What more than three objects share is said once.
    curves.extend(["b", "c", "d"].map(|id| fit(id, FitDoubt::FewMotions(12))));
    curves.extend(["b", "c"].map(|id| fit(id, FitDoubt::NotIncreasing(state))));
    all(&curves);
    let hazards = [
        HazardDoubt::IdleSite,
        HazardDoubt::CertainPoints(1),
        HazardDoubt::EqualPoints(3),
        HazardDoubt::SiteAway { metres: 2345 },
        HazardDoubt::OtherThanMean(Statistic::Quantile(0.95)),
        HazardDoubt::OtherThanMean(Statistic::Realization),
        HazardDoubt::DesignAccelerations,
        HazardDoubt::SlopeOfPlace,
        HazardDoubt::AssumedSite("site class C".to_owned()),
    ];
    all(&hazards);
    let (path, id) = (PathBuf::from("i.csv"), "a".to_owned());
    let unused = |heading: &str, near: Option<&str>| UnusedColumn {
        heading: heading.to_owned(),
        near: near.map(str::to_owned),
    };
    let unused = [
        unused("qty", None),
        unused("repair_costs [AUD]", Some("repair_cost")),
    ];
    let costs = [
        CostDoubt::OfList("row 3: \"many\" is no downtime: it is not counted".to_owned()),
        CostDoubt::Unused {
            path: path.clone(),
            columns: unused[..1].to_vec(),
        },
        CostDoubt::Unused {
            path: path.clone(),
            columns: unused.to_vec(),
        },
        CostDoubt::NoQuantity {
            path: path.clone(),
            rows: 1,
        },
        CostDoubt::NoQuantity {
            path: path.clone(),
            rows: 2,
        },
        CostDoubt::DearRepair { path, line: 2, id },
    ];
    all(&costs);
    let changed = |format, count, allowed, longest| ExportDoubt::ChangedIds {
        format,
        count,
        id: "CAB-01".to_owned(),
        exported: "FS.CAB_01".to_owned(),
        allowed,
        longest,
    };
    let exported = [
        ExportDoubt::Cost(costs[0].clone()),
        ExportDoubt::Hazard(HazardDoubt::DesignAccelerations),
        ExportDoubt::NotInInventory("a".to_owned()),
        ExportDoubt::NoneOfIt("a".to_owned()),
        changed(ExportFormat::Pelicun, 1, "_.", None),
        changed(ExportFormat::OpenQuake, 2, "_-", Some(50)),
        ExportDoubt::InDollars("AUD".to_owned()),
        ExportDoubt::NoReplacement(names(&["b"])),
        ExportDoubt::NoReplacement(names(&["b", "c"])),
    ];
    all(&exported);
    let mut told = curve_doubts(&curves);
    told.extend(hazards.iter().map(hazard_doubt));
    told.extend(costs.iter().map(cost_doubt));
    told.extend(exported.iter().skip(2).map(exports::doubt));
    insta::assert_snapshot!(told.join("\n"));
}
