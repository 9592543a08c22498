//! `freestand fragility` from motions, studies and inventories: the objects are run before the fit.

use std::path::PathBuf;

use clap::Args;
use freestand::rocking::{Base, Restitution};
use freestand_app::CellKeys;
use freestand_app::list::ListKeys;
use freestand_assess::fragility::{
    At, DEFAULT_MAX_SCALE, FRAGILITY_SCHEMA, FloorMotion, GivenObject, KeepRuns, Limits, METHODS,
    Measure, Method, RunObjects, RunsReport, RunsRequest, file_name, fragility_of_runs, measures,
    scales,
};
use freestand_assess::risk::{LEFT_OUT, load_changed};
use freestand_input::file::{InputFile, load};
use freestand_input::problem::Problem;
use freestand_input::quantity::Dimension;
use freestand_input::words::counted;
use freestand_input::written::Written;
use freestand_output::facts::Facts;
use freestand_output::json::document;
use freestand_records::notes::grouped;
use freestand_study::recorded::ReadMotion;
use freestand_study::restitution::checked;
use freestand_study::unsolved::rocking_problem;

use super::Done;
use super::assess::watched;
use super::block::ShapeArgs;
use super::fragility::{Exports, FragilityArgs, curves_text, stopped};
use super::list::{of_cells, of_list, read};
use crate::args::GlobalArgs;
use crate::cushion::CushionArgs;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::{Column, Printer, facts_table};
use crate::reading::{ReadArgs, VerticalArgs};
use crate::values::{Given, Reads, Values, choice, name_of};

/// Flags of runs.
#[derive(Debug, Args)]
pub(crate) struct RunArgs {
    #[command(flatten)]
    list: ListKeys,
    /// Height of one object, instead of an inventory
    #[arg(long, positive = Dimension::Length, help_heading = "One object")]
    height: Option<Given>,
    /// Horizontal size of the object in the plane of rocking
    #[arg(long, positive = Dimension::Length, help_heading = "One object")]
    thickness: Option<Given>,
    /// Mass of the object; needed for the shock
    #[arg(long, positive = Dimension::Mass, help_heading = "One object")]
    mass: Option<Given>,
    #[command(flatten)]
    shape: ShapeArgs,
    #[command(flatten)]
    cushion: CushionArgs,
    /// Restitution: angular velocity after an impact divided by the one before, in (0, 1]
    /// [default: Housner's]
    #[arg(long, any = Dimension::Ratio, conflicts_with = "restitution_factor", help_heading = "One object")]
    restitution: Option<Given>,
    /// Factor that multiplies Housner's restitution
    #[arg(long, positive = Dimension::Ratio, help_heading = "One object")]
    restitution_factor: Option<Given>,
    /// Duration of the half-sine pulse whose peak is --tolerance
    #[arg(long, positive = Dimension::Time, requires = "tolerance", help_heading = "One object")]
    tolerance_duration: Option<Given>,
    /// Velocity change that the object withstands; with --tolerance a damage boundary
    #[arg(long, positive = Dimension::Velocity, help_heading = "One object")]
    tolerance_velocity_change: Option<Given>,
    /// Uplift of the free edge that the object withstands
    #[arg(long, positive = Dimension::Length, help_heading = "One object")]
    tolerance_edge_lift: Option<Given>,
    /// Rotation divided by α beyond which `exceeds` is reached, such as 0.4; also for an inventory
    #[arg(long, conflicts_with = "outcomes", positive = Dimension::Ratio, help_heading = "The runs")]
    tolerance_rotation: Option<Given>,
    /// Records of the horizontal acceleration of the floor under the object
    #[arg(long, value_name = "FILE", num_args = 1.., help_heading = "One object")]
    motion: Vec<PathBuf>,
    /// Records of the vertical acceleration of the floor, positive upward: one for each --motion
    #[arg(long, value_name = "FILE", num_args = 1.., requires = "motion", help_heading = "One object")]
    vertical: Vec<PathBuf>,
    #[command(flatten)]
    vertically: VerticalArgs,
    #[command(flatten)]
    read: ReadArgs,
    /// Intensity measures, such as "pfv, pfa, sa(0.5), sa_avg(0.2:2), velocity_ratio"; the first one
    /// is that of fragility.csv [default: pfv, with a study pgv]
    #[arg(long, conflicts_with = "outcomes", value_name = "LIST", read = measures, help_heading = "The runs")]
    im: Option<Given<Vec<Measure>>>,
    /// How the runs are chosen
    #[arg(long, value_parser = choice(METHODS), default_value = name_of(METHODS, Method::Incremental), help_heading = "The runs")]
    method: Method,
    /// `adaptive`, or a grid "from:to:count" of equal ratios, or a list. For ida these are factors on the
    /// motions, such as "0.5:5:10"; for stripes intensities by the first measure, such as
    /// "0.1 m/s:2 m/s:12" [default: adaptive]
    #[arg(
        long,
        conflicts_with = "outcomes",
        value_name = "adaptive|GRID",
        help_heading = "The runs"
    )]
    scales: Option<String>,
    /// Largest factor on a motion [default: 10]
    #[arg(long, conflicts_with = "outcomes", positive = Dimension::Ratio, help_heading = "The runs")]
    max_scale: Option<Given>,
    /// Options (CSV), as for freestand risk: objects whose stiffness, base thickness or mass an option
    /// changes are also run as changed, with the id ID/option
    #[arg(
        long,
        conflicts_with = "outcomes",
        value_name = "FILE",
        help_heading = "The runs"
    )]
    options: Option<PathBuf>,
    /// Continue the runs of an inventory that Ctrl-C or a crash ended, in the same --out
    #[arg(long, conflicts_with = "outcomes", help_heading = "The runs")]
    resume: bool,
    /// Number of worlds, if the study generates its motions; records are used once each [default: 40]
    #[arg(long, conflicts_with = "outcomes", value_name = "N", value_parser = clap::value_parser!(u32).range(2..=10_000), help_heading = "The runs")]
    worlds: Option<u32>,
}

