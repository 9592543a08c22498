//! Assessments from end to end: the same bytes whatever happens to the run, probabilities against
//! integrals.

#![expect(
    clippy::unwrap_used,
    clippy::panic,
    reason = "helpers of tests may stop"
)]

use std::collections::HashMap;
use std::fmt::Write;
use std::fs;
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use freestand::block::Block;
use freestand::compliant::{CompliantBase, CompliantOptions, rock_compliant};
use freestand::cushion::{ContactLaw, Cushion};
use freestand::motion::Motion;
use freestand::rocking::{Base, Outcome, RockingOptions, Until, rock};
use freestand::synthesis::{SynthesisOptions, synthesize};
use freestand_app::job::{Job, assess_into};
use freestand_assess::list::{ListRequest, inventory_of};
use freestand_assess::restrain::{
    Anchors, RestrainFactors, RestrainFloor, RestrainHazard, RestrainRequest, restrain,
};
use freestand_output::answer::Answer as _;
use freestand_records::horizontal::HorizontalMotion;
use freestand_report::assessment::JobReport;
use freestand_report::restraint::restrain_report;
use freestand_study::resolve::resolve;
use freestand_study::run::{Progress, Stage, Step, no_progress};
use freestand_study::study::Study;

/// A low building in few worlds, so that a test does not take long.
fn study(assessment: &str) -> Study {
    let text = format!(
        "[ground]\nseed = 3\n[building]\nstoreys = 8\n[worlds]\nfirst = 3\nmost = 6\nshares = false\n[assessment]\n\
         {assessment}"
    );
    resolve(&text, None, Path::new("")).unwrap()
}

const HEADER: &str = "id,item,level_ratio,height [mm],thickness [mm],width [mm],mass [kg],stiffness [N/mm],tolerance [g],notes\n";

/// Slender and squat objects on three floors, some with missing data.
fn rows(count: usize) -> Vec<String> {
    (0..count)
        .map(|i| {
            let (height, thickness) = (600 + 170 * (i % 11), 150 + 60 * (i % 7));
            let tolerance = if i % 5 == 4 {
                String::new()
            } else {
                format!("{}", 2 + i % 3)
            };
            let level = ["0", "0.5", "1"][i % 3];
            format!(
                "o{i},box {i},{level},{height},{thickness},{},80,3000,{tolerance},=1+{i}\n",
                thickness + 200
            )
        })
        .collect()
}

fn inventory_file(folder: &Path, rows: &[String]) -> std::path::PathBuf {
    let path = folder.join("objects-in.csv");
    fs::write(&path, HEADER.to_owned() + &rows.concat()).unwrap();
    path
}

fn run(study: &Study, rows: &[String], out: &Path, job: &Job, progress: Progress) -> JobReport {
    let folder = tempfile::tempdir().unwrap();
    let inventory = inventory_of(
        study,
        Some(&inventory_file(folder.path(), rows)),
        &ListRequest::default(),
    )
    .unwrap();
    assess_into(study, &inventory, out, job, progress).unwrap()
}

/// Every file of a folder by its name.
fn contents(folder: &Path) -> HashMap<String, Vec<u8>> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap());
    entries
        .filter(|entry| entry.file_type().unwrap().is_file())
        .map(|entry| {
            (
                entry.file_name().into_string().unwrap(),
                fs::read(entry.path()).unwrap(),
            )
        })
        .collect()
}

/// One column of `objects.csv`, by id.
fn column(folder: &Path, name: &str) -> HashMap<String, String> {
    let mut reader = csv::Reader::from_path(folder.join("objects.csv")).unwrap();
    let headers = reader.headers().unwrap().clone();
    let place = |name: &str| headers.iter().position(|header| header == name).unwrap();
    let (id, wanted) = (place("id"), place(name));
    reader
        .records()
        .map(|row| row.unwrap())
        .map(|row| (row[id].to_owned(), row[wanted].to_owned()))
        .collect()
}

fn on_threads<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .unwrap()
        .install(work)
}

#[test]
#[ignore = "a quarter of a minute: every run several times"]
fn the_same_bytes_on_any_number_of_threads() {
    same_bytes(6);
}

