//! Drop tests of a cushion, from files to a pooled law: request → report.

pub mod doubt;
mod pool;

use std::path::{Path, PathBuf};

use freestand::G0_M_S2;
use freestand::cushion::{ContactLaw, PAD_STIFFNESS_N_M};
use freestand::identify::{
    Candidate, DropOfRecord, DropSetup, DropTest, FittedLaw, Identified, ImpactVelocity, LoopPoint,
    NORMAL_975, StiffnessEstimates, drop_tests as drops_of,
};
use freestand::impact::HALF_SPACE_SHARE;

use self::doubt::{DropDoubt, DropsDoubt};
use super::virtual_laboratory::{DEFAULT_VELOCITY_ERROR_RATIO, check_speed};
use super::{Impactor, check_sensors};
use crate::recorded::Failed;
use freestand_input::problem::{Problem, ProblemKind, Problems};
use freestand_input::quantity::{Dimension, parse_positive};
use freestand_input::words::{self, Choices};
use freestand_output::answer_of;
use freestand_output::rows::table_of_numbers;
use freestand_output::table::Table;
use freestand_records::formats::{ReadOptions, parse_motions};
use freestand_records::tables::laboratory::{Comment, comments, load};

pub use pool::{PooledReport, cushion_toml};

/// A warning is given below this many samples per contact: 50, with a contact time that is accurate
/// to one or two per cent.
const GOOD_SAMPLES: f64 = 49.0;
/// A warning is given where the estimates of a linear pad differ by more than this.
const WIDE_SPREAD: f64 = 0.1;
/// A fitted exponent above this indicates a round impactor.
const ROUND_EXPONENT: f64 = 1.2;

/// Contact laws that can be fitted, by name.
pub const LAWS: Choices<FittedLaw> = &[
    (FittedLaw::Linear, "linear", "F = k d"),
    (FittedLaw::Power, "power", "F = K dⁿ"),
    (FittedLaw::KelvinVoigt, "kelvin-voigt", "F = k d + c ḋ"),
    (
        FittedLaw::HuntCrossley,
        "hunt-crossley",
        "F = K dⁿ (1 + Λḋ)",
    ),
    (FittedLaw::Cubic, "cubic", "F = k d + k₃ d³"),
    (
        FittedLaw::Tabulated,
        "tabulated",
        "a smooth curve without a formula",
    ),
];

/// A request to evaluate drop tests: values for all files; the comments of a file supply those that
/// are missing.
#[derive(Debug, Clone, Default)]
pub struct DropRequest {
    /// The files.
    pub files: Vec<PathBuf>,
    /// Mass \[kg\].
    pub mass_kg: Option<f64>,
    /// Drop height \[m\].
    pub height_m: Option<f64>,
    /// Speed at the first touch \[m/s\].
    pub impact_velocity_m_s: Option<f64>,
    /// Relative standard deviation of the impact velocity; `None`: the usual one.
    pub velocity_error_ratio: Option<f64>,
    /// Gravity during the contact \[m/s²\].
    pub gravity_m_s2: f64,
    /// Corner frequency of the low-pass filter of the instrument \[Hz\].
    pub filter_corner_hz: Option<f64>,
    /// Fit only this law.
    pub law: Option<FittedLaw>,
    /// How the files are read.
    pub read: ReadOptions,
    /// Which column, if a file has several.
    pub component: Option<String>,
    /// Whether the sign of the samples is reversed.
    pub inverted: bool,
    /// Thickness of the pad \[m\].
    pub thickness_m: Option<f64>,
    /// Flat or sphere; overrides the files.
    pub impactor: Option<String>,
    /// Radius of a sphere \[m\].
    pub sphere_radius_m: Option<f64>,
    /// Glued, unglued or lubricated; overrides the files.
    pub boundary: Option<String>,
    /// Seed of the bootstrap.
    pub seed: u64,
}

/// Where the impact velocity comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub(super) enum VelocitySource {
    Given,
    Height,
    Impulse,
}

/// One drop.
#[derive(Debug, Clone, PartialEq)]
pub struct DropReport {
    /// The file.
    pub path: String,
    /// Which drop of its file, from 1.
    pub drop: usize,
    /// Time of its pulse from the first sample of the file \[s\].
    start_time_s: Option<f64>,
    /// Mass that landed \[kg\].
    pub mass_kg: f64,
    velocity_source: VelocitySource,
    pub(super) impactor: Option<String>,
    pub(super) sphere_radius_m: Option<f64>,
    pub(super) boundary: Option<String>,
    /// Gravity that acts during the contact \[m/s²\].
    pub gravity_m_s2: f64,
    /// The evaluation of its pulse.
    pub test: DropTest,
}

