//! What earthquakes cost at all sites together, and what an insurance pays of it.

use freestand::decision::strip_rates;
use freestand::risk::{
    Amounts, Dependence, Hazard, LossLevel, SIMULATED_YEARS, SimulatedLosses, SiteLosses, Terms,
    correlations, reached_once_in, simulate,
};
use freestand_assess::verdict::{Restrained, Wanted};
use freestand_input::problem::Problem;
use freestand_output::{answer, answer_of};
use freestand_records::tables::hazard::Coordinates;
use strum::IntoStaticStr;

use super::{Budget, Priced, rate};
use crate::costs::CostRow;
use crate::export::{Exposed, Files, exposure_of_sites};

/// How far earthquakes of sites belong together, where nobody states it: about the middle of the ranges of Jayaram and
/// Baker (2009), 8.5 to 41 km by period and ground. An assumption.
const ASSUMED_RANGE_KM: f64 = 20.0;

/// The return periods whose losses are stated \[years\].
const RETURN_PERIODS: [u32; 7] = [10, 25, 50, 100, 250, 500, 1000];

/// What the falls of all objects of a list cost.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Losses {
    /// In each world, by strength.
    levels: Vec<LossLevel>,
    /// Days that objects are missing a year, added up; `None`: the list has no downtime.
    downtime_days: Option<f64>,
    /// Whether weaker earthquakes, or objects without a verdict, add to it.
    is_at_least: bool,
}

impl Budget {
    /// `None`: the list has no costs.
    pub(super) fn losses(
        &self,
        objects: &[Wanted],
        found: &[Option<Restrained>],
        hazard: &Hazard,
    ) -> Option<Losses> {
        if !self.has_costs {
            return None;
        }
        let with_costs = || {
            let all = objects.iter().zip(found);
            all.filter_map(|(one, found)| {
                let cost = self.costs.get(&one.item.id)?;
                Some((f64::from(one.item.quantity), cost, found.as_ref()))
            })
        };
        let costing =
            || with_costs().filter_map(|(quantity, cost, found)| Some((quantity, cost, found?)));
        let mut found = Losses {
            levels: Vec::new(),
            downtime_days: (self.costs.values())
                .any(|cost| cost.downtime_days.is_some())
                .then_some(0.0),
            // Nothing is known of an object without a verdict.
            is_at_least: with_costs().any(|(_, cost, found)| cost.has_costs() && found.is_none()),
        };
        let Some((_, _, first)) = costing().next() else {
            return Some(found);
        };
        let intensities: Vec<f64> = first.free.iter().map(|one| one.intensity_ratio).collect();
        let rates = strip_rates(&intensities, |ratio| hazard.annual_rate(ratio)).ok()?;
        for (level, annual_rate) in rates.into_iter().enumerate() {
            let falls = costing().filter_map(|(_, _, one)| one.falls.get(level));
            let mut losses = vec![0.0; falls.map(Vec::len).max()?];
            for (quantity, cost, one) in costing() {
                // Objects that take long to follow have fewer worlds: theirs are repeated.
                let falls = one.falls.get(level).into_iter().flatten().cycle();
                for (loss, _) in losses.iter_mut().zip(falls).filter(|(_, falls)| **falls) {
                    *loss += quantity * cost.overturned();
                }
            }
            found.levels.push(LossLevel {
                annual_rate,
                losses,
            });
        }
        for (quantity, cost, one) in costing() {
            let (falls, is_at_least) = rate(&one.free, hazard)?;
            found.is_at_least |= is_at_least && cost.has_costs();
            if let (Some(sum), Some(days)) = (&mut found.downtime_days, cost.downtime_days) {
                *sum += quantity * falls * days;
            }
        }
        Some(found)
    }
}

/// What is insured, and how earthquakes of sites belong together.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Insured {
    /// What the policy pays of what the sites are paid together in an earthquake.
    pub policy: Terms,
    /// r of the correlation exp(−3h/r) \[km\]; `None`: 20 km, assumed.
    pub range_km: Option<f64>,
}

/// A site and its losses.
pub struct InsuredSite<'a> {
    /// Its name.
    pub name: &'a str,
    /// Where it is.
    pub at: Option<Coordinates>,
    /// What is paid of its loss in an earthquake.
    pub terms: Terms,
    /// Its budget, with what falls cost there.
    pub budget: &'a Budget,
    /// What its list costs.
    pub priced: &'a Priced,
}

/// Why losses of all sites are not known.
#[derive(Debug, Clone, PartialEq)]
pub enum UnknownLosses {
    /// No yearly rate is known at this site.
    NoRates(String),
    /// The list of this site has no costs of a fall.
    NoCosts(String),
}

/// How earthquakes of several sites belong together.
#[derive(Debug, Clone, Copy, PartialEq, Eq, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum Together {
    /// Each is at one site.
    Independent,
    /// Each is at all sites, as alike as their distance makes it.
    Correlated,
    /// The sites are as one.
    Common,
}

impl Together {
    /// The name in outputs.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

/// A loss of all sites that is reached once in so many years.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LossRow {
    /// How earthquakes of the sites belong together.
    pub dependence: Together,
    /// How rare \[years\].
    pub return_period_years: u32,
    /// In one earthquake.
    pub event: Amounts,
    /// In one year.
    pub year: Amounts,
}

answer_of!(LossRow as row {
    /// `independent`: each earthquake is at one site; `correlated`: it is at all of them, as alike as their distance
    /// makes it; `common`: the sites are as one.
    dependence: &'static str = row.dependence.name();
    return_period_years: usize = row.return_period_years as usize;
    /// Of all sites in one earthquake.
    event_loss: f64 = row.event.loss;
    /// What deductibles and limits leave of it.
    event_paid: f64 = row.event.paid;
    /// Of all sites in one year.
    year_loss: f64 = row.year.loss;
    year_paid: f64 = row.year.paid;
});

