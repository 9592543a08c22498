//! `freestand check`: a study validated and explained, without running it.

use std::path::{Path, PathBuf};

use clap::Args;
use freestand_input::quantity::{Dimension, format_si};
use freestand_study::building::{damping_words, model_words};
use freestand_study::cushion::cushion_words;
use freestand_study::resolve::{Overrides, builtin, load, motion_paths};
use freestand_study::simulated::FoundEarthquake;
use freestand_study::study::{BuildingInput, Ground, RecordedMotion, SimulatedGround, Study};
use serde::Serialize;

use super::Done;
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::{Printer, pairs, significant};
use crate::reading::path_text;

/// Check a study without running it, and show how it was understood
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand check study.toml
  freestand check study.toml --json
  freestand check            (the built-in study)")]
pub(crate) struct CheckArgs {
    /// Study file (TOML) [default: the built-in study]
    #[arg(value_name = "STUDY.toml")]
    study: Option<PathBuf>,
}

#[derive(Debug, Serialize)]
struct CheckReport {
    path: Option<String>,
    ground: String,
    motions: Vec<MotionReport>,
    directions_deg: Vec<f64>,
    #[serde(flatten)]
    building: Option<BuildingReport>,
    levels: Vec<LevelReport>,
    heights_m: Vec<f64>,
    thicknesses_m: Vec<f64>,
    objects: usize,
    mass_kg: f64,
    stiffness_n_m: Option<f64>,
    cushion: String,
    cushion_notes: Vec<String>,
    tolerance_g: Option<f64>,
}

/// The building, where the motions of the floors are computed.
#[derive(Debug, Serialize)]
struct BuildingReport {
    storeys: usize,
    building_height_m: f64,
    period_s: f64,
    damping_ratio: Option<f64>,
    shear_flexure_ratio: Option<f64>,
    modes: usize,
    model: String,
    across: Option<String>,
}

#[derive(Debug, Serialize)]
struct MotionReport {
    name: String,
    path: String,
    description: String,
    sha256: String,
    dt_s: f64,
    npts: usize,
    components: usize,
    pga_g: f64,
    /// Of a record that is matched to a spectrum.
    rms_misfit_ratio: Option<f64>,
}

#[derive(Debug, Serialize)]
struct LevelReport {
    name: String,
    level_ratio: Option<f64>,
}

pub(crate) fn run(args: &CheckArgs, global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
    let overrides = Overrides { seed: global.seed, ..Overrides::default() };
    let study = match &args.study {
        Some(path) => load(path, &overrides)?,
        None => builtin(&overrides)?,
    };
    let inputs: Vec<PathBuf> = args.study.iter().cloned().chain(motion_paths(&study)).collect();
    let files = Files::begin(global, &inputs)?;
    let report = report(&study);
    files.print(printer, "freestand.check/1", &report, &study.warnings, || text(&study, &report))?;
    Ok(Done::OK)
}

fn report(study: &Study) -> CheckReport {
    let objects = &study.objects;
    let (ground, motions) = match &study.ground {
        Ground::Synthetic(synthetic) => {
            let line = synthetic.target.one_line();
            let text = format!("{} synthetic motions, seed {}, {line}", synthetic.count, synthetic.seed);
            (text, Vec::new())
        }
        Ground::Simulated(simulated) => (simulated_words(simulated), Vec::new()),
        Ground::Recorded(recorded) => {
            let matched = recorded.iter().find_map(|one| one.matched.as_ref());
            let words =
                matched.map_or_else(String::new, |matched| format!(", matched to {}", matched.target.one_line()));
            (format!("{} recorded motions{words}", recorded.len()), recorded.iter().map(motion_report).collect())
        }
        Ground::OnFloors => {
            let motions: Vec<MotionReport> = study.ground.recorded(&study.levels).map(motion_report).collect();
            (format!("none: {} motions of floors are given", motions.len()), motions)
        }
    };
    CheckReport {
        path: study.source.as_deref().map(path_text),
        ground,
        motions,
        directions_deg: study.directions_deg.clone(),
        building: study.building.as_ref().map(building_report),
        levels: study
            .levels
            .iter()
            .map(|level| LevelReport { name: level.name.clone(), level_ratio: level.level_ratio })
            .collect(),
        heights_m: objects.heights_m.clone(),
        thicknesses_m: objects.thicknesses_m.clone(),
        objects: objects.blocks.len(),
        mass_kg: objects.mass_kg,
        stiffness_n_m: objects.cushion.cushion.linear_stiffness_n_m(),
        cushion: cushion_words(&objects.cushion.cushion),
        cushion_notes: objects.cushion.notes.clone(),
        tolerance_g: objects.tolerance_m_s2.map(|tolerance| tolerance / freestand::G0_M_S2),
    }
}

