//! Makes an object from the values of a row.

use std::sync::Arc;

use freestand::block::{Block, BlockError};
use freestand::hull::shapes::Outline;
use freestand::impact::stiffness_warnings;
use freestand::rocking::Restitution;

use crate::library::{Confidence, Lookup, Tolerance};
use freestand_input::keys::{KeyStyle, Words};
use freestand_input::problem::{Problem, ProblemKind, Problems};
use freestand_input::quantity::shorten;
use freestand_input::words::{nearest, number};
use freestand_scan::body::Leaking;
use freestand_study::cushion::{self, EdgeCushion};
use freestand_study::hull::BodyInPose;
use freestand_study::hull::body::{Form, SCAN_BASES, SCAN_UNITS, Scan, Upright, feet_of};
use freestand_study::shape::Shape;

use super::columns::{COLUMNS, Column, ColumnSpec};
use super::floors::{FloorFinder, Floors, Found};
use super::given::{Given, Value};
use super::plausible;
use super::problems::{Finding, Findings, Kind, RowFindings};
use super::round::names_round_object;
use super::scans::Scans;
use super::template::EXAMPLE;
use super::values::Values;
use super::wheels::{Wheels, casters, may_roll, names_wheels};
use super::{Casters, Consequences, Item, ItemShape, Surroundings, UpperBody};
use freestand_study::restitution::checked;

/// How far a size of a list may be from that of a scan, over the former.
const SAME_SIZE: f64 = 0.1;

/// The largest resistance of rolling wheels over the weight, on a carpet or a rough floor.
const WHEEL_FRICTION: f64 = 0.1;

/// What a row is read with besides its cells.
pub(super) struct Reading<'a> {
    pub lookup: &'a Lookup<'a>,
    /// Finds floors by their names; `None`: the list has shares of the height.
    pub floors: Option<&'a FloorFinder>,
    pub section: &'a str,
    /// The scans that the list names.
    pub scans: &'a Scans,
}

/// The object of these values, and what is wrong or doubtful about it; floors are found by their names
/// unless the values have a [`Column::LevelRatio`].
pub fn item_of(
    values: &[(Column, Value)],
    floors: &Floors,
    lookup: &Lookup<'_>,
) -> (Item, Vec<Finding>) {
    let mut findings = Findings::default();
    let given = Given {
        values,
        told: RowFindings::new(&mut findings),
    };
    let names: Vec<String> = given
        .get(Column::Floor)
        .map(|floor| floor.shown(Column::Floor))
        .into_iter()
        .collect();
    let finder = given
        .get(Column::LevelRatio)
        .is_none()
        .then(|| FloorFinder::new(floors, &names, false, false));
    let reading = Reading {
        lookup,
        floors: finder.as_ref(),
        section: "",
        scans: &Scans::default(),
    };
    let item = item(&mut Values::Given(given), &reading, Vec::new());
    (item, findings.finish().0)
}

