//! Motions of stochastic point sources: from a request to a report.

mod assumptions;
mod words;

use std::path::Path;

use freestand::G0_M_S2;
use freestand::code_spectrum::SiteClass;
use freestand::measures::measures;
use freestand::motion::Motion;
use freestand::synthesis::{
    Corners, GENERATOR, HighCut, PAIR_MAGNITUDES, PAIR_MOTIONS, PathDuration, PointSource, Preset, Quality,
    SimulationOptions, Simulator, SourceSpectrum, SynthesisError, distance_for_target, mean_ratio, stream,
};
use rayon::prelude::*;
use serde::Serialize;

use self::assumptions::{assumptions, outside_limits};
use crate::target::Target;
use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::{Dimension, format_si};
use freestand_input::words::number;
use freestand_output::rows::columns_csv;

pub use words::{SOURCE_KEYS, SourceInput, read_source};

/// Changes to a preset; `None` keeps its value.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SourceChanges {
    /// Stress drop \[Pa\].
    pub stress_drop_pa: Option<f64>,
    /// κ₀ \[s\], which replaces any other loss near the surface.
    pub kappa_s: Option<f64>,
    /// Shape of the source spectrum.
    pub spectrum: Option<SourceSpectrum>,
    /// Duration along the path.
    pub path_duration: Option<PathDuration>,
    /// The envelope of the motion.
    pub window: Option<freestand::synthesis::Window>,
    /// No amplification by the crust.
    pub hard_rock: bool,
}

/// Default ground at the site: the rock that the presets are for.
pub const DEFAULT_SITE: SiteClass = SiteClass::Be;

/// Which earthquakes.
#[derive(Debug, Clone, PartialEq)]
pub enum Earthquakes {
    /// One magnitude at one distance.
    One {
        /// Moment magnitude.
        magnitude: f64,
        /// Distance \[m\].
        distance_m: f64,
    },
    /// Earthquakes whose mean spectrum fits the rock spectrum of AS 1170.4 from T = 0.5 to 1 s.
    Pairs {
        /// kp·Z of the code, with its minimum \[g\].
        kpz_g: f64,
        /// Magnitudes; empty: 5.5, 6, 6.5 and 7.
        magnitudes: Vec<f64>,
    },
}

/// Motions to simulate.
#[derive(Debug, Clone, PartialEq)]
pub struct SimulatedRequest {
    /// Parameters that belong together.
    pub preset: Preset,
    /// Changes to them.
    pub changes: SourceChanges,
    /// Which earthquakes.
    pub earthquakes: Earthquakes,
    /// The ground at the site, by AS 1170.4.
    pub site: SiteClass,
    /// Motions of each earthquake.
    pub count: u64,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Time step and low cut.
    pub options: SimulationOptions,
}

/// What was simulated.
#[derive(Debug, Clone, Serialize)]
pub struct SimulatedReport {
    preset: &'static str,
    parameters: SourceParameters,
    /// The class of the ground at the site.
    pub site: &'static str,
    kpz_g: Option<f64>,
    seed: u64,
    generator: &'static str,
    dt_s: f64,
    low_cut_hz: f64,
    /// The assumptions, one sentence each.
    pub assumptions: Vec<String>,
    /// Warnings for the reader.
    #[serde(skip)]
    pub warnings: Vec<String>,
    /// The earthquakes and their motions.
    pub earthquakes: Vec<Earthquake>,
}

/// The parameters that all earthquakes of a report share.
#[derive(Debug, Clone, Serialize)]
pub struct SourceParameters {
    stress_drop_pa: f64,
    density_kg_m3: f64,
    shear_velocity_m_s: f64,
    source_spectrum: &'static str,
    spreading: Vec<Spreading>,
    quality: String,
    kappa_s: Option<f64>,
    maximum_frequency_hz: Option<f64>,
    vs30_m_s: Option<f64>,
    path_duration: &'static str,
    window: &'static str,
}

#[derive(Debug, Clone, Serialize)]
struct Spreading {
    from_distance_m: f64,
    exponent_ratio: f64,
}

