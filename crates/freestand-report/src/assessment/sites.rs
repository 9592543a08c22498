//! Several sites in one answer: a table of all objects, the counts of each site, and one plan.

use std::path::Path;

use freestand_assess::result::Decision;
use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::words::counted;
use freestand_output::answer;
use freestand_output::answer::{ByName, table_of};
use freestand_output::facts;
use freestand_output::folder::OutputFolder;
use freestand_risk::budget::{BudgetPlan, PlanRow, SitesLosses, UnknownLosses};
use freestand_study::study::TitleBlock;

use super::csv::CSV_NAME;
use super::losses::{losses_text, why_unknown};
use super::orders::{PARTS_NAME, PARTS_PAGE, write_orders};
use super::plan::{ALTERNATIVES_NAME, PLAN_NAME, assumptions, plan_text_of_sites, sentences};
use super::told::JobReport;
use crate::figures::losses_figure;
use crate::signature::Signing;
use crate::table::table;

/// The file with the counts of each site.
pub const SITES_NAME: &str = "sites.csv";

/// The file with the losses of all sites together.
const LOSSES_NAME: &str = "losses.csv";

/// The figure of these losses.
const LOSSES_FIGURES: [&str; 2] = ["losses.svg", "losses.png"];

/// The files that all sites share.
pub const SHARED_NAMES: [&str; 9] = [
    CSV_NAME,
    SITES_NAME,
    LOSSES_NAME,
    LOSSES_FIGURES[0],
    LOSSES_FIGURES[1],
    PLAN_NAME,
    ALTERNATIVES_NAME,
    PARTS_NAME,
    PARTS_PAGE,
];

answer! {
    /// What became of the objects of a site.
    pub struct SiteReport {
        site: String = "site",
        report: JobReport = flat,
    }

    /// A measure of the plan over all sites.
    pub struct SitePlanRow {
        site: String = "site",
        row: PlanRow = flat,
    }

    /// What became of the objects of all sites; its fields are the keys of the JSON document.
    pub struct SitesReport {
        /// Rows of all inventories.
        objects: usize,
        /// Objects of all sites by decision.
        decisions: ByName<usize>,
        /// Each site, as an assessment of it alone tells.
        sites: Vec<SiteReport>,
        /// What the plan within a budget was asked, and what it leaves; `null`: no budget was given.
        budget: Option<BudgetPlan>,
        /// The measures of the plan over all sites.
        plan: Option<Vec<SitePlanRow>>,
        /// Every measure for every object of all sites.
        plan_alternatives: Option<Vec<SitePlanRow>>,
        /// What the plan does, one sentence each; empty: no budget was given.
        plan_sentences: Vec<String>,
        /// What it assumes, one sentence each.
        plan_assumptions: Vec<String>,
        /// What all sites lose together; `null`: no budget was given, or it is not known.
        losses: Option<SitesLosses>,
        /// Why it is not known.
        losses_unknown: Option<String>,
        /// The folder.
        out: String,
        /// The files in it.
        files: Vec<String>,
        /// The files of an earlier run that were removed from it.
        removed: Vec<String>,
    }
}

impl SitesReport {
    /// Of these sites, before there is a plan or a file.
    pub fn of(sites: Vec<SiteReport>, out: &Path) -> Self {
        let count = |one: Decision| {
            let all = sites.iter().map(|site| site.report.count(one) as usize);
            (one.name(), all.sum())
        };
        Self {
            objects: sites.iter().map(|site| site.report.objects).sum(),
            decisions: ByName(Decision::ALL.map(count).into()),
            sites,
            budget: None,
            plan: None,
            plan_alternatives: None,
            plan_sentences: Vec::new(),
            plan_assumptions: Vec::new(),
            losses: None,
            losses_unknown: None,
            out: out.display().to_string(),
            files: Vec::new(),
            removed: Vec::new(),
        }
    }

