//! Motions of stochastic point sources: request → report.

mod assumptions;

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
use crate::cushion::KeyStyle;
use crate::error::{Problem, ProblemKind};
use crate::tables::columns_csv;
use crate::target::{Target, TargetWords};
use crate::words::number;

/// What is changed in a preset; `None` leaves it.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SourceChanges {
    /// Stress drop \[Pa\].
    pub stress_drop_pa: Option<f64>,
    /// κ₀ \[s\], in place of another loss near the surface.
    pub kappa_s: Option<f64>,
    /// Shape of the source spectrum.
    pub spectrum: Option<SourceSpectrum>,
    /// Duration along the path.
    pub path_duration: Option<PathDuration>,
    /// How shaking rises and falls.
    pub window: Option<freestand::synthesis::Window>,
    /// No amplification by the crust.
    pub hard_rock: bool,
}

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
    /// Those whose mean spectrum meets the rock spectrum of AS 1170.4 over T = 0.5 to 1 s.
    Pairs {
        /// A place of the code's table.
        city: String,
        /// Return period.
        return_period_years: u32,
        /// Magnitudes; empty: 5.5, 6, 6.5 and 7.
        magnitudes: Vec<f64>,
    },
}

/// Motions to simulate.
#[derive(Debug, Clone, PartialEq)]
pub struct SimulatedRequest {
    /// Parameters that belong together.
    pub preset: Preset,
    /// What is changed in them.
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
    parameters: Parameters,
    /// The class of the ground at the site.
    pub site: &'static str,
    kpz_g: Option<f64>,
    seed: u64,
    generator: &'static str,
    dt_s: f64,
    low_cut_hz: f64,
    /// What is assumed, in sentences.
    pub assumptions: Vec<String>,
    /// What the reader must know, besides.
    #[serde(skip)]
    pub warnings: Vec<String>,
    /// The earthquakes and their motions.
    pub earthquakes: Vec<Earthquake>,
}