const MEASURE_COLUMNS: [Column; 8] = [
    ("id", "object", 0),
    ("limit_state", "limit state", 0),
    ("im", "measure", 0),
    ("efficiency", "efficiency", 3),
    ("practicality", "practicality", 3),
    ("proficiency", "proficiency", 3),
    ("p_mean_period", "p mean period", 0),
    ("p_pgv_over_pga", "p PGV/PGA", 0),
];

/// Motions, what their readers noted, and their files.
type Motions = (Vec<FloorMotion>, Vec<String>, Vec<InputFile>);

/// The path that a person wrote.
fn path(written: &Written) -> PathBuf {
    PathBuf::from(written.text())
}

impl RunArgs {
    /// What is run: something that names an object.
    pub(crate) fn is_given(&self) -> bool {
        self.is_given_beside_outcomes() || self.list.inventory.is_some()
    }

    /// As [`RunArgs::is_given`] with a table of outcomes, for which the inventory has costs.
    pub(crate) fn is_given_beside_outcomes(&self) -> bool {
        self.height.is_some()
            || self.thickness.is_some()
            || !self.motion.is_empty()
            || self.list.study.is_some()
    }

    /// How the cells of the list are read.
    pub(crate) fn cells(&self) -> &CellKeys {
        &self.list.cells
    }

    /// The list of the objects.
    pub(crate) fn inventory(&self) -> Option<PathBuf> {
        self.list.inventory.as_ref().map(path)
    }

    fn names_list(&self) -> bool {
        self.list.study.is_some() || self.list.inventory.is_some()
    }

