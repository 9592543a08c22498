//! The shape of an object: a box, a cylinder, a regular polygon, on feet, or as it was scanned.

use std::ops::RangeInclusive;
use std::path::Path;
use std::sync::Arc;

use freestand::hull::HullError;
use freestand::hull::shake::Contact;
use freestand::hull::shapes::{Outline, upright};
use freestand_input::problem::Problem;
use freestand_input::quantity::{Dimension, parse_grid, shorten};
use freestand_input::word_reader::WordReader;
use freestand_input::words::{Choices, number};
use freestand_input::written::Written;
use freestand_scan::body::{Leaking, Solid, Underside, scanned_body};
use freestand_study::hull::{BodyInPose, BodyKind};
use freestand_study::spatial;

use crate::block;
use crate::files::Files;
use crate::request::{Switch, one_of, request};

/// How far the surface of a scan may be from the true one \[m\].
const SCAN_ERROR_M: f64 = 0.002;

/// Densities that objects have, from a hollow one of paper to one of platinum \[kg/m³\].
const DENSITIES_KG_M3: RangeInclusive<f64> = 2.0..=25_000.0;

/// The most feet.
const MAX_FEET: usize = 100;

/// The most corners of a regular polygon: with more it is a cylinder.
const MAX_CORNERS: u32 = 60;

request! {
    /// The shape of an object.
    pub struct BodyShape {
        /// Shape of the object: box, cylinder or polygon:N, which has N corners on a circle
        #[arg(long, value_name = "box|cylinder|polygon:N", help_heading = "The shape, in three dimensions")]
        pub shape: Option<Written>,
        /// Diameter of a cylinder, or of the circle through the corners of a polygon, in place of --thickness
        #[arg(long, value_name = "LENGTH", help_heading = "The shape, in three dimensions")]
        pub diameter: Option<Written>,
        /// Points on which the object stands, from the middle of its outline (of a scan: in its axes): "x, y; x,
        /// y; …", such as "-200 mm, -150 mm; 200 mm, -150 mm; 0 mm, 180 mm" [default: its outline]
        #[arg(
            long,
            value_name = "X, Y; X, Y; …",
            allow_hyphen_values = true,
            help_heading = "The shape, in three dimensions"
        )]
        pub feet: Option<Written>,
        /// Scan of the object, z upward: OBJ, STL, PLY, or binary glTF
        #[arg(long, value_name = "FILE", help_heading = "A scan")]
        pub scan: Option<Written>,
        /// Unit of length of the scan (the glTF standard prescribes metres; exporters do not always follow it)
        #[arg(long, value_name = "UNIT", value_parser = one_of(SCAN_UNITS), help_heading = "A scan")]
        pub scan_unit: Option<Written>,
        /// The underside of the scan [default: flat]
        #[arg(long, value_name = "BASE", value_parser = one_of(SCAN_BASES), help_heading = "A scan")]
        pub scan_base: Option<Written>,
        /// How far the surface of the scan may be from the true one; with a flat base, everything within this
        /// distance of the lowest point is taken to touch the floor [default: 2 mm]
        #[arg(long, value_name = "LENGTH", help_heading = "A scan")]
        pub scan_error: Option<Written>,
        /// Use the convex hull in place of a scan with holes or of several parts
        #[arg(long, action = clap::ArgAction::SetTrue, help_heading = "A scan")]
        pub scan_hull: Switch,
        /// Stable pose in which the scanned object stands, by its number in `stable_poses`; others than 1, the most upright
        /// one, need --scan-base measured [default: 1]
        #[arg(long, value_name = "N", help_heading = "A scan")]
        pub stand_on: Option<Written>,
    }
}

request! {
    /// How a body touches the floor.
    pub struct Contacts {
        /// Damping of the contacts of a shape or a scan with the floor, as a ratio [default: 20 %]
        #[arg(long, value_name = "RATIO", help_heading = "The shape, in three dimensions")]
        pub contact_damping: Option<Written>,
        /// How far three points of a shape or a scan sink into the floor under its weight [default: 0.1 mm for a scan, 0.01 mm
        /// for a shape; less where the centre of gravity is lower than 250 mm]
        #[arg(long, value_name = "LENGTH", help_heading = "The shape, in three dimensions")]
        pub contact_sinking: Option<Written>,
        /// Coefficient of rolling friction of a cylinder that rolls on its rim: the lever arm of the force of the floor over
        /// the radius [default: 0]
        #[arg(long, value_name = "RATIO", help_heading = "The shape, in three dimensions")]
        pub rolling_friction: Option<Written>,
    }
}

/// Its keys.
pub(crate) const KEYS: [&str; 12] = [
    "shape",
    "diameter",
    "feet",
    "scan",
    "scan_unit",
    "scan_base",
    "scan_error",
    "scan_hull",
    "stand_on",
    "contact_damping",
    "contact_sinking",
    "rolling_friction",
];

