use std::f64::consts::{FRAC_PI_2, PI};

use proptest::prelude::*;

use super::equation::{Grip, Grips, Line};
use super::*;
use crate::G0_M_S2;
use crate::block::Block;
use crate::compliant::{CompliantBase, CompliantOptions, rock_compliant};
use crate::cushion::ContactLaw;
use crate::rocking::{Base, Outcome};

/// One sine of this amplitude \[g\] and duration, from `from_s` on, sampled every 5 ms.
fn pulse(amplitude_g: f64, period_s: f64, from_s: f64, duration_s: f64) -> Motion {
    let samples = (duration_s / 0.005).round() as usize;
    let at = |index: usize| {
        let time_s = index as f64 * 0.005 - from_s;
        let inside = (0.0..=period_s).contains(&time_s);
        if inside {
            amplitude_g * G0_M_S2 * (2.0 * PI * time_s / period_s).sin()
        } else {
            0.0
        }
    };
    Motion::new(0.005, (0..=samples).map(at).collect()).unwrap()
}

fn prism(
    thickness_m: f64,
    width_m: f64,
    height_m: f64,
    mass_kg: f64,
    stiffness_n_m: f64,
) -> SpatialObject {
    let support = Support::new(Cushion::linear(stiffness_n_m).unwrap());
    SpatialObject {
        shape: Shape::Prism {
            thickness_m,
            width_m,
            height_m,
        },
        mass_kg,
        support,
        walls: Vec::new(),
    }
}

fn cylinder(radius_m: f64, height_m: f64, mass_kg: f64, stiffness_n_m: f64) -> SpatialObject {
    let shape = Shape::Cylinder {
        diameter_m: 2.0 * radius_m,
        height_m,
    };
    SpatialObject {
        shape,
        ..prism(1.0, 1.0, 1.0, mass_kg, stiffness_n_m)
    }
}

fn until(duration_s: f64) -> SpatialOptions {
    SpatialOptions {
        duration_s: Some(duration_s),
        ..SpatialOptions::default()
    }
}

fn released(
    tilt_rad: f64,
    toward_rad: f64,
    omega_rad_s: [f64; 3],
    duration_s: f64,
) -> SpatialOptions {
    let start = SpatialStart::Released {
        tilt_rad,
        toward_rad,
        omega_rad_s,
    };
    SpatialOptions {
        start,
        ..until(duration_s)
    }
}

fn both<'a>(x: &'a Motion, y: &'a Motion) -> SpatialMotion<'a> {
    SpatialMotion {
        x: Some(x),
        y: Some(y),
        vertical: None,
    }
}

fn along_x(x: &Motion) -> SpatialMotion<'_> {
    SpatialMotion {
        x: Some(x),
        ..SpatialMotion::default()
    }
}

/// To the last sample: most of these objects stand on undamped cushions, on which they ring on.
fn within(motions: [Option<&Motion>; 3]) -> SpatialOptions {
    let duration_s = motions.into_iter().flatten().next().map(Motion::duration_s);
    SpatialOptions {
        duration_s,
        ..SpatialOptions::default()
    }
}

fn rock(object: &SpatialObject, motion: SpatialMotion<'_>) -> SpatialRocking {
    rock_spatial(
        object,
        motion,
        &within([motion.x, motion.y, motion.vertical]),
    )
    .unwrap()
}

/// A push that rocks the objects of these tests by about half of their slenderness angle.
fn push() -> Motion {
    pulse(0.4, 0.5, 0.0, 1.2)
}