#[test]
#[ignore = "half a minute: 24 objects, three times"]
fn many_objects_have_the_same_bytes_on_any_number_of_threads() {
    same_bytes(24);
}

fn same_bytes(count: usize) {
    let (study, rows) = (study(""), rows(count));
    let of = |threads: usize| {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("out");
        let job = Job {
            parquet: true,
            ..Job::default()
        };
        let report = on_threads(threads, || run(&study, &rows, &out, &job, &no_progress));
        assert_eq!(
            (
                report.objects,
                report.resumed,
                report.computed,
                report.interrupted
            ),
            (count, 0, count, false)
        );
        contents(&out)
    };
    let one = of(1);
    assert_eq!(one.len(), 7, "{:?}", one.keys());
    assert_eq!((&one, &one), (&of(2), &of(7)));
}

/// A ratio of 0 gives the bytes of no vertical motion; another one changes answers and is described, on
/// any number of threads.
#[test]
#[ignore = "ten seconds: a list twice"]
fn the_vertical_motion_of_a_world_changes_the_answers() {
    vertical_motion(2);
}

#[test]
#[ignore = "ten seconds: six objects, five times"]
fn the_vertical_motion_of_a_world_changes_many_answers() {
    vertical_motion(6);
}

fn vertical_motion(count: usize) {
    let rows = rows(count);
    let of = |ground: &str, building: &str, threads: usize| {
        let text = format!(
            "[ground]\nseed = 3\nhazard_factor = 0.3\n{ground}[building]\nstoreys = 8\n{building}[worlds]\nfirst = \
             3\nmost = 3\nshares = false\n"
        );
        let study = resolve(&text, None, Path::new("")).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("out");
        on_threads(threads, || {
            run(&study, &rows, &out, &Job::default(), &no_progress)
        });
        let text = |name: &str| fs::read_to_string(out.join(name)).unwrap();
        (text("objects.csv"), text("report.html"))
    };
    let (without, words) = of("", "", 2);
    assert_eq!(
        of("vertical = 0\n", "vertical_amplification = 2\n", 2).0,
        without
    );
    assert!(words.contains("The motions are horizontal only."));
    let (with, words) = of("vertical = 0.67\n", "", 1);
    assert_eq!(with, of("vertical = 0.67\n", "", 2).0);
    assert!(words.contains("Vertical motion: matched to 0.67 of the target"));
    let amplified = of("vertical = 0.67\n", "vertical_amplification = 2\n", 2).0;
    assert!(with != without && amplified != with);
}

/// A run is stopped while the motions are generated, then twice in the second part, then finished:
/// it writes the bytes of an undisturbed run, and computes no part twice.
#[test]
#[ignore = "half a minute: 1032 objects, several times"]
fn a_run_that_was_stopped_goes_on() {
    let (study, rows) = (study("compliant = false\npages = 3\n"), rows(1032));
    let folder = tempfile::tempdir().unwrap();
    let (whole, out) = (folder.path().join("whole"), folder.path().join("out"));
    run(&study, &rows, &whole, &Job::default(), &no_progress);
    let go_on = Job {
        resume: true,
        ..Job::default()
    };
    let stopped_in = |part: usize| {
        let parts = AtomicUsize::new(0);
        let stops = |step: Step| {
            // A part ends with as many more settled questions as it has.
            let is_there = step.stage == Some(Stage::Objects) && step.done >= 1024 * part;
            if is_there {
                parts.fetch_add(1, Ordering::Relaxed);
            }
            match parts.load(Ordering::Relaxed) > 0 {
                true => ControlFlow::Break(()),
                false => ControlFlow::Continue(()),
            }
        };
        let report = run(&study, &rows, &out, &go_on, &stops);
        // The outputs contain the objects that were begun, and say that the result is partial.
        let begun = report.resumed + report.computed + report.unsettled;
        let decisions = column(&out, "decision");
        let has_one = decisions.values().filter(|decision| !decision.is_empty());
        assert_eq!(has_one.count(), begun);
        (report.interrupted, report.resumed, report.computed)
    };
    assert_eq!(stopped_in(0), (true, 0, 0));
    let first = stopped_in(1);
    assert!(
        first.0 && first.1 == 0 && (1..=1024).contains(&first.2),
        "{first:?}"
    );
    let report = run(&study, &rows, &out, &go_on, &no_progress);
    assert!(!report.interrupted && report.unsettled == 0);
    assert_eq!(report.resumed + report.computed, 1032);
    assert_eq!(contents(&whole), contents(&out));
    assert!(!out.join("progress").exists());
    // Another run has nothing left to do.
    let report = run(&study, &rows, &out, &go_on, &no_progress);
    assert_eq!((report.resumed, report.computed), (1032, 0));
}

