//! Taiwan's free format.
#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| freestand_fuzz::check_family(
    b"#StationCode: A\n#AmplitudeUnit:  gal. DCoffset(corr)\n",
    bytes
));
