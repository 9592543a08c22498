//! Fragilities as folders for other programs: pelicun and the OpenQuake engine.

mod openquake;
mod pelicun;
mod points;

pub use openquake::{Exposed, exposure_of_sites};

use std::collections::BTreeSet;
use std::path::PathBuf;

use freestand::fragility::{CurveKind, FitKind, LimitState};
use freestand_input::problem::{Problem, ProblemKind, Problems};
use freestand_input::quantity::shorten;
use freestand_input::words::Choices;
use freestand_output::rows::csv;
use serde_json::{Value, json};
use strum::EnumCount;

use crate::costs::{CostDoubt, CostRow, Costs, load_costs};
use crate::fragility::{
    FragilityReport, HazardDoubt, HazardPlace, HazardSource, ObjectFragility, hazard_of,
};

use points::Points;

/// A program for which fragilities are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ExportFormat {
    /// `fragility.csv` alone.
    Csv,
    /// A folder for pelicun.
    Pelicun,
    /// A folder for the OpenQuake engine.
    OpenQuake,
}

/// Formats by name.
pub const FORMATS: Choices<ExportFormat> = &[
    (ExportFormat::Csv, "csv", "fragility.csv alone"),
    (
        ExportFormat::Pelicun,
        "pelicun",
        "a folder pelicun/ with a complete calculation for pelicun",
    ),
    (
        ExportFormat::OpenQuake,
        "openquake",
        "a folder openquake/ with complete jobs for the OpenQuake engine",
    ),
];

/// A folder for another program.
#[derive(Debug, Clone, PartialEq)]
pub struct ExportRequest {
    /// The program.
    pub format: ExportFormat,
    /// Intensity with its unit, of the scenario or of every realization.
    pub demand: Option<String>,
    /// Realizations of pelicun; `None`: 10,000.
    pub realizations: Option<u32>,
    /// β for states that have none.
    pub beta: Option<f64>,
    /// Points instead of lognormal curves: the shares of runs, or the probability of exceeding a
    /// tolerance that was fitted to the shocks.
    pub is_discrete: bool,
    /// Longitude and latitude for OpenQuake where the inventory has none \[degrees\].
    pub site_deg: Option<(f64, f64)>,
    /// Quantities, costs, floors and coordinates (CSV).
    pub inventory: Option<PathBuf>,
    /// How the cells of that list are read.
    pub list: freestand_inventory::CellsRequest,
    /// The hazard curve, for a second job of OpenQuake.
    pub hazard: Option<HazardSource>,
}

/// A folder for another program.
#[derive(Debug, Clone, PartialEq)]
pub struct Exported {
    /// Its files, by their paths in the output folder.
    pub files: Vec<(String, Vec<u8>)>,
    /// A file that repeats the doubts in words.
    pub metadata: Option<Metadata>,
    /// What to know beside them.
    pub doubts: Vec<ExportDoubt>,
}

/// A JSON document that is written with what there is to know beside the folder.
#[derive(Debug, Clone, PartialEq)]
pub struct Metadata {
    /// Its path in the output folder.
    pub path: String,
    /// Its schema.
    pub schema: &'static str,
    /// Its other keys.
    pub body: Value,
}

/// What to know beside a folder for another program.
#[derive(Debug, Clone, PartialEq, Eq, EnumCount)]
pub enum ExportDoubt {
    /// Of the costs.
    Cost(CostDoubt),
    /// Of the hazard.
    Hazard(HazardDoubt),
    /// An object that the inventory does not have: one without costs is exported.
    NotInInventory(String),
    /// An object of which there is none: it is not exported.
    NoneOfIt(String),
    /// Ids that the program does not accept were changed.
    ChangedIds {
        /// The program.
        format: ExportFormat,
        /// How many.
        count: usize,
        /// The first of them.
        id: String,
        /// What it became.
        exported: String,
        /// The characters that are allowed besides letters and digits.
        allowed: &'static str,
        /// The largest number of characters; `None`: no limit.
        longest: Option<usize>,
    },
    /// pelicun calls every cost dollars, but they are in this currency.
    InDollars(String),
    /// Objects without a replacement cost among others with costs.
    NoReplacement(Vec<String>),
}

