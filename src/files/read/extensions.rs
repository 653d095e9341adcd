//! Extensions of the files that are read.

/// Extensions of the files that open as a material or as a map of one.
pub const EXTENSIONS: [&str; 14] =
    ["png", "tif", "tiff", "jpg", "jpeg", "hdr", "exr", "npy", "npz", "gltf", "glb", "mtl", "mtlx", "json"];
/// Extensions of files that list their textures.
pub(crate) const LISTING: [&str; 4] = ["gltf", "glb", "mtl", "mtlx"];
