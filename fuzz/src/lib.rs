//! What the fuzz targets share.

pub mod check;
pub mod inventory;

/// A record of a known family: `bytes`, after the family's signature unless they begin with it.
///
/// Without it the fuzzer would spend its time on finding the words by which a format is told.
pub fn check_family(signature: &[u8], bytes: &[u8]) {
    if bytes.starts_with(signature) {
        check::check_record(bytes);
    } else {
        check::check_record(&[signature, bytes].concat());
    }
}
