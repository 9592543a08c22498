//! `freestand object`: one object, one sentence.

use clap::Args;
use freestand_app::object::{Meant, Object, SCHEMA};
use freestand_assess::one_object::{AtScale, ObjectReport, one_object_shown};
use freestand_input::quantity::UnitSystem;
use freestand_output::answer::Answer as _;

use super::{Done, Tell};
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::{Printer, lines, table};
use crate::session::Session;

/// Say in one sentence whether an earthquake rocks one object and whether it falls over
///
/// Name the earthquake in one of four ways: --place, --pga, --study or --motion. Earthquakes are
/// simulated until the answer is settled; under motions of the floor, the object is calculated as
/// given. The sentence is followed by at most 20 lines of numbers.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  A bookcase on the ground in Melbourne:
    freestand object --height 2m --thickness \"300 mm\" --place Melbourne
  A cabinet on the third floor of a building with six, in Los Angeles, in US units:
    freestand object --height \"6'6\\\"\" --thickness 18in --width 36in --place \"Los Angeles\" \\
      --floor 3 --storeys 6 --storey-height 13ft
  With its mass, its feet and what it withstands, its landings are compared too:
    freestand object --height 1.8m --thickness 0.6m --mass 150kg --on \"4380 N/mm\" \\
      --tolerance 10g --pga 0.3g --json
  In the building and the earthquake of a study:
    freestand object --height 1.8m --thickness 0.5m --study hospital.toml --floor 2
  Beside its wall, 20 mm away:
    freestand object --height 1.95m --thickness 0.42m --wall-gap 20mm --place Wellington
  On free casters, with 400 mm of room until its stop:
    freestand object --height 1.4m --thickness 0.6m --casters free --clearance 400mm --pga 0.4g
  Under motions of its floor, also weaker and stronger ones:
    freestand object --height 1.8m --thickness 0.5m --motion floor-1.csv floor-2.csv \\
      --scales \"0.5, 1, 2\"

Floors: 1 is the first above the ground. freestand place list shows the places, freestand cushion
list the entries for --on. Several objects are a list: freestand assess.")]
pub(crate) struct ObjectArgs {
    #[command(flatten)]
    pub(super) request: Object,
}

impl Tell for Object {
    type Output = ();

    fn tell(
        Meant { object, inputs }: Meant,
        (): &(),
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        let files = Files::begin(global, &inputs)?;
        let stop = printer.stop();
        let session = printer.session();
        let (memory, follow) = (
            session.map(Session::memory).unwrap_or_default(),
            session.and_then(Session::follow),
        );
        let shown = one_object_shown(&object, &memory, follow.as_ref(), &|| stop.wanted());
        let (report, shown) = shown.map_err(|problems| match problems.is_stopped() {
            true => Failure::Stopped { printed: false },
            false => problems.into(),
        })?;
        if let Some((session, shown)) = session.zip(shown.as_ref()) {
            session.beside(shown);
        }
        files.print(printer, SCHEMA, &report, &report.warnings, || {
            text(&report, object.units)
        })?;
        Ok(Done::OK)
    }
}

/// The unit of uplifts, and of the headings of the table by scale.
fn scale_headings(units: UnitSystem) -> (&'static str, [&'static str; 7]) {
    let (unit, uplift) = match units {
        UnitSystem::Si => ("mm", "uplift [mm]"),
        UnitSystem::Us => ("in", "uplift [in]"),
    };
    (
        unit,
        [
            "scale",
            "median PFA [g]",
            "largest PFA [g]",
            "lift an edge",
            "overturn it",
            uplift,
            "shock [g]",
        ],
    )
}

/// A row of that table.
fn at_scale(row: &AtScale, length: &str) -> Vec<String> {
    let facts = row.facts();
    let columns = [
        ("scale_ratio", "", 0),
        ("median", "", 3),
        ("max", "", 3),
        ("motions_lifted", "", 0),
        ("motions_overturned", "", 0),
        ("uplift_m_max", length, 3),
        ("landing_acceleration_g_max", "", 3),
    ];
    columns
        .map(|(name, unit, digits)| facts.cell(name, unit, digits))
        .to_vec()
}

/// The most lines of a table below the sentence.
const MAX_ROWS: usize = 18;

fn text(report: &ObjectReport, units: UnitSystem) -> String {
    let mut text = format!("{}\n\n", report.answer);
    if report.scales.is_empty() {
        text.push_str(&lines(&report.facts()));
        return text;
    }
    let (length, headings) = scale_headings(units);
    let rows: Vec<Vec<String>> = report
        .scales
        .iter()
        .take(MAX_ROWS)
        .map(|row| at_scale(row, length))
        .collect();
    text.push_str(&table(&headings, &rows));
    if report.scales.len() > MAX_ROWS {
        text.push_str(&format!(
            "and {} more: --json\n",
            report.scales.len() - MAX_ROWS
        ));
    }
    text
}
