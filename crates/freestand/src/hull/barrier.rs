//! The hill that the centre of gravity of a body must climb before it falls.

use std::cmp::{Ordering, Reverse};
use std::collections::{BinaryHeap, HashMap};
use std::f64::consts::{PI, TAU};

use super::contact::Around;
use super::poses::StablePose;
use super::{Hull, Vector, tilt_of};
use crate::space::dot;

/// A body has fallen at this tilt from its pose \[rad\], or where its centre of gravity is this much lower
/// \[m\].
const FALLEN_RAD: f64 = 50.0 * PI / 180.0;
const FALLEN_M: f64 = 0.01;

/// Steps of the tilt and of its direction: a tenth of a degree and half a degree.
const TILTS: usize = 500;
const DIRECTIONS: usize = 720;

/// About the pass they are this many times finer: the height of the pass is then within 0.01 mm for a centre
/// of gravity at 0.3 m.
const FINER: usize = 8;

/// How far about the pass \[steps\].
const WINDOW: usize = 10;

/// The lowest way over which a body falls.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Barrier {
    /// Height of the centre of gravity in the pose \[m\].
    pub rest_m: f64,
    /// How much higher the pass is \[m\].
    pub rise_m: f64,
    /// Tilt of the pass from the pose: from there on the body falls by itself. About an edge it is the angle of
    /// the edge \[rad\].
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

impl Hull {
    /// The lowest pass between a pose and a fall: over all ways of tilting, the smallest of the largest
    /// heights of the centre of gravity on the way to a tilt of 50°, or to 10 mm below the pose.
    pub fn barrier(&self, pose: &StablePose) -> Barrier {
        let rest_m = pose.cg_height_m;
        let coarse = Grid::new(self, pose, 1);
        let is_over =
            |cell: Cell, height_m: f64| cell.tilt == coarse.tilts || height_m < rest_m - FALLEN_M;
        let way = coarse.lowest_way(POSE, |_| true, is_over);
        // The same about the pass alone, in finer steps, from before it to past it.
        let at = way.highest();
        let (from, to) = (
            at.saturating_sub(WINDOW),
            (at + WINDOW).min(way.cells.len() - 1),
        );
        let fine = Grid::new(self, pose, FINER);
        let [start, end] = [from, to].map(|at| fine.of(way.cells[at].0));
        let pass = way.cells[at].0;
        let is_near = |cell: Cell| fine.is_near(cell, pass);
        let finer = fine.lowest_way(start, is_near, |cell, _| cell == end);
        let (cell, pass_m) = finer.cells[finer.highest()];
        let beside = way.cells[..from].iter().chain(&way.cells[to..]);
        let highest_m = beside.map(|(_, height_m)| *height_m).fold(pass_m, f64::max);
        let down = fine.down(cell);
        let along = dot(&down, &pose.down);
        let aside = [0, 1, 2].map(|i| down[i] - along * pose.down[i]);
        Barrier {
            rest_m,
            rise_m: highest_m - rest_m,
            tilt_rad: fine.angles(cell).0,
            toward_rad: tilt_of(&aside).1,
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
    around: Around,
    finer: usize,
    tilts: usize,
    directions: usize,
}

impl<'h> Grid<'h> {
    fn new(hull: &'h Hull, pose: &StablePose, finer: usize) -> Self {
        Self {
            hull,
            around: Around::new(&pose.down),
            finer,
            tilts: finer * TILTS,
            directions: finer * DIRECTIONS,
        }
    }

    /// A cell of the coarse grid.
    fn of(&self, coarse: Cell) -> Cell {
        Cell {
            tilt: self.finer * coarse.tilt,
            direction: self.finer * coarse.direction,
        }
    }

    fn angles(&self, cell: Cell) -> (f64, f64) {
        (
            FALLEN_RAD * cell.tilt as f64 / self.tilts as f64,
            TAU * cell.direction as f64 / self.directions as f64,
        )
    }

    fn down(&self, cell: Cell) -> Vector {
        let (tilt_rad, toward_rad) = self.angles(cell);
        self.around.down(tilt_rad, toward_rad)
    }

    /// Whether a cell is within twice the window about one of the coarse grid.
    fn is_near(&self, cell: Cell, coarse: Cell) -> bool {
        let middle = self.of(coarse);
        let most = 2 * WINDOW * self.finer;
        let turn = cell.direction.abs_diff(middle.direction);
        // Near the pose all directions are.
        cell.tilt.abs_diff(middle.tilt) <= most
            && (turn.min(self.directions - turn) <= most || cell.tilt <= most)
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

    /// The way from `start` whose highest place is lowest, through cells that are allowed, to the first one
    /// that ends it.
    fn lowest_way(
        &self,
        start: Cell,
        is_allowed: impl Fn(Cell) -> bool,
        is_end: impl Fn(Cell, f64) -> bool,
    ) -> Way {
        let height = |cell: Cell| self.hull.height_m(&self.down(cell));
        let start_m = height(start);
        let mut seen: HashMap<Cell, Seen> = HashMap::new();
        seen.insert(
            start,
            Seen {
                height_m: start_m,
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
                return Way::back(&seen, start, cell);
            }
            for next in self
                .beside(cell)
                .into_iter()
                .filter(|next| is_allowed(*next))
            {
                let found = seen.entry(next).or_insert_with(|| Seen {
                    height_m: height(next),
                    highest_m: f64::INFINITY,
                    before: cell,
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

/// What is known of a cell: its height, the highest place on the best way to it, and the cell before it.
#[derive(Clone, Copy)]
struct Seen {
    height_m: f64,
    highest_m: f64,
    before: Cell,
}

/// Cells with their heights, from the pose.
struct Way {
    cells: Vec<(Cell, f64)>,
}

impl Way {
    fn back(seen: &HashMap<Cell, Seen>, start: Cell, end: Cell) -> Self {
        let mut cells = vec![(end, seen[&end].height_m)];
        let mut cell = end;
        while cell != start {
            cell = seen[&cell].before;
            cells.push((cell, seen[&cell].height_m));
        }
        cells.reverse();
        Self { cells }
    }

    /// The place of its highest cell.
    fn highest(&self) -> usize {
        let all = self.cells.iter().enumerate();
        all.max_by(|a, b| a.1.1.total_cmp(&b.1.1))
            .map_or(0, |(at, _)| at)
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
