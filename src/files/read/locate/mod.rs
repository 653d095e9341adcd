//! Where the maps of a material are: in files of a folder, tiles of a packed image, layers of one file.

pub(super) mod binding;
pub(super) mod channels;
pub(super) mod directory;
pub(super) mod folder;
pub(super) mod grouping;
pub(super) mod layers;
pub(super) mod names;
pub(super) mod neighbours;
pub(super) mod packed;
pub(super) mod picture;
pub(super) mod reading;
