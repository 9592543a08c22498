//! One history of one object, with its events and its samples: what [`respond`](super::respond) sums
//! up, for those who look at it.

use crate::block::Block;
use crate::compliant::{
    CompliantBase, CompliantPoint, CompliantRecorder, CompliantRocking, Start,
    rock_compliant_observed,
};
use crate::impact::{ImpactModel, Landing};
use crate::motion::{MAX_SAMPLES, Motion};
use crate::rocking::{
    Base, HistoryPoint, HistoryRecorder, LONGEST_TAIL_S, Rocking, RockingOptions, rock_observed,
};
use crate::sliding::{
    PlaneMotion, PlanePoint, PlaneSliding, Sliding, SlidingPiece, slide_in_plane_observed,
    slide_observed,
};
use crate::spatial::{
    Pattern, SpatialMotion, SpatialObject, SpatialOptions, SpatialPiece, SpatialRocking,
    SpatialStart, Stack, StackRocking, rock_spatial_observed, rock_stack_observed,
};

use super::error::RespondError;
use super::object::{Glider, Pads, RigidPlane};
use super::settings::Settings;

/// Samples of a history without a motion \[s\].
const FREE_HISTORY_DT_S: f64 = 0.005;

/// Samples in each landing pulse of a history on pads: a peak between samples is at most 0.1 %
/// higher.
const SAMPLES_PER_PULSE: f64 = 40.0;

/// How one history is followed.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct HistoryOptions {
    /// As for every history.
    pub settings: Settings,
    /// How it begins.
    pub start: Release,
    /// Points whose accelerations are wanted, on pads: from the left edge, and above the base \[m\].
    pub points_m: Vec<(f64, f64)>,
    /// Whether its samples are kept.
    pub is_sampled: bool,
}

/// The rotation to the right from which an object is released; upright and at rest if both are 0.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Release {
    /// θ \[rad\].
    pub rotation_rad: f64,
    /// ω \[rad/s\].
    pub omega_rad_s: f64,
}

/// On a rigid base.
#[derive(Debug, Clone, PartialEq)]
pub struct RigidHistory {
    /// What the solver found.
    pub rocking: Rocking,
    /// The friction that rocking needs; `None`: it did not rock.
    pub friction_needed_ratio: Option<f64>,
    /// At the steps of the motion and just before and after every impact; empty if not sampled.
    pub samples: Vec<HistoryPoint>,
}

/// On pads.
#[derive(Debug, Clone, PartialEq)]
pub struct PadHistory {
    /// What the solver found.
    pub rocking: CompliantRocking,
    /// Fine enough for each landing; empty if not sampled.
    pub samples: Vec<CompliantPoint>,
}

/// While it rolls or slides.
#[derive(Debug, Clone, PartialEq)]
pub struct SlideHistory {
    /// What the solver found.
    pub sliding: Sliding,
    /// At every sample of the motion and at every event; empty if not sampled.
    pub samples: Vec<SlidePoint>,
}

/// While it rolls or slides under both components.
#[derive(Debug, Clone, PartialEq)]
pub struct PlaneSlideHistory {
    /// What the solver found.
    pub sliding: PlaneSliding,
    /// At every sample of the motion; empty if not sampled.
    pub samples: Vec<PlanePoint>,
}

/// An object that rolls or slides, at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlidePoint {
    /// Time \[s\].
    pub time_s: f64,
    /// x \[m\].
    pub slide_m: f64,
    /// ẋ \[m/s\].
    pub velocity_m_s: f64,
    /// Horizontal acceleration of the base \[m/s²\].
    pub base_accel_m_s2: f64,
}

/// In three dimensions.
#[derive(Debug, Clone, PartialEq)]
pub struct SpatialHistory {
    /// What the solver found.
    pub rocking: SpatialRocking,
    /// At the steps of the motion; empty if not sampled.
    pub samples: Vec<SpatialPoint>,
    /// The outline of the base at the end, from above \[m\]; empty if not sampled.
    pub outline_m: Vec<[f64; 2]>,
}

