//! Inventories as workbooks: the bytes are the XML of the sheet.
//!
//! A fuzzer that changes a whole workbook meets checksums and little else.
#![no_main]
libfuzzer_sys::fuzz_target!(|sheet: &[u8]| freestand_fuzz::inventory::check_inventory(
    freestand_fuzz::inventory::workbook(sheet)
));
