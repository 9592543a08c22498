//! The plan within a budget: its sentences, its tables on the console and in the report, its sheet and `plan.csv`.

use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;
use freestand_input::words::{counted, number, percent_significant};
use freestand_inventory::Rating;
use freestand_inventory::library::{ASSUMED_BETA, Confidence};
use freestand_output::answer::table_of;
use freestand_output::folder::OutputFolder;
use freestand_output::html::{Cell, figure, list, table, words};
use freestand_risk::budget::{
    BudgetPlan, LifeSafety, NotPlanned, PlanRow, Planned, Standing, Unfunded,
};

use maud::{Markup, html};

use super::sheet_cell::SheetCell;
use super::words::{amount, label, long, probability};
use crate::table::table as text_table;

/// The file of the plan.
pub const PLAN_NAME: &str = "plan.csv";

/// The file of everything that the plan was chosen from.
pub const ALTERNATIVES_NAME: &str = "plan_alternatives.csv";

/// Rows of options that are not planned, in the report.
const MOST_ROWS: usize = 300;

/// Writes `plan.csv` and `plan_alternatives.csv`.
///
/// # Errors
/// A full disk.
pub(super) fn write_plan(folder: &OutputFolder, plan: &BudgetPlan) -> Result<(), Problem> {
    folder.write(PLAN_NAME, table_of(plan.planned())?.as_ref())?;
    folder.write(ALTERNATIVES_NAME, table_of(&plan.rows)?.as_ref())
}

/// Whether an option is planned, in words.
pub(super) fn standing_words(standing: Standing) -> &'static str {
    match standing {
        Standing::In(Planned::LifeSafety) => "planned: life safety",
        Standing::In(Planned::Pays) => "planned: it pays",
        Standing::In(Planned::AvoidsFalls) => "planned: it avoids falls",
        Standing::Out(why) => match why {
            NotPlanned::AnotherMeasure => "another option is planned",
            NotPlanned::Unfunded => "the budget does not reach it",
            NotPlanned::DoesNotPay => "does not pay",
            NotPlanned::NothingToSave => "the list has no cost of its fall",
            NotPlanned::AvoidsNoFalls => "avoids no falls",
            NotPlanned::NoMedian => "not calculated: the capacity of the restraint is not known",
            NotPlanned::Slack => "not calculated: its slack ends in an impact",
            NotPlanned::HoldsContents => "not calculated: it holds what is on the object",
            NotPlanned::Pad => "not calculated: a pad softens landings and holds nothing",
            NotPlanned::NoMass => "not calculated: the mass of the object is not known",
            NotPlanned::Stacked => {
                "not calculated: something stands on the object, which is not held"
            }
            NotPlanned::NotInAPlane => {
                "not calculated: a flexible hold, and the object does not move in a plane"
            }
        },
    }
}

/// Objects whose fall may hurt somebody and which the budget does not reach; `None`: it reaches all of them.
pub(super) fn unfunded(plan: &BudgetPlan) -> Option<String> {
    let Unfunded { objects, cost } = plan.unfunded;
    (objects > 0).then(|| {
        format!(
            "Unfunded life safety: {}, {} {}.",
            counted(objects as usize, "object"),
            amount(cost),
            plan.currency
        )
    })
}

/// What is said before the tables.
pub(super) fn sentences(plan: &BudgetPlan) -> Vec<String> {
    let BudgetPlan { currency, .. } = plan;
    let mut said: Vec<String> = unfunded(plan).into_iter().collect();
    if plan.without_measure > 0 {
        let objects = counted(plan.without_measure as usize, "object");
        said.push(format!(
            "Life safety without a calculated option that avoids falls: {objects}. Restrain all the same, for the force in the work list."
        ));
    }
    let planned = plan.planned().map(|row| row.quantity as usize).sum();
    let optimal = match plan.is_optimal {
        true => "",
        false => " It is the best that was found in the time allowed.",
    };
    said.push(format!(
        "The plan restrains {} for {} {currency}; the budget is {} {currency}. Life safety comes first: the plan avoids as \
         many expected falls as it can, of objects rated high, then of those rated medium; what is left goes to {}.{optimal}",
        counted(planned, "object"),
        amount(plan.cost),
        amount(plan.amount),
        match plan.has_rates {
            true => "what saves most money beyond its cost",
            false => "what avoids most falls",
        }
    ));
    let left = [
        (Planned::LifeSafety, "a fall may hurt somebody"),
        (Planned::Pays, "the restraint saves more than it costs"),
        (Planned::AvoidsFalls, "the restraint avoids falls"),
    ];
    for (why, because) in left {
        let objects = plan.left_and_planned(why);
        if objects > 0 {
            said.push(format!(
                "Planned although the verdict is leave: {}, because {because}.",
                counted(objects as usize, "object")
            ));
        }
    }
    if plan.not_restrained > 0 {
        said.push(format!(
            "Not planned although the verdict is restrain: {}. {ALTERNATIVES_NAME} says why of each option.",
            counted(plan.not_restrained as usize, "object")
        ));
    }
    if plan.without_option > 0 {
        said.push(format!(
            "For {} of these no restraint suits that has a price in {currency}: state your own (`restraints`).",
            plan.without_option
        ));
    }
    said
}

