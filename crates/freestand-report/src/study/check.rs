//! A study as it was understood, without running it.

use freestand::G0_M_S2;
use freestand_input::quantity::{Dimension, format_si};
use freestand_input::words::{counted, significant, some};
use freestand_output::answer_of;
use freestand_study::building::{damping_words, model_words};
use freestand_study::cushion::cushion_words;
use freestand_study::simulated::FoundEarthquake;
use freestand_study::study::{
    BuildingInput, Ground, Level, Objects, RecordedMotion, SimulatedGround, Study,
};
use freestand_study::suite::{NAMED, Suite};

use crate::doubts::{cushion_notes, dispersion, mean_off, period_from};
use crate::ground::{count_words, period_words, vertical_motion};

/// What a study means: its motions, building, levels and objects.
#[derive(Debug, Clone, Copy)]
pub struct Check<'s>(pub &'s Study);

impl<'s> Check<'s> {
    fn path(&self) -> Option<String> {
        let path = self.0.source.as_ref();
        path.map(|path| path.display().to_string())
    }

    fn recorded(&self) -> Vec<&'s RecordedMotion> {
        self.0.ground.recorded(&self.0.levels).collect()
    }
}

answer_of!(Check<'_> as check.0 {
    /// The file; `null` for the built-in study.
    path: Option<String> = check.path();
    __: String = format!("{}: valid", check.path().as_deref().unwrap_or("built-in")) => "study";
    ground: String = ground_words(&check.0.ground, check.recorded().len()) => "ground";
    vertical: String = vertical_motion(&check.0.ground)
        => (if check.0.ground.has_vertical() { "vertical" } else { "" });
    /// Those that were read from files.
    motions: Vec<OfMotion<'_>> = check.recorded().into_iter().map(OfMotion).collect();
    selected: Option<OfSuite<'_>> = check.0.ground.suite().map(OfSuite) => flat;
    // The motions are listed below `ground`, without a label of their own.
    __: Vec<String> = check.recorded().into_iter().map(motion_words).collect() => " ";
    directions_deg: Vec<f64>;
    building: Option<OfBuilding<'_>> = OfBuilding::of(check.0) => flat;
    __: Option<String> = directions_words(&check.0.directions_deg) => "directions";
    __: String = check.0.levels.iter().map(level_words).collect::<Vec<_>>().join(", ") => "levels";
    __: String = range(&check.0.objects.heights_m) => "heights";
    __: String = range(&check.0.objects.thicknesses_m) => "thicknesses";
    /// The code of the restraints.
    restraint_code: Option<String> = restraint_words(check.0) => "restraints by";
    __: String = objects_words(&check.0.objects) => "objects";
    levels: Vec<OfLevel<'_>> = check.0.levels.iter().map(OfLevel).collect();
    heights_m: Vec<f64> = check.0.objects.heights_m.clone();
    thicknesses_m: Vec<f64> = check.0.objects.thicknesses_m.clone();
    /// How many there are.
    objects: usize = check.0.objects.blocks.len();
    mass_kg: f64 = check.0.objects.mass_kg;
    stiffness_n_m: Option<f64> = check.0.objects.cushion.cushion.linear_stiffness_n_m();
    cushion: String = cushion_words(&check.0.objects.cushion.cushion);
    cushion_notes: Vec<String> = cushion_notes(&check.0.objects.cushion.notes) => "note";
    tolerance_g: Option<f64> = check.0.objects.tolerance_m_s2.map(|tolerance| tolerance / G0_M_S2);
});

answer_of!(
    /// A level.
    struct OfLevel<'s>(&'s Level) as level.0 {
    name: String;
    /// Its height as a share of the building's.
    level_ratio: Option<f64>;
});

fn level_words(level: &Level) -> String {
    let ratio = level.level_ratio;
    level.name.clone() + &ratio.map_or_else(String::new, |x| format!(" (level {x})"))
}

fn directions_words(directions_deg: &[f64]) -> Option<String> {
    let count = directions_deg.len();
    (count > 1).then(|| format!("{count} over half a circle, the worst counts"))
}

fn restraint_words(study: &Study) -> Option<String> {
    let code = study.assessment.restraint_code.as_ref()?;
    Some(format!("{}, {}", code.spectrum.name(), code.parts_words()))
}

