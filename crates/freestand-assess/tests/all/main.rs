//! Lists and single objects from end to end, one module for each subject. One program, so that the library is
//! linked once and the tests fill the processor to the end.

mod around;
mod assess;
mod lists;
mod mutations;
mod one_object;
mod shards;
mod space;
mod worlds;
