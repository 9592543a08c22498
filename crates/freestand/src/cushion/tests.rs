use std::f64::consts::PI;

use super::*;
use crate::G0_M_S2;

fn of(law: ContactLaw) -> Cushion {
    Cushion::new(law).unwrap()
}

/// Plates of 0.365 kg, with the speed after a fall of 100 mm.
const MASS_KG: f64 = 0.365;

fn fall_m_s() -> f64 {
    (2.0 * G0_M_S2 * 0.1).sqrt()
}

fn laws() -> Vec<Cushion> {
    let table = ContactLaw::Tabulated {
        compressions_m: vec![0.0, 0.2e-3, 0.4e-3, 1e-3],
        forces_n: vec![0.0, 300.0, 300.0, 2400.0],
    };
    let rising = ContactLaw::Tabulated {
        compressions_m: vec![0.0, 0.2e-3, 1e-3],
        forces_n: vec![0.0, 300.0, 2400.0],
    };
    let tangent = ContactLaw::Tangent {
        stiffness_n_m: 1e6,
        bottoming_m: 1.5e-3,
    };
    let hertz = ContactLaw::Power {
        coefficient_n_mn: 2e7,
        exponent: 1.5,
    };
    let layers = |laws: &[&ContactLaw]| {
        Cushion::in_series(&laws.iter().map(|&law| of(law.clone())).collect::<Vec<_>>()).unwrap()
    };
    let spring = ContactLaw::Linear { stiffness_n_m: 4e6 };
    let second = ContactLaw::Tangent {
        stiffness_n_m: 2e6,
        bottoming_m: 0.9e-3,
    };
    vec![
        of(ContactLaw::Linear {
            stiffness_n_m: 2.19e6,
        }),
        of(hertz.clone()),
        of(ContactLaw::Power {
            coefficient_n_mn: 4e4,
            exponent: 0.7,
        }),
        of(ContactLaw::KelvinVoigt {
            stiffness_n_m: 2.19e6,
            damping_n_s_m: 150.0,
        }),
        of(ContactLaw::KelvinVoigt {
            stiffness_n_m: 2.19e6,
            damping_n_s_m: 1200.0,
        }),
        of(ContactLaw::KelvinVoigt {
            stiffness_n_m: 2.19e6,
            damping_n_s_m: 4000.0,
        }),
        of(ContactLaw::HuntCrossley {
            coefficient_n_mn: 2e7,
            exponent: 1.5,
            dissipation_s_m: 0.3,
        }),
        of(ContactLaw::HuntCrossley {
            coefficient_n_mn: 2e6,
            exponent: 1.0,
            dissipation_s_m: 2.0,
        }),
        of(tangent.clone()),
        of(table),
        layers(&[&tangent, &spring, &hertz]),
        layers(&[&rising, &spring]),
        layers(&[&tangent, &second]),
    ]
}

/// The closed forms agree with an integration of the equation of motion, which uses none of them.
/// Runge–Kutta with 4000 steps is accurate to 1e-8 for smooth laws; a kink of a table costs the
/// square of a step, 1e-6; the force ends between two steps.
#[test]
fn closed_forms_are_what_the_motion_does() {
    for cushion in laws() {
        let name = cushion.law().name();
        for speed_m_s in [0.3 * fall_m_s(), fall_m_s()] {
            let contact = cushion.land(MASS_KG, speed_m_s);
            let history = cushion.landing_history(MASS_KG, speed_m_s, 0.0);
            let last = history.last().unwrap();
            let peak_n = history.iter().map(|p| p.force_n).fold(0.0, f64::max);
            let deepest_m = history.iter().map(|p| p.compression_m).fold(0.0, f64::max);
            // Between the samples a peak may be higher by (π/4000)²/8 = 8e-8 of itself.
            assert!(
                (peak_n / contact.peak_force_n - 1.0).abs() < 2e-6,
                "{name} {cushion:?} {contact:?} {peak_n}"
            );
            assert!(
                (deepest_m / contact.compression_m - 1.0).abs() < 2e-6,
                "{name} {contact:?} {deepest_m}"
            );
            assert!(
                (last.time_s / contact.duration_s - 1.0).abs() < 2e-4,
                "{name} {contact:?} {last:?}"
            );
            let e = -last.speed_m_s / speed_m_s;
            assert!(
                (e - contact.restitution_ratio).abs() < 2e-4,
                "{name} {contact:?} {e}"
            );
        }
    }
}

