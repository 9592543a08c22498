//! Fragilities as a folder with a complete calculation for pelicun.

use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::quantity::shorten;
use freestand_input::words::{number, shortest};
use freestand_output::rows::csv;
use serde_json::{Value, json};

use crate::fragility::{FragilityReport, Measure};

use super::{ExportDoubt, ExportObject, ExportRequest, Files, Listed, Shape, sources};

/// Realizations where none are asked for.
const DEFAULT_REALIZATIONS: u32 = 10_000;
/// The most objects of one row: pelicun draws a capacity for each of them in every realization.
const MAX_BLOCKS: f64 = 10_000.0;
/// The only currency of pelicun.
const DOLLARS: &str = "USD";

/// Where pelicun looks for the demand of a component.
enum Place {
    /// Both are at location 0.
    Ground,
    /// The demand of the floor below: a component at location 1 takes that of floor 0.
    FloorBelow,
    /// Both are at the same location.
    Same,
}

impl Place {
    /// Locations of a component on a floor (0: the ground), and of its demand.
    fn locations(&self, floor: u32) -> (u32, u32) {
        match self {
            Self::Ground => (0, 0),
            Self::FloorBelow => (floor + 1, floor),
            Self::Same => (floor + 1, floor + 1),
        }
    }
}

/// How pelicun names a measure.
struct Demand {
    /// In `Demand-Type`.
    kind: String,
    /// In `Demand-Unit`.
    unit: &'static str,
    /// In the header of the demands.
    acronym: String,
    place: Place,
    /// Demands that pelicun does not know, with their acronym.
    custom: Option<(&'static str, &'static str)>,
}

fn demand_of(measure: Measure) -> Result<Demand, Problem> {
    let known = |kind: &str, unit, acronym: &str, place| Demand {
        kind: kind.to_owned(),
        unit,
        acronym: acronym.to_owned(),
        place,
        custom: None,
    };
    let ratio = |kind: &'static str, acronym: &'static str| Demand {
        custom: Some((kind, acronym)),
        ..known(kind, "unitless", acronym, Place::Same)
    };
    Ok(match measure {
        Measure::Pfv => known("Peak Floor Velocity", "mps", "PFV", Place::FloorBelow),
        Measure::Pfa => known("Peak Floor Acceleration", "g", "PFA", Place::FloorBelow),
        Measure::Pga => known("Peak Ground Acceleration", "g", "PGA", Place::Ground),
        Measure::Pgv => known("Peak Ground Velocity", "mps", "PGV", Place::Ground),
        Measure::Sa { period_s } => {
            let period = shortest(period_s);
            known(
                &format!("Spectral Acceleration|{period}"),
                "g",
                &format!("SA_{period}"),
                Place::Same,
            )
        }
        Measure::VelocityRatio => ratio("Rocking Velocity Ratio", "RVR"),
        Measure::AccelerationRatio => ratio("Rocking Acceleration Ratio", "RAR"),
        Measure::SaAverage { .. } => {
            let message = "pelicun has no average of spectral accelerations";
            return Err(Problem::value(
                message,
                "fit the outcomes against another measure",
            ));
        }
    })
}

/// pelicun keeps six digits of a point and refuses two points with equal probabilities.
const RISE: f64 = 1e-5;
/// How far beyond the last level pelicun reaches the probability 1 that it asks for: so far that the
/// curve stays where it is.
const FAR: f64 = 1e6;

/// A curve of points as pelicun writes it, `x1,x2|0,1`: it rises from 0 to 1, and where it would be
/// level, by 1e-5.
fn multilinear(levels: &[f64], probabilities: &[f64]) -> String {
    let mut points: Vec<(f64, f64)> = vec![(0.0, 0.0)];
    let mut is_level = false;
    for (x, p) in levels.iter().copied().zip(probabilities.iter().copied()) {
        let Some(last) = points.last_mut() else { break };
        if p > 1.0 - 3.0 * RISE {
            points.push((x, 1.0));
            break;
        } else if p >= last.1 + RISE {
            points.push((x, p));
            is_level = false;
        } else if is_level || p <= 0.0 {
            // Of points on one level the last one counts.
            last.0 = x;
        } else {
            let level = last.1 + RISE;
            points.push((x, level));
            is_level = true;
        }
    }
    if let Some(&(x, _)) = points.last().filter(|point| point.1 < 1.0) {
        points.push((FAR * x.max(f64::MIN_POSITIVE), 1.0));
    }
    let list = |of: &dyn Fn(&(f64, f64)) -> f64| {
        points
            .iter()
            .map(|point| shortest(of(point)))
            .collect::<Vec<_>>()
    };
    format!(
        "{}|{}",
        list(&|point| point.0).join(","),
        list(&|point| point.1).join(",")
    )
}

