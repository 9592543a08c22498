//! Which objects of an assessment to restrain with a given amount of money: life safety first, then what pays most.

mod fitting;
mod losses;
mod rates;
mod sites;
mod uses;

pub use losses::{
    Insured, InsuredSite, LossOfSite, LossRow, SitesLosses, Together, UnknownLosses, exposure,
    losses_over_sites,
};

pub use fitting::{Fitting, ToFit};
pub use sites::{PlannedSite, plan_over_sites};
pub use uses::LifeSafety;

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use freestand::decision::{Level, annual_rate};
use freestand::risk::{Hazard, present_value_factor_years};
use freestand_assess::portfolio::Row;
use freestand_assess::result::{Decision, Probability};
use freestand_assess::verdict::{
    Effect, Grip, GripAt, Measure, NotCalculated, Restrained, Wanted, restrained,
};
use freestand_assess::worlds::Worlds;
use freestand_input::file::InputFile;
use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::{UnitSystem, shorten};
use freestand_inventory::library::{
    Confidence, Hold, HoldsWhat, RestraintEntry, RestraintKind, RestraintLibrary,
};
use freestand_inventory::{Casters, CellsRequest, Item, Rating, currency_code};
use freestand_output::answer_of;
use freestand_study::run::Progress;
use freestand_study::study::Study;
use strum::IntoStaticStr;

use crate::costs::{CostRow, costs_of_register};
use crate::objects::LossBounds;
use crate::plan::{Worth, is_for_people, spent_within};

/// Years over which a restraint pays, where nobody states them: an assumption.
pub const ASSUMED_HORIZON_YEARS: f64 = 50.0;

/// Discount rate per year where nobody states it: an assumption.
pub const ASSUMED_DISCOUNT_RATIO: f64 = 0.03;

/// What one US dollar is in other currencies, rounded values of 2025, for the prices of the built-in restraints,
/// which are no more exact themselves: an assumption.
const PER_DOLLAR: [(&str, f64); 8] = [
    ("USD", 1.0),
    ("NZD", 1.7),
    ("AUD", 1.55),
    ("CAD", 1.4),
    ("EUR", 0.9),
    ("CHF", 0.85),
    ("GBP", 0.78),
    ("JPY", 150.0),
];

/// What is asked.
#[derive(Debug, Clone, PartialEq)]
pub struct BudgetRequest {
    /// The most that the measures may cost, and its currency.
    pub budget: (f64, String),
    /// Over which they pay \[years\]; `None`: [`ASSUMED_HORIZON_YEARS`].
    pub horizon_years: Option<f64>,
    /// Discount rate per year; `None`: [`ASSUMED_DISCOUNT_RATIO`].
    pub discount_ratio: Option<f64>,
    /// The user's restraints.
    pub restraints: Option<PathBuf>,
    /// How the cells of the list are read.
    pub cells: CellsRequest,
}

/// A budget, with the restraints that it may buy and what falls cost.
#[derive(Debug)]
pub struct Budget {
    amount: f64,
    currency: String,
    horizon_years: f64,
    discount_ratio: f64,
    is_horizon_assumed: bool,
    library: RestraintLibrary,
    /// Of the objects of the list, by their ids.
    costs: HashMap<String, CostRow>,
    has_costs: bool,
    /// The units of the list.
    units: UnitSystem,
}

