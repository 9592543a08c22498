//! The formats of meshes, recognised by their content.

use std::io::{BufReader, Cursor};
use std::path::Path;

use freestand_input::file::{InputFile, load};
use freestand_input::problem::Problem;
use ply_rs_bw::parser::Parser;
use ply_rs_bw::ply::{Property, PropertyAccess, PropertyAccessResult};

use crate::glb;
use crate::mesh::Mesh;

/// The bytes before the triangles of a binary STL, and those of each triangle.
const STL_HEAD: usize = 84;
const STL_TRIANGLE: usize = 50;

const HINT: &str = "give a scan as OBJ, STL, PLY or binary glTF (.glb)";

/// Reads a mesh from an OBJ, STL, PLY or binary glTF file.
///
/// # Errors
/// A file that cannot be read, or that is none of these; one without triangles, or with numbers that are
/// none.
pub fn read_mesh(path: &Path) -> Result<(InputFile, Mesh), Problem> {
    let bytes = load(path)?;
    let mesh = parse_mesh(&bytes).map_err(|problem| problem.in_file(path))?;
    Ok((InputFile::new(path, &bytes), mesh))
}

/// Reads a mesh from the content of such a file.
///
/// # Errors
/// As [`read_mesh`].
pub fn parse_mesh(bytes: &[u8]) -> Result<Mesh, Problem> {
    parse(bytes)?.checked()
}

/// Whether the content is that of a mesh, as far as its beginning and its words tell.
pub fn is_mesh(bytes: &[u8]) -> bool {
    bytes.starts_with(b"glTF") || is_ply(bytes) || is_stl(bytes) || is_obj(bytes)
}

fn is_ply(bytes: &[u8]) -> bool {
    bytes.starts_with(b"ply\n") || bytes.starts_with(b"ply\r")
}

fn parse(bytes: &[u8]) -> Result<Mesh, Problem> {
    if bytes.starts_with(b"glTF") || is_json(bytes) {
        glb::parse(bytes)
    } else if is_ply(bytes) {
        ply(bytes)
    } else if is_stl(bytes) {
        stl(bytes)
    } else if is_obj(bytes) {
        obj(bytes)
    } else {
        Err(Problem::format("this is no mesh that is known", HINT))
    }
}

fn is_json(bytes: &[u8]) -> bool {
    bytes.trim_ascii_start().starts_with(b"{")
}

/// A binary STL says how many triangles follow; a text begins with `solid` and has facets.
fn is_stl(bytes: &[u8]) -> bool {
    let head = bytes.get(..1000.min(bytes.len())).unwrap_or_default();
    let is_text = head.trim_ascii_start().starts_with(b"solid")
        && head.windows(5).any(|word| word == b"facet");
    stl_triangles(bytes).is_some() || is_text
}

/// The triangles of a binary STL: a normal, three corners and two more bytes.
fn stl_triangles(bytes: &[u8]) -> Option<&[[u8; STL_TRIANGLE]]> {
    let (head, rest) = bytes.split_at_checked(STL_HEAD)?;
    let count = u32::from_le_bytes(head.last_chunk::<4>().copied()?);
    let (triangles, left) = rest.as_chunks::<STL_TRIANGLE>();
    (triangles.len() == count as usize && left.is_empty()).then_some(triangles)
}

/// A text in which a line begins with `v `.
fn is_obj(bytes: &[u8]) -> bool {
    let mut lines = bytes.split(|byte| *byte == b'\n');
    lines.any(|line| {
        let line = line.trim_ascii_start();
        line.starts_with(b"v ") || line.starts_with(b"v\t")
    })
}

fn broken(format: &str, error: &dyn std::fmt::Display) -> Problem {
    Problem::format(
        format!("the {format} file cannot be read: {error}"),
        "export the scan again",
    )
}

/// Triangles by vertices that may not be there.
fn checked(
    format: &str,
    vertices: &[[f64; 3]],
    faces: impl Iterator<Item = [usize; 3]> + Clone,
) -> Result<Mesh, Problem> {
    let mut all = faces.clone();
    if all.any(|face| face.iter().any(|one| *one >= vertices.len())) {
        return Err(broken(
            format,
            &"a triangle names a vertex that is not there",
        ));
    }
    Ok(Mesh::merged(vertices, faces))
}

fn obj(bytes: &[u8]) -> Result<Mesh, Problem> {
    let options = tobj::LoadOptions {
        triangulate: true,
        ignore_points: true,
        ignore_lines: true,
        ..tobj::LoadOptions::default()
    };
    // Materials have no weight.
    let no_materials = |_: &std::path::Path| Ok(Default::default());
    let (models, _) = tobj::load_obj_buf(&mut Cursor::new(bytes), &options, no_materials)
        .map_err(|error| broken("OBJ", &error))?;
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    for model in models {
        let first = vertices.len();
        let positions = model.mesh.positions.as_chunks::<3>().0;
        vertices.extend_from_slice(positions);
        let triangles = model.mesh.indices.as_chunks::<3>().0;
        faces.extend(
            triangles
                .iter()
                .map(|face| face.map(|one| first + one as usize)),
        );
    }
    checked("OBJ", &vertices, faces.iter().copied())
}

