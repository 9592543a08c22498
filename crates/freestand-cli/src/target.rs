//! Flags that describe a spectrum: that of a code, or a table of the user's.

use std::path::{Path, PathBuf};

use clap::Args;
use freestand_input::keys::KeyStyle;
use freestand_study::target::{Target, TargetWords};
use serde::Serialize;

use crate::failure::Failure;

const AS: &str = "AS 1170.4 and NZS 1170.5";
const EC8: &str = "Eurocode 8";
const ASCE: &str = "ASCE 7";
const TABLE: &str = "A table of your own";

/// A spectrum; every flag is text here, so that all that is wrong is said at once.
#[derive(Debug, Args)]
#[command(next_help_heading = "The code")]
pub(crate) struct TargetArgs {
    /// The code: as1170.4, eurocode8, asce7, nzs1170.5 [default: as1170.4, or a table with --spectrum]
    #[arg(long, value_name = "CODE")]
    code: Option<String>,
    /// Edition: of AS 1170.4 2007 (with its amendments to 2018) or 2024 (not confirmed), of ASCE 7 2022 or 2016 [default: the first]
    #[arg(long, value_name = "YEAR", allow_hyphen_values = true)]
    edition: Option<String>,
    /// Site class Ae to Ee [default: De]; ground type A to E of Eurocode 8; subsoil class A to E of NZS 1170.5
    #[arg(long, value_name = "CLASS")]
    site: Option<String>,
    /// Hazard factor Z
    #[arg(long, value_name = "RATIO", allow_hyphen_values = true, help_heading = AS)]
    hazard_factor: Option<String>,
    /// Place of the table of AS 1170.4 [default: Melbourne]
    #[arg(long, value_name = "NAME", help_heading = AS)]
    city: Option<String>,
    /// Return period in years [default: 500]
    #[arg(long, value_name = "YEARS", allow_hyphen_values = true, help_heading = AS)]
    return_period: Option<String>,
    /// Distance to the nearest major fault, for N(T, D) of NZS 1170.5 [default: none is near]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true, help_heading = AS)]
    fault_distance: Option<String>,
    /// Type of spectrum: 1, or 2 where magnitudes stay below 5.5
    #[arg(long, value_name = "1|2", allow_hyphen_values = true, help_heading = EC8)]
    spectrum_type: Option<String>,
    /// Reference ground acceleration on rock, a_gR
    #[arg(long, value_name = "ACCELERATION", allow_hyphen_values = true, help_heading = EC8)]
    ground_acceleration: Option<String>,
    /// Importance factor [default: 1]
    #[arg(long, value_name = "RATIO", allow_hyphen_values = true, help_heading = EC8)]
    importance_factor: Option<String>,
    /// Soil factor S of a national annex [default: as recommended for the ground type]
    #[arg(long, value_name = "RATIO", allow_hyphen_values = true, help_heading = EC8)]
    soil_factor: Option<String>,
    /// TB, TC and TD of a national annex, such as "0.15 s, 0.5 s, 2 s" [default: as recommended]
    #[arg(long, value_name = "LIST", allow_hyphen_values = true, help_heading = EC8)]
    corner_periods: Option<String>,
    /// Design acceleration at short periods
    #[arg(long, value_name = "ACCELERATION", allow_hyphen_values = true, help_heading = ASCE)]
    sds: Option<String>,
    /// Design acceleration at 1 s
    #[arg(long, value_name = "ACCELERATION", allow_hyphen_values = true, help_heading = ASCE)]
    sd1: Option<String>,
    /// Mapped acceleration at short periods, in place of --sds
    #[arg(long, value_name = "ACCELERATION", allow_hyphen_values = true, help_heading = ASCE)]
    ss: Option<String>,
    /// Mapped acceleration at 1 s, in place of --sd1
    #[arg(long, value_name = "ACCELERATION", allow_hyphen_values = true, help_heading = ASCE)]
    s1: Option<String>,
    /// Site coefficient of --ss
    #[arg(long, value_name = "RATIO", allow_hyphen_values = true, help_heading = ASCE)]
    fa: Option<String>,
    /// Site coefficient of --s1
    #[arg(long, value_name = "RATIO", allow_hyphen_values = true, help_heading = ASCE)]
    fv: Option<String>,
    /// Long-period transition TL
    #[arg(long, value_name = "TIME", allow_hyphen_values = true, help_heading = ASCE)]
    long_period: Option<String>,
    /// Periods and pseudo-accelerations at 5 % damping, in columns with units in their headings
    #[arg(long, value_name = "FILE", help_heading = TABLE)]
    spectrum: Option<PathBuf>,
    /// Between the periods: log-log or linear [default: log-log]
    #[arg(long, value_name = "HOW", help_heading = TABLE)]
    interpolation: Option<String>,
    /// Outside of them: refuse, or hold (constant Sa below, constant displacement beyond) [default: refuse]
    #[arg(long, value_name = "HOW", help_heading = TABLE)]
    beyond: Option<String>,
}

