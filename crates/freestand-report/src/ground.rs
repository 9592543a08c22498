//! Where ground motions come from.

use freestand::code_spectrum::CodeSpectrum;
use freestand::suite::SuiteScale;
use freestand::synthesis::{
    GENERATOR, HighCut, PathDuration, PointSource, Quality, ShearWaveProfile, SpreadingPiece,
};
use freestand_input::words::{counted, number};
use freestand_output::answer_of;
use freestand_study::simulated::{
    Earthquake, FoundEarthquake, SimulatedReport, SimulatedRequest, spectrum_name,
};
use freestand_study::study::{Ground, SimulatedGround, SyntheticGround, VerticalTarget};
use freestand_study::suite::Suite;
use freestand_study::target::Target;

use crate::doubts::simulation_assumption;

/// The earthquake, for a title: `a 500-year earthquake: Melbourne, site class De`.
pub(crate) fn earthquake(target: &Target) -> String {
    match &target.spectrum {
        CodeSpectrum::As1170_4(code) => {
            let place = target
                .place_name()
                .unwrap_or_else(|| format!("Z = {}", code.hazard_factor()));
            let years = code.return_period_years();
            format!(
                "a {years}-year earthquake: {place}, site class {}",
                code.site().name()
            )
        }
        CodeSpectrum::Nzs1170_5(code) => {
            let years = code.return_period_years();
            let place = target
                .place_name()
                .unwrap_or_else(|| format!("NZS 1170.5, Z = {}", code.hazard_factor()));
            format!(
                "a {years}-year earthquake: {place}, site class {}",
                code.site().name()
            )
        }
        CodeSpectrum::Table(_) => {
            format!("an earthquake with the spectrum {}", target.file_name())
        }
        CodeSpectrum::Eurocode8(_)
        | CodeSpectrum::Asce7(_)
        | CodeSpectrum::Ntc2018(_)
        | CodeSpectrum::Tbdy2018(_)
        | CodeSpectrum::Ts1170_5(_) => match target.place_name() {
            Some(place) => format!(
                "an earthquake by {}: {place}, {}",
                target.spectrum.name(),
                target.site_words()
            ),
            None => format!(
                "an earthquake by {}: {}",
                target.spectrum.name(),
                target.parameters()
            ),
        },
    }
}

/// The earthquakes of the motions, for a title: `a simulated earthquake of magnitude 6 at 30
/// km`.
pub(crate) fn simulated_earthquakes(ground: &SimulatedGround) -> String {
    let each = |found: &FoundEarthquake| {
        let (magnitude, km) = (
            number(found.source.magnitude, 3),
            number(found.source.distance_m / 1e3, 2),
        );
        format!("magnitude {magnitude} at {km} km")
    };
    match (&ground.hazard, &ground.earthquakes[..]) {
        (Some(code), _) => {
            format!("simulated earthquakes equivalent to {}", earthquake(code))
        }
        (None, [one]) => {
            format!(
                "a simulated earthquake of {}, site class {}",
                each(one),
                ground.request.site.name()
            )
        }
        (None, _) => "simulated earthquakes".to_owned(),
    }
}

/// Where the vertical motion comes from, in words.
pub(crate) fn vertical_motion(ground: &Ground) -> String {
    match ground {
        Ground::Synthetic(SyntheticGround {
            vertical: VerticalTarget::Ratio(ratio),
            ..
        }) => {
            format!(
                "matched to {} of the target at every period, with phases of its own",
                number(*ratio, 3)
            )
        }
        Ground::Synthetic(SyntheticGround {
            vertical: VerticalTarget::Code,
            ..
        }) => "matched to the vertical spectrum of the code, with phases of its own".to_owned(),
        Ground::Recorded(_) if ground.has_vertical() => {
            "the vertical components of the records".to_owned()
        }
        _ => "horizontal only".to_owned(),
    }
}

/// The same parameters in words, for a report.
pub(crate) fn source_words(source: &PointSource) -> String {
    let near_the_surface = match source.high_cut {
        HighCut::Kappa { kappa_s } => format!("κ0 = {} s", number(kappa_s, 4)),
        HighCut::MaximumFrequency { frequency_hz } => {
            format!("f_max = {} Hz", number(frequency_hz, 4))
        }
    };
    let crust = match &source.profile {
        Some(profile) => format!("crust with V_S30 = {} m/s", number(profile.vs30_m_s(), 3)),
        None => "no amplification by the crust".to_owned(),
    };
    let spreading: Vec<String> = source
        .spreading
        .iter()
        // 0 less the exponent, so that no spreading is R^0 and not R^-0.
        .map(|piece| {
            format!(
                "R^{} from {} km",
                0.0 - piece.exponent_ratio,
                number(piece.from_distance_m / 1e3, 3)
            )
        })
        .collect();
    format!(
        "{} spectrum, {} MPa, {} kg/m³, {} m/s; {}; Q = {}; {near_the_surface}; {crust}; path duration {}; \
         window {}",
        spectrum_name(source.spectrum),
        number(source.stress_drop_pa / 1e6, 4),
        number(source.density_kg_m3, 4),
        number(source.shear_velocity_m_s, 4),
        spreading.join(", "),
        quality_words(&source.quality),
        path_words(source.path_duration),
        <&str>::from(source.window)
    )
}

