//! Suites of records for a study: selected from a folder by the core's [`freestand::suite`].

use std::path::PathBuf;

use freestand::G0_M_S2;
use freestand::oscillator::{DAMPING_RATIO, response_spectrum};
use freestand::suite::{
    Candidate, FACTOR_LIMITS, SuiteError, SuiteScale, select_suite, suite_periods_s,
};
use freestand_input::words::{number, some};
use freestand_output::answer_of;
use freestand_records::horizontal::HorizontalMotion;
use strum::EnumCount;

use crate::target::Target;

/// Largest number of files in the folder of a suite.
pub const MAX_FILES: usize = 2000;
/// Largest number of records in a suite where the study does not say how many: so many without an
/// event show that its probability is below 10 % (Clopper–Pearson, 98 %: 1 − 0.01^(1/44) = 0.0994).
pub const DEFAULT_MOST: usize = 44;
/// Periods of a suite where no building filters its motions \[s\].
pub const GROUND_PERIODS_S: (f64, f64) = (0.2, 3.0);
/// Periods of a suite below and above that of the building.
pub const BUILDING_PERIODS_RATIO: (f64, f64) = (0.2, 2.0);
/// Root mean square difference from the asked mean or standard deviation of ln Sa above which a
/// suite is worth a warning: 10 %, as much as ASCE 7-16, 16.2.3.2, lets the mean of scaled records
/// fall below their target.
const FAR_LN: f64 = 0.1;

/// The default of `suite_scale`.
pub const DEFAULT_SCALE: SuiteScale = SuiteScale::Each;

/// A file that is not in a suite because it cannot be.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LeftOut {
    /// Its name.
    pub file: String,
    /// Why.
    pub reason: String,
}

/// Something that the reader of results with a suite must know.
#[derive(Debug, Clone, PartialEq, EnumCount)]
pub enum SuiteDoubt {
    /// Files that cannot be used.
    LeftOut(Vec<LeftOut>),
    /// The mean is far from the target.
    MeanOff(MeanOff),
    /// The standard deviation is far from the one that was asked for.
    Dispersion(Dispersion),
}

/// How far the mean of ln Sa is from ln of the target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeanOff {
    /// Root mean square over the periods.
    pub rms: f64,
    /// At the worst of them.
    pub worst_ln: f64,
}

/// The standard deviation of ln Sa.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dispersion {
    /// Root mean square over the periods.
    pub rms: f64,
    /// The least.
    pub least: f64,
    /// The most.
    pub most: f64,
    /// The one that was asked for.
    pub asked: f64,
}

/// How many files a sentence names.
pub const NAMED: usize = 5;

/// The first few files that are left out, with their reasons.
pub fn some_left_out(files: &[LeftOut]) -> String {
    let named: Vec<String> = files
        .iter()
        .map(|one| format!("{}: {}", one.file, one.reason))
        .collect();
    some(&named, NAMED)
}

/// How the motions of a study were selected, and what they reach.
#[derive(Debug, Clone, PartialEq)]
pub struct Suite {
    /// The folder.
    pub folder: PathBuf,
    /// The spectrum that they are to have in the mean.
    pub target: Target,
    /// How they are scaled.
    pub scale: SuiteScale,
    /// The periods at which spectra are compared \[s\].
    pub periods_s: Vec<f64>,
    /// Where the first and the last period come from.
    pub periods_from: String,
    /// Number of records that could have been selected.
    pub usable: usize,
    /// The records: name and factor.
    pub members: Vec<(String, f64)>,
    /// Mean of ln Sa over all components, less ln of the target, at each period.
    pub mean_ln_ratio: Vec<f64>,
    /// Standard deviation of ln Sa over all components, at each period.
    pub sd_ln: Vec<f64>,
    /// Files and records of the folder that cannot be used.
    pub left_out: Vec<LeftOut>,
    /// Files of the folder that are not horizontal motions.
    pub skipped: Vec<String>,
}

/// The range of periods in which a suite is compared with its target.
#[derive(Debug, Clone, PartialEq)]
pub struct PeriodRange {
    /// The shortest \[s\].
    pub from_s: f64,
    /// The longest \[s\].
    pub to_s: f64,
    /// Where they come from.
    pub from: String,
}