/// All drops.
#[derive(Debug, Clone, PartialEq)]
pub struct DropsReport {
    /// One for each file that could be read.
    pub tests: Vec<DropReport>,
    /// All of them as one pad.
    pub pooled: PooledReport,
    /// Files that could not be read.
    pub failed: Vec<Failed>,
    /// What is doubtful in the files, in their order.
    pub doubts: Vec<DropsDoubt>,
}

impl DropsReport {
    /// Whether every file gave a stiffness, and all of them together one.
    pub fn all_gave(&self) -> bool {
        self.failed.is_empty()
            && self.pooled.differences.is_empty()
            && self.tests.iter().all(|test| test.test.identified.is_some())
    }
}

/// Reads and evaluates every file; one that cannot be read does not stop the others.
///
/// # Errors
/// No file could be read, or a flat impactor has a radius.
pub fn drop_tests(request: &DropRequest) -> Result<DropsReport, Problems> {
    if request.sphere_radius_m.is_some()
        && Impactor::of(request.impactor.as_deref()) == Impactor::Flat
    {
        let hint = "leave out `sphere_radius` or `impactor`";
        return Err(value("`sphere_radius` is given for a flat impactor")
            .hint(hint)
            .of(&["sphere_radius"])
            .into());
    }
    check_sensors(
        request.read.sensitivity.as_slice(),
        &[Dimension::Acceleration],
        "10 mV/g",
    )?;
    let (mut tests, mut failed, mut doubts) = (Vec::new(), Vec::new(), Vec::new());
    for path in &request.files {
        match one(path, request, &mut doubts) {
            Ok(drops) => tests.extend(drops),
            Err(problem) => failed.push(Failed::new(path, problem)),
        }
    }
    if tests.is_empty() {
        return Err(failed.into_iter().map(|one| one.problem).collect());
    }
    let pooled = pool::pooled(&tests, request.seed);
    Ok(DropsReport {
        tests,
        pooled,
        failed,
        doubts,
    })
}

/// Steps are the same up to the rounding of the times that a file states.
const SAME_STEP: f64 = 1e-6;