impl Budget {
    /// What is asked of this list, which has these units, with everything that it needs.
    ///
    /// # Errors
    /// A file of restraints or costs that cannot be read; costs or restraints in another currency.
    pub fn new(request: &BudgetRequest, list: &Path, units: UnitSystem) -> Result<Self, Problems> {
        let (amount, currency) = &request.budget;
        let currency = currency_code(currency).to_owned();
        let library = RestraintLibrary::restraints(request.restraints.as_deref())?;
        let priced = library.entries().iter();
        let unpriced = priced
            .clone()
            .find(|entry| !entry.is_builtin() && entry.currency != currency);
        if let Some(entry) = unpriced {
            let message = format!(
                "the restraint \"{}\" is priced in {}, and the budget is in {currency}",
                shorten(&entry.id),
                entry.currency
            );
            let hint = format!("convert the prices of the file to {currency}");
            let problem = Problem::value(message, hint).of(&["restraints"]);
            return Err(problem.into());
        }
        if priced
            .clone()
            .all(|entry| per_unit(entry, &currency).is_none())
        {
            let known: Vec<&str> = PER_DOLLAR.iter().map(|(code, _)| *code).collect();
            let message = match currency.as_str() {
                "$" => "the budget does not say whose dollars it is in".to_owned(),
                _ => format!(
                    "the prices of the built-in restraints are not known in {}",
                    shorten(&currency)
                ),
            };
            let hint = format!(
                "give a file of restraints with prices in {}: `restraints = \"mine.csv\"`; or a budget in one of {}",
                shorten(&currency),
                known.join(", ")
            );
            return Err(Problem::value(message, hint).of(&["budget"]).into());
        }
        let costs = costs_of_register(list, &request.cells)?;
        if let Some(other) = costs.currency.as_deref().map(currency_code)
            && other != currency
        {
            let message = format!(
                "the budget is in {}, and the costs of the list are in {}",
                shorten(&currency),
                shorten(other)
            );
            let hint = format!("give the budget in {}", shorten(other));
            return Err(Problem::value(message, hint).of(&["budget"]).into());
        }
        let has_costs = costs.rows.iter().any(CostRow::has_costs);
        Ok(Self {
            amount: *amount,
            currency,
            horizon_years: request.horizon_years.unwrap_or(ASSUMED_HORIZON_YEARS),
            discount_ratio: request.discount_ratio.unwrap_or(ASSUMED_DISCOUNT_RATIO),
            is_horizon_assumed: request.horizon_years.is_none() || request.discount_ratio.is_none(),
            library,
            costs: costs
                .rows
                .into_iter()
                .map(|row| (row.id.clone(), row))
                .collect(),
            has_costs,
            units,
        })
    }

    /// The files that it reads besides the list.
    pub fn inputs(&self) -> &[InputFile] {
        &self.library.inputs
    }

    /// What the results depend on, for a manifest.
    pub fn told(&self) -> String {
        let files: Vec<&str> = self
            .library
            .inputs
            .iter()
            .map(|file| file.sha256.as_str())
            .collect();
        format!(
            "{} {}; {} years at {}; restraints {}",
            self.amount,
            self.currency,
            self.horizon_years,
            self.discount_ratio,
            files.join(" ")
        )
    }
}

/// What one unit of the currency of a restraint is in another one; `None`: not known.
fn per_unit(entry: &RestraintEntry, currency: &str) -> Option<f64> {
    if entry.currency == currency {
        return Some(1.0);
    }
    let rate = |code: &str| PER_DOLLAR.iter().find(|(known, _)| *known == code);
    let (_, own) = rate(&entry.currency).filter(|_| entry.is_builtin())?;
    let (_, other) = rate(currency)?;
    Some(other / own)
}

/// Why a measure is in the plan.
#[derive(Debug, Clone, Copy, PartialEq, Eq, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum Planned {
    /// The fall of the object may hurt somebody, by its rating.
    LifeSafety,
    /// What it saves is more than it costs.
    Pays,
    /// It avoids falls, and no yearly rate is known.
    AvoidsFalls,
}

/// Why a measure is not in the plan.
#[derive(Debug, Clone, Copy, PartialEq, Eq, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum NotPlanned {
    /// Another measure for the object is.
    AnotherMeasure,
    /// The budget does not reach it.
    Unfunded,
    /// It saves less than it costs.
    DoesNotPay,
    /// No cost of a fall is known, and nobody is hurt.
    NothingToSave,
    /// It avoids no falls.
    AvoidsNoFalls,
    /// The capacity of the restraint is not known.
    NoMedian,
    /// The slack of the restraint ends in an impact, of which nothing is calculated.
    Slack,
    /// It holds what is on the object.
    HoldsContents,
    /// A pad softens landings, and holds nothing.
    Pad,
    /// The mass of the object is not known.
    NoMass,
    /// The hold is flexible, and the object does not move in a plane.
    NotInAPlane,
    /// Something stands on the object, which it does not hold.
    Stacked,
}

