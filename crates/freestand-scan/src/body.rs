//! What a mesh weighs, where its centre of gravity is, and its hull.

use freestand::hull::{Hull, HullBody, HullError};
use freestand_input::problem::Problem;
use freestand_input::words::number;
use parry3d_f64::mass_properties::MassProperties;
use parry3d_f64::math::Vector;
use parry3d_f64::transformation::try_convex_hull;

use crate::mesh::Mesh;

/// Sizes that an object may have \[m\]: a figurine, and a column.
const SIZES_M: std::ops::RangeInclusive<f64> = 0.02..=30.0;

/// What is done with a mesh that encloses no volume.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Leaking {
    /// It is refused.
    #[default]
    Refuse,
    /// Its hull takes its place.
    UseHull,
}

/// What is known of the side on which a scanned object stands, which the scanner rarely saw.
#[derive(Debug, Clone, PartialEq)]
pub enum Underside {
    /// It was scanned.
    Measured,
    /// It is flat: what is this near to the lowest point \[m\] is on the floor.
    Flat(f64),
    /// It stands on these points \[m\], x and y in the axes of the scan; they take the place of what is this
    /// near to the lowest point \[m\].
    Feet(Vec<[f64; 2]>, f64),
}

/// A uniform body.
#[derive(Debug, Clone, PartialEq)]
pub struct Solid {
    /// The body, about its centre of gravity.
    pub body: HullBody,
    /// Its volume \[m³\].
    pub volume_m3: f64,
    /// Its centre of gravity in the axes in which it was given \[m\].
    pub cg_m: [f64; 3],
    /// Whether its hull was used in place of its mesh, because that encloses no volume.
    pub is_hull: bool,
}

impl Solid {
    /// The same with its centre of gravity so high above its lowest point \[m\]; its moments of inertia remain those of
    /// the uniform body.
    ///
    /// # Errors
    /// A centre of gravity outside of its hull.
    pub fn with_cg_height(self, height_m: f64) -> Result<Self, HullError> {
        let hull = &self.body.hull;
        let depth_m = hull.height_m(&[0.0, 0.0, -1.0]);
        let up_m = height_m - depth_m;
        let lowered = hull.vertices_m().iter().map(|[x, y, z]| [*x, *y, z - up_m]);
        let hull = Hull::new(lowered.collect(), hull.faces().to_vec())?;
        let [x, y, z] = self.cg_m;
        Ok(Self {
            body: HullBody { hull, ..self.body },
            cg_m: [x, y, z + up_m],
            ..self
        })
    }
}

