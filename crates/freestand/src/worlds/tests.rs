use rand::RngExt;

use super::*;

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

fn sd(values: &[f64]) -> f64 {
    let mean = mean(values);
    (values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / (values.len() - 1) as f64).sqrt()
}

#[test]
fn no_two_uses_share_random_numbers() {
    let mut seen = std::collections::HashSet::new();
    let mut add = |mut random: rand_chacha::ChaCha8Rng| assert!(seen.insert(random.random::<u64>()));
    add(crate::fragility::draw_stream(1, 0, 0, 1));
    for group in Group::ALL {
        for (seed, world, repetition) in [(1, 0, 0), (2, 0, 0), (1, 1, 0), (1, 0, 1), (1, 0, 256), (1, 256, 0)] {
            add(world_stream(seed, world, group, repetition));
            for object in [0, 1, u64::MAX] {
                add(object_stream(seed, world, object, group, repetition));
            }
        }
    }
}

/// Recorded with rand_chacha 0.10.0. Any other value changes every world of every study.
#[test]
fn the_random_numbers_of_worlds_stay() {
    let shared: u64 = world_stream(1, 7, Group::Motion, 0).random();
    let own: u64 = object_stream(1, 7, 99, Group::Pad, 2).random();
    assert_eq!([shared, own], [1953417826444048120, 6192029235278566179]);
}

#[test]
fn restitution_moves_by_its_loss() {
    // One sd at 0.95 and 0.87; two sd at 0.95, all to the printed digit.
    for (median, z, expected) in
        [(0.95, 1.0, 0.93), (0.95, -1.0, 0.966), (0.87, 1.0, 0.82), (0.87, -1.0, 0.91), (0.95, -2.0, 0.977)]
    {
        let r = restitution_at(median, 0.4, z);
        let digits = if expected > 0.95 { 1000.0 } else { 100.0 };
        assert!((r - expected).abs() < 0.5 / digits + 1e-12, "{median} {z}: {r}");
    }
    // logit L moves by exactly s ξ: 1e-15 of r is 1e-14 of a loss of 0.1.
    let logit = |r: f64| ((1.0 - r * r) / (r * r)).ln();
    assert!((logit(restitution_at(0.95, 0.4, 1.7)) - logit(0.95) - 0.68).abs() < 1e-13);
    for r in [1e-9, 0.3, 0.95, 1.0 - 1e-9] {
        for z in [-8.0, -1.0, 1.0, 8.0] {
            assert!((0.0..1.0).contains(&restitution_at(r, 0.8, z)) && restitution_at(r, 0.8, z) > 0.0, "{r} {z}");
        }
        assert_eq!(restitution_at(r, 0.0, 3.0), r);
    }
    assert_eq!(
        [restitution_at(1.0, 0.4, 2.0), restitution_at(0.0, 0.4, 2.0), restitution_at(-0.3, 0.4, 2.0)],
        [1.0, 0.0, 0.0]
    );
}

/// Half of the draws are below the median: within 4 standard errors of ½, which are 4 of r.
#[test]
fn the_median_of_restitution_is_what_was_given() {
    let draw = |world| restitution_draw(&mut object_stream(3, world, 5, Group::Restitution, 0), 0.95 * 0.98, 0.4);
    let draws: Vec<f64> = (0..4000).map(draw).collect();
    let below = draws.iter().filter(|r| **r < 0.95 * 0.98).count() as f64 / 4000.0;
    assert!((below - 0.5).abs() < 4.0 * 0.5 / 4000_f64.sqrt(), "{below}");
    assert!(draws.iter().all(|r| *r > 0.0 && *r < 1.0));
    // The spread is that of the logit, with a standard error of s/√(2n).
    let logits: Vec<f64> = draws.iter().map(|r| ((1.0 - r * r) / (r * r)).ln()).collect();
    assert!((sd(&logits) / 0.4 - 1.0).abs() < 4.0 / 8000_f64.sqrt(), "{}", sd(&logits));
}
