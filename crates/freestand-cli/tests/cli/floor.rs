//! `freestand floor` as a whole: tables of buildings, two axes, several motions.

use std::path::Path;

use serde_json::Value;

use crate::program::execute;

const TOWER: &str =
    "storey,height [m],mass [t],stiffness [kN/mm]\n1,4,100,300\n2,3,100,200\n3,3,60,200\n";
const MODES: &str = "period [s],participation,5 m,10 m\n0.8,1.3,0.5,1\n0.3,-0.3,-1.2,1\n";

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: String| std::fs::write(folder.path().join(name), text).unwrap();
    write("tower.csv", TOWER.to_owned());
    write("modes.csv", MODES.to_owned());
    let wave = |scale: f64| {
        let rows = (0..500u32).map(|k| {
            let t = 0.02 * f64::from(k);
            format!(
                "{t},{},{}\n",
                scale * (7.0 * t).sin(),
                scale * (3.0 * t).sin()
            )
        });
        "time [s],N-S [m/s2],E-W [m/s2]\n".to_owned() + &rows.collect::<String>()
    };
    for (name, scale) in [("one.csv", 1.0), ("two.csv", 2.0), ("three.csv", 3.0)] {
        write(name, wave(scale));
    }
    folder
}

fn floor(folder: &Path, args: &[&str]) -> (Option<i32>, Value, String) {
    let all = [&["floor"], args, &["--json"]].concat();
    let output = execute(folder, &all);
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    (
        output.status.code(),
        serde_json::from_slice(&output.stdout).unwrap_or_default(),
        error,
    )
}

#[test]
fn a_table_of_storeys_gives_every_floor_and_its_drift() {
    let folder = folder();
    let args = [
        "--motion",
        "one.csv",
        "--component",
        "1",
        "--storey-table",
        "tower.csv",
        "--levels",
        "all",
        "--tail",
        "20 s",
    ];
    let args = [
        &args[..],
        &[
            "--spectra",
            "--spectrum-damping",
            "2 %, 5 %",
            "--out",
            "out",
        ],
    ]
    .concat();
    let (status, report, error) = floor(folder.path(), &args);
    assert_eq!(status, Some(0), "{error}");
    let heights: Vec<f64> = report["levels"]
        .as_array()
        .unwrap()
        .iter()
        .map(|level| level["height_m"].as_f64().unwrap())
        .collect();
    assert_eq!(heights, [0.0, 4.0, 7.0, 10.0]);
    assert!(
        report["levels"][0]["drift_ratio"].is_null()
            && report["levels"][3]["drift_ratio"].as_f64().unwrap() > 0.0
    );
    assert_eq!(report["modes"].as_array().unwrap().len(), 3);
    assert!(report["shear_flexure_ratio"].is_null());
    assert_eq!(
        report["spectra"]["levels"][3]["psa_g"]
            .as_array()
            .unwrap()
            .len(),
        2
    );
    for name in [
        "profile.csv",
        "profile.svg",
        "profile.png",
        "spectra.csv",
        "spectra.svg",
        "level-0.7.csv",
        "manifest.json",
    ] {
        assert!(folder.path().join("out").join(name).exists(), "{name}");
    }
}

#[test]
fn two_components_go_through_two_axes_and_several_motions_have_medians() {
    let folder = folder();
    let motions = [
        "--motion",
        "one.csv",
        "two.csv",
        "three.csv",
        "--components",
        "both",
        "--out",
        "out",
    ];
    let building = [
        "--storey-table",
        "tower.csv",
        "--across-mode-table",
        "modes.csv",
        "--damping",
        "3 %",
    ];
    let (status, report, error) = floor(folder.path(), &[&motions[..], &building].concat());
    assert_eq!(status, Some(0), "{error}");
    let of = |motion: usize, key: &str| {
        report["motions"][motion]["levels"][1][key]
            .as_f64()
            .unwrap()
    };
    let roof = &report["levels"][1];
    assert!(
        (roof["pfa_g"].as_f64().unwrap() / of(0, "pfa_g") - 2.0).abs() < 1e-9,
        "all is linear"
    );
    assert!(of(0, "pfa_g") >= of(0, "pfa_along_g").max(of(0, "pfa_across_g")));
    assert_eq!(report["across"]["modes"].as_array().unwrap().len(), 2);
    let pair = std::fs::read_to_string(folder.path().join("out/two/level-1.csv")).unwrap();
    assert!(pair.starts_with("time_s,along_m_s2,across_m_s2\n"));
}

