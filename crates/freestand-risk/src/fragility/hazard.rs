//! Hazard curves: from a file, a power law, or the return periods of a code.

use std::path::{Path, PathBuf};

use freestand::code_spectrum::{
    SiteClass, SubsoilClass, near_fault_ratio, probability_factors, return_period_factors,
};
use freestand::risk::{Hazard, HazardError, HazardPoint};
use freestand_input::file::{InputFile, load};
use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::shorten;
use freestand_input::words::{Choices, counted, shortest};
use freestand_output::{answer, answer_of};

use super::doubt::HazardDoubt;
use super::table::{Row, RowProblems, Table};
use super::{At, Measure, measure_of};

/// Where the hazard comes from.
#[derive(Debug, Clone, PartialEq)]
pub enum HazardSource {
    /// A CSV of our own or of OpenQuake.
    File(PathBuf),
    /// `k0=1e-4 /yr, k=2.5, reference=1 m/s`, of a measure.
    PowerLaw {
        /// The text.
        text: String,
        /// The measure; `None`: that of the fragilities.
        measure: Option<Measure>,
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
        /// `pga` or `sa(T)`; `None`: that of the fragilities.
        measure: Option<Measure>,
    },
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
    (
        HazardCode::As1170_4,
        "as1170.4",
        "AS 1170.4, edition 2007: k_p Z C_h(T)",
    ),
    (
        HazardCode::Nzs1170_5,
        "nzs1170.5",
        "NZS 1170.5:2004: R Z C_h(T) N(T, D)",
    ),
];

/// A hazard with its measure.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredHazard {
    /// The hazard.
    pub hazard: Hazard,
    /// Its measure.
    pub measure: Measure,
    /// Where it is taken.
    pub at: At,
    /// The file that it was read from.
    pub file: Option<InputFile>,
    /// Whether coordinates choose one of its sites.
    pub has_sites: bool,
    /// What to know beside it.
    pub doubts: Vec<HazardDoubt>,
}

impl MeasuredHazard {
    /// What to know beside it, with coordinates that are for it alone.
    pub(crate) fn doubts_at(
        &self,
        site_deg: Option<(f64, f64)>,
    ) -> impl Iterator<Item = HazardDoubt> {
        let is_idle = site_deg.is_some() && !self.has_sites;
        let idle = is_idle.then_some(HazardDoubt::IdleSite);
        idle.into_iter().chain(self.doubts.iter().copied())
    }

    /// Refuses a hazard of another measure than that of outcomes.
    pub(crate) fn check(&self, measure: Measure, at: At) -> Result<(), Problem> {
        if self.measure == measure && self.at == at {
            return Ok(());
        }
        let named = |measure: Measure, at: At| format!("{} of the {}", measure.name(), at.name());
        let (of_hazard, of_outcomes) = (named(self.measure, self.at), named(measure, at));
        let message =
            format!("the hazard curve is for {of_hazard}, and the outcomes are for {of_outcomes}");
        let hint = "give a hazard curve for the measure of the outcomes, or outcomes for the measure of the curve";
        let problem = Problem::value(message, hint).of(&["hazard"]);
        Err(self
            .file
            .iter()
            .fold(problem, |problem, file| problem.in_file(&file.path)))
    }
}

answer_of!(MeasuredHazard as measured {
    /// The intensity measure.
    im: String = measured.measure.name();
    im_unit: &'static str = measured.measure.unit();
    /// Where the measure is taken: ground or floor.
    at: &'static str = measured.at.name();
    points: Option<Vec<Point<'_>>> = match &measured.hazard {
        Hazard::Points(points) => Some(points.iter().map(Point).collect()),
        Hazard::PowerLaw { .. } => None,
    };
    power_law: Option<PowerLaw> = match measured.hazard {
        Hazard::PowerLaw { rate, reference, exponent } => Some(PowerLaw { k0: rate, k: exponent, reference }),
        Hazard::Points(_) => None,
    };
});

/// A point of a hazard curve.
#[derive(Clone, Copy)]
struct Point<'h>(&'h HazardPoint);

answer_of!(Point<'_> as point {
    im: f64 = point.0.intensity;
    annual_rate: f64 = point.0.annual_rate;
});

answer! {
    /// k0 (im / reference)^−k.
    pub struct PowerLaw {
        k0: f64,
        k: f64,
        reference: f64,
    }
}

