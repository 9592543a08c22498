//! Walls, neighbours and free casters of a list, against the solvers on the same motion.

#![expect(clippy::unwrap_used, reason = "helpers of tests may stop")]

use std::collections::HashMap;
use std::fs;
use std::path::Path;

use freestand::block::Block;
use freestand::motion::Motion;
use freestand::rocking::{Base, RockingOptions, Until, rock};
use freestand::sliding::{Clearance, Friction, SlidingOptions, slide, trip_speed_m_s};
use freestand::wall::{Wall, Walls};
use freestand_assess::job::{Job, ListRequest, assess_into, inventory_of};
use freestand_study::resolve::resolve;
use freestand_study::run::no_progress;

const WORLDS: usize = 20;

const HEADER: &str = "id,level_ratio,height [mm],thickness [mm],width [mm],mass [kg],stiffness [N/mm],tolerance [g],\
                      wall_gap [mm],neighbour_gap [mm],wall_restitution,wall_stiffness [N/mm]\n";

/// 4 s that begin with half a sine of 4.5 m/s² and half a sine of −3.6 m/s²: a wall on the left and one
/// on the right differ, and what is thinner than 0.45 of its height lifts.
fn pulse() -> Motion {
    let sample = |i: usize| {
        let peak_m_s2 = if i <= 50 { 4.5 } else { 3.6 };
        if i <= 100 { peak_m_s2 * (std::f64::consts::TAU * i as f64 / 100.0).sin() } else { 0.0 }
    };
    Motion::new(0.01, (0..400).map(sample).collect()).unwrap()
}

/// Every world has the same floor and the same object; only the side of the wall is drawn.
fn assess(folder: &Path, settings: &str, header: &str, rows: &str) {
    let motion = pulse();
    let lines: String =
        motion.accel_m_s2().iter().enumerate().map(|(i, a)| format!("{},{a}\n", i as f64 * motion.dt_s())).collect();
    fs::write(folder.join("pulse.csv"), format!("time_s,accel_m_s2\n{lines}")).unwrap();
    let none =
        ["restitution", "stiffness", "mass", "geometry", "model", "compliant"].map(|one| format!("{one}_spread = 0\n"));
    let text = format!(
        "[ground]\nmotions = [\"pulse.csv\"]\n[building]\nstoreys = 4\nperiod = \"0.5 s\"\n[worlds]\nfirst = \
         {WORLDS}\nmost = {WORLDS}\nperiod_spread = 0\ndamping_spread = 0\nshares = false\n[assessment]\n{settings}{}",
        none.concat()
    );
    let study = resolve(&text, None, folder).unwrap();
    let list = folder.join("list.csv");
    fs::write(&list, format!("{header}{rows}")).unwrap();
    let inventory = inventory_of(&study, Some(&list), &ListRequest::default()).unwrap();
    assert!(!inventory.has_errors(), "{:?}", inventory.findings);
    let job = Job { outcomes: true, ..Job::default() };
    assess_into(&study, &inventory, &folder.join("out"), &job, &no_progress).unwrap();
}

/// The rows of a table, each by the names of its columns.
fn table(folder: &Path, name: &str) -> Vec<HashMap<String, String>> {
    let mut reader = csv::Reader::from_path(folder.join("out").join(name)).unwrap();
    reader.deserialize().map(|row| row.unwrap()).collect()
}

fn with_wall(block: &Block, walls: Walls) -> (f64, f64) {
    let motion = pulse();
    let base = Base { horizontal: Some(&motion), vertical: None };
    let options = RockingOptions { walls, until: Until::Settled { at_most_s: 60.0 }, ..RockingOptions::default() };
    let found = rock(block, base, &options).unwrap();
    let fastest = found.wall_impacts.iter().map(|one| one.omega_before_rad_s.abs()).fold(0.0, f64::max);
    let lever_m = found.contacts.iter().flatten().map(|contact| contact.lever_m).fold(0.0, f64::max);
    (found.uplift_m, fastest * lever_m)
}

