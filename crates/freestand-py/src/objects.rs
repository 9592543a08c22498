//! One object: whether it falls over, and how strongly it must be held.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::Ordering;

use freestand::G0_M_S2;
use freestand_assess::inventory::{CASTERS, Surroundings, UpperBody};
use freestand_assess::one_object::{
    Earthquake, Floor, FloorPlace, Object, ObjectRequest, RestsOn, SCHEMA, StudySource, Withstood,
    one_object,
};
use freestand_assess::restrain::{
    DEFAULT_ANCHORS_PER_EDGE, RestrainFactors, RestrainFloor, RestrainHazard, RestrainListRequest,
    RestrainRequest, restrain as restrained, restrain_list as restrained_list,
};
use freestand_input::keys::Words;
use freestand_input::problem::Problem;
use freestand_input::quantity::UnitSystem;
use freestand_study::resolve::Overrides;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arguments::{Given, told};
use crate::assess::study_of;
use crate::errors::{raised, raised_all, raised_by};
use crate::motion::Record;
use crate::work::watched;

/// Arguments of `check_object` that are named otherwise in the command.
const ARGUMENTS: &[(&str, &str)] = &[
    ("on", "cushion"),
    ("wall_gap", "wall_gap_m"),
    ("neighbour_gap", "neighbour_gap_m"),
    ("wall_height", "wall_height_m"),
    ("wall_stiffness", "wall_stiffness_n_m"),
    ("clearance", "clearance_m"),
    ("upper_height", "upper_height_m"),
    ("upper_thickness", "upper_thickness_m"),
    ("upper_mass", "upper_mass_kg"),
];

