//! The motion of the floors of a building.

use std::ops::Range;

use super::{Building, BuildingError};
use crate::motion::Motion;
use crate::oscillator::{LANES, LaneGroup, LaneStates, Lanes, step_of_period};
use crate::vector::Column;

/// Motion of one floor; see [`floor_motions`].
///
/// # Errors
/// A level outside 0 to 1, or samples that overflow.
///
/// # Example
/// The ground floor has the motion of the ground:
/// ```
/// use freestand::{building::{Building, floor_motion}, motion::Motion};
/// let ground = Motion::new(0.02, vec![0.3, -1.0, 0.7])?;
/// let building = Building::beam(1.92, 0.05, 5.0, 10)?;
/// assert_eq!(floor_motion(&ground, &building, 0.0)?, ground);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn floor_motion(
    ground: &Motion,
    building: &Building,
    level_ratio: f64,
) -> Result<Motion, BuildingError> {
    let (mut floors, _) = floor_motions_and_peaks(ground, building, &[level_ratio], &[])?;
    Ok(floors.swap_remove(0))
}

/// Absolute accelerations of several floors of a building that is at rest at t = 0, in the order of
/// `levels_ratio`.
///
/// `a(x, t) = Σ Γ_iφ_i(x) A_i(t) + [1 − Σ Γ_iφ_i(x)] a_g(t)`, with A_i the absolute acceleration of
/// a modal oscillator. The bracket is the quasi-static share of the modes left out: without it the
/// floors near the ground would not move. At x = 0 the result is the ground motion itself, bit for
/// bit.
///
/// # Reference
/// Chopra, Dynamics of Structures, modal analysis with static correction; oscillators by Nigam and
/// Jennings (1969).
///
/// # Accuracy
/// Exact in time for the modes included. With 6 modes of a building of T₁ = 2 s the peak
/// accelerations under the 1940 El Centro record are, from mid-height up, within 0.4 % of those
/// with many modes.
///
/// # Limitation
/// The result is as long as the ground motion: append [`Building::tail_s`] of zeros first, so that
/// the vibration of the floors decays.
///
/// # Errors
/// A level outside 0 to 1, or samples that overflow.
pub fn floor_motions(
    ground: &Motion,
    building: &Building,
    levels_ratio: &[f64],
) -> Result<Vec<Motion>, BuildingError> {
    floor_motions_and_peaks(ground, building, levels_ratio, &[]).map(|(floors, _)| floors)
}

/// The [`floor_motions`] of some levels, and of others the peak accelerations \[m/s²\] alone: those of their motions, to
/// the bit, at half the cost.
///
/// # Errors
/// A level outside 0 to 1, or samples or peaks that overflow.
///
/// # Example
/// ```
/// use freestand::{building::{Building, floor_motions_and_peaks}, motion::Motion};
/// let ground = Motion::new(0.02, vec![0.3, -1.0, 0.7])?;
/// let building = Building::beam(1.92, 0.05, 5.0, 10)?;
/// let (floors, peaks_m_s2) = floor_motions_and_peaks(&ground, &building, &[1.0], &[0.0, 1.0])?;
/// assert_eq!(peaks_m_s2, [1.0, floors[0].peak_m_s2()]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn floor_motions_and_peaks(
    ground: &Motion,
    building: &Building,
    levels_ratio: &[f64],
    peaks_at_ratio: &[f64],
) -> Result<(Vec<Motion>, Vec<f64>), BuildingError> {
    let levels = shares(building, levels_ratio)?;
    let of_peaks = shares(building, peaks_at_ratio)?;
    let samples = ground.accel_m_s2().len();
    let mut floors: Vec<Vec<f64>> = levels.iter().map(|_| Vec::with_capacity(samples)).collect();
    let mut peaks_m_s2 = vec![0.0; of_peaks.len()];
    let mut sums = Sums::default();
    follow::<false>(ground, building, |block| {
        let modes = &block.absolute_m_s2;
        for (floor, level) in floors.iter_mut().zip(&levels) {
            floor.extend_from_slice(sums.of(block, level.residual, level, modes));
        }
        for (peak, level) in peaks_m_s2.iter_mut().zip(&of_peaks) {
            raise(peak, sums.of(block, level.residual, level, modes));
        }
    })?;
    check_finite(peaks_m_s2.iter().copied())?;
    let motion = |accel_m_s2| Ok(Motion::new(ground.dt_s(), accel_m_s2)?);
    let floors: Result<Vec<Motion>, BuildingError> = floors.into_iter().map(motion).collect();
    Ok((floors?, peaks_m_s2))
}

