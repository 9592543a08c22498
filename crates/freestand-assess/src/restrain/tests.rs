use freestand_input::keys::Words;
use freestand_study::resolve::resolve;

use super::*;
use crate::restraint::factor::{Factor, FactorKey, FactorSource, Found};
use crate::restraint::source::{Clause, Unread};
use crate::result::reported_force;
use crate::verdict::forces_by_sizes;
use freestand::code_spectrum::part_forces::Governing;
use freestand_inventory::library::Lookup;
use freestand_inventory::{ReadOptions, parse_inventory};

const WEIGHT_N: f64 = 140.0 * 9.80665;

/// Anchors at the edges.
fn at_edges() -> Anchors {
    Anchors {
        inset_m: Some(0.0),
        ..Anchors::default()
    }
}

/// The paper's cabinet, 2.3 m × 0.6 m × 0.9 m, 140 kg.
fn cabinet(hazard: RestrainHazard, level_ratio: Option<f64>) -> RestrainRequest {
    RestrainRequest {
        mass_kg: 140.0,
        height_m: 2.3,
        thickness_m: 0.6,
        width_m: Some(0.9),
        cg_height_m: None,
        hazard,
        floor: RestrainFloor {
            level_ratio,
            ..RestrainFloor::default()
        },
        factors: RestrainFactors::default(),
        component: Some("cabinet".to_owned()),
        // At the edges, so that the numbers below stay simple.
        anchors: at_edges(),
        units: UnitSystem::Si,
        is_compared: false,
    }
}

fn code(words: &[(&'static str, &'static str)]) -> RestrainHazard {
    RestrainHazard::Code(words.iter().copied().collect::<Words>())
}

/// The number of a force that its document has under this name.
fn number_of(case: &Case, name: &str) -> f64 {
    let force = &case.own;
    match name {
        "force_n" => force.force_n,
        "force_ratio" => force.force_ratio(),
        "acts_at_height_m" => case.question.object.cg_height_m,
        "overturning_moment_n_m" => force.overturning_moment_n_m(),
        "resisting_moment_n_m" => force.resisting_moment_n_m(),
        "anchor_inset_m" => force.inset_m(),
        "anchor_tension_n" => force.anchor_tension_n,
        "anchor_tension_concrete_n" => force.anchor_tension_concrete_n,
        "tension_n" => case.each_anchor().tension_n,
        "tension_concrete_n" => case.each_anchor().tension_concrete_n,
        "shear_n" => case.each_anchor().shear_n,
        "bracket_height_m" => force.bracket_height_m,
        "bracket_force_n" => force.bracket_force_n,
        "bracket_base_shear_n" => force.bracket_base_shear_n,
        _ => panic!("{name}"),
    }
}

/// The factors that nobody has read.
fn recalled(case: &Case) -> Vec<FactorKey> {
    let is_recalled = |factor: &&Factor| matches!(factor.source, FactorSource::Recalled(_));
    let factors = case.own.source.factors.iter().filter(is_recalled);
    factors.map(|factor| factor.key).collect()
}

#[track_caller]
fn near(got: f64, expected: f64) {
    // A handful of products of numbers near one, times a weight of some kN.
    assert!(
        (got - expected).abs() < 1e-9 * expected.abs().max(1.0),
        "{got} {expected}"
    );
}

fn problems(request: RestrainRequest) -> String {
    restrain(request).unwrap_err().to_string()
}

