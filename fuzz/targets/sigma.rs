//! SIGMA and RESORCE.
#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| freestand_fuzz::check_family(
    b"Event Date & Time : 2000-01-01\n",
    bytes
));
