//! Measurements of stored pixels.

mod channels;
mod heights;
mod normals;
mod specular;

pub(super) use channels::{Channels, is_flat};
pub(super) use heights::slope_correlations;
pub(super) use normals::{NORMAL_AT_LEAST, curl, curved_normal_score, normal_score, signed_normal_score};
pub(super) use specular::{dark_metal, specular_median};
