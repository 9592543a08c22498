//! Corners of code spectra by hand, printed values, and accelerations of parts on floors.

use std::f64::consts::TAU;

use freestand::G0_M_S2;
use freestand::code_spectrum::part_forces::{
    As1170_4Part, Asce7_16Part, Asce7_22Part, Eurocode8Part, Nzs1170_5Part, as1170_4_force,
    asce7_16_force, asce7_22_force, eurocode8_force, nzs1170_5_force,
};
use freestand::code_spectrum::parts::{PartsQuestion, floor_acceleration_g};
use freestand::code_spectrum::{
    As1170_4, Asce7, Asce7Edition, CodeSpectrum, Edition, Eurocode8, FrameKind, GroundType,
    Nzs1170_5, SiteClass, SpectrumType, SubsoilClass, fundamental_period_s,
};

use super::{Check, check, defect};
use freestand_input::problem::Problem;

/// Rounding of a few products of numbers of order one.
const ROUNDING: f64 = 1e-12;

pub(super) fn checks() -> Result<Vec<Check>, Problem> {
    Ok([australia()?, others()?, floors()?, forces()].concat())
}

/// Forces of parts on a roof, over their weight.
fn forces() -> Vec<Check> {
    const BY_HAND: &str = "by hand";
    let australia = As1170_4Part {
        amplification_ratio: 1.0,
        ductility_ratio: 2.5,
        importance_ratio: 1.5,
    };
    let america_16 = Asce7_16Part {
        amplification_ratio: 1.0,
        response_ratio: 2.5,
        importance_ratio: 1.5,
    };
    let america_22 = Asce7_22Part {
        resonance_ratio: 1.0,
        strength_ratio: 1.5,
        building_ductility_ratio: 1.3,
        importance_ratio: 1.0,
        is_at_grade: false,
    };
    let europe = Eurocode8Part {
        period_ratio: 0.0,
        amplification_ratio: 1.0,
        importance_ratio: 1.5,
        behaviour_ratio: 2.0,
    };
    let new_zealand = Nzs1170_5Part {
        spectral_ratio: 2.0,
        response_ratio: 1.0,
        risk_ratio: 1.0,
    };
    [
        (
            "AS 1170.4, 0.264 × 1.5/2.5",
            as1170_4_force(0.264, &australia).force_ratio,
            0.1584,
        ),
        (
            "ASCE 7-16, 0.4 × 1 × 3 × 1.5/2.5",
            asce7_16_force(1.0, 3.0, &america_16).force_ratio,
            0.72,
        ),
        (
            "ASCE 7-22, 0.4 × 1 × 3.5/1.3/1.5",
            asce7_22_force(1.0, 3.5, &america_22).force_ratio,
            1.4 / 1.95,
        ),
        (
            "EN 1998-1, 0.24 × 2.5 × 1.5/2",
            eurocode8_force(0.24, 1.0, &europe).force_ratio,
            0.45,
        ),
        (
            "NZS 1170.5, 0.532 × 3 × 2",
            nzs1170_5_force(3.0 * 0.532, &new_zealand).force_ratio,
            3.192,
        ),
        (
            "NZS 1170.5, at most 3.6",
            nzs1170_5_force(3.0 * 0.7, &new_zealand).force_ratio,
            3.6,
        ),
    ]
    .map(|(name, computed, expected)| {
        check(
            format!("force of a part, {name}"),
            computed,
            expected,
            ROUNDING,
            BY_HAND,
        )
    })
    .to_vec()
}

fn melbourne() -> Result<As1170_4, Problem> {
    As1170_4::new(Edition::default(), SiteClass::De, 0.08, 500).map_err(defect)
}

fn europe(kind: SpectrumType, ground: GroundType) -> Result<Eurocode8, Problem> {
    Eurocode8::new(kind, ground, 0.2, 1.0).map_err(defect)
}

fn america() -> Result<Asce7, Problem> {
    Asce7::new(Asce7Edition::Asce7_22, 1.0, 0.6, 8.0).map_err(defect)
}

fn new_zealand() -> Result<Nzs1170_5, Problem> {
    Nzs1170_5::new(SubsoilClass::C, 0.4, 500, None).map_err(defect)
}

/// Spectral accelerations \[g\] of a code at some periods \[s\].
fn accelerations<const N: usize>(
    name: &'static str,
    code: &CodeSpectrum,
    values: [(f64, f64); N],
    reference: &'static str,
) -> impl Iterator<Item = Check> {
    values.into_iter().map(move |(t, sa_g)| {
        let name = format!("{name}, Sa({t} s) [g]");
        check(name, code.sa_g(t), sa_g, ROUNDING, reference)
    })
}

