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
    let mut round = cylinder(0.2, 1.8, 150.0, 3e6);
    round.walls = vec![wall(EdgeSide::Left, 0.1, 1.0)];
    assert!(rock_spatial(&round, along_x(&x), &until(1.0)).is_err());
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
        duration_s: Some(0.1),
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
