//! What is not known is said, and nothing is left as it is on its account.

#![expect(clippy::unwrap_used, reason = "helpers of tests may stop")]

use std::collections::HashMap;
use std::fs;
use std::path::Path;

use freestand_app::job::{Job, assess_into};
use freestand_assess::list::{ListRequest, inventory_of};
use freestand_assess::one_object::{
    Earthquake, Floor, FloorPlace, Object, ObjectRequest, one_object,
};
use freestand_input::quantity::UnitSystem;
use freestand_report::assessment::JobReport;
use freestand_report::object::{ObjectReport, object_report};
use freestand_study::resolve::{Overrides, builtin, resolve_with};
use freestand_study::run::no_progress;
use freestand_study::study::Study;

/// The objects of a list by their names.
struct Assessed {
    rows: HashMap<String, HashMap<String, String>>,
    how: HashMap<String, String>,
    report: JobReport,
}

impl Assessed {
    fn of(&self, id: &str, column: &str) -> &str {
        &self.rows[id][column]
    }
}

fn assess(study: &Study, lines: &str) -> Assessed {
    let folder = tempfile::tempdir().unwrap();
    let list = folder.path().join("list.csv");
    fs::write(&list, lines).unwrap();
    let storeys = study.building.as_ref().map(|building| building.storeys);
    let request = ListRequest {
        storeys,
        ..ListRequest::default()
    };
    let mut study = study.clone();
    // What the answers depend on takes most of the time and decides nothing.
    study.assessment.worlds.shares = Some(false);
    let study = &study;
    let inventory = inventory_of(study, Some(&list), &request).unwrap();
    assert!(!inventory.has_errors(), "{:?}", inventory.findings);
    let out = folder.path().join("out");
    let report = assess_into(study, &inventory, &out, &Job::default(), &no_progress).unwrap();
    let table = |name: &str| -> Vec<HashMap<String, String>> {
        csv::Reader::from_path(out.join(name))
            .unwrap()
            .deserialize()
            .map(|row| row.unwrap())
            .collect()
    };
    let how = table("worklist.csv")
        .into_iter()
        .map(|row| (row["id"].clone(), row["how"].clone()))
        .collect();
    Assessed {
        rows: table("objects.csv")
            .into_iter()
            .map(|row| (row["id"].clone(), row))
            .collect(),
        how,
        report,
    }
}

fn study(text: &str) -> Study {
    resolve_with(text, None, Path::new(""), &Overrides::default()).unwrap()
}

fn overrides(place: &str, storeys: u16) -> Overrides {
    Overrides {
        hazard: [("place", place.to_owned())].into_iter().collect(),
        storeys: Some(storeys),
        ..Overrides::default()
    }
}

fn object(is_round: bool, (place, storeys): (&str, u16), worlds: Option<u32>) -> ObjectReport {
    let object = Object {
        is_round,
        ..Object::of_size(0.4, 0.2)
    };
    let earthquake = Earthquake::Place([("place", place.to_owned())].into_iter().collect());
    let floor = Floor {
        place: FloorPlace::Name("roof".to_owned()),
        storeys: Some(storeys),
        storey_height_m: None,
    };
    let request = ObjectRequest {
        object,
        earthquake,
        floor,
        worlds,
        seed: None,
        units: UnitSystem::Si,
    };
    object_report(one_object(&request, &|| false).unwrap())
}

fn json(report: &ObjectReport) -> serde_json::Value {
    serde_json::to_value(report).unwrap()
}

/// A number of storeys is that building, for a list as for one object: a jar on the roof of two storeys
/// in Christchurch falls in a few worlds, on that of the built-in tower in two of five.
#[test]
#[ignore = "half a minute: hundreds of worlds, twice"]
fn a_list_and_one_object_stand_in_the_same_building() {
    let one = json(&object(false, ("Christchurch", 2), None));
    let listed = assess(
        &builtin(&overrides("Christchurch", 2)).unwrap(),
        "id,floor,height [mm],thickness [mm]\nobject,roof,400,200\n",
    );
    for column in ["p_overturn", "p_overturn_low", "p_overturn_high"] {
        assert_eq!(
            Some(listed.of("object", column).parse().unwrap()),
            one[column].as_f64(),
            "{column}"
        );
    }
    assert!(one["p_overturn"].as_f64().unwrap() < 0.1);
    assert_eq!(
        (listed.of("object", "decision"), &one["decision"]),
        ("leave", &"leave".into())
    );
    assert!(
        !listed.report.place_is_assumed
            && !listed.report.building_is_assumed
            && listed.report.no_study.is_none()
    );
}

const THREE: &str = "id,level_ratio,height [mm],thickness [mm],width [mm]\nground,0,500,400,600\nroof,1,500,400,600\n\
                     tall,1,2000,50,600\n";

/// A tower that nobody described leaves nothing as it is; what falls there is restrained all the same.
/// On the ground no building matters.
#[test]
#[ignore = "a quarter of a minute: several lists"]
fn what_nobody_stated_leaves_nothing_as_it_is() {
    left_as_it_is(&[(
        "[assessment]\n",
        "no-verdict",
        "no-verdict",
        "give place and storeys.",
    )]);
}

