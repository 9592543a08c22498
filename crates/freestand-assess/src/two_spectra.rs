//! National annexes with two spectra: an object is assessed by both, and the worse result counts.

use freestand_input::problem::Problem;
use freestand_study::study::Study;
use freestand_study::target::Target;

use crate::rank::Urgency;
use crate::reason::Reason;
use crate::result::Assessment;
use freestand_inventory::Item;

/// Whether the result by the other spectrum is the worse one: the more urgent by the rule of [`crate::rank`], which for one
/// object compares the decision, the probability that it falls and the probability that its tolerance is exceeded.
pub(crate) fn is_worse(item: &Item, one: &Assessment, other: &Assessment) -> bool {
    Urgency::new(item, other)
        .order(&Urgency::new(item, one))
        .is_lt()
}

/// The result that counts; where it is that by the other spectrum, it says so. `study` is that of the other spectrum.
pub(crate) fn worse(
    item: &Item,
    study: &Study,
    one: Assessment,
    mut other: Assessment,
) -> Assessment {
    if !is_worse(item, &one, &other) {
        return one;
    }
    other.why.push(Reason::Spectrum(spectrum_type(study)));
    other
}

/// The type of the spectrum of `study`.
pub(crate) fn spectrum_type(study: &Study) -> u8 {
    study
        .ground
        .code_spectrum()
        .and_then(Target::spectrum_type)
        .unwrap_or(2)
}

/// Refuses outcomes where there are two spectra: those of both cannot stand in one table.
pub fn refuse_outcomes(wants_outcomes: bool, alternative: Option<&Study>) -> Result<(), Problem> {
    if !wants_outcomes || alternative.is_none() {
        return Ok(());
    }
    let hint = "add `spectrum_type = 1` or `spectrum_type = 2` to [ground], and run once with each";
    Err(Problem::value(
        "`outcomes` are those of one spectrum, but the national annex of this place has two",
        hint,
    ))
}
