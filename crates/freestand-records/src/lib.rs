//! Ground and floor motions from strong-motion records: read, processed and written. Also other
//! tables that come as text.
//!
//! ```text
//! text <- motion_file <- formats <- horizontal, processing      text <- tables
//! ```

pub mod formats;
pub mod horizontal;
mod motion_file;
pub mod processing;
pub mod tables;
mod text;
mod write;