/// A tangent law from its soft part to a thousand times its initial stiffness: the motion reaches
/// the force of the closed form. Steps of 2e-3 radians miss the peak by at most (1e-3)²/2 = 5e-7 of
/// it; the tolerance is four times that.
#[test]
fn the_motion_follows_a_cushion_to_its_end() {
    let (k0, db) = (1e6, 1e-3);
    let cushion = of(ContactLaw::Tangent {
        stiffness_n_m: k0,
        bottoming_m: db,
    });
    for stiffer in [1.1_f64, 3.0, 30.0, 1000.0] {
        // k/k₀ = 1/cos² of the angle πd/2d_b, F = (2k₀d_b/π) tan and E = −(4k₀d_b²/π²) ln cos of
        // it.
        let energy_j = 2.0 * k0 * db * db / (PI * PI) * stiffer.ln();
        let speed_m_s = (2.0 * energy_j / MASS_KG).sqrt();
        let force_n = 2.0 * k0 * db / PI * (stiffer - 1.0).sqrt();
        let history = cushion.landing_history(MASS_KG, speed_m_s, 0.0);
        let peak_n = history.iter().map(|p| p.force_n).fold(0.0, f64::max);
        assert!(
            (peak_n / force_n - 1.0).abs() < 2e-6,
            "{stiffer} {peak_n} {force_n}"
        );
        let last = history.last().unwrap();
        assert!(
            (-last.speed_m_s / speed_m_s - 1.0).abs() < 2e-4,
            "{stiffer} {last:?}"
        );
        // With the weight, the energy of the fall through the compression is added.
        let heavy = cushion.landing_history(MASS_KG, speed_m_s, G0_M_S2);
        let deepest_m = heavy.iter().map(|p| p.compression_m).fold(0.0, f64::max);
        let stored_j = cushion.stored_energy_j(deepest_m);
        assert!(
            (stored_j / (energy_j + MASS_KG * G0_M_S2 * deepest_m) - 1.0).abs() < 2e-6,
            "{stiffer}"
        );
    }
}

/// d_max, a_max and contact time of the pads in the example of the literature, and Cₙ, to the
/// printed digits.
#[test]
fn worked_numbers() {
    let contact = of(ContactLaw::Power {
        coefficient_n_mn: 2e7,
        exponent: 1.5,
    })
    .land(MASS_KG, fall_m_s());
    assert!((contact.peak_force_n / MASS_KG / G0_M_S2 - 217.596).abs() < 5e-4);
    assert!((contact.compression_m * 1e3 - 1.148919).abs() < 5e-7);
    assert!((contact.duration_s * 1e3 - 2.414599).abs() < 5e-7);
    for (exponent, c_n) in [(1.0, PI), (1.5, 2.94328), (2.0, 2.80436), (2.5, 2.70145)] {
        let contact = of(ContactLaw::Power {
            coefficient_n_mn: 1e7,
            exponent,
        })
        .land(1.0, 1.0);
        assert!((contact.duration_s / contact.compression_m - c_n).abs() < 5e-6);
        // a d/v² = (n+1)/2.
        assert!(
            (contact.peak_force_n * contact.compression_m - 0.5 * (exponent + 1.0)).abs() < 1e-12
        );
    }
}

/// The tangent law from its energy: F = (2k₀d_b/π)√(exp(π²Wh/(2k₀d_b²)) − 1), and it never passes
/// d_b.
#[test]
fn a_bottoming_cushion_follows_its_closed_form() {
    let (k0, db) = (1e6, 1e-3);
    let cushion = of(ContactLaw::Tangent {
        stiffness_n_m: k0,
        bottoming_m: db,
    });
    for height_m in [1e-3, 0.1, 0.5] {
        let weight_n = MASS_KG * G0_M_S2;
        let contact = cushion.land(MASS_KG, (2.0 * G0_M_S2 * height_m).sqrt());
        let force_n = 2.0 * k0 * db / PI
            * ((PI * PI * weight_n * height_m / (2.0 * k0 * db * db)).exp() - 1.0).sqrt();
        assert!((contact.peak_force_n / force_n - 1.0).abs() < 1e-12);
        assert!(contact.compression_m < db);
    }
    let beyond = cushion.land(MASS_KG, 100.0);
    assert!(
        beyond.peak_force_n.is_infinite() && beyond.compression_m <= db && beyond.duration_s > 0.0
    );
}

