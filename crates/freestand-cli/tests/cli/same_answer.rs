//! The same question has the same answer, whichever command is asked: thirty objects under three
//! motions that are given, with nothing drawn.

use std::collections::HashMap;
use std::fs;
use std::path::Path;

use rayon::prelude::*;
use serde_json::Value;

use crate::program::{document, refused};

const MOTIONS: [&str; 3] = ["sine.csv", "weak.csv", "decaying.csv"];

/// Three pulses that end with their last sample: what falls does so long after it.
fn motions(folder: &Path) {
    let write = |name: &str, end: usize, accel_g: &dyn Fn(f64) -> f64| {
        let rows = (0..=end).map(|i| format!("{:.2},{:.6}\n", 0.01 * i as f64, accel_g(0.01 * i as f64)));
        fs::write(folder.join(name), format!("time [s],a [g]\n{}", rows.collect::<String>())).unwrap();
    };
    let wave = |period_s: f64, t: f64| (std::f64::consts::TAU * t / period_s).sin();
    write(MOTIONS[0], 100, &|t| 0.5 * wave(1.0, t));
    write(MOTIONS[1], 60, &|t| 0.3 * wave(0.6, t));
    write(MOTIONS[2], 250, &|t| 0.6 * (-0.6 * t).exp() * wave(1.25, t));
}

