//! The hill that the centre of gravity of a body must climb before it falls.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;
use std::f64::consts::{PI, TAU};

use foldhash::{HashMap, HashSet};

use super::poses::StablePose;
use super::{Hull, Vector};

/// A body has fallen at this tilt from its pose \[rad\], or where its centre of gravity is this much lower
/// \[m\].
const FALLEN_RAD: f64 = 50.0 * PI / 180.0;
const FALLEN_M: f64 = 0.01;

/// Steps of the tilt and of its direction: a tenth of a degree and half a degree.
const TILTS: usize = 500;
const DIRECTIONS: usize = 720;

/// Beside the lowest way they are this many times finer, because the edge over which it falls may lie between
/// two directions; within this many coarse steps.
const FINER: usize = 8;
const WIDTH: usize = 2;

/// The lowest way over which a body falls.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Barrier {
    /// Height of the centre of gravity in the pose \[m\].
    pub rest_m: f64,
    /// How much higher the pass is \[m\].
    pub rise_m: f64,
    /// Tilt of the pass from the pose; about an edge it is the angle of the edge \[rad\].
    pub tilt_rad: f64,
    /// Its direction in the [axes](StablePose::axes) of the pose: 0 to +x, π/2 to +y \[rad\].
    pub toward_rad: f64,
}

impl Barrier {
    /// The slenderness angle of the symmetric block with the same barrier, acos(Z_rest/Z_pass) \[rad\].
    pub fn angle_rad(&self) -> f64 {
        (self.rest_m / (self.rest_m + self.rise_m)).acos()
    }
}

impl Hull {
    /// The lowest pass between a pose and a fall: over all ways of tilting, the smallest of the largest
    /// heights of the centre of gravity on the way to a tilt of 50°, or to 10 mm below the pose. Passes to other
    /// stable poses on the way are not told apart.
    pub fn barrier(&self, pose: &StablePose) -> Barrier {
        let rest_m = pose.cg_height_m;
        let is_over = |grid: &Grid, cell: Cell, height_m: f64| {
            cell.tilt == grid.tilts || height_m < rest_m - FALLEN_M
        };
        let sides = self.sides();
        let coarse = Grid::new(self, &sides, pose, 1);
        let mut way =
            coarse.lowest_way(|_| true, |cell, height_m| is_over(&coarse, cell, height_m));
        // The same beside that way alone, in finer steps, until it is lower again for good.
        let low_m = rest_m + 0.9 * (way.highest().1 - rest_m);
        let is_high = |(_, height_m): &(Cell, f64)| *height_m > low_m;
        let last = way.cells.iter().rposition(is_high).unwrap_or(0);
        way.cells.truncate(last + 2);
        let end = way.cells.last().map_or(POSE, |(cell, _)| *cell);
        let fine = Grid::new(self, &sides, pose, FINER);
        let on_way = way.cells.iter().map(|(cell, _)| *cell);
        let beside = coarse.beside_all(on_way.filter(|cell| *cell != POSE));
        // Below the first coarse step, the way has the direction of that step.
        let coarser = |cell: Cell| Cell {
            tilt: (cell.tilt / FINER).max(1),
            direction: cell.direction / FINER,
        };
        let way = fine.lowest_way(
            |cell| beside.contains(&coarser(cell)),
            |cell, height_m| coarser(cell) == end || is_over(&fine, cell, height_m),
        );
        let (cell, highest_m) = way.highest();
        let (tilt_rad, toward_rad) = fine.angles(cell);
        // From −π to π.
        let toward_rad = toward_rad.sin().atan2(toward_rad.cos());
        Barrier {
            rest_m,
            rise_m: highest_m - rest_m,
            tilt_rad,
            toward_rad,
        }
    }
}

/// A tilt and its direction, in steps of a grid; no tilt has one direction alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
struct Cell {
    tilt: usize,
    direction: usize,
}

const POSE: Cell = Cell {
    tilt: 0,
    direction: 0,
};

struct Grid<'h> {
    hull: &'h Hull,
    sides: &'h [Vec<usize>],
    pose: &'h StablePose,
    axes: [Vector; 3],
    tilts: usize,
    directions: usize,
}

impl<'h> Grid<'h> {
    fn new(hull: &'h Hull, sides: &'h [Vec<usize>], pose: &'h StablePose, finer: usize) -> Self {
        Self {
            hull,
            sides,
            pose,
            axes: pose.axes(),
            tilts: finer * TILTS,
            directions: finer * DIRECTIONS,
        }
    }

