//! Walls, neighbours and free casters of a list, against the solvers on the same motion.

#![expect(clippy::unwrap_used, reason = "helpers of tests may stop")]

use std::collections::HashMap;
use std::fs;
use std::path::Path;

use freestand::block::Block;
use freestand::compliant::{CompliantAccuracy, CompliantBase, CompliantOptions, rock_compliant};
use freestand::cushion::{ContactLaw, Cushion};
use freestand::motion::Motion;
use freestand::rocking::{Base, RockingOptions, Until, rock};
use freestand::sliding::{Clearance, Friction, Sliding, SlidingOptions, slide, trip_speed_m_s};
use freestand::wall::{Wall, Walls};
use freestand_app::job::{Job, assess_into};
use freestand_assess::list::{ListRequest, inventory_of};
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
        if i <= 100 {
            peak_m_s2 * (std::f64::consts::TAU * i as f64 / 100.0).sin()
        } else {
            0.0
        }
    };
    Motion::new(0.01, (0..400).map(sample).collect()).unwrap()
}

/// Every world has the same floor and the same object; only the side of the wall is drawn.
fn assess(folder: &Path, settings: &str, header: &str, rows: &str) {
    let motion = pulse();
    let lines: String = motion
        .accel_m_s2()
        .iter()
        .enumerate()
        .map(|(i, a)| format!("{},{a}\n", i as f64 * motion.dt_s()))
        .collect();
    fs::write(
        folder.join("pulse.csv"),
        format!("time_s,accel_m_s2\n{lines}"),
    )
    .unwrap();
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
        "[ground]\nmotions = [\"pulse.csv\"]\n[building]\nstoreys = 4\nperiod = \"0.5 s\"\n[worlds]\nfirst = \
         {WORLDS}\nmost = {WORLDS}\nperiod_spread = 0\ndamping_spread = 0\nshares = false\n[assessment]\n{settings}{}",
        none.concat()
    );
    assess_list(folder, &text, &format!("{header}{rows}"));
}

/// A list on the floors of a study.
fn assess_list(folder: &Path, study: &str, lines: &str) {
    let study = resolve(study, None, folder).unwrap();
    let list = folder.join("list.csv");
    fs::write(&list, lines).unwrap();
    let inventory = inventory_of(&study, Some(&list), &ListRequest::default()).unwrap();
    assert!(!inventory.has_errors(), "{:?}", inventory.findings);
    let job = Job {
        outcomes: true,
        ..Job::default()
    };
    assess_into(&study, &inventory, &folder.join("out"), &job, &no_progress).unwrap();
}

/// The rows of a table, each by the names of its columns.
fn table(folder: &Path, name: &str) -> Vec<HashMap<String, String>> {
    let mut reader = csv::Reader::from_path(folder.join("out").join(name)).unwrap();
    reader.deserialize().map(|row| row.unwrap()).collect()
}

/// Every object by its id.
fn by_id(folder: &Path) -> HashMap<String, HashMap<String, String>> {
    table(folder, "objects.csv")
        .into_iter()
        .map(|row| (row["id"].clone(), row))
        .collect()
}

/// What slides under the pulse with this friction, up to stops at this distance.
fn slid(friction_ratio: f64, clearance_m: Option<f64>) -> Sliding {
    let motion = pulse();
    let clearance = Clearance {
        left_m: clearance_m,
        right_m: clearance_m,
    };
    let until = Until::Settled { at_most_s: 120.0 };
    let friction = Friction::uniform(friction_ratio).unwrap();
    let options = SlidingOptions {
        clearance,
        until,
        ..SlidingOptions::new(friction)
    };
    slide(
        Base {
            horizontal: Some(&motion),
            vertical: None,
        },
        &options,
    )
    .unwrap()
}

/// Whether a number of a table is that of the solver: the table has at least nine digits.
fn is(got: f64, expected: f64) -> bool {
    (got - expected).abs() <= 1e-8 * expected
}

