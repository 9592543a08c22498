//! The motions of the ground and of the floors.

use std::sync::Arc;

use freestand::G0_M_S2;
use freestand::building::{Building, floor_motions};
use freestand::motion::Motion;
use freestand::synthesis::{Misfit, SynthesisOptions, stream, synthesize};
use freestand::worlds::Component;
use rayon::prelude::*;

use super::{SPECTRUM_DAMPING_RATIO, spectrum_periods_s};
use crate::floor::{every_floor, largest_psa_m_s2};
use crate::matched::synthetic_name;
use crate::result::{FloorProfile, GroundMotion, PseudoSpectrum};
use crate::simulated::simulator;
use crate::study::{
    BuildingInput, Ground, Level, RecordedMotion, SimulatedGround, Study, SyntheticGround,
    VerticalTarget,
};
use crate::target::code_parts;
use freestand_input::problem::{Problem, ProblemKind, Problems};
use freestand_records::horizontal::HorizontalMotion;

/// Calls `go_on` before each motion, so that it can stop the run: a thousand motions take minutes.
pub fn ground_motions(
    ground: &Ground,
    go_on: impl Fn() -> Result<(), Problems> + Sync,
) -> Result<Vec<GroundMotion>, Problems> {
    let finish = |name: String,
                  motion: HorizontalMotion,
                  vertical,
                  misfit|
     -> Result<GroundMotion, Problems> {
        let spectrum = spectrum_of(&motion)?;
        Ok(GroundMotion {
            name,
            motion,
            vertical,
            spectrum,
            misfit,
        })
    };
    match ground {
        Ground::Synthetic(synthetic) => (0..synthetic.count)
            .into_par_iter()
            .map(|i| {
                go_on()?;
                let options = SynthesisOptions::default();
                let matched = synthesize(
                    |t| synthetic.target.spectrum.sa_g(t),
                    synthetic.seed,
                    i as u64,
                    &options,
                )
                .map_err(failed("a synthetic motion"))?;
                finish(
                    synthetic_name(i),
                    along_alone(matched.motion),
                    vertical_motion(synthetic, i as u32)?,
                    Some(matched.misfit),
                )
            })
            .collect(),
        Ground::Simulated(simulated) => simulated_motions(simulated, &go_on, finish),
        Ground::Recorded(records) => records
            .par_iter()
            .map(|record| {
                let misfit = record.matched.as_ref().map(|matched| matched.misfit);
                let vertical = record
                    .vertical
                    .as_ref()
                    .map(|vertical| vertical.motion.clone());
                finish(record.name.clone(), record.as_used(), vertical, misfit)
            })
            .collect(),
        Ground::OnFloors => Ok(Vec::new()),
    }
}

/// A motion with one component.
fn along_alone(along: Motion) -> HorizontalMotion {
    HorizontalMotion {
        along,
        across: None,
    }
}

/// The vertical motion that belongs to a synthetic one, from a stream of its own: the one that a world
/// of this number draws it from.
fn vertical_motion(synthetic: &SyntheticGround, index: u32) -> Result<Option<Motion>, Problems> {
    if synthetic.vertical == VerticalTarget::None {
        return Ok(None);
    }
    let sa_g = |period_s| {
        synthetic
            .vertical
            .sa_g(&synthetic.target, period_s)
            .unwrap_or(f64::NAN)
    };
    let stream = stream(Component::Vertical.number(), index);
    let matched = synthesize(sa_g, synthetic.seed, stream, &SynthesisOptions::default());
    matched
        .map(|matched| Some(matched.motion))
        .map_err(failed("a vertical motion"))
}

/// Vertical motions of the levels, `[level][motion]`: those of the ground, which floors above it
/// amplify, with the zeros that the horizontal ones ring down in.
pub(super) fn verticals(
    study: &Study,
    ground: &[GroundMotion],
) -> Result<Vec<Vec<Option<Arc<Motion>>>>, Problems> {
    let Some(building) = &study.building else {
        return Ok(study
            .levels
            .iter()
            .map(|level| vec![None; level.motions.len()])
            .collect());
    };
    let of = |motion: &GroundMotion, ratio: f64| -> Result<Option<Arc<Motion>>, Problems> {
        let Some(vertical) = &motion.vertical else {
            return Ok(None);
        };
        let padded = vertical
            .with_zero_tail(building.tail_s())
            .and_then(|motion| motion.scaled(ratio));
        padded
            .map(|motion| Some(Arc::new(motion)))
            .map_err(failed(format!("the vertical motion of {}", motion.name)))
    };
    let both: Vec<[Option<Arc<Motion>>; 2]> = ground
        .iter()
        .map(|motion| {
            Ok([
                of(motion, 1.0)?,
                of(motion, study.vertical_amplification_ratio)?,
            ])
        })
        .collect::<Result<_, Problems>>()?;
    let is_above = |level: &Level| usize::from(level.level_ratio != Some(0.0));
    Ok(study
        .levels
        .iter()
        .map(|level| {
            both.iter()
                .map(|both| both[is_above(level)].clone())
                .collect()
        })
        .collect())
}

