//! `freestand object`: one object, one sentence.

use clap::Args;
use freestand_app::object::{Meant, Object, SCHEMA};
use freestand_assess::one_object::one_object_shown;
use freestand_report::object::{object_report, object_text};

use super::{Done, Tell};
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::Printer;
use crate::session::Session;

/// Say in one sentence whether an earthquake rocks one object and whether it falls over
///
/// Name the earthquake in one of four ways: --place, --pga, --study or --motion. Earthquakes are
/// simulated until the answer is settled; under motions of the floor, the object is calculated as
/// given. The sentence is followed by at most 20 lines of numbers.
#[derive(Debug, Args)]
#[command(after_help = include_str!("../help/object.txt").trim_end())]
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
        let (result, shown) = shown?;
        // A history that failed is an item that failed, as in a list.
        let at = std::iter::once(&result.at_one).chain(&result.scales);
        let criterion_met = !at.into_iter().any(|at| at.found.has_failed_histories());
        let report = object_report(result);
        if let Some((session, shown)) = session.zip(shown.as_ref()) {
            session.beside(shown);
        }
        files.print(printer, SCHEMA, &report, &report.warnings, || {
            object_text(&report, object.units)
        })?;
        Ok(Done { criterion_met })
    }
}