fn stl(bytes: &[u8]) -> Result<Mesh, Problem> {
    if let Some(triangles) = stl_triangles(bytes) {
        let number = |bytes: &[u8; 4]| f64::from(f32::from_le_bytes(*bytes));
        let corners = triangles.iter().map(|triangle| {
            // Past the normal.
            let (numbers, _) = triangle[12..].as_chunks::<4>();
            [0, 1, 2].map(|corner| [0, 1, 2].map(|axis| number(&numbers[3 * corner + axis])))
        });
        return Ok(Mesh::of_corners(corners, triangles.len() / 2));
    }
    let mesh = stl_io::read_stl(&mut Cursor::new(bytes)).map_err(|error| broken("STL", &error))?;
    let vertices: Vec<[f64; 3]> = mesh
        .vertices
        .iter()
        .map(|vertex| [0, 1, 2].map(|axis| f64::from(vertex[axis])))
        .collect();
    let faces = mesh.faces.iter().map(|face| face.vertices);
    checked("STL", &vertices, faces)
}

/// A vertex of a PLY file.
struct PlyVertex([f64; 3]);

impl PropertyAccess for PlyVertex {
    fn new() -> Self {
        Self([f64::NAN; 3])
    }

    fn set_property(&mut self, key: &str, property: Property) -> PropertyAccessResult {
        let axis = match key {
            "x" => 0,
            "y" => 1,
            "z" => 2,
            _ => return PropertyAccessResult::Set,
        };
        self.0[axis] = match property {
            Property::Float(x) => f64::from(x),
            Property::Double(x) => x,
            Property::Int(x) => f64::from(x),
            Property::Short(x) => f64::from(x),
            _ => f64::NAN,
        };
        PropertyAccessResult::Set
    }
}

/// A face of a PLY file: the places of its vertices.
struct PlyFace(Vec<usize>);

impl PropertyAccess for PlyFace {
    fn new() -> Self {
        Self(Vec::new())
    }

    fn set_property(&mut self, key: &str, property: Property) -> PropertyAccessResult {
        if !matches!(key, "vertex_index" | "vertex_indices") {
            return PropertyAccessResult::Set;
        }
        // A place that is below 0 is none.
        let place = |one: i64| usize::try_from(one).unwrap_or(usize::MAX);
        self.0 = match property {
            Property::ListInt(all) => all.into_iter().map(|one| place(one.into())).collect(),
            Property::ListUInt(all) => all.into_iter().map(|one| place(one.into())).collect(),
            Property::ListUShort(all) => all.into_iter().map(|one| place(one.into())).collect(),
            Property::ListShort(all) => all.into_iter().map(|one| place(one.into())).collect(),
            Property::ListUChar(all) => all.into_iter().map(|one| place(one.into())).collect(),
            _ => Vec::new(),
        };
        PropertyAccessResult::Set
    }
}

/// What else stands in a PLY file.
struct PlyOther;

impl PropertyAccess for PlyOther {
    fn new() -> Self {
        Self
    }

    fn set_property(&mut self, _: &str, _: Property) -> PropertyAccessResult {
        PropertyAccessResult::Set
    }
}

fn ply(bytes: &[u8]) -> Result<Mesh, Problem> {
    let failed = |error| broken("PLY", &error);
    let mut reader = ply_rs_bw::parser::Reader::new(BufReader::new(Cursor::new(bytes)));
    let vertex_parser = Parser::<PlyVertex>::new();
    let (face_parser, other_parser) = (Parser::<PlyFace>::new(), Parser::<PlyOther>::new());
    let header = vertex_parser.read_header(&mut reader).map_err(failed)?;
    let (mut vertices, mut polygons) = (Vec::new(), Vec::new());
    for (name, element) in &header.elements {
        match name.as_str() {
            "vertex" => {
                let read = vertex_parser.read_payload_for_element(&mut reader, element, &header);
                vertices = read.map_err(failed)?;
            }
            "face" => {
                let read = face_parser.read_payload_for_element(&mut reader, element, &header);
                polygons = read.map_err(failed)?;
            }
            _ => {
                let read = other_parser.read_payload_for_element(&mut reader, element, &header);
                read.map_err(failed)?;
            }
        }
    }
    let vertices: Vec<[f64; 3]> = vertices.into_iter().map(|vertex| vertex.0).collect();
    // A polygon is a fan about its first vertex.
    let faces = polygons.iter().flat_map(|polygon| {
        let rest = polygon.0.get(1..).unwrap_or_default();
        rest.windows(2).map(|pair| [polygon.0[0], pair[0], pair[1]])
    });
    checked("PLY", &vertices, faces)
}
