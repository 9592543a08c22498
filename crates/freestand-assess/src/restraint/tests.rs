use freestand::code_spectrum::part_forces::Governing;
use freestand::code_spectrum::{
    As1170_4, Asce7, Asce7Edition, Edition, Eurocode8, GroundType, Interpolation, Nzs1170_5,
    OutOfRange, SiteClass, SpectrumTable, SpectrumType, SubsoilClass,
};
use freestand_study::study::assessment::Bracket;

use super::*;
use crate::restraint::factor::{Assumed, FactorKey, FactorSource};
use crate::restraint::source::{Clause, Unread};

const WEIGHT_N: f64 = 140.0 * 9.80665;

/// The paper's cabinet, 2.3 m × 0.6 m × 0.9 m, on the roof of a tower.
fn cabinet(spectrum: Option<CodeSpectrum>) -> RestraintQuestion {
    let axis = |axis, base_m: f64| RestraintAxis {
        axis,
        base_m,
        weight_lever_m: base_m / 2.0,
    };
    RestraintQuestion {
        object: HeldObject {
            mass_kg: 140.0,
            height_m: 2.3,
            cg_height_m: 1.15,
            axes: vec![axis(Axis::Thickness, 0.6), axis(Axis::Width, 0.9)],
            level_ratio: 1.0,
            is_critical: false,
            component: Component::find("cabinet"),
        },
        building_height_m: Some(96.0),
        building_period_s: Some(3.0),
        spectrum,
        parts_edition: None,
        floor_acceleration_g: Some(0.4),
        is_floor_given: false,
        // At the edges, so that the numbers below stay simple.
        settings: RestraintSettings {
            anchor_inset_m: Some(0.0),
            ..RestraintSettings::default()
        },
        pivot: Pivot::Edge,
    }
}

/// The same question for another object.
fn other(question: RestraintQuestion, change: impl Fn(&mut HeldObject)) -> RestraintQuestion {
    let mut question = question;
    change(&mut question.object);
    question
}

/// The cabinet with other settings.
fn set(question: RestraintQuestion, change: impl Fn(&mut RestraintSettings)) -> RestraintQuestion {
    let mut question = question;
    change(&mut question.settings);
    question
}

fn melbourne() -> CodeSpectrum {
    As1170_4::new(Edition::default(), SiteClass::De, 0.08, 500)
        .unwrap()
        .into()
}

/// S_DS = 1 g.
fn america(edition: Asce7Edition) -> CodeSpectrum {
    Asce7::new(edition, 1.0, 0.6, 8.0).unwrap().into()
}

fn of(forces: &[RestraintForce], clause: Clause) -> &RestraintForce {
    forces
        .iter()
        .find(|force| force.source.clause == clause)
        .unwrap()
}

fn clauses(forces: &[RestraintForce]) -> Vec<Clause> {
    forces.iter().map(|force| force.source.clause).collect()
}

/// The value of a factor, and who says so.
fn factor(force: &RestraintForce, key: FactorKey) -> (f64, FactorSource) {
    let factor = force.source.factor(key).unwrap();
    (factor.value, factor.source)
}

/// F/W, T/W and T_c/W.
fn held(forces: &[RestraintForce], clause: Clause) -> [f64; 3] {
    let force = of(forces, clause);
    near([force.force_n / WEIGHT_N], [force.force_ratio()]);
    [
        force.force_ratio(),
        force.anchor_tension_n / WEIGHT_N,
        force.anchor_tension_concrete_n / WEIGHT_N,
    ]
}

/// P/W, P_c/W and V/W.
fn bracketed(force: &RestraintForce) -> [f64; 3] {
    [
        force.bracket_force_n,
        force.bracket_force_concrete_n,
        force.bracket_base_shear_n,
    ]
    .map(|n| n / WEIGHT_N)
}

#[track_caller]
fn near<const N: usize>(got: [f64; N], expected: [f64; N]) {
    // A handful of products of numbers near one.
    assert!(
        got.iter()
            .zip(&expected)
            .all(|(got, expected)| (got - expected).abs() < 1e-12),
        "{got:?} {expected:?}"
    );
}

