//! Invented assessments for tests: every kind of row, with hostile texts among them. The numbers of
//! a row are unrelated, except for the chain, which is computed.

use std::path::PathBuf;

use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::cushion::Cushion;
use freestand::impact::{ImpactModel, Landing};
use freestand::rocking::Restitution;

use freestand::code_spectrum::part_forces::{Governing, PartForce};
use freestand_assess::capacity::Capacity;
use freestand_assess::reason::{Missing, Note, Reason};
use freestand_assess::restrain::Component;
use freestand_assess::restraint::factor::{Factor, FactorKey, FactorSource, Recalled};
use freestand_assess::restraint::footing::Footing;
use freestand_assess::restraint::source::{Clause, Source, SourceKind};
use freestand_assess::result::{
    AcceptedFor, Answers, Assessment, AtWall, Axis, AxisResponse, CapacityCheck, Cause, Chain,
    Comparison, Criterion, Decision, FallsAnswer, FloorFacts, MeasureFirst, ModelAnswers,
    ObjectModel, OnPads, OnRigidBase, PadOutcome, Probability, RestraintForce, Rolled, Shares,
    Shock, ShockAnswer, Sliding, SlidingVerdict, Softening,
};
use freestand_input::problem::Problem;
use freestand_inventory::library::{Confidence, Tolerance};
use freestand_inventory::{Consequences, Inventory, Item, ItemShape, Rating};
use freestand_output::folder::OutputFolder;
use freestand_study::cushion::EdgeCushion;
use freestand_study::result::Ranked;

use super::{Head, Row, Wanted, write_all};
use crate::signature::Signing;

/// The outputs that are always written, and no others.
pub(super) const TABLES: Wanted = Wanted {
    parquet: false,
    workbook: false,
    report: false,
    pages: 0,
    plan: None,
    lacks_plan: false,
    since: None,
    signing: Signing {
        allows_recalled: false,
    },
};

pub(super) const HOSTILE: [&str; 6] = [
    "<script>alert('x')</script>",
    "=cmd|'/C calc'!A0",
    "two\nlines, \"quoted\"; and\ttabs\r",
    "🪨 Büste \u{202e}right-to-left",
    "]]></svg></style><img src=x onerror=alert(1)>\u{1}\u{fffe}",
    "@SUM(A1)",
];

pub(super) fn head(total: usize) -> Head {
    Head {
        no_study: Some("Nobody stated the place and the building: this is a 30-storey tower in Melbourne, not your building. Give place and storeys.".into()),
        place: vec![
            ("Building".into(), "Main, 30 storeys, 90 m high".into()),
            ("Place".into(), "Melbourne".into()),
            ("List".into(), "ward.xlsx, sheet Objects, 24 objects".into()),
        ],
        one_line: "Melbourne (AS 1170.4-2007, site class De, 500 years); Main, 30 storeys, 90 m high".into(),
        facts: vec![("Period of the building".into(), "3.1 s".into()), ("Seed of the motions".into(), "seed 1".into())],
        problems: vec!["error: unreadable: Height: 1 cell (D2); hint: give a mapping file (`columns`)".into()],
        most_important: vec!["The building stays elastic.".into()],
        assumed_columns: vec![("width", 4)],
        assumptions: vec![
            "Accepted probability 10 %: assumption of this study.".into(),
            "Model error 0.085: Table I, five tests of one cabinet.".into(),
        ],
        warnings: vec!["Row 7: the stiffness looks like N/m typed for N/mm.".into()],
        is_elastic: true,
        title: freestand_study::study::TitleBlock::default(),
        recalled_place: None,
        cards: false,
        confidence: 0.98,
        total,
    }
}

