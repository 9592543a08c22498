//! How good probabilities are.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::data::{Test, motions};

/// Samples of motions for an interval.
const SAMPLES: usize = 4000;

/// How often a model is right, if it says of each test what is more probable.
pub(crate) struct Scores {
    pub(crate) right_ratio: f64,
    /// It says that a rock falls that stood.
    pub(crate) false_alarms: usize,
    /// It says that a rock stands that fell.
    pub(crate) misses: usize,
}

impl Scores {
    pub(crate) fn of(said: &[f64], fell: &[bool]) -> Self {
        let count = |is: fn(bool, bool) -> bool| {
            let both = said.iter().zip(fell);
            both.filter(|(said, fell)| is(**said >= 0.5, **fell))
                .count()
        };
        Self {
            right_ratio: count(|said, fell| said == fell) as f64 / said.len() as f64,
            false_alarms: count(|said, fell| said && !fell),
            misses: count(|said, fell| !said && fell),
        }
    }
}

fn square(said: f64, fell: bool) -> f64 {
    let error = said - f64::from(u8::from(fell));
    error * error
}

/// The mean; of [`squares`] it is the Brier score (Brier 1950).
pub(crate) fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// The square of the error of each probability.
pub(crate) fn squares(said: &[f64], fell: &[bool]) -> Vec<f64> {
    let both = said.iter().zip(fell);
    both.map(|(said, fell)| square(*said, *fell)).collect()
}

/// The 90 % interval of the mean of a value of each test: whole motions are drawn again, because tests under
/// one motion are not independent.
pub(crate) fn clustered_interval(tests: &[Test], values: &[f64]) -> (f64, f64) {
    let clusters: Vec<(f64, usize)> = motions(tests)
        .into_iter()
        .map(|motion| {
            let of = tests
                .iter()
                .zip(values)
                .filter(|(test, _)| test.motion == motion);
            of.fold((0.0, 0), |(sum, count), (_, value)| {
                (sum + value, count + 1)
            })
        })
        .collect();
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let mut means: Vec<f64> = (0..SAMPLES)
        .map(|_| {
            let drawn =
                (0..clusters.len()).map(|_| clusters[random.random_range(0..clusters.len())]);
            let (sum, count) = drawn.fold((0.0, 0), |all, one| (all.0 + one.0, all.1 + one.1));
            sum / count as f64
        })
        .collect();
    means.sort_by(f64::total_cmp);
    (means[SAMPLES / 20], means[SAMPLES - 1 - SAMPLES / 20])
}

/// The probability at `x` of the logistic curve through these outcomes, by Newton's method, with a weak
/// pull to zero slope so that outcomes which a threshold separates have a curve.
pub(crate) fn logistic(known: &[(f64, bool)], x: f64) -> f64 {
    const PULL: f64 = 1e-3;
    let (mut a, mut b) = (0.0_f64, 0.0_f64);
    for _ in 0..50 {
        let (mut ga, mut gb) = (-PULL * a, -PULL * b);
        let (mut haa, mut hab, mut hbb) = (PULL, 0.0, PULL);
        for (x, fell) in known {
            let p = 1.0 / (1.0 + (-a - b * x).exp());
            let error = f64::from(u8::from(*fell)) - p;
            let weight = p * (1.0 - p);
            ga += error;
            gb += error * x;
            haa += weight;
            hab += weight * x;
            hbb += weight * x * x;
        }
        let determinant = haa * hbb - hab * hab;
        let (da, db) = (
            (hbb * ga - hab * gb) / determinant,
            (haa * gb - hab * ga) / determinant,
        );
        (a, b) = (a + da, b + db);
        if da.abs() + db.abs() < 1e-10 {
            break;
        }
    }
    1.0 / (1.0 + (-a - b * x).exp())
}

/// Tests of a range of probabilities.
pub(crate) struct Bin {
    pub(crate) rock: usize,
    pub(crate) tests: usize,
    pub(crate) said_mean: f64,
    pub(crate) fell_share: f64,
}

/// The share that fell by what was said: none of 20, up to a fifth, and so on.
pub(crate) fn reliability(ensembles: &[(Vec<f64>, Vec<bool>)]) -> Vec<Bin> {
    const EDGES: [f64; 7] = [0.0, 0.001, 0.2, 0.4, 0.6, 0.8, 1.001];
    let mut bins = Vec::new();
    for (rock, (said, fell)) in ensembles.iter().enumerate() {
        for edges in EDGES.windows(2) {
            let inside: Vec<(f64, bool)> = said
                .iter()
                .zip(fell)
                .filter(|(said, _)| (edges[0]..edges[1]).contains(*said))
                .map(|(said, fell)| (*said, *fell))
                .collect();
            if inside.is_empty() {
                continue;
            }
            let count = inside.len() as f64;
            bins.push(Bin {
                rock: rock + 1,
                tests: inside.len(),
                said_mean: inside.iter().map(|one| one.0).sum::<f64>() / count,
                fell_share: inside.iter().filter(|one| one.1).count() as f64 / count,
            });
        }
    }
    bins
}

pub(crate) fn reliability_csv(bins: &[Bin]) -> String {
    let mut text = String::from("rock,tests,p_mean,overturned_share\n");
    for bin in bins {
        text.push_str(&format!(
            "{},{},{:.4},{:.4}\n",
            bin.rock, bin.tests, bin.said_mean, bin.fell_share
        ));
    }
    text
}
