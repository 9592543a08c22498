//! One landing, from the known properties of the object to the shock and the verdict.

use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::cushion::Cushion;
use freestand::impact::{
    self, Impact, ImpactModel, Landing, ValidityWarning, compression_warnings,
    impact_friction_needed_ratio, stiffness_warnings,
};
use freestand::spectra::BEYOND_ALL_G;

mod boundary;
mod cushion;
mod doubt;
mod test_points;
mod verdict;

pub use boundary::{BoundaryAnswer, DamageBoundaryReport};
use cushion::{Contact, contact};
pub use doubt::{BalancePoint, NoLargestStiffness, ShockDoubt, ShockNote};
pub use test_points::{
    BoundaryTests, Bracket, BracketAnswer, PeakBracket, TestPoint, TestPointAnswer, TestsAnswer,
    TestsDoubt, boundary_tests,
};
pub use verdict::DemandCapacity;
use verdict::{Compared, compared, max_stiffness};

use crate::cushion::cushion_words;
use freestand_input::keys::Words;
use freestand_input::problem::{Problem, Problems};
use freestand_input::words::{Choices, name_of};
use freestand_output::answer;

/// What ends the fall, Fig. 1 of Al Abadi et al.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Scenario {
    /// The edge lands and the object rocks on, Fig. 1(c).
    #[default]
    Rocking,
    /// The edge lands and the object stops, Fig. 1(b).
    Halted,
    /// The object falls over onto the floor, Fig. 1(a).
    OverturnFloor,
    /// The object falls against an obstacle, Fig. 1(a).
    OverturnObstacle,
}

/// The scenarios by name.
pub const SCENARIOS: Choices<Scenario> = &[
    (
        Scenario::Rocking,
        "rocking",
        "The edge lands and the object continues to rock",
    ),
    (
        Scenario::Halted,
        "halted",
        "The edge lands and the object stops",
    ),
    (
        Scenario::OverturnFloor,
        "overturn-floor",
        "The object falls over onto the floor",
    ),
    (
        Scenario::OverturnObstacle,
        "overturn-obstacle",
        "The object falls against an obstacle",
    ),
];

/// The impact models by name.
pub const MODELS: Choices<ImpactModel> = &[
    (
        ImpactModel::Paper,
        "paper",
        "Eq. (5): the landing edge does not slip",
    ),
    (
        ImpactModel::Halted,
        "halted",
        "Eq. (8): the rotation is halted",
    ),
    (
        ImpactModel::FreeCorner,
        "free-corner",
        "The landing edge slides without friction; for comparison",
    ),
];

impl Scenario {
    fn overturns(self) -> bool {
        matches!(self, Self::OverturnFloor | Self::OverturnObstacle)
    }
}

/// Where the energy of the landing comes from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Energy {
    /// The centre of gravity rose by this much \[m\].
    CgRise(f64),
    /// The free base edge was lifted by this much \[m\].
    Uplift(f64),
    /// The object was rotated by this much \[rad\].
    Rotation(f64),
    /// The object turns at this speed just before the contact \[rad/s\].
    AngularVelocity(f64),
}

