//! Uplift and shock spectra over a grid of objects, chunk by chunk: of a million objects under a
//! thousand motions only one chunk is in memory at a time.

use std::ops::Range;
use std::time::Instant;

use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::cushion::Cushion;
use freestand::impact::{ImpactModel, Landing};
use freestand::motion::Motion;
use freestand::respond::{RigidPlane, Settings};
use freestand::rocking::{Base, FREE_FLIGHT, Outcome, Restitution, RockingError};
use freestand::sliding::{Sliding, SlidingOutcome};
use freestand::spectra::{Sensitivity, ShockCell, UpliftCell, uplift_sensitivity, uplift_spectrum};
use freestand::wall::{Contact, Walls};
use rayon::prelude::*;

use crate::cushion::{BOTTOMED, EdgeCushion};
use crate::doubt::SpectrumDoubt;
use crate::resolve::MAX_OBJECTS;
use crate::shape::{Sizes, squat};
use crate::sliding::{Surface, slide_under};
use crate::walls::{WallStiffness, acceleration_g, speed_m_s};
use freestand_input::problem::Problem;
use freestand_output::answer;
use freestand_output::answer::Answer;
use freestand_output::facts::Facts;
use freestand_output::parquet::ColumnType;

/// Block-steps of a chunk: seconds of work, after which a request to stop is noticed.
const CHUNK_STEPS: usize = 200_000_000;
/// Objects of a chunk for each thread, enough to fill its lanes and its caches.
const CHUNK_OBJECTS_PER_THREAD: usize = 2048;
/// The largest number of objects in a chunk, which keeps them and their rows within tens of
/// megabytes.
const MAX_CHUNK_OBJECTS: usize = 65_536;
/// Objects whose rows one thread writes at a time.
const ROWS_AT_A_TIME: usize = 512;
/// The outcome of an object whose history could not be calculated.
const FAILED: &str = "failed";

/// Uniform blocks: of every height and thickness, where thickness varies fastest, or one for each
/// pair of them.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    heights_m: Vec<f64>,
    thicknesses_m: Vec<f64>,
    is_paired: bool,
}

fn too_many(objects: impl std::fmt::Display) -> Problem {
    let hint = format!("give at most {MAX_OBJECTS} objects in one call");
    Problem::value(format!("{objects} objects are too many"), hint)
}

impl Grid {
    /// The grid; each of its objects is checked.
    ///
    /// # Errors
    /// More than [`MAX_OBJECTS`] objects, or one without a size.
    pub fn new(heights_m: Vec<f64>, thicknesses_m: Vec<f64>) -> Result<Self, Problem> {
        let (heights, thicknesses) = (heights_m.len(), thicknesses_m.len());
        if heights.saturating_mul(thicknesses) > MAX_OBJECTS {
            return Err(too_many(format!("{heights} × {thicknesses}")));
        }
        Self {
            heights_m,
            thicknesses_m,
            is_paired: false,
        }
        .checked()
    }

    /// One object for each height and the thickness at the same place; each object is checked.
    ///
    /// # Errors
    /// Lists of different lengths, more than [`MAX_OBJECTS`] objects, or one without a size.
    pub fn pairs(heights_m: Vec<f64>, thicknesses_m: Vec<f64>) -> Result<Self, Problem> {
        let (heights, thicknesses) = (heights_m.len(), thicknesses_m.len());
        if heights != thicknesses {
            let message = format!("{heights} heights and {thicknesses} thicknesses are not pairs");
            return Err(Problem::value(
                message,
                "give as many `heights` as `thicknesses`",
            ));
        }
        if heights > MAX_OBJECTS {
            return Err(too_many(heights));
        }
        Self {
            heights_m,
            thicknesses_m,
            is_paired: true,
        }
        .checked()
    }

