//! Which objects of an inventory must be restrained: the inventory, the libraries of tolerances and cushions, and the
//! assessment.

pub mod assess;
pub mod inventory;
pub mod library;
pub mod validate;
