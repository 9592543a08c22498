//! Walls beside an object.

use super::*;

/// A wall that cannot be reached changes nothing; one nearby holds the object; left and right are
/// mirror images; a low wall holds it later than a tall one.
#[test]
fn a_wall_holds_an_object() {
    let x = pulse(1.0, 0.9, 0.0, 2.0);
    let wall = |side: EdgeSide, gap_m: f64, height_m: f64| Wall {
        side,
        gap_m,
        height_m,
        cushion: None,
    };
    for shape in [
        Shape::Plane {
            thickness_m: 0.4,
            height_m: 1.8,
        },
        Shape::Prism {
            thickness_m: 0.4,
            width_m: 0.6,
            height_m: 1.8,
        },
    ] {
        let free = SpatialObject {
            shape,
            ..prism(1.0, 1.0, 1.0, 150.0, 3e6)
        };
        let at = |walls: Vec<Wall>, motion: &Motion| {
            rock(
                &SpatialObject {
                    walls,
                    ..free.clone()
                },
                along_x(motion),
            )
        };
        let alone = at(Vec::new(), &x);
        assert_eq!(alone.body.outcome, Outcome::Overturned);
        let far = at(
            vec![
                wall(EdgeSide::Left, 2.0, f64::INFINITY),
                wall(EdgeSide::Right, 2.0, f64::INFINITY),
            ],
            &x,
        );
        assert_eq!(far.body, alone.body);
        let gap_m = 0.05;
        let tall = |height_m: f64| {
            vec![
                wall(EdgeSide::Left, gap_m, height_m),
                wall(EdgeSide::Right, gap_m, height_m),
            ]
        };
        for height_m in [f64::INFINITY, 1.2] {
            let held = at(tall(height_m), &x);
            assert!(
                held.wall_contact_count > 0 && held.energy.residual_ratio < 1e-7,
                "{held:?}"
            );
            // On undamped cushions it still rocks where the motion ends.
            assert!(
                matches!(held.body.outcome, Outcome::Rocked | Outcome::Unresolved),
                "{held:?}"
            );
            let contact = (gap_m / height_m.min(1.8)).atan();
            // The foot may jump and come closer to the wall, but the object does not fall past it.
            let peak = held.body.peak_tilt_rad;
            assert!(
                peak > 0.9 * contact && peak < (0.4f64 / 1.8).atan(),
                "{peak} {contact}"
            );
        }
        let one = at(vec![wall(EdgeSide::Left, gap_m, f64::INFINITY)], &x).body;
        let opposite = Motion::new(0.005, x.accel_m_s2().iter().map(|a| -a).collect()).unwrap();
        let other = at(vec![wall(EdgeSide::Right, gap_m, f64::INFINITY)], &opposite).body;
        assert!(
            (one.peak_tilt_x_rad + other.peak_tilt_x_rad).abs() < 1e-9,
            "{one:?} {other:?}"
        );
    }
    // Released past its balance point, 0.22 rad, it comes to lean on a wall that damps its impacts.
    let law = ContactLaw::KelvinVoigt {
        stiffness_n_m: 1e6,
        damping_n_s_m: 1e4,
    };
    let cushion = Some(Cushion::new(law.clone()).unwrap());
    let shape = Shape::Plane {
        thickness_m: 0.4,
        height_m: 1.8,
    };
    let walls = vec![Wall {
        cushion,
        ..wall(EdgeSide::Left, 0.6, f64::INFINITY)
    }];
    let support = Support::new(Cushion::new(law).unwrap());
    let far = SpatialObject {
        shape,
        mass_kg: 150.0,
        support,
        walls,
    };
    let start = SpatialStart::Released {
        tilt_rad: -0.25,
        toward_rad: 0.0,
        omega_rad_s: [0.0; 3],
    };
    let leant = rock_spatial(
        &far,
        SpatialMotion::default(),
        &SpatialOptions {
            start,
            ..until(5.0)
        },
    )
    .unwrap();
    assert_eq!(leant.body.outcome, Outcome::Leaned, "{leant:?}");
    // On its foot the corner reaches the wall at asin(0.6/1.8); both cushions give by millimetres.
    assert!(
        (leant.body.final_tilt_x_rad + (0.6f64 / 1.8).asin()).abs() < 0.005,
        "{leant:?}"
    );
    // Only the rims of a cylinder meet a wall.
    let mut round = cylinder(0.2, 1.8, 150.0, 3e6);
    round.walls = vec![wall(EdgeSide::Left, 0.1, 1.0)];
    assert!(rock_spatial(&round, along_x(&x), &until(1.0)).is_err());
}

