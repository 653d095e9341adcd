//! From stored samples to the linear values of a material.

pub mod colour;
pub mod decide;
pub mod detect;
pub mod encoding;
pub mod normals;
pub mod report;
pub mod transfer;
pub mod values;
pub mod workflow;
