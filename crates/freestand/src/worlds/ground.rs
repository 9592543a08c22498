//! The ground motion of a world: its spectrum deviates from the target as spectra of records do.

use rand_distr::{Distribution, StandardNormal};

use super::correlation::spectral_correlation_ratio;
use super::streams::{Group, redrawn_stream};
use super::{WorldError, within};
use crate::motion::Motion;
use crate::synthesis::{
    LONGEST_PERIOD_S, MATCHED_PERIODS, QuickMatcher, SHORTEST_PERIOD_S, SynthesisError,
    matched_periods_s, stream, synthesize,
};

/// The periods over which the mean deviation is removed \[s\].
const MEAN_OVER_S: std::ops::RangeInclusive<f64> = 0.2..=3.0;
/// The largest standard deviation of ln Sa.
const MOST_SPREAD: f64 = 1.5;
/// Spectra are drawn again where one of them deviates too far at one of these periods \[s\].
const BOUNDED_AT_S: [f64; 4] = [0.2, 0.5, 1.0, 2.0];
/// The largest deviation there, in standard deviations of the deviation at that period.
const MOST_DEVIATION: f64 = 3.0;
/// Number of components: two horizontal and a vertical one.
const COMPONENTS: u32 = 3;

/// How far the spectra of worlds deviate from the target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpreadOptions {
    /// σ: standard deviation of ln Sa at one period, before the mean over periods is removed.
    pub spectral_spread: f64,
    /// τ: standard deviation of the logarithm of a factor common to all periods.
    pub intensity_spread: f64,
    /// Correlation of the deviations of the two horizontal components.
    pub component_correlation: f64,
    /// Standard deviation of the logarithm of the hazard itself: one factor on all components at all periods.
    pub hazard_spread: f64,
}

impl Default for SpreadOptions {
    /// 0.65, 0.15 and 0.6.
    ///
    /// σ and τ give a standard deviation of ln Sa of 0.39 over 0.2 to 3 s, between those of the 44
    /// components of FEMA P-695 with each record scaled (0.38) and normalised by their peak velocities
    /// (0.45). The components of those pairs have a correlation of 0.62 as recorded, 0.45 normalised
    /// and 0.24 with each record scaled.
    fn default() -> Self {
        Self {
            spectral_spread: 0.65,
            intensity_spread: 0.15,
            component_correlation: 0.6,
            hazard_spread: 0.0,
        }
    }
}

impl SpreadOptions {
    /// No deviations: every world has the target itself.
    pub const NONE: Self = Self {
        spectral_spread: 0.0,
        intensity_spread: 0.0,
        component_correlation: 0.6,
        hazard_spread: 0.0,
    };
}

/// A component of the ground motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Component {
    /// Horizontal, along the first axis of the building.
    X,
    /// Horizontal, along the second.
    Y,
    /// Vertical.
    Vertical,
}

impl Component {
    /// The earthquake number of its [`stream`]: what a study and its worlds draw the component from.
    pub fn number(self) -> u32 {
        match self {
            Self::X => 0,
            Self::Y => 1,
            Self::Vertical => 2,
        }
    }
}

/// ln of a spectrum divided by the target, at the matched periods.
#[derive(Debug, Clone, PartialEq)]
pub struct Deviation {
    ln_ratios: Vec<f64>,
}

impl Deviation {
    pub(super) fn new(ln_ratios: Vec<f64>) -> Self {
        Self { ln_ratios }
    }

    /// The values at [`matched_periods_s`].
    pub fn ln_ratios(&self) -> &[f64] {
        &self.ln_ratios
    }

    /// The spectrum where the target is `target_sa_g` \[g\]: the deviation is linear in ln T between
    /// the matched periods and constant beyond them. Without a deviation it is exactly the target.
    pub fn sa_g(&self, period_s: f64, target_sa_g: f64) -> f64 {
        let last = (MATCHED_PERIODS - 1) as f64;
        let along = (period_s / SHORTEST_PERIOD_S).ln()
            / (LONGEST_PERIOD_S / SHORTEST_PERIOD_S).ln()
            * last;
        // The logarithm of period 0 is −∞, which is at the first.
        let along = along.clamp(0.0, last);
        let below = along as usize;
        let at = |index: usize| {
            self.ln_ratios
                .get(index)
                .or(self.ln_ratios.last())
                .copied()
                .unwrap_or(0.0)
        };
        let (low, high) = (at(below), at(below + 1));
        target_sa_g * (low + (high - low) * (along - below as f64)).exp()
    }
}

