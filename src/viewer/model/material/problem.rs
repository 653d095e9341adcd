//! Problem with materials that were to be read.

use std::fmt;
use std::path::Path;

use svbrdf_files::source::{MaterialSource, Place};

use crate::error::Error;

/// Why a material is not in the window, or not any more.
#[derive(Debug)]
pub enum MaterialProblem {
    /// A prediction was not opened: its size is not the ground truth's.
    Refused(Box<SizeMismatch>),
    /// A prediction was closed: the new ground truth has another size.
    Closed(Box<SizeMismatch>),
    /// A material could not be read, in the opening of this number.
    NotRead { source: Box<MaterialSource>, error: Error, opening: u64 },
    /// These predictions were not opened: their ground truth could not be read.
    NotOpened(Vec<String>),
}

/// A prediction and a ground truth of different sizes.
#[derive(Clone, Debug, PartialEq)]
pub struct SizeMismatch {
    pub prediction: String,
    pub prediction_size: [usize; 2],
    pub ground_truth: String,
    pub ground_truth_size: [usize; 2],
    /// The prediction.
    pub source: MaterialSource,
}

impl MaterialProblem {
    /// The file that it is about: it is settled once that has been read.
    pub fn path(&self) -> Option<&Path> {
        let source = match self {
            Self::NotRead { source, .. } => source,
            Self::Refused(sizes) | Self::Closed(sizes) => &sizes.source,
            Self::NotOpened(_) => return None,
        };
        match &source.place {
            Place::Path(path) => Some(path),
            Place::BuiltIn(_) => None,
        }
    }
}

impl fmt::Display for MaterialProblem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Refused(sizes) => write!(f, "Not opened: {sizes}."),
            Self::Closed(sizes) => write!(f, "Prediction closed: {sizes}."),
            Self::NotOpened(names) => {
                write!(f, "Not opened, because the ground truth could not be read: {}.", names.join(", "))
            }
            Self::NotRead { error, .. } => error.fmt(f),
        }
    }
}

impl fmt::Display for SizeMismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [[w, h], [gt_w, gt_h]] = [self.prediction_size, self.ground_truth_size];
        write!(
            f,
            "{} is {w} x {h} and the ground truth {} is {gt_w} x {gt_h}",
            self.prediction, self.ground_truth
        )
    }
}
