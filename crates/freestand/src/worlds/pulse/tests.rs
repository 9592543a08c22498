use crate::code_spectrum::{Nzs1170_5, SubsoilClass};
use crate::motion::Motion;
use crate::synthesis::{QuickMatcher, SynthesisOptions, with_pulse};
use crate::worlds::{GroundSpread, SpreadOptions, WorldDraw, world_motion};

use super::*;

/// A fault at a distance in km.
fn fault(distance_km: f64, magnitude: Option<f64>) -> NearFault {
    NearFault::new(distance_km * 1e3, magnitude).unwrap()
}

/// Wellington, class C, 500 years, 2 km from the fault.
fn target(period_s: f64) -> f64 {
    let code = Nzs1170_5::new(SubsoilClass::C, 0.4, 500, Some(2.0)).unwrap();
    code.sa_g(period_s)
}

/// Its pulses where the target has them, through N(T, D).
fn pulses(fault: NearFault) -> Pulses {
    Pulses::new(fault.in_target(), target).unwrap().unwrap()
}

/// By hand, with e^x from a table.
#[test]
fn the_laws_give_what_they_give_by_hand() {
    for (value, by_hand) in [
        // 1/(1 + e^0.642), 1/(1 + e^(0.642 + 1.67 − 0.75)), 1/(1 + e^(0.642 + 8.35)).
        (pulse_probability(0.0, 0.0), 0.344_79),
        (pulse_probability(10.0, 10.0), 0.173_33),
        (pulse_probability(50.0, 0.0), 0.000_124_4),
        // e^0.705, e^1.2.
        (pulse_period_s(6.5), 2.023_85),
        (pulse_period_s(7.0), 3.320_12),
        // 10^1.26, 10^1.63.
        (rupture_length_km(6.5), 18.197),
        (rupture_length_km(7.0), 42.658),
        // e^(−0.0905 · 1.098 61 · 0.9), half of the exponent at M 6.25, e^−0.198.
        (without_pulse_ratio(3.0, 7.0, 2e3), 0.914_41),
        (without_pulse_ratio(3.0, 6.25, 2e3), 0.956_25),
        (without_pulse_ratio(20.0, 7.5, 0.0), 0.820_37),
        (without_pulse_ratio(1.0, 7.0, 0.0), 1.0),
        (without_pulse_ratio(3.0, 7.0, 20e3), 1.0),
        // e^(1.131 + 0.058), and e^0.058, e^0.255 far away.
        (
            pulse_amplification_ratio((-0.127_f64).exp() * 0.999),
            3.2838,
        ),
        (pulse_amplification_ratio(0.01), 1.059_7),
        (pulse_amplification_ratio(100.0), 1.290_5),
    ] {
        // The numbers by hand have four to five digits.
        assert!((value / by_hand - 1.0).abs() < 2e-4, "{value} {by_hand}");
    }
}

#[test]
fn pulses_become_rare_with_distance_and_end_at_50_km() {
    let shares = [0.0, 2.0, 5.0, 10.0, 20.0, 30.0, 49.9].map(|km| fault(km, None).pulse_share());
    assert!(
        shares.windows(2).all(|pair| pair[1] < pair[0]),
        "{shares:?}"
    );
    assert!(shares[6] > 0.0 && shares[6] < 0.001, "{shares:?}");
    assert_eq!(fault(50.0, Some(8.5)).pulse_share(), 0.0);
    assert_eq!(Pulses::new(fault(50.0, None), target), Ok(None));
    // Summed in another program, over 2000 steps of s: 5 km, M 6.5 and M 7.
    assert!((fault(5.0, Some(6.5)).pulse_share() - 0.2691).abs() < 1e-4);
    assert!((fault(5.0, Some(7.0)).pulse_share() - 0.4069).abs() < 1e-4);
}

#[test]
fn what_is_out_of_range_is_refused() {
    for (distance_m, magnitude) in [
        (-1.0, None),
        (1e6 + 1.0, None),
        (f64::NAN, None),
        (5e3, Some(4.9)),
        (5e3, Some(8.6)),
    ] {
        assert!(
            NearFault::new(distance_m, magnitude).is_err(),
            "{distance_m} {magnitude:?}"
        );
    }
    assert!(NearFault::new(0.0, Some(5.0)).is_ok() && NearFault::new(1e6, Some(8.5)).is_ok());
}

