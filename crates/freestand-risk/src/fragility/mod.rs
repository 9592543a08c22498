//! Fragilities of objects: fitted to a table of outcomes, and written for other programs.

mod curves;
mod doubt;
mod hazard;
pub mod measure;
mod outcomes;
mod quality;
mod runs;
pub(crate) mod table;

use std::ops::ControlFlow;
use std::path::PathBuf;

use freestand::fragility::{
    Bootstrap, CurveKind, Fit, FitKind, Goodness, LimitState, NoInterval, Outcomes, ShockFitError,
    ShockRun, TwoStage, bootstrap, clopper_pearson, empirical, fit_curves, fit_shock, goodness,
};
use freestand::risk::{Capacity, capacities};
use freestand_input::problem::{Problem, Problems};
use freestand_input::words::{Choices, name_of};
use freestand_output::facts::{Facts, table};
use freestand_output::table::Table;
use freestand_study::run::{Progress, Step};
use rayon::prelude::*;

use freestand_inventory::too_mild::TooMild;

pub use curves::ObjectCurves;
pub use curves::cautions;
use curves::{CAPACITY, CAUTION, capacities_text};
pub(crate) use curves::{contradictions, load_curves};
pub use doubt::{Contradiction, CurveDoubt, FitDoubt, HazardDoubt, UnusedColumn};
pub use hazard::MeasuredHazard;
pub use hazard::{HAZARD_CODES, HazardCode, HazardSource};
pub(crate) use hazard::{HazardPlace, hazard_of, number_and_unit};
pub use measure::{At, Measure};
pub use outcomes::OutcomeTable;
pub(crate) use outcomes::measure_of;
pub use quality::{Quality, Sufficiency};
pub use runs::{
    Added, Change, ChangedObject, DEFAULT_MAX_SCALE, FloorMotion, FloorShaking, Followed,
    GivenObject, KeepRuns, LeftOut, Limits, METHODS, Method, ObjectRuns, RunObjects, RunsDoubt,
    RunsReport, RunsRequest, file_name, fragility_of_runs, measures, scales,
};

/// How limit states are fitted, by name.
pub const FITS: Choices<FitKind> = &[
    (
        FitKind::Ordered,
        "ordered",
        "one β for all limit states of an object: curves cannot cross",
    ),
    (FitKind::Separate, "separate", "each limit state by itself"),
];

/// How runs are fitted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum FitMethod {
    /// Curves of all limit states, from the outcomes.
    Curves(FitKind),
    /// The ordered fit, but with `exceeds` from the shocks.
    TwoStage,
}

/// The names of the ways to fit runs.
pub const FIT_METHODS: Choices<FitMethod> = &[
    (
        FitMethod::Curves(FitKind::Ordered),
        "ordered",
        "one β for all limit states of an object: curves cannot cross",
    ),
    (
        FitMethod::Curves(FitKind::Separate),
        "separate",
        "each limit state by itself",
    ),
    (
        FitMethod::TwoStage,
        TWO_STAGE,
        "as ordered, with the limit state exceeds from the shocks below the ceiling",
    ),
];

impl FitMethod {
    /// How those limit states are fitted that are fitted to outcomes.
    pub fn kind(self) -> FitKind {
        match self {
            Self::Curves(kind) => kind,
            Self::TwoStage => FitKind::Ordered,
        }
    }
}

/// What an object withstands, for a fit of its shocks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShockLimits {
    /// Tolerance \[g\].
    pub tolerance_g: f64,
    /// Largest shock of an object that does not overturn \[g\].
    pub ceiling_g: f64,
}

/// The name of a fit of shocks and of its curve.
pub const TWO_STAGE: &str = "two-stage";

/// Runs whose rotation over α is below this ratio take no part in a line of ln demand or ln shock:
/// at the intensity that just lifts an object both are 0, and their logarithms are minus infinity.
const LEAST_ROTATION_RATIO: f64 = 0.01;

/// Bootstrap samples where none are asked for.
pub(crate) const DEFAULT_REPLICATES: u32 = 1000;

/// The most simulated samples for the p-value of a fit; more would not change what it says.
const MAX_SIMULATED: u32 = 199;

/// The schema of the document.
pub const FRAGILITY_SCHEMA: &str = "freestand.fragility/1";

