//! `report.html`: one page for the owner.

use freestand::fragility::LimitState;
use freestand::risk::probability_in_years;
use freestand_input::quantity::shorten;
use freestand_input::words::{counted, number, percent_significant, some};
use freestand_output::figure::Figure;
use freestand_output::html::{ONE_PAGE_CSS, document, drawing, figure, list, table, words};
use maud::{Markup, html};

use freestand_inventory::Rating;
use freestand_risk::fragility::{At, CurveDoubt, Measure, cautions};

use super::doubts::assumptions;
use super::text::unfunded_words;
use super::words::{self as risk_words, least, once_in, rounded, uncertainty_words, why_not_run};
use crate::fragility::doubts::curve_doubts;
use freestand_risk::RiskReport;
use freestand_risk::costs::{CostRow, NotCounted};
use freestand_risk::objects::{Limit, LossBounds, ObjectRisk, RiskVerdict, Slopes, StateRisk};
use freestand_risk::plan::{Chosen, Measures, Worth};

/// The style of this report, added to that of a one-page report.
const CSS: &str = "\
.boxes { display: flex; flex-wrap: wrap; gap: .8rem; margin: 1.1rem 0; }
.boxes > div { flex: 1 1 13rem; border: 1px solid #bbb; border-top: 4px solid #0072b2; padding: .45rem .8rem .6rem; }
.boxes strong { display: block; font-size: 1.35rem; line-height: 1.35; }
.boxes small { display: block; font-size: .88rem; line-height: 1.35; color: #444; }
thead th, thead th.n { white-space: normal; }
tbody th { white-space: nowrap; }
figure { margin: .8rem 0; }
@media print {
  h1 { font-size: 16pt; }
  .sub { margin-bottom: .4rem; }
  .boxes { margin: .5rem 0; flex-wrap: nowrap; }
  .boxes > div { flex-basis: 0; }
  .boxes strong { font-size: 13pt; }
  .boxes small { font-size: 7.8pt; }
  figure { margin: .4rem 0; }
  figure svg { max-width: 100%; max-height: 52mm; }
}
";

/// The most objects of the table; the rest is added up.
const MAX_ROWS: usize = 5;
/// The largest number of sentences about rates that are above the accepted ones.
const MAX_SENTENCES: usize = 3;
/// The most ids that a list names.
const MAX_NAMED: usize = 2;

/// The page for the owner: loss a year, chances, the plan, what it leaves, what is not counted.
pub fn owners_page(report: &RiskReport, drawn: Option<&Figure>) -> String {
    let years = number(report.years, 4);
    let hazard = measure_words(report.hazard.measure, report.hazard.at);
    let file = report
        .hazard
        .file
        .as_ref()
        .and_then(|file| file.path.file_name());
    let source = file.map_or(hazard.clone(), |name| {
        format!("{} ({hazard})", name.to_string_lossy())
    });
    let kinds = counted(report.objects.len(), "kind");
    let subtitle = format!(
        "{kinds} of object. Hazard: {source}. freestand {}.",
        env!("CARGO_PKG_VERSION")
    );
    let content = html! {
        div.boxes {
            @for (value, what) in boxes(report, &years) {
                div { strong { (value) } small { (what) } }
            }
        }
        p { (whose(report)) }
        (plan(report))
        (objects(report, &years))
        @if let Some(drawn) = drawn {
            figure {
                (drawing(drawn))
                figcaption { (drawn.caption) }
            }
        }
        h3 { "What is not counted" }
        (list(not_counted(report)))
        @for sentence in assumptions(report) { p { (sentence) } }
    };
    document(
        "What earthquakes may cost",
        &subtitle,
        &format!("{ONE_PAGE_CSS}{CSS}"),
        &content,
    )
}

/// Whose objects these are, with room for what nobody stated.
fn whose(report: &RiskReport) -> String {
    let stated = |of: fn(&CostRow) -> &str| {
        let rows = report
            .objects
            .iter()
            .filter_map(|object| object.cost.as_ref());
        let mut all: Vec<&str> = rows.map(of).filter(|text| !text.is_empty()).collect();
        all.sort_unstable();
        all.dedup();
        if all.is_empty() {
            "______________".to_owned()
        } else {
            named(&all)
        }
    };
    let (building, place) = (stated(|row| &row.building), stated(|row| &row.location));
    format!(
        "Building: {building}. Place: {place}. Date: ______________. Prepared by: ______________."
    )
}

/// A measure in words, for readers who do not know its abbreviation.
fn measure_words(measure: Measure, at: At) -> String {
    match measure {
        Measure::Pga => "peak ground acceleration".to_owned(),
        Measure::Pgv => "peak ground velocity".to_owned(),
        Measure::Pfa => "peak floor acceleration".to_owned(),
        Measure::Pfv => "peak floor velocity".to_owned(),
        Measure::Sa { .. } | Measure::SaAverage { .. } => {
            format!(
                "spectral acceleration {} of the {}",
                measure.name(),
                at.name()
            )
        }
        Measure::VelocityRatio => "velocity ratio of the floor".to_owned(),
        Measure::AccelerationRatio => "acceleration ratio of the floor".to_owned(),
    }
}

/// An amount of money with its digits in groups: 259 000 AUD.
fn money(value: f64, currency: &str) -> String {
    format!("{} {currency}", grouped(value))
}

/// Three significant digits, in groups.
fn grouped(value: f64) -> String {
    let text = rounded(value, 3);
    let (sign, digits) = text
        .strip_prefix(['-', '−'])
        .map_or(("", text.as_str()), |digits| ("−", digits));
    if digits.len() < 5 || !digits.bytes().all(|byte| byte.is_ascii_digit()) {
        return text;
    }
    let groups: Vec<&str> = {
        let first = digits.len() % 3;
        let starts = (first..digits.len()).step_by(3).map(|i| &digits[i..i + 3]);
        std::iter::once(&digits[..first])
            .filter(|group| !group.is_empty())
            .chain(starts)
            .collect()
    };
    format!("{sign}{}", groups.join("\u{202f}"))
}

/// The numbers at the top, each with what it is.
fn boxes(report: &RiskReport, years: &str) -> Vec<(String, String)> {
    let currency = report.currency.as_deref().unwrap_or("");
    let mut boxes = Vec::new();
    if let Some(loss) = report.stated_loss() {
        let losses = report.objects.iter().filter_map(|object| object.loss);
        let between = bounded(losses).filter(|_| report.is_bound() && !report.is_at_least());
        boxes.push((
            format!("{}{} a year", least(report.is_at_least()), money(loss, currency)),
            format!(
                "Expected loss: the mean over very many years. Most years cost nothing, a few cost much.{}",
                between.map_or(String::new(), |bounds| format!(" Only its bounds are known: {bounds} {currency}."))
            ),
        ));
    }
    match &report.portfolio {
        Some(portfolio) => {
            let rate = portfolio
                .curve
                .first()
                .map_or(0.0, |point| point.annual_rate);
            let chance = probability_in_years(rate, report.years);
            boxes.push((
                format!(
                    "{}{}",
                    least(portfolio.is_at_least),
                    percent_significant(chance, 2)
                ),
                format!("Chance that an earthquake causes a loss within {years} years."),
            ));
        }
        None => boxes.extend(likeliest(report, years)),
    }
    if let Some((measures, plan)) = report
        .measures
        .as_ref()
        .and_then(|all| Some((all, all.plan.as_ref()?)))
    {
        let saved: f64 = plan
            .chosen
            .iter()
            .filter_map(|worth| worth.benefit_present_value)
            .sum::<f64>()
            / measures.years;
        boxes.push((
            money(plan.plan.cost, currency),
            format!(
                "Cost of the plan below, within a budget of {}. It avoids a loss of {}{} a year.",
                money(plan.budget, currency),
                least(plan.is_at_least()),
                money(saved, currency)
            ),
        ));
        let left = bounded(
            report
                .objects
                .iter()
                .filter_map(|object| left(object, plan)),
        );
        let value = left.map_or_else(not_known, |left| format!("{left} {currency} a year"));
        boxes.push((
            value,
            "Expected loss that remains with the plan.".to_owned(),
        ));
    }
    boxes.extend(casualties(report));
    boxes
}

/// The largest chance of overturning that is known, and which objects may have a larger one: those
/// whose rate is not known, or only the least that it can be.
fn likeliest(report: &RiskReport, years: &str) -> Option<(String, String)> {
    let known = |object: &ObjectRisk| object.state(LimitState::Overturns)?.known();
    let rates = report
        .objects
        .iter()
        .filter_map(|object| Some((object, known(object)?)));
    let (object, rate) = rates.reduce(|a, b| if b.1 > a.1 { b } else { a })?;
    let most = |other: &ObjectRisk| {
        let rates = other.state(LimitState::Overturns)?.rates;
        rates.most()
    };
    let is_open = |other: &&ObjectRisk| {
        other.id != object.id
            && other.may_overturn_more()
            && most(other).is_none_or(|most| most > rate)
    };
    let open: Vec<&str> = report
        .objects
        .iter()
        .filter(is_open)
        .map(|other| other.id.as_str())
        .collect();
    let others = match open.len() {
        0 => "No other object is more likely to overturn.".to_owned(),
        1 => format!(
            "The object {} may be more likely to overturn: only bounds of its rate are known.",
            named(&open)
        ),
        _ => {
            format!(
                "These may be more likely to overturn, as only bounds of their rates are known: {}.",
                named(&open)
            )
        }
    };
    let chance = probability_in_years(rate, report.years);
    Some((
        format!(
            "{}{}",
            least(object.may_overturn_more()),
            percent_significant(chance, 2)
        ),
        format!(
            "Chance that an earthquake overturns the object {} within {years} years. {others}",
            shorten(&object.id)
        ),
    ))
}

/// Expected casualties of the objects whose probability of casualties is known.
fn casualties(report: &RiskReport) -> Option<(String, String)> {
    let counted: Vec<&ObjectRisk> = report
        .objects
        .iter()
        .filter(|object| object.least_casualties.is_some())
        .collect();
    let sum: f64 = counted
        .iter()
        .filter_map(|object| object.least_casualties)
        .sum();
    let has_some = |object: &&&ObjectRisk| {
        object
            .cost
            .as_ref()
            .is_some_and(|cost| cost.quantity * cost.casualty_probability.unwrap_or(0.0) > 0.0)
    };
    let open: Vec<&str> = counted
        .iter()
        .filter(has_some)
        .filter(|object| object.may_overturn_more())
        .map(|object| object.id.as_str())
        .collect();
    counted.first()?;
    let value = match (open.is_empty(), sum > 0.0) {
        (false, false) => not_known(),
        (is_all, _) => format!("{}{} a year", least(!is_all), number(sum, 2)),
    };
    let why = if open.is_empty() {
        String::new()
    } else {
        format!(
            " These may overturn more often than is counted: {}.",
            named(&open)
        )
    };
    Some((
        value,
        format!("Expected casualties: the mean over very many years, without the plan.{why}"),
    ))
}

/// The annual loss of an object that remains with a plan.
fn left(object: &ObjectRisk, plan: &Chosen) -> Option<LossBounds> {
    plan.of(&object.id).map(|worth| worth.after).or(object.loss)
}

/// A sum of losses: itself where it is known, or its bounds; `None` where nothing is known but that it is
/// 0 or more.
fn bounded(losses: impl Iterator<Item = LossBounds>) -> Option<String> {
    let zero = LossBounds {
        least: 0.0,
        best: 0.0,
        most: Some(0.0),
    };
    let sum = losses.fold(zero, |sum, loss| LossBounds {
        least: sum.least + loss.least,
        best: sum.best + loss.best,
        most: sum.most.zip(loss.most).map(|(a, b)| a + b),
    });
    match sum.most {
        Some(_) if !sum.is_bound() => Some(grouped(sum.best)),
        Some(most) if sum.least > 0.0 => {
            Some(format!("{} to {}", grouped(sum.least), grouped(most)))
        }
        Some(most) => Some(format!("at most {}", grouped(most))),
        None => (sum.least > 0.0).then(|| format!("{}{}", least(true), grouped(sum.least))),
    }
}

fn not_known() -> String {
    "not known".to_owned()
}

fn plan(report: &RiskReport) -> Markup {
    let Some((measures, plan)) = report
        .measures
        .as_ref()
        .and_then(|all| Some((all, all.plan.as_ref()?)))
    else {
        return Markup::default();
    };
    let unfunded = unfunded_words(plan, report.currency.as_deref().unwrap_or(""));
    html! {
        h3 { "The plan" }
        @if let Some(words) = unfunded { p { (words) ": the budget does not reach what people need." } }
        p { (what_it_saves(report, measures, plan)) }
        @if !plan.chosen.is_empty() { (chosen(report, plan)) }
    }
}

/// What a plan saves, and whether another may save more.
fn what_it_saves(report: &RiskReport, measures: &Measures, plan: &Chosen) -> String {
    let unknown = match measures.unknown().len() {
        0 => String::new(),
        1 => " What one option saves is not known, so that it is not in the plan.".to_owned(),
        many => {
            format!(" What {many} options save is not known, so that they are not in the plan.")
        }
    };
    if plan.chosen.is_empty() {
        let known = if measures.is_at_least() {
            ", as far as is known"
        } else {
            ""
        };
        return format!("Within the budget, no option saves more than it costs{known}.{unknown}");
    }
    let is_rated = plan
        .chosen
        .iter()
        .any(|worth| worth.life_safety > Some(Rating::Low));
    let proven = match (plan.plan.is_optimal, measures.is_at_least()) {
        _ if is_rated => {
            "Life safety comes first: within the budget, most falls of objects rated high are avoided, then of those \
             rated medium, and then the most money is saved"
        }
        (true, false) => "No other choice within the budget is worth more",
        (true, true) => {
            "Some options may save more than is known. Judged by the least that each saves, no other choice within \
             the budget is worth more"
        }
        (false, _) => "The best plan that was found in the time allowed; there may be a better one",
    };
    format!(
        "{proven}. Over {} years at a discount rate of {} a year, the plan saves {}{} more than it \
         costs.{unknown}",
        number(measures.horizon_years, 4),
        percent_significant(measures.discount_ratio, 2),
        least(plan.is_at_least()),
        money(plan.plan.value, report.currency.as_deref().unwrap_or(""))
    )
}

/// The options of a plan.
fn chosen(report: &RiskReport, plan: &Chosen) -> Markup {
    let currency = report.currency.as_deref().unwrap_or("");
    let of = |id: &str| {
        report
            .objects
            .iter()
            .find(|object| object.id == id)
            .and_then(|object| object.cost.as_ref())
    };
    let row = |worth: &Worth| {
        [
            words(shorten(&worth.id)),
            words(of(&worth.id).map_or(String::new(), |row| shorten(&row.item))),
            words(of(&worth.id).map_or(String::new(), |row| shorten(&row.location))),
            words(worth.life_safety.map_or("–", Rating::name)),
            words(shorten(&worth.option)),
            figure(grouped(worth.cost)),
            figure(
                worth
                    .benefit_present_value
                    .map_or("–".to_owned(), |benefit| {
                        format!("{}{}", least(worth.is_at_least), grouped(benefit))
                    }),
            ),
            figure(worth.ratio().map_or("–".to_owned(), |ratio| {
                format!("{}{}", least(worth.is_at_least), number(ratio, 2))
            })),
        ]
    };
    let headings = [
        words("object"),
        words("item"),
        words("place"),
        words("life safety"),
        words("option"),
        figure(format!("cost ({currency})")),
        figure(format!("saves, present value ({currency})")),
        figure("benefit/cost"),
    ];
    table("", &headings, plan.chosen.iter().map(row))
}

fn objects(report: &RiskReport, years: &str) -> Markup {
    let currency = report.currency.as_deref().unwrap_or("");
    let chosen = report
        .measures
        .as_ref()
        .and_then(|measures| measures.plan.as_ref());
    let has_plan = chosen.is_some();
    let has_verdicts = report.objects.iter().any(|object| object.verdict.is_some());
    let has_losses = report.expected_annual_loss().is_some();
    let mut sorted: Vec<&ObjectRisk> = report.objects.iter().collect();
    let key = |object: &ObjectRisk| {
        let rate = object
            .state(LimitState::Overturns)
            .and_then(StateRisk::known)
            .unwrap_or(0.0);
        (object.expected_annual_loss.unwrap_or(-1.0), rate)
    };
    // The sort is stable: equal objects stay in the order of the file.
    sorted.sort_by(|a, b| {
        key(b)
            .0
            .total_cmp(&key(a).0)
            .then(key(b).1.total_cmp(&key(a).1))
    });
    let mut heads = vec![
        words("object"),
        figure("number"),
        figure("overturns once in (years)"),
        figure(format!("chance of overturning in {years} years")),
        figure(format!("chance of damage in {years} years")),
    ];
    if has_losses {
        heads.push(figure(format!("loss a year ({currency})")));
    }
    if has_plan {
        heads.push(figure(format!("loss a year with the plan ({currency})")));
    }
    if has_verdicts {
        heads.push(words("compared with the accepted rate"));
    }
    let row = |object: &&ObjectRisk| {
        let known = |limit_state: LimitState| {
            object
                .state(limit_state)
                .and_then(|one| Some((one, one.known()?)))
        };
        let chance = |limit_state: LimitState| {
            let words = |(one, rate): (&StateRisk, f64)| {
                let chance = probability_in_years(rate, report.years);
                format!(
                    "{}{}",
                    least(one.is_at_least()),
                    percent_significant(chance, 2)
                )
            };
            figure(known(limit_state).map_or("–".to_owned(), words))
        };
        let is_at_least = object.is_at_least;
        let loss = |loss: LossBounds| {
            format!(
                "{}{}",
                least(is_at_least),
                grouped(loss.stated(is_at_least))
            )
        };
        // More often is in fewer years.
        let every = |(one, rate): (&StateRisk, f64)| {
            format!(
                "{}{}",
                if one.is_at_least() { "at most " } else { "" },
                grouped(1.0 / rate)
            )
        };
        let every = known(LimitState::Overturns)
            .filter(|one| one.1 > 0.0)
            .map_or("–".to_owned(), every);
        let mut cells = vec![
            words(shorten(&object.id)),
            figure(number(
                object.cost.as_ref().map_or(1.0, |cost| cost.quantity),
                4,
            )),
            figure(every),
            chance(LimitState::Overturns),
            chance(LimitState::Exceeds),
        ];
        if has_losses {
            cells.push(figure(object.loss.map_or("–".to_owned(), loss)));
        }
        if has_plan {
            let left = chosen
                .and_then(|plan| left(object, plan))
                .map(|left| bounded(std::iter::once(left)));
            cells.push(figure(
                left.map_or("–".to_owned(), |left| left.unwrap_or_else(not_known)),
            ));
        }
        if has_verdicts {
            cells.push(words(compared(object)));
        }
        cells
    };
    let rest = sorted.get(MAX_ROWS..).unwrap_or_default();
    let losses_of_rest = rest.iter().filter_map(|one| one.expected_annual_loss);
    html! {
        h3 { "The objects" }
        @if has_verdicts { p { (verdicts(report)) } }
        (table("", &heads, sorted.iter().take(MAX_ROWS).map(row)))
        @if !rest.is_empty() {
            p {
                "And " (rest.len()) " more"
                @if has_losses { ", together " (money(losses_of_rest.sum(), currency)) " a year" }
                ", in risk.csv."
            }
        }
    }
}

/// How many kinds of object fail more often than accepted, and how much more often the worst of
/// them do.
fn verdicts(report: &RiskReport) -> String {
    let compared = report
        .objects
        .iter()
        .filter(|one| one.verdict.is_some())
        .count();
    let broken: Vec<&ObjectRisk> = report
        .objects
        .iter()
        .filter(|one| one.verdict == Some(RiskVerdict::Exceeds))
        .collect();
    let kinds = format!("{} of object", counted(compared, "kind"));
    let mut sentences = vec![match broken.len() {
        0 => format!("Of {kinds} with an accepted rate, none fails more often than that."),
        many => {
            let verb = if many == 1 { "fails" } else { "fail" };
            format!("Of {kinds} with an accepted rate, {many} {verb} more often than that.")
        }
    }];
    let mut worst: Vec<(&ObjectRisk, Limit)> = broken
        .iter()
        .flat_map(|object| {
            object
                .named_limits()
                .into_iter()
                .map(|limit| (*object, limit))
        })
        .collect();
    // The sort is stable: equal ratios stay in the order of the file.
    worst.sort_by(|a, b| b.1.ratio().total_cmp(&a.1.ratio()));
    let once = |rate: f64| once_in(rate).unwrap_or_else(|| "never".to_owned());
    sentences.extend(worst.iter().take(MAX_SENTENCES).map(|(object, limit)| {
        let does = match (limit.limit_state == LimitState::Overturns, limit.is_most) {
            (true, false) => "overturns",
            (true, true) => "may overturn up to",
            (false, false) => "is damaged",
            (false, true) => "may be damaged up to",
        };
        let (more, than) = more_often(limit.ratio());
        let (found, accepted) = (once(limit.annual_rate.unwrap_or(0.0)), once(limit.accepted));
        let sure = match object.is_certain {
            Some(true) => "",
            Some(false) => " This is not certain.",
            None => " It is not known how certain this is.",
        };
        let id = shorten(&object.id);
        format!(
            "The object {id} {does} {more} {than} accepted: {found} instead of {accepted}.{sure}"
        )
    }));
    if worst.len() > MAX_SENTENCES {
        sentences.push(format!(
            "risk.json has {} more.",
            worst.len() - MAX_SENTENCES
        ));
    }
    sentences.join(" ")
}

/// How the rates of an object compare with those that its owner accepts, in a few words.
fn compared(object: &ObjectRisk) -> String {
    let Some(verdict) = object.verdict else {
        return "–".to_owned();
    };
    let words = match verdict {
        RiskVerdict::Accepted => "not more often".to_owned(),
        RiskVerdict::Exceeds => {
            more_often(
                object
                    .named_limits()
                    .iter()
                    .map(Limit::ratio)
                    .fold(1.0, f64::max),
            )
            .0
        }
    };
    format!("{words}{}", uncertainty_words(object))
}

/// `3 times as often` as, `20 % more often` than: a rate over the accepted one.
fn more_often(ratio: f64) -> (String, &'static str) {
    if ratio < 1.01 {
        ("slightly more often".to_owned(), "than")
    } else if ratio < 1.5 {
        (
            format!("{} more often", percent_significant(ratio - 1.0, 1)),
            "than",
        )
    } else {
        (format!("{} times as often", rounded(ratio, 2)), "as")
    }
}

/// What the numbers leave out: first what this report misses, then what every one does.
fn not_counted(report: &RiskReport) -> Vec<String> {
    let mut missing: Vec<(NotCounted, Vec<&str>)> = Vec::new();
    for object in report
        .objects
        .iter()
        .filter(|object| object.expected_annual_loss.is_some())
    {
        for what in &object.not_counted {
            match missing.iter_mut().find(|(known, _)| known == what) {
                Some((_, ids)) => ids.push(&object.id),
                None => missing.push((*what, vec![&object.id])),
            }
        }
    }
    let curves = report
        .objects
        .iter()
        .map(|one| (one.id.as_str(), one.curves.caution));
    let cautions: Vec<CurveDoubt> = cautions(curves).collect();
    let cautions = curve_doubts(&cautions).into_iter();
    let mut lines: Vec<String> = cautions.map(|said| said + ".").collect();
    for one in &report.not_run {
        let item = if one.item.is_empty() {
            String::new()
        } else {
            format!(" ({})", shorten(&one.item))
        };
        let why = one
            .why
            .as_ref()
            .map_or("no reason is known".to_owned(), why_not_run);
        lines.push(format!(
            "The object {}{item}, which was not run: {}.",
            shorten(&one.id),
            why.trim_end_matches('.')
        ));
    }
    let bounded: Vec<&str> = report
        .objects
        .iter()
        .filter(|object| object.loss.is_some_and(|loss| loss.is_bound()))
        .map(|object| object.id.as_str())
        .collect();
    if !bounded.is_empty() {
        lines.push(format!("What the runs or the hazard curve leave open; only bounds of the losses of these objects are known (risk.json): {}.", named(&bounded)));
    }
    let missing = missing.into_iter().map(|(what, ids)| {
        // What is missing for another reason than its amount says so between brackets.
        let why = if what.lacks_amount() {
            ", for which no amount was given"
        } else {
            ""
        };
        format!(
            "{}{why}: {}.",
            sentence(risk_words::not_counted(what)),
            named(&ids)
        )
    });
    lines.extend(missing);
    let unpriced: Vec<&str> = report
        .objects
        .iter()
        .filter(|object| object.expected_annual_loss.is_none())
        .map(|object| object.id.as_str())
        .collect();
    if !unpriced.is_empty() {
        lines.push(format!(
            "Any loss of these objects, for which no cost was given: {}.",
            named(&unpriced)
        ));
    }
    let unjudged: Vec<&str> = report
        .objects
        .iter()
        .filter(|object| object.why.is_some())
        .map(|object| object.id.as_str())
        .collect();
    if !unjudged.is_empty() {
        lines.push(format!(
            "An accepted rate of these objects, whose own rate is not known: {}.",
            named(&unjudged)
        ));
    }
    if report
        .portfolio
        .as_ref()
        .is_some_and(|portfolio| portfolio.fails_at_lowest)
    {
        lines.push(
            "Earthquakes weaker than the weakest that was calculated. They cause losses too, so the losses of all \
             objects together are at least as large as stated."
                .to_owned(),
        );
    }
    let states = || report.objects.iter().flat_map(|object| &object.states);
    if states().any(|one| one.ci95.is_some()) {
        let counted = match states().any(|one| one.slopes != Slopes::Stated) {
            true => "allow for a slope that is 0.5 smaller or larger, and for nothing else of it",
            false => "include that of the fragilities alone",
        };
        lines.push(format!(
            "The uncertainty of the hazard: the intervals of the rates (risk.json) {counted}."
        ));
    } else {
        lines.push("The uncertainty of the hazard and of the fragilities.".to_owned());
    }
    lines.push(
        "Damage to the building, and whatever falls on the objects or out of them.".to_owned(),
    );
    lines
}

/// The name of a column or a phrase as the beginning of a sentence.
fn sentence(what: &str) -> String {
    let words = what.replace('_', " ");
    let mut characters = words.chars();
    characters.next().map_or(String::new(), |first| {
        first.to_uppercase().chain(characters).collect()
    })
}

fn named(ids: &[&str]) -> String {
    some(
        &ids.iter().map(|id| shorten(id)).collect::<Vec<_>>(),
        MAX_NAMED,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn amounts_are_grouped() {
        let cases = [
            (392.1, "392"),
            (9000.0, "9000"),
            (259_200.0, "259 000"),
            (1_234_567.0, "1 230 000"),
            (0.0, "0"),
        ];
        for (value, expected) in cases {
            assert_eq!(grouped(value), expected.replace(' ', "\u{202f}"), "{value}");
        }
        assert_eq!(grouped(-25_900.0), "−25\u{202f}900");
    }

    #[test]
    fn rates_are_compared_in_words() {
        let cases = [
            (1.001, ("slightly more often", "than")),
            (1.03, ("3 % more often", "than")),
            (1.6, ("1.6 times as often", "as")),
            (12.34, ("12 times as often", "as")),
        ];
        for (ratio, (words, than)) in cases {
            assert_eq!(more_often(ratio), (words.to_owned(), than));
        }
    }

    #[test]
    fn long_lists_name_the_first() {
        assert_eq!(named(&["a", "b", "c", "d", "e", "f"]), "a, b and 4 more");
        assert_eq!(sentence("repair_cost"), "Repair cost");
    }
}
