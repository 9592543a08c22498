//! `summary.json`: the key figures of each level, and their provenance.

use freestand::rocking::Outcome;
use freestand::synthesis::{self, Misfit};
use serde::Serialize;
use serde_json::{Value, json};

use crate::building::{ModeReport, model_words};
use crate::cushion::cushion_words;
use crate::places::Place;
use crate::result::{LevelResult, ObjectResponse, Ranked, StudyResult};
use crate::simulated::{FoundEarthquake, Parameters};
use crate::statistics::ranked_quantile;
use crate::study::{
    BuildingInput, Ground, Level, RecordedMotion, SimulatedGround, Study, SyntheticGround,
};
use crate::target::{HazardOf, NamedFact, Target};
use freestand::G0_M_S2;
use freestand::building::Building;
use freestand::rocking::{Accuracy, Restitution};
use freestand_input::file::sha256_hex;
use freestand_output::answer::Input;
use freestand_output::answer_of;

/// Name and version of the document.
pub const SCHEMA: &str = "freestand.run/1";

/// The key figures of one level.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LevelSummary {
    /// Name of the level.
    pub level: String,
    /// Height as a share of the building's, if it is known.
    pub level_ratio: Option<f64>,
    /// Median over the motions of the peak floor acceleration \[g\].
    pub pfa_g_median: Option<f64>,
    /// Histories on this level: objects × motions.
    pub histories: usize,
    /// Histories that failed.
    pub failed: usize,
    /// Share of the histories in which the object uplifts.
    pub uplift_share: f64,
    /// Share of the histories in which the object overturns.
    pub overturned_share: f64,
    /// Objects that exceed the study's tolerance ([`crate::result::ObjectStatistics::exceeds`]);
    /// `None` without one.
    pub exceeded_objects: Option<usize>,
    /// Objects that half or more of the motions overturn.
    pub overturned_objects: usize,
    /// Largest shock of any history without overturning \[g\].
    pub edge_acceleration_g_max: Option<f64>,
    /// Largest median shock over the motions, of all objects whose median is a number \[g\].
    pub edge_acceleration_g_median: Option<f64>,
    /// Largest shock from the impact velocity of any history without overturning \[g\].
    pub edge_acceleration_impact_velocity_g_max: Option<f64>,
    /// The same median, of the shock from the impact velocity \[g\].
    pub edge_acceleration_impact_velocity_g_median: Option<f64>,
}

/// The key figures of every level.
pub fn level_summaries(study: &Study, result: &StudyResult) -> Vec<LevelSummary> {
    result
        .levels
        .iter()
        .map(|level| level_summary(level, study.objects.tolerance_m_s2))
        .collect()
}

/// The key figures of a level; `tolerance_m_s2` is the study's.
pub fn level_summary(level: &LevelResult, tolerance_m_s2: Option<f64>) -> LevelSummary {
    let mut pfa_g: Vec<f64> = level
        .floors
        .iter()
        .map(|floor| floor.peak_m_s2() / G0_M_S2)
        .collect();
    let rows = || level.responses.iter().flatten();
    let histories = rows().count();
    let count = |holds: &dyn Fn(Outcome) -> bool| {
        rows().filter(|r| matches!(r, ObjectResponse::Done { uplift, .. } if holds(uplift.rocking.outcome))).count()
    };
    let done = count(&|_| true);
    let share = |n: usize| {
        if done == 0 {
            0.0
        } else {
            n as f64 / done as f64
        }
    };
    let statistics = || level.statistics.iter().flatten();
    let largest = |values: &mut dyn Iterator<Item = f64>| values.reduce(f64::max);
    let shocks = |velocity: bool| {
        rows().filter_map(move |r| match r {
            ObjectResponse::Done { shock, .. } if velocity => {
                shock.edge_acceleration_impact_velocity_g
            }
            ObjectResponse::Done { shock, .. } => shock.edge_acceleration_g,
            ObjectResponse::FreeFlight(_) | ObjectResponse::Failed(_) => None,
        })
    };
    LevelSummary {
        level: level.level.name.clone(),
        level_ratio: level.level.level_ratio,
        pfa_g_median: ranked_quantile(&mut pfa_g, 0.5).value(),
        histories,
        failed: histories - done,
        uplift_share: share(count(&|o| o != Outcome::NoUplift)),
        overturned_share: share(count(&|o| o.has_fallen())),
        exceeded_objects: tolerance_m_s2.map(|tolerance| {
            statistics()
                .filter(|s| s.exceeds(tolerance / G0_M_S2))
                .count()
        }),
        overturned_objects: statistics()
            .filter(|s| s.edge_acceleration_g[1] == Ranked::Overturned)
            .count(),
        edge_acceleration_g_max: largest(&mut shocks(false)),
        edge_acceleration_g_median: largest(
            &mut statistics().filter_map(|s| s.edge_acceleration_g[1].value()),
        ),
        edge_acceleration_impact_velocity_g_max: largest(&mut shocks(true)),
        edge_acceleration_impact_velocity_g_median: largest(
            &mut statistics().filter_map(|s| s.edge_acceleration_impact_velocity_g[1].value()),
        ),
    }
}

