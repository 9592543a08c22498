//! `freestand shard`: an assessment that several processes or machines share.

use std::path::Path;

use clap::{Args, Subcommand};
use freestand_app::job::{
    Merged, PLAN_SCHEMA, PlanRequest, SHARD_SCHEMA, ShardReport, merge_shards, plan_shards,
    run_shard,
};
use freestand_app::shard::{
    MERGE_SCHEMA, MergeMeant, MissingShards, PlanMeant, RunMeant, ShardMerge, ShardPlan, ShardRun,
};
use freestand_input::problem::Problem;
use freestand_input::words::counted;
use freestand_report::assessment::{missing_text, plan_text, quoted};

use super::assess::{print, watched};
use super::{Done, Tell};
use crate::args::GlobalArgs;
use crate::failure::{Failure, Left};
use crate::printer::{Printer, significant};

/// Divide an assessment into shards that run on any machines, and put their results together
///
/// The results are those of freestand assess, byte for byte, whatever the number of shards, their
/// order, the machines and what was killed in between.
#[derive(Debug, Args)]
#[command(after_help = include_str!("../help/shard.txt").trim_end())]
pub(crate) struct ShardArgs {
    #[command(subcommand)]
    command: ShardCommand,
}

#[derive(Debug, Subcommand)]
enum ShardCommand {
    Plan(Box<PlanArgs>),
    Run(RunArgs),
    Merge(MergeArgs),
}

/// Write the folder of a plan, which holds everything that the shards need
///
/// The study, its records and the inventory are copied into the folder, so that shards do not depend
/// on the originals. The same plan may be made again: the folder is then left as it is.
#[derive(Debug, Args)]
#[command(after_help = include_str!("../help/shard_plan.txt").trim_end())]
struct PlanArgs {
    #[command(flatten)]
    request: ShardPlan,
}

/// Assess the objects of one shard
///
/// A shard that is finished is left as it is, at once. One that was killed is continued. Shards may
/// run at the same time, in any order.
#[derive(Debug, Args)]
#[command(after_help = include_str!("../help/shard_run.txt").trim_end())]
struct RunArgs {
    #[command(flatten)]
    request: ShardRun,
}

/// Write the outputs of the assessment from the results of all shards
///
/// The files are those of freestand assess, with objects.parquet.
#[derive(Debug, Args)]
#[command(after_help = include_str!("../help/shard_merge.txt").trim_end())]
struct MergeArgs {
    #[command(flatten)]
    request: ShardMerge,
}

pub(crate) fn run(
    args: &ShardArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    match &args.command {
        ShardCommand::Plan(args) => args.request.run(&(), global, printer),
        ShardCommand::Run(args) => args.request.run(&(), global, printer),
        ShardCommand::Merge(args) => args.request.run(&(), global, printer),
    }
}

/// The folder of `--out`, which a command needs.
fn out<'g>(global: &'g GlobalArgs, hint: &str) -> Result<&'g Path, Failure> {
    let missing = || Problem::value("`out` is missing", hint).of(&["out"]);
    Ok(global.out.as_deref().ok_or_else(missing)?)
}

impl Tell for ShardPlan {
    type Output = ();

    fn tell(
        meant: PlanMeant,
        (): &(),
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        let out = out(
            global,
            "name the folder of the plan: one that all machines can read and write",
        )?;
        let study = meant.list.study(meant.pages)?;
        let inventory = meant.list.inventory(&study)?;
        let request = PlanRequest {
            study: &study,
            seed: meant.seed,
            inventory: &inventory,
            list: &meant.list.request,
            shards: meant.shards,
            outcomes: meant.outcomes,
        };
        let report = plan_shards(&request, out, global.force)?;
        let said = report
            .problems
            .iter()
            .map(|line| format!("in the list: {line}"));
        let warnings: Vec<String> = report
            .no_study
            .iter()
            .cloned()
            .chain(said)
            .chain(report.warnings.clone())
            .collect();
        printer.result(PLAN_SCHEMA, &report, &warnings, || plan_text(&report))?;
        Ok(Done {
            criterion_met: !inventory.has_errors(),
        })
    }
}

impl Tell for ShardRun {
    type Output = ();

    fn tell(
        RunMeant { dir, shard }: RunMeant,
        (): &(),
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        if global.out.is_some() || global.seed.is_some() {
            let hint = "leave it out: the folder of the plan has the seed, and gets the results";
            return Err(Failure::usage(
                "shard run takes neither --out nor --seed",
                hint,
            ));
        }
        let run = watched(printer, |progress| run_shard(&dir, shard, progress));
        let report = run.map_err(|problems| Failure::from(problems).leaving(Left::Parts))?;
        printer.result(SHARD_SCHEMA, &report, &[], || {
            let ShardReport {
                index,
                rows,
                seconds,
                failed,
                was_finished,
                ..
            } = &report;
            let when = if *was_finished {
                "was finished before"
            } else {
                "is finished"
            };
            let failed = match failed {
                0 => String::new(),
                failed => format!(
                    "; {} with histories that failed",
                    counted(*failed, "object")
                ),
            };
            format!(
                "shard {index} {when}: {}, {} s{failed}\n",
                counted(*rows, "object"),
                significant(*seconds, 3)
            )
        })?;
        Ok(Done::OK)
    }
}

impl Tell for ShardMerge {
    type Output = ();

    fn tell(
        MergeMeant { dir, signing }: MergeMeant,
        (): &(),
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        let out = out(global, "name the folder for the results")?;
        if global.seed.is_some() {
            return Err(Failure::usage(
                "shard merge takes no --seed",
                "leave it out: the plan has the seed",
            ));
        }
        let merged = watched(printer, |progress| {
            merge_shards(&dir, out, global.force, signing, progress)
        });
        match merged? {
            Merged::Missing(missing) => {
                let dir = quoted(&dir.display().to_string());
                let commands: Vec<String> = missing
                    .iter()
                    .map(|shard| format!("freestand shard run {dir} --shard {shard}"))
                    .collect();
                let body = MissingShards { missing, commands };
                let text = || missing_text(&body.commands, &body.missing, &dir);
                printer.result(MERGE_SCHEMA, &body, &[], text)?;
                Ok(Done {
                    criterion_met: false,
                })
            }
            Merged::Done(done) => {
                let (report, inventory) = *done;
                print(&report, out, &inventory, printer)?;
                Ok(Done {
                    criterion_met: report.failed == 0 && !inventory.has_errors(),
                })
            }
        }
    }
}