/// The number of worlds with pulses is binomial: within four standard deviations.
#[test]
fn the_worlds_have_the_pulses_of_the_law() {
    let near = fault(5.0, None);
    let (pulses, share) = (pulses(near), near.pulse_share());
    let worlds = 20_000;
    let drawn: Vec<WorldPulse> = (0..worlds)
        .filter_map(|world| pulses.draw(3, world, 0))
        .collect();
    let n = f64::from(worlds);
    let off = (drawn.len() as f64 - n * share) / (n * share * (1.0 - share)).sqrt();
    assert!(off.abs() < 4.0, "{} {share}", drawn.len());
    // The median period lies between those of the two magnitudes.
    let mut periods_s: Vec<f64> = drawn.iter().map(|pulse| pulse.shape.period_s).collect();
    periods_s.sort_by(f64::total_cmp);
    let median_s = periods_s[periods_s.len() / 2];
    assert!(
        median_s > pulse_period_s(6.5) && median_s < pulse_period_s(7.0),
        "{median_s}"
    );
    for pulse in &drawn {
        assert!(pulse.shape.period_s <= 10.0 && (2.0..=3.2).contains(&pulse.shape.cycles));
        assert!((pulse.part(Component::X).hypot(pulse.part(Component::Y)) - 1.0).abs() < 1e-15);
        assert_eq!(pulse.part(Component::Vertical), 0.0);
    }
    // The mean of a cosine of which all angles are as likely: standard deviation √½ over √n.
    let mean = drawn
        .iter()
        .map(|pulse| pulse.part(Component::X))
        .sum::<f64>()
        / drawn.len() as f64;
    assert!(
        mean.abs() < 4.0 * (0.5 / drawn.len() as f64).sqrt(),
        "{mean}"
    );
    // Each world has its own, whatever the others have.
    assert_eq!(pulses.draw(3, 7, 1), pulses.draw(3, 7, 1));
    assert_ne!(pulses.drawn(3, 7, 1).0, pulses.drawn(3, 7, 0).0);
}

fn motion(pulses: Option<&Pulses>, spectra: &crate::worlds::WorldSpectra, world: u32) -> Motion {
    let lowered = |t: f64| pulses.map_or(target(t), |pulses| pulses.under_sa_g(None, t, target(t)));
    let matcher = QuickMatcher::new(&SynthesisOptions::default()).unwrap();
    world_motion(
        lowered,
        spectra,
        Component::X,
        WorldDraw {
            seed: 1,
            world,
            repetition: 0,
        },
        &matcher,
    )
    .unwrap()
}

/// The mean of ln Sa over worlds with and without pulses is that of worlds without a fault. Every world is taken with
/// its pulse and without, weighted by the probability, so that what differs between the phases of the same world is all
/// that scatters: within four standard errors, which are 0.03 at most.
#[test]
fn the_mean_spectrum_stays_the_target() {
    let near = fault(2.0, Some(7.0));
    let (pulses, share) = (pulses(near), near.pulse_share());
    let spread = GroundSpread::new(SpreadOptions::default()).unwrap();
    let periods_s = [0.2, 0.5, 1.0, 2.0, 3.0, 4.5];
    let options = SynthesisOptions::default();
    let ln = |motion: &Motion| -> Vec<f64> {
        let spectrum = response_spectrum(motion, DAMPING_RATIO, &periods_s).unwrap();
        spectrum.psa_m_s2.into_iter().map(f64::ln).collect()
    };
    let mut away = vec![Vec::new(); periods_s.len()];
    let mut raised = vec![0.0; periods_s.len()];
    let worlds = 80;
    for world in 0..worlds {
        let spectra = spread.spectra(1, world, 0);
        let far = ln(&motion(None, &spectra, world));
        let under = motion(Some(&pulses), &spectra, world);
        let (pulse, _) = pulses.drawn(1, world, 0);
        let lowered = |t: f64| spectra.x.sa_g(t, pulses.under_sa_g(None, t, target(t)));
        let amplitude_m_s = pulse.amplitude_m_s(lowered).unwrap() * pulse.part(Component::X);
        let with = ln(&with_pulse(&under, &pulse.shape, amplitude_m_s, &options).unwrap());
        for (i, without) in ln(&under).into_iter().enumerate() {
            away[i].push(share * with[i] + (1.0 - share) * without - far[i]);
            raised[i] += (with[i] - without) / f64::from(worlds);
        }
    }
    for (i, away) in away.iter().enumerate() {
        let n = away.len() as f64;
        let mean = away.iter().sum::<f64>() / n;
        let variance = away.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / (n - 1.0);
        let error = (variance / n).sqrt();
        println!(
            "{} s: mean {mean:.3}, error {error:.3}, raised by {:.3}",
            periods_s[i], raised[i]
        );
        assert!(
            error < 0.03 && mean.abs() < 4.0 * error,
            "{} s: {mean} {error}",
            periods_s[i]
        );
    }
    // At short periods a pulse is little more than its peak acceleration; around its median period, 3.3 s, it rules.
    assert!(
        raised[4] > 0.3 && raised[0] < 0.25 * raised[4],
        "{raised:?}"
    );
}

#[test]
fn a_spectrum_without_a_value_has_no_amplitude() {
    let pulse = pulses(fault(2.0, None)).drawn(1, 0, 0).0;
    assert!(pulse.amplitude_m_s(|_| f64::NAN).is_err());
    let one = pulse.amplitude_m_s(|_| 0.2).unwrap();
    assert!((pulse.amplitude_m_s(|_| 0.4).unwrap() / one - 2.0).abs() < 1e-12);
}