/// Family, two parameters and weights of a limit state.
type State = [String; 4];

fn states(shape: &Shape) -> [State; 2] {
    let lognormal = |(median, beta): (f64, f64)| {
        [
            "lognormal".to_owned(),
            shortest(median),
            shortest(beta),
            String::new(),
        ]
    };
    let none = || [const { String::new() }; 4];
    match shape {
        Shape::Lognormal {
            exceeds: Some(exceeds),
            overturns,
        } => [lognormal(*exceeds), lognormal(*overturns)],
        Shape::Lognormal {
            exceeds: None,
            overturns,
        } => [lognormal(*overturns), none()],
        Shape::Points(points) => {
            let state = |curve: &[f64]| {
                [
                    "multilinear_CDF".to_owned(),
                    multilinear(&points.levels, curve),
                    String::new(),
                    String::new(),
                ]
            };
            match &points.exceeds {
                Some(exceeds) => [state(exceeds), state(&points.overturns)],
                None => [state(&points.overturns), none()],
            }
        }
    }
}

/// Rows of `consequence_repair.csv`: what the damage states of one object cost, and how long they
/// last. An empty family is a fixed value.
fn consequences(object: &ExportObject) -> Vec<Vec<String>> {
    let Some(cost) = object.cost else {
        return Vec::new();
    };
    let row = |name: &str, unit: &str, exceeds: f64, overturns: f64| {
        let (first, second) = if object.shape.has_exceeds() {
            (exceeds, shortest(overturns))
        } else {
            (overturns, String::new())
        };
        let id = format!("{}-{name}", object.id);
        [
            &id,
            "0",
            "1 EA",
            unit,
            "",
            &shortest(first),
            "",
            "",
            &second,
            "",
        ]
        .map(str::to_owned)
        .to_vec()
    };
    let mut rows = Vec::new();
    if cost.repair.is_some() || cost.replacement.is_some() {
        rows.push(row(
            "Cost",
            DOLLARS,
            cost.repair.unwrap_or(0.0),
            cost.replacement.unwrap_or(0.0),
        ));
    }
    if let Some(days) = cost.downtime_days {
        rows.push(row("Time", "worker_day", 0.0, days));
    }
    rows
}

