//! The runs of an object.

use freestand::fragility::{LimitState, ScaleRun, mean_and_sd, missing_levels, scales_of_motion};
use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::shorten;
use freestand_input::words::number;

use super::shaking::{Asked, FloorShaking};
use super::{Method, ObjectRuns, RunsRequest};
use freestand_assess::verdict::NominalRun;
use freestand_assess::worlds::FloorOfWorld;

/// One run.
#[derive(Debug, Clone, PartialEq)]
pub struct Followed {
    /// Factor on the motion.
    pub scale_ratio: f64,
    /// Why it could not be followed, in words.
    pub found: Result<NominalRun, String>,
}

impl Followed {
    /// What the object did; `None`: the run could not be followed.
    pub fn run(&self) -> Option<NominalRun> {
        self.found.as_ref().ok().copied()
    }
}

/// The classes of runs, as the search for scales sees them.
pub(super) fn classes(runs: &[Followed]) -> Vec<ScaleRun> {
    let class = |run: &Followed| ScaleRun {
        scale_ratio: run.scale_ratio,
        class: run.run().map(|run| run.class),
    };
    runs.iter().map(class).collect()
}

fn followed(
    request: &RunsRequest,
    one: &ObjectRuns,
    shaking: &FloorShaking,
    scales_ratio: &[f64],
) -> Vec<Followed> {
    let floors: Vec<_> = scales_ratio
        .iter()
        .map(|scale_ratio| shaking.scaled(*scale_ratio))
        .collect();
    let is_finite: Vec<bool> = floors.iter().map(Option::is_some).collect();
    let floors: Vec<FloorOfWorld> = floors.into_iter().flatten().collect();
    let mut found = one
        .nominal
        .runs(shaking.number, &floors, request.rotation_ratio)
        .into_iter();
    let beyond = || Err("the scaled motion is beyond all numbers".to_owned());
    let of_scale = |(&scale_ratio, is_finite): (&f64, bool)| {
        let found = if is_finite { found.next() } else { None };
        Followed {
            scale_ratio,
            found: found.unwrap_or_else(beyond),
        }
    };
    scales_ratio.iter().zip(is_finite).map(of_scale).collect()
}

/// At one scale.
fn followed_at(
    request: &RunsRequest,
    one: &ObjectRuns,
    shaking: &FloorShaking,
    scale_ratio: f64,
) -> Option<Followed> {
    followed(request, one, shaking, &[scale_ratio]).pop()
}

/// Scales of a motion that are followed before the work can be stopped again.
const TOGETHER: usize = 16;

fn followed_together(
    request: &RunsRequest,
    one: &ObjectRuns,
    shaking: &FloorShaking,
    scales_ratio: &[f64],
    go_on: GoOn,
) -> Result<Vec<Followed>, Problems> {
    let mut runs = Vec::with_capacity(scales_ratio.len());
    for scales_ratio in scales_ratio.chunks(TOGETHER) {
        go_on()?;
        runs.extend(followed(request, one, shaking, scales_ratio));
    }
    Ok(runs)
}

/// Steps down in the search for the scale that does not lift an object.
const MAX_DOWN: i32 = 200;

/// The largest scale of a motion, to 0.1 %, at which the object was seen not to lift: below it no limit
/// state is reached. It is exact where nothing but the horizontal motion lifts the object from a rigid
/// base; otherwise the scale falls by a tenth until nothing lifts it. `None` where that cannot be told.
pub(super) fn uplift_ratio(
    request: &RunsRequest,
    one: &ObjectRuns,
    shaking: &FloorShaking,
) -> Option<f64> {
    const BELOW: f64 = 0.999;
    let highest_ratio = BELOW * shaking.uplift_scale_ratio(one.factors);
    let all: Vec<f64> = (0..MAX_DOWN)
        .map(|step| highest_ratio / 1.1_f64.powi(step))
        .collect();
    // Most objects need the first alone.
    let (first, lower) = all.split_at(1);
    for scales_ratio in std::iter::once(first).chain(lower.chunks(TOGETHER)) {
        for run in followed(request, one, shaking, scales_ratio) {
            if !LimitState::Rocks.is_reached(run.run()?.class) {
                return Some(run.scale_ratio);
            }
        }
    }
    None
}

/// Whether the work continues: an error if it was stopped.
pub(super) type GoOn<'a> = &'a (dyn Fn() -> Result<(), Problems> + Sync);

/// The runs of an object under a motion, by rising scale; those of an adaptive analysis are filled
/// later.
pub(super) fn first_runs(
    request: &RunsRequest,
    one: &ObjectRuns,
    shaking: &FloorShaking,
    measures: &[Asked],
    go_on: GoOn,
) -> Result<Vec<Followed>, Problems> {
    let scales_ratio = match (request.method, &request.scales) {
        (Method::Cloud, _) => vec![1.0],
        (Method::Incremental, None) => return adaptive(request, one, shaking, go_on),
        (Method::Incremental, Some(scales)) => scales.clone(),
        (Method::Stripes, levels) => stripes(
            one,
            shaking,
            measures,
            levels.as_deref().unwrap_or_default(),
        )?,
    };
    let most = scales_ratio.iter().copied().fold(0.0, f64::max);
    if most > request.max_scale_ratio {
        let message = format!(
            "the motion {} would be scaled by {}, above the largest scale of {}",
            shorten(&shaking.name),
            number(most, 4),
            request.max_scale_ratio
        );
        let hint = "give smaller `scales`, stronger motions, or a larger `max_scale`";
        return Err(Problem::value(message, hint).of(&["scales"]).into());
    }
    let mut sorted = scales_ratio;
    sorted.sort_by(f64::total_cmp);
    sorted.dedup();
    followed_together(request, one, shaking, &sorted, go_on)
}

