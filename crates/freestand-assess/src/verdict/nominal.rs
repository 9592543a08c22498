//! An object exactly as it is listed, with nothing drawn: for fragilities, in which the motions alone
//! differ. It responds as in an assessment ([`super::respond`]), by the same models, and the worse one
//! counts.

use std::fmt::{self, Display, Formatter};

use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::cushion::Cushion;
use freestand::fragility::OutcomeClass;
use freestand::impact::{ImpactModel, Landing};
use freestand::respond::Outcome;
use freestand::rocking::{Outcome as Rocking, Restitution, RockingModel, SideExtremes};
use freestand::spectra::{BEYOND_ALL_G, landings};
use freestand::wall::DEFAULT_WALL_RESTITUTION_RATIO;
use freestand::worlds::{Group, WallDraw, wall_cushion_at, wall_draw};
use freestand_study::cushion::EdgeCushion;
use freestand_study::study::assessment::{Settings, Spread};

use super::demand::{Demand, Terms};
use super::draw::{Change, Draw, Drawn, draw, key};
use super::object::{AxisGeometry, Body, Model, Subject, Way, own_damping_ratio};
use super::respond::responses;
use super::response::{AxisMotion, Lived, ModelResponse, PadMotion, terms};
use super::slip::slips;
use crate::capacity::Capacity;
use crate::reason::Missing;
use crate::result::{Criterion, TooMild};
use crate::worlds::FloorOfWorld;
use freestand_inventory::Item;
use freestand_inventory::library::Tolerance;

/// An object as it is listed.
#[derive(Debug, Clone)]
pub struct Nominal {
    /// In the plane in which it lifts first.
    pub block: Block,
    /// Height of its floor over that of the building.
    pub level_ratio: f64,
    subject: Subject,
    draw: Draw,
    body: Option<(f64, Cushion)>,
    /// Whether its pads are asked as well as a rigid base.
    with_pads: bool,
    /// Of the random numbers that say on which side its wall is: those of an assessment.
    seed: u64,
    key: u64,
}

/// What it did under one motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NominalRun {
    /// How it ended.
    pub class: OutcomeClass,
    /// Largest |θ|/α of any edge, in three dimensions of the tilt and the smaller α; above 1 where it
    /// overturned; 0 where it rolls or slides. `None`: a stack, or only its pads overturned it.
    pub rotation_ratio: Option<f64>,
    /// Shock from the uplift; `None`: it overturned or did not lift, mass or cushion is not known, or
    /// the cushion bottomed, so that the shock is above any number that can be relied on \[g\].
    pub edge_acceleration_g: Option<f64>,
}

impl NominalRun {
    /// Of two models of the same object, what the worse one says.
    fn worse(self, other: Self) -> Self {
        let class = if other.class.index() > self.class.index() {
            other.class
        } else {
            self.class
        };
        let lifted = [self, other]
            .into_iter()
            .filter(|one| one.class != OutcomeClass::NoUplift);
        // A shock that one of them does not know is above all that the other one finds.
        let shocks_g: Option<Vec<f64>> = lifted.map(|one| one.edge_acceleration_g).collect();
        // The rotation of a model that keeps it upright says nothing where it overturns.
        let is_told = |one: &Self| class != OutcomeClass::Overturned || one.class == class;
        let turned = [self, other].into_iter().filter(is_told);
        Self {
            class,
            rotation_ratio: turned.filter_map(|one| one.rotation_ratio).reduce(f64::max),
            edge_acceleration_g: shocks_g
                .and_then(|shocks_g| shocks_g.into_iter().reduce(f64::max)),
        }
    }
}

/// Why an object cannot be followed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum NotFollowed {
    /// It is anchored.
    Anchored,
    /// These are not known.
    NotGiven(Vec<Missing>),
    /// It has no size.
    NoSize,
}

impl Display for NotFollowed {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Anchored => f.write_str("it is anchored"),
            Self::NotGiven(missing) => {
                let verb = if missing.len() == 1 { "is" } else { "are" };
                write!(f, "{} {verb} not given", Missing::listed(missing))
            }
            Self::NoSize => f.write_str("it has no size"),
        }
    }
}

