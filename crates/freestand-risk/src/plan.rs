//! What options are worth, and the best of them within a budget: life safety first.

use std::collections::HashMap;
use std::time::{Duration, Instant};

use freestand::risk::{Choice, best_plan, present_value_factor_years, renewed_cost};
use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::shorten;
use freestand_output::{answer, answer_of};
use freestand_study::run::Progress;

use super::costs::OptionRow;
use super::objects::{Avoided, LossBounds, ObjectRisk, avoided};
use super::request::RiskRequest;
use crate::doubts::{OpenOptions, RiskDoubt};
use crate::fragility::MeasuredHazard;
use crate::fragility::go_on;
use freestand_inventory::{Rating, currency_code};

/// Budgets of the frontier.
const FRONTIER: u32 = 20;
/// How long a plan is searched, and all of the frontier together.
const PLAN_TIME: Duration = Duration::from_secs(10);

/// What one option is worth.
#[derive(Debug, Clone, PartialEq)]
pub struct Worth {
    /// Identifier of the object.
    pub id: String,
    /// Name of the option.
    pub option: String,
    pub(crate) object: usize,
    /// What it costs.
    pub cost: f64,
    /// With renewals.
    pub(crate) cost_present_value: f64,
    /// The least that it can be; `None` where nothing bounds the rates with the option.
    pub benefit_present_value: Option<f64>,
    /// By the stated losses, of which the least that the benefit can be may be far below.
    pub(crate) estimate: f64,
    /// Whether the benefit may be larger.
    pub is_at_least: bool,
    /// Annual loss that the option leaves.
    pub after: LossBounds,
    /// What a fall of the object means for people.
    pub life_safety: Option<Rating>,
    /// The least number of falls a year that the option avoids; `None` where nothing bounds it.
    pub(crate) falls: Option<f64>,
    /// Whether falls count where no benefit is known: no yearly rate is, and these are falls in one earthquake.
    pub(crate) counts_falls: bool,
}

impl Worth {
    /// `None` for what costs nothing, or has no known benefit.
    pub fn ratio(&self) -> Option<f64> {
        self.benefit_present_value
            .filter(|_| self.cost_present_value > 0.0)
            .map(|benefit| benefit / self.cost_present_value)
    }

    fn net(&self) -> Option<f64> {
        Some(self.benefit_present_value? - self.cost_present_value)
    }

    /// For what it is bought where people do not need it.
    fn gain(&self) -> Option<f64> {
        self.net()
            .or_else(|| self.falls.filter(|_| self.counts_falls))
    }

    /// By what options are ranked: their ratio. What costs nothing comes first if it is worth anything,
    /// and what has no known benefit last.
    fn rank(&self) -> f64 {
        match (self.ratio(), self.net()) {
            (_, None) => f64::NEG_INFINITY,
            (Some(ratio), _) => ratio,
            (None, Some(net)) => {
                if net > 0.0 {
                    f64::INFINITY
                } else {
                    0.0
                }
            }
        }
    }
}

answer_of!(Worth as worth {
    id: String = worth.id.clone();
    option: String = worth.option.clone();
    cost: f64 = worth.cost;
    cost_present_value: f64 = worth.cost_present_value;
    benefit_present_value: Option<f64> = worth.benefit_present_value;
    benefit_present_value_estimate: Option<f64> = worth.benefit_present_value.map(|_| worth.estimate);
    benefit_cost_ratio: Option<f64> = worth.ratio();
    net_present_value: Option<f64> = worth.net();
    /// Whether the benefit may be larger.
    is_at_least: bool = worth.is_at_least;
    /// What a fall of the object means for people.
    life_safety: Option<&'static str> = worth.life_safety.map(Rating::name);
    falls_avoided_per_year: Option<f64> = worth.falls;
});

/// All options, by their ratio of benefit to cost, and the plan within the budget.
#[derive(Debug, Clone, PartialEq)]
pub struct Measures {
    ranking: Vec<Worth>,
    /// The plan within a budget.
    pub plan: Option<Chosen>,
    /// Over which options pay \[years\].
    pub horizon_years: f64,
    /// Discount rate per year.
    pub discount_ratio: f64,
    /// Present value of 1 per year over the horizon \[years\].
    pub years: f64,
}

/// The plan within a budget.
#[derive(Debug, Clone, PartialEq)]
pub struct Chosen {
    /// The budget.
    pub budget: f64,
    /// What the plan costs and what it is worth.
    pub plan: Totals,
    /// Sorted: life safety first, then by benefit over cost.
    pub chosen: Vec<Worth>,
    /// For each object that people need and the budget does not reach, the option that avoids most falls.
    pub unfunded: Vec<Worth>,
    /// The best plans within parts of the budget.
    pub frontier: Vec<Within>,
}

