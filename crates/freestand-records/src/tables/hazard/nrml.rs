//! NRML, the XML of EFEHR (0.3) and of OpenQuake (0.4, 0.5): curves and uniform hazard spectra.

use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;
use roxmltree::{Document, Node, ParsingOptions};

use super::numbers::{
    Exceedance, Value, coordinates, curve, measure, return_period, spectrum, years,
};
use super::sites::{Chosen, Site, Wanted, chosen};
use super::{
    Coordinates, Curve, GroundMeasure, HazardFormat, ReturnSpectrum, SiteHazard, Statistic,
};

const DOWNLOAD: &str = "download the file again: it may be cut off";
/// Most XML nodes; each takes some tens of bytes while the file is read.
const MAX_NODES: u32 = 20_000_000;

/// Whether the beginning of a document names NRML.
pub(super) fn is_it(bytes: &[u8]) -> bool {
    let start = &bytes[..bytes.len().min(4096)];
    memchr::memmem::find(start, b"nrml").is_some()
        && memchr::memmem::find(bytes, b"azard").is_some()
}

/// The attributes that name the branches of a realization.
const BRANCHES: [&str; 2] = ["sourceModelTreePath", "gsimTreePath"];

/// A curve or a spectrum of a site, not yet judged.
struct Found<'d> {
    at: Option<Coordinates>,
    line: usize,
    node: Node<'d, 'd>,
    field: Node<'d, 'd>,
}

pub(super) fn read(bytes: &[u8], wanted: &Wanted) -> Result<SiteHazard, Problem> {
    let text = std::str::from_utf8(bytes)
        .map_err(|_| Problem::format("is not UTF-8", "download the file again"))?;
    let options = ParsingOptions {
        nodes_limit: MAX_NODES,
        ..ParsingOptions::default()
    };
    let document = Document::parse_with_options(text, options).map_err(|error| {
        // The end has no place of its own.
        let line = match error {
            roxmltree::Error::UnexpectedEndOfStream => text.lines().count(),
            _ => error.pos().row as usize,
        };
        Problem::format(format!("the XML is damaged: {error}"), DOWNLOAD).at_line(line)
    })?;
    let is_curve = |node: &Node| {
        named(*node, &["hazardCurve", "HCNode"]) && first(*node, &["poE", "poEs"]).is_some()
    };
    let is_spectrum = |node: &Node| named(*node, &["uhs", "UHSNode"]);
    let mut found: Vec<Found> = Vec::new();
    for node in document
        .descendants()
        .filter(|node| is_curve(node) || is_spectrum(node))
    {
        // In NRML 0.3 the curve is within the node of its site, which has it already.
        if node
            .ancestors()
            .skip(1)
            .any(|one| is_curve(&one) || is_spectrum(&one))
        {
            continue;
        }
        let line = document.text_pos_at(node.range().start).row as usize;
        found.push(Found {
            at: position(&document, node)?,
            line,
            node,
            field: node.parent().unwrap_or(node),
        });
    }
    if found.is_empty() {
        return Err(Problem::format(
            "the document has no hazard curve and no uniform hazard spectrum",
            "download a curve or a spectrum: EFEHR gives them for coordinates",
        ));
    }
    // A site may have a curve for each of several measures.
    let mut sites: Vec<Site> = Vec::new();
    for one in &found {
        if !sites.iter().any(|site| site.at == one.at) {
            sites.push(Site {
                line: Some(one.line),
                name: None,
                at: one.at,
            });
        }
    }
    let Chosen { index, distance_km } = chosen(&sites, wanted)?;
    let mut out = SiteHazard {
        sites: sites.len(),
        at: sites[index].at,
        distance_km,
        ..SiteHazard::of(HazardFormat::Nrml)
    };
    let here: Vec<&Found> = found.iter().filter(|one| one.at == out.at).collect();
    out.statistic = here.first().and_then(|one| statistic(one));
    for one in &here {
        let at_line = |problem: Problem| problem.at_line(one.line);
        let is_other = |name: &&str| attribute(one, &[*name]) != attribute(here[0], &[*name]);
        if statistic(one) != out.statistic || BRANCHES.iter().any(is_other) {
            let message = "the document has several statistics or realizations of one site, such as a mean and a quantile";
            return Err(at_line(Problem::format(
                message,
                "leave only the mean in the file",
            )));
        }
        if is_curve(&one.node) {
            let curve = hazard_curve(&document, one).map_err(at_line)?;
            if out
                .curves
                .iter()
                .any(|other| other.measure == curve.measure)
            {
                let message = "the document has two curves of one measure at this site";
                return Err(at_line(Problem::format(
                    message,
                    "leave one of them in the file",
                )));
            }
            out.curves.push(curve);
        } else {
            out.spectra
                .push(uniform_spectrum(&document, one).map_err(at_line)?);
        }
    }
    out.spectra
        .sort_by(|a, b| a.years.unwrap_or(0.0).total_cmp(&b.years.unwrap_or(0.0)));
    Ok(out)
}

