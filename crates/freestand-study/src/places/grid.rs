//! The grid of annex B of NTC: ag, F0 and Tc* at nine return periods, between its nodes and its periods.

use std::io::Read as _;
use std::sync::LazyLock;

use flate2::read::ZlibDecoder;
use freestand::code_spectrum::NtcHazard;
use freestand_records::tables::hazard::NTC_YEARS;

use super::Coordinates;

/// A node further south has an id larger by this; one further east by 1.
const ROW: u32 = 222;
/// Values of a node: its id, longitude and latitude, and three for each return period.
const COLUMNS: usize = 3 + 3 * NTC_YEARS.len();

struct Node {
    id: u32,
    /// On ED50.
    at: Coordinates,
    /// ag \[g\], F0, Tc* \[s\] for each return period.
    values: [[f64; 3]; NTC_YEARS.len()],
}

/// The nodes by ascending id.
fn nodes() -> &'static [Node] {
    static NODES: LazyLock<Vec<Node>> =
        LazyLock::new(|| read(include_bytes!("../../places/italy.zlib")));
    &NODES
}

/// The text of a compressed table; `None` for one that is damaged.
pub(super) fn inflated(bytes: &[u8]) -> Option<Vec<u8>> {
    let mut out = Vec::new();
    ZlibDecoder::new(bytes).read_to_end(&mut out).ok()?;
    Some(out)
}

/// The nodes as make.py writes them: a column after another, each as differences, zigzag, in three planes of bytes.
fn read(bytes: &[u8]) -> Vec<Node> {
    let planes = inflated(bytes).unwrap_or_default();
    let values = planes.len() / 3;
    let rows = values / COLUMNS;
    let columns: Vec<Vec<i32>> = (0..COLUMNS)
        .map(|column| {
            let mut value = 0;
            (0..rows)
                .map(|row| {
                    let at = column * rows + row;
                    let zigzag = (0..3).fold(0, |all, plane| {
                        all | i32::from(planes[plane * values + at]) << (8 * plane)
                    });
                    value += (zigzag >> 1) ^ -(zigzag & 1);
                    value
                })
                .collect()
        })
        .collect();
    let node = |row: usize| {
        let at = |column: usize| f64::from(columns[column][row]);
        Node {
            id: columns[0][row].unsigned_abs(),
            at: Coordinates {
                latitude_deg: at(2) / 1e4,
                longitude_deg: at(1) / 1e4,
            },
            values: std::array::from_fn(|k| std::array::from_fn(|j| at(3 + 3 * k + j) / 1e3)),
        }
    };
    (0..rows).map(node).collect()
}

