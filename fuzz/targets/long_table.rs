//! Tables of ETABS and SAP2000.
#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| freestand_fuzz::check_family(
    b"Story,Label,Output Case,Step Type,Time,UX,UY\n",
    bytes
));