    /// With the plan over all sites; each measure with its site.
    #[must_use]
    pub fn planned(mut self, plan: BudgetPlan, sites: Vec<String>) -> Self {
        let rows = plan.rows.iter().cloned().zip(sites);
        let rows: Vec<SitePlanRow> = rows.map(|(row, site)| SitePlanRow { site, row }).collect();
        let planned = rows.iter().filter(|one| one.row.is_planned()).cloned();
        self.plan = Some(planned.collect());
        self.plan_alternatives = Some(rows);
        self.plan_sentences = sentences(&plan);
        self.plan_assumptions = assumptions(&plan);
        self.budget = Some(plan);
        self
    }

    /// With what all sites lose, or why that is not known.
    #[must_use]
    pub fn losing(mut self, losses: Result<SitesLosses, UnknownLosses>) -> Self {
        match losses {
            Ok(losses) => self.losses = Some(losses),
            Err(unknown) => self.losses_unknown = Some(why_unknown(&unknown)),
        }
        self
    }

    /// The warnings of all sites, each with its site.
    pub fn all_warnings(&self) -> Vec<String> {
        let of = |one: &SiteReport| {
            let site = one.site.clone();
            let warnings = one.report.all_warnings().into_iter();
            warnings.map(move |warning| format!("{site}: {warning}"))
        };
        self.sites.iter().flat_map(of).collect()
    }
}

/// Writes the files that all sites share; the folders of the sites are in `folder` already.
///
/// # Errors
/// A table of a site that cannot be read again, or a full disk.
pub fn write_sites(
    folder: &OutputFolder,
    report: &SitesReport,
    title: &TitleBlock,
    signing: Signing,
) -> Result<(), Problem> {
    let names: Vec<&str> = report.sites.iter().map(|one| one.site.as_str()).collect();
    objects(folder, &names)?;
    let rows = report.sites.iter().map(|one| {
        let counts = Decision::ALL.map(|decision| (decision, one.report.count(decision)));
        let facts = facts::Facts::default()
            .key("site", one.site.clone())
            .key("place", one.report.place_name.clone())
            .key("objects", one.report.objects);
        let facts = counts.into_iter().fold(facts, |facts, (decision, count)| {
            facts.key(decision.name(), count)
        });
        let mut losses = report.losses.iter().flat_map(|losses| &losses.sites);
        match losses.find(|own| own.site == one.site) {
            Some(own) => facts
                .key("latitude_deg", own.latitude_deg)
                .key("longitude_deg", own.longitude_deg)
                .key("annual_loss", own.annual_loss)
                .key("annual_paid", own.annual_paid)
                .key("annual_loss_is_at_least", own.annual_loss_is_at_least)
                .key("downtime_days_per_year", own.downtime_days_per_year),
            None => facts,
        }
    });
    folder.write(SITES_NAME, facts::table(rows)?.as_ref())?;
    if let Some(losses) = &report.losses {
        folder.write(LOSSES_NAME, table_of(&losses.rows)?.as_ref())?;
        let figure = losses_figure(losses)?;
        folder.write(LOSSES_FIGURES[0], figure.svg.as_bytes())?;
        folder.write(LOSSES_FIGURES[1], &figure.png)?;
    }
    if let (Some(plan), Some(all)) = (&report.plan, &report.plan_alternatives) {
        folder.write(PLAN_NAME, table_of(plan)?.as_ref())?;
        folder.write(ALTERNATIVES_NAME, table_of(all)?.as_ref())?;
    }
    if let (Some(plan), Some(all)) = (&report.budget, &report.plan_alternatives) {
        let sites: Vec<String> = all.iter().map(|row| row.site.clone()).collect();
        write_orders(folder, plan, Some(&sites), title, signing)?;
    }
    Ok(())
}