/// Why the shock alone does not decide whether a tolerance is exceeded.
#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::Display)]
pub enum NoShockLimits {
    /// There is none.
    #[strum(to_string = "it has no tolerance")]
    NoTolerance,
    /// Its shocks do not follow from an uplift on a rigid base.
    #[strum(to_string = "its shocks are not those of an uplift on a rigid base")]
    NotOfUplift,
    /// Its cushion bottoms.
    #[strum(
        to_string = "its cushion bottoms in a landing from the balance point, so that its shocks have no ceiling"
    )]
    NoCeiling,
    /// Mass or cushion are missing.
    #[strum(to_string = "its mass or its cushion is not known")]
    NoBody,
    /// Its tolerance is another one.
    #[strum(to_string = "its tolerance is not a peak acceleration alone")]
    NotPeakAlone,
    /// Its tolerance also limits the rotation.
    #[strum(to_string = "its tolerance also limits the rotation")]
    LimitsRotation,
}

impl Nominal {
    /// The object of a row.
    ///
    /// # Errors
    /// Why it cannot be followed.
    pub fn new(item: &Item, settings: &Settings) -> Result<Self, NotFollowed> {
        if item.anchored == Some(true) {
            return Err(NotFollowed::Anchored);
        }
        let subject = Subject::new(item, settings).map_err(NotFollowed::NotGiven)?;
        let threshold =
            |axis: &AxisGeometry| RockingModel::Rigid.uplift_threshold_ratio(&axis.block);
        let axes = subject.axes.iter().enumerate();
        let first = axes.min_by(|a, b| threshold(a.1).total_cmp(&threshold(b.1)));
        match first.map(|(axis, geometry)| (axis, geometry.block)) {
            Some(first) => Ok(Self::of(first, subject, key(&item.id), settings)),
            None => Err(NotFollowed::NoSize),
        }
    }

    /// An object of any shape; `body` is its mass \[kg\] and the cushion under one edge.
    pub fn of_block(
        block: Block,
        restitution: Restitution,
        body: Option<&(f64, EdgeCushion)>,
        tolerance: Option<&Tolerance>,
    ) -> Self {
        let body = body.map(|(mass_kg, edge)| Body {
            mass_kg: *mass_kg,
            cushion: edge.cushion.clone(),
            pad_thickness_m: edge.pad_thickness_m,
            stiffness_spread: None,
            damping_ratio: own_damping_ratio(&edge.cushion, *mass_kg),
        });
        let subject = Subject {
            level_ratio: 0.0,
            axes: vec![AxisGeometry::of_block(block)],
            restitution,
            friction_ratio: None,
            mass_kg: body.as_ref().map(|body| body.mass_kg),
            body,
            capacity: tolerance.and_then(Capacity::new),
            way: Way::Planar,
            flat: None,
            too_mild: None,
        };
        Self::of((0, block), subject, 0, &Settings::default())
    }

    /// `first`: the axis about which it lifts first, which is the one that moves along x.
    fn of((first, block): (usize, Block), subject: Subject, key: u64, settings: &Settings) -> Self {
        let spread = Spread {
            restitution: 0.0,
            stiffness: 0.0,
            mass: 0.0,
            geometry: 0.0,
            model: 0.0,
            compliant: 0.0,
        };
        let settings = Settings {
            spread,
            ..settings.clone()
        };
        // The middle of what an assessment draws for its pads and its friction.
        let mut draw =
            draw(&settings, &subject, 0, 0, Change::At(Group::Pad, 0.0)).without_factors();
        draw.is_thickness_along_x = first == 0;
        let body = draw.body(&subject);
        Self {
            block,
            level_ratio: subject.level_ratio,
            subject,
            draw,
            body,
            with_pads: settings.compliant,
            seed: settings.seed,
            key,
        }
    }

    /// The same on a rigid base alone, where it rocks on one: its shocks then follow from its uplift.
    pub fn without_pads(self) -> Self {
        Self {
            with_pads: false,
            ..self
        }
    }

    /// Why it may fail where its runs let it stand; `None`: they are not known to be too mild.
    pub fn too_mild(&self) -> Option<TooMild> {
        self.subject
            .way
            .glides()
            .map(|_| TooMild::Glides)
            .or(self.subject.too_mild)
    }

