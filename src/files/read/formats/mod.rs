//! Files that describe materials and name their textures.

pub mod ahead;
pub mod gltf;
pub mod mtl;
pub mod mtlx;
mod principled;
mod scaled_normals;