/// ASCE 7-16, S_DS = 1 g, roof, a_p = 1, R_p = 2.5, I_p = 1.5: 0.4 · 1 · 3 · 1.5/2.5 = 0.72 W, from
/// 0.45 W to 2.4 W. H = (0.9 − 0.2) W. M_o = 0.72 · 1.15 = 0.828 W m, M_r = 0.7 · 0.3 = 0.21 W m: T =
/// 0.618/0.6 = 1.03 W; in concrete (2 · 0.828 − 0.21)/0.6 = 2.41 W. Each of two: 0.515 W; shear of
/// each of four: 0.18 W. A bracket at 2.07 m: 0.828/2.07 = 0.4 W, at the feet 0.72 · (1 − 0.5556) =
/// 0.32 W.
#[test]
fn asce_7_16_by_hand() {
    let words = [("code", "asce7"), ("edition", "2016"), ("sds", "1 g")];
    let factors = RestrainFactors {
        importance_ratio: Some(1.5),
        ..RestrainFactors::default()
    };
    let report = restrain(RestrainRequest {
        factors,
        ..cabinet(code(&words), Some(1.0))
    })
    .unwrap();
    for (name, ratio) in [
        ("force_n", 0.72),
        ("overturning_moment_n_m", 0.828),
        ("resisting_moment_n_m", 0.21),
        ("anchor_tension_n", 1.03),
        ("anchor_tension_concrete_n", 2.41),
        ("tension_n", 0.515),
        ("shear_n", 0.18),
        ("bracket_force_n", 0.4),
        ("bracket_base_shear_n", 0.32),
    ] {
        near(number_of(&report, name) / WEIGHT_N, ratio);
    }
    near(number_of(&report, "force_ratio"), 0.72);
    near(number_of(&report, "acts_at_height_m"), 1.15);
    assert_eq!(report.own.source.clause, Clause::Asce7_16);
    let factor = |key| {
        let factor = report.own.source.factor(key).unwrap();
        (factor.value, factor.source)
    };
    assert_eq!(factor(FactorKey::Importance), (1.5, FactorSource::Given));
    assert_eq!(factor(FactorKey::Amplification), (1.0, FactorSource::Read));
    let found = FactorSource::Found(Found::Hazard);
    assert_eq!(factor(FactorKey::Sds), (1.0, found));
    assert!(report.others.is_empty());
}

/// 800 lb, 24 in. deep, held 3 in. inside the edge: the moment is that at the edge, the lever 21 in.
/// in place of 24 in., so the tension is 24/21 = 1.143 times that at the edge. By hand, F = m a with 0.9
/// g, c = 36 in., e = 12 in.: T = (0.9 · 36 − 0.9 · 12)/21 W = 1.0286 W; at the edge 0.9 W. Without a
/// stated distance 75 mm: (0.9 · 914.4 − 0.9 · 304.8)/(609.6 − 75) W = 1.02626 W.
#[test]
fn anchors_inside_the_edge_have_a_shorter_lever() {
    let at = |inset_m| {
        let anchors = Anchors {
            inset_m,
            ..Anchors::default()
        };
        let object = RestrainRequest {
            mass_kg: 362.874,
            height_m: 1.8288,
            thickness_m: 0.6096,
            width_m: None,
            anchors,
            ..cabinet(RestrainHazard::FloorAcceleration(0.9), None)
        };
        restrain(object)
    };
    let weight_n = 362.874 * 9.80665;
    let tension = |inset_m| number_of(&at(inset_m).unwrap(), "anchor_tension_n") / weight_n;
    near(tension(Some(0.0)), 0.9);
    near(tension(Some(0.0762)), 0.9 * 24.0 / 21.0);
    near(tension(None), 0.9 * 609.6 / (609.6 - 75.0));
    let assumed = at(None).unwrap();
    near(number_of(&assumed, "anchor_inset_m"), 0.075);
    assert_eq!(
        assumed.assumptions.last(),
        Some(&RestraintAssumption::Inset(0.075)),
        "{:?}",
        assumed.assumptions
    );
    assert!(
        at(Some(0.31))
            .unwrap_err()
            .to_string()
            .contains("half of the base")
    );
}