fn quality_words(quality: &Quality) -> String {
    match quality {
        Quality::Power {
            at_1_hz_ratio,
            exponent_ratio,
        } => format!("{at_1_hz_ratio} f^{exponent_ratio}"),
        Quality::LogCubic {
            coefficients_ratio: [a, b, c, d],
            lowest_hz,
            highest_hz,
        } => format!(
            "log10 Q = {a} + {b} x + {c} x^2 + {d} x^3, x = log10 f, constant below {lowest_hz} and \
             above {highest_hz} Hz"
        ),
    }
}

fn path_words(path: PathDuration) -> &'static str {
    match path {
        PathDuration::Boore => "0.05 s/km",
        PathDuration::AtkinsonBoore => "Atkinson and Boore (1995)",
    }
}

/// The parameters that all earthquakes of a request share, for programs.
#[derive(Debug, Clone)]
pub(crate) struct Parameters(pub(crate) PointSource);

impl Parameters {
    /// κ₀ or the maximum frequency.
    fn high_cut(&self) -> (Option<f64>, Option<f64>) {
        match self.0.high_cut {
            HighCut::Kappa { kappa_s } => (Some(kappa_s), None),
            HighCut::MaximumFrequency { frequency_hz } => (None, Some(frequency_hz)),
        }
    }
}

answer_of!(Parameters as of.0 {
    stress_drop_pa: f64;
    density_kg_m3: f64;
    shear_velocity_m_s: f64;
    source_spectrum: &'static str = spectrum_name(of.0.spectrum);
    spreading: Vec<Spreading<'_>> = of.0.spreading.iter().map(Spreading).collect();
    quality: String = quality_words(&of.0.quality);
    kappa_s: Option<f64> = of.high_cut().0;
    maximum_frequency_hz: Option<f64> = of.high_cut().1;
    vs30_m_s: Option<f64> = of.0.profile.as_ref().map(ShearWaveProfile::vs30_m_s);
    path_duration: &'static str = path_words(of.0.path_duration);
    window: &'static str = of.0.window.into();
});

answer_of!(
    /// Geometric spreading from a distance on.
    struct Spreading<'s>(&'s SpreadingPiece) as piece.0 {
    from_distance_m: f64;
    exponent_ratio: f64;
});

/// `11 of 22 usable records, each with its own factor, from 0.53 to 3.1`.
pub(crate) fn count_words(suite: &Suite) -> String {
    let factors = || suite.members.iter().map(|(_, factor)| *factor);
    let (least, most) = (
        factors().fold(f64::INFINITY, f64::min),
        factors().fold(0.0, f64::max),
    );
    let scaled = match suite.scale {
        SuiteScale::Each => format!(
            "each with its own factor, from {} to {}",
            number(least, 3),
            number(most, 3)
        ),
        SuiteScale::One => format!("all with the factor {}", number(most, 3)),
    };
    format!(
        "{} of {}, {scaled}",
        suite.members.len(),
        counted(suite.usable, "usable record")
    )
}

/// `from 0.2 s to 3 s (no floor above the ground)`.
pub(crate) fn period_words(suite: &Suite) -> String {
    let ends = |at: Option<&f64>| number(at.copied().unwrap_or(f64::NAN), 3);
    let (from_s, to_s) = (ends(suite.periods_s.first()), ends(suite.periods_s.last()));
    format!("from {from_s} s to {to_s} s ({})", suite.periods_from)
}

/// What a simulation assumes, one sentence each.
pub fn assumptions(request: &SimulatedRequest) -> Vec<String> {
    let all = request.assumptions();
    all.iter().map(simulation_assumption).collect()
}

/// What was simulated.
#[derive(Debug, Clone, Copy)]
pub struct SimulatedAnswer<'r>(pub &'r SimulatedReport<'r>);

answer_of!(SimulatedAnswer<'_> as report.0 {
    preset: &'static str = report.0.request.preset.name();
    parameters: Parameters = Parameters(report.0.request.any_source());
    /// The class of the site, by AS 1170.4.
    site: &'static str = report.0.request.site.name();
    kpz_g: Option<f64> = report.0.request.kpz_g();
    seed: u64 = report.0.request.seed;
    /// Of the random numbers.
    generator: &'static str = GENERATOR;
    dt_s: f64 = report.0.request.options.dt_s;
    low_cut_hz: f64 = report.0.request.options.low_cut_hz;
    assumptions: Vec<String> = assumptions(report.0.request);
    earthquakes: Vec<&Earthquake> = report.0.earthquakes.iter().collect();
});