/// A killed run leaves finished parts; one that is incomplete is computed again.
#[test]
#[ignore = "half a minute: 1032 objects, twice"]
fn a_run_that_was_killed_goes_on() {
    let (study, rows) = (study("compliant = false\n"), rows(1032));
    let folder = tempfile::tempdir().unwrap();
    let (whole, out) = (folder.path().join("whole"), folder.path().join("out"));
    run(&study, &rows, &whole, &Job::default(), &no_progress);
    let killed = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
        let dies = |step: Step| {
            let is_first = Path::new(&out).join("progress/000000.jsonl").exists();
            if step.stage == Some(Stage::Objects) && is_first {
                panic!("killed");
            }
            ControlFlow::Continue(())
        };
        run(&study, &rows, &out, &Job::default(), &dies)
    }));
    let part = out.join("progress/000000.jsonl");
    assert!(killed.is_err() && part.exists());
    let bytes = fs::read(&part).unwrap();
    fs::write(&part, &bytes[..bytes.len() / 2]).unwrap();
    let report = run(
        &study,
        &rows,
        &out,
        &Job {
            resume: true,
            ..Job::default()
        },
        &no_progress,
    );
    // The finished part of 1024 objects is cut.
    assert_eq!((report.resumed, report.computed), (0, 1032));
    assert_eq!(contents(&whole), contents(&out));
}

/// The result of an object depends on its own row, not on other rows or their order; only its rank
/// does, which says where it is among the others.
#[test]
#[ignore = "a quarter of a minute: every run several times"]
fn the_order_of_the_rows_does_not_matter() {
    in_any_order(6);
}

#[test]
#[ignore = "ten seconds: 24 objects, twice"]
fn the_order_of_many_rows_does_not_matter() {
    in_any_order(24);
}

fn in_any_order(count: usize) {
    let (study, rows) = (study(""), rows(count));
    let folder = tempfile::tempdir().unwrap();
    let (out, turned, alone) = (
        folder.path().join("a"),
        folder.path().join("b"),
        folder.path().join("c"),
    );
    run(&study, &rows, &out, &Job::default(), &no_progress);
    let mut reversed = rows.clone();
    reversed.reverse();
    run(&study, &reversed, &turned, &Job::default(), &no_progress);
    run(&study, &rows[5..6], &alone, &Job::default(), &no_progress);
    let lines = |folder: &Path| -> Vec<String> {
        let text = fs::read_to_string(folder.join("objects.csv")).unwrap();
        let mut lines: Vec<String> = text
            .lines()
            .map(|line| line.split_once(',').unwrap().1.to_owned())
            .collect();
        lines.sort();
        lines
    };
    assert_eq!(lines(&out), lines(&turned));
    for name in [
        "p_exceed",
        "p_overturn",
        "decision",
        "why",
        "edge_acceleration_g_median",
        "worlds",
        "p_exceed_compliant",
    ] {
        assert_eq!(
            column(&out, name)["o5"],
            column(&alone, name)["o5"],
            "{name}"
        );
    }
}

/// Where the history is certain, the shock is lognormal about Eq. (5): P = Σ Φ(ln(a/a_c)/β)/n,
/// β² = (β_k² + β_m²)/4 + β_model².
#[test]
#[ignore = "seconds: many worlds"]
fn worlds_against_the_integral() {
    against_the_integral(512);
}

#[test]
#[ignore = "half a minute: 4096 worlds"]
fn many_worlds_against_the_integral() {
    against_the_integral(4096);
}

