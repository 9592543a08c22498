//! How strongly one object must be held: the force that a code asks for, the anchors.
//! The numbers are those of `assess`, from the same function (`restraint`).

mod list;

pub use crate::restraint::anchors::{Anchor, AnchorForces};
pub use crate::restraint::components::Component;
pub use crate::restraint::footing::Pivot;
pub use list::{HeldItem, HeldList, Missing, NotHeld, RestrainListRequest, restrain_list};

use std::num::NonZeroUsize;
use std::sync::Arc;

use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::code_spectrum::part_forces::LEAST_BUILDING_DUCTILITY_RATIO;
use freestand::code_spectrum::{Asce7Edition, CodeSpectrum};
use freestand_input::keys::Words;
use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::{UnitSystem, shorten};
use freestand_study::building::{DEFAULT_STOREY_HEIGHT_M, MAX_STOREYS};
use freestand_study::doubt::UnlikelySize;
use freestand_study::places::Place;
use freestand_study::shape::{Shape, Sizes};
use freestand_study::study::Study;
use freestand_study::study::assessment::RestraintSettings;
use freestand_study::target::{Target, TargetDoubt};

use crate::axis::Axis;
use crate::list::floors_of;
use crate::restraint::anchors::of_each_anchor;
use crate::restraint::force::RestraintForce;
use crate::restraint::source::SourceKind;
use crate::restraint::{HeldObject, RestraintAxis, RestraintQuestion, restraint_forces};
use freestand_inventory::{Floors, level_of_floor};

/// Factors of any code.
const FACTORS: std::ops::RangeInclusive<f64> = 0.1..=20.0;

/// Anchors along each of the two edges, where their number is not given.
pub const DEFAULT_ANCHORS_PER_EDGE: NonZeroUsize = NonZeroUsize::MIN.saturating_add(1);

/// One object and what shakes it.
#[derive(Debug, Clone, PartialEq)]
pub struct RestrainRequest {
    /// Mass \[kg\].
    pub mass_kg: f64,
    /// Height \[m\].
    pub height_m: f64,
    /// Horizontal size across one pair of anchored edges \[m\].
    pub thickness_m: f64,
    /// Horizontal size across the other pair; `None`: only the thickness is checked \[m\].
    pub width_m: Option<f64>,
    /// Height of the centre of gravity; `None`: half of the height \[m\].
    pub cg_height_m: Option<f64>,
    /// The hazard.
    pub hazard: RestrainHazard,
    /// The floor.
    pub floor: RestrainFloor,
    /// Factors that take the place of those of the code, and of the study.
    pub factors: RestrainFactors,
    /// What the object is, by the name of a row of the tables of ASCE 7 or in words; `None`: not known.
    pub component: Option<String>,
    /// The anchors.
    pub anchors: Anchors,
    /// The units of the texts and of the sheet; those of names such as `force_n` do not change.
    pub units: UnitSystem,
    /// Whether other codes are shown too.
    pub is_compared: bool,
}

/// The anchors of an object.
#[derive(Debug, Clone, PartialEq)]
pub struct Anchors {
    /// Distance of the anchors from the edge that they hold down; `None`: that of the study, else
    /// assumed \[m\].
    pub inset_m: Option<f64>,
    /// The line about which the object tips.
    pub pivot: Pivot,
    /// Anchors along each of the two edges.
    pub per_edge: usize,
    /// The anchor that the user has chosen.
    pub chosen: Option<Anchor>,
}

impl Default for Anchors {
    fn default() -> Self {
        Self {
            inset_m: None,
            pivot: Pivot::default(),
            per_edge: DEFAULT_ANCHORS_PER_EDGE.get(),
            chosen: None,
        }
    }
}

/// Where the force comes from.
#[derive(Debug, Clone, PartialEq)]
pub enum RestrainHazard {
    /// The code and the building of a study.
    Study(Arc<Study>),
    /// The code that these words name, or the one of the place that they name.
    Code(Words),
    /// F = m a, with this acceleration of the floor \[g\].
    FloorAcceleration(f64),
}