/// The parameters that all earthquakes of a report share.
#[derive(Debug, Clone, Serialize)]
struct Parameters {
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
    /// Geometric mean of PSA over the code's on rock, T = 0.5 to 1 s, where it was searched for.
    pub mean_ratio_to_rock_spectrum: Option<f64>,
    /// So many motions the distance was searched with, however many are written.
    pub searched_motions: Option<u32>,
    /// Of the written motions over the code's spectrum for the site, as far as there is one.
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
    /// Where it was written.
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

/// Simulates.
///
/// # Errors
/// A city or return period that the code does not have, parameters out of range, a magnitude that meets the spectrum at
/// no distance from 2 to 300 km.
pub fn simulate(request: &SimulatedRequest) -> Result<SimulatedReport, Problem> {
    let wrong = |error: SynthesisError| {
        Problem::new(ProblemKind::Value, error.to_string())
            .hint("give another value; `freestand motion simulate --help` lists the flags")
    };
    let source = |magnitude, distance_m| changed(request.preset.source(magnitude, distance_m), &request.changes);
    let (rock, found) = match &request.earthquakes {
        Earthquakes::One { magnitude, distance_m } => (None, vec![(source(*magnitude, *distance_m), None)]),
        Earthquakes::Pairs { city, return_period_years, magnitudes } => {
            let rock = rock(city, *return_period_years)?;
            let all = if magnitudes.is_empty() { &PAIR_MAGNITUDES[..] } else { magnitudes };
            let mut found = Vec::new();
            for (number, &magnitude) in (0..).zip(all) {
                let streams = stream(number, 0)..stream(number, PAIR_MOTIONS);
                let sa_g = |period_s| rock.spectrum.sa_g(period_s);
                let at = |r_m| source(magnitude, r_m);
                let pair = distance_for_target(at, sa_g, &request.options, request.seed, streams);
                let pair = pair.map_err(wrong)?.ok_or_else(|| no_distance(magnitude, rock.kpz_g()))?;
                found.push((source(magnitude, pair.distance_m), Some(pair.mean_ratio)));
            }
            (Some(rock), found)
        }
    };
    let kpz_g = rock.as_ref().and_then(Target::kpz_g);
    let mut warnings = rock.map_or_else(Vec::new, |rock| rock.warnings);
    warnings.extend(found.iter().filter_map(|(source, _)| outside_limits(request.preset, source)));
    let earthquakes = (0..)
        .zip(&found)
        .map(|(number, (source, ratio))| earthquake(request, number, source, kpz_g.zip(*ratio)))
        .collect::<Result<Vec<_>, SynthesisError>>()
        .map_err(wrong)?;
    Ok(SimulatedReport {
        preset: request.preset.name(),
        parameters: parameters(&source(6.0, 30e3)),
        site: request.site.name(),
        kpz_g,
        seed: request.seed,
        generator: GENERATOR,
        dt_s: request.options.dt_s,
        low_cut_hz: request.options.low_cut_hz,
        assumptions: assumptions(request, &source(6.0, 30e3)),
        warnings,
        earthquakes,
    })
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

/// The rock spectrum of a city.
fn rock(city: &str, return_period_years: u32) -> Result<Target, Problem> {
    let mut words = TargetWords::new(KeyStyle::Flag);
    words.set("city", city);
    words.set("return_period_years", return_period_years.to_string());
    words.set("site", SiteClass::Be.name());
    Target::resolve(&words, Path::new("")).map_err(|problems| {
        let first = problems.into_iter().next().map(|problem| problem.problem);
        first.unwrap_or_else(|| Problem::new(ProblemKind::Value, format!("AS 1170.4 has no spectrum for \"{city}\"")))
    })
}

fn no_distance(magnitude: f64, kpz_g: Option<f64>) -> Problem {
    let message = format!(
        "earthquakes of magnitude {} meet the rock spectrum of kpZ = {} g at no distance from 2 to 300 km",
        number(magnitude, 3),
        kpz_g.map_or_else(String::new, |kpz_g| number(kpz_g, 3))
    );
    Problem::new(ProblemKind::Value, message).hint("give another magnitude or return period, or a --distance")
}

/// The earthquake of a number, each with random numbers of its own; with kpZ and the ratio of the search, if there was one.
fn earthquake(
    request: &SimulatedRequest,
    earthquake: u32,
    source: &PointSource,
    kpz_g_and_ratio: Option<(f64, f64)>,
) -> Result<Earthquake, SynthesisError> {
    let (site, rock) = (request.site, SiteClass::Be);
    let site_ratio = |period_s: f64| site.shape_factor_ratio(period_s) / rock.shape_factor_ratio(period_s);
    let simulator = Simulator::new(source, site_ratio, &request.options)?;
    let motions = (0..request.count).into_par_iter().map(|index| {
        let motion = simulator.motion(request.seed, stream(earthquake, 0) + index)?;
        let m = measures(&motion);
        Ok(SimulatedMotion {
            name: motion_name(source, index),
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
        mean_ratio_to_rock_spectrum: kpz_g_and_ratio.map(|(_, ratio)| ratio),
        searched_motions: kpz_g_and_ratio.map(|_| PAIR_MOTIONS),
        written_mean_ratio_to_site_spectrum: match kpz_g_and_ratio {
            Some((kpz_g, _)) => {
                mean_ratio(motions.iter().map(|one| &one.motion), |t| kpz_g * site.shape_factor_ratio(t))?
            }
            None => None,
        },
        moment_n_m: source.moment_n_m(),
        corner_frequencies_hz: match source.corners() {
            Corners::Single { corner_hz } => vec![corner_hz],
            Corners::Two { lower_hz, upper_hz, .. } => vec![lower_hz, upper_hz],
        },
        duration_s: source.duration_s(),
        pad_s: simulator.pad_s(),
        motions,
        fourier: (frequencies_hz, amplitudes),
    })
}

/// `m6.0-30km-01`, counted from 0.
fn motion_name(source: &PointSource, index: u64) -> String {
    format!("m{:.1}-{:.0}km-{:02}", source.magnitude, source.distance_m / 1000.0, index + 1)
}

fn parameters(source: &PointSource) -> Parameters {
    let (kappa_s, maximum_frequency_hz) = match source.high_cut {
        HighCut::Kappa { kappa_s } => (Some(kappa_s), None),
        HighCut::MaximumFrequency { frequency_hz } => (None, Some(frequency_hz)),
    };
    Parameters {
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
                "log10 Q = {a} + {b} x + {c} x^2 + {d} x^3, x = log10 f, held below {lowest_hz} and above {highest_hz} Hz"
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

impl SimulatedReport {
    /// All motions, earthquake by earthquake.
    pub fn motions(&self) -> impl Iterator<Item = &SimulatedMotion> {
        self.earthquakes.iter().flat_map(|one| &one.motions)
    }

    /// The code's spectrum for the site (period \[s\] to g), where distances were looked for by one.
    pub fn code_spectrum(&self) -> Option<impl Fn(f64) -> f64 + use<>> {
        let site = SiteClass::parse(self.site).ok()?;
        self.kpz_g.map(|kpz_g| move |period_s| kpz_g * site.shape_factor_ratio(period_s))
    }

    /// The target amplitudes of every earthquake against frequency, low cut and site included.
    ///
    /// # Errors
    /// What the CSV library says.
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