fn against_the_integral(worlds: u32) {
    let folder = tempfile::tempdir().unwrap();
    let (motions, shocks_g) = motions_and_shocks(folder.path());
    let text = format!(
        "[ground]\nmotions = [{motions}]\nunit = \"m/s2\"\n[building]\nstoreys = 8\n[worlds]\nfirst = {worlds}\nmost = \
         {worlds}\nperiod_spread = 0\ndamping_spread = 0\nshares = false\n[assessment]\ncompliant = \
         false\nrestitution_spread = 0\ngeometry_spread = 0\nstiffness_spread = 0.3\nmass_spread = 0.2\nmodel_spread = \
         0.1\n"
    );
    let beta = ((0.3f64.powi(2) + 0.2f64.powi(2)) / 4.0 + 0.01).sqrt();
    let study = resolve(&text, None, folder.path()).unwrap();
    let tolerances_g = [4.5, 5.0, 5.5, 6.0, 6.5, 7.0];
    let rows = tolerances_g
        .map(|tolerance_g| format!("a{tolerance_g},box,1,1500,400,,150,4380,{tolerance_g},\n"));
    let out = folder.path().join("out");
    run(&study, &rows, &out, &Job::default(), &no_progress);
    let found = column(&out, "p_exceed");
    let mut between = 0;
    for tolerance_g in tolerances_g {
        let got: f64 = found[&format!("a{tolerance_g}")].parse().unwrap();
        let by_motion = shocks_g
            .iter()
            .map(|shock_g| normal_probability((shock_g / tolerance_g).ln() / beta));
        let expected = by_motion.sum::<f64>() / shocks_g.len() as f64;
        between += usize::from((0.02..0.98).contains(&expected));
        // Four standard deviations of a share, none of which is above that of a fair coin.
        let error = 4.0 * (0.25 / f64::from(worlds)).sqrt();
        assert!(
            (got - expected).abs() <= error,
            "{tolerance_g} g: {got} {expected}"
        );
    }
    // Probabilities of 0 and 1 would not test the integral.
    assert!(between >= 3, "{shocks_g:?}");
}

/// Without any spread an assessment counts what both solvers compute motion by motion.
#[test]
#[ignore = "ten seconds of the scalar solvers"]
fn without_spreads_the_shares_are_those_of_the_solvers() {
    let folder = tempfile::tempdir().unwrap();
    let records: Vec<Motion> = (0..12)
        .map(|i| {
            let target = |t: f64| 0.5 * (1.0 + 0.1 * f64::from(i)) / (1.0 + t);
            synthesize(target, 7, u64::from(i as u32), &SynthesisOptions::default())
                .unwrap()
                .motion
        })
        .collect();
    let names: Vec<String> = (0..records.len())
        .map(|i| format!("\"m{i:02}.csv\""))
        .collect();
    for (record, name) in records.iter().zip(&names) {
        let motion = HorizontalMotion {
            along: record.clone(),
            across: None,
        };
        fs::write(folder.path().join(name.trim_matches('"')), motion.csv()).unwrap();
    }
    let none = [
        "restitution",
        "stiffness",
        "mass",
        "geometry",
        "model",
        "compliant",
    ]
    .map(|one| format!("{one}_spread = 0\n"));
    let text = format!(
        "[ground]\nmotions = [{}]\n[building]\nstoreys = 8\n[worlds]\nfirst = 12\nmost = 12\nperiod_spread = \
         0\ndamping_spread = 0\nshares = false\n[assessment]\npad_damping = 0.1\ncompliant_factor = 1\n{}",
        names.join(", "),
        none.concat()
    );
    let study = resolve(&text, None, folder.path()).unwrap();
    let sizes = [(2.0, 0.4, 4380.0), (1.6, 0.5, 1500.0), (3.0, 0.6, 8000.0)];
    let rows: Vec<String> = sizes
        .iter()
        .enumerate()
        .map(|(i, (h, t, k))| format!("o{i},box,0,{},{},,200,{k},5,\n", 1e3 * h, 1e3 * t))
        .collect();
    let out = folder.path().join("out");
    run(&study, &rows, &out, &Job::default(), &no_progress);
    let mut fallen = 0;
    for (i, (h, t, k)) in sizes.into_iter().enumerate() {
        let block = Block::uniform(h, t).unwrap();
        let stiffness_n_m = 1e3 * k;
        let damping_n_s_m = 0.2 * (stiffness_n_m * 200.0f64).sqrt();
        let cushion = Cushion::new(ContactLaw::KelvinVoigt {
            stiffness_n_m,
            damping_n_s_m,
        })
        .unwrap();
        let base = CompliantBase::new(200.0, cushion);
        let (mut rigid, mut pads) = (0, 0);
        for record in &records {
            // The floor of the ground moves with it, and comes to rest after it.
            let motion = Base {
                horizontal: Some(record),
                vertical: None,
            };
            let options = RockingOptions {
                until: Until::Settled { at_most_s: 60.0 },
                ..RockingOptions::default()
            };
            let outcome = rock(&block, motion, &options).unwrap().outcome;
            rigid += usize::from(outcome == Outcome::Overturned);
            let duration_s = Some(record.duration_s() + 10.0);
            let options = CompliantOptions {
                duration_s,
                ..CompliantOptions::default()
            };
            let outcome = rock_compliant(&block, &base, motion, &options)
                .unwrap()
                .outcome;
            pads += usize::from(outcome == Outcome::Overturned);
        }
        let share =
            |name: &str| column(&out, name)[&format!("o{i}")].parse::<f64>().unwrap() * 12.0;
        // The compliant base is chaotic where an object almost falls: one motion of twelve.
        assert_eq!(
            share("p_overturn_rigid").round() as usize,
            rigid,
            "{h} x {t}"
        );
        assert!(
            (share("p_overturn_compliant") - pads as f64).abs() <= 1.01,
            "{h} x {t}: {pads}"
        );
        fallen += rigid;
    }
    assert!(
        (1..36).contains(&fallen),
        "{fallen} of 36 fall: that would test nothing"
    );
}