pub(super) fn item(index: usize) -> Item {
    let slender = 1.0 + 0.1 * (index % 13) as f64;
    Item {
        row: 2 + index as u32,
        section: String::new(),
        id: format!("O-{index:04}"),
        item: ["cabinet", "server rack", "bust on a pedestal", "shelf"][index % 4].to_owned(),
        quantity: 1 + (index % 3) as u32,
        priority: ["", "1", "B"][index % 3].to_owned(),
        location: String::new(),
        building: "Main".to_owned(),
        floor: format!("Level {}", index % 5),
        room: format!("{}", 100 + index % 40),
        consequences: Consequences {
            life_safety: [None, Some(Rating::High), Some(Rating::Low)][index % 3],
            property: [Some(Rating::Medium), None][index % 2],
            function: Some(Rating::High),
        },
        level_ratio: Some(0.25 * (index % 5) as f64),
        height_m: Some(1.5 + 0.2 * slender),
        thickness_m: Some(0.4 + 0.05 * slender),
        width_m: (!index.is_multiple_of(4)).then_some(0.8),
        base_thickness_m: (index % 5 == 1).then_some(0.35),
        base_width_m: None,
        shape: ItemShape::Block,
        cg_height_m: (index % 5 == 1).then_some(0.9),
        mass_kg: Some(100.0 + 10.0 * slender),
        cushion: Some(EdgeCushion {
            cushion: Cushion::linear(4.38e6).unwrap(),
            pad_thickness_m: None,
            notes: vec![],
        }),
        cushion_log_sd: None,
        cushion_source: None,
        tolerance: (index % 4 != 2).then(|| Tolerance {
            peak_m_s2: Some(5.0 * G0_M_S2),
            duration_s: None,
            velocity_change_m_s: (index % 8 == 5).then_some(0.3),
            edge_lift_m: None,
            source: "hdd-35-operating: data sheets (class)".to_owned(),
            confidence: Confidence::Secondary,
        }),
        restitution: [
            Restitution::Housner,
            Restitution::Value(0.9),
            Restitution::Factor(0.95),
        ][index % 3],
        friction_ratio: None,
        accepted_ratio: None,
        questions: None,
        anchored: None,
        rests_on: String::new(),
        surroundings: Default::default(),
        notes: String::new(),
        doubts: Vec::new(),
        to_confirm: Vec::new(),
        carried: vec![format!("A{index}"), "-12".to_owned()],
    }
}

pub(super) fn inventory(items: Vec<Item>) -> Inventory {
    Inventory {
        libraries: Vec::new(),
        scans: Vec::new(),
        path: PathBuf::from("ward.xlsx"),
        sha256: "0123456789abcdef".repeat(4),
        sheet: Some("Objects".to_owned()),
        carried: vec!["Asset".to_owned(), "rank".to_owned()],
        items,
        read_with: String::new(),
        findings: vec![],
        warnings: vec![],
        units: Default::default(),
    }
}

/// The chain of an item about its thickness, computed by the core, for a quarter of the rise at the
/// balance point.
pub(super) fn chain(item: &Item) -> Option<Chain> {
    let (height_m, thickness_m) = (item.height_m?, item.thickness_m?);
    let (base_m, cg_height_m) = (item.base_thickness_m, item.cg_height_m);
    let is_uniform = base_m.is_none() && cg_height_m.is_none();
    let base_m = base_m.unwrap_or(thickness_m);
    let block = Block::uniform(height_m, thickness_m)
        .unwrap()
        .with_base_width(base_m)
        .unwrap();
    let block = block
        .with_cg_height(cg_height_m.unwrap_or(0.5 * height_m))
        .unwrap();
    let landing = Landing::rocking(&block, ImpactModel::Paper);
    let (mass_kg, cushion) = (item.mass_kg?, &item.cushion.as_ref()?.cushion);
    let cg_rise_m = 0.25 * block.pivot().balance_rise_m();
    let impact = landing.impact(mass_kg, cushion, cg_rise_m, G0_M_S2);
    let edge_acceleration_g = impact.edge_acceleration_m_s2 / G0_M_S2;
    let shock_g = 1.2 * edge_acceleration_g;
    let ratio = item.tolerance.as_ref().map(|tolerance| {
        let peak = shock_g * G0_M_S2 / tolerance.peak_m_s2.unwrap();
        let change = tolerance
            .velocity_change_m_s
            .map(|limit| 1.2 * impact.velocity_change_m_s / limit);
        change.map_or(peak, |change| peak.min(change))
    });
    Some(Chain {
        motion: "synthetic-07".to_owned(),
        axis: Axis::Thickness,
        height_m,
        thickness_m,
        is_uniform,
        base_m,
        half_diagonal_m: block.pivot().half_diagonal_m,
        mass_kg,
        stiffness_n_m: cushion.linear_stiffness_n_m(),
        cg_rise_m,
        landing_ratio: block.landing_ratio(),
        is_halted: landing.model == ImpactModel::Halted,
        drop_acceleration_g: impact.drop_acceleration_m_s2 / G0_M_S2,
        effective_mass_kg: landing.effective_mass_ratio * mass_kg,
        edge_acceleration_g,
        edge_acceleration_impact_velocity_g: shock_g,
        velocity_change_m_s: impact.velocity_change_m_s,
        pulse_duration_s: impact.pulse_duration_s,
        uplift_m: base_m * block.pivot().rotation_at_rise_rad(cg_rise_m).unwrap().sin(),
        demand_capacity_ratio: ratio,
    })
}

