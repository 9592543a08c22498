//! The pulses of landings in a history of the solver for any contact law, as the kernel of linear pads
//! reports them: an edge about which the object turns on stays in contact for much longer.

use crate::compliant::{CompliantRocking, EdgeSide, Piece};

const EDGES: [EdgeSide; 2] = [EdgeSide::Left, EdgeSide::Right];

/// Upward acceleration of an edge that presses on its pad, without a pause.
#[derive(Debug, Clone, Copy)]
struct Pulse {
    edge: EdgeSide,
    start_s: f64,
    end_s: f64,
    peak_m_s2: f64,
    /// Integral of the acceleration \[m/s\].
    change_m_s: f64,
}

/// Watches the edges through a history.
pub(super) struct Pulses {
    edges_m: [f64; 2],
    open: [Option<Pulse>; 2],
    hardest: Option<Pulse>,
    velocity_change_m_s: f64,
}

impl Pulses {
    /// For a base from 0 to `base_width_m`.
    pub(super) fn new(base_width_m: f64) -> Self {
        Self {
            edges_m: [0.0, base_width_m],
            open: [None; 2],
            hardest: None,
            velocity_change_m_s: 0.0,
        }
    }

    pub(super) fn observe(&mut self, piece: &Piece<'_, '_>) {
        let (start_s, length_s) = (piece.start_s(), piece.length_s());
        for (index, edge) in EDGES.into_iter().enumerate() {
            let presses = piece
                .contact(index, 0.5)
                .is_some_and(|(_, up_n, _)| up_n > 0.0);
            if !presses {
                self.end(index);
                continue;
            }
            let at = |share: f64| piece.acceleration_m_s2(self.edges_m[index], 0.0, share).1;
            let (before, after) = (at(0.0), at(1.0));
            if before <= 0.0 && after <= 0.0 {
                self.end(index);
                continue;
            }
            let between = at(0.5);
            // The straight line between the ends tells where a pulse begins or ends.
            let turn_s = start_s + length_s * (before / (before - after)).clamp(0.0, 1.0);
            let (from_s, to_s) = match (before > 0.0, after > 0.0) {
                (true, true) => (start_s, start_s + length_s),
                (true, false) => (start_s, turn_s),
                _ => (turn_s, start_s + length_s),
            };
            let mean_m_s2 = match (before > 0.0, after > 0.0) {
                (true, true) => (before + 4.0 * between + after) / 6.0,
                _ => 0.5 * before.max(after),
            };
            let none = Pulse {
                edge,
                start_s: from_s,
                end_s: to_s,
                peak_m_s2: 0.0,
                change_m_s: 0.0,
            };
            let pulse = self.open[index].get_or_insert(none);
            pulse.end_s = to_s;
            pulse.peak_m_s2 = pulse.peak_m_s2.max(before).max(between).max(after);
            pulse.change_m_s += mean_m_s2 * (to_s - from_s);
            if after <= 0.0 {
                self.end(index);
            }
        }
    }

    fn end(&mut self, index: usize) {
        let Some(pulse) = self.open[index].take() else {
            return;
        };
        self.velocity_change_m_s = self.velocity_change_m_s.max(pulse.change_m_s);
        if self
            .hardest
            .is_none_or(|hardest| pulse.peak_m_s2 > hardest.peak_m_s2)
        {
            self.hardest = Some(pulse);
        }
    }

    /// Δv of the pulse with the most \[m/s\], and the duration of the one with the highest peak, from the
    /// touch on \[s\].
    pub(super) fn found(mut self, history: &CompliantRocking) -> (f64, Option<f64>) {
        (0..EDGES.len()).for_each(|index| self.end(index));
        // What never lets go of its pads has no landings.
        if history.touches.is_empty() {
            return (0.0, None);
        }
        let duration_s = self.hardest.map(|pulse| {
            let own = history
                .touches
                .iter()
                .filter(|touch| touch.edge == pulse.edge && touch.time_s <= pulse.start_s);
            let mut held =
                own.filter(|touch| touch.end_time_s.is_none_or(|end_s| end_s >= pulse.start_s));
            pulse.end_s
                - held.next_back().map_or(pulse.start_s, |touch| {
                    touch.time_s.max(pulse.start_s - FLAT_S)
                })
        });
        (self.velocity_change_m_s, duration_s)
    }
}

/// The longest time from a touch to the upward acceleration that is part of its pulse \[s\]: later ones
/// are vibrations of an edge that stays.
const FLAT_S: f64 = 0.005;

#[cfg(test)]
mod tests {
    use crate::G0_M_S2;
    use crate::block::Block;
    use crate::compliant::{
        CompliantAccuracy, CompliantBase, CompliantOptions, CompliantWorld, rock_compliant_many,
        rock_compliant_observed,
    };
    use crate::cushion::{ContactLaw, Cushion};
    use crate::motion::Motion;
    use crate::rocking::Base;

    use super::Pulses;

    /// The kernel of linear pads and the other solver see the same landings.
    #[test]
    fn pulses_are_those_of_the_kernel() {
        let sample = |i: usize| {
            if i <= 100 {
                4.5 * (std::f64::consts::TAU * i as f64 / 100.0).sin()
            } else {
                0.0
            }
        };
        let motion = Motion::new(0.01, (0..400).map(sample).collect()).unwrap();
        let base = Base {
            horizontal: Some(&motion),
            vertical: None,
        };
        let (mass_kg, stiffness_n_m) = (100.0, 4e6);
        for (thickness_m, damping_ratio) in [(0.7, 0.1), (0.7, 0.2), (0.65, 0.05)] {
            let block = Block::uniform(1.8, thickness_m).unwrap();
            let damping_n_s_m = 2.0 * damping_ratio * f64::sqrt(stiffness_n_m * mass_kg);
            let world = CompliantWorld {
                block,
                mass_kg,
                stiffness_n_m,
                damping_n_s_m,
                motion: base,
            };
            let kernel = rock_compliant_many(&[world], G0_M_S2).remove(0).unwrap();
            let cushion = Cushion::new(ContactLaw::KelvinVoigt {
                stiffness_n_m,
                damping_n_s_m,
            })
            .unwrap();
            let options = CompliantOptions {
                accuracy: CompliantAccuracy::Fast,
                ..CompliantOptions::default()
            };
            let mut pulses = Pulses::new(thickness_m);
            let on_pads = CompliantBase::new(mass_kg, cushion);
            let history = rock_compliant_observed(&block, &on_pads, base, &options, |piece| {
                pulses.observe(piece)
            })
            .unwrap();
            let (change_m_s, duration_s) = pulses.found(&history);
            // Steps of a tenth of a pulse, of which the ends lie on straight lines.
            let is_near = |got: f64, expected: f64| (got / expected - 1.0).abs() < 0.05;
            let expected_s = kernel.pulse_duration_s.unwrap();
            assert!(
                is_near(duration_s.unwrap(), expected_s),
                "{duration_s:?} {expected_s}"
            );
            assert!(
                is_near(change_m_s, kernel.velocity_change_m_s),
                "{change_m_s} {}",
                kernel.velocity_change_m_s
            );
            let edge_m_s2 = kernel.peak_edge_acceleration_m_s2();
            assert!(
                is_near(history.peak_edge_acceleration_m_s2(), edge_m_s2),
                "{edge_m_s2}"
            );
        }
    }
}
