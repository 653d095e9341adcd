//! Pairs of a ground truth and a prediction.

use super::samples::LossSamples;
use svbrdf_core::material::Material;
use svbrdf_files::read::Storage;

/// A ground truth and a prediction, and how each is stored.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair<'a> {
    pub(super) ground_truth: &'a Material<f32>,
    pub(super) prediction: &'a Material<f32>,
    /// Of the ground truth and of the prediction.
    pub(super) storages: [&'a Storage; 2],
}

/// The texels of a pair that it is compared on.
#[derive(Debug)]
pub(super) struct SampledPair {
    pub(super) samples: LossSamples,
    pub(super) ground_truth: Material<f32>,
    pub(super) prediction: Material<f32>,
}

impl SampledPair {
    pub(super) fn new(samples: LossSamples, pair: &Pair<'_>) -> Self {
        let [ground_truth, prediction] = [pair.ground_truth, pair.prediction].map(|map| samples.of_map(map));
        Self { samples, ground_truth, prediction }
    }
}