answer_of!(Chosen as chosen {
    budget: f64 = chosen.budget;
    cost: f64 = chosen.plan.cost;
    net_present_value: f64 = chosen.plan.value;
    is_at_least: bool = chosen.is_at_least();
    /// Life safety first, then by benefit over cost.
    chosen: Vec<&Worth> = chosen.chosen.iter().collect();
    /// What people need and the budget does not reach.
    unfunded_life_safety: Vec<&Worth> = chosen.unfunded.iter().collect();
    // An empty sum is −0.
    unfunded_life_safety_cost: f64 = chosen.unfunded.iter().fold(0.0, |sum, worth| sum + worth.cost);
    method: &'static str = "dynamic programming with bounds";
    /// No plan is worth more.
    bound: f64 = chosen.plan.bound;
    optimal: bool = chosen.plan.is_optimal;
    /// The best plans within smaller and larger budgets.
    frontier: Vec<Within> = chosen.frontier.clone();
});

answer! {
    /// The best plan within a budget.
    pub struct Within {
        /// The budget.
        budget: f64,
        /// What the plan costs.
        cost: f64,
        /// What it is worth, less its cost.
        net_present_value: f64,
    }
}

/// What every option is worth, and the plan within the budget.
pub(crate) fn measures(
    request: &RiskRequest,
    options: &[OptionRow],
    objects: &[ObjectRisk],
    hazard: &MeasuredHazard,
    currency: Option<&str>,
    progress: Progress,
) -> Result<Measures, Problems> {
    let (Some(horizon), Some(discount)) = (request.horizon_years, request.discount_ratio) else {
        let message =
            "options pay off over years, but the horizon or the discount rate is not given";
        let hint = "give `horizon_years = \"40 yr\"` and `discount = \"3 %\"`";
        return Err(Problem::value(message, hint)
            .of(&["horizon_years", "discount"])
            .into());
    };
    let Some(currency) = currency else {
        let hint = "give an inventory with replacement_cost [AUD], or other costs";
        return Err(Problem::value(
            "the benefit of an option cannot be calculated without the cost of failures",
            hint,
        )
        .of(&["inventory"])
        .into());
    };
    if let Some((_, other)) = request
        .budget
        .as_ref()
        .filter(|(_, other)| !currency_code(other).eq_ignore_ascii_case(currency_code(currency)))
    {
        let message = format!(
            "the budget is in {}, and the costs are in {currency}",
            shorten(other)
        );
        return Err(
            Problem::value(message, format!("give the budget in {currency}"))
                .of(&["budget"])
                .into(),
        );
    }
    let years = present_value_factor_years(discount, horizon).map_err(|error| {
        Problem::value(error.to_string(), "correct `horizon_years` or `discount`")
    })?;
    let places: HashMap<&str, usize> = objects
        .iter()
        .enumerate()
        .map(|(i, object)| (object.id.as_str(), i))
        .collect();
    let mut ranking = Vec::new();
    let mut problems = Problems::default();
    for option in options {
        let named = format!(
            "the option \"{}\" is for {}",
            shorten(&option.option),
            shorten(&option.id)
        );
        let wrong = |message: String, hint: &str| {
            let problem = Problem::value(message, hint);
            let problem = request
                .options
                .iter()
                .fold(problem, |problem, path| problem.in_file(path));
            problem.at_line(option.line)
        };
        let Some((place, object)) = places
            .get(option.id.as_str())
            .and_then(|&place| Some((place, objects.get(place)?)))
        else {
            let hint = "correct the id, leave out the row, or add the curves of the object";
            problems.push(wrong(format!("{named}, which has no fragility"), hint));
            continue;
        };
        let Some(cost) = object
            .cost
            .as_ref()
            .filter(|_| object.expected_annual_loss.is_some())
        else {
            let hint = "give the costs of its failures in the inventory, or leave out the row";
            problems.push(wrong(format!("{named}, which has no costs"), hint));
            continue;
        };
        let renewed = renewed_cost(option.cost, option.life_years, discount, horizon)
            .map_err(|error| wrong(error.to_string(), "correct the life, or the horizon"));
        let Some(cost_present_value) = problems.keep(renewed) else {
            continue;
        };
        let Avoided {
            after,
            least,
            best,
            is_at_least,
            falls,
        } = avoided(&object.curves, &option.effect, cost, &hazard.hazard);
        ranking.push(Worth {
            id: option.id.clone(),
            option: option.option.clone(),
            object: place,
            cost: option.cost,
            cost_present_value,
            benefit_present_value: least.map(|least| years * least),
            estimate: years * best,
            is_at_least,
            after,
            life_safety: cost.life_safety,
            falls: falls.map(|falls| falls.max(0.0)),
            counts_falls: false,
        });
    }
    let mut ranking = problems.finish(Some(ranking))?;
    // Stable, so that equal ratios stay in the order of the file.
    ranking.sort_by(|a, b| b.rank().total_cmp(&a.rank()));
    let plan = request
        .budget
        .as_ref()
        .map(|(budget, _)| chosen(&ranking, objects.len(), *budget, progress));
    go_on(progress)?;
    Ok(Measures {
        ranking,
        plan,
        horizon_years: horizon,
        discount_ratio: discount,
        years,
    })
}

