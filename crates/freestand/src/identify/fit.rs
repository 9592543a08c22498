//! The least-squares fit of a law's pulse to the samples of an acceleration, with known values as
//! priors.

use super::FittedLaw;
use super::filter::{LowPass, Poles};
use super::model::{Elastic, Model, PIECES, Predicted};
use std::cmp::Ordering;

/// Accuracy of the predicted pulse and of printed samples, as a share of the peak.
const FLOOR_SHARE: f64 = 2e-4;
/// A smaller gain in χ² moves no parameter by more than a thirtieth of its error.
const ENOUGH: f64 = 1e-3;
/// Iterations of Levenberg–Marquardt.
const ROUNDS: usize = 60;
/// Number of parameters.
const P: usize = 12 + PIECES;
/// Largest change of the first contact in one iteration, in contact times: a toe below the noise
/// can be a large part of a contact.
const TOUCH_SHARE: f64 = 0.1;
/// First contact in samples; ln v; ln k; n; ζ; Λv; zero line over peak; level of a clipped top over
/// peak; ln of the corner of the filter; the part of k₃d² in k; the compression at which k is the secant; how much the
/// tangent of a curve changes from piece to piece, 0 without a curve; ln of its tangents over the first one.
type Parameters = [f64; P];
const TOUCH: usize = 0;
const SPEED: usize = 1;
const STIFFNESS: usize = 2;
const EXPONENT: usize = 3;
const DAMPING: usize = 4;
const DISSIPATION: usize = 5;
const OFFSET: usize = 6;
const TOP: usize = 7;
const CORNER: usize = 8;
const CUBE: usize = 9;
const DEPTH: usize = 10;
const ROUGHNESS: usize = 11;
const CURVE: usize = 12;
/// Step of the numerical derivative by a parameter.
fn step_of(which: usize) -> f64 {
    match which {
        TOUCH => 1e-3,
        SPEED | STIFFNESS | OFFSET => 1e-5,
        _ => 1e-4,
    }
}
/// What is tried for the standard deviation of ln of the tangent from piece to piece, of pads between one that is nearly
/// linear and one with sharp kinks. The search goes from smooth to rough.
const ROUGHNESSES: [f64; 4] = [0.07, 0.2, 0.6, 1.8];
/// The tangent at which the search for a curve begins is at least this share of the secant.
const LEAST_TANGENT: f64 = 0.05;
/// First contacts that are tried to each side, and the −2 ln of a probability at which they end.
const MOST_TOUCHES: usize = 12;
const UNLIKELY: f64 = 9.0;
/// ln of the largest and smallest tangent over the first one.
const MOST_CHANGE: f64 = 7.0;
/// Corner times contact time above which a filter does nothing but delay the pulse.
const FAST_CORNER: f64 = 30.0;
/// Corner times contact time below which a pulse shows its filter more than its pad.
const SLOWEST_CORNER: f64 = 0.3;
/// Where the search for an unknown corner begins, as corner times contact time.
const CORNER_STARTS: [f64; 2] = [1.5, 4.0];

/// The samples around a contact and what is known about it.
#[derive(Debug, Clone)]
pub(super) struct Data<'a> {
    pub(super) mass_kg: f64,
    pub(super) gravity_m_s2: f64,
    pub(super) dt_s: f64,
    /// Samples above the zero line.
    pub(super) accel_m_s2: &'a [f64],
    pub(super) peak_m_s2: f64,
    pub(super) noise_m_s2: f64,
    /// The filter of the instrument, if its corner is known.
    pub(super) corner_hz: Option<f64>,
    pub(super) poles: Poles,
    /// Standard deviation of the zero line.
    pub(super) zero_error_m_s2: f64,
    /// The velocity and the standard deviation of its logarithm, which is large where the velocity
    /// is not known.
    pub(super) speed_m_s: f64,
    pub(super) speed_error_ratio: f64,
    /// Approximate beginning and length of the contact, in samples.
    pub(super) touch: f64,
    pub(super) contact: f64,
}

/// What the samples say about the pad without any law.
#[derive(Debug, Clone)]
pub(super) struct Measured {
    /// First contact, in samples of the data.
    pub(super) touch: f64,
    /// The largest compression.
    pub(super) depth_m: f64,
    /// Compression and force up to it.
    pub(super) points: Vec<(f64, f64)>,
}

