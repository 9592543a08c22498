//! What a person sees while an assessment runs, and what is left of one that was stopped.

#![expect(clippy::unwrap_used, reason = "helpers of tests may stop")]

use std::fs;
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

use freestand_app::job::{Beside, Job, Told, assess_telling};
use freestand_assess::list::{ListRequest, inventory_of};
use freestand_assess::portfolio::Estimate;
use freestand_report::assessment::JobReport;
use freestand_study::resolve::resolve;
use freestand_study::run::{Progress, Stage, Step, no_progress};

const STUDY: &str = "[ground]\nplace = \"Wellington\"\nseed = 3\n[building]\nstoreys = 6\n\
                     [worlds]\nfirst = 20\nmost = 80\n";

/// Three that may fall, and two on pads that may be hit too hard.
const ROWS: &str = "id,item,level_ratio,height [mm],thickness [mm],mass [kg],stiffness [N/mm],tolerance [g]\n\
                    a,box,0,1800,300,,,\nb,box,0.5,900,700,,,\nc,box,1,1500,500,,,\n\
                    d,rack,0.5,2000,900,400,1500,4\ne,rack,0,1600,800,300,3000,8\n";

fn run(
    out: &Path,
    (study, rows): (&str, &str),
    resume: bool,
    told: Told,
    progress: Progress,
) -> JobReport {
    let folder = tempfile::tempdir().unwrap();
    let list = folder.path().join("list.csv");
    fs::write(&list, rows).unwrap();
    let study = resolve(study, None, Path::new("")).unwrap();
    let inventory = inventory_of(&study, Some(&list), &ListRequest::default()).unwrap();
    let job = Job {
        resume,
        outcomes: true,
        ..Job::default()
    };
    assess_telling(
        &study,
        &inventory,
        out,
        &job,
        Beside::default(),
        told,
        progress,
    )
    .unwrap()
}

/// The columns of a row of `objects.csv`.
fn cells(out: &Path, id: &str, names: &[&str]) -> Vec<String> {
    let mut reader = csv::Reader::from_path(out.join("objects.csv")).unwrap();
    let header = reader.headers().unwrap().clone();
    let place = |name: &str| header.iter().position(|one| one == name).unwrap();
    let rows = reader.records().map(Result::unwrap);
    let row = rows
        .into_iter()
        .find(|row| &row[place("id")] == id)
        .unwrap();
    names
        .iter()
        .map(|name| row[place(name)].to_owned())
        .collect()
}

/// Stopped at several places of its effort, again and again: a stop loses the block of worlds that it is in and no other,
/// what was lived is in the outputs, and the bytes at the end are those of a run that was never stopped.
#[test]
#[ignore = "a quarter of a minute: 80 worlds of five objects, twice"]
fn every_finished_block_is_kept() {
    let folder = tempfile::tempdir().unwrap();
    let (whole, out) = (folder.path().join("whole"), folder.path().join("out"));
    let total = AtomicU64::new(0);
    let counts = |step: Step| {
        total.fetch_max(step.effort.map_or(0, |(done, _)| done), Ordering::Relaxed);
        ControlFlow::Continue(())
    };
    let plain = run(&whole, (STUDY, ROWS), false, Told::default(), &counts);
    // Each of three runs lives through some of the worlds: what follows after the last world is not kept.
    const STEPS: u64 = 7;
    let first = 20 * 7;
    let mut histories = 0;
    for run_number in 0..3 {
        let calls = AtomicU64::new(0);
        let stops = |step: Step| {
            calls.fetch_add(u64::from(step.effort.is_some()), Ordering::Relaxed);
            match calls.load(Ordering::Relaxed) >= STEPS {
                true => ControlFlow::Break(()),
                false => ControlFlow::Continue(()),
            }
        };
        let report = run(&out, (STUDY, ROWS), true, Told::default(), &stops);
        assert!(report.interrupted && report.unsettled > 0, "{run_number}");
        histories += report.histories;
        let [decision, worlds, low, high] = &cells(
            &out,
            "a",
            &["decision", "worlds", "p_overturn_low", "p_overturn_high"],
        )[..] else {
            unreachable!()
        };
        if !worlds.is_empty() {
            let (low, high): (f64, f64) = (low.parse().unwrap(), high.parse().unwrap());
            assert!(low < high, "{decision} {worlds}");
        }
    }
    assert!(histories >= first, "{histories}");
    let report = run(&out, (STUDY, ROWS), true, Told::default(), &no_progress);
    assert_eq!((report.interrupted, report.unsettled), (false, 0));
    // Five objects have seven histories in a world, and a block has 40 worlds.
    let repeated = (histories + report.histories).checked_sub(plain.histories);
    assert!(
        repeated.is_some_and(|repeated| repeated <= 3 * 40 * 7),
        "{repeated:?}"
    );
    for name in [
        "objects.csv",
        "worklist.csv",
        "worlds.csv",
        "outcomes.csv",
        "manifest.json",
        "report.html",
    ] {
        let read = |folder: &Path| fs::read(folder.join(name)).unwrap();
        assert!(read(&whole) == read(&out), "{name}");
    }
    assert!(!out.join("progress").exists());
}

