//! Shock response spectra, classical pulses and the damage boundary against closed forms.

use freestand::G0_M_S2;
use freestand::damage_boundary::{DamageBoundary, half_sine_floor_m_s2};
use freestand::shock_response::{
    Peak, Pulse, PulseShape, ResponseKind, ResponsePeaks, half_sine_maximax_ratio, pulse_spectrum,
};
use std::f64::consts::PI;

use super::{Check, check, defect};
use crate::shock_spectrum::SHAPES;
use freestand_input::problem::Problem;
use freestand_input::words::name_of;

/// The peaks under a pulse of 1 m/s² and 1 s at one f T.
fn peaks(
    shape: PulseShape,
    q: f64,
    damping_ratio: f64,
    kind: ResponseKind,
) -> Result<ResponsePeaks, Problem> {
    let pulse = Pulse::new(shape, 1.0, 1.0).map_err(defect)?;
    let spectrum = pulse_spectrum(&pulse, &[q], kind, damping_ratio).map_err(defect)?;
    Ok(spectrum.peaks.first().copied().unwrap_or_default())
}

pub(super) fn spectrum_checks() -> Result<Vec<Check>, Problem> {
    const DAMPED: &str =
        "half-sine on an oscillator of 5 % damping, fine numerical solution to five decimals";
    const UNDAMPED: &str =
        "undamped oscillator under a half-sine, closed form (Ayre, Shock and Vibration Handbook)";
    const ACCELERATION: ResponseKind = ResponseKind::AbsoluteAcceleration;
    let mut checks = Vec::new();
    for (q, expected) in [
        (0.25, 0.878_08),
        (0.5, 1.462_64),
        (1.0, 1.623_79),
        (2.0, 1.212_37),
    ] {
        let computed = peaks(PulseShape::HalfSine, q, 0.05, ACCELERATION)?.peak(Peak::Maximax);
        // Half a unit of the last decimal, and the sampling of the pulse.
        let name = format!("shock response spectrum of a half-sine, 5 %, fT = {q}");
        checks.push(check(name, computed, expected, 1e-5, DAMPED));
        let computed = peaks(PulseShape::HalfSine, q, 0.0, ACCELERATION)?.peak(Peak::Maximax);
        let name = format!("shock response spectrum of a half-sine, undamped, fT = {q}");
        checks.push(check(
            name,
            computed,
            half_sine_maximax_ratio(q),
            2e-5,
            UNDAMPED,
        ));
    }
    const RECTANGLE: &str = "undamped oscillator under a rectangle: 2|sin πfT| after it";
    let computed = peaks(PulseShape::Rectangle, 0.2, 0.0, ACCELERATION)?.peak(Peak::Residual);
    // The jumps are drawn over two of 2000 steps.
    checks.push(check(
        "residual of a rectangle, fT = 0.2",
        computed,
        2.0 * (0.2 * PI).sin(),
        1e-5,
        RECTANGLE,
    ));
    Ok(checks)
}

pub(super) fn pulse_checks() -> Result<Vec<Check>, Problem> {
    const IMPULSE: &str = "pseudo-velocity of a slow undamped component: the velocity change, 2AT/π, AT/2, AT, 0.9 AT";
    let expected = [2.0 / PI, 0.5, 0.5, 0.5, 1.0, 0.9];
    let checks = PulseShape::ALL
        .into_iter()
        .zip(expected)
        .map(|(shape, expected)| {
            let computed =
                peaks(shape, 1e-3, 0.0, ResponseKind::PseudoVelocity)?.peak(Peak::Maximax);
            // (ωT)²/24 = 1.6e-6 at fT = 1e-3.
            Ok(check(
                format!("velocity change of a pulse: {}", name_of(SHAPES, shape)),
                computed,
                expected,
                2e-6,
                IMPULSE,
            ))
        });
    checks.collect()
}

pub(super) fn boundary_checks() -> Result<Vec<Check>, Problem> {
    const COMPONENT: &str = "component of 40 g and 100 Hz under rectangles: V_c = a_c/ω, A_c = a_c/2, 2A sin(ωV/2A) = a_c";
    let a_c = 40.0 * G0_M_S2;
    let boundary = DamageBoundary::of_component(100.0, a_c).map_err(defect)?;
    let (v_c, floor) = (boundary.velocity_change_m_s(), boundary.acceleration_m_s2());
    let mut checks = vec![
        check(
            "damage boundary: V_c [m/s]",
            v_c,
            0.624_31,
            5.1e-6,
            COMPONENT,
        ),
        check(
            "damage boundary: A_c [g]",
            floor / G0_M_S2,
            20.0,
            1e-12,
            COMPONENT,
        ),
        check(
            "half-sine that a component just withstands",
            half_sine_floor_m_s2(1.0),
            0.565_46,
            5.1e-6,
            COMPONENT,
        ),
    ];
    for (ratio, expected) in [(1.05, 0.975_09), (1.2, 0.584_37), (1.4, 0.509_98)] {
        let knee = boundary
            .knee_acceleration_m_s2(ratio * v_c)
            .unwrap_or(f64::NAN);
        let name = format!("damage boundary: A/a_c at {ratio} V_c");
        checks.push(check(name, knee / a_c, expected, 5.1e-6, COMPONENT));
    }
    Ok(checks)
}