impl Measured {
    fn force_n(&self, d: f64) -> f64 {
        let next = self.points.partition_point(|point| point.0 < d);
        let before = next
            .checked_sub(1)
            .and_then(|before| self.points.get(before))
            .copied()
            .unwrap_or_default();
        let Some(after) = self.points.get(next) else {
            return before.1;
        };
        before.1 + (after.1 - before.1) * (d - before.0) / (after.0 - before.0)
    }
}

/// One law, fitted.
#[derive(Debug, Clone)]
pub(super) struct Fit {
    pub(super) law: FittedLaw,
    parameters: Parameters,
    /// The parameters that were fitted.
    free: Vec<usize>,
    pub(super) model: Model,
    pub(super) predicted: Predicted,
    /// First contact, from the first sample of the data.
    pub(super) touch_s: f64,
    /// Its standard deviation, in samples.
    touch_error: f64,
    /// F/d at the largest compression, without damping.
    pub(super) secant_n_m: f64,
    /// Standard deviation of its logarithm.
    pub(super) secant_error_ratio: f64,
    pub(super) exponent_error: Option<f64>,
    /// ζ = c/(2√(km)), of Kelvin–Voigt only.
    pub(super) damping_ratio: f64,
    /// Standard deviation of ζ, or of Λv.
    damping_error: Option<f64>,
    /// ln of the determinant of the normal equations.
    log_information: f64,
    /// Sum of squares in units of the noise.
    pub(super) chi_squared: f64,
    pub(super) degrees: f64,
    /// Root mean square of the residuals divided by the peak.
    pub(super) residual_ratio: f64,
}

fn free_of(law: FittedLaw) -> Vec<usize> {
    let more: &[usize] = match law {
        FittedLaw::Linear => &[],
        FittedLaw::Power => &[EXPONENT],
        FittedLaw::KelvinVoigt | FittedLaw::Tabulated => &[DAMPING],
        FittedLaw::HuntCrossley => &[EXPONENT, DISSIPATION],
        FittedLaw::DampedPower => &[EXPONENT, DAMPING],
        FittedLaw::Cubic => &[CUBE],
    };
    let curve = if law == FittedLaw::Tabulated {
        CURVE..CURVE + PIECES
    } else {
        0..0
    };
    [TOUCH, SPEED, STIFFNESS, OFFSET]
        .iter()
        .chain(more)
        .copied()
        .chain(curve)
        .collect()
}

