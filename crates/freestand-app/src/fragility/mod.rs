//! `fragility`: how likely objects rock, are damaged and overturn at an intensity.

mod exports;
mod runs;

use std::path::PathBuf;

use clap::Arg;
use freestand::G0_M_S2;
use freestand::fragility::FitKind;
use freestand_input::file::InputFile;
use freestand_input::problem::Problems;
use freestand_input::quantity::Dimension;
use freestand_input::word_reader::WordReader;
use freestand_input::words::Choices;
use freestand_input::written::Written;
use freestand_inventory::CellsRequest;
use freestand_risk::export::{ExportRequest, FORMATS};
use freestand_risk::fragility::{
    At, FIT_METHODS, FitMethod, FragilityRequest, GivenObject, HazardSource, METHODS, Measure,
    Method, RunObjects, RunsRequest, ShockLimits, check_replicates,
};
use freestand_study::study::DEFAULT_SEED;

use crate::block::GeneralBlock;
use crate::cushion::CushionUnder;
use crate::files::Files;
use crate::hazard::{self, HazardCurve};
use crate::list::ListKeys;
use crate::records::{Records, VerticalRecords};
use crate::request::{Question, Request as _, one_of, path, reader, request, seed};

use exports::Exports;
use runs::{Chosen, RunMotions};

pub use freestand_risk::fragility::FRAGILITY_SCHEMA as SCHEMA;

request! { question
    /// How likely objects fail at an intensity, from runs or from a table of outcomes.
    #[command(mut_args(under_heading))]
    pub struct Fragility {
        /// Table of outcomes (CSV) of earlier runs; nothing is run
        pub outcomes = "FILE",
        /// The study and the list of the objects.
        #[command(flatten)]
        pub list: ListKeys,
        /// One object, instead of a list.
        #[command(flatten)]
        pub object: OneObject,
        /// How the runs are chosen.
        #[command(flatten)]
        pub runs: RunKeys,
        /// Motion of which a spectral acceleration is taken. With --motion, `ground` says that the object
        /// is on the ground [default: ground; with --motion, floor]
        pub at = "AT" with (value_parser = one_of(PLACES)),
        /// How the limit states of an object are fitted [default: ordered]
        pub fit = "FIT" with (value_parser = one_of(FIT_METHODS)),
        /// Largest shock without overturning, the ceiling_g of freestand shock; with --outcomes
        pub ceiling = "ACCELERATION" under "From the shocks",
        /// Samples of motions for the 95 % intervals; 0: none [default: 1000]
        pub bootstrap = "N",
        /// Folders for other programs.
        #[command(flatten)]
        pub exports: ExportKeys,
        /// A hazard curve.
        #[command(flatten)]
        pub curve: HazardCurve,

        /// Seed of the random numbers.
        #[arg(skip)]
        pub seed: Option<Written>,
    }
}

/// Puts the keys of its parts under their headings in the help.
fn under_heading(arg: Arg) -> Arg {
    match arg.get_id().as_str() {
        "hazard" | "hazard_power" | "hazard_im" | "site_coordinates" => {
            arg.help_heading("Hazard (for --method stripes and --format openquake)")
        }
        _ => arg,
    }
}

/// Where a spectral acceleration is taken.
pub const PLACES: Choices<At> = &[
    (At::Ground, "ground", "of the ground motion"),
    (At::Floor, "floor", "of the floor motion"),
];

request! {
    /// One object, and the motions of the floor under it.
    pub struct OneObject under "One object" {
        /// Height of one object, instead of an inventory
        pub height = "LENGTH",
        /// Horizontal size of the object in the plane of rocking
        pub thickness = "LENGTH",
        /// Mass of the object; needed for the shock
        pub mass = "MASS",
        /// What else is known of the object.
        #[command(flatten)]
        pub block: GeneralBlock,
        /// The cushion under one edge.
        #[command(flatten)]
        pub pad: CushionUnder,
        /// Restitution: angular velocity after an impact divided by the one before, in (0, 1]
        /// [default: Housner's]
        pub restitution = "RATIO",
        /// Factor that multiplies Housner's restitution
        pub restitution_factor = "RATIO",
        /// Peak acceleration of a landing that the object withstands. With --outcomes and --ceiling, the
        /// fit of `exceeds` uses the shocks of the column `edge_acceleration [g]`, not the outcomes
        pub tolerance = "ACCELERATION",
        /// Duration of the half-sine pulse whose peak is --tolerance
        pub tolerance_duration = "TIME",
        /// Velocity change that the object withstands; with --tolerance a damage boundary
        pub tolerance_velocity_change = "VELOCITY",
        /// Uplift of the free edge that the object withstands
        pub tolerance_edge_lift = "LENGTH",
        /// Records of the horizontal acceleration of the floor under the object
        #[arg(long, value_name = "FILE", num_args = 1.., help_heading = "One object")]
        pub motion: Vec<Written>,
        /// Records of the vertical acceleration of the floor, positive upward: one for each --motion
        #[arg(long, value_name = "FILE", num_args = 1.., help_heading = "One object")]
        pub vertical: Vec<Written>,
        /// How vertical records are read.
        #[command(flatten)]
        pub upward: VerticalRecords,
        /// How records are read.
        #[command(flatten)]
        pub records: Records,
    }
}

