//! Objects as scanners see them: meshes, their mass properties and their hulls.
//!
//! | module | content |
//! |---|---|
//! | [`mesh`] | a mesh of triangles from OBJ, STL, PLY or glTF |
//! | [`body`] | what a mesh weighs, its centre of gravity, its moments of inertia and its hull |

pub mod body;
mod formats;
pub mod mesh;
