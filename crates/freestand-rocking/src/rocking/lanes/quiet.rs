//! The rest of a response after the motion: the base is at rest and energy is conserved between
//! impacts, so no steps are needed.

use super::chatter::Trace;
use super::rocker::{EdgeTerms, Rocker};

/// The response of a block from the end of the motion until it rests.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Tail {
    /// Largest rotation about each edge \[rad\], and largest speed of an impact that ends it
    /// \[rad per step\].
    pub(super) sides: [Trace; 2],
    pub(super) impacts: usize,
    /// Upper bound of the number of steps.
    pub(super) steps: f64,
}

/// Smallest sin φ, divided by sin α, at which a block turns back. Closer to the balance point the
/// turn takes long, and rounding decides its result.
const LEAST_SINE: f64 = 1e-3;

/// The response from the rotation `y` and the velocity `w` about an edge until the speed after an
/// impact is at most `rest`; `None` where the block may not return to the floor, or meets a wall.
///
/// With ÿ = −x² sin φ, φ = α − y, the energy ½w² + x² cos φ about an edge is constant, and every
/// impact multiplies the speed by the restitution.
pub(super) fn tail(rocker: &Rocker, mut edge: usize, y: f64, w: f64, rest: f64) -> Option<Tail> {
    let mut tail = Tail::default();
    let terms = &rocker.edges[edge];
    let highest = if w > 0.0 {
        turning_point(terms, y, w)?
    } else {
        y
    };
    let clear = |terms: &EdgeTerms, highest: f64| (highest < terms.ceiling).then_some(());
    clear(terms, highest)?;
    let mut speed = landing_speed(terms, y, w);
    tail.steps = (w.abs() + speed) / least_pull(terms, highest)?;
    tail.sides[edge].height = highest;
    loop {
        let side = &mut tail.sides[edge];
        side.speed = side.speed.max(speed);
        edge = 1 - edge;
        speed *= rocker.restitution[edge];
        tail.impacts += 1;
        if speed <= rest {
            return Some(tail);
        }
        // Later flights about an edge are lower and shorter than the second one.
        if tail.impacts <= 2 {
            let terms = &rocker.edges[edge];
            let highest = turning_point(terms, 0.0, speed)?;
            clear(terms, highest)?;
            let [r, r_left] = rocker.restitution;
            tail.steps += 2.0 * speed / least_pull(terms, highest)? / (1.0 - r * r_left);
            let side = &mut tail.sides[edge];
            side.height = side.height.max(highest);
        }
    }
}

/// Whether a block with the rotation `y` and the velocity `w` about an edge has too little energy to pass a
/// balance point; no impact on a base at rest adds any.
pub(super) fn cannot_fall(rocker: &Rocker, edge: usize, y: f64, w: f64) -> bool {
    let terms = &rocker.edges[edge];
    let speed = landing_speed(terms, y, w);
    let returns = |terms: &EdgeTerms| {
        terms.ceiling < terms.alpha || turning_point(terms, 0.0, speed).is_some()
    };
    y < terms.alpha && rocker.edges.iter().all(returns)
}

/// The speed with which a block lands that has the rotation `y` ≤ α and the velocity `w`.
fn landing_speed(terms: &EdgeTerms, y: f64, w: f64) -> f64 {
    (w * w + 4.0 * terms.x2 * (terms.alpha - 0.5 * y).sin() * (0.5 * y).sin()).sqrt()
}

/// x² sin φ at the highest point of a flight, where the pull is weakest; `None` too close to the
/// balance point.
fn least_pull(terms: &EdgeTerms, highest: f64) -> Option<f64> {
    let sin = (terms.alpha - highest).sin();
    (sin >= LEAST_SINE * terms.alpha.sin()).then_some(terms.x2 * sin)
}

