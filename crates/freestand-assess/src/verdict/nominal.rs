//! An object exactly as it is listed, with nothing drawn, on a rigid base: for fragilities, in which
//! the motions alone differ.

use freestand::block::Block;
use freestand::cushion::Cushion;
use freestand::fragility::OutcomeClass;
use freestand::impact::ImpactModel;
use freestand::rocking::{Base, Outcome, Restitution, RockingError, rock_between};
use freestand::spectra::{BEYOND_ALL_G, landings};
use freestand::wall::{DEFAULT_WALL_RESTITUTION_RATIO, Walls};
use freestand::worlds::{Group, WallDraw};
use freestand::{G0_M_S2, rocking::RockingSummary};
use freestand_study::cushion::EdgeCushion;
use freestand_study::study::assessment::{Settings, Spread};

use super::capacity::{Capacity, Demand};
use super::draw::{Change, Draw, draw, own_damping_ratio};
use super::object::{Body, Subject, Way};
use super::response::{axis_motion, options, terms};
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
    /// Shock from the uplift; `None`: it overturned or did not lift, mass or cushion is not known, or
    /// the cushion bottomed, so that the shock is above any number that can be relied on \[g\].
    pub(crate) edge_acceleration_g: Option<f64>,
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
        let without = match self.body {
            Some(_) => "its cushion bottoms in a landing from the balance point, so that its shocks have no ceiling",
            None => "its mass or its cushion is not known",
        };
        let ceiling_g = self.ceiling_g().ok_or(without)?;
        match (capacity.edge_criterion(), capacity.peak_m_s2) {
            (Criterion::Peak, Some(peak)) if capacity.edge_lift_m.is_none() => Ok((peak / G0_M_S2, ceiling_g)),
            _ => Err("its tolerance is not a peak acceleration alone"),
        }
    }

    /// The shock of a landing from the balance point; `None` without mass and cushion, and where the
    /// cushion bottoms \[g\].
    pub(crate) fn ceiling_g(&self) -> Option<f64> {
        let (mass_kg, cushion) = self.body.as_ref()?;
        let shock_g = |landing: &freestand::impact::Landing| {
            landing.edge_acceleration_m_s2(*mass_kg, cushion, landing.pivot.balance_rise_m(), G0_M_S2) / G0_M_S2
        };
        let shocks_g: Vec<f64> = landings(&self.block, ImpactModel::Paper).iter().map(shock_g).collect();
        let is_known = shocks_g.iter().all(|shock_g| *shock_g <= BEYOND_ALL_G);
        is_known.then(|| shocks_g.into_iter().fold(0.0, f64::max))
    }

    /// What it does under a motion; beyond `rotation_ratio` of α its tolerance is exceeded, too. The
    /// solver, the shock and the comparison are those of an assessment, without the acceleration of
    /// the floor itself: an object that does not lift is `no-uplift`.
    ///
    /// # Errors
    /// Why the history has no end.
    pub(crate) fn run(&self, base: Base, rotation_ratio: Option<f64>) -> Result<NominalRun, RockingError> {
        let one = [(self.block, self.subject.restitution, self.walls)];
        let found = rock_between(&one, base, &options(Restitution::Housner, Walls::NONE));
        // One block has one history.
        let rocking = found.into_iter().next().unwrap_or(Err(RockingError::Duration { duration_s: 0.0 }))?;
        let share = |(pivot, peak_rad): (freestand::block::Pivot, f64)| peak_rad / pivot.slenderness_angle_rad;
        let pivots = [self.block.right_pivot(), self.block.pivot()];
        let peaks = rocking.sides.map(|side| side.peak_rotation_rad);
        let turned = pivots.into_iter().zip(peaks).map(share).fold(0.0, f64::max);
        let class = match rocking.outcome {
            Outcome::NoUplift => OutcomeClass::NoUplift,
            Outcome::Overturned | Outcome::Leaned => OutcomeClass::Overturned,
            Outcome::Rocked => self.rocked(rocking, turned, rotation_ratio),
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
    ///
    /// Where a cushion bottoms, the shock is above every peak that an object tolerates. Leaving such a
    /// run out would leave out the strong motions that did not overturn it.
    fn rocked(&self, rocking: RockingSummary, turned: f64, rotation_ratio: Option<f64>) -> OutcomeClass {
        if rotation_ratio.is_some_and(|limit| turned > limit) {
            return OutcomeClass::Exceeded;
        }
        if !self.has_tolerance() {
            return OutcomeClass::Rocked;
        }
        let bottomed = self.bottomed(&rocking);
        let uplift_m = rocking.uplift_m;
        let motion = axis_motion(&self.subject, &self.draw, 0, &self.block, rocking, self.body.as_ref(), 0.0);
        let at_least = || terms(self.subject.capacity.as_ref()?, bottomed, false, uplift_m, 0.0);
        match motion.terms.or_else(at_least) {
            Some(terms) if terms.ratio() > 1.0 => OutcomeClass::Exceeded,
            _ => OutcomeClass::Rocked,
        }
    }

    /// The demand of a landing in which the cushion bottoms: a peak above all, and the velocity change
    /// of the edge, which does not depend on the cushion and may be within a damage boundary.
    fn bottomed(&self, rocking: &RockingSummary) -> Option<Demand> {
        let (mass_kg, cushion) = self.body.as_ref()?;
        let landings = landings(&self.block, ImpactModel::Paper);
        let speeds_m_s = landings.iter().zip(rocking.sides).map(|(landing, side)| {
            let from_uplift = landing.pivot.largest_rise_m(side.peak_rotation_rad);
            let from_velocity = landing.equivalent_rise_m(side.impact_omega_rad_s, G0_M_S2);
            landing.impact(*mass_kg, cushion, from_uplift.max(from_velocity), G0_M_S2).edge_velocity_m_s
        });
        let velocity_change_m_s = (1.0 + self.draw.rebound_restitution()) * speeds_m_s.fold(0.0, f64::max);
        Some(Demand { edge_m_s2: f64::INFINITY, velocity_change_m_s, duration_s: 0.0 })
    }
}

#[cfg(test)]
mod tests {
    use freestand::cushion::ContactLaw;
    use freestand::motion::Motion;

    use super::*;
    use crate::library::Confidence;

    fn cabinet(cushion: Cushion, tolerance: &Tolerance) -> Nominal {
        let block = Block::uniform(1.8, 0.4).unwrap();
        let edge = EdgeCushion { cushion, pad_thickness_m: None, notes: Vec::new() };
        Nominal::of_block(block, Restitution::Housner, Some(&(150.0, edge)), Some(tolerance))
    }

    /// A pad that bottoms changes the shock, and neither rocking nor overturning: the class is exceeded
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
        let bottoms = || Cushion::new(ContactLaw::Tangent { stiffness_n_m: 4.38e6, bottoming_m: 0.2e-3 }).unwrap();
        let run = |nominal: &Nominal, peak_g: f64| {
            let sine = |i: usize| peak_g * G0_M_S2 * (std::f64::consts::TAU * 0.01 * i as f64 / 0.8).sin();
            let motion = Motion::new(0.01, (0..=160).map(sine).collect()).unwrap();
            nominal.run(Base { horizontal: Some(&motion), vertical: None }, None).unwrap()
        };
        let peak = tolerance(Some(50.0), None, None);
        let (soft, hard) = (cabinet(linear(), &peak), cabinet(bottoms(), &peak));
        let mut bottomed = 0;
        for i in 0..60 {
            let peak_g = 0.2 + 0.01 * f64::from(i);
            let (one, other) = (run(&soft, peak_g), run(&hard, peak_g));
            assert_eq!(one.rotation_ratio, other.rotation_ratio, "{peak_g} g");
            assert_eq!(one.class == OutcomeClass::Overturned, other.class == OutcomeClass::Overturned, "{peak_g} g");
            if matches!(other.class, OutcomeClass::Exceeded) && other.edge_acceleration_g.is_none() {
                bottomed += 1;
                let class = |tolerance: &Tolerance| run(&cabinet(bottoms(), tolerance), peak_g).class;
                assert_eq!(class(&tolerance(None, None, Some(5.0))), OutcomeClass::Rocked);
                // No landing of a cabinet changes the velocity of its edge by 50 m/s, and each by 1 µm/s.
                assert_eq!(class(&tolerance(Some(5.0), Some(50.0), None)), OutcomeClass::Rocked);
                assert_eq!(class(&tolerance(Some(5.0), Some(1e-6), None)), OutcomeClass::Exceeded);
            }
        }
        assert!(bottomed >= 3, "{bottomed}");
        assert!(soft.shock_limits().is_ok() && hard.shock_limits().unwrap_err().contains("bottoms"));
    }
}
