//! From a study to its result: ground motions, floor motions, every object on every floor under
//! every motion.

mod doubts;
mod motions;

use std::ops::ControlFlow;
use std::sync::Arc;

use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::impact::{ImpactModel, Landing};
use freestand::motion::Motion;
use freestand::respond::{HistoryOptions, RigidHistory, RigidPlane, Settings};
use freestand::rocking::{Base, Outcome, RockingError};
use freestand::spectra::{UpliftCell, uplift_spectrum};
use freestand::wall::Walls;
use rayon::prelude::*;

use crate::cushion::BOTTOMED;
use crate::result::{ExampleHistory, LevelResult, ObjectResponse, StudyResult};
use crate::statistics::object_statistics;
use crate::study::{Level, Study, StudyDoubt};
use freestand_input::problem::{Problem, Problems};
use freestand_records::horizontal::HorizontalMotion;
use motions::{floor_profile, floors, spectrum_of, verticals};
pub use motions::{floors_under, ground_motions};

pub use freestand::rocking::LONGEST_TAIL_S;

/// Damping of all spectra in figures.
pub use freestand::oscillator::DAMPING_RATIO as SPECTRUM_DAMPING_RATIO;

/// What a run is doing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say what is calculated")]
pub enum Stage {
    GroundMotions,
    FloorMotions,
    RockingHistories,
    /// The questions about the objects of an inventory.
    Objects,
}

impl Stage {
    /// The name next to the bar of progress.
    pub fn name(self) -> &'static str {
        match self {
            Self::GroundMotions => "ground motions",
            Self::FloorMotions => "floor motions",
            Self::RockingHistories => "rocking histories",
            Self::Objects => "questions settled",
        }
    }
}

/// How far a run has come.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Step {
    /// What is being done; `None`: nothing new, the call only asks whether to stop.
    pub stage: Option<Stage>,
    /// Histories that are done.
    pub done: usize,
    /// Histories in all.
    pub total: usize,
    /// The effort that is done, and that of the whole run as far as it is known; `None`: as `done` and `total`.
    pub effort: Option<(u64, u64)>,
}

impl Step {
    /// So much is done of a stage.
    pub fn new(stage: Stage, done: usize, total: usize) -> Self {
        Self {
            stage: Some(stage),
            done,
            total,
            effort: None,
        }
    }

    /// Nothing new: whether to stop.
    pub fn asks() -> Self {
        Self {
            stage: None,
            done: 0,
            total: 0,
            effort: None,
        }
    }

    /// The share of the effort that is done.
    pub fn share(&self) -> f64 {
        let (done, total) = self.effort.unwrap_or((self.done as u64, self.total as u64));
        done as f64 / total.max(1) as f64
    }
}

/// Called after each step; `Break` stops the run.
pub type Progress<'a> = &'a (dyn Fn(Step) -> ControlFlow<()> + Sync);

/// A [`Progress`] that does nothing.
pub fn no_progress(_: Step) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// Periods at which spectra are shown \[s\]: 0.02 to 10 s, 20 a decade.
pub fn spectrum_periods_s() -> Vec<f64> {
    let (first, last, count) = (0.02f64, 10.0f64, 109);
    (0..count)
        .map(|i| first * (last / first).powf(f64::from(i) / f64::from(count - 1)))
        .collect()
}

/// Runs `study` on the current thread pool; the result does not depend on the number of threads.
///
/// # Errors
/// A motion that cannot be calculated, or a run that was stopped. A history that fails is a row
/// with its reason, not an error.
pub fn run(study: &Study, progress: Progress) -> Result<StudyResult, Problems> {
    let names = study.ground.names(&study.levels);
    let directions = study.directions_deg.len();
    let total = study.levels.len() * study.objects.blocks.len() * names.len() * directions;
    let tell = |stage, done| {
        progress(Step::new(stage, done, total))
            .is_continue()
            .then_some(())
            .ok_or_else(|| Problems::from(Problem::stopped()))
    };
    let ground = ground_motions(&study.ground, || tell(Stage::GroundMotions, 0))?;
    let floors = floors(study, &ground, || tell(Stage::FloorMotions, 0))?;
    let verticals = verticals(study, &ground)?;
    let profile = floor_profile(study, &ground, || tell(Stage::FloorMotions, 0))?;

    let finished = std::sync::atomic::AtomicUsize::new(0);
    let pairs: Vec<(usize, usize)> = (0..study.levels.len())
        .flat_map(|level| (0..names.len()).map(move |motion| (level, motion)))
        .collect();
    let responses: Vec<Vec<ObjectResponse>> = pairs
        .par_iter()
        .map(|&(level, motion)| {
            let mut governing: Vec<ObjectResponse> = Vec::new();
            for &direction_deg in &study.directions_deg {
                let row = object_responses(
                    study,
                    &floors[level][motion],
                    verticals[level][motion].as_deref(),
                    direction_deg,
                );
                let done =
                    finished.fetch_add(row.len(), std::sync::atomic::Ordering::Relaxed) + row.len();
                tell(Stage::RockingHistories, done)?;
                governing = if governing.is_empty() {
                    row
                } else {
                    larger(governing, row)
                };
            }
            Ok(governing)
        })
        .collect::<Result<_, Problems>>()?;

    let mut responses = responses.into_iter();
    let mut levels = Vec::with_capacity(study.levels.len());
    for ((level, floors), verticals) in study.levels.iter().zip(floors).zip(verticals) {
        let responses: Vec<_> = responses.by_ref().take(floors.len()).collect();
        levels.push(level_result(level, (floors, verticals), responses)?);
    }
    let mut doubts = study.doubts.clone();
    doubts.extend(doubts::doubts(study, &ground, &levels));
    let history = example_history(study, &names, &levels).unwrap_or_else(|error| {
        doubts.push(StudyDoubt::NoHistory(error.to_string()));
        None
    });
    let modes = study
        .building
        .as_ref()
        .map_or_else(Vec::new, |building| building.along.modes().to_vec());
    Ok(StudyResult {
        motions: names,
        ground,
        modes,
        profile,
        levels,
        history,
        sensitivity: None,
        doubts,
    })
}

