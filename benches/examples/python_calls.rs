//! Times what `python_calls.py` times from Python: one `rock`, and spectra of 1,000 and 4,096 objects
//! on one thread. Prints seconds, the least of several turns.
//!
//! `python_calls.rs RECORD.csv`: a record with a scale that lifts the objects.

#![expect(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a benchmark may stop, and says what it measured"
)]

use std::hint::black_box;
use std::time::Instant;

use freestand::block::Block;
use freestand::motion::Motion;
use freestand::respond::{HistoryOptions, RigidPlane, Settings};
use freestand::rocking::{Restitution, Until};
use freestand::wall::Walls;
use freestand_input::keys::Words;
use freestand_records::formats::{ReadOptions, read_motions};
use freestand_study::cushion;
use freestand_study::rock::{RockRequest, rock};
use freestand_study::spectrum::{
    Grid, SpectrumMotion, SpectrumRequest, SpectrumTally, chunk_objects, spectrum,
};

fn least(turns: usize, mut work: impl FnMut()) -> f64 {
    let time = |_| {
        let start = Instant::now();
        work();
        start.elapsed().as_secs_f64()
    };
    (0..turns).map(time).fold(f64::INFINITY, f64::min)
}

fn main() {
    rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build_global()
        .unwrap();
    let path = std::env::args().nth(1).unwrap();
    let read = read_motions(path.as_ref(), &ReadOptions::default())
        .unwrap()
        .components
        .remove(0)
        .motion;
    let scaled: Vec<f64> = read.accel_m_s2().iter().map(|a| 3.5 * a).collect();
    let motion = Motion::new(read.dt_s(), scaled).unwrap();
    let words: Words = [("stiffness", "4380 N/mm")].into_iter().collect();
    let edge = cushion::resolve(&words, Some(150.0)).unwrap();
    let settings = Settings {
        until: Until::EndOfMotion,
        ..Settings::default()
    };
    let standing = |thickness_m, height_m| {
        let block = Block::uniform(height_m, thickness_m).unwrap();
        RigidPlane::along_x(block, Restitution::Housner, Walls::NONE)
    };
    let request = RockRequest {
        object: standing(0.4, 1.8),
        horizontal: Some(motion.clone()),
        vertical: None,
        how: HistoryOptions {
            settings,
            ..HistoryOptions::default()
        },
        cushion: Some((150.0, edge.clone())),
        wall: Default::default(),
        friction: None,
    };
    println!(
        "rock {:e}",
        least(2000, || drop(black_box(rock(&request.clone()).unwrap())))
    );
    let still = RockRequest {
        object: standing(0.4, 0.4),
        ..request.clone()
    };
    println!(
        "still {:e}",
        least(2000, || drop(black_box(rock(&still.clone()).unwrap())))
    );
    for (heights, thicknesses) in [(40, 25), (64, 64)] {
        let grid = |count: usize, from: f64, to: f64| -> Vec<f64> {
            (0..count)
                .map(|i| from + (to - from) * i as f64 / (count - 1) as f64)
                .collect()
        };
        let grid = Grid::new(grid(heights, 0.3, 3.0), grid(thicknesses, 0.1, 1.0)).unwrap();
        let request = SpectrumRequest {
            grid,
            restitution: Restitution::Housner,
            walls: Walls::NONE,
            settings,
            cushion: Some((150.0, edge.clone())),
            wall: Default::default(),
            sensitivity: false,
            surface: None,
        };
        let motions = [SpectrumMotion {
            name: "m".to_owned(),
            horizontal: motion.clone(),
            vertical: None,
        }];
        let took = least(20, || {
            let mut tallies = [SpectrumTally::default()];
            let mut rows = 0;
            spectrum(&request, &motions, chunk_objects, |chunk| {
                chunk.add_to(&mut tallies[0]);
                rows += chunk.rows().count();
                Ok::<(), freestand_input::Problem>(())
            })
            .unwrap();
            assert_eq!(rows, heights * thicknesses);
        });
        println!("spectrum{} {took:e}", heights * thicknesses);
    }
}
