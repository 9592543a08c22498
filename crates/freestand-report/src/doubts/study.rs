//! What the reader of a study and its result must know, and what nobody stated, as sentences.

use freestand::building::ModalDoubt;
use freestand::synthesis::SHORTEST_PERIOD_S;
use freestand_input::keys::KeyStyle;
use freestand_input::quantity::{Dimension, UnitSystem, format_si};
use freestand_input::words::{counted, number, percent, significant};
use freestand_study::building::{BuildingDoubt, PeriodFrom};
use freestand_study::matched::FitDoubt;
use freestand_study::result::{NoResult, NotVaried, Same, WhyNotVaried};
use freestand_study::study::{Assumed, Study, StudyDoubt, UsedFriction};
use freestand_study::suite::{Dispersion, LeftOut, MeanOff, SuiteDoubt, some_left_out};

use super::limit::model_limit;
use super::simulation::{outside_limits, simulation_assumption};
use super::squat_objects;
use super::target::target_doubt;

/// What the reader of a study and its result must know; keys are named as in files, but for those of records, which
/// whoever read the records knows how to name.
pub fn study_doubt(doubt: &StudyDoubt) -> String {
    match doubt {
        StudyDoubt::OfRecords(words) => words.clone(),
        doubt => KeyStyle::File.shown(&words(doubt)),
    }
}

/// The same of all, as they are told.
pub fn study_doubts(doubts: &[StudyDoubt]) -> Vec<String> {
    doubts.iter().map(study_doubt).collect()
}

fn words(doubt: &StudyDoubt) -> String {
    match doubt {
        StudyDoubt::Target(doubt) => target_doubt(doubt),
        StudyDoubt::Restraint(doubt) => format!("[restraint]: {}", target_doubt(doubt)),
        StudyDoubt::Building(doubt) => building_doubt(doubt),
        StudyDoubt::Suite(doubt) => suite_doubt(doubt),
        StudyDoubt::OutsideLimits(earthquake) => outside_limits(earthquake),
        StudyDoubt::Simulated(assumption) => simulation_assumption(assumption),
        StudyDoubt::VerticalUnused => {
            "[ground] vertical is not used, because other motions replace those of the study"
                .to_owned()
        }
        StudyDoubt::AcrossUnused => {
            "[building] across is not used, because the motions have one component".to_owned()
        }
        StudyDoubt::BuildingAssumed { storeys, height_m } => format!(
            "[building] states no storeys: the building is the built-in one, with {storeys} storeys and {} m high; give \
             storeys",
            number(*height_m, 4)
        ),
        StudyDoubt::Cushion(limit) => model_limit(limit),
        StudyDoubt::Squat(objects) => squat_objects(objects),
        StudyDoubt::OfType { number, doubt } => {
            format!("with the spectrum of type {number}: {}", words(doubt))
        }
        StudyDoubt::OfRecords(words) => words.clone(),
        StudyDoubt::HighPeak(ratio) => high_peak(*ratio),
        StudyDoubt::Failed(share) => format!(
            "{} of {} histories could not be calculated: see the column reason of srs.csv",
            share.count, share.of
        ),
        StudyDoubt::Unsettled(share) => format!(
            "{} of {} histories had not come to rest when the calculation stopped after the motion: later impacts are \
             not counted",
            share.count, share.of
        ),
        StudyDoubt::NoPulses => {
            "the earthquake is near its fault, and the motions of a study have no velocity pulses: those of a list and \
             of one object have"
                .to_owned()
        }
        StudyDoubt::Slide(share, friction) => format!(
            "for {} of {} objects t/h is above the friction of {}: such objects slide before they uplift, which the \
             model neglects",
            share.count,
            share.of,
            used(*friction)
        ),
        StudyDoubt::Slip(share, friction) => format!(
            "for {} of {} objects the friction needed in an impact is above {}: the edge that lands may slip",
            share.count,
            share.of,
            used(*friction)
        ),
        StudyDoubt::NoHistory(error) => {
            format!("the requested rocking history cannot be drawn: {error}")
        }
    }
}

fn used(friction: UsedFriction) -> String {
    let assumed = if friction.is_assumed {
        " (assumed)"
    } else {
        ""
    };
    format!("{}{assumed}", friction.ratio)
}