/// Peak responses of one level, at the samples.
///
/// **Units**: m/s², m. Displacement and drift are relative to the ground.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FloorPeaks {
    /// The level as a share of the height of the building.
    pub level_ratio: f64,
    /// Largest absolute acceleration \[m/s²\].
    pub accel_m_s2: f64,
    /// Largest displacement relative to the ground \[m\].
    pub displacement_m: f64,
    /// Largest displacement relative to the previous level in the list, or to the ground for the
    /// first one \[m\].
    pub drift_m: f64,
}

/// Peak responses of many levels in one pass, without storing their histories.
///
/// The accelerations are those of [`floor_motions`], to the bit; the displacement is
/// `u(x, t) = Σ Γ_iφ_i(x) u_i(t)`. The modes left out do not contribute to it: they follow the
/// ground without delay.
///
/// # Errors
/// A level outside 0 to 1, or peaks that overflow.
///
/// # Example
/// A rigid block on a spring under a sudden 1 m/s² moves 2a/ω² = 2·0.0253 m in half a period:
/// ```
/// use freestand::{building::{Building, Damping, Storey, floor_peaks}, motion::Motion};
/// let omega2 = (std::f64::consts::TAU).powi(2);
/// let storey = Storey { mass_kg: 1.0, stiffness_n_m: omega2, height_m: 3.0 };
/// let building = Building::shear(&[storey], &Damping::Uniform(0.0), 1)?;
/// let peaks = floor_peaks(&Motion::new(0.5, vec![1.0; 3])?, &building, &[1.0])?;
/// assert!((peaks[0].displacement_m - 2.0 / omega2).abs() < 1e-15);
/// assert!((peaks[0].accel_m_s2 - 2.0).abs() < 1e-13);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn floor_peaks(
    ground: &Motion,
    building: &Building,
    levels_ratio: &[f64],
) -> Result<Vec<FloorPeaks>, BuildingError> {
    let levels = shares(building, levels_ratio)?;
    let mut peaks: Vec<FloorPeaks> = levels_ratio
        .iter()
        .map(|&level_ratio| FloorPeaks {
            level_ratio,
            accel_m_s2: 0.0,
            displacement_m: 0.0,
            drift_m: 0.0,
        })
        .collect();
    let (mut sums, mut below) = (Sums::default(), Sums::default());
    follow::<true>(ground, building, |block| {
        below = Sums::default();
        for (peak, level) in peaks.iter_mut().zip(&levels) {
            raise(
                &mut peak.accel_m_s2,
                sums.of(block, level.residual, level, &block.absolute_m_s2),
            );
            let here = sums.of(block, 0.0, level, &block.displacement_m);
            raise(&mut peak.displacement_m, here);
            for (below, here) in below.0.iter_mut().zip(here) {
                *below = here - *below;
            }
            raise(&mut peak.drift_m, &below.0[..here.len()]);
            std::mem::swap(&mut sums, &mut below);
        }
    })?;
    let all = |peak: &FloorPeaks| [peak.accel_m_s2, peak.displacement_m, peak.drift_m];
    check_finite(peaks.iter().flat_map(all))?;
    Ok(peaks)
}

