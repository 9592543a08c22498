//! miniSEED.
#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| freestand_fuzz::check_family(b"000001D ", bytes));
