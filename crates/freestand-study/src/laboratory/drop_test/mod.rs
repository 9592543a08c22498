//! Drop tests of a cushion, from files to a pooled law: request → report.

mod pool;

use std::path::{Path, PathBuf};

use freestand::G0_M_S2;
use freestand::cushion::ContactLaw;
use freestand::identify::{DropSetup, DropTest, FittedLaw, Flag, Identified, ImpactVelocity, NORMAL_975, drop_test};
use freestand::impact::HALF_SPACE_SHARE;
use serde::{Serialize, Serializer};

use freestand_input::file::load;
use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::quantity::{Dimension, parse_positive};
use freestand_input::words::push_shortest;
use freestand_input::words::significant;
use freestand_records::formats::{ReadOptions, parse_motions};
use freestand_records::tables::laboratory::comments;

pub use pool::{PooledReport, cushion_toml};

/// Warned below this many samples per contact: 50, of a contact time that is good to a hundredth or two.
const GOOD_SAMPLES: f64 = 49.0;
/// A spread of the four estimates beyond this is worth a word where the pad is linear.
const WIDE_SPREAD: f64 = 0.1;
/// A fitted exponent above this is that of a round impactor.
const ROUND_EXPONENT: f64 = 1.2;

/// What is known of all files; a file's own comments fill what is missing.
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
    /// Relative standard deviation of the impact velocity.
    pub velocity_error_ratio: f64,
    /// Gravity in the contact \[m/s²\].
    pub gravity_m_s2: f64,
    /// Low-pass corner \[Hz\].
    pub filter_corner_hz: Option<f64>,
    /// This law alone.
    pub law: Option<FittedLaw>,
    /// How the files are read.
    pub read: ReadOptions,
    /// Which column of several.
    pub component: Option<String>,
    /// Turns the sign.
    pub inverted: bool,
    /// Thickness of the pad \[m\].
    pub thickness_m: Option<f64>,
    /// Flat or sphere, over what the files say.
    pub impactor: Option<String>,
    /// Radius of a sphere \[m\].
    pub sphere_radius_m: Option<f64>,
    /// Glued, unglued, lubricated, over what the files say.
    pub boundary: Option<String>,
    /// Seed of the bootstrap.
    pub seed: u64,
}

/// Stiffness by six ways \[N/m\].
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[expect(missing_docs, reason = "the names are the documentation: SI units as they say")]
pub struct StiffnessReport {
    pub fit: f64,
    pub peak_over_velocity: f64,
    pub contact_time: f64,
    pub velocity_over_compression: f64,
    pub acceleration_over_compression: f64,
    pub energy: f64,
}

/// A stiffness that is missing has its keys all the same, each of them `null`.
fn with_all_keys<S: Serializer>(stiffness: &Option<StiffnessReport>, serializer: S) -> Result<S::Ok, S::Error> {
    const KEYS: [&str; 6] = [
        "fit",
        "peak_over_velocity",
        "contact_time",
        "velocity_over_compression",
        "acceleration_over_compression",
        "energy",
    ];
    match stiffness {
        Some(stiffness) => stiffness.serialize(serializer),
        None => serializer.collect_map(KEYS.map(|key| (key, None::<f64>))),
    }
}

/// How good a record is.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[expect(missing_docs, reason = "the names are the documentation: SI units as they say")]
pub struct Quality {
    pub samples_per_contact: Option<f64>,
    pub zero_shift_ratio: Option<f64>,
    pub noise_ratio: Option<f64>,
    pub residual_ratio: Option<f64>,
    pub spread_ratio: Option<f64>,
    pub flags: Vec<&'static str>,
}

/// One law that was tried.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[expect(missing_docs, reason = "the names are the documentation: SI units as they say")]
pub struct CandidateReport {
    pub law: &'static str,
    pub stiffness_n_m: f64,
    pub exponent: f64,
    pub damping_ratio: f64,
    pub residual_ratio: f64,
    pub chi_squared: f64,
}

