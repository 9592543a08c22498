//! The object as a row of a list has it, without a list.

use std::sync::Arc;

use freestand::wall::DEFAULT_WALL_RESTITUTION_RATIO;
use freestand_input::problem::{Problem, Problems};
use freestand_study::doubt::UnlikelySize;
use freestand_study::shape::Sizes;
use freestand_study::study::{FirstFloor, Study};

use super::{Earthquake, FloorPlace, Object, ObjectRequest, RestsOn};
use crate::list::floors_of;
use freestand_inventory::library::Libraries;
use freestand_inventory::{Column, Finding, Item, Severity, Surroundings, Value, item_of};

/// Its identifier. Random numbers belong to identifiers: a list with this object has the same numbers.
pub(super) const ID: &str = "object";

/// The object, as a list has it.
pub(super) struct Row {
    pub(super) item: Item,
    /// Its sizes that hardly any object has.
    pub(super) unlikely_sizes: Vec<UnlikelySize>,
    /// What else is doubtful about it, as of a row of a list.
    pub(super) doubts: Vec<String>,
}

/// The object of a request.
///
/// # Errors
/// All problems of its values, under the keys of the request.
pub(super) fn row(request: &ObjectRequest, study: &Study) -> Result<Row, Problems> {
    let settings = &study.assessment;
    let libraries = Libraries::with_files(
        settings.library.as_deref(),
        settings.cushion_library.as_deref(),
    )?;
    let mut floors = floors_of(study, None);
    floors.first_floor = floors.first_floor.or(Some(FirstFloor::Above));
    let (mut item, findings) =
        libraries.looked_up(|lookup| item_of(&values(request), &floors, lookup));
    let mut problems = Problems::default();
    let Object {
        height_m,
        thickness_m,
        width_m,
        ..
    } = request.object;
    // In place of what a list says of such sizes, which asks for a cell to be confirmed: who gives one object
    // with its units means what is only unusual.
    let unlikely_sizes = Sizes {
        height_m,
        thickness_m,
        width_m,
    }
    .check()?;
    let mut doubts = Vec::new();
    for finding in &findings {
        let problem = problem(finding, request, study);
        match finding.severity {
            Severity::Error => problems.push(problem),
            Severity::Doubt => {
                let hint = problem.hint.unwrap_or_default();
                doubts.push(format!("{}; {hint}", problem.message));
            }
        }
    }
    problems.finish(Some(()))?;
    if let Earthquake::Motions { .. } = request.earthquake {
        // Under given motions nothing is drawn.
        item.cushion_log_sd = None;
        let restitution = &mut item.surroundings.wall_restitution;
        *restitution = restitution.or(Some(DEFAULT_WALL_RESTITUTION_RATIO));
    }
    Ok(Row {
        item,
        unlikely_sizes,
        doubts,
    })
}

/// The values of the object by the columns that a list has for them.
fn values(request: &ObjectRequest) -> Vec<(Column, Value)> {
    let Object {
        height_m,
        thickness_m,
        width_m,
        is_round,
        body,
        cg_height_m,
        mass_kg,
        rests_on,
        tolerance,
        friction_ratio,
        surroundings,
    } = &request.object;
    let Surroundings {
        wall_gap_m,
        neighbour_gap_m,
        wall_height_m,
        wall_stiffness_n_m,
        wall_restitution,
        casters,
        rolling_resistance_ratio,
        clearance_m,
        upper,
    } = surroundings;
    let number = |value: Option<f64>| value.map(Value::Number);
    let (stiffness, entry) = match rests_on {
        Some(RestsOn::Stiffness(stiffness_n_m)) => (Some(*stiffness_n_m), None),
        Some(RestsOn::Entry(entry)) => (None, Some(entry.clone())),
        None => (None, None),
    };
    let (floor, level_ratio) = match &request.floor.place {
        FloorPlace::Ground => (None, Some(0.0)),
        FloorPlace::Name(name) => (Some(name.clone()), None),
        FloorPlace::Share(ratio) => (None, Some(*ratio)),
    };
    let shape = match body {
        Some(body) => Some(Value::Body(Arc::clone(body))),
        None => is_round.then_some(Value::Round),
    };
    let values = [
        (Column::Id, Some(Value::Text(ID.to_owned()))),
        (Column::Height, number(Some(*height_m))),
        (Column::Thickness, number(Some(*thickness_m))),
        (Column::Width, number(*width_m)),
        (Column::Shape, shape),
        (Column::CgHeight, number(*cg_height_m)),
        (Column::Mass, number(*mass_kg)),
        (Column::Stiffness, number(stiffness)),
        (Column::Cushion, entry.map(Value::Text)),
        (
            Column::Tolerance,
            number(tolerance.map(|one| one.peak_m_s2)),
        ),
        (
            Column::ToleranceDuration,
            number(tolerance.and_then(|one| one.duration_s)),
        ),
        (
            Column::Friction,
            friction_ratio.map(|(low, high)| Value::Range(low, high)),
        ),
        (Column::WallGap, number(*wall_gap_m)),
        (Column::NeighbourGap, number(*neighbour_gap_m)),
        (Column::WallHeight, number(*wall_height_m)),
        (Column::WallStiffness, number(*wall_stiffness_n_m)),
        (Column::WallRestitution, number(*wall_restitution)),
        (Column::Casters, casters.map(Value::Casters)),
        (Column::RollingResistance, number(*rolling_resistance_ratio)),
        (Column::Clearance, number(*clearance_m)),
        (Column::UpperHeight, number(upper.map(|body| body.height_m))),
        (
            Column::UpperThickness,
            number(upper.map(|body| body.thickness_m)),
        ),
        (
            Column::UpperMass,
            number(upper.and_then(|body| body.mass_kg)),
        ),
        (Column::Floor, floor.map(Value::Text)),
        (Column::LevelRatio, number(level_ratio)),
    ];
    let given = values.into_iter();
    given
        .filter_map(|(column, value)| Some((column, value?)))
        .collect()
}

