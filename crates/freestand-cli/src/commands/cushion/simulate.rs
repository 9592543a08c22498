//! `freestand cushion simulate`: virtual drop and static tests.

use clap::Args;
use freestand::G0_M_S2;
use freestand::cushion::Cushion;
use freestand::identify::{VirtualDrop, VirtualDropOptions, VirtualStaticOptions};
use freestand_app::virtual_test::{Meant, Plan, SCHEMA, VirtualTests};
use freestand_output::answer::Answer;
use freestand_study::laboratory::virtual_laboratory::{
    SimulatedTest, SimulatedTests, drop_file, static_file,
};

use crate::args::GlobalArgs;
use crate::commands::{Done, Tell};
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::{Column, Printer, facts_table};

/// Simulate drop tests and static tests of a cushion, with the imperfections of real ones
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand cushion simulate --stiffness \"2190 N/mm\" --mass 0.365kg --height 100mm \\
    --noise 0.5% --bias 1g --count 5 --out drops
  freestand cushion simulate --law hertz --stiffness \"2e7 N/m^1.5\" --mass 0.365kg --height 100mm \\
    > drop.csv
  freestand cushion simulate --law kelvin-voigt --stiffness \"2190 N/mm\" --damping 5% \\
    --mass 0.365kg --height 100mm --bounces 1
  freestand cushion simulate --static --stiffness \"1100 N/mm\" --load \"1 kN\" --hysteresis 15% \\
    > press.csv

Without --out, the file is printed. The first touch lies between two samples. Its place and the
noise depend on --seed and on the number of the test.")]
pub(crate) struct SimulateArgs {
    #[command(flatten)]
    pub(super) request: VirtualTests,
}

impl Tell for VirtualTests {
    type Output = ();

    fn tell(
        meant: Meant,
        (): &(),
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        if global.out.is_none() && meant.count > 1 {
            return Err(Failure::usage(
                "several tests need a folder",
                "give --out DIR",
            ));
        }
        let (cushion, notes) = (&meant.edge.cushion, &meant.edge.notes);
        let files = Files::begin(global, &meant.inputs)?;
        let mut tests = Vec::new();
        let mut first = String::new();
        for index in 0..u64::from(meant.count) {
            let (text, one) = simulated(cushion, &meant.plan, index, &files)?;
            if index == 0 && !files.wanted() {
                first = text;
            }
            tests.push(one);
        }
        let report = SimulatedTests {
            law: cushion.law().name(),
            seed: meant.seed,
            tests,
        };
        let is_file = !files.wanted() && !printer.json();
        files.finish(SCHEMA, &report, notes)?;
        if is_file {
            // Only the file is printed, so that it can be redirected.
            printer.print(&first)?;
            printer.warn(notes);
            return Ok(Done::OK);
        }
        printer.result(SCHEMA, &report, notes, || {
            facts_table(report.tests.iter().map(Answer::facts), &COLUMNS)
        })?;
        Ok(Done::OK)
    }
}

/// The file of a test, and its entry in the document.
fn simulated(
    cushion: &Cushion,
    plan: &Plan,
    index: u64,
    files: &Files,
) -> Result<(String, SimulatedTest), Failure> {
    let (kind, text, drop) = match plan {
        Plan::Drop(options) => {
            let (text, drop) = drop_file(cushion, &VirtualDropOptions { index, ..*options })?;
            ("drop", text, Some(drop))
        }
        Plan::Static(options) => (
            "static",
            static_file(cushion, &VirtualStaticOptions { index, ..*options }),
            None,
        ),
    };
    let name = format!("{kind}-{:03}", index + 1);
    let path = files.write(&format!("{name}.csv"), || &text)?;
    let of = |value: fn(&VirtualDrop) -> f64| drop.as_ref().map(value);
    let test = SimulatedTest {
        name,
        path,
        peak_acceleration_g: of(|drop| drop.peak_m_s2 / G0_M_S2),
        contact_time_s: of(|drop| drop.contact_s),
        samples_per_contact: of(|drop| drop.contact_s / drop.dt_s),
        restitution_ratio: of(|drop| drop.restitution_ratio),
    };
    Ok((text, test))
}

const COLUMNS: [Column; 5] = [
    ("path", "test", 0),
    ("peak_acceleration_g", "peak [g]", 5),
    ("contact_time_s", "contact time [ms]", 5),
    ("samples_per_contact", "samples per contact", 4),
    ("restitution_ratio", "restitution", 4),
];