const STIFF_N_M: f64 = 5e6;

/// A touching wall on the left, elastic.
fn touching() -> Wall {
    Wall {
        side: EdgeSide::Left,
        gap_m: 0.0,
        height_m: f64::INFINITY,
        cushion: Some(Cushion::linear(STIFF_N_M).unwrap()),
    }
}

/// Objects of each shape at a touching wall, on a floor with this friction.
fn at_a_wall(friction_ratio: Option<f64>) -> [SpatialObject; 3] {
    let plane = Shape::Plane {
        thickness_m: 0.4,
        height_m: 1.8,
    };
    let [flat, square, round] = [
        SpatialObject {
            shape: plane,
            ..prism(1.0, 1.0, 1.0, 150.0, 3e6)
        },
        prism(0.4, 0.6, 1.8, 150.0, 3e6),
        cylinder(0.2, 1.8, 150.0, 3e6),
    ];
    [flat, square, round].map(|one| SpatialObject {
        support: Support {
            friction_ratio,
            ..one.support.clone()
        },
        walls: vec![touching()],
        ..one
    })
}

/// No point of an object is deeper in the wall than the force on it compresses the wall: a wall that stops the top
/// alone lets the base of these objects through by centimetres. 48 points of a cylinder's rim are looked at, between
/// which it is 0.2 % wider; the force is that at the ends of steps, within 1 %.
#[test]
fn a_wall_stops_the_base() {
    // It slides towards the wall under the first half and rocks under the second.
    let x = pulse(0.8, 1.2, 0.0, 3.0);
    let y = pulse(0.3, 0.7, 0.0, 3.0);
    for object in at_a_wall(Some(0.3)) {
        let motion = match object.shape {
            Shape::Plane { .. } => along_x(&x),
            _ => both(&x, &y),
        };
        let [.., height_m] = object.shape.sizes_m();
        let feet = object.shape.feet_m();
        let (mut base_m, mut top_m) = (0.0f64, 0.0f64);
        let found =
            rock_spatial_observed(&object, motion, &within([Some(&x), None, None]), |step| {
                let depth = |[px, py]: [f64; 2], pz: f64| {
                    -0.2 - step.place_m(0, [px, py, pz], 1.0).unwrap()[0]
                };
                for foot in &feet {
                    base_m = base_m.max(depth(*foot, 0.0));
                    top_m = top_m.max(depth(*foot, height_m));
                }
            })
            .unwrap();
        let share = match object.shape {
            // One of the two ends of an edge can carry all of it.
            Shape::Prism { .. } => 0.5,
            _ => 1.0,
        };
        let most_m = 1.01 * found.wall_edge_forces_max_n[0] / (share * STIFF_N_M);
        assert!(found.wall_contact_count > 1, "{found:?}");
        assert!(base_m > 0.0 && base_m <= most_m, "{base_m} {most_m}");
        assert!(top_m <= most_m, "{top_m} {most_m}");
        assert!(most_m < 0.01, "{most_m}");
        assert!(found.energy.residual_ratio < 1e-7, "{found:?}");
        assert!(found.wall_forces_max_n[0] >= found.wall_edge_forces_max_n[0]);
        assert_eq!(found.wall_forces_max_n[1], 0.0);
    }
}