/// The drops of a file.
fn one(
    path: &Path,
    request: &DropRequest,
    doubts: &mut Vec<DropsDoubt>,
) -> Result<Vec<DropReport>, Problem> {
    let in_file = |problem: Problem| problem.in_file(path);
    let bytes = load(path)?;
    let said = Said::of(&bytes).map_err(in_file)?;
    let name = path.to_string_lossy().into_owned();
    let mut doubt = |doubt| {
        doubts.push(DropsDoubt {
            path: name.clone(),
            drop: None,
            doubt,
        });
    };
    said.replaced_by(request).for_each(&mut doubt);
    let read = ReadOptions {
        is_shock: true,
        ..request.read.clone()
    };
    let file = parse_motions(bytes, path, &read).map_err(|error| {
        error
            .problems
            .into_iter()
            .next()
            .unwrap_or_else(|| value("the file cannot be read"))
    })?;
    file.notes
        .iter()
        .cloned()
        .map(DropDoubt::Record)
        .for_each(&mut doubt);
    let component = file.select(request.component.as_deref()).map_err(in_file)?;
    let dt_s = component.motion.dt_s();
    if request
        .read
        .uneven_dt_s
        .is_some_and(|asked_s| (asked_s / dt_s - 1.0).abs() > SAME_STEP)
    {
        doubt(DropDoubt::EvenlySpaced(dt_s));
    }
    let Some(mass_kg) = request.mass_kg.or(said.mass_kg) else {
        return Err(in_file(
            value("the mass is not given")
                .hint("give `mass`, or a line \"# mass: 0.365 kg\" in the file"),
        ));
    };
    let (impact_velocity, velocity_source) = impact_velocity(request, &said).map_err(in_file)?;
    match impact_velocity {
        ImpactVelocity::Known { speed_m_s, .. } => check_speed(speed_m_s).map_err(in_file)?,
        ImpactVelocity::FromImpulse if request.velocity_error_ratio.is_some() => {
            doubt(DropDoubt::VelocityErrorUnused);
        }
        ImpactVelocity::FromImpulse => {}
    }
    let setup = DropSetup {
        mass_kg,
        impact_velocity,
        gravity_m_s2: request.gravity_m_s2,
        filter_corner_hz: request.filter_corner_hz.or(said.corner_hz),
        law: request.law,
    };
    let sign = if request.inverted { -1.0 } else { 1.0 };
    let samples: Vec<f64> = component
        .motion
        .accel_m_s2()
        .iter()
        .map(|a| sign * a)
        .collect();
    let found = drops_of(&samples, component.motion.dt_s(), &setup)
        .map_err(|error| in_file(value(error.to_string())))?;
    if found.len() > 1 {
        doubt(DropDoubt::Several(found.len()));
    }
    // Only a sphere has a radius.
    let sphere = request.sphere_radius_m.map(|_| "sphere".to_owned());
    let impactor = request.impactor.clone().or(sphere).or(said.impactor);
    let boundary = request.boundary.clone().or(said.boundary);
    let report = |(index, DropOfRecord { start_time_s, test }): (usize, DropOfRecord)| {
        let has_gravity = test
            .identified
            .as_ref()
            .is_none_or(|found| found.has_gravity);
        DropReport {
            path: name.clone(),
            drop: index + 1,
            start_time_s,
            mass_kg,
            velocity_source,
            impactor: impactor.clone(),
            sphere_radius_m: request.sphere_radius_m.or(said.sphere_radius_m),
            boundary: boundary.clone(),
            gravity_m_s2: if has_gravity {
                request.gravity_m_s2
            } else {
                0.0
            },
            test,
        }
    };
    let is_one_of_several = found.len() > 1;
    let reports: Vec<DropReport> = found.into_iter().enumerate().map(report).collect();
    for report in &reports {
        let drop = is_one_of_several.then_some(report.drop);
        let of_drop = doubts_of(report, request.thickness_m.or(said.thickness_m));
        doubts.extend(of_drop.into_iter().map(|doubt| DropsDoubt {
            path: name.clone(),
            drop,
            doubt,
        }));
    }
    Ok(reports)
}

fn value(message: impl Into<String>) -> Problem {
    Problem::new(ProblemKind::Value, message)
}

/// Whether a velocity may be that after a fall: along rails it is some percent lower than after a free one.
fn is_after_fall(velocity_m_s: f64, height_m: f64) -> bool {
    const FRICTION: f64 = 0.1;
    /// Of a number with two or three digits.
    const ROUNDED: f64 = 0.01;
    (1.0 - FRICTION..=1.0 + ROUNDED).contains(&(velocity_m_s / fall(height_m)))
}

/// The velocity after a fall. Gravity may be off during the contact, but it acted during the fall before.
fn fall(height_m: f64) -> f64 {
    (2.0 * G0_M_S2 * height_m).sqrt()
}

fn impact_velocity(
    request: &DropRequest,
    said: &Said,
) -> Result<(ImpactVelocity, VelocitySource), Problem> {
    let known = |speed_m_s| ImpactVelocity::Known {
        speed_m_s,
        error_ratio: request
            .velocity_error_ratio
            .unwrap_or(DEFAULT_VELOCITY_ERROR_RATIO),
    };
    let (speed_m_s, height_m) = match (request.impact_velocity_m_s, request.height_m) {
        (None, None) => {
            said.check_velocity()?;
            // Where both agree, the height counts: it is measured with a ruler.
            (
                said.velocity_m_s.filter(|_| said.height_m.is_none()),
                said.height_m,
            )
        }
        given => given,
    };
    Ok(match (speed_m_s, height_m) {
        (Some(speed_m_s), _) => (known(speed_m_s), VelocitySource::Given),
        (None, Some(height_m)) => (known(fall(height_m)), VelocitySource::Height),
        (None, None) => (ImpactVelocity::FromImpulse, VelocitySource::Impulse),
    })
}

/// What the comments of a file say.
#[derive(Debug, Default)]
struct Said {
    mass_kg: Option<f64>,
    height_m: Option<f64>,
    velocity_m_s: Option<f64>,
    corner_hz: Option<f64>,
    thickness_m: Option<f64>,
    impactor: Option<String>,
    sphere_radius_m: Option<f64>,
    boundary: Option<String>,
}

