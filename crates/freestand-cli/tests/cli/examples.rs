//! The worked examples: their commands run, and their READMEs say what comes out.

use crate::program::{execute, json, root};

/// How many objects get each decision, in as many worlds as each needs or in these. What the answers
/// depend on takes most of the time and decides nothing: it is left out.
fn decisions(example: &str, worlds: &str) -> Vec<(String, u64)> {
    let folder = tempfile::tempdir().unwrap();
    let from = root().join("examples").join(example);
    let study = std::fs::read_to_string(from.join("study.toml")).unwrap();
    let study = study + "\n[worlds]\nshares = false\n" + worlds;
    for entry in std::fs::read_dir(from).unwrap() {
        let entry = entry.unwrap();
        std::fs::copy(entry.path(), folder.path().join(entry.file_name())).unwrap();
    }
    std::fs::write(folder.path().join("study.toml"), study).unwrap();
    let done = execute(
        folder.path(),
        &["assess", "study.toml", "--quiet", "--json", "--out", "out"],
    );
    assert!(
        done.status.success(),
        "{}",
        String::from_utf8_lossy(&done.stderr)
    );
    let report = json(&done);
    let count = |name: &str| (name.to_owned(), report["decisions"][name].as_u64().unwrap());
    ["restrain", "soften", "lock", "no-verdict", "leave"]
        .map(count)
        .to_vec()
}

/// The same as the README's table has it.
fn as_told(example: &str) -> Vec<(String, u64)> {
    let readme =
        std::fs::read_to_string(root().join(format!("examples/{example}/README.md"))).unwrap();
    let row = |line: &str| {
        let mut cells = line.strip_prefix("| ")?.split(" | ");
        Some((cells.next()?.to_owned(), cells.next()?.parse().ok()?))
    };
    readme.lines().filter_map(row).collect()
}

fn comes_out_as_its_readme_says(example: &str) {
    assert_eq!(decisions(example, ""), as_told(example));
}

// A test for each, so that one fills the processor while another reads or writes.

#[test]
#[ignore = "minutes: up to 1280 worlds"]
fn the_hospital_comes_out_as_its_readme_says() {
    comes_out_as_its_readme_says("hospital");
}

#[test]
#[ignore = "minutes: up to 1280 worlds"]
fn the_server_room_comes_out_as_its_readme_says() {
    comes_out_as_its_readme_says("server-room");
}

#[test]
#[ignore = "minutes: up to 1280 worlds"]
fn the_museum_comes_out_as_its_readme_says() {
    comes_out_as_its_readme_says("museum");
}

/// In a few worlds many decisions are others, but they are made for the same objects.
#[test]
#[ignore = "a quarter of a minute: whole examples"]
fn every_example_is_decided() {
    for example in ["hospital", "server-room", "museum"] {
        let all = |decisions: Vec<(String, u64)>| decisions.iter().map(|one| one.1).sum::<u64>();
        let few = decisions(example, "first = 2\nmost = 2\n");
        assert_eq!(all(few), all(as_told(example)), "{example}");
    }
}
