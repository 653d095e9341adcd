//! Records of a data set: the cases to compare, the settings of a run and the results.

use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::diagnose::Finding;
use svbrdf_core::loss::{Estimate, LossOptions, Request};

use super::remark::Remark;
use super::scenes::DatasetScenes;
use crate::error::Error;
use crate::metrics::MetricSelection;
use crate::protocols::{self, Protocol};
use svbrdf_files::convention::ChosenConvention;

/// A material: its ground truth, and the predictions of all methods.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Case {
    /// Its place in the whole data set, from 0.
    pub index: usize,
    pub material: String,
    pub ground_truth: PathBuf,
    pub candidates: Vec<CandidateFile>,
}

/// A prediction.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CandidateFile {
    pub method: String,
    /// Which of the predictions of this method, from 0.
    pub sample: usize,
    /// Where it is, or would be.
    pub path: PathBuf,
    /// Why there is none.
    pub missing: Option<String>,
}

/// Where the materials of a data set are, as the user named them.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Source {
    /// Folders of materials of the same names.
    Folders {
        #[serde(serialize_with = "as_text")]
        ground_truths: PathBuf,
        methods: Vec<Method>,
    },
    /// A table of pairs.
    #[serde(serialize_with = "as_text")]
    Table(PathBuf),
    /// Predictions of one ground truth, each of which is a material of the list.
    Predictions {
        #[serde(serialize_with = "as_text")]
        ground_truth: PathBuf,
        predictions: Vec<Method>,
    },
}

impl Source {
    /// What was named first: the ground truths, or the table.
    pub fn path(&self) -> &Path {
        match self {
            Self::Folders { ground_truths: path, .. }
            | Self::Table(path)
            | Self::Predictions { ground_truth: path, .. } => path,
        }
    }
}

/// A method by its name.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Method {
    pub name: String,
    /// The folder of its predictions, or a pattern: a path in which `{}` stands for the name of a material.
    #[serde(serialize_with = "as_text")]
    pub path: PathBuf,
}

/// True for all metrics, otherwise the words that select them.
fn words<S: Serializer>(metrics: &Option<MetricSelection>, serializer: S) -> Result<S::Ok, S::Error> {
    match metrics.as_ref().filter(|metrics| !metrics.is_all()) {
        Some(metrics) => metrics.serialize(serializer),
        None => serializer.serialize_bool(metrics.is_some()),
    }
}

/// A path as it is printed: it may be no Unicode.
fn as_text<S: Serializer>(path: &Path, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(&path.display())
}

/// The settings that the results of all materials have in common.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DatasetSettings {
    /// Where the materials are.
    pub source: Source,
    pub convention: ChosenConvention,
    #[serde(flatten)]
    pub scenes: DatasetScenes,
    /// Names the scenes, together with the name of the material.
    pub seed: u64,
    /// The materials of the whole data set, in order.
    pub materials: Vec<String>,
    /// In order.
    pub methods: Vec<String>,
    /// Whether all methods are compared, over the materials that all have.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub common: bool,
    /// What it follows, by its name and source.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "protocols::by_name")]
    pub protocol: Option<Protocol>,
    /// Which metrics results have, if any.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "words")]
    pub metrics: Option<MetricSelection>,
    /// Whether results have the marks of a diagnosis.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub diagnose: bool,
}

impl DatasetSettings {
    /// The settings for `cases`, which are those of the whole data set.
    pub fn new(source: Source, convention: ChosenConvention, request: Request, cases: &[Case]) -> Self {
        let mut methods: Vec<String> = Vec::new();
        for candidate in cases.iter().flat_map(|case| &case.candidates) {
            if !methods.contains(&candidate.method) {
                methods.push(candidate.method.clone());
            }
        }
        let materials = cases.iter().map(|case| case.material.clone()).collect();
        Self {
            source,
            convention,
            seed: request.seed().unwrap_or(0),
            scenes: request.into(),
            materials,
            methods,
            common: false,
            protocol: None,
            metrics: None,
            diagnose: false,
        }
    }

    /// The same settings, with what these `options` ask for, or what the `protocol` states in their place.
    ///
    /// # Errors
    /// As [`LossOptions::request`] and [`Protocol::options`]; [`Error::OneScene`].
    pub fn following(
        mut self,
        options: &LossOptions,
        metrics: Option<MetricSelection>,
        protocol: Option<Protocol>,
    ) -> Result<Self, Error> {
        let options = protocol.as_ref().map_or(Ok(options.clone()), |protocol| protocol.options(options))?;
        (self.seed, self.metrics) = (options.seed.unwrap_or(0), metrics);
        self.scenes = DatasetScenes::new(&options)?;
        if let Some(protocol) = &protocol {
            if protocol.scenes.is_some() {
                self.scenes.options.clear();
            }
            if protocol.convention.is_some() {
                self.convention = protocol.chosen_convention()?;
            }
            let stated = Some(protocol.selection()).filter(|_| !protocol.metrics.is_empty());
            self.metrics = self.metrics.or(stated);
        }
        Ok(Self { protocol, ..self })
    }

