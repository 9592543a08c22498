//! Random numbers keyed by their use.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardNormal};

/// The random numbers of one draw for one object under one motion: ChaCha8 with a 256-bit key that
/// holds the four numbers, each as 8 bytes, little endian.
///
/// Nothing else affects them: not the thread, the order or the shard in which objects are
/// calculated. The streams of two keys that differ in any bit are statistically independent.
///
/// # Reference
/// Bernstein (2008), ChaCha; Salmon et al. (2011), counter-based random numbers.
///
/// # Example
/// ```
/// use freestand::fragility::{draw_stream, lognormal_draw};
/// let one = lognormal_draw(&mut draw_stream(1, 7, 3, 0), 2.0, 0.1);
/// assert_eq!(one, lognormal_draw(&mut draw_stream(1, 7, 3, 0), 2.0, 0.1));
/// assert_ne!(one, lognormal_draw(&mut draw_stream(1, 7, 3, 1), 2.0, 0.1));
/// ```
pub fn draw_stream(seed: u64, object: u64, record: u64, draw: u64) -> ChaCha8Rng {
    let mut key = [0; 32];
    for (bytes, number) in key.chunks_exact_mut(8).zip([seed, object, record, draw]) {
        bytes.copy_from_slice(&number.to_le_bytes());
    }
    ChaCha8Rng::from_seed(key)
}

/// A lognormal number, median·exp(log_sd·N): positive, half of them below the median. `log_sd` is
/// the standard deviation of the logarithm.
pub fn lognormal_draw(random: &mut ChaCha8Rng, median: f64, log_sd: f64) -> f64 {
    let normal: f64 = StandardNormal.sample(random);
    median * (log_sd * normal).exp()
}

/// A number between `low` and `high`, uniform.
///
/// # Example
/// ```
/// use freestand::fragility::{draw_stream, uniform_draw};
/// let ratio = uniform_draw(&mut draw_stream(1, 7, 3, 0), 0.2, 0.8);
/// assert!((0.2..=0.8).contains(&ratio));
/// assert_eq!(uniform_draw(&mut draw_stream(1, 7, 3, 0), 0.3, 0.3), 0.3);
/// ```
pub fn uniform_draw(random: &mut ChaCha8Rng, low: f64, high: f64) -> f64 {
    let share: f64 = random.random();
    low + (high - low) * share
}

/// A number between `low` and `high` whose logarithm is uniform; both must be positive.
///
/// # Example
/// ```
/// use freestand::fragility::{draw_stream, log_uniform_draw};
/// let ratio = log_uniform_draw(&mut draw_stream(1, 7, 3, 0), 0.05, 0.20);
/// assert!((0.05..=0.20).contains(&ratio));
/// assert_eq!(log_uniform_draw(&mut draw_stream(1, 7, 3, 0), 0.1, 0.1), 0.1);
/// ```
pub fn log_uniform_draw(random: &mut ChaCha8Rng, low: f64, high: f64) -> f64 {
    let share: f64 = random.random();
    low * (high / low).powf(share)
}
