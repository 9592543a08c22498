//! Many worlds of one object on its pads at once: the kernel of verdicts on pads.
//!
//! The same block on two edges as [`rock_compliant`](super::rock_compliant), on Kelvin–Voigt pads
//! without slip, k_t = k. Worlds stand in lanes, sixteen abreast, each with its own block, pads and
//! motion:
//!
//! * **Both edges on their pads** (`linear`, `stretch`, `reach`, `pressed`): the linear equations of
//!   (x, z, θ), exact over eight samples at once; the samples (`through`) and the steps in between
//!   (`look`) are taken where a bound says that one may set a new extreme. Their first way through the whole motion is the screen: U, the largest part of its load
//!   at rest that an edge loses. Where U ≤ 1, that is all.
//! * **Else** (`lifted`), from the first 0.15 of a load lost on: exact sines, Runge–Kutta steps of a
//!   third of a radian of the fastest vibration, shortened to the events of contacts: let go at
//!   N = 0, touched where the edge meets the surface of its pad, which recovers as its dashpot
//!   allows. Back to the linear equations when both edges have carried nine tenths of their load at
//!   rest for half a period of rocking; z and the stretch of both springs go with it.
//! * **Fallen** beyond 1.2 rad, or half of the way from the balance point to the floor, if that is
//!   more.
//!
//! Every operation of a lane is its own, and what is fused is fused on every vector unit: no result
//! depends on the other worlds of a call, their order, the number of threads or the processor.

mod body;
mod crew;
mod each;
mod lifted;
mod linear;
mod look;
mod pressed;
mod reach;
mod stand;
mod stretch;
mod through;
mod world;

#[cfg(test)]
mod tests;

use rayon::prelude::*;

use super::CompliantError;
use crate::block::Block;
use crate::motion::Motion;
use crate::rocking::Base;
use crate::vector::Column;
use body::Body;
use world::World;

pub use stand::{pad_uplift_threshold_m_s2, rocking_frequency_hz};

/// Worlds side by side.
const LANES: usize = 16;

/// A number of each.
type Lane = Column<LANES>;

/// The most worlds that a thread takes at once: enough to fill the lanes that worlds have left.
const WORLDS: usize = 1024;

/// One world: an object on its pads, and what shakes it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CompliantWorld<'a> {
    /// The object.
    pub block: Block,
    /// Its mass \[kg\].
    pub mass_kg: f64,
    /// k: of the pads under one edge, upright and sideways \[N/m\].
    pub stiffness_n_m: f64,
    /// c: of the pads under one edge, upright \[N s/m\].
    pub damping_n_s_m: f64,
    /// Accelerations of the base.
    pub motion: Base<'a>,
}

/// What an object on pads did.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PadOutcome {
    /// Both edges stayed on their pads all the time.
    StayedOn,
    /// An edge let go of its pad.
    LetGo,
    /// It overturned.
    Overturned,
}

/// What is left of a history of an object on its pads.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CompliantSummary {
    /// What it did.
    pub outcome: PadOutcome,
    /// U: largest part of its load at rest that an edge would lose over the whole motion if pads could
    /// pull; an edge lets go where it passes 1. For a centred block without vertical motion
    /// max |θ + (c/k) θ̇| k b/(m g), in proportion to the motion.
    pub pad_uplift_ratio: f64,
    /// Largest height of an edge above its unloaded pad \[m\]; 0 where none rose above it.
    pub lift_m: f64,
    /// Largest upward acceleration of the left and the right edge during contact, in the inertial
    /// frame \[m/s²\].
    pub peak_edge_accelerations_m_s2: [f64; 2],
    /// Contacts that began.
    pub touch_count: usize,
    /// Largest speed of an edge at a touch \[m/s\].
    pub touch_speed_m_s: f64,
    /// Δv: largest sum, over the touches, of the speed at the touch and the upward speed at the end of
    /// its pulse \[m/s\].
    pub velocity_change_m_s: f64,
    /// Duration of the pulse with the highest peak, from the touch until the edge is no longer
    /// accelerated upward \[s\]: that of the half-sine to compare with.
    pub pulse_duration_s: Option<f64>,
    /// Duration of the contact with that pulse, where it ended \[s\]; an edge about which the block turns on stays
    /// for much longer than a pulse.
    pub contact_duration_s: Option<f64>,
    /// Largest compression of a pad under an edge \[m\].
    pub peak_compression_m: f64,
    /// Time at which an edge first let go of its pad, at the start of the step in which it did \[s\].
    pub let_go_time_s: Option<f64>,
    /// Time at which an edge was first above its unloaded pad, to a step \[s\].
    pub first_uplift_time_s: Option<f64>,
    /// Time at which the object counts as overturned \[s\].
    pub overturn_time_s: Option<f64>,
}