/// The wall stands on the left in some worlds and on the right in the others, and each world is the
/// history of the solver: for a wall that touches, one of the two never lifts before the motion
/// turns.
#[test]
fn every_world_is_a_history_beside_its_wall() {
    for gap_m in [0.0, 0.02] {
        let folder = tempfile::tempdir().unwrap();
        assess(folder.path(), "", HEADER, &format!("a,0,1800,600,,100,4000,5,{},,0.3,2000\n", 1e3 * gap_m));
        let block = Block::uniform(1.8, 0.6).unwrap();
        let wall = Some(Wall { restitution_ratio: 0.3, ..Wall::at(gap_m) });
        let left = with_wall(&block, Walls { left: wall, right: None });
        let right = with_wall(&block, Walls { left: None, right: wall });
        assert!((left.0 - right.0).abs() > 1e-3, "{left:?} {right:?}: the sides must differ");
        let rows = table(folder.path(), "outcomes.csv");
        assert!(rows.iter().all(|row| row["model"] == "rigid"), "its pads are not asked");
        let lifts: Vec<f64> = rows.iter().map(|row| row["lift_m"].parse().unwrap()).collect();
        // The kernel for many blocks gives the scalar answers to 1e-8.
        let is = |lift_m: f64, one: f64| (lift_m - one).abs() <= 1e-8 + 1e-7 * one;
        let on_left = lifts.iter().filter(|lift_m| is(**lift_m, left.0)).count();
        let on_right = lifts.iter().filter(|lift_m| is(**lift_m, right.0)).count();
        assert_eq!(on_left + on_right, rows.len(), "{lifts:?} {left:?} {right:?}");
        // Sixteen throws of a coin: all alike once in 3e4.
        assert!(on_left > 0 && on_right > 0, "{on_left} {on_right}");
        let found = &table(folder.path(), "objects.csv")[0];
        assert_eq!(found["model"], "rock-wall");
        assert_eq!((found["models_agree"].as_str(), found["p_lean"].as_str()), ("", "0"));
        assert!(found["why"].contains("its pads are not followed"), "{}", found["why"]);
        let speed: f64 = found["wall_speed_m_s_median"].parse().unwrap();
        let (slow, fast) = (left.1.min(right.1), left.1.max(right.1));
        assert!(speed > 0.0 && speed >= slow * (1.0 - 1e-7) && speed <= fast * (1.0 + 1e-7), "{slow} {speed} {fast}");
        assert!(found["wall_acceleration_g_median"].parse::<f64>().unwrap() > 0.0);
    }
}

/// Out of reach, and where the study ignores walls, an object has the bytes of one without a wall.
#[test]
fn a_wall_out_of_reach_is_no_wall() {
    let objects = |settings: &str, walls: &str| {
        let folder = tempfile::tempdir().unwrap();
        assess(folder.path(), settings, HEADER, &format!("a,0,1800,300,700,100,4000,5,{walls}\n"));
        let files = ["objects.csv", "outcomes.csv"].map(|name| fs::read(folder.path().join("out").join(name)).unwrap());
        (files, table(folder.path(), "objects.csv")[0]["model"].clone())
    };
    let free = objects("", ",,,");
    assert_eq!(free.1, "compliant");
    assert_eq!(objects("", "1900,2500,,"), free);
    assert_eq!(objects("walls = \"ignore\"\n", "0,0,,2000"), free);
    assert_ne!(objects("", "0,0,,2000"), free);
}

/// Between two neighbours that it touches an object never moves; one that is wide enough not to rock
/// the other way stands in every world. Leaning counts as falling, and is counted apart.
#[test]
fn bounds_of_a_touching_wall_and_of_one_to_lean_on() {
    let folder = tempfile::tempdir().unwrap();
    let rows = "held,0,1800,900,200,,,,,0,,\nalone,0,1800,900,200,,,,,,,\nleans,0,1800,900,120,,,,,150,0,\n";
    assess(folder.path(), "", HEADER, rows);
    let found: HashMap<String, HashMap<String, String>> =
        table(folder.path(), "objects.csv").into_iter().map(|row| (row["id"].clone(), row)).collect();
    let number = |id: &str, name: &str| found[id][name].parse::<f64>().unwrap();
    assert_eq!((number("held", "uplift_share"), number("held", "p_overturn")), (0.0, 0.0));
    assert_eq!(number("alone", "p_overturn"), 1.0);
    // Its balance point is at tan θ = 120/1800, half way to the neighbours.
    assert_eq!((number("leans", "p_overturn"), number("leans", "p_lean")), (1.0, 1.0));
    assert_eq!(found["leans"]["decision"], "restrain");
    let worlds = &found["leans"]["worlds"];
    let said = format!("leaning on its wall in {worlds} of {worlds} worlds");
    assert!(found["leans"]["why"].contains(&said), "{}", found["leans"]["why"]);
    assert_eq!(found["alone"]["p_lean"], "");
}