impl Data<'_> {
    fn model(&self, p: &Parameters) -> Model {
        let k = p[STIFFNESS].exp();
        let speed_m_s = p[SPEED].exp();
        let depth_m = p[DEPTH];
        let elastic = if p[ROUGHNESS] > 0.0 {
            let mut ratios = [1.0; PIECES + 1];
            ratios
                .iter_mut()
                .skip(1)
                .zip(&p[CURVE..])
                .for_each(|(ratio, q)| *ratio = q.exp());
            Elastic::curve(k, depth_m, &ratios)
        } else if p[CUBE] != 0.0 {
            Elastic::Cubic {
                initial_n_m: k * (1.0 - p[CUBE]),
                cubic_n_m3: k * p[CUBE] / (depth_m * depth_m),
            }
        } else {
            Elastic::Power {
                coefficient_n_mn: k * depth_m.powf(1.0 - p[EXPONENT]),
                exponent: p[EXPONENT],
            }
        };
        Model {
            mass_kg: self.mass_kg,
            gravity_m_s2: self.gravity_m_s2,
            speed_m_s,
            elastic,
            damping_n_s_m: 2.0 * p[DAMPING] * (k * self.mass_kg).sqrt(),
            dissipation_s_m: p[DISSIPATION] / speed_m_s,
            reference_m: depth_m,
            filter: p[CORNER].is_finite().then(|| LowPass {
                corner_hz: p[CORNER].exp(),
                poles: self.poles,
            }),
        }
    }

    /// ln of the corner whose product with the contact time is `corner`.
    fn corner(&self, corner: f64) -> f64 {
        (corner / (self.contact * self.dt_s)).ln()
    }

    fn sigma(&self) -> f64 {
        self.noise_m_s2.max(FLOOR_SHARE * self.peak_m_s2)
    }

    /// Residuals of the samples, then those of the priors of velocity and zero line.
    fn residuals(&self, p: &Parameters) -> Vec<f64> {
        let predicted = self.model(p).predict();
        let offset = p[OFFSET] * self.peak_m_s2;
        let sigma = self.sigma();
        let left = self.accel_m_s2.iter().enumerate().map(|(i, a)| {
            let at = predicted.at((i as f64 - p[TOUCH]) * self.dt_s);
            (a - offset - at.min(p[TOP] * self.peak_m_s2)) / sigma
        });
        let priors = [
            (p[SPEED] - self.speed_m_s.ln()) / self.speed_error_ratio,
            offset / self.zero_error_m_s2.max(1e-6 * self.peak_m_s2),
        ];
        // The tangent of a curve changes from piece to piece by no more than it must.
        let curve = if p[ROUGHNESS] > 0.0 { &p[CURVE..] } else { &[] };
        let changes = curve.iter().zip(std::iter::once(&0.0).chain(curve));
        left.chain(priors)
            .chain(changes.map(|(q, before)| (q - before) / p[ROUGHNESS]))
            .collect()
    }

    fn start(&self, touch: f64, exponent: f64) -> Parameters {
        let omega = std::f64::consts::PI / (self.contact * self.dt_s);
        let mut p = [0.0; P];
        (p[TOUCH], p[SPEED], p[STIFFNESS]) = (
            touch,
            self.speed_m_s.ln(),
            (self.mass_kg * omega * omega).ln(),
        );
        (p[EXPONENT], p[TOP], p[CORNER]) = (exponent, f64::INFINITY, f64::INFINITY);
        // Constant, so that k and n are nearly independent.
        p[DEPTH] = self.speed_m_s / omega;
        if let Some(corner_hz) = self
            .corner_hz
            .map(f64::ln)
            .filter(|corner| *corner < self.corner(FAST_CORNER))
        {
            p[CORNER] = corner_hz;
            p[TOUCH] -= LowPass {
                corner_hz: corner_hz.exp(),
                poles: self.poles,
            }
            .delay_s()
                / self.dt_s;
        }
        p
    }

    /// The best fit of a law from a few starting points; `None` where none converges to a cushion.
    pub(super) fn fit(&self, law: FittedLaw) -> Option<Fit> {
        let free = free_of(law);
        let exponents: &[f64] = if free.contains(&EXPONENT) {
            &[1.0, 1.6]
        } else {
            &[1.0]
        };
        let mut best: Option<Descent> = None;
        let enough = 1.5 * self.accel_m_s2.len() as f64;
        for early in [0.0, 1.0, 0.05 * self.contact] {
            for &exponent in exponents {
                if best.as_ref().is_some_and(|found| found.cost < enough) {
                    continue;
                }
                let mut p = self.start(self.touch - early, exponent);
                match law {
                    FittedLaw::HuntCrossley => p[DISSIPATION] = 0.1,
                    FittedLaw::KelvinVoigt | FittedLaw::DampedPower => p[DAMPING] = 0.1,
                    FittedLaw::Linear
                    | FittedLaw::Power
                    | FittedLaw::Cubic
                    | FittedLaw::Tabulated => {}
                }
                keep_better(&mut best, self.descend(p, &free, None));
            }
        }
        self.finished(law, &self.between_samples(best?, &free), free)
    }

    /// The fit of a law with more parameters, started from the fit of one with fewer.
    pub(super) fn extend(&self, law: FittedLaw, from: &Fit) -> Option<Fit> {
        let mut free = free_of(law);
        if from.free.contains(&CORNER) {
            free.push(CORNER);
        }
        let found = self.descend(from.parameters, &free, None);
        self.finished(law, &self.between_samples(found, &free), free)
    }

    /// The fit of a curve without a formula: the likeliest roughness. It is started from every law and from the
    /// samples themselves; its error includes what the other roughnesses make of the samples.
    pub(super) fn curve(&self, laws: &[Fit], measured: Option<&Measured>) -> Option<Fit> {
        let free = free_of(FittedLaw::Tabulated);
        let of_law = |from: &Fit| {
            curved(from.parameters, from.predicted.compression_m, |d| {
                from.model.elastic_n(d)
            })
        };
        let of_samples = measured.map(|measured| {
            let p = self.start(measured.touch, 1.0);
            curved(p, measured.depth_m, |d| measured.force_n(d))
        });
        // The first touch has several minima: each law begins at its own.
        let mut starts: Vec<Parameters> = laws.iter().map(of_law).chain(of_samples).collect();
        let mut fits: Vec<Fit> = Vec::new();
        for roughness in ROUGHNESSES {
            let mut best: Option<Descent> = None;
            for p in &mut starts {
                p[ROUGHNESS] = roughness;
                keep_better(&mut best, self.descend(*p, &free, None));
            }
            let found = best?;
            starts = vec![found.p];
            fits.extend(self.finished(FittedLaw::Tabulated, &found, free.clone()));
        }
        let likeliest = fits
            .iter()
            .enumerate()
            .min_by(|a, b| a.1.unlikeliness(1.0).total_cmp(&b.1.unlikeliness(1.0)))?
            .0;
        let chosen = self.over_touches(fits.swap_remove(likeliest))?;
        let error = chosen.error_among(std::iter::once(&chosen).chain(&fits), 1.0);
        Some(Fit {
            secant_error_ratio: error,
            ..chosen
        })
    }

    /// The likeliest of the same curve with other first contacts, with an error that includes all of them. What a toe below
    /// the noise allows is no neighbourhood of one minimum: whenever the first contact passes a sample, the curve changes.
    fn over_touches(&self, from: Fit) -> Option<Fit> {
        let held: Vec<usize> = from
            .free
            .iter()
            .copied()
            .filter(|&which| which != TOUCH)
            .collect();
        let middle = Descent {
            p: from.parameters,
            cost: from.chi_squared,
        };
        let mut fits: Vec<Fit> = self
            .finished(from.law, &middle, held.clone())
            .into_iter()
            .collect();
        for step in [-from.touch_error, from.touch_error] {
            let mut p = from.parameters;
            for _ in 0..MOST_TOUCHES {
                p[TOUCH] += step;
                let found = self.descend(p, &held, None);
                p = found.p;
                let Some(fit) = self.finished(from.law, &found, held.clone()) else {
                    break;
                };
                let likeliest = fits
                    .iter()
                    .map(|fit| fit.unlikeliness(1.0))
                    .fold(f64::INFINITY, f64::min);
                let is_far = fit.unlikeliness(1.0) > likeliest + UNLIKELY;
                fits.push(fit);
                if is_far {
                    break;
                }
            }
        }
        let best = fits
            .iter()
            .min_by(|a, b| a.unlikeliness(1.0).total_cmp(&b.unlikeliness(1.0)))?;
        let error = best.error_among(&fits, 1.0);
        let best = Descent {
            p: best.parameters,
            cost: best.chi_squared,
        };
        let fit = self.finished(from.law, &best, from.free)?;
        Some(Fit {
            secant_error_ratio: error.max(fit.secant_error_ratio),
            ..fit
        })
    }

    /// The fit of a law behind a filter whose corner is not known either.
    pub(super) fn behind_filter(&self, from: &Fit) -> Option<Fit> {
        let mut free = free_of(from.law);
        free.push(CORNER);
        let mut best: Option<Descent> = None;
        for corner in CORNER_STARTS {
            let mut p = from.parameters;
            p[CORNER] = self.corner(corner);
            p[TOUCH] -= LowPass {
                corner_hz: p[CORNER].exp(),
                poles: self.poles,
            }
            .delay_s()
                / self.dt_s;
            keep_better(&mut best, self.descend(p, &free, None));
        }
        self.finished(from.law, &best?, free)
    }

    /// The same fit with other poles of the filter.
    pub(super) fn refit(&self, from: &Fit) -> Option<Fit> {
        let mut p = from.parameters;
        if p[CORNER].is_finite() {
            let delay = |poles| {
                LowPass {
                    corner_hz: p[CORNER].exp(),
                    poles,
                }
                .delay_s()
                    / self.dt_s
            };
            p[TOUCH] +=
                from.model.filter.map_or(0.0, |filter| delay(filter.poles)) - delay(self.poles);
        }
        let found = self.descend(p, &from.free, None);
        self.finished(from.law, &found, from.free.clone())
    }

    /// The sum of squares with the top of the same law clipped at a fitted level; `None` where the
    /// noise explains the improvement.
    pub(super) fn cut(&self, from: &Fit) -> Option<f64> {
        let mut free = from.free.clone();
        free.push(TOP);
        let data = Self {
            poles: from.model.filter.map_or(self.poles, |filter| filter.poles),
            ..self.clone()
        };
        let mut p = from.parameters;
        p[TOP] = 0.97 * from.predicted.peak_m_s2() / self.peak_m_s2;
        let found = data.descend(p, &free, None);
        (found.cost < 2.0 * from.degrees).then_some(found.cost)
    }

    /// Where the force jumps at first contact, the sum of squares jumps whenever the first contact
    /// passes a sample, and a search stops at the first such jump. Between two samples it is
    /// smooth, so each interval around the first contact is searched on its own.
    fn between_samples(&self, found: Descent, free: &[usize]) -> Descent {
        if !free.contains(&DAMPING) || found.p[CORNER].is_finite() {
            return found;
        }
        let mut best = found;
        let mut centre = best.p[TOUCH].ceil();
        for _ in 0..4 {
            let mut next: Option<Descent> = None;
            for gap in [centre - 1.0, centre, centre + 1.0] {
                let mut p = best.p;
                p[TOUCH] = p[TOUCH].clamp(gap - 0.999, gap);
                p[DAMPING] = p[DAMPING].max(0.02);
                keep_better(&mut next, self.descend(p, free, Some((gap - 0.999, gap))));
            }
            let Some(next) = next.filter(|next| next.cost < best.cost) else {
                break;
            };
            best = next;
            if best.p[TOUCH].ceil() == centre {
                break;
            }
            centre = best.p[TOUCH].ceil();
        }
        best
    }

    /// Levenberg–Marquardt, with the first contact between bounds if they are given.
    fn descend(&self, start: Parameters, free: &[usize], bounds: Option<(f64, f64)>) -> Descent {
        let mut p = start;
        let mut r = self.residuals(&p);
        let mut cost = square(&r);
        let mut damping = 1e-3;
        for _ in 0..ROUNDS {
            let (mut normal, mut gradient) = self.normal(&p, &r, free);
            hold_at_bound(&mut normal, &mut gradient, p[TOUCH], bounds);
            let mut gained = 0.0;
            while damping < 1e9 {
                let mut damped = normal.clone();
                for (i, row) in damped.iter_mut().enumerate() {
                    row[i] *= 1.0 + damping;
                }
                let Some(step) = solve(damped, gradient.clone()) else {
                    damping *= 10.0;
                    continue;
                };
                let mut next = moved(&p, free, &step, TOUCH_SHARE * self.contact);
                if next[CORNER].is_finite() {
                    next[CORNER] =
                        next[CORNER].clamp(self.corner(SLOWEST_CORNER), self.corner(FAST_CORNER));
                }
                if let Some((low, high)) = bounds {
                    next[TOUCH] = next[TOUCH].clamp(low, high);
                }
                let left = self.residuals(&next);
                let less = square(&left);
                if less < cost {
                    gained = cost - less;
                    (p, r, cost) = (next, left, less);
                    damping = (damping * 0.2).max(1e-9);
                    break;
                }
                damping *= 5.0;
            }
            if gained < ENOUGH + 1e-7 * cost {
                break;
            }
        }
        Descent { p, cost }
    }

    /// JᵀJ and −Jᵀr over the free parameters.
    fn normal(&self, p: &Parameters, r: &[f64], free: &[usize]) -> (Vec<Vec<f64>>, Vec<f64>) {
        let columns: Vec<Vec<f64>> = free
            .iter()
            .map(|&i| {
                let (q, h) = perturbed(p, i);
                self.residuals(&q)
                    .iter()
                    .zip(r)
                    .map(|(a, b)| (a - b) / h)
                    .collect()
            })
            .collect();
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
        let normal = columns
            .iter()
            .map(|a| columns.iter().map(|b| dot(a, b)).collect())
            .collect();
        (normal, columns.iter().map(|a| -dot(a, r)).collect())
    }

    /// The number of parameters of a curve that its priors fix: the trace of the covariance times their part of the
    /// normal equations.
    fn fixed_by_priors(&self, p: &Parameters, free: &[usize], covariance: &[Vec<f64>]) -> f64 {
        let places: Vec<usize> = (0..free.len()).filter(|&at| free[at] >= CURVE).collect();
        let mut sum = 0.0;
        for (i, &at) in places.iter().enumerate() {
            let last = i + 1 == places.len();
            sum += covariance[at][at] * if last { 1.0 } else { 2.0 };
            if let Some(&next) = places.get(i + 1) {
                sum -= 2.0 * covariance[at][next];
            }
        }
        if places.is_empty() {
            0.0
        } else {
            sum / p[ROUGHNESS].powi(2)
        }
    }

    fn finished(&self, law: FittedLaw, found: &Descent, free: Vec<usize>) -> Option<Fit> {
        let Descent { p, cost } = found;
        let cost = *cost;
        let r = self.residuals(p);
        let (normal, _) = self.normal(p, &r, &free);
        let covariance = inverse(&normal)?;
        // What the priors of a curve fix is no parameter.
        let numbers = free.len() as f64 - self.fixed_by_priors(p, &free, &covariance);
        let degrees = (self.accel_m_s2.len() + 2) as f64 - numbers;
        // Residuals in excess of the noise make every parameter less certain.
        let scale = (cost / degrees).max(1.0);
        let secant = |p: &Parameters| {
            let model = self.model(p);
            let d = model.predict().compression_m;
            (model.elastic_n(d) / d).ln()
        };
        let slopes: Vec<f64> = free
            .iter()
            .map(|&i| {
                let (q, h) = perturbed(p, i);
                (secant(&q) - secant(p)) / h
            })
            .collect();
        let mut variance = 0.0;
        for (i, row) in covariance.iter().enumerate() {
            variance += row
                .iter()
                .zip(&slopes)
                .map(|(c, s)| c * s * slopes[i])
                .sum::<f64>();
        }
        let of = |which: usize| {
            let at = free.iter().position(|&i| i == which)?;
            Some((covariance[at][at] * scale).max(0.0).sqrt())
        };
        let touch_error = of(TOUCH).unwrap_or(0.0);
        let (exponent_error, damping_error) =
            (of(EXPONENT), of(DAMPING).or_else(|| of(DISSIPATION)));
        let samples = &r[..self.accel_m_s2.len()];
        let model = self.model(p);
        let fit = Fit {
            law,
            parameters: *p,
            free,
            model,
            predicted: model.predict(),
            touch_s: p[TOUCH] * self.dt_s,
            touch_error,
            secant_n_m: secant(p).exp(),
            secant_error_ratio: (variance * scale).max(0.0).sqrt(),
            exponent_error,
            damping_ratio: p[DAMPING],
            damping_error,
            chi_squared: cost,
            log_information: log_determinant(&normal)?,
            degrees,
            residual_ratio: (square(samples) / samples.len() as f64).sqrt() * self.sigma()
                / self.peak_m_s2,
        };
        let sound = fit.secant_n_m.is_finite()
            && fit.secant_error_ratio.is_finite()
            && fit.predicted.contact_s > 0.0;
        sound.then_some(fit)
    }
}