fn check_finite(peaks: impl IntoIterator<Item = f64>) -> Result<(), BuildingError> {
    match peaks.into_iter().find(|peak| !peak.is_finite()) {
        Some(value) => Err(crate::motion::MotionError::NotFinite { index: 0, value }.into()),
        None => Ok(()),
    }
}

/// The shares of the modes and of the ground itself in the motion of a level.
struct Shares {
    residual: f64,
    /// Empty at the ground, whose motion is the given one.
    modes: Vec<f64>,
}

/// The shares of each level.
fn shares(building: &Building, levels_ratio: &[f64]) -> Result<Vec<Shares>, BuildingError> {
    levels_ratio
        .iter()
        .map(|&level_ratio| Shares::new(building, level_ratio))
        .collect()
}

impl Shares {
    fn new(building: &Building, level_ratio: f64) -> Result<Self, BuildingError> {
        if !(0.0..=1.0).contains(&level_ratio) {
            return Err(BuildingError::Level { level_ratio });
        }
        let modes: Vec<f64> = building
            .modes
            .iter()
            .map(|mode| mode.share_ratio(level_ratio))
            .collect();
        let residual = 1.0 - modes.iter().sum::<f64>();
        Ok(Self {
            residual,
            modes: if level_ratio > 0.0 { modes } else { Vec::new() },
        })
    }
}

/// Samples whose sums are kept in the registers of a vector unit.
const SUMMED: usize = 32;

/// So many samples in whole lines of the cache: loads that cross a line take twice as long.
type Run = Column<SUMMED>;

/// The samples of a block are a multiple of those of a run. Those of ten modes stay in the fastest cache while they are
/// summed for every floor.
const BLOCK: usize = RUNS * SUMMED;
const RUNS: usize = 8;

/// The ground and all modes during one block of time; beyond its last sample a run has any values.
struct Block {
    samples: usize,
    ground_m_s2: Column<BLOCK>,
    /// First the first run of every mode, then the second of every mode.
    absolute_m_s2: Vec<Run>,
    /// Empty where nobody reads it.
    displacement_m: Vec<Run>,
}

/// The sums of modes during one block of time.
#[derive(Default)]
struct Sums(Column<BLOCK>);

impl Sums {
    /// The share `residual` of the ground, and those that a level has of `modes`.
    fn of(&mut self, block: &Block, residual: f64, level: &Shares, modes: &[Run]) -> &[f64] {
        pulp::Arch::new().dispatch(Sum {
            sums: &mut self.0,
            ground_m_s2: &block.ground_m_s2,
            residual,
            shares: &level.modes,
            modes,
        });
        &self.0[..block.samples]
    }
}

/// Sums to be compiled for each vector unit: the share of the ground, and the modes, each in turn. Nothing is fused, so
/// the vector unit changes no bit.
struct Sum<'a> {
    sums: &'a mut Column<BLOCK>,
    ground_m_s2: &'a Column<BLOCK>,
    residual: f64,
    shares: &'a [f64],
    modes: &'a [Run],
}

impl pulp::WithSimd for Sum<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        let each = self.modes.len() / RUNS;
        let (sums, _) = self.sums.as_chunks_mut::<SUMMED>();
        let (ground, _) = self.ground_m_s2.as_chunks::<SUMMED>();
        for (place, (sums, ground)) in sums.iter_mut().zip(ground).enumerate() {
            let mut now = [0.0; SUMMED];
            for i in 0..SUMMED {
                now[i] = self.residual * ground[i];
            }
            let modes = &self.modes[place * each..][..each];
            for (share, mode) in self.shares.iter().zip(modes) {
                for i in 0..SUMMED {
                    now[i] += share * mode[i];
                }
            }
            *sums = now;
        }
    }
}

/// Raises a peak to the largest absolute value. Keeps NaN, so that an overflow is noticed.
fn raise(peak: &mut f64, values: &[f64]) {
    let most = pulp::Arch::new().dispatch(Raise { values });
    *peak = f64::from_bits(most.max(peak.to_bits()));
}