/// Its keys of a scan alone.
pub(crate) const OF_SCAN: [&str; 5] = [
    "scan_unit",
    "scan_base",
    "scan_error",
    "scan_hull",
    "stand_on",
];

/// The lengths of one unit of a scan \[m\].
const SCAN_UNITS: Choices<f64> = &[
    (1.0, "m", "Metres"),
    (0.01, "cm", "Centimetres"),
    (0.001, "mm", "Millimetres"),
    (0.0254, "in", "Inches"),
    (0.3048, "ft", "Feet"),
];

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum ScanBase {
    Measured,
    Flat,
}

const SCAN_BASES: Choices<ScanBase> = &[
    (
        ScanBase::Measured,
        "measured",
        "It was scanned as well, to less than 1 mm",
    ),
    (
        ScanBase::Flat,
        "flat",
        "Nobody saw it: what is within --scan-error of the lowest point is on the floor",
    ),
];

/// The name of a shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ShapeName {
    Box,
    Cylinder,
    Polygon(u32),
}

const SHAPE_HINT: &str =
    "give box, cylinder, or polygon:N with a number of corners, such as polygon:8";

/// The shape of this name.
fn shape_of(text: &str) -> Result<ShapeName, Problem> {
    let plain = text.trim().to_lowercase();
    match plain.as_str() {
        "box" | "prism" => return Ok(ShapeName::Box),
        "cylinder" => return Ok(ShapeName::Cylinder),
        "sphere" | "ball" => {
            let message = "a sphere does not stand: it rolls away";
            return Err(Problem::value(message, SHAPE_HINT));
        }
        _ => {}
    }
    let corners = plain.strip_prefix("polygon:").map(str::trim);
    let message = match corners.map(str::parse::<u32>) {
        Some(Ok(count @ 3..=MAX_CORNERS)) => return Ok(ShapeName::Polygon(count)),
        Some(_) => format!("a polygon has from 3 to {MAX_CORNERS} corners"),
        None => format!("`shape` \"{}\" is not known", shorten(text)),
    };
    Err(Problem::value(message, SHAPE_HINT))
}

/// Whether an object is neither a box nor a cylinder on its own outline.
pub(crate) fn is_body(read: &WordReader<'_>, shape: Option<&Written>) -> bool {
    let named = shape.map(|shape| shape_of(&shape.text()));
    read.has("scan") || read.has("feet") || matches!(named, Some(Ok(ShapeName::Polygon(_))))
}

/// The shape that was named; `diameter` alone names a cylinder.
pub(crate) fn named(read: &mut WordReader<'_>) -> Option<ShapeName> {
    let has_diameter = read.has("diameter");
    let Some(text) = read.one("shape") else {
        return has_diameter.then_some(ShapeName::Cylinder);
    };
    let named = match shape_of(text) {
        Ok(ShapeName::Box) if has_diameter => Err(Problem::value(
            "a box has a thickness and a width, and no diameter",
            "give both, or `shape = \"cylinder\"`",
        )),
        named => named,
    };
    if named.is_err() {
        // They may be right for the shape that was meant.
        read.pass(&[
            "height",
            "thickness",
            "width",
            "diameter",
            "cg_height",
            "feet",
        ]);
    }
    read.keep("shape", named)
}

/// The diameter of a round base \[m\]: its thickness has the same meaning.
pub(crate) fn diameter(read: &mut WordReader<'_>) -> Option<f64> {
    read.exclusive("diameter", "thickness");
    read.pass(&["diameter"]);
    let key = match read.has("thickness") {
        true => "thickness",
        false => "diameter",
    };
    block::length(read, key)
}

/// The shape of an object on cushions.
pub(crate) fn on_cushions(read: &mut WordReader<'_>) -> spatial::ShapeName {
    match named(read) {
        Some(ShapeName::Cylinder) => spatial::ShapeName::Cylinder,
        Some(ShapeName::Polygon(_)) => {
            read.note(
                &["shape"],
                "a polygon can be calculated only on a stiff floor",
                "leave `base` and the cushion out, or give a box or a cylinder",
            );
            spatial::ShapeName::Prism
        }
        Some(ShapeName::Box) | None => spatial::ShapeName::Prism,
    }
}

