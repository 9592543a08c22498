//! Cushion curves of packaging: from drops on a foam (ASTM D1596) to one stress–energy curve, and from it to the thickness
//! and the load that keep a shock below a limit.

use std::cell::RefCell;
use std::path::Path;

use freestand::G0_M_S2;
use freestand::cushion::{CurveError, StressEnergy, StressEnergyFit};
use serde::Serialize;

use freestand_input::problem::{Problem, ProblemKind};
use freestand_records::tables::load_curve;

/// What is asked; `None` where nobody says.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CurveRequest {
    /// Drop height, of the tests that do not state theirs and of the design \[m\].
    pub drop_height_m: Option<f64>,
    /// Thickness, of the tests that do not state theirs and of the design \[m\].
    pub thickness_m: Option<f64>,
    /// Static stress of the design, mg/A \[Pa\].
    pub static_stress_pa: Option<f64>,
    /// Peak acceleration that must not be exceeded \[m/s²\].
    pub limit_m_s2: Option<f64>,
}

/// One test beside the curve.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[expect(missing_docs, reason = "the names are the documentation: SI units as they say")]
pub struct CurvePoint {
    pub static_stress_pa: f64,
    pub drop_height_m: f64,
    pub thickness_m: f64,
    pub energy_j_m3: f64,
    pub peak_acceleration_g: f64,
    pub curve_g: f64,
}

/// The curve and what follows from it: the keys of `freestand cushion curve --json`.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[expect(missing_docs, reason = "the names are the documentation: SI units as they say")]
pub struct CurveReport {
    pub stress_pa: f64,
    pub exponent_m3_j: f64,
    pub r_squared_ratio: f64,
    pub tested_energies_j_m3: [f64; 2],
    pub tests: Vec<CurvePoint>,
    /// Static stress of the least peak at the drop height and thickness asked for, and that peak.
    pub best_static_stress_pa: Option<f64>,
    pub best_peak_acceleration_g: Option<f64>,
    /// Peak at the drop height, thickness and static stress asked for.
    pub peak_acceleration_g: Option<f64>,
    /// Thickness for the limit at the static stress asked for.
    pub thickness_m: Option<f64>,
    /// The least thickness for the limit, and the static stress that it takes.
    pub optimum_thickness_m: Option<f64>,
    pub optimum_static_stress_pa: Option<f64>,
    #[serde(skip)]
    pub warnings: Vec<String>,
}

/// Reads the tests of a cushion and answers with its curve.
///
/// # Errors
/// A file without such tests, tests that do not say from where they were dropped or on how much, or that give no curve.
pub fn cushion_curve(path: &Path, request: &CurveRequest) -> Result<CurveReport, Problem> {
    let mut tests = Vec::new();
    for row in load_curve(path)? {
        let stated = |value: Option<f64>, asked: Option<f64>, what: &str, flag: &str| {
            value.or(asked).ok_or_else(|| {
                let problem = Problem::new(ProblemKind::Value, format!("the {what} of the tests is not known"));
                problem.in_file(path).hint(format!("give it as {flag}, or as a column"))
            })
        };
        let drop_height_m = stated(row.drop_height_m, request.drop_height_m, "drop height", "--drop-height")?;
        let thickness_m = stated(row.thickness_m, request.thickness_m, "thickness", "--thickness")?;
        let sizes = [row.static_stress_pa, drop_height_m, thickness_m, row.peak_acceleration_m_s2];
        if sizes.iter().any(|&size| !(size > 0.0 && size.is_finite())) {
            let problem = Problem::new(ProblemKind::Value, "stress, height, thickness and peak must be positive");
            return Err(problem.at_line(row.line).in_file(path).hint("correct the row, or make it a comment with #"));
        }
        tests.push((row.static_stress_pa, drop_height_m, thickness_m, row.peak_acceleration_m_s2 / G0_M_S2));
    }
    let fit = StressEnergy::fitted(&tests).map_err(|error| {
        let hint = match error {
            CurveError::TooFew { .. } => "test at several static stresses",
            CurveError::OneEnergy => "vary the static stress, the drop height or the thickness",
            _ => "check the columns and their units",
        };
        Problem::new(ProblemKind::Value, error.to_string()).in_file(path).hint(hint)
    })?;
    Ok(report(&fit, &tests, request))
}

