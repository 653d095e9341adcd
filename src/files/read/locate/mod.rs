//! Where the maps of a material are: in files of a folder, tiles of a packed image, layers of one file.

pub mod binding;
pub mod channels;
pub mod directory;
pub mod folder;
pub mod grouping;
pub mod layers;
pub mod names;
pub mod neighbours;
pub mod packed;
pub mod picture;
pub mod reading;
