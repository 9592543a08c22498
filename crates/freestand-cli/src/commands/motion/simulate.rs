//! `freestand motion simulate`: motions from a magnitude and a distance, or from a city and a
//! return period.

use clap::Args;
use freestand::motion::Motion;
use freestand::synthesis::matched_periods_s;
use freestand_app::simulate::{Meant, SCHEMA, Simulate};
use freestand_records::formats::write_csv;
use freestand_report::doubts::outside_limits;
use freestand_report::figures::{MatchedPicture, Words, matched_figure, record_figure};
use freestand_report::ground::{SimulatedAnswer, assumptions};
use freestand_report::motion::earthquakes_text;
use freestand_study::simulated::{SimulatedReport, simulate};

use crate::args::GlobalArgs;
use crate::commands::{Done, Tell};
use crate::failure::Failure;
use crate::files::{Files, TableArgs};
use crate::printer::Printer;

/// Simulate ground motions with a stochastic point source
///
/// For a magnitude at a distance, or for earthquakes that agree with the code spectrum of a city.
#[derive(Debug, Args)]
#[command(after_help = include_str!("../../help/motion_simulate.txt").trim_end())]
pub(crate) struct SimulateArgs {
    #[command(flatten)]
    pub(super) request: Simulate,
    #[command(flatten)]
    pub(super) output: TableArgs,
}

impl Tell for Simulate {
    type Output = TableArgs;

    fn tell(
        Meant {
            request,
            mut warnings,
        }: Meant,
        tables: &TableArgs,
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        let files = Files::with_tables(global, &[], tables, SCHEMA, Some(request.seed))?;
        let mut report = simulate(&request)?;
        for earthquake in &mut report.earthquakes {
            for one in &mut earthquake.motions {
                one.path = files.write(&format!("{}.csv", one.name), || write_csv(&one.motion))?;
            }
        }
        if files.wanted() {
            files.table("fourier_amplitude", || report.fourier_table())?;
            draw(&report, &files)?;
        }
        warnings.extend(report.limits.iter().map(outside_limits));
        warnings.extend(assumptions(&request));
        files.print(
            printer,
            SCHEMA,
            &SimulatedAnswer(&report),
            &warnings,
            || earthquakes_text(&report),
        )?;
        Ok(Done::OK)
    }
}

/// Draws the spectra with the code spectrum, if there is one, and the first motion of each
/// earthquake.
fn draw(report: &SimulatedReport, files: &Files) -> Result<(), Failure> {
    if let Some(target) = report.request.code_spectrum() {
        let sa_g: Vec<f64> = matched_periods_s().into_iter().map(target).collect();
        let motions: Vec<&Motion> = report.motions().map(|one| &one.motion).collect();
        let picture = MatchedPicture {
            title: "Simulated motions and the code spectrum",
            target: "AS 1170.4",
            target_sa_g: &sa_g,
            motions: &motions,
        };
        files.drawn("target", &matched_figure(&picture)?)?;
    }
    for one in report
        .earthquakes
        .iter()
        .filter_map(|earthquake| earthquake.motions.first())
    {
        let words = Words {
            name: &one.name,
            description: "simulated",
            processing: &[],
        };
        files.drawn(&one.name, &record_figure(words, &one.motion)?)?;
    }
    Ok(())
}
