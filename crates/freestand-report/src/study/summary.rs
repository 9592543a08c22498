//! `summary.json`: the key figures of each level, and their provenance.

use freestand::G0_M_S2;
use freestand::building::Building;
use freestand::rocking::Restitution;
use freestand::synthesis::{self, Misfit};
use freestand_input::file::sha256_hex;
use freestand_output::answer::{Described, Input};
use freestand_output::answer_of;
use freestand_output::facts::Value;
use freestand_study::building::{ModeReport, PeriodFrom, model_words};
use freestand_study::cushion::cushion_words;
use freestand_study::matched::Matched;
use freestand_study::places::Place;
use freestand_study::result::{GroundMotion, StudyResult};
use freestand_study::simulated::FoundEarthquake;
use freestand_study::study::{
    BuildingInput, Ground, Level, Objects, RecordedMotion, SecondComponent, SimulatedGround, Study,
    SyntheticGround,
};
use freestand_study::suite::Suite;
use freestand_study::summary::{LevelSummary, accuracy_words};
use freestand_study::target::Target;
use serde_json::{Value as Json, json};

use super::sensitivity::Varied;
use crate::doubts::{cushion_notes, period_from};
use crate::ground::{Parameters, assumptions, vertical_motion};
use crate::target::{HazardOf, NamedFact, named_facts};

/// Name and version of the document.
pub const SCHEMA: &str = "freestand.run/1";

/// The whole document.
#[derive(Debug, Clone, Copy)]
pub struct Summary<'r> {
    /// What was run.
    pub study: &'r Study,
    /// What came out.
    pub result: &'r StudyResult,
    /// The key figures of each level.
    pub levels: &'r [LevelSummary],
    /// The names of the files that are written.
    pub files: &'r [String],
}

answer_of!(Summary<'_> as of {
    levels: Vec<LevelSummary> = of.levels.to_vec();
    /// What each change did, where one value was changed at a time.
    vary: Option<Varied<'_>> = of.result.sensitivity.as_ref().map(Varied);
    definitions: Definitions = Definitions;
    inputs: Inputs<'_> = Inputs(of.study, of.result);
    /// The seed of motions that were made.
    seeds: Option<Seeds> = of.study.ground.seed().map(Seeds);
    versions: Versions = Versions;
    files: Vec<String> = of.files.to_vec();
});

/// What a run answers: its summary, and where its files are.
#[derive(Debug, Clone)]
pub struct RunAnswer<'r> {
    /// The document that is among its files.
    pub summary: Summary<'r>,
    /// The folder.
    pub out: String,
}

answer_of!(RunAnswer<'_> as of {
    summary: Summary<'_> => flat;
    /// The folder.
    out: String;
});

/// What the names of key figures mean.
#[derive(Clone, Copy)]
struct Definitions;

answer_of!(Definitions as _of {
    pfa_g_median: &'static str =
        "median over the motions of the peak floor acceleration, at the samples";
    overturned_share: &'static str =
        "histories in which the object overturns, as a share of all histories (object × motion) that did not fail";
    direction_deg: &'static str =
        "for motions with two components: the direction, counted from the first component, in which the centre of \
         gravity rises most, or the first direction that overturns the object; the shock from the impact velocity \
         is the largest of all directions";
    exceeded_objects: &'static str =
        "objects whose median shock, by the larger of the two sources, is above the tolerance, or that half or more \
         of the motions overturn; null without a tolerance";
    edge_acceleration_g_max: &'static str =
        "largest shock of all histories without overturning, calculated from the uplift";
    edge_acceleration_g_median: &'static str =
        "largest median shock over all motions (no uplift counts as 0, overturned as larger than any number), of \
         all objects whose median is a number";
});

/// The seed of synthetic or simulated motions.
#[derive(Clone, Copy)]
struct Seeds(u64);

answer_of!(Seeds as of {
    ground: u64 = of.0;
    generator: &'static str = synthesis::GENERATOR;
});

/// Of the program.
#[derive(Clone, Copy)]
struct Versions;

answer_of!(Versions as _of {
    freestand: &'static str = env!("CARGO_PKG_VERSION");
});

