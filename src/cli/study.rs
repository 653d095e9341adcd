//! `svbrdf study`: speed against accuracy.

use std::path::PathBuf;

use svbrdf_core::loss::check_same_size;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::text::time;
use svbrdf_evaluate::study::{self, Pair, Study};
use svbrdf_evaluate::study::{csv as study_csv, plot};
use svbrdf_files::disk::inputs::check_output;

use super::args::{ComparisonArgs, Given};
use super::job::materials::Opened;
use super::job::{ComparisonJob, Job, MaterialJob, NewJob};
use super::output::stop::stoppable;
use super::output::{CommandError, exit, watched};

/// Measures the time and the error of the loss in many settings, for one pair on this machine
///
/// Computes the loss over 9 to 24,576 scenes, random and Sobol, on all texels and on subsets, in f32 and f64,
/// with float, half and 8-bit maps. Errors are relative to a reference over far more scenes. Prints the
/// cheapest setting for a few target errors. Without GT and PRED: the built-in pair.
#[derive(Debug, clap::Args)]
pub struct StudyArgs {
    /// Writes all points to a CSV file
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,

    /// Plots error against time to an .svg or .png file
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,

    #[command(flatten)]
    comparison: ComparisonArgs,
}

#[derive(Debug)]
struct StudyJob {
    comparison: ComparisonJob,
    output: Option<PathBuf>,
    plot: Option<PathBuf>,
}

impl StudyArgs {
    pub fn job(self, given: &Given) -> NewJob {
        let comparison = ComparisonJob::new(&self.comparison, given)?;
        check_predictions(&comparison.materials)?;
        Ok(Box::new(StudyJob { comparison, output: self.output, plot: self.plot }))
    }
}

/// Measures, prints the summary to stdout and writes the files.
impl Job for StudyJob {
    fn run(self: Box<Self>) -> Result<(), CommandError> {
        let Self { comparison, output, plot: picture } = *self;
        let plot = picture.as_deref().map(plot::destination).transpose()?;
        let table = output.as_deref().map(study_csv::destination).transpose()?;
        let opened = comparison.materials.open::<f32>()?;
        output.iter().chain(&picture).try_for_each(|output| check_output(output))?;
        let study = measured(&opened, comparison.convention)?;
        stoppable(|progress| {
            table.map_or(Ok(()), |table| study_csv::write(&study, &table, progress))?;
            plot.map_or(Ok(()), |plot| plot::write(&study, &plot, progress))
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

fn measured(opened: &Opened<f32>, convention: Convention) -> Result<Study, CommandError> {
    let (ground_truth, prediction) = (&opened.ground_truth, &opened.predictions[0]);
    check_same_size(ground_truth, prediction)?;
    let pair = Pair { ground_truth, prediction, convention };
    let reference = watched("computing the reference", |progress| study::reference(&pair, progress))?;
    let expected = time(study::expected_seconds(&pair, &reference));
    exit::tell(&format!("note: about {expected} to go"));
    Ok(watched("measuring", |progress| study::measure(&pair, reference, progress, |_| ()))?)
}