impl PeriodRange {
    /// For motions that pass through a building with these periods, the shortest and the longest of
    /// its axes \[s\]; without them, for motions of the ground.
    pub fn new(building_s: Option<(f64, f64)>) -> Self {
        let Some((shortest_s, longest_s)) = building_s else {
            let (from_s, to_s) = GROUND_PERIODS_S;
            return Self {
                from_s,
                to_s,
                from: "no floor above the ground".to_owned(),
            };
        };
        let (below, above) = BUILDING_PERIODS_RATIO;
        let from = if shortest_s == longest_s {
            format!(
                "{below} and {above} times the building's period of {} s",
                number(longest_s, 4)
            )
        } else {
            let (shortest, longest) = (number(shortest_s, 4), number(longest_s, 4));
            format!(
                "{below} times the building's period of {shortest} s, {above} times that of {longest} s"
            )
        };
        Self {
            from_s: below * shortest_s,
            to_s: above * longest_s,
            from,
        }
    }
}

/// Spectra of a record that a suite may use.
#[derive(Debug, Clone, PartialEq)]
pub struct Spectra {
    /// ln Sa of its components at 5 % damping \[g\].
    ln_sa: Vec<Vec<f64>>,
}

/// A record that could be selected.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    /// Its name in the outputs.
    pub name: String,
    /// Its spectra.
    pub spectra: Spectra,
}

/// What is asked of a suite.
#[derive(Debug, Clone, PartialEq)]
pub struct Request {
    /// The folder of the records.
    folder: PathBuf,
    /// The spectrum.
    target: Target,
    /// How records are scaled.
    scale: SuiteScale,
    /// Where the periods come from.
    periods_from: String,
    /// The periods at which spectra are compared \[s\].
    periods_s: Vec<f64>,
    /// ln of the target there \[g\].
    ln_target_sa: Vec<f64>,
}

impl Request {
    /// For the records of a folder, a spectrum and the periods at which it counts.
    ///
    /// # Errors
    /// Periods that do not rise from above 0, or a spectrum without a logarithm there.
    pub fn new(
        folder: PathBuf,
        target: Target,
        scale: SuiteScale,
        range: PeriodRange,
    ) -> Result<Self, SuiteError> {
        let periods_s = suite_periods_s(range.from_s, range.to_s)?;
        let ln_target_sa: Vec<f64> = periods_s
            .iter()
            .map(|&period_s| target.spectrum.sa_g(period_s).ln())
            .collect();
        if !ln_target_sa.iter().all(|ln| ln.is_finite()) {
            return Err(SuiteError::Spectrum);
        }
        Ok(Self {
            folder,
            target,
            scale,
            periods_from: range.from,
            periods_s,
            ln_target_sa,
        })
    }

    /// The spectra of the components of a motion.
    ///
    /// # Errors
    /// Why a suite cannot use it: it has no content at some of the periods, or would need a factor of
    /// its own outside [`FACTOR_LIMITS`].
    pub fn spectra(&self, motion: &HorizontalMotion) -> Result<Spectra, String> {
        let one = |motion| -> Result<Vec<f64>, String> {
            let spectrum = response_spectrum(motion, DAMPING_RATIO, &self.periods_s)
                .map_err(|error| error.to_string())?;
            let ln_sa: Vec<f64> = spectrum
                .psa_m_s2
                .iter()
                .map(|psa| (psa / G0_M_S2).ln())
                .collect();
            if ln_sa.iter().all(|ln| ln.is_finite()) {
                Ok(ln_sa)
            } else {
                Err("it has no content at some of the periods".to_owned())
            }
        };
        let ln_sa: Vec<Vec<f64>> = std::iter::once(&motion.along)
            .chain(&motion.across)
            .map(one)
            .collect::<Result<_, _>>()?;
        let off = ln_sa
            .iter()
            .flat_map(|one| self.ln_target_sa.iter().zip(one))
            .map(|(target, ln)| target - ln);
        let factor = (off.sum::<f64>() / (ln_sa.len() * self.periods_s.len()) as f64).exp();
        let (least, most) = FACTOR_LIMITS;
        if self.scale == SuiteScale::Each && !(least..=most).contains(&factor) {
            return Err(format!(
                "it needs a factor of {}, outside {least} to {most}",
                number(factor, 3)
            ));
        }
        Ok(Spectra { ln_sa })
    }
}

