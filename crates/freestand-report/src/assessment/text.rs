//! What becomes of the objects of a list.

use freestand_assess::result::Decision;
use freestand_input::keys::KeyStyle;
use freestand_input::quantity::shorten;
use freestand_input::toml_reader::one_line;
use freestand_input::words::{counted, significant};

use super::told::{JobReport, PlanReport};
use super::words::advice;
use crate::table::table;

/// What became of the objects of a list: the counts, the most urgent ones, the problems and the files.
pub fn assessment_text(report: &JobReport) -> String {
    let mut text = report
        .no_study
        .as_ref()
        .map_or_else(String::new, |no_study| format!("{no_study}\n\n"));
    text.push_str(&format!("{}\n\n", report.place));
    let row = |one: &Decision| {
        vec![
            one.name().to_owned(),
            report.count(*one).to_string(),
            advice(*one).to_owned(),
        ]
    };
    let rows: Vec<Vec<String>> = Decision::ALL.iter().map(row).collect();
    text.push_str(&table(&["action", "objects", ""], &rows));
    let done = report.resumed + report.computed;
    text.push_str(&format!(
        "\n{done} of {}",
        counted(report.objects, "object")
    ));
    if report.resumed > 0 {
        text.push_str(&format!(", {} of them from an earlier run", report.resumed));
    }
    text.push_str(&format!(
        "; {}\n",
        counted(report.histories as usize, "rocking history")
    ));
    if report.only_falling > 0 {
        let objects = counted(report.only_falling, "object");
        text.push_str(&format!("{objects} to leave: only falling was assessed\n"));
    }
    if !report.first.is_empty() {
        text.push_str(&format!("\n{}", first(report)));
    }
    if let Some(plan) = &report.budget {
        text.push_str(&format!("\n{}", super::plan::plan_text(plan)));
        text.push_str(super::plan::WHERE_ASSUMED);
    }
    if let Some(since) = &report.since {
        text.push_str(&format!("\n{}", super::since::since_text(since)));
    }
    if report.failed > 0 || !report.problems.is_empty() {
        text.push_str("\nProblems\n");
    }
    if report.failed > 0 {
        text.push_str(&format!(
            "{} with histories that failed\n",
            counted(report.failed, "object")
        ));
    }
    for problem in &report.problems {
        text.push_str(&format!("{}\n", one_line(&KeyStyle::Flag.shown(problem))));
    }
    if report.interrupted {
        text.push_str(&stopped(report));
    }
    let tables = report.files.iter().filter(|name| *name != "manifest.json");
    let named = tables.map(String::as_str).collect::<Vec<_>>().join(", ");
    text.push_str(&format!("\nFiles in {}: {named}\n", report.out));
    text
}

/// How far a run has come that was stopped.
fn stopped(report: &JobReport) -> String {
    let begun = report.resumed + report.computed + report.unsettled;
    let mut parts = Vec::new();
    if report.unsettled > 0 {
        parts.push(format!(
            "{} not settled, after up to {}",
            counted(report.unsettled, "object"),
            counted(report.worlds, "world")
        ));
    }
    if begun < report.objects {
        parts.push(format!("{} not begun", report.objects - begun));
    }
    let what = match parts.is_empty() {
        true => String::new(),
        false => format!(": {}", parts.join(", ")),
    };
    format!("stopped before the end{what}; continue with --resume\n")
}

/// The most urgent objects.
fn first(report: &JobReport) -> String {
    let rows: Vec<Vec<String>> = report
        .first
        .iter()
        .map(|one| {
            vec![
                one.rank.to_string(),
                shorten(&one.id),
                shorten(&one.item),
                shorten(&one.floor),
                one.action.name().to_owned(),
                one.chance.clone(),
                one.force_n
                    .map_or_else(|| "-".to_owned(), |force_n| significant(force_n, 3)),
            ]
        })
        .collect();
    let mut text = table(
        &[
            "rank",
            "id",
            "item",
            "floor",
            "action",
            "probability",
            "force [N]",
        ],
        &rows,
    );
    let done = report.resumed + report.computed;
    if done > report.first.len() {
        text.push_str(&format!(
            "… and {} more: worklist.csv, objects.csv\n",
            done - report.first.len()
        ));
    }
    text
}

/// A plan, with the commands that work it off.
pub fn plan_text(report: &PlanReport) -> String {
    let PlanReport {
        out,
        shards,
        rows,
        rows_most,
        was_planned,
        place,
        ..
    } = report;
    let again = if *was_planned {
        " (plan_text before; nothing was written)"
    } else {
        ""
    };
    let dir = quoted(out);
    let last = shards - 1;
    format!(
        "{place}\n\n{} in {} of at most {rows_most}, in {out}{again}\n\n\
         Run each shard, on any machine that sees this folder, then merge:\n  \
         for shard in $(seq 0 {last}); do freestand shard run {dir} --shard $shard; done\n  \
         freestand shard merge {dir} --out results\n",
        counted(*rows, "object"),
        counted(*shards, "shard")
    )
}

/// Missing shards that are listed by their commands.
const LISTED: usize = 20;

/// The shards that are missing: a command for each, or one loop where they are many.
pub fn missing_text(commands: &[String], missing: &[usize], dir: &str) -> String {
    let shards = match missing.len() {
        1 => "1 shard is".to_owned(),
        many => format!("{many} shards are"),
    };
    let run = if commands.len() <= LISTED {
        let lines = commands.iter().map(|command| format!("  {command}\n"));
        lines.collect()
    } else {
        let numbers: Vec<String> = missing.iter().map(usize::to_string).collect();
        format!(
            "  for shard in {}; do freestand shard run {dir} --shard $shard; done\n",
            numbers.join(" ")
        )
    };
    format!("{shards} not finished, so nothing was written. Run them:\n{run}")
}

/// A path as a shell reads it.
pub fn quoted(path: &str) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || "/._-+=:,@%".contains(c);
    if !path.is_empty() && path.chars().all(is_plain) {
        path.to_owned()
    } else {
        format!("'{}'", path.replace('\'', "'\\''"))
    }
}