/// What was assumed.
pub(super) fn assumptions(plan: &BudgetPlan) -> Vec<String> {
    let mut said = Vec::new();
    said.push(match (plan.has_rates, plan.has_costs) {
        (false, _) => "No annual rates are known for this place: its code has one return period, or none. The plan counts \
                       falls in the earthquake of the study."
            .to_owned(),
        (true, false) => "The list has no costs of falls, such as a replacement cost: beyond life safety nothing is planned."
            .to_owned(),
        (true, true) => format!(
            "Savings count over {} years at a discount rate of {} a year{}. Only falls are counted, by the return periods \
             of the code; replacement, downtime and casualties cost what the list says.",
            number(plan.horizon_years, 3),
            percent_significant(plan.discount_ratio, 2),
            match plan.is_horizon_assumed {
                true => " (assumed where not stated)",
                false => "",
            }
        ),
    });
    if plan.extends {
        said.push(
            "Below the shortest return period of the code, the slope of its hazard between the two shortest goes on."
                .to_owned(),
        );
    }
    if plan.rows.iter().any(|row| row.is_at_least) {
        said.push(
            "A loss marked ≥ is a bound: the object may also fall in earthquakes weaker than those that were calculated. \
             So an option that does not pay may pay."
                .to_owned(),
        );
    }
    said.push(format!(
        "A restraint holds until the force on it exceeds its capacity, which is lognormal{}. From that instant the \
         object is free. The upper end of the probability with a restraint is never below the probability that its \
         capacity is exceeded.",
        match plan.rows.iter().any(|row| row.capacity_n.is_some() && row.beta_is_assumed) {
            true => format!("; β = {ASSUMED_BETA} is assumed where no test is known"),
            false => String::new(),
        }
    ));
    let unsure =
        |confidence: Confidence| !matches!(confidence, Confidence::Stated | Confidence::Primary);
    let mut names = |is_one: &dyn Fn(&PlanRow) -> bool, what: &str| {
        let mut ids: Vec<&str> = plan
            .rows
            .iter()
            .filter(|row| is_one(row))
            .map(|row| row.measure.as_str())
            .collect();
        ids.sort_unstable();
        ids.dedup();
        if !ids.is_empty() {
            said.push(format!("{what}: {}.", ids.join(", ")));
        }
    };
    names(
        &|row| row.capacity_confidence.is_some_and(unsure),
        "Capacities that are recalled or assumed, to be confirmed by whoever fixes them",
    );
    names(
        &|row| unsure(row.price_confidence),
        "Prices that are assumed or from a secondary source, to be replaced by offers",
    );
    names(
        &|row| row.fitting.work.is_none(),
        "Restraints whose cost leaves out the work, because their file does not say what it takes",
    );
    if let Some(rate) = plan.converted {
        said.push(format!(
            "Prices of built-in restraints are multiplied by {} {} for one US dollar (assumed, 2025).",
            number(rate, 3),
            plan.currency
        ));
    }
    let mut assumed: Vec<&str> = plan
        .rows
        .iter()
        .filter(|row| row.life_safety.is_assumed)
        .map(|row| row.id.as_str())
        .collect();
    assumed.dedup();
    assumed.sort_unstable();
    assumed.dedup();
    if !assumed.is_empty() {
        said.push(format!(
            "The list does not rate the life safety of {}: gas cylinders, and what somebody lies in, are taken as high.",
            freestand_input::words::some(&assumed, 12)
        ));
    }
    said
}