/// The planar solver on the same cushions; both integrate to 1e-8 of the effect of the weight, of
/// which the pulse makes 1e-6 of the rotation.
#[test]
fn a_push_along_x_is_the_planar_block() {
    let x = push();
    let object = prism(0.5, 0.7, 1.8, 200.0, 4e6);
    for friction_ratio in [None, Some(0.35)] {
        let mut object = object.clone();
        object.support.friction_ratio = friction_ratio;
        let flat = SpatialObject {
            shape: Shape::Plane {
                thickness_m: 0.5,
                height_m: 1.8,
            },
            ..object.clone()
        };
        let got = rock(&object, along_x(&x));
        let base = CompliantBase {
            friction_ratio,
            ..CompliantBase::new(200.0, object.support.cushion.clone())
        };
        let block = Block::uniform(1.8, 0.5).unwrap();
        let motion = Base {
            horizontal: Some(&x),
            vertical: None,
        };
        let within = CompliantOptions {
            duration_s: Some(x.duration_s()),
            ..CompliantOptions::default()
        };
        let plane = rock_compliant(&block, &base, motion, &within).unwrap();
        let tolerance = if friction_ratio.is_some() { 1e-5 } else { 1e-6 };
        assert!(
            plane.peak_rotation_rad > 0.05,
            "{}",
            plane.peak_rotation_rad
        );
        let error = got.body.peak_tilt_rad / plane.peak_rotation_rad - 1.0;
        assert!(error.abs() < tolerance, "{friction_ratio:?}: {error}");
        let error =
            (got.body.final_tilt_x_rad - plane.final_rotation_rad) / plane.peak_rotation_rad;
        assert!(error.abs() < tolerance, "{friction_ratio:?}: {error}");
        let uplift = got.body.uplift_m / plane.uplift_m - 1.0;
        assert!(uplift.abs() < tolerance, "{friction_ratio:?}: {uplift}");
        // Peaks of sums of vibrations: those inside a step are found to 1e-4 of its change.
        let close = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-4;
        let landings = got.landings;
        assert!(
            close(
                landings.peak_acceleration_m_s2,
                plane.peak_edge_acceleration_m_s2()
            ),
            "{landings:?}"
        );
        assert!(
            close(landings.peak_compression_m, plane.peak_compression_m),
            "{landings:?}"
        );
        let hardest = plane
            .touches
            .iter()
            .map(|touch| touch.peak_acceleration_m_s2)
            .fold(0.0, f64::max);
        assert!(
            hardest > 0.0 && landings.velocity_change_m_s > 0.0,
            "{landings:?}"
        );
        // As short as a contact of the plane or shorter: it ends where the point falls again.
        let contacts = plane
            .touches
            .iter()
            .filter_map(|touch| Some(touch.end_time_s? - touch.time_s));
        assert!(
            landings.pulse_duration_s.unwrap() <= contacts.fold(0.0, f64::max),
            "{landings:?}"
        );
        let error = rock(&flat, along_x(&x)).body.peak_tilt_rad / plane.peak_rotation_rad - 1.0;
        assert!(error.abs() < tolerance, "{friction_ratio:?}: {error}");
        // With friction the direction π of a sliding spring is rounded to 1e-16 of a half turn.
        let zero = if friction_ratio.is_some() {
            1e-9
        } else {
            1e-12
        };
        assert!(
            got.body.peak_tilt_y_rad.abs() < zero && got.body.yaw_rad.abs() < zero,
            "{:?}",
            got.body
        );
    }
}

/// The same numbers in another order. Rounding decides how far past an event a step ends, within
/// 5e-8 of the static compression: 1e-9 of the rotation.
#[test]
fn axes_may_be_swapped_and_mirrored() {
    let (x, y) = (push(), pulse(0.5, 0.4, 0.1, 1.2));
    let object = prism(0.5, 0.7, 1.8, 200.0, 4e6);
    let here = rock(&object, both(&x, &y)).body;
    assert!(
        here.peak_tilt_x_rad.abs() > 0.02
            && here.peak_tilt_y_rad.abs() > 0.02
            && here.yaw_rad.abs() > 1e-4
    );
    let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-9, "{a} {b}");
    let swapped = rock(&prism(0.7, 0.5, 1.8, 200.0, 4e6), both(&y, &x)).body;
    near(swapped.final_tilt_x_rad, here.final_tilt_y_rad);
    near(swapped.final_tilt_y_rad, here.final_tilt_x_rad);
    near(swapped.peak_tilt_x_rad, here.peak_tilt_y_rad);
    near(swapped.yaw_rad, -here.yaw_rad);
    let opposite = Motion::new(0.005, x.accel_m_s2().iter().map(|a| -a).collect()).unwrap();
    let mirrored = rock(&object, both(&opposite, &y)).body;
    near(mirrored.final_tilt_x_rad, -here.final_tilt_x_rad);
    near(mirrored.final_tilt_y_rad, here.final_tilt_y_rad);
    near(mirrored.yaw_rad, -here.yaw_rad);
}

/// A square plan that is pushed along its diagonal rocks on a vertex and stays in its diagonal
/// plane, exactly: both axes do the same arithmetic. Rounding differs in the order of sums.
#[test]
fn a_diagonal_push_rocks_on_a_vertex() {
    let x = push();
    let got = rock(&prism(0.5, 0.5, 1.8, 200.0, 4e6), both(&x, &x)).body;
    assert!(got.peak_tilt_rad > 0.05);
    assert!(
        (got.final_tilt_x_rad - got.final_tilt_y_rad).abs() < 1e-9 && got.yaw_rad.abs() < 1e-9,
        "{got:?}"
    );
}

/// Released on a corner, without dashpots or slip: only what contacts leave in their springs is
/// lost, and the balance closes to the tolerance of the steps, which adds up with time.
#[test]
fn free_motion_keeps_its_energy() {
    let object = prism(0.5, 0.7, 1.8, 200.0, 4e6);
    for (toward, omega) in [(0.6, [0.0; 3]), (0.6, [0.3, -0.2, 0.5]), (2.5, [0.0; 3])] {
        let got = rock_spatial(
            &object,
            SpatialMotion::default(),
            &released(0.08, toward, omega, 1.0),
        )
        .unwrap();
        assert!(got.energy.residual_ratio < 1e-8, "{:?}", got.energy);
        assert!(got.base_contact_count > 2);
    }
    // Below the first uplift nothing is lost at all.
    let got = rock_spatial(
        &object,
        SpatialMotion::default(),
        &released(1e-5, 0.6, [0.0; 3], 1.0),
    )
    .unwrap();
    assert!(
        got.energy.lost_at_separation_j == 0.0 && got.energy.residual_ratio < 1e-8,
        "{:?}",
        got.energy
    );
}

