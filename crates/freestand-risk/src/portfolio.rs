//! Losses of all objects together under common motions.

use std::collections::HashMap;

use freestand::decision::strip_rates;
use freestand::fragility::{CurveKind, LimitState, OutcomeClass};
use freestand::risk::{
    LossPoint, LossShares, World, expected_loss_per_year, independent_loss_exceedance,
    loss_at_return_period, loss_exceedance,
};
use freestand_input::problem::{Problem, ProblemKind};
use freestand_output::{answer, answer_of};

use crate::fragility::{At, FragilityReport, OutcomeTable};

use super::costs::{CostRow, Costs};
use super::objects::LOSS_STATES;
use super::objects::{LossBounds, ObjectRisk};
use crate::doubts::{NoPortfolio, RiskDoubt};
use crate::fragility::MeasuredHazard;

/// The return periods whose losses are stated \[years\].
pub const RETURN_PERIODS: [f64; 5] = [100.0, 250.0, 500.0, 1000.0, 2500.0];
/// If a larger share of the worlds of the lowest intensity has a loss, lower intensities are
/// missing.
const SMALL: f64 = 0.02;
/// If a larger share of the outcomes under pairs of motion and intensity is missing, the runs are
/// not stripes.
const NO_STRIPES: f64 = 0.5;

/// The losses of all objects.
#[derive(Debug, Clone, PartialEq)]
pub struct Portfolio {
    /// Worlds that the objects share.
    pub worlds: usize,
    /// What failures cost a year on average.
    pub expected_annual_loss: f64,
    /// The least and the most that it can be, whatever happens between the intensities; the most is
    /// `None` where something fails at the lowest one,
    /// or may fail more often than its curves say.
    bounds: (f64, Option<f64>),
    /// The rates at which losses are reached.
    pub curve: Vec<LossPoint>,
    /// The same at the least and, as far as it is known, at the most.
    least: Vec<LossPoint>,
    most: Option<Vec<LossPoint>>,
    /// The same for objects that fail independently.
    pub independent: Vec<LossPoint>,
    /// Whether losses may be larger than those that are counted.
    pub is_at_least: bool,
    /// Whether motions below those that were calculated cause losses too.
    pub fails_at_lowest: bool,
}

/// An object with costs.
struct Priced<'a> {
    /// Its place in the table of outcomes.
    object: usize,
    cost: &'a CostRow,
    risk: Option<&'a ObjectRisk>,
}

fn priced<'a>(
    table: &OutcomeTable,
    costs: &'a Costs,
    objects: &'a [ObjectRisk],
) -> Vec<Priced<'a>> {
    let rows = costs.rows.iter().filter(|row| row.has_costs());
    let rows: HashMap<&str, &CostRow> = rows.map(|row| (row.id.as_str(), row)).collect();
    let risks: HashMap<&str, &ObjectRisk> =
        objects.iter().map(|one| (one.id.as_str(), one)).collect();
    let of = |(object, id): (usize, &String)| {
        let cost = *rows.get(id.as_str())?;
        Some(Priced {
            object,
            cost,
            risk: risks.get(id.as_str()).copied(),
        })
    };
    table.objects.iter().enumerate().filter_map(of).collect()
}

/// The worlds that objects share: motions at intensities.
struct Worlds {
    /// Intensities, rising.
    levels: Vec<f64>,
    /// How often motions happen that each intensity represents \[1/year\].
    strips: Vec<f64>,
    /// How many worlds each intensity has.
    counts: Vec<usize>,
    /// For each world its intensity, by its number, and the classes of the objects with costs.
    all: Vec<(usize, Vec<OutcomeClass>)>,
}

