//! Holds the benchmarks of `benches/`; nothing else depends on it.

use std::time::Duration;

/// Processor time of this thread so far: what else the machine does hardly changes a benchmark that
/// measures it. Only Linux tells it, in steps of a few milliseconds.
pub fn processor_time() -> Option<Duration> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    text.split(' ')
        .next()?
        .parse()
        .ok()
        .map(Duration::from_nanos)
}

/// Processor time of `rounds` runs, or the time that passes where the former is not known.
pub fn time_of<T>(rounds: u64, mut run: impl FnMut() -> T) -> Duration {
    let (begin, passed) = (processor_time(), std::time::Instant::now());
    for _ in 0..rounds {
        std::hint::black_box(run());
    }
    processor_time()
        .zip(begin)
        .map_or(passed.elapsed(), |(end, begin)| end - begin)
}
