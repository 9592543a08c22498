//! What is compared with the tests.

use std::f64::consts::PI;
use std::path::Path;

use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::hull::barrier::Barrier;
use freestand::hull::poses::StablePose;
use freestand::hull::shake::{Contact, HullOutcome, shake};
use freestand::hull::standing::Standing;
use freestand::measures::measures;
use freestand::rocking::{Base, Outcome, RockingOptions, Until, rock};
use freestand::signal::filter::{Pass, filtered};
use freestand::spatial::SpatialMotion;
use freestand_input::problem::Problem;
use freestand_input::words::number;
use freestand_scan::body::{Leaking, Solid, Underside, scanned_body};
use freestand_scan::formats::read_mesh;
use rand::RngExt;
use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use crate::data::Test;
use crate::scores::logistic;

/// The masses \[kg\].
const MASSES_KG: [f64; 2] = [353.8, 353.5];

/// What was fixed before a body in space was run. One history: along +x of the scan, with [`Contact::default`].
/// The probability: the mean over ten points of a Latin hypercube and both signs of the direction, with these
/// ranges.
pub(crate) struct Prior {
    yaw_rad: (f64, f64),
    friction_ratio: (f64, f64),
    damping_ratio: (f64, f64),
    sinking_m: (f64, f64),
    scale_ratio: (f64, f64),
}

/// The direction of the table relative to the scan, friction and restitution are not known.
pub(crate) const PRIOR: Prior = Prior {
    yaw_rad: (-20.0 * PI / 180.0, 20.0 * PI / 180.0),
    friction_ratio: (0.4, 0.8),
    damping_ratio: (0.05, 0.5),
    sinking_m: (5e-5, 5e-4),
    scale_ratio: (0.9, 1.1),
};

/// Points of the hypercube.
const POINTS: usize = 10;

/// A scanned rock and what follows from it.
pub(crate) struct Rock {
    scanned: Solid,
    standing: Standing,
    barrier: Barrier,
    /// Which motions of a plane along x: the levers of its edges by each reading of the base.
    projected: Block,
    along_ray: Block,
    symmetric: Block,
}

impl Rock {
    pub(crate) fn read(folder: &Path, number: usize) -> Result<Self, Problem> {
        let path = folder.join(format!("rock{number}.obj"));
        let (_, mesh) = read_mesh(&path)?;
        let scanned = scanned_body(
            &mesh,
            1.0,
            MASSES_KG[number - 1],
            Leaking::Refuse,
            &Underside::Measured,
        )
        .map_err(|problem| problem.in_file(&path))?;
        let unfit = |error: &dyn std::fmt::Display| {
            Problem::value(error.to_string(), "check the scan").in_file(&path)
        };
        let body = &scanned.body;
        let standing = body
            .standing(0)
            .ok_or_else(|| unfit(&"it does not stand"))?;
        let barrier = body.hull.barrier(standing.pose());
        let cg_m = standing.pose().cg_height_m;
        let polygon = polygon(&scanned, standing.pose());
        let levers = |reach: &dyn Fn(f64) -> f64| [reach(0.0), reach(PI)];
        let projected = levers(&|toward| {
            polygon
                .iter()
                .map(|[x, y]| x * toward.cos() + y * toward.sin())
                .fold(0.0, f64::max)
        });
        let along_ray = levers(&|toward| ray(&polygon, toward));
        let inertia = |axis: [f64; 3]| {
            let row = body
                .inertia_kg_m2
                .map(|row| row[0] * axis[0] + row[1] * axis[1] + row[2] * axis[2]);
            (row[0] * axis[0] + row[1] * axis[1] + row[2] * axis[2]) / body.mass_kg
        };
        let block = |[right, left]: [f64; 2], inertia_m2: f64| -> Result<Block, Problem> {
            let base = right + left;
            // The moment of inertia is that about the left edge.
            let block = Block::uniform(2.0 * cg_m, base).map_err(|error| unfit(&error))?;
            let block = block
                .with_cg_offset(0.5 * (left - right))
                .map_err(|error| unfit(&error))?;
            let corner = left.hypot(cg_m);
            block
                .with_inertia_per_mass(inertia_m2 + corner * corner)
                .map_err(|error| unfit(&error))
        };
        let [x_axis, y_axis, _] = standing.pose().axes();
        let about_y = inertia(y_axis);
        let toward = barrier.toward_rad;
        let lever_m = cg_m * barrier.angle_rad().tan();
        let (sin, cos) = toward.sin_cos();
        let across = [0, 1, 2].map(|i| cos * y_axis[i] - sin * x_axis[i]);
        let symmetric = block([lever_m; 2], inertia(across))?;
        Ok(Self {
            projected: block(projected, about_y)?,
            along_ray: block(along_ray, about_y)?,
            symmetric,
            barrier,
            standing,
            scanned,
        })
    }

