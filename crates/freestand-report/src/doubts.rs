//! What may make a history or a study wrong and what its reader must know, as sentences.

mod cushion;
mod limit;
mod simulation;
mod study;
mod target;

use freestand::impact::ValidityWarning;
use freestand::spectra::{PERTURBATION_RATIO, SENSITIVE_RATIO};
use freestand_input::quantity::{Dimension, format_si};
use freestand_input::words::{number, significant};
use freestand_output::answer;
use freestand_records::processing::few_steps;
use freestand_study::doubt::{
    BesideWall, HistoryDoubt, HistoryNote, MotionDoubt, NarrowBase, SpectrumDoubt, SquatObjects,
    UnlikelySize,
};

pub use cushion::cushion_note;
pub(crate) use cushion::cushion_notes;
pub use limit::model_limit;
pub use simulation::{outside_limits, simulation_assumption};
pub use study::{
    assumed_at, building_doubt, fit_doubt, not_varied, period_from, study_doubt, study_doubts,
    two_spectra,
};
pub(crate) use study::{dispersion, mean_off, no_result};
pub use target::{place_doubt, target_doubt};

/// What may make a history wrong.
pub fn history_doubt(doubt: &HistoryDoubt) -> String {
    match doubt {
        HistoryDoubt::Size(size) => unlikely_size(size),
        HistoryDoubt::Validity(limit) => model_limit(limit),
        HistoryDoubt::SlidesByAssumption(limit) => {
            let limit = model_limit(limit);
            format!("{limit}; this coefficient is assumed: `friction` replaces it")
        }
        HistoryDoubt::LeavesTheFloor => {
            "at some instant the contact would have to pull the object down: the object would leave the floor, which the \
             model does not include"
                .to_owned()
        }
        HistoryDoubt::Unresolved => {
            "at the end of the calculation the object is neither at rest nor down: leave `duration` out, or give a \
             longer one, to see whether it falls"
                .to_owned()
        }
        HistoryDoubt::WallOutOfReach {
            side,
            gap_m,
            height_m,
        } => format!(
            "the wall on the {side} is {} m away and the object {} m high: it cannot touch it, so there is no wall \
             within reach",
            number(*gap_m, 4),
            number(*height_m, 4)
        ),
        HistoryDoubt::WallPastBalance {
            side,
            angle_rad,
            balance_rad,
        } => format!(
            "the object touches the wall on the {side} at {} rad, past its balance point at {} rad: it can fall against \
             the wall and lean there",
            number(*angle_rad, 3),
            number(*balance_rad, 3)
        ),
        HistoryDoubt::WallCushionAssumed(ends) => {
            let [soft, stiff] = ends.map(beside_wall);
            format!("the cushion of the walls is assumed: {soft}; {stiff}")
        }
        HistoryDoubt::OtherOutcomeNearby => {
            "one realisation: another outcome follows from a motion that differs by 0.01 %; trust shares over many \
             motions, not this history"
                .to_owned()
        }
        HistoryDoubt::Undamped => {
            "the cushions have no damping: under a motion the object keeps ringing on them, and the largest shock of a \
             long history depends on rounding; use a damped law, such as `law = \"kelvin-voigt\"` with `damping = \"5 %\"`"
                .to_owned()
        }
        HistoryDoubt::TooSoft => {
            "the cushions are too soft to keep the object upright at rest: check their stiffness".to_owned()
        }
        HistoryDoubt::EnergyError(error_ratio) => format!(
            "the energy balance has an error of {error_ratio:.1e} of the energy exchanged: use `accuracy = \"tight\"`"
        ),
        HistoryDoubt::Assumed { key, ratio } => {
            let name = key.replace('_', " ");
            format!("the {name} of {ratio} is assumed: `{key}` replaces it")
        }
        HistoryDoubt::Trips {
            speed_m_s,
            trip_m_s,
        } => format!(
            "it reaches its clearance at {} m/s, and its trip speed is {} m/s: a low stop there would overturn it",
            significant(*speed_m_s, 3),
            significant(*trip_m_s, 3)
        ),
        HistoryDoubt::StillMoves => {
            "it still moves at the end of the calculation: a longer `duration` follows it to rest".to_owned()
        }
        HistoryDoubt::MayRockAcross => {
            "whether it rocks across before it slides is not known without `width`".to_owned()
        }
        HistoryDoubt::NarrowBase(base) => narrow_base(base),
        HistoryDoubt::HardlyStands(rise_m) => format!(
            "the body hardly stands: its centre of gravity rises by {} mm until it falls",
            number(1e3 * rise_m, 2)
        ),
        HistoryDoubt::UnresolvedOnHull => {
            "the body still moves two minutes after the last sample: whether it falls is not known".to_owned()
        }
    }
}

/// A size that hardly any object has.
pub fn unlikely_size(size: &UnlikelySize) -> String {
    format!(
        "`{}` is {} m, and that of an object is between {} and {} m: check its unit",
        size.key,
        number(size.size_m, 4),
        size.usual_m.start(),
        size.usual_m.end()
    )
}

