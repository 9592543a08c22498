//! A record for tests, here and in the crates above.

/// The counts 2000, -1000, 0 and 500 of XX.ABC..HNE: one record of miniSEED 2, 32-bit integers, 100
/// Hz, 2019-07-06.
pub(crate) fn mseed_record() -> Vec<u8> {
    let mut out =
        b"000001D ABC    HNEXX\x07\xE3\0\xBB\x03\x13\x17\0\0\0\0\x04\0\x64\0\x01\0\0\0\x01\0\0\0\0\0\x40\0\x30"
            .to_vec();
    out.extend(b"\x03\xE8\0\0\x03\x01\x07\0");
    out.resize(64, 0);
    out.extend(
        [2000i32, -1000, 0, 500]
            .iter()
            .flat_map(|x| x.to_be_bytes()),
    );
    out.resize(128, 0);
    out
}
