//! `freestand run`: a whole study, from the ground motions to the report.

use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::Mutex;
use std::time::Instant;

use clap::{ArgAction, Args};
use freestand_app::place::{self, PlaceKeys};
use freestand_app::request::Request as _;
use freestand_input::words::counted;
use freestand_output::folder::{OutputFolder, removed_note};
use freestand_study::outputs::{expected_names, write_outputs};
use freestand_study::recorded::MotionFiles;
use freestand_study::rerun::with_seed;
use freestand_study::resolve::{
    Overrides, builtin, builtin_toml, is_study_file, load, motion_paths,
};
use freestand_study::result::{NoResult, Sensitivity, VariedLevel};
use freestand_study::run::{Stage, Step, run as run_study};
use freestand_study::summary::{LevelSummary, level_summaries};
use freestand_study::vary::{Variation, default_variations, parse_variation, vary};
use serde_json::Value;

use super::Done;
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::{Printer, optional, table};
use crate::reading::{ReadArgs, SecondArgs};
use crate::values::Values;

/// Run a whole study: motions, building, spectra of a grid of objects, figures and report
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  The built-in study: a 30-storey building in a 500-year Melbourne earthquake, site class D:
    freestand run
  The built-in study as a file to edit, then the edited study:
    freestand run --dump-study > study.toml
    freestand run study.toml --out results
  The built-in study in another place, which brings its code:
    freestand run --place Wellington --site D --return-period 1000 --out results
  The built-in study under your own record:
    freestand run --motion record.AT2 --out results
  How the result depends on each assumption, or on those named:
    freestand run --vary
    freestand run study.toml --vary \"damping = 2 %, 10 %\" --vary site
  Both horizontal components, with objects that may rock in any direction:
    freestand run --motion record.V2 --components both \\
      --rotation-step \"10 deg\" --out results")]
#[command(mut_args(|arg| place::under(arg, place::OF_STUDY)))]
pub(crate) struct RunArgs {
    /// Study file (TOML) [default: the built-in study]
    #[arg(value_name = "STUDY.toml")]
    study: Option<PathBuf>,
    #[command(flatten)]
    hazard: PlaceKeys,
    /// Records that replace the ground motions of the study
    #[arg(long, value_name = "FILE", num_args = 1..)]
    motion: Vec<PathBuf>,
    #[command(flatten)]
    read: ReadArgs,
    #[command(flatten)]
    second: SecondArgs,
    /// Run the study again with one value changed at a time: the usual values of damping, period,
    /// shear_flexure, seed and site, or the values named, such as "damping = 2 %, 10 %"
    #[arg(long, value_name = "KEY[= VALUE, …]", num_args = 0.., action = ArgAction::Append)]
    vary: Option<Vec<String>>,
    /// Write each table of results as Parquet too; the same as parquet = true in [outputs]
    #[arg(long)]
    parquet: bool,
    /// Print the built-in study as TOML, ready to edit
    #[arg(long, conflicts_with_all = ["study", "motion", "vary"])]
    dump_study: bool,
}

/// The folder where no `--out` is given.
const FOLDER: &str = "freestand-out";

