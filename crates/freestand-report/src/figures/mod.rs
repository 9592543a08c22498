//! Figures, as SVG and PNG: of a study, and of the answers to single questions.
//!
//! Colours are those of Okabe and Ito; curves also differ in dashes and markers.

mod code_spectrum;
mod floor_response;
mod floor_spectra;
mod fragility;
mod history;
mod kind;
mod laboratory;
mod losses;
mod matched;
mod of_study;
mod profile;
mod record;
mod response;
mod response_spectrum;
mod risk;
mod runs;
mod shock_spectrum;
mod slide;
mod spatial;
mod trace;
mod vary;

pub use code_spectrum::code_spectrum_figure;
pub use floor_response::floor_response_figure;
pub use fragility::curves_figure;
pub use history::rock_figure;
pub use kind::{FigureKind, MAX_RECORDS};
pub use laboratory::{drop_figures, static_figure};
pub use losses::losses_figure;
pub use matched::{MatchedPicture, fit_figure, matched_figure};
pub use of_study::{figure, figure_kinds, figures};
pub use profile::profile_figure;
pub use record::{Words, info_figure, record_figure};
pub use response_spectrum::spectrum_figure;
pub use risk::risk_figure;
pub use runs::{ida_figure, measures_figure, residuals_figure};
pub use shock_spectrum::{boundary_figure, spectra_figure};
pub use slide::{plane_slide_figure, slide_figure};
pub use spatial::{hull_figure, spatial_figure, stack_figure};
pub use trace::trace_figure;
