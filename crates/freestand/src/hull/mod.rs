//! Bodies of any shape on the points of their hull, in three dimensions, on a stiff floor.
//!
//! What decides whether such a body falls is the true shape of its base. A base that is slightly
//! curved rolls where a flat polygon strikes and loses energy, and the hill that its centre of gravity
//! must climb is lower.
//!
//! * [`poses`]: the poses in which a body can stand;
//! * [`barrier`]: the hill that its centre of gravity must climb before it falls;
//! * [`contact`]: the few points of its hull with which it touches the floor;
//! * [`standing`]: the body in one of its poses;
//! * [`shake`]: the body under a motion of the floor;
//! * [`wall`]: walls beside it;
//! * [`shapes`]: prisms and cylinders, on their outline or on feet.
//!
//! Vectors are in the axes in which the body was given, from its centre of gravity, z upward.

pub mod barrier;
pub mod contact;
mod lanes;
pub mod poses;
mod rolling;
pub mod shake;
pub mod shapes;
pub mod standing;
pub mod wall;

use thiserror::Error;

use crate::space::{cross, difference, dot};

/// A vector.
pub type Vector = [f64; 3];

/// The convex hull of a body, about its centre of gravity.
#[derive(Debug, Clone, PartialEq)]
pub struct Hull {
    vertices_m: Vec<Vector>,
    faces: Vec<[usize; 3]>,
}

/// Why a body cannot be calculated.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum HullError {
    /// A hull has fewer than four vertices or faces.
    #[error("the hull has {vertices} vertices and {faces} faces, and needs at least four of each")]
    Few {
        /// Its vertices.
        vertices: usize,
        /// Its faces.
        faces: usize,
    },
    /// A face names a vertex that is not there, or a vertex is not a number.
    #[error("the hull has a face or a vertex that is not valid")]
    Invalid,
    /// The centre of gravity is not inside.
    #[error("the centre of gravity is not inside the hull")]
    Outside,
    /// The mass is not above 0, or the moments of inertia are not those of a body.
    #[error("the mass or the moments of inertia are not those of a body")]
    Mass,
    /// How it touches the floor is not valid.
    #[error(
        "friction and rolling friction must be at least 0, damping and sinking of the contacts above 0"
    )]
    Contact,
    /// A wall is not valid.
    #[error("the gap and the damping of a wall must be at least 0, its stiffness above 0")]
    Wall,
    /// The components of the motion differ.
    #[error("the components of the motion must have the same step and length")]
    Motion,
    /// It cannot stand as it was given.
    #[error("the body cannot stand: its nearest stable pose is {tilt_deg:.0} degrees away")]
    NoPose {
        /// The tilt of the nearest stable pose \[°\].
        tilt_deg: f64,
    },
}

impl Hull {
    /// A hull of triangles, about the centre of gravity of the body.
    ///
    /// # Errors
    /// Too few vertices or faces, a face without its vertex, a centre of gravity outside.
    pub fn new(vertices_m: Vec<Vector>, faces: Vec<[usize; 3]>) -> Result<Self, HullError> {
        if vertices_m.len() < 4 || faces.len() < 4 {
            return Err(HullError::Few {
                vertices: vertices_m.len(),
                faces: faces.len(),
            });
        }
        let is_number = |vertex: &Vector| vertex.iter().all(|x| x.is_finite());
        let is_vertex = |face: &[usize; 3]| face.iter().all(|one| *one < vertices_m.len());
        if !vertices_m.iter().all(is_number) || !faces.iter().all(is_vertex) {
            return Err(HullError::Invalid);
        }
        let hull = Self { vertices_m, faces };
        let size_m2 = hull
            .vertices_m
            .iter()
            .map(|vertex| dot(vertex, vertex))
            .fold(0.0, f64::max);
        if hull
            .planes(1e-9 * size_m2)
            .any(|distance_m| distance_m <= 0.0)
        {
            return Err(HullError::Outside);
        }
        Ok(hull)
    }

    /// Its vertices \[m\].
    pub fn vertices_m(&self) -> &[Vector] {
        &self.vertices_m
    }

    /// Its triangles, by their vertices.
    pub fn faces(&self) -> &[[usize; 3]] {
        &self.faces
    }

    /// The corners of a face.
    fn corners(&self, face: &[usize; 3]) -> [Vector; 3] {
        face.map(|one| self.vertices_m[one])
    }

    /// The distance of every face from the centre of gravity; a sliver of a face has no direction, and says
    /// nothing.
    fn planes(&self, least_area_m2: f64) -> impl Iterator<Item = f64> {
        self.faces.iter().filter_map(move |face| {
            let corners = self.corners(face);
            let normal = normal_of(&corners);
            let is_sliver = dot(&normal, &normal).sqrt() <= least_area_m2;
            Some(dot(&unit(&normal)?, &corners[0])).filter(|_| !is_sliver)
        })
    }

