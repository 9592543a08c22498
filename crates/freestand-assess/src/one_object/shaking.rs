//! The study of one object: what shakes it.

use std::path::Path;

use freestand::G0_M_S2;
use freestand::code_spectrum::{CodeSpectrum, GroundType, SpectrumShape, SpectrumType};
use freestand::decision::Looks;
use freestand_input::file::file_name;
use freestand_input::keys::Words;
use freestand_input::problem::{Problem, Problems};
use freestand_records::notes::grouped;
use freestand_study::near_fault;
use freestand_study::places::{Confidence, Place, PlaceHazard};
use freestand_study::recorded::{ReadMotion, refuse_copies};
use freestand_study::resolve::{Hazard, Overrides, Values, of_values};
use freestand_study::study::assessment::{Settings, Spread};
use freestand_study::study::{Ground, Level, Study, StudyDoubt};
use freestand_study::target::Target;

use super::earthquake::NamedEarthquake;
use super::{Earthquake, Floor, FloorPlace, ObjectRequest};

/// The ground of a peak acceleration: the type of Eurocode 8 whose spectrum is scaled.
const SPECTRUM: (SpectrumType, GroundType) = (SpectrumType::Type1, GroundType::B);

/// A study, and its earthquake.
#[derive(Clone)]
pub(super) struct Shaken {
    pub(super) study: Study,
    pub(super) earthquake: NamedEarthquake,
    pub(super) doubts: Vec<StudyDoubt>,
}

impl Shaken {
    /// With the other spectrum of the national annex, where that has two.
    pub(super) fn alternative(&self) -> Option<Self> {
        Some(Self {
            study: self.study.alternative()?,
            ..self.clone()
        })
    }
}

/// The study that a request describes.
///
/// # Errors
/// Everything that is wrong with it.
pub(super) fn shaken(request: &ObjectRequest) -> Result<Shaken, Problems> {
    let Floor {
        storeys,
        storey_height_m,
        ..
    } = request.floor;
    let values = |hazard| Values {
        hazard,
        count: None,
        seed: request.seed,
        storeys,
        storey_height_m,
    };
    let overrides = |hazard: &Words| Overrides {
        seed: request.seed,
        hazard: hazard.clone(),
        ..Overrides::default()
    };
    let mut shaken = match &request.earthquake {
        Earthquake::Place(hazard) => {
            check_place(hazard)?;
            let study = of_values(&values(Hazard::Keys(hazard.clone())))?;
            let file = hazard
                .get("spectrum")
                .and_then(|path| file_name(Path::new(path)));
            let mut shaken = of_study(study, hazard.get("site").is_some(), file);
            if let Some(doubts) = of_ground(&shaken.study, &request.floor) {
                shaken.doubts = doubts;
            }
            shaken
        }
        Earthquake::GroundAcceleration {
            peak_m_s2,
            near_fault,
        } => {
            // a_g S is the value of the spectrum at T = 0: EN 1998-1:2004, Eq. (3.2).
            let soil = SpectrumShape::recommended(SPECTRUM.0, SPECTRUM.1).soil_factor_ratio;
            let target = Target::eurocode8(SPECTRUM.0, SPECTRUM.1, peak_m_s2 / soil / G0_M_S2)
                .map_err(|error| {
                    Problem::value(format!("`pga`: {error}"), "give an acceleration above 0")
                })?;
            let peak_g = peak_m_s2 / G0_M_S2;
            let mut study = of_values(&values(Hazard::Spectrum(Box::new(target))))?;
            if let Ground::Synthetic(synthetic) = &mut study.ground {
                synthetic.near_fault = *near_fault;
            }
            let doubts = of_ground(&study, &request.floor);
            Shaken {
                doubts: doubts.unwrap_or_else(|| study.and_assumed_building()),
                study,
                earthquake: NamedEarthquake::GroundAcceleration { peak_g },
            }
        }
        Earthquake::Study { source, hazard } => {
            let study = source.load(&overrides(hazard))?;
            of_study(study, true, Some(source.name()))
        }
        Earthquake::Motions { motions, .. } => {
            refuse_copies(motions.iter().map(|read| read.motion.samples()))?;
            let mut study = of_values(&values(Hazard::default()))?;
            let notes = grouped(motions.iter().flat_map(ReadMotion::named_notes));
            let recorded = motions.iter().map(|read| read.motion.clone()).collect();
            study.ground = Ground::OnFloors;
            study.building = None;
            (study.place_is_assumed, study.building_is_assumed) = (false, false);
            study.assumed.clear();
            study.levels = vec![Level {
                name: "floor".to_owned(),
                level_ratio: Some(0.0),
                motions: recorded,
            }];
            as_given(&mut study.assessment, motions.len())?;
            Shaken {
                study,
                earthquake: NamedEarthquake::Motions,
                doubts: notes.into_iter().map(StudyDoubt::OfRecords).collect(),
            }
        }
    };
    let settings = &mut shaken.study.assessment;
    settings.seed = request.seed.unwrap_or(settings.seed);
    // What the answer depends on takes longer than the answer.
    settings.worlds.shares = Some(false);
    settings.is_annual = false;
    if let Some(worlds) = request.worlds {
        let looks = settings.worlds.looks;
        settings.worlds.looks = looks_of(looks.first().min(worlds), worlds, looks.confidence())?;
    }
    Ok(shaken)
}