    /// Its facts in one line.
    pub(crate) fn words(&self) -> String {
        let pose = self.standing.pose();
        format!(
            "{} kg, {} m³, centre of gravity at {} m, tips at {}° towards {}°, barrier {} mm: {}°, {} points",
            number(self.scanned.body.mass_kg, 4),
            number(self.scanned.volume_m3, 4),
            number(pose.cg_height_m, 4),
            number(self.barrier.tilt_rad.to_degrees(), 3),
            number(self.barrier.toward_rad.to_degrees(), 3),
            number(1e3 * self.barrier.rise_m, 3),
            number(self.barrier.angle_rad().to_degrees(), 3),
            self.standing.points_m().len()
        )
    }
}

/// The points of the base, within 3 mm of the floor as it rests, from the centre of gravity \[m\].
fn polygon(scanned: &Solid, pose: &StablePose) -> Vec<[f64; 2]> {
    let axes = pose.axes();
    let along = |vertex: &[f64; 3], axis: &[f64; 3]| -> f64 {
        vertex.iter().zip(axis).map(|(x, of)| x * of).sum()
    };
    let vertices = scanned.body.hull.vertices_m().iter();
    let base = vertices.filter(|one| along(one, &pose.down) > pose.cg_height_m - 0.003);
    base.map(|one| [along(one, &axes[0]), along(one, &axes[1])])
        .collect()
}

/// How far the edge of the hull of these points is from the origin in a direction \[m\].
fn ray(points: &[[f64; 2]], toward_rad: f64) -> f64 {
    // Of all half planes that hold the points, the one whose edge the ray meets first.
    (0..3600)
        .filter_map(|step| {
            let normal = toward_rad + (f64::from(step) - 1800.0) * PI / 3600.0;
            let (sin, cos) = normal.sin_cos();
            let reach = points
                .iter()
                .map(|[x, y]| x * cos + y * sin)
                .fold(0.0, f64::max);
            let along = (normal - toward_rad).cos();
            (along > 1e-6).then(|| reach / along)
        })
        .fold(f64::INFINITY, f64::min)
}

/// A model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Model {
    Stands,
    Logistic,
    Projected,
    AlongRay,
    Symmetric,
    Hull,
    HullPrior,
}

impl Model {
    pub(crate) const ALL: [Self; 7] = [
        Self::Stands,
        Self::Logistic,
        Self::Projected,
        Self::AlongRay,
        Self::Symmetric,
        Self::Hull,
        Self::HullPrior,
    ];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Stands => "always-stands",
            Self::Logistic => "pgv-logistic",
            Self::Projected => "plane-projected",
            Self::AlongRay => "plane-along-ray",
            Self::Symmetric => "symmetric-barrier",
            Self::Hull => "hull",
            Self::HullPrior => "hull-prior",
        }
    }

    pub(crate) fn words(self) -> &'static str {
        match self {
            Self::Stands => "always \"stands\"",
            Self::Logistic => "logistic in PGV, each motion predicted by the others",
            Self::Projected => "plane block, levers of the projected base",
            Self::AlongRay => "plane block, levers along the ray",
            Self::Symmetric => "symmetric block of the energy barrier",
            Self::Hull => "three dimensions on the scanned hull, one history",
            Self::HullPrior => "the same, 20 histories over the prior",
        }
    }

    /// What it says of each test.
    pub(crate) fn says(self, rock: &Rock, tests: &[Test], fell: &[bool]) -> Result<Said, Problem> {
        match self {
            Self::Stands => Ok(Said::of(vec![0.0; tests.len()])),
            Self::Logistic => by_pgv(tests, fell).map(Said::of),
            Self::Projected => plane(&rock.projected, tests),
            Self::AlongRay => plane(&rock.along_ray, tests),
            Self::Symmetric => plane(&rock.symmetric, tests),
            Self::Hull => in_space(rock, tests, &[Point::ONE]),
            Self::HullPrior => in_space(rock, tests, &points()),
        }
    }
}

/// What a model says of each test.
pub(crate) struct Said {
    /// The probability that the rock overturns.
    pub(crate) probabilities: Vec<f64>,
    /// Histories that end in another pose, which count as falls, and that do not end.
    pub(crate) shifted: usize,
    pub(crate) unresolved: usize,
}

impl Said {
    fn of(probabilities: Vec<f64>) -> Self {
        Self {
            probabilities,
            shifted: 0,
            unresolved: 0,
        }
    }
}

/// The rock on its hull, at each of these points.
fn in_space(rock: &Rock, tests: &[Test], points: &[Point]) -> Result<Said, Problem> {
    let found: Result<Vec<Vec<HullOutcome>>, Problem> = tests
        .par_iter()
        .map(|test| {
            points
                .iter()
                .map(|point| point.follow(rock, test))
                .collect()
        })
        .collect();
    let found = found?;
    let share = |outcomes: &Vec<HullOutcome>| {
        let falls = outcomes.iter().filter(|one| one.falls()).count();
        falls as f64 / outcomes.len() as f64
    };
    let count = |is: fn(&HullOutcome) -> bool| found.iter().flatten().filter(|one| is(one)).count();
    Ok(Said {
        probabilities: found.iter().map(share).collect(),
        shifted: count(|one| matches!(one, HullOutcome::Shifted(_))),
        unresolved: count(|one| matches!(one, HullOutcome::Unresolved | HullOutcome::Unsettled)),
    })
}