/// The object of a row.
pub(super) fn item(values: &mut Values<'_>, reading: &Reading<'_>, carried: Vec<String>) -> Item {
    let mut size = size(values);
    values.units();
    let mass_kg = values.positive(Column::Mass);
    let shape = shape(values, reading.scans, &mut size, mass_kg);
    let support = support(values, reading.lookup, mass_kg);
    let quantity = values.whole(Column::Quantity).unwrap_or(1);
    let (floor, level_ratio) = floor(values, reading);
    let (casters, stands_on) = values.casters(Column::Casters);
    let rests_on = Some(values.text(Column::RestsOn))
        .filter(|text| !text.is_empty() && feet_of(text).is_err())
        .unwrap_or(stands_on);
    let friction_ratio = values.range(Column::Friction);
    // So little is the resistance of wheels: the list says already that it rolls.
    let is_known_to_roll = friction_ratio.is_some_and(|(_, highest)| highest <= WHEEL_FRICTION);
    let surroundings = surroundings(values, &rests_on, casters, is_known_to_roll);
    let mut item = Item {
        row: values.row(),
        section: reading.section.to_owned(),
        id: id(values),
        item: values.text(Column::Item),
        quantity,
        priority: values.text(Column::Priority),
        location: values.text(Column::Location),
        building: values.text(Column::Building),
        floor,
        room: values.text(Column::Room),
        consequences: Consequences {
            life_safety: values.rating(Column::LifeSafety),
            property: values.rating(Column::Property),
            function: values.rating(Column::Function),
        },
        level_ratio,
        height_m: size.height_m,
        thickness_m: size.thickness_m,
        width_m: size.width_m,
        base_thickness_m: size.base_thickness_m,
        base_width_m: size.base_width_m,
        shape,
        cg_height_m: size.cg_height_m,
        mass_kg,
        cushion: support.cushion,
        cushion_log_sd: support.log_sd,
        cushion_source: support.source,
        tolerance: tolerance(values, reading.lookup),
        restitution: restitution(values, &size.blocks),
        friction_ratio,
        accepted_ratio: values.share(Column::Accepted),
        questions: values.questions(Column::Questions),
        anchored: anchored(values, &surroundings),
        rests_on,
        surroundings,
        notes: values.text(Column::Notes),
        doubts: Vec::new(),
        to_confirm: Vec::new(),
        carried,
    };
    for (kind, column) in plausible::doubts(&item) {
        // A side may be that of a column of all sizes, a stiffness that of one pad.
        let columns = [
            column,
            Column::Dimensions,
            Column::PadStiffness,
            Column::Cushion,
        ];
        let found = columns
            .into_iter()
            .find(|column| values.has(*column))
            .unwrap_or(column);
        values.report(found, kind, "");
    }
    item.doubts.clone_from(&values.told().doubts);
    item
}

/// What is around it and on it. What it stands on says whether it rolls, where no column does; its name, its
/// notes and what it stands on may contradict a column.
fn surroundings(
    values: &mut Values<'_>,
    rests_on: &str,
    stated: Option<Casters>,
    is_known_to_roll: bool,
) -> Surroundings {
    let said = names_wheels(rests_on).then(|| casters(rests_on));
    let wheels = match said {
        Some(Wheels::Said(found)) => Some(found),
        Some(Wheels::Some | Wheels::PerhapsBraked) => Some(Casters::Free),
        _ => None,
    };
    let doubted = match (stated, said) {
        (None, Some(Wheels::Some | Wheels::PerhapsBraked)) => Some(Column::RestsOn),
        (Some(Casters::None), _) if wheels == Some(Casters::Free) => Some(Column::RestsOn),
        (Some(Casters::Braked), Some(Wheels::Said(Casters::Free) | Wheels::PerhapsBraked))
        | (Some(Casters::Free), Some(Wheels::Said(Casters::Braked))) => Some(Column::RestsOn),
        // Whether they roll is said.
        _ if is_known_to_roll => None,
        _ if [stated, wheels]
            .iter()
            .any(|one| matches!(one, Some(Casters::Free | Casters::Braked))) =>
        {
            None
        }
        _ => [Column::Item, Column::Notes]
            .into_iter()
            .find(|column| values.shown(*column).is_some_and(|text| may_roll(&text))),
    };
    if let Some(column) = doubted {
        values.report(column, Kind::Casters, "");
    }
    let casters = if doubted.is_some() {
        Some(Casters::Free)
    } else {
        stated.or(wheels)
    };
    Surroundings {
        wall_gap_m: values.not_negative(Column::WallGap),
        neighbour_gap_m: values.not_negative(Column::NeighbourGap),
        wall_height_m: values.positive(Column::WallHeight),
        wall_stiffness_n_m: values.positive(Column::WallStiffness),
        wall_restitution: {
            let value = values.not_negative(Column::WallRestitution);
            let expected = "must be from 0 to below 1";
            values.accepted(
                Column::WallRestitution,
                value,
                |ratio| *ratio < 1.0,
                expected,
            )
        },
        casters,
        rolling_resistance_ratio: values.share(Column::RollingResistance),
        clearance_m: values.not_negative(Column::Clearance),
        upper: upper(values),
    }
}

