//! Hazard curves: from a file, a power law, or the return periods of a code.

use std::path::{Path, PathBuf};

use freestand::code_spectrum::{SiteClass, SubsoilClass, near_fault_ratio, probability_factors, return_period_factors};
use freestand::risk::{Hazard, HazardPoint};
use freestand_input::file::{InputFile, load};
use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::shorten;
use freestand_input::words::{Choices, counted};
use freestand_output::facts::Facts;

use super::number_and_unit;
use crate::fragility::measure::MEASURES;
use crate::fragility::table::Table;
use crate::fragility::{At, Measure};

/// Where the hazard comes from.
#[derive(Debug, Clone, PartialEq)]
pub enum HazardSource {
    /// A CSV of our own or of OpenQuake.
    File(PathBuf),
    /// `k0=1e-4 /yr, k=2.5, reference=1 m/s`, of a measure.
    PowerLaw {
        /// The text.
        text: String,
        /// The measure.
        measure: Measure,
    },
    /// The return periods of a code.
    Code {
        /// The code.
        code: HazardCode,
        /// Site class.
        site: String,
        /// Z.
        hazard_factor: f64,
        /// Distance to a major fault \[km\].
        fault_distance_km: Option<f64>,
        /// `pga` or `sa(T)`.
        measure: Measure,
    },
}

/// What a person gave of the hazard.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct HazardGiven {
    /// A file.
    pub file: Option<PathBuf>,
    /// A power law.
    pub power_law: Option<String>,
    /// A code.
    pub code: Option<HazardCode>,
    /// The measure of the power law or of the code.
    pub measure: Option<Measure>,
    /// Site class of the code.
    pub site: Option<String>,
    /// Z of the code.
    pub hazard_factor: Option<f64>,
    /// Distance to a major fault \[m\].
    pub fault_distance_m: Option<f64>,
}

impl HazardGiven {
    /// Where the hazard comes from.
    ///
    /// # Errors
    /// No source or several, or a source that needs more.
    pub fn source(self) -> Result<HazardSource, Problem> {
        let needed = |key: &'static str, example: &'static str| {
            move || Problem::value(format!("the hazard needs `{key}`"), format!("give `{key}`, such as {example}"))
        };
        match (self.file, self.power_law, self.code) {
            (Some(path), None, None) => Ok(HazardSource::File(path)),
            (None, Some(text), None) => {
                let measure = self.measure.ok_or_else(needed("hazard_im", "pgv"))?;
                Ok(HazardSource::PowerLaw { text, measure })
            }
            (None, None, Some(code)) => Ok(HazardSource::Code {
                code,
                site: self.site.ok_or_else(needed("site", "De"))?,
                hazard_factor: self.hazard_factor.ok_or_else(needed("hazard_factor", "0.12"))?,
                fault_distance_km: self.fault_distance_m.map(|distance_m| distance_m / 1e3),
                measure: self.measure.ok_or_else(needed("hazard_im", "pga"))?,
            }),
            (None, None, None) => Err(Problem::value(
                "there is no hazard curve, which says how often motions reach an intensity",
                "give one of `hazard`, `hazard_power` and `hazard_code`",
            )),
            _ => {
                let message = "`hazard`, `hazard_power` and `hazard_code` exclude each other";
                Err(Problem::value(message, "keep one of them"))
            }
        }
    }
}

/// A code whose return periods are a hazard.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum HazardCode {
    /// AS 1170.4—2007.
    As1170_4,
    /// NZS 1170.5:2004.
    Nzs1170_5,
}

/// Codes by name.
pub const HAZARD_CODES: Choices<HazardCode> = &[
    (HazardCode::As1170_4, "as1170.4", "AS 1170.4, edition 2007: k_p Z C_h(T)"),
    (HazardCode::Nzs1170_5, "nzs1170.5", "NZS 1170.5:2004: R Z C_h(T) N(T, D)"),
];

