//! `freestand motion convert`: records to CSV or AT2.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use freestand_study::records::{write_at2, write_csv};
use serde::Serialize;

use crate::args::GlobalArgs;
use crate::commands::Done;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::Printer;
use crate::reading::{ReadArgs, path_text};

/// Records to CSV (m/s², every bit kept) or PEER AT2 (g, 8 digits): to --out, or one file to standard output
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand motion convert record.AT2 --to csv > record.csv
  freestand motion convert a.csv b.csv --to at2 --out converted")]
pub(crate) struct ConvertArgs {
    /// Record files
    #[arg(value_name = "FILE", required = true)]
    files: Vec<PathBuf>,
    /// Format to write
    #[arg(long, value_enum)]
    to: Target,
    #[command(flatten)]
    read: ReadArgs,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum Target {
    /// time_s,accel_m_s2
    Csv,
    /// PEER AT2
    At2,
}

#[derive(Debug, Serialize)]
struct ConvertReport {
    motions: Vec<Converted>,
}

#[derive(Debug, Serialize)]
struct Converted {
    source: String,
    path: Option<String>,
    format: &'static str,
    dt_s: f64,
    npts: usize,
    /// The file itself, where it was not written to `--out`.
    text: Option<String>,
}

pub(crate) fn run(args: &ConvertArgs, global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
    let read = args.read.read_all(&args.files)?;
    if global.out.is_none() && !global.json && read.len() > 1 {
        return Err(Failure::usage("several files cannot share standard output", "name a folder with --out"));
    }
    let files = Files::begin(global, &args.files)?;
    let (mut motions, mut warnings) = (Vec::new(), Vec::new());
    for one in &read {
        warnings.extend(one.notes.iter().map(|note| format!("{}: {note}", one.motion.name)));
        let motion = &one.motion.motion;
        let (text, extension, format) = match args.to {
            Target::Csv => (write_csv(motion), "csv", "csv"),
            Target::At2 => (write_at2(motion, &one.motion.name), "AT2", "at2"),
        };
        let path = files.write(&format!("{}.{extension}", one.motion.name), || text.clone())?;
        motions.push(Converted {
            source: path_text(&one.motion.path),
            text: path.is_none().then_some(text),
            path,
            format,
            dt_s: motion.dt_s(),
            npts: motion.accel_m_s2().len(),
        });
    }
    let report = ConvertReport { motions };
    const SCHEMA: &str = "freestand.motion-convert/1";
    files.finish(SCHEMA, &report, &warnings)?;
    printer.result(SCHEMA, &report, &warnings, || {
        let lines = report.motions.iter().map(|one| match (&one.text, &one.path) {
            (Some(text), _) => text.clone(),
            (None, Some(path)) => format!("{path}\n"),
            (None, None) => String::new(),
        });
        lines.collect()
    })?;
    Ok(Done::OK)
}
