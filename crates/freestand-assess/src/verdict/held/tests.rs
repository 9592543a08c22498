use freestand::block::Block;
use freestand::motion::Motion;
use freestand::respond::RigidPlane;
use freestand_inventory::library::Libraries;
use freestand_inventory::{Inventory, ReadOptions, read_inventory};
use freestand_study::resolve::resolve;
use freestand_study::run::no_progress;

use super::*;

fn study() -> Study {
    let text = "[ground]\ncode = \"nzs1170.5\"\nsite = \"C\"\nhazard_factor = 0.4\n[building]\nstoreys = 5\n\
                [worlds]\nfirst = 20\nmost = 80\nshares = false\n";
    resolve(text, None, "".as_ref()).unwrap()
}

fn list(rows: &str) -> Inventory {
    let head = "id,level_ratio,height [mm],thickness [mm],width [mm],mass [kg],casters\n";
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("list.csv");
    std::fs::write(&path, format!("{head}{rows}")).unwrap();
    let libraries = Libraries::with_files(None, None).unwrap();
    libraries
        .looked_up(|lookup| read_inventory(&path, &ReadOptions::new(lookup)))
        .unwrap()
}

fn at_top(period_s: Option<f64>, median_n: f64) -> Grip {
    Grip {
        period_s,
        at: GripAt::Height(0.9),
        median_n,
        beta: 0.3,
    }
}

/// The instant at which a force first exceeds a capacity, with the motion between its samples on lines, found in steps
/// of a twentieth of a sample.
fn released_at(
    floor: &FloorOfWorld,
    force_n: impl Fn(f64, f64) -> f64,
    capacity_n: f64,
) -> Option<f64> {
    let shaking = floor.shaking();
    let (x, y) = (shaking.x.unwrap(), shaking.y);
    let step_s = x.dt_s() / 20.0;
    let steps = (x.duration_s() / step_s) as usize;
    (0..=steps).map(|i| i as f64 * step_s).find(|&t| {
        let y_m_s2 = y.map_or(0.0, |y| y.at_m_s2(t));
        force_n(x.at_m_s2(t), y_m_s2) > capacity_n
    })
}

/// Housner's block from an instant on, at rest there, by the classical Runge-Kutta method: whether it overturns.
fn overturns(plane: &RigidPlane, motion: &Motion, from_s: f64) -> bool {
    let block: &Block = &plane.plane.block;
    let pivot = block.pivot();
    let alpha = pivot.slenderness_angle_rad;
    let p2 = pivot.frequency_parameter_rad_s(G0_M_S2).powi(2);
    let [e, _] = plane.restitution.ratios(block).unwrap();
    let step_s = motion.dt_s() / 20.0;
    let rate = |t: f64, angle: f64, side: f64| {
        let lean = alpha * side - angle;
        -p2 * (lean.sin() + motion.at_m_s2(t) / G0_M_S2 * lean.cos())
    };
    let (mut t, mut angle, mut omega, mut side) = (from_s, 0.0f64, 0.0f64, 0.0f64);
    let end_s = motion.duration_s() + 20.0;
    while t < end_s {
        if side == 0.0 {
            // It lifts where the floor pulls its foot away.
            let a_m_s2 = motion.at_m_s2(t);
            if a_m_s2.abs() > G0_M_S2 * alpha.tan() {
                side = -a_m_s2.signum();
            }
            t += step_s;
            if side == 0.0 {
                continue;
            }
        }
        let h = step_s;
        let [k1, l1] = [omega, rate(t, angle, side)];
        let [k2, l2] = [
            omega + 0.5 * h * l1,
            rate(t + 0.5 * h, angle + 0.5 * h * k1, side),
        ];
        let [k3, l3] = [
            omega + 0.5 * h * l2,
            rate(t + 0.5 * h, angle + 0.5 * h * k2, side),
        ];
        let [k4, l4] = [omega + h * l3, rate(t + h, angle + h * k3, side)];
        let before = angle;
        angle += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
        omega += h / 6.0 * (l1 + 2.0 * l2 + 2.0 * l3 + l4);
        t += h;
        if angle.abs() > std::f64::consts::FRAC_PI_2 {
            return true;
        }
        if angle * side < 0.0 || (angle == 0.0 && before != 0.0) {
            // An impact: it goes on over the other edge, or rests where hardly anything is left.
            omega *= e;
            angle = 0.0;
            side = if omega.abs() < 1e-4 {
                0.0
            } else {
                omega.signum()
            };
            if side == 0.0 {
                omega = 0.0;
            }
        }
    }
    false
}