/// The losses of all objects; `None` without costs, and where there are no worlds that objects
/// share, with a doubt that says why.
///
/// # Errors
/// A run that is missing, and intensities that the hazard does not tell apart.
pub(crate) fn portfolio(
    report: &FragilityReport,
    costs: &Costs,
    objects: &[ObjectRisk],
    hazard: &MeasuredHazard,
    doubts: &mut Vec<RiskDoubt>,
) -> Result<Option<Portfolio>, Problem> {
    let table = &report.table;
    let priced = priced(table, costs, objects);
    if priced.is_empty() {
        return Ok(None);
    }
    let Some(worlds) = shared_worlds(table, &priced, hazard, doubts)? else {
        return Ok(None);
    };
    let one = |(class, priced): (&OutcomeClass, &Priced)| match class {
        OutcomeClass::Overturned => priced.cost.quantity * priced.cost.overturned(),
        OutcomeClass::Exceeded => priced.cost.quantity * priced.cost.repair.unwrap_or(0.0),
        OutcomeClass::NoUplift | OutcomeClass::Rocked => 0.0,
    };
    let all: Vec<World> = worlds
        .all
        .iter()
        .map(|(level, classes)| World {
            annual_rate: worlds.strips[*level] / worlds.counts[*level] as f64,
            loss: classes.iter().zip(&priced).map(one).sum(),
        })
        .collect();
    let fails_at = fails_at_lowest(&worlds);
    let fails_at_lowest = fails_at.is_some();
    let is_cautious = priced
        .iter()
        .filter_map(|one| one.risk)
        .any(|one| one.curves.caution.is_some());
    let is_at_least = fails_at_lowest || is_cautious;
    doubts.extend(fails_at);
    let curve = loss_exceedance(&all);
    let losses: Vec<f64> = curve.iter().map(|point| point.loss).collect();
    let ends = Ends::new(&worlds, &all, &priced, hazard);
    let (least, most) = ends.of(|loss| loss);
    let bounds = (least, (!is_at_least).then_some(most));
    let (least, most) = ends.curves(&losses);
    Ok(Some(Portfolio {
        worlds: all.len(),
        expected_annual_loss: expected_loss_per_year(&all),
        bounds,
        least,
        most: (!is_at_least).then_some(most),
        independent: independent(&worlds, &priced, &losses, doubts),
        curve,
        is_at_least,
        fails_at_lowest,
    }))
}

/// The least and the most that losses can be: between two intensities at least those of the lower one and at
/// most those of the upper one, and above the highest one at most that of everything.
struct Ends<'w> {
    worlds: &'w Worlds,
    /// The loss of each world.
    losses: Vec<f64>,
    /// How often a year motions lie between each intensity and the next one, or above the last.
    strips: Vec<f64>,
    everything: f64,
}

impl<'w> Ends<'w> {
    fn new(worlds: &'w Worlds, all: &[World], priced: &[Priced], hazard: &MeasuredHazard) -> Self {
        let most =
            |cost: &CostRow| cost.quantity * cost.overturned().max(cost.repair.unwrap_or(0.0));
        let rates: Vec<f64> = worlds
            .levels
            .iter()
            .map(|level| hazard.hazard.annual_rate(*level))
            .chain([0.0])
            .collect();
        Self {
            worlds,
            losses: all.iter().map(|world| world.loss).collect(),
            strips: rates.windows(2).map(|pair| pair[0] - pair[1]).collect(),
            everything: priced.iter().map(|one| most(one.cost)).sum(),
        }
    }

    /// The ends of the rate of something whose mean over the motions of an intensity is made to rise with it
    /// first; of everything it is `everything`.
    fn of(&self, something: impl Fn(f64) -> f64) -> (f64, f64) {
        let mut means = vec![0.0; self.worlds.levels.len()];
        for ((level, _), loss) in self.worlds.all.iter().zip(&self.losses) {
            means[*level] += something(*loss) / self.worlds.counts[*level] as f64;
        }
        let mut falling = means.clone();
        (1..means.len())
            .rev()
            .for_each(|i| falling[i - 1] = falling[i - 1].min(falling[i]));
        (1..means.len()).for_each(|i| means[i] = means[i].max(means[i - 1]));
        let sum = |ends: &mut dyn Iterator<Item = f64>| {
            ends.zip(&self.strips).map(|(end, strip)| end * strip).sum()
        };
        let above = something(self.everything);
        (
            sum(&mut falling.into_iter()),
            sum(&mut means.into_iter().skip(1).chain([above])),
        )
    }

