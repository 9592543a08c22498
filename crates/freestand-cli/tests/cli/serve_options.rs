//! What the page may ask for, and how it is told what is wrong.

use super::serve::{Page, message, with_options};
use crate::program::PROGRAM;
use serde_json::{Value, json};
use std::path::Path;
use std::process::Command;

#[test]
fn options_that_name_files_are_refused() {
    let page = Page::open();
    let facts = page.get("/api/v1/facts");
    let facts: Value =
        serde_json::from_slice(&facts[facts.iter().position(|byte| *byte == b'{').unwrap()..])
            .unwrap();
    let mut count = 0;
    for command in facts["commands"].as_array().unwrap() {
        let command = command.as_str().unwrap();
        let help = Command::new(PROGRAM)
            .args(command.split(' '))
            .arg("--help")
            .output()
            .unwrap();
        let help = String::from_utf8(help.stdout).unwrap();
        let flags = help
            .lines()
            .filter_map(|line| line.trim_start().strip_prefix("--"))
            .map(|line| line.split([' ', '=']));
        for flag in flags.filter_map(|mut words| words.next()) {
            let is_path = [
                "out", "csv", "history", "plot", "cushion", "study", "library", "spectrum",
            ];
            if is_path.contains(&flag) {
                let error = page.refused(&with_options(command, &json!({flag: "/etc/passwd"})));
                // What is no part of a request is not known to it.
                let said = [
                    "names a file",
                    "is not known",
                    "is not a file of this request",
                ];
                assert!(
                    said.iter().any(|said| error.to_string().contains(said)),
                    "{command} --{flag}: {error}"
                );
                count += 1;
            }
        }
    }
    assert!(count > 20, "{count}");
    for command in [
        "run",
        "serve",
        "check",
        "motion simulate",
        "inventory template",
        "",
        "object --out=x",
        "motion",
    ] {
        let error = page.refused(&with_options(command, &json!({})));
        assert!(message(&error).contains("cannot ask"), "{command}: {error}");
    }
    for option in ["json", "threads", "quiet", "force", "help", "out"] {
        page.refused(&with_options("validate", &json!({option: true})));
    }
    // A value is never taken for a flag.
    let found = page.answered(&with_options(
        "tolerance search",
        &json!({"words": ["--library=/etc/passwd"]}),
    ));
    assert_eq!(found["entries"], json!([]));
}

#[test]
fn what_is_asked_can_be_typed_with_the_names_of_the_files() {
    let page = Page::open();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("my list.csv");
    std::fs::write(&path, "item,height,thickness\nrack,2 m,0.6 m\n").unwrap();
    let id = page.upload(&path);
    let typed = |request: &Value| {
        page.post(
            "/api/v1/asked",
            "application/json",
            request.to_string().as_bytes(),
        )
    };
    let list = json!({"command": "assess", "options": {"place": "Athens", "storeys": 3}, "files": {"inventory": [id]},
        "edits": [{"cell": "B2", "value": "1,9 m"}], "shape": "events"});
    let (status, told) = typed(&list);
    assert_eq!(status, 200, "{told}");
    assert_eq!(
        told["line"],
        r#"freestand assess --place Athens --inventory "my list.csv" --edit "B2=1,9 m" --storeys 3"#
    );
    assert_eq!(
        told["python"],
        "import freestand as fs\nfs.assess(place=\"Athens\", inventory=\"my list.csv\", edits=[\"B2=1,9 m\"], storeys=3)"
    );
    let (status, told) = typed(&json!({"command": "no such"}));
    assert_eq!(status, 400, "{told}");
}

#[test]
fn texts_of_fields_are_read() {
    let page = Page::open();
    let read = |body: &Value| {
        page.post(
            "/api/v1/quantities",
            "application/json",
            body.to_string().as_bytes(),
        )
    };
    let texts = json!({"texts": [{"text": "1,8", "quantity": "length", "units": "si"}, {"text": "?", "quantity": "mass", "units": "us"}]});
    let expected = json!({"read": [{"asked": "1.8 m", "si": 1.8}, {"asked": "?", "si": null}]});
    assert_eq!(read(&texts), (200, expected));
    for wrong in [
        json!({}),
        json!({"texts": [{"text": "1", "quantity": "colour", "units": "si"}]}),
    ] {
        assert_eq!(read(&wrong).0, 400, "{wrong}");
    }
}

#[test]
fn the_messages_are_those_of_the_command_line() {
    let page = Page::open();
    let size = json!({"height": "2 apples", "thickness": "0.5 m", "mass": "100 kg"});
    let error = page.refused(&with_options("shock", &size));
    assert_eq!(error["key"], "height");
    assert!(message(&error).starts_with("--height: "), "{error}");
    let error = page.refused(&with_options("shock", &json!({"depth": 1})));
    assert!(message(&error).contains("--depth is not known"), "{error}");
    assert_eq!(error["key"], "depth");
}

