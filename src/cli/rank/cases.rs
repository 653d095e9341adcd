//! The materials of a data set, and how they are read.

use std::path::Path;

use svbrdf_evaluate::dataset::{DatasetReading, Method, Source};
use svbrdf_evaluate::report::distinct_names;

use super::args::RankArgs;
use crate::cli::args::reading::{PairReadingArgs, Side};
use crate::cli::args::wildcards;
use crate::cli::output::CommandError;

/// How the ground truths and the predictions of `methods` are read.
///
/// # Errors
/// [`Error::SpecifiedTwice`](svbrdf_files::Error::SpecifiedTwice); [`CommandError::Usage`] for a name that no method has.
pub fn reading(given: &PairReadingArgs, methods: &[String]) -> Result<DatasetReading, CommandError> {
    let reading = given.reading()?;
    reading.check(None, methods)?;
    let predictions = reading.options_for(Side::Prediction, "");
    let of_method = |name: &String| (name.clone(), reading.options_for(Side::Prediction, name));
    let methods = methods.iter().map(of_method).filter(|(_, options)| *options != predictions).collect();
    let ground_truths = reading.options_for(Side::GroundTruth, "");
    Ok(DatasetReading { ground_truths, predictions, methods, strict: given.both.strict })
}

/// The folders or the table of the materials.
///
/// # Errors
/// [`CommandError::Usage`].
pub fn source(args: &RankArgs) -> Result<Source, CommandError> {
    let Some(ground_truth) = &args.comparison.materials.ground_truth else {
        return Err(CommandError::usage("give a folder of ground truths, or a table of pairs"));
    };
    if args.pairs {
        return match args.comparison.materials.predictions.as_slice() {
            [] => Ok(Source::Table(ground_truth.path.clone())),
            _ => Err(CommandError::usage("--pairs takes one CSV table, which names the predictions")),
        };
    }
    let given = wildcards::expanded(&args.comparison.materials.predictions)?;
    if given.is_empty() {
        return Err(CommandError::Usage(format!(
            "there is no method to compare with {}; give one or more folders",
            ground_truth.path.display()
        )));
    }
    let named: Vec<(String, &Path)> = given
        .iter()
        .map(|given| (given.name.clone().unwrap_or_else(|| name(&given.path)), given.path.as_path()))
        .collect();
    let named: Vec<(&str, &Path)> = named.iter().map(|(name, path)| (name.as_str(), *path)).collect();
    let names = distinct_names(&named);
    let methods = names.into_iter().zip(given.iter().map(|given| given.path.clone()));
    let methods = methods.map(|(name, path)| Method { name, path }).collect();
    Ok(Source::Folders { ground_truths: ground_truth.path.clone(), methods })
}

/// The name of a method: that of its folder, or what its pattern adds to the name of a material.
fn name(path: &Path) -> String {
    let last = |path: &Path| path.file_name().map(|name| name.to_string_lossy().into_owned());
    let stem = path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
    let added = stem
        .filter(|stem| stem.contains("{}"))
        .map(|stem| stem.replace("{}", "").trim_matches(|c: char| !c.is_alphanumeric()).to_owned());
    match added {
        Some(added) if !added.is_empty() => Some(added),
        Some(_) => path.parent().and_then(last),
        None => last(path),
    }
    .unwrap_or_else(|| path.display().to_string())
}
