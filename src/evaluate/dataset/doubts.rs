//! The doubts in reading the materials of a data set, counted by method.

use std::collections::{BTreeMap, BTreeSet};

use serde::Serialize;

use super::record::MaterialResult;
use super::remark::Remark;

/// How the materials of a method, or the ground truths, were read.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ReadingSummary {
    /// The number of materials that were read.
    pub materials: usize,
    /// For each doubt the number of materials that have it, the most frequent first.
    pub doubts: Vec<DoubtCount>,
}

/// The number of materials with one doubt.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct DoubtCount {
    /// What is in doubt, such as "without normal map".
    pub doubt: String,
    pub materials: usize,
}

impl ReadingSummary {
    /// How the ground truths were read.
    pub fn of_ground_truths(results: &[MaterialResult]) -> Self {
        Self::new(results.iter().map(|result| result.reading.iter().collect()))
    }

    /// How the predictions of each method were read; of several of a material, each doubt counts once.
    pub fn by_method(results: &[MaterialResult]) -> BTreeMap<&str, Self> {
        let mut all: BTreeMap<&str, Vec<Vec<&Remark>>> = BTreeMap::new();
        for result in results {
            let mut remarks: BTreeMap<&str, Vec<&Remark>> = BTreeMap::new();
            for prediction in &result.predictions {
                remarks.entry(&prediction.method).or_default().extend(&prediction.reading);
            }
            remarks.into_iter().for_each(|(method, remarks)| all.entry(method).or_default().push(remarks));
        }
        all.into_iter().map(|(method, materials)| (method, Self::new(materials.into_iter()))).collect()
    }

    fn new<'a>(materials: impl Iterator<Item = Vec<&'a Remark>>) -> Self {
        let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
        let mut read = 0;
        // A material that was read has remarks: on its layout at least.
        for remarks in materials.filter(|remarks| !remarks.is_empty()) {
            read += 1;
            let doubts: BTreeSet<&str> = remarks.into_iter().filter_map(|one| one.doubt.as_deref()).collect();
            doubts.into_iter().for_each(|doubt| *counts.entry(doubt).or_default() += 1);
        }
        let count = |(doubt, materials): (&str, usize)| DoubtCount { doubt: doubt.to_owned(), materials };
        let mut doubts: Vec<DoubtCount> = counts.into_iter().map(count).collect();
        doubts.sort_by_key(|doubt| std::cmp::Reverse(doubt.materials));
        Self { materials: read, doubts }
    }

    /// `ours: 3 of 3 without normal map; 2 of 3 with unsure albedo=srgb`, where anything is in doubt.
    pub fn line(&self, name: &str) -> Option<String> {
        let part = |DoubtCount { doubt, materials }: &DoubtCount| {
            format!("{materials} of {} {doubt}", self.materials)
        };
        let parts: Vec<String> = self.doubts.iter().map(part).collect();
        (!parts.is_empty()).then(|| format!("{name}: {}", parts.join("; ")))
    }
}