/// Statics by hand, with F = m a: 0.9 g on W at c = 36 in., B = 24 in., a = 3 in., H = 0.9 W. About the
/// edge the moments are 0.9 · 36 − 0.9 · 12 on a lever of 24 − 3; about the feet 0.9 · 36 − 0.9 · (12 − 3)
/// on 24 − 6. With the reaction at the pivot, forces and moments are in balance: the sum of moments
/// about any other point, here the middle of the base, is 0 as well.
#[test]
fn an_object_tips_about_its_edge_or_its_feet() {
    let held = |pivot| {
        restrain(RestrainRequest {
            mass_kg: 362.874,
            height_m: 1.8288,
            thickness_m: 0.6096,
            width_m: None,
            anchors: Anchors {
                inset_m: Some(0.0762),
                pivot,
                ..Anchors::default()
            },
            ..cabinet(RestrainHazard::FloorAcceleration(0.9), None)
        })
        .unwrap()
    };
    let weight_n = 362.874 * 9.80665;
    for (pivot, ratio, pivot_in) in [
        (Pivot::Edge, (0.9 * 36.0 - 0.9 * 12.0) / 21.0, 12.0),
        (Pivot::Feet, (0.9 * 36.0 - 0.9 * 9.0) / 18.0, 9.0),
    ] {
        let case = held(pivot);
        let tension = number_of(&case, "anchor_tension_n") / weight_n;
        near(tension, ratio);
        // About the middle: F c, the tension at 9 in. on one side, the reaction T + H at the pivot.
        near(0.9 * 36.0, tension * 9.0 + (tension + 0.9) * pivot_in);
        near(case.own.anchor_lever_m(), (9.0 + pivot_in) * 0.0254);
    }
}

/// Feet 200 mm inside a base of 500 mm are apart, inside one of 400 mm they meet: the lever of the weight
/// would be 0.
#[test]
fn the_weight_stands_between_the_feet() {
    let pivot = |base_thickness_m| {
        let kind = ObjectKind {
            base_thickness_m: Some(base_thickness_m),
            ..ObjectKind::default()
        };
        let anchors = Anchors {
            inset_m: Some(0.2),
            pivot: Pivot::Feet,
            ..Anchors::default()
        };
        let request = RestrainRequest {
            anchors,
            ..cabinet(RestrainHazard::FloorAcceleration(0.9), None)
        };
        case_of(request, Ok(kind))
    };
    assert!(pivot(0.5).is_ok());
    let refused = pivot(0.4).unwrap_err().to_string();
    assert!(refused.contains("half of the base"), "{refused}");
}

/// 1.275 W over two anchors, 0.9 W over four: N = 0.6375 W, V = 0.225 W. With Ω_0 = 1 concrete changes
/// nothing. Capacities of W and W/2: 0.6375, and 0.45 more.
#[test]
fn a_chosen_anchor_is_compared() {
    let with = |shear_n| {
        let chosen = Anchor {
            name: Some("M10".to_owned()),
            tension_n: WEIGHT_N,
            shear_n,
        };
        let anchors = Anchors {
            chosen: Some(chosen),
            ..at_edges()
        };
        let request = RestrainRequest {
            anchors,
            ..cabinet(RestrainHazard::FloorAcceleration(0.9), None)
        };
        restrain(request).unwrap().demand_capacity_ratio().unwrap()
    };
    near(with(None), 0.6375);
    near(with(Some(0.5 * WEIGHT_N)), 0.6375 + 0.45);
    // In concrete both are larger by ASCE 7: (2 · 0.48 · 1.15 − 0.21)/0.6/2 and 2 · 0.48/4.
    let words = [("code", "asce7"), ("edition", "2016"), ("sds", "1 g")];
    let case = restrain(cabinet(code(&words), Some(1.0))).unwrap();
    let each = case.each_anchor();
    near(
        each.tension_concrete_n / WEIGHT_N,
        (0.96 * 1.15 - 0.21) / 1.2,
    );
    near(each.shear_concrete_n / WEIGHT_N, 0.24);
}