    fn checked(self) -> Result<Self, Problem> {
        for (height_m, thickness_m) in self.sizes(0..self.objects()) {
            Block::uniform(height_m, thickness_m).map_err(|error| {
                Problem::value(error.to_string(), "check `heights` and `thicknesses`")
            })?;
        }
        Ok(self)
    }

    /// The number of objects.
    pub fn objects(&self) -> usize {
        if self.is_paired {
            self.heights_m.len()
        } else {
            self.heights_m.len() * self.thicknesses_m.len()
        }
    }

    /// Some of its objects, in order.
    pub fn blocks(&self, range: Range<usize>) -> impl Iterator<Item = Block> + '_ {
        // `new` has made every object once, so none fails here.
        self.sizes(range)
            .filter_map(|(height_m, thickness_m)| Block::uniform(height_m, thickness_m).ok())
    }

    fn sizes(&self, range: Range<usize>) -> impl Iterator<Item = (f64, f64)> + '_ {
        let columns = if self.is_paired {
            1
        } else {
            self.thicknesses_m.len().max(1)
        };
        let thickness = move |index: usize| {
            if self.is_paired {
                index
            } else {
                index % columns
            }
        };
        range.map(move |index| {
            (
                self.heights_m[index / columns],
                self.thicknesses_m[thickness(index)],
            )
        })
    }
}

/// What is calculated for every object.
#[derive(Debug, Clone)]
pub struct SpectrumRequest {
    /// The objects.
    pub grid: Grid,
    /// What remains of ω in an impact.
    pub restitution: Restitution,
    /// What stands beside each object.
    pub walls: Walls,
    /// Model, accuracy, end.
    pub settings: Settings,
    /// Mass \[kg\] and the cushion under one edge, for the shock.
    pub cushion: Option<(f64, EdgeCushion)>,
    /// Mass and stiffness for the shock on a wall.
    pub wall: WallStiffness,
    /// Whether to report by how much each object amplifies an error of the motion.
    pub sensitivity: bool,
    /// For objects that slide, or stand on casters: what is under them.
    pub surface: Option<Surface>,
}

impl SpectrumRequest {
    /// An object that rocks on a rigid base.
    pub fn standing(&self, block: Block) -> RigidPlane {
        RigidPlane::along_x(block, self.restitution, self.walls)
    }

    /// Whether every object slides or rolls: nothing then reads the restitution and the model of rocking.
    pub fn none_rocks(&self) -> bool {
        let carried = |surface: &Surface| {
            self.grid
                .blocks(0..self.grid.objects())
                .all(|block| surface.carries(&block) == Ok(true))
        };
        self.surface.as_ref().is_some_and(carried)
    }

    /// What may make the results wrong, which `tallies` sum up.
    pub fn doubts(&self, tallies: &[SpectrumTally]) -> Vec<SpectrumDoubt> {
        let objects = self.grid.objects();
        let squat = squat(objects, self.grid.blocks(0..objects));
        let mut doubts: Vec<SpectrumDoubt> = squat.map(SpectrumDoubt::Squat).into_iter().collect();
        let mut sizes = self.grid.blocks(0..objects);
        let first = sizes.find_map(|block| Sizes::of(&block).doubts().into_iter().next());
        doubts.extend(first.map(SpectrumDoubt::Size));
        if let Some((mass_kg, edge)) = &self.cushion {
            let of_stiffness = edge.stiffness_doubts(*mass_kg);
            doubts.extend(of_stiffness.into_iter().map(SpectrumDoubt::Validity));
            let deepest_m = tallies
                .iter()
                .filter_map(|tally| tally.largest_compression_m)
                .reduce(f64::max);
            let beyond = deepest_m.into_iter();
            let beyond = beyond.flat_map(|deepest_m| edge.compression_doubts(deepest_m));
            doubts.extend(beyond.map(SpectrumDoubt::OfDeepestLanding));
        }
        let sum = |count: fn(&SpectrumTally) -> usize| tallies.iter().map(count).sum::<usize>();
        let (total, failed, sensitive) = (
            sum(|tally| tally.objects),
            sum(|tally| tally.failed),
            sum(|tally| tally.sensitive),
        );
        if failed > 0 {
            doubts.push(SpectrumDoubt::Failed { failed, total });
        }
        if sensitive > 0 {
            doubts.push(SpectrumDoubt::Sensitive { sensitive, total });
        }
        doubts
    }
}