/// A landing to be evaluated: SI units, `None` where a value is not given.
#[derive(Debug, Clone, PartialEq)]
pub struct ShockRequest {
    /// The object; it rotates about its left edge and lands on its right edge.
    pub block: Block,
    /// Its mass \[kg\].
    pub mass_kg: f64,
    /// The cushion under one edge.
    pub cushion: Words,
    /// Stiffness of the side on the floor or the obstacle, when the object falls over \[N/m\].
    pub contact_stiffness_n_m: Option<f64>,
    /// A measured drop acceleration (same mass, same rise) in place of the stiffness \[m/s²\].
    pub drop_acceleration_m_s2: Option<f64>,
    /// The energy; an object that falls over needs none here.
    pub energy: Option<Energy>,
    /// What ends the fall.
    pub scenario: Scenario,
    /// The impact model; `None`: that of the scenario.
    pub model: Option<ImpactModel>,
    /// Distance to the obstacle \[m\].
    pub gap_m: Option<f64>,
    /// Height of the obstacle; `None`: taller than the object \[m\].
    pub obstacle_height_m: Option<f64>,
    /// A point of the object: from the old pivot and above the base \[m\].
    pub at_m: Option<(f64, f64)>,
    /// Gravity \[m/s²\].
    pub gravity_m_s2: f64,
    /// Coefficient of friction, for the warning about sliding.
    pub friction_ratio: Option<f64>,
    /// Peak acceleration that the object withstands \[m/s²\].
    pub tolerance_m_s2: Option<f64>,
    /// Duration of the half-sine of that peak that it withstands \[s\].
    pub tolerance_duration_s: Option<f64>,
    /// Velocity change below which no peak does damage \[m/s\].
    pub tolerance_velocity_change_m_s: Option<f64>,
    /// Tests of the object, in place of the peak and the velocity change that it withstands.
    pub boundary_tests: Option<BoundaryTests>,
    /// Uplift from which it may fall back undamaged: bench handling \[m\].
    pub tolerance_edge_lift_m: Option<f64>,
    /// Frequency of its most delicate component \[Hz\], with
    /// [`ShockRequest::component_capacity_m_s2`].
    pub component_frequency_hz: Option<f64>,
    /// Acceleration that this component itself withstands \[m/s²\].
    pub component_capacity_m_s2: Option<f64>,
}

impl ShockRequest {
    /// A request with an object and its mass; no other value is given.
    pub fn new(block: Block, mass_kg: f64) -> Self {
        Self {
            block,
            mass_kg,
            cushion: Words::default(),
            contact_stiffness_n_m: None,
            drop_acceleration_m_s2: None,
            energy: None,
            scenario: Scenario::Rocking,
            model: None,
            gap_m: None,
            obstacle_height_m: None,
            at_m: None,
            gravity_m_s2: G0_M_S2,
            friction_ratio: None,
            tolerance_m_s2: None,
            tolerance_duration_s: None,
            tolerance_velocity_change_m_s: None,
            boundary_tests: None,
            tolerance_edge_lift_m: None,
            component_frequency_hz: None,
            component_capacity_m_s2: None,
        }
    }
}

/// Whether the object withstands the landing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// No tolerance is exceeded.
    Ok,
    /// One is exceeded.
    Exceeded,
    /// This landing cannot be compared with any tolerance that was given.
    None,
}

impl Verdict {
    /// The name in outputs.
    pub fn name(self) -> &'static str {
        match self {
            Self::Ok => "ok",
            Self::Exceeded => "exceeded",
            Self::None => "no-verdict",
        }
    }
}