/// TBDY 2018, from Ss of the places on ZC: Istanbul 0.999 g (F_S 1.2), S_DS = 1.1988 g; Ankara
/// 0.347 g (F_S 1.3), S_DS = 0.4511 g. A cabinet has B_e = 1, R_e = 2.5: on the roof 0.4 · 3/2.5 S_DS = 0.48 S_DS; on the ground
/// 0.16 S_DS, raised to 0.3 S_DS I. All of it is recalled.
#[test]
fn tbdy_2018_by_hand() {
    for (place, sds_g) in [("Istanbul", 0.999 * 1.2), ("Ankara", 0.347 * 1.3)] {
        let at = |level_ratio| {
            let words = [("place", place), ("site", "ZC")];
            restrain(cabinet(code(&words), Some(level_ratio))).unwrap()
        };
        let roof = at(1.0);
        assert_eq!(roof.own.source.clause, Clause::Tbdy2018);
        near(number_of(&roof, "force_ratio"), 0.48 * sds_g);
        let ground = at(0.0);
        near(number_of(&ground, "force_ratio"), 0.3 * sds_g);
        assert_eq!(ground.own.source.part.governing, Governing::Minimum);
        assert_eq!(
            recalled(&roof),
            [
                FactorKey::Amplification,
                FactorKey::Response,
                FactorKey::Overstrength
            ]
        );
        assert!(!roof.own.source.to_confirm.is_empty());
    }
}

/// TS 1170.5, from the PGA of the settlements on site III, 0.91 and 0.18 g at 500 years: a rigid part on the roof has C_Hi = 1 + 2.5, so 3.5 PGA;
/// at mid-height with R_p = 1.3 and a response of 2: 2.25 · 1.3/2 PGA. All of it is recalled.
#[test]
fn ts_1170_5_by_hand() {
    for (place, pga_g) in [("Wellington", 0.91), ("Auckland", 0.18)] {
        let at = |level_ratio, factors| {
            let words = [("place", place), ("code", "ts1170.5"), ("site", "III")];
            restrain(RestrainRequest {
                factors,
                ..cabinet(code(&words), Some(level_ratio))
            })
            .unwrap()
        };
        let roof = at(1.0, RestrainFactors::default());
        assert_eq!(roof.own.source.clause, Clause::Ts1170_5);
        near(number_of(&roof, "force_ratio"), 3.5 * pga_g);
        assert_eq!(
            recalled(&roof),
            [
                FactorKey::BuildingDuctility,
                FactorKey::Amplification,
                FactorKey::Response,
                FactorKey::Importance,
                FactorKey::Overstrength
            ]
        );
        let factors = RestrainFactors {
            importance_ratio: Some(1.3),
            response_ratio: Some(2.0),
            ..RestrainFactors::default()
        };
        near(
            number_of(&at(0.5, factors), "force_ratio"),
            2.25 * 1.3 / 2.0 * pga_g,
        );
    }
}

/// NTC 2018, 7.2.3: F_a = S_a W/q_a with S_a of EN 1998-1: ag S_S (1 + 1.5 z/H) for a rigid part and
/// q_a = 2 for a cabinet; on ground A S_S = 1. The annex has 0.2607 g for L'Aquila and 0.121 g for Rome at 475
/// years: at other points of the towns, so ag is that of the grid within 1 %.
#[test]
fn ntc_2018_by_hand() {
    for (place, ag_g) in [("L'Aquila", 0.2607), ("Rome", 0.121)] {
        for (level_ratio, factor) in [(0.0, 1.0), (0.5, 1.75), (1.0, 2.5)] {
            let words = [("place", place), ("code", "ntc2018"), ("site", "A")];
            let case = restrain(cabinet(code(&words), Some(level_ratio))).unwrap();
            let at_ground_g = case.target.as_ref().unwrap().spectrum.sa_g(0.0);
            assert!((at_ground_g / ag_g - 1.0).abs() < 0.01, "{at_ground_g}");
            near(number_of(&case, "force_ratio"), at_ground_g * factor / 2.0);
            assert_eq!(case.own.source.clause, Clause::Ntc2018);
        }
    }
}

