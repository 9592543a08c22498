//! One box in every format is one body; what is no scan is refused.

#![allow(clippy::unwrap_used, reason = "tests")]

use std::fmt::Write as _;

use freestand_scan::body::{Leaking, Underside, scanned_body};
use freestand_scan::formats::parse_mesh;
use freestand_scan::mesh::Mesh;

/// A box of 0.4 m × 0.6 m × 1 m that stands on z = 0, in millimetres.
const SIZES_MM: [f64; 3] = [400.0, 600.0, 1000.0];

const FACES: [[usize; 3]; 12] = [
    [0, 2, 1],
    [1, 2, 3],
    [4, 5, 6],
    [5, 7, 6],
    [0, 1, 4],
    [1, 5, 4],
    [2, 6, 3],
    [3, 6, 7],
    [0, 4, 2],
    [2, 4, 6],
    [1, 3, 5],
    [3, 7, 5],
];

fn corners() -> [[f64; 3]; 8] {
    [0, 1, 2, 3, 4, 5, 6, 7].map(|at: usize| {
        [0, 1, 2].map(|axis| {
            let is_far = at >> axis & 1 == 1;
            if is_far { SIZES_MM[axis] } else { 0.0 }
        })
    })
}

fn obj() -> Vec<u8> {
    let mut text = "# a box\nmtllib none.mtl\no box\n".to_owned();
    for [x, y, z] in corners() {
        let _ = writeln!(text, "v {x} {y} {z}");
    }
    for [a, b, c] in FACES {
        let _ = writeln!(text, "f {}//1 {}//1 {}//1", a + 1, b + 1, c + 1);
    }
    text.replace("o box\n", "o box\nvn 0 0 1\n").into_bytes()
}

fn stl_text() -> Vec<u8> {
    let mut text = "solid box\n".to_owned();
    for face in FACES {
        text.push_str("facet normal 0 0 0\nouter loop\n");
        for [x, y, z] in face.map(|one| corners()[one]) {
            let _ = writeln!(text, "vertex {x} {y} {z}");
        }
        text.push_str("endloop\nendfacet\n");
    }
    (text + "endsolid box\n").into_bytes()
}

fn stl_binary() -> Vec<u8> {
    // Some programs begin a binary file with the word of the text.
    let mut bytes = b"solid of a program".to_vec();
    bytes.resize(80, 0);
    bytes.extend(12_u32.to_le_bytes());
    for face in FACES {
        bytes.extend([0; 12]);
        for corner in face.map(|one| corners()[one]) {
            bytes.extend(corner.iter().flat_map(|x| (*x as f32).to_le_bytes()));
        }
        bytes.extend([0; 2]);
    }
    bytes
}

fn ply_text() -> Vec<u8> {
    let mut text = "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n\
                    property uchar red\nelement face 6\nproperty list uchar int vertex_indices\nend_header\n"
        .to_owned();
    for [x, y, z] in corners() {
        let _ = writeln!(text, "{x} {y} {z} 200");
    }
    // Its faces are quadrilaterals.
    for [a, b, c, d] in [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ] {
        let _ = writeln!(text, "4 {a} {b} {c} {d}");
    }
    text.into_bytes()
}

fn ply_binary() -> Vec<u8> {
    let mut bytes = b"ply\nformat binary_little_endian 1.0\nelement vertex 8\nproperty double x\nproperty double y\n\
                      property double z\nelement face 12\nproperty list uchar uint vertex_index\nend_header\n"
        .to_vec();
    for corner in corners() {
        bytes.extend(corner.iter().flat_map(|x| x.to_le_bytes()));
    }
    for face in FACES {
        bytes.push(3);
        bytes.extend(face.iter().flat_map(|one| (*one as u32).to_le_bytes()));
    }
    bytes
}