/// A constant push holds an object that slides freely against the wall: both edges share it, F/(2 k_w) deep. Its top
/// edge is at the same depth, so it does not turn.
#[test]
fn a_push_against_a_wall_compresses_it_as_springs_do() {
    // Pushed so slowly, it does not vibrate: 0.2 g within 20 periods of the wall.
    let ramp = Motion::new(
        0.01,
        (0..=200)
            .map(|i| 0.2 * G0_M_S2 * f64::from(i) / 200.0)
            .collect(),
    )
    .unwrap();
    for object in at_a_wall(Some(0.0)) {
        let mut last_m = [0.0; 2];
        let found = rock_spatial_observed(
            &object,
            along_x(&ramp),
            &within([Some(&ramp), None, None]),
            |step| {
                last_m = [0.0, 1.8].map(|z| -step.place_m(0, [0.0, 0.0, z], 1.0).unwrap()[0]);
            },
        )
        .unwrap();
        let force_n = 150.0 * 0.2 * G0_M_S2;
        let depth_m = force_n / (2.0 * STIFF_N_M);
        // What vibrates is a ramp's: its rate over the frequency of the wall, 2 %.
        for place_m in last_m {
            assert!(
                (place_m / depth_m - 1.0).abs() < 0.02,
                "{last_m:?} {depth_m}"
            );
        }
        assert!(
            (found.wall_forces_max_n[0] / force_n - 1.0).abs() < 0.02,
            "{found:?}"
        );
    }
}

/// Without dashpots and without friction nothing is lost, however often corners and rims strike the walls.
#[test]
fn elastic_walls_keep_the_energy() {
    let cases = at_a_wall(None).into_iter().zip([0.0, 0.7, 0.7]);
    for (object, toward_rad) in cases {
        let right = Wall {
            side: EdgeSide::Right,
            gap_m: 0.02,
            ..touching()
        };
        let object = SpatialObject {
            walls: vec![touching(), right],
            // Smooth, so that no stretched spring is left where a foot lifts.
            support: Support {
                friction_ratio: Some(0.0),
                ..object.support.clone()
            },
            ..object
        };
        // To and fro between the walls: without friction nothing else turns it back.
        let options = released(0.01, toward_rad, [0.0, -0.5, 0.0], 2.0);
        let found = rock_spatial(&object, SpatialMotion::default(), &options).unwrap();
        assert!(found.wall_contact_count > 5, "{found:?}");
        let energy = &found.energy;
        let now_j = energy.kinetic_j + energy.potential_j + energy.stored_j;
        // Without walls the balance of such an object closes to 2e-7 at `standard`.
        let lost = (now_j - energy.initial_j) / energy.turnover_j;
        assert!(lost.abs() < 1e-6, "{lost} {found:?}");
        assert_eq!(
            (energy.friction_j, energy.cushion_dissipation_j),
            (0.0, 0.0)
        );
    }
}

/// Ten times the tolerance changes a history before it is chaotic by less than a thousandth.
#[test]
fn histories_at_a_wall_converge() {
    let x = pulse(0.6, 0.9, 0.0, 1.2);
    let y = pulse(0.2, 0.7, 0.0, 1.2);
    for object in at_a_wall(None) {
        let of = |accuracy: CompliantAccuracy| {
            let options = SpatialOptions {
                accuracy,
                ..within([Some(&x), None, None])
            };
            let motion = match object.shape {
                Shape::Plane { .. } => along_x(&x),
                _ => both(&x, &y),
            };
            let found = rock_spatial(&object, motion, &options).unwrap();
            assert!(found.wall_contact_count > 0);
            (found.body.final_tilt_x_rad, found.body.peak_tilt_rad)
        };
        let (fast, standard, tight) = (
            of(CompliantAccuracy::Fast),
            of(CompliantAccuracy::Standard),
            of(CompliantAccuracy::Tight),
        );
        assert!(tight.1 > 0.01, "{tight:?}");
        let error =
            |one: (f64, f64)| (one.0 - tight.0).abs().max((one.1 - tight.1).abs()) / tight.1;
        assert!(error(fast) < 1e-3, "{fast:?} {tight:?}");
        assert!(error(standard) < 1e-4, "{standard:?} {tight:?}");
    }
}