/// On the roof, S_DS = 1 g, ASCE 7-16: 0.4 · 3 a_p/R_p. Switchgear 2.5/6: 0.5 W; on isolators 2.5/2:
/// 1.5 W; a generator 1/2.5: 0.48 W; not known 1/1.5: 0.8 W. EN 1998-1 divides by 2 for a cabinet alone:
/// 0.288 · 2.5 = 0.72 W.
#[test]
fn a_generator_is_no_cabinet() {
    let words = [("code", "asce7"), ("edition", "2016"), ("sds", "1 g")];
    let of = |words: &[(&'static str, &'static str)], component: Option<&str>| {
        let component = component.map(str::to_owned);
        restrain(RestrainRequest {
            component,
            ..cabinet(code(words), Some(1.0))
        })
    };
    let ratio = |component| number_of(&of(&words, component).unwrap(), "force_ratio");
    near(ratio(Some("switchgear")), 0.5);
    near(ratio(Some("isolated")), 1.5);
    near(ratio(Some("Emergency generator, 200 kVA")), 0.48);
    near(ratio(None), 0.8);
    let unnamed = of(&words, None).unwrap();
    let unread = &unnamed.own.source.to_confirm;
    assert!(unread.contains(&Unread::Component));
    let europe = [
        ("code", "eurocode8"),
        ("ground_acceleration", "0.24 g"),
        ("spectrum_type", "1"),
        ("site", "B"),
    ];
    near(
        number_of(&of(&europe, Some("cabinet")).unwrap(), "force_ratio"),
        0.36,
    );
    near(
        number_of(&of(&europe, Some("generator")).unwrap(), "force_ratio"),
        0.72,
    );
    assert!(
        of(&words, Some("gizmo"))
            .unwrap_err()
            .to_string()
            .contains("give one of cabinet, shelving, generator")
    );
}

/// California has adopted ASCE 7-22; an edition that is stated counts, and elsewhere the one of the
/// mapped values.
#[test]
fn the_edition_in_force() {
    let by = |words: &[(&'static str, &'static str)]| {
        let case = restrain(cabinet(code(words), Some(1.0))).unwrap();
        case.own.source.clause
    };
    assert_eq!(by(&[("place", "Los Angeles")]), Clause::Asce7_22);
    assert_eq!(
        by(&[("place", "Los Angeles"), ("edition", "2016")]),
        Clause::Asce7_16
    );
    assert_eq!(by(&[("place", "Seattle")]), Clause::Asce7_16);
}

/// What nobody has read is to be confirmed; a value that the user gives is not.
#[test]
fn recalled_values_are_to_be_confirmed() {
    let words = [
        ("code", "eurocode8"),
        ("ground_acceleration", "0.24 g"),
        ("spectrum_type", "1"),
        ("site", "B"),
    ];
    let report = restrain(cabinet(code(&words), Some(0.5))).unwrap();
    assert!(recalled(&report).contains(&FactorKey::Response));
    let factors = RestrainFactors {
        response_ratio: Some(2.0),
        ..RestrainFactors::default()
    };
    let given = restrain(RestrainRequest {
        factors,
        ..cabinet(code(&words), Some(0.5))
    })
    .unwrap();
    assert!(!recalled(&given).contains(&FactorKey::Response));
    // Of every code: no factor is printed as sourced that is not.
    for words in [
        &[("place", "Melbourne")][..],
        &[("place", "Wellington")],
        &[("place", "Seattle")],
    ] {
        let report = restrain(cabinet(code(words), Some(0.5))).unwrap();
        let is_all_read = recalled(&report).is_empty() && report.own.source.to_confirm.is_empty();
        assert!(!is_all_read, "{words:?}");
    }
}