fn named(node: Node, names: &[&str]) -> bool {
    node.is_element() && names.contains(&node.tag_name().name())
}

fn first<'d>(node: Node<'d, 'd>, names: &[&str]) -> Option<Node<'d, 'd>> {
    node.descendants().find(|one| named(*one, names))
}

/// The list of a site, or that which all sites of its field share.
fn list<'d>(one: &Found<'d>, names: &[&str]) -> Option<Node<'d, 'd>> {
    let shared = || one.field.children().find(|child| named(*child, names));
    first(one.node, names).or_else(shared)
}

/// An attribute of the curve or of what it stands in; in NRML 0.3 the years and the period are in `config`.
fn attribute<'d>(one: &Found<'d>, names: &[&str]) -> Option<&'d str> {
    let of = |node: Node<'d, 'd>| names.iter().find_map(|name| node.attribute(*name));
    one.node.ancestors().find_map(of).or_else(|| {
        let root = one.node.document().root_element();
        root.descendants()
            .filter(|node| named(*node, &["hazardProcessing", "IML", "IMLs"]))
            .find_map(of)
    })
}

/// Which of the results of its hazard model a curve is. The value of a quantile stands beside every statistic, also beside a mean.
///
/// # Reference
/// OpenQuake, `ClassicalHazardCase7TestCase` of its `qa_tests`: the curve of a realization has the branches of its logic trees, and
/// no `statistics`.
fn statistic(one: &Found) -> Option<Statistic> {
    match attribute(one, &["statistics"]) {
        Some("quantile") => Some(
            attribute(one, &["quantileValue"])
                .and_then(Statistic::quantile)
                .unwrap_or_else(|| Statistic::of("quantile")),
        ),
        Some(kind) => Some(Statistic::of(kind)),
        None => attribute(one, &BRANCHES).map(|_| Statistic::Realization),
    }
}

fn position(document: &Document, node: Node) -> Result<Option<Coordinates>, Problem> {
    let Some(pos) = node.descendants().find(|one| named(*one, &["pos"])) else {
        return Ok(None);
    };
    let line = document.text_pos_at(pos.range().start).row as usize;
    let numbers: Vec<Value> = values(document, pos)?;
    match numbers.as_slice() {
        // Longitude first.
        [longitude, latitude, ..] => coordinates(longitude, latitude).map(Some),
        _ => {
            let text = shorten(pos.text().unwrap_or_default());
            let message = format!("\"{text}\" is not a longitude and a latitude");
            Err(Problem::format(message, DOWNLOAD).at_line(line))
        }
    }
}

/// The numbers of an element.
fn values(document: &Document, node: Node) -> Result<Vec<Value>, Problem> {
    let line = document.text_pos_at(node.range().start).row as usize;
    let name = node.tag_name().name();
    node.text()
        .unwrap_or_default()
        .split_whitespace()
        .enumerate()
        .map(|(k, word)| {
            let place = format!("{name}, value {}", k + 1);
            match word.parse::<f64>() {
                Ok(number) => Ok(Value {
                    number,
                    place,
                    line: Some(line),
                }),
                Err(_) => {
                    let message = format!("{place}: \"{}\" is not a number", shorten(word));
                    Err(Problem::value(message, DOWNLOAD).at_line(line))
                }
            }
        })
        .collect()
}

