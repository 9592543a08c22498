//! `motion simulate`: motions of stochastic point sources.

use freestand::code_spectrum::SiteClass;
use freestand_input::problem::{Problem, Problems};
use freestand_input::word_reader::WordReader;
use freestand_input::written::Written;
use freestand_report::doubts::target_doubt;
use freestand_study::simulated::{
    DEFAULT_SITE, Earthquakes, SimulatedRequest, SourceInput, city_rock, read_source,
};
use freestand_study::study::{DEFAULT_MOTIONS, DEFAULT_SEED};
use freestand_study::target::{DEFAULT_YEARS, Target};

use crate::files::Files;
use crate::request::{Question, Request, motions, reader, request, seed};

/// The schema of the response.
pub const SCHEMA: &str = "freestand.motion-simulate/1";

request! { question
    /// Motions of earthquakes: of one magnitude at one distance, or of those that agree with the code spectrum of a city.
    pub struct Simulate {
        /// Moment magnitude [default with --city: 5.5, 6, 6.5 and 7]
        pub magnitude = "M",
        /// Distance from the source to the site
        pub distance = "LENGTH",
        /// Find the distances at which the mean spectrum agrees with the rock spectrum of this city
        /// (AS 1170.4)
        pub city = "NAME" with (visible_alias = "place"),
        /// Return period in years; needs --city [default: 500]
        #[arg(long = "return-period", value_name = "YEARS")]
        pub return_period_years: Option<Written>,
        /// Site class of AS 1170.4; for other classes than Be, amplitudes are multiplied by the ratio
        /// of the code spectra [default: Be]
        pub site = "CLASS",
        /// Number of motions of each earthquake [default: 10]
        pub count = "N",
        /// The source.
        #[command(flatten)]
        pub source: Source,

        /// Seed of the random numbers.
        #[arg(skip)]
        pub seed: Option<Written>,
    }
}

request! {
    /// A source and the crust around it.
    pub struct Source {
        /// Set of parameters: victoria (or melbourne), intraplate, se-australia [default: victoria]
        pub preset = "NAME" under "The source and the crust",
        /// Stress drop, such as "200 bar" or "23 MPa" [default: the preset's]
        pub stress_drop = "PRESSURE" under "The source and the crust",
        /// κ0, the attenuation near the surface [default: the preset's]
        pub kappa = "TIME" under "The source and the crust",
        /// Shape of the source spectrum: single-corner (Brune), two-corner (Atkinson and Boore 1995) [default: the
        /// preset's]
        pub source_spectrum = "SHAPE" under "The source and the crust",
        /// Duration along the path: boore (0.05 s per km), atkinson-boore (1995) [default: the preset's]
        pub path_duration = "NAME" under "The source and the crust",
        /// Window of the shaking: lam (Lam, Wilson and Hutchinson 2000), saragoni-hart (1974) [default: the preset's]
        pub window = "NAME" under "The source and the crust",
        /// No amplification by the crust
        pub hard_rock = switch under "The source and the crust",
        /// Time step [default: 0.005 s]
        pub time_step = "TIME" under "The motion",
        /// Corner frequency of the acausal high-pass filter [default: 0.05 Hz]
        pub low_cut = "FREQUENCY" under "The motion",
    }
}

/// What is asked, in SI.
#[derive(Debug)]
pub struct Meant {
    /// The earthquakes.
    pub request: SimulatedRequest,
    /// What is doubtful about the spectrum of the city.
    pub warnings: Vec<String>,
}

impl Question for Simulate {
    type Meant = Meant;

    fn resolve(&self, _: &Files) -> Result<Meant, Problems> {
        let words = self.words();
        let mut read = reader::<Self>(&words, &self.unknown);
        let rock = rock(&mut read);
        let source = read.problems.keep(read_source(&words));
        let kpz_g = rock.as_ref().and_then(Target::kpz_g);
        let earthquakes = earthquakes(&mut read, source.as_ref(), kpz_g);
        let site = read.read("site", site).unwrap_or(DEFAULT_SITE);
        let count = motions(&mut read).unwrap_or(DEFAULT_MOTIONS);
        let seed = seed(&mut read).unwrap_or(DEFAULT_SEED);
        let request = source.zip(earthquakes).map(|(source, earthquakes)| {
            let SourceInput {
                preset,
                changes,
                options,
                ..
            } = source;
            SimulatedRequest {
                preset,
                changes,
                earthquakes,
                site,
                count,
                seed,
                options,
            }
        });
        if let Some(request) = &request {
            read.problems.keep_comparisons(request.check());
        }
        let request = read.problems.finish(request)?;
        let of_rock = rock.iter().flat_map(|rock| &rock.doubts);
        let warnings = of_rock.map(target_doubt).collect();
        Ok(Meant { request, warnings })
    }

    fn set_seed(&mut self, seed: Option<Written>) {
        self.seed = seed;
    }
}

/// The rock spectrum of the city, if one is named.
fn rock(read: &mut WordReader<'_>) -> Option<Target> {
    let city = read.one("city");
    let years = read.whole("return_period_years").unwrap_or(DEFAULT_YEARS);
    if read.has("return_period_years") && !read.has("city") {
        let message = "`return_period_years` needs `city`: it selects the spectrum of a code";
        read.note(
            &["return_period_years"],
            message,
            "give `city`, or leave `return_period_years` out",
        );
    }
    read.problems.keep(city_rock(city?, years))
}

/// Which earthquakes; `kpz_g` is that of the city.
fn earthquakes(
    read: &mut WordReader<'_>,
    source: Option<&SourceInput>,
    kpz_g: Option<f64>,
) -> Option<Earthquakes> {
    if read.has("city") {
        read.exclusive("city", "distance");
        return Some(Earthquakes::Pairs {
            kpz_g: kpz_g?,
            magnitudes: source?.magnitude.into_iter().collect(),
        });
    }
    for key in ["magnitude", "distance"] {
        read.require(
            key,
            format!("`{key}` is missing"),
            "give `magnitude` and `distance`, or `city`",
        );
    }
    Some(Earthquakes::One {
        magnitude: source?.magnitude?,
        distance_m: source?.distance_m?,
    })
}

fn site(text: &str) -> Result<SiteClass, Problem> {
    let hint = "give Ae, Be, Ce, De or Ee, as in AS 1170.4";
    SiteClass::parse(text).map_err(|error| Problem::value(error.to_string(), hint))
}
