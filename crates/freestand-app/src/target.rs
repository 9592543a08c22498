//! The target of synthetic motions and of comparisons: the spectrum of a code, or a table of the user.

use std::path::{Path, PathBuf};

use freestand::code_spectrum::PeriodCode;
use freestand_input::keys::Words;
use freestand_input::problem::Problems;
use freestand_input::word_reader::WordReader;
use freestand_input::written::Written;
use freestand_study::target::{Target, period_code};

use crate::files::Files;
use crate::request::{Request, request};

request! {
    /// A target: the spectrum of a code, or a table of the user.
    pub struct TargetKeys {
        /// Design code: as1170.4, eurocode8, asce7, nzs1170.5, ntc2018, tbdy2018, ts1170.5 [default: that of the place,
        /// as1170.4, or the table of --spectrum]
        pub code = "CODE" under "The code",
        /// Edition: 2007 (amended to 2018) or 2024 (unconfirmed) of AS 1170.4, 2022 or 2016 of ASCE 7 [default:
        /// the first]
        pub edition = "YEAR" under "The code",
        /// Site: class Ae to Ee of AS 1170.4 [default: De], ground type A to E of Eurocode 8 and NTC 2018, subsoil class A
        /// to E of NZS 1170.5, site class A to E of ASCE 7, ZA to ZE of TBDY 2018, I to VI of TS 1170.5
        pub site = "CLASS" under "The code",
        /// Place or coordinates ("41.01, 28.97") whose hazard is used, with its code: freestand place list [default:
        /// Melbourne]
        pub place = "NAME" under "The code",
        /// Latitude in degrees, north positive, in place of --place
        pub latitude = "DEGREES" with (allow_hyphen_values = true) under "The code",
        /// Longitude in degrees, east positive
        pub longitude = "DEGREES" with (allow_hyphen_values = true) under "The code",
        /// Topographic category T1 to T4 of NTC 2018 [default: T1]
        pub topography = "CLASS" under "The code",
        /// Hazard factor Z [default: that of the place]
        pub hazard_factor = "RATIO" under "AS 1170.4 and NZS 1170.5",
        /// Another name of --place
        pub city = "NAME" under "AS 1170.4 and NZS 1170.5",
        /// Return period in years [default: 500]
        #[arg(
            long = "return-period",
            value_name = "YEARS",
            help_heading = "AS 1170.4 and NZS 1170.5"
        )]
        pub return_period_years: Option<Written>,
        /// Distance to the nearest major fault, for N(T, D) of NZS 1170.5 [default: no fault nearby]
        pub fault_distance = "LENGTH" under "AS 1170.4 and NZS 1170.5",
        /// Type of spectrum: 1, or 2 if magnitudes stay below 5.5
        pub spectrum_type = "1|2" under "Eurocode 8",
        /// Reference ground acceleration on rock, a_gR
        pub ground_acceleration = "ACCELERATION" under "Eurocode 8",
        /// Importance factor [default: 1]
        pub importance_factor = "RATIO" under "Eurocode 8",
        /// Soil factor S of a national annex [default: as recommended for the ground type]
        pub soil_factor = "RATIO" under "Eurocode 8",
        /// TB, TC and TD of a national annex, such as "0.15 s, 0.5 s, 2 s" [default: as recommended]
        pub corner_periods = "LIST" under "Eurocode 8",
        /// Design acceleration at short periods
        pub sds = "ACCELERATION" under "ASCE 7",
        /// Design acceleration at 1 s
        pub sd1 = "ACCELERATION" under "ASCE 7",
        /// Mapped acceleration at short periods, instead of --sds
        pub ss = "ACCELERATION" under "ASCE 7",
        /// Mapped acceleration at 1 s, instead of --sd1
        pub s1 = "ACCELERATION" under "ASCE 7",
        /// Site coefficient of --ss [default: that of --site]
        pub fa = "RATIO" under "ASCE 7",
        /// Site coefficient of --s1 [default: that of --site]
        pub fv = "RATIO" under "ASCE 7",
        /// Long-period transition TL [default with --place: 8 s]
        pub long_period = "TIME" under "ASCE 7",
        /// Periods and pseudo-accelerations at 5 % damping, in columns with units in their headings; or a file of OpenQuake,
        /// USGS, EFEHR, AFAD or GEM, with --place for its site and --return-period
        pub spectrum = "FILE" under "A table of your own",
        /// How to interpolate between periods: log-log or linear [default: log-log]
        pub interpolation = "HOW" under "A table of your own",
        /// Outside the periods of the table: refuse, or hold (constant Sa below, constant displacement above)
        /// [default: refuse]
        pub beyond = "HOW" under "A table of your own",
    }
}

impl TargetKeys {
    /// The target; its problems are added.
    pub(crate) fn target(&self, read: &mut WordReader<'_>, files: &Files) -> Option<Target> {
        let keys: Vec<&'static str> = self.words().entries().map(|(key, _)| key).collect();
        read.pass(&keys);
        read.problems.keep(self.resolved(files))
    }

    /// The target.
    ///
    /// # Errors
    /// All problems of these keys.
    pub fn resolved(&self, files: &Files) -> Result<Target, Problems> {
        Target::resolve(&self.located(files)?, Path::new(""))
    }

    /// As [`TargetKeys::target`]; the target must cover all periods at which motions are matched.
    pub(crate) fn matched(&self, read: &mut WordReader<'_>, files: &Files) -> Option<Target> {
        let target = self.target(read, files)?;
        let covered = target.check_matched_band();
        let covered = covered.map_err(|problem| problem.of(&["spectrum"]));
        read.problems.keep(covered.map(|()| target))
    }

    /// The values, with the path of the table that they name.
    pub(crate) fn located(&self, files: &Files) -> Result<Words, Problems> {
        let mut words = self.words();
        if let Some(name) = &self.spectrum {
            let path = files.path(&name.text());
            let path = path.map_err(|problem| problem.named("spectrum"))?;
            words.set("spectrum", path.to_string_lossy());
        }
        Ok(words)
    }

    /// The code whose formula gives the periods of buildings.
    pub fn period_code(&self) -> Option<PeriodCode> {
        period_code(&self.words())
    }

    /// Whether any of these values was given.
    pub fn is_given(&self) -> bool {
        !self.words().is_empty()
    }

    /// The table that is named.
    pub fn inputs(&self, files: &Files) -> Vec<PathBuf> {
        files.path_of(self.spectrum.as_ref()).into_iter().collect()
    }
}
