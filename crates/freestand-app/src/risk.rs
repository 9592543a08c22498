//! `risk`: how often objects fail, what that costs, and which options pay.

use std::path::PathBuf;

use clap::Arg;
use freestand::fragility::FitKind;
use freestand_input::problem::Problems;
use freestand_input::quantity::Dimension;
use freestand_input::word_reader::WordReader;
use freestand_input::written::Written;
use freestand_risk::fragility::{At, FITS, FragilityRequest, check_replicates};
use freestand_risk::{RiskCurves, RiskRequest, amount, yearly_rate, years};
use freestand_study::study::DEFAULT_SEED;

use crate::cells::CellKeys;
use crate::files::Files;
use crate::fragility::PLACES;
use crate::hazard::{self, HazardCurve, HazardOfCode};
use crate::request::{Question, Request as _, discount, one_of, path, reader, request, seed};

/// The schema of the response.
pub use freestand_risk::RISK_SCHEMA as SCHEMA;

request! { question
    /// How often objects fail, and what that costs.
    #[command(mut_args(under_heading))]
    pub struct Risk {
        /// Fragilities, as freestand fragility writes them (CSV)
        pub fragility = "FILE" under "Fragility",
        /// Table of outcomes (CSV), which is fitted first; stripes also give the losses of all objects
        /// under the same motions
        pub outcomes = "FILE" under "Fragility",
        /// How the limit states of an object are fitted, with --outcomes [default: ordered]
        pub fit = "FIT" with (value_parser = one_of(FITS)) under "Fragility",
        /// Samples of motions for the 95 % intervals, with --outcomes; 0: none [default: 1000]
        pub bootstrap = "N" under "Fragility",
        /// Motion of which a spectral acceleration is taken [default: ground]
        pub at = "AT" with (value_parser = one_of(PLACES)) under "Fragility",

        /// A hazard curve.
        #[command(flatten)]
        pub curve: HazardCurve,
        /// The hazard of a code.
        #[command(flatten)]
        pub of_code: HazardOfCode,

        /// Costs and accepted rates of objects: the inventory (CSV or XLSX)
        pub inventory = "FILE" under "Money",
        /// How its cells are read.
        #[command(flatten)]
        pub cells: CellKeys,
        /// Options, such as straps or pads: id, option, `cost [AUD]`, median_factor or curves (CSV)
        pub options = "FILE" under "Money",
        /// The most that options may cost, such as "20000 AUD"
        pub budget = "AMOUNT" under "Money",
        /// Years over which the savings of options count, such as "40 yr"
        #[arg(long = "horizon", value_name = "YEARS", help_heading = "Money")]
        pub horizon_years: Option<Written>,
        /// Discount rate per year, compounded continuously, such as "3 %"
        pub discount = "RATIO" under "Money",

        /// Rate of overturning that is accepted where the inventory has none, such as "1e-4 /yr"
        pub accepted = "RATE" with (alias = "accepted-rate"),
        /// Years for which the chance of a failure is stated [default: 50]
        pub years = "YEARS",

        /// Seed of the random numbers.
        #[arg(skip)]
        pub seed: Option<Written>,
    }
}

/// Puts the keys of its parts under their headings in the help.
fn under_heading(arg: Arg) -> Arg {
    match arg.get_id().as_str() {
        "sheet" | "columns" | "edit" => arg.help_heading("Money"),
        "hazard" | "hazard_power" | "hazard_im" | "site_coordinates" | "place" | "hazard_code"
        | "site" | "hazard_factor" | "fault_distance" => {
            arg.help_heading("Hazard (one of --hazard, --hazard-power, --place, --hazard-code)")
        }
        _ => arg,
    }
}

/// What is asked.
#[derive(Debug, Clone, PartialEq)]
pub struct Meant {
    /// The question.
    pub risk: RiskRequest,
    /// The files that are read.
    pub inputs: Vec<PathBuf>,
}

impl Question for Risk {
    type Meant = Meant;

