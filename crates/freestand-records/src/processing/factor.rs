//! The factor by which a record is multiplied in the last step.

use freestand::G0_M_S2;
use freestand::motion::Motion;
use freestand::signal::scale::{SpectrumFit, factor_to_peak, factor_to_sa, fit_to_spectrum};

use super::{Scale, refused, short_period_warning};
use crate::notes::{Note, NoteKind};
use freestand_input::problem::Problem;
use freestand_input::words::number;

/// The factor, and why.
pub(super) fn factor(motion: &Motion, scale: &Scale) -> Result<(f64, String), Problem> {
    let wrong = |error| refused("scale", error, "check the record and the target");
    Ok(match *scale {
        Scale::Factor(factor) => (factor, String::new()),
        Scale::Peak { target_m_s2 } => {
            let factor = factor_to_peak(motion, target_m_s2).map_err(wrong)?;
            (
                factor,
                format!(" to a peak of {} g", number(target_m_s2 / G0_M_S2, 6)),
            )
        }
        Scale::Sa {
            target_m_s2,
            period_s,
            damping_ratio,
        } => {
            let factor =
                factor_to_sa(motion, period_s, damping_ratio, target_m_s2).map_err(wrong)?;
            let (target, damping) = (
                number(target_m_s2 / G0_M_S2, 6),
                number(100.0 * damping_ratio, 6),
            );
            (
                factor,
                format!(
                    " to a pseudo-acceleration of {target} g at {period_s} s, {damping} % damping"
                ),
            )
        }
        Scale::Spectrum(ref target) => {
            let SpectrumFit { factor, misfit_ln } = fit_to_spectrum(
                motion,
                target.damping_ratio,
                &target.periods_s,
                &target.psa_m_s2,
            )
            .map_err(wrong)?;
            // Anything smaller comes from the rounding of the target's digits.
            let misfit = if misfit_ln < 1e-4 {
                "below 0.01".to_owned()
            } else {
                number(100.0 * misfit_ln, 3)
            };
            (
                factor,
                format!(
                    " to the spectrum of {}; misfit {misfit} % rms in ln)",
                    target.words()
                ),
            )
        }
    })
}

/// A factor with all digits, or with six if it needs many zeros; `scale_ratio` has all digits.
pub(super) fn factor_words(factor: f64) -> String {
    if (1e-4..1e9).contains(&factor.abs()) {
        factor.to_string()
    } else {
        number(factor, 6)
    }
}

/// Notes about a target: what was left out of its file, and periods for which the record has few
/// samples.
pub(super) fn target_notes(scale: &Scale, dt_s: f64) -> Vec<Note> {
    let (note, periods_s) = match scale {
        Scale::Factor(_) | Scale::Peak { .. } => return Vec::new(),
        Scale::Sa { period_s, .. } => (&None, std::slice::from_ref(period_s)),
        Scale::Spectrum(target) => (&target.note, target.periods_s.as_slice()),
    };
    let few = short_period_warning("the target", periods_s, dt_s);
    let of = |kind| move |words: String| Note::new(kind, words);
    note.iter()
        .cloned()
        .map(of(NoteKind::Target))
        .chain(few.map(of(NoteKind::ShortPeriod)))
        .collect()
}
