//! `assess`: which objects of a list must be restrained.

pub mod sites;

use std::path::PathBuf;

use crate::job::Job;
use freestand_assess::result::Decision;
use freestand_input::problem::{Problem, Problems};
use freestand_input::word_reader::WordReader;
use freestand_input::written::Written;
use freestand_inventory::Inventory;
use freestand_report::assessment::Earlier;
use freestand_report::signature::Signing;
use freestand_risk::budget::{Budget, BudgetRequest};
use freestand_risk::{amount, years};
use freestand_study::study::{Study, TitleBlock};
use sites::Sites;

use crate::files::Files;
use crate::list::{ListKeys, ListMeant};
use crate::request::{Question, Request as _, discount, one_of, path, reader, request, seed};

/// The schema of the response.
pub use crate::job::SCHEMA;

request! { question
    /// A list in the building of a study.
    pub struct Assess {
        /// The study and the list.
        #[command(flatten)]
        pub list: ListKeys,
        /// File of sites (TOML), each `[sites.NAME]` with place, storeys, study and inventory of its own: one table,
        /// and with a budget one plan, over all of them
        pub sites = "FILE.toml",
        /// Continue an earlier run in the same folder
        pub resume = switch,
        /// Tables to write besides objects.csv, assessment.xlsx and report.html [default: csv]
        #[arg(long, value_name = "FORMAT", value_delimiter = ',', value_parser = one_of(TABLES))]
        pub format: Vec<Written>,
        /// Also write outcomes.csv: what happened to every object in every world, by each model
        pub outcomes = switch,
        /// Number of objects, the most urgent first, that get a page in the report [default: 200]
        pub pages = "N",
        /// Print the card of every object too, where the report is printed
        pub cards = switch under "The report",
        /// Date on the report [default: a line to fill in]
        pub date = "DATE" under "The report",
        /// Who prepared the report [default: a line to fill in]
        pub preparer = "NAME" under "The report",
        /// Revision of the report [default: a line to fill in]
        pub revision = "TEXT" under "The report",
        /// Whoever signs has confirmed the values that are quoted from memory: without it the report and the work orders
        /// are drafts where they rest on one
        pub allow_recalled = switch under "The report",
        /// Folder of an earlier assessment: the report says what is new, gone, done or worse since then
        pub since = "DIR" under "The report",
        /// End with status 1 if an object gets this verdict; give it once for each verdict
        #[arg(long, value_name = "VERDICT", value_parser = one_of(VERDICTS))]
        pub fail_on: Vec<Written>,

        /// The most that restraints may cost, such as "20000 NZD": also plan what to restrain, life safety first
        pub budget = "AMOUNT" under "The plan",
        /// Your own restraints (CSV); its entries replace built-in entries with the same id
        pub restraints = "FILE.csv" under "The plan",
        /// Years over which the savings of restraints count [default: 50 yr, assumed]
        #[arg(long = "horizon", value_name = "YEARS", help_heading = "The plan")]
        pub horizon_years: Option<Written>,
        /// Discount rate per year, compounded continuously [default: 3 %, assumed]
        pub discount = "RATIO" under "The plan",

        /// Seed of the random numbers.
        #[arg(skip)]
        pub seed: Option<Written>,
    }
}

/// Tables, and whether each is one in Parquet.
const TABLES: &[(bool, &str, &str)] = &[
    (false, "csv", "objects.csv, always written"),
    (true, "parquet", "objects.parquet"),
];

/// The verdicts by their names in outputs.
const VERDICTS: &[(Decision, &str, &str)] = &[
    (Decision::Restrain, "restrain", "Fix it to the building"),
    (Decision::Soften, "soften", "Put it on a softer pad"),
    (
        Decision::Lock,
        "lock",
        "Lock it, tether it, or give it room",
    ),
    (Decision::NoVerdict, "no-verdict", "Data are missing"),
    (Decision::Leave, "leave", "Leave it as it is"),
];

/// What is asked.
#[derive(Debug, Clone)]
pub struct Meant {
    /// The study and the list.
    pub list: ListMeant,
    /// What is written, and where the work begins.
    pub job: Job,
    /// Verdicts that fail.
    pub fail_on: Vec<Decision>,
    /// For which a plan is made.
    budget: Option<BudgetRequest>,
    /// The folder of an earlier assessment.
    since: Option<PathBuf>,
    /// The sites, each with what is asked about it, in place of the list.
    pub sites: Option<Sites>,
    pages: Option<usize>,
    with_cards: bool,
    title: TitleBlock,
}

