mod any;

use std::f64::consts::PI;

use super::*;
use crate::G0_M_S2;
use crate::block::Block;
use crate::cushion::{ContactLaw, Cushion};
use crate::impact::{ImpactModel, Landing};
use crate::motion::Motion;

/// The cabinet of Al Abadi et al.
const MASS_KG: f64 = 140.0;
const EDGE_N_M: f64 = 4.38e6;

fn cabinet() -> Block {
    Block::uniform(2.3, 0.6).unwrap()
}

fn springs(stiffness_n_m: f64) -> CompliantBase {
    CompliantBase::new(MASS_KG, Cushion::linear(stiffness_n_m).unwrap())
}

fn on(law: ContactLaw) -> CompliantBase {
    CompliantBase::new(MASS_KG, Cushion::new(law).unwrap())
}

/// Laws that carry the cabinet at about the stiffness of its pads.
fn laws() -> Vec<ContactLaw> {
    vec![
        ContactLaw::Linear {
            stiffness_n_m: EDGE_N_M,
        },
        ContactLaw::Power {
            coefficient_n_mn: 2e8,
            exponent: 1.5,
        },
        ContactLaw::Power {
            coefficient_n_mn: 5e5,
            exponent: 0.7,
        },
        ContactLaw::KelvinVoigt {
            stiffness_n_m: EDGE_N_M,
            damping_n_s_m: 2500.0,
        },
        ContactLaw::HuntCrossley {
            coefficient_n_mn: 2e8,
            exponent: 1.5,
            dissipation_s_m: 0.3,
        },
        ContactLaw::Tangent {
            stiffness_n_m: 2e6,
            bottoming_m: 8e-3,
        },
        ContactLaw::Tabulated {
            compressions_m: vec![0.0, 0.2e-3, 1e-3, 3e-3],
            forces_n: vec![0.0, 700.0, 4e3, 2e4],
        },
    ]
}

fn tilted(block: &Block, rise_m: f64, duration_s: f64) -> CompliantOptions {
    let rotation_rad = block.right_pivot().rotation_at_rise_rad(rise_m).unwrap();
    let start = Start::Tilted {
        rotation_rad,
        omega_rad_s: 0.0,
    };
    CompliantOptions {
        start,
        duration_s: Some(duration_s),
        ..CompliantOptions::default()
    }
}

fn released(block: &Block, base: &CompliantBase, rise_m: f64, duration_s: f64) -> CompliantRocking {
    rock_compliant(
        block,
        base,
        Base::default(),
        &tilted(block, rise_m, duration_s),
    )
    .unwrap()
}

/// The largest acceleration of the edge that lands first, divided by Eq. (5).
fn first_over_eq5(base: &CompliantBase, stiffness_n_m: f64, rise_m: f64) -> f64 {
    let got = released(&cabinet(), base, rise_m, 0.45);
    let paper = Landing::rocking(&cabinet(), ImpactModel::Paper).impact(
        MASS_KG,
        &springs(stiffness_n_m).cushion,
        rise_m,
        G0_M_S2,
    );
    got.touches[0].peak_acceleration_m_s2 / paper.edge_acceleration_m_s2
}

/// First peak divided by Eq. (5) for a release from 16 mm, from an independent program, to its two
/// digits (0.6 %: half a unit of the last digit, and the effect of 9.81 for 9.80665).
#[test]
fn shock_of_the_cabinet_over_equation_5() {
    for (scale, expected) in [
        (0.25, [0.80, 0.67, 0.75, 0.75]),
        (1.0, [0.83, 0.79, 0.86, 0.93]),
        (16.0, [0.96, 0.93, 1.00, 1.02]),
    ] {
        for (ratio, expected) in [0.5, 1.0, 10.0, 100.0].into_iter().zip(expected) {
            let stiffness_n_m = scale * EDGE_N_M;
            let base = CompliantBase {
                tangential_stiffness_ratio: ratio,
                ..springs(stiffness_n_m)
            };
            let got = first_over_eq5(&base, stiffness_n_m, 0.016);
            assert!((got - expected).abs() < 0.006, "{scale} {ratio}: {got}");
        }
    }
}