/// Φ by its series; within 1e-15 for the arguments here.
fn normal_probability(x: f64) -> f64 {
    if x.abs() > 8.0 {
        return if x > 0.0 { 1.0 } else { 0.0 };
    }
    let (mut term, mut sum, mut n) = (x, x, 1.0);
    while term.abs() > 1e-17 * sum.abs() {
        n += 2.0;
        term *= x * x / n;
        sum += term;
    }
    0.5 + sum * (-0.5 * x * x).exp() / (2.0 * std::f64::consts::PI).sqrt()
}

/// The motions of the built-in ground as files, named as in a study, and the larger shock of the box
/// of [`worlds_against_the_integral`] on the roof under each, from `run`.
fn motions_and_shocks(folder: &Path) -> (String, Vec<f64>) {
    let text = "[ground]\ncount = 4\nseed = 3\n[building]\nstoreys = 8\nlevels = [{ name = \"roof\", level_ratio = \
         1.0 }]\n[objects]\nheights = \"1.5 m\"\nthicknesses = \"400 mm\"\n";
    let study = resolve(text, None, Path::new("")).unwrap();
    let result = freestand_study::run::run(&study, &no_progress).unwrap();
    let mut names = Vec::new();
    for (i, ground) in result.ground.iter().enumerate() {
        names.push(format!("\"m{i}.csv\""));
        fs::write(folder.join(format!("m{i}.csv")), ground.motion.csv()).unwrap();
    }
    let responses = result.levels[0].responses.iter().map(|row| &row[0]);
    let shocks_g = responses
        .map(|response| match response {
            freestand_study::result::ObjectResponse::Done { shock, .. } => {
                let sources = [
                    shock.edge_acceleration_g,
                    shock.edge_acceleration_impact_velocity_g,
                ];
                sources.into_iter().flatten().fold(0.0, f64::max)
            }
            freestand_study::result::ObjectResponse::FreeFlight(reason)
            | freestand_study::result::ObjectResponse::Failed(reason) => panic!("{reason}"),
        })
        .collect();
    (names.join(", "), shocks_g)
}