/// With every law, with friction and under three components the balance closes: to 1e-7 with smooth
/// laws, to 1e-5 with a fractional power at first contact, as in the plane.
#[test]
fn the_energy_balance_closes() {
    let laws = [
        (ContactLaw::Linear { stiffness_n_m: 4e6 }, 1e-7),
        (
            ContactLaw::KelvinVoigt {
                stiffness_n_m: 4e6,
                damping_n_s_m: 3000.0,
            },
            1e-7,
        ),
        (
            ContactLaw::Power {
                coefficient_n_mn: 2e8,
                exponent: 1.5,
            },
            1e-5,
        ),
        (
            ContactLaw::HuntCrossley {
                coefficient_n_mn: 2e8,
                exponent: 1.5,
                dissipation_s_m: 0.3,
            },
            1e-5,
        ),
    ];
    let (x, y, z) = (push(), pulse(0.5, 0.4, 0.1, 1.2), pulse(0.3, 0.3, 0.0, 1.2));
    let motion = SpatialMotion {
        x: Some(&x),
        y: Some(&y),
        vertical: Some(&z),
    };
    for (law, limit) in laws {
        for friction_ratio in [None, Some(0.3), Some(0.0)] {
            let mut object = prism(0.5, 0.7, 1.8, 200.0, 4e6);
            object.support.cushion = Cushion::new(law.clone()).unwrap();
            object.support.friction_ratio = friction_ratio;
            let got = rock(&object, motion);
            let slips = friction_ratio == Some(0.3);
            assert_eq!(
                got.energy.friction_j > 0.0,
                slips,
                "{law:?} {friction_ratio:?}"
            );
            assert!(
                got.energy.residual_ratio < limit,
                "{law:?} {friction_ratio:?}: {:?}",
                got.energy
            );
        }
    }
}

/// A rim of 48 points looks the same from every multiple of 7.5°.
#[test]
fn a_cylinder_answers_alike_in_every_direction() {
    let object = cylinder(0.25, 1.6, 150.0, 4e6);
    let x = push();
    let straight = rock(&object, along_x(&x)).body;
    assert!(straight.peak_tilt_rad > 0.03);
    for turns in [1, 3, 6, 12, 31] {
        let angle = f64::from(turns) * PI / 24.0;
        let part = |factor: f64| {
            Motion::new(0.005, x.accel_m_s2().iter().map(|a| factor * a).collect()).unwrap()
        };
        let got = rock(&object, both(&part(angle.cos()), &part(angle.sin()))).body;
        let error = got.peak_tilt_rad / straight.peak_tilt_rad - 1.0;
        assert!(error.abs() < 1e-5, "{turns}: {error}");
    }
}

/// Feet that stick are summed together; one by one they do the same. 1e-12 of the largest rate: up to
/// 48 forces, each rounded to 1e-16 of the largest.
#[test]
fn feet_together_are_feet_one_by_one() {
    let law = ContactLaw::KelvinVoigt {
        stiffness_n_m: 4e6,
        damping_n_s_m: 5e3,
    };
    let support = Support {
        friction_ratio: Some(0.4),
        ..Support::new(Cushion::new(law).unwrap())
    };
    for object in [
        prism(0.5, 0.7, 1.8, 200.0, 4e6),
        cylinder(0.25, 1.6, 150.0, 4e6),
    ] {
        let object = SpatialObject {
            support: support.clone(),
            ..object
        };
        let together = object.world(G0_M_S2);
        let apart = World {
            feet: None,
            ..together.clone()
        };
        let y = together.released(vector::tilted(0.05, 0.7), [0.2, -0.1, 0.4]);
        let line = Line {
            start: [1.0, -2.0, 0.5],
            slope: [3.0, 1.0, -2.0],
            start_s: 0.0,
        };
        let grip = |index: usize| match index % 4 {
            0 => Grip::Slip,
            3 => Grip::UNTOUCHED,
            _ => Grip::Stick {
                anchor: [0.01 * index as f64, -0.02],
            },
        };
        let grips: Vec<Grip> = (0..together.elements.len()).map(grip).collect();
        let of =
            |world: &World<'_>| world.rates(&Grips::new(world, grips.clone()), &line, 0.01, &y);
        let (got, expected) = (of(&together), of(&apart));
        let largest = expected
            .iter()
            .fold(0.0, |most: f64, rate| most.max(rate.abs()));
        for (index, (got, expected)) in got.iter().zip(&expected).enumerate() {
            assert!(
                (got - expected).abs() <= 1e-12 * largest,
                "{index}: {got} {expected}"
            );
        }
        let stored = |world: &World<'_>| world.energies(&grips, &y, &world.poses(&y)).stored_j;
        assert!((stored(&together) / stored(&apart) - 1.0).abs() < 1e-12);
    }
}