/// Where a spectral acceleration of a hazard is taken.
#[derive(Debug, Clone, Copy)]
pub(crate) enum HazardPlace {
    /// Where the user says, if anything: a measure of the other place contradicts it.
    Stated(Option<At>),
    /// Where that of the outcomes is.
    OfOutcomes(At),
}

impl HazardPlace {
    fn of(self, measure: Measure) -> Result<At, Problem> {
        match self {
            Self::Stated(at) => measure.at(at),
            Self::OfOutcomes(at) => Ok(measure.place().unwrap_or(at)),
        }
    }
}

/// Reads a hazard; `place` is where a spectral acceleration is taken, `site_deg` the site of an
/// OpenQuake file with several, and `of_curves` the measure of all fragilities, if they have one: that of
/// a hazard that names none.
pub(crate) fn hazard_of(
    source: &HazardSource,
    place: HazardPlace,
    site_deg: Option<(f64, f64)>,
    of_curves: Option<(Measure, At)>,
) -> Result<MeasuredHazard, Problems> {
    let measure_of = |given: Option<Measure>| {
        given.or(of_curves.map(|one| one.0)).ok_or_else(|| {
            let message =
                "the fragilities have several intensity measures, and nothing says which is that of the hazard";
            Problem::value(message, "give `hazard_im`, such as pgv").of(&["hazard_im"])
        })
    };
    // Where the measure is that of the fragilities, so is its place.
    let place_of = |given: Option<Measure>| match place {
        HazardPlace::Stated(at) => {
            HazardPlace::Stated(at.or(of_curves.filter(|_| given.is_none()).map(|one| one.1)))
        }
        of_outcomes @ HazardPlace::OfOutcomes(_) => of_outcomes,
    };
    match source {
        HazardSource::File(path) => from_file(&load(path)?, path, place, site_deg),
        HazardSource::PowerLaw { text, measure } => {
            let (measure, place) = (measure_of(*measure)?, place_of(*measure));
            let hazard =
                power_law(text, measure).map_err(|problem| problem.named("hazard_power"))?;
            let at = place.of(measure)?;
            Ok(MeasuredHazard {
                hazard,
                measure,
                at,
                file: None,
                has_sites: false,
                doubts: Vec::new(),
            })
        }
        HazardSource::Code {
            code,
            site,
            hazard_factor,
            fault_distance_km,
            measure,
        } => Ok(of_code(
            *code,
            site,
            *hazard_factor,
            *fault_distance_km,
            measure_of(*measure)?,
        )?),
    }
}

const HINT: &str = "write \"pgv [m/s],annual_rate\" with rising intensities and falling rates, or give a \
                    hazard_curve-*.csv of OpenQuake";

fn from_file(
    bytes: &[u8],
    path: &Path,
    place: HazardPlace,
    site_deg: Option<(f64, f64)>,
) -> Result<MeasuredHazard, Problems> {
    let mut problems = RowProblems::default();
    let table = Table::read(bytes, path, HINT, &mut problems)?;
    let is_openquake = table
        .headings
        .iter()
        .any(|heading| heading.name.starts_with("poe-"));
    let file = Some(InputFile::new(path, bytes));
    if is_openquake {
        return Ok(MeasuredHazard {
            file,
            ..openquake(&table, problems, place, site_deg)?
        });
    }
    let rates = table.needed("annual_rate")?;
    let (column, measure, factor) = measure_of(&table)?;
    let mut before: Option<(&Row, HazardPoint)> = None;
    let points = table.each_row(problems, |row, problems| {
        let intensity = problems.keep(table.positive(row, column));
        let annual_rate = problems.keep(table.positive(row, rates));
        let point = HazardPoint {
            intensity: factor * intensity?,
            annual_rate: annual_rate?,
        };
        if let Some((above, last)) = before.replace((row, point))
            && let Err(error) = Hazard::points(vec![last, point])
        {
            let column = if matches!(error, HazardError::NotFalling { .. }) {
                rates
            } else {
                column
            };
            let [above, here] = [above, row].map(|row| Cell { row, column });
            problems.push(disorder(&table, above, here, error));
            return None;
        }
        Some(point)
    })?;
    let hazard = Hazard::points(points).map_err(|error| table.header_problem(error.to_string()))?;
    Ok(MeasuredHazard {
        hazard,
        measure,
        at: place.of(measure)?,
        file,
        has_sites: false,
        doubts: Vec::new(),
    })
}