fn report(fit: &StressEnergyFit, tests: &[(f64, f64, f64, f64)], request: &CurveRequest) -> CurveReport {
    let curve = fit.curve;
    let (least, most) = fit.energies_j_m3;
    let warnings = RefCell::new(Vec::new());
    let warn = |words: String| warnings.borrow_mut().push(words);
    let within = |what: &str, stress_pa: f64, height_m: f64, thickness_m: f64| {
        let energy = stress_pa * height_m / thickness_m;
        if !(least * 0.999..=most * 1.001).contains(&energy) {
            warn(format!(
                "{what} asks the curve for {energy:.4e} J/m³, the tests reach from {least:.4e} to {most:.4e}: it is a guess"
            ));
        }
    };
    let (height, thickness, stress) = (request.drop_height_m, request.thickness_m, request.static_stress_pa);
    let limit_g = request.limit_m_s2.map(|limit| limit / G0_M_S2);
    let best = height.zip(thickness).map(|(h, t)| (curve.best_static_stress_pa(h, t), h, t));
    if let Some((s, h, t)) = best {
        within("the best static stress", s, h, t);
    }
    let asked = height.zip(thickness).zip(stress);
    if let Some(((h, t), s)) = asked {
        within("the peak", s, h, t);
    }
    let needed = height.zip(stress).zip(limit_g).map(|((h, s), limit)| (curve.thickness_m(s, h, limit), s, h));
    match needed {
        Some((Some(t), s, h)) => within("the thickness", s, h, t),
        Some((None, ..)) => warn(
            "no thickness keeps the limit at this static stress: the load is too light for this cushion; give it less area"
                .to_owned(),
        ),
        None => {}
    }
    let optimum = height.zip(limit_g).map(|(h, limit)| {
        let t = curve.optimum_thickness_m(h, limit);
        (t, curve.best_static_stress_pa(h, t), h)
    });
    if let Some((t, s, h)) = optimum {
        within("the optimum thickness", s, h, t);
    }
    if fit.r_squared_ratio < 0.9 {
        warn(format!(
            "the tests scatter about one stress-energy curve (R² = {:.3}): heights and thicknesses may not reduce to it",
            fit.r_squared_ratio
        ));
    }
    CurveReport {
        stress_pa: curve.stress_pa,
        exponent_m3_j: curve.exponent_m3_j,
        r_squared_ratio: fit.r_squared_ratio,
        tested_energies_j_m3: [least, most],
        tests: tests
            .iter()
            .map(|&(s, h, t, g)| CurvePoint {
                static_stress_pa: s,
                drop_height_m: h,
                thickness_m: t,
                energy_j_m3: s * h / t,
                peak_acceleration_g: g,
                curve_g: curve.peak_acceleration_g(s, h, t),
            })
            .collect(),
        best_static_stress_pa: best.map(|(s, ..)| s),
        best_peak_acceleration_g: best.map(|(s, h, t)| curve.peak_acceleration_g(s, h, t)),
        peak_acceleration_g: asked.map(|((h, t), s)| curve.peak_acceleration_g(s, h, t)),
        thickness_m: needed.and_then(|(t, ..)| t),
        optimum_thickness_m: optimum.map(|(t, ..)| t),
        optimum_static_stress_pa: optimum.map(|(_, s, _)| s),
        warnings: warnings.into_inner(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// a = 100 kPa, b = 2e-5 m³/J: from 100 mm the least peak on 20 mm is 27.1828 g at 10 kPa, which makes 20 mm the
    /// optimum for that limit.
    #[test]
    fn the_optimum_of_a_known_curve() {
        let foam = StressEnergy { stress_pa: 1e5, exponent_m3_j: 2e-5 };
        let path = std::env::temp_dir().join(format!("freestand-curve-{}.csv", std::process::id()));
        let mut text = "static stress [kPa],peak acceleration [g]\n".to_owned();
        for s in [4.0, 8.0, 12.0, 16.0] {
            text += &format!("{s},{}\n", foam.peak_acceleration_g(1e3 * s, 0.1, 0.02));
        }
        std::fs::write(&path, text).unwrap();
        let mut request = CurveRequest { drop_height_m: Some(0.1), ..CurveRequest::default() };
        assert!(cushion_curve(&path, &request).unwrap_err().message.contains("thickness"));
        request.thickness_m = Some(0.02);
        request.limit_m_s2 = Some(27.1828 * G0_M_S2);
        request.static_stress_pa = Some(30e3);
        let report = cushion_curve(&path, &request).unwrap();
        std::fs::remove_file(&path).unwrap();
        assert!((report.best_static_stress_pa.unwrap() / 10e3 - 1.0).abs() < 1e-9);
        assert!((report.best_peak_acceleration_g.unwrap() - 27.1828).abs() < 1e-4);
        // Four decimals of the limit are known.
        assert!((report.optimum_thickness_m.unwrap() / 0.02 - 1.0).abs() < 1e-5);
        // 30 kPa asks for 1.5 times the energy of the hardest test.
        assert!(report.warnings.iter().any(|warning| warning.starts_with("the peak asks")), "{:?}", report.warnings);
    }
}
