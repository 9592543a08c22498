//! What there is to know beside fragilities, hazards and costs, in sentences.

use freestand::fragility::{Crossing, NoInterval};
use freestand_input::quantity::shorten;
use freestand_input::words::{counted, number, significant, some};
use freestand_risk::costs::CostDoubt;
use freestand_risk::fragility::{
    Contradiction, CurveDoubt, FitDoubt, FragilityReport, HazardDoubt, UnusedColumn,
};

use crate::assessment::words::too_mild;

/// The most objects with the same sentence that are named one by one.
const MAX_NAMED: usize = 3;

/// What to know beside a fit.
pub fn warnings(report: &FragilityReport) -> Vec<String> {
    curve_doubts(&report.doubts())
}

/// What to know beside curves. What is the same for many objects is said once.
pub(crate) fn curve_doubts(doubts: &[CurveDoubt]) -> Vec<String> {
    let mut said = Vec::new();
    let mut fits: Vec<(String, Vec<&str>)> = Vec::new();
    for doubt in doubts {
        match doubt {
            CurveDoubt::TooMild { why, ids } => {
                let (verb, they) = if ids.len() == 1 {
                    ("is", "it")
                } else {
                    ("are", "they")
                };
                said.push(format!(
                    "{} {verb} {}; {they} may fail more often than the curves say, for example {}",
                    counted(ids.len(), "object"),
                    too_mild(*why),
                    shorten(ids.first().map_or("", String::as_str))
                ));
            }
            CurveDoubt::Contradiction { first, also } => said.push(contradiction(first, also)),
            CurveDoubt::Fit { id, doubt } => {
                let text = fit_doubt(doubt);
                match fits.iter_mut().find(|(known, _)| *known == text) {
                    Some((_, ids)) => ids.push(id),
                    None => fits.push((text, vec![id])),
                }
            }
        }
    }
    let of_fits = fits
        .into_iter()
        .flat_map(|(text, ids)| match ids.as_slice() {
            [first, ..] if ids.len() > MAX_NAMED => vec![format!(
                "{}, {} among them: {text}",
                counted(ids.len(), "object"),
                shorten(first)
            )],
            _ => ids.iter().map(|id| format!("{id}: {text}")).collect(),
        });
    said.extend(of_fits);
    said
}

fn contradiction(first: &Contradiction, also: &[String]) -> String {
    let unit = first.measure.unit();
    let place = match first.crossing {
        Some(x) => format!("they cross at {} {unit}", significant(x, 3)),
        None => "they do not cross".to_owned(),
    };
    let also: Vec<String> = also.iter().map(|id| shorten(id)).collect();
    let also = if also.is_empty() {
        String::new()
    } else {
        format!(" (also {})", some(&also, MAX_NAMED))
    };
    format!(
        "{}: between {} and {} {unit} {} is more probable than {}, which it includes ({place}): the rates and \
         the loss contradict each other; fit both with one beta (`fit = \"ordered\"`){also}",
        shorten(&first.id),
        significant(first.from, 3),
        significant(first.to, 3),
        first.severe.name(),
        first.mild.name(),
    )
}

fn fit_doubt(doubt: &FitDoubt) -> String {
    match doubt {
        FitDoubt::NotByShock(why) => {
            format!("exceeds is fitted to the outcomes, not to the shocks: {why}")
        }
        FitDoubt::Unresolved { runs, reasons } => {
            let verb = if *runs == 1 { "was" } else { "were" };
            let mut why: Vec<&str> = reasons.iter().take(MAX_NAMED).map(String::as_str).collect();
            if reasons.len() > MAX_NAMED {
                why.push("and others: see the column reason of the table");
            }
            let why = if why.is_empty() {
                String::new()
            } else {
                format!(": {}", why.join("; "))
            };
            format!(
                "{} could not be calculated and {verb} left out of the fit{why}",
                counted(*runs, "run")
            )
        }
        FitDoubt::Crossing(Crossing {
            states: [one, other],
            intensity,
        }) => format!(
            "the curves of {} and {} cross at {}, beyond which the more severe state would be the more probable \
             one: use `fit = \"ordered\"`",
            one.name(),
            other.name(),
            significant(*intensity, 3)
        ),
        FitDoubt::Misfit { p_value } => format!(
            "the curves do not fit the runs (p = {}): compare them with empirical.csv",
            significant(*p_value, 2)
        ),
        FitDoubt::NotIncreasing(state) => format!(
            "{} is not more frequent at higher intensities, so no curve fits",
            state.name()
        ),
        FitDoubt::OnlyBounds(state) => format!(
            "at one intensity alone some runs reach {} and some do not, so only its bounds are known: run more \
             intensities or motions",
            state.name()
        ),
        FitDoubt::NoInterval { state, why } => format!(
            "{} has no 95 % interval, because {}",
            state.name(),
            why_no_interval(*why)
        ),
        FitDoubt::FewMotions(motions) => format!(
            "the 95 % intervals of {} are too narrow, above all those of beta",
            counted(*motions, "motion")
        ),
        FitDoubt::FailedSamples { failed, samples } => format!(
            "{failed} of {samples} samples have no curve, so the intervals are doubtful: run more motions or \
             intensities"
        ),
    }
}

