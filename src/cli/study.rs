//! `svbrdf study`: speed against accuracy.

use std::io::Write as _;
use std::path::PathBuf;

use svbrdf_core::loss::Comparison;
use svbrdf_evaluate::study;
use svbrdf_files::disk::atomic::Destination;
use svbrdf_files::disk::inputs::check_output;

use super::args::{ComparisonArgs, Specified};
use super::job::materials::OpenedMaterials;
use super::job::{ComparisonJob, Job, MaterialJob, NewJob};
use super::output::{CommandError, exit, stoppable, watched};

/// Measures the time and the error of the loss in many settings, for one pair on this machine
///
/// Computes the loss over 9 to 24,576 scenes, random and Sobol, on all texels and on subsets. Errors are relative to a
/// reference over far more scenes. Prints the cheapest setting for a few target errors. Without GT and PRED: the built-in pair.
#[derive(Debug, clap::Args)]
pub struct StudyArgs {
    /// Writes all points to a CSV file
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,

    #[command(flatten)]
    comparison: ComparisonArgs,
}

#[derive(Debug)]
struct StudyJob {
    comparison: ComparisonJob,
    output: Option<PathBuf>,
}

impl StudyArgs {
    pub fn job(self, given: &Specified) -> NewJob {
        let comparison = ComparisonJob::new(&self.comparison, given)?;
        check_predictions(&comparison.materials)?;
        Ok(Box::new(StudyJob { comparison, output: self.output }))
    }
}

/// Measures, prints the summary to stdout and writes the table.
impl Job for StudyJob {
    fn run(self: Box<Self>) -> Result<(), CommandError> {
        let Self { comparison: ComparisonJob { materials, convention, .. }, output } = *self;
        let table = |path: &PathBuf| Destination::new(path, &["csv"], "extension of a table", ".csv");
        let table = output.as_ref().map(table).transpose()?;
        let OpenedMaterials { ground_truth, predictions, .. } = &materials.open::<f32>()?;
        output.iter().try_for_each(|output| check_output(output))?;
        let predictions: Vec<_> = predictions.iter().take(1).collect();
        let comparison = Comparison::new(ground_truth, &predictions, convention)?;
        let study = watched("measuring", |progress| study::run(&comparison, progress))?;
        let rows = study.table().csv()?;
        stoppable(|progress| {
            table.map_or(Ok(()), |table| table.replace(progress, |file| file.write_all(rows.as_bytes())))
        })?;
        Ok(exit::put_text(&study.summary())?)
    }
}

fn check_predictions(materials: &MaterialJob) -> Result<(), CommandError> {
    match (materials.paths.first(), materials.predictions()) {
        (None, _) | (Some(_), 1) => Ok(()),
        (Some(path), count) => Err(CommandError::Usage(format!(
            "a study takes one prediction of {}, found {count}; {}",
            path.display(),
            if count == 0 { "give one after it" } else { "leave out the others" }
        ))),
    }
}
