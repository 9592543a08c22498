//! `freestand rock`: one object under one motion, or under each of several.

use std::path::PathBuf;

use clap::Args;
use freestand_app::rock::{Asked, Did, Meant, Results, Rock, SCHEMA};
use freestand_output::answer::Answer as _;
use freestand_report::rocking::{Moves, followed_text};
use freestand_report::table::lines;
use freestand_study::drawn::DrawnHistory;
use serde::Serialize;

use super::motion::plot::{PlotArgs, place};
use super::{Done, Tell};
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::files::{Files, TableArgs, refuse_one_for_two, write_table};
use crate::printer::Printer;

/// Follow one object under a motion: rotation, uplift, impacts, overturning and shock
#[derive(Debug, Args)]
#[command(after_help = include_str!("../help/rock.txt").trim_end())]
pub(crate) struct RockArgs {
    #[command(flatten)]
    pub(super) request: Rock,
    #[command(flatten)]
    pub(super) output: Output,
}

/// The files that are written.
#[derive(Debug, Default, Args)]
pub(crate) struct Output {
    /// File to write the history to: CSV, or Parquet if its name ends in .parquet
    #[arg(long, value_name = "FILE")]
    history: Option<PathBuf>,
    #[command(flatten)]
    tables: TableArgs,
    #[command(flatten)]
    plot: PlotArgs,
}

/// What is printed.
#[derive(Debug, Serialize)]
struct Document {
    #[serde(flatten)]
    results: Results,
    #[serde(skip_serializing_if = "Option::is_none")]
    plots: Option<Vec<String>>,
    processing: Vec<String>,
}

/// What goes beside the document of who wants to draw the history.
#[derive(Debug, Serialize)]
struct Beside {
    history: DrawnHistory,
}

impl Tell for Rock {
    type Output = Output;

    fn tell(
        meant: Meant,
        output: &Output,
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        let (count, motions) = (meant.count(), &meant.motions);
        if count > 1 && output.history.is_some() {
            return Err(Failure::usage(
                "--history names one file, but there are several motions",
                "name a folder with --out: it gets the history of each",
            ));
        }
        let (history, plot) = (output.history.as_deref(), output.plot.file());
        refuse_one_for_two(("--history", history), ("--plot", plot))?;
        let target = output.plot.target(global)?;
        if let Some(target) = &target {
            target.check(count)?;
        }
        let files = Files::with_tables(global, &motions.inputs, &output.tables, SCHEMA, None)?;
        let session = printer
            .session()
            .filter(|session| session.wants_history() && count == 1);
        let is_sampled =
            output.history.is_some() || files.wanted() || target.is_some() || session.is_some();
        let (mut answers, mut plots) = (Vec::new(), Vec::new());
        let mut warnings = motions.warnings();
        for (index, followed) in meant.follow_each(is_sampled).enumerate() {
            let followed = followed?;
            let name = &followed.name;
            let file = match count {
                1 => "history".to_owned(),
                _ => format!("history-{:02}-{name}", index + 1),
            };
            files.table(&file, || Ok(followed.history()))?;
            if let Some(path) = &output.history {
                write_table(path, followed.history(), SCHEMA, &motions.inputs)?;
            }
            if let Some(session) = session
                && let Some(history) = followed.drawn()?
            {
                session.beside(&Beside { history });
            }
            if let Some(target) = &target
                && let Some((figure_name, figure)) = followed.figure()?
            {
                let figure_name = if count == 1 {
                    figure_name.to_owned()
                } else {
                    file
                };
                plots.extend(place(
                    target,
                    vec![(figure_name, figure)],
                    &files,
                    &motions.inputs,
                )?);
            }
            // The landings on cushions are drawn without being asked for.
            if target.is_none()
                && files.wanted()
                && matches!(meant.asked, Asked::OnPads(_))
                && let Some((figure_name, figure)) = followed.figure()?
            {
                files.drawn(figure_name, &figure)?;
            }
            let told = followed.warnings().into_iter().map(|warning| match count {
                1 => warning,
                _ => format!("{name}: {warning}"),
            });
            warnings.extend(told);
            answers.push((name.clone(), followed.answer()));
        }
        let document = Document {
            plots: (target.is_some() || count > 1).then_some(plots),
            results: Results::of(answers),
            processing: motions.processing(),
        };
        files.print(printer, SCHEMA, &document, &warnings, || {
            text(&document.results)
        })?;
        Ok(Done::OK)
    }
}

/// The result for people.
fn text(results: &Results) -> String {
    match results {
        Results::One(answer) => lines(&answer.facts()),
        Results::Each { results } => {
            let first = results.first().map(|one| &one.answer.did);
            let moves = match first {
                Some(Did::Slides(_)) => Moves::Slides,
                Some(Did::SlidesInPlane(_)) => Moves::SlidesInPlane,
                _ => Moves::Rocks,
            };
            let each = results.iter();
            followed_text(each.map(|one| (&*one.motion, one.answer.facts())), moves)
        }
        Results::Rows { set, notes, rows } => {
            let each = rows.iter().map(|row| (&*row.motion, row.run.facts()));
            let rows = followed_text(each, Moves::OnHull);
            format!("{}\n\n{rows}", lines(&set.facts().and(notes.facts())))
        }
    }
}
