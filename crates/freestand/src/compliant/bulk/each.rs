//! The same for both edges, or for every state, written out: a closure in a vector function may be compiled apart from
//! it, without its vector unit, and is then some twenty times as slow.

/// An expression for each of two edges, or ways.
macro_rules! two {
    ($i:ident, $value:expr) => {
        each!($i, $value, 0 1)
    };
}

/// An expression for each of six states.
macro_rules! six {
    ($i:ident, $value:expr) => {
        each!($i, $value, 0 1 2 3 4 5)
    };
}

macro_rules! each {
    ($i:ident, $value:expr, $($place:literal)*) => {
        [$({
            let $i: usize = $place;
            $value
        }),*]
    };
}

pub(super) use {each, six, two};
