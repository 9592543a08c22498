//! Files of seismic hazard that people download: how often ground motion is exceeded, spectra at return
//! periods, and the values of design codes. The format is recognised by its content.
//!
//! ```text
//! sites, numbers <- table <- openquake, usgs, national      usgs <- design      sites, numbers <- nrml, geotiff
//! ```

mod design;
mod geotiff;
mod national;
mod nrml;
mod numbers;
mod openquake;
mod sites;
mod table;
mod usgs;

use std::path::Path;

use freestand_input::file::load_up_to;
use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;
use freestand_input::words::number;

pub use national::{NTC_YEARS, TsRow};
pub use openquake::AVERAGE_KEY;
pub use sites::{Coordinates, FARTHEST_KM, Wanted};

/// Longest hazard file \[bytes\]: a map of the whole Earth in steps of 0.05° is 207 MB.
const MAX_BYTES: u64 = 1 << 30;

/// The formats.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum HazardFormat {
    /// `hazard_curve-*.csv` of OpenQuake.
    OpenquakeCurves,
    /// `hazard_uhs-*.csv` of OpenQuake.
    OpenquakeSpectra,
    /// `hazard_map-*.csv` of OpenQuake.
    OpenquakeMap,
    /// A table of one site by measure and probability: AELO of GEM.
    Aelo,
    /// `curves.csv` of nshmp-haz, USGS.
    UsgsCurves,
    /// Hazard curves of a web service of USGS, JSON.
    UsgsCurvesJson,
    /// Design values of a web service of USGS, JSON.
    UsgsDesign,
    /// XML of EFEHR or of OpenQuake: NRML.
    Nrml,
    /// A map of GEM.
    Geotiff,
    /// The grid of AFAD.
    Afad,
    /// Annex B of NTC 2008.
    Ntc,
    /// Table 3.1 of TS 1170.5:2025.
    Ts1170_5,
}

impl HazardFormat {
    /// The name in outputs.
    pub fn name(self) -> &'static str {
        match self {
            Self::OpenquakeCurves => "OpenQuake hazard curves",
            Self::OpenquakeSpectra => "OpenQuake uniform hazard spectra",
            Self::OpenquakeMap => "OpenQuake hazard map",
            Self::Aelo => "AELO spectra",
            Self::UsgsCurves => "USGS nshmp-haz curves",
            Self::UsgsCurvesJson => "USGS hazard curves",
            Self::UsgsDesign => "USGS design values",
            Self::Nrml => "NRML (EFEHR)",
            Self::Geotiff => "GeoTIFF map",
            Self::Afad => "AFAD grid (TBDY 2018)",
            Self::Ntc => "NTC grid, annex B",
            Self::Ts1170_5 => "TS 1170.5:2025, Table 3.1",
        }
    }
}

/// How strong ground motion is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum GroundMeasure {
    /// Peak ground acceleration \[g\].
    Pga,
    /// Peak ground velocity \[m/s\].
    Pgv,
    /// Spectral acceleration, 5 % damping \[g\].
    Sa {
        /// Its period \[s\].
        period_s: f64,
    },
    /// Mean of spectral accelerations over periods \[g\].
    SaAverage {
        /// The shortest period \[s\].
        from_s: f64,
        /// The longest period \[s\].
        to_s: f64,
    },
}

impl GroundMeasure {
    /// The period of a spectrum at which it stands: 0 for the peak acceleration \[s\].
    fn period_s(self) -> Option<f64> {
        match self {
            Self::Pga => Some(0.0),
            Self::Sa { period_s } => Some(period_s),
            Self::Pgv | Self::SaAverage { .. } => None,
        }
    }
}

/// A hazard curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Its measure.
    pub measure: GroundMeasure,
    /// Intensities, which rise, with their annual rates of exceedance, which fall.
    pub points: Vec<(f64, f64)>,
    /// Points left out because their probability is 1.
    pub certain: usize,
    /// Points left out because a stronger motion is as frequent.
    pub equal: usize,
}

impl Curve {
    /// The intensity with a return period, log–log between two points; `None` outside of them.
    fn intensity_at(&self, years: f64) -> Option<f64> {
        let rate = years.recip();
        let between = self
            .points
            .windows(2)
            .find(|pair| pair[0].1 >= rate && rate >= pair[1].1)?;
        let [(x0, r0), (x1, r1)] = [between[0], between[1]];
        let share = (rate / r0).ln() / (r1 / r0).ln();
        Some(x0 * (x1 / x0).powf(share))
    }
}