    fn resolve(&self, files: &Files) -> Result<Meant, Problems> {
        let words = self.words();
        let mut read = reader::<Self>(&words, &self.unknown);
        let at = read.choice("at", PLACES);
        let measure = hazard::measure(&mut read);
        let curve = HazardCurve::source(&mut read, measure, files);
        let hazard = curve.or(HazardOfCode::source(&mut read, measure));
        let site_deg = HazardCurve::site_deg(&mut read);
        let curves = curves(&mut read, at, files);
        let inventory = path(&mut read, "inventory", files);
        let list = self.cells.cells(&mut read, files);
        let options = path(&mut read, "options", files);
        let budget = read.read("budget", amount);
        let horizon_years = read.read("horizon_years", years);
        let discount_ratio = discount(&mut read);
        let accepted_rate = rate(&mut read);
        let years = read.read("years", years);
        check_together(&mut read);
        let risk = curves.zip(hazard).map(|(curves, hazard)| RiskRequest {
            curves,
            hazard,
            hazard_at: at,
            site_deg,
            inventory,
            list,
            options,
            budget,
            horizon_years,
            discount_ratio,
            accepted_rate,
            years,
        });
        let named = [
            &self.fragility,
            &self.outcomes,
            &self.curve.hazard,
            &self.inventory,
            &self.options,
        ];
        Ok(Meant {
            risk: read.problems.finish(risk)?,
            inputs: named
                .into_iter()
                .filter_map(|name| files.path_of(name.as_ref()))
                .chain(self.cells.inputs(files))
                .collect(),
        })
    }

    fn set_seed(&mut self, seed: Option<Written>) {
        self.seed = seed;
    }
}

/// The fragilities, of a file or of outcomes.
fn curves(read: &mut WordReader<'_>, at: Option<At>, files: &Files) -> Option<RiskCurves> {
    let file = path(read, "fragility", files);
    let outcomes = path(read, "outcomes", files);
    let fit = read.choice("fit", FITS).unwrap_or(FitKind::Ordered);
    let replicates = read.whole("bootstrap");
    read.problems.keep(check_replicates(replicates));
    let seed = seed(read).unwrap_or(DEFAULT_SEED);
    let of_outcomes = outcomes.map(|outcomes| {
        RiskCurves::Outcomes(FragilityRequest {
            outcomes,
            at,
            fit,
            shock: None,
            replicates,
            seed,
        })
    });
    of_outcomes.or(file.map(RiskCurves::File))
}

/// What contradicts, and what nothing reads beside the rest.
fn check_together(read: &mut WordReader<'_>) {
    read.exclusive("fragility", "outcomes");
    if !read.has("fragility") && !read.has("outcomes") {
        let hint = "give `fragility` or `outcomes`";
        read.missing(&["fragility"], "no fragility is given", hint);
    }
    for curve in ["hazard", "hazard_power"] {
        read.exclusive(curve, "hazard_code");
    }
    if !["hazard", "hazard_power", "place", "hazard_code"]
        .iter()
        .any(|key| read.has(key))
    {
        let of_code = ["site", "hazard_factor", "fault_distance"];
        let key = match of_code.iter().any(|key| read.has(key)) {
            true => "hazard_code",
            false => "hazard",
        };
        read.missing(
            &[key],
            "there is no hazard curve, which says how often motions reach an intensity",
            "give one of `hazard`, `hazard_power`, `place` and `hazard_code`",
        );
    }
    for key in ["horizon_years", "discount"] {
        if read.has("options") && !read.has(key) {
            let message = format!("options pay off over years, but `{key}` is not given");
            let hint = "give `horizon_years = \"40 yr\"` and `discount = \"3 %\"`";
            read.missing(&[key], message, hint);
        }
    }
    if read.has("budget") && !read.has("options") {
        let hint = "give the options with `options = \"options.csv\"`";
        read.missing(&["options"], "a budget needs options to spend it on", hint);
    }
    let idle = [
        (
            read.has("fragility"),
            &["fit", "bootstrap"][..],
            "the curves of `fragility` are fitted already",
        ),
        (
            !read.has("options"),
            &["horizon_years", "discount"],
            "there are no `options` whose savings would count over years",
        ),
        (
            !read.has("hazard"),
            &["site_coordinates"],
            "it chooses a site of a file of `hazard`, and none is given",
        ),
        (
            !read.has("inventory"),
            &["sheet", "columns", "edit"],
            "it says how a list is read, and there is no `inventory`",
        ),
    ];
    for (is_idle, keys, why) in idle {
        if is_idle {
            read.idle(keys, why);
        }
    }
}

/// The accepted rate \[1/year\].
fn rate(read: &mut WordReader<'_>) -> Option<f64> {
    match *read.words.numbers("accepted") {
        // A number of a program is in SI, which a text states.
        [_] => read.positive("accepted", Dimension::Ratio),
        _ => read.read("accepted", yearly_rate),
    }
}