/// The closed form of a block that slides under a half sine (Newmark): A = 0.6 g for 0.5 s, μ =
/// 0.2: 0.475945 m. The block is squat and stiff, but its cushions shear and it nods: 2 %.
#[test]
fn a_squat_block_slides_in_any_direction() {
    let mut object = prism(1.0, 0.8, 0.2, 300.0, 3e7);
    object.support.friction_ratio = Some(0.2);
    for angle in [0.0, 0.4, FRAC_PI_2, 3.9] {
        let half_sine = |factor: f64| {
            let at = |index: usize| {
                let time_s = index as f64 * 0.005;
                if time_s < 0.5 {
                    factor * 0.6 * G0_M_S2 * (PI * time_s / 0.5).sin()
                } else {
                    0.0
                }
            };
            Motion::new(0.005, (0..400).map(at).collect()).unwrap()
        };
        let got = rock(
            &object,
            both(&half_sine(f64::cos(angle)), &half_sine(f64::sin(angle))),
        );
        let error = got.body.base_slide_final_m / 0.475_945 - 1.0;
        assert!(error.abs() < 0.02, "{angle}: {error}");
        assert!(
            got.body.yaw_rad.abs() < 1e-3,
            "{angle}: {}",
            got.body.yaw_rad
        );
    }
}

/// A slow push lets go of the first point where N = W/n − moments reach zero, linear in the pads:
/// tilts (a c W)/(K − W c) about each axis, with K = Σ k x². 2e-3: the tilt follows the push by some
/// 15 ms of 9 s.
#[test]
fn a_slow_push_lifts_the_first_point_where_its_load_ends() {
    let ramp = |rate_g_s: f64| {
        Motion::new(
            0.01,
            (0..=1600)
                .map(|i| rate_g_s * G0_M_S2 * f64::from(i) * 0.01)
                .collect(),
        )
    };
    let damped = |object: SpatialObject| {
        let law = ContactLaw::KelvinVoigt {
            stiffness_n_m: 4e6,
            damping_n_s_m: 5e3,
        };
        SpatialObject {
            support: Support::new(Cushion::new(law).unwrap()),
            ..object
        }
    };
    let (mass_kg, k, h): (f64, f64, f64) = (200.0, 4e6, 1.8);
    let (w, c) = (mass_kg * G0_M_S2, 0.5 * h);
    let (ax, ay) = (0.02, 0.015);
    let (x, y) = (ramp(ax).unwrap(), ramp(ay).unwrap());
    // A prism: four corners, each k/2.
    let (t, b) = (0.5, 0.7);
    let got = rock(&damped(prism(t, b, h, mass_kg, k)), both(&x, &y)).body;
    let tilt = |size: f64| w * c / (0.5 * k * size * size - w * c);
    let down = 0.5 * t * ax * tilt(t) + 0.5 * b * ay * tilt(b);
    let expected_s = 0.5 * w / k / down;
    let got_s = got.first_uplift_time_s.unwrap();
    assert!(
        (got_s / expected_s - 1.0).abs() < 2e-3,
        "{got_s} {expected_s}"
    );
    // On rigid corners neither axis alone would have lifted: |a_x|h/t + |a_y|h/w > 1 is the rule.
    assert!(
        (got_s * (ax * h / t + ay * h / b) - 1.0).abs() < 0.03,
        "{got_s}"
    );
    // A cylinder along x: b/4c − mg/(kb), with its diameter b.
    let got = rock(&damped(cylinder(0.25, h, mass_kg, k)), along_x(&x)).body;
    let expected = t / (4.0 * c) - w / (k * t);
    let got_g = ax * got.first_uplift_time_s.unwrap();
    assert!((got_g / expected - 1.0).abs() < 2e-3, "{got_g} {expected}");
}

/// The mean angular velocity at which the axis of a body goes round the vertical.
fn goes_round_at_rad_s(object: &SpatialObject, options: &SpatialOptions) -> f64 {
    let mut ends: Option<[(f64, f64); 2]> = None;
    rock_spatial_observed(object, SpatialMotion::default(), options, |piece| {
        let pose = piece.pose(0, 1.0).unwrap();
        let angle = pose.tilts_rad[1].atan2(pose.tilts_rad[0]);
        let before = ends.map_or(angle, |[_, last]| last.1);
        let unwrapped = angle + 2.0 * PI * ((before - angle) / (2.0 * PI)).round();
        let now = (piece.start_s() + piece.length_s(), unwrapped);
        ends = Some([ends.map_or(now, |[first, _]| first), now]);
    })
    .unwrap();
    let [first, last] = ends.unwrap();
    (last.1 - first.1) / (last.0 - first.0)
}

/// Closed forms of a cylinder that rolls at constant tilt. 2 % for wobbling in place, over about a
/// revolution: the rim is 48 springs, which sink. With the centre of gravity at rest the springs
/// soon shake it off its path: the first 50 ms on stiffer ones.
#[test]
fn a_cylinder_rolls_round_at_the_speed_of_a_rigid_one() {
    let mass_kg = 50.0;
    for (a, h, theta, at_rest, wobbling) in [
        (0.2, 1.0, 0.15, 9.756_903, 4.719_272),
        (0.2, 1.0, 0.05, 19.442_017, 9.891_432),
        (0.15, 0.9, 0.15, 8.893_570, 4.297_848),
    ] {
        let c = 0.5 * h;
        let (sin, cos) = f64::sin_cos(theta);
        // Spin n about the axis and Ω sin θ across it, for a body tilted towards +x.
        let omega = |round: f64, spin: f64| {
            [
                spin * sin - round * sin * cos,
                0.0,
                spin * cos + round * sin * sin,
            ]
        };
        for (round, spin, stiffness_n_m, time_s) in [
            (at_rest, at_rest * c / a * sin, 1e9, 0.05),
            (wobbling, -wobbling * (1.0 - cos), 1e8, 2.0 * PI / wobbling),
        ] {
            let object = cylinder(a, h, mass_kg, stiffness_n_m);
            let got =
                goes_round_at_rad_s(&object, &released(theta, 0.0, omega(round, spin), time_s));
            assert!(
                (got / round - 1.0).abs() < 0.02,
                "{a} {theta}: {got} {round}"
            );
        }
    }
}

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

