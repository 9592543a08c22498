//! Binary glTF 2.0: the triangles of its default scene, z upward.
//!
//! Read here and not by a library: a library that trusts the numbers of a file panics where it lies.

use std::collections::{HashMap, HashSet};

use freestand_input::problem::Problem;
use serde::Deserialize;

use crate::mesh::Mesh;

/// `JSON` and `BIN`.
const JSON: u32 = 0x4e4f_534a;
const BINARY: u32 = 0x004e_4942;

/// Types of components, and of what a primitive draws.
const BYTE: u32 = 5121;
const SHORT: u32 = 5123;
const INT: u32 = 5125;
const FLOAT: u32 = 5126;
const POINTS_AND_LINES: std::ops::RangeInclusive<u32> = 0..=3;
const TRIANGLES: u32 = 4;

#[derive(Deserialize, Default)]
#[serde(rename_all = "camelCase", default)]
struct Document {
    scene: Option<usize>,
    scenes: Vec<Scene>,
    nodes: Vec<Node>,
    meshes: Vec<Primitives>,
    accessors: Vec<Accessor>,
    buffer_views: Vec<View>,
    buffers: Vec<Buffer>,
    extensions_required: Vec<String>,
}

#[derive(Deserialize, Default)]
#[serde(default)]
struct Scene {
    nodes: Vec<usize>,
}

#[derive(Deserialize, Default)]
#[serde(default)]
struct Node {
    mesh: Option<usize>,
    children: Vec<usize>,
    matrix: Option<[f64; 16]>,
    translation: [f64; 3],
    rotation: Option<[f64; 4]>,
    scale: Option<[f64; 3]>,
}

#[derive(Deserialize)]
struct Primitives {
    primitives: Vec<Primitive>,
}

#[derive(Deserialize)]
struct Primitive {
    attributes: HashMap<String, usize>,
    indices: Option<usize>,
    mode: Option<u32>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Accessor {
    buffer_view: Option<usize>,
    #[serde(default)]
    byte_offset: usize,
    component_type: u32,
    count: usize,
    r#type: String,
    sparse: Option<serde_json::Value>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct View {
    buffer: usize,
    #[serde(default)]
    byte_offset: usize,
    byte_length: usize,
    byte_stride: Option<usize>,
}

#[derive(Deserialize)]
struct Buffer {
    uri: Option<String>,
}

fn broken(what: &str) -> Problem {
    let message = format!("the glTF file cannot be read: {what}");
    Problem::format(message, "export the scan again, as one binary file (.glb)")
}

/// The chunk of a kind.
fn chunk(bytes: &[u8], kind: u32) -> Option<&[u8]> {
    let mut rest = bytes.get(12..)?;
    loop {
        let length = u32_at(rest, 0)? as usize;
        let data = rest.get(8..8_usize.checked_add(length)?)?;
        if u32_at(rest, 4)? == kind {
            return Some(data);
        }
        rest = rest.get(8 + length..)?;
    }
}

fn u32_at(bytes: &[u8], at: usize) -> Option<u32> {
    let bytes = bytes.get(at..at.checked_add(4)?)?;
    Some(u32::from_le_bytes(bytes.try_into().ok()?))
}

pub(crate) fn parse(bytes: &[u8]) -> Result<Mesh, Problem> {
    let binary = bytes.starts_with(b"glTF");
    let json = if binary {
        chunk(bytes, JSON).ok_or_else(|| broken("it has no description"))?
    } else {
        bytes
    };
    let document: Document =
        serde_json::from_slice(json).map_err(|error| broken(&error.to_string()))?;
    if let Some(extension) = document.extensions_required.first() {
        let hint = "export it without compression";
        let message = format!("the glTF file needs {extension}, which is not read");
        return Err(Problem::format(message, hint));
    }
    if !binary || document.buffers.iter().any(|one| one.uri.is_some()) {
        let message = "the glTF file has its vertices in another file";
        return Err(Problem::format(
            message,
            "export it as one binary file (.glb)",
        ));
    }
    let data = chunk(bytes, BINARY).ok_or_else(|| broken("it has no data"))?;
    let mut reading = Reading {
        document: &document,
        data,
        vertices: Vec::new(),
        faces: Vec::new(),
    };
    reading.scene()?;
    Ok(Mesh::merged(
        &reading.vertices,
        reading.faces.iter().copied(),
    ))
}

/// Four columns.
type Transform = [[f64; 4]; 4];

struct Reading<'d> {
    document: &'d Document,
    data: &'d [u8],
    vertices: Vec<[f64; 3]>,
    faces: Vec<[usize; 3]>,
}

impl Reading<'_> {
    fn scene(&mut self) -> Result<(), Problem> {
        let scenes = &self.document.scenes;
        let scene = scenes.get(self.document.scene.unwrap_or(0));
        let roots = &scene.ok_or_else(|| broken("it has no scene"))?.nodes;
        let mut open: Vec<(usize, Transform)> = roots.iter().map(|one| (*one, UNMOVED)).collect();
        let mut seen = HashSet::new();
        while let Some((index, parent)) = open.pop() {
            if !seen.insert(index) {
                return Err(broken("its nodes are no tree"));
            }
            let nodes = &self.document.nodes;
            let node = nodes
                .get(index)
                .ok_or_else(|| broken("a node is missing"))?;
            let at = product(&parent, &own(node));
            if let Some(mesh) = node.mesh {
                let mesh = self.document.meshes.get(mesh);
                let mesh = mesh.ok_or_else(|| broken("a mesh is missing"))?;
                for primitive in &mesh.primitives {
                    self.primitive(primitive, &at)?;
                }
            }
            open.extend(node.children.iter().map(|child| (*child, at)));
        }
        Ok(())
    }

