//! Tables of OpenQuake: curves, uniform hazard spectra and maps, and those of AELO.

use std::path::Path;

use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;

use super::numbers::{Exceedance, Value, curve, measure, return_period, spectrum, years};
use super::sites::Wanted;
use super::table::{Head, Row, Table};
use super::{GroundMeasure, HazardFormat, SiteHazard, Statistic};

/// The key in the comment above the headings that states the periods of AvgSA, as `sa_avg(0.2:2)`;
/// we write it, and OpenQuake keeps what it does not know.
pub const AVERAGE_KEY: &str = "measure";

const AS_WRITTEN: &str = "give the file as OpenQuake wrote it, with its first line";

pub(super) fn format_of(head: &Head) -> Option<HazardFormat> {
    let has = |part: &str| head.headings.iter().any(|one| one.contains(part));
    let is_sited = head.column("lon").is_some() && head.column("lat").is_some();
    let starts = |start: &str| head.headings.iter().any(|one| one.starts_with(start));
    let first = head.headings.first().map_or("", String::as_str);
    match () {
        () if is_sited && starts("poe-") => Some(HazardFormat::OpenquakeCurves),
        () if is_sited && has("~") => Some(HazardFormat::OpenquakeSpectra),
        () if is_sited && (starts("PGA-0") || starts("PGV-0") || starts("SA(")) => {
            Some(HazardFormat::OpenquakeMap)
        }
        () if is_sited && starts("PGA") && head.comments.contains("OpenQuake") => {
            Some(HazardFormat::OpenquakeMap)
        }
        () if matches!(first, "" | "period" | "imt") && starts("poe-") => Some(HazardFormat::Aelo),
        () => None,
    }
}

/// What the comment states under a key.
fn stated<'c>(head: &'c Head, key: &str) -> Result<Option<&'c str>, Problem> {
    let name = format!("{key}=");
    let mut found = head.comments.match_indices(&name).map(|(at, _)| {
        let rest = &head.comments[at + name.len()..];
        // An apostrophe closes what it opens: `measure='sa_avg(0.2:2)'`.
        let end = rest.find([',', '"']).unwrap_or(rest.len());
        rest[..end].trim().trim_matches('\'')
    });
    let first = found.next();
    match (first, found.find(|other| Some(*other) != first)) {
        (Some(one), Some(other)) => {
            let message = format!(
                "the comment above the headings states two values of {key}, {} and {}",
                shorten(one),
                shorten(other)
            );
            Err(head.problem(message, AS_WRITTEN))
        }
        _ => Ok(first),
    }
}

fn needed<'c>(head: &'c Head, key: &str) -> Result<&'c str, Problem> {
    stated(head, key)?.ok_or_else(|| {
        let message = format!("the comment above the headings does not state {key}");
        head.problem(message, AS_WRITTEN)
    })
}

/// Which of the results of its hazard model it is.
fn statistic(head: &Head) -> Result<Option<Statistic>, Problem> {
    match stated(head, "kind")? {
        Some("std") => Err(head.problem(
            "the file has standard deviations between models, which are no hazard".to_owned(),
            "give the file of the mean, such as hazard_curve-mean-PGA_1.csv",
        )),
        kind => Ok(kind.map(Statistic::of)),
    }
}

/// The return period in the name of a file, `hazard_map-mean-475y_1.csv`: a map of one return period states it nowhere else.
fn years_of_name(path: &Path) -> Option<f64> {
    let name = path.file_stem()?.to_str()?;
    let years = |part: &str| part.strip_suffix('y')?.parse::<f64>().ok();
    name.split(['-', '_'])
        .find_map(years)
        .filter(|years| *years > 0.0 && years.is_finite())
}