/// The travel is that of the solver for sliding, and a stop overturns what reaches it faster than its
/// trip speed; without a stop nothing overturns.
#[test]
fn what_rolls_travels_as_the_sliding_block() {
    const G0_M_S2: f64 = 9.80665;
    let header = "id,level_ratio,height [mm],thickness [mm],mass [kg],tolerance [g],casters,rolling_resistance,clearance \
                  [mm],wall_stiffness [N/mm]\n";
    let rows = "free,0,1800,300,,,free,,,\nstopped,0,1800,300,,,free,0.03,100,\nwide,0,1000,950,,,free,0.03,100,\nfar,0,1800,\
                300,80,5,free,0.03,9000,\nsoft,0,1000,950,80,5,free,0.03,100,20\n";
    let folder = tempfile::tempdir().unwrap();
    assess(folder.path(), "", header, rows);
    let found: HashMap<String, HashMap<String, String>> =
        table(folder.path(), "objects.csv").into_iter().map(|row| (row["id"].clone(), row)).collect();
    let number = |id: &str, name: &str| found[id][name].parse::<f64>().unwrap();
    let motion = pulse();
    let slid = |ratio: f64, clearance_m: Option<f64>| {
        let clearance = Clearance { left_m: clearance_m, right_m: clearance_m };
        let until = Until::Settled { at_most_s: 120.0 };
        let options = SlidingOptions { clearance, until, ..SlidingOptions::new(Friction::uniform(ratio).unwrap()) };
        slide(Base { horizontal: Some(&motion), vertical: None }, &options).unwrap()
    };
    // The table has at least nine digits.
    let is = |got: f64, expected: f64| (got - expected).abs() <= 1e-8 * expected;
    let free = slid(0.02, None);
    for name in ["slide_m_median", "slide_m_p84"] {
        assert!(is(number("free", name), free.peak_m.abs()), "{name} {}", free.peak_m);
    }
    assert_eq!((number("free", "p_overturn"), found["free"]["trip_margin"].as_str()), (0.0, ""));
    assert!(found["free"]["why"].starts_with("It rolls: up to "), "{}", found["free"]["why"]);
    let (_, speed_m_s) = slid(0.03, Some(0.1)).contact.unwrap();
    let mut fallen = 0;
    for (id, height_m, thickness_m) in [("stopped", 1.8, 0.3), ("wide", 1.0, 0.95)] {
        let trip_m_s = trip_speed_m_s(&Block::uniform(height_m, thickness_m).unwrap(), G0_M_S2);
        assert!(is(number(id, "trip_margin"), trip_m_s / speed_m_s.abs()), "{id}: {trip_m_s} {speed_m_s}");
        let falls = speed_m_s.abs() >= trip_m_s;
        assert_eq!(number(id, "p_overturn"), f64::from(u8::from(falls)), "{id}");
        fallen += u32::from(falls);
    }
    assert_eq!(fallen, 1, "one is to fall and one to stand");
    assert!(found.values().all(|row| row["model"] == "roll" && row["sliding"] == "yes"));
    // No more than 0.03 g reaches what nothing stops; the other has v √(k/m).
    assert_eq!(number("far", "p_exceed"), 0.0);
    let shock_g = speed_m_s.abs() * (2e4f64 / 80.0).sqrt() / G0_M_S2;
    assert_eq!(number("soft", "p_exceed"), f64::from(u8::from(shock_g > 5.0)), "{shock_g}");
    assert!(is(number("soft", "demand_capacity_ratio"), shock_g / 5.0), "{shock_g}");
}