/// The spectra of a world.
#[derive(Debug, Clone, PartialEq)]
pub struct WorldSpectra {
    /// Along the first axis.
    pub x: Deviation,
    /// Along the second.
    pub y: Deviation,
    /// Vertical: independent of the others.
    pub vertical: Deviation,
}

impl WorldSpectra {
    /// The deviation of a component.
    pub fn of(&self, component: Component) -> &Deviation {
        match component {
            Component::X => &self.x,
            Component::Y => &self.y,
            Component::Vertical => &self.vertical,
        }
    }
}

/// The deviations of spectra, ready to be drawn.
///
/// ln S_c(T) = ln S(T) + σ e_c(T) + τ z_c + η h,
///
/// where η is the [`hazard_spread`](SpreadOptions::hazard_spread) and h is one standard normal number of all components, e is Gaussian with the [`spectral_correlation_ratio`] between periods, less its mean over
/// ln T in 0.2 to 3 s, and z is standard normal. Those of the two horizontal components share √ρ of
/// each: e_c = √ρ e + √(1 − ρ) e′_c. The mean of ln S_c is ln S at every period.
///
/// Where the spectrum of a horizontal component deviates by more than three of its own standard deviations at
/// 0.2, 0.5, 1 or 2 s, both are drawn again: 2 % of the worlds. It takes 0.006 to 0.011 off these standard
/// deviations (`extreme_spectra_are_drawn_again`). Without it a target of 0.5 g gives peaks of 4 g in one of
/// a thousand worlds.
///
/// # Accuracy
/// With the defaults the standard deviation of ln S_c over 0.2–3 s (root mean square) is 0.393 by
/// the covariances, and 0.386 without extreme worlds: 0.31 at 0.7 s, 0.5 at 0.2 s and 3 s, 0.65 at 0.1 s. The motions of
/// 160 worlds (EN 1998-1 type 1, ground C) have 0.381, correlations of x and y from 0.48 to 0.65, and at the
/// roof of five storeys (T₁ = 0.65 s) a standard deviation of ln PFA of 0.27, or of 0.33 with the
/// spreads of [`BuildingSpread`](super::BuildingSpread).
#[derive(Debug, Clone)]
pub struct GroundSpread {
    options: SpreadOptions,
    /// Rows of the lower triangle whose product with its transpose is the matrix of correlations.
    factor: Vec<Vec<f64>>,
    /// The indices of the periods over which the mean is removed.
    band: Vec<usize>,
    /// The indices of [`BOUNDED_AT_S`], with the largest deviation of ln Sa at each.
    bounds: Vec<(usize, f64)>,
}

impl GroundSpread {
    /// Deviations of this size.
    ///
    /// # Errors
    /// A spread outside 0 to 1.5, or a correlation outside 0 to 1.
    pub fn new(options: SpreadOptions) -> Result<Self, WorldError> {
        within("the spectral spread", MOST_SPREAD, options.spectral_spread)?;
        within(
            "the intensity spread",
            MOST_SPREAD,
            options.intensity_spread,
        )?;
        within("the hazard spread", MOST_SPREAD, options.hazard_spread)?;
        within(
            "the correlation of the components",
            1.0,
            options.component_correlation,
        )?;
        let periods_s = matched_periods_s();
        let band = (0..periods_s.len())
            .filter(|&i| MEAN_OVER_S.contains(&periods_s[i]))
            .collect();
        let mut spread = Self {
            options,
            factor: factor(&periods_s),
            band,
            bounds: Vec::new(),
        };
        spread.bounds = BOUNDED_AT_S
            .map(|period_s| {
                let index = nearest(&periods_s, period_s);
                (index, MOST_DEVIATION * spread.deviation_sd(index))
            })
            .to_vec();
        Ok(spread)
    }

