//! Drop tests of pads that follow no formula of the fit, as instruments record them: noise, 12 bits, filters.

use super::*;
use crate::G0_M_S2;
use crate::cushion::Cushion;

const MASS_KG: f64 = 0.365;

fn fall_m_s() -> f64 {
    (2.0 * G0_M_S2 * 0.1).sqrt()
}

/// A table of 400 points of a force, some way beyond what the drop compresses: straight lines between them are wrong
/// by 1e-5.
fn dense(force_n: impl Fn(f64) -> f64, most_m: f64) -> Cushion {
    let compressions_m: Vec<f64> = (0..=400).map(|i| most_m * f64::from(i) / 400.0).collect();
    let forces_n = compressions_m.iter().map(|&d| force_n(d)).collect();
    Cushion::new(ContactLaw::Tabulated { compressions_m, forces_n }).unwrap()
}

fn table(points: &[(f64, f64)]) -> Cushion {
    let (compressions_m, forces_n) = points.iter().map(|&(d, f)| (1e-3 * d, 1e3 * f)).unzip();
    Cushion::new(ContactLaw::Tabulated { compressions_m, forces_n }).unwrap()
}

/// Pads by name.
fn pads() -> Vec<(&'static str, Cushion)> {
    let tangent =
        |stiffness_n_m, bottoming_m| Cushion::new(ContactLaw::Tangent { stiffness_n_m, bottoming_m }).unwrap();
    vec![
        ("hardening weakly", dense(|d| 1.8e6 * d + 1.5e12 * d.powi(3), 2e-3)),
        ("hardening", dense(|d| 1.2e6 * d + 6e12 * d.powi(3), 2e-3)),
        ("hardening strongly", dense(|d| 4e5 * d + 9e12 * d.powi(3), 2e-3)),
        // The force of this pad has its largest value at 1.05 mm.
        ("softening", dense(|d| 2.0e6 * d - 0.6e12 * d.powi(3), 1.04e-3)),
        ("softening weakly", dense(|d| 2.2e6 * d - 0.35e12 * d.powi(3), 1.4e-3)),
        ("tangent", tangent(1.0e6, 1.5e-3)),
        ("tangent, nearly bottoming", tangent(6e5, 0.9e-3)),
        ("table, kink up", table(&[(0.0, 0.0), (0.3, 0.36), (0.6, 1.2), (1.0, 3.0)])),
        ("table, kink down", table(&[(0.0, 0.0), (0.25, 0.75), (0.6, 1.3), (1.2, 2.0)])),
        ("exponential", dense(|d| 420.0 * (d / 0.35e-3).exp_m1(), 2e-3)),
        ("square", dense(|d| 1.0e6 * d + 1.6e9 * d * d, 2e-3)),
    ]
}

/// How an instrument records.
#[derive(Debug, Clone, Copy)]
struct Recorder {
    per_contact: f64,
    noise_ratio: f64,
    /// Corner times contact time.
    corner: Option<f64>,
}

const RECORDERS: [Recorder; 6] = [
    Recorder { per_contact: 50.0, noise_ratio: 0.005, corner: None },
    Recorder { per_contact: 75.0, noise_ratio: 0.001, corner: None },
    Recorder { per_contact: 200.0, noise_ratio: 0.01, corner: None },
    Recorder { per_contact: 60.0, noise_ratio: 0.0, corner: None },
    Recorder { per_contact: 60.0, noise_ratio: 0.003, corner: Some(6.0) },
    Recorder { per_contact: 100.0, noise_ratio: 0.003, corner: Some(3.0) },
];

/// What the evaluation of a pad on a recorder makes of its drops.
#[derive(Debug, Default)]
struct Score {
    drops: usize,
    given: usize,
    held: usize,
    flagged: usize,
    /// Half of the 95 % interval over the stiffness, and the error.
    halves: Vec<f64>,
    errors: Vec<f64>,
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(f64::NAN)
}

/// The secant at the largest compression.
fn truth_n_m(pad: &Cushion) -> f64 {
    let history = pad.landing_history(MASS_KG, fall_m_s(), G0_M_S2);
    let deepest_m = history.iter().map(|p| p.compression_m).fold(0.0, f64::max);
    pad.force_n(deepest_m, 0.0) / deepest_m
}

