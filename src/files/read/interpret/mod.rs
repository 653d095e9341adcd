//! From stored samples to the linear values of a material.

pub(crate) mod colour;
pub(crate) mod decide;
pub(crate) mod detect;
pub(crate) mod encoding;
pub(crate) mod normals;
pub(crate) mod report;
pub(crate) mod transfer;
pub(crate) mod values;
pub(crate) mod workflow;