fn high_peak(ratio: f64) -> String {
    format!(
        "the PGA of the matched motions is up to {ratio:.2} times the target's zero-period acceleration: their spectra \
         are matched only at periods of {SHORTEST_PERIOD_S} s and longer, and a motion with this plateau cannot have \
         such a small peak"
    )
}

/// What the reader of motions that fit a target must know.
pub fn fit_doubt(doubt: &FitDoubt) -> String {
    let percent = |ratio: f64, digits| significant(100.0 * ratio, digits);
    match doubt {
        FitDoubt::Target(doubt) => target_doubt(doubt),
        FitDoubt::Poor { name, misfit } => format!(
            "{name} does not fit its target: rms misfit {} %, worst {} % at {} s",
            percent(misfit.rms_ratio, 3),
            percent(misfit.worst_ratio, 3),
            significant(misfit.worst_period_s, 3)
        ),
        FitDoubt::HighPeak(ratio) => high_peak(*ratio),
        FitDoubt::PeakScaled {
            before_ratio,
            after_ratio,
        } => format!(
            "half-cycles were scaled to give the PGA of the target; this changed the rms misfit of the first motion from \
             {} % to {} %",
            percent(*before_ratio, 2),
            percent(*after_ratio, 2)
        ),
    }
}

/// What may be wrong with a building.
pub fn building_doubt(doubt: &BuildingDoubt) -> String {
    match doubt {
        BuildingDoubt::LooksLikeElevations { file } => format!(
            "{file}: the heights change from row to row by nearly the same step, like elevations above the ground; give \
             the height of each storey itself"
        ),
        BuildingDoubt::Modes { file, doubt } => format!("{file}: {}", modal_doubt(*doubt)),
        BuildingDoubt::TooHigh {
            code,
            greatest_m,
            height_m,
        } => {
            let [height, greatest] =
                [*height_m, *greatest_m].map(|height_m| format_si(height_m, Dimension::Length));
            format!(
                "the period is by {}, which is for buildings up to {greatest}; this one is {height} high: give its period",
                code.clause()
            )
        }
        BuildingDoubt::FormulaUnread(code) => format!(
            "the formula of {} for the period was not checked against its text: confirm it",
            code.clause()
        ),
    }
}

fn modal_doubt(doubt: ModalDoubt) -> String {
    match doubt {
        ModalDoubt::EffectiveMass { sum_ratio } if sum_ratio > 1.0 => format!(
            "the effective masses of the modes add up to {} of the mass: check that all modes belong to one direction",
            percent(sum_ratio, 1)
        ),
        ModalDoubt::EffectiveMass { sum_ratio } => format!(
            "the effective masses of the modes add up to {} of the mass, while codes usually require 90 %: export \
             more modes; the rest of the mass follows the ground",
            percent(sum_ratio, 1)
        ),
        ModalDoubt::RoofShare { sum_ratio } => format!(
            "participation times shape adds up to {} at the roof instead of 1: take both from one export, in the \
             same units and direction",
            number(sum_ratio, 4)
        ),
    }
}

/// What the period of a building is from.
pub fn period_from(from: &PeriodFrom) -> String {
    match *from {
        PeriodFrom::Given => "as given".to_owned(),
        PeriodFrom::Storeys => "from the storeys of the table".to_owned(),
        PeriodFrom::Modes => "from the table".to_owned(),
        PeriodFrom::Formula {
            code,
            frame,
            height_m,
        } => format!(
            "{}: T = {} with H = {} (frame \"{}\")",
            code.clause(),
            code.formula(frame).words(),
            format_si(height_m, Dimension::Length),
            frame.name()
        ),
    }
}

fn suite_doubt(doubt: &SuiteDoubt) -> String {
    let more = "more records to choose from, or a smaller suite_count, would fit better";
    match doubt {
        SuiteDoubt::LeftOut(files) => match files.as_slice() {
            [LeftOut { file, reason }] => format!("suite: {file} is left out: {reason}"),
            several => {
                let count = counted(several.len(), "file");
                format!("suite: {count} are left out: {}", some_left_out(several))
            }
        },
        SuiteDoubt::MeanOff(off) => {
            format!("suite: the mean of ln Sa is {}: {more}", mean_off(*off))
        }
        SuiteDoubt::Dispersion(found) => {
            let effect = match found.rms < found.asked {
                true => "probabilities come out too near 0 and 1",
                false => "rare events come out too often",
            };
            format!(
                "suite: the standard deviation of ln Sa is {}: {effect}; {more}",
                dispersion(*found)
            )
        }
    }
}