/// Whether it is anchored: what rolls for certain is not.
fn anchored(values: &mut Values<'_>, surroundings: &Surroundings) -> Option<bool> {
    let anchored = values.answer(Column::Anchored);
    let rolls = surroundings.casters == Some(Casters::Free)
        && !values.told().doubts.contains(&Kind::Casters);
    if anchored == Some(true) && rolls {
        values.report(Column::Anchored, Kind::AnchoredUnclear, "");
        return None;
    }
    anchored
}

/// What stands on it: both sizes, or nothing.
fn upper(values: &mut Values<'_>) -> Option<UpperBody> {
    let (height, thickness) = (
        values.positive(Column::UpperHeight),
        values.positive(Column::UpperThickness),
    );
    let mass_kg = values.positive(Column::UpperMass);
    match (height, thickness) {
        (Some(height_m), Some(thickness_m)) => Some(UpperBody {
            height_m,
            thickness_m,
            mass_kg,
        }),
        (None, None) if mass_kg.is_none() => None,
        (height, _) => {
            let (column, lacks) = match height {
                Some(_) => (Column::UpperHeight, "its thickness"),
                None if values.is_filled(Column::UpperThickness) => {
                    (Column::UpperThickness, "its height")
                }
                None => (Column::UpperMass, "its height and thickness"),
            };
            let detail = format!("what stands on the object lacks {lacks}");
            values.report(column, Kind::UpperAlone, &detail);
            None
        }
    }
}

fn id(values: &mut Values<'_>) -> String {
    let id = values.text(Column::Id);
    if !id.is_empty() {
        if id.starts_with(EXAMPLE) {
            values.report(Column::Id, Kind::Example, "");
        }
        return id;
    }
    if values.has(Column::Id) {
        values.note("no id: the row number is used, such as row-12");
    }
    format!("row-{}", values.row())
}

/// The floor as it is named, and its height over that of the building.
fn floor(values: &mut Values<'_>, reading: &Reading<'_>) -> (String, Option<f64>) {
    let name = values.text(Column::Floor);
    let Some(finder) = reading.floors else {
        return (name, level(values));
    };
    let has_column = values.has(Column::Floor);
    // A section "Level 3" over rows without a floor of their own.
    let is_section = name.is_empty() && !has_column;
    let text = if is_section { reading.section } else { &name };
    if text.is_empty() {
        return (name, None);
    }
    match finder.find(text) {
        Found::Ratio(ratio, is_assumed) => {
            if is_section {
                values.report(Column::Floor, Kind::FloorFromSection, "");
            }
            if is_assumed {
                values.report(Column::Floor, Kind::FloorNumbering, "");
            }
            // A floor whose height is given is not guessed.
            match finder.identity(text).filter(|_| !finder.names(text)) {
                Some((1, _)) => values.note("a basement moves like the ground: level 0"),
                Some((4, _)) => values.report(Column::Floor, Kind::Mezzanine, ""),
                _ => {}
            }
            (text.to_owned(), Some(ratio))
        }
        _ if is_section => (name, None),
        Found::Unknown => {
            values.report(Column::Floor, Kind::FloorUnknown, "");
            (name, None)
        }
        Found::NoStoreys => {
            // One number is missing, however many rows need it.
            values.report_once(Column::Floor, Kind::StoreysMissing);
            (name, None)
        }
    }
}

fn level(values: &mut Values<'_>) -> Option<f64> {
    let level = values.number(Column::LevelRatio)?;
    if (0.0..=1.0).contains(&level) {
        return Some(level);
    }
    let hint = if level > 1.0 {
        "give the height of the floor over the height of the building, not its number: 0 is the ground, 1 the roof, \
         and 50 % is 0.5"
    } else {
        "0 is the ground, 1 the roof; a basement moves like the ground, so give 0"
    };
    let problem = Problem::value("the level must be from 0 to 1", hint);
    values.wrong(Column::LevelRatio, Kind::OutOfRange, &problem);
    None
}

