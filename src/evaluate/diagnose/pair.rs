//! Pairs of a ground truth and a prediction.

use super::storage::Storage;
use svbrdf_core::material::Material;

/// A ground truth and a prediction, and how each is stored.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair<'a> {
    pub(super) ground_truth: &'a Material<f32>,
    pub(super) prediction: &'a Material<f32>,
    /// Of the ground truth and of the prediction.
    pub(super) storages: [&'a Storage; 2],
}
