//! Uplift and shock spectra over a grid of objects, chunk by chunk: of a million objects under a thousand motions only
//! one chunk is ever in memory.

use std::ops::Range;
use std::time::Instant;

use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::cushion::Cushion;
use freestand::impact::{Impact, ImpactModel, Landing};
use freestand::motion::Motion;
use freestand::rocking::{Base, Outcome, RockingError, RockingOptions};
use freestand::spectra::{Sensitivity, ShockCell, UpliftCell, uplift_sensitivity, uplift_spectrum};
use rayon::prelude::*;
use serde::Serialize;

use crate::cushion::{BOTTOMED, EdgeCushion};
use crate::resolve::MAX_OBJECTS;
use freestand_input::problem::{Problem, ProblemKind};
use freestand_output::rows::Field;

/// Block-steps of a chunk: seconds of work, between two questions whether to go on.
const CHUNK_STEPS: usize = 200_000_000;
/// Objects of a chunk for each thread, so that its lanes and its caches are full.
const CHUNK_OBJECTS_PER_THREAD: usize = 2048;
/// Most objects of a chunk: they and their rows stay within tens of megabytes.
const CHUNK_OBJECTS: usize = 65_536;
/// Objects whose rows are put into words at a time, on one thread.
const ROWS_AT_A_TIME: usize = 512;

/// Uniform blocks of every height and thickness, thickness by thickness within each height.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    heights_m: Vec<f64>,
    thicknesses_m: Vec<f64>,
}

impl Grid {
    /// The grid; each of its objects is checked.
    ///
    /// # Errors
    /// More than [`MAX_OBJECTS`] objects, or one without a size.
    pub fn new(heights_m: Vec<f64>, thicknesses_m: Vec<f64>) -> Result<Self, Problem> {
        if heights_m.len().saturating_mul(thicknesses_m.len()) > MAX_OBJECTS {
            let message = format!("{} × {} objects are too many", heights_m.len(), thicknesses_m.len());
            return Err(Problem::new(ProblemKind::Value, message).hint(format!("at most {MAX_OBJECTS} in one call")));
        }
        let grid = Self { heights_m, thicknesses_m };
        for (height_m, thickness_m) in grid.sizes(0..grid.objects()) {
            Block::uniform(height_m, thickness_m).map_err(|error| {
                Problem::new(ProblemKind::Value, error.to_string()).hint("check --heights and --thicknesses")
            })?;
        }
        Ok(grid)
    }

    /// How many objects it has.
    pub fn objects(&self) -> usize {
        self.heights_m.len() * self.thicknesses_m.len()
    }

    /// Some of its objects, in order.
    pub fn blocks(&self, range: Range<usize>) -> impl Iterator<Item = Block> + '_ {
        // Every object was made once in `new`.
        self.sizes(range).filter_map(|(height_m, thickness_m)| Block::uniform(height_m, thickness_m).ok())
    }

    fn sizes(&self, range: Range<usize>) -> impl Iterator<Item = (f64, f64)> + '_ {
        let columns = self.thicknesses_m.len().max(1);
        range.map(move |index| (self.heights_m[index / columns], self.thicknesses_m[index % columns]))
    }
}

/// What is asked of every object.
#[derive(Debug, Clone)]
pub struct SpectrumRequest {
    /// The objects.
    pub grid: Grid,
    /// Model, restitution, accuracy.
    pub options: RockingOptions,
    /// Mass \[kg\] and what stands under one edge, for the shock.
    pub cushion: Option<(f64, EdgeCushion)>,
    /// Whether to tell how far each object amplifies an error of the motion.
    pub sensitivity: bool,
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

/// Time in the solver alone, and its work.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct SpectrumTiming {
    /// For the spectrum \[s\].
    pub solve_s: f64,
    /// Objects × intervals of their records, whether or not they were skipped.
    pub block_steps: u64,
    /// For the spectrum under the changed motion \[s\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sensitivity_s: Option<f64>,
}

/// One object under one motion. What is `None` is missing: no cushion, an overturned object, a history that could not be
/// followed.
#[derive(Debug, Clone, PartialEq)]
#[expect(missing_docs, reason = "the names are the documentation: SI units as they say")]
pub struct SpectrumRow<'a> {
    pub motion: &'a str,
    pub height_m: f64,
    pub thickness_m: f64,
    pub outcome: &'static str,
    pub peak_rotation_rad: Option<f64>,
    pub impact_count: Option<usize>,
    pub uplift_m: Option<f64>,
    pub cg_rise_m: Option<f64>,
    pub edge_acceleration_g: Option<f64>,
    pub edge_acceleration_impact_velocity_g: Option<f64>,
    pub ceiling_g: Option<f64>,
    /// `None`: not asked for, no columns.
    pub sensitivity: Option<Sensitivity>,
    pub reason: Option<String>,
}

