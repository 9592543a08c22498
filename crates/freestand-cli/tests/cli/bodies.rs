//! `freestand rock` of shapes and scans, as it is called.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use serde_json::Value;
use tempfile::TempDir;

use crate::program;

/// A box of 0.2 m × 0.3 m × 1 m around the origin, in millimetres.
pub(crate) fn scan(folder: &TempDir) -> String {
    let mut text = String::new();
    for at in 0..8 {
        let side = |bit: i32, half: i32| if at >> bit & 1 == 1 { half } else { -half };
        let _ = writeln!(text, "v {} {} {}", side(0, 100), side(1, 150), side(2, 500));
    }
    let faces =
        "1 3 2, 2 3 4, 5 6 7, 6 8 7, 1 2 5, 2 6 5, 3 7 4, 4 7 8, 1 5 3, 3 5 7, 2 4 6, 4 8 6";
    for face in faces.split(", ") {
        let _ = writeln!(text, "f {face}");
    }
    written(folder, "box.obj", &text)
}

fn written(folder: &TempDir, name: &str, text: &str) -> String {
    let path = folder.path().join(name);
    fs::write(&path, text).unwrap();
    path.to_string_lossy().into_owned()
}

/// One second of a steady acceleration, and its opposite.
pub(crate) fn motion(folder: &TempDir, name: &str, peak_g: f64) -> String {
    let at = |i: i32| if i < 100 { peak_g } else { -peak_g };
    let text: String = (0..200).map(|i| format!("{}\n", at(i))).collect();
    written(folder, name, &text)
}

fn rock(more: &[&str]) -> Value {
    let args = [&["rock", "--unit", "g", "--dt", "10ms"], more].concat();
    program::document(Path::new("."), &args)
}

fn number(document: &Value, key: &str) -> f64 {
    document[key].as_f64().unwrap()
}

/// A scan of a box is the box, and a motion too weak to lift it does nothing to either.
#[test]
fn a_scan_of_a_box_is_the_box() {
    let folder = TempDir::new().unwrap();
    let (scan, weak) = (scan(&folder), motion(&folder, "weak.txt", 0.15));
    let given = ["--mass", "140 kg", "--motion", &weak];
    let of_scan = [
        "--scan",
        &scan,
        "--scan-unit",
        "mm",
        "--scan-base",
        "measured",
    ];
    let scanned = rock(&[&of_scan[..], &given].concat());
    let sizes = [
        "--shape",
        "box",
        "--thickness",
        "0.2 m",
        "--width",
        "0.3 m",
        "--height",
        "1 m",
    ];
    let shaped = rock(&[&sizes[..], &given].concat());
    assert_eq!(scanned["outcome"], "stood");
    assert_eq!(shaped["outcome"], "stood");
    for key in [
        "volume_m3",
        "cg_height_m",
        "tip_angle_rad",
        "barrier_angle_rad",
    ] {
        let [one, other] = [&scanned, &shaped].map(|of| number(&of["body"], key));
        assert!((one - other).abs() < 1e-9, "{key}: {one} {other}");
    }
    assert!((number(&scanned["body"], "volume_m3") - 0.06).abs() < 1e-12);
    assert_eq!(
        scanned["body"]["contact_points"].as_array().unwrap().len(),
        4
    );
    assert_eq!(scanned["body"]["stable_poses"].as_array().unwrap().len(), 6);
    assert_eq!(scanned["model_bias"], true);
}

/// Several motions give rows, each as it is alone; the one that is above e/h for a second overturns it.
#[test]
fn several_motions_give_rows() {
    let folder = TempDir::new().unwrap();
    let files = [("weak.txt", 0.15), ("strong.txt", 0.6)];
    let [weak, strong] = files.map(|(name, peak)| motion(&folder, name, peak));
    let body = [
        "--shape",
        "cylinder",
        "--diameter",
        "0.2 m",
        "--height",
        "1 m",
    ];
    let both = rock(&[&body[..], &["--motion", &weak, &strong]].concat());
    let rows = both["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 2);
    assert_eq!(rows[0]["outcome"], "stood");
    assert_eq!(rows[1]["outcome"], "overturned");
    assert!(both["body"]["tip_angle_rad"].is_number());
    let alone = rock(&[&body[..], &["--motion", &strong]].concat());
    for key in ["outcome", "peak_tilt_rad", "overturn_time_s"] {
        assert_eq!(alone[key], rows[1][key], "{key}");
    }
    // From every direction alike, but for its contact points.
    let turned = [&body[..], &["--motion", &strong, "--orientation", "40 deg"]].concat();
    assert_eq!(rock(&turned)["outcome"], "overturned");
}