/// A cell of a table.
struct Cell<'t> {
    row: &'t Row,
    column: usize,
}

/// The problem with a cell that does not continue the curve. It quotes this cell and the one before
/// it.
fn disorder(table: &Table, above: Cell, at: Cell, error: HazardError) -> Problem {
    let [before, here] = [&above, &at].map(|cell| shorten(table.text(cell.row, cell.column)));
    let (message, hint) = match error {
        HazardError::NotFalling { .. } => (
            format!("the rate {here} is not below {before}, that of the weaker motions before it"),
            "each stronger intensity must be rarer: correct the rate, or leave the point out",
        ),
        HazardError::NotRising { .. } => (
            format!("the intensity {here} is not above {before}, the one before it"),
            "sort the points by rising intensity, and give each intensity once",
        ),
        other => (other.to_string(), HINT),
    };
    table.cell_problem(at.row, at.column, &message).hint(hint)
}

/// The key in the comment above the headings that states the periods of AvgSA, as `sa_avg(0.2:2)`;
/// we write it, and OpenQuake keeps what it does not know.
pub(crate) const AVERAGE_KEY: &str = "measure";

/// A hazard curve of OpenQuake: probabilities of exceedance in an investigation time.
fn openquake(
    table: &Table,
    rows: RowProblems,
    place: HazardPlace,
    site_deg: Option<(f64, f64)>,
) -> Result<MeasuredHazard, Problems> {
    let comment = table.comments.join(",");
    let stated = |key: &str| {
        let (_, rest) = comment.split_once(&format!("{key}="))?;
        let end = rest.find([',', '"']).unwrap_or(rest.len());
        Some(rest.get(..end)?.trim().trim_matches('\'').to_owned())
    };
    let lost = |key: &str| {
        let message = format!("the comment above the headings does not state {key}");
        table
            .header_problem(message)
            .hint("give the file as OpenQuake wrote it, with its first line")
    };
    let years = stated("investigation_time").ok_or_else(|| lost("investigation_time"))?;
    let years = years
        .parse::<f64>()
        .ok()
        .filter(|years| *years > 0.0 && years.is_finite())
        .ok_or_else(|| {
            let message = format!(
                "the investigation_time \"{}\" is not a number of years above 0",
                shorten(&years)
            );
            table
                .header_problem(message)
                .hint("give the file as OpenQuake wrote it, with its first line")
        })?;
    let imt = stated("imt").ok_or_else(|| lost("imt"))?;
    let (measure, factor) = match imt.as_str() {
        "PGA" => (Measure::Pga, 1.0),
        "PGV" => (Measure::Pgv, 0.01),
        "AvgSA" => {
            // OpenQuake takes the periods from the job and does not write them: without them
            // nothing tells whether it is the measure of the outcomes.
            let text = stated(AVERAGE_KEY).unwrap_or_default();
            let measure = Measure::parse(&text)
                .filter(|measure| matches!(measure, Measure::SaAverage { .. }));
            let measure = measure.ok_or_else(|| {
                let message = if text.is_empty() {
                    format!("the comment above the headings does not state the periods of AvgSA as {AVERAGE_KEY}")
                } else {
                    format!("the {AVERAGE_KEY} \"{}\" of AvgSA does not state its periods", shorten(&text))
                };
                let hint = format!(
                    "add the shortest and the longest period of the job in s to the comment, \
                     such as imt='AvgSA', {AVERAGE_KEY}='sa_avg(0.2:2)'"
                );
                table.header_problem(message).hint(hint)
            })?;
            (measure, 1.0)
        }
        other => match other
            .starts_with("SA")
            .then(|| Measure::parse(other))
            .flatten()
        {
            Some(measure) => (measure, 1.0),
            None => {
                let message = format!(
                    "the measure {} is not one of PGA, PGV, SA and AvgSA",
                    shorten(other)
                );
                let problem = table
                    .header_problem(message)
                    .hint("export hazard curves of PGA, PGV, SA or AvgSA");
                return Err(problem.into());
            }
        },
    };
    let row = table.row_of_site(rows, site_deg)?;
    let mut problems = Problems::default();
    let (mut points, mut certain, mut equal): (Vec<HazardPoint>, usize, usize) = (Vec::new(), 0, 0);
    let mut before: Option<usize> = None;
    for (column, heading) in table.headings.iter().enumerate() {
        let Some(text) = heading.name.strip_prefix("poe-") else {
            continue;
        };
        let level = text
            .parse::<f64>()
            .ok()
            .filter(|level| *level > 0.0 && level.is_finite())
            .ok_or_else(|| {
                let message = format!(
                    "column {}: \"{}\" states no intensity",
                    column + 1,
                    shorten(&heading.name)
                );
                table
                    .header_problem(message)
                    .hint("write poe- and an intensity above 0, such as poe-0.1")
            });
        let poe = table.non_negative(row, column).and_then(|poe| {
            let hint = "write the probability that the intensity is exceeded, from 0 to 1";
            let problem = || {
                table
                    .cell_problem(row, column, &format!("{poe} is not a probability"))
                    .hint(hint)
            };
            if poe > 1.0 { Err(problem()) } else { Ok(poe) }
        });
        let (Some(level), Some(poe)) = (problems.keep(level), problems.keep(poe)) else {
            continue;
        };
        if poe == 1.0 {
            certain += 1;
            continue;
        } else if poe == 0.0 {
            continue;
        }
        let point = HazardPoint {
            intensity: factor * level,
            annual_rate: -(-poe).ln_1p() / years,
        };
        let last = points.last().copied();
        // OpenQuake writes seven digits, so neighbours may have the same rate: the stronger motions
        // are then as frequent as the weaker ones, and their point is kept.
        if last.is_some_and(|last| {
            last.annual_rate == point.annual_rate && last.intensity < point.intensity
        }) {
            equal += 1;
            points.pop();
        } else if let (Some(last), Some(above)) = (last, before)
            && let Err(error) = Hazard::points(vec![last, point])
        {
            problems.push(match error {
                HazardError::NotFalling { .. } => {
                    let [above, here] = [above, column].map(|column| Cell { row, column });
                    disorder(table, above, here, error)
                }
                _ => {
                    let message = format!(
                        "column {}: {}",
                        column + 1,
                        disorder_of_levels(table, above, column)
                    );
                    table
                        .header_problem(message)
                        .hint("sort the columns by rising intensity, and give each intensity once")
                }
            });
            continue;
        }
        before = Some(column);
        points.push(point);
    }
    problems.finish(Some(()))?;
    if points.len() < 2 {
        let message = format!(
            "{} of the site {} a probability between 0 and 1, but a hazard curve needs two",
            counted(points.len(), "intensity"),
            if points.len() == 1 { "has" } else { "have" }
        );
        let hint =
            "export the curve with weaker or stronger intensities, or a shorter investigation time";
        return Err(table.row_problem(row, message).hint(hint).into());
    }
    let hazard =
        Hazard::points(points).map_err(|error| table.row_problem(row, error.to_string()))?;
    let doubts = [
        (certain, HazardDoubt::CertainPoints(certain)),
        (equal, HazardDoubt::EqualPoints(equal)),
    ];
    let doubts = doubts.into_iter().filter(|(count, _)| *count > 0);
    Ok(MeasuredHazard {
        hazard,
        measure,
        at: place.of(measure)?,
        file: None,
        has_sites: true,
        doubts: doubts.map(|(_, doubt)| doubt).collect(),
    })
}