/// One earthquake and its motions.
#[derive(Debug, Clone, Serialize)]
pub struct Earthquake {
    /// Moment magnitude.
    pub magnitude: f64,
    /// Distance \[m\].
    pub distance_m: f64,
    /// Geometric mean of the PSA divided by the code's on rock, T = 0.5 to 1 s, if the distance was
    /// searched for.
    pub mean_ratio_to_rock_spectrum: Option<f64>,
    /// Number of motions that the distance was searched with; it does not depend on the number that
    /// is written.
    pub searched_motions: Option<u32>,
    /// The same ratio for the written motions and the code's spectrum for the site, if there is
    /// one.
    pub written_mean_ratio_to_site_spectrum: Option<f64>,
    moment_n_m: f64,
    /// f₀, or f_a and f_b.
    pub corner_frequencies_hz: Vec<f64>,
    /// T_d of the window.
    pub duration_s: f64,
    pad_s: f64,
    /// Its motions.
    pub motions: Vec<SimulatedMotion>,
    /// Frequencies and target amplitudes, for `fourier_amplitude.csv`.
    #[serde(skip)]
    fourier: (Vec<f64>, Vec<f64>),
}

/// One motion.
#[derive(Debug, Clone, Serialize)]
pub struct SimulatedMotion {
    /// Name for files.
    pub name: String,
    /// The file that it was written to.
    pub path: Option<String>,
    /// Number of samples.
    pub npts: usize,
    /// PGA \[g\].
    pub pga_g: f64,
    /// PGV \[m/s\].
    pub pgv_m_s: f64,
    /// PGD \[m\].
    pub pgd_m: f64,
    /// Arias intensity \[m/s\].
    pub arias_m_s: f64,
    /// Significant duration \[s\].
    pub d5_95_s: f64,
    /// The samples.
    #[serde(skip)]
    pub motion: Motion,
}

/// Frequencies of `fourier_amplitude.csv`: 0.05 to 50 Hz.
const FOURIER_POINTS: usize = 151;

/// An earthquake of a request, with its distance.
#[derive(Debug, Clone, PartialEq)]
pub struct FoundEarthquake {
    /// Its number in the request: each earthquake has its own random numbers.
    pub number: u32,
    /// Source and path.
    pub source: PointSource,
    /// Geometric mean of the PSA divided by the code's on rock, T = 0.5 to 1 s, if the distance was
    /// searched for.
    pub mean_ratio_to_rock_spectrum: Option<f64>,
}

impl FoundEarthquake {
    /// The name of a motion, counted from 0: `m6.0-30km-01`.
    pub fn motion_name(&self, index: u64) -> String {
        format!("m{:.1}-{:.0}km-{:02}", self.source.magnitude, self.source.distance_m / 1000.0, index + 1)
    }

    /// The stream of random numbers of a motion, counted from 0.
    pub fn stream(&self, index: u64) -> u64 {
        stream(self.number, 0) + index
    }

    /// f₀, or f_a and f_b \[Hz\].
    pub fn corner_frequencies_hz(&self) -> Vec<f64> {
        match self.source.corners() {
            Corners::Single { corner_hz } => vec![corner_hz],
            Corners::Two { lower_hz, upper_hz, .. } => vec![lower_hz, upper_hz],
        }
    }
}