/// Exactly one earthquake is named.
fn check_one(given: &mut Given<'_, '_>, named: &[(&'static str, bool)]) {
    let names: Vec<&str> = named
        .iter()
        .filter(|(_, is_named)| *is_named)
        .map(|(name, _)| *name)
        .collect();
    match names.as_slice() {
        [_] => {}
        [] => {
            let all: Vec<&str> = named.iter().map(|(name, _)| *name).collect();
            given.push(Problem::value(
                "no earthquake is named",
                format!("give one of {}", all.join(", ")),
            ));
        }
        several => {
            let message = format!("{} name different earthquakes", several.join(" and "));
            given.push(Problem::value(message, "keep one of them"));
        }
    }
}

/// What is beside an object and on it.
fn surroundings(given: &mut Given<'_, '_>) -> Surroundings {
    let [height_m, thickness_m, mass_kg] =
        ["upper_height_m", "upper_thickness_m", "upper_mass_kg"].map(|name| given.positive(name));
    let upper = height_m
        .zip(thickness_m)
        .map(|(height_m, thickness_m)| UpperBody {
            height_m,
            thickness_m,
            mass_kg,
        });
    if upper.is_none() && (height_m.is_some() || thickness_m.is_some() || mass_kg.is_some()) {
        let message = "what stands on the object lacks its height or its thickness";
        given.push(Problem::value(
            message,
            "give upper_height_m and upper_thickness_m, or leave out all three",
        ));
    }
    Surroundings {
        wall_gap_m: given.non_negative("wall_gap_m"),
        neighbour_gap_m: given.non_negative("neighbour_gap_m"),
        wall_height_m: given.positive("wall_height_m"),
        wall_stiffness_n_m: given.positive("wall_stiffness_n_m"),
        wall_restitution: given.non_negative("wall_restitution"),
        casters: given.choice("casters", CASTERS),
        rolling_resistance_ratio: given.positive("rolling_resistance"),
        clearance_m: given.non_negative("clearance_m"),
        upper,
    }
}

/// The sentence about one object, and the numbers behind it.
#[pyfunction]
pub(crate) fn check_object(
    py: Python<'_>,
    motions: Vec<PyRef<'_, Record>>,
    values: &Bound<'_, PyDict>,
    threads: Option<usize>,
) -> PyResult<String> {
    let mut given = Given::new(values);
    let hazard: Words = given.words("hazard");
    let has_place = hazard.get("place").is_some();
    let file = given.path("study").map(StudySource::File);
    let (peak_g, study) = (
        given.positive("pga_g"),
        file.or(given.text("study_text").map(StudySource::Text)),
    );
    let named = [
        ("place", has_place && study.is_none()),
        ("pga_g", peak_g.is_some()),
        ("study", study.is_some()),
        ("motions", !motions.is_empty()),
    ];
    check_one(&mut given, &named);
    let has_site = hazard.get("site").is_some() || hazard.get("return_period_years").is_some();
    if has_site && !has_place && study.is_none() {
        let message = "site and return_period_years belong to the code of a place";
        given.push(Problem::value(message, "give place, or leave them out"));
    }
    let scales = given.numbers("scales");
    if scales.is_some() && motions.is_empty() {
        given.push(Problem::value(
            "scales applies to motions of the floor",
            "give motions, or leave scales out",
        ));
    }
    let rests_on = given.text("cushion").map(RestsOn::Entry);
    let rests_on = rests_on.or(given.positive("stiffness_n_m").map(RestsOn::Stiffness));
    let duration_s = given.positive("tolerance_duration_s");
    let tolerance = given.positive("tolerance_g");
    let tolerance = tolerance.map(|of_g| Withstood {
        peak_m_s2: of_g * G0_M_S2,
        duration_s,
    });
    let (height, thickness) = (given.positive("height_m"), given.positive("thickness_m"));
    let (width_m, cg_height_m) = (given.positive("width_m"), given.positive("cg_height_m"));
    let shape = given.text("shape");
    if let Some(other) = shape
        .as_deref()
        .filter(|shape| !["box", "cylinder"].contains(shape))
    {
        given.push(Problem::value(
            format!("shape \"{other}\" is not known"),
            "give \"box\" or \"cylinder\"",
        ));
    }
    let mass_kg = given.positive("mass_kg");
    let friction_ratio = given.range("friction");
    let surroundings = surroundings(&mut given);
    let place = match (given.text("floor"), given.number("level_ratio")) {
        (Some(_), Some(_)) => {
            let message = "floor and level_ratio are two ways to name the floor";
            given.push(Problem::value(message, "keep one of them"));
            FloorPlace::Ground
        }
        (Some(name), None) => FloorPlace::Name(name),
        (None, Some(ratio)) => FloorPlace::Share(ratio),
        (None, None) => FloorPlace::Ground,
    };
    let storeys = given
        .whole("storeys", 1)
        .map(|storeys| u16::try_from(storeys).unwrap_or(u16::MAX));
    let storey_height_m = given.positive("storey_height_m");
    let worlds = given
        .whole("worlds", 1)
        .map(|worlds| u32::try_from(worlds).unwrap_or(u32::MAX));
    let seed = given.whole("seed", 0);
    given.finish()?;
    let Some((height_m, thickness_m)) = height.zip(thickness) else {
        return Err(raised(Problem::value(
            "the size of the object is missing",
            "give height_m and thickness_m",
        )));
    };
    let earthquake = match (study, peak_g) {
        (Some(source), _) => Earthquake::Study { source, hazard },
        (None, Some(of_g)) => Earthquake::GroundAcceleration(of_g * G0_M_S2),
        (None, None) if motions.is_empty() => Earthquake::Place(hazard),
        (None, None) => Earthquake::Motions {
            motions: motions.iter().map(|record| record.read.clone()).collect(),
            scales: scales.unwrap_or_default(),
        },
    };
    let request = ObjectRequest {
        object: Object {
            height_m,
            thickness_m,
            width_m,
            is_round: shape.as_deref() == Some("cylinder"),
            cg_height_m,
            mass_kg,
            rests_on,
            tolerance,
            friction_ratio,
            surroundings,
        },
        earthquake,
        floor: Floor {
            place,
            storeys,
            storey_height_m,
        },
        worlds,
        seed,
        units: UnitSystem::Si,
    };
    let report = watched(py, threads, |stop| {
        one_object(&request, &|| stop.load(Ordering::Relaxed))
    })?;
    let report = report.map_err(|problems| raised_by(ARGUMENTS, problems))?;
    told(SCHEMA, &report.facts, &report.warnings)
}

/// What shakes objects that are held, and the factors of the clause.
struct Shaken<'py> {
    values: Bound<'py, PyDict>,
    hazard: Words,
    acceleration_g: Option<f64>,
    floor: RestrainFloor,
    factors: RestrainFactors,
}

impl<'py> Shaken<'py> {
    fn read(given: &mut Given<'_, 'py>, values: &Bound<'py, PyDict>) -> PyResult<Self> {
        let hazard = given.words("hazard");
        let acceleration_g = given.positive("floor_acceleration_g");
        let has_study = has_study(values)?;
        let named = [
            ("place or code", !hazard.is_empty() && !has_study),
            ("study", has_study),
            ("floor_acceleration_g", acceleration_g.is_some()),
        ];
        check_one(given, &named);
        let floor = RestrainFloor {
            name: given.text("floor"),
            level_ratio: given.number("level_ratio"),
            storeys: given.count("storeys"),
            storey_height_m: given.positive("storey_height_m"),
        };
        let factors = RestrainFactors {
            importance_ratio: given.positive("importance_ratio"),
            amplification_ratio: given.positive("amplification_ratio"),
            response_ratio: given.positive("response_ratio"),
            resonance_ratio: given.positive("resonance_ratio"),
            strength_ratio: given.positive("strength_ratio"),
            building_ductility_ratio: given.positive("building_ductility_ratio"),
        };
        Ok(Self {
            values: values.clone(),
            hazard,
            acceleration_g,
            floor,
            factors,
        })
    }

    /// The hazard; what is wrong with the values was told before.
    fn hazard(&self) -> PyResult<RestrainHazard> {
        if has_study(&self.values)? {
            let overrides = Overrides {
                hazard: self.hazard.clone(),
                ..Overrides::default()
            };
            return Ok(RestrainHazard::Study(Arc::new(study_of(
                &self.values,
                &overrides,
            )?)));
        }
        let code = || RestrainHazard::Code(self.hazard.clone());
        Ok(self
            .acceleration_g
            .map_or_else(code, RestrainHazard::FloorAcceleration))
    }
}

fn has_study(values: &Bound<'_, PyDict>) -> PyResult<bool> {
    Ok(values.contains("study")? || values.contains("study_text")?)
}

/// The force that a restraint has to carry: the document, and a sheet to print (HTML).
#[pyfunction]
pub(crate) fn restrain(py: Python<'_>, values: &Bound<'_, PyDict>) -> PyResult<(String, String)> {
    let mut given = Given::new(values);
    let shaken = Shaken::read(&mut given, values)?;
    let (mass, height, thickness) = (
        given.positive("mass_kg"),
        given.positive("height_m"),
        given.positive("thickness_m"),
    );
    let (width_m, cg_height_m) = (given.positive("width_m"), given.positive("cg_height_m"));
    let anchors_per_edge = given
        .count("anchors_per_edge")
        .unwrap_or(DEFAULT_ANCHORS_PER_EDGE.get());
    let is_compared = given.flag("compare");
    let (component, anchor_inset_m) = (
        given.text("component"),
        given.non_negative("anchor_inset_m"),
    );
    given.finish()?;
    let (Some(mass_kg), Some(height_m), Some(thickness_m)) = (mass, height, thickness) else {
        let hint = "give mass_kg, height_m and thickness_m";
        return Err(raised(Problem::value(
            "the mass or the size of the object is missing",
            hint,
        )));
    };
    let request = RestrainRequest {
        mass_kg,
        height_m,
        thickness_m,
        width_m,
        cg_height_m,
        hazard: shaken.hazard()?,
        floor: shaken.floor,
        factors: shaken.factors,
        component,
        anchor_inset_m,
        units: UnitSystem::Si,
        anchors_per_edge,
        is_compared,
    };
    let report = watched(py, None, |_| restrained(request))?.map_err(raised_all)?;
    let document = report.facts.clone().key("sheet", None::<String>);
    Ok((
        told("freestand.restrain/1", &document, &report.warnings)?,
        report.sheet,
    ))
}

/// The forces that the restraints of all objects of a list have to carry.
#[pyfunction]
pub(crate) fn restrain_list(
    py: Python<'_>,
    list: PathBuf,
    values: &Bound<'_, PyDict>,
) -> PyResult<String> {
    let mut given = Given::new(values);
    let shaken = Shaken::read(&mut given, values)?;
    let cells = given.cells();
    let anchors_per_edge = given
        .count("anchors_per_edge")
        .unwrap_or(DEFAULT_ANCHORS_PER_EDGE.get());
    let anchor_inset_m = given.non_negative("anchor_inset_m");
    given.finish()?;
    let request = RestrainListRequest {
        list,
        cells,
        hazard: shaken.hazard()?,
        floor: shaken.floor,
        factors: shaken.factors,
        anchor_inset_m,
        anchors_per_edge,
        units: Some(UnitSystem::Si),
    };
    let report = watched(py, None, |_| restrained_list(&request))?.map_err(raised_all)?;
    told("freestand.restrain/1", &report.facts(), &report.warnings)
}
