//! `freestand shock-spectrum`: shock response spectra of records and of classical pulses.

use clap::Args;
use freestand_app::shock_spectrum::{Meant, SCHEMA, Shock, ShockSpectrum};
use freestand_report::doubts::motion_doubts;
use freestand_report::figures::spectra_figure;
use freestand_report::motion::shock_spectrum_text;
use freestand_study::recorded::ReadMotion;

use super::{Done, Tell};
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::files::{Files, TableArgs};
use crate::printer::Printer;

/// Calculate the shock response spectrum of records or of a classical pulse (ISO 18431-4)
#[derive(Debug, Args)]
#[command(after_help = include_str!("../help/shock_spectrum.txt").trim_end())]
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
        let report = meant.spectra(|| stop.go_on())?;
        let files = Files::with_tables(global, meant.inputs(), tables, SCHEMA, None)?;
        files.table("shock_spectrum", || report.table())?;
        files.figure("shock_spectrum", || spectra_figure(&report))?;
        files.print(
            printer,
            SCHEMA,
            &report,
            &motion_doubts(&report.doubts),
            || shock_spectrum_text(&report),
        )?;
        Ok(Done::OK)
    }
}