/// ASCE 7-22, S_DS = 1.2 g, mid-height, period not known: H_f = 1 + 2.5 · 0.5 = 2.25; C_AR = 2.2, R_po
/// = 1.5, R_μ = 1.5: 0.4 · 1.2 · 2.25/1.5 · 2.2/1.5 = 1.056 W, below 1.92 W. On the ground R_μ = 1 and
/// H_f = 1: 0.48 · 2.2/1.5 = 0.704 W.
#[test]
fn asce_7_22_by_hand() {
    let words = [("code", "asce7"), ("edition", "2022"), ("sds", "1.2 g")];
    let factors = RestrainFactors {
        resonance_ratio: Some(2.2),
        strength_ratio: Some(1.5),
        building_ductility_ratio: Some(1.5),
        ..RestrainFactors::default()
    };
    let at = |level| {
        restrain(RestrainRequest {
            factors,
            ..cabinet(code(&words), level)
        })
        .unwrap()
    };
    near(number_of(&at(Some(0.5)), "force_ratio"), 1.056);
    near(number_of(&at(None), "force_ratio"), 0.704);
    assert!(at(None).assumptions.contains(&RestraintAssumption::Ground));
}

/// AS 1170.4, Z = 0.11 (600 years do not matter: 500), class Ce: Ch(0) = 1.3, kpZ Ch(0) = 0.143 g.
/// Floor 2 of 3 storeys of 3 m, a low building: a_x = 1 + 0.17 · 6 = 2.02; a_c = 2.5, R_c = 2.5, I_c =
/// 1: 0.28886 W, from 0.05 W to 0.5 W; T = (0.28886 · 1.15 − 0.9 · 0.3)/0.6.
#[test]
fn as_1170_4_by_hand() {
    let words = [
        ("code", "as1170.4"),
        ("hazard_factor", "0.11"),
        ("site", "Ce"),
    ];
    let floor = RestrainFloor {
        name: Some("2".to_owned()),
        storeys: Some(3),
        storey_height_m: Some(3.0),
        ..RestrainFloor::default()
    };
    let factors = RestrainFactors {
        amplification_ratio: Some(2.5),
        response_ratio: Some(2.5),
        ..RestrainFactors::default()
    };
    let report = restrain(RestrainRequest {
        floor,
        factors,
        ..cabinet(code(&words), None)
    })
    .unwrap();
    near(number_of(&report, "force_ratio"), 0.143 * 2.02);
    near(
        number_of(&report, "anchor_tension_n") / WEIGHT_N,
        (0.143 * 2.02 * 1.15 - 0.27) / 0.6,
    );
    assert_eq!(report.own.source.clause, Clause::As1170_4);
}

/// NZS 1170.5, Wellington (Z = 0.4, 500 years: R = 1), class C: C(0) = 1.33 · 0.4 = 0.532 g; at a fifth
/// of the height and above C_Hi = 3; C_i = 2: 3.192 W, below 3.6 W. At a tenth C_Hi = 2 and with
/// response 2 C_ph = 0.5: 0.532 · 2 · 2 · 0.5 = 1.064 W.
#[test]
fn nzs_1170_5_by_hand() {
    let words = [("place", "Wellington"), ("site", "C")];
    near(
        number_of(
            &restrain(cabinet(code(&words), Some(1.0))).unwrap(),
            "force_ratio",
        ),
        3.192,
    );
    let factors = RestrainFactors {
        response_ratio: Some(2.0),
        ..RestrainFactors::default()
    };
    let request = RestrainRequest {
        factors,
        ..cabinet(code(&words), Some(0.1))
    };
    near(number_of(&restrain(request).unwrap(), "force_ratio"), 1.064);
    let factors = RestrainFactors {
        importance_ratio: Some(1.3),
        ..RestrainFactors::default()
    };
    let report = restrain(RestrainRequest {
        factors,
        ..cabinet(code(&words), Some(1.0))
    })
    .unwrap();
    near(number_of(&report, "force_ratio"), 3.6);
    let force = &report.own.source.part;
    assert_eq!(force.governing, Governing::Maximum);
    assert_eq!(force.maximum_ratio, Some(3.6));
}

