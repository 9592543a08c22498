//! The motions of runs: what moves an object, and how strong it is by every measure.

use std::sync::Arc;

use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::measures::{mean_period_s, measures, rocking_measures};
use freestand::motion::Motion;
use freestand::oscillator::{DAMPING_RATIO, response_spectrum};
use freestand_input::problem::{Problem, ProblemKind, Problems};
use freestand_input::quantity::shorten;
use freestand_output::answer_of;
use freestand_study::study::{Ground, Study};
use rayon::prelude::*;

use super::super::measure::{At, Measure};
use freestand_assess::worlds::{Again, FloorOfWorld, Worlds};

/// Worlds of a study whose ground motions are generated, if the user gives no number.
pub(crate) const DEFAULT_WORLDS: u32 = 40;

/// Number of periods of an average spectral acceleration.
const AVERAGED: usize = 10;

/// A measure that is asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Asked {
    pub(super) measure: Measure,
    /// Its place among those that are asked.
    pub(super) place: usize,
    /// Where it is taken.
    pub(super) at: At,
}

/// The motions of all floors, and the measures of their intensities.
#[derive(Clone, Copy)]
pub(super) struct Motions<'a> {
    pub(super) floors: &'a [Vec<FloorShaking>],
    pub(super) measures: &'a [Asked],
}

/// A motion of a floor.
#[derive(Debug, Clone, PartialEq)]
pub struct FloorMotion {
    /// Its name in the outcomes.
    pub name: String,
    /// Horizontal acceleration, in the plane of the object.
    pub horizontal: Motion,
    /// Vertical acceleration, of the same step and length.
    pub vertical: Option<Motion>,
}

/// What a motion is at one place, at a scale of 1.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Strength {
    peak_m_s2: f64,
    peak_m_s: f64,
    /// Of each measure that is asked, in its order; `None`: no spectral acceleration.
    spectral_g: Vec<Option<f64>>,
    pub(super) mean_period_s: Option<f64>,
}

impl Strength {
    /// `asked` are measures, of which spectral accelerations are calculated here.
    fn new(motion: &Motion, asked: &[Measure]) -> Result<Self, Problem> {
        let all = measures(motion);
        let spectral = |measure: &Measure| {
            let periods_s = match *measure {
                Measure::Sa { period_s } => vec![period_s],
                Measure::SaAverage { from_s, to_s } => {
                    // Equal steps of the logarithm.
                    let share = |i: usize| i as f64 / (AVERAGED - 1) as f64;
                    (0..AVERAGED)
                        .map(|i| from_s * (to_s / from_s).powf(share(i)))
                        .collect()
                }
                _ => return Ok(None),
            };
            let spectrum =
                response_spectrum(motion, DAMPING_RATIO, &periods_s).map_err(|error| {
                    Problem::new(ProblemKind::Value, format!("{}: {error}", measure.name()))
                        .hint("give a period that the motion can have")
                })?;
            let logs = spectrum
                .psa_m_s2
                .iter()
                .map(|psa| (psa / G0_M_S2).ln())
                .sum::<f64>();
            Ok(Some((logs / periods_s.len() as f64).exp()))
        };
        Ok(Self {
            peak_m_s2: all.pga_m_s2,
            peak_m_s: all.pgv_m_s,
            spectral_g: asked.iter().map(spectral).collect::<Result<_, Problem>>()?,
            mean_period_s: mean_period_s(motion),
        })
    }

    /// Peak velocity over peak acceleration \[s\].
    pub(super) fn velocity_over_acceleration_s(&self) -> f64 {
        self.peak_m_s / self.peak_m_s2
    }
}

/// Factors from peaks of a floor motion to the ratios of an object.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct RatioFactors {
    acceleration_per_m_s2: f64,
    velocity_per_m_s: f64,
}

impl RatioFactors {
    /// The ratios are linear in the motion, so those of a pulse with peaks of 1 m/s² and 1 m/s are
    /// the factors.
    pub(super) fn new(block: &Block) -> Result<Self, Problem> {
        let pulse = Motion::new(1.0, vec![0.0, 1.0, 0.0])
            .map_err(|error| Problem::new(ProblemKind::Computation, error.to_string()))?;
        let ratios = rocking_measures(&pulse, block, G0_M_S2);
        Ok(Self {
            acceleration_per_m_s2: ratios.pga_ratio,
            velocity_per_m_s: ratios.pgv_ratio,
        })
    }
}

/// A motion of a floor with the motion of the ground under it.
#[derive(Debug, Clone)]
pub struct FloorShaking {
    pub(super) name: String,
    /// Its place among the motions of the floor.
    pub(super) number: u32,
    floor: Arc<FloorOfWorld>,
    pub(super) at_floor: Strength,
    /// `None`: only the floor motion is known.
    pub(super) at_ground: Option<Strength>,
}

impl FloorShaking {
    /// The motion of the floor at a scale, its own acceleration left out of demands; `None` where its
    /// numbers have no end.
    pub(super) fn scaled(&self, scale_ratio: f64) -> Option<FloorOfWorld> {
        self.floor
            .scaled(scale_ratio)
            .map(FloorOfWorld::without_peak)
    }

