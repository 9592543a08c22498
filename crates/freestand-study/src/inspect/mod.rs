//! What is in record files, the response spectra of one motion and those of two components over all
//! directions: request → report.

mod damped_spectrum;
mod info;
mod record_figure;
mod rotd;
mod spectrum;

mod spectrum_figure;

pub use damped_spectrum::DampedSpectrum;
pub use info::{Contents, InfoReport, InfoRequest, MotionInfo, MotionMeasures, info};
pub(crate) use record_figure::record;
pub use record_figure::{Words, record_figure};
pub use rotd::{PercentileSpectrum, RotdReport, RotdRequest, check_percentiles, rotd};
pub use spectrum::{SpectrumReport, SpectrumRequest, check_upsampling, spectrum};
pub use spectrum_figure::response_spectrum_figure;

#[cfg(test)]
mod tests;