/// kpZ Ch(0) = 0.088 g, a_x = 3: 0.264 W. T = (0.264 · 1.15 − 0.9 · 0.3)/0.6 W = 0.056 W; across
/// the width (0.3036 − 0.405)/0.9 < 0. S_DS = 0.088/1.1 · 3.68 = 0.2944 g, H = (0.9 − 0.05888) W.
/// 16: F = 0.4 · 0.2944 · 3/2.5 = 0.141312 W; T < 0, T_c = (0.2826240 · 1.15 − 0.84112 · 0.3)/0.6 =
/// 0.121136 W. 22 (T = 3 s: a1 = 1/3, a2 = 1 − (0.4/3)²): H_f = 1 + 0.3333 + 0.98222 = 2.315556,
/// 0.4 · 0.2944 · 2.315556/1.3/1.5 = 0.139836 W: both above 0.3 S_DS = 0.08832.
#[test]
fn the_cabinet_in_melbourne_by_hand() {
    let forces = restraint_forces(&cabinet(Some(melbourne())));
    let expected = [
        Clause::As1170_4,
        Clause::ComputedFloor,
        Clause::Asce7_16,
        Clause::Asce7_22,
    ];
    assert_eq!(clauses(&forces), expected);
    near(held(&forces, Clause::As1170_4), [0.264, 0.056, 0.056]);
    near(held(&forces, Clause::Asce7_16), [0.141_312, 0.0, 0.121_136]);
    let force = 0.4 * 0.2944 * (1.0 + 1.0 / 3.0 + 1.0 - (0.4_f64 / 3.0).powi(2)) / 1.3 / 1.5;
    near(
        held(&forces, Clause::Asce7_22),
        [force, 0.0, (2.0 * force * 1.15 - 0.84112 * 0.3) / 0.6],
    );
    // (0.4 · 1.15 − 0.27)/0.6; across the width (0.46 − 0.405)/0.9 is less.
    near(
        held(&forces, Clause::ComputedFloor),
        [0.4, 0.19 / 0.6, 0.19 / 0.6],
    );
    near(
        [
            of(&forces, Clause::As1170_4).held_weight_ratio,
            of(&forces, Clause::Asce7_16).held_weight_ratio,
        ],
        [0.9, 0.84112],
    );
    near(
        [
            of(&forces, Clause::As1170_4).source.overstrength_ratio(),
            of(&forces, Clause::Asce7_16).source.overstrength_ratio(),
        ],
        [1.0, 2.0],
    );
    assert_eq!(
        forces[2].source.remarks,
        [Remark::OtherSpectrum, Remark::Row]
    );
    assert_eq!(forces[0].source.to_confirm, [Unread::Formula]);
    assert!(forces[0].source.remarks.is_empty(), "its own spectrum");
    let [
        Remark::NoReduction,
        Remark::AboveCode {
            ratio,
            clause: Clause::As1170_4,
        },
    ] = forces[1].source.remarks[..]
    else {
        panic!("{:?}", forces[1].source.remarks)
    };
    near([ratio], [0.4 / 0.264]);
}

/// The cabinet's bracket at 0.9 · 2.3 m = 2.07 m: P = 0.264 · 1.15/2.07 = 0.146667 W, V = 0.264 (1
/// − 0.555556) = 0.117333 W, less than the friction 0.3 · 0.9 W. ASCE 7-16 in concrete: 2 ·
/// 0.141312 · 0.555556 W.
#[test]
fn a_bracket_by_hand() {
    let forces = restraint_forces(&cabinet(Some(melbourne())));
    let (own, asce) = (of(&forces, Clause::As1170_4), of(&forces, Clause::Asce7_16));
    near([own.bracket_height_m], [2.07]);
    near(
        bracketed(own),
        [0.264 / 1.8, 0.264 / 1.8, 0.264 * 0.8 / 1.8],
    );
    near(
        bracketed(asce),
        [0.141_312 / 1.8, 0.282_624 / 1.8, 0.141_312 * 0.8 / 1.8],
    );
    near([own.foot_friction_n() / WEIGHT_N], [0.27]);
}

