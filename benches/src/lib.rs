//! Holds the benchmarks of `benches/`; nothing else depends on it.