/// Binary glTF, whose y is upward; the box is scaled and moved by the node that has it.
fn glb() -> Vec<u8> {
    let mut data = Vec::new();
    for [x, y, z] in corners() {
        data.extend([x, z, -y].iter().flat_map(|x| (0.5 * x).to_bits_le()));
    }
    for face in FACES {
        data.extend(face.iter().flat_map(|one| (*one as u16).to_le_bytes()));
    }
    let json = format!(
        "{{\"asset\":{{\"version\":\"2.0\"}},\"scene\":0,\"scenes\":[{{\"nodes\":[0]}}],\
         \"nodes\":[{{\"children\":[1],\"scale\":[2,2,2]}},{{\"mesh\":0,\"translation\":[5,6,7]}}],\
         \"meshes\":[{{\"primitives\":[{{\"attributes\":{{\"POSITION\":0}},\"indices\":1}}]}}],\
         \"accessors\":[{{\"bufferView\":0,\"componentType\":5126,\"count\":8,\"type\":\"VEC3\",\
         \"min\":[0,0,-300],\"max\":[200,500,0]}},\
         {{\"bufferView\":1,\"componentType\":5123,\"count\":36,\"type\":\"SCALAR\"}}],\
         \"bufferViews\":[{{\"buffer\":0,\"byteOffset\":0,\"byteLength\":96}},\
         {{\"buffer\":0,\"byteOffset\":96,\"byteLength\":72}}],\"buffers\":[{{\"byteLength\":{}}}]}}",
        data.len()
    );
    let mut json = json.into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut bytes = b"glTF".to_vec();
    let total = 12 + 8 + json.len() + 8 + data.len();
    bytes.extend([2, total as u32].iter().flat_map(|x: &u32| x.to_le_bytes()));
    bytes.extend((json.len() as u32).to_le_bytes());
    bytes.extend(b"JSON");
    bytes.extend(json);
    bytes.extend((data.len() as u32).to_le_bytes());
    bytes.extend(b"BIN\0");
    bytes.extend(data);
    bytes
}

trait Bits {
    fn to_bits_le(self) -> [u8; 4];
}

impl Bits for f64 {
    fn to_bits_le(self) -> [u8; 4] {
        (self as f32).to_le_bytes()
    }
}

/// A uniform box: its volume, half of its sizes, (w² + h²)/12 of its mass.
#[test]
fn a_box_is_one_body_in_every_format() {
    for (format, bytes) in [
        ("OBJ", obj()),
        ("STL text", stl_text()),
        ("STL", stl_binary()),
        ("PLY text", ply_text()),
        ("PLY", ply_binary()),
        ("glTF", glb()),
    ] {
        let mesh = parse_mesh(&bytes).unwrap();
        assert_eq!((mesh.vertices.len(), mesh.faces.len()), (8, 12), "{format}");
        assert!(mesh.is_watertight(), "{format}");
        let found = scanned_body(&mesh, 1e-3, 50.0, Leaking::Refuse, &Underside::Measured).unwrap();
        // The numbers of the files are exact in single precision: what is left are rounding errors.
        assert!(
            (found.volume_m3 - 0.24).abs() < 1e-12,
            "{format}: {found:?}"
        );
        let offset = if format == "glTF" {
            [0.01, -0.014, 0.012]
        } else {
            [0.0; 3]
        };
        for axis in 0..3 {
            let middle = 0.5e-3 * SIZES_MM[axis] + offset[axis];
            assert!(
                (found.cg_m[axis] - middle).abs() < 1e-12,
                "{format}: {:?}",
                found.cg_m
            );
            let others: f64 = (0..3)
                .filter(|other| *other != axis)
                .map(|other| (1e-3 * SIZES_MM[other]).powi(2))
                .sum();
            let moment = found.body.inertia_kg_m2[axis][axis];
            assert!(
                (moment - 50.0 * others / 12.0).abs() < 1e-12,
                "{format}: {moment}"
            );
        }
        assert_eq!(found.body.hull.vertices_m().len(), 8, "{format}");
        assert_eq!(found.body.hull.stable_poses().len(), 6, "{format}");
        assert!(!found.is_hull);
    }
}