    /// How often each loss is reached, at the least and at the most.
    fn curves(&self, losses: &[f64]) -> (Vec<LossPoint>, Vec<LossPoint>) {
        let all = losses
            .iter()
            .copied()
            .filter(|loss| *loss < self.everything)
            .chain([self.everything]);
        let point = |least: f64| {
            let ends = self.of(|loss| if loss >= least { 1.0 } else { 0.0 });
            let at = |annual_rate| LossPoint {
                loss: least,
                annual_rate,
            };
            (at(ends.0), at(ends.1))
        };
        all.map(point).unzip()
    }
}

/// The worlds of the outcomes; `None`, with a doubt, where objects share none.
///
/// A world with a run that could not be calculated is left out for all objects, and the other
/// motions at its intensity count for it: what one of its objects costs is not known, so neither is
/// the sum.
fn shared_worlds(
    table: &OutcomeTable,
    priced: &[Priced],
    hazard: &MeasuredHazard,
    doubts: &mut Vec<RiskDoubt>,
) -> Result<Option<Worlds>, Problem> {
    let mut without = |why: NoPortfolio| {
        doubts.push(RiskDoubt::NoPortfolio(why));
        Ok(None)
    };
    if hazard.at != At::Ground {
        return without(NoPortfolio::OfFloor);
    }
    let motions = table.motions.len();
    if motions == 0 {
        return without(NoPortfolio::Counts);
    }
    let mut places: Vec<Option<usize>> = vec![None; table.objects.len()];
    for (place, one) in priced.iter().enumerate() {
        places[one.object] = Some(place);
    }
    let runs = || {
        table
            .runs
            .iter()
            .filter_map(|run| Some((places.get(run.object).copied().flatten()?, &run.run)))
    };
    let mut levels: Vec<f64> = runs().map(|(_, run)| run.intensity).collect();
    levels.sort_by(f64::total_cmp);
    levels.dedup();
    if levels.len() < 2 {
        return without(NoPortfolio::OneIntensity);
    }
    let mut classes: Vec<Option<OutcomeClass>> = vec![None; motions * levels.len() * priced.len()];
    let wanted = classes.len();
    for (place, run) in runs() {
        let level = levels.partition_point(|level| *level < run.intensity);
        let world = run.motion.unwrap_or(0) * levels.len() + level;
        if let Some(class) = classes.get_mut(world * priced.len() + place) {
            *class = Some(run.class);
        }
    }
    if (classes.iter().flatten().count() as f64) < (1.0 - NO_STRIPES) * wanted as f64 {
        return without(NoPortfolio::NoStripes);
    }
    check_missing(table, priced, &levels, &classes)?;
    let strips = strip_rates(&levels, |x| hazard.hazard.annual_rate(x)).map_err(|error| {
        Problem::new(ProblemKind::Value, error.to_string())
            .hint("give intensities that the hazard curve covers")
    })?;
    let complete = classes
        .chunks(priced.len())
        .enumerate()
        .filter_map(|(world, classes)| {
            Some((
                world % levels.len(),
                classes
                    .iter()
                    .copied()
                    .collect::<Option<Vec<OutcomeClass>>>()?,
            ))
        });
    let all: Vec<(usize, Vec<OutcomeClass>)> = complete.collect();
    let mut counts = vec![0_usize; levels.len()];
    for (level, _) in &all {
        counts[*level] += 1;
    }
    let left_out = motions * levels.len() - all.len();
    if let Some(level) = levels
        .iter()
        .zip(&counts)
        .find(|(_, count)| **count == 0)
        .map(|(level, _)| *level)
    {
        return without(NoPortfolio::NotCalculated(level));
    }
    if left_out > 0 {
        doubts.push(RiskDoubt::WorldsLeftOut {
            left_out,
            worlds: motions * levels.len(),
        });
    }
    Ok(Some(Worlds {
        levels,
        strips,
        counts,
        all,
    }))
}

