//! `freestand floor`: how the floors of a building move.

use clap::Args;
use freestand_app::floor::{Floor, Meant, SCHEMA};
use freestand_input::words::number;
use freestand_records::notes::grouped;
use freestand_records::write::write_csv;
use freestand_report::doubts::building_doubt;
use freestand_report::figures::{floor_response_figure, profile_figure};
use freestand_report::motion::floor_text;
use freestand_study::floor::{FloorReport, FloorRequest, SpectraReport, floors, spectra_table};
use freestand_study::recorded::ReadMotion;

use super::{Done, Tell};
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::files::{Files, TableArgs};
use crate::printer::Printer;

/// Calculate the motions of the floors of a building
#[derive(Debug, Args)]
#[command(after_help = include_str!("../help/floor.txt").trim_end())]
pub(crate) struct FloorArgs {
    #[command(flatten)]
    pub(super) request: Floor,
    #[command(flatten)]
    pub(super) output: TableArgs,
}

impl Tell for Floor {
    type Output = TableArgs;

    fn tell(
        meant: Meant,
        tables: &TableArgs,
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        let files = Files::with_tables(global, &meant.inputs, tables, SCHEMA, None)?;
        let (report, mut warnings) = report(&meant.motions, &meant.floors, &files)?;
        warnings.extend(meant.warnings);
        files.finish(SCHEMA, &report, &warnings)?;
        printer.result(SCHEMA, &report, &warnings, || floor_text(&report))?;
        Ok(Done::OK)
    }
}

/// Calculates one motion at a time, so that only its floors are in memory, and writes the files.
fn report(
    read: &[ReadMotion],
    request: &FloorRequest,
    files: &Files,
) -> Result<(FloorReport, Vec<String>), Failure> {
    let (mut motions, mut spectra_g, mut notes) = (Vec::new(), Vec::new(), Vec::new());
    for one in read {
        let mut done = floors(one, request)?;
        let mut verticals = done.verticals.iter();
        for (level, floor) in done.report.levels.iter_mut().zip(&done.floors) {
            let folder = if read.len() > 1 {
                format!("{}/", done.report.motion)
            } else {
                String::new()
            };
            // Floors of a table may be at any level; levels that the user gave keep their digits.
            let ratio = if request.is_storeys {
                number(level.level_ratio, 4)
            } else {
                level.level_ratio.to_string()
            };
            let name = format!("{folder}level-{ratio}.csv");
            level.path = files.write(&name, || floor.csv())?;
            if let Some(vertical) = verticals.next() {
                let name = format!("{folder}level-{ratio}-vertical.csv");
                level.vertical_path = files.write(&name, || write_csv(vertical))?;
            }
        }
        notes.extend(done.notes.into_iter().map(|note| (&one.motion.name, note)));
        motions.push(done.report);
        spectra_g.push(done.spectra_g);
    }
    let spectra = request
        .spectra
        .as_ref()
        .map(|spectra| SpectraReport::new(&request.levels_ratio, spectra, &spectra_g));
    let report = FloorReport::new(request, motions, spectra)
        .ok_or_else(|| Failure::computation("the files were read but contain no motion"))?;
    files.table("profile", || report.profile_table())?;
    files.figure("profile", || profile_figure(&report))?;
    if let Some(spectra) = &report.spectra {
        files.table("spectra", || spectra_table(spectra))?;
        let draw =
            || floor_response_figure(spectra, report.building_height_m, report.motions.len());
        files.figure("spectra", draw)?;
    }
    let notes = grouped(notes.iter().map(|(name, note)| (name, note)));
    let of_building = request.building.doubts.iter().map(building_doubt);
    Ok((report, of_building.chain(notes).collect()))
}
