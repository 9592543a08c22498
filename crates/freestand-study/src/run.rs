//! From a study to its result: ground motions, floor motions, every object on every floor under every motion.

use std::ops::ControlFlow;

use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::building::floor_motions;
use freestand::impact::impact_friction_needed_ratio;
use freestand::impact::{ASSUMED_FRICTION, ImpactModel, Landing, compression_warnings};
use freestand::motion::Motion;
use freestand::oscillator::response_spectrum;
use freestand::rocking::Outcome;
use freestand::rocking::{
    Base, HistoryRecorder, RockingError, RockingModel, RockingOptions, StopReason, Until, rock_observed,
};
use freestand::spectra::{UpliftCell, uplift_spectrum};
use freestand::synthesis::{self, SynthesisOptions, synthesize};
use rayon::prelude::*;

use crate::cushion::{BOTTOMED, EdgeCushion};
use crate::error::{Problem, ProblemKind, StudyError};
use crate::result::{ExampleHistory, GroundMotion, LevelResult, ObjectResponse, StudyResult};
use crate::statistics::object_statistics;
use crate::study::{Ground, Level, Study};

/// Longest wait for a block to settle after the motion \[s\]; only a restitution of nearly 1 needs more.
const LONGEST_TAIL_S: f64 = 120.0;

/// Damping of every spectrum that is shown.
pub const SPECTRUM_DAMPING_RATIO: f64 = 0.05;

/// How far a run has come.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Step {
    /// What is being done.
    pub stage: &'static str,
    /// Histories that are done.
    pub done: usize,
    /// Histories in all.
    pub total: usize,
}

/// Hears of every step; `Break` stops the run.
pub type Progress<'a> = &'a (dyn Fn(Step) -> ControlFlow<()> + Sync);

/// A [`Progress`] that listens to nothing.
pub fn no_progress(_: Step) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// Periods at which spectra are shown \[s\]: 0.02 to 10 s, 20 a decade.
pub fn spectrum_periods_s() -> Vec<f64> {
    let (first, last, count) = (0.02f64, 10.0f64, 109);
    (0..count).map(|i| first * (last / first).powf(f64::from(i) / f64::from(count - 1))).collect()
}

/// Runs `study` on the current thread pool; the result does not depend on its size.
///
/// # Errors
/// A motion that cannot be made or filtered, or a run that was stopped. An object that cannot be followed is a row with
/// its reason, not an error.
pub fn run(study: &Study, progress: Progress) -> Result<StudyResult, StudyError> {
    let total = study.levels.len() * study.objects.blocks.len() * motion_count(&study.ground);
    let tell = |stage, done| {
        progress(Step { stage, done, total }).is_continue().then_some(()).ok_or_else(|| {
            StudyError::from(Problem::new(ProblemKind::Computation, "the run was stopped before its end"))
        })
    };
    let ground = ground_motions(&study.ground, || tell("ground motions", 0))?;
    let floors = floors(study, &ground, || tell("floor motions", 0))?;

    let finished = std::sync::atomic::AtomicUsize::new(0);
    let pairs: Vec<(usize, usize)> =
        (0..study.levels.len()).flat_map(|level| (0..ground.len()).map(move |motion| (level, motion))).collect();
    let responses: Vec<Vec<ObjectResponse>> = pairs
        .par_iter()
        .map(|&(level, motion)| {
            let row = object_responses(study, &floors[level][motion]);
            let done = finished.fetch_add(row.len(), std::sync::atomic::Ordering::Relaxed) + row.len();
            tell("rocking histories", done).map(|()| row)
        })
        .collect::<Result<_, _>>()?;

    let mut responses = responses.into_iter();
    let mut levels = Vec::with_capacity(study.levels.len());
    for (level, floors) in study.levels.iter().zip(floors) {
        let responses: Vec<_> = responses.by_ref().take(floors.len()).collect();
        levels.push(level_result(level, floors, responses)?);
    }
    let mut warnings = study.warnings.clone();
    warnings.extend(result_warnings(study, &ground, &levels));
    let history = example_history(study, &ground, &levels).unwrap_or_else(|error| {
        warnings.push(format!("the rocking history that was asked for cannot be drawn: {error}"));
        None
    });
    Ok(StudyResult { ground, modes: study.building.beam.modes().to_vec(), levels, history, warnings })
}

fn motion_count(ground: &Ground) -> usize {
    match ground {
        Ground::Synthetic(synthetic) => synthetic.count,
        Ground::Recorded(records) => records.len(),
    }
}

/// Asks before each motion whether to `go_on`: a thousand of them take minutes.
fn ground_motions(
    ground: &Ground,
    go_on: impl Fn() -> Result<(), StudyError> + Sync,
) -> Result<Vec<GroundMotion>, StudyError> {
    let finish = |name: String, motion: Motion, misfit| -> Result<GroundMotion, StudyError> {
        let spectrum = spectrum_of(&motion)?;
        Ok(GroundMotion { name, motion, spectrum, misfit })
    };
    match ground {
        Ground::Synthetic(synthetic) => ground
            .names()
            .into_par_iter()
            .enumerate()
            .map(|(i, name)| {
                go_on()?;
                let options = SynthesisOptions::default();
                let matched = synthesize(|t| synthetic.spectrum.sa_g(t), synthetic.seed, i as u64, &options)
                    .map_err(failed("a synthetic motion"))?;
                finish(name, matched.motion, Some(matched.misfit))
            })
            .collect(),
        Ground::Recorded(records) => {
            records.par_iter().map(|record| finish(record.name.clone(), record.motion.clone(), None)).collect()
        }
    }
}

