//! Inventories as CSV, and whatever else is taken for one.
#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| freestand_fuzz::inventory::check_inventory(
    bytes.to_vec()
));
