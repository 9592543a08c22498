//! What the reader of a spectrum or a place must know, as sentences.

use freestand_input::words::number;
use freestand_study::places::{PlaceDoubt, WhyDoubted};
use freestand_study::target::TargetDoubt;

/// What the reader of a spectrum must know.
pub fn target_doubt(doubt: &TargetDoubt) -> String {
    match doubt {
        TargetDoubt::EditionUnread => {
            "AS 1170.4:2024 was not available: its spectral shape is reported to be that of 2007, and the tables of 2007 \
             with Amendment 2 (Z, kp, smallest kpZ) are used"
                .to_owned()
        }
        TargetDoubt::Place(doubt) => place_doubt(doubt),
        TargetDoubt::Derived { place, derived } => format!(
            "the hazard of {place} at {} years is derived, not read: {}, for screening only; the synthetic motions of \
             worlds draw a factor from this range",
            derived.years,
            derived.words()
        ),
        TargetDoubt::PlaceAssumed(city) => format!(
            "no place is stated: the hazard is that of {city}; give `place`, or a hazard of your own"
        ),
        TargetDoubt::MinimumGoverns {
            least_ratio,
            years,
            hazard_factor,
        } => format!(
            "the code's minimum kpZ of {least_ratio} for {years} years governs: Z = {hazard_factor} would give less"
        ),
        TargetDoubt::MaximumGoverns { zr_ratio } => format!(
            "Z R = {} is above the maximum of NZS 1170.5, so 0.7 governs",
            number(*zr_ratio, 4)
        ),
        TargetDoubt::TwoSpectra(both) => {
            let [one, two] = both.map(|one| one.name());
            format!(
                "the national annex has two spectra, {one} and {two}: assessments calculate both and take the worse for \
                 each object, restraints are designed for the larger acceleration of the ground, and everything else \
                 uses {one} alone, whose velocity is the larger, unless a study states spectrum_type"
            )
        }
        TargetDoubt::OwnShape => {
            "the soil factor or the corner periods differ from those that EN 1998-1 recommends: check them against the \
             national annex"
                .to_owned()
        }
        TargetDoubt::AsksForStudy => {
            "ASCE 7-16, 11.4.8, asks for a site-specific study on site class D where S1 is 0.2 g or more; Fv of Table \
             11.4-2 is used instead, without the increase of SM1 by half that Supplement 3 allows in its place: long \
             periods may be underestimated"
                .to_owned()
        }
        TargetDoubt::CoefficientsOf2016 => {
            "the site coefficients, and the values of places, are those of ASCE 7-16: ASCE 7-22 has no such tables"
                .to_owned()
        }
        TargetDoubt::BeginsLate { name, first_s } => format!(
            "the spectrum {name} begins at {} s: its first value applies below, and the PGA of motions is compared with it",
            number(*first_s, 4)
        ),
        TargetDoubt::EndsEarly { name, last_s } => format!(
            "the spectrum {name} ends at {} s: the displacement is taken as constant beyond",
            number(*last_s, 4)
        ),
        TargetDoubt::OtherSite {
            name,
            years,
            at,
            distance_km,
        } => {
            let years = years.map_or_else(String::new, |years| {
                format!(" at {} years", number(years, 4))
            });
            format!(
                "the spectrum{years} is that of the site of {name} at {}, {} km away",
                at.words(),
                number(*distance_km, 2)
            )
        }
        TargetDoubt::NotMean { name, statistic } => format!(
            "the file {name} is {} of its hazard model, not the mean: rates and losses from it are not means",
            statistic.name_with_article()
        ),
    }
}

/// What the reader must know about the values of a place.
pub fn place_doubt(doubt: &PlaceDoubt) -> String {
    let PlaceDoubt { place, values, why } = doubt;
    let approximate = format!("the hazard of {place} ({values}) is approximate");
    match why {
        WhyDoubted::Shape { by, is_approximate } => {
            let why = match by {
                Some(by) => format!("that of {by} is not in the program"),
                None => "the file has the peak ground acceleration alone".to_owned(),
            };
            let shape = format!(
                "the spectrum of {place} has the shape of Eurocode 8, type 1, because {why}"
            );
            match is_approximate {
                true => format!("{approximate}: confirm it before you rely on it; {shape}"),
                false => shape,
            }
        }
        WhyDoubted::AnnexNotRead => format!(
            "{approximate}, and the shape of its spectrum is the one that EN 1998-1 recommends, because the national \
             annex was not read: confirm it in the national annex before you rely on it"
        ),
        WhyDoubted::PerhapsAbroad => format!(
            "the grid of NTC 2018 reaches beyond the border: its values hold for {place} only if that is in Italy"
        ),
        WhyDoubted::Approximate => {
            format!("{approximate}: confirm it in the national annex before you rely on it")
        }
    }
}
