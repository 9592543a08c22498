//! Processing as flags and studies write it.
#![no_main]
use freestand_study::processing::{Scale, parse_baseline, parse_sa_target};

libfuzzer_sys::fuzz_target!(|text: &str| {
    if let Err(problem) = parse_baseline(text) {
        assert!(!problem.message.is_empty());
    }
    if let Ok(Scale::Sa { target_m_s2, period_s, damping_ratio }) = parse_sa_target(text) {
        assert!(target_m_s2.is_finite() && target_m_s2 > 0.0);
        assert!(period_s.is_finite() && period_s >= 0.0 && (0.0..1.0).contains(&damping_ratio));
    }
});