#[test]
fn what_makes_no_history_is_refused() {
    let object = prism(0.5, 0.7, 1.8, 200.0, 4e6);
    let none = SpatialMotion::default();
    let is = |error: Result<SpatialRocking, CompliantError>, name: &str| {
        let text = error.unwrap_err().to_string();
        assert!(text.contains(name), "{text}");
    };
    is(
        rock_spatial(&object, none, &SpatialOptions::default()),
        "needs a motion",
    );
    is(
        rock_spatial(
            &SpatialObject {
                mass_kg: 0.0,
                ..object.clone()
            },
            none,
            &until(1.0),
        ),
        "mass",
    );
    is(
        rock_spatial(&prism(0.5, -0.7, 1.8, 200.0, 4e6), none, &until(1.0)),
        "width",
    );
    is(
        rock_spatial(&prism(0.5, 0.7, 1.8, 200.0, 4e3), none, &until(1.0)),
        "too soft",
    );
    is(
        rock_spatial(&object, none, &released(2.0, 0.0, [0.0; 3], 1.0)),
        "initial tilt",
    );
    let (short, long) = (pulse(0.1, 0.2, 0.0, 0.5), push());
    is(
        rock_spatial(&object, both(&short, &long), &until(1.0)),
        "differ",
    );
}

/// Without a push nothing moves, whatever the law.
#[test]
fn an_object_at_rest_stays_there() {
    let still = Motion::new(0.005, vec![0.0; 100]).unwrap();
    for object in [
        prism(0.5, 0.7, 1.8, 200.0, 4e6),
        cylinder(0.25, 1.8, 200.0, 4e6),
    ] {
        let got = rock(&object, along_x(&still));
        assert_eq!(
            (got.body.outcome, got.body.peak_tilt_rad, got.effort.steps),
            (Outcome::NoUplift, 0.0, 0)
        );
    }
}

fn stack(
    lower: (f64, f64, f64),
    upper: (f64, f64, f64),
    stiffness_n_m: f64,
    interface_n_m: f64,
) -> Stack {
    let body = |(height_m, thickness_m, mass_kg): (f64, f64, f64)| StackBody {
        height_m,
        thickness_m,
        mass_kg,
    };
    Stack {
        lower: body(lower),
        upper: body(upper),
        support: Support::new(Cushion::linear(stiffness_n_m).unwrap()),
        interface: Support::new(Cushion::linear(interface_n_m).unwrap()),
    }
}

fn rock_both(stack: &Stack, x: &Motion) -> StackRocking {
    rock_stack(
        stack,
        Base {
            horizontal: Some(x),
            vertical: None,
        },
        &within([Some(x), None, None]),
    )
    .unwrap()
}

fn alone(block: &Block, mass_kg: f64, stiffness_n_m: f64, x: &Motion) -> f64 {
    let base = CompliantBase::new(mass_kg, Cushion::linear(stiffness_n_m).unwrap());
    let motion = Base {
        horizontal: Some(x),
        vertical: None,
    };
    rock_compliant(
        block,
        &base,
        motion,
        &CompliantOptions {
            duration_s: Some(x.duration_s()),
            ..CompliantOptions::default()
        },
    )
    .unwrap()
    .peak_rotation_rad
}

/// min(b₂, B₁)/h₂ = 0.242/0.825, and (m₁ + m₂)B₁/[m₁H₁ + m₂(2H₁ + h₂)] by hand.
#[test]
fn thresholds_of_a_stack() {
    let both = stack((1.148, 0.379, 382.9), (0.825, 0.242, 95.8), 7.7e6, 1.1e6);
    assert!((both.threshold_upper() - 0.293_333_333).abs() < 1e-9);
    let by_hand = 478.7 * 0.379 / (382.9 * 1.148 + 95.8 * (2.296 + 0.825));
    assert!((both.threshold_together() - by_hand).abs() < 1e-12);
}

/// An upper body without weight: the pedestal alone. Its own share is 1e-8; 1e-5 is the steps of
/// two integrations.
#[test]
fn a_weightless_upper_body_changes_nothing() {
    let x = pulse(0.46, 0.72, 0.0, 0.6);
    let (mass_kg, stiffness_n_m) = (367.0, 7.515e6);
    let light = stack(
        (1.149, 0.363, mass_kg),
        (0.358, 0.287, 1e-8 * mass_kg),
        stiffness_n_m,
        0.06,
    );
    let expected = alone(
        &Block::uniform(1.149, 0.363).unwrap(),
        mass_kg,
        stiffness_n_m,
        &x,
    );
    let got = rock_both(&light, &x).lower.peak_tilt_rad;
    assert!(
        expected > 0.03 && (got / expected - 1.0).abs() < 1e-5,
        "{got} {expected}"
    );
}