/// The dimensions of an object, as far as they are known.
struct Size {
    height_m: Option<f64>,
    thickness_m: Option<f64>,
    width_m: Option<f64>,
    base_thickness_m: Option<f64>,
    base_width_m: Option<f64>,
    cg_height_m: Option<f64>,
    form: Form,
    /// The object about both axes, as far as they are known.
    blocks: Vec<Block>,
}

fn size(values: &mut Values<'_>) -> Size {
    let all = values.sizes().unwrap_or_default();
    let mut size = Size {
        height_m: values.positive(Column::Height).or(all.height),
        thickness_m: values.positive(Column::Thickness).or(all.thickness),
        width_m: values.positive(Column::Width).or(all.width),
        base_thickness_m: values.positive(Column::BaseThickness),
        base_width_m: values.positive(Column::BaseWidth),
        cg_height_m: values.positive(Column::CgHeight),
        form: Form::Box,
        blocks: Vec::new(),
    };
    round(values, &mut size, all.is_round);
    let Some(height_m) = size.height_m else {
        return size;
    };
    let cg_height_m = size.cg_height_m.take();
    let below_top = "is not below the top of the object";
    size.cg_height_m = values.accepted(
        Column::CgHeight,
        cg_height_m,
        |cg_m| *cg_m < height_m,
        below_top,
    );
    let planes = [
        (size.thickness_m, Column::BaseThickness),
        (size.width_m, Column::BaseWidth),
    ];
    for (side, column) in planes {
        let Some(side_m) = side else { continue };
        let base = if column == Column::BaseThickness {
            &mut size.base_thickness_m
        } else {
            &mut size.base_width_m
        };
        let feet = Shape {
            base_width_m: *base,
            ..Shape::default()
        };
        if let Err(error) = feet.block(height_m, side_m) {
            let column = base.take().map_or(Column::Height, |_| column);
            refuse_block(values, column, &error);
            continue;
        }
        let whole = Shape {
            cg_height_m: size.cg_height_m,
            ..feet
        };
        match whole.block(height_m, side_m) {
            Ok(block) => size.blocks.push(block),
            Err(error) => {
                refuse_block(values, Column::CgHeight, &error);
                size.cg_height_m = None;
            }
        }
    }
    if size.blocks.iter().any(|block| block.landing_ratio() < 0.0) {
        let squat = "squat (Housner's restitution is negative; h/t < 0.707 for a uniform block): landings are halted";
        values.note(squat);
    }
    size
}

/// A round base: its sides are those of the square around it.
fn round(values: &mut Values<'_>, size: &mut Size, is_marked: bool) {
    let diameter_m = values.positive(Column::Diameter);
    let sides = [Column::Thickness, Column::Width];
    let is_marked = is_marked
        || diameter_m.is_some()
        || sides.into_iter().any(|column| values.is_diameter(column));
    if let (Some(diameter_m), Some(thickness_m)) = (diameter_m, size.thickness_m)
        && (diameter_m - thickness_m).abs() > 0.02 * diameter_m
    {
        let detail = "differs from the sides of the object";
        values.report(Column::Diameter, Kind::TwoColumns, detail);
    }
    size.thickness_m = size.thickness_m.or(diameter_m);
    let shape = values.shape();
    let is_equal = match (size.thickness_m, size.width_m) {
        (Some(thickness), Some(width)) => (thickness - width).abs() <= 0.02 * width,
        (sides, _) => sides.is_some(),
    };
    let item = values.shown(Column::Item);
    let is_named = is_equal && item.is_some_and(|item| names_round_object(&item));
    size.form = match shape {
        Some(form) => form,
        None if is_marked || is_named => Form::Cylinder,
        None => Form::Box,
    };
    if size.form != Form::Box {
        if !is_equal && size.thickness_m.is_some() && size.width_m.is_some() {
            let detail =
                "differs from the thickness of an object with one diameter, which was used";
            values.report(Column::Width, Kind::TwoColumns, detail);
        }
        size.width_m = size.width_m.or(size.thickness_m);
        size.thickness_m = size.thickness_m.or(size.width_m);
        if shape.is_none() && !is_marked {
            values.report(Column::Item, Kind::Round, "");
        }
    }
}