/// The earthquakes of a request. Distances that fit a code's spectrum are searched for, which takes
/// several rounds of [`PAIR_MOTIONS`] motions.
///
/// # Errors
/// Parameters out of range, or a magnitude that does not fit the spectrum at any distance from 2 to
/// 300 km.
pub fn find_earthquakes(request: &SimulatedRequest) -> Result<Vec<FoundEarthquake>, Problem> {
    let source = |magnitude, distance_m| changed(request.preset.source(magnitude, distance_m), &request.changes);
    let found = match &request.earthquakes {
        Earthquakes::One { magnitude, distance_m } => {
            let source = source(*magnitude, *distance_m);
            vec![FoundEarthquake { number: 0, source, mean_ratio_to_rock_spectrum: None }]
        }
        Earthquakes::Pairs { kpz_g, magnitudes } => {
            let all = if magnitudes.is_empty() { &PAIR_MAGNITUDES[..] } else { magnitudes };
            let mut found = Vec::new();
            for (number, &magnitude) in (0..).zip(all) {
                let rock = |period_s| kpz_g * SiteClass::Be.shape_factor_ratio(period_s);
                let streams = stream(number, 0)..stream(number, PAIR_MOTIONS);
                let at = |r_m| source(magnitude, r_m);
                let pair = distance_for_target(at, rock, &request.options, request.seed, streams);
                let pair = pair.map_err(source_problem)?.ok_or_else(|| no_distance(magnitude, *kpz_g))?;
                let mean_ratio_to_rock_spectrum = Some(pair.mean_ratio);
                let source = source(magnitude, pair.distance_m);
                found.push(FoundEarthquake { number, source, mean_ratio_to_rock_spectrum });
            }
            found
        }
    };
    // Parameters out of their range are reported before anything is computed.
    found.iter().try_for_each(|one| simulator(request, one).map(|_| ())).map_err(source_problem)?;
    Ok(found)
}

/// The generator of the motions of one earthquake at the request's site.
///
/// # Errors
/// Parameters out of range.
pub fn simulator(request: &SimulatedRequest, found: &FoundEarthquake) -> Result<Simulator, SynthesisError> {
    let (site, rock) = (request.site, SiteClass::Be);
    let site_ratio = |period_s: f64| site.shape_factor_ratio(period_s) / rock.shape_factor_ratio(period_s);
    Simulator::new(&found.source, site_ratio, &request.options)
}

/// Simulates.
///
/// # Errors
/// As [`find_earthquakes`].
pub fn simulate(request: &SimulatedRequest) -> Result<SimulatedReport, Problem> {
    let found = find_earthquakes(request)?;
    let kpz_g = match request.earthquakes {
        Earthquakes::One { .. } => None,
        Earthquakes::Pairs { kpz_g, .. } => Some(kpz_g),
    };
    let earthquakes = found
        .iter()
        .map(|found| earthquake(request, found, kpz_g))
        .collect::<Result<Vec<_>, SynthesisError>>()
        .map_err(source_problem)?;
    Ok(SimulatedReport {
        preset: request.preset.name(),
        parameters: request.parameters(),
        site: request.site.name(),
        kpz_g,
        seed: request.seed,
        generator: GENERATOR,
        dt_s: request.options.dt_s,
        low_cut_hz: request.options.low_cut_hz,
        assumptions: request.assumptions(),
        warnings: request.limits(&found),
        earthquakes,
    })
}

/// A parameter that is out of its range, by its key and in the unit that it has as text.
fn source_problem(error: SynthesisError) -> Problem {
    let fields = [
        ("magnitude", "magnitude", Dimension::Ratio),
        ("distance_m", "distance", Dimension::Length),
        ("stress_drop_pa", "stress_drop", Dimension::Pressure),
        ("kappa_s", "kappa", Dimension::Time),
        ("dt_s", "time_step", Dimension::Time),
        ("low_cut_hz", "low_cut", Dimension::Frequency),
    ];
    if let SynthesisError::Option { name, requirement, value } = &error
        && let Some((_, key, dimension)) = fields.iter().find(|(field, ..)| field == name)
    {
        let message = format!("`{key}` must be {requirement}, not {}", format_si(*value, *dimension));
        return Problem::value(message, "give a value within these limits").of(&[*key]);
    }
    Problem::value(error.to_string(), "give other values for the source or the motion")
}

fn changed(source: PointSource, changes: &SourceChanges) -> PointSource {
    PointSource {
        stress_drop_pa: changes.stress_drop_pa.unwrap_or(source.stress_drop_pa),
        high_cut: changes.kappa_s.map_or(source.high_cut, |kappa_s| HighCut::Kappa { kappa_s }),
        spectrum: changes.spectrum.unwrap_or(source.spectrum),
        path_duration: changes.path_duration.unwrap_or(source.path_duration),
        window: changes.window.unwrap_or(source.window),
        profile: if changes.hard_rock { None } else { source.profile.clone() },
        ..source
    }
}