/// A table of one line is a spring, before and beyond its end.
#[test]
fn a_table_of_one_line_is_a_spring() {
    let table = of(ContactLaw::Tabulated {
        compressions_m: vec![0.0, 1e-3],
        forces_n: vec![0.0, 2190.0],
    });
    let spring = Cushion::linear(2.19e6).unwrap();
    for speed_m_s in [1.0, 5.0] {
        let (a, b) = (
            table.land(MASS_KG, speed_m_s),
            spring.land(MASS_KG, speed_m_s),
        );
        for (x, y) in [
            (a.peak_force_n, b.peak_force_n),
            (a.compression_m, b.compression_m),
            // The kink of the table at its end divides the integral of the duration.
            (a.duration_s, b.duration_s),
        ] {
            assert!((x / y - 1.0).abs() < 1e-10, "{a:?} {b:?}");
        }
    }
}

/// Springs in series are one spring; a stiff spring under a law changes nothing.
#[test]
fn layers_in_series() {
    let springs = [2e6, 3e6, 6e6].map(|k| Cushion::linear(k).unwrap());
    let one = Cushion::in_series(&springs).unwrap();
    assert!((one.linear_stiffness_n_m().unwrap() - 1e6).abs() < 1e-6);
    let hertz = of(ContactLaw::Power {
        coefficient_n_mn: 2e7,
        exponent: 1.5,
    });
    let on_rock = Cushion::in_series(&[hertz.clone(), Cushion::linear(1e15).unwrap()]).unwrap();
    let (a, b) = (hertz.land(MASS_KG, 1.0), on_rock.land(MASS_KG, 1.0));
    // The spring compresses by F/k = 1e-12 m, 2e-9 of the compression.
    assert!((a.peak_force_n / b.peak_force_n - 1.0).abs() < 1e-8);
    assert!((a.duration_s / b.duration_s - 1.0).abs() < 1e-8);
    assert!(
        (on_rock.tangent_stiffness_n_m(1e-3) / hertz.tangent_stiffness_n_m(1e-3) - 1.0).abs()
            < 1e-8
    );
    let damped = of(ContactLaw::KelvinVoigt {
        stiffness_n_m: 1e6,
        damping_n_s_m: 10.0,
    });
    assert_eq!(
        Cushion::in_series(&[damped, Cushion::linear(1e6).unwrap()]),
        Err(CushionError::DampedSeries {
            law: "kelvin-voigt"
        })
    );
}

/// Two pads carry a mass as one pad carries half of it.
#[test]
fn pads_side_by_side_share_the_mass() {
    for pad in laws() {
        let (two, one) = (
            pad.side_by_side(2).land(2.0 * MASS_KG, 1.0),
            pad.land(MASS_KG, 1.0),
        );
        assert!(
            (two.peak_force_n / (2.0 * one.peak_force_n) - 1.0).abs() < 1e-12,
            "{pad:?}"
        );
        assert!(
            (two.duration_s / one.duration_s - 1.0).abs() < 1e-10,
            "{pad:?}"
        );
        assert!(
            (two.restitution_ratio - one.restitution_ratio).abs() < 1e-12,
            "{pad:?}"
        );
    }
}

/// Force, energy, slope and inverse of each law are consistent: differences over 1e-5 of the
/// compression are accurate to 1e-9, except at a kink, which the chosen depth avoids.
#[test]
fn force_energy_slope_and_inverse_agree() {
    for cushion in laws() {
        let (d, step) = (0.47e-3, 0.47e-8);
        let slope =
            (cushion.force_n(d + step, 0.0) - cushion.force_n(d - step, 0.0)) / (2.0 * step);
        let force =
            (cushion.stored_energy_j(d + step) - cushion.stored_energy_j(d - step)) / (2.0 * step);
        assert!(
            (slope / cushion.tangent_stiffness_n_m(d) - 1.0).abs() < 1e-5,
            "{cushion:?}"
        );
        assert!(
            (force / cushion.force_n(d, 0.0) - 1.0).abs() < 1e-5,
            "{cushion:?}"
        );
        assert!(
            (cushion.static_compression_m(cushion.force_n(d, 0.0)) / d - 1.0).abs() < 1e-12,
            "{cushion:?}"
        );
    }
}