/// Whether a search that begins now may go on.
fn within(time: Duration, progress: Progress) -> impl FnMut() -> bool {
    let start = Instant::now();
    move || start.elapsed() < time && go_on(progress).is_ok()
}

/// Falls a year below which an option is not bought for the sake of people: a chance of one in a million a
/// year, which the Health and Safety Executive calls broadly acceptable.
///
/// # Reference
/// HSE (2001). Reducing risks, protecting people, paragraph 130.
const FEWEST_FALLS: f64 = 1e-6;

/// What a plan costs and what it is worth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Totals {
    /// What it costs.
    pub cost: f64,
    /// Its net present value.
    pub value: f64,
    /// The most that any plan within the budget can be worth.
    bound: f64,
    /// Whether no plan is worth more.
    pub is_optimal: bool,
}

/// The options of a budget: those that avoid most falls of objects rated high for life safety, with what is
/// left those of objects rated medium, and with what is left then those that are worth most.
pub(crate) struct Spent<'a> {
    plan: Totals,
    /// For each object.
    pub(crate) chosen: Vec<Option<&'a Worth>>,
    /// For each object that people need and the budget does not reach, what avoids most falls.
    pub(crate) unfunded: Vec<&'a Worth>,
}

impl Spent<'_> {
    /// Whether no plan is worth more.
    pub(crate) fn is_optimal(&self) -> bool {
        self.plan.is_optimal
    }
}

/// Whether something is bought for the sake of people.
pub(crate) fn is_for_people(life_safety: Option<Rating>, falls: Option<f64>) -> bool {
    life_safety > Some(Rating::Low) && falls > Some(FEWEST_FALLS)
}

/// What a budget is spent on, found within the time of a plan.
pub(crate) fn spent_within<'a>(
    ranking: &'a [Worth],
    objects: usize,
    budget: f64,
    progress: Progress,
) -> Spent<'a> {
    spent(ranking, objects, budget, &mut within(PLAN_TIME, progress))
}

fn spent<'a>(
    ranking: &'a [Worth],
    objects: usize,
    budget: f64,
    go_on: &mut dyn FnMut() -> bool,
) -> Spent<'a> {
    let mut chosen: Vec<Option<&Worth>> = vec![None; objects];
    let mut unfunded = Vec::new();
    let (mut left, mut is_optimal) = (budget, true);
    for rating in [Rating::High, Rating::Medium] {
        let saves = |worth: &&Worth| {
            worth.life_safety == Some(rating) && is_for_people(worth.life_safety, worth.falls)
        };
        let worths = of_objects(ranking, objects, saves);
        let choices = worths
            .iter()
            .map(|worths| undominated(worths))
            .collect::<Vec<_>>();
        let priced: Vec<Vec<Choice>> = choices
            .iter()
            .map(|worths| {
                worths
                    .iter()
                    .map(|worth| Choice {
                        cost: worth.cost,
                        value: worth.falls.unwrap_or(0.0),
                    })
                    .collect()
            })
            .collect();
        let plan = best_plan(&priced, left, &mut *go_on);
        for ((object, worths), number) in choices.iter().enumerate().zip(&plan.chosen) {
            match (number.and_then(|number| worths.get(number)), worths.last()) {
                (Some(worth), _) => chosen[object] = Some(worth),
                (None, Some(most)) => unfunded.push(*most),
                (None, None) => {}
            }
        }
        left -= plan.cost;
        is_optimal &= plan.is_optimal;
    }
    // What has no known worth is not bought.
    let is_open = |worth: &&Worth| chosen[worth.object].is_none() && worth.gain().is_some();
    let worths = of_objects(ranking, objects, is_open);
    let choice = |worth: &&Worth| Choice {
        cost: worth.cost,
        value: worth.gain().unwrap_or(0.0),
    };
    let priced: Vec<Vec<Choice>> = worths
        .iter()
        .map(|worths| worths.iter().map(choice).collect())
        .collect();
    let first: (f64, f64) = chosen
        .iter()
        .flatten()
        .fold((0.0, 0.0), |(cost, value), worth| {
            (cost + worth.cost, value + worth.net().unwrap_or(0.0))
        });
    let money = best_plan(&priced, left, &mut *go_on);
    for ((known, worths), number) in chosen.iter_mut().zip(&worths).zip(&money.chosen) {
        *known = known.or_else(|| worths.get((*number)?).copied());
    }
    unfunded.retain(|worth| chosen[worth.object].is_none());
    let plan = Totals {
        cost: first.0 + money.cost,
        value: first.1 + money.value,
        bound: first.1 + money.bound,
        is_optimal: is_optimal && money.is_optimal,
    };
    Spent {
        plan,
        chosen,
        unfunded,
    }
}

