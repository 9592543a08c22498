//! A body as it is described: by its shape, by its feet, or by a scan.

use std::ops::RangeInclusive;

use freestand::hull::HullError;
use freestand::hull::shapes::{Outline, upright};
use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::{Dimension, parse_grid, shorten};
use freestand_input::words::{Choices, number};
use freestand_scan::body::{Leaking, Solid, Underside, scanned_body};
use freestand_scan::mesh::Mesh;

use super::{BodyInPose, BodyKind, Surface};

/// How far the surface of a scan may be from the true one \[m\].
const SCAN_ERROR_M: f64 = 0.002;

/// Densities that objects have, from a hollow one of paper to one of platinum \[kg/m³\].
const DENSITIES_KG_M3: RangeInclusive<f64> = 2.0..=25_000.0;

/// The most feet.
const MAX_FEET: usize = 100;

/// The most corners of a regular polygon: with more it is a cylinder.
const MAX_CORNERS: u32 = 60;

/// The name of a shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// A rectangular base.
    Box,
    /// A round base.
    Cylinder,
    /// A regular polygon with so many corners.
    Polygon(u32),
}

const FORM_HINT: &str =
    "give box, cylinder, or polygon:N with a number of corners, such as polygon:8";

impl Form {
    /// The shape of this name.
    ///
    /// # Errors
    /// A name that is not known, and a shape that does not stand.
    pub fn of(text: &str) -> Result<Self, Problem> {
        let plain = text.trim().to_lowercase();
        match plain.as_str() {
            "box" | "prism" => return Ok(Self::Box),
            "cylinder" => return Ok(Self::Cylinder),
            "sphere" | "ball" => {
                let message = "a sphere does not stand: it rolls away";
                return Err(Problem::value(message, FORM_HINT));
            }
            _ => {}
        }
        let corners = plain.strip_prefix("polygon:").map(str::trim);
        let message = match corners.map(str::parse::<u32>) {
            Some(Ok(count @ 3..=MAX_CORNERS)) => return Ok(Self::Polygon(count)),
            Some(_) => format!("a polygon has from 3 to {MAX_CORNERS} corners"),
            None => format!("`shape` \"{}\" is not known", shorten(text)),
        };
        Err(Problem::value(message, FORM_HINT))
    }
}

/// The points on which a body stands \[m\], written as "x, y; x, y; …".
///
/// # Errors
/// What is no point, and fewer than three or very many of them.
pub fn feet_of(text: &str) -> Result<Vec<[f64; 2]>, Problem> {
    let hint = "write \"x, y\" for each, with semicolons between them, such as \"-0.2 m, -0.1 m; 0.2 m, -0.1 m; 0 m, \
                0.2 m\"";
    let point = |text: &str| match parse_grid(text, Dimension::Length)?[..] {
        [x, y] => Ok([x, y]),
        _ => {
            let message = format!("\"{}\" is not a point", shorten(text.trim()));
            Err(Problem::value(message, hint))
        }
    };
    let points = text
        .split([';', '\n'])
        .filter(|text| !text.trim().is_empty());
    let feet: Vec<[f64; 2]> = points.map(point).collect::<Result<_, _>>()?;
    match feet.len() {
        3..=MAX_FEET => Ok(feet),
        count => {
            let message =
                format!("an object stands on 3 to {MAX_FEET} feet, and {count} were given");
            Err(Problem::value(message, hint))
        }
    }
}

/// A body of a simple shape.
#[derive(Debug, Clone, PartialEq)]
pub struct Upright {
    /// The outline of its base.
    pub outline: Outline,
    /// Its height \[m\].
    pub height_m: f64,
    /// Height of its centre of gravity; `None`: half of its height \[m\].
    pub cg_height_m: Option<f64>,
    /// The points on which it stands, from the middle of the outline; `None`: on its outline \[m\].
    pub feet_m: Option<Vec<[f64; 2]>>,
    /// Its mass, where it is known \[kg\].
    pub mass_kg: Option<f64>,
}

impl Upright {
    /// The body, with problems under the keys `height`, `cg_height` and `feet`.
    ///
    /// # Errors
    /// A centre of gravity that is not inside or not above the feet; feet outside of the outline.
    pub fn body(&self) -> Result<BodyInPose, Problem> {
        let Self {
            outline,
            height_m,
            cg_height_m,
            feet_m,
            mass_kg,
        } = self;
        if let Some(cg_m) = cg_height_m.filter(|cg_m| cg_m >= height_m) {
            let message = format!(
                "the centre of gravity, {} m above the floor, is not inside the object",
                number(cg_m, 4)
            );
            let problem = Problem::value(message, "give a `cg_height` below `height`");
            return Err(problem.of(&["cg_height"]));
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
            return Err(Problem::value(message, hint).of(&["feet"]));
        }
        let kind = match (outline, feet_m) {
            (_, Some(_)) => BodyKind::OnFeet,
            (Outline::Box(_), None) => BodyKind::Box,
            (Outline::Circle(_), None) => BodyKind::Cylinder,
            (Outline::Polygon(..), None) => BodyKind::Polygon,
        };
        let key = if feet_m.is_some() { "feet" } else { "height" };
        let of_mass = mass_kg.unwrap_or(1.0);
        let solid = upright(outline, *height_m, of_mass, *cg_height_m, feet_m.as_deref());
        let unfit = |error: HullError| match error {
            HullError::Outside => Problem::value(
                "the centre of gravity is not above the points on which the object stands: it tips over",
                "give feet on all sides of the middle of the object",
            ),
            _ => Problem::value(error.to_string(), "check the sizes and the feet"),
        };
        let (body, volume_m3) = solid.map_err(|error| unfit(error).of(&[key]))?;
        let posed = BodyInPose::new(&body, kind, volume_m3, false, *mass_kg, 1, 0.0);
        posed.map_err(|problem| match feet_m {
            Some(_) => unfit(HullError::Outside).of(&[key]),
            None => problem.of(&[key]),
        })
    }
}

