//! How well an intensity measure tells whether an object fails.

use freestand::fragility::LimitState;
use freestand_output::answer_of;

/// A measure and a limit state of one object.
#[derive(Debug, Clone, PartialEq)]
pub struct Quality {
    /// The limit state.
    pub limit_state: LimitState,
    /// β of the capacities; of a cloud the residual standard deviation of ln demand.
    pub efficiency: Option<f64>,
    /// Slope of ln demand by ln intensity.
    pub practicality: Option<f64>,
    /// p of the residuals against ln of the mean period; `None` unless all motions reach the limit
    /// state, or of a cloud.
    pub p_mean_period: Option<f64>,
    /// p of the residuals against ln of PGV/PGA.
    pub p_velocity_over_acceleration: Option<f64>,
    /// ln of the mean period, ln of PGV/PGA and the residual, for each motion that has one.
    pub residuals: Vec<[f64; 3]>,
}

impl Quality {
    /// β/b.
    pub fn proficiency(&self) -> Option<f64> {
        let practicality = self.practicality.filter(|slope| *slope > 0.0)?;
        Some(self.efficiency? / practicality)
    }
}

answer_of!(Quality as quality {
    limit_state: &'static str = quality.limit_state.name();
    efficiency: Option<f64> = quality.efficiency;
    practicality: Option<f64> = quality.practicality;
    proficiency: Option<f64> = quality.proficiency();
    sufficiency: Sufficiency<'_> = Sufficiency(quality);
});

/// p-values; what motions from files do not tell has none.
#[derive(Clone, Copy)]
pub struct Sufficiency<'q>(pub &'q Quality);

answer_of!(Sufficiency<'_> as p {
    magnitude: Option<f64> = None;
    distance: Option<f64> = None;
    epsilon: Option<f64> = None;
    mean_period: Option<f64> = p.0.p_mean_period;
    pgv_over_pga: Option<f64> = p.0.p_velocity_over_acceleration;
});
