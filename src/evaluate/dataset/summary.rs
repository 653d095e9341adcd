//! The report of a data set and its parts: the keys of the JSON.

use std::collections::{BTreeMap, BTreeSet};

use serde::Serialize;

use crate::report::Repetition;

use super::doubts::ReadingSummary;
use super::pick::Pick;
use super::reading::DatasetReading;
use super::record::{DatasetSettings, MaterialResult};

/// In place of an interval over fewer materials than have one.
pub(super) const FEW: &str = "few materials";

/// The losses of methods over a data set.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct DatasetReport {
    #[cfg_attr(feature = "schema", schemars(with = "BTreeMap<String, serde_json::Value>"))]
    pub settings: DatasetSettings,
    /// How the files are read.
    #[cfg_attr(feature = "schema", schemars(with = "BTreeMap<String, serde_json::Value>"))]
    pub reading: DatasetReading,
    /// Which of several predictions of a material counts.
    pub pick: Pick,
    /// How to repeat it.
    pub repetition: Repetition,
    /// The beginning of the SHA-256 of the files of each material, by `ground truth, wood` and `ours, wood`.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    #[cfg_attr(feature = "schema", schemars(with = "Option<BTreeMap<String, String>>"))]
    pub files: BTreeMap<String, String>,
    /// The names of the materials that the means of compared methods are over.
    pub compared_materials: Vec<String>,
    /// How the ground truths were read.
    pub ground_truths: ReadingSummary,
    /// The compared ones first, best first; then those that lack materials, the most materials first.
    pub methods: Vec<MethodSummary>,
    /// One per material, in order.
    pub results: Vec<MaterialResult>,
    /// The indices of the materials that the means of compared methods are over.
    #[serde(skip)]
    pub(super) common: BTreeSet<usize>,
}

/// The losses of a method.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MethodSummary {
    pub method: String,
    /// Whether it has a loss of as many materials as any other; if not, its mean is over other materials.
    pub compared: bool,
    /// The number of materials with a loss.
    pub materials: usize,
    /// The number of materials without one.
    pub failures: usize,
    /// Over the materials that all compared methods have, `compared_materials`; of a method that is not compared, over those that it has
    /// a loss of; `None` without a loss.
    #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
    pub mean: f64,
    /// Over the materials of the mean.
    #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
    pub median: f64,
    /// The 95% interval of the mean over all materials like these; `None` for fewer than 25.
    pub interval95_materials: Option<[f64; 2]>,
    /// The 95% interval of the mean over these materials, due to the sampling of scenes alone.
    #[cfg_attr(feature = "schema", schemars(with = "[Option<f64>; 2]"))]
    pub interval95_scenes: [f64; 2],
    /// The mean difference to the best method over the materials of both; `None` for the best, and where nothing is compared.
    pub to_best: Option<f64>,
    pub to_best_interval95_materials: Option<[f64; 2]>,
    /// Of the materials of both, how many it is worse on than the best method, and how many there are.
    pub worse_on: Option<[usize; 2]>,
    /// Whether it is compared, and the materials cannot separate it from the best: tables set it in bold.
    pub ties_with_best: bool,
    /// How its predictions were read; `None` where there are none.
    pub reading: Option<ReadingSummary>,
    /// Of the maps, by name; `None` where they were not asked for.
    #[cfg_attr(feature = "schema", schemars(with = "Option<BTreeMap<String, MetricSummary>>"))]
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub metrics: BTreeMap<String, MetricSummary>,
    /// `None` where no diagnosis was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub marks: Option<MarkSummary>,
}

impl MethodSummary {
    /// What takes the place of an interval of the difference to the best that too few materials have.
    pub fn signs(&self) -> String {
        let signs = self.worse_on.map(|[worse, all]| format!("few materials, worse on {worse} of {all}"));
        signs.unwrap_or_default()
    }

    /// The number of materials with a loss, and of how many where it lacks some.
    pub fn count(&self) -> String {
        match self.failures {
            0 => self.materials.to_string(),
            failures => format!("{} of {}", self.materials, self.materials + failures),
        }
    }
}

/// A metric of a method over the materials that its mean loss is over.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MetricSummary {
    /// The mean over materials, as papers print it; of `psnr_*`, over those whose PSNR is finite; of `psnr_pooled_*`, the PSNR of the mean
    /// square error of all materials.
    #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
    pub mean: f64,
    /// How many materials have an infinite PSNR: their maps are equal.
    #[serde(skip_serializing_if = "is_zero")]
    pub infinite: usize,
    #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
    pub median: f64,
    /// The 95% interval of the mean over all materials like these; `None` for fewer than 25, and where the mean is infinite.
    pub interval95_materials: Option<[f64; 2]>,
}

fn is_zero(count: &usize) -> bool {
    *count == 0
}

/// The marks of a method over the materials that were diagnosed.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MarkSummary {
    /// The number of materials with a diagnosis.
    pub materials: usize,
    /// The number of these with any mark.
    pub marked: usize,
    /// The number of materials that are marked by each hypothesis.
    pub by: BTreeMap<String, usize>,
    /// The number of materials whose loss is not above the floor of the ground truth.
    pub not_resolvable: usize,
    /// The number of materials whose difference to the best method is not above it; `None` for the best.
    pub to_best_not_resolvable: Option<usize>,
}