#[test]
#[ignore = "half a minute: four towers"]
fn every_other_thing_that_nobody_stated() {
    left_as_it_is(&[
        (
            "[ground]\nplace = \"Melbourne\"\n",
            "leave",
            "no-verdict",
            "give storeys.",
        ),
        (
            "[building]\nname = \"Our museum\"\n",
            "no-verdict",
            "no-verdict",
            "give place and storeys.",
        ),
        (
            "[building]\nstoreys = 30\n",
            "no-verdict",
            "no-verdict",
            "give place.",
        ),
        (
            "[ground]\nplace = \"Melbourne\"\n[building]\nstoreys = 30\n",
            "leave",
            "leave",
            "",
        ),
    ]);
}

/// Studies with the decisions on the ground and on the roof, and what the roof is to be given.
fn left_as_it_is(studies: &[(&str, &str, &str, &str)]) {
    for &(text, ground, roof, keys) in studies {
        let found = assess(&study(text), THREE);
        assert_eq!(
            (found.of("ground", "decision"), found.of("roof", "decision")),
            (ground, roof),
            "{text}"
        );
        assert_eq!(found.of("tall", "decision"), "restrain", "{text}");
        let report = &found.report;
        let is_assumed = (report.place_is_assumed, report.building_is_assumed);
        assert_eq!(
            is_assumed,
            (!text.contains("place"), !text.contains("storeys")),
            "{text}"
        );
        assert_eq!(
            report.no_study.is_some(),
            is_assumed != (false, false),
            "{text}"
        );
        assert!(
            found.how.get("roof").is_none_or(|how| how.ends_with(keys)),
            "{text}: {:?}",
            found.how
        );
    }
}

/// A round object is followed on its rim, by underestimates how often: the upper end of the probability that it falls is at
/// least 8 %.
#[test]
fn what_is_round_is_never_left_as_it_is() {
    round_ones("first = 2\nmost = 2\n", "0.05");
}

/// In enough worlds to leave the square one.
#[test]
#[ignore = "ten seconds: as many worlds as they need"]
fn what_is_round_is_not_left_where_the_square_one_is() {
    round_ones("", "0.05");
    let found = round_ones("", "0.1");
    let left = |id| [found.of(id, "decision"), found.of(id, "falls")];
    assert_eq!(left("can"), ["leave", "stays"]);
    assert_eq!(found.of("can", "p_overturn_high"), "0.08");
    assert_eq!(
        (
            found.of("square", "decision"),
            found.of("square", "is_round")
        ),
        ("leave", "false")
    );
    // What falls as a prism falls.
    assert_eq!(
        (
            found.of("needle", "falls"),
            found.of("needle", "close_call")
        ),
        ("falls", "false")
    );
}

fn round_ones(worlds: &str, accepted: &str) -> Assessed {
    let text = format!(
        "[assessment]\naccepted = {accepted}\n[ground]\nplace = \"Melbourne\"\n[building]\nstoreys = 3\n[worlds]\n{worlds}"
    );
    let header = "id,level_ratio,height [mm],thickness [mm],width [mm],shape,casters,stiffness [N/mm],mass [kg]\n";
    let rows = "square,0,1000,400,400,box,,,\ncan,0,1000,400,400,cylinder,,,\ncart,0,1000,400,400,cylinder,free,,\n\
                pads,0,1000,400,400,cylinder,,500,80\nneedle,0,2000,60,60,cylinder,,,\n";
    let found = assess(&study(&text), &format!("{header}{rows}"));
    let mild = ["can", "cart", "pads"].into_iter();
    for id in mild.filter(|id| accepted == "0.05" || *id == "cart") {
        let row =
            ["decision", "falls", "close_call", "is_round"].map(|column| found.of(id, column));
        assert_eq!(row, ["restrain", "close", "true", "true"], "{id}");
        assert!(
            found.of(id, "why").contains("underestimates how often"),
            "{}",
            found.of(id, "why")
        );
    }
    assert_eq!(
        [found.of("can", "model"), found.of("square", "model")],
        ["hull-3d", "rock"]
    );
    found
}

/// The same of one object.
#[test]
#[ignore = "ten seconds: two objects in as many worlds as they need"]
fn one_object_that_is_round_is_never_left_as_it_is() {
    let [square, round] = [false, true].map(|is_round| object(is_round, ("Melbourne", 3), None));
    let of = |report: &_| {
        let told = json(report);
        ["model", "model_bias", "p_overturn_high"].map(|key| told[key].clone())
    };
    assert_eq!(
        serde_json::json!(of(&square)[..2]),
        serde_json::json!(["rock", false])
    );
    assert_eq!(
        serde_json::json!(of(&round)[..2]),
        serde_json::json!(["hull-3d", true])
    );
    assert!(of(&round)[2].as_f64().unwrap() >= 0.08);
    let assumed = json(&round)["assumptions"].to_string();
    assert!(assumed.contains("underestimated"), "{assumed}");
}