fn disorder_of_levels(table: &Table, before: usize, here: usize) -> String {
    let [before, here] = [before, here].map(|i| {
        table
            .headings
            .get(i)
            .map_or("", |heading| heading.name.as_str())
    });
    format!("\"{}\" is not above \"{}\"", shorten(here), shorten(before))
}

impl Table {
    /// The row of a site, or the only one.
    fn row_of_site(
        &self,
        rows: RowProblems,
        site_deg: Option<(f64, f64)>,
    ) -> Result<&Row, Problems> {
        let columns = [(self.needed("lon")?, 360.0), (self.needed("lat")?, 90.0)];
        let sites = self.each_row(rows, |row, problems| {
            let [lon, lat] =
                columns.map(|(column, most)| problems.keep(self.degrees(row, column, most)));
            Some((row, lon?, lat?))
        })?;
        // Coordinates are written with five decimals.
        let is_it = |(_, lon, lat): &&(&Row, f64, f64)| {
            site_deg.is_none_or(|site| (lon - site.0).abs() < 1e-4 && (lat - site.1).abs() < 1e-4)
        };
        let found: Vec<_> = sites.iter().filter(is_it).collect();
        match (found.as_slice(), sites.first()) {
            ([(row, _, _)], _) => Ok(row),
            (found, Some((_, lon, lat))) => {
                let message = match (site_deg, found.len()) {
                    (Some((lon, lat)), 0) => format!(
                        "the file has no site at {},{}",
                        shortest(lon),
                        shortest(lat)
                    ),
                    (_, many) => format!("the file has {}", counted(many, "site")),
                };
                let example = format!("{},{}", shortest(*lon), shortest(*lat));
                let hint = format!(
                    "name one site of the file, such as `site_coordinates = \"{example}\"`"
                );
                Err(self.header_problem(message).hint(hint).into())
            }
            (_, None) => Err(self
                .header_problem("the file has no site".to_owned())
                .into()),
        }
    }
}