/// Eq. (5) is the limit of a stiff base whose landing edge does not move sideways. A dashpot of a
/// tenth of the critical one damps the tangential vibration, which would otherwise be superimposed.
/// What remains is the time that the edge takes to stop sideways, √(k/k_t) of the pulse: about 1 %
/// at 1000.
#[test]
fn equation_5_is_the_limit_of_a_stiff_base_that_grips() {
    let off = |scale: f64, ratio: f64| {
        let stiffness_n_m = scale * EDGE_N_M;
        let tangential_damping_n_s_m = 0.2 * (ratio * stiffness_n_m * MASS_KG).sqrt();
        let base = CompliantBase {
            tangential_stiffness_ratio: ratio,
            tangential_damping_n_s_m,
            ..springs(stiffness_n_m)
        };
        (first_over_eq5(&base, stiffness_n_m, 0.016) - 1.0).abs()
    };
    assert!(off(1.0, 1.0) > 0.1);
    assert!(off(256.0, 100.0) < 0.02, "{}", off(256.0, 100.0));
    assert!(off(4096.0, 1000.0) < 0.006, "{}", off(4096.0, 1000.0));
}

/// On the way to its first landing a block on a stiff base follows Housner: the quarter period
/// p·T/4 (α = 0.2, θ₀ = α/2: 1.31850440) and ω² = 2p²[cos(α−θ₀) − cos(α−θ)] of the energy. The pads
/// compress by m g/k = 1e-8 m, which is 3e-7 of the uplift.
#[test]
fn a_stiff_base_lets_the_block_rock_as_housners() {
    let block = Block::uniform(0.6 / 0.2f64.tan(), 0.6).unwrap();
    let pivot = block.right_pivot();
    let p = pivot.frequency_parameter_rad_s(G0_M_S2);
    let base = springs(1e11);
    let start = Start::Tilted {
        rotation_rad: 0.1,
        omega_rad_s: 0.0,
    };
    let options = CompliantOptions {
        start,
        duration_s: Some(1.4 / p),
        ..CompliantOptions::default()
    };
    let mut worst = 0.0f64;
    let mut landed = false;
    let history = rock_compliant_observed(&block, &base, Base::default(), &options, |piece| {
        landed |= piece
            .contact(0, 0.0)
            .is_some_and(|(_, normal_n, _)| normal_n > 0.0);
        let (theta, omega) = piece.rotation(0.0);
        if !landed {
            let fall = 2.0 * (0.2 - 0.05 - 0.5 * theta).sin() * (0.05 - 0.5 * theta).sin();
            worst = worst.max((omega + p * (2.0 * fall.abs()).sqrt()).abs());
        }
    })
    .unwrap();
    // The release takes weight off the pad suddenly, which leaves it ringing at √(k/m) = 3e4 rad/s
    // with 1e-8 m.
    assert!(worst < 1e-3 * p * 0.1, "{worst}");
    assert!(
        (p * history.touches[0].time_s - 1.318_504_40).abs() < 2e-6,
        "{}",
        p * history.touches[0].time_s
    );
}