/// A spectrum, 5 % damping, or a peak acceleration alone.
#[derive(Debug, Clone, PartialEq)]
pub struct ReturnSpectrum {
    /// Its return period \[years\]; `None` for a design spectrum, which has none.
    pub years: Option<f64>,
    /// Periods, which rise, each with its spectral acceleration; 0 is the peak acceleration \[s, g\].
    pub values: Vec<(f64, f64)>,
}

/// The values of a design code at a site.
#[derive(Debug, Clone, PartialEq)]
pub enum CodeValues {
    /// ASCE 7, class B/C.
    Asce7 {
        /// Ss \[g\].
        ss_g: f64,
        /// S1 \[g\].
        s1_g: f64,
        /// The long-period transition TL \[s\], where the file has it.
        long_period_s: Option<f64>,
        /// The site class for which the file was asked, without what it adds of a default or an estimate.
        site_class: Option<String>,
    },
    /// TBDY 2018, Vs30 760 m/s, by level: DD-2 (475 years), DD-1 (2475 years).
    Tbdy2018 {
        /// Ss \[g\].
        ss_g: [f64; 2],
        /// S1 \[g\].
        s1_g: [f64; 2],
    },
    /// The grid of NTC 2018.
    Ntc2018,
    /// TS 1170.5:2025.
    Ts1170_5(Vec<TsRow>),
}

/// Which of the results of a hazard model a file is: the branches of its logic trees are its realizations.
#[derive(Debug, Clone, PartialEq)]
pub enum Statistic {
    /// The mean over the realizations.
    Mean,
    /// A quantile of them, between 0 and 1.
    Quantile(f64),
    /// One of them.
    Realization,
    /// Another, as the file calls it.
    Other(String),
}

// A quantile is never NaN.
impl Eq for Statistic {}

impl Statistic {
    /// As OpenQuake writes it: `mean`, `quantile-0.95`, `rlz-001`.
    fn of(kind: &str) -> Self {
        let lower = kind.to_ascii_lowercase();
        let known = match lower.split_once('-') {
            None => (lower == "mean").then_some(Self::Mean),
            Some(("quantile", value)) => Self::quantile(value),
            Some(("rlz", _)) => Some(Self::Realization),
            Some(_) => None,
        };
        known.unwrap_or_else(|| Self::Other(kind.to_owned()))
    }

    /// `None` for what is not between 0 and 1.
    fn quantile(value: &str) -> Option<Self> {
        let value: f64 = value.trim().parse().ok()?;
        (value > 0.0 && value < 1.0).then_some(Self::Quantile(value))
    }

    /// The name in outputs.
    pub fn name(&self) -> String {
        match self {
            Self::Mean => "mean".to_owned(),
            // Up to 99.9999 %, so that no quantile is 100 %.
            Self::Quantile(value) => format!("{} % quantile", number(100.0 * value, 6)),
            Self::Realization => "one realization".to_owned(),
            Self::Other(kind) => format!("\"{}\"", shorten(kind)),
        }
    }

    /// Its name in a sentence: `the 95 % quantile`.
    pub fn name_with_article(&self) -> String {
        match self {
            Self::Mean | Self::Quantile(_) => format!("the {}", self.name()),
            Self::Realization | Self::Other(_) => self.name(),
        }
    }
}

/// What a file has for one site.
#[derive(Debug, Clone, PartialEq)]
pub struct SiteHazard {
    /// The format of the file.
    pub format: HazardFormat,
    /// Which of the results of its hazard model it is, if the file says so.
    pub statistic: Option<Statistic>,
    /// Number of sites in the file.
    pub sites: usize,
    /// The name of the site in the file.
    pub name: Option<String>,
    /// Where it is.
    pub at: Option<Coordinates>,
    /// From the coordinates that were asked for to it \[km\].
    pub distance_km: Option<f64>,
    /// The curves of a file that has curves.
    pub curves: Vec<Curve>,
    /// Its spectra.
    pub spectra: Vec<ReturnSpectrum>,
    /// Its values by a code.
    pub code: Option<CodeValues>,
}

/// Return periods that differ by less than this share are equal: a probability of 0.002105 in a year is
/// 475.06 years as 1/p and 474.56 as −1/ln(1−p), and 0.02 in 50 years 2474.9.
const SAME_YEARS: f64 = 0.005;