/// On a wide, heavy and stiff pedestal the upper body rocks as alone on a floor; 1e-3: the pedestal
/// gives way by 1e-3 of the pads between them.
#[test]
fn a_heavy_pedestal_is_a_floor() {
    let x = pulse(0.5, 0.48, 0.0, 0.6);
    let on_rock = stack((0.5, 20.0, 1e6), (0.958, 0.259, 121.4), 1e12, 2.11e6);
    let expected = alone(&Block::uniform(0.958, 0.259).unwrap(), 121.4, 2.11e6, &x);
    let got = rock_both(&on_rock, &x);
    let error = got.upper.peak_tilt_rad / expected - 1.0;
    assert!(expected > 0.03 && error.abs() < 1e-3, "{got:?} {expected}");
    assert!(
        got.patterns.upper_alone_ratio > 0.5 && got.lower.peak_tilt_rad < 1e-6,
        "{got:?}"
    );
}

/// A squat upper body on stiff pads goes along with the lower one: one block with the common centre
/// of gravity and inertia, until the first landing. 2e-3: the pads between them are a hundred times
/// as stiff as those below.
#[test]
fn a_squat_upper_body_goes_along() {
    let x = pulse(0.46, 0.72, 0.0, 0.5);
    let (h1, b1, m1, h2, b2, m2) = (1.1, 0.4, 350.0, 0.2, 0.38, 45.0);
    let got = rock_both(&stack((h1, b1, m1), (h2, b2, m2), 7e6, 7e8), &x);
    let mass_kg = m1 + m2;
    let cg_m = (m1 * 0.5 * h1 + m2 * (h1 + 0.5 * h2)) / mass_kg;
    let about_edge =
        |m: f64, b: f64, h: f64, z: f64| m * ((b * b + h * h) / 12.0 + 0.25 * b1 * b1 + z * z);
    let inertia = about_edge(m1, b1, h1, 0.5 * h1) + about_edge(m2, b2, h2, h1 + 0.5 * h2);
    let block = Block::uniform(h1 + h2, b1)
        .unwrap()
        .with_cg_height(cg_m)
        .unwrap();
    let expected = alone(
        &block.with_inertia_per_mass(inertia / mass_kg).unwrap(),
        mass_kg,
        7e6,
        &x,
    );
    let error = got.lower.peak_tilt_rad / expected - 1.0;
    assert!(
        expected > 0.02 && error.abs() < 2e-3,
        "{} {expected}",
        got.lower.peak_tilt_rad
    );
    assert!(
        got.patterns.together_ratio > 0.2 && got.peak_relative_rotation_rad < 1e-3,
        "{got:?}"
    );
}

/// Mirror images (1e-5: one upper body begins to fall, and the 5e-8 with which events are located
/// grow with it); the shares of the patterns add up; the balance closes, with friction and
/// dashpots in both layers and with a lower body that is narrower than the upper one.
#[test]
fn stacks_keep_their_symmetry_and_energy() {
    let x = pulse(0.34, 0.59, 0.0, 1.0);
    let opposite = Motion::new(0.005, x.accel_m_s2().iter().map(|a| -a).collect()).unwrap();
    for (lower, upper) in [
        ((0.998, 0.37, 324.9), (0.792, 0.23, 94.9)),
        ((1.0, 0.3, 200.0), (0.2, 0.8, 60.0)),
        ((0.9, 0.3, 200.0), (0.6, 0.3, 90.0)),
    ] {
        let mut both = stack(lower, upper, 7.4e6, 1.3e6);
        for is_rough in [false, true] {
            if is_rough {
                let law = |k: f64, c: f64| {
                    Cushion::new(ContactLaw::KelvinVoigt {
                        stiffness_n_m: k,
                        damping_n_s_m: c,
                    })
                };
                both.support = Support {
                    friction_ratio: Some(0.4),
                    ..Support::new(law(7.4e6, 3e3).unwrap())
                };
                both.interface = Support {
                    friction_ratio: Some(0.25),
                    ..Support::new(law(1.3e6, 600.0).unwrap())
                };
            }
            let got = rock_both(&both, &x);
            // They ring without losses for a second: 1e-8 of each of some hundred vibrations.
            assert!(
                got.energy.residual_ratio < 1e-6,
                "{lower:?} {is_rough}: {:?}",
                got.energy
            );
            let p = got.patterns;
            let sum = p.rest_ratio
                + p.same_ratio
                + p.opposite_ratio
                + p.together_ratio
                + p.upper_alone_ratio;
            assert!((sum - 1.0).abs() < 1e-12 && p.rest_ratio < 0.9, "{p:?}");
            assert!(
                got.upper.peak_tilt_y_rad == 0.0 && got.lower.yaw_rad == 0.0,
                "{got:?}"
            );
            let mirrored = rock_both(&both, &opposite);
            assert!((got.lower.peak_tilt_x_rad + mirrored.lower.peak_tilt_x_rad).abs() < 1e-5);
            let apart = got.upper.peak_tilt_x_rad + mirrored.upper.peak_tilt_x_rad;
            assert!(apart.abs() < 1e-5, "{lower:?} {is_rough}: {apart:e}");
        }
    }
}