    /// Whether it has a tolerance that can be compared.
    pub fn has_tolerance(&self) -> bool {
        let has_shock = || match self.subject.way.glides() {
            // What rolls or slides is struck by its stop alone.
            Some(gliding) => {
                gliding.clearance_m.is_none()
                    || gliding.stop_stiffness_n_m.is_some() && self.subject.mass_kg.is_some()
            }
            None => self.body.is_some(),
        };
        self.subject
            .capacity
            .as_ref()
            .is_some_and(|capacity| !capacity.needs_shock() || has_shock())
    }

    /// Whether the shock of its landings is known, however it follows from its motion in a plane.
    pub fn has_shock(&self) -> bool {
        self.subject.way.rocks() && self.subject.way.asks(Model::Rigid) && self.body.is_some()
    }

    /// Whether its tolerance is compared with a shock.
    pub fn compares_shock(&self) -> bool {
        self.has_shock()
            && self
                .subject
                .capacity
                .as_ref()
                .is_some_and(Capacity::needs_shock)
    }

    /// Whether its tolerance cannot be compared, because mass or cushion are missing.
    pub fn lacks_shock(&self) -> bool {
        self.subject.capacity.is_some() && !self.has_tolerance()
    }

    /// Its tolerance and the ceiling of its shock, for a fit of shocks \[g\].
    ///
    /// # Errors
    /// Why the shock alone does not decide whether the tolerance is exceeded.
    pub fn shock_limits(&self) -> Result<(f64, f64), NoShockLimits> {
        let capacity = self
            .subject
            .capacity
            .as_ref()
            .ok_or(NoShockLimits::NoTolerance)?;
        if !self.follows_uplift() {
            return Err(NoShockLimits::NotOfUplift);
        }
        let without = match self.body {
            Some(_) => NoShockLimits::NoCeiling,
            None => NoShockLimits::NoBody,
        };
        let ceiling_g = self.ceiling_g().ok_or(without)?;
        match (capacity.edge_criterion(), capacity.peak_m_s2) {
            (Criterion::Peak, Some(peak)) if capacity.edge_lift_m.is_none() => {
                Ok((peak / G0_M_S2, ceiling_g))
            }
            _ => Err(NoShockLimits::NotPeakAlone),
        }
    }

    /// The shock of a landing from the balance point; `None` without mass and cushion, and where the
    /// cushion bottoms \[g\].
    pub fn ceiling_g(&self) -> Option<f64> {
        let (mass_kg, cushion) = self.body.as_ref().filter(|_| self.follows_uplift())?;
        let shock_g = |landing: Landing| {
            landing.edge_acceleration_m_s2(
                *mass_kg,
                cushion,
                landing.pivot.balance_rise_m(),
                G0_M_S2,
            ) / G0_M_S2
        };
        let both = |axis: &AxisGeometry| landings(&axis.block, ImpactModel::Paper);
        let shocks_g: Vec<f64> = self
            .subject
            .axes
            .iter()
            .flat_map(both)
            .map(shock_g)
            .collect();
        let is_known = shocks_g.iter().all(|shock_g| *shock_g <= BEYOND_ALL_G);
        is_known.then(|| shocks_g.into_iter().fold(0.0, f64::max))
    }

    /// Whether it rocks on a rigid base alone, so that its shocks follow from its uplift.
    fn follows_uplift(&self) -> bool {
        let way = &self.subject.way;
        way.rocks() && way.asks(Model::Rigid) && !self.subject.asks(Model::Pads, self.with_pads)
    }