    fn given_object(
        &self,
        args: &FragilityArgs,
        values: &mut Values,
    ) -> Result<GivenObject, Failure> {
        if self.motion.is_empty() {
            return Err(Failure::usage(
                "there are no motions to run",
                "give --motion FILE…, the motions of the floor under the object; or an inventory with a study",
            ));
        }
        let (height, thickness) = (values.read(&self.height), values.read(&self.thickness));
        if self.height.is_none() || self.thickness.is_none() {
            let message = "the size of the object is missing";
            return Err(Failure::usage(
                message,
                "give --height and --thickness, or an inventory with --inventory",
            ));
        }
        let mass = values.read(&self.mass);
        let cushion = self.cushion.edge(mass, values)?;
        if self.mass.is_none() && self.cushion.is_given() {
            let message = "the shock needs both the mass and the cushion of the object";
            values.push(Problem::value(
                message,
                "give --mass, or leave the cushion out",
            ));
        }
        let block = height
            .zip(thickness)
            .and_then(|size| self.shape.block(size, mass, values));
        let factor = values
            .read(&self.restitution_factor)
            .map_or(Restitution::Housner, Restitution::Factor);
        let restitution = values
            .read(&self.restitution)
            .map_or(factor, Restitution::Value);
        let blocks: Vec<_> = block.into_iter().collect();
        let restitution = values
            .take(checked(restitution, &blocks))
            .unwrap_or_default();
        let limits = Limits {
            peak_m_s2: values.read(&args.tolerance),
            duration_s: values.read(&self.tolerance_duration),
            velocity_change_m_s: values.read(&self.tolerance_velocity_change),
            edge_lift_m: values.read(&self.tolerance_edge_lift),
        };
        std::mem::take(values).finish()?;
        let Some(block) = block else {
            return Err(Failure::usage(
                "the size of the object is missing",
                "give --height and --thickness",
            ));
        };
        Ok(GivenObject {
            block,
            restitution,
            body: mass.zip(cushion),
            limits,
            motions: Vec::new(),
            is_on_ground: args.at == Some(At::Ground),
        })
    }

    /// The motions, with the notes of their readers and their files.
    fn motions(&self) -> Result<Motions, Failure> {
        let (mut motions, mut files) = (Vec::new(), Vec::new());
        let read = self.read.read_all(&self.motion)?;
        let mut notes = grouped(read.iter().flat_map(ReadMotion::named_notes));
        for read in read {
            let name = read.motion.name;
            files.push(InputFile {
                path: read.motion.path,
                sha256: read.motion.sha256,
            });
            motions.push(FloorMotion {
                name,
                horizontal: read.motion.motion,
                vertical: None,
            });
        }
        let count = self.vertical.len();
        if count == 0 {
            return Ok((motions, notes, files));
        }
        if count != motions.len() {
            return Err(Failure::usage(
                format!(
                    "--vertical has {}, --motion {}",
                    counted(count, "file"),
                    motions.len()
                ),
                "give one vertical record for each horizontal one, in the same order, or none",
            ));
        }
        let verticals = self.vertically.read_all(&self.read, &self.vertical)?;
        let named = verticals.iter().flat_map(ReadMotion::named_notes);
        notes.extend(grouped(
            named.map(|(name, note)| (format!("vertical {name}"), note)),
        ));
        for (motion, read) in motions.iter_mut().zip(verticals) {
            files.push(InputFile {
                path: read.motion.path.clone(),
                sha256: read.motion.sha256.clone(),
            });
            motion.vertical = Some(read.motion.motion);
            Base {
                horizontal: Some(&motion.horizontal),
                vertical: motion.vertical.as_ref(),
            }
            .check()
            .map_err(rocking_problem)?;
        }
        Ok((motions, notes, files))
    }

    /// Refuses flags of a list where nothing reads one.
    pub(super) fn refuse_list(&self) -> Result<(), Failure> {
        let worlds = self.worlds.map(|_| "--worlds".to_owned());
        let flag = of_list(&self.list).or(worlds);
        // Beside outcomes, an inventory has the costs.
        let flag = flag.or(of_cells(&self.list.cells).filter(|_| self.list.inventory.is_none()));
        flag.map_or(Ok(()), |flag| {
            let message =
                format!("{flag} is for an inventory in the building of a study, and none is run");
            Err(Failure::usage(
                message,
                "leave it out, or give --inventory or a study in place of one object",
            ))
        })
    }

    /// Refuses flags of one object if an inventory is given.
    fn refuse_object(&self, args: &FragilityArgs) -> Result<(), Failure> {
        let given = [
            (self.height.is_some(), "--height"),
            (self.thickness.is_some(), "--thickness"),
            (self.mass.is_some(), "--mass"),
            (self.cushion.is_given(), "a cushion"),
            (self.restitution.is_some(), "--restitution"),
            (self.restitution_factor.is_some(), "--restitution-factor"),
            (args.tolerance.is_some(), "--tolerance"),
            (
                self.tolerance_velocity_change.is_some(),
                "--tolerance-velocity-change",
            ),
            (self.tolerance_edge_lift.is_some(), "--tolerance-edge-lift"),
            (!self.motion.is_empty(), "--motion"),
        ];
        let found = given
            .into_iter()
            .find_map(|(is_given, name)| is_given.then_some(name))
            .or(self.shape.given());
        found.map_or(Ok(()), |name| {
            Err(Failure::usage(
                format!("{name} describes one object, but an inventory or a study is given"),
                "write it into the inventory, or leave the inventory and the study out; the motions of an inventory \
                 are those of its study",
            ))
        })
    }
}

