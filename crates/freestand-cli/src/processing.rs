//! Arguments for what is done to records after they are read.

use std::path::PathBuf;

use clap::Args;
use freestand::signal::baseline::Baseline;
use freestand_input::problem::Problem;
use freestand_input::quantity::Dimension;
use freestand_records::processing::{
    FILTER_ORDER, Processing, Scale, TargetSource, azimuth_deg, parse_baseline, parse_sa_target, parse_target_source,
    read_target,
};

use crate::failure::problem;
use crate::values::{Given, Reads, Values};

/// What is done to records, in the order of these flags; nothing without them.
#[derive(Debug, Clone, Default, Args)]
#[command(next_help_heading = "Processing records, in this order")]
pub(crate) struct ProcessArgs {
    /// Rotate the two horizontal components of a file to this azimuth, clockwise from north
    #[arg(long, any = Dimension::Angle, conflicts_with = "component", hide_short_help = true)]
    pub(crate) azimuth: Option<Given>,
    /// Baseline to remove: mean, pre-event:5s, linear, quadratic, cubic, poly:N, graizer,
    /// graizer:N:5s, boore:T1:T2
    ///
    /// mean and pre-event remove a constant: the mean of the record or of its first seconds.
    /// linear, quadratic, cubic and poly:N remove a polynomial fitted to the acceleration. graizer
    /// removes the derivative of a polynomial fitted to the velocity, of degree 2 or N, from 0 s or
    /// from the time given (Graizer 1979). boore removes two offsets, one from T1 to T2 and one
    /// after T2, so that the velocity ends near zero (Iwan 1985, Boore 2001).
    #[arg(long, value_name = "BASELINE", read = parse_baseline, hide_short_help = true)]
    pub(crate) baseline: Option<Given<Baseline>>,
    /// Length of the cosine taper at each end, as a share of the record
    #[arg(long, any = Dimension::Ratio, hide_short_help = true)]
    pub(crate) taper: Option<Given>,
    /// Corner frequency of a high-pass filter
    ///
    /// A Butterworth filter is run forwards and backwards: it shifts nothing in time and halves the
    /// amplitude at the corner. Zeros are added before and after the record for a time of
    /// 1.5 × order / corner, and are kept, so that the record starts earlier (Boore 2005).
    #[arg(long, any = Dimension::Frequency, hide_short_help = true)]
    pub(crate) low_cut: Option<Given>,
    /// Corner frequency of a low-pass filter of the same kind
    #[arg(long, any = Dimension::Frequency, hide_short_help = true)]
    pub(crate) high_cut: Option<Given>,
    /// Order of the filters, from 1 to 10 [default: 4]
    #[arg(long, value_name = "N", read = filter_order, hide_short_help = true)]
    pub(crate) filter_order: Option<Given<u32>>,
    /// New time step, by band-limited interpolation (by straight lines if samples are unevenly
    /// spaced)
    #[arg(long, any = Dimension::Time, hide_short_help = true)]
    pub(crate) resample: Option<Given>,
    /// Scale to this peak acceleration, such as "0.3 g"
    #[arg(long, any = Dimension::Acceleration, conflicts_with = "scale", hide_short_help = true)]
    pub(crate) scale_to: Option<Given>,
    /// Scale to a pseudo-acceleration, such as "0.4 g at 1.2 s", or "0.4 g at 1.2 s, 2 %" for a
    /// damping other than 5 %
    #[arg(
        long,
        value_name = "ACCELERATION at PERIOD",
        read = parse_sa_target,
        conflicts_with_all = ["scale", "scale_to"],
        hide_short_help = true
    )]
    pub(crate) scale_to_sa: Option<Given<Scale>>,
    /// Scale to the spectrum of a file, such as target.csv; "target.csv, 0.1 s to 2 s, 2 %" uses a
    /// part of it and a damping of 2 %
    ///
    /// The file has columns of periods and pseudo-accelerations with units in their headings, such
    /// as "period [s]; PSA [g]", or is the spectrum.csv of `freestand motion spectrum --out`. The
    /// factor gives the least squares of ln PSA, in which every period of the file has the same
    /// weight. The damping is that of the file if it states exactly one, and otherwise 5 %.
    #[arg(
        long,
        value_name = "FILE[, PERIODS][, DAMPING]",
        read = parse_target_source,
        conflicts_with_all = ["scale", "scale_to", "scale_to_sa"],
        hide_short_help = true
    )]
    pub(crate) scale_to_spectrum: Option<Given<TargetSource>>,
}

impl ProcessArgs {
    /// The file of the spectrum that records are scaled to.
    pub(crate) fn target_path(&self) -> Option<PathBuf> {
        self.scale_to_spectrum.as_ref()?.0.as_ref().ok().map(|source| source.path.clone())
    }

    /// What is to be done; what is wrong goes into `values`.
    pub(crate) fn processing(&self, keep_mean: bool, scale_ratio: f64, values: &mut Values) -> Processing {
        let target = |target_m_s2| Scale::Peak { target_m_s2 };
        let peak = values.read(&self.scale_to).map(target);
        let sa = values.read(&self.scale_to_sa);
        let source = values.read(&self.scale_to_spectrum);
        let spectrum = source.and_then(|source| values.keep("scale-to-spectrum", read_target(&source)));
        let processing = Processing {
            keep_mean,
            azimuth_deg: values.read(&self.azimuth).map(azimuth_deg),
            baseline: values.read(&self.baseline),
            taper_ratio: values.read(&self.taper),
            low_cut_hz: values.read(&self.low_cut),
            high_cut_hz: values.read(&self.high_cut),
            filter_order: self.order(values),
            resample_dt_s: values.read(&self.resample),
            scale: peak.or(sa).or(spectrum.map(Scale::Spectrum)).unwrap_or(Scale::Factor(scale_ratio)),
        };
        for (key, problem) in processing.problems() {
            values.keep::<()>(&key.replace('_', "-"), Err(problem));
        }
        processing
    }

    fn order(&self, values: &mut Values) -> u32 {
        let order = values.read(&self.filter_order);
        if self.filter_order.is_some() && self.low_cut.is_none() && self.high_cut.is_none() {
            values.push(problem("--filter-order without a filter", "give --low-cut or --high-cut"));
        }
        order.unwrap_or(FILTER_ORDER)
    }
}

fn filter_order(text: &str) -> Result<u32, Problem> {
    let wrong = |_| problem(format!("\"{text}\" is not a whole number"), "write 4, or any other order from 1 to 10");
    text.trim().parse().map_err(wrong)
}