/// A hazard with its measure.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct MeasuredHazard {
    pub(crate) hazard: Hazard,
    pub(crate) measure: Measure,
    pub(crate) at: At,
    pub(crate) file: Option<InputFile>,
    pub(crate) warnings: Vec<String>,
}

impl MeasuredHazard {
    pub(crate) fn facts(&self) -> Facts<'static> {
        let points: Option<Vec<Facts>> = match &self.hazard {
            Hazard::Points(points) => Some(
                points
                    .iter()
                    .map(|point| Facts::default().key("im", point.intensity).key("annual_rate", point.annual_rate))
                    .collect(),
            ),
            Hazard::PowerLaw { .. } => None,
        };
        let law = match self.hazard {
            Hazard::PowerLaw { rate, reference, exponent } => {
                Some(Facts::default().key("k0", rate).key("k", exponent).key("reference", reference))
            }
            Hazard::Points(_) => None,
        };
        Facts::default()
            .key("im", self.measure.name())
            .key("im_unit", self.measure.unit())
            .key("at", self.at.name())
            .key("points", points)
            .key("power_law", law)
    }
}

/// Reads a hazard; `at` is where a spectral acceleration is taken, `site_deg` the site of an
/// OpenQuake file with several.
pub(crate) fn hazard_of(
    source: &HazardSource,
    at: Option<At>,
    site_deg: Option<(f64, f64)>,
) -> Result<MeasuredHazard, Problems> {
    match source {
        HazardSource::File(path) => Ok(from_file(&load(path)?, path, at, site_deg)?),
        HazardSource::PowerLaw { text, measure } => {
            let hazard = power_law(text, *measure).map_err(|problem| problem.named("hazard_power"))?;
            let at = measure.at(at)?;
            Ok(MeasuredHazard { hazard, measure: *measure, at, file: None, warnings: Vec::new() })
        }
        HazardSource::Code { code, site, hazard_factor, fault_distance_km, measure } => {
            Ok(of_code(*code, site, *hazard_factor, *fault_distance_km, *measure)?)
        }
    }
}

const HINT: &str = "write \"pgv [m/s],annual_rate\" with rising intensities and falling rates, or give a \
                    hazard_curve-*.csv of OpenQuake";

fn from_file(
    bytes: &[u8],
    path: &Path,
    at: Option<At>,
    site_deg: Option<(f64, f64)>,
) -> Result<MeasuredHazard, Problem> {
    let table = Table::read(bytes, path, HINT)?;
    let is_openquake = table.headings.iter().any(|heading| heading.name.starts_with("poe-"));
    let file = Some(InputFile::new(path, bytes));
    if is_openquake {
        return Ok(MeasuredHazard { file, ..openquake(&table, at, site_deg)? });
    }
    let rates = table.needed("annual_rate")?;
    let found = table.headings.iter().enumerate().find_map(|(i, heading)| Some((i, Measure::parse(&heading.name)?)));
    let (column, measure) = found.ok_or_else(|| {
        table
            .header_problem("there is no column with an intensity measure".to_owned())
            .hint(format!("write {MEASURES}"))
    })?;
    let unit = table.headings.get(column).and_then(|heading| heading.unit.as_deref());
    let factor = measure.factor_from(unit).map_err(|problem| table.header_problem(problem.message))?;
    let points = table.rows.iter().map(|row| {
        Ok(HazardPoint { intensity: factor * table.positive(row, column)?, annual_rate: table.positive(row, rates)? })
    });
    let points = points.collect::<Result<Vec<_>, Problem>>()?;
    let hazard =
        Hazard::points(points).map_err(|error| match error.point().and_then(|point| table.rows.get(point - 1)) {
            Some(row) => {
                let is_rate = matches!(error, freestand::risk::HazardError::NotFalling { .. });
                table.cell_problem(row, if is_rate { rates } else { column }, &error.to_string()).hint(HINT)
            }
            None => table.header_problem(error.to_string()),
        })?;
    Ok(MeasuredHazard { hazard, measure, at: measure.at(at)?, file, warnings: Vec::new() })
}