answer! {
    /// The shock of a landing.
    pub struct ShockAnswer {
        scenario: &'static str = "scenario",
        model: &'static str = "model",
        /// What the energy of the fall follows from.
        energy_source: &'static str,
        drop_acceleration_g: f64 = "drop acceleration",
        edge_acceleration_g: f64 = "shock",
        /// The shock in m/s².
        edge_acceleration_m_s2: f64,
        /// The shock divided by the drop acceleration.
        amplification_ratio: f64,
        landing_ratio: f64 = "landing ratio R_D, Eq. (6)",
        effective_mass_kg: f64 = "effective mass",
        edge_velocity_m_s: Option<f64> = "velocity of the edge",
        /// Angular velocity just before the landing.
        angular_velocity_rad_s: Option<f64>,
        /// Distance of the point that lands from the pivot.
        contact_distance_m: f64,
        half_diagonal_m: f64 = "half diagonal R",
        slenderness_angle_rad: f64 = "slenderness angle α",
        cg_rise_m: Option<f64> = "rise of the centre of gravity",
        uplift_m: Option<f64> = "uplift",
        rotation_rad: Option<f64> = "rotation",
        /// Stiffness of a linear cushion.
        stiffness_n_m: Option<f64>,
        /// The contact law.
        law: Option<&'static str>,
        cushion: Option<String> = "cushion",
        pulse_duration_s: Option<f64> = "duration of the pulse",
        velocity_change_m_s: Option<f64> = "velocity change",
        compression_m: Option<f64> = "compression of the cushion",
        /// Rise of the centre of gravity at the balance point.
        balance_rise_m: f64,
        ceiling_g: Option<f64> = "ceiling of the shock",
        /// Friction that the impact needs.
        impact_friction_needed_ratio: Option<f64>,
        /// The shock by each impact model.
        models: ShockOfModels,
        /// The shock at the point that was asked for.
        at: Option<PointShock>,
        tolerance_g: Option<f64> = "tolerance",
        tolerance_edge_lift_m: Option<f64> = "tolerance, uplift",
        /// The shock tests of the object.
        damage_boundary_tests: Option<TestsAnswer>,
        /// The damage boundary that the shock is compared with.
        damage_boundary: Option<BoundaryAnswer>,
        /// Demand divided by capacity, for each kind of tolerance.
        demand_capacity: Option<DemandCapacity>,
        demand_capacity_ratio: Option<f64> = "demand/capacity",
        governing: Option<&'static str> = "  governed by",
        verdict: &'static str = "verdict" if demand_capacity_ratio,
        max_stiffness_n_m: Option<f64> = "largest stiffness at this rise",
    }

    /// The shock by each impact model; none where it does not apply.
    pub struct ShockOfModels {
        paper_g: Option<f64> = "shock by the paper's model, Eq. (5)",
        halted_g: Option<f64> = "shock by the halted model, Eq. (8)",
        free_corner_g: Option<f64> = "shock by the free-corner model",
    }

    /// The shock at a point of the object.
    pub struct PointShock {
        /// From the pivot.
        x_m: f64,
        /// Above the base.
        z_m: f64,
        horizontal_g: f64 = "shock at the point, horizontal",
        vertical_g: f64 = "shock at the point, vertical",
    }
}

/// The shock of a landing.
#[derive(Debug, Clone, PartialEq)]
pub struct ShockReport {
    /// What the landing does.
    pub answer: ShockAnswer,
    /// Whether the object withstands it.
    pub verdict: Verdict,
    /// The damage boundary of tests or of the component, with the demand.
    pub damage_boundary: Option<DamageBoundaryReport>,
    /// What may make it wrong.
    pub doubts: Vec<ShockDoubt>,
    /// What its reader must know.
    pub notes: Vec<ShockNote>,
}

/// Evaluates a landing.
///
/// # Errors
/// Values that contradict each other or are missing, a rise beyond the balance point of a rocking
/// object. All of them at once.
///
/// # Example
/// Test 1 of Table I of Al Abadi et al., with g = 9.81 m/s² as the paper has it:
/// ```
/// use freestand_study::cushion::spring;
/// use freestand_study::shock::{Energy, ShockRequest, shock};
/// let mut cabinet = ShockRequest::new(freestand::block::Block::uniform(2.3, 0.6)?, 140.0);
/// cabinet.cushion = spring(4.38e6);
/// cabinet.energy = Some(Energy::CgRise(0.016));
/// let report = shock(&cabinet)?;
/// assert!((report.answer.edge_acceleration_g - 4.526).abs() < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn shock(request: &ShockRequest) -> Result<ShockReport, Problems> {
    let mut problems = Problems::default();
    problems.problems.extend(contradictions(request));
    let request = &with_tests(request);
    let contact = contact(request, &mut problems);
    let Some(landing) = problems.keep(landing(request)) else {
        return Err(problems);
    };
    let fall = problems.keep(fall(request, &landing));
    match (contact, fall) {
        (Some(contact), Some(fall)) if problems.is_empty() => {
            Ok(report(request, &landing, &contact, &fall)?)
        }
        _ => Err(problems),
    }
}

