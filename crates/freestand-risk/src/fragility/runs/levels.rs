//! The intensities of stripes that nobody chose, and those that are added for a hazard.

use freestand::fragility::{FitKind, Outcomes, Run, fit_curves};
use freestand::risk::{
    AboveLast, Gap, Hazard, OpenPart, annual_rate, bounds_by_runs, capacities, open_parts,
};
use freestand_input::problem::{Problem, Problems};
use freestand_input::words::name_of;
use rayon::prelude::*;

use super::super::hazard::{HazardPlace, MeasuredHazard, hazard_of};
use super::shaking::{Asked, FloorShaking, Motions};
use super::{METHODS, Method, ObjectRuns, RunsRequest, follow};

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
    motions: Motions,
    go_on: follow::GoOn,
) -> Result<Vec<f64>, Problems> {
    let Motions { floors, measures } = motions;
    let Some(&first) = measures.first() else {
        return Ok(Vec::new());
    };
    let pilot = RunsRequest {
        method: Method::Incremental,
        scales: None,
        ..request.clone()
    };
    let ends = |one: &ObjectRuns| -> Result<Ends, Problems> {
        let mut ends = Ends {
            from: f64::INFINITY,
            to: 0.0,
        };
        for (place, shaking) in floors.get(one.floor).into_iter().flatten().enumerate() {
            go_on()?;
            let Some(unit) = shaking.intensity(first, one.factors) else {
                continue;
            };
            let uplift = follow::uplift_ratio(request, one, shaking)
                .unwrap_or(shaking.uplift_scale_ratio(one.factors));
            ends.from = ends.from.min(unit * uplift);
            if place < PILOTS {
                let runs = follow::first_runs(&pilot, one, shaking, measures, go_on)?;
                let highest = runs.last().map_or(0.0, |run| run.scale_ratio);
                ends.to = ends.to.max(BEYOND * unit * highest);
            }
        }
        Ok(ends)
    };
    let all = objects
        .par_iter()
        .map(ends)
        .collect::<Result<Vec<Ends>, Problems>>()?;
    let all = all.into_iter().reduce(|a, b| Ends {
        from: a.from.min(b.from),
        to: a.to.max(b.to),
    });
    let limit = limit(request, objects, motions);
    let found = all
        .map(|ends| (ends.from, ends.to.min(limit)))
        .filter(|(from, to)| from < to);
    let (from, to) = found.ok_or_else(|| {
        let hint = "give the intensities by the first measure as `scales`, or a larger `max_scale`";
        Problem::value("no motion lifts an object within the largest scale", hint).of(&["scales"])
    })?;
    let steps = (((to / from).ln() / RATIO.ln()).ceil() as usize).clamp(1, MOST - 1);
    Ok((0..=steps)
        .map(|i| from * (to / from).powf(i as f64 / steps as f64))
        .collect())
}

/// The intensities that an object needs.
struct Ends {
    from: f64,
    to: f64,
}

/// The intensity up to which no motion is scaled by more than the largest scale.
pub(super) fn limit(request: &RunsRequest, objects: &[ObjectRuns], motions: Motions) -> f64 {
    let units = objects.iter().flat_map(|one| units(one, motions)).flatten();
    // A motion at the largest scale must not be above it by rounding.
    request.max_scale_ratio * (1.0 - 1e-9) * units.fold(f64::INFINITY, f64::min)
}

/// The intensities of the motions of an object at a scale of 1.
fn units<'a>(one: &'a ObjectRuns, motions: Motions<'a>) -> impl Iterator<Item = Option<f64>> + 'a {
    let first = motions.measures.first();
    let of = move |shaking: &FloorShaking| shaking.intensity(*first?, one.factors);
    motions.floors.get(one.floor).into_iter().flatten().map(of)
}

/// Intensities of stripes by the first measure, rising; empty for other runs.
pub(super) struct Levels(Vec<f64>);

impl Levels {
    pub(super) fn new(levels: &[f64]) -> Self {
        let mut levels = levels.to_vec();
        levels.sort_by(f64::total_cmp);
        Self(levels)
    }

    /// The intensity of a run: exactly that of its stripe. Calculated from the scale of the motion
    /// it may differ in the last digit.
    pub(super) fn exact(&self, product: f64) -> f64 {
        // Two roundings, 2.2e-16 each.
        const ROUNDING: f64 = 1e-15;
        let place = self
            .0
            .partition_point(|level| *level < product * (1.0 - ROUNDING));
        let level = self
            .0
            .get(place)
            .filter(|level| (product / **level - 1.0).abs() < ROUNDING);
        level.copied().unwrap_or(product)
    }
}

/// The most intensities that are added.
pub(super) const MOST_ADDED: usize = 100;
/// The most rounds in which they are added: each halves the gaps, so that two intensities that are a factor of 1000
/// apart are a factor of 1.002 apart after them.
pub(super) const ROUNDS: usize = 12;