impl CompliantSummary {
    /// The larger of the two: a_edge.
    pub fn peak_edge_acceleration_m_s2(&self) -> f64 {
        self.peak_edge_accelerations_m_s2[0].max(self.peak_edge_accelerations_m_s2[1])
    }
}

/// Follows many worlds of objects on pads through their motions, and on until both edges hold or the object has
/// fallen, in the order given, on the current rayon pool.
///
/// A result does not depend on the other worlds, their order, the number of threads or the
/// processor's vector units. Start from rest on the pads; linear pads, no slip: for everything else
/// there is [`rock_compliant`](super::rock_compliant), the reference.
///
/// # Accuracy
/// Against the reference at `standard`, 200 synthetic motions of 1 to 2 times the threshold under each
/// of six objects of 25 to 400 kg (`campaign_of_both_solvers`):
///
/// | ζ of an edge | lift, \|Δ ln\|: median | 90 % | edge peak: median | 90 % | shares of falls differ by |
/// |---|---|---|---|---|---|
/// | 0.1, 0.2 | up to 1e-4 | up to 0.018 | up to 0.0011 | up to 0.017 | up to 0.005 |
/// | 0.05 | up to 2e-4 | up to 0.07 | up to 0.0021 | up to 0.09 | up to 0.005 |
///
/// At ζ = 0.05 one history in ten amplifies the smallest change (the reference at `fast` differs from
/// that at `standard` by up to 0.05); the 16, 50 and 84 % quantiles are within 4.1 %. An edge let go in
/// both solvers or in neither, in every history.
///
/// U is exact to first order: motions scaled to U = 0.985 leave both edges on their pads, at 1.03 one
/// lets go. Above 1 by less than a hundredth it may be that none does: the outcome counts.
///
/// # Reference
/// Runge–Kutta's classical method: Hairer, Nørsett and Wanner (1993), Solving ODEs I, II.1, Table 1.2.
/// The linear equations by the exponential of their matrix with the motion as further states: Van Loan
/// (1978).
///
/// # Errors
/// Each world has its own: numbers out of range, pads that do not keep the block upright, a motion
/// that is missing or whose components differ in time step or length, a history of too many steps.
///
/// # Example
/// A rack of 2.0 m × 0.9 m and 400 kg on 1500 N/mm under each edge, one cycle of 2.5 Hz: 0.2 g leave
/// it on its pads, 0.6 g do not.
/// ```
/// use freestand::block::Block;
/// use freestand::compliant::{CompliantWorld, PadOutcome, rock_compliant_many};
/// use freestand::{motion::Motion, rocking::Base};
/// let cycle = (0..=80).map(|i| (std::f64::consts::TAU * f64::from(i) / 80.0).sin());
/// let weak = Motion::new(0.005, cycle.map(|a| 0.2 * freestand::G0_M_S2 * a).collect())?;
/// let strong = weak.scaled(3.0)?;
/// let world = |motion| CompliantWorld {
///     block: Block::uniform(2.0, 0.9).unwrap(),
///     mass_kg: 400.0,
///     stiffness_n_m: 1.5e6,
///     damping_n_s_m: 4900.0,
///     motion: Base { horizontal: Some(motion), vertical: None },
/// };
/// let found = rock_compliant_many(&[world(&weak), world(&strong)], freestand::G0_M_S2);
/// let (weak, strong) = (found[0].clone()?, found[1].clone()?);
/// assert!(weak.outcome == PadOutcome::StayedOn && weak.pad_uplift_ratio < 1.0);
/// assert!(strong.outcome == PadOutcome::LetGo && strong.lift_m > 0.0);
/// assert!((strong.pad_uplift_ratio / weak.pad_uplift_ratio - 3.0).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn rock_compliant_many(
    worlds: &[CompliantWorld],
    gravity_m_s2: f64,
) -> Vec<Result<CompliantSummary, CompliantError>> {
    rock_compliant_many_on(pulp::Arch::new(), worlds, gravity_m_s2)
}