/// Energy balance for every law with and without friction, damping and elements along the base:
/// 1e-6 of the turnover. The largest errors come from laws with a root at first contact; springs
/// reach 1e-8.
#[test]
fn the_energy_balance_closes() {
    for law in laws() {
        let is_smooth = matches!(
            law,
            ContactLaw::Linear { .. } | ContactLaw::KelvinVoigt { .. }
        );
        let limit = if is_smooth { 2e-8 } else { 1e-6 };
        for (friction_ratio, tangential_damping_n_s_m, contacts) in [
            (None, 0.0, 2),
            (Some(0.3), 0.0, 2),
            (Some(0.2), 3000.0, 2),
            (None, 1000.0, 3),
            (Some(0.1), 0.0, 5),
        ] {
            let base = CompliantBase {
                friction_ratio,
                tangential_damping_n_s_m,
                contacts,
                ..on(law.clone())
            };
            let got = released(&cabinet(), &base, 0.016, 1.0);
            let energy = got.energy;
            assert!(energy.residual_ratio < limit, "{base:?} {energy:?}");
            assert!(
                (energy.friction_j > 0.0) == friction_ratio.is_some(),
                "{base:?} {energy:?}"
            );
            assert!(
                (energy.tangential_dissipation_j > 0.0) == (tangential_damping_n_s_m > 0.0),
                "{base:?}"
            );
            assert!(
                (energy.cushion_dissipation_j > 0.0) == base.cushion.law().is_damped(),
                "{base:?}"
            );
        }
    }
}

/// The errors of the peak and of the end decrease with the tolerance, as they do in a fifth-order
/// method with a controlled error per step; the reference is 1e-13.
#[test]
fn the_error_follows_the_tolerance() {
    let at = |tolerance| {
        let accuracy = CompliantAccuracy::Tolerance(tolerance);
        let options = CompliantOptions {
            accuracy,
            ..tilted(&cabinet(), 0.016, 1.0)
        };
        let got =
            rock_compliant(&cabinet(), &springs(EDGE_N_M), Base::default(), &options).unwrap();
        (
            got.peak_edge_acceleration_m_s2(),
            got.final_rotation_rad,
            got.effort,
        )
    };
    let (peak, end, _) = at(1e-13);
    let error = |tolerance| {
        let (a, b, _) = at(tolerance);
        (a / peak - 1.0).abs().max((b / end - 1.0).abs())
    };
    for (tolerance, most) in [(1e-5, 2e-4), (1e-8, 2e-7), (1e-11, 2e-10)] {
        assert!(error(tolerance) < most, "{tolerance}: {}", error(tolerance));
    }
    let order = (error(1e-6) / error(1e-11)).log10() / 5.0;
    assert!((0.8..1.2).contains(&order), "{order}");
    // Fifth order: ten times the accuracy takes 10^(1/5) times the steps.
    let growth = (at(1e-12).2.steps as f64 / at(1e-9).2.steps as f64).powf(1.0 / 3.0);
    assert!((1.45..1.7).contains(&growth), "{growth}");
}