impl SiteHazard {
    fn of(format: HazardFormat) -> Self {
        Self {
            format,
            statistic: None,
            sites: 1,
            name: None,
            at: None,
            distance_km: None,
            curves: Vec::new(),
            spectra: Vec::new(),
            code: None,
        }
    }

    /// What it is in place of the mean of its hazard model; `None`: the mean, or the file does not say.
    pub fn other_than_mean(&self) -> Option<&Statistic> {
        self.statistic
            .as_ref()
            .filter(|statistic| **statistic != Statistic::Mean)
    }

    /// The return periods of its spectra \[years\].
    pub fn return_periods(&self) -> Vec<f64> {
        self.spectra.iter().filter_map(|one| one.years).collect()
    }

    /// The spectrum at a return period, or the only one; of curves of several measures, the intensities with
    /// that return period.
    ///
    /// # Errors
    /// A return period that the file does not have, or none where it has several.
    pub fn spectrum(&self, years: Option<f64>) -> Result<ReturnSpectrum, Problem> {
        let known: Vec<String> = self
            .return_periods()
            .into_iter()
            .map(|years| format!("{years:.0}"))
            .collect();
        let is_it = |one: &&ReturnSpectrum| match (one.years, years) {
            (Some(one), Some(wanted)) => (one / wanted - 1.0).abs() < SAME_YEARS,
            (None, Some(_)) => false,
            (_, None) => true,
        };
        let found: Vec<&ReturnSpectrum> = self.spectra.iter().filter(is_it).collect();
        let problem = |message: String, hint: String| {
            Err(Problem::value(message, hint).of(&["return_period_years"]))
        };
        match (found.as_slice(), years) {
            ([one], _) => Ok((*one).clone()),
            ([], Some(_)) if self.spectra.iter().any(|one| one.years.is_none()) => problem(
                "the spectrum of this file is that of a code, and has no return period".to_owned(),
                "leave `return_period_years` out".to_owned(),
            ),
            ([], Some(wanted)) if !known.is_empty() => problem(
                format!("the file has no spectrum at {wanted} years"),
                format!("it has {} years", known.join(", ")),
            ),
            ([_, _, ..], _) => problem(
                format!("the file has spectra at {} years", known.join(", ")),
                format!("name one: `return_period_years = {}`", known[0]),
            ),
            ([], None) => problem(
                "the file has hazard curves, and a spectrum needs a return period".to_owned(),
                "give it in years, such as `return_period_years = 475`".to_owned(),
            ),
            ([], Some(wanted)) => self.spectrum_of_curves(wanted),
        }
    }

    /// Its curves; of a file of spectra those through them, one for each period that all of them have.
    ///
    /// # Errors
    /// Spectra whose values do not rise with the return period.
    pub fn hazard_curves(&self) -> Result<Vec<Curve>, Problem> {
        if !self.curves.is_empty() {
            return Ok(self.curves.clone());
        }
        let mut levels: Vec<(f64, &ReturnSpectrum)> = self
            .spectra
            .iter()
            .filter_map(|one| Some((one.years?, one)))
            .collect();
        levels.sort_by(|a, b| a.0.total_cmp(&b.0));
        let [(_, first), _, ..] = levels[..] else {
            return Ok(Vec::new());
        };
        let of_period = |&(period_s, _): &(f64, f64)| {
            let points = levels.iter().map(|(years, one)| {
                let value = one.values.iter().find(|value| value.0 == period_s)?;
                Some((*years, value.1))
            });
            let points: Vec<(f64, numbers::Value)> = points
                .map(|point| point.map(|(years, number)| (years, numbers::at_years(years, number))))
                .collect::<Option<_>>()?;
            let measure = match period_s {
                0.0 => GroundMeasure::Pga,
                _ => GroundMeasure::Sa { period_s },
            };
            Some(numbers::at_return_periods(measure, 1.0, points))
        };
        first.values.iter().filter_map(of_period).collect()
    }

