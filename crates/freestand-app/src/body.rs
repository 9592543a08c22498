//! The shape of an object: a box, a cylinder, a regular polygon, on feet, or as it was scanned.

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
        /// Unit of length of the scan; glTF is in metres
        #[arg(long, value_name = "UNIT", value_parser = one_of(SCAN_UNITS), help_heading = "A scan")]
        pub scan_unit: Option<Written>,
        /// The underside of the scan [default: flat]
        #[arg(long, value_name = "BASE", value_parser = one_of(SCAN_BASES), help_heading = "A scan")]
        pub scan_base: Option<Written>,
        /// How far the surface of the scan may be from the true one: what is this near to the lowest point of a
        /// flat base is on the floor [default: 2 mm]
        #[arg(long, value_name = "LENGTH", help_heading = "A scan")]
        pub scan_error: Option<Written>,
        /// Let the convex hull take the place of a scan with holes or in several parts
        #[arg(long, action = clap::ArgAction::SetTrue, help_heading = "A scan")]
        pub scan_hull: Switch,
        /// Stable pose in which the scanned object stands, by its number in `stable_poses`; 1 is the most upright
        /// one [default: 1]
        #[arg(long, value_name = "N", help_heading = "A scan")]
        pub stand_on: Option<Written>,
        /// Damping of the contacts of such a body with the floor, as a ratio [default: 20 %]
        #[arg(long, value_name = "RATIO", help_heading = "The shape, in three dimensions")]
        pub contact_damping: Option<Written>,
        /// How far three points of such a body sink into the floor under its weight [default: 0.1 mm]
        #[arg(long, value_name = "LENGTH", help_heading = "The shape, in three dimensions")]
        pub contact_sinking: Option<Written>,
    }
}

/// Its keys.
pub(crate) const KEYS: [&str; 11] = [
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

/// The shape that was named; `diameter` alone names a cylinder.
pub(crate) fn named(read: &mut WordReader<'_>) -> Option<ShapeName> {
    let Some(text) = read.one("shape") else {
        return read.has("diameter").then_some(ShapeName::Cylinder);
    };
    let plain = text.trim().to_lowercase();
    let has_diameter = read.has("diameter");
    let hint = "give box, cylinder, or polygon:N with a number of corners, such as polygon:8";
    let named = match plain.as_str() {
        "box" | "prism" if has_diameter => Err(Problem::value(
            "a box has a thickness and a width, and no diameter",
            "give both, or `shape = \"cylinder\"`",
        )),
        "box" | "prism" => Ok(ShapeName::Box),
        "sphere" | "ball" => Err(Problem::value(
            "a sphere does not stand: it rolls away",
            hint,
        )),
        "cylinder" => Ok(ShapeName::Cylinder),
        _ => {
            let corners = plain.strip_prefix("polygon:").map(str::trim);
            match corners.map(str::parse::<u32>) {
                Some(Ok(count @ 3..=MAX_CORNERS)) => Ok(ShapeName::Polygon(count)),
                Some(_) => Err(Problem::value(
                    format!("a polygon has from 3 to {MAX_CORNERS} corners"),
                    hint,
                )),
                None => Err(Problem::value(
                    format!("`shape` \"{}\" is not known", shorten(text)),
                    hint,
                )),
            }
        }
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

/// The shape of an object on cushions.
pub(crate) fn on_cushions(read: &mut WordReader<'_>) -> spatial::ShapeName {
    match named(read) {
        Some(ShapeName::Cylinder) => spatial::ShapeName::Cylinder,
        Some(ShapeName::Polygon(_)) => {
            read.note(
                &["shape"],
                "a polygon is calculated on a stiff floor alone",
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
pub(crate) fn contact(read: &mut WordReader<'_>) -> Option<Contact> {
    let assumed = Contact::default();
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
        ["from 1 µm to 10 mm", "such as \"0.1 mm\""],
    );
    let is_right = |key: &str, value: Option<f64>| value.is_some() || !read.has(key);
    let all_right = is_right("friction", friction)
        && is_right("contact_damping", damping)
        && is_right("contact_sinking", sinking);
    all_right.then_some(Contact {
        friction_ratio: friction.unwrap_or(assumed.friction_ratio),
        damping_ratio: damping.unwrap_or(assumed.damping_ratio),
        sinking_m: sinking.unwrap_or(assumed.sinking_m),
    })
}

/// The scanned body, in its pose.
pub(crate) fn scanned(
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
        let message = "the side on which another pose stands is known only of a measured scan";
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
    let solid = read.keep("scan", solid)?;
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
    let posed = BodyInPose::new(&body, kind, volume_m3, is_hull, mass_kg, pose);
    let key = if pose > 1 { "stand_on" } else { "scan" };
    read.keep(key, posed).map(Arc::new)
}

/// The body of a simple shape.
pub(crate) fn shaped(
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
            read.exclusive("diameter", "thickness");
            read.pass(&["diameter"]);
            let key = match read.has("thickness") {
                true => "thickness",
                false => "diameter",
            };
            let diameter = block::length(read, key);
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
    let posed = BodyInPose::new(&body, kind, volume_m3, false, mass_kg, 1);
    read.keep(key, posed).map(Arc::new)
}
