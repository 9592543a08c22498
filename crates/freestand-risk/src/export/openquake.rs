//! Fragilities as a folder with complete jobs for the OpenQuake engine.

use freestand::risk::Hazard;
use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::quantity::shorten;
use freestand_input::words::shortest;
use freestand_output::json::document;
use freestand_output::rows::csv;
use serde_json::json;

use crate::costs::CostRow;
use crate::fragility::{At, FragilityReport, Measure, MeasuredHazard};
use freestand_records::tables::hazard::{AVERAGE_KEY, Coordinates};

use super::{
    ExportDoubt, ExportObject, ExportRequest, Files, Listed, OPENQUAKE_IDS, Shape, plain_ids,
    sources,
};

/// Years of the damage that the classical job states.
const RISK_YEARS: u32 = 50;
/// How much rarer than its last point the exported end of a hazard curve is.
const BEYOND: f64 = 1e4;
/// The most that its intensity is above the last point: a level hazard would go on without an end.
const MAX_BEYOND: f64 = 100.0;
/// Levels of the hazard curve: OpenQuake sums over them, and with 300 it is off by 0.05 %.
const LEVELS: usize = 600;
/// More motions per year than this have a probability within a year that cannot be told from 1.
const MAX_RATE: f64 = 10.0;
/// Beyond how many β about its contributions a curve adds nothing.
const REACH: f64 = 6.0;

/// A measure of OpenQuake.
#[derive(Debug, PartialEq)]
struct Imt {
    name: String,
    /// From our unit to its.
    factor: f64,
}

/// A measure as OpenQuake has it.
fn imt_of(measure: Measure, at: At) -> Result<Imt, Problem> {
    let name = measure.name();
    let refused = || {
        let message = format!("OpenQuake has no measure {name} of the {}", at.name());
        Problem::value(
            message,
            "fit the outcomes against a measure of the ground, such as pgv, with `at = \"ground\"`",
        )
    };
    let imt = |name, factor| Imt { name, factor };
    match (measure, at) {
        (_, At::Floor) => Err(refused()),
        (Measure::Pga, At::Ground) => Ok(imt("PGA".to_owned(), 1.0)),
        (Measure::Sa { period_s }, At::Ground) => {
            Ok(imt(format!("SA({})", shortest(period_s)), 1.0))
        }
        (Measure::SaAverage { .. }, At::Ground) => Ok(imt("AvgSA".to_owned(), 1.0)),
        (Measure::Pgv, At::Ground) => Ok(imt("PGV".to_owned(), 100.0)),
        _ => Err(refused()),
    }
}

