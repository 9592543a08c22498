//! The object as the only row of a list: it is read like any other list.

use std::path::Path;

use freestand::wall::DEFAULT_WALL_RESTITUTION_RATIO;
use freestand_input::problem::{Problem, ProblemKind, Problems};
use freestand_study::shape::Sizes;
use freestand_study::study::{FirstFloor, Study};

use super::{Earthquake, FloorPlace, Object, ObjectRequest, RestsOn};
use crate::inventory::{
    Column, Finding, Item, Kind, Mapping, ReadOptions, Severity, Surroundings, parse_inventory,
};
use crate::job::floors_of;
use crate::library::Libraries;

/// The identifier of the row. Random numbers belong to identifiers: a list with this row has the
/// same numbers.
pub(super) const ID: &str = "object";

/// The object, as a list has it.
pub(super) struct Row {
    pub(super) item: Item,
    /// What is doubtful about it.
    pub(super) warnings: Vec<String>,
}

/// Reads the object.
///
/// # Errors
/// All problems of its values, under the keys of the request.
pub(super) fn row(request: &ObjectRequest, study: &Study) -> Result<Row, Problems> {
    let settings = &study.assessment;
    let libraries = Libraries::with_files(
        settings.library.as_deref(),
        settings.cushion_library.as_deref(),
    )?;
    // Numbers are written with a point, whatever they look like.
    let mapping = Mapping::parse("[numbers]\ndecimal = \"point\"\n")?;
    let mut floors = floors_of(study, None);
    floors.first_floor = floors.first_floor.or(Some(FirstFloor::Above));
    let list = list(request)?;
    let reading = libraries.looked_up(|lookup| {
        let options = ReadOptions {
            mapping: Some(&mapping),
            floors,
            ..ReadOptions::new(lookup)
        };
        parse_inventory(list, Path::new(ID), &options)
    })?;
    // A problem of the list is that of the flag whose value it is; the path has no meaning.
    let mut problems = Problems::default();
    let Object {
        height_m,
        thickness_m,
        width_m,
        ..
    } = request.object;
    // In place of what a list says of such sizes: there is no cell to confirm.
    let mut warnings = Sizes {
        height_m,
        thickness_m,
        width_m,
    }
    .check()?;
    for finding in reading
        .inventory
        .findings
        .iter()
        .filter(|one| one.kind != Kind::ImplausibleSize)
    {
        let problem = problem(finding, request, study);
        match finding.severity {
            Severity::Error => problems.push(problem),
            Severity::Doubt => {
                let hint = problem.hint.unwrap_or_default();
                warnings.push(format!("{}; {hint}", problem.message));
            }
        }
    }
    let mut item = problems.finish(reading.inventory.items.into_iter().next())?;
    // Who gives one object with its units means what is only unusual.
    item.to_confirm.clear();
    item.doubts.retain(|doubt| *doubt != Kind::ImplausibleSize);
    if let Earthquake::Motions { .. } = request.earthquake {
        // Under given motions nothing is drawn.
        item.cushion_log_sd = None;
        let restitution = &mut item.surroundings.wall_restitution;
        *restitution = restitution.or(Some(DEFAULT_WALL_RESTITUTION_RATIO));
    }
    Ok(Row { item, warnings })
}

/// The list, in SI with all digits.
fn list(request: &ObjectRequest) -> Result<Vec<u8>, Problem> {
    let Object {
        height_m,
        thickness_m,
        width_m,
        is_round,
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
    let with = |unit: &'static str| move |value: f64| format!("{value} {unit}");
    let (stiffness, entry) = match rests_on {
        Some(RestsOn::Stiffness(stiffness_n_m)) => (Some(format!("{stiffness_n_m} N/m")), None),
        Some(RestsOn::Entry(entry)) => (None, Some(entry.clone())),
        None => (None, None),
    };
    let (floor, level) = match &request.floor.place {
        FloorPlace::Ground => (None, Some("0".to_owned())),
        FloorPlace::Name(name) => (Some(name.clone()), None),
        FloorPlace::Share(ratio) => (None, Some(ratio.to_string())),
    };
    let cells = [
        (Column::Id, Some(ID.to_owned())),
        (Column::Height, Some(format!("{height_m} m"))),
        (Column::Thickness, Some(format!("{thickness_m} m"))),
        (Column::Width, width_m.map(with("m"))),
        (Column::Shape, is_round.then(|| "cylinder".to_owned())),
        (Column::CgHeight, cg_height_m.map(with("m"))),
        (Column::Mass, mass_kg.map(with("kg"))),
        (Column::Stiffness, stiffness),
        (Column::Cushion, entry),
        (
            Column::Tolerance,
            tolerance.map(|one| format!("{} m/s2", one.peak_m_s2)),
        ),
        (
            Column::ToleranceDuration,
            tolerance.and_then(|one| one.duration_s).map(with("s")),
        ),
        (
            Column::Friction,
            friction_ratio.map(|(low, high)| format!("{low} to {high}")),
        ),
        (Column::WallGap, wall_gap_m.map(with("m"))),
        (Column::NeighbourGap, neighbour_gap_m.map(with("m"))),
        (Column::WallHeight, wall_height_m.map(with("m"))),
        (Column::WallStiffness, wall_stiffness_n_m.map(with("N/m"))),
        (
            Column::WallRestitution,
            wall_restitution.map(|ratio| ratio.to_string()),
        ),
        (
            Column::Casters,
            casters.map(|casters| casters.name().to_owned()),
        ),
        (
            Column::RollingResistance,
            rolling_resistance_ratio.map(|ratio| ratio.to_string()),
        ),
        (Column::Clearance, clearance_m.map(with("m"))),
        (
            Column::UpperHeight,
            upper.map(|body| body.height_m).map(with("m")),
        ),
        (
            Column::UpperThickness,
            upper.map(|body| body.thickness_m).map(with("m")),
        ),
        (
            Column::UpperMass,
            upper.and_then(|body| body.mass_kg).map(with("kg")),
        ),
        (Column::Floor, floor),
        (Column::LevelRatio, level),
    ];
    let (names, texts): (Vec<&str>, Vec<String>) = cells
        .into_iter()
        .filter_map(|(column, text)| Some((column.name(), text?)))
        .unzip();
    let broken = |error: &dyn std::fmt::Display| {
        Problem::new(
            ProblemKind::Computation,
            format!("the list of one object cannot be written: {error}"),
        )
    };
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer
        .write_record(&names)
        .map_err(|error| broken(&error))?;
    writer
        .write_record(&texts)
        .map_err(|error| broken(&error))?;
    writer.into_inner().map_err(|error| broken(&error))
}

/// A problem of a cell under the key of the request.
fn problem(finding: &Finding, request: &ObjectRequest, study: &Study) -> Problem {
    let key = match finding.column {
        Some(Column::Stiffness | Column::Cushion | Column::PadStiffness) => "on",
        Some(Column::ToleranceDuration) => Column::Tolerance.name(),
        Some(column) => column.name(),
        None => ID,
    };
    if let (Some(Column::Floor), FloorPlace::Name(name)) = (finding.column, &request.floor.place) {
        return no_floor(name, study);
    }
    let written = finding
        .examples
        .first()
        .map_or_else(String::new, |text| format!(" \"{text}\""));
    let what = finding.detail.as_deref().unwrap_or(finding.kind.words());
    Problem::value(format!("`{key}`{written} {what}"), finding.hint.clone())
}

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
        None => "give `level_ratio`, the height of the floor over that of the building".to_owned(),
    };
    Problem::value(
        format!("`floor` \"{name}\" is not a floor of the building"),
        hint,
    )
}