/// EN 1998-1, a_gR = 0.24 g, type 1, ground B (S = 1.2): α S = 0.288; z/H = 0.5, rigid, γ_a = 1.5, q_a
/// = 2: 0.288 · (3 · 1.5/2 − 0.5) · 1.5/2 = 0.378 W.
#[test]
fn eurocode_8_by_hand() {
    let words = [
        ("code", "eurocode8"),
        ("ground_acceleration", "0.24 g"),
        ("spectrum_type", "1"),
        ("site", "B"),
    ];
    let factors = RestrainFactors {
        importance_ratio: Some(1.5),
        ..RestrainFactors::default()
    };
    let report = restrain(RestrainRequest {
        factors,
        ..cabinet(code(&words), Some(0.5))
    })
    .unwrap();
    near(number_of(&report, "force_ratio"), 0.378);
    assert_eq!(report.own.source.clause, Clause::Eurocode8);
}

/// F = m a: 0.9 W; T = (0.9 · 1.15 − 0.27)/0.6 = 1.275 W.
#[test]
fn a_floor_acceleration_by_hand() {
    let report = restrain(cabinet(RestrainHazard::FloorAcceleration(0.9), None)).unwrap();
    near(number_of(&report, "force_ratio"), 0.9);
    near(number_of(&report, "anchor_tension_n") / WEIGHT_N, 1.275);
    assert_eq!(report.own.source.clause, Clause::GivenFloor);
    assert_eq!(report.floor, StandsOn::Accelerated);
    assert!(!report.assumptions.contains(&RestraintAssumption::Ground));
}

/// Other codes are shown where they are asked for.
#[test]
fn other_codes() {
    let request = |is_compared| RestrainRequest {
        is_compared,
        ..cabinet(code(&[("place", "Athens")]), Some(1.0))
    };
    let report = restrain(request(true)).unwrap();
    let others: Vec<_> = report.others.iter().map(|one| one.source.clause).collect();
    assert_eq!(
        others,
        [Clause::As1170_4, Clause::Asce7_16, Clause::Asce7_22]
    );
    assert!(restrain(request(false)).unwrap().others.is_empty());
}

/// The same object in a list and alone: force and tension are equal to the bit. The list has it
/// anchored, so that nothing must be simulated.
#[test]
fn a_list_and_a_single_object_agree() {
    let toml = "[ground]\nplace = \"Newcastle\"\nsite = \"Ee\"\n[building]\nstoreys = 8\n[restraint]\nresponse_ratio = \
                1.5\nbracket_height = \"1.9 m\"\n";
    let study = resolve(toml, None, "".as_ref()).unwrap();
    let csv = "id,height [mm],thickness [mm],width [mm],mass [kg],cg height [mm],floor,life safety,anchored\n\
               a,2300,600,900,140,1300,3,M,yes\nb,1800,500,700,90,,roof,,yes\nc,2300,600,900,140,1300,3,H,yes\n";
    let options = ReadOptions {
        floors: floors_of(&study, None),
        ..ReadOptions::new(&Lookup::NONE)
    };
    let read = parse_inventory(csv.as_bytes().to_vec(), "list.csv".as_ref(), &options);
    let items = read.unwrap().inventory.items;
    let alone =
        |height_m, (thickness_m, width_m), mass_kg, cg_height_m, floor: &str, importance_ratio| {
            RestrainRequest {
                height_m,
                thickness_m,
                width_m: Some(width_m),
                mass_kg,
                cg_height_m,
                floor: RestrainFloor {
                    name: Some(floor.to_owned()),
                    ..RestrainFloor::default()
                },
                factors: RestrainFactors {
                    importance_ratio,
                    ..RestrainFactors::default()
                },
                component: None,
                anchors: Anchors::default(),
                ..cabinet(RestrainHazard::Study(Arc::new(study.clone())), None)
            }
        };
    let singles = [
        alone(2.3, (0.6, 0.9), 140.0, Some(1.3), "3", None),
        alone(1.8, (0.5, 0.7), 90.0, None, "roof", None),
        // Life safety is rated high.
        alone(2.3, (0.6, 0.9), 140.0, Some(1.3), "3", Some(1.5)),
    ];
    for (item, request) in items.iter().zip(singles) {
        let forces = forces_by_sizes(&study, item);
        let listed = reported_force(&forces).unwrap();
        let report = restrain(request).unwrap();
        let numbers = [
            "force_n",
            "anchor_tension_n",
            "anchor_tension_concrete_n",
            "bracket_force_n",
        ];
        let alone = numbers.map(|name| number_of(&report, name).to_bits());
        let listed = [
            listed.force_n,
            listed.anchor_tension_n,
            listed.anchor_tension_concrete_n,
            listed.bracket_force_n,
        ];
        assert_eq!(alone, listed.map(f64::to_bits), "{}", item.id);
    }
    assert_eq!(items.len(), 3);
}

