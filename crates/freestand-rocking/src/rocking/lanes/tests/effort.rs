//! The work that histories take. A number that changes here is speed lost or gained: whoever
//! changes one knowingly writes the new one down.

use super::super::{DEGREES, Plan, Rocker, Tile, WallRecord, plan, prepare};
use super::trouble::Random;
use crate::block::Block;
use crate::motion::Motion;
use crate::rocking::{Accuracy, Base, RockingOptions, Until, rock};
use crate::wall::{Wall, Walls};

/// Peak 3 m/s²: two halves of a cycle of 0.5 s, each a parabola, and quiet.
fn pulse() -> Motion {
    let half = |i: usize| 3.0 * f64::from(i as u32 * (25 - i as u32)) / 156.25;
    let at = |k: usize| if k < 25 { half(k) } else { -half(k - 25) };
    Motion::new(
        0.01,
        (0..200).map(|k| if k < 50 { at(k) } else { 0.0 }).collect(),
    )
    .unwrap()
}

/// 10 s of ±4 m/s².
fn noise(seed: u64) -> Motion {
    let mut random = Random::new(seed);
    Motion::new(0.01, (0..1000).map(|_| random.between(-4.0, 4.0)).collect()).unwrap()
}

fn cabinet() -> Block {
    Block::uniform(2.0, 0.4).unwrap()
}

/// 144 blocks 0.5–2.7 m high and as slender as 3 to 8.5.
fn furniture() -> Vec<Block> {
    let block = |i: usize| {
        let height = 0.5 + 0.2 * (i / 12) as f64;
        Block::uniform(height, height / (3.0 + 0.5 * (i % 12) as f64)).unwrap()
    };
    (0..144).map(block).collect()
}

fn across(motion: &Motion) -> Base<'_> {
    Base {
        horizontal: Some(motion),
        vertical: None,
    }
}

fn at(accuracy: Accuracy) -> RockingOptions {
    RockingOptions {
        accuracy,
        ..RockingOptions::default()
    }
}

fn until_rest() -> RockingOptions {
    RockingOptions {
        until: Until::Settled { at_most_s: 60.0 },
        ..RockingOptions::default()
    }
}

/// Taylor steps, terms of their series, and impacts.
fn scalar(base: Base, options: &RockingOptions) -> [usize; 3] {
    let history = rock(&cabinet(), base, options).unwrap();
    [
        history.effort.steps,
        history.effort.evaluations,
        history.impacts.len(),
    ]
}

/// Steps of blocks that move, batches of events, events, and those left to all roots of the series.
fn kernel(base: Base, options: &RockingOptions) -> [usize; 4] {
    let (shaking, wait) = prepare(base, options).unwrap();
    let mut planned: Vec<(Plan, Rocker, WallRecord)> = furniture()
        .iter()
        .map(|block| plan(block, &shaking, options).unwrap())
        .collect();
    planned.sort_by_key(|(plan, ..)| *plan);
    let mut sum = [0; 4];
    for tile in planned.chunk_by(|(a, ..), (b, ..)| a == b) {
        let plan = tile[0].0;
        let (rockers, walls): (Vec<Rocker>, Vec<WallRecord>) = tile
            .iter()
            .map(|(_, rocker, wall)| (*rocker, *wall))
            .unzip();
        let mut tile = Tile::new(
            pulp::Arch::new(),
            DEGREES[plan.degree],
            &shaking,
            &rockers,
            walls,
            plan.parts,
        );
        tile.run(wait);
        sum = [
            sum[0] + tile.work.steps,
            sum[1] + tile.work.batches,
            sum[2] + tile.work.events,
            sum[3] + tile.work.intricate,
        ];
    }
    sum
}

#[test]
fn scalar_solver_at_rest() {
    assert_eq!(
        scalar(across(&pulse().scaled(0.6).unwrap()), &until_rest()),
        [0, 0, 0]
    );
}

#[test]
fn scalar_solver_let_go() {
    let let_go = RockingOptions {
        initial_rotation_rad: 0.1,
        ..until_rest()
    };
    assert_eq!(
        scalar(across(&Motion::new(0.01, vec![0.0; 2]).unwrap()), &let_go),
        [378, 6403, 336]
    );
}

#[test]
fn scalar_solver_under_a_pulse() {
    assert_eq!(scalar(across(&pulse()), &until_rest()), [556, 7549, 335]);
}

#[test]
fn scalar_solver_under_noise_fast() {
    assert_eq!(
        scalar(across(&noise(1)), &at(Accuracy::Fast)),
        [1117, 7947, 118]
    );
}

#[test]
fn scalar_solver_under_noise_standard() {
    assert_eq!(
        scalar(across(&noise(1)), &at(Accuracy::Standard)),
        [1107, 10732, 108]
    );
}

#[test]
fn scalar_solver_under_noise_tight() {
    assert_eq!(
        scalar(across(&noise(1)), &at(Accuracy::Tight)),
        [1107, 12732, 108]
    );
}

#[test]
fn kernel_at_rest() {
    assert_eq!(
        kernel(across(&pulse().scaled(0.1).unwrap()), &until_rest()),
        [0, 0, 0, 0]
    );
}

#[test]
fn kernel_under_a_pulse() {
    assert_eq!(
        kernel(across(&pulse()), &until_rest()),
        [43326, 1423, 2884, 68]
    );
}

#[test]
fn kernel_under_noise_fast() {
    assert_eq!(
        kernel(across(&noise(1)), &at(Accuracy::Fast)),
        [124733, 3514, 28911, 1570]
    );
}

#[test]
fn kernel_under_noise_standard() {
    assert_eq!(
        kernel(across(&noise(1)), &at(Accuracy::Standard)),
        [125228, 5259, 27749, 1609]
    );
}

#[test]
fn kernel_under_noise_tight() {
    assert_eq!(
        kernel(across(&noise(1)), &at(Accuracy::Tight)),
        [132535, 4370, 27244, 1508]
    );
}

#[test]
fn kernel_with_vertical_motion() {
    let base = Base {
        horizontal: Some(&noise(1)),
        vertical: Some(&noise(2)),
    };
    assert_eq!(
        kernel(base, &at(Accuracy::Standard)),
        [122789, 2410, 19844, 1622]
    );
}

/// 20 mm to both walls.
#[test]
fn kernel_between_walls() {
    let wall = Some(Wall::at(0.02));
    let options = RockingOptions {
        walls: Walls {
            left: wall,
            right: wall,
        },
        ..at(Accuracy::Standard)
    };
    assert_eq!(
        kernel(across(&noise(1)), &options),
        [142063, 5345, 32110, 1143]
    );
}