/// A hazard curve of OpenQuake: probabilities of exceedance in an investigation time.
fn openquake(table: &Table, at: Option<At>, site_deg: Option<(f64, f64)>) -> Result<MeasuredHazard, Problem> {
    let comment = table.comments.join(",");
    let stated = |key: &str| {
        let (_, rest) = comment.split_once(&format!("{key}="))?;
        let end = rest.find([',', '"']).unwrap_or(rest.len());
        Some(rest[..end].trim().trim_matches('\'').to_owned())
    };
    let lost = |key: &str| {
        let message = format!("the comment above the headings does not state {key}");
        table.header_problem(message).hint("give the file as OpenQuake wrote it, with its first line")
    };
    let years = stated("investigation_time").and_then(|years| years.parse::<f64>().ok()).filter(|years| *years > 0.0);
    let years = years.ok_or_else(|| lost("investigation_time"))?;
    let imt = stated("imt").ok_or_else(|| lost("imt"))?;
    let (measure, factor) = match imt.as_str() {
        "PGA" => (Measure::Pga, 1.0),
        "PGV" => (Measure::Pgv, 0.01),
        other => match other.starts_with("SA").then(|| Measure::parse(other)).flatten() {
            Some(measure) => (measure, 1.0),
            None => {
                let message = format!("the measure {} is not one of PGA, PGV and SA", shorten(other));
                return Err(table.header_problem(message).hint("export hazard curves of PGA, PGV or SA"));
            }
        },
    };
    let (lon, lat) = (table.needed("lon")?, table.needed("lat")?);
    let mut rows = Vec::new();
    for row in &table.rows {
        let of = |column| table.text(row, column).parse::<f64>().ok();
        // Coordinates are written with five decimals.
        let is_it = site_deg.is_none_or(|site| {
            of(lon).zip(of(lat)).is_some_and(|(lon, lat)| (lon - site.0).abs() < 1e-4 && (lat - site.1).abs() < 1e-4)
        });
        if is_it {
            rows.push(row);
        }
    }
    let [row] = rows.as_slice() else {
        let message = format!("{} of the file match", counted(rows.len(), "site"));
        let hint = "name one site of the file, with `site_coordinates = \"151.2,-33.9\"`";
        return Err(table.header_problem(message).hint(hint));
    };
    let (mut points, mut warnings, mut certain) = (Vec::new(), Vec::new(), 0);
    for (column, heading) in table.headings.iter().enumerate() {
        let Some(level) = heading.name.strip_prefix("poe-") else { continue };
        let level = level.parse::<f64>().ok().filter(|level| *level > 0.0);
        let level =
            level.ok_or_else(|| table.header_problem(format!("\"{}\" states no level", shorten(&heading.name))))?;
        let poe = table.non_negative(row, column)?;
        if poe > 1.0 {
            return Err(table.cell_problem(row, column, "a probability cannot be above 1"));
        }
        if poe == 1.0 {
            certain += 1;
        } else if poe > 0.0 {
            points.push(HazardPoint { intensity: factor * level, annual_rate: -(-poe).ln_1p() / years });
        }
    }
    if certain > 0 {
        warnings.push(format!("{} with a probability of 1 left out: its rate is not known", counted(certain, "level")));
    }
    let hazard = Hazard::points(points).map_err(|error| table.header_problem(error.to_string()))?;
    Ok(MeasuredHazard { hazard, measure, at: measure.at(at)?, file: None, warnings })
}