fn settings(study: &Study) -> Settings {
    Settings {
        accuracy: study.objects.accuracy,
        ..Settings::default()
    }
}

fn standing(study: &Study, block: Block) -> RigidPlane {
    RigidPlane::along_x(block, study.objects.restitution, Walls::NONE)
}

fn object_responses(
    study: &Study,
    floor: &HorizontalMotion,
    vertical: Option<&Motion>,
    direction_deg: f64,
) -> Vec<ObjectResponse> {
    let objects = &study.objects;
    let motion = match floor.in_direction(direction_deg) {
        Ok(motion) => motion,
        Err(error) => return vec![ObjectResponse::Failed(error.to_string()); objects.blocks.len()],
    };
    let base = Base {
        horizontal: Some(&motion),
        vertical,
    };
    let direction_deg = floor.across.is_some().then_some(direction_deg);
    let standing = objects.blocks.iter().map(|block| standing(study, *block));
    let standing: Vec<RigidPlane> = standing.collect();
    uplift_spectrum(&standing, base, &settings(study))
        .into_iter()
        .map(|cell| match cell {
            Ok(uplift) => {
                let shock = uplift.shock(
                    objects.mass_kg,
                    &objects.cushion.cushion,
                    ImpactModel::Paper,
                    G0_M_S2,
                );
                if shock.is_beyond_numbers() {
                    return ObjectResponse::Failed(BOTTOMED.to_owned());
                }
                ObjectResponse::Done {
                    uplift,
                    shock,
                    direction_deg,
                }
            }
            Err(error @ RockingError::FreeFlight { .. }) => {
                ObjectResponse::FreeFlight(error.to_string())
            }
            Err(error) => ObjectResponse::Failed(error.to_string()),
        })
        .collect()
}

/// The governing response of each object. A failed history governs, since it may have been the
/// worst; then one that overturns; then the one with the larger rise of the centre of gravity,
/// which determines the shock. Of equals the first governs. The shock from the impact velocity is
/// the largest of all directions, so it may belong to another direction.
fn larger(first: Vec<ObjectResponse>, second: Vec<ObjectResponse>) -> Vec<ObjectResponse> {
    let rank = |response: &ObjectResponse| {
        response.done().map_or((2, 0.0), |(uplift, _)| {
            (
                u8::from(uplift.rocking.outcome.has_fallen()),
                uplift.rocking.cg_rise_m,
            )
        })
    };
    let governs = |one: &ObjectResponse, other: &ObjectResponse| {
        let (one, other) = (rank(one), rank(other));
        other.0 > one.0 || (other.0 == one.0 && other.1 > one.1)
    };
    let velocity_g =
        |response: &ObjectResponse| response.done()?.1.edge_acceleration_impact_velocity_g;
    let merged = |(one, other): (ObjectResponse, ObjectResponse)| {
        let (one_g, other_g) = (velocity_g(&one), velocity_g(&other));
        let mut governing = if governs(&one, &other) { other } else { one };
        if let ObjectResponse::Done { shock, .. } = &mut governing
            && let Some(governing_g) = &mut shock.edge_acceleration_impact_velocity_g
        {
            *governing_g = [one_g, other_g]
                .into_iter()
                .flatten()
                .fold(*governing_g, f64::max);
        }
        governing
    };
    first.into_iter().zip(second).map(merged).collect()
}