/// A flat fall on two cushions is the fall of one mass: F/m = g√(1+2h/δ) + g on springs (δ =
/// mg/2k), the root of 2K dⁿ⁺¹/(n+1) = m g(h+d) on power laws, and the history of the cushion under
/// one mass for damped ones (1e-8 of the force).
#[test]
fn a_flat_fall_is_the_landing_of_one_mass() {
    let height_m = 0.02;
    let weight_n = MASS_KG * G0_M_S2;
    let options = CompliantOptions {
        start: Start::Dropped { height_m },
        duration_s: Some(0.12),
        accuracy: CompliantAccuracy::Tolerance(1e-10),
        ..CompliantOptions::default()
    };
    for law in laws() {
        let base = on(law.clone());
        let got = rock_compliant(&cabinet(), &base, Base::default(), &options).unwrap();
        let speed_m_s = (2.0 * G0_M_S2 * height_m).sqrt();
        let both = base.cushion.side_by_side(2);
        let history = both.landing_history(MASS_KG, speed_m_s, G0_M_S2);
        let peak_n = match law {
            ContactLaw::Linear { stiffness_n_m } => {
                weight_n * (1.0 + (1.0 + 4.0 * stiffness_n_m * height_m / weight_n).sqrt())
            }
            ContactLaw::Power {
                coefficient_n_mn,
                exponent: n,
            } => {
                let work = |d: f64| {
                    2.0 * coefficient_n_mn * d.powf(n + 1.0) / (n + 1.0) - weight_n * (height_m + d)
                };
                let d = crate::search::bisect(1e-6, 1.0, |d| work(d) >= 0.0);
                2.0 * coefficient_n_mn * d.powf(n)
            }
            _ => history
                .iter()
                .map(|point| point.force_n)
                .fold(0.0, f64::max),
        };
        let touch = got.touches[0];
        let name = law.name();
        // Peaks between the samples of the reference: (π/4000)²/8 = 8e-8.
        assert!(
            (2.0 * touch.peak_force_n / peak_n - 1.0).abs() < 3e-7,
            "{name}: {} {peak_n}",
            touch.peak_force_n
        );
        let a = peak_n / MASS_KG - G0_M_S2;
        assert!(
            (touch.peak_acceleration_m_s2 / a - 1.0).abs() < 4e-7,
            "{name}"
        );
        assert!(
            (touch.time_s - (2.0 * height_m / G0_M_S2).sqrt()).abs() < 1e-9,
            "{name}"
        );
        let last = history.last().unwrap();
        // The reference ends between two of its steps.
        assert!(
            (touch.end_time_s.unwrap() - touch.time_s - last.time_s).abs() < 2e-4 * last.time_s,
            "{name}"
        );
        assert!(
            (touch.rebound_m_s.unwrap() + last.speed_m_s).abs() < 3e-4 * speed_m_s,
            "{name}"
        );
        assert!(
            got.peak_rotation_rad < 1e-12,
            "{name}: {}",
            got.peak_rotation_rad
        );
        assert_eq!(got.outcome, crate::rocking::Outcome::Rocked);
    }
    // Five elements that share the cushions behave as two do.
    let two = rock_compliant(&cabinet(), &springs(EDGE_N_M), Base::default(), &options).unwrap();
    let five = CompliantBase {
        contacts: 5,
        ..springs(EDGE_N_M)
    };
    let five = rock_compliant(&cabinet(), &five, Base::default(), &options).unwrap();
    assert!(
        (five.peak_edge_acceleration_m_s2() / two.peak_edge_acceleration_m_s2() - 1.0).abs() < 1e-9
    );
}

/// A motion of a few half-sines, not symmetric.
fn shaking(factor: f64) -> Motion {
    let a = |i: i32| {
        let t = f64::from(i) * 0.01;
        factor
            * G0_M_S2
            * (0.35 * (2.0 * PI * t).sin() + 0.15 * (5.0 * PI * t).sin())
            * (-0.3 * t).exp()
    };
    Motion::new(0.01, (0..=300).map(a).collect()).unwrap()
}

/// Without a motion, or with a motion of zeros, a block at rest stays exactly at rest.
#[test]
fn nothing_moves_a_body_at_rest() {
    let zero = Motion::new(0.01, vec![0.0; 101]).unwrap();
    for law in laws() {
        let block = cabinet().with_cg_offset(0.1).unwrap();
        let base = CompliantBase {
            contacts: 3,
            friction_ratio: Some(0.3),
            ..on(law)
        };
        let rest = equilibrium(&block, &base, G0_M_S2).unwrap();
        let motion = Base {
            horizontal: Some(&zero),
            vertical: None,
        };
        let got = rock_compliant(&block, &base, motion, &CompliantOptions::default()).unwrap();
        assert_eq!(got.final_rotation_rad, rest.rotation_rad);
        assert_eq!(
            (
                got.final_omega_rad_s,
                got.uplift_m,
                got.peak_edge_accelerations_m_s2
            ),
            (0.0, 0.0, [0.0; 2])
        );
        assert_eq!(got.outcome, crate::rocking::Outcome::NoUplift);
    }
    // The same where the equation is integrated, because the base moves a little later.
    let later = Motion::new(0.5, vec![0.0, 0.0, 1e-12]).unwrap();
    let motion = Base {
        horizontal: Some(&later),
        vertical: None,
    };
    let got = rock_compliant(
        &cabinet(),
        &springs(EDGE_N_M),
        motion,
        &CompliantOptions::default(),
    )
    .unwrap();
    assert!(got.peak_rotation_rad < 1e-12 && got.outcome == crate::rocking::Outcome::NoUplift);
}

