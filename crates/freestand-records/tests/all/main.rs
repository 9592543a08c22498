//! Records: damaged, large and real ones, one module for each subject. One program, so that the library is linked
//! once and the tests fill the processor to the end.

mod compliant_many;
mod large_files;
mod mutations;
mod real_records;
mod suites;