/// 0 of 40 worlds leave up to 10.9 %: too few for 10 %, whatever happens in them. 44 are enough, and the
/// largest number is itself a look.
#[test]
#[ignore = "seconds: many worlds"]
fn too_few_worlds_are_said_with_how_many_would_do() {
    let few = in_worlds(40);
    let row = close_call;
    assert_eq!(row(&few, "unrated"), ["restrain", "40", "44", "true"]);
    assert_eq!(row(&few, "strict"), ["restrain", "40", "228", "true"]);
    assert!(
        few.of("unrated", "why").contains("give most = 44 or more"),
        "{}",
        few.of("unrated", "why")
    );
    let warning = few
        .report
        .warnings
        .iter()
        .find(|text| text.contains("40 worlds at most"))
        .unwrap();
    assert!(
        warning.contains("2 objects of 2") && warning.contains("most = 228"),
        "{warning}"
    );
}

/// An object, and one of which less is accepted, in this many worlds at most.
fn in_worlds(most: u32) -> Assessed {
    let row = "id,level_ratio,height [mm],thickness [mm],width [mm],accepted\nunrated,0,500,400,600,\n\
               strict,0,500,400,600,2 %\n";
    let text = format!(
        "[ground]\nplace = \"Melbourne\"\n[building]\nstoreys = 3\n[worlds]\nmost = {most}\nshares = false\n"
    );
    assess(&study(&text), row)
}

fn close_call(found: &Assessed, id: &str) -> [String; 4] {
    ["decision", "worlds", "worlds_needed", "close_call"]
        .map(|column| found.of(id, column).to_owned())
}

/// The same with as many as would do, and of one object.
#[test]
#[ignore = "ten seconds: 44 worlds of a list, and one object twice"]
fn as_many_worlds_as_would_do_are_enough() {
    let enough = in_worlds(44);
    assert_eq!(close_call(&enough, "unrated"), ["leave", "44", "", "false"]);
    assert_eq!(enough.of("strict", "worlds_needed"), "228");

    let one = |worlds| object(false, ("Melbourne", 3), Some(worlds));
    let warned = |report: &ObjectReport| {
        report
            .warnings
            .iter()
            .any(|text| text.contains("at least 44 are needed"))
    };
    assert_eq!([40, 44].map(|worlds| warned(&one(worlds))), [true, false]);
    assert_eq!(json(&one(40))["worlds_needed"], 44);
}

/// What the study and the list do not say is listed where the answer is read.
#[test]
#[ignore = "a quarter of a minute: several lists"]
fn what_was_assumed_is_listed() {
    let listed = assess(&builtin(&overrides("Christchurch", 2)).unwrap(), THREE);
    let report = &listed.report;
    let all = report.assumptions.join("\n");
    for said in [
        "site class C",
        "a return period of 500 years",
        "storeys of 3.2 m",
        "5 % damping",
        "cg_height (3)",
    ] {
        assert!(all.contains(said), "{said}: {all}");
    }
    let assumed = &report.assumed_columns.0;
    assert!(assumed.contains(&("cg_height", 3)), "{assumed:?}");
    assert!(assumed.iter().all(|(column, _)| *column != "width"));
    assert!(
        listed.of("roof", "assumed").contains("mass, stiffness")
            && !listed.of("roof", "assumed").contains("width")
    );
    assert_eq!(
        listed.of("roof", "assumed_count").parse::<usize>().unwrap(),
        listed.of("roof", "assumed").split(", ").count()
    );

    let said = json(&object(false, ("Christchurch", 2), Some(20)))["assumptions"].to_string();
    for one in [
        "site class C",
        "500 years",
        "storeys of 3.2 m",
        "first period",
        "half the height",
        "one axis",
        "friction",
        "Housner",
        "no casters",
        "nothing beside it",
    ] {
        assert!(said.contains(one), "{one}: {said}");
    }
}

/// Without the height of a recorded floor no object is on it: that is said at once, not of every object.
#[test]
fn a_recorded_floor_needs_its_height() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(
        folder.path().join("m.csv"),
        "time [s],a [g]\n0,0\n0.01,0.1\n0.02,0\n",
    )
    .unwrap();
    fs::write(
        folder.path().join("list.csv"),
        "id,floor,height [mm],thickness [mm]\n1,ground,1800,500\n",
    )
    .unwrap();
    let text = "[building]\nlevels = [{ name = \"ground\", motions = [\"m.csv\"] }]\n";
    let study = resolve_with(text, None, folder.path(), &Overrides::default()).unwrap();
    let inventory = inventory_of(
        &study,
        Some(&folder.path().join("list.csv")),
        &ListRequest::default(),
    )
    .unwrap();
    let refused = assess_into(
        &study,
        &inventory,
        &folder.path().join("out"),
        &Job::default(),
        &no_progress,
    );
    assert!(
        refused
            .unwrap_err()
            .to_string()
            .contains("has no level_ratio")
    );
}
