//! What is told of fragilities.

use freestand::fragility::{
    Bootstrap, Curve, Goodness, LimitState, OutcomeClass, TwoStage, capacity_spread,
};
use freestand::risk::Capacity;
use freestand_output::answer::Input;
use freestand_output::answer_of;

use freestand_inventory::too_mild::TooMild;
use freestand_risk::fragility::{FragilityReport, ObjectFragility, Quality, Sufficiency};

use super::doubts::why_no_interval;

answer_of!(
    /// Fragilities as a JSON document tells them.
    pub struct FragilityAnswer<'r>(pub &'r FragilityReport) as report.0 {
        version: &'static str = env!("CARGO_PKG_VERSION");
        /// Seed of the bootstrap.
        seed: u64 = report.0.request.seed;
        /// The files that were read.
        inputs: Vec<Input> = vec![Input::from(&report.0.table.file)];
        objects: Vec<OfObject<'_>> = OfObject::all(report.0);
    }
);

/// An object in its report.
#[derive(Clone, Copy)]
pub(super) struct OfObject<'r> {
    report: &'r FragilityReport,
    object: &'r ObjectFragility,
}

impl<'r> OfObject<'r> {
    /// All objects of a report.
    pub(super) fn all(report: &'r FragilityReport) -> Vec<Self> {
        let of = |object| Self { report, object };
        report.objects.iter().map(of).collect()
    }

    fn class(&self, class: OutcomeClass) -> f64 {
        self.object.outcomes.totals()[class.index()]
    }

    /// The quality of the measure for the most severe limit state that has one.
    fn severe(&self) -> Option<&'r Quality> {
        let mut qualities = self.object.qualities.iter();
        qualities.rfind(|quality| quality.efficiency.is_some())
    }

    fn efficiency(&self) -> Option<f64> {
        match self.severe() {
            Some(quality) => quality.efficiency,
            None => capacity_spread(&self.object.outcomes, LimitState::Overturns),
        }
    }

    /// Where two curves cross within the levels.
    fn crossing(&self) -> Option<f64> {
        let levels = self.object.outcomes.levels();
        let (from, to) = levels.first().zip(levels.last())?;
        self.object
            .fit
            .crossing(*from, *to)
            .map(|found| found.intensity)
    }
}

answer_of!(OfObject<'_> as of {
    id: String = of.object.id.clone();
    /// The intensity measure.
    im: String = of.report.table.measure.name();
    im_unit: &'static str = of.report.table.measure.unit();
    /// Where the measure is taken: ground or floor.
    at: &'static str = of.report.at.name();
    /// How the runs were chosen.
    method: &'static str = of.report.method;
    /// How the limit states were fitted.
    fit: &'static str = of.object.fit_name();
    motions: Option<usize> = of.object.outcomes.motions();
    /// Runs; the sum of their weights.
    runs: f64 = of.object.runs();
    /// Runs that could not be calculated.
    unresolved: usize = of.object.unresolved;
    counts: Counts<'_> = Counts(*of);
    curves: Vec<OfCurve<'_>> = of.object.fit.curves.iter().map(|curve| OfCurve { object: of.object, curve }).collect();
    /// Why the object may fail more often than its curves say.
    caution: Option<&'static str> = of.object.caution.map(TooMild::name);
    exceeds_by_shock: Option<ByShock> = of.object.two_stage.map(ByShock);
    crossing_im: Option<f64> = of.crossing();
    log_likelihood: Option<f64> = (!of.object.fit.fitted_states().is_empty()).then_some(of.object.fit.log_likelihood);
    goodness: Option<Fitness> = of.object.goodness.map(Fitness);
    /// β of the capacities, of the most severe limit state that has one.
    efficiency: Option<f64> = of.efficiency();
    sufficiency: Option<Sufficiency<'_>> = of.severe().map(Sufficiency);
    measures: Vec<&Quality> = of.object.qualities.iter().collect();
    /// Runs that stayed upright above a scale that overturned the object.
    resurrections: Option<usize> = of.object.resurrections;
    scaled_above_4: Option<usize> = of.object.scaled_above_4;
    bootstrap: Option<Sampled<'_>> = of.object.bootstrap.as_ref().map(Sampled);
});

