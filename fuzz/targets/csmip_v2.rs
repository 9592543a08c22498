//! CSMIP Volume 2.
#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| freestand_fuzz::check_family(
    b"Corrected accelerogram      \nUncorrected      \n",
    bytes
));
