//! The equation of motion of a rigid block on contact elements.

use super::audit::Energies;
use super::pad::Pad;

/// The largest number of contact elements under a block.
pub(super) const MAX_CONTACTS: usize = 16;

// Indices into the state. Displacements of the centre of gravity are relative to the base and to
// its position above unloaded pads.
pub(super) const X: usize = 0;
pub(super) const Z: usize = 1;
pub(super) const THETA: usize = 2;
pub(super) const V_X: usize = 3;
pub(super) const V_Z: usize = 4;
pub(super) const OMEGA: usize = 5;
/// Work of the base.
pub(super) const WORK: usize = 6;
/// Dissipated by normal dashpots, tangential dashpots and slip.
pub(super) const DASHPOT: usize = 7;
pub(super) const DRAG: usize = 8;
pub(super) const SLIP: usize = 9;
/// Stretch of the tangential spring of contact i, at `STRETCH + i`.
pub(super) const STRETCH: usize = 10;

pub(super) const LEN: usize = STRETCH + MAX_CONTACTS;

pub(super) type State = [f64; LEN];

/// A straight segment of the motion of the base: to the right, upward.
pub(super) type Line = super::stepper::Line<2>;

/// The state of a contact element.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Grip {
    /// No contact; its surface recovers from `compression_m`, at which a damped cushion was left at
    /// `since_s`.
    Open { since_s: f64, compression_m: f64 },
    /// In contact; its foot does not move.
    Stick,
    /// In contact; its foot slides in this direction (±1).
    Slip(f64),
}

impl Grip {
    pub(super) const UNTOUCHED: Self = Self::Open {
        since_s: 0.0,
        compression_m: 0.0,
    };

    pub(super) fn carries(self) -> bool {
        !matches!(self, Self::Open { .. })
    }
}

/// The block and its supports.
#[derive(Debug, Clone)]
pub(super) struct Body<'a> {
    pub(super) mass: f64,
    /// About the centre of gravity.
    pub(super) inertia: f64,
    pub(super) gravity: f64,
    pub(super) cg_height: f64,
    /// Contact elements from left to right, relative to the centre of gravity.
    pub(super) contacts: Vec<f64>,
    /// One element: its share of the cushion of one edge.
    pub(super) pad: Pad<'a>,
    /// Of one element.
    pub(super) tangential_stiffness: f64,
    pub(super) tangential_damping: f64,
    /// `None`: no slip.
    pub(super) friction: Option<f64>,
}

/// The kinematics of one contact point.
#[derive(Debug, Clone, Copy)]
pub(super) struct Foot {
    /// From the centre of gravity to the point.
    pub(super) arm_x: f64,
    pub(super) arm_z: f64,
    pub(super) compression: f64,
    pub(super) compression_rate: f64,
    pub(super) sliding: f64,
}

/// The functions of the rotation that the place of every contact needs: they take longer to calculate
/// than everything else about a contact, so they are calculated once for each state.
#[derive(Debug, Clone, Copy)]
pub(super) struct Turn {
    sin: f64,
    cos: f64,
    /// 1 − cos θ without cancellation.
    versine: f64,
}

impl Turn {
    pub(super) fn of(y: &State) -> Self {
        let (sin, cos) = y[THETA].sin_cos();
        Self {
            sin,
            cos,
            versine: 2.0 * (0.5 * y[THETA]).sin().powi(2),
        }
    }
}

/// Forces of one contact on the block, upward and to the right.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Load {
    pub(super) normal: f64,
    pub(super) tangential: f64,
    /// Rate of stretch of the tangential spring.
    pub(super) stretching: f64,
}

