//! `freestand spectrum`: rows that are written as they come, vertical motions, sensitivities.

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use serde_json::Value;

use crate::program::{self, PROGRAM, command, execute};

/// Swells to 1.2 m/s² within 4 s and goes again; the second column is quicker and half as strong.
fn record() -> String {
    let row = |k: u32| {
        let t = f64::from(k) / 100.0;
        let wave =
            |f: f64| (-0.5 * (t - 4.0) * (t - 4.0)).exp() * (std::f64::consts::TAU * f * t).sin();
        format!("{t},{:.6},{:.6}\n", 1.2 * wave(0.9), 0.6 * wave(2.3))
    };
    format!(
        "time [s],h [m/s2],v [m/s2]\n{}",
        (0..=1200).map(row).collect::<String>()
    )
}

fn folder() -> tempfile::TempDir {
    let record = record();
    program::folder(&[
        ("r.csv", &record),
        (
            "short.csv",
            &record.lines().take(500).collect::<Vec<_>>().join("\n"),
        ),
    ])
}

/// A spectrum of `r.csv`, 3 times as strong.
fn spectrum(folder: &Path, grid: [&str; 2], more: &[&str]) -> Output {
    let object = [
        "spectrum",
        "--motion",
        "r.csv",
        "--component",
        "1",
        "--scale",
        "3",
        "--heights",
        grid[0],
    ];
    execute(
        folder,
        &[&object[..], &["--thicknesses", grid[1]], more].concat(),
    )
}

fn document(output: &Output) -> Value {
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    serde_json::from_slice(&output.stdout).unwrap()
}

fn error(output: &Output) -> String {
    assert_eq!(output.status.code(), Some(2));
    assert!(output.stdout.is_empty());
    String::from_utf8(output.stderr.clone()).unwrap()
}

const GRID: [&str; 2] = ["0.5 m:3 m:41", "0.2 m:1 m:40"];
const SHOCK: [&str; 4] = ["--mass", "150 kg", "--stiffness", "4380 N/mm"];

/// Everything but the time that it took.
fn without_timing(bytes: &[u8]) -> Value {
    let mut document: Value = serde_json::from_slice(bytes).unwrap();
    document["timing"]
        .as_object_mut()
        .unwrap()
        .retain(|name, _| !name.ends_with("_s"));
    document
}