fn with_wall(block: &Block, walls: Walls) -> (f64, f64) {
    let motion = pulse();
    let base = Base {
        horizontal: Some(&motion),
        vertical: None,
    };
    let options = RockingOptions {
        walls,
        until: Until::Settled { at_most_s: 60.0 },
        ..RockingOptions::default()
    };
    let found = rock(block, base, &options).unwrap();
    let fastest = found
        .wall_impacts
        .iter()
        .map(|one| one.omega_before_rad_s.abs())
        .fold(0.0, f64::max);
    let lever_m = found
        .contacts
        .iter()
        .flatten()
        .map(|contact| contact.lever_m)
        .fold(0.0, f64::max);
    (found.uplift_m, fastest * lever_m)
}

/// The wall stands on the left in some worlds and on the right in the others, and each world is the
/// history of the solver: for a wall that touches, one of the two never lifts before the motion
/// turns.
#[test]
fn every_world_is_a_history_beside_its_wall() {
    for gap_m in [0.0, 0.02] {
        let folder = tempfile::tempdir().unwrap();
        assess(
            folder.path(),
            "",
            HEADER,
            &format!("a,0,1800,600,,100,4000,5,{},,0.3,2000\n", 1e3 * gap_m),
        );
        let block = Block::uniform(1.8, 0.6).unwrap();
        let wall = Some(Wall {
            restitution_ratio: 0.3,
            ..Wall::at(gap_m)
        });
        let left = with_wall(
            &block,
            Walls {
                left: wall,
                right: None,
            },
        );
        let right = with_wall(
            &block,
            Walls {
                left: None,
                right: wall,
            },
        );
        assert!(
            (left.0 - right.0).abs() > 1e-3,
            "{left:?} {right:?}: the sides must differ"
        );
        let rows = table(folder.path(), "outcomes.csv");
        assert!(
            rows.iter().all(|row| row["model"] == "rigid"),
            "its pads are not asked"
        );
        let lifts: Vec<f64> = rows
            .iter()
            .map(|row| row["lift_m"].parse().unwrap())
            .collect();
        // The kernel for many blocks gives the scalar answers to 1e-8.
        let is = |lift_m: f64, one: f64| (lift_m - one).abs() <= 1e-8 + 1e-7 * one;
        let on_left = lifts.iter().filter(|lift_m| is(**lift_m, left.0)).count();
        let on_right = lifts.iter().filter(|lift_m| is(**lift_m, right.0)).count();
        assert_eq!(
            on_left + on_right,
            rows.len(),
            "{lifts:?} {left:?} {right:?}"
        );
        // Sixteen throws of a coin: all alike once in 3e4.
        assert!(on_left > 0 && on_right > 0, "{on_left} {on_right}");
        let found = &table(folder.path(), "objects.csv")[0];
        assert_eq!(found["model"], "rock-wall");
        assert_eq!(
            (found["models_agree"].as_str(), found["p_lean"].as_str()),
            ("", "0")
        );
        assert!(
            found["why"].contains("its pads are not followed"),
            "{}",
            found["why"]
        );
        let speed: f64 = found["wall_speed_m_s_median"].parse().unwrap();
        let (slow, fast) = (left.1.min(right.1), left.1.max(right.1));
        assert!(
            speed > 0.0 && speed >= slow * (1.0 - 1e-7) && speed <= fast * (1.0 + 1e-7),
            "{slow} {speed} {fast}"
        );
        assert!(found["wall_acceleration_g_median"].parse::<f64>().unwrap() > 0.0);
    }
}

/// The columns that say which cells of a row are empty.
const ASSUMED: [&str; 2] = ["assumed", "assumed_count"];