impl Body<'_> {
    /// Number of entries of the state in use.
    pub(super) fn len(&self) -> usize {
        STRETCH + self.contacts.len()
    }

    pub(super) fn foot(&self, index: usize, y: &State) -> Foot {
        self.foot_turned(index, y, &Turn::of(y))
    }

    /// [`Body::foot`] in a state whose turn is known.
    pub(super) fn foot_turned(
        &self,
        index: usize,
        y: &State,
        &Turn { sin, cos, versine }: &Turn,
    ) -> Foot {
        let xi = self.contacts[index];
        let arm_x = xi * cos - self.cg_height * sin;
        let arm_z = -xi * sin - self.cg_height * cos;
        Foot {
            arm_x,
            arm_z,
            compression: -(y[Z] - xi * sin + self.cg_height * versine),
            compression_rate: -(y[V_Z] - y[OMEGA] * arm_x),
            sliding: y[V_X] + y[OMEGA] * arm_z,
        }
    }

    pub(super) fn load(&self, grip: Grip, foot: &Foot, stretch: f64) -> Load {
        if !grip.carries() {
            return Load::default();
        }
        let normal = self.pad.push(foot.compression, foot.compression_rate);
        let (k, c) = (self.tangential_stiffness, self.tangential_damping);
        let (tangential, stretching) = match grip {
            Grip::Slip(way) => {
                let tangential = -way * self.friction.unwrap_or(0.0) * normal;
                // Without a dashpot the stretch follows from the force, and nothing depends on its
                // rate.
                (
                    tangential,
                    if c > 0.0 {
                        (-tangential - k * stretch) / c
                    } else {
                        foot.sliding
                    },
                )
            }
            _ => (-k * stretch - c * foot.sliding, foot.sliding),
        };
        Load {
            normal,
            tangential,
            stretching,
        }
    }

    /// The time derivative of the state.
    pub(super) fn rates(&self, grips: &[Grip], line: &Line, time_s: f64, y: &State) -> State {
        let mut rates = [0.0; LEN];
        self.write_rates(grips, line, (time_s, y), &mut rates);
        rates
    }

    /// [`Body::rates`], written where a step needs them: a state is longer than most objects use, and
    /// moving it takes a noticeable share of a step.
    pub(super) fn write_rates(
        &self,
        grips: &[Grip],
        line: &Line,
        (time_s, y): (f64, &State),
        rates: &mut State,
    ) {
        rates[..self.len()].fill(0.0);
        let [horizontal, vertical] = line.at(time_s);
        let (mut right, mut up, mut turning) = (0.0, 0.0, 0.0);
        let turn = Turn::of(y);
        for (index, &grip) in grips.iter().enumerate().filter(|(_, grip)| grip.carries()) {
            let foot = self.foot_turned(index, y, &turn);
            let load = self.load(grip, &foot, y[STRETCH + index]);
            right += load.tangential;
            up += load.normal;
            turning += foot.arm_z * load.tangential - foot.arm_x * load.normal;
            rates[STRETCH + index] = load.stretching;
            rates[DASHPOT] +=
                (load.normal - self.pad.elastic(foot.compression)) * foot.compression_rate;
            rates[DRAG] += self.tangential_damping * load.stretching * load.stretching;
            if matches!(grip, Grip::Slip(_)) {
                rates[SLIP] -= load.tangential * self.slipping(&foot, &load);
            }
        }
        (rates[X], rates[Z], rates[THETA]) = (y[V_X], y[V_Z], y[OMEGA]);
        rates[V_X] = right / self.mass - horizontal;
        rates[V_Z] = up / self.mass - self.gravity - vertical;
        rates[OMEGA] = turning / self.inertia;
        rates[WORK] = -self.mass * (horizontal * y[V_X] + vertical * y[V_Z]);
    }

    /// The velocity for the work of slip: that of the sliding part of the foot or, where the
    /// stretch follows from the force, of the whole foot. What the spring stores or releases is
    /// then accounted for when the slip begins and ends.
    fn slipping(&self, foot: &Foot, load: &Load) -> f64 {
        if self.tangential_damping > 0.0 {
            foot.sliding - load.stretching
        } else {
            foot.sliding
        }
    }

    /// Vertical and horizontal acceleration, relative to the base, of the point of the block that
    /// is `(right, up)` of the centre of gravity when the block is upright: (horizontal, vertical).
    pub(super) fn acceleration_of(
        &self,
        (right, up): (f64, f64),
        y: &State,
        rates: &State,
        &Turn { sin, cos, .. }: &Turn,
    ) -> (f64, f64) {
        let (arm_x, arm_z) = (right * cos + up * sin, up * cos - right * sin);
        let (alpha, square) = (rates[OMEGA], y[OMEGA] * y[OMEGA]);
        (
            rates[V_X] + alpha * arm_z - square * arm_x,
            rates[V_Z] - alpha * arm_x - square * arm_z,
        )
    }

    /// Where the energy of the block is.
    pub(super) fn energies(&self, grips: &[Grip], y: &State) -> Energies {
        let speed = y[V_X] * y[V_X] + y[V_Z] * y[V_Z];
        Energies {
            kinetic_j: 0.5 * self.mass * speed + 0.5 * self.inertia * y[OMEGA] * y[OMEGA],
            potential_j: self.mass * self.gravity * y[Z],
            stored_j: self.stored_j(grips, y),
            base_work_j: y[WORK],
            cushion_dissipation_j: y[DASHPOT],
            tangential_dissipation_j: y[DRAG],
            friction_j: y[SLIP],
        }
    }

    /// Energy in cushions and tangential springs; without a dashpot, the energy of a slipping
    /// spring is counted with the slip.
    fn stored_j(&self, grips: &[Grip], y: &State) -> f64 {
        let turn = Turn::of(y);
        let of = |(index, &grip): (usize, &Grip)| {
            let pressed = self
                .pad
                .pressed_j(self.foot_turned(index, y, &turn).compression);
            let sheared = 0.5 * self.tangential_stiffness * y[STRETCH + index].powi(2);
            match grip {
                Grip::Open { .. } => 0.0,
                Grip::Slip(_) if self.tangential_damping == 0.0 => pressed,
                _ => pressed + sheared,
            }
        };
        grips.iter().enumerate().map(of).sum()
    }
}
