//! COSMOS.
#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| freestand_fuzz::check_family(
    b"Corrected acceleration   (Format v01.20 with 13 text lines) Src: 1\n",
    bytes
));