/// A map of one return period: `lon,lat,PGA,SA(0.2)`, as the engine writes it since its version 3.
fn map_of_one(table: &Table, path: &Path, wanted: &Wanted) -> Result<SiteHazard, Problem> {
    let head = &table.head;
    let years = years_of_name(path).ok_or_else(|| {
        let message =
            "neither the headings nor the name of the file state the return period of the map";
        head.problem(
            message.to_owned(),
            "give the file the name that OpenQuake gave it, such as hazard_map-mean-475y_1.csv",
        )
    })?;
    let (mut out, row) = table.site(
        HazardFormat::OpenquakeMap,
        table.place_columns()?,
        None,
        wanted,
    )?;
    out.statistic = statistic(head)?;
    let mut values: Vec<(f64, Value)> = Vec::new();
    for (column, name) in head.headings.iter().enumerate() {
        if let Some(period_s) = measure(name).and_then(|(measure, _)| measure.period_s()) {
            values.push((period_s, table.number(row, column)?));
        }
    }
    out.spectra = spectra(vec![(years, values)], head)?;
    Ok(out)
}

pub(super) fn read(
    table: &Table,
    path: &Path,
    format: HazardFormat,
    wanted: &Wanted,
) -> Result<SiteHazard, Problem> {
    let head = &table.head;
    let is_map = format == HazardFormat::OpenquakeMap;
    if is_map && !head.headings.iter().any(|name| name.contains('-')) {
        return map_of_one(table, path, wanted);
    }
    let years =
        years(needed(head, "investigation_time")?).map_err(|problem| problem.at_line(head.line))?;
    let mut out = SiteHazard::of(format);
    out.statistic = statistic(head)?;
    if format == HazardFormat::Aelo {
        out.spectra = by_measure(table, years)?;
        return Ok(out);
    }
    let statistic = out.statistic;
    let (mut out, row) = table.site(format, table.place_columns()?, None, wanted)?;
    out.statistic = statistic;
    match format {
        HazardFormat::OpenquakeCurves => out.curves.push(hazard_curve(table, row, years)?),
        _ => out.spectra = by_probability(table, row, years, format)?,
    }
    Ok(out)
}

/// The curve of a row: `poe-0.1` and so on, probabilities in the investigation time.
fn hazard_curve(table: &Table, row: &Row, years: f64) -> Result<super::Curve, Problem> {
    let head = &table.head;
    let (measure, factor) = curve_measure(head)?;
    let mut points = Vec::new();
    let mut before: Option<f64> = None;
    for (column, name) in head.headings.iter().enumerate() {
        let Some(text) = name.strip_prefix("poe-") else {
            continue;
        };
        let place = format!("column {}", column + 1);
        let level = text.parse::<f64>().ok();
        let Some(level) = level.filter(|level| *level > 0.0 && level.is_finite()) else {
            let message = format!("{place}: \"{}\" states no intensity", shorten(name));
            let hint = "write poe- and an intensity above 0, such as poe-0.1";
            return Err(head.problem(message, hint));
        };
        if before.replace(level).is_some_and(|before| before >= level) {
            let message = format!(
                "{place}: \"{}\" is not above the intensity before it",
                shorten(name)
            );
            let hint = "sort the columns by rising intensity, and give each intensity once";
            return Err(head.problem(message, hint));
        }
        let level = Value {
            number: factor * level,
            place,
            line: Some(head.line),
        };
        points.push((level, table.number(row, column)?));
    }
    curve(measure, points, Exceedance::Probabilities { years })
        .map_err(|problem| problem.at_line(row.line))
}

/// The measure of a file of curves, and the factor from its unit.
fn curve_measure(head: &Head) -> Result<(GroundMeasure, f64), Problem> {
    let imt = needed(head, "imt")?;
    if imt == "AvgSA" {
        // OpenQuake takes the periods from the job and does not write them: without them
        // nothing tells whether it is the measure of the outcomes.
        let text = stated(head, AVERAGE_KEY)?.unwrap_or_default();
        return average(text).map(|measure| (measure, 1.0)).ok_or_else(|| {
            let message = if text.is_empty() {
                format!("the comment above the headings does not state the periods of AvgSA as {AVERAGE_KEY}")
            } else {
                let text = shorten(text);
                format!("the {AVERAGE_KEY} \"{text}\" of AvgSA does not state its periods")
            };
            let hint = format!(
                "add the shortest and the longest period of the job in s to the comment, \
                 such as imt='AvgSA', {AVERAGE_KEY}='sa_avg(0.2:2)'"
            );
            head.problem(message, &hint)
        });
    }
    measure(imt).ok_or_else(|| {
        let message = format!(
            "the measure {} is not one of PGA, PGV, SA and AvgSA",
            shorten(imt)
        );
        head.problem(message, "export hazard curves of PGA, PGV, SA or AvgSA")
    })
}

