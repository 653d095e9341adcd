//! The materials and the convention of a comparison, as arguments.

use std::path::PathBuf;

use clap::error::ErrorKind;
use clap::{ArgMatches, Command, FromArgMatches};

use svbrdf_core::model::named_conventions;
use svbrdf_files::Error;
use svbrdf_files::convention::ChosenConvention;
use svbrdf_files::source::MaterialSource;

use super::reading::{PairReadingArgs, StatementArgs, Whose};
use super::{NamedPath, Specified, offered, refuse, wildcards};
use crate::cli::output::CommandError;

#[derive(Debug, clap::Args)]
pub struct ComparisonArgs {
    /// Convention: a name of `svbrdf conventions`, or a .toml file [default: printed, or as in the session]
    #[arg(long, value_name = "NAME", value_parser = offered(ChosenConvention::read, names()), hide_possible_values = true)]
    pub convention: Option<ChosenConvention>,

    #[command(flatten)]
    pub materials: MaterialArgs,
}

/// The names of all conventions.
pub fn names() -> impl Iterator<Item = &'static str> {
    named_conventions::all().iter().map(|convention| convention.name.as_str())
}

/// The materials of a command, with patterns expanded.
#[derive(Debug)]
pub struct MaterialArgs {
    pub ground_truth: Option<NamedPath>,
    pub predictions: Vec<NamedPath>,
    pub reading: PairReadingArgs,
}

/// The materials as they are typed.
#[derive(Debug, clap::Args)]
struct TypedMaterialArgs {
    /// Ground truth: an image, a folder, a name prefix or a session
    ///
    /// A packed or layered image, a folder, a name prefix, or a session file or saved picture with its predictions; without one, the
    /// built-in materials. NAME=PATH names it.
    #[arg(value_name = "GT", value_parser = NamedPath::parser())]
    ground_truth: Option<NamedPath>,

    /// Predictions of it, of the same size; NAME=PATH names one
    ///
    /// Patterns such as 'out/*.png' are expanded.
    #[arg(value_name = "PRED", value_parser = NamedPath::parser())]
    predictions: Vec<NamedPath>,

    #[command(flatten)]
    reading: PairReadingArgs,
}

impl clap::Args for MaterialArgs {
    fn augment_args(command: Command) -> Command {
        TypedMaterialArgs::augment_args(command)
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl FromArgMatches for MaterialArgs {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let TypedMaterialArgs { ground_truth, predictions, reading } =
            TypedMaterialArgs::from_arg_matches(matches)?;
        let mut materials = Self { ground_truth: None, predictions: Vec::new(), reading };
        materials
            .set(ground_truth.into_iter().chain(predictions))
            .map_err(|problem| clap::Error::raw(ErrorKind::ValueValidation, format!("{problem}\n")))?;
        Ok(materials)
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

impl MaterialArgs {
    /// Takes the paths `given` for the ground truth and the predictions, with patterns expanded as a shell does.
    pub fn set(&mut self, given: impl Iterator<Item = NamedPath>) -> Result<(), CommandError> {
        let mut paths = wildcards::expanded(given)?.into_iter();
        self.ground_truth = paths.next();
        self.predictions = paths.collect();
        Ok(())
    }

    /// Refuses what is specified of files that are not read in this way.
    fn refuse(&self, given: &Specified, reason: &str) -> Result<(), CommandError> {
        given.refuse::<StatementArgs>(reason)?;
        refuse(!self.reading.register.is_empty(), "register", reason)?;
        refuse(self.reading.resize_to.is_some(), "resize-to", reason)
    }

    /// Refuses what is specified of files where the built-in materials are taken.
    pub fn refuse_of_built_in(&self, given: &Specified) -> Result<(), CommandError> {
        let reason = "the built-in materials are not read from files";
        self.refuse(given, reason)?;
        refuse(self.reading.both.strict, "strict", reason)
    }

    /// Refuses what is specified of files where a session names them.
    pub fn refuse_of_session(&self, given: &Specified) -> Result<(), CommandError> {
        self.refuse(given, "a session specifies how its materials are read")
    }

    /// The ground truth, then the predictions, each with the options that it is read with.
    pub fn sources(&self) -> Result<Vec<MaterialSource>, CommandError> {
        let reading = self.reading.reading()?;
        let sides = std::iter::once(Whose::GroundTruth).chain(std::iter::repeat(Whose::Predictions));
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

    /// The paths as given: the ground truth, then the predictions.
    pub fn paths(&self) -> impl Iterator<Item = &PathBuf> {
        self.ground_truth.iter().chain(&self.predictions).map(|given| &given.path)
    }
}