/// The floor of the object; without a name or a ratio, the ground.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RestrainFloor {
    /// Its name or number; floor 1 is the first above the ground.
    pub name: Option<String>,
    /// Its height over that of the building.
    pub level_ratio: Option<f64>,
    /// Number of storeys.
    pub storeys: Option<usize>,
    /// Height of a storey \[m\].
    pub storey_height_m: Option<f64>,
}

/// Factors that the user states; `None`: those of the study, else those of the code.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct RestrainFactors {
    /// I_p, I_c, γ_a, R_p of NZS 1170.5.
    pub importance_ratio: Option<f64>,
    /// a_p, a_c, C_i; of EN 1998-1 and of a floor acceleration A.
    pub amplification_ratio: Option<f64>,
    /// R_p, R_c, q_a, 1/C_ph.
    pub response_ratio: Option<f64>,
    /// C_AR of ASCE 7-22.
    pub resonance_ratio: Option<f64>,
    /// R_po of ASCE 7-22.
    pub strength_ratio: Option<f64>,
    /// R_μ of ASCE 7-22.
    pub building_ductility_ratio: Option<f64>,
}

impl RestrainFactors {
    /// The settings with these factors in place of theirs.
    fn over(self, settings: RestraintSettings) -> RestraintSettings {
        RestraintSettings {
            importance_ratio: self.importance_ratio.or(settings.importance_ratio),
            amplification_ratio: self.amplification_ratio.or(settings.amplification_ratio),
            response_ratio: self.response_ratio.or(settings.response_ratio),
            resonance_ratio: self
                .resonance_ratio
                .or(self.amplification_ratio)
                .or(settings.resonance_ratio),
            strength_ratio: self
                .strength_ratio
                .or(self.response_ratio)
                .or(settings.strength_ratio),
            building_ductility_ratio: self
                .building_ductility_ratio
                .or(settings.building_ductility_ratio),
            ..settings
        }
    }

    /// Every factor by name: its value where it is stated, and whether this source has it.
    fn stated(&self, of: FactorsOf) -> [(&'static str, Option<f64>, bool); 6] {
        let asce7_22 = of == FactorsOf::Asce7_22;
        let floor = of == FactorsOf::Floor;
        [
            ("importance", self.importance_ratio, !floor),
            ("amplification", self.amplification_ratio, !asce7_22),
            ("response", self.response_ratio, !asce7_22 && !floor),
            ("resonance", self.resonance_ratio, asce7_22),
            ("strength", self.strength_ratio, asce7_22),
            (
                "building_ductility",
                self.building_ductility_ratio,
                asce7_22,
            ),
        ]
    }

    /// The names of the factors that are stated and that this source has none of.
    fn strangers(&self, of: FactorsOf) -> Vec<&'static str> {
        self.stated(of)
            .into_iter()
            .filter(|(_, stated, is_known)| stated.is_some() && !is_known)
            .map(|(name, ..)| name)
            .collect()
    }
}

/// Whose factors.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum FactorsOf {
    Asce7_22,
    OtherCode,
    Floor,
}

/// A request with everything that follows from it.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// The request.
    pub request: RestrainRequest,
    /// What is asked of the codes.
    pub question: RestraintQuestion,
    /// The spectrum of the hazard.
    pub target: Option<Target>,
    /// Where it stands.
    pub floor: StandsOn,
    /// What was not stated, and stands in its place.
    pub assumptions: Vec<RestraintAssumption>,
    /// What there is to know beside it.
    pub doubts: Vec<RestraintDoubt>,
    /// The force that counts.
    pub own: RestraintForce,
    /// The forces by other codes.
    pub others: Vec<RestraintForce>,
}

/// The floor of an object.
#[derive(Debug, Clone, PartialEq)]
pub enum StandsOn {
    /// A floor of a building.
    Floor {
        /// Its name or number.
        name: String,
        /// Storeys of the building, where they are known.
        storeys: Option<usize>,
        /// Its height over that of the building.
        level_ratio: f64,
    },
    /// A height over that of the building.
    Level(f64),
    /// The ground, because no floor was given.
    Ground,
    /// The floor that has the given acceleration.
    Accelerated,
}