/// Files of a folder, by their names in it.
pub type Files = Vec<(String, Vec<u8>)>;

/// The most realizations of pelicun.
const MAX_REALIZATIONS: u32 = 1_000_000;

/// Refuses more realizations than pelicun has rows for.
///
/// # Errors
/// More than a million.
pub fn check_realizations(realizations: Option<u32>) -> Result<(), Problem> {
    let Some(many) = realizations.filter(|many| *many > MAX_REALIZATIONS) else {
        return Ok(());
    };
    let message =
        format!("{many} realizations are too many: each is a row of the demands of pelicun");
    let hint = format!("give at most {MAX_REALIZATIONS}");
    Err(Problem::value(message, hint).of(&["realizations"]))
}

/// What can be checked of a request before there is a fit: its inventory.
///
/// # Errors
/// An inventory that cannot be read as one of quantities and costs.
pub fn check_export(request: &ExportRequest) -> Result<(), Problems> {
    check_realizations(request.realizations)?;
    if request.format != ExportFormat::Csv {
        request
            .inventory
            .as_deref()
            .map(|path| load_costs(path, &request.list))
            .transpose()?;
    }
    Ok(())
}

/// The files for another program.
///
/// # Errors
/// Fits or measures that the program does not have; a demand, a site or an inventory that is missing or
/// wrong.
pub fn export(report: &FragilityReport, request: &ExportRequest) -> Result<Exported, Problems> {
    let demand = request
        .demand
        .as_deref()
        .map(|text| report.table.measure.quantity(text))
        .transpose();
    let demand = demand.map_err(|problem| problem.named("demand"))?;
    let mut doubts = Vec::new();
    let (folder, ids) = match request.format {
        ExportFormat::Csv => {
            return Ok(Exported {
                files: Vec::new(),
                metadata: None,
                doubts,
            });
        }
        ExportFormat::Pelicun => ("pelicun", &PELICUN_IDS),
        ExportFormat::OpenQuake => ("openquake", &OPENQUAKE_IDS),
    };
    check_fit(report, request)?;
    let costs = request
        .inventory
        .as_deref()
        .map(|path| load_costs(path, &request.list))
        .transpose()?;
    let of_costs = costs.iter().flat_map(|costs| costs.doubts.clone());
    doubts.extend(of_costs.map(ExportDoubt::Cost));
    let objects = objects(report, request, costs.as_ref(), ids, &mut doubts)?;
    let listed = Listed {
        objects: &objects,
        currency: costs.as_ref().and_then(|costs| costs.currency.as_deref()),
    };
    let id_table = id_table(&objects, ids, request.format, &mut doubts)?;
    let mut metadata = None;
    let mut files = match request.format {
        ExportFormat::Csv => Vec::new(),
        ExportFormat::Pelicun => {
            if request.hazard.is_some() {
                let message = "pelicun does not read hazard curves";
                let hint = "leave out the hazard, or export for OpenQuake";
                return Err(Problem::value(message, hint).of(&["hazard"]).into());
            }
            let (files, body) = pelicun::files(report, request, &listed, demand, &mut doubts)?;
            metadata = Some(Metadata {
                path: format!("{folder}/metadata.json"),
                schema: "freestand.pelicun/1",
                body,
            });
            files
        }
        ExportFormat::OpenQuake => {
            let hazard = request
                .hazard
                .as_ref()
                .map(|source| {
                    let (measure, at) = (report.table.measure, report.at);
                    hazard_of(
                        source,
                        HazardPlace::OfOutcomes(at),
                        request.site_deg,
                        Some((measure, at)),
                    )
                })
                .transpose()?;
            // The coordinates are those of the objects, too.
            let of_hazard = hazard.iter().flat_map(|hazard| &hazard.doubts);
            doubts.extend(of_hazard.cloned().map(ExportDoubt::Hazard));
            openquake::files(
                report,
                request,
                &listed,
                demand,
                hazard.as_ref(),
                &mut doubts,
            )?
        }
    };
    files.extend(id_table);
    let files = files
        .into_iter()
        .map(|(name, bytes)| (format!("{folder}/{name}"), bytes))
        .collect();
    Ok(Exported {
        files,
        metadata,
        doubts,
    })
}

