//! Kernel against scalar.
#![allow(clippy::unwrap_used, clippy::print_stdout)]
use freestand::block::Block;
use freestand::motion::Motion;
use freestand::rocking::{Accuracy, Base, RockingOptions, Outcome, rock_many, rock};
use std::time::Instant;
fn main() {
    let text = include_str!("../../validation/rocking/records/bench4000.csv");
    let scale: f64 = std::env::args().nth(1).map_or(1.0, |s| s.parse().unwrap());
    let samples: Vec<f64> = text.lines().filter(|line| !line.starts_with('#')).map(|line| scale*line.parse::<f64>().unwrap()).collect();
    let record = Motion::new(0.005, samples).unwrap();
    let base = Base { horizontal: Some(&record), vertical: None };
    let at = |from: f64, to: f64, i: usize| from + (to - from) * i as f64 / 63.0;
    let blocks: Vec<Block> = (0..64).flat_map(|i| (0..64).map(move |j| Block::uniform(at(0.3, 4.0, i), at(0.1, 1.0, j)).unwrap())).collect();
    let steps = 4096.0 * 3999.0;
    let t = Instant::now();
    let tight: Vec<_> = blocks.iter().map(|b| rock(b, base, &RockingOptions { accuracy: Accuracy::Fast, ..Default::default() }).unwrap()).collect();
    println!("scalar tight {:.2} ns", t.elapsed().as_secs_f64() * 1e9 / steps);
    let moved: usize = tight.iter().map(|r| r.effort.steps).sum();
    println!("moving {:.3}", moved as f64 / steps);
    for accuracy in [Accuracy::Standard] {
        let options = RockingOptions { accuracy, ..Default::default() };
        let pool = rayon_pool();
        let mut best = f64::INFINITY;
        let mut out = vec![];
        for _ in 0..40 { let t = Instant::now(); out = pool.install(|| rock_many(&blocks, base, &options)); best = best.min(t.elapsed().as_secs_f64()); }
        let mut errors = vec![]; let mut mismatch = 0; let mut counts = 0; let mut omega = 0.0f64;
        for (a, b) in tight.iter().zip(&out) { let b = b.unwrap();
            if a.outcome != b.outcome { mismatch += 1; println!("{:?} {:?} {} {}", a.outcome, b.outcome, a.peak_rotation_rad, b.peak_rotation_rad); continue; }
            if a.outcome == Outcome::Rocked { let e = (a.peak_rotation_rad / b.peak_rotation_rad - 1.0).abs(); if e > 1e-5 { println!("  bad {e:.2e} {} {} impacts {} {} uplifts {}", a.peak_rotation_rad, b.peak_rotation_rad, a.impacts.len(), b.impact_count, a.uplift_count); }
              errors.push((a.peak_rotation_rad / b.peak_rotation_rad - 1.0).abs());
              if a.impacts.len() != b.impact_count { counts += 1; }
              for s in 0..2 { if a.sides[s].impact_omega_rad_s > 0.0 { omega = omega.max((a.sides[s].impact_omega_rad_s / b.sides[s].impact_omega_rad_s - 1.0).abs()); } } }
        }
        errors.sort_by(f64::total_cmp);
        let q = |p: f64| errors[((errors.len() - 1) as f64 * p) as usize];
        println!("{accuracy:?}: {:.3} ns nominal, {:.2} ns moving; rocked {} error median {:.1e} 99% {:.1e} max {:.1e}; outcome mismatch {mismatch}, count mismatch {counts}, omega {omega:.1e}", best * 1e9 / steps, best*1e9/moved as f64, errors.len(), q(0.5), q(0.99), q(1.0));
    }
}
fn rayon_pool() -> rayon::ThreadPool { rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap() }