/// A motion of the base.
#[derive(Debug, Clone, PartialEq)]
pub struct SpectrumMotion {
    /// Its name in the rows.
    pub name: String,
    /// Horizontal acceleration.
    pub horizontal: Motion,
    /// Vertical acceleration, of the same step and length.
    pub vertical: Option<Motion>,
}

answer! {
    /// Time in the solver alone, and its work.
    #[derive(Copy, Default)]
    pub struct SpectrumTiming {
        /// For the spectrum.
        solve_s: f64,
        /// Objects × intervals of their motions, including skipped ones.
        block_steps: u64,
        sensitivity: Option<SensitivityTiming> = flat,
    }

    /// Time for the sensitivities.
    #[derive(Copy, Default)]
    pub struct SensitivityTiming {
        /// For the spectrum under the changed motion.
        sensitivity_s: f64,
    }

    /// One object under a motion. Values are missing if there is no cushion, the object overturns or the history
    /// failed.
    pub struct SpectrumRow {
        /// The motion.
        motion: String,
        /// Height.
        height_m: f64,
        /// Thickness.
        thickness_m: f64,
        /// How the history ended.
        outcome: &'static str,
        /// Largest rotation.
        peak_rotation_rad: Option<f64>,
        /// Impacts on the floor.
        impact_count: Option<usize>,
        /// Of the edge that rises.
        uplift_m: Option<f64>,
        /// Of the centre of gravity.
        cg_rise_m: Option<f64>,
        /// Shock from the uplift.
        edge_acceleration_g: Option<f64>,
        /// Shock from the impact velocity.
        edge_acceleration_impact_velocity_g: Option<f64>,
        /// Shock at the largest uplift without overturning.
        ceiling_g: Option<f64>,
        walls: Option<AtWalls> = flat,
        sensitivity: Option<SensitivityCells> = flat,
        slide: Option<SlideCells> = flat,
        /// Why there is no result.
        reason: Option<String>,
    }

    /// What an object does at its walls.
    pub struct AtWalls {
        /// Fastest impact on a wall.
        wall_speed_max_m_s: Option<f64>,
        shock: Option<WallShock> = flat,
    }

    /// The shock on a wall of known stiffness.
    pub struct WallShock {
        /// Shock of the fastest impact on a wall.
        wall_acceleration_g: Option<f64>,
    }

    /// How strongly an object amplifies an error of the motion.
    pub struct SensitivityCells {
        /// Change of the peak rotation, divided by that of the motion.
        sensitivity_ratio: Option<f64>,
        /// Whether an error of the motion makes the result uncertain.
        sensitive: Option<bool>,
    }

    /// How an object slides or rolls.
    pub struct SlideCells {
        /// Largest slide.
        slide_peak_m: Option<f64>,
        /// Largest speed over the floor.
        slide_speed_max_m_s: Option<f64>,
        /// When it reaches the end of its clearance.
        clearance_time_s: Option<f64>,
        /// Its speed then.
        clearance_speed_m_s: Option<f64>,
    }
}

/// Some objects under one motion, solved.
#[derive(Debug)]
pub struct SpectrumChunk<'a> {
    /// Index of the motion.
    pub motion: usize,
    name: &'a str,
    walls: Walls,
    wall: WallStiffness,
    cushion: Option<(f64, &'a Cushion)>,
    blocks: Vec<Block>,
    cells: Vec<Cell>,
    sensitivities: Option<Vec<Sensitivity>>,
    slide: Option<Result<Sliding, Problem>>,
}

