//! Loops over the terms of a series, unrolled in the source.

/// Runs the body for N = 0 to 11, each time with the constant N.
///
/// A compiler unrolls such loops only up to some size; beyond it, it keeps the terms of a series in
/// memory, which is half as fast. Unrolled here, every term is in a register at every degree.
macro_rules! unroll {
    ($n:ident, $body:block) => {{
        unroll!(@each $n, $body, 0 1 2 3 4 5 6 7 8 9 10 11);
    }};
    (@each $n:ident, $body:block, $($value:literal)*) => {
        $({
            const $n: usize = $value;
            $body
        })*
    };
}

/// Like [`unroll`], from 11 down to 0.
macro_rules! unroll_down {
    ($n:ident, $body:block) => {{
        unroll!(@each $n, $body, 11 10 9 8 7 6 5 4 3 2 1 0);
    }};
}

pub(super) use {unroll, unroll_down};