answer! {
    /// What a site loses a year on average.
    pub struct LossOfSite {
        /// Its name.
        site: String,
        /// Where it is, on WGS 84.
        latitude_deg: Option<f64>,
        /// East positive.
        longitude_deg: Option<f64>,
        /// On average.
        annual_loss: f64,
        /// What its deductible and its limit leave of it.
        annual_paid: f64,
        /// Whether weaker earthquakes, or objects without a verdict, add to it.
        annual_loss_is_at_least: bool,
        /// Days that objects are missing, added up; `null`: the list has no downtime.
        downtime_days_per_year: Option<f64>,
    }

    /// What all sites lose together.
    pub struct SitesLosses {
        /// That of the budget.
        currency: String,
        /// Of all sites, on average.
        annual_loss: f64,
        /// Whether weaker earthquakes, or objects without a verdict, add to it.
        annual_loss_is_at_least: bool,
        /// r of the correlation exp(−3h/r); `null`: the coordinates of a site are not known.
        correlation_range_km: Option<f64>,
        /// Whether nobody states it.
        correlation_range_is_assumed: bool,
        /// Whether there is a deductible or a limit.
        is_insured: bool,
        /// From which the rows are.
        simulated_years: usize,
        /// Each site.
        sites: Vec<LossOfSite>,
        /// Losses by dependence and return period.
        rows: Vec<LossRow>,
    }
}

/// The exposure of all sites for OpenQuake; `None`: the coordinates of one are not known.
///
/// # Errors
/// A table that cannot be made.
pub fn exposure(sites: &[InsuredSite]) -> Result<Option<Files>, Problem> {
    let mut objects = Vec::new();
    for site in sites {
        let Some(at) = site.at else { return Ok(None) };
        let mut costs: Vec<&CostRow> = site.budget.costs.values().collect();
        costs.sort_by_key(|cost| cost.line);
        objects.extend(costs.into_iter().map(|cost| Exposed {
            site: site.name,
            at,
            cost,
        }));
    }
    let currency = sites.first().map_or("", |site| &site.budget.currency);
    exposure_of_sites(currency, &objects).map(Some)
}

/// What all sites lose, if their earthquakes are independent, correlated and common.
///
/// # Errors
/// Why it is not known.
pub fn losses_over_sites(
    sites: &[InsuredSite],
    insured: Insured,
    seed: u64,
) -> Result<SitesLosses, UnknownLosses> {
    let mut all: Vec<SiteLosses> = Vec::new();
    let mut told: Vec<LossOfSite> = Vec::new();
    for site in sites {
        let name = || site.name.to_owned();
        if !site.priced.has_costs {
            return Err(UnknownLosses::NoCosts(name()));
        }
        let Some(losses) = &site.priced.losses else {
            return Err(UnknownLosses::NoRates(name()));
        };
        let own = SiteLosses {
            levels: losses.levels.clone(),
            terms: site.terms,
        };
        told.push(LossOfSite {
            site: name(),
            latitude_deg: site.at.map(|at| at.latitude_deg),
            longitude_deg: site.at.map(|at| at.longitude_deg),
            annual_loss: own.expected_loss_per_year(),
            annual_paid: own.expected_payment_per_year(),
            annual_loss_is_at_least: losses.is_at_least,
            downtime_days_per_year: losses.downtime_days,
        });
        all.push(own);
    }
    let range_km = insured.range_km.unwrap_or(ASSUMED_RANGE_KM);
    let places: Option<Vec<Coordinates>> = sites.iter().map(|site| site.at).collect();
    let distances_km = |places: Vec<Coordinates>| -> Vec<Vec<f64>> {
        let from = |one: &Coordinates| places.iter().map(|two| one.distance_km(*two)).collect();
        places.iter().map(from).collect()
    };
    let correlated = places.map(|places| correlations(&distances_km(places), range_km));
    let is_placed = correlated.is_some();
    let dependences = [
        (Together::Independent, Some(Dependence::Independent)),
        (Together::Correlated, correlated.map(Dependence::Correlated)),
        (Together::Common, Some(Dependence::Common)),
    ];
    let mut rows = Vec::new();
    for (dependence, how) in dependences {
        let Some(how) = how else { continue };
        let SimulatedLosses { events, totals } = simulate(&all, &how, insured.policy, seed);
        rows.extend(RETURN_PERIODS.map(|return_period_years| {
            let reached = |all: &[Amounts]| {
                let years = f64::from(return_period_years);
                Amounts {
                    loss: reached_once_in(years, all.iter().map(|one| one.loss)),
                    paid: reached_once_in(years, all.iter().map(|one| one.paid)),
                }
            };
            LossRow {
                dependence,
                return_period_years,
                event: reached(&events),
                year: reached(&totals),
            }
        }));
    }
    let terms = sites.iter().map(|site| site.terms);
    Ok(SitesLosses {
        currency: sites
            .first()
            .map_or_else(String::new, |site| site.budget.currency.clone()),
        annual_loss: told.iter().map(|one| one.annual_loss).sum(),
        annual_loss_is_at_least: told.iter().any(|one| one.annual_loss_is_at_least),
        correlation_range_km: is_placed.then_some(range_km),
        correlation_range_is_assumed: insured.range_km.is_none(),
        is_insured: terms.chain([insured.policy]).any(|one| one != Terms::ALL),
        simulated_years: SIMULATED_YEARS as usize,
        sites: told,
        rows,
    })
}
