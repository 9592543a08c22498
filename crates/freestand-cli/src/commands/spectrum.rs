//! `freestand spectrum`: uplift and shock spectra over a grid of objects.

use std::path::PathBuf;
use std::sync::LazyLock;

use clap::Args;
use freestand::respond::{HistoryOptions, RigidHistory};
use freestand::rocking::Base;
use freestand_app::spectrum::{Meant, Others, SCHEMA, Spectrum};
use freestand_assess::one_object::Follow;
use freestand_report::doubts::spectrum_doubt;
use freestand_report::spectrum::Seen;
use freestand_study::at_place::LastGround;
use freestand_study::drawn::{DrawnHistory, drawn};
use freestand_study::rock::edge_landings;
use freestand_study::spectrum::{SpectrumMotion, SpectrumRequest, chunk_objects, spectrum};
use freestand_study::unsolved;
use serde::Serialize;

use super::{Done, Tell};
use crate::args::GlobalArgs;
use crate::failure::{Failure, Left};
use crate::files::path_text;
use crate::files::{Files, refuse_one_for_two};
use crate::printer::Printer;
use crate::rows::{ROWS, Rows};

/// Calculate uplift and shock spectra: a grid of objects under one or more records
#[derive(Debug, Args)]
#[command(after_help = include_str!("../help/spectrum.txt").trim_end())]
pub(crate) struct SpectrumArgs {
    #[command(flatten)]
    pub(super) request: Spectrum,
    #[command(flatten)]
    pub(super) output: Output,
}

/// The files that are written.
#[derive(Debug, Default, Args)]
pub(crate) struct Output {
    /// File to write the rows to (CSV)
    #[arg(long, value_name = "FILE.csv")]
    csv: Option<PathBuf>,
    /// File to write the rows to (Parquet)
    #[arg(long, value_name = "FILE.parquet")]
    parquet: Option<PathBuf>,
}

/// The ground of the last request of the page.
static LAST: LazyLock<LastGround> = LazyLock::new(LastGround::default);

impl Tell for Spectrum {
    type Output = Output;

    fn tell(
        meant: Meant,
        output: &Output,
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        refuse_one_for_two(
            ("--csv", output.csv.as_deref()),
            ("--parquet", output.parquet.as_deref()),
        )?;
        let Meant {
            objects: request,
            shaking,
            inputs,
        } = meant;
        let stop = printer.stop();
        let shaken = shaking.motions(&LAST, || Ok(stop.go_on()?))?;
        let (motions, mut warnings) = (shaken.motions, shaken.warnings);
        let files = Files::begin(global, &inputs)?;
        let paths = (output.csv.as_deref(), output.parquet.as_deref());
        let mut rows = Rows::begin(SCHEMA, printer, &files, paths, &inputs)?;
        let total = request.grid.objects() * motions.len();
        if let Some(session) = printer.session() {
            session.check_histories(total)?;
        }
        if let Some((session, follow)) = printer
            .session()
            .and_then(|session| Some((session, session.follow()?)))
        {
            session.beside(&followed(&request, &motions, &follow)?);
        }
        let mut seen = Seen::new(motions.len(), total, &request);
        let bar = printer.progress_bar(printer.json());
        bar.set_length(total as u64);
        bar.set_message("rocking histories");
        let left = if printer.json() {
            Left::Printed
        } else {
            Left::Nothing
        };
        let solved = spectrum(&request, &motions, chunk_objects, |chunk| {
            rows.write(chunk)?;
            seen.add(chunk);
            bar.inc(chunk.objects() as u64);
            stop.go_on()
                .map_err(|stopped| Failure::from(stopped).leaving(left))
        });
        bar.finish_and_clear();
        let timing = solved?;

        warnings.extend(request.doubts(&seen.tallies).iter().map(spectrum_doubt));
        let failed = seen.tallies.iter().any(|tally| tally.failed > 0);
        let place = paths
            .0
            .or(paths.1)
            .map(path_text)
            .or_else(|| files.path(ROWS));
        let text = || seen.text(&motions, place.as_deref(), &timing);
        let others = Others {
            processing: shaken.processing,
            timing,
        };
        rows.finish(files, printer, &others, &warnings, text)?;
        Ok(Done {
            criterion_met: !failed,
        })
    }
}

/// What the page gets next to the document to draw the history of an object.
#[derive(Debug, Serialize)]
struct Followed {
    followed: String,
    history: DrawnHistory,
}

/// The history of the only object under one of the motions.
fn followed(
    request: &SpectrumRequest,
    motions: &[SpectrumMotion],
    follow: &Follow,
) -> Result<Followed, Failure> {
    let [block] = request
        .grid
        .blocks(0..request.grid.objects().min(2))
        .collect::<Vec<_>>()[..]
    else {
        let hint = "give one height and one thickness, or leave the history out";
        return Err(Failure::usage(
            "a history can be calculated for one object only",
            hint,
        ));
    };
    if request.surface.is_some() {
        return Err(Failure::usage(
            "an object that slides has no rocking history",
            "leave the history out",
        ));
    }
    let object = request.standing(block);
    let how = HistoryOptions::sampled(request.settings);
    let chosen: Vec<&SpectrumMotion> = match follow {
        Follow::Named(name) => motions
            .iter()
            .filter(|one| one.name == *name)
            .take(1)
            .collect(),
        Follow::Telling => motions.iter().collect(),
    };
    let histories = chosen.iter().map(|motion| {
        let base = Base {
            horizontal: Some(&motion.horizontal),
            vertical: motion.vertical.as_ref(),
        };
        object.follow(base, &how).map_err(unsolved::problem)
    });
    let histories = histories.collect::<Result<Vec<RigidHistory>, _>>()?;
    let farthest = |history: &RigidHistory| history.rocking.peak_rotation_rad;
    let found = chosen
        .into_iter()
        .zip(histories)
        .max_by(|a, b| farthest(&a.1).total_cmp(&farthest(&b.1)));
    let (motion, history) = found.ok_or_else(|| {
        let names: Vec<&str> = motions.iter().map(|motion| motion.name.as_str()).collect();
        Failure::usage(
            "no motion has this name",
            format!("choose one of {}", names.join(", ")),
        )
    })?;
    let body = request.cushion.as_ref();
    let body = body.map(|(mass_kg, edge)| (*mass_kg, &edge.cushion));
    let landings = edge_landings(
        &block,
        &history.rocking,
        body,
        request.settings.gravity_m_s2,
    );
    Ok(Followed {
        history: drawn(&object, &history, &landings, Some(&motion.horizontal)),
        followed: motion.name.clone(),
    })
}