answer_of!(
    /// What a study was run with.
    struct Inputs<'r>(&'r Study, &'r StudyResult) as of.0 {
    study: String =
        of.0.source.as_ref().map_or_else(|| "built-in".to_owned(), |path| path.display().to_string());
    study_sha256: String = sha256_hex(of.0.toml.as_bytes());
    /// Parameters of motions that were made, or each record; null where the motions of floors are given.
    ground: GroundInputs<'_> = GroundInputs(&of.0.ground);
    suite: Option<&Suite> = of.0.ground.suite();
    /// The files of each level, where the motions of floors are given.
    floor_motions: Option<Vec<FloorInputs<'_>>> =
        matches!(of.0.ground, Ground::OnFloors).then(|| of.0.levels.iter().map(FloorInputs).collect());
    vertical: String = vertical_motion(&of.0.ground);
    vertical_amplification_ratio: f64;
    motions: Vec<OfMotion<'_>> = of.1.ground.iter().map(OfMotion).collect();
    /// In which every object is tried.
    directions_deg: Vec<f64>;
    building: Option<BuildingInputs<'_>> =
        of.0.building.as_ref().map(|building| BuildingInputs(of.0.building_name.as_deref(), building));
    objects: ObjectInputs<'_> = ObjectInputs(&of.0.objects);
});

answer_of!(
    /// A ground motion as used.
    struct OfMotion<'r>(&'r GroundMotion) as of {
    motion: String = of.0.name.clone();
    dt_s: f64 = of.0.motion.along.dt_s();
    npts: usize = of.0.motion.along.accel_m_s2().len();
    components: usize = if of.0.motion.across.is_some() { 2 } else { 1 };
    pga_g: f64 = of.0.motion.peak_m_s2() / G0_M_S2;
    vertical_pga_g: Option<f64> = of.0.vertical.as_ref().map(|vertical| vertical.peak_m_s2() / G0_M_S2);
    /// How well it fits its target, if it has one.
    misfit: Option<OfMisfit<'_>> = of.0.misfit.as_ref().map(OfMisfit);
});

answer_of!(
    /// The grid of objects.
    struct ObjectInputs<'s>(&'s Objects) as of.0 {
    heights_m: Vec<f64>;
    thicknesses_m: Vec<f64>;
    mass_kg: f64;
    stiffness_n_m: Option<f64> = of.0.cushion.cushion.linear_stiffness_n_m();
    law: &'static str = of.0.cushion.cushion.law().name();
    cushion: String = cushion_words(&of.0.cushion.cushion);
    cushion_notes: Vec<String> = cushion_notes(&of.0.cushion.notes);
    cushion_file: Option<Input> = of.0.cushion_file.as_ref().map(|(file, _)| Input::from(file));
    restitution: String = restitution_words(of.0.restitution);
    accuracy: String = accuracy_words(of.0.accuracy);
    tolerance_m_s2: Option<f64>;
    gravity_m_s2: f64 = G0_M_S2;
    model: &'static str = "paper";
});

answer_of!(
    /// The building, with its name.
    struct BuildingInputs<'s>(Option<&'s str>, &'s BuildingInput) as of {
    name: Option<String> = of.0.map(str::to_owned);
    storeys: usize = of.1.storeys;
    storey_height_m: Option<f64> = of.1.storey_height_m;
    height_m: f64 = of.1.height_m;
    along: AxisInputs<'_> = AxisInputs(&of.1.along, Some(of.1.period_from)) => flat;
    /// Along its second axis, if that differs.
    across: Option<AxisInputs<'_>> =
        of.1.across.as_ref().map(|across| AxisInputs(across, of.1.across_from));
    tables: Vec<Input> = of.1.tables.iter().map(|table| Input::from(&table.file)).collect();
});

answer_of!(
    /// A building along an axis, and what its period is from.
    struct AxisInputs<'s>(&'s Building, Option<PeriodFrom>) as of {
    model: String = model_words(of.0);
    period_s: f64 = of.0.period_s();
    period_from: Option<String> = of.1.as_ref().map(period_from);
    damping_ratio: Option<f64> = of.0.damping_ratio();
    shear_flexure_ratio: Option<f64> = of.0.shear_flexure_ratio();
    modes: Vec<ModeReport> = of.0.modes().iter().cloned().map(ModeReport).collect();
});

/// Where the motions of a study are from.
#[derive(Clone, Copy)]
struct GroundInputs<'s>(&'s Ground);

impl Described for GroundInputs<'_> {
    fn schema() -> Json {
        let recorded = Option::<Vec<RecordedInput<'_>>>::schema();
        json!({"anyOf": [SyntheticInputs::schema(), SimulatedInputs::schema(), recorded]})
    }
}

impl From<GroundInputs<'_>> for Value<'static> {
    fn from(GroundInputs(ground): GroundInputs<'_>) -> Self {
        match ground {
            Ground::Synthetic(synthetic) => SyntheticInputs(synthetic).into(),
            Ground::Simulated(simulated) => SimulatedInputs(simulated).into(),
            Ground::Recorded(records) => recorded(records).into(),
            Ground::OnFloors => Self::Missing,
        }
    }
}

