//! USC and CIT.
#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| freestand_fuzz::check_family(
    b"CORRECTED ACCELEROGRAM IIB001     94.001.0 COMP N08W   FILE 1\n",
    bytes
));
