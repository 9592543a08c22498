//! Ground and floor motions from strong-motion records: read, processed and written. Also
//! tables of other things: buildings, tests of cushions and of objects, response spectra, seismic hazard.
//!
//! ```text
//! notes <- text <- motion_file <- formats <- horizontal, processing      text <- tables <- formats
//! ```

pub mod formats;
pub mod horizontal;
mod motion_file;
pub mod notes;
pub mod processing;
pub mod tables;
mod text;
pub mod write;

#[cfg(test)]
mod tests {
    use freestand_input::quantity::{Dimension, parse};

    /// The unit of inputs and the constant of the equations are written in two crates.
    #[test]
    fn one_g_is_the_same_everywhere() {
        assert_eq!(
            parse("1 g", Dimension::Acceleration).ok(),
            Some(freestand::G0_M_S2)
        );
    }
}