pub(crate) fn run(args: &RunArgs, global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
    if args.motion.is_empty() {
        args.read.refuse_without_record(|keys| {
            format!("name the records with --motion, or write {keys} next to motions in the study's [ground]")
        })?;
        if args.second.names_records() {
            return Err(Failure::usage(
                "--components and --across need records",
                "name them with --motion, or write components or across next to motions in the study's [ground]",
            ));
        }
    }
    if args.dump_study {
        return dump_study(global, printer);
    }
    // In `--motion a.AT2 study.toml`, clap takes the study for a second record.
    if let (None, Some(study)) = (
        &args.study,
        args.motion.iter().find(|path| is_study_file(path)),
    ) {
        let study = study.display();
        return Err(Failure::usage(
            format!("--motion: {study} is a study, not a record"),
            format!("put the study first: freestand run {study} --motion FILE"),
        ));
    }
    let start = Instant::now();
    let mut values = Values::default();
    let motions = (!args.motion.is_empty()).then(|| MotionFiles {
        second: args.second.second(args.motion.len(), &mut values),
        ..args.read.files(&args.motion, &mut values)
    });
    let rotation_step_deg = args.second.rotation_step_deg(&mut values);
    let variations = args
        .vary
        .as_ref()
        .map(|texts| variations(texts, &mut values));
    values.finish()?;
    let overrides = Overrides {
        seed: global.seed,
        hazard: args.hazard.words(),
        motions,
        rotation_step_deg,
        ..Overrides::default()
    };
    let mut study = match &args.study {
        Some(path) => load(path, &overrides)?,
        None => builtin(&overrides)?,
    };
    study.outputs.parquet |= args.parquet;
    let out = global.folder(FOLDER);
    let inputs: Vec<PathBuf> = args
        .study
        .iter()
        .cloned()
        .chain(motion_paths(&study))
        .collect();
    let stop = printer.stop();
    let folder = OutputFolder::stage(&out, global.force, &inputs)?
        .of_command(freestand_study::summary::SCHEMA)?;
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
        if stop.wanted() {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    };
    let tell = |index: usize, count: usize, words: &str| {
        if let Ok(mut change) = change.lock() {
            *change = format!("variation {} of {count}: {words}", index + 1);
        }
    };
    let result = run_study(&study, &progress).and_then(|mut result| {
        if let Some(variations) = &variations {
            result.sensitivity = Some(vary(
                &study, &result, variations, &overrides, &tell, &progress,
            )?);
        }
        Ok(result)
    });
    if stop.wanted() {
        bar.finish_and_clear();
        return Err(Failure::Stopped { printed: false });
    }
    let result = result?;
    bar.set_message("writing");
    let written = write_outputs(folder, &study, &result)?;
    bar.finish_and_clear();

    if let Some(note) = removed_note(&written.removed) {
        printer.note(&note);
    }
    let levels = level_summaries(&study, &result);
    let failed: usize = levels.iter().map(|level| level.failed).sum();
    let mut body = written.body;
    if let Value::Object(keys) = &mut body {
        keys.insert(
            "out".to_owned(),
            Value::from(written.folder.display().to_string()),
        );
    }
    printer.result(
        freestand_study::summary::SCHEMA,
        &body,
        &result.warnings,
        || {
            let files = written
                .files
                .iter()
                .filter(|name| !name.contains('/'))
                .count();
            text(&levels, result.motions.len(), start.elapsed().as_secs_f64())
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

/// The variations: those that the user named, or the default ones.
fn variations(texts: &[String], values: &mut Values) -> Vec<Variation> {
    if texts.is_empty() {
        return default_variations();
    }
    texts
        .iter()
        .filter_map(|text| values.keep("vary", parse_variation(text)))
        .collect()
}

/// The variations at the highest level; `vary.csv` has those of all levels.
fn sensitivity_text(sensitivity: &Sensitivity) -> String {
    let height = |row: &VariedLevel| row.level_ratio.unwrap_or(-1.0);
    let Some(highest) = sensitivity
        .rows
        .iter()
        .max_by(|a, b| height(a).total_cmp(&height(b)))
    else {
        return String::new();
    };
    let rows: Vec<Vec<String>> = sensitivity
        .rows
        .iter()
        .filter(|row| row.level == highest.level)
        .map(|row| {
            let changed = match &row.reason {
                _ if row.value.is_empty() => "unchanged".to_owned(),
                None => format!("{} = {}", row.parameter, row.value),
                Some(reason) => format!("{} = {}: {reason}", row.parameter, row.value),
            };
            vec![
                changed,
                optional(row.pfa_g_median, 3, ""),
                row.overturned_share
                    .map_or_else(|| "-".to_owned(), |share| format!("{:.1} %", 100.0 * share)),
                optional(row.edge_acceleration_g_median, 3, ""),
                optional(row.edge_acceleration_ratio, 3, ""),
            ]
        })
        .collect();
    let headings = [
        "changed",
        "median PFA g",
        "overturned",
        "largest median shock g",
        "shock ratio",
    ];
    let mut text = format!(
        "\n{}, one value changed at a time:\n{}",
        highest.level,
        table(&headings, &rows)
    );
    text.push_str(
        "shock ratio: sum of the median shocks divided by that of the unchanged study, without objects that overturn in either\n",
    );
    for reason in &sensitivity.left_out {
        text.push_str(reason);
        text.push('\n');
    }
    text
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

fn text(levels: &[LevelSummary], motions: usize, seconds: f64) -> String {
    let criterion = levels.iter().any(|level| level.exceeded_objects.is_some());
    let rows: Vec<Vec<String>> = levels
        .iter()
        .map(|level| {
            let mut row = vec![
                level.level.clone(),
                optional(level.pfa_g_median, 3, ""),
                format!("{:.1} %", 100.0 * level.uplift_share),
                format!("{:.1} %", 100.0 * level.overturned_share),
                optional(level.edge_acceleration_g_median, 3, ""),
                optional(level.edge_acceleration_g_max, 3, ""),
                level.failed.to_string(),
            ];
            row.extend(level.exceeded_objects.map(|objects| objects.to_string()));
            row
        })
        .collect();
    let mut headings = vec![
        "level",
        "median PFA g",
        "uplift",
        "overturned",
        "largest median shock g",
        "largest shock g",
        "failed",
    ];
    headings.extend(criterion.then_some("objects above tolerance"));
    let histories: usize = levels.iter().map(|level| level.histories).sum();
    let (motions, histories) = (
        counted(motions, "motion"),
        counted(histories, "rocking history"),
    );
    format!(
        "{}\n{motions}, {histories}, {seconds:.1} s\n",
        table(&headings, &rows)
    )
}