/// How far the mean of a suite is from its target.
pub(crate) fn mean_off(off: MeanOff) -> String {
    format!(
        "off by {} rms, by {} % at worst",
        significant(off.rms, 2),
        number(100.0 * off.worst_ln.exp_m1(), 2)
    )
}

/// The standard deviation of a suite and the one that was asked for.
pub(crate) fn dispersion(found: Dispersion) -> String {
    let Dispersion {
        rms,
        least,
        most,
        asked,
    } = found;
    let [rms, least, most] = [rms, least, most].map(|ln| significant(ln, 2));
    format!("{rms} rms, from {least} to {most} (asked: {asked})")
}

/// What was assumed about the shaking at a level, where nobody stated it.
pub fn assumed_at(
    study: &Study,
    level_ratio: f64,
    units: UnitSystem,
) -> impl Iterator<Item = String> {
    let all = study.assumed_at(level_ratio);
    all.map(move |one| assumed(one, units))
}

fn assumed(assumed: &Assumed, units: UnitSystem) -> String {
    match assumed {
        Assumed::Place(place) => format!(
            "the hazard of {}, because no place was given",
            place.as_deref().unwrap_or("the built-in study")
        ),
        Assumed::Site(site) => format!("{site}, because no site was given"),
        Assumed::ReturnPeriod(years) => {
            format!("a return period of {years} years, because none was given")
        }
        Assumed::NoVertical => "no vertical motion".to_owned(),
        Assumed::Building(storeys) => format!(
            "a building of {}, because none was given",
            counted(*storeys, "storey")
        ),
        Assumed::StoreyHeight(height_m) => format!("storeys of {}", units.storey(*height_m)),
        Assumed::FirstPeriod { period_s, from } => format!(
            "a first period of {} s, by {}",
            number(*period_s, 3),
            period_from(from)
        ),
        Assumed::Damping(ratio) => format!(
            "{} damping of the building, which stays elastic",
            percent(*ratio, 0)
        ),
        Assumed::WallsAndFrames => "a building of walls and frames (shear_flexure)".to_owned(),
    }
}

/// What an assessment says of a national annex with two spectra: it asks both.
pub fn two_spectra(study: &Study) -> Option<String> {
    let target = study.ground.code_spectrum()?;
    let (one, other) = (target.spectrum_type()?, target.other_type()?);
    Some(format!(
        "both spectra of the national annex, of type {one} and of type {other}: the worse counts for each object"
    ))
}

/// Why a change has no result.
pub(crate) fn no_result(why: &NoResult) -> String {
    let same = match why {
        NoResult::Failed(why) => return why.clone(),
        NoResult::Unchanged(Same::Modes) => "the building has the same modes",
        NoResult::Unchanged(Same::Objects) => "the objects and their cushion are the same",
        NoResult::Unchanged(Same::Motions) => {
            "the motions have the same spectrum and seed, or are the same records"
        }
    };
    format!("nothing changes: {same}")
}

/// Why a key is not varied.
pub fn not_varied(left_out: &NotVaried) -> String {
    let NotVaried { key, why } = left_out;
    let why = match why {
        WhyNotVaried::DefaultsChangeNothing => "none of its default values changes the model",
        WhyNotVaried::NoDefaults => {
            return format!(
                "{key} is not varied: it has no default values here; give some, as in \"{key} = …\""
            );
        }
        WhyNotVaried::OtherMotions => "[ground] is not used: other motions were given in its place",
        WhyNotVaried::MotionsOfFloors => "the study gives the motions of the floors",
        WhyNotVaried::DampingOfTable => "the table states the damping of every mode",
        WhyNotVaried::BuildingOfTable => "the building comes from a table",
        WhyNotVaried::Synthetic => "synthetic motions follow their target",
        WhyNotVaried::Simulated => "simulated motions follow their source",
        WhyNotVaried::OneEarthquake => "the motions are of one magnitude and distance",
        WhyNotVaried::MatchedSeed => "the motions are matched records",
        WhyNotVaried::SuiteSeed => "the motions are records of a suite",
        WhyNotVaried::SuiteScale => "the factors of a suite follow its target",
        WhyNotVaried::MatchedScale => "matched records follow their target",
        WhyNotVaried::Files => "the motions are read from files",
    };
    format!("{key} is not varied: {why}")
}

#[cfg(test)]
mod tests;
