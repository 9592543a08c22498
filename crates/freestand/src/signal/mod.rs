//! What is done to a record before it is used: baseline, taper, filter, resampling, rotation, scale.
//!
//! A [`Motion`](crate::motion::Motion) goes in and another comes out; nothing here alters a record unasked.

pub mod baseline;
pub mod filter;
pub mod resample;
pub mod rotate;
pub mod scale;
pub mod taper;