/// At 0.5 m, below the centre of gravity: P = 0.264 · 2.3 = 0.6072 W, V = 0.264 · 1.3 = 0.3432 W
/// against F, more than the friction of 0.27 W. At the centre of gravity nothing is left for the
/// feet. At 3 m it is limited to the top: P = 0.264/2.
#[test]
fn a_bracket_below_the_centre_of_gravity_and_above_the_object() {
    let at = |height_m| {
        let question = set(cabinet(Some(melbourne())), |settings| {
            settings.bracket_height_m = Some(height_m)
        });
        restraint_forces(&question).remove(0)
    };
    let low = at(0.5);
    near(bracketed(&low), [0.6072, 0.6072, 0.3432]);
    near(bracketed(&at(1.15)), [0.264, 0.264, 0.0]);
    let high = at(3.0);
    near([high.bracket_height_m], [2.3]);
    near(bracketed(&high), [0.132, 0.132, 0.132]);
    assert_eq!(high.too_high_bracket_m, Some(3.0));
    assert_eq!(at(2.3).too_high_bracket_m, None);
}

/// S_DS = 1 g: H = (0.9 − 0.2) W. 16: 0.4 · 3/2.5 = 0.48: T = (0.48 · 1.15 − 0.7 · 0.3)/0.6 = 0.57
/// W, T_c = (0.96 · 1.15 − 0.21)/0.6 = 1.49 W. Critical: 1.5 times. AS with Sa(0) = 0.4 g: 1.2 W,
/// limited to 0.5.
#[test]
fn america_takes_some_of_the_weight_away() {
    let question = cabinet(Some(america(Asce7Edition::Asce7_16)));
    let forces = restraint_forces(&question);
    let expected = [
        Clause::Asce7_16,
        Clause::ComputedFloor,
        Clause::As1170_4,
        Clause::Asce7_22,
    ];
    assert_eq!(clauses(&forces), expected);
    near(held(&forces, Clause::Asce7_16), [0.48, 0.57, 1.49]);
    near(
        held(&forces, Clause::As1170_4),
        [0.5, (0.575 - 0.27) / 0.6, (0.575 - 0.27) / 0.6],
    );
    let source = |clause| &of(&forces, clause).source;
    assert_eq!(source(Clause::As1170_4).part.governing, Governing::Maximum);
    assert_eq!(source(Clause::As1170_4).remarks, [Remark::OtherSpectrum]);
    assert_eq!(source(Clause::Asce7_16).remarks, [Remark::Row]);
    // 0.4 g is below 0.48 g.
    assert_eq!(source(Clause::ComputedFloor).remarks, [Remark::NoReduction]);
    let critical = restraint_forces(&other(question, |object| object.is_critical = true));
    near(
        held(&critical, Clause::Asce7_16),
        [0.72, (0.72 * 1.15 - 0.21) / 0.6, (1.44 * 1.15 - 0.21) / 0.6],
    );
    assert_eq!(
        factor(of(&critical, Clause::Asce7_16), FactorKey::Importance),
        (1.5, FactorSource::Assumed(Assumed::LifeSafety))
    );
}

/// S_DS = 5 g deducts more than the dead load: H = 0, not less. T = F c/B.
#[test]
fn no_more_than_the_weight_is_deducted() {
    let code = Asce7::new(Asce7Edition::Asce7_16, 5.0, 3.0, 8.0).unwrap();
    let forces = restraint_forces(&cabinet(Some(code.into())));
    near([of(&forces, Clause::Asce7_16).held_weight_ratio], [0.0]);
    near(
        held(&forces, Clause::Asce7_16),
        [2.4, 2.4 * 1.15 / 0.6, 4.8 * 1.15 / 0.6],
    );
}