/// Mean and standard deviation of a lognormal capacity: θ e^{β²/2} and mean √(e^{β²} − 1).
fn moments((median, beta): (f64, f64)) -> (f64, f64) {
    let mean = median * (0.5 * beta * beta).exp();
    (mean, mean * (beta * beta).exp_m1().sqrt())
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

/// The function of one object. `exceeds` repeats `overturns` where there is no tolerance, because
/// the limit states are common to all objects.
fn function(object: &ExportObject, Imt { name: imt, factor }: &Imt) -> String {
    let id = &object.id;
    match &object.shape {
        Shape::Lognormal { exceeds, overturns } => {
            let params = |state: &str, curve: (f64, f64)| {
                let (mean, stddev) = moments((factor * curve.0, curve.1));
                format!(
                    "      <params ls=\"{state}\" mean=\"{mean:.16e}\" stddev=\"{stddev:.16e}\"/>\n"
                )
            };
            // A level below minIML would be raised to it.
            format!(
                "    <fragilityFunction id=\"{id}\" format=\"continuous\" shape=\"logncdf\">\n      \
                 <imls imt=\"{imt}\" minIML=\"1e-6\" maxIML=\"1e3\"/>\n{}{}    </fragilityFunction>\n",
                params("exceeds", exceeds.unwrap_or(*overturns)),
                params("overturns", *overturns)
            )
        }
        Shape::Points(points) => {
            let list = |values: &mut dyn Iterator<Item = f64>| {
                values.map(shortest).collect::<Vec<_>>().join(" ")
            };
            // Below the first level OpenQuake has the probability of that level, so that one at
            // almost 0 comes first.
            let first = points.levels.first().map_or(1e-6, |level| 1e-6 * level);
            let imls = list(
                &mut std::iter::once(first)
                    .chain(points.levels.iter().copied())
                    .map(|x| factor * x),
            );
            let poes = |state: &str, curve: &[f64]| {
                let all = list(&mut std::iter::once(0.0).chain(curve.iter().copied()));
                format!("      <poes ls=\"{state}\">{all}</poes>\n")
            };
            format!(
                "    <fragilityFunction id=\"{id}\" format=\"discrete\">\n      <imls imt=\"{imt}\">{imls}</imls>\n{}{}    \
                 </fragilityFunction>\n",
                poes(
                    "exceeds",
                    points.exceeds.as_ref().unwrap_or(&points.overturns)
                ),
                poes("overturns", &points.overturns)
            )
        }
    }
}

fn replacement(object: &ExportObject) -> Option<f64> {
    object.cost.and_then(|cost| cost.replacement)
}

/// What an object without a replacement cost is worth in the column of values, which is required: 1
/// where no object has any cost, so that the values count objects. Beside costs in a currency 1
/// would be an amount of it, so that it is 0, with a doubt.
fn value_without_cost(objects: &[ExportObject]) -> (f64, Option<ExportDoubt>) {
    if !objects
        .iter()
        .any(|object| object.cost.is_some_and(CostRow::has_costs))
    {
        return (1.0, None);
    }
    let without = objects
        .iter()
        .filter(|object| replacement(object).is_none());
    let ids: Vec<String> = without.map(|object| object.object.id.clone()).collect();
    (
        0.0,
        (!ids.is_empty()).then_some(ExportDoubt::NoReplacement(ids)),
    )
}

/// Where an object is \[degrees\].
fn site_of(object: &ExportObject, request: &ExportRequest) -> Result<(f64, f64), Problem> {
    object.site_deg.or(request.site_deg).ok_or_else(|| {
        let message = format!("OpenQuake needs `site_coordinates`, and object {} has none", shorten(&object.object.id));
        Problem::new(ProblemKind::Missing, message)
            .hint("give `site_coordinates = \"151.2,-33.9\"`, or the columns longitude and latitude of the inventory")
            .of(&["site_coordinates"])
    })
}

/// Rising intensities and their rates, close enough for the sums of OpenQuake, which has straight
/// lines between its levels and counts nothing beyond the last one. Beyond the last point of a hazard its
/// last segment goes on, as in `annual_rate`, to a ten thousandth of its rate. What is left counts as
/// motions of the last level: a level right above it has almost no rate.
fn levels(hazard: &Hazard, objects: &[ExportObject]) -> Vec<(f64, f64)> {
    let (from, to) = match hazard {
        Hazard::Points(points) => {
            let of = |point: Option<&freestand::risk::HazardPoint>| {
                point.map_or(1.0, |point| point.intensity)
            };
            let exponent = points.last_chunk().map_or(f64::INFINITY, |[low, high]| {
                (low.annual_rate / high.annual_rate).ln() / (high.intensity / low.intensity).ln()
            });
            (
                of(points.first()),
                of(points.last()) * BEYOND.powf(1.0 / exponent).min(MAX_BEYOND),
            )
        }
        Hazard::PowerLaw { exponent, .. } => objects
            .iter()
            .map(|object| extent(&object.shape, *exponent))
            .fold((f64::INFINITY, 0.0_f64), |(low, high), (from, to)| {
                (low.min(from), high.max(to))
            }),
    };
    let share = |i: usize| i as f64 / LEVELS as f64;
    let mut levels: Vec<f64> = (0..=LEVELS)
        .map(|i| from * (to / from).powf(share(i)))
        .collect();
    if let Hazard::Points(points) = hazard {
        // Rounding must not put the ends beyond the curve.
        levels.retain(|x| *x > from && *x < to);
        levels.extend(points.iter().map(|point| point.intensity));
    }
    levels.sort_by(f64::total_cmp);
    levels.dedup_by(|a, b| *a <= *b * (1.0 + 1e-9));
    let mut rates: Vec<(f64, f64)> = levels
        .into_iter()
        .map(|x| (x, hazard.annual_rate(x)))
        .collect();
    rates.retain(|(_, rate)| *rate <= MAX_RATE);
    if let Some(&(x, rate)) = rates.last() {
        rates.push((x * (1.0 + 1e-6), 1e-9 * rate));
    }
    rates
}

/// The intensities that contribute to a rate under λ ∝ x^−k: those about θ exp(−kβ²).
fn extent(shape: &Shape, exponent: f64) -> (f64, f64) {
    match shape {
        Shape::Lognormal { exceeds, overturns } => {
            let low = exceeds.unwrap_or(*overturns);
            let centre = |(median, beta): (f64, f64)| median * (-exponent * beta * beta).exp();
            (
                centre(low) * (-REACH * low.1).exp(),
                overturns.0 * (REACH * overturns.1).exp(),
            )
        }
        Shape::Points(points) => {
            let seen = points.exceeds.as_ref().unwrap_or(&points.overturns);
            let first = points
                .levels
                .iter()
                .zip(seen)
                .find(|(_, p)| **p > 0.0)
                .map(|(x, _)| *x);
            let last = points.levels.last().copied().unwrap_or(1.0);
            (first.unwrap_or(last) / 10.0, last)
        }
    }
}

/// `hazard.csv`, a hazard curve as OpenQuake writes it: probabilities of exceedance within a year, the
/// same at all sites.
fn hazard_csv(
    measure: Measure,
    imt: &Imt,
    sites: &[(f64, f64)],
    levels: &[(f64, f64)],
) -> Result<Vec<u8>, Problem> {
    let names = ["lon", "lat", "depth"].map(str::to_owned).into_iter();
    let header: Vec<String> = names
        .chain(
            levels
                .iter()
                .map(|(x, _)| format!("poe-{}", shortest(imt.factor * x))),
        )
        .collect();
    let poes: Vec<String> = levels
        .iter()
        .map(|(_, rate)| shortest(-(-rate).exp_m1()))
        .collect();
    let row = |(lon, lat): &(f64, f64)| {
        [shortest(*lon), shortest(*lat), "0".to_owned()]
            .into_iter()
            .chain(poes.iter().cloned())
            .collect::<Vec<_>>()
    };
    let table = csv(
        &header.iter().map(String::as_str).collect::<Vec<_>>(),
        sites.iter().map(row),
    )?;
    let commas = ",".repeat(header.len() - 1);
    // OpenQuake has no periods of AvgSA; it keeps what it does not know, and we read it.
    let periods = match measure {
        Measure::SaAverage { .. } => format!(", {AVERAGE_KEY}='{}'", measure.name()),
        _ => String::new(),
    };
    let mut text = format!(
        "#{commas}\"kind='mean', investigation_time=1.0, imt='{}'{periods}\"\n",
        imt.name
    )
    .into_bytes();
    text.extend(table);
    Ok(text)
}

/// What is at which site, and what it is worth: `exposure.xml` and its assets.
fn exposure(currency: &str, assets: Vec<Vec<String>>) -> Result<Files, Problem> {
    let currency = escaped(currency);
    let model = format!(
        "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<nrml xmlns=\"http://openquake.org/xmlns/nrml/0.5\">\n  \
         <exposureModel id=\"freestand\" category=\"contents\">\n    <description>free-standing \
         objects</description>\n    <conversions>\n      <costTypes>\n        <costType name=\"contents\" \
         type=\"aggregated\" unit=\"{currency}\"/>\n      </costTypes>\n    </conversions>\n    \
         <assets>exposure.csv</assets>\n  </exposureModel>\n</nrml>\n"
    );
    let header = ["id", "lon", "lat", "taxonomy", "number", "contents"];
    Ok(vec![
        ("exposure.xml".to_owned(), model.into_bytes()),
        ("exposure.csv".to_owned(), csv(&header, assets.into_iter())?),
    ])
}

/// An object at one of several sites.
pub struct Exposed<'a> {
    /// The site.
    pub site: &'a str,
    /// Where the site is.
    pub at: Coordinates,
    /// The object, with its cost.
    pub cost: &'a CostRow,
}

