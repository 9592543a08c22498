//! SAC: a header of 632 bytes whose version, in either byte order, is the signature.
#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let mut bytes = bytes.to_vec();
    if let Some(version) = bytes.get_mut(304..308) {
        let big = version.first() == Some(&0);
        version.copy_from_slice(&if big {
            6_i32.to_be_bytes()
        } else {
            6_i32.to_le_bytes()
        });
    }
    freestand_fuzz::check::check_record(&bytes);
});
