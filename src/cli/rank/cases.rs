//! The materials of a data set, and how they are read.

use std::path::{Path, PathBuf};

use svbrdf_core::report::distinct_names;
use svbrdf_files::dataset::{Case, DatasetReading, cases_of_folders, cases_of_table};

use super::args::RankArgs;
use crate::cli::args::reading::Side;
use crate::cli::args::wildcards;
use crate::cli::output::CommandError;

/// How the materials are read.
///
/// # Errors
/// [`Error::SpecifiedTwice`](svbrdf_core::error::Error::SpecifiedTwice); [`CommandError::Usage`].
pub fn reading(args: &RankArgs) -> Result<DatasetReading, CommandError> {
    let given = &args.comparison.materials.reading;
    let reading = given.reading()?;
    if reading.has_names() {
        return Err(CommandError::usage(
            "rank --dataset does not read one method in its own way yet; leave out NAME:",
        ));
    }
    Ok(DatasetReading {
        ground_truths: reading.options_for(Side::GroundTruth, ""),
        predictions: reading.options_for(Side::Prediction, ""),
        strict: given.both.strict,
    })
}

/// The materials of the folders or of the table.
///
/// # Errors
/// [`CommandError::Usage`]; those of [`cases_of_folders`] and [`cases_of_table`].
pub fn cases(args: &RankArgs) -> Result<Vec<Case>, CommandError> {
    let Some(ground_truth) = &args.comparison.materials.ground_truth else {
        return Err(CommandError::usage("give a folder of ground truths, or a table of pairs"));
    };
    if args.pairs {
        return match args.comparison.materials.predictions.as_slice() {
            [] => Ok(cases_of_table(&ground_truth.path)?),
            _ => Err(CommandError::usage("--pairs takes one CSV table, which names the predictions")),
        };
    }
    let folders = wildcards::expanded(&args.comparison.materials.predictions)?;
    if folders.is_empty() {
        return Err(CommandError::Usage(format!(
            "there is no method to compare with {}; give one or more folders",
            ground_truth.path.display()
        )));
    }
    let named: Vec<(String, &Path)> = folders
        .iter()
        .map(|given| (given.name.clone().unwrap_or_else(|| name(&given.path)), given.path.as_path()))
        .collect();
    let named: Vec<(&str, &Path)> = named.iter().map(|(name, path)| (name.as_str(), *path)).collect();
    let names = distinct_names(&named);
    let methods: Vec<(String, PathBuf)> =
        names.into_iter().zip(folders.iter().map(|given| given.path.clone())).collect();
    Ok(cases_of_folders(&ground_truth.path, &methods)?)
}

fn name(folder: &Path) -> String {
    folder
        .file_name()
        .map_or_else(|| folder.display().to_string(), |name| name.to_string_lossy().into_owned())
}
