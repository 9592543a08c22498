//! `worlds.csv`: the motions that objects lived through, whatever happens to the run.

#![expect(clippy::unwrap_used, reason = "helpers of tests may stop")]

use std::fs;
use std::ops::ControlFlow;
use std::path::Path;

use freestand_app::job::{Job, assess_into};
use freestand_assess::list::{ListRequest, inventory_of};
use freestand_report::assessment::JobReport;
use freestand_study::resolve::resolve;
use freestand_study::run::{Progress, Stage, Step, no_progress};

/// No spread between the worlds of a motion, and few worlds.
const KNOWN: &str = "[worlds]\nperiod_spread = 0\ndamping_spread = 0\nmost = 20\nshares = false\n";

const INVENTORY: &str = "id,level_ratio,height [mm],thickness [mm]\na,1,1500,300\nb,0,1500,400\nc,1,900,500\nd,,900,500\n";

/// Writes a motion of 4 s whose largest acceleration is `peak_m_s2`, in both senses of direction.
fn motion(folder: &Path, name: &str, peak_m_s2: f64) {
    let sample = |i: usize| {
        if i <= 100 {
            peak_m_s2 * (std::f64::consts::TAU * i as f64 / 100.0).sin()
        } else {
            0.0
        }
    };
    let lines: String = (0..400)
        .map(|i| format!("{},{}\n", i as f64 * 0.01, sample(i)))
        .collect();
    fs::write(folder.join(name), format!("time_s,accel_m_s2\n{lines}")).unwrap();
}

fn run(folder: &Path, study: &str, out: &str, job: &Job, progress: Progress) -> JobReport {
    run_list(INVENTORY, folder, study, out, job, progress)
}

fn run_list(
    list: &str,
    folder: &Path,
    study: &str,
    out: &str,
    job: &Job,
    progress: Progress,
) -> JobReport {
    let study = resolve(study, None, folder).unwrap();
    let path = folder.join("objects-in.csv");
    fs::write(&path, list).unwrap();
    let inventory = inventory_of(&study, Some(&path), &ListRequest::default()).unwrap();
    assess_into(&study, &inventory, &folder.join(out), job, progress).unwrap()
}

/// A cell of each row.
fn column(table: &Path, name: &str) -> Vec<String> {
    let mut reader = csv::Reader::from_path(table).unwrap();
    let place = reader
        .headers()
        .unwrap()
        .iter()
        .position(|header| header == name)
        .unwrap();
    reader
        .records()
        .map(|row| row.unwrap()[place].to_owned())
        .collect()
}

fn numbers(table: &Path, name: &str) -> Vec<f64> {
    column(table, name)
        .iter()
        .map(|cell| cell.parse().unwrap())
        .collect()
}

/// Of `objects.csv`: the worlds of the object with the most.
fn most_worlds(table: &Path) -> usize {
    column(table, "worlds")
        .iter()
        .filter_map(|cell| cell.parse().ok())
        .max()
        .unwrap()
}

/// One motion and a known building: every world has its peak on the ground, and the same roof.
#[test]
fn a_given_motion_is_that_of_every_world() {
    let folder = tempfile::tempdir().unwrap();
    motion(folder.path(), "pulse.csv", 2.0);
    let study = format!(
        "[ground]\nmotions = [\"pulse.csv\"]\n[building]\nstoreys = 4\nperiod = \"0.5 s\"\n{KNOWN}"
    );
    let report = run(folder.path(), &study, "out", &Job::default(), &no_progress);
    assert!(
        report.files.contains(&"worlds.csv".to_owned()),
        "{:?}",
        report.files
    );
    let (table, objects) = (
        folder.path().join("out/worlds.csv"),
        folder.path().join("out/objects.csv"),
    );
    // Row d has no floor: it lives through no world.
    let worlds = most_worlds(&objects);
    let rows: Vec<(usize, &str)> = (0..worlds)
        .flat_map(|world| [(world, "0"), (world, "1")])
        .collect();
    let (world, level) = (column(&table, "world"), column(&table, "level_ratio"));
    let found: Vec<(usize, &str)> = world
        .iter()
        .map(|w| w.parse().unwrap())
        .zip(level.iter().map(String::as_str))
        .collect();
    assert_eq!(found, rows);
    let (pga, pfa, sa) = (
        numbers(&table, "pga_x_g"),
        numbers(&table, "pfa_x_g"),
        numbers(&table, "sa_0.2_x_g"),
    );
    // The sine is sampled at its peak, and the table has all digits: a few roundings are left.
    let is_peak = |g: &f64| (g * 9.80665 - 2.0).abs() < 1e-14;
    assert!(
        pga.iter().all(is_peak) && pfa.iter().step_by(2).all(is_peak),
        "{pga:?} {pfa:?}"
    );
    assert!(
        pfa.iter()
            .skip(1)
            .step_by(2)
            .all(|roof| *roof == pfa[1] && !is_peak(roof)),
        "{pfa:?}"
    );
    // A sine of 1 s carries a building of 0.2 s further than itself, but by less than half.
    assert!(
        sa.iter()
            .all(|one| *one == sa[0] && *one > pga[0] && *one < 1.5 * pga[0]),
        "{sa:?}"
    );
    assert!(
        numbers(&table, "period_s")
            .iter()
            .all(|period_s| (period_s - 0.5).abs() < 1e-12)
    );
    assert!(
        column(&table, "record").iter().all(|name| name == "pulse"),
        "{:?}",
        column(&table, "record")
    );
    assert!(
        column(&table, "pga_y_g")
            .iter()
            .chain(&column(&table, "pfa_y_g"))
            .all(String::is_empty)
    );
}

