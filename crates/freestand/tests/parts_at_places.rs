//! Forces of restraints at two places for each code, by hand from the values of its tables.

#![allow(clippy::unwrap_used, reason = "a test may stop at what it needs")]

use freestand::code_spectrum::part_forces::{
    Eurocode8Part, Nzs1170_5Part, Tbdy2018Part, Ts1170_5Part, eurocode8_force, nzs1170_5_force,
    tbdy2018_force, ts1170_5_force,
};
use freestand::code_spectrum::{
    CodeSpectrum, GroundType, Ntc2018, NtcHazard, Nzs1170_5, SubsoilClass, Tbdy2018, TbdySite,
    Topography,
};

/// Half a unit of the last digit of the numbers by hand.
fn near(got: f64, expected: f64) {
    assert!((got - expected).abs() < 5e-5, "{got} {expected}");
}

/// NTC 2018, 7.2.3: F/W = S_a γ/q, S_a = a_g S (3 (1 + z/H)/(1 + (1 − T_a/T_1)²) − 0.5), at least a_g S; rigid part, q = 2.
/// L'Aquila, ground B: a_g = 0.2607 g, F_0 = 2.364, S = 1.40 − 0.40 · 2.364 · 0.2607 = 1.1535, a_g S = 0.30071 g; on the ground
/// 3/2 − 0.5 = 1: 0.1504. Rome: 0.121 g, F_0 = 2.62, S = 1.40 − 0.1268 = 1.2732, at most 1.2: 0.1452 g; on the roof
/// 3 − 0.5 = 2.5: 0.1815.
#[test]
fn ntc_2018_at_two_places() {
    let ground_g = |ag_g: f64, f0_ratio: f64, tc_star_s: f64| {
        let hazard = NtcHazard {
            ag_g,
            f0_ratio,
            tc_star_s,
        };
        let code = Ntc2018::new(hazard, 475, GroundType::B, Topography::default()).unwrap();
        CodeSpectrum::from(code).sa_g(0.0)
    };
    let rigid = Eurocode8Part {
        period_ratio: 0.0,
        amplification_ratio: 1.0,
        importance_ratio: 1.0,
        behaviour_ratio: 2.0,
    };
    let laquila = ground_g(0.2607, 2.364, 0.347);
    near(laquila, 0.30071);
    near(eurocode8_force(laquila, 0.0, &rigid).force_ratio, 0.15036);
    let rome = ground_g(0.121, 2.62, 0.297);
    near(rome, 0.1452);
    near(eurocode8_force(rome, 1.0, &rigid).force_ratio, 0.1815);
}

/// TBDY 2018, 6.2: A_ie B_e/R_e, at least 0.3 S_DS I. Istanbul, ZC: S_S = 0.999 g, F_S = 1.2: S_DS = 1.1988 g; on the roof A_ie = 0.4
/// · 1.1988 · 3 = 1.43856 g, R_e = 2.5: 0.57542, above 0.35964. Ankara, ZC: S_S = 0.347 g, F_S = 1.3: 0.4511 g; on the ground 0.18044/2.5 =
/// 0.07218, raised to 0.13533.
#[test]
fn tbdy_2018_at_two_places() {
    let sds_g = |ss_g: f64, s1_g: f64| {
        Tbdy2018::new(ss_g, s1_g, TbdySite::ZC, Some(475))
            .unwrap()
            .sds_g()
    };
    let part = Tbdy2018Part {
        amplification_ratio: 1.0,
        response_ratio: 2.5,
        importance_ratio: 1.0,
    };
    let istanbul = sds_g(0.999, 0.276);
    near(istanbul, 1.1988);
    near(
        tbdy2018_force(0.4 * istanbul * 3.0, istanbul, &part).force_ratio,
        0.57542,
    );
    let ankara = sds_g(0.347, 0.121);
    near(ankara, 0.4511);
    near(
        tbdy2018_force(0.4 * ankara, ankara, &part).force_ratio,
        0.13533,
    );
}

/// NZS 1170.5, 8.5.1: C(0) C_Hi C_i C_ph R_p, at most 3.6. Wellington, C: C(0) = 1.33 · 0.4 = 0.532 g; on the roof of a high building
/// C_Hi = 3, C_i = 2, C_ph = 0.85: 2.7132. Christchurch, C: 1.33 · 0.3 = 0.399 g; on the ground C_Hi = 1, elastic: 0.798.
#[test]
fn nzs_1170_5_at_two_places() {
    let zero_g = |z: f64| {
        let code = Nzs1170_5::new(SubsoilClass::C, z, 500, None).unwrap();
        CodeSpectrum::from(code).sa_g(0.0)
    };
    let elastic = Nzs1170_5Part {
        spectral_ratio: 2.0,
        response_ratio: 1.0,
        risk_ratio: 1.0,
    };
    let ductile = Nzs1170_5Part {
        response_ratio: 0.85,
        ..elastic
    };
    near(
        nzs1170_5_force(3.0 * zero_g(0.4), &ductile).force_ratio,
        2.7132,
    );
    near(nzs1170_5_force(zero_g(0.3), &elastic).force_ratio, 0.798);
}

/// TS 1170.5, 8: PGA (C_Hi/C_str)(C_i/C_ph) R_p. Kerikeri, class III, 500 years: PGA = 0.18 g; roof C_Hi = 3.5, C_i = 4, C_ph = 2: 1.26.
/// Oban: 0.32 g; on the ground, rigid: 0.32.
#[test]
fn ts_1170_5_at_two_places() {
    let rigid = Ts1170_5Part {
        structure_ratio: 1.0,
        spectral_ratio: 1.0,
        response_ratio: 1.0,
        risk_ratio: 1.0,
    };
    let resonant = Ts1170_5Part {
        spectral_ratio: 4.0,
        response_ratio: 2.0,
        ..rigid
    };
    near(ts1170_5_force(0.18, 3.5, &resonant).force_ratio, 1.26);
    near(ts1170_5_force(0.32, 1.0, &rigid).force_ratio, 0.32);
}