/// The objects of a folder, and the currency of their costs.
struct Listed<'a> {
    objects: &'a [ExportObject<'a>],
    currency: Option<&'a str>,
}

/// The curves of an object, as another program gets them.
enum Shape {
    /// Median and β of exceeding, if it has a tolerance, and of overturning.
    Lognormal {
        exceeds: Option<(f64, f64)>,
        overturns: (f64, f64),
    },
    /// Probabilities at common intensities.
    Points(Points),
}

impl Shape {
    fn has_exceeds(&self) -> bool {
        match self {
            Self::Lognormal { exceeds, .. } => exceeds.is_some(),
            Self::Points(points) => points.exceeds.is_some(),
        }
    }
}

/// An object with all that the folders of other programs state about it.
struct ExportObject<'a> {
    object: &'a ObjectFragility,
    /// Its id there.
    id: String,
    shape: Shape,
    quantity: f64,
    /// 0: the ground.
    floor: u32,
    site_deg: Option<(f64, f64)>,
    cost: Option<&'a CostRow>,
}

impl ExportObject<'_> {
    /// What `metadata.json` says of it.
    fn metadata(&self, report: &FragilityReport) -> Value {
        let curves = match &self.shape {
            Shape::Lognormal { exceeds, overturns } => {
                json!({"exceeds": exceeds, "overturns": overturns})
            }
            Shape::Points(points) => json!({"points": points.levels.len()}),
        };
        json!({
            "id": self.object.id, "exported_id": self.id, "im": report.table.measure.name(),
            "im_unit": report.table.measure.unit(), "at": report.at.name(),
            "fit": if matches!(self.shape, Shape::Points(_)) { "discrete" } else { "ordered" },
            "limit_states": if self.shape.has_exceeds() { &["exceeds", "overturns"][..] } else { &["overturns"] },
            "median_and_beta": curves, "motions": self.object.outcomes.motions(), "quantity": self.quantity,
        })
    }
}

fn objects<'a>(
    report: &'a FragilityReport,
    request: &ExportRequest,
    costs: Option<&'a Costs>,
    style: &IdStyle,
    doubts: &mut Vec<ExportDoubt>,
) -> Result<Vec<ExportObject<'a>>, Problem> {
    let names: Vec<&str> = report
        .objects
        .iter()
        .map(|object| object.id.as_str())
        .collect();
    let ids = plain_ids(&names, style);
    let mut objects = Vec::new();
    for (object, id) in report.objects.iter().zip(ids) {
        let cost = costs.and_then(|costs| costs.rows.iter().find(|row| row.id == object.id));
        if costs.is_some() && cost.is_none() {
            doubts.push(ExportDoubt::NotInInventory(object.id.clone()));
        }
        let quantity = cost.map_or(1.0, |cost| cost.quantity);
        if quantity == 0.0 {
            doubts.push(ExportDoubt::NoneOfIt(object.id.clone()));
            continue;
        }
        let shape = if request.is_discrete {
            Shape::Points(Points::of(object, report.request.shock.is_some())?)
        } else {
            let overturns =
                exported(object, LimitState::Overturns, request.beta)?.ok_or_else(|| {
                    let message =
                        format!("object {} has no curve of overturning", shorten(&object.id));
                    Problem::value(
                        message,
                        "run it at more intensities, or leave out the object",
                    )
                })?;
            Shape::Lognormal {
                exceeds: exported(object, LimitState::Exceeds, request.beta)?,
                overturns,
            }
        };
        objects.push(ExportObject {
            object,
            id,
            shape,
            quantity,
            floor: cost.and_then(|cost| cost.floor).unwrap_or(0),
            site_deg: cost.and_then(|cost| cost.site_deg),
            cost,
        });
    }
    if objects.is_empty() {
        return Err(
            Problem::new(ProblemKind::Missing, "no object is left to export")
                .hint("correct the quantities"),
        );
    }
    Ok(objects)
}