/// The shape of an object: that of its scan, or on its feet, or of its base. A body brings its own sizes, and one that
/// cannot be used has none.
fn shape(
    values: &mut Values<'_>,
    scans: &Scans,
    size: &mut Size,
    mass_kg: Option<f64>,
) -> ItemShape {
    let text = values.shown(Column::RestsOn).unwrap_or_default();
    let file = values.text(Column::Scan);
    let feet = match are_points(&text).then(|| feet_of(&text)).transpose() {
        Ok(feet) => feet,
        Err(problem) => {
            values.wrong(Column::RestsOn, Kind::Unreadable, &problem);
            return ItemShape::Unknown;
        }
    };
    let found = match values.body() {
        Some(body) => Some(Ok(body)),
        None if !file.is_empty() => Some(scanned(values, scans, &file, feet, mass_kg, size)),
        None => upright(size, feet, mass_kg)
            .map(|upright| upright.and_then(|upright| upright.body().map(Arc::new))),
    };
    match found {
        None => match size.form {
            Form::Cylinder => ItemShape::Round,
            // A polygon is none without its sizes, and these are what is missing.
            Form::Box | Form::Polygon(_) => ItemShape::Block,
        },
        Some(Ok(body)) => {
            size.height_m = Some(body.height_m);
            size.cg_height_m = Some(body.standing.pose().cg_height_m);
            if !file.is_empty() {
                size.thickness_m = Some(body.thickness_m());
                size.width_m = None;
            }
            ItemShape::Body(body)
        }
        Some(Err(problem)) => {
            let kind = match problem.kind {
                ProblemKind::Value => Kind::OutOfRange,
                _ => Kind::Unreadable,
            };
            let column = of_body(&problem);
            values.wrong(column, kind, &problem.shown(KeyStyle::File));
            ItemShape::Unknown
        }
    }
}

/// Whether a text is of pairs of numbers: "four feet; two with pads" is none.
fn are_points(text: &str) -> bool {
    let has_digit = |text: &str| text.contains(|c: char| c.is_ascii_digit());
    let is_point = |text: &&str| {
        let halves = text.split_once(',');
        halves.is_some_and(|(x, y)| has_digit(x) && has_digit(y))
    };
    text.split([';', '\n']).filter(is_point).count() > 1
}

/// The body of a polygon, or of any shape on feet, if it is one and its sizes are known.
fn upright(
    size: &Size,
    feet_m: Option<Vec<[f64; 2]>>,
    mass_kg: Option<f64>,
) -> Option<Result<Upright, Problem>> {
    let (height_m, thickness_m) = size.height_m.zip(size.thickness_m)?;
    let has_base = size.base_thickness_m.is_some() || size.base_width_m.is_some();
    if feet_m.is_some() && has_base {
        let message = "is given beside the points on which it stands";
        let problem = Problem::value(message, "leave it empty, or the points");
        return Some(Err(problem.of(&["base_thickness"])));
    }
    let outline = match (size.form, size.width_m) {
        // Feet under a polygon are on the circle through its corners.
        (Form::Polygon(corners), _) => {
            let base_m = size.base_thickness_m.or(size.base_width_m);
            Outline::Polygon(corners, base_m.unwrap_or(thickness_m))
        }
        _ if feet_m.is_none() => return None,
        (Form::Cylinder, _) => Outline::Circle(thickness_m),
        (Form::Box, Some(width_m)) => Outline::Box([thickness_m, width_m]),
        (Form::Box, None) => {
            let message = "the width of an object on feet is not given";
            return Some(Err(Problem::value(message, "give it").of(&["width"])));
        }
    };
    Some(Ok(Upright {
        outline,
        height_m,
        cg_height_m: size.cg_height_m,
        feet_m,
        mass_kg,
    }))
}