/// An object by the columns of a list: a length in mm, or what the key takes.
struct Thing {
    id: String,
    cells: Vec<(&'static str, String)>,
}

impl Thing {
    fn new(kind: &str, number: usize, sizes_mm: &[u32], more: &[(&'static str, &str)]) -> Self {
        let sizes = ["height", "thickness", "width"].into_iter().zip(sizes_mm.iter().map(u32::to_string));
        let more = more.iter().map(|(key, text)| (*key, (*text).to_owned()));
        Self { id: format!("{kind}-{number}"), cells: sizes.chain(more).collect() }
    }

    fn cell(&self, key: &str) -> Option<&str> {
        self.cells.iter().find(|(own, _)| *own == key).map(|(_, text)| text.as_str())
    }

    /// As flags, with the units that lengths need.
    fn flags(&self, keys: &[(&str, &str)]) -> Vec<String> {
        let flag = |(key, flag): &(&str, &str)| {
            let text = self.cell(key)?;
            let is_length = text.parse::<f64>().is_ok() && !["friction", "wall_restitution"].contains(key);
            Some([format!("--{flag}"), if is_length { format!("{text}mm") } else { text.to_owned() }])
        };
        keys.iter().filter_map(flag).flatten().collect()
    }
}

fn things() -> Vec<Thing> {
    let mut things = Vec::new();
    for (number, (height, thickness)) in
        [900, 1500, 2100].into_iter().flat_map(|height| [250, 400, 600, 900].map(|side| (height, side))).enumerate()
    {
        things.push(Thing::new("free", number, &[height, thickness], &[]));
    }
    for (number, sizes) in [[2000, 1070, 600], [2000, 600, 1070], [1500, 300, 900], [1200, 800, 350]].iter().enumerate()
    {
        things.push(Thing::new("wide", number, sizes, &[]));
    }
    let gaps = ["0", "20", "80", "300"];
    for (number, gap) in gaps.iter().enumerate() {
        let wall = [("wall_gap", *gap), ("wall_restitution", "0.3")];
        things.push(Thing::new("wall", number, &[1600, 350], &wall));
    }
    for (number, gap) in ["10", "60", "200"].iter().enumerate() {
        let beside = [("neighbour_gap", *gap), ("wall_restitution", "0.3")];
        things.push(Thing::new("between", number, &[1800, 700, 450], &beside));
    }
    for (number, clearance) in [None, Some("20"), Some("200"), Some("900")].into_iter().enumerate() {
        let mut rolls = vec![("casters", "free")];
        rolls.extend(clearance.map(|clearance| ("clearance", clearance)));
        things.push(Thing::new("rolls", number, &[1400, 600], &rolls));
    }
    for (number, clearance) in [None, Some("5"), Some("60")].into_iter().enumerate() {
        let mut slides = vec![("friction", "0.2")];
        slides.extend(clearance.map(|clearance| ("clearance", clearance)));
        things.push(Thing::new("slides", number, &[900, 700], &slides));
    }
    things
}

const KEYS: [&str; 9] = [
    "height",
    "thickness",
    "width",
    "wall_gap",
    "neighbour_gap",
    "wall_restitution",
    "casters",
    "clearance",
    "friction",
];

/// The list and a study whose floor moves as given.
fn write_list(folder: &Path, things: &[Thing]) {
    let is_length = |key: &str| !["wall_restitution", "casters", "friction"].contains(&key);
    let heading = |key: &&str| if is_length(key) { format!("{key} [mm]") } else { (*key).to_owned() };
    let mut list = format!("id,level_ratio,{}\n", KEYS.iter().map(heading).collect::<Vec<_>>().join(","));
    for thing in things {
        let cells: Vec<&str> = KEYS.iter().map(|key| thing.cell(key).unwrap_or_default()).collect();
        list += &format!("{},0,{}\n", thing.id, cells.join(","));
    }
    fs::write(folder.join("list.csv"), list).unwrap();
    let spreads: String = ["restitution", "stiffness", "mass", "geometry", "model", "compliant"]
        .map(|one| format!("{one}_spread = 0\n"))
        .concat();
    let study = format!(
        "[building]\nlevels = [{{ name = \"floor\", level_ratio = 0.0, motions = {MOTIONS:?} }}]\n[worlds]\nfirst = 3\n\
         most = 3\nshares = false\n[assessment]\n{spreads}"
    );
    fs::write(folder.join("study.toml"), study).unwrap();
}

/// The rows of a table, each by the names of its columns.
fn table(path: &Path) -> Vec<HashMap<String, String>> {
    let text = fs::read_to_string(path).unwrap();
    let mut lines = text.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
    let head = lines.next().unwrap();
    lines.map(|line| head.iter().cloned().zip(line).collect()).collect()
}

/// Whether each object falls under each motion, by its id.
type Falls = HashMap<String, Vec<bool>>;

fn gathered(rows: impl Iterator<Item = (String, bool)>) -> Falls {
    let mut falls = Falls::new();
    rows.for_each(|(id, falls_over)| falls.entry(id).or_default().push(falls_over));
    falls
}

fn has_fallen(outcome: &Value) -> bool {
    matches!(outcome.as_str(), Some("overturned" | "leaned"))
}

/// The outcomes of `rock` in each plane of an object; the worse one counts.
fn rocked(folder: &Path, thing: &Thing) -> Vec<bool> {
    let mut falls = vec![false; MOTIONS.len()];
    for side in ["thickness", "width"].iter().filter(|side| thing.cell(side).is_some()) {
        let mut flags =
            thing.flags(&[("height", "height"), (side, "thickness"), ("wall_restitution", "wall-restitution")]);
        let walls: &[&str] = match *side {
            "width" => &["wall-gap-left", "wall-gap-right"],
            _ => &[],
        };
        match thing.cell("neighbour_gap") {
            Some(gap) if !walls.is_empty() => {
                flags.extend(walls.iter().flat_map(|wall| [format!("--{wall}"), format!("{gap}mm")]))
            }
            Some(_) => flags.retain(|flag| !flag.contains("restitution") && flag != "0.3"),
            None => {}
        }
        let flags: Vec<&str> = flags.iter().map(String::as_str).collect();
        let found = document(folder, &[&["rock", "--motion"], &MOTIONS[..], &flags].concat());
        for (falls, one) in falls.iter_mut().zip(found["results"].as_array().unwrap()) {
            *falls |= has_fallen(&one["outcome"]);
        }
    }
    falls
}

#[test]
fn every_command_has_the_same_outcome() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let things = things();
    assert_eq!(things.len(), 30);
    motions(folder);
    write_list(folder, &things);

    document(folder, &["assess", "study.toml", "--inventory", "list.csv", "--outcomes", "--out", "assessed"]);
    let rows = table(&folder.join("assessed/outcomes.csv"));
    let assessed = gathered(rows.iter().map(|row| (row["id"].clone(), row["fell"] == "1")));
    let count = |falls: &Falls| falls.values().flatten().filter(|falls| **falls).count();
    // Of 90 histories many end either way.
    assert!((15..75).contains(&count(&assessed)), "{}", count(&assessed));

    // Each motion once, as it is: the same outcome of every object, those that roll or slide included.
    let cloud = ["fragility", "study.toml", "--inventory", "list.csv", "--method", "cloud", "--bootstrap", "0"];
    let found = document(folder, &[&cloud[..], &["--out", "fragile"]].concat());
    assert_eq!(found["left_out"], serde_json::json!([]));
    let rows = table(&folder.join("fragile/outcomes.csv"));
    let fragile = gathered(rows.iter().map(|row| (row["object"].clone(), row["outcome"] == "overturned")));
    for thing in &things {
        assert_eq!(fragile[&thing.id], assessed[&thing.id], "fragility and assess: {}", thing.id);
    }

    // One object at a time. The side of the one wall behind an object belongs to its id.
    let alone: Vec<&Thing> = things.iter().filter(|thing| thing.cell("wall_gap").is_none()).collect();
    alone.par_iter().for_each(|thing| {
        let keys = KEYS.map(|key| (key, key.replace('_', "-")));
        let keys: Vec<(&str, &str)> = keys.iter().map(|(key, flag)| (*key, flag.as_str())).collect();
        let flags = thing.flags(&keys);
        let flags: Vec<&str> = flags.iter().map(String::as_str).collect();
        let found = document(folder, &[&["object", "--motion"], &MOTIONS[..], &flags].concat());
        let fallen = assessed[&thing.id].iter().filter(|falls| **falls).count();
        assert_eq!(found["motions_overturned"], fallen, "object and assess: {}", thing.id);
        if thing.cell("casters").or(thing.cell("friction")).is_none() {
            assert_eq!(rocked(folder, thing), assessed[&thing.id], "rock and assess: {}", thing.id);
        }
    });

    // The grid of the free ones, motion by motion.
    let grid = ["spectrum", "--heights", "900mm, 1500mm, 2100mm", "--thicknesses", "250mm, 400mm, 600mm, 900mm"];
    let found = document(folder, &[&grid[..], &["--motion"], &MOTIONS[..]].concat());
    for (place, row) in found["rows"].as_array().unwrap().iter().enumerate() {
        let (motion, thing) = (place / 12, place % 12);
        assert_eq!(
            has_fallen(&row["outcome"]),
            assessed[&format!("free-{thing}")][motion],
            "spectrum: {thing} {motion}"
        );
    }
}

/// A command that cannot take an object says so, with a remedy.
#[test]
fn a_command_that_cannot_answer_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    motions(folder);
    let size = ["--height", "1.4m", "--thickness", "0.6m"];
    let refused =
        |command: &str, more: &[&str]| refused(folder, &[&[command, "--motion", "sine.csv"], &size[..], more].concat());
    assert!(refused("rock", &["--casters", "--wall-gap", "10mm"]).contains("--wall-gap"));
    assert!(refused("rock", &["--width", "0.9m"]).contains("--width"));
    assert!(refused("rock", &["--upper-height", "0.5m"]).contains("--upper-height"));
}
