//! `freestand cushion simulate`: virtual drop and static tests.

use clap::Args;
use freestand::G0_M_S2;
use freestand::cushion::Cushion;
use freestand::identify::{VirtualDrop, VirtualDropOptions, VirtualStaticOptions};
use freestand_app::virtual_test::{Meant, Plan, SCHEMA, VirtualTests};
use freestand_output::answer::Answer;
use freestand_report::cushion::{SIMULATED, virtual_pad_notes};
use freestand_report::table::facts_table;
use freestand_study::laboratory::virtual_laboratory::{
    SimulatedTest, SimulatedTests, drop_file, static_file,
};

use crate::args::GlobalArgs;
use crate::commands::{Done, Tell};
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::Printer;

/// Simulate drop tests and static tests of a cushion, with the imperfections of real ones
#[derive(Debug, Args)]
#[command(after_help = include_str!("../../help/cushion_simulate.txt").trim_end())]
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
        let cushion = &meant.edge.cushion;
        let notes = &virtual_pad_notes(&meant.edge, meant.assumed, &meant.doubts);
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
            facts_table(report.tests.iter().map(Answer::facts), &SIMULATED)
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