/// The edition of the study comes first, the other one is for comparison.
#[test]
fn own_code_then_floor_then_comparisons() {
    for (edition, own) in [
        (Asce7Edition::Asce7_16, Clause::Asce7_16),
        (Asce7Edition::Asce7_22, Clause::Asce7_22),
    ] {
        let forces = restraint_forces(&cabinet(Some(america(edition))));
        let study: Vec<Clause> = forces
            .iter()
            .take_while(|force| force.source.kind != SourceKind::OtherCode)
            .map(|force| force.source.clause)
            .collect();
        assert_eq!(study, [own, Clause::ComputedFloor]);
        let is_other = |force: &RestraintForce| force.source.kind == SourceKind::OtherCode;
        assert!(forces[2..].iter().all(is_other));
        let counts = reported_force(&forces).unwrap();
        assert_eq!(counts.source.clause, own, "not the largest");
    }
    // Nothing of the study's own: no force counts.
    let table = SpectrumTable::new(
        vec![0.1, 1.0],
        vec![0.2, 0.1],
        Interpolation::LogLog,
        OutOfRange::Refuse,
    )
    .unwrap();
    let only = RestraintQuestion {
        floor_acceleration_g: None,
        ..cabinet(Some(table.into()))
    };
    let forces = restraint_forces(&only);
    assert!(forces.len() == 3 && reported_force(&forces).is_none());
}

/// a_g S = 0.24 g, roof, rigid, q_a = 2: 0.3 W; C(0) C_Hi = 0.532 · 3 = 1.596 g, C_i = 2: 3.192 W.
#[test]
fn europe_and_new_zealand_have_their_own() {
    let europe = Eurocode8::new(SpectrumType::Type1, GroundType::B, 0.2, 1.0).unwrap();
    let forces = restraint_forces(&cabinet(Some(europe.into())));
    near(
        held(&forces, Clause::Eurocode8),
        [0.3, (0.345 - 0.27) / 0.6, (0.345 - 0.27) / 0.6],
    );
    assert_eq!(
        (forces.len(), forces[0].source.clause),
        (5, Clause::Eurocode8)
    );
    let new_zealand = Nzs1170_5::new(SubsoilClass::C, 0.4, 500, None).unwrap();
    let forces = restraint_forces(&cabinet(Some(new_zealand.into())));
    let tension: [f64; 2] = [(3.192 * 1.15 - 0.27) / 0.6, (3.192 * 1.15 - 0.405) / 0.9];
    let most = tension[0].max(tension[1]);
    near(held(&forces, Clause::Nzs1170_5), [3.192, most, most]);
}