/// Which body falls, and how: a slender one tips over; a smooth one slides off.
#[test]
fn the_upper_body_falls() {
    let strong = pulse(0.9, 0.9, 0.0, 4.0);
    let slender = stack((0.5, 1.0, 400.0), (1.2, 0.2, 60.0), 8e6, 1.2e6);
    let got = rock_both(&slender, &strong);
    assert_eq!(
        (got.outcome, got.overturned_body),
        (Outcome::Overturned, Some(StackPart::Upper))
    );
    assert_eq!(got.upper.peak_tilt_rad, FRAC_PI_2);
    assert_eq!(
        got.lower.outcome,
        if got.lower.uplift_m > 0.0 {
            Outcome::Rocked
        } else {
            Outcome::NoUplift
        }
    );
    let mut smooth = stack((0.5, 0.6, 400.0), (0.3, 0.4, 60.0), 8e6, 1.2e6);
    smooth.interface.friction_ratio = Some(0.05);
    let got = rock_both(&smooth, &strong);
    assert_eq!(
        (got.outcome, got.overturned_body),
        (Outcome::Overturned, Some(StackPart::Upper))
    );
    assert!(got.energy.friction_j > 0.0, "{:?}", got.energy);
    let soft = stack((0.5, 0.6, 400.0), (1.3, 0.2, 60.0), 8e6, 2e3);
    let motion = Base {
        horizontal: Some(&strong),
        vertical: None,
    };
    assert!(matches!(
        rock_stack(&soft, motion, &until(1.0)),
        Err(CompliantError::Unstable { .. })
    ));
}

fn any_law() -> impl Strategy<Value = ContactLaw> {
    prop_oneof![
        (1e6..1e8f64).prop_map(|stiffness_n_m| ContactLaw::Linear { stiffness_n_m }),
        ((1e6..1e7f64), (0.0..1e4f64)).prop_map(|(stiffness_n_m, damping_n_s_m)| {
            ContactLaw::KelvinVoigt {
                stiffness_n_m,
                damping_n_s_m,
            }
        }),
        (1e8..1e9f64).prop_map(|coefficient_n_mn| ContactLaw::Power {
            coefficient_n_mn,
            exponent: 1.5
        }),
        (0.0..0.5f64).prop_map(|dissipation_s_m| ContactLaw::HuntCrossley {
            coefficient_n_mn: 2e8,
            exponent: 1.5,
            dissipation_s_m
        }),
        Just(ContactLaw::Tabulated {
            compressions_m: vec![0.0, 0.2e-3, 1e-3, 3e-3],
            forces_n: vec![0.0, 1.4e3, 8e3, 4e4]
        }),
    ]
}

fn any_support() -> impl Strategy<Value = Support> {
    let friction = prop_oneof![Just(None), Just(Some(0.0)), (0.05..1.2f64).prop_map(Some)];
    (any_law(), friction, 0.3..3.0f64).prop_map(
        |(law, friction_ratio, tangential_stiffness_ratio)| Support {
            cushion: Cushion::new(law).unwrap(),
            tangential_stiffness_ratio,
            friction_ratio,
        },
    )
}