/// What an object of a chunk does.
#[derive(Debug)]
enum Cell {
    Rocks(Result<UpliftCell, RockingError>),
    /// As all others that slide: the slide does not depend on the size.
    Slides,
    /// It would rock and slide at once.
    Refused(Problem),
}

impl Cell {
    fn rocked(&self) -> Option<&UpliftCell> {
        if let Self::Rocks(Ok(cell)) = self {
            Some(cell)
        } else {
            None
        }
    }
}

impl SpectrumChunk<'_> {
    /// The number of rows.
    pub fn objects(&self) -> usize {
        self.blocks.len()
    }

    /// The shock of an object; `None` without a cushion, or where the history failed.
    fn shock(&self, index: usize) -> Option<ShockCell> {
        let (mass_kg, cushion) = self.cushion?;
        Some(
            self.cells[index]
                .rocked()?
                .shock(mass_kg, cushion, ImpactModel::Paper, G0_M_S2),
        )
    }

    /// Where an object touches the walls; a wall that cannot be used has made its history fail.
    fn contacts(&self, block: &Block) -> [Option<Contact>; 2] {
        self.walls.contacts(block).unwrap_or_default()
    }

    /// One object under the motion. Values are missing if there is no cushion, the object overturns
    /// or the history failed.
    pub fn row(&self, index: usize) -> Facts<'_> {
        let (block, cell) = (&self.blocks[index], &self.cells[index]);
        let rocking = cell.rocked().map(|cell| &cell.rocking);
        let slide = self.slide.as_ref().filter(|_| matches!(cell, Cell::Slides));
        let slid = slide.and_then(|slide| slide.as_ref().ok());
        let outcome = match cell {
            Cell::Rocks(Ok(cell)) => cell.rocking.outcome.name(),
            Cell::Rocks(Err(RockingError::FreeFlight { .. })) => FREE_FLIGHT,
            Cell::Slides => slid.map_or(FAILED, |slid| slid.outcome.name()),
            Cell::Rocks(Err(_)) | Cell::Refused(_) => FAILED,
        };
        // It does not rock: zero, which is not the same as missing.
        let level = slid
            .filter(|slid| slid.outcome != SlidingOutcome::FreeFlight)
            .map(|_| 0.0);
        let reason = match cell {
            Cell::Rocks(Ok(_)) => None,
            Cell::Rocks(Err(error)) => Some(error.to_string()),
            Cell::Slides => slide
                .and_then(|slide| slide.as_ref().err())
                .map(|problem| problem.message.clone()),
            Cell::Refused(problem) => Some(problem.message.clone()),
        };
        let shock = self.shock(index);
        let bottomed = shock
            .filter(ShockCell::is_beyond_numbers)
            .map(|_| BOTTOMED.to_owned());
        let shock = shock.filter(|shock| !shock.is_beyond_numbers());
        let walls = (!self.walls.is_none()).then(|| {
            let contacts = self.contacts(block);
            let sides = rocking.map(|found| found.sides);
            AtWalls {
                wall_speed_max_m_s: sides.and_then(|sides| speed_m_s(block, contacts, sides)),
                shock: self.wall.stiffness_n_m.map(|_| WallShock {
                    wall_acceleration_g: sides
                        .and_then(|sides| acceleration_g(block, contacts, sides, self.wall)),
                }),
            }
        });
        let sensitivity = self.sensitivities.as_ref().map(|all| {
            let Sensitivity { ratio, sensitive } = all[index];
            let followed = rocking.is_some() && bottomed.is_none();
            SensitivityCells {
                sensitivity_ratio: ratio,
                sensitive: followed.then_some(sensitive),
            }
        });
        let contact = slid.and_then(|slid| slid.contact);
        let slide = self.slide.as_ref().map(|_| SlideCells {
            slide_peak_m: slid.map(|slid| slid.peak_m),
            slide_speed_max_m_s: slid.map(|slid| slid.speed_max_m_s),
            clearance_time_s: contact.map(|(time_s, _)| time_s),
            clearance_speed_m_s: contact.map(|(_, velocity_m_s)| velocity_m_s),
        });
        SpectrumRow {
            motion: self.name.to_owned(),
            height_m: block.height_m(),
            thickness_m: block.thickness_m(),
            outcome,
            peak_rotation_rad: rocking.map(|rocking| rocking.peak_rotation_rad).or(level),
            impact_count: rocking
                .map(|rocking| rocking.impact_count)
                .or(level.map(|_| 0)),
            uplift_m: rocking.map(|rocking| rocking.uplift_m).or(level),
            cg_rise_m: rocking.map(|rocking| rocking.cg_rise_m).or(level),
            edge_acceleration_g: shock.and_then(|shock| shock.edge_acceleration_g),
            edge_acceleration_impact_velocity_g: shock
                .and_then(|shock| shock.edge_acceleration_impact_velocity_g),
            ceiling_g: shock.map(|shock| shock.ceiling_g),
            walls,
            sensitivity,
            slide,
            reason: reason.or(bottomed),
        }
        .facts()
    }

    /// All rows.
    pub fn rows(&self) -> impl Iterator<Item = Facts<'_>> {
        (0..self.objects()).map(|index| self.row(index))
    }

    /// Adds its objects to the tally of the motion.
    pub fn add_to(&self, tally: &mut SpectrumTally) {
        let larger =
            |most: Option<f64>, value: Option<f64>| most.into_iter().chain(value).reduce(f64::max);
        tally.largest_compression_m =
            larger(tally.largest_compression_m, self.largest_compression_m());
        for (index, cell) in self.cells.iter().enumerate() {
            let shock = self.shock(index);
            let bottomed = shock.as_ref().is_some_and(ShockCell::is_beyond_numbers);
            tally.objects += 1;
            let slid = self
                .slide
                .as_ref()
                .filter(|_| matches!(cell, Cell::Slides))
                .and_then(|slide| slide.as_ref().ok());
            let is_whole = match cell {
                Cell::Rocks(cell) => cell.is_ok(),
                Cell::Slides => slid.is_some_and(|slid| slid.outcome != SlidingOutcome::FreeFlight),
                Cell::Refused(_) => false,
            };
            tally.failed += usize::from(!is_whole || bottomed);
            tally.slid +=
                usize::from(slid.is_some_and(|slid| slid.outcome == SlidingOutcome::Slid));
            tally.largest_slide_m =
                larger(tally.largest_slide_m, slid.map(|slid| slid.peak_m.abs()));
            tally.sensitive += usize::from(
                self.sensitivities
                    .as_ref()
                    .is_some_and(|all| all[index].sensitive),
            );
            let Some(UpliftCell { rocking, .. }) = cell.rocked() else {
                continue;
            };
            tally.rocked += usize::from(rocking.outcome == Outcome::Rocked);
            tally.leaned += usize::from(rocking.outcome == Outcome::Leaned);
            tally.overturned += usize::from(rocking.outcome == Outcome::Overturned);
            if !rocking.outcome.has_fallen() {
                let edge_g = shock
                    .filter(|_| !bottomed)
                    .and_then(|shock| shock.edge_acceleration_g);
                tally.largest_uplift_m = larger(tally.largest_uplift_m, Some(rocking.uplift_m));
                tally.largest_edge_acceleration_g =
                    larger(tally.largest_edge_acceleration_g, edge_g);
            }
        }
    }

    /// The compression in the landing with the most energy, by the largest rise, of the objects
    /// that rocked without overturning.
    fn largest_compression_m(&self) -> Option<f64> {
        let (mass_kg, cushion) = self.cushion?;
        let rocked = self
            .cells
            .iter()
            .filter_map(Cell::rocked)
            .filter(|cell| cell.rocking.outcome == Outcome::Rocked);
        let energy_of = |cell: &UpliftCell| {
            let landing = Landing::rocking(&cell.block, ImpactModel::Paper);
            landing.effective_mass_ratio
                * landing
                    .edge_velocity_m_s(cell.rocking.cg_rise_m, G0_M_S2)
                    .powi(2)
        };
        let cell = rocked.max_by(|a, b| energy_of(a).total_cmp(&energy_of(b)))?;
        let landing = Landing::rocking(&cell.block, ImpactModel::Paper);
        Some(
            landing
                .impact(mass_kg, cushion, cell.rocking.cg_rise_m, G0_M_S2)
                .compression_m,
        )
    }

    /// Applies `words` to a few rows at a time, on all threads; the results are in the order of the
    /// rows.
    pub fn pieces<T: Send>(
        &self,
        words: impl Fn(&mut dyn Iterator<Item = Facts<'_>>) -> T + Sync,
    ) -> Vec<T> {
        let starts: Vec<usize> = (0..self.objects()).step_by(ROWS_AT_A_TIME).collect();
        let piece = |&start: &usize| {
            words(
                &mut (start..(start + ROWS_AT_A_TIME).min(self.objects()))
                    .map(|index| self.row(index)),
            )
        };
        starts.par_iter().map(piece).collect()
    }
}

