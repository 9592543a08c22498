//! What rests on what: measured restitutions over Housner's.

use super::Confidence;

/// The restitution of a pair of materials over Housner's ratio.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RestitutionFactor {
    /// What the object stands on.
    pub material: &'static str,
    /// Height over thickness of the blocks that were tested.
    pub slenderness_ratio: f64,
    /// Measured over Housner's: a `restitution_factor`.
    pub factor_ratio: f64,
    /// Where it comes from.
    pub source: &'static str,
    /// How sure.
    pub confidence: Confidence,
}

const ELGAWADY: &str = "ElGawady, Butterworth and Ingham, free rocking of blocks: an excerpt, without a page";

/// Measured restitutions over Housner's; the order of materials, rubber the lowest, then steel, timber, concrete, is theirs too.
pub const RESTITUTION_FACTORS: [RestitutionFactor; 3] = [
    RestitutionFactor {
        material: "concrete",
        slenderness_ratio: 5.0,
        factor_ratio: 0.95,
        source: ELGAWADY,
        confidence: Confidence::Recalled,
    },
    RestitutionFactor {
        material: "concrete",
        slenderness_ratio: 3.0,
        factor_ratio: 0.97,
        source: ELGAWADY,
        confidence: Confidence::Recalled,
    },
    RestitutionFactor {
        material: "rubber",
        slenderness_ratio: 5.0,
        factor_ratio: 0.67,
        source: ELGAWADY,
        confidence: Confidence::Recalled,
    },
];

/// The factor of a material, of the blocks whose slenderness is nearest; `None` for a material that is not there.
///
/// # Example
/// ```
/// use freestand_study::library::restitution_factor;
/// assert_eq!(restitution_factor("Rubber", 4.0).map(|found| found.factor_ratio), Some(0.67));
/// assert_eq!(restitution_factor("concrete", 2.5).map(|found| found.factor_ratio), Some(0.97));
/// assert!(restitution_factor("ice", 4.0).is_none());
/// ```
pub fn restitution_factor(material: &str, slenderness_ratio: f64) -> Option<&'static RestitutionFactor> {
    let away = |one: &RestitutionFactor| (one.slenderness_ratio - slenderness_ratio).abs();
    RESTITUTION_FACTORS
        .iter()
        .filter(|one| one.material.eq_ignore_ascii_case(material.trim()))
        .min_by(|a, b| away(a).total_cmp(&away(b)))
}
