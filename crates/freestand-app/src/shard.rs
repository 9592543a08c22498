//! `shard`: an assessment that several processes or machines share.

use std::path::PathBuf;

use crate::job::check_shards;
use freestand_input::problem::Problems;
use freestand_input::word_reader::WordReader;
use freestand_input::written::Written;
use freestand_output::answer;
use freestand_report::signature::Signing;

use crate::files::Files;
use crate::list::{ListKeys, ListMeant};
use crate::request::{Question, Request as _, path_without_flag, reader, request, seed};

request! { question
    /// An assessment that is divided into shards.
    pub struct ShardPlan {
        /// The study and the list.
        #[command(flatten)]
        pub list: ListKeys,
        /// Number of shards
        pub shards = "N",
        /// Also make outcomes.csv: what happened to every object in every world, by each model
        pub outcomes = switch,
        /// Number of objects, the most urgent first, that get a page in the report [default: 200]
        pub pages = "N",

        /// Seed of the random numbers.
        #[arg(skip)]
        pub seed: Option<Written>,
    }
}

/// What is planned.
#[derive(Debug, Clone)]
pub struct PlanMeant {
    /// The study and the list.
    pub list: ListMeant,
    /// Number of shards.
    pub shards: usize,
    /// Whether `outcomes.csv` is written too.
    pub outcomes: bool,
    /// Objects with a page in the report; `None`: those of the study.
    pub pages: Option<usize>,
    /// The seed in place of those of the study.
    pub seed: Option<u64>,
}

impl Question for ShardPlan {
    type Meant = PlanMeant;

    fn resolve(&self, files: &Files) -> Result<PlanMeant, Problems> {
        let words = self.words();
        let mut read = reader::<Self>(&words, &self.unknown);
        let seed = seed(&mut read);
        let list = self.list.judged(&mut read, files, seed);
        let hint = "say with `shards` how many there are: some minutes of work for each, about 200 objects or more";
        read.require("shards", "`shards` is missing", hint);
        let shards = read.whole_within("shards", 0..);
        if let Some(shards) = shards {
            read.problems.keep(check_shards(shards));
        }
        let outcomes = read.flag("outcomes");
        let pages = read.whole_within("pages", 0..);
        let meant = shards.map(|shards| PlanMeant {
            list,
            shards,
            outcomes,
            pages,
            seed,
        });
        read.problems.finish(meant)
    }

    fn set_seed(&mut self, seed: Option<Written>) {
        self.seed = seed;
    }
}

request! { question
    /// One shard of a plan.
    pub struct ShardRun {
        /// Folder of the plan
        #[arg(value_name = "DIR")]
        pub dir: Option<Written>,
        /// Number of the shard, counted from 0
        pub shard = "N",
    }
}

/// A shard of a plan.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RunMeant {
    /// The folder of the plan.
    pub dir: PathBuf,
    /// The number of the shard.
    pub shard: usize,
}

impl Question for ShardRun {
    type Meant = RunMeant;

    fn resolve(&self, files: &Files) -> Result<RunMeant, Problems> {
        let words = self.words();
        let mut read = reader::<Self>(&words, &self.unknown);
        let dir = folder(&mut read, files);
        let hint = "say with `shard` which one, counted from 0";
        read.require("shard", "`shard` is missing", hint);
        let shard = read.whole_within("shard", 0..);
        let meant = dir.zip(shard).map(|(dir, shard)| RunMeant { dir, shard });
        read.problems.finish(meant)
    }
}

request! { question
    /// All shards of a plan, which are put together.
    pub struct ShardMerge {
        /// Folder of the plan
        #[arg(value_name = "DIR")]
        pub dir: Option<Written>,
        /// Whoever signs has confirmed the values that are quoted from memory: without it the report is a draft where it
        /// rests on one
        pub allow_recalled = switch,
    }
}

/// A plan whose shards are put together.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MergeMeant {
    /// The folder of the plan.
    pub dir: PathBuf,
    /// Whether the report may be signed.
    pub signing: Signing,
}

impl Question for ShardMerge {
    type Meant = MergeMeant;

    fn resolve(&self, files: &Files) -> Result<MergeMeant, Problems> {
        let words = self.words();
        let mut read = reader::<Self>(&words, &self.unknown);
        let dir = folder(&mut read, files);
        let signing = Signing {
            allows_recalled: read.flag("allow_recalled"),
        };
        read.problems
            .finish(dir.map(|dir| MergeMeant { dir, signing }))
    }
}

/// The schema of the document that lists missing shards.
pub const MERGE_SCHEMA: &str = "freestand.shard-merge/1";

answer! {
    /// What a merge lacks.
    pub struct MissingShards {
        /// The numbers of the shards that are not finished.
        missing: Vec<usize>,
        /// A command that runs each of them.
        commands: Vec<String>,
    }
}

/// The folder of a plan.
fn folder(read: &mut WordReader<'_>, files: &Files) -> Option<PathBuf> {
    let hint = "name the folder that freestand shard plan wrote";
    read.require("dir", "no folder is named", hint);
    path_without_flag(read, "dir", files)
}