/// Missing data lead to no verdict on what was asked, and whether an object falls is always said.
#[test]
#[ignore = "ten seconds: a list of every kind of object"]
fn missing_data_is_no_verdict() {
    let rows = [
        "no-height,box,1,,400,,150,4380,5,\n",
        "no-mass,box,0,300,900,,,4380,5,\n",
        "no-tolerance,box,0,300,900,,150,4380,,\n",
        "falls,box,1,4000,150,,150,4380,,\n",
        "stands,box,0,300,900,,150,4380,5,\n",
    ]
    .map(str::to_owned);
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let text = "[ground]\nplace = \"Melbourne\"\nseed = 3\n[building]\nstoreys = 8\n[worlds]\nfirst = 40\nmost = 80\nshares = false\n";
    run(
        &resolve(text, None, Path::new("")).unwrap(),
        &rows,
        &out,
        &Job::default(),
        &no_progress,
    );
    let (decision, why) = (column(&out, "decision"), column(&out, "why"));
    let mut text = String::new();
    for id in ["no-height", "no-mass", "no-tolerance", "falls", "stands"] {
        writeln!(text, "{id} {}", decision[id]).unwrap();
    }
    assert_eq!(
        text,
        "no-height no-verdict\nno-mass no-verdict\nno-tolerance leave\nfalls restrain\nstands leave\n"
    );
    assert!(
        why["no-mass"].ends_with("because its mass was not given."),
        "{}",
        why["no-mass"]
    );
    assert!(
        why["no-tolerance"].ends_with("Only falling was assessed: no tolerance was given."),
        "{}",
        why["no-tolerance"]
    );
    assert!(
        why["no-height"].contains("because its height was not given"),
        "{}",
        why["no-height"]
    );
}

/// An object in a list has the force, the tension and the bracket of `restrain` on the same study, to
/// the last digit: one that falls, and one that is anchored and not simulated.
#[test]
fn a_list_and_restrain_agree() {
    let text = "[ground]\nplace = \"Wellington\"\nseed = 3\n[building]\nstoreys = 8\n[worlds]\nfirst = 3\nmost = \
                6\nshares = false\n[assessment]\ncompliant = false\n[restraint]\nresponse_ratio = 1.5\n";
    let study = resolve(text, None, Path::new("")).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let (list, out) = (folder.path().join("list.csv"), folder.path().join("out"));
    let rows = "id,level_ratio,height [mm],thickness [mm],width [mm],mass [kg],anchored\n\
                free,0.5,2300,400,900,140,no\nheld,1,1800,500,700,90,yes\n";
    fs::write(&list, rows).unwrap();
    let inventory = inventory_of(&study, Some(&list), &ListRequest::default()).unwrap();
    assess_into(&study, &inventory, &out, &Job::default(), &no_progress).unwrap();
    assert_eq!(column(&out, "decision")["free"], "restrain");
    let sizes = [
        ("free", 0.5, 2.3, 0.4, 0.9, 140.0),
        ("held", 1.0, 1.8, 0.5, 0.7, 90.0),
    ];
    for (id, level_ratio, height_m, thickness_m, width_m, mass_kg) in sizes {
        let report = restrain(RestrainRequest {
            mass_kg,
            height_m,
            thickness_m,
            width_m: Some(width_m),
            cg_height_m: None,
            hazard: RestrainHazard::Study(Arc::new(study.clone())),
            floor: RestrainFloor {
                level_ratio: Some(level_ratio),
                ..RestrainFloor::default()
            },
            factors: RestrainFactors::default(),
            component: None,
            anchors: Anchors::default(),
            units: freestand_input::quantity::UnitSystem::default(),
            is_compared: false,
        })
        .unwrap();
        let report = restrain_report(report);
        let names = [
            "anchor_tension_n",
            "anchor_tension_concrete_n",
            "bracket_force_n",
            "bracket_base_shear_n",
        ];
        for (listed, alone) in names
            .map(|name| (name, name))
            .into_iter()
            .chain([("restraint_force_n", "force_n")])
        {
            let listed: f64 = column(&out, listed)[id].parse().unwrap();
            assert_eq!(Some(listed), report.facts().number(alone), "{id}: {alone}");
            assert!(listed > 0.0, "{id}: {alone}");
        }
        assert_eq!(
            column(&out, "restraint_source")[id],
            "NZS 1170.5:2004, section 8"
        );
    }
}
