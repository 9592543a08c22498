//! A place with the hazard of its code.

use clap::Arg;
use freestand_input::written::Written;

use crate::request::request;

request! {
    /// A place with the hazard of its code.
    pub struct PlaceKeys {
        /// Place or coordinates ("41.01, 28.97"), with their code and hazard; see freestand place list
        #[arg(long, value_name = "NAME")]
        pub place: Option<Written>,
        /// Site class of the code
        #[arg(long, value_name = "CLASS")]
        pub site: Option<Written>,
        /// Return period in years, where the code has several
        #[arg(long = "return-period", value_name = "YEARS")]
        pub return_period_years: Option<Written>,
    }
}

/// These keys.
pub(crate) const KEYS: [&str; 3] = ["place", "site", "return_period_years"];

/// Their heading in the help of a command that has a study.
pub const OF_STUDY: &str = "Hazard, in place of that of the study";

/// Puts these keys under a heading of the help.
pub fn under(arg: Arg, heading: &'static str) -> Arg {
    if KEYS.contains(&arg.get_id().as_str()) {
        arg.help_heading(heading)
    } else {
        arg
    }
}