/// Whether a measure is in the plan.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Standing {
    /// It is.
    In(Planned),
    /// It is not.
    Out(NotPlanned),
}

impl Standing {
    /// The name in outputs.
    pub fn name(self) -> &'static str {
        match self {
            Self::In(why) => why.into(),
            Self::Out(why) => why.into(),
        }
    }
}

/// One measure for one object, in the plan or not.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanRow {
    /// The object.
    pub id: String,
    /// What it is.
    pub item: String,
    /// Where it is: building, floor and room, as the list has them.
    pub place: String,
    /// How many such objects there are; everything of money is for all of them.
    pub quantity: u32,
    /// The restraint, by its id.
    pub measure: String,
    /// What the restraint is.
    pub measure_item: String,
    /// Its kind.
    pub kind: RestraintKind,
    /// Whether it is in the plan, and why.
    pub standing: Standing,
    /// What it costs: low, middle, high.
    pub cost: [f64; 3],
    /// The currency.
    pub currency: String,
    /// Median capacity of the restraint \[N\].
    pub capacity_n: Option<f64>,
    /// Standard deviation of the logarithm of its capacity.
    pub beta: f64,
    /// Whether nobody states it.
    pub beta_is_assumed: bool,
    /// How far the capacity can be trusted; `None`: there is none.
    pub capacity_confidence: Option<Confidence>,
    /// How far the price can be trusted.
    pub price_confidence: Confidence,
    /// The verdict of the assessment.
    pub decision: Decision,
    /// The probability that it falls as it stands.
    pub before: Probability,
    /// What the measure does; `None`: not calculated.
    pub effect: Option<Effect>,
    /// Falls of one object a year, as it stands and with the measure; `None`: not known.
    pub rates: Option<[f64; 2]>,
    /// Whether the first of them may be larger.
    pub is_at_least: bool,
    /// What falls of all these objects cost a year, as they stand and with the measure.
    pub losses: Option<[f64; 2]>,
    /// Present value of what it saves.
    pub benefit: Option<f64>,
    /// What its fall means for people.
    pub life_safety: LifeSafety,
    /// The object, shared by all its measures.
    pub object: Arc<ToFit>,
    /// What fitting the restraint takes, for one of them.
    pub fitting: Fitting,
}

impl PlanRow {
    /// Whether it is in the plan.
    pub fn is_planned(&self) -> bool {
        matches!(self.standing, Standing::In(_))
    }

    /// Upper end of the probability of falling with the measure: not below the share of worlds in which the
    /// restraint gives way, because then nothing is certain of the object.
    pub fn after_high(&self) -> Option<f64> {
        let effect = self.effect.as_ref()?;
        Some(
            effect
                .overturn
                .high
                .max(effect.exceeded_ratio.unwrap_or(0.0)),
        )
    }

    /// Falls that it avoids, of all these objects: a year where rates are known, else in the earthquake of the
    /// study.
    pub fn falls_avoided(&self) -> Option<f64> {
        let each = match self.rates {
            Some([before, after]) => before - after,
            None => self.before.value - self.effect.as_ref()?.overturn.value,
        };
        Some(f64::from(self.quantity) * each.max(0.0))
    }
}