/// Fragilities that are to be fitted.
#[derive(Debug, Clone, PartialEq)]
pub struct FragilityRequest {
    /// The table of outcomes.
    pub outcomes: PathBuf,
    /// Where the measure is taken; `None`: where it is by its nature, or the ground.
    pub at: Option<At>,
    /// How limit states are fitted.
    pub fit: FitKind,
    /// The tolerance and the ceiling for a fit of shocks; `None`: the classes of the table are
    /// fitted. For runs: those of the first object whose shocks are fitted.
    pub shock: Option<ShockLimits>,
    /// Bootstrap samples; `None`: 1000, 0: none.
    pub replicates: Option<u32>,
    /// Seed of the bootstrap.
    pub seed: u64,
}

/// The fragility of one object.
#[derive(Debug, Clone, PartialEq)]
pub struct ObjectFragility {
    /// Its id.
    pub id: String,
    /// Its runs.
    pub outcomes: Outcomes,
    /// Runs that could not be followed.
    pub unresolved: usize,
    /// Why, in words: each reason once.
    pub(crate) reasons: Vec<String>,
    /// Its curves.
    pub fit: Fit,
    /// Between which intensities of the runs the capacities are, for each limit state.
    pub(crate) capacities: Vec<(LimitState, Vec<Capacity>)>,
    /// Why it may fail more often than its curves say; `None`: that is not said.
    pub caution: Option<TooMild>,
    /// The probability of exceeding the tolerance, from the shocks.
    pub two_stage: Option<TwoStage>,
    /// Why the outcomes of runs were fitted instead of their shocks.
    pub(crate) no_two_stage: Option<ShockFitError>,
    /// How well they fit.
    pub goodness: Option<Goodness>,
    /// Fits of samples of motions; `None` for counts.
    pub bootstrap: Option<Bootstrap>,
    /// How well the measure tells what happens; empty where only the outcomes are known.
    pub qualities: Vec<Quality>,
    /// Runs that stayed upright above a scale that overturned the object; `None`: not known.
    pub resurrections: Option<usize>,
    /// Runs with a motion that was scaled by more than 4; `None`: not known.
    pub scaled_above_4: Option<usize>,
}

/// What was fitted.
#[derive(Debug, Clone, PartialEq)]
pub struct FragilityReport {
    /// What was asked.
    pub request: FragilityRequest,
    /// The table of outcomes.
    pub table: OutcomeTable,
    /// Where the measure is taken.
    pub at: At,
    /// The objects, as they first appear in the table.
    pub objects: Vec<ObjectFragility>,
    /// How the runs were chosen.
    pub method: &'static str,
}

/// Fits the fragilities of all objects of a table. The caller can stop it, at every bootstrap sample at the
/// latest.
///
/// # Errors
/// A table that cannot be read, with all its problems; and if the caller stopped it.
pub fn fragility(
    request: FragilityRequest,
    progress: Progress,
) -> Result<FragilityReport, Problems> {
    check_replicates(request.replicates)?;
    let table = OutcomeTable::load(&request.outcomes, progress)?;
    request
        .shock
        .map_or(Ok(()), |limits| table.check_shocks(limits.ceiling_g))?;
    let limits = vec![request.shock; table.objects.len()];
    let fitting = Fitting {
        request,
        table,
        method: METHOD,
        limits: &limits,
    };
    fitting.fitted(progress)
}

/// The most bootstrap samples: each keeps the curves of every object.
const MAX_REPLICATES: u32 = 100_000;

/// Refuses more samples than memory has room for.
///
/// # Errors
/// More than 100,000.
pub fn check_replicates(replicates: Option<u32>) -> Result<(), Problem> {
    let Some(many) = replicates.filter(|replicates| *replicates > MAX_REPLICATES) else {
        return Ok(());
    };
    let message =
        format!("{many} samples are too many: each is kept, and a 95 % interval needs about 1000");
    Err(Problem::value(message, format!("give at most {MAX_REPLICATES}")).of(&["bootstrap"]))
}

/// Asks the caller whether to continue.
///
/// # Errors
/// The caller stopped the work.
pub(crate) fn go_on(progress: Progress) -> Result<(), Problem> {
    match progress(Step::asks()) {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(Problem::stopped()),
    }
}

/// A table that was read, and how its fragilities are fitted.
struct Fitting<'a> {
    request: FragilityRequest,
    table: OutcomeTable,
    /// How the runs were chosen.
    method: &'static str,
    /// For each object the limits of a fit of its shocks; `None`: its outcomes are fitted.
    limits: &'a [Option<ShockLimits>],
}