/// Why there is no interval.
pub(super) fn why_no_interval(why: NoInterval) -> String {
    match why {
        NoInterval::FewCurves { known, samples } => {
            format!(
                "only {known} of {samples} samples have a curve: run more motions or intensities"
            )
        }
        NoInterval::AllEqual => "all samples have the same curve: run more motions".to_owned(),
    }
}

/// What to know beside a hazard.
pub(crate) fn hazard_doubt(doubt: &HazardDoubt) -> String {
    let left_out =
        |count: usize, why: &str| format!("hazard: {} left out: {why}", counted(count, "point"));
    match doubt {
        HazardDoubt::IdleSite => {
            "`site_coordinates` has no effect: the file of the hazard curve has no sites".to_owned()
        }
        HazardDoubt::CertainPoints(count) => left_out(
            *count,
            "the probability is 1, so the rate is not known",
        ),
        HazardDoubt::EqualPoints(count) => left_out(
            *count,
            "the next, stronger intensity has the same probability",
        ),
        HazardDoubt::SiteAway { metres } => format!(
            "hazard: the site of the file is {} km from the coordinates that were asked for",
            number(f64::from(*metres) / 1e3, 2)
        ),
        HazardDoubt::OtherThanMean(statistic) => format!(
            "hazard: the file is {} of its hazard model, not the mean: rates and losses from it are not means",
            statistic.name_with_article()
        ),
        HazardDoubt::SlopeOfPlace => {
            "the hazard goes through the return periods of the place: the interval of a rate allows for a slope that is \
             smaller or larger by 0.5; without runs it is only the range that follows from this, not a 95 % interval"
                .to_owned()
        }
        HazardDoubt::AssumedSite(site) => format!(
            "hazard: {site} is assumed, because no `site` was given; another one may change a rate several times"
        ),
        HazardDoubt::DesignAccelerations => {
            "the rates are those of design accelerations of a code, without its minimum and maximum: they are not a \
             hazard study of the site"
                .to_owned()
        }
    }
}

/// What to know beside costs and options.
pub(crate) fn cost_doubt(doubt: &CostDoubt) -> String {
    match doubt {
        CostDoubt::OfList(said) => said.clone(),
        CostDoubt::Unused { path, columns } => {
            let named: Vec<String> = columns
                .iter()
                .map(|UnusedColumn { heading, near }| {
                    let near = near.as_ref();
                    let near = near.map_or_else(String::new, |near| format!(" (is it {near}?)"));
                    format!("{}{near}", shorten(heading))
                })
                .collect();
            let are = if columns.len() == 1 {
                "this column is"
            } else {
                "these columns are"
            };
            format!("{}: {are} not used: {}", path.display(), named.join(", "))
        }
        CostDoubt::NoQuantity { path, rows } => {
            let has = if *rows == 1 { "has" } else { "have" };
            format!(
                "{}: {} {has} no quantity: 1 is assumed",
                path.display(),
                counted(*rows, "row")
            )
        }
        CostDoubt::DearRepair { path, line, id } => format!(
            "{}:{line}: the repair of {} costs more than its overturning: are the costs in the wrong columns?",
            path.display(),
            shorten(id)
        ),
    }
}

#[cfg(test)]
mod tests;
