//! The extension module `freestand._freestand`. Everything is in the library beside it, so that the level of
//! optimisation of this last piece, which is that of the passes over the whole, is not that of the functions
//! (`published` in the workspace's `Cargo.toml`).

use freestand_py as _;
