//! Cushion curves of packaging: from drops on a foam (ASTM D1596) to one stress–energy curve, and
//! from it to the thickness and the load that keep a shock below a limit.

use std::path::Path;

use freestand::G0_M_S2;
use freestand::cushion::{CurveError, CushionTest, StressEnergy, StressEnergyFit};

use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::quantity::{Dimension, format_si};
use freestand_output::{answer, answer_of};
use freestand_records::tables::load_curve;
use strum::EnumCount;

/// A design; `None` where a value is not given.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CurveRequest {
    /// Drop height of the design, and of tests that do not state theirs \[m\].
    pub drop_height_m: Option<f64>,
    /// Thickness of the design, and of tests that do not state theirs \[m\].
    pub thickness_m: Option<f64>,
    /// Static stress of the design, mg/A \[Pa\].
    pub static_stress_pa: Option<f64>,
    /// Peak acceleration that must not be exceeded \[m/s²\].
    pub limit_m_s2: Option<f64>,
}

/// The fitted curve, and what follows from it for the design.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveReport {
    fit: StressEnergyFit,
    tests: Vec<CurveTest>,
    request: CurveRequest,
    /// At the static stress with the least peak.
    best: Option<Design>,
    /// At the given static stress.
    given: Option<Design>,
    /// At the given static stress, with the peak of the limit.
    needed: Option<Design>,
    /// The thinnest that keeps the limit.
    optimum: Option<Design>,
    /// What is doubtful.
    pub doubts: Vec<CurveDoubt>,
}

/// Something doubtful about a cushion curve or its design.
#[derive(Debug, Clone, Copy, PartialEq, EnumCount)]
pub enum CurveDoubt {
    /// A part of the design needs the curve where no test is.
    Extrapolated {
        /// Which part.
        part: CurvePart,
        /// The energy at which it needs the curve \[J/m³\].
        energy_j_m3: f64,
        /// What the tests cover \[J/m³\].
        tested_j_m3: (f64, f64),
    },
    /// No thickness keeps the limit at the given static stress.
    TooLight,
    /// The tests scatter about the curve: R².
    Scatter(f64),
    /// A drop height that no test and no design needs.
    DropHeightUnused,
    /// A thickness that no test and no design needs.
    ThicknessUnused,
}

/// A part of a design that is read off the curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CurvePart {
    /// The best static stress.
    BestStress,
    /// The peak at the given static stress.
    Peak,
    /// The thickness at the given static stress.
    Thickness,
    /// The least thickness.
    Optimum,
}

/// A cushion under a load that falls on it.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Design {
    static_stress_pa: f64,
    drop_height_m: f64,
    thickness_m: f64,
}

answer! {
    /// A test, and the curve at it.
    pub struct CurveTest {
        /// mg/A.
        static_stress_pa: f64,
        /// Of the fall.
        drop_height_m: f64,
        /// Of the cushion.
        thickness_m: f64,
        /// Of the fall, in the volume of the cushion.
        energy_j_m3: f64,
        /// The measured peak.
        peak_acceleration_g: f64,
        /// The peak by the curve.
        curve_g: f64,
    }
}

answer_of!(CurveReport as report {
    stress_pa: f64 = report.fit.curve.stress_pa => "dynamic stress at zero energy";
    exponent_m3_j: f64 = report.fit.curve.exponent_m3_j => "  exponent per energy";
    r_squared_ratio: f64 = report.fit.r_squared_ratio => "  R²";
    tested_energies_j_m3: [f64; 2] = report.fit.energies_j_m3.into() => "  energies of the tests";
    tests: Vec<CurveTest>;
    best_static_stress_pa: Option<f64> =
        report.best.map(|best| best.static_stress_pa) => "best static stress";
    best_peak_acceleration_g: Option<f64> = report.peak_g(report.best) => "  peak";
    __: Option<String> = report.request.static_stress_pa.map(|stress| format_si(stress, Dimension::Pressure))
        => "given static stress";
    /// At the given static stress.
    peak_acceleration_g: Option<f64> = report.peak_g(report.given) => "  peak";
    __: Option<String> = report.request.limit_m_s2.map(|limit| format_si(limit, Dimension::Acceleration))
        => "given limit";
    /// That keeps the limit at the given static stress.
    thickness_m: Option<f64> = report.needed.map(|needed| needed.thickness_m)
        => "  thickness at the given static stress";
    /// The least that keeps the limit.
    optimum_thickness_m: Option<f64> =
        report.optimum.map(|optimum| optimum.thickness_m) => "  least thickness";
    optimum_static_stress_pa: Option<f64> = report.optimum.map(|optimum| optimum.static_stress_pa)
        => "  static stress of the least thickness";
});