/// [`rock_compliant_many`] on a chosen generation of vector units, for tests and benchmarks: the results are the
/// same bits on all.
#[doc(hidden)]
pub fn rock_compliant_many_on(
    arch: pulp::Arch,
    worlds: &[CompliantWorld],
    gravity_m_s2: f64,
) -> Vec<Result<CompliantSummary, CompliantError>> {
    // Neighbouring worlds resemble each other, so groups of them are assigned to the batches in turn: all batches
    // then take about equally long.
    let threads = rayon::current_num_threads().max(1);
    let rounds = worlds.len().div_ceil(threads * WORLDS);
    let groups: Vec<&[CompliantWorld]> = worlds.chunks(LANES).collect();
    let batches = (threads * rounds).min(groups.len());
    let results: Vec<Vec<_>> = (0..batches)
        .into_par_iter()
        .with_max_len(1)
        .map(|batch| {
            let assigned = groups.iter().skip(batch).step_by(batches).copied();
            follow(arch, assigned.flatten(), gravity_m_s2)
        })
        .collect();
    // Back in the order given.
    let mut remaining: Vec<_> = results.into_iter().map(Vec::into_iter).collect();
    let mut ordered = Vec::with_capacity(worlds.len());
    for (place, group) in groups.iter().enumerate() {
        ordered.extend(remaining[place % batches].by_ref().take(group.len()));
    }
    ordered
}

fn follow<'a>(
    arch: pulp::Arch,
    worlds: impl Iterator<Item = &'a CompliantWorld<'a>>,
    gravity_m_s2: f64,
) -> Vec<Result<CompliantSummary, CompliantError>> {
    let (mut ready, mut errors) = (Vec::new(), Vec::new());
    for world in worlds {
        match prepare(world, gravity_m_s2) {
            Ok(world) => {
                ready.push(world);
                errors.push(None);
            }
            Err(error) => errors.push(Some(error)),
        }
    }
    crew::run(arch, &mut ready);
    let mut done = ready.into_iter().map(World::result);
    let missing = || Err(CompliantError::Duration { duration_s: 0.0 });
    errors
        .into_iter()
        .map(|error| error.map_or_else(|| done.next().unwrap_or_else(missing), Err))
        .collect()
}

fn prepare<'a>(world: &CompliantWorld<'a>, gravity_m_s2: f64) -> Result<World<'a>, CompliantError> {
    let Base {
        horizontal,
        vertical,
    } = world.motion;
    let longest = horizontal
        .or(vertical)
        .filter(|motion| motion.duration_s() > 0.0);
    let motion = longest.ok_or(CompliantError::Duration { duration_s: 0.0 })?;
    if let (Some(h), Some(v)) = (horizontal, vertical)
        && (h.dt_s() != v.dt_s() || h.accel_m_s2().len() != v.accel_m_s2().len())
    {
        return Err(CompliantError::VerticalMismatch);
    }
    let samples = |motion: Option<&'a Motion>| motion.map_or(&[][..], Motion::accel_m_s2);
    let body = Body::new(world, motion, gravity_m_s2)?;
    Ok(World::new(
        body,
        motion,
        samples(horizontal),
        samples(vertical),
    ))
}