/// Refuses an object with fewer outcomes than there are worlds, unless its runs that could not be
/// calculated are all that is missing.
fn check_missing(
    table: &OutcomeTable,
    priced: &[Priced],
    levels: &[f64],
    classes: &[Option<OutcomeClass>],
) -> Result<(), Problem> {
    let missing = |place: usize| {
        let of_object = classes.iter().skip(place).step_by(priced.len()).enumerate();
        of_object
            .filter(|(_, class)| class.is_none())
            .map(|(world, _)| world)
    };
    for (place, one) in priced.iter().enumerate() {
        let unresolved = table.unresolved.get(one.object).copied().unwrap_or(0);
        let Some(first) = missing(place)
            .next()
            .filter(|_| missing(place).count() > unresolved)
        else {
            continue;
        };
        let name = |names: &[String], i: usize| names.get(i).cloned().unwrap_or_default();
        let message = format!(
            "object {} has no outcome under motion {} at {}",
            name(&table.objects, one.object),
            name(&table.motions, first / levels.len()),
            levels
                .get(first % levels.len())
                .map_or(String::new(), |level| table.measure.value_words(*level))
        );
        let hint = "add this run: the losses of all objects need each object under each motion at each intensity";
        return Err(Problem::value(message, hint).in_file(&table.file.path));
    }
    Ok(())
}

/// Whether something fails at the lowest intensity that counts: intensities below it, and below the
/// first point of the hazard curve, are not counted.
fn fails_at_lowest(worlds: &Worlds) -> Option<RiskDoubt> {
    let lowest = worlds
        .strips
        .iter()
        .position(|strip| *strip > 0.0)
        .unwrap_or(0);
    let fails = |(level, classes): &&(usize, Vec<OutcomeClass>)| {
        *level == lowest && classes.iter().any(|class| *class > OutcomeClass::Rocked)
    };
    let (failing, all) = (
        worlds.all.iter().filter(fails).count(),
        worlds.counts.get(lowest).copied().unwrap_or(0),
    );
    let lowest = *worlds.levels.get(lowest)?;
    (failing as f64 > SMALL * all as f64).then_some(RiskDoubt::FailsAtLowest {
        lowest,
        failing,
        motions: all,
    })
}

/// How often each loss is reached if, given the intensity, objects fail independently of each
/// other, by their curves; an object without a curve counts with the least that its outcomes allow,
/// with a doubt.
fn independent(
    worlds: &Worlds,
    priced: &[Priced],
    losses: &[f64],
    doubts: &mut Vec<RiskDoubt>,
) -> Vec<LossPoint> {
    let shares_at = |level: f64| -> Vec<LossShares> {
        priced
            .iter()
            .filter_map(|one| Some(shares(one.risk?, one.cost, level)))
            .collect()
    };
    let levels: Vec<(f64, Vec<LossShares>)> = worlds
        .levels
        .iter()
        .zip(&worlds.strips)
        .map(|(level, strip)| (*strip, shares_at(*level)))
        .collect();
    let unknown: Vec<String> = priced
        .iter()
        .filter_map(|one| one.risk)
        .filter(|one| {
            LOSS_STATES
                .into_iter()
                .filter_map(|state| one.curves.curve(state))
                .any(is_unknown)
        })
        .map(|one| one.id.clone())
        .collect();
    if !unknown.is_empty() {
        doubts.push(RiskDoubt::LeastAlone(unknown));
    }
    independent_loss_exceedance(&levels, losses)
}

