//! Checks of the built-in library: probabilities of FEMA P-58 calculated by hand, and its medians
//! for objects that overturn compared with an empirical formula.

use freestand::block::Block;
use freestand::fragility::{kaneko_hayashi_velocity_m_s, lognormal_probability};

use crate::library::ToleranceLibrary;
use freestand_input::problem::Problem;
use freestand_study::validate::{Check, Validation, check, defect};

/// Height and depth \[in\] of the furniture whose medians of peak floor velocity FEMA P-58 gives.
pub const FURNITURE: [(&str, f64, f64); 9] = [
    ("p58-bookcase-2-shelves", 29.0, 12.625),
    ("p58-bookcase-3-shelves", 41.0, 12.625),
    ("p58-bookcase-4-shelves", 56.0, 12.625),
    ("p58-bookcase-5-shelves", 71.0, 12.625),
    ("p58-bookcase-6-shelves", 81.25, 12.625),
    ("p58-vertical-file-2-drawers", 24.0, 15.0),
    ("p58-vertical-file-4-drawers", 52.0, 15.0),
    ("p58-lateral-file-2-drawers", 52.5, 18.6),
    ("p58-lateral-file-4-drawers", 67.75, 18.6),
];

/// The checks of the models ([`freestand_study::validate::validate`]), and those of the built-in
/// library.
///
/// # Errors
/// A model that refuses one of the standard inputs: a defect.
pub fn validate() -> Result<Validation, Problem> {
    let mut validation = freestand_study::validate::validate()?;
    validation.checks.extend(checks()?);
    Ok(validation)
}

fn checks() -> Result<Vec<Check>, Problem> {
    const P_58: &str = "FEMA P-58, 2nd edition, median and beta: normal distribution of ln(demand/median)/beta, from a table";
    const KANEKO: &str = "FEMA P-58, nine medians against Kaneko and Hayashi (2000, recalled): 0.75 to 0.81 of V_R50";
    let library = ToleranceLibrary::builtin();
    let entry = |id: &str| {
        library
            .find(id)
            .ok_or_else(|| defect(format!("the library has no {id}")))
    };
    let mut checks = Vec::new();
    for (id, name, demand, expected) in [
        (
            "p58-bookcase-5-shelves",
            "bookcase of 5 shelves, PFV 0.4 m/s",
            0.4,
            0.739_94,
        ),
        (
            "p58-desktop-electronics-smooth",
            "desktop electronics, smooth, PFA 0.5 g",
            0.5,
            0.672_31,
        ),
        (
            "p58-motor-control-centre",
            "motor control centre, PFA 0.5 g",
            0.5,
            0.200_18,
        ),
    ] {
        let entry = entry(id)?;
        let median = entry.pfv_median_m_s.or(entry.pfa_median_g).zip(entry.beta);
        let (median, beta) = median.ok_or_else(|| defect(format!("{id} is not a fragility")))?;
        let p = lognormal_probability(demand, median, beta);
        // Half a unit of the last digit.
        checks.push(check(
            format!("P-58 P(failure), {name}"),
            p,
            expected,
            5.1e-6,
            P_58,
        ));
    }
    for (id, height_in, depth_in) in FURNITURE {
        let block = Block::uniform(height_in * 0.0254, depth_in * 0.0254).map_err(defect)?;
        let median = entry(id)?
            .pfv_median_m_s
            .ok_or_else(|| defect(format!("{id} has no median")))?;
        let ratio = median / kaneko_hayashi_velocity_m_s(&block);
        // From 0.75 to 0.81, both rounded to two digits.
        checks.push(check(
            format!("P-58 median over V_R50, {height_in} in × {depth_in} in"),
            ratio,
            0.78,
            0.035,
            KANEKO,
        ));
    }
    Ok(checks)
}