/// `k0=1e-4 /yr, k=2.5, reference=1 m/s`.
fn power_law(text: &str, measure: Measure) -> Result<Hazard, Problem> {
    let unit = if measure.unit() == "1" { String::new() } else { format!(" {}", measure.unit()) };
    let example = format!("write \"k0=1e-4 /yr, k=2.5, reference=1{unit}\"");
    let bad = |message: String| Problem::value(message, example.clone());
    let (mut rate, mut exponent, mut reference) = (None, None, None);
    let mut seen: Vec<&str> = Vec::new();
    for part in text.split(',') {
        let (key, value) =
            part.split_once('=').ok_or_else(|| bad(format!("\"{}\" is not key=value", shorten(part.trim()))))?;
        let found = number_and_unit(value).filter(|(number, _)| *number > 0.0);
        let (number, unit) =
            found.ok_or_else(|| bad(format!("\"{}\" is not a number above 0", shorten(value.trim()))))?;
        let key = key.trim();
        if seen.contains(&key) {
            return Err(bad(format!("{key} is there twice")));
        }
        seen.push(key);
        match (key, unit) {
            ("k0", "/yr" | "1/yr" | "/year" | "1/year") => rate = Some(number),
            ("k0", _) => return Err(bad("k0 needs the unit /yr".to_owned())),
            ("k", "") => exponent = Some(number),
            ("reference", unit) => {
                let factor = measure.factor_from((!unit.is_empty()).then_some(unit));
                reference = Some(number * factor.map_err(|problem| bad(problem.message))?);
            }
            (other, _) => return Err(bad(format!("\"{}\" is not k0, k or reference", shorten(other)))),
        }
    }
    let missing = |name: &str| bad(format!("{name} is missing"));
    let rate = rate.ok_or_else(|| missing("k0"))?;
    let exponent = exponent.ok_or_else(|| missing("k"))?;
    let reference = reference.ok_or_else(|| missing("reference"))?;
    Hazard::power_law(rate, reference, exponent).map_err(|error| bad(error.to_string()))
}

