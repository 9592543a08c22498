//! Mexico's ASA.
#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| freestand_fuzz::check_family(
    b"ARCHIVO ESTANDAR DE ACELERACION\n",
    bytes
));