/// The lengths of one unit of a scan \[m\].
pub const SCAN_UNITS: Choices<f64> = &[
    (1.0, "m", "Metres"),
    (0.01, "cm", "Centimetres"),
    (0.001, "mm", "Millimetres"),
    (0.0254, "in", "Inches"),
    (0.3048, "ft", "Feet"),
];

/// What is known of the underside of a scan.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ScanBase {
    /// It was scanned.
    Measured,
    /// It is taken to be flat.
    Flat,
}

/// These by name.
pub const SCAN_BASES: Choices<ScanBase> = &[
    (
        ScanBase::Measured,
        "measured",
        "It was scanned as well, to less than 1 mm",
    ),
    (
        ScanBase::Flat,
        "flat",
        "Nobody saw it: what is within the error of the scan from its lowest point is on the floor",
    ),
];

/// A scan, as it is described.
#[derive(Debug, Clone, PartialEq)]
pub struct Scan {
    /// The length of one unit of its file \[m\].
    pub unit_m: f64,
    /// What is known of its underside; `None`: nothing.
    pub base: Option<ScanBase>,
    /// How far its surface may be from the true one \[m\]; `None`: 2 mm, and 0 where the base was measured.
    pub error_m: Option<f64>,
    /// What is done where it has holes.
    pub leaking: Leaking,
    /// The points on which the object stands, in the axes of the scan \[m\].
    pub feet_m: Option<Vec<[f64; 2]>>,
    /// The number of its stable pose, from 1.
    pub pose: usize,
    /// Height of its centre of gravity above its lowest point, where it is known \[m\].
    pub cg_height_m: Option<f64>,
    /// Its mass, where it is known \[kg\].
    pub mass_kg: Option<f64>,
}

impl Scan {
    /// What contradicts, before its file is read.
    pub fn contradictions(&self) -> Problems {
        let mut problems = Problems::default();
        let is_measured = self.base == Some(ScanBase::Measured);
        if is_measured && self.feet_m.is_some() {
            let message = "`feet` and a measured base exclude each other";
            let hint = "keep the scan as it is, or give `scan_base = \"flat\"`";
            problems.push(Problem::value(message, hint).of(&["feet", "scan_base"]));
        }
        if !is_measured && self.pose > 1 {
            let message = "only a scan with a measured base can stand in another pose";
            let hint = "add `scan_base = \"measured\"`, or turn the scan and leave `stand_on` out";
            problems.push(Problem::value(message, hint).of(&["stand_on"]));
        }
        problems
    }

    /// The body, with problems under the keys `scan`, `scan_unit`, `mass` and `stand_on`.
    ///
    /// # Errors
    /// A mesh that is no body, sizes or a density that no object has, and a body that does not stand.
    pub fn body(&self, mesh: &Mesh) -> Result<BodyInPose, Problem> {
        let within_m = self.error_m.unwrap_or(SCAN_ERROR_M);
        let (underside, kind) = match (self.base, &self.feet_m) {
            (Some(ScanBase::Measured), _) => (Underside::Measured, BodyKind::Scan),
            (_, Some(feet_m)) => (
                Underside::Feet(feet_m.clone(), within_m),
                BodyKind::ScanOnFeet,
            ),
            _ => (Underside::Flat(within_m), BodyKind::ScanOnFlatBase),
        };
        let of_mass = self.mass_kg.unwrap_or(1.0);
        let solid = scanned_body(mesh, self.unit_m, of_mass, self.leaking, &underside)
            .map_err(|problem| problem.of(&["scan"]))?;
        let solid = match self.cg_height_m {
            None => solid,
            Some(height_m) => solid.with_cg_height(height_m).map_err(|_| {
                let message = format!(
                    "the centre of gravity, {} m above the lowest point, is not inside the scan",
                    number(height_m, 4)
                );
                let hint = "give its height above the floor on which the scan stands";
                Problem::value(message, hint).of(&["cg_height"])
            })?,
        };
        let Solid {
            body,
            volume_m3,
            cg_m,
            is_hull,
        } = solid;
        let density = of_mass / volume_m3;
        if self.mass_kg.is_some() && !DENSITIES_KG_M3.contains(&density) {
            let message = format!(
                "a scan of {} m³ with this mass has {} kg/m³",
                number(volume_m3, 3),
                number(density, 3)
            );
            let hint = "correct the unit of the scan, or the mass";
            return Err(Problem::value(message, hint).of(&["scan_unit", "mass"]));
        }
        let error_m = match kind {
            BodyKind::Scan => self.error_m.unwrap_or(0.0),
            _ => within_m,
        };
        let key = if self.pose > 1 { "stand_on" } else { "scan" };
        let posed = BodyInPose::new(
            &body,
            kind,
            volume_m3,
            is_hull,
            self.mass_kg,
            self.pose,
            error_m,
        );
        let posed = posed.map_err(|problem| problem.of(&[key]))?;
        Ok(BodyInPose {
            is_cg_stated: self.cg_height_m.is_some(),
            // Also where its hull takes its place: it is what the scanner saw.
            surface: Surface::of_mesh(mesh, self.unit_m, cg_m),
            ..posed
        })
    }
}
