use super::*;
use crate::G0_M_S2;
use crate::block::Block;
use crate::compliant::{CompliantAccuracy, CompliantBase, CompliantOptions, rock_compliant};
use crate::cushion::{ContactLaw, Cushion};
use crate::rocking::{LONGEST_TAIL_S, Outcome as Rocking, Until, rock};
use crate::sliding::{Clearance, Friction, SlidingOptions, slide, trip_speed_m_s};
use crate::spatial::{
    Shape, SpatialMotion, SpatialObject, SpatialOptions, Stack, StackBody, Support, rock_spatial,
    rock_stack,
};
use crate::wall::Wall;

/// A sine of this peak and period for 4 s, in steps of 10 ms.
fn sine(peak_m_s2: f64, period_s: f64) -> Motion {
    let at = |i: usize| peak_m_s2 * (std::f64::consts::TAU * 0.01 * i as f64 / period_s).sin();
    Motion::new(0.01, (0..=400).map(at).collect()).unwrap()
}

fn plane(along: Along) -> Plane {
    let block = Block::uniform(1.8, 0.5).unwrap();
    Plane { along, block }
}

fn rigid(along: Along) -> RigidPlane {
    RigidPlane {
        plane: plane(along),
        restitution: Restitution::Housner,
        walls: Walls::NONE,
    }
}

const MASS_KG: f64 = 150.0;
const STIFFNESS_N_M: f64 = 4e6;
const DAMPING_N_S_M: f64 = 5e3;

fn cushion() -> Cushion {
    Cushion::new(ContactLaw::KelvinVoigt {
        stiffness_n_m: STIFFNESS_N_M,
        damping_n_s_m: DAMPING_N_S_M,
    })
    .unwrap()
}

fn support() -> Support {
    Support {
        friction_ratio: Some(0.4),
        ..Support::new(cushion())
    }
}

fn base(friction_ratio: Option<f64>) -> CompliantBase {
    CompliantBase {
        friction_ratio,
        ..CompliantBase::new(MASS_KG, cushion())
    }
}

fn spatial() -> SpatialObject {
    SpatialObject {
        shape: Shape::Prism {
            thickness_m: 0.5,
            width_m: 0.7,
            height_m: 1.8,
        },
        mass_kg: MASS_KG,
        support: support(),
        walls: Vec::new(),
    }
}

fn stack() -> Stack {
    let body = |height_m, thickness_m, mass_kg| StackBody {
        height_m,
        thickness_m,
        mass_kg,
    };
    Stack {
        lower: body(0.9, 0.5, 100.0),
        upper: body(0.6, 0.3, 20.0),
        support: support(),
        interface: support(),
    }
}

/// One object of every way.
fn all() -> Vec<Object> {
    let both = || Planes {
        one: plane(Along::X),
        other: Some(plane(Along::Y)),
    };
    let behind = Walls {
        left: Some(Wall::at(0.02)),
        ..Walls::NONE
    };
    let walled = RigidPlane {
        walls: behind,
        ..rigid(Along::X)
    };
    let glider = |friction_ratio: f64, room_m: Option<f64>| Glider {
        planes: both(),
        friction: Friction::uniform(friction_ratio).unwrap(),
        clearance: Clearance {
            left_m: room_m,
            right_m: room_m,
        },
        yaw_rad: 0.4,
    };
    vec![
        Object::Rigid(Planes {
            one: rigid(Along::X),
            other: Some(rigid(Along::Y)),
        }),
        Object::Rigid(Planes::single(walled)),
        Object::Springs(Springs {
            planes: both(),
            mass_kg: MASS_KG,
            stiffness_n_m: STIFFNESS_N_M,
            damping_n_s_m: DAMPING_N_S_M,
        }),
        Object::Pads(Pads {
            planes: both(),
            base: base(None),
        }),
        Object::Pads(Pads {
            planes: Planes::single(plane(Along::X)),
            base: base(Some(0.25)),
        }),
        Object::Rolls(glider(0.02, Some(0.1))),
        Object::Slides(glider(0.2, None)),
        Object::Spatial(spatial(), Along::Y),
        Object::Stack(stack(), Along::X),
    ]
}

