//! Bodies of simple shapes: upright prisms on a polygon, cylinders, and boxes on feet.

use std::f64::consts::TAU;

use super::{Hull, HullBody, HullError};

/// Corners of the polygon that stands for a circle, symmetrical about both axes: it is 0.2 % narrower between two of
/// them.
const OF_A_CIRCLE: u32 = 48;

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

    /// How far it reaches from its middle along x and along y \[m\].
    pub fn reach_m(&self) -> [f64; 2] {
        match *self {
            Self::Box(sides_m) => sides_m.map(|side_m| 0.5 * side_m),
            Self::Circle(diameter_m) | Self::Polygon(_, diameter_m) => [0.5 * diameter_m; 2],
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

/// A uniform upright body of this height and mass, on its outline or on feet, and its volume \[m³\]. Feet are points of
/// the floor, from the middle of the outline; they have no height.
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
) -> Result<(HullBody, f64), HullError> {
    let corners_m = match feet_m {
        Some(feet_m) => around(feet_m),
        None => outline.corners_m(),
    };
    let cg_m = cg_height_m.unwrap_or(0.5 * height_m);
    let (area_m2, [of_x, of_y]) = outline.area();
    let high = height_m * height_m / 12.0;
    let [x, y, z] = [of_x + high, of_y + high, of_x + of_y].map(|of| mass_kg * of);
    let inertia_kg_m2 = [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]];
    let hull = prism(&corners_m, [-cg_m, height_m - cg_m])?;
    let body = HullBody::new(mass_kg, inertia_kg_m2, hull)?;
    Ok((body, area_m2 * height_m))
}

/// An upright prism between two heights, on corners that go round anticlockwise.
fn prism(corners_m: &[[f64; 2]], heights_m: [f64; 2]) -> Result<Hull, HullError> {
    let count = corners_m.len();
    let at = |z: f64| move |[x, y]: &[f64; 2]| [*x, *y, z];
    let [low, high] = heights_m;
    let vertices = corners_m
        .iter()
        .map(at(low))
        .chain(corners_m.iter().map(at(high)));
    let sides = (0..count).flat_map(|one| {
        let next = (one + 1) % count;
        [[one, next, count + next], [one, count + next, count + one]]
    });
    let ends =
        (2..count).flat_map(|one| [[0, one, one - 1], [count, count + one - 1, count + one]]);
    Hull::new(vertices.collect(), sides.chain(ends).collect())
}

/// The convex polygon around points, anticlockwise (Andrew 1979).
fn around(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let mut polygon: Vec<[f64; 2]> = Vec::new();
    for _ in 0..2 {
        let start = polygon.len();
        for point in &sorted {
            while let [.., a, b] = polygon[start..]
                && (b[0] - a[0]) * (point[1] - a[1]) <= (b[1] - a[1]) * (point[0] - a[0])
            {
                polygon.pop();
            }
            polygon.push(*point);
        }
        // It is the first one of the other half.
        polygon.pop();
        sorted.reverse();
    }
    polygon
}
