use std::collections::HashSet;

use crate::signature::Signing;
use calamine::{Data, DataType as _, Reader as _, Xlsx};
use freestand_assess::axis::Axis;
use freestand_assess::restrain::Component;
use freestand_assess::restrain::{
    Anchor, Anchors, Missing, NotHeld, Pivot, RestrainFactors, RestrainFloor, RestrainHazard,
    RestrainListRequest, RestrainRequest, RestraintAssumption, RestraintDoubt, StandsOn, restrain,
    restrain_list,
};
use freestand_assess::restraint::{HeldObject, RestraintAxis, RestraintQuestion, restraint_forces};
use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::UnitSystem;
use freestand_inventory::CellsRequest;
use freestand_study::study::assessment::{Bracket, RestraintSettings};
use freestand_study::target::Target;

use super::force::{note, numbers, source_name};
use super::words::{assumption, doubt_words, floor_words, not_held};
use super::*;

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
        anchors: at_edges(),
        units: UnitSystem::Si,
        is_compared: false,
    }
}

fn code(words: &[(&'static str, &'static str)]) -> RestrainHazard {
    RestrainHazard::Code(words.iter().copied().collect())
}

fn sheet(request: RestrainRequest) -> String {
    restraint_sheet(
        &restrain_report(restrain(request).unwrap()),
        Signing::default(),
    )
}

/// 0.3 S_DS I_p W = 0.45 W and 1.6 S_DS I_p W = 2.4 W; what nobody has read has its own box.
#[test]
fn limits_and_what_is_to_be_confirmed_are_on_the_sheet() {
    let words = [("code", "asce7"), ("edition", "2016"), ("sds", "1 g")];
    let factors = RestrainFactors {
        importance_ratio: Some(1.5),
        ..RestrainFactors::default()
    };
    let limited = sheet(RestrainRequest {
        factors,
        ..cabinet(code(&words), Some(1.0))
    });
    assert!(limited.contains("0.45 W to 2.4 W; the formula governs"));
    let recalled = [
        ("code", "eurocode8"),
        ("ground_acceleration", "0.24 g"),
        ("spectrum_type", "1"),
        ("site", "B"),
    ];
    assert!(sheet(cabinet(code(&recalled), Some(0.5))).contains("class=\"confirm\""));
}

/// 140 kg = 308.6 lb, 0.6 m = 23.62 in.
#[test]
fn us_units_on_the_sheet() {
    let sheet = sheet(RestrainRequest {
        units: UnitSystem::Us,
        ..cabinet(RestrainHazard::FloorAcceleration(0.9), None)
    });
    for part in ["308.6 lb", "23.62 in", "lbf·ft"] {
        assert!(sheet.contains(part), "{part}");
    }
}

/// It holds everything and loads nothing.
#[test]
fn other_codes_are_on_the_sheet() {
    let sheet = sheet(RestrainRequest {
        is_compared: true,
        ..cabinet(code(&[("place", "Athens")]), Some(1.0))
    });
    for part in [
        "<svg",
        "F<sub>a</sub> = α S",
        "who says so",
        "approximate, and the shape",
        "DRAFT",
        "For comparison",
    ] {
        assert!(sheet.contains(part), "{part}");
    }
    assert!(!sheet.contains("Date and signature"));
    let all = sheet.matches("http://").count();
    assert_eq!(all, sheet.matches("http://www.w3.org").count());
}

/// 0.9 W = 1235.6 N = 278 lbf, and half of 2.3 m = 45.28 in.
#[test]
fn the_text_of_one_object() {
    let text = |request| restraint_text(&restrain_report(restrain(request).unwrap()));
    let us = text(RestrainRequest {
        units: UnitSystem::Us,
        ..cabinet(RestrainHazard::FloorAcceleration(0.9), None)
    });
    assert!(us.contains("278 lbf") && us.contains("45.28 in"), "{us}");
    let words = [("code", "asce7"), ("edition", "2016"), ("sds", "1 g")];
    insta::assert_snapshot!(text(RestrainRequest {
        is_compared: true,
        ..cabinet(code(&words), Some(1.0))
    }));
}