impl Fitting<'_> {
    /// Fits the fragilities of all objects.
    fn fitted(self, progress: Progress) -> Result<FragilityReport, Problems> {
        let Self {
            request,
            table,
            method,
            limits,
        } = self;
        let at = table.measure.at(request.at)?;
        let replicates = request.replicates.unwrap_or(DEFAULT_REPLICATES);
        let is_wanted = || go_on(progress).is_ok();
        let shocks = if limits.iter().any(Option::is_some) {
            table.shocks()
        } else {
            Vec::new()
        };
        // Within an object the samples are calculated in parallel.
        let each = table
            .objects
            .iter()
            .zip(table.by_object()?)
            .zip(table.uplifts())
            .zip(limits)
            .enumerate();
        let objects = each.map(|(i, (((id, outcomes), uplifts), limits))| {
            go_on(progress)?;
            let mut states = outcomes.limit_states();
            let all = states.clone();
            if limits.is_some() {
                states.retain(|state| *state != LimitState::Exceeds);
            }
            let mut fit = fit_curves(&outcomes, &states, request.fit);
            let shocks = shocks.get(i).map_or(&[][..], Vec::as_slice);
            let (two_stage, no_two_stage) = match limits
                .map(|limits| two_stage(shocks, &fit, limits))
                .transpose()
            {
                Ok(found) => (found, None),
                Err(error) if method == METHOD => {
                    return Err(table.object_problem(i, &error.to_string(), shock_hint(error)));
                }
                // Some of many objects may have too few shocks; their outcomes can still be fitted.
                Err(error) => {
                    states = all;
                    fit = fit_curves(&outcomes, &states, request.fit);
                    (None, Some(error))
                }
            };
            let goodness = goodness(
                &outcomes,
                &fit,
                (replicates.min(MAX_SIMULATED), request.seed),
                &is_wanted,
            );
            let bootstrap = (replicates > 0 && !fit.fitted_states().is_empty())
                .then(|| {
                    bootstrap(
                        &outcomes,
                        &states,
                        request.fit,
                        (replicates, request.seed),
                        &is_wanted,
                    )
                })
                .flatten();
            go_on(progress)?;
            let unresolved = table.unresolved.get(i).copied().unwrap_or(0);
            let found = |state: LimitState| (state, capacities(&outcomes, state, &uplifts));
            Ok(ObjectFragility {
                id: id.clone(),
                capacities: fit
                    .curves
                    .iter()
                    .map(|curve| found(curve.limit_state))
                    .collect(),
                outcomes,
                unresolved,
                reasons: table.reasons.get(i).cloned().unwrap_or_default(),
                fit,
                caution: table.cautions.get(i).copied().flatten(),
                two_stage,
                no_two_stage,
                goodness,
                bootstrap,
                qualities: Vec::new(),
                resurrections: None,
                scaled_above_4: None,
            })
        });
        let objects = objects.collect::<Result<Vec<_>, Problem>>()?;
        Ok(FragilityReport {
            request,
            table,
            at,
            objects,
            method,
        })
    }
}

/// The probability of exceeding a tolerance, from the shocks of an object (each with its line).
fn two_stage(
    shocks: &[(usize, ShockRun)],
    fit: &Fit,
    limits: ShockLimits,
) -> Result<TwoStage, ShockFitError> {
    let ShockLimits {
        tolerance_g,
        ceiling_g,
    } = limits;
    let runs: Vec<ShockRun> = shocks.iter().map(|(_, run)| *run).collect();
    let shock = match fit_shock(&runs, ceiling_g) {
        Ok(shock) => Some(shock),
        // No shock exceeds such a tolerance, whatever the distribution.
        Err(_) if tolerance_g >= ceiling_g => None,
        Err(error) => return Err(error),
    };
    let curve = |state: LimitState| fit.curve(state).unwrap_or(CurveKind::None { lower: 0.0 });
    let (rocks, overturns) = (curve(LimitState::Rocks), curve(LimitState::Overturns));
    Ok(TwoStage {
        rocks,
        overturns,
        shock,
        ceiling_g,
        tolerance_g,
    })
}

/// What to do about shocks that cannot be fitted.
fn shock_hint(error: ShockFitError) -> &'static str {
    match error {
        ShockFitError::Shock { .. } => {
            "give the `ceiling` of this object, the ceiling_g that freestand shock states"
        }
        ShockFitError::TooFew { .. } => {
            "add runs that rocked, with their shock in the column edge_acceleration [g]"
        }
        ShockFitError::NoMaximum => "fit the outcomes with `fit = \"ordered\"`",
    }
}

/// The share of samples without a curve from which on the intervals are doubtful.
const MANY_FAILED: f64 = 0.02;

/// Motions below which percentile intervals are too narrow (docs/risk.md).
const FEW_MOTIONS: usize = 40;

