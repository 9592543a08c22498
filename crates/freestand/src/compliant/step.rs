//! One Runge–Kutta 5(4) step with an interpolating polynomial, for any equation of motion.

/// An explicit method of order 5 whose last stage gives the rates at the end, with its error estimate and a polynomial.
#[derive(Debug)]
pub(crate) struct Pair {
    nodes: &'static [f64],
    /// Weights of the rates so far that lead to each node.
    stages: &'static [&'static [f64]],
    /// Differences to the weights of an embedded formula of order 4.
    error: &'static [f64],
    /// Coefficients of an interpolating polynomial of order 4.
    dense: &'static [f64],
}

/// Dormand and Prince (1980); its polynomial: Hairer, Nørsett and Wanner, Solving ODEs I, II.6.
pub(crate) static DORMAND_PRINCE: Pair = Pair {
    nodes: &[0.2, 0.3, 0.8, 8.0 / 9.0, 1.0, 1.0],
    stages: &[
        &[0.2],
        &[3.0 / 40.0, 9.0 / 40.0],
        &[44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0],
        &[
            19372.0 / 6561.0,
            -25360.0 / 2187.0,
            64448.0 / 6561.0,
            -212.0 / 729.0,
        ],
        &[
            9017.0 / 3168.0,
            -355.0 / 33.0,
            46732.0 / 5247.0,
            49.0 / 176.0,
            -5103.0 / 18656.0,
        ],
        &[
            35.0 / 384.0,
            0.0,
            500.0 / 1113.0,
            125.0 / 192.0,
            -2187.0 / 6784.0,
            11.0 / 84.0,
        ],
    ],
    error: &[
        71.0 / 57600.0,
        0.0,
        -71.0 / 16695.0,
        71.0 / 1920.0,
        -17253.0 / 339200.0,
        22.0 / 525.0,
        -1.0 / 40.0,
    ],
    dense: &[
        -12715105075.0 / 11282082432.0,
        0.0,
        87487479700.0 / 32700410799.0,
        -10690763975.0 / 1880347072.0,
        701980252875.0 / 199316789632.0,
        -1453857185.0 / 822651844.0,
        69997945.0 / 29380423.0,
    ],
};

/// Bogacki and Shampine (1996). With seven evaluations in place of six, steps may be 1.6 times as long at the same
/// tolerance, and the balance of energy closes better. The polynomial is ours: of all of degree 4 it has the least error,
/// θ²(1 − θ)²(θ − ½) h⁵y⁽⁵⁾/5!. For each rooted tree with fewer than four vertices its coefficients have Σ dᵢφᵢ = 0, with
/// four 1/γ, with five 5/(2γ), and no others have.
pub(crate) static BOGACKI_SHAMPINE: Pair = Pair {
    nodes: &[
        1.0 / 6.0,
        2.0 / 9.0,
        3.0 / 7.0,
        2.0 / 3.0,
        3.0 / 4.0,
        1.0,
        1.0,
    ],
    stages: &[
        &[1.0 / 6.0],
        &[2.0 / 27.0, 4.0 / 27.0],
        &[183.0 / 1372.0, -162.0 / 343.0, 1053.0 / 1372.0],
        &[68.0 / 297.0, -4.0 / 11.0, 42.0 / 143.0, 1960.0 / 3861.0],
        &[
            597.0 / 22528.0,
            81.0 / 352.0,
            63099.0 / 585728.0,
            58653.0 / 366080.0,
            4617.0 / 20480.0,
        ],
        &[
            174197.0 / 959244.0,
            -30942.0 / 79937.0,
            8152137.0 / 19744439.0,
            666106.0 / 1039181.0,
            -29421.0 / 29068.0,
            482048.0 / 414219.0,
        ],
        &[
            587.0 / 8064.0,
            0.0,
            4440339.0 / 15491840.0,
            24353.0 / 124800.0,
            387.0 / 44800.0,
            2152.0 / 5985.0,
            7267.0 / 94080.0,
        ],
    ],
    error: &[
        3817.0 / 1959552.0,
        0.0,
        -140181.0 / 15491840.0,
        4224731.0 / 272937600.0,
        -8557.0 / 403200.0,
        57928.0 / 4363065.0,
        23930231.0 / 4366535040.0,
        -3293.0 / 556956.0,
    ],
    dense: &[
        -11269.0 / 8064.0,
        0.0,
        7254279.0 / 3098368.0,
        110789.0 / 224640.0,
        -1161.0 / 8960.0,
        -9512.0 / 3591.0,
        -7267.0 / 6272.0,
        2.5,
    ],
};