answer_of!(
    /// How well a motion fits its target.
    struct OfMisfit<'r>(&'r Misfit) as misfit.0 {
    rms_ratio: f64;
    worst_ratio: f64;
    worst_period_s: f64;
    pga_g: f64;
    target_zpa_g: f64;
    d5_95_s: f64;
    pgv_m_s: f64;
});

answer_of!(
    /// Synthetic motions of a study.
    struct SyntheticInputs<'s>(&'s SyntheticGround) as of.0 {
    code: &'static str = of.0.target.code();
    edition: &'static str = of.0.target.spectrum.name();
    site: Option<&'static str> = of.0.target.spectrum.site_name();
    city: Option<String> = of.0.target.place_name();
    place: Option<&Place> = of.0.target.place.as_ref();
    hazard: HazardOf<'_> = HazardOf(Some(&of.0.target)) => flat;
    facts: Vec<NamedFact<'_>> = named_facts(&of.0.target);
    spectrum_file: Option<Input> = of.0.target.file.as_ref().map(Input::from);
    count: usize;
    seed: u64;
});

answer_of!(
    /// Simulated motions of a study.
    struct SimulatedInputs<'s>(&'s SimulatedGround) as of {
    preset: &'static str = of.0.request.preset.name();
    parameters: Parameters = Parameters(of.0.request.any_source());
    earthquakes: Vec<&FoundEarthquake> = of.0.earthquakes.iter().collect();
    site: &'static str = of.0.request.site.name();
    city: Option<String> = of.0.hazard.as_ref().and_then(Target::place_name);
    hazard: HazardOf<'_> = HazardOf(of.0.hazard.as_ref()) => flat;
    dt_s: f64 = of.0.request.options.dt_s;
    low_cut_hz: f64 = of.0.request.options.low_cut_hz;
    assumptions: Vec<String> = assumptions(&of.0.request);
    count: u64 = of.0.request.count;
    seed: u64 = of.0.request.seed;
    generator: &'static str = synthesis::GENERATOR;
});

answer_of!(
    /// The files of a level.
    struct FloorInputs<'s>(&'s Level) as of {
    level: String = of.0.name.clone();
    motions: Vec<RecordedInput<'_>> = recorded(&of.0.motions);
});

fn recorded(records: &[RecordedMotion]) -> Vec<RecordedInput<'_>> {
    records.iter().map(RecordedInput).collect()
}

answer_of!(
    /// A record of a study.
    struct RecordedInput<'s>(&'s RecordedMotion) as of.0 {
    motion: String = of.0.name.clone();
    path: String = of.0.path.display().to_string();
    sha256: String;
    description: String;
    /// The file of its second component, if that is another.
    across: Option<Input> = file(of.0.across.as_ref());
    /// The file of its vertical component, if that is another.
    vertical: Option<Input> = file(of.0.vertical.as_ref());
    scale_ratio: f64;
    station_xml: Vec<Input> = of.0.station_xml.iter().map(Input::from).collect();
    scale_target: Option<Input> = of.0.scale_target.as_ref().map(Input::from);
    processing: Vec<String>;
    matched: Option<MatchedInputs<'_>> = of.0.matched.as_ref().map(MatchedInputs);
});

fn file(component: Option<&SecondComponent>) -> Option<Input> {
    component?.file.as_ref().map(Input::from)
}

answer_of!(
    /// The spectrum that a record was matched to.
    struct MatchedInputs<'s>(&'s Matched) as of {
    method: &'static str = of.0.method.name();
    target: String = of.0.target.one_line();
    facts: Vec<NamedFact<'_>> = named_facts(&of.0.target);
    spectrum_file: Option<Input> = of.0.target.file.as_ref().map(Input::from);
    /// Of the accelerations before and after.
    correlation_ratio: f64 = of.0.resemblance.correlation_ratio;
    /// The largest difference of the shares of energy that have arrived.
    husid_difference_ratio: f64 = of.0.resemblance.husid_difference_ratio;
});

/// A restitution in outputs.
pub(super) fn restitution_words(restitution: Restitution) -> String {
    match restitution {
        Restitution::Housner => "Housner".to_owned(),
        Restitution::Value(value) => value.to_string(),
        Restitution::Factor(factor) => format!("{factor} × Housner"),
        Restitution::Edges([right, left]) => format!("{right} and {left}"),
    }
}