/// One drop: the keys of `tests` in `freestand cushion drop --json`.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[expect(missing_docs, reason = "the names are the documentation: SI units as they say")]
pub struct DropReport {
    pub path: String,
    pub mass_kg: f64,
    pub impact_velocity_m_s: Option<f64>,
    pub impact_velocity_source: &'static str,
    pub fitted_velocity_m_s: Option<f64>,
    pub peak_acceleration_g: Option<f64>,
    pub contact_time_s: Option<f64>,
    pub max_compression_m: Option<f64>,
    pub restitution_ratio: Option<f64>,
    pub restitution_bounce_ratio: Option<f64>,
    pub energy_lost_ratio: Option<f64>,
    /// `None` where a flag forbids a stiffness.
    #[serde(serialize_with = "with_all_keys")]
    pub stiffness_n_m: Option<StiffnessReport>,
    pub stiffness_ci95_n_m: Option<[f64; 2]>,
    pub law: Option<&'static str>,
    pub coefficient_n_mn: Option<f64>,
    pub exponent: Option<f64>,
    pub exponent_error: Option<f64>,
    pub exponent_by_identity: Option<f64>,
    pub damping_ratio: Option<f64>,
    pub damping_n_s_m: Option<f64>,
    pub dissipation_s_m: Option<f64>,
    pub gravity_in_contact: Option<bool>,
    pub candidates: Vec<CandidateReport>,
    pub quality: Quality,
    pub impactor: Option<String>,
    pub sphere_radius_m: Option<f64>,
    pub boundary: Option<String>,
    /// Why there is no stiffness.
    pub reason: Option<String>,
    /// What acts in the contact.
    #[serde(skip)]
    pub gravity_m_s2: f64,
    #[serde(skip)]
    pub test: Option<DropTest>,
}

/// A file that could not be read.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[expect(missing_docs, reason = "the names are the documentation")]
pub struct FailedDrop {
    pub path: String,
    pub reason: String,
    #[serde(skip)]
    pub problem: Problem,
}

/// The keys of `freestand cushion drop --json`.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[expect(missing_docs, reason = "the names are the documentation")]
pub struct DropsReport {
    pub tests: Vec<DropReport>,
    pub pooled: PooledReport,
    pub failed: Vec<FailedDrop>,
    #[serde(skip)]
    pub warnings: Vec<String>,
}

impl DropsReport {
    /// Whether every file gave a stiffness, and all of them one.
    pub fn all_gave(&self) -> bool {
        self.failed.is_empty()
            && self.pooled.reason.is_none()
            && self.tests.iter().all(|test| test.stiffness_n_m.is_some())
    }
}

/// Reads and evaluates every file; one that cannot be read hides no other.
///
/// # Errors
/// No file could be read.
pub fn drop_tests(request: &DropRequest) -> Result<DropsReport, Vec<Problem>> {
    let (mut tests, mut failed, mut warnings) = (Vec::new(), Vec::new(), Vec::new());
    for path in &request.files {
        match one(path, request, &mut warnings) {
            Ok(test) => tests.push(test),
            Err(problem) => failed.push(FailedDrop {
                path: path.to_string_lossy().into_owned(),
                reason: problem.message.clone(),
                problem,
            }),
        }
    }
    if tests.is_empty() {
        return Err(failed.into_iter().map(|one| one.problem).collect());
    }
    let pooled = pool::pooled(&tests, request.seed, &mut warnings);
    Ok(DropsReport { tests, pooled, failed, warnings })
}

fn one(path: &Path, request: &DropRequest, warnings: &mut Vec<String>) -> Result<DropReport, Problem> {
    let in_file = |problem: Problem| problem.in_file(path);
    let bytes = load(path)?;
    let said = Said::of(&bytes).map_err(in_file)?;
    let read = ReadOptions { is_shock: true, ..request.read.clone() };
    let file = parse_motions(bytes, path, &read)
        .map_err(|error| error.problems.into_iter().next().unwrap_or_else(|| value("the file cannot be read")))?;
    let name = path.to_string_lossy().into_owned();
    warnings.extend(file.notes.iter().map(|note| format!("{name}: {note}")));
    let component = file.select(request.component.as_deref()).map_err(in_file)?;
    let Some(mass_kg) = request.mass_kg.or(said.mass_kg) else {
        return Err(in_file(value("the mass is not known").hint("give --mass, or a line \"# mass: 0.365 kg\"")));
    };
    let height_m = request.height_m.or(if request.impact_velocity_m_s.is_some() { None } else { said.height_m });
    let (impact_velocity, source) = impact_velocity(request, height_m, said.velocity_m_s);
    let setup = DropSetup {
        mass_kg,
        impact_velocity,
        gravity_m_s2: request.gravity_m_s2,
        filter_corner_hz: request.filter_corner_hz.or(said.corner_hz),
        law: request.law,
    };
    let sign = if request.inverted { -1.0 } else { 1.0 };
    let samples: Vec<f64> = component.motion.accel_m_s2().iter().map(|a| sign * a).collect();
    let test =
        drop_test(&samples, component.motion.dt_s(), &setup).map_err(|error| in_file(value(error.to_string())))?;
    let mut report = report(name, mass_kg, source, &said, test);
    report.impactor = request.impactor.clone().or(report.impactor);
    report.sphere_radius_m = request.sphere_radius_m.or(report.sphere_radius_m);
    report.boundary = request.boundary.clone().or(report.boundary);
    report.gravity_m_s2 = if report.gravity_in_contact == Some(false) { 0.0 } else { request.gravity_m_s2 };
    notes(&report, request.thickness_m.or(said.thickness_m), warnings);
    Ok(report)
}

