//! The shape of an object: a box, a cylinder, a regular polygon, on feet, or as it was scanned.

use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

use freestand::hull::shake::Contact;
use freestand::hull::shapes::Outline;
use freestand_input::file::sha256_hex;
use freestand_input::problem::Problem;
use freestand_input::quantity::Dimension;
use freestand_input::word_reader::WordReader;
use freestand_input::written::Written;
use freestand_scan::body::Leaking;
use freestand_scan::formats::parse_mesh;
use freestand_study::hull::body::{Form, SCAN_BASES, SCAN_UNITS, Scan, Upright, feet_of};
use freestand_study::hull::{BodyInPose, BodyKind};
use freestand_study::spatial;

use crate::block;
use crate::files::{Files, ScanFile};
use crate::request::{Switch, one_of, request};

request! {
    /// The shape of an object.
    pub struct BodyShape {
        /// Shape of the object: box, cylinder or polygon:N, which has N corners on a circle
        pub shape = "box|cylinder|polygon:N" under "The shape, in three dimensions",
        /// Diameter of a cylinder, or of the circle through the corners of a polygon, in place of --thickness
        pub diameter = "LENGTH" under "The shape, in three dimensions",
        /// Points on which the object stands, from the middle of its outline (of a scan: in its axes): "x, y; x,
        /// y; …", such as "-200 mm, -150 mm; 200 mm, -150 mm; 0 mm, 180 mm" [default: its outline]
        pub feet = "X, Y; X, Y; …" with (allow_hyphen_values = true) under "The shape, in three dimensions",
        /// Scan of the object, z upward: OBJ, STL, PLY, or binary glTF
        pub scan = "FILE" under "A scan",
        /// Unit of length of the scan (the glTF standard prescribes metres; exporters do not always follow it)
        pub scan_unit = "UNIT" with (value_parser = one_of(SCAN_UNITS)) under "A scan",
        /// The underside of the scan [default: flat]
        pub scan_base = "BASE" with (value_parser = one_of(SCAN_BASES)) under "A scan",
        /// How far the surface of the scan may be from the true one; with a flat base, everything within this
        /// distance of the lowest point is taken to touch the floor [default: 2 mm]
        pub scan_error = "LENGTH" under "A scan",
        /// Use the convex hull in place of a scan with holes or of several parts
        #[arg(long, action = clap::ArgAction::SetTrue, help_heading = "A scan")]
        pub scan_hull: Switch,
        /// Stable pose in which the scanned object stands, by its number in `stable_poses`; others than 1, the most upright
        /// one, need --scan-base measured [default: 1]
        pub stand_on = "N" under "A scan",
    }
}