/// Under one component a prism and a cylinder at a wall stay in its plane, and the prism moves as the block in the
/// plane does.
#[test]
fn under_one_component_walls_keep_objects_in_their_plane() {
    let x = pulse(0.35, 0.9, 0.0, 2.0);
    let [flat, square, round] = at_a_wall(None).map(|one| rock(&one, along_x(&x)));
    for one in [&square, &round] {
        assert!(one.body.peak_tilt_y_rad.abs() < 1e-9, "{one:?}");
        assert!(
            one.body.yaw_rad.abs() < 1e-9 && one.wall_contact_count > 0,
            "{one:?}"
        );
    }
    let (a, b) = (flat.body.peak_tilt_rad, square.body.peak_tilt_rad);
    assert!(a > 0.01 && (a / b - 1.0).abs() < 1e-6, "{a} {b}");
}

/// A cylinder is as near to a wall as its circles are: the rim of the top reaches a√(1 − e_x²) beyond its centre, with
/// the axis e, in whatever direction it is tilted and yawed.
#[test]
fn a_rim_meets_a_wall_where_it_is_nearest() {
    let (radius_m, height_m) = (0.2, 1.8);
    for (tilt_rad, toward_rad) in [(0.1, PI), (0.1, 2.5), (0.3, 2.0), (0.2, -2.8)] {
        let ([sin, cos], [along, across]) = (
            [f64::sin(tilt_rad), f64::cos(tilt_rad)],
            [f64::cos(toward_rad), f64::sin(toward_rad)],
        );
        // From the lowest of the 48 points of the base, in place, to the centre of the top.
        let feet = cylinder(radius_m, height_m, 150.0, 3e6).shape.feet_m();
        let low = feet
            .into_iter()
            .max_by(|a, b| {
                let down = |p: &[f64; 2]| p[0] * along + p[1] * across;
                down(a).total_cmp(&down(b))
            })
            .unwrap();
        // The turn about the horizontal axis (−sin φ, cos φ) keeps what is along it.
        let (inward, aside) = (
            low[0] * along + low[1] * across,
            low[1] * along - low[0] * across,
        );
        let foot_x = inward * cos * along - aside * across;
        let centre_x = low[0] - foot_x;
        let top_x = centre_x + height_m * sin * along;
        let reach_m = radius_m * (1.0 - (sin * along).powi(2)).sqrt();
        let gap_m = -(top_x - reach_m) - radius_m;
        assert!(gap_m > 0.01, "{gap_m}");
        for (factor, is_free) in [(1.0 + 1e-9, true), (1.0 - 1e-9, false)] {
            let object = SpatialObject {
                walls: vec![Wall {
                    gap_m: factor * gap_m,
                    ..touching()
                }],
                ..cylinder(radius_m, height_m, 150.0, 3e6)
            };
            let options = released(tilt_rad, toward_rad, [0.0; 3], 1e-3);
            let found = rock_spatial(&object, SpatialMotion::default(), &options);
            assert_eq!(found.is_ok(), is_free, "{tilt_rad} {toward_rad}: {found:?}");
        }
    }
}