fn value(message: impl Into<String>) -> Problem {
    Problem::new(ProblemKind::Value, message)
}

fn impact_velocity(
    request: &DropRequest,
    height_m: Option<f64>,
    said_m_s: Option<f64>,
) -> (ImpactVelocity, &'static str) {
    let error_ratio = request.velocity_error_ratio;
    let known = |speed_m_s| ImpactVelocity::Known { speed_m_s, error_ratio };
    // Gravity may be switched off in the contact; the fall before it had it.
    let fall = |height_m: f64| (2.0 * G0_M_S2 * height_m).sqrt();
    match (request.impact_velocity_m_s, height_m, said_m_s) {
        (Some(speed), ..) => (known(speed), "given"),
        (None, Some(height_m), _) => (known(fall(height_m)), "height"),
        (None, None, Some(speed)) => (known(speed), "given"),
        (None, None, None) => (ImpactVelocity::FromImpulse, "impulse"),
    }
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
        for (key, text, line) in comments(bytes) {
            let quantity =
                |dimension| parse_positive(&text, dimension, &key).map(Some).map_err(|problem| problem.at_line(line));
            match key.as_str() {
                "mass" => said.mass_kg = quantity(Dimension::Mass)?,
                "height" | "drop height" => said.height_m = quantity(Dimension::Length)?,
                "impact velocity" => said.velocity_m_s = quantity(Dimension::Velocity)?,
                "corner" | "filter corner" => said.corner_hz = quantity(Dimension::Frequency)?,
                "pad thickness" | "thickness" => said.thickness_m = quantity(Dimension::Length)?,
                "sphere radius" => said.sphere_radius_m = quantity(Dimension::Length)?,
                "impactor" => said.impactor = Some(text.clone()),
                "boundary" => said.boundary = Some(text.clone()),
                _ => {}
            }
        }
        Ok(said)
    }
}

fn report(path: String, mass_kg: f64, source: &'static str, said: &Said, test: DropTest) -> DropReport {
    let found = test.identified.as_ref();
    let reason = found.is_none().then(|| {
        let said = test.flags.iter().map(|flag| flag.remedy()).collect::<Vec<_>>().join("; ");
        if said.is_empty() { "no law could be fitted".to_owned() } else { said }
    });
    let (coefficient_n_mn, damping_n_s_m, dissipation_s_m) = numbers(found);
    DropReport {
        path,
        mass_kg,
        impact_velocity_m_s: test.impact_velocity_m_s,
        impact_velocity_source: source,
        fitted_velocity_m_s: found.map(|f| f.fitted_velocity_m_s),
        peak_acceleration_g: test.peak_acceleration_m_s2.map(|a| a / G0_M_S2),
        contact_time_s: test.contact_time_s,
        max_compression_m: test.max_compression_m,
        restitution_ratio: test.restitution_ratio,
        restitution_bounce_ratio: test.restitution_bounce_ratio,
        energy_lost_ratio: test.energy_lost_ratio,
        stiffness_n_m: found.map(|f| StiffnessReport {
            fit: f.stiffness.fit_n_m,
            peak_over_velocity: f.stiffness.peak_over_velocity_n_m,
            contact_time: f.stiffness.contact_time_n_m,
            velocity_over_compression: f.stiffness.velocity_over_compression_n_m,
            acceleration_over_compression: f.stiffness.acceleration_over_compression_n_m,
            energy: f.stiffness.energy_n_m,
        }),
        stiffness_ci95_n_m: found
            .map(|f| [-NORMAL_975, NORMAL_975].map(|side| f.stiffness.fit_n_m * (side * f.error_ratio).exp())),
        law: found.map(|f| f.chosen.name()),
        coefficient_n_mn,
        exponent: found.map(|f| f.exponent),
        exponent_error: found.and_then(|f| f.exponent_error),
        exponent_by_identity: found.map(|f| f.exponent_by_identity),
        damping_ratio: found.map(|f| f.damping_ratio),
        damping_n_s_m,
        dissipation_s_m,
        gravity_in_contact: found.map(|f| f.has_gravity),
        candidates: found.map_or_else(Vec::new, |f| {
            let candidate = |c: &freestand::identify::Candidate| CandidateReport {
                law: c.law.name(),
                stiffness_n_m: c.secant_n_m,
                exponent: c.exponent,
                damping_ratio: c.damping_ratio,
                residual_ratio: c.residual_ratio,
                chi_squared: c.chi_squared,
            };
            f.candidates.iter().map(candidate).collect()
        }),
        quality: Quality {
            samples_per_contact: test.samples_per_contact,
            zero_shift_ratio: test.zero_shift_ratio,
            noise_ratio: test.noise_ratio,
            residual_ratio: found.map(|f| f.residual_ratio),
            spread_ratio: found.map(|f| f.stiffness.spread_ratio()),
            flags: test.flags.iter().map(|flag| flag.name()).collect(),
        },
        impactor: said.impactor.clone(),
        sphere_radius_m: said.sphere_radius_m,
        boundary: said.boundary.clone(),
        reason,
        gravity_m_s2: 0.0,
        test: Some(test),
    }
}

