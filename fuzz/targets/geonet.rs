//! GeoNet Volume 1 and 2.
#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| freestand_fuzz::check_family(
    b"Corrected accelerogram                  GNS Science\n",
    bytes
));