/// The body of the scan that a row names.
fn scanned(
    values: &mut Values<'_>,
    scans: &Scans,
    file: &str,
    feet_m: Option<Vec<[f64; 2]>>,
    mass_kg: Option<f64>,
    size: &Size,
) -> Result<Arc<BodyInPose>, Problem> {
    let unit_m = values.named(Column::ScanUnit, SCAN_UNITS);
    let base = values.named(Column::ScanBase, SCAN_BASES);
    let Some(unit_m) = unit_m else {
        let problem = Problem::value(
            "the unit of the scan is not stated",
            "give `scan_unit`: m, cm, mm, in or ft",
        );
        return Err(problem.of(&["scan_unit"]));
    };
    let scan = Scan {
        unit_m,
        base,
        error_m: None,
        leaking: Leaking::Refuse,
        feet_m,
        pose: 1,
        cg_height_m: size.cg_height_m,
        mass_kg,
    };
    let body = scans.body(file, &scan)?;
    agrees(values, size, &body)?;
    Ok(body)
}

/// Whether what the row says of its sizes is that of its scan, the sides in either order.
fn agrees(values: &Values<'_>, size: &Size, body: &BodyInPose) -> Result<(), Problem> {
    for column in [Column::BaseThickness, Column::BaseWidth, Column::Shape] {
        if values.is_filled(column) {
            let message = "is given beside a scan, which has its own";
            return Err(Problem::value(message, "leave it empty").of(&[column.name()]));
        }
    }
    let differs = |said_m: f64, found_m: f64| (said_m - found_m).abs() > SAME_SIZE * said_m;
    let [x, y] = body.plan_m;
    let sides = [
        (Column::Height, size.height_m, [body.height_m; 2]),
        (Column::Thickness, size.thickness_m, [x, y]),
        (Column::Width, size.width_m, [x, y]),
    ];
    for (column, said_m, found_m) in sides {
        let Some(said_m) = said_m else { continue };
        if found_m.iter().all(|found_m| differs(said_m, *found_m)) {
            let of_scan = match column {
                Column::Height => format!("{} m high", number(body.height_m, 3)),
                _ => format!("{} m by {} m", number(x, 3), number(y, 3)),
            };
            let message = format!(
                "says {} m, and the scan is {of_scan}: one of them, or the unit of the scan, is wrong",
                number(said_m, 3)
            );
            let hint = "correct it, or leave the size out";
            return Err(Problem::value(message, hint).of(&[column.name()]));
        }
    }
    Ok(())
}

/// The column of a problem of a body.
fn of_body(problem: &Problem) -> Column {
    let of_key = |column: &&ColumnSpec| problem.is_about(column.name);
    match problem.is_about("feet") {
        true => Column::RestsOn,
        false => COLUMNS
            .iter()
            .find(of_key)
            .map_or(Column::Shape, |spec| spec.column),
    }
}

fn refuse_block(values: &mut Values<'_>, column: Column, error: &BlockError) {
    let hint = match error {
        BlockError::OutOfObject { .. } => {
            "the feet must be under the object and its centre of gravity inside it: check the numbers and their units"
        }
        _ => "check the number and its unit",
    };
    let problem = Problem::value(error.to_string(), hint);
    values.wrong(column, Kind::OutOfRange, &problem);
}

/// What is under one edge.
#[derive(Default)]
struct Support {
    cushion: Option<EdgeCushion>,
    log_sd: Option<f64>,
    source: Option<String>,
}