/// Statics by hand: the forces of the edges are m g times the arm of the other edge divided by B,
/// up to the effect of the rotation on the arms (h θ of 0.3 m), and their moment about the centre
/// of gravity is zero with the exact arms.
#[test]
fn a_body_rests_where_forces_and_moments_balance() {
    for law in laws() {
        let block = cabinet().with_cg_offset(0.12).unwrap();
        let base = on(law);
        let rest = equilibrium(&block, &base, G0_M_S2).unwrap();
        let [left, right] = rest.compressions_m.map(|d| base.cushion.force_n(d, 0.0));
        assert!(
            ((left + right) / (MASS_KG * G0_M_S2) - 1.0).abs() < 1e-12,
            "{base:?}"
        );
        let (sin, cos) = rest.rotation_rad.sin_cos();
        let arm = |from_cg: f64| from_cg * cos - 1.15 * sin;
        assert!(
            (left * arm(-0.42) + right * arm(0.18)).abs() < 1e-11 * MASS_KG * G0_M_S2,
            "{base:?}"
        );
        assert!(
            rest.rotation_rad > 0.0 && (right / left - 0.42 / 0.18).abs() < 0.1 * right / left,
            "{base:?}"
        );
    }
}

/// To the last sample: what follows on undamped pads amplifies rounding.
fn within(motion: &Motion) -> CompliantOptions {
    CompliantOptions {
        duration_s: Some(motion.duration_s()),
        ..CompliantOptions::default()
    }
}

#[test]
fn the_mirror_image_does_the_mirrored() {
    let block = cabinet().with_cg_offset(0.05).unwrap();
    let base = CompliantBase {
        friction_ratio: Some(0.4),
        ..springs(EDGE_N_M)
    };
    let run = |block: &Block, factor: f64| {
        let motion = shaking(factor);
        let base_motion = Base {
            horizontal: Some(&motion),
            vertical: None,
        };
        let options = CompliantOptions {
            points_m: vec![(0.3, 1.0)],
            ..within(&motion)
        };
        rock_compliant(block, &base, base_motion, &options).unwrap()
    };
    let (one, other) = (run(&block, 1.0), run(&block.mirrored(), -1.0));
    assert!(
        one.uplift_m > 0.0 && one.outcome == other.outcome,
        "{:?}",
        one.outcome
    );
    // Both sum from left to right: a rounding difference that the impacts amplify.
    assert!(
        (one.final_rotation_rad + other.final_rotation_rad).abs() < 1e-6 * one.peak_rotation_rad
    );
    let [a, b] = one.peak_edge_accelerations_m_s2;
    let [c, d] = other.peak_edge_accelerations_m_s2;
    assert!(
        (a / d - 1.0).abs() < 1e-6 && (b / c - 1.0).abs() < 1e-6,
        "{a} {b} {c} {d}"
    );
    assert!((one.peak_rotation_rad / other.peak_rotation_rad - 1.0).abs() < 1e-8);
    assert_eq!(one.touches.len(), other.touches.len());
}

/// All lengths four times, times twice, the same accelerations: the stiffness for which the weight
/// compresses the pads four times as much. Powers of two keep every bit the same.
#[test]
fn similar_bodies_do_similar_things() {
    let run = |scale: f64| {
        let block = Block::uniform(2.3 * scale, 0.6 * scale).unwrap();
        let base = CompliantBase {
            friction_ratio: Some(0.3),
            ..springs(EDGE_N_M / scale)
        };
        let slow = shaking(1.0);
        let motion = Motion::new(slow.dt_s() * scale.sqrt(), slow.accel_m_s2().to_vec()).unwrap();
        let base_motion = Base {
            horizontal: Some(&motion),
            vertical: None,
        };
        rock_compliant(&block, &base, base_motion, &within(&motion)).unwrap()
    };
    let (one, four) = (run(1.0), run(4.0));
    assert_eq!(one.peak_rotation_rad, four.peak_rotation_rad);
    assert_eq!(
        one.peak_edge_accelerations_m_s2,
        four.peak_edge_accelerations_m_s2
    );
    assert_eq!(
        (4.0 * one.uplift_m, one.touches.len()),
        (four.uplift_m, four.touches.len())
    );
    assert!(one.uplift_m > 0.01 && one.energy.friction_j > 0.0);
}

