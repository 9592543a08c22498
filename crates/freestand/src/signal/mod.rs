//! The processing of a record before use: baseline, taper, filter, resampling, rotation, scale.
//!
//! Every function takes a [`Motion`](crate::motion::Motion) and returns a new one; no processing is
//! automatic.

pub mod baseline;
pub mod filter;
pub mod resample;
pub mod rotate;
pub mod scale;
pub mod taper;
