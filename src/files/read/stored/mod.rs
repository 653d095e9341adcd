//! Stored maps: what files hold of a material, by the roles of its maps.

mod field;
mod material;
mod picture;
mod roles;
mod written;

pub(super) use field::{Field, reflectance, separated};
pub(super) use material::{Inferences, Inferred, StoredHeight, StoredMap, StoredMaterial};
pub(super) use picture::{DecodedPicture, Picture, PictureSource, decoded, notice};
pub(super) use roles::{CHANNELS, MapsByRole};
pub(super) use written::written_albedo;
