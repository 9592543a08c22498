//! CSMIP Volume 1 and 2, RENADIC.
#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| freestand_fuzz::check_family(
    b"Uncorrected Accelerogram Data      ",
    bytes
));