fn objects_words(objects: &Objects) -> String {
    format!(
        "{} of {} on {} under one edge",
        objects.blocks.len(),
        format_si(objects.mass_kg, Dimension::Mass),
        cushion_words(&objects.cushion.cushion)
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

answer_of!(
    /// How the motions were selected.
    struct OfSuite<'s>(&'s Suite) as of {
    __: String = format!("{}, of {}", count_words(of.0), of.0.folder.display()) => "suite";
    __: String = period_words(of.0) => "periods";
    __: String = mean_off(of.0.mean_off()) => "mean ln Sa";
    __: String = dispersion(of.0.dispersion()) => "sd of ln Sa";
    __: Option<String> = files(of.0.left_out.iter().map(|one| one.file.clone()).collect()) => "left out";
    __: Option<String> = files(of.0.skipped.clone()) => "no records";
    suite: &Suite = of.0;
});

/// `7 files: a, b, c …`.
fn files(names: Vec<String>) -> Option<String> {
    (!names.is_empty())
        .then(|| format!("{}: {}", counted(names.len(), "file"), some(&names, NAMED)))
}

fn pga_g(one: &RecordedMotion) -> f64 {
    one.as_used().peak_m_s2() / G0_M_S2
}

fn rms_misfit_ratio(one: &RecordedMotion) -> Option<f64> {
    one.matched.as_ref().map(|matched| matched.misfit.rms_ratio)
}

answer_of!(
    /// A motion that was read from a file.
    struct OfMotion<'s>(&'s RecordedMotion) as one.0 {
    name: String;
    path: String = one.0.path.display().to_string();
    description: String;
    sha256: String;
    dt_s: f64 = one.0.motion.dt_s();
    npts: usize = one.0.motion.accel_m_s2().len();
    components: usize = if one.0.across.is_some() { 2 } else { 1 };
    pga_g: f64 = pga_g(one.0);
    /// From the spectrum that it is matched to.
    rms_misfit_ratio: Option<f64> = rms_misfit_ratio(one.0);
});

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

/// The building of a study.
#[derive(Clone, Copy)]
struct OfBuilding<'s> {
    name: Option<&'s str>,
    input: &'s BuildingInput,
}

impl<'s> OfBuilding<'s> {
    fn of(study: &'s Study) -> Option<Self> {
        let name = study.building_name.as_deref();
        study.building.as_ref().map(|input| Self { name, input })
    }

    fn size(&self) -> String {
        let called = self
            .name
            .map_or_else(String::new, |name| format!("{name}, "));
        let storeys = counted(self.input.storeys, "storey");
        let height = format_si(self.input.height_m, Dimension::Length);
        format!("{called}{storeys}, {height} high")
    }

    fn period(&self) -> String {
        let period_s = significant(self.input.along.period_s(), 4);
        format!("{period_s} s: {}", period_from(&self.input.period_from))
    }

    fn model(&self) -> String {
        let along = &self.input.along;
        let modes = counted(along.modes().len(), "mode");
        format!(
            "{}, damping {}, {modes}",
            model_words(along),
            damping_words(along)
        )
    }

    fn across(&self) -> Option<String> {
        let across = self.input.across.as_ref()?;
        Some(format!(
            "{}, period {} s, damping {}",
            model_words(across),
            significant(across.period_s(), 4),
            damping_words(across)
        ))
    }
}

answer_of!(OfBuilding<'_> as of {
    __: String = of.size() => "building";
    __: String = of.period() => "period";
    __: String = of.model() => "model";
    building_name: Option<String> = of.name.map(str::to_owned);
    storeys: usize = of.input.storeys;
    building_height_m: f64 = of.input.height_m;
    period_s: f64 = of.input.along.period_s();
    damping_ratio: Option<f64> = of.input.along.damping_ratio();
    shear_flexure_ratio: Option<f64> = of.input.along.shear_flexure_ratio();
    /// How many there are.
    modes: usize = of.input.along.modes().len();
    model: String = model_words(&of.input.along);
    /// The second axis.
    across: Option<String> = of.across() => "second axis";
});

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