impl Said {
    fn of(bytes: &[u8]) -> Result<Self, Problem> {
        let mut said = Self::default();
        for Comment { key, value, line } in comments(bytes) {
            let quantity = |dimension| {
                parse_positive(&value, dimension, &key)
                    .map(Some)
                    .map_err(|problem| problem.at_line(line))
            };
            match key.as_str() {
                "mass" => said.mass_kg = quantity(Dimension::Mass)?,
                "height" | "drop height" => said.height_m = quantity(Dimension::Length)?,
                "impact velocity" => said.velocity_m_s = quantity(Dimension::Velocity)?,
                "corner" | "filter corner" => said.corner_hz = quantity(Dimension::Frequency)?,
                "pad thickness" | "thickness" => said.thickness_m = quantity(Dimension::Length)?,
                "sphere radius" => said.sphere_radius_m = quantity(Dimension::Length)?,
                "impactor" => said.impactor = Some(value.clone()),
                "boundary" => said.boundary = Some(value.clone()),
                _ => {}
            }
        }
        Ok(said)
    }

    /// Refuses a height and a velocity of which only one can be right.
    fn check_velocity(&self) -> Result<(), Problem> {
        let Some((height_m, velocity_m_s)) = self.height_m.zip(self.velocity_m_s) else {
            return Ok(());
        };
        if is_after_fall(velocity_m_s, height_m) {
            return Ok(());
        }
        let [height, velocity, after] =
            [height_m, velocity_m_s, fall(height_m)].map(|one| words::number(one, 4));
        let message = format!(
            "the file says an impact velocity of {velocity} m/s, and a drop height of {height} m, which gives {after} m/s"
        );
        Err(value(message).hint("give the right one, as `height` or `impact_velocity`"))
    }

    /// What the file says otherwise than the request, which counts.
    fn replaced_by(&self, request: &DropRequest) -> impl Iterator<Item = DropDoubt> {
        let is_other = |(given, said): &(f64, f64)| (given / said - 1.0).abs() > ROUNDING;
        let number = |key, unit, given: Option<f64>, said: Option<f64>| {
            let (given, said) = given.zip(said).filter(is_other)?;
            Some(DropDoubt::OtherNumber {
                key,
                unit,
                said,
                given,
            })
        };
        let text = |key, given: &Option<String>, said: &Option<String>| {
            let (given, said) = given.clone().zip(said.clone())?;
            (given != said).then_some(DropDoubt::OtherWord { key, said, given })
        };
        let other_fall = |velocity: Option<f64>, height: Option<f64>| {
            velocity
                .zip(height)
                .is_some_and(|(velocity_m_s, height_m)| !is_after_fall(velocity_m_s, height_m))
        };
        let all = [
            other_fall(request.impact_velocity_m_s, self.height_m)
                .then_some(DropDoubt::OtherHeight),
            other_fall(self.velocity_m_s, request.height_m).then_some(DropDoubt::OtherVelocity),
            number("mass", "kg", request.mass_kg, self.mass_kg),
            number("height", "m", request.height_m, self.height_m),
            number(
                "impact_velocity",
                "m/s",
                request.impact_velocity_m_s,
                self.velocity_m_s,
            ),
            number("corner", "Hz", request.filter_corner_hz, self.corner_hz),
            number("thickness", "m", request.thickness_m, self.thickness_m),
            number(
                "sphere_radius",
                "m",
                request.sphere_radius_m,
                self.sphere_radius_m,
            ),
            text("impactor", &request.impactor, &self.impactor),
            text("boundary", &request.boundary, &self.boundary),
        ];
        all.into_iter().flatten()
    }
}

/// Two numbers are the same that differ by less: 4 in is 101.6 mm.
const ROUNDING: f64 = 1e-9;

impl DropReport {
    /// The law and its numbers; `None` where a flag forbids a stiffness.
    pub(super) fn found(&self) -> Option<&Identified> {
        self.test.identified.as_ref()
    }

    /// A number of the law.
    fn of<T>(&self, value: impl Fn(&Identified) -> T) -> Option<T> {
        self.found().map(value)
    }
}

