//! What a picture shows of materials, from where, and in which colours.

pub mod camera;
pub mod colour_map;
pub mod difference;
pub mod differences;
pub mod quantity;
pub mod shown;
pub mod statistics;
pub mod tone;
