//! BHRC of Iran.
#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| freestand_fuzz::check_family(b"* VOL1DS FILE\n", bytes));