/// What a column of the rows holds; its name has the unit.
pub fn column_type(name: &str) -> ColumnType {
    match name {
        "motion" | "outcome" | "reason" => ColumnType::Text,
        "impact_count" => ColumnType::Count,
        "sensitive" => ColumnType::Flag,
        _ => ColumnType::Number,
    }
}

/// The number of objects in a chunk under a motion of so many intervals, on the current thread
/// pool.
pub fn chunk_objects(intervals: usize) -> usize {
    let least = CHUNK_OBJECTS_PER_THREAD.saturating_mul(rayon::current_num_threads());
    (CHUNK_STEPS / intervals.max(1))
        .max(least)
        .min(MAX_CHUNK_OBJECTS)
}

/// Calculates every object of the grid under every motion, in the order motion, height, thickness,
/// and calls `each` for every chunk. `chunk` gives its size for a number of intervals (see
/// [`chunk_objects`]); the rows depend neither on it nor on the number of threads. The first error
/// of `each` ends the work.
///
/// # Errors
/// What `each` returns.
pub fn spectrum<E>(
    request: &SpectrumRequest,
    motions: &[SpectrumMotion],
    chunk: impl Fn(usize) -> usize,
    mut each: impl FnMut(&SpectrumChunk) -> Result<(), E>,
) -> Result<SpectrumTiming, E> {
    let mut timing = SpectrumTiming {
        sensitivity: request.sensitivity.then(SensitivityTiming::default),
        ..SpectrumTiming::default()
    };
    let objects = request.grid.objects();
    for (index, motion) in motions.iter().enumerate() {
        let base = Base {
            horizontal: Some(&motion.horizontal),
            vertical: motion.vertical.as_ref(),
        };
        let intervals = motion.horizontal.accel_m_s2().len() - 1;
        let size = chunk(intervals).max(1);
        let began = Instant::now();
        // The slide is the same for all.
        let first = request.grid.blocks(0..objects.min(1)).next();
        let slide = request.surface.zip(first);
        let slide = slide.map(|(surface, block)| slide_under(&surface, block, base));
        timing.solve_s += began.elapsed().as_secs_f64();
        timing.block_steps += slide.iter().len() as u64 * intervals as u64;
        for start in (0..objects).step_by(size) {
            let blocks: Vec<Block> = request
                .grid
                .blocks(start..(start + size).min(objects))
                .collect();
            let began = Instant::now();
            let carried = |block: &Block| {
                request
                    .surface
                    .map_or(Ok(false), |surface| surface.carries(block))
            };
            let rocking: Vec<RigidPlane> = blocks
                .iter()
                .filter(|block| matches!(carried(block), Ok(false)))
                .map(|block| request.standing(*block))
                .collect();
            let mut solved = uplift_spectrum(&rocking, base, &request.settings).into_iter();
            timing.solve_s += began.elapsed().as_secs_f64();
            timing.block_steps += rocking.len() as u64 * intervals as u64;
            let sensitivities = timing.sensitivity.as_mut().map(|timing| {
                let began = Instant::now();
                let sensitivities =
                    uplift_sensitivity(&rocking, solved.as_slice(), base, &request.settings);
                timing.sensitivity_s += began.elapsed().as_secs_f64();
                sensitivities
            });
            let cell = |block: &Block| match carried(block) {
                Ok(true) => Some(Cell::Slides),
                Ok(false) => solved.next().map(Cell::Rocks),
                Err(problem) => Some(Cell::Refused(problem)),
            };
            let cells = blocks.iter().filter_map(cell).collect();
            let slide = slide.clone();
            let name = motion.name.as_str();
            let cushion = request
                .cushion
                .as_ref()
                .map(|(mass_kg, edge)| (*mass_kg, &edge.cushion));
            let (walls, wall) = (request.walls, request.wall);
            each(&SpectrumChunk {
                motion: index,
                name,
                walls,
                wall,
                cushion,
                blocks,
                cells,
                sensitivities,
                slide,
            })?;
        }
    }
    Ok(timing)
}