/// The whole document.
pub fn summary(study: &Study, result: &StudyResult, files: &[String]) -> Value {
    let motions: Vec<Value> = result
        .ground
        .iter()
        .map(|ground| {
            json!({
                "motion": ground.name,
                "dt_s": ground.motion.along.dt_s(),
                "npts": ground.motion.along.accel_m_s2().len(),
                "components": if ground.motion.across.is_some() { 2 } else { 1 },
                "pga_g": ground.motion.peak_m_s2() / G0_M_S2,
                "vertical_pga_g": ground.vertical.as_ref().map(|vertical| vertical.peak_m_s2() / G0_M_S2),
                "misfit": ground.misfit.as_ref().map(OfMisfit),
            })
        })
        .collect();
    let objects = &study.objects;
    json!({
        "levels": level_summaries(study, result),
        "vary": result.sensitivity.as_ref().map(|sensitivity| json!({
            "rows": sensitivity.rows,
            "left_out": sensitivity.left_out,
        })),
        "definitions": {
            "pfa_g_median": "median over the motions of the peak floor acceleration, at the samples",
            "overturned_share": "histories in which the object overturns, as a share of all histories (object × \
                                 motion) that did not fail",
            "direction_deg": "for motions with two components: the direction, counted from the first component, in \
                              which the centre of gravity rises most, or the first direction that overturns the \
                              object; the shock from the impact velocity is the largest of all directions",
            "exceeded_objects": "objects whose median shock, by the larger of the two sources, is above the \
                                 tolerance, or that half or more of the motions overturn; null without a tolerance",
            "edge_acceleration_g_max": "largest shock of all histories without overturning, calculated from the uplift",
            "edge_acceleration_g_median": "largest median shock over all motions (no uplift counts as 0, overturned \
                as larger than any number), of all objects whose median is a number",
        },
        "inputs": {
            "study": study.source.as_ref().map_or_else(|| "built-in".to_owned(), |path| path.display().to_string()),
            "study_sha256": sha256_hex(study.toml.as_bytes()),
            "ground": ground_inputs(&study.ground),
            "suite": study.ground.suite(),
            "floor_motions": floor_inputs(study),
            "vertical": study.ground.vertical_words(),
            "vertical_amplification_ratio": study.vertical_amplification_ratio,
            "motions": motions,
            "directions_deg": study.directions_deg,
            "building": study.building.as_ref().map(|building| building_inputs(study.building_name.as_deref(), building)),
            "objects": {
                "heights_m": objects.heights_m,
                "thicknesses_m": objects.thicknesses_m,
                "mass_kg": objects.mass_kg,
                "stiffness_n_m": objects.cushion.cushion.linear_stiffness_n_m(),
                "law": objects.cushion.cushion.law().name(),
                "cushion": cushion_words(&objects.cushion.cushion),
                "cushion_notes": objects.cushion.notes,
                "cushion_file": objects.cushion_file.as_ref().map(|(file, _)| Input::from(file)),
                "restitution": restitution_words(objects.restitution),
                "accuracy": accuracy_words(objects.accuracy),
                "tolerance_m_s2": objects.tolerance_m_s2,
                "gravity_m_s2": G0_M_S2,
                "model": "paper",
            },
        },
        "seeds": study.ground.seed().map(|seed| json!({"ground": seed, "generator": synthesis::GENERATOR})),
        "versions": {"freestand": env!("CARGO_PKG_VERSION")},
        "files": files,
    })
}

fn building_inputs(name: Option<&str>, building: &BuildingInput) -> Value {
    let axis = |axis: &Building, note: Option<&str>| {
        json!({
            "model": model_words(axis),
            "period_s": axis.period_s(),
            "period_from": note,
            "damping_ratio": axis.damping_ratio(),
            "shear_flexure_ratio": axis.shear_flexure_ratio(),
            "modes": axis.modes().iter().map(ModeReport::from).collect::<Vec<_>>(),
        })
    };
    let mut inputs = json!({
        "name": name,
        "storeys": building.storeys,
        "storey_height_m": building.storey_height_m,
        "height_m": building.height_m,
    });
    if let (Some(inputs), Value::Object(along)) = (
        inputs.as_object_mut(),
        axis(&building.along, Some(&building.period_note)),
    ) {
        inputs.extend(along);
        let across = building
            .across
            .as_ref()
            .map(|across| axis(across, building.across_note.as_deref()));
        inputs.insert("across".to_owned(), across.unwrap_or_default());
        inputs.insert(
            "tables".to_owned(),
            building
                .tables
                .iter()
                .map(|(_, table)| json!(Input::from(&table.file)))
                .collect(),
        );
    }
    inputs
}

