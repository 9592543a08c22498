//! An assessment in shards: the bytes of one process, whatever the number of shards, their order, the
//! threads, and what was damaged or killed in between.

#![expect(clippy::unwrap_used, reason = "helpers of tests may stop")]

use std::collections::BTreeMap;
use std::fs;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use freestand_app::job::{
    Job, Merged, PlanRequest, assess_into, merge_shards, plan_shards, run_shard,
};
use freestand_assess::list::{ListRequest, inventory_of};
use freestand_input::problem::Problems;
use freestand_inventory::Inventory;
use freestand_report::assessment::PlanReport;
use freestand_report::signature::Signing;
use freestand_study::resolve::{Overrides, load};
use freestand_study::run::{Step, no_progress};
use freestand_study::study::Study;

const STUDY: &str =
    "[ground]\nseed = 3\n[building]\nstoreys = 8\n[worlds]\nfirst = 3\nmost = 6\nshares = false\n";

/// Slender and squat objects on three floors, two with the same id, some with cells that cannot be read.
fn list(rows: usize) -> String {
    let mut text =
        "id,item,floor,height [mm],thickness [mm],width [mm],mass [kg],stiffness [N/mm],tolerance \
                    [g],notes,Asset\n"
            .to_owned();
    for i in 0..rows {
        let (height, thickness) = (600 + 170 * (i % 11), 150 + 60 * (i % 7));
        let tolerance = ["", "2", "3", "4", "soft"][i % 5];
        let floor = ["0", "4", "roof"][i % 3];
        let id = if i == 17 { 3 } else { i };
        text += &format!(
            "o{id},box {i},{floor},{height},{thickness},{},80,3000,{tolerance},=1+{i},a{i}\n",
            thickness + 200
        );
    }
    text
}

/// A folder with a study and its list.
struct Place {
    folder: tempfile::TempDir,
    study: Study,
    inventory: Inventory,
}

impl Place {
    fn new(study: &str, rows: usize) -> Self {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("objects-in.csv"), list(rows)).unwrap();
        Self::of(folder, study)
    }

    fn of(folder: tempfile::TempDir, text: &str) -> Self {
        let path = folder.path().join("study.toml");
        fs::write(&path, text).unwrap();
        let study = load(&path, &Overrides::default()).unwrap();
        let list = folder.path().join("objects-in.csv");
        let inventory = inventory_of(&study, Some(&list), &ListRequest::default()).unwrap();
        Self {
            folder,
            study,
            inventory,
        }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// The files of one process.
    fn whole(&self) -> BTreeMap<String, Vec<u8>> {
        let job = Job {
            parquet: true,
            outcomes: true,
            ..Job::default()
        };
        let out = self.path("whole");
        assess_into(&self.study, &self.inventory, &out, &job, &no_progress).unwrap();
        contents(&out)
    }

    fn plan(&self, name: &str, shards: usize) -> Result<PlanReport, Problems> {
        let request = PlanRequest {
            study: &self.study,
            seed: None,
            inventory: &self.inventory,
            list: &ListRequest::default(),
            shards,
            outcomes: true,
        };
        plan_shards(&request, &self.path(name), false)
    }

    fn run(&self, plan: &str, shard: usize) -> Result<bool, Problems> {
        run_shard(&self.path(plan), shard, &no_progress).map(|report| report.was_finished)
    }

    /// The files of a merge, or the shards that are missing.
    fn merged(&self, plan: &str) -> Result<BTreeMap<String, Vec<u8>>, Vec<usize>> {
        let out = self.path(&format!("{plan}-merged"));
        match merge_shards(
            &self.path(plan),
            &out,
            false,
            Signing::default(),
            &no_progress,
        )
        .unwrap()
        {
            Merged::Done(_) => Ok(contents(&out)),
            Merged::Missing(missing) => {
                assert!(!out.exists());
                Err(missing)
            }
        }
    }
}

/// Every file of a folder by its name.
fn contents(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path());
    entries
        .map(|path| {
            (
                path.file_name().unwrap().to_str().unwrap().to_owned(),
                fs::read(&path).unwrap(),
            )
        })
        .collect()
}

/// Every file below a folder with its bytes.
fn tree(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut all = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        match path.is_dir() {
            true => all.extend(tree(&path)),
            false => drop(all.insert(path.clone(), fs::read(&path).unwrap())),
        }
    }
    all
}

