//! Lists and single objects from end to end, one module for each subject. They are one program, so
//! that the library is linked once and no core is idle at the end of each module.

mod around;
mod assess;
mod doubt;
mod one_object;
mod shards;
mod space;
mod worlds;
