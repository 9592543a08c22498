//! Hazard curves of USGS: the tables of nshmp-haz and the answers of its web services.

use std::path::Path;

use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;
use serde_json::Value as Json;

use super::numbers::{Exceedance, PGV_M_S, Value, coordinates, curve, measure};
use super::sites::{Chosen, Site, Wanted, chosen};
use super::table::{Head, Table};
use super::{Coordinates, Curve, GroundMeasure, HazardFormat, SiteHazard};

const DOWNLOAD: &str = "download the file again";

/// `name,lon,lat,0.005,0.007,…`
pub(super) fn is_table(head: &Head) -> bool {
    let names: Vec<String> = head
        .headings
        .iter()
        .take(3)
        .map(|name| name.to_lowercase())
        .collect();
    let levels = head.headings.get(3..).unwrap_or_default();
    names == ["name", "lon", "lat"]
        && levels.len() > 1
        && levels.iter().all(|name| name.parse::<f64>().is_ok())
}

/// The measure of a table is the name of its folder, `PGA/curves.csv`, or stands in that of the file.
pub(super) fn curves_table(
    table: &Table,
    path: &Path,
    wanted: &Wanted,
) -> Result<SiteHazard, Problem> {
    let folder = path.parent().and_then(Path::file_name);
    let words: Vec<String> = [folder, path.file_stem()]
        .into_iter()
        .flatten()
        .flat_map(|name| {
            let name = name.to_string_lossy().into_owned();
            let parts: Vec<String> = name
                .split(['-', '_', '.', ' '])
                .map(str::to_owned)
                .collect();
            parts
        })
        .collect();
    let found = words
        .iter()
        .find_map(|word| measure(word))
        .or(wanted.measure.map(|measure| (measure, factor_of(measure))));
    let Some((measure, factor)) = found else {
        let message = "the file does not say whether its intensities are PGA, PGV or SA".to_owned();
        let hint = "keep the folder of nshmp-haz, such as PGA/curves.csv, or name the file PGA.csv or SA0P2.csv";
        return Err(table.head.problem(message, hint));
    };
    let (mut out, row) = table.site(HazardFormat::UsgsCurves, [1, 2], Some(0), wanted)?;
    let mut points = Vec::new();
    for column in 3..table.head.headings.len() {
        let name = &table.head.headings[column];
        let level = Value {
            number: factor * name.parse::<f64>().unwrap_or(f64::NAN),
            place: format!("column {}", column + 1),
            line: Some(table.head.line),
        };
        points.push((level, table.number(row, column)?));
    }
    let curve =
        curve(measure, points, Exceedance::Rates).map_err(|problem| problem.at_line(row.line))?;
    out.curves.push(curve);
    Ok(out)
}

/// nshmp-haz writes PGV in cm/s.
fn factor_of(measure: GroundMeasure) -> f64 {
    if measure == GroundMeasure::Pgv {
        PGV_M_S
    } else {
        1.0
    }
}

/// The most that is looked at to tell formats of JSON apart: both kinds of answer name what they have in their first
/// kilobytes, and a document is parsed once.
pub(super) fn json_format(bytes: &[u8]) -> Option<HazardFormat> {
    let has = |word: &str| memchr::memmem::find(bytes, word.as_bytes()).is_some();
    let is_curve = (has("\"imt\"") || has("hazardCurves"))
        && (has("\"xvals\"") || has("\"xvalues\"") || has("\"xs\""));
    match () {
        () if is_curve => Some(HazardFormat::UsgsCurvesJson),
        () if has("\"ss\"") && has("\"s1\"") || has("\"multiPeriodDesignSpectrum\"") => {
            Some(HazardFormat::UsgsDesign)
        }
        () => None,
    }
}

pub(super) fn document(bytes: &[u8]) -> Result<Json, Problem> {
    serde_json::from_slice(bytes).map_err(|error| {
        let message = format!("the JSON is damaged: {error}");
        Problem::format(message, "download the file again: it may be cut off").at_line(error.line())
    })
}

/// Where a document says that its site is.
pub(super) fn site_of(places: &[&Json]) -> Result<Option<Coordinates>, Problem> {
    let number = |name: &str| {
        places.iter().find_map(|one| {
            // Coordinates of a request may be texts.
            let value = one.get(name)?;
            let number = value
                .as_f64()
                .or_else(|| value.as_str()?.trim().parse::<f64>().ok())?;
            Some(Value {
                number,
                place: name.to_owned(),
                line: None,
            })
        })
    };
    match (number("longitude"), number("latitude")) {
        (Some(longitude), Some(latitude)) => coordinates(&longitude, &latitude).map(Some),
        _ => Ok(None),
    }
}