/// An object in three dimensions at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpatialPoint {
    /// Time \[s\].
    pub time_s: f64,
    /// Angles of the axis to the vertical: to the right, to the back, and in all \[rad\].
    pub tilts_rad: [f64; 3],
    /// Yaw \[rad\].
    pub yaw_rad: f64,
    /// Displacement of the centre of the base \[m\].
    pub base_m: [f64; 3],
}

/// Of a stack.
#[derive(Debug, Clone, PartialEq)]
pub struct StackHistory {
    /// What the solver found.
    pub rocking: StackRocking,
    /// At the steps of the motion; empty if not sampled.
    pub samples: Vec<StackPoint>,
}

/// A stack at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StackPoint {
    /// Time \[s\].
    pub time_s: f64,
    /// Rotations of the lower and of the upper body \[rad\].
    pub rotations_rad: [f64; 2],
    /// How both move.
    pub pattern: Pattern,
}

impl HistoryOptions {
    /// With samples, and else as [`respond`](super::respond) follows it.
    pub fn sampled(settings: Settings) -> Self {
        Self {
            settings,
            is_sampled: true,
            ..Self::default()
        }
    }

    /// Refuses a history until `end_s` that has too many samples.
    fn check(&self, end_s: f64, dt_s: f64) -> Result<(), RespondError> {
        if self.is_sampled && end_s / dt_s > MAX_SAMPLES as f64 {
            return Err(RespondError::TooLong { end_s, dt_s });
        }
        Ok(())
    }

    /// The end of a history on pads, at the latest \[s\].
    fn end_s(duration_s: Option<f64>, motion: Option<&Motion>) -> f64 {
        duration_s.unwrap_or_else(|| motion.map_or(0.0, Motion::duration_s) + LONGEST_TAIL_S)
    }
}

impl Release {
    /// Whether nothing releases it.
    pub fn is_at_rest(self) -> bool {
        self == Self::default()
    }
}

impl RigidPlane {
    /// The history on a rigid base.
    ///
    /// # Errors
    /// Those of the solver, and too many samples.
    pub fn follow(
        &self,
        base: Base<'_>,
        how: &HistoryOptions,
    ) -> Result<RigidHistory, RespondError> {
        let options = RockingOptions {
            initial_rotation_rad: how.start.rotation_rad,
            initial_omega_rad_s: how.start.omega_rad_s,
            ..how.settings.rocking(self.restitution, self.walls)
        };
        let dt_s = base.horizontal.map_or(FREE_HISTORY_DT_S, Motion::dt_s);
        let end_s = how.settings.duration_s(base.horizontal);
        how.check(end_s.unwrap_or(0.0), dt_s)?;
        let recorder = || HistoryRecorder::new(base.horizontal, FREE_HISTORY_DT_S);
        let mut recorder = how.is_sampled.then(recorder);
        let mut friction_needed_ratio: Option<f64> = None;
        let rocking = rock_observed(&self.plane.block, base, &options, |segment| {
            let needed = segment.friction_needed_ratio();
            friction_needed_ratio =
                Some(friction_needed_ratio.map_or(needed, |most| most.max(needed)));
            if let Some(recorder) = &mut recorder {
                recorder.observe(segment);
            }
        })?;
        let samples = recorder.map(|recorder| recorder.finish(&rocking));
        Ok(RigidHistory {
            rocking,
            friction_needed_ratio,
            samples: samples.unwrap_or_default(),
        })
    }
}