    fn spectrum_of_curves(&self, years: f64) -> Result<ReturnSpectrum, Problem> {
        let mut values = Vec::new();
        for curve in &self.curves {
            let Some(period_s) = curve.measure.period_s() else {
                continue;
            };
            let Some(intensity) = curve.intensity_at(years) else {
                let end = |point: Option<&(f64, f64)>| point.map_or(f64::NAN, |one| one.1.recip());
                let (first, last) = (end(curve.points.first()), end(curve.points.last()));
                let [years, first, last] = [years, first, last].map(|one| number(one, 4));
                let message = format!(
                    "a hazard curve of the file does not reach {years} years: it has {first} to {last} years"
                );
                return Err(
                    Problem::value(message, "choose a return period within the curve")
                        .of(&["return_period_years"]),
                );
            };
            values.push((period_s, intensity));
        }
        values.sort_by(|a, b| a.0.total_cmp(&b.0));
        if values.is_empty() {
            return Err(Problem::value(
                "the file has no acceleration, of which a spectrum consists",
                "give a file with PGA or spectral accelerations",
            ));
        }
        Ok(ReturnSpectrum {
            years: Some(years),
            values,
        })
    }
}

/// The format of a hazard file; `None` for anything else.
pub fn recognised(bytes: &[u8]) -> Option<HazardFormat> {
    let start = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    let start = start.trim_ascii_start();
    match start {
        [b'I', b'I', 42 | 43, 0, ..] | [b'M', b'M', 0, 42 | 43, ..] => Some(HazardFormat::Geotiff),
        [b'<', ..] => nrml::is_it(start).then_some(HazardFormat::Nrml),
        [b'{' | b'[', ..] => usgs::json_format(start),
        _ => table::Table::head(start).and_then(|head| {
            openquake::format_of(&head)
                .or_else(|| national::format_of(&head))
                .or_else(|| usgs::is_table(&head).then_some(HazardFormat::UsgsCurves))
        }),
    }
}

/// Reads the bytes of a file of hazard.
///
/// # Errors
/// A file that cannot be read or is longer than 1 GiB.
pub fn load_hazard(path: &Path) -> Result<Vec<u8>, Problem> {
    load_up_to(
        path,
        MAX_BYTES,
        "is longer than 1 GiB; a hazard curve or a spectrum is expected",
        "cut the region that you need out of it",
    )
}

/// What a hazard file has for one of its sites; the path tells the measure of curves of nshmp-haz and of
/// maps, which have it in their name alone.
///
/// # Errors
/// A format that is not known or a damaged file; a site that is not in it, or several of which none is
/// named; values that no hazard has.
///
/// # Example
/// ```
/// use freestand_records::tables::hazard::{GroundMeasure, Wanted, read_hazard};
/// let text = b"#,,,\"kind='mean', investigation_time=50.0, imt='PGA'\"\nlon,lat,depth,poe-0.1,poe-0.2\n\
///              28.97,41.01,0.0,0.1,0.02\n";
/// let site = read_hazard(text, "curves.csv".as_ref(), &Wanted::default())?;
/// assert_eq!(site.curves[0].measure, GroundMeasure::Pga);
/// assert!((site.curves[0].points[0].1 - 1.0 / 474.56).abs() < 1e-8); // 10 % in 50 years
/// # Ok::<(), freestand_input::problem::Problem>(())
/// ```
pub fn read_hazard(bytes: &[u8], path: &Path, wanted: &Wanted) -> Result<SiteHazard, Problem> {
    let text = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    let found = match recognised(bytes) {
        None => Err(Problem::format(
            "is not a hazard file of a known format",
            "give a curve, a uniform hazard spectrum or a map of OpenQuake, curves or design values of USGS, XML of \
             EFEHR, the grid of AFAD or NTC, or Table 3.1 of TS 1170.5",
        )),
        Some(HazardFormat::Geotiff) => geotiff::read(bytes, path, wanted),
        Some(HazardFormat::Nrml) => nrml::read(text, wanted),
        Some(HazardFormat::UsgsCurvesJson) => usgs::curves_json(text, wanted),
        Some(HazardFormat::UsgsDesign) => design::read(text, wanted),
        Some(format) => table::Table::read(text).and_then(|table| match format {
            HazardFormat::UsgsCurves => usgs::curves_table(&table, path, wanted),
            HazardFormat::Afad => national::afad(&table, wanted),
            HazardFormat::Ntc => national::ntc(&table, wanted),
            HazardFormat::Ts1170_5 => national::ts1170_5(&table, wanted),
            _ => openquake::read(&table, path, format, wanted),
        }),
    };
    found.map_err(|problem| problem.in_file(path))
}

#[cfg(test)]
mod tests;
