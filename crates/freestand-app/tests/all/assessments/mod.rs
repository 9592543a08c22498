//! Lists and single objects from end to end, one module for each subject.

mod around;
mod assess;
mod budget;
mod doubt;
mod one_object;
mod pulses;
mod shards;
mod space;
mod watched;
mod worlds;