impl Pads {
    /// The history in the first of its planes.
    ///
    /// # Errors
    /// Those of the solver, and too many samples.
    pub fn follow(&self, base: Base<'_>, how: &HistoryOptions) -> Result<PadHistory, RespondError> {
        let block = &self.planes.one.block;
        let motion = base.horizontal.or(base.vertical);
        let mut options = how.settings.compliant(motion);
        options.points_m.clone_from(&how.points_m);
        if !how.start.is_at_rest() {
            options.start = Start::Tilted {
                rotation_rad: how.start.rotation_rad,
                omega_rad_s: how.start.omega_rad_s,
            };
        }
        let dt_s = self.sample_s(block, motion, options.gravity_m_s2);
        how.check(HistoryOptions::end_s(options.duration_s, motion), dt_s)?;
        let (width_m, contacts) = (block.base_width_m(), self.base.contacts);
        let recorder = || CompliantRecorder::new(dt_s, width_m, &options.points_m, contacts);
        let mut recorder = how.is_sampled.then(recorder);
        let rocking = rock_compliant_observed(block, &self.base, base, &options, |piece| {
            if let Some(recorder) = &mut recorder {
                recorder.observe(piece);
            }
        })?;
        let samples = recorder.map(|recorder| recorder.finish(&rocking));
        Ok(PadHistory {
            rocking,
            samples: samples.unwrap_or_default(),
        })
    }

    /// The step of the motion, or one fine enough for a landing \[s\].
    fn sample_s(&self, block: &Block, motion: Option<&Motion>, gravity_m_s2: f64) -> f64 {
        let landing = Landing::rocking(block, ImpactModel::Paper);
        let CompliantBase {
            cushion, mass_kg, ..
        } = &self.base;
        let at_rest_m = cushion.static_compression_m(mass_kg * gravity_m_s2);
        let stiffness_n_m = cushion.tangent_stiffness_n_m(at_rest_m);
        let m_eff = landing.effective_mass_ratio * mass_kg;
        let pulse_s = std::f64::consts::PI * (m_eff / stiffness_n_m).sqrt() / SAMPLES_PER_PULSE;
        motion.map_or(pulse_s, |motion| motion.dt_s().min(pulse_s))
    }
}

impl Glider {
    /// The history under one horizontal component.
    ///
    /// # Errors
    /// Those of the solver.
    pub fn follow(
        &self,
        base: Base<'_>,
        how: &HistoryOptions,
    ) -> Result<SlideHistory, RespondError> {
        let mut samples: Vec<SlidePoint> = Vec::new();
        let mut last: Option<SlidingPiece> = None;
        let accel = |time_s: f64| base.horizontal.map_or(0.0, |motion| motion.at_m_s2(time_s));
        let point = |time_s, (slide_m, velocity_m_s)| SlidePoint {
            time_s,
            slide_m,
            velocity_m_s,
            base_accel_m_s2: accel(time_s),
        };
        let options = how.settings.sliding(self.friction, self.clearance);
        let sliding = slide_observed(base, &options, |piece| {
            // A stop and the rest that follows it begin at the same instant as a piece of no length.
            if how.is_sampled && samples.len() < MAX_SAMPLES && piece.length_s > 0.0 {
                samples.push(point(piece.start_s, piece.state(0.0)));
                last = Some(*piece);
            }
        })?;
        if let Some(piece) = last {
            samples.push(point(sliding.end_time_s, piece.state(piece.length_s)));
        }
        Ok(SlideHistory { sliding, samples })
    }

    /// The history under both horizontal components.
    ///
    /// # Errors
    /// Those of the solver.
    pub fn follow_in_plane(
        &self,
        motion: PlaneMotion<'_>,
        how: &HistoryOptions,
    ) -> Result<PlaneSlideHistory, RespondError> {
        let mut samples: Vec<PlanePoint> = Vec::new();
        let options = how.settings.sliding(self.friction, self.clearance);
        let sliding = slide_in_plane_observed(motion, self.yaw_rad, &options, |point| {
            if how.is_sampled && samples.len() < MAX_SAMPLES {
                samples.push(point);
            }
        })?;
        Ok(PlaneSlideHistory { sliding, samples })
    }
}