answer_of!(PlanRow as row {
    id: String = row.id.clone();
    measure: String = row.measure.clone();
    kind: &'static str = row.kind.name();
    /// Why it is in the plan, or not.
    status: &'static str = row.standing.name();
    /// The verdict of the assessment.
    decision: &'static str = row.decision.name();
    quantity: usize = row.quantity as usize;
    /// For all of them.
    cost: f64 = row.cost[1];
    cost_low: f64 = row.cost[0];
    cost_high: f64 = row.cost[2];
    currency: String = row.currency.clone();
    /// Force that the restraint must withstand in all worlds but the accepted share.
    force_n: Option<f64> = row.effect.as_ref().and_then(|effect| effect.force_n);
    /// Median capacity of the restraint.
    capacity_n: Option<f64> = row.capacity_n;
    /// Standard deviation of its logarithm.
    capacity_beta: Option<f64> = row.capacity_n.map(|_| row.beta);
    capacity_confidence: Option<&'static str> = row.capacity_confidence.map(Confidence::name);
    price_confidence: &'static str = row.price_confidence.name();
    p_overturn: f64 = row.before.value;
    p_overturn_low: f64 = row.before.low;
    p_overturn_high: f64 = row.before.high;
    p_overturn_after: Option<f64> = row.effect.as_ref().map(|effect| effect.overturn.value);
    p_overturn_after_low: Option<f64> = row.effect.as_ref().map(|effect| effect.overturn.low);
    /// Not below the probability that the capacity is exceeded.
    p_overturn_after_high: Option<f64> = row.after_high();
    /// The probability that the capacity is exceeded.
    p_capacity_exceeded: Option<f64> = row.effect.as_ref().and_then(|effect| effect.exceeded_ratio);
    /// Of all of them.
    annual_loss: Option<f64> = row.losses.map(|[before, _]| before);
    annual_loss_after: Option<f64> = row.losses.map(|[_, after]| after);
    /// Whether falls below the weakest earthquake that was calculated add to it.
    annual_loss_is_at_least: bool = row.is_at_least;
    benefit_present_value: Option<f64> = row.benefit;
    /// A year, or in the earthquake of the study where no yearly rate is known.
    falls_avoided: Option<f64> = row.falls_avoided();
    life_safety: Option<&'static str> = row.life_safety.rating.map(Rating::name);
    life_safety_is_assumed: bool = row.life_safety.is_assumed;
});

/// Objects whose fall may hurt somebody and which a budget does not reach.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unfunded {
    /// How many.
    pub objects: u32,
    /// What restraining them costs.
    pub cost: f64,
}

/// The plan, and everything that it was chosen from.
#[derive(Debug, Clone, PartialEq)]
pub struct BudgetPlan {
    /// The budget.
    pub amount: f64,
    /// Its currency.
    pub currency: String,
    /// What the plan costs.
    pub cost: f64,
    /// Over which measures pay \[years\].
    pub horizon_years: f64,
    /// Discount rate per year.
    pub discount_ratio: f64,
    /// Whether one of both is assumed.
    pub is_horizon_assumed: bool,
    /// Whether yearly rates are known; else falls in the earthquake of the study count.
    pub has_rates: bool,
    /// Whether the yearly rates go on below the return periods of the code.
    pub extends: bool,
    /// Whether the list says what a fall costs.
    pub has_costs: bool,
    /// What the prices of built-in restraints were multiplied by; `None`: they are in the currency of the budget.
    pub converted: Option<f64>,
    /// Life safety that the budget does not reach.
    pub unfunded: Unfunded,
    /// Objects whose fall may hurt somebody and of which no measure has a calculated effect that avoids falls.
    pub without_measure: u32,
    /// Objects whose verdict is to restrain them and that are not planned.
    pub not_restrained: u32,
    /// Those of them for which no restraint suits that has a price in this currency.
    pub without_option: u32,
    /// Whether no plan is better.
    pub is_optimal: bool,
    /// Every measure for every object: those of the plan first, by life safety, then by the verdict, then by benefit
    /// over cost.
    pub rows: Vec<PlanRow>,
}

impl BudgetPlan {
    /// The measures of the plan.
    pub fn planned(&self) -> impl Iterator<Item = &PlanRow> {
        self.rows.iter().filter(|row| row.is_planned())
    }