    /// The scale at which the acceleration ratio of an object is 1.
    pub(super) fn uplift_scale_ratio(&self, factors: RatioFactors) -> f64 {
        1.0 / (factors.acceleration_per_m_s2 * self.at_floor.peak_m_s2)
    }

    /// The intensity at a scale of 1, in the unit of outputs. `None` where the ground motion is not
    /// known.
    pub(super) fn intensity(&self, asked: Asked, factors: RatioFactors) -> Option<f64> {
        let strength = self.at(asked.at)?;
        match asked.measure {
            Measure::Pga | Measure::Pfa => Some(strength.peak_m_s2 / G0_M_S2),
            Measure::Pgv | Measure::Pfv => Some(strength.peak_m_s),
            Measure::Sa { .. } | Measure::SaAverage { .. } => {
                strength.spectral_g.get(asked.place).copied().flatten()
            }
            Measure::VelocityRatio => Some(factors.velocity_per_m_s * strength.peak_m_s),
            Measure::AccelerationRatio => Some(factors.acceleration_per_m_s2 * strength.peak_m_s2),
        }
    }

    /// What the motion is at the ground, or at the floor.
    pub(super) fn at(&self, at: At) -> Option<&Strength> {
        match at {
            At::Ground => self.at_ground.as_ref(),
            At::Floor => Some(&self.at_floor),
        }
    }
}

answer_of!(FloorShaking as motion {
    name: String = motion.name.clone();
    /// PGV over PGA of the floor.
    floor_velocity_over_acceleration_s: f64 = motion.at_floor.velocity_over_acceleration_s();
    floor_mean_period_s: Option<f64> = motion.at_floor.mean_period_s;
});

/// Motions of one floor that the user gave; `is_ground`: the object is on the ground.
pub(super) fn given(
    motions: &[FloorMotion],
    is_ground: bool,
    asked: &[Measure],
) -> Result<Vec<FloorShaking>, Problems> {
    let shaking = |(number, motion): (usize, &FloorMotion)| {
        let strength = Strength::new(&motion.horizontal, asked)
            .map_err(|problem| of_motion(problem, &motion.name))?;
        still(&strength, &motion.name)?;
        Ok(FloorShaking {
            name: motion.name.clone(),
            number: number as u32,
            floor: Arc::new(FloorOfWorld::given(
                &motion.horizontal,
                motion.vertical.as_ref(),
            )),
            at_ground: is_ground.then(|| strength.clone()),
            at_floor: strength,
        })
    };
    motions
        .par_iter()
        .enumerate()
        .map(shaking)
        .collect::<Result<_, Problem>>()
        .map_err(Problems::from)
}

/// The motions of some floors of a study, `[floor][motion]`: its records once each, or worlds.
pub(super) fn of_study(
    study: &Study,
    levels_ratio: &[f64],
    worlds: Option<u32>,
    asked: &[Measure],
    go_on: impl Fn() -> Result<(), Problems> + Sync,
) -> Result<Vec<Vec<FloorShaking>>, Problems> {
    let all = Worlds::new(study, &go_on)?;
    if let Some(level) = levels_ratio.iter().find(|level| !all.has_floor(**level)) {
        let message = format!("the study has no motion for the floor at {level} of the height");
        return Err(Problem::value(
            message,
            "give the study a building, or motions of this floor",
        )
        .into());
    }
    let count = worlds.unwrap_or_else(|| all.records().unwrap_or(DEFAULT_WORLDS));
    let has_ground = study.ground != Ground::OnFloors;
    let ground = |world: u32| -> Result<Option<Strength>, Problems> {
        go_on()?;
        let ground = if has_ground {
            all.ground(world, 0)?
        } else {
            None
        };
        Ok(ground
            .map(|ground| Strength::new(&ground.motion.along, asked))
            .transpose()?)
    };
    let grounds = (0..count)
        .into_par_iter()
        .map(ground)
        .collect::<Result<Vec<_>, Problems>>()?;
    let floors = all.floors(0..count, levels_ratio, Again::default(), None, &go_on)?;
    let of_floor = |floors: Vec<Arc<FloorOfWorld>>| -> Result<Vec<FloorShaking>, Problems> {
        let made =
            floors
                .into_par_iter()
                .zip(&grounds)
                .enumerate()
                .map(|(world, (floor, ground))| {
                    let name = all.name(world as u32);
                    let strength = Strength::new(&floor.motion.along, asked)
                        .map_err(|problem| of_motion(problem, &name))?;
                    still(&strength, &name)?;
                    Ok(FloorShaking {
                        name,
                        number: world as u32,
                        floor,
                        at_floor: strength,
                        at_ground: ground.clone(),
                    })
                });
        made.collect::<Result<_, Problem>>().map_err(Problems::from)
    };
    floors.into_iter().map(of_floor).collect()
}

/// Refuses a motion without any acceleration: no scale makes it stronger.
fn still(strength: &Strength, name: &str) -> Result<(), Problem> {
    if strength.peak_m_s2 > 0.0 && strength.peak_m_s > 0.0 {
        return Ok(());
    }
    let message = format!(
        "the motion {} does not move: it cannot be scaled",
        shorten(name)
    );
    Err(Problem::value(message, "leave it out"))
}

fn of_motion(mut problem: Problem, name: &str) -> Problem {
    problem.message = format!("motion {}: {}", shorten(name), problem.message);
    problem
}
