//! The description of a station that goes with a miniSEED record.
#![no_main]
use freestand_records::formats::{ReadOptions, parse_motions};
use std::path::Path;

const RECORD: &[u8] = include_bytes!("../seeds/mseed/int32.mseed");

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let xml = std::env::temp_dir().join(format!("freestand-fuzz-{}.xml", std::process::id()));
    if std::fs::write(&xml, bytes).is_err() {
        return;
    }
    let options = ReadOptions {
        station_xml: Some(xml),
        ..ReadOptions::default()
    };
    if let Ok(file) = parse_motions(
        RECORD.to_vec(),
        Path::new("/nowhere/record.mseed"),
        &options,
    ) {
        assert!(
            file.components
                .iter()
                .all(|one| one.motion.accel_m_s2().iter().all(|a| a.is_finite()))
        );
    }
});