impl<'a> SpectrumRow<'a> {
    /// Name and value of every column.
    pub fn fields(self) -> Vec<(&'static str, Field<'a>)> {
        let mut fields = vec![
            ("motion", Field::Text(self.motion.into())),
            ("height_m", Field::Number(self.height_m)),
            ("thickness_m", Field::Number(self.thickness_m)),
            ("outcome", Field::Text(self.outcome.into())),
            ("peak_rotation_rad", self.peak_rotation_rad.into()),
            ("impact_count", self.impact_count.map_or(Field::Missing, Field::Count)),
            ("uplift_m", self.uplift_m.into()),
            ("cg_rise_m", self.cg_rise_m.into()),
            ("edge_acceleration_g", self.edge_acceleration_g.into()),
            ("edge_acceleration_impact_velocity_g", self.edge_acceleration_impact_velocity_g.into()),
            ("ceiling_g", self.ceiling_g.into()),
        ];
        if let Some(sensitivity) = self.sensitivity {
            let followed = self.reason.is_none();
            fields.push(("sensitivity_ratio", sensitivity.ratio.into()));
            fields.push(("sensitive", if followed { Field::Flag(sensitivity.sensitive) } else { Field::Missing }));
        }
        fields.push(("reason", self.reason.map_or(Field::Missing, |reason| Field::Text(reason.into()))));
        fields
    }
}

/// Some objects under one motion, solved.
#[derive(Debug)]
pub struct SpectrumChunk<'a> {
    /// Index of the motion.
    pub motion: usize,
    name: &'a str,
    cushion: Option<(f64, &'a Cushion)>,
    blocks: Vec<Block>,
    cells: Vec<Result<UpliftCell, RockingError>>,
    sensitivities: Option<Vec<Sensitivity>>,
}

impl SpectrumChunk<'_> {
    /// How many rows it has.
    pub fn objects(&self) -> usize {
        self.blocks.len()
    }

    /// One row.
    pub fn row(&self, index: usize) -> SpectrumRow<'_> {
        let (block, cell) = (&self.blocks[index], &self.cells[index]);
        let done = cell.as_ref().ok();
        let shock = done
            .zip(self.cushion)
            .map(|(cell, (mass, cushion))| cell.shock(mass, cushion, ImpactModel::Paper, G0_M_S2));
        let rocking = done.map(|cell| &cell.rocking);
        let bottomed = shock.filter(ShockCell::is_beyond_numbers).map(|_| BOTTOMED.to_owned());
        let shock = shock.filter(|shock| !shock.is_beyond_numbers());
        SpectrumRow {
            motion: self.name,
            height_m: block.height_m(),
            thickness_m: block.thickness_m(),
            outcome: rocking.map_or("failed", |rocking| rocking.outcome.name()),
            peak_rotation_rad: rocking.map(|rocking| rocking.peak_rotation_rad),
            impact_count: rocking.map(|rocking| rocking.impact_count),
            uplift_m: rocking.map(|rocking| rocking.uplift_m),
            cg_rise_m: rocking.map(|rocking| rocking.cg_rise_m),
            edge_acceleration_g: shock.and_then(|shock| shock.edge_acceleration_g),
            edge_acceleration_impact_velocity_g: shock.and_then(|shock| shock.edge_acceleration_impact_velocity_g),
            ceiling_g: shock.map(|shock| shock.ceiling_g),
            sensitivity: self.sensitivities.as_ref().map(|all| all[index]),
            reason: cell.as_ref().err().map(ToString::to_string).or(bottomed),
        }
    }

    /// All rows.
    pub fn rows(&self) -> impl Iterator<Item = SpectrumRow<'_>> {
        (0..self.objects()).map(|index| self.row(index))
    }

    /// The landing of most energy among the objects that rocked and stayed upright, by their largest rise: the one that
    /// compresses the cushion most.
    pub fn deepest_impact(&self) -> Option<Impact> {
        let (mass_kg, cushion) = self.cushion?;
        let rocked = self.cells.iter().flatten().filter(|cell| cell.rocking.outcome == Outcome::Rocked);
        let energy_of = |cell: &UpliftCell| {
            let landing = Landing::rocking(&cell.block, ImpactModel::Paper);
            landing.effective_mass_ratio * landing.edge_velocity_m_s(cell.rocking.cg_rise_m, G0_M_S2).powi(2)
        };
        let cell = rocked.max_by(|a, b| energy_of(a).total_cmp(&energy_of(b)))?;
        let landing = Landing::rocking(&cell.block, ImpactModel::Paper);
        Some(landing.impact(mass_kg, cushion, cell.rocking.cg_rise_m, G0_M_S2))
    }

    /// What `words` makes of a few rows at a time, in their order and on all threads, to be written one after the other.
    pub fn pieces<T: Send>(&self, words: impl Fn(&mut dyn Iterator<Item = SpectrumRow<'_>>) -> T + Sync) -> Vec<T> {
        let starts: Vec<usize> = (0..self.objects()).step_by(ROWS_AT_A_TIME).collect();
        let piece = |&start: &usize| {
            words(&mut (start..(start + ROWS_AT_A_TIME).min(self.objects())).map(|index| self.row(index)))
        };
        starts.par_iter().map(piece).collect()
    }
}