/// The scales of a motion that give it these intensities by the first measure.
fn stripes(
    one: &ObjectRuns,
    shaking: &FloorShaking,
    measures: &[Asked],
    levels: &[f64],
) -> Result<Vec<f64>, Problems> {
    let Some(first) = measures.first() else {
        return Ok(Vec::new());
    };
    let of_one = shaking.intensity(*first, one.factors).ok_or_else(|| {
        let message = format!(
            "the motion {} has no {}",
            shorten(&shaking.name),
            first.measure.name()
        );
        Problem::value(message, "give a measure that every motion has").of(&["im"])
    })?;
    Ok(levels.iter().map(|level| level / of_one).collect())
}

fn adaptive(
    request: &RunsRequest,
    one: &ObjectRuns,
    shaking: &FloorShaking,
    go_on: GoOn,
) -> Result<Vec<Followed>, Problems> {
    let mut stopped = Ok(());
    let mut runs: Vec<Followed> = Vec::new();
    let start_ratio = shaking.uplift_scale_ratio(one.factors);
    scales_of_motion(
        start_ratio,
        request.max_scale_ratio,
        &one.states(),
        |scale_ratio| {
            // The search ends by itself, and nothing more is run.
            if stopped.is_ok() {
                stopped = go_on();
            }
            if stopped.is_err() {
                return None;
            }
            let run = followed_at(request, one, shaking, scale_ratio)?;
            let class = run.run().map(|run| run.class);
            runs.push(run);
            class
        },
    );
    stopped?;
    sort(&mut runs);
    Ok(runs)
}

pub(super) fn sort(runs: &mut [Followed]) {
    runs.sort_by(|a, b| a.scale_ratio.total_cmp(&b.scale_ratio));
}

/// Normal quantile of 95 %.
const NORMAL_95: f64 = 1.644_853_626_951_472_6;

/// The intensities over which the runs of all motions are spread: all that were run of the motions
/// that lift the object, and the 5–95 % band of the capacities. A motion that is too weak to lift it
/// at the largest scale would only add levels at which nothing happens; if none lifts it, all count.
fn span(one: &ObjectRuns, shakings: &[FloorShaking], asked: Asked) -> Option<(f64, f64)> {
    let units: Vec<Option<f64>> = shakings
        .iter()
        .map(|shaking| shaking.intensity(asked, one.factors))
        .collect();
    let each = || {
        one.motions
            .iter()
            .zip(&units)
            .filter_map(|(runs, unit)| Some((runs, (*unit)?)))
    };
    let lifts = |runs: &[Followed]| {
        runs.iter().any(|run| {
            run.run()
                .is_some_and(|run| LimitState::Rocks.is_reached(run.class))
        })
    };
    let is_lifted = each().any(|(runs, _)| lifts(runs));
    let spread = || each().filter(|(runs, _)| !is_lifted || lifts(runs));
    let all =
        || spread().flat_map(|(runs, unit)| runs.iter().map(move |run| unit * run.scale_ratio));
    let (mut from, mut to) = (all().reduce(f64::min)?, all().reduce(f64::max)?);
    for state in one.states() {
        let reached = |runs: &[Followed]| {
            runs.iter()
                .find(|run| run.run().is_some_and(|run| state.is_reached(run.class)))
                .map(|run| run.scale_ratio)
        };
        let logs: Vec<f64> = each()
            .filter_map(|(runs, unit)| Some((unit * reached(runs)?).ln()))
            .collect();
        let Some((mean, sd)) = mean_and_sd(&logs) else {
            continue;
        };
        from = if state == LimitState::Rocks {
            from
        } else {
            from.min((mean - NORMAL_95 * sd).exp())
        };
        to = to.max((mean + NORMAL_95 * sd).exp());
    }
    Some((from, to))
}

/// Adds the runs that spread every motion over the same intensities by every measure, up to the
/// largest scale.
pub(super) fn fill(
    request: &RunsRequest,
    one: &mut ObjectRuns,
    shakings: &[FloorShaking],
    measures: &[Asked],
    go_on: GoOn,
) -> Result<(), Problems> {
    use rayon::prelude::*;
    let spans: Vec<Option<(f64, f64)>> = measures
        .iter()
        .map(|asked| span(one, shakings, *asked))
        .collect();
    one.spans.clone_from(&spans);
    let seen: &ObjectRuns = one;
    let more: Result<Vec<Vec<Followed>>, Problems> = shakings
        .par_iter()
        .zip(&seen.motions)
        .map(|(shaking, runs)| {
            let mut scales_ratio: Vec<f64> = runs.iter().map(|run| run.scale_ratio).collect();
            let mut added = Vec::new();
            for (asked, span) in measures.iter().zip(&spans) {
                let unit = shaking.intensity(*asked, seen.factors);
                let Some((unit, (from, to))) = unit.zip(*span) else {
                    continue;
                };
                let to_ratio = (to / unit).min(request.max_scale_ratio);
                if from / unit > to_ratio {
                    continue;
                }
                let missing = missing_levels(&scales_ratio, from / unit, to_ratio);
                scales_ratio.extend(&missing);
                scales_ratio.sort_by(f64::total_cmp);
                added.extend(missing);
            }
            followed_together(request, seen, shaking, &added, go_on)
        })
        .collect();
    for (runs, more) in one.motions.iter_mut().zip(more?) {
        runs.extend(more);
        sort(runs);
    }
    Ok(())
}
