//! One Runge–Kutta 5(4) step with an interpolating polynomial, for any equation of motion.

/// Nodes, weights and the error estimate of Dormand and Prince (1980).
const NODES: [f64; 6] = [0.2, 0.3, 0.8, 8.0 / 9.0, 1.0, 1.0];
const STAGES: [[f64; 6]; 6] = [
    [0.2, 0.0, 0.0, 0.0, 0.0, 0.0],
    [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0, 0.0],
    [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0, 0.0],
    [
        19372.0 / 6561.0,
        -25360.0 / 2187.0,
        64448.0 / 6561.0,
        -212.0 / 729.0,
        0.0,
        0.0,
    ],
    [
        9017.0 / 3168.0,
        -355.0 / 33.0,
        46732.0 / 5247.0,
        49.0 / 176.0,
        -5103.0 / 18656.0,
        0.0,
    ],
    [
        35.0 / 384.0,
        0.0,
        500.0 / 1113.0,
        125.0 / 192.0,
        -2187.0 / 6784.0,
        11.0 / 84.0,
    ],
];
const ERROR: [f64; 7] = [
    71.0 / 57600.0,
    0.0,
    -71.0 / 16695.0,
    71.0 / 1920.0,
    -17253.0 / 339200.0,
    22.0 / 525.0,
    -1.0 / 40.0,
];
/// Coefficients of the fourth-order interpolating polynomial: Hairer, Nørsett and Wanner, Solving
/// ODEs I, II.6.
const DENSE: [f64; 7] = [
    -12715105075.0 / 11282082432.0,
    0.0,
    87487479700.0 / 32700410799.0,
    -10690763975.0 / 1880347072.0,
    701980252875.0 / 199316789632.0,
    -1453857185.0 / 822651844.0,
    69997945.0 / 29380423.0,
];

/// Share of a value that counts towards its scale, so that the rounding of large rotations is not
/// taken for an error.
const RELATIVE: f64 = 1e-3;

/// An accepted step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Step<const N: usize> {
    pub(crate) start_s: f64,
    pub(crate) length_s: f64,
    pub(crate) start: [f64; N],
    pub(crate) end: [f64; N],
    /// Rates at the start and at the end.
    pub(crate) start_rates: [f64; N],
    pub(crate) end_rates: [f64; N],
    /// Error estimate relative to the scales of the state; above 1 the step was too long.
    pub(crate) error_ratio: f64,
    /// Number of entries of the state in use.
    len: usize,
    last: [f64; N],
}

/// What the error of a step is compared with.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Scales<'a, const N: usize> {
    /// Number of entries of the state in use.
    pub(crate) len: usize,
    /// The size of each entry.
    pub(crate) sizes: &'a [f64; N],
    /// An error ratio of 1 is this share of the sizes.
    pub(crate) tolerance: f64,
}

impl<const N: usize> Step<N> {
    /// A step over `length_s` from a state and its rates; `rates` writes the rates at a time and a
    /// state into its last argument.
    pub(crate) fn take(
        rates: impl Fn(f64, &[f64; N], &mut [f64; N]),
        start_s: f64,
        (start, start_rates): (&[f64; N], &[f64; N]),
        length_s: f64,
        Scales {
            len,
            sizes,
            tolerance,
        }: Scales<N>,
    ) -> Self {
        let mut slopes = [[0.0; N]; 7];
        slopes[0] = *start_rates;
        let mut y = *start;
        for (stage, row) in STAGES.iter().enumerate() {
            // A number of weights that the compiler knows, so that it unrolls the sums.
            let mean = match stage {
                0 => weighted(&[row[0]], &slopes, len),
                1 => weighted(&[row[0], row[1]], &slopes, len),
                2 => weighted(&[row[0], row[1], row[2]], &slopes, len),
                3 => weighted(&[row[0], row[1], row[2], row[3]], &slopes, len),
                4 => weighted(&[row[0], row[1], row[2], row[3], row[4]], &slopes, len),
                _ => weighted(row, &slopes, len),
            };
            for ((value, start), mean) in y.iter_mut().zip(start).zip(&mean).take(len) {
                *value = start + length_s * mean;
            }
            rates(
                start_s + NODES[stage] * length_s,
                &y,
                &mut slopes[stage + 1],
            );
        }
        let (dense, error) = (
            weighted(&DENSE, &slopes, len),
            weighted(&ERROR, &slopes, len),
        );
        let mut last = [0.0; N];
        let mut sum = 0.0;
        for i in 0..len {
            last[i] = length_s * dense[i];
            let scale = sizes[i] + RELATIVE * start[i].abs().max(y[i].abs());
            sum += (length_s * error[i] / (tolerance * scale)).powi(2);
        }
        Self {
            start_s,
            length_s,
            start: *start,
            end: y,
            start_rates: *start_rates,
            end_rates: slopes[6],
            error_ratio: (sum / len as f64).sqrt(),
            len,
            last,
        }
    }

    /// The state at a share of the step.
    pub(crate) fn state(&self, share: f64) -> [f64; N] {
        let rest = 1.0 - share;
        let mut y = self.start;
        for (i, value) in y[..self.len].iter_mut().enumerate() {
            let change = self.end[i] - self.start[i];
            let bend = self.length_s * self.start_rates[i] - change;
            let twist = change - self.length_s * self.end_rates[i] - bend;
            *value += share * (change + rest * (bend + share * (twist + rest * self.last[i])));
        }
        y
    }
}

/// Entries that are summed at once.
const BLOCK: usize = 8;

/// Σ wⱼ sⱼ of the first `len` entries, by blocks of entries that stay in vectors.
#[inline(always)]
fn weighted<const N: usize, const M: usize>(
    weights: &[f64; M],
    slopes: &[[f64; N]; 7],
    len: usize,
) -> [f64; N] {
    let mut sums = [0.0; N];
    let blocks = slopes.each_ref().map(|slope| slope.as_chunks::<BLOCK>().0);
    for (at, sums) in sums
        .as_chunks_mut::<BLOCK>()
        .0
        .iter_mut()
        .enumerate()
        .take(len.div_ceil(BLOCK))
    {
        for (weight, blocks) in weights.iter().zip(&blocks) {
            for (sum, slope) in sums.iter_mut().zip(&blocks[at]) {
                *sum += weight * slope;
            }
        }
    }
    for i in N / BLOCK * BLOCK..len {
        sums[i] = weights
            .iter()
            .zip(slopes)
            .map(|(weight, slope)| weight * slope[i])
            .sum();
    }
    sums
}