    /// Height of the centre of gravity above a floor that is down in this direction of the body \[m\].
    pub fn height_m(&self, down: &Vector) -> f64 {
        height_m(&self.vertices_m, down)
    }

    /// Of each vertex, those to which an edge leads.
    fn sides(&self) -> Vec<Vec<usize>> {
        let mut sides = vec![Vec::new(); self.vertices_m.len()];
        for [a, b, c] in &self.faces {
            for (from, to) in [(*a, *b), (*b, *c), (*c, *a)] {
                sides[from].push(to);
            }
        }
        sides
    }

    /// The height of the centre of gravity, and the vertex on which it stands.
    fn lowest(&self, down: &Vector) -> (f64, usize) {
        let heights = self.vertices_m.iter().map(|vertex| dot(vertex, down));
        let both = heights.zip(0..);
        both.reduce(|most, one| if one.0 > most.0 { one } else { most })
            .unwrap_or((f64::NEG_INFINITY, 0))
    }

    /// As [`Hull::lowest`], from a vertex near to it along edges that lead down: on a convex body they end at the
    /// lowest vertex.
    fn lowest_from(&self, near: usize, sides: &[Vec<usize>], down: &Vector) -> (f64, usize) {
        let height_of = |vertex: usize| dot(&self.vertices_m[vertex], down);
        let (mut height_m, mut vertex) = (height_of(near), near);
        loop {
            let lower = sides[vertex].iter().map(|one| (height_of(*one), *one));
            let next = lower.reduce(|most, one| if one.0 > most.0 { one } else { most });
            match next {
                Some(next) if next.0 > height_m => (height_m, vertex) = next,
                _ => return (height_m, vertex),
            }
        }
    }
}

/// Height of the centre of gravity on these points \[m\].
pub(crate) fn height_m(points_m: &[Vector], down: &Vector) -> f64 {
    points_m
        .iter()
        .map(|point| dot(point, down))
        .fold(f64::NEG_INFINITY, f64::max)
}

fn normal_of([a, b, c]: &[Vector; 3]) -> Vector {
    cross(&difference(b, a), &difference(c, a))
}

fn unit(vector: &Vector) -> Option<Vector> {
    let size = dot(vector, vector).sqrt();
    (size > 0.0).then(|| vector.map(|x| x / size))
}

/// Tilt and direction of a body in which this direction is down \[rad\].
pub fn tilt_of(down: &Vector) -> (f64, f64) {
    let tilt_rad = down[0].hypot(down[1]).atan2(-down[2]);
    (tilt_rad, down[1].atan2(down[0]))
}

/// A rigid body.
#[derive(Debug, Clone, PartialEq)]
pub struct HullBody {
    /// Its mass \[kg\].
    pub mass_kg: f64,
    /// Its moments of inertia about the centre of gravity \[kg m²\].
    pub inertia_kg_m2: [Vector; 3],
    /// Its hull.
    pub hull: Hull,
}

impl HullBody {
    /// A body with this mass, these moments of inertia and this hull.
    ///
    /// # Errors
    /// A mass that is not above 0, or moments of inertia of no body: each must be above 0 and at most the
    /// sum of the two others.
    pub fn new(mass_kg: f64, inertia_kg_m2: [Vector; 3], hull: Hull) -> Result<Self, HullError> {
        let [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]] = inertia_kg_m2;
        let moments = [xx, yy, zz];
        let sum: f64 = moments.iter().sum();
        let determinant = dot(
            &inertia_kg_m2[0],
            &cross(&inertia_kg_m2[1], &inertia_kg_m2[2]),
        );
        let is_symmetric = [(xy, yx), (xz, zx), (yz, zy)]
            .iter()
            .all(|(a, b)| (a - b).abs() <= 1e-9 * sum);
        let has_minors = xx * yy > xy * xy && yy * zz > yz * yz && xx * zz > xz * xz;
        // A rounding error of a thin plate is allowed.
        let is_moment = |one: &f64| *one > 0.0 && *one <= 0.5 * sum * (1.0 + 1e-9);
        let is_body =
            mass_kg > 0.0 && mass_kg.is_finite() && is_symmetric && has_minors && determinant > 0.0;
        if !is_body || !moments.iter().all(is_moment) {
            return Err(HullError::Mass);
        }
        Ok(Self {
            mass_kg,
            inertia_kg_m2,
            hull,
        })
    }
}

#[cfg(test)]
mod tests;
