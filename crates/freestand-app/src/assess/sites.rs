//! Several sites in one file: each is an assessment of its own, with its place, its building and its list.

use std::collections::BTreeSet;
use std::path::Path;

use freestand::risk::Terms;
use freestand_input::file::load;
use freestand_input::file_names;
use freestand_input::problem::{Problem, ProblemKind, Problems};
use freestand_input::quantity::{Dimension, parse_positive, shorten};
use freestand_input::words::nearest;
use freestand_input::written::Written;
use freestand_inventory::currency_code;
use freestand_report::assessment::ORDERS_FOLDER;
use freestand_risk::amount;
use freestand_risk::budget::Insured;
use serde_json::{Map, Value};
use toml_edit::{DocumentMut, Item, TomlError};

use super::{Assess, Meant};
use crate::files::Files;
use crate::job::{EXPOSURE, SiteRun, SitesRun};
use crate::place::{FaultKeys, PlaceKeys};
use crate::request::{Question as _, Request as _, from_entries, keys, request};

request! { question
    /// What a site has of its own.
    pub struct SiteKeys {
        /// Study file (TOML) with hazard, building and settings
        #[arg(long)]
        pub study: Option<Written>,
        /// A place.
        #[command(flatten)]
        pub hazard: PlaceKeys,
        /// Its fault.
        #[command(flatten)]
        pub fault: FaultKeys,
        /// Inventory (CSV or XLSX)
        #[arg(long)]
        pub inventory: Option<Written>,
        /// Sheet of the workbook
        #[arg(long)]
        pub sheet: Option<Written>,
        /// Number of storeys
        #[arg(long)]
        pub storeys: Option<Written>,
        /// What its insurance does not pay of a loss in one earthquake
        #[arg(long)]
        pub deductible: Option<Written>,
        /// The most that its insurance pays in one earthquake
        #[arg(long)]
        pub limit: Option<Written>,
    }
}

request! { question
    /// What holds for all sites together.
    pub struct PolicyKeys {
        /// What the policy does not pay of what the sites are paid together in one earthquake
        #[arg(long)]
        pub deductible: Option<Written>,
        /// The most that the policy pays in one earthquake
        #[arg(long)]
        pub limit: Option<Written>,
        /// r of the correlation exp(-3h/r) between sites at the distance h
        #[arg(long)]
        pub correlation_range: Option<Written>,
    }
}

/// The sites of a file.
#[derive(Debug, Clone)]
pub struct Sites {
    /// Each of them.
    pub all: Vec<Site>,
    /// What holds for all of them together.
    pub insured: Insured,
}

/// A site and what is asked about it.
#[derive(Debug, Clone)]
pub struct Site {
    /// Its name, which is that of its folder.
    pub name: String,
    /// Its list, in its building.
    pub meant: Meant,
    /// What its insurance pays.
    pub terms: Terms,
}

/// The folders beside those of the sites.
const SHARED_FOLDERS: [&str; 2] = [ORDERS_FOLDER, EXPOSURE];

