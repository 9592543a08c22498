//! Motions of stochastic point sources: from a request to a report.

mod assumptions;
mod words;

use freestand::G0_M_S2;
use freestand::code_spectrum::SiteClass;
use freestand::measures::{Measures, measures};
use freestand::motion::Motion;
use freestand::synthesis::{
    Corners, HighCut, PAIR_MAGNITUDES, PAIR_MOTIONS, Parameter, PathDuration, PointSource, Preset,
    SimulationOptions, Simulator, SourceSpectrum, SynthesisError, distance_for_target, mean_ratio,
    stream,
};
use rayon::prelude::*;

pub use self::assumptions::{OutsideLimits, PresetAssumption, SimulationAssumption};
use self::assumptions::{assumptions, outside_limits};
use crate::target::Target;
use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::{Dimension, format_si};
use freestand_input::words::number;
use freestand_output::answer_of;
use freestand_output::rows::table_of_columns;
use freestand_output::table::Table;

pub use words::{SourceInput, read_source, spectrum_name};

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
    /// A set of parameters that belong together.
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
#[derive(Debug, Clone)]
pub struct SimulatedReport<'a> {
    /// The request.
    pub request: &'a SimulatedRequest,
    /// Those of its earthquakes that the preset was not made for.
    pub limits: Vec<OutsideLimits>,
    /// The earthquakes and their motions.
    pub earthquakes: Vec<Earthquake>,
}

/// One earthquake and its motions.
#[derive(Debug, Clone)]
pub struct Earthquake {
    /// Its source, and its distance as it was found.
    pub found: FoundEarthquake,
    /// Number of motions that the distance was searched with; it does not depend on the number that
    /// is written.
    pub searched_motions: Option<u32>,
    /// Geometric mean of the PSA of the written motions divided by the code's spectrum for the site,
    /// if there is one.
    pub written_mean_ratio_to_site_spectrum: Option<f64>,
    pad_s: f64,
    /// Its motions.
    pub motions: Vec<SimulatedMotion>,
    /// Frequencies and target amplitudes, for `fourier_amplitude.csv`.
    fourier: (Vec<f64>, Vec<f64>),
}

/// One motion.
#[derive(Debug, Clone)]
pub struct SimulatedMotion {
    /// Name for files.
    pub name: String,
    /// The file that it was written to.
    pub path: Option<String>,
    measures: Measures,
    /// The samples.
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
        format!(
            "m{:.1}-{:.0}km-{:02}",
            self.source.magnitude,
            self.source.distance_m / 1000.0,
            index + 1
        )
    }

    /// The stream of random numbers of a motion, counted from 0.
    pub fn stream(&self, index: u64) -> u64 {
        stream(self.number, 0) + index
    }

    /// f₀, or f_a and f_b \[Hz\].
    pub fn corner_frequencies_hz(&self) -> Vec<f64> {
        match self.source.corners() {
            Corners::Single { corner_hz } => vec![corner_hz],
            Corners::Two {
                lower_hz, upper_hz, ..
            } => vec![lower_hz, upper_hz],
        }
    }
}

answer_of!(FoundEarthquake as found {
    magnitude: f64 = found.source.magnitude;
    distance_m: f64 = found.source.distance_m;
    /// Geometric mean of the PSA divided by the code's on rock, if the distance was searched for.
    mean_ratio_to_rock_spectrum: Option<f64>;
    moment_n_m: f64 = found.source.moment_n_m();
    corner_frequencies_hz: Vec<f64> = found.corner_frequencies_hz();
    duration_s: f64 = found.source.duration_s();
});

/// The earthquakes of a request. Distances that fit a code's spectrum are searched for, which takes
/// several rounds of [`PAIR_MOTIONS`] motions.
///
/// # Errors
/// Parameters out of range, or a magnitude that does not fit the spectrum at any distance from 2 to
/// 300 km.
pub fn find_earthquakes(request: &SimulatedRequest) -> Result<Vec<FoundEarthquake>, Problem> {
    let source = |magnitude, distance_m| {
        changed(
            request.preset.source(magnitude, distance_m),
            &request.changes,
        )
    };
    let found = match &request.earthquakes {
        Earthquakes::One {
            magnitude,
            distance_m,
        } => {
            let source = source(*magnitude, *distance_m);
            vec![FoundEarthquake {
                number: 0,
                source,
                mean_ratio_to_rock_spectrum: None,
            }]
        }
        Earthquakes::Pairs { kpz_g, magnitudes } => {
            let all = if magnitudes.is_empty() {
                &PAIR_MAGNITUDES[..]
            } else {
                magnitudes
            };
            let mut found = Vec::new();
            for (number, &magnitude) in (0..).zip(all) {
                let rock = |period_s| kpz_g * SiteClass::Be.shape_factor_ratio(period_s);
                let streams = stream(number, 0)..stream(number, PAIR_MOTIONS);
                let at = |r_m| source(magnitude, r_m);
                let pair = distance_for_target(at, rock, &request.options, request.seed, streams);
                let pair = pair
                    .map_err(source_problem)?
                    .ok_or_else(|| no_distance(magnitude, *kpz_g))?;
                let mean_ratio_to_rock_spectrum = Some(pair.mean_ratio);
                let source = source(magnitude, pair.distance_m);
                found.push(FoundEarthquake {
                    number,
                    source,
                    mean_ratio_to_rock_spectrum,
                });
            }
            found
        }
    };
    // Parameters out of their range are reported before anything is computed.
    found
        .iter()
        .try_for_each(|one| simulator(request, one).map(|_| ()))
        .map_err(source_problem)?;
    Ok(found)
}