/// The bits of the largest absolute value, to be compiled for each vector unit. Those of positive numbers rise with them,
/// and NaN is above infinity.
struct Raise<'a> {
    values: &'a [f64],
}

impl pulp::WithSimd for Raise<'_> {
    type Output = u64;

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) -> u64 {
        let (abreast, rest) = self.values.as_chunks::<SUMMED>();
        let mut most = [0; SUMMED];
        for values in abreast {
            for i in 0..SUMMED {
                most[i] = most[i].max(values[i].abs().to_bits());
            }
        }
        let rest = rest.iter().map(|value| value.abs().to_bits());
        rest.chain(most).max().unwrap_or(0)
    }
}

/// Calculates the oscillators of all modes once, side by side and block by block, for `each` block. With `DISPLACED`,
/// their displacements are kept too.
fn follow<const DISPLACED: bool>(
    ground: &Motion,
    building: &Building,
    mut each: impl FnMut(&Block),
) -> Result<(), BuildingError> {
    let steps = building.modes.iter().map(|mode| {
        // The building and the motion are valid, so the only error left is a period too short
        // for its ω².
        let period_s = mode.period_s;
        let step = step_of_period(period_s, mode.damping_ratio, ground.dt_s());
        step.map(Some)
            .map_err(|_| BuildingError::Period { period_s })
    });
    let steps = steps.collect::<Result<Vec<_>, BuildingError>>()?;
    let mut groups: Vec<(LaneGroup, LaneStates)> = steps
        .chunks(LANES)
        .map(|steps| (LaneGroup::new(steps), LaneStates::default()))
        .collect();
    let runs = |is_kept: bool| vec![Run::default(); if is_kept { RUNS * steps.len() } else { 0 }];
    let mut block = Block {
        samples: 0,
        ground_m_s2: Column::default(),
        absolute_m_s2: runs(true),
        displacement_m: runs(DISPLACED),
    };
    let widest = pulp::Arch::new();
    let accel = ground.accel_m_s2();
    let mut absolute_m_s2 = vec![[0.0; LANES]; BLOCK];
    let mut displacement_m = vec![[0.0; LANES]; if DISPLACED { BLOCK } else { 0 }];
    for from in (0..accel.len()).step_by(BLOCK) {
        let to = accel.len().min(from + BLOCK);
        block.samples = to - from;
        block.ground_m_s2[..to - from].copy_from_slice(&accel[from..to]);
        // The very first sample is at rest: its place keeps the zeros that it begins with.
        let rests = usize::from(from == 0);
        for (place, (group, states)) in groups.iter_mut().enumerate() {
            widest.dispatch(Advance {
                group,
                states,
                accel_m_s2: &accel[from.saturating_sub(1)..to],
                absolute_m_s2: &mut absolute_m_s2[rests..],
                displacement_m: displacement_m.get_mut(rests..).unwrap_or_default(),
            });
            let lanes = place * LANES..steps.len().min((place + 1) * LANES);
            transpose(&absolute_m_s2, &mut block.absolute_m_s2, lanes.clone());
            transpose(&displacement_m, &mut block.displacement_m, lanes);
        }
        each(&block);
    }
    Ok(())
}

/// Oscillators that go on through a block, to be compiled for each vector unit.
struct Advance<'a> {
    group: &'a LaneGroup,
    states: &'a mut LaneStates,
    accel_m_s2: &'a [f64],
    absolute_m_s2: &'a mut [Lanes],
    displacement_m: &'a mut [Lanes],
}

impl pulp::WithSimd for Advance<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        self.group.advance(
            self.states,
            self.accel_m_s2,
            self.absolute_m_s2,
            self.displacement_m,
        );
    }
}

