//! AFAD's older files.
#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| freestand_fuzz::check_family(
    b"STRONG GROUND MOTION RECORDS OF TURKIYE\r\n",
    bytes
));