impl Meant {
    /// The study, with what was given in place of its keys.
    ///
    /// # Errors
    /// Everything that is wrong with it.
    pub fn study(&self) -> Result<Study, Problems> {
        let mut study = self.list.study(self.pages)?;
        study.outputs.cards |= self.with_cards;
        let (title, given) = (&mut study.outputs.title, self.title.clone());
        title.date = given.date.or(title.date.take());
        title.preparer = given.preparer.or(title.preparer.take());
        title.revision = given.revision.or(title.revision.take());
        Ok(study)
    }

    /// The budget for which a plan is made, with what it needs of this list.
    ///
    /// # Errors
    /// Restraints or costs that cannot be read, or that are in another currency.
    pub fn budget(&self, inventory: &Inventory) -> Result<Option<Budget>, Problems> {
        let of_list = |request| Budget::new(request, &inventory.path, inventory.units);
        self.budget.as_ref().map(of_list).transpose()
    }
}

impl Meant {
    /// The earlier assessment, read before anything is written: it may be in the same folder.
    ///
    /// # Errors
    /// A folder without a complete assessment.
    pub fn earlier(&self) -> Result<Option<Earlier>, Problem> {
        let read =
            |folder: &PathBuf| Earlier::read(folder).map_err(|problem| problem.of(&["since"]));
        self.since.as_ref().map(read).transpose()
    }
}

impl Question for Assess {
    type Meant = Meant;

    fn resolve(&self, files: &Files) -> Result<Meant, Problems> {
        let words = self.words();
        let mut read = reader::<Self>(&words, &self.unknown);
        let seed = seed(&mut read);
        let text = |read: &mut WordReader<'_>, key| read.one(key).map(str::to_owned);
        let list = self.list.judged(&mut read, files, seed);
        let budget = budget(&mut read, &list, files);
        let sites = path(&mut read, "sites", files);
        for key in ["resume", "since"] {
            if sites.is_some() && read.has(key) {
                let message = format!("`{key}` is for one list, not for several sites");
                read.note(&[key], message, "leave it out");
            }
        }
        let mut meant = Meant {
            sites: None,
            list,
            budget,
            since: path(&mut read, "since", files),
            job: Job {
                resume: read.flag("resume"),
                force: false,
                parquet: parquet(&mut read),
                outcomes: read.flag("outcomes"),
                signing: Signing {
                    allows_recalled: read.flag("allow_recalled"),
                },
            },
            fail_on: read.choices("fail_on", VERDICTS),
            pages: read.whole_within("pages", 0..),
            with_cards: read.flag("cards"),
            title: TitleBlock {
                date: text(&mut read, "date"),
                preparer: text(&mut read, "preparer"),
                revision: text(&mut read, "revision"),
            },
        };
        // What is wrong with the request is wrong for every site.
        if let Some(path) = sites.filter(|_| read.problems.is_empty()) {
            let sites = sites::sites(self, &path, files);
            meant.sites = read.problems.keep(sites);
        }
        read.problems.finish(Some(meant))
    }

    fn check(&self, files: &Files) -> Result<(), Problems> {
        let meant = self.resolve(files)?;
        match &meant.sites {
            Some(sites) => sites
                .all
                .iter()
                .try_for_each(|site| site.meant.study().map(drop)),
            None => meant.study().map(drop),
        }
    }

    fn set_seed(&mut self, seed: Option<Written>) {
        self.seed = seed;
    }
}

/// The budget; `None`: there is none, or something is wrong.
fn budget(read: &mut WordReader<'_>, list: &ListMeant, files: &Files) -> Option<BudgetRequest> {
    let budget = read.read("budget", amount);
    let restraints = path(read, "restraints", files);
    let horizon_years = read.read("horizon_years", years);
    let discount_ratio = discount(read);
    for key in ["restraints", "horizon_years", "discount"] {
        if read.has(key) && !read.has("budget") {
            let message = format!("`{key}` is for a plan within a budget");
            read.note(
                &[key],
                message,
                "give `budget = \"20000 NZD\"`, or leave it out",
            );
        }
    }
    Some(BudgetRequest {
        budget: budget?,
        horizon_years,
        discount_ratio,
        restraints,
        cells: list.request.cells.clone(),
    })
}

/// Whether a table in Parquet is wanted.
fn parquet(read: &mut WordReader<'_>) -> bool {
    let mut names = read.words.all("format").flat_map(|text| text.split(','));
    if names.any(|name| name.trim().eq_ignore_ascii_case("pdf")) {
        read.pass(&["format"]);
        read.note(
            &["format"],
            "`format = \"pdf\"`: freestand does not write PDF files",
            "leave pdf out, open report.html in a browser and print it, to paper or as a PDF",
        );
        return false;
    }
    read.choices("format", TABLES).contains(&true)
}