/// The sites of a file, each asked what `request` asks.
///
/// # Errors
/// All that is wrong with the file and with its sites; what a site has of its own and the request, too.
pub(crate) fn sites(request: &Assess, path: &Path, files: &Files) -> Result<Sites, Problems> {
    let mut problems = Problems::default();
    let words = request.words();
    for key in own_keys().iter().filter(|key| words.get(key).is_some()) {
        let message = "each site has its own";
        let hint = format!("write it under the sites of {}", path.display());
        problems.push(Problem::value(message, hint).of_key(key.clone()));
    }
    let bytes = load(path).map_err(|problem| problem.of(&["sites"]))?;
    let text = String::from_utf8(bytes)
        .map_err(|_| wrong(path, "is not UTF-8, which TOML must be", "save it as UTF-8"))?;
    let document: DocumentMut = text.parse().map_err(|error: TomlError| {
        let message = format!("not TOML: {}", error.message().replace('`', "\""));
        wrong(
            path,
            message,
            "write [sites.NAME], and below it place = \"…\" and inventory = \"…\"",
        )
    })?;
    let strange = document
        .iter()
        .map(|(key, _)| key)
        .find(|key| !["sites", "policy"].contains(key));
    if let Some(key) = strange {
        let message = format!("\"{}\" is not a table of a file of sites", shorten(key));
        let hint = "write [sites.NAME] for each site, and [policy] for all of them";
        problems.push(wrong(path, message, hint));
    }
    let all = document.get("sites").and_then(Item::as_table_like);
    let all: Vec<(&str, &Item)> = all.into_iter().flat_map(|all| all.iter()).collect();
    if all.is_empty() {
        problems.push(wrong(
            path,
            "there is no site",
            "write [sites.NAME] for each site",
        ));
    }
    let of_table = |table: &str, mut problem: Problem| {
        problem.message = format!("[{}]: {}", shorten(table), problem.message);
        problem.path = problem.path.or_else(|| Some(path.to_owned()));
        problem
    };
    let budget = request.budget.as_ref().map(|text| amount(&text.text()));
    let budget = budget
        .transpose()
        .map_err(|problem| problem.of(&["budget"]))?;
    let currency = budget.map(|(_, currency)| currency);
    let insured = match document
        .get("policy")
        .map(|item| policy(item, currency.as_deref()))
    {
        Some(Err(found)) => {
            let found = found.problems.into_iter();
            found.for_each(|one| problems.push(of_table("policy", one)));
            None
        }
        Some(Ok(insured)) => Some(insured),
        None => Some(Insured {
            policy: Terms::ALL,
            range_km: None,
        }),
    };
    let mut sites: Vec<Site> = Vec::new();
    for (name, item) in all {
        let of_site = |problem: Problem| of_table(&format!("sites.{name}"), problem);
        let taken = sites
            .iter()
            .any(|site| file_names::same_file(&site.name) == file_names::same_file(name));
        let is_shared = SHARED_FOLDERS.contains(&file_names::same_file(name).as_str());
        let why = file_names::unfit(name)
            .or(taken.then_some("two sites have this name"))
            .or(is_shared.then_some("a folder of this name has what the sites share"));
        if let Some(why) = why {
            let hint = "give it a name of letters, digits, spaces, hyphens, underscores and dots: its folder has this name";
            problems.push(of_site(Problem::value(why, hint)));
            continue;
        }
        match site(request, path, item, currency.as_deref(), files) {
            Ok((meant, terms)) => sites.push(Site {
                name: name.to_owned(),
                meant,
                terms,
            }),
            Err(found) => found
                .problems
                .into_iter()
                .for_each(|one| problems.push(of_site(one))),
        }
    }
    problems.finish(insured.map(|insured| Sites {
        all: sites,
        insured,
    }))
}

/// Reads what each site needs, before any work.
///
/// # Errors
/// Everything that is wrong with any of them; costs in another currency than the budget.
pub fn read(sites: &Sites) -> Result<SitesRun, Problems> {
    let mut problems = Problems::default();
    let mut read = Vec::new();
    for site in &sites.all {
        let found = site.meant.study().and_then(|study| {
            let inventory = site.meant.list.inventory(&study)?;
            let budget = site.meant.budget(&inventory)?;
            Ok(SiteRun {
                name: site.name.clone(),
                study,
                inventory,
                budget,
                terms: site.terms,
            })
        });
        match found {
            Ok(one) => read.push(one),
            Err(found) => found.problems.into_iter().for_each(|mut problem| {
                problem.message = format!("[sites.{}]: {}", site.name, problem.message);
                problems.push(problem);
            }),
        }
    }
    problems.finish(Some(SitesRun {
        sites: read,
        insured: sites.insured,
    }))
}

/// The keys that a site has of its own.
fn own_keys() -> Vec<String> {
    keys::<SiteKeys>()
}

/// The keys of a table, each once.
fn entries(item: &Item, hint: &str) -> Result<Map<String, Value>, Problem> {
    let table = item.as_table_like();
    let table = table.ok_or_else(|| Problem::format("is not a table", hint))?;
    let all = table.iter();
    all.map(|(key, item)| Ok((key.to_owned(), value(key, item)?)))
        .collect()
}

/// Keys that a table does not have.
fn note_unknown(problems: &mut Problems, unknown: &BTreeSet<String>, what: &str, known: &[String]) {
    for key in unknown {
        let near = nearest(key, &known.iter().map(String::as_str).collect::<Vec<_>>());
        let hint = match near {
            Some(near) => format!("did you mean {near}?"),
            None => format!("{what} has {}", known.join(", ")),
        };
        let message = format!("\"{}\" is not known", shorten(key));
        problems.push(Problem::value(message, hint));
    }
}

/// A key of losses, which are calculated with a budget alone.
fn without_budget(key: &str) -> Problem {
    let message = format!("{key} applies to losses, which are calculated only with a budget");
    Problem::value(message, "give `budget`, or leave it out")
}