/// The force that a restraint must withstand over its capacity: `2.1 of 11 kN`.
fn force(row: &PlanRow) -> String {
    let kilonewtons = |value_n: f64| number(value_n / 1e3, 2);
    let force = row.effect.as_ref().and_then(|effect| effect.force_n);
    match (force, row.capacity_n) {
        (Some(force_n), Some(capacity_n)) => {
            format!("{} of {} kN", kilonewtons(force_n), kilonewtons(capacity_n))
        }
        (Some(force_n), None) => format!("{} kN", kilonewtons(force_n)),
        (None, _) => "–".to_owned(),
    }
}

/// The probability with an option: `0.4 % (0.1–2 %)`.
fn after(row: &PlanRow) -> String {
    row.effect
        .as_ref()
        .zip(row.after_high())
        .map_or("–".to_owned(), |(effect, high)| {
            let found = freestand_assess::result::Probability {
                high,
                ..effect.overturn
            };
            probability(found)
        })
}

/// The headings of a table of options, and whether each is of numbers.
const HEADINGS: [(&str, bool); 10] = [
    ("object", false),
    ("item", false),
    ("verdict", false),
    ("life safety", false),
    ("option", false),
    ("cost", true),
    ("force", false),
    ("falls", false),
    ("with it", false),
    ("saves a year", true),
];

fn cells(row: &PlanRow) -> [String; 10] {
    let many = match row.quantity {
        1 => String::new(),
        many => format!(" × {many}"),
    };
    let rating = match row.life_safety {
        LifeSafety { rating: None, .. } => "–".to_owned(),
        LifeSafety {
            rating: Some(rating),
            is_assumed: false,
        } => rating.name().to_owned(),
        LifeSafety {
            rating: Some(rating),
            is_assumed: true,
        } => format!("{} (assumed)", rating.name()),
    };
    [
        shorten(&row.id),
        format!("{}{many}", shorten(&row.item)),
        label(row.decision).to_owned(),
        rating,
        row.measure.clone(),
        amount(row.cost[1]),
        force(row),
        probability(row.before),
        after(row),
        row.losses.map_or("–".to_owned(), |[before, after]| {
            let least = if row.is_at_least { "≥ " } else { "" };
            format!("{least}{}", amount(before - after))
        }),
    ]
}

/// Where the console says what a plan rests on.
pub(super) const WHERE_ASSUMED: &str =
    "Capacities and prices that are recalled or assumed are named in report.html\n";

/// The plan for the console.
pub(super) fn plan_text(plan: &BudgetPlan) -> String {
    text_of(plan, None)
}

/// The same with the site of each option.
pub(super) fn plan_text_of_sites(plan: &BudgetPlan, sites: &[String]) -> String {
    text_of(plan, Some(sites))
}

fn text_of(plan: &BudgetPlan, sites: Option<&[String]>) -> String {
    let mut text = sentences(plan).join("\n") + "\n\n";
    let site = |at: usize| sites.and_then(|sites| sites.get(at)).cloned();
    let rows: Vec<Vec<String>> = plan
        .rows
        .iter()
        .enumerate()
        .filter(|(_, row)| row.is_planned())
        .map(|(at, row)| site(at).into_iter().chain(cells(row)).collect())
        .collect();
    if !rows.is_empty() {
        let own = HEADINGS.iter().map(|(head, _)| with_currency(head, plan));
        let heads: Vec<String> = sites
            .map(|_| "site".to_owned())
            .into_iter()
            .chain(own)
            .collect();
        let heads: Vec<&str> = heads.iter().map(String::as_str).collect();
        text += &text_table(&heads, &rows);
    }
    let count = |why: NotPlanned| {
        plan.rows
            .iter()
            .filter(|row| row.standing == Standing::Out(why))
            .count()
    };
    let unpaid = count(NotPlanned::DoesNotPay);
    if unpaid > 0 {
        text += &format!(
            "{} would not pay: see {ALTERNATIVES_NAME}\n",
            counted(unpaid, "option")
        );
    }
    text
}

fn with_currency(head: &str, plan: &BudgetPlan) -> String {
    match head {
        "cost" | "saves a year" => format!("{head} ({})", plan.currency),
        _ => head.to_owned(),
    }
}