/// With a hole it encloses no volume; its hull does.
#[test]
fn a_mesh_with_a_hole_is_refused_or_its_hull_is_used() {
    let whole = parse_mesh(&ply_binary()).unwrap();
    let mut open = whole.clone();
    open.faces.pop();
    assert!(!open.is_watertight());
    let refused =
        scanned_body(&open, 1e-3, 50.0, Leaking::Refuse, &Underside::Measured).unwrap_err();
    assert!(refused.to_string().contains("has holes"), "{refused}");
    let found = scanned_body(&open, 1e-3, 50.0, Leaking::UseHull, &Underside::Measured).unwrap();
    assert!(found.is_hull && (found.volume_m3 - 0.24).abs() < 1e-12);
    // Turned inside out it encloses the same.
    let inside_out = Mesh {
        faces: whole.faces.iter().map(|[a, b, c]| [*a, *c, *b]).collect(),
        ..whole
    };
    let found = scanned_body(
        &inside_out,
        1e-3,
        50.0,
        Leaking::Refuse,
        &Underside::Measured,
    )
    .unwrap();
    assert!((found.volume_m3 - 0.24).abs() < 1e-12);
}

#[test]
fn what_is_no_object_is_refused() {
    let mesh = parse_mesh(&obj()).unwrap();
    for unit_m in [1.0, 1e-6] {
        let refused =
            scanned_body(&mesh, unit_m, 50.0, Leaking::Refuse, &Underside::Measured).unwrap_err();
        assert!(
            refused.to_string().contains("which no object is"),
            "{refused}"
        );
    }
    let flat = Mesh {
        vertices: mesh
            .vertices
            .iter()
            .map(|[x, y, _]| [*x, *y, 0.0])
            .collect(),
        faces: mesh.faces,
    };
    assert!(scanned_body(&flat, 1e-3, 50.0, Leaking::UseHull, &Underside::Measured).is_err());
}

#[test]
fn what_is_no_mesh_is_refused() {
    let cases: [(&[u8], &str); 9] = [
        (b"", "no mesh that is known"),
        (b"time,acceleration\n0,1\n", "no mesh that is known"),
        (b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "enclose nothing"),
        (b"v 0 0 0\nf 1 2 3\n", "OBJ file cannot be read"),
        (b"v a b c\n", "OBJ file cannot be read"),
        (
            b"ply\nformat ascii 1.0\nelement vertex 9999999999\nend_header\n",
            "PLY file cannot be read",
        ),
        (
            b"solid x\nfacet normal 0 0 0\nouter loop\nvertex 1 2\n",
            "STL file cannot be read",
        ),
        (b"glTF\x02\0\0\0", "it has no description"),
        (
            b"{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"uri\":\"a.bin\",\"byteLength\":4}]}",
            "another file",
        ),
    ];
    for (bytes, expected) in cases {
        let problem = parse_mesh(bytes).unwrap_err().to_string();
        assert!(
            problem.contains(expected),
            "{problem} {:?}",
            String::from_utf8_lossy(bytes)
        );
    }
    // Cut off anywhere, every format is refused or read, and never panics.
    for bytes in [
        obj(),
        stl_text(),
        stl_binary(),
        ply_text(),
        ply_binary(),
        glb(),
    ] {
        for end in (0..bytes.len()).step_by(7) {
            let _ = parse_mesh(&bytes[..end]);
        }
    }
}

/// A file whose numbers lie is refused.
#[test]
fn a_file_that_lies_is_refused() {
    let whole = String::from_utf8_lossy(&glb()).into_owned();
    assert!(whole.contains("componentType"));
    for (from, to) in [
        ("\"children\":[1]", "\"children\":[0]"),
        ("\"componentType\":5123", "\"componentType\":5126"),
        ("\"componentType\":5126", "\"componentType\":5121"),
        ("\"count\":36", "\"count\":99"),
        ("\"count\":8", "\"count\":0"),
        ("\"type\":\"VEC3\"", "\"type\":\"VEC2\""),
        ("\"byteOffset\":96", "\"byteOffset\":99"),
        ("\"byteLength\":72", "\"byteLength\":71"),
        ("\"mesh\":0", "\"mesh\":7"),
        ("\"indices\":1", "\"indices\":5"),
    ] {
        let bytes = glb();
        let at = bytes
            .windows(from.len())
            .position(|part| part == from.as_bytes())
            .unwrap();
        let mut changed = bytes.clone();
        changed[at..at + to.len()].copy_from_slice(to.as_bytes());
        let problem = parse_mesh(&changed).unwrap_err().to_string();
        assert!(problem.contains("glTF"), "{to}: {problem}");
    }
}