/// The feet \[m\], if they were given.
fn feet(read: &mut WordReader<'_>) -> Option<Vec<[f64; 2]>> {
    let text = read.one("feet")?;
    let hint = "write \"x, y\" for each, with semicolons between them, such as \"-0.2 m, -0.1 m; 0.2 m, -0.1 m; 0 m, \
                0.2 m\"";
    let point = |text: &str| match parse_grid(text, Dimension::Length)?[..] {
        [x, y] => Ok([x, y]),
        _ => {
            let message = format!("\"{}\" is not a point", shorten(text.trim()));
            Err(Problem::value(message, hint))
        }
    };
    let points = text.split(';').filter(|text| !text.trim().is_empty());
    let feet: Result<Vec<[f64; 2]>, Problem> = points.map(point).collect();
    let feet = feet.and_then(|feet| match feet.len() {
        3..=MAX_FEET => Ok(feet),
        count => {
            let message =
                format!("an object stands on 3 to {MAX_FEET} feet, and {count} were given");
            Err(Problem::value(message, hint))
        }
    });
    read.keep("feet", feet)
}

/// How the body touches the floor.
pub(crate) fn contact(read: &mut WordReader<'_>, body: Option<&BodyInPose>) -> Option<Contact> {
    let assumed = Contact::default();
    let assumed = Contact {
        sinking_m: assumed.sinking_m * body.map_or(1.0, BodyInPose::sinking_ratio),
        ..assumed
    };
    let friction = read.non_negative("friction", Dimension::Ratio);
    let damping = read.accepted(
        "contact_damping",
        Dimension::Ratio,
        |ratio| (0.001..=1.0).contains(&ratio),
        ["from 0.1 to 100 %", "such as \"20 %\""],
    );
    let sinking = read.accepted(
        "contact_sinking",
        Dimension::Length,
        |length_m| (1e-6..=0.01).contains(&length_m),
        ["from 0.001 mm to 10 mm", "such as \"0.1 mm\""],
    );
    let rolling = read.accepted(
        "rolling_friction",
        Dimension::Ratio,
        |ratio| (0.0..=1.0).contains(&ratio),
        ["from 0 to 1", "such as \"0.01\""],
    );
    if rolling.is_some() && body.is_some_and(|body| body.kind != BodyKind::Cylinder) {
        read.note(
            &["rolling_friction"],
            "only a cylinder rolls on its rim",
            "leave `rolling_friction` out, or give `shape = \"cylinder\"`",
        );
    }
    let is_right = |key: &str, value: Option<f64>| value.is_some() || !read.has(key);
    let all_right = is_right("friction", friction)
        && is_right("contact_damping", damping)
        && is_right("contact_sinking", sinking)
        && is_right("rolling_friction", rolling);
    all_right.then_some(Contact {
        friction_ratio: friction.unwrap_or(assumed.friction_ratio),
        damping_ratio: damping.unwrap_or(assumed.damping_ratio),
        sinking_m: sinking.unwrap_or(assumed.sinking_m),
        rolling_ratio: rolling.unwrap_or(assumed.rolling_ratio),
    })
}

/// The scanned body, in its pose.
fn scanned(
    read: &mut WordReader<'_>,
    mass_kg: Option<f64>,
    files: &Files,
) -> Option<Arc<BodyInPose>> {
    let path = read.one("scan")?;
    let unit_m = read.choice("scan_unit", SCAN_UNITS);
    read.require(
        "scan_unit",
        "the unit of the scan is not stated",
        "give `scan_unit`: m, cm, mm, in or ft",
    );
    let base = read.choice("scan_base", SCAN_BASES);
    let error_m = read.non_negative("scan_error", Dimension::Length);
    let leaking = match read.flag("scan_hull") {
        true => Leaking::UseHull,
        false => Leaking::Refuse,
    };
    let pose = read.whole_within("stand_on", 1..=1000).unwrap_or(1usize);
    let stands_on_feet = read.has("feet");
    let feet_m = feet(read);
    if base == Some(ScanBase::Measured) && stands_on_feet {
        let message = "`feet` and a measured base exclude each other";
        read.note(
            &["feet", "scan_base"],
            message,
            "keep the scan as it is, or give `scan_base = \"flat\"`",
        );
    }
    if base != Some(ScanBase::Measured) && pose > 1 {
        let message = "only a scan with a measured base can stand in another pose";
        read.note(
            &["stand_on"],
            message,
            "add `scan_base = \"measured\"`, or turn the scan and leave `stand_on` out",
        );
    }
    let mesh = read.keep("scan", files.mesh(path))?;
    if stands_on_feet && feet_m.is_none() {
        return None;
    }
    let within_m = error_m.unwrap_or(SCAN_ERROR_M);
    let underside = match (base, feet_m) {
        (Some(ScanBase::Measured), _) => Underside::Measured,
        (_, Some(feet_m)) => Underside::Feet(feet_m, within_m),
        _ => Underside::Flat(within_m),
    };
    let of_mass = mass_kg.unwrap_or(1.0);
    let solid = scanned_body(&mesh, unit_m?, of_mass, leaking, &underside);
    let in_file = |problem: Problem| problem.in_file(Path::new(path));
    let solid = read.keep("scan", solid.map_err(in_file))?;
    let density = of_mass / solid.volume_m3;
    if mass_kg.is_some() && !DENSITIES_KG_M3.contains(&density) {
        let message = format!(
            "a scan of {} m³ with this mass has {} kg/m³",
            number(solid.volume_m3, 3),
            number(density, 3)
        );
        read.note(
            &["scan_unit", "mass"],
            message,
            "correct the unit of the scan, or the mass",
        );
        return None;
    }
    let kind = match underside {
        Underside::Measured => BodyKind::Scan,
        Underside::Flat(_) => BodyKind::ScanOnFlatBase,
        Underside::Feet(..) => BodyKind::ScanOnFeet,
    };
    let Solid {
        body,
        volume_m3,
        is_hull,
        ..
    } = solid;
    let error_m = match kind {
        BodyKind::Scan => error_m.unwrap_or(0.0),
        _ => within_m,
    };
    let posed = BodyInPose::new(&body, kind, volume_m3, is_hull, mass_kg, pose, error_m);
    let key = if pose > 1 { "stand_on" } else { "scan" };
    read.keep(key, posed).map(Arc::new)
}

