//! Sample materials that are built in: a ground truth and two predictions of it.
//!
//! This project's own code made them ([`generate`]); they are free to use like the rest of it.

pub mod generate;
mod noise;
mod tiles;

use crate::error::Error;
use crate::material::read::{Read, ReadOptions, read_bytes};
use crate::real::Real;

/// A ground truth and predictions of it, of the same size.
#[derive(Clone, Debug, PartialEq)]
pub struct Samples<T> {
    pub ground_truth: Read<T>,
    pub predictions: Vec<Read<T>>,
}

/// The samples, by name: worn tiles; blurred normals, wrong roughness.
///
/// # Errors
/// None, unless the samples that were built in are damaged.
pub fn load<T: Real>() -> Result<Samples<T>, Error> {
    let read = |name, bytes| read_bytes(name, bytes, &OPTIONS);
    Ok(Samples {
        ground_truth: read("worn tiles", include_bytes!("../../assets/worn_tiles.png"))?,
        predictions: vec![
            read("blurred normals", include_bytes!("../../assets/blurred_normals.png"))?,
            read("wrong roughness", include_bytes!("../../assets/wrong_roughness.png"))?,
        ],
    })
}
