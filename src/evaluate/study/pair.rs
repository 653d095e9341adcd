//! The input of a study.

use std::fmt;

use svbrdf_core::loss::Backend;
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;

/// A ground truth, a prediction and a convention, and the backends to study them with.
#[derive(Clone, Copy)]
pub struct Pair<'a> {
    pub ground_truth: &'a Material<f32>,
    pub prediction: &'a Material<f32>,
    pub convention: Convention,
    /// `None` without a graphics adapter.
    pub gpu: Option<&'a dyn Backend<f32>>,
}

impl fmt::Debug for Pair<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names = (self.ground_truth.name(), self.prediction.name());
        f.debug_struct("Pair")
            .field("names", &names)
            .field("gpu", &self.gpu.is_some())
            .finish_non_exhaustive()
    }
}
