//! Drops of the virtual laboratory give what their pads are.

use super::tests::{MASS_KG, STIFFNESS_N_M, fall_m_s, interval, setup, virtual_options};
use super::*;
use crate::G0_M_S2;
use crate::cushion::Cushion;

/// 95 % of the intervals contain the stiffness. Of 40 virtual drops, 34 is three standard
/// deviations below 38.
#[test]
#[ignore = "a minute: 120 drops"]
fn intervals_cover() {
    let laws = [
        ContactLaw::Linear {
            stiffness_n_m: STIFFNESS_N_M,
        },
        ContactLaw::Power {
            coefficient_n_mn: 2e7,
            exponent: 1.5,
        },
        ContactLaw::KelvinVoigt {
            stiffness_n_m: STIFFNESS_N_M,
            damping_n_s_m: 90.0,
        },
    ];
    for law in laws {
        let cushion = Cushion::new(law).unwrap();
        let history = cushion.landing_history(MASS_KG, fall_m_s(), G0_M_S2);
        let deepest_m = history.iter().map(|p| p.compression_m).fold(0.0, f64::max);
        let truth_n_m = cushion.force_n(deepest_m, 0.0) / deepest_m;
        let held = (0..40).filter(|&index| {
            let drop = virtual_drop(&cushion, &virtual_options(index)).unwrap();
            let found = drop_test(&drop.samples_m_s2, drop.dt_s, &setup(true))
                .unwrap()
                .identified
                .unwrap();
            let (low, high) = interval(&found);
            low <= truth_n_m && truth_n_m <= high
        });
        let count = held.count();
        assert!(count >= 34, "{count} {cushion:?}");
    }
}

/// A virtual drop depends only on its seed and number; a bounce is found from its flight.
#[test]
fn virtual_drops_bounce() {
    let c = 0.2 * (STIFFNESS_N_M * MASS_KG).sqrt();
    let pad = Cushion::new(ContactLaw::KelvinVoigt {
        stiffness_n_m: STIFFNESS_N_M,
        damping_n_s_m: c,
    })
    .unwrap();
    let options = VirtualDropOptions {
        bounces: 1,
        noise_ratio: 0.002,
        ..virtual_options(4)
    };
    let drop = virtual_drop(&pad, &options).unwrap();
    assert_eq!(Some(&drop), virtual_drop(&pad, &options).as_ref());
    assert_ne!(
        Some(&drop),
        virtual_drop(&pad, &virtual_options(5)).as_ref()
    );
    let test = drop_test(&drop.samples_m_s2, drop.dt_s, &setup(true)).unwrap();
    assert_eq!(test.flags, []);
    // The flight begins where the force ends, some 0.1 mm below the surface; e itself is accurate
    // to the noise.
    assert!((test.restitution_bounce_ratio.unwrap() / drop.restitution_ratio - 1.0).abs() < 0.01);
    assert!((test.restitution_ratio.unwrap() / drop.restitution_ratio - 1.0).abs() < 0.01);
}

/// Four drops in one record, each with a bounce and half a second of handling at rest (+1 g) before
/// the next one falls; the second from another height. Each gives the numbers of its own record.
#[test]
#[ignore = "ten seconds: many fits"]
fn several_drops_of_a_record_are_told_from_bounces() {
    several_drops(true);
}

/// The same where nobody states the velocity.
#[test]
#[ignore = "seconds: four drops"]
fn several_drops_of_unknown_velocity_are_told_from_bounces() {
    several_drops(false);
}

fn several_drops(known: bool) {
    let c = 0.2 * (STIFFNESS_N_M * MASS_KG).sqrt();
    let pad = Cushion::new(ContactLaw::KelvinVoigt {
        stiffness_n_m: STIFFNESS_N_M,
        damping_n_s_m: c,
    })
    .unwrap();
    let (mut record, mut alone) = (Vec::new(), Vec::new());
    for index in 0..4 {
        let speed_m_s = if index == 1 && !known {
            1.5 * fall_m_s()
        } else {
            fall_m_s()
        };
        let options = VirtualDropOptions {
            bounces: 1,
            noise_ratio: 0.002,
            pre_trigger_s: 0.05,
            speed_m_s,
            ..virtual_options(index)
        };
        let drop = virtual_drop(&pad, &options).unwrap();
        let rest = vec![drop.samples_m_s2[0] + G0_M_S2; (0.5 / drop.dt_s) as usize];
        record.extend(rest);
        let starts_s = (record.len() as f64 * drop.dt_s) + 0.05;
        record.extend_from_slice(&drop.samples_m_s2);
        alone.push((
            starts_s,
            drop_test(&drop.samples_m_s2, drop.dt_s, &setup(known)).unwrap(),
            drop,
        ));
    }
    let dt_s = alone[0].2.dt_s;
    let found = drop_tests(&record, dt_s, &setup(known)).unwrap();
    assert_eq!(found.len(), 4, "{known}");
    for (one, (starts_s, single, drop)) in found.iter().zip(&alone) {
        // The pulse has risen to a fifth within a tenth of the contact.
        assert!((one.start_time_s.unwrap() - starts_s).abs() < 0.1 * drop.contact_s + 2.0 * dt_s);
        let [k, alone] =
            [&one.test, single].map(|test| test.identified.as_ref().unwrap().stiffness.fit_n_m);
        // The same samples of the contact; only the window of the zero line differs: noise.
        assert!((k / alone - 1.0).abs() < 0.01, "{known}: {k} {alone}");
        for e in [
            one.test.restitution_ratio,
            one.test.restitution_bounce_ratio,
        ] {
            // As in `virtual_drops_bounce`; an unknown velocity is known to some per cent.
            assert!(
                (e.unwrap() / drop.restitution_ratio - 1.0).abs() < if known { 0.02 } else { 0.06 },
                "{e:?}"
            );
        }
    }
    // One drop with its bounce stays one.
    let single = drop_tests(&alone[0].2.samples_m_s2, dt_s, &setup(known)).unwrap();
    assert_eq!((single.len(), &single[0].test), (1, &alone[0].1));
}

/// Without a bounce rule, the flight between two drops would be read as a restitution of 3.5.
#[test]
#[ignore = "seconds: several drops"]
fn no_restitution_is_above_one() {
    let drop = virtual_drop(
        &Cushion::linear(STIFFNESS_N_M).unwrap(),
        &virtual_options(1),
    )
    .unwrap();
    let mut record = drop.samples_m_s2.clone();
    // e = gT/(2v) = 3.5.
    let rest_s = 3.5 * 2.0 * fall_m_s() / G0_M_S2;
    record.extend(vec![drop.samples_m_s2[0]; (rest_s / drop.dt_s) as usize]);
    record.extend_from_slice(&drop.samples_m_s2);
    assert_eq!(
        drop_test(&record, drop.dt_s, &setup(true))
            .unwrap()
            .restitution_bounce_ratio,
        None
    );
    let found = drop_tests(&record, drop.dt_s, &setup(true)).unwrap();
    assert_eq!(found.len(), 2);
    assert!(
        found
            .iter()
            .all(|one| one.test.restitution_ratio.is_some_and(|e| e <= 1.0))
    );
}
