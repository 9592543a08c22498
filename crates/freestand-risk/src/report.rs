//! The answer: the rates and losses of objects, and what is known beside them.

use freestand_input::file::InputFile;
use freestand_input::problem::Problem;
use freestand_output::facts::table;
use freestand_output::table::Table;

use crate::doubts::{RiskAssumption, RiskDoubt};
use crate::fragility::MeasuredHazard;
use crate::objects::{LossBounds, ObjectRisk, RiskVerdict};
use crate::plan::Measures;
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
    pub why: Option<WhyNotRun>,
}

/// Why an object was not run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum WhyNotRun {
    /// What the table of objects that were left out of the runs says.
    LeftOut(String),
    /// What the inventory says of its anchors.
    Anchored(String),
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
    pub assumptions: Vec<RiskAssumption>,
    /// The files that were read.
    pub inputs: Vec<InputFile>,
    /// What to know beside the result.
    pub doubts: Vec<RiskDoubt>,
}

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