/// What an insurance pays, in the currency of the budget.
fn terms(
    problems: &mut Problems,
    currency: Option<&str>,
    deductible: Option<&Written>,
    limit: Option<&Written>,
) -> Terms {
    let mut read = |key: &str, written: Option<&Written>| {
        let text = written?.text();
        let Some(currency) = currency else {
            problems.push(without_budget(key));
            return None;
        };
        let of_key = |mut problem: Problem| {
            problem.message = format!("{key}: {}", problem.message);
            problem
        };
        match amount(&text) {
            Ok((number, own)) if currency_code(&own) == currency_code(currency) => Some(number),
            Ok((_, own)) => {
                let message = format!(
                    "{key} is in {}, and the budget in {}",
                    shorten(&own),
                    shorten(currency)
                );
                let hint = format!("give it in {}", shorten(currency));
                problems.push(Problem::value(message, hint));
                None
            }
            Err(problem) => {
                problems.push(of_key(problem));
                None
            }
        }
    };
    Terms {
        deductible: read("deductible", deductible).unwrap_or(Terms::ALL.deductible),
        limit: read("limit", limit).unwrap_or(Terms::ALL.limit),
    }
}

/// What holds for all sites together.
fn policy(item: &Item, currency: Option<&str>) -> Result<Insured, Problems> {
    let hint = "write deductible = \"…\" and limit = \"…\" below [policy]";
    let own: PolicyKeys = from_entries(&entries(item, hint)?)?;
    let mut problems = Problems::default();
    note_unknown(
        &mut problems,
        &own.unknown,
        "a policy",
        &keys::<PolicyKeys>(),
    );
    let policy = terms(
        &mut problems,
        currency,
        own.deductible.as_ref(),
        own.limit.as_ref(),
    );
    if own.correlation_range.is_some() && currency.is_none() {
        problems.push(without_budget("correlation_range"));
    }
    let range = own.correlation_range.as_ref().map(Written::text);
    let range_m = range.map(|text| parse_positive(&text, Dimension::Length, "correlation_range"));
    let range_m = range_m.transpose().map_err(|mut problem| {
        problem.message = format!("correlation_range: {}", problem.message);
        problem
    });
    let range_m = problems.keep(range_m).flatten();
    problems.finish(Some(Insured {
        policy,
        range_km: range_m.map(|range_m| 1e-3 * range_m),
    }))
}

/// One site.
fn site(
    request: &Assess,
    path: &Path,
    item: &Item,
    currency: Option<&str>,
    files: &Files,
) -> Result<(Meant, Terms), Problems> {
    let hint = "write place = \"…\" and inventory = \"…\" below [sites.NAME]";
    let mut own: SiteKeys = from_entries(&entries(item, hint)?)?;
    let mut problems = Problems::default();
    note_unknown(&mut problems, &own.unknown, "a site", &own_keys());
    let (deductible, limit) = (own.deductible.take(), own.limit.take());
    let terms = terms(&mut problems, currency, deductible.as_ref(), limit.as_ref());
    // A file is named from the folder of the file of sites.
    let folder = path.parent().unwrap_or(Path::new(""));
    let named = [&mut own.study, &mut own.inventory, &mut own.hazard.spectrum];
    for name in named.into_iter().flatten() {
        *name = Written::Text(folder.join(name.text()).display().to_string());
    }
    if own.inventory.is_none() && own.study.is_none() {
        let hint = "write inventory = \"list.xlsx\" below [sites.NAME], or name a study that names its list";
        problems.push(Problem::value("it has no list", hint));
    }
    let mut one = request.clone();
    one.sites = None;
    let list = &mut one.list;
    list.study = own.study;
    list.hazard = own.hazard;
    list.fault = own.fault;
    list.inventory = own.inventory;
    list.storeys = own.storeys;
    list.cells.sheet = own.sheet;
    let meant = problems.keep(one.resolve(files));
    problems.finish(meant.map(|meant| (meant, terms)))
}

/// A value of a site: a text, a number, or yes or no.
fn value(key: &str, item: &Item) -> Result<Value, Problem> {
    let found = item.as_value().and_then(|value| {
        let number = value.as_integer().map(Value::from);
        let number = number.or_else(|| value.as_float().map(Value::from));
        let text = value.as_str().map(Value::from);
        number.or(text).or_else(|| value.as_bool().map(Value::from))
    });
    found.ok_or_else(|| {
        let message = format!("{key} must be a text or a number");
        Problem::format(message, "write it as place = \"Wellington\" or storeys = 6")
    })
}

fn wrong(path: &Path, message: impl Into<String>, hint: &str) -> Problem {
    Problem::new(ProblemKind::Format, message)
        .in_file(path)
        .hint(hint)
        .of(&["sites"])
}
