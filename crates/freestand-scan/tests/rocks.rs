//! Two scanned rocks that were shaken on a table: `shake-table/` of the shared data, where it is.

#![allow(clippy::unwrap_used, clippy::print_stderr, reason = "tests")]

use std::path::PathBuf;

use freestand_scan::body::{Leaking, Solid, Underside, scanned_body};
use freestand_scan::formats::read_mesh;

/// The scans; `None` where they are not at hand, which is said.
fn rocks() -> Option<[Solid; 2]> {
    let shared = std::env::var_os("FREESTAND_SHARED").map_or_else(
        || PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared"),
        PathBuf::from,
    );
    let folder = shared.join("shake-table");
    if !folder.join("rock1.obj").is_file() {
        eprintln!(
            "skipped: the scans of the rocks are not in {}",
            folder.display()
        );
        return None;
    }
    let rock = |name: &str, mass_kg| {
        let (_, mesh) = read_mesh(&folder.join(name)).unwrap();
        assert!(mesh.is_watertight(), "{name}");
        scanned_body(&mesh, 1.0, mass_kg, Leaking::Refuse, &Underside::Measured).unwrap()
    };
    Some([rock("rock1.obj", 353.8), rock("rock2.obj", 353.5)])
}

/// What an independent calculation found: the centre of gravity at 0.294 m and 0.292 m; barriers of 7.3° and 6.7°,
/// on a grid of 0.5° × 2°; rock 2 has a second pose 8° away.
#[test]
fn the_scanned_rocks_have_their_known_shapes() {
    let Some(rocks) = rocks() else { return };
    // The numbers have two or three digits; a scan's own reading of its base is a few tenths of a degree.
    for (rock, cg_m, angle_deg) in [(&rocks[0], 0.294, 7.3), (&rocks[1], 0.292, 6.7)] {
        let hull = &rock.body.hull;
        let pose = hull.standing().unwrap();
        assert!((pose.cg_height_m - cg_m).abs() < 5e-4, "{pose:?}");
        let barrier = hull.barrier(&pose);
        let found = barrier.angle_rad().to_degrees();
        assert!((found - angle_deg).abs() < 0.2, "{found}");
        let points = hull.contact_points_m(&pose);
        assert!((40..=90).contains(&points.len()), "{}", points.len());
    }
    assert!((rocks[0].volume_m3 - 0.1225).abs() < 1e-3);
    let near: Vec<f64> = rocks[1]
        .body
        .hull
        .stable_poses()
        .iter()
        .map(|pose| pose.tilt().0.to_degrees())
        .filter(|tilt| *tilt < 20.0)
        .collect();
    assert!(
        matches!(near[..], [first, second] if first < 1.0 && (second - 8.0).abs() < 0.5),
        "{near:?}"
    );
}