/// Numbers of a list; `place` says where it stands.
pub(super) fn numbers(list: Option<&Json>, place: &str) -> Result<Vec<Value>, Problem> {
    let Some(list) = list.and_then(Json::as_array) else {
        let message = format!("{place} is missing, or not a list of numbers");
        return Err(Problem::format(message, DOWNLOAD));
    };
    let value = |(k, one): (usize, &Json)| {
        let place = format!("{place}[{k}]");
        match one.as_f64() {
            Some(number) => Ok(Value {
                number,
                place,
                line: None,
            }),
            None => {
                let message = format!("{place}: {} is not a number", shorten(&one.to_string()));
                Err(Problem::value(message, DOWNLOAD))
            }
        }
    };
    list.iter().enumerate().map(value).collect()
}

/// Curves as the web services answer them: `response[].metadata.{imt, xvals}` with `response[].data[].yvals`, both also
/// `…values`, and `response.hazardCurves[].data[].values.{xs, ys}`.
pub(super) fn curves_json(bytes: &[u8], wanted: &Wanted) -> Result<SiteHazard, Problem> {
    let document = document(bytes)?;
    let response = document.get("response").unwrap_or(&document);
    let newer = response.get("hazardCurves");
    let (list, name) = match newer {
        Some(list) => (list, "response.hazardCurves"),
        None => (response, "response"),
    };
    let empty = Vec::new();
    let entries = list.as_array().unwrap_or(&empty);
    let mut curves: Vec<Curve> = Vec::new();
    let mut site = site_of(&[&document, response, request(&document), metadata(response)])?;
    for (k, entry) in entries.iter().enumerate() {
        let place = format!("{name}[{k}]");
        let head = if newer.is_some() {
            entry
        } else {
            metadata(entry)
        };
        if site.is_none() {
            site = site_of(&[head])?;
        }
        let imt = head.get("imt");
        let imt = imt
            .and_then(|imt| imt.get("value").unwrap_or(imt).as_str())
            .unwrap_or_default();
        let Some((measure, factor)) = measure(imt) else {
            let message = format!("{place}: the measure \"{}\" is not known", shorten(imt));
            return Err(Problem::format(
                message,
                "download curves of PGA, PGV or SA",
            ));
        };
        let data = entry.get("data").and_then(Json::as_array).unwrap_or(&empty);
        // The sum over all sources; others are its parts.
        let total = data
            .iter()
            .find(|one| one.get("component").and_then(Json::as_str) == Some("Total"))
            .or(data.first());
        let values = total.and_then(|one| one.get("values"));
        let of = |keys: [&str; 2], from: Option<&Json>, other: [&str; 1]| {
            let found = keys.iter().find_map(|key| from?.get(key));
            found.or_else(|| values?.get(other[0])).cloned()
        };
        let xs = of(["xvals", "xvalues"], Some(head), ["xs"]);
        let ys = of(["yvals", "yvalues"], total, ["ys"]);
        let xs = numbers(xs.as_ref(), &format!("{place}: the intensities"))?;
        let ys = numbers(ys.as_ref(), &format!("{place}: the rates"))?;
        if xs.len() != ys.len() {
            let message = format!(
                "{place} has {} intensities and {} rates",
                xs.len(),
                ys.len()
            );
            return Err(Problem::format(message, DOWNLOAD));
        }
        let scaled = xs.into_iter().map(|x| Value {
            number: factor * x.number,
            ..x
        });
        curves.push(curve(measure, scaled.zip(ys), Exceedance::Rates)?);
    }
    if curves.is_empty() {
        let message = "the document has no hazard curve in `response`";
        return Err(Problem::format(message, DOWNLOAD));
    }
    let sites = [Site {
        line: None,
        name: None,
        at: site,
    }];
    let Chosen { distance_km, .. } = chosen(&sites, wanted)?;
    Ok(SiteHazard {
        at: site,
        distance_km,
        curves,
        ..SiteHazard::of(HazardFormat::UsgsCurvesJson)
    })
}

fn metadata(of: &Json) -> &Json {
    of.get("metadata").unwrap_or(&Json::Null)
}

pub(super) fn request(document: &Json) -> &Json {
    let request = document.get("request").unwrap_or(&Json::Null);
    request.get("parameters").unwrap_or(request)
}