/// Damping that is negative by this many standard deviations is not a coincidence; damping that is
/// negative by less than the following limit does not matter.
const NEGATIVE_ERRORS: f64 = 3.0;
const NEGATIVE_DAMPING: f64 = 0.005;

impl Fit {
    /// −2 ln of the probability of the samples, up to a constant, by the method of Laplace: a law that must choose its
    /// numbers narrowly out of what they may be has a small one. `scale` is the variance of the samples over their noise.
    pub(super) fn unlikeliness(&self, scale: f64) -> f64 {
        let extra = self.free.iter().map(|&which| {
            let (expected, width) = self.expected(which);
            let off = (self.parameters[which] - expected) / width;
            // Those of a curve are among the residuals.
            2.0 * width.ln() + if which < CURVE { off * off } else { 0.0 }
        });
        let count = self.free.len() as f64;
        self.chi_squared / scale + self.log_information - count * scale.ln() + extra.sum::<f64>()
    }

    /// Whether a fit has fewer parameters than another one, or as many and is likelier.
    pub(super) fn simpler(&self, other: &Self, scale: f64) -> Ordering {
        let parameters = self.free.len().cmp(&other.free.len());
        parameters.then(
            self.unlikeliness(scale)
                .total_cmp(&other.unlikeliness(scale)),
        )
    }

