//! One object: the numbers of a list with one row, the histories of `rock`, and what is refused.

#![expect(clippy::unwrap_used, reason = "helpers of tests may stop")]

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use freestand::block::Block;
use freestand::rocking::{Base, Outcome, RockingOptions, Until, rock};
use freestand_app::job::{Job, assess_into};
use freestand_assess::list::{ListRequest, inventory_of};
use freestand_assess::one_object::{
    Earthquake, Floor, FloorPlace, Object, ObjectRequest, RestsOn, Withstood, one_object,
};
use freestand_input::keys::Words;
use freestand_input::quantity::UnitSystem;
use freestand_input::words::shortest;
use freestand_inventory::{Casters, Surroundings};
use freestand_output::answer::Answer as _;
use freestand_output::facts::Value;
use freestand_report::object::{AnswerKind, ObjectReport, object_report};
use freestand_study::recorded::{MotionFiles, ReadMotion, read_all};
use freestand_study::resolve::StudySource;
use freestand_study::resolve::{Overrides, load};
use freestand_study::run::{LONGEST_TAIL_S, no_progress};

const GROUND: Floor = Floor {
    place: FloorPlace::Ground,
    storeys: None,
    storey_height_m: None,
};

fn request(object: Object, earthquake: Earthquake, floor: Floor) -> ObjectRequest {
    ObjectRequest {
        object,
        earthquake,
        floor,
        worlds: Some(3),
        seed: None,
        units: UnitSystem::Si,
    }
}

fn answer(request: &ObjectRequest) -> ObjectReport {
    object_report(one_object(request, &|| false).unwrap())
}

fn place(name: &str) -> Earthquake {
    Earthquake::Place(Words::from_iter([("place", name.to_owned())]))
}

/// A floor motion of a 30-storey building, times a factor.
fn motions(names: &[&str], scale: &str) -> Vec<ReadMotion> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../validation/rocking/records");
    let words = Words::from_iter([("scale", scale.to_owned())]);
    let mut reader = freestand_input::word_reader::WordReader::new(&words);
    let files = MotionFiles::read(&mut reader, freestand_input::file::as_named);
    let paths: Vec<PathBuf> = names.iter().map(|name| folder.join(name)).collect();
    read_all(&MotionFiles { paths, ..files }).unwrap()
}

/// The number `name` of a report as a list writes it: "overturned" where the quantile overturns.
fn field(report: &ObjectReport, name: &str) -> String {
    match report.facts().get(name) {
        Some(Value::NumberOr(None, word)) => (*word).to_owned(),
        _ => report
            .facts()
            .number(name)
            .map(shortest)
            .unwrap_or_default(),
    }
}

/// The cells of the object "object" of a list that is assessed in a study, by their headings.
fn assessed(study: &Path, list: &Path) -> HashMap<String, String> {
    let study = load(study, &Overrides::default()).unwrap();
    let out = list.with_file_name("out");
    let inventory = inventory_of(&study, Some(list), &ListRequest::default()).unwrap();
    assess_into(&study, &inventory, &out, &Job::default(), &no_progress).unwrap();
    let mut reader = csv::Reader::from_path(out.join("objects.csv")).unwrap();
    let mut rows = reader
        .deserialize()
        .map(|row: Result<HashMap<String, String>, _>| row.unwrap());
    rows.find(|row| row["id"] == "object").unwrap()
}