pub(super) fn decision(index: usize) -> Decision {
    match index % 4 {
        2 => Decision::NoVerdict,
        _ => [Decision::Restrain, Decision::Leave, Decision::Soften][index % 3],
    }
}

fn spread(value: f64, falls: bool) -> [Ranked; 3] {
    let upper = if falls {
        Ranked::Overturned
    } else {
        Ranked::Value(1.6 * value)
    };
    [Ranked::Value(0.6 * value), Ranked::Value(value), upper]
}

pub(super) fn assessment(item: &Item, index: usize) -> Assessment {
    let decision = decision(index);
    let falls = decision == Decision::Restrain;
    let chain = chain(item);
    let axis = |axis, share: f64| AxisResponse {
        axis,
        slenderness_angle_rad: 0.25,
        half_diagonal_m: 0.93,
        uplift_threshold_g: 0.2553,
        uplift_share: share,
        overturn_share: if falls { 0.3 } else { 0.0 },
        edge_acceleration_g: Some(spread(4.2, falls)),
        ceiling_g: Some(6.1),
    };
    let mut axes = vec![axis(Axis::Thickness, 0.8)];
    axes.extend(item.width_m.map(|_| axis(Axis::Width, 0.1)));
    let capacity = item
        .tolerance
        .as_ref()
        .zip(chain.as_ref())
        .map(|(tolerance, _)| CapacityCheck {
            demand_capacity: if falls && index % 2 == 1 {
                Ranked::Overturned
            } else {
                Ranked::Value(1.3)
            },
            demand_capacity_p84: if falls {
                Ranked::Overturned
            } else {
                Ranked::Value(2.1)
            },
            governing: if tolerance.velocity_change_m_s.is_some() {
                Criterion::DamageBoundary
            } else {
                Criterion::Peak
            },
            tolerance: Capacity {
                peak_m_s2: Some(5.0 * G0_M_S2),
                duration_s: None,
                velocity_change_m_s: None,
                edge_lift_m: None,
                decides: true,
            },
            source: tolerance.source.clone(),
            floor_ratio: Some(0.06),
        });
    Assessment {
        id: item.id.clone(),
        decision,
        why: std::iter::once(Reason::Falling { lifts: true })
            .chain(
                (decision == Decision::NoVerdict)
                    .then(|| Reason::ShockUnknown(vec![Missing::Tolerance])),
            )
            .collect(),
        tier: (index % 4) as u8,
        accepted_ratio: 0.1,
        accepted_for: AcceptedFor::LifeSafety,
        floor: Some(FloorFacts {
            level_ratio: 0.5,
            pfa_g_median: 0.3,
            pfa_g_max: 0.52,
            pfv_m_s_median: 0.41,
        }),
        response: Some(OnRigidBase {
            motions: 20,
            failed: usize::from(index.is_multiple_of(7)),
            failure: index
                .is_multiple_of(7)
                .then(|| "the cushion bottoms".to_owned()),
            uplift_share: 0.8,
            overturn_share: if falls { 0.3 } else { 0.0 },
            uplift_m: spread(0.031, falls),
            rotation_ratio: spread(0.31, falls),
            impacts_max: 41,
            axes,
        }),
        shock: Some(Shock {
            edge_acceleration_g: spread(4.2, falls),
            edge_acceleration_uplift_g: spread(3.9, falls),
            edge_acceleration_max_g: Some(6.6),
            pulse_duration_s: 0.0171,
            velocity_change_m_s: Ranked::Value(0.44),
            ceiling_g: 6.1,
            stiffness_n_m: Some(4.38e6),
            impacts_above_tolerance: item.tolerance.is_some().then_some(3),
        }),
        p_overturn: Some(Probability {
            value: if falls { 0.31 } else { 0.0 },
            low: 0.0,
            high: 0.46,
        }),
        p_exceed: capacity.is_some().then_some(Probability {
            value: 0.42,
            low: 0.31,
            high: 0.53,
        }),
        capacity,
        answers: Some(answers(falls, item.tolerance.is_some(), index)),
        model: Some(if index % 4 == 3 {
            ObjectModel::Compliant
        } else {
            ObjectModel::RockWall
        }),
        at_wall: (index % 4 != 3).then_some(AtWall {
            lean_share: 0.05,
            strike_share: 0.7,
            speed_m_s_median: 0.31,
            acceleration_g_median: Some(2.4),
        }),
        before_wall: None,
        rolled: (index % 4 == 2).then_some(Rolled {
            travel_m_median: 0.21,
            travel_m_p84: 0.35,
            is_at_least: false,
            clearance_m: Some(0.3),
            clearance_needed_m: 0.42,
            room_m: [0.19, 0.32, 0.4],
            stop_share: 0.25,
            stop_speed_m_s_p84: Some(0.4),
            trip_speed_m_s: 0.9,
        }),
        braked: None,
        in_space: None,
        stacked: None,
        on_pads: (index % 4 == 3).then_some(OnPads {
            rocking_frequency_hz: Some(4.1),
            pad_uplift_threshold_g: Some(0.21),
            pad_uplift_ratio_p84: Some(1.4),
            let_go_share: 0.6,
            rebound_restitution: 0.55,
            edge_acceleration_g_median: Ranked::Value(3.9),
            demand_capacity_median: Ranked::Value(0.78),
            lift_m_median: Ranked::Value(0.021),
            compression_m_p95: 0.012,
            failed: 0,
        }),
        shares: (index % 4 == 3).then(|| Shares {
            by_group: Cause::ALL.map(|cause| (cause, Some(0.3))).to_vec(),
            measure_first: Some(MeasureFirst {
                cause: Cause::Pad,
                low_ratio: 0.04,
                high_ratio: 0.31,
            }),
        }),
        per_year: None,
        sliding: Some(Sliding {
            verdict: SlidingVerdict::Possible,
            friction_ratio: (0.3, 0.7),
            is_stated: false,
        }),
        softening: (decision == Decision::Soften).then_some(Softening {
            max_stiffness_n_m: Some(1.1e6),
            stroke_m: Some(0.011),
            pad_thickness_m: 0.04,
            edge_acceleration_g: Some(3.1),
            p_exceed_high: Some(0.02),
            p_overturn_high: Some(0.014),
            is_assumed: false,
            outcome: PadOutcome::Enough,
        }),
        restraint: if falls { forces() } else { vec![] },
        clearance_m: Some(0.06),
        comparisons: vec![Comparison::CodeFloor {
            code_g: 0.41,
            clause: "ASCE 7-22, 13.3".to_owned(),
        }],
        chain,
        notes: vec![Note::OneComponent],
    }
}