/// A sum of weights without the rounding of its parts, if it is a whole number. Weights of a user that
/// do not sum to one stay as they are.
fn whole(sum: f64) -> f64 {
    // 1e-16 for each of up to a million weights.
    let rounded = sum.round();
    if (sum - rounded).abs() <= 1e-10 * rounded {
        rounded
    } else {
        sum
    }
}

impl ObjectFragility {
    /// Its curves, for a hazard.
    pub(crate) fn curves(&self, measure: Measure, at: At) -> ObjectCurves {
        let (curves, capacities) = (self.fit.curves.clone(), self.capacities.clone());
        ObjectCurves {
            id: self.id.clone(),
            measure,
            at,
            curves,
            capacities,
            caution: self.caution,
            line: 0,
        }
    }

    /// What to know beside its fit.
    fn doubts(&self) -> Vec<FitDoubt> {
        let mut doubts: Vec<FitDoubt> = Vec::new();
        doubts.extend(self.no_two_stage.map(FitDoubt::NotByShock));
        if self.unresolved > 0 {
            doubts.push(FitDoubt::Unresolved {
                runs: self.unresolved,
                reasons: self.reasons.clone(),
            });
        }
        let levels = self.outcomes.levels();
        let ends = levels.first().zip(levels.last());
        let crossing = ends.and_then(|(from, to)| self.fit.crossing(*from, *to));
        doubts.extend(crossing.map(FitDoubt::Crossing));
        let misfit = self.goodness.filter(|one| one.is_misfit() == Some(true));
        doubts.extend(misfit.map(|one| FitDoubt::Misfit {
            p_value: one.p_value.unwrap_or(0.0),
        }));
        for curve in &self.fit.curves {
            let state = curve.limit_state;
            doubts.extend(match curve.kind {
                CurveKind::NotIncreasing { .. } => Some(FitDoubt::NotIncreasing(state)),
                CurveKind::Bounds { .. } => Some(FitDoubt::OnlyBounds(state)),
                _ => self
                    .lacks_interval(state)
                    .map(|why| FitDoubt::NoInterval { state, why }),
            });
        }
        if let Some(bootstrap) = &self.bootstrap {
            let motions = self.outcomes.motions().unwrap_or(0);
            doubts.extend((motions < FEW_MOTIONS).then_some(FitDoubt::FewMotions(motions)));
            let (failed, samples) = (bootstrap.failed, bootstrap.samples.len());
            let is_many = failed as f64 > MANY_FAILED * samples as f64;
            doubts.extend(is_many.then_some(FitDoubt::FailedSamples { failed, samples }));
        }
        doubts
    }

    /// Between which intensities of the runs the capacities of a limit state are.
    pub fn capacities_of(&self, state: LimitState) -> &[Capacity] {
        self.capacities
            .iter()
            .find(|one| one.0 == state)
            .map_or(&[], |one| &one.1)
    }

    /// How it was fitted.
    pub fn fit_name(&self) -> &'static str {
        match self.two_stage {
            Some(_) if self.fit.kind == FitKind::Ordered => TWO_STAGE,
            _ => name_of(FITS, self.fit.kind),
        }
    }

    /// How many runs it has: the sum of their weights.
    pub fn runs(&self) -> f64 {
        whole(self.outcomes.totals().iter().sum())
    }

    /// Why a lognormal curve has no interval although samples were drawn.
    pub fn lacks_interval(&self, state: LimitState) -> Option<NoInterval> {
        let is_lognormal = matches!(self.fit.curve(state)?, CurveKind::Lognormal { .. });
        self.bootstrap
            .as_ref()
            .filter(|_| is_lognormal)?
            .lacks_interval(state)
    }

    /// The 95 % intervals of the median and of β.
    pub fn interval(&self, state: LimitState) -> Option<((f64, f64), (f64, f64))> {
        let interval = self.bootstrap.as_ref()?.interval(state)?;
        // Samples may have a curve where the whole has none.
        matches!(self.fit.curve(state)?, CurveKind::Lognormal { .. })
            .then_some((interval.median, interval.beta))
    }
}

/// How the runs were chosen: not known of a table.
const METHOD: &str = "outcomes";

impl FragilityReport {
    /// What to know beside the result.
    pub fn doubts(&self) -> Vec<CurveDoubt> {
        let objects = self.objects.iter();
        let of_fits = objects.clone().flat_map(|one| {
            let doubts = one.doubts().into_iter();
            doubts.map(|doubt| CurveDoubt::Fit {
                id: one.id.clone(),
                doubt,
            })
        });
        cautions(objects.map(|one| (one.id.as_str(), one.caution)))
            .chain(of_fits)
            .collect()
    }

