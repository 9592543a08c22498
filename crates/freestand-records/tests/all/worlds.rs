//! How often blocks fall in synthetic worlds, against the far-field records of FEMA P-695. The records belong to
//! others and are not shipped; see [`super::suites`].

#![allow(
    clippy::expect_used,
    clippy::panic,
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "the lint configuration exempts test functions, but not the helpers of an integration test"
)]

use freestand::block::Block;
use freestand::building::{Building, Damping, Storey, floor_motion};
use freestand::measures::measures;
use freestand::motion::Motion;
use freestand::rocking::{Base, Outcome, RockingOptions, Until, rock_many};
use freestand::synthesis::{QuickMatcher, SynthesisOptions};
use freestand::worlds::{
    Component, GroundSpread, Group, SpreadOptions, WorldDraw, place_among, world_motion,
    world_stream,
};
use rayon::prelude::*;

use super::suites::{code, ln_sa, mean, pairs, periods_s};

const WORLDS: u32 = 640;
const SAMPLES: u32 = 1000;

/// The bins of the probability of a block: the mean of both sides, so that neither chooses the blocks.
const BINS: [(f64, f64); 3] = [(0.001, 0.02), (0.02, 0.15), (0.15, 0.5)];

/// Five equal storeys, T₁ = 0.65 s, 5 % damping.
fn five_storeys() -> Building {
    let storey = Storey {
        mass_kg: 2e5,
        stiffness_n_m: 2e8,
        height_m: 3.2,
    };
    let building = Building::shear(&[storey; 5], &Damping::Uniform(0.05), 5).unwrap();
    let factor = 0.65 / building.period_s();
    building.with_factors(factor, 1.0).unwrap()
}

/// 0.5 to 2.5 m high, 1.5 to 18 times as high as thick.
fn blocks() -> Vec<Block> {
    let heights = [0.5, 0.8, 1.2, 1.8, 2.5];
    let slenderness = |i: i32| 1.5 * 12_f64.powf(f64::from(i) / 35.0);
    heights
        .into_iter()
        .flat_map(|height_m| {
            (0..36).map(move |i| Block::uniform(height_m, height_m / slenderness(i)).unwrap())
        })
        .collect()
}

/// How many of the two components of a motion overturn each block, on the ground and on the roof.
type Falls = [Vec<f64>; 2];

fn falls(pair: &[Motion; 2], factor: f64, blocks: &[Block], building: &Building) -> Falls {
    let options = RockingOptions {
        until: Until::Settled { at_most_s: 120.0 },
        ..RockingOptions::default()
    };
    let of = |motion: &Motion| -> Vec<f64> {
        let base = Base {
            horizontal: Some(motion),
            vertical: None,
        };
        rock_many(blocks, base, &options)
            .into_iter()
            .map(|found| f64::from(u8::from(found.unwrap().outcome == Outcome::Overturned)))
            .collect()
    };
    let both = pair.each_ref().map(|motion| {
        let ground = motion.scaled(factor).unwrap();
        let padded = ground.with_zero_tail(building.tail_s()).unwrap();
        [
            of(&ground),
            of(&floor_motion(&padded, building, 1.0).unwrap()),
        ]
    });
    [0, 1].map(|place| {
        let [x, y] = [&both[0][place], &both[1][place]];
        x.iter().zip(y).map(|(a, b)| 0.5 * (a + b)).collect()
    })
}

/// Mean over the motions, each counted so often.
fn shares(all: &[Falls], place: usize, counts: &[f64]) -> Vec<f64> {
    let total: f64 = counts.iter().sum();
    (0..all[0][place].len())
        .map(|block| {
            let sum: f64 = all
                .iter()
                .zip(counts)
                .map(|(one, count)| count * one[place][block])
                .sum();
            sum / total
        })
        .collect()
}

/// Motions drawn with replacement.
fn drawn(count: usize, sample: u32, of_worlds: u32) -> Vec<f64> {
    let mut random = world_stream(7, sample, Group::Model, of_worlds);
    let mut counts = vec![0.0; count];
    for _ in 0..count {
        counts[place_among(&mut random, count)] += 1.0;
    }
    counts
}

fn interval(mut values: Vec<f64>) -> [f64; 2] {
    values.sort_by(f64::total_cmp);
    let at = |share: f64| values[((values.len() - 1) as f64 * share).round() as usize];
    [at(0.05), at(0.95)]
}