/// Out of reach, and where the study ignores walls, an object has the results of one without a wall; only
/// what was assumed differs.
#[test]
fn a_wall_out_of_reach_is_no_wall() {
    let objects = |settings: &str, walls: &str| {
        let folder = tempfile::tempdir().unwrap();
        assess(
            folder.path(),
            settings,
            HEADER,
            &format!("a,0,1800,300,700,100,4000,5,{walls}\n"),
        );
        let mut object = table(folder.path(), "objects.csv").remove(0);
        object.retain(|name, _| !ASSUMED.contains(&name.as_str()));
        (
            object,
            fs::read(folder.path().join("out/outcomes.csv")).unwrap(),
        )
    };
    let free = objects("", ",,,");
    assert_eq!(free.0["model"], "compliant");
    // Where the list says nothing of a wall, it is tried what one would change; no world is another.
    let ignored = objects("walls = \"ignore\"\n", ",,,");
    assert_eq!(ignored.1, free.1);
    assert_eq!(objects("", "1900,2500,,"), ignored);
    assert_eq!(objects("walls = \"ignore\"\n", "0,0,,2000"), ignored);
    assert_ne!(objects("", "0,0,,2000"), free);
}

/// Between two neighbours that it touches an object never moves; one that is wide enough not to rock
/// the other way stands in every world. Leaning counts as falling, and is counted apart.
#[test]
fn bounds_of_a_touching_wall_and_of_one_to_lean_on() {
    let folder = tempfile::tempdir().unwrap();
    let rows = "held,0,1800,900,200,,,,,0,,\nalone,0,1800,900,200,,,,,,,\nleans,0,1800,900,120,,,,,150,0,\n";
    assess(folder.path(), "", HEADER, rows);
    let found = by_id(folder.path());
    let number = |id: &str, name: &str| found[id][name].parse::<f64>().unwrap();
    assert_eq!(
        (number("held", "uplift_share"), number("held", "p_overturn")),
        (0.0, 0.0)
    );
    assert_eq!(number("alone", "p_overturn"), 1.0);
    // Its balance point is at tan θ = 120/1800, half way to the neighbours.
    assert_eq!(
        (number("leans", "p_overturn"), number("leans", "p_lean")),
        (1.0, 1.0)
    );
    assert_eq!(found["leans"]["decision"], "restrain");
    let worlds = &found["leans"]["worlds"];
    let said = format!("leaning on its wall in {worlds} of {worlds} worlds");
    assert!(
        found["leans"]["why"].contains(&said),
        "{}",
        found["leans"]["why"]
    );
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
    let found = by_id(folder.path());
    let number = |id: &str, name: &str| found[id][name].parse::<f64>().unwrap();
    let free = slid(0.02, None);
    for name in ["slide_m_median", "slide_m_p84"] {
        assert!(
            is(number("free", name), free.peak_m.abs()),
            "{name} {}",
            free.peak_m
        );
    }
    assert_eq!(
        (
            number("free", "p_overturn"),
            found["free"]["trip_margin"].as_str()
        ),
        (0.0, "")
    );
    assert!(
        found["free"]["why"].starts_with("It rolls: up to "),
        "{}",
        found["free"]["why"]
    );
    let (_, speed_m_s) = slid(0.03, Some(0.1)).contact.unwrap();
    let mut fallen = 0;
    for (id, height_m, thickness_m) in [("stopped", 1.8, 0.3), ("wide", 1.0, 0.95)] {
        let trip_m_s = trip_speed_m_s(&Block::uniform(height_m, thickness_m).unwrap(), G0_M_S2);
        assert!(
            is(number(id, "trip_margin"), trip_m_s / speed_m_s.abs()),
            "{id}: {trip_m_s} {speed_m_s}"
        );
        let falls = speed_m_s.abs() >= trip_m_s;
        assert_eq!(number(id, "p_overturn"), f64::from(u8::from(falls)), "{id}");
        fallen += u32::from(falls);
    }
    assert_eq!(fallen, 1, "one is to fall and one to stand");
    assert!(
        found
            .values()
            .all(|row| row["model"] == "roll" && row["sliding"] == "yes")
    );
    // No more than 0.03 g reaches what nothing stops; the other has v √(k/m).
    assert_eq!(number("far", "p_exceed"), 0.0);
    let shock_g = speed_m_s.abs() * (2e4f64 / 80.0).sqrt() / G0_M_S2;
    assert_eq!(
        number("soft", "p_exceed"),
        f64::from(u8::from(shock_g > 5.0)),
        "{shock_g}"
    );
    assert!(
        is(number("soft", "demand_capacity_ratio"), shock_g / 5.0),
        "{shock_g}"
    );
}

