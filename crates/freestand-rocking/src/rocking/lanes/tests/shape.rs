//! What bounds on a series claim about a step, against the series itself.

use super::super::series::{Series, TERMS};
use super::trouble::Random;
use crate::polynomial::value;
use crate::vector::Math;

const K: usize = 7;

/// What a shape claims is so at every thousandth of the step, and every claim is made often.
#[test]
fn what_is_certain_of_a_step_is_so() {
    let m = Math(pulp::Scalar::new());
    let mut random = Random::new(1);
    let mut claims = [0; 5];
    for _ in 0..4000 {
        let mut c = [0.0_f64; TERMS];
        for (k, c) in c.iter_mut().enumerate().take(K + 1) {
            // Smaller from term to term, and here and there zero, as where a block starts from rest.
            let size = random.log(0.01, 1.0) * 0.3_f64.powi(k as i32);
            let sign = [0.0, -1.0, 1.0, 1.0, -1.0][random.pick(5)];
            *c = sign * size;
        }
        c[0] = c[0].max(0.0);
        let slope: [f64; TERMS] = std::array::from_fn(|k| k as f64 * c[k]);
        let series = Series::<pulp::Scalar, K> {
            c: c.map(|c| [c; 2]),
            slope: slope.map(|c| [c; 2]),
            // Not what a shape is found from.
            start: [[0.0; 2]; 2],
        };
        let shape = series.shape(m);
        let second: Vec<f64> = (2..=K).map(|k| (k - 1) as f64 * slope[k]).collect();
        let third: Vec<f64> = (1..second.len()).map(|k| k as f64 * second[k]).collect();
        // An exact zero at the start is none of the step.
        let all = |terms: &[f64], sign: f64| {
            (1..=1000).all(|i| sign * value(terms, f64::from(i) * 1e-3) > 0.0)
        };
        let truths = [
            (shape.concave, all(&second, -1.0)),
            (shape.convex, all(&second, 1.0)),
            (shape.opens, all(&third, 1.0)),
            (shape.closes, all(&third, -1.0)),
            (series.stays_above(m), all(&c[..=K], 1.0)),
        ];
        for (i, (claim, truth)) in truths.into_iter().enumerate() {
            assert!(!claim[0] || truth, "claim {i} of {c:?}");
            claims[i] += usize::from(claim[0]);
        }
    }
    assert!(claims.iter().all(|claims| *claims > 300), "{claims:?}");
}
