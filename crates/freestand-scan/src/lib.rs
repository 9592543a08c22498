//! Objects as scanners see them: meshes, their mass properties and their hulls.
