//! Hazard files that people download, of every format.
#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    freestand_fuzz::check::check_hazard(bytes);
});