/// Compared file by file, so that a failure names the file.
fn assert_same(whole: &BTreeMap<String, Vec<u8>>, merged: &BTreeMap<String, Vec<u8>>, what: &str) {
    assert_eq!(
        whole.keys().collect::<Vec<_>>(),
        merged.keys().collect::<Vec<_>>(),
        "{what}"
    );
    for (name, bytes) in whole {
        assert!(*bytes == merged[name], "{what}: {name} differs");
    }
}

fn on_threads<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .unwrap()
        .install(work)
}

fn message(result: Result<impl std::fmt::Debug, Problems>) -> String {
    let problem = result.unwrap_err().problems.swap_remove(0);
    format!(
        "{problem} | {}",
        problem.hint.as_deref().unwrap_or_default()
    )
}

/// The merge has the files of one process, with report and manifest, to the byte.
#[test]
#[ignore = "half a minute: 30 rows, four times"]
fn shards_in_any_order_give_the_bytes_of_one_process() {
    let place = Place::new(STUDY, 30);
    let whole = place.whole();
    assert_eq!(whole.len(), 8, "{:?}", whole.keys());
    for (shards, step, threads) in [(1, 1, 2), (7, 3, 1), (64, 27, 2)] {
        let plan = format!("plan-{shards}");
        let report = place.plan(&plan, shards).unwrap();
        assert_eq!(
            (report.rows, report.shards, report.problems.is_empty()),
            (30, shards, false)
        );
        assert_eq!(place.merged(&plan).unwrap_err().len(), shards);
        // The step has no divisor in common with the number: every shard once, out of order.
        for shard in (0..shards).map(|i| (i * step + 5) % shards) {
            assert!(!on_threads(threads, || place.run(&plan, shard)).unwrap());
        }
        let merged = on_threads(3 - threads, || place.merged(&plan)).unwrap();
        assert_same(&whole, &merged, &plan);
    }
}

/// A report that rests on values quoted from memory is a draft in shards as well, until somebody confirms them; then it is
/// that of one process to the byte.
#[test]
fn a_merged_report_can_be_signed() {
    let study = "[ground]\nplace = \"Athens\"\nseed = 3\n[building]\nstoreys = 8\n[worlds]\nfirst = 2\nmost = 2\nshares = false\n";
    let place = Place::new(study, 2);
    place.plan("plan", 1).unwrap();
    place.run("plan", 0).unwrap();
    let signed = Signing {
        allows_recalled: true,
    };
    let of = |name: &str, signing: Signing| {
        let out = place.path(name);
        let merged = merge_shards(&place.path("plan"), &out, false, signing, &no_progress);
        assert!(matches!(merged.unwrap(), Merged::Done(_)));
        contents(&out)
    };
    let (draft, merged) = (of("draft", Signing::default()), of("signed", signed));
    assert_ne!(draft["report.html"], merged["report.html"]);
    let job = Job {
        parquet: true,
        outcomes: true,
        signing: signed,
        ..Job::default()
    };
    let out = place.path("whole");
    assess_into(&place.study, &place.inventory, &out, &job, &no_progress).unwrap();
    assert_same(&contents(&out), &merged, "signed");
}

/// The parts of a shard, and what depends on the number of rows of the whole list: from 501 on no shares
/// are computed, however few rows a shard has.
#[test]
#[ignore = "half a minute: 510 rows, three times"]
fn a_long_list_is_the_same_in_shards_of_several_parts() {
    let place = Place::new(
        "[building]\nstoreys = 8\n[worlds]\nfirst = 2\nmost = 2\n[assessment]\ncompliant = false\npages = 3\n",
        510,
    );
    let whole = place.whole();
    for shards in [1, 5] {
        let plan = format!("plan-{shards}");
        place.plan(&plan, shards).unwrap();
        for shard in 0..shards {
            place.run(&plan, shard).unwrap();
        }
        assert_same(&whole, &place.merged(&plan).unwrap(), &plan);
    }
}

/// Shards that run at the same time make the same motions, and do not disturb each other.
#[test]
#[ignore = "ten seconds: a list, several times"]
fn shards_at_the_same_time_give_the_bytes_of_one_process() {
    let place = Place::new(STUDY, 10);
    let whole = place.whole();
    place.plan("plan", 5).unwrap();
    let dir = place.path("plan");
    std::thread::scope(|scope| {
        // Each shard twice.
        for shard in (0..5).chain(0..5) {
            let dir = &dir;
            scope.spawn(move || run_shard(dir, shard, &no_progress).unwrap());
        }
    });
    assert_same(&whole, &place.merged("plan").unwrap(), "at once");
    let left = tree(&dir)
        .into_keys()
        .filter(|path| path.to_string_lossy().contains("partial"));
    assert_eq!(left.collect::<Vec<_>>(), Vec::<PathBuf>::new());
}