    /// What it does under motions of its floor; beyond `rotation_ratio` of α its tolerance is exceeded, too.
    /// The response, the shock and the comparison are those of an assessment, without the acceleration
    /// of the floor itself: an object that does not lift is `no-uplift`, and so is one that rolls or
    /// slides, unless a stop trips it or strikes it too hard. An error says why a history has no end.
    ///
    /// `world`: the number of the motion, which decides on which side of it a wall is.
    pub fn runs(
        &self,
        world: u32,
        floors: &[FloorOfWorld],
        rotation_ratio: Option<f64>,
    ) -> Vec<Result<NominalRun, String>> {
        // As in an assessment, with the usual restitution where the list gives none.
        let (stiffness_ratio, damping_ratio) = wall_cushion_at(0.5);
        let side = |_| WallDraw {
            is_on_left: wall_draw(self.seed, world, self.key, 0, 0).is_on_left,
            restitution_ratio: DEFAULT_WALL_RESTITUTION_RATIO,
            stiffness_ratio,
            damping_ratio,
        };
        let mut draw = self.draw;
        draw.wall = draw.wall.map(side);
        let lived = self.lived(
            Drawn {
                subject: &self.subject,
                draw: &draw,
            },
            floors,
        );
        lived
            .into_iter()
            .map(|lived| self.run(&lived, rotation_ratio))
            .collect()
    }

    /// A model that cannot follow it, as on pads that bottom, leaves the answer to the other one.
    fn run(&self, lived: &Lived, rotation_ratio: Option<f64>) -> Result<NominalRun, String> {
        let rigid = lived.on_rigid().filter(|_| !lived.is_for_pads());
        let rigid = rigid.map(|told| self.on_rigid(told, rotation_ratio));
        let pads = lived
            .on_pads()
            .map(|told| self.on_pads(told, rotation_ratio));
        let why = || match (&lived.rigid, &lived.pads) {
            (Some(Err(lost)), _) => lost.why().to_owned(),
            (_, Some(Err(lost))) => lost.why().to_owned(),
            _ => "no model follows it".to_owned(),
        };
        rigid
            .into_iter()
            .chain(pads)
            .reduce(NominalRun::worse)
            .ok_or_else(why)
    }

    /// Under each motion by every model that is asked.
    fn lived(&self, one: Drawn<'_>, floors: &[FloorOfWorld]) -> Vec<Lived> {
        let Drawn { subject, draw } = one;
        let [asks_rigid, asks_pads] =
            [Model::Rigid, Model::Pads].map(|model| subject.asks(model, self.with_pads));
        let bases = floors.iter().filter(|_| asks_rigid);
        let bases = bases.map(|floor| Ok((one.on_rigid_base()?, floor.shaking())));
        let mut on_rigid_base = responses(bases).into_iter();
        let of_floor = |floor: &FloorOfWorld| {
            let rigid = on_rigid_base.next();
            let rigid = rigid.map(|found| one.rigid_response(floor, found));
            let slips = slips(subject, draw, floor, rigid.as_ref());
            Lived {
                draw: *draw,
                rigid,
                pads: None,
                slips,
                pfa_m_s2: floor.pfa_m_s2,
                pfv_m_s: Some(floor.pfv_m_s()),
            }
        };
        let mut lived: Vec<Lived> = floors.iter().map(of_floor).collect();
        if asks_pads {
            let on_pads = lived.iter().zip(floors).map(|(lived, floor)| {
                let friction_ratio = draw.friction_ratio.filter(|_| lived.slips);
                Ok((one.on_pads(friction_ratio)?, floor.shaking()))
            });
            let found = responses(on_pads);
            for ((lived, floor), found) in lived.iter_mut().zip(floors).zip(found) {
                lived.pads = Some(one.pad_response(floor, found));
            }
        }
        lived
    }

    fn on_rigid(
        &self,
        told: &ModelResponse<AxisMotion>,
        rotation_ratio: Option<f64>,
    ) -> NominalRun {
        let ModelResponse { outcome, axes } = told;
        let turned = self
            .subject
            .axes
            .iter()
            .zip(axes)
            .map(|(axis, one)| turned(&axis.block, one))
            .fold(0.0, f64::max);
        let exceeds = || {
            rotation_ratio.is_some_and(|limit| turned > limit)
                || axes
                    .iter()
                    .enumerate()
                    .any(|(axis, one)| self.exceeds(axis, one))
        };
        let class = class(*outcome, exceeds);
        let rocks = matches!(outcome, Outcome::Rocked { .. });
        // A cushion that bottoms about one axis hides the shock of the object.
        let lifted = axes.iter().filter(|one| one.lifts());
        let shocks_g: Option<Vec<f64>> = lifted.map(|one| Some(one.hit()?.uplift_g)).collect();
        let shock_g = shocks_g
            .filter(|_| rocks)
            .and_then(|shocks_g| shocks_g.into_iter().reduce(f64::max));
        NominalRun {
            class,
            rotation_ratio: Some(turned),
            edge_acceleration_g: shock_g.filter(|shock_g| *shock_g > 0.0),
        }
    }