/// What was added to the intensities of stripes for a hazard.
#[derive(Debug)]
pub struct Added {
    /// That hazard.
    pub hazard: MeasuredHazard,
    /// How many intensities.
    pub count: usize,
    /// Ids of objects of whose rates the runs still leave much open.
    pub(crate) open_ids: Vec<String>,
}

/// The hazard for which intensities are added.
pub(super) fn hazard(
    request: &RunsRequest,
    measures: &[Asked],
) -> Result<Option<MeasuredHazard>, Problems> {
    let Some((source, first)) = request.hazard.as_ref().zip(measures.first()) else {
        return Ok(None);
    };
    let Asked { measure, at, .. } = *first;
    if request.method != Method::Stripes {
        let method = name_of(METHODS, request.method);
        let message =
            format!("a hazard curve adds intensities to stripes, but the method is {method}");
        let hint = "give `method = \"stripes\"`, or leave the hazard out";
        return Err(Problem::value(message, hint).of(&["hazard"]).into());
    }
    let hazard = hazard_of(
        source,
        HazardPlace::OfOutcomes(at),
        request.site_deg,
        Some((measure, at)),
    )?;
    hazard.check(measure, at)?;
    Ok(Some(hazard))
}

/// For each object the parts of its rates that its runs at these intensities leave open.
pub(super) fn open(
    hazard: &Hazard,
    objects: &[ObjectRuns],
    motions: Motions,
    levels: &[f64],
) -> Vec<Vec<OpenPart>> {
    let levels = Levels::new(levels);
    let of_object = |one: &ObjectRuns| {
        let (mut runs, mut uplifts) = (Vec::new(), Vec::new());
        let each = one
            .motions
            .iter()
            .zip(&one.uplifts_ratio)
            .zip(units(one, motions))
            .enumerate();
        for (motion, ((followed, uplift), unit)) in each {
            let Some(unit) = unit else { continue };
            let known = followed
                .iter()
                .filter_map(|run| Some((run.scale_ratio, run.run()?.class)));
            let before = runs.len();
            runs.extend(known.map(|(scale_ratio, class)| {
                let intensity = levels.exact(unit * scale_ratio);
                Run {
                    motion: Some(motion),
                    intensity,
                    class,
                    weight: 1.0,
                }
            }));
            // Motions without a run have no number.
            if runs.len() > before {
                uplifts.push(uplift.map(|uplift| unit * uplift));
            }
        }
        // The fit of all runs says what is wrong with them. However they are fitted, the same intensities are
        // added, so that kept runs serve every fit.
        let Ok(outcomes) = Outcomes::new(&runs) else {
            return Vec::new();
        };
        let curves = fit_curves(&outcomes, &outcomes.limit_states(), FitKind::Ordered).curves;
        let of_curve = curves.into_iter().flat_map(|curve| {
            let found = capacities(&outcomes, curve.limit_state, &uplifts);
            let by_curve = annual_rate(hazard, curve.kind);
            let (_, most) = bounds_by_runs(hazard, curve.kind, by_curve, &found, AboveLast::Open);
            open_parts(hazard, by_curve, most, &found)
        });
        of_curve.collect()
    };
    objects.par_iter().map(of_object).collect()
}

/// At most so many intensities inside what is open, rising: the geometric middle of a gap; half of the
/// lowest where the uplift is not known, and twice the highest, up to the limit.
pub(super) fn wanted(open: &[Vec<OpenPart>], levels: &[f64], limit: f64, most: usize) -> Vec<f64> {
    let inside = |part: &OpenPart| {
        let level = match part.gap {
            Gap::Below {
                uplift: Some(uplift),
                lowest,
            } => (uplift * lowest).sqrt(),
            Gap::Below {
                uplift: None,
                lowest,
            } => 0.5 * lowest,
            Gap::Between(from, to) => (from * to).sqrt(),
            Gap::Above(highest) => (2.0 * highest).min(limit),
        };
        (level, part.share)
    };
    // Runs that could not be followed leave gaps in which there is an intensity.
    let is_new = |level: f64| {
        levels
            .iter()
            .all(|other| (level / other).ln().abs() > LEAST_STEP)
    };
    let mut found: Vec<(f64, f64)> = open
        .iter()
        .flatten()
        .map(inside)
        .filter(|(level, _)| is_new(*level))
        .collect();
    // Objects share most of them; the largest share first.
    found.sort_by(|a, b| a.0.total_cmp(&b.0).then(b.1.total_cmp(&a.1)));
    found.dedup_by(|a, b| (a.0 / b.0).ln() < LEAST_STEP);
    found.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.total_cmp(&b.0)));
    found.truncate(most);
    let mut found: Vec<f64> = found.into_iter().map(|(level, _)| level).collect();
    found.sort_by(f64::total_cmp);
    found
}

/// Intensities that are closer than this in ln are the same: between them no rate has a tenth, unless λ
/// falls with x^−100.
const LEAST_STEP: f64 = 1e-3;
