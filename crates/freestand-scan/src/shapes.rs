//! Bodies of simple shapes: upright prisms on a polygon, cylinders, and boxes on feet.

use std::f64::consts::TAU;

use freestand::hull::HullBody;
use freestand_input::problem::Problem;
use parry3d_f64::math::Vector;
use parry3d_f64::transformation::try_convex_hull;

use crate::body::{Solid, about};

/// Corners of the polygon that stands for a circle: it is 0.03 % narrower between two of them.
const OF_A_CIRCLE: u32 = 120;

/// The outline of an upright body from above.
#[derive(Debug, Clone, PartialEq)]
pub enum Outline {
    /// A rectangle, along x and along y \[m\].
    Box([f64; 2]),
    /// A circle of this diameter \[m\].
    Circle(f64),
    /// A regular polygon with this number of corners on a circle of this diameter \[m\]; one corner is on +x.
    Polygon(u32, f64),
}

impl Outline {
    /// Its corners, anticlockwise \[m\].
    fn corners_m(&self) -> Vec<[f64; 2]> {
        let on_circle = |count: u32, diameter_m: f64| {
            let corner = |one: u32| {
                let (sin, cos) = (TAU * f64::from(one) / f64::from(count)).sin_cos();
                [0.5 * diameter_m * cos, 0.5 * diameter_m * sin]
            };
            (0..count).map(corner).collect()
        };
        match *self {
            Self::Box([x, y]) => [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]]
                .map(|[to_x, to_y]: [f64; 2]| [0.5 * to_x * x, 0.5 * to_y * y])
                .to_vec(),
            Self::Circle(diameter_m) => on_circle(OF_A_CIRCLE, diameter_m),
            Self::Polygon(count, diameter_m) => on_circle(count, diameter_m),
        }
    }

    /// Its area \[m²\], and the second moments of area about x and y over it \[m²\].
    fn area(&self) -> (f64, [f64; 2]) {
        match *self {
            Self::Box([x, y]) => (x * y, [y * y / 12.0, x * x / 12.0]),
            Self::Circle(diameter_m) => {
                let r2 = 0.25 * diameter_m * diameter_m;
                (0.5 * TAU * r2, [0.25 * r2; 2])
            }
            // I = n r⁴/24 (2 + cos 2π/n) sin 2π/n, A = n r²/2 sin 2π/n.
            Self::Polygon(count, diameter_m) => {
                let (r2, n) = (0.25 * diameter_m * diameter_m, f64::from(count));
                let (sin, cos) = (TAU / n).sin_cos();
                (0.5 * n * r2 * sin, [r2 * (2.0 + cos) / 12.0; 2])
            }
        }
    }
}

/// A uniform upright body of this height and mass, on its outline or on feet: points of the floor from the middle of
/// the outline, toes of no height.
///
/// `cg_height_m` moves its centre of gravity up or down; its moments of inertia about it stay those of the
/// uniform body.
///
/// # Errors
/// A centre of gravity that is not above the points on which it stands.
pub fn upright(
    outline: &Outline,
    height_m: f64,
    mass_kg: f64,
    cg_height_m: Option<f64>,
    feet_m: Option<&[[f64; 2]]>,
) -> Result<Solid, Problem> {
    let corners_m = outline.corners_m();
    let at = |z: f64| move |[x, y]: &[f64; 2]| Vector::new(*x, *y, z);
    let below = feet_m.unwrap_or(&corners_m).iter().map(at(0.0));
    let points: Vec<Vector> = below.chain(corners_m.iter().map(at(height_m))).collect();
    let unfit = |error: &dyn std::fmt::Display| {
        Problem::value(
            error.to_string(),
            "check the sizes, the centre of gravity and the feet",
        )
    };
    let (points, faces) = try_convex_hull(&points).map_err(|error| unfit(&error))?;
    let cg_m = [0.0, 0.0, cg_height_m.unwrap_or(0.5 * height_m)];
    let (area_m2, [of_x, of_y]) = outline.area();
    let high = height_m * height_m / 12.0;
    let of = [of_x + high, of_y + high, of_x + of_y].map(|of| mass_kg * of);
    let [x, y, z] = of;
    let inertia_kg_m2 = [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]];
    let body =
        about(cg_m, &points, &faces).and_then(|hull| HullBody::new(mass_kg, inertia_kg_m2, hull));
    Ok(Solid {
        body: body.map_err(|error| unfit(&error))?,
        volume_m3: area_m2 * height_m,
        cg_m,
        is_hull: false,
    })
}
