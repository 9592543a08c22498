//! Closed forms of a mass that lands on a cushion. The expected numbers are those of
//! `validation/cushion/closed_forms.py`.

use freestand::G0_M_S2;
use freestand::cushion::{ContactLaw, Cushion, StressEnergy};

use super::{Check, check, defect};
use freestand_input::problem::Problem;

/// The steel plate of the pad tests \[kg\], from 100 mm.
const MASS_KG: f64 = 0.365;

const POWER: &str =
    "energy and Γ functions of a power law (Landau and Lifshitz, Mechanics, §11), at 60 digits";
const VISCOUS: &str = "free oscillation of Kelvin–Voigt until its force ends, at 60 digits";
const HUNT: &str =
    "Hunt and Crossley (1975): c(1+e) = ln((1+c)/(1−ce)), c = Λv, and its integrals at 60 digits";
const TANGENT: &str = "Mindlin (1945): F = (2k₀d_b/π)√(exp(π²Wh/(2k₀d_b²)) − 1), at 60 digits";
const STRESS: &str = "σ = a exp(bE): G = a b e h/t at s = t/(b h)";

/// Law, its name, its reference, and peak [g], compression [mm], duration [ms], restitution.
type Case = (ContactLaw, &'static str, &'static str, [f64; 4]);

fn cases() -> [Case; 5] {
    let hertz = (2e7, 1.5);
    [
        (
            ContactLaw::Linear {
                stiffness_n_m: 2.19e6,
            },
            "linear, 2190 N/mm",
            POWER,
            [349.808_441_232, 0.571_741_491_702, 1.282_549_830_16, 1.0],
        ),
        (
            ContactLaw::Power {
                coefficient_n_mn: hertz.0,
                exponent: hertz.1,
            },
            "Hertz, 2e7 N/m^1.5",
            POWER,
            [217.595_839_598, 1.148_919_025_58, 2.414_598_654_94, 1.0],
        ),
        (
            // c = 2ζ√(k m), ζ = 0.1.
            ContactLaw::KelvinVoigt {
                stiffness_n_m: 2.19e6,
                damping_n_s_m: 0.2 * (2.19e6 * MASS_KG).sqrt(),
            },
            "Kelvin–Voigt, ζ = 0.1",
            VISCOUS,
            [
                307.881_921_242,
                0.493_184_422_087,
                1.206_812_697_81,
                0.744_079_397_722,
            ],
        ),
        (
            ContactLaw::HuntCrossley {
                coefficient_n_mn: hertz.0,
                exponent: hertz.1,
                dissipation_s_m: 0.3,
            },
            "Hunt–Crossley, Λ = 0.3 s/m",
            HUNT,
            [
                198.704_106_687,
                1.043_496_677_64,
                2.489_315_308_01,
                0.780_142_747_741,
            ],
        ),
        (
            ContactLaw::Tangent {
                stiffness_n_m: 1e6,
                bottoming_m: 1e-3,
            },
            "tangent, bottoming at 1 mm",
            TANGENT,
            [
                1_401.954_559_64 / MASS_KG / G0_M_S2,
                0.728_638_501_801,
                1.509_703_544_43,
                1.0,
            ],
        ),
    ]
}

pub(super) fn checks() -> Result<Vec<Check>, Problem> {
    // Eleven digits are known, and rounding of the integrals.
    const DIGITS: f64 = 1e-10;
    let mut checks = Vec::new();
    for (law, name, reference, expected) in cases() {
        let cushion = Cushion::new(law).map_err(defect)?;
        let speed_m_s = (2.0 * G0_M_S2 * 0.1).sqrt();
        let contact = cushion.land(MASS_KG, speed_m_s);
        let computed = [
            ("peak [g]", contact.peak_force_n / MASS_KG / G0_M_S2),
            ("compression [mm]", 1e3 * contact.compression_m),
            ("duration [ms]", 1e3 * contact.duration_s),
            ("restitution", contact.restitution_ratio),
        ];
        for ((what, computed), expected) in computed.into_iter().zip(expected) {
            let words = format!("0.365 kg from 100 mm, {name}: {what}");
            checks.push(check(
                words,
                computed,
                expected,
                DIGITS * expected,
                reference,
            ));
        }
    }
    let foam = StressEnergy {
        stress_pa: 1e5,
        exponent_m3_j: 2e-5,
    };
    let best_pa = foam.best_static_stress_pa(0.1, 0.02);
    checks.push(check(
        "cushion curve: best static stress [Pa]",
        best_pa,
        10e3,
        1e-9,
        STRESS,
    ));
    let least = foam.peak_acceleration_g(best_pa, 0.1, 0.02);
    checks.push(check(
        "cushion curve: least peak [g]",
        least,
        10.0 * std::f64::consts::E,
        1e-12,
        STRESS,
    ));
    Ok(checks)
}