    /// Objects that may be left as they are and that are planned for this reason.
    pub fn left_and_planned(&self, why: Planned) -> u32 {
        self.planned()
            .filter(|row| row.decision == Decision::Leave && row.standing == Standing::In(why))
            .map(|row| row.quantity)
            .sum()
    }
}

answer_of!(BudgetPlan as plan {
    budget: f64 = plan.amount;
    currency: String = plan.currency.clone();
    cost: f64 = plan.cost;
    horizon_years: f64 = plan.horizon_years;
    discount_ratio: f64 = plan.discount_ratio;
    /// Whether nobody stated one of both.
    horizon_is_assumed: bool = plan.is_horizon_assumed;
    /// Whether yearly rates are known; else falls in the earthquake of the study count.
    has_annual_rates: bool = plan.has_rates;
    unfunded_life_safety_objects: usize = plan.unfunded.objects as usize;
    unfunded_life_safety_cost: f64 = plan.unfunded.cost;
    /// Objects whose fall may hurt somebody and of which no measure has a calculated effect that avoids falls.
    life_safety_without_measure: usize = plan.without_measure as usize;
    /// Objects whose verdict is to restrain them and that are not planned.
    not_restrained: usize = plan.not_restrained as usize;
    is_optimal: bool = plan.is_optimal;
});

/// Every measure for every object of a list, before anything is chosen.
#[derive(Debug, Clone)]
pub struct Priced {
    /// Each with the number of its object.
    rows: Vec<(usize, PlanRow)>,
    objects: Vec<Asked>,
    has_rates: bool,
    /// Whether the rates go on below the return periods of the code.
    extends: bool,
    has_costs: bool,
    /// What falls cost in earthquakes; `None`: yearly rates or costs are not known.
    losses: Option<losses::Losses>,
}

/// What counts of an object, also where no measure suits it.
#[derive(Debug, Clone, Copy)]
struct Asked {
    quantity: u32,
    decision: Decision,
    rating: Option<Rating>,
}

/// An object that may be restrained.
struct Candidate<'a> {
    item: &'a Item,
    decision: Decision,
    before: Probability,
    object: Arc<ToFit>,
    entries: Vec<&'a RestraintEntry>,
}

impl Budget {
    /// The plan for the objects of an assessment.
    pub fn plan(&self, priced: Priced, progress: Progress) -> BudgetPlan {
        self.chosen(priced, progress).0
    }

