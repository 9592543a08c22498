//! Ground and floor motions from strong-motion records: read, processed and written.

pub mod formats;
pub mod horizontal;
pub mod processing;