/// The request with the peak and the velocity change of its tests.
fn with_tests(request: &ShockRequest) -> ShockRequest {
    let mut request = request.clone();
    if let Some((acceleration_m_s2, velocity_change_m_s)) = request
        .boundary_tests
        .as_ref()
        .and_then(BoundaryTests::critical)
    {
        request.tolerance_m_s2 = Some(acceleration_m_s2);
        request.tolerance_velocity_change_m_s = Some(velocity_change_m_s);
    }
    request
}

/// Values that are wrong, or that cannot be combined.
fn contradictions(request: &ShockRequest) -> impl Iterator<Item = Problem> {
    let is_peak = request.tolerance_m_s2.is_some();
    let is_pulse =
        request.tolerance_duration_s.is_some() || request.tolerance_velocity_change_m_s.is_some();
    let is_obstacle = request.gap_m.is_some() || request.obstacle_height_m.is_some();
    let is_tested = request
        .boundary_tests
        .as_ref()
        .is_some_and(|tests| tests.critical().is_some());
    let is_measured_alone = request.drop_acceleration_m_s2.is_some() && request.energy.is_none();
    [
        (
            request.boundary_tests.is_some() && (is_peak || is_pulse),
            "the test points of `damage_boundary` replace `tolerance`, `tolerance_velocity_change` and \
             `tolerance_duration`",
            "leave these three out",
        ),
        (
            !(request.mass_kg > 0.0 && request.mass_kg.is_finite()),
            "`mass` must be positive and finite",
            "give `mass` in kg or t",
        ),
        (
            request.scenario != Scenario::Rocking && request.model.is_some_and(|model| model != ImpactModel::Halted),
            "`model` belongs to the scenario rocking: in all others the landing is halted",
            "leave `model` out",
        ),
        (
            request.scenario != Scenario::OverturnObstacle && is_obstacle,
            "`gap` and `obstacle_height` belong to the scenario overturn-obstacle",
            "use `scenario = \"overturn-obstacle\"`, or leave them out",
        ),
        (
            request.boundary_tests.is_none() && !is_peak && is_pulse,
            "`tolerance_duration` and `tolerance_velocity_change` need `tolerance`",
            "give the peak acceleration that the object withstands, such as `tolerance = \"5 g\"`",
        ),
        (
            request.component_frequency_hz.is_some() != request.component_capacity_m_s2.is_some(),
            "`component_frequency` and `component_capacity` go together",
            "give both, such as `component_frequency = \"100 Hz\"` and `component_capacity = \"40 g\"`",
        ),
        (
            (is_peak && is_pulse || is_tested) && is_measured_alone,
            "a drop acceleration alone gives neither duration nor velocity change to compare with the tolerance",
            "give the rise at which it was measured as well, such as `cg_rise = \"16 mm\"`",
        ),
    ]
    .into_iter()
    .filter(|(is_wrong, ..)| *is_wrong)
    .map(|(_, message, hint)| Problem::value(message, hint))
}

fn landing(request: &ShockRequest) -> Result<Landing, Problem> {
    let block = &request.block;
    match request.scenario {
        Scenario::Rocking => Ok(Landing::rocking(
            block,
            request.model.unwrap_or(ImpactModel::Paper),
        )),
        Scenario::Halted => Ok(Landing::rocking(block, ImpactModel::Halted)),
        Scenario::OverturnFloor => Ok(Landing::overturning_onto_floor(block)),
        Scenario::OverturnObstacle => {
            let gap_m = request.gap_m.ok_or_else(|| {
                Problem::value(
                    "the scenario overturn-obstacle needs `gap`",
                    "give the distance to the obstacle, such as `gap = \"0.5 m\"`",
                )
            })?;
            Landing::overturning_onto_obstacle(block, gap_m, request.obstacle_height_m).map_err(
                |error| Problem::value(error.to_string(), "use `scenario = \"overturn-floor\"`"),
            )
        }
    }
}

