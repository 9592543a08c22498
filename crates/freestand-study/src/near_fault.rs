//! The fault on which the earthquake of a study happens: what brings velocity pulses into its worlds.

use freestand::code_spectrum::CodeSpectrum;
use freestand::worlds::{ACCEPTED_FAULT_MAGNITUDES, MOST_FAULT_DISTANCE_M, NearFault};
use freestand_input::keys::Words;
use freestand_input::problem::Problems;
use freestand_input::quantity::Dimension;
use freestand_input::word_reader::WordReader;
use freestand_input::words::number;

use crate::places::{FAR_KM, PlaceHazard};
use crate::target::{Code, Target, code_of};

/// Up to this return period NZS 1170.5 counts no fault as near (R up to 0.75), and so is it here for TS 1170.5 \[years\].
const NEAR_FAULT_YEARS: u32 = 250;

/// The words of the spectrum: of the two keys of a fault, NZS 1170.5 alone takes the distance.
pub fn spectrum_words(words: &Words) -> Words {
    let mut left = words.clone();
    left.remove("fault_magnitude");
    if code_of(words) != Some(Code::Nzs1170_5) {
        left.remove("fault_distance");
    }
    left
}

/// The fault that the keys `fault_distance` and `fault_magnitude` describe; where no distance is stated, that of the
/// place, if its code counts a fault as near there. `None`: no fault is known.
///
/// # Errors
/// Everything that is wrong with these keys.
pub fn near_fault(words: &Words, target: Option<&Target>) -> Result<Option<NearFault>, Problems> {
    let mut reader = WordReader::new(words);
    let of_place = target.and_then(|target| match &target.spectrum {
        CodeSpectrum::Nzs1170_5(code) if code.is_near_fault() => {
            Some((code.fault_distance_km()?, None))
        }
        // The table of the settlement has a distance and a magnitude for each return period.
        CodeSpectrum::Ts1170_5(code) => {
            let PlaceHazard::Ts1170_5 { levels } = target.place.as_ref()?.hazard else {
                return None;
            };
            let years = code.return_period_years();
            let level = levels.iter().find(|level| level.years == years)?;
            let is_rare = years > NEAR_FAULT_YEARS;
            let km = level
                .fault_distance_km
                .filter(|km| *km < FAR_KM && is_rare)?;
            Some((km, level.magnitude))
        }
        _ => None,
    });
    let is_known = reader.has("fault_distance") || of_place.is_some();
    let stated_m = reader.non_negative("fault_distance", Dimension::Length);
    let distance_m = stated_m.or(of_place.map(|(km, _)| km * 1e3));
    if let Some(distance_m) = distance_m.filter(|far| *far > MOST_FAULT_DISTANCE_M) {
        let message = format!(
            "`fault_distance` must be at most {} km, not {} km",
            MOST_FAULT_DISTANCE_M / 1e3,
            number(distance_m / 1e3, 4)
        );
        reader.note(
            &["fault_distance"],
            message,
            "give the closest distance to the fault, or leave it out where none is near",
        );
    }
    let magnitude = reader.positive("fault_magnitude", Dimension::Ratio);
    let (least, most) = ACCEPTED_FAULT_MAGNITUDES;
    if let Some(magnitude) = magnitude.filter(|given| !(least..=most).contains(given)) {
        let message = format!("`fault_magnitude` must be from {least} to {most}, not {magnitude}");
        reader.note(
            &["fault_magnitude"],
            message,
            "give the moment magnitude of the earthquakes of this fault, such as 7.1",
        );
    }
    if reader.has("fault_magnitude") && !is_known {
        reader.missing(
            &["fault_distance", "fault_magnitude"],
            "`fault_magnitude` needs `fault_distance`",
            "give `fault_distance = \"5 km\"`, or leave `fault_magnitude` out",
        );
    }
    let magnitude = magnitude.or(of_place.and_then(|(_, magnitude)| magnitude));
    let fault = distance_m.and_then(|distance_m| NearFault::new(distance_m, magnitude).ok());
    // N(T, D) raises the target for the same pulses.
    let is_in_target = target.is_some_and(
        |target| matches!(&target.spectrum, CodeSpectrum::Nzs1170_5(code) if code.is_near_fault()),
    );
    let fault = fault.map(|fault| {
        if is_in_target {
            fault.in_target()
        } else {
            fault
        }
    });
    reader.problems.finish(Some(fault))
}