/// Whether nothing but the least probability is known at an intensity of the runs.
fn is_unknown(kind: CurveKind) -> bool {
    match kind {
        CurveKind::Bounds { .. } | CurveKind::NotIncreasing { .. } => true,
        // From its lowest intensity on, which is that of the runs, every run failed; of `None` none
        // did.
        CurveKind::Lognormal { .. }
        | CurveKind::Step { .. }
        | CurveKind::All { .. }
        | CurveKind::None { .. } => false,
    }
}

/// The losses of one object at a level, by its curves.
fn shares(object: &ObjectRisk, cost: &CostRow, level: f64) -> LossShares {
    let p = |state: LimitState| {
        object
            .curves
            .curve(state)
            .map(|kind| kind.least_probability(level))
    };
    let overturns = p(LimitState::Overturns).unwrap_or(0.0);
    let exceeds = p(LimitState::Exceeds).unwrap_or(overturns).max(overturns);
    vec![
        (0.0, 1.0 - exceeds),
        (
            cost.quantity * cost.repair.unwrap_or(0.0),
            exceeds - overturns,
        ),
        (cost.quantity * cost.overturned(), overturns),
    ]
}

/// The losses of all objects with their currency.
#[derive(Clone, Copy)]
pub struct InCurrency<'r> {
    /// The losses.
    pub portfolio: &'r Portfolio,
    /// Their currency.
    pub currency: Option<&'r str>,
}

answer_of!(InCurrency<'_> as of {
    currency: Option<String> = of.currency.map(str::to_owned);
    worlds: usize = of.portfolio.worlds;
    expected_annual_loss: f64 = of.portfolio.expected_annual_loss;
    expected_annual_loss_lower: f64 = of.portfolio.bounds.0;
    expected_annual_loss_upper: Option<f64> = of.portfolio.bounds.1;
    is_bound: bool = of.portfolio.is_bound();
    is_at_least: bool = of.portfolio.is_at_least;
    loss_at_return_period: Vec<OnceIn> = RETURN_PERIODS.iter().map(|&years| of.portfolio.once_in(years)).collect();
    /// The rates at which losses are reached.
    loss_exceedance: Vec<Reached<'_>> = of.portfolio.curve.iter().map(Reached).collect();
    /// The same for objects that fail independently.
    independent_loss_exceedance: Vec<Reached<'_>> = of.portfolio.independent.iter().map(Reached).collect();
});

/// A loss, and how often a year it is reached.
#[derive(Clone, Copy)]
struct Reached<'r>(&'r LossPoint);

answer_of!(Reached<'_> as point {
    loss: f64 = point.0.loss;
    annual_rate: f64 = point.0.annual_rate;
});

answer! {
    /// The loss that is reached once in so many years.
    pub struct OnceIn {
        /// The return period.
        years: f64,
        /// The loss.
        loss: f64,
        /// The least that it can be.
        loss_lower: f64,
        /// The most; none where nothing bounds it.
        loss_upper: Option<f64>,
    }
}

impl Portfolio {
    fn once_in(&self, years: f64) -> OnceIn {
        let LossBounds { least, best, most } = self.at_return_period(years);
        OnceIn {
            years,
            loss: best,
            loss_lower: least,
            loss_upper: most,
        }
    }

    /// The loss that is reached once in so many years.
    pub fn at_return_period(&self, years: f64) -> LossBounds {
        let of = |curve: &[LossPoint]| loss_at_return_period(curve, years);
        LossBounds {
            least: of(&self.least),
            best: of(&self.curve),
            most: self.most.as_deref().map(of),
        }
    }

    /// The loss of a year on average.
    pub fn annual_loss(&self) -> LossBounds {
        LossBounds {
            least: self.bounds.0,
            best: self.expected_annual_loss,
            most: self.bounds.1,
        }
    }