    /// `fragility.csv`: one row for each curve.
    ///
    /// # Errors
    /// None in practice: see [`table`].
    pub fn table(&self) -> Result<Table, Problem> {
        table(self.objects.iter().flat_map(|object| {
            object.fit.curves.iter().map(move |curve| {
                let interval = object.interval(curve.limit_state);
                let (median, beta) = interval.unzip();
                Facts::default()
                    .key("id", object.id.as_str())
                    .key("im", self.table.measure.name())
                    .key("im_unit", self.table.measure.unit())
                    .key("at", self.at.name())
                    .key("limit_state", curve.limit_state.name())
                    .key("kind", curve.kind.name())
                    .key("median", curve.kind.median())
                    .key("beta", curve.kind.beta())
                    .key("median_ci95_low", median.map(|ends| ends.0))
                    .key("median_ci95_high", median.map(|ends| ends.1))
                    .key("beta_ci95_low", beta.map(|ends| ends.0))
                    .key("beta_ci95_high", beta.map(|ends| ends.1))
                    .key("lower", curve.kind.lower())
                    .key("upper", curve.kind.upper())
                    .key("method", self.method)
                    .key("fit", object.fit_name())
                    .key("motions", object.outcomes.motions())
                    .key("runs", object.runs())
                    .key(
                        CAPACITY,
                        capacities_text(object.capacities_of(curve.limit_state)),
                    )
                    .key(CAUTION, object.caution.map(TooMild::name))
            })
        }))
    }

    /// `empirical.csv`: what was seen at each level, the capacities of the motions, or of one run per
    /// motion the shares in bins.
    ///
    /// # Errors
    /// None in practice: see [`table`].
    pub fn empirical_table(&self) -> Result<Table, Problem> {
        let rows: Vec<Facts> = self
            .objects
            .par_iter()
            .flat_map_iter(|object| {
                object.fit.curves.iter().flat_map(move |curve| {
                    empirical(&object.outcomes, curve.limit_state)
                        .into_iter()
                        .map(move |seen| {
                            let (low, high) = clopper_pearson(seen.reached, seen.trials, 0.95);
                            Facts::default()
                                .key("id", object.id.as_str())
                                .key("limit_state", curve.limit_state.name())
                                .key("intensity", seen.intensity)
                                .key("trials", seen.trials)
                                .key("reached", seen.reached)
                                .key("share", seen.reached / seen.trials)
                                .key("share_ci95_low", low)
                                .key("share_ci95_high", high)
                                .key("fitted", curve.kind.probability(seen.intensity))
                        })
                })
            })
            .collect();
        table(rows)
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use freestand_study::run::no_progress;

    use super::*;

    fn report(text: &str) -> FragilityReport {
        let table = OutcomeTable::read(text.as_bytes(), Path::new("o.csv"), &no_progress).unwrap();
        let request = FragilityRequest {
            outcomes: PathBuf::from("o.csv"),
            at: None,
            fit: FitKind::Ordered,
            shock: None,
            replicates: Some(200),
            seed: 1,
        };
        let limits = vec![None; table.objects.len()];
        let fitting = Fitting {
            request,
            table,
            method: METHOD,
            limits: &limits,
        };
        fitting.fitted(&no_progress).unwrap()
    }

    #[test]
    fn runs_of_weights_are_a_whole_number_where_their_sum_is_one() {
        assert_eq!(
            (whole(58.999_999_999_999_99), whole(58.999), whole(0.0)),
            (59.0, 58.999, 0.0)
        );
    }

    /// One motion: every sample is the same.
    #[test]
    fn an_interval_without_width_is_none() {
        let report = report(
            "object,motion,pgv [m/s],outcome\na,m,0.1,no-uplift\na,m,0.2,overturned\na,m,0.3,no-uplift\n\
             a,m,0.4,overturned\n",
        );
        let object = &report.objects[0];
        assert!(matches!(
            object.fit.curve(LimitState::Overturns),
            Some(CurveKind::Lognormal { .. })
        ));
        assert_eq!(
            object.lacks_interval(LimitState::Overturns),
            Some(NoInterval::AllEqual)
        );
        assert!(object.interval(LimitState::Overturns).is_none());
        let doubt = FitDoubt::NoInterval {
            state: LimitState::Overturns,
            why: NoInterval::AllEqual,
        };
        assert!(object.doubts().contains(&doubt), "{:?}", object.doubts());
    }
}