/// A point of the prior.
struct Point {
    contact: Contact,
    yaw_rad: f64,
    scale_ratio: f64,
}

impl Point {
    /// Along +x of the scan, with the contacts that were fixed.
    const ONE: Self = Self {
        contact: Contact {
            friction_ratio: 0.6,
            damping_ratio: 0.2,
            sinking_m: 1e-4,
            rolling_ratio: 0.0,
        },
        yaw_rad: 0.0,
        scale_ratio: 1.0,
    };

    fn follow(&self, rock: &Rock, test: &Test) -> Result<HullOutcome, Problem> {
        let failed =
            |error: &dyn std::fmt::Display| Problem::value(error.to_string(), "check the test");
        let table = test
            .table
            .scaled(self.scale_ratio)
            .map_err(|error| failed(&error))?;
        let x = SpatialMotion {
            x: Some(&table),
            ..SpatialMotion::default()
        };
        let found = shake(&rock.standing, &self.contact, self.yaw_rad, &x, G0_M_S2);
        found
            .map(|found| found.outcome)
            .map_err(|error| failed(&error))
    }
}

/// Ten points of a Latin hypercube, each with both signs of the direction.
fn points() -> Vec<Point> {
    let mut random = ChaCha8Rng::seed_from_u64(0);
    let mut column = || {
        let mut cells: Vec<f64> = (0..POINTS)
            .map(|cell| (cell as f64 + random.random::<f64>()) / POINTS as f64)
            .collect();
        cells.shuffle(&mut random);
        cells
    };
    let [yaw, friction, damping, sinking, scale] = std::array::from_fn(|_| column());
    let even = |share: f64, (low, high): (f64, f64)| low + share * (high - low);
    let by_ratio = |share: f64, (low, high): (f64, f64)| low * (high / low).powf(share);
    (0..POINTS)
        .flat_map(|at| {
            [1.0, -1.0].map(|sign| Point {
                contact: Contact {
                    friction_ratio: even(friction[at], PRIOR.friction_ratio),
                    damping_ratio: by_ratio(damping[at], PRIOR.damping_ratio),
                    sinking_m: by_ratio(sinking[at], PRIOR.sinking_m),
                    rolling_ratio: 0.0,
                },
                yaw_rad: sign * even(yaw[at], PRIOR.yaw_rad),
                scale_ratio: even(scale[at], PRIOR.scale_ratio),
            })
        })
        .collect()
}

/// 1 where a plane block falls.
fn plane(block: &Block, tests: &[Test]) -> Result<Said, Problem> {
    let until = Until::Settled { at_most_s: 120.0 };
    let options = RockingOptions {
        until,
        ..RockingOptions::default()
    };
    let fell = |test: &Test| {
        let base = Base {
            horizontal: Some(&test.table),
            vertical: None,
        };
        let history = rock(block, base, &options);
        history
            .map(|history| f64::from(u8::from(history.outcome == Outcome::Overturned)))
            .map_err(|error| Problem::value(error.to_string(), "check the test"))
    };
    let said: Result<Vec<f64>, Problem> = tests.par_iter().map(fell).collect();
    said.map(Said::of)
}

/// The corner of the high-pass that the records of the table had before their ends were cut \[Hz\].
const LOW_CUT_HZ: f64 = 0.1;

/// The peak velocity of the table decides, as the tests under all other motions say. The records are filtered
/// again, because velocities drift after their ends were cut.
fn by_pgv(tests: &[Test], fell: &[bool]) -> Result<Vec<f64>, Problem> {
    let ln_pgv = |test: &Test| {
        let pass = Pass::High {
            low_cut_hz: LOW_CUT_HZ,
        };
        let table = filtered(&test.table, pass, 3);
        table
            .map(|table| measures(&table.motion).pgv_m_s.ln())
            .map_err(|error| Problem::value(error.to_string(), "check the test"))
    };
    let ln_pgv: Result<Vec<f64>, Problem> = tests.par_iter().map(ln_pgv).collect();
    let ln_pgv = ln_pgv?;
    let by_others = |(test, own): (&Test, &f64)| {
        let all = tests.iter().zip(&ln_pgv).zip(fell);
        let others = all.filter(|((other, _), _)| other.motion != test.motion);
        let known: Vec<(f64, bool)> = others.map(|((_, ln_pgv), fell)| (*ln_pgv, *fell)).collect();
        logistic(&known, *own)
    };
    Ok(tests.iter().zip(&ln_pgv).map(by_others).collect())
}
