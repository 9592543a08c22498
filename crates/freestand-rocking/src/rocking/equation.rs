//! The equation of motion on one edge, as a Taylor series over a step.

use std::f64::consts::FRAC_PI_2;

use super::{RockingError, RockingModel};
use crate::block::Pivot;
use crate::polynomial::{self, MAX_DEGREE};
use crate::wall::Contact;

/// Largest p·h of a step: up to it the series converges like ½ᵏ/k! or faster.
const MAX_STEP: f64 = 0.5;

/// The block as it turns about one of its edges, with y = sθ ≥ 0.
///
/// With E = (1+ü_v/g) sin α + s(ü_h/g) cos α and D = (1+ü_v/g) cos α − s(ü_h/g) sin α, both linear
/// in time between samples, the equation of motion is ÿ = −p²(E cos y − D sin y). E vanishes where
/// the block is about to uplift, so small rotations keep their digits. Linearised: E = (1+ü_v/g)α +
/// sü_h/g, D = 1+ü_v/g, cos y → 1, sin y → y.
#[derive(Debug, Clone, Copy)]
pub(super) struct Edge {
    /// s: +1 on the right edge, −1 on the left one.
    pub side: f64,
    pub pivot: Pivot,
    pub p2: f64,
    pub linearised: bool,
    /// Uplift threshold of s·ü_h/g: tan α, or α when linearised.
    pub threshold: f64,
    /// The wall that ends the rotation about this edge.
    pub wall: Option<Contact>,
    sin: f64,
    cos: f64,
}

/// What the block does at the start of a segment.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Start {
    /// It goes on from any state.
    Moving,
    /// It leaves the floor from rest, at the instant at which the threshold is passed: E is zero or
    /// less there, whatever rounding yields.
    Lifting,
    /// It leaves the wall without velocity, at the instant at which nothing presses it on any
    /// longer: −ÿ is zero or more there.
    Leaving,
    /// The wall holds it throughout.
    Held,
}

/// Base acceleration over a step in units of g, with one g of gravity in `v`: start and
/// slope \[1/s\].
#[derive(Debug, Clone, Copy)]
pub(super) struct Ground {
    pub u: f64,
    pub u_slope: f64,
    pub v: f64,
    pub v_slope: f64,
}

impl Ground {
    /// The acceleration `tau` later.
    pub(super) fn after(self, tau: f64) -> Self {
        Self {
            u: self.u + self.u_slope * tau,
            v: self.v + self.v_slope * tau,
            ..self
        }
    }
}

/// A part of a history between two events or samples: y = sθ as a polynomial in time.
#[derive(Debug, Clone, Copy)]
pub struct Segment {
    /// Start time \[s\].
    pub start_s: f64,
    /// The step that the series is scaled by \[s\].
    pub step_s: f64,
    /// The share of the step that belongs to the history, in (0, 1\].
    pub end_ratio: f64,
    pub(super) edge: Edge,
    pub(super) ground: Ground,
    pub(super) gravity_m_s2: f64,
    /// Whether a wall holds the block throughout.
    held: bool,
    series: [f64; MAX_DEGREE + 1],
    degree: usize,
}

impl Edge {
    pub(super) fn new(
        side: f64,
        pivot: Pivot,
        cg_from_edge_m: f64,
        cg_height_m: f64,
        gravity: f64,
        model: RockingModel,
    ) -> Self {
        let p = pivot.frequency_parameter_rad_s(gravity);
        let linearised = model == RockingModel::Linearised;
        let alpha = pivot.slenderness_angle_rad;
        let (sin, cos, threshold) = if linearised {
            (alpha, 1.0, alpha)
        } else {
            (
                cg_from_edge_m / pivot.half_diagonal_m,
                cg_height_m / pivot.half_diagonal_m,
                cg_from_edge_m / cg_height_m,
            )
        };
        Self {
            side,
            pivot,
            p2: p * p,
            linearised,
            threshold,
            wall: None,
            sin,
            cos,
        }
    }

    /// The rotation that ends the motion about this edge: θ_c, or π/2 without a wall.
    pub(super) fn ceiling(&self) -> f64 {
        self.wall.map_or(FRAC_PI_2, |wall| wall.angle_rad)
    }