/// With k_t = k, friction of 0.5 and more changes the first peak by little more than 1 %; friction
/// of 0.3 on a soft base changes it by 2 %.
#[test]
fn friction_hardly_changes_the_shock() {
    for scale in [0.25, 1.0, 16.0] {
        let base = springs(scale * EDGE_N_M);
        let grips = first_over_eq5(&base, scale * EDGE_N_M, 0.016);
        for (friction, most) in [(0.3, 0.02), (0.5, 0.012), (1.0, 0.012)] {
            let slips = CompliantBase {
                friction_ratio: Some(friction),
                ..base.clone()
            };
            let got = first_over_eq5(&slips, scale * EDGE_N_M, 0.016) / grips;
            assert!((got - 1.0).abs() < most, "{scale} {friction}: {got}");
        }
    }
}

/// Without friction nothing holds the block sideways: its centre of gravity stays where it is and
/// the base slides under it.
#[test]
fn a_base_without_friction_slides_away() {
    let base = CompliantBase {
        friction_ratio: Some(0.0),
        ..springs(EDGE_N_M)
    };
    let push = Motion::new(0.1, vec![2.0; 11]).unwrap();
    let motion = Base {
        horizontal: Some(&push),
        vertical: None,
    };
    let mut last = (0.0, 0.0);
    let got = rock_compliant_observed(&cabinet(), &base, motion, &within(&push), |piece| {
        last = piece.displacement_m(1.0);
    })
    .unwrap();
    // −½ a t² after 1 s, which the contacts slide as well.
    assert!(
        (last.0 + 1.0).abs() < 1e-9 && (got.slid_m - 2.0).abs() < 1e-6,
        "{last:?} {}",
        got.slid_m
    );
    assert!(
        got.peak_rotation_rad < 1e-9 && got.energy.friction_j.abs() < 1e-12,
        "{got:?}"
    );
}

/// Released beyond the balance point it overturns, on any cushion; released just within it, it does
/// not.
#[test]
fn a_body_falls_beyond_the_balance_point() {
    let alpha = cabinet().pivot().slenderness_angle_rad;
    for (share, falls) in [(1.05, true), (0.9, false), (-1.05, true)] {
        let start = Start::Tilted {
            rotation_rad: share * alpha,
            omega_rad_s: 0.0,
        };
        let options = CompliantOptions {
            start,
            duration_s: Some(5.0),
            ..CompliantOptions::default()
        };
        let got =
            rock_compliant(&cabinet(), &springs(EDGE_N_M), Base::default(), &options).unwrap();
        assert_eq!(got.overturn_time_s.is_some(), falls, "{share}");
        if falls {
            assert_eq!(
                (got.outcome, got.peak_rotation_rad),
                (crate::rocking::Outcome::Overturned, PI / 2.0)
            );
        }
        assert!(got.energy.residual_ratio < 1e-7);
    }
}

/// On soft pads a block sways: it rotates, and neither edge leaves its pad. That is not uplift.
#[test]
fn swaying_is_not_uplift() {
    let motion = shaking(0.2);
    let base_motion = Base {
        horizontal: Some(&motion),
        vertical: None,
    };
    let got = rock_compliant(
        &cabinet(),
        &springs(0.25 * EDGE_N_M),
        base_motion,
        &CompliantOptions::default(),
    )
    .unwrap();
    assert!(got.peak_rotation_rad > 1e-4);
    assert_eq!(
        (got.outcome, got.uplift_m, got.cg_rise_m),
        (crate::rocking::Outcome::NoUplift, 0.0, 0.0)
    );
    assert!(got.touches.is_empty() && got.first_uplift_time_s.is_none());
}