/// The most rates of a step: at its start and at the nodes.
const MOST_RATES: usize = 8;

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
    /// The state where [`Step::look`] last looked.
    inner: [f64; N],
    /// Error estimates, by their scales.
    errors: [f64; N],
    /// The blocks of entries that change.
    changing: Changing,
    /// The rates at the start, at each stage, and at the end.
    slopes: [[f64; N]; MOST_RATES],
    pair: &'static Pair,
}

impl<const N: usize> Step<N> {
    /// An empty step, for states of which `len` entries are in use.
    pub(crate) fn new(start: &[f64; N], len: usize, pair: &'static Pair) -> Self {
        const { assert!(N <= BLOCK * MOST_BLOCKS) };
        Self {
            start_s: 0.0,
            length_s: 0.0,
            start: *start,
            end: *start,
            len,
            last: [0.0; N],
            inner: *start,
            errors: [0.0; N],
            changing: [true; MOST_BLOCKS],
            slopes: [[0.0; N]; MOST_RATES],
            pair,
        }
    }

    /// From now on only the first `first` entries and `others` change; the rates of all others are zero.
    pub(crate) fn change_only(&mut self, first: usize, others: impl Iterator<Item = usize>) {
        let before = self.changing;
        for (block, changing) in self.changing.iter_mut().enumerate() {
            *changing = BLOCK * block < first;
        }
        others.for_each(|entry| self.changing[entry / BLOCK] = true);
        for (block, changed) in before.into_iter().enumerate() {
            if changed && !self.changing[block] {
                let entries = (BLOCK * block).min(N)..(BLOCK * (block + 1)).min(N);
                for values in self.slopes.iter_mut().chain([&mut self.last]) {
                    values[entries.clone()].fill(0.0);
                }
            }
        }
    }

    /// Rates at the start.
    pub(crate) fn start_rates(&self) -> &[f64; N] {
        &self.slopes[0]
    }

    /// Rates at the end.
    pub(crate) fn end_rates(&self) -> &[f64; N] {
        &self.slopes[self.evaluations()]
    }

    /// Evaluations of the equation of motion in a step.
    pub(crate) fn evaluations(&self) -> usize {
        self.pair.nodes.len()
    }

    /// Takes the step over `length_s` from a state and its rates; `rates` writes the rates at a time and a state into
    /// its last argument.
    pub(crate) fn take(
        &mut self,
        rates: impl Fn(f64, &[f64; N], &mut [f64; N]),
        start_s: f64,
        (start, start_rates): (&[f64; N], &[f64; N]),
        length_s: f64,
    ) {
        let len = self.len;
        (self.start_s, self.length_s) = (start_s, length_s);
        self.start[..len].copy_from_slice(&start[..len]);
        self.end[..len].copy_from_slice(&start[..len]);
        self.slopes[0][..len].copy_from_slice(&start_rates[..len]);
        for (stage, (node, weights)) in self.pair.nodes.iter().zip(self.pair.stages).enumerate() {
            let (slopes, later) = self.slopes.split_at_mut(stage + 1);
            let start = (&self.start, length_s);
            weighted(weights, slopes, start, &mut self.end, (len, &self.changing));
            rates(start_s + node * length_s, &self.end, &mut later[0]);
        }
        let from_nothing = (&[0.0; N], length_s);
        weighted(
            self.pair.dense,
            &self.slopes,
            from_nothing,
            &mut self.last,
            (len, &self.changing),
        );
    }