    /// These cells, and all within [`WIDTH`] of them.
    fn beside_all(&self, cells: impl Iterator<Item = Cell>) -> HashSet<Cell> {
        let mut all: HashSet<Cell> = cells.collect();
        for _ in 0..WIDTH {
            let more: Vec<Cell> = all.iter().flat_map(|cell| self.beside(*cell)).collect();
            all.extend(more);
        }
        all
    }

    fn angles(&self, cell: Cell) -> (f64, f64) {
        (
            FALLEN_RAD * cell.tilt as f64 / self.tilts as f64,
            TAU * cell.direction as f64 / self.directions as f64,
        )
    }

    fn down(&self, cell: Cell) -> Vector {
        let (tilt_rad, toward_rad) = self.angles(cell);
        self.pose.tilted(&self.axes, tilt_rad, toward_rad)
    }

    /// The cells beside a cell, with those across its corners.
    fn beside(&self, cell: Cell) -> Vec<Cell> {
        let at = |tilt: usize, direction: usize| Cell { tilt, direction };
        if cell == POSE {
            return (0..self.directions).map(|one| at(1, one)).collect();
        }
        let one = cell.direction;
        let near = [
            (one + self.directions - 1) % self.directions,
            one,
            (one + 1) % self.directions,
        ];
        let mut cells = vec![at(cell.tilt, near[0]), at(cell.tilt, near[2])];
        match cell.tilt {
            1 => cells.push(POSE),
            tilt => cells.extend(near.map(|one| at(tilt - 1, one))),
        }
        if cell.tilt < self.tilts {
            cells.extend(near.map(|one| at(cell.tilt + 1, one)));
        }
        cells
    }

    /// The way from the pose whose highest place is lowest, through cells that are allowed, to the first one
    /// that ends it.
    fn lowest_way(
        &self,
        is_allowed: impl Fn(Cell) -> bool,
        is_end: impl Fn(Cell, f64) -> bool,
    ) -> Way {
        let start = POSE;
        let (start_m, vertex) = self.hull.lowest(&self.down(start));
        let mut seen: HashMap<Cell, Seen> = HashMap::default();
        seen.insert(
            start,
            Seen {
                height_m: start_m,
                vertex,
                highest_m: start_m,
                before: start,
            },
        );
        let mut open = BinaryHeap::from([Reverse(Open(start_m, start))]);
        while let Some(Reverse(Open(highest_m, cell))) = open.pop() {
            let here = seen[&cell];
            if highest_m > here.highest_m {
                continue;
            }
            if is_end(cell, here.height_m) {
                return Way::back(&seen, cell);
            }
            for next in self
                .beside(cell)
                .into_iter()
                .filter(|next| is_allowed(*next))
            {
                let found = seen.entry(next).or_insert_with(|| {
                    let down = self.down(next);
                    let (height_m, vertex) = self.hull.lowest_from(here.vertex, self.sides, &down);
                    Seen {
                        height_m,
                        vertex,
                        highest_m: f64::INFINITY,
                        before: cell,
                    }
                });
                let way_m = highest_m.max(found.height_m);
                if way_m < found.highest_m {
                    (found.highest_m, found.before) = (way_m, cell);
                    open.push(Reverse(Open(way_m, next)));
                }
            }
        }
        // Every cell is beside others that lead to the end.
        Way {
            cells: vec![(start, start_m)],
        }
    }
}

/// What is known of a cell: its height and the vertex on which it stands, the highest place on the best way to it, and
/// the cell before it.
#[derive(Clone, Copy)]
struct Seen {
    height_m: f64,
    vertex: usize,
    highest_m: f64,
    before: Cell,
}

/// Cells with their heights, from the pose.
struct Way {
    cells: Vec<(Cell, f64)>,
}

impl Way {
    fn back(seen: &HashMap<Cell, Seen>, end: Cell) -> Self {
        let mut cells = vec![(end, seen[&end].height_m)];
        let mut cell = end;
        while cell != POSE {
            cell = seen[&cell].before;
            cells.push((cell, seen[&cell].height_m));
        }
        cells.reverse();
        Self { cells }
    }

    /// Its highest cell.
    fn highest(&self) -> (Cell, f64) {
        let cells = self.cells.iter().copied();
        cells
            .reduce(|most, one| if one.1 > most.1 { one } else { most })
            .unwrap_or((POSE, 0.0))
    }
}

/// A cell by the highest place on the best known way to it.
#[derive(PartialEq)]
struct Open(f64, Cell);

impl Eq for Open {}

impl Ord for Open {
    fn cmp(&self, other: &Self) -> Ordering {
        self.0.total_cmp(&other.0).then(self.1.cmp(&other.1))
    }
}

impl PartialOrd for Open {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