/// Runs by what happened, each with its weight.
#[derive(Clone, Copy)]
struct Counts<'r>(OfObject<'r>);

answer_of!(Counts<'_> as counts {
    no_uplift: f64 = counts.0.class(OutcomeClass::NoUplift);
    rocked: f64 = counts.0.class(OutcomeClass::Rocked);
    exceeded: f64 = counts.0.class(OutcomeClass::Exceeded);
    overturned: f64 = counts.0.class(OutcomeClass::Overturned);
});

/// The curve of a limit state.
#[derive(Clone, Copy)]
struct OfCurve<'r> {
    object: &'r ObjectFragility,
    curve: &'r Curve,
}

impl OfCurve<'_> {
    /// The 95 % intervals of the median and of β.
    fn intervals(&self) -> (Option<[f64; 2]>, Option<[f64; 2]>) {
        let both = self.object.interval(self.curve.limit_state).unzip();
        (both.0.map(Into::into), both.1.map(Into::into))
    }
}

answer_of!(OfCurve<'_> as of {
    limit_state: &'static str = of.curve.limit_state.name();
    /// lognormal, step, none or another shape.
    kind: &'static str = of.curve.kind.name();
    median: Option<f64> = of.curve.kind.median();
    beta: Option<f64> = of.curve.kind.beta();
    median_ci95: Option<[f64; 2]> = of.intervals().0;
    beta_ci95: Option<[f64; 2]> = of.intervals().1;
    why_no_ci95: Option<String> = of.object.lacks_interval(of.curve.limit_state).map(why_no_interval);
    /// No run reaches the state below this intensity.
    lower: Option<f64> = of.curve.kind.lower();
    /// All runs reach it above this one.
    upper: Option<f64> = of.curve.kind.upper();
    capacity: Vec<Between<'_>> = of.object.capacities_of(of.curve.limit_state).iter().map(Between).collect();
});

/// Two intensities between which motions reach a limit state.
#[derive(Clone, Copy)]
struct Between<'r>(&'r Capacity);

answer_of!(Between<'_> as one {
    from: Option<f64> = one.0.from;
    to: Option<f64> = one.0.to;
    /// The share of the motions.
    share: f64 = one.0.share;
});

/// The probability of exceeding a tolerance, from the shocks.
#[derive(Clone, Copy)]
struct ByShock(TwoStage);

answer_of!(ByShock as by {
    tolerance_g: f64 = by.0.tolerance_g;
    ceiling_g: f64 = by.0.ceiling_g;
    intercept: Option<f64> = by.0.shock.map(|shock| shock.intercept);
    slope: Option<f64> = by.0.shock.map(|shock| shock.slope);
    sigma: Option<f64> = by.0.shock.map(|shock| shock.sigma);
    log_likelihood: Option<f64> = by.0.shock.map(|shock| shock.log_likelihood);
    median: Option<f64> = by.0.median();
    /// `ceiling`: no shock exceeds such a tolerance.
    why: Option<&'static str> = by.0.is_above_ceiling().then_some("ceiling");
});

/// How well the curves fit.
#[derive(Clone, Copy)]
struct Fitness(Goodness);

answer_of!(Fitness as fitness {
    deviance: f64 = fitness.0.deviance;
    /// Degrees of freedom.
    dof: f64 = fitness.0.dof as f64;
    p_value: Option<f64> = fitness.0.p_value;
    ks: Option<f64> = fitness.0.ks;
    misfit: Option<bool> = fitness.0.is_misfit();
});

/// Samples of the motions.
#[derive(Clone, Copy)]
struct Sampled<'r>(&'r Bootstrap);

answer_of!(Sampled<'_> as sampled {
    replicates: usize = sampled.0.samples.len();
    /// Samples without a curve.
    failed: usize = sampled.0.failed;
});