/// A list of two objects, of which one has no mass: the table has both, and the one has a sheet with the source
/// of the hazard. The same objects are in the workbook, whose bytes are the same twice.
#[test]
fn a_sheet_for_each_object_of_a_list() {
    let name = format!("freestand-restraints-{}.csv", std::process::id());
    let path = std::env::temp_dir().join(name);
    let csv = "id,item,floor,height [mm],depth [mm],mass [kg],qty\n=a,cabinet <1>,2,1800,600,360,3\nb,fridge,2,1700,600,,1\n";
    std::fs::write(&path, csv).unwrap();
    let anchors = Anchors {
        pivot: Pivot::Feet,
        chosen: Some(Anchor {
            name: Some("M10 & co".to_owned()),
            tension_n: 100.0,
            shear_n: None,
        }),
        ..Anchors::default()
    };
    let request = RestrainListRequest {
        list: path.clone(),
        cells: CellsRequest::default(),
        hazard: code(&[("place", "Istanbul")]),
        floor: RestrainFloor {
            storeys: Some(5),
            ..RestrainFloor::default()
        },
        factors: RestrainFactors::default(),
        component: None,
        anchors,
        units: Some(UnitSystem::Us),
    };
    let held = restrain_list(&request);
    std::fs::remove_file(path).unwrap();
    let report = restrain_list_report(held.unwrap());
    let html = restraint_sheets(&report, Signing::default());
    assert_eq!(html.matches("class=\"object\"").count(), 1);
    for part in [
        "=a cabinet &lt;1&gt;",
        "its mass is not known",
        "Row 2 of the list, 3 of them, 2.",
        "read, interpolated",
        "(B − 2a)",
        "M10 &amp; co",
        "(not enough; shear not compared)",
        "793.7 lb",
        "F<sub>ie</sub>",
        "class=\"confirm\"",
    ] {
        assert!(html.contains(part), "{part}");
    }
    let workbook = restraint_workbook(&report).unwrap();
    assert_eq!(workbook, restraint_workbook(&report).unwrap());
    let mut read = Xlsx::new(std::io::Cursor::new(workbook)).unwrap();
    let sheet = read.worksheet_range("Restraints").unwrap();
    let cell = |row, column| sheet.get((row, column)).unwrap().clone();
    assert_eq!(cell(0, 8), Data::String("force [lbf]".to_owned()));
    assert_eq!(cell(1, 1), Data::String("=a".to_owned()));
    assert_eq!(
        cell(2, 21),
        Data::String("its mass is not known".to_owned())
    );
    // Istanbul, ZD (F_S 1.1004): S_DS = 1.0993 g, 0.4 · 1.0993 · (1 + 2 · 0.4)/2.5 = 0.3166 W, below 0.3 S_DS = 0.32979 W;
    // 360 kg = 793.664 lb. Tolerance: the digits written here.
    let force = cell(1, 8).get_float().unwrap();
    assert!((force - 0.329_79 * 793.664_1).abs() < 0.01, "{force}");
    insta::assert_snapshot!(restraints_text(&report));
}

#[test]
fn every_sentence() {
    let mut all: Vec<String> = [
        StandsOn::Floor {
            name: "3".to_owned(),
            storeys: Some(6),
            level_ratio: 0.5,
        },
        StandsOn::Level(0.5),
        StandsOn::Ground,
    ]
    .iter()
    .map(floor_words)
    .collect();
    let assumed = [
        RestraintAssumption::Ground,
        RestraintAssumption::StoreyHeight,
        RestraintAssumption::Site("Ce"),
        RestraintAssumption::ReturnPeriod(500),
        RestraintAssumption::CgHeight,
        RestraintAssumption::NoWidth,
        RestraintAssumption::Inset(0.075),
        RestraintAssumption::Insets(0.075),
    ];
    all.extend(
        assumed
            .iter()
            .map(|one| assumption(one, UnitSystem::Si, 1.15)),
    );
    let doubts = [
        RestraintDoubt::NoEffect("sd1"),
        RestraintDoubt::ComponentUnused("AS 1170.4"),
        RestraintDoubt::NoTension,
    ];
    all.extend(doubts.iter().map(doubt_words));
    let refused = Problem::value("its height is not that of an object", "correct it");
    let why = [
        NotHeld::Anchored,
        NotHeld::Unconfirmed(vec!["mass".to_owned(), "height".to_owned()]),
        NotHeld::Stacked,
        NotHeld::Unknown(vec![Missing::Mass]),
        NotHeld::Unknown(vec![Missing::Mass, Missing::Height, Missing::Floor]),
        NotHeld::Refused(Problems::from(refused)),
    ];
    all.extend(why.iter().map(not_held));
    insta::assert_snapshot!(all.join("\n"));
}

/// The paper's cabinet at mid-height.
fn question(target: &Target) -> RestraintQuestion {
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
            level_ratio: 0.5,
            is_critical: false,
            component: Component::find("cabinet"),
        },
        building_height_m: Some(96.0),
        building_period_s: Some(3.0),
        spectrum: Some(target.parts_spectrum().clone()),
        parts_edition: target.parts_edition,
        floor_acceleration_g: Some(0.4),
        is_floor_given: false,
        settings: RestraintSettings::default(),
        pivot: Pivot::Edge,
    }
}