impl StandsOn {
    fn level_ratio(&self) -> f64 {
        match self {
            Self::Floor { level_ratio, .. } | Self::Level(level_ratio) => *level_ratio,
            Self::Ground | Self::Accelerated => 0.0,
        }
    }
}

/// What nobody stated, and what stands in its place.
#[derive(Debug, Clone, PartialEq)]
pub enum RestraintAssumption {
    /// It stands on the ground.
    Ground,
    /// A storey has [`DEFAULT_STOREY_HEIGHT_M`].
    StoreyHeight,
    /// The class of the site.
    Site(&'static str),
    /// The return period \[years\].
    ReturnPeriod(u32),
    /// The centre of gravity is at half of the height.
    CgHeight,
    /// It tips across the thickness alone.
    NoWidth,
    /// Distance of the anchors from the edge that they hold down \[m\].
    Inset(f64),
    /// The same of each object of a list, where it depends on the size of the object: at most
    /// this \[m\].
    Insets(f64),
}

/// What there is to know beside a force.
#[derive(Debug, Clone, PartialEq)]
pub enum RestraintDoubt {
    /// What is doubtful about the hazard or the place.
    Hazard(TargetDoubt),
    /// A size that hardly any object has.
    Size(UnlikelySize),
    /// A key that says something about long periods alone.
    NoEffect(&'static str),
    /// The component is a row of the tables of ASCE 7, and this gives the force.
    ComponentUnused(&'static str),
    /// The force of the code lifts nothing.
    NoTension,
}

/// The force, moments and anchors of one object.
///
/// # Errors
/// Everything that is wrong with the request.
pub fn restrain(request: RestrainRequest) -> Result<Case, Problems> {
    let kind = component(&request).map(|component| ObjectKind {
        component,
        ..ObjectKind::default()
    });
    case_of(request, kind)
}

/// Everything that is wrong with a request.
///
/// # Errors
/// All of it, under its keys.
pub fn check(request: RestrainRequest) -> Result<(), Problems> {
    restrain(request).map(drop)
}

/// What is known about an object beside its request.
#[derive(Default)]
struct ObjectKind {
    component: Option<&'static Component>,
    is_critical: bool,
    /// Of its feet, where they stand closer than its sides \[m\].
    base_thickness_m: Option<f64>,
    base_width_m: Option<f64>,
}

fn case_of(request: RestrainRequest, kind: Result<ObjectKind, Problem>) -> Result<Case, Problems> {
    let mut problems = Problems::default();
    let kind = problems.keep(kind);
    let blocks = problems.keep(blocks(&request, kind.as_ref()));
    let target = problems.keep(target(&request));
    let floor = problems.keep(floor(&request));
    if let Some(target) = &target {
        check_factors(&request, target.as_ref(), &mut problems);
    }
    let found = blocks.zip(target).zip(floor).zip(kind);
    let sizes = Sizes {
        height_m: request.height_m,
        thickness_m: request.thickness_m,
        width_m: request.width_m,
    };
    let sizes = problems.keep(sizes.check());
    let ((((blocks, target), floor), kind), of_sizes) = problems.finish(found.zip(sizes))?;
    let Floor {
        on: floor,
        building_height_m,
        mut assumptions,
    } = floor;
    let object = HeldObject::new(
        request.mass_kg,
        floor.level_ratio(),
        kind.is_critical,
        kind.component,
        &blocks,
    );
    let question = match &request.hazard {
        RestrainHazard::Study(study) => RestraintQuestion::in_study(study, object, None),
        hazard => RestraintQuestion {
            object,
            building_height_m,
            building_period_s: None,
            spectrum: target.as_ref().map(|target| target.spectrum.clone()),
            parts_edition: target.as_ref().and_then(|target| target.parts_edition),
            floor_acceleration_g: match hazard {
                RestrainHazard::FloorAcceleration(acceleration_g) => Some(*acceleration_g),
                RestrainHazard::Study(_) | RestrainHazard::Code(_) => None,
            },
            is_floor_given: true,
            settings: RestraintSettings::default(),
            pivot: Pivot::default(),
        },
    };
    let settings = request.factors.over(question.settings);
    let anchor_inset_m = request.anchors.inset_m.or(settings.anchor_inset_m);
    let settings = RestraintSettings {
        anchor_inset_m,
        ..settings
    };
    let question = RestraintQuestion {
        settings,
        pivot: request.anchors.pivot,
        ..question
    };
    check_inset(&question)?;
    let (others, mut own): (Vec<_>, Vec<_>) = restraint_forces(&question)
        .into_iter()
        .partition(|force| force.source.kind == SourceKind::OtherCode);
    if own.is_empty() {
        return Err(without_code().into());
    }
    let own = own.swap_remove(0);
    if let (RestrainHazard::Code(words), Some(target)) = (&request.hazard, &target) {
        assumptions.extend(assumed_hazard(words, target));
    }
    if request.cg_height_m.is_none() {
        assumptions.push(RestraintAssumption::CgHeight);
    }
    if request.width_m.is_none() {
        assumptions.push(RestraintAssumption::NoWidth);
    }
    if let (None, Some(axis)) = (question.settings.anchor_inset_m, &own.axis) {
        assumptions.push(RestraintAssumption::Inset(axis.inset_m(None)));
    }
    let of_hazard: Vec<TargetDoubt> = match (&request.hazard, &target) {
        // A study tells its own; here only what concerns the place counts.
        (RestrainHazard::Study(_), Some(target)) => target
            .place
            .as_ref()
            .and_then(Place::doubt)
            .map(TargetDoubt::Place)
            .into_iter()
            .collect(),
        (_, target) => target
            .iter()
            .flat_map(|target| target.doubts.iter().cloned())
            .collect(),
    };
    let mut doubts: Vec<RestraintDoubt> = of_hazard
        .into_iter()
        .map(RestraintDoubt::Hazard)
        .chain(of_sizes.into_iter().map(RestraintDoubt::Size))
        .collect();
    if let (RestrainHazard::Code(words), Some(target)) = (&request.hazard, &target) {
        doubts.extend(idle(words, target).map(RestraintDoubt::NoEffect));
    }
    if request.component.is_some()
        && !request.is_compared
        && !target
            .as_ref()
            .is_some_and(|target| uses_components(&target.spectrum))
    {
        let by = target
            .as_ref()
            .map_or("F = m a", |target| target.spectrum.name());
        doubts.push(RestraintDoubt::ComponentUnused(by));
    }
    if own.anchor_tension_n <= 0.0 && own.source.kind == SourceKind::OwnCode {
        doubts.push(RestraintDoubt::NoTension);
    }
    let others = if request.is_compared {
        others
    } else {
        Vec::new()
    };
    Ok(Case {
        request,
        question,
        target,
        floor,
        assumptions,
        doubts,
        own,
        others,
    })
}

/// The row of the object in the tables of ASCE 7.
fn component(request: &RestrainRequest) -> Result<Option<&'static Component>, Problem> {
    let Some(text) = &request.component else {
        return Ok(None);
    };
    let found = Component::find(text);
    found.map(Some).ok_or_else(|| {
        let message = format!(
            "`component` \"{}\" is no row of tables 13.5-1 and 13.6-1 that is known",
            shorten(text)
        );
        Problem::value(message, format!("give one of {}", Component::names())).of(&["component"])
    })
}

/// Whether the clause of this code asks what the object is.
fn uses_components(spectrum: &CodeSpectrum) -> bool {
    match spectrum {
        CodeSpectrum::Asce7(_)
        | CodeSpectrum::Eurocode8(_)
        | CodeSpectrum::Ntc2018(_)
        | CodeSpectrum::Tbdy2018(_) => true,
        CodeSpectrum::As1170_4(_)
        | CodeSpectrum::Nzs1170_5(_)
        | CodeSpectrum::Ts1170_5(_)
        | CodeSpectrum::Table(_) => false,
    }
}

/// Refuses anchors beyond the middle of the base: the edge would not be the one that they hold down. Feet
/// that the centre of gravity is beyond hold nothing up.
fn check_inset(question: &RestraintQuestion) -> Result<(), Problem> {
    let footing = question.footing();
    let mut axes = question.object.axes.iter();
    let is_beyond = |axis: &RestraintAxis| axis.inset_m(footing.inset_m) >= axis.base_m / 2.0;
    if axes.clone().any(is_beyond) {
        let hint = "give the distance from the edge of the base to the anchors along it, such as \"75 mm\"";
        let message = "`anchor_inset` is half of the base or more";
        return Err(Problem::value(message, hint).of(&["anchor_inset"]));
    }
    if axes.any(|axis| axis.lever_of_weight_m(footing) <= 0.0) {
        let hint = "give the distance from the edge of the base to the feet as `anchor_inset`, or leave `pivot` out";
        let message = "the centre of gravity is not between the feet";
        return Err(Problem::value(message, hint).of(&["anchor_inset", "pivot"]));
    }
    Ok(())
}

fn blocks(
    request: &RestrainRequest,
    kind: Option<&ObjectKind>,
) -> Result<Vec<(Axis, Block)>, Problem> {
    let sides = [
        (
            Axis::Thickness,
            Some(request.thickness_m),
            kind.and_then(|kind| kind.base_thickness_m),
        ),
        (
            Axis::Width,
            request.width_m,
            kind.and_then(|kind| kind.base_width_m),
        ),
    ];
    let block = |(axis, side_m, base_width_m): (Axis, Option<f64>, Option<f64>)| {
        let shape = Shape {
            cg_height_m: request.cg_height_m,
            base_width_m,
            ..Shape::default()
        };
        let block = shape.block(request.height_m, side_m?);
        Some(block.map(|block| (axis, block)))
    };
    let blocks: Result<Vec<_>, _> = sides.into_iter().filter_map(block).collect();
    blocks.map_err(|error| {
        let hint = "check the dimensions of the object";
        Problem::value(error.to_string(), hint).of(&["thickness", "width", "height", "cg_height"])
    })
}

/// Keys that say something about the long periods of a spectrum, and without which the parts are the same.
fn idle<'w>(words: &'w Words, target: &'w Target) -> impl Iterator<Item = &'static str> + 'w {
    const LONG_PERIODS: [&str; 6] = [
        "sd1",
        "s1",
        "fv",
        "long_period",
        "fault_distance",
        "corner_periods",
    ];
    let of_parts = |target: &Target| {
        let spectrum = target.parts_spectrum();
        (spectrum.sa_g(0.0), spectrum.plateau_g())
    };
    let given = LONG_PERIODS
        .into_iter()
        .filter(|key| words.get(key).is_some());
    given.filter(move |key| {
        let mut without = words.clone();
        without.remove(key);
        Target::for_parts(&without).is_ok_and(|other| of_parts(&other) == of_parts(target))
    })
}

/// The code; `None` for a floor acceleration.
fn target(request: &RestrainRequest) -> Result<Option<Target>, Problems> {
    match &request.hazard {
        RestrainHazard::Code(words) => Target::for_parts(words).map(Some),
        RestrainHazard::Study(study) => {
            let target = study.restraint_target();
            let is_code = |target: &&Target| !matches!(target.spectrum, CodeSpectrum::Table(_));
            target
                .filter(is_code)
                .cloned()
                .map(Some)
                .ok_or_else(|| without_code().into())
        }
        RestrainHazard::FloorAcceleration(_) if request.is_compared => {
            let hint =
                "leave `compare` out, or give a place or a code in place of `floor_acceleration`";
            let message = "codes cannot be compared: a floor acceleration has no spectrum";
            Err(Problem::value(message, hint)
                .of(&["compare", "floor_acceleration"])
                .into())
        }
        RestrainHazard::FloorAcceleration(_) => Ok(None),
    }
}

fn without_code() -> Problem {
    let hint = "add a code to the table [restraint] of the study, such as code = \"asce7\" and sds = \"1 g\"; or leave \
                the study out and give `place`, `code` or `floor_acceleration`";
    Problem::value("the study names no code, so no clause gives a force", hint)
}

/// Refuses factors that the code does not have: they would be read silently as others.
fn check_factors(request: &RestrainRequest, target: Option<&Target>, problems: &mut Problems) {
    if request
        .factors
        .building_ductility_ratio
        .is_some_and(|ratio| ratio < LEAST_BUILDING_DUCTILITY_RATIO)
    {
        let message =
            format!("`building_ductility` must be at least {LEAST_BUILDING_DUCTILITY_RATIO}");
        let hint = "leave it out: 1.3 stands for a building that is not known";
        problems.push(Problem::value(message, hint).of(&["building_ductility"]));
    }
    for (name, ratio, _) in request.factors.stated(FactorsOf::OtherCode) {
        if ratio.is_some_and(|ratio| !FACTORS.contains(&ratio)) {
            let message = format!(
                "`{name}` must be between {} and {}",
                FACTORS.start(),
                FACTORS.end()
            );
            let hint = "give the factor of the code, or leave it out";
            problems.push(Problem::value(message, hint).of(&[name]));
        }
    }
    if request.is_compared {
        return;
    }
    let of = match target.map(|target| &target.spectrum) {
        None => FactorsOf::Floor,
        Some(CodeSpectrum::Asce7(code)) => match code.edition() {
            Asce7Edition::Asce7_22 => FactorsOf::Asce7_22,
            Asce7Edition::Asce7_16 => FactorsOf::OtherCode,
        },
        Some(_) => FactorsOf::OtherCode,
    };
    let by = target.map_or("F = m a", |target| target.spectrum.name());
    let hint = match of {
        FactorsOf::Asce7_22 => {
            "ASCE 7-22 has `resonance` (C_AR), `strength` (R_po) and `building_ductility` (R_μ)"
        }
        FactorsOf::OtherCode => "leave it out, or add `compare` to see ASCE 7-22 too",
        FactorsOf::Floor => "leave it out: only `amplification` multiplies a floor acceleration",
    };
    for name in request.factors.strangers(of) {
        let message = format!("`{name}` is not a factor of {by}");
        problems.push(Problem::value(message, hint).of(&[name]));
    }
}

/// The floor of the request.
struct Floor {
    on: StandsOn,
    building_height_m: Option<f64>,
    assumptions: Vec<RestraintAssumption>,
}

fn floor(request: &RestrainRequest) -> Result<Floor, Problems> {
    let RestrainFloor {
        name,
        level_ratio,
        storeys,
        storey_height_m,
    } = &request.floor;
    let mut problems = Problems::default();
    let mut note = |keys: &[&'static str], message: &str, hint: &str| {
        problems.push(Problem::value(message, hint).of(keys));
    };
    let has_building = storeys.is_some() || storey_height_m.is_some();
    if name.is_some() && level_ratio.is_some() {
        note(
            &["floor", "level_ratio"],
            "`floor` and `level_ratio` exclude each other",
            "keep one of them",
        );
    }
    if level_ratio.is_some_and(|ratio| !(0.0..=1.0).contains(&ratio)) {
        note(
            &["level_ratio"],
            "`level_ratio` must be from 0 (the ground) to 1 (the roof)",
            "give the height of the floor over the roof's",
        );
    }
    if storeys.is_some_and(|storeys| !(1..=usize::from(MAX_STOREYS)).contains(&storeys)) {
        note(
            &["storeys"],
            &format!("`storeys` must be from 1 to {MAX_STOREYS}"),
            "give the number of storeys above the ground",
        );
    }
    match &request.hazard {
        RestrainHazard::FloorAcceleration(_)
            if name.is_some() || level_ratio.is_some() || has_building =>
        {
            note(
                &["floor", "level_ratio", "storeys", "storey_height"],
                "the acceleration is that of the floor of the object: a floor or a building has no meaning beside it",
                "leave them out, or give a place or a code in place of `floor_acceleration`",
            )
        }
        RestrainHazard::Study(_) if has_building => note(
            &["storeys", "storey_height"],
            "the study describes the building: `storeys` and `storey_height` have no meaning beside it",
            "leave them out, or change the table [building] of the study",
        ),
        RestrainHazard::Code(_) => {
            if name.is_some() && storeys.is_none() {
                note(
                    &["floor", "storeys"],
                    "`floor` needs `storeys`: the number of storeys of the building",
                    "add `storeys`, such as 6",
                );
            } else if storey_height_m.is_some() && storeys.is_none() {
                note(
                    &["storey_height", "storeys"],
                    "`storey_height` needs `storeys`",
                    "add the number of storeys",
                );
            } else if has_building && name.is_none() && level_ratio.is_none() {
                note(
                    &["storeys", "storey_height", "floor", "level_ratio"],
                    "`storeys` and `storey_height` describe a building, but no floor of it is named",
                    "add `floor` or `level_ratio`, or leave them out: the object is then on the ground",
                );
            }
        }
        RestrainHazard::FloorAcceleration(_) | RestrainHazard::Study(_) => {}
    }
    problems.finish(Some(()))?;
    let floors = match &request.hazard {
        RestrainHazard::Study(study) => floors_of(study, None),
        _ => Floors {
            storeys: *storeys,
            ..Floors::default()
        },
    };
    let mut assumptions = Vec::new();
    let on = match (name, level_ratio) {
        (Some(name), _) => StandsOn::Floor {
            level_ratio: level_of_floor(&floors, name).map_err(|problem| problem.of(&["floor"]))?,
            name: name.trim().to_owned(),
            storeys: floors.storeys,
        },
        (None, Some(ratio)) => StandsOn::Level(*ratio),
        (None, None) if matches!(request.hazard, RestrainHazard::FloorAcceleration(_)) => {
            StandsOn::Accelerated
        }
        (None, None) => {
            assumptions.push(RestraintAssumption::Ground);
            StandsOn::Ground
        }
    };
    if storeys.is_some() && storey_height_m.is_none() {
        assumptions.push(RestraintAssumption::StoreyHeight);
    }
    let building_height_m =
        storeys.map(|storeys| storeys as f64 * storey_height_m.unwrap_or(DEFAULT_STOREY_HEIGHT_M));
    Ok(Floor {
        on,
        building_height_m,
        assumptions,
    })
}

/// The floors that the names in a list mean.
///
/// # Errors
/// A floor beside those of the list.
fn floor_of_list(hazard: &RestrainHazard, floor: &RestrainFloor) -> Result<Floors, Problem> {
    if floor.name.is_some() || floor.level_ratio.is_some() {
        let message = "`floor` and `level_ratio` are those of one object: the list names the floors of its own";
        return Err(Problem::value(
            message,
            "leave them out, or give the object in place of the list",
        )
        .of(&["floor", "level_ratio"]));
    }
    Ok(match hazard {
        RestrainHazard::Study(study) => floors_of(study, None),
        _ => Floors {
            storeys: floor.storeys,
            ..Floors::default()
        },
    })
}

/// What the code of flags assumes about the site.
fn assumed_hazard(words: &Words, target: &Target) -> Vec<RestraintAssumption> {
    let mut assumed = Vec::new();
    if let (None, Some(site)) = (words.get("site"), target.spectrum.site_name()) {
        assumed.push(RestraintAssumption::Site(site));
    }
    if let (None, Some(years)) = (
        words.get("return_period_years"),
        target.return_period_years(),
    ) {
        assumed.push(RestraintAssumption::ReturnPeriod(years));
    }
    assumed
}

impl Case {
    /// Its weight \[N\].
    pub fn weight_n(&self) -> f64 {
        self.request.mass_kg * G0_M_S2
    }

    /// What each anchor carries.
    pub fn each_anchor(&self) -> AnchorForces {
        of_each_anchor(&self.own, self.request.anchors.per_edge)
    }

    /// Demand over capacity of the anchor that the user has chosen.
    pub fn demand_capacity_ratio(&self) -> Option<f64> {
        let anchor = self.request.anchors.chosen.as_ref()?;
        Some(anchor.demand_capacity_ratio(&self.each_anchor()))
    }
}

#[cfg(test)]
mod tests;
