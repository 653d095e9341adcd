//! Files that describe materials and name their textures.

pub(super) mod ahead;
pub(super) mod gltf;
pub(super) mod mtl;
pub(super) mod mtlx;
mod principled;
mod scaled_normals;