/// From lanes of samples to runs of modes; `modes` are those of the lanes.
fn transpose(samples: &[Lanes], runs: &mut [Run], modes: Range<usize>) {
    let each = runs.len() / RUNS;
    let (samples, _) = samples.as_chunks::<SUMMED>();
    for (place, samples) in samples.iter().enumerate() {
        let runs = &mut runs[place * each..][modes.clone()];
        for (lane, run) in runs.iter_mut().enumerate() {
            for (value, lanes) in run.iter_mut().zip(samples) {
                *value = lanes[lane];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Mode;
    use super::*;
    use crate::oscillator::absolute_acceleration_history_m_s2;

    fn shaking() -> Motion {
        Motion::new(
            0.01,
            (0..500)
                .map(|k| (0.07 * k as f64).sin() * 2.0 + (0.9 * k as f64).cos())
                .collect(),
        )
        .unwrap()
    }

    #[test]
    fn the_ground_floor_is_the_ground_bit_for_bit() {
        let mut accel = shaking().accel_m_s2().to_vec();
        accel[7] = -0.0;
        let ground = Motion::new(0.01, accel).unwrap();
        let building = Building::beam(2.0, 0.02, 5.0, 7).unwrap();
        let floor = floor_motion(&ground, &building, 0.0).unwrap();
        for (a, b) in floor.accel_m_s2().iter().zip(ground.accel_m_s2()) {
            assert_eq!(a.to_bits(), b.to_bits());
        }
    }

    /// Side by side, and for several samples at once, the modes have the bits that each has alone; more of them than lanes,
    /// and more samples than a block, with a rest.
    #[test]
    fn floors_are_the_sums_of_their_modes_bit_for_bit() {
        let building = Building::beam(2.0, 0.02, 5.0, LANES + 3).unwrap();
        let ground = shaking();
        assert!(
            ground.accel_m_s2().len() > BLOCK && !ground.accel_m_s2().len().is_multiple_of(SUMMED)
        );
        let modes: Vec<Vec<f64>> = building
            .modes
            .iter()
            .map(|mode| {
                let Mode {
                    period_s,
                    damping_ratio,
                    ..
                } = *mode;
                absolute_acceleration_history_m_s2(&ground, period_s, damping_ratio).unwrap()
            })
            .collect();
        for level_ratio in [0.1, 0.5, 1.0] {
            let Shares {
                residual,
                modes: shares,
            } = Shares::new(&building, level_ratio).unwrap();
            let floor = floor_motion(&ground, &building, level_ratio).unwrap();
            for (i, (found, a)) in floor
                .accel_m_s2()
                .iter()
                .zip(ground.accel_m_s2())
                .enumerate()
            {
                let mut expected = residual * a;
                for (share, mode) in shares.iter().zip(&modes) {
                    expected += share * mode[i];
                }
                assert_eq!(found.to_bits(), expected.to_bits(), "{level_ratio} {i}");
            }
        }
    }

    #[test]
    fn levels_together_are_levels_one_by_one() {
        let building = Building::beam(2.0, 0.02, 5.0, 7).unwrap();
        let levels_ratio = [1.0, 0.0, 0.5, 0.1];
        let together = floor_motions(&shaking(), &building, &levels_ratio).unwrap();
        for (motion, level_ratio) in together.iter().zip(levels_ratio) {
            assert_eq!(
                *motion,
                floor_motion(&shaking(), &building, level_ratio).unwrap()
            );
        }
    }

    #[test]
    fn a_floor_of_a_rigid_building_moves_as_the_ground() {
        // T₁ = dt/1000: a mode lags the ground by 2ζT/(2π dt) ≤ 9.6e-5 of the change between
        // samples, which is at most 0.87 + 0.14 m/s² here; its own vibration decays within a step.
        // The shares of the modes add up to less than 1.2. The first sample is an exception: there
        // the oscillators are at rest.
        let building = Building::beam(1e-5, 0.3, 5.0, 5).unwrap();
        let floor = floor_motion(&shaking(), &building, 0.7).unwrap();
        for (a, b) in floor
            .accel_m_s2()
            .iter()
            .zip(shaking().accel_m_s2())
            .skip(1)
        {
            assert!((a - b).abs() < 1.2e-4, "{a} {b}");
        }
    }

    /// The formula as written, level by level over whole histories. The number of samples is larger
    /// than a block and not a multiple of it.
    #[test]
    fn blocks_change_no_bit() {
        let samples = 2 * BLOCK + 77;
        let ground =
            Motion::new(0.01, (0..samples).map(|k| (0.3 * k as f64).sin()).collect()).unwrap();
        let building = Building::beam(0.7, 0.02, 5.0, 4).unwrap();
        let level = 0.6;
        let residual = 1.0
            - building
                .modes()
                .iter()
                .map(|mode| mode.share_ratio(level))
                .sum::<f64>();
        let mut expected: Vec<f64> = ground.accel_m_s2().iter().map(|a| residual * a).collect();
        for mode in building.modes() {
            let history =
                absolute_acceleration_history_m_s2(&ground, mode.period_s(), 0.02).unwrap();
            for (sample, absolute) in expected.iter_mut().zip(history) {
                *sample += mode.share_ratio(level) * absolute;
            }
        }
        assert_eq!(
            floor_motion(&ground, &building, level)
                .unwrap()
                .accel_m_s2(),
            expected
        );
    }

    #[test]
    fn peaks_are_those_of_the_motions() {
        let ground = shaking().with_zero_tail(4.0).unwrap();
        let building = Building::beam(1.3, 0.02, 5.0, 7).unwrap();
        let levels_ratio = [0.0, 0.2, 0.5, 1.0];
        let floors = floor_motions(&ground, &building, &levels_ratio).unwrap();
        let peaks = floor_peaks(&ground, &building, &levels_ratio).unwrap();
        for (floor, peak) in floors.iter().zip(&peaks) {
            assert_eq!(floor.peak_m_s2(), peak.accel_m_s2);
        }
        let still = peaks[0];
        assert_eq!([still.displacement_m, still.drift_m], [0.0; 2]);
        assert_eq!(peaks[1].drift_m, peaks[1].displacement_m);
        // A drift is at most the sum of the displacements of both ends, and at least their
        // difference.
        for pair in peaks.windows(2) {
            let (low, high) = (pair[0].displacement_m, pair[1].displacement_m);
            assert!(
                pair[1].drift_m <= low + high && pair[1].drift_m >= (high - low) * (1.0 - 1e-12)
            );
        }
    }

    /// One mode alone: the displacement is its share of the oscillator's spectrum.
    #[test]
    fn one_mode_moves_as_its_oscillator() {
        let building = Building::beam(0.8, 0.03, 5.0, 1).unwrap();
        let peaks = floor_peaks(&shaking(), &building, &[0.5, 1.0]).unwrap();
        let sd = crate::oscillator::response_spectrum(&shaking(), 0.03, &[0.8])
            .unwrap()
            .sd_m[0];
        for peak in peaks {
            let share = building.modes()[0].share_ratio(peak.level_ratio);
            assert!(
                (peak.displacement_m / (share * sd) - 1.0).abs() < 1e-13,
                "two roundings of each sample"
            );
        }
    }

    #[test]
    fn levels_outside_the_building_are_refused() {
        let fine = Building::beam(1.0, 0.05, 5.0, 3).unwrap();
        for level_ratio in [-0.1, 1.1, f64::NAN] {
            assert!(matches!(
                floor_motion(&shaking(), &fine, level_ratio),
                Err(BuildingError::Level { .. })
            ));
            assert!(matches!(
                floor_peaks(&shaking(), &fine, &[level_ratio]),
                Err(BuildingError::Level { .. })
            ));
        }
    }
}