/// A plan that was killed while its files moved into place is made again.
#[test]
fn a_plan_that_was_killed_is_made_again() {
    let place = Place::new(STUDY, 4);
    place.plan("plan", 2).unwrap();
    let dir = place.path("plan");
    let good = tree(&dir);
    let mut manifest: serde_json::Value =
        serde_json::from_slice(&good[&dir.join("plan.json")]).unwrap();
    manifest["schema"] = "freestand.incomplete/1".into();
    manifest["command"] = "freestand.shard-plan".into();
    manifest["in_progress"] = manifest["files"].clone();
    fs::write(dir.join("plan.json"), manifest.to_string()).unwrap();
    fs::remove_file(dir.join("in/00001.jsonl")).unwrap();
    assert!(
        message(place.run("plan", 0))
            .contains("plan.json is not a plan of freestand, or is damaged")
    );
    assert!(!place.plan("plan", 2).unwrap().was_planned);
    assert_eq!(tree(&dir), good);
}

/// Records, one of them named from the root of the file system, are kept with the plan: the originals
/// are removed before the shards run.
#[test]
fn a_plan_does_not_need_the_originals() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir_all(folder.path().join("records/north")).unwrap();
    fs::write(folder.path().join("objects-in.csv"), list(6)).unwrap();
    for (i, name) in ["records/a.csv", "records/north/b.csv"]
        .into_iter()
        .enumerate()
    {
        let samples = (0..800).map(|k| {
            format!(
                "{},{}\n",
                0.01 * f64::from(k),
                (0.05 * f64::from(k) * (1.0 + i as f64)).sin()
            )
        });
        fs::write(
            folder.path().join(name),
            "time [s],acceleration [m/s2]\n".to_owned() + &samples.collect::<String>(),
        )
        .unwrap();
    }
    let from_root = folder.path().join("records/north/b.csv");
    let text = format!(
        "[ground]\nmotions = [\"records/a.csv\", '{}']\n[building]\nstoreys = 8\n[worlds]\nfirst = 4\nmost = \
         4\nshares = false\n",
        from_root.display()
    );
    let place = Place::of(folder, &text);
    let mut whole = place.whole();
    place.plan("plan", 2).unwrap();
    for name in ["records", "whole"] {
        fs::remove_dir_all(place.path(name)).unwrap();
    }
    fs::remove_file(place.path("study.toml")).unwrap();
    fs::remove_file(place.path("objects-in.csv")).unwrap();
    // The folder may move.
    fs::rename(place.path("plan"), place.path("moved")).unwrap();
    for shard in [1, 0] {
        place.run("moved", shard).unwrap();
    }
    let mut merged = place.merged("moved").unwrap();
    // The manifest has the text of the study, in which the path from the root became relative.
    assert_ne!(
        whole.remove("manifest.json"),
        merged.remove("manifest.json")
    );
    assert_same(&whole, &merged, "moved");
}

/// What was killed or damaged is done again, and nothing else.
#[test]
#[ignore = "twenty seconds: many shards, each done again"]
fn a_shard_that_is_not_intact_is_done_again() {
    let place = Place::new(STUDY, 12);
    let whole = place.whole();
    place.plan("plan", 3).unwrap();
    let dir = place.path("plan");
    let died = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
        // Within a part it is only asked whether to stop.
        run_shard(&dir, 0, &|step: Step| match step.stage {
            None => panic!("killed"),
            Some(_) => ControlFlow::Continue(()),
        })
    }));
    assert!(died.is_err());
    let stops = |_: Step| ControlFlow::Break(());
    assert!(run_shard(&dir, 0, &stops).unwrap_err().is_stopped());
    assert_eq!(place.merged("plan").unwrap_err(), [0, 1, 2]);
    for shard in 0..3 {
        assert!(!place.run("plan", shard).unwrap());
        assert!(place.run("plan", shard).unwrap());
    }
    assert!(dir.join("motions/000002-0.motion").exists());
    let good = tree(&dir);
    let damage = |name: &str, with: &dyn Fn(&[u8]) -> Vec<u8>| {
        let path = dir.join(name);
        fs::write(&path, with(&good[&path])).unwrap();
    };
    // Half a file, another number, a shard without its last file, a motion that no shard needs any more.
    damage("out/00000-000.jsonl", &|bytes| {
        bytes[..bytes.len() / 2].to_vec()
    });
    damage("out/00001-000.jsonl", &|bytes| {
        String::from_utf8_lossy(bytes)
            .replacen("0.", "1.", 1)
            .into_bytes()
    });
    fs::remove_file(dir.join("out/00002.json")).unwrap();
    damage("motions/000001-0.motion", &|bytes| bytes[..100].to_vec());
    assert_eq!(place.merged("plan").unwrap_err(), [0, 1, 2]);
    for shard in 0..3 {
        assert!(!place.run("plan", shard).unwrap());
    }
    assert_same(&whole, &place.merged("plan").unwrap(), "again");
    for (path, bytes) in tree(&dir) {
        let is_timed =
            path.parent().unwrap().ends_with("out") && path.extension().unwrap() == "json";
        assert!(is_timed || good[&path] == bytes, "{}", path.display());
    }
}

