//! Columns and CSV.
#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| freestand_fuzz::check_family(
    b"time [s],a [g]\n",
    bytes
));
