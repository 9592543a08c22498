//! Lists from end to end, one module for each subject. They are one program, so that the library is
//! linked once and no core is idle at the end of each module.

mod lists;
mod mutations;