/// The generator of the motions of one earthquake at the request's site.
///
/// # Errors
/// Parameters out of range.
pub fn simulator(
    request: &SimulatedRequest,
    found: &FoundEarthquake,
) -> Result<Simulator, SynthesisError> {
    let (site, rock) = (request.site, SiteClass::Be);
    let site_ratio =
        |period_s: f64| site.shape_factor_ratio(period_s) / rock.shape_factor_ratio(period_s);
    Simulator::new(&found.source, site_ratio, &request.options)
}

/// Simulates the motions of a request.
///
/// # Errors
/// As [`find_earthquakes`].
pub fn simulate(request: &SimulatedRequest) -> Result<SimulatedReport<'_>, Problem> {
    let found = find_earthquakes(request)?;
    let limits = request.limits(&found);
    let earthquakes = found
        .into_iter()
        .map(|found| earthquake(request, found))
        .collect::<Result<Vec<_>, SynthesisError>>()
        .map_err(source_problem)?;
    Ok(SimulatedReport {
        request,
        limits,
        earthquakes,
    })
}

/// The problem of a parameter that is out of its range: its key, and its value with a unit.
pub(crate) fn source_problem(error: SynthesisError) -> Problem {
    const HINT: &str = "give other values for the motion or its source";
    let SynthesisError::Option {
        parameter,
        requirement,
        value,
    } = error
    else {
        return Problem::value(error.to_string(), HINT);
    };
    let (key, dimension) = match parameter {
        Parameter::TimeStep => ("time_step", Dimension::Time),
        Parameter::Shaking => ("shaking", Dimension::Time),
        Parameter::Envelope => ("envelope", Dimension::Time),
        Parameter::LowCut => ("low_cut", Dimension::Frequency),
        Parameter::Magnitude => ("magnitude", Dimension::Ratio),
        Parameter::Distance => ("distance", Dimension::Length),
        Parameter::StressDrop => ("stress_drop", Dimension::Pressure),
        Parameter::Kappa => ("kappa", Dimension::Time),
        Parameter::Samples => {
            return Problem::value(
                error.to_string(),
                "give a longer `time_step`, or less shaking",
            )
            .of(&["time_step"]);
        }
        Parameter::Other(_) => return Problem::value(error.to_string(), HINT),
    };
    let message = format!(
        "`{key}` must be {requirement}, not {}",
        format_si(value, dimension)
    );
    Problem::value(message, "give a value within these limits").of(&[key])
}

fn changed(source: PointSource, changes: &SourceChanges) -> PointSource {
    PointSource {
        stress_drop_pa: changes.stress_drop_pa.unwrap_or(source.stress_drop_pa),
        high_cut: changes
            .kappa_s
            .map_or(source.high_cut, |kappa_s| HighCut::Kappa { kappa_s }),
        spectrum: changes.spectrum.unwrap_or(source.spectrum),
        path_duration: changes.path_duration.unwrap_or(source.path_duration),
        window: changes.window.unwrap_or(source.window),
        profile: if changes.hard_rock {
            None
        } else {
            source.profile.clone()
        },
        ..source
    }
}

