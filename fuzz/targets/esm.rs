//! ESM and AFAD.
#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| freestand_fuzz::check_family(b"EVENT_NAME: A\n", bytes));
