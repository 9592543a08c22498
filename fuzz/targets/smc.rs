//! SMC of the U.S. Geological Survey.
#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| freestand_fuzz::check_family(
    b"2 CORRECTED ACCELEROGRAM\n*\n",
    bytes
));