/// The uniform body of this mass whose surface is a mesh; `unit_m` is the length of one unit of its file.
///
/// # Errors
/// A mesh that encloses no volume, unless its hull may be used; sizes that no object has; a mesh without a
/// hull, such as a plane.
pub fn scanned_body(
    mesh: &Mesh,
    unit_m: f64,
    mass_kg: f64,
    leaking: Leaking,
    underside: &Underside,
) -> Result<Solid, Problem> {
    let [low, high] = mesh.extent();
    let size_m = [0, 1, 2]
        .map(|axis| unit_m * (high[axis] - low[axis]))
        .into_iter()
        .fold(0.0, f64::max);
    if !SIZES_M.contains(&size_m) {
        let message = format!(
            "the scan is {} m across, which no object is",
            number(size_m, 3)
        );
        let hint = "correct the unit of the scan: m, cm, mm, in or ft";
        return Err(Problem::value(message, hint));
    }
    let points: Vec<Vector> = mesh
        .vertices
        .iter()
        .map(|vertex| Vector::from_array(vertex.map(|x| unit_m * x)))
        .collect();
    let (hull, hull_faces) = try_convex_hull(&points).map_err(|error| {
        let message = format!("the scan has no convex hull: {error}");
        Problem::value(message, "scan the whole surface of the object")
    })?;
    let parts = mesh.parts();
    if parts > 1 && leaking == Leaking::Refuse {
        let message = format!("the scan has {parts} separate parts");
        let hint = "keep the object alone, or use the hull of the scan with `scan_hull`";
        return Err(Problem::value(message, hint));
    }
    let is_tight = mesh.is_watertight() && parts == 1;
    if !is_tight && leaking == Leaking::Refuse {
        let hint = "repair the mesh, or use the hull of the scan with `scan_hull`";
        return Err(Problem::value(
            "the surface of the scan does not close: it has holes, or triangles that are there twice or turned over",
            hint,
        ));
    }
    let of_hull = MassProperties::from_trimesh(1.0, &hull, &hull_faces);
    let of = if is_tight {
        MassProperties::from_trimesh(1.0, &points, &mesh.faces)
    } else {
        of_hull
    };
    // More than its hull is counted twice; next to nothing is a sheet with two sides.
    let filled = of.mass() / of_hull.mass();
    if !(1e-3..=1.0 + 1e-6).contains(&filled) {
        let message = "the surface of the scan encloses next to nothing, or more than its hull: it is a sheet, or passes through itself";
        let hint = "repair the mesh: its surface must enclose the object once";
        return Err(Problem::value(message, hint));
    }
    let volume_m3 = of.mass();
    let density = mass_kg / volume_m3;
    let moments = of.reconstruct_inertia_matrix().to_cols_array_2d();
    let cg_m = of.local_com.to_array();
    let inertia_kg_m2 = moments.map(|row| row.map(|x| density * x));
    let stood = match underside {
        Underside::Measured => None,
        Underside::Flat(within_m) => Some(flattened(&hull, *within_m)),
        Underside::Feet(feet_m, within_m) => Some(on_feet(&hull, feet_m, *within_m)),
    };
    let hull = match stood {
        None => Ok((hull, hull_faces)),
        Some(points) => try_convex_hull(&points),
    };
    let unfit = |error: &dyn std::fmt::Display| {
        let hint = "check the scan and the mass; a thin object needs a smaller `scan_error`, and feet are in the axes of the scan";
        Problem::value(error.to_string(), hint)
    };
    let (hull, faces) = hull.map_err(|error| unfit(&error))?;
    let hull = about(cg_m, &hull, &faces);
    let body = hull.and_then(|hull| HullBody::new(mass_kg, inertia_kg_m2, hull));
    Ok(Solid {
        body: body.map_err(|error| unfit(&error))?,
        volume_m3,
        cg_m,
        is_hull: !is_tight,
    })
}

/// A hull about a centre of gravity.
pub(crate) fn about(
    cg_m: [f64; 3],
    points: &[Vector],
    faces: &[[u32; 3]],
) -> Result<Hull, HullError> {
    let cg = Vector::from_array(cg_m);
    let vertices = points.iter().map(|point| (*point - cg).to_array());
    let faces = faces.iter().map(|face| face.map(|one| one as usize));
    Hull::new(vertices.collect(), faces.collect())
}

fn lowest_m(points: &[Vector]) -> f64 {
    points
        .iter()
        .map(|point| point.z)
        .fold(f64::INFINITY, f64::min)
}

/// Points of which those near to the lowest are as low as it.
fn flattened(points: &[Vector], within_m: f64) -> Vec<Vector> {
    let low_m = lowest_m(points);
    let is_low = |z: f64| z <= low_m + within_m;
    let z_of = |z: f64| if is_low(z) { low_m } else { z };
    points
        .iter()
        .map(|point| Vector::new(point.x, point.y, z_of(point.z)))
        .collect()
}

/// Points with feet in place of those near to the lowest.
fn on_feet(points: &[Vector], feet_m: &[[f64; 2]], within_m: f64) -> Vec<Vector> {
    let low_m = lowest_m(points);
    let rest = points.iter().filter(|point| point.z > low_m + within_m);
    let feet = feet_m.iter().map(|[x, y]| Vector::new(*x, *y, low_m));
    rest.copied().chain(feet).collect()
}