/// A number and what follows it, with or without a space between them: `40 yr`, `3000AUD`.
pub(crate) fn number_and_unit(text: &str) -> Option<(f64, &str)> {
    let text = text.trim();
    let is_part = |c: char| c.is_ascii_digit() || "+-.eE".contains(c);
    let longest = text.find(|c| !is_part(c)).unwrap_or(text.len());
    // `3000EUR`: the E belongs to the unit.
    let ends = (1..=longest).rev();
    let found = ends.filter_map(|end| {
        Some((
            text.get(..end)?.parse::<f64>().ok()?,
            text.get(end..)?.trim(),
        ))
    });
    found.into_iter().find(|(number, _)| number.is_finite())
}

/// `k0=1e-4 /yr, k=2.5, reference=1 m/s`.
fn power_law(text: &str, measure: Measure) -> Result<Hazard, Problem> {
    let unit = if measure.unit() == "1" {
        String::new()
    } else {
        format!(" {}", measure.unit())
    };
    let example = format!("write \"k0=1e-4 /yr, k=2.5, reference=1{unit}\"");
    let bad = |message: String| Problem::value(message, example.clone());
    let (mut rate, mut exponent, mut reference) = (None, None, None);
    let mut seen: Vec<&str> = Vec::new();
    for part in text.split(',') {
        let (key, value) = part
            .split_once('=')
            .ok_or_else(|| bad(format!("\"{}\" is not key=value", shorten(part.trim()))))?;
        let found = number_and_unit(value).filter(|(number, _)| *number > 0.0);
        let (number, unit) = found.ok_or_else(|| {
            bad(format!(
                "\"{}\" is not a number above 0",
                shorten(value.trim())
            ))
        })?;
        let key = key.trim();
        if seen.contains(&key) {
            return Err(bad(format!("{key} appears twice")));
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
            (other, _) => {
                return Err(bad(format!(
                    "\"{}\" is not k0, k or reference",
                    shorten(other)
                )));
            }
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
            return Err(Problem::value(
                message,
                "give `hazard_im = \"pga\"` or `hazard_im = \"sa(0.5)\"`",
            )
            .of(&["hazard_im"]));
        }
    };
    let class = |error: freestand::code_spectrum::CodeSpectrumError| {
        Problem::value(error.to_string(), "name the class as the code does").named("site")
    };
    let (shape, factors): (f64, &[(u32, f64)]) = match code {
        HazardCode::As1170_4 => (
            SiteClass::parse(site)
                .map_err(class)?
                .shape_factor_ratio(period_s),
            probability_factors(),
        ),
        HazardCode::Nzs1170_5 => (
            SubsoilClass::parse(site)
                .map_err(class)?
                .shape_factor_ratio(period_s),
            return_period_factors(),
        ),
    };
    let near = |factor: f64| match (code, fault_distance_km) {
        (HazardCode::Nzs1170_5, Some(km)) => near_fault_ratio(period_s, km, factor),
        _ => 1.0,
    };
    let points = factors.iter().map(|&(years, factor)| HazardPoint {
        intensity: factor * hazard_factor * shape * near(factor),
        annual_rate: 1.0 / f64::from(years),
    });
    let hazard = Hazard::points(points.collect()).map_err(|error| {
        Problem::value(error.to_string(), "give a hazard factor above 0").named("hazard_factor")
    })?;
    Ok(MeasuredHazard {
        hazard,
        measure,
        at: At::Ground,
        file: None,
        has_sites: false,
        doubts: vec![HazardDoubt::DesignAccelerations],
    })
}

#[cfg(test)]
mod tests;