/// Objects of a chunk under a motion of so many intervals, on the current thread pool.
pub fn chunk_objects(intervals: usize) -> usize {
    let least = CHUNK_OBJECTS_PER_THREAD.saturating_mul(rayon::current_num_threads());
    (CHUNK_STEPS / intervals.max(1)).max(least).min(CHUNK_OBJECTS)
}

/// Follows every object of the grid under every motion, in the order motion, height, thickness, and hands over chunks of
/// as many as `chunk` says for a number of intervals (see [`chunk_objects`]); the rows do not depend on it, nor on the
/// number of threads. The first error of `each` ends the work.
///
/// # Errors
/// What `each` returns.
pub fn spectrum<E>(
    request: &SpectrumRequest,
    motions: &[SpectrumMotion],
    chunk: impl Fn(usize) -> usize,
    mut each: impl FnMut(&SpectrumChunk) -> Result<(), E>,
) -> Result<SpectrumTiming, E> {
    let mut timing = SpectrumTiming { sensitivity_s: request.sensitivity.then_some(0.0), ..SpectrumTiming::default() };
    let objects = request.grid.objects();
    for (index, motion) in motions.iter().enumerate() {
        let base = Base { horizontal: Some(&motion.horizontal), vertical: motion.vertical.as_ref() };
        let intervals = motion.horizontal.accel_m_s2().len() - 1;
        let size = chunk(intervals).max(1);
        for start in (0..objects).step_by(size) {
            let blocks: Vec<Block> = request.grid.blocks(start..(start + size).min(objects)).collect();
            let began = Instant::now();
            let cells = uplift_spectrum(&blocks, base, &request.options);
            timing.solve_s += began.elapsed().as_secs_f64();
            timing.block_steps += blocks.len() as u64 * intervals as u64;
            let sensitivities = timing.sensitivity_s.as_mut().map(|seconds| {
                let began = Instant::now();
                let sensitivities = uplift_sensitivity(&cells, base, &request.options);
                *seconds += began.elapsed().as_secs_f64();
                sensitivities
            });
            let name = motion.name.as_str();
            let cushion = request.cushion.as_ref().map(|(mass_kg, edge)| (*mass_kg, &edge.cushion));
            each(&SpectrumChunk { motion: index, name, cushion, blocks, cells, sensitivities })?;
        }
    }
    Ok(timing)
}

/// What came of all objects under one motion.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[expect(missing_docs, reason = "the names are the documentation: SI units as they say")]
pub struct SpectrumTally {
    pub objects: usize,
    pub rocked: usize,
    pub overturned: usize,
    pub failed: usize,
    pub sensitive: usize,
    /// Of those that stay upright.
    pub largest_uplift_m: Option<f64>,
    /// Of those that stay upright, from the uplift.
    pub largest_edge_acceleration_g: Option<f64>,
}