/// The exposure of several sites for OpenQuake, NRML 0.5: each object where its site is, with its replacement cost (0 where the
/// list has none). Its id, and its taxonomy, are the site and the id of the list.
///
/// # Errors
/// A table that cannot be made.
pub fn exposure_of_sites(currency: &str, objects: &[Exposed]) -> Result<Files, Problem> {
    let own: Vec<String> = objects
        .iter()
        .map(|one| format!("{}-{}", one.site, one.cost.id))
        .collect();
    let ids = plain_ids(
        &own.iter().map(String::as_str).collect::<Vec<_>>(),
        &OPENQUAKE_IDS,
    );
    let asset = |(one, id): (&Exposed, &String)| {
        let value = one.cost.replacement.unwrap_or(0.0);
        let degrees = [one.at.longitude_deg, one.at.latitude_deg].map(round);
        let amounts = [one.cost.quantity, one.cost.quantity * value];
        let [lon, lat] = degrees.map(shortest);
        let [number, contents] = amounts.map(shortest);
        vec![id.clone(), lon, lat, id.clone(), number, contents]
    };
    exposure(currency, objects.iter().zip(&ids).map(asset).collect())
}

/// The files of a folder for OpenQuake, by their names in it: a scenario with one ground motion
/// field and, with a hazard, classical damage.
///
/// Its limit states are common to all objects, `exceeds` and `overturns`; of an object without a
/// tolerance `exceeds` repeats `overturns`.
///
/// # Reference
/// OpenQuake engine 3.26, scenario damage and classical damage; NRML 0.5.
///
/// # Errors
/// A measure of a floor; no demand and no hazard; no coordinates; a hazard of another measure.
pub(super) fn files(
    report: &FragilityReport,
    request: &ExportRequest,
    listed: &Listed,
    demand: Option<f64>,
    hazard: Option<&MeasuredHazard>,
    doubts: &mut Vec<ExportDoubt>,
) -> Result<Files, Problem> {
    let imt = imt_of(report.table.measure, report.at)?;
    if demand.is_none() && hazard.is_none() {
        let problem = Problem::new(
            ProblemKind::Missing,
            "a scenario of OpenQuake needs `demand`",
        );
        return Err(problem
            .hint("give `demand = \"0.4 m/s\"`, or a hazard curve with `hazard`")
            .of(&["demand"]));
    }
    hazard.map_or(Ok(()), |hazard| {
        hazard.check(report.table.measure, report.at)
    })?;
    let (unpriced, doubt) = value_without_cost(listed.objects);
    doubts.extend(doubt);
    let mut functions = String::new();
    let (mut assets, mut sites) = (Vec::new(), Vec::new());
    for object in listed.objects {
        let (lon, lat) = site_of(object, request)?;
        functions += &function(object, &imt);
        let value = replacement(object).unwrap_or(unpriced);
        let (lon, lat) = (round(lon), round(lat));
        let numbers = [lon, lat].map(shortest);
        let value = [object.quantity, object.quantity * value].map(shortest);
        let id = || std::iter::once(object.id.clone());
        assets.push(
            id().chain(numbers)
                .chain(id())
                .chain(value)
                .collect::<Vec<String>>(),
        );
        if !sites.contains(&(lon, lat)) {
            sites.push((lon, lat));
        }
    }
    let fragility = format!(
        "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<nrml xmlns=\"http://openquake.org/xmlns/nrml/0.5\">\n  \
         <fragilityModel id=\"freestand\" assetCategory=\"contents\" lossCategory=\"contents\">\n    \
         <description>{}</description>\n    <limitStates>exceeds overturns</limitStates>\n{functions}  \
         </fragilityModel>\n</nrml>\n",
        escaped(&format!(
            "fragilities of free-standing objects by freestand {}",
            env!("CARGO_PKG_VERSION")
        ))
    );
    let mut files = vec![("fragility.xml".to_owned(), fragility.into_bytes())];
    files.extend(exposure(listed.currency.unwrap_or("USD"), assets)?);
    let risk = "[risk]\nexposure_file = exposure.xml\ncontents_fragility_file = fragility.xml\n\
                asset_hazard_distance = 20\n";
    if let Some(demand) = demand {
        let level = shortest(imt.factor * demand);
        let rows = (0..sites.len()).map(|site| {
            ["0", &site.to_string(), "0", &level]
                .map(str::to_owned)
                .to_vec()
        });
        files.push((
            "gmf.csv".to_owned(),
            csv(&["rlzi", "sid", "eid", &format!("gmv_{}", imt.name)], rows)?,
        ));
        let listed: Vec<String> = sites
            .iter()
            .map(|(lon, lat)| format!("{} {}", shortest(*lon), shortest(*lat)))
            .collect();
        let job = format!(
            "[general]\ndescription = free-standing objects, one scenario\ncalculation_mode = scenario_damage\n\n\
             [geometry]\nsites = {}\n\n[hazard]\ngmfs_csv = gmf.csv\nnumber_of_ground_motion_fields = 1\n\n{risk}",
            listed.join(", ")
        );
        files.push(("job_scenario_damage.ini".to_owned(), job.into_bytes()));
    }
    if let Some(hazard) = hazard {
        let levels = levels(&hazard.hazard, listed.objects);
        files.push((
            "hazard.csv".to_owned(),
            hazard_csv(report.table.measure, &imt, &sites, &levels)?,
        ));
        let job = format!(
            "[general]\ndescription = free-standing objects, {RISK_YEARS} years\ncalculation_mode = \
             classical_damage\n\n[hazard]\nhazard_curves_csv = hazard.csv\ninvestigation_time = 1\n\n{risk}\
             risk_investigation_time = {RISK_YEARS}\n"
        );
        files.push(("job_classical_damage.ini".to_owned(), job.into_bytes()));
    }
    let metadata = json!({
        "version": env!("CARGO_PKG_VERSION"),
        "objects": listed.objects.iter().map(|object| object.metadata(report)).collect::<Vec<_>>(),
        "imt": imt.name,
        "factor_to_imt": imt.factor,
        "units": "fragility.xml has means and standard deviations in the unit of OpenQuake (PGV in cm/s), not medians",
        "currency": listed.currency,
        "hazard": hazard.map(|hazard| json!({
            "investigation_time_yr": 1, "risk_investigation_time_yr": RISK_YEARS,
            "largest_annual_rate": MAX_RATE,
            "beyond_the_last_point": "counted as motions of the last point, as freestand risk does",
            "file": hazard.file.as_ref().map(|file| json!({"path": file.path.display().to_string(), "sha256": file.sha256})),
        })),
        "sources": sources(report),
    });
    files.push((
        "metadata.json".to_owned(),
        document("freestand.openquake/1", &metadata, &[])?.into_bytes(),
    ));
    Ok(files)
}

