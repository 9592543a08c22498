//! A mesh of triangles, as a file has it.

use foldhash::HashMap;
use foldhash::fast::RandomState;

use freestand_input::problem::Problem;

/// Triangles with outward normals by the order of their vertices, z upward, in the unit of the file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Mesh {
    /// Its vertices; no two are equal.
    pub vertices: Vec<[f64; 3]>,
    /// Its triangles; none has the same vertex twice.
    pub faces: Vec<[u32; 3]>,
}

/// A vertex of a sum: `-0` is `0`.
fn bits(vertex: &[f64; 3]) -> [u64; 3] {
    vertex.map(|x| (x + 0.0).to_bits())
}

impl Mesh {
    /// A mesh of triangles, each with the numbers of its vertices.
    ///
    /// # Errors
    /// A triangle without its vertex, coordinates that are no numbers, fewer than four triangles.
    pub fn of_triangles(vertices: &[[f64; 3]], faces: &[[usize; 3]]) -> Result<Self, Problem> {
        let is_there = |one: &usize| *one < vertices.len();
        if let Some(face) = faces.iter().find(|face| !face.iter().all(is_there)) {
            let message = format!(
                "the mesh has {} vertices, and a triangle has number {:?}",
                vertices.len(),
                face
            );
            return Err(Problem::format(message, "export the scan again"));
        }
        Self::merged(vertices, faces.iter().copied()).checked()
    }

    /// The mesh, if it may be that of an object.
    pub(crate) fn checked(self) -> Result<Self, Problem> {
        if !self.vertices.iter().flatten().all(|x| x.is_finite()) {
            let hint = "export the scan again";
            return Err(Problem::format(
                "a vertex of the mesh is not a number",
                hint,
            ));
        }
        if self.faces.len() < 4 {
            let message = format!(
                "the mesh has {} triangles, which enclose nothing",
                self.faces.len()
            );
            let hint = "export the surface of the scan as triangles, not as points";
            return Err(Problem::format(message, hint));
        }
        Ok(self)
    }

    /// A mesh from triangles whose vertices may be equal: those become one. A triangle of one or two points is left out.
    pub(crate) fn merged(vertices: &[[f64; 3]], faces: impl Iterator<Item = [usize; 3]>) -> Self {
        Self::of_corners(
            faces.map(|face| face.map(|one| vertices[one])),
            vertices.len(),
        )
    }

    /// The same of triangles by their corners, about so many of which differ.
    pub(crate) fn of_corners(corners: impl Iterator<Item = [[f64; 3]; 3]>, differ: usize) -> Self {
        let mut mesh = Self::default();
        let mut known: HashMap<[u64; 3], u32> =
            HashMap::with_capacity_and_hasher(differ, RandomState::default());
        for triangle in corners {
            let corners = triangle.map(|vertex| {
                *known.entry(bits(&vertex)).or_insert_with(|| {
                    mesh.vertices.push(vertex);
                    (mesh.vertices.len() - 1) as u32
                })
            });
            let [a, b, c] = corners;
            if a != b && b != c && a != c {
                mesh.faces.push(corners);
            }
        }
        mesh
    }

    /// Whether the triangles enclose a volume: each of their sides belongs to two of them, in opposite directions.
    pub fn is_watertight(&self) -> bool {
        let sides = || {
            let of = |[a, b, c]: &[u32; 3]| [(*a, *b), (*b, *c), (*c, *a)];
            self.faces.iter().flat_map(of)
        };
        // Where the sides from each vertex lead, those of one vertex after those of the one before.
        let mut starts = vec![0usize; self.vertices.len() + 1];
        sides().for_each(|(from, _)| starts[from as usize + 1] += 1);
        for vertex in 1..starts.len() {
            starts[vertex] += starts[vertex - 1];
        }
        let mut next = starts.clone();
        let mut ends = vec![0u32; 3 * self.faces.len()];
        for (from, to) in sides() {
            ends[next[from as usize]] = to;
            next[from as usize] += 1;
        }
        for pair in starts.windows(2) {
            ends[pair[0]..pair[1]].sort_unstable();
        }
        let count = |from: u32, to: u32| {
            let of = &ends[starts[from as usize]..starts[from as usize + 1]];
            of.partition_point(|one| *one <= to) - of.partition_point(|one| *one < to)
        };
        !self.faces.is_empty() && sides().all(|(from, to)| count(from, to) == count(to, from))
    }

    /// How many separate parts it has, which share no vertex.
    pub fn parts(&self) -> usize {
        let mut first: Vec<u32> = (0..self.vertices.len() as u32).collect();
        fn root(first: &mut [u32], mut one: u32) -> u32 {
            while first[one as usize] != one {
                first[one as usize] = first[first[one as usize] as usize];
                one = first[one as usize];
            }
            one
        }
        for [a, b, c] in &self.faces {
            let a = root(&mut first, *a);
            for other in [b, c] {
                let other = root(&mut first, *other);
                first[other as usize] = a;
            }
        }
        (0..first.len() as u32)
            .filter(|one| first[*one as usize] == *one)
            .count()
    }

    /// The smallest and the largest coordinates.
    pub fn extent(&self) -> [[f64; 3]; 2] {
        let mut extent = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        for vertex in &self.vertices {
            for axis in 0..3 {
                extent[0][axis] = extent[0][axis].min(vertex[axis]);
                extent[1][axis] = extent[1][axis].max(vertex[axis]);
            }
        }
        extent
    }
}
