//! How the materials of a data set are read and registered.

use std::collections::BTreeMap;

use serde::Serialize;

use svbrdf_files::read::ReadOptions;

use crate::protocols::{MaskSource, Protocol};
use crate::registration::Registration;

/// How the materials of a data set are read.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub struct DatasetReading {
    pub ground_truths: ReadOptions,
    /// Of all methods but those of `methods`.
    pub predictions: ReadOptions,
    /// By the name of a method.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub methods: BTreeMap<String, ReadOptions>,
    /// How the predictions of a method of another size lie on their ground truths, by the name of the method.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub registrations: BTreeMap<String, Registration>,
    /// How they may, where that is restricted: the maps decide which.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub ways: Vec<Registration>,
    /// Which texels count, where not all do.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mask: Option<MaskSource>,
    /// Factor and offset on the roughness of ground truths and predictions.
    #[serde(skip_serializing_if = "is_nothing")]
    pub roughness: [Option<[f64; 2]>; 2],
    /// What the materials beside each other have decided: lines.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub decisions: Vec<String>,
    /// Whether a material that can only be read by guesses has no result.
    pub strict: bool,
}

fn is_nothing(roughness: &[Option<[f64; 2]>; 2]) -> bool {
    *roughness == [None; 2]
}

impl DatasetReading {
    /// This reading, and what a protocol states where it is left open.
    #[must_use]
    pub fn over(self, protocol: &Protocol) -> Self {
        let Protocol { ground_truths, predictions, registration, mask, .. } = protocol;
        let method = |(name, options): (String, ReadOptions)| (name, options.over(predictions.read));
        Self {
            ground_truths: self.ground_truths.over(ground_truths.read),
            predictions: self.predictions.over(predictions.read),
            methods: self.methods.into_iter().map(method).collect(),
            ways: registration.clone(),
            mask: self.mask.or_else(|| mask.clone()),
            roughness: [ground_truths.roughness, predictions.roughness],
            ..self
        }
    }

    /// How the predictions of a method are read.
    pub fn of_method(&self, method: &str) -> &ReadOptions {
        self.methods.get(method).unwrap_or(&self.predictions)
    }
}
