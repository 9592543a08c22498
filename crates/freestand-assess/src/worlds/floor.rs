//! How a floor moves in a world.

use std::sync::OnceLock;

use freestand::motion::Motion;
use freestand::respond::{Along, Shaking};
use freestand::rocking::Base;
use freestand_records::horizontal::HorizontalMotion;

/// The motion of a floor in a world, and its peaks.
#[derive(Debug, Clone)]
pub struct FloorOfWorld {
    /// Its horizontal components.
    pub motion: HorizontalMotion,
    /// Its vertical component, if it has one.
    vertical: Option<Motion>,
    /// Peak acceleration in any direction \[m/s²\].
    pub pfa_m_s2: f64,
    velocity_m_s: OnceLock<f64>,
}

impl FloorOfWorld {
    pub(super) fn new(motion: HorizontalMotion, vertical: Option<Motion>) -> Self {
        Self {
            pfa_m_s2: motion.peak_m_s2(),
            velocity_m_s: OnceLock::new(),
            motion,
            vertical,
        }
    }

    /// One that moves as given, in every direction alike.
    pub fn given(horizontal: &Motion, vertical: Option<&Motion>) -> Self {
        Self::new(
            HorizontalMotion {
                along: horizontal.clone(),
                across: None,
            },
            vertical.cloned(),
        )
    }

    /// Every component multiplied by a factor; `None` where their numbers have no end.
    pub fn scaled(&self, scale_ratio: f64) -> Option<Self> {
        let scaled = |motion: Option<&Motion>| {
            motion
                .map(|motion| motion.scaled(scale_ratio))
                .transpose()
                .ok()
        };
        Some(Self {
            motion: HorizontalMotion {
                along: self.motion.along.scaled(scale_ratio).ok()?,
                across: scaled(self.motion.across.as_ref())?,
            },
            vertical: scaled(self.vertical.as_ref())?,
            pfa_m_s2: self.pfa_m_s2 * scale_ratio,
            velocity_m_s: OnceLock::new(),
        })
    }

    /// What is left of its motion from a sample on; `None`: less than two samples.
    pub fn from_sample(&self, sample: usize) -> Option<Self> {
        let rest = |motion: &Motion| {
            let samples = motion.accel_m_s2().get(sample..)?;
            Motion::new(motion.dt_s(), samples.to_vec()).ok()
        };
        let across = self.motion.across.as_ref();
        let motion = HorizontalMotion {
            along: rest(&self.motion.along)?,
            across: across.map(rest).map_or(Some(None), |rest| rest.map(Some))?,
        };
        let vertical = self.vertical.as_ref();
        let vertical = vertical
            .map(rest)
            .map_or(Some(None), |rest| rest.map(Some))?;
        Some(Self::new(motion, vertical))
    }

    /// The same, in which the acceleration of the floor itself counts for nothing: only what the object
    /// does.
    pub fn without_peak(self) -> Self {
        Self {
            pfa_m_s2: 0.0,
            ..self
        }
    }

    /// Peak velocity in any direction \[m/s\]; it is calculated where somebody asks.
    pub fn pfv_m_s(&self) -> f64 {
        *self
            .velocity_m_s
            .get_or_init(|| self.motion.peak_velocity_m_s())
    }

    /// The accelerations of all its components.
    pub fn shaking(&self) -> Shaking<'_> {
        Shaking {
            x: Some(&self.motion.along),
            y: self.motion.across.as_ref(),
            vertical: self.vertical.as_ref(),
        }
    }

    /// How the base of an object moves in a plane.
    pub fn base(&self, along: Along) -> Base<'_> {
        self.shaking().base(along)
    }
}

/// Peak accelerations of a floor in a world.
#[derive(Debug, Clone, Copy)]
pub struct HorizontalPeaks {
    /// Of its first horizontal component \[m/s²\].
    pub along_m_s2: f64,
    /// Of its second one, if it has one \[m/s²\].
    pub across_m_s2: Option<f64>,
}

impl HorizontalPeaks {
    pub(super) fn of(motion: &HorizontalMotion) -> Self {
        Self {
            along_m_s2: motion.along.peak_m_s2(),
            across_m_s2: motion.across.as_ref().map(Motion::peak_m_s2),
        }
    }
}
