//! Several sites in one file: each is an assessment of its own, with its place, its building and its list.

use std::path::Path;

use freestand_input::file::load;
use freestand_input::problem::{Problem, ProblemKind, Problems};
use freestand_input::quantity::shorten;
use freestand_input::words::nearest;
use freestand_input::written::Written;
use freestand_output::paths::is_device;
use serde_json::{Map, Value};
use toml_edit::{DocumentMut, Item, TomlError};

use super::{Assess, Meant};
use crate::files::Files;
use crate::job::SiteRun;
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
    }
}

/// A site and what is asked about it.
#[derive(Debug, Clone)]
pub struct Site {
    /// Its name, which is that of its folder.
    pub name: String,
    /// Its list, in its building.
    pub meant: Meant,
}

/// The sites of a file, each asked what `request` asks.
///
/// # Errors
/// All that is wrong with the file and with its sites; what a site has of its own and the request, too.
pub(crate) fn sites(request: &Assess, path: &Path, files: &Files) -> Result<Vec<Site>, Problems> {
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
        .find(|key| *key != "sites");
    if let Some(key) = strange {
        let message = format!("\"{}\" is not a table of a file of sites", shorten(key));
        problems.push(wrong(path, message, "write [sites.NAME] for each site"));
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
    let mut sites: Vec<Site> = Vec::new();
    for (name, item) in all {
        let of_site = |mut problem: Problem| {
            problem.message = format!("[sites.{}]: {}", shorten(name), problem.message);
            problem.path = problem.path.or_else(|| Some(path.to_owned()));
            problem
        };
        let taken = sites
            .iter()
            .any(|site| site.name.eq_ignore_ascii_case(name));
        if let Some(why) = not_a_folder(name).or(taken.then_some("two sites have this name")) {
            let hint = "give it a name of letters, digits, spaces, hyphens and dots: it is that of its folder";
            problems.push(of_site(Problem::value(why, hint)));
            continue;
        }
        match site(request, path, item, files) {
            Ok(meant) => sites.push(Site {
                name: name.to_owned(),
                meant,
            }),
            Err(found) => found
                .problems
                .into_iter()
                .for_each(|one| problems.push(of_site(one))),
        }
    }
    problems.finish(Some(sites))
}

/// Reads what each site needs, before any work.
///
/// # Errors
/// Everything that is wrong with any of them; costs in another currency than the budget.
pub fn read(sites: &[Site]) -> Result<Vec<SiteRun>, Problems> {
    let mut problems = Problems::default();
    let mut read = Vec::new();
    for site in sites {
        let found = site.meant.study().and_then(|study| {
            let inventory = site.meant.list.inventory(&study)?;
            let budget = site.meant.budget(&inventory)?;
            Ok(SiteRun {
                name: site.name.clone(),
                study,
                inventory,
                budget,
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
    problems.finish(Some(read))
}

/// The keys that a site has of its own.
fn own_keys() -> Vec<String> {
    keys::<SiteKeys>()
}

/// One site.
fn site(request: &Assess, path: &Path, item: &Item, files: &Files) -> Result<Meant, Problems> {
    let Some(table) = item.as_table_like() else {
        let hint = "write place = \"…\" and inventory = \"…\" below [sites.NAME]";
        return Err(Problem::format("is not a table", hint).into());
    };
    let mut entries = Map::new();
    for (key, item) in table.iter() {
        entries.insert(key.to_owned(), value(key, item)?);
    }
    let mut own: SiteKeys = from_entries(&entries)?;
    let mut problems = Problems::default();
    for key in &own.unknown {
        let known = own_keys();
        let near = nearest(key, &known.iter().map(String::as_str).collect::<Vec<_>>());
        let hint = match near {
            Some(near) => format!("did you mean {near}?"),
            None => format!("a site has {}", known.join(", ")),
        };
        problems.push(Problem::value(
            format!("\"{}\" is not known", shorten(key)),
            hint,
        ));
    }
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
    problems.finish(meant)
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

/// Why a folder cannot have this name on some system; `None`: it can.
fn not_a_folder(name: &str) -> Option<&'static str> {
    const MOST: usize = 100;
    let is_fine = |letter: char| letter.is_alphanumeric() || " -_.".contains(letter);
    if name.is_empty() || name.chars().count() > MOST || !name.chars().all(is_fine) {
        Some("no folder can have this name everywhere")
    } else if name.starts_with(['.', ' ']) || name.ends_with(['.', ' ']) {
        Some("it begins or ends with a dot or a space")
    } else if is_device(name) {
        Some("Windows keeps this name for a device")
    } else {
        None
    }
}

fn wrong(path: &Path, message: impl Into<String>, hint: &str) -> Problem {
    Problem::new(ProblemKind::Format, message)
        .in_file(path)
        .hint(hint)
        .of(&["sites"])
}

#[cfg(test)]
mod tests {
    use super::not_a_folder;

    #[test]
    fn a_site_has_a_name_that_a_folder_may_have() {
        for name in ["Messina", "Bogotá 2", "a.b", "comet", "auxiliary", "仙台"] {
            assert_eq!(not_a_folder(name), None, "{name}");
        }
        for name in [
            "", "a/b", "..", "con", "NUL.txt", "COM1", "lpt9.x", "a ", ".a", "a:b", "a*",
        ] {
            assert!(not_a_folder(name).is_some(), "{name}");
        }
        assert!(not_a_folder(&"a".repeat(101)).is_some());
    }
}