/// The body in three dimensions that is asked for: by a scan, by its feet or by its shape.
pub(crate) fn body(
    read: &mut WordReader<'_>,
    mass_kg: Option<f64>,
    files: &Files,
) -> Option<Arc<BodyInPose>> {
    if read.has("scan") {
        read.exclusive("scan", "shape");
        read.pass(&["shape"]);
        return scanned(read, mass_kg, files);
    }
    let is_named = read.has("shape");
    match named(read) {
        None if is_named => None,
        name => shaped(read, name.unwrap_or(ShapeName::Box), mass_kg),
    }
}

/// The body of a simple shape.
fn shaped(
    read: &mut WordReader<'_>,
    name: ShapeName,
    mass_kg: Option<f64>,
) -> Option<Arc<BodyInPose>> {
    let height = block::height(read);
    let cg_height_m = read.positive("cg_height", Dimension::Length);
    let outline = match name {
        ShapeName::Box => {
            let sides = ["thickness", "width"].map(|key| block::length(read, key));
            sides[0].zip(sides[1]).map(|(x, y)| Outline::Box([x, y]))
        }
        ShapeName::Cylinder | ShapeName::Polygon(_) => {
            let diameter = diameter(read);
            diameter.map(|diameter_m| match name {
                ShapeName::Polygon(count) => Outline::Polygon(count, diameter_m),
                _ => Outline::Circle(diameter_m),
            })
        }
    };
    let stands_on_feet = read.has("feet");
    let feet_m = feet(read);
    if stands_on_feet && feet_m.is_none() {
        return None;
    }
    let (height_m, outline) = height.zip(outline)?;
    if let Some(cg_m) = cg_height_m.filter(|cg_m| *cg_m >= height_m) {
        let message = format!(
            "the centre of gravity, {} m above the floor, is not inside the object",
            number(cg_m, 4)
        );
        read.note(&["cg_height"], message, "give a `cg_height` below `height`");
        return None;
    }
    let reach = outline.reach_m();
    let is_outside = |[x, y]: &[f64; 2]| x.abs() > 1.01 * reach[0] || y.abs() > 1.01 * reach[1];
    if let Some([x, y]) = feet_m.iter().flatten().find(|foot| is_outside(foot)) {
        let message = format!(
            "the foot at {} mm, {} mm is outside the object, which reaches {} mm and {} mm from its middle",
            number(1e3 * x, 4),
            number(1e3 * y, 4),
            number(1e3 * reach[0], 4),
            number(1e3 * reach[1], 4)
        );
        let hint = "measure the feet from the middle of the outline; to outriggers, give the sizes around them";
        read.note(&["feet"], message, hint);
        return None;
    }
    let solid = upright(
        &outline,
        height_m,
        mass_kg.unwrap_or(1.0),
        cg_height_m,
        feet_m.as_deref(),
    );
    let key = if stands_on_feet { "feet" } else { "height" };
    let unfit = |error: HullError| match error {
        HullError::Outside => Problem::value(
            "the centre of gravity is not above the points on which the object stands: it tips over",
            "give feet on all sides of the middle of the object",
        ),
        _ => Problem::value(error.to_string(), "check the sizes and the feet"),
    };
    let (body, volume_m3) = read.keep(key, solid.map_err(unfit))?;
    let kind = match (name, stands_on_feet) {
        (_, true) => BodyKind::OnFeet,
        (ShapeName::Box, _) => BodyKind::Box,
        (ShapeName::Cylinder, _) => BodyKind::Cylinder,
        (ShapeName::Polygon(_), _) => BodyKind::Polygon,
    };
    let posed = BodyInPose::new(&body, kind, volume_m3, false, mass_kg, 1, 0.0);
    read.keep(key, posed).map(Arc::new)
}