/// The results of all objects under one motion.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[expect(
    missing_docs,
    reason = "the names say what the fields are, in SI units"
)]
pub struct SpectrumTally {
    pub objects: usize,
    pub rocked: usize,
    /// Past their balance points, on a wall.
    pub leaned: usize,
    pub overturned: usize,
    pub failed: usize,
    pub sensitive: usize,
    pub slid: usize,
    /// By magnitude.
    pub largest_slide_m: Option<f64>,
    /// Of the objects that do not overturn.
    pub largest_uplift_m: Option<f64>,
    /// Of the objects that do not overturn, from the uplift.
    pub largest_edge_acceleration_g: Option<f64>,
    /// Of the cushion, by the objects that do not overturn.
    pub largest_compression_m: Option<f64>,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cushion;
    use freestand::rocking::Until;
    use freestand_output::facts::csv_rows;

    fn request() -> SpectrumRequest {
        let heights_m: Vec<f64> = (0..23).map(|i| 0.4 + 0.15 * f64::from(i)).collect();
        let thicknesses_m: Vec<f64> = (0..11).map(|i| 0.1 + 0.07 * f64::from(i)).collect();
        SpectrumRequest {
            grid: Grid::new(heights_m, thicknesses_m).unwrap(),
            restitution: Restitution::Housner,
            walls: Walls::NONE,
            settings: Settings {
                until: Until::EndOfMotion,
                ..Settings::default()
            },
            cushion: Some((
                150.0,
                cushion::resolve(&cushion::spring(4.38e6), None).unwrap(),
            )),
            wall: WallStiffness::default(),
            sensitivity: true,
            surface: None,
        }
    }

