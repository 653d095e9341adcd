//! The materials and the convention of a comparison, as arguments.

use std::path::PathBuf;

use svbrdf_core::error::Error;
use svbrdf_core::model::convention::Convention;
use svbrdf_files::steps::runs_in;

use super::reading::PairReadingArgs;

#[derive(Debug, clap::Args)]
pub struct ComparisonArgs {
    /// Convention: printed, single-image-2018, multi-image-2019 or guided-2020 [default: printed, or as in the session]
    #[arg(long, value_name = "NAME")]
    pub convention: Option<Convention>,

    #[command(flatten)]
    pub materials: MaterialArgs,
}

#[derive(Debug, clap::Args)]
pub struct MaterialArgs {
    /// Ground truth: a packed or layered image, a folder, a name prefix, or a session file of the window with its
    /// predictions; without one, the built-in materials
    #[arg(value_name = "GT")]
    pub ground_truth: Option<PathBuf>,

    /// Predictions of it, of the same size
    #[arg(value_name = "PRED")]
    pub predictions: Vec<PathBuf>,

    #[command(flatten)]
    pub reading: PairReadingArgs,
}

impl MaterialArgs {
    /// Puts the steps of training runs in the place of each prediction that is a folder of them. Returns the number of the step of
    /// each prediction.
    ///
    /// # Errors
    /// Where a folder cannot be listed.
    pub fn expand_steps(&mut self) -> Result<Vec<Option<u64>>, Error> {
        let mut expanded = Vec::new();
        for path in std::mem::take(&mut self.predictions) {
            let runs = if path.is_dir() { runs_in(&path)? } else { Vec::new() };
            if runs.is_empty() {
                expanded.push((path, None));
            }
            let steps = runs.into_iter().flat_map(|run| run.steps);
            expanded.extend(steps.map(|step| (step.path, Some(step.number))));
        }
        let (paths, steps) = expanded.into_iter().unzip();
        self.predictions = paths;
        Ok(steps)
    }

    /// The paths as given: the ground truth, then the predictions.
    pub fn paths(&self) -> impl Iterator<Item = &PathBuf> {
        self.ground_truth.iter().chain(&self.predictions)
    }
}
