//! A hazard curve: how often motions reach an intensity.

use std::path::PathBuf;

use freestand_input::problem::Problem;
use freestand_input::quantity::{Dimension, shorten};
use freestand_input::word_reader::WordReader;
use freestand_records::tables::hazard::Wanted;
use freestand_risk::coordinates;
use freestand_risk::fragility::{HAZARD_CODES, HazardCode, HazardSource, Measure};
use freestand_study::places::wanted_site;

use crate::files::Files;
use crate::request::{one_of, path, request};

request! {
    /// A hazard curve of a file, or a power law.
    pub struct HazardCurve {
        /// Hazard curve: "pgv [m/s],annual_rate", or a file of OpenQuake, USGS, EFEHR, AFAD or NTC; --place chooses
        /// its site
        pub hazard = "FILE",
        /// Power law, such as "k0=1e-4 /yr, k=2.5, reference=1 m/s"
        pub hazard_power = "LAW",
        /// Intensity measure of a hazard that is not from a file, or which curve of a file with several: pga, pgv,
        /// pfv, sa(0.5) and so on [default: that of the fragilities]
        pub hazard_im = "IM",
        /// Longitude and latitude in degrees: the site to use of a hazard file with several, or the place
        /// of exported objects
        pub site_coordinates = "LON,LAT" with (alias = "site-deg"),
    }
}

request! {
    /// The return periods of a code.
    pub struct HazardOfCode {
        /// Place whose return periods are the hazard, for pga or sa(T); with --hazard the site of that file
        pub place = "NAME",
        /// Return periods of a code, for pga or sa(T)
        pub hazard_code = "CODE" with (value_parser = one_of(HAZARD_CODES)),
        /// Site class of the code
        pub site = "CLASS",
        /// Hazard factor Z of the code
        pub hazard_factor = "RATIO",
        /// Distance to the nearest major fault, of NZS 1170.5
        pub fault_distance = "LENGTH",
    }
}

impl HazardCurve {
    /// The hazard; `None` if none is given, or something is wrong.
    pub(crate) fn source(
        read: &mut WordReader<'_>,
        measure: Option<Measure>,
        files: &Files,
    ) -> Option<HazardSource> {
        let file = path(read, "hazard", files);
        let law = read.one("hazard_power").map(str::to_owned);
        read.exclusive("hazard", "hazard_power");
        let law = law.map(|text| HazardSource::PowerLaw { text, measure });
        // Without a file the place is not for the hazard.
        let site = match &file {
            Some(_) => {
                let place = read.one("place").map(str::to_owned);
                read.problems.keep(wanted_site(place.as_deref()))?
            }
            None => Wanted::default(),
        };
        let file = file.map(|path| HazardSource::File {
            path,
            measure,
            site,
        });
        file.or(law)
    }

    /// Longitude and latitude \[degrees\].
    pub(crate) fn site_deg(read: &mut WordReader<'_>) -> Option<(f64, f64)> {
        let text = read.text("site_coordinates")?;
        read.keep("site_coordinates", coordinates(text))
    }

    /// The file of the curve.
    pub(crate) fn input(&self, files: &Files) -> Option<PathBuf> {
        files.path_of(self.hazard.as_ref())
    }
}

impl HazardOfCode {
    /// The hazard; `None` if no code and no place is given, or something is wrong.
    pub(crate) fn source(
        read: &mut WordReader<'_>,
        measure: Option<Measure>,
    ) -> Option<HazardSource> {
        let name = read.one("place").map(str::to_owned);
        let code = read.choice("hazard_code", HAZARD_CODES);
        let site = read.one("site").map(str::to_owned);
        let hazard_factor = read.positive("hazard_factor", Dimension::Ratio);
        let fault_distance_m = read.non_negative("fault_distance", Dimension::Length);
        let is_another = read.has("hazard") || read.has("hazard_power");
        if let Some(name) = name.filter(|_| !is_another) {
            for key in ["hazard_code", "hazard_factor", "fault_distance"] {
                read.exclusive("place", key);
            }
            return Some(HazardSource::Place {
                name,
                site,
                measure,
            });
        }
        read.exclusive("place", "hazard_power");
        if !read.has("hazard_code") {
            for key in ["site", "hazard_factor", "fault_distance"] {
                if read.has(key) && is_another {
                    unused(read, key, "a hazard that does not come from a code");
                }
            }
            return None;
        }
        for (key, example) in [("site", "De"), ("hazard_factor", "0.12")] {
            if !read.has(key) && !is_another {
                let hint = format!("give `{key}`, such as {example}");
                read.missing(&[key], format!("the hazard needs `{key}`"), hint);
            }
        }
        if code == Some(HazardCode::As1170_4) && read.has("fault_distance") {
            unused(read, "fault_distance", "AS 1170.4");
        }
        Some(HazardSource::Code {
            code: code?,
            site: site?,
            hazard_factor: hazard_factor?,
            fault_distance_km: fault_distance_m.map(|distance_m| distance_m / 1e3),
            measure,
        })
    }
}

/// A value that a source would ignore.
fn unused(read: &mut WordReader<'_>, key: &'static str, source: &str) {
    let message = format!("{source} does not use `{key}`");
    read.note(&[key], message, format!("leave out `{key}`"));
}

/// The measure of a hazard that is not from a file.
pub(crate) fn measure(read: &mut WordReader<'_>) -> Option<Measure> {
    read.read("hazard_im", |text| {
        Measure::parse(text).ok_or_else(|| {
            let message = format!("\"{}\" is not an intensity measure", shorten(text));
            Problem::value(
                message,
                "write pga, pgv, pfa, pfv, sa(0.5), sa_avg(0.2:2), velocity_ratio or acceleration_ratio",
            )
        })
    })
}
