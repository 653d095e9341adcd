//! Records of a data set: the cases to compare, the settings of a run and the results.

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde::{Deserialize, Deserializer, Serialize};

use svbrdf_core::diagnose::Finding;
use svbrdf_core::loss::Estimate;

use crate::read::ReadOptions;

/// A material: its ground truth, and the predictions of all methods.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Case {
    /// Its place in the whole data set, from 0.
    pub index: usize,
    pub material: String,
    pub ground_truth: PathBuf,
    pub candidates: Vec<Candidate>,
}

/// A prediction.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Candidate {
    pub method: String,
    /// Which of the predictions of this method, from 0.
    pub sample: usize,
    pub path: PathBuf,
}

/// The settings that the results of all materials have in common: results of other settings cannot be joined with them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DatasetSettings {
    pub convention: String,
    /// Half of the 95% interval of each loss over scenes, as a share of the loss.
    pub target_error: f64,
    /// Names the scenes, together with the index of the material.
    pub seed: u64,
    /// The materials of the whole data set, in order.
    pub materials: Vec<String>,
    /// In order.
    pub methods: Vec<String>,
    /// Whether results have metrics of the maps.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub metrics: bool,
    /// Whether results have the marks of a diagnosis.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub diagnose: bool,
}

impl DatasetSettings {
    /// The settings for `cases`, which are those of the whole data set.
    pub fn new(convention: &str, target_error: f64, seed: u64, cases: &[Case]) -> Self {
        let mut methods: Vec<String> = Vec::new();
        for candidate in cases.iter().flat_map(|case| &case.candidates) {
            if !methods.contains(&candidate.method) {
                methods.push(candidate.method.clone());
            }
        }
        let materials = cases.iter().map(|case| case.material.clone()).collect();
        Self {
            convention: convention.to_owned(),
            target_error,
            seed,
            materials,
            methods,
            metrics: false,
            diagnose: false,
        }
    }

    /// The same settings, with metrics of the maps or without.
    #[must_use]
    pub fn with_metrics(self, metrics: bool) -> Self {
        Self { metrics, ..self }
    }

    /// The same settings, with the marks of a diagnosis or without.
    #[must_use]
    pub fn with_diagnoses(self, diagnose: bool) -> Self {
        Self { diagnose, ..self }
    }
}

/// How the materials of a data set are read.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub struct DatasetReading {
    pub ground_truths: ReadOptions,
    pub predictions: ReadOptions,
    /// Whether a material that can only be read by guesses has no result.
    pub strict: bool,
}

/// The results of one material.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MaterialResult {
    pub index: usize,
    pub material: String,
    /// The seed of its scenes: errors due to scenes are independent between materials.
    pub seed: u64,
    /// The number of scenes.
    pub scenes: usize,
    /// The loss that the ground truth cannot resolve, where diagnoses were asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub floor: Option<f64>,
    pub predictions: Vec<PredictionResult>,
}

impl MaterialResult {
    /// Whether a loss, or a difference of losses, is known not to be above the floor.
    pub fn is_below_floor(&self, value: Option<f64>) -> bool {
        self.floor.zip(value).is_some_and(|(floor, value)| value <= floor)
    }
}

/// The result of one prediction.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PredictionResult {
    pub method: String,
    pub sample: usize,
    pub path: String,
    /// The loss, or why there is none.
    pub result: Result<KnownLoss, String>,
    /// The metrics of its maps by name, where they were asked for; the PSNR of equal maps is infinite, in JSON null.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty", deserialize_with = "with_infinities")]
    pub metrics: BTreeMap<String, f64>,
    /// The marks of its diagnosis, the largest share first, where they were asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub marks: Option<Vec<Mark>>,
}

/// A marked finding of a diagnosis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Mark {
    /// Its name, such as "exposure".
    pub hypothesis: String,
    /// A number, a list of numbers or a name.
    pub value: serde_json::Value,
    /// The part of the loss that disappears under the hypothesis.
    pub share: f64,
    /// The option that corrects the reading, as `--read` has it after the name of the method: `normal-y=down`.
    pub remedy: Option<String>,
}

impl From<&Finding> for Mark {
    fn from(finding: &Finding) -> Self {
        Self {
            hypothesis: finding.hypothesis.name().to_owned(),
            // Numbers and names have a value.
            value: serde_json::to_value(&finding.value).unwrap_or_default(),
            share: finding.share.unwrap_or(0.0),
            remedy: finding.remedy.map(|remedy| remedy.to_string()),
        }
    }
}

/// Metrics whose null is infinity, which JSON does not have.
fn with_infinities<'de, D: Deserializer<'de>>(deserializer: D) -> Result<BTreeMap<String, f64>, D::Error> {
    let metrics = BTreeMap::<String, Option<f64>>::deserialize(deserializer)?;
    Ok(metrics.into_iter().map(|(name, value)| (name, value.unwrap_or(f64::INFINITY))).collect())
}

/// A loss that is known.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct KnownLoss {
    pub loss: f64,
    /// Due to the sampling of scenes and texels.
    pub standard_error: f64,
    pub interval95: [f64; 2],
}

impl KnownLoss {
    /// The loss as an estimate.
    pub fn estimate(&self) -> Estimate {
        let Self { loss, standard_error, interval95 } = *self;
        Estimate { mean: loss, standard_error: Some(standard_error), interval95: Some(interval95) }
    }
}
