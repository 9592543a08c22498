//! The motions of any floor: computed through the building of the study, or given by the study.

use std::collections::HashMap;
use std::ops::ControlFlow;
use std::sync::{Arc, Mutex, PoisonError};

use freestand::G0_M_S2;
use freestand::motion::Motion;
use rayon::prelude::*;

use crate::result::FloorFacts;
use freestand_input::problem::{Problem, ProblemKind, Problems};
use freestand_records::horizontal::HorizontalMotion;
use freestand_study::result::GroundMotion;
use freestand_study::run::{Progress, Stage, Step, floors_under, ground_motions};
use freestand_study::statistics::ranked_quantile;
use freestand_study::study::{Level, Study};

/// Largest difference between two level ratios of the same floor: inventories give two or three
/// digits.
const SAME_LEVEL: f64 = 5e-3;

/// The ground motions of a study, and the floor motions made from them.
#[derive(Debug)]
pub(crate) struct Hazard<'a> {
    study: &'a Study,
    pub(crate) names: Vec<String>,
    ground: Vec<GroundMotion>,
    /// Floors that were made, for the next parts.
    held: Mutex<Floors>,
}

/// Floors by the bits of their level.
pub(crate) type Floors = HashMap<u64, Arc<Floor>>;

/// Floors that are kept in memory: 32 floors of 20 motions of one minute take about 100 MB.
pub(crate) const MAX_FLOORS_HELD: usize = 32;

/// The motions of one floor: for each ground motion one in each direction that is tried.
#[derive(Debug)]
pub(crate) struct Floor {
    /// `[motion][direction]`.
    pub(crate) motions: Vec<Vec<Motion>>,
    /// Peak acceleration of each motion in any direction \[m/s²\].
    pub(crate) pfa_m_s2: Vec<f64>,
    pub(crate) facts: FloorFacts,
}

impl<'a> Hazard<'a> {
    /// Generates the ground motions, or takes those that the study gives.
    pub(crate) fn new(study: &'a Study, progress: Progress) -> Result<Self, Problems> {
        let go_on = || match progress(Step { stage: Some(Stage::GroundMotions), done: 0, total: 0 }) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(Problem::stopped().into()),
        };
        let ground = ground_motions(&study.ground, go_on)?;
        Ok(Self { study, names: study.ground.names(&study.levels), ground, held: Mutex::default() })
    }

    /// The floors of these levels, at most [`MAX_FLOORS_HELD`]; a level for which the study has no
    /// motion is missing.
    pub(crate) fn floors(&self, levels: &[f64]) -> Result<Floors, Problems> {
        let mut held = self.held.lock().unwrap_or_else(PoisonError::into_inner);
        let missing: Vec<f64> = levels.iter().copied().filter(|level| !held.contains_key(&level.to_bits())).collect();
        if held.len() + missing.len() > MAX_FLOORS_HELD {
            held.retain(|bits, _| levels.iter().any(|level| level.to_bits() == *bits));
        }
        held.extend(self.made(&missing)?);
        let of = |level: &f64| Some((level.to_bits(), Arc::clone(held.get(&level.to_bits())?)));
        Ok(levels.iter().filter_map(of).collect())
    }

    fn made(&self, levels: &[f64]) -> Result<Floors, Problems> {
        let by_level: Vec<(f64, Vec<HorizontalMotion>)> = match &self.study.building {
            Some(building) => {
                let mut by_level: Vec<(f64, Vec<HorizontalMotion>)> =
                    levels.iter().map(|&level| (level, Vec::new())).collect();
                let by_motion: Vec<Result<_, Problems>> =
                    self.ground.par_iter().map(|ground| floors_under(ground, building, levels)).collect();
                for floors in by_motion {
                    for ((_, motions), floor) in by_level.iter_mut().zip(floors?) {
                        motions.push(floor);
                    }
                }
                by_level
            }
            None => levels.iter().filter_map(|&level| Some((level, self.given(level)?))).collect(),
        };
        let made = |(level, motions): (f64, Vec<HorizontalMotion>)| {
            Ok((level.to_bits(), Arc::new(self.floor(level, &motions)?)))
        };
        by_level.into_iter().map(made).collect()
    }

    /// The motions that the study gives for a level.
    fn given(&self, level_ratio: f64) -> Option<Vec<HorizontalMotion>> {
        let away = |level: &&Level| level.level_ratio.map_or(f64::INFINITY, |ratio| (ratio - level_ratio).abs());
        let nearest = self.study.levels.iter().min_by(|a, b| away(a).total_cmp(&away(b)));
        let level = nearest.filter(|level| away(level) <= SAME_LEVEL)?;
        Some(level.motions.iter().map(freestand_study::study::RecordedMotion::as_used).collect())
    }

    fn floor(&self, level_ratio: f64, motions: &[HorizontalMotion]) -> Result<Floor, Problems> {
        let failed = |error: freestand::motion::MotionError| {
            Problems::from(Problem::new(ProblemKind::Computation, format!("a floor motion cannot be rotated: {error}")))
        };
        let turned = |motion: &HorizontalMotion| -> Result<Vec<Motion>, Problems> {
            let directions = self.study.directions_deg.iter();
            directions.map(|&deg| Ok(motion.in_direction(deg).map_err(failed)?.into_owned())).collect()
        };
        let pfa_m_s2: Vec<f64> = motions.iter().map(HorizontalMotion::peak_m_s2).collect();
        let median = |mut values: Vec<f64>| ranked_quantile(&mut values, 0.5).value().unwrap_or(0.0);
        let facts = FloorFacts {
            level_ratio,
            pfa_g_median: median(pfa_m_s2.clone()) / G0_M_S2,
            pfa_g_max: pfa_m_s2.iter().copied().fold(0.0, f64::max) / G0_M_S2,
            pfv_m_s_median: median(motions.iter().map(HorizontalMotion::peak_velocity_m_s).collect()),
        };
        Ok(Floor { motions: motions.iter().map(turned).collect::<Result<_, _>>()?, pfa_m_s2, facts })
    }
}
