//! Kernel against scalar on trouble.
#![allow(clippy::unwrap_used, clippy::print_stdout)]
use freestand::block::Block;
use freestand::motion::Motion;
use freestand::rocking::{Accuracy, Base, RockingOptions, Restitution, RockingModel, Until, rock_many, rock};
struct R(u64);
impl R { fn n(&mut self) -> f64 { self.0 ^= self.0 << 13; self.0 ^= self.0 >> 7; self.0 ^= self.0 << 17; (self.0 >> 11) as f64 / (1u64 << 53) as f64 }
 fn between(&mut self, a: f64, b: f64) -> f64 { a + (b - a) * self.n() }
 fn log(&mut self, a: f64, b: f64) -> f64 { (a.ln() + (b / a).ln() * self.n()).exp() } }
fn main() {
    let seed: u64 = std::env::args().nth(1).map_or(1, |s| s.parse().unwrap());
    let rounds: usize = std::env::args().nth(2).map_or(200, |s| s.parse().unwrap());
    let mut r = R(seed.wrapping_mul(0x9E3779B97F4A7C15) | 1);
    let (mut total, mut bad, mut outcome_bad, mut sens, mut counts, mut errs) = (0, 0, 0, 0, 0, 0);
    let mut worst = 0.0f64;
    for round in 0..rounds {
        let n = 50 + (r.n() * 600.0) as usize;
        let dt = r.log(0.001, 0.02);
        let pga = r.log(0.05, 3.0) * 9.80665;
        let kind = (r.n() * 5.0) as usize;
        let (f1, f2, ph) = (r.log(0.2, 15.0), r.log(0.2, 15.0), r.between(0.0, 6.3));
        let shape = |k: usize, r: &mut R| -> f64 { let t = k as f64 * dt; match kind {
            0 => (f1 * 6.283 * t).sin() * 0.6 + 0.4 * (f2 * 6.283 * t + ph).sin(),
            1 => if (t * f1).fract() < 0.5 { 1.0 } else { -1.0 },
            2 => r.between(-1.0, 1.0),
            3 => if t * f1 < 1.0 { (f1 * 6.283 * t).sin() } else { 0.0 },
            _ => if r.n() < 0.05 { r.between(-1.0, 1.0) } else { 0.0 } } };
        let a: Vec<f64> = (0..n).map(|k| pga * shape(k, &mut r)).collect();
        let vertical = r.n() < 0.3;
        let av: Vec<f64> = (0..n).map(|k| 0.3 * 9.8 * shape(k, &mut r)).collect();
        let (h, v) = (Motion::new(dt, a.clone()).unwrap(), Motion::new(dt, av).unwrap());
        let base = Base { horizontal: Some(&h), vertical: vertical.then_some(&v) };
        let restitution = match (r.n() * 4.0) as usize { 0 => Restitution::Value(r.n()), 1 => Restitution::Factor(r.between(0.5, 1.0)), _ => Restitution::Housner };
        let linear = r.n() < 0.1;
        let until = if r.n() < 0.5 { Until::EndOfMotion } else { Until::Settled { at_most_s: 60.0 } };
        let options = RockingOptions { model: if linear { RockingModel::Linearised } else { RockingModel::Rigid }, restitution, until, accuracy: Accuracy::Standard, ..Default::default() };
        let blocks: Vec<Block> = (0..40).map(|_| { let s = r.log(0.8, 50.0); let hh = if r.n() < 0.7 { r.log(0.2, 5.0) } else { r.log(0.001, 100.0) };
            let b = Block::uniform(hh, hh / s).unwrap(); if r.n() < 0.2 { let o = 0.3 * hh / s * r.between(-0.5, 0.5); b.with_cg_offset(o).unwrap_or(b) } else { b } }).collect();
        let many = rock_many(&blocks, base, &options);
        let up = Motion::new(dt, a.iter().map(|x| x * (1.0 + 1e-10)).collect()).unwrap();
        let base_up = Base { horizontal: Some(&up), vertical: vertical.then_some(&v) };
        let tight = RockingOptions { accuracy: Accuracy::Tight, ..options };
        for (i, (b, m)) in blocks.iter().zip(&many).enumerate() {
            total += 1;
            let s = rock(b, base, &tight); let p = rock(b, base_up, &tight);
            let (Ok(s), Ok(p), Ok(m)) = (&s, &p, m) else { if s.is_ok() != m.is_ok() { errs += 1; println!("errs {round} {i} {s:?} {m:?}"); } continue };
            let amplification = if s.outcome == p.outcome { (s.peak_rotation_rad - p.peak_rotation_rad).abs() / s.peak_rotation_rad.max(1e-300) / 1e-10 } else { 1e9 };
            if amplification > 1e4 { sens += 1; continue; }
            if s.outcome != m.outcome || s.stop != m.stop { outcome_bad += 1; println!("OUTCOME {round} {i} kind {kind} lin {linear} vert {vertical} {:?} {:?} {:?} {:?} peak {} {} amp {amplification:.1e} h {} t {} dt {dt} until {until:?}", s.outcome, m.outcome, s.stop, m.stop, s.peak_rotation_rad, m.peak_rotation_rad, b.height_m(), b.thickness_m()); continue; }
            let e = (s.peak_rotation_rad - m.peak_rotation_rad).abs() / s.peak_rotation_rad.max(1e-12);
            let scaled = e / amplification.max(1.0);
            worst = worst.max(scaled);
            if scaled > 1e-8 { bad += 1; println!("PEAK {round} {i} kind {kind} lin {linear} vert {vertical} err {e:.1e} amp {amplification:.1e} peak {} {} impacts {} {} h {} t {} dt {dt} rest {restitution:?}", s.peak_rotation_rad, m.peak_rotation_rad, s.impacts.len(), m.impact_count, b.height_m(), b.thickness_m()); }
            if s.impacts.len() != m.impact_count && amplification < 100.0 { counts += 1; if s.impacts.len().abs_diff(m.impact_count) > 2 { println!("COUNT {round} {i} {} {} h {} t {} lin {linear} vert {vertical} until {until:?} rest {restitution:?}", s.impacts.len(), m.impact_count, b.height_m(), b.thickness_m()); } }
        }
    }
    println!("total {total} sensitive {sens} outcome bad {outcome_bad} bad {bad} counts {counts} errs {errs} worst scaled {worst:.1e}");
}