/// The files of a folder for pelicun, by their names in it, and the keys of its metadata.
///
/// `LS1` is `exceeds` and `LS2` `overturns`; an object without a tolerance has `overturns` alone. A
/// floor n (0 is the ground) is the location n + 1 of pelicun.
///
/// # Reference
/// pelicun 3.10 (NHERI SimCenter), `pelicun.tools.DL_calculation`.
///
/// # Errors
/// A measure that pelicun does not have, a quantity that is not a whole number.
pub(super) fn files(
    report: &FragilityReport,
    request: &ExportRequest,
    listed: &Listed,
    level: Option<f64>,
    doubts: &mut Vec<ExportDoubt>,
) -> Result<(Files, Value), Problem> {
    let demand = demand_of(report.table.measure)?;
    let mut fragilities = Vec::new();
    let mut components = Vec::new();
    let mut consequences = Vec::new();
    let (mut locations, mut stories) = (Vec::new(), 1);
    for object in listed.objects {
        if object.quantity.fract() != 0.0 || object.quantity > MAX_BLOCKS {
            let (id, quantity) = (shorten(&object.object.id), shortest(object.quantity));
            let message = format!(
                "object {id}: pelicun counts up to {MAX_BLOCKS} objects one by one, not {quantity}"
            );
            return Err(Problem::value(
                message,
                "correct the column quantity of the inventory",
            ));
        }
        // Demand-Directional 0 would multiply the demand by 1.2.
        let head = [
            object.id.as_str(),
            "0",
            demand.kind.as_str(),
            demand.unit,
            "0",
            "1",
        ]
        .map(str::to_owned);
        fragilities.push(
            head.into_iter()
                .chain(states(&object.shape).into_iter().flatten())
                .collect(),
        );
        let (location, demand_location) = demand.place.locations(object.floor);
        let (place, quantity) = (location.to_string(), shortest(object.quantity));
        let component = [
            &object.id,
            "ea",
            &place,
            "1",
            &quantity,
            &quantity,
            &object.object.id,
        ];
        components.push(component.map(ToString::to_string).to_vec());
        consequences.extend(self::consequences(object));
        locations.push(demand_location);
        stories = stories.max(location);
    }
    locations.sort_unstable();
    locations.dedup();
    let states = |names: &[&str]| {
        let of = |i: usize| names.iter().map(move |name| format!("{i}-{name}"));
        (1..=2).flat_map(of).collect::<Vec<String>>()
    };
    let head = [
        "ID",
        "Incomplete",
        "Demand-Type",
        "Demand-Unit",
        "Demand-Offset",
        "Demand-Directional",
    ];
    let limit_states = states(&["Family", "Theta_0", "Theta_1", "DamageStateWeights"]);
    let limit_states = limit_states.iter().map(|name| format!("LS{name}"));
    let header: Vec<String> = head
        .map(str::to_owned)
        .into_iter()
        .chain(limit_states)
        .collect();
    let quantities = [
        "ID",
        "Units",
        "Location",
        "Direction",
        "Theta_0",
        "Blocks",
        "Comment",
    ];
    let levels: Vec<f64> = match level {
        Some(value) => vec![value; request.realizations.unwrap_or(DEFAULT_REALIZATIONS) as usize],
        None => report
            .table
            .runs
            .iter()
            .map(|run| run.run.intensity)
            .collect(),
    };
    let mut files = vec![
        ("fragility.csv".to_owned(), table(&header, fragilities)?),
        (
            "CMP_QNT.csv".to_owned(),
            csv(&quantities, components.into_iter())?,
        ),
        (
            "demand.csv".to_owned(),
            demands(&demand, &locations, &levels)?,
        ),
    ];
    let has_costs = !consequences.is_empty();
    if has_costs {
        let damage_states = states(&["Family", "Theta_0", "Theta_1"]);
        let damage_states = damage_states.iter().map(|name| format!("DS{name}"));
        let head = ["ID", "Incomplete", "Quantity-Unit", "DV-Unit"].map(str::to_owned);
        let header: Vec<String> = head.into_iter().chain(damage_states).collect();
        files.push((
            "consequence_repair.csv".to_owned(),
            table(&header, consequences)?,
        ));
        let other = listed.currency.filter(|currency| *currency != DOLLARS);
        doubts.extend(other.map(|currency| ExportDoubt::InDollars(currency.to_owned())));
    }
    let seed = report.request.seed;
    let config = config(
        &demand,
        &Job {
            realizations: levels.len(),
            seed,
            stories,
            has_costs,
        },
    );
    let text = serde_json::to_string_pretty(&config)
        .map_err(|error| Problem::new(ProblemKind::Computation, format!("config.json: {error}")))?;
    files.push(("config.json".to_owned(), format!("{text}\n").into_bytes()));
    let metadata = json!({
        "version": env!("CARGO_PKG_VERSION"),
        "objects": listed.objects.iter().map(|object| object.metadata(report)).collect::<Vec<_>>(),
        "demand": level.map(|value| format!("{} {}", number(value, 6), demand.unit)),
        "currency": listed.currency,
        "sources": sources(report),
    });
    Ok((files, metadata))
}

fn table(header: &[String], rows: Vec<Vec<String>>) -> Result<Vec<u8>, Problem> {
    csv(
        &header.iter().map(String::as_str).collect::<Vec<_>>(),
        rows.into_iter(),
    )
}