/// A stated factor takes the place of each code's own. Amplification 1.4, response 2, importance
/// 1.2, overstrength 1.7, dead load 0.8; mid-height: AS a_x = 2, ASCE 7-16 1 + 2 · 0.5 = 2. AS:
/// 0.088 · 2 · 1.2 · 1.4/2 = 0.14784. ASCE 7-16: 0.4 · 1.4 · 0.2944 · 2 · 1.2/2 = 0.1978368. EN:
/// 0.24 · (1.5 · 1.5 − 0.5) · 1.4 · 1.2/2 = 0.3528. NZS: 0.532 · 3 · 1.4/2 · 1.2 = 1.34064. Floor:
/// 1.4 · 0.4 = 0.56; T_c = (1.7 · 0.56 · 1.15 − 0.8 · 0.3)/0.6.
#[test]
fn stated_factors_replace_those_of_the_codes() {
    let stated = |spectrum: CodeSpectrum| {
        let question = other(cabinet(Some(spectrum)), |object| {
            (object.level_ratio, object.is_critical) = (0.5, true)
        });
        restraint_forces(&set(question, |settings| {
            *settings = RestraintSettings {
                dead_load_ratio: 0.8,
                overstrength_ratio: Some(1.7),
                amplification_ratio: Some(1.4),
                response_ratio: Some(2.0),
                importance_ratio: Some(1.2),
                ..*settings
            }
        }))
    };
    let ratio = |forces: &[RestraintForce], clause: Clause| of(forces, clause).force_ratio();
    let forces = stated(melbourne());
    near(
        [
            ratio(&forces, Clause::As1170_4),
            ratio(&forces, Clause::Asce7_16),
            ratio(&forces, Clause::ComputedFloor),
        ],
        [0.14784, 0.197_836_8, 0.56],
    );
    // T = 3 s: 1 + 0.5/3 + 0.98222/1024; 0.4 · 0.2944 · 1.2 · H_f/1.3 · 1.4/2.
    let height = 1.0 + 0.5 / 3.0 + (1.0 - (0.4_f64 / 3.0).powi(2)) / 1024.0;
    near(
        [ratio(&forces, Clause::Asce7_22)],
        [(0.4 * 0.2944 * 1.2 * height / 1.3 * 0.7).max(0.3 * 0.2944 * 1.2)],
    );
    near(
        held(&forces, Clause::ComputedFloor),
        [
            0.56,
            (0.56 * 1.15 - 0.24) / 0.6,
            (1.7 * 0.56 * 1.15 - 0.24) / 0.6,
        ],
    );
    assert!(
        forces
            .iter()
            .all(|force| force.source.overstrength_ratio() == 1.7)
    );
    near(
        [
            of(&forces, Clause::As1170_4).held_weight_ratio,
            of(&forces, Clause::Asce7_16).held_weight_ratio,
        ],
        [0.8, 0.74112],
    );
    let keys = [
        FactorKey::Importance,
        FactorKey::Amplification,
        FactorKey::Response,
        FactorKey::Overstrength,
    ];
    assert_eq!(
        keys.map(|key| factor(of(&forces, Clause::As1170_4), key)),
        [1.2, 1.4, 2.0, 1.7].map(|value| (value, FactorSource::Given))
    );
    let europe = Eurocode8::new(SpectrumType::Type1, GroundType::B, 0.2, 1.0).unwrap();
    let forces = stated(europe.into());
    near([ratio(&forces, Clause::Eurocode8)], [0.3528]);
    assert_eq!(
        factor(&forces[0], FactorKey::Amplification),
        (1.4, FactorSource::Given)
    );
    let new_zealand = Nzs1170_5::new(SubsoilClass::C, 0.4, 500, None).unwrap();
    let forces = stated(new_zealand.into());
    near([ratio(&forces, Clause::Nzs1170_5)], [1.340_64]);
    // 1/R: what the code multiplies by.
    assert_eq!(
        factor(&forces[0], FactorKey::Response),
        (0.5, FactorSource::Given)
    );
}

/// The computed floor: 2.5 · 0.4 = 1 W; a_c, a_p = 2.5: 0.66 W, limited to 0.5 W, and 0.35328 W;
/// C_AR = 2.2. Eurocode 8 in resonance on the roof: 0.24 · 5.5/2 = 0.66 W.
#[test]
fn a_flexible_bracket_amplifies() {
    let flexible = |spectrum| {
        restraint_forces(&set(cabinet(Some(spectrum)), |settings| {
            settings.bracket = Bracket::Flexible
        }))
    };
    let forces = flexible(melbourne());
    let rigid = restraint_forces(&cabinet(Some(melbourne())));
    let ratio = |clause| of(&forces, clause).force_ratio();
    near(
        [
            ratio(Clause::ComputedFloor),
            ratio(Clause::As1170_4),
            ratio(Clause::Asce7_16),
        ],
        [1.0, 0.5, 2.5 * 0.141_312],
    );
    near(
        [ratio(Clause::Asce7_22)],
        [2.2 * of(&rigid, Clause::Asce7_22).force_ratio()],
    );
    assert_eq!(
        factor(of(&forces, Clause::ComputedFloor), FactorKey::Amplification),
        (2.5, FactorSource::Assumed(Assumed::FlexibleBracket))
    );
    let europe = Eurocode8::new(SpectrumType::Type1, GroundType::B, 0.2, 1.0).unwrap();
    near(
        [of(&flexible(europe.into()), Clause::Eurocode8).force_ratio()],
        [0.66],
    );
    // An amplification of the floor is never below 1.
    let low = restraint_forces(&set(cabinet(None), |settings| {
        settings.amplification_ratio = Some(0.5)
    }));
    near([low[0].force_ratio()], [0.4]);
    assert_eq!(
        factor(&low[0], FactorKey::Amplification),
        (0.5, FactorSource::Given)
    );
}

