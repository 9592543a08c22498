//! The rocking of free-standing blocks: the part of freestand that takes longest to compile and
//! changes least.
//!
//! | what | module |
//! |---|---|
//! | the object, as a rigid block on two edges | [`block`] |
//! | equally spaced samples of acceleration | [`motion`] |
//! | walls beside it | [`wall`] |
//! | rotation against time: the scalar solver and the vector kernel | [`rocking`] |
//!
//! The crate `freestand` contains the other models and re-exports these modules; signs and units
//! are described there. This crate uses no files, clock, environment or output.

pub mod block;
pub mod motion;
mod polynomial;
pub mod rocking;
#[doc(hidden)]
pub mod vector;
pub mod wall;

/// Standard acceleration of gravity, the unit "g" \[m/s²\].
pub const G0_M_S2: f64 = 9.80665;
