//! The answer: the rates and losses of objects, and what is known beside them.

use freestand_input::file::InputFile;
use freestand_input::problem::Problem;
use freestand_output::answer::Input;
use freestand_output::answer_of;
use freestand_output::facts::table;
use freestand_output::table::Table;

use crate::fragility::MeasuredHazard;
use crate::objects::{LossBounds, ObjectRisk, RiskVerdict};
use crate::plan::{Chosen, Measures, Worth};
use crate::portfolio::{InCurrency, Portfolio};

/// An object of the inventory that has no fragility, so that nothing about it is counted.
#[derive(Debug, Clone, PartialEq)]
pub struct NotRun {
    /// Identifier of the object.
    pub id: String,
    /// What it is.
    pub item: String,
    /// How many objects it stands for.
    pub quantity: f64,
    /// Why it was not run, as far as that is known.
    pub why: Option<String>,
}

/// The answer.
#[derive(Debug, Clone, PartialEq)]
pub struct RiskReport {
    /// Years of the stated probabilities.
    pub years: f64,
    /// The currency of all costs.
    pub currency: Option<String>,
    /// The hazard.
    pub hazard: MeasuredHazard,
    /// The objects.
    pub objects: Vec<ObjectRisk>,
    /// The losses of all of them together.
    pub portfolio: Option<Portfolio>,
    /// The options.
    pub measures: Option<Measures>,
    /// Objects of the inventory that have no fragility.
    pub not_run: Vec<NotRun>,
    /// What was used because nobody stated it.
    pub assumptions: Vec<String>,
    /// The files that were read.
    pub inputs: Vec<InputFile>,
    /// What to know beside the result.
    pub warnings: Vec<String>,
}

answer_of!(NotRun as object {
    id: String = object.id.clone();
    item: String = object.item.clone();
    quantity: f64 = object.quantity;
    /// Why it was not run, as far as that is known.
    why: Option<String> = object.why.clone();
});

answer_of!(RiskReport as report {
    version: &'static str = env!("CARGO_PKG_VERSION");
    /// The files that were read.
    inputs: Vec<Input> = report.inputs.iter().map(Input::from).collect();
    /// Years of the stated probabilities.
    years: f64 = report.years;
    currency: Option<String> = report.currency.clone();
    hazard: &MeasuredHazard = &report.hazard;
    assumptions: Vec<String> = report.assumptions.clone();
    objects: Vec<&ObjectRisk> = report.objects.iter().collect();
    expected_annual_loss: Option<f64> = report.expected_annual_loss();
    expected_annual_loss_lower: Option<f64> = report.loss_bounds().map(|loss| loss.0);
    expected_annual_loss_upper: Option<f64> = report.loss_bounds().and_then(|loss| loss.1);
    is_bound: bool = report.is_bound();
    is_at_least: bool = report.is_at_least();
    /// Objects of the inventory without a fragility.
    not_run: Vec<&NotRun> = report.not_run.iter().collect();
    portfolio: Option<InCurrency<'_>> = report.in_currency();
    /// Options, the one that pays most first.
    ranking: Option<Vec<&Worth>> = report.measures.as_ref().map(Measures::ranking);
    plan: Option<&Chosen> = report.measures.as_ref().and_then(|measures| measures.plan.as_ref());
});

impl RiskReport {
    /// Whether every accepted rate is kept, as far as it is known.
    pub fn is_accepted(&self) -> bool {
        self.objects
            .iter()
            .all(|object| object.verdict != Some(RiskVerdict::Exceeds))
    }

    /// Expected annual loss of all objects with costs.
    pub fn expected_annual_loss(&self) -> Option<f64> {
        let losses: Vec<f64> = self
            .objects
            .iter()
            .filter_map(|object| object.expected_annual_loss)
            .collect();
        (!losses.is_empty()).then(|| losses.iter().sum())
    }

    /// The least and the most that the losses of all objects with costs can be together.
    pub fn loss_bounds(&self) -> Option<(f64, Option<f64>)> {
        let losses = self.objects.iter().filter_map(|object| object.loss);
        losses
            .map(|loss| (loss.least, loss.most))
            .reduce(|a, b| (a.0 + b.0, a.1.zip(b.1).map(|(a, b)| a + b)))
    }

    /// The loss of all objects that is stated: *at least* the least, where one of them has no most.
    pub fn stated_loss(&self) -> Option<f64> {
        let losses = self.objects.iter().filter_map(|object| object.loss);
        losses
            .map(|loss| loss.stated(self.is_at_least()))
            .reduce(|a, b| a + b)
    }

    /// Whether only bounds of the losses of all objects together are known.
    pub fn is_bound(&self) -> bool {
        self.loss_bounds().is_some_and(|(least, most)| {
            LossBounds {
                least,
                best: least,
                most,
            }
            .is_bound()
        })
    }

    /// Whether the losses may be larger than stated, because a rate of an object with costs may be.
    pub fn is_at_least(&self) -> bool {
        self.objects
            .iter()
            .any(|object| object.expected_annual_loss.is_some() && object.is_at_least)
    }

    /// The losses of all objects with their currency.
    pub fn in_currency(&self) -> Option<InCurrency<'_>> {
        let (portfolio, currency) = (self.portfolio.as_ref()?, self.currency.as_deref());
        Some(InCurrency {
            portfolio,
            currency,
        })
    }

    /// `risk.csv`: one row for each object and limit state.
    ///
    /// # Errors
    /// None in practice: see [`table`].
    pub fn table(&self) -> Result<Table, Problem> {
        table(
            self.objects
                .iter()
                .flat_map(|object| object.rows(self.years)),
        )
    }
}