/// The rock spectrum of a city, by AS 1170.4, with its warnings.
///
/// # Errors
/// A city or a return period that the code does not have.
pub fn city_rock(city: &str, return_period_years: u32) -> Result<Target, Problems> {
    let years = return_period_years.to_string();
    let words = [("city", city), ("return_period_years", years.as_str()), ("site", SiteClass::Be.name())];
    Target::resolve(&words.into_iter().collect(), Path::new(""))
}

fn no_distance(magnitude: f64, kpz_g: f64) -> Problem {
    let message = format!(
        "no distance from 2 to 300 km gives earthquakes of magnitude {} the rock spectrum of kpZ = {} g",
        number(magnitude, 3),
        number(kpz_g, 3)
    );
    let hint = "give another magnitude or return period, or a distance";
    Problem::value(message, hint).of(&["magnitude"])
}

/// The motions of an earthquake, each with its own random numbers; kpZ if its distance was searched
/// for.
fn earthquake(
    request: &SimulatedRequest,
    found: &FoundEarthquake,
    kpz_g: Option<f64>,
) -> Result<Earthquake, SynthesisError> {
    let (source, site) = (&found.source, request.site);
    let simulator = simulator(request, found)?;
    let motions = (0..request.count).into_par_iter().map(|index| {
        let motion = simulator.motion(request.seed, found.stream(index))?;
        let m = measures(&motion);
        Ok(SimulatedMotion {
            name: found.motion_name(index),
            path: None,
            npts: motion.accel_m_s2().len(),
            pga_g: m.pga_m_s2 / G0_M_S2,
            pgv_m_s: m.pgv_m_s,
            pgd_m: m.pgd_m,
            arias_m_s: m.arias_m_s,
            d5_95_s: m.d5_95_s,
            motion,
        })
    });
    let motions: Vec<SimulatedMotion> = motions.collect::<Result<_, SynthesisError>>()?;
    let frequency = |i: usize| 0.05 * 1000.0_f64.powf(i as f64 / (FOURIER_POINTS - 1) as f64);
    let frequencies_hz: Vec<f64> = (0..FOURIER_POINTS).map(frequency).collect();
    let amplitudes = frequencies_hz.iter().filter_map(|&f| simulator.amplitude_m_s(f)).collect();
    Ok(Earthquake {
        magnitude: source.magnitude,
        distance_m: source.distance_m,
        mean_ratio_to_rock_spectrum: found.mean_ratio_to_rock_spectrum,
        searched_motions: kpz_g.map(|_| PAIR_MOTIONS),
        written_mean_ratio_to_site_spectrum: match kpz_g {
            Some(kpz_g) => mean_ratio(motions.iter().map(|one| &one.motion), |t| kpz_g * site.shape_factor_ratio(t))?,
            None => None,
        },
        moment_n_m: source.moment_n_m(),
        corner_frequencies_hz: found.corner_frequencies_hz(),
        duration_s: source.duration_s(),
        pad_s: simulator.pad_s(),
        motions,
        fourier: (frequencies_hz, amplitudes),
    })
}

fn parameters(source: &PointSource) -> SourceParameters {
    let (kappa_s, maximum_frequency_hz) = match source.high_cut {
        HighCut::Kappa { kappa_s } => (Some(kappa_s), None),
        HighCut::MaximumFrequency { frequency_hz } => (None, Some(frequency_hz)),
    };
    SourceParameters {
        stress_drop_pa: source.stress_drop_pa,
        density_kg_m3: source.density_kg_m3,
        shear_velocity_m_s: source.shear_velocity_m_s,
        source_spectrum: match source.spectrum {
            SourceSpectrum::SingleCorner => "single-corner",
            SourceSpectrum::TwoCorner => "two-corner",
        },
        spreading: source
            .spreading
            .iter()
            .map(|piece| Spreading { from_distance_m: piece.from_distance_m, exponent_ratio: piece.exponent_ratio })
            .collect(),
        quality: match source.quality {
            Quality::Power { at_1_hz_ratio, exponent_ratio } => format!("{at_1_hz_ratio} f^{exponent_ratio}"),
            Quality::LogCubic { coefficients_ratio: [a, b, c, d], lowest_hz, highest_hz } => format!(
                "log10 Q = {a} + {b} x + {c} x^2 + {d} x^3, x = log10 f, held below {lowest_hz} and above \
                 {highest_hz} Hz"
            ),
        },
        kappa_s,
        maximum_frequency_hz,
        vs30_m_s: source.profile.as_ref().map(freestand::synthesis::ShearWaveProfile::vs30_m_s),
        path_duration: match source.path_duration {
            PathDuration::Boore => "0.05 s/km",
            PathDuration::AtkinsonBoore => "Atkinson and Boore (1995)",
        },
        window: source.window.name(),
    }
}

