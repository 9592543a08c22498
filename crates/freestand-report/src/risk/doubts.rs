//! What there is to know beside rates and losses, and what was assumed, in sentences.

use freestand::risk::Gap;
use freestand_input::quantity::shorten;
use freestand_input::words::{counted, number, percent_significant, some};
use freestand_risk::RiskReport;
use freestand_risk::doubts::{NoPortfolio, OpenOptions, RiskAssumption, RiskDoubt};
use freestand_risk::fragility::{Measure, MeasuredHazard};

use super::words::why_unjudged;
use crate::fragility::doubts::{cost_doubt, curve_doubts, hazard_doubt};

/// What to know beside the result.
pub fn warnings(report: &RiskReport) -> Vec<String> {
    let measure = report.hazard.measure;
    let doubts = report.doubts.iter();
    doubts.flat_map(|doubt| sentences(doubt, measure)).collect()
}

/// What was used because nobody stated it, as one sentence; none where all was stated.
pub(super) fn assumptions(report: &RiskReport) -> Vec<String> {
    let all: Vec<String> = report
        .assumptions
        .iter()
        .map(|one| assumed(*one, &report.hazard))
        .collect();
    if all.is_empty() {
        return all;
    }
    let all = all.join("; ");
    vec![format!("Assumed, because nobody stated it: {all}.")]
}

fn assumed(assumed: RiskAssumption, hazard: &MeasuredHazard) -> String {
    let are = |count: usize| if count == 1 { "is" } else { "are" };
    match assumed {
        RiskAssumption::Years(years) => format!("chances are those in {} years", number(years, 4)),
        RiskAssumption::OneDispersion => {
            "the limit states of an object are fitted with one dispersion".to_owned()
        }
        RiskAssumption::Replicates(samples) => {
            format!("intervals come from {samples} samples of motions")
        }
        RiskAssumption::Place => format!(
            "{} is that of the {}",
            hazard.measure.name(),
            hazard.at.name()
        ),
        RiskAssumption::HazardGoesOn => {
            "above its last point the hazard goes on as between the last two".to_owned()
        }
        RiskAssumption::NothingAccepted => {
            "no rate is accepted, so that there is no verdict".to_owned()
        }
        RiskAssumption::OneOfEach(objects) => format!(
            "{} without a quantity {} counted once",
            counted(objects, "object"),
            are(objects)
        ),
        RiskAssumption::PaidOnce(options) => format!(
            "{} without a life {} paid for once",
            counted(options, "option"),
            are(options)
        ),
    }
}

/// The first of several ids, and how many there are besides.
fn first(ids: &[String]) -> String {
    let ids: Vec<String> = ids.iter().map(|id| shorten(id)).collect();
    some(&ids, 1)
}

/// An intensity with four digits.
fn intensity(measure: Measure, value: f64) -> String {
    measure.value_words(format!("{value:.3e}").parse().unwrap_or(value))
}