fn ground_inputs(ground: &Ground) -> Value {
    match ground {
        Ground::Synthetic(synthetic) => json!(SyntheticInputs(synthetic)),
        Ground::Simulated(simulated) => json!(SimulatedInputs(simulated)),
        Ground::Recorded(records) => records.iter().map(recorded_input).collect(),
        Ground::OnFloors => Value::Null,
    }
}

/// How well a motion fits its target.
#[derive(Clone, Copy)]
struct OfMisfit<'r>(&'r Misfit);

answer_of!(OfMisfit<'_> as misfit {
    rms_ratio: f64 = misfit.0.rms_ratio;
    worst_ratio: f64 = misfit.0.worst_ratio;
    worst_period_s: f64 = misfit.0.worst_period_s;
    pga_g: f64 = misfit.0.pga_g;
    target_zpa_g: f64 = misfit.0.target_zpa_g;
    d5_95_s: f64 = misfit.0.d5_95_s;
    pgv_m_s: f64 = misfit.0.pgv_m_s;
});

/// Synthetic motions of a study.
#[derive(Clone, Copy)]
struct SyntheticInputs<'s>(&'s SyntheticGround);

answer_of!(SyntheticInputs<'_> as of {
    code: &'static str = of.0.target.code();
    edition: &'static str = of.0.target.spectrum.name();
    site: Option<&'static str> = of.0.target.spectrum.site_name();
    city: Option<String> = of.0.target.place_name();
    place: Option<&'static Place> = of.0.target.place;
    hazard: HazardOf<'_> = HazardOf(Some(&of.0.target)) => flat;
    facts: Vec<NamedFact<'_>> = of.0.target.named_facts();
    spectrum_file: Option<Input> = of.0.target.file.as_ref().map(Input::from);
    count: usize = of.0.count;
    seed: u64 = of.0.seed;
});

/// Simulated motions of a study.
#[derive(Clone, Copy)]
struct SimulatedInputs<'s>(&'s SimulatedGround);

answer_of!(SimulatedInputs<'_> as of {
    preset: &'static str = of.0.request.preset.name();
    parameters: Parameters = Parameters(of.0.request.any_source());
    earthquakes: Vec<&FoundEarthquake> = of.0.earthquakes.iter().collect();
    site: &'static str = of.0.request.site.name();
    city: Option<String> = of.0.hazard.as_ref().and_then(Target::place_name);
    hazard: HazardOf<'_> = HazardOf(of.0.hazard.as_ref()) => flat;
    dt_s: f64 = of.0.request.options.dt_s;
    low_cut_hz: f64 = of.0.request.options.low_cut_hz;
    assumptions: Vec<String> = of.0.request.assumptions();
    count: u64 = of.0.request.count;
    seed: u64 = of.0.request.seed;
    generator: &'static str = synthesis::GENERATOR;
});

/// The files of each level, if the motions of floors are given.
fn floor_inputs(study: &Study) -> Value {
    if !matches!(study.ground, Ground::OnFloors) {
        return Value::Null;
    }
    let level = |level: &Level| json!({"level": level.name, "motions": level.motions.iter().map(recorded_input).collect::<Vec<_>>()});
    study.levels.iter().map(level).collect()
}

fn recorded_input(record: &RecordedMotion) -> Value {
    let across = record
        .across
        .as_ref()
        .map(|second| second.file.as_ref().map(Input::from));
    json!({
        "motion": record.name,
        "path": record.path.display().to_string(),
        "sha256": record.sha256,
        "description": record.description,
        "across": across,
        "vertical": record.vertical.as_ref().map(|vertical| vertical.file.as_ref().map(Input::from)),
        "scale_ratio": record.scale_ratio,
        "station_xml": record.station_xml.iter().map(Input::from).collect::<Vec<_>>(),
        "scale_target": record.scale_target.as_ref().map(Input::from),
        "processing": record.processing,
        "matched": record.matched.as_ref().map(|matched| json!({
            "method": matched.method.name(),
            "target": matched.target.one_line(),
            "facts": matched.target.named_facts(),
            "spectrum_file": matched.target.file.as_ref().map(Input::from),
            "correlation_ratio": matched.resemblance.correlation_ratio,
            "husid_difference_ratio": matched.resemblance.husid_difference_ratio,
        })),
    })
}

/// A restitution in outputs.
pub fn restitution_words(restitution: Restitution) -> String {
    match restitution {
        Restitution::Housner => "Housner".to_owned(),
        Restitution::Value(value) => value.to_string(),
        Restitution::Factor(factor) => format!("{factor} × Housner"),
    }
}

/// An accuracy in outputs.
pub fn accuracy_words(accuracy: Accuracy) -> String {
    accuracy
        .name()
        .map_or_else(|| accuracy.tolerance().to_string(), str::to_owned)
}
