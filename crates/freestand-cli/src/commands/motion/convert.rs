//! `freestand motion convert`: records to CSV or AT2.

use std::path::Path;

use clap::Args;
use freestand::measures::{Integrals, integrals};
use freestand::motion::Motion;
use freestand_app::motion::{CONVERT, ConvertReport, Converted, Format, Meant, MotionConvert};
use freestand_records::formats::{write_at2, write_csv};
use freestand_records::notes::grouped;
use freestand_study::recorded::ReadMotion;
use freestand_study::study::RecordedMotion;
use serde::Serialize;
use serde_json::json;

use crate::args::GlobalArgs;
use crate::commands::{Done, Tell};
use crate::failure::Failure;
use crate::files::Files;
use crate::files::path_text;
use crate::printer::Printer;

/// Convert records to CSV (m/s², exact) or PEER AT2 (g, 8 digits)
///
/// Writes into the folder of --out; without it, a single motion is printed.
#[derive(Debug, Args)]
#[command(after_help = include_str!("../../help/motion_convert.txt").trim_end())]
pub(crate) struct ConvertArgs {
    #[command(flatten)]
    pub(super) request: MotionConvert,
}

/// The velocity and the displacement of a motion, for a program that draws it.
#[derive(Debug, Serialize)]
struct Traces {
    velocity_m_s: Vec<f64>,
    displacement_m: Vec<f64>,
}

impl From<Integrals> for Traces {
    fn from(
        Integrals {
            velocity_m_s,
            displacement_m,
        }: Integrals,
    ) -> Self {
        Self {
            velocity_m_s,
            displacement_m,
        }
    }
}

impl Tell for MotionConvert {
    type Output = ();

    fn tell(
        Meant {
            asked: (read, format),
            inputs,
        }: Self::Meant,
        (): &(),
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        if global.out.is_none() && !global.json && read.len() > 1 {
            return Err(Failure::usage(
                "several files cannot share standard output",
                "name a folder with --out",
            ));
        }
        let files = Files::begin(global, &inputs)?;
        let starts = read
            .iter()
            .filter_map(|one| Some((one.motion.name.as_str(), one.start_note.as_ref()?)));
        let warnings = grouped(read.iter().flat_map(ReadMotion::named_notes).chain(starts));
        let mut motions = Vec::new();
        for one in &read {
            let RecordedMotion {
                name,
                path,
                motion,
                processing,
                scale_ratio,
                ..
            } = &one.motion;
            motions.push(write(
                format,
                &files,
                (path, name),
                motion,
                processing,
                *scale_ratio,
            )?);
        }
        if let Some(session) = printer.session().filter(|session| session.wants_history()) {
            let traces: Vec<Traces> = read
                .iter()
                .map(|one| integrals(&one.motion.motion).into())
                .collect();
            session.beside(&json!({ "traces": traces }));
        }
        let report = ConvertReport { motions };
        files.finish(CONVERT, &report, &warnings)?;
        printer.result(CONVERT, &report, &warnings, || {
            report.motions.iter().map(shown).collect()
        })?;
        Ok(Done::OK)
    }
}

/// Writes a motion to `--out`, or keeps its text for standard output.
pub(super) fn write(
    format: Format,
    files: &Files,
    (source, name): (&Path, &str),
    motion: &Motion,
    processing: &[String],
    scale_ratio: f64,
) -> Result<Converted, Failure> {
    let (text, extension, format) = match format {
        Format::Csv => (write_csv(motion), "csv", "csv"),
        Format::At2 => (write_at2(motion, name), "AT2", "at2"),
    };
    let path = files.write(&format!("{name}.{extension}"), || text.clone())?;
    Ok(Converted {
        source: path_text(source),
        text: path.is_none().then_some(text),
        path,
        format,
        dt_s: motion.dt_s(),
        npts: motion.accel_m_s2().len(),
        processing: processing.to_vec(),
        scale_ratio,
    })
}

/// What is printed: the text of the file, or its path.
pub(super) fn shown(converted: &Converted) -> String {
    match (&converted.text, &converted.path) {
        (Some(text), _) => text.clone(),
        (None, Some(path)) => format!("{path}\n"),
        (None, None) => String::new(),
    }
}
