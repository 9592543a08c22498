//! Processing as people write it.
#![no_main]
use freestand_records::processing::{
    Scale, TargetSource, parse_baseline, parse_sa_target, parse_target, parse_target_source,
};

libfuzzer_sys::fuzz_target!(|text: &str| {
    if let Err(problem) = parse_baseline(text) {
        assert!(!problem.message.is_empty());
    }
    if let Ok(Scale::Sa {
        target_m_s2,
        period_s,
        damping_ratio,
    }) = parse_sa_target(text)
    {
        assert!(target_m_s2.is_finite() && target_m_s2 > 0.0);
        assert!(period_s.is_finite() && period_s >= 0.0 && (0.0..1.0).contains(&damping_ratio));
    }
    if let Ok(source) = parse_target_source(text) {
        assert!(
            source
                .range_s
                .is_none_or(|(from_s, to_s)| 0.0 <= from_s && from_s <= to_s && to_s.is_finite())
        );
    }
    // The same bytes as a file with a target: a target that is read is one that a record can be scaled to.
    let source = TargetSource {
        path: "t.csv".into(),
        range_s: None,
        damping_ratio: None,
    };
    match parse_target(text.as_bytes().to_vec(), &source) {
        Ok(target) => {
            assert!(
                !target.periods_s.is_empty() && target.periods_s.len() == target.psa_m_s2.len()
            );
            assert!(target.psa_m_s2.iter().all(|sa| *sa > 0.0 && sa.is_finite()));
            assert!((0.0..1.0).contains(&target.damping_ratio));
        }
        Err(problem) => assert!(!problem.message.is_empty() && problem.hint.is_some()),
    }
});
