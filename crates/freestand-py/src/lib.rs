//! The compiled half of the Python package `freestand`. Functions take the arguments of the Python
//! layer (`python/freestand`), call the same requests as the command line, and return the same
//! documents; arrays cross as bytes that Python owns, so neither side needs `unsafe`.

mod arguments;
mod asked;
mod assess;
mod block;
mod errors;
mod motion;
mod objects;
mod requests;
mod risk;
mod rock;
mod spectrum;
mod table;
mod work;

/// The extension module `freestand._freestand`, which the crate in extension/ makes a library of.
#[pyo3::pymodule]
mod _freestand {
    #[pymodule_export]
    use crate::assess::{assess, check_inventory, run, study_toml};
    #[pymodule_export]
    use crate::block::Body;
    #[pymodule_export]
    use crate::motion::{Record, acceleration_unit, read_motions};
    #[pymodule_export]
    use crate::objects::{check_object, restrain};
    #[pymodule_export]
    use crate::requests::{
        code_spectrum, drop_test, floor, shock, shock_spectrum, static_test, synth, validate,
    };
    #[pymodule_export]
    use crate::risk::{fragility, lognormal, risk};
    #[pymodule_export]
    use crate::rock::rock;
    #[pymodule_export]
    use crate::spectrum::spectrum;
    #[pymodule_export]
    use crate::table::arrow_stream;
    #[pymodule_export]
    use crate::work::{threads, version};
}