impl SourceParameters {
    /// In words for a report.
    pub(crate) fn one_line(&self) -> String {
        let near_the_surface = match (self.kappa_s, self.maximum_frequency_hz) {
            (Some(kappa_s), _) => format!("κ0 = {} s", number(kappa_s, 4)),
            (None, Some(frequency_hz)) => format!("f_max = {} Hz", number(frequency_hz, 4)),
            (None, None) => "no loss near the surface".to_owned(),
        };
        let crust = match self.vs30_m_s {
            Some(vs30_m_s) => format!("crust with V_S30 = {} m/s", number(vs30_m_s, 3)),
            None => "no amplification by the crust".to_owned(),
        };
        let spreading: Vec<String> = self
            .spreading
            .iter()
            // 0 less the exponent, so that no spreading is R^0 and not R^-0.
            .map(|piece| format!("R^{} from {} km", 0.0 - piece.exponent_ratio, number(piece.from_distance_m / 1e3, 3)))
            .collect();
        format!(
            "{} spectrum, {} MPa, {} kg/m³, {} m/s; {}; Q = {}; {near_the_surface}; {crust}; path duration {}; \
             window {}",
            self.source_spectrum,
            number(self.stress_drop_pa / 1e6, 4),
            number(self.density_kg_m3, 4),
            number(self.shear_velocity_m_s, 4),
            spreading.join(", "),
            self.quality,
            self.path_duration,
            self.window
        )
    }
}

impl SimulatedRequest {
    /// The parameters that all its earthquakes share.
    pub fn parameters(&self) -> SourceParameters {
        // Neither depends on the magnitude or the distance.
        parameters(&changed(self.preset.source(6.0, 30e3), &self.changes))
    }

    /// The assumptions, one sentence each.
    pub fn assumptions(&self) -> Vec<String> {
        assumptions(self, &changed(self.preset.source(6.0, 30e3), &self.changes))
    }

    /// Warnings about earthquakes that the preset was not made for.
    pub fn limits(&self, found: &[FoundEarthquake]) -> Vec<String> {
        found.iter().filter_map(|one| outside_limits(self.preset, &one.source)).collect()
    }
}

impl SimulatedReport {
    /// All motions, earthquake by earthquake.
    pub fn motions(&self) -> impl Iterator<Item = &SimulatedMotion> {
        self.earthquakes.iter().flat_map(|one| &one.motions)
    }

    /// The code's spectrum for the site (period \[s\] to g), if distances were searched for with
    /// one.
    pub fn code_spectrum(&self) -> Option<impl Fn(f64) -> f64 + use<>> {
        let site = SiteClass::parse(self.site).ok()?;
        self.kpz_g.map(|kpz_g| move |period_s| kpz_g * site.shape_factor_ratio(period_s))
    }

    /// The target amplitudes of every earthquake against frequency, with low cut and site.
    ///
    /// # Errors
    /// The error of the CSV library.
    pub fn fourier_csv(&self) -> Result<Vec<u8>, Problem> {
        let names: Vec<String> = self
            .earthquakes
            .iter()
            .map(|one| format!("amplitude_m{:.1}_{:.0}km_m_s", one.magnitude, one.distance_m / 1000.0))
            .collect();
        let Some(first) = self.earthquakes.first() else { return Ok(Vec::new()) };
        let mut columns = vec![("frequency_hz", &first.fourier.0[..first.fourier.1.len()])];
        for (name, one) in names.iter().zip(&self.earthquakes) {
            columns.push((name, &one.fourier.1[..]));
        }
        columns_csv(&columns)
    }
}
