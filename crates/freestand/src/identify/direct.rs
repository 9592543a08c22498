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
}

impl Flank<'_> {
    /// The touch after which a parabola through zero, or one after a jump, fits the samples of the flank best.
    pub(super) fn touch(&self) -> Option<Touch> {
        let from = self.before.saturating_sub((LEAD * self.contact).ceil() as usize + 3);
        let top = self.before + self.accel[self.before..].iter().position(|a| *a > FLANK_SHARE * self.peak)?;
        let to = top.max(self.before + 4).min(self.accel.len());
        let samples = self.accel.get(from..to)?;
        let place = |i: usize| i as f64 * self.contact / PLACES;
        let count = ((samples.len() as f64 - 3.0) * PLACES / self.contact).max(0.0) as usize;
        let costs = |has_jump: bool| -> Vec<f64> {
            (0..count).map(|i| cost(samples, place(i), has_jump).unwrap_or(f64::INFINITY)).collect()
        };
        let least = |costs: &[f64]| costs.iter().copied().enumerate().min_by(|a, b| a.1.total_cmp(&b.1));
        let (smooth, jump) = (costs(false), costs(true));
        let ((_, cost), (_, cost_jump)) = (least(&smooth)?, least(&jump)?);
        let noise2 = self.noise.powi(2).max((1e-4 * self.peak).powi(2));
        let costs = if cost - cost_jump > WORTH * noise2.max(cost_jump / samples.len() as f64) { jump } else { smooth };
        let (index, cost) = least(&costs)?;
        // A standard deviation away, the sum of squares has risen by one variance.
        let variance = noise2.max(cost / (samples.len() as f64 - 3.0).max(1.0));
        let inside = costs.iter().filter(|other| **other < cost + variance).count();
        let error = 0.5 * place(inside) + 0.5 * place(1);
        cost.is_finite().then(|| Touch { at: from as f64 + place(index), error })
    }
}

/// Sum of squares about zero before `touch` and about (j +) sτ + qτ² after it.
fn cost(samples: &[f64], touch: f64, has_jump: bool) -> Option<f64> {
    let first = if has_jump { 0 } else { 1 };
    let size = 3 - first;
    let (mut normal, mut right, mut squares) = (vec![vec![0.0; size]; size], vec![0.0; size], 0.0);
    for (i, a) in samples.iter().enumerate() {
        squares += a * a;
        // In units of the flank, so that the normal equations are well scaled.
        let tau = (i as f64 - touch) / samples.len() as f64;
        if tau <= 0.0 {
            continue;
        }
        let terms = [1.0, tau, tau * tau];
        for (row, x) in terms[first..].iter().enumerate() {
            right[row] += x * a;
            normal[row].iter_mut().zip(&terms[first..]).for_each(|(sum, y)| *sum += x * y);
        }
    }
    let found = solve(normal, right.clone())?;
    // A pad pushes from the first moment on.
    let rises =
        found.iter().rev().nth(1).is_some_and(|slope| *slope >= 0.0) && found.first().is_some_and(|f| *f >= 0.0);
    rises.then(|| squares - found.iter().zip(&right).map(|(x, y)| x * y).sum::<f64>())
}