    /// Where a parameter is expected and how far from there it may be: about a linear pad. Of the parameters that every
    /// law has, nothing is expected here.
    fn expected(&self, which: usize) -> (f64, f64) {
        match which {
            EXPONENT => (1.0, 0.5),
            CUBE => (0.0, 0.5),
            DAMPING => (0.0, 0.1),
            DISSIPATION => (0.0, 0.2),
            CURVE.. => (0.0, self.parameters[ROUGHNESS]),
            _ => (self.parameters[which], 1.0),
        }
    }

    /// The standard deviation of ln k about this fit, by what all fits make of the samples, each as much as it is likely.
    pub(super) fn error_among<'a>(
        &self,
        fits: impl IntoIterator<Item = &'a Self>,
        scale: f64,
    ) -> f64 {
        let of = |fit: &Self| {
            let apart = (fit.secant_n_m / self.secant_n_m).ln();
            (
                fit.unlikeliness(scale),
                fit.secant_error_ratio.powi(2) + apart * apart,
            )
        };
        let variances: Vec<(f64, f64)> = fits.into_iter().map(of).collect();
        let lowest = variances
            .iter()
            .map(|(unlikeliness, _)| *unlikeliness)
            .fold(f64::INFINITY, f64::min);
        let (mut sum, mut total) = (0.0, 0.0);
        for (unlikeliness, variance) in variances {
            let weight = (0.5 * (lowest - unlikeliness)).exp();
            sum += weight * variance;
            total += weight;
        }
        (sum / total).sqrt()
    }

    /// The zero line of the fit, above that of the samples.
    pub(super) fn offset_m_s2(&self, peak_m_s2: f64) -> f64 {
        self.parameters[OFFSET] * peak_m_s2
    }

    /// The corner of the filter, where it was fitted \[Hz\].
    pub(super) fn fitted_corner_hz(&self) -> Option<f64> {
        self.free
            .contains(&CORNER)
            .then(|| self.parameters[CORNER].exp())
    }

    /// Whether the numbers are those of a pad: a curve that contains laws without damping may be negative by its error.
    pub(super) fn is_law(&self) -> bool {
        match self.law {
            FittedLaw::Tabulated => !self.gives_energy(),
            _ => self.damping_ratio >= 0.0 && self.model.dissipation_s_m >= 0.0,
        }
    }

    /// Whether the law fits the samples only with clearly negative damping.
    pub(super) fn gives_energy(&self) -> bool {
        let [damping, dissipation] = [DAMPING, DISSIPATION].map(|which| self.parameters[which]);
        self.damping_error.is_some_and(|error| {
            damping.min(dissipation) < -(NEGATIVE_ERRORS * error).max(NEGATIVE_DAMPING)
        })
    }
}