    /// The standard deviation of ln S_c − ln S at a matched period, by the covariances.
    fn deviation_sd(&self, index: usize) -> f64 {
        let weight = |row: &[f64], column: usize| row.get(column).copied().unwrap_or(0.0);
        let own = &self.factor[index];
        let variance: f64 = (0..self.factor.len())
            .map(|column| {
                let in_band = self.band.iter().map(|&i| weight(&self.factor[i], column));
                let mean = in_band.sum::<f64>() / self.band.len() as f64;
                (weight(own, column) - mean).powi(2)
            })
            .sum();
        (self.options.spectral_spread * variance.sqrt())
            .hypot(self.options.intensity_spread)
            .hypot(self.options.hazard_spread)
    }

    /// The options.
    pub fn options(&self) -> SpreadOptions {
        self.options
    }

    /// The spectra of a world; `repetition` is 0, or 1 and more where the motion alone is drawn
    /// again. Both horizontal ones are drawn again until neither is extreme, and so is the vertical one.
    pub fn spectra(&self, seed: u64, world: u32, repetition: u32) -> WorldSpectra {
        let mut found = self.drawn(seed, world, repetition, 0);
        let mut refused = 0;
        while refused < u16::MAX && (self.is_extreme(&found.x) || self.is_extreme(&found.y)) {
            refused += 1;
            let WorldSpectra { x, y, .. } = self.drawn(seed, world, repetition, refused);
            (found.x, found.y) = (x, y);
        }
        refused = 0;
        while refused < u16::MAX && self.is_extreme(&found.vertical) {
            refused += 1;
            found.vertical = self.drawn(seed, world, repetition, refused).vertical;
        }
        found
    }

    /// Whether a spectrum deviates from the target by more than 3 standard deviations of its own at
    /// 0.2, 0.5, 1 or 2 s.
    pub(super) fn is_extreme(&self, deviation: &Deviation) -> bool {
        self.bounds
            .iter()
            .any(|&(index, most)| deviation.ln_ratios[index].abs() > most)
    }

    /// The spectra after `refused` draws that were extreme.
    ///
    /// All random numbers are drawn in one order, whatever the options: e shared, of x, of y, and
    /// vertical; then z in that order; then h.
    pub(super) fn drawn(
        &self,
        seed: u64,
        world: u32,
        repetition: u32,
        refused: u16,
    ) -> WorldSpectra {
        let mut random = redrawn_stream(seed, world, Group::Motion, repetition, refused);
        let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
        let [shared, of_x, of_y, vertical] = [(); 4].map(|()| self.field(&mut normal));
        let [z, z_x, z_y, z_vertical] = [(); 4].map(|()| normal());
        let hazard = self.options.hazard_spread * normal();
        let common = self.options.component_correlation.sqrt();
        let own = (1.0 - self.options.component_correlation).sqrt();
        let joined = |e: &[f64], z_own: f64| {
            let e = shared
                .iter()
                .zip(e)
                .map(|(shared, e)| common * shared + own * e)
                .collect();
            self.deviation(e, common * z + own * z_own, hazard)
        };
        WorldSpectra {
            x: joined(&of_x, z_x),
            y: joined(&of_y, z_y),
            vertical: self.deviation(vertical, z_vertical, hazard),
        }
    }

    /// e: correlated, less its mean over the band.
    fn field(&self, normal: &mut impl FnMut() -> f64) -> Vec<f64> {
        let white: Vec<f64> = self.factor.iter().map(|_| normal()).collect();
        let row = |row: &Vec<f64>| {
            row.iter()
                .zip(&white)
                .map(|(weight, value)| weight * value)
                .sum::<f64>()
        };
        let e: Vec<f64> = self.factor.iter().map(row).collect();
        // The periods are equally spaced in ln T.
        let mean = self.band.iter().map(|&i| e[i]).sum::<f64>() / self.band.len() as f64;
        e.iter().map(|e| e - mean).collect()
    }

    fn deviation(&self, e: Vec<f64>, z: f64, hazard: f64) -> Deviation {
        let SpreadOptions {
            spectral_spread,
            intensity_spread,
            ..
        } = self.options;
        Deviation {
            ln_ratios: e
                .iter()
                .map(|e| spectral_spread * e + intensity_spread * z + hazard)
                .collect(),
        }
    }
}