#[test]
#[ignore = "a minute: 2 × 640 motions are matched, and 180 blocks rock under each; run it after a change of the worlds"]
fn how_often_blocks_fall_in_worlds_and_under_records() {
    let Some(pairs) = pairs() else { return };
    let (blocks, building) = (blocks(), five_storeys());
    let spread = GroundSpread::new(SpreadOptions::default()).unwrap();
    let matcher = QuickMatcher::new(&SynthesisOptions::default()).unwrap();
    let worlds: Vec<Falls> = (0..WORLDS)
        .into_par_iter()
        .map(|world| {
            let spectra = spread.spectra(1, world, 0);
            let pair = [Component::X, Component::Y].map(|component| {
                world_motion(
                    code,
                    &spectra,
                    component,
                    WorldDraw {
                        seed: 1,
                        world,
                        repetition: 0,
                    },
                    &matcher,
                )
                .unwrap()
            });
            falls(&pair, 1.0, &blocks, &building)
        })
        .collect();
    // How far the mean of ln Sa over 0.2 to 3 s of a pair is below the target.
    let target = mean(
        &periods_s()
            .iter()
            .map(|t| code(*t).ln())
            .collect::<Vec<_>>(),
    );
    let below: Vec<f64> = pairs
        .iter()
        .map(|pair| {
            let of = |motion: &Motion| mean(&ln_sa(motion)) - freestand::G0_M_S2.ln();
            target - mean(&pair.each_ref().map(of))
        })
        .collect();
    let ln_pgv: Vec<f64> = pairs
        .iter()
        .map(|pair| mean(&pair.each_ref().map(|motion| measures(motion).pgv_m_s.ln())))
        .collect();
    // Made equal in PGV, and then all by one factor.
    let common = mean(&below) + mean(&ln_pgv);
    let normalised: Vec<f64> = ln_pgv.iter().map(|ln| common - ln).collect();
    let mut compared = Vec::new();
    println!("| floor | records | P | blocks | worlds | records | ratio |");
    for (name, ln_factors) in [
        ("each record scaled", below),
        ("normalised by PGV", normalised),
    ] {
        let records: Vec<Falls> = pairs
            .par_iter()
            .zip(ln_factors)
            .map(|(pair, ln)| falls(pair, ln.exp(), &blocks, &building))
            .collect();
        for (place, floor) in ["ground", "roof"].into_iter().enumerate() {
            let sides = |sample: Option<u32>| {
                let counts = |all: &[Falls], side| match sample {
                    Some(sample) => drawn(all.len(), sample, side),
                    None => vec![1.0; all.len()],
                };
                [
                    shares(&worlds, place, &counts(&worlds, 0)),
                    shares(&records, place, &counts(&records, 1)),
                ]
            };
            let whole = sides(None);
            let samples: Vec<_> = (0..SAMPLES)
                .into_par_iter()
                .map(|i| sides(Some(i)))
                .collect();
            for (low, high) in BINS {
                let middle = |i: usize| 0.5 * (whole[0][i] + whole[1][i]);
                let chosen: Vec<usize> = (0..blocks.len())
                    .filter(|&i| (low..high).contains(&middle(i)))
                    .collect();
                let of = |sides: &[Vec<f64>; 2]| {
                    let of_side = |side: &Vec<f64>| {
                        mean(&chosen.iter().map(|i| side[*i]).collect::<Vec<_>>())
                    };
                    let [of_worlds, of_records] = sides.each_ref().map(of_side);
                    [of_worlds, of_records, of_worlds / of_records]
                };
                let found = of(&whole);
                let spread = [0, 1, 2]
                    .map(|which| interval(samples.iter().map(|one| of(one)[which]).collect()));
                let shown = |which: usize| {
                    let [least, most] = spread[which];
                    format!("{:.3} ({least:.3}–{most:.3})", found[which])
                };
                println!(
                    "| {floor} | {name} | {low}–{high} | {} | {} | {} | {} |",
                    chosen.len(),
                    shown(0),
                    shown(1),
                    shown(2)
                );
                compared.push((spread[2], found));
            }
        }
    }
    // What docs/validation.md says, by place in the table. Scaled one by one, neither floor differs at 2–15 %.
    for place in [1, 4] {
        let [least, most] = compared[place].0;
        assert!(least < 1.0 && most > 1.0, "{:?}", compared[place]);
    }
    // Normalised, the worlds have too few falls on the ground, and far too few in the lowest bin.
    assert!(compared[7].0[1] < 1.0, "{:?}", compared[7]);
    assert!(compared[6].1[2] < 0.5, "{:?}", compared[6]);
}