    /// The error estimate as a multiple of `tolerance`, a share of the sizes of the entries: above 1 the step was too
    /// long.
    pub(crate) fn error_ratio(&mut self, sizes: &[f64; N], tolerance: f64) -> f64 {
        let len = self.len;
        weighted(
            self.pair.error,
            &self.slopes,
            (&[0.0; N], self.length_s),
            &mut self.errors,
            (len, &self.changing),
        );
        // In lanes, whose additions do not wait for each other.
        let mut sums = [0.0; BLOCK];
        let ratio = |i: usize| {
            let [start, end] = [self.start[i].abs(), self.end[i].abs()];
            let scale = sizes[i] + RELATIVE * if start > end { start } else { end };
            self.errors[i] / (tolerance * scale)
        };
        for at in (0..len).step_by(BLOCK) {
            if !self.changing[at / BLOCK] {
                continue;
            }
            if at + BLOCK <= len {
                let ratios: [f64; BLOCK] = std::array::from_fn(|lane| ratio(at + lane));
                for (sum, ratio) in sums.iter_mut().zip(ratios) {
                    *sum += ratio * ratio;
                }
            } else {
                for (sum, i) in sums.iter_mut().zip(at..len) {
                    *sum += ratio(i).powi(2);
                }
            }
        }
        (sums.iter().sum::<f64>() / len as f64).sqrt()
    }

    /// The state at a share of the step.
    pub(crate) fn state(&self, share: f64) -> [f64; N] {
        let mut y = self.start;
        for (i, value) in y[..self.len].iter_mut().enumerate() {
            *value = self.entry(i, share);
        }
        y
    }

    /// The state at a share of the step, without a copy of what is not in use.
    pub(crate) fn look(&mut self, share: f64) -> &[f64; N] {
        let length_s = self.length_s;
        let (first_rates, last_rates) = (&self.slopes[0], &self.slopes[self.evaluations()]);
        for at in (0..self.len).step_by(BLOCK) {
            let entries = at..(at + BLOCK).min(self.len);
            let (start, end) = (&self.start[entries.clone()], &self.end[entries.clone()]);
            let inner = &mut self.inner[entries.clone()];
            inner.copy_from_slice(start);
            if !self.changing[at / BLOCK] {
                continue;
            }
            let rates = first_rates[entries.clone()]
                .iter()
                .zip(&last_rates[entries.clone()]);
            let others = end.iter().zip(rates).zip(&self.last[entries]);
            for (value, ((end, (first, last)), bow)) in inner.iter_mut().zip(others) {
                *value = inside(
                    share,
                    [*value, *end],
                    [length_s * first, length_s * last],
                    *bow,
                );
            }
        }
        &self.inner
    }

    /// The entries of the state from `first` on, at a share of the step.
    #[inline]
    pub(crate) fn entries<const M: usize>(&self, first: usize, share: f64) -> [f64; M] {
        std::array::from_fn(|i| self.entry(first + i, share))
    }

    #[inline(always)]
    fn entry(&self, i: usize, share: f64) -> f64 {
        let changes = [self.slopes[0][i], self.end_rates()[i]].map(|rate| self.length_s * rate);
        inside(share, [self.start[i], self.end[i]], changes, self.last[i])
    }
}

/// A value at a share of a step from those at its ends, from what it would change by at the rates of both ends, and from the last
/// coefficient of the polynomial.
#[inline(always)]
fn inside(share: f64, [start, end]: [f64; 2], [first, last]: [f64; 2], bow: f64) -> f64 {
    let (rest, change) = (1.0 - share, end - start);
    let bend = first - change;
    let twist = change - last - bend;
    start + share * (change + rest * (bend + share * (twist + rest * bow)))
}

/// Entries that are summed at once.
const BLOCK: usize = 8;

/// The most blocks of a state.
const MOST_BLOCKS: usize = 8;

type Changing = [bool; MOST_BLOCKS];

/// start + h Σ wⱼ sⱼ of the first `len` entries, of those that change.
fn weighted<const N: usize>(
    weights: &[f64],
    slopes: &[[f64; N]],
    start: (&[f64; N], f64),
    out: &mut [f64; N],
    used: (usize, &Changing),
) {
    // A number of weights that the compiler knows, so that it unrolls the sums.
    match weights.len() {
        1 => weighted_of::<N, 1>(weights, slopes, start, out, used),
        2 => weighted_of::<N, 2>(weights, slopes, start, out, used),
        3 => weighted_of::<N, 3>(weights, slopes, start, out, used),
        4 => weighted_of::<N, 4>(weights, slopes, start, out, used),
        5 => weighted_of::<N, 5>(weights, slopes, start, out, used),
        6 => weighted_of::<N, 6>(weights, slopes, start, out, used),
        7 => weighted_of::<N, 7>(weights, slopes, start, out, used),
        _ => weighted_of::<N, MOST_RATES>(weights, slopes, start, out, used),
    }
}