/// Vertical motion alone: the block on its pads is an oscillator of √(2k/m) = 250 rad/s. Under a
/// constant −½ g it settles at half its compression at rest, and a step overshoots by as much
/// again, so N per edge is between 0 and half the weight.
#[test]
fn the_base_may_move_up_and_down() {
    let motion = Motion::new(0.001, [vec![0.0], vec![-0.5 * G0_M_S2; 200]].concat()).unwrap();
    let base_motion = Base {
        horizontal: None,
        vertical: Some(&motion),
    };
    let got = rock_compliant(
        &cabinet(),
        &springs(EDGE_N_M),
        base_motion,
        &within(&motion),
    )
    .unwrap();
    assert_eq!(got.outcome, crate::rocking::Outcome::NoUplift);
    // The ramp of 1 ms reduces the overshoot by (ωt)²/24 = 0.3 %, so the acceleration swings
    // between −g and 0.
    assert!(got.peak_edge_acceleration_m_s2() < 0.01 * G0_M_S2);
    let half_n = 0.5 * MASS_KG * G0_M_S2;
    assert!(
        (got.peak_edge_forces_n[0] / half_n - 1.0).abs() < 1e-6,
        "{}",
        got.peak_edge_forces_n[0] / half_n
    );
    assert!(got.energy.residual_ratio < 1e-7);
}

/// Points of a rigid block: points at the edges have the accelerations of the edges, and the middle
/// of the base has their mean.
#[test]
fn points_of_the_body_follow_its_edges() {
    let options = tilted(&cabinet(), 0.016, 0.5);
    let mut worst = 0.0f64;
    rock_compliant_observed(
        &cabinet(),
        &springs(EDGE_N_M),
        Base::default(),
        &options,
        |piece| {
            let at = |x| piece.acceleration_m_s2(x, 0.0, 0.37).1;
            worst = worst.max((0.5 * (at(0.0) + at(0.6)) - at(0.3)).abs());
        },
    )
    .unwrap();
    assert!(worst < 1e-10);
    let mut recorder = CompliantRecorder::new(0.001, 0.6, &[(0.0, 0.0), (0.6, 2.3)], 2);
    let got = rock_compliant_observed(
        &cabinet(),
        &springs(EDGE_N_M),
        Base::default(),
        &options,
        |piece| {
            recorder.observe(piece);
        },
    )
    .unwrap();
    let points = recorder.finish(&got);
    assert_eq!(points.len(), 501);
    for (index, point) in points.iter().enumerate() {
        assert!((point.time_s - 0.001 * index as f64).abs() < 1e-12);
        assert_eq!(
            point.point_accelerations_m_s2[0].1,
            point.edge_accelerations_m_s2[0]
        );
        // Newton: the forces accelerate the centre of gravity, which is half-way between opposite
        // corners.
        let up: f64 = point.contact_forces_n.iter().map(|f| f.1).sum();
        let mean =
            0.5 * (point.point_accelerations_m_s2[0].1 + point.point_accelerations_m_s2[1].1);
        assert!(
            (up / MASS_KG - G0_M_S2 - mean).abs() < 1e-9 * (1.0 + mean.abs()),
            "{point:?}"
        );
    }
}

