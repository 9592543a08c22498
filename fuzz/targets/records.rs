//! Any bytes, to whichever reader takes them.
#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    freestand_fuzz::check::check_record(bytes);
});
