//! Measures of a motion for a block that may rock.

use super::{excursions, measures};
use crate::block::Block;
use crate::motion::Motion;

/// The intensity of a motion relative to a block: with `pga_ratio` below 1 the block does not
/// uplift, and of two motions the one with the larger `pgv_ratio` is more likely to overturn it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RockingMeasures {
    /// Acceleration that uplifts the block, g tan α \[m/s²\]; for a block with an offset, with the
    /// smaller α of its two edges.
    pub uplift_threshold_m_s2: f64,
    /// PGA/(g tan α).
    pub pga_ratio: f64,
    /// p·PGV/(g tan α).
    pub pgv_ratio: f64,
    /// Total time for which |a| > g tan α \[s\].
    pub time_above_s: f64,
    /// Number of intervals in which |a| > g tan α; a positive and a negative one count as two.
    pub excursions: usize,
}

/// The [`RockingMeasures`] of a motion for a block: α = atan(x/z) and p = √(m g R/I₀) of the edge
/// with the smaller α.
///
/// # Reference
/// Uplift: Housner (1963). p·PGV/(g tan α) as the measure of overturning: Dimitrakopoulos and
/// Paraskeva (2015), "Dimensionless fragility curves for rocking response to near-fault
/// excitations", EESD 44.
///
/// # Limitation
/// The crossings are exact for a motion that is linear between samples. PGV is that of
/// [`measures`], without baseline correction.
///
/// # Example
/// ```
/// use freestand::{block::Block, measures::rocking_measures, motion::Motion};
/// let motion = Motion::new(1.0, vec![0.0, 5.0, 0.0])?;
/// let m = rocking_measures(&motion, &Block::uniform(2.0, 0.5)?, 10.0);
/// assert_eq!((m.uplift_threshold_m_s2, m.pga_ratio), (2.5, 2.0));
/// assert_eq!((m.time_above_s, m.excursions), (1.0, 1));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn rocking_measures(motion: &Motion, block: &Block, gravity_m_s2: f64) -> RockingMeasures {
    let (left, right) = (block.pivot(), block.right_pivot());
    let edge = if left.slenderness_angle_rad <= right.slenderness_angle_rad {
        left
    } else {
        right
    };
    // Not tan(atan(x/z)), which would lose the last bits.
    let tan_alpha = block.cg_from_left_m().min(block.cg_from_right_m()) / block.cg_height_m();
    let threshold = gravity_m_s2 * tan_alpha;
    let above = excursions(motion, threshold);
    let all = measures(motion);
    RockingMeasures {
        uplift_threshold_m_s2: threshold,
        pga_ratio: all.pga_m_s2 / threshold,
        pgv_ratio: edge.frequency_parameter_rad_s(gravity_m_s2) * all.pgv_m_s / threshold,
        // Added to 0, because an empty sum is -0.
        time_above_s: above
            .iter()
            .fold(0.0, |sum, one| sum + (one.to_s - one.from_s)),
        excursions: above.len(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_block_under_a_triangle_has_measures_by_hand() {
        // h = 4, t = 3: R = 2.5, tan α = 3/4, p = √(3g/4R) = √3 for g = 10. Triangle of ±9 m/s²,
        // 1 s a side.
        let block = Block::uniform(4.0, 3.0).unwrap();
        let motion = Motion::new(1.0, vec![0.0, 9.0, 0.0, -9.0, 0.0]).unwrap();
        let m = rocking_measures(&motion, &block, 10.0);
        let near =
            |value: f64, want: f64| assert!((value / want - 1.0).abs() < 1e-14, "{value} {want}");
        near(m.uplift_threshold_m_s2, 7.5);
        near(m.pga_ratio, 1.2);
        // PGV = 9 m/s after the first triangle.
        near(m.pgv_ratio, 3.0f64.sqrt() * 9.0 / 7.5);
        // Each peak is above the threshold for 2·(9 − 7.5)/9 s.
        near(m.time_above_s, 2.0 / 3.0);
        assert_eq!(m.excursions, 2);
    }

    #[test]
    fn an_offset_takes_the_weaker_edge() {
        let block = Block::uniform(4.0, 3.0)
            .unwrap()
            .with_cg_offset(0.5)
            .unwrap();
        let motion = Motion::new(1.0, vec![0.0, 6.0, 0.0]).unwrap();
        let m = rocking_measures(&motion, &block, 10.0);
        // One metre from the nearer edge, two metres high.
        assert_eq!((m.uplift_threshold_m_s2, m.excursions), (5.0, 1));
        assert_eq!(m, rocking_measures(&motion, &block.mirrored(), 10.0));
    }
}
