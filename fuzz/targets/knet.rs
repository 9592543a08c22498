//! K-NET and KiK-net.
#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| freestand_fuzz::check_family(
    b"Origin Time       2006/01/18 23:25:00\nStation Code      A\n",
    bytes
));
