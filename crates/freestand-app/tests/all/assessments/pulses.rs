//! Velocity pulses in the worlds of a study near a fault, on every floor, and what is said of them.

#![expect(
    clippy::unwrap_used,
    clippy::panic,
    reason = "helpers of tests may stop"
)]

use std::sync::Arc;

use freestand::synthesis::{QuickMatcher, SynthesisOptions, with_pulse};
use freestand::worlds::{Component, GroundSpread, Pulses, SpreadOptions, WorldDraw, world_motion};
use freestand_app::job::{Job, assess_into};
use freestand_assess::list::{ListRequest, inventory_of};
use freestand_assess::one_object::{
    Earthquake, Floor, FloorPlace, Object, ObjectRequest, one_object,
};
use freestand_assess::worlds::{Again, FloorOfWorld, Worlds};
use freestand_input::keys::Words;
use freestand_input::quantity::UnitSystem;
use freestand_report::object::object_report;
use freestand_study::resolve::resolve;
use freestand_study::run::no_progress;
use freestand_study::study::{Ground, Study, SyntheticGround};

fn study(fault: &str) -> Study {
    let text = format!(
        "[ground]\ncode = \"eurocode8\"\nspectrum_type = 1\nsite = \"B\"\nground_acceleration = \"0.4 g\"\n{fault}\n\
         [building]\nstoreys = 5\n[worlds]\nmost = 20\nshares = false\n"
    );
    resolve(&text, None, "".as_ref()).unwrap()
}

const NEAR: &str = "fault_distance = \"2 km\"\nfault_magnitude = 7";

fn synthetic(study: &Study) -> &SyntheticGround {
    let Ground::Synthetic(ground) = &study.ground else {
        panic!("a spectrum gives synthetic motions");
    };
    ground
}

fn ground(worlds: &Worlds, world: u32) -> [Vec<f64>; 2] {
    let ground = worlds.ground(world, 0).unwrap().unwrap();
    let across = ground.motion.across.as_ref().unwrap();
    [&ground.motion.along, across].map(|motion| motion.accel_m_s2().to_vec())
}

/// Without a fault, and from 50 km on, a world is the motion that its spectrum gives, to the bit.
#[test]
fn without_a_fault_no_world_changes() {
    for fault in [
        "",
        "fault_distance = \"50 km\"",
        "fault_distance = \"900 km\"\nfault_magnitude = 8",
    ] {
        let study = study(fault);
        let worlds = Worlds::new(&study, || Ok(())).unwrap();
        let ground_of = synthetic(&study);
        let matcher = QuickMatcher::new(&SynthesisOptions::default()).unwrap();
        let spread = GroundSpread::new(SpreadOptions::default()).unwrap();
        for world in 0..2 {
            let spectra = spread.spectra(ground_of.seed, world, 0);
            let plain = [Component::X, Component::Y].map(|component| {
                let target = |t: f64| ground_of.target.spectrum.sa_g(t);
                let key = WorldDraw {
                    seed: ground_of.seed,
                    world,
                    repetition: 0,
                };
                let made = world_motion(target, &spectra, component, key, &matcher).unwrap();
                made.accel_m_s2().to_vec()
            });
            assert_eq!(ground(&worlds, world), plain, "{fault}");
            assert_eq!(worlds.pulse(world).unwrap(), None);
        }
    }
}

/// Each component of a world with a pulse is the motion of its target and its part of the pulse; a world without one has
/// the lower spectrum of such worlds.
#[test]
fn a_fault_brings_its_pulses_to_every_floor() {
    let (near, far) = (study(NEAR), study(""));
    let (worlds, away) = (
        Worlds::new(&near, || Ok(())).unwrap(),
        Worlds::new(&far, || Ok(())).unwrap(),
    );
    let has: Vec<u32> = (0..40)
        .filter(|world| worlds.pulse(*world).unwrap().is_some())
        .collect();
    // 0.52 of 40: 21 ± 3.2; four standard deviations.
    assert!((8..34).contains(&has.len()), "{has:?}");
    let world = has[0];
    let (pulse, amplitude_m_s) = worlds.pulse(world).unwrap().unwrap();
    let ground_of = synthetic(&near);
    let target = |t: f64| ground_of.target.spectrum.sa_g(t);
    let pulses = Pulses::new(ground_of.near_fault.unwrap(), target)
        .unwrap()
        .unwrap();
    let spread = GroundSpread::new(SpreadOptions::default()).unwrap();
    let spectra = spread.spectra(ground_of.seed, world, 0);
    let matcher = QuickMatcher::new(&SynthesisOptions::default()).unwrap();
    for (component, found) in [Component::X, Component::Y]
        .into_iter()
        .zip(ground(&worlds, world))
    {
        let lowered = |t: f64| pulses.under_sa_g(Some(&pulse), t, target(t));
        let key = WorldDraw {
            seed: ground_of.seed,
            world,
            repetition: 0,
        };
        let under = world_motion(lowered, &spectra, component, key, &matcher).unwrap();
        let still = under.scaled(0.0).unwrap();
        let along = amplitude_m_s * pulse.part(component);
        let added = with_pulse(&still, &pulse.shape, along, matcher.options()).unwrap();
        for ((found, under), added) in found.iter().zip(under.accel_m_s2()).zip(added.accel_m_s2())
        {
            // Rounding of sums of some m/s².
            assert!(
                (found - under - added).abs() < 1e-12,
                "{found} {under} {added}"
            );
        }
    }
    let world = (0..40).find(|world| !has.contains(world)).unwrap();
    let spectra = spread.spectra(ground_of.seed, world, 0);
    let lower = |t: f64| pulses.under_sa_g(None, t, target(t));
    assert!(lower(3.0) < 0.95 * target(3.0));
    let key = WorldDraw {
        seed: ground_of.seed,
        world,
        repetition: 0,
    };
    let without = world_motion(lower, &spectra, Component::X, key, &matcher).unwrap();
    assert_eq!(ground(&worlds, world)[0], without.accel_m_s2());
    // The floors: what moves the ground moves the roof.
    let world = has[0];
    let roof = |worlds: &Worlds| worlds.floor(world, 1.0).unwrap().pfv_m_s();
    assert!(
        roof(&worlds) > roof(&away),
        "{} {}",
        roof(&worlds),
        roof(&away)
    );
}