    fn on_pads(&self, told: &ModelResponse<PadMotion>, rotation_ratio: Option<f64>) -> NominalRun {
        let ModelResponse { outcome, axes } = told;
        let alpha_rad = self.block.pivot().slenderness_angle_rad;
        let turned = axes
            .iter()
            .find_map(|one| one.space)
            .map(|space| space.tilt_rad / alpha_rad);
        let exceeds = || {
            turned
                .zip(rotation_ratio)
                .is_some_and(|(turned, limit)| turned > limit)
                || axes
                    .iter()
                    .any(|one| one.terms.is_some_and(|terms| terms.ratio() > 1.0))
        };
        let class = class(*outcome, exceeds);
        let edge_m_s2 = axes.iter().map(|one| one.edge_m_s2).fold(0.0, f64::max);
        let rocks = matches!(outcome, Outcome::Rocked { .. }) && edge_m_s2 > 0.0;
        NominalRun {
            class,
            rotation_ratio: turned,
            edge_acceleration_g: rocks.then_some(edge_m_s2 / G0_M_S2),
        }
    }

    /// Whether its tolerance is exceeded about an axis.
    ///
    /// Where a cushion bottoms, the shock is above every peak that an object tolerates. Leaving such a
    /// run out would leave out the strong motions that did not overturn it.
    fn exceeds(&self, axis: usize, one: &AxisMotion) -> bool {
        let is_over = |terms: Terms| terms.ratio() > 1.0;
        let Some(rocking) = one.rocking() else {
            return one.terms.is_some_and(is_over);
        };
        if rocking.outcome == Rocking::NoUplift || !self.has_tolerance() {
            return false;
        }
        let at_least = || {
            terms(
                self.subject.capacity.as_ref()?,
                self.bottomed(axis, rocking.sides),
                false,
                rocking.uplift_m,
                0.0,
            )
        };
        one.terms.or_else(at_least).is_some_and(is_over)
    }

    /// The demand of a landing in which the cushion bottoms: a peak above all, and the velocity change
    /// of the edge, which does not depend on the cushion and may be within a damage boundary.
    fn bottomed(&self, axis: usize, sides: [SideExtremes; 2]) -> Option<Demand> {
        let (mass_kg, cushion) = self.body.as_ref()?;
        let landings = landings(&self.subject.axes.get(axis)?.block, ImpactModel::Paper);
        let speeds_m_s = landings.iter().zip(sides).map(|(landing, side)| {
            let from_uplift = landing.pivot.largest_rise_m(side.peak_rotation_rad);
            let from_velocity = landing.equivalent_rise_m(side.impact_omega_rad_s, G0_M_S2);
            landing
                .impact(*mass_kg, cushion, from_uplift.max(from_velocity), G0_M_S2)
                .edge_velocity_m_s
        });
        let velocity_change_m_s =
            (1.0 + self.draw.rebound_restitution()) * speeds_m_s.fold(0.0, f64::max);
        Some(Demand {
            edge_m_s2: f64::INFINITY,
            velocity_change_m_s,
            duration_s: 0.0,
        })
    }
}

/// The class of an outcome; `exceeds`: whether a tolerance is exceeded by an object that stays upright.
fn class(outcome: Outcome, exceeds: impl FnOnce() -> bool) -> OutcomeClass {
    match (outcome, outcome.has_fallen()) {
        (_, Some(true)) => OutcomeClass::Overturned,
        (Outcome::Stood, _) => OutcomeClass::NoUplift,
        _ if exceeds() => OutcomeClass::Exceeded,
        (Outcome::Rolled(_) | Outcome::Slid(_), _) => OutcomeClass::NoUplift,
        _ => OutcomeClass::Rocked,
    }
}