    fn primitive(&mut self, primitive: &Primitive, at: &Transform) -> Result<(), Problem> {
        match primitive.mode.unwrap_or(TRIANGLES) {
            TRIANGLES => {}
            // They have no surface.
            mode if POINTS_AND_LINES.contains(&mode) => return Ok(()),
            _ => {
                let message = "the glTF file has strips or fans of triangles";
                return Err(Problem::format(message, "export separate triangles"));
            }
        }
        let positions = primitive.attributes.get("POSITION").copied();
        let positions = positions.ok_or_else(|| broken("a mesh has no vertices"))?;
        let first = self.vertices.len();
        let places: Vec<[f64; 3]> = self
            .values(positions, "VEC3", &[FLOAT])?
            .map(|(bytes, _)| {
                [0, 1, 2]
                    .map(|axis| f64::from(f32::from_bits(u32_at(bytes, 4 * axis).unwrap_or(0))))
            })
            .collect();
        // Its y is upward.
        self.vertices.extend(places.iter().map(|place| {
            let [x, y, z] = moved(at, place);
            [x, -z, y]
        }));
        let places: Vec<usize> = match primitive.indices {
            None => (0..places.len()).collect(),
            Some(indices) => self
                .values(indices, "SCALAR", &[BYTE, SHORT, INT])?
                .map(|(bytes, size)| {
                    let digits = bytes.iter().take(size).rev();
                    digits.fold(0, |sum, byte| sum << 8 | usize::from(*byte))
                })
                .collect(),
        };
        let count = self.vertices.len() - first;
        if places.iter().any(|place| *place >= count) {
            return Err(broken("a triangle names a vertex that is not there"));
        }
        // A mirrored part is inside out.
        let is_mirrored = determinant(at) < 0.0;
        let triangles = places.as_chunks::<3>().0.iter().map(|face| {
            let [a, b, c] = face.map(|place| first + place);
            if is_mirrored { [a, c, b] } else { [a, b, c] }
        });
        self.faces.extend(triangles);
        Ok(())
    }

    /// The bytes of each value of an accessor, with the size of a component.
    fn values(
        &self,
        accessor: usize,
        kind: &str,
        components: &[u32],
    ) -> Result<impl Iterator<Item = (&[u8], usize)>, Problem> {
        let wrong = || broken("its data are not where it says");
        let accessor = self.document.accessors.get(accessor).ok_or_else(wrong)?;
        let is_known = accessor.r#type == kind && components.contains(&accessor.component_type);
        if !is_known || accessor.sparse.is_some() {
            return Err(broken("its data are of a kind that is not read"));
        }
        let component = match accessor.component_type {
            BYTE => 1,
            SHORT => 2,
            _ => 4,
        };
        let size = if kind == "VEC3" {
            3 * component
        } else {
            component
        };
        let view = accessor
            .buffer_view
            .and_then(|view| self.document.buffer_views.get(view));
        let view = view.filter(|view| view.buffer == 0).ok_or_else(wrong)?;
        let end = view.byte_offset.checked_add(view.byte_length);
        let end = end.ok_or_else(wrong)?;
        let bytes = self.data.get(view.byte_offset..end).ok_or_else(wrong)?;
        let bytes = bytes.get(accessor.byte_offset..).ok_or_else(wrong)?;
        let stride = view.byte_stride.unwrap_or(size);
        let last = accessor
            .count
            .checked_sub(1)
            .and_then(|steps| steps.checked_mul(stride));
        let needed = last
            .and_then(|last| last.checked_add(size))
            .ok_or_else(wrong)?;
        if stride < size || needed > bytes.len() {
            return Err(wrong());
        }
        Ok((0..accessor.count).map(move |at| (&bytes[at * stride..at * stride + size], component)))
    }
}

const UNMOVED: Transform = [
    [1.0, 0.0, 0.0, 0.0],
    [0.0, 1.0, 0.0, 0.0],
    [0.0, 0.0, 1.0, 0.0],
    [0.0, 0.0, 0.0, 1.0],
];

/// The matrix of a node, or its translation, rotation and scale.
fn own(node: &Node) -> Transform {
    if let Some(matrix) = node.matrix {
        return [0, 1, 2, 3].map(|column| [0, 1, 2, 3].map(|row| matrix[4 * column + row]));
    }
    let [x, y, z, w] = node.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]);
    let [sx, sy, sz] = node.scale.unwrap_or([1.0; 3]);
    let [tx, ty, tz] = node.translation;
    [
        [
            sx * (1.0 - 2.0 * (y * y + z * z)),
            sx * 2.0 * (x * y + w * z),
            sx * 2.0 * (x * z - w * y),
            0.0,
        ],
        [
            sy * 2.0 * (x * y - w * z),
            sy * (1.0 - 2.0 * (x * x + z * z)),
            sy * 2.0 * (y * z + w * x),
            0.0,
        ],
        [
            sz * 2.0 * (x * z + w * y),
            sz * 2.0 * (y * z - w * x),
            sz * (1.0 - 2.0 * (x * x + y * y)),
            0.0,
        ],
        [tx, ty, tz, 1.0],
    ]
}

fn product(a: &Transform, b: &Transform) -> Transform {
    b.map(|column| [0, 1, 2, 3].map(|row| (0..4).map(|i| a[i][row] * column[i]).sum::<f64>()))
}

fn moved(at: &Transform, [x, y, z]: &[f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|row| at[0][row] * x + at[1][row] * y + at[2][row] * z + at[3][row])
}

fn determinant([a, b, c, _]: &Transform) -> f64 {
    a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
}