/// `10 simulated motions, seed 1, victoria, site Be, M 6 at 30 km`.
fn simulated_words(simulated: &SimulatedGround) -> String {
    let request = &simulated.request;
    let each = |found: &FoundEarthquake| {
        format!("M {} at {} km", significant(found.source.magnitude, 2), significant(found.source.distance_m / 1e3, 3))
    };
    let code = simulated.hazard.as_ref().map_or_else(String::new, |code| format!(", for {}", code.one_line()));
    format!(
        "{} simulated motions, seed {}, {}, site {}: {}{code}",
        simulated.motions().count(),
        request.seed,
        request.preset.name(),
        request.site.name(),
        simulated.earthquakes.iter().map(each).collect::<Vec<_>>().join(", ")
    )
}

fn motion_report(one: &RecordedMotion) -> MotionReport {
    MotionReport {
        name: one.name.clone(),
        path: path_text(&one.path),
        description: one.description.clone(),
        sha256: one.sha256.clone(),
        dt_s: one.motion.dt_s(),
        npts: one.motion.accel_m_s2().len(),
        components: if one.across.is_some() { 2 } else { 1 },
        pga_g: one.as_used().peak_m_s2() / freestand::G0_M_S2,
        rms_misfit_ratio: one.matched.as_ref().map(|matched| matched.misfit.rms_ratio),
    }
}

fn building_report(building: &BuildingInput) -> BuildingReport {
    BuildingReport {
        storeys: building.storeys,
        building_height_m: building.height_m,
        period_s: building.along.period_s(),
        damping_ratio: building.along.damping_ratio(),
        shear_flexure_ratio: building.along.shear_flexure_ratio(),
        modes: building.along.modes().len(),
        model: model_words(&building.along),
        across: building.across.as_ref().map(|across| {
            let period_s = significant(across.period_s(), 4);
            format!("{}, period {period_s} s, damping {}", model_words(across), damping_words(across))
        }),
    }
}

fn text(study: &Study, report: &CheckReport) -> String {
    let length = |value: f64| format_si(value, Dimension::Length);
    let range = |values: &[f64]| match (values.first(), values.last()) {
        (Some(&first), Some(&last)) if values.len() > 1 => {
            format!("{} values from {} to {}", values.len(), length(first), length(last))
        }
        (Some(&only), _) => length(only),
        _ => "-".to_owned(),
    };
    let levels: Vec<String> = report
        .levels
        .iter()
        .map(|level| level.name.clone() + &level.level_ratio.map_or_else(String::new, |x| format!(" (x = {x})")))
        .collect();
    let source = study.source.as_deref().map_or_else(|| "built-in".to_owned(), |path: &Path| path_text(path));
    let mut rows = vec![("study", format!("{source}: valid")), ("ground", report.ground.clone())];
    for one in &report.motions {
        let rms = one.rms_misfit_ratio.map(|rms| format!(", rms misfit {} %", significant(100.0 * rms, 2)));
        let (pga, rms) = (significant(one.pga_g, 4), rms.unwrap_or_default());
        rows.push(("", format!("{}: {}, PGA {pga} g{rms}", one.name, one.description)));
    }
    if let (Some(building), Some(input)) = (&report.building, &study.building) {
        rows.push(("building", format!("{} storeys, {} high", building.storeys, length(building.building_height_m))));
        rows.push(("period", format!("{} s: {}", significant(building.period_s, 4), input.period_note)));
        rows.push((
            "model",
            format!("{}, damping {}, {} modes", building.model, damping_words(&input.along), building.modes),
        ));
        rows.extend(building.across.iter().map(|across| ("second axis", across.clone())));
    }
    if report.directions_deg.len() > 1 {
        rows.push(("directions", format!("{} over half a circle, the worst counts", report.directions_deg.len())));
    }
    rows.push(("levels", levels.join(", ")));
    rows.push(("heights", range(&report.heights_m)));
    rows.push(("thicknesses", range(&report.thicknesses_m)));
    rows.push((
        "objects",
        format!(
            "{} of {} on {} under one edge",
            report.objects,
            format_si(report.mass_kg, Dimension::Mass),
            report.cushion
        ),
    ));
    rows.extend(report.cushion_notes.iter().map(|note| ("note", note.clone())));
    pairs(&rows)
}