fn support(values: &mut Values<'_>, lookup: &Lookup<'_>, mass_kg: Option<f64>) -> Support {
    let mut words = Words::default();
    for column in [
        Column::Stiffness,
        Column::PadStiffness,
        Column::SeriesStiffness,
        Column::PadThickness,
    ] {
        if let Some(text) = values.positive_text(column) {
            words.set(column.name(), text);
        }
    }
    if let Some(pads) = values.whole(Column::PadsPerEdge) {
        words.set(Column::PadsPerEdge.name(), pads.to_string());
    }
    let entry = values.text(Column::Cushion);
    let mut support = Support::default();
    if let Some(stiffness_n_m) = values.given_stiffness() {
        let edge = cushion::linear(stiffness_n_m, &words);
        support.cushion = resolved(values, edge, mass_kg);
        return support;
    }
    if !entry.is_empty() {
        let Some(prior) = (lookup.cushion)(&entry) else {
            let names = lookup.cushion_names;
            refuse_entry(values, Column::Cushion, &entry, names, "cushion");
            return support;
        };
        words.set(Column::Cushion.name(), entry);
        match joined(words, prior.words) {
            Ok(both) => words = both,
            Err(problem) => {
                values.wrong(column_of(&problem), Kind::Unreadable, &problem);
                return support;
            }
        }
        support.log_sd = Some(prior.log_sd);
        support.source = Some(prior.source);
    }
    if words.is_empty() {
        return support;
    }
    // Missing data cost the object its verdict, but do not stop the reading.
    let has = |key: &str| words.get(key).is_some();
    if !["stiffness", "pad_stiffness", "law"].into_iter().any(has) {
        let column = pad_column(values);
        values.report(column, Kind::PadAlone, "");
        return Support::default();
    }
    if has("pad_stiffness") && !has("pads_per_edge") {
        values.report(Column::PadStiffness, Kind::PadsMissing, "");
        return Support::default();
    }
    let edge = resolved(values, cushion::resolve(&words, mass_kg), mass_kg);
    edge.map_or_else(Support::default, |edge| Support {
        cushion: Some(edge),
        ..support
    })
}

/// The cushion, if it could be made; what is wrong or doubtful about it is reported.
fn resolved(
    values: &mut Values<'_>,
    edge: Result<EdgeCushion, Problems>,
    mass_kg: Option<f64>,
) -> Option<EdgeCushion> {
    match edge {
        Ok(edge) => {
            let doubts =
                mass_kg.map(|mass| stiffness_warnings(mass, &edge.cushion, edge.pad_thickness_m));
            if doubts.is_some_and(|doubts| !doubts.is_empty()) {
                let column = if values.is_filled(Column::PadStiffness) {
                    Column::PadStiffness
                } else {
                    Column::Stiffness
                };
                values.report(column, Kind::Stiffness, "");
            }
            Some(edge)
        }
        Err(problems) => {
            let is_damping = |problem: &Problem| problem.keys == ["damping"];
            if mass_kg.is_none() && problems.problems.iter().all(is_damping) {
                values.report(Column::Cushion, Kind::DampingMass, "");
            } else {
                for problem in &problems.problems {
                    values.wrong(column_of(problem), Kind::Unreadable, problem);
                }
            }
            None
        }
    }
}

/// Joins the cushion keys of a row with those of the library entry that it names. The row may add
/// pads, layers and a thickness, but not another contact law.
fn joined(mut words: Words, entry: Words) -> Result<Words, Problem> {
    // An entry for a whole edge needs no count of pads; for one pad, a missing count only costs the
    // shock.
    let is_counted = words.get("pads_per_edge").is_some() || entry.get("pads_per_edge").is_some();
    if !is_counted {
        words.set("pads_per_edge", "1");
    }
    let mut both = cushion::with_file(&words, entry)?;
    if !is_counted {
        both.remove("pads_per_edge");
    }
    Ok(both)
}

/// The column of a key of a cushion; keys of a library entry belong to the column with its name.
fn column_of(problem: &Problem) -> Column {
    let specs = problem
        .keys
        .iter()
        .find_map(|key| COLUMNS.iter().find(|spec| spec.name == key));
    specs.map_or(Column::Cushion, |spec| spec.column)
}

