//! The materials of a data set, and how they are read.

use std::collections::BTreeMap;
use std::path::Path;

use svbrdf_core::report::distinct_names;
use svbrdf_files::dataset::{DatasetReading, Method, Source};

use super::args::RankArgs;
use crate::cli::args::wildcards;
use crate::cli::output::CommandError;

/// How the materials are read.
pub fn reading(args: &RankArgs) -> DatasetReading {
    let reading = &args.comparison.materials.reading;
    DatasetReading {
        ground_truths: reading.of_ground_truth(),
        predictions: reading.of_predictions(),
        methods: BTreeMap::new(),
        strict: reading.both.strict,
    }
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
            [] => Ok(Source::Table(ground_truth.clone())),
            _ => Err(CommandError::usage("--pairs takes one CSV table, which names the predictions")),
        };
    }
    let paths = wildcards::expanded(&args.comparison.materials.predictions)?;
    if paths.is_empty() {
        return Err(CommandError::Usage(format!(
            "there is no method to compare with {}; give one or more folders",
            ground_truth.display()
        )));
    }
    let named: Vec<(String, &Path)> = paths.iter().map(|path| (name(path), path.as_path())).collect();
    let named: Vec<(&str, &Path)> = named.iter().map(|(name, path)| (name.as_str(), *path)).collect();
    let names = distinct_names(&named);
    let methods = names.into_iter().zip(paths.iter().cloned()).map(|(name, path)| Method { name, path });
    Ok(Source::Folders { ground_truths: ground_truth.clone(), methods: methods.collect() })
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