#[test]
fn what_cannot_be_meant_is_refused() {
    let folder = folder();
    let refused = |args: &[&str], said: &str| {
        let (status, _, error) = floor(folder.path(), &[&["--motion", "one.csv"], args].concat());
        assert!(
            status == Some(2) && error.contains(said) && error.contains("hint:"),
            "{args:?}: {error}"
        );
    };
    let one = ["--component", "1"];
    refused(
        &[&one[..], &["--across-period", "1 s"]].concat(),
        "needs a second component",
    );
    refused(
        &[&one[..], &["--rayleigh-modes", "1"]].concat(),
        "--rayleigh-modes must be two mode numbers, not \"1\"",
    );
    refused(
        &[&one[..], &["--rayleigh-modes", "1, 99"]].concat(),
        "among the first 10, not 1 and 99",
    );
    refused(
        &[&one[..], &["--levels", "1.2"]].concat(),
        "is not a share of the height",
    );
    refused(
        &[&one[..], &["--storey-table", "modes.csv"]].concat(),
        "modes.csv:1: no column holds",
    );
    refused(
        &[&one[..], &["--components", "both"]].concat(),
        "--components and --component exclude each other",
    );
    refused(
        &["--components", "both", "--rotation-step", "5 deg"],
        "applies to objects, not to floors",
    );
    let tall = TOWER.replace("3,3,60", "3,5,60");
    std::fs::write(folder.path().join("tall.csv"), tall).unwrap();
    let tables = [
        "--storey-table",
        "tower.csv",
        "--across-storey-table",
        "tall.csv",
        "--components",
        "both",
    ];
    refused(
        &tables,
        "12 m high across, but 10 m high along its first axis",
    );
}

/// The vertical motion of the ground is that of every floor, amplified above the ground and scaled as
/// the horizontal one; a floor's vertical file is a motion that `rock --vertical` takes.
#[test]
fn vertical_motions_are_amplified_above_the_ground() {
    let folder = folder();
    let base = [
        "--motion",
        "one.csv",
        "--component",
        "1",
        "--levels",
        "0, 1",
        "--scale",
        "2",
    ];
    // A third column that says that it is vertical.
    let text = std::fs::read_to_string(folder.path().join("two.csv"))
        .unwrap()
        .replace("E-W", "Up");
    std::fs::write(folder.path().join("up.csv"), text).unwrap();
    let vertical = [
        "--vertical",
        "up.csv",
        "--vertical-amplification",
        "1.5",
        "--out",
        "out",
    ];
    let (status, report, error) = floor(folder.path(), &[&base[..], &vertical].concat());
    assert_eq!(status, Some(0), "{error}");
    let peaks = [0, 1].map(|level| {
        report["motions"][0]["levels"][level]["pfa_vertical_g"]
            .as_f64()
            .unwrap()
    });
    // 2 m/s2 times 2: the sine is sampled within 1e-3 of its crest.
    assert!(
        (peaks[0] * 9.80665 - 4.0).abs() < 4e-3 && (peaks[1] / peaks[0] - 1.5).abs() < 1e-14,
        "{peaks:?}"
    );
    assert_eq!(
        report["levels"][1]["pfa_vertical_g"].as_f64(),
        Some(peaks[1])
    );
    assert!(folder.path().join("out/level-1-vertical.csv").exists());
    let (_, without, _) = floor(folder.path(), &base);
    assert!(without["motions"][0]["levels"][0]["pfa_vertical_g"].is_null());
    assert_eq!(
        without["motions"][0]["levels"][1]["pfa_g"],
        report["motions"][0]["levels"][1]["pfa_g"]
    );

    let both = [&base[..4], &["--vertical", "record"]].concat();
    let (status, _, error) = floor(folder.path(), &both);
    assert!(
        status == Some(2) && error.contains("exactly one vertical component"),
        "{error}"
    );
    let (status, _, error) = floor(
        folder.path(),
        &[&base[..], &["--vertical", "up.csv", "two.csv"]].concat(),
    );
    assert!(
        status == Some(2) && error.contains("--vertical has 2 files, --motion 1"),
        "{error}"
    );
}