/// Reads the tests of a cushion and fits its curve.
///
/// # Errors
/// A file without such tests, tests without a drop height or a thickness, or tests that no curve
/// can be fitted to.
pub fn cushion_curve(path: &Path, request: &CurveRequest) -> Result<CurveReport, Problem> {
    let mut tests = Vec::new();
    let (mut takes_height, mut takes_thickness) = (false, false);
    for row in load_curve(path)? {
        takes_height |= row.drop_height_m.is_none();
        takes_thickness |= row.thickness_m.is_none();
        let stated = |value: Option<f64>, asked: Option<f64>, what: &str, key: &str| {
            value.or(asked).ok_or_else(|| {
                let problem = Problem::new(
                    ProblemKind::Value,
                    format!("the {what} of the tests is not given"),
                );
                problem
                    .in_file(path)
                    .hint(format!("give `{key}`, or add a column with it"))
            })
        };
        let drop_height_m = stated(
            row.drop_height_m,
            request.drop_height_m,
            "drop height",
            "drop_height",
        )?;
        let thickness_m = stated(
            row.thickness_m,
            request.thickness_m,
            "thickness",
            "thickness",
        )?;
        let test = CushionTest {
            static_stress_pa: row.static_stress_pa,
            drop_height_m,
            thickness_m,
            peak_acceleration_g: row.peak_acceleration_m_s2 / G0_M_S2,
        };
        if !test.is_positive() {
            let problem = Problem::new(
                ProblemKind::Value,
                "stress, height, thickness and peak must be positive",
            );
            return Err(problem
                .at_line(row.line)
                .in_file(path)
                .hint("correct the row, or make it a comment with #"));
        }
        tests.push(test);
    }
    let fit = StressEnergy::fitted(&tests).map_err(|error| {
        let hint = match error {
            CurveError::TooFew { .. } => "test at several static stresses",
            CurveError::OneEnergy => "vary the static stress, the drop height or the thickness",
            _ => "check the columns and their units",
        };
        Problem::new(ProblemKind::Value, error.to_string())
            .in_file(path)
            .hint(hint)
    })?;
    let mut report = report(fit, &tests, *request);
    let (height, thickness) = (request.drop_height_m, request.thickness_m);
    if height.is_some() && !takes_height && thickness.or(request.limit_m_s2).is_none() {
        report.doubts.push(CurveDoubt::DropHeightUnused);
    }
    if thickness.is_some() && !takes_thickness && height.is_none() {
        report.doubts.push(CurveDoubt::ThicknessUnused);
    }
    Ok(report)
}

impl CurveReport {
    fn peak_g(&self, design: Option<Design>) -> Option<f64> {
        let curve = self.fit.curve;
        design.map(|of| {
            curve.peak_acceleration_g(of.static_stress_pa, of.drop_height_m, of.thickness_m)
        })
    }
}