/// Each response is that of its own solver, to the bit, for an object among others.
#[test]
fn every_way_is_that_of_its_solver() {
    let (x, y) = (sine(4.0, 0.8), sine(3.2, 1.1));
    let up = sine(1.0, 0.3);
    let shaking = Shaking {
        x: Some(&x),
        y: Some(&y),
        vertical: Some(&up),
    };
    let asked: Vec<_> = all().into_iter().map(|object| (object, shaking)).collect();
    let found: Vec<Response> = respond(&asked, &Settings::default())
        .into_iter()
        .map(Result::unwrap)
        .collect();
    let moves = |along| shaking.base(along);

    let block = plane(Along::X).block;
    let alone = |along, walls| {
        let options = Settings::default().rocking(Restitution::Housner, walls);
        rock(&block, moves(along), &options).unwrap()
    };
    let Response::Rigid(planes) = &found[0] else {
        panic!("{:?}", found[0])
    };
    for (one, along) in planes.iter().zip([Along::X, Along::Y]) {
        let alone = alone(along, Walls::NONE);
        assert_eq!(one.outcome, alone.outcome, "{along:?}");
        // The kernel and the scalar solver agree to 1e-9 of a rotation.
        assert!((one.uplift_m - alone.uplift_m).abs() < 1e-9);
    }
    assert!(matches!(&found[1], Response::Rigid(planes) if planes.one.wall_impact_count > 0));

    let fast = CompliantOptions {
        accuracy: CompliantAccuracy::Fast,
        ..CompliantOptions::default()
    };
    for (place, friction_ratio) in [(3, None), (4, Some(0.25))] {
        let Response::Pads(planes) = &found[place] else {
            panic!("{:?}", found[place])
        };
        let base = base(friction_ratio);
        let alone = rock_compliant(&block, &base, moves(Along::X), &fast).unwrap();
        assert_eq!(planes.one.lift_m, alone.uplift_m);
        assert_eq!(planes.one.compression_m, alone.peak_compression_m);
    }
    // Springs by the kernel and by the other solver, which reports the same peaks to its accuracy.
    let (Response::Pads(springs), Response::Pads(pads)) = (&found[2], &found[3]) else {
        panic!("{found:?}")
    };
    assert_eq!(springs.one.outcome, pads.one.outcome);
    assert!((springs.one.compression_m / pads.one.compression_m - 1.0).abs() < 0.02);

    let Response::Spatial(body, Some(tilt)) = &found[7] else {
        panic!("{:?}", found[7])
    };
    let motion = SpatialMotion {
        x: Some(&y),
        y: Some(&x),
        vertical: Some(&up),
    };
    let options = SpatialOptions {
        accuracy: CompliantAccuracy::Fast,
        ..SpatialOptions::default()
    };
    let alone = rock_spatial(&spatial(), motion, &options).unwrap();
    assert_eq!(tilt.tilt_rad, alone.body.peak_tilt_rad);
    assert_eq!(body.lift_m, alone.body.uplift_m);
    let Response::Stack(lower, fallen) = &found[8] else {
        panic!("{:?}", found[8])
    };
    let alone = rock_stack(&stack(), moves(Along::X), &options).unwrap();
    assert_eq!(
        (lower.lift_m, *fallen),
        (alone.lower.uplift_m, alone.overturned_body)
    );
}

/// The order, and what else is asked, change nothing.
#[test]
fn no_object_depends_on_another() {
    let (one, other) = (sine(4.0, 0.8), sine(2.5, 1.3));
    let shakings = [&one, &other].map(|x| Shaking {
        x: Some(x),
        y: None,
        vertical: None,
    });
    let asked: Vec<_> = all()
        .into_iter()
        .flat_map(|object| shakings.map(|shaking| (object.clone(), shaking)))
        .collect();
    let together = respond(&asked, &Settings::default());
    let backwards: Vec<_> = asked.iter().rev().cloned().collect();
    let mut backwards = respond(&backwards, &Settings::default());
    backwards.reverse();
    assert_eq!(together, backwards);
    for (one, found) in asked.into_iter().zip(together) {
        assert_eq!(respond(&[one], &Settings::default()), [found]);
    }
}