request! {
    /// How the runs are chosen.
    pub struct RunKeys under "The runs" {
        /// Rotation divided by α beyond which `exceeds` is reached, such as 0.4; also for an inventory
        pub tolerance_rotation = "RATIO",
        /// Intensity measures, such as "pfv, pfa, sa(0.5), sa_avg(0.2:2), velocity_ratio"; the first one
        /// is that of fragility.csv [default: pfv, with a study pgv]
        pub im = "LIST",
        /// How the runs are chosen [default: ida]
        pub method = "METHOD" with (value_parser = one_of(METHODS)),
        /// `adaptive`, or a grid "from:to:count" of equal ratios, or a list. For ida these are factors on the
        /// motions, such as "0.5:5:10"; for stripes intensities by the first measure, such as
        /// "0.1 m/s:2 m/s:12" [default: adaptive]
        pub scales = "adaptive|GRID",
        /// Largest factor on a motion [default: 10]
        pub max_scale = "RATIO",
        /// Options (CSV), as for freestand risk: objects whose stiffness, base thickness or mass an option
        /// changes are also run as changed, with the id ID/option
        pub options = "FILE",
        /// Continue the runs of an inventory that Ctrl-C or a crash ended, in the same --out
        pub resume = switch,
        /// Number of worlds, if the study generates its motions; records are used once each [default: 40]
        pub worlds = "N",
    }
}

request! {
    /// Folders for other programs.
    pub struct ExportKeys under "Other programs" {
        /// Write a folder for another program into --out; may be given several times
        #[arg(long, value_name = "FORMAT", value_parser = one_of(FORMATS), help_heading = "Other programs")]
        pub format: Vec<Written>,
        /// Intensity of the scenario, such as "0.4 m/s" [default: those of the outcomes]
        pub demand = "INTENSITY",
        /// Realizations of pelicun with --demand [default: 10000]
        pub realizations = "N",
        /// β for limit states that have none, such as a step
        pub beta = "RATIO",
        /// Export curves as points (shares of runs, or the fit of the shocks) instead of lognormal curves
        pub discrete = switch,
    }
}

/// What is asked.
#[derive(Debug, Clone)]
pub struct Meant {
    /// What the curves are fitted to.
    pub fitted: Fitted,
    /// Folders for other programs.
    pub exports: Vec<ExportRequest>,
    /// The files that are read.
    pub inputs: Vec<PathBuf>,
}

/// What the curves are fitted to.
#[derive(Debug, Clone)]
pub enum Fitted {
    /// A table of outcomes.
    Outcomes(FragilityRequest),
    /// Objects that are run.
    Runs(Box<Runs>),
}

/// Objects that are run.
#[derive(Debug, Clone)]
pub struct Runs {
    /// What is run and fitted; its finished runs are kept where the shell says.
    pub request: RunsRequest,
    /// What the readers of the motions noted.
    pub notes: Vec<String>,
    /// Whether earlier runs go on.
    pub resume: bool,
}

impl Runs {
    /// Whether the objects are those of a list.
    pub fn is_listed(&self) -> bool {
        matches!(self.request.objects, RunObjects::Listed { .. })
    }

    /// Whether something of the list could not be read.
    pub fn has_errors(&self) -> bool {
        match &self.request.objects {
            RunObjects::Listed { inventory, .. } => inventory.has_errors(),
            RunObjects::Given(_) => false,
        }
    }
}

impl Question for Fragility {
    type Meant = Meant;

    fn resolve(&self, files: &Files) -> Result<Meant, Problems> {
        let words = self.words();
        let mut read = reader::<Self>(&words, &self.unknown);
        let is_listed = read.has("study") || read.has("inventory");
        let is_object = ["height", "thickness", "motion"].map(|key| read.has(key)) != [false; 3];
        match (read.has("outcomes"), is_listed, is_object) {
            (true, ..) => self.of_table(read, files),
            (false, true, _) => self.of_list(read, files),
            (false, false, true) => self.of_object(read, files),
            (false, false, false) => {
                read.missing(
                    &["outcomes"],
                    "there is nothing to run and nothing to fit",
                    "give `height`, `thickness` and `motion`, or `inventory` with a study, or `outcomes`",
                );
                read.problems.finish(None)
            }
        }
    }