answer_of!(DropReport as one {
    path: String => "file";
    /// Its number in its file.
    drop: usize;
    /// Of its pulse, from the first sample of the file.
    start_time_s: Option<f64>;
    mass_kg: f64;
    impact_velocity_m_s: Option<f64> = one.test.impact_velocity_m_s => "impact velocity";
    /// given, height or impulse.
    impact_velocity_source: &'static str = one.velocity_source.into() => "  source";
    fitted_velocity_m_s: Option<f64> = one.of(|found| found.fitted_velocity_m_s);
    peak_acceleration_g: Option<f64> =
        one.test.peak_acceleration_m_s2.map(|a| a / G0_M_S2) => "peak acceleration";
    contact_time_s: Option<f64> = one.test.contact_time_s => "contact time";
    max_compression_m: Option<f64> = one.test.max_compression_m => "largest compression";
    restitution_ratio: Option<f64> = one.test.restitution_ratio => "restitution";
    restitution_bounce_ratio: Option<f64> =
        one.test.restitution_bounce_ratio => "restitution, from the bounce";
    energy_lost_ratio: Option<f64> = one.test.energy_lost_ratio;
    stiffness_n_m: Estimates = Estimates(one.of(|found| found.stiffness));
    stiffness_ci95_n_m: Option<[f64; 2]> = one.of(|found| {
        [-NORMAL_975, NORMAL_975].map(|side| found.stiffness.fit_n_m * (side * found.error_ratio).exp())
    }) => "  95 % interval of the fit";
    law: Option<&'static str> = one.of(|found| found.chosen.name()) => "law";
    initial_stiffness_n_m: Option<f64> =
        one.of(|found| found.initial_stiffness_n_m).flatten() => "tangent at the origin";
    cubic_n_m3: Option<f64> = one.of(|found| found.cubic_n_m3).flatten();
    filter_corner_hz: Option<f64> = one.of(|found| found.filter_corner_hz).flatten();
    coefficient_n_mn: Option<f64> = numbers(one.found()).0;
    exponent: Option<f64> = one.of(|found| found.exponent) => "exponent, fitted";
    exponent_error: Option<f64> = one.of(|found| found.exponent_error).flatten();
    exponent_by_identity: Option<f64> =
        one.of(|found| found.exponent_by_identity) => "exponent, 2ad/v² − 1";
    damping_ratio: Option<f64> = one.of(|found| found.damping_ratio) => "damping ratio";
    damping_n_s_m: Option<f64> = numbers(one.found()).1;
    dissipation_s_m: Option<f64> = numbers(one.found()).2;
    gravity_in_contact: Option<bool> = one.of(|found| found.has_gravity);
    /// The laws that were fitted.
    candidates: Vec<Fitted<'_>> =
        one.found().map_or(&[][..], |found| &found.candidates).iter().map(Fitted).collect();
    quality: OfQuality<'_> = OfQuality(one);
    impactor: Option<String>;
    sphere_radius_m: Option<f64>;
    boundary: Option<String>;
});

/// The estimates; without a stiffness, all are missing.
#[derive(Clone, Copy)]
struct Estimates(Option<StiffnessEstimates>);

answer_of!(Estimates as k {
    fit: Option<f64> = k.0.map(|k| k.fit_n_m) => "stiffness F/d, fitted";
    integrated: Option<f64> = k.0.and_then(|k| k.integrated_n_m) => "  F/d, integrated";
    peak_over_velocity: Option<f64> = k.0.map(|k| k.peak_over_velocity_n_m) => "  m (a/v)²";
    contact_time: Option<f64> = k.0.map(|k| k.contact_time_n_m) => "  m (π/tc)²";
    velocity_over_compression: Option<f64> = k.0.map(|k| k.velocity_over_compression_n_m) => "  m (v/d)²";
    acceleration_over_compression: Option<f64> =
        k.0.map(|k| k.acceleration_over_compression_n_m) => "  m a/d";
    energy: Option<f64> = k.0.map(|k| k.energy_n_m) => "  2E/d²";
});

answer_of!(
    /// A law that was fitted.
    struct Fitted<'r>(&'r Candidate) as fitted.0 {
    law: &'static str = fitted.0.law.name();
    stiffness_n_m: f64 = fitted.0.secant_n_m;
    exponent: f64;
    damping_ratio: f64;
    residual_ratio: f64;
    chi_squared: f64;
});