    /// A swelling wave, and another with a vertical motion.
    fn motions() -> Vec<SpectrumMotion> {
        let wave = |frequency_hz: f64, peak: f64| {
            let sample = |i: i32| {
                let t = f64::from(i) * 0.01;
                peak * (-0.5 * (t - 3.0) * (t - 3.0)).exp()
                    * (std::f64::consts::TAU * frequency_hz * t).sin()
            };
            Motion::new(0.01, (0..800).map(sample).collect()).unwrap()
        };
        vec![
            SpectrumMotion {
                name: "one".into(),
                horizontal: wave(0.9, 4.0),
                vertical: None,
            },
            SpectrumMotion {
                name: "two".into(),
                horizontal: wave(1.6, 6.0),
                vertical: Some(wave(3.1, 3.0)),
            },
        ]
    }

    fn table(chunk: usize, threads: usize) -> String {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        let mut text = Vec::new();
        let work = || {
            spectrum::<Problem>(
                &request(),
                &motions(),
                |_| chunk,
                |chunk| {
                    let pieces = chunk.pieces(|rows| csv_rows(rows).unwrap());
                    text.extend(pieces.concat());
                    Ok(())
                },
            )
        };
        pool.install(work).unwrap();
        String::from_utf8(text).unwrap()
    }

