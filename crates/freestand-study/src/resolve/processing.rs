//! Resolves `processing` of `[ground]`.

use super::{Resolver, or};
use crate::options::{GroundOptions, ProcessingOptions};
use freestand_input::toml_reader::Written;
use freestand_records::processing::{
    FILTER_ORDER, Processing, Scale, TargetSource, TargetSpectrum, azimuth_deg, check_scale, read_target,
};

impl Resolver<'_> {
    /// What is done to the records; contradictions are noted.
    pub(super) fn processing(&mut self, ground: &GroundOptions) -> Processing {
        let factor = Scale::Factor(or(&ground.scale, 1.0));
        if let Some(scale) = &ground.scale
            && let Err(problem) = check_scale(scale.value)
        {
            self.fault(Some(scale.line), "scale", problem);
        }
        let Some(written) = &ground.processing else {
            return Processing { scale: factor, ..Processing::default() };
        };
        self.exclusive(("component", &ground.component), ("azimuth", &written.azimuth_rad));
        self.exclusive(("scale", &ground.scale), ("scale_to", &written.scale_to_m_s2));
        self.exclusive(("scale", &ground.scale), ("scale_to_sa", &written.scale_to_sa));
        self.exclusive(("scale_to", &written.scale_to_m_s2), ("scale_to_sa", &written.scale_to_sa));
        self.exclusive(("scale", &ground.scale), ("scale_to_spectrum", &written.scale_to_spectrum));
        self.exclusive(("scale_to", &written.scale_to_m_s2), ("scale_to_spectrum", &written.scale_to_spectrum));
        self.exclusive(("scale_to_sa", &written.scale_to_sa), ("scale_to_spectrum", &written.scale_to_spectrum));
        let spectrum = written.scale_to_spectrum.as_ref().and_then(|source| self.target_spectrum(source));
        let value = |written: &Option<_>| written.as_ref().map(|one: &Written<f64>| one.value);
        let peak = value(&written.scale_to_m_s2).map(|target_m_s2| Scale::Peak { target_m_s2 });
        let order = or(&written.filter_order, u64::from(FILTER_ORDER));
        let processing = Processing {
            keep_mean: or(&written.keep_mean, false),
            azimuth_deg: value(&written.azimuth_rad).map(azimuth_deg),
            baseline: written.baseline.as_ref().map(|baseline| baseline.value),
            taper_ratio: value(&written.taper),
            low_cut_hz: value(&written.low_cut_hz),
            high_cut_hz: value(&written.high_cut_hz),
            filter_order: u32::try_from(order).unwrap_or(u32::MAX),
            resample_dt_s: value(&written.resample_s),
            scale: peak
                .or_else(|| written.scale_to_sa.as_ref().map(|sa| sa.value.clone()))
                .or(spectrum.map(Scale::Spectrum))
                .unwrap_or(factor),
        };
        if let Some(order) = &written.filter_order
            && processing.low_cut_hz.is_none()
            && processing.high_cut_hz.is_none()
        {
            self.note(
                Some(order.line),
                "filter_order needs low_cut or high_cut",
                "give one of them, such as low_cut = \"0.1 Hz\"",
            );
        }
        for (key, problem) in processing.problems().into_iter().filter(|(key, _)| *key != "scale") {
            self.fault(Some(line_of(written, key)), key, problem.named(key));
        }
        processing
    }

    fn target_spectrum(&mut self, written: &Written<TargetSource>) -> Option<TargetSpectrum> {
        let source = TargetSource { path: self.base_dir.join(&written.value.path), ..written.value.clone() };
        let read = read_target(&source);
        read.map_err(|problem| self.fault(Some(written.line), "scale_to_spectrum", problem)).ok()
    }
}

fn line_of(written: &ProcessingOptions, key: &str) -> usize {
    let line = match key {
        "azimuth" => written.azimuth_rad.as_ref().map(|one| one.line),
        "baseline" => written.baseline.as_ref().map(|one| one.line),
        "taper" => written.taper.as_ref().map(|one| one.line),
        "low_cut" => written.low_cut_hz.as_ref().map(|one| one.line),
        "high_cut" => written.high_cut_hz.as_ref().map(|one| one.line),
        "filter_order" => written.filter_order.as_ref().map(|one| one.line),
        "resample" => written.resample_s.as_ref().map(|one| one.line),
        "scale_to" => written.scale_to_m_s2.as_ref().map(|one| one.line),
        "scale_to_spectrum" => written.scale_to_spectrum.as_ref().map(|one| one.line),
        "scale_to_sa" => written.scale_to_sa.as_ref().map(|one| one.line),
        _ => None,
    };
    line.unwrap_or(written.line)
}
