use super::*;

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn a_file_is_whole_or_not_there() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.csv");
    write_file(&path, b"one", &[]).unwrap();
    write_file(&path, b"two", &[]).unwrap();
    assert_eq!(
        (fs::read(&path).unwrap(), names(folder.path())),
        (b"two".to_vec(), vec!["a.csv".to_owned()])
    );
    let absent = folder.path().join("absent/a.csv");
    let problem = write_file(&absent, b"x", &[]).unwrap_err();
    assert_eq!(
        (problem.path.as_deref(), problem.kind),
        (Some(absent.as_path()), ProblemKind::Io)
    );
    assert!(problem.hint.unwrap().contains("folder exists"));
    assert!(
        write_file(folder.path(), b"x", &[])
            .unwrap_err()
            .message
            .contains("is a folder")
    );
    assert_eq!(names(folder.path()), ["a.csv"]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_said() {
    let full = Path::new("/dev/full");
    if full.exists() {
        let problem = write_file(full, b"x", &[]).unwrap_err();
        assert!(
            problem.hint.unwrap().contains("free space"),
            "{}",
            problem.message
        );
    }
}

#[test]
fn a_folder_appears_whole() {
    let parent = tempfile::tempdir().unwrap();
    let target = parent.path().join("deep/out");
    let folder = OutputFolder::stage(&target, false, &[]).unwrap();
    folder
        .write(
            "summary.json",
            br#"{"schema":"freestand.run/1","files":["motions/a.csv"]}"#,
        )
        .unwrap();
    folder.write("motions/a.csv", b"1").unwrap();
    assert!(!target.exists());
    assert_eq!(folder.commit().unwrap().folder, target);
    assert_eq!(names(&target), ["motions", "summary.json"]);
    assert_eq!(names(target.parent().unwrap()), ["out"]);

    // The files that its manifest lists are replaced.
    let folder = OutputFolder::stage(&target, false, &[]).unwrap();
    folder
        .write("manifest.json", br#"{"a":[1],"schema":"freestand.run/1"}"#)
        .unwrap();
    folder.commit().unwrap();
    assert_eq!(names(&target), ["manifest.json"]);

    // Dropped, it leaves the old one as it was.
    let folder = OutputFolder::stage(&target, false, &[]).unwrap();
    folder.write("x", b"1").unwrap();
    drop(folder);
    assert_eq!(
        (names(&target), names(target.parent().unwrap())),
        (vec!["manifest.json".to_owned()], vec!["out".to_owned()])
    );
}

#[test]
fn what_is_not_ours_is_not_touched() {
    let parent = tempfile::tempdir().unwrap();
    let target = parent.path().join("out");
    fs::create_dir(&target).unwrap();
    OutputFolder::stage(&target, false, &[])
        .unwrap()
        .commit()
        .unwrap();
    for (name, content) in [
        ("thesis.doc", &b"years of work"[..]),
        ("manifest.json", br#"{"schema":"other/1"}"#),
        ("manifest.json", br#"{"note":"schema freestand."}"#),
        ("summary.json", b"\"schema\":\"freestand.run/1\""),
        ("summary.json", b""),
    ] {
        fs::write(target.join(name), content).unwrap();
        let problem = OutputFolder::stage(&target, false, &[]).unwrap_err();
        assert!(problem.hint.unwrap().contains("`force = true`"), "{name}");
        assert_eq!(names(parent.path()), ["out"]);
        fs::remove_file(target.join(name)).unwrap();
    }
    // Something that came while we worked.
    let folder = OutputFolder::stage(&target, false, &[]).unwrap();
    fs::write(target.join("thesis.doc"), "years of work").unwrap();
    assert!(folder.commit().is_err());
    assert_eq!(
        (names(&target), names(parent.path())),
        (vec!["thesis.doc".to_owned()], vec!["out".to_owned()])
    );
    // With force we add our files and replace only those with our names.
    fs::create_dir(target.join("motions")).unwrap();
    fs::write(target.join("motions/mine.csv"), "mine").unwrap();
    fs::write(target.join("a"), "old").unwrap();
    let folder = OutputFolder::stage(&target, true, &[]).unwrap();
    folder.write("a", b"1").unwrap();
    folder.write("motions/b", b"2").unwrap();
    folder.commit().unwrap();
    assert_eq!(
        (names(&target), names(parent.path())),
        (
            vec!["a", "motions", "thesis.doc"]
                .into_iter()
                .map(str::to_owned)
                .collect(),
            vec!["out".to_owned()]
        )
    );
    assert_eq!(names(&target.join("motions")), ["b", "mine.csv"]);
    assert_eq!(fs::read(target.join("a")).unwrap(), b"1");
    // A file in the folder's place stays, whatever is asked.
    let file = parent.path().join("file");
    fs::write(&file, "x").unwrap();
    for force in [false, true] {
        assert!(
            OutputFolder::stage(&file, force, &[])
                .unwrap_err()
                .message
                .contains("is a file")
        );
        assert!(OutputFolder::stage(&file.join("out"), force, &[]).is_err());
    }
    assert_eq!(fs::read(&file).unwrap(), b"x");
}

fn run(target: &Path, force: bool, files: &[&str]) -> Result<Committed, Problem> {
    let folder = OutputFolder::stage(target, force, &[])?;
    for name in files {
        folder.write(name, b"new")?;
    }
    let list: Vec<&str> = files.iter().copied().chain(["summary.json"]).collect();
    let summary = serde_json::json!({"schema": "freestand.run/1", "files": list}).to_string();
    folder.write("summary.json", summary.as_bytes())?;
    folder.commit()
}

#[test]
fn only_what_a_manifest_lists_is_replaced() {
    let parent = tempfile::tempdir().unwrap();
    let target = parent.path().join("out");
    fs::create_dir_all(target.join("motions")).unwrap();
    fs::write(target.join("thesis.doc"), "years of work").unwrap();
    run(&target, true, &["srs.csv", "motions/a.csv", "old/deep/x"]).unwrap();
    fs::write(target.join("notes.md"), "mine").unwrap();
    fs::write(target.join("motions/mine.csv"), "mine").unwrap();
    run(&target, false, &["srs.csv", "motions/b.csv"]).unwrap();
    assert_eq!(
        names(&target),
        [
            "motions",
            "notes.md",
            "srs.csv",
            "summary.json",
            "thesis.doc"
        ]
    );
    assert_eq!(names(&target.join("motions")), ["b.csv", "mine.csv"]);
    // A file that nobody listed is in the way: said before the work, and nothing has changed.
    fs::write(target.join("urs.csv"), "mine").unwrap();
    let folder = OutputFolder::stage(&target, false, &[]).unwrap();
    assert!(
        folder
            .check(&["urs.csv".to_owned()])
            .unwrap_err()
            .hint
            .unwrap()
            .contains("`force = true`")
    );
    drop(folder);
    assert!(run(&target, false, &["urs.csv", "motions/c.csv"]).is_err());
    assert!(
        run(&target, true, &["thesis.doc/x"])
            .unwrap_err()
            .message
            .contains("not a folder")
    );
    assert!(
        run(&target, true, &["motions"])
            .unwrap_err()
            .message
            .contains("is a folder")
    );
    assert_eq!(
        names(&target),
        [
            "motions",
            "notes.md",
            "srs.csv",
            "summary.json",
            "thesis.doc",
            "urs.csv"
        ]
    );
    assert_eq!(names(&target.join("motions")), ["b.csv", "mine.csv"]);
    run(&target, true, &["urs.csv"]).unwrap();
    assert_eq!(fs::read(target.join("urs.csv")).unwrap(), b"new");
    assert_eq!(names(parent.path()), ["out"]);
}

#[test]
fn a_manifest_does_not_lead_out_of_its_folder() {
    let parent = tempfile::tempdir().unwrap();
    let (target, other) = (parent.path().join("out"), parent.path().join("other"));
    for folder in [&target, &other] {
        fs::create_dir(folder).unwrap();
    }
    fs::write(other.join("precious"), "x").unwrap();
    let absolute = other.join("precious");
    let mut files = vec![
        "../other/precious",
        "..",
        "",
        "sub",
        absolute.to_str().unwrap(),
    ];
    fs::create_dir(target.join("sub")).unwrap();
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(&other, target.join("link")).unwrap();
        files.push("link/precious");
    }
    let manifest = serde_json::json!({"schema": "freestand.run/1", "files": files}).to_string();
    fs::write(target.join("summary.json"), manifest).unwrap();
    run(&target, false, &["a"]).unwrap();
    assert_eq!(names(&other), ["precious"]);
    assert!(target.join("sub").is_dir());
    #[cfg(unix)]
    assert!(run(&target, true, &["link/a"]).is_err() && names(&other) == ["precious"]);
}

#[test]
fn an_input_is_no_place_for_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let record = folder.path().join("record.csv");
    fs::write(&record, "recorded").unwrap();
    let problem = write_file(&record, b"computed", std::slice::from_ref(&record)).unwrap_err();
    assert!(
        problem.message.contains("is read by this command"),
        "{problem}"
    );
    assert_eq!(fs::read(&record).unwrap(), b"recorded");
}

#[test]
fn inputs_are_not_replaced() {
    let parent = tempfile::tempdir().unwrap();
    let target = parent.path().join("y");
    run(&target, false, &["rec.csv"]).unwrap();
    fs::write(target.join("own.csv"), "mine").unwrap();
    let listed = OutputFolder::stage(&target, true, &[target.join("rec.csv")]).unwrap_err();
    assert!(listed.message.contains("read by this command"));
    let folder = OutputFolder::stage(&target, true, &[target.join("../y/own.csv")]).unwrap();
    assert!(folder.check(&["own.csv".to_owned()]).is_err());
    folder.write("own.csv", b"new").unwrap();
    assert!(folder.commit().is_err());
    assert_eq!(fs::read(target.join("own.csv")).unwrap(), b"mine");
    assert_eq!(names(&target), ["own.csv", "rec.csv", "summary.json"]);
}

/// It may be a mount point, which cannot be renamed, and its permissions are the user's.
#[cfg(unix)]
#[test]
fn an_empty_folder_stays_the_same_folder() {
    use std::os::unix::fs::{MetadataExt, PermissionsExt};
    let parent = tempfile::tempdir().unwrap();
    let target = parent.path().join("out");
    fs::create_dir(&target).unwrap();
    fs::set_permissions(&target, fs::Permissions::from_mode(0o750)).unwrap();
    let facts = || {
        fs::metadata(&target)
            .map(|data| (data.ino(), data.mode()))
            .unwrap()
    };
    let before = facts();
    let folder = OutputFolder::stage(&target, false, &[]).unwrap();
    assert_eq!(names(parent.path()), ["out"]);
    folder.write("a", b"1").unwrap();
    folder.commit().unwrap();
    assert_eq!((facts(), names(&target)), (before, vec!["a".to_owned()]));
}

#[cfg(target_os = "linux")]
#[test]
fn leftovers_of_the_dead_are_cleared() {
    let parent = tempfile::tempdir().unwrap();
    let target = parent.path().join("out");
    // No process has a number above 2^22, the kernel's limit.
    let dead = ".out.partial-4194999-0";
    let others = [
        ".out.partial-1-0",
        ".out.partial-4194999",
        ".out2.partial-4194999-0",
        "out.partial-4194999-0",
    ];
    for name in others.iter().chain([&dead]) {
        fs::create_dir(parent.path().join(name)).unwrap();
        fs::write(parent.path().join(name).join("a"), "x").unwrap();
    }
    fs::write(parent.path().join(".out.partial-4194999-7"), "a file").unwrap();
    drop(OutputFolder::stage(&target, false, &[]).unwrap());
    let left = names(parent.path());
    assert!(
        !left.contains(&dead.to_owned()) && left.len() == others.len() + 1,
        "{left:?}"
    );
    // Inside a target that exists they make no content of it, and a lock protects whoever has
    // another kernel's view.
    for name in [
        ".freestand-partial-4194999-0",
        ".freestand-partial-4194998-0",
    ] {
        fs::create_dir_all(target.join(name)).unwrap();
    }
    let alive = fs::File::open(target.join(".freestand-partial-4194998-0")).unwrap();
    alive.try_lock().unwrap();
    drop(OutputFolder::stage(&target, false, &[]).unwrap());
    assert_eq!(names(&target), [".freestand-partial-4194998-0"]);
}

#[test]
fn an_output_has_one_name() {
    let parent = tempfile::tempdir().unwrap();
    let folder = OutputFolder::stage(&parent.path().join("out"), false, &[]).unwrap();
    folder.write("motions/a", b"1").unwrap();
    assert!(
        folder
            .write("motions/a", b"2")
            .unwrap_err()
            .message
            .contains("two outputs")
    );
    assert_eq!(folder.names().unwrap(), ["motions/a"]);
}

#[cfg(unix)]
#[test]
fn links_stay_links() {
    let parent = tempfile::tempdir().unwrap();
    let (real, link) = (parent.path().join("real"), parent.path().join("link"));
    fs::create_dir(&real).unwrap();
    std::os::unix::fs::symlink(&real, &link).unwrap();
    let folder = OutputFolder::stage(&link, false, &[]).unwrap();
    folder.write("a", b"1").unwrap();
    folder.commit().unwrap();
    assert_eq!(
        (names(&real), fs::read_link(&link).unwrap()),
        (vec!["a".to_owned()], real.clone())
    );
    std::os::unix::fs::symlink(real.join("a"), parent.path().join("file")).unwrap();
    write_file(&parent.path().join("file"), b"2", &[]).unwrap();
    assert_eq!(fs::read(real.join("a")).unwrap(), b"2");
    std::os::unix::fs::symlink(
        parent.path().join("nothing"),
        parent.path().join("dangling"),
    )
    .unwrap();
    let problem = OutputFolder::stage(&parent.path().join("dangling"), false, &[]).unwrap_err();
    assert!(problem.message.contains("broken link"));
}

#[test]
fn names_stay_inside() {
    let parent = tempfile::tempdir().unwrap();
    let folder = OutputFolder::stage(&parent.path().join("out"), false, &[]).unwrap();
    for name in ["", "..", "../x", "/etc/x", "a/../../x", "."] {
        assert!(folder.write(name, b"x").is_err(), "{name}");
    }
    assert_eq!(names(folder.staging.path()).len(), 0);
    assert!(OutputFolder::stage(Path::new("/"), true, &[]).is_err());
}

/// A run of another command, with one file.
fn other(target: &Path, force: bool) -> Result<Committed, Problem> {
    let folder = OutputFolder::stage(target, force, &[])?.of_command("freestand.assess/1")?;
    folder.write("objects.csv", b"new")?;
    folder.write(
        MANIFEST,
        br#"{"schema": "freestand.assess/1", "files": ["objects.csv", "manifest.json"]}"#,
    )?;
    folder.commit()
}

#[test]
fn a_folder_belongs_to_its_command() {
    let parent = tempfile::tempdir().unwrap();
    let target = parent.path().join("out");
    run(&target, false, &["srs.csv"]).unwrap();
    let problem = other(&target, false).unwrap_err();
    assert_eq!(
        problem.message,
        "the folder has the results of freestand run"
    );
    assert!(problem.hint.unwrap().contains("`force = true`"));
    // A command that is known only by its manifest is refused before anything moves.
    let folder = OutputFolder::stage(&target, false, &[]).unwrap();
    folder
        .write(
            MANIFEST,
            br#"{"schema": "freestand.manifest/1", "result": "freestand.shock/1"}"#,
        )
        .unwrap();
    assert!(
        folder
            .commit()
            .unwrap_err()
            .message
            .contains("results of freestand run")
    );
    assert!(announce(&target, false, "freestand.assess/1", &[]).is_err());
    assert_eq!(names(&target), ["srs.csv", "summary.json"]);
    // With force both commands' files are there, and neither removes the other's.
    assert_eq!(other(&target, true).unwrap().removed, [""; 0]);
    assert_eq!(
        names(&target),
        ["manifest.json", "objects.csv", "srs.csv", "summary.json"]
    );
    assert_eq!(
        run(&target, true, &["urs.csv"]).unwrap().removed,
        ["srs.csv"]
    );
    assert_eq!(
        names(&target),
        ["manifest.json", "objects.csv", "summary.json", "urs.csv"]
    );
}

#[test]
fn edited_files_are_the_users() {
    let parent = tempfile::tempdir().unwrap();
    let target = parent.path().join("out");
    run(&target, false, &["a.csv", "b.csv", "c.csv"]).unwrap();
    fs::write(target.join("a.csv"), "edited").unwrap();
    for files in [&["a.csv"][..], &["b.csv"]] {
        // It would be replaced, or removed.
        let problem = run(&target, false, files).unwrap_err();
        assert_eq!(
            problem.path.as_deref(),
            Some(target.join("a.csv").as_path())
        );
        assert!(
            problem
                .message
                .contains("was changed after freestand wrote it"),
            "{problem}"
        );
    }
    fs::write(target.join("b.csv"), "edited").unwrap();
    assert!(
        run(&target, false, &["a.csv"])
            .unwrap_err()
            .message
            .ends_with("like 1 more file")
    );
    assert!(announce(&target, false, "freestand.run/1", &[]).is_err());
    assert_eq!(names(&target), ["a.csv", "b.csv", "c.csv", "summary.json"]);
    // Force replaces what has the same name, and removes only what nobody edited.
    assert_eq!(run(&target, true, &["a.csv"]).unwrap().removed, ["c.csv"]);
    assert_eq!(fs::read(target.join("a.csv")).unwrap(), b"new");
    assert_eq!(fs::read(target.join("b.csv")).unwrap(), b"edited");
    assert_eq!(names(&target), ["a.csv", "b.csv", "summary.json"]);
    // b.csv is no longer in the manifest: the next run leaves it alone.
    assert_eq!(run(&target, false, &["c.csv"]).unwrap().removed, ["a.csv"]);
    assert_eq!(names(&target), ["b.csv", "c.csv", "summary.json"]);
    // A file that the user deleted is not missed.
    fs::remove_file(target.join("c.csv")).unwrap();
    assert!(run(&target, false, &["a.csv"]).is_ok());
}

#[test]
fn what_is_removed_is_named() {
    let parent = tempfile::tempdir().unwrap();
    let target = parent.path().join("out");
    run(
        &target,
        false,
        &["motions/synthetic-01.csv", "motions/synthetic-02.csv"],
    )
    .unwrap();
    let committed = run(&target, false, &["motions/synthetic-01.csv"]).unwrap();
    assert_eq!(
        committed.note().unwrap(),
        "removed motions/synthetic-02.csv of the earlier run"
    );
    assert_eq!(
        run(&target, false, &["motions/synthetic-01.csv"])
            .unwrap()
            .note(),
        None
    );
    let many: Vec<String> = (1..=8).map(|i| format!("{i}.csv")).collect();
    let note = removed_note(&many).unwrap();
    assert_eq!(
        note,
        "removed 1.csv, 2.csv, 3.csv, 4.csv, 5.csv, 6.csv and 2 more files of the earlier run"
    );
}

/// Every state that a kill can leave while the files are moved into place: some of the old files
/// removed, some of the new ones there, under the manifest that says so.
#[test]
fn a_kill_while_files_are_moved_leaves_a_folder_that_can_be_replaced() {
    let (old, new) = (["a.csv", "b.csv", "c.csv"], ["a.csv", "b.csv", "d.csv"]);
    for moved in 0..8u32 {
        let parent = tempfile::tempdir().unwrap();
        let target = parent.path().join("out");
        run(&target, false, &old).unwrap();
        fs::write(target.join("mine.txt"), "mine").unwrap();
        let all: BTreeSet<String> = old
            .iter()
            .chain(&new)
            .map(|name| (*name).to_owned())
            .collect();
        let all: BTreeSet<&String> = all.iter().collect();
        fs::write(
            target.join("summary.json"),
            incomplete("freestand.run", &all, &all, &BTreeMap::new()),
        )
        .unwrap();
        if moved & 1 != 0 {
            fs::remove_file(target.join("c.csv")).unwrap();
        }
        for (bit, name) in [(2, "a.csv"), (4, "d.csv")] {
            if moved & bit != 0 {
                fs::write(target.join(name), "half of the n").unwrap();
            }
        }
        assert!(
            other(&target, false)
                .unwrap_err()
                .message
                .contains("results of freestand run")
        );
        // What the kill left is replaced or removed, and is not worth a word.
        assert_eq!(run(&target, false, &new).unwrap().removed, [""; 0]);
        assert_eq!(
            names(&target),
            ["a.csv", "b.csv", "d.csv", "mine.txt", "summary.json"],
            "{moved}"
        );
        assert_eq!(fs::read(target.join("mine.txt")).unwrap(), b"mine");
        // The hashes are complete again.
        fs::write(target.join("d.csv"), "edited").unwrap();
        assert!(run(&target, false, &new).is_err());
    }
}

#[test]
fn a_long_run_keeps_the_hashes_of_the_results_that_it_will_replace() {
    let parent = tempfile::tempdir().unwrap();
    let target = parent.path().join("out");
    other(&target, false).unwrap();
    let progress = ["progress/000000.jsonl".to_owned()];
    announce(&target, false, "freestand.assess/1", &progress).unwrap();
    fs::create_dir(target.join("progress")).unwrap();
    fs::write(target.join("progress/000000.jsonl"), "part").unwrap();
    // Killed here: the part may be replaced, an edited result may not.
    announce(&target, false, "freestand.assess/1", &progress).unwrap();
    fs::write(target.join("objects.csv"), "edited").unwrap();
    for problem in [
        announce(&target, false, "freestand.assess/1", &progress),
        other(&target, false).map(drop),
    ] {
        assert!(problem.unwrap_err().message.contains("was changed"));
    }
    fs::write(target.join("objects.csv"), "new").unwrap();
    assert_eq!(other(&target, false).unwrap().removed, [""; 0]);
    assert_eq!(names(&target), ["manifest.json", "objects.csv"]);
}

#[test]
fn a_manifest_without_hashes_proves_nothing() {
    let parent = tempfile::tempdir().unwrap();
    let target = parent.path().join("out");
    fs::create_dir(&target).unwrap();
    fs::write(target.join("notes.txt"), "mine").unwrap();
    fs::write(
        target.join("summary.json"),
        r#"{"schema": "freestand.run/1", "files": ["notes.txt"]}"#,
    )
    .unwrap();
    assert!(run(&target, false, &["a.csv"]).is_err());
    run(&target, true, &["a.csv"]).unwrap();
    assert_eq!(names(&target), ["a.csv", "notes.txt", "summary.json"]);
}

/// A folder of results that somebody else made may have links: nothing is written, emptied or removed
/// through them, with `force` either.
#[cfg(unix)]
#[test]
fn links_in_a_folder_of_results_are_refused() {
    use std::os::unix::fs::symlink;
    let parent = tempfile::tempdir().unwrap();
    let (target, others) = (parent.path().join("out"), parent.path().join("others"));
    fs::create_dir_all(&target).unwrap();
    fs::create_dir_all(&others).unwrap();
    let mine = [
        others.join("000001.jsonl"),
        others.join("manifest.json"),
        others.join("lock"),
    ];
    for path in &mine {
        fs::write(path, "mine").unwrap();
    }
    let part = "progress/000001.jsonl".to_owned();
    for (link, to) in [
        ("manifest.json", &mine[1]),
        ("progress", &others),
        ("rows.csv", &mine[0]),
    ] {
        symlink(to, target.join(link)).unwrap();
        for force in [false, true] {
            let refused = |problem: Problem| {
                problem.path == Some(target.join(link)) && problem.kind == ProblemKind::Io
            };
            let staged = OutputFolder::stage(&target, force, &[])
                .and_then(|folder| folder.check(&["rows.csv".to_owned(), part.clone()]));
            // Without `force`, a folder with files of others is refused as such.
            assert!(refused(staged.unwrap_err()) || !force, "{link}");
            let names = ["rows.csv".to_owned(), part.clone()];
            let announced = announce(&target, force, "freestand.assess/1", &names);
            assert!(refused(announced.unwrap_err()) || !force, "{link}");
        }
        fs::remove_file(target.join(link)).unwrap();
    }
    assert_eq!(names(&target), [""; 0]);
    assert!(
        mine.iter()
            .all(|path| fs::read_to_string(path).unwrap() == "mine")
    );
}