/// Free casters in Christchurch, on the ground: what has no room is locked where it stands locked, and
/// tethered or restrained where it would then fall. Room enough, or a slide that goes no farther than
/// 50 mm, is no task.
#[test]
#[ignore = "a quarter of a minute: several lists"]
fn what_lacks_room_is_locked_only_where_it_stands_locked() {
    let rows = [
        ("incubator,0,1350,600,1100,120,free,,", "lock"),
        ("roomy,0,1350,600,1100,120,free,9000,", "leave"),
        ("tight,0,1350,600,1100,120,free,100,", "lock"),
        ("tall,0,2000,300,400,40,free,,", "restrain"),
        ("slider,0,600,800,900,50,,,0.1", "lock"),
        ("crate,0,600,800,900,50,,,0.3", "leave"),
        ("still,0,600,800,900,50,,,", "leave"),
    ];
    let header = "id,level_ratio,height [mm],thickness [mm],width [mm],mass [kg],casters,clearance [mm],friction\n";
    let lines: String = rows.iter().map(|(row, _)| format!("{row}\n")).collect();
    let text = "[ground]\nplace = \"Christchurch\"\n[building]\nstoreys = 3\n";
    let folder = tempfile::tempdir().unwrap();
    assess_list(folder.path(), text, &format!("{header}{lines}"));
    let found = by_id(folder.path());
    for (row, decision) in rows {
        let id = row.split(',').next().unwrap();
        assert_eq!(
            found[id]["decision"], decision,
            "{id}: {}",
            found[id]["why"]
        );
    }
    let number = |id: &str, name: &str| found[id][name].parse::<f64>().unwrap();
    // More than 84 % of its earthquakes need, and the stated 100 mm of the one is less, the 9 m of the
    // other more.
    assert!(number("incubator", "clearance_needed_m") > number("incubator", "slide_m_p84"));
    assert!(
        number("tight", "clearance_needed_m") > 0.1 && number("roomy", "clearance_needed_m") < 9.0
    );
    assert!(
        number("crate", "clearance_needed_m") < 0.05
            && number("slider", "clearance_needed_m") > 0.05
    );
    assert!(
        number("incubator", "p_overturn_locked_high") < 0.1
            && number("tall", "p_overturn_locked") > 0.1
    );
    assert_eq!(
        (
            found["roomy"]["p_overturn_locked"].as_str(),
            found["still"]["clearance_needed_m"].as_str()
        ),
        ("", "")
    );
    let tasks: Vec<(String, String)> = table(folder.path(), "worklist.csv")
        .into_iter()
        .map(|row| (row["id"].clone(), row["action"].clone()))
        .collect();
    for (id, action) in [
        ("incubator", "lock"),
        ("tight", "lock"),
        ("slider", "lock"),
        ("tall", "restrain"),
    ] {
        assert!(
            tasks.contains(&(id.to_owned(), action.to_owned())),
            "{tasks:?}"
        );
    }
    assert_eq!(tasks.len(), 4);
}

const WITH_FRICTION: &str = "id,level_ratio,height [mm],thickness [mm],mass [kg],stiffness [N/mm],tolerance [g],friction,clearance [mm]\n";

