//! The hill that the centre of gravity of a body must climb before it falls.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;
use std::f64::consts::{PI, TAU};

use super::contact::Around;
use super::poses::StablePose;
use super::{Hull, Vector};

/// A body has fallen at this tilt from its pose \[rad\], or where its centre of gravity is this much lower
/// \[m\].
const FALLEN_RAD: f64 = 50.0 * PI / 180.0;
const FALLEN_M: f64 = 0.01;

/// Steps of the tilt and of its direction: a tenth of a degree and half a degree. The height of a pass is
/// then within 0.02 mm for a centre of gravity at 0.3 m.
const TILTS: usize = 500;
const DIRECTIONS: usize = 720;

/// The lowest way over which a body falls.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Barrier {
    /// Height of the centre of gravity in the pose \[m\].
    pub rest_m: f64,
    /// How much higher the pass is \[m\].
    pub rise_m: f64,
    /// Tilt of the pass from the pose \[rad\].
    pub tilt_rad: f64,
    /// Its direction: 0 to +x, π/2 to +y \[rad\].
    pub toward_rad: f64,
}

impl Barrier {
    /// The slenderness angle of the symmetric block with the same barrier, acos(Z_rest/Z_pass) \[rad\].
    pub fn angle_rad(&self) -> f64 {
        (self.rest_m / (self.rest_m + self.rise_m)).acos()
    }
}

/// A cell by the highest place on the best known way to it.
#[derive(PartialEq)]
struct Way {
    highest_m: f64,
    cell: usize,
}

impl Eq for Way {}

impl Ord for Way {
    fn cmp(&self, other: &Self) -> Ordering {
        let by_height = self.highest_m.total_cmp(&other.highest_m);
        by_height.then(self.cell.cmp(&other.cell))
    }
}

impl PartialOrd for Way {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Hull {
    /// The lowest pass between a pose and a fall: over all ways of tilting, the smallest of the largest
    /// heights of the centre of gravity on the way to a tilt of 50°, or to 10 mm below the pose.
    pub fn barrier(&self, pose: &StablePose) -> Barrier {
        let around = Around::new(&pose.down);
        let down_of = |cell: usize| -> Vector {
            let (tilt_rad, toward_rad) = angles(cell);
            around.down(tilt_rad, toward_rad)
        };
        let rest_m = pose.cg_height_m;
        let cells = 1 + TILTS * DIRECTIONS;
        // Nearly all cells are never reached.
        let mut heights_m = vec![f64::NAN; cells];
        let mut height = |cell: usize| {
            if heights_m[cell].is_nan() {
                heights_m[cell] = self.height_m(&down_of(cell));
            }
            heights_m[cell]
        };
        let mut highest_m = vec![f64::INFINITY; cells];
        let mut pass = vec![0; cells];
        highest_m[0] = rest_m;
        let mut open = BinaryHeap::from([Reverse(Way {
            highest_m: rest_m,
            cell: 0,
        })]);
        while let Some(Reverse(Way {
            highest_m: most_m,
            cell,
        })) = open.pop()
        {
            if most_m > highest_m[cell] {
                continue;
            }
            let is_over = cell > (TILTS - 1) * DIRECTIONS;
            if is_over || height(cell) < rest_m - FALLEN_M {
                let (tilt_rad, _) = angles(pass[cell]);
                return Barrier {
                    rest_m,
                    rise_m: most_m - rest_m,
                    tilt_rad,
                    toward_rad: super::tilt_of(&horizontal(&pose.down, &down_of(pass[cell]))).1,
                };
            }
            for next in beside(cell) {
                let here_m = height(next);
                let way_m = most_m.max(here_m);
                if way_m < highest_m[next] {
                    highest_m[next] = way_m;
                    pass[next] = if here_m >= most_m { next } else { pass[cell] };
                    open.push(Reverse(Way {
                        highest_m: way_m,
                        cell: next,
                    }));
                }
            }
        }
        // No way leads to a tilt of 50°: the grid is connected, so this is never reached.
        Barrier {
            rest_m,
            rise_m: f64::INFINITY,
            tilt_rad: FALLEN_RAD,
            toward_rad: 0.0,
        }
    }
}

/// The part of a direction that is not along the pose.
fn horizontal(pose_down: &Vector, down: &Vector) -> Vector {
    let along = crate::space::dot(pose_down, down);
    [0, 1, 2].map(|i| down[i] - along * pose_down[i])
}

/// Tilt and direction of a cell; cell 0 is the pose.
fn angles(cell: usize) -> (f64, f64) {
    let Some(rest) = cell.checked_sub(1) else {
        return (0.0, 0.0);
    };
    (
        FALLEN_RAD * (rest / DIRECTIONS + 1) as f64 / TILTS as f64,
        TAU * (rest % DIRECTIONS) as f64 / DIRECTIONS as f64,
    )
}

/// The cells beside a cell, with those across its corners.
fn beside(cell: usize) -> Vec<usize> {
    let Some(rest) = cell.checked_sub(1) else {
        return (1..=DIRECTIONS).collect();
    };
    let (ring, one) = (rest / DIRECTIONS, rest % DIRECTIONS);
    let near = [
        (one + DIRECTIONS - 1) % DIRECTIONS,
        one,
        (one + 1) % DIRECTIONS,
    ];
    let at = |ring: usize, one: usize| 1 + ring * DIRECTIONS + one;
    let mut cells = vec![at(ring, near[0]), at(ring, near[2])];
    match ring.checked_sub(1) {
        Some(inner) => cells.extend(near.map(|one| at(inner, one))),
        None => cells.push(0),
    }
    if ring + 1 < TILTS {
        cells.extend(near.map(|one| at(ring + 1, one)));
    }
    cells
}
