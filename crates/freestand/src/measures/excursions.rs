//! The times at which a motion, linear between its samples, exceeds a level.

use crate::motion::Motion;

/// An interval in which the acceleration exceeds a level on one side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Excursion {
    /// Start; 0 where the motion begins above the level \[s\].
    pub from_s: f64,
    /// End; the end of the motion where it does not return \[s\].
    pub to_s: f64,
    /// Whether the acceleration is positive.
    pub positive: bool,
}

/// Every interval in which |a| > `level_m_s2` ≥ 0, in order; the crossings are exact for a motion
/// that is linear between samples. An acceleration that only reaches the level does not exceed it.
///
/// # Example
/// ```
/// use freestand::{measures::excursions, motion::Motion};
/// let triangle = Motion::new(1.0, vec![0.0, 2.0, -2.0, 0.0])?;
/// let above = excursions(&triangle, 1.0);
/// let spans: Vec<_> = above.iter().map(|one| (one.from_s, one.to_s)).collect();
/// assert_eq!(spans, [(0.5, 1.25), (1.75, 2.5)]);
/// # Ok::<(), freestand::motion::MotionError>(())
/// ```
pub fn excursions(motion: &Motion, level_m_s2: f64) -> Vec<Excursion> {
    let mut found = one_side(motion, level_m_s2, 1.0);
    found.extend(one_side(motion, level_m_s2, -1.0));
    found.sort_by(|a, b| a.from_s.total_cmp(&b.from_s));
    found
}

fn one_side(motion: &Motion, level_m_s2: f64, sign: f64) -> Vec<Excursion> {
    let (dt_s, accel) = (motion.dt_s(), motion.accel_m_s2());
    let mut found = Vec::new();
    let mut since = (sign * accel[0] > level_m_s2).then_some(0.0);
    for (i, pair) in accel.windows(2).enumerate() {
        let (before, after) = (sign * pair[0], sign * pair[1]);
        let crossing_s = || (i as f64 + (level_m_s2 - before) / (after - before)) * dt_s;
        match since {
            None if after > level_m_s2 => since = Some(crossing_s()),
            Some(from_s) if after <= level_m_s2 => {
                found.push(Excursion {
                    from_s,
                    to_s: crossing_s(),
                    positive: sign > 0.0,
                });
                since = None;
            }
            _ => {}
        }
    }
    found.extend(since.map(|from_s| Excursion {
        from_s,
        to_s: motion.duration_s(),
        positive: sign > 0.0,
    }));
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn touching_is_not_exceeding_and_ends_are_kept() {
        let motion = Motion::new(0.5, vec![3.0, 1.0, 0.0, 1.0, 0.0, -1.5, -1.5]).unwrap();
        let found = excursions(&motion, 1.0);
        // From the start to the sample on the level; nothing where it only reaches the level in the
        // middle; the end is open.
        assert_eq!(
            found[0],
            Excursion {
                from_s: 0.0,
                to_s: 0.5,
                positive: true
            }
        );
        assert_eq!(found.len(), 2);
        // From 0 to −1.5 in 0.5 s: −1 after 1/3 s. Two roundings.
        assert!((found[1].from_s - (2.0 + 1.0 / 3.0)).abs() < 1e-15);
        assert_eq!((found[1].to_s, found[1].positive), (3.0, false));
    }

    #[test]
    fn times_above_a_level_of_a_sine_are_those_of_the_arc() {
        // For two thirds of the time |sin| > 1/2. Linear between samples: the crossings move by
        // dt²/8 · curvature.
        let n = 4000;
        let motion = Motion::new(
            1e-3,
            (0..=n)
                .map(|i| (std::f64::consts::TAU * i as f64 * 1e-3).sin())
                .collect(),
        );
        let found = excursions(&motion.unwrap(), 0.5);
        let total: f64 = found.iter().map(|one| one.to_s - one.from_s).sum();
        assert_eq!(found.len(), 8);
        // Each of 16 crossings: (1e-3)²/8 · (2π)² · 0.5 over a slope of 5.4.
        assert!((total - 8.0 / 3.0).abs() < 16.0 * 5e-7, "{total}");
        assert!(
            found
                .windows(2)
                .all(|pair| pair[0].to_s < pair[1].from_s && pair[0].positive != pair[1].positive)
        );
    }
}