/// The runs of the command, and their fit.
pub(crate) fn run(
    args: &FragilityArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    let runs = &args.runs;
    let mut values = Values::default();
    let asked = values.read(&runs.im).unwrap_or_default();
    let max_scale_ratio = values.read(&runs.max_scale).unwrap_or(DEFAULT_MAX_SCALE);
    let rotation_ratio = values.read(&runs.tolerance_rotation);
    let site_deg = values.read(&args.curve.site_coordinates);
    if args.ceiling.is_some() {
        let message = "--ceiling is for --outcomes only: runs calculate the ceiling";
        values.push(Problem::value(message, "leave it out"));
    }
    let listed = runs.names_list();
    if runs.options.is_some() && !listed {
        let message = "--options changes objects of an inventory, and none is given";
        values.push(Problem::value(
            message,
            "give --inventory, or the changed size in the flags",
        ));
    }
    if runs.resume && !(listed && global.out.is_some()) {
        let message = "--resume continues runs of an inventory in their folder";
        values.push(Problem::value(
            message,
            "give --inventory and --out, as in the earlier command",
        ));
    }
    if listed {
        runs.refuse_object(args)?;
        runs.read.refuse_without_record(|_| {
            "leave it out: the motions of an inventory are those of its study".into()
        })?;
    } else {
        runs.refuse_list()?;
    }
    let given = if listed {
        None
    } else {
        Some(runs.given_object(args, &mut values)?)
    };
    let first = asked
        .first()
        .copied()
        .unwrap_or(if listed { Measure::Pgv } else { Measure::Pfv });
    let grid = runs
        .scales
        .as_deref()
        .map(|text| scales(text, runs.method, first))
        .transpose();
    let grid = values
        .take(grid.map_err(|problem| problem.named("scales")))
        .flatten()
        .flatten();
    values.finish()?;

    let mut exports = Exports::new(args, runs.inventory().as_ref())?;
    // Stripes take it, or else a program; if nothing does, the runs say so.
    let hazard = exports
        .hazard
        .clone()
        .filter(|_| runs.method == Method::Stripes || !exports.takes_hazard());
    let (mut notes, mut sources) = (Vec::new(), Vec::new());
    let mut inputs: Vec<PathBuf> = runs.read.inputs(
        runs.motion
            .iter()
            .chain(&runs.vertical)
            .chain(&runs.cushion.inputs()),
    );
    inputs.extend(
        runs.options
            .iter()
            .chain(&args.curve.hazard)
            .cloned()
            .chain(runs.list.study.iter().map(path))
            .chain(runs.inventory()),
    );
    let files = Files::with_tables(
        global,
        &inputs,
        &args.tables,
        FRAGILITY_SCHEMA,
        Some(global.seed()),
    )?;
    let (study, inventory);
    let mut has_errors = false;
    let objects = match given {
        Some(object) => {
            let (motions, read, files) = runs.motions()?;
            (notes, sources) = (read, files);
            RunObjects::Given(Box::new(GivenObject { motions, ..object }))
        }
        None => {
            let (of_study, _, of_list) = read(&runs.list, global, None)?;
            (study, inventory) = (of_study, of_list);
            has_errors = inventory.has_errors();
            if let Some(path) = &study.source {
                sources.push(InputFile::new(path, &load(path)?));
            }
            sources.push(InputFile {
                path: inventory.path.clone(),
                sha256: inventory.sha256.clone(),
            });
            sources.extend(inventory.libraries.iter().cloned());
            let recorded = study.ground.recorded(&study.levels);
            sources.extend(recorded.map(|one| InputFile {
                path: one.path.clone(),
                sha256: one.sha256.clone(),
            }));
            let mut changed = Vec::new();
            if let Some(path) = &runs.options {
                let (file, objects) = load_changed(path)?;
                sources.push(file);
                changed = objects;
            }
            RunObjects::Listed {
                study: &study,
                inventory: &inventory,
                worlds: runs.worlds,
                changed,
            }
        }
    };
    let keep = global.out.clone().filter(|_| listed);
    let keep = keep.map(|folder| KeepRuns {
        folder,
        resume: runs.resume,
        force: global.force,
    });
    let is_kept = keep.is_some();
    let request = RunsRequest {
        objects,
        keep,
        measures: asked,
        at: args.at,
        method: runs.method,
        scales: grid,
        max_scale_ratio,
        hazard,
        site_deg,
        rotation_ratio,
        fit: args.fit,
        replicates: args.bootstrap,
        seed: global.seed(),
        inputs: sources,
    };
    // Made before the runs, so that no signal is missed between them and the files.
    let stop = printer.stop();
    let found = watched(printer, |progress| fragility_of_runs(&request, progress));
    let report = found.map_err(|problems| match is_kept && problems.is_stopped() {
        true => Failure::StoppedKeepingRuns,
        false => stopped(problems),
    })?;
    // Before anything is written, so that what cannot be exported leaves no folder.
    if let Some(first) = report.first() {
        exports.make(first)?;
    }
    let of_runs = notes.into_iter().chain(report.warnings.iter().cloned());
    let warnings: Vec<String> = of_runs.chain(exports.warnings.iter().cloned()).collect();
    let facts = report.facts(global.seed());
    if files.wanted() {
        let go_on = || match (stop.wanted(), is_kept) {
            (false, _) => Ok(()),
            (true, true) => Err(Failure::StoppedKeepingRuns),
            (true, false) => Err(Failure::Stopped { printed: false }),
        };
        write(&report, &facts, &warnings, &files, go_on)?;
        exports.write(&files)?;
    }
    files.finish_result(FRAGILITY_SCHEMA, &warnings)?;
    // The text begins with that sentence.
    let is_said = |warning: &String| !printer.json() && report.no_study() == Some(warning);
    let told: Vec<String> = warnings
        .into_iter()
        .filter(|warning| !is_said(warning))
        .collect();
    printer.result(FRAGILITY_SCHEMA, &facts, &told, || text(&report))?;
    Ok(Done {
        criterion_met: !has_errors,
    })
}