fn spectrum_of(motion: &Motion) -> Result<freestand::oscillator::ResponseSpectrum, StudyError> {
    response_spectrum(motion, SPECTRUM_DAMPING_RATIO, &spectrum_periods_s()).map_err(failed("a response spectrum"))
}

fn failed<E: std::fmt::Display>(what: impl std::fmt::Display) -> impl Fn(E) -> StudyError {
    move |error| Problem::new(ProblemKind::Computation, format!("{what} cannot be computed: {error}")).into()
}

/// Floor motions, `[level][motion]`, with the building's ring-down behind the ground motion.
fn floors(
    study: &Study,
    ground: &[GroundMotion],
    go_on: impl Fn() -> Result<(), StudyError> + Sync,
) -> Result<Vec<Vec<Motion>>, StudyError> {
    let beam = &study.building.beam;
    let ratios: Vec<f64> = study.levels.iter().map(|level| level.level_ratio).collect();
    let by_motion: Vec<Vec<Motion>> = ground
        .par_iter()
        .map(|g| {
            go_on()?;
            let what = || format!("the floor motion under {}", g.name);
            let ground = g.motion.with_zero_tail(beam.tail_s()).map_err(failed(what()))?;
            floor_motions(&ground, beam, &ratios).map_err(failed(what()))
        })
        // The first error in the order of the motions, whichever thread met one first.
        .collect::<Vec<Result<_, StudyError>>>()
        .into_iter()
        .collect::<Result<_, _>>()?;
    let mut by_level = vec![Vec::with_capacity(ground.len()); ratios.len()];
    for floors in by_motion {
        for (level, floor) in by_level.iter_mut().zip(floors) {
            level.push(floor);
        }
    }
    Ok(by_level)
}

fn options(study: &Study) -> RockingOptions {
    RockingOptions {
        restitution: study.objects.restitution,
        accuracy: study.objects.accuracy,
        until: Until::Settled { at_most_s: LONGEST_TAIL_S },
        ..RockingOptions::default()
    }
}

fn object_responses(study: &Study, floor: &Motion) -> Vec<ObjectResponse> {
    let objects = &study.objects;
    let base = Base { horizontal: Some(floor), vertical: None };
    uplift_spectrum(&objects.blocks, base, &options(study))
        .into_iter()
        .map(|cell| match cell {
            Ok(uplift) => {
                let shock = uplift.shock(objects.mass_kg, &objects.cushion.cushion, ImpactModel::Paper, G0_M_S2);
                if shock.is_beyond_numbers() {
                    return ObjectResponse::Failed(BOTTOMED.to_owned());
                }
                ObjectResponse::Done { uplift, shock }
            }
            Err(error) => ObjectResponse::Failed(error.to_string()),
        })
        .collect()
}

fn level_result(
    level: &Level,
    floors: Vec<Motion>,
    responses: Vec<Vec<ObjectResponse>>,
) -> Result<LevelResult, StudyError> {
    let spectra = floors.par_iter().map(spectrum_of).collect::<Result<_, _>>()?;
    let objects = responses.first().map_or(0, Vec::len);
    let statistics =
        (0..objects).map(|object| object_statistics(responses.iter().map(|motion| &motion[object]))).collect();
    Ok(LevelResult { level: level.clone(), floors, spectra, responses, statistics })
}

/// The history that is drawn: the study's choice, or else the survivor with the largest shock on the highest floor
/// under the first motion under which anything rocks.
fn example_history(
    study: &Study,
    ground: &[GroundMotion],
    levels: &[LevelResult],
) -> Result<Option<ExampleHistory>, RockingError> {
    let Some((level, motion, block)) = history_choice(study, ground, levels) else { return Ok(None) };
    let floor = &level.floors[motion];
    let base = Base { horizontal: Some(floor), vertical: None };
    let mut recorder = HistoryRecorder::new(Some(floor), floor.dt_s());
    let rocking = rock_observed(&block, base, &options(study), |segment| recorder.observe(segment))?;
    let points = recorder.finish(&rocking);
    let landing = Landing::rocking(&block, ImpactModel::Paper);
    let shock_g = |omega: f64| {
        let (mass, cushion) = (study.objects.mass_kg, &study.objects.cushion.cushion);
        landing.impact_at_omega(mass, cushion, omega, G0_M_S2).edge_acceleration_m_s2 / G0_M_S2
    };
    Ok(Some(ExampleHistory {
        level: level.level.name.clone(),
        motion: ground[motion].name.clone(),
        height_m: block.height_m(),
        thickness_m: block.thickness_m(),
        slenderness_angle_rad: block.pivot().slenderness_angle_rad,
        outcome: rocking.outcome,
        time_s: points.iter().map(|p| p.time_s).collect(),
        accel_m_s2: points.iter().map(|p| p.base_accel_m_s2).collect(),
        theta_rad: points.iter().map(|p| p.theta_rad).collect(),
        impacts: rocking.impacts.iter().map(|i| (i.time_s, shock_g(i.omega_before_rad_s))).collect(),
    }))
}

