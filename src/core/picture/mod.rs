//! Pictures of materials: quantities, differences, cameras, tone and colour maps.

pub mod camera;
pub mod colour_map;
pub mod content;
pub mod difference;
pub mod differences;
pub mod exposure;
pub mod flip;
pub mod quantity;
pub mod statistics;
pub mod tone;