fn answers(falls: bool, asks_shock: bool, index: usize) -> Answers {
    let overturn = Probability {
        value: if falls { 0.31 } else { 0.0 },
        low: 0.0,
        high: 0.46,
    };
    let model = ModelAnswers {
        overturn,
        exceed: Some(Probability {
            value: 0.42,
            low: 0.31,
            high: 0.53,
        }),
    };
    Answers {
        falls: if falls {
            FallsAnswer::Falls
        } else {
            FallsAnswer::Stays
        },
        shock: if asks_shock {
            ShockAnswer::Exceeded
        } else {
            ShockAnswer::Unknown
        },
        asks_shock,
        models_agree: (index % 4 == 3).then_some(true),
        worlds: 80,
        worlds_cap: 320,
        worlds_compliant: None,
        confidence: 0.98,
        rigid: Some(model),
        compliant: (index % 4 == 3).then_some(model),
        restitution_p16_p84: [0.93, 0.97],
        few_motions: None,
        worlds_needed: None,
        too_mild: None,
    }
}

pub(super) fn forces() -> Vec<RestraintForce> {
    let factor = |key, value, source| Factor { key, value, source };
    let recalled = FactorSource::Recalled(Recalled::Ordinary);
    let force = |kind, clause, force_n: f64, anchor_tension_n: f64| RestraintForce {
        source: Source {
            kind,
            clause,
            part: PartForce {
                force_ratio: 0.42,
                formula_ratio: 0.42,
                minimum_ratio: 0.0,
                maximum_ratio: None,
                governing: Governing::Formula,
            },
            vertical_ratio: 0.0,
            factors: vec![
                factor(FactorKey::Response, 1.0, recalled),
                factor(FactorKey::Overstrength, 2.0, FactorSource::Given),
            ],
            component: Component::find("cabinet"),
            remarks: Vec::new(),
            to_confirm: Vec::new(),
        },
        weight_n: 1373.0,
        cg_height_m: 1.15,
        axis: None,
        footing: Footing::default(),
        force_n,
        dead_load_ratio: 0.9,
        held_weight_ratio: 0.9,
        anchor_tension_n,
        anchor_tension_concrete_n: 2.0 * anchor_tension_n,
        bracket_height_m: 1.35,
        too_high_bracket_m: None,
        bracket_force_n: 0.5 * force_n,
        bracket_force_concrete_n: force_n,
        bracket_base_shear_n: 0.5 * force_n,
    };
    vec![
        force(SourceKind::OwnCode, Clause::As1170_4, 410.0, 950.0),
        force(SourceKind::OtherCode, Clause::Asce7_22, 530.0, 720.0),
    ]
}

