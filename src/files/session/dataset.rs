//! Data set of a session: folders of materials, how they are read, and what a person has noted about them.

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use crate::read::ReadOptions;

/// A data set that a window shows, material by material. In a file, paths are relative to its folder. All of them are read: a results
/// folder, which is written, is named by a person alone.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub struct SessionDataset {
    /// The folder of the ground truths; without methods, a table of pairs; with predictions, their ground truth.
    pub ground_truths: PathBuf,
    #[serde(default)]
    pub methods: Vec<SessionMethod>,
    /// Predictions of one ground truth.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub predictions: Vec<SessionMethod>,
    /// Half of the 95% interval of each loss over scenes, as a share of the loss.
    pub target_error: f64,
    pub seed: u64,
    /// Whether floors are known: what the ground truths cannot resolve.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub diagnose: bool,
    /// How the ground truths are read, how predictions are, and how those of methods that differ.
    #[serde(default)]
    pub read: ReadOptions,
    #[serde(default)]
    pub read_predictions: ReadOptions,
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub read_methods: BTreeMap<String, ReadOptions>,
    /// The name of the material in the window.
    pub shown: String,
    /// How the list of its materials is sorted and filtered, in the terms of the window.
    #[serde(default, skip_serializing_if = "serde_json::Value::is_null")]
    pub list: serde_json::Value,
    /// Marks and notes by the name of a material.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub marks: BTreeMap<String, SessionMark>,
}

/// A method of a data set.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct SessionMethod {
    pub name: String,
    /// The folder of its predictions, or a pattern with `{}` for the name of a material.
    pub path: PathBuf,
}

/// What a person has noted about a material.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct SessionMark {
    #[serde(rename = "marked")]
    pub is_marked: bool,
    #[serde(skip_serializing_if = "String::is_empty")]
    pub note: String,
}

impl SessionDataset {
    /// Every path, to be changed.
    pub(super) fn paths_mut(&mut self) -> impl Iterator<Item = &mut PathBuf> {
        let methods = self.methods.iter_mut().chain(&mut self.predictions).map(|method| &mut method.path);
        std::iter::once(&mut self.ground_truths).chain(methods)
    }

    /// Every path.
    pub fn paths(&self) -> impl Iterator<Item = &PathBuf> {
        let methods = self.methods.iter().chain(&self.predictions).map(|method| &method.path);
        std::iter::once(&self.ground_truths).chain(methods)
    }
}
