//! `freestand floor`: how the floors of a building move.

use clap::Args;
use freestand_app::floor::{Floor, Meant, SCHEMA};
use freestand_input::words::number;
use freestand_output::answer::Answer;
use freestand_output::facts::Facts;
use freestand_records::notes::grouped;
use freestand_records::write::write_csv;
use freestand_study::floor::{
    FloorReport, FloorRequest, LevelProfile, SpectraReport, floor_response_figure, floors,
    spectra_table,
};
use freestand_study::recorded::ReadMotion;

use super::{Done, Tell};
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::files::{Files, TableArgs};
use crate::printer::{Column, Printer, facts_table};

/// Calculate the motions of the floors of a building
#[derive(Debug, Args)]
#[command(after_help = "\
The building is a shear-flexure beam (Miranda and Taghavi 2005), or a table of storeys (height,
mass, stiffness) or of modes (period, participation, shape); see docs/buildings.md.

Examples:
  freestand floor --motion record.AT2 --storeys 30 --storey-height \"3.2 m\" --levels \"0.5, 1.0\" \\
    --out floors
  freestand floor --motion record.AT2 --storeys 12 --storey-height \"3 m\" --period \"1.2 s\" --json
  freestand floor --motion a.AT2 b.AT2 c.AT2 --storey-table tower.csv --levels all --spectra \\
    --out floors
  freestand floor --motion a.AT2 --levels all --code as1170.4 --city Melbourne --site De \\
    --out floors
  freestand floor --motion h1.AT2 --vertical up.AT2 --vertical-amplification 1.5 --levels all \\
    --out floors
  freestand floor --motion record.v2 --components both --mode-table x.csv \\
    --across-mode-table y.csv --levels all")]
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
        printer.result(SCHEMA, &report, &warnings, || text(&report))?;
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
    files.figure("profile", || report.profile_figure())?;
    if let Some(spectra) = &report.spectra {
        files.table("spectra", || spectra_table(spectra))?;
        let draw =
            || floor_response_figure(spectra, report.building_height_m, report.motions.len());
        files.figure("spectra", draw)?;
    }
    let notes = grouped(notes.iter().map(|(name, note)| (name, note)));
    Ok((report, [request.building.warnings.clone(), notes].concat()))
}

const MODES: [Column; 5] = [
    ("mode", "mode", 0),
    ("period_s", "period [s]", 4),
    ("damping_ratio", "damping [%]", 3),
    ("participation_ratio", "participation", 4),
    ("effective_mass_ratio", "share of the mass", 4),
];

fn text(report: &FloorReport) -> String {
    let several = report.motions.len() > 1;
    let has =
        |has: fn(&LevelProfile) -> bool| report.levels.iter().any(|level| has(&level.profile));
    let mut columns = vec![("level_ratio", "level", 4), ("height_m", "height [m]", 4)];
    columns.push((
        "pfa_g",
        if several { "median PFA [g]" } else { "PFA [g]" },
        4,
    ));
    if several {
        columns.extend([("pfa_g_p16", "16 % [g]", 4), ("pfa_g_p84", "84 % [g]", 4)]);
    }
    columns.extend([("pfv_m_s", "PFV [m/s]", 4), ("pfd_m", "PFD [m]", 4)]);
    let has_drift = has(|level| level.drift_ratio.is_some());
    columns.extend(has_drift.then_some(("drift_ratio", "drift [%]", 4)));
    let is_vertical = has(|level| level.vertical.is_some());
    columns.extend(is_vertical.then_some(("pfa_vertical_g", "vertical PFA [g]", 4)));
    columns.extend(
        report
            .code_clause
            .map(|_| ("code_part_g", "code part [g]", 4)),
    );
    columns.extend((!several).then_some(("path", "file", 0)));
    let modes = report.modes.iter().enumerate();
    let modes = modes.map(|(i, mode)| Facts::default().key("mode", i + 1).and(mode.facts()));
    let levels = report.levels.iter().map(Answer::facts);
    facts_table(modes, &MODES) + "\n" + &facts_table(levels, &columns)
}
