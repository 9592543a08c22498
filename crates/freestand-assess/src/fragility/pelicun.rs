//! Fragilities as a folder that pelicun runs as it is.

use std::collections::BTreeSet;

use freestand::fragility::{CurveKind, FitKind, LimitState};
use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;
use freestand_input::words::shortest;
use freestand_output::json::document;
use freestand_output::rows::csv;
use serde_json::json;

use super::measure::Measure;
use super::{FragilityReport, ObjectFragility};

/// A folder for pelicun.
#[derive(Debug, Clone, PartialEq)]
pub struct PelicunRequest {
    /// Intensity of every realization, in the unit of the measure; `None`: the intensities of the
    /// outcomes.
    pub demand: Option<f64>,
    /// Realizations; `None`: 10,000.
    pub realizations: Option<u32>,
    /// β for states that have none; `None`: such an object is refused.
    pub beta: Option<f64>,
}

/// Realizations where none are asked for.
const DEFAULT_REALIZATIONS: u32 = 10_000;

/// How pelicun names a measure.
struct Demand {
    /// In `Demand-Type`.
    kind: String,
    /// In `Demand-Unit`.
    unit: &'static str,
    /// In the header of the demands.
    acronym: String,
    /// Location of the components, and of their demand. Peak floor measures are those of the floor
    /// below: a component at location 1 takes that of floor 0.
    location: u32,
    demand_location: u32,
    /// Demands that pelicun does not know, with their acronym.
    custom: Option<(&'static str, &'static str)>,
}

fn demand_of(measure: Measure) -> Result<Demand, Problem> {
    let known = |kind: &str, unit, acronym: &str, location, demand_location| Demand {
        kind: kind.to_owned(),
        unit,
        acronym: acronym.to_owned(),
        location,
        demand_location,
        custom: None,
    };
    let ratio = |kind: &'static str, acronym: &'static str| Demand {
        custom: Some((kind, acronym)),
        ..known(kind, "unitless", acronym, 1, 1)
    };
    Ok(match measure {
        Measure::Pfv => known("Peak Floor Velocity", "mps", "PFV", 1, 0),
        Measure::Pfa => known("Peak Floor Acceleration", "g", "PFA", 1, 0),
        Measure::Pga => known("Peak Ground Acceleration", "g", "PGA", 0, 0),
        Measure::Pgv => known("Peak Ground Velocity", "mps", "PGV", 0, 0),
        Measure::Sa { period_s } => {
            let period = shortest(period_s);
            known(&format!("Spectral Acceleration|{period}"), "g", &format!("SA_{period}"), 1, 1)
        }
        Measure::VelocityRatio => ratio("Rocking Velocity Ratio", "RVR"),
        Measure::AccelerationRatio => ratio("Rocking Acceleration Ratio", "RAR"),
        Measure::SaAverage { .. } => {
            let message = "pelicun has no average of spectral accelerations";
            return Err(Problem::value(message, "fit the outcomes against another measure"));
        }
    })
}

/// Ids as pelicun accepts them: `FS.` and letters, digits, `_` and `.`; a hyphen would break one.
pub(super) fn plain_ids<'a>(ids: impl Iterator<Item = &'a str>, start: &str, fine: &str) -> Vec<String> {
    let mut used = BTreeSet::new();
    ids.map(|id| {
        let is_fine = |c: char| c.is_ascii_alphanumeric() || fine.contains(c);
        let plain: String = id.chars().map(|c| if is_fine(c) { c } else { '_' }).collect();
        let base = format!("{start}{plain}");
        let unique = std::iter::once(base.clone())
            .chain((2..).map(|i| format!("{base}_{i}")))
            .find(|id| !used.contains(id))
            .unwrap_or(base);
        used.insert(unique.clone());
        unique
    })
    .collect()
}

/// Median and β of a limit state for another program; a state without β takes that of the user.
///
/// # Errors
/// A state without a median, or without β where the user gives none.
pub(super) fn exported(
    object: &ObjectFragility,
    state: LimitState,
    beta: Option<f64>,
) -> Result<Option<(f64, f64)>, Problem> {
    let Some(kind) = object.fit.curve(state) else { return Ok(None) };
    if let CurveKind::Lognormal { median, beta } = kind {
        return Ok(Some((median, beta)));
    }
    let (id, state) = (shorten(&object.id), state.name());
    match (kind.median(), beta) {
        (Some(median), Some(beta)) => Ok(Some((median, beta))),
        (Some(_), None) => {
            let message = format!("object {id}: {state} is a step, which has no beta");
            Err(Problem::value(message, "give `beta = 0.25` for states whose beta is not known, or run more levels"))
        }
        (None, _) => {
            let message = format!("object {id}: {state} has no curve ({})", kind.name());
            Err(Problem::value(message, "run more levels, or leave out the object"))
        }
    }
}

/// Refuses curves that may cross: both programs mend them silently.
pub(super) fn check_ordered(report: &FragilityReport) -> Result<(), Problem> {
    if report.request.shock.is_some() {
        let message = "a fit of shocks has no lognormal curve of exceeding, and other programs need one";
        return Err(Problem::value(message, "export the fit of the classes, without `tolerance`").of(&["tolerance"]));
    }
    if report.request.fit == FitKind::Ordered {
        return Ok(());
    }
    let message = "separate fits may cross, and other programs would mend them silently";
    Err(Problem::value(message, "export with `fit = \"ordered\"`").of(&["fit"]))
}