#[test]
fn the_same_bytes_on_any_number_of_threads() {
    let folder = folder();
    let run = |threads: &str| {
        let out = format!("out{threads}");
        let more = [
            "--sensitivity",
            "--json",
            "--quiet",
            "--threads",
            threads,
            "--out",
            &out,
            "--csv",
            "rows.csv",
        ];
        let output = spectrum(folder.path(), GRID, &[&SHOCK[..], &more].concat());
        let read = |path: PathBuf| std::fs::read(folder.path().join(path)).unwrap();
        let csv = read("rows.csv".into());
        assert!(csv == read(Path::new(&out).join("rows.csv")));
        // One document, on standard output and in the folder, where nothing differs between equal runs.
        let kept: Value =
            serde_json::from_slice(&read(Path::new(&out).join("result.json"))).unwrap();
        assert!(without_timing(&output.stdout) == kept);
        (csv, without_timing(&output.stdout))
    };
    let (csv, document) = run("1");
    let (csv_2, document_2) = run("2");
    assert!(csv == csv_2 && document == document_2);
    let csv = String::from_utf8(csv).unwrap();
    assert_eq!(csv.lines().count(), 1 + 41 * 40);
    let header = "motion,height_m,thickness_m,outcome,peak_rotation_rad,impact_count,uplift_m,cg_rise_m,edge_acceleration_g,\
                  edge_acceleration_impact_velocity_g,ceiling_g,sensitivity_ratio,sensitive,reason";
    assert_eq!(csv.lines().next().unwrap(), header);
    // The table and the document say the same.
    let rows = document["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 41 * 40);
    for (line, row) in csv.lines().skip(1).zip(rows) {
        let keys: Vec<&String> = row.as_object().unwrap().keys().collect();
        assert_eq!(keys, header.split(',').collect::<Vec<_>>());
        for (field, value) in line.split(',').zip(row.as_object().unwrap().values()) {
            let same = match value {
                Value::Null => field.is_empty(),
                // serde_json reads numbers to a unit in the last place only.
                Value::Number(number) => {
                    let (read, number) = (field.parse::<f64>().unwrap(), number.as_f64().unwrap());
                    (read - number).abs() <= f64::EPSILON * number.abs()
                }
                Value::String(text) => field == text,
                Value::Bool(flag) => field.parse() == Ok(*flag),
                _ => false,
            };
            assert!(same, "{line}: {field} {value}");
        }
    }
    for outcome in ["no-uplift", "rocked", "overturned"] {
        assert!(
            rows.iter().any(|row| row["outcome"] == outcome),
            "{outcome}"
        );
    }
}

#[test]
fn sensitivity_is_told_where_it_is_asked_for() {
    let folder = folder();
    let plain = document(&spectrum(folder.path(), GRID, &["--json"]));
    let asked = document(&spectrum(folder.path(), GRID, &["--json", "--sensitivity"]));
    assert!(
        plain["timing"].get("sensitivity_s").is_none()
            && asked["timing"]["sensitivity_s"].as_f64().unwrap() > 0.0
    );
    assert_eq!(plain["timing"]["block_steps"], 41 * 40 * 1200);
    let (plain, rows) = (
        plain["rows"].as_array().unwrap(),
        asked["rows"].as_array().unwrap(),
    );
    let mut sensitive = 0;
    let mut moderate = 0;
    let mut by_impacts = 0;
    for (plain, row) in plain.iter().zip(rows) {
        assert!(plain.get("sensitivity_ratio").is_none() && plain.get("sensitive").is_none());
        assert_eq!(plain["peak_rotation_rad"], row["peak_rotation_rad"]);
        let flagged = row["sensitive"].as_bool().unwrap();
        sensitive += usize::from(flagged);
        match row["sensitivity_ratio"].as_f64() {
            Some(ratio) => {
                // Impacts can be sensitive where the rotation is not.
                assert!(
                    row["outcome"] == "rocked" && (flagged || ratio <= 10.0),
                    "{row}"
                );
                by_impacts += usize::from(flagged && ratio <= 10.0);
                moderate += usize::from((1.0..20.0).contains(&ratio));
            }
            None => assert!(flagged || row["outcome"] != "rocked", "{row}"),
        }
    }
    let rocked = rows.iter().filter(|row| row["outcome"] == "rocked").count();
    assert!(
        sensitive > 0 && moderate > rocked / 4,
        "{sensitive} and {moderate} of {rocked}"
    );
    assert!(by_impacts > 0, "of {rocked}");
    let said = format!("{sensitive} of 1640 histories are sensitive");
    let warnings = asked["warnings"].as_array().unwrap();
    assert!(
        warnings
            .iter()
            .any(|warning| warning.as_str().unwrap().starts_with(&said)),
        "{warnings:?}"
    );
}

/// The velocity shock is proportional to the fastest impact: of an object that is not sensitive it
/// changes by no more than ten times what the motion does.
#[test]
fn shocks_of_objects_that_are_not_sensitive_are_steady() {
    let folder = folder();
    let cushion = [
        "--mass",
        "150 kg",
        "--stiffness",
        "4380 N/mm",
        "--sensitivity",
        "--json",
    ];
    let asked = document(&spectrum(folder.path(), GRID, &cushion));
    let grid = ["--heights", GRID[0], "--thicknesses", GRID[1]];
    let stronger = [
        "spectrum",
        "--motion",
        "r.csv",
        "--component",
        "1",
        "--scale",
        "3.000003",
    ];
    let changed = document(&execute(
        folder.path(),
        &[&stronger[..], &grid, &cushion].concat(),
    ));
    let (mut steady, mut unsteady) = (0, 0);
    for (row, changed) in asked["rows"]
        .as_array()
        .unwrap()
        .iter()
        .zip(changed["rows"].as_array().unwrap())
    {
        let shock = |row: &Value| {
            row["edge_acceleration_impact_velocity_g"]
                .as_f64()
                .filter(|shock| *shock > 0.0)
        };
        let (Some(shock), Some(changed)) = (shock(row), shock(changed)) else {
            continue;
        };
        // 1e-9 for the rounding of the scaled motion.
        let within = (changed / shock - 1.0).abs() <= 1e-5 + 1e-9;
        assert!(within || row["sensitive"] == true, "{row}: {changed}");
        *(if within { &mut steady } else { &mut unsteady }) += 1;
    }
    // Enough of both (93 and 252) for the test to mean something.
    assert!(steady > 50 && unsteady > 50, "{steady} and {unsteady}");
}

/// As `rock` follows one object, within what `standard` accuracy promises and a record amplifies.
#[test]
fn a_vertical_motion_is_that_of_rock() {
    let folder = folder();
    let vertical = [
        "--vertical",
        "r.csv",
        "--vertical-component",
        "2",
        "--vertical-scale",
        "4",
        "--json",
    ];
    let grid = ["1.2 m, 2 m", "0.5 m, 0.8 m"];
    let rows = document(&spectrum(folder.path(), grid, &vertical));
    let level = document(&spectrum(folder.path(), grid, &["--json"]));
    let mut rocked = 0;
    for (row, level) in rows["rows"]
        .as_array()
        .unwrap()
        .iter()
        .zip(level["rows"].as_array().unwrap())
    {
        let size = |key: &str| format!("{} m", row[key]);
        let (height, thickness) = (size("height_m"), size("thickness_m"));
        let object = [
            "rock",
            "--motion",
            "r.csv",
            "--component",
            "1",
            "--scale",
            "3",
            "--height",
            &height,
        ];
        let alone = document(&execute(
            folder.path(),
            &[&object[..], &["--thickness", &thickness], &vertical].concat(),
        ));
        assert_eq!(row["outcome"], alone["outcome"]);
        let peaks = [row, &alone, level].map(|row| row["peak_rotation_rad"].as_f64().unwrap());
        assert!((peaks[0] - peaks[1]).abs() <= 1e-7 * peaks[1], "{peaks:?}");
        if row["outcome"] == "rocked" {
            rocked += 1;
            assert!(
                (peaks[0] - peaks[2]).abs() > 1e-3 * peaks[2],
                "the vertical motion does nothing: {peaks:?}"
            );
        }
    }
    assert!(rocked > 0, "{rows}");

    let wrong = error(&spectrum(
        folder.path(),
        grid,
        &[
            "--vertical",
            "r.csv",
            "short.csv",
            "--vertical-component",
            "2",
        ],
    ));
    assert!(
        wrong.contains("--vertical has 2 files, --motion 1"),
        "{wrong}"
    );
    let wrong = error(&spectrum(
        folder.path(),
        grid,
        &["--vertical", "short.csv", "--vertical-component", "2"],
    ));
    assert!(
        wrong.contains("the vertical motion has 499 samples"),
        "{wrong}"
    );
    // Free flight ends each history: told in its row, and by the status.
    let flying = spectrum(
        folder.path(),
        grid,
        &[
            "--vertical",
            "r.csv",
            "--vertical-component",
            "2",
            "--vertical-scale",
            "40",
            "--json",
            "--sensitivity",
        ],
    );
    assert_eq!(flying.status.code(), Some(1));
    let rows: Value = serde_json::from_slice(&flying.stdout).unwrap();
    for row in rows["rows"].as_array().unwrap() {
        assert_eq!(
            (&row["outcome"], &row["sensitive"]),
            (&Value::from("free-flight"), &Value::Null),
            "{row}"
        );
        assert!(row["reason"].as_str().unwrap().contains("free flight"));
    }
}

/// A large grid is shown in part, and it is said where the rest is.
#[test]
fn a_large_table_is_not_printed() {
    let folder = folder();
    let text = |more: &[&str]| {
        let output = spectrum(folder.path(), GRID, more);
        assert!(output.status.success());
        String::from_utf8(output.stdout).unwrap()
    };
    let shown = text(&[]);
    assert!(
        shown.contains("… and 1630 more rows: --csv FILE or --json writes all rows\n"),
        "{shown}"
    );
    assert!(
        shown.lines().count() < 20 && shown.contains("overturned"),
        "{shown}"
    );
    let csv = std::fs::read_to_string(folder.path().join("rows.csv"));
    assert!(csv.is_err() && text(&["--csv", "rows.csv"]).contains("all rows are in rows.csv\n"));
    assert!(text(&["--out", "out"]).contains("all rows are in out/rows.csv\n"));
    let small =
        String::from_utf8(spectrum(folder.path(), ["1 m:2 m:10", "0.2 m:0.5 m:20"], &[]).stdout)
            .unwrap();
    assert!(
        small.lines().count() > 200 && !small.contains("more rows"),
        "{small}"
    );
}

/// `freestand … | head`: nobody reads on, and the files are complete all the same.
#[cfg(unix)]
#[test]
fn files_are_complete_though_nobody_reads_the_document() {
    let folder = folder();
    let command = |more: &str| {
        let grid = "--heights '0.5 m:3 m:200' --thicknesses '0.2 m:1 m:100'";
        let script = format!(
            "'{PROGRAM}' spectrum --motion r.csv --component 1 {grid} --json --quiet {more} | head -c 1"
        );
        Command::new("sh")
            .args(["-c", &script])
            .current_dir(folder.path())
            .output()
            .unwrap()
    };
    for more in ["", "--csv rows.csv"] {
        let output = command(more);
        assert_eq!(
            (output.stdout.as_slice(), output.stderr.as_slice()),
            (&b"{"[..], &b""[..])
        );
    }
    let csv = std::fs::read_to_string(folder.path().join("rows.csv")).unwrap();
    assert_eq!(csv.lines().count(), 1 + 200 * 100);
}

/// Ctrl-C between two chunks: status 130, and what stood there before stands.
#[cfg(unix)]
#[test]
#[ignore = "seconds: it waits until a spectrum has begun"]
fn a_spectrum_that_is_stopped_leaves_no_file() {
    let folder = folder();
    std::fs::write(folder.path().join("rows.csv"), "before").unwrap();
    let names = || {
        let entries = std::fs::read_dir(folder.path()).unwrap();
        let mut names: Vec<_> = entries
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    };
    let before = names();
    // Twenty times the same record: many chunks, and more work than the test has patience for.
    let records = vec!["r.csv"; 20];
    let run = command(folder.path())
        .args([&["spectrum", "--motion"], &records[..]].concat())
        .args([
            "--component",
            "1",
            "--scale",
            "3",
            "--heights",
            "0.5 m:3 m:1000",
            "--thicknesses",
            "0.2 m:1 m:1000",
        ])
        .args(["--csv", "rows.csv", "--out", "out"])
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let start = std::time::Instant::now();
    while names().len() < before.len() + 2 {
        assert!(start.elapsed().as_secs() < 60, "the work does not begin");
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    assert!(
        Command::new("kill")
            .args(["-INT", &run.id().to_string()])
            .status()
            .unwrap()
            .success()
    );
    let output = run.wait_with_output().unwrap();
    let message = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(130), "{message}");
    assert!(
        message.contains("error: stopped\nhint: nothing was written"),
        "{message}"
    );
    assert_eq!(names(), before);
    assert_eq!(
        std::fs::read_to_string(folder.path().join("rows.csv")).unwrap(),
        "before"
    );
}

/// The Parquet table has the fields of the CSV with their types, the same bytes on any number of
/// threads, and says what it was made from.
#[test]
fn a_parquet_table_has_the_values_of_the_csv() {
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::Field;
    let folder = folder();
    let file = |name: &str| folder.path().join(name);
    let write = |threads: &str, name: &str| {
        let more = [
            "--sensitivity",
            "--parquet",
            name,
            "--csv",
            "rows.csv",
            "--threads",
            threads,
        ];
        let output = spectrum(
            folder.path(),
            ["0.5 m:3 m:9", "0.2 m:1 m:8"],
            &[&SHOCK[..], &more].concat(),
        );
        assert!(
            output.status.success(),
            "{}",
            String::from_utf8_lossy(&output.stderr)
        );
        std::fs::read(file(name)).unwrap()
    };
    assert!(write("1", "one.parquet") == write("2", "two.parquet"));
    let reader =
        SerializedFileReader::new(std::fs::File::open(file("one.parquet")).unwrap()).unwrap();
    let csv = std::fs::read_to_string(file("rows.csv")).unwrap();
    let mut lines = csv.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let header = lines.next().unwrap();
    let (mut rows, mut types) = (0, std::collections::BTreeSet::new());
    for row in reader.get_row_iter(None).unwrap() {
        let (row, fields) = (row.unwrap(), lines.next().unwrap());
        let columns: Vec<_> = row.get_column_iter().collect();
        assert_eq!(
            columns
                .iter()
                .map(|(name, _)| name.as_str())
                .collect::<Vec<_>>(),
            header
        );
        for ((name, found), field) in columns.into_iter().zip(fields) {
            let is_same = match found {
                Field::Null => field.is_empty(),
                Field::Double(value) => field.parse::<f64>().unwrap() == *value,
                Field::Long(value) => field.parse::<i64>().unwrap() == *value,
                Field::Bool(value) => field == value.to_string(),
                Field::Str(value) => field == value,
                _ => false,
            };
            assert!(is_same, "{name}: {found} {field}");
            types.insert(format!("{:?}", std::mem::discriminant(found)));
        }
        rows += 1;
    }
    // Null, double, long, Boolean and text.
    assert_eq!((rows, types.len(), lines.next()), (72, 5, None));
    let values = reader
        .metadata()
        .file_metadata()
        .key_value_metadata()
        .unwrap();
    let value = |key: &str| -> Value {
        let text = values
            .iter()
            .find(|one| one.key == key)
            .and_then(|one| one.value.clone())
            .unwrap();
        serde_json::from_str(&text).unwrap()
    };
    assert_eq!(value("freestand.columns")["uplift_m"]["unit"], "m");
    assert_eq!(value("freestand.inputs")[0]["name"], "r.csv");
    assert_eq!(
        value("freestand.inputs")[0]["sha256"]
            .as_str()
            .unwrap()
            .len(),
        64
    );
}

/// Without records a place is needed, and what belongs to one is refused beside the other.
#[test]
fn motions_come_from_records_or_from_a_place() {
    let folder = folder();
    let at = |more: &[&str]| {
        let object = ["spectrum", "--heights", "1 m", "--thicknesses", "0.3 m"];
        error(&execute(folder.path(), &[&object[..], more].concat()))
    };
    assert!(at(&[]).contains("no motion is named"));
    assert!(at(&["--level-ratio", "1"]).contains("no motion is named"));
    assert!(
        at(&["--place", "Athens", "--motion", "r.csv"])
            .contains("--place applies to motions of a place, but --motion names records")
    );
    assert!(
        at(&["--place", "Athens", "--level-ratio", "1.2"])
            .contains("--level-ratio must be from 0 to 1, not 1.2")
    );
    assert!(
        at(&["--place", "Athens", "--vertical", "r.csv"])
            .contains("--vertical has 1 file, --motion 0")
    );
    assert!(at(&["--place", "Atlantis"]).contains("Atlantis"));
}
