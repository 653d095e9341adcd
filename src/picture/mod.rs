//! Pictures of materials: what they show, from where, in which colours, and how they become files.

pub mod camera;
pub mod colour_map;
pub mod difference;
pub mod export;
pub mod quantity;
pub mod statistics;
pub mod tone;
