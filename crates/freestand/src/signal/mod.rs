//! The processing of a record before use: baseline, taper, filter, resampling, rotation, scale.
//!
//! Every function takes a [`Motion`](crate::motion::Motion) and returns another; none changes a
//! record without being asked to.

pub mod baseline;
pub mod filter;
pub mod resample;
pub mod rotate;
pub mod scale;
pub mod taper;
