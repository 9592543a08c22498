//! Records: damaged, large and real ones, one module for each subject. They are one program, so
//! that the library is linked once and no core is idle at the end of each module.

mod compliant_many;
mod large_files;
mod mutations;
mod real_records;
mod suites;
mod worlds;
