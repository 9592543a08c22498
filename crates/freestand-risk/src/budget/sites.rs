//! One plan for several sites.

use freestand_study::run::Progress;

use super::{Budget, BudgetPlan, Priced};

/// A site whose objects one plan holds.
#[derive(Debug)]
pub struct PlannedSite<'b> {
    /// Its name.
    pub name: String,
    /// What is asked.
    pub budget: &'b Budget,
    /// Its objects.
    pub priced: Priced,
}

/// One plan for the objects of several sites, of which the first says what is asked, and the site of each of its
/// rows. Where the yearly rates of a site are not known, falls in the earthquakes of their studies count for all:
/// a fall a year and a fall in one earthquake are no sum. `None`: there is no site.
pub fn plan_over_sites(
    sites: Vec<PlannedSite>,
    progress: Progress,
) -> Option<(BudgetPlan, Vec<String>)> {
    let budget = sites.first()?.budget;
    let mut all = Priced {
        rows: Vec::new(),
        objects: Vec::new(),
        has_rates: sites.iter().all(|site| site.priced.has_rates),
        extends: sites.iter().any(|site| site.priced.extends),
        has_costs: sites.iter().any(|site| site.priced.has_costs),
        losses: None,
    };
    let mut names: Vec<String> = Vec::new();
    for PlannedSite { name, priced, .. } in sites {
        let before = all.objects.len();
        all.objects.extend(priced.objects);
        names.resize(all.objects.len(), name);
        let numbered = priced.rows.into_iter();
        all.rows
            .extend(numbered.map(|(object, row)| (before + object, row)));
    }
    if !all.has_rates {
        for (_, row) in &mut all.rows {
            (row.rates, row.losses, row.benefit) = (None, None, None);
        }
    }
    let (plan, numbers) = budget.chosen(all, progress);
    let sites = numbers.into_iter().map(|number| names[number].clone());
    Some((plan, sites.collect()))
}