/// The ids that another program accepts.
struct IdStyle {
    /// The beginning that every id has.
    start: &'static str,
    /// The characters that are allowed besides letters and digits.
    fine: &'static str,
    /// The largest number of characters; `None`: no limit.
    longest: Option<usize>,
}

/// pelicun joins ids, locations and directions with hyphens, so an id would end at its first
/// hyphen.
const PELICUN_IDS: IdStyle = IdStyle {
    start: "FS.",
    fine: "_.",
    longest: None,
};
/// Ids of assets have at most 50 characters (`ASSET_ID_LENGTH`, OpenQuake 3.26); ids of functions
/// have no quotation marks.
const OPENQUAKE_IDS: IdStyle = IdStyle {
    start: "",
    fine: "_-",
    longest: Some(50),
};

impl IdStyle {
    /// The id with all other characters replaced by `_`, and cut off if it is too long.
    fn plain(&self, id: &str) -> String {
        let is_fine = |c: char| c.is_ascii_alphanumeric() || self.fine.contains(c);
        let plain = id.chars().map(|c| if is_fine(c) { c } else { '_' });
        self.start
            .chars()
            .chain(plain)
            .take(self.longest.unwrap_or(usize::MAX))
            .collect()
    }

    /// An id with a number at its end, no longer than allowed.
    fn numbered(&self, id: &str, number: usize) -> String {
        let end = format!("_{number}");
        let room = self
            .longest
            .map_or(usize::MAX, |most| most.saturating_sub(end.len()));
        id.chars().take(room).chain(end.chars()).collect()
    }
}

/// Ids as another program accepts them, all different. An id that is accepted as it is does not
/// change.
fn plain_ids(ids: &[&str], style: &IdStyle) -> Vec<String> {
    let plain: Vec<String> = ids.iter().map(|id| style.plain(id)).collect();
    let is_kept = |(id, plain): (&&str, &String)| plain.strip_prefix(style.start) == Some(*id);
    let mut used: BTreeSet<String> = ids
        .iter()
        .zip(&plain)
        .filter(|pair| is_kept(*pair))
        .map(|(_, plain)| plain.clone())
        .collect();
    let mut unique = |(id, plain): (&&str, &String)| {
        let mut id_there = plain.clone();
        if !is_kept((id, plain)) {
            let mut number = 2;
            while !used.insert(id_there.clone()) {
                id_there = style.numbered(plain, number);
                number += 1;
            }
        }
        id_there
    };
    ids.iter().zip(&plain).map(&mut unique).collect()
}

/// `ids.csv` with the ids of both sides, and a doubt, if any id was changed.
fn id_table(
    objects: &[ExportObject],
    style: &IdStyle,
    format: ExportFormat,
    doubts: &mut Vec<ExportDoubt>,
) -> Result<Option<(String, Vec<u8>)>, Problem> {
    let is_changed =
        |one: &&ExportObject| one.id.strip_prefix(style.start) != Some(one.object.id.as_str());
    let changed: Vec<&ExportObject> = objects.iter().filter(is_changed).collect();
    let Some(first) = changed.first() else {
        return Ok(None);
    };
    doubts.push(ExportDoubt::ChangedIds {
        format,
        count: changed.len(),
        id: first.object.id.clone(),
        exported: first.id.clone(),
        allowed: style.fine,
        longest: style.longest,
    });
    let rows = objects
        .iter()
        .map(|one| vec![one.object.id.clone(), one.id.clone()]);
    Ok(Some((
        "ids.csv".to_owned(),
        csv(&["id", "exported_id"], rows)?,
    )))
}