    /// Whether metrics of maps and of renderings are computed. Those of renderings only where they are named.
    pub(super) fn computes(&self) -> [bool; 2] {
        let Some(metrics) = &self.metrics else { return [false; 2] };
        [metrics.has_maps(), !metrics.is_all() && metrics.has_renderings()]
    }

    /// The seed of the scenes of each material, in order: by its name, and for materials of one name by their order, so that it does
    /// not depend on which other materials there are. Predictions of one ground truth have the same scenes.
    pub fn seeds(&self) -> Vec<u64> {
        if matches!(self.source, Source::Predictions { .. }) {
            return vec![self.seed; self.materials.len()];
        }
        let mut counts: HashMap<&str, u64> = HashMap::new();
        let mut seeds = Vec::new();
        for material in &self.materials {
            let count = counts.entry(material).or_default();
            *count += 1;
            let [seed, count] = [self.seed, *count].map(u64::to_le_bytes);
            seeds.push(fnv1a(&[&seed[..], &count, material.as_bytes()].concat()));
        }
        seeds
    }
}

/// FNV-1a (Fowler, Noll and Vo) of bytes, 64 bits.
fn fnv1a(bytes: &[u8]) -> u64 {
    const BASIS: u64 = 0xcbf2_9ce4_8422_2325;
    const PRIME: u64 = 0x0100_0000_01b3;
    bytes.iter().fold(BASIS, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(PRIME))
}

/// The results of one material.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MaterialResult {
    pub index: usize,
    pub material: String,
    /// The seed of its scenes: errors due to scenes are independent between materials.
    pub seed: u64,
    /// What was noticed and assumed in reading the ground truth.
    pub reading: Vec<Remark>,
    /// The loss that the ground truth cannot resolve, where diagnoses were asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
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
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PredictionResult {
    pub method: String,
    pub sample: usize,
    pub path: String,
    /// Width and height of what is compared, in texels.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub size: Option<[usize; 2]>,
    /// `None` where it has no loss.
    #[serde(flatten)]
    pub known: Option<KnownLoss>,
    /// Why there is no loss.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error: Option<String>,
    /// What was noticed and assumed in reading it.
    pub reading: Vec<Remark>,
    /// The metrics of its maps by name, where they were asked for; the PSNR of equal maps is infinite, in JSON null.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty", deserialize_with = "with_infinities")]
    #[cfg_attr(feature = "schema", schemars(with = "Option<BTreeMap<String, Option<f64>>>"))]
    pub metrics: BTreeMap<String, f64>,
    /// The marks of its diagnosis, the largest share first, where they were asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub marks: Option<Vec<Mark>>,
}

impl PredictionResult {
    /// The names of its marks, separated by blanks; `None` where it was not diagnosed.
    pub(super) fn marked(&self) -> Option<String> {
        let names = self.marks.as_ref()?.iter().map(|mark| mark.hypothesis.as_str());
        Some(names.collect::<Vec<_>>().join(" "))
    }
}

/// The result of a pair of a ground truth and a prediction: what a results folder has of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct PairResult {
    /// What was noticed and assumed in reading the ground truth.
    pub(super) reading: Vec<Remark>,
    /// The loss that the ground truth cannot resolve, where diagnoses were asked for.
    pub(super) floor: Option<f64>,
    /// One with a loss: what fails is tried again.
    pub(super) prediction: PredictionResult,
}

/// A marked finding of a diagnosis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Mark {
    /// Its name, such as "exposure".
    pub hypothesis: String,
    /// A number, a list of numbers or a name.
    pub value: serde_json::Value,
    /// The part of the loss that disappears under the hypothesis.
    pub share: f64,
    /// The options that correct the reading, as `--read` has them after the name of the method: `normal-y=down`; after that of the ground
    /// truths where `hypothesis` is "ground_truth".
    pub remedy: Option<String>,
}

impl From<&Finding> for Mark {
    fn from(finding: &Finding) -> Self {
        Self {
            hypothesis: finding.hypothesis.name().to_owned(),
            // Numbers and names have a value.
            value: serde_json::to_value(&finding.value).unwrap_or_default(),
            share: finding.share,
            remedy: finding.remedy.map(|remedy| remedy.words()),
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
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct KnownLoss {
    /// The loss.
    pub loss: f64,
    /// Due to the sampling of scenes and texels.
    pub standard_error: f64,
    /// The 95% confidence interval of the loss over all scenes.
    pub interval95: [f64; 2],
    /// The number of scenes that its accuracy took: the first ones of the seed of its material, so that it does not depend on which
    /// other predictions there are.
    pub scenes: usize,
}

impl KnownLoss {
    /// The loss as an estimate.
    pub fn estimate(&self) -> Estimate {
        let Self { loss, standard_error, interval95, .. } = *self;
        Estimate { mean: loss, standard_error: Some(standard_error), interval95: Some(interval95) }
    }
}
