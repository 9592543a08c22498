//! What is told of risk as a JSON document.

use freestand::risk::Bin;
use freestand_inventory::too_mild::TooMild;
use freestand_output::answer::Input;
use freestand_output::answer_of;
use freestand_risk::RiskReport;
use freestand_risk::fragility::MeasuredHazard;
use freestand_risk::objects::{ObjectRisk, StateRisk};
use freestand_risk::plan::{Chosen, Measures, Worth};
use freestand_risk::portfolio::InCurrency;
use freestand_risk::report::NotRun;

use super::doubts::assumptions;
use super::words::{not_counted, why_not_run, why_unjudged};

answer_of!(
    /// The rates and losses of objects, and what is known beside them.
    pub struct RiskAnswer<'r>(pub &'r RiskReport) as report.0 {
        version: &'static str = env!("CARGO_PKG_VERSION");
        /// The files that were read.
        inputs: Vec<Input> = report.0.inputs.iter().map(Input::from).collect();
        /// Years of the stated probabilities.
        years: f64;
        currency: Option<String>;
        hazard: &MeasuredHazard = &report.0.hazard;
        assumptions: Vec<String> = assumptions(report.0);
        objects: Vec<OfObject<'_>> = report.0.objects.iter().map(OfObject).collect();
        expected_annual_loss: Option<f64> = report.0.expected_annual_loss();
        expected_annual_loss_lower: Option<f64> = report.0.loss_bounds().map(|loss| loss.0);
        expected_annual_loss_upper: Option<f64> = report.0.loss_bounds().and_then(|loss| loss.1);
        is_bound: bool = report.0.is_bound();
        is_at_least: bool = report.0.is_at_least();
        /// Objects of the inventory without a fragility.
        not_run: Vec<OfNotRun<'_>> = report.0.not_run.iter().map(OfNotRun).collect();
        portfolio: Option<InCurrency<'_>> = report.0.in_currency();
        /// Options, the one that pays most first.
        ranking: Option<Vec<&Worth>> = report.0.measures.as_ref().map(Measures::ranking);
        plan: Option<&Chosen> = report.0.measures.as_ref().and_then(|measures| measures.plan.as_ref());
    }
);

answer_of!(
    /// An object.
    struct OfObject<'r>(&'r ObjectRisk) as object.0 {
        id: String;
        limit_states: Vec<&StateRisk> = object.0.states.iter().collect();
        /// Why the object may fail more often than its curves say.
        caution: Option<&'static str> = object.0.curves.caution.map(TooMild::name);
        /// Which intensities contribute to the rate.
        deaggregation: Vec<Contribution<'_>> = object.0.deaggregation.iter().map(Contribution).collect();
        /// The accepted rate of overturning.
        accepted_annual_rate: Option<f64> = object.0.accepted_rate;
        accepted_exceed_annual_rate: Option<f64> = object.0.accepted_exceed_rate;
        verdict: Option<&'static str> = object.0.verdict.map(<&str>::from);
        /// Whether the verdict holds within the 95 % interval.
        certain: Option<bool> = object.0.is_certain;
        /// Why there is no verdict.
        why: Option<String> = object.0.why.map(why_unjudged);
        expected_annual_loss: Option<f64>;
        expected_annual_loss_lower: Option<f64> = object.0.loss.map(|loss| loss.least);
        expected_annual_loss_upper: Option<f64> = object.0.loss.and_then(|loss| loss.most);
        /// Whether only bounds of the loss are known.
        is_bound: bool = object.0.loss.is_some_and(|loss| loss.is_bound());
        /// Whether it may be larger than stated.
        is_at_least: bool;
        expected_annual_casualties: Option<f64>;
        expected_annual_casualties_lower: Option<f64> = object.0.casualty_bounds.map(|bounds| bounds.0);
        expected_annual_casualties_upper: Option<f64> = object.0.casualty_bounds.and_then(|bounds| bounds.1);
        /// Costs that are missing.
        not_counted: Vec<&'static str> = object.0.not_counted.iter().copied().map(not_counted).collect();
    }
);

answer_of!(
    /// The part of a rate that comes from some intensities.
    struct Contribution<'r>(&'r Bin) as bin.0 {
        im_low: f64 = bin.0.low;
        im_high: Option<f64> = bin.0.high;
        annual_rate: f64;
        share: f64;
    }
);

answer_of!(
    /// An object of the inventory without a fragility.
    struct OfNotRun<'r>(&'r NotRun) as object.0 {
        id: String;
        item: String;
        quantity: f64;
        /// Why it was not run, as far as that is known.
        why: Option<String> = object.0.why.as_ref().map(why_not_run);
    }
);
