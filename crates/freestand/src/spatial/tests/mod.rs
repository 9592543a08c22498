mod any;
mod stacks;
mod walls;

use std::f64::consts::{FRAC_PI_2, PI};

use super::element::Grip;
use super::equation::{Grips, Line};
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
        let y = together.released(crate::space::tilted(0.05, 0.7), [0.2, -0.1, 0.4]);
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
        let stored = |world: &World<'_>| {
            let grips = Grips::new(world, grips.clone());
            world.energies(&grips, &y, &world.poses(&y)).stored_j
        };
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