/// How the energy of the landing is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
enum EnergySource {
    Uplift,
    ImpactVelocity,
    FallFromBalance,
    Measured,
}

/// The energy of the landing, as a fall of the centre of gravity.
struct Fall {
    source: EnergySource,
    rise_m: Option<f64>,
    rotation_rad: Option<f64>,
    doubt: Option<ShockDoubt>,
}

impl Fall {
    fn new(source: EnergySource, rise_m: Option<f64>, rotation_rad: Option<f64>) -> Self {
        Self {
            source,
            rise_m,
            rotation_rad,
            doubt: None,
        }
    }
}

fn fall(request: &ShockRequest, landing: &Landing) -> Result<Fall, Problem> {
    let (block, pivot) = (&request.block, landing.pivot);
    if let Some(Energy::AngularVelocity(omega)) = request.energy {
        let rise_m = landing.equivalent_rise_m(omega, request.gravity_m_s2);
        return Ok(Fall::new(EnergySource::ImpactVelocity, Some(rise_m), None));
    }
    if request.scenario.overturns() {
        return match landing.fall_from_balance_m.filter(|&fall| fall >= 0.0) {
            Some(fall) => Ok(Fall {
                doubt: Some(ShockDoubt::FromRest),
                ..Fall::new(EnergySource::FallFromBalance, Some(fall), None)
            }),
            None if request.scenario == Scenario::OverturnFloor => Err(Problem::value(
                "on its side the centre of gravity is higher than at the balance point: there is no fall to provide \
                 the energy",
                "check the centre of gravity and the base width, or give the `angular_velocity` before the contact",
            )),
            None => Err(Problem::value(
                "the object touches the obstacle before it reaches its balance point: there is no fall to provide \
                 the energy",
                "give the speed of the contact from a rocking history, such as `angular_velocity = \"1.2 rad/s\"`",
            )),
        };
    }
    let alpha = pivot.slenderness_angle_rad;
    let rotation = match request.energy {
        None if request.drop_acceleration_m_s2.is_some() => {
            return Ok(Fall::new(EnergySource::Measured, None, None));
        }
        None => {
            return Err(Problem::value(
                "neither the rise of the object nor its speed at the landing is given",
                "give one of `cg_rise`, `uplift`, `rotation`, `angular_velocity` or `drop_acceleration`",
            ));
        }
        Some(Energy::CgRise(rise_m)) if rise_m <= pivot.balance_rise_m() => {
            let rotation_rad = pivot.rotation_at_rise_rad(rise_m);
            return Ok(Fall::new(EnergySource::Uplift, Some(rise_m), rotation_rad));
        }
        Some(Energy::Rotation(theta)) => Some(theta.abs()),
        Some(Energy::Uplift(uplift_m)) if uplift_m <= block.base_width_m() => {
            Some((uplift_m / block.base_width_m()).asin())
        }
        Some(_) => None,
    };
    if let Some(theta) = rotation.filter(|&theta| theta <= alpha) {
        let rise_m = pivot.cg_rise_m(theta);
        return Ok(Fall::new(EnergySource::Uplift, Some(rise_m), Some(theta)));
    }
    let balance = BalancePoint {
        rise_m: pivot.balance_rise_m(),
        rotation_rad: alpha,
        uplift_m: block.base_width_m() * alpha.sin(),
    };
    if request.scenario == Scenario::Halted {
        let rise_m = match request.energy {
            Some(Energy::CgRise(rise_m)) => rise_m,
            _ => pivot.balance_rise_m(),
        };
        return Ok(Fall {
            doubt: Some(ShockDoubt::BeyondBalance(balance)),
            ..Fall::new(EnergySource::Uplift, Some(rise_m), rotation)
        });
    }
    Err(Problem::value(
        format!(
            "beyond its {} the object does not come back",
            balance.words()
        ),
        "for the fall itself use `scenario = \"overturn-floor\"` or `scenario = \"overturn-obstacle\"`",
    ))
}