/// An elastic wall stops the point that strikes it with F = v √(k_w m_c), where 1/m_c = 1/m + z²/I:
/// a thin block high above a soft floor, whose cushions do not act in the time of the impact. The
/// quarter of a vibration is short, so 2 % remain for the floor.
#[test]
fn the_force_of_a_wall_is_that_of_the_free_body() {
    let shape = Shape::Plane {
        thickness_m: 0.2,
        height_m: 2.0,
    };
    let stiff = Some(Cushion::linear(1e6).unwrap());
    let walls = vec![Wall {
        side: EdgeSide::Right,
        gap_m: 0.05,
        height_m: f64::INFINITY,
        cushion: stiff,
    }];
    let support = Support {
        friction_ratio: Some(0.0),
        ..Support::new(Cushion::linear(2e4).unwrap())
    };
    let object = SpatialObject {
        shape,
        mass_kg: 20.0,
        support,
        walls,
    };
    let start = SpatialStart::Released {
        tilt_rad: 0.01,
        toward_rad: 0.0,
        omega_rad_s: [0.0, 0.8, 0.0],
    };
    let options = SpatialOptions {
        start,
        // Before the foot, which the impact throws forward, strikes the wall as well.
        duration_s: Some(0.04),
        ..SpatialOptions::default()
    };
    let found = rock_spatial(&object, SpatialMotion::default(), &options).unwrap();
    assert_eq!(found.wall_contact_count, 1);
    let gyration_m2 = (0.2f64.powi(2) + 4.0) / 12.0;
    let free_kg = 20.0 / (1.0 + 1.0 / gyration_m2);
    let force_n = found.wall_speed_max_m_s * (1e6 * free_kg).sqrt();
    assert!(
        (found.wall_forces_max_n[1] / force_n - 1.0).abs() < 0.02,
        "{found:?} {force_n}"
    );
}

/// Unequal gaps under a motion and mirrored: the same forces on the other walls.
#[test]
fn mirrored_walls_have_mirrored_forces() {
    let push = Motion::new(
        0.01,
        (0..200)
            .map(|i| 5.0 * (f64::from(i) * 0.06).sin())
            .collect(),
    )
    .unwrap();
    let forces = |left_m: f64, right_m: f64, factor: f64| {
        let wall = |side, gap_m| Wall {
            side,
            gap_m,
            height_m: f64::INFINITY,
            cushion: None,
        };
        let walls = vec![wall(EdgeSide::Left, left_m), wall(EdgeSide::Right, right_m)];
        let shape = Shape::Plane {
            thickness_m: 0.4,
            height_m: 1.8,
        };
        let law = ContactLaw::KelvinVoigt {
            stiffness_n_m: 4e6,
            damping_n_s_m: 2e3,
        };
        let support = Support::new(Cushion::new(law).unwrap());
        let motion = push.scaled(factor).unwrap();
        let motion = SpatialMotion {
            x: Some(&motion),
            ..SpatialMotion::default()
        };
        let object = SpatialObject {
            shape,
            mass_kg: 100.0,
            support,
            walls,
        };
        rock(&object, motion).wall_forces_max_n
    };
    let [left, right] = forces(0.03, 0.06, 1.0);
    assert!(left > 0.0 && right > 0.0 && left != right, "{left} {right}");
    assert_eq!(forces(0.06, 0.03, -1.0), [right, left]);
}

#[test]
fn a_start_beyond_a_wall_is_refused() {
    let walls = vec![Wall {
        side: EdgeSide::Left,
        gap_m: 0.005,
        height_m: f64::INFINITY,
        cushion: None,
    }];
    let shape = Shape::Plane {
        thickness_m: 0.4,
        height_m: 1.8,
    };
    let object = SpatialObject {
        shape,
        mass_kg: 100.0,
        support: Support::new(Cushion::linear(4e6).unwrap()),
        walls,
    };
    let from = |tilt_rad: f64| {
        let start = SpatialStart::Released {
            tilt_rad,
            toward_rad: 0.0,
            omega_rad_s: [0.0; 3],
        };
        let options = SpatialOptions {
            start,
            duration_s: Some(0.1),
            ..SpatialOptions::default()
        };
        rock_spatial(&object, SpatialMotion::default(), &options)
    };
    assert_eq!(from(-0.1).unwrap_err(), CompliantError::BeyondWall);
    assert!(from(0.1).is_ok());
}
