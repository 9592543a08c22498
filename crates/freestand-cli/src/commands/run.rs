//! `freestand run`: a whole study, from the ground motions to the report.

use std::sync::Mutex;
use std::time::Instant;

use clap::Args;
use freestand_app::files::Files as Sources;
use freestand_app::request::Question as _;
use freestand_app::run::{Meant, Run};
use freestand_output::folder::{OutputFolder, removed_note};
use freestand_report::doubts::study_doubts;
use freestand_report::study::outputs::{expected_names, write_outputs};
use freestand_report::study::summary::{RunAnswer, Summary};
use freestand_report::study::{levels_text, sensitivity_text};
use freestand_study::rerun::with_seed;
use freestand_study::resolve::{builtin_toml, motion_paths};
use freestand_study::result::NoResult;
use freestand_study::run::{Stage, Step, run as run_study};
use freestand_study::vary::vary;

use super::{Done, Tell};
use crate::args::GlobalArgs;
use crate::failure::{Failure, Left};
use crate::files::Files;
use crate::printer::Printer;

/// Run a whole study: motions, building, spectra of a grid of objects, figures and report
#[derive(Debug, Args)]
#[command(after_help = include_str!("../help/run.txt").trim_end())]
pub(crate) struct RunArgs {
    #[command(flatten)]
    request: Run,
    /// Print the built-in study as TOML, ready to edit
    #[arg(long, conflicts_with_all = ["study", "motion", "vary"])]
    dump_study: bool,
}

/// The folder where no `--out` is given.
const FOLDER: &str = "freestand-out";

pub(crate) fn run(args: &RunArgs, global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
    if args.dump_study {
        // What is wrong with other flags is told, too.
        args.request.resolve(&Sources::Disk)?;
        return dump_study(global, printer);
    }
    args.request.run(&(), global, printer)
}

impl Tell for Run {
    type Output = ();

    const WRITES_A_FOLDER: bool = true;

    fn tell(
        meant: Meant,
        (): &(),
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        whole_study(&meant, global, printer)
    }
}

fn whole_study(meant: &Meant, global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
    let start = Instant::now();
    let variations = &meant.variations;
    let study = meant.study()?;
    let out = global.folder(FOLDER);
    let mut inputs = meant.study.inputs.clone();
    inputs.extend(motion_paths(&study));
    let stop = printer.stop();
    let folder = OutputFolder::stage(&out, global.force, &inputs)?
        .of_command(freestand_report::study::summary::SCHEMA)?;
    folder.check(&expected_names(&study, variations.is_some()))?;

    let bar = printer.progress_bar(false);
    let change = Mutex::new(String::new());
    let progress = |step: Step| {
        bar.set_length(step.total as u64);
        bar.set_position(step.done as u64);
        let change = change
            .lock()
            .map_or_else(|_| String::new(), |words| words.clone());
        bar.set_message(if change.is_empty() {
            step.stage.map_or("", Stage::name).to_owned()
        } else {
            change
        });
        stop.flow()
    };
    let tell = |index: usize, count: usize, words: &str| {
        if let Ok(mut change) = change.lock() {
            *change = format!("variation {} of {count}: {words}", index + 1);
        }
    };
    let result = run_study(&study, &progress).and_then(|mut result| {
        if let Some(variations) = variations {
            let overrides = &meant.study.overrides;
            let varied = vary(&study, &result, variations, overrides, &tell, &progress)?;
            result.sensitivity = Some(varied);
        }
        Ok(result)
    });
    if stop.wanted() {
        bar.finish_and_clear();
        return Err(Failure::Stopped(Left::Nothing));
    }
    let result = result?;
    bar.set_message("writing");
    let written = write_outputs(folder, &study, &result)?;
    bar.finish_and_clear();

    if let Some(note) = removed_note(&written.removed) {
        printer.note(&note);
    }
    let levels = &written.levels;
    let failed: usize = levels.iter().map(|level| level.failed).sum();
    let answer = RunAnswer {
        summary: Summary {
            study: &study,
            result: &result,
            levels,
            files: &written.files,
        },
        out: written.folder.display().to_string(),
    };
    printer.result(
        freestand_report::study::summary::SCHEMA,
        &answer,
        &study_doubts(&result.doubts),
        || {
            let files = written
                .files
                .iter()
                .filter(|name| !name.contains('/'))
                .count();
            levels_text(levels, result.motions.len(), start.elapsed().as_secs_f64())
                + &result
                    .sensitivity
                    .as_ref()
                    .map_or_else(String::new, sensitivity_text)
                + &format!("{files} files and motions/ in {}\n", out.display())
        },
    )?;
    let varied = result
        .sensitivity
        .iter()
        .flat_map(|sensitivity| &sensitivity.rows);
    let failed = failed
        + varied
            .filter(|row| matches!(row.reason, Some(NoResult::Failed(_))))
            .count();
    let exceeded = levels
        .iter()
        .any(|level| level.exceeded_objects.is_some_and(|objects| objects > 0));
    Ok(Done {
        criterion_met: failed == 0 && !exceeded,
    })
}

/// Prints the built-in study as TOML, with the seed of `--seed`.
fn dump_study(global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
    let study = match global.seed {
        Some(seed) => with_seed(builtin_toml(), seed)?,
        None => builtin_toml().to_owned(),
    };
    let files = Files::begin(global, &[])?;
    files.write("study.toml", || &study)?;
    const SCHEMA: &str = "freestand.study/1";
    let body = serde_json::json!({"study": study});
    files.finish(SCHEMA, &body, &[])?;
    printer.result(SCHEMA, &body, &[], || study)?;
    Ok(Done::OK)
}