/// Level, index of the motion and object of the history that is drawn; `None` where nothing rocks.
fn history_choice<'a>(
    study: &Study,
    ground: &[GroundMotion],
    levels: &'a [LevelResult],
) -> Option<(&'a LevelResult, usize, Block)> {
    Some(match &study.outputs.history {
        Some(choice) => {
            let level = levels.iter().find(|level| level.level.name == choice.level)?;
            let motion = match &choice.motion {
                Some(name) => ground.iter().position(|g| g.name == *name)?,
                None => 0,
            };
            (level, motion, Block::uniform(choice.height_m, choice.thickness_m).ok()?)
        }
        None => {
            let level = levels.iter().max_by(|a, b| a.level.level_ratio.total_cmp(&b.level.level_ratio))?;
            let hardest = |row: &[ObjectResponse]| -> Option<UpliftCell> {
                let shocks = row.iter().filter_map(|response| match response {
                    ObjectResponse::Done { uplift, shock } if uplift.rocking.outcome == Outcome::Rocked => {
                        Some((*uplift, shock.edge_acceleration_g?))
                    }
                    _ => None,
                });
                shocks.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(uplift, _)| uplift)
            };
            let (motion, cell) =
                level.responses.iter().enumerate().find_map(|(motion, row)| Some((motion, hardest(row)?)))?;
            (level, motion, cell.block)
        }
    })
}

/// What the reader of the result must know, from what came out.
fn result_warnings(study: &Study, ground: &[GroundMotion], levels: &[LevelResult]) -> Vec<String> {
    let mut warnings = Vec::new();
    let above: Vec<f64> =
        ground.iter().filter_map(|g| g.misfit.as_ref()).map(|misfit| misfit.pga_g / misfit.target_zpa_g).collect();
    if let Some(most) = above.iter().copied().reduce(f64::max)
        && most > 1.1
    {
        warnings.push(format!(
            "the matched motions have up to {most:.2} times the target's zero-period acceleration as PGA: their spectra are \
             matched from {} s up, and a motion with this plateau cannot have so small a peak",
            synthesis::SHORTEST_PERIOD_S
        ));
    }
    let rows = || levels.iter().flat_map(|level| level.responses.iter().flatten());
    let failed = rows().filter(|response| matches!(response, ObjectResponse::Failed(_))).count();
    if failed > 0 {
        warnings
            .push(format!("{failed} of {} histories could not be followed: see `reason` in srs.csv", rows().count()));
    }

    let unsettled = rows()
        .filter(|r| matches!(r, ObjectResponse::Done { uplift, .. } if uplift.rocking.stop == StopReason::EndOfMotion))
        .count();
    if unsettled > 0 {
        warnings.push(format!(
            "{unsettled} of {} histories still rocked when they were stopped behind the motion: their impacts are not all \
             counted",
            rows().count()
        ));
    }

    let objects = &study.objects;
    let friction = objects.friction.unwrap_or(ASSUMED_FRICTION);
    let assumed = if objects.friction.is_some() { "" } else { " (assumed)" };
    let squat = objects.blocks.iter().filter(|b| RockingModel::Rigid.uplift_threshold_ratio(b) > friction).count();
    if squat > 0 {
        warnings.push(format!(
            "{squat} of {} objects have t/h above a friction of {friction}{assumed}: they slide before they uplift, which \
             the model leaves out",
            objects.blocks.len()
        ));
    }
    let slipping = objects
        .blocks
        .iter()
        .filter(|b| {
            let r = objects.restitution.ratios(b).map_or(0.0, |ratios| ratios[0]);
            impact_friction_needed_ratio(b, r) > friction
        })
        .count();
    if slipping > 0 {
        warnings.push(format!(
            "{slipping} of {} objects need more friction than {friction}{assumed} in an impact: their landing edge may slip",
            objects.blocks.len()
        ));
    }
    let EdgeCushion { cushion, pad_thickness_m, .. } = &objects.cushion;
    let worst = rows()
        .filter_map(|response| match response {
            ObjectResponse::Done { uplift, .. } if uplift.rocking.outcome == Outcome::Rocked => {
                let landing = Landing::rocking(&uplift.block, ImpactModel::Paper);
                Some(landing.impact(objects.mass_kg, cushion, uplift.rocking.cg_rise_m, G0_M_S2))
            }
            _ => None,
        })
        .max_by(|a, b| a.compression_m.total_cmp(&b.compression_m));
    if let Some(impact) = worst {
        warnings.extend(
            compression_warnings(impact.compression_m, cushion, *pad_thickness_m).iter().map(ToString::to_string),
        );
    }
    warnings
}