/// The four nodes around a point, each with its distance \[km\]; `None` outside the grid.
fn around(point: Coordinates) -> Option<[(&'static Node, f64); 4]> {
    let point = ed50(point);
    let nodes = nodes();
    let nearest = nodes
        .iter()
        .min_by(|a, b| a.at.distance_km(point).total_cmp(&b.at.distance_km(point)))?;
    let node = |id: u32| {
        let at = nodes.binary_search_by_key(&id, |node| node.id).ok()?;
        nodes.get(at)
    };
    // The nearest node is a corner of the cell, the north-western, north-eastern, south-western or south-eastern one.
    [0, 1, ROW, ROW + 1].into_iter().find_map(|back| {
        let first = nearest.id.checked_sub(back)?;
        let corners = [
            node(first)?,
            node(first + 1)?,
            node(first + ROW + 1)?,
            node(first + ROW)?,
        ];
        let is_cell = corners
            .iter()
            .all(|one| one.at.distance_km(nearest.at) < LARGEST_DIAGONAL_KM);
        (is_cell && holds(corners.map(|node| node.at), point))
            .then(|| corners.map(|node| (node, node.at.distance_km(point))))
    })
}

/// Ids go on from one row to the next where a row is short: such nodes are no neighbours. A cell of 0.05° has a diagonal of
/// 5.6 km north to south and 4.4 km west to east at 37° N, so of 7.1 km at most.
const LARGEST_DIAGONAL_KM: f64 = 8.0;

/// Whether a point lies in a quadrilateral, its corners clockwise; its edges count.
fn holds(corners: [Coordinates; 4], point: Coordinates) -> bool {
    (0..4).all(|k| {
        let (from, to) = (corners[k], corners[(k + 1) % 4]);
        let (x, y) = (
            to.longitude_deg - from.longitude_deg,
            to.latitude_deg - from.latitude_deg,
        );
        let (px, py) = (
            point.longitude_deg - from.longitude_deg,
            point.latitude_deg - from.latitude_deg,
        );
        x * py - y * px <= 0.0
    })
}

/// The distance to the nearest of the four nodes around a point \[km\]; `None` outside the grid.
pub(super) fn node_distance_km(point: Coordinates) -> Option<f64> {
    Some(
        around(point)?
            .map(|(_, km)| km)
            .into_iter()
            .fold(f64::INFINITY, f64::min),
    )
}

/// The hazard of a point on rock; `None` outside the grid, or outside 30 to 2475 years.
///
/// At each of the four nodes, log p is linear in log T_R between the return periods of the annex; then p of the point is
/// `Σ (p_i/d_i) / Σ (1/d_i)`, d_i being the distance to a node.
///
/// # Reference
/// NTC 2008, annex A, Eqs. 2 and 3, to which NTC 2018, 3.2, refers.
pub fn ntc_hazard(point: Coordinates, years: u32) -> Option<NtcHazard> {
    let upper = NTC_YEARS.iter().position(|&known| years <= known)?;
    let lower = upper.saturating_sub(1);
    if years < NTC_YEARS[0] {
        return None;
    }
    let [from, to] = [lower, upper].map(|k| f64::from(NTC_YEARS[k]).ln());
    let share = if years == NTC_YEARS[upper] {
        1.0
    } else {
        (f64::from(years).ln() - from) / (to - from)
    };
    let corners = around(point)?;
    // On a node its weight is infinite: a nanometre away gives its values.
    let weights = corners.map(|(_, km)| 1.0 / km.max(1e-12));
    let total: f64 = weights.iter().sum();
    let [ag_g, f0_ratio, tc_star_s] = std::array::from_fn(|j| {
        let at = |(node, _): (&Node, f64)| {
            let [low, high] = [lower, upper].map(|k| node.values[k][j].ln());
            (low + share * (high - low)).exp()
        };
        corners
            .iter()
            .zip(weights)
            .map(|(&corner, weight)| at(corner) * weight)
            .sum::<f64>()
            / total
    });
    Some(NtcHazard {
        ag_g,
        f0_ratio,
        tc_star_s,
    })
}

/// Coordinates on ED50 of a point on WGS 84: three shifts, mean of Europe (EPSG 1133).
fn ed50(point: Coordinates) -> Coordinates {
    const SHIFT_M: [f64; 3] = [87.0, 98.0, 121.0];
    const WGS84: [f64; 2] = [6_378_137.0, 1.0 / 298.257_223_563];
    const HAYFORD: [f64; 2] = [6_378_388.0, 1.0 / 297.0];
    let squared = |flattening: f64| flattening * (2.0 - flattening);
    let (latitude, longitude) = (
        point.latitude_deg.to_radians(),
        point.longitude_deg.to_radians(),
    );
    let e2 = squared(WGS84[1]);
    let n = WGS84[0] / (1.0 - e2 * latitude.sin().powi(2)).sqrt();
    let x = n * latitude.cos() * longitude.cos() + SHIFT_M[0];
    let y = n * latitude.cos() * longitude.sin() + SHIFT_M[1];
    let z = n * (1.0 - e2) * latitude.sin() + SHIFT_M[2];
    let (e2, p) = (squared(HAYFORD[1]), x.hypot(y));
    let mut latitude = z.atan2(p * (1.0 - e2));
    // Each step leaves e² of the error before.
    for _ in 0..6 {
        let n = HAYFORD[0] / (1.0 - e2 * latitude.sin().powi(2)).sqrt();
        latitude = (z + e2 * n * latitude.sin()).atan2(p);
    }
    Coordinates {
        latitude_deg: latitude.to_degrees(),
        longitude_deg: y.atan2(x).to_degrees(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(latitude_deg: f64, longitude_deg: f64) -> Coordinates {
        Coordinates {
            latitude_deg,
            longitude_deg,
        }
    }

    /// Published values at 475 years: L'Aquila 0.2607 g, 2.364, 0.347 s, Rome (the Colosseum) 0.121 g, Milan 0.050 g. The
    /// point of L'Aquila is not published: within a kilometre ag differs by 0.001 g, F0 by 0.002, Tc* by 0.001 s; of the
    /// other two half a unit of the last digit.
    #[test]
    fn published_values() {
        let laquila = ntc_hazard(at(42.3498, 13.3995), 475).unwrap();
        assert!((laquila.ag_g - 0.2607).abs() < 1e-3, "{laquila:?}");
        assert!((laquila.f0_ratio - 2.364).abs() < 2e-3, "{laquila:?}");
        assert!((laquila.tc_star_s - 0.347).abs() < 1e-3, "{laquila:?}");
        let rome = ntc_hazard(at(41.8902, 12.4922), 475).unwrap();
        assert!((rome.ag_g - 0.121).abs() < 5e-4, "{rome:?}");
        let milan = ntc_hazard(at(45.4642, 9.19), 475).unwrap();
        assert!((milan.ag_g - 0.050).abs() < 5e-4, "{milan:?}");
    }

    /// At a node the values are those of its row; a return period between two columns lies on the straight line of the
    /// logarithms, by hand for the node 13111: 0.094 and 0.127 g at 475 and 975 years.
    #[test]
    fn nodes_and_periods() {
        let node = nodes().iter().find(|node| node.id == 13_111).unwrap();
        assert_eq!(node.at, at(45.1345, 6.5448));
        assert_eq!(node.values[6], [0.094, 2.435, 0.267]);
        assert_eq!(nodes().len(), 10_751);
        let inside = at(42.35, 13.40);
        let [low, between, high] =
            [475, 700, 975].map(|years| ntc_hazard(inside, years).unwrap().ag_g);
        assert!(low < between && between < high);
        // Every grid value rises by nearly the same power between two periods here.
        let line =
            (low.ln() + (high / low).ln() * (700f64 / 475.0).ln() / (975f64 / 475.0).ln()).exp();
        assert!((between / line - 1.0).abs() < 1e-4, "{between} {line}");
        assert_eq!(ntc_hazard(inside, 29), None);
        assert_eq!(ntc_hazard(inside, 2476), None);
        assert!(ntc_hazard(inside, 30).is_some() && ntc_hazard(inside, 2475).is_some());
    }

    /// Sardinia and the open sea have no nodes; every node has a cell that holds its neighbourhood.
    #[test]
    fn where_the_grid_is() {
        for (latitude, longitude) in [(39.22, 9.12), (41.01, 28.97), (40.0, 13.0), (f64::NAN, 0.0)]
        {
            assert!(around(at(latitude, longitude)).is_none(), "{latitude}");
        }
        let cells = nodes().iter().step_by(97).filter_map(|node| {
            // A point of the cell to the south-east, back on WGS 84 to about a metre.
            let moved = at(node.at.latitude_deg - 0.02, node.at.longitude_deg + 0.03);
            let there = ed50(moved);
            let back = at(
                2.0 * moved.latitude_deg - there.latitude_deg,
                2.0 * moved.longitude_deg - there.longitude_deg,
            );
            around(back)
        });
        let found = cells
            .map(|corners| corners.map(|(_, km)| km))
            .collect::<Vec<_>>();
        assert!(found.len() > 90, "{}", found.len());
        assert!(found.iter().flatten().all(|&km| km < LARGEST_DIAGONAL_KM));
    }

    /// The shift to ED50 is some 130 m here: 45° N 10° E is 45.000 93° N 10.000 98° E (three shifts, by the formulas of
    /// Molodensky, which differ by a metre: 1e-5°).
    #[test]
    fn the_datum() {
        let there = ed50(at(45.0, 10.0));
        let (latitude, longitude) = (45.0f64.to_radians(), 10.0f64.to_radians());
        let [dx, dy, dz] = [87.0, 98.0, 121.0];
        let (a, da) = (6_378_137.0, 251.0);
        let (f, df) = (1.0 / 298.257_223_563, 1.0 / 297.0 - 1.0 / 298.257_223_563);
        let e2: f64 = f * (2.0 - f);
        let w = 1.0 - e2 * latitude.sin().powi(2);
        let (n, m) = (a / w.sqrt(), a * (1.0 - e2) / w.powf(1.5));
        let north = (-dx * latitude.sin() * longitude.cos()
            - dy * latitude.sin() * longitude.sin()
            + dz * latitude.cos()
            + da * n * e2 * latitude.sin() * latitude.cos() / a
            + df * (m / (1.0 - f) + n * (1.0 - f)) * latitude.sin() * latitude.cos())
            / m;
        let east = (-dx * longitude.sin() + dy * longitude.cos()) / (n * latitude.cos());
        assert!((there.latitude_deg - 45.0 - north.to_degrees()).abs() < 1e-5);
        assert!((there.longitude_deg - 10.0 - east.to_degrees()).abs() < 1e-5);
    }
}