/// 0.5 s of two sines.
fn shaking(amplitude_g: f64, frequency_hz: f64) -> Motion {
    let at = |index: usize| {
        let phase = 2.0 * PI * frequency_hz * 0.005 * index as f64;
        amplitude_g * G0_M_S2 * (phase.sin() + 0.3 * (3.7 * phase).sin())
    };
    Motion::new(0.005, (0..=100).map(at).collect()).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 60,
        failure_persistence: None,
        rng_seed: proptest::test_runner::RngSeed::Fixed(7),
        ..ProptestConfig::default()
    })]

    /// For any object, cushions, walls, start and motion in three directions the history reaches its
    /// end or the object overturns, in a number of steps that a user waits for, and the balance
    /// closes to 1e-4. Only cushions too soft to keep the object upright are refused.
    #[test]
    #[ignore = "seconds: objects at random"]
    fn any_object_is_followed_and_closes(
        support in any_support(),
        (h, t, w) in (0.5..2.5f64, 0.3..1.0f64, 0.3..1.0f64),
        (round, walls) in prop_oneof![Just((true, false)), Just((false, false)), Just((false, true))],
        (x, y, z, frequency) in (-1.2..1.2f64, -1.2..1.2f64, -1.3..1.3f64, 0.8..4.0f64),
        (tilt, toward, spin) in prop_oneof![Just((0.0, 0.0, 0.0)), (0.0..0.3f64, -3.0..3.0f64, -3.0..3.0f64)],
    ) {
        let shape = if round {
            Shape::Cylinder { diameter_m: t, height_m: h }
        } else {
            Shape::Prism { thickness_m: t, width_m: w, height_m: h }
        };
        let wall = |side, gap_m, height_m| Wall { side, gap_m, height_m, cushion: None };
        let walls = if walls {
            vec![wall(EdgeSide::Left, 0.02, f64::INFINITY), wall(EdgeSide::Right, 0.1, 0.6 * h)]
        } else {
            Vec::new()
        };
        let object = SpatialObject { shape, mass_kg: 200.0, support, walls };
        let (x, y, z) = (shaking(x, frequency), shaking(y, 1.3 * frequency), shaking(z, 2.0 * frequency));
        let motion = SpatialMotion { x: Some(&x), y: Some(&y), vertical: Some(&z) };
        let start = if tilt == 0.0 {
            SpatialStart::Rest
        } else {
            SpatialStart::Released { tilt_rad: tilt, toward_rad: toward, omega_rad_s: [0.2, 0.1 * spin, spin] }
        };
        let options = SpatialOptions { start, ..within([motion.x, motion.y, motion.vertical]) };
        let got = match rock_spatial(&object, motion, &options) {
            Ok(got) => got,
            Err(CompliantError::Unstable { .. }) => return Ok(()),
            Err(CompliantError::BeyondWall) => return Err(TestCaseError::reject("it starts beyond its wall")),
            Err(error) => return Err(TestCaseError::fail(format!("{error}: {object:?} {start:?}"))),
        };
        prop_assert!(got.energy.residual_ratio < 1e-4, "{:?} {:?}", got.energy, object);
        prop_assert!(got.energy.friction_j >= -1e-6 * got.energy.turnover_j, "{:?}", got.energy);
        prop_assert!(got.effort.steps < 50_000, "{:?} {:?}", got.effort, object);
        prop_assert_eq!(got.body.overturn_time_s.is_none(), (got.end_time_s - 0.5).abs() < 1e-12);
        prop_assert!(got.body.peak_tilt_rad <= FRAC_PI_2 && got.body.base_slide_peak_m.is_finite());
    }

    /// The same of stacks.
    #[test]
    fn any_stack_is_followed_and_closes(
        (support, interface) in (any_support(), any_support()),
        (h1, b1, m1) in (0.3..1.5f64, 0.3..1.0f64, 50.0..400.0f64),
        (h2, b2, m2) in (0.2..1.2f64, 0.1..1.2f64, 5.0..200.0f64),
        (x, z, frequency) in (-1.2..1.2f64, -1.3..1.3f64, 0.8..4.0f64),
    ) {
        let body = |height_m, thickness_m, mass_kg| StackBody { height_m, thickness_m, mass_kg };
        let stack = Stack { lower: body(h1, b1, m1), upper: body(h2, b2, m2), support, interface };
        let (x, z) = (shaking(x, frequency), shaking(z, 2.0 * frequency));
        let motion = Base { horizontal: Some(&x), vertical: Some(&z) };
        let got = match rock_stack(&stack, motion, &within([motion.horizontal, motion.vertical, None])) {
            Ok(got) => got,
            Err(CompliantError::Unstable { .. }) => return Ok(()),
            Err(error) => return Err(TestCaseError::fail(format!("{error}: {stack:?}"))),
        };
        prop_assert!(got.energy.residual_ratio < 1e-4, "{:?} {:?}", got.energy, stack);
        prop_assert!(got.effort.steps < 50_000, "{:?} {:?}", got.effort, stack);
        prop_assert_eq!(got.overturned_body.is_some(), got.end_time_s < 0.5 - 1e-12);
        prop_assert!(got.upper.peak_tilt_y_rad == 0.0 && got.lower.yaw_rad == 0.0);
    }
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

/// A push that ends while the object is beyond its balance point throws it over after the record, and
/// zeros after it change nothing; a time that was given ends it, open. One that stays upright rests.
#[test]
fn a_history_goes_on_until_the_object_rests_or_lies() {
    let law = ContactLaw::KelvinVoigt {
        stiffness_n_m: 4e6,
        damping_n_s_m: 5000.0,
    };
    let object = SpatialObject {
        shape: Shape::Prism {
            thickness_m: 0.4,
            width_m: 0.5,
            height_m: 1.8,
        },
        mass_kg: 200.0,
        support: Support::new(Cushion::new(law).unwrap()),
        walls: Vec::new(),
    };
    let half = |peak_g: f64, zeros: usize| {
        let half = (0..=40).map(|i| peak_g * G0_M_S2 * (PI * f64::from(i) / 40.0).sin());
        Motion::new(0.005, half.chain(std::iter::repeat_n(0.0, zeros)).collect()).unwrap()
    };
    let run = |motion: &Motion, duration_s: Option<f64>| {
        let options = SpatialOptions {
            duration_s,
            ..SpatialOptions::default()
        };
        rock_spatial(&object, along_x(motion), &options)
            .unwrap()
            .body
    };
    for (peak_g, outcome) in [
        (0.1, Outcome::NoUplift),
        (0.6, Outcome::Rocked),
        (3.0, Outcome::Overturned),
    ] {
        let (bare, padded) = (run(&half(peak_g, 0), None), run(&half(peak_g, 100), None));
        assert_eq!(
            (bare.outcome, padded.outcome),
            (outcome, outcome),
            "{peak_g} g"
        );
        // The steps of the padded history end at its samples.
        assert!(
            (bare.peak_tilt_rad / padded.peak_tilt_rad - 1.0).abs() < 1e-6,
            "{peak_g} g"
        );
    }
    assert_eq!(run(&half(3.0, 0), Some(0.2)).outcome, Outcome::Unresolved);
}