fn report(
    request: &ShockRequest,
    landing: &Landing,
    contact: &Contact,
    fall: &Fall,
) -> Result<ShockReport, Problem> {
    let block = &request.block;
    let (mass_kg, gravity) = (request.mass_kg, request.gravity_m_s2);
    let mut doubts: Vec<ShockDoubt> = fall.doubt.iter().cloned().collect();
    let mut notes = Vec::new();
    let (cushion, pad_thickness_m) = match contact {
        Contact::Cushion(edge) => {
            notes.extend(edge.notes.iter().cloned().map(ShockNote::Cushion));
            (Some(edge.cushion.clone()), edge.pad_thickness_m)
        }
        Contact::Measured(a) => (
            implied_spring(*a, mass_kg, fall.rise_m, gravity, &mut notes)?,
            None,
        ),
    };
    let cushion = cushion.as_ref();
    let impact_of = |landing: &Landing| -> Option<Impact> {
        Some(landing.impact(mass_kg, cushion?, fall.rise_m?, gravity))
    };
    let impact = impact_of(landing);
    let drop_m_s2 = match contact {
        Contact::Measured(a) => *a,
        Contact::Cushion(_) => impact.map_or(0.0, |impact| impact.drop_acceleration_m_s2),
    };
    let edge_of = |landing: &Landing| {
        let measured = || landing.amplification_ratio() * drop_m_s2;
        impact_of(landing).map_or_else(measured, |impact| impact.edge_acceleration_m_s2)
    };
    let edge_m_s2 = edge_of(landing);
    let overturns = request.scenario.overturns();
    // Close to the end of its range a contact law gives numbers of any size, beyond it none.
    let largest_m_s2 = edge_m_s2.max(drop_m_s2);
    if edge_m_s2.is_nan() || largest_m_s2 > BEYOND_ALL_G * G0_M_S2 {
        return Err(Problem::value(
            "the shock is too large to calculate",
            "check the sizes, the mass and the cushion: one that bottoms must absorb the energy of the landing",
        ));
    }

    if landing.model == ImpactModel::Halted
        && request.scenario == Scenario::Rocking
        && request.model != Some(ImpactModel::Halted)
    {
        doubts.push(ShockDoubt::Validity(ValidityWarning::Squat {
            landing_ratio: block.landing_ratio(),
        }));
    }
    let edge_keys = ["stiffness", "pad_stiffness", "cushion", "compressions"];
    if overturns
        && edge_keys
            .iter()
            .any(|key| request.cushion.get(key).is_some())
    {
        doubts.push(ShockDoubt::EdgeUnused);
    }
    if overturns && request.energy.is_some() && fall.source == EnergySource::FallFromBalance {
        doubts.push(ShockDoubt::RiseUnused);
    }
    if let Some(cushion) = cushion {
        let limits = stiffness_warnings(mass_kg, cushion, pad_thickness_m);
        doubts.extend(limits.into_iter().map(ShockDoubt::Validity));
    }
    if let Some((impact, cushion)) = impact.zip(cushion).filter(|_| !overturns) {
        let limits = compression_warnings(impact.compression_m, cushion, pad_thickness_m);
        doubts.extend(limits.into_iter().map(ShockDoubt::Validity));
    }
    let rocks_through =
        request.scenario == Scenario::Rocking && landing.model == ImpactModel::Paper;
    let friction_needed =
        rocks_through.then(|| impact_friction_needed_ratio(block, block.landing_ratio()));
    let friction_ratio = request.friction_ratio.unwrap_or(impact::ASSUMED_FRICTION);
    if let Some(needed_ratio) = friction_needed.filter(|&needed| needed > friction_ratio) {
        doubts.push(ShockDoubt::Validity(ValidityWarning::Sliding {
            needed_ratio,
            friction_ratio,
            in_impact: true,
        }));
    }
    if landing.model == ImpactModel::FreeCorner {
        doubts.push(ShockDoubt::FreeCorner);
    }

    let uplift_m = fall
        .rotation_rad
        .map(|theta| block.base_width_m() * theta.sin());
    let compared = compared(request, edge_m_s2, uplift_m, impact.as_ref());
    let of_tests = request
        .boundary_tests
        .iter()
        .flat_map(|tests| tests.doubts.iter().cloned());
    doubts.extend(of_tests.map(ShockDoubt::Tests));
    let damage_boundary = impact
        .as_ref()
        .and_then(|impact| DamageBoundaryReport::new(request, edge_m_s2, impact));
    let share = request
        .at_m
        .map(|(x_m, z_m)| (x_m, z_m, landing.shock_share_at(x_m, z_m)));
    if let Some((x_m, z_m, _)) = share
        && !(0.0..=block.thickness_m()).contains(&x_m) | !(0.0..=block.height_m()).contains(&z_m)
    {
        doubts.push(ShockDoubt::PointOutside);
    }
    // Only a spring has a largest stiffness: that of another law would not be the one stated.
    let rise_on_a_spring_m = fall
        .rise_m
        .filter(|_| cushion.and_then(Cushion::linear_stiffness_n_m).is_some());
    let largest = rise_on_a_spring_m.map_or(Ok(None), |rise_m| {
        max_stiffness(request, landing, rise_m, uplift_m)
    });
    let max_stiffness_n_m = largest.unwrap_or_else(|why| {
        notes.push(ShockNote::NoLargestStiffness(why));
        None
    });
    doubts.extend(not_compared(request, compared.as_ref()));
    let at = share.map(|(x_m, z_m, (horizontal, vertical))| PointShock {
        x_m,
        z_m,
        horizontal_g: horizontal * edge_m_s2 / G0_M_S2,
        vertical_g: vertical * edge_m_s2 / G0_M_S2,
    });
    let pivot = landing.pivot;
    let ceiling_m_s2 = cushion.filter(|_| !overturns).map(|cushion| {
        landing.edge_acceleration_m_s2(mass_kg, cushion, pivot.balance_rise_m(), gravity)
    });
    let ceiling_g = ceiling_m_s2
        .map(|a| a / G0_M_S2)
        .filter(|ceiling_g| ceiling_g.is_finite());
    let omega_rad_s = fall
        .rise_m
        .map(|rise_m| landing.omega_rad_s(rise_m, gravity));
    let governing = compared.as_ref().map(|compared| compared.governing);
    let ratio = compared.as_ref().map(|compared| compared.ratio);
    let verdict = match ratio {
        Some(ratio) if ratio > 1.0 => Verdict::Exceeded,
        Some(_) => Verdict::Ok,
        None => Verdict::None,
    };
    let answer = ShockAnswer {
        scenario: name_of(SCENARIOS, request.scenario),
        model: name_of(MODELS, landing.model),
        energy_source: fall.source.into(),
        drop_acceleration_g: drop_m_s2 / G0_M_S2,
        edge_acceleration_g: edge_m_s2 / G0_M_S2,
        edge_acceleration_m_s2: edge_m_s2,
        amplification_ratio: landing.amplification_ratio(),
        landing_ratio: block.landing_ratio(),
        effective_mass_kg: landing.effective_mass_ratio * mass_kg,
        edge_velocity_m_s: fall
            .rise_m
            .map(|rise| landing.edge_velocity_m_s(rise, gravity)),
        angular_velocity_rad_s: omega_rad_s,
        contact_distance_m: landing.contact_distance_m,
        half_diagonal_m: pivot.half_diagonal_m,
        slenderness_angle_rad: pivot.slenderness_angle_rad,
        cg_rise_m: fall.rise_m,
        uplift_m,
        rotation_rad: fall.rotation_rad,
        stiffness_n_m: cushion.and_then(Cushion::linear_stiffness_n_m),
        law: cushion.map(|cushion| cushion.law().name()),
        cushion: cushion.map(cushion_words),
        pulse_duration_s: impact.map(|impact| impact.pulse_duration_s),
        velocity_change_m_s: impact.map(|impact| impact.velocity_change_m_s),
        compression_m: impact.map(|impact| impact.compression_m),
        balance_rise_m: pivot.balance_rise_m(),
        ceiling_g,
        impact_friction_needed_ratio: friction_needed,
        models: models(request, landing, &edge_of),
        at,
        tolerance_g: request.tolerance_m_s2.map(|tolerance| tolerance / G0_M_S2),
        tolerance_edge_lift_m: request.tolerance_edge_lift_m,
        damage_boundary_tests: request.boundary_tests.as_ref().map(TestsAnswer::of),
        damage_boundary: damage_boundary.as_ref().map(BoundaryAnswer::of),
        demand_capacity: compared
            .as_ref()
            .map(|compared| compared.demand_capacity.clone()),
        demand_capacity_ratio: ratio,
        governing,
        verdict: verdict.name(),
        max_stiffness_n_m,
    };
    Ok(ShockReport {
        answer,
        verdict,
        damage_boundary,
        doubts,
        notes,
    })
}