/// Writes `objects.csv` of all sites: that of each site, with its name before it. Columns that only some lists have
/// are empty for the others.
fn objects(folder: &OutputFolder, sites: &[&str]) -> Result<(), Problem> {
    let open = |site: &str| {
        let path = folder.path_of(&format!("{site}/{CSV_NAME}"))?;
        let problem = |error: csv::Error| {
            Problem::new(ProblemKind::Io, format!("cannot be read again: {error}")).in_file(&path)
        };
        let mut reader = csv::Reader::from_path(&path).map_err(problem)?;
        let header = reader.headers().map_err(problem)?.clone();
        Ok::<_, Problem>((reader, header))
    };
    let mut names: Vec<String> = Vec::new();
    for site in sites {
        let (_, header) = open(site)?;
        let new: Vec<String> = header
            .iter()
            .filter(|name| !names.iter().any(|known| known == name))
            .map(str::to_owned)
            .collect();
        names.extend(new);
    }
    let mut file = folder.begin(CSV_NAME)?;
    let head = std::iter::once("site").chain(names.iter().map(String::as_str));
    file.write(&line(head)?)?;
    for site in sites {
        let (reader, header) = open(site)?;
        let places: Vec<Option<usize>> = names
            .iter()
            .map(|name| header.iter().position(|own| own == name))
            .collect();
        for record in reader.into_records() {
            let record = record.map_err(|error| {
                Problem::new(
                    ProblemKind::Io,
                    format!("{site}: cannot be read again: {error}"),
                )
            })?;
            let cells = places
                .iter()
                .map(|place| place.and_then(|at| record.get(at)).unwrap_or(""));
            file.write(&line(std::iter::once(*site).chain(cells))?)?;
        }
    }
    file.finish()
}

/// A line of CSV.
fn line<'a>(cells: impl Iterator<Item = &'a str>) -> Result<Vec<u8>, Problem> {
    let mut writer = csv::WriterBuilder::new().from_writer(Vec::new());
    let failed = |error: &dyn std::fmt::Display| {
        Problem::new(
            ProblemKind::Computation,
            format!("a row is no CSV: {error}"),
        )
    };
    writer.write_record(cells).map_err(|error| failed(&error))?;
    writer.into_inner().map_err(|error| failed(&error))
}

/// What became of the objects of all sites, on the console.
pub fn sites_text(report: &SitesReport) -> String {
    let mut headings = vec!["site", "place", "objects"];
    headings.extend(Decision::ALL.map(Decision::name));
    let rows: Vec<Vec<String>> = report
        .sites
        .iter()
        .map(|one| {
            let place = one.report.place_name.clone().unwrap_or_default();
            let mut row = vec![one.site.clone(), place, one.report.objects.to_string()];
            row.extend(Decision::ALL.map(|decision| one.report.count(decision).to_string()));
            row
        })
        .collect();
    let mut text = table(&headings, &rows);
    text.push_str(&format!(
        "\n{} at {}\n",
        counted(report.objects, "object"),
        counted(report.sites.len(), "site")
    ));
    if let Some(plan) = &report.budget {
        let all = report.plan_alternatives.iter().flatten();
        let sites: Vec<String> = all.map(|row| row.site.clone()).collect();
        text.push_str(&format!("\n{}\n", plan_text_of_sites(plan, &sites)));
        // The report of no site has the plan over all of them.
        for assumed in assumptions(plan) {
            text.push_str(&format!("- {assumed}\n"));
        }
    }
    match (&report.losses, &report.losses_unknown) {
        (Some(losses), _) => text.push_str(&losses_text(losses)),
        (None, Some(why)) => text.push_str(&format!("\n{why}\n")),
        (None, None) => {}
    }
    let shared = report.files.iter().filter(|name| !name.contains('/'));
    let named: Vec<&str> = shared.map(String::as_str).collect();
    text.push_str(&format!(
        "\nFiles in {}: {}; and a folder for each site\n",
        report.out,
        named.join(", ")
    ));
    text
}
