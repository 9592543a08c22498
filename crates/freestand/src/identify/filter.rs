//! The low-pass filter of an instrument, for virtual tests and for the pulse that a law predicts.

use std::f64::consts::{PI, SQRT_2};

/// A low-pass filter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct LowPass {
    pub(super) corner_hz: f64,
    pub(super) poles: Poles,
}

/// Its poles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Poles {
    /// Butterworth.
    Two,
    /// Butterworth.
    Four,
    /// Two equal real poles, as two RC stages have them; the corner is that of each.
    Real,
}

impl Poles {
    pub(super) const ALL: [Self; 3] = [Self::Two, Self::Four, Self::Real];

    /// 1/Q of its pairs of poles: √2; 2 sin(π/8) and 2 sin(3π/8); 2.
    fn pairs(self) -> &'static [f64] {
        match self {
            Self::Two => &[SQRT_2],
            Self::Four => &[0.765_366_864_730_179_6, 1.847_759_065_022_573_5],
            Self::Real => &[2.0],
        }
    }
}

/// The bilinear transform reaches half of the sampling rate only at infinity.
const MOST_ANGLE: f64 = 1.5;

impl LowPass {
    /// The delay of slow signals: Σ 1/(Q ω).
    pub(super) fn delay_s(self) -> f64 {
        self.poles.pairs().iter().sum::<f64>() / (2.0 * PI * self.corner_hz)
    }

    /// Filters samples that are zero before the first one (bilinear transform that keeps the corner).
    pub(super) fn apply(self, samples: &mut [f64], dt_s: f64) {
        let w = (PI * self.corner_hz * dt_s).min(MOST_ANGLE).tan();
        let w2 = w * w;
        for &damping in self.poles.pairs() {
            let root = damping * w;
            let scale = 1.0 / (1.0 + root + w2);
            let (mut x1, mut x2, mut y1, mut y2) = (0.0, 0.0, 0.0, 0.0);
            for sample in samples.iter_mut() {
                let x = *sample;
                let y = scale
                    * (w2 * (x + 2.0 * x1 + x2) - 2.0 * (w2 - 1.0) * y1 - (1.0 - root + w2) * y2);
                (x2, x1, y2, y1) = (x1, x, y1, y);
                *sample = y;
            }
        }
    }
}
