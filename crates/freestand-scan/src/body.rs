//! What a mesh weighs, where its centre of gravity is, and its hull.

use freestand::hull::{Hull, HullBody};
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

/// A uniform body in the shape of a mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct ScannedBody {
    /// The body, about its centre of gravity.
    pub body: HullBody,
    /// Its volume \[m³\].
    pub volume_m3: f64,
    /// Its centre of gravity in the axes of the scan \[m\].
    pub cg_m: [f64; 3],
    /// Whether its hull was used in place of its mesh, because that encloses no volume.
    pub is_hull: bool,
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
) -> Result<ScannedBody, Problem> {
    let [low, high] = mesh.extent();
    let size_m = [0, 1, 2]
        .map(|axis| unit_m * (high[axis] - low[axis]))
        .into_iter()
        .fold(0.0, f64::max);
    if !SIZES_M.contains(&size_m) {
        let message = format!(
            "the scan is {} m large, which no object is",
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
        let hint = "keep the object alone, or let the hull of the scan take its place";
        return Err(Problem::value(message, hint));
    }
    let is_tight = mesh.is_watertight() && parts == 1;
    if !is_tight && leaking == Leaking::Refuse {
        let hint = "close its holes, or let the hull of the scan take its place";
        return Err(Problem::value(
            "the surface of the scan has holes, so that it encloses no volume",
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
        let message =
            "the surface of the scan passes through itself, or its triangles are there twice";
        let hint = "repair the mesh, or let the hull of the scan take its place";
        return Err(Problem::value(message, hint));
    }
    let volume_m3 = of.mass();
    let density = mass_kg / volume_m3;
    let moments = of.reconstruct_inertia_matrix().to_cols_array_2d();
    let cg = of.local_com;
    let vertices = hull.iter().map(|point| (*point - cg).to_array()).collect();
    let faces = hull_faces
        .iter()
        .map(|face| face.map(|one| one as usize))
        .collect();
    let unfit = |error: freestand::hull::HullError| {
        Problem::value(error.to_string(), "check the scan and the mass")
    };
    let body = Hull::new(vertices, faces)
        .and_then(|hull| HullBody::new(mass_kg, moments.map(|row| row.map(|x| density * x)), hull))
        .map_err(unfit)?;
    Ok(ScannedBody {
        body,
        volume_m3,
        cg_m: cg.to_array(),
        is_hull: !is_tight,
    })
}
