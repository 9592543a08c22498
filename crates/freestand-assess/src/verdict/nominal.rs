//! An object exactly as it is listed, with nothing drawn, on a rigid base: for fragilities, in which
//! the motions alone differ.

use freestand::block::Block;
use freestand::cushion::Cushion;
use freestand::fragility::OutcomeClass;
use freestand::impact::ImpactModel;
use freestand::rocking::{Base, Outcome, Restitution, RockingError, rock_between};
use freestand::spectra::landings;
use freestand::wall::{DEFAULT_WALL_RESTITUTION_RATIO, Walls};
use freestand::worlds::{Group, WallDraw};
use freestand::{G0_M_S2, rocking::RockingSummary};
use freestand_study::cushion::EdgeCushion;
use freestand_study::study::assessment::{Settings, Spread};

use super::capacity::Capacity;
use super::draw::{Change, Draw, draw, own_damping_ratio};
use super::object::{Body, Subject, Way};
use super::response::{axis_motion, options};
use crate::inventory::Item;
use crate::library::Tolerance;
use crate::output::words::listed;
use crate::result::Criterion;

/// An object as it is listed.
#[derive(Debug, Clone)]
pub(crate) struct Nominal {
    /// In the plane of its thickness.
    pub(crate) block: Block,
    /// Height of its floor over that of the building.
    pub(crate) level_ratio: f64,
    subject: Subject,
    draw: Draw,
    walls: Walls,
    body: Option<(f64, Cushion)>,
}

/// What it did under one motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct NominalRun {
    /// How it ended.
    pub(crate) class: OutcomeClass,
    /// Largest |θ|/α of either edge; above 1 where it overturned.
    pub(crate) rotation_ratio: f64,
    /// Shock from the uplift; `None`: it overturned or did not lift, or mass or cushion is not
    /// known \[g\].
    pub(crate) edge_acceleration_g: Option<f64>,
}

/// Why a run has no outcome.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Unresolved {
    /// The history has no end.
    History(RockingError),
    /// The cushion bottoms, so that no shock can be compared with the tolerance.
    Bottomed,
}

impl Nominal {
    /// The object of a row.
    ///
    /// # Errors
    /// Why a rigid base on two edges is not its model, in words.
    pub(crate) fn new(item: &Item, settings: &Settings) -> Result<Self, String> {
        if item.anchored == Some(true) {
            return Err("it is anchored".to_owned());
        }
        let subject = Subject::new(item, settings).map_err(|missing| {
            let verb = if missing.len() == 1 { "is" } else { "are" };
            format!("its {} {verb} not given", listed(&missing))
        })?;
        let why = match subject.way {
            Way::Planar | Way::Walled(_) | Way::Spatial(_) => None,
            Way::Rolls(_) => Some("it rolls on free casters before it could rock"),
            Way::Slides(_) => Some("its friction lets it slide before it could rock"),
            Way::Stack(_) => Some("another object stands on it"),
        };
        match (why, subject.axes.first()) {
            (Some(why), _) => Err(why.to_owned()),
            (None, None) => Err("it has no size".to_owned()),
            (None, Some(axis)) => Ok(Self::of(axis.block, subject, settings)),
        }
    }