/// [`weighted`] by blocks of entries that stay in vectors.
#[inline(always)]
fn weighted_of<const N: usize, const M: usize>(
    weights: &[f64],
    slopes: &[[f64; N]],
    (start, h): (&[f64; N], f64),
    out: &mut [f64; N],
    (len, changing): (usize, &Changing),
) {
    let (weights, slopes) = (&weights[..M], &slopes[..M]);
    let blocks: [&[[f64; BLOCK]]; M] = std::array::from_fn(|j| slopes[j].as_chunks().0);
    let starts = start.as_chunks::<BLOCK>().0;
    let outs = out.as_chunks_mut::<BLOCK>().0;
    let used = len.div_ceil(BLOCK).min(outs.len());
    for at in 0..used {
        if !changing[at] {
            continue;
        }
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

#[cfg(test)]
mod tests {
    use super::*;

    /// The conditions of quadrature, and that the last stage is the end of the step. Each is a sum of up to eight numbers
    /// below 4 that are rounded to 1e-16 of themselves.
    #[test]
    fn pairs_have_their_order() {
        for pair in [&DORMAND_PRINCE, &BOGACKI_SHAMPINE] {
            let nodes: Vec<f64> = [0.0].iter().chain(pair.nodes).copied().collect();
            let moment = |weights: &[f64], power: i32| -> f64 {
                let terms = weights.iter().zip(&nodes);
                terms.map(|(weight, node)| weight * node.powi(power)).sum()
            };
            let near = |found: f64, expected: f64| (found - expected).abs() < 1e-14;
            for (node, weights) in pair.nodes.iter().zip(pair.stages) {
                assert!(near(moment(weights, 0), *node), "{node}");
            }
            let end = pair.stages[pair.stages.len() - 1];
            for power in 0..5 {
                assert!(
                    near(moment(end, power), 1.0 / f64::from(power + 1)),
                    "{power}"
                );
            }
            for power in 0..4 {
                assert!(near(moment(pair.error, power), 0.0), "{power}");
                // What a cubic through both ends lacks of θ⁴/4 is θ²(1 − θ)²/4.
                let lacks = if power == 3 { 0.25 } else { 0.0 };
                assert!(near(moment(pair.dense, power), lacks), "{power}");
            }
            assert!(moment(pair.error, 4).abs() > 1e-5);
        }
    }

    /// A rotation at 1 rad/s: halving the step divides the error at its end by 2⁶ (Dormand and Prince's by 2⁶·⁷:
    /// theirs of order 6 is small there) and that of the polynomial by 2⁵.
    #[test]
    fn steps_and_polynomials_converge() {
        for pair in [&DORMAND_PRINCE, &BOGACKI_SHAMPINE] {
            let errors = |length_s: f64| {
                let (start, start_rates) = ([1.0, 0.0], [0.0, 1.0]);
                let mut step = Step::new(&start, 2, pair);
                let rates = |_: f64, y: &[f64; 2], rates: &mut [f64; 2]| *rates = [-y[1], y[0]];
                step.take(rates, 0.0, (&start, &start_rates), length_s);
                let error = |share: f64| {
                    let [x, y] = if share == 1.0 {
                        step.end
                    } else {
                        step.state(share)
                    };
                    let (sin, cos) = (share * length_s).sin_cos();
                    (x - cos).hypot(y - sin)
                };
                [error(1.0), error(0.3)]
            };
            let (long, short) = (errors(0.4), errors(0.2));
            assert!(
                (5.5..7.0).contains(&(long[0] / short[0]).log2()),
                "{long:?} {short:?}"
            );
            assert!(
                (4.5..5.7).contains(&(long[1] / short[1]).log2()),
                "{long:?} {short:?}"
            );
        }
    }
}
