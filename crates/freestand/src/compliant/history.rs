//! The history of a block on its cushions, sampled for plots and tables.

use super::{CompliantRocking, Piece};

/// The block at one instant.
#[derive(Debug, Clone, PartialEq)]
pub struct CompliantPoint {
    /// Time \[s\].
    pub time_s: f64,
    /// θ \[rad\].
    pub theta_rad: f64,
    /// ω \[rad/s\].
    pub omega_rad_s: f64,
    /// Displacement of the centre of gravity relative to the base, to the right \[m\].
    pub x_m: f64,
    /// The same, upward, from its position above unloaded cushions \[m\].
    pub z_m: f64,
    /// Upward acceleration of the left and the right edge in the inertial frame \[m/s²\].
    pub edge_accelerations_m_s2: [f64; 2],
    /// (Horizontal, vertical) accelerations of the requested points in the inertial frame \[m/s²\].
    pub point_accelerations_m_s2: Vec<(f64, f64)>,
    /// (To the right, upward) forces of the contact elements on the block, from left to
    /// right \[N\].
    pub contact_forces_n: Vec<(f64, f64)>,
}

/// Collects a history at a fixed time step from the pieces that [`super::rock_compliant_observed`]
/// passes on.
#[derive(Debug, Clone)]
pub struct CompliantRecorder {
    dt_s: f64,
    base_width_m: f64,
    points_m: Vec<(f64, f64)>,
    contacts: usize,
    points: Vec<CompliantPoint>,
    sampled: usize,
}

impl CompliantRecorder {
    /// A recorder that samples at intervals of `dt_s` > 0, with the accelerations of the points
    /// `points_m` (from the left edge, above the base).
    pub fn new(dt_s: f64, base_width_m: f64, points_m: &[(f64, f64)], contacts: usize) -> Self {
        Self {
            dt_s,
            base_width_m,
            points_m: points_m.to_vec(),
            contacts,
            points: Vec::new(),
            sampled: 0,
        }
    }

    /// Adds the next piece.
    pub fn observe(&mut self, piece: &Piece<'_, '_>) {
        let end_s = piece.start_s() + piece.length_s();
        while self.sampled as f64 * self.dt_s <= end_s {
            let time_s = self.sampled as f64 * self.dt_s;
            let share = ((time_s - piece.start_s()) / piece.length_s()).clamp(0.0, 1.0);
            // Before its first piece a block at rest is in its initial state.
            self.points.push(self.point(piece, time_s, share));
            self.sampled += 1;
        }
    }

    fn point(&self, piece: &Piece<'_, '_>, time_s: f64, share: f64) -> CompliantPoint {
        let (theta_rad, omega_rad_s) = piece.rotation(share);
        let (x_m, z_m) = piece.displacement_m(share);
        let edge = |x_m: f64| piece.acceleration_m_s2(x_m, 0.0, share).1;
        CompliantPoint {
            time_s,
            theta_rad,
            omega_rad_s,
            x_m,
            z_m,
            edge_accelerations_m_s2: [edge(0.0), edge(self.base_width_m)],
            point_accelerations_m_s2: self
                .points_m
                .iter()
                .map(|&(x, z)| piece.acceleration_m_s2(x, z, share))
                .collect(),
            contact_forces_n: (0..self.contacts)
                .filter_map(|index| {
                    piece
                        .contact(index, share)
                        .map(|(right, up, _)| (right, up))
                })
                .collect(),
        }
    }

    /// The samples; for a block that rests to the end, the last ones repeat its state of rest.
    pub fn finish(mut self, rocking: &CompliantRocking) -> Vec<CompliantPoint> {
        while let Some(last) = self.points.last().cloned()
            && self.sampled as f64 * self.dt_s < rocking.end_time_s
        {
            self.points.push(CompliantPoint {
                time_s: self.sampled as f64 * self.dt_s,
                ..last
            });
            self.sampled += 1;
        }
        self.points
    }
}