fn australia() -> Result<Vec<Check>, Problem> {
    const CODE: &str =
        "AS 1170.4-2007, Table 6.4 formulas: kpZ Ch(T), Melbourne, site De, 500 years";
    let spectrum = melbourne()?;
    let values = [
        (0.0, 0.088),
        (0.3, 0.2944),
        (1.0, 0.1584),
        (1.5, 0.1056),
        (2.0, 0.0594),
    ];
    let mut checks: Vec<Check> =
        accelerations("code spectrum", &spectrum.into(), values, CODE).collect();
    let sd_mm = 1e3 * G0_M_S2 * spectrum.sa_g(4.0) * (4.0 / TAU).powi(2);
    checks.push(check(
        "code spectrum, Sd beyond 1.5 s [mm]",
        sd_mm,
        59.0,
        0.05,
        CODE,
    ));
    const PERIOD: &str = "AS 1170.4-2007, clause 6.2.3: 1.25 kt h^0.75";
    for (frame, kt, expected) in [
        (FrameKind::MomentSteel, 0.11, 4.22),
        (FrameKind::MomentConcrete, 0.075, 2.88),
        (FrameKind::EccentricallyBracedSteel, 0.06, 2.30),
        (FrameKind::Other, 0.05, 1.92),
    ] {
        let t1 = fundamental_period_s(frame, 96.0).map_err(defect)?;
        checks.push(check(
            format!("period of a tower of 96 m, kt = {kt} [s]"),
            t1,
            expected,
            5e-3,
            PERIOD,
        ));
    }
    Ok(checks)
}

fn others() -> Result<Vec<Check>, Problem> {
    const EC8: &str = "EN 1998-1:2004, Eqs. (3.2)-(3.5), Tables 3.2 and 3.3, a_g = 0.2 g, by hand";
    const ASCE: &str = "ASCE 7, 11.4: SDS = 1 g, SD1 = 0.6 g, TL = 8 s, by hand";
    const NZS: &str = "NZS 1170.5:2004, Table 3.1 as printed, times Z R = 0.4";
    let first = europe(SpectrumType::Type1, GroundType::B)?;
    let second = europe(SpectrumType::Type2, GroundType::D)?;
    let (america, new_zealand) = (america()?, new_zealand()?);
    let values = [
        (0.0, 0.24),
        (0.15, 0.6),
        (0.5, 0.6),
        (1.0, 0.3),
        (2.0, 0.15),
        (4.0, 0.0375),
    ];
    let mut checks: Vec<Check> =
        accelerations("Eurocode 8, type 1, ground B", &first.into(), values, EC8).collect();
    let values = [
        (0.0, 0.36),
        (0.1, 0.9),
        (0.3, 0.9),
        (1.2, 0.225),
        (2.4, 0.056_25),
    ];
    let name = "Eurocode 8, type 2, ground D";
    checks.extend(accelerations(name, &second.into(), values, EC8));
    let values = [
        (0.0, 0.4),
        (0.12, 1.0),
        (0.6, 1.0),
        (2.0, 0.3),
        (8.0, 0.075),
        (16.0, 0.01875),
    ];
    checks.extend(accelerations("ASCE 7", &america.into(), values, ASCE));
    for (t, ch) in [
        (0.0, 1.33),
        (0.3, 2.93),
        (0.7, 1.55),
        (1.5, 0.88),
        (3.0, 0.44),
        (4.5, 0.20),
    ] {
        let name = format!("NZS 1170.5, site C, Sa({t} s) [g]");
        checks.push(check(name, new_zealand.sa_g(t), 0.4 * ch, 0.4 * 0.005, NZS));
    }
    Ok(checks)
}

/// A rigid part on the roof of a building of 96 m.
fn floors() -> Result<Vec<Check>, Problem> {
    const PARTS: &str = "parts and components of each code, by hand";
    let roof = PartsQuestion {
        level_ratio: 1.0,
        building_height_m: Some(96.0),
        building_period_s: None,
    };
    let codes: [(&str, CodeSpectrum, f64); 4] = [
        ("AS 1170.4", melbourne()?.into(), 3.0 * 0.088),
        (
            "Eurocode 8",
            europe(SpectrumType::Type1, GroundType::B)?.into(),
            2.5 * 0.24,
        ),
        ("ASCE 7-22", america()?.into(), 3.5 * 0.4),
        ("NZS 1170.5", new_zealand()?.into(), 3.0 * 0.532),
    ];
    let mut checks = Vec::new();
    for (name, code, expected) in codes {
        let accel_g =
            floor_acceleration_g(&code, &roof).ok_or_else(|| defect("a code without parts"))?;
        checks.push(check(
            format!("{name}, a rigid part on the roof [g]"),
            accel_g,
            expected,
            ROUNDING,
            PARTS,
        ));
    }
    Ok(checks)
}