    fn set_seed(&mut self, seed: Option<Written>) {
        self.seed = seed;
    }
}

/// What does not depend on where the outcomes come from.
struct Fitting {
    at: Option<At>,
    fit: FitMethod,
    replicates: Option<u32>,
    seed: Option<u64>,
    hazard: Option<HazardSource>,
    site_deg: Option<(f64, f64)>,
    exports: Exports,
}

impl Fitting {
    fn judged(read: &mut WordReader<'_>, files: &Files) -> Self {
        let fit = read.choice("fit", FIT_METHODS);
        let replicates = read.whole("bootstrap");
        read.problems.keep(check_replicates(replicates));
        let measure = hazard::measure(read);
        let hazard = HazardCurve::source(read, measure, files);
        if read.has("hazard_im") && !read.has("hazard") && !read.has("hazard_power") {
            let message = "`hazard_im` is the measure of `hazard_power`, which is not given";
            read.note(&["hazard_im"], message, "give both, or leave it out");
        }
        let site_deg = HazardCurve::site_deg(read);
        Self {
            at: read.choice("at", PLACES),
            fit: fit.unwrap_or(FitMethod::Curves(FitKind::Ordered)),
            replicates,
            seed: seed(read),
            exports: exports::judged(read, hazard.as_ref(), site_deg),
            hazard,
            site_deg,
        }
    }

    fn seed(&self) -> u64 {
        self.seed.unwrap_or(DEFAULT_SEED)
    }

    /// The request of runs of these objects.
    fn of_runs(&self, chosen: Chosen, objects: RunObjects, inputs: Vec<InputFile>) -> RunsRequest {
        let is_for_stripes = chosen.method == Method::Stripes;
        // Stripes take it, or else a program; if nothing does, the runs say so.
        let hazard = self.hazard.clone();
        let hazard = hazard.filter(|_| is_for_stripes || !self.exports.take_hazard());
        RunsRequest {
            objects,
            measures: chosen.measures,
            at: self.at,
            method: chosen.method,
            scales: chosen.scales,
            max_scale_ratio: chosen.max_scale_ratio,
            hazard,
            site_deg: self.site_deg,
            site_is_exported: self.exports.take_site(),
            rotation_ratio: chosen.rotation_ratio,
            fit: self.fit,
            replicates: self.replicates,
            seed: self.seed(),
            inputs,
            keep: None,
        }
    }
}

impl Fragility {
    /// The fit of a table of outcomes.
    fn of_table(&self, mut read: WordReader<'_>, files: &Files) -> Result<Meant, Problems> {
        let fitting = Fitting::judged(&mut read, files);
        let outcomes = path(&mut read, "outcomes", files);
        let shock = shock_limits(&mut read, fitting.fit);
        let costs = path(&mut read, "inventory", files);
        let cells = match read.has("inventory") {
            true => self.list.cells.cells(&mut read, files),
            false => CellsRequest::default(),
        };
        if read.has("inventory") && !read.has("format") {
            let message = "`inventory` has quantities and costs for `format`, which is not given";
            let hint = "give `format`, or leave out `inventory`";
            read.note(&["inventory", "format"], message, hint);
        }
        for key in ["hazard", "hazard_power"] {
            if read.has(key) && fitting.exports.lack_hazard() {
                let message =
                    format!("only OpenQuake takes a hazard curve, so `{key}` has no effect");
                let hint = format!("add `format = \"openquake\"`, or leave out `{key}`");
                read.note(&[key], message, hint);
            }
        }
        for key in read.unread() {
            let (message, hint) = unread_beside_outcomes(key);
            read.note(&[key], message, hint);
        }
        let outcomes = read.problems.finish(outcomes)?;
        Ok(Meant {
            fitted: Fitted::Outcomes(FragilityRequest {
                outcomes: outcomes.clone(),
                at: fitting.at,
                fit: fitting.fit.kind(),
                shock,
                replicates: fitting.replicates,
                seed: fitting.seed(),
            }),
            inputs: [Some(outcomes), costs.clone(), self.curve.input(files)]
                .into_iter()
                .flatten()
                .chain(self.list.cells.inputs(files))
                .collect(),
            exports: exports::with_costs(fitting.exports.requests, costs, &cells)?,
        })
    }

