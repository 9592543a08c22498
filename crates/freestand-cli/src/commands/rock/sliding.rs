//! `freestand rock --sliding` and `--casters`: one object that slides or rolls.

use freestand::respond::{HistoryOptions, SlideHistory};
use freestand_output::facts::Facts;
use freestand_study::figures::slide_figure;
use freestand_study::sliding::{SlideReport, SlideRequest, StopShock, history_table, slide};

use super::{Reading, RockArgs, SCHEMA, place};
use crate::args::GlobalArgs;
use crate::commands::Done;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::{Column, Printer, facts_table};
use crate::values::Values;

/// The table of several motions.
const COLUMNS: [Column; 6] = [
    ("motion", "motion", 0),
    ("outcome", "outcome", 0),
    ("slide_peak_m", "slide [mm]", 4),
    ("slide_final_m", "at the end [mm]", 4),
    ("slide_speed_max_m_s", "speed [m/s]", 4),
    ("clearance_speed_m_s", "at the clearance [m/s]", 4),
];

/// The slide of the object; `None` if it is on braked casters that hold, so that it rocks.
pub(super) fn run(
    args: &RockArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Option<Done>, Failure> {
    let Some(request) = request(args)? else {
        return Ok(None);
    };
    let target = args.plot.target(global)?;
    args.refuse_one_file_for_several()?;
    let mut reading = Reading::of(args)?;
    if let Some(target) = &target {
        target.check(reading.horizontal.len().max(1))?;
    }
    let files = Files::with_tables(global, &reading.inputs, &args.tables, SCHEMA, None)?;
    let recorded = args.history.is_some() || files.wanted() || target.is_some();
    let mut request = SlideRequest {
        vertical: reading.vertical.take(),
        ..request
    };
    request.how.is_sampled = recorded;
    let motions = std::mem::take(&mut reading.horizontal);
    let is_one = motions.len() < 2;
    let (mut results, mut plots, mut history) = (Vec::new(), Vec::new(), Vec::new());
    // Without a horizontal motion there is one result, which sticks.
    let mut motions: Vec<_> = motions
        .into_iter()
        .map(|(name, motion)| (name, Some(motion)))
        .collect();
    if motions.is_empty() {
        motions.push(("vertical motion".to_owned(), None));
    }
    for (index, (name, horizontal)) in motions.into_iter().enumerate() {
        let report = slide(&SlideRequest {
            horizontal,
            ..request.clone()
        })?;
        let file = if is_one {
            "history".to_owned()
        } else {
            format!("history-{:02}-{name}", index + 1)
        };
        if let Some(target) = &target
            && let Some(figure) = slide_figure(
                &name,
                &request.block,
                &request.surface,
                &report.history.samples,
            )?
        {
            plots.extend(place(
                target,
                vec![(file.clone(), figure)],
                &files,
                &reading.inputs,
            )?);
        }
        let SlideReport {
            facts,
            warnings,
            history: SlideHistory {
                samples: points, ..
            },
        } = report;
        if is_one {
            reading.warnings.extend(warnings);
            results.push(facts);
            history = points;
        } else {
            files.table(&file, || Ok(history_table(&points)))?;
            reading
                .warnings
                .extend(warnings.iter().map(|warning| format!("{name}: {warning}")));
            results.push(Facts::default().key("motion", name).and(facts));
        }
    }
    if is_one {
        let facts = results.pop().unwrap_or_default();
        let facts = if target.is_some() {
            facts.key("plots", plots)
        } else {
            facts
        };
        let finished = (facts, Vec::new());
        return reading
            .finish(
                args.history.as_deref(),
                || history_table(&history),
                finished,
                files,
                printer,
            )
            .map(Some);
    }
    let table = facts_table(&results, &COLUMNS);
    let facts = Facts::default()
        .key("results", results)
        .key("plots", plots)
        .key("processing", reading.processing);
    files.print(printer, SCHEMA, &facts, &reading.warnings, || table)?;
    Ok(Some(Done::OK))
}

/// What is asked, without its motions; `None` for an object that rocks.
fn request(args: &RockArgs) -> Result<Option<SlideRequest>, Failure> {
    let mut values = Values::default();
    let height = values.read(&args.height);
    let thickness = values.read(&args.thickness);
    let mass = values.read(&args.mass);
    let block = height
        .zip(thickness)
        .and_then(|size| args.shape.block(size, mass, &mut values));
    let friction = values.read(&args.friction);
    let surface = args.sliding.surface(friction, &mut values);
    let stop = surface.and_then(|surface| {
        let stiffness_n_m = values.read(&args.sliding.stop_stiffness);
        values.take(StopShock::new(stiffness_n_m, mass, &surface.clearance))
    });
    let gravity = values.read(&args.gravity);
    let duration = values.read(&args.duration);
    let slides = block
        .zip(surface)
        .and_then(|(block, surface)| values.take(surface.carries(&block)));
    values.finish()?;
    let (Some((block, surface)), Some(true)) = (block.zip(surface), slides) else {
        return Ok(None);
    };
    let of_rocking = args.rocking.of_rigid_base();
    let started = [
        ("--initial-rotation", args.initial_rotation.is_some()),
        ("--initial-velocity", args.initial_velocity.is_some()),
        ("the cushion", args.cushion.is_given()),
    ];
    let of_rocking = of_rocking.or(started
        .into_iter()
        .find_map(|(name, given)| given.then_some(name)));
    if let Some(name) = of_rocking {
        let message =
            format!("{name} applies only to an object that rocks, and this one slides or rolls");
        return Err(Failure::usage(
            message,
            "leave it out, or leave --sliding or --casters out",
        ));
    }
    if args.motion.is_empty() && args.vertical.is_none() {
        return Err(Failure::usage(
            "nothing moves the object",
            "give --motion FILE",
        ));
    }
    let how = HistoryOptions {
        settings: args.settings(gravity, duration),
        ..HistoryOptions::default()
    };
    let stop = stop.flatten();
    Ok(Some(SlideRequest {
        block,
        surface,
        horizontal: None,
        vertical: None,
        stop,
        how,
    }))
}