/// Where the floors' motions are given, each world has the next of them, and no ground.
#[test]
fn given_floors_have_no_ground() {
    let folder = tempfile::tempdir().unwrap();
    motion(folder.path(), "one.csv", 2.0);
    motion(folder.path(), "two.csv", 3.0);
    let level =
        |ratio: f64| format!("{{ level_ratio = {ratio}, motions = [\"one.csv\", \"two.csv\"] }}");
    let study = format!(
        "[building]\nlevels = [{}, {}]\n{KNOWN}",
        level(0.0),
        level(1.0)
    );
    run(folder.path(), &study, "out", &Job::default(), &no_progress);
    let table = folder.path().join("out/worlds.csv");
    let pfa = numbers(&table, "pfa_x_g");
    for (place, pfa_g) in pfa.iter().enumerate() {
        let peak_m_s2 = if place / 2 % 2 == 0 { 2.0 } else { 3.0 };
        assert!(
            (pfa_g * 9.80665 - peak_m_s2).abs() < 1e-14,
            "{place}: {pfa_g}"
        );
    }
    assert_eq!(
        pfa.len(),
        2 * most_worlds(&folder.path().join("out/objects.csv"))
    );
    assert_eq!(column(&table, "record")[..4], ["one", "one", "two", "two"]);
    for name in ["pga_x_g", "sa_1_x_g", "period_s", "damping_ratio"] {
        assert!(column(&table, name).iter().all(String::is_empty), "{name}");
    }
}

/// A run that is stopped while the table is written has none of it, and goes on to the bytes of an
/// undisturbed run, with worlds that are made anew.
#[test]
#[ignore = "half a minute: 80 worlds, a block more than 64"]
fn a_run_that_was_stopped_has_the_whole_table_or_none() {
    let folder = tempfile::tempdir().unwrap();
    let study = "[ground]\nseed = 3\n[building]\nstoreys = 4\n[worlds]\nfirst = 80\nmost = 80\nshares = false\n";
    run(folder.path(), study, "whole", &Job::default(), &no_progress);
    let (whole, out) = (folder.path().join("whole"), folder.path().join("out"));
    // In the second of the blocks of 64 worlds.
    let stops = |step: Step| match step.stage {
        Some(Stage::FloorMotions) if step.done > 0 => ControlFlow::Break(()),
        _ => ControlFlow::Continue(()),
    };
    let report = run(folder.path(), study, "out", &Job::default(), &stops);
    assert_eq!((report.computed, report.interrupted), (4, true));
    assert!(!out.join("worlds.csv").exists() && out.join("progress/000000.jsonl").exists());
    assert!(
        !report.files.contains(&"worlds.csv".to_owned()),
        "{:?}",
        report.files
    );
    let go_on = Job {
        resume: true,
        ..Job::default()
    };
    let report = run(folder.path(), study, "out", &go_on, &no_progress);
    assert_eq!(
        (report.resumed, report.computed, report.interrupted),
        (4, 0, false)
    );
    let read = |folder: &Path, name: &str| fs::read(folder.join(name)).unwrap();
    for name in ["worlds.csv", "objects.csv", "manifest.json"] {
        assert!(read(&whole, name) == read(&out, name), "{name}");
    }
    assert_eq!(numbers(&out.join("worlds.csv"), "world").len(), 160);
}