/// Whatever is wrong with a field is said without the errors of a parser, and with what the user typed as it is.
#[test]
fn no_message_is_that_of_a_parser() {
    let page = Page::open();
    let good = json!({"height": "1.8 m", "thickness": "0.4 m", "place": "Melbourne", "worlds": 1});
    let names = [
        "height",
        "thickness",
        "width",
        "cg-height",
        "mass",
        "on",
        "tolerance",
        "friction",
        "wall-gap",
        "wall-height",
        "neighbour-gap",
        "clearance",
        "casters",
        "upper-height",
        "upper-thickness",
        "upper-mass",
        "place",
        "site",
        "pga",
        "floor",
        "level-ratio",
        "storeys",
        "storey-height",
        "return-period",
        "scales",
        "unit",
    ];
    let wrong = ["x", "1,8 m", "3 apples", "0.4 m --out x"];
    let mut requests = vec![
        with_options("object", &json!({})),
        with_options("object", &json!({"height": "1.8 m", "thickness": "0.4 m"})),
        with_options("assess", &json!({"place": "Atlantis"})),
        with_options("assess", &json!({"storeys": "seven"})),
        with_options("inventory check", &json!({})),
        with_options("cushion drop", &json!({})),
        with_options("spectrum", &json!({"heights": "1"})),
        with_options("motion info", &json!({})),
        with_options("run", &json!({})),
    ];
    for name in names {
        for value in wrong {
            let mut options = good.clone();
            options[name] = value.into();
            requests.push(with_options("object", &options));
        }
    }
    let mut count = 0;
    for request in &requests {
        let (status, answer) = page.run(request);
        let error = &answer["error"];
        // Some of these values are good for some of these fields.
        if status == 200 {
            continue;
        }
        count += 1;
        let mut told = vec![error];
        told.extend(error["others"].as_array().into_iter().flatten());
        for told in told {
            for text in [&told["message"], &told["hint"]] {
                let text = text.as_str().unwrap();
                assert!(!text.contains("invalid digit"), "{request}: {text}");
                assert!(!text.contains('“'), "{request}: {text}");
            }
        }
    }
    assert!(count > 80, "{count} refusals");
}

/// The page marks the field that is wrong, whoever finds it: the parser, the server or the command.
#[test]
fn a_refusal_names_its_option() {
    let page = Page::open();
    let object = |more: &Value| {
        let mut options = json!({"height": "1.8 m", "thickness": "0.4 m", "place": "Melbourne"});
        options
            .as_object_mut()
            .unwrap()
            .extend(more.as_object().unwrap().clone());
        page.refused(&with_options("object", &options))
    };
    for (more, key) in [
        (json!({"storeys": "many", "floor": "roof"}), "storeys"),
        (json!({"casters": "locked"}), "casters"),
        (json!({"pga": "0.2 apples"}), "pga"),
        (json!({"mass": {"kg": 100}}), "mass"),
        (json!({"thickness": "2 m"}), "thickness"),
        (json!({"place": "Atlantis"}), "place"),
    ] {
        let error = object(&more);
        assert_eq!(error["key"], key, "{more}: {error}");
    }
    // So is an option that is missing.
    let error = page.refused(&with_options("shock", &json!({})));
    assert_eq!(error["key"], "height", "{error}");
}

#[test]
fn an_edit_changes_the_cell_that_it_names_only() {
    let page = Page::open();
    for (cell, value) in [("C2=5\nD2", "1"), ("C2=5", "1"), ("C2", "5\nD2=1")] {
        let error = page.refused(
            &json!({"command": "inventory check", "edits": [{"cell": cell, "value": value}]}),
        );
        assert_eq!(error["key"], "edit", "{cell:?}: {error}");
    }
}

/// Nobody waits so long for a live answer, and a job may take its time.
#[test]
fn a_live_shock_spectrum_has_a_bound() {
    let page = Page::open();
    let pulse = |frequencies: &str| {
        let options = json!({"pulse": "half-sine", "peak-acceleration": "30 g", "duration": "11 ms",
            "frequencies": frequencies});
        with_options("shock-spectrum", &options)
    };
    let error = page.refused(&pulse("1 Hz:1e6 Hz:1000000"));
    assert!(message(&error).contains("frequencies"), "{error}");
    page.answered(&pulse("20 Hz, 45 Hz"));
}

