//! All the flights before rest in one formula.

/// What pulls a block back to the floor about one edge over the rest of a step: `now` + `slope` x.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pull {
    pub(super) now: f64,
    pub(super) slope: f64,
}

/// Largest |ε| = |E′w/E²| of a flight whose duration is a series in ε.
pub(super) const SMALL_EPSILON: f64 = 0.02;

/// τ of a flight under E + E′x that lasts (2w/E)τ: ⅔ετ² + τ = 1, as a series whose first omitted
/// term is 42(⅔ε)⁵ < 2e-8.
#[inline(always)]
fn flight_ratio(epsilon: f64) -> f64 {
    let a = 2.0 / 3.0 * epsilon;
    let square = a * a;
    (1.0 - a) + square * ((2.0 - 5.0 * a) + 14.0 * square)
}

impl Pull {
    #[inline(always)]
    fn after(self, time: f64) -> Self {
        Self {
            now: self.now + time * self.slope,
            ..self
        }
    }
}

/// The largest y and the largest speed of an impact about an edge so far.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Trace {
    pub(super) height: f64,
    pub(super) speed: f64,
}

/// Flights are calculated one by one while the pull still changes by more than this ratio on the
/// way to rest. Below it the third-order error of the sum is less than 3e-6, far less than the ln
/// of the speed ratio of two impacts.
const SMALL_CHANGE: f64 = 0.01;

/// Impacts to rest, as long as both pulls stay positive.
///
/// A flight under E + E′x lasts (2w/E)τ with ⅔ετ² + τ = 1, ε = E′w/E², and lands at w(2 − τ), like
/// a ball on a table under changing gravity. With ln(2 − τ) = ⅔ε − 10/9 ε² + … the sum over all
/// flights consists of geometric series, taken to the second order. The contribution of y to the
/// pull conserves energy about each edge and drops out.
#[inline(never)]
pub(super) fn count(mut edges: [Pull; 2], r: f64, mut w: f64, rest: f64) -> usize {
    let mut followed = 0;
    loop {
        if w <= rest {
            return followed;
        }
        let [first, other] = edges;
        let small =
            |pull: Pull| (pull.slope * w).abs() <= SMALL_CHANGE * (1.0 - r) * pull.now * pull.now;
        if small(first) && small(other) {
            let impacts = ((w / rest).ln() + growth(edges, r, w)) / -r.ln();
            return followed + impacts.ceil().max(1.0) as usize;
        }
        let epsilon = first.slope * w / (first.now * first.now);
        let tau = if epsilon.abs() > SMALL_EPSILON {
            2.0 / (1.0 + (1.0 + 8.0 / 3.0 * epsilon).sqrt())
        } else {
            flight_ratio(epsilon)
        };
        let flight = 2.0 * w / first.now * tau;
        w *= r * (2.0 - tau);
        followed += 1;
        edges = [other, first].map(|pull| pull.after(flight));
    }
}

/// ln of the factor by which changes of the pull increase the speed over all flights to rest, to
/// the second order in E′.
fn growth([first, other]: [Pull; 2], r: f64, w: f64) -> f64 {
    let q = r * r;
    // ε of the first two flights, their durations, and E′/E.
    let (e0, e1) = (
        first.slope * w / (first.now * first.now),
        other.slope * w * r / (other.now * other.now),
    );
    let (t0, t1) = (2.0 * w / first.now, 2.0 * w * r / other.now);
    let (k0, k1) = (first.slope / first.now, other.slope / other.now);
    let gained = 2.0 / 3.0 * (e0 + e1) / (1.0 - q);
    let time = (t0 + t1) / (1.0 - q);
    let pairs = q * (e0 * (gained - 2.0 * k0 * time) + e1 * (gained - 2.0 * k1 * time));
    let within = e1 * (2.0 / 3.0 * e0 - 2.0 * k1 * t0);
    gained + (2.0 / 3.0 * (pairs + within) - 10.0 / 9.0 * (e0 * e0 + e1 * e1)) / (1.0 - q * q)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Number of impacts and speed after the last one, calculated flight by flight.
    fn followed(mut edges: [Pull; 2], r: f64, mut w: f64, rest: f64) -> (usize, f64) {
        let mut count = 0;
        while w > rest {
            let (e, s) = (edges[0].now, edges[0].slope);
            // w t = E t²/2 + E′ t³/6.
            let flight = 2.0 * w / (0.5 * e + (0.25 * e * e + 2.0 / 3.0 * s * w).sqrt());
            w = r * (e * flight + 0.5 * s * flight * flight - w);
            edges = [edges[1], edges[0]].map(|pull| Pull {
                now: pull.now + pull.slope * flight,
                ..pull
            });
            count += 1;
        }
        (count, w)
    }

    #[test]
    fn impacts_to_rest_are_those_of_flights_followed_one_by_one() {
        let mut cases = 0;
        for r in [0.3, 0.7, 0.9, 0.97] {
            for (e0, e1, s0, s1) in [
                (1.0, 1.0, 0.0, 0.0),
                (1.0, 0.4, 0.3, -0.3),
                (0.5, 2.0, -0.4, 0.3),
                (1.0, 0.7, -0.3, -0.1),
            ] {
                for i in 0..10 {
                    // All flights together take at most a tenth of the step, and less each time.
                    let w = 0.02 * (1.0 - r) * 0.61_f64.powi(i);
                    let edges = [Pull { now: e0, slope: s0 }, Pull { now: e1, slope: s1 }];
                    let rest = 1e-9;
                    let (impacts, last) = followed(edges, r, w, rest);
                    // The last speed must be further from the threshold than the third order can
                    // take it.
                    if (rest / last).ln() > 3e-6 && (last / (r * rest)).ln() > 3e-6 {
                        assert_eq!(
                            count(edges, r, w, rest),
                            impacts,
                            "{r} {e0} {e1} {s0} {s1} {w}"
                        );
                        cases += 1;
                    }
                }
            }
        }
        assert!(cases > 150, "{cases}");
    }

    /// ln of the growth against flights followed one by one: the error falls with the third power
    /// of the change.
    #[test]
    fn the_growth_is_right_to_the_second_order() {
        let edges = [
            Pull {
                now: 1.0,
                slope: 0.8,
            },
            Pull {
                now: 0.6,
                slope: -0.5,
            },
        ];
        let error = |w: f64| {
            let r: f64 = 0.8;
            let (count, last) = followed(edges, r, w, 1e-12 * w);
            ((last / w).ln() - count as f64 * r.ln() - growth(edges, r, w)).abs()
        };
        let order = (error(4e-3) / error(2e-3)).log2();
        assert!((order - 3.0).abs() < 0.2, "{order}");
    }
}
