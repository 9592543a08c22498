//! `freestand motion simulate`: motions from a magnitude and a distance, or from a city and a
//! return period.

use clap::Args;
use freestand::motion::Motion;
use freestand::synthesis::matched_periods_s;
use freestand_app::simulate::{Meant, SCHEMA, Simulate};
use freestand_output::answer::Answer as _;
use freestand_records::formats::write_csv;
use freestand_study::inspect::{Words, record_figure};
use freestand_study::matched::{MatchedPicture, matched_figure};
use freestand_study::simulated::{Earthquake, SimulatedReport, simulate};

use crate::args::GlobalArgs;
use crate::commands::{Done, Tell};
use crate::failure::Failure;
use crate::files::{Files, TableArgs};
use crate::printer::{Column, Printer, cells, headings, significant, table};

/// Simulate ground motions with a stochastic point source
///
/// For a magnitude at a distance, or for earthquakes that agree with the code spectrum of a city.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand motion simulate --magnitude 6 --distance \"30 km\" --count 10 --seed 1 --out motions
  freestand motion simulate --magnitude 6.5 --distance \"45 km\" \\
    --preset se-australia --stress-drop \"50 MPa\" --json
  freestand motion simulate --city Melbourne --return-period 500 --site De --count 20 \\
    --out motions")]
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
        warnings.extend(report.warnings.iter().cloned());
        warnings.extend(request.assumptions());
        files.print(printer, SCHEMA, &report, &warnings, || text(&report))?;
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

const COLUMNS: [Column; 3] = [
    ("pga_g", "PGA [g]", 3),
    ("pgv_m_s", "PGV [m/s]", 3),
    ("d5_95_s", "D5-95 [s]", 3),
];

fn text(report: &SimulatedReport) -> String {
    let mut rows = Vec::new();
    for Earthquake { found, motions, .. } in &report.earthquakes {
        for one in motions {
            let source = vec![
                one.path.clone().unwrap_or_else(|| one.name.clone()),
                significant(found.source.magnitude, 3),
                significant(found.source.distance_m / 1000.0, 3),
                found
                    .corner_frequencies_hz()
                    .first()
                    .map_or(String::new(), |&corner| significant(corner, 3)),
                significant(found.source.duration_s(), 3),
            ];
            rows.push([source, cells(&one.facts(), &COLUMNS)].concat());
        }
    }
    let of_source = ["motion", "M", "R [km]", "f0 [Hz]", "Td [s]"];
    let mut text = table(&[&of_source, &headings(&COLUMNS)[..]].concat(), &rows);
    for one in &report.earthquakes {
        if let (Some(searched), Some(motions), Some(written)) = (
            one.found.mean_ratio_to_rock_spectrum,
            one.searched_motions,
            one.written_mean_ratio_to_site_spectrum,
        ) {
            text.push_str(&format!(
                "\nM {} at {} km: mean spectrum divided by the code spectrum, T = 0.5 to 1 s: {} for the \
                 {motions} motions of the search (rock), {} for those written (site {})",
                significant(one.found.source.magnitude, 3),
                significant(one.found.source.distance_m / 1000.0, 3),
                significant(searched, 3),
                significant(written, 3),
                report.request.site.name(),
            ));
        }
    }
    text
}