impl TargetArgs {
    /// The spectrum.
    pub(crate) fn target(&self) -> Result<Target, Failure> {
        let wrong = |problems: Vec<freestand_study::target::TargetProblem>| {
            Failure::Problems(problems.into_iter().map(|problem| problem.problem).collect())
        };
        Target::resolve(&self.words(), Path::new("")).map_err(wrong)
    }

    /// The spectrum, which must have all the periods that motions are matched at.
    pub(crate) fn matched_target(&self) -> Result<Target, Failure> {
        let target = self.target()?;
        target.check_matched_band(&self.words().example("beyond", "hold"))?;
        Ok(target)
    }

    /// Whether any of these flags was given.
    pub(crate) fn is_given(&self) -> bool {
        self.words() != TargetWords::new(KeyStyle::Flag)
    }

    fn words(&self) -> TargetWords {
        let mut words = TargetWords::new(KeyStyle::Flag);
        let texts = [
            ("code", &self.code),
            ("edition", &self.edition),
            ("site", &self.site),
            ("city", &self.city),
            ("hazard_factor", &self.hazard_factor),
            ("return_period_years", &self.return_period),
            ("spectrum_type", &self.spectrum_type),
            ("ground_acceleration", &self.ground_acceleration),
            ("importance_factor", &self.importance_factor),
            ("soil_factor", &self.soil_factor),
            ("corner_periods", &self.corner_periods),
            ("sds", &self.sds),
            ("sd1", &self.sd1),
            ("ss", &self.ss),
            ("s1", &self.s1),
            ("fa", &self.fa),
            ("fv", &self.fv),
            ("long_period", &self.long_period),
            ("fault_distance", &self.fault_distance),
            ("interpolation", &self.interpolation),
            ("beyond", &self.beyond),
        ];
        for (key, text) in texts {
            if let Some(text) = text {
                words.set(key, text.clone());
            }
        }
        if let Some(path) = &self.spectrum {
            words.set("spectrum", path.display().to_string());
        }
        words
    }

    /// The file that these flags name.
    pub(crate) fn inputs(&self) -> impl Iterator<Item = &PathBuf> {
        self.spectrum.iter()
    }
}

/// What a report says of a spectrum. What a code does not have is null.
#[derive(Debug, Serialize)]
pub(crate) struct TargetReport {
    code: &'static str,
    site: Option<&'static str>,
    hazard_factor: Option<f64>,
    return_period_years: Option<u32>,
    kpz_g: Option<f64>,
    minimum_kpz_governs: Option<bool>,
    facts: serde_json::Value,
}

impl From<&Target> for TargetReport {
    fn from(target: &Target) -> Self {
        Self {
            code: target.spectrum.name(),
            site: target.spectrum.site_name(),
            hazard_factor: target.hazard_factor(),
            return_period_years: target.spectrum.return_period_years(),
            kpz_g: target.kpz_g(),
            minimum_kpz_governs: target.minimum_kpz_governs(),
            facts: freestand_study::summary::fact_list(target),
        }
    }
}

#[cfg(test)]
mod tests {
    use clap::Parser;
    use freestand_study::target::TARGET_KEYS;

    use super::*;

    #[derive(Parser)]
    struct Flags {
        #[command(flatten)]
        target: TargetArgs,
    }

    /// A word that has no flag, or a flag that is read and then forgotten, would be no part of any spectrum.
    #[test]
    fn every_word_of_a_spectrum_has_its_flag() {
        let words = TargetWords::new(KeyStyle::Flag);
        for key in TARGET_KEYS {
            let flags = Flags::try_parse_from(["freestand", &words.name(key), "7"]).unwrap();
            let mut expected = words.clone();
            expected.set(key, "7");
            assert_eq!(flags.target.words(), expected);
        }
    }
}
