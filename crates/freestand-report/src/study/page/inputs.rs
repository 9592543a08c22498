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
use freestand_output::html::{figure, properties, table, words};
use maud::{Markup, html};

/// Ground, building and objects.
pub(super) fn inputs(study: &Study, result: &StudyResult) -> Markup {
    html! {
        h3 { "Ground motions" }
        (ground_motions(study, result))
        (vertical_motion(study, result))
        @if let Some(input) = &study.building {
            h3 { "Building" }
            (building(study, input, result))
        } @else {
            h3 { "Floor motions" }
            @for level in &study.levels {
                @let caption = format!("Motions given for the level {}, as used", level.name);
                (recorded_motions(&caption, &level.motions))
            }
        }
        h3 { "Objects" }
        (objects(study))
    }
}

fn ground_motions(study: &Study, result: &StudyResult) -> Markup {
    match &study.ground {
        Ground::Synthetic(synthetic) => synthetic_ground(synthetic, result),
        Ground::Simulated(simulated) => simulated_ground(simulated, result),
        Ground::Recorded(records) => {
            let target = study.ground.target();
            html! {
                @if let Some(target) = target { (properties("", &facts_of(target))) }
                @if let Some(suite) = study.ground.suite() { (suite_selected(suite)) }
                (recorded_motions("Recorded motions as used", records))
                @if let Some(target) = target { (misfits(target, result)) }
            }
        }
        Ground::OnFloors => html! { p { "None: the study gives the motions of the floors." } },
    }
}

/// Where the vertical motion comes from, and how strong it is.
fn vertical_motion(study: &Study, result: &StudyResult) -> Markup {
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

fn synthetic_ground(synthetic: &SyntheticGround, result: &StudyResult) -> Markup {
    let target = &synthetic.target;
    let mut facts = facts_of(target);
    facts.push(("Motions", synthetic.count.to_string()));
    facts.push(("Seed", synthetic.seed.to_string()));
    html! {
        (properties("", &facts))
        (misfits(target, result))
    }
}

/// How well the motions fit their target.
fn misfits(target: &Target, result: &StudyResult) -> Markup {
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
    let rows = result.ground.iter().filter_map(|ground| {
        let m = ground.misfit.as_ref()?;
        Some([
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
    });
    let plateau_over_zpa = target.spectrum.plateau_g() / target.spectrum.sa_g(0.0);
    html! {
        (table("How well the motions fit their target", &headings, rows))
        p {
            "The misfit is the spectrum of the motion divided by the target, minus one, at "
            (synthesis::MATCHED_PERIODS) " periods from " (synthesis::SHORTEST_PERIOD_S) " s to "
            (synthesis::LONGEST_PERIOD_S)
            " s. Why the PGA exceeds the target’s value at zero period (ZPA): the plateau of "
            (target.site_words()) " is " (fixed(plateau_over_zpa, 2))
            " times its ZPA. A motion whose spectrum has such a plateau cannot have such a small peak; the motions \
             are matched from "
            (synthesis::SHORTEST_PERIOD_S)
            " s on, and their PGA follows from that. It is not scaled down, because that would lower the plateau too."
        }
    }
}

fn simulated_ground(simulated: &SimulatedGround, result: &StudyResult) -> Markup {
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
    let motions = simulated.motions().zip(&result.ground);
    let rows = motions.map(|((found, _), ground)| {
        let m = measures(&ground.motion.along);
        let corners: Vec<String> = found
            .corner_frequencies_hz()
            .iter()
            .map(|hz| number(*hz, 3))
            .collect();
        [
            words(&ground.name),
            figure(number(found.source.magnitude, 3)),
            figure(fixed(found.source.distance_m / 1e3, 1)),
            figure(corners.join(", ")),
            figure(fixed(found.source.duration_s(), 2)),
            figure(fixed(m.pga_m_s2 / G0_M_S2, 3)),
            figure(fixed(m.pgv_m_s, 3)),
            figure(fixed(m.d5_95_s, 1)),
        ]
    });
    html! {
        (properties("", &facts))
        (table("Simulated motions", &headings, rows))
        p {
            "M: moment magnitude; R: distance; corner: corner frequency or frequencies of the source spectrum; T_d: \
             duration of the window."
        }
    }
}

/// The target of a suite, what the suite reaches, and the files that it could not use.
fn suite_selected(suite: &Suite) -> Markup {
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
    let left_out = suite.left_out.iter();
    let left_out = left_out.map(|one| [words(&one.file), words(&one.reason)]);
    html! {
        (properties("", &facts))
        @if !suite.left_out.is_empty() {
            (table("Left out of the suite", &["File", "Why"].map(words), left_out))
        }
    }
}

fn recorded_motions(caption: &str, records: &[RecordedMotion]) -> Markup {
    let headings = headings(
        ["Motion", "File", "Read as"],
        ["Scale", "PGA (g)", "dt (s)", "Duration (s)"],
    );
    let rows = records.iter().map(|record| {
        let motion = &record.motion;
        [
            words(&record.name),
            words(file_name(&record.path).unwrap_or_default()),
            words(&record.description),
            figure(number(record.scale_ratio, 6)),
            figure(fixed(motion.peak_m_s2() / G0_M_S2, 3)),
            figure(number(motion.dt_s(), 4)),
            figure(fixed(motion.duration_s(), 1)),
        ]
    });
    let processed: Vec<_> = records
        .iter()
        .filter(|record| !record.processing.is_empty())
        .map(|record| [words(&record.name), words(record.processing.join("; "))])
        .collect();
    html! {
        (table(caption, &headings, rows))
        @if !processed.is_empty() {
            (table("Processing, in this order", &["Motion", "Processing"].map(words), processed))
        }
        @if records.len() < 7 { p { "Percentiles of so few motions are coarse estimates." } }
    }
}

fn building(study: &Study, building: &BuildingInput, result: &StudyResult) -> Markup {
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
    let levels = study.levels.iter().map(|l| {
        let ratio = l.level_ratio.unwrap_or(1.0);
        format!(
            "{} at {} m (z/H = {})",
            l.name,
            number(ratio * height_m, 4),
            number(ratio, 3)
        )
    });
    let facts = [
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
        ("Levels", levels.collect::<Vec<_>>().join("; ")),
    ];
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
    let rows = result.modes.iter().enumerate().map(|(i, mode)| {
        sum = sum
            .zip(mode.effective_mass_ratio())
            .map(|(sum, mass)| sum + mass);
        let share = |ratio: Option<f64>| or_dash(ratio, |ratio| percent(ratio, 1));
        [
            figure(i + 1),
            figure(fixed(mode.period_s(), 3)),
            figure(fixed(mode.participation_ratio(), 3)),
            share(mode.effective_mass_ratio()),
            share(sum),
        ]
    });
    let title = match beam.model() {
        Model::Table { .. } => "Modes (shapes as in the table)",
        Model::Beam { .. } => "Modes (shapes are 1 at the roof)",
        Model::Shear { .. } => {
            "Modes (shapes are 1 at the roof, or at their maximum if the roof hardly moves)"
        }
    };
    html! {
        (properties("", &facts))
        (table(title, &headings, rows))
    }
}

fn objects(study: &Study) -> Markup {
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