/// Coordinates as OpenQuake keeps them, with five decimals (1 m).
fn round(degrees: f64) -> f64 {
    (degrees * 1e5).round() / 1e5
}

#[cfg(test)]
mod tests {
    use super::*;

    /// mean and standard deviation of a lognormal number give back its median and β.
    #[test]
    fn moments_are_those_of_the_median() {
        let (mean, stddev) = moments((30.0, 0.25));
        let beta = (1.0 + (stddev / mean).powi(2)).ln().sqrt();
        assert!(
            (beta - 0.25).abs() < 1e-14 && (mean * (-0.5 * beta * beta).exp() - 30.0).abs() < 1e-12
        );
    }

    #[test]
    fn only_measures_of_the_ground_are_exported() {
        let pgv = Imt {
            name: "PGV".to_owned(),
            factor: 100.0,
        };
        assert_eq!(imt_of(Measure::Pgv, At::Ground), Ok(pgv));
        assert_eq!(
            imt_of(Measure::Sa { period_s: 0.5 }, At::Ground).map(|imt| imt.name),
            Ok("SA(0.5)".to_owned())
        );
        for (measure, at) in [
            (Measure::Pfv, At::Floor),
            (Measure::Sa { period_s: 0.5 }, At::Floor),
        ] {
            assert!(
                imt_of(measure, at)
                    .unwrap_err()
                    .hint
                    .is_some_and(|hint| hint.contains("pgv"))
            );
        }
    }

