//! `processing` of `[ground]`.

use freestand::signal::baseline::Baseline;

use super::{Reader, Section, Written};
use freestand_input::problem::Problem;
use freestand_input::quantity::Dimension;
use freestand_records::processing::{Scale, TargetSource, parse_baseline, parse_sa_target, parse_target_source};

/// `processing` of `[ground]`, as written.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ProcessingOptions {
    pub(crate) line: usize,
    pub(crate) keep_mean: Option<Written<bool>>,
    pub(crate) azimuth_rad: Option<Written<f64>>,
    pub(crate) baseline: Option<Written<Baseline>>,
    pub(crate) taper: Option<Written<f64>>,
    pub(crate) low_cut_hz: Option<Written<f64>>,
    pub(crate) high_cut_hz: Option<Written<f64>>,
    pub(crate) filter_order: Option<Written<u64>>,
    pub(crate) resample_s: Option<Written<f64>>,
    pub(crate) scale_to_m_s2: Option<Written<f64>>,
    pub(crate) scale_to_sa: Option<Written<Scale>>,
    pub(crate) scale_to_spectrum: Option<Written<TargetSource>>,
}

pub(super) fn processing(reader: &mut Reader<'_>, table: &mut Section<'_, '_>) -> Option<ProcessingOptions> {
    let mut entry = table.table(reader, "processing")?;
    let options = ProcessingOptions {
        line: entry.line,
        keep_mean: entry.boolean(reader, "keep_mean"),
        azimuth_rad: entry.quantity(reader, "azimuth", Dimension::Angle),
        baseline: read(reader, &mut entry, "baseline", parse_baseline),
        taper: entry.ratio(reader, "taper"),
        low_cut_hz: entry.quantity(reader, "low_cut", Dimension::Frequency),
        high_cut_hz: entry.quantity(reader, "high_cut", Dimension::Frequency),
        filter_order: entry.count(reader, "filter_order"),
        resample_s: entry.quantity(reader, "resample", Dimension::Time),
        scale_to_m_s2: entry.quantity(reader, "scale_to", Dimension::Acceleration),
        scale_to_sa: read(reader, &mut entry, "scale_to_sa", parse_sa_target),
        scale_to_spectrum: read(reader, &mut entry, "scale_to_spectrum", parse_target_source),
    };
    entry.finish(reader);
    Some(options)
}

fn read<T>(
    reader: &mut Reader<'_>,
    entry: &mut Section<'_, '_>,
    key: &'static str,
    parse: impl Fn(&str) -> Result<T, Problem>,
) -> Option<Written<T>> {
    let Written { value, line } = entry.string(reader, key)?;
    reader.keep(key, line, parse(&value))
}
