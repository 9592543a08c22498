//! Two bodies, one upon the other.

use super::*;

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