/// The end of a search.
#[derive(Debug, Clone)]
struct Descent {
    p: Parameters,
    cost: f64,
}

fn keep_better(best: &mut Option<Descent>, found: Descent) {
    if found.cost.is_finite() && best.as_ref().is_none_or(|best| found.cost < best.cost) {
        *best = Some(found);
    }
}

/// The curve of a force up to a compression.
fn curved(mut p: Parameters, depth_m: f64, force_n: impl Fn(f64) -> f64) -> Parameters {
    let secant_n_m = force_n(depth_m) / depth_m;
    (p[DEPTH], p[STIFFNESS], p[EXPONENT], p[CUBE], p[DISSIPATION]) =
        (depth_m, secant_n_m.ln(), 1.0, 0.0, 0.0);
    let step_m = depth_m / PIECES as f64;
    let tangent = |i: usize| {
        let [low, high] =
            [i as f64 - 0.5, i as f64 + 0.5].map(|x| x.clamp(0.0, PIECES as f64) * step_m);
        ((force_n(high) - force_n(low)) / (high - low)).max(LEAST_TANGENT * secant_n_m)
    };
    (0..PIECES).for_each(|i| p[CURVE + i] = (tangent(i + 1) / tangent(0)).ln());
    p
}

/// A point next to p for the derivative by one parameter, and its distance. The first contact does
/// not pass a sample, where the force of a damped pad jumps.
fn perturbed(p: &Parameters, i: usize) -> (Parameters, f64) {
    let mut q = *p;
    let step = step_of(i);
    let passes = i == TOUCH && (p[i] + step).ceil() != p[i].ceil();
    let h = if passes { -step } else { step };
    q[i] += h;
    (q, h)
}

