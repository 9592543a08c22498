//! The binary `freestand`.

fn main() {}
