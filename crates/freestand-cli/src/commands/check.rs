//! `freestand check`: validates and explains a study without running it.

use clap::Args;
use freestand_app::run::{CHECK_SCHEMA, CheckStudy, StudyMeant};
use freestand_output::answer::Answer;
use freestand_report::doubts::study_doubts;
use freestand_report::study::check::Check;
use freestand_report::table::lines;
use freestand_study::resolve::motion_paths;

use super::{Done, Tell};
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::Printer;

/// Check a study without running it, and show how it was understood
#[derive(Debug, Args)]
#[command(after_help = include_str!("../help/check.txt").trim_end())]
pub(crate) struct CheckArgs {
    #[command(flatten)]
    pub(super) request: CheckStudy,
}

impl Tell for CheckStudy {
    type Output = ();

    fn tell(
        meant: StudyMeant,
        (): &(),
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        let study = meant.study()?;
        let mut inputs = meant.inputs;
        inputs.extend(motion_paths(&study));
        let files = Files::begin(global, &inputs)?;
        let check = Check(&study);
        files.print(
            printer,
            CHECK_SCHEMA,
            &check,
            &study_doubts(&study.doubts),
            || lines(&check.facts()),
        )?;
        Ok(Done::OK)
    }
}