/// `demand.csv`: a column for each floor in use, a row for each realization.
fn demands(demand: &Demand, locations: &[u32], levels: &[f64]) -> Result<Vec<u8>, Problem> {
    let columns = locations
        .iter()
        .map(|location| format!("1-{}-{location}-1", demand.acronym));
    let header: Vec<String> = std::iter::once(String::new()).chain(columns).collect();
    let row = |first: String, cell: String| {
        std::iter::once(first)
            .chain(std::iter::repeat_n(cell, locations.len()))
            .collect::<Vec<String>>()
    };
    let units = row("Units".to_owned(), demand.unit.to_owned());
    let rows = levels
        .iter()
        .enumerate()
        .map(|(i, value)| row(i.to_string(), shortest(*value)));
    table(&header, std::iter::once(units).chain(rows).collect())
}

/// What `config.json` contains in addition to the measure.
struct Job {
    realizations: usize,
    seed: u64,
    stories: u32,
    has_costs: bool,
}

fn config(demand: &Demand, job: &Job) -> Value {
    let custom = demand
        .custom
        .map(|(kind, acronym)| json!({kind: {"Acronym": acronym, "UnitType": "unitless"}}));
    let mut options = json!({
        "Seed": job.seed,
        "Sampling": {"SamplingMethod": "LHS", "SampleSize": job.realizations, "PreserveRawOrder": true},
    });
    let mut outputs = json!({
        "Demand": {"Statistics": true},
        "Damage": {"Sample": true, "Statistics": true},
        "Format": {"CSV": true, "JSON": false},
    });
    if let Some(custom) = custom {
        options["CustomDemandTypes"] = custom;
    }
    if job.has_costs {
        let all = json!({"Sample": true, "Statistics": true, "AggregateSample": true, "AggregateStatistics": true});
        outputs["Loss"] = json!({"Repair": all});
    }
    let mut calculation = json!({
        "Demands": {
            "DemandFilePath": "demand.csv", "CoupledDemands": true, "SampleSize": job.realizations.to_string(),
        },
        "Asset": {
            "ComponentAssignmentFile": "CMP_QNT.csv", "NumberOfStories": job.stories,
            "ComponentDatabase": "None", "ComponentDatabasePath": "fragility.csv",
        },
        "Damage": {"DamageProcess": "None"},
        "Options": options,
        "Outputs": outputs,
    });
    if job.has_costs {
        calculation["Losses"] = json!({"Repair": {
            "ConsequenceDatabase": "None", "ConsequenceDatabasePath": "consequence_repair.csv",
            "MapApproach": "Automatic",
            "DecisionVariables": {"Cost": true, "Time": true, "Carbon": false, "Energy": false},
        }});
    }
    json!({"GeneralInformation": {"units": {"length": "m"}}, "DL": calculation})
}

#[cfg(test)]
mod tests {
    use super::*;

    /// pelicun wants 0 at first, 1 at last, and a rise that its six digits show between.
    #[test]
    fn points_rise_from_0_to_1() {
        assert_eq!(
            multilinear(&[0.1, 0.2, 0.4, 0.8], &[0.0, 0.0, 0.5, 1.0]),
            "0.2,0.4,0.8|0,0.5,1"
        );
        assert_eq!(
            multilinear(&[1.0, 2.0, 3.0], &[0.25, 0.25, 0.5]),
            "0,1,2,3,3000000|0,0.25,0.25001,0.5,1"
        );
        assert_eq!(
            multilinear(&[1.0, 2.0, 3.0, 4.0], &[0.25; 4]),
            "0,1,4,4000000|0,0.25,0.25001,1"
        );
        assert_eq!(multilinear(&[1.0], &[0.0]), "1,1000000|0,1");
    }

    #[test]
    fn floors_become_locations() {
        assert_eq!(demand_of(Measure::Pfv).unwrap().place.locations(3), (4, 3));
        assert_eq!(demand_of(Measure::Pga).unwrap().place.locations(3), (0, 0));
        assert_eq!(
            demand_of(Measure::VelocityRatio)
                .unwrap()
                .place
                .locations(0),
            (1, 1)
        );
        assert!(
            demand_of(Measure::SaAverage {
                from_s: 0.2,
                to_s: 2.0
            })
            .is_err()
        );
    }
}