/// Drops with a stated velocity that is wrong by 1 %, as 12 bits of a range of twice the peak.
fn score(pad: &Cushion, recorder: &Recorder, seed: u64, drops: u64, states_corner: bool) -> Score {
    let truth = truth_n_m(pad);
    let contact_s = pad.land(MASS_KG, fall_m_s()).duration_s;
    let mut score = Score::default();
    for index in 0..drops {
        let filter_corner_hz = recorder.corner.map(|corner| corner / contact_s);
        let options = VirtualDropOptions {
            sample_rate_hz: recorder.per_contact / contact_s,
            noise_ratio: recorder.noise_ratio,
            bias_m_s2: 0.3 * G0_M_S2,
            filter_corner_hz,
            speed_error_ratio: 0.01,
            seed,
            index,
            ..VirtualDropOptions::from_height(pad, MASS_KG, 0.1)
        };
        let drop = virtual_drop(pad, &options).unwrap();
        let step = 4.0 * drop.peak_m_s2 / 4096.0;
        let samples: Vec<f64> = drop.samples_m_s2.iter().map(|a| (a / step).round() * step).collect();
        let setup = DropSetup {
            mass_kg: MASS_KG,
            impact_velocity: ImpactVelocity::Known { speed_m_s: drop.stated_speed_m_s, error_ratio: 0.01 },
            gravity_m_s2: G0_M_S2,
            filter_corner_hz: filter_corner_hz.filter(|_| states_corner),
            law: None,
        };
        let test = drop_test(&samples, drop.dt_s, &setup).unwrap();
        score.drops += 1;
        score.flagged += usize::from(!test.flags.is_empty());
        if let Some(found) = test.identified {
            let (off, half) = ((found.stiffness.fit_n_m / truth).ln(), NORMAL_975 * found.error_ratio);
            score.given += 1;
            score.held += usize::from(off.abs() <= half);
            score.halves.push(half);
            score.errors.push(off);
        }
    }
    score
}

/// Drops of each pad on each recorder.
const CAMPAIGN_DROPS: u64 = 100;
/// Another than that of the tests.
const CAMPAIGN_SEED: u64 = 777;
const TEST_SEED: u64 = 11;

fn campaign(drops: u64, states_corner: bool) {
    for (name, pad) in pads() {
        for recorder in RECORDERS.iter().filter(|recorder| states_corner || recorder.corner.is_some()) {
            let s = score(&pad, recorder, CAMPAIGN_SEED, drops, states_corner);
            let mean = s.errors.iter().sum::<f64>() / s.errors.len().max(1) as f64;
            println!(
                "{name:26} {:4} {:6} {:?}: given {} held {} flagged {} | half-width {:.4} mean error {mean:+.4}",
                recorder.per_contact,
                recorder.noise_ratio,
                recorder.corner,
                s.given,
                s.held,
                s.flagged,
                median(&s.halves),
            );
        }
    }
}

/// A part of the campaign below: the intervals hold the truth, and are no excuse. Of 24 drops with intervals of 95 %, 20
/// or fewer are held with a probability of 1 in 170; the half-width is twice the largest of the campaign.
#[test]
fn pads_that_follow_no_law_are_inside_their_intervals() {
    let wanted = ["hardening", "softening", "tangent", "table, kink up"];
    for recorder in [&RECORDERS[0], &RECORDERS[4]] {
        let (mut held, mut given) = (0, 0);
        for (name, pad) in pads().into_iter().filter(|(name, _)| wanted.contains(name)) {
            let s = score(&pad, recorder, TEST_SEED, 6, true);
            (held, given) = (held + s.held, given + s.given);
            assert!(median(&s.halves) < 0.06, "{name} {recorder:?}: {s:?}");
        }
        assert!(held > 20 && given > 21, "{recorder:?}: {held} of {given}");
    }
}

/// A linear pad behind a filter of two poles at 2.4/t_c that nobody stated: the pulse has the shape of a pad that
/// hardens, which would be 26 % too soft. The filter is found and flagged, and the interval holds the truth.
#[test]
fn a_slow_filter_is_noticed() {
    let pad = Cushion::linear(7.6e5).unwrap();
    let slow = Recorder { per_contact: 100.0, noise_ratio: 0.003, corner: Some(2.4) };
    let s = score(&pad, &slow, TEST_SEED, 4, false);
    assert!(s.flagged == 4 && s.held == s.given && s.given > 2, "{s:?}");
    let stated = score(&pad, &slow, TEST_SEED, 4, true);
    // Behind the stated filter the pad is as well known as without one: noise and the velocity.
    assert!(stated.held > 2 && median(&stated.halves) < 0.05, "{stated:?}");
}

/// The pad of a finding: 1187 N/mm at first, 3175 N/mm at the largest compression. A power law gave 2309 N/mm.
#[test]
fn a_hardening_pad_is_no_power_law() {
    let pad = dense(|d| 1.19e6 * d + 6e12 * d.powi(3), 2e-3);
    let s = score(&pad, &RECORDERS[1], TEST_SEED, 3, true);
    // Noise of 0.1 % and the velocity, of 1 %, decide: 1 % is three times the half-width of the campaign.
    assert!(s.held == 3 && s.errors.iter().all(|off| off.abs() < 0.01) && s.flagged == 0, "{s:?}");
}

#[test]
#[ignore = "some minutes: prints the figures of docs/cushion-laboratory.md"]
fn every_pad_on_every_recorder() {
    campaign(CAMPAIGN_DROPS, true);
    println!("the corner is not stated:");
    campaign(CAMPAIGN_DROPS, false);
}