/// Removes the first contact (the first of the free parameters) where it is at a bound and the step
/// would leave the range.
fn hold_at_bound(
    normal: &mut [Vec<f64>],
    gradient: &mut [f64],
    touch: f64,
    bounds: Option<(f64, f64)>,
) {
    let Some((low, high)) = bounds else { return };
    let Some(down_hill) = gradient.first_mut() else {
        return;
    };
    if (touch >= high && *down_hill > 0.0) || (touch <= low && *down_hill < 0.0) {
        *down_hill = 0.0;
        for (i, row) in normal.iter_mut().enumerate() {
            for (j, value) in row.iter_mut().enumerate() {
                if (i == TOUCH) != (j == TOUCH) {
                    *value = 0.0;
                }
            }
        }
    }
}

/// Moves the parameters, within the range in which the laws are valid.
fn moved(p: &Parameters, free: &[usize], step: &[f64], touch: f64) -> Parameters {
    let mut next = *p;
    for (&i, s) in free.iter().zip(step) {
        let most = match i {
            TOUCH => touch.max(2.0),
            OFFSET => 0.05,
            _ => 0.3,
        };
        next[i] += s.clamp(-most, most);
    }
    next.iter_mut()
        .skip(CURVE)
        .for_each(|q| *q = q.clamp(-MOST_CHANGE, MOST_CHANGE));
    next[EXPONENT] = next[EXPONENT].clamp(0.3, 8.0);
    next[DAMPING] = next[DAMPING].clamp(-0.2, 2.0);
    next[DISSIPATION] = next[DISSIPATION].clamp(-0.3, 20.0);
    next
}

