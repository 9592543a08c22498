//! Polygons, bodies on feet and scans in lists.

use std::collections::HashMap;
use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

/// A box of 0.3 m × 0.3 m × 1.2 m, in millimetres.
const BOX: &str = "v 0 0 0\nv 300 0 0\nv 300 300 0\nv 0 300 0\nv 0 0 1200\nv 300 0 1200\nv 300 300 1200\n\
    v 0 300 1200\nf 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

fn document(folder: &Path, args: &[&str]) -> Value {
    let output = Command::new(env!("CARGO_BIN_EXE_freestand"))
        .current_dir(folder)
        .args(args)
        .arg("--json")
        .output()
        .unwrap();
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{args:?}: {told}");
    serde_json::from_slice(&output.stdout).unwrap()
}

/// The only row of a table, by the names of its columns.
fn row(path: &Path) -> HashMap<String, String> {
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_path(path)
        .unwrap();
    reader.deserialize().next().unwrap().unwrap()
}

/// Random numbers belong to identifiers, and that of a single object is `object`. A shard keeps
/// the bodies of its rows.
#[test]
#[ignore = "seconds: bodies in many worlds"]
fn a_list_and_object_give_bodies_the_same_answer() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    fs::write(folder.join("box.obj"), BOX).unwrap();
    let feet = "-140 mm, -140 mm; 140 mm, -140 mm; 0 mm, 140 mm";
    let bodies: [(&str, &str, &[&str]); 3] = [
        (
            "height [mm],diameter [mm],shape\nobject,0,1200,300,polygon:6\n",
            "polygon",
            &[
                "--shape",
                "polygon:6",
                "--diameter",
                "300 mm",
                "--height",
                "1200 mm",
            ],
        ),
        (
            &format!(
                "height [mm],thickness [mm],width [mm],feet\nobject,0,1200,300,300,\"{feet}\"\n"
            ),
            "feet",
            &[
                "--feet",
                feet,
                "--thickness",
                "300 mm",
                "--width",
                "300 mm",
                "--height",
                "1200 mm",
            ],
        ),
        (
            "scan,scan unit,scan base\nobject,0,box.obj,mm,measured\n",
            "scan",
            &[
                "--scan",
                "box.obj",
                "--scan-unit",
                "mm",
                "--scan-base",
                "measured",
            ],
        ),
    ];
    for (list, name, asked) in bodies {
        let file = format!("{name}.csv");
        fs::write(folder.join(&file), format!("id,level_ratio,{list}")).unwrap();
        let place = ["--place", "Wellington"];
        let one = document(folder, &[&["object"], &place[..], asked].concat());
        let out = ["--inventory", &file, "--out", name];
        document(folder, &[&["assess"], &place[..], &out].concat());
        let listed = row(&folder.join(name).join("objects.csv"));
        assert_eq!(listed["model"], "hull-3d");
        assert_eq!(one["model"], "hull-3d");
        let p = |text: &str| text.parse::<f64>().unwrap();
        assert_eq!(
            Some(p(&listed["p_overturn"])),
            one["p_overturn"].as_f64(),
            "{name}"
        );
        assert!(
            p(&listed["p_overturn"]) > 0.0,
            "{name}: it falls in some world"
        );
    }
    let plan = ["--inventory", "scan.csv", "--place", "Wellington"];
    document(
        folder,
        &[
            &["shard", "plan", "--shards", "1", "--out", "plan"],
            &plan[..],
        ]
        .concat(),
    );
    fs::remove_file(folder.join("box.obj")).unwrap();
    document(folder, &["shard", "run", "plan", "--shard", "0"]);
    document(folder, &["shard", "merge", "plan", "--out", "merged"]);
    let of = |folder_name: &str| fs::read(folder.join(folder_name).join("objects.csv")).unwrap();
    assert_eq!(of("merged"), of("scan"), "a shard needs no scan");
}