impl SpectrumTally {
    /// Counts a row.
    pub fn add(&mut self, row: &SpectrumRow) {
        let larger = |most: Option<f64>, value: Option<f64>| match (most, value) {
            (Some(most), Some(value)) => Some(most.max(value)),
            (most, value) => most.or(value),
        };
        self.objects += 1;
        self.rocked += usize::from(row.outcome == Outcome::Rocked.name());
        let overturned = row.outcome == Outcome::Overturned.name();
        self.overturned += usize::from(overturned);
        self.failed += usize::from(row.reason.is_some());
        self.sensitive += usize::from(row.sensitivity.is_some_and(|sensitivity| sensitivity.sensitive));
        if !overturned {
            self.largest_uplift_m = larger(self.largest_uplift_m, row.uplift_m);
            self.largest_edge_acceleration_g = larger(self.largest_edge_acceleration_g, row.edge_acceleration_g);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cushion::CushionWords;
    use freestand_output::rows::csv_rows;

    fn request() -> SpectrumRequest {
        let heights_m: Vec<f64> = (0..23).map(|i| 0.4 + 0.15 * f64::from(i)).collect();
        let thicknesses_m: Vec<f64> = (0..11).map(|i| 0.1 + 0.07 * f64::from(i)).collect();
        SpectrumRequest {
            grid: Grid::new(heights_m, thicknesses_m).unwrap(),
            options: RockingOptions::default(),
            cushion: Some((150.0, CushionWords::spring(4.38e6).resolve(None).unwrap())),
            sensitivity: true,
        }
    }

    /// A swelling wave, and another with a vertical motion.
    fn motions() -> Vec<SpectrumMotion> {
        let wave = |frequency_hz: f64, peak: f64| {
            let sample = |i: i32| {
                let t = f64::from(i) * 0.01;
                peak * (-0.5 * (t - 3.0) * (t - 3.0)).exp() * (std::f64::consts::TAU * frequency_hz * t).sin()
            };
            Motion::new(0.01, (0..800).map(sample).collect()).unwrap()
        };
        vec![
            SpectrumMotion { name: "one".into(), horizontal: wave(0.9, 4.0), vertical: None },
            SpectrumMotion { name: "two".into(), horizontal: wave(1.6, 6.0), vertical: Some(wave(3.1, 3.0)) },
        ]
    }

    fn table(chunk: usize, threads: usize) -> String {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let mut text = Vec::new();
        let work = || {
            spectrum::<Problem>(
                &request(),
                &motions(),
                |_| chunk,
                |chunk| {
                    let pieces = chunk.pieces(|rows| csv_rows(rows.map(SpectrumRow::fields)).unwrap());
                    text.extend(pieces.concat());
                    Ok(())
                },
            )
        };
        pool.install(work).unwrap();
        String::from_utf8(text).unwrap()
    }

    /// Same bytes on any number of threads and in chunks of any size, even of one object: no lane knows its neighbours.
    #[test]
    fn rows_depend_neither_on_threads_nor_on_chunks() {
        let whole = table(usize::MAX, 1);
        assert_eq!(whole.lines().count(), 2 * 23 * 11);
        for outcome in ["no-uplift", "rocked", "overturned"] {
            assert!(whole.contains(outcome), "{outcome}");
        }
        assert!(whole.lines().next().unwrap().starts_with("one,0.4,0.1,"));
        for (chunk, threads) in [(usize::MAX, 2), (1, 1), (7, 2), (100, 2), (250, 1)] {
            assert_eq!(table(chunk, threads), whole, "chunks of {chunk} on {threads} threads");
        }
    }

    /// A pad that ends after 0.1 mm holds no rocking cabinet: no number, and the reason instead.
    #[test]
    fn a_cushion_that_bottoms_gives_a_reason_and_no_number() {
        let mut words = CushionWords::default();
        for (key, text) in [("law", "tangent"), ("stiffness", "100 N/mm"), ("bottoming", "0.1 mm")] {
            words.set(key, text);
        }
        let request = SpectrumRequest { cushion: Some((150.0, words.resolve(None).unwrap())), ..request() };
        let mut rocked = 0;
        let seen = spectrum::<Problem>(
            &request,
            &motions()[..1],
            |_| usize::MAX,
            |chunk| {
                for row in chunk.rows().filter(|row| row.outcome == "rocked" && row.uplift_m > Some(1e-3)) {
                    rocked += 1;
                    assert_eq!((row.edge_acceleration_g, row.reason.as_deref()), (None, Some(BOTTOMED)));
                }
                Ok(())
            },
        );
        assert!(seen.is_ok() && rocked > 10, "{rocked}");
    }

    #[test]
    fn chunks_are_bounded() {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build().unwrap();
        let size = |intervals| pool.install(|| chunk_objects(intervals));
        assert_eq!([0, 1000, 10_000, 10_000_000].map(size), [65_536, 65_536, 20_000, 4096]);
    }

    #[test]
    fn a_grid_of_nothing_and_one_too_large_are_refused() {
        assert!(Grid::new(vec![1.0], vec![0.0]).is_err());
        assert!(Grid::new(vec![1.0; 1001], vec![0.2; 1000]).is_err());
        assert_eq!(Grid::new(vec![1.0; 1000], vec![0.2; 1000]).unwrap().objects(), 1_000_000);
    }
}
