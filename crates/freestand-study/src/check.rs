//! A study as it was understood, without running it.

use freestand::G0_M_S2;
use freestand_input::quantity::{Dimension, format_si};
use freestand_input::words::{counted, significant, some};
use freestand_output::facts::Facts;

use crate::building::{damping_words, model_words};
use crate::cushion::cushion_words;
use crate::simulated::FoundEarthquake;
use crate::study::{BuildingInput, Ground, Level, RecordedMotion, SimulatedGround, Study};
use crate::suite::{NAMED, Suite};

/// What a study means: its motions, building, levels and objects.
pub fn check(study: &Study) -> Facts<'static> {
    let objects = &study.objects;
    let path = study.source.as_ref().map(|path| path.display().to_string());
    let valid = format!("{}: valid", path.as_deref().unwrap_or("built-in"));
    let recorded: Vec<&RecordedMotion> = study.ground.recorded(&study.levels).collect();
    let facts = Facts::default()
        .key("path", path)
        .line("study", Some(valid))
        .fact(
            "ground",
            "ground",
            ground_words(&study.ground, recorded.len()),
        )
        .key("vertical", study.ground.vertical_words())
        .line(
            "vertical",
            study
                .ground
                .has_vertical()
                .then(|| study.ground.vertical_words()),
        )
        .key(
            "motions",
            recorded
                .iter()
                .map(|one| motion_facts(one))
                .collect::<Vec<_>>(),
        );
    let facts = study
        .ground
        .suite()
        .iter()
        .fold(facts, |facts, suite| facts.and(suite_facts(suite)));
    // The motions are listed below `ground`, without a label of their own.
    let facts = recorded
        .iter()
        .fold(facts, |facts, one| facts.line(" ", Some(motion_words(one))));
    let facts = facts.key("directions_deg", study.directions_deg.as_slice());
    let facts = study.building.iter().fold(facts, |facts, building| {
        facts.and(building_facts(study.building_name.as_deref(), building))
    });
    let directions = study.directions_deg.len();
    let directions =
        (directions > 1).then(|| format!("{directions} over half a circle, the worst counts"));
    let level_words = |level: &Level| {
        level.name.clone()
            + &level
                .level_ratio
                .map_or_else(String::new, |x| format!(" (level {x})"))
    };
    let levels: Vec<String> = study.levels.iter().map(level_words).collect();
    let level_facts = |level: &Level| {
        Facts::default()
            .key("name", level.name.clone())
            .key("level_ratio", level.level_ratio)
    };
    let restraint = study.assessment.restraint_code.as_ref();
    let restraint =
        restraint.map(|code| format!("{}, {}", code.spectrum.name(), code.parts_words()));
    let cushion = cushion_words(&objects.cushion.cushion);
    let (count, mass) = (
        objects.blocks.len(),
        format_si(objects.mass_kg, Dimension::Mass),
    );
    facts
        .line("directions", directions)
        .line("levels", Some(levels.join(", ")))
        .line("heights", Some(range(&objects.heights_m)))
        .line("thicknesses", Some(range(&objects.thicknesses_m)))
        .fact("restraint_code", "restraints by", restraint)
        .line(
            "objects",
            Some(format!("{count} of {mass} on {cushion} under one edge")),
        )
        .key(
            "levels",
            study.levels.iter().map(level_facts).collect::<Vec<_>>(),
        )
        .key("heights_m", objects.heights_m.as_slice())
        .key("thicknesses_m", objects.thicknesses_m.as_slice())
        .key("objects", count)
        .key("mass_kg", objects.mass_kg)
        .key(
            "stiffness_n_m",
            objects.cushion.cushion.linear_stiffness_n_m(),
        )
        .key("cushion", cushion)
        .fact("cushion_notes", "note", objects.cushion.notes.as_slice())
        .key(
            "tolerance_g",
            objects.tolerance_m_s2.map(|tolerance| tolerance / G0_M_S2),
        )
}

/// Where the motions come from; `recorded` is the number of those that were read from files.
fn ground_words(ground: &Ground, recorded: usize) -> String {
    match ground {
        Ground::Synthetic(synthetic) => {
            let count = counted(synthetic.count, "synthetic motion");
            format!(
                "{count}, seed {}, {}",
                synthetic.seed,
                synthetic.target.one_line()
            )
        }
        Ground::Simulated(simulated) => simulated_words(simulated),
        Ground::Recorded(motions) => {
            let matched = motions.iter().find_map(|one| one.matched.as_ref());
            let words = matched.map_or_else(String::new, |matched| {
                format!(", matched to {}", matched.target.one_line())
            });
            let suite = ground.suite();
            let selected = suite.map_or_else(String::new, |suite| {
                format!(", a suite for {}", suite.target.one_line())
            });
            format!("{}{words}{selected}", counted(recorded, "recorded motion"))
        }
        Ground::OnFloors => format!("none; {} given", counted(recorded, "floor motion")),
    }
}

