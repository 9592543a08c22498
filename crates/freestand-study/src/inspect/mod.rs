//! What is in record files, the response spectrum of one of them and those of two components over all directions: request
//! → report.

mod failed;
mod info;
mod rotd;
mod spectrum;

pub use failed::Failed;
pub use info::{InfoReport, InfoRequest, MotionInfo, info};
pub use rotd::{PercentileSpectrum, RotdReport, RotdRequest, rotd};
pub use spectrum::{DampedSpectrum, SpectrumReport, SpectrumRequest, check_upsampling, spectrum};

#[cfg(test)]
mod tests;
