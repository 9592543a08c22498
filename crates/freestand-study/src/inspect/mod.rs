//! What is in record files, the response spectra of one motion and those of two components over all
//! directions: request → report.

mod damped_spectrum;
mod info;
mod rotd;
mod spectrum;

pub use damped_spectrum::DampedSpectrum;
pub use info::{Contents, InfoReport, InfoRequest, MotionInfo, MotionMeasures, info};
pub use rotd::{PercentileSpectrum, RotdReport, RotdRequest, check_percentiles, rotd};
pub use spectrum::{SpectrumReport, SpectrumRequest, check_upsampling, spectrum};

#[cfg(test)]
mod tests;