    /// At least 300 levels, the points of the curve among them, and its tail at its last point.
    #[test]
    fn a_hazard_has_many_levels_and_its_tail() {
        let point = |intensity, annual_rate| freestand::risk::HazardPoint {
            intensity,
            annual_rate,
        };
        let hazard =
            Hazard::points(vec![point(0.01, 40.0), point(0.1, 1e-2), point(1.0, 1e-4)]).unwrap();
        let levels = levels(&hazard, &[]);
        assert!(
            levels.len() >= 300 && levels.iter().any(|(x, _)| *x == 0.1),
            "{}",
            levels.len()
        );
        assert!(
            levels
                .windows(2)
                .all(|pair| pair[0].0 < pair[1].0 && pair[0].1 > pair[1].1)
        );
        assert!(levels[0].1 <= MAX_RATE, "{:?}", levels[0]);
        assert!(levels.contains(&(1.0, 1e-4)));
        // k = 2: a ten thousandth at 100 times the intensity. Rounding keeps the last step of 600 out.
        let (end, tail) = (levels[levels.len() - 2], levels[levels.len() - 1]);
        assert!(
            end.0 > 98.0 && end.0 <= 100.0 && (end.1 * end.0 * end.0 / 1e-4 - 1.0).abs() < 1e-9,
            "{end:?}"
        );
        // A product of two rounded numbers.
        assert!(
            tail.0 < 100.0 + 2e-4 && (tail.1 / end.1 / 1e-9 - 1.0).abs() < 1e-12,
            "{tail:?}"
        );
    }
}