#[test]
fn two_objects_and_double_surfaces_are_refused() {
    let one = parse_mesh(&ply_binary()).unwrap();
    let count = one.vertices.len() as u32;
    let moved = |[x, y, z]: &[f64; 3]| [x + 2000.0, *y, *z];
    let two = Mesh {
        vertices: one
            .vertices
            .iter()
            .copied()
            .chain(one.vertices.iter().map(moved))
            .collect(),
        faces: one
            .faces
            .iter()
            .copied()
            .chain(one.faces.iter().map(|face| face.map(|place| place + count)))
            .collect(),
    };
    assert_eq!((one.parts(), two.parts()), (1, 2));
    let refused =
        scanned_body(&two, 1e-3, 50.0, Leaking::Refuse, &Underside::Measured).unwrap_err();
    assert!(
        refused.to_string().contains("2 separate parts"),
        "{refused}"
    );
    let twice = Mesh {
        faces: [one.faces.clone(), one.faces.clone()].concat(),
        ..one
    };
    let refused =
        scanned_body(&twice, 1e-3, 50.0, Leaking::Refuse, &Underside::Measured).unwrap_err();
    assert!(
        refused.to_string().contains("passes through itself"),
        "{refused}"
    );
}

/// A box with a base that is a roof of 1 mm: measured it stands on one side of the ridge, and it is flat where
/// nobody saw it.
#[test]
fn a_base_that_nobody_saw_is_flat_or_on_feet() {
    let top = [[0.0, 0.0], [0.4, 0.0], [0.4, 0.4], [0.0, 0.4]];
    let mut vertices: Vec<[f64; 3]> = top.iter().map(|[x, y]| [*x, *y, 1.0]).collect();
    vertices.extend(top.iter().map(|[x, y]| [*x, *y, 0.001]));
    vertices.extend([[0.2, 0.0, 0.0], [0.2, 0.4, 0.0]]);
    let faces = vec![
        [0, 1, 2],
        [0, 2, 3],
        [0, 5, 1],
        [0, 4, 5],
        [4, 8, 5],
        [1, 6, 2],
        [1, 5, 6],
        [2, 7, 3],
        [2, 6, 7],
        [6, 9, 7],
        [3, 4, 0],
        [3, 7, 4],
        [4, 7, 9],
        [4, 9, 8],
        [8, 9, 6],
        [8, 6, 5],
    ];
    let mesh = Mesh { vertices, faces };
    let stands = |underside: Underside| {
        let solid = scanned_body(&mesh, 1.0, 50.0, Leaking::Refuse, &underside).unwrap();
        let pose = solid.body.hull.standing().unwrap();
        let barrier = solid.body.hull.barrier(&pose);
        (pose.tilt().0, barrier.tilt_rad)
    };
    let (tilt, _) = stands(Underside::Measured);
    assert!((tilt - 0.001 / 0.2).abs() < 1e-4, "{tilt}");
    let (tilt, tips) = stands(Underside::Flat(0.002));
    assert!(
        tilt < 1e-9 && (tips - 0.4_f64.atan()).abs() < 1e-3,
        "{tilt} {tips}"
    );
    let feet = vec![[0.1, 0.1], [0.3, 0.1], [0.3, 0.3], [0.1, 0.3]];
    let (tilt, tips) = stands(Underside::Feet(feet, 0.002));
    assert!(
        tilt < 1e-3 && (tips - 0.2_f64.atan()).abs() < 2e-3,
        "{tilt} {tips}"
    );
}