fn looks_of(first: u32, most: u32, confidence: f64) -> Result<Looks, Problem> {
    Looks::new(first, most, confidence).map_err(|error| {
        Problem::value(
            format!("`worlds`: {error}"),
            "give a whole number, at least 1",
        )
    })
}

/// What is wrong with the hazard of a place.
///
/// # Errors
/// All of it, under its own keys and without the keys of a study.
pub fn check_place(hazard: &Words) -> Result<(), Problems> {
    let name = hazard.get("place").unwrap_or_default();
    let has_file = hazard.get("spectrum").is_some();
    let earthquake = |problem: Problem| {
        // The place is then a site of the file.
        if has_file {
            return problem;
        }
        if problem.is_about("return_period_years")
            && Place::find(name).is_some_and(|place| !place.hazard.takes_return_period())
        {
            return problem.hint("leave it out: this code has one intensity for each place");
        }
        if let Err(why) = Place::look_up(name, None)
            && problem.is_about("place")
        {
            let bring = "for another hazard give `pga`, or a study";
            return why.problem(Some("place"), name, bring).of(&["place"]);
        }
        problem
    };
    near_fault::check_place(hazard)
        .map_err(|problems| problems.into_iter().map(earthquake).collect())
}

/// What is doubtful for an object on the ground: the building has no part in the answer. `None`: it is on a floor.
fn of_ground(study: &Study, floor: &Floor) -> Option<Vec<StudyDoubt>> {
    let target = study.ground.code_spectrum()?;
    let doubts = || target.doubts.iter().cloned().map(StudyDoubt::Target);
    (floor.place == FloorPlace::Ground).then(|| doubts().collect())
}

/// Nothing is drawn, and every motion is used once.
fn as_given(settings: &mut Settings, motions: usize) -> Result<(), Problem> {
    settings.spread = Spread {
        restitution: 0.0,
        stiffness: 0.0,
        mass: 0.0,
        geometry: 0.0,
        model: 0.0,
        compliant: 0.0,
    };
    // The middle of what an assessment draws, on its logarithmic scale.
    let (low, high) = settings.pad_damping_ratio;
    settings.pad_damping_ratio = ((low * high).sqrt(), (low * high).sqrt());
    let motions = u32::try_from(motions).unwrap_or(u32::MAX);
    settings.worlds.looks = looks_of(motions, motions, settings.worlds.looks.confidence())?;
    Ok(())
}