/// Earthquake by earthquake, each motion from the same streams of random numbers as in `motion
/// simulate`.
fn simulated_motions(
    simulated: &SimulatedGround,
    go_on: impl Fn() -> Result<(), Problems> + Sync,
    finish: impl Fn(
        String,
        HorizontalMotion,
        Option<Motion>,
        Option<Misfit>,
    ) -> Result<GroundMotion, Problems>
    + Sync,
) -> Result<Vec<GroundMotion>, Problems> {
    let wrong = "a simulated motion";
    let mut motions = Vec::new();
    for found in &simulated.earthquakes {
        let simulator = simulator(&simulated.request, found).map_err(failed(wrong))?;
        let made: Vec<GroundMotion> = (0..simulated.request.count)
            .into_par_iter()
            .map(|index| {
                go_on()?;
                let along = simulator
                    .motion(simulated.request.seed, found.stream(index))
                    .map_err(failed(wrong))?;
                finish(found.motion_name(index), along_alone(along), None, None)
            })
            .collect::<Result<_, Problems>>()?;
        motions.extend(made);
    }
    Ok(motions)
}

/// The spectrum for figures, at 5 % damping.
pub(super) fn spectrum_of(motion: &HorizontalMotion) -> Result<PseudoSpectrum, Problems> {
    let periods_s = spectrum_periods_s();
    let psa_m_s2 = largest_psa_m_s2(motion, SPECTRUM_DAMPING_RATIO, &periods_s)
        .map_err(failed("a response spectrum"))?;
    Ok(PseudoSpectrum {
        periods_s,
        psa_m_s2,
    })
}

fn failed<E: std::fmt::Display>(what: impl std::fmt::Display) -> impl Fn(E) -> Problems {
    move |error| {
        Problem::new(
            ProblemKind::Computation,
            format!("{what} cannot be computed: {error}"),
        )
        .into()
    }
}

/// Floor motions, `[level][motion]`: those that are given, or those of the building, with its free
/// vibration after the ground motion.
pub(super) fn floors(
    study: &Study,
    ground: &[GroundMotion],
    go_on: impl Fn() -> Result<(), Problems> + Sync,
) -> Result<Vec<Vec<HorizontalMotion>>, Problems> {
    let Some(building) = &study.building else {
        return Ok(study
            .levels
            .iter()
            .map(|level| level.motions.iter().map(RecordedMotion::as_used).collect())
            .collect());
    };
    let ratios: Vec<f64> = study
        .levels
        .iter()
        .map(|level| level.level_ratio.unwrap_or(1.0))
        .collect();
    let by_motion: Vec<Vec<HorizontalMotion>> = ground
        .par_iter()
        .map(|g| {
            go_on()?;
            floors_under(g, building, &ratios)
        })
        // The first error in the order of the motions, whichever thread met one first.
        .collect::<Vec<Result<_, Problems>>>()
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

/// Peak accelerations of every floor for every motion, and those of the code's clause for rigid
/// parts.
pub(super) fn floor_profile(
    study: &Study,
    ground: &[GroundMotion],
    go_on: impl Fn() -> Result<(), Problems> + Sync,
) -> Result<Option<FloorProfile>, Problems> {
    let Some(building) = &study.building else {
        return Ok(None);
    };
    let levels_ratio = every_floor(&building.along, building.storeys);
    let peaks = |g: &GroundMotion| -> Result<(Vec<f64>, Vec<f64>), Problems> {
        go_on()?;
        let floors = floors_under(g, building, &levels_ratio)?;
        Ok(floors
            .iter()
            .map(|floor| (floor.peak_m_s2() / G0_M_S2, floor.peak_velocity_m_s()))
            .unzip())
    };
    let (pfa_g, pfv_m_s) = ground
        .par_iter()
        .map(peaks)
        .collect::<Vec<Result<_, Problems>>>()
        .into_iter()
        .collect::<Result<Vec<(Vec<f64>, Vec<f64>)>, _>>()?
        .into_iter()
        .unzip();
    // A stiffer axis gives the larger accelerations by the codes that ask for a period.
    let across_s = building
        .across
        .as_ref()
        .map_or(f64::INFINITY, Building::period_s);
    let period_s = building.along.period_s().min(across_s);
    let code = study.ground.code_spectrum().and_then(|target| {
        code_parts(
            &target.spectrum,
            Some(building.height_m),
            Some(period_s),
            &levels_ratio,
        )
    });
    Ok(Some(FloorProfile {
        levels_ratio,
        pfa_g,
        pfv_m_s,
        code,
    }))
}

/// The motions of every level under one ground motion.
pub fn floors_under(
    ground: &GroundMotion,
    building: &BuildingInput,
    ratios: &[f64],
) -> Result<Vec<HorizontalMotion>, Problems> {
    let what = || format!("the floor motion under {}", ground.name);
    let axis = |motion: &Motion, axis: &Building| -> Result<Vec<Motion>, Problems> {
        let motion = motion
            .with_zero_tail(building.tail_s())
            .map_err(failed(what()))?;
        floor_motions(&motion, axis, ratios).map_err(failed(what()))
    };
    let along = axis(&ground.motion.along, &building.along)?;
    let across = match &ground.motion.across {
        Some(motion) => axis(motion, building.across.as_ref().unwrap_or(&building.along))?
            .into_iter()
            .map(Some)
            .collect(),
        None => vec![None; along.len()],
    };
    Ok(along
        .into_iter()
        .zip(across)
        .map(|(along, across)| HorizontalMotion { along, across })
        .collect())
}