#[test]
fn the_threads_change_nothing() {
    let floors = |threads: usize| -> Vec<Vec<Arc<FloorOfWorld>>> {
        let study = study(NEAR);
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        let worlds = Worlds::new(&study, || Ok(())).unwrap();
        pool.install(|| worlds.floors(0..6, &[0.0, 1.0], Again::default(), None, || Ok(())))
            .unwrap()
    };
    let (one, three) = (floors(1), floors(3));
    for (one, three) in one.iter().flatten().zip(three.iter().flatten()) {
        assert_eq!(one.motion, three.motion);
    }
}

/// What `assess` says and writes, and what `object` says.
#[test]
fn what_is_said_of_a_fault() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("list.csv");
    std::fs::write(
        &path,
        "id,level_ratio,height [mm],thickness [mm]\na,0,1500,300\n",
    )
    .unwrap();
    let said = |fault: &str| -> (Vec<String>, usize) {
        let study = study(fault);
        let inventory = inventory_of(&study, Some(&path), &ListRequest::default()).unwrap();
        let out = folder.path().join(format!("out{}", fault.len()));
        let report = assess_into(&study, &inventory, &out, &Job::default(), &no_progress).unwrap();
        let assumptions = report
            .assumptions
            .iter()
            .filter(|one| one.contains("pulse"));
        let assumptions = assumptions.cloned().collect();
        let mut rows = csv::Reader::from_path(out.join("worlds.csv")).unwrap();
        let place = rows
            .headers()
            .unwrap()
            .iter()
            .position(|name| name == "pulse_velocity_m_s")
            .unwrap();
        let pulses = rows
            .records()
            .filter(|row| !row.as_ref().unwrap()[place].is_empty())
            .count();
        (assumptions, pulses)
    };
    assert_eq!(said(""), (vec![], 0));
    let (assumptions, pulses) = said(NEAR);
    assert_eq!(
        assumptions,
        [
            "Assumed: 52 % of the worlds have a velocity pulse: the earthquake is on a fault 2 km away, and its magnitude is 7."
        ]
    );
    assert!(pulses > 0 && pulses < 20, "{pulses}");
    let (assumptions, pulses) = said("fault_distance = \"60 km\"");
    assert!(assumptions[0].contains("no world has a velocity pulse: the fault is 60 km away"));
    assert_eq!(pulses, 0);

    let of_object = |words: &[(&'static str, &str)]| -> Vec<String> {
        let request = ObjectRequest {
            object: Object::of_size(1.5, 0.3),
            earthquake: Earthquake::Place(words.iter().copied().collect::<Words>()),
            floor: Floor {
                place: FloorPlace::Ground,
                storeys: None,
                storey_height_m: None,
            },
            worlds: Some(3),
            seed: None,
            units: UnitSystem::Si,
        };
        let report =
            serde_json::to_value(object_report(one_object(&request, &|| false).unwrap())).unwrap();
        let all = report["assumptions"].as_array().unwrap().iter();
        let all = all.map(|one| one.as_str().unwrap().to_owned());
        all.filter(|one| one.contains("pulse")).collect()
    };
    assert_eq!(of_object(&[("place", "Athens")]), Vec::<String>::new());
    assert_eq!(
        of_object(&[("place", "Athens"), ("fault_distance", "5 km")]),
        [
            "33 % of the worlds have a velocity pulse: the earthquake is on a fault 5 km away, and its magnitude is from 6.5 to 7, because none was given"
        ]
    );
}