    fn is_bound(&self) -> bool {
        self.annual_loss().is_bound()
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use freestand::fragility::FitKind;
    use freestand_input::problem::Problems;
    use freestand_study::run::no_progress;

    use super::*;
    use crate::fragility::FragilityRequest;
    use crate::fragility::{HazardSource, Measure};
    use crate::{RiskCurves, RiskReport, RiskRequest, risk};

    /// λ = 10⁻² (x/0.1 m/s)⁻², and 1000 for each object that overturns.
    fn risk_of(outcomes: &str) -> Result<RiskReport, Problems> {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        fs::write(path("o.csv"), outcomes).unwrap();
        fs::write(
            path("c.csv"),
            "id,repair_cost [AUD],replacement_cost [AUD]\na,10,1000\nb,10,1000\n",
        )
        .unwrap();
        let request = RiskRequest {
            curves: RiskCurves::Outcomes(FragilityRequest {
                outcomes: path("o.csv"),
                at: None,
                fit: FitKind::Ordered,
                shock: None,
                replicates: Some(0),
                seed: 1,
            }),
            hazard: HazardSource::PowerLaw {
                text: "k0=1e-2 /yr, k=2, reference=0.1 m/s".to_owned(),
                measure: Some(Measure::Pgv),
            },
            hazard_at: None,
            site_deg: None,
            list: Default::default(),
            inventory: Some(path("c.csv")),
            options: None,
            budget: None,
            horizon_years: None,
            discount_ratio: None,
            accepted_rate: None,
            years: None,
        };
        risk(&request, &no_progress)
    }

    const LEVELS: [f64; 3] = [0.1, 0.2, 0.4];
    /// Edges 0.1/√2, 0.1√2, 0.2√2: 2 − 0.5, 0.5 − 0.125 and 0.125 of a hundredth.
    const STRIPS: [f64; 3] = [0.015, 0.00375, 0.00125];

    /// Outcomes at [`LEVELS`], of each object in two motions.
    fn table(objects: &[(&str, [[&str; 2]; 3])]) -> String {
        let mut text = "object,motion,pgv [m/s],outcome\n".to_owned();
        for (id, outcomes) in objects {
            for (level, pair) in LEVELS.iter().zip(outcomes) {
                for (motion, outcome) in pair.iter().enumerate() {
                    text += &format!("{id},m{motion},{level},{outcome}\n");
                }
            }
        }
        text
    }

    const MIXED: [[&str; 2]; 3] = [
        ["rocked", "overturned"],
        ["overturned", "rocked"],
        ["overturned", "overturned"],
    ];

    /// What overturns in every run costs as often under common motions as independently.
    #[test]
    fn what_always_overturns_counts() {
        let report = risk_of(&table(&[("a", [["overturned"; 2]; 3]), ("b", MIXED)])).unwrap();
        let found = report.portfolio.unwrap();
        let all: f64 = STRIPS.iter().sum();
        for curve in [&found.curve, &found.independent] {
            assert_eq!((curve[0].loss, curve.len()), (1000.0, 2));
            // Sums of three strips.
            assert!(
                (curve[0].annual_rate / all - 1.0).abs() < 1e-12,
                "{curve:?}"
            );
        }
        let is_least = |doubt: &RiskDoubt| matches!(doubt, RiskDoubt::LeastAlone(_));
        assert!(!report.doubts.iter().any(is_least), "{:?}", report.doubts);
    }

    /// Without a curve an object counts with the least that is known, and that is said.
    #[test]
    fn an_object_without_a_curve_is_named() {
        let falling = [["overturned"; 2], ["rocked", "overturned"], ["rocked"; 2]];
        let bounded = [["rocked"; 2], ["rocked", "overturned"], ["overturned"; 2]];
        let report = risk_of(&table(&[("a", bounded), ("b", falling)])).unwrap();
        let both = RiskDoubt::LeastAlone(vec!["a".to_owned(), "b".to_owned()]);
        assert!(report.doubts.contains(&both), "{:?}", report.doubts);
        let found = report.portfolio.unwrap();
        // Only the strongest motions surely overturn a.
        assert!(
            (found.independent[0].annual_rate / STRIPS[2] - 1.0).abs() < 1e-12,
            "{:?}",
            found.independent
        );
    }

    /// A run that could not be calculated takes its world from all objects, and the other motion at
    /// that intensity counts twice as much.
    #[test]
    fn a_world_with_a_run_that_is_not_known_is_left_out() {
        let mut unknown = MIXED;
        unknown[1][0] = "unresolved";
        let known = [["rocked"; 2], ["overturned", "rocked"], ["overturned"; 2]];
        let report = risk_of(&table(&[("a", unknown), ("b", known)])).unwrap();
        let doubt = RiskDoubt::WorldsLeftOut {
            left_out: 1,
            worlds: 6,
        };
        assert!(report.doubts.contains(&doubt), "{:?}", report.doubts);
        let found = report.portfolio.unwrap();
        assert_eq!(found.worlds, 5);
        // At 0.2 m/s nothing overturns in the motion that is left.
        let expected = 1000.0 * (0.5 * STRIPS[0] + 2.0 * STRIPS[2]);
        assert!(
            (found.expected_annual_loss / expected - 1.0).abs() < 1e-12,
            "{}",
            found.expected_annual_loss
        );

        unknown[1][1] = "unresolved";
        let report = risk_of(&table(&[("a", unknown), ("b", known)])).unwrap();
        let why = NoPortfolio::NotCalculated(0.2);
        assert!(report.portfolio.is_none());
        assert!(
            report.doubts.contains(&RiskDoubt::NoPortfolio(why)),
            "{:?}",
            report.doubts
        );
        // A row that is not there at all is a mistake.
        let missing = table(&[("a", MIXED), ("b", known)]).replace("b,m1,0.2,rocked\n", "");
        assert!(
            risk_of(&missing)
                .unwrap_err()
                .to_string()
                .contains("object b has no outcome under motion m1 at 0.2")
        );
    }

    /// λ is 1/100, 1/400 and 1/1600 a year at the three intensities, of which only the highest overturns one
    /// object: 1000 is lost between once in 1600 and once in 400 years, and 2000 at most once in 1600.
    #[test]
    fn losses_at_return_periods_have_ends() {
        let falls = [["rocked"; 2], ["rocked"; 2], ["overturned"; 2]];
        let found = risk_of(&table(&[("a", falls), ("b", [["rocked"; 2]; 3])]))
            .unwrap()
            .portfolio
            .unwrap();
        let ends = |years| found.at_return_period(years);
        let loss = |least, best, most| LossBounds {
            least,
            best,
            most: Some(most),
        };
        // The strip of the highest intensity begins where λ is 1/800.
        assert_eq!(ends(390.0), loss(0.0, 0.0, 0.0));
        assert_eq!(ends(410.0), loss(0.0, 0.0, 1000.0));
        assert_eq!(ends(810.0), loss(0.0, 1000.0, 1000.0));
        assert_eq!(ends(1610.0), loss(1000.0, 1000.0, 2000.0));
        assert_eq!(ends(500.0), loss(0.0, 0.0, 1000.0));
        // Where one fails at the lowest intensity, weaker motions may cost anything.
        let report = risk_of(&table(&[("a", [["overturned"; 2]; 3]), ("b", falls)])).unwrap();
        assert_eq!(report.portfolio.unwrap().at_return_period(250.0).most, None);
    }

    #[test]
    fn outcomes_without_common_worlds_say_why() {
        let counts = "object,pgv [m/s],rocked,overturned\na,0.1,4,1\na,0.2,2,3\na,0.4,1,4\n";
        let one = "object,motion,pgv [m/s],outcome\na,m,0.1,rocked\na,n,0.1,overturned\n";
        for (text, why) in [
            (counts, NoPortfolio::Counts),
            (one, NoPortfolio::OneIntensity),
        ] {
            let report = risk_of(text).unwrap();
            assert!(report.portfolio.is_none());
            assert!(
                report.doubts.contains(&RiskDoubt::NoPortfolio(why)),
                "{:?}",
                report.doubts
            );
        }
    }
}
