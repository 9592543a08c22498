//! Studies and solvers against known answers, one module for each subject. One program, so that the library is
//! linked once and the tests fill the processor to the end.

mod ground_sources;
mod record_measures;
mod rocking_cases;
mod rocking_grid;
mod rolling_cases;
mod sensitivity;
mod suite;
mod two_components;
mod vertical;
mod wall_cases;
