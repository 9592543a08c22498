//! `kernel.rs CASE LEVEL`: the kernel for many blocks, on one thread, on the file that `peers/rk4.c` reads; it writes
//! the lines that the peers write. Like them, it ends at the last sample.

#![expect(
    clippy::panic,
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a measurement may stop, and says what it measured"
)]

use std::time::Instant;

use freestand::block::Block;
use freestand::motion::Motion;
use freestand::rocking::{Accuracy, Base, RockingOptions, rock_many};

fn main() {
    let [_, case, level] = &std::env::args().collect::<Vec<_>>()[..] else {
        panic!("kernel CASE LEVEL");
    };
    let levels = [Accuracy::Fast, Accuracy::Standard, Accuracy::Tight];
    let accuracy = levels
        .into_iter()
        .find(|one| one.name() == Some(level))
        .unwrap();
    let text = std::fs::read_to_string(case).unwrap();
    let mut numbers = text
        .split_whitespace()
        .map(|word| word.parse::<f64>().unwrap());
    let mut next = || numbers.next().unwrap();
    let (dt_s, gravity_m_s2, samples, count) = (next(), next(), next(), next());
    let motion = Motion::new(dt_s, (0..samples as usize).map(|_| next()).collect()).unwrap();
    let blocks: Vec<Block> = (0..count as usize)
        .map(|_| Block::uniform(next(), next()).unwrap())
        .collect();
    let base = Base {
        horizontal: Some(&motion),
        vertical: None,
    };
    let options = RockingOptions {
        accuracy,
        gravity_m_s2,
        ..RockingOptions::default()
    };
    let one = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .unwrap();
    let (seconds, found) = one.install(|| {
        let start = Instant::now();
        let found = rock_many(&blocks, base, &options);
        (start.elapsed().as_secs_f64(), found)
    });
    println!("{seconds:.9}");
    for rocking in found {
        println!("{:e}", rocking.unwrap().peak_rotation_rad);
    }
}
