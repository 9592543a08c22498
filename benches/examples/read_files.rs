//! Times the reading of record files on one thread [s], the median of five; `compare.py` compares
//! it with other readers.

#![expect(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a benchmark may stop, and says what it measured"
)]

use freestand_records::formats::{ReadOptions, read_motions};
use std::time::Instant;

fn main() {
    let paths: Vec<String> = std::env::args().skip(1).collect();
    let options = ReadOptions::default();
    let mut times_s: Vec<f64> = (0..5)
        .map(|_| {
            let start = Instant::now();
            for path in &paths {
                let file = read_motions(path.as_ref(), &options).unwrap();
                assert!(
                    file.components
                        .iter()
                        .all(|one| one.motion.peak_m_s2() > 0.0),
                    "{path}"
                );
            }
            start.elapsed().as_secs_f64()
        })
        .collect();
    times_s.sort_by(f64::total_cmp);
    println!("{}", times_s[2]);
}