    /// Whether the block at rest touches the wall of this side.
    pub(super) fn touches_wall(&self) -> bool {
        self.wall.is_some_and(|wall| wall.touches())
    }

    /// What pulls the block back from the rotation y: (1+ü_v/g) sin(α−y) + s(ü_h/g) cos(α−y), by
    /// which a block at a wall leaves it (> 0) or leans on it.
    pub(super) fn pull(&self, y: f64, u: f64, v: f64) -> f64 {
        let (sin, cos) = (self.pivot.slenderness_angle_rad - y).sin_cos();
        v * sin + self.side * u * cos
    }

    /// How far the base is from lifting the block about this edge: (1+ü_v/g) tan α + s ü_h/g,
    /// negative when it uplifts.
    pub(super) fn margin(&self, u: f64, v: f64) -> f64 {
        v * self.threshold + self.side * u
    }

    /// Whether a block that leaves the floor with the velocity w does not reach its balance point on a base
    /// at rest, or meets a wall before it.
    pub(super) fn swings_back(&self, w: f64) -> bool {
        let alpha = self.pivot.slenderness_angle_rad;
        self.ceiling() < alpha || self.stays_on_its_side(0.0, w)
    }

    /// Whether a block at the rotation y with the velocity w does not pass its balance point on a base at rest:
    /// ½w² < p²(1 − cos(α−y)) = 2p² sin²((α−y)/2).
    pub(super) fn stays_on_its_side(&self, y: f64, w: f64) -> bool {
        let phi = self.pivot.slenderness_angle_rad - y;
        let climb = if self.linearised {
            0.5 * phi * phi
        } else {
            2.0 * (0.5 * phi).sin().powi(2)
        };
        0.5 * w * w < self.p2 * climb
    }

    /// The speed with which a block at the rotation y ≤ α and the velocity w lands on a base at rest, where
    /// energy is conserved: v² = w² + 2p²(cos(α−y) − cos α).
    pub(super) fn landing_speed(&self, y: f64, w: f64) -> f64 {
        let alpha = self.pivot.slenderness_angle_rad;
        let fall = if self.linearised {
            (alpha - 0.5 * y) * y
        } else {
            2.0 * (alpha - 0.5 * y).sin() * (0.5 * y).sin()
        };
        (w * w + 2.0 * self.p2 * fall).sqrt()
    }

    /// The longest step over which the series converges fast.
    pub(super) fn max_step_s(&self) -> f64 {
        MAX_STEP / self.p2.sqrt()
    }
}

