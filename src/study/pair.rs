//! What is studied.

use std::fmt;

use crate::error::Error;
use crate::loss::Loss;
use crate::material::Material;
use crate::model::convention::Convention;
use crate::model::scene::Scene;
use crate::progress::Progress;

/// The loss on a graphics adapter: [`crate::loss::losses_f32`] of one prediction, elsewhere.
pub type OnGpu<'a> =
    dyn Fn(&Material<f32>, &Material<f32>, &[Scene], &Convention, &Progress) -> Result<Vec<Loss>, Error> + 'a;

/// What is studied, and what with.
#[derive(Clone, Copy)]
pub struct Pair<'a> {
    pub ground_truth: &'a Material<f32>,
    pub prediction: &'a Material<f32>,
    pub convention: Convention,
    /// `None` where there is no adapter.
    pub gpu: Option<&'a OnGpu<'a>>,
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
