//! Flags that describe a target: the spectrum of a code, or a table of the user.

use std::path::{Path, PathBuf};

use clap::Args;
use freestand::code_spectrum::PeriodCode;
use freestand_study::target::{Target, period_code};

use crate::failure::Failure;
use crate::keys::{Key, KeySet, Keys, key};

/// Flags that describe a target: the spectrum of a code, or a table of the user.
#[derive(Debug, Args)]
pub(crate) struct TargetArgs {
    #[command(flatten)]
    keys: Keys<TargetKeys>,
}

#[derive(Debug, Clone)]
struct TargetKeys;

impl KeySet for TargetKeys {
    const KEYS: &'static [(&'static str, &'static [Key])] = &[
        (
            "The code",
            &[
                key(
                    "code",
                    "CODE",
                    "Design code: as1170.4, eurocode8, asce7, nzs1170.5 [default: as1170.4, or the table of \
                     --spectrum]",
                ),
                key(
                    "edition",
                    "YEAR",
                    "Edition: 2007 (amended to 2018) or 2024 (unconfirmed) of AS 1170.4, 2022 or 2016 of ASCE 7 \
                     [default: the first]",
                ),
                key(
                    "site",
                    "CLASS",
                    "Site: class Ae to Ee of AS 1170.4 [default: De], ground type A to E of Eurocode 8, \
                     subsoil class A to E of NZS 1170.5, site class A to E of ASCE 7",
                ),
                key(
                    "place",
                    "NAME",
                    "Place whose hazard is used, with its code: freestand place list [default: Melbourne]",
                ),
            ],
        ),
        (
            "AS 1170.4 and NZS 1170.5",
            &[
                key(
                    "hazard_factor",
                    "RATIO",
                    "Hazard factor Z [default: that of the place]",
                ),
                key("city", "NAME", "Another name of --place"),
                key(
                    "return_period_years",
                    "YEARS",
                    "Return period in years [default: 500]",
                ),
                key(
                    "fault_distance",
                    "LENGTH",
                    "Distance to the nearest major fault, for N(T, D) of NZS 1170.5 [default: no fault nearby]",
                ),
            ],
        ),
        (
            "Eurocode 8",
            &[
                key(
                    "spectrum_type",
                    "1|2",
                    "Type of spectrum: 1, or 2 if magnitudes stay below 5.5",
                ),
                key(
                    "ground_acceleration",
                    "ACCELERATION",
                    "Reference ground acceleration on rock, a_gR",
                ),
                key(
                    "importance_factor",
                    "RATIO",
                    "Importance factor [default: 1]",
                ),
                key(
                    "soil_factor",
                    "RATIO",
                    "Soil factor S of a national annex [default: as recommended for the ground type]",
                ),
                key(
                    "corner_periods",
                    "LIST",
                    "TB, TC and TD of a national annex, such as \"0.15 s, 0.5 s, 2 s\" [default: as recommended]",
                ),
            ],
        ),
        (
            "ASCE 7",
            &[
                key(
                    "sds",
                    "ACCELERATION",
                    "Design acceleration at short periods",
                ),
                key("sd1", "ACCELERATION", "Design acceleration at 1 s"),
                key(
                    "ss",
                    "ACCELERATION",
                    "Mapped acceleration at short periods, instead of --sds",
                ),
                key(
                    "s1",
                    "ACCELERATION",
                    "Mapped acceleration at 1 s, instead of --sd1",
                ),
                key(
                    "fa",
                    "RATIO",
                    "Site coefficient of --ss [default: that of --site]",
                ),
                key(
                    "fv",
                    "RATIO",
                    "Site coefficient of --s1 [default: that of --site]",
                ),
                key(
                    "long_period",
                    "TIME",
                    "Long-period transition TL [default with --place: 8 s]",
                ),
            ],
        ),
        (
            "A table of your own",
            &[
                key(
                    "spectrum",
                    "FILE",
                    "Periods and pseudo-accelerations at 5 % damping, in columns with units in their headings",
                ),
                key(
                    "interpolation",
                    "HOW",
                    "How to interpolate between periods: log-log or linear [default: log-log]",
                ),
                key(
                    "beyond",
                    "HOW",
                    "Outside the periods of the table: refuse, or hold (constant Sa below, constant displacement \
                     above) [default: refuse]",
                ),
            ],
        ),
    ];
}

impl TargetArgs {
    /// The target.
    pub(crate) fn target(&self) -> Result<Target, Failure> {
        Ok(Target::resolve(&self.keys.words, Path::new(""))?)
    }

    /// The target, which must cover all periods at which motions are matched.
    pub(crate) fn matched_target(&self) -> Result<Target, Failure> {
        let target = self.target()?;
        target.check_matched_band()?;
        Ok(target)
    }

    /// The code whose formula gives the periods of buildings.
    pub(crate) fn period_code(&self) -> Option<PeriodCode> {
        period_code(&self.keys.words)
    }

    /// Whether any of these flags was given.
    pub(crate) fn is_given(&self) -> bool {
        !self.keys.words.is_empty()
    }

    /// The file that `--spectrum` names.
    pub(crate) fn inputs(&self) -> Vec<PathBuf> {
        self.keys
            .words
            .get("spectrum")
            .map(PathBuf::from)
            .into_iter()
            .collect()
    }
}
