//! `cargo xtask test`: everything that has to hold, with all set-up.

fn main() {}