/// Every number that an object and a list have under the same name, on the third of eight floors,
/// on pads and with a tolerance. The list is in other units and has the floor by its number.
#[test]
#[ignore = "seconds: a list and an object"]
fn a_list_with_this_row_has_the_same_numbers() {
    let folder = tempfile::tempdir().unwrap();
    let (study, list) = (
        folder.path().join("study.toml"),
        folder.path().join("list.csv"),
    );
    let text = "[ground]\nplace = \"Wellington\"\nseed = 3\n[building]\nstoreys = 8\n[worlds]\nfirst = 3\nmost = 6\n\
                shares = false\n";
    std::fs::write(&study, text).unwrap();
    let row = "id,floor,height [mm],thickness [in],width [m],mass [lb],stiffness [N/mm],tolerance [g]\n\
               other,G,900,20,1,100,3000,3\nobject,3,1800,40,1.25,330,4380,10\n";
    std::fs::write(&list, row).unwrap();
    let object = Object {
        width_m: Some(1.25),
        mass_kg: Some(330.0 * 0.453_592_37),
        rests_on: Some(RestsOn::Stiffness(4.38e6)),
        tolerance: Some(Withstood {
            peak_m_s2: 10.0 * freestand::G0_M_S2,
            duration_s: None,
        }),
        ..Object::of_size(1.8, 40.0 * 0.0254)
    };
    let earthquake = Earthquake::Study {
        source: StudySource::File(study.clone()),
        hazard: Words::default(),
    };
    let floor = Floor {
        place: FloorPlace::Name("3".to_owned()),
        ..GROUND
    };
    let report = answer(&ObjectRequest {
        worlds: None,
        ..request(object, earthquake, floor)
    });

    let row = assessed(&study, &list);
    let cell = |name: &str| row[name].clone();

    let numbers = [
        "level_ratio",
        "motions",
        "p_overturn",
        "p_overturn_low",
        "p_overturn_high",
        "p_exceed",
        "p_exceed_low",
        "p_exceed_high",
        "accepted_ratio",
        "confidence",
        "uplift_m_median",
        "rotation_ratio_median",
        "edge_acceleration_g_median",
        "edge_acceleration_g_p16",
        "edge_acceleration_g_p84",
        "edge_acceleration_g_max",
        "edge_acceleration_compliant_g_median",
        "ceiling_g",
        "pulse_duration_s",
        "velocity_change_m_s",
        "pad_uplift_threshold_g",
        "rocking_frequency_hz",
        "demand_capacity_ratio",
        "clearance_m",
    ];
    for name in numbers {
        assert_eq!(field(&report, name), cell(name), "{name}");
    }
    for name in ["falls", "shock", "sliding", "accepted_for"] {
        assert_eq!(report.facts().text(name).unwrap(), cell(name), "{name}");
    }
    assert_eq!(
        report.facts().number("median").map(shortest).unwrap(),
        cell("pfa_g_median")
    );
    assert_eq!(
        report.facts().number("max").map(shortest).unwrap(),
        cell("pfa_g_max")
    );
    // The object rocks, so that these numbers are not all 0.
    assert!(
        report.facts().number("edge_acceleration_g_median").unwrap() > 0.5,
        "{}",
        report.answer
    );
    assert!(
        report
            .answer
            .starts_with("In Wellington (NZS 1170.5, 500 years, site "),
        "{}",
        report.answer
    );
    assert!(
        report.answer.contains(") on floor 3 of 8 this object "),
        "{}",
        report.answer
    );
}

/// Where a national annex has two spectra, one rule chooses: an object alone and the same in a list have the
/// same numbers, the same decision and the same spectrum. The larger velocity of type 1 overturns the tall object;
/// the larger acceleration of type 2 is too much for the tolerance of the low one, which both leave standing.
#[test]
#[ignore = "ten seconds: a list and an object"]
fn a_list_with_this_row_has_the_same_spectrum() {
    same_spectrum(low());
}

#[test]
#[ignore = "ten seconds: the same of a tall object, which the other spectrum decides"]
fn a_list_with_a_tall_row_has_the_same_spectrum() {
    let row = "id,level_ratio,height [mm],thickness [mm]\nobject,0,1200,200\n";
    same_spectrum((Object::of_size(1.2, 0.2), row, false));
}