/// Samples at a fixed step from the pieces of a history.
struct Sampler {
    dt_s: f64,
    sampled: usize,
}

impl Sampler {
    fn new(
        how: &HistoryOptions,
        motion: Option<&Motion>,
        options: &SpatialOptions,
    ) -> Result<Self, RespondError> {
        let dt_s = motion.map_or(FREE_HISTORY_DT_S, Motion::dt_s);
        how.check(HistoryOptions::end_s(options.duration_s, motion), dt_s)?;
        Ok(Self { dt_s, sampled: 0 })
    }

    /// Passes the samples of a piece, each with its time and its share of the piece.
    fn each(&mut self, piece: &SpatialPiece<'_, '_>, mut take: impl FnMut(f64, f64)) {
        let end_s = piece.start_s() + piece.length_s();
        while self.sampled as f64 * self.dt_s <= end_s {
            let time_s = self.sampled as f64 * self.dt_s;
            // Before its first piece a body at rest is in its initial state.
            let share = (time_s - piece.start_s()) / piece.length_s();
            take(time_s, share.clamp(0.0, 1.0));
            self.sampled += 1;
        }
    }
}

impl SpatialObject {
    /// The history in three dimensions; x of the motion is x of the object.
    ///
    /// # Errors
    /// Those of the solver, and too many samples.
    pub fn follow(
        &self,
        motion: SpatialMotion<'_>,
        how: &HistoryOptions,
    ) -> Result<SpatialHistory, RespondError> {
        let given = motion.x.or(motion.vertical);
        let mut options = how.settings.spatial(given);
        if !how.start.is_at_rest() {
            options.start = SpatialStart::Released {
                tilt_rad: how.start.rotation_rad,
                toward_rad: 0.0,
                omega_rad_s: [0.0, how.start.omega_rad_s, 0.0],
            };
        }
        let mut sampler = Sampler::new(how, given, &options)?;
        let feet = self.shape.feet_m();
        let (mut samples, mut outline_m) = (Vec::new(), Vec::new());
        let rocking = rock_spatial_observed(self, motion, &options, |piece| {
            if !how.is_sampled {
                return;
            }
            sampler.each(piece, |time_s, share| {
                if let Some(pose) = piece.pose(0, share) {
                    let [x, y] = pose.tilts_rad;
                    samples.push(SpatialPoint {
                        time_s,
                        tilts_rad: [x, y, pose.tilt_rad],
                        yaw_rad: pose.yaw_rad,
                        base_m: pose.base_m,
                    });
                }
            });
            let above =
                |&[x, y]: &[f64; 2]| piece.place_m(0, [x, y, 0.0], 1.0).map(|[x, y, _]| [x, y]);
            outline_m = feet.iter().filter_map(above).collect();
        })?;
        Ok(SpatialHistory {
            rocking,
            samples,
            outline_m,
        })
    }
}

impl Stack {
    /// The history of both bodies.
    ///
    /// # Errors
    /// Those of the solver, and too many samples.
    pub fn follow(
        &self,
        base: Base<'_>,
        how: &HistoryOptions,
    ) -> Result<StackHistory, RespondError> {
        let given = base.horizontal.or(base.vertical);
        let options = how.settings.spatial(given);
        let mut sampler = Sampler::new(how, given, &options)?;
        let mut samples = Vec::new();
        let rocking = rock_stack_observed(self, base, &options, |piece| {
            if !how.is_sampled {
                return;
            }
            sampler.each(piece, |time_s, share| {
                let rotation = |body| {
                    let pose = piece.pose(body, share);
                    pose.map_or(0.0, |pose| pose.tilts_rad[0])
                };
                samples.push(StackPoint {
                    time_s,
                    rotations_rad: [rotation(0), rotation(1)],
                    pattern: piece.pattern().unwrap_or(Pattern::Rest),
                });
            });
        })?;
        Ok(StackHistory { rocking, samples })
    }
}