/// The files of a folder for pelicun, by their names in it.
///
/// `LS1` is `exceeds` and `LS2` `overturns`; an object without a tolerance has `overturns` alone.
///
/// # Reference
/// pelicun 3.10 (NHERI SimCenter), `pelicun.tools.DL_calculation`.
///
/// # Errors
/// Separate fits, a state without a curve, a measure that pelicun does not have.
pub fn pelicun_files(report: &FragilityReport, request: &PelicunRequest) -> Result<Vec<(String, Vec<u8>)>, Problem> {
    check_ordered(report)?;
    let demand = demand_of(report.table.measure)?;
    let ids = plain_ids(report.objects.iter().map(|object| object.id.as_str()), "FS.", "_.");
    let mut fragilities = Vec::new();
    let mut components = Vec::new();
    let mut listed = Vec::new();
    for (object, id) in report.objects.iter().zip(&ids) {
        let exceeds = exported(object, LimitState::Exceeds, request.beta)?;
        let Some(overturns) = exported(object, LimitState::Overturns, request.beta)? else { continue };
        let state = |curve: Option<(f64, f64)>| match curve {
            Some((median, beta)) => ["lognormal".to_owned(), shortest(median), shortest(beta), String::new()],
            None => [const { String::new() }; 4],
        };
        let (first, second) = match exceeds {
            Some(exceeds) => (Some(exceeds), Some(overturns)),
            None => (Some(overturns), None),
        };
        // Demand-Directional 0 would multiply the demand by 1.2.
        let head = [id.as_str(), "0", demand.kind.as_str(), demand.unit, "0", "1"].map(str::to_owned);
        fragilities.push(head.into_iter().chain(state(first)).chain(state(second)).collect());
        let location = demand.location.to_string();
        let component = [id.as_str(), "ea", location.as_str(), "1", "1", "1", object.id.as_str()];
        components.push(component.map(str::to_owned).to_vec());
        let names: &[&str] = if exceeds.is_some() { &["exceeds", "overturns"] } else { &["overturns"] };
        listed.push(json!({
            "id": object.id, "pelicun_id": id, "im": report.table.measure.name(), "fit": "ordered",
            "limit_states": names, "curves": [exceeds, Some(overturns)], "motions": object.outcomes.motions(),
        }));
    }
    let header = [
        "ID",
        "Incomplete",
        "Demand-Type",
        "Demand-Unit",
        "Demand-Offset",
        "Demand-Directional",
        "LS1-Family",
        "LS1-Theta_0",
        "LS1-Theta_1",
        "LS1-DamageStateWeights",
        "LS2-Family",
        "LS2-Theta_0",
        "LS2-Theta_1",
        "LS2-DamageStateWeights",
    ];
    let quantities = ["ID", "Units", "Location", "Direction", "Theta_0", "Blocks", "Comment"];
    let levels: Vec<f64> = match request.demand {
        Some(value) => vec![value; request.realizations.unwrap_or(DEFAULT_REALIZATIONS) as usize],
        None => report.table.runs.iter().map(|run| run.run.intensity).collect(),
    };
    let column = format!("1-{}-{}-1", demand.acronym, demand.demand_location);
    let rows = levels.iter().enumerate().map(|(i, value)| vec![i.to_string(), shortest(*value)]);
    let unit = std::iter::once(vec!["Units".to_owned(), demand.unit.to_owned()]);
    let demands = csv(&["", &column], unit.chain(rows))?;
    let metadata = json!({
        "version": env!("CARGO_PKG_VERSION"),
        "objects": listed,
        "sources": [{"path": report.table.file.path.display().to_string(), "sha256": report.table.file.sha256}],
    });
    Ok(vec![
        ("fragility.csv".to_owned(), csv(&header, fragilities.into_iter())?),
        ("CMP_QNT.csv".to_owned(), csv(&quantities, components.into_iter())?),
        ("demand.csv".to_owned(), demands),
        ("config.json".to_owned(), config(&demand, levels.len(), report.request.seed)?),
        ("metadata.json".to_owned(), document("freestand.pelicun/1", &metadata, &[])?.into_bytes()),
    ])
}

fn config(demand: &Demand, realizations: usize, seed: u64) -> Result<Vec<u8>, Problem> {
    let mut options = json!({
        "Seed": seed,
        "Sampling": {"SamplingMethod": "LHS", "SampleSize": realizations, "PreserveRawOrder": true},
    });
    if let (Some((kind, acronym)), Some(options)) = (demand.custom, options.as_object_mut()) {
        options.insert("CustomDemandTypes".to_owned(), json!({kind: {"Acronym": acronym, "UnitType": "unitless"}}));
    }
    let config = json!({
        "GeneralInformation": {"units": {"length": "m"}},
        "DL": {
            "Demands": {
                "DemandFilePath": "demand.csv", "CoupledDemands": true, "SampleSize": realizations.to_string(),
            },
            "Asset": {
                "ComponentAssignmentFile": "CMP_QNT.csv", "NumberOfStories": 1,
                "ComponentDatabase": "None", "ComponentDatabasePath": "fragility.csv",
            },
            "Damage": {"DamageProcess": "None"},
            "Options": options,
            "Outputs": {
                "Demand": {"Statistics": true},
                "Damage": {"Sample": true, "Statistics": true},
                "Format": {"CSV": true, "JSON": false},
            },
        },
    });
    let text = serde_json::to_string_pretty(&config).map_err(|error| {
        Problem::new(freestand_input::problem::ProblemKind::Computation, format!("config.json: {error}"))
    })?;
    Ok(format!("{text}\n").into_bytes())
}