/// Writes the files. Before each of them it asks whether to continue, because tables and figures of
/// many runs take some seconds.
fn write(
    report: &RunsReport,
    facts: &Facts,
    warnings: &[String],
    files: &Files,
    go_on: impl Fn() -> Result<(), Failure>,
) -> Result<(), Failure> {
    for (place, (fit, outcomes)) in report.reports.iter().zip(&report.outcomes).enumerate() {
        let name = |what: &str| {
            file_name(what, place, fit.table.measure)
                .trim_end_matches(".csv")
                .to_owned()
        };
        go_on()?;
        files.table(&name("outcomes"), || Ok(outcomes.clone()))?;
        go_on()?;
        files.table(&name("fragility"), || fit.table())?;
        files.table(&name("empirical"), || fit.empirical_table())?;
    }
    if let Some(table) = report.left_out_table()? {
        files.table(LEFT_OUT.trim_end_matches(".csv"), || Ok(table))?;
    }
    go_on()?;
    let json = document(FRAGILITY_SCHEMA, facts, warnings)?;
    files.write("fragility.json", || json)?;
    if let Some(first) = report.first() {
        go_on()?;
        files.figure("fragility", || first.figure())?;
    }
    go_on()?;
    files.figure("ida", || report.ida_figure())?;
    go_on()?;
    files.figure("measures", || report.measures_figure())?;
    files.figure("residuals", || report.residuals_figure())?;
    go_on()
}

fn text(report: &RunsReport) -> String {
    let mut text = format!("{}\n", report.summary());
    for fit in &report.reports {
        text.push_str(&format!("\n{}", curves_text(fit)));
    }
    let rows = report.measure_rows();
    text.push_str(&format!("\n{}", facts_table(&rows, &MEASURE_COLUMNS)));
    text
}