#[test]
fn a_history_is_thinned_and_rises() {
    let page = Page::open();
    let options = json!({"height": "1.5 m", "thickness": "0.3 m", "initial-rotation": "5 deg", "duration": "5 s",
        "mass": "100 kg", "stiffness": "4000 N/mm"});
    let mut one = with_options("rock", &options);
    let plain = page.answered(&one);
    one["history"] = json!(true);
    let mut drawn = page.answered(&one);
    let history = drawn
        .as_object_mut()
        .unwrap()
        .shift_remove("history")
        .unwrap();
    assert_eq!(plain, drawn);
    let numbers = |name: &str| -> Vec<f64> {
        history[name]
            .as_array()
            .unwrap()
            .iter()
            .map(|value| value.as_f64().unwrap())
            .collect()
    };
    let (times, angles) = (numbers("time_s"), numbers("theta_rad"));
    assert_eq!(times.len(), angles.len());
    assert!(times.windows(2).all(|two| two[0] < two[1]));
    let impacts = history["impacts"].as_array().unwrap();
    assert_eq!(
        impacts.len(),
        plain["impact_count"].as_u64().unwrap() as usize
    );
    assert!(impacts[0]["edge_acceleration_g"].as_f64().unwrap() > 0.0);
    // It is released leaning to the right, so its left edge lands first.
    assert_eq!(impacts[0]["edge"], "left");
    assert!(
        impacts
            .iter()
            .all(|impact| times.contains(&impact["time_s"].as_f64().unwrap()))
    );
}

/// The columns that a command writes are the same as those made from its rows.
#[test]
fn columns_have_the_numbers_of_the_rows() {
    let page = Page::open();
    let options = json!({"place": "Melbourne", "count": 2, "storeys": 3, "level-ratio": 1, "heights": "1 m, 2 m",
        "thicknesses": "300 mm, 400 mm, 500 mm", "mass": "100 kg", "stiffness": "4000 N/mm"});
    let mut one = with_options("spectrum", &options);
    let rows = page.answered(&one);
    one["shape"] = json!("columns");
    let turned = page.answered(&one);
    let list = rows["rows"].as_array().unwrap();
    assert_eq!(list.len(), 12);
    let columns = turned["rows"].as_object().unwrap();
    for (name, column) in columns {
        let expected: Vec<Value> = list
            .iter()
            .map(|row| row.get(name).cloned().unwrap_or(Value::Null))
            .collect();
        assert_eq!(column, &json!(expected), "{name}");
    }
    for name in list.iter().flat_map(|row| row.as_object().unwrap().keys()) {
        assert!(columns.contains_key(name), "{name}");
    }
    assert_eq!(rows["processing"], turned["processing"]);
    one["history"] = json!({"motion": "synthetic-02"});
    assert!(message(&page.refused(&one)).contains("one object"));
    one["options"]["heights"] = json!("2 m");
    one["options"]["thicknesses"] = json!("300 mm");
    let cell = page.answered(&one);
    assert_eq!(
        (&cell["followed"], &cell["history"]["height_m"]),
        (&json!("synthetic-02"), &json!(2.0))
    );
    assert_eq!(cell["rows"]["uplift_m"][1], turned["rows"]["uplift_m"][9]);
}

