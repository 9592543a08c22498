//! The stiffness of a pad without any law: the first touch from the flank of the pulse, and two integrations.

use super::fit::solve;

/// The flank ends at this share of the peak: beyond it a pad that hardens is no parabola any more.
const FLANK_SHARE: f64 = 0.35;
/// The flank begins this share of the contact before the first sample above the noise.
const LEAD: f64 = 0.25;
/// Places at which a touch is tried, per contact: a hundredth of a contact is 3 % of the compression.
const PLACES: f64 = 1000.0;
/// The reduction of the sum of squares that a jump of the force must bring, as for a parameter of a law.
const WORTH: f64 = 12.0;

/// The flank of a pulse: samples above the zero line from `from` on.
#[derive(Debug, Clone, Copy)]
pub(super) struct Flank<'a> {
    pub(super) accel: &'a [f64],
    /// Last sample below the threshold before the pulse.
    pub(super) before: usize,
    /// Contact time in samples.
    pub(super) contact: f64,
    pub(super) peak: f64,
    pub(super) noise: f64,
}

/// The first touch, in samples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Touch {
    pub(super) at: f64,
    /// Standard deviation.
    pub(super) error: f64,
    /// Which of the [`BEGINNINGS`].
    pub(super) beginning: usize,
}

/// How a force may begin, as powers of the time since the touch: of a linear pad that hardens or softens by a square
/// or a cube, of Hertz's, of a quadratic one, and after a jump.
const BEGINNINGS: [&[f64]; 5] = [
    &[1.0, 2.0],
    &[1.0, 3.0],
    &[1.5, 2.5],
    &[2.0, 3.0],
    &[0.0, 1.0, 2.0],
];

impl Flank<'_> {
    /// The touch after which one of the [`BEGINNINGS`], or `only` one of them, fits the samples of the flank best. Its
    /// error includes the touches of the others, as far as the samples allow them.
    pub(super) fn touch(&self, only: Option<usize>) -> Option<Touch> {
        let from = self
            .before
            .saturating_sub((LEAD * self.contact).ceil() as usize + 3);
        let top = self.before
            + self
                .accel
                .get(self.before..)?
                .iter()
                .position(|a| *a > FLANK_SHARE * self.peak)?;
        let to = top.max(self.before + 4).min(self.accel.len());
        let samples = self.accel.get(from..to)?;
        let place = |i: usize| i as f64 * self.contact / PLACES;
        let count = ((samples.len() as f64 - 3.0) * PLACES / self.contact).max(0.0) as usize;
        let noise2 = self.noise.powi(2).max((1e-4 * self.peak).powi(2));
        let beginnings = BEGINNINGS
            .iter()
            .enumerate()
            .filter(|(i, _)| only.is_none_or(|only| only == *i));
        let costs: Vec<(f64, usize)> = (0..count)
            .map(|i| {
                let of = |(beginning, powers): (usize, &&[f64])| {
                    let price = WORTH * noise2 * (powers.len() - 2) as f64;
                    Some((cost(samples, place(i), powers)? + price, beginning))
                };
                let least = beginnings
                    .clone()
                    .filter_map(of)
                    .min_by(|a, b| a.0.total_cmp(&b.0));
                least.unwrap_or((f64::INFINITY, 0))
            })
            .collect();
        let (index, (cost, beginning)) = costs
            .iter()
            .copied()
            .enumerate()
            .min_by(|a, b| a.1.0.total_cmp(&b.1.0))?;
        // A standard deviation away, the sum of squares has risen by one variance.
        let variance = noise2.max(cost / (samples.len() as f64 - 3.0).max(1.0));
        let inside = costs
            .iter()
            .filter(|(other, _)| *other < cost + variance)
            .count();
        let error = 0.5 * place(inside) + 0.5 * place(1);
        cost.is_finite().then_some(Touch {
            at: from as f64 + place(index),
            error,
            beginning,
        })
    }
}

/// Sum of squares about zero before `touch` and about Σ cτ^p after it; `None` where the force would not rise.
fn cost(samples: &[f64], touch: f64, powers: &[f64]) -> Option<f64> {
    let size = powers.len();
    let (mut normal, mut right, mut squares) = (vec![vec![0.0; size]; size], vec![0.0; size], 0.0);
    for (i, a) in samples.iter().enumerate() {
        squares += a * a;
        // In units of the flank, so that the normal equations are well scaled.
        let tau = (i as f64 - touch) / samples.len() as f64;
        if tau <= 0.0 {
            continue;
        }
        let terms: Vec<f64> = powers.iter().map(|p| tau.powf(*p)).collect();
        for (row, x) in terms.iter().enumerate() {
            right[row] += x * a;
            normal[row]
                .iter_mut()
                .zip(&terms)
                .for_each(|(sum, y)| *sum += x * y);
        }
    }
    let found = solve(normal, right.clone())?;
    // A pad pushes from the first moment on, and a jump is followed by a rise.
    let rises = found.iter().take(size - 1).all(|term| *term >= 0.0);
    rises.then(|| squares - found.iter().zip(&right).map(|(x, y)| x * y).sum::<f64>())
}