    /// What every measure does to every object of an assessment, and what it costs. If `asks_losses`, objects that stand in the
    /// earthquakes of the study are followed in stronger ones as well.
    ///
    /// # Errors
    /// A part of the assessment that cannot be read, a motion that cannot be generated, or a stop.
    pub fn priced<'a>(
        &self,
        study: &Study,
        worlds: Worlds,
        rows: impl Iterator<Item = Result<Row<'a>, Problem>>,
        asks_losses: bool,
        progress: Progress,
    ) -> Result<Priced, Problems> {
        let mut candidates: Vec<Candidate> = Vec::new();
        let mut others: Vec<&Item> = Vec::new();
        for row in rows {
            let row = row?;
            match self.candidate(&row, study) {
                Some(candidate) => candidates.push(candidate),
                None if asks_losses && row.item.anchored != Some(true) => others.push(row.item),
                None => {}
            }
        }
        let (hazard, extends) = rates::rates_of(study).unzip();
        let extends = extends.unwrap_or(false);
        let measures = |entries: &[&RestraintEntry]| {
            entries.iter().filter_map(|entry| measure(entry)).collect()
        };
        let wanted: Vec<Wanted> = candidates
            .iter()
            .map(|one| Wanted {
                item: one.item,
                measures: measures(&one.entries),
            })
            .chain(others.into_iter().map(|item| Wanted {
                item,
                measures: Vec::new(),
            }))
            .collect();
        let effects = restrained(study, worlds, &wanted, hazard.is_some(), progress)?;
        let years = present_value_factor_years(self.discount_ratio, self.horizon_years).map_err(
            |error| Problem::value(error.to_string(), "correct `horizon_years` or `discount`"),
        )?;
        let losses = hazard
            .as_ref()
            .filter(|_| asks_losses)
            .and_then(|hazard| self.losses(&wanted, &effects, hazard));
        let mut rows = Vec::new();
        for (object, (candidate, effects)) in candidates.iter().zip(effects).enumerate() {
            let mut of_measures = effects.iter().flat_map(|one| &one.measures);
            for entry in &candidate.entries {
                let found = measure(entry).and_then(|_| of_measures.next());
                let free = effects.as_ref().zip(hazard.as_ref());
                rows.push((object, self.row(candidate, entry, found, free, years)));
            }
        }
        Ok(Priced {
            rows,
            objects: candidates
                .iter()
                .map(|one| Asked {
                    quantity: one.item.quantity,
                    decision: one.decision,
                    rating: LifeSafety::of(one.item).rating,
                })
                .collect(),
            has_rates: hazard.is_some(),
            extends,
            has_costs: self.has_costs,
            losses,
        })
    }

    /// `None`: nothing needs to be done, or nothing is known of it.
    fn candidate<'a>(&'a self, row: &Row<'a>, study: &Study) -> Option<Candidate<'a>> {
        let before = row.found.p_overturn?;
        let is_asked = before.value > 0.0
            || !matches!(row.found.decision, Decision::Leave | Decision::NoVerdict);
        if !is_asked || row.item.anchored == Some(true) {
            return None;
        }
        let uses = uses::uses(row.item);
        let suits = |entry: &&RestraintEntry| {
            let is_for = |what: &HoldsWhat| entry.holds.contains(what);
            let rolls = row.item.surroundings.casters == Some(Casters::Free);
            uses.iter().any(is_for)
                && (entry.hold != Hold::Lock || rolls)
                && per_unit(entry, &self.currency).is_some()
        };
        Some(Candidate {
            item: row.item,
            decision: row.found.decision,
            before,
            object: Arc::new(fitting::to_fit(row, study, self.units)),
            entries: self.library.entries().iter().filter(suits).collect(),
        })
    }

    fn row(
        &self,
        candidate: &Candidate,
        entry: &RestraintEntry,
        found: Option<&Result<Effect, NotCalculated>>,
        free: Option<(&Restrained, &Hazard)>,
        years: f64,
    ) -> PlanRow {
        let item = candidate.item;
        let effect = found.and_then(|found| found.as_ref().ok()).cloned();
        let rated = effect
            .as_ref()
            .zip(free)
            .and_then(|(effect, (free, hazard))| {
                let before = rate(&free.free, hazard)?;
                let after = rate(&effect.levels, hazard)?;
                Some(([before.0, after.0], before.1))
            });
        let rates = rated.map(|(rates, _)| rates);
        let cost = self.costs.get(&item.id).filter(|cost| cost.has_costs());
        let losses = rates.zip(cost).map(|(rates, cost)| {
            rates.map(|rate| f64::from(item.quantity) * rate * cost.overturned())
        });
        let converted = per_unit(entry, &self.currency).unwrap_or(1.0);
        let standing = match (found, entry.hold) {
            (Some(Err(why)), _) => NotPlanned::of(*why),
            (_, Hold::Slack) => NotPlanned::Slack,
            (_, Hold::Contents) => NotPlanned::HoldsContents,
            (_, Hold::Pad) => NotPlanned::Pad,
            (None, _) => NotPlanned::NoMedian,
            (Some(Ok(_)), _) => NotPlanned::AvoidsNoFalls,
        };
        let place = [&item.building, &item.floor, &item.room, &item.location];
        let place: Vec<&str> = place
            .into_iter()
            .map(String::as_str)
            .filter(|text| !text.is_empty())
            .collect();
        PlanRow {
            id: item.id.clone(),
            item: item.item.clone(),
            place: place.join(", "),
            quantity: item.quantity,
            measure: entry.id.clone(),
            measure_item: entry.item.clone(),
            kind: entry.kind,
            standing: Standing::Out(standing),
            cost: entry
                .cost()
                .map(|cost| f64::from(item.quantity) * converted * cost),
            currency: self.currency.clone(),
            capacity_n: entry.capacity_n,
            beta: entry.beta,
            beta_is_assumed: entry.beta_is_assumed,
            capacity_confidence: entry.capacity_confidence,
            price_confidence: entry.price_confidence,
            decision: candidate.decision,
            before: candidate.before,
            effect,
            rates,
            is_at_least: rated.is_some_and(|(_, is_at_least)| is_at_least),
            losses,
            benefit: losses.map(|[before, after]| years * (before - after)),
            life_safety: LifeSafety::of(item),
            object: Arc::clone(&candidate.object),
            fitting: fitting::fitting(entry, converted),
        }
    }

    /// Chooses among all measures: [`crate::plan`]. Also the number of the object of each row.
    fn chosen(&self, priced: Priced, progress: Progress) -> (BudgetPlan, Vec<usize>) {
        let Priced {
            mut rows,
            objects,
            has_rates,
            extends,
            has_costs,
            losses: _,
        } = priced;
        let worths: Vec<Worth> = rows
            .iter()
            .filter(|(_, row)| row.effect.is_some())
            .map(|(object, row)| {
                let losses = row.losses.map(|[_, after]| after).unwrap_or(0.0);
                Worth {
                    id: row.id.clone(),
                    option: row.measure.clone(),
                    object: *object,
                    cost: row.cost[1],
                    cost_present_value: row.cost[1],
                    benefit_present_value: row.benefit,
                    estimate: row.benefit.unwrap_or(0.0),
                    is_at_least: row.is_at_least,
                    after: LossBounds {
                        least: losses,
                        best: losses,
                        most: Some(losses),
                    },
                    life_safety: row.life_safety.rating,
                    falls: row.falls_avoided(),
                    counts_falls: !has_rates,
                }
            })
            .collect();
        let spent = spent_within(&worths, objects.len(), self.amount, progress);
        let chosen: HashMap<usize, &str> = spent
            .chosen
            .iter()
            .flatten()
            .map(|worth| (worth.object, worth.option.as_str()))
            .collect();
        let unfunded: Vec<usize> = spent.unfunded.iter().map(|worth| worth.object).collect();
        for (object, row) in &mut rows {
            let avoids = row.effect.is_some() && row.falls_avoided() > Some(0.0);
            let for_people = is_for_people(row.life_safety.rating, row.falls_avoided());
            row.standing = match (chosen.get(object), row.standing) {
                (Some(measure), _) if *measure == row.measure => {
                    Standing::In(match (for_people, row.benefit) {
                        (true, _) => Planned::LifeSafety,
                        (false, Some(_)) => Planned::Pays,
                        (false, None) => Planned::AvoidsFalls,
                    })
                }
                (_, before) if !avoids => before,
                (Some(_), _) => Standing::Out(NotPlanned::AnotherMeasure),
                (None, _) if unfunded.contains(object) => Standing::Out(NotPlanned::Unfunded),
                (None, _) => Standing::Out(match row.benefit {
                    Some(benefit) if benefit <= row.cost[1] => NotPlanned::DoesNotPay,
                    None if has_rates => NotPlanned::NothingToSave,
                    _ => NotPlanned::Unfunded,
                }),
            };
        }
        let unfunded = Unfunded {
            // Objects are counted one by one, not as rows.
            objects: unfunded
                .iter()
                .filter_map(|object| objects.get(*object))
                .map(|asked| asked.quantity)
                .sum(),
            // An empty sum is −0.
            cost: spent
                .unfunded
                .iter()
                .fold(0.0, |sum, worth| sum + worth.cost),
        };
        let (mut without_measure, mut not_restrained, mut without_option) = (0, 0, 0);
        for (object, asked) in objects.iter().enumerate() {
            let mut own = rows.iter().filter(|(place, _)| *place == object).peekable();
            if asked.decision == Decision::Restrain && !chosen.contains_key(&object) {
                not_restrained += asked.quantity;
                if own.peek().is_none() {
                    without_option += asked.quantity;
                }
            }
            let helps = |row: &PlanRow| {
                row.effect.is_some() && row.standing != Standing::Out(NotPlanned::AvoidsNoFalls)
            };
            let is_rated = asked.rating > Some(Rating::Low) && asked.decision != Decision::Leave;
            if is_rated && !own.any(|(_, row)| helps(row)) {
                without_measure += asked.quantity;
            }
        }
        let cost = rows
            .iter()
            .filter(|(_, row)| row.is_planned())
            .map(|(_, row)| row.cost[1])
            // An empty sum is −0.
            .fold(0.0, |sum, cost| sum + cost);
        // Stable: the measures of an object stay together.
        let ratio = |row: &PlanRow| {
            row.benefit
                .map_or(0.0, |benefit| benefit / row.cost[1].max(f64::MIN_POSITIVE))
        };
        // A low rating is no question of life safety.
        let rating = |row: &PlanRow| row.life_safety.rating.filter(|one| *one > Rating::Low);
        rows.sort_by(|(_, a), (_, b)| {
            b.is_planned()
                .cmp(&a.is_planned())
                .then(match a.is_planned() {
                    true => rating(b)
                        .cmp(&rating(a))
                        // What pays beside what must be done comes after it: both are within the budget.
                        .then(a.decision.cmp(&b.decision))
                        .then(ratio(b).total_cmp(&ratio(a))),
                    false => std::cmp::Ordering::Equal,
                })
        });
        let converted = self
            .library
            .entries()
            .iter()
            .filter_map(|entry| per_unit(entry, &self.currency))
            .find(|rate| *rate != 1.0);
        let (numbers, rows) = rows.into_iter().unzip();
        let plan = BudgetPlan {
            amount: self.amount,
            currency: self.currency.clone(),
            cost,
            horizon_years: self.horizon_years,
            discount_ratio: self.discount_ratio,
            is_horizon_assumed: self.is_horizon_assumed,
            has_rates,
            extends,
            has_costs,
            converted,
            unfunded,
            without_measure,
            not_restrained,
            without_option,
            is_optimal: spent.is_optimal(),
            rows,
        };
        (plan, numbers)
    }
}