/// Items with hostile texts, and one with nothing but a name.
pub(super) fn hostile_items() -> Vec<Item> {
    let mut items: Vec<Item> = (0..8).map(item).collect();
    for (item, text) in items.iter_mut().zip(HOSTILE) {
        item.id = format!("{text}{}", item.row);
        for field in [
            &mut item.item,
            &mut item.location,
            &mut item.floor,
            &mut item.room,
            &mut item.notes,
        ] {
            *field = text.to_owned();
        }
        item.carried = vec![text.to_owned()];
    }
    items[6].item = "long ".repeat(10_000);
    let bare = &mut items[7];
    *bare = Item {
        level_ratio: None,
        height_m: None,
        thickness_m: None,
        mass_kg: None,
        cushion: None,
        tolerance: None,
        width_m: None,
        ..bare.clone()
    };
    items
}

/// Only its name is known.
pub(super) fn unknown(item: &Item) -> Assessment {
    Assessment {
        decision: Decision::NoVerdict,
        why: vec![Reason::NotGiven(vec![
            Missing::Height,
            Missing::Thickness,
            Missing::Level,
        ])],
        floor: None,
        response: None,
        shock: None,
        capacity: None,
        p_overturn: None,
        p_exceed: None,
        answers: None,
        model: None,
        at_wall: None,
        rolled: None,
        braked: None,
        before_wall: None,
        on_pads: None,
        shares: None,
        per_year: None,
        sliding: None,
        clearance_m: None,
        comparisons: vec![],
        chain: None,
        restraint: vec![],
        softening: None,
        ..assessment(item, 2)
    }
}

/// The rows of an inventory, ranked backwards, as far as `assessed` says.
pub(super) fn rows(inventory: &Inventory, assessed: usize) -> Vec<Row<'_>> {
    let rows = inventory
        .items
        .iter()
        .take(assessed)
        .enumerate()
        .map(|(index, item)| {
            let mut found = if item.height_m.is_none() {
                unknown(item)
            } else {
                assessment(item, index)
            };
            if item.notes.contains(HOSTILE[0]) {
                found.why = vec![Reason::Unchecked];
                found.notes = vec![Note::Failed {
                    on_pads: false,
                    worlds: 1,
                    of: 1,
                    why: HOSTILE.concat(),
                }];
                found.comparisons = vec![Comparison::CodeFloor {
                    code_g: 1.0,
                    clause: HOSTILE.concat(),
                }];
            }
            Row {
                rank: assessed - index,
                item,
                found,
            }
        });
    rows.collect()
}

/// Writes everything about the first `assessed` objects and gives the folder.
pub(super) fn written(
    inventory: &Inventory,
    assessed: usize,
    wanted: Wanted,
) -> (tempfile::TempDir, Vec<String>) {
    let folder = tempfile::tempdir().unwrap();
    let out = OutputFolder::stage(&folder.path().join("out"), false, &[]).unwrap();
    let rows = rows(inventory, assessed);
    let mut rows = rows.into_iter().map(Ok::<_, Problem>);
    write_all(
        &out,
        &head(inventory.items.len()),
        inventory,
        wanted,
        &mut rows,
    )
    .unwrap();
    let names = out.names().unwrap();
    out.commit().unwrap();
    (folder, names)
}

/// The bytes of one of the files.
pub(super) fn read(folder: &tempfile::TempDir, name: &str) -> Vec<u8> {
    std::fs::read(folder.path().join("out").join(name)).unwrap()
}
