//! The inputs, with units.

use freestand::G0_M_S2;
use freestand::building::Model;
use freestand::measures::measures;
use freestand::synthesis;

use freestand_input::file::file_name;
use freestand_input::words::{fixed, number, percent};
use freestand_study::building::{damping_words, model_words};
use freestand_study::cushion::{EdgeCushion, cushion_words};
use freestand_study::result::StudyResult;
use freestand_study::study::{
    BuildingInput, Ground, RecordedMotion, SimulatedGround, Study, SyntheticGround,
};
use freestand_study::suite::Suite;
use freestand_study::summary::accuracy_words;
use freestand_study::target::Target;

use super::super::summary::restitution_words;
use super::{headings, or_dash};
use crate::doubts::{cushion_notes, dispersion, mean_off, period_from};
use crate::ground;
use crate::target::facts as facts_of;
use freestand_output::html::{figure, heading, paragraph, properties, table, words};

/// Ground, building and objects.
pub(super) fn inputs(study: &Study, result: &StudyResult) -> String {
    let mut html = heading("Ground motions");
    match &study.ground {
        Ground::Synthetic(synthetic) => html += &synthetic_ground(synthetic, result),
        Ground::Simulated(simulated) => html += &simulated_ground(simulated, result),
        Ground::Recorded(records) => {
            if let Some(target) = study.ground.target() {
                html += &properties("", &facts_of(target));
            }
            html += &study
                .ground
                .suite()
                .map_or_else(String::new, suite_selected);
            html += &recorded_motions(
                "Recorded motions as used",
                &records.iter().collect::<Vec<_>>(),
            );
            html += &study
                .ground
                .target()
                .map_or_else(String::new, |target| misfits(target, result));
        }
        Ground::OnFloors => html += &paragraph("None: the study gives the motions of the floors."),
    }
    html += &vertical_motion(study, result);
    if let Some(input) = &study.building {
        html += &heading("Building");
        html += &building(study, input, result);
    } else {
        html += &heading("Floor motions");
        for level in &study.levels {
            let caption = format!("Motions given for the level {}, as used", level.name);
            html += &recorded_motions(&caption, &level.motions.iter().collect::<Vec<_>>());
        }
    }
    html += &heading("Objects");
    html += &objects(study);
    html
}

/// Where the vertical motion comes from, and how strong it is.
fn vertical_motion(study: &Study, result: &StudyResult) -> String {
    let words = ground::vertical_motion(&study.ground);
    let peaks_g = result
        .ground
        .iter()
        .filter_map(|ground| Some(ground.vertical.as_ref()?.peak_m_s2() / G0_M_S2));
    let facts = match peaks_g.reduce(f64::max) {
        None => vec![("Vertical motion", words)],
        Some(peak_g) => vec![
            ("Vertical motion", words),
            ("Largest vertical PGA", format!("{} g", fixed(peak_g, 3))),
            ("Vertical acceleration of floors above the ground", {
                format!(
                    "{} times that of the ground",
                    number(study.vertical_amplification_ratio, 4)
                )
            }),
        ],
    };
    properties("", &facts)
}

fn synthetic_ground(synthetic: &SyntheticGround, result: &StudyResult) -> String {
    let target = &synthetic.target;
    let mut facts = facts_of(target);
    facts.push(("Motions", synthetic.count.to_string()));
    facts.push(("Seed", synthetic.seed.to_string()));
    properties("", &facts) + &misfits(target, result)
}

/// How well the motions fit their target.
fn misfits(target: &Target, result: &StudyResult) -> String {
    let headings = headings(
        ["Motion"],
        [
            "rms misfit",
            "worst misfit",
            "at T (s)",
            "PGA (g)",
            "target ZPA (g)",
            "PGA/ZPA",
            "PGV (m/s)",
            "D5–95 (s)",
        ],
    );
    let rows: Vec<_> = result
        .ground
        .iter()
        .filter_map(|ground| {
            let m = ground.misfit.as_ref()?;
            Some(vec![
                words(&ground.name),
                figure(percent(m.rms_ratio, 1)),
                figure(format!("{:+.1} %", 100.0 * m.worst_ratio)),
                figure(fixed(m.worst_period_s, 3)),
                figure(fixed(m.pga_g, 3)),
                figure(fixed(m.target_zpa_g, 3)),
                figure(fixed(m.pga_g / m.target_zpa_g, 2)),
                figure(fixed(m.pgv_m_s, 3)),
                figure(fixed(m.d5_95_s, 1)),
            ])
        })
        .collect();
    let why = paragraph(&format!(
        "The misfit is the spectrum of the motion divided by the target, minus one, at {} periods from {} s to {} s. \
         Why the PGA exceeds the target’s value at zero period (ZPA): the plateau of {} is {} times its ZPA. A \
         motion whose spectrum has such a plateau cannot have such a small peak; the motions are matched from {} s \
         on, and their PGA follows from that. It is not scaled down, because that would lower the plateau too.",
        synthesis::MATCHED_PERIODS,
        synthesis::SHORTEST_PERIOD_S,
        synthesis::LONGEST_PERIOD_S,
        target.site_words(),
        fixed(target.spectrum.plateau_g() / target.spectrum.sa_g(0.0), 2),
        synthesis::SHORTEST_PERIOD_S,
    ));
    table("How well the motions fit their target", &headings, &rows) + &why
}