/// `sa_avg(0.2:2)`.
fn average(text: &str) -> Option<GroundMeasure> {
    let inside = text.strip_prefix("sa_avg(")?.strip_suffix(')')?;
    let (from, to) = inside.split_once(':')?;
    let (from_s, to_s) = (from.trim().parse().ok()?, to.trim().parse().ok()?);
    (0.0 < from_s && from_s < to_s && f64::is_finite(to_s))
        .then_some(GroundMeasure::SaAverage { from_s, to_s })
}

/// The spectra of a row, one for each probability: `0.002105~SA(0.2)` or `SA(0.2)-0.002105`. Measures that are no spectral
/// acceleration are passed over.
fn by_probability(
    table: &Table,
    row: &Row,
    years: f64,
    format: HazardFormat,
) -> Result<Vec<super::ReturnSpectrum>, Problem> {
    let mut groups: Vec<(f64, Vec<(f64, Value)>)> = Vec::new();
    for (column, name) in table.head.headings.iter().enumerate() {
        let parts = match format {
            HazardFormat::OpenquakeSpectra => name.split_once('~'),
            _ => name.split_once('-').map(|(imt, poe)| (poe, imt)),
        };
        let Some((poe, imt)) = parts else { continue };
        let Some(period_s) = measure(imt).and_then(|(measure, _)| measure.period_s()) else {
            continue;
        };
        let value = table.number(row, column)?;
        put(
            &mut groups,
            probability(&table.head, name, poe, years)?,
            (period_s, value),
        );
    }
    spectra(groups, &table.head)
}

/// One row for each measure or period: `,poe-0.02,…` above `PGA,…` or `0.2,…`.
fn by_measure(table: &Table, years: f64) -> Result<Vec<super::ReturnSpectrum>, Problem> {
    let mut groups: Vec<(f64, Vec<(f64, Value)>)> = Vec::new();
    for row in &table.rows {
        let name = table.text(row, 0);
        let period_s = match (name.parse::<f64>(), measure(name)) {
            (Ok(period_s), _) => period_s,
            (_, Some((measure, _))) => match measure.period_s() {
                Some(period_s) => period_s,
                None => continue,
            },
            _ => {
                let message = format!("\"{}\" is no period and no measure", shorten(name));
                return Err(
                    Problem::value(message, "write PGA, SA(0.2) or a period in s")
                        .at_line(row.line),
                );
            }
        };
        for (column, heading) in table.head.headings.iter().enumerate() {
            let Some(poe) = heading.strip_prefix("poe-") else {
                continue;
            };
            let value = table.number(row, column)?;
            put(
                &mut groups,
                probability(&table.head, heading, poe, years)?,
                (period_s, value),
            );
        }
    }
    spectra(groups, &table.head)
}

fn put(groups: &mut Vec<(f64, Vec<(f64, Value)>)>, years: f64, value: (f64, Value)) {
    match groups.iter_mut().find(|group| group.0 == years) {
        Some(group) => group.1.push(value),
        None => groups.push((years, vec![value])),
    }
}

fn probability(head: &Head, name: &str, text: &str, years: f64) -> Result<f64, Problem> {
    let poe = text.parse::<f64>().ok();
    poe.and_then(|poe| return_period(poe, years))
        .ok_or_else(|| {
            let message = format!(
                "\"{}\" states no probability between 0 and 1",
                shorten(name)
            );
            head.problem(message, AS_WRITTEN)
        })
}

fn spectra(
    mut groups: Vec<(f64, Vec<(f64, Value)>)>,
    head: &Head,
) -> Result<Vec<super::ReturnSpectrum>, Problem> {
    groups.sort_by(|a, b| a.0.total_cmp(&b.0));
    if groups.is_empty() {
        let message = "no column holds a peak or a spectral acceleration".to_owned();
        return Err(head.problem(message, "export PGA and SA"));
    }
    groups
        .into_iter()
        .map(|(years, values)| spectrum(Some(years), values))
        .collect()
}