fn sentences(doubt: &RiskDoubt, measure: Measure) -> Vec<String> {
    vec![match doubt {
        RiskDoubt::Curves(doubts) => return curve_doubts(doubts),
        RiskDoubt::Hazard(doubt) => hazard_doubt(doubt),
        RiskDoubt::Cost(doubt) => cost_doubt(doubt),
        RiskDoubt::BeginsTooHigh { first: begin, ids } => format!(
            "the hazard curve begins at {}, but weaker motions also reach limit states of {}: their rates are at \
             least those stated; give a hazard curve that begins at a lower intensity",
            intensity(measure, *begin),
            first(ids)
        ),
        RiskDoubt::EndsTooLow { last, share, ids } => format!(
            "the hazard curve ends at {}, and stronger motions cause up to {} of a rate of {}: the slope of the last \
             two points was continued, and the upper bound of the rate is that of motions which are all as strong as \
             any; give a hazard curve up to stronger motions",
            intensity(measure, *last),
            percent_significant(*share, 2),
            first(ids)
        ),
        RiskDoubt::NotResolved { gap, ids } => not_resolved(*gap, ids, measure),
        RiskDoubt::WouldTell { from, to, count } => format!(
            "runs at these intensities would probably tell these rates: `scales = \"{}:{}:{count}\"`",
            // A little outwards, so that rounding leaves out none.
            intensity(measure, 0.999 * from),
            intensity(measure, 1.001 * to)
        ),
        RiskDoubt::WithoutCosts(ids) => format!(
            "{} without a row in the inventory: {}",
            counted(ids.len(), "object"),
            some(ids, 1)
        ),
        RiskDoubt::WithoutFragility(ids) => format!(
            "{} of the inventory without a fragility: {}",
            counted(ids.len(), "object"),
            some(ids, 1)
        ),
        RiskDoubt::Unjudged { why, ids } => format!(
            "{}: an accepted rate was not compared with anything: {}",
            first(ids),
            why_unjudged(*why)
        ),
        RiskDoubt::UnknownWorth(options) => {
            let (with, ranked) = match options.more {
                0 => ("the option", "the option is ranked last and is"),
                _ => ("each of them", "they are ranked last and are"),
            };
            format!(
                "the worth of {} is not known: a rate with {with} has no upper bound, so {ranked} not chosen; {}",
                named(options),
                remedy(options)
            )
        }
        RiskDoubt::UnknownFalls(options) => {
            let (avoid, they) = match options.more {
                0 => ("avoids", "it is"),
                _ => ("avoid", "they are"),
            };
            format!(
                "how many falls {} {avoid} is not known, so {they} not chosen for the sake of people; {}",
                named(options),
                remedy(options)
            )
        }
        RiskDoubt::NoPortfolio(why) => format!(
            "{}: the losses of all objects together were not calculated",
            no_portfolio(*why, measure)
        ),
        RiskDoubt::WorldsLeftOut { left_out, worlds } => {
            let (has, was, it) = if *left_out == 1 {
                ("has", "was", "it")
            } else {
                ("have", "were", "them")
            };
            format!(
                "{left_out} of {} {has} a run that could not be calculated and {was} left out of the losses of all \
                 objects together; the other motions at the same intensity count for {it}",
                counted(*worlds, "world")
            )
        }
        RiskDoubt::FailsAtLowest {
            lowest,
            failing,
            motions,
        } => format!(
            "at the lowest intensity that is counted, {}, an object fails in {failing} of {}: weaker motions cause \
             losses too, so the losses of all objects are at least those stated; add lower intensities to the \
             outcomes, and to the hazard curve if it begins there",
            intensity(measure, *lowest),
            counted(*motions, "motion")
        ),
        RiskDoubt::LeastAlone(ids) => format!(
            "{}: the outcomes give no curve of exceeding or overturning (\"bounds\" or \"not-increasing\"), so the \
             losses of objects that fail independently count the least that they can be; run more intensities",
            first(ids)
        ),
    }]
}

fn not_resolved(gap: Gap, ids: &[String], measure: Measure) -> String {
    let words = |x: f64| intensity(measure, x);
    let (place, remedy) = match gap {
        Gap::Below { lowest, .. } => (
            format!("below {}, the lowest intensity of the runs", words(lowest)),
            "run lower intensities",
        ),
        Gap::Between(a, b) => (
            format!(
                "between {} and {}, with no run between them",
                words(a),
                words(b)
            ),
            "run intensities there",
        ),
        Gap::Above(x) => (
            format!("above {}, the highest intensity of the runs", words(x)),
            "run higher intensities",
        ),
    };
    format!(
        "more than a tenth of a rate of {} may be {place}: such rates are only known between bounds, and so is what \
         they cost; {remedy}",
        first(ids)
    )
}

fn named(OpenOptions { option, id, more }: &OpenOptions) -> String {
    let (one, more) = match more {
        0 => ("option", String::new()),
        more => ("options", format!(" and {more} more")),
    };
    format!(
        "the {one} \"{}\" for {}{more}",
        shorten(option),
        shorten(id)
    )
}

/// What to do where a rate has no upper bound.
fn remedy(options: &OpenOptions) -> String {
    let it = if options.more == 0 { "it" } else { "them" };
    format!(
        "run {it} under more and weaker motions, or give a hazard curve that begins at a lower intensity"
    )
}

fn no_portfolio(why: NoPortfolio, measure: Measure) -> String {
    match why {
        NoPortfolio::OfFloor => {
            "the hazard curve is that of a measure of the floor, and all objects share only the motions of the ground"
                .to_owned()
        }
        NoPortfolio::Counts => {
            "the outcomes are counts, which do not say which objects fail under the same motion"
                .to_owned()
        }
        NoPortfolio::OneIntensity => {
            "the outcomes have a single intensity, and motions of others would cause losses too"
                .to_owned()
        }
        NoPortfolio::NoStripes => {
            "the motions were not all scaled to the same intensities, so there are no worlds that all objects share"
                .to_owned()
        }
        NoPortfolio::NotCalculated(at) => format!(
            "at {} every motion has a run that could not be calculated",
            intensity(measure, at)
        ),
    }
}

#[cfg(test)]
mod tests;
