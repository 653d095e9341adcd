//! The materials of a data set, and how they are read.

use std::collections::BTreeMap;

use svbrdf_evaluate::dataset::{DatasetReading, Source};

use crate::cli::args::reading::{PairReadingArgs, Whose};
use crate::cli::args::{MaterialArgs, refuse};
use crate::cli::output::CommandError;

/// How the ground truths and the predictions of `methods` are read.
pub fn reading(given: &PairReadingArgs, methods: &[String]) -> Result<DatasetReading, CommandError> {
    let reason = "materials of a data set are brought to one size by --register";
    refuse(given.resize_to.is_some(), "resize-to", reason)?;
    let reading = given.reading()?;
    reading.check(None, methods)?;
    let predictions = reading.options_for(Whose::Predictions, "");
    let of_method = |name: &String| (name.clone(), reading.options_for(Whose::Predictions, name));
    let of_methods = methods.iter().map(of_method).filter(|(_, options)| *options != predictions).collect();
    let ground_truths = reading.options_for(Whose::GroundTruth, "");
    let mut registrations = BTreeMap::new();
    for (whose, way) in &given.register {
        let is_of = |method: &&String| whose.as_ref().is_none_or(|whose| whose == *method);
        let of: Vec<&String> = methods.iter().filter(is_of).collect();
        if of.is_empty() {
            let (whose, names) = (whose.as_deref().unwrap_or_default(), methods.join(", "));
            return Err(CommandError::Usage(format!(
                "--register: no method is named {whose}; the names are {names}"
            )));
        }
        registrations.extend(of.into_iter().map(|method| (method.clone(), *way)));
    }
    Ok(DatasetReading {
        ground_truths,
        predictions,
        methods: of_methods,
        registrations,
        strict: given.both.strict,
        ..DatasetReading::default()
    })
}

/// The folders or the table of the materials.
pub fn source(materials: &MaterialArgs, is_table: bool) -> Result<Source, CommandError> {
    let Some(ground_truth) = &materials.ground_truth else {
        return Err(CommandError::usage("give a folder of ground truths, or a table of pairs"));
    };
    if is_table {
        return match materials.predictions.as_slice() {
            [] => Ok(Source::Table(ground_truth.path.clone())),
            _ => Err(CommandError::usage("--pairs takes one CSV table, which names the predictions")),
        };
    }
    if materials.predictions.is_empty() {
        return Err(CommandError::Usage(format!(
            "--dataset: there is no method to compare with {}; give one or more folders",
            ground_truth.path.display()
        )));
    }
    let methods =
        materials.predictions.iter().map(|given| (given.name.clone(), given.path.clone())).collect();
    Ok(Source::folders(ground_truth.path.clone(), methods))
}