    /// Runs of one object.
    fn of_object(&self, mut read: WordReader<'_>, files: &Files) -> Result<Meant, Problems> {
        let fitting = Fitting::judged(&mut read, files);
        let chosen = Chosen::judged(&mut read, Measure::Pfv);
        let object = self.object.judged(&mut read, fitting.at, files);
        let named = self.object.records(&mut read, files);
        for key in read.unread() {
            let (message, hint) = runs::refusal(key, false);
            read.note(&[key], message, hint);
        }
        let (object, chosen) = read.problems.finish(object.zip(chosen))?;
        let RunMotions {
            motions,
            notes,
            files: sources,
        } = runs::motions(&named)?;
        let objects = RunObjects::Given(Box::new(GivenObject { motions, ..object }));
        let mut inputs = named.all_paths();
        inputs.extend(self.object.records.inputs(files));
        inputs.extend(self.object.pad.input(files));
        inputs.extend(self.curve.input(files));
        Ok(Meant {
            fitted: Fitted::Runs(Box::new(Runs {
                request: fitting.of_runs(chosen, objects, sources),
                notes,
                resume: false,
            })),
            inputs,
            exports: exports::with_costs(fitting.exports.requests, None, &CellsRequest::default())?,
        })
    }

    /// Runs of a list in the building of a study.
    fn of_list(&self, mut read: WordReader<'_>, files: &Files) -> Result<Meant, Problems> {
        let fitting = Fitting::judged(&mut read, files);
        let chosen = Chosen::judged(&mut read, Measure::Pgv);
        let list = self.list.judged(&mut read, files, fitting.seed);
        let worlds = read.whole_within("worlds", 2..=10_000);
        let options = path(&mut read, "options", files);
        let resume = read.flag("resume");
        for key in read.unread() {
            let (message, hint) = runs::refusal(key, true);
            read.note(&[key], message, hint);
        }
        let chosen = read.problems.finish(chosen)?;
        let costs = files.path_of(self.list.inventory.as_ref());
        let exports = exports::with_costs(
            fitting.exports.requests.clone(),
            costs.clone(),
            &list.request.cells,
        )?;
        let listed = runs::listed(&list, worlds, options.as_deref())?;
        let named = [files.path_of(self.list.study.as_ref()), costs, options];
        let named = named.into_iter().chain([self.curve.input(files)]);
        let (objects, sources) = listed;
        Ok(Meant {
            fitted: Fitted::Runs(Box::new(Runs {
                request: fitting.of_runs(chosen, objects, sources),
                notes: Vec::new(),
                resume,
            })),
            inputs: named.flatten().chain(self.list.inputs(files)).collect(),
            exports,
        })
    }
}

/// What is said of a key that nothing reads beside a table of outcomes.
fn unread_beside_outcomes(key: &str) -> (String, String) {
    match key {
        "sheet" | "columns" | "edit" => (
            format!(
                "`{key}` has no effect: it says how a list is read, and there is no `inventory`"
            ),
            "leave it out".to_owned(),
        ),
        // In the command line it has no flag that a message could name.
        "study" => (
            "`outcomes` contains the runs, so the study has no effect".to_owned(),
            "leave out `outcomes`, or the study".to_owned(),
        ),
        _ => (
            format!("`outcomes` contains the runs, so `{key}` has no effect"),
            format!("leave out `outcomes`, or `{key}`"),
        ),
    }
}

/// The tolerance and the ceiling for a fit of the shocks of a table.
fn shock_limits(read: &mut WordReader<'_>, fit: FitMethod) -> Option<ShockLimits> {
    let tolerance = read.positive("tolerance", Dimension::Acceleration);
    let ceiling = read.positive("ceiling", Dimension::Acceleration);
    let hint = "give both, or neither; the ceiling is the ceiling_g that freestand shock states";
    match (read.has("tolerance"), read.has("ceiling")) {
        (true, false) => {
            let message = "`tolerance` with `outcomes` needs the `ceiling` of the shocks";
            read.missing(&["ceiling"], message, hint);
        }
        (false, true) => read.missing(&["tolerance"], "`ceiling` needs `tolerance`", hint),
        (false, false) if fit == FitMethod::TwoStage => {
            let message = "`fit = \"two-stage\"` with `outcomes` needs the tolerance and the ceiling of the shocks";
            let hint = "give `tolerance` and `ceiling`, the ceiling_g that freestand shock states";
            read.missing(&["tolerance", "ceiling"], message, hint);
        }
        _ => {}
    }
    Some(ShockLimits {
        tolerance_g: tolerance? / G0_M_S2,
        ceiling_g: ceiling? / G0_M_S2,
    })
}