/// Tolerances that were given but with which this landing cannot be compared.
fn not_compared(
    request: &ShockRequest,
    compared: Option<&Compared>,
) -> impl Iterator<Item = ShockDoubt> {
    let compared = compared.map(|compared| &compared.demand_capacity);
    let is_left = |of: fn(&DemandCapacity) -> Option<f64>| compared.and_then(of).is_none();
    let kinds = [
        (
            request.component_frequency_hz.is_some() && is_left(|one| one.component),
            ShockDoubt::ComponentNotCompared,
        ),
        (
            request.tolerance_edge_lift_m.is_some() && is_left(|one| one.edge_lift),
            ShockDoubt::UpliftNotCompared,
        ),
    ];
    kinds
        .into_iter()
        .filter_map(|(is_left, doubt)| is_left.then_some(doubt))
}

/// The spring on which the mass, dropped by the same rise, reaches the measured acceleration;
/// `None` if no rise was given.
fn implied_spring(
    measured_m_s2: f64,
    mass_kg: f64,
    rise_m: Option<f64>,
    gravity_m_s2: f64,
    notes: &mut Vec<ShockNote>,
) -> Result<Option<Cushion>, Problem> {
    let Some(rise_m) = rise_m else {
        return Ok(None);
    };
    let implied_n_m = mass_kg * measured_m_s2 * measured_m_s2 / (2.0 * gravity_m_s2 * rise_m);
    let Ok(spring) = Cushion::linear(implied_n_m) else {
        return Err(Problem::value(
            "a drop from no height gives no acceleration",
            "give a rise above 0 at which it was measured",
        ));
    };
    notes.push(ShockNote::ImpliedStiffness(implied_n_m));
    Ok(Some(spring))
}

/// The shock of the same landing by each model; missing where a model does not apply.
fn models(
    request: &ShockRequest,
    landing: &Landing,
    edge_m_s2: &dyn Fn(&Landing) -> f64,
) -> ShockOfModels {
    let of = |model: ImpactModel| {
        let other = Landing::rocking(&request.block, model);
        match request.scenario.overturns() {
            true => (model == ImpactModel::Halted).then(|| edge_m_s2(landing) / G0_M_S2),
            false => (other.model == model).then(|| edge_m_s2(&other) / G0_M_S2),
        }
    };
    ShockOfModels {
        paper_g: of(ImpactModel::Paper),
        halted_g: of(ImpactModel::Halted),
        free_corner_g: of(ImpactModel::FreeCorner),
    }
}

#[cfg(test)]
mod tests;