/// The effect of a rigid bracket against a simulation of another kind, which holds the object up to the capacity
/// of the world, finds the instant to a twentieth of a sample, and follows the block by Runge-Kutta steps. Of 60 worlds at
/// most three may end otherwise: rocking is sensitive to the half of a sample by which the instants differ.
#[test]
fn a_restraint_holds_up_to_its_capacity() {
    let study = study();
    let inventory = list("shelf,1,2000,420,,120,\n");
    let item = &inventory.items[0];
    let worlds = Worlds::new(&study, || Ok(())).unwrap();
    let never = || false;
    let context = Context::new(&study, worlds, 1, &never);
    let wanted = Wanted {
        item,
        measures: Vec::new(),
    };
    let member = wanted.member(&study).unwrap();
    let trial = Trial::new(&context, &member, member.subject.clone());
    let floors = floors(&context, &[1.0], 0..60, Change::None).unwrap();
    let grip = at_top(None, 1200.0);
    let mut held = HeldWorlds::default();
    let stretch = Stretch {
        first: 0,
        floors: &floors[0],
    };
    held.live_on(&context, &trial, &grip, stretch);
    let (mut released, mut fallen, mut others) = (0, 0, 0);
    for (world, floor) in (0..).zip(&floors[0]) {
        let settings = &study.assessment;
        let draw = draw(settings, &trial.subject, member.key, world, Change::None);
        let one = Drawn {
            subject: &trial.subject,
            draw: &draw,
        };
        let mut random = object_stream(settings.seed, world, member.key, Group::Restraint, 0);
        let capacity_n = lognormal_draw(&mut random, grip.median_n, grip.beta);
        let plane = one.rigid_plane(0).unwrap();
        let block = plane.plane.block;
        let mass_kg = draw.mass_kg(&trial.subject).unwrap();
        let per_m_s2 = mass_kg * block.cg_height_m() / (0.9 * block.height_m());
        let at_s = released_at(floor, |x, y| per_m_s2 * x.hypot(y), capacity_n);
        let motion = floor.base(plane.plane.along).horizontal.unwrap();
        let fell = at_s.is_some_and(|at_s| overturns(&plane, motion, at_s));
        // Between two samples the force of two components is below the larger one.
        assert_eq!(at_s.is_some(), held.released[world as usize], "{world}");
        released += usize::from(at_s.is_some());
        fallen += usize::from(fell);
        others += usize::from(held.fell[0][world as usize] != Some(fell));
    }
    assert!(others <= 3, "{others} of 60 otherwise");
    // The test sees all three: worlds that hold, worlds that are released and stand, and falls.
    assert!(
        released < 60 && fallen > 0 && fallen < released,
        "{released} {fallen}"
    );
}

/// A flexible hold in resonance with its floor: after n cycles the acceleration is a (1 − e^−2πζn)/2ζ, of which ζ² is
/// neglected; its velocity is that over ω, a quarter of a cycle earlier or later.
#[test]
fn a_flexible_hold_is_an_oscillator() {
    let period_s = 0.2;
    let (dt_s, amplitude_m_s2) = (0.001, 1.5);
    let samples = (0..4001).map(|i| amplitude_m_s2 * (TAU / period_s * f64::from(i) * dt_s).sin());
    let motion = Motion::new(dt_s, samples.collect()).unwrap();
    let floor = FloorOfWorld::given(&motion, None);
    let inventory = list("shelf,1,2000,420,,120,\n");
    let settings = study().assessment;
    let subject = Subject::new(&inventory.items[0], &settings).unwrap();
    let draw = draw(&settings, &subject, 1, 0, Change::None).without_factors();
    let hold = Hold::new(&at_top(Some(period_s), 1.0), &draw, &subject, &floor);
    let cycles = 4.0 / period_s;
    let accel_m_s2 =
        amplitude_m_s2 / (2.0 * DAMPING_RATIO) * (1.0 - (-TAU * DAMPING_RATIO * cycles).exp());
    let peak_n = hold.force_n.iter().copied().fold(0.0, f64::max);
    let expected_n = 120.0 * accel_m_s2 * 1.0 / (0.9 * 2.0);
    assert!(
        (peak_n / expected_n - 1.0).abs() < 0.01,
        "{peak_n} {expected_n}"
    );
    let fastest_m_s = hold
        .velocity_m_s
        .iter()
        .map(|one| one[0].abs())
        .fold(0.0, f64::max);
    let expected_m_s = accel_m_s2 * period_s / TAU;
    assert!(
        (fastest_m_s / expected_m_s - 1.0).abs() < 0.01,
        "{fastest_m_s} {expected_m_s}"
    );
    // Its largest force is not where it is fastest.
    let until = hold.until(0.98 * expected_n);
    let [x, y] = until.released.unwrap().velocity_m_s;
    assert!(x.abs() < 0.5 * expected_m_s && x == y, "{x}");
}