/// `10 simulated motions, seed 1, victoria, site Be, M 6 at 30 km`.
fn simulated_words(simulated: &SimulatedGround) -> String {
    let request = &simulated.request;
    let each = |found: &FoundEarthquake| {
        format!(
            "M {} at {} km",
            significant(found.source.magnitude, 2),
            significant(found.source.distance_m / 1e3, 3)
        )
    };
    let code = simulated
        .hazard
        .as_ref()
        .map_or_else(String::new, |code| format!(", for {}", code.one_line()));
    format!(
        "{}, seed {}, {}, site {}: {}{code}",
        counted(simulated.motions().count(), "simulated motion"),
        request.seed,
        request.preset.name(),
        request.site.name(),
        simulated
            .earthquakes
            .iter()
            .map(each)
            .collect::<Vec<_>>()
            .join(", ")
    )
}

fn suite_facts(suite: &Suite) -> Facts<'static> {
    let names: Vec<String> = suite.left_out.iter().map(|one| one.file.clone()).collect();
    let files = |names: &[String]| {
        (!names.is_empty())
            .then(|| format!("{}: {}", counted(names.len(), "file"), some(names, NAMED)))
    };
    Facts::default()
        .line(
            "suite",
            Some(format!(
                "{}, of {}",
                suite.count_words(),
                suite.folder.display()
            )),
        )
        .line("periods", Some(suite.period_words()))
        .line("mean ln Sa", Some(suite.mean_words()))
        .line("sd of ln Sa", Some(suite.sd_words()))
        .line("left out", files(&names))
        .line("no records", files(&suite.skipped))
        .key("suite", suite.facts())
}

fn pga_g(one: &RecordedMotion) -> f64 {
    one.as_used().peak_m_s2() / G0_M_S2
}

fn rms_misfit_ratio(one: &RecordedMotion) -> Option<f64> {
    one.matched.as_ref().map(|matched| matched.misfit.rms_ratio)
}

fn motion_facts(one: &RecordedMotion) -> Facts<'static> {
    Facts::default()
        .key("name", one.name.clone())
        .key("path", one.path.display().to_string())
        .key("description", one.description.clone())
        .key("sha256", one.sha256.clone())
        .key("dt_s", one.motion.dt_s())
        .key("npts", one.motion.accel_m_s2().len())
        .key("components", if one.across.is_some() { 2_usize } else { 1 })
        .key("pga_g", pga_g(one))
        .key("rms_misfit_ratio", rms_misfit_ratio(one))
}

fn motion_words(one: &RecordedMotion) -> String {
    let rms =
        rms_misfit_ratio(one).map(|rms| format!(", rms misfit {} %", significant(100.0 * rms, 2)));
    let pga = significant(pga_g(one), 4);
    let factor = one
        .suite
        .as_ref()
        .map(|_| format!(", times {}", significant(one.scale_ratio, 3)));
    let (rms, factor) = (rms.unwrap_or_default(), factor.unwrap_or_default());
    format!(
        "{}: {}{factor}, PGA {pga} g{rms}",
        one.name, one.description
    )
}

fn building_facts(name: Option<&str>, input: &BuildingInput) -> Facts<'static> {
    let BuildingInput {
        storeys,
        height_m,
        along,
        across,
        ..
    } = input;
    let (model, modes) = (model_words(along), along.modes().len());
    let across = across.as_ref().map(|across| {
        let period_s = significant(across.period_s(), 4);
        format!(
            "{}, period {period_s} s, damping {}",
            model_words(across),
            damping_words(across)
        )
    });
    let called = name.map_or_else(String::new, |name| format!("{name}, "));
    let height = format_si(*height_m, Dimension::Length);
    let size = format!("{called}{}, {height} high", counted(*storeys, "storey"));
    let damping = damping_words(along);
    Facts::default()
        .line("building", Some(size))
        .line(
            "period",
            Some(format!(
                "{} s: {}",
                significant(along.period_s(), 4),
                input.period_note
            )),
        )
        .line(
            "model",
            Some(format!(
                "{model}, damping {damping}, {}",
                counted(modes, "mode")
            )),
        )
        .key("building_name", name.map(str::to_owned))
        .key("storeys", *storeys)
        .key("building_height_m", *height_m)
        .key("period_s", along.period_s())
        .key("damping_ratio", along.damping_ratio())
        .key("shear_flexure_ratio", along.shear_flexure_ratio())
        .key("modes", modes)
        .key("model", model)
        .fact("across", "second axis", across)
}

/// `26 values from 500 mm to 3 m`.
fn range(lengths_m: &[f64]) -> String {
    let length = |value: f64| format_si(value, Dimension::Length);
    match lengths_m {
        [first, .., last] => format!(
            "{} values from {} to {}",
            lengths_m.len(),
            length(*first),
            length(*last)
        ),
        [only] => length(*only),
        [] => "-".to_owned(),
    }
}
