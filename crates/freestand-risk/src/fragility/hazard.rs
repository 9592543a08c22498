//! Hazard curves: from a file, a power law, or the return periods of a code.

use std::path::{Path, PathBuf};

use freestand::code_spectrum::{
    SiteClass, SubsoilClass, near_fault_ratio, probability_factors, return_period_factors,
};
use freestand::risk::{Hazard, HazardError, HazardPoint};
use freestand_input::file::InputFile;
use freestand_input::keys::Words;
use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::shorten;
use freestand_input::words::Choices;
use freestand_output::{answer, answer_of};
use freestand_records::tables::hazard::{
    Coordinates, GroundMeasure, Wanted, load_hazard, read_hazard, recognised,
};
use freestand_study::places::{FAR_KM, Place, PlaceHazard};
use freestand_study::target::Target;

use super::doubt::HazardDoubt;
use super::table::{Row, RowProblems, Table};
use super::{At, Measure, measure_of};

/// Where the hazard comes from.
#[derive(Debug, Clone, PartialEq)]
pub enum HazardSource {
    /// A CSV of our own, or a file that people download.
    File {
        /// The file.
        path: PathBuf,
        /// Which of its curves; `None`: that of the fragilities.
        measure: Option<Measure>,
        /// Which of its sites.
        site: Wanted,
    },
    /// The return periods of a place.
    Place {
        /// Its name or its coordinates.
        name: String,
        /// Site class of its code.
        site: Option<String>,
        /// `pga` or `sa(T)`; `None`: that of the fragilities.
        measure: Option<Measure>,
    },
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
    /// The same curve with other slopes, where few points leave its slope open.
    pub tilted: Vec<Hazard>,
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
        idle.into_iter().chain(self.doubts.iter().cloned())
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
        HazardSource::File {
            path,
            measure,
            site,
        } => {
            let wanted = Wanted {
                at: site_deg.map(on_globe).or(site.at),
                ..site.clone()
            };
            let measure = measure.or(of_curves.map(|one| one.0));
            let bytes = load_hazard(path)?;
            if (site.at.is_some() || site.name.is_some()) && recognised(&bytes).is_none() {
                let message =
                    "the file has one hazard curve and no sites, so that `place` chooses nothing";
                let hint = "leave `place` out, or give a file that has sites";
                let problem = Problem::value(message, hint).in_file(path);
                return Err(problem.of(&["place"]).into());
            }
            from_file(&bytes, path, place, wanted, measure)
        }
        HazardSource::Place {
            name,
            site,
            measure,
        } => of_place(name, site.as_deref(), measure_of(*measure)?),
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
                tilted: Vec::new(),
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

/// A longitude and a latitude.
fn on_globe((longitude_deg, latitude_deg): (f64, f64)) -> Coordinates {
    Coordinates {
        latitude_deg,
        // Some files count from 0 to 360.
        longitude_deg: (longitude_deg + 180.0).rem_euclid(360.0) - 180.0,
    }
}

const HINT: &str = "write \"pgv [m/s],annual_rate\" with rising intensities and falling rates, or give a curve \
                    of OpenQuake, USGS or EFEHR";

fn from_file(
    bytes: &[u8],
    path: &Path,
    place: HazardPlace,
    wanted: Wanted,
    measure: Option<Measure>,
) -> Result<MeasuredHazard, Problems> {
    let file = Some(InputFile::new(path, bytes));
    if recognised(bytes).is_some() {
        return Ok(MeasuredHazard {
            file,
            ..downloaded(bytes, path, place, wanted, measure)?
        });
    }
    let mut problems = RowProblems::default();
    let table = Table::read(bytes, path, HINT, &mut problems)?;
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
        tilted: Vec::new(),
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

/// The measure of a file's curve.
fn of_ground(measure: GroundMeasure) -> Measure {
    match measure {
        GroundMeasure::Pga => Measure::Pga,
        GroundMeasure::Pgv => Measure::Pgv,
        GroundMeasure::Sa { period_s } => Measure::Sa { period_s },
        GroundMeasure::SaAverage { from_s, to_s } => Measure::SaAverage { from_s, to_s },
    }
}

fn to_ground(measure: Measure) -> Option<GroundMeasure> {
    match measure {
        Measure::Pga => Some(GroundMeasure::Pga),
        Measure::Pgv => Some(GroundMeasure::Pgv),
        Measure::Sa { period_s } => Some(GroundMeasure::Sa { period_s }),
        Measure::SaAverage { from_s, to_s } => Some(GroundMeasure::SaAverage { from_s, to_s }),
        _ => None,
    }
}

/// From so far away it is said \[km\]: coordinates of files are rounded to some metres.
const AWAY_KM: f64 = 0.1;

/// The curve of a file that people download: of several the one of this measure.
fn downloaded(
    bytes: &[u8],
    path: &Path,
    place: HazardPlace,
    wanted: Wanted,
    measure: Option<Measure>,
) -> Result<MeasuredHazard, Problems> {
    let wanted = Wanted {
        measure: measure.and_then(to_ground),
        ..wanted
    };
    let site = read_hazard(bytes, path, &wanted)?;
    let curves = site
        .hazard_curves()
        .map_err(|problem| problem.in_file(path))?;
    let names: Vec<String> = curves
        .iter()
        .map(|curve| of_ground(curve.measure).name())
        .collect();
    let one = match (curves.as_slice(), measure) {
        ([one], _) => Ok(one),
        ([], _) => {
            let message = match site.code {
                Some(_) => "the file has design values, which have no return period",
                None => "the file has one return period alone, and a hazard curve needs two",
            };
            let hint = "give a file with a hazard curve, or with several return periods";
            Err(Problem::value(message, hint).of(&["hazard"]))
        }
        (_, None) => {
            let message = format!("the file has curves of {}", names.join(", "));
            let hint = format!("name one: `hazard_im = \"{}\"`", names[0]);
            Err(Problem::value(message, hint).of(&["hazard_im"]))
        }
        (all, Some(wanted)) => {
            let found = all.iter().find(|one| of_ground(one.measure) == wanted);
            found.ok_or_else(|| {
                let message = format!(
                    "the file has no curve of {}, but of {}",
                    wanted.name(),
                    names.join(", ")
                );
                let hint = "give outcomes for one of its measures, or another file";
                Problem::value(message, hint).of(&["hazard"])
            })
        }
    };
    let one = one.map_err(|problem| problem.in_file(path))?;
    let points = one
        .points
        .iter()
        .map(|&(intensity, annual_rate)| HazardPoint {
            intensity,
            annual_rate,
        });
    let measure = of_ground(one.measure);
    let hazard = Hazard::points(points.collect())
        .map_err(|error| Problem::value(error.to_string(), HINT).in_file(path))?;
    let away = site.distance_km.filter(|km| *km >= AWAY_KM);
    let doubts = [
        (one.certain > 0).then_some(HazardDoubt::CertainPoints(one.certain)),
        (one.equal > 0).then_some(HazardDoubt::EqualPoints(one.equal)),
        away.map(|km| HazardDoubt::SiteAway {
            metres: (1e3 * km).round() as u32,
        }),
        site.other_than_mean()
            .map(|statistic| HazardDoubt::OtherThanMean(statistic.clone())),
    ];
    Ok(MeasuredHazard {
        hazard,
        measure,
        at: place.of(measure)?,
        file: None,
        has_sites: true,
        tilted: Vec::new(),
        doubts: doubts.into_iter().flatten().collect(),
    })
}

/// The return period about which the curve of a place is tilted: that of its code \[years\].
const PIVOT_YEARS: f64 = 475.0;
/// By how much the slope of the curve of a place is open: those of the grids of New Zealand (1.9 to 2.5) and of Türkiye (1.9 to
/// 3.0) lie within it of their medians, 2.2 and 2.5.
const OPEN_SLOPE: f64 = 0.5;

/// The spectrum of a place at each of its return periods, at one period.
fn of_place(name: &str, site: Option<&str>, measure: Measure) -> Result<MeasuredHazard, Problems> {
    let at_key = |message: String, hint: &str| Problem::value(message, hint).of(&["place"]);
    let place = Place::look_up(name, None).map_err(|why| {
        let bring = "give a hazard curve of the place as `hazard`";
        why.problem(Some("place"), name, bring).of(&["place"])
    })?;
    let period_s = period_of(measure)?;
    let factor = match place.hazard {
        PlaceHazard::As1170_4 { hazard_factor } => {
            Some((HazardCode::As1170_4, "De", hazard_factor))
        }
        PlaceHazard::Nzs1170_5 { hazard_factor } => {
            Some((HazardCode::Nzs1170_5, "C", hazard_factor))
        }
        _ => None,
    };
    let mut assumed_site = None;
    let years = place.hazard.return_periods();
    let read = if let Some((code, class, factor)) = factor {
        // As in `near_fault_ratio`, a fault counts up to 20 km.
        let km = place.fault_distance_km.filter(|km| *km < FAR_KM);
        assumed_site = site.is_none().then(|| format!("site class {class}"));
        of_code(code, site.unwrap_or(class), factor, km, measure)?
    } else if let [_, _, ..] = years[..] {
        let mut points: Vec<HazardPoint> = Vec::new();
        for years in years {
            let mut words: Words = [("place", name)].into_iter().collect();
            words.set("return_period_years", years.to_string());
            if let Some(site) = site {
                words.set("site", site);
            }
            let target = Target::resolve_place(&words)?;
            let intensity = target.spectrum.sa_g(period_s);
            if site.is_none() && target.spectrum.site_name().is_some() {
                assumed_site = Some(target.site_words());
            }
            // Values with two digits may be equal at the shortest return periods: the rarer one counts.
            if points
                .last()
                .is_some_and(|last| last.intensity >= intensity)
            {
                points.pop();
            }
            points.push(HazardPoint {
                intensity,
                annual_rate: 1.0 / f64::from(years),
            });
        }
        MeasuredHazard {
            hazard: Hazard::points(points).map_err(|error| at_key(error.to_string(), HINT))?,
            measure,
            at: At::Ground,
            file: None,
            has_sites: false,
            tilted: Vec::new(),
            doubts: vec![HazardDoubt::DesignAccelerations],
        }
    } else {
        let message = format!(
            "the values of {} are for one return period alone, or for none, and a hazard curve needs two",
            place.told_name()
        );
        return Err(at_key(message, "give a hazard curve of the place as `hazard`").into());
    };
    let tilted = match &read.hazard {
        Hazard::Points(points) => [-OPEN_SLOPE, OPEN_SLOPE]
            .into_iter()
            .filter_map(|by| tilted(points, by))
            .collect(),
        Hazard::PowerLaw { .. } => Vec::new(),
    };
    let mut doubts = read.doubts.clone();
    doubts.push(HazardDoubt::SlopeOfPlace);
    doubts.extend(assumed_site.map(HazardDoubt::AssumedSite));
    Ok(MeasuredHazard {
        tilted,
        doubts,
        ..read
    })
}

/// The curve about its point of 475 years with a slope that is larger by so much.
fn tilted(points: &[HazardPoint], by: f64) -> Option<Hazard> {
    let far = |point: &HazardPoint| (point.annual_rate * PIVOT_YEARS).ln().abs();
    let pivot = points
        .iter()
        .min_by(|a, b| far(a).total_cmp(&far(b)))?
        .intensity;
    let points = points.iter().map(|point| HazardPoint {
        annual_rate: point.annual_rate * (point.intensity / pivot).powf(-by),
        ..*point
    });
    Hazard::points(points.collect()).ok()
}

/// The period of a measure that codes have; 0: the peak \[s\].
fn period_of(measure: Measure) -> Result<f64, Problem> {
    match measure {
        Measure::Pga => Ok(0.0),
        Measure::Sa { period_s } => Ok(period_s),
        _ => {
            let message = format!("a code has no {}", measure.name());
            let hint = "give `hazard_im = \"pga\"` or `hazard_im = \"sa(0.5)\"`";
            Err(Problem::value(message, hint).of(&["hazard_im"]))
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
    let period_s = period_of(measure)?;
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
        tilted: Vec::new(),
        doubts: vec![HazardDoubt::DesignAccelerations],
    })
}

#[cfg(test)]
mod tests;
