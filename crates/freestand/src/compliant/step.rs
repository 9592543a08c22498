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

/// A step, with what is needed to interpolate within it. It is reused and not copied, because most of a large state may
/// be unused.
#[derive(Debug, Clone)]
pub(crate) struct Step<const N: usize> {
    pub(crate) start_s: f64,
    pub(crate) length_s: f64,
    pub(crate) start: [f64; N],
    pub(crate) end: [f64; N],
    /// Number of entries of the state in use.
    len: usize,
    last: [f64; N],
    /// The rates at the start, at each stage, and at the end.
    slopes: [[f64; N]; 7],
}

impl<const N: usize> Step<N> {
    /// An empty step, for states of which `len` entries are in use.
    pub(crate) fn new(start: &[f64; N], len: usize) -> Self {
        Self {
            start_s: 0.0,
            length_s: 0.0,
            start: *start,
            end: *start,
            len,
            last: [0.0; N],
            slopes: [[0.0; N]; 7],
        }
    }

    /// Rates at the start.
    pub(crate) fn start_rates(&self) -> &[f64; N] {
        &self.slopes[0]
    }

    /// Rates at the end.
    pub(crate) fn end_rates(&self) -> &[f64; N] {
        &self.slopes[6]
    }

    /// Takes the step over `length_s` from a state and its rates; `rates` writes the rates at a time and a state into
    /// its last argument. Returns the error estimate as a multiple of `tolerance`, a share of the sizes of the
    /// entries: above 1 the step was too long.
    pub(crate) fn take(
        &mut self,
        rates: impl Fn(f64, &[f64; N], &mut [f64; N]),
        start_s: f64,
        (start, start_rates): (&[f64; N], &[f64; N]),
        length_s: f64,
        (sizes, tolerance): (&[f64; N], f64),
    ) -> f64 {
        let len = self.len;
        (self.start_s, self.length_s) = (start_s, length_s);
        self.start[..len].copy_from_slice(&start[..len]);
        self.slopes[0][..len].copy_from_slice(&start_rates[..len]);
        for (stage, row) in STAGES.iter().enumerate() {
            let (slopes, later) = self.slopes.split_at_mut(stage + 1);
            // A number of weights that the compiler knows, so that it unrolls the sums.
            let (start, y) = (&self.start, &mut self.end);
            match stage {
                0 => weighted::<N, 1>(row, slopes, (start, length_s), y, len),
                1 => weighted::<N, 2>(row, slopes, (start, length_s), y, len),
                2 => weighted::<N, 3>(row, slopes, (start, length_s), y, len),
                3 => weighted::<N, 4>(row, slopes, (start, length_s), y, len),
                4 => weighted::<N, 5>(row, slopes, (start, length_s), y, len),
                _ => weighted::<N, 6>(row, slopes, (start, length_s), y, len),
            }
            rates(start_s + NODES[stage] * length_s, &self.end, &mut later[0]);
        }
        let nothing = [0.0; N];
        weighted::<N, 7>(
            &DENSE,
            &self.slopes,
            (&nothing, length_s),
            &mut self.last,
            len,
        );
        let mut error = [0.0; N];
        weighted::<N, 7>(&ERROR, &self.slopes, (&nothing, length_s), &mut error, len);
        for i in 0..len {
            let scale = sizes[i] + RELATIVE * self.start[i].abs().max(self.end[i].abs());
            error[i] /= tolerance * scale;
        }
        // In lanes, whose additions do not wait for each other; behind `len` there is no error.
        let mut sums = [0.0; BLOCK];
        for block in error[..len.next_multiple_of(BLOCK).min(N)].chunks(BLOCK) {
            for (sum, ratio) in sums.iter_mut().zip(block) {
                *sum += ratio * ratio;
            }
        }
        (sums.iter().sum::<f64>() / len as f64).sqrt()
    }

    /// The state at a share of the step.
    pub(crate) fn state(&self, share: f64) -> [f64; N] {
        let rest = 1.0 - share;
        let mut y = self.start;
        for (i, value) in y[..self.len].iter_mut().enumerate() {
            let change = self.end[i] - self.start[i];
            let bend = self.length_s * self.slopes[0][i] - change;
            let twist = change - self.length_s * self.slopes[6][i] - bend;
            *value += share * (change + rest * (bend + share * (twist + rest * self.last[i])));
        }
        y
    }
}

/// Entries that are summed at once.
const BLOCK: usize = 8;

/// start + h Σ wⱼ sⱼ of the first `len` entries, by blocks of entries that stay in vectors.
#[inline(always)]
fn weighted<const N: usize, const M: usize>(
    weights: &[f64],
    slopes: &[[f64; N]],
    (start, h): (&[f64; N], f64),
    out: &mut [f64; N],
    len: usize,
) {
    let (weights, slopes) = (&weights[..M], &slopes[..M]);
    let blocks: [&[[f64; BLOCK]]; M] = std::array::from_fn(|j| slopes[j].as_chunks().0);
    let starts = start.as_chunks::<BLOCK>().0;
    let outs = out.as_chunks_mut::<BLOCK>().0;
    let used = len.div_ceil(BLOCK).min(outs.len());
    for at in 0..used {
        let mut sums = [0.0; BLOCK];
        for (weight, blocks) in weights.iter().zip(&blocks) {
            for (sum, slope) in sums.iter_mut().zip(&blocks[at]) {
                *sum += weight * slope;
            }
        }
        for i in 0..BLOCK {
            outs[at][i] = starts[at][i] + h * sums[i];
        }
    }
    for i in N / BLOCK * BLOCK..len {
        let sum: f64 = weights
            .iter()
            .zip(slopes)
            .map(|(weight, slope)| weight * slope[i])
            .sum();
        out[i] = start[i] + h * sum;
    }
}
