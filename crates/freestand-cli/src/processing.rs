//! Arguments for what is done to records after they are read.

use clap::Args;
use freestand_input::quantity::Dimension;
use freestand_records::processing::{
    FILTER_ORDER, Processing, Scale, azimuth_deg, parse_baseline, parse_sa_target, parse_target_source, read_target,
};

use crate::values::Values;

/// What is done to records, in the order of these flags; nothing without them.
#[derive(Debug, Clone, Default, Args)]
#[command(next_help_heading = "Processing records, in this order")]
pub(crate) struct ProcessArgs {
    /// Turn the two horizontal components of a file to this azimuth, clockwise from north
    #[arg(
        long,
        value_name = "ANGLE",
        conflicts_with = "component",
        allow_hyphen_values = true,
        hide_short_help = true
    )]
    pub(crate) azimuth: Option<String>,
    /// Baseline to remove: mean, pre-event:5s, linear, quadratic, cubic, poly:N, graizer, graizer:N:5s, boore:T1:T2
    ///
    /// mean, and pre-event (of the first seconds): a constant. linear, quadratic, cubic, poly:N: a polynomial fitted to
    /// the acceleration. graizer: the derivative of a polynomial fitted to the velocity, of degree 2 or N, from 0 s or
    /// another time on (Graizer 1979). boore: two offsets, from T1 to T2 and after T2, so that the velocity ends about
    /// zero (Iwan 1985, Boore 2001).
    #[arg(long, value_name = "BASELINE", hide_short_help = true)]
    pub(crate) baseline: Option<String>,
    /// Cosine taper over this share of the record at each end
    #[arg(long, value_name = "SHARE", allow_hyphen_values = true, hide_short_help = true)]
    pub(crate) taper: Option<String>,
    /// Corner of a high-pass filter
    ///
    /// Butterworth, forwards and backwards: no shift in time, half the amplitude at the corner. Zeros for 1.5 × order /
    /// corner are put before and after the record and kept, so that it starts earlier (Boore 2005).
    #[arg(long, value_name = "FREQUENCY", allow_hyphen_values = true, hide_short_help = true)]
    pub(crate) low_cut: Option<String>,
    /// Corner of a low-pass filter, of the same kind
    #[arg(long, value_name = "FREQUENCY", allow_hyphen_values = true, hide_short_help = true)]
    pub(crate) high_cut: Option<String>,
    /// Order of the filters, 1 to 10 [default: 4]
    #[arg(long, value_name = "N", allow_hyphen_values = true, hide_short_help = true)]
    pub(crate) filter_order: Option<String>,
    /// New time step: band-limited interpolation; straight lines where the samples are unevenly spaced
    #[arg(long, value_name = "TIME", allow_hyphen_values = true, hide_short_help = true)]
    pub(crate) resample: Option<String>,
    /// Scale to this largest acceleration, such as "0.3 g"
    #[arg(
        long,
        value_name = "ACCELERATION",
        conflicts_with = "scale",
        allow_hyphen_values = true,
        hide_short_help = true
    )]
    pub(crate) scale_to: Option<String>,
    /// Scale to a pseudo-acceleration, such as "0.4 g at 1.2 s", or "0.4 g at 1.2 s, 2 %" for another damping than 5 %
    #[arg(
        long,
        value_name = "ACCELERATION at PERIOD",
        conflicts_with_all = ["scale", "scale_to"],
        allow_hyphen_values = true,
        hide_short_help = true
    )]
    pub(crate) scale_to_sa: Option<String>,
    /// Scale to a spectrum: a file, or "target.csv, 0.1 s to 2 s, 2 %" for part of it and for a damping
    ///
    /// The file has columns of periods and pseudo-accelerations with units in their headings, such as "period [s]; PSA [g]",
    /// or is the spectrum.csv of `freestand motion spectrum --out`. The factor is that of the least squares of ln PSA, in
    /// which every period of the file counts the same. The damping is that of the file where it states one only, else 5 %.
    #[arg(
        long,
        value_name = "FILE[, PERIODS][, DAMPING]",
        conflicts_with_all = ["scale", "scale_to", "scale_to_sa"],
        hide_short_help = true
    )]
    pub(crate) scale_to_spectrum: Option<String>,
}

impl ProcessArgs {
    /// The flags that are given, without their dashes.
    pub(crate) fn given(&self) -> impl Iterator<Item = &'static str> {
        let flags = [
            ("azimuth", &self.azimuth),
            ("baseline", &self.baseline),
            ("taper", &self.taper),
            ("low-cut", &self.low_cut),
            ("high-cut", &self.high_cut),
            ("filter-order", &self.filter_order),
            ("resample", &self.resample),
            ("scale-to", &self.scale_to),
            ("scale-to-sa", &self.scale_to_sa),
            ("scale-to-spectrum", &self.scale_to_spectrum),
        ];
        flags.into_iter().filter(|(_, value)| value.is_some()).map(|(name, _)| name)
    }

    /// What is to be done; what is wrong goes into `values`.
    pub(crate) fn processing(&self, keep_mean: bool, scale_ratio: f64, values: &mut Values) -> Processing {
        let target = |target_m_s2| Scale::Peak { target_m_s2 };
        let peak = values.any("--scale-to", self.scale_to.as_deref(), Dimension::Acceleration).map(target);
        let sa = self.scale_to_sa.as_deref().and_then(|text| values.keep("--scale-to-sa", parse_sa_target(text)));
        let spectrum = self.scale_to_spectrum.as_deref().and_then(|text| {
            values.keep("--scale-to-spectrum", parse_target_source(text).and_then(|source| read_target(&source)))
        });
        let processing = Processing {
            keep_mean,
            azimuth_deg: values.any("--azimuth", self.azimuth.as_deref(), Dimension::Angle).map(azimuth_deg),
            baseline: self.baseline.as_deref().and_then(|text| values.keep("--baseline", parse_baseline(text))),
            taper_ratio: values.any("--taper", self.taper.as_deref(), Dimension::Ratio),
            low_cut_hz: values.any("--low-cut", self.low_cut.as_deref(), Dimension::Frequency),
            high_cut_hz: values.any("--high-cut", self.high_cut.as_deref(), Dimension::Frequency),
            filter_order: self.order(values),
            resample_dt_s: values.any("--resample", self.resample.as_deref(), Dimension::Time),
            scale: peak.or(sa).or(spectrum.map(Scale::Spectrum)).unwrap_or(Scale::Factor(scale_ratio)),
        };
        for (key, problem) in processing.problems() {
            values.keep::<()>(&format!("--{}", key.replace('_', "-")), Err(problem));
        }
        processing
    }

    fn order(&self, values: &mut Values) -> u32 {
        let Some(text) = &self.filter_order else { return FILTER_ORDER };
        if self.low_cut.is_none() && self.high_cut.is_none() {
            values.push(crate::failure::problem("--filter-order without a filter", "give --low-cut or --high-cut"));
        }
        text.trim().parse().unwrap_or_else(|_| {
            values.push(crate::failure::problem(
                format!("--filter-order: \"{text}\" is not a whole number"),
                "write 4, or any other order from 1 to 10",
            ));
            FILTER_ORDER
        })
    }
}