/// Median and β of a limit state for another program; a state without β takes that of the user.
///
/// # Errors
/// A state without a median, or without β where the user gives none.
fn exported(
    object: &ObjectFragility,
    state: LimitState,
    beta: Option<f64>,
) -> Result<Option<(f64, f64)>, Problem> {
    let Some(kind) = object.fit.curve(state) else {
        return Ok(None);
    };
    if let CurveKind::Lognormal { median, beta } = kind {
        return Ok(Some((median, beta)));
    }
    let (id, state) = (shorten(&object.id), state.name());
    match (kind.median(), beta) {
        (Some(median), Some(beta)) => Ok(Some((median, beta))),
        (Some(_), None) => {
            let message = format!("object {id}: {state} is a step, which has no beta");
            Err(Problem::value(
                message,
                "give a β for such states, such as `beta = 0.25`, or run more intensities",
            ))
        }
        (None, _) => {
            let message = format!("object {id}: {state} has no curve ({})", kind.name());
            Err(Problem::value(
                message,
                "run more intensities, leave out the object, or export its points: `discrete = true`",
            ))
        }
    }
}

/// Refuses curves that may cross, which both programs change without a warning, and curves that are
/// not lognormal. Shares of runs cannot cross.
fn check_fit(report: &FragilityReport, request: &ExportRequest) -> Result<(), Problem> {
    if request.is_discrete {
        return Ok(());
    }
    if report.request.shock.is_some() {
        let message = "a fit of shocks has no lognormal curve of exceeding";
        let hint = "export its points with `discrete = true`, or leave out `tolerance`, so that the outcomes are fitted";
        return Err(Problem::value(message, hint).of(&["tolerance"]));
    }
    if report.request.fit == FitKind::Ordered {
        return Ok(());
    }
    let message =
        "separate fits may cross, and other programs change crossing curves without a warning";
    Err(Problem::value(message, "export with `fit = \"ordered\"`").of(&["fit"]))
}

