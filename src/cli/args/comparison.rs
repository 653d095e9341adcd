//! The materials and the convention of a comparison, as arguments.

use std::path::PathBuf;

use svbrdf_files::Error;
use svbrdf_files::convention::ChosenConvention;
use svbrdf_files::source::MaterialSource;
use svbrdf_files::steps::{RunId, runs_in};

use super::floor::FloorArgs;
use super::reading::{FormerSideArgs, PairReadingArgs, Side, StatementArgs};
use super::{Given, NamedPath, refuse};
use crate::cli::output::CommandError;

#[derive(Debug, clap::Args)]
pub struct ComparisonArgs {
    /// Convention: a name, which `svbrdf conventions` lists, or a .toml file [default: printed, or as in the session]
    #[arg(long, value_name = "NAME", value_parser = ChosenConvention::read)]
    pub convention: Option<ChosenConvention>,

    #[command(flatten)]
    pub materials: MaterialArgs,
}

#[derive(Debug, clap::Args)]
pub struct MaterialArgs {
    /// Ground truth: a packed or layered image, a folder, a name prefix, or a session file of the window with its
    /// predictions; without one, the built-in materials. NAME=PATH names it
    #[arg(value_name = "GT", value_parser = NamedPath::parser())]
    pub ground_truth: Option<NamedPath>,

    /// Predictions of it, of the same size; NAME=PATH names one
    #[arg(value_name = "PRED", value_parser = NamedPath::parser())]
    pub predictions: Vec<NamedPath>,

    #[command(flatten)]
    pub reading: PairReadingArgs,
}

impl MaterialArgs {
    /// Refuses what is specified of files that are not read in this way.
    ///
    /// # Errors
    /// [`CommandError::Usage`].
    fn refuse(&self, given: &Given, reason: &str) -> Result<(), CommandError> {
        given.refuse::<StatementArgs>(reason)?;
        given.refuse::<FormerSideArgs>(reason)?;
        refuse(self.reading.resize_to.is_some(), "resize-to", reason)
    }

    /// Refuses what is specified of files where the built-in materials are taken.
    ///
    /// # Errors
    /// [`CommandError::Usage`].
    pub fn refuse_of_built_in(&self, given: &Given) -> Result<(), CommandError> {
        let reason = "the built-in materials are not read from files";
        self.refuse(given, reason)?;
        refuse(self.reading.both.strict, "strict", reason)?;
        given.refuse::<FloorArgs>(reason)
    }

    /// Refuses what is specified of files where a session names them.
    ///
    /// # Errors
    /// [`CommandError::Usage`].
    pub fn refuse_of_session(&self, given: &Given) -> Result<(), CommandError> {
        self.refuse(given, "a session specifies how its materials are read")
    }

    /// The ground truth, then the predictions, each with the options that it is read with.
    ///
    /// # Errors
    /// [`Error::SpecifiedTwice`]; [`CommandError::Usage`] for options of materials that do not exist.
    pub fn sources(&self) -> Result<Vec<MaterialSource>, CommandError> {
        let reading = self.reading.reading()?;
        let sides = std::iter::once(Side::GroundTruth).chain(std::iter::repeat(Side::Prediction));
        let given: Vec<_> =
            self.ground_truth.iter().chain(&self.predictions).map(NamedPath::source).collect();
        let names = reading.names_of(&given);
        let (first, others) =
            names.split_first().ok_or_else(|| Error::Internal("there is no material".to_owned()))?;
        reading.check(Some(first), others)?;
        let sources = given.into_iter().zip(&names).zip(sides);
        Ok(sources
            .map(|((source, name), side)| MaterialSource {
                options: reading.options_for(side, name),
                ..source
            })
            .collect())
    }

    /// Puts the steps of training runs in the place of each prediction that is a folder of them. Returns the number of the step of
    /// each prediction.
    ///
    /// # Errors
    /// Where a folder cannot be listed.
    pub fn expand_steps(&mut self) -> Result<Vec<Option<u64>>, Error> {
        let mut expanded = Vec::new();
        for given in std::mem::take(&mut self.predictions) {
            let runs = if given.path.is_dir() { runs_in(&given.path)? } else { Vec::new() };
            if runs.is_empty() {
                expanded.push((given.clone(), None));
            }
            for run in runs {
                let named = |number| {
                    given.name.clone().map(|name| RunId { name, ..run.id.clone() }.step_name(number))
                };
                let steps = run.steps.iter().map(|step| {
                    (NamedPath { name: named(step.number), path: step.path.clone() }, Some(step.number))
                });
                expanded.extend(steps);
            }
        }
        let (paths, steps) = expanded.into_iter().unzip();
        self.predictions = paths;
        Ok(steps)
    }

    /// The paths as given: the ground truth, then the predictions.
    pub fn paths(&self) -> impl Iterator<Item = &PathBuf> {
        self.ground_truth.iter().chain(&self.predictions).map(|given| &given.path)
    }
}