/// Very small damping approaches the undamped law; Kelvin–Voigt is smooth at its critical damping.
#[test]
fn damped_laws_meet_their_limits() {
    let hertz = ContactLaw::Power {
        coefficient_n_mn: 2e7,
        exponent: 1.5,
    };
    for dissipation_s_m in [0.0, 1e-16, 1e-12, 1e-9] {
        let damped = ContactLaw::HuntCrossley {
            coefficient_n_mn: 2e7,
            exponent: 1.5,
            dissipation_s_m,
        };
        let (a, b) = (of(hertz.clone()).land(1.0, 1.0), of(damped).land(1.0, 1.0));
        assert!(
            (a.peak_force_n / b.peak_force_n - 1.0).abs() < 1e-8,
            "{dissipation_s_m}: {a:?} {b:?}"
        );
        assert!(
            (a.duration_s / b.duration_s - 1.0).abs() < 1e-8,
            "{dissipation_s_m}: {a:?} {b:?}"
        );
        assert!(
            (b.restitution_ratio - 1.0).abs() < 1e-8,
            "{dissipation_s_m}: {a:?} {b:?}"
        );
    }
    let critical = |zeta: f64| {
        of(ContactLaw::KelvinVoigt {
            stiffness_n_m: 1.0,
            damping_n_s_m: 2.0 * zeta,
        })
        .land(1.0, 1.0)
    };
    // At ζ = 1: d = 1/e, e = exp(−2), T = 2, F = 2.
    let at = critical(1.0);
    assert!((at.compression_m - (-1.0f64).exp()).abs() < 1e-15);
    assert!((at.restitution_ratio - (-2.0f64).exp()).abs() < 1e-15);
    for offset in [1e-3, 4e-5, 6e-5, 1e-7] {
        for zeta in [1.0 - offset, 1.0 + offset] {
            let near = critical(zeta);
            // dd/dζ = −2/(3e) and dT/dζ = −2/3 there, up to terms of offset².
            let drift = zeta - 1.0;
            assert!(
                (near.duration_s - 2.0 + 2.0 / 3.0 * drift).abs() < 2.0 * drift * drift + 1e-13,
                "{zeta} {near:?}"
            );
        }
    }
}

#[test]
fn numbers_that_make_no_cushion_are_refused() {
    let table = |d: &[f64], f: &[f64]| {
        Cushion::new(ContactLaw::Tabulated {
            compressions_m: d.to_vec(),
            forces_n: f.to_vec(),
        })
    };
    assert!(Cushion::linear(0.0).is_err() && Cushion::linear(f64::NAN).is_err());
    assert!(
        Cushion::new(ContactLaw::Power {
            coefficient_n_mn: 1.0,
            exponent: 0.0
        })
        .is_err()
    );
    assert!(
        Cushion::new(ContactLaw::KelvinVoigt {
            stiffness_n_m: 1.0,
            damping_n_s_m: -1.0
        })
        .is_err()
    );
    assert_eq!(table(&[0.0], &[0.0]), Err(CushionError::ShortTable));
    assert!(matches!(
        table(&[0.1, 0.2], &[0.0, 1.0]),
        Err(CushionError::Table { number: 1, .. })
    ));
    assert!(matches!(
        table(&[0.0, 0.2, 0.2], &[0.0, 1.0, 2.0]),
        Err(CushionError::Table { number: 3, .. })
    ));
    assert!(matches!(
        table(&[0.0, 0.1, 0.2], &[0.0, 1.0, 0.5]),
        Err(CushionError::Table { number: 3, .. })
    ));
    assert!(matches!(
        table(&[0.0, 0.1, 0.2], &[0.0, 1.0, 1.0]),
        Err(CushionError::Table { number: 3, .. })
    ));
    assert_eq!(Cushion::in_series(&[]), Err(CushionError::NoParts));
}