fn square(r: &[f64]) -> f64 {
    r.iter().map(|x| x * x).sum()
}

/// Gaussian elimination with pivoting.
pub(super) fn solve(mut a: Vec<Vec<f64>>, mut b: Vec<f64>) -> Option<Vec<f64>> {
    let n = b.len();
    for k in 0..n {
        let pivot = (k..n).max_by(|&i, &j| a[i][k].abs().total_cmp(&a[j][k].abs()))?;
        a.swap(k, pivot);
        b.swap(k, pivot);
        if !(a[k][k].abs() > 0.0 && a[k][k].is_finite()) {
            return None;
        }
        let row = a[k].clone();
        for i in k + 1..n {
            let factor = a[i][k] / row[k];
            a[i].iter_mut()
                .zip(&row)
                .skip(k)
                .for_each(|(x, y)| *x -= factor * y);
            b[i] -= factor * b[k];
        }
    }
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|j| a[k][j] * b[j]).sum();
        b[k] = (b[k] - known) / a[k][k];
    }
    b.iter().all(|x| x.is_finite()).then_some(b)
}

/// ln of the determinant of a positive definite matrix (Cholesky).
fn log_determinant(a: &[Vec<f64>]) -> Option<f64> {
    let mut rows: Vec<Vec<f64>> = Vec::with_capacity(a.len());
    let mut sum = 0.0;
    for (i, given) in a.iter().enumerate() {
        let mut row: Vec<f64> = Vec::with_capacity(i + 1);
        for j in 0..i {
            let known: f64 = row.iter().zip(&rows[j]).map(|(x, y)| x * y).sum();
            row.push((given[j] - known) / rows[j][j]);
        }
        let rest = given[i] - row.iter().map(|x| x * x).sum::<f64>();
        if rest.is_nan() || rest <= 0.0 {
            return None;
        }
        sum += rest.ln();
        row.push(rest.sqrt());
        rows.push(row);
    }
    Some(sum)
}

fn inverse(a: &[Vec<f64>]) -> Option<Vec<Vec<f64>>> {
    (0..a.len())
        .map(|i| {
            solve(
                a.to_vec(),
                (0..a.len())
                    .map(|j| if i == j { 1.0 } else { 0.0 })
                    .collect(),
            )
        })
        .collect()
}