/// Up to t/h an object slides, as far as the solver says, and nothing but a stop overturns it; above
/// t/h it does not.
#[test]
fn what_has_little_friction_slides() {
    let folder = tempfile::tempdir().unwrap();
    let rows = "free,0,1800,540,100,4000,5,0.29,\nstopped,0,1800,380,,,,0.2,20\nrange,0,1800,540,,,,0.1-0.29,\n\
                rough,0,1800,540,,,,0.1-0.31,\n";
    assess(folder.path(), "", WITH_FRICTION, rows);
    let found = by_id(folder.path());
    let number = |id: &str, name: &str| found[id][name].parse::<f64>().unwrap();
    let free = slid(0.29, None).peak_m.abs();
    assert!(
        free > 0.01
            && is(number("free", "slide_m_median"), free)
            && is(number("free", "slide_m_p84"), free)
    );
    assert_eq!(
        (
            number("free", "p_overturn"),
            found["free"]["p_overturn_compliant"].as_str()
        ),
        (0.0, "")
    );
    assert!(
        found["free"]["why"].starts_with("It slides: up to "),
        "{}",
        found["free"]["why"]
    );
    let (_, speed_m_s) = slid(0.2, Some(0.02)).contact.unwrap();
    let trip_m_s = trip_speed_m_s(&Block::uniform(1.8, 0.38).unwrap(), 9.80665);
    assert!(
        is(number("stopped", "trip_margin"), trip_m_s / speed_m_s.abs()),
        "{trip_m_s} {speed_m_s}"
    );
    // A friction between the two slides further than the largest and less far than the smallest.
    let (least, most) = (slid(0.29, None).peak_m.abs(), slid(0.1, None).peak_m.abs());
    let travel = number("range", "slide_m_median");
    assert!(least < travel && travel < most, "{least} {travel} {most}");
    for id in ["free", "stopped", "range"] {
        assert_eq!(
            (found[id]["model"].as_str(), found[id]["sliding"].as_str()),
            ("slide", "yes"),
            "{id}"
        );
    }
    assert_eq!(
        (
            found["rough"]["model"].as_str(),
            found["rough"]["slide_m_median"].as_str()
        ),
        ("rock", "")
    );
}