fn refuse_entry(
    values: &mut Values<'_>,
    column: Column,
    entry: &str,
    names: &[String],
    library: &str,
) {
    let all: Vec<&str> = names.iter().map(String::as_str).collect();
    let entry = shorten(entry);
    let hint = match nearest(&entry, &all) {
        Some(near) => format!("did you mean {near}?"),
        None if all.is_empty() => {
            format!("no {library} library is available here: put the values into their own columns")
        }
        None => {
            let more = if all.len() > 6 { " and more" } else { "" };
            format!("known: {}{more}", all[..all.len().min(6)].join(", "))
        }
    };
    let message = format!("is not an entry of the {library} library");
    values.wrong(column, Kind::Unreadable, &Problem::value(message, hint));
}

fn tolerance(values: &mut Values<'_>, lookup: &Lookup<'_>) -> Option<Tolerance> {
    let peak_m_s2 = values.positive(Column::Tolerance);
    let pulse_s = peak_m_s2.and_then(|_| values.pulse());
    let stated = Tolerance {
        peak_m_s2,
        duration_s: values.positive(Column::ToleranceDuration).or(pulse_s),
        velocity_change_m_s: values.positive(Column::ToleranceVelocityChange),
        edge_lift_m: values.positive(Column::ToleranceEdgeLift),
        source: "the inventory".to_owned(),
        confidence: Confidence::Stated,
    };
    let has_pulse = stated.duration_s.is_some();
    let is_stated = has_pulse
        || [peak_m_s2, stated.velocity_change_m_s, stated.edge_lift_m]
            .iter()
            .any(Option::is_some);
    if has_pulse && peak_m_s2.is_none() {
        values.report(Column::ToleranceDuration, Kind::PulseAlone, "");
    }
    let entry = values.text(Column::ToleranceEntry);
    if entry.is_empty() {
        return is_stated.then_some(stated);
    }
    if is_stated {
        let hint = "keep either the entry or the values in the other tolerance columns";
        let message = "tolerance_entry and the other tolerance columns exclude each other";
        let problem = Problem::value(message, hint);
        values.wrong(Column::ToleranceEntry, Kind::Unreadable, &problem);
        return None;
    }
    let found = (lookup.tolerance)(&entry);
    if found.is_none() {
        let names = lookup.tolerance_names;
        refuse_entry(values, Column::ToleranceEntry, &entry, names, "tolerance");
    }
    found
}

fn restitution(values: &mut Values<'_>, blocks: &[Block]) -> Restitution {
    // The word "Housner" has no digit and counts as missing, which means the same.
    let value = values.positive(Column::Restitution);
    let factor = values.positive(Column::RestitutionFactor);
    let (column, restitution) = match (value, factor) {
        (None, None) => return Restitution::Housner,
        (Some(value), None) => (Column::Restitution, Restitution::Value(value)),
        (Some(_), Some(_)) => {
            let hint = "keep one of them; the factor multiplies Housner's restitution";
            let message = "restitution and restitution_factor exclude each other";
            let problem = Problem::value(message, hint);
            values.wrong(Column::RestitutionFactor, Kind::Unreadable, &problem);
            return Restitution::Housner;
        }
        (None, Some(factor)) => (Column::RestitutionFactor, Restitution::Factor(factor)),
    };
    checked(restitution, blocks).unwrap_or_else(|problem| {
        values.wrong(column, Kind::OutOfRange, &problem);
        Restitution::Housner
    })
}

/// The first column that describes a pad.
fn pad_column(values: &Values<'_>) -> Column {
    let columns = [
        Column::PadThickness,
        Column::PadsPerEdge,
        Column::SeriesStiffness,
    ];
    columns
        .into_iter()
        .find(|column| values.is_filled(*column))
        .unwrap_or(Column::PadThickness)
}