/// The index of the matched period that is nearest on a logarithmic scale.
fn nearest(periods_s: &[f64], period_s: f64) -> usize {
    let away = |index: &usize| (periods_s[*index] / period_s).ln().abs();
    (0..periods_s.len())
        .min_by(|a, b| away(a).total_cmp(&away(b)))
        .unwrap_or(0)
}

/// Cholesky factor of the correlations between periods; they are positive definite for the matched
/// periods, the smallest pivot being 0.005.
pub(super) fn factor(periods_s: &[f64]) -> Vec<Vec<f64>> {
    let mut rows: Vec<Vec<f64>> = Vec::with_capacity(periods_s.len());
    for (i, &period_s) in periods_s.iter().enumerate() {
        let mut row = Vec::with_capacity(i + 1);
        for (other, other_s) in rows.iter().zip(periods_s) {
            let product: f64 = row
                .iter()
                .zip(other)
                .map(|(a, b): (&f64, &f64)| a * b)
                .sum();
            let diagonal = other.last().copied().unwrap_or(1.0);
            row.push((spectral_correlation_ratio(period_s, *other_s) - product) / diagonal);
        }
        let used: f64 = row.iter().map(|a| a * a).sum();
        row.push((1.0 - used).sqrt());
        rows.push(row);
    }
    rows
}

/// The random numbers of the motions of a world.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct WorldDraw {
    /// The seed of all worlds.
    pub seed: u64,
    /// The number of the world.
    pub world: u32,
    /// How often its motions were drawn before.
    pub repetition: u32,
}

/// The motion of a component of a world, matched to the target PSA `target_sa_g` (period \[s\] to g,
/// 5 % damping) with its deviation.
///
/// The phases of a component are those of motion number `world` of its [`stream`]: of earthquake
/// number 0 for x, 1 for y and 2 for vertical, and three numbers further for each repetition.
/// Without deviations the motion is that of [`synthesize`]. A spectrum with deviations is rougher than
/// that of any motion, whose valleys stay too high: [`QuickMatcher`] follows it with few passes, and
/// one factor takes the mean of ln PSA over 0.2 to 3 s to that of the spectrum.
///
/// # Accuracy
/// The motions have the statistics of those that thirty passes of [`synthesize`] make from the same
/// numbers. Of 4000 worlds (AS 1170.4, class De; the example `world_motions` of the benches), over 0.05
/// to 4 s: the mean of ln PSA differs by up to 0.006, its standard deviation by 0.007, its correlation
/// between periods by 0.026 and between components by 0.016; the 16, 50 and 84 % of PGA differ by up to
/// 0.9 %, of PGV by 1.8 %, of CAV by 2.2 %, of D5–95 by 2.8 % (4.2 % in class Be). PGD is larger by 20
/// to 37 %. Eight blocks overturn 1.008 times as often (geometric
/// mean; 0.97 to 1.03).
///
/// # Limitation
/// How often a block overturns depends on how long passes go on, although PSA, PGA and PGV hardly
/// change: each pass lengthens the shaking at long periods. Of 640 motions on the ground (AS 1170.4,
/// class De), the eight blocks overturn 0.82 times as often after 15 plain passes as after 30, 1.12 times
/// after 60 and 1.20 times after 120 (geometric means, each to within 0.05).
///
/// # Errors
/// Those of [`synthesize`].
pub fn world_motion(
    target_sa_g: impl Fn(f64) -> f64,
    spectra: &WorldSpectra,
    component: Component,
    draw: WorldDraw,
    matcher: &QuickMatcher,
) -> Result<Motion, SynthesisError> {
    let WorldDraw {
        seed,
        world,
        repetition,
    } = draw;
    let deviation = spectra.of(component);
    let number = component.number() + COMPONENTS * repetition;
    let stream = stream(number, world);
    let of_world = |t: f64| deviation.sa_g(t, target_sa_g(t));
    if deviation.ln_ratios.iter().all(|ln| *ln == 0.0) {
        return Ok(synthesize(of_world, seed, stream, matcher.options())?.motion);
    }
    matcher.motion(of_world, &MEAN_OVER_S, seed, stream)
}