    /// Same bytes on any number of threads and in chunks of any size, even of one object: lanes are
    /// independent.
    #[test]
    fn rows_depend_neither_on_threads_nor_on_chunks() {
        let whole = table(usize::MAX, 1);
        assert_eq!(whole.lines().count(), 2 * 23 * 11);
        for outcome in ["no-uplift", "rocked", "overturned"] {
            assert!(whole.contains(outcome), "{outcome}");
        }
        assert!(whole.lines().next().unwrap().starts_with("one,0.4,0.1,"));
        for (chunk, threads) in [(usize::MAX, 2), (1, 1), (7, 2), (100, 2), (250, 1)] {
            assert_eq!(
                table(chunk, threads),
                whole,
                "chunks of {chunk} on {threads} threads"
            );
        }
    }

    /// A pad that bottoms after 0.1 mm cannot hold a rocking cabinet: a reason in place of a
    /// number.
    #[test]
    fn a_cushion_that_bottoms_gives_a_reason_and_no_number() {
        let words = [
            ("law", "tangent"),
            ("stiffness", "100 N/mm"),
            ("bottoming", "0.1 mm"),
        ]
        .into_iter()
        .collect();
        let request = SpectrumRequest {
            cushion: Some((150.0, cushion::resolve(&words, None).unwrap())),
            ..request()
        };
        let mut rocked = 0;
        let seen = spectrum::<Problem>(
            &request,
            &motions(),
            |_| usize::MAX,
            |chunk| {
                let is_up = |row: &Facts| {
                    row.text("outcome") == Some("rocked") && row.number("uplift_m") > Some(1e-3)
                };
                for row in chunk.rows().filter(is_up) {
                    rocked += 1;
                    assert_eq!(
                        (row.number("edge_acceleration_g"), row.text("reason")),
                        (None, Some(BOTTOMED))
                    );
                }
                Ok(())
            },
        );
        assert!(seen.is_ok() && rocked > 10, "{rocked}");
    }

    #[test]
    fn chunks_are_bounded() {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(2)
            .build()
            .unwrap();
        let size = |intervals| pool.install(|| chunk_objects(intervals));
        assert_eq!(
            [0, 1000, 10_000, 10_000_000].map(size),
            [65_536, 65_536, 20_000, 4096]
        );
    }

    #[test]
    fn pairs_are_the_diagonal_of_their_grid() {
        let (heights_m, thicknesses_m) = (vec![1.0, 2.0, 3.0], vec![0.3, 0.4, 0.5]);
        let pairs = Grid::pairs(heights_m.clone(), thicknesses_m.clone()).unwrap();
        let grid = Grid::new(heights_m, thicknesses_m).unwrap();
        let diagonal: Vec<Block> = grid.blocks(0..9).step_by(4).collect();
        assert_eq!(
            pairs.blocks(0..pairs.objects()).collect::<Vec<_>>(),
            diagonal
        );
        assert!(Grid::pairs(vec![1.0], vec![0.3, 0.4]).is_err());
    }

    #[test]
    fn an_empty_grid_and_one_too_large_are_refused() {
        assert!(Grid::new(vec![1.0], vec![0.0]).is_err());
        assert!(Grid::new(vec![1.0; 1001], vec![0.2; 1000]).is_err());
        assert_eq!(
            Grid::new(vec![1.0; 1000], vec![0.2; 1000])
                .unwrap()
                .objects(),
            1_000_000
        );
    }
}