impl Segment {
    /// The motion from (y, w) at `start_s` over `step_s`, which is halved as often as the series
    /// needs.
    #[expect(
        clippy::too_many_arguments,
        reason = "the state, the step and the accuracy are what a Taylor step takes"
    )]
    pub(super) fn new(
        edge: Edge,
        y: f64,
        w: f64,
        ground: Ground,
        gravity_m_s2: f64,
        start_s: f64,
        step_s: f64,
        tolerance: f64,
        start: Start,
    ) -> Result<Self, RockingError> {
        let mut segment = Self {
            start_s,
            step_s,
            end_ratio: 1.0,
            edge,
            ground,
            gravity_m_s2,
            held: start == Start::Held,
            series: [0.0; MAX_DEGREE + 1],
            degree: 0,
        };
        if segment.held {
            segment.series[0] = y;
            return Ok(segment);
        }
        let least_s = step_s * 1e-12;
        while !segment.expand(y, w, tolerance, start) {
            segment.step_s *= 0.5;
            if segment.step_s <= least_s {
                return Err(RockingError::StepTooSmall {
                    time_s: start_s,
                    step_s: segment.step_s,
                });
            }
        }
        Ok(segment)
    }

    /// Taylor coefficients in units of the step, up to the order at which two consecutive terms
    /// fall below `tolerance` of the largest; `false` if that takes more terms than the arrays
    /// hold.
    fn expand(&mut self, y: f64, w: f64, tolerance: f64, start: Start) -> bool {
        let (edge, ground, h) = (&self.edge, &self.ground, self.step_s);
        let e = {
            let margin = edge.margin(ground.u, ground.v);
            edge.cos
                * if start == Start::Lifting {
                    margin.min(0.0)
                } else {
                    margin
                }
        };
        let e_slope = h * edge.cos * edge.margin(ground.u_slope, ground.v_slope);
        let (d, d_slope) = if edge.linearised {
            (ground.v, h * ground.v_slope)
        } else {
            (
                ground.v * edge.cos - edge.side * ground.u * edge.sin,
                h * (ground.v_slope * edge.cos - edge.side * ground.u_slope * edge.sin),
            )
        };
        let factor = -edge.p2 * h * h;

        let c = &mut self.series;
        c[0] = y;
        c[1] = w * h;
        let mut sin = [0.0; MAX_DEGREE + 1];
        let mut cos = [0.0; MAX_DEGREE + 1];
        (sin[0], cos[0]) = if edge.linearised {
            (y, 1.0)
        } else {
            y.sin_cos()
        };
        // k·cₖ, the series of the derivative.
        let mut slope = [0.0; MAX_DEGREE + 1];
        slope[1] = c[1];
        let mut largest = y.abs().max(c[1].abs());
        let mut small = 0;
        for k in 0..=MAX_DEGREE - 2 {
            if k > 0 {
                if edge.linearised {
                    sin[k] = c[k];
                } else {
                    let (mut s, mut q) = (0.0, 0.0);
                    for j in 1..=k {
                        s += slope[j] * cos[k - j];
                        q += slope[j] * sin[k - j];
                    }
                    sin[k] = s / k as f64;
                    cos[k] = -q / k as f64;
                }
            }
            let mut f = e * cos[k] - d * sin[k];
            if k > 0 {
                f += e_slope * cos[k - 1] - d_slope * sin[k - 1];
            } else if start == Start::Leaving {
                f = f.max(0.0);
            }
            let next = factor * f / ((k + 1) * (k + 2)) as f64;
            c[k + 2] = next;
            slope[k + 2] = (k + 2) as f64 * next;
            largest = largest.max(next.abs());
            // The term of the derivative is tested: velocities are then as accurate as rotations.
            small = if slope[k + 2].abs() <= tolerance * largest {
                small + 1
            } else {
                0
            };
            if small >= 2 && k >= 2 {
                self.degree = k + 2;
                return largest.is_finite();
            }
        }
        false
    }

    /// Taylor coefficients of y in units of the step.
    pub(super) fn series(&self) -> &[f64] {
        &self.series[..=self.degree]
    }

    /// y and dy/dt \[rad/s\] at a ratio of the step.
    pub(super) fn state(&self, ratio: f64) -> (f64, f64) {
        let (y, slope) = polynomial::value_and_slope(self.series(), ratio);
        (y, slope / self.step_s)
    }

    /// Whether an impact or an uplift happened at the start: the block is on the floor or at the
    /// wall there.
    pub(super) fn starts_with_an_event(&self) -> bool {
        let y = self.series[0];
        y == 0.0 || (y == self.edge.ceiling() && !self.held)
    }

    /// θ \[rad\] and ω \[rad/s\] at a ratio in \[0, 1\] of the step.
    pub fn rotation(&self, ratio: f64) -> (f64, f64) {
        let (y, w) = self.state(ratio);
        (self.edge.side * y, self.edge.side * w)
    }

    /// The largest F_x/N of the contact over the segment while |θ| ≤ α: with a smaller coefficient
    /// of friction the object slides. Infinite where the contact would have to pull (N ≤ 0), 0
    /// where the object is past its balance point throughout.
    ///
    /// # Limitation
    /// Past α an object falls, its contact unloads and F_x/N passes through a pole: the value does
    /// not cover this range.
    pub fn friction_needed_ratio(&self) -> f64 {
        const PARTS: usize = 4;
        let at = |i: usize| self.end_ratio * i as f64 / PARTS as f64;
        let best = (0..=PARTS)
            .max_by(|&i, &j| self.friction(at(i)).total_cmp(&self.friction(at(j))))
            .unwrap_or(0);
        let mut most = self.friction(at(best));
        if (1..PARTS).contains(&best) {
            // A smooth maximum inside the segment: golden sections around it, to far below the
            // printed digits.
            let (mut lo, mut hi) = (at(best - 1), at(best + 1));
            for _ in 0..40 {
                let (a, b) = (
                    hi - 0.618_033_988_75 * (hi - lo),
                    lo + 0.618_033_988_75 * (hi - lo),
                );
                if self.friction(a) > self.friction(b) {
                    hi = b
                } else {
                    lo = a
                }
            }
            most = most.max(self.friction(0.5 * (lo + hi)));
        }
        most
    }

    /// F_x/N of the contact at a ratio of the step; 0 past the balance point.
    ///
    /// F_x/m = ü_h + s ẍ, N/m = g + ü_v + z̈ with the centre of gravity at x = −R sin(α−y), z = R
    /// cos(α−y). A block that leans does not accelerate: the moment that presses it on the wall,
    /// −m g R P, gives the force of the wall on its lever ℓ.
    pub(super) fn friction(&self, ratio: f64) -> f64 {
        let (y, w) = self.state(ratio);
        let Ground { u, v, .. } = self.ground.after(ratio * self.step_s);
        let edge = &self.edge;
        let (sin, cos) = (edge.pivot.slenderness_angle_rad - y).sin_cos();
        let (horizontal, vertical) = if let Some(wall) = edge.wall.filter(|_| self.held) {
            let pressed = -edge.pivot.half_diagonal_m * edge.pull(y, u, v) / wall.lever_m;
            let (lift, push) = wall.force_angle_rad.sin_cos();
            (u + edge.side * pressed * push, v - pressed * lift)
        } else {
            let acceleration = -edge.p2
                * if edge.linearised {
                    edge.margin(u, v) - v * y
                } else {
                    v * sin + edge.side * u * cos
                };
            let r = edge.pivot.half_diagonal_m / self.gravity_m_s2;
            (
                u + edge.side * r * (cos * acceleration + sin * w * w),
                v + r * (sin * acceleration - cos * w * w),
            )
        };
        if y > edge.pivot.slenderness_angle_rad {
            0.0
        } else if vertical > 0.0 {
            horizontal.abs() / vertical
        } else {
            f64::INFINITY
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::Block;

    fn segment(step_s: f64, model: RockingModel) -> Segment {
        let block = Block::uniform(1.5, 0.5).unwrap();
        let edge = Edge::new(
            1.0,
            block.right_pivot(),
            block.cg_from_right_m(),
            block.cg_height_m(),
            9.81,
            model,
        );
        let ground = Ground {
            u: -0.4,
            u_slope: 3.0,
            v: 1.1,
            v_slope: 1.3,
        };
        Segment::new(
            edge,
            0.07,
            0.3,
            ground,
            9.81,
            0.0,
            step_s,
            1e-16,
            Start::Moving,
        )
        .unwrap()
    }

    /// The local error of the series truncated after degree n decreases like hⁿ⁺¹: every
    /// coefficient is right to its order.
    #[test]
    fn a_series_of_degree_n_converges_with_order_n_plus_one() {
        for model in [RockingModel::Rigid, RockingModel::Linearised] {
            for degree in 2..=4_u8 {
                let error = |step_s: f64| {
                    let full = segment(step_s, model);
                    (polynomial::value(&full.series()[..=usize::from(degree)], 1.0)
                        - full.state(1.0).0)
                        .abs()
                };
                let order = (error(0.04) / error(0.02)).log2();
                // A wrong coefficient of degree k ≤ n would show as order k; the next term changes
                // the order by less than half.
                let excess = order - (f64::from(degree) + 1.0);
                assert!(
                    (-0.5..0.75).contains(&excess),
                    "{model:?} degree {degree}: order {order}"
                );
            }
        }
    }

    /// The polynomial satisfies the equation of motion: its second derivative equals the right-hand
    /// side.
    #[test]
    fn the_series_solves_the_equation_of_motion() {
        let full = segment(0.08, RockingModel::Rigid);
        let second: Vec<f64> = full
            .series()
            .iter()
            .enumerate()
            .skip(2)
            .map(|(k, c)| (k * (k - 1)) as f64 * c / (0.08 * 0.08))
            .collect();
        for ratio in [0.0, 0.3, 0.7, 1.0] {
            let Ground { u, v, .. } = full.ground.after(0.08 * ratio);
            let phi = full.edge.pivot.slenderness_angle_rad - full.state(ratio).0;
            let expected = -full.edge.p2 * (v * phi.sin() + u * phi.cos());
            // Double precision for a sum of terms of up to 20.
            assert!(
                (polynomial::value(&second, ratio) - expected).abs() < 1e-11,
                "{ratio}"
            );
        }
    }
}