/// A table that begins at 0.1 s: its first value is the ground's. A low building: 1 + 0.17 · 10 m ·
/// 0.5.
#[test]
fn a_table_and_a_low_building() {
    let table = SpectrumTable::new(
        vec![0.1, 1.0],
        vec![0.2, 0.1],
        Interpolation::LogLog,
        OutOfRange::Refuse,
    )
    .unwrap();
    let low = RestraintQuestion {
        building_height_m: Some(10.0),
        building_period_s: None,
        ..other(cabinet(Some(table.into())), |object| {
            object.level_ratio = 0.5
        })
    };
    let forces = restraint_forces(&low);
    // The table is nobody's code: the floor comes first, and counts.
    assert_eq!(
        reported_force(&forces).unwrap().source.clause,
        Clause::ComputedFloor
    );
    let tension = (0.37 * 1.15 - 0.27) / 0.6;
    near(
        held(&forces, Clause::As1170_4),
        [0.2 * 1.85, tension, tension],
    );
    let force: f64 = 0.4 * 0.2 * 2.25 / 1.3 / 1.5;
    near(
        held(&forces, Clause::Asce7_22),
        [
            force,
            0.0,
            ((2.0 * force * 1.15 - 0.86 * 0.3) / 0.6).max(0.0),
        ],
    );
    let unknown = restraint_forces(&RestraintQuestion {
        building_height_m: None,
        ..low
    });
    near(
        held(&unknown, Clause::As1170_4),
        [0.4, (0.46 - 0.27) / 0.6, (0.46 - 0.27) / 0.6],
    );
    assert_eq!(
        of(&unknown, Clause::As1170_4).source.remarks,
        [Remark::OtherSpectrum, Remark::TallBuilding]
    );
}

#[test]
fn without_a_hazard_only_the_computed_floor_speaks() {
    let forces = restraint_forces(&cabinet(None));
    assert_eq!(clauses(&forces), [Clause::ComputedFloor]);
    assert_eq!(reported_force(&forces), forces.first());
    assert!(
        restraint_forces(&RestraintQuestion {
            floor_acceleration_g: None,
            ..cabinet(None)
        })
        .is_empty()
    );
    assert!(
        restraint_forces(&other(cabinet(Some(melbourne())), |object| object
            .mass_kg =
            0.0))
        .is_empty()
    );
    assert!(
        restraint_forces(&other(cabinet(Some(melbourne())), |object| object
            .height_m =
            0.0))
        .is_empty()
    );
    // No side to tip over: the force and the bracket alone.
    let flat = restraint_forces(&other(cabinet(None), |object| object.axes.clear()));
    assert_eq!(
        (flat[0].anchor_tension_n, flat[0].anchor_tension_concrete_n),
        (0.0, 0.0)
    );
    near(bracketed(&flat[0]), [0.4 / 1.8, 0.4 / 1.8, 0.4 * 0.8 / 1.8]);
}

/// As in a part of a list that is stored: to the bit, and with the row of the tables.
#[test]
fn forces_are_read_as_they_were_written() {
    for spectrum in [
        None,
        Some(melbourne()),
        Some(america(Asce7Edition::Asce7_16)),
    ] {
        let forces = restraint_forces(&cabinet(spectrum));
        let text = serde_json::to_string(&forces).unwrap();
        let read: Vec<RestraintForce> = serde_json::from_str(&text).unwrap();
        assert_eq!(read, forces);
        let unknown = text.replace("\"cabinet\"", "\"gizmo\"");
        let is_read = serde_json::from_str::<Vec<RestraintForce>>(&unknown).is_ok();
        assert_eq!(is_read, unknown == text);
    }
}