/// K, c and Λ of the law.
fn numbers(found: Option<&Identified>) -> (Option<f64>, Option<f64>, Option<f64>) {
    match found.map(|found| &found.law) {
        Some(ContactLaw::Linear { stiffness_n_m }) => (Some(*stiffness_n_m), None, None),
        Some(ContactLaw::Power { coefficient_n_mn, .. }) => (Some(*coefficient_n_mn), None, None),
        Some(ContactLaw::KelvinVoigt { stiffness_n_m, damping_n_s_m }) => {
            (Some(*stiffness_n_m), Some(*damping_n_s_m), None)
        }
        Some(ContactLaw::HuntCrossley { coefficient_n_mn, dissipation_s_m, .. }) => {
            (Some(*coefficient_n_mn), None, Some(*dissipation_s_m))
        }
        _ => (None, None, None),
    }
}

/// What is worth a word, beside the flags.
fn notes(report: &DropReport, thickness_m: Option<f64>, warnings: &mut Vec<String>) {
    let mut say = |text: String| warnings.push(format!("{}: {text}", report.path));
    for flag in report.test.iter().flat_map(|test: &DropTest| &test.flags) {
        let flag: &Flag = flag;
        say(format!("{}: {}", flag.name(), flag.remedy()));
    }
    if let Some(samples) = report.quality.samples_per_contact
        && samples < GOOD_SAMPLES
        && report.stiffness_n_m.is_some()
    {
        say(format!("{} samples per contact: 50 or more are better", significant(samples, 3)));
    }
    if let (Some(spread), Some("linear")) = (report.quality.spread_ratio, report.law)
        && spread > WIDE_SPREAD
    {
        say(format!(
            "the four estimates are {} % apart, although the pulse is that of a linear pad: check mass, height and zero line",
            significant(100.0 * spread, 2)
        ));
    }
    if report.gravity_in_contact == Some(false) && report.impact_velocity_source != "impulse" {
        say("the pulse is that of a contact without weight: the zero line is not that of a free fall".to_owned());
    }
    // A flat plate never met a half space.
    let is_sphere = report.impactor.as_deref().is_some_and(|text| text.to_lowercase().starts_with("sphere"));
    if !is_sphere && report.exponent.is_none_or(|exponent| exponent <= ROUND_EXPONENT) {
        return;
    }
    let lengths = [("its thickness", thickness_m), ("the sphere's radius", report.sphere_radius_m)];
    for (name, length_m) in lengths {
        if let (Some(d), Some(length_m)) = (report.max_compression_m, length_m)
            && d > HALF_SPACE_SHARE * length_m
        {
            say(format!("compressed by more than a quarter of {name}: Hertz's half space (n = 1.5) is no model of it"));
        }
    }
}

/// The loop of a test as CSV.
pub fn loop_csv(test: &DropTest) -> String {
    let mut text = String::from("time_s,acceleration_g,force_n,compression_m,speed_m_s\n");
    for p in &test.points {
        let row = [p.time_s, p.acceleration_m_s2 / G0_M_S2, p.force_n, p.compression_m, p.speed_m_s];
        for (i, value) in row.into_iter().enumerate() {
            if i > 0 {
                text.push(',');
            }
            push_shortest(&mut text, value);
        }
        text.push('\n');
    }
    text
}
