//! `freestand shard` as it is called: in a loop of a shell, killed and run again.

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use crate::program::{PROGRAM, command, execute};

const STUDY: &str = "[ground]\nseed = 3\n[building]\nstoreys = 8\n[worlds]\nfirst = 2\nmost = 4\nshares = false\n\
                     [assessment]\ncompliant = false\npages = 2\n";

/// A study, and a list of `rows` objects of which one cell cannot be read.
fn place(rows: usize) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let mut list = "id,floor,height [m],thickness [m],mass [kg]\n".to_owned();
    for i in 0..rows {
        let height = if i == 2 {
            "tall0x".to_owned()
        } else {
            format!("{}", 1.0 + 0.1 * (i % 12) as f64)
        };
        list += &format!(
            "o{i},{},{height},{},80\n",
            i % 9,
            0.25 + 0.03 * (i % 7) as f64
        );
    }
    fs::write(folder.path().join("city.toml"), STUDY).unwrap();
    fs::write(folder.path().join("city.csv"), list).unwrap();
    folder
}

fn run(folder: &Path, args: &str) -> Output {
    execute(folder, &args.split(' ').collect::<Vec<_>>())
}

fn said(output: &Output) -> (Option<i32>, String) {
    let text = [&output.stdout, &output.stderr]
        .map(|bytes| String::from_utf8_lossy(bytes).into_owned())
        .concat();
    (output.status.code(), text)
}

/// The outputs of one process, and those of the shards.
fn assert_same(folder: &Path) {
    let (code, text) = said(&run(
        folder,
        "assess city.toml --inventory city.csv --format csv,parquet --out whole",
    ));
    assert_eq!(code, Some(1), "{text}");
    let names: Vec<_> = fs::read_dir(folder.join("whole"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name())
        .collect();
    assert_eq!(names.len(), 7, "{names:?}");
    for name in names {
        let [whole, merged] =
            ["whole", "results"].map(|out| fs::read(folder.join(out).join(&name)).unwrap());
        assert!(whole == merged, "{} differs", name.display());
    }
}

/// The loop of docs/shards.md. One cell of the list cannot be read, which is said by the plan and by the
/// merge, and not by every shard.
#[test]
#[ignore = "seconds: a process a shard"]
fn a_loop_in_a_shell_does_an_assessment() {
    let page = include_str!("../../../../docs/shards.md");
    let (_, script) = page.split_once("```sh\n").unwrap();
    let (script, _) = script.split_once("```").unwrap();
    assert_eq!(script.matches("freestand shard").count(), 3);
    let folder = place(9);
    let binary = Path::new(PROGRAM).parent().unwrap();
    let path = format!("{}:{}", binary.display(), std::env::var("PATH").unwrap());
    let output = Command::new("sh")
        .args(["-c", script])
        .env("PATH", path)
        .current_dir(folder.path())
        .output()
        .unwrap();
    let (code, text) = said(&output);
    assert_eq!(code, Some(1), "{text}");
    assert_eq!(text.matches("unreadable").count(), 2, "{text}");
    assert_eq!(text.matches(" is finished: ").count(), 7, "{text}");
    assert!(text.contains("9 of 9 objects; "), "{text}");
    assert_same(folder.path());
}

/// Killed between the two parts of a shard: the first part is used, the second computed.
#[test]
#[ignore = "ten seconds: an assessment, twice"]
fn a_shard_that_is_killed_goes_on() {
    let folder = place(300);
    let (code, text) = said(&run(
        folder.path(),
        "shard plan city.toml --inventory city.csv --shards 1 --out plan",
    ));
    assert_eq!(code, Some(1), "{text}");
    let (code, text) = said(&run(folder.path(), "shard merge plan --out results"));
    assert_eq!(code, Some(1), "{text}");
    assert!(
        text.contains("freestand shard run plan --shard 0\n")
            && !folder.path().join("results").exists(),
        "{text}"
    );
    let mut child = command(folder.path())
        .args(["shard", "run", "plan", "--shard", "0", "--threads", "1"])
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    let part = folder.path().join("plan/out/00000-000.jsonl");
    let begin = Instant::now();
    while !part.exists() && begin.elapsed() < Duration::from_secs(300) {
        std::thread::sleep(Duration::from_millis(1));
    }
    child.kill().unwrap();
    assert_eq!(
        child.wait().unwrap().code(),
        None,
        "it had ended before it was killed"
    );
    let written = fs::metadata(&part).unwrap().modified().unwrap();
    assert!(!folder.path().join("plan/out/00000.json").exists());
    let (code, text) = said(&run(folder.path(), "shard run plan --shard 0"));
    assert_eq!(
        (code, text.contains("shard 0 is finished: 300 objects")),
        (Some(0), true),
        "{text}"
    );
    assert_eq!(fs::metadata(&part).unwrap().modified().unwrap(), written);
    let (code, text) = said(&run(folder.path(), "shard run plan --shard 0 --json"));
    assert_eq!(
        (code, text.contains("\"was_finished\": true")),
        (Some(0), true),
        "{text}"
    );
    let (code, text) = said(&run(folder.path(), "shard merge plan --out results"));
    assert_eq!(code, Some(1), "{text}");
    assert_same(folder.path());
}

/// What is refused has status 2, names the place and says what to do.
#[test]
fn what_cannot_run_is_refused() {
    let folder = place(4);
    let refused = |args: &str, message: &str, hint: &str| {
        let (code, text) = said(&run(folder.path(), args));
        assert!(
            code == Some(2) && text.contains(message) && text.contains(hint),
            "{args}: {code:?}\n{text}"
        );
    };
    refused(
        "shard plan city.toml --inventory city.csv --shards 2",
        "--out is missing",
        "name the folder of the plan",
    );
    refused(
        "shard plan city.toml --inventory city.csv --shards 0 --out plan",
        "--shards must be",
        "200 objects",
    );
    refused(
        "shard run . --shard 0",
        "there is no plan.json",
        "freestand shard plan makes one",
    );
    assert_eq!(
        run(
            folder.path(),
            "shard plan city.toml --inventory city.csv --shards 2 --out plan"
        )
        .status
        .code(),
        Some(1)
    );
    refused(
        "shard run plan --shard 2",
        "--shard must be from 0 to 1, not 2",
        "counted from 0",
    );
    refused(
        "shard run plan --shard 1 --seed 4",
        "neither --out nor --seed",
        "leave it out",
    );
    refused(
        "shard merge plan",
        "--out is missing",
        "name the folder for the results",
    );
    refused(
        "assess city.toml --inventory city.csv --out plan",
        "has the results of freestand shard-plan",
        "--out",
    );
    fs::write(
        folder.path().join("city.csv"),
        "id,height [m],thickness [m]\na,1,0.3\n",
    )
    .unwrap();
    refused(
        "shard run plan --shard 1",
        "city.csv: was changed after",
        "plan again into another folder",
    );
}
