//! `assess`: which objects of a list must be restrained.

use crate::job::Job;
use clap::ArgAction;
use freestand_assess::result::Decision;
use freestand_input::problem::Problems;
use freestand_input::word_reader::WordReader;
use freestand_input::written::Written;
use freestand_study::study::{Study, TitleBlock};

use crate::files::Files;
use crate::list::{ListKeys, ListMeant};
use crate::request::{Question, Request as _, Switch, one_of, reader, request, seed};

/// The schema of the response.
pub use crate::job::SCHEMA;

request! { question
    /// A list in the building of a study.
    pub struct Assess {
        /// The study and the list.
        #[command(flatten)]
        pub list: ListKeys,
        /// Continue an earlier run in the same folder
        #[arg(long, action = ArgAction::SetTrue)]
        pub resume: Switch,
        /// Tables to write besides objects.csv, assessment.xlsx and report.html [default: csv]
        #[arg(long, value_name = "FORMAT", value_delimiter = ',', value_parser = one_of(TABLES))]
        pub format: Vec<Written>,
        /// Also write outcomes.csv: what happened to every object in every world, by each model
        #[arg(long, action = ArgAction::SetTrue)]
        pub outcomes: Switch,
        /// Number of objects, the most urgent first, that get a page in the report [default: 200]
        #[arg(long, value_name = "N")]
        pub pages: Option<Written>,
        /// Print the card of every object too, where the report is printed
        #[arg(long, action = ArgAction::SetTrue, help_heading = "The report")]
        pub cards: Switch,
        /// Date on the report [default: a line to fill in]
        #[arg(long, value_name = "DATE", help_heading = "The report")]
        pub date: Option<Written>,
        /// Who prepared the report [default: a line to fill in]
        #[arg(long, value_name = "NAME", help_heading = "The report")]
        pub preparer: Option<Written>,
        /// Revision of the report [default: a line to fill in]
        #[arg(long, value_name = "TEXT", help_heading = "The report")]
        pub revision: Option<Written>,
        /// End with status 1 if an object gets this verdict; give it once for each verdict
        #[arg(long, value_name = "VERDICT", value_parser = one_of(VERDICTS))]
        pub fail_on: Vec<Written>,

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
}

impl Question for Assess {
    type Meant = Meant;

    fn resolve(&self, files: &Files) -> Result<Meant, Problems> {
        let words = self.words();
        let mut read = reader::<Self>(&words, &self.unknown);
        let seed = seed(&mut read);
        let text = |read: &mut WordReader<'_>, key| read.one(key).map(str::to_owned);
        let meant = Meant {
            list: self.list.judged(&mut read, files, seed),
            job: Job {
                resume: read.flag("resume"),
                force: false,
                parquet: parquet(&mut read),
                outcomes: read.flag("outcomes"),
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
        read.problems.finish(Some(meant))
    }

    fn check(&self, files: &Files) -> Result<(), Problems> {
        self.resolve(files)?.study().map(drop)
    }

    fn set_seed(&mut self, seed: Option<Written>) {
        self.seed = seed;
    }
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