impl NotPlanned {
    fn of(why: NotCalculated) -> Self {
        match why {
            NotCalculated::NoMass => Self::NoMass,
            NotCalculated::DoesNotRoll => Self::AvoidsNoFalls,
            NotCalculated::NotInAPlane => Self::NotInAPlane,
            NotCalculated::Stacked => Self::Stacked,
        }
    }
}

/// What a restraint does to an object, as it is calculated; `None`: nothing is.
fn measure(entry: &RestraintEntry) -> Option<Measure> {
    let period_s = match entry.hold {
        Hold::Lock => return Some(Measure::Locked),
        Hold::Slack | Hold::Pad | Hold::Contents => return None,
        Hold::Rigid => None,
        Hold::Flexible(period_s) => Some(period_s),
    };
    let at = match entry.kind {
        RestraintKind::BasePlate => GripAt::Base,
        _ => GripAt::Height(entry.height_ratio),
    };
    Some(Measure::Held(Grip {
        period_s,
        at,
        median_n: entry.capacity_n?,
        beta: entry.beta,
    }))
}

/// Falls a year from their probabilities at several intensities, and whether there may be more.
fn rate(levels: &[Level], hazard: &Hazard) -> Option<(f64, bool)> {
    let found = annual_rate(levels, |ratio| hazard.annual_rate(ratio)).ok()?;
    Some((found.rate_per_year, found.is_at_least))
}

#[cfg(test)]
mod tests;