/// Refuses what is wrong with the hazard of a place and with its fault.
///
/// # Errors
/// All of it.
pub fn check_place(words: &Words) -> Result<(), Problems> {
    let target = Target::resolve_place(&spectrum_words(words))?;
    near_fault(words, Some(&target)).map(|_| ())
}

#[cfg(test)]
mod tests {
    use crate::resolve::resolve;
    use crate::study::Ground;

    /// Distance in km and magnitude of the fault of a study.
    fn fault(ground: &str) -> Option<(f64, Option<f64>)> {
        let study = resolve(&format!("[ground]\n{ground}\n"), None, "".as_ref()).unwrap();
        let Ground::Synthetic(ground) = study.ground else {
            panic!("synthetic motions");
        };
        let fault = ground.near_fault?;
        Some((fault.distance_m() / 1e3, fault.magnitude()))
    }

    #[test]
    fn a_fault_is_stated_or_that_of_the_place() {
        assert_eq!(fault("place = \"Lisbon\""), None);
        let stated = "place = \"Lisbon\"\nfault_distance = \"5 km\"\nfault_magnitude = 7.1";
        assert_eq!(fault(stated), Some((5.0, Some(7.1))));
        assert_eq!(fault("fault_distance = \"0 km\""), Some((0.0, None)));
        // Of the table of places, unless another is stated; no fault is near Auckland.
        assert_eq!(fault("place = \"Kaikoura\""), Some((6.0, None)));
        assert_eq!(
            fault("place = \"Kaikoura\"\nfault_magnitude = 7.8"),
            Some((6.0, Some(7.8)))
        );
        assert_eq!(
            fault("place = \"Kaikoura\"\nfault_distance = \"9 km\""),
            Some((9.0, None))
        );
        assert_eq!(fault("place = \"Auckland\""), None);
        // TS 1170.5:2025, Table 3.1, has the magnitude as well.
        assert_eq!(
            fault("place = \"Masterton\"\ncode = \"ts1170.5\""),
            Some((6.0, Some(7.9)))
        );
        let rarer = "place = \"Masterton\"\ncode = \"ts1170.5\"\nreturn_period_years = 250";
        assert_eq!(fault(rarer), None);
        // R = 0.5: the code counts no fault as near; whoever states one has it.
        let rarer = "place = \"Kaikoura\"\nreturn_period_years = 100";
        assert_eq!(fault(rarer), None);
        assert_eq!(
            fault(&format!("{rarer}\nfault_distance = \"6 km\"")),
            Some((6.0, None))
        );
    }

    #[test]
    fn what_is_wrong_is_told_with_its_line() {
        for (ground, line, said) in [
            ("fault_distance = \"5\"", 3, "needs a unit"),
            ("fault_distance = \"-1 km\"", 3, "must be 0 or more"),
            (
                "fault_distance = \"1001 km\"",
                3,
                "must be at most 1000 km, not 1001 km",
            ),
            (
                "fault_distance = \"5 km\"\nfault_magnitude = 9",
                4,
                "must be from 5 to 8.5, not 9",
            ),
            ("fault_magnitude = 7", 3, "needs fault_distance"),
        ] {
            let text = format!("[ground]\nplace = \"Lisbon\"\n{ground}\n");
            let told = resolve(&text, None, "".as_ref()).unwrap_err().problems;
            assert!(
                told.len() == 1 && told[0].message.contains(said),
                "{told:?}"
            );
            assert_eq!(told[0].line, Some(line), "{told:?}");
        }
        // Records are what they are.
        let records = "[ground]\nmotions = [\"a.csv\"]\nfault_distance = \"5 km\"\n";
        let told = resolve(records, None, "".as_ref()).unwrap_err().to_string();
        assert!(
            told.contains("fault_distance and motions exclude each other"),
            "{told}"
        );
    }
}