/// For each object those of its options that are wanted.
fn of_objects<'a>(
    ranking: &'a [Worth],
    objects: usize,
    is_wanted: impl Fn(&&'a Worth) -> bool,
) -> Vec<Vec<&'a Worth>> {
    let mut found: Vec<Vec<&Worth>> = vec![Vec::new(); objects];
    for worth in ranking.iter().filter(is_wanted) {
        found[worth.object].push(worth);
    }
    found
}

/// Those that avoid more falls than every cheaper one, by rising cost.
fn undominated<'a>(worths: &[&'a Worth]) -> Vec<&'a Worth> {
    let mut sorted = worths.to_vec();
    let falls = |worth: &Worth| worth.falls.unwrap_or(0.0);
    sorted.sort_by(|a, b| {
        a.cost
            .total_cmp(&b.cost)
            .then(falls(b).total_cmp(&falls(a)))
    });
    let mut most = 0.0;
    sorted.retain(|worth| {
        let is_more = falls(worth) > most;
        most = falls(worth).max(most);
        is_more
    });
    sorted
}

fn chosen(ranking: &[Worth], objects: usize, budget: f64, progress: Progress) -> Chosen {
    let Spent {
        plan,
        chosen,
        unfunded,
    } = spent(ranking, objects, budget, &mut within(PLAN_TIME, progress));
    let mut chosen: Vec<Worth> = chosen.into_iter().flatten().cloned().collect();
    // Both sorts are stable: equal ones stay in the order of the objects.
    let ratio = |worth: &Worth| worth.ratio().unwrap_or(f64::INFINITY);
    chosen.sort_by(|a, b| {
        b.life_safety
            .cmp(&a.life_safety)
            .then(ratio(b).total_cmp(&ratio(a)))
    });
    let unfunded = unfunded.into_iter().cloned().collect();
    let frontier = (1..=FRONTIER).map(|i| {
        let part = budget * f64::from(i) / f64::from(FRONTIER);
        let plan = spent(
            ranking,
            objects,
            part,
            &mut within(PLAN_TIME / FRONTIER, progress),
        )
        .plan;
        Within {
            budget: part,
            cost: plan.cost,
            net_present_value: plan.value,
        }
    });
    let frontier = frontier.collect();
    Chosen {
        budget,
        plan,
        chosen,
        unfunded,
        frontier,
    }
}

impl Chosen {
    /// Whether the plan may be worth more.
    pub fn is_at_least(&self) -> bool {
        self.chosen.iter().any(|worth| worth.is_at_least)
    }

    /// The option of the plan for an object.
    pub fn of(&self, id: &str) -> Option<&Worth> {
        self.chosen.iter().find(|worth| worth.id == id)
    }
}

impl Measures {
    /// The options whose benefit may be larger than stated, so that another plan may be the best.
    pub fn is_at_least(&self) -> bool {
        self.ranking.iter().any(|worth| worth.is_at_least)
    }

    /// The options without a known benefit.
    pub fn unknown(&self) -> Vec<&Worth> {
        self.ranking
            .iter()
            .filter(|worth| worth.benefit_present_value.is_none())
            .collect()
    }

    /// The options of which something is not known.
    pub(crate) fn doubts(&self) -> Vec<RiskDoubt> {
        let is_life =
            |worth: &&Worth| worth.life_safety > Some(Rating::Low) && worth.falls.is_none();
        let lives: Vec<&Worth> = self.ranking.iter().filter(is_life).collect();
        let open = |unknown: &[&Worth]| {
            let (first, rest) = unknown.split_first()?;
            Some(OpenOptions {
                option: first.option.clone(),
                id: first.id.clone(),
                more: rest.len(),
            })
        };
        let worth = open(&self.unknown()).map(RiskDoubt::UnknownWorth);
        let falls = open(&lives).map(RiskDoubt::UnknownFalls);
        worth.into_iter().chain(falls).collect()
    }

    /// The options, the one that pays most first.
    pub fn ranking(&self) -> Vec<&Worth> {
        self.ranking.iter().collect()
    }
}