/// Of every code: the cabinet, and an object of which little is known, on a flexible bracket below its centre of
/// gravity.
fn every_question() -> Vec<RestraintQuestion> {
    let hazards: [&[(&'static str, &'static str)]; 9] = [
        &[("place", "Melbourne"), ("site", "Ce")],
        &[("code", "asce7"), ("edition", "2016"), ("sds", "1 g")],
        &[("code", "asce7"), ("edition", "2022"), ("sds", "1 g")],
        &[("place", "Los Angeles"), ("site", "D")],
        &[("place", "Athens")],
        &[("place", "L'Aquila"), ("code", "ntc2018"), ("site", "A")],
        &[("place", "Wellington"), ("site", "C")],
        &[("place", "Istanbul"), ("site", "ZC")],
        &[
            ("place", "Wellington"),
            ("code", "ts1170.5"),
            ("site", "III"),
        ],
    ];
    let target = |words: &[(&'static str, &'static str)]| {
        Target::for_parts(&words.iter().copied().collect()).unwrap()
    };
    let mut questions = Vec::new();
    for words in hazards {
        let plain = question(&target(words));
        let mut unknown = plain.clone();
        unknown.object.component = None;
        unknown.object.is_critical = true;
        (unknown.building_height_m, unknown.building_period_s) = (None, None);
        unknown.pivot = Pivot::Feet;
        unknown.settings.bracket = Bracket::Flexible;
        unknown.settings.bracket_height_m = Some(0.5);
        questions.extend([plain, unknown]);
    }
    questions
}

/// The notes of every question, and of one code all forces with stated factors and a bracket above the object.
#[test]
fn every_note() {
    let questions = every_question();
    let mut forces: Vec<_> = questions
        .iter()
        .map(|question| restraint_forces(question).remove(0))
        .collect();
    let mut stated = questions[0].clone();
    stated.settings = RestraintSettings {
        amplification_ratio: Some(1.4),
        response_ratio: Some(2.0),
        importance_ratio: Some(1.2),
        overstrength_ratio: Some(1.7),
        anchor_inset_m: Some(0.0),
        bracket_height_m: Some(3.0),
        ..stated.settings
    };
    forces.extend(restraint_forces(&stated));
    let notes = forces
        .iter()
        .map(|force| format!("{}\n{}\n", source_name(&force.source), note(force)));
    insta::assert_snapshot!(notes.collect::<String>());
}

/// What is left of an expression as a report prints it.
struct Printed<'a>(std::iter::Peekable<std::str::Chars<'a>>);

impl Printed<'_> {
    fn next_is(&mut self, symbols: &[char]) -> Option<char> {
        while self.0.next_if_eq(&' ').is_some() {}
        self.0.next_if(|next| symbols.contains(next))
    }

    fn sum(&mut self) -> f64 {
        let mut sum = self.product();
        while let Some(sign) = self.next_is(&['+', '−']) {
            let next = self.product();
            sum += if sign == '+' { next } else { -next };
        }
        sum
    }

    /// A bracket after a number is a factor.
    fn product(&mut self) -> f64 {
        let mut product = self.factor().unwrap();
        loop {
            let symbol = self.next_is(&['×', '/']);
            let Some(factor) = self.factor() else {
                assert_eq!(symbol, None);
                return product;
            };
            match symbol {
                Some('/') => product /= factor,
                _ => product *= factor,
            }
        }
    }

    fn factor(&mut self) -> Option<f64> {
        let base = if self.next_is(&['(', '[']).is_some() {
            let inside = self.sum();
            self.next_is(&[')', ']']).unwrap();
            inside
        } else {
            let mut digits = String::new();
            while let Some(digit) = self.0.next_if(|c| c.is_ascii_digit() || *c == '.') {
                digits.push(digit);
            }
            digits.parse().ok()?
        };
        Some(match self.next_is(&['²']) {
            Some(_) => base * base,
            None => base,
        })
    }
}

/// The numbers that are printed give the ratio that is calculated, so none of the factors that the formula names is
/// missing.
#[test]
fn the_printed_numbers_give_the_force() {
    let mut seen = HashSet::new();
    let given = |question: &RestraintQuestion| RestraintQuestion {
        is_floor_given: true,
        ..question.clone()
    };
    let questions = every_question();
    let on_given_floors: Vec<_> = questions.iter().map(given).collect();
    for question in questions.iter().chain(&on_given_floors) {
        for force in restraint_forces(question) {
            let source = &force.source;
            let printed = numbers(source);
            let mut expression = Printed(printed.trim_end_matches(" g").chars().peekable());
            let found = expression.sum();
            assert_eq!(expression.0.next(), None, "{printed}");
            // Up to six factors, each printed with four digits, the level with three.
            let error = found / source.part.formula_ratio - 1.0;
            assert!(error.abs() < 6.0 * 5e-4, "{printed}: {found}, {source:?}");
            seen.insert(source_name(source));
        }
    }
    assert_eq!(seen.len(), 10, "{seen:?}");
}