/// The rock spectrum of a city, by AS 1170.4, with its warnings.
///
/// # Errors
/// A place outside Australia or not in the table, or a return period that the code does not have.
pub fn city_rock(city: &str, return_period_years: u32) -> Result<Target, Problems> {
    let years = return_period_years.to_string();
    let code = ("code", "as1170.4");
    let words = [
        code,
        ("city", city),
        ("return_period_years", years.as_str()),
        ("site", SiteClass::Be.name()),
    ];
    // Who names a city has named no code, and can give no other value of one.
    let of_city = |mut problem: Problem| {
        let is_of_code = problem.is_about("code");
        problem.keys.retain(|key| key != "code");
        match is_of_code {
            true => problem.hint(
                "name a place of AS 1170.4: freestand place list; or give `magnitude` and `distance`",
            ),
            false => problem,
        }
    };
    Target::resolve_place(&words.into_iter().collect())
        .map_err(|problems| problems.into_iter().map(of_city).collect())
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

/// The motions of an earthquake, each with its own random numbers.
fn earthquake(
    request: &SimulatedRequest,
    found: FoundEarthquake,
) -> Result<Earthquake, SynthesisError> {
    let simulator = simulator(request, &found)?;
    let motions = (0..request.count).into_par_iter().map(|index| {
        let motion = simulator.motion(request.seed, found.stream(index))?;
        Ok(SimulatedMotion {
            name: found.motion_name(index),
            path: None,
            measures: measures(&motion),
            motion,
        })
    });
    let motions: Vec<SimulatedMotion> = motions.collect::<Result<_, SynthesisError>>()?;
    let frequency = |i: usize| 0.05 * 1000.0_f64.powf(i as f64 / (FOURIER_POINTS - 1) as f64);
    let frequencies_hz: Vec<f64> = (0..FOURIER_POINTS).map(frequency).collect();
    let amplitudes = frequencies_hz
        .iter()
        .filter_map(|&f| simulator.amplitude_m_s(f))
        .collect();
    let target = request.code_spectrum();
    let mean = |target| mean_ratio(motions.iter().map(|one| &one.motion), target);
    Ok(Earthquake {
        searched_motions: target.as_ref().map(|_| PAIR_MOTIONS),
        written_mean_ratio_to_site_spectrum: target.map(mean).transpose()?.flatten(),
        pad_s: simulator.pad_s(),
        found,
        motions,
        fourier: (frequencies_hz, amplitudes),
    })
}

impl SimulatedRequest {
    /// A source with the parameters that all its earthquakes share.
    pub fn any_source(&self) -> PointSource {
        // No parameter but its own depends on the magnitude or the distance.
        changed(self.preset.source(6.0, 30e3), &self.changes)
    }

    /// Refuses what is out of range, as far as no distance has to be searched for.
    ///
    /// # Errors
    /// Each parameter that is out of range.
    pub fn check(&self) -> Result<(), Problems> {
        const USUAL: (f64, f64) = (6.0, 30e3);
        let (magnitude, distance_m) = match &self.earthquakes {
            Earthquakes::One {
                magnitude,
                distance_m,
            } => (*magnitude, *distance_m),
            Earthquakes::Pairs { magnitudes, .. } => {
                (magnitudes.first().copied().unwrap_or(USUAL.0), USUAL.1)
            }
        };
        let source = changed(self.preset.source(magnitude, distance_m), &self.changes);
        let faults = source.faults().into_iter().chain(self.options.faults());
        let problems: Problems = faults.map(source_problem).collect();
        problems.finish(Some(()))
    }

    /// What it assumes.
    pub fn assumptions(&self) -> Vec<SimulationAssumption> {
        assumptions(self, &self.any_source())
    }

    /// The earthquakes that the preset was not made for.
    pub fn limits(&self, found: &[FoundEarthquake]) -> Vec<OutsideLimits> {
        found
            .iter()
            .filter_map(|one| outside_limits(self.preset, &one.source))
            .collect()
    }

    /// kp·Z of the code, if distances are searched for with one \[g\].
    pub fn kpz_g(&self) -> Option<f64> {
        if let Earthquakes::Pairs { kpz_g, .. } = self.earthquakes {
            Some(kpz_g)
        } else {
            None
        }
    }

    /// The code's spectrum for the site (period \[s\] to g), if distances are searched for with one.
    pub fn code_spectrum(&self) -> Option<impl Fn(f64) -> f64 + use<>> {
        let site = self.site;
        self.kpz_g()
            .map(|kpz_g| move |period_s| kpz_g * site.shape_factor_ratio(period_s))
    }
}

answer_of!(Earthquake as one {
    found: &FoundEarthquake = &one.found => flat;
    searched_motions: Option<u64> = one.searched_motions.map(u64::from);
    /// Geometric mean of the PSA of the written motions divided by the code's spectrum.
    written_mean_ratio_to_site_spectrum: Option<f64>;
    pad_s: f64;
    motions: Vec<&SimulatedMotion> = one.motions.iter().collect();
});

answer_of!(SimulatedMotion as one {
    name: String;
    /// The file that it was written to.
    path: Option<String>;
    npts: usize = one.motion.accel_m_s2().len();
    pga_g: f64 = one.measures.pga_m_s2 / G0_M_S2;
    pgv_m_s: f64 = one.measures.pgv_m_s;
    pgd_m: f64 = one.measures.pgd_m;
    arias_m_s: f64 = one.measures.arias_m_s;
    d5_95_s: f64 = one.measures.d5_95_s;
});

impl SimulatedReport<'_> {
    /// All motions, earthquake by earthquake.
    pub fn motions(&self) -> impl Iterator<Item = &SimulatedMotion> {
        self.earthquakes.iter().flat_map(|one| &one.motions)
    }

    /// The target amplitudes of every earthquake against frequency, with low cut and site.
    ///
    /// # Errors
    /// The error of the CSV library.
    pub fn fourier_table(&self) -> Result<Table, Problem> {
        let names: Vec<String> = self
            .earthquakes
            .iter()
            .map(|one| &one.found.source)
            .map(|source| {
                format!(
                    "amplitude_m{:.1}_{:.0}km_m_s",
                    source.magnitude,
                    source.distance_m / 1000.0
                )
            })
            .collect();
        let Some(first) = self.earthquakes.first() else {
            return Ok(Table::default());
        };
        let mut columns = vec![("frequency_hz", &first.fourier.0[..first.fourier.1.len()])];
        for (name, one) in names.iter().zip(&self.earthquakes) {
            columns.push((name, &one.fourier.1[..]));
        }
        table_of_columns(&columns)
    }
}