/// An object, its row, and whether the spectrum of type 2 decides.
type Listed = (Object, &'static str, bool);

fn low() -> Listed {
    let low = Object {
        mass_kg: Some(20.0),
        rests_on: Some(RestsOn::Stiffness(5e5)),
        tolerance: Some(Withstood {
            peak_m_s2: 1.2 * freestand::G0_M_S2,
            duration_s: None,
        }),
        ..Object::of_size(0.3, 0.12)
    };
    let low_row = "id,level_ratio,height [mm],thickness [mm],mass [kg],stiffness [N/mm],tolerance [g]\n\
                   object,0,300,120,20,500,1.2\n";
    (low, low_row, true)
}

fn same_spectrum((object, row, decides_type_2): Listed) {
    let folder = tempfile::tempdir().unwrap();
    let (study, list) = (
        folder.path().join("study.toml"),
        folder.path().join("list.csv"),
    );
    let text = "[ground]\nplace = \"Lisbon\"\n[building]\nstoreys = 2\n[worlds]\nfirst = 20\nmost = 20\n\
                    shares = false\n";
    std::fs::write(&study, text).unwrap();
    std::fs::write(&list, row).unwrap();
    let earthquake = Earthquake::Study {
        source: StudySource::File(study.clone()),
        hazard: Words::default(),
    };
    let report = answer(&ObjectRequest {
        worlds: None,
        ..request(object, earthquake, GROUND)
    });
    let row = assessed(&study, &list);
    for name in [
        "motions",
        "p_overturn",
        "p_overturn_high",
        "p_exceed",
        "uplift_m_median",
        "ceiling_g",
    ] {
        assert_eq!(field(&report, name), row[name], "{name}");
    }
    assert_eq!(
        report.facts().text("decision"),
        Some(row["decision"].as_str())
    );
    let says = |text: &str| text.contains("spectrum of type 2 of the national annex decides");
    let alone = report.warnings.iter().any(|warning| says(warning));
    assert_eq!(
        (alone, says(&row["why"])),
        (decides_type_2, decides_type_2),
        "{:?}",
        report.warnings
    );
}

/// The same at a wall, on free casters and with friction: what an inventory says about the
/// surroundings, in its own units.
#[test]
#[ignore = "seconds: a list and an object"]
fn a_list_with_these_surroundings_has_the_same_numbers() {
    let at_wall = Object {
        mass_kg: Some(120.0),
        friction_ratio: Some((0.3, 0.6)),
        surroundings: Surroundings {
            wall_gap_m: Some(0.02),
            wall_height_m: Some(1.7),
            wall_stiffness_n_m: Some(2e6),
            wall_restitution: Some(0.25),
            ..Surroundings::default()
        },
        ..Object::of_size(1.95, 0.42)
    };
    let wall_row = "id,level_ratio,height [mm],thickness [mm],mass [kg],friction,wall_gap [mm],wall_height [m],\
                    wall_stiffness [N/mm],wall_restitution\nobject,0.5,1950,420,120,0.3-0.6,20,1.7,2000,25 %\n";
    let rolling = Object {
        width_m: Some(0.9),
        mass_kg: Some(120.0),
        tolerance: Some(Withstood {
            peak_m_s2: 8.0 * freestand::G0_M_S2,
            duration_s: None,
        }),
        surroundings: Surroundings {
            wall_stiffness_n_m: Some(5e5),
            casters: Some(Casters::Free),
            rolling_resistance_ratio: Some(0.03),
            clearance_m: Some(0.15),
            ..Surroundings::default()
        },
        ..Object::of_size(1.4, 0.6)
    };
    let rolling_row = "id,level_ratio,height [mm],thickness [mm],width [mm],mass [kg],tolerance [g],casters,\
                       rolling_resistance,clearance [mm],wall_stiffness [N/mm]\n\
                       object,0.5,1400,600,900,120,8,free,3 %,150,500\n";
    for (object, row, model) in [
        (at_wall, wall_row, "rock-wall"),
        (rolling, rolling_row, "roll"),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let (study, list) = (
            folder.path().join("study.toml"),
            folder.path().join("list.csv"),
        );
        let text = "[ground]\nplace = \"Wellington\"\nseed = 3\n[building]\nstoreys = 8\n[worlds]\nfirst = 6\n\
                    most = 6\nshares = false\n";
        std::fs::write(&study, text).unwrap();
        std::fs::write(&list, row).unwrap();
        let earthquake = Earthquake::Study {
            source: StudySource::File(study.clone()),
            hazard: Words::default(),
        };
        let floor = Floor {
            place: FloorPlace::Share(0.5),
            ..GROUND
        };
        let report = answer(&ObjectRequest {
            worlds: None,
            ..request(object, earthquake, floor)
        });

        let row = assessed(&study, &list);
        let cell = |name: &str| row[name].clone();
        for name in [
            "motions",
            "p_overturn",
            "p_lean",
            "p_exceed",
            "wall_speed_m_s_median",
            "wall_acceleration_g_median",
            "slide_m_median",
            "slide_m_p84",
            "trip_margin",
        ] {
            assert_eq!(field(&report, name), cell(name), "{name}");
        }
        for name in ["falls", "shock", "model"] {
            assert_eq!(report.facts().text(name).unwrap(), cell(name), "{name}");
        }
        assert_eq!(report.facts().text("model"), Some(model));
        // Something happens: it strikes its wall, or rolls.
        let number = |name: &str| report.facts().number(name).unwrap_or(0.0);
        assert!(
            number("wall_speed_m_s_median") > 0.1 || number("slide_m_median") > 0.05,
            "{}",
            report.answer
        );
    }
}

/// Under given motions every motion counts once, and its history is that of `rock`, at every scale.
#[test]
fn given_motions_are_those_of_rock() {
    let names = ["synthfloor.csv", "onesine_T1.0.csv", "decsine_f1.25.csv"];
    let motions = motions(&names, "1");
    let scales = vec![1.0, 3.0, 3.5, 4.0];
    let earthquake = Earthquake::Motions {
        motions: motions.clone(),
        scales: scales.clone(),
    };
    let report = answer(&ObjectRequest {
        worlds: None,
        ..request(Object::of_size(1.8, 0.5), earthquake, GROUND)
    });
    let block = Block::uniform(1.8, 0.5).unwrap();
    let options = RockingOptions {
        until: Until::Settled {
            at_most_s: LONGEST_TAIL_S,
        },
        ..RockingOptions::default()
    };
    assert_eq!(report.scales.len(), scales.len());
    for (row, scale) in report.scales.iter().zip(scales) {
        let (mut lifted, mut overturned, mut uplift_m) = (0, 0, None::<f64>);
        for read in &motions {
            let motion = read.motion.motion.scaled(scale).unwrap();
            let found = rock(
                &block,
                Base {
                    horizontal: Some(&motion),
                    vertical: None,
                },
                &options,
            )
            .unwrap();
            lifted += u32::from(found.outcome != Outcome::NoUplift);
            overturned += u32::from(found.outcome == Outcome::Overturned);
            if found.outcome == Outcome::Rocked {
                uplift_m = Some(uplift_m.map_or(found.uplift_m, |most| most.max(found.uplift_m)));
            }
        }
        let count = |name: &str| row.facts().number(name).map(|count| count as u32);
        assert_eq!(
            (count("motions_lifted"), count("motions_overturned")),
            (Some(lifted), Some(overturned)),
            "{scale}"
        );
        assert_eq!(
            (count("motions"), row.facts().number("scale_ratio")),
            (Some(3), Some(scale))
        );
        // The kernel and the scalar solver agree to 4e-10 of a rotation at their standard accuracy.
        match (row.facts().number("uplift_m_max"), uplift_m) {
            (Some(found), Some(expected)) => {
                assert!((found / expected - 1.0).abs() < 1e-6, "{found} {expected}")
            }
            (found, expected) => assert_eq!(found, expected, "{scale}"),
        }
    }
    // Something happens at the largest scale and not at the first.
    assert_eq!(report.kind, AnswerKind::DoesNotRock);
    assert!(
        report.scales[3]
            .facts()
            .number("motions_overturned")
            .unwrap()
            >= 1.0
    );
    assert!(report.facts().number("level_ratio").is_none());
}

/// The sentence is about the motions themselves: those that are read with a factor have it already.
#[test]
fn one_motion_on_pads() {
    let object = Object {
        mass_kg: Some(150.0),
        rests_on: Some(RestsOn::Stiffness(4.38e6)),
        tolerance: Some(Withstood {
            peak_m_s2: 98.0665,
            duration_s: Some(0.011),
        }),
        ..Object::of_size(1.8, 0.5)
    };
    let earthquake = Earthquake::Motions {
        motions: motions(&["synthfloor.csv"], "3.5"),
        scales: Vec::new(),
    };
    let report = answer(&ObjectRequest {
        worlds: None,
        ..request(object, earthquake, GROUND)
    });
    assert_eq!(report.kind, AnswerKind::Rocks);
    assert!(
        report
            .answer
            .starts_with("Under this motion this object stays standing: it lifts an edge, by ")
    );
    assert!(
        report.answer.contains(" 10 g of 11 ms that it withstands"),
        "{}",
        report.answer
    );
    assert_eq!(report.facts().number("motions"), Some(1.0));
    // Nothing is drawn: the stiffness is as given, the damping the middle of what is drawn elsewhere.
    let again = answer(&ObjectRequest {
        seed: Some(99),
        worlds: None,
        ..request(
            Object {
                mass_kg: Some(150.0),
                rests_on: Some(RestsOn::Stiffness(4.38e6)),
                tolerance: Some(Withstood {
                    peak_m_s2: 98.0665,
                    duration_s: Some(0.011),
                }),
                ..Object::of_size(1.8, 0.5)
            },
            Earthquake::Motions {
                motions: motions(&["synthfloor.csv"], "3.5"),
                scales: Vec::new(),
            },
            GROUND,
        )
    });
    assert_eq!(report.answer, again.answer);
    assert_eq!(
        report.facts().number("landing_acceleration_g_max"),
        again.facts().number("landing_acceleration_g_max")
    );
}

#[test]
fn floors_as_people_name_them() {
    let on = |name: &str| {
        let floor = Floor {
            place: FloorPlace::Name(name.to_owned()),
            storeys: Some(6),
            storey_height_m: Some(3.0),
        };
        answer(&ObjectRequest {
            worlds: Some(1),
            ..request(Object::of_size(2.0, 0.3), place("Athens"), floor)
        })
    };
    for (name, words, ratio) in [
        ("3", "on floor 3 of 6", 0.5),
        ("3rd floor", "on floor 3 of 6", 0.5),
        ("6", "on floor 6 of 6", 1.0),
        ("Roof", "on the roof", 1.0),
        ("G", "on the ground", 0.0),
        ("mezzanine", "on \"mezzanine\"", 0.5 / 6.0),
    ] {
        let report = on(name);
        let expected = format!("In Athens (Eurocode 8, approximate hazard, confirm) {words}");
        assert!(report.answer.starts_with(&expected), "{}", report.answer);
        assert!(
            (report.facts().number("level_ratio").unwrap() - ratio).abs() < 1e-12,
            "{name}"
        );
    }
    let share = Floor {
        place: FloorPlace::Share(0.5),
        storeys: Some(6),
        storey_height_m: None,
    };
    let report = answer(&ObjectRequest {
        worlds: Some(1),
        ..request(Object::of_size(2.0, 0.3), place("Athens"), share)
    });
    assert!(
        report
            .answer
            .contains("at 50 % of the height of the building"),
        "{}",
        report.answer
    );
}

/// The document has it all, and people read at most 20 lines.
#[test]
fn the_longest_answer() {
    let object = Object {
        mass_kg: Some(150.0),
        rests_on: Some(RestsOn::Entry("rubber-foot + carpet-underlay".to_owned())),
        tolerance: Some(Withstood {
            peak_m_s2: 50.0,
            duration_s: None,
        }),
        ..Object::of_size(1.8, 0.6)
    };
    let floor = Floor {
        place: FloorPlace::Name("2".to_owned()),
        storeys: Some(5),
        storey_height_m: None,
    };
    // Of three worlds with few falls the interval holds 10 %.
    let report = answer(&request(object.clone(), place("Basel"), floor.clone()));
    assert!(report.answer.starts_with(
        "In Basel (Eurocode 8, approximate hazard, confirm) on floor 2 of 5 this object "
    ));
    assert!(
        report
            .warnings
            .iter()
            .any(|warning| warning.contains("too close to call")),
        "{:?}",
        report.warnings
    );
    let lines = report.facts().lines();
    assert!(lines.len() > 16 && lines.len() <= 20, "{lines:?}");
    assert!(
        lines
            .iter()
            .any(|(_, text)| text.contains("ground type B, because no site was given")),
        "{lines:?}"
    );
    let report = answer(&request(
        object,
        Earthquake::GroundAcceleration {
            peak_m_s2: 0.4 * freestand::G0_M_S2,
            near_fault: None,
        },
        floor,
    ));
    assert!(
        report
            .answer
            .starts_with("At a ground acceleration of 0.4 g on floor 2 of 5 this object ")
    );
    let lines = report.facts().lines();
    assert!(lines.len() > 14 && lines.len() <= 20, "{lines:?}");
    let json = serde_json::to_value(report).unwrap();
    for key in [
        "answer",
        "answer_kind",
        "falls",
        "shock",
        "lift_acceleration_g",
        "assumptions",
        "place",
    ] {
        assert!(json.get(key).is_some(), "{key}");
    }
    assert_eq!(json["floor_acceleration_g"].as_object().unwrap().len(), 2);
    // t/h of a uniform block.
    assert!((json["lift_acceleration_g"].as_f64().unwrap() - 1.0 / 3.0).abs() < 1e-12);
}

#[test]
fn what_contradicts_itself_is_refused_at_once() {
    let problems = |request: &ObjectRequest| -> Vec<String> {
        let error = one_object(request, &|| false).unwrap_err();
        error
            .problems
            .into_iter()
            .map(|problem| format!("{}|{}", problem.message, problem.hint.unwrap_or_default()))
            .collect()
    };
    let tolerance = Some(Withstood {
        peak_m_s2: 50.0,
        duration_s: None,
    });
    let floor = Floor {
        place: FloorPlace::Name("2".to_owned()),
        storeys: None,
        storey_height_m: Some(3.0),
    };
    let all = problems(&request(
        Object {
            tolerance,
            ..Object::of_size(0.5, 2.0)
        },
        place("Athens"),
        floor,
    ));
    assert_eq!(all.len(), 3, "{all:?}");
    for (found, expected) in all.iter().zip([
        "were they swapped?",
        "`tolerance` needs `mass` and `on`",
        "`storeys`",
    ]) {
        assert!(found.contains(expected), "{found}");
    }
    let six = |name: &str| Floor {
        place: FloorPlace::Name(name.to_owned()),
        storeys: Some(6),
        storey_height_m: None,
    };
    let found = problems(&request(
        Object::of_size(2.0, 0.3),
        place("Athens"),
        six("9"),
    ));
    assert!(
        found[0].starts_with("`floor` \"9\" is not a floor of the building|write 1 to 6"),
        "{found:?}"
    );
    // Half a storey is a floor whose height is assumed: that is said, and it is used.
    let asked = request(Object::of_size(2.0, 0.3), place("Athens"), six("mezzanine"));
    let report = answer(&asked);
    let said = "`floor` \"mezzanine\" is half a storey; it was taken as the one above the ground; give `level_ratio`";
    let says = |warning: &String| warning.starts_with(said);
    assert!(report.warnings.iter().any(says), "{:?}", report.warnings);
    let found = problems(&request(
        Object::of_size(2.0, 0.3),
        place("Welington"),
        GROUND,
    ));
    assert!(found[0].contains("Wellington"), "{found:?}");
    let entry = Object {
        mass_kg: Some(100.0),
        rests_on: Some(RestsOn::Entry("ruber-foot".to_owned())),
        cg_height_m: Some(2.5),
        ..Object::of_size(2.0, 0.3)
    };
    let found = problems(&request(entry, place("Athens"), GROUND));
    assert_eq!(found.len(), 2, "{found:?}");
    assert!(
        found
            .iter()
            .any(|one| one.starts_with("`cg_height` \"2.5 m\" is not below the top")),
        "{found:?}"
    );
    assert!(
        found.iter().any(|one| one.starts_with("`on` \"ruber-foot\" is not") && one.contains("rubber-foot")),
        "{found:?}"
    );
    let scaled = Earthquake::Motions {
        motions: motions(&["synthfloor.csv"], "1"),
        scales: vec![0.5, 0.0],
    };
    let found = problems(&request(Object::of_size(2.0, 0.3), scaled, GROUND));
    assert_eq!(found.len(), 2, "{found:?}");
    assert!(
        found[1].starts_with("`scales` must be above 0, not 0|"),
        "{found:?}"
    );
}

/// What contradicts itself about the surroundings, and what a list refuses under its own column.
#[test]
fn surroundings_that_are_not_there() {
    let found = |surroundings: Surroundings, tolerance: Option<Withstood>| -> Vec<String> {
        let object = Object {
            surroundings,
            tolerance,
            ..Object::of_size(2.0, 0.3)
        };
        let error = one_object(&request(object, place("Athens"), GROUND), &|| false).unwrap_err();
        error
            .problems
            .into_iter()
            .map(|problem| problem.message)
            .collect()
    };
    let none = Surroundings::default();
    let all = found(
        Surroundings {
            wall_height_m: Some(1.0),
            wall_stiffness_n_m: Some(1e6),
            rolling_resistance_ratio: Some(0.02),
            ..none
        },
        None,
    );
    assert_eq!(all.len(), 3, "{all:?}");
    let beside = found(
        Surroundings {
            neighbour_gap_m: Some(0.1),
            ..none
        },
        None,
    );
    assert!(
        beside[0].contains("direction of the width, which is not given"),
        "{beside:?}"
    );
    let tolerance = Some(Withstood {
        peak_m_s2: 50.0,
        duration_s: None,
    });
    let stop = found(
        Surroundings {
            casters: Some(Casters::Free),
            ..none
        },
        tolerance,
    );
    assert!(
        stop[0].contains("needs `mass` and `wall_stiffness`"),
        "{stop:?}"
    );
    let elastic = found(
        Surroundings {
            wall_gap_m: Some(0.1),
            wall_restitution: Some(1.0),
            ..none
        },
        None,
    );
    assert!(
        elastic[0].contains("`wall_restitution` \"1\" must be from 0 to below 1"),
        "{elastic:?}"
    );
}

/// A stop is a stop.
#[test]
fn it_can_be_stopped() {
    let error = one_object(
        &request(Object::of_size(2.0, 0.3), place("Athens"), GROUND),
        &|| true,
    )
    .unwrap_err();
    assert!(error.is_stopped(), "{error:?}");
}
