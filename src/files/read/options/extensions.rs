//! Extensions of the files that are read.

use std::path::Path;

/// Extensions of the files that open as a material or as a map of one.
pub const EXTENSIONS: [&str; 28] = [
    "png", "tif", "tiff", "tx", "jpg", "jpeg", "jfif", "jpe", "tga", "bmp", "webp", "dds", "hdr", "exr",
    "pbm", "pgm", "ppm", "pnm", "pam", "pfm", "qoi", "npy", "npz", "gltf", "glb", "mtl", "mtlx", "json",
];
/// Extensions of files that list their textures.
pub(crate) const LISTING: [&str; 4] = ["gltf", "glb", "mtl", "mtlx"];
/// Extensions of the pictures that count among the files of a folder, the better one of two last.
pub(crate) const PICTURES: [&str; 22] = [
    "dds", "webp", "jpe", "jfif", "jpg", "jpeg", "bmp", "tga", "pbm", "pgm", "ppm", "pnm", "pam", "qoi",
    "hdr", "png", "tx", "tif", "tiff", "pfm", "npy", "exr",
];

/// The extension of a file name, in lower case.
pub(crate) fn of_name(name: impl AsRef<Path>) -> String {
    name.as_ref().extension().unwrap_or_default().to_string_lossy().to_lowercase()
}