/// The suite of `count` records, and which it took: their places and factors.
///
/// # Errors
/// Fewer than two records, or than `count`.
pub fn select(
    request: Request,
    records: &[Record],
    count: usize,
) -> Result<(Suite, Vec<(usize, f64)>), SuiteError> {
    let candidates: Vec<Candidate> = records
        .iter()
        .map(|record| Candidate::new(record.spectra.ln_sa.clone()))
        .collect::<Result<_, _>>()?;
    let selected = select_suite(&candidates, &request.ln_target_sa, count, request.scale)?;
    let chosen: Vec<(usize, f64)> = selected
        .chosen
        .iter()
        .map(|one| (one.candidate, one.factor))
        .collect();
    let member = |&(index, factor): &(usize, f64)| Some((records.get(index)?.name.clone(), factor));
    let suite = Suite {
        members: chosen.iter().filter_map(member).collect(),
        folder: request.folder,
        target: request.target,
        scale: request.scale,
        periods_s: request.periods_s,
        periods_from: request.periods_from,
        usable: candidates.len(),
        mean_ln_ratio: selected.mean_ln_ratio,
        sd_ln: selected.sd_ln,
        left_out: Vec::new(),
        skipped: Vec::new(),
    };
    Ok((suite, chosen))
}

fn rms(values: &[f64]) -> f64 {
    (values.iter().map(|value| value * value).sum::<f64>() / values.len() as f64).sqrt()
}

impl Suite {
    /// Root mean square over the periods of the difference of the mean of ln Sa from ln of the
    /// target.
    pub fn mean_rms(&self) -> f64 {
        rms(&self.mean_ln_ratio)
    }

    /// Root mean square over the periods of the standard deviation of ln Sa.
    pub fn sd_rms(&self) -> f64 {
        rms(&self.sd_ln)
    }

    /// How far the mean is from the target.
    pub fn mean_off(&self) -> MeanOff {
        let worst = |worst: f64, x: &f64| if x.abs() > worst.abs() { *x } else { worst };
        MeanOff {
            rms: self.mean_rms(),
            worst_ln: self.mean_ln_ratio.iter().fold(0.0, worst),
        }
    }

    /// The standard deviation of ln Sa and the one that was asked for.
    pub fn dispersion(&self) -> Dispersion {
        Dispersion {
            rms: self.sd_rms(),
            least: self.sd_ln.iter().copied().fold(f64::INFINITY, f64::min),
            most: self.sd_ln.iter().copied().fold(0.0, f64::max),
            asked: self.scale.dispersion(),
        }
    }

    /// What the reader of the results must know.
    pub fn doubts(&self) -> Vec<SuiteDoubt> {
        let (mean, dispersion) = (self.mean_off(), self.dispersion());
        let left_out = !self.left_out.is_empty();
        let is_far = (dispersion.rms - dispersion.asked).abs() > FAR_LN;
        left_out
            .then(|| SuiteDoubt::LeftOut(self.left_out.clone()))
            .into_iter()
            .chain((mean.rms > FAR_LN).then_some(SuiteDoubt::MeanOff(mean)))
            .chain(is_far.then_some(SuiteDoubt::Dispersion(dispersion)))
            .collect()
    }
}

answer_of!(Suite as suite {
    folder: String = suite.folder.display().to_string();
    /// The spectrum that the records have in the mean.
    target: String = suite.target.one_line();
    scale: &'static str = suite.scale.name();
    count: usize = suite.members.len();
    /// Records that could have been selected.
    usable: usize;
    records: Vec<Member<'_>> = suite.members.iter().map(Member).collect();
    /// At which spectra are compared.
    periods_s: Vec<f64>;
    periods_from: String;
    /// Mean of ln Sa over all components, less ln of the target.
    mean_ln_ratio: Vec<f64>;
    mean_ln_ratio_rms: f64 = suite.mean_rms();
    /// Standard deviation of ln Sa over all components.
    sd_ln: Vec<f64>;
    sd_ln_rms: f64 = suite.sd_rms();
    sd_ln_asked: f64 = suite.scale.dispersion();
    /// Files and records that cannot be used.
    left_out: Vec<&LeftOut> = suite.left_out.iter().collect();
    /// Files that are not horizontal motions.
    skipped: Vec<String>;
});

answer_of!(
    /// A record of a suite.
    struct Member<'s>(&'s (String, f64)) as member {
    motion: String = member.0.0.clone();
    factor: f64 = member.0.1;
});

answer_of!(LeftOut as one {
    file: String;
    reason: String;
});
