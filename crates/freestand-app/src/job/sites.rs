//! Several sites in one run: each is assessed into a folder of its own, and what they share beside these.

use std::cell::RefCell;
use std::path::{Path, PathBuf};

use freestand::risk::Terms;
use freestand_input::problem::{Problem, Problems};
use freestand_inventory::Inventory;
use freestand_output::folder::{MANIFEST, OutputFolder};
use freestand_output::json::document;
use freestand_report::assessment::{SHARED_NAMES, SiteReport, SitesReport, write_sites};
use freestand_risk::budget::{
    Budget, Insured, InsuredSite, PlannedSite, exposure, losses_over_sites, plan_over_sites,
};
use freestand_study::resolve::motion_paths;
use freestand_study::run::Progress;
use freestand_study::study::Study;
use serde_json::json;

use super::{Beside, Job, Spending, Told, assess_telling};

/// Schema of the document of several sites.
pub const SITES_SCHEMA: &str = "freestand.assess.sites/1";

/// The folder of the exposure for OpenQuake.
pub(crate) const EXPOSURE: &str = "openquake";

/// A site with everything that its assessment needs.
pub struct SiteRun {
    /// Its name, which is that of its folder.
    pub name: String,
    /// Its building and its hazard.
    pub study: Study,
    /// Its list.
    pub inventory: Inventory,
    /// The budget, with what its list says of costs.
    pub budget: Option<Budget>,
    /// What its insurance pays.
    pub terms: Terms,
}

/// Several sites.
pub struct SitesRun {
    /// Each of them.
    pub sites: Vec<SiteRun>,
    /// What holds for all of them together.
    pub insured: Insured,
}

/// Assesses every site into a folder of its name in `target`, and writes beside them the table of all objects and the
/// plan over all sites. A run that is stopped leaves nothing.
///
/// # Errors
/// As [`assess_telling`], and a stop.
pub fn assess_sites(
    run: &SitesRun,
    target: &Path,
    job: &Job,
    progress: Progress,
) -> Result<SitesReport, Problems> {
    let sites = &run.sites;
    let inputs = sites.iter().flat_map(|site| {
        let source = site.study.source.iter().cloned();
        source
            .chain(motion_paths(&site.study))
            .chain([site.inventory.path.clone()])
    });
    let folder = OutputFolder::stage(target, job.force, &inputs.collect::<Vec<PathBuf>>())?
        .of_command(SITES_SCHEMA)?;
    let names = SHARED_NAMES.iter().chain([&MANIFEST]);
    folder.check(&names.map(|name| (*name).to_owned()).collect::<Vec<_>>())?;
    let mut reports = Vec::new();
    let mut priced = Vec::new();
    for site in sites {
        let into = folder.place_for(&format!("{}/{MANIFEST}", site.name))?;
        let into = into.parent().unwrap_or(&into);
        let costs = RefCell::new(None);
        let spending = site.budget.as_ref();
        let beside = Beside {
            spending: spending.map(|budget| Spending::Priced(budget, &costs)),
            earlier: None,
        };
        let report = assess_telling(
            &site.study,
            &site.inventory,
            into,
            job,
            beside,
            Told::default(),
            progress,
        )?;
        if report.interrupted {
            return Err(Problem::stopped().into());
        }
        let of_site = site.budget.as_ref().zip(costs.into_inner());
        priced.extend(of_site.map(|(budget, priced)| PlannedSite {
            name: site.name.clone(),
            budget,
            priced,
        }));
        reports.push(SiteReport {
            site: site.name.clone(),
            report,
        });
    }
    let mut report = SitesReport::of(reports, target);
    let mut exposed = None;
    if let Some(first) = sites.first().filter(|_| !priced.is_empty()) {
        let insured = sites.iter().zip(&priced).map(|(site, planned)| {
            let target = site.study.ground.code_spectrum();
            let place = target.and_then(|target| target.place.as_ref());
            InsuredSite {
                name: &site.name,
                at: place.and_then(|place| place.coordinates),
                terms: site.terms,
                budget: planned.budget,
                priced: &planned.priced,
            }
        });
        let seed = first.study.assessment.seed;
        let insured: Vec<InsuredSite> = insured.collect();
        report = report.losing(losses_over_sites(&insured, run.insured, seed));
        exposed = exposure(&insured)?;
    }
    if let Some((plan, names)) = plan_over_sites(priced, progress) {
        report = report.planned(plan, names);
    }
    // The folders of the sites were made where they do not stay.
    for one in &mut report.sites {
        one.report.out = target.join(&one.site).display().to_string();
    }
    let title = sites.first().map(|site| site.study.outputs.title.clone());
    write_sites(&folder, &report, &title.unwrap_or_default(), job.signing)?;
    for (name, bytes) in exposed.into_iter().flatten() {
        folder.write(&format!("{EXPOSURE}/{name}"), &bytes)?;
    }
    report.files = folder.names()?;
    report.files.push(MANIFEST.to_owned());
    report.files.sort_unstable();
    let body = json!({
        "version": env!("CARGO_PKG_VERSION"),
        "complete": true,
        "objects": report.objects,
        "decisions": report.decisions,
        "sites": sites.iter().map(|site| &site.name).collect::<Vec<_>>(),
        "files": report.files,
    });
    let manifest = document(SITES_SCHEMA, &body, &report.all_warnings())?;
    folder.write(MANIFEST, manifest.as_bytes())?;
    report.removed = folder.commit()?.removed;
    Ok(report)
}