    /// An object of any shape; `body` is its mass \[kg\] and the cushion under one edge.
    pub(crate) fn of_block(
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
            axes: Vec::new(),
            restitution,
            friction_ratio: None,
            mass_kg: body.as_ref().map(|body| body.mass_kg),
            body,
            capacity: tolerance.and_then(Capacity::new),
            way: Way::Planar,
            flat: None,
        };
        Self::of(block, subject, &Settings::default())
    }

    fn of(block: Block, subject: Subject, settings: &Settings) -> Self {
        let spread = Spread { restitution: 0.0, stiffness: 0.0, mass: 0.0, geometry: 0.0, model: 0.0, compliant: 0.0 };
        let settings = Settings { spread, ..settings.clone() };
        // The middle of what an assessment draws for its pads.
        let mut draw = draw(&settings, &subject, 0, 0, Change::At(Group::Pad, 0.0)).without_factors();
        // The wall is behind it, with the usual restitution where the list gives none.
        draw.wall = draw.wall.map(|_| WallDraw { is_on_left: true, restitution_ratio: DEFAULT_WALL_RESTITUTION_RATIO });
        let walls = draw.walls(&subject, 0);
        let body = draw.body(&subject);
        Self { block, level_ratio: subject.level_ratio, subject, draw, walls, body }
    }

    /// Whether it has a tolerance that can be compared.
    pub(crate) fn has_tolerance(&self) -> bool {
        self.subject.capacity.as_ref().is_some_and(|capacity| !capacity.needs_shock() || self.body.is_some())
    }

    /// Whether its tolerance is compared with a shock.
    pub(crate) fn compares_shock(&self) -> bool {
        self.body.is_some() && self.subject.capacity.as_ref().is_some_and(Capacity::needs_shock)
    }

    /// Whether its tolerance cannot be compared, because mass or cushion are missing.
    pub(crate) fn lacks_shock(&self) -> bool {
        self.subject.capacity.is_some() && !self.has_tolerance()
    }

    /// Its tolerance and the ceiling of its shock, for a fit of shocks \[g\].
    ///
    /// # Errors
    /// Why the shock alone does not decide whether the tolerance is exceeded, in words.
    pub(crate) fn shock_limits(&self) -> Result<(f64, f64), &'static str> {
        let capacity = self.subject.capacity.as_ref().ok_or("it has no tolerance")?;
        let ceiling_g = self.ceiling_g().ok_or("its mass or its cushion is not known")?;
        match (capacity.edge_criterion(), capacity.peak_m_s2) {
            (Criterion::Peak, Some(peak)) if capacity.edge_lift_m.is_none() => Ok((peak / G0_M_S2, ceiling_g)),
            _ => Err("its tolerance is not a peak acceleration alone"),
        }
    }

    /// The shock of a landing from the balance point; `None` without mass and cushion \[g\].
    pub(crate) fn ceiling_g(&self) -> Option<f64> {
        let (mass_kg, cushion) = self.body.as_ref()?;
        let shock_g = |landing: &freestand::impact::Landing| {
            landing.edge_acceleration_m_s2(*mass_kg, cushion, landing.pivot.balance_rise_m(), G0_M_S2) / G0_M_S2
        };
        Some(landings(&self.block, ImpactModel::Paper).iter().map(shock_g).fold(0.0, f64::max))
    }

    /// What it does under a motion; beyond `rotation_ratio` of α its tolerance is exceeded, too. The
    /// solver, the shock and the comparison are those of an assessment, without the acceleration of
    /// the floor itself: an object that does not lift is `no-uplift`.
    pub(crate) fn run(&self, base: Base, rotation_ratio: Option<f64>) -> Result<NominalRun, Unresolved> {
        let one = [(self.block, self.subject.restitution, self.walls)];
        let found = rock_between(&one, base, &options(Restitution::Housner, Walls::NONE));
        let rocking = found.into_iter().next().unwrap_or(Err(RockingError::Duration { duration_s: 0.0 }));
        let rocking = rocking.map_err(Unresolved::History)?;
        let share = |(pivot, peak_rad): (freestand::block::Pivot, f64)| peak_rad / pivot.slenderness_angle_rad;
        let pivots = [self.block.right_pivot(), self.block.pivot()];
        let peaks = rocking.sides.map(|side| side.peak_rotation_rad);
        let turned = pivots.into_iter().zip(peaks).map(share).fold(0.0, f64::max);
        let class = match rocking.outcome {
            Outcome::NoUplift => OutcomeClass::NoUplift,
            Outcome::Overturned | Outcome::Leaned => OutcomeClass::Overturned,
            Outcome::Rocked => self.rocked(rocking, turned, rotation_ratio)?,
        };
        let shock_g = || {
            let (mass_kg, cushion) = self.body.as_ref()?;
            super::object::hit(&self.block, &rocking, *mass_kg, cushion).map(|hit| hit.uplift_g)
        };
        let rocks = matches!(class, OutcomeClass::Rocked | OutcomeClass::Exceeded);
        let edge_acceleration_g = rocks.then(shock_g).flatten().filter(|shock_g| *shock_g > 0.0);
        Ok(NominalRun { class, rotation_ratio: turned, edge_acceleration_g })
    }

    /// The class of an object that rocked and stayed upright.
    fn rocked(
        &self,
        rocking: RockingSummary,
        turned: f64,
        rotation_ratio: Option<f64>,
    ) -> Result<OutcomeClass, Unresolved> {
        if rotation_ratio.is_some_and(|limit| turned > limit) {
            return Ok(OutcomeClass::Exceeded);
        }
        if !self.has_tolerance() {
            return Ok(OutcomeClass::Rocked);
        }
        let motion = axis_motion(&self.subject, &self.draw, 0, &self.block, rocking, self.body.as_ref(), 0.0);
        match motion.terms.map(|terms| terms.ratio()) {
            Some(ratio) if ratio > 1.0 => Ok(OutcomeClass::Exceeded),
            Some(_) => Ok(OutcomeClass::Rocked),
            None => Err(Unresolved::Bottomed),
        }
    }
}