fn level_result(
    level: &Level,
    (floors, verticals): (Vec<HorizontalMotion>, Vec<Option<Arc<Motion>>>),
    responses: Vec<Vec<ObjectResponse>>,
) -> Result<LevelResult, Problems> {
    let spectra = floors
        .par_iter()
        .map(spectrum_of)
        .collect::<Result<_, _>>()?;
    let objects = responses.first().map_or(0, Vec::len);
    let statistics = (0..objects)
        .map(|object| object_statistics(responses.iter().map(|motion| &motion[object])))
        .collect();
    Ok(LevelResult {
        level: level.clone(),
        floors,
        verticals,
        spectra,
        responses,
        statistics,
    })
}

/// The history that is drawn: the study's choice; otherwise, on the highest floor and for the first
/// motion that makes any object rock, the object with the largest shock that does not overturn.
fn example_history(
    study: &Study,
    names: &[String],
    levels: &[LevelResult],
) -> Result<Option<ExampleHistory>, Box<dyn std::error::Error>> {
    let Some(Drawn {
        level,
        motion,
        block,
    }) = history_choice(study, names, levels)
    else {
        return Ok(None);
    };
    let direction_deg = governing_direction(study, &level.responses[motion], &block);
    let floor = level.floors[motion].in_direction(direction_deg.unwrap_or(0.0))?;
    let floor = floor.as_ref();
    let base = Base {
        horizontal: Some(floor),
        vertical: level.verticals[motion].as_deref(),
    };
    let how = HistoryOptions::sampled(settings(study));
    let RigidHistory {
        rocking,
        samples: points,
        ..
    } = standing(study, block).follow(base, &how)?;
    let landing = Landing::rocking(&block, ImpactModel::Paper);
    let shock_g = |omega: f64| {
        let (mass, cushion) = (study.objects.mass_kg, &study.objects.cushion.cushion);
        landing
            .impact_at_omega(mass, cushion, omega, G0_M_S2)
            .edge_acceleration_m_s2
            / G0_M_S2
    };
    Ok(Some(ExampleHistory {
        level: level.level.name.clone(),
        motion: names[motion].clone(),
        direction_deg,
        height_m: block.height_m(),
        thickness_m: block.thickness_m(),
        slenderness_angle_rad: block.pivot().slenderness_angle_rad,
        outcome: rocking.outcome,
        time_s: points.iter().map(|p| p.time_s).collect(),
        accel_m_s2: points.iter().map(|p| p.base_accel_m_s2).collect(),
        theta_rad: points.iter().map(|p| p.theta_rad).collect(),
        impacts: rocking
            .impacts
            .iter()
            .map(|i| (i.time_s, shock_g(i.omega_before_rad_s)))
            .collect(),
    }))
}

/// The governing direction of an object of the grid. Sizes of a grid are interpolated, so they
/// agree only up to rounding.
fn governing_direction(study: &Study, row: &[ObjectResponse], block: &Block) -> Option<f64> {
    let near = |a: f64, b: f64| (a - b).abs() <= 1e-9 * b;
    let is_it = |one: &Block| {
        near(one.height_m(), block.height_m()) && near(one.thickness_m(), block.thickness_m())
    };
    let object = study.objects.blocks.iter().position(is_it)?;
    match row.get(object)? {
        ObjectResponse::Done { direction_deg, .. } => *direction_deg,
        ObjectResponse::FreeFlight(_) | ObjectResponse::Failed(_) => None,
    }
}

/// The history that is drawn.
struct Drawn<'a> {
    level: &'a LevelResult,
    /// The place of the motion among those of the level.
    motion: usize,
    block: Block,
}

/// The history that is drawn; `None` where nothing rocks.
fn history_choice<'a>(
    study: &Study,
    names: &[String],
    levels: &'a [LevelResult],
) -> Option<Drawn<'a>> {
    Some(match &study.outputs.history {
        Some(choice) => {
            let level = levels
                .iter()
                .find(|level| level.level.name == choice.level)?;
            let motion = match &choice.motion {
                Some(wanted) => names.iter().position(|name| name == wanted)?,
                None => 0,
            };
            Drawn {
                level,
                motion,
                block: Block::uniform(choice.height_m, choice.thickness_m).ok()?,
            }
        }
        None => {
            // A level whose height is not known ranks below the others.
            let height = |level: &LevelResult| level.level.level_ratio.unwrap_or(-1.0);
            let level = levels
                .iter()
                .max_by(|a, b| height(a).total_cmp(&height(b)))?;
            let hardest = |row: &[ObjectResponse]| -> Option<UpliftCell> {
                let done = row.iter().filter_map(ObjectResponse::done);
                done.filter(|(uplift, _)| uplift.rocking.outcome == Outcome::Rocked)
                    .filter_map(|(uplift, shock)| Some((*uplift, shock.edge_acceleration_g?)))
                    .max_by(|a, b| a.1.total_cmp(&b.1))
                    .map(|(uplift, _)| uplift)
            };
            let (motion, cell) = level
                .responses
                .iter()
                .enumerate()
                .find_map(|(motion, row)| Some((motion, hardest(row)?)))?;
            Drawn {
                level,
                motion,
                block: cell.block,
            }
        }
    })
}