#[test]
fn bad_requests_say_what_is_wrong() {
    let melbourne = || code(&[("place", "Melbourne")]);
    let floor = |name: Option<&str>, level_ratio, storeys| RestrainFloor {
        name: name.map(str::to_owned),
        level_ratio,
        storeys,
        storey_height_m: None,
    };
    let on = |floor| {
        problems(RestrainRequest {
            floor,
            ..cabinet(melbourne(), None)
        })
    };
    assert!(on(floor(Some("3"), None, None)).contains("`floor` needs `storeys`"));
    assert!(on(floor(Some("3"), Some(0.5), Some(6))).contains("exclude each other"));
    assert!(on(floor(Some("9"), None, Some(6))).contains("is not a floor of the building"));
    assert!(on(floor(None, Some(1.2), None)).contains("`level_ratio` must be"));
    assert!(on(floor(None, None, Some(6))).contains("no floor of it is named"));
    let with = |factors| {
        problems(RestrainRequest {
            factors,
            ..cabinet(melbourne(), None)
        })
    };
    let none = RestrainFactors::default();
    assert!(
        with(RestrainFactors {
            strength_ratio: Some(1.5),
            ..none
        })
        .contains("`strength` is not a factor of AS 1170.4")
    );
    assert!(
        with(RestrainFactors {
            building_ductility_ratio: Some(1.0),
            ..none
        })
        .contains("at least 1.3")
    );
    assert!(
        with(RestrainFactors {
            importance_ratio: Some(0.01),
            ..none
        })
        .contains("`importance` must be between")
    );
    let sized = |height_m| {
        problems(RestrainRequest {
            height_m,
            ..cabinet(melbourne(), None)
        })
    };
    assert!(sized(1.8e6).contains("no object has 1800000 m"));
    let told = restrain(cabinet(melbourne(), None)).unwrap().doubts;
    assert!(
        matches!(told[..], [RestraintDoubt::ComponentUnused(by), ..] if by.starts_with("AS 1170.4")),
        "{told:?}"
    );
    let of_a_spectrum = code(&[("code", "asce7"), ("sds", "1 g"), ("sd1", "0.6 g")]);
    let told = restrain(cabinet(of_a_spectrum, None)).unwrap().doubts;
    assert!(told.contains(&RestraintDoubt::NoEffect("sd1")), "{told:?}");
    let newer = code(&[("code", "asce7"), ("sds", "1 g")]);
    let factors = RestrainFactors {
        response_ratio: Some(2.5),
        ..none
    };
    assert!(
        problems(RestrainRequest {
            factors,
            ..cabinet(newer, None)
        })
        .contains("`response` is not a factor of ASCE 7-22")
    );
    let given = || RestrainHazard::FloorAcceleration(0.9);
    assert!(
        problems(RestrainRequest {
            is_compared: true,
            ..cabinet(given(), None)
        })
        .contains("no spectrum")
    );
    assert!(problems(cabinet(given(), Some(0.5))).contains("no meaning beside it"));
    assert!(
        problems(RestrainRequest {
            cg_height_m: Some(3.0),
            ..cabinet(melbourne(), None)
        })
        .contains("height")
    );
    let mut study = resolve("[building]\nstoreys = 30\n", None, "".as_ref()).unwrap();
    study.ground = freestand_study::study::Ground::Recorded(Vec::new());
    assert!(
        problems(cabinet(RestrainHazard::Study(Arc::new(study)), None))
            .contains("the study names no code")
    );
}