/// Squat objects of a grid.
fn squat_objects(objects: &SquatObjects) -> String {
    let SquatObjects {
        count,
        objects,
        height_m,
        thickness_m,
        landing_ratio,
    } = *objects;
    let [height, thickness] =
        [height_m, thickness_m].map(|size_m| format_si(size_m, Dimension::Length));
    let are = if count == 1 { "is" } else { "are" };
    let squat = model_limit(&ValidityWarning::Squat { landing_ratio });
    format!(
        "{count} of {objects} objects {are} squat, the first {height} high and {thickness} thick: {squat}"
    )
}

/// What may make what is calculated from motions wrong.
pub fn motion_doubt(doubt: &MotionDoubt) -> String {
    match doubt {
        MotionDoubt::OfRecords(words) => words.clone(),
        MotionDoubt::OtherDirection {
            component,
            stated_deg,
            used_deg,
        } => format!(
            "{component}: the file states {}°, and the given {}° is used",
            number(*stated_deg, 6),
            number(*used_deg, 6)
        ),
        MotionDoubt::FewSteps {
            shortest_s,
            dt_s,
            upsample,
            needed,
        } => {
            let given = match upsample {
                0 | 1 => String::new(),
                parts => format!(", in {parts} parts each"),
            };
            format!(
                "{}{given}: the spectrum is inaccurate there, because peaks between samples are missed; `upsample = \
                 {needed}` would give it ten",
                few_steps("the shortest period", *shortest_s, *dt_s)
            )
        }
        MotionDoubt::LongPulse => {
            "the pulse is so long that the fastest oscillators have few samples in a period: their peaks may be too low"
                .to_owned()
        }
    }
}

/// The same of all, as they are told.
pub fn motion_doubts(doubts: &[MotionDoubt]) -> Vec<String> {
    doubts.iter().map(motion_doubt).collect()
}

fn beside_wall(beside: BesideWall) -> String {
    format!(
        "with {} times the stiffness of an edge and {} % of damping the outcome is {}, the largest tilt {} rad",
        number(beside.stiffness_ratio, 3),
        number(100.0 * beside.damping_ratio, 2),
        beside.outcome,
        number(beside.tilt_rad, 3)
    )
}

/// What a flat base that is much narrower than the body may mean.
pub(crate) fn narrow_base(base: &NarrowBase) -> String {
    format!(
        "the flat base is only {} mm wide in a direction in which the scan is {} mm wide: if the scan is tilted or its \
         underside bulges, turn its base onto the floor, or give a larger `scan_error` or the `feet`",
        number(1e3 * base.base_m, 2),
        number(1e3 * base.plan_m, 3)
    )
}

/// That a scan was turned by an angle before it stands.
pub(crate) fn turned(turned_rad: f64) -> String {
    format!(
        "the scan was turned by {} degrees to stand",
        number(turned_rad.to_degrees(), 2)
    )
}

fn note(note: &HistoryNote) -> String {
    let words = match note {
        HistoryNote::Leans => "it leans on a wall at the end",
        HistoryNote::PadsForShockAlone => {
            "the base is rigid: the pads are used for the shock alone, and on them the object may lift more"
        }
        HistoryNote::OneRealisation => {
            "one realisation: trust shares and fractiles over many motions and directions, not a single history"
        }
        // Mean of both rocks and shares that overturned: docs/validation.md.
        HistoryNote::Underestimates => {
            "in 327 tests of two scanned rocks on a shake table this model underestimated overturning: it gave a mean \
             probability of 0.29 and 0.21, and 37 % and 31 % overturned"
        }
        HistoryNote::Untested => "this model has not been tested on round bodies or bodies on feet",
        HistoryNote::FlatUnderside => {
            "its underside is taken to be flat: on a base curved by 2 mm it would fall far more easily"
        }
        HistoryNote::Turned(turned_rad) => return turned(*turned_rad),
        HistoryNote::HullOfScan => {
            "the scan has holes or several parts: its convex hull, with uniform density, is used instead"
        }
        HistoryNote::Cushion(note) => return cushion_note(note),
    };
    words.to_owned()
}

answer! {
    /// What the reader of a history must know.
    pub struct Notes {
        notes: Vec<String> = "note",
    }
}

impl Notes {
    /// As sentences.
    pub fn of(notes: &[HistoryNote]) -> Self {
        Self {
            notes: notes.iter().map(note).collect(),
        }
    }
}

/// What may make rows of spectra wrong.
pub fn spectrum_doubt(doubt: &SpectrumDoubt) -> String {
    match doubt {
        SpectrumDoubt::Squat(objects) => squat_objects(objects),
        SpectrumDoubt::Size(size) => unlikely_size(size),
        SpectrumDoubt::Validity(limit) => model_limit(limit),
        SpectrumDoubt::OfDeepestLanding(limit) => {
            format!(
                "the landing with the largest compression: {}",
                model_limit(limit)
            )
        }
        SpectrumDoubt::Failed { failed, total } => {
            format!("{failed} of {total} histories could not be calculated: see the column reason")
        }
        SpectrumDoubt::Sensitive { sensitive, total } => format!(
            "{sensitive} of {total} histories are sensitive: an error of the motion grows more than {SENSITIVE_RATIO} \
             times in the rotation or the impacts, or an error of {PERTURBATION_RATIO:e} of the motion may change the \
             outcome"
        ),
    }
}

#[cfg(test)]
pub(crate) mod tests;
