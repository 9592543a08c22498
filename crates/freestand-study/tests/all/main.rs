//! Studies and solvers against known answers, one module for each subject. They are one program, so
//! that the library is linked once and no core is idle at the end of each module.

mod cases;
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