fn report(fit: StressEnergyFit, tests: &[CushionTest], request: CurveRequest) -> CurveReport {
    let curve = fit.curve;
    let (least, most) = fit.energies_j_m3;
    let within = |part, design: Option<Design>| {
        let of = design?;
        let energy_j_m3 = of.static_stress_pa * of.drop_height_m / of.thickness_m;
        (!(least * 0.999..=most * 1.001).contains(&energy_j_m3)).then_some(
            CurveDoubt::Extrapolated {
                part,
                energy_j_m3,
                tested_j_m3: (least, most),
            },
        )
    };
    let design = |static_stress_pa, drop_height_m, thickness_m| Design {
        static_stress_pa,
        drop_height_m,
        thickness_m,
    };
    let (height, thickness, stress) = (
        request.drop_height_m,
        request.thickness_m,
        request.static_stress_pa,
    );
    let limit_g = request.limit_m_s2.map(|limit| limit / G0_M_S2);
    let best = height
        .zip(thickness)
        .map(|(h, t)| design(curve.best_static_stress_pa(h, t), h, t));
    let given = height
        .zip(thickness)
        .zip(stress)
        .map(|((h, t), s)| design(s, h, t));
    let asked = height.zip(stress).zip(limit_g);
    let needed =
        asked.and_then(|((h, s), limit)| Some(design(s, h, curve.thickness_m(s, h, limit)?)));
    let optimum = height.zip(limit_g).map(|(h, limit)| {
        let t = curve.optimum_thickness_m(h, limit);
        design(curve.best_static_stress_pa(h, t), h, t)
    });
    let too_light = asked.is_some() && needed.is_none();
    let scatter = fit.r_squared_ratio < 0.9;
    let doubts = [
        within(CurvePart::BestStress, best),
        within(CurvePart::Peak, given),
        within(CurvePart::Thickness, needed),
        too_light.then_some(CurveDoubt::TooLight),
        within(CurvePart::Optimum, optimum),
        scatter.then_some(CurveDoubt::Scatter(fit.r_squared_ratio)),
    ];
    let test = |test: &CushionTest| CurveTest {
        static_stress_pa: test.static_stress_pa,
        drop_height_m: test.drop_height_m,
        thickness_m: test.thickness_m,
        energy_j_m3: test.energy_j_m3(),
        peak_acceleration_g: test.peak_acceleration_g,
        curve_g: curve.peak_acceleration_g(
            test.static_stress_pa,
            test.drop_height_m,
            test.thickness_m,
        ),
    };
    CurveReport {
        tests: tests.iter().map(test).collect(),
        fit,
        request,
        best,
        given,
        needed,
        optimum,
        doubts: doubts.into_iter().flatten().collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// a = 100 kPa, b = 2e-5 m³/J: from 100 mm the least peak on 20 mm is 27.1828 g at 10 kPa,
    /// which makes 20 mm the optimum for that limit.
    #[test]
    fn the_optimum_of_a_known_curve() {
        let foam = StressEnergy {
            stress_pa: 1e5,
            exponent_m3_j: 2e-5,
        };
        let path = std::env::temp_dir().join(format!("freestand-curve-{}.csv", std::process::id()));
        let mut text = "static stress [kPa],peak acceleration [g]\n".to_owned();
        for s in [4.0, 8.0, 12.0, 16.0] {
            text += &format!("{s},{}\n", foam.peak_acceleration_g(1e3 * s, 0.1, 0.02));
        }
        std::fs::write(&path, text).unwrap();
        let mut request = CurveRequest {
            drop_height_m: Some(0.1),
            ..CurveRequest::default()
        };
        assert!(
            cushion_curve(&path, &request)
                .unwrap_err()
                .message
                .contains("thickness")
        );
        request.thickness_m = Some(0.02);
        request.limit_m_s2 = Some(27.1828 * G0_M_S2);
        request.static_stress_pa = Some(30e3);
        let report = cushion_curve(&path, &request).unwrap();
        std::fs::remove_file(&path).unwrap();
        std::fs::write(
            &path,
            "static stress [kPa],drop height [mm],thickness [mm],peak acceleration [g]\n4,600,50,60\n6,600,50,50\n\
             10,600,50,44\n",
        )
        .unwrap();
        for (doubt, drop_height_m, thickness_m) in [
            (CurveDoubt::DropHeightUnused, Some(0.6), None),
            (CurveDoubt::ThicknessUnused, None, Some(0.05)),
        ] {
            let request = CurveRequest {
                drop_height_m,
                thickness_m,
                ..CurveRequest::default()
            };
            let doubts = cushion_curve(&path, &request).unwrap().doubts;
            assert!(doubts.contains(&doubt), "{doubts:?}");
        }
        std::fs::remove_file(&path).unwrap();
        let best = report.best.unwrap();
        assert!((best.static_stress_pa / 10e3 - 1.0).abs() < 1e-9);
        assert!((report.peak_g(report.best).unwrap() - 27.1828).abs() < 1e-4);
        // Four decimals of the limit are known.
        assert!((report.optimum.unwrap().thickness_m / 0.02 - 1.0).abs() < 1e-5);
        // 30 kPa asks for 1.5 times the energy of the hardest test.
        let is_peak = |doubt: &CurveDoubt| {
            matches!(
                doubt,
                CurveDoubt::Extrapolated {
                    part: CurvePart::Peak,
                    ..
                }
            )
        };
        assert!(report.doubts.iter().any(is_peak), "{:?}", report.doubts);
    }
}
