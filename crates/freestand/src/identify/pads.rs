//! Drop tests of pads that follow no formula of the fit, as instruments record them: noise, 12 bits, filters.

use rayon::prelude::*;

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
    Cushion::new(ContactLaw::Tabulated {
        compressions_m,
        forces_n,
    })
    .unwrap()
}

fn table(points: &[(f64, f64)]) -> Cushion {
    let (compressions_m, forces_n) = points.iter().map(|&(d, f)| (1e-3 * d, 1e3 * f)).unzip();
    Cushion::new(ContactLaw::Tabulated {
        compressions_m,
        forces_n,
    })
    .unwrap()
}

/// What a pad follows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Family {
    /// k d + k₃ d³.
    Cubic,
    Tangent,
    /// Straight lines with kinks.
    Table,
    Other,
}

/// Pads by name.
fn pads() -> Vec<(Family, &'static str, Cushion)> {
    let tangent = |stiffness_n_m, bottoming_m| {
        Cushion::new(ContactLaw::Tangent {
            stiffness_n_m,
            bottoming_m,
        })
        .unwrap()
    };
    use Family::{Cubic, Other, Table, Tangent};
    vec![
        (
            Cubic,
            "hardening weakly",
            dense(|d| 1.8e6 * d + 1.5e12 * d.powi(3), 2e-3),
        ),
        (
            Cubic,
            "hardening",
            dense(|d| 1.2e6 * d + 6e12 * d.powi(3), 2e-3),
        ),
        (
            Cubic,
            "hardening strongly",
            dense(|d| 4e5 * d + 9e12 * d.powi(3), 2e-3),
        ),
        // The force of this pad has its largest value at 1.05 mm.
        (
            Cubic,
            "softening",
            dense(|d| 2.0e6 * d - 0.6e12 * d.powi(3), 1.04e-3),
        ),
        (
            Cubic,
            "softening weakly",
            dense(|d| 2.2e6 * d - 0.35e12 * d.powi(3), 1.4e-3),
        ),
        (Tangent, "tangent", tangent(1.0e6, 1.5e-3)),
        (Tangent, "tangent, nearly bottoming", tangent(6e5, 0.9e-3)),
        (
            Table,
            "table, kink up",
            table(&[(0.0, 0.0), (0.3, 0.36), (0.6, 1.2), (1.0, 3.0)]),
        ),
        (
            Table,
            "table, kink down",
            table(&[(0.0, 0.0), (0.25, 0.75), (0.6, 1.3), (1.2, 2.0)]),
        ),
        (
            Other,
            "exponential",
            dense(|d| 420.0 * (d / 0.35e-3).exp_m1(), 2e-3),
        ),
        (Other, "square", dense(|d| 1.0e6 * d + 1.6e9 * d * d, 2e-3)),
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
    Recorder {
        per_contact: 50.0,
        noise_ratio: 0.005,
        corner: None,
    },
    Recorder {
        per_contact: 75.0,
        noise_ratio: 0.001,
        corner: None,
    },
    Recorder {
        per_contact: 200.0,
        noise_ratio: 0.01,
        corner: None,
    },
    Recorder {
        per_contact: 60.0,
        noise_ratio: 0.0,
        corner: None,
    },
    Recorder {
        per_contact: 60.0,
        noise_ratio: 0.003,
        corner: Some(6.0),
    },
    Recorder {
        per_contact: 100.0,
        noise_ratio: 0.003,
        corner: Some(3.0),
    },
];

/// One drop, evaluated.
#[derive(Debug)]
struct Outcome {
    flags: Vec<Flag>,
    /// ln of the stiffness over the truth, and half of its 95 % interval.
    off_and_half: Option<(f64, f64)>,
}

impl Outcome {
    fn is_given(&self) -> bool {
        self.off_and_half.is_some()
    }

    /// Whether the interval holds the truth.
    fn holds(&self) -> bool {
        self.off_and_half
            .is_some_and(|(off, half)| off.abs() <= half)
    }

    fn is_flagged(&self) -> bool {
        !self.flags.is_empty()
    }
}

fn count(outcomes: &[Outcome], is_it: impl Fn(&Outcome) -> bool) -> usize {
    outcomes.iter().filter(|outcome| is_it(outcome)).count()
}

fn median_half(outcomes: &[Outcome]) -> f64 {
    median(
        &outcomes
            .iter()
            .filter_map(|outcome| Some(outcome.off_and_half?.1))
            .collect::<Vec<_>>(),
    )
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
fn outcomes(
    pad: &Cushion,
    recorder: &Recorder,
    seed: u64,
    drops: u64,
    states_corner: bool,
) -> Vec<Outcome> {
    let truth = truth_n_m(pad);
    let contact_s = pad.land(MASS_KG, fall_m_s()).duration_s;
    let filter_corner_hz = recorder.corner.map(|corner| corner / contact_s);
    let one = |index| {
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
        let samples: Vec<f64> = drop
            .samples_m_s2
            .iter()
            .map(|a| (a / step).round() * step)
            .collect();
        let setup = DropSetup {
            mass_kg: MASS_KG,
            impact_velocity: ImpactVelocity::Known {
                speed_m_s: drop.stated_speed_m_s,
                error_ratio: 0.01,
            },
            gravity_m_s2: G0_M_S2,
            filter_corner_hz: filter_corner_hz.filter(|_| states_corner),
            law: None,
        };
        let DropTest {
            flags, identified, ..
        } = drop_test(&samples, drop.dt_s, &setup).unwrap();
        let off_and_half = identified.map(|found| {
            (
                (found.stiffness.fit_n_m / truth).ln(),
                NORMAL_975 * found.error_ratio,
            )
        });
        Outcome {
            flags,
            off_and_half,
        }
    };
    (0..drops).map(one).collect()
}

/// Another than that of the tests.
const CAMPAIGN_SEED: u64 = 60613;
const TEST_SEED: u64 = 11;

impl Family {
    /// Drops of each pad on each recorder: more than a hundred of each family but the last.
    fn drops(self) -> u64 {
        match self {
            Self::Cubic => 4,
            Self::Tangent | Self::Table => 9,
            Self::Other => 2,
        }
    }
}

/// Drops of every pad on every recorder, on all cores, with totals by pad and by recorder.
fn campaign(states_corner: bool) {
    let recorders: Vec<&Recorder> = RECORDERS
        .iter()
        .filter(|recorder| states_corner || recorder.corner.is_some())
        .collect();
    let pads = pads();
    let cells: Vec<(usize, usize)> = (0..pads.len())
        .flat_map(|p| (0..recorders.len()).map(move |r| (p, r)))
        .collect();
    let found: Vec<Vec<Outcome>> = cells
        .par_iter()
        .map(|&(p, r)| {
            let (family, _, pad) = &pads[p];
            // The corner that nobody states has a third as many recorders.
            let drops = if states_corner {
                family.drops()
            } else {
                family.drops().div_ceil(2)
            };
            outcomes(pad, recorders[r], CAMPAIGN_SEED, drops, states_corner)
        })
        .collect();
    for (&(p, r), cell) in cells.iter().zip(&found) {
        for outcome in cell.iter().filter(|outcome| !outcome.holds()) {
            println!("  {} {:?}: {outcome:?}", pads[p].1, recorders[r]);
        }
    }
    let line = |name: String, is_in: &dyn Fn(usize, usize) -> bool| {
        let inside = || {
            cells
                .iter()
                .zip(&found)
                .filter(|((p, r), _)| is_in(*p, *r))
                .flat_map(|(_, cell)| cell)
        };
        let count =
            |is_it: &dyn Fn(&Outcome) -> bool| inside().filter(|outcome| is_it(outcome)).count();
        let halves: Vec<f64> = inside()
            .filter_map(|outcome| Some(outcome.off_and_half?.1))
            .collect();
        println!(
            "{name:40} drops {} given {} held {} flagged {} wrong and not flagged {} | half-width {:.4}",
            count(&|_| true),
            count(&Outcome::is_given),
            count(&Outcome::holds),
            count(&Outcome::is_flagged),
            count(&|outcome| outcome.is_given() && !outcome.holds() && !outcome.is_flagged()),
            median(&halves),
        );
    };
    for (p, (_, name, _)) in pads.iter().enumerate() {
        line((*name).to_owned(), &|pad, _| pad == p);
    }
    for family in [Family::Cubic, Family::Tangent, Family::Table, Family::Other] {
        line(format!("{family:?}"), &|pad, _| pads[pad].0 == family);
    }
    for (r, recorder) in recorders.iter().enumerate() {
        line(
            format!("{recorder:?}").replace("Recorder ", ""),
            &|_, other| other == r,
        );
    }
}

/// A part of the campaign below: the intervals hold the truth, and are no excuse. Of 24 drops with intervals of 95 %, 20
/// or fewer are held with a probability of 1 in 170; the half-width is twice the largest of the campaign.
#[test]
#[ignore = "half a minute: four pads on two recorders, 48 drops"]
fn pads_that_follow_no_law_are_inside_their_intervals() {
    let wanted = ["hardening", "softening", "tangent", "table, kink up"];
    for recorder in [&RECORDERS[0], &RECORDERS[4]] {
        let (mut held, mut given) = (0, 0);
        for (_, name, pad) in pads()
            .into_iter()
            .filter(|(_, name, _)| wanted.contains(name))
        {
            let s = outcomes(&pad, recorder, TEST_SEED, 6, true);
            (held, given) = (
                held + count(&s, Outcome::holds),
                given + count(&s, Outcome::is_given),
            );
            assert!(median_half(&s) < 0.06, "{name} {recorder:?}: {s:?}");
        }
        assert!(held > 20 && given > 21, "{recorder:?}: {held} of {given}");
    }
}

/// A linear pad behind a filter of two poles at 2.4/t_c that nobody stated: the pulse has the shape of a pad that
/// hardens, which would be 26 % too soft. The filter is found and flagged, and the interval holds the truth.
#[test]
#[ignore = "seconds: a drop and its filter"]
fn a_slow_filter_is_noticed() {
    let pad = Cushion::linear(7.6e5).unwrap();
    let slow = Recorder {
        per_contact: 100.0,
        noise_ratio: 0.003,
        corner: Some(2.4),
    };
    let s = outcomes(&pad, &slow, TEST_SEED, 4, false);
    let given = count(&s, Outcome::is_given);
    assert!(
        count(&s, Outcome::is_flagged) == 4 && count(&s, Outcome::holds) == given && given > 2,
        "{s:?}"
    );
    let stated = outcomes(&pad, &slow, TEST_SEED, 4, true);
    // Behind the stated filter the pad is as well known as without one: noise and the velocity.
    assert!(
        count(&stated, Outcome::holds) > 2 && median_half(&stated) < 0.05,
        "{stated:?}"
    );
}

/// A pad without a formula behind a filter at 3/t_c that nobody stated: its curve could take the shape of the filter, and
/// would be 2 to 17 % too soft. In the campaign all of 32 such drops are flagged and inside their intervals.
#[test]
#[ignore = "seconds: two pads behind a slow filter"]
fn a_slow_filter_is_no_part_of_a_curve() {
    for (_, name, pad) in pads()
        .into_iter()
        .filter(|(_, name, _)| ["tangent", "table, kink up"].contains(name))
    {
        let s = outcomes(&pad, &RECORDERS[5], TEST_SEED, 3, false);
        assert!(
            count(&s, Outcome::is_flagged) == 3 && count(&s, Outcome::holds) == 3,
            "{name}: {s:?}"
        );
    }
}

/// The pad of a finding: 1187 N/mm at first, 3175 N/mm at the largest compression. A power law gave 2309 N/mm.
#[test]
#[ignore = "seconds: drops from several heights"]
fn a_hardening_pad_is_no_power_law() {
    let pad = dense(|d| 1.19e6 * d + 6e12 * d.powi(3), 2e-3);
    let s = outcomes(&pad, &RECORDERS[1], TEST_SEED, 3, true);
    // Noise of 0.1 % and the velocity, of 1 %, decide: 1 % is three times the half-width of the campaign.
    let is_near = |s: &Outcome| {
        s.holds() && !s.is_flagged() && s.off_and_half.is_some_and(|(off, _)| off.abs() < 0.01)
    };
    assert!(s.iter().all(is_near), "{s:?}");
}

#[test]
#[ignore = "some minutes: prints the figures of docs/cushion-laboratory.md"]
fn campaign_of_every_pad_on_every_recorder() {
    campaign(true);
}

#[test]
#[ignore = "some minutes: the same where nobody states the corner"]
fn campaign_of_every_pad_behind_an_unstated_filter() {
    campaign(false);
}
