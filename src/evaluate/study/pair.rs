//! The input of a study.

use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;

/// A ground truth, a prediction and a convention.
#[derive(Clone, Copy, Debug)]
pub struct Pair<'a> {
    pub ground_truth: &'a Material<f32>,
    pub prediction: &'a Material<f32>,
    pub convention: Convention,
}