answer_of!(
    /// How far a drop can be trusted.
    struct OfQuality<'r>(&'r DropReport) as of {
    samples_per_contact: Option<f64> = of.0.test.samples_per_contact => "samples per contact";
    zero_shift_ratio: Option<f64> = of.0.test.zero_shift_ratio => "zero shift over peak";
    noise_ratio: Option<f64> = of.0.test.noise_ratio => "noise over peak";
    residual_ratio: Option<f64> = of.0.of(|found| found.residual_ratio) => "residual of the fit over peak";
    spread_ratio: Option<f64> =
        of.0.of(|found| found.stiffness.spread_ratio()) => "spread of the estimates";
    flags: Vec<&'static str> = of.0.test.flags.iter().map(|flag| flag.name()).collect() => "flag";
});

/// K, c and Λ of the law.
pub(super) fn numbers(found: Option<&Identified>) -> (Option<f64>, Option<f64>, Option<f64>) {
    match found.map(|found| &found.law) {
        // k of k d + k₃ d³.
        Some(ContactLaw::Tabulated { .. }) => (
            found
                .filter(|f| f.chosen == FittedLaw::Cubic)
                .and_then(|f| f.initial_stiffness_n_m),
            None,
            None,
        ),
        Some(ContactLaw::Linear { stiffness_n_m }) => (Some(*stiffness_n_m), None, None),
        Some(ContactLaw::Power {
            coefficient_n_mn, ..
        }) => (Some(*coefficient_n_mn), None, None),
        Some(ContactLaw::KelvinVoigt {
            stiffness_n_m,
            damping_n_s_m,
        }) => (Some(*stiffness_n_m), Some(*damping_n_s_m), None),
        Some(ContactLaw::HuntCrossley {
            coefficient_n_mn,
            dissipation_s_m,
            ..
        }) => (Some(*coefficient_n_mn), None, Some(*dissipation_s_m)),
        _ => (None, None, None),
    }
}

/// What is doubtful about a drop: its flags, and what else.
fn doubts_of(report: &DropReport, thickness_m: Option<f64>) -> Vec<DropDoubt> {
    let (test, found) = (&report.test, report.found());
    let mut doubts: Vec<DropDoubt> = test.flags.iter().copied().map(DropDoubt::Flag).collect();
    let few = test
        .samples_per_contact
        .filter(|samples| *samples < GOOD_SAMPLES && found.is_some());
    doubts.extend(few.map(DropDoubt::FewSamples));
    if found.is_some_and(|found| found.stiffness.fit_n_m > *PAD_STIFFNESS_N_M.end()) {
        doubts.push(DropDoubt::TooStiff);
    }
    let spread_ratio = found.map_or(0.0, |found| found.stiffness.spread_ratio());
    if found.is_some_and(|found| found.chosen == FittedLaw::Linear) && spread_ratio > WIDE_SPREAD {
        doubts.push(DropDoubt::WideSpread(spread_ratio));
    }
    let corner_hz = found.and_then(|found| found.filter_corner_hz);
    doubts.extend(corner_hz.map(DropDoubt::Filtered));
    if found.is_some_and(|found| matches!(found.chosen, FittedLaw::Cubic | FittedLaw::Tabulated)) {
        let compression_m = test.max_compression_m.unwrap_or(0.0);
        doubts.push(DropDoubt::Curved(compression_m));
    }
    if found.is_some_and(|found| !found.has_gravity)
        && report.velocity_source != VelocitySource::Impulse
    {
        doubts.push(DropDoubt::NoGravity);
    }
    // Hertz's half space applies to round impactors only.
    if Impactor::of(report.impactor.as_deref()) == Impactor::Sphere
        || found.is_some_and(|found| found.exponent > ROUND_EXPONENT)
    {
        let is_deep = |length_m: Option<f64>| {
            let lengths = test.max_compression_m.zip(length_m);
            lengths.is_some_and(|(d, length_m)| d > HALF_SPACE_SHARE * length_m)
        };
        doubts.extend(is_deep(thickness_m).then_some(DropDoubt::Thin));
        doubts.extend(is_deep(report.sphere_radius_m).then_some(DropDoubt::SmallSphere));
    }
    doubts
}

/// The loop of a test as CSV.
pub fn loop_table(test: &DropTest) -> Table {
    let row = |p: &LoopPoint| {
        [
            p.time_s,
            p.acceleration_m_s2 / G0_M_S2,
            p.force_n,
            p.compression_m,
            p.speed_m_s,
        ]
    };
    table_of_numbers(
        "time_s,acceleration_g,force_n,compression_m,speed_m_s",
        test.points.iter().map(row),
    )
}