/// Friction above what rocking needs changes nothing but the columns of friction. Below it, its pads
/// answer with that friction for both models; without pads the planar answer stands, and the notes say
/// by how much it may be wrong.
#[test]
fn friction_that_rocking_lacks_is_followed_on_pads() {
    let object = |body: &str, friction: &str| {
        let folder = tempfile::tempdir().unwrap();
        assess(
            folder.path(),
            "",
            WITH_FRICTION,
            &format!("a,0,1800,700,{body},{friction},\n"),
        );
        let mut found = by_id(folder.path()).remove("a").unwrap();
        found.retain(|name, _| !ASSUMED.contains(&name.as_str()));
        let said = ["friction_low_ratio", "friction_high_ratio", "sliding"]
            .map(|name| found.remove(name).unwrap());
        (found, said[2].clone(), table(folder.path(), "outcomes.csv"))
    };
    let pads = "100,4000,5";
    let (given, ..) = object(pads, "");
    assert_eq!(given["uplift_share"], "1");
    let (enough, slides, _) = object(pads, "0.95");
    assert_eq!((enough, slides.as_str()), (given.clone(), "no"));
    let (little, slides, outcomes) = object(pads, "0.4");
    assert_eq!(
        (slides.as_str(), little["model"].as_str()),
        ("yes", "compliant")
    );
    assert!(
        little["why"].contains("its friction (0.4) is less than rocking needs"),
        "{little:?}"
    );
    let of = |model: &str| {
        outcomes
            .iter()
            .filter(|row| row["model"] == model)
            .collect::<Vec<_>>()
    };
    let (rigid, on_pads) = (of("rigid"), of("compliant"));
    assert!(!rigid.is_empty() && rigid.len() == on_pads.len());
    assert!(
        rigid
            .iter()
            .zip(&on_pads)
            .all(|(rigid, pads)| rigid["lift_m"] == pads["lift_m"])
    );
    // Its pads have one damping in each world: the history is the solver's.
    let number = |name: &str| on_pads[0][name].parse::<f64>().unwrap();
    let (mass_kg, stiffness_n_m) = (number("mass_kg"), number("stiffness_n_m"));
    let damping_n_s_m = 2.0 * number("pad_damping_ratio") * (stiffness_n_m * mass_kg).sqrt();
    let cushion = Cushion::new(ContactLaw::KelvinVoigt {
        stiffness_n_m,
        damping_n_s_m,
    })
    .unwrap();
    let (block, motion) = (Block::uniform(1.8, 0.7).unwrap(), pulse());
    let alone = |friction_ratio: Option<f64>| {
        let base = CompliantBase {
            friction_ratio,
            ..CompliantBase::new(mass_kg, cushion.clone())
        };
        let options = CompliantOptions {
            accuracy: CompliantAccuracy::Fast,
            ..CompliantOptions::default()
        };
        rock_compliant(
            &block,
            &base,
            Base {
                horizontal: Some(&motion),
                vertical: None,
            },
            &options,
        )
        .unwrap()
    };
    let (slipping, held) = (alone(Some(0.4)), alone(None));
    let away = |uplift_m: f64| (number("lift_m") / uplift_m - 1.0).abs();
    // The damping has the digits of the table, and the motion ends 4 s after the start and not with the
    // building's tail: neither moves the largest uplift by more than the tolerance of a step at `fast`.
    assert!(
        slipping.slid_m > 1e-3 && away(slipping.uplift_m) < 1e-4,
        "{} {}",
        slipping.slid_m,
        away(slipping.uplift_m)
    );
    assert!(
        away(held.uplift_m) > 0.01,
        "{} {}",
        held.uplift_m,
        slipping.uplift_m
    );
    let (bare, slides, _) = object(",,", "0.4");
    let (bare_given, ..) = object(",,", "");
    assert_eq!(
        (bare["p_overturn"].clone(), slides.as_str()),
        (bare_given["p_overturn"].clone(), "yes")
    );
    assert!(
        bare["remarks"].contains("0.8 times") && bare["remarks"].contains("1.05 times"),
        "{}",
        bare["remarks"]
    );
    assert!(!bare_given["remarks"].contains("0.8 times"));
}

/// What falls and has no wall in the list lives through the same worlds with one, as an object that has
/// it in the list.
#[test]
fn a_wall_that_is_not_listed_is_tried() {
    let folder = tempfile::tempdir().unwrap();
    let header = "id,level_ratio,height [mm],thickness [mm],wall_gap [mm]\n";
    let rows = "alone,0,1800,200,\nlisted,0,1800,200,50\n";
    assess(folder.path(), "", header, rows);
    let found = by_id(folder.path());
    let number = |id: &str, name: &str| found[id][name].parse::<f64>().unwrap();
    let block = Block::uniform(1.8, 0.2).unwrap();
    assert_eq!(
        (
            found["alone"]["decision"].as_str(),
            number("alone", "p_overturn")
        ),
        ("restrain", 1.0)
    );
    // At a wall that it touches, it falls or leans in all worlds with one sign of the motion, or in none.
    let falls = |wall: Walls| {
        let motion = pulse();
        let options = RockingOptions {
            walls: wall,
            until: Until::Settled { at_most_s: 60.0 },
            ..RockingOptions::default()
        };
        rock(
            &block,
            Base {
                horizontal: Some(&motion),
                vertical: None,
            },
            &options,
        )
        .unwrap()
        .outcome
        .has_fallen()
    };
    let touching = Some(Wall {
        restitution_ratio: 0.25,
        ..Wall::at(0.0)
    });
    let [left, right] = [
        Walls {
            left: touching,
            right: None,
        },
        Walls {
            left: None,
            right: touching,
        },
    ]
    .map(falls);
    let p = number("alone", "p_overturn_wall_touching");
    assert!(
        if left == right {
            p == f64::from(u8::from(left))
        } else {
            p > 0.0 && p < 1.0
        },
        "{left} {right} {p}"
    );
    assert!(
        found["alone"]["why"].contains("The list gives no wall behind it"),
        "{}",
        found["alone"]["why"]
    );
    assert_eq!(found["listed"]["p_overturn_wall_touching"], "");
}