/// Where the outcomes came from, for `metadata.json`.
fn sources(report: &FragilityReport) -> Value {
    json!([{"path": report.table.file.path.display().to_string(), "sha256": report.table.file.sha256}])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fragility::{At, FragilityRequest, fragility};
    use freestand_study::run::no_progress;

    #[test]
    fn ids_are_plain_and_unique() {
        let ids = ["CAB-01", "CAB_01", "Schrank Ä", "a.b"];
        // An id that is accepted as it is does not change.
        assert_eq!(
            plain_ids(&ids, &PELICUN_IDS),
            ["FS.CAB_01_2", "FS.CAB_01", "FS.Schrank__", "FS.a.b"]
        );
    }

    /// Spaces, umlauts, slashes, quotation marks, digits at the beginning, ids longer than 50
    /// characters that differ only at their end, and ids that would be equal after these changes.
    #[test]
    fn openquake_gets_ids_that_it_accepts() {
        let (long, longer) = ("x".repeat(60), format!("{}y", "x".repeat(60)));
        let exact = "z".repeat(50);
        let ids = [
            "2 racks/Ä",
            "2_racks__",
            "it's",
            "a\"b#c",
            &long,
            &longer,
            &exact,
            "007",
            "a_b_c",
            "",
            "ß",
        ];
        let found = plain_ids(&ids, &OPENQUAKE_IDS);
        let is_fine = |id: &String| {
            (1..=50).contains(&id.len())
                && id
                    .bytes()
                    .all(|b| b.is_ascii_alphanumeric() || b"_-".contains(&b))
        };
        let unique: BTreeSet<&String> = found.iter().collect();
        assert_eq!(unique.len(), ids.len(), "{found:?}");
        assert!(
            found
                .iter()
                .enumerate()
                .all(|(i, id)| ids[i].is_empty() || is_fine(id)),
            "{found:?}"
        );
        assert_eq!(found[..4], ["2_racks___2", "2_racks__", "it_s", "a_b_c_2"]);
        assert_eq!(
            (found[4].as_str(), found[5].as_str()),
            (&*"x".repeat(50), &*format!("{}_2", "x".repeat(48)))
        );
        assert_eq!([&found[6], &found[7], &found[8]], [&*exact, "007", "a_b_c"]);
    }

    /// The folder for OpenQuake of three objects, with an inventory, by a power law of sa_avg.
    fn for_openquake(inventory: &str) -> Exported {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        let rows = ["a", "b", "c"].map(|id| {
            [
                (0.1, "rocked"),
                (0.2, "overturned"),
                (0.3, "rocked"),
                (0.4, "overturned"),
            ]
            .map(|(x, outcome)| format!("{id},m{x},{x},{outcome}\n"))
            .concat()
        });
        std::fs::write(
            path("o.csv"),
            format!("object,motion,sa_avg(0.2:2) [g],outcome\n{}", rows.concat()),
        )
        .unwrap();
        std::fs::write(path("i.csv"), inventory).unwrap();
        let outcomes = FragilityRequest {
            outcomes: path("o.csv"),
            at: None,
            fit: FitKind::Ordered,
            shock: None,
            replicates: Some(0),
            seed: 1,
        };
        let report = fragility(outcomes, &no_progress).unwrap();
        let request = ExportRequest {
            format: ExportFormat::OpenQuake,
            demand: None,
            realizations: None,
            beta: None,
            is_discrete: false,
            site_deg: Some((151.2, -33.9)),
            list: Default::default(),
            inventory: Some(path("i.csv")),
            hazard: Some(HazardSource::PowerLaw {
                text: "k0=1e-3 /yr, k=2, reference=0.3 g".to_owned(),
                measure: Some(report.table.measure),
            }),
        };
        export(&report, &request).unwrap()
    }

    fn text_of(exported: &Exported, name: &str) -> String {
        let bytes = exported
            .files
            .iter()
            .find(|file| file.0 == format!("openquake/{name}"))
            .unwrap();
        String::from_utf8(bytes.1.clone()).unwrap()
    }

    /// The last column, the value of all pieces of an object.
    fn values(exported: &Exported) -> Vec<String> {
        let text = text_of(exported, "exposure.csv");
        text.lines()
            .skip(1)
            .map(|line| line.rsplit(',').next().unwrap().to_owned())
            .collect()
    }

    /// Beside costs an object without one is worth nothing that is known; without any cost each
    /// counts 1.
    #[test]
    fn a_value_is_an_amount_or_a_count() {
        let some = for_openquake(
            "id,quantity,repair_cost [AUD],replacement_cost [AUD]\na,2,,900\nb,3,50,\nc,1,,\n",
        );
        assert_eq!(values(&some), ["1800", "0", "0"]);
        let without = ExportDoubt::NoReplacement(vec!["b".to_owned(), "c".to_owned()]);
        assert_eq!(some.doubts, [without]);
        let none = for_openquake("id,quantity\na,2\nb,3\nc,1\n");
        assert_eq!(values(&none), ["2", "3", "1"]);
        assert_eq!(none.doubts, []);
    }

    /// The hazard curve of a folder can be read again, AvgSA with its periods.
    #[test]
    fn an_exported_hazard_is_read_again() {
        let exported = for_openquake("id,quantity\na,1\nb,1\nc,1\n");
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("hazard.csv");
        std::fs::write(&path, text_of(&exported, "hazard.csv")).unwrap();
        let read = hazard_of(
            &HazardSource::File {
                path,
                measure: None,
                site: Default::default(),
            },
            HazardPlace::Stated(None),
            None,
            None,
        )
        .unwrap();
        assert_eq!(
            (read.measure.name(), read.at),
            ("sa_avg(0.2:2)".to_owned(), At::Ground)
        );
        // λ = k0 at the reference; points are joined by power laws, so that only their digits
        // differ.
        assert!(
            (read.hazard.annual_rate(0.3) / 1e-3 - 1.0).abs() < 1e-6,
            "{}",
            read.hazard.annual_rate(0.3)
        );
    }
}
