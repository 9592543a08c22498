//! `freestand shock-spectrum`: shock response spectra of records and of classical pulses.

use clap::Args;
use freestand_app::shock_spectrum::{Meant, SCHEMA, Shock, ShockSpectrum};
use freestand_input::problem::Problem;
use freestand_output::answer::Answer;
use freestand_study::recorded::ReadMotion;
use freestand_study::shock_spectrum::ShockSpectrumReport;

use super::{Done, Tell};
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::files::{Files, TableArgs};
use crate::printer::{Printer, significant, table};

/// Calculate the shock response spectrum of records or of a classical pulse (ISO 18431-4)
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  A drop test with the columns time [ms] and acceleration [g]:
    freestand shock-spectrum drop.csv --out spectrum
  Pseudo-velocity after the shock, at Q = 25:
    freestand shock-spectrum drop.csv --kind pseudo-velocity --peak residual --q 25 \\
      --frequencies \"10 Hz:2 kHz:24/oct\"
  The pulse of a data sheet:
    freestand shock-spectrum --pulse half-sine --peak-acceleration \"30 g\" --duration \"11 ms\" \\
      --frequencies \"20 Hz, 45 Hz\"

Values are magnitudes: a negative peak is given without its sign. Accelerations are in the unit of
the input, displacements in m, velocities in m/s. --out writes shock_spectrum.csv and a figure.")]
pub(crate) struct ShockSpectrumArgs {
    #[command(flatten)]
    pub(super) request: ShockSpectrum,
    #[command(flatten)]
    pub(super) output: TableArgs,
}

/// What a pulse counts as in a live request: it is sampled as its stiffest oscillator needs it, which
/// is seldom more.
const PULSE_SAMPLES: usize = 1_000_000;

/// What a record counts as at least: many samples are added to a short one.
const LEAST_SAMPLES: usize = 20_000;

impl Tell for ShockSpectrum {
    type Output = TableArgs;

    fn tell(
        meant: Meant,
        tables: &TableArgs,
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        if let Some(session) = printer.session() {
            let count = |read: &ReadMotion| read.motion.motion.accel_m_s2().len();
            let samples = match &meant.shock {
                Shock::Pulse(..) => PULSE_SAMPLES,
                Shock::Recorded(motions, _) => motions
                    .iter()
                    .map(|read| count(read).max(LEAST_SAMPLES))
                    .sum(),
            };
            session.check_oscillators(meant.spectrum.frequencies_hz.len(), samples)?;
        }
        let stop = printer.stop();
        let go_on = || {
            if stop.wanted() {
                Err(Problem::stopped())
            } else {
                Ok(())
            }
        };
        let report = meant.spectra(go_on)?;
        let files = Files::with_tables(global, meant.inputs(), tables, SCHEMA, None)?;
        files.table("shock_spectrum", || report.table())?;
        files.figure("shock_spectrum", || report.figure())?;
        files.print(printer, SCHEMA, &report, &report.warnings, || text(&report))?;
        Ok(Done::OK)
    }
}

fn text(report: &ShockSpectrumReport) -> String {
    let mut headings = vec!["f [Hz]".to_owned()];
    headings.extend(
        report
            .spectra
            .iter()
            .map(|one| format!("{} [{}]", one.name, one.unit)),
    );
    let frequencies = report
        .spectra
        .first()
        .map_or(&[][..], |one| &one.frequencies_hz);
    let rows: Vec<Vec<String>> = frequencies
        .iter()
        .enumerate()
        .map(|(i, &f)| {
            let values = report.spectra.iter().filter_map(|one| one.values.get(i));
            std::iter::once(significant(f, 5))
                .chain(values.map(|&value| significant(value, 5)))
                .collect()
        })
        .collect();
    let headings: Vec<&str> = headings.iter().map(String::as_str).collect();
    let mut text = table(&headings, &rows);
    for one in &report.spectra {
        if let Some(pulse) = &one.enveloping_half_sine {
            let pulse = pulse.facts();
            let words = |name, unit| format!("{} {unit}", pulse.cell(name, unit, 4));
            text += &format!(
                "{}: enveloped by a half-sine of {} and {}, with a velocity change of {}\n",
                one.name,
                words("peak_acceleration_g", "g"),
                words("duration_s", "ms"),
                words("velocity_change_m_s", "m/s"),
            );
        }
    }
    text
}