/// What touches a wall and would be left by its planar calculation alone is left only where it also stays on a stiff
/// floor in three dimensions: of these two, which fall in at most one of 20 worlds in the plane, the wider one does.
#[test]
fn a_touching_wall_needs_the_stiff_floor_too() {
    let folder = tempfile::tempdir().unwrap();
    let text = "[ground]\nhazard_factor = 0.2\n[building]\nstoreys = 4\n[worlds]\nfirst = 20\nmost = 20\nshares = false\n\
                [assessment]\naccepted = 0.3\n";
    let list = "id,level_ratio,height [mm],thickness [mm],width [mm],wall_gap [mm]\n\
                narrow,0,1800,430,430,0\nwide,0,1800,520,520,0\n";
    assess_list(folder.path(), text, list);
    let found = by_id(folder.path());
    for (id, decision) in [("narrow", "restrain"), ("wide", "leave")] {
        let row = &found[id];
        // The probability is that of the planar calculation: its whole interval is accepted.
        let high: f64 = row["p_overturn_high"].parse().unwrap();
        assert!(high < 0.3, "{id}: {high}");
        assert_eq!(row["decision"], decision, "{id}: {}", row["why"]);
        let is_told = row["why"].contains("in three dimensions on a stiff floor");
        assert_eq!(is_told, decision == "restrain", "{id}: {}", row["why"]);
    }
}

/// Where the floor falls away, an object on pads flies and is followed; without pads that world is not
/// known, and is not counted as one in which it stands.
#[test]
fn what_flies_is_followed_on_its_pads() {
    let folder = tempfile::tempdir().unwrap();
    let text = "[ground]\nhazard_factor = 0.8\nvertical = 1\nseed = 3\n[building]\nstoreys = 4\n[worlds]\nfirst = 4\nmost = 4\nshares = false\n";
    let study = resolve(text, None, folder.path()).unwrap();
    let list = folder.path().join("list.csv");
    let header = "id,level_ratio,height [mm],thickness [mm],mass [kg],stiffness [N/mm]\n";
    fs::write(
        &list,
        format!("{header}pads,0,900,900,100,4000\nbare,0,900,900,,\n"),
    )
    .unwrap();
    let inventory = inventory_of(&study, Some(&list), &ListRequest::default()).unwrap();
    assess_into(
        &study,
        &inventory,
        &folder.path().join("out"),
        &Job::default(),
        &no_progress,
    )
    .unwrap();
    let found = by_id(folder.path());
    assert!(
        found["pads"]["remarks"].contains("it flies: there its pads answer for both models"),
        "{:?}",
        found["pads"]
    );
    assert_eq!(found["pads"]["motions_failed"], "0", "{:?}", found["pads"]);
    let notes = &found["bare"]["remarks"];
    assert!(
        notes.contains("the base falls away") && notes.contains("give its mass and its pads"),
        "{notes}"
    );
    assert_ne!(found["bare"]["decision"], "leave");
}

/// Friction, flight and walls that are tried have the same bytes on any number of threads.
#[test]
fn the_same_bytes_on_one_thread_and_on_three() {
    let rows = "slides,0,1800,540,100,4000,5,0.1-0.29,\nslips,0,1800,700,100,4000,5,0.35-0.5,\nfalls,0,1800,300,,,,,\n";
    let on = |threads: usize| {
        let folder = tempfile::tempdir().unwrap();
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| assess(folder.path(), "", WITH_FRICTION, rows));
        ["objects.csv", "outcomes.csv"]
            .map(|name| fs::read(folder.path().join("out").join(name)).unwrap())
    };
    assert!(on(1) == on(3));
}