request! {
    /// How a body touches the floor.
    pub struct Contacts under "The shape, in three dimensions" {
        /// Damping of the contacts of a shape or a scan with the floor, as a ratio [default: 20 %]
        pub contact_damping = "RATIO",
        /// How far three points of a shape or a scan sink into the floor under its weight [default: 0.1 mm for a scan, 0.01 mm
        /// for a shape; less where the centre of gravity is lower than 250 mm]
        pub contact_sinking = "LENGTH",
        /// Coefficient of rolling friction of a cylinder that rolls on its rim: the lever arm of the force of the floor over
        /// the radius [default: 0]
        pub rolling_friction = "RATIO",
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

impl BodyShape {
    /// Whether it is a polygon.
    pub(crate) fn is_polygon(&self) -> bool {
        let named = self.shape.as_ref().map(|shape| Form::of(&shape.text()));
        matches!(named, Some(Ok(Form::Polygon(_))))
    }
}

/// Whether an object is neither a box nor a cylinder on its own outline.
pub(crate) fn is_body(read: &WordReader<'_>, shape: Option<&Written>) -> bool {
    let named = shape.map(|shape| Form::of(&shape.text()));
    read.has("scan") || read.has("feet") || matches!(named, Some(Ok(Form::Polygon(_))))
}

/// The shape that was named; `diameter` alone names a cylinder.
pub(crate) fn named(read: &mut WordReader<'_>) -> Option<Form> {
    let has_diameter = read.has("diameter");
    let Some(text) = read.one("shape") else {
        return has_diameter.then_some(Form::Cylinder);
    };
    let named = match Form::of(text) {
        Ok(Form::Box) if has_diameter => Err(Problem::value(
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
        Some(Form::Cylinder) => spatial::ShapeName::Cylinder,
        Some(Form::Polygon(_)) => {
            read.note(
                &["shape"],
                "a polygon can be calculated only on a stiff floor",
                "leave `base` and the cushion out, or give a box or a cylinder",
            );
            spatial::ShapeName::Prism
        }
        Some(Form::Box) | None => spatial::ShapeName::Prism,
    }
}

/// The feet \[m\], if they were given.
fn feet(read: &mut WordReader<'_>) -> Option<Vec<[f64; 2]>> {
    let text = read.one("feet")?;
    read.keep("feet", feet_of(text))
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
    let scan = Scan {
        unit_m: unit_m.unwrap_or(1.0),
        base,
        error_m,
        leaking,
        feet_m: feet(read),
        pose,
        cg_height_m: read.positive("cg_height", Dimension::Length),
        mass_kg,
    };
    scan.contradictions()
        .problems
        .into_iter()
        .for_each(|problem| read.problems.push(problem));
    let file = read.keep("scan", files.scan(path))?;
    if stands_on_feet && scan.feet_m.is_none() {
        return None;
    }
    unit_m?;
    let body = match file {
        ScanFile::Mesh(mesh) => scan.body(&mesh).map(Arc::new),
        ScanFile::Bytes(bytes) => body_of(&scan, &bytes),
    };
    let body = body.map_err(|problem| match problem.is_about("scan") {
        true => problem.in_file(Path::new(path)),
        false => problem,
    });
    read.problems.keep(body)
}

/// A body with its scan and the SHA-256 of the file of that.
type OfScan = (String, Scan, Arc<BodyInPose>);

/// The body that was made last from a file: the page asks about one scan again and again, and a large one takes
/// seconds.
static LAST: Mutex<Option<OfScan>> = Mutex::new(None);

/// The body of a scan with this content of its file, made anew unless it is the last one.
fn body_of(scan: &Scan, bytes: &[u8]) -> Result<Arc<BodyInPose>, Problem> {
    let sha256 = sha256_hex(bytes);
    let last = LAST.lock().unwrap_or_else(PoisonError::into_inner).clone();
    if let Some((_, _, body)) = last.filter(|(of, with, _)| *of == sha256 && with == scan) {
        return Ok(body);
    }
    let mesh = parse_mesh(bytes).map_err(|problem| problem.of(&["scan"]))?;
    let body = Arc::new(scan.body(&mesh)?);
    let made = Some((sha256, scan.clone(), Arc::clone(&body)));
    *LAST.lock().unwrap_or_else(PoisonError::into_inner) = made;
    Ok(body)
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
        name => shaped(read, name.unwrap_or(Form::Box), mass_kg),
    }
}

/// The body of a simple shape.
fn shaped(read: &mut WordReader<'_>, name: Form, mass_kg: Option<f64>) -> Option<Arc<BodyInPose>> {
    let height = block::height(read);
    let cg_height_m = read.positive("cg_height", Dimension::Length);
    let outline = match name {
        Form::Box => {
            let sides = ["thickness", "width"].map(|key| block::length(read, key));
            sides[0].zip(sides[1]).map(|(x, y)| Outline::Box([x, y]))
        }
        Form::Cylinder | Form::Polygon(_) => {
            let diameter = diameter(read);
            diameter.map(|diameter_m| match name {
                Form::Polygon(count) => Outline::Polygon(count, diameter_m),
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
    let upright = Upright {
        outline,
        height_m,
        cg_height_m,
        feet_m,
        mass_kg,
    };
    read.problems.keep(upright.body()).map(Arc::new)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The same file with the same options is not read again, and with other options it is.
    #[test]
    fn the_last_scan_is_kept() {
        let cube = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 2\nv 1 0 2\nv 1 1 2\nv 0 1 2\nf 4 3 2 1\nf 5 6 7 8\n\
                    f 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
        let scan = Scan {
            unit_m: 1.0,
            base: None,
            error_m: None,
            leaking: Leaking::Refuse,
            feet_m: None,
            pose: 1,
            cg_height_m: None,
            mass_kg: None,
        };
        let bytes = cube.as_bytes();
        let first = body_of(&scan, bytes).unwrap();
        assert!(Arc::ptr_eq(&first, &body_of(&scan, bytes).unwrap()));
        let lower = Scan {
            cg_height_m: Some(0.5),
            ..scan.clone()
        };
        let other = body_of(&lower, bytes).unwrap();
        assert!(other.barrier.angle_rad() > first.barrier.angle_rad());
        let taller = cube.replace(" 2\n", " 3\n");
        let other = body_of(&scan, taller.as_bytes()).unwrap();
        assert!(other.height_m > 1.4 * first.height_m);
    }
}