/// The effort only grows, and from a tenth of it on that of the whole run is known within a factor of 1.5. The
/// questions are counted, and all are settled at the end.
#[test]
#[ignore = "ten seconds: 80 worlds of five objects"]
fn the_bar_moves_with_the_effort() {
    let steps = Mutex::new(Vec::new());
    let keeps = |step: Step| {
        if step.stage == Some(Stage::Objects) {
            steps.lock().unwrap().push(step);
        }
        ControlFlow::Continue(())
    };
    let folder = tempfile::tempdir().unwrap();
    run(
        &folder.path().join("out"),
        (STUDY, ROWS),
        false,
        Told::default(),
        &keeps,
    );
    let steps = steps.into_inner().unwrap();
    let efforts: Vec<(u64, u64)> = steps.iter().filter_map(|step| step.effort).collect();
    assert!(efforts.is_sorted_by_key(|(done, _)| *done) && efforts.len() > 20);
    let (all, _) = *efforts.last().unwrap();
    let late = efforts.iter().filter(|(done, _)| 10 * done >= all);
    let ratios: Vec<f64> = late
        .map(|(_, expected)| *expected as f64 / all as f64)
        .collect();
    let [least, most] = [f64::min, f64::max].map(|of| ratios.iter().copied().reduce(of).unwrap());
    assert!(least > 1.0 / 1.5 && most < 1.5, "{least} {most}");
    // Two questions about those with a tolerance.
    let last = steps.last().unwrap();
    assert_eq!((last.done, last.total), (7, 7));
    assert!(steps[0].done == 0 && steps.iter().all(|step| step.total == 7));
}

/// All objects have an estimate after the first 20 worlds, and sharper ones later.
#[test]
#[ignore = "ten seconds: 80 worlds of five objects"]
fn estimates_come_first_and_get_sharper() {
    let told = Mutex::new(Vec::new());
    let keeps = |estimates: &[Estimate]| {
        let mut told = told.lock().unwrap();
        told.push(
            estimates
                .iter()
                .map(|one| {
                    (
                        one.item.id.clone(),
                        one.worlds,
                        one.overturn.high - one.overturn.low,
                    )
                })
                .collect::<Vec<_>>(),
        );
    };
    let told_of = Told {
        estimates: Some(&keeps),
        ..Told::default()
    };
    let folder = tempfile::tempdir().unwrap();
    run(
        &folder.path().join("out"),
        (STUDY, ROWS),
        false,
        told_of,
        &no_progress,
    );
    let told = told.into_inner().unwrap();
    let ids: Vec<&str> = told[0].iter().map(|(id, ..)| id.as_str()).collect();
    assert_eq!(ids, ["a", "b", "c", "d", "e"]);
    assert!(told[0].iter().all(|(_, worlds, _)| *worlds == 20));
    let last = told.last().unwrap();
    let sharper = told[0]
        .iter()
        .zip(last)
        .filter(|(first, last)| last.1 > first.1);
    assert!(
        sharper.clone().count() > 0 && sharper.into_iter().all(|(first, last)| last.2 < first.2)
    );
}