/// Rotation at which a rising block turns back: sin²(φₚ/2) = sin²(φ/2) − w²/4x²; `None` if it does
/// not.
fn turning_point(terms: &EdgeTerms, y: f64, w: f64) -> Option<f64> {
    let (sin, cos) = (0.5 * (terms.alpha - y)).sin_cos();
    let spent = 0.25 * w * w / terms.x2;
    let left = sin * sin - spent;
    if y >= terms.alpha || left <= 0.0 {
        return None;
    }
    // The difference of the two angles would lose the digits of a low flight; its sine does not.
    let risen = 2.0 * (spent / (sin * (1.0 - left).sqrt() + cos * left.sqrt())).asin();
    Some(y + risen)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;
    use crate::block::Block;
    use crate::motion::Motion;
    use crate::rocking::{Accuracy, Base, RockingOptions, Until, rock};

    /// Blocks released at up to 0.6 of the slenderness angle, against the scalar solver.
    #[test]
    fn a_tail_is_what_the_scalar_solver_follows() {
        let block = Block::uniform(1.5, 0.4).unwrap();
        let still = Motion::new(0.01, vec![0.0; 2]).unwrap();
        let pivot = block.pivot();
        let alpha = pivot.slenderness_angle_rad;
        for (y, omega) in [
            (0.5 * alpha, 0.0),
            (0.2 * alpha, 0.3),
            (0.6 * alpha, -0.2),
            (0.01 * alpha, 0.01),
        ] {
            let options = RockingOptions {
                accuracy: Accuracy::Tight,
                initial_rotation_rad: y,
                initial_omega_rad_s: omega,
                until: Until::Settled { at_most_s: 60.0 },
                ..RockingOptions::default()
            };
            let expected = rock(
                &block,
                Base {
                    horizontal: Some(&still),
                    vertical: None,
                },
                &options,
            )
            .unwrap();
            let h = 0.01;
            let x = pivot.frequency_parameter_rad_s(options.gravity_m_s2) * h;
            let terms = EdgeTerms {
                alpha,
                x2: x * x,
                threshold: alpha.tan(),
                b: x * x * alpha.cos(),
                ceiling: FRAC_PI_2,
            };
            let rocker = Rocker {
                edges: [terms; 2],
                restitution: [block.landing_ratio(); 2],
            };
            let got = tail(&rocker, 0, y, omega * h, 1e-9 * h).unwrap();
            assert_eq!(got.impacts, expected.impacts.len());
            for (got, expected) in got.sides.iter().zip(expected.sides) {
                // Rounding of about ten operations, and of as many steps of the solver.
                assert!((got.height / expected.peak_rotation_rad - 1.0).abs() < 1e-13);
                assert!((got.speed / h / expected.impact_omega_rad_s - 1.0).abs() < 1e-13);
            }
            let rest_s = expected.rest_time_s.unwrap();
            assert!(
                got.steps * h >= rest_s && got.steps * h < 10.0 * rest_s,
                "{} {rest_s}",
                got.steps * h
            );
        }
    }

    /// A block that overturns, or nearly does, is left to the step-by-step calculation.
    #[test]
    fn a_block_near_its_balance_point_has_no_tail() {
        let alpha = 0.25;
        let terms = EdgeTerms {
            alpha,
            x2: 1e-4,
            threshold: 0.0,
            b: 0.0,
            ceiling: FRAC_PI_2,
        };
        let rocker = Rocker {
            edges: [terms; 2],
            restitution: [0.9; 2],
        };
        let barrier = 2.0 * 1e-2 * (0.5_f64 * alpha).sin();
        assert!(tail(&rocker, 0, 0.0, 1.0001 * barrier, 1e-11).is_none());
        assert!(tail(&rocker, 0, 0.0, (1.0 - 1e-9) * barrier, 1e-11).is_none());
        assert!(tail(&rocker, 0, 0.0, 0.99 * barrier, 1e-11).is_some());
        assert!(tail(&rocker, 0, 1.1 * alpha, -0.01, 1e-11).is_none());
    }
}