#[test]
#[ignore = "seconds: shards of several lists"]
fn what_does_not_fit_is_refused_and_nothing_is_lost() {
    let place = Place::new(STUDY, 6);
    assert!(
        message(place.plan("plan", 0))
            .starts_with("`shards` must be a whole number from 1 to 100000, not 0")
    );
    assert!(!place.plan("plan", 2).unwrap().was_planned);
    place.run("plan", 0).unwrap();
    let dir = place.path("plan");
    let good = tree(&dir);
    // The same plan again, another plan, other files.
    assert!(place.plan("plan", 2).unwrap().was_planned);
    assert!(message(place.plan("plan", 3)).contains("has another plan"));
    fs::create_dir(place.path("mine")).unwrap();
    fs::write(place.path("mine/thesis.txt"), "years").unwrap();
    assert!(message(place.plan("mine", 2)).contains("files that freestand did not write"));
    assert!(message(place.run("mine", 0)).contains("there is no plan.json"));
    assert!(message(place.run("nowhere", 0)).contains("there is no plan.json"));
    let refused = message(place.run("plan", 2));
    assert!(
        refused.contains("must be from 0 to 1, not 2")
            && refused.contains("2 shards, counted from 0"),
        "{refused}"
    );
    assert_eq!(tree(&dir), good);
    // Results are not written into the plan, nor over files of the user.
    place.run("plan", 1).unwrap();
    let good = tree(&dir);
    for out in ["plan", "plan/out", "mine"] {
        merge_shards(
            &dir,
            &place.path(out),
            false,
            Signing::default(),
            &no_progress,
        )
        .unwrap_err();
    }
    assert_eq!(
        (tree(&dir), fs::read(place.path("mine/thesis.txt")).unwrap()),
        (good.clone(), b"years".to_vec())
    );
    // The list was changed since.
    let original = fs::read(place.path("objects-in.csv")).unwrap();
    fs::write(place.path("objects-in.csv"), list(7)).unwrap();
    let refused = message(merge_shards(
        &dir,
        &place.path("merged"),
        false,
        Signing::default(),
        &no_progress,
    ));
    assert!(
        refused.contains("objects-in.csv: was changed after the shards were planned"),
        "{refused}"
    );
    assert!(
        refused.contains("plan again into another folder")
            && refused.contains("study/objects-in.csv"),
        "{refused}"
    );
    fs::remove_file(dir.join("out/00001.json")).unwrap();
    assert!(message(place.run("plan", 1)).contains("was changed after"));
    fs::write(place.path("objects-in.csv"), &original).unwrap();
    // Files of the plan itself.
    let with = |name: &str, from: &str, to: &str| {
        let path = dir.join(name);
        let text = String::from_utf8(good[&path].clone()).unwrap();
        assert!(text.contains(from));
        fs::write(&path, text.replacen(from, to, 1)).unwrap();
        let refused = message(place.run("plan", 1));
        fs::write(&path, &good[&path]).unwrap();
        refused
    };
    assert!(
        with("in/00001.jsonl", "80", "81").contains("in/00001.jsonl: is not as it was planned")
    );
    assert!(
        with("study/study.toml", "seed = 3", "seed = 4")
            .contains("study/study.toml: is not as it was planned")
    );
    let version = format!("\"version\": \"{}\"", env!("CARGO_PKG_VERSION"));
    let refused = with("plan.json", &version, "\"version\": \"0.0.1\"");
    assert!(
        refused.contains("was planned by freestand 0.0.1, and this is"),
        "{refused}"
    );
    assert!(refused.contains("use the version of the plan"), "{refused}");
    assert!(with("plan.json", "freestand.shard-plan/1", "freestand.run/1").contains("not a plan"));
    place.run("plan", 1).unwrap();
    assert!(place.merged("plan").is_ok());
}
