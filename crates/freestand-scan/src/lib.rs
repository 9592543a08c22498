//! Objects as scanners see them: meshes, their mass properties and their hulls.
//!
//! | module | content |
//! |---|---|
//! | [`mesh`] | a mesh of triangles |
//! | [`formats`] | meshes from OBJ, STL, PLY and glTF files |
//! | [`body`] | what a mesh weighs, its centre of gravity, its moments of inertia and its hull |

pub mod body;
pub mod formats;
mod glb;
pub mod mesh;