/// The weight's lever is that of the nearer edge, whichever side the inventory counts from: 0.2 m
/// of 0.6 m: (0.4 · 1.15 − 0.9 · 0.2)/0.6. A heavy force on the width counts where that needs more:
/// base 0.9 m with the weight at its edge: 0.46/0.9, against (0.46 − 0.27)/0.6.
#[test]
fn the_nearer_edge_and_the_worse_axis_count() {
    let axes = |thickness_lever_m: f64, width_lever_m: f64| {
        let mut question = cabinet(None);
        question.object.axes[0].weight_lever_m = thickness_lever_m;
        question.object.axes[1].weight_lever_m = width_lever_m;
        restraint_forces(&question)
    };
    for lever_m in [0.2, 0.4] {
        near(
            held(&axes(lever_m, 0.45), Clause::ComputedFloor),
            [0.4, 0.28 / 0.6, 0.28 / 0.6],
        );
    }
    let forces = axes(0.3, 0.0);
    near(
        held(&forces, Clause::ComputedFloor),
        [0.4, 0.46 / 0.9, 0.46 / 0.9],
    );
    assert_eq!(forces[0].axis.as_ref().unwrap().axis, Axis::Width);
}

/// The largest reach of all four corners, followed one by one.
#[test]
fn clearance_is_that_of_the_farthest_corner() {
    for (h, t) in [(2.3, 0.6), (1.0, 1.0), (0.5, 0.8)] {
        for share in [0.0, 0.1, 0.5, 0.99] {
            let theta: f64 = share * f64::atan(t / h);
            let corners = [(0.0, 0.0), (-t, 0.0), (-t, h), (0.0, h)];
            let reach = corners.map(|(x, z)| {
                let moved = x * theta.cos() + z * theta.sin();
                moved.max(-t - moved)
            });
            let farthest = reach.into_iter().fold(0.0, f64::max);
            assert!(
                (clearance_m(h, t, theta) - farthest).abs() < 1e-15
                    && clearance_m(h, t, -theta) == clearance_m(h, t, theta)
            );
        }
        assert_eq!(clearance_m(h, t, 1.5), h);
    }
}

/// A cabinet of 2.3 m × 0.6 m at 5°, and past its balance point at 14.6°.
#[test]
fn the_clearance_is_that_of_the_top_or_of_the_fallen_object() {
    assert!((clearance_m(2.3, 0.6, 5.0_f64.to_radians()) - 0.2005).abs() < 5e-5);
    assert_eq!(clearance_m(2.3, 0.6, 0.3), 2.3);
}

/// Mid-height: 0.176 W by the code, (0.176 · 1.15 − 0.27)/0.6 < 0; the floor has 0.4 W = 549 N and
/// (0.46 − 0.27)/0.6 W: the anchors are those of the floor.
#[test]
fn what_the_code_does_not_lift_is_designed_for_the_floor() {
    let at = |level_ratio| {
        restraint_forces(&other(cabinet(Some(melbourne())), |object| {
            object.level_ratio = level_ratio
        }))
    };
    let middle = at(0.5);
    assert_eq!(
        (middle[0].source.kind, middle[0].anchor_tension_n),
        (SourceKind::OwnCode, 0.0)
    );
    assert_eq!(reported_force(&middle), middle.first());
    assert_eq!(
        design_force(&middle).unwrap().source.kind,
        SourceKind::Floor
    );
    // On the roof the code asks for anchors itself; there may be no code.
    assert_eq!(
        design_force(&at(1.0)).unwrap().source.kind,
        SourceKind::OwnCode
    );
    let without = restraint_forces(&cabinet(None));
    assert_eq!(
        [&middle, &at(1.0), &without].map(|forces| is_beyond_code(forces)),
        [true, false, false]
    );
}