/// The histories of a scan: of `object` in the earthquake that is followed, and of `rock`; and its triangles.
#[test]
fn a_scan_has_a_history_and_a_surface() {
    let page = Page::open();
    let folder = tempfile::tempdir().unwrap();
    let scan = page.upload(Path::new(&crate::bodies::scan(&folder)));
    let motion = page.upload(Path::new(&crate::bodies::motion(&folder, "push.txt", 0.35)));
    let options = json!({"scan-unit": "mm", "pga": "0.3 g", "worlds": 2});
    let mut object = with_options("object", &options);
    object["files"] = json!({"scan": scan});
    object["history"] = json!(true);
    let (status, found) = page.run(&object);
    assert_eq!(status, 200, "{found}");
    let numbers = |value: &Value| -> Vec<f64> {
        let all = value.as_array().unwrap().iter();
        all.map(|one| one.as_f64().unwrap()).collect()
    };
    let is_history = |history: &Value| {
        let times = numbers(&history["time_s"]);
        assert!(times.windows(2).all(|two| two[0] < two[1]));
        assert_eq!(times[0], 0.0);
        assert_eq!(history["theta_rad"].as_array().unwrap().len(), times.len());
        let space = &history["space"];
        for values in [&space["place_m"], &space["turn"]] {
            let all = values.as_array().unwrap().iter();
            assert!(all.map(numbers).all(|values| values.len() == times.len()));
        }
        assert!(space["weakest_rad"].is_number());
        assert!(space["tolerance_m"].as_f64().unwrap() <= 1e-4);
        // 0.02 degrees.
        assert!(history["tolerance_rad"].as_f64().unwrap() < 3.5e-4);
        // A unit quaternion, to the seven decimals that are handed out.
        let turn: Vec<Vec<f64>> = space["turn"]
            .as_array()
            .unwrap()
            .iter()
            .map(numbers)
            .collect();
        let size = |i: usize| turn.iter().map(|values| values[i].powi(2)).sum::<f64>();
        assert!((0..times.len()).all(|i| (size(i) - 1.0).abs() < 1e-6));
    };
    is_history(&found["history"]);
    // Each of the earthquakes that are shown ends as its history does.
    for one in found["earthquakes"].as_array().unwrap() {
        let mut named = object.clone();
        named["history"] = json!({"motion": one["name"]});
        let (_, told) = page.run(&named);
        is_history(&told["history"]);
        assert_eq!(told["history"]["outcome"], one["outcome"], "{one}");
    }
    let asked = object.to_string().replace("\"history\":true,", "");
    let (status, bytes) = page.bytes("/api/v1/surface", "application/json", asked.as_bytes());
    assert_eq!(status, 200);
    let whole = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
    assert_eq!((whole(0), whole(4)), (8, 12));
    assert_eq!(bytes.len(), 8 + 8 * 12 + 12 * 12);
    // The box of 0.2 m × 0.3 m × 1 m about its centre of gravity.
    let place = |at: usize| f32::from_le_bytes(bytes[8 + 4 * at..12 + 4 * at].try_into().unwrap());
    for (axis, half_m) in [(0, 0.1), (1, 0.15), (2, 0.5)] {
        assert!((0..8).all(|vertex| (place(3 * vertex + axis).abs() - half_m).abs() < 1e-6));
    }
    let options = json!({"scan-unit": "mm", "unit": "g", "dt": "10 ms"});
    let mut rock = with_options("rock", &options);
    rock["files"] = json!({"scan": scan, "motion": motion});
    rock["history"] = json!(true);
    let (status, found) = page.run(&rock);
    assert_eq!(status, 200, "{found}");
    is_history(&found["history"]);
    let tilts = numbers(&found["history"]["theta_rad"]);
    let peak = tilts.into_iter().fold(0.0, f64::max);
    let told = found["peak_tilt_rad"].as_f64().unwrap();
    // The largest tilt may lie between two points.
    assert!((peak - told).abs() < 3.5e-4, "{peak} {told}");
    // Beside walls that it leans on, its history ends as the answer does.
    let options = json!({
        "shape": "box", "height": "1.5 m", "thickness": "0.3 m", "width": "0.4 m", "unit": "g", "dt": "10 ms",
        "wall-gap-left": "0.5 m", "wall-gap-right": "0.5 m", "wall-damping": "0.1", "mass": "80 kg",
        "wall-stiffness": "1000 N/mm",
    });
    let mut beside = with_options("rock", &options);
    beside["files"] = json!({"motion": motion});
    beside["history"] = json!(true);
    let (status, found) = page.run(&beside);
    assert_eq!(status, 200, "{found}");
    assert_eq!(found["outcome"], "leaned");
    assert_eq!(found["history"]["outcome"], "leaned");
    // An object in a plane has no surface.
    let flat = json!({"height": "1 m", "thickness": "0.3 m", "pga": "0.3 g"});
    let (status, told) = page.post(
        "/api/v1/surface",
        "application/json",
        with_options("object", &flat).to_string().as_bytes(),
    );
    assert_eq!(status, 400, "{told}");
    assert!(message(&told["error"]).contains("in a plane"), "{told}");
}

/// A list names scans that were sent with it, and no other file of the machine: whether there is one is not told.
#[test]
fn a_list_cannot_name_other_files_as_scans() {
    let page = Page::open();
    let folder = tempfile::tempdir().unwrap();
    let list = folder.path().join("list.csv");
    let outside = "is not in the folder of the list";
    for (named, message) in [
        ("/etc/passwd", outside),
        ("/no/such/file", outside),
        ("../../../../etc/passwd", outside),
        ("gone.obj", "is not a file of this request"),
    ] {
        let text = format!("id,level_ratio,scan,scan unit\na,0,{named},m\n");
        std::fs::write(&list, text).unwrap();
        let request =
            json!({"command": "inventory check", "files": {"file": [page.upload(&list)]}});
        let (status, answer) = page.run(&request);
        assert_eq!(status, 200, "{answer}");
        let told = answer["problems"].to_string();
        assert!(told.contains(message), "{named}: {told}");
    }
}
