//! How a block stands on its pads, in closed form: what the linear equations of both edges give.

use std::f64::consts::TAU;

use crate::block::Block;

/// f_rock = √((k b²/2 − m g c)/(I_cg + m c²))/2π \[Hz\]: the rocking of a block with both edges on
/// their pads; `None` where it does not stand.
///
/// # Accuracy
/// For pads that do not give way sideways. With k_t = k the base sways as well, and the lowest
/// frequency is lower: by 6 % for a block twice as high as wide, by 1 % for one five times as high.
///
/// # Example
/// A rack of 2.0 m × 0.9 m and 400 kg on 1500 N/mm under each edge: 5.2 Hz.
/// ```
/// use freestand::block::Block;
/// use freestand::compliant::rocking_frequency_hz;
/// let rack = Block::uniform(2.0, 0.9)?;
/// let f_hz = rocking_frequency_hz(&rack, 400.0, 1.5e6, freestand::G0_M_S2).unwrap();
/// assert!((f_hz - 5.2235).abs() < 1e-4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn rocking_frequency_hz(
    block: &Block,
    mass_kg: f64,
    stiffness_n_m: f64,
    gravity_m_s2: f64,
) -> Option<f64> {
    let righting = righting_n_m(block, mass_kg, stiffness_n_m, gravity_m_s2);
    let inertia = mass_kg * (block.gyration_radius_m().powi(2) + block.cg_height_m().powi(2));
    let square = righting / inertia;
    (square > 0.0).then(|| square.sqrt() / TAU)
}

/// a_up = g (b/2c − m g/(k b)) \[m/s²\]: the steady acceleration of the base at which an edge lets
/// go of its pad. It is the threshold of the rigid block, less twice the static sink over b.
///
/// With the centre of gravity off the middle the edge farther from it carries less and goes first:
/// the share 2 min(b_l, b_r)/b of this. Zero where the block does not stand.
///
/// # Accuracy
/// First order in the rotation, as the screen of [`rock_compliant_many`](super::rock_compliant_many).
/// An earthquake is not steady: near f_rock less than a_up is enough.
///
/// # Example
/// A rack of 2.0 m × 0.9 m and 400 kg on 1500 N/mm: 9.80665 (0.45 − 400 · 9.80665/(1.5e6 · 0.9)) m/s².
/// ```
/// use freestand::block::Block;
/// use freestand::compliant::pad_uplift_threshold_m_s2;
/// let rack = Block::uniform(2.0, 0.9)?;
/// let up_m_s2 = pad_uplift_threshold_m_s2(&rack, 400.0, 1.5e6, freestand::G0_M_S2);
/// assert!((up_m_s2 - 4.3845).abs() < 1e-4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn pad_uplift_threshold_m_s2(
    block: &Block,
    mass_kg: f64,
    stiffness_n_m: f64,
    gravity_m_s2: f64,
) -> f64 {
    let width = block.base_width_m();
    let nearer = block.cg_from_left_m().min(block.cg_from_right_m());
    let righting = righting_n_m(block, mass_kg, stiffness_n_m, gravity_m_s2).max(0.0);
    2.0 * nearer / width * gravity_m_s2 * righting / (stiffness_n_m * width * block.cg_height_m())
}

/// k b²/2 − m g c.
fn righting_n_m(block: &Block, mass_kg: f64, stiffness_n_m: f64, gravity_m_s2: f64) -> f64 {
    let width = block.base_width_m();
    0.5 * stiffness_n_m * width * width - mass_kg * gravity_m_s2 * block.cg_height_m()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::G0_M_S2;

    /// The threshold in the words of its definition, and the limits of a rigid base and of no
    /// stability.
    #[test]
    fn the_threshold_has_its_limits() {
        let block = Block::uniform(2.0, 0.5).unwrap();
        let up = |k: f64| pad_uplift_threshold_m_s2(&block, 300.0, k, G0_M_S2);
        // Rounding of six operations.
        let stated = G0_M_S2 * (0.5 / 2.0 - 300.0 * G0_M_S2 / (2e6 * 0.5));
        assert!((up(2e6) / stated - 1.0).abs() < 1e-13);
        assert!((up(1e15) / (0.25 * G0_M_S2) - 1.0).abs() < 1e-10);
        let least = 300.0 * G0_M_S2 * 2.0 / 0.25;
        assert!(up(0.999 * least) == 0.0 && up(1.001 * least) > 0.0);
        assert_eq!(
            rocking_frequency_hz(&block, 300.0, 0.999 * least, G0_M_S2),
            None
        );
        let off = block.with_cg_offset(0.1).unwrap();
        assert!(
            (pad_uplift_threshold_m_s2(&off, 300.0, 2e6, G0_M_S2) / up(2e6) - 0.6).abs() < 1e-13
        );
    }
}
