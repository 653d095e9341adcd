//! What the formats print.

use svbrdf::error::Error;
use svbrdf::loss::Request;
use svbrdf::report::Report;

/// A report, and what the command line knows beside it.
#[derive(Debug)]
pub struct Printed {
    pub report: Report,
    /// What was asked for.
    pub request: Request,
    /// The accuracy that was asked for, where it was not reached.
    pub missed: Option<Error>,
    /// Where the ground truth and the predictions were read from; none for the built-in ones.
    pub paths: Vec<String>,
    /// The step of the training run that each prediction is; empty, or `None` for others.
    pub steps: Vec<Option<u64>>,
}

impl Printed {
    /// The accuracy that was asked for, if any, and whether it was reached.
    pub fn target(&self) -> Option<(f64, bool)> {
        match self.request {
            Request::Accuracy { target, .. } => Some((target, self.missed.is_none())),
            _ => None,
        }
    }

    /// Whether the number of scenes was given, so that a list of them is of a readable length.
    pub fn lists_scenes(&self) -> bool {
        matches!(self.request, Request::Scenes(_) | Request::Listed(_))
    }

    pub fn ground_truth_path(&self) -> Option<&str> {
        self.paths.first().map(String::as_str)
    }

    /// The step of the training run that a prediction is.
    pub fn step(&self, index: usize) -> Option<u64> {
        self.steps.get(index).copied().flatten()
    }

    /// The path of each prediction.
    pub fn prediction_paths(&self) -> impl Iterator<Item = Option<&str>> {
        self.paths.iter().skip(1).map(|path| Some(path.as_str())).chain(std::iter::repeat(None))
    }
}
