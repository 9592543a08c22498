//! PEER AT2.
#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| freestand_fuzz::check_family(
    b"PEER\nA, 1/1/2000, B, 90\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS=  ",
    bytes
));
