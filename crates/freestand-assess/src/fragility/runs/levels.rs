//! The intensities of stripes that nobody chose.

use freestand_input::problem::{Problem, Problems};
use rayon::prelude::*;

use super::super::measure::{At, Measure};
use super::shaking::Shaking;
use super::{Method, ObjectRuns, RunsRequest, follow};

/// The ratio of neighbours. The part of a rate between two intensities is at most about k ln ratio times the
/// share of the capacities near them: for a hazard λ ∝ x^−4 and β = 0.4, that is a tenth.
const RATIO: f64 = 1.1;
/// The most intensities: farther apart where they would be more.
const MOST: usize = 60;
/// Motions of each object that are scaled up until they overturn it, to find where the highest intensity is.
const PILOTS: usize = 4;
/// How far above the capacities of these motions the highest intensity is: others withstand more.
const BEYOND: f64 = 1.5;

/// Intensities in equal ratios, common to all objects: from the weakest that lifts any of them in any motion
/// to above those that overturn them, as far as no motion is scaled by more than the largest scale.
pub(super) fn chosen(
    request: &RunsRequest,
    objects: &[ObjectRuns],
    floors: &[Vec<Shaking>],
    measures: &[(Measure, At)],
    go_on: follow::GoOn,
) -> Result<Vec<f64>, Problems> {
    let Some(&(measure, at)) = measures.first() else { return Ok(Vec::new()) };
    let pilot = RunsRequest { method: Method::Incremental, scales: None, ..request.clone() };
    let ends = |one: &ObjectRuns| -> Result<Ends, Problems> {
        let mut ends = Ends { from: f64::INFINITY, to: 0.0, limit: f64::INFINITY };
        for (place, shaking) in floors.get(one.floor).into_iter().flatten().enumerate() {
            go_on()?;
            let Some(unit) = shaking.intensity(measure, 0, at, one.factors) else { continue };
            let uplift = follow::uplift_ratio(request, one, shaking).unwrap_or(shaking.uplift_scale_ratio(one.factors));
            ends.from = ends.from.min(unit * uplift);
            ends.limit = ends.limit.min(unit * request.max_scale_ratio);
            if place < PILOTS {
                let runs = follow::first_runs(&pilot, one, shaking, measures, go_on)?;
                let highest = runs.last().map_or(0.0, |run| run.scale_ratio);
                ends.to = ends.to.max(BEYOND * unit * highest);
            }
        }
        Ok(ends)
    };
    let all = objects.par_iter().map(ends).collect::<Result<Vec<Ends>, Problems>>()?;
    let all = all.into_iter().reduce(|a, b| Ends {
        from: a.from.min(b.from),
        to: a.to.max(b.to),
        limit: a.limit.min(b.limit),
    });
    let found = all.map(|ends| (ends.from, ends.to.min(ends.limit))).filter(|(from, to)| from < to);
    let (from, to) = found.ok_or_else(|| {
        let hint = "give the intensities by the first measure as `scales`, or a larger `max_scale`";
        Problem::value("no motion lifts an object within the largest scale", hint).of(&["scales"])
    })?;
    let steps = (((to / from).ln() / RATIO.ln()).ceil() as usize).clamp(1, MOST - 1);
    // A motion at the largest scale must not be above it by rounding.
    let to = to * (1.0 - 1e-9);
    Ok((0..=steps).map(|i| from * (to / from).powf(i as f64 / steps as f64)).collect())
}

/// The intensities that an object needs.
struct Ends {
    from: f64,
    to: f64,
    limit: f64,
}