fn simulated_ground(simulated: &SimulatedGround, result: &StudyResult) -> String {
    let request = &simulated.request;
    let mut facts: Vec<(&str, String)> = vec![
        (
            "Source",
            format!("stochastic point source, preset {}", request.preset.name()),
        ),
        (
            "Source and path",
            ground::source_words(&request.any_source()),
        ),
    ];
    if let Some(code) = &simulated.hazard {
        let meets = format!(
            "the rock spectrum (Be) of {} for kpZ = {} g from T = 0.5 to 1 s, as the mean of {} motions",
            code.spectrum.name(),
            number(code.kpz_g().unwrap_or(0.0), 4),
            request.count
        );
        facts.push(("Hazard", code.one_line()));
        facts.push(("Distances fitted to", meets));
    }
    let site = format!("{}: {}", request.site.name(), request.site.description());
    let (dt_s, low_cut_hz) = (
        number(request.options.dt_s, 4),
        number(request.options.low_cut_hz, 4),
    );
    facts.extend([
        ("Site class", site),
        ("Time step, low cut", format!("{dt_s} s, {low_cut_hz} Hz")),
        ("Motions of each earthquake", request.count.to_string()),
        ("Seed", request.seed.to_string()),
    ]);
    let headings = headings(
        ["Motion"],
        [
            "M",
            "R (km)",
            "corner (Hz)",
            "T_d (s)",
            "PGA (g)",
            "PGV (m/s)",
            "D5–95 (s)",
        ],
    );
    let rows: Vec<_> = simulated
        .motions()
        .zip(&result.ground)
        .map(|((found, _), ground)| {
            let m = measures(&ground.motion.along);
            let corners: Vec<String> = found
                .corner_frequencies_hz()
                .iter()
                .map(|hz| number(*hz, 3))
                .collect();
            vec![
                words(&ground.name),
                figure(number(found.source.magnitude, 3)),
                figure(fixed(found.source.distance_m / 1e3, 1)),
                figure(corners.join(", ")),
                figure(fixed(found.source.duration_s(), 2)),
                figure(fixed(m.pga_m_s2 / G0_M_S2, 3)),
                figure(fixed(m.pgv_m_s, 3)),
                figure(fixed(m.d5_95_s, 1)),
            ]
        })
        .collect();
    properties("", &facts)
        + &table("Simulated motions", &headings, &rows)
        + &paragraph(
            "M: moment magnitude; R: distance; corner: corner frequency or frequencies of the source spectrum; T_d: \
             duration of the window.",
        )
}

/// The target of a suite, what the suite reaches, and the files that it could not use.
fn suite_selected(suite: &Suite) -> String {
    let mut facts = facts_of(&suite.target);
    let folder = file_name(&suite.folder).unwrap_or_default();
    facts.extend([
        (
            "Suite",
            format!("{}, of the folder {folder}", ground::count_words(suite)),
        ),
        ("Periods compared", ground::period_words(suite)),
        (
            "Mean of ln Sa against ln of the target",
            mean_off(suite.mean_off()),
        ),
        (
            "Standard deviation of ln Sa",
            dispersion(suite.dispersion()),
        ),
        (
            "Files that are not records of horizontal motion",
            suite.skipped.join(", "),
        ),
    ]);
    let rows: Vec<_> = suite
        .left_out
        .iter()
        .map(|one| vec![words(&one.file), words(&one.reason)])
        .collect();
    let left_out = if rows.is_empty() {
        String::new()
    } else {
        table(
            "Left out of the suite",
            &[vec![words("File"), words("Why")]],
            &rows,
        )
    };
    properties("", &facts) + &left_out
}

fn recorded_motions(caption: &str, records: &[&RecordedMotion]) -> String {
    let headings = headings(
        ["Motion", "File", "Read as"],
        ["Scale", "PGA (g)", "dt (s)", "Duration (s)"],
    );
    let rows: Vec<_> = records
        .iter()
        .map(|record| {
            let motion = &record.motion;
            let file = file_name(&record.path).unwrap_or_default();
            vec![
                words(&record.name),
                words(&file),
                words(&record.description),
                figure(number(record.scale_ratio, 6)),
                figure(fixed(motion.peak_m_s2() / G0_M_S2, 3)),
                figure(number(motion.dt_s(), 4)),
                figure(fixed(motion.duration_s(), 1)),
            ]
        })
        .collect();
    let mut html = table(caption, &headings, &rows);
    html += &processing(records);
    if records.len() < 7 {
        html += &paragraph("Percentiles of so few motions are coarse estimates.");
    }
    html
}