/// The plan for the report, with `orders`, the links to the work orders.
pub(super) fn plan_html(plan: &BudgetPlan, orders: &Markup) -> Markup {
    let cell = |text: String, is_number: bool| {
        if is_number { figure(text) } else { words(text) }
    };
    let headings = |why: &str| -> Vec<Cell> {
        let own = HEADINGS.iter();
        let own = own.map(|(head, is_number)| cell(with_currency(head, plan), *is_number));
        own.chain([words(why)]).collect()
    };
    let row = |row: &PlanRow| -> Vec<Cell> {
        let own = cells(row).into_iter().zip(HEADINGS);
        let own = own.map(|(text, (_, is_number))| cell(text, is_number));
        own.chain([words(standing_words(row.standing))]).collect()
    };
    let rest: Vec<&PlanRow> = plan.rows.iter().filter(|row| !row.is_planned()).collect();
    html! {
        @for said in sentences(plan) { p { (said) } }
        @if plan.planned().next().is_some() { (table("", &headings("why"), plan.planned().map(row))) }
        (orders)
        @if !rest.is_empty() {
            @let alternatives = html! {
                h3 { "Alternatives, and what is not planned" }
                (table("", &headings("why not"), rest.iter().take(MOST_ROWS).map(|one| row(one))))
                @if rest.len() > MOST_ROWS { p { "All of them are in " (ALTERNATIVES_NAME) "." } }
            };
            (long(alternatives, rest.len(), ALTERNATIVES_NAME))
        }
        h3 { "What the plan assumes" }
        (list(assumptions(plan)))
    }
}

/// The options for one object side by side, for its card: what each costs, carries and leaves of its risk.
pub(super) fn options_html(options: &[&PlanRow]) -> Markup {
    let Some(first) = options.first() else {
        return Markup::default();
    };
    let headings = [
        words("Option"),
        words("What it is"),
        figure(format!("Cost ({})", first.currency)),
        words("Force"),
        words("Falls now"),
        words("Falls with it"),
        words("In the plan"),
    ];
    let row = |row: &&PlanRow| {
        [
            words(&row.measure),
            words(&row.measure_item),
            figure(format!("{}–{}", amount(row.cost[0]), amount(row.cost[2]))),
            words(force(row)),
            words(probability(row.before)),
            words(after(row)),
            words(standing_words(row.standing)),
        ]
    };
    table("", &headings, options.iter().map(row))
}

/// The rows of the sheet: headings, then every option, as texts and numbers.
pub(super) fn sheet_rows(plan: &BudgetPlan) -> impl Iterator<Item = Vec<SheetCell>> {
    let number = |value: Option<f64>| SheetCell::Number(value);
    let text = |value: &str| SheetCell::Text(value.to_owned());
    plan.rows.iter().map(move |row| {
        let effect = row.effect.as_ref();
        vec![
            text(&row.id),
            text(&row.item),
            text(&row.place),
            number(Some(f64::from(row.quantity))),
            text(label(row.decision)),
            text(row.life_safety.rating.map_or("", Rating::name)),
            text(&row.measure),
            text(&row.measure_item),
            text(standing_words(row.standing)),
            number(Some(row.cost[1])),
            number(Some(row.cost[0])),
            number(Some(row.cost[2])),
            number(effect.and_then(|effect| effect.force_n)),
            number(row.capacity_n),
            SheetCell::Share(Some(row.before.value)),
            SheetCell::Share(Some(row.before.high)),
            SheetCell::Share(effect.map(|effect| effect.overturn.value)),
            SheetCell::Share(row.after_high()),
            number(row.losses.map(|[before, _]| before)),
            number(row.losses.map(|[_, after]| after)),
            number(row.benefit),
        ]
    })
}

/// The headings of the sheet with the widths of their columns.
pub(super) fn sheet_headings(plan: &BudgetPlan) -> Vec<(String, f64)> {
    let money = |head: &str| (format!("{head} [{}]", plan.currency), 12.0);
    let plain = |head: &str, width: f64| (head.to_owned(), width);
    vec![
        plain("id", 12.0),
        plain("item", 34.0),
        plain("place", 22.0),
        plain("quantity", 9.0),
        plain("verdict", 12.0),
        plain("life safety", 11.0),
        plain("option", 16.0),
        plain("what it is", 40.0),
        plain("status", 40.0),
        money("cost"),
        money("cost, low"),
        money("cost, high"),
        plain("force [N]", 10.0),
        plain("median capacity [N]", 12.0),
        plain("falls", 9.0),
        plain("falls, high", 9.0),
        plain("falls with it", 9.0),
        plain("falls with it, high", 9.0),
        money("annual loss"),
        money("annual loss with it"),
        money("present value saved"),
    ]
}
