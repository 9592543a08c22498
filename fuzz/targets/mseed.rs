//! miniSEED: the checksum of version 3 is set, so that the code after its check is reached.
#![no_main]

/// CRC-32C of the first record, whose own field counts as zero; `None` where it is cut off.
fn sealed(bytes: &[u8]) -> Option<Vec<u8>> {
    let data = u32::from_le_bytes(bytes.get(36..40)?.try_into().ok()?) as usize;
    let extra = usize::from(u16::from_le_bytes(bytes.get(34..36)?.try_into().ok()?));
    let length = 40 + usize::from(bytes[33]) + extra + data;
    let mut out = bytes.to_vec();
    let record = out.get_mut(..length)?;
    record[28..32].fill(0);
    let crc = !record.iter().fold(u32::MAX, |crc, byte| {
        (0..8).fold(crc ^ u32::from(*byte), |crc, _| {
            crc >> 1 ^ 0x82F6_3B78 & (crc & 1).wrapping_neg()
        })
    });
    record[28..32].copy_from_slice(&crc.to_le_bytes());
    Some(out)
}

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    if bytes.starts_with(b"MS\x03") {
        freestand_fuzz::check::check_record(&sealed(bytes).unwrap_or_else(|| bytes.to_vec()));
    } else {
        freestand_fuzz::check_family(b"000001D ", bytes);
    }
});