/// A problem of a value under the key of the request.
fn problem(finding: &Finding, request: &ObjectRequest, study: &Study) -> Problem {
    let key = match finding.column {
        Some(Column::Stiffness | Column::Cushion | Column::PadStiffness) => "on",
        Some(Column::ToleranceDuration) => Column::Tolerance.name(),
        Some(column) => column.name(),
        None => ID,
    };
    let of_floor = (finding.column, &request.floor.place, finding.severity);
    let hint = match of_floor {
        (Some(Column::Floor), FloorPlace::Name(name), Severity::Error) => {
            return no_floor(name, study);
        }
        (Some(Column::Floor), ..) => LEVEL_RATIO.to_owned(),
        _ => finding.hint.clone(),
    };
    let written = finding
        .examples
        .first()
        .map_or_else(String::new, |text| format!(" \"{text}\""));
    let what = finding.detail.as_deref().unwrap_or(finding.kind.words());
    Problem::value(format!("`{key}`{written} {what}"), hint).of(&[key])
}

/// Where a name leaves the height of a floor open.
const LEVEL_RATIO: &str = "give `level_ratio`, the height of the floor over that of the building";

fn no_floor(name: &str, study: &Study) -> Problem {
    let floors = floors_of(study, None);
    let named: Vec<String> = floors
        .named
        .iter()
        .take(8)
        .map(|(name, _)| format!("\"{name}\""))
        .collect();
    let name = freestand_input::quantity::shorten(name);
    let hint = match floors.storeys {
        _ if !named.is_empty() => format!(
            "the study names the floors {}; or give `level_ratio`",
            named.join(", ")
        ),
        Some(storeys) => {
            format!(
                "write 1 to {storeys} (1 is the first above the ground, {storeys} the roof), ground or roof"
            )
        }
        None => LEVEL_RATIO.to_owned(),
    };
    Problem::value(
        format!("`floor` \"{name}\" is not a floor of the building"),
        hint,
    )
}

#[cfg(test)]
mod tests {
    use freestand_input::keys::Words;
    use freestand_input::quantity::UnitSystem;
    use freestand_study::resolve::{Values, of_values};

    use super::super::{Floor, Withstood};
    use super::*;
    use freestand_inventory::Kind;

    /// The row of an object at a third of the height.
    fn read(object: Object) -> Result<Row, Problems> {
        let request = ObjectRequest {
            object,
            earthquake: Earthquake::Place(Words::default()),
            floor: Floor {
                place: FloorPlace::Share(1.0 / 3.0),
                storeys: None,
                storey_height_m: None,
            },
            worlds: None,
            seed: None,
            units: UnitSystem::Si,
        };
        row(&request, &of_values(&Values::default()).unwrap())
    }

    #[test]
    fn values_that_are_too_large_are_refused() {
        let object = Object {
            mass_kg: Some(1e30),
            rests_on: Some(RestsOn::Stiffness(f64::INFINITY)),
            friction_ratio: Some((0.3, 1e30)),
            ..Object::of_size(2.0, 0.5)
        };
        let problems = read(object).err().unwrap().problems;
        let mut keys: Vec<&str> = problems.iter().filter_map(Problem::key).collect();
        keys.sort_unstable();
        assert_eq!(keys, ["friction", "mass", "on"]);
        for problem in &problems {
            assert!(problem.message.contains("is too large"), "{problem}");
            assert!(problem.hint.is_some(), "{problem}");
        }
    }

    /// Values keep their bits. In a list, 2.125 could be 2125 too: a value has one meaning.
    #[test]
    fn values_are_taken_as_they_are() {
        let third = 1.0 / 3.0;
        let object = Object {
            width_m: Some(2.0 * third),
            mass_kg: Some(100.0 * third),
            rests_on: Some(RestsOn::Stiffness(1e6 * third)),
            tolerance: Some(Withstood {
                peak_m_s2: 2.125,
                duration_s: Some(0.01 * third),
            }),
            ..Object::of_size(5.0 * third, third)
        };
        let Row {
            item,
            unlikely_sizes,
            doubts,
        } = read(object).unwrap();
        // It is below 0.3 g, and that is all.
        assert_eq!((unlikely_sizes.len(), doubts.len()), (0, 1), "{doubts:?}");
        let sizes = (item.height_m, item.thickness_m, item.width_m);
        assert_eq!(sizes, (Some(5.0 * third), Some(third), Some(2.0 * third)));
        let stiffness = item
            .cushion
            .and_then(|edge| edge.cushion.linear_stiffness_n_m());
        assert_eq!(
            (item.mass_kg, stiffness, item.level_ratio),
            (Some(100.0 * third), Some(1e6 * third), Some(third))
        );
        let tolerance = item.tolerance.unwrap();
        let found = (tolerance.peak_m_s2, tolerance.duration_s);
        assert_eq!(found, (Some(2.125), Some(0.01 * third)));
        assert_eq!(item.doubts, [Kind::Tolerance]);
    }
}