#[test]
fn what_makes_no_history_is_refused() {
    let block = cabinet();
    let run = |base: &CompliantBase, options: &CompliantOptions| {
        rock_compliant(&block, base, Base::default(), options)
    };
    let good = tilted(&block, 0.016, 0.1);
    let error = |base: CompliantBase| run(&base, &good).unwrap_err();
    assert!(matches!(
        error(CompliantBase {
            mass_kg: f64::NAN,
            ..springs(1e6)
        }),
        CompliantError::Value { .. }
    ));
    assert!(matches!(
        error(CompliantBase {
            friction_ratio: Some(-0.1),
            ..springs(1e6)
        }),
        CompliantError::Value { .. }
    ));
    assert_eq!(
        error(CompliantBase {
            contacts: 1,
            ..springs(1e6)
        }),
        CompliantError::Contacts { contacts: 1 }
    );
    assert_eq!(
        error(CompliantBase {
            contacts: 17,
            ..springs(1e6)
        }),
        CompliantError::Contacts { contacts: 17 }
    );
    let none = CompliantOptions {
        duration_s: None,
        ..good.clone()
    };
    assert!(matches!(
        run(&springs(1e6), &none),
        Err(CompliantError::Duration { .. })
    ));
    let flat = Start::Tilted {
        rotation_rad: PI,
        omega_rad_s: 0.0,
    };
    let flat = CompliantOptions {
        start: flat,
        ..good.clone()
    };
    assert!(matches!(
        run(&springs(1e6), &flat),
        Err(CompliantError::Value { .. })
    ));
    // k B²/2 = m g z at 8770 N/m: below it the block has no stable upright position.
    let rest = CompliantOptions {
        start: Start::Rest,
        ..good.clone()
    };
    assert!(matches!(
        run(&springs(8_000.0), &rest),
        Err(CompliantError::Unstable { .. })
    ));
    assert!(run(&springs(9_500.0), &rest).is_ok());
    let (short, long) = (
        Motion::new(0.01, vec![0.0; 3]).unwrap(),
        Motion::new(0.01, vec![0.0; 4]).unwrap(),
    );
    let both = Base {
        horizontal: Some(&short),
        vertical: Some(&long),
    };
    assert_eq!(
        rock_compliant(&block, &springs(1e6), both, &rest),
        Err(CompliantError::VerticalMismatch)
    );
}

/// A half-sine of 0.2 s that throws the block beyond its balance point within the record is followed
/// until it lies; zeros after it change nothing; a time that was given ends it, open.
#[test]
fn a_history_goes_on_until_the_block_rests_or_lies() {
    let pads = damped_springs();
    let pulse = |peak_g: f64, zeros: usize| {
        let half = (0..=40).map(|i| peak_g * G0_M_S2 * (PI * f64::from(i) / 40.0).sin());
        Motion::new(0.005, half.chain(std::iter::repeat_n(0.0, zeros)).collect()).unwrap()
    };
    let run = |motion: &Motion, duration_s: Option<f64>| {
        let options = CompliantOptions {
            duration_s,
            ..CompliantOptions::default()
        };
        rock_compliant(
            &cabinet(),
            &pads,
            Base {
                horizontal: Some(motion),
                vertical: None,
            },
            &options,
        )
        .unwrap()
    };
    use crate::rocking::Outcome;
    let mut seen = Vec::new();
    for peak_g in [0.1, 0.8, 4.0] {
        let (bare, padded) = (run(&pulse(peak_g, 0), None), run(&pulse(peak_g, 200), None));
        assert_eq!(bare.outcome, padded.outcome, "{peak_g} g");
        // The steps of the padded history end at its samples.
        assert!(
            (bare.peak_rotation_rad / padded.peak_rotation_rad - 1.0).abs() < 1e-6,
            "{peak_g} g"
        );
        seen.push(bare.outcome);
    }
    assert_eq!(
        seen,
        [Outcome::NoUplift, Outcome::Rocked, Outcome::Overturned]
    );
    assert_eq!(run(&pulse(4.0, 0), Some(0.2)).outcome, Outcome::Unresolved);
}

fn damped_springs() -> CompliantBase {
    let law = ContactLaw::KelvinVoigt {
        stiffness_n_m: EDGE_N_M,
        damping_n_s_m: 0.1 * (EDGE_N_M * MASS_KG).sqrt(),
    };
    CompliantBase::new(MASS_KG, Cushion::new(law).unwrap())
}