/// The shares of the outcomes are the probabilities; a run that was stopped goes on to the same
/// bytes, and one without outcomes is computed again.
#[test]
#[ignore = "ten seconds: worlds of several kinds of object"]
fn outcomes_are_what_was_counted() {
    let folder = tempfile::tempdir().unwrap();
    let study = "[ground]\nseed = 3\n[building]\nstoreys = 4\n[worlds]\nfirst = 20\nmost = 20\nshares = false\n";
    let wanted = Job {
        outcomes: true,
        resume: true,
        ..Job::default()
    };
    let report = run(folder.path(), study, "whole", &wanted, &no_progress);
    assert!(
        report.files.contains(&"outcomes.csv".to_owned()),
        "{:?}",
        report.files
    );
    let (whole, out) = (folder.path().join("whole"), folder.path().join("out"));
    let (table, objects) = (whole.join("outcomes.csv"), whole.join("objects.csv"));
    let ids = column(&table, "id");
    let expected: Vec<&str> = ["a", "b", "c"]
        .into_iter()
        .flat_map(|id| [id; 20])
        .collect();
    // Without pads only the rigid base is asked.
    assert_eq!(ids, expected);
    assert!(column(&table, "model").iter().all(|model| model == "rigid"));
    assert!(column(&table, "exceeded").iter().all(String::is_empty));
    let (fell, p) = (
        numbers(&table, "fell"),
        column(&objects, "p_overturn_rigid"),
    );
    for (place, p) in p.iter().take(3).enumerate() {
        let share = fell[20 * place..20 * (place + 1)].iter().sum::<f64>() / 20.0;
        assert_eq!(share, p.parse::<f64>().unwrap(), "{place}");
    }
    let lifts = column(&table, "lift_m");
    assert!(
        lifts
            .iter()
            .zip(&fell)
            .all(|(lift, fell)| lift.is_empty() == (*fell == 1.0)),
        "{lifts:?}"
    );

    let stops = |step: Step| match step.stage {
        Some(Stage::FloorMotions) => ControlFlow::Break(()),
        _ => ControlFlow::Continue(()),
    };
    let without = Job {
        resume: true,
        ..Job::default()
    };
    assert_eq!(
        run(folder.path(), study, "out", &without, &stops).computed,
        4
    );
    assert!(!out.join("outcomes.csv").exists());
    let report = run(folder.path(), study, "out", &wanted, &stops);
    assert_eq!(
        (report.resumed, report.computed, report.interrupted),
        (0, 4, true)
    );
    let report = run(folder.path(), study, "out", &wanted, &no_progress);
    assert_eq!(
        (report.resumed, report.computed, report.interrupted),
        (4, 0, false)
    );
    for name in ["worlds.csv", "outcomes.csv", "manifest.json"] {
        assert!(
            fs::read(whole.join(name)).unwrap() == fs::read(out.join(name)).unwrap(),
            "{name}"
        );
    }
    assert!(!out.join("progress").exists());
}

/// Objects share the floors of an intensity; those that fall even at the lowest are followed further
/// down, by themselves. The rate of an object is the same with the others and without them.
#[test]
fn the_yearly_rate_of_an_object_does_not_depend_on_the_others() {
    let folder = tempfile::tempdir().unwrap();
    motion(folder.path(), "pulse.csv", 3.0);
    let study = format!(
        "[ground]\nmotions = [\"pulse.csv\"]\n[building]\nstoreys = 4\nperiod = \"0.5 s\"\n{KNOWN}[assessment]\nannual = \
         true\n"
    );
    let rates = |list: &str, out: &str| -> Vec<String> {
        run_list(
            list,
            folder.path(),
            &study,
            out,
            &Job::default(),
            &no_progress,
        );
        column(
            &folder.path().join(out).join("objects.csv"),
            "p_overturn_per_year",
        )
    };
    let header = INVENTORY.lines().next().unwrap();
    // Slender, of medium size, and squat: one falls at low intensities, one at high ones, one never.
    let rows = ["a,1,1500,100", "b,0,1500,400", "c,1,900,800"];
    let together = rates(&format!("{header}\n{}\n", rows.join("\n")), "all");
    for row in rows {
        let id = row.split(',').next().unwrap();
        let alone = rates(&format!("{header}\n{row}\n"), id);
        assert!(
            together.contains(&alone[0]),
            "{row}: {alone:?} {together:?}"
        );
    }
    let mut sorted: Vec<f64> = together.iter().map(|rate| rate.parse().unwrap()).collect();
    sorted.sort_by(f64::total_cmp);
    // Never; between λ(2) and λ(0.5) of a return period of 475 years; more often than λ(0.5).
    assert_eq!(sorted[0], 0.0, "{together:?}");
    assert!(
        sorted[1] > 1.0 / 8.0 / 475.0 && sorted[1] < 8.0 / 475.0,
        "{together:?}"
    );
    assert!(sorted[2] > 8.0 / 475.0, "{together:?}");
}

/// The histories of a yearly rate are its own, at each intensity: on pads too, and however many worlds
/// the verdict took.
#[test]
fn the_yearly_rate_does_not_depend_on_the_worlds_of_the_verdict() {
    let folder = tempfile::tempdir().unwrap();
    motion(folder.path(), "pulse.csv", 3.0);
    let list = "id,level_ratio,height [mm],thickness [mm],mass [kg],stiffness [N/mm]\na,0,1500,400,80,300\n";
    let rates = |worlds: &str, out: &str| {
        let study = format!(
            "[ground]\nmotions = [\"pulse.csv\"]\n[building]\nstoreys = 4\nperiod = \"0.5 s\"\n[worlds]\nperiod_spread \
             = 0\ndamping_spread = 0\nshares = false\n{worlds}[assessment]\nannual = true\n"
        );
        run_list(
            list,
            folder.path(),
            &study,
            out,
            &Job::default(),
            &no_progress,
        );
        let table = folder.path().join(out).join("objects.csv");
        (most_worlds(&table), column(&table, "p_overturn_per_year"))
    };
    let (few, rate) = rates("first = 20\nmost = 20\n", "few");
    let (many, same) = rates("first = 320\nmost = 320\n", "many");
    // 160 worlds at each intensity.
    assert!(few <= 20 && many >= 160, "{few} {many}");
    assert!(
        rate[0].parse::<f64>().unwrap() > 0.0 && rate == same,
        "{rate:?} {same:?}"
    );
}