fn missing(what: &str) -> Problem {
    Problem::format(format!("the document does not have {what}"), DOWNLOAD)
}

fn investigation(one: &Found) -> Result<f64, Problem> {
    let text = attribute(one, &["investigationTime", "investigationTimeSpan"])
        .ok_or_else(|| missing("investigationTime, the years of its probabilities"))?;
    years(text)
}

/// A list of values.
struct Listed<'d> {
    /// Where it stands.
    node: Option<Node<'d, 'd>>,
    /// What it is called.
    name: &'static str,
}

/// Two lists of one length.
fn pairs(document: &Document, [one, two]: [Listed; 2]) -> Result<Vec<(Value, Value)>, Problem> {
    let names = [one.name, two.name];
    let of = |list: Listed| values(document, list.node.ok_or_else(|| missing(list.name))?);
    let (one, two) = (of(one)?, of(two)?);
    if one.len() != two.len() {
        let message = format!(
            "there are {} values of {} and {} of {}",
            one.len(),
            names[0],
            two.len(),
            names[1]
        );
        return Err(Problem::format(message, DOWNLOAD));
    }
    Ok(one.into_iter().zip(two).collect())
}

fn hazard_curve(document: &Document, one: &Found) -> Result<Curve, Problem> {
    let years = investigation(one)?;
    let levels = list(one, &["IML", "IMLs"]);
    let imt = levels
        .and_then(|node| node.attribute("IMT"))
        .or_else(|| attribute(one, &["IMT"]))
        .ok_or_else(|| missing("IMT, the measure of its intensities"))?;
    check_damping(one)?;
    let (measure, factor) = match (imt, attribute(one, &["saPeriod"])) {
        ("SA", Some(text)) => {
            let period_s = text
                .parse::<f64>()
                .ok()
                .filter(|one| *one > 0.0 && one.is_finite());
            let period_s = period_s.ok_or_else(|| missing("saPeriod above 0"))?;
            (GroundMeasure::Sa { period_s }, 1.0)
        }
        _ => measure(imt).ok_or_else(|| {
            let message = format!("the measure {} is not one of PGA, PGV and SA", shorten(imt));
            Problem::format(message, "download a curve of PGA, PGV or SA")
        })?,
    };
    let levels = Listed {
        node: levels,
        name: "IML",
    };
    let chances = Listed {
        node: first(one.node, &["poE", "poEs"]),
        name: "poE",
    };
    let points = pairs(document, [levels, chances])?;
    let scaled = points.into_iter().map(|(x, y)| {
        let number = factor * x.number;
        (Value { number, ..x }, y)
    });
    curve(measure, scaled, Exceedance::Probabilities { years })
}

/// Spectral accelerations hold for a damping of 5 %, which files write as a share or in percent.
fn check_damping(one: &Found) -> Result<(), Problem> {
    match attribute(one, &["saDamping"]) {
        Some(text) if !matches!(text.trim().parse(), Ok(0.05 | 5.0)) => Err(Problem::format(
            format!(
                "the damping of the accelerations is {}, not 5 %",
                shorten(text)
            ),
            "download a curve or a spectrum of 5 % damping",
        )),
        _ => Ok(()),
    }
}

fn uniform_spectrum(document: &Document, one: &Found) -> Result<ReturnSpectrum, Problem> {
    check_damping(one)?;
    let poe = attribute(one, &["poE", "poe"])
        .ok_or_else(|| missing("poE, the probability of the spectrum"))?;
    let years = investigation(one)?;
    let found = poe.trim().parse::<f64>().ok();
    let years = found
        .and_then(|poe| return_period(poe, years))
        .ok_or_else(|| {
            let message = format!(
                "poE \"{}\" is not a probability between 0 and 1",
                shorten(poe)
            );
            Problem::value(message, DOWNLOAD)
        })?;
    let periods = Listed {
        node: list(one, &["periods", "period"]),
        name: "periods",
    };
    let levels = Listed {
        node: first(one.node, &["IMLs", "IML"]),
        name: "IMLs",
    };
    let points = pairs(document, [periods, levels])?;
    spectrum(
        Some(years),
        points
            .into_iter()
            .map(|(period, value)| (period.number, value)),
    )
}