/// The design accelerations of all return periods, as points (factor·Z·C_h(T), 1/return period).
fn of_code(
    code: HazardCode,
    site: &str,
    hazard_factor: f64,
    fault_distance_km: Option<f64>,
    measure: Measure,
) -> Result<MeasuredHazard, Problem> {
    let period_s = match measure {
        Measure::Pga => 0.0,
        Measure::Sa { period_s } => period_s,
        _ => {
            let message = format!("a code has no {}", measure.name());
            return Err(
                Problem::value(message, "give `hazard_im = \"pga\"` or `hazard_im = \"sa(0.5)\"`").of(&["hazard_im"])
            );
        }
    };
    let class = |error: freestand::code_spectrum::CodeSpectrumError| {
        Problem::value(error.to_string(), "name the class as the code does").named("site")
    };
    let (shape, factors): (f64, &[(u32, f64)]) = match code {
        HazardCode::As1170_4 => {
            (SiteClass::parse(site).map_err(class)?.shape_factor_ratio(period_s), probability_factors())
        }
        HazardCode::Nzs1170_5 => {
            let near = fault_distance_km.map_or(1.0, |km| near_fault_ratio(period_s, km));
            (near * SubsoilClass::parse(site).map_err(class)?.shape_factor_ratio(period_s), return_period_factors())
        }
    };
    let points = factors.iter().map(|&(years, factor)| HazardPoint {
        intensity: factor * hazard_factor * shape,
        annual_rate: 1.0 / f64::from(years),
    });
    let hazard = Hazard::points(points.collect())
        .map_err(|error| Problem::value(error.to_string(), "give a hazard factor above 0").named("hazard_factor"))?;
    let warnings = vec![
        "the rates are those of design accelerations of a code, without its minimum and maximum: they are not a hazard \
         study of the site"
            .to_owned(),
    ];
    Ok(MeasuredHazard { hazard, measure, at: At::Ground, file: None, warnings })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(text: &str) -> Result<MeasuredHazard, Problem> {
        from_file(text.as_bytes(), Path::new("h.csv"), None, None)
    }

    #[test]
    fn points_are_read_and_refused_with_their_cell() {
        let read = file("pgv [cm/s],annual_rate\n5,0.02\n50,0.0002\n").unwrap();
        assert_eq!((read.measure, read.at), (Measure::Pgv, At::Ground));
        assert!((read.hazard.annual_rate(0.05) - 0.02).abs() < 1e-15);
        let cases = [
            ("pgv [m/s],annual_rate\n0.1,0.02\n0.1,0.01\n", "h.csv:3: column 1"),
            ("pgv [m/s],annual_rate\n0.1,0.02\n0.2,0.02\n", "h.csv:3: column 2"),
            ("pgv [m/s],annual_rate\n0.1,0\n0.2,0.02\n", "h.csv:2: column 2"),
            ("pgv [m/s],annual_rate\n0.1,0.02\n", "at least two points"),
            ("pgv [m/s],rate\n0.1,0.02\n", "there is no column \"annual_rate\""),
            ("pgv,annual_rate\n0.1,0.02\n", "pgv has no unit"),
        ];
        for (text, said) in cases {
            let problem = file(text).unwrap_err();
            assert!(problem.to_string().contains(said) && problem.hint.is_some(), "{said}: {problem}");
        }
    }

    const OPENQUAKE: &str = "#,,,,\"generated_by='OpenQuake engine 3.26.2', start_date='2026-01-01T00:00:00', \
                             checksum=1, kind='mean', investigation_time=50.0, imt='PGV'\"\n\
                             lon,lat,depth,poe-1.0,poe-10.0,poe-100.0\n\
                             151.20000,-33.90000,0.0,1.0,0.1,0.001\n150.0,-33.0,0.0,0.9,0.1,0.0\n";

    #[test]
    fn curves_of_openquake_become_rates() {
        let read = |site| from_file(OPENQUAKE.as_bytes(), Path::new("h.csv"), None, site);
        let read_one = read(Some((151.2, -33.9))).unwrap();
        let Hazard::Points(points) = &read_one.hazard else { panic!() };
        assert_eq!((points.len(), read_one.measure, read_one.warnings.len()), (2, Measure::Pgv, 1));
        assert!((points[0].intensity - 0.1).abs() < 1e-15);
        assert!((points[0].annual_rate + 0.9_f64.ln() / 50.0).abs() < 1e-15);
        assert!(read(None).unwrap_err().message.contains("2 sites"));
        assert!(read(Some((0.0, 0.0))).unwrap_err().message.contains("0 sites"));
    }

    #[test]
    fn power_laws_have_three_keys_with_units() {
        let law = power_law("k0=1e-4 /yr, k=2.5, reference=100 cm/s", Measure::Pgv).unwrap();
        assert_eq!(law, Hazard::PowerLaw { rate: 1e-4, reference: 1.0, exponent: 2.5 });
        for (text, said) in [
            ("k0=1e-4, k=2.5, reference=1 m/s", "k0 needs the unit"),
            ("k0=1e-4 /yr, k=2.5", "reference is missing"),
            ("k0=1e-4 /yr, k=2.5, reference=1", "pgv has no unit"),
            ("k0=1e-4 /yr, k=-2.5, reference=1 m/s", "not a number above 0"),
            ("k0", "is not key=value"),
            ("q=3", "is not k0"),
        ] {
            let problem = power_law(text, Measure::Pgv).unwrap_err();
            assert!(problem.message.contains(said) && problem.hint.is_some(), "{said}: {problem}");
        }
    }

    /// Sydney, rock: 0.08 g every 500 years, 1.8 times as much every 2500.
    #[test]
    fn the_return_periods_of_a_code_are_points() {
        let hazard = of_code(HazardCode::As1170_4, "Be", 0.08, None, Measure::Pga).unwrap().hazard;
        assert!((hazard.annual_rate(0.08) - 1.0 / 500.0).abs() < 1e-15);
        assert!((hazard.annual_rate(0.08 * 1.8) * 2500.0 - 1.0).abs() < 1e-12);
        let new_zealand = of_code(HazardCode::Nzs1170_5, "C", 0.4, None, Measure::Sa { period_s: 0.5 }).unwrap().hazard;
        assert!((new_zealand.annual_rate(0.8) - 1.0 / 500.0).abs() < 1e-15);
        assert!(of_code(HazardCode::As1170_4, "X", 0.08, None, Measure::Pga).is_err());
        assert!(of_code(HazardCode::As1170_4, "Be", 0.08, None, Measure::Pgv).is_err());
    }
}