/// The earthquake of a study; `name` is its file. A site that nobody named is left to the numbers
/// where the code alone assumes it.
fn of_study(study: Study, names_site: bool, name: Option<String>) -> Shaken {
    let target = study.ground.code_spectrum();
    let own = name.unwrap_or_else(|| "the built-in study".to_owned());
    let earthquake = match (&study.ground, target) {
        (Ground::Synthetic(_), Some(target)) => named(target, names_site, own),
        _ => NamedEarthquake::MotionsOfStudy {
            motions: study.ground.names(&study.levels).len(),
            study: own,
        },
    };
    Shaken {
        doubts: study.doubts.clone(),
        study,
        earthquake,
    }
}

fn named(target: &Target, names_site: bool, study: String) -> NamedEarthquake {
    let years = target.return_period_years();
    let has_ground_types = matches!(
        target.spectrum,
        CodeSpectrum::Eurocode8(_) | CodeSpectrum::Ntc2018(_)
    );
    let noun = if has_ground_types { "ground" } else { "site" };
    let site = target
        .spectrum
        .site_name()
        .filter(|_| names_site || !has_ground_types);
    let site = site.map(|site| format!("{noun} {site}"));
    match &target.place {
        Some(place) => NamedEarthquake::Place {
            name: place.short_name(),
            is_point: place.is_point(),
            code: place.hazard.code_title().to_owned(),
            years: years.or(match place.hazard {
                PlaceHazard::Shape {
                    return_period_years,
                    ..
                } => return_period_years,
                _ => None,
            }),
            site,
            is_approximate: place.confidence == Confidence::Approximate,
        },
        None => NamedEarthquake::Study {
            study,
            code: target.spectrum.name().to_owned(),
            years,
            site,
        },
    }
}

#[cfg(test)]
mod tests {
    use freestand_study::target::TargetDoubt;

    use super::*;
    use crate::one_object::Object;

    fn shaken_by(earthquake: Earthquake, seed: Option<u64>) -> Shaken {
        let object = Object::of_size(2.0, 0.3);
        let floor = Floor {
            place: FloorPlace::Ground,
            storeys: None,
            storey_height_m: None,
        };
        shaken(&ObjectRequest {
            object,
            earthquake,
            floor,
            worlds: Some(7),
            seed,
            units: freestand_input::quantity::UnitSystem::Si,
        })
        .unwrap()
    }

    /// The peak acceleration of the ground is the spectrum at T = 0, with the soil factor in it.
    #[test]
    fn a_ground_acceleration_is_the_value_at_no_period() {
        let found = shaken_by(
            Earthquake::GroundAcceleration {
                peak_m_s2: 0.4 * G0_M_S2,
                near_fault: None,
            },
            Some(5),
        );
        let target = found.study.ground.code_spectrum().unwrap();
        assert!(
            (target.spectrum.sa_g(0.0) - 0.4).abs() < 1e-15,
            "{}",
            target.spectrum.sa_g(0.0)
        );
        // 2.5 times on the plateau, at 5 % damping.
        assert!((target.spectrum.sa_g(0.3) - 1.0).abs() < 1e-15);
        let settings = &found.study.assessment;
        assert_eq!((found.study.ground.seed(), settings.seed), (Some(5), 5));
        assert_eq!(
            (settings.worlds.looks.first(), settings.worlds.looks.most()),
            (7, 7)
        );
    }

    /// On the ground, nothing is said about a building that nobody named.
    #[test]
    fn doubts_are_those_of_the_hazard() {
        let words = Words::from_iter([("place", "Athens".to_owned())]);
        let found = shaken_by(Earthquake::Place(words), None);
        assert!(
            matches!(
                found.doubts[..],
                [StudyDoubt::Target(TargetDoubt::Place(_))]
            ),
            "{:?}",
            found.doubts
        );
        assert!(found.study.doubts.len() > found.doubts.len());
    }
}