/// T = (m a c − m g e)/(B − i), and nothing before an edge would lift.
#[test]
fn anchors_at_the_base_carry_what_the_weight_does_not() {
    let inventory = list("shelf,1,2000,420,,120,\n");
    let settings = study().assessment;
    let subject = Subject::new(&inventory.items[0], &settings).unwrap();
    let draw = draw(&settings, &subject, 1, 0, Change::None).without_factors();
    let motion = Motion::new(0.01, vec![0.0, 2.0, -8.0]).unwrap();
    let grip = Grip {
        at: GripAt::Base,
        ..at_top(None, 100.0)
    };
    let hold = Hold::new(&grip, &draw, &subject, &FloorOfWorld::given(&motion, None));
    let expected_n = (120.0 * 8.0 * 1.0 - 120.0 * G0_M_S2 * 0.21) / (0.42 - 0.075);
    assert_eq!(hold.force_n[..2], [0.0, 0.0]);
    assert!(
        (hold.force_n[2] - expected_n).abs() < 1e-9,
        "{:?}",
        hold.force_n
    );
    let until = hold.until(0.8 * expected_n);
    // Nearer to the sample of the peak.
    assert_eq!(
        (until.released.unwrap().sample, until.peak_n > 0.0),
        (2, true)
    );
}

/// A restraint of no strength changes nothing but the time before its release, one of endless strength lets
/// nothing fall, and more strength never lets more restraints give way.
#[test]
fn strength_is_worth_something() {
    let study = study();
    let inventory =
        list("shelf,1,2000,420,900,120,\ntrolley,1,1200,400,,60,free\nno mass,1,2000,420,,,\n");
    let grips = [1e-3, 800.0, 1600.0, 1e9].map(|median_n| Measure::Held(at_top(None, median_n)));
    let all: Vec<Measure> = grips
        .into_iter()
        .chain([Measure::Held(at_top(Some(0.15), 1600.0)), Measure::Locked])
        .collect();
    let wanted: Vec<Wanted> = inventory
        .items
        .iter()
        .map(|item| Wanted {
            item,
            measures: all.clone(),
        })
        .collect();
    let worlds = Worlds::new(&study, || Ok(())).unwrap();
    let found = restrained(&study, worlds, &wanted, false, &no_progress).unwrap();
    let [shelf, trolley, unknown] = [0, 1, 2].map(|place: usize| found[place].as_ref().unwrap());
    let effects: Vec<&Effect> = shelf.measures[..5]
        .iter()
        .map(|one| one.as_ref().unwrap())
        .collect();
    let given_way: Vec<f64> = effects[..4]
        .iter()
        .map(|one| one.exceeded_ratio.unwrap())
        .collect();
    assert!(given_way.is_sorted_by(|a, b| a >= b), "{given_way:?}");
    assert_eq!((given_way[0], given_way[3]), (1.0, 0.0));
    assert_eq!(
        (effects[3].overturn.value, effects[3].overturn.low),
        (0.0, 0.0)
    );
    assert!(effects[0].overturn.value > 0.3, "{:?}", effects[0]);
    // The force does not depend on the strength.
    assert!(
        effects[..4]
            .iter()
            .all(|one| one.force_n == effects[0].force_n)
    );
    assert_eq!(shelf.measures[5], Err(NotCalculated::DoesNotRoll));
    // A locked trolley rocks.
    let locked = trolley.measures[5].as_ref().unwrap();
    assert!(locked.overturn.value > 0.0 && locked.force_n.is_none());
    assert_eq!(trolley.measures[4], Err(NotCalculated::NotInAPlane));
    assert!(
        unknown.measures[..5]
            .iter()
            .all(|one| *one == Err(NotCalculated::NoMass))
    );
}
