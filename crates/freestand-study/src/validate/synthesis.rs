//! The stochastic point source against reference values, and a motion against its target.

use freestand::code_spectrum::{As1170_4, Edition, SiteClass};
use freestand::synthesis::{PointSource, Preset, ShearWaveProfile, SynthesisOptions, synthesize};

use super::{Check, check, defect};
use freestand_input::problem::Problem;

pub(super) fn checks() -> Result<Vec<Check>, Problem> {
    const SOURCE: &str = "M 6 at 28 km, 200 bar, 1/R, Q = 100 f^0.85, κ = 0.025 s: independent computation to five digits";
    const CRUST: &str =
        "quarter wavelength under Melbourne (Tang 2019): sum over a million layers to five digits";
    const MATCH: &str = "synthetic motion 1 of seed 1, AS 1170.4 De, 0.08 g: rms misfit over 0.05 to 5 s at most 5 %";
    let source = PointSource {
        profile: None,
        ..Preset::Victoria.source(6.0, 28e3)
    };
    let mut checks = vec![check(
        "corner frequency of a point source [Hz]",
        source.corner_hz(),
        0.448_54,
        5e-6,
        SOURCE,
    )];
    for (frequency_hz, expected) in [(0.1, 0.645_29), (1.0, 9.8230), (10.0, 5.2356)] {
        let computed = 100.0 * source.fourier_amplitude_m_s(frequency_hz);
        let name = format!("Fourier amplitude of a point source at {frequency_hz} Hz [cm/s]");
        // Half a unit of the fifth digit, and constants that the reference may hold to four (0.7071
        // for 1/√2: 1e-5).
        checks.push(check(name, computed, expected, 2e-5 * expected, SOURCE));
    }
    let crust = ShearWaveProfile::melbourne();
    for (frequency_hz, expected) in [(0.1, 1.162_32), (1.0, 1.859_26), (10.0, 3.253_50)] {
        let computed = crust.amplification_ratio(frequency_hz, 2800.0, 3500.0);
        checks.push(check(
            format!("amplification of the crust at {frequency_hz} Hz"),
            computed,
            expected,
            1e-5,
            CRUST,
        ));
    }
    let code = As1170_4::new(Edition::default(), SiteClass::De, 0.08, 500).map_err(defect)?;
    let matched =
        synthesize(|t| code.sa_g(t), 1, 0, &SynthesisOptions::default()).map_err(defect)?;
    checks.push(check(
        "rms misfit of a synthetic motion",
        matched.misfit.rms_ratio,
        0.0,
        0.05,
        MATCH,
    ));
    Ok(checks)
}
