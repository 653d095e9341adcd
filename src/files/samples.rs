//! The built-in materials: a ground truth and two predictions, 256 x 256 texels each.
//!
//! Worn glazed tiles, inlaid with metal, and predictions as networks make them. They are free to use like the rest of this project.
//!
//! ```
//! let built_in = svbrdf_files::samples::load::<f32>()?;
//! assert_eq!(built_in.ground_truth.material.size(), [256, 256]);
//! assert_eq!(built_in.predictions.len(), 2);
//! # Ok::<(), svbrdf_files::Error>(())
//! ```

use svbrdf_assets::SAMPLES;
use svbrdf_core::math::real::Real;

use crate::error::Error;
use crate::read::{Albedo, Certainty, NormalY, Order, Read, ReadOptions, Reason, Roughness, read_bytes};

/// How the samples are stored, so that nothing is inferred.
const STORED: ReadOptions = ReadOptions {
    albedo: Some(Albedo::Linear),
    specular: Some(Albedo::Linear),
    normal_y: Some(NormalY::Up),
    roughness: Some(Roughness::R),
    order: Some(Order::NDRS),
    ..ReadOptions::AUTO
};

/// Number of samples.
pub const COUNT: usize = SAMPLES.len();

/// A ground truth and predictions of it, of the same size.
#[derive(Clone, Debug, PartialEq)]
pub struct BuiltIn<T> {
    pub ground_truth: Read<T>,
    pub predictions: Vec<Read<T>>,
}

/// The ground truth "worn tiles" with the predictions "blurred normals" and "wrong roughness".
///
/// # Errors
/// None, unless the build damaged the embedded files.
pub fn load<T: Real>() -> Result<BuiltIn<T>, Error> {
    let predictions = (1..COUNT).map(load_one).collect::<Result<_, _>>()?;
    Ok(BuiltIn { ground_truth: load_one(0)?, predictions })
}

/// The sample of this number: 0 for the ground truth, then the predictions.
///
/// # Errors
/// [`Error::NoSuchBuiltIn`].
pub fn load_one<T: Real>(number: usize) -> Result<Read<T>, Error> {
    let Some((name, bytes)) = SAMPLES.get(number) else {
        return Err(Error::NoSuchBuiltIn { number, count: COUNT });
    };
    let mut read = read_bytes(name, bytes, &STORED)?;
    for known in read.assumptions.iter_mut().filter(|a| a.certainty == Certainty::Given) {
        known.why = Reason::stated("the built-in materials are stored in this way");
        known.certainty = Certainty::Sure;
    }
    Ok(read)
}