/// Largest |θ|/α of either edge; 0 where it rolls or slides and is not tripped.
fn turned(block: &Block, one: &AxisMotion) -> f64 {
    let Some(rocking) = one.rocking() else {
        let of_body = one.peak_rotation_rad();
        return of_body.unwrap_or(0.0) / block.pivot().slenderness_angle_rad;
    };
    let pivots = [block.right_pivot(), block.pivot()];
    let share = |(pivot, side): (freestand::block::Pivot, SideExtremes)| {
        side.peak_rotation_rad / pivot.slenderness_angle_rad
    };
    pivots
        .into_iter()
        .zip(rocking.sides)
        .map(share)
        .fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use freestand::cushion::ContactLaw;
    use freestand::motion::Motion;

    use super::*;
    use freestand_inventory::library::Confidence;

    fn cabinet(cushion: Cushion, tolerance: &Tolerance) -> Nominal {
        let block = Block::uniform(1.8, 0.4).unwrap();
        let edge = EdgeCushion {
            cushion,
            pad_thickness_m: None,
            notes: Vec::new(),
        };
        Nominal::of_block(
            block,
            Restitution::Housner,
            Some(&(150.0, edge)),
            Some(tolerance),
        )
        .without_pads()
    }

    /// On a rigid base a pad that bottoms changes the shock, and neither rocking nor overturning: the class is exceeded
    /// where the shock is compared, and rocked where the uplift is, or where the velocity change of
    /// a damage boundary is not exceeded.
    #[test]
    fn a_pad_that_bottoms_hides_no_run() {
        let tolerance = |peak_g: Option<f64>, velocity_change_m_s, edge_lift_m| Tolerance {
            peak_m_s2: peak_g.map(|g| g * G0_M_S2),
            duration_s: None,
            velocity_change_m_s,
            edge_lift_m,
            source: "a test".to_owned(),
            confidence: Confidence::Stated,
        };
        let linear = || Cushion::linear(4.38e6).unwrap();
        let bottoms = || {
            Cushion::new(ContactLaw::Tangent {
                stiffness_n_m: 4.38e6,
                bottoming_m: 0.2e-3,
            })
            .unwrap()
        };
        let run = |nominal: &Nominal, peak_g: f64| {
            let sine =
                |i: usize| peak_g * G0_M_S2 * (std::f64::consts::TAU * 0.01 * i as f64 / 0.8).sin();
            let motion = Motion::new(0.01, (0..=160).map(sine).collect()).unwrap();
            nominal
                .runs(0, &[FloorOfWorld::given(&motion, None)], None)
                .remove(0)
                .unwrap()
        };
        let peak = tolerance(Some(50.0), None, None);
        let (soft, hard) = (cabinet(linear(), &peak), cabinet(bottoms(), &peak));
        let mut bottomed = 0;
        for i in 0..60 {
            let peak_g = 0.2 + 0.01 * f64::from(i);
            let (one, other) = (run(&soft, peak_g), run(&hard, peak_g));
            assert_eq!(one.rotation_ratio, other.rotation_ratio, "{peak_g} g");
            assert_eq!(
                one.class == OutcomeClass::Overturned,
                other.class == OutcomeClass::Overturned,
                "{peak_g} g"
            );
            if matches!(other.class, OutcomeClass::Exceeded) && other.edge_acceleration_g.is_none()
            {
                bottomed += 1;
                let class =
                    |tolerance: &Tolerance| run(&cabinet(bottoms(), tolerance), peak_g).class;
                assert_eq!(
                    class(&tolerance(None, None, Some(5.0))),
                    OutcomeClass::Rocked
                );
                // No landing of a cabinet changes the velocity of its edge by 50 m/s, and each by 1 µm/s.
                assert_eq!(
                    class(&tolerance(Some(5.0), Some(50.0), None)),
                    OutcomeClass::Rocked
                );
                assert_eq!(
                    class(&tolerance(Some(5.0), Some(1e-6), None)),
                    OutcomeClass::Exceeded
                );
            }
        }
        assert!(bottomed >= 3, "{bottomed}");
        assert!(soft.shock_limits().is_ok());
        assert_eq!(hard.shock_limits(), Err(NoShockLimits::NoCeiling));
    }
}