/// Under one component each plane moves along it, and the way is a lower bound; a stop trips what
/// reaches it fast enough.
#[test]
fn what_rolls_has_a_way_and_a_stop() {
    let motion = sine(3.0, 1.5);
    let shaking = Shaking {
        x: Some(&motion),
        y: None,
        vertical: None,
    };
    let friction = Friction::uniform(0.02).unwrap();
    let slender = Plane {
        along: Along::Y,
        block: Block::uniform(2.0, 0.12).unwrap(),
    };
    let roll = |room_m: Option<f64>| {
        let clearance = Clearance {
            left_m: room_m,
            right_m: room_m,
        };
        let glider = Glider {
            planes: Planes::single(slender),
            friction,
            clearance,
            yaw_rad: 0.0,
        };
        let found = respond(&[(Object::Rolls(glider), shaking)], &Settings::default()).remove(0);
        found.unwrap().outcome()
    };
    let free = roll(None).travelled().unwrap();
    let options = SlidingOptions {
        until: Until::Settled {
            at_most_s: LONGEST_TAIL_S,
        },
        ..SlidingOptions::new(friction)
    };
    let alone = slide(shaking.base(Along::Y), &options).unwrap();
    assert_eq!(free.travel_m, alone.peak_m.abs());
    assert!(free.is_at_least && !free.has_tripped && free.stop_speed_m_s.is_none());
    let stopped = roll(Some(0.1));
    let speed_m_s = stopped.travelled().unwrap().stop_speed_m_s.unwrap();
    assert!(speed_m_s > trip_speed_m_s(&slender.block, G0_M_S2));
    assert!(stopped.has_fallen() == Some(true) && stopped.uplift_m().is_none());
}

/// A body that its pads do not keep upright has fallen; one that flies off a rigid base has no answer
/// there, and says so.
#[test]
fn what_topples_and_what_flies() {
    let motion = sine(1.0, 1.0);
    let drop = sine(-15.0, 2.0);
    let still = Shaking {
        x: Some(&motion),
        y: None,
        vertical: None,
    };
    let soft = Cushion::linear(1e3).unwrap();
    let toppling = Object::Pads(Pads {
        planes: Planes::single(plane(Along::X)),
        base: CompliantBase::new(MASS_KG, soft),
    });
    let falling = Shaking {
        vertical: Some(&drop),
        ..still
    };
    let rocking = || Object::Rigid(Planes::single(rigid(Along::X)));
    let asked = [(toppling, still), (rocking(), falling), (rocking(), still)];
    let found = respond(&asked, &Settings::default());
    assert_eq!(found[0].as_ref().unwrap().outcome(), Outcome::Overturned);
    assert!(found[1].as_ref().unwrap_err().is_flight());
    assert_eq!(found[2].as_ref().unwrap().outcome(), Outcome::Stood);
}

/// The worse plane counts: a fall onto the floor before one against a wall, that before uplift.
#[test]
fn the_worse_plane_counts() {
    let summary = |outcome, uplift_m| RockingSummary {
        outcome,
        uplift_m,
        ..respond(
            &[(
                Object::Rigid(Planes::single(rigid(Along::X))),
                Shaking {
                    x: Some(&sine(0.1, 1.0)),
                    y: None,
                    vertical: None,
                },
            )],
            &Settings::default(),
        )
        .remove(0)
        .map(|found| match found {
            Response::Rigid(planes) => planes.one,
            other => panic!("{other:?}"),
        })
        .unwrap()
    };
    let of = |planes: &[(Rocking, f64)]| {
        let planes = planes
            .iter()
            .map(|&(outcome, uplift_m)| summary(outcome, uplift_m));
        Response::Rigid(Planes::of(planes).unwrap()).outcome()
    };
    use Rocking::{Leaned, NoUplift, Overturned, Rocked, Unresolved};
    assert_eq!(of(&[(NoUplift, 0.0), (NoUplift, 0.0)]), Outcome::Stood);
    let rocked = of(&[(Rocked, 0.02), (Rocked, 0.03)]);
    assert_eq!(rocked, Outcome::Rocked { uplift_m: 0.03 });
    assert_eq!(of(&[(Rocked, 0.02), (Leaned, 0.3)]), Outcome::Leaned);
    assert_eq!(of(&[(Overturned, 0.5), (Leaned, 0.3)]), Outcome::Overturned);
    // What is down is down, whatever becomes of the other plane.
    assert_eq!(of(&[(Leaned, 0.3), (Unresolved, 0.1)]), Outcome::Unresolved);
    assert_eq!(
        of(&[(Unresolved, 0.1), (Overturned, 0.5)]),
        Outcome::Overturned
    );
}