/// The processing of each motion, if any.
fn processing(records: &[&RecordedMotion]) -> String {
    let rows: Vec<_> = records
        .iter()
        .filter(|record| !record.processing.is_empty())
        .map(|record| vec![words(&record.name), words(&record.processing.join("; "))])
        .collect();
    if rows.is_empty() {
        return String::new();
    }
    table(
        "Processing, in this order",
        &[vec![words("Motion"), words("Processing")]],
        &rows,
    )
}

fn building(study: &Study, building: &BuildingInput, result: &StudyResult) -> String {
    let beam = &building.along;
    let height_m = building.height_m;
    let storeys = match building.storey_height_m {
        Some(storey_m) => {
            format!(
                "{} of {} m, {} m in all",
                building.storeys,
                number(storey_m, 4),
                number(height_m, 5)
            )
        }
        None => format!("{}, {} m in all", building.storeys, number(height_m, 5)),
    };
    let across = building.across.as_ref().map_or_else(String::new, |across| {
        let from = building.across_from.as_ref().map(period_from);
        let (model, period) = (model_words(across), number(across.period_s(), 4));
        format!(
            "{model}; T₁ = {period} s: {}; damping {}",
            from.unwrap_or_default(),
            damping_words(across)
        )
    });
    let mut html = properties(
        "",
        &[
            ("Name", study.building_name.clone().unwrap_or_default()),
            ("Model", format!("{}, linear", model_words(beam))),
            ("Storeys", storeys),
            (
                "Fundamental period T₁",
                format!(
                    "{} s: {}",
                    number(beam.period_s(), 4),
                    period_from(&building.period_from)
                ),
            ),
            ("Damping", damping_words(beam)),
            ("Second axis", across),
            (
                "Levels",
                study
                    .levels
                    .iter()
                    .map(|l| {
                        let ratio = l.level_ratio.unwrap_or(1.0);
                        format!(
                            "{} at {} m (z/H = {})",
                            l.name,
                            number(ratio * height_m, 4),
                            number(ratio, 3)
                        )
                    })
                    .collect::<Vec<_>>()
                    .join("; "),
            ),
        ],
    );
    let headings = headings(
        [],
        [
            "Mode",
            "Period (s)",
            "Participation Γ",
            "Effective mass",
            "Sum",
        ],
    );
    let mut sum = Some(0.0);
    let rows: Vec<_> = result
        .modes
        .iter()
        .enumerate()
        .map(|(i, mode)| {
            sum = sum
                .zip(mode.effective_mass_ratio())
                .map(|(sum, mass)| sum + mass);
            let share = |ratio: Option<f64>| or_dash(ratio, |ratio| percent(ratio, 1));
            vec![
                figure((i + 1).to_string()),
                figure(fixed(mode.period_s(), 3)),
                figure(fixed(mode.participation_ratio(), 3)),
                share(mode.effective_mass_ratio()),
                share(sum),
            ]
        })
        .collect();
    let title = match beam.model() {
        Model::Table { .. } => "Modes (shapes as in the table)",
        Model::Beam { .. } => "Modes (shapes are 1 at the roof)",
        Model::Shear { .. } => {
            "Modes (shapes are 1 at the roof, or at their maximum if the roof hardly moves)"
        }
    };
    html += &table(title, &headings, &rows);
    html
}

fn objects(study: &Study) -> String {
    let objects = &study.objects;
    let tolerance = objects
        .tolerance_m_s2
        .map(|a| format!("{} g", number(a / G0_M_S2, 4)))
        .unwrap_or_default();
    let friction = objects.friction.map_or_else(
        || {
            format!(
                "not given; the warnings assume {}",
                freestand::impact::ASSUMED_FRICTION
            )
        },
        |mu| number(mu, 3),
    );
    properties(
        "",
        &[
            ("Heights h", grid_words(&objects.heights_m, 1.0, "m")),
            (
                "Thicknesses t",
                grid_words(&objects.thicknesses_m, 1e3, "mm"),
            ),
            ("Mass m", format!("{} kg", number(objects.mass_kg, 6))),
            ("Cushion under one edge", edge_words(&objects.cushion)),
            ("Restitution r", restitution_words(objects.restitution)),
            ("Accuracy of the solver", accuracy_words(objects.accuracy)),
            ("Shock tolerance of the objects", tolerance),
            ("Coefficient of friction", friction),
        ],
    )
}

/// All values of a short list, the ends of a long one.
fn grid_words(values: &[f64], factor: f64, unit: &str) -> String {
    const WHOLE: usize = 8;
    let text = |v: &f64| number(v * factor, 5);
    match (values.first(), values.last()) {
        (Some(first), Some(last)) if values.len() > WHOLE => {
            format!(
                "{} values from {} to {} {unit}",
                values.len(),
                text(first),
                text(last)
            )
        }
        _ => format!(
            "{} {unit}",
            values.iter().map(text).collect::<Vec<_>>().join(", ")
        ),
    }
}

fn edge_words(edge: &EdgeCushion) -> String {
    let words = format!(
        "{}, all the cushion under that edge",
        cushion_words(&edge.cushion)
    );
    if edge.notes.is_empty() {
        return words;
    }
    format!("{words} ({})", cushion_notes(&edge.notes).join("; "))
}
