//! Objects as scanners see them: meshes, their mass properties and their hulls.
//!
//! | module | content |
//! |---|---|
//! | [`mesh`] | a mesh of triangles |
//! | [`formats`] | meshes from OBJ, STL, PLY and glTF files |
//! | [`body`] | what a mesh weighs, its centre of gravity, its moments of inertia and its hull |
//! | [`shapes`] | the same of upright prisms and cylinders, on their outline or on feet |

pub mod body;
pub mod formats;
mod glb;
pub mod mesh;
pub mod shapes;
